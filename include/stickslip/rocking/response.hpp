// The response of a block that rocks to a ground motion.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "stickslip/rocking/state.hpp"
#include "stickslip/run/response.hpp"

namespace stickslip {

/// What happens to a block.
enum class RockingEventKind : std::uint8_t {
  uplift,      ///< it starts to rock, from rest (or rocks already at the start)
  impact,      ///< its base hits the ground; the rate is that before the impact
  slip,        ///< its base or its corner starts to slip, or slips the other way
  stick,       ///< its corner stops slipping, and it rocks on
  liftoff,     ///< it leaves the ground
  landing,     ///< it comes back from flight, on a corner or on its base
  rest,        ///< it comes to rest on its base
  overturned,  ///< it is certain that it never comes back
  end          ///< the motion is over
};

struct RockingEvent {
  double time;      ///< [s]
  double rotation;  ///< theta [rad]
  double rate;      ///< theta' [rad/s]
  RockingEventKind kind;
  double rate_after = 0;    ///< theta' after an impact or a landing, else theta' [rad/s]
  double displacement = 0;  ///< of the middle of the base [m]
  double speed = 0;         ///< with which the corner arrived, downward [m/s]; of a RockingBlock
  std::int8_t side = 0;     ///< the corner that arrived, or on which it stands: +1 right, -1 left, 0 the base
};

/// The motion of a block under one ground motion.
///
/// Energies of a SlenderBlock are per unit moment of inertia about a corner [1/s^2]: `elastic` is the potential energy
/// p^2 (s alpha theta - theta^2/2) under gravity. Those of a RockingBlock are per
/// unit mass [m^2/s^2]: `elastic` is g times the rise of the center of mass, `dissipated` the work of friction. `damped` is
/// what a fall on the side takes.
struct RockingResponse {
  /// theta at the samples of the motion [rad]. With `settle`, if the block still rocks at the last sample, further
  /// samples follow with the last time step, up to the first at or after rest. Once it lies on its side, +-pi/2.
  std::vector<double> rotation;
  std::vector<double> rate;          ///< theta' at the same times [rad/s]
  std::vector<RockingEvent> events;  ///< in order of time; the last is the end
  double peak = 0;        ///< largest |theta| over all time, not only at samples [rad]; pi/2 if it overturned
  double peak_time = 0;   ///< its time; of an overturned block, that at which it is certain [s]
  double peak_ratio = 0;  ///< largest |theta| over alpha of the side; infinite if it overturned
  int overturned = 0;     ///< +1 to the right, -1 to the left, 0 if it stands
  /// When it is certain that it never comes back; NaN if it stands [s].
  double overturned_at = std::numeric_limits<double>::quiet_NaN();
  /// Of the base, and landings: those faster than 1e-3 p alpha, or 1 mm/s at a corner of a RockingBlock; the others are too
  /// many to count.
  std::size_t impacts = 0;
  std::size_t uplifts = 0;   ///< from rest
  std::size_t liftoffs = 0;  ///< into flight
  /// Impacts at which the corner slipped, so that a given restitution could not hold: they are those of a lever of 1.
  std::size_t impacts_with_slip = 0;
  /// Displacements relative to the ground at the same times [m], of a RockingBlock: of the middle of the base, and of that of
  /// the top. Empty for a SlenderBlock, which does not slide.
  std::vector<double> displacement, top_displacement;
  std::vector<double> gap;      ///< between the lower corner and the ground at the same times, in flight [m]
  double residual = 0;          ///< displacement of the base at the end: what it has slid and walked [m]
  double sliding_distance = 0;  ///< path that the base or a corner slips [m]
  double time_sliding = 0;      ///< [s]
  double time_rocking = 0;      ///< [s]
  Energy energy;
  /// How close the nearest decision was, relative to what decides: the distance from the stable manifold of the
  /// overturning at turning points beyond alpha / 2, over p alpha; that of the load from the level of uplift at its
  /// maxima at rest; infinite without a decision. If tiny, the history hangs on round-off.
  double margin = std::numeric_limits<double>::infinity();
  /// The largest |d theta / d ln scale| / alpha at the samples of the ground motion, which is scaled: an error of 1e-16
  /// of the input grows to this times 1e-16 in theta / alpha. A block that has overturned does not count. NaN for a
  /// RockingBlock: its derivatives are not computed; compare two scales.
  double condition = 0;
  bool truncated = false;  ///< as ResponseOf::truncated
  std::string components = "axis";
  RockingState state;  ///< at the end: a motion can be continued from it
};

}  // namespace stickslip
