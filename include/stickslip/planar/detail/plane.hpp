// A slider in the plane, as a sliding system.
#pragma once

#include <cmath>
#include <limits>
#include <type_traits>
#include <utility>

#include "stickslip/base/equal.hpp"
#include "stickslip/base/error.hpp"
#include "stickslip/base/min_max.hpp"
#include "stickslip/base/units.hpp"
#include "stickslip/friction/law.hpp"
#include "stickslip/planar/detail/departure.hpp"
#include "stickslip/planar/detail/heated.hpp"
#include "stickslip/planar/detail/level_along.hpp"
#include "stickslip/planar/detail/radius.hpp"
#include "stickslip/planar/flow.hpp"
#include "stickslip/planar/observer.hpp"
#include "stickslip/planar/segment.hpp"
#include "stickslip/planar/slider.hpp"
#include "stickslip/planar/state.hpp"
#include "stickslip/run/detail/loop.hpp"
#include "stickslip/run/detail/system.hpp"
#include "stickslip/sliding/observer.hpp"

namespace stickslip::detail {

/// The part of a planar flow up to a parameter.
struct PlanarLeg {
  double last;  ///< parameter of the flow
  PlanarProgress end;
};

/// A slip in the plane, and the law from which it was computed.
template <class Law>
struct PlanarSlide {
  Law law;
  PlanarFlow<Law> flow;
  double stop;

  template <class... Arguments>
  PlanarSlide(const Law& now, const Mounting& mounting, Arguments&&... arguments)
      : law(now), flow(mounting, law, std::forward<Arguments>(arguments)...), stop(flow.stop()) {}
  PlanarLeg whole() const noexcept { return {flow.last, flow.end}; }
  PlanarLeg until(double) const noexcept { return whole(); }
};

/// Where a slip meets the stop or a change of its law.
struct PlanarPassage {
  bool passes = false;
  bool changes_law = false;
  PlanarLeg leg{};
};

/// When and how a slider at rest begins to slip.
struct PlanarDeparture {
  PlanarMode mode = PlanarMode::stuck;
  double delay = 0;       ///< from now [s]
  bool at_level = false;  ///< whether the load then equals the level
  int side = 0;           ///< at a stop: the direction along it (PlanarFlow)

  bool departs() const noexcept { return mode != PlanarMode::stuck; }
};

/// A slider in the plane during one segment (a SlidingSystem).
template <IsotropicLaw Law>
class Plane {
 public:
  static constexpr int most_steps = 3'000'000;
  static constexpr bool heated = HeatedLaw<Law>;

  /// @param touching  whether the ground carries it: otherwise there is no friction
  Plane(const PlanarSlider<Law>& slider, const PlanarLoadSegment& segment, bool touching, PlanarState& state)
      : slider_(slider),
        segment_(segment),
        weight_start_(touching ? segment.normal_start / standard_gravity : 0),
        weight_end_(touching ? segment.normal_end / standard_gravity : 0),
        gap_(slider.mounting().stops.forward()),
        state_(state),
        left_(segment.duration) {}

  double left() const noexcept { return left_; }
  double elapsed() const noexcept { return segment_.duration - left_; }
  const PlanarState& state() const noexcept { return state_; }
  /// The state in which it has just stopped; by now the surface has cooled.
  decltype(auto) resting_state() const noexcept {
    if constexpr (heated) {
      PlanarState at = state_;
      at.heat = heat_at_rest_;
      return at;
    } else {
      return (state_);
    }
  }
  bool at_rest() const noexcept { return state_.mode == PlanarMode::stuck; }
  bool has_stopped() const noexcept { return stopped_; }

  PlanarDeparture departure() {
    const PlanarLoad load = load_now();
    if constexpr (heated) return heated_departure(load);
    const double holds = stickslip::hold(law_now(), 0.0, Direction::forward);
    const double level = load.weight * holds, level_rate = load.weight_rate * holds;
    const Vector2 q = load.start - pull(load.weight),
                  rate = load.rate - spring().rate(load.weight_rate) * state_.displacement;
    if (!at_stop()) return slips(exceeds(q, rate, level, level_rate, left_), q, rate, level, PlanarMode::sliding);
    // Pressed against the stop, only the load along it has to be held.
    const LoadAtStop net = load_at_stop(load);
    bool pressed = net.first.axis > 0 || (equal(net.first.axis, 0) && net.last.axis > 0);
    const double turns =
        pressed != (net.last.axis > 0) ? left_ * (net.first.axis / (net.first.axis - net.last.axis)) : left_;
    const auto held_by = [&](double level_then, Vector2 load_then) {
      return pressed ? net.along(load_then, level_then) : load_then;
    };
    const Vector2 net_rate = net.rate();
    const auto within = [&](double from, double until) {
      const double level_then = level + from * level_rate;
      return from + exceeds(held_by(level_then, net.at(from)), pressed ? Vector2{0, net_rate.transverse} : net_rate,
                            level_then, level_rate, until - from);
    };
    double delay = within(0, turns);
    if (!(delay < never) && turns < left_) {
      pressed = !pressed;
      delay = within(turns, left_);
    }
    PlanarDeparture departure = slips(delay, held_by(level, net.first), net_rate, level,
                                      pressed ? PlanarMode::along_stop : PlanarMode::sliding);
    departure.side = net.side(delay);
    return departure;
  }

  Resumption depart(const PlanarDeparture& departure) noexcept {
    state_.mode = departure.mode;
    left_ -= departure.delay;
    start_ = departure.at_level ? PlanarStart::at_level : PlanarStart::above_level;
    side_ = departure.side;
    if (!std::exchange(stopped_, false)) return Resumption::from_rest;
    if (turned_) return Resumption::onward;
    const PlanarLoad load = load_now();
    return dot(load.start - pull(load.weight), arrived_) > 0 ? Resumption::onward : Resumption::reversed;
  }

  auto slide() {
    if (norm(state_.velocity) > 0) {
      start_ = PlanarStart::moving;
      side_ = state_.mode != PlanarMode::along_stop ? 0 : cross(state_.displacement, state_.velocity) < 0 ? -1 : 1;
    }
    const PlanarLoad load = load_now();
    const auto over = [&]<class Now>(const Now& law, double duration) {
      return PlanarSlide<Now>(law, slider_.mounting(), state_.displacement, state_.velocity, start_, side_, load,
                              duration, patience_);
    };
    auto slide = [&] {
      if constexpr (heated) {
        const auto weight = [&](double time) { return std::max(load.weight + load.weight_rate * time, 0.0); };
        return heating_.template slide<PlanarSlide<HeatedStep<Law>>>(state_, left_, covers(), over, weight);
      } else {
        return over(std::remove_cvref_t<decltype(law_now())>(law_now()), left_);
      }
    }();
    state_.mode = slide.flow.along_stop ? PlanarMode::along_stop : PlanarMode::sliding;
    return slide;
  }

  template <class Slide>
  PlanarPassage passage(const Slide& slide) const {
    const auto& flow = slide.flow;
    PlanarPassage passage{false, false, slide.whole()};
    const auto shorten = [&](double parameter, bool changes_law) {
      if (!(parameter < never) || parameter > passage.leg.last) return;
      passage = {true, changes_law, {parameter, flow.at_parameter(parameter)}};
    };
    if constexpr (heated) {
      const double edge = slider_.law().edge();
      if (edge < never) shorten(parameter_at_radius(flow, edge, covers()), true);
    } else if constexpr (MemoryLaw<Law>) {
      const double ahead = slider_.law().ahead(along_path(), Direction::forward);
      if (ahead < flow.end.distance) shorten(flow.parameter_at_distance(ahead, flow.last), true);
    }
    if (gap_ < never && !flow.along_stop) shorten(parameter_at_radius(flow, gap_, true), false);
    return passage;
  }

  template <class Slide, class Observer>
  void show(const Slide& slide, const PlanarLeg& leg, Observer& observer) const {
    if constexpr (requires { observer.follow(slide.flow, leg.last, elapsed()); })
      observer.follow(slide.flow, leg.last, elapsed());
  }

  /// To the place of a passage. @return whether the segment goes on
  template <class Slide, class Observer>
  bool pass(const Slide& slide, const PlanarPassage& passage, Observer& observer) {
    const double before = state_.sliding_distance;
    go(passage.leg);
    if constexpr (heated) {
      if (passage.changes_law) {
        state_.displacement = (slider_.law().edge() / norm(state_.displacement)) * state_.displacement;
        return left_ > 0;
      }
    } else if constexpr (MemoryLaw<Law>) {
      if (passage.changes_law) {
        State there = along_path();
        there.sliding_distance = before;
        slider_.law().pass(there, Direction::forward);
        state_.sliding_distance = there.sliding_distance;
        return left_ > 0;
      }
    }
    return strike(slide, observer);
  }

  /// To the end of a flow that does not stop. @return whether the segment goes on
  template <class Slide>
  bool proceed(const Slide&, const PlanarLeg& leg) {
    const bool ends = !(leg.end.time < left_);
    go(leg);
    if (state_.mode == PlanarMode::along_stop)
      state_.displacement = (gap_ / norm(state_.displacement)) * state_.displacement;
    // A slip too slow for doubles would never end.
    if (!(norm(state_.velocity) > std::numeric_limits<double>::min())) {
      arrived_ = leg.end.way;
      rest();
      return left_ > 0;
    }
    return !ends;
  }

  template <class Slide>
  void stop(const Slide& slide, const PlanarLeg& leg) {
    arrived_ = state_.velocity;
    go(leg);
    if (state_.mode == PlanarMode::along_stop) {
      state_.displacement = (gap_ / norm(state_.displacement)) * state_.displacement;
      arrived_ = slide.flow.at_parameter(leg.last / 2).velocity;
    }
    rest();
    turned_ = slide.flow.turns;
  }

  [[noreturn, gnu::noinline]] void stall() const {
    throw ConvergenceError(
        "advance: in a segment of " + shortest(segment_.duration) +
        " s the motion changes faster than its time can be resolved, at r = (" + shortest(state_.displacement.axis) +
        ", " + shortest(state_.displacement.transverse) + ") m, |r'| = " + shortest(norm(state_.velocity)) + " m/s, " +
        shortest(left_) +
        " s before its end: the spring or damper is too stiff, or the acceleration or the slip level too large, for a "
        "segment this long");
  }

 private:
  Spring spring() const noexcept { return slider_.mounting().spring(); }
  Vector2 pull(double weight) const noexcept { return spring().under(weight) * state_.displacement; }
  State along_path() const noexcept { return on_path<Law>(state_); }
  decltype(auto) law_now() const { return law_at(slider_.law(), along_path(), load_now().weight); }

  PlanarLoad load_now() const noexcept {
    const double by = 1 / segment_.duration, part = left_ * by;
    const Vector2 change = segment_.load_end - segment_.load_start;
    const double gained = weight_end_ - weight_start_;
    if (equal(left_, segment_.duration)) return {segment_.load_start, by * change, weight_start_, gained * by};
    return {segment_.load_end - part * change, by * change, std::max(weight_end_ - part * gained, 0.0), gained * by};
  }

  PlanarDeparture slips(double delay, Vector2 q, Vector2 rate, double level, PlanarMode mode) const {
    if (!(delay < never)) return {};
    const bool at_level = delay > 0 || !(norm(q + delay * rate) > level);
    if constexpr (LawWithHold<Law>) {
      const double resists = stickslip::resist(law_now(), 0.0, 0.0, Direction::forward);
      return {mode, delay, at_level && equal(resists, stickslip::hold(law_now(), 0.0, Direction::forward))};
    } else {
      return {mode, delay, at_level};
    }
  }

  bool at_stop() const noexcept { return gap_ < never && norm(state_.displacement) >= gap_ * (1 - 0x1p-48); }

  // The load at rest at the stop, without that of the spring, now and at the end of the segment: its components outward
  // and along the stop. They are small differences of larger numbers, of which round-off is no load.
  struct LoadAtStop {
    Vector2 first, last;
    double left, round_off;

    // A load along the stop that differs from a level by round-off is equal to it.
    Vector2 along(Vector2 load, double level) const noexcept {
      const double size = std::abs(load.transverse);
      return {0, std::abs(size - level) <= round_off ? std::copysign(level, load.transverse) : load.transverse};
    }
    Vector2 at(double time) const noexcept {
      const double part = time / left;
      return (1 - part) * first + part * last;
    }
    Vector2 rate() const noexcept { return (1 / left) * (last - first); }
    // The direction along the stop in which a slip begins.
    int side(double time) const noexcept {
      const double from = first.transverse, to = last.transverse, load = time < left ? at(time).transverse : to;
      const bool vanishes = std::abs(load) <= 0x1p-48 * std::max(std::abs(from), std::abs(to));
      return (vanishes ? to - from : load) < 0 ? -1 : 1;
    }
  };
  LoadAtStop load_at_stop(const PlanarLoad& load) const noexcept {
    const double far = norm(state_.displacement);
    const Vector2 outward = (1 / far) * state_.displacement, sideways = turned(outward);
    const double largest = std::max(norm(segment_.load_start), norm(segment_.load_end));
    const double pull_now = spring().under(load.weight) * far, pull_at_end = spring().under(weight_end_) * far;
    const double round_off = 0x1p-48 * (largest + std::max(pull_now, pull_at_end));
    const auto components = [&](Vector2 of, double pulls) {
      const double out = dot(of, outward) - pulls, aside = dot(of, sideways);
      return Vector2{std::abs(out) <= round_off ? 0 : out, std::abs(aside) <= round_off ? 0 : aside};
    };
    return {components(load.start, pull_now), components(segment_.load_end, pull_at_end), left_, round_off};
  }

  void go(const PlanarLeg& leg) noexcept {
    state_.displacement += leg.end.way;
    state_.velocity = leg.end.velocity;
    state_.sliding_distance += leg.end.distance;
    left_ = leg.end.time < left_ ? pass_time(left_, leg.end.time) : 0;
    if constexpr (heated) heating_.heat(leg.end.time, state_.heat);
  }
  void rest() noexcept {
    state_.velocity = {};
    state_.mode = PlanarMode::stuck;
    stopped_ = true;
    turned_ = false;
    if constexpr (heated) heat_at_rest_ = state_.heat;
  }

  // The radial velocity is reversed. Infinitely many bounces are skipped if they stay within round-off of the stop: the
  // slider then slides along it.
  template <class Slide, class Observer>
  bool strike(const Slide& slide, Observer& observer) {
    const Vector2 outward = (1 / norm(state_.displacement)) * state_.displacement;
    state_.displacement = gap_ * outward;
    const double radial = std::max(dot(state_.velocity, outward), 0.0), aside = dot(state_.velocity, turned(outward));
    if (!(radial > 0x1p-40 * std::abs(aside))) {  // it comes in along the stop
      arrived_ = state_.velocity = aside * turned(outward);
      state_.mode = PlanarMode::along_stop;
      if (!(norm(state_.velocity) > 0)) rest();
      return left_ > 0;
    }
    observer.event(EventKind::impact, elapsed(), state_);
    double back = slider_.mounting().stops.restitution() * radial;
    const PlanarLoad load = load_now();
    const double speed = std::hypot(back, aside);
    const double resists =
        load.weight * (speed > 0 ? level_along(slide.law, 0.0, speed, 0.0) : 0.0) * (speed > 0 ? back / speed : 0);
    const double outward_push = dot(load.start - pull(load.weight), outward) + aside * aside / gap_;
    bool pressed = false;
    if (outward_push > resists && back * back <= 0x1p-60 * gap_ * (outward_push - resists)) {
      back = 0;
      pressed = true;
    }
    if constexpr (PlanarEnergyObserver<Observer>) observer.lose((radial * radial - back * back) / 2);
    state_.velocity = aside * turned(outward) - back * outward;
    arrived_ = radial * outward;
    if (norm(state_.velocity) > 0) {
      state_.mode = pressed ? PlanarMode::along_stop : PlanarMode::sliding;
    } else {
      rest();
      turned_ = true;  // a slip away from the stop is a rebound, not a reversal
    }
    return left_ > 0 || at_rest();
  }

  // Whether the slider covers the middle of the surface, whose temperature matters. At the edge, the velocity decides.
  bool covers() const noexcept requires heated {
    const double edge = slider_.law().edge(), place = norm(state_.displacement);
    if (!(std::abs(place - edge) <= 0x1p-40 * edge)) return place < edge;
    return dot(state_.displacement, state_.velocity) < 0;
  }

  // The level rises as the surface cools.
  PlanarDeparture heated_departure(const PlanarLoad& load) requires heated {
    const auto weight = [&](double time) { return std::max(load.weight + load.weight_rate * time, 0.0); };
    const bool stop = at_stop();
    const LoadAtStop net = stop ? load_at_stop(load) : LoadAtStop{};
    const auto presses = [&](double time) { return stop && net.at(time).axis > 0; };
    const auto excess = [&](double time, double level) {
      const Vector2 q = presses(time) ? net.along(net.at(time), level)
                        : stop        ? net.at(time)
                                      : load.start + time * load.rate - pull(weight(time));
      return dot(q, q) - level * level;
    };
    const double now = load.weight * slider_.law().level(0, load.weight, state_.heat.half_integral());
    const bool exceeds_now = excess(0, now) > 0;
    const double delay = heating_.departure(state_.heat, left_, weight, excess);
    if (!(delay < never)) return {};
    return {presses(delay) ? PlanarMode::along_stop : PlanarMode::sliding, delay, delay > 0 || !exceeds_now,
            stop ? net.side(delay) : 0};
  }

  const PlanarSlider<Law>& slider_;
  const PlanarLoadSegment& segment_;
  double weight_start_, weight_end_, gap_;
  PlanarState& state_;
  double left_;                              // time to the end of the segment [s]
  PlanarStart start_ = PlanarStart::moving;  // of the next flow,
  int side_ = 0;                             // and its direction along the stop, 0 away from it
  bool turned_ = false;                      // whether the last stop was a turn that takes no time
  bool stopped_ = false;                     // whether a slip has just stopped,
  [[no_unique_address]] HeatingOf<Law> heating_{slider_.law()};
  struct Cold {};
  [[no_unique_address]] std::conditional_t<heated, SurfaceHeat, Cold> heat_at_rest_{};
  PlanarPatience patience_;
  Vector2 arrived_{};  // and its last velocity [m/s]
};

}  // namespace stickslip::detail
