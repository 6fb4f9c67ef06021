// Simulates the members of an ensemble, block by block.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "stickslip/base/equal.hpp"
#include "stickslip/base/error.hpp"
#include "stickslip/ensemble/detail/block.hpp"
#include "stickslip/ensemble/member.hpp"
#include "stickslip/ground/ground_motion.hpp"
#include "stickslip/slider/slider.hpp"
#include "stickslip/sliding/any_slider.hpp"
#include "stickslip/sliding/detail/contact.hpp"
#include "stickslip/sliding/detail/engine.hpp"
#include "stickslip/sliding/detail/engine_of.hpp"
#include "stickslip/sliding/detail/recorder.hpp"
#include "stickslip/sliding/detail/run.hpp"
#include "stickslip/sliding/detail/sink.hpp"
#include "stickslip/sliding/impacts.hpp"

namespace stickslip {
class SlidingStructure;
struct FlexibleSlope;
}  // namespace stickslip

namespace stickslip::detail {

/// Simulates the members of a block. Each thread has its own.
class Simulator {
 public:
  virtual ~Simulator() = default;
  virtual void simulate(std::uint64_t first_member, std::size_t members, Block& block) = 0;
};

/// Run the work for a member; errors name the member.
template <class Work>
void naming_member(std::uint64_t member, Work&& work, const char* who = "run_ensemble") {
  const auto named = [&](const std::exception& error) {
    return who + (": member " + std::to_string(member)) + ": " + error.what();
  };
  try {
    work();
  } catch (const ConvergenceError& error) {
    throw ConvergenceError(named(error));
  } catch (const std::invalid_argument& error) {
    throw std::invalid_argument(named(error));
  }
}

/// The output of one member of a block.
struct MemberPlace {
  Block& block;
  std::size_t index;                ///< of the member in the block
  double *displacement, *velocity;  ///< of all members by time, `block.width()` at each

  void keep(std::size_t time, double x, double v) const noexcept {
    displacement[time * block.width() + index] = x;
    velocity[time * block.width() + index] = v;
  }
  void end(double peak, double residual) const noexcept {
    block.peak()[index] = peak;
    block.residual()[index] = residual;
  }
};

/// The first `time` of a segment, of which `rest` [s] remains.
inline Segment cut(Segment& segment, double time, double rest) noexcept {
  const double middle = segment.start + (segment.end - segment.start) * (time / segment.duration);
  const Segment taken{time, segment.start, middle};
  segment = {rest, middle, segment.end};
  return taken;
}
template <class AnyLoadSegment>
AnyLoadSegment cut(AnyLoadSegment& segment, double time, double rest) noexcept {
  const AnyLoadSegment taken = take(segment, time, segment.normal(time));
  segment.duration = rest;
  return taken;
}

/// The segments of a motion, of which those that contain a time of the statistics are divided there.
template <class Pieces, class AnySegment = decltype(std::declval<const Pieces&>().segment(0))>
class DividedSegments {
 public:
  DividedSegments(const Pieces& pieces, std::size_t segments, const Block& block)
      : pieces_(pieces), count_(segments), block_(block), begin_(pieces.time(0)), dt_(block.times().dt) {
    block_.check_stopped();
  }

  /// Put the next segment.
  /// @param keep  called with the index of each time that has been reached
  /// @return whether there is one
  template <class Keep>
  bool next(AnySegment& segment, Keep&& keep) {
    const std::size_t times = block_.times().count;
    const auto reach = [&] {
      keep(next_++);
      wanted_ = static_cast<double>(next_) * dt_;
    };
    for (;;) {
      if (!inside_) {
        if (next_ < times && equal(wanted_, to_)) reach();  // also the start
        if (i_ == count_) {
          while (next_ < times) reach();  // a last time that exceeds the end by rounding
          return false;
        }
        if (i_ > 0 && i_ % 1024 == 0) block_.check_stopped();
        from_ = to_;
        to_ = pieces_.time(i_ + 1) - begin_;
        rest_ = pieces_.segment(i_++);
        inside_ = true;
      }
      while (next_ < times && wanted_ < to_) {
        if (wanted_ > from_) {
          segment = cut(rest_, wanted_ - from_, to_ - wanted_);
          from_ = wanted_;
          return true;
        }
        reach();
      }
      segment = rest_;
      inside_ = false;
      return true;
    }
  }

 private:
  Pieces pieces_;
  std::size_t count_, i_ = 0;  // segments begun
  const Block& block_;
  double begin_, dt_;
  std::size_t next_ = 0;      // time of the statistics
  double wanted_ = 0;         // the same, after the beginning [s]
  double from_ = 0, to_ = 0;  // of the rest of the present segment [s]
  AnySegment rest_{};
  bool inside_ = false;
};

/// Move through the segments of a motion: `go` integrates over a segment, and `keep` is called at each time of the
/// statistics.
template <class Pieces, class Go, class Keep>
void go_through(const Pieces& pieces, std::size_t segments, const Block& block, Go&& go, Keep&& keep) {
  DividedSegments divided(pieces, segments, block);
  for (decltype(pieces.segment(0)) segment{}; divided.next(segment, keep);) go(segment);
}

/// The ground acceleration at the times of the statistics; at a jump, the value after it.
inline void accelerations(const GroundMotion& motion, const EnsembleTimes& times, std::vector<double>& values) {
  values.resize(times.count);
  const double begin = motion.time(0);
  std::size_t next = 0;
  const auto read_off = [&](std::size_t i, double segment_begins, double segment_ends, const Segment& s) {
    const double from = segment_begins - begin, to = segment_ends - begin;
    const bool last = i + 1 == motion.segments();
    for (double at; next < times.count && ((at = static_cast<double>(next) * times.dt) < to || last); ++next)
      values[next] =
          s.duration > 0 ? s.start + (s.end - s.start) * std::clamp((at - from) / s.duration, 0.0, 1.0) : s.end;
  };
  walk(motion, motion.segments(), read_off, [] {});
}

/// What is kept of a member of any kind while it moves: its peak and its impacts. Checks regularly whether the run was
/// stopped.
class MemberTally {
 public:
  MemberTally(const Block& block, std::size_t event_limit) : block_(block), events_(event_limit) {}

  double peak() const noexcept { return peak_; }
  const Impacts& impacts() const noexcept { return impacts_; }

  void reach(double distance) noexcept { peak_ = std::max(peak_, distance); }
  void count_work() {
    if (++work_ % Recorder::work_per_report == 0) block_.check_stopped();
  }
  /// @param place, velocity  of an impact: those along the outward direction
  void count_event(EventKind kind, double place, double velocity) {
    if (kind == EventKind::impact) impacts_.add(place, velocity);
    count_work();
    ++events_;
  }

 private:
  const Block& block_;
  EventCount events_;
  std::uint32_t work_ = 0;
  double peak_ = 0;
  Impacts impacts_;
};

class PeakObserver final : public Sink, public MemberTally {
 public:
  using MemberTally::MemberTally;

  void slide(const Slip& slip, const SlipFlow&) override {
    count_work();
    reach(std::abs(slip.to()));
  }
  void event(EventKind kind, double, const State& state) override {
    count_event(kind, state.displacement, state.velocity);
  }
};

/// Continue a member without ground acceleration until it comes to rest.
void settle_member(const Engine& engine, bool loaded, Contact contact, State& state, PeakObserver& observer,
                   const Block& block);

/// Simulate one member from rest at x = 0, by the event loop of `advance`. A member may end in flight.
/// @param settle  whether to continue without ground acceleration until it comes to rest
void simulate_member(const Engine& engine, const GroundMotion& motion, bool settle, Contact contact,
                     const MemberPlace& place);
template <FrictionLaw Law>
void simulate_member(const Slider<Law>& slider, const GroundMotion& motion, bool settle, Contact contact,
                     const MemberPlace& place) {
  simulate_member(EngineOf<Law>(slider), motion, settle, contact, place);
}

/// The same for a slider of any law.
void simulate_member(const AnySlider& slider, const GroundMotion& motion, bool settle, Contact contact,
                     const MemberPlace& place);

/// The same for a structure with a sliding interface, from rest; with the peaks of its floors. Where the normal force
/// would be negative the interface slides without friction, whatever the contact.
void simulate_member(const SlidingStructure& system, const GroundMotion& motion, bool settle, Contact contact,
                     const MemberPlace& place);
void simulate_member(const FlexibleSlope& slope, const GroundMotion& motion, bool settle, Contact contact,
                     const MemberPlace& place);

/// The same for a slider of one of several laws, or for one of several kinds of structures.
template <class... Sliders>
void simulate_member(const std::variant<Sliders...>& slider, const GroundMotion& motion, bool settle, Contact contact,
                     const MemberPlace& place) {
  std::visit([&](const auto& one) { simulate_member(one, motion, settle, contact, place); }, slider);
}

/// Simulates any members, one after the other.
template <MemberSource Source>
class MemberSimulator final : public Simulator {
 public:
  /// @param source  held by reference
  MemberSimulator(const Source& source, std::uint64_t seed, bool settle, Contact contact = Contact::flight)
      : source_(source), seed_(seed), settle_(settle), contact_(contact) {}

  void simulate(std::uint64_t first_member, std::size_t members, Block& block) override {
    const std::size_t times = block.times().count, width = block.width();
    displacement_.resize(times * width);
    velocity_.resize(times * width);
    for (std::size_t i = 0; i < members; ++i) {
      const auto& member = source_.member(seed_, first_member + i);
      naming_member(first_member + i, [&] {
        const MemberPlace place{block, i, displacement_.data(), velocity_.data()};
        simulate_member(member.slider, member.motion, settle_, contact_, place);
      });
    }
    for (std::size_t k = 0; k < times; ++k) block.row(k, &displacement_[k * width], &velocity_[k * width]);
  }

 private:
  const Source& source_;
  std::uint64_t seed_;
  bool settle_;
  Contact contact_;
  std::vector<double> displacement_, velocity_;  // by time and member
};

}  // namespace stickslip::detail
