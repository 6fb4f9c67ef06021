// The motion of a structure whose interface never slides, under one ground motion.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "stickslip/ground/ground_motion.hpp"
#include "structure/stuck_flow.hpp"

namespace stickslip::detail {

/// Bounds of what happens in a span of time.
struct StuckSpan {
  double lowest, highest;  ///< demand, without the spring [m/s^2]
  double least_weight;     ///< N+/g
};

/// States at the samples, from rest, and certified bounds of the demand in each segment and in blocks of segments.
/// Without bounds (uneven steps, damping that is not classical, feedback of equipment, or a very stiff structure) it is
/// empty.
class StuckMotion {
 public:
  static constexpr std::size_t block = StuckFlow::most_steps;  ///< segments

  StuckMotion(const ModalInterface& of, const GroundMotion& motion);

  bool empty() const noexcept { return !flow_; }
  const StuckFlow& flow() const noexcept { return *flow_; }
  const double* state(std::size_t sample) const noexcept { return states_.data() + sample * 2 * flow_->modes(); }
  const StuckSpan& segment(std::size_t i) const noexcept { return segments_[i]; }
  const StuckSpan& block_from(std::size_t i) const noexcept { return blocks_[i / block]; }
  double largest() const noexcept { return largest_; }                ///< magnitude of a demand [m/s^2]
  double largest_weight() const noexcept { return largest_weight_; }  ///< N+/g

 private:
  std::optional<StuckFlow> flow_{};
  std::vector<double> states_{};
  std::vector<StuckSpan> segments_{}, blocks_{};
  double largest_ = 0, largest_weight_ = 1;
};

/// The lowest and the highest demand during a step, without the spring; the state is moved through it.
StuckSpan pass_step(const StuckFlow& flow, double* state, double n_start, double n_end);

/// The largest displacement of the first floor while the interface is stuck, over all time [m]; empty where StuckMotion
/// is.
std::optional<double> largest_top(const ModalInterface& of, const GroundMotion& motion);

}  // namespace stickslip::detail
