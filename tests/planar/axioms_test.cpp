// What holds for every law in the plane, on every mounting.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "stickslip/core.hpp"
#include "stickslip/planar/integrate.hpp"
#include "support/catch.hpp"
#include "support/laws.hpp"
#include "support/motions.hpp"
#include "support/size.hpp"

using namespace stickslip;
using namespace test;

namespace {

struct Named {
  const char* name;
  Mounting mounting;
  bool level = true;    // no direction is distinguished
  bool weighs = false;  // the weight has a scale of its own
  double vertical = 0;  // root mean square of the vertical acceleration [m/s^2]
};

const std::vector<Named>& mountings() {
  static const std::vector<Named> list{
      {"none", {}},
      {"spring", {.natural_frequency = 4}},
      {"spring and damper", {.natural_frequency = 4, .damping = 0.5}},
      {"stop", {.natural_frequency = 2, .stops = Stops(0.04, 0.5)}},
      {"elastic stop", {.damping = 0.2, .stops = Stops(0.05, 0.9)}},
      {"dead stop", {.stops = Stops(0.02, 0)}},
      {"slope", {.natural_frequency = 3, .slope_degrees = 2}, false, true},
      {"pendulum under vertical motion", {.natural_frequency = 2.5, .pendulum = true}, true, true, 1},
      {"flight", {.natural_frequency = 1, .stops = Stops(0.2, 0.3)}, true, true, 9},
  };
  return list;
}

// The laws of `all_laws` that are the same in all directions.
template <class Work>
void for_each_isotropic_law(Work&& work) {
  const auto scaled = [](double length, double time) { return length / (time * time); };
  work(Example{"Coulomb", Coulomb(1), same,
               [=](const Coulomb& c, double l, double t) { return Coulomb(c.forward() * scaled(l, t)); }, 1e-12});
  for_each_law([&](const auto& example) {
    using Law = std::remove_cvref_t<decltype(example.law)>;
    if constexpr (IsotropicLaw<Law> && !HeatedLaw<Law>)
      if (example.law.isotropic()) work(example);
  });
}

GroundMotion ground(std::uint64_t seed, double vertical) {
  const std::size_t samples = size(60, 20);
  const GroundMotion motion(gaussian(seed, samples, 2, true), 0.05);
  std::vector<double> up;
  if (vertical != 0) {
    up = gaussian(seed + 1, samples, vertical, true);
    up.back() = 0;
  }
  return motion.with_components(gaussian(seed + 2, samples, 1.5, true), up);
}

template <class Work>
void for_each_slider(Work&& work) {
  for_each_isotropic_law([&](const auto& example) {
    for (const Named& on : mountings()) {
      INFO(example.name << ", " << on.name);
      work(example, on, PlanarSlider(example.law, on.mounting), ground(11, on.vertical));
    }
  });
}

std::vector<double> copy(std::span<const double> values) { return {values.begin(), values.end()}; }

// A motion whose components are replaced by combinations of them.
GroundMotion combined(const GroundMotion& motion, double aa, double at, double ta, double tt, double up = 1,
                      double time = 1) {
  std::vector<double> axis, transverse, vertical = copy(motion.vertical());
  for (std::size_t i = 0; i < motion.samples(); ++i) {
    axis.push_back(aa * motion.acceleration()[i] + at * motion.transverse()[i]);
    transverse.push_back(ta * motion.acceleration()[i] + tt * motion.transverse()[i]);
  }
  for (double& value : vertical) value *= up;
  return GroundMotion(axis, motion.dt() * time).with_components(transverse, vertical);
}

GroundMotion halved(const GroundMotion& motion) {
  const auto finer = [](std::span<const double> from) {
    std::vector<double> to;
    for (std::size_t i = 0; i + 1 < from.size(); ++i) {
      to.push_back(from[i]);
      to.push_back((from[i] + from[i + 1]) / 2);
    }
    if (!from.empty()) to.push_back(from.back());
    return to;
  };
  return GroundMotion(finer(motion.acceleration()), motion.dt() / 2)
      .with_components(finer(motion.transverse()), finer(motion.vertical()));
}

// Largest distance between two histories, the first one transformed.
template <class Transform>
double apart(const std::vector<Vector2>& a, const std::vector<Vector2>& b, Transform&& transform) {
  double result = a.size() == b.size() ? 0 : infinity;
  for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i)
    result = std::max(result, norm(transform(a[i]) - b[i]));
  return result;
}

// Events of the same kinds at the same times. A slip that is shorter than the tolerance may be there or not, and the
// last of infinitely many bounces, too.
bool alike(const PlanarResponse& a, const PlanarResponse& b, double tolerance, double time = 1) {
  const auto lasting = [&](const PlanarResponse& r, double unit) {
    std::vector<std::pair<EventKind, double>> kept;
    for (const PlanarEvent& e : r.events) {
      const bool pair = !kept.empty() && e.time * unit - kept.back().second <= tolerance &&
                        ((kept.back().first == EventKind::breakaway && e.kind == EventKind::arrest) ||
                         (kept.back().first == EventKind::arrest && e.kind == EventKind::breakaway));
      if (e.kind == EventKind::arrest)
        while (!kept.empty() && (kept.back().first == EventKind::impact || kept.back().first == EventKind::reversal) &&
               e.time * unit - kept.back().second < 1e-4)
          kept.pop_back();
      if (pair)
        kept.pop_back();
      else
        kept.emplace_back(e.kind, e.time * unit);
    }
    return kept;
  };
  const auto first = lasting(a, time), second = lasting(b, 1);
  return std::ranges::equal(first, second, [&](const auto& one, const auto& other) {
    return one.first == other.first && std::abs(one.second - other.second) <= tolerance;
  });
}

}  // namespace

TEST_CASE("in the plane, what the ground does on a slider is dissipated, lost in impacts, or still there",
          "[planar][axioms]") {
  for_each_slider([](const auto&, const Named& on, const auto& slider, const GroundMotion& motion) {
    for (const bool settle : {false, true}) {
      if (!settle && on.vertical > 5) continue;  // it ends in flight
      const PlanarResponse r = integrate(slider, motion, {.settle = settle});
      CHECK(r.peak > 1e-3);
      CHECK(r.energy.dissipated > 0);
      CHECK(r.energy.impact >= 0);
      CHECK(r.energy.damped >= 0);
      CHECK(std::abs(r.energy.imbalance()) <= 1e-12 * turnover(r.energy));
      CHECK(r.peak <= on.mounting.stops.forward() * (1 + 1e-14));
      CHECK(r.peak == Approx(norm(r.peak_displacement)).epsilon(1e-13));
      CHECK(r.peak <= r.sliding_distance * (1 + 1e-13));
      for (std::size_t i = 0; i < r.displacement.size(); ++i)
        CHECK_FALSE(norm(r.displacement[i]) > r.peak * (1 + 1e-14));
      if (settle) CHECK(r.state.mode == PlanarMode::stuck);
      CHECK(r.events.back().kind == EventKind::end);
      CHECK(std::ranges::is_sorted(r.events, {}, &PlanarEvent::time));
    }
  });
}

TEST_CASE("in the plane, rotated and mirrored ground rotates and mirrors the motion", "[planar][axioms]") {
  for_each_slider([](const auto& example, const Named& on, const auto& slider, const GroundMotion& motion) {
    const PlanarResponse one = integrate(slider, motion, {.settle = true});
    const auto compare = [&](double aa, double at, double ta, double tt) {
      const PlanarResponse other = integrate(slider, combined(motion, aa, at, ta, tt), {.settle = true});
      const auto transform = [&](Vector2 r) {
        return Vector2{aa * r.axis + at * r.transverse, ta * r.axis + tt * r.transverse};
      };
      CHECK(apart(one.displacement, other.displacement, transform) <= 100 * example.accuracy * one.peak);
      CHECK(apart(one.velocity, other.velocity, transform) <= 1e-9);
      CHECK(alike(one, other, 1e-7));
      CHECK(one.peak == Approx(other.peak).epsilon(100 * example.accuracy));
      CHECK(one.sliding_distance == Approx(other.sliding_distance).epsilon(100 * example.accuracy));
    };
    compare(1, 0, 0, -1);
    if (!on.level) return;
    compare(0, -1, 1, 0);
    compare(std::cos(1.0), -std::sin(1.0), std::sin(1.0), std::cos(1.0));
  });
}

TEST_CASE("in the plane, lengths and times that are measured in other units change nothing else", "[planar][axioms]") {
  for_each_slider([](const auto& example, const Named& on, const auto& slider, const GroundMotion& motion) {
    if constexpr (!std::is_same_v<std::remove_cvref_t<decltype(example.scale)>, std::nullptr_t>) {
      if (on.weighs) return;
      const double length = 8, time = 0.5;  // powers of two: no rounding
      const double acceleration = length / (time * time);
      Mounting scaled = on.mounting;
      scaled.natural_frequency /= time;
      scaled.damping /= time;
      if (const Stops s = scaled.stops) scaled.stops = Stops(s.forward() * length, s.restitution());
      const GroundMotion there = combined(motion, acceleration, 0, 0, acceleration, 1, time);
      const PlanarResponse one = integrate(slider, motion);
      const PlanarResponse other = integrate(PlanarSlider(example.scale(example.law, length, time), scaled), there);
      CHECK(apart(one.displacement, other.displacement, [&](Vector2 r) { return length * r; }) <=
            example.accuracy * other.peak);
      CHECK(alike(one, other, 1e-7, time));
    }
  });
}

TEST_CASE("in the plane, a ground motion may be cut anywhere", "[planar][axioms]") {
  for_each_slider([](const auto& example, const Named&, const auto& slider, const GroundMotion& motion) {
    const PlanarIntegrateOptions options{.settle = true};
    const PlanarResponse one = integrate(slider, motion, options), other = integrate(slider, halved(motion), options);
    double apart = 0;
    for (std::size_t i = 0; i < motion.samples(); ++i)
      apart = std::max(apart, norm(one.displacement[i] - other.displacement[2 * i]));
    CHECK(apart <= 100 * example.accuracy * one.peak);
    CHECK(norm(one.residual - other.residual) <= 100 * example.accuracy * one.peak);
    CHECK(alike(one, other, 1e-7));
  });
}

TEST_CASE("along one line, a slider in the plane is a slider on one axis", "[planar][axioms]") {
  for_each_slider([](const auto& example, const Named& on, const auto& slider, const GroundMotion& motion) {
    const GroundMotion axis =
        GroundMotion(copy(motion.acceleration()), motion.dt()).with_components({}, copy(motion.vertical()));
    const Response one = integrate(slider.along_axis(), axis, {.settle = true});
    const double away = 100 * example.accuracy * one.peak;
    for (const Vector2 direction : {Vector2{1, 0}, Vector2{-0.6, 0.8}}) {
      if (!on.level && direction.axis < 0) continue;
      INFO("along (" << direction.axis << ", " << direction.transverse << ")");
      const PlanarResponse both =
          integrate(slider, combined(motion, direction.axis, 0, direction.transverse, 0), {.settle = true});
      REQUIRE(both.displacement.size() == one.displacement.size());
      double apart = 0, faster = 0;
      for (std::size_t i = 0; i < one.displacement.size(); ++i) {
        apart = std::max(apart, norm(both.displacement[i] - one.displacement[i] * direction));
        faster = std::max(faster, norm(both.velocity[i] - one.velocity[i] * direction));
      }
      CHECK(apart <= away);
      CHECK(faster <= 1e-9);
      CHECK(both.peak == Approx(one.peak).epsilon(1e-10));
      CHECK(both.sliding_distance == Approx(one.sliding_distance).epsilon(1e-10));
      CHECK(both.energy.dissipated == Approx(one.energy.dissipated).epsilon(1e-10));
      CHECK(both.energy.input == Approx(one.energy.input).margin(1e-10 * turnover(one.energy)));
      CHECK(both.energy.impact == Approx(one.energy.impact).margin(1e-10 * turnover(one.energy)));
      CHECK(both.energy.damped == Approx(one.energy.damped).margin(1e-10 * turnover(one.energy)));
      // At an oblique stop, round-off leaves a speed along it: there, a reversal is none.
      if (on.mounting.stops && direction.axis < 0) continue;
      PlanarResponse events;
      for (const Event& e : one.events) events.events.push_back({e.time, {}, {}, e.kind});
      CHECK(alike(events, both, 1e-7));
    }
  });
}

TEST_CASE("in the plane, what the ground does later changes nothing before", "[planar][axioms]") {
  for_each_slider([](const auto&, const Named& on, const auto& slider, const GroundMotion& motion) {
    if (on.vertical > 5) return;
    const std::size_t kept = motion.samples() / 2;
    const auto first = [&](std::span<const double> all) {
      return std::vector<double>(all.begin(),
                                 all.empty() ? all.end() : all.begin() + static_cast<std::ptrdiff_t>(kept));
    };
    const GroundMotion before = GroundMotion(first(motion.acceleration()), motion.dt())
                                    .with_components(first(motion.transverse()), first(motion.vertical()));
    const PlanarResponse one = integrate(slider, before), other = integrate(slider, motion);
    for (std::size_t i = 0; i < kept; ++i) {
      CHECK(one.displacement[i] == other.displacement[i]);
      CHECK(one.velocity[i] == other.velocity[i]);
    }
  });
}

TEST_CASE("in the plane, segment by segment is as at one time", "[planar][axioms]") {
  for_each_slider([](const auto&, const Named& on, const auto& slider, const GroundMotion& motion) {
    if (on.vertical > 5) return;
    const PlanarResponse one = integrate(slider, motion);
    PlanarState state;
    const detail::PlanarPieces pieces(motion, slider.slope());
    bool same = true;
    for (std::size_t i = 0; i < motion.segments(); ++i) {
      advance(slider, pieces.segment(i), state);
      same = same && state.displacement == one.displacement[i + 1] && state.velocity == one.velocity[i + 1];
    }
    CHECK(same);
    CHECK(state.sliding_distance == Approx(one.sliding_distance).epsilon(1e-14));
  });
}
