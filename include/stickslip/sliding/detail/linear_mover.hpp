// A slider whose motion between two events is linear with constant coefficients, for many segments of one duration.
#pragma once

#include <cmath>
#include <cstddef>
#include <memory>
#include <numbers>
#include <optional>
#include <type_traits>
#include <vector>

#include "stickslip/base/equal.hpp"
#include "stickslip/base/min_max.hpp"
#include "stickslip/flow/closed_form.hpp"
#include "stickslip/flow/damped.hpp"
#include "stickslip/friction/law.hpp"
#include "stickslip/ground/segment.hpp"
#include "stickslip/slider/slider.hpp"
#include "stickslip/sliding/advance.hpp"
#include "stickslip/sliding/detail/axis.hpp"
#include "stickslip/sliding/detail/bounds.hpp"
#include "stickslip/sliding/detail/contact.hpp"
#include "stickslip/sliding/detail/engine_of.hpp"
#include "stickslip/sliding/detail/sink.hpp"
#include "stickslip/sliding/detail/with_flows.hpp"
#include "stickslip/sliding/impacts.hpp"
#include "stickslip/sliding/observer.hpp"
#include "stickslip/state/state.hpp"

namespace stickslip::detail {

/// What a segment of constant coefficients makes of y'' + c y' + k y = q(t), with a load that is linear in time: from
/// the speed u, the net load q = p - base - k y at its beginning and the gain of the load until its end,
///     speed = speed_u u + speed_q q + speed_g gain,
/// and likewise the distance, and the acceleration at the end. At the beginning that is q - c u.
struct LinearStepOf {
  double stiffness = 0, damping = 0;  ///< k [1/s^2], negative if it pushes away; c [1/s]
  double speed_u = 0, speed_q = 0, speed_g = 0;
  double way_u = 0, way_q = 0, way_g = 0;
  double end_u = 0, end_q = 0, end_g = 0;
  bool one_arch = false;  ///< whether the acceleration has at most one zero within
  /// The basis decay, impulse, step, ramp after a part of the segment, as power series in that part; the time unit is the
  /// duration. Good to round-off if `smooth`.
  static constexpr std::size_t terms = 12;
  alignas(64) double series[terms][4] = {};
  double duration = 0;
  bool smooth = false;

  LinearStepOf() = default;
  LinearStepOf(double damping_, double stiffness_, double duration_) noexcept
      : stiffness(stiffness_), damping(damping_), duration(duration_) {
    const double frequency = std::copysign(std::sqrt(std::abs(stiffness)), stiffness), half = damping / 2;
    const DampedBasis basis(damping, frequency, duration);
    speed_u = basis.decay;
    speed_q = basis.impulse;
    speed_g = basis.step / duration;
    way_u = basis.impulse;
    way_q = basis.step;
    way_g = basis.ramp / duration;
    end_u = -(damping * basis.decay + stiffness * basis.impulse);
    end_q = basis.decay;
    end_g = basis.impulse / duration;
    one_arch =
        !(frequency > half) || duration * std::sqrt(std::abs(excess_damping(half, frequency))) <= std::numbers::pi;
    // impulse'' + c impulse' + k impulse = 0. What is left out is at most (1/4)^12 / 12!.
    const double c = damping * duration, k = stiffness * duration * duration;
    smooth = c + std::sqrt(std::abs(k)) <= 0.25;
    double impulse = 0, next = 1;
    for (std::size_t n = 0; n < terms; ++n) {
      const auto m = static_cast<double>(n);
      series[n][0] = (m + 1) * next;
      series[n][1] = impulse;
      if (n + 1 < terms) series[n + 1][2] = impulse / (m + 1);
      if (n + 2 < terms) series[n + 2][3] = impulse / ((m + 1) * (m + 2));
      const double after = -(c * (m + 1) * next + k * impulse) / ((m + 1) * (m + 2));
      impulse = next;
      next = after;
    }
  }
};

/// How a slider moves from a state on, until something changes.
struct LinearRegime {
  /// At rest: the loads p that are held for certain [m/s^2].
  double low = 0, high = 0;
  /// While it slides: 1 or -1, its direction. In y = sign x its net load is sign p - base - stiffness y, and nothing
  /// changes, for certain, while y is below `limit`.
  double sign = 0, base = 0, limit = 0;
  const LinearStepOf* step = nullptr;

  /// @param forward, backward  what is held in each direction, beside the pull of the spring [m/s^2]
  static LinearRegime at_rest(double pull, double forward, double backward) noexcept {
    const double unsure = round_off * std::abs(pull);
    LinearRegime regime;
    regime.low = pull - (1 - round_off) * (backward - unsure);
    regime.high = pull + (1 - round_off) * (forward - unsure);
    return regime;
  }
  /// @param level  at y [m/s^2]; it rises with y by `rises` [1/s^2], which the step contains
  /// @param room   from y on [m]
  static LinearRegime sliding(double sign, double y, double level, double rises, double room,
                              const LinearStepOf& step) noexcept {
    LinearRegime regime;
    regime.sign = sign;
    regime.base = level - rises * y;
    regime.step = &step;
    regime.limit = step.one_arch && std::isfinite(level) ? limit_of(y, room) : -never;
    return regime;
  }
  /// Up to where y surely stays before what is ahead.
  static double limit_of(double y, double room) noexcept {
    return room < never ? y + room - round_off * (std::abs(y) + room) : never;
  }

 private:
  static constexpr double round_off = 0x1p-40;
};

/// A slider whose levels are constant, on level ground: all that its motion depends on.
struct LinearLevels {
  double resist_forward, resist_backward, hold_forward, hold_backward;  ///< [m/s^2]
  Bounds bounds;
  const LinearStepOf* step;

  double resist(double sign) const noexcept { return sign > 0 ? resist_forward : resist_backward; }
  double hold(double sign) const noexcept { return sign > 0 ? hold_forward : hold_backward; }
  double room(double sign, double x) const noexcept {
    return bounds.room(sign > 0 ? Direction::forward : Direction::backward, x);
  }

  LinearRegime regime(const State& state) const noexcept {
    const double x = state.displacement;
    if (state.mode == Mode::stuck)
      return LinearRegime::at_rest(step->stiffness * x, bounds.bound(Direction::forward, x, hold_forward),
                                   bounds.bound(Direction::backward, x, hold_backward));
    const double sign = stickslip::sign(direction_of(state.mode));
    return LinearRegime::sliding(sign, sign * x, resist(sign), 0, room(sign, x), *step);
  }
};

/// What a sweep keeps of a motion.
struct SweepWatch {
  double peak = 0;              ///< largest |x| [m]
  double sliding_distance = 0;  ///< [m]
  double slip_from = 0;         ///< x where the current slip began [m]
  std::size_t events = 0;
  Impacts impacts{};

  void slide(const Slip&) const noexcept {}
  void event(EventKind kind, double, const State& state) noexcept {
    ++events;
    if (kind == EventKind::impact) impacts.add(state.displacement, state.velocity);
    add(state);
  }
  void add(const State& state) noexcept { pass(state.displacement); }
  void pass(double x) noexcept {
    peak = std::max(peak, std::abs(x));
    sliding_distance += std::abs(x - slip_from);
    slip_from = x;
  }
};

/// A slider on level ground without vertical motion, under segments of one duration.
class LinearMover {
 public:
  virtual ~LinearMover() = default;

  virtual LinearRegime regime(const State& state) const = 0;
  /// Null if they are not constant.
  virtual const LinearLevels* levels() const = 0;
  /// Moves the memory of the law over a distance within the regime [m].
  virtual void slid(State& state, double distance) const = 0;
  /// Moves it through a segment by the event loop.
  virtual void advance(const Segment& segment, State& state, SweepWatch& watch) const = 0;
  /// Moves it without ground acceleration until it comes to rest.
  virtual void settle(State& state, SweepWatch& watch) const = 0;
};

/// Whether motions under a law are linear between two events.
template <class Law>
inline constexpr bool moves_linearly = form_of<Law> == Form::constant ||
                                       (MemoryLaw<Law> && form_of<Law> == Form::linear);

template <FrictionLaw Law, class Flows>
class LinearMoverOf final : public LinearMover {
 public:
  /// @param slider  held by reference
  LinearMoverOf(const Slider<Law>& slider, const Flows& flows, double duration)
      : slider_(slider),
        flows_(flows),
        bounds_(slider.mounting().stops, slider.mounting().one_way),
        duration_(duration) {
    if constexpr (form_of<Law> == Form::constant && !MemoryLaw<Law>) {
      const auto of = [&](auto&& level, Direction direction) { return level(flows_.law_now(State(), 1), direction); };
      const auto resists = [](const auto& law, Direction way) { return stickslip::resist(law, 0.0, 0.0, way); };
      const auto holds = [](const auto& law, Direction way) { return stickslip::hold(law, 0.0, way); };
      const double backward = slider.mounting().one_way ? never : of(holds, Direction::backward);
      levels_ = {of(resists, Direction::forward),
                 of(resists, Direction::backward),
                 of(holds, Direction::forward),
                 backward,
                 bounds_,
                 &step(slider_.stiffness())};
    }
  }

  const LinearLevels* levels() const override { return levels_ ? &*levels_ : nullptr; }

  LinearRegime regime(const State& state) const override {
    if (levels_) return levels_->regime(state);
    const double x = state.displacement;
    if (state.mode == Mode::stuck) {
      const auto law = flows_.law_now(state, 1);
      const auto holds = [&](Direction direction) { return bounds_.bound(direction, x, hold(law, x, direction)); };
      return LinearRegime::at_rest(flows_.pull(x, 1), holds(Direction::forward), holds(Direction::backward));
    }
    const Direction direction = direction_of(state.mode);
    const auto law = flows_.law_toward(direction, state, 1);
    const double sign = stickslip::sign(direction);
    double rises = 0;
    if constexpr (form_of<Law> == Form::linear) rises = law.slope(direction);
    return LinearRegime::sliding(sign, sign * x, resist(law, x, std::abs(state.velocity), direction), rises,
                                 std::min(flows_.surely_ahead(state), bounds_.room(direction, x)),
                                 step(slider_.stiffness() + rises));
  }

  void slid([[maybe_unused]] State& state, [[maybe_unused]] double distance) const override {
    if constexpr (MemoryLaw<Law>) flows_.slid_surely(state, distance);
  }

  void advance(const Segment& segment, State& state, SweepWatch& watch) const override {
    StateOf<Law> moving(state);
    if (slider_.plain())
      detail::advance(flows_, segment, moving, watch);
    else
      detail::advance(flows_, load_segment(segment, Slope(0)), bounds_, Contact::flight, moving, watch);
    store(moving, state);
  }

  void settle(State& state, SweepWatch& watch) const override {
    const EngineOf<Law> engine(slider_);
    ObserverSink sink(watch);
    detail::settle(engine, state, [&](double duration) {
      detail::advance(engine, Segment{duration, 0, 0}, !slider_.plain(), Contact::flight, state, sink);
    });
  }

 private:
  const LinearStepOf& step(double stiffness) const {
    for (const auto& one : steps_)
      if (equal(one->stiffness, stiffness)) return *one;
    return *steps_.emplace_back(std::make_unique<LinearStepOf>(slider_.damping(), stiffness, duration_));
  }

  const Slider<Law>& slider_;
  Flows flows_;
  Bounds bounds_;
  double duration_;                                           // of the segments [s]
  mutable std::vector<std::unique_ptr<LinearStepOf>> steps_;  // those met so far: a law has few slopes
  std::optional<LinearLevels> levels_;
};

/// The mover of a slider, held by reference; null if it is on a slope, or its motion is not linear between events.
/// @param duration  of the segments [s]
template <FrictionLaw Law>
std::unique_ptr<LinearMover> linear_mover(const Slider<Law>& slider, double duration) {
  std::unique_ptr<LinearMover> mover;
  if constexpr (moves_linearly<Law>)
    if (equal(slider.mounting().slope_degrees, 0))
      with_flows(slider, false, duration, [&]<class Flows>(const Flows& flows) {
        mover = std::make_unique<LinearMoverOf<Law, Flows>>(slider, flows, duration);
      });
  return mover;
}

}  // namespace stickslip::detail

#ifdef STICKSLIP_LIBRARY  // the linked library contains those of its laws
#include "stickslip/friction/laws.hpp"
namespace stickslip::detail {
#define STICKSLIP_LINEAR_MOVER(...) \
  template std::unique_ptr<LinearMover> linear_mover(const Slider<__VA_ARGS__>&, double);
#define STICKSLIP_EXTERN_LINEAR_MOVER(...) extern STICKSLIP_LINEAR_MOVER(__VA_ARGS__)
STICKSLIP_LAWS(STICKSLIP_EXTERN_LINEAR_MOVER)
#undef STICKSLIP_EXTERN_LINEAR_MOVER
}  // namespace stickslip::detail
#endif
