// The event loop: integrate one slider over one segment.
#pragma once

#include <cmath>
#include <concepts>
#include <limits>
#include <utility>

#include "stickslip/base/equal.hpp"
#include "stickslip/base/min_max.hpp"
#include "stickslip/error.hpp"
#include "stickslip/flow/closed_form.hpp"
#include "stickslip/flow/collocation.hpp"
#include "stickslip/friction/law.hpp"
#include "stickslip/ground/segment.hpp"
#include "stickslip/numerics/root.hpp"
#include "stickslip/sliding/observer.hpp"
#include "stickslip/state.hpp"
#include "stickslip/stops.hpp"

namespace stickslip::detail {

/// Stops an event loop that takes too many steps, or meets numbers that overflow, within a hundredth of its segment.
/// @tparam max_steps  in a hundredth of the segment
template <int max_steps>
class Standstill {
 public:
  explicit Standstill(double duration) : mark_(duration) {}

  /// @param left  time to the end of the segment [s]
  void count(double left, double duration, const State& state) {
    if (++steps_ < max_steps) [[likely]]
      return;
    if (!(mark_ - left >= duration / 100)) refuse(duration, left, state);
    steps_ = 0;
    mark_ = left;
  }

 private:
  [[noreturn, gnu::noinline]] static void refuse(double duration, double left, State state) {
    throw ConvergenceError(
        "advance: in a segment of " + shortest(duration) +
        " s the motion changes faster than its time can be resolved, at x = " + shortest(state.displacement) +
        " m, x' = " + shortest(state.velocity) + " m/s, " + shortest(left) +
        " s before its end: the spring or damper is too stiff, or the acceleration or the slip "
        "level too large, for a segment this long");
  }

  double mark_;  // time left at the last check [s]
  int steps_ = 0;
};

/// No stops; the slider can move both ways.
struct Unbounded {
  static constexpr double room(Direction, double) noexcept { return never; }
  static constexpr double bound(Direction, double, double level) noexcept { return level; }
};

/// The bounds on displacement: stops, and sliding that is restricted to one direction.
struct Bounds {
  Stops stops;
  bool one_way;

  double wall(Direction direction) const noexcept {
    return direction == Direction::forward ? stops.forward() : -stops.backward();
  }
  /// Distance to the wall [m].
  double room(Direction direction, double x) const noexcept { return sign(direction) * (wall(direction) - x); }
  /// The load that can be held at x: the friction level, or any load at a wall.
  double bound(Direction direction, double x, double level) const noexcept {
    return room(direction, x) <= 0 || (one_way && direction == Direction::backward) ? never : level;
  }
  /// Whether a slider on a spring of stiffness k per unit mass certainly stays between the bounds during a segment of
  /// duration T. Friction and dampers only reduce the speed, so that |v| <= |v0| + T (|p| + k (|x0| + D)), and the
  /// distance D from x0 is at most
  ///     D = T (|v0| + T/2 (|p| + k |x0|)) / (1 - k T^2 / 2).
  bool out_of_reach(const LoadSegment& segment, double k, const State& state) const noexcept {
    const double nearest = one_way ? 0 : std::min(stops.forward(), stops.backward());
    if (!(nearest < never)) return true;
    const double x = std::abs(state.displacement), time = segment.duration;
    const double load = std::max(std::abs(segment.load_start), std::abs(segment.load_end)) + k * x;
    const double way = time * (std::abs(state.velocity) + time / 2 * load), shrinks = k * time * time / 2;
    return shrinks < 0.5 && x + 2 * way < nearest;
  }
};

/// The bounces of a slider that leaves a stop at speed u while a constant net load q pushes it back, against friction
/// a < q. Each bounce multiplies the speed by rho = e sqrt((q - a) / (q + a)), so that infinitely many take a finite
/// time.
struct Bounces {
  double time;      ///< total time of all bounces [s]
  double distance;  ///< total distance of all bounces [m]

  Bounces(double u, double q, double a, double restitution) noexcept {
    const double k = std::sqrt((q - a) / (q + a)), rho = restitution * k;
    time = u * (1 + 1 / k) / ((q + a) * (1 - rho));
    distance = u * u / ((q + a) * (1 - rho * rho));
  }
};

/// A segment with a normal force, expressed as a weight N/g.
template <class Piece>
concept LoadedPiece = requires(const Piece& piece) {
  piece.weight(0.0);
};

/// The departure of a slider at rest whose level changes as its surface cools. `pull(left)` is the force of the spring,
/// and `bound(direction, level)` the load that can be held with a level. The margins are approximated by polynomials on
/// successive parts of the time, to 1e-9 of the level. On return the surface has the state at the departure, or at the
/// end if there is none.
template <HeatedLaw Law, class Piece, class Pull, class Bound>
[[gnu::noinline]] Departure heated_departure(const Law& law, const Piece& segment, State& state, double left,
                                             Cooling& cooling, const Pull& pull, const Bound& bound) {
  const Nodes& nodes = Nodes::get();
  for (double passed = 0, step = left;;) {
    const Nodes::Values half = cooling.half_integrals(state.heat, step);
    Nodes::Values holds, net;
    double scale = 0;
    for (std::size_t i = 0; i < half.size(); ++i) {
      const double then = std::max(left - (passed + nodes.nodes[i] * step), 0.0);
      double weight = 1;
      if constexpr (LoadedPiece<Piece>) weight = segment.weight(then);
      holds[i] = weight * law.level(0, weight, half[i]);
      net[i] = segment.load_before_end(then) - pull(then);
      scale = std::max(scale, std::abs(net[i]) + holds[i]);
    }
    bool resolved = true;
    const auto first_exceeded = [&](Direction direction) -> double {
      if (!(bound(direction, 0.0) < never)) return never;
      Nodes::Values margin, powers;
      for (std::size_t i = 0; i < margin.size(); ++i) margin[i] = holds[i] - sign(direction) * net[i];
      const Nodes::Values c = nodes.chebyshev(margin);
      resolved = resolved && std::abs(c[c.size() - 1]) + std::abs(c[c.size() - 2]) <= 1e-9 * scale;
      int degree = Nodes::powers(c, 1e-15 * scale, powers);
      const double* from = powers.data();
      if (!(margin[0] > 0))  // a load equal to the level is held
        for (++from, --degree; degree >= 0 && equal(*from, 0);) ++from, --degree;
      if (degree < 0) return never;
      return *from > 0 ? FirstRoot(from, degree).find() : 0;
    };
    const double forward = first_exceeded(Direction::forward), backward = first_exceeded(Direction::backward);
    if (!resolved && step > 0x1p-40 * left) {
      step /= 2;
      continue;
    }
    const double part = std::min(forward, backward);
    if (part <= 1) {
      state.heat.rest(part * step);
      return {forward <= backward ? Mode::forward : Mode::backward, passed + part * step};
    }
    state.heat.rest(step);
    passed += step;
    if (!(passed < left)) return {};
    step = std::min(2 * step, left - passed);
  }
}

/// The event loop over a segment of any kind (segment.hpp). `flows` makes the flows of the law under the segment's
/// load.
template <FrictionLaw Law, class Flows, class Piece, MotionObserver Observer, class Within = Unbounded>
[[gnu::always_inline]] inline void advance(const Law& law, const Flows& flows, const Piece& segment, State& state,
                                           Observer& observer, const Within& within = {}) {
  constexpr bool loaded = LoadedPiece<Piece>, bounded = !std::same_as<Within, Unbounded>;
  if (!(segment.duration > 0)) return;
  double left = segment.duration;
  constexpr bool in_closed_form = requires { typename Flows::Basis; };
  Standstill<in_closed_form ? 1'000'000 : 3'000'000> standstill(segment.duration);
  // The factor on friction at time `until_end` before the end of the segment, and the pull of the spring.
  const auto weigh = [&](double until_end, double level) {
    if constexpr (loaded) return Piece::weigh(segment.weight(until_end), level);
    return level;
  };
  const auto pull_at = [&](double until_end) {
    if constexpr (loaded && requires { flows.pendulum(); })
      if (flows.pendulum()) return segment.weight(until_end) * flows.pull(state.displacement);
    return flows.pull(state.displacement);
  };
  const auto pull = [&] { return pull_at(left); };
  const auto count_step = [&] {
    if constexpr (bounded || !requires { Flows::stops_twice_at_most; }) standstill.count(left, segment.duration, state);
  };
  double load = segment.first_load() - pull();  // all forces but friction
  Mode stopped = Mode::stuck;                   // the mode of a slip that has just stopped,
  bool instant = false;                         // and whether it took no time
  // After an impact, the distance from that stop is tracked separately, without cancellation.
  Direction struck = Direction::forward;
  double from_stop = -1;
  const auto law_then = [&](double until_end) -> decltype(auto) {
    if constexpr (loaded && HeatedLaw<Law>)
      return law_at(law, state, segment.weight(until_end));
    else
      return law_at(law, state);
  };
  const auto law_now = [&]() -> decltype(auto) { return law_then(left); };
  const auto slid = [&](double distance) {
    if constexpr (MemoryLaw<Law>) state.sliding_distance += distance;
  };
  const auto room_ahead = [&](Direction direction) {
    return from_stop >= 0 && direction == struck ? from_stop : within.room(direction, state.displacement);
  };
  // Net acceleration in the direction of sliding. From rest it is the excess of the load over the resistance: exactly
  // zero if the slider was held until the load reached the level.
  const auto acceleration = [&](Direction direction) {
    const double speed = std::abs(state.velocity);
    return sign(direction) * load - weigh(left, resist(law_now(), state.displacement, speed, direction)) -
           flows.drag(speed);
  };

  for (;;) {
    if (state.mode == Mode::stuck) {
      // A slip begins when the load exceeds the holding level, at once or later in this segment. A load equal to the
      // level is held.
      const auto holds = [&](Direction direction) {
        return within.bound(direction, state.displacement, hold(law_now(), state.displacement, direction));
      };
      const double holds_forward = holds(Direction::forward), holds_backward = holds(Direction::backward);
      const double forward = weigh(left, holds_forward), backward = weigh(left, holds_backward);
      double delay = 0;
      // A slip decelerates as it stops, so any excess of the load over the level is round-off, unless the speed only
      // touched zero.
      if (stopped != Mode::stuck) {
        const double tolerance = instant ? never : 0x1p-44 * (std::abs(load) + 2 * std::abs(pull()));
        if (stopped == Mode::forward && load - forward <= tolerance)
          load = std::min(load, forward);
        else if (stopped == Mode::backward && -load - backward <= tolerance)
          load = std::max(load, -backward);
      }
      if (load > forward) {
        state.mode = Mode::forward;
      } else if (load < -backward) {
        state.mode = Mode::backward;
      } else if (left > 0) {
        const Departure next = [&] {
          if constexpr (HeatedLaw<Law>)
            return heated_departure(
                law, segment, state, left, flows.cooling(), pull_at,
                [&](Direction direction, double level) { return within.bound(direction, state.displacement, level); });
          else
            return segment.departure(load, pull_at(0), holds_forward, holds_backward, left);
        }();
        if (next.mode != Mode::stuck) {
          state.mode = next.mode;
          delay = next.delay;
          const auto level = [&](Direction direction, double held) {
            if constexpr (HeatedLaw<Law>) held = hold(law_then(left - delay), state.displacement, direction);
            return weigh(left - delay, held);
          };
          load = next.mode == Mode::forward ? level(Direction::forward, holds_forward)
                                            : -level(Direction::backward, holds_backward);
        }
      }

      // A reversal is a stick of zero duration. If motion resumes in the same direction, the velocity merely touched
      // zero.
      const bool sticks = state.mode == Mode::stuck || delay > 0;
      if (sticks && stopped != Mode::stuck)
        observer.event(EventKind::arrest, segment.duration - left,
                       State{.displacement = state.displacement, .sliding_distance = state.sliding_distance});
      if (state.mode == Mode::stuck) return;
      left -= delay;
      if (sticks || stopped == Mode::stuck)
        observer.event(EventKind::breakaway, segment.duration - left, state);
      else if (stopped != state.mode)
        observer.event(EventKind::reversal, segment.duration - left, state);
      stopped = Mode::stuck;
      if (left <= 0) return;
    }

    const Direction direction = direction_of(state.mode);
    const double s = sign(direction);
    const double ground_load = load + pull();
    const auto start = [&] {
      const double speed = std::abs(state.velocity);
      if constexpr (loaded)
        return segment.slip(s, speed, acceleration(direction), ground_load, left,
                            resist(law_now(), state.displacement, speed, direction));
      else
        return segment.slip(s, speed, acceleration(direction), ground_load, left);
    }();
    const auto flow = [&] {
      if constexpr (MemoryLaw<Law>)
        return flows.flow(direction, state, start, left);
      else
        return flows.flow(direction, state.displacement, start, left);
    }();
    const double stop = flow.first_stop();
    const auto show = [&](double taken, const Progress& end, double gain) {
      if constexpr (requires { observer.follow(flow, taken); }) observer.follow(flow, taken);
      if constexpr (HeatedLaw<Law>) flow.heat(taken, state.heat);
      if constexpr (requires { observer.dissipate(0.0); }) {
        if constexpr (requires { flow.friction_work(taken); })
          observer.dissipate(flow.friction_work(taken));
        else if constexpr (loaded)
          observer.dissipate(start.friction_work(taken, left, end));
        else
          observer.dissipate(friction_work(law, state.displacement, end.distance, direction));
      }
      observer.slide(Slip{direction, state.displacement, end.distance, taken,
                          start.work(flow, s * ground_load, gain, taken, end)});
    };
    if constexpr (bounded || MemoryLaw<Law>) {
      // Until the velocity is zero, x is monotonic: it passes a stop, or a change of the law, if it ends beyond it.
      const double to_stop = room_ahead(direction), to_change = [&]() -> double {
        if constexpr (MemoryLaw<Law>) return law.ahead(state, direction);
        return never;
      }();
      const double room = std::min(to_stop, to_change), most = stop < never ? stop : flow.horizon();
      const double way = (stop < never ? flow.at(stop) : flow.at_horizon()).distance;
      const double beyond = way - room;
      if (beyond > 0) {
        const auto excess = [&](double t) { return flow.at(t).distance - room; };
        const double taken = room > 0 ? numerics::root(excess, 0, -room, most, beyond) : 0, flow_left = left;
        Progress end = flow.at(taken);
        end.distance = room;
        end.speed = std::max(end.speed, 0.0);
        show(taken, end, start.gain_within(taken, left));
        count_step();
        left -= taken;
        state.velocity = s * end.speed;
        const auto load_now = [&] { return ground_load + s * start.gain_within(flow_left - left, flow_left) - pull(); };
        if constexpr (MemoryLaw<Law>)
          if (to_change < to_stop) {
            law.pass(state, direction);
            if (from_stop >= 0) from_stop += direction == struck ? -room : room;
            if (left <= 0) return;
            load = load_now();
            continue;
          }
        if constexpr (bounded) {
          slid(room);
          state.displacement = within.wall(direction);
          struck = direction;
          from_stop = 0;
          observer.event(EventKind::impact, segment.duration - left, state);
          load = load_now();
          const Direction back = opposite(direction);
          double speed = within.stops.restitution() * end.speed;
          if (!(within.bound(back, state.displacement, resist(law_now(), state.displacement, speed, back)) < never))
            speed = 0;
          // Skip infinitely many bounces if their total distance is below round-off and the load is practically
          // constant meanwhile.
          const double q = s * load, a = weigh(left, resist(law_now(), state.displacement, speed, direction));
          if (speed > 0 && q > a && left > 0) {
            const Bounces bounces(speed, q, a, within.stops.restitution());
            const double changes = std::abs(start.gain_within(flow_left, flow_left));
            if (bounces.distance <= 0x1p-52 * std::abs(state.displacement) &&
                changes * (bounces.time / flow_left) <= (q - a) / 1024) {
              left -= std::min(bounces.time, left);
              load = load_now();
              speed = 0;
            }
          }
          if constexpr (requires { observer.lose(0.0); }) observer.lose((end.speed * end.speed - speed * speed) / 2);
          state.velocity = -s * speed;
          state.mode = speed > 0 ? mode_of(back) : Mode::stuck;
          stopped = speed > 0 ? Mode::stuck : mode_of(direction);
          instant = false;
          if (left <= 0 && speed > 0) return;
          continue;
        }
      }
      if (from_stop >= 0) from_stop += direction == struck ? -way : way;
    }
    // These branches are kept separate on purpose: merging them slows the common case by 5 to 10 %.
    if (equal(stop, never)) {
      const double taken = flow.horizon();
      const Progress end = flow.at_horizon();
      const bool whole = equal(taken, left);
      const double gain = start.gain_within(taken, left);
      show(taken, end, gain);
      state.displacement += s * end.distance;
      slid(end.distance);
      state.velocity = s * std::max(end.speed, 0.0);
      if (whole) return;
      count_step();
      left -= taken;
      load = ground_load + s * gain - pull();
      // If the loads balance to the last digit, a slip too slow to change x would never end.
      if (std::abs(state.velocity) < std::numeric_limits<double>::min() && acceleration(direction) <= 0) {
        state.velocity = 0;
        stopped = std::exchange(state.mode, Mode::stuck);
        instant = false;
      }
    } else {
      const Progress end = flow.at(stop);
      const double gain = start.gain_within(stop, left);
      show(stop, end, gain);
      state.displacement += s * end.distance;
      slid(end.distance);
      state.velocity = 0;
      stopped = std::exchange(state.mode, Mode::stuck);
      instant = !(left - stop < left);
      count_step();
      left -= stop;
      load = ground_load + s * gain - pull();
    }
  }
}

}  // namespace stickslip::detail
