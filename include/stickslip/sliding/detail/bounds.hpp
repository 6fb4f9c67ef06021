// The bounds on displacement: stops, and sliding that is restricted to one direction.
#pragma once

#include <cmath>

#include "stickslip/base/equal.hpp"
#include "stickslip/base/min_max.hpp"
#include "stickslip/flow/closed_form.hpp"
#include "stickslip/ground/segment.hpp"
#include "stickslip/slider/stops.hpp"
#include "stickslip/state/state.hpp"

namespace stickslip::detail {

/// No stops; the slider can move both ways.
struct Unbounded {
  static constexpr bool bounded = false;

  static constexpr double room(Direction, double) noexcept { return never; }
  static constexpr double bound(Direction, double, double level) noexcept { return level; }
  static constexpr double wall(Direction) noexcept { return never; }
  static constexpr double restitution() noexcept { return 0; }
  static constexpr bool has_struck() noexcept { return false; }
  static constexpr bool at_struck_wall() noexcept { return false; }
  static constexpr void strike(Direction) noexcept {}
  static constexpr void move(Direction, double) noexcept {}
};

/// Stops, and sliding that may be restricted to one direction.
class Bounds {
 public:
  static constexpr bool bounded = true;

  Bounds(const Stops& stops, bool one_way) noexcept : stops_(stops), one_way_(one_way) {}

  double wall(Direction direction) const noexcept {
    return direction == Direction::forward ? stops_.forward() : -stops_.backward();
  }
  double restitution() const noexcept { return stops_.restitution(); }

  /// Distance to the wall [m]. After an impact, the distance from that wall is tracked without cancellation.
  double room(Direction direction, double x) const noexcept {
    return has_struck() && direction == struck_ ? from_wall_ : from(direction, x);
  }
  /// The load that can be held at x: the friction level, or any load at a wall.
  double bound(Direction direction, double x, double level) const noexcept {
    return from(direction, x) <= 0 || (one_way_ && direction == Direction::backward) ? never : level;
  }

  /// Record an impact on the wall in a direction, or a distance slid [m].
  bool has_struck() const noexcept { return from_wall_ >= 0; }
  bool at_struck_wall() const noexcept { return equal(from_wall_, 0); }
  void strike(Direction direction) noexcept {
    struck_ = direction;
    from_wall_ = 0;
  }
  void move(Direction direction, double way) noexcept {
    if (has_struck()) from_wall_ += direction == struck_ ? -way : way;
  }

  /// Whether a slider on a spring of stiffness k per unit mass, which its law accelerates by at most `push`, certainly
  /// stays between the bounds during a segment of duration T. Friction and dampers only reduce the speed, so that |v|
  /// <= |v0| + T (|p| + push + k (|x0| + D)), and the distance D from x0 is at most
  ///     D = T (|v0| + T/2 (|p| + push + k |x0|)) / (1 - k T^2 / 2).
  template <class Place>
  bool out_of_reach(const LoadSegment& segment, double k, double push, const Place& state) const noexcept {
    const double nearest = one_way_ ? 0 : std::min(stops_.forward(), stops_.backward());
    if (!(nearest < never)) return true;
    const double x = std::abs(state.displacement), time = segment.duration;
    const double load = std::max(std::abs(segment.load_start), std::abs(segment.load_end)) + k * x + push;
    const double way = time * (std::abs(state.velocity) + time / 2 * load), shrinks = k * time * time / 2;
    return shrinks < 0.5 && x + 2 * way < nearest;
  }

 private:
  double from(Direction direction, double x) const noexcept { return sign(direction) * (wall(direction) - x); }

  Stops stops_;
  bool one_way_;
  Direction struck_ = Direction::forward;
  double from_wall_ = -1;  // from the wall that was struck last [m]
};

/// The bounces of a slider that leaves a stop at speed u while a constant net load q pushes it back, against friction
/// a < q. Each bounce multiplies the speed by rho = e sqrt((q - a) / (q + a)), so that infinitely many take a finite
/// time.
struct Bounces {
  double time;      ///< total time of all bounces [s]
  double distance;  ///< total distance of all bounces [m]

  Bounces(double u, double q, double a, double restitution) noexcept {
    const double k = std::sqrt((q - a) / (q + a)), rho = restitution * k;
    time = u * (1 + 1 / k) / ((q + a) * (1 - rho));
    distance = u * u / ((q + a) * (1 - rho * rho));
  }
};

}  // namespace stickslip::detail
