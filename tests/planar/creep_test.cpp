// Creep in the plane: a slider whose friction grows steeply with the speed returns slowly on its spring.
#include <cmath>
#include <vector>

#include "stickslip/core.hpp"
#include "support/catch.hpp"
#include "support/motions.hpp"

using namespace stickslip;

namespace {

constexpr double slow = 0.3, fast = 1.5, rate = 2000, wn = 4;

PlanarSlider<VelocityDependent> slider(double damping = 0) {
  return PlanarSlider(VelocityDependent(slow, fast, rate), {.natural_frequency = wn, .damping = damping});
}

/// Counts flows, and sums the works.
struct Flows {
  long number = 0;
  double work = 0;

  void event(EventKind, double, const PlanarState&) const noexcept {}
  template <class Flow>
  void follow(const Flow& flow, double last, double) {
    ++number;
    const auto done = detail::work(flow, last);
    work += done.friction + done.damper - done.load;
  }
};

double energy(const PlanarState& state) {
  return dot(state.velocity, state.velocity) / 2 + wn * wn * dot(state.displacement, state.displacement) / 2;
}

}  // namespace

TEST_CASE("creep in the plane takes few steps, and they are as exact as many", "[planar]") {
  for (const double damping : {0.0, 0.5}) {
    const PlanarState start = PlanarState::at({0.063, 0.0128}, {-0.0005, -0.001});
    PlanarState at_once = start, in_parts = start;
    Flows few, many;
    advance(slider(damping), PlanarSegment{8, {}, {}}, at_once, few);
    // Within 10 ms creep is not tried: the decay time of the speed is about 1 ms.
    for (int i = 0; i < 800; ++i) advance(slider(damping), PlanarSegment{0.01, {}, {}}, in_parts, many);
    CHECK(few.number < 200);
    CHECK(many.number > 10 * few.number);
    CHECK(norm(at_once.displacement - in_parts.displacement) <= 1e-12 * norm(start.displacement));
    CHECK(norm(at_once.velocity - in_parts.velocity) <= 1e-12);
    CHECK(std::abs(energy(at_once) + few.work - energy(start)) <= 1e-14 * energy(start));
  }
}

TEST_CASE("creep in the plane is that of a balance of forces", "[planar]") {
  // Without inertia u = ln((fast - slow) / (fast - wn^2 r)) / rate on a line through the origin; it acts by about
  // u' / Q, some 1e-5. The time from one place to another, by Simpson's rule.
  PlanarState state = PlanarState::at({0.06, 0.045}, {-8e-4, -6e-4});
  advance(slider(), PlanarSegment{1, {}, {}}, state);
  const double from = norm(state.displacement);
  advance(slider(), PlanarSegment{50, {}, {}}, state);
  const double to = norm(state.displacement);
  CHECK(std::abs(cross(state.displacement, {0.8, 0.6})) <= 1e-6 * to);
  const auto slowness = [](double r) { return rate / std::log((fast - slow) / (fast - wn * wn * r)); };
  constexpr int parts = 200;
  double time = 0;
  for (int i = 0; i <= parts; ++i)
    time += slowness(to + (from - to) * i / parts) * (i == 0 || i == parts ? 1 : i % 2 == 1 ? 4 : 2);
  time *= (from - to) / parts / 3;
  CHECK(time == Approx(50).epsilon(1e-4));
}

TEST_CASE("a slider on a strong damper settles where friction holds the spring", "[planar]") {
  const GroundMotion still = GroundMotion({0, 0, 0}, 0.1).with_components({0, 0, 0});
  for (const double damping : {1.9, 2.1, 5.0}) {
    PlanarIntegrateOptions options;
    options.displacement = {0.48, 0.64};
    options.settle = true;
    const PlanarResponse r =
        integrate(PlanarSlider(Coulomb(0.5), {.natural_frequency = 1, .damping = damping}), still, options);
    CHECK(r.state.mode == PlanarMode::stuck);
    CHECK(norm(r.residual) <= 0.5 * (1 + 1e-12));
    if (damping > 2) CHECK(norm(r.residual - Vector2{0.3, 0.4}) <= 1e-12);
    CHECK(std::abs(r.energy.imbalance()) <= 1e-12 * test::turnover(r.energy));
  }
}

TEST_CASE("a slider that creeps in the plane settles where friction at rest holds the spring", "[planar]") {
  std::vector<double> n, t;
  for (int i = 0; i < 600; ++i) {
    const double window = std::sin(3.14159265358979 * i / 600);
    n.push_back(6 * window * std::sin(0.04 * i));
    t.push_back(4.2 * window * std::cos(0.053 * i));
  }
  PlanarIntegrateOptions options;
  options.settle = true;
  const PlanarResponse r = integrate(slider(), GroundMotion(n, 0.01).with_components(t, {}), options);
  CHECK(norm(r.residual) == Approx(slow / (wn * wn)).epsilon(1e-9));
  CHECK(r.events.back().time > 1000);
  CHECK(std::abs(r.energy.imbalance()) <= 1e-12 * test::turnover(r.energy));
}
