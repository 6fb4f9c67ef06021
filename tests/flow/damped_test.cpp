// A damper with friction: reference values, the functions of time, energy, limits.
#include "stickslip/flow/damped.hpp"

#include <array>
#include <cmath>
#include <random>
#include <stdexcept>
#include <vector>

#include "support/catch.hpp"
#include "support/motions.hpp"
#include "support/outcome.hpp"
#include "support/reference.hpp"

using namespace stickslip;
using namespace test;
using Catch::Matchers::ContainsSubstring;

namespace {

/// A law whose level at rest is higher than while sliding.
struct Sticky {
  static constexpr bool constant_while_sliding = true;
  double held, level;
  double hold(double, Direction) const { return held; }
  template <class T>
  double resist(const T&, Direction) const {
    return level;
  }
};

/// Coulomb friction and a damper as one law of the speed.
struct Viscous {
  double slip_level, damping;
  template <class X, class Speed>
  auto resist(const X&, const Speed& speed, Direction) const {
    return slip_level + damping * speed;
  }
};

static_assert(FrictionLaw<Viscous> && SpeedLaw<Viscous> && !PositionLaw<Viscous>);
static_assert(form_of<Sticky> == Form::constant && LawWithHold<Sticky>);

}  // namespace

TEST_CASE("a damped block on a spring moves as the reference does, by closed form and by power series", "[damped]") {
  for (const auto& run : reference::rows("sliders", "damped")) {
    const double hold = run["hold"], resist = run["resist"], wn = run["natural_frequency"],
                 c = 2 * run["damping_ratio"] * wn;
    const GroundMotion motion = record_a(Interpolation::linear);
    const bool at_once = motion.acceleration()[0] > hold;  // the reference counts from the first event after t = 0
    const auto check = [&](const Response& r, bool by_speed = false) {
      INFO(run["id"].as<std::string>());
      check_outcome(r, run, at_once);
      // Friction's; by a law of the speed it is the damper's too, of which the work is not given.
      if (by_speed)
        CHECK(r.energy.dissipated > run["dissipated"]);
      else
        CHECK(std::abs(r.energy.dissipated - run["dissipated"]) <= 1e-12 * run["dissipated"]);
    };
    check(integrate(Slider(Sticky{hold, resist}, wn, c), motion));
    if (hold != resist) continue;
    check(integrate(Slider(Coulomb(resist), wn, c), motion));
    check(integrate(Slider(Disguised{resist}, wn, c), motion));
    check(integrate(Slider(Viscous{resist, c}, wn), motion), true);
    check(integrate(Slider(Viscous{resist, c / 4}, wn, 0.75 * c), motion), true);
  }
}

TEST_CASE("friction and damper share the energy as their forces do", "[damped]") {
  // As a law of the speed the damper's work is friction's; the sum is the same.
  const GroundMotion motion = broadband(5, 300);
  for (const double wn : {0.0, 1.5, 12.0})
    for (const double c : {0.01, 0.8, 30.0}) {
      const Response apart = integrate(Slider(Coulomb(0.4), wn, c), motion),
                     together = integrate(Slider(Viscous{0.4, c}, wn), motion);
      const double all = turnover(apart.energy);
      CHECK(apart.energy.damped > 0);
      CHECK(together.energy.damped == 0);
      CHECK(std::abs(apart.energy.dissipated - 0.4 * apart.sliding_distance) <= 1e-13 * all);
      CHECK(std::abs(apart.energy.dissipated + apart.energy.damped - together.energy.dissipated) <= 1e-11 * all);
      // Each of 300 samples and its events adds some roundings of the energy.
      CHECK(std::abs(apart.energy.imbalance()) <= 1e-12 * all);
      CHECK(std::abs(together.energy.imbalance()) <= 1e-12 * all);
    }
}

TEST_CASE("the functions of a damped motion obey its equation, damped little, critically or much", "[damped]") {
  for (const double c : {1e-9, 0.1, 2.0, 2.0000001, 6.0, 6.0000001, 40.0, 1e5})
    for (const double wn : {0.0, 1e-6, 1.0, 3.0, 20.0})
      for (const double t : {1e-7, 0.01, 0.3, 5.0}) {
        CAPTURE(c, wn, t);
        const DampedBasis b(c, wn, t);
        // y'' + c y' + wn^2 y = 0 and its integrals, each term to a few roundings and as many as radians.
        const double e = (30 + wn * t) * std::numeric_limits<double>::epsilon(), k = wn * wn;
        CHECK(std::abs(b.decay + c * b.impulse + k * b.step - 1) <= e * (1 + c * b.impulse + k * std::abs(b.step)));
        CHECK(std::abs(b.impulse + c * b.step + k * b.ramp - t) <= e * (t + c * b.step + k * std::abs(b.ramp)));
        CHECK(std::abs(b.step + c * b.ramp + k * b.curve - t * t / 2) <= e * (t * t + c * b.ramp + k * b.curve));
        // Twice the time from one, by its own formula or by doubling.
        DampedBasis twice = b;
        twice.double_time(k);
        const DampedBasis there(c, wn, 2 * t);
        CHECK(std::abs(twice.impulse - there.impulse) <= 40 * e * 2 * t);
        CHECK(std::abs(twice.curve - there.curve) <= 40 * e * std::abs(there.curve));
      }
}

TEST_CASE("a spring that pushes away makes a damped motion grow", "[damped]") {
  for (const double c : {0.0, 1e-9, 0.1, 2.0, 40.0, 1e4})
    for (const double wn : {1e-6, 1.0, 3.0, 20.0})
      for (const double t : {1e-7, 0.01, 0.3, 5.0}) {
        CAPTURE(c, wn, t);
        const DampedBasis b(c, -wn, t);
        // As above with k = -wn^2; what grows has as many roundings as it has radians.
        const double e = (30 + wn * t) * std::numeric_limits<double>::epsilon(), k = -wn * wn;
        CHECK(std::abs(b.decay + c * b.impulse + k * b.step - 1) <= e * (1 + c * b.impulse - k * b.step));
        CHECK(std::abs(b.impulse + c * b.step + k * b.ramp - t) <= e * (t + c * b.step - k * b.ramp));
        CHECK(std::abs(b.step + c * b.ramp + k * b.curve - t * t / 2) <= e * (t * t + c * b.ramp - k * b.curve));
        if (c == 0) {
          CHECK(std::abs(b.decay - std::cosh(wn * t)) <= e * b.decay);
          CHECK(std::abs(b.impulse - std::sinh(wn * t) / wn) <= e * b.impulse);
        }
        DampedBasis twice = b;
        twice.double_time(k);
        const DampedBasis there(c, -wn, 2 * t);
        CHECK(std::abs(twice.impulse - there.impulse) <= 40 * e * there.impulse);
        CHECK(std::abs(twice.curve - there.curve) <= 40 * e * there.curve);
        // The integral of v^2 of a unit speed, by its two rates where they are apart.
        const double apart = std::sqrt(c * c - 4 * k), fast = (c + apart) / 2, slow = -wn * wn / fast;
        if (apart * t < 0.1) continue;
        const auto integral = [&](double rate) { return -std::expm1(-rate * t) / rate; };
        const double square = (fast * fast * integral(2 * fast) + slow * slow * integral(2 * slow) -
                               2 * fast * slow * integral(fast + slow + (c == 0 ? 1e-30 : 0))) /
                              (apart * apart);
        CHECK(std::abs(DampedSquare(c, -wn, t).of(1, 0, 0) - square) <= 1e-11 * square);
      }
}

TEST_CASE("slips on a damper that last for ages stop where they must", "[damped]") {
  // From 2 m/s against friction and a damper, without ground motion: u exp(-c t) = a (1 - exp(-c t)) / c.
  for (const double c : {1e-6, 0.3, 50.0, 1e6}) {
    State state = State::at(0, 2);
    advance(Slider(Coulomb(0.5), 0, c), Segment{100, 0, 0}, state);
    CHECK(state.mode == Mode::stuck);
    const double t = std::log1p(2 * c / 0.5) / c;
    CHECK(std::abs(state.displacement - (2 - 0.5 * t) / c) <= 1e-15 * (2 + 0.5 * t) / c);
  }
  // On a spring it swings until friction holds it, or, damped more than critically, creeps there indefinitely: where
  // friction and pull balance at 0.25 m, with the slower of the two rates.
  for (const double c : {0.02, 1.9, 2.1, 20.0, 500.0}) {
    State state = State::at(3, 0);
    advance(Slider(Coulomb(0.25), 1, c), Segment{1000, 0, 0}, state);
    CHECK((state.mode == Mode::stuck) == (c < 2));
    const double half = c / 2, root = std::sqrt(std::max(half * half - 1, 0.0)), slow = 1 / (half + root);
    const double creeping = 2.75 * (half + root) / (2 * root) * std::exp(-slow * 1000);  // the fast rate has died out
    if (c < 2)
      CHECK(std::abs(state.displacement) <= 0.25);
    else
      CHECK(std::abs(state.displacement - (0.25 + creeping)) <= 1e-14);
  }
}

TEST_CASE("the first stop is where the speed first comes down to zero", "[damped]") {
  // Against samples of the flow itself: nowhere before it is the speed negative, and there it is zero.
  for (const double c : {0.05, 1.0, 9.0})
    for (const double wn : {0.0, 2.0, 4.5, 30.0})
      for (const double u : {0.0, 0.01, 1.0})
        for (const double a : {-3.0, -0.1, 0.0, 0.4, 3.0})
          for (const double gain : {-20.0, -1.0, 0.0, 1.0, 20.0}) {
            CAPTURE(c, wn, u, a, gain);
            const double duration = 2;
            const Damped damped(c, wn);
            const DampedFlow flow(damped, {u, a, gain}, duration);
            const double stop = flow.first_stop();
            const double scale = u + std::abs(a) + std::abs(gain);
            const bool begins = u > 0 || a > 0 || (a == 0 && gain > 0);
            CHECK((stop > 0) == begins);
            if (!begins) continue;
            if (stop < never) CHECK(std::abs(flow.at(stop).speed) <= 1e-14 * scale);
            for (int i = 0; i <= 1000; ++i) CHECK(flow.at(std::min(stop, duration) * i / 1000).speed >= -1e-14 * scale);
          }
}

TEST_CASE("a slider's damping is checked", "[damped][errors]") {
  CHECK_THROWS_WITH(Slider(Coulomb(1), 0, -2),
                    "Slider: damping and its square must be finite and at least 0, got -2 1/s");
  CHECK_THROWS_AS(Slider(Coulomb(1), 0, infinity), std::invalid_argument);
  CHECK_THROWS_AS(Slider(Coulomb(1), 0, not_a_number), std::invalid_argument);
  CHECK(Slider(Coulomb(1), 2, 3).damping() == 3);
  CHECK(Slider(Coulomb(1), 2).damping() == 0);
}

TEST_CASE("closed form and power series agree for dampers and springs of all sizes", "[damped]") {
  std::mt19937_64 generator(5);
  std::uniform_real_distribution<double> uniform;
  for (int k = 0; k < 300; ++k) {
    const double dt = std::pow(10, -3 + 4 * uniform(generator));
    const double c = std::pow(10, -4 + 6 * uniform(generator)) / dt;
    const double wn = k % 3 == 0 ? 0 : std::pow(10, -3 + 4.5 * uniform(generator)) / dt;
    const double level = k % 5 == 0 ? 0 : std::pow(10, -2 + 3 * uniform(generator));
    CAPTURE(k, dt, c, wn, level);
    std::vector<double> n = gaussian(static_cast<std::uint64_t>(k), 30, 2);
    if (k % 4 == 0)
      for (double& value : n) value = std::round(2 * value) / 2;  // stops and breakaways at samples
    const GroundMotion motion(n, dt, k % 2 == 0 ? Interpolation::linear : Interpolation::constant);
    const Response r = integrate(Slider(Coulomb(level), wn, c), motion),
                   s = integrate(Slider(Disguised{level}, wn, c), motion);
    // A series is as good as its last check, to some 1e-14 of its terms; 30 segments add up.
    CHECK(difference(r.displacement, s.displacement) <= 1e-11 * r.peak);
    CHECK(count(r.events) == count(s.events));
    CHECK(std::abs(r.energy.imbalance()) <= 1e-11 * turnover(r.energy));
  }
}

TEST_CASE("what holds at rest is at least what resists at no speed", "[damped][law]") {
  // Rounded apart, as mu_s g and mu_k g are: a block at the level itself holds; it does not repeat slips of zero
  // duration without end.
  const double level = 0.3 * 9.80665;
  const Sticky law{std::nextafter(level, 0), level};
  CHECK(hold(law, 0, Direction::forward) == level);
  const Response r = integrate(law, GroundMotion({-level, -level, -level, -2 * level, 0}, 0.1), from(0, 0, true));
  CHECK(r.events.front().kind == EventKind::breakaway);
  CHECK(std::abs(r.events.front().time - 0.2) <= 1e-15);
}
