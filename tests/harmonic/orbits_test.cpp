// Periodic motions under a harmonic ground.
#include <array>
#include <complex>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include "stickslip/harmonic/continuation.hpp"
#include "stickslip/harmonic/orbits.hpp"
#include "support/catch.hpp"
#include "support/motions.hpp"
#include "support/reference.hpp"

using namespace stickslip;
using namespace test;
using Catch::Matchers::ContainsSubstring;

namespace {

/// A law whose level at rest is higher than while sliding.
struct Sticky {
  static constexpr bool constant_while_sliding = true;
  double hold(double, Direction) const { return 1.5; }
  template <class T>
  double resist(const T&, Direction) const {
    return 1;
  }
};

constexpr double pi = std::numbers::pi;

/// The orbit of that amplitude, or one of amplitude NaN.
Orbit orbit_near(const std::vector<Orbit>& found, double amplitude) {
  Orbit none{};
  none.amplitude = not_a_number;
  for (const Orbit& orbit : found)
    if (std::abs(orbit.amplitude - amplitude) <= 1e-3 * amplitude) none = orbit;
  return none;
}

double angle_between(double a, double b) { return std::abs(std::remainder(a - b, 2 * pi)); }

double largest_multiplier(const Orbit& orbit) { return std::abs(orbit.half_period_multipliers[0]); }

std::complex<double> determinant(const Orbit& orbit) {
  return orbit.half_period_multipliers[0] * orbit.half_period_multipliers[1];
}

/// All that a law may be written with.
struct Formula {
  template <class T>
  auto resist(const T& x, Direction) const {
    using std::exp, std::log, std::pow, std::sqrt, std::sin, std::cos, std::sinh, std::cosh, std::tanh;
    return 2 + exp(-x) * sin(x) / (1.5 + cos(x)) - log(x + 1) + pow(x, 1.3) * sqrt(x) + 0.1 * sinh(x) / cosh(x) -
           (1 - tanh(x)) * (-x) / 3 + 1 / (2 - 0.1 * x) + (x - 0.5) * sech(x);
  }
};

/// The motion of an orbit from t = 0 on.
template <class S>
Response along(const S& slider, const Orbit& orbit, double periods, double samples_a_period = 64) {
  return integrate(slider,
                   HarmonicMotion(orbit.load, orbit.omega, periods * orbit.period(), orbit.period() / samples_a_period),
                   from(orbit.state.displacement, orbit.state.velocity));
}

}  // namespace

TEST_CASE("a block has the exact orbit in closed form", "[orbits]") {
  for (const auto& row : reference::rows("harmonic", "coulomb"))
    for (const double omega : {0.5, 1.0, 20.0}) {
      const double amplitude = row["amplitude"], exact = row["exact"];
      const bool stops = row["stops"].as<bool>();
      INFO("B " << amplitude << ", omega " << omega);
      const auto found = orbits(Coulomb(1), amplitude, omega);
      REQUIRE(found.size() == 1);
      const Orbit& orbit = found[0];
      CHECK(std::abs(orbit.amplitude * omega * omega - exact) <= 2e-14 * exact);
      CHECK(orbit.stops_per_cycle == (stops ? 2 : 0));
      CHECK(orbit.reversals_per_cycle == (stops ? 0 : 2));
      CHECK(orbit.stable);
      CHECK(orbit.mean_arbitrary);
      CHECK(std::abs(orbit.multipliers[0] - 1.0) <= 1e-14);  // wherever it is put
      if (!stops) {
        // ERRATA (2.14), (2.17): sin(phase) = -pi a / 2 B, in the third quadrant; the reversal's x'' jumps from
        // -(root - 1) a to -(root + 1) a, root = sqrt(B^2/a^2 - pi^2/4).
        CHECK(std::abs(orbit.phase - (-pi + std::asin(pi / 2 / amplitude))) <= 1e-14);
        const double root = std::sqrt(amplitude * amplitude - pi * pi / 4);
        CHECK(std::abs(determinant(orbit).real() - (root - 1) / (root + 1)) <= 1e-13);
      } else {
        CHECK(orbit.multipliers[1] == 0.0);
      }
    }
}

TEST_CASE("a block changes from two stops a cycle to none at B/a = sqrt(1 + pi^2/4)", "[orbits]") {
  const double limit = std::sqrt(1 + pi * pi / 4);
  const Orbit below = orbits(Coulomb(3), 3 * limit * (1 - 1e-6), 2)[0];
  const Orbit above = orbits(Coulomb(3), 3 * limit * (1 + 1e-6), 2)[0];
  CHECK(below.stops_per_cycle == 2);
  CHECK(above.stops_per_cycle == 0);
  CHECK(std::abs(below.amplitude - 3.0 / 4) <= 1e-5);  // A omega^2 = a there
  CHECK(std::abs(above.amplitude - 3.0 / 4) <= 1e-5);
}

TEST_CASE("below the slip level there is nothing but rest", "[orbits]") {
  for (const double load : {1e-3, 0.9, 1.0})
    for (const double frequency : {0.0, 0.7}) {
      const auto found = orbits(Slider(Coulomb(1), frequency), load, 1.3);
      REQUIRE(found.size() == 1);
      CHECK(found[0].at_rest());
      CHECK(found[0].stable);
      CHECK(std::isnan(found[0].phase));
      CHECK(found[0].events.empty());
      CHECK(found[0].stops_per_cycle == 0);
    }
  CHECK(orbits(Caster(1, 1), 1.0, 0.3)[0].at_rest());
  CHECK_FALSE(orbits(Caster(1, 1), 1.01, 0.8)[0].at_rest());
}

TEST_CASE("a block on a spring has Den Hartog's orbit, or one that stops", "[orbits]") {
  for (const auto& row : reference::rows("harmonic", "spring")) {
    const double load = row["amplitude"], omega = row["omega"], simulated = row["simulated"],
                 den_hartog = row["den_hartog"];
    INFO("B " << load << ", omega " << omega);
    const auto found = orbits(Slider(Coulomb(1), std::sqrt(0.5)), load, omega);
    REQUIRE(found.size() == 1);
    CHECK(std::abs(found[0].amplitude - simulated) <= 1e-8);
    CHECK((found[0].stops_per_cycle == 0) == (den_hartog > 0));
    if (den_hartog > 0) CHECK(std::abs(found[0].amplitude - den_hartog) <= 1e-13 * den_hartog);
    CHECK(found[0].stable);
    CHECK_FALSE(found[0].mean_arbitrary);
  }
}

TEST_CASE("constant friction has one orbit, whose halves stop alike", "[orbits]") {
  std::mt19937_64 bits(3);
  std::uniform_real_distribution<double> part(0, 1);
  // two that were found twice, the second time with a stop too many, from a rest with round-off of a velocity
  std::vector<std::array<double, 3>> cases = {{1.9882720218432965, 0.16585680510174611, 0.47424230716740123},
                                              {1.0077665593970109, 1.0931175142157781, 1.3301069367073015}};
  for (int i = 0; i < 200; ++i) {
    const double load = 1.001 + 1.5 * part(bits), omega = 0.1 + 2 * part(bits);
    cases.push_back({load, omega, i % 3 == 0 ? 0 : 0.2 + 1.5 * part(bits)});
  }
  for (const auto& [load, omega, natural_frequency] : cases) {
    INFO("B " << load << ", omega " << omega << ", wn " << natural_frequency);
    const auto found = orbits(Slider(Coulomb(1), natural_frequency), load, omega);
    REQUIRE(found.size() == 1);
    CHECK(found[0].stops_per_cycle % 2 == 0);
    CHECK(found[0].reversals_per_cycle % 2 == 0);
  }
}

TEST_CASE("at resonance a block on a spring has no orbit once B passes 4 a/pi", "[orbits]") {
  const Slider slider(Coulomb(1), 1.0);
  CHECK(orbits(slider, 1.3, 1).empty());
  CHECK(orbits(slider, 2, 1).empty());
  // below: values.json harm.resonance, bounded by 0.1638 at B/a = 1.2 from rest, which that orbit is reached from
  const auto bounded = orbits(slider, 1.2, 1);
  REQUIRE(bounded.size() == 1);
  CHECK(std::abs(bounded[0].amplitude - 0.1638) <= 1e-3);
  // Next to it, slowly varying parameters are exact: A |wn^2 - omega^2| = sqrt(B^2 - (4 a/pi)^2), (2.48); the error is
  // of the order of the detuning.
  for (const double detuning : {1e-4, -1e-4}) {
    const Orbit near = orbits(slider, 2, 1 + detuning)[0];
    const double expected = std::sqrt(4 - 16 / (pi * pi)) / std::abs(1 - (1 + detuning) * (1 + detuning));
    CHECK(std::abs(near.amplitude / expected - 1) <= 1e-3);
  }
}

TEST_CASE("without friction the orbit is the linear response", "[orbits]") {
  for (const double frequency : {0.0, 0.4, 3.0}) {
    const Orbit orbit = orbits(Slider(Coulomb(0), frequency), 2, 1.3)[0];
    const double linear = 2 / (frequency * frequency - 1.3 * 1.3);
    CHECK(std::abs(orbit.amplitude - std::abs(linear)) <= 1e-14 * std::abs(linear));
    CHECK(angle_between(orbit.phase, linear > 0 ? 0 : pi) <= 1e-14);
    for (const auto& m : orbit.multipliers) CHECK(std::abs(std::abs(m) - 1) <= 1e-7);  // a double root without a spring
  }
  for (const double frequency : {0.0, 0.4, 3.0}) {  // found by searching too
    const auto found = orbits(Slider(Caster(0, 1), frequency), 2, 1.3);
    REQUIRE(found.size() == 1);
    CHECK(std::abs(found[0].amplitude - std::abs(2 / (frequency * frequency - 1.3 * 1.3))) <= 1e-12);
  }
  // and with friction it is so when B is much larger: (2.24), A^2 = (B^2 - (4 a/pi)^2) / omega^4 but for terms (a/B)^2
  // of 16/pi^2 - pi^2/4 = 0.85
  const Orbit strong = orbits(Coulomb(1), 1e4, 1)[0];
  CHECK(std::abs(strong.amplitude / 1e4 - 1) <= 2e-8);
}

TEST_CASE("a caster's orbits are those of the reference, stable or not", "[orbits]") {
  // values.json orbit.caster.*: to 1e-9, the multipliers to the six digits given, the determinant to its own noise.
  for (const auto& c : reference::rows("harmonic", "casters")) {
    INFO("wn^2 " << c["stiffness"] << ", B " << c["load"] << ", omega " << c["omega"] << ", A " << c["amplitude"]);
    const auto found = orbits(Slider(Caster(1, 1), std::sqrt(c["stiffness"])), c["load"], c["omega"]);
    const Orbit orbit = orbit_near(found, c["amplitude"]);
    CHECK(std::abs(orbit.amplitude - c["amplitude"]) <= 1e-9 * c["amplitude"]);
    CHECK(angle_between(orbit.phase, c["phase"]) <= 1e-9);
    const std::complex<double> m = orbit.half_period_multipliers[0];
    CHECK(std::abs(m - std::complex<double>(c["multiplier_re"], std::copysign(c["multiplier_im"], m.imag()))) <= 1e-6);
    CHECK(std::abs(determinant(orbit) - double{c["determinant"]}) <= 1e-8);
    CHECK(orbit.stable == (std::hypot(c["multiplier_re"], c["multiplier_im"]) < 1 + 1e-6));
    CHECK(std::ranges::is_sorted(found, {}, &Orbit::amplitude));
  }
}

TEST_CASE("a small load on a caster makes a small orbit that stops around the middle", "[orbits]") {
  // ERRATA, text before (2.36); values.json harm.caster.b1.25.W0.7 and .W0.75, simulated for 400 cycles
  const auto found = orbits(Caster(1, 1), 1.25, 0.7), faster = orbits(Caster(1, 1), 1.25, 0.75);
  const Orbit small = orbit_near(found, 0.2914);
  CHECK(std::abs(small.amplitude - 0.2913861550850907) <= 1e-9);
  CHECK(small.stable);
  CHECK(small.stops_per_cycle == 2);
  CHECK(found.size() == 3);  // next to the fold at 0.7035
  REQUIRE(faster.size() == 1);
  CHECK(std::abs(faster[0].amplitude - 0.23894264531887136) <= 1e-9);
}

TEST_CASE("integrate stays on an orbit, half a period later mirrored", "[orbits]") {
  const auto stays = [](const auto& slider, double load, double omega) {
    for (const Orbit& orbit : orbits(slider, load, omega)) {
      if (orbit.at_rest()) continue;
      INFO("B " << load << ", omega " << omega << ", A " << orbit.amplitude);
      const Response r = along(slider, orbit, 1);
      // What the state at t = 0 is rounded by, 1e-15, or was missed by in the shooting, 1e-13, grows by the
      // multipliers.
      const double growth = std::max(1.0, std::norm(largest_multiplier(orbit)));
      double error = 0;
      for (std::size_t i = 0; i <= 32; ++i)
        error = std::max(error, std::abs(r.displacement[i] + r.displacement[i + 32]));
      CHECK(error <= 4e-13 * growth * orbit.amplitude);
      CHECK(std::abs(r.residual - orbit.state.displacement) <= 4e-13 * growth * orbit.amplitude);
      // in a cycle the ground supplies the energy that friction dissipates
      CHECK(std::abs(r.energy.input - r.energy.dissipated) <= 1e-12 * growth * load * r.sliding_distance);
      CHECK(std::abs(orbit.dissipated - r.energy.dissipated) <= 1e-12 * growth * load * r.sliding_distance);
      // and x cos + x' sin ... : it is at its highest where the phase says
      const double high = std::remainder(-orbit.phase, 2 * pi) / omega;
      const Response there = integrate(slider, HarmonicMotion(load, omega, high > 0 ? high : high + orbit.period()),
                                       from(orbit.state.displacement, orbit.state.velocity));
      CHECK(std::abs(there.residual - orbit.amplitude) <= 1e-12 * growth * orbit.amplitude);
    }
  };
  for (const double load : {1.05, 1.5, 3.0})
    for (const double omega : {0.13, 0.7, 2.0}) {
      for (const double frequency : {0.0, 0.8}) {
        stays(Slider(Coulomb(1), frequency), load, omega);
        stays(Slider(Caster(1, 0.8), frequency), load, omega);
      }
    }
  stays(Slider(Bump{1, 0.8}), 1.5, 0.9);
  stays(Slider(Disguised{1}, 0.8), 1.5, 0.9);
}

TEST_CASE("the steady state of integrate is among the orbits", "[orbits]") {
  // Coulomb friction on a spring: whatever the motion before, it comes to the one orbit; slowly springs first stop many
  // times a cycle.
  std::mt19937_64 bits(21);
  std::uniform_real_distribution<double> unit;
  for (int i = 0; i < 30; ++i) {
    const double load = 1.02 + 3 * unit(bits) * unit(bits), omega = std::exp(4 * unit(bits) - 3);
    const Slider slider(Coulomb(1), 1.0);
    INFO("B " << load << ", omega " << omega);
    const auto found = orbits(slider, load, omega);
    REQUIRE(found.size() == 1);
    if (largest_multiplier(found[0]) > 0.97) continue;  // 400 cycles are too few
    const HarmonicMotion motion(load, omega, 400 * 2 * pi / omega);
    const Response r = integrate(slider, motion, from(0.3));
    double low = infinity, high = -infinity;
    int stops = 0;
    for (const Event& e : r.events)
      if (e.time > motion.duration() - 10 * motion.period()) {
        low = std::min(low, e.displacement), high = std::max(high, e.displacement);
        stops += e.kind == EventKind::arrest;
      }
    CHECK(std::abs((high - low) / 2 - found[0].amplitude) <= 1e-9 * found[0].amplitude);
    CHECK(stops == 10 * found[0].stops_per_cycle);
  }
}

TEST_CASE("a small change of the state dies out, or grows, as the multipliers say", "[orbits]") {
  // Differences of two motions that differ by 1e-6 at first: the ratio is known to the curvature of the map, some 1e-5.
  const auto matches = [](const auto& slider, double load, double omega) {
    for (const Orbit& orbit : orbits(slider, load, omega)) {
      if (orbit.at_rest() || orbit.stops_per_cycle > 0) continue;
      INFO("B " << load << ", omega " << omega << ", A " << orbit.amplitude);
      const auto end = [&](double dx, double dv) {
        const Response r = integrate(slider, HarmonicMotion(load, omega, orbit.period()),
                                     from(orbit.state.displacement + dx, orbit.state.velocity + dv));
        return std::array{r.residual, r.state.velocity};
      };
      const double dx = 1e-6 * orbit.amplitude, dv = dx * omega;
      std::array<std::array<double, 2>, 2> change;
      for (std::size_t i = 0; i < 2; ++i) {
        const auto up = end(i == 0 ? dx : 0, i == 1 ? dv : 0), down = end(i == 0 ? -dx : 0, i == 1 ? -dv : 0);
        for (std::size_t k = 0; k < 2; ++k) change[k][i] = (up[k] - down[k]) / (2 * (i == 0 ? dx : dv));
      }
      const std::complex<double> sum = orbit.multipliers[0] + orbit.multipliers[1],
                                 product = orbit.multipliers[0] * orbit.multipliers[1];
      const double scale = std::norm(largest_multiplier(orbit)) + 1;
      CHECK(std::abs(change[0][0] + change[1][1] - sum) <= 1e-5 * scale);
      CHECK(std::abs(change[0][0] * change[1][1] - change[0][1] * change[1][0] - product) <= 1e-5 * scale);
    }
  };
  matches(Slider(Coulomb(1)), 3, 1.3);
  matches(Slider(Coulomb(1), 0.8), 3, 1.3);
  matches(Slider(Caster(1, 1)), 1, 0.5);
  matches(Slider(Caster(1, 1), std::sqrt(0.5)), 2, 0.3);
  matches(Slider(Bump{1, 0.8}, 0.5), 2, 1.1);
}

TEST_CASE("an orbit scales with the load, the slip level and the time", "[orbits]") {
  // x scales with a / omega^2, B/a and omega^2 reach / a kept (2.35)
  const double strong = 3, slow = 0.7, far = strong / (slow * slow);
  const auto one = orbits(Slider(Caster(1, 0.8), 0.5), 1.5, 0.9);
  const auto other = orbits(Slider(Caster(strong, 0.8 * far), 0.5 * slow), 1.5 * strong, 0.9 * slow);
  REQUIRE(one.size() == other.size());
  for (std::size_t i = 0; i < one.size(); ++i) {
    CHECK(std::abs(other[i].amplitude - far * one[i].amplitude) <= 1e-12 * other[i].amplitude);
    CHECK(angle_between(other[i].phase, one[i].phase) <= 1e-12);
    CHECK(std::abs(other[i].multipliers[0] - one[i].multipliers[0]) <= 1e-10);
  }
  for (const double scale : {1e-80, 1e90}) {
    const auto extreme = orbits(Slider(Coulomb(scale), 0.8), 1.5 * scale, 0.9);
    REQUIRE(extreme.size() == 1);
    const double usual = orbits(Slider(Coulomb(1), 0.8), 1.5, 0.9)[0].amplitude;
    CHECK(std::abs(extreme[0].amplitude / scale - usual) <= 1e-12 * usual);
  }
}

TEST_CASE("a caster of a long reach has the orbit of a block", "[orbits]") {
  // level = a (1 - (A / reach)^2 / 2 ...): with a reach of 1e6 a part of 1e-12
  for (const double load : {1.3, 3.0}) {
    const auto block = orbits(Slider(Coulomb(1), 0.5), load, 1.3),
               caster = orbits(Slider(Caster(1, 1e6), 0.5), load, 1.3);
    REQUIRE(caster.size() == 1);
    CHECK(std::abs(caster[0].amplitude - block[0].amplitude) <= 1e-11 * block[0].amplitude);
    CHECK(std::abs(largest_multiplier(caster[0]) - largest_multiplier(block[0])) <= 1e-10);
  }
}

TEST_CASE("a slow load on a stiff spring is followed through all its swings", "[orbits]") {
  // wn / omega = 5.8, B >> a: orbits are close to linear ones, within a/wn^2, and turn where they are about to stop.
  const double load = 32.04, omega = 0.1593, frequency = 0.9179;
  const double block = orbits(Slider(Coulomb(1), frequency), load, omega).at(0).amplitude;
  for (const double reach : {1e7, 1e3, 500.0, 245.0, 100.0}) {
    INFO("reach " << reach);
    const auto found = orbits(Slider(Caster(1, reach), frequency), load, omega);
    REQUIRE(found.size() == 1);
    CHECK(std::abs(found[0].amplitude - block) <= 2 * block * block / (reach * reach));
    CHECK(found[0].stable);
  }
}

TEST_CASE("continuation goes round the caster's fold and meets what orbits finds", "[orbits][continuation]") {
  const Slider slider(Caster(1, 1));
  const auto start = orbits(slider, 1, 0.5);
  const OrbitBranch branch = continuation(slider, start.back(), 0.2, 2);
  REQUIRE(branch.folds.size() == 1);
  const Orbit& fold = branch.orbits[branch.folds[0]];
  CHECK(std::abs(fold.half_period_multipliers[0] - 1.0) <= 1e-5);
  for (const Orbit& orbit : branch.orbits) {
    CHECK(orbit.omega <= fold.omega * (1 + 1e-10));
    if (std::abs(orbit.omega / fold.omega - 1) > 1e-3) CHECK(orbit.stable == (orbit.amplitude > fold.amplitude));
  }
  // both ends are at the lowest frequency
  const auto low = orbits(slider, 1, 0.2);
  for (const Orbit& end : {branch.orbits.front(), branch.orbits.back()}) {
    CHECK(end.omega == Approx(0.2).epsilon(1e-14));
    CHECK(std::abs(orbit_near(low, end.amplitude).amplitude - end.amplitude) <= 1e-9 * end.amplitude);
  }
  // next to the fold two orbits, beyond it none but the rest
  CHECK(orbits(slider, 1, fold.omega * 0.999).size() == 3);
  CHECK(orbits(slider, 1, fold.omega * 1.001).size() == 1);
  // begun on the other side it finds the same fold, to the square root of a rounding and better
  const OrbitBranch other = continuation(slider, start[1], 0.2, 2);
  REQUIRE(other.folds.size() == 1);
  CHECK(std::abs(other.orbits[other.folds[0]].omega - fold.omega) <= 1e-9);
}

TEST_CASE("continuation follows the closed form of a block", "[orbits][continuation]") {
  const OrbitBranch branch = continuation(Coulomb(1), orbits(Coulomb(1), 3, 1)[0], 0.5, 2);
  CHECK(branch.folds.empty());
  CHECK(branch.orbits.size() > 20);
  const double exact = std::sqrt(9 - pi * pi / 4);
  for (const Orbit& orbit : branch.orbits)
    CHECK(std::abs(orbit.amplitude * orbit.omega * orbit.omega - exact) <= 1e-12 * exact);
  CHECK(std::ranges::is_sorted(branch.orbits, {}, &Orbit::omega));
  CHECK(branch.orbits.front().omega == Approx(0.5).epsilon(1e-14));
  CHECK(branch.orbits.back().omega == Approx(2).epsilon(1e-14));
}

TEST_CASE("continuation goes from Den Hartog's orbits to those that stop", "[orbits][continuation]") {
  const Slider slider(Coulomb(1), std::sqrt(0.5));
  ContinuationOptions options;
  options.max_amplitude = 100;
  const OrbitBranch branch = continuation(slider, orbits(slider, 1.3, 2)[0], 0.1, 3, options);
  CHECK(branch.orbits.front().amplitude > 80);  // towards resonance
  int calls = 0;
  options.progress = [&] {
    if (++calls == 5) throw std::runtime_error("enough");
  };
  CHECK_THROWS_WITH(continuation(slider, branch.orbits[0], 0.1, 3, options), "enough");
  std::size_t stopping = 0;
  for (std::size_t i = 0; i < branch.orbits.size(); i += 10) {
    const Orbit& orbit = branch.orbits[i];
    stopping += orbit.stops_per_cycle > 0;
    const auto found = orbits(slider, 1.3, orbit.omega);
    REQUIRE(found.size() == 1);
    CHECK(std::abs(found[0].amplitude - orbit.amplitude) <= 1e-9 * orbit.amplitude);
  }
  CHECK(stopping > 3);
}

TEST_CASE("a block of unequal levels on a spring does not drift: it swings about another place", "[orbits]") {
  const Slider slider(Coulomb(1, 1.6), 0.7);
  const std::vector<Orbit> found = orbits(slider, 3, 1);
  REQUIRE(found.size() == 1);
  const Orbit& orbit = found[0];
  CHECK(orbit.center == Approx(0.3 / 0.49).epsilon(1e-14));
  CHECK(orbit.state.displacement == Approx(-3.20727285142).epsilon(1e-11));  // by another program, at every period
  CHECK(orbit.stable);
  CHECK(!orbit.mean_arbitrary);
  // It is the orbit of the mean level, moved; what friction takes is what the mean level takes on the way both ways.
  const Orbit mean = orbits(Slider(Coulomb(1.3), 0.7), 3, 1)[0];
  CHECK(orbit.amplitude == mean.amplitude);
  CHECK(orbit.dissipated == mean.dissipated);
  CHECK(orbit.state.displacement - orbit.center == Approx(mean.state.displacement).epsilon(1e-14));
  // `integrate` stays on it, and comes to it from rest.
  const double period = orbit.period();
  const HarmonicMotion motion(3, 1, 200 * period, period / 64);
  const Response stays = integrate(slider, motion,
                                   {.displacement = orbit.state.displacement, .velocity = orbit.state.velocity}),
                 comes = integrate(slider, motion);
  const std::size_t last = stays.displacement.size() - 1;
  CHECK(stays.displacement[last] == Approx(orbit.state.displacement).epsilon(1e-9));
  CHECK(comes.displacement[last] == Approx(orbit.state.displacement).epsilon(1e-9));
  // Half a period later it is as far on the other side of the center.
  const std::vector<State> states = states_at(slider, orbit, {0.3, 0.3 + period / 2});
  CHECK(states[0].displacement - orbit.center == Approx(orbit.center - states[1].displacement).epsilon(1e-11));
  CHECK(states[0].velocity == Approx(-states[1].velocity).epsilon(1e-11));
  // The branch holds the orbits that are found one by one.
  const OrbitBranch branch = continuation(slider, orbit, 0.95, 1.05);
  REQUIRE(branch.orbits.size() > 2);
  for (const Orbit& other : branch.orbits) {
    const Orbit alone = orbits(slider, 3, other.omega)[0];
    CHECK(other.center == Approx(orbit.center).epsilon(1e-14));
    CHECK(other.amplitude == Approx(alone.amplitude).epsilon(1e-9));
    CHECK(other.state.displacement == Approx(alone.state.displacement).epsilon(1e-9));
  }
  // A weak load lets it rest: at the center, among other places.
  const Orbit rest = orbits(slider, 1.2, 1)[0];
  CHECK(rest.at_rest());
  CHECK(rest.center == orbit.center);
  CHECK(states_at(slider, rest, {1.0})[0].displacement == orbit.center);
  CHECK_THROWS_WITH(orbits(Slider(Coulomb(1, infinity), 0.7), 3, 1), ContainsSubstring("finite alone"));
}

TEST_CASE("orbits and continuation name what they refuse", "[orbits][errors]") {
  for (const double bad : {not_a_number, infinity, -1.0, 0.0}) {
    CHECK_THROWS_AS(orbits(Coulomb(1), bad, 1), std::invalid_argument);
    CHECK_THROWS_AS(orbits(Coulomb(1), 1, bad), std::invalid_argument);
  }
  CHECK_THROWS_WITH(orbits(Coulomb(1), -1, 1), "orbits: B must be positive and at most 1e100 m/s^2, got -1 m/s^2");
  CHECK_THROWS_WITH(orbits(Coulomb(1, 1.5), 2, 1), ContainsSubstring("else the slider drifts, got 1.5 m/s^2"));
  CHECK_THROWS_WITH(orbits(Slider(Coulomb(1), 2, 0.5), 2, 1), ContainsSubstring("damping must be 0, got 0.5 1/s"));
  CHECK_THROWS_WITH(orbits(Slider(Sticky(), 3), 1.2, 2), ContainsSubstring("it must hold 1 m/s^2, got 1.5 m/s^2"));
  CHECK_THROWS_WITH(orbits(Coulomb(1, infinity), 2, 1), ContainsSubstring("else the slider drifts"));
  const Orbit orbit = orbits(Coulomb(1), 3, 1)[0], rest = orbits(Coulomb(1), 0.5, 1)[0];
  CHECK_THROWS_WITH(continuation(Coulomb(1), rest, 0.5, 2), ContainsSubstring("must move"));
  CHECK_THROWS_WITH(continuation(Coulomb(1), orbit, 1.5, 2), ContainsSubstring("low must be positive and at most"));
  CHECK_THROWS_AS(continuation(Coulomb(1), orbit, 0.5, 0.9), std::invalid_argument);
  CHECK_THROWS_AS(continuation(Coulomb(1), orbit, not_a_number, 2), std::invalid_argument);
  CHECK_THROWS_AS(continuation(Coulomb(1), orbit, 0.5, infinity), std::invalid_argument);
  ContinuationOptions options;
  options.max_step = 0;
  CHECK_THROWS_WITH(continuation(Coulomb(1), orbit, 0.5, 2, options), ContainsSubstring("max_step"));
}

TEST_CASE("a law's slope is the derivative of its level, by whatever functions it is written", "[orbits][dual]") {
  // Against central differences with a step of 1e-5: 1e-10 of the third derivative, and 1e-11 of rounding.
  const auto differentiates = [](const auto& law) {
    for (const double x : {0.3, 0.7, 1.9}) {
      series::Coefficients series;
      series[0] = x;
      auto slope = series::slope_of(law.resist(series::variable(series), Direction::forward));
      slope.update(0);
      const double h = 1e-5,
                   difference =
                       (law.resist(x + h, Direction::forward) - law.resist(x - h, Direction::forward)) / (2 * h);
      CHECK(std::abs(slope[0] - difference) <= 1e-8);
    }
  };
  differentiates(Formula{});
  differentiates(Caster(2, 0.7));
  differentiates(Bump{1, 0.5});
  differentiates(Disguised{1});
}
