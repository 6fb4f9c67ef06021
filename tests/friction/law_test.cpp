// A user's own friction law: three lines are enough.
#include <numbers>

#include "support/catch.hpp"
#include "support/motions.hpp"

using namespace stickslip;
using namespace test;

namespace {

/// A law that depends on direction and uses most of the available functions.
struct Ripple {
  template <class T>
  auto resist(const T& x, Direction direction) const {
    using std::exp, std::sin, std::cos, std::sqrt;
    return (direction == Direction::forward ? 1.0 : 1.5) * (1.2 + 0.3 * sin(3 * x) * exp(-x * x / 9)) /
           sqrt(1 + x * x * 0.01) * (2 + cos(x)) / 3;
  }
};

/// A law given by its work as well.
struct Quadratic {
  template <class T>
  auto resist(const T& x, Direction) const {
    return 1 + x * x;
  }
  double work(double from, double distance, Direction direction) const {
    const double middle = from + sign(direction) * distance / 2;
    return distance * (1 + middle * middle + distance * distance / 12);
  }
};

/// No number to the left of 0, and no derivative at it.
struct Root {
  template <class T>
  auto resist(const T& x, Direction) const {
    using std::sqrt;
    return sqrt(x);
  }
};

double bump_work(const Bump& law, double from, double distance) {
  const long double low = from / static_cast<long double>(law.reach);
  const long double high = low + distance / static_cast<long double>(law.reach);
  const long double area = low > 0    ? std::erfc(low) - std::erfc(high)
                           : high < 0 ? std::erfc(-high) - std::erfc(-low)
                                      : std::erf(high) - std::erf(low);
  return static_cast<double>(law.slip_level * law.reach * std::sqrt(std::numbers::pi_v<long double>) / 2 * area);
}

static_assert(FrictionLaw<Coulomb> && form_of<Coulomb> == Form::constant);
static_assert(FrictionLaw<Caster> && form_of<Caster> != Form::constant);
static_assert(FrictionLaw<Bump> && form_of<Bump> != Form::constant);
static_assert(FrictionLaw<Ripple> && FrictionLaw<Quadratic> && FrictionLaw<Disguised>);
static_assert(LawWithWork<Coulomb> && LawWithWork<Caster> && LawWithWork<Quadratic> && !LawWithWork<Bump>);
static_assert(SpeedLaw<RateDependent> && !PositionLaw<RateDependent> && !LawWithHold<RateDependent>);
static_assert(!FrictionLaw<double> && !FrictionLaw<State>);

}  // namespace

TEST_CASE("the work against a user's law is the integral of its level", "[law]") {
  // Ten Gauss-Legendre points are wrong by at most (h/reach)^21 (10!)^4 / (21 (20!)^3) * 20!/10!, 4e-19 for h = reach.
  // The remaining error is the rounding of x, on a slope of 2 x / reach^2.
  const Bump law{1.3, 0.4};
  for (const double from : {-2.0, -0.4, -0.1, 0.0, 0.05, 0.3, 1.0})
    for (const double distance : {0.001, 0.01, 0.1, 0.4}) {
      INFO("from " << from << " by " << distance);
      const double exact = bump_work(law, from, distance), y = (std::abs(from) + distance) / law.reach;
      const double tolerance = (2e-15 + 2 * y * y * 2.2e-16) * exact;
      CHECK(std::abs(friction_work(law, from, distance, Direction::forward) - exact) <= tolerance);
      CHECK(std::abs(friction_work(law, from + distance, distance, Direction::backward) - exact) <= 2 * tolerance);
    }
  CHECK(friction_work(law, 0.2, 0, Direction::forward) == 0);
}

TEST_CASE("a law that defines its work is called for it", "[law]") {
  CHECK(std::abs(friction_work(Quadratic{}, 1, 2, Direction::forward) - (2 + 26.0 / 3)) <= 1e-14);
  CHECK(std::abs(friction_work(Quadratic{}, 3, 2, Direction::backward) - (2 + 26.0 / 3)) <= 1e-14);
  CHECK(friction_work(Coulomb(2, 3), 7, 4, Direction::forward) == 8);
  CHECK(friction_work(Coulomb(2, 3), 7, 4, Direction::backward) == 12);
  CHECK(friction_work(Coulomb(2, infinity), 7, 0, Direction::backward) == 0);
}

TEST_CASE("the ledger of a user's law closes", "[law]") {
  for (const double natural_frequency : {0.0, 1.3}) {
    const auto closes = [&](const auto& law, const IntegrateOptions& start) {
      const Response r = integrate(Slider(law, natural_frequency), broadband(20, 2'000), start);
      CHECK(std::abs(r.energy.imbalance()) <= 1e-12 * turnover(r.energy));
      CHECK(r.energy.dissipated > 0);
      CHECK(grammatical(r));
    };
    for (const auto& start : {from(0), from(0.3, 2), from(-0.2, -1)}) {
      closes(Bump{1, 0.5}, start);
      closes(Ripple{}, start);
      closes(Quadratic{}, start);
      closes(Caster(1, 0.5), start);
      closes(Disguised{1}, start);
    }
  }
}

TEST_CASE("a user's bump takes its whole work from what shoots across it", "[law]") {
  // v^2/2 falls by a reach sqrt(pi); in one segment from so far out that the level is less than any double.
  const Bump law{1, 0.5};
  const double whole = 0.5 * std::sqrt(std::numbers::pi);
  for (const double start : {-2.0, -10.0, -40.0})
    for (const double speed : {1.5, 5.0, 100.0}) {
      INFO("from " << start << " at " << speed);
      const Response r = integrate(law, line(0, 0, 4 * -start / speed), from(start, speed));
      const double paid = start < -5 ? whole : bump_work(law, start, 4);
      CHECK(r.residual > 2);
      CHECK(std::abs(r.energy.dissipated - paid) <= 1e-3);  // the work beyond -2 and 2
      CHECK(std::abs(r.energy.imbalance()) <= 1e-12 * r.energy.initial);
      const double out = std::sqrt(speed * speed - 2 * r.energy.dissipated);
      CHECK(std::abs(r.state.velocity - out) <= 1e-12 * speed);
      if (start < -5) {
        CHECK(std::abs(r.energy.dissipated - whole) <= 1e-12 * r.energy.initial);
      }
    }
}

TEST_CASE("a user's law is symmetric where its formula is", "[law]") {
  const GroundMotion motion = broadband(21, 1'000);
  const Response one = integrate(Bump{1, 0.5}, motion), other = integrate(Bump{1, 0.5}, motion.scaled(-1));
  bool mirrored = one.events.size() == other.events.size();
  for (std::size_t i = 0; i < motion.samples(); ++i)
    mirrored = mirrored && one.displacement[i] == -other.displacement[i];
  CHECK(mirrored);
}

TEST_CASE("a law with no finite power series is said to have none", "[law][errors]") {
  CHECK_THROWS_AS(integrate(Root{}, held(0, 2), from(1, -3)), ConvergenceError);
  CHECK_THROWS_WITH(integrate(Root{}, held(-1, 2)),
                    Catch::Matchers::ContainsSubstring("no finite power series at x = 0 m"));
}

TEST_CASE("a law of the speed slows a slip as its equation says", "[law][speed]") {
  // v' = -(k + d exp(-v/s)) is linear in exp(v/s): (exp(v0/s) + d/k) exp(-k t/s) - d/k, until it is 1.
  for (const auto& law : {RateDependent{1, 0.4, 0.3}, RateDependent{0.4, 1, 0.3}, RateDependent{2, 1, 0.05}}) {
    const double k = law.sliding, d = law.at_rest - k, s = law.scale, v0 = 0.7, w0 = std::exp(v0 / s) + d / k;
    const double stop = s / k * std::log(w0 / (1 + d / k));
    const GroundMotion still = held(0, 2 * stop);
    const Response r = integrate(law, still, from(0, -v0));
    REQUIRE(r.events.size() == 3);
    CHECK(r.events[1].kind == EventKind::arrest);
    CHECK(std::abs(r.events[1].time - stop) <= 1e-13 * stop);
    CHECK(std::abs(r.energy.dissipated - v0 * v0 / 2) <= 1e-14 * v0 * v0);
    for (const double part : {0.1, 0.5, 0.99}) {
      State state = State::at(3, v0);
      advance(Slider(law), Segment{part * stop, 0, 0}, state);
      CHECK(std::abs(state.velocity - s * std::log(w0 * std::exp(-k * part * stop / s) - d / k)) <= 1e-13 * v0);
    }
  }
}

TEST_CASE("a law of the speed holds at rest what resists at no speed, and its ledger closes", "[law][speed]") {
  const RateDependent law{1, 0.4, 0.3};
  const GroundMotion strong = broadband(22, 2'000);
  const GroundMotion weak = strong.scaled(1 / strong.peak_acceleration() * (1 - 1e-15));
  CHECK(integrate(law, weak).sliding_distance == 0);
  for (const auto& slider : {Slider(law), Slider(law, 1.3), Slider(law, 1.3, 0.5)})
    for (const auto& start : {from(0), from(0.3, 2), from(-0.2, -1)}) {
      const Response r = integrate(slider, strong, start);
      CHECK(std::abs(r.energy.imbalance()) <= 1e-12 * turnover(r.energy));
      CHECK(r.energy.dissipated > law.sliding * r.sliding_distance);
      CHECK(r.energy.dissipated < law.at_rest * r.sliding_distance);
      CHECK(grammatical(r));
    }
}
