// The response of a slider at rest to one pulse.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "stickslip/base/equal.hpp"
#include "stickslip/base/error.hpp"
#include "stickslip/excitation/poisson.hpp"
#include "stickslip/friction/coulomb.hpp"
#include "stickslip/friction/law.hpp"
#include "stickslip/numerics/gauss_legendre.hpp"
#include "stickslip/slider/slider.hpp"
#include "stickslip/sliding/advance.hpp"
#include "stickslip/state/state.hpp"
#include "stickslip/theory/theory.hpp"

namespace stickslip::theory {

/// The motion that one pulse of ground acceleration causes.
struct PulseResponse {
  std::vector<double> time;          ///< [s] from the arrival of the pulse on
  std::vector<double> displacement;  ///< x minus the initial position [m]
  std::vector<double> velocity;      ///< x' [m/s]
  double offset = 0;                 ///< the last displacement [m], thesis (5.8); infinite where it never stops
  double peak = 0;                   ///< largest |displacement| over all time [m]
  double stop = 0;                   ///< when it has come to rest for good [s]; 0 if it never moves
  double velocity_square = 0;        ///< integral of x'^2 over all time [m^2/s], thesis (5.32)
};

}  // namespace stickslip::theory

namespace stickslip::detail {

/// The state during a response to a pulse, with the accumulated integral of x'^2.
struct Ride {
  State state{};
  double velocity_square = 0;  ///< integral of x'^2 so far [m^2/s]

  void uniform(double duration, double last_velocity) {
    const double v = state.velocity;
    state.displacement += (v + last_velocity) / 2 * duration;
    velocity_square += (v * v + v * last_velocity + last_velocity * last_velocity) / 3 * duration;
    state.velocity = last_velocity;
  }
};

/// Advances the slider under a constant ground acceleration and calls knot(time since the call, ride) at stops and
/// reversals. Coulomb friction: closed forms, without the event loop.
template <class Knot>
void hold(const Slider<Coulomb>& slider, double n, double duration, Ride& ride, Knot&& knot) {
  const Coulomb& law = slider.law();
  double left = duration;
  if (!equal(ride.state.velocity, 0)) {
    const double v = ride.state.velocity;
    const double acceleration = v > 0 ? -n - law.forward() : -n + law.backward();
    const double stop = -v / acceleration;
    if (!(stop >= 0 && stop <= left)) return ride.uniform(left, v + acceleration * left);
    ride.uniform(stop, 0);
    left -= stop;
    knot(duration - left, ride);
  }
  const double acceleration = -n > law.forward() ? -n - law.forward() : n > law.backward() ? -n + law.backward() : 0;
  if (!equal(acceleration, 0)) ride.uniform(left, acceleration * left);
}

/// The same for any law, by the event loop. Between events the velocity is analytic, so that its square is integrated
/// by Gauss-Legendre quadrature of eight points.
template <FrictionLaw Law, class Knot>
void hold(const Slider<Law>& slider, double n, double duration, Ride& ride, Knot&& knot) {
  struct Watch {
    std::vector<double> times{};
    void slide(const Slip&) const noexcept {}
    void event(EventKind, double time, const State&) { times.push_back(time); }
  } watch;
  State probe = ride.state;
  advance(slider, Segment{duration, n, n}, probe, watch);
  watch.times.push_back(duration);

  double from = 0;
  for (const double to : watch.times) {
    double now = from;
    const auto go = [&](double time) {
      advance(slider, Segment{time - now, n, n}, ride.state);
      now = time;
      return ride.state.velocity * ride.state.velocity;
    };
    ride.velocity_square += numerics::gauss_integral<8>(from, to, go);
    go(to);
    if (to < duration) knot(to, ride);
    from = to;
  }
}

/// Lets the slider slide over ground at rest until it stops. Returns the time to stop [s], infinite if it never stops.
inline double coast(const Slider<Coulomb>& slider, Ride& ride) {
  const double v = ride.state.velocity;
  if (equal(v, 0)) return 0;
  const double time = std::abs(v) / (v > 0 ? slider.law().forward() : slider.law().backward());
  ride.uniform(time, 0);
  return time;
}

template <FrictionLaw Law>
double coast(const Slider<Law>& slider, Ride& ride) {
  constexpr double never_stops = std::numeric_limits<double>::infinity();
  constexpr int max_doublings = 30;
  // The time to stop under the level at the current position. It is limited beyond x = 0, because the level may vanish
  // away from x = 0 and a long step would cost the event times their precision.
  const auto first_step = [&] {
    const Direction direction = direction_of(ride.state.mode);
    const double x = std::abs(ride.state.displacement), v = std::abs(ride.state.velocity);
    const auto time_to_stop = [&](double place) { return v / slider.law().resist(place, direction); };
    return std::min(time_to_stop(ride.state.displacement), std::max(x / v, time_to_stop(0)));
  };
  double time = 0, step = 0;
  for (int i = 0; ride.state.mode != Mode::stuck; ++i) {
    step = i == 0 ? first_step() : 2 * step;
    if (i > max_doublings || !std::isfinite(step)) {
      ride.state.displacement *= never_stops;
      return never_stops;
    }
    double stopped = step;
    try {
      hold(slider, 0, step, ride, [&](double now, const Ride&) { stopped = now; });
    } catch (const ConvergenceError&) {  // the level is practically zero
      step = never_stops;
      continue;
    }
    time += ride.state.mode == Mode::stuck ? stopped : step;
  }
  return time;
}

struct NoKnot {
  void operator()(double, const Ride&) const noexcept {}
};

/// Simulates one pulse from rest at `position` until the slider stops; calls knot(time, ride) at the edges of the
/// pulse, at stops and turns, and at the end. The slider has no spring.
template <FrictionLaw Law, class Knot = NoKnot>
Ride ride(const Slider<Law>& slider, const PulseShape& shape, double b, double dt, double position, Knot&& knot = {}) {
  Ride ride{State::at(position, 0)};
  const auto times = shape.times();
  double rounding = 0;
  for (std::size_t i = 0; i + 1 < times.size(); ++i) {
    const double begin = times[i] * dt;
    rounding += 1e-15 * std::abs(b * shape.values()[i]) * (times[i + 1] - times[i]) * dt;
    knot(begin, ride);
    hold(slider, b * shape.values()[i], (times[i + 1] - times[i]) * dt, ride,
         [&](double now, const Ride& there) { knot(begin + now, there); });
  }
  const double end = shape.length() * dt;
  // A velocity that is only round-off would never stop where the slip level is zero.
  if (std::abs(ride.state.velocity) <= rounding) ride.state = State::at(ride.state.displacement, 0);
  knot(end, ride);
  if (const double more = coast(slider, ride); more > 0) knot(end + more, ride);
  return ride;
}

void check_pulse(double b, double dt, std::span<const double> times);

inline void require_no_spring(double natural_frequency, const char* theory) {
  require(equal(natural_frequency, 0),
          std::string(theory) +
              ": a slider with a spring is not covered, natural_frequency "
              "must be 0",
          natural_frequency, "rad/s");
}

}  // namespace stickslip::detail

namespace stickslip::theory {

/// The response of a slider at rest to one pulse, thesis (5.7), (5.8), (5.32): x'' + level sgn x' = -b w(t / dt).
///
/// Coulomb friction in closed form (its velocity is straight between the instants that are answered without `times`),
/// any other law by the event loop, `advance`: a pulse is a few held loads, and what it does is not random.
/// @param slider    without a spring
/// @param b         amplitude [m/s^2], finite
/// @param dt        half width [s], positive and finite; the unit of the shape's times
/// @param shape     of the pulse
/// @param position  initial position [m], finite; matters only if the slip level depends on the position
/// @param times     output times [s], ascending, finite, at least 0; empty: the edges of the pulse, stops and turns
/// @return displacements less `position`; all over where the motion is
/// @throws std::invalid_argument naming the value
/// Accuracy and cost: Coulomb to round-off, 30 ns; other laws to about 1e-10, some 20 us.
template <FrictionLaw Law>
PulseResponse pulse_response(const Slider<Law>& slider, double b, double dt, const PulseShape& shape = {},
                             double position = 0, std::span<const double> times = {}) {
  detail::check_pulse(b, dt, times);
  detail::require_no_spring(slider.natural_frequency(), "pulse_response");
  detail::require_plain(slider, "pulse_response");
  detail::require(std::isfinite(position), "pulse_response: position must be finite", position, "m");

  struct Knot {
    double time;
    detail::Ride ride;
  };
  std::vector<Knot> knots;
  const detail::Ride end = detail::ride(slider, shape, b, dt, position, [&](double time, const detail::Ride& ride) {
    knots.push_back({time, ride});
  });
  PulseResponse response;
  response.offset = end.state.displacement - position;
  response.velocity_square = end.velocity_square;
  for (const Knot& knot : knots) {
    response.peak = std::max(response.peak, std::abs(knot.ride.state.displacement - position));
    if (knot.ride.velocity_square > 0 && detail::equal(response.stop, 0)) response.stop = knot.time;  // it has moved
  }
  if (response.velocity_square > 0)
    for (auto knot = knots.rbegin();
         knot != knots.rend() && detail::equal(knot->ride.velocity_square, end.velocity_square); ++knot)
      response.stop = knot->time;

  const auto answer = [&](double time, const State& state) {
    response.time.push_back(time);
    response.displacement.push_back(state.displacement - position);
    response.velocity.push_back(state.velocity);
  };
  if (times.empty()) {
    for (const Knot& knot : knots) answer(knot.time, knot.ride.state);
    return response;
  }
  const auto edges = shape.times();
  for (std::size_t i = 0, k = 0; i < times.size(); ++i) {
    while (k + 1 < knots.size() && knots[k + 1].time <= times[i]) ++k;
    detail::Ride ride = knots[k].ride;
    double n = 0;
    for (std::size_t j = 0; j + 1 < edges.size(); ++j)
      if (edges[j] * dt <= knots[k].time && knots[k].time < edges[j + 1] * dt) n = b * shape.values()[j];
    detail::hold(slider, n, times[i] - knots[k].time, ride, detail::NoKnot{});
    answer(times[i], ride.state);
  }
  return response;
}

/// The response of a mass on a viscous damper to the symmetric rectangular pulse, thesis (5.2), (5.14), corrected
/// (5.15): x'' + damping x' = -n(t).
///
/// Evaluated without cancellation, down to zero damping. Any positive damping leaves no offset.
/// @param damping  zeta [1/s], finite and at least 0
/// @param b        amplitude [m/s^2], finite
/// @param dt       half width [s], positive and finite
/// @param times    output times [s], ascending, finite, at least 0; empty: 0, dt and 2 dt
/// @return `stop` is infinite (0 where b = 0)
/// @throws std::invalid_argument naming the value
PulseResponse viscous_pulse_response(double damping, double b, double dt, std::span<const double> times = {});

/// The viscous damping that makes the integral of x'^2 under the symmetric rectangular pulse what it is under friction,
/// thesis figure 5.3: both have the same rms velocity.
/// @param velocity_square  the integral to be matched [m^2/s], `PulseResponse::velocity_square`, positive, below the
///                         2 b^2 dt^3 / 3 of no damping (5.43)
/// @param b                amplitude [m/s^2], finite, not 0
/// @param dt               half width [s], positive and finite
/// @param window           from the arrival to when it is integrated [s], above 0; infinite by default
/// @return zeta [1/s]
/// @throws std::invalid_argument naming the value
/// To round-off, by bisection.
double viscous_damping_for(double velocity_square, double b, double dt,
                           double window = std::numeric_limits<double>::infinity());

}  // namespace stickslip::theory
