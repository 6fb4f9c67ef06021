// A slider through the segments of a ground motion, one after another.
#pragma once

#include <cstddef>
#include <span>

#include "stickslip/advance.hpp"
#include "stickslip/ground_motion.hpp"
#include "stickslip/recorder.hpp"
#include "stickslip/state.hpp"

namespace stickslip::detail {

/// The motion at the samples.
struct HistorySpans {
  std::span<double> displacement, velocity;

  void keep(std::size_t sample, const State& state) const noexcept {
    displacement[sample] = state.displacement;
    velocity[sample] = state.velocity;
  }
};

/// Slides through all segments, one by one.
template <FrictionLaw Law, class Flows>
[[gnu::flatten]] void run(const Law& law, const Flows& flows, const GroundMotion& motion, State& state,
                          Recorder<Law>& recorder, const HistorySpans& histories) {
  State moving = state;
  for (std::size_t i = 0; i < motion.segments(); ++i) {
    if ((i + 1) % Recorder<Law>::work_a_beat == 0) recorder.heartbeat();
    recorder.begin_segment(motion.time(i));
    detail::advance(law, flows, motion.segment(i), moving, recorder);
    histories.keep(i + 1, moving);
  }
  state = moving;
}

}  // namespace stickslip::detail
