// The members of an ensemble that are simulated and summed together.
#pragma once

#include <atomic>
#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include "stickslip/ensemble/times.hpp"
#include "stickslip/statistics/tally.hpp"

namespace stickslip::detail {

/// The members of one block, while they are simulated: takes their motion row by row.
class Block {
 public:
  Block(const EnsembleTimes& times, bool velocity_spectrum, bool ground_acceleration, const std::atomic<bool>& stopped);
  ~Block();
  Block(const Block&) = delete;
  Block& operator=(const Block&) = delete;

  const EnsembleTimes& times() const noexcept { return times_; }
  /// Members that a row has room for: a block, padded to whole vectors.
  std::size_t width() const noexcept { return width_; }

  /// The motion of all members at one time; each time in turn.
  /// @param displacement, velocity  `width()` of each; what is past the last member does not count
  void row(std::size_t time, const double* displacement, const double* velocity);

  /// The ground acceleration of one member at all times, where it is asked for; each member in turn.
  void ground(std::span<const double> acceleration);

  /// Of each member, set by who simulates.
  std::span<double> peak() noexcept { return {peak_.data(), width_}; }
  std::span<double> residual() noexcept { return {residual_.data(), width_}; }

  /// Ends the work if that is wanted; to be called every millisecond or so.
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
  bool ground_acceleration_;
  std::size_t members_ = 0, grounds_ = 0;
  std::size_t width_;
  const std::atomic<bool>& stopped_;
  std::vector<double> peak_, residual_;
  std::vector<double> central_, first_half_, marks_, velocities_;
  std::unique_ptr<Spectrum> spectrum_;
  Tally tally_;
};

}  // namespace stickslip::detail
