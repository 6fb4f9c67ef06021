// Many Coulomb blocks in parallel, each under its own pulses.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "stickslip/lanes/row.hpp"

namespace stickslip::detail {

/// The maximum number of edges of a shape.
inline constexpr std::size_t max_edges = 16;

/// Coulomb friction without a spring, under pulses of one shape.
struct PulseLanes {
  double forward;             ///< slip level against forward sliding [m/s^2], finite
  double backward;            ///< against backward sliding [m/s^2], may be infinite
  std::vector<double> edges;  ///< times after its arrival at which a pulse changes [s], ascending
  std::vector<double> jumps;  ///< by how much, for a pulse of amplitude 1
};

/// The pulses of many members.
struct PulseStreams {
  std::vector<double> arrivals;     ///< of all members [s], each member's ending with infinity, and one more
  std::vector<double> amplitudes;   ///< [m/s^2], in the same places
  std::vector<std::int64_t> first;  ///< the place of each member's first; as many as members, padded
};

/// The times at which the motion is wanted: 0, dt, 2 dt, ... and where it goes, by time and member; with one row more
/// than times, for what lies between the last one and the end.
struct PulseHistory {
  double dt;  ///< [s]
  std::size_t times;
  double* displacement;  ///< [m]
  double* velocity;      ///< [m/s]
};

/// Moves each block from rest to the end, from one edge of its pulses or wanted time to the next: thesis (5.16) and
/// (4.51) to (4.53) with a constant n, in closed form, with one stop at most on each piece. Members are at different
/// times meanwhile.
/// @param states  become those at the end
void advance_lanes(const PulseLanes& slider, double end, const PulseStreams& pulses, const PulseHistory& history,
                   const LaneStates& states);

}  // namespace stickslip::detail
