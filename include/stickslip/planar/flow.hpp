// The expansion of a slip in the plane.
#pragma once

#include "stickslip/base/vector2.hpp"
#include "stickslip/planar/detail/along_load.hpp"
#include "stickslip/planar/detail/along_stop.hpp"
#include "stickslip/planar/detail/closed_forms.hpp"
#include "stickslip/planar/detail/creep.hpp"
#include "stickslip/planar/detail/expansion.hpp"
#include "stickslip/planar/path.hpp"
#include "stickslip/slider/slider.hpp"

namespace stickslip {

/// How a planar flow starts: moving, or from rest, under a load that exceeds the level or is equal to it.
enum class PlanarStart : unsigned char { moving, above_level, at_level };

/// Flows after which it is worth trying whether the direction of a slip follows the load, and whether its speed does.
struct PlanarPatience {
  int direction = 0, speed = 0;
};

/// A slip in the plane,
///     r'' + w a r'/u + c r' + wn^2 r = p(t),   u = |r'|,
/// in which p and the weight w = N+/g are linear in time, and a may depend on u and on the path length. Friction turns
/// with the velocity: as a function of time the motion has a singularity wherever u nearly vanishes. It has none as a
/// function of the regularized time that obeys dt = u d(tau),
///     t' = u,   r' = u v,   v' = u q - (w a + c u) v,   u' = q.v - (w a + c u) u,   q = p(t) - wn^2 r,
/// where a stop is at infinity. These equations are solved by power series in tau, which only need products. Under a
/// constant load their solutions are exponentials; a stop is closed by them as soon as the load no longer changes in
/// the time that is left.
///
/// From rest, tau begins at minus infinity. The motion is then a power series in time; where the load passes the level
/// smoothly, this series diverges (the start is an irregular singular point), and is used up to the time at which its
/// smallest term is below round-off.
/// @tparam Law  a law without memory, or one of time and speed, `resist_at(time, speed)`
template <class Law>
struct PlanarFlow : PlanarPath {
  /// Kept out of line, as TaylorFlow.
  /// @param mounting  spring, damper, pendulum
  /// @param law       as it applies from now on, a function of the path length and of the speed
  /// @param from      r at the start [m]
  /// @param moving    r' at the start [m/s]; 0 only from rest
  /// @param start     the kind of start
  /// @param side      at a circular stop: 1 if it moves along the stop in the direction of the place turned clockwise,
  ///                  -1 if in the opposite one; it slides along the stop unless it leaves at once. Otherwise 0
  /// @param lasts     for which the load is given [s], positive
  /// @param patience  updated
  [[gnu::noinline]] PlanarFlow(const Mounting& mounting, const Law& law, Vector2 from, Vector2 moving,
                               PlanarStart start, int side, const PlanarLoad& acts, double lasts,
                               PlanarPatience& patience)
      : PlanarPath(mounting, from, moving, acts, lasts) {
    if (side != 0 && detail::move_along(*this, law, side, start == PlanarStart::at_level)) {
      along_stop = true;
      return;
    }
    leaves_at_once = side != 0;
    if (start != PlanarStart::moving) {
      double misaligned = 0;
      detail::along_load(*this, law, 0, start == PlanarStart::at_level, misaligned);
    } else if (!detail::close(*this, law) && !detail::hold_load(*this, law) &&
               !detail::creep(*this, law, patience.speed) && !detail::follow(*this, law, patience.direction)) {
      detail::expand(*this, law);
    }
  }
};

}  // namespace stickslip
