// Structures by linear steps move as by power series, also near events.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <limits>
#include <memory>
#include <random>
#include <vector>

#include "stickslip/core.hpp"
#include "stickslip/structure/equipment_on_floor.hpp"
#include "stickslip/structure/isolated_structure.hpp"
#include "support/catch.hpp"

using namespace stickslip;

namespace {

using Bits = std::mt19937_64;

double uniform(Bits& bits, double low, double high) { return std::uniform_real_distribution(low, high)(bits); }

struct Problem {
  std::vector<double> n;
  double dt;
};

// Long enough for matrices to pay, and the same with uneven times, whose segments are expanded one by one.
constexpr std::size_t calm = 300;
GroundMotion even(const Problem& of) {
  std::vector<double> n = of.n;
  n.resize(n.size() + calm);
  return GroundMotion(n, of.dt);
}
GroundMotion uneven(const Problem& of) {
  std::vector<double> n = of.n, times;
  n.resize(n.size() + calm - 1);
  for (std::size_t i = 0; i < n.size(); ++i) times.push_back(static_cast<double>(i) * of.dt);
  times.back() += of.dt;
  return GroundMotion(n, times);
}

Structure random_structure(Bits& bits, int modes, bool shapes) {
  std::vector<double> masses, stiffnesses, fractions, frequencies, ratios;
  const double damping = uniform(bits, 0, 1) < 0.2 ? 0 : uniform(bits, 0, 0.1);
  if (shapes) {
    for (int j = 0; j < modes; ++j)
      masses.push_back(uniform(bits, 0.5, 2)), stiffnesses.push_back(uniform(bits, 200, 4000));
    return Structure::shear_building(masses, stiffnesses, damping);
  }
  double frequency = uniform(bits, 5, 40);
  for (int j = 0; j < modes; ++j) {
    fractions.push_back(0.8 / ((j + 1) * (j + 2)));
    frequencies.push_back(frequency);
    ratios.push_back(damping);
    frequency *= uniform(bits, 1.2, 2.2);
  }
  return Structure::from_modes(fractions, frequencies, ratios);
}

void compare(const SlidingStructure& system, const Problem& problem, double tolerance) {
  const StructureResponse fast = integrate(system, even(problem)), slow = integrate(system, uneven(problem));
  const std::size_t samples = problem.n.size();
  const double scale = std::max(slow.sliding_distance, 1e-6);
  REQUIRE(fast.events.size() == slow.events.size());
  for (std::size_t i = 0; i < fast.events.size(); ++i) {
    CHECK(fast.events[i].kind == slow.events[i].kind);
    CHECK(std::abs(fast.events[i].displacement - slow.events[i].displacement) <= tolerance * scale);
  }
  double most = 0, size = 0;
  for (std::size_t i = 0; i < samples; ++i) {
    most = std::max(most, std::abs(fast.displacement[i] - slow.displacement[i]));
    size = std::max(size, std::abs(slow.interface_demand[i]));
  }
  CHECK(most <= tolerance * scale);
  double apart = 0;
  for (std::size_t i = 0; i < samples; ++i)
    apart = std::max(apart, std::abs(fast.interface_demand[i] - slow.interface_demand[i]));
  CHECK(apart <= tolerance * size);
  const auto close = [&](double a, double b, double of) { CHECK(std::abs(a - b) <= tolerance * std::max(of, 1e-9)); };
  close(fast.peak, slow.peak, scale);
  close(fast.sliding_distance, slow.sliding_distance, scale);
  close(fast.time_sliding, slow.time_sliding, problem.dt * static_cast<double>(samples));
  const double energy = std::abs(slow.energy.input) + slow.energy.dissipated + slow.energy.damped;
  close(fast.energy.input, slow.energy.input, energy);
  close(fast.energy.damped, slow.energy.damped, energy);
  close(fast.energy.dissipated, slow.energy.dissipated, energy);
  close(fast.energy.impact, slow.energy.impact, energy);
  close(fast.peak_base_shear, slow.peak_base_shear, slow.peak_base_shear);
  close(fast.peak_base_acceleration, slow.peak_base_acceleration, slow.peak_base_acceleration);
  for (std::size_t i = 0; i < slow.floors.peak_acceleration.size(); ++i)
    close(fast.floors.peak_acceleration[i], slow.floors.peak_acceleration[i], slow.floors.peak_acceleration[i]);
  for (std::size_t i = 0; i < slow.floors.peak_drift.size(); ++i)
    close(fast.floors.peak_drift[i], slow.floors.peak_drift[i], slow.floors.peak_drift[i]);
}

Problem random_problem(Bits& bits, std::size_t samples = 150) {
  std::normal_distribution<> normal(0, 2);
  Problem problem{{}, std::exp(uniform(bits, std::log(0.002), std::log(0.08)))};
  double strength = 1;
  for (std::size_t i = 0; i < samples; ++i) {
    if (i % 20 == 0) strength = uniform(bits, 0, 1) < 0.3 ? 0.1 : 1;
    problem.n.push_back(strength * normal(bits));
  }
  return problem;
}

using Make = std::function<std::unique_ptr<SlidingStructure>(double level)>;

Make random_system(Bits& bits) {
  const int modes = static_cast<int>(uniform(bits, 1, 6));
  const bool shapes = uniform(bits, 0, 1) < 0.6, floor = shapes && uniform(bits, 0, 1) < 0.4;
  const Structure structure = random_structure(bits, modes, shapes);
  Mounting mounting;
  if (uniform(bits, 0, 1) < 0.4) mounting.natural_frequency = uniform(bits, 1, 10);
  if (uniform(bits, 0, 1) < 0.3) mounting.damping = uniform(bits, 0, 1);
  if (uniform(bits, 0, 1) < 0.2) mounting.stops = Stops(uniform(bits, 0.01, 0.1), 0);
  const double backward = uniform(bits, 0, 1) < 0.2 ? std::numeric_limits<double>::infinity() : uniform(bits, 0.5, 2);
  const double above = uniform(bits, 1, 1.3);
  const double mass = uniform(bits, 0, 1) < 0.3 ? 0 : uniform(bits, 0.1, 1);
  const bool decoupled = uniform(bits, 0, 1) < 0.2;
  return [=](double level) -> std::unique_ptr<SlidingStructure> {
    const StaticKinetic law(Coulomb(level, backward * level), above * level, above * backward * level);
    const AnySlider slider = Slider<StaticKinetic<Coulomb>>(law, mounting);
    if (floor) return std::make_unique<EquipmentOnFloor>(slider, structure, 1, mass);
    if (decoupled && shapes) return std::make_unique<DecoupledStructure>(slider, structure, mass + 0.1);
    if (decoupled) return std::make_unique<DecoupledStructure>(slider, structure);
    if (shapes) return std::make_unique<IsolatedStructure>(slider, structure, mass + 0.1);
    return std::make_unique<IsolatedStructure>(slider, structure);
  };
}

}  // namespace

TEST_CASE("a structure moves by linear steps as by power series", "[structure][long]") {
  Bits bits(1);
  int compared = 0;
  for (int i = 0; i < 1000; ++i) {
    CAPTURE(i);
    const Problem problem = random_problem(bits);
    const Make make = random_system(bits);
    const double level = std::exp(uniform(bits, std::log(0.01), std::log(10)));
    // Some are chaotic: they bounce on stops, or vibrate hardly damped.
    const GroundMotion motion = uneven(problem);
    const StructureResponse one = integrate(*make(level), motion),
                            other = integrate(*make(level * (1 + 1e-13)), motion);
    if (std::abs(one.residual - other.residual) > 1e-11 * one.sliding_distance) continue;
    ++compared;
    compare(*make(level), problem, 1e-9);
  }
  CHECK(compared > 950);
}

TEST_CASE("linear steps miss no event that barely occurs, and add none that barely does not", "[structure][long]") {
  Bits bits(2);
  int found = 0;
  for (int i = 0; i < 300; ++i) {
    CAPTURE(i);
    const Problem problem = random_problem(bits, 100);
    const Make make = random_system(bits);
    const GroundMotion motion = uneven(problem);
    const auto events = [&](double level) { return integrate(*make(level), motion).events.size(); };
    // A level beside which the number of events differs: there a load just reaches it, or a speed just reaches zero.
    double low = std::exp(uniform(bits, std::log(0.05), std::log(5))), high = low * uniform(bits, 1.01, 1.3);
    const std::size_t count = events(low);
    if (events(high) == count) continue;
    while (high - low > 1e-9 * high) {
      const double middle = (low + high) / 2;
      (events(middle) == count ? low : high) = middle;
    }
    ++found;
    for (const double level : {low, high}) compare(*make(level), problem, 1e-7);
  }
  CHECK(found > 150);
}
