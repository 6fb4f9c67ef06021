// Pendulums with several surfaces: values, limits, the operator, energy, an independent integration.
#include "stickslip/friction/multi_pendulum.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <random>
#include <stdexcept>
#include <vector>

#include "stickslip/core.hpp"
#include "stickslip/friction/pendulum_loop.hpp"
#include "stickslip/sliding/element_motion.hpp"
#include "stickslip/sliding/floor_motion.hpp"
#include "stickslip/sliding/forces.hpp"
#include "support/catch.hpp"
#include "support/motions.hpp"
#include "support/reference.hpp"

using namespace stickslip;
using namespace test;
using Catch::Matchers::ContainsSubstring;
using Catch::Matchers::WithinAbs;

static_assert(MemoryLaw<MultiPendulum> && SymmetricLaw<MultiPendulum> && form_of<MultiPendulum> == Form::linear);
static_assert(detail::SpringLaw<MultiPendulum::Piece> && !detail::SpringLaw<Degrading::Piece>);

namespace {

MultiPendulum made(const reference::Value& b) {
  return {b["radii"].list(), b["mu"].list(), b["capacities"].list(), b["restitution"], b["nested"].as<bool>()};
}
MultiPendulum in_series(std::vector<double> radii, std::vector<double> mu, std::vector<double> capacities,
                        double e = 0) {
  return {std::move(radii), std::move(mu), std::move(capacities), e};
}
const MultiPendulum triple({0.3937, 3.7465, 3.7465}, {0.01, 0.04, 0.08}, {0.0716, 0.5043, 0.5043}, 0, true);

GroundMotion shaking(double factor, double dt, bool vertical) {
  std::vector<double> n = record_a_samples(), up;
  for (double& value : n) value *= factor;
  for (int m = 0; m <= 400; ++m) up.push_back(static_cast<double>(2.5L * std::cos(0.5L * m + 0.2L)));
  const GroundMotion motion(n, dt);
  return vertical ? motion.with_components({}, up) : motion;
}

IntegrateOptions settled() {
  IntegrateOptions options;
  options.settle = true;
  return options;
}

int count(const Response& r, EventKind kind) {
  return static_cast<int>(
      std::count_if(r.events.begin(), r.events.end(), [&](const Event& e) { return e.kind == kind; }));
}

void check_all(const std::vector<double>& values, const std::vector<double>& expected, double tolerance) {
  REQUIRE(values.size() == expected.size());
  for (std::size_t k = 0; k < values.size(); ++k) CHECK_THAT(values[k], WithinAbs(expected[k], tolerance));
}

double sum(const std::vector<double>& values) { return std::accumulate(values.begin(), values.end(), 0.0); }

/// Random bearings: some elements equal, some without a stop, some flat.
MultiPendulum random_bearing(std::mt19937_64& bits, double restitution) {
  std::uniform_real_distribution<double> unit(0, 1);
  std::vector<double> radii, mu, capacities;
  const int elements = 1 + static_cast<int>(5 * unit(bits));
  for (int k = 0; k < elements; ++k) {
    radii.push_back(unit(bits) < 0.08 ? infinity : 0.3 + 3 * unit(bits));
    mu.push_back(unit(bits) < 0.3 ? 0.05 : 0.01 + 0.09 * unit(bits));
    capacities.push_back(unit(bits) < 0.2 ? infinity : 0.01 + 0.1 * unit(bits));
  }
  return in_series(radii, mu, capacities, restitution);
}

}  // namespace

TEST_CASE("the loop of a pendulum with several surfaces has the values of the reference") {
  for (const auto& v : reference::rows("pendulums", "loops")) {
    CAPTURE(v["id"].as<std::string>());
    const PendulumLoop loop = trace(made(v["bearing"]), v["path"].list());
    check_all(loop.force, v["force"].list(), 1e-15);
    check_all(loop.dissipated, v["dissipated"].list(), 1e-15);
    std::vector<double> elements, surfaces;
    for (std::size_t k = 0; k < loop.displacement.size(); ++k) {
      elements.push_back(loop.displacement[k].back());
      surfaces.push_back(loop.surfaces[k].back());
    }
    check_all(elements, v["elements"].list(), 2e-16);
    check_all(surfaces, v["surfaces"].list(), 4e-16);
    CHECK(loop.slides == v["slides"].as<std::vector<std::size_t>>());
    CHECK(loop.stops == v["stops"].as<std::vector<std::size_t>>());
  }
}

TEST_CASE("the motion of a pendulum with several surfaces has the values of the reference") {
  for (const auto& v : reference::rows("pendulums", "motions")) {
    CAPTURE(v["id"].as<std::string>());
    const MultiPendulum law = made(v["bearing"]);
    const Slider<MultiPendulum> slider(law);
    const GroundMotion motion = shaking(v["factor"], v["dt"], v["vertical"].as<bool>());
    const Response r = integrate(slider, motion);
    const double x = 1e-12 * v["peak"], work = 1e-12 * (v["dissipated"] + v["impact"]);
    CHECK_THAT(r.displacement[400], WithinAbs(v["displacement"], x));
    CHECK_THAT(r.velocity[400], WithinAbs(v["velocity"], 1e-12 * std::sqrt(v["dissipated"])));
    CHECK_THAT(r.peak, WithinAbs(v["peak"], x));
    check_all({r.displacement[100], r.displacement[200], r.displacement[300]}, {v["at_100"], v["at_200"], v["at_300"]},
              x);
    CHECK_THAT(r.energy.dissipated, WithinAbs(v["dissipated"], work));
    CHECK_THAT(r.energy.impact, WithinAbs(v["impact"], work));
    CHECK_THAT(r.energy.imbalance(), WithinAbs(0, work));
    CHECK(count(r, EventKind::breakaway) == v["breakaways"].as<int>());
    CHECK(count(r, EventKind::reversal) == v["reversals"].as<int>());
    CHECK(count(r, EventKind::arrest) == v["arrests"].as<int>());
    CHECK(count(r, EventKind::impact) == v["impacts"].as<int>());
    CHECK_THAT(integrate(slider, motion, settled()).residual, WithinAbs(v["residual"], x));

    const ElementMotion elements = element_motion(law, *trajectory(slider, motion, r));
    check_all(elements.dissipated, v["element_dissipated"].list(), work);
    check_all(elements.sliding_distance, v["element_distance"].list(), 1e-12 * r.sliding_distance);
    check_all(elements.peak, v["element_peak"].list(), x);
    CHECK(elements.slides == v["slides"].as<std::vector<std::size_t>>());
    CHECK(elements.stops == v["stops"].as<std::vector<std::size_t>>());
    std::vector<double> last, last_surfaces;
    for (std::size_t k = 0; k < elements.displacement.size(); ++k) {
      last.push_back(elements.displacement[k].back());
      last_surfaces.push_back(elements.surfaces[k].back());
    }
    check_all(last, v["elements"].list(), x);
    check_all(last_surfaces, v["surfaces"].list(), 2 * x);
  }
}

TEST_CASE("a bearing with one surface is a slider on a spring") {
  for (const double e : {0.0, 0.4})
    for (const bool vertical : {false, true}) {
      CAPTURE(e, vertical);
      const GroundMotion motion = shaking(1.5, 0.1, vertical);
      const Response r = integrate(in_series({1.5}, {0.05}, {0.05}, e), motion, settled());
      Mounting mounting{
          .natural_frequency = std::sqrt(standard_gravity / 1.5), .stops = Stops(0.05, e), .pendulum = true};
      const Response one = integrate(Slider(Coulomb(0.05 * standard_gravity), mounting), motion, settled());
      REQUIRE(count(one, EventKind::impact) > 3);
      REQUIRE(r.events.size() == one.events.size());
      for (std::size_t i = 0; i < r.displacement.size(); ++i)
        CHECK_THAT(r.displacement[i], WithinAbs(one.displacement[i], 1e-13 * one.peak));
      CHECK_THAT(r.energy.dissipated, WithinAbs(one.energy.dissipated, 1e-12));
      CHECK_THAT(r.energy.elastic, WithinAbs(one.energy.elastic, 1e-14));
      CHECK_THAT(r.energy.input, WithinAbs(one.energy.input, 1e-12));
    }
}

TEST_CASE("elements that are alike are one element") {
  const GroundMotion motion = shaking(0.5, 0.3, true);
  const Response one = integrate(in_series({2, 2.5}, {0.04, 0.07}, {0.06, 0.09}, 0.3), motion, settled());
  const Response split =
      integrate(in_series({0.8, 1.2, 2.5}, {0.04, 0.04, 0.07}, {0.024, 0.036, 0.09}, 0.3), motion, settled());
  REQUIRE(count(one, EventKind::impact) > 3);
  CHECK(one.events.size() == split.events.size());
  CHECK_THAT(split.residual, WithinAbs(one.residual, 1e-12 * one.peak));
  CHECK_THAT(split.energy.dissipated, WithinAbs(one.energy.dissipated, 1e-11));
}

TEST_CASE("a pendulum scales with its friction and remembers closed loops for nothing") {
  std::mt19937_64 bits(3);
  std::uniform_real_distribution<double> unit(-1, 1);
  for (int i = 0; i < 300; ++i) {
    const MultiPendulum law = random_bearing(bits, 0);
    const double most = std::min(law.capacity(), 0.5);
    std::vector<double> path;
    for (int k = 0; k < 6; ++k) path.push_back(0.9 * most * unit(bits));
    const PendulumLoop loop = trace(law, path);
    // Friction and capacities three times as large: so are forces and displacements.
    std::vector<double> mu, capacities, longer;
    for (const double value : law.mu()) mu.push_back(3 * value);
    for (const double value : law.capacities()) capacities.push_back(3 * value);
    for (const double value : path) longer.push_back(3 * value);
    const PendulumLoop scaled = trace(in_series(law.radii(), mu, capacities), longer);
    for (std::size_t k = 0; k < path.size(); ++k) CHECK_THAT(scaled.force[k], WithinAbs(3 * loop.force[k], 1e-12));
    // An excursion within the last two turning points, back to the end of the path, is forgotten.
    std::vector<double> excursion = path;
    const double last = path[5], before = path[4];
    excursion.push_back(last + 0.4 * (before - last));
    excursion.push_back(last);
    excursion.push_back(last + (last - before) * 0.05);
    path.push_back(excursion.back());
    if (std::abs(path.back()) < most) {
      const PendulumLoop straight = trace(law, path), around = trace(law, excursion);
      CHECK_THAT(around.force.back(), WithinAbs(straight.force.back(), 1e-12));
    }
    // The elements add up, and each is where the play operator with stops puts it.
    double total = 0;
    for (const auto& element : loop.displacement) total += element.back();
    CHECK_THAT(total, WithinAbs(path[5], 1e-13));
  }
}

TEST_CASE("the energy of a pendulum is balanced, and its loop has the area of its elements") {
  std::mt19937_64 bits(5);
  for (int i = 0; i < 200; ++i) {
    CAPTURE(i);
    const MultiPendulum law = random_bearing(bits, 0.4 * (i % 3));
    const Slider<MultiPendulum> slider(law, Mounting{.damping = i % 4 == 0 ? 0.4 : 0.0});
    const GroundMotion motion = shaking(0.3 + 0.01 * (i % 50), i % 2 == 0 ? 0.1 : 0.3, i % 5 == 0);
    Response r;
    try {
      r = integrate(slider, motion, settled());
    } catch (const ConvergenceError&) {
      FAIL("does not settle");
    }
    const double scale = r.energy.dissipated + r.energy.damped + r.energy.impact + r.energy.kinetic + r.energy.elastic;
    CHECK_THAT(r.energy.imbalance(), WithinAbs(0, 2e-12 * scale));
    const ElementMotion elements = element_motion(law, *trajectory(slider, motion, r));
    CHECK_THAT(sum(elements.dissipated), WithinAbs(r.energy.dissipated, 2e-12 * scale));
    for (std::size_t k = 0; k < elements.peak.size(); ++k) CHECK(elements.peak[k] <= law.elements()[k].capacity);
    double end = 0;
    for (const auto& element : elements.displacement) end += element.back();
    if (!r.truncated) CHECK_THAT(end, WithinAbs(r.displacement.back(), 1e-12 * (r.peak + 1e-3)));
  }
}

TEST_CASE("a pendulum moves as plays that are inverted step by step") {
  // The velocity is taken at the middle of steps, the force by inverting the sum of the plays: neither sets of elements
  // nor events. The error is of first order in the step: three steps tell how well it is extrapolated.
  std::mt19937_64 bits(7);
  for (int i = 0; i < 6; ++i) {
    const MultiPendulum law = random_bearing(bits, 0);
    const auto end_of = [&](int parts) {
      const auto& elements = law.elements();
      std::vector<double> plays(elements.size(), 0);  // P[phi], u = clip(R P)
      std::vector<double> flats(elements.size(), 0);
      const auto sum_at = [&](double phi) {
        double x = 0;
        for (std::size_t k = 0; k < elements.size(); ++k) {
          const double play = std::clamp(plays[k], phi - elements[k].mu, phi + elements[k].mu);
          x += std::clamp(elements[k].radius * play, -elements[k].capacity, elements[k].capacity);
        }
        return x;
      };
      const std::vector<double> n = record_a_samples();
      double x = 0, v = 0, phi = 0;
      const double h = 0.1 / parts;
      for (std::size_t m = 0; m < 60; ++m)
        for (int j = 0; j < parts; ++j) {
          const double p = -0.3 * std::lerp(n[m], n[m + 1], (j + 0.5) / parts);
          // Implicit: v1 = v + h (p - g phi), x1 = x + h v1 = X(phi).
          const auto excess = [&](double f) { return x + h * (v + h * (p - standard_gravity * f)) - sum_at(f); };
          double low = phi - 1, high = phi + 1;
          for (int bisections = 0; bisections < 60; ++bisections) {
            const double middle = (low + high) / 2;
            (excess(middle) > 0 ? low : high) = middle;
          }
          phi = (low + high) / 2;
          v += h * (p - standard_gravity * phi);
          x += h * v;
          for (std::size_t k = 0; k < elements.size(); ++k)
            plays[k] = std::clamp(plays[k], phi - elements[k].mu, phi + elements[k].mu);
        }
      return x;
    };
    if (std::any_of(law.radii().begin(), law.radii().end(), [](double r) { return !(r < infinity); })) continue;
    std::vector<double> n = record_a_samples();
    n.resize(61);
    for (double& value : n) value *= 0.3;
    const Response r = integrate(law, GroundMotion(n, 0.1));
    if (count(r, EventKind::impact) > 0) continue;
    const double coarse = end_of(200), fine = end_of(400), finest = end_of(800);
    const double first = 2 * fine - coarse, second = 2 * finest - fine;
    CHECK_THAT(second, WithinAbs(r.displacement.back(), 4 * std::abs(second - first) + 1e-4 * r.peak));
    CHECK_THAT(finest, WithinAbs(r.displacement.back(), 0.01 * r.peak));
  }
}

TEST_CASE("a motion of a pendulum can be divided, and read at any time") {
  const GroundMotion motion = shaking(1, 0.1, true);
  const Slider<MultiPendulum> slider(triple);
  const Response whole = integrate(slider, motion);
  State state;
  const detail::LoadPieces pieces(motion, 0);
  for (std::size_t i = 0; i < motion.segments(); ++i) {
    LoadSegment segment = pieces.segment(i);
    advance(slider, detail::take(segment, 0.03, segment.normal(0.03)), state);
    advance(slider, segment, state);
    CHECK_THAT(state.displacement, WithinAbs(whole.displacement[i + 1], 1e-12 * whole.peak));
  }
  CHECK_THAT(sum(triple.displacements(state.pendulum)), WithinAbs(state.displacement, 1e-14));
  const std::vector<double> times{motion.time(400), motion.time(200), 12.345};
  const std::vector<State> states = states_at(slider, motion, whole, times);
  CHECK_THAT(states[0].displacement, WithinAbs(whole.displacement[400], 1e-12 * whole.peak));
  CHECK_THAT(states[1].displacement, WithinAbs(whole.displacement[200], 1e-12 * whole.peak));
  for (const State& at : states) CHECK_THAT(sum(triple.displacements(at.pendulum)), WithinAbs(at.displacement, 1e-13));
}

TEST_CASE("a pendulum starts elsewhere as if it had been pushed there") {
  const Response r = integrate(triple, GroundMotion({0, 0}, 1), from(0.3, 0, true));
  // Released from the backbone, it is stuck in the end within the levels of all elements.
  CHECK(std::abs(r.residual) < 0.3);
  CHECK_THAT(r.energy.imbalance(), WithinAbs(0, 1e-13));
  State state = State::at(0.3, 0);
  triple.begin(state);
  const std::vector<double> path{0.3};
  check_all({triple.force(state.pendulum, Direction::forward)}, {trace(triple, path).force[0]}, 1e-15);
}

TEST_CASE("bearings that the model does not cover are refused with the number") {
  CHECK_THROWS_WITH(in_series({1, 2}, {0.05}, {1, 1}), ContainsSubstring("mu must be as many as radii, 2, got 1"));
  CHECK_THROWS_WITH(in_series({1, -2}, {0.05, 0.06}, {1, 1}), ContainsSubstring("radii[1] must be positive"));
  CHECK_THROWS_WITH(in_series({1}, {0}, {1}), ContainsSubstring("mu[0] must be positive"));
  CHECK_THROWS_WITH(in_series({1}, {0.1}, {0}), ContainsSubstring("capacities[0] must be positive"));
  CHECK_THROWS_WITH(in_series({1}, {0.1}, {1}, 1.5), ContainsSubstring("restitution"));
  const auto nested = [](std::vector<double> radii, std::vector<double> mu, std::vector<double> capacities) {
    return MultiPendulum(std::move(radii), std::move(mu), std::move(capacities), 0, true);
  };
  CHECK_THROWS_WITH(nested({0.4, 0.3, 3}, {0.01, 0.04, 0.08}, {1, 1, 1}), ContainsSubstring("radii[1]"));
  CHECK_THROWS_WITH(nested({0.4, 3, 3}, {0.05, 0.04, 0.08}, {1, 1, 1}), ContainsSubstring("mu[1]"));
  CHECK_THROWS_WITH(nested({0.4, 3, 3}, {0.01, 0.04, 0.08}, {0.02, 1, 1}), ContainsSubstring("capacities[0]"));
  CHECK_THROWS_WITH(nested({0.4, 3}, {0.01, 0.04}, {1, 1}), ContainsSubstring("3 surfaces"));
  CHECK_THROWS_AS(Slider(triple, Mounting{.slope_degrees = 5}), std::invalid_argument);
  CHECK_THROWS_AS(Slider(triple, Mounting{.one_way = true}), std::invalid_argument);
  CHECK_THROWS_AS(Slider(triple, Mounting{.stops = Stops(2, 0)}), std::invalid_argument);
  CHECK(Slider(triple).mounting().stops.forward() == triple.capacity());
  CHECK_THROWS_AS(integrate(triple, GroundMotion({0, 0}, 1), from(1.2)), std::invalid_argument);
}
