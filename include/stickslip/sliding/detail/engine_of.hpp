// The engine of a law: the only place where the event loop is compiled for code that does not know the law.
#pragma once

#include <cmath>
#include <concepts>
#include <cstddef>
#include <limits>
#include <type_traits>

#include "stickslip/base/equal.hpp"
#include "stickslip/flow/detail/block.hpp"
#include "stickslip/flow/polynomial.hpp"
#include "stickslip/friction/coulomb.hpp"
#include "stickslip/friction/law.hpp"
#include "stickslip/ground/ground_motion.hpp"
#include "stickslip/slider/slider.hpp"
#include "stickslip/sliding/detail/axis.hpp"
#include "stickslip/sliding/detail/bounds.hpp"
#include "stickslip/sliding/detail/contact.hpp"
#include "stickslip/sliding/detail/engine.hpp"
#include "stickslip/sliding/detail/recorder.hpp"
#include "stickslip/sliding/detail/run.hpp"
#include "stickslip/sliding/detail/sink.hpp"
#include "stickslip/sliding/detail/with_flows.hpp"
#include "stickslip/state/state.hpp"

namespace stickslip::detail {

/// A flow that can have a damper.
template <class Flow>
concept FlowWithDamper = requires(const Flow& flow, double time) {
  flow.damped_work(time);
};

/// Observes the event loop for a sink.
/// @tparam AnySink  Sink, or a final class of it, whose functions are then inlined
template <class AnySink>
class ToSink {
 public:
  explicit ToSink(AnySink& sink) noexcept : sink_(sink), account_(sink.account()) {}

  template <class Flow>
  void follow(const Flow& flow, [[maybe_unused]] double taken) {
    flow_ = SlipFlow(flow);
    if (account_ == Account::none) return;
    if constexpr (FlowWithDamper<Flow>) sink_.energy.damped += flow.damped_work(taken);
    if constexpr (requires { flow.pendulum_work(taken); }) sink_.energy.input += flow.pendulum_work(taken);
  }
  bool counts_energy() const noexcept { return account_ == Account::whole; }
  void dissipate(double work) {
    if (counts_energy()) sink_.energy.dissipated += work;
  }
  void lose(double energy) { sink_.energy.impact += energy; }

  void slide(const Slip& slip) { sink_.slide(slip, flow_); }
  void event(EventKind kind, double time, const State& state) { sink_.event(kind, time, state); }

 private:
  AnySink& sink_;
  Account account_;
  SlipFlow flow_;
};

/// Constant friction on a plane or a spring: a slip costs so little that calls between the parts of the event loop would
/// show.
template <class Flows>
inline constexpr bool is_cheap = Flows::in_closed_form && (form_of<typename Flows::Law> == Form::constant);

/// Whether segments of a law are passed in one step, where they hold no event. The event loop for the others is apart
/// and knows no type of sink: it is compiled once.
template <class Law>
inline constexpr bool passes_in_one_step = MemoryLaw<Law>&& form_of<Law> == Form::linear;

template <class Flows>
[[gnu::noinline]] void advance_apart(const Flows& flows, const Segment& segment, State& state, Sink& sink) {
  ToSink<Sink> observer(sink);
  advance(flows, segment, state, observer);
}
template <class Flows>
[[gnu::noinline]] void advance_apart(const Flows& flows, const LoadSegment& segment, const Bounds& bounds,
                                     Contact contact, State& state, Sink& sink) {
  ToSink<Sink> observer(sink);
  advance(flows, segment, bounds, contact, state, observer);
}
template <class Flows, class Place, class Observer>
[[gnu::always_inline]] inline void advance_in_steps(const Flows& flows, const Segment& segment, Place& state,
                                                    Observer& observer, [[maybe_unused]] Sink& sink) {
  if constexpr (!passes_in_one_step<typename Flows::Law>)
    advance(flows, segment, state, observer);
  else if (!pass_in_one_step(flows, load_of(segment), Unbounded{}, state, observer))
    advance_apart(flows, segment, state, sink);
}
template <class Flows, class Place, class Observer>
[[gnu::always_inline]] inline void advance_in_steps(const Flows& flows, const LoadSegment& segment,
                                                    const Bounds& bounds, Contact contact, Place& state,
                                                    Observer& observer, [[maybe_unused]] Sink& sink) {
  if constexpr (!passes_in_one_step<typename Flows::Law>)
    advance(flows, segment, bounds, contact, state, observer);
  else if (!pass_in_one_step(flows, segment, bounds, state, observer))
    advance_apart(flows, segment, bounds, contact, state, sink);
}

/// Move a state through all segments.
/// @param go  `go(segment, state, observer)` moves it through one
/// @tparam AnySegments, AnySink  Segments and Sink, or final classes of them, whose functions are then inlined
template <class AnySegments, class Place, class AnySink, class Go>
[[gnu::always_inline]] inline void move_through(AnySegments& segments, Place& state, AnySink& sink, Go&& go) {
  ToSink<AnySink> observer(sink);
  typename AnySegments::Given segment;
  if constexpr (requires { segments.give(state, segment); })
    while (segments.give(state, segment)) go(segment, state, observer);
  else
    while (segments.next(StateView(state), segment)) go(segment, state, observer);
}
template <class AnySegments, class Place, class AnySink, class Go>
[[gnu::flatten, gnu::noinline]] void move_inlined(AnySegments& segments, Place& state, AnySink& sink, Go go) {
  Place moving = state;  // a state whose address is taken is kept in memory
  if constexpr (std::copy_constructible<AnySegments>) {
    AnySegments given = segments;
    move_through(given, moving, sink, go);
  } else {
    move_through(segments, moving, sink, go);
  }
  state = moving;
}
/// The same of a public state, by the way that suits the flows.
/// @tparam Place  in which the event loop carries it
template <class Flows, class Place, class AnySegment, class Go>
[[gnu::always_inline]] inline void move_as(Segments<AnySegment>& segments, State& state, Sink& sink, const Go& go) {
  Place moving(state);
  if constexpr (is_cheap<Flows>)
    move_inlined(segments, moving, sink, go);
  else
    move_through(segments, moving, sink, go);
  store(moving, state);
}

/// A slider of any law as an Engine. The library contains those of its laws; a user's own law compiles here.
template <FrictionLaw Law>
class EngineOf final : public Engine {
 public:
  /// @param slider  held by reference
  explicit EngineOf(const Slider<Law>& slider) noexcept
      : Engine(slider.mounting(), slider.plain(), traits()), slider_(slider) {}

  void move(Segments<Segment>& segments, double usual_duration, State& state, Sink& sink) const override;
  void move(Segments<LoadSegment>& segments, double usual_duration, Contact contact, State& state,
            Sink& sink) const override;
  void move(Segments<HarmonicSegment>& segments, double omega, double usual_duration, State& state,
            Sink& sink) const override;
  void record(const GroundMotion& motion, State& state, Recorder& recorder,
              const HistorySpans& histories) const override;
  void record(const GroundMotion& motion, State& state, NoRecorder& none, const HistorySpans& histories) const override;

  State started(const State& state) const override;
  void slide(State& state, double distance) const override;
  double resist(const State& state, double weight, Direction direction) const override;
  double hold(const State& state, double weight, Direction direction) const override;
  double work(double from, double distance, Direction direction) const override;
  double elastic(const State& state) const override;
  double temperature(const State& state) const override;
  SurfaceHeat heat_at(double temperature) const override;

 private:
  static constexpr LawTraits traits() noexcept {
    return {.constant = form_of<Law> == Form::constant,
            .coulomb = std::same_as<Law, Coulomb>,
            .position = PositionLaw<Law>,
            .closed_work = LawWithWork<Law>,
            .memory = MemoryLaw<Law>,
            .heated = HeatedLaw<Law>,
            .springs = LawWithSprings<Law>};
  }
  void record(const GroundMotion& motion, Contact contact, State& state, Recorder& recorder,
              const HistorySpans& histories) const override;
  void record(const GroundMotion& motion, Contact contact, State& state, NoRecorder& none,
              const HistorySpans& histories) const override;
  template <class AnySink>
  void record_any(const GroundMotion& motion, State& state, AnySink& sink, const HistorySpans& histories) const;
  template <class AnySink>
  void record_any(const GroundMotion& motion, Contact contact, State& state, AnySink& sink,
                  const HistorySpans& histories) const;
  template <class Place, class AnySegments, class AnySink, class Go, class Else>
  void move_any(AnySegments& segments, bool weighed, double usual_duration, State& state, AnySink& sink, Go&& go,
                Else&& otherwise) const;

  const Slider<Law>& slider_;
};

// The functions are defined outside of the class, so that they are not inline: compilers do not instantiate them where
// the library contains them.

template <FrictionLaw Law>
void EngineOf<Law>::move(Segments<Segment>& segments, double usual_duration, State& state, Sink& sink) const {
  with_flows(slider_, false, usual_duration, [&]<class Flows>(const Flows& flows) {
    move_as<Flows, typename Flows::Place>(segments, state, sink,
                                          [&flows, &sink](const Segment& segment, auto& place, auto& observer) {
                                            advance_in_steps(flows, segment, place, observer, sink);
                                          });
  });
}

template <FrictionLaw Law>
void EngineOf<Law>::move(Segments<LoadSegment>& segments, double usual_duration, Contact contact, State& state,
                         Sink& sink) const {
  const Bounds bounds{mounting().stops, mounting().one_way};
  with_flows(slider_, true, usual_duration, [&]<class Flows>(const Flows& flows) {
    move_as<Flows, StateOf<Law>>(
        segments, state, sink,
        [&flows, &sink, bounds, contact](const LoadSegment& segment, auto& place, auto& observer) {
          advance_in_steps(flows, segment, bounds, contact, place, observer, sink);
        });
  });
}

template <FrictionLaw Law>
void EngineOf<Law>::move(Segments<HarmonicSegment>& segments, double omega, double usual_duration, State& state,
                         Sink& sink) const {
  with_harmonic_flows(slider_, omega, usual_duration, [&]<class Flows>(const Flows& flows) {
    move_as<Flows, typename Flows::Place>(segments, state, sink,
                                          [&flows](const HarmonicSegment& segment, auto& place, auto& observer) {
                                            advance(flows, segment, place, observer);
                                          });
  });
}

template <FrictionLaw Law>
template <class AnySink>
void EngineOf<Law>::record_any(const GroundMotion& motion, State& state, AnySink& sink,
                               const HistorySpans& histories) const {
  SampledSegments segments(GroundMotion::Pieces(motion), motion.segments(), *this, sink, histories);
  if constexpr (std::same_as<Law, Coulomb>) {
    with_block_flows(slider_, motion.dt(), [&](const auto& flows) {
      BareState moving(state);
      move_inlined(
          segments, moving,
          sink, [&](const Segment& segment, auto& place, auto& observer) __attribute__((always_inline)) {
            advance(flows, segment, place, observer);
          });
      store(moving, state);
    });
  } else {
    move_any<StateOf<Law>>(
        segments, false, motion.dt(), state, sink,
        [&sink](const auto& flows, const Segment& segment, auto& place, auto& observer)
            __attribute__((always_inline)) { advance_in_steps(flows, segment, place, observer, sink); },
        [&] { move(segments, motion.dt(), state, sink); });
  }
}
template <FrictionLaw Law>
template <class AnySink>
void EngineOf<Law>::record_any(const GroundMotion& motion, Contact contact, State& state, AnySink& sink,
                               const HistorySpans& histories) const {
  const Bounds bounds{mounting().stops, mounting().one_way};
  SampledSegments segments(LoadPieces(motion, mounting().slope()), motion.segments(), *this, sink, histories);
  const bool weighed = motion.has_vertical() || mounting().slope_degrees > 0;
  move_any<StateOf<Law>>(
      segments, weighed, motion.dt(), state, sink,
      [ bounds, contact, &sink ](const auto& flows, const LoadSegment& segment, auto& place, auto& observer)
          __attribute__((always_inline)) { advance_in_steps(flows, segment, bounds, contact, place, observer, sink); },
      [&] { move(segments, motion.dt(), contact, state, sink); });
}
/// Where the flows are cheap, with segments and sink inlined into the event loop; otherwise as for any.
template <FrictionLaw Law>
template <class Place, class AnySegments, class AnySink, class Go, class Else>
void EngineOf<Law>::move_any(AnySegments& segments, [[maybe_unused]] bool weighed,
                             [[maybe_unused]] double usual_duration, State& state, AnySink& sink,
                             [[maybe_unused]] Go&& go, Else&& otherwise) const {
  if constexpr (form_of<Law> != Form::constant && !passes_in_one_step<Law>) {
    otherwise();
  } else {
    with_flows(slider_, weighed, usual_duration, [&]<class Flows>(const Flows& flows) {
      if constexpr (is_cheap<Flows> || passes_in_one_step<Law>) {
        Place moving(state);
        move_inlined(
            segments, moving,
            sink, [&](const auto& segment, auto& place, auto& observer) __attribute__((always_inline)) {
              go(flows, segment, place, observer);
            });
        store(moving, state);
      } else {
        otherwise();
      }
    });
  }
}
template <FrictionLaw Law>
void EngineOf<Law>::record(const GroundMotion& motion, State& state, Recorder& recorder,
                           const HistorySpans& histories) const {
  record_any(motion, state, recorder, histories);
}
template <FrictionLaw Law>
void EngineOf<Law>::record(const GroundMotion& motion, State& state, NoRecorder& none,
                           const HistorySpans& histories) const {
  record_any(motion, state, none, histories);
}

template <FrictionLaw Law>
void EngineOf<Law>::record(const GroundMotion& motion, Contact contact, State& state, Recorder& recorder,
                           const HistorySpans& histories) const {
  record_any(motion, contact, state, recorder, histories);
}
template <FrictionLaw Law>
void EngineOf<Law>::record(const GroundMotion& motion, Contact contact, State& state, NoRecorder& none,
                           const HistorySpans& histories) const {
  record_any(motion, contact, state, none, histories);
}

template <FrictionLaw Law>
State EngineOf<Law>::started(const State& state) const {
  return State(with_memory(slider_.law(), state));
}
template <FrictionLaw Law>
void EngineOf<Law>::slide([[maybe_unused]] State& state, [[maybe_unused]] double distance) const {
  if constexpr (MemoryLaw<Law>) detail::slide(slider_.law(), state, distance);
}
template <FrictionLaw Law>
double EngineOf<Law>::resist(const State& state, double weight, Direction direction) const {
  return stickslip::resist(law_at(slider_.law(), state, weight), state.displacement, std::abs(state.velocity),
                           direction);
}
template <FrictionLaw Law>
double EngineOf<Law>::hold(const State& state, double weight, Direction direction) const {
  return stickslip::hold(law_at(slider_.law(), state, weight), state.displacement, direction);
}
template <FrictionLaw Law>
double EngineOf<Law>::work([[maybe_unused]] double from, [[maybe_unused]] double distance,
                           [[maybe_unused]] Direction direction) const {
  if constexpr (PositionLaw<Law>)
    return friction_work(slider_.law(), from, distance, direction);
  else
    return std::numeric_limits<double>::quiet_NaN();
}
template <FrictionLaw Law>
double EngineOf<Law>::elastic(const State& state) const {
  return detail::elastic(slider_.law(), state);
}
template <FrictionLaw Law>
double EngineOf<Law>::temperature([[maybe_unused]] const State& state) const {
  if constexpr (HeatedLaw<Law>)
    return slider_.law().temperature(state);
  else
    return std::numeric_limits<double>::quiet_NaN();
}
template <FrictionLaw Law>
SurfaceHeat EngineOf<Law>::heat_at([[maybe_unused]] double temperature) const {
  if constexpr (HeatedLaw<Law>)
    return SurfaceHeat::with(slider_.law().half_integral_at(temperature));
  else
    return {};
}

}  // namespace stickslip::detail

#ifdef STICKSLIP_LIBRARY
#include "stickslip/sliding/detail/engines.hpp"
#endif
