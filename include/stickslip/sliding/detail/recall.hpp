// The arcs of a motion as its response tells them, without integrating it again.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "stickslip/base/equal.hpp"
#include "stickslip/base/min_max.hpp"
#include "stickslip/base/requirements.hpp"
#include "stickslip/ground/motion.hpp"
#include "stickslip/ground/segment.hpp"
#include "stickslip/sliding/detail/engine.hpp"
#include "stickslip/sliding/detail/run.hpp"
#include "stickslip/sliding/response.hpp"
#include "stickslip/sliding/trajectory.hpp"
#include "stickslip/state/state.hpp"

namespace stickslip::detail {

/// Shows the arcs and events of a motion on the ground to a reader, from one sample or event of its response to the next.
template <class Reader>
class Recall {
 public:
  /// Whether the samples and events of a response hold the states at the ends of all arcs, and their times those of the
  /// loads: the law has no memory, the ground acceleration does not jump, and the slider never leaves the ground.
  static bool covers(const Trajectory& trajectory) {
    const GroundMotion* const motion = trajectory.ground();
    const Response& response = trajectory.response();
    return motion != nullptr && response.displacement.size() >= motion->samples() && !trajectory.has_memory() &&
           motion->interpolation() == Interpolation::linear && std::isfinite(motion->dt()) && response.gap.empty() &&
           (response.contact == Contact::flight || !trajectory.engine_.loaded(*motion));
  }

  /// @param trajectory  that it covers
  Recall(const Trajectory& trajectory, Reader& reader)
      : reader_(reader),
        engine_(trajectory.engine_),
        motion_(*trajectory.ground()),
        response_(trajectory.response()),
        state_(State::at(response_.displacement.front(), 0)) {}

  void read(double until) {
    const double slope = engine_.mounting().slope();
    const LoadPieces pieces(motion_, slope);
    std::size_t i = 0;
    for (double begin = pieces.time(0), end; i < motion_.segments() && begin < until; begin = end, ++i) {
      end = pieces.time(i + 1);
      segment(begin, end, pieces.segment(i), response_.displacement[i + 1], response_.velocity[i + 1]);
    }
    const std::size_t last = response_.displacement.size() - 1;
    for (double begin = pieces.time(i), end; begin < until; begin = end) {
      const bool sampled = i < last && pieces.time(i + 1) < until;
      end = sampled ? pieces.time(++i) : until;
      segment(begin, end, load_segment(Segment{end - begin, 0, 0}, Slope(slope)),
              sampled ? response_.displacement[i] : response_.residual, sampled ? response_.velocity[i] : 0);
    }
    reader_.event(EventKind::end, until, state_, load(line_.duration));
  }

 private:
  // A segment, at whose end the slider has this displacement and velocity.
  void segment(double begin, double end, const LoadSegment& line, double displacement, double velocity) {
    begin_ = begin, end_ = end, now_ = 0;
    line_ = line;
    // What breaks away at its end does so under the load of the next one: after the ground motion that load is another.
    const auto& events = response_.events;
    const auto within = [&](const Event& event) {
      return event.time < end || (equal(event.time, end) && event.kind != EventKind::breakaway);
    };
    for (; next_ + 1 < events.size() && within(events[next_]); ++next_) {
      const Event& event = events[next_];
      go(std::clamp(event.time - begin, now_, line.duration), event.displacement, event.velocity);
      reader_.event(event.kind, event.time, state_, load(now_));
      pass(event);
    }
    go(line.duration, displacement, velocity);
  }

  // The slider arrives at a place, within the segment.
  void go(double time, double displacement, double velocity) {
    if (time - now_ > 0x1p-40 * line_.duration) {
      if (slides_) {
        const double toward = !equal(velocity, 0)          ? velocity
                              : !equal(state_.velocity, 0) ? state_.velocity
                                                           : displacement - state_.displacement;
        if (!equal(toward, 0)) state_.mode = toward > 0 ? Mode::forward : Mode::backward;
      }
      Arc arc(begin_ + now_, time < line_.duration ? begin_ + time : end_, time - now_, state_, part(now_, time),
              engine_);
      arc.distance = std::abs(displacement - state_.displacement);
      reader_.arc(arc);
    }
    now_ = time;
    state_.displacement = displacement;
    state_.velocity = velocity;
  }

  void pass(const Event& event) {
    slides_ = event.kind != EventKind::arrest;
    if (event.kind == EventKind::impact)
      state_.velocity *= -engine_.mounting().stops.restitution();
    else if (event.kind != EventKind::breakaway)
      state_.velocity = 0;
    if (!slides_) state_.mode = Mode::stuck;
  }

  Load load(double time) const noexcept { return load_at(line_, time); }
  LoadSegment part(double from, double to) const noexcept {
    const Load first = load(from), last = load(to);
    return {to - from, first.load, last.load, first.normal, last.normal};
  }

  Reader& reader_;
  const Engine& engine_;
  const GroundMotion& motion_;
  const Response& response_;
  std::size_t next_ = 0;  // event
  State state_;
  bool slides_ = false;
  double begin_ = 0, end_ = 0;  // of the segment [s]
  double now_ = 0;              // since its beginning [s]
  LoadSegment line_{};
};

/// Show a motion to a reader that asks of a slip only the states at both ends of its arcs, as Trajectory::read does.
/// Where the response holds these, nothing is integrated: an arc is then from one sample or event to the next, without
/// its work, and what it says of the motion within is undefined.
template <class Reader>
void read_ends(const Trajectory& trajectory, Reader& reader, double until) {
  if (Recall<Reader>::covers(trajectory))
    Recall<Reader>(trajectory, reader).read(until);
  else
    trajectory.read(reader, until);
}

}  // namespace stickslip::detail
