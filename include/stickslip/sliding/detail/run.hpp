// The segments of a whole ground motion, and what is kept at its samples.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>

#include "stickslip/base/equal.hpp"
#include "stickslip/base/error.hpp"
#include "stickslip/base/extremes.hpp"
#include "stickslip/base/min_max.hpp"
#include "stickslip/ground/motion.hpp"
#include "stickslip/ground/segment.hpp"
#include "stickslip/run/detail/run.hpp"
#include "stickslip/sliding/detail/engine.hpp"
#include "stickslip/sliding/detail/resting.hpp"
#include "stickslip/sliding/detail/sink.hpp"
#include "stickslip/state/state.hpp"
#ifdef STICKSLIP_LIBRARY
#include "stickslip/sliding/detail/pieces.hpp"
#endif

namespace stickslip::detail {

/// Where the response at the samples is written.
struct HistorySpans : HistorySpansOf<double> {
  template <class Place>
  void keep(std::size_t sample, const Place& state) const noexcept {
    displacement[sample] = state.displacement;
    velocity[sample] = state.velocity;
  }
  template <class Place>
  [[gnu::always_inline]] void keep(std::size_t sample, const Place& state, const Engine& engine) const {
    keep(sample, state);
    if (!gap.empty() || !temperature.empty()) [[unlikely]]
      keep_rarer(sample, StateView(state), engine);
  }
  /// The same of the samples from `first` to the one before `last`, at rest on the ground.
  template <class Place>
  void keep(std::size_t first, std::size_t last, const Place& state, const Engine& engine) const {
    std::fill_n(displacement.begin() + static_cast<std::ptrdiff_t>(first), last - first, state.displacement);
    std::fill_n(velocity.begin() + static_cast<std::ptrdiff_t>(first), last - first, 0.0);
    if (!gap.empty() || !temperature.empty()) [[unlikely]]
      for (std::size_t i = first; i < last; ++i) keep_rarer(i, StateView(state), engine);
  }

 private:
  [[gnu::noinline]] void keep_rarer(std::size_t sample, StateView state, const Engine& engine) const {
    if (!gap.empty()) gap[sample] = state.gap;
    if (!temperature.empty()) temperature[sample] = engine.temperature(state.state());
  }
};

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

/// The load and normal force of a slider on a slope under a ground motion.
class LoadPieces {
 public:
  LoadPieces(const GroundMotion& motion, double slope) noexcept
      : pieces_(motion),
        up_(motion.vertical()),
        next_(motion.interpolation() == Interpolation::linear ? 1 : 0),
        slope_(slope) {}

  double time(std::size_t i) const noexcept { return pieces_.time(i); }
  [[gnu::always_inline]] LoadSegment segment(std::size_t i) const noexcept {
    if (up_.empty()) return load_segment(pieces_.segment(i), slope_);
    return load_segment(pieces_.segment(i), slope_, up_[i], up_[i + next_]);
  }
  /// As GroundMotion::Pieces::around. Load and weight are linear in both components.
  std::array<LoadSegment, 2> around(std::size_t i, std::size_t count) const noexcept {
    const Segment along = pieces_.around(i, count)[0];
    if (up_.empty()) return {load_segment(along, slope_), load_segment(along, slope_)};
    const auto [least, most] = extremes(&up_[i], count + 1);
    return {load_segment(along, slope_, least, most), load_segment(along, slope_, most, least)};
  }

 private:
  GroundMotion::Pieces pieces_;
  std::span<const double> up_;
  std::size_t next_;
  Slope slope_;
};

/// The segments of a ground motion, whose times a sink receives and at whose samples histories are kept. Segments in
/// which a slider is certain to rest are passed; a sink with `pass(count)` receives their number.
/// @tparam Pieces  of the motion: GroundMotion::Pieces or LoadPieces
template <class Pieces, class AnySink, class AnySegment = decltype(std::declval<const Pieces&>().segment(0))>
class SampledSegments final : public Segments<AnySegment> {
 public:
  SampledSegments(const Pieces& pieces, std::size_t count, const Engine& engine, AnySink& sink,
                  const HistorySpans& histories)
      : pieces_(pieces),
        count_(count),
        engine_(engine),
        sink_(sink),
        histories_(histories),
        end_(pieces.time(0)),
        resting_(engine) {}

  bool next(const StateView& now, AnySegment& segment) override { return give(now, segment); }
  /// The same for a state of any kind, without a view of it.
  template <class Place>
  [[gnu::always_inline]] bool give(const Place& now, AnySegment& segment) {
    if (i_ > 0) {
      histories_.keep(i_, now, engine_);
      // A slider that did not move in the last segment may rest for many more.
      if (now.mode == Mode::stuck && equal(histories_.displacement[i_ - 1], now.displacement)) pass_rests(now);
      if (i_ == count_) return false;
      if (i_ % AnySink::work_per_report == 0) sink_.report_progress();
    }
    const double begin = std::exchange(end_, pieces_.time(i_ + 1));
    sink_.begin_segment(begin, end_);
    segment = pieces_.segment(i_++);
    return true;
  }

 private:
  // The segments in which a slider at rest is certain to stay.
  template <class Place>
  [[gnu::noinline]] void pass_rests(const Place& now) {
    if (i_ == count_ || now.in_flight || !resting_.known()) return;
    resting_.begin(now);
    const Pieces pieces = pieces_;
    const Resting resting = resting_;
    const std::size_t until = std::min(count_, i_ - i_ % AnySink::work_per_report + AnySink::work_per_report);
    std::size_t i = i_;
    constexpr std::size_t block = 32;
    for (std::size_t end = i; i == end && i < until;) {
      end = std::min(i + block, until);
      const auto around = pieces.around(i, end - i);
      if (std::all_of(around.begin(), around.end(), [&](const AnySegment& s) { return resting.holds(s); }))
        i = end;
      else
        while (i < end && resting.holds(pieces.segment(i))) ++i;
    }
    if (i == i_) return;
    histories_.keep(i_ + 1, i + 1, now, engine_);
    if constexpr (requires { sink_.pass(i - i_); }) sink_.pass(i - i_);
    i_ = i;
    end_ = pieces.time(i);
  }

  Pieces pieces_;
  std::size_t count_, i_ = 0;  // segments given, or passed at rest
  const Engine& engine_;
  AnySink& sink_;
  HistorySpans histories_;
  double end_;  // of the last segment [s]
  Resting resting_;
};

/// Minimum number of segments into which a motion is split: for a harmonic motion at least one per period, so that
/// phases stay small.
inline std::size_t pieces(const GroundMotion& motion) noexcept { return motion.segments(); }
inline std::size_t pieces(const HarmonicMotion& motion) noexcept {
  return std::max(motion.segments(), static_cast<std::size_t>(motion.duration() / motion.period()));
}

/// The same of a harmonic motion: from sample to sample, in segments of at most one period.
template <class AnySink>
class HarmonicSegments final : public Segments<HarmonicSegment> {
 public:
  HarmonicSegments(const HarmonicMotion& motion, const Engine& engine, AnySink& sink, const HistorySpans& histories)
      : motion_(motion), engine_(engine), sink_(sink), histories_(histories), time_(motion.time(0)), end_(time_) {}

  bool next(const StateView& now, HarmonicSegment& segment) override {
    if (!(time_ < end_)) {  // at a sample
      if (i_ > 0) histories_.keep(i_, now, engine_);
      if (i_ == motion_.segments()) return false;
      time_ = motion_.time(i_);
      end_ = motion_.time(++i_);
      if (motion_.dt() <= motion_.period() && i_ < motion_.segments()) {
        // Equal durations, without the rounding of the times.
        const double begin = std::exchange(time_, end_);
        segment = piece(begin, end_, motion_.dt(),
                        motion_.phase(begin, std::fma(static_cast<double>(i_ - 1), motion_.dt(), -begin)));
        return true;
      }
    }
    const double begin = std::exchange(time_, std::min(time_ + motion_.period(), end_));
    segment = piece(begin, time_, time_ - begin, motion_.phase(begin));
    return true;
  }

 private:
  HarmonicSegment piece(double begin, double end, double duration, double phase) {
    if (++pieces_ % AnySink::work_per_report == 0) sink_.report_progress();
    sink_.begin_segment(begin, end);
    return {duration, motion_.amplitude(), motion_.omega(), phase};
  }

  const HarmonicMotion& motion_;
  const Engine& engine_;
  AnySink& sink_;
  const HistorySpans& histories_;
  std::size_t i_ = 0;         // samples reached or under way
  double time_, end_;         // where the next segment begins, and the next sample [s]
  std::uint32_t pieces_ = 0;  // given
};

/// Whether the normal force is negative anywhere.
inline bool may_fly(const GroundMotion& motion, double slope) noexcept {
  const std::span<const double> up = motion.vertical();
  if (equal(slope, 0) && (up.empty() || extremes(up.data(), up.size()).least > -standard_gravity)) return false;
  const LoadPieces pieces(motion, slope);
  constexpr std::size_t block = 32;
  const auto falls = [](const LoadSegment& s) { return s.normal_start < 0 || s.normal_end < 0; };
  for (std::size_t i = 0; i < motion.segments(); i += block) {
    const std::size_t end = std::min(i + block, motion.segments());
    const auto around = pieces.around(i, end - i);
    if (std::none_of(around.begin(), around.end(), falls)) continue;
    for (std::size_t k = i; k < end; ++k)
      if (falls(pieces.segment(k))) return true;
  }
  return false;
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

/// Move a slider through a whole ground motion by the fastest method there is.
/// @param in_order  segment by segment, as the header-only core does
template <class AnyRecorder>
void run(const Engine& engine, const GroundMotion& motion, [[maybe_unused]] bool in_order, State& state,
         AnyRecorder& recorder, const HistorySpans& histories) {
#ifdef STICKSLIP_LIBRARY
  if (!in_order && recorded_by_pieces(engine, motion, state, recorder, histories)) return;
#endif
  engine.record(motion, state, recorder, histories);
}

/// Move a slider through a whole ground motion under load and normal force.
template <class AnySink>
void run_loaded(const Engine& engine, const GroundMotion& motion, Contact contact, State& state, AnySink& sink,
                const HistorySpans& histories) {
  if constexpr (requires { engine.record(motion, contact, state, sink, histories); }) {
    engine.record(motion, contact, state, sink, histories);
  } else {
    SampledSegments segments(LoadPieces(motion, engine.mounting().slope()), motion.segments(), engine, sink, histories);
    engine.move(segments, motion.dt(), contact, state, sink);
  }
}

}  // namespace stickslip::detail
