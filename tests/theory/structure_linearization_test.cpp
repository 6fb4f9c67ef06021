// Equivalent linearization of structures with a sliding interface: limits, the stationary solution, refusals. An
// independent integration in physical coordinates is in tests/python/test_structure_linearization.py.
#include <algorithm>
#include <cmath>
#include <vector>

#include "stickslip/excitation/gaussian.hpp"
#include "stickslip/structure/equipment_on_floor.hpp"
#include "stickslip/structure/isolated_structure.hpp"
#include "stickslip/theory/equivalent_linearization.hpp"
#include "support/catch.hpp"

using namespace stickslip;
using Catch::Matchers::ContainsSubstring;
using theory::EquivalentLinearization;
using Force = EquivalentLinearization::Force;

namespace {

Structure one_mode(double fraction, double frequency) { return Structure::from_modes({fraction}, {frequency}, {0.05}); }

const Spectrum soil = Spectrum::kanai_tajimi(0.02, 12, 0.6);
const std::vector<double> times{1, 4, 16};

double relative(double found, double value) { return std::abs(found / value - 1); }

/// Largest relative distance of the second moments and, if they are not 0, of the means.
double apart(const Moments& a, const Moments& b) {
  double most = 0;
  for (std::size_t i = 0; i < a.time.size(); ++i) {
    most = std::max({most, relative(a.displacement_variance.value[i], b.displacement_variance.value[i]),
                     relative(a.velocity_variance.value[i], b.velocity_variance.value[i])});
    if (std::abs(b.velocity_mean.value[i]) > 0)
      most = std::max(most, relative(a.displacement_mean.value[i], b.displacement_mean.value[i]));
  }
  return most;
}

}  // namespace

TEST_CASE("a structure of hardly any mass is linearized as the slider alone", "[theory][structure]") {
  const EquivalentLinearization gauss({.tolerance = 1e-12}), laplace({.force = Force::laplace, .tolerance = 1e-12});
  const Structure light = one_mode(1e-13, 8);
  const auto compare = [&](const EquivalentLinearization& method, const auto& slider, const auto& noise) {
    return apart(method.predict(IsolatedStructure(slider, light), noise, times), method.predict(slider, noise, times));
  };
  const Envelope rise(1, 4, 0.5);
  CHECK(compare(gauss, Slider<Coulomb>(Coulomb(0.4), 2), soil) < 1e-10);
  CHECK(compare(laplace, Slider<Coulomb>(Coulomb(0.4)), soil) < 1e-10);
  CHECK(compare(gauss, Slider<Coulomb>(Coulomb(0.4, 0.6), {.damping = 0.3}), soil) < 1e-10);
  CHECK(compare(gauss, Slider<Caster>(Caster(0.4, 0.3), 2), soil) < 1e-10);
  CHECK(compare(gauss, Slider<Coulomb>(Coulomb(0.4), 2),
                GaussianExcitation(soil, 0.02, 801, {.zero_frequency = true, .envelope = rise})) < 1e-8);
  // Where the slider alone is solved over the logarithm of time.
  CHECK(compare(gauss, Slider<Coulomb>(Coulomb(0.4), 2), 0.02) < 1e-9);
  const Slider<Coulomb> sprung(Coulomb(0.4), 2), loose(Coulomb(0.4));
  CHECK(apart(gauss.stationary(IsolatedStructure(sprung, light), soil), gauss.stationary(sprung, soil)) < 1e-9);
  CHECK(relative(gauss.stationary(IsolatedStructure(loose, light), soil).growth_rate.value,
                 gauss.stationary(loose, soil).growth_rate.value) < 1e-9);
}

TEST_CASE("a stiff structure is linearized as the rigid block", "[theory][structure]") {
  const EquivalentLinearization method;
  const Slider<Coulomb> slider(Coulomb(0.4), 2);
  const Moments rigid = method.predict(slider, soil, times);
  double former = 1;
  for (const double frequency : {30., 300., 3000.}) {
    const double found = apart(method.predict(IsolatedStructure(slider, one_mode(0.7, frequency)), soil, times), rigid);
    // At least of the first order in the period of the structure.
    CAPTURE(frequency, found);
    CHECK(found < former / 8);
    former = found;
  }
  CHECK(former < 1e-4);
  // Equal modes are one mode.
  const Structure halves = Structure::from_modes({0.3, 0.4}, {8, 8}, {0.05, 0.05});
  CHECK(apart(method.predict(IsolatedStructure(slider, halves), soil, times),
              method.predict(IsolatedStructure(slider, one_mode(0.7, 8)), soil, times)) < 1e-8);
}

TEST_CASE("the covariance of a structure tends to the stationary one", "[theory][structure]") {
  const Structure building = Structure::shear_building({1, 1, 0.8}, {600, 500, 400}, Rayleigh{0.6, 0.004});
  const std::vector<double> late{40};
  // Of the slowest transient, 1e-5 is left.
  for (const Force force : {Force::gaussian, Force::laplace}) {
    const EquivalentLinearization method({.force = force, .tolerance = 1e-7});
    const IsolatedStructure base(Slider<Coulomb>(Coulomb(0.3), {.natural_frequency = 2, .damping = 0.1}), building, 1);
    CHECK(apart(method.predict(base, soil, late), method.stationary(base, soil)) < 1e-4);
    const EquipmentOnFloor rack(Slider<Coulomb>(Coulomb(0.3), 3), building, 2, 0.2);
    CHECK(apart(method.predict(rack, soil, late), method.stationary(rack, soil)) < 1e-4);
    // White noise on equipment that the ground reaches through the floors alone.
    const std::vector<double> both{1, 40};
    const Moments white = method.predict(rack, 0.02, both);
    CHECK(relative(white.velocity_variance.value[1], method.stationary(rack, 0.02).velocity_variance.value[0]) < 1e-4);
    const IsolatedStructure free(Slider<Coulomb>(Coulomb(0.3)), building, 1);
    const Moments grows = method.predict(free, soil, late), stationary = method.stationary(free, soil);
    CHECK(relative(grows.velocity_variance.value[0], stationary.velocity_variance.value[0]) < 1e-4);
    CHECK(relative(2 * grows.covariance.value[0], stationary.growth_rate.value) < 1e-4);
    CHECK(relative(grows.growth_rate.value, stationary.growth_rate.value) < 1e-12);
  }
}

TEST_CASE("a base that friction holds does not move", "[theory][structure]") {
  const EquivalentLinearization method;
  const Structure building = one_mode(0.7, 8);
  const IsolatedStructure held(Slider<Coulomb>(Coulomb(20), 2), building);
  const Moments still = method.predict(held, soil, times);
  CHECK(still.velocity_variance.value[2] == 0);
  CHECK(still.displacement_variance.value[2] == 0);
  CHECK_THAT(still.remark, ContainsSubstring("force on the stuck interface") && ContainsSubstring("3 of 3 times"));
  CHECK(method.stationary(held, soil).velocity_variance.value[0] == 0);
  // The structure resonates with the ground: its base moves under a level that holds a rigid block.
  const Spectrum narrow = Spectrum::kanai_tajimi(0.002, 8, 0.1);
  const Slider<Coulomb> slider(Coulomb(0.8), 2);
  CHECK(method.predict(slider, narrow, times).velocity_variance.value[2] == 0);
  CHECK(method.predict(IsolatedStructure(slider, building), narrow, times).velocity_variance.value[2] > 0);
}

TEST_CASE("equivalent linearization says which structures it does not cover", "[theory][structure]") {
  const EquivalentLinearization method;
  const Structure building = one_mode(0.7, 8);
  const auto reason = [&](const SlidingStructure& system, const EquivalentLinearization& by) {
    const theory::Coverage coverage = by.covers(system, soil);
    CHECK_FALSE(coverage);
    CHECK_THROWS_WITH(by.predict(system, soil, times), ContainsSubstring(coverage.reason));
    return coverage.reason;
  };
  CHECK(method.covers(IsolatedStructure(Slider<Coulomb>(Coulomb(1)), building), soil));
  Mounting stops;
  stops.stops = Stops(0.1, 0.5);
  CHECK_THAT(reason(IsolatedStructure(Slider<Coulomb>(Coulomb(1), stops), building), method),
             ContainsSubstring("stops"));
  CHECK_THAT(reason(IsolatedStructure(Slider<Stribeck>(Stribeck(1, 0.5, 0.1, 1)), building), method),
             ContainsSubstring("speed"));
  CHECK_THAT(
      reason(IsolatedStructure(Slider<Coulomb>(Coulomb(1)), building), EquivalentLinearization({.dimensions = 2})),
      ContainsSubstring("dimensions must be 1, got 2"));
  const std::vector<double> masses(13, 1.0), stiffnesses(13, 900.0);
  CHECK_THAT(
      reason(IsolatedStructure(Slider<Coulomb>(Coulomb(1)), Structure::shear_building(masses, stiffnesses, 0.05), 1),
             method),
      ContainsSubstring("at most 12 modes, got 13"));
}
