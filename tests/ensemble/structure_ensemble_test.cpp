// Ensembles of structures with a sliding interface: members as integrate has them, limits, parts, peaks of the floors.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <variant>
#include <vector>

#include "stickslip/ensemble/run.hpp"
#include "stickslip/excitation/gaussian.hpp"
#include "stickslip/excitation/poisson.hpp"
#include "stickslip/structure/equipment_on_floor.hpp"
#include "stickslip/structure/flexible_slope.hpp"
#include "stickslip/structure/identity.hpp"
#include "stickslip/structure/isolated_structure.hpp"
#include "support/catch.hpp"
#include "support/size.hpp"

using namespace stickslip;
using namespace test;
using Catch::Matchers::ContainsSubstring;

namespace {

using System = std::variant<IsolatedStructure, EquipmentOnFloor, FlexibleSlope>;

const GaussianExcitation noise(Spectrum::kanai_tajimi(0.01, 12, 0.6), 0.02, 257);

Structure building() { return Structure::shear_building({1, 1, 0.8}, {600, 500, 400}, Rayleigh{0.1, 0.002}); }

Slider<Coulomb> bearing(Mounting mounting = {.natural_frequency = 1.5}) {
  return Slider<Coulomb>(Coulomb(0.5), mounting);
}

IsolatedStructure isolated() { return {bearing(), building(), 1}; }

EnsembleOptions options(std::uint64_t members, unsigned threads = 2) {
  EnsembleOptions o;
  o.members = members;
  o.seed = 5;
  o.threads = threads;
  o.dt = 0.32;
  return o;
}

StructureResponse moved(const System& system, const GroundMotion& motion, bool settle) {
  StructureIntegrateOptions o;
  o.settle = settle;
  return std::visit([&](const auto& one) { return integrate(one, motion, o); }, system);
}

double relative(double found, double value) { return std::abs(found - value) / std::max(std::abs(value), 1e-12); }

}  // namespace

TEST_CASE("members with structures are what integrate says of them", "[ensemble][structure]") {
  FlexibleSlope slope{.ky_g = 0.04, .height = 40, .shear_velocity = 300, .damping_ratio = 0.1, .modes = 2};
  FlexibleSlope apart = slope;
  apart.method = SlopeMethod::decoupled;
  Mounting with_stops{.natural_frequency = 1.5};
  with_stops.stops = Stops(0.02, 0.03, 0.5);
  constexpr std::size_t members = 6;
  for (const System& system :
       {System(isolated()), System(IsolatedStructure(bearing(with_stops), building(), 1)),
        System(EquipmentOnFloor(Slider<Coulomb>(Coulomb(0.7)), building(), 3, 0.2)), System(slope), System(apart)})
    for (const bool settle : {false, true}) {
      EnsembleOptions o = options(members);
      o.settle = settle;
      const Ensemble e = run_ensemble(OneOf(std::vector{system}), noise, o);
      REQUIRE(e.has_floors());
      const auto peak = e.peak(), residual = e.residual(), base = e.peak_base_acceleration(),
                 shear = e.peak_base_shear();
      const FloorPeaks accelerations = e.peak_floor_acceleration(), drifts = e.peak_floor_drift();
      std::vector<double> last;
      for (std::size_t i = 0; i < members; ++i) {
        // The times of the statistics divide segments: round-off of some hundred steps.
        const StructureResponse r = moved(system, noise.sample(5, i), settle);
        CHECK(peak[i] == Approx(r.peak).epsilon(1e-9));
        CHECK(residual[i] == Approx(r.residual).epsilon(1e-8).margin(1e-12));
        CHECK(base[i] == Approx(r.peak_base_acceleration).epsilon(1e-9));
        CHECK(shear[i] == Approx(r.peak_base_shear).epsilon(1e-9));
        REQUIRE(accelerations.floors == r.floors.peak_drift.size());
        for (std::size_t k = 0; k < accelerations.floors; ++k) {
          CHECK(accelerations.values[i * accelerations.floors + k] ==
                Approx(r.floors.peak_acceleration[k]).epsilon(1e-9));
          CHECK(drifts.on_floor(k + 1)[i] == Approx(r.floors.peak_drift[k]).epsilon(1e-9));
        }
        last.push_back(r.displacement[256]);
      }
      double mean = 0;
      for (const double x : last) mean += x / members;
      CHECK(e.displacement_mean().value.back() == Approx(mean).epsilon(1e-9).margin(1e-12));
    }
}

TEST_CASE("impacts of a base on its stops are counted", "[ensemble][structure]") {
  Mounting mounting{.natural_frequency = 1.5};
  mounting.stops = Stops(0.005, 0.01, 0.5);
  const Ensemble e = run_ensemble(IsolatedStructure(bearing(mounting), building(), 1), noise, options(8));
  std::uint64_t count = 0;
  for (const Impacts& one : e.impacts()) count += one.forward.count;
  CHECK(count > 0);
  CHECK(e.parts().gaps == SmallestGaps{0.005, 0.01});
  for (const double peak : e.peak()) CHECK(peak <= 0.01);
}

TEST_CASE("a structure of hardly any mass is the slider alone, member by member", "[ensemble][structure]") {
  // Differences are of the first order in the mass fraction.
  const Structure light = Structure::from_modes({1e-10}, {8}, {0.05});
  const auto compared = [&](const auto& motions) {
    const EnsembleOptions o = options(20);
    const Ensemble structure = run_ensemble(IsolatedStructure(bearing(), light), motions, o),
                   slider = run_ensemble(bearing(), motions, o);
    double most = 0;
    for (std::size_t i = 0; i < 20; ++i) most = std::max(most, relative(structure.peak()[i], slider.peak()[i]));
    const auto variance = structure.velocity_variance().value, other = slider.velocity_variance().value;
    for (std::size_t i = 1; i < variance.size(); ++i) most = std::max(most, relative(variance[i], other[i]));
    return most;
  };
  CHECK(compared(noise) < 1e-8);
  CHECK(compared(PoissonPulses(2, 0.5, 2, 6)) < 1e-8);
}

TEST_CASE("structures have the same bits on any threads and in any parts", "[ensemble][structure]") {
  const std::uint64_t members = size(130, 70);
  const Ensemble whole = run_ensemble(isolated(), noise, options(members, 1));
  CHECK(run_ensemble(isolated(), noise, options(members, 2)) == whole);
  EnsembleOptions rest = options(members - 64);
  rest.first_member = 64;
  Ensemble part = run_ensemble(isolated(), noise, rest);
  part.merge(run_ensemble(isolated(), noise, options(64)));
  CHECK(part == whole);
  CHECK(Ensemble(whole.parts()) == whole);
}

TEST_CASE("peaks of floors have means, deviations and quantiles", "[ensemble][structure]") {
  FloorPeaks peaks{{1, 10, 2, 20, 3, 20, 6, 20}, 2};
  REQUIRE(peaks.members() == 4);
  CHECK(peaks.on_floor(1) == std::vector<double>{1, 2, 3, 6});
  CHECK_THROWS_WITH(peaks.on_floor(3), ContainsSubstring("floor must be from 1 to 2, got 3"));
  const Estimates mean = peaks.mean(), deviation = peaks.deviation();
  CHECK(mean.value[0] == Approx(3));
  CHECK(deviation.value[0] == Approx(std::sqrt(14 / 3.)));
  CHECK(mean.error[0] == Approx(std::sqrt(14 / 3. / 4)));
  CHECK(deviation.error[0] > 0);
  CHECK(peaks.quantile(0.5)[0].value == 2);
  CHECK(peaks.quantile(0.8)[1].value == 20);
  CHECK_THROWS_WITH(peaks.quantile(1), ContainsSubstring("FloorPeaks: probability"));
  CHECK(FloorPeaks{}.mean().value.empty());
  CHECK_THROWS_AS((FloorPeaks{{1}, 1}).mean(), std::domain_error);
}

TEST_CASE("ensembles of structures refuse what does not go together", "[ensemble][structure]") {
  const Structure two = Structure::shear_building({1, 1}, {600, 500}, 0.05);
  const std::vector<IsolatedStructure> both{isolated(), {bearing(), two, 1}};
  CHECK_THROWS_WITH(run_ensemble(OneOf(both), noise, options(4)),
                    ContainsSubstring("member 1") && ContainsSubstring("the same number of floors, got 3 and 2"));
  // Degrees of freedom that are not floors above each other have accelerations, but no drifts.
  const Structure turned(two.mass(), two.damping(), two.stiffness(), {1, 0.5});
  const Ensemble apart = run_ensemble(IsolatedStructure(bearing(), turned, 1), noise, options(4));
  CHECK(apart.peak_floor_acceleration().values.size() == 8);
  CHECK_THROWS_WITH(apart.peak_floor_drift(), ContainsSubstring("drifts need an influence of ones"));
  const IsolatedStructure extreme(bearing(), two, 1e-12);
  CHECK_THROWS_WITH(run_ensemble(OneOf(std::vector{isolated(), extreme}), noise, options(4)),
                    ContainsSubstring("member 1") && ContainsSubstring("too fast for the time step"));
  const Ensemble sliders = run_ensemble(bearing(), noise, options(4));
  CHECK_FALSE(sliders.has_floors());
  CHECK_THROWS_WITH(sliders.peak_floor_drift(), ContainsSubstring("sliders have no floors"));
}

TEST_CASE("structures are known by what they are made from", "[ensemble][structure]") {
  CHECK(identity(IsolatedStructure(bearing(), Structure::from_modes({0.7}, {8}, {0.05}))) ==
        "{\"isolated_structure\": {\"mass_fractions\": [0.7], \"frequencies\": [8], \"damping_ratios\": [0.05]}, "
        "\"base_mass\": " +
            detail::shortest(1 - 0.7) + ", \"slider\": " + identity(bearing()) + "}");
  CHECK(identity(isolated()) != identity(IsolatedStructure(bearing(), building(), 1.1)));
  const EquipmentOnFloor third(bearing(), building(), 3, 0.1), second(bearing(), building(), 2, 0.1);
  CHECK(identity(third) != identity(second));
  const FlexibleSlope slope{.ky_g = 0.1, .height = 40, .shear_velocity = 300};
  FlexibleSlope other = slope;
  other.soil = HyperbolicSoil(1e-3);
  CHECK_THAT(identity(other), ContainsSubstring("\"reference_strain\": 0.001"));
  CHECK(identity(slope) != identity(other));
}
