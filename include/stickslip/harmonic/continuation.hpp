// Continuation of a branch of periodic motions over the frequency of the ground motion.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <iterator>
#include <limits>
#include <numbers>
#include <optional>
#include <type_traits>
#include <utility>
#include <vector>

#include "stickslip/base/equal.hpp"
#include "stickslip/base/error.hpp"
#include "stickslip/harmonic/orbit.hpp"
#include "stickslip/harmonic/orbits.hpp"
#include "stickslip/slider/slider.hpp"
#include "stickslip/sliding/response.hpp"
#include "stickslip/state/state.hpp"

namespace stickslip {

/// A connected branch of orbits along the response curve.
struct OrbitBranch {
  std::vector<Orbit> orbits;       ///< in order along the curve
  std::vector<std::size_t> folds;  ///< indices of the orbits at which the curve turns back in frequency
};

struct ContinuationOptions {
  double max_step = 0.05;  ///< largest relative change of state and frequency from orbit to orbit, up to 0.5
  double max_amplitude = std::numeric_limits<double>::infinity();  ///< the branch ends above this [m]
  std::size_t max_orbits = 10'000;                                 ///< in each direction
  std::function<void()> progress{};                                ///< called at each step; may throw to stop the work
};

namespace detail {

/// Follows one curve of orbits over the frequency by pseudo-arclength continuation: Newton's method seeks the next
/// orbit on a plane perpendicular to the tangent of the curve. The frequency may turn back along the curve.
template <FrictionLaw Law>
class BranchFollower {
 public:
  BranchFollower(const Slider<Law>& slider, double load, double low, double high, const ContinuationOptions& options)
      : slider_(slider), load_(load), low_(low), high_(high), options_(options) {}

  /// Compute the orbits after `first`, which is not included. The frequency initially rises for way = 1 and falls for
  /// way = -1.
  OrbitBranch follow(const Orbit& first, double way) const {
    OrbitBranch branch;
    Point last = point_on(first);
    Vector direction = tangent(last, {0, 0, way});
    double step = options_.max_step / 16;
    while (branch.orbits.size() < options_.max_orbits) {
      if (options_.progress) options_.progress();
      const auto next = try_correct(last, direction, step);
      if (!next) {
        step /= 2;
        if (step < shortest_step * options_.max_step) break;  // the branch ends here or cannot be followed
        continue;
      }
      const double omega = next->omega();
      if (omega < low_ || omega > high_) {  // the last orbit lies exactly at the end of the range
        if (auto end = at_frequency(*next, std::clamp(omega, low_, high_), last))
          branch.orbits.push_back(std::move(*end));
        break;
      }
      Orbit orbit = describe(*next);
      if (!(orbit.amplitude > 0 && orbit.amplitude <= options_.max_amplitude)) break;
      const Vector onward = tangent(*next, direction);
      const double bend = dot(onward, direction);
      if (bend < 0.95 && step > 0x1p-6 * options_.max_step) {
        step /= 2;
        continue;
      }
      if (onward[2] * direction[2] < 0 || (equal(onward[2], 0) && !equal(direction[2], 0))) {
        if (auto fold = find_fold(last, direction, step)) {
          branch.folds.push_back(branch.orbits.size());
          branch.orbits.push_back(describe(*fold));
        }
      }
      const bool closed = branch.orbits.size() > 8 && close(orbit, first);
      branch.orbits.push_back(orbit);
      if (closed) break;
      // The phase moves with the orbit, so that no turning point reaches the phase at which the state is compared.
      const Point moved = point_on(orbit);
      direction = tangent(moved, secant(last, moved));
      last = moved;
      if (bend > 0.99) step = std::min(1.5 * step, options_.max_step);
    }
    return branch;
  }

 private:
  using Vector = std::array<double, 3>;  // x/scale, x'/(omega scale), log omega
  static constexpr double shortest_step = 1e-6;

  struct Point {
    double phase, scale;
    Vector y;
    double omega() const noexcept { return std::exp(y[2]); }
    State state() const noexcept { return State::at(y[0] * scale, y[1] * scale * omega()); }
  };

  static double dot(const Vector& a, const Vector& b) noexcept { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
  static Vector cross(const Vector& a, const Vector& b) noexcept {
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
  }

  template <class Work>
  auto at(double omega, Work&& work) const {
    return with_finder(slider_, load_, omega, std::forward<Work>(work));
  }

  /// The state a quarter of a period after the slider has left its maximum x.
  Point point_on(const Orbit& orbit) const {
    constexpr double quarter = std::numbers::pi / 2;
    double high = -std::numeric_limits<double>::infinity(), time = 0;
    for (const Event& e : orbit.events)
      if (e.kind != EventKind::arrest && e.displacement > high) high = e.displacement, time = e.time;
    const double phase = orbit.omega * time + quarter;
    const State state = at(orbit.omega, [&](const auto& finder) { return finder.after({0, orbit.state}, phase); });
    return {phase,
            orbit.amplitude,
            {state.displacement / orbit.amplitude, state.velocity / (orbit.omega * orbit.amplitude),
             std::log(orbit.omega)}};
  }

  struct Equations {
    Vector miss{};        // mismatches of x and x', then 0
    Vector rows[2] = {};  // gradients of the mismatches with respect to Point::y
  };

  std::array<double, 2> miss(const Point& point) const {
    return at(point.omega(), [&](const auto& finder) {
      const typename std::remove_cvref_t<decltype(finder)>::Place place{point.phase, point.state()};
      const auto m = finder.miss(place, finder.after(place, std::numbers::pi), point.scale);
      return std::array{m.x, m.v};
    });
  }

  Equations equations(const Point& point) const {
    Equations result = at(point.omega(), [&](const auto& finder) {
      const double omega = point.omega();
      const typename std::remove_cvref_t<decltype(finder)>::Place place{point.phase, point.state()};
      Variation variation(place.state);
      const auto m = finder.miss(place, finder.after(place, std::numbers::pi, variation), point.scale);
      const auto [xx, xv, vx, vv] = variation.matrix;
      Equations e;
      e.miss = {m.x, m.v, 0};
      e.rows[0] = {1 + xx, xv * omega, 0};
      e.rows[1] = {vx / omega, 1 + vv, 0};
      return e;
    });
    // Finite differences suffice: the derivative only determines the direction of steps, while the accuracy of an orbit
    // depends on the mismatch alone.
    constexpr double little = 1e-6;
    Point more = point, less = point;
    more.y[2] += little;
    less.y[2] -= little;
    const auto up = miss(more), down = miss(less);
    for (const std::size_t i : {0u, 1u}) result.rows[i][2] = (up[i] - down[i]) / (2 * little);
    return result;
  }

  // Unit tangent of the curve, oriented along `onward`.
  Vector tangent(const Point& point, const Vector& onward) const {
    const Equations e = equations(point);
    Vector t = cross(e.rows[0], e.rows[1]);
    const double size = std::copysign(std::sqrt(dot(t, t)), dot(t, onward));
    for (double& c : t) c /= size;
    return t;
  }

  // The orbit on the plane perpendicular to `direction` at the distance `step`.
  std::optional<Point> correct(const Point& from, const Vector& direction, double step) const {
    Point point = from;
    for (std::size_t i = 0; i < 3; ++i) point.y[i] += step * direction[i];
    double before = std::numeric_limits<double>::infinity();
    for (int steps = 0; steps < 12; ++steps) {
      const Equations e = equations(point);
      const double size = std::max(std::abs(e.miss[0]), std::abs(e.miss[1]));
      if (size <= 1e-13 || (size <= 1e-11 && size >= before)) return point;
      if (!(size < 4 * before)) return std::nullopt;
      before = size;
      // rows . change = -miss, direction . change = 0
      const Vector n = cross(e.rows[0], e.rows[1]), first = cross(e.rows[1], direction),
                   second = cross(direction, e.rows[0]);
      const double determinant = dot(n, direction);
      double length = 0;
      for (std::size_t i = 0; i < 3; ++i) {
        const double change = -(e.miss[0] * first[i] + e.miss[1] * second[i]) / determinant;
        point.y[i] += change;
        length = std::max(length, std::abs(change));
      }
      if (!(length <= 2 * step + 1e-9)) return std::nullopt;
    }
    return std::nullopt;
  }

  // Near resonance the amplitude of a caster's orbits tends to infinity, and the integration eventually fails.
  std::optional<Point> try_correct(const Point& from, const Vector& direction, double step) const {
    try {
      return correct(from, direction, step);
    } catch (const ConvergenceError&) {
      return std::nullopt;
    }
  }

  // The fold between two orbits: the point at which the frequency component of the tangent is zero.
  std::optional<Point> find_fold(const Point& from, const Vector& direction, double step) const {
    double low = 0, high = step, low_value = direction[2], high_value = 0;
    std::optional<Point> best = correct(from, direction, high);
    if (!best) return std::nullopt;
    high_value = tangent(*best, direction)[2];
    for (int i = 0; i < 40 && high - low > 1e-9 * step; ++i) {
      const double part = std::clamp(low_value / (low_value - high_value), 0.1, 0.9);
      const double middle = low + (high - low) * part;
      const auto point = correct(from, direction, middle);
      if (!point) return std::nullopt;
      const double value = tangent(*point, direction)[2];
      ((value > 0) == (low_value > 0) ? low : high) = middle;
      ((value > 0) == (low_value > 0) ? low_value : high_value) = value;
      best = point;
      if (std::abs(value) < 1e-9) break;
    }
    return best;
  }

  std::optional<Orbit> at_frequency(const Point& near, double omega, const Point& last) const {
    // The initial guess lies on the straight line between the two points.
    Point point = near;
    const double part = (std::log(omega) - last.y[2]) / (near.y[2] - last.y[2]);
    for (std::size_t i = 0; i < 3; ++i) point.y[i] = last.y[i] + part * (near.y[i] - last.y[i]);
    return at(omega, [&](const auto& finder) -> std::optional<Orbit> {
      const auto place = finder.shoot({point.phase, point.state()}, point.scale);
      if (!place) return std::nullopt;
      return finder.describe(*place);
    });
  }

  Orbit describe(const Point& point) const {
    return at(point.omega(), [&](const auto& finder) { return finder.describe({point.phase, point.state()}); });
  }

  // The difference from `last` to `point`, both at the phase of `point`.
  Vector secant(const Point& last, const Point& point) const {
    const State state = at(last.omega(), [&](const auto& finder) {
      constexpr double cycle = 2 * std::numbers::pi;
      const double on = point.phase - last.phase;
      return finder.after({last.phase, last.state()}, on - cycle * std::floor(on / cycle));
    });
    return {point.y[0] - state.displacement / point.scale, point.y[1] - state.velocity / (last.omega() * point.scale),
            point.y[2] - last.y[2]};
  }

  bool close(const Orbit& one, const Orbit& other) const noexcept {
    return std::abs(std::log(one.omega / other.omega)) < options_.max_step / 2 &&
           std::abs(one.amplitude / other.amplitude - 1) < options_.max_step / 2 &&
           std::abs(std::remainder(one.phase - other.phase, 2 * std::numbers::pi)) < options_.max_step / 2;
  }

  const Slider<Law>& slider_;
  double load_, low_, high_;
  const ContinuationOptions& options_;
};

}  // namespace detail

/// Follow the branch of the response curve through a given orbit, by pseudo-arclength continuation over the frequency.
/// The continuation passes folds and follows the unstable orbits beyond them.
///
/// @param slider   the slider of the orbit `from`
/// @param from     the orbit to start from, not at rest
/// @param low      minimum frequency [rad/s], positive; the frequency of `from` lies between `low` and `high`
/// @param high     maximum frequency [rad/s]
/// @param options  step size and limits
/// @return `from` and the orbits on both sides of it, up to where the branch leaves the frequency range, ends, or
///         closes; folds are orbits of the branch
/// @throws std::invalid_argument  a value out of its range
/// Each orbit takes about fifteen half periods of motion: 20 to 40 us with constant friction, 1 to 4 ms for a caster.
/// Reference: H. B. Keller, Numerical solution of bifurcation and nonlinear eigenvalue problems (1977).
template <FrictionLaw Law>
OrbitBranch continuation(const Slider<Law>& slider, const Orbit& from, double low, double high,
                         const ContinuationOptions& options = {}) {
  const auto balanced = detail::balanced(slider);
  detail::check_orbit_arguments(balanced.slider, from.load, from.omega, "continuation");
  detail::require(!from.at_rest(), "continuation: the orbit it begins with must move, its amplitude", from.amplitude,
                  "m");
  detail::require(low > 0 && low <= from.omega, "continuation: low must be positive and at most the orbit's omega", low,
                  "rad/s");
  detail::require(std::isfinite(high * high) && high >= from.omega,
                  "continuation: high must be finite and at least the orbit's omega", high, "rad/s");
  detail::require(options.max_step > 0 && options.max_step <= 0.5,
                  "continuation: max_step must be positive and at most 0.5", options.max_step);
  const detail::BranchFollower<Law> follower(balanced.slider, from.load, low, high, options);
  const Orbit start = detail::moved(from, -balanced.center);
  OrbitBranch falling = follower.follow(start, -1), rising = follower.follow(start, 1), branch;
  const std::size_t before = falling.orbits.size();
  for (const std::size_t fold : falling.folds) branch.folds.push_back(before - 1 - fold);
  std::reverse(branch.folds.begin(), branch.folds.end());
  branch.orbits.assign(std::make_move_iterator(falling.orbits.rbegin()),
                       std::make_move_iterator(falling.orbits.rend()));
  branch.orbits.push_back(start);
  for (const std::size_t fold : rising.folds) branch.folds.push_back(before + 1 + fold);
  std::move(rising.orbits.begin(), rising.orbits.end(), std::back_inserter(branch.orbits));
  for (Orbit& orbit : branch.orbits) orbit = detail::moved(std::move(orbit), balanced.center);
  return branch;
}

template <FrictionLaw Law>
OrbitBranch continuation(const Law& law, const Orbit& from, double low, double high,
                         const ContinuationOptions& options = {}) {
  return continuation(Slider<Law>(law), from, low, high, options);
}

}  // namespace stickslip

#ifdef STICKSLIP_LIBRARY  // the linked library contains these
#include "stickslip/friction/caster.hpp"
#include "stickslip/friction/coulomb.hpp"

namespace stickslip {
extern template OrbitBranch continuation(const Slider<Coulomb>&, const Orbit&, double, double,
                                         const ContinuationOptions&);
extern template OrbitBranch continuation(const Slider<Caster>&, const Orbit&, double, double,
                                         const ContinuationOptions&);
}  // namespace stickslip
#endif
