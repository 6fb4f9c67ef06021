// The event loop of one friction law, behind an interface that does not know the law.
#pragma once

#include <cmath>

#include "stickslip/base/units.hpp"
#include "stickslip/friction/law.hpp"
#include "stickslip/ground/ground_motion.hpp"
#include "stickslip/ground/segment.hpp"
#include "stickslip/run/detail/run.hpp"
#include "stickslip/slider/slider.hpp"
#include "stickslip/sliding/detail/sink.hpp"
#include "stickslip/sliding/response.hpp"
#include "stickslip/state/state.hpp"

namespace stickslip::detail {

class Recorder;
class NoRecorder;
struct HistorySpans;

/// What code that is compiled once asks of a law.
struct LawTraits {
  bool constant = false;     ///< while it slides in one direction
  bool coulomb = false;      ///< it is Coulomb itself
  bool position = false;     ///< the level depends on x only, so that `Engine::work` knows the work against friction
  bool closed_work = false;  ///< `Engine::work` is a closed form, for slips of any length
  bool memory = false;       ///< it depends on more than x and speed
  bool heated = false;       ///< it depends on the temperature of the sliding surface
  bool springs = false;      ///< its resistance contains springs
};

/// Moves a slider, and answers what depends on its law. `integrate`, `histories`, `advance`, trajectories, members of
/// ensembles and sensitivities are written over it; the event loop is compiled once for each law, in EngineOf.
class Engine {
 public:
  virtual ~Engine() = default;
  Engine(const Engine&) = delete;
  Engine& operator=(const Engine&) = delete;

  const Mounting& mounting() const noexcept { return mounting_; }
  const LawTraits& law() const noexcept { return law_; }
  /// Whether the motion needs the event loop with load and normal force.
  bool loaded(const GroundMotion& motion) const noexcept { return !plain_ || motion.has_vertical(); }
  /// Whether the mounting is as Slider::plain.
  bool plain() const noexcept { return plain_; }

  /// Move a state through all segments. The first is for plain sliders, the last for those that
  /// `require_plain_mounting` accepts. `usual_duration` is that of most segments [s], NaN if there is none.
  virtual void move(Segments<Segment>& segments, double usual_duration, State& state, Sink& sink) const = 0;
  virtual void move(Segments<LoadSegment>& segments, double usual_duration, Contact contact, State& state,
                    Sink& sink) const = 0;
  virtual void move(Segments<HarmonicSegment>& segments, double omega, double usual_duration, State& state,
                    Sink& sink) const = 0;

  /// Move a plain slider through a ground motion.
  virtual void record(const GroundMotion& motion, State& state, Recorder& recorder,
                      const HistorySpans& histories) const = 0;
  virtual void record(const GroundMotion& motion, State& state, NoRecorder& none,
                      const HistorySpans& histories) const = 0;
  /// Move a slider through a ground motion under load and normal force.
  virtual void record(const GroundMotion& motion, Contact contact, State& state, Recorder& recorder,
                      const HistorySpans& histories) const = 0;
  virtual void record(const GroundMotion& motion, Contact contact, State& state, NoRecorder& none,
                      const HistorySpans& histories) const = 0;

  /// A state as the event loop carries it: with the memory of the law, and with no other.
  virtual State started(const State& state) const = 0;
  /// Move the memory of the law over a distance, in the direction of the mode of the state.
  virtual void slide(State& state, double distance) const = 0;

  /// Resistance to sliding, and largest friction at rest, under a normal force of `weight` times g, divided by the
  /// weight [m/s^2].
  virtual double resist(const State& state, double weight, Direction direction) const = 0;
  virtual double hold(const State& state, double weight, Direction direction) const = 0;
  /// Work against friction of a law whose level depends on x only, over a distance [m^2/s^2].
  virtual double work(double from, double distance, Direction direction) const = 0;
  /// Energy in the springs of the law [m^2/s^2].
  virtual double elastic(const State& state) const = 0;
  /// Of a heated law: temperature of the surface [degrees Celsius], and the heat that has it as if it came long ago.
  virtual double temperature(const State& state) const = 0;
  virtual SurfaceHeat heat_at(double temperature) const = 0;

  /// The level against which it slides, under its weight [m/s^2].
  double level(const State& state) const { return resist(state, 1, direction_of(state.mode)); }
  /// What can keep it from rest.
  Unrest unrest(const State& state) const {
    const auto holds = [&](Direction direction) { return hold(state, 1, direction) > 0; };
    return {mounting_.natural_frequency,
            law_.constant && !is_stuck(state) && !holds(Direction::forward) && !holds(Direction::backward),
            !law_.position, standard_gravity * std::sin(mounting_.slope()), mounting_.stops.forward()};
  }

 protected:
  /// @param mounting  held by reference
  Engine(const Mounting& mounting, bool plain, const LawTraits& law) noexcept
      : mounting_(mounting), plain_(plain), law_(law) {}

 private:
  const Mounting& mounting_;
  bool plain_;
  LawTraits law_;
};

}  // namespace stickslip::detail
