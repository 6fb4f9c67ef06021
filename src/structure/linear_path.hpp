// Passes segments without an event by linear steps.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>

#include "stickslip/base/equal.hpp"
#include "stickslip/base/units.hpp"
#include "stickslip/friction/law.hpp"
#include "stickslip/ground/ground_motion.hpp"
#include "stickslip/ground/segment.hpp"
#include "stickslip/sliding/detail/bounds.hpp"
#include "stickslip/structure/sliding_structure.hpp"
#include "structure/linear_step.hpp"
#include "structure/motion.hpp"
#include "structure/move.hpp"

namespace stickslip::detail {

/// A structure under a ground motion: it passes segments in which no event can occur, each by one step. It leaves the
/// others to the event loop, and all where steps are uneven, or do not pay.
template <FrictionLaw Law>
class LinearPath {
 public:
  /// @param floors  whether the sink asks for the floors
  LinearPath(const SlidingStructure& system, const Law& law, const GroundMotion& motion, bool floors)
      : LinearPath(system.modal(), law, system.steps(), motion, floors) {}
  /// @param steps  of `of`, whatever its law
  LinearPath(const ModalInterface& of, const Law& law, LinearSteps& steps, const GroundMotion& motion, bool floors)
      : of_(of), law_(law), steps_(steps), step_(motion.dt()), count_(motion.segments()), floors_(floors) {}

  /// @return whether the segment is passed; otherwise nothing has changed
  bool pass(const LoadSegment& segment, StructureState& state, StructureSink& sink) {
    const bool passes = equal(segment.duration, step_) &&
                        (state.mode == Mode::stuck ? stays(segment, state, sink) : slides(segment, state, sink));
    if (!passes) held_.reset();
    return passes;
  }

 private:
  static constexpr double infinity = std::numeric_limits<double>::infinity();

  bool stays(const LoadSegment& segment, StructureState& state, StructureSink& sink) {
    LinearMove* const move = stuck_.get(*this, false);
    if (move == nullptr) return false;
    const double first = std::max(segment.normal_start, 0.0) / standard_gravity;
    const double last = std::max(segment.normal_end, 0.0) / standard_gravity;
    const double least = std::min(first, last), heaviest = std::max(first, last);
    if (HeatedLaw<Law> || !held_ || !equal(least, least_) || !equal(heaviest, heaviest_)) {
      held_.emplace(of_, state.displacement, stuck_levels(of_, law_, state, heaviest), least, heaviest);
      least_ = least;
      heaviest_ = heaviest;
    }
    move->begin(state, -segment.load_start, -segment.load_end, 0);
    if (!move->remains(0, held_->low, held_->high)) return false;
    move->finish();
    if (!sink.pass(*move, state, 0)) return false;
    move->write(state);
    if constexpr (HeatedLaw<Law>) state.heat.rest(step_);
    return true;
  }

  bool slides(const LoadSegment& segment, StructureState& state, StructureSink& sink) {
    if constexpr (MemorylessLaw<Law> && form_of<Law> == Form::constant) {
      if (!equal(segment.normal_start, standard_gravity) || !equal(segment.normal_end, standard_gravity)) return false;
      if (of_.driven && of_.damper > 0) return false;
      LinearMove* const move = sliding_.get(*this, true);
      if (move == nullptr) return false;
      const Direction direction = direction_of(state.mode);
      const double s = sign(direction), level = resist(law_, state.displacement, std::abs(state.velocity), direction);
      constexpr double slowest = std::numeric_limits<double>::min();
      move->begin(state, -segment.load_start, -segment.load_end, s * level);
      if (!(s > 0 ? move->remains(0, slowest, infinity) : move->remains(0, -infinity, -slowest))) return false;
      move->finish();
      // The velocity keeps its sign, so that the interface is nearest to a stop at the end.
      const Bounds bounds(of_.stops, of_.one_way);
      if (!(s * move->distance() < bounds.room(direction, state.displacement))) return false;
      if (!sink.pass(*move, state, level)) return false;
      move->write(state);
      return true;
    } else {
      return false;
    }
  }

  // Made when it is asked for.
  class Lazy {
   public:
    LinearMove* get(LinearPath& path, bool sliding) {
      if (!asked_) {
        asked_ = true;
        if (auto step = path.steps_.get(path.of_, path.step_, sliding, path.floors_, path.count_))
          move_.emplace(std::move(step));
      }
      return move_ ? &*move_ : nullptr;
    }

   private:
    bool asked_ = false;
    std::optional<LinearMove> move_{};
  };

  const ModalInterface& of_;
  const Law& law_;
  LinearSteps& steps_;
  double step_;        // [s]
  std::size_t count_;  // of the segments
  bool floors_;
  Lazy stuck_{}, sliding_{};
  std::optional<HeldDemands> held_{};  // while it remains stuck
  double least_ = 0, heaviest_ = 0;
};

}  // namespace stickslip::detail
