// A slider through a whole motion of the ground, piece by piece.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <stdexcept>
#include <utility>

#include "stickslip/detail/min_max.hpp"
#ifdef STICKSLIP_LIBRARY
#include "stickslip/detail/pieces.hpp"
#endif
#include "stickslip/detail/recorder.hpp"
#include "stickslip/ground/motion.hpp"
#include "stickslip/sliding/advance.hpp"
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

/// Under a harmonic motion slips of any law but Coulomb's without a spring come in steps.
template <Motion M, FrictionLaw Law>
using RecorderFor = Recorder<Law, std::same_as<M, HarmonicMotion> || !ConstantLevelLaw<Law>>;

/// Walks over a motion: `go(i, begin, end, segment)` for each of its segments, which last from `begin` to `end` [s],
/// and `beat()` after each `segments_a_beat` of them but the last.
template <class Go, class Beat>
[[gnu::always_inline]] inline void walk(const GroundMotion& motion, std::size_t segments_a_beat, Go&& go, Beat&& beat) {
  const GroundMotion::Pieces pieces(motion);
  const std::size_t count = motion.segments();
  double begin = pieces.time(0);
  for (std::size_t i = 0; i < count;) {
    for (const std::size_t next = std::min(i + segments_a_beat, count); i < next; ++i) {
      const double end = pieces.time(i + 1);
      go(i, std::exchange(begin, end), end, pieces.segment(i));
    }
    if (i < count) beat();
  }
}

/// Slides through all segments, one by one.
/// @tparam Recording  a RecorderFor the motion and law, or NoRecorder
template <FrictionLaw Law, class Flows, class Recording>
[[gnu::flatten]] void run(const Law& law, const Flows& flows, const GroundMotion& motion, State& state,
                          Recording& recorder, const HistorySpans& histories) {
  State moving = state;
  walk(
      motion, Recording::work_a_beat,
      [&](std::size_t i, double begin, double end, const Segment& segment) {
        recorder.begin_segment(begin, end);
        detail::advance(law, flows, segment, moving, recorder);
        histories.keep(i + 1, moving);
      },
      [&] { recorder.heartbeat(); });
  state = moving;
}

/// Calls `work` with the flows that fit the slider under a motion. All that slides under a GroundMotion comes by here.
/// @throws std::invalid_argument  a motion with a vertical component, which no slider takes yet
template <FrictionLaw Law, class Work>
void with_flows(const Slider<Law>& slider, const GroundMotion& motion, Work&& work) {
  if (motion.has_vertical())
    throw std::invalid_argument(
        "integrate: the vertical component of a ground motion cannot act on a slider yet; take one component, as "
        "motion.component(\"axis\")");
  with_flows(slider, motion.dt(), std::forward<Work>(work));
}
template <FrictionLaw Law, class Work>
void with_flows(const Slider<Law>& slider, const HarmonicMotion& motion, Work&& work) {
  with_harmonic_flows(slider, motion.omega(), motion.dt(), std::forward<Work>(work));
}

/// How many pieces a motion has at least: one a period, so that phases stay small.
inline std::size_t pieces(const GroundMotion& motion) noexcept { return motion.segments(); }
inline std::size_t pieces(const HarmonicMotion& motion) noexcept {
  return std::max(motion.segments(), static_cast<std::size_t>(motion.duration() / motion.period()));
}

template <FrictionLaw Law, class Flows>
void run(const Law& law, const Flows& flows, const HarmonicMotion& motion, State& state,
         RecorderFor<HarmonicMotion, Law>& recorder, const HistorySpans& histories) {
  std::uint32_t pieces = 0;
  const auto piece = [&](double begin, double end, double duration, double phase) {
    if (++pieces % RecorderFor<HarmonicMotion, Law>::work_a_beat == 0) recorder.heartbeat();
    recorder.begin_segment(begin, end);
    detail::advance(law, flows, HarmonicSegment{duration, motion.amplitude(), motion.omega(), phase}, state, recorder);
  };
  const bool short_steps = motion.dt() <= motion.period();
  for (std::size_t i = 0; i < motion.segments(); ++i) {
    const double begin = motion.time(i), end = motion.time(i + 1);
    if (short_steps && i + 1 < motion.segments()) {  // all of one length, as if times were not rounded
      piece(begin, end, motion.dt(), motion.phase(begin, std::fma(static_cast<double>(i), motion.dt(), -begin)));
    } else {
      for (double time = begin; time < end;) {
        const double next = std::min(time + motion.period(), end);
        piece(time, next, next - time, motion.phase(time));
        time = next;
      }
    }
    histories.keep(i + 1, state);
  }
}

/// The same with the flows that fit the slider.
template <FrictionLaw Law, Motion M, class Recording>
void run_in_order(const Slider<Law>& slider, const M& motion, State& state, Recording& recorder,
                  const HistorySpans& histories) {
  with_flows(slider, motion, [&](const auto& flows) { run(slider.law(), flows, motion, state, recorder, histories); });
}

/// The same by the quickest way there is.
template <FrictionLaw Law, Motion M, class Recording>
void run(const Slider<Law>& slider, const M& motion, State& state, Recording& recorder, const HistorySpans& histories) {
#ifdef STICKSLIP_LIBRARY
  if constexpr (std::same_as<Law, Coulomb> && std::same_as<M, GroundMotion>)
    if (worth_pieces(slider, motion)) return run_by_pieces(slider.law(), motion, state, recorder, histories);
#endif
  run_in_order(slider, motion, state, recorder, histories);
}

}  // namespace stickslip::detail
