// Integrate a slider over a whole ground motion, segment by segment.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>

#include "stickslip/base/min_max.hpp"
#ifdef STICKSLIP_LIBRARY
#include "stickslip/sliding/detail/pieces.hpp"
#endif
#include "stickslip/ground/motion.hpp"
#include "stickslip/sliding/advance.hpp"
#include "stickslip/sliding/detail/recorder.hpp"
#include "stickslip/state.hpp"

namespace stickslip::detail {

/// Where the response at the samples is written.
struct HistorySpans {
  std::span<double> displacement, velocity;
  std::span<double> gap{};          // empty if the slider cannot leave the ground
  std::span<double> temperature{};  // empty if friction does not depend on it

  template <FrictionLaw Law>
  void keep(std::size_t sample, const Law& law, const StateOf<Law>& state) const noexcept {
    displacement[sample] = state.displacement;
    velocity[sample] = state.velocity;
    if constexpr (HeatedLaw<Law>)
      if (!temperature.empty()) temperature[sample] = law.temperature(state);
  }
};

/// Under a harmonic motion, slips come in several steps for every law but Coulomb friction without a spring.
template <Motion M, FrictionLaw Law>
using RecorderFor = Recorder<Law, std::same_as<M, HarmonicMotion> || form_of<Law> != Form::constant>;

/// Iterate over the segments of a motion: call `go(i, begin, end, segment)` for each segment, from `begin` to `end`
/// [s], and `report()` after every `segments_per_report` segments, except after the last one.
template <class Pieces, class Go, class Report>
[[gnu::always_inline]] inline void walk(const Pieces& pieces, std::size_t count, std::size_t segments_per_report,
                                        Go&& go, Report&& report) {
  double begin = pieces.time(0);
  for (std::size_t i = 0; i < count;) {
    for (const std::size_t next = std::min(i + segments_per_report, count); i < next; ++i) {
      const double end = pieces.time(i + 1);
      go(i, std::exchange(begin, end), end, pieces.segment(i));
    }
    if (i < count) report();
  }
}

template <class Go, class Report>
[[gnu::always_inline]] inline void walk(const GroundMotion& motion, std::size_t segments_per_report, Go&& go,
                                        Report&& report) {
  walk(GroundMotion::Pieces(motion), motion.segments(), segments_per_report, go, report);
}

/// Integrate over all segments in order.
/// @tparam RecorderType  a RecorderFor the motion and law, or NoRecorder
template <FlowMaker Flows, class RecorderType>
[[gnu::flatten]] void run(const Flows& flows, const GroundMotion& motion, State& state, RecorderType& recorder,
                          const HistorySpans& histories) {
  typename Flows::Place moving(state);
  walk(
      GroundMotion::Pieces(motion), motion.segments(), RecorderType::work_per_report,
      [&](std::size_t i, double begin, double end, const Segment& segment) {
        recorder.begin_segment(begin, end);
        detail::advance(flows, segment, moving, recorder);
        histories.keep(i + 1, flows.law(), moving);
      },
      [&] { recorder.report_progress(); });
  store(moving, state);
}

/// Call `work` with the flows that suit the slider under a motion.
template <FrictionLaw Law, class Work>
void with_flows(const Slider<Law>& slider, const GroundMotion& motion, Work&& work) {
  with_flows(slider, motion.dt(), std::forward<Work>(work));
}
template <FrictionLaw Law, class Work>
void with_flows(const Slider<Law>& slider, const HarmonicMotion& motion, Work&& work) {
  with_harmonic_flows(slider, motion.omega(), motion.dt(), std::forward<Work>(work));
}

/// Minimum number of segments into which a motion is split: for a harmonic motion at least one per period, so that
/// phases stay small.
inline std::size_t pieces(const GroundMotion& motion) noexcept { return motion.segments(); }
inline std::size_t pieces(const HarmonicMotion& motion) noexcept {
  return std::max(motion.segments(), static_cast<std::size_t>(motion.duration() / motion.period()));
}

template <FlowMaker Flows, class RecorderType>
void run(const Flows& flows, const HarmonicMotion& motion, State& state, RecorderType& recorder,
         const HistorySpans& histories) {
  typename Flows::Place moving(state);
  std::uint32_t pieces = 0;
  const auto piece = [&](double begin, double end, double duration, double phase) {
    if (++pieces % RecorderType::work_per_report == 0) recorder.report_progress();
    recorder.begin_segment(begin, end);
    detail::advance(flows, HarmonicSegment{duration, motion.amplitude(), motion.omega(), phase}, moving, recorder);
  };
  const bool short_steps = motion.dt() <= motion.period();
  for (std::size_t i = 0; i < motion.segments(); ++i) {
    const double begin = motion.time(i), end = motion.time(i + 1);
    if (short_steps && i + 1 < motion.segments()) {  // equal durations, without the rounding of the times
      piece(begin, end, motion.dt(), motion.phase(begin, std::fma(static_cast<double>(i), motion.dt(), -begin)));
    } else {
      for (double time = begin; time < end;) {
        const double next = std::min(time + motion.period(), end);
        piece(time, next, next - time, motion.phase(time));
        time = next;
      }
    }
    histories.keep(i + 1, flows.law(), moving);
  }
  store(moving, state);
}

/// The load and normal force of a slider on a slope under a ground motion.
class LoadPieces {
 public:
  LoadPieces(const GroundMotion& motion, double slope) noexcept
      : pieces_(motion),
        up_(motion.vertical()),
        next_(motion.interpolation() == Interpolation::linear ? 1 : 0),
        slope_(slope) {}

  double time(std::size_t i) const noexcept { return pieces_.time(i); }
  LoadSegment segment(std::size_t i) const noexcept {
    if (up_.empty()) return load_segment(pieces_.segment(i), slope_);
    return load_segment(pieces_.segment(i), slope_, up_[i], up_[i + next_]);
  }

 private:
  GroundMotion::Pieces pieces_;
  std::span<const double> up_;
  std::size_t next_;
  Slope slope_;
};

/// Whether the motion needs the event loop with load and normal force.
template <FrictionLaw Law>
bool loaded(const Slider<Law>& slider, const GroundMotion& motion) noexcept {
  return !slider.plain() || motion.has_vertical();
}
template <FrictionLaw Law>
bool loaded(const Slider<Law>& slider, const HarmonicMotion&) noexcept {
  return !slider.plain();
}

/// Whether the normal force is negative anywhere.
inline bool may_fly(const GroundMotion& motion, double slope) noexcept {
  const LoadPieces pieces(motion, slope);
  double least = never;
  for (std::size_t i = 0; i < motion.segments(); ++i) {
    const LoadSegment segment = pieces.segment(i);
    least = std::min(least, std::min(segment.normal_start, segment.normal_end));
  }
  return least < 0;
}

/// Throw if the ground falls freely, or faster, at the end of the motion: the slider would never land.
inline void check_landing(const GroundMotion& motion, double slope) {
  const std::size_t last = motion.segments() - 1;
  const LoadSegment segment = LoadPieces(motion, slope).segment(last);
  require(segment.normal_end > 0,
          "the ground must press on the slider at the end of the motion, or it never lands: N = (g + a_z) "
          "cos(slope) + n sin(slope) must be positive in the last segment; is the vertical acceleration in m/s^2?",
          segment.normal_end, "m/s^2");
}

/// Integrate over all segments of load and normal force in order.
template <FrictionLaw Law, FlowMaker Flows, class RecorderType>
[[gnu::flatten]] void run_loaded(const Slider<Law>& slider, const Flows& flows, const GroundMotion& motion,
                                 Contact contact, State& state, RecorderType& recorder, const HistorySpans& histories) {
  const Bounds bounds{slider.mounting().stops, slider.mounting().one_way};
  const LoadPieces pieces(motion, slider.slope());
  StateOf<Law> moving(state);
  const auto go = [&](std::size_t i, double begin, double end, const LoadSegment& segment) {
    recorder.begin_segment(begin, end);
    advance(flows, segment, bounds, contact, moving, recorder);
    histories.keep(i + 1, slider.law(), moving);
    if (!histories.gap.empty()) histories.gap[i + 1] = moving.gap;
  };
  walk(pieces, motion.segments(), RecorderType::work_per_report, go, [&] { recorder.report_progress(); });
  store(moving, state);
}

/// The same with the flows that suit the slider.
template <FrictionLaw Law, Motion M, class RecorderType>
void run_in_order(const Slider<Law>& slider, const M& motion, State& state, RecorderType& recorder,
                  const HistorySpans& histories) {
  with_flows(slider, motion, [&](const auto& flows) { run(flows, motion, state, recorder, histories); });
}

/// The same by the fastest available method.
template <FrictionLaw Law, Motion M, class RecorderType>
void run(const Slider<Law>& slider, const M& motion, State& state, RecorderType& recorder,
         const HistorySpans& histories) {
#ifdef STICKSLIP_LIBRARY
  if constexpr (std::same_as<Law, Coulomb> && std::same_as<M, GroundMotion>)
    if (worth_pieces(slider, motion)) return run_by_pieces(slider.law(), motion, state, recorder, histories);
#endif
  run_in_order(slider, motion, state, recorder, histories);
}

}  // namespace stickslip::detail
