// Many Coulomb blocks side by side, each under pulses of its own.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "lane_queue.hpp"

namespace stickslip::detail {

/// Coulomb friction without a spring, under pulses of one shape.
struct PulseLanes {
  double forward;             ///< slip level against forward sliding [m/s^2], finite
  double backward;            ///< against backward sliding [m/s^2], may be infinite
  std::vector<double> edges;  ///< times after its arrival at which a pulse changes [s], ascending
  std::vector<double> jumps;  ///< by how much, for a pulse of amplitude 1
};

/// The pulses of many members, and how far each member has come with them.
struct PulseStreams {
  std::vector<double> arrivals;    ///< of all members [s], each member's ending with infinity
  std::vector<double> amplitudes;  ///< [m/s^2], in the same places
  std::vector<std::int64_t> next;  ///< by edge and member: the place of the pulse which meets that edge next
  std::vector<double> time;        ///< by edge and member: when it does [s]
  std::vector<double> ground;      ///< ground acceleration of each member [m/s^2]
  std::size_t width = 0;           ///< members, padded
};

/// Moves each block from `from` to `until` [s], from one edge of its pulses to the next: thesis (5.16) and (4.51) to
/// (4.53) with a constant n, in closed form, one stop at most on each piece.
void advance_lanes(const PulseLanes& slider, double from, double until, PulseStreams& pulses, const LaneStates& states);

}  // namespace stickslip::detail
