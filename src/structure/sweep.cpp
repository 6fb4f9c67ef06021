#include "stickslip/structure/sweep.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <tuple>
#include <utility>

#include "stickslip/base/units.hpp"
#include "stickslip/friction/coulomb.hpp"
#include "stickslip/sliding/detail/recorder.hpp"
#include "stickslip/sliding/detail/run.hpp"
#include "structure/linear_path.hpp"
#include "structure/modal_interface.hpp"
#include "structure/move.hpp"
#include "structure/stuck_motion.hpp"
#include "sweep/sweep_groups.hpp"

namespace stickslip::detail {
namespace {

// Keeps what a sweep shows.
class Tally final : public StructureSink {
 public:
  Tally(std::size_t event_limit, const SweepGroup::Check& check) : event_limit_(event_limit), check_(check) {}

  void event(EventKind kind, double, const InterfacePlace& place) override {
    if (outcome_.events >= event_limit_) refuse_more_events(event_limit_);
    ++outcome_.events;
    outcome_.peak = std::max(outcome_.peak, std::abs(place.displacement));  // x is monotonic between events
    if (kind == EventKind::impact) outcome_.impacts.add(place.displacement, place.velocity);
  }
  void follow(const Expansion& motion, Mode mode) override {
    count_work();
    if (mode == Mode::stuck) return;
    outcome_.sliding_distance += std::max(motion.distance(static_cast<double>(static_cast<int>(mode)), 1), 0.0);
  }

  bool pass(const LinearMove& move, const StructureState&, double) override {
    count_work();
    outcome_.sliding_distance += std::abs(move.distance());
    return true;
  }

  SweepOutcome end(const StructureState& state) {
    outcome_.residual = state.displacement;
    outcome_.peak = std::max(outcome_.peak, std::abs(state.displacement));
    if (!std::isfinite(outcome_.peak) || !finite(state)) refuse_overflow(outcome_.peak);
    return outcome_;
  }

 private:
  void count_work() {
    if (++work_ % work_per_check == 0) check_();
  }

  static constexpr std::uint32_t work_per_check = 4096;
  SweepOutcome outcome_{};
  std::size_t event_limit_;
  std::uint32_t work_ = 0;
  const SweepGroup::Check& check_;
};

// One interface under one ground motion, or its mirror image. While it is stuck, the structure moves as the
// StuckMotion, plus a deviation that slips have left, which decays without ground motion.
template <FrictionLaw Law>
class SweptInterface {
 public:
  SweptInterface(const ModalInterface& of, const Law& law, const GroundMotion& motion, const StuckMotion& stuck,
                 LinearSteps& steps, bool reversed, const SweepGroup::Check& check)
      : of_(of),
        law_(law),
        motion_(motion),
        pieces_(motion, 0),
        stuck_(stuck),
        sign_(reversed ? -1 : 1),
        tally_(max_events(motion.segments()), check),
        expansion_(of, law, mean_step(motion)),
        path_(of, law, steps, motion, false),
        deviation_(Eigen::VectorXd::Zero(2 * of.modes())) {
    state_.modal_displacement.resize(static_cast<std::size_t>(of.modes()));
    state_.modal_velocity = state_.modal_displacement;
    hold_from_here();
  }

  SweepOutcome run(bool settle) {
    const std::size_t segments = motion_.segments();
    while (at_ < segments) {
      if (!stuck_.empty() && state_.mode == Mode::stuck) {
        pass_held(segments);
        rejoin();
        if (at_ == segments) break;
      }
      LoadSegment segment = pieces_.segment(at_++);
      segment.load_start *= sign_;
      segment.load_end *= sign_;
      move(segment);
      if (!stuck_.empty() && state_.mode == Mode::stuck) part();
    }
    if (settle) come_to_rest();
    return tally_.end(state_);
  }

 private:
  // The state of the structure from the deviation, and the deviation from the state.
  void rejoin() {
    const Eigen::Index n = of_.modes();
    const Eigen::Map<const Eigen::VectorXd> whole(stuck_.state(at_), 2 * n);
    view(state_.modal_displacement) = sign_ * whole.head(n) + deviation_.head(n);
    view(state_.modal_velocity) = sign_ * whole.tail(n) + deviation_.tail(n);
  }
  void part() {
    const Eigen::Index n = of_.modes();
    const Eigen::Map<const Eigen::VectorXd> whole(stuck_.state(at_), 2 * n);
    deviation_.head(n) = view(state_.modal_displacement) - sign_ * whole.head(n);
    deviation_.tail(n) = view(state_.modal_velocity) - sign_ * whole.tail(n);
    bound_ = stuck_.flow().later_demand(deviation_.data());
    forget_round_off();
    hold_from_here();
  }
  void forget_round_off() {
    if (bound_ > 0x1p-54 * stuck_.largest()) return;
    bound_ = 0;
    deviation_.setZero();
  }

  void hold_from_here() { hold_from_here(stuck_.largest_weight()); }
  void hold_from_here(double heaviest) {
    heaviest_ = heaviest;
    levels_ = stuck_levels(of_, law_, state_, heaviest);
    pull_ = of_.spring.stiffness * state_.displacement;
  }
  bool holds(double lowest, double highest, double least_weight) const {
    const HeldDemands held(of_, state_.displacement, levels_, least_weight, heaviest_);
    return highest <= held.high && lowest >= held.low;
  }
  bool holds(const StuckSpan& span) const {
    const double low = (sign_ > 0 ? span.lowest : -span.highest) - bound_;
    const double high = (sign_ > 0 ? span.highest : -span.lowest) + bound_;
    return holds(low, high, span.least_weight);
  }

  // To the first segment in which the demand may exceed the friction.
  void pass_held(std::size_t segments) {
    constexpr std::size_t block = StuckMotion::block;
    const std::size_t from = at_;
    std::size_t passed = 0;  // segments through which the deviation has not been moved
    const auto decay = [&] {
      for (; passed > block; passed -= block) stuck_.flow().decay(deviation_.data(), block);
      stuck_.flow().decay(deviation_.data(), std::exchange(passed, 0));
    };
    while (at_ < segments) {
      std::size_t steps = 0;
      if (at_ % block == 0 && at_ + block <= segments && holds(stuck_.block_from(at_)))
        steps = block;
      else if (holds(stuck_.segment(at_)))
        steps = 1;
      at_ += steps;
      if (bound_ > 0) passed += steps;
      if (steps > 0) continue;
      if (passed == 0) break;
      decay();
      bound_ = stuck_.flow().later_demand(deviation_.data());
      forget_round_off();
    }
    decay();
    state_.heat.rest(motion_.time(at_) - motion_.time(from));
  }

  void come_to_rest() {
    const double step = motion_.last_step();
    const LoadSegment calm{step, 0, 0, standard_gravity, standard_gravity};
    std::optional<StuckBound> bound, left;
    RingDown energy;
    if (stuck_.empty()) bound.emplace(of_);
    for (std::size_t steps = 0, look = calm_steps_per_look;; ++steps) {  // most rest before
      double amplitude = never;
      if (state_.mode == Mode::stuck) {
        hold_from_here(1);
        amplitude = bound ? (*bound)(state_) : pass_calm(steps);
        if (holds_forever(pull_, amplitude, levels_)) return;
      }
      if (steps == most_calm_steps) refuse_restless(step, state_, amplitude + std::abs(pull_));
      if (steps >= look) {
        look = steps + calm_steps_per_look;
        if (!left) left.emplace(of_);
        refuse_endless(of_, law_, *left, energy, step, state_, steps);
      }
      move(calm);
    }
  }

  void move(const LoadSegment& segment) {
    if (!path_.pass(segment, state_, tally_)) move_structure(of_, law_, segment, state_, expansion_, tally_);
  }

  // To the first step without ground motion in which the demand may exceed the friction, or after which it cannot.
  // @return a bound of the later demand without the spring
  double pass_calm(std::size_t& steps) {
    const StuckFlow& flow = stuck_.flow();
    const Eigen::Index n = of_.modes();
    const std::size_t from = steps;
    Eigen::VectorXd now(2 * n), next(2 * n);
    now << view(state_.modal_displacement), view(state_.modal_velocity);
    double amplitude = never;
    for (;; ++steps) {
      amplitude = flow.later_demand(now.data());
      if (holds_forever(pull_, amplitude, levels_) || steps == most_calm_steps) break;
      next = now;
      const StuckSpan span = pass_step(flow, next.data(), 0, 0);
      if (!holds(span.lowest, span.highest, 1)) break;
      now.swap(next);
    }
    view(state_.modal_displacement) = now.head(n);
    view(state_.modal_velocity) = now.tail(n);
    state_.heat.rest(static_cast<double>(steps - from) * motion_.last_step());
    return amplitude;
  }

  const ModalInterface& of_;
  const Law& law_;
  const GroundMotion& motion_;
  LoadPieces pieces_;
  const StuckMotion& stuck_;
  double sign_;
  Tally tally_;
  LawExpansion<Law> expansion_;
  LinearPath<Law> path_;
  StructureState state_{};
  std::size_t at_ = 0;  // the segment that comes next
  // While it is stuck: the modes and their rates beside the StuckMotion, a bound of their demand, and what holds.
  Eigen::VectorXd deviation_;
  double bound_ = 0, pull_ = 0, heaviest_ = 1;
  StuckLevels levels_{};
};

template <FrictionLaw Law>
SweepOutcome slide(const ModalInterface& of, const Law& law, const GroundMotion& motion, const StuckMotion& stuck,
                   LinearSteps& steps, bool reversed, bool settle, const SweepGroup::Check& check) {
  return SweptInterface<Law>(of, law, motion, stuck, steps, reversed, check).run(settle);
}

// Slopes that differ in ky_g alone, or in their Degrading law.
SweepGroup::Each start_slopes(const std::vector<FlexibleSlope>& slopes, const std::optional<SlidingStructure>& linear,
                              const GroundMotion& motion, bool settle, const SweepGroup::Check& check) {
  const SlidingStructure column = linear ? *linear : sliding_structure(slopes[0], properties(slopes[0], motion));
  auto stuck = std::make_shared<const StuckMotion>(column.modal(), motion);
  return [&slopes, column, stuck, &motion, settle, check](std::size_t i, bool reversed) {
    const auto with = [&](const auto& law) {
      return slide(column.modal(), law, motion, *stuck, column.steps(), reversed, settle, check);
    };
    if (slopes[i].degrading) return with(*slopes[i].degrading);
    return with(Coulomb(slopes[i].ky_g * standard_gravity, never));
  };
}

// Whether structures that move alike while they are stuck do so while they slide against the same friction.
bool slide_alike(const ModalInterface& a, const ModalInterface& b) {
  return equal(a.mass, b.mass) && equal(a.spring.stiffness, b.spring.stiffness) && equal(a.damper, b.damper) &&
         a.jump == b.jump && equal(a.fastest, b.fastest);
}

// Structures that differ in the interface alone.
SweepGroup::Each start_structures(const std::vector<SlidingStructure>& structures, const GroundMotion& motion,
                                  bool settle, const SweepGroup::Check& check) {
  auto stuck = std::make_shared<const StuckMotion>(structures[0].modal(), motion);
  return [&structures, stuck, &motion, settle, check](std::size_t i, bool reversed) {
    SweepOutcome outcome;
    // The steps of the first that slides alike.
    const auto same = std::ranges::find_if(
        structures, [&](const SlidingStructure& other) { return slide_alike(other.modal(), structures[i].modal()); });
    with_interface_law(structures[i].slider(), [&](const auto& law) {
      outcome = slide(structures[i].modal(), law, motion, *stuck, same->steps(), reversed, settle, check);
    });
    return outcome;
  };
}

bool alike(const FlexibleSlope& a, const FlexibleSlope& b) {
  const auto column = [](const FlexibleSlope& s) {
    const std::optional<double> strain = s.soil ? std::optional(s.soil->reference_strain()) : std::nullopt;
    return std::tuple(s.height, s.shear_velocity, s.damping_ratio, s.modes, s.rock_velocity, strain, s.method,
                      s.degrading.has_value());
  };
  return column(a) == column(b);
}

// Whether both move alike while they are stuck.
bool alike(const SlidingStructure& a, const SlidingStructure& b) {
  const ModalInterface &one = a.modal(), &other = b.modal();
  return one.modes() == other.modes() && one.stiffness == other.stiffness && one.damping == other.damping &&
         one.load == other.load && one.demand == other.demand && one.reaction == other.reaction &&
         equal(one.ground_demand, other.ground_demand);
}

template <class S>
struct Group {
  std::vector<S> members;
  std::vector<std::size_t> places;
};

// Adds to the group of those that are alike.
template <class S>
void add(std::vector<Group<S>>& groups, const S& one, std::size_t place) {
  auto group = std::ranges::find_if(groups, [&](const Group<S>& g) { return alike(g.members[0], one); });
  if (group == groups.end()) group = groups.insert(group, Group<S>{});
  group->members.push_back(one);
  group->places.push_back(place);
}

}  // namespace

SweepTable sweep_structures(const std::vector<AnySlidingStructure>& structures,
                            std::span<const GroundMotion* const> motions, const SweepOptions& options) {
  std::vector<Group<FlexibleSlope>> slopes;
  std::vector<Group<SlidingStructure>> others;
  std::vector<SweepSlider> sliders;
  for (std::size_t i = 0; i < structures.size(); ++i) {
    bool has_stops = false;
    if (const auto* slope = std::get_if<FlexibleSlope>(&structures[i])) {
      check(*slope);
      add(slopes, *slope, i);
    } else {
      const auto& structure = std::get<SlidingStructure>(structures[i]);
      has_stops = static_cast<bool>(structure.modal().stops);
      add(others, structure, i);
    }
    sliders.push_back({{}, has_stops, {}});
  }
  std::vector<SweepGroup> groups;
  for (const auto& group : slopes) {
    std::optional<SlidingStructure> linear;
    if (const FlexibleSlope& slope = group.members[0]; !slope.soil && !motions.empty())
      linear = sliding_structure(slope, properties(slope, *motions[0]));
    groups.push_back({group.places, [&group, linear](const GroundMotion& motion, bool settle, const auto& check) {
                        return start_slopes(group.members, linear, motion, settle, check);
                      }});
  }
  for (const auto& group : others)
    groups.push_back({group.places, [&group](const GroundMotion& motion, bool settle, const auto& check) {
                        return start_structures(group.members, motion, settle, check);
                      }});
  return sweep(sliders, groups, motions, options);
}

}  // namespace stickslip::detail
