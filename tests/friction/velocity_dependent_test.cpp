// Friction that changes with the speed: reference values, closed forms, limits, energy.
#include "stickslip/friction/velocity_dependent.hpp"

#include <cmath>
#include <limits>
#include <numbers>

#include "stickslip/numerics/gauss_legendre.hpp"
#include "support/catch.hpp"
#include "support/motions.hpp"
#include "support/outcome.hpp"
#include "support/reference.hpp"

using namespace stickslip;
using namespace test;

namespace {

/// The speed of a slide under a load that grows from p0 at the rate p1 > 0, without a spring. With w = exp(r v) the
/// equation of motion is linear, w' = r ((p - fast) w + fast - slow): with z = (p - fast) sqrt(r / 2 p1), which runs
/// from z0 to z1,
///     w = exp(z1^2) (exp(-z0^2) w0 + r (fast - slow) sqrt(2 / r p1) int exp(-z^2) dz), the integral by erf.
double speed_under_growing_load(const VelocityDependent& law, double p0, double p1, double v0, double t) {
  const long double r = law.rate(), fast = law.fast(), c = std::sqrt(r / (2 * static_cast<long double>(p1)));
  const long double z0 = (p0 - fast) * c, z1 = (p0 + static_cast<long double>(p1) * t - fast) * c;
  const long double part = z1 < 0 ? std::erfc(-z1) - std::erfc(-z0) : std::erf(z1) - std::erf(z0);
  const long double area = std::sqrt(std::numbers::pi_v<long double>) / 2 * part;
  const long double w =
      std::exp(z1 * z1) * (std::exp(-z0 * z0 + r * v0) + r * (fast - law.slow()) * (1 / (c * p1)) * area);
  return static_cast<double>(std::log(w) / r);
}

State slide(const VelocityDependent& law, double p0, double p1, double v0, double t) {
  State state = State::at(0, v0);
  advance(Slider(law), Segment{t, -p0, -(p0 + p1 * t)}, state);
  return state;
}

static_assert(SpeedLaw<VelocityDependent> && SymmetricLaw<VelocityDependent>);

}  // namespace

TEST_CASE("a block on speed-dependent friction and a spring moves as the reference does", "[velocity_dependent]") {
  const GroundMotion motion = record_a(Interpolation::linear);
  for (const auto& run : reference::rows("sliders", "speed_dependent")) {
    INFO(run["id"].as<std::string>());
    const VelocityDependent law(run["slow"], run["fast"], run["rate"]);
    const Response r = integrate(Slider(law, run["natural_frequency"]), motion);
    check_outcome(r, run, std::abs(motion.acceleration()[0]) > run["slow"]);
    CHECK(std::abs(r.energy.dissipated - run["dissipated"]) <= 1e-12 * run["dissipated"]);
  }
}

TEST_CASE("a slide on speed-dependent friction follows its closed forms", "[velocity_dependent]") {
  // next_values.json C.closed.up and C.closed.const
  const State up = slide(VelocityDependent(0.6, 1.5, 5), 0.4, 3, 0.8, 0.1);
  CHECK(std::abs(up.velocity - 0.7071251543684945851247682) <= 1e-14);
  CHECK(std::abs(up.displacement - 0.07509810500552427963765063) <= 1e-15);
  const State level = slide(VelocityDependent(0.6, 1.5, 20), 1.2, 0, 0.2, 0.1);
  CHECK(std::abs(level.velocity - 0.17220911598920858284469) <= 1e-14);
  CHECK(std::abs(level.displacement - 0.01860028033737045775185241) <= 1e-15);
  for (const auto& law : {VelocityDependent(0.6, 1.5, 5), VelocityDependent(1.5, 0.6, 5), VelocityDependent(0, 2, 30)})
    for (const double p0 : {0.5, 2.0})
      for (const double p1 : {0.4, 3.0})
        for (const double t : {0.01, 0.3}) {
          CAPTURE(law.slow(), law.fast(), law.rate(), p0, p1, t);
          CHECK(std::abs(slide(law, p0, p1, 0.8, t).velocity - speed_under_growing_load(law, p0, p1, 0.8, t)) <= 1e-14);
        }
}

TEST_CASE("speed-dependent friction becomes Coulomb's in its limits", "[velocity_dependent]") {
  const GroundMotion motion = record_a(Interpolation::linear);
  const auto compare = [&](const VelocityDependent& law, double level, double tolerance) {
    for (const double wn : {0.0, 2.0}) {
      CAPTURE(law.slow(), law.fast(), law.rate(), wn);
      const Response r = integrate(Slider(law, wn), motion), coulomb = integrate(Slider(Coulomb(level), wn), motion);
      CHECK(difference(r.displacement, coulomb.displacement) <= tolerance * coulomb.peak);
      CHECK(std::abs(r.peak - coulomb.peak) <= tolerance * coulomb.peak);
    }
  };
  compare({1, 1, 7}, 1, 1e-12);
  compare({1, 3, 0}, 1, 1e-12);  // always slow
  // Almost always fast: where it slides it is slow for some 1 / (rate * 1 m/s^2) s of each slip, and the level at rest
  // is the fast one to a part in rate.
  compare({1 - 1e-9, 1, 1e9}, 1, 1e-7);
}

TEST_CASE("speed-dependent friction takes no side and closes its ledger", "[velocity_dependent]") {
  const GroundMotion motion = broadband(31, 1'000);
  for (const auto& law : {VelocityDependent(0.3, 0.6, 50), VelocityDependent(0.6, 0.3, 10)})
    for (const double wn : {0.0, 2.5})
      for (const double c : {0.0, 0.4}) {
        CAPTURE(law.slow(), wn, c);
        const Response r = integrate(Slider(law, wn, c), motion),
                       mirrored = integrate(Slider(law, wn, c), motion.scaled(-1));
        CHECK(std::abs(r.energy.imbalance()) <= 1e-12 * turnover(r.energy));
        CHECK(r.energy.dissipated >= 0.3 * r.sliding_distance);
        CHECK(r.energy.dissipated <= 0.6 * r.sliding_distance);
        CHECK(r.residual == -mirrored.residual);
        CHECK(grammatical(r));
        // Lengths twice as long, speeds and levels too.
        const VelocityDependent twice(2 * law.slow(), 2 * law.fast(), law.rate() / 2);
        CHECK(integrate(Slider(twice, wn, c), motion.scaled(2)).residual == 2 * r.residual);
      }
}

TEST_CASE("speed-dependent friction rejects invalid parameters", "[velocity_dependent][errors]") {
  CHECK_THROWS_WITH(VelocityDependent(-0.1, 1, 1),
                    Catch::Matchers::ContainsSubstring("slow must be finite and at least 0, got -0.1 m/s^2"));
  CHECK_THROWS_AS(VelocityDependent(1, infinity, 1), std::invalid_argument);
  CHECK_THROWS_AS(VelocityDependent(1, 1, -1), std::invalid_argument);
  CHECK_THROWS_AS(VelocityDependent(1, 1, not_a_number), std::invalid_argument);
}

TEST_CASE("friction that grows with the speed creeps to rest on a spring", "[velocity_dependent]") {
  // Overdamped: c = (fast - slow) rate = 9.8 1/s beside wn = 2 rad/s. It approaches x = slow / wn^2, where the spring
  // is as strong as friction at no speed, and never reaches it.
  const double slow = 0.05 * standard_gravity;
  const Slider slider(VelocityDependent(slow, 2 * slow, 20), 2);
  const Response r = integrate(slider, GroundMotion({0, 0, 0}, 0.05),
                               {.displacement = 0.19672, .velocity = -0.042568, .settle = true});
  CHECK(r.residual == Approx(slow / 4).epsilon(1e-14));
  CHECK(r.state.mode == Mode::stuck);
  CHECK(r.events[r.events.size() - 2].kind == EventKind::arrest);
  CHECK(std::abs(r.energy.imbalance()) <= 1e-14 * r.energy.initial);
}

TEST_CASE("friction that vanishes at rest lets a slider creep to rest in bounded work", "[velocity_dependent]") {
  // v' = -fast (1 - exp(-rate v)): w = exp(rate v) - 1 decays as exp(-fast rate t), and the slider comes to rest at the
  // integral of v / (fast (1 - exp(-rate v))) over the speeds, here by the quadrature of log-spaced parts.
  struct Steps {
    int count = 0;
    void slide(const Slip&) { ++count; }
    void event(EventKind, double, const State&) {}
  };
  const double v0 = 1;
  for (const double fast : {0.1, 1.0, 5.0})
    for (const double rate : {0.5, 5.0, 100.0}) {
      CAPTURE(fast, rate);
      const VelocityDependent law(0, fast, rate);
      for (const double time : {1.0, 6.0, 100.0}) {
        State state = State::at(0, v0);
        Steps steps;
        advance(Slider(law), Segment{time, 0, 0}, state, steps);
        const double left = std::log1p(std::expm1(rate * v0) * std::exp(-fast * rate * time)) / rate;
        if (left > 1e-300) CHECK(state.velocity == Approx(left).epsilon(1e-11));
        CHECK(steps.count <= 50 + 2 * fast * rate * time);
      }
      double far = 0;
      for (double v = v0; v > 1e-18 * v0; v /= 2)
        far += numerics::gauss_integral<20>(v / 2, v, [&](double u) { return u / (-fast * std::expm1(-rate * u)); });
      const Response r = integrate(law, GroundMotion({0, 0, 0}, 0.1), from(0, v0, true));
      CHECK(r.residual == Approx(far).epsilon(1e-12));
      CHECK(r.state.mode == Mode::stuck);
      CHECK(r.events[r.events.size() - 2].kind == EventKind::arrest);
    }
}

TEST_CASE("friction that all but vanishes at rest, or at speed, is followed", "[velocity_dependent]") {
  const GroundMotion motion({0, 3, -3, 0}, 0.1);
  const double limit = integrate(VelocityDependent(0, 1, 5), motion, from(0, 0, true)).residual;
  for (const double slow : {1e-300, 1e-100, 1e-20, 1e-9}) {
    const Response r = integrate(VelocityDependent(slow, 1, 5), motion, from(0, 0, true));
    CHECK(std::abs(r.residual - limit) <= 1e-14 + 100 * slow);
    CHECK(r.state.mode == Mode::stuck);
  }
  // On springs and as pendulums it creeps or swings to the middle.
  for (const double frequency : {0.5, 3.0}) {
    const Response r = integrate(Slider(VelocityDependent(0, 1, 5), frequency), motion, from(0, 0, true));
    CHECK(std::abs(r.residual) <= 1e-12 * r.peak);
    CHECK(r.state.mode == Mode::stuck);
  }
  const Response dish =
      integrate(Slider<VelocityDependent>::friction_pendulum(VelocityDependent(0, 1, 50), 2), motion, from(0, 0, true));
  CHECK(std::abs(dish.residual) <= 1e-12 * dish.peak);
  // A level that vanishes at high speed: a load of 10 m/s^2 meets a work of 1/50 m^2/s^2 per meter of speed.
  State state = State::at(0, 1);
  advance(Slider(VelocityDependent(1, 0, 50)), Segment{1, -10, -10}, state);
  CHECK(state.velocity == Approx(11).epsilon(1e-14));  // exp(-50) of the level is left at the start
}
