// Moves a structure with one sliding interface through segments of ground motion, and until it has settled.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <variant>

#include "stickslip/base/units.hpp"
#include "stickslip/friction/law.hpp"
#include "stickslip/ground/segment.hpp"
#include "stickslip/run/detail/loop.hpp"
#include "stickslip/sliding/any_slider.hpp"
#include "stickslip/sliding/detail/bounds.hpp"
#include "stickslip/structure/response.hpp"
#include "structure/law_expansion.hpp"
#include "structure/modal_interface.hpp"
#include "structure/motion.hpp"

namespace stickslip::detail {

/// Whether the motion of a structure can be expanded under a law.
template <class Law>
constexpr bool interface_law = SeparableHeatedLaw<Law> || form_of<Law> != Form::numeric;

/// Calls `use(law)` with the law of the interface.
/// @param name  of the class of the structure, whose constructor has this checked
template <class Use>
void with_interface_law(const AnySlider& slider, Use&& use, const char* name = "SlidingStructure") {
  std::visit(
      [&](const auto& one) {
        if constexpr (interface_law<std::remove_cvref_t<decltype(one.law())>>)
          use(one.law());
        else
          throw std::invalid_argument(
              std::string(name) +
              ": a structure cannot slide on this law: levels that are functions of numbers are not covered");
      },
      slider);
}

/// The parts of a segment between which the normal force changes its sign.
template <class Move>
void by_weight(const LoadSegment& segment, Move&& move) {
  const double g = standard_gravity, first = segment.normal_start, last = segment.normal_end;
  const GroundLoad whole{segment.duration, -segment.load_start, -segment.load_end, std::max(first, 0.0) / g,
                         std::max(last, 0.0) / g};
  if (!(segment.duration > 0)) return;
  if ((first >= 0 && last >= 0) || (first <= 0 && last <= 0)) return move(whole, 0.0);
  const double part = first / (first - last), time = part * segment.duration;
  const double between = whole.start + part * (whole.end - whole.start);
  move(GroundLoad{time, whole.start, between, whole.weight_start, 0}, 0.0);
  move(GroundLoad{segment.duration - time, between, whole.end, 0, whole.weight_end}, time);
}

/// Passes events with times from the start of the whole segment.
class WithinStructureSegment final : public StructureSink {
 public:
  /// @param begin  of the part [s]
  WithinStructureSegment(StructureSink& sink, double begin) : sink_(sink), begin_(begin) {}

  void event(EventKind kind, double time, const InterfacePlace& place) override {
    sink_.event(kind, begin_ + time, place);
  }
  void follow(const Expansion& motion, Mode mode) override { sink_.follow(motion, mode); }
  void lose(double energy) override { sink_.lose(energy); }
  void decide(double difference) override { sink_.decide(difference); }

 private:
  StructureSink& sink_;
  double begin_;
};

/// The event loop. Compiled once for each law, in engines.cpp; empty for a law that an interface cannot have.
template <FrictionLaw Law, bool = interface_law<Law>>
struct StructureEngine {};
template <FrictionLaw Law>
struct StructureEngine<Law, true> {
  static void move(const ModalInterface& of, const Law& law, const LoadSegment& segment, StructureState& state,
                   LawExpansion<Law>& expansion, StructureSink& sink);
};

/// Move through a segment.
template <FrictionLaw Law>
void move_structure(const ModalInterface& of, const Law& law, const LoadSegment& segment, StructureState& state,
                    LawExpansion<Law>& expansion, StructureSink& sink) {
  StructureEngine<Law>::move(of, law, segment, state, expansion, sink);
}

/// What the interface can hold in both directions while it is stuck, under its weight [m/s^2].
struct StuckLevels {
  double forward, backward;
};

/// @param weight  the largest N+/g: a law that depends on it can hold more under less; one whose surface cools, later
template <FrictionLaw Law>
StuckLevels stuck_levels(const ModalInterface& of, const Law& law, const StructureState& state, double weight = 1) {
  const State at = interface_of(state);
  const double x = state.displacement;
  const Bounds bounds(of.stops, of.one_way);
  const auto level = [&](Direction direction) {
    return bounds.bound(direction, x, hold(law_at(law, at, weight), x, direction));
  };
  return {level(Direction::forward), level(Direction::backward)};
}

/// The demands, beside the pull of the spring, that are certain to be held while the weight remains in a range, a
/// little less than those that are held.
struct HeldDemands {
  double low, high;  ///< [m/s^2]

  /// @param least, heaviest  N+/g
  HeldDemands(const ModalInterface& of, double x, const StuckLevels& levels, double least, double heaviest) {
    constexpr double gap = 0x1p-40;
    const double light = of.spring.under(0) * x, heavy = of.spring.under(heaviest) * x;
    // The springs of a law can make a level negative.
    const auto level = [&](double full) {
      return full > 0 ? weigh(least, full) * (1 - gap) : heaviest * full * (1 + gap);
    };
    low = std::max(light, heavy) - level(levels.backward);
    high = std::min(light, heavy) + level(levels.forward);
  }
};

/// Whether demands are held that differ from the constant -pull by at most `amplitude`.
inline bool holds_forever(double pull, double amplitude, const StuckLevels& levels) {
  constexpr double gap = 0x1p-40;
  const double most = amplitude + gap * (amplitude + std::abs(pull));
  return most - pull <= levels.forward && most + pull <= levels.backward;
}

/// After the ground motion, an interface must settle within this number of steps.
inline constexpr std::size_t most_calm_steps = 1'000'000;

bool finite(const StructureState& state);
[[noreturn]] void refuse_restless(double step, const StructureState& state, double demand);

/// How often it is asked whether that can be.
inline constexpr std::size_t calm_steps_per_look = 1000;

/// Finds by the loss of energy that an interface on springs cannot settle within the steps that are left.
class RingDown {
 public:
  /// @param energy  per reference mass [m^2/s^2]
  /// @param level   of friction, or more [m/s^2]
  /// @param steps   since the ground motion
  bool endless(double energy, double level, double step, std::size_t steps) {
    if (steps < next_) return false;
    const double passed = step * static_cast<double>(steps - since_), before = before_;
    before_ = energy, since_ = steps, next_ = 2 * steps;
    if (!(before > 0)) return false;
    // Of dE/dt = -rate E - level sqrt(2 E), where rate is less than the one observed.
    const double rate = std::log(before / energy) / passed, cycles = std::sqrt(energy / 2) / level;
    const double time = rate > 0 ? 2 / rate * std::log1p(rate * cycles) : 2 * cycles;
    return time > step * static_cast<double>(most_calm_steps - steps);
  }

 private:
  std::size_t since_ = 0, next_ = 16384;  // steps of many cycles
  double before_ = 0;
};

/// Throws if the interface cannot settle within the steps that are left, because friction is next to nothing beside what
/// is left of the motion. Only friction changes the momentum of an interface that slides without spring, damper and
/// stops; with them, friction and dampers take its energy; and the modes ring on unless their own dampers, or friction,
/// stop them.
template <FrictionLaw Law>
void refuse_endless(const ModalInterface& of, const Law& law, const StuckBound& bound, RingDown& energy, double step,
                    const StructureState& state, std::size_t steps) {
  constexpr double margin = 1000;  // for friction that is higher later
  const double speed = std::abs(state.velocity), time = static_cast<double>(most_calm_steps - steps) * step;
  const State at = interface_of(state);
  const auto now = law_at(law, at, 1);
  double level = 0;
  const auto add = [&](double forward, double backward) {
    if constexpr (LawWithSprings<Law>)  // whose pull is in both, with opposite signs
      forward = backward = (forward + backward) / 2;
    if (std::isfinite(forward)) level = std::max(level, forward);
    if (std::isfinite(backward) && !of.one_way) level = std::max(level, backward);
  };
  const double x = state.displacement;
  add(hold(now, x, Direction::forward), hold(now, x, Direction::backward));
  add(resist(now, x, speed, Direction::forward), resist(now, x, speed, Direction::backward));
  if (of.spring.stiffness > 0 || of.damper > 0 || of.stops || LawWithSprings<Law>) {
    const auto [kinetic, springs] = energy_of(of, state);
    if (energy.endless(kinetic + springs + elastic(law, at), margin * level, step, steps))
      refuse_restless(step, state, bound(state) + of.spring.stiffness * std::abs(x));
    return;
  }
  const double impulse = margin * level * time, amplitude = bound.after(state, time);
  const double momentum = state.velocity + of.coupling.dot(view(state.modal_velocity));
  constexpr bool constant = form_of<Law> == Form::constant;
  const bool slides_on = state.mode != Mode::stuck && std::abs(momentum) > impulse;
  const bool rings_on = of.driven ? amplitude > (constant ? 1 : margin) * level : amplitude > of.fastest * impulse;
  if (slides_on || rings_on) refuse_restless(step, state, amplitude);
}

/// Continue without ground motion until it is certain that the interface will not slide again.
/// @param step  duration of each segment [s]
/// @param go    moves through a segment
/// @throws ConvergenceError  the interface does not come to rest within `most_calm_steps`
template <FrictionLaw Law, class Go>
void settle_structure(const ModalInterface& of, const Law& law, double step, StructureState& state, Go&& go) {
  const StuckBound bound(of);
  RingDown energy;
  const auto amplitude = [&] { return bound(state); };
  const auto pull = [&] { return of.spring.stiffness * state.displacement; };
  const LoadSegment calm{step, 0, 0, standard_gravity, standard_gravity};
  for (std::size_t steps = 0;
       state.mode != Mode::stuck || !holds_forever(pull(), amplitude(), stuck_levels(of, law, state)); ++steps) {
    if (steps == most_calm_steps) refuse_restless(step, state, amplitude() + std::abs(pull()));
    if (steps % calm_steps_per_look == 0) refuse_endless(of, law, bound, energy, step, state, steps);
    go(calm);
  }
}

}  // namespace stickslip::detail
