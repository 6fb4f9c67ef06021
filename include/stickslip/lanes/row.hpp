// A row of sliders that are integrated in parallel.
#pragma once

#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "stickslip/base/error.hpp"
#include "stickslip/base/min_max.hpp"
#include "stickslip/sliding/advance.hpp"

namespace stickslip::detail {

/// Rows are padded to a multiple of this number of members, so that any instruction set can use whole vectors.
inline constexpr std::size_t row_padding = 8;

/// Maximum width of a row: one bit per member in one word.
inline constexpr std::size_t max_lanes = 64;

/// The sliders' states, padded to a multiple of `row_padding`. The velocity is exactly 0 if a slider is stuck,
/// and only then; laws without memory need no other state.
struct LaneStates {
  double* displacement;  ///< x [m]
  double* velocity;      ///< x' [m/s]
  double* peak;          ///< largest |x| so far [m]
};

/// The members of a row that need further work, packed into whole vectors.
struct LaneQueue {
  alignas(64) double displacement[max_lanes];
  double velocity[max_lanes], start[max_lanes], end[max_lanes], peak[max_lanes];
  std::uint8_t lane[max_lanes];
  std::size_t count = 0;  ///< of these members; the first is repeated to fill the vectors

  /// @param members       one bit per member to take, at least one set
  /// @param ground_start  ground acceleration of each member of the row at the beginning of its segment, and
  /// @param ground_end    at its end
  LaneQueue(std::uint64_t members, const double* ground_start, const double* ground_end, const LaneStates& states) {
    std::size_t next = 0;
    const auto push = [&](std::size_t i) {
      displacement[next] = states.displacement[i];
      velocity[next] = states.velocity[i];
      start[next] = ground_start[i];
      end[next] = ground_end[i];
      peak[next] = states.peak[i];
      lane[next++] = static_cast<std::uint8_t>(i);
    };
    for (; members != 0; members &= members - 1) push(static_cast<std::size_t>(std::countr_zero(members)));
    count = next;
    while (next % row_padding != 0) push(lane[0]);
  }

  State state(std::size_t place) const noexcept { return State::at(displacement[place], velocity[place]); }
  Segment segment(std::size_t place, double duration) const noexcept { return {duration, start[place], end[place]}; }

  /// Writes the states back to the row.
  void put_back(const LaneStates& states) const {
    for (std::size_t k = 0; k < count; ++k) {
      states.displacement[lane[k]] = displacement[k];
      states.velocity[lane[k]] = velocity[k];
      states.peak[lane[k]] = peak[k];
    }
  }
};

/// Error of a slider of a row that cannot complete its segment.
struct LaneError : ConvergenceError {
  LaneError(const ConvergenceError& error, std::size_t place) : ConvergenceError(error), lane(place) {}
  std::size_t lane;
};

/// Integrate one slider of a row by the event loop for single sliders.
/// @param from  its displacement and velocity at the beginning of the segment; its peak is that of the row
/// @throws LaneError
template <FrictionLaw Law>
[[gnu::noinline]] void advance_alone(const Slider<Law>& slider, const Segment& segment, State from,
                                     const LaneStates& row, std::size_t lane) {
  struct Peak {
    double& most;
    void slide(const Slip& slip) const { most = std::max(most, std::abs(slip.to())); }
    void event(EventKind, double, const State&) const noexcept {}
  } peak{row.peak[lane]};
  try {
    advance(slider, segment, from, peak);
  } catch (const ConvergenceError& error) {
    throw LaneError(error, lane);
  }
  row.displacement[lane] = from.displacement;
  row.velocity[lane] = from.velocity;
}

}  // namespace stickslip::detail
