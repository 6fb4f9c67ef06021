// Margins of decisions in the plane: cases whose margins are known, one axis, symmetries, and what they mean.
#include "stickslip/planar/margins.hpp"

#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

#include "stickslip/core.hpp"
#include "support/catch.hpp"
#include "support/motions.hpp"

using namespace stickslip;
using namespace test;

namespace {

/// The ground motion that loads a slider on level ground with these vectors, straight lines between them.
GroundMotion loads(const std::vector<Vector2>& p, double dt = 1) {
  std::vector<double> axis, transverse;
  for (const Vector2 one : p) axis.push_back(-one.axis), transverse.push_back(-one.transverse);
  return GroundMotion(axis, dt).with_components(transverse, {});
}

template <class Law>
Margins margins_of(const PlanarSlider<Law>& slider, const GroundMotion& motion,
                   const PlanarIntegrateOptions& options = {}) {
  return margins(slider, motion, integrate(slider, motion, options));
}

PlanarIntegrateOptions thrown(Vector2 velocity, Vector2 displacement = {}) {
  PlanarIntegrateOptions options;
  options.velocity = velocity;
  options.displacement = displacement;
  return options;
}

std::vector<double> across_samples() {
  std::vector<double> n;
  for (int m = 0; m <= 400; ++m) n.push_back(1.5 * std::sin(0.9 * m + 1.1) + 0.8 * std::cos(2.3 * m));
  return n;
}

}  // namespace

TEST_CASE("a load vector that all but breaks a slider away has the margin that was left", "[planar][margins]") {
  const PlanarSlider block(Coulomb(1.0));
  CHECK(margins_of(block, loads({{}, {0.6, 0.45}, {}})).load == Approx(0.25).epsilon(1e-15));
  CHECK(margins_of(block, loads({{}, {0, -0.75}, {}})).load == 0.25);
  CHECK(margins_of(block, loads({{}, {0.3, 0.4}, {0.1, 0.1}, {-0.45, 0.6}})).load == Approx(0.25).epsilon(1e-15));
  // The load goes past the origin within a segment: its magnitude falls and grows again.
  CHECK(margins_of(block, loads({{0.75, 0}, {-0.5, 0.5}})).load == 0.25);
  CHECK(margins_of(PlanarSlider(StaticKinetic(Coulomb(1.0), 2)), loads({{}, {0.9, 1.2}, {}})).load == 0.25);
  // The spring draws with (0, 1); on a slope the weight acts along the axis.
  CHECK(
      margins_of(PlanarSlider(Coulomb(2.0), {.natural_frequency = 2}), loads({{}, {0.8, 1}, {}}), thrown({}, {0, 0.25}))
          .load == Approx(0.5).epsilon(1e-15));
  // N from g to 0.9 g and back.
  const GroundMotion lighter =
      loads({{0.6, 0.8}, {0.6, 0.8}, {0.6, 0.8}}).with_components({-0.8, -0.8, -0.8}, {0, -0.1 * standard_gravity, 0});
  CHECK(margins_of(PlanarSlider(Coulomb(1.25)), lighter).load == Approx(1 - 1 / (0.9 * 1.25)).epsilon(1e-13));
}

TEST_CASE("a load vector that just breaks a slider away has the margin by which it went beyond", "[planar][margins]") {
  const PlanarSlider block(Coulomb(1.0));
  for (const double e : {0.25, 0.125, 1e-3})
    CHECK(margins_of(block, loads({{}, {0.6 * (1 + e), 0.8 * (1 + e)}, {}})).load == Approx(e).epsilon(1e-12));
  // The load turns meanwhile: its largest magnitude counts.
  CHECK(margins_of(block, loads({{0, 0}, {1.125, 0}, {0, 0.5}, {0, 0}})).load == Approx(0.125).epsilon(1e-12));
}

TEST_CASE("a load that grows across a sample has no margin there, whatever its last bits", "[planar][margins]") {
  const PlanarSlider block(Coulomb(0.85));
  int rounded = 0;
  for (int k = 0; k < 500; ++k) {
    const double before = -0.3 - 0.0002 * k, after = 0.9 + 1e-6 * k;
    rounded += before + (after - before) > after ? 1 : 0;
    INFO(k);
    CHECK(margins_of(block, loads({{}, {before, 0}, {after, 0}, {1.5, 0}, {}, {}, {}})).load > 0.1);
  }
  CHECK(rounded > 10);
}

TEST_CASE("under loads along one line the margins in the plane are those on one axis", "[planar][margins]") {
  const std::vector<double> n = record_a_samples();
  const auto line = [&](Vector2 toward) {
    std::vector<double> axis, transverse;
    for (const double one : n) axis.push_back(toward.axis * one), transverse.push_back(toward.transverse * one);
    return GroundMotion(axis, 0.1).with_components(transverse, {});
  };
  const auto check = [&](const auto& slider) {
    const Margins one = margins(slider, record_a(), integrate(slider, record_a()));
    CHECK(one.load < 1);
    for (const Vector2 toward : {Vector2{1, 0}, Vector2{0, -1}, Vector2{0.6, 0.8}}) {
      const Margins both = margins_of(PlanarSlider(slider), line(toward));
      // The direction is rounded. Near the level a margin is the difference of nearly equal numbers.
      CHECK(both.load == Approx(one.load).epsilon(1e-8));
      CHECK(both.impact == Approx(one.impact).epsilon(1e-8));
    }
  };
  for (const double level : {0.5, 1.0, 2.0}) check(Slider(Coulomb(level)));
  check(Slider(Coulomb(1.0), 2, 0.2));
  check(Slider(StaticKinetic(Coulomb(1.0), 1.3)));
  check(Slider(StaticKinetic(Coulomb(1.0), 1.3), 2));
  check(Slider(Degrading({0, 0.5}, {1.5, 1})));
  check(Slider(Coulomb(1.0), {.stops = Stops(0.3, 0.5)}));
  check(Slider(VelocityDependent(0.5, 1, 20), 2));
}

TEST_CASE("margins in the plane do not depend on the scale or the direction", "[planar][margins]") {
  const std::vector<double> n = record_a_samples(), t = across_samples();
  const GroundMotion pair = GroundMotion(n, 0.1).with_components(t, {});
  std::vector<double> mirrored = n;
  for (double& one : mirrored) one = -one;
  const GroundMotion swapped = GroundMotion(t, 0.1).with_components(mirrored, {});
  for (const double level : {1.5, 2.0, 2.5}) {
    const Margins one = margins_of(PlanarSlider(Coulomb(level)), pair);
    CHECK(one.load > 0);
    CHECK(one.load < 1);
    CHECK(margins_of(PlanarSlider(Coulomb(4 * level)), pair.scaled(4)).load == Approx(one.load).epsilon(1e-9));
    CHECK(margins_of(PlanarSlider(Coulomb(level)), swapped).load == Approx(one.load).epsilon(1e-9));
  }
}

TEST_CASE("changes of the level within the margin keep the events in the plane", "[planar][margins]") {
  const GroundMotion pair = record_a().with_components(across_samples(), {});
  const auto kinds = [](const PlanarResponse& r) {
    std::vector<EventKind> all;
    for (const PlanarEvent& e : r.events) all.push_back(e.kind);
    return all;
  };
  int kept = 0;
  for (int i = 0; i < 12; ++i) {
    const double level = 1.5 + 0.05 * i;
    const PlanarSlider slider(Coulomb{level});
    const PlanarResponse r = integrate(slider, pair);
    const double margin = margins(slider, pair, r).load;
    const PlanarResponse other = integrate(PlanarSlider(Coulomb(level * (1 + 0.01 * margin))), pair);
    kept += kinds(r) == kinds(other);
  }
  // A turn that became a stop is no decision that was counted.
  CHECK(kept >= 11);
}

TEST_CASE("distances to a circular stop", "[planar][margins]") {
  // Thrown along the axis at 1 m/s against a level of 1, the block stops at 0.5 m.
  const GroundMotion quiet = loads({{}, {}, {}});
  const auto with_gap = [&](double gap, PlanarIntegrateOptions options) {
    return margins_of(PlanarSlider(Coulomb(1.0), {.stops = Stops(gap, 0.5)}), quiet, options).impact;
  };
  CHECK(with_gap(0.8, thrown({0.6, 0.8})) == Approx(0.375).epsilon(1e-12));
  // From the other side it goes through the middle.
  CHECK(with_gap(0.8, thrown({1, 0}, {-0.4, 0})) == Approx(1 - 0.1 / 0.8).epsilon(1e-12));
  // It would have stopped 0.1 m beyond a stop at 0.4 m; then it rebounds.
  CHECK(with_gap(0.4, thrown({1, 0})) == Approx(0.1 / 0.4).epsilon(1e-12));
  CHECK(with_gap(0.4, thrown({0, std::sqrt(0.802)})) == Approx(0.001 / 0.4).epsilon(1e-8));
  // Past the middle at a distance, closest to the circle where it stops, by Pythagoras.
  CHECK(with_gap(0.8, thrown({1, 0}, {0, 0.3})) == Approx(1 - std::hypot(0.5, 0.3) / 0.8).epsilon(1e-12));
  CHECK(std::isinf(margins_of(PlanarSlider(Coulomb(1.0)), quiet, thrown({1, 0})).impact));

  // A block that rests against a stop and is pushed away from it did not miss it.
  const Slider near(Coulomb(1.0), {.stops = Stops(0.1, 0)});
  const std::vector<Vector2> back_and_forth = {{}, {2, 0}, {2, 0}, {-1.5, 0}, {0, 0}, {0, 0}};
  std::vector<double> n;
  for (const Vector2 p : back_and_forth) n.push_back(-p.axis);
  const GroundMotion on_axis(n, 1);
  const Margins one = margins(near, on_axis, integrate(near, on_axis)),
                both = margins_of(PlanarSlider(near), loads(back_and_forth));
  CHECK(one.impact > 1);
  CHECK(both.impact > 1);
}
