// The members of an ensemble that are simulated and summed together.
#pragma once

#include <atomic>
#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include "stickslip/ensemble/smallest_gaps.hpp"
#include "stickslip/ensemble/times.hpp"
#include "stickslip/sliding/impacts.hpp"
#include "stickslip/statistics/tally.hpp"

namespace stickslip::detail {

/// Collects the motion of the members of one block, row by row, while they are simulated.
class Block {
 public:
  Block(const EnsembleTimes& times, bool velocity_spectrum, bool ground_acceleration, const std::atomic<bool>& stopped,
        bool in_plane = false);
  ~Block();
  Block(const Block&) = delete;
  Block& operator=(const Block&) = delete;

  const EnsembleTimes& times() const noexcept { return times_; }
  /// Capacity of a row, in members: a block, padded to whole SIMD vectors.
  std::size_t width() const noexcept { return width_; }

  /// Add the motion of all members at one time; call it for each time in order.
  /// @param displacement, velocity  `width()` values each; values past the last member are ignored
  void row(std::size_t time, const double* displacement, const double* velocity);

  /// Displacements and velocities of all members in one direction.
  struct Motions {
    const double *displacement, *velocity;
  };
  /// The same for members in the plane.
  void row(std::size_t time, const Motions& along_axis, const Motions& transverse);

  /// Add the ground acceleration of one member at all times, if requested; call it for each member in order.
  void ground(std::span<const double> acceleration);

  /// Peak and residual per member; written by the simulator.
  std::span<double> peak() noexcept { return {peak_.data(), width_}; }
  std::span<double> residual() noexcept { return {residual_.data(), width_}; }
  /// The transverse component of the residual; empty on one axis.
  std::span<double> residual_transverse() noexcept { return residual_transverse_; }

  /// Enter the impacts of a member whose slider has stops.
  void impacts(std::size_t member, const SmallestGaps& gaps, const Impacts& impacts);
  /// Enter the peaks of the floors of a member that is a structure, as in Ensemble::Kept.
  /// @throws std::invalid_argument  another number of floors than the structures before it
  void floors(std::size_t member, std::span<const double> peaks);
  /// Count a member that ends in flight.
  void ends_airborne() noexcept { ++airborne_; }

  /// Impacts per member; empty if no slider of the block has stops.
  std::span<const Impacts> impacts() const noexcept { return impacts_; }
  /// Peaks of the floors, member by member; empty if no member of the block is a structure.
  std::span<const double> floor_peaks() const noexcept { return floor_peaks_; }
  const SmallestGaps& gaps() const noexcept { return gaps_; }
  std::size_t airborne() const noexcept { return airborne_; }

  /// Throw `Stopped` if the run has been stopped; call it about every millisecond.
  void check_stopped() const {
    if (stopped_.load(std::memory_order_relaxed)) throw Stopped{};
  }
  struct Stopped {};

  void begin(std::size_t members);
  /// The sums of the block.
  Tally finish();

 private:
  struct Spectrum;
  EnsembleTimes times_;
  bool ground_acceleration_, in_plane_;
  std::size_t members_ = 0, grounds_ = 0;
  std::size_t width_;
  const std::atomic<bool>& stopped_;
  std::vector<double> peak_, residual_, residual_transverse_;
  std::vector<Impacts> impacts_;
  std::vector<double> floor_peaks_;
  SmallestGaps gaps_;
  std::size_t airborne_ = 0;
  std::vector<double> central_, first_half_, marks_, velocities_;
  std::unique_ptr<Spectrum> spectrum_;
  Tally tally_;
};

}  // namespace stickslip::detail
