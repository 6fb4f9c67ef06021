// A mass on a viscous damper: the linear system that stands in for a slider on friction.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <stdexcept>
#include <utility>

#include "stickslip/detail/min_max.hpp"
#include "stickslip/error.hpp"
#include "stickslip/ground/ground_motion.hpp"
#include "stickslip/numerics/gauss_legendre.hpp"
#include "stickslip/sliding/integrate.hpp"
#include "stickslip/sliding/response.hpp"
#include "stickslip/state.hpp"

namespace stickslip {

/// A mass on a viscous damper, with an optional centering spring:
///     x'' + zeta x' + wn^2 x = -n(t),                                                              thesis (4.2), (5.2)
/// x the displacement relative to the ground [m], n the ground acceleration [m/s^2]. It never sticks.
class ViscousSlider {
 public:
  /// @param damping            zeta [1/s], finite and at least 0; 2 wn times the share of critical
  /// @param natural_frequency  wn [rad/s], finite and at least 0; 0 is no spring
  /// @throws std::invalid_argument naming the value
  explicit ViscousSlider(double damping, double natural_frequency = 0)
      : damping_(damping), natural_frequency_(natural_frequency), stiffness_(natural_frequency * natural_frequency) {
    detail::require(std::isfinite(damping) && damping >= 0, "ViscousSlider: damping must be finite and at least 0",
                    damping, "1/s");
    detail::require(std::isfinite(stiffness_) && natural_frequency >= 0,
                    "ViscousSlider: natural_frequency must be finite and at least 0", natural_frequency, "rad/s");
  }

  double damping() const noexcept { return damping_; }
  double natural_frequency() const noexcept { return natural_frequency_; }

  /// wn^2, spring stiffness per unit mass [1/s^2].
  double stiffness() const noexcept { return stiffness_; }

  friend bool operator==(const ViscousSlider& a, const ViscousSlider& b) {
    return a.damping_ == b.damping_ && a.natural_frequency_ == b.natural_frequency_;
  }

 private:
  double damping_;
  double natural_frequency_;
  double stiffness_;
};

namespace detail {

/// What the viscous slider has come to after a time, of each: a velocity of one, and, from rest, a load of one and a
/// load that grows by one a second. The velocity under a load that runs straight, p(t) = p0 + s t, is
///     v(t) = v0 decay(t) + q0 impulse(t) + s step(t),   q0 = p0 - wn^2 x0
/// and x(t) - x0, its integral, v0 impulse(t) + q0 step(t) + s ramp(t).
struct ViscousStep {
  double duration;  ///< [s]
  double decay = 1, impulse = 0, step = 0, ramp = 0;

  ViscousStep(const ViscousSlider& slider, double time) : duration(time) {
    const double wn = slider.natural_frequency(), half = slider.damping() / 2;
    const double apart = half > wn ? 2 * std::sqrt((half - wn) * (half + wn)) : 0;  // of the two rates of decay
    const double size = (slider.damping() + wn) * time;
    if (apart * time > 1) {
      from_rates(half + apart / 2, slider.stiffness() / (half + apart / 2), apart);
    } else {
      const int doublings = size > 1 ? static_cast<int>(std::ceil(std::log2(size))) : 0;
      duration = std::ldexp(time, -doublings);
      from_series(slider);
      for (int i = 0; i < doublings; ++i) double_time(slider);
    }
  }

  /// The same for twice the time.
  void double_time(const ViscousSlider& slider) {
    const double position = 1 - slider.stiffness() * step;  // of a unit displacement
    *this = {2 * duration, decay * decay - slider.stiffness() * impulse * impulse, impulse * (position + decay),
             position * step + impulse * impulse + step, position * ramp + impulse * step + duration * step + ramp};
  }

  double velocity(double v, double q, double s) const noexcept { return v * decay + q * impulse + s * step; }
  double distance(double v, double q, double s) const noexcept { return v * impulse + q * step + s * ramp; }

 private:
  ViscousStep(double duration_, double decay_, double impulse_, double step_, double ramp_)
      : duration(duration_), decay(decay_), impulse(impulse_), step(step_), ramp(ramp_) {}

  // Two rates of decay far enough apart: divided differences of (e^-y and its like), none of which cancel.
  void from_rates(double fast, double slow, double apart) {
    const double u = duration, ys = slow * u, yf = fast * u;
    const double ef = std::exp(-yf), es = std::exp(-ys), mean_f = -std::expm1(-yf) / yf, after_f = (1 - mean_f) / yf;
    const double mean_s = ys > 0 ? -std::expm1(-ys) / ys : 1;
    double after_s = (1 - mean_s) / ys;
    if (ys < 1) {
      after_s = 0;
      double term = 0.5;
      for (int k = 3; std::abs(term) > 1e-18; term *= -ys / k++) after_s += term;
    }
    decay = (fast * ef - slow * es) / apart;
    impulse = (es - ef) / apart;
    step = u * (mean_s - mean_f) / apart;
    ramp = u * u * (after_s - after_f) / apart;
  }

  // ramp'' + zeta ramp' + wn^2 ramp = t as a power series, for (zeta + wn) t <= 1.
  void from_series(const ViscousSlider& slider) {
    const double u = duration, y = slider.damping() * u, q = slider.stiffness() * u * u;
    double before = 0, term = 1.0 / 6;
    decay = 0;
    for (int k = 3;; ++k) {
      ramp += term;
      step += k * term;
      impulse += k * (k - 1) * term;
      decay += k * (k - 1) * (k - 2) * term;
      const double next = -(y * term + q * before / k) / (k + 1);
      before = std::exchange(term, next);
      if (k * k * k * (std::abs(term) + std::abs(before) * q) < 1e-18) break;
    }
    impulse *= u;
    step *= u * u;
    ramp *= u * u * u;
  }
};

/// The energies of a step, as forms in (v0, q0, s).
struct ViscousEnergy {
  std::array<std::array<double, 3>, 3> square{};  ///< of the integral of v^2 dt
  std::array<double, 3> moment{};                 ///< of the integral of t v dt

  /// By Gauss-Legendre quadrature of eight points over a time in which little changes, which is then doubled.
  ViscousEnergy(const ViscousSlider& slider, double duration) {
    const double size = (slider.damping() + slider.natural_frequency()) * duration;
    const int doublings = size > 1 ? static_cast<int>(std::ceil(std::log2(size))) : 0;
    const double part = std::ldexp(duration, -doublings);
    numerics::gauss_points<8>(0, part, [&](double time, double weight) {
      const ViscousStep at(slider, time);
      const std::array<double, 3> v{at.decay, at.impulse, at.step};
      for (std::size_t a = 0; a < 3; ++a) {
        moment[a] += weight * time * v[a];
        for (std::size_t b = 0; b < 3; ++b) square[a][b] += weight * v[a] * v[b];
      }
    });
    ViscousStep step(slider, part);
    for (int i = 0; i < doublings; ++i) {
      double_time(slider, step);
      step.double_time(slider);
    }
  }

  double dissipated(const ViscousSlider& slider, double v, double q, double s) const noexcept {
    const std::array<double, 3> z{v, q, s};
    double sum = 0;
    for (std::size_t a = 0; a < 3; ++a)
      for (std::size_t b = 0; b < 3; ++b) sum += square[a][b] * z[a] * z[b];
    return slider.damping() * sum;
  }
  double first_moment(double v, double q, double s) const noexcept {
    return moment[0] * v + moment[1] * q + moment[2] * s;
  }

 private:
  void double_time(const ViscousSlider& slider, const ViscousStep& step) {
    const double k = slider.stiffness();
    // (v, q, s) after the step, of those before it; and the way.
    const double after[3][3] = {{step.decay, step.impulse, step.step},
                                {-k * step.impulse, 1 - k * step.step, step.duration - k * step.ramp},
                                {0, 0, 1}};
    const double way[3] = {step.impulse, step.step, step.ramp};
    const ViscousEnergy first = *this;
    for (std::size_t a = 0; a < 3; ++a)
      for (std::size_t i = 0; i < 3; ++i) {
        moment[a] += after[i][a] * (first.moment[i] + step.duration * way[i]);
        for (std::size_t b = 0; b < 3; ++b)
          for (std::size_t j = 0; j < 3; ++j) square[a][b] += after[i][a] * first.square[i][j] * after[j][b];
      }
  }
};

/// Where a function that has one zero between `low` and `high` has it, to 1e-9, by Newton's method within the bracket,
/// as the slope is at hand.
/// @param f  gives value and slope; of opposite signs at both ends
template <class F>
double crossing(double low, double high, const F& f) {
  const bool rises = f(high).first > 0;
  double time = low + (high - low) / 2;
  for (int i = 0; i < 100; ++i) {
    const auto [value, slope] = f(time);
    const double next = time - value / slope;
    if (value == 0 || std::abs(next - time) <= 1e-9 * time) return time;
    (rises == (value > 0) ? high : low) = time;
    time = next > low && next < high ? next : low + (high - low) / 2;
  }
  return time;
}

/// A viscous slider on its way: moves it over pieces of straight ground acceleration, each so short that its velocity
/// turns at most once within.
class ViscousMotion {
 public:
  ViscousMotion(const ViscousSlider& slider, double displacement, double velocity)
      : slider_(slider), x_(displacement), v_(velocity), peak_(std::abs(displacement)) {}

  double displacement() const noexcept { return x_; }
  double velocity() const noexcept { return v_; }
  double peak() const noexcept { return peak_; }
  double way() const noexcept { return way_; }

  /// Pieces that a time must be cut in: of less than half a period each.
  double pieces(double duration) const noexcept {
    const double half = slider_.damping() / 2, wn = slider_.natural_frequency();
    return wn > half ? std::max(1.0, std::ceil(std::sqrt((wn - half) * (wn + half)) * duration / 3)) : 1;
  }

  /// @param step   of the piece's length
  /// @param load   -n at its beginning [m/s^2]
  /// @param slope  of the load [m/s^3]
  void advance(const ViscousStep& step, double load, double slope) {
    const double v0 = v_, q0 = load - slider_.stiffness() * x_;
    const double v1 = step.velocity(v0, q0, slope), distance = step.distance(v0, q0, slope);
    const double turned = turning_points(step, v0, q0, slope, v1, distance);
    way_ += std::abs(distance - turned);
    x_ += distance;
    v_ = v1;
    peak_ = std::max(peak_, std::abs(x_));
  }

 private:
  // The velocity's zeros within: the way up to the last of them is added, and the displacement there returned.
  double turning_points(const ViscousStep& step, double v0, double q0, double slope, double v1, double distance) {
    const double zeta = slider_.damping(), k = slider_.stiffness();
    const auto at = [&](double time) {
      const ViscousStep there(slider_, time);
      const double v = there.velocity(v0, q0, slope), d = there.distance(v0, q0, slope);
      return std::array<double, 3>{d, v, q0 + slope * time - k * d - zeta * v};
    };
    double from = 0;
    const auto turn_between = [&](double low, double high) {
      const double time = crossing(low, high, [&](double t) {
        const auto [d, v, a] = at(t);
        return std::pair(v, a);
      });
      const double there = at(time)[0];
      way_ += std::abs(there - from);
      peak_ = std::max(peak_, std::abs(x_ + there));
      from = there;
    };
    if (v0 * v1 < 0) {
      turn_between(0, step.duration);
      return from;
    }
    // Or it dips through zero and back, or leaves a rest and comes back through it.
    const double a0 = q0 - zeta * v0, a1 = q0 + slope * step.duration - k * distance - zeta * v1;
    if (!(a0 * a1 < 0 && v0 * a0 <= 0 && (v1 * a1 > 0 || v0 == 0))) return from;
    const double extreme = crossing(0, step.duration, [&](double t) {
      const auto [d, v, a] = at(t);
      return std::pair(a, slope - zeta * a - k * v);
    });
    const double v = at(extreme)[1];
    if (v * v0 < 0) turn_between(0, extreme);
    if (v * v1 < 0) turn_between(extreme, step.duration);
    return from;
  }

  const ViscousSlider& slider_;
  double x_, v_, peak_, way_ = 0;
};

}  // namespace detail

/// Moves the viscous slider through a whole ground motion:
///     x'' + zeta x' + wn^2 x = -n(t),                                                              thesis (4.2), (5.2)
/// in closed form over each straight piece of n(t).
///
/// @param slider   the linear system
/// @param motion   the ground acceleration
/// @param options  state at the start; it never comes to rest, so `settle` is refused. (Without a spring it comes to
///                 x + x' / zeta in the end, with one to 0)
/// @param storage  a response that is no longer needed, for its memory
/// @return as of a slider on friction: displacement and velocity at the samples, the largest |x| between them too, the
///         length of the way; no events but the end; as dissipated energy the integral of zeta x'^2 dt
/// @throws std::invalid_argument  a start that is not finite; `settle`
/// @throws std::overflow_error    a displacement, velocity or energy beyond the range of doubles
/// @throws ConvergenceError       more than a million half periods of the spring in one piece of the motion
/// Exact to round-off for any damping and step: 1e-15 of the scale of x, or as many roundings more as the spring has
/// swung radians in one piece. Some 150 ns a sample at even steps; 1.2 us where they are uneven.
inline Response integrate(const ViscousSlider& slider, const GroundMotion& motion, const IntegrateOptions& options = {},
                          Response storage = {}) {
  detail::require(std::isfinite(options.displacement), "integrate: displacement must be finite", options.displacement,
                  "m");
  detail::require(std::isfinite(options.velocity), "integrate: velocity must be finite", options.velocity, "m/s");
  if (options.settle)
    throw std::invalid_argument("integrate: settle must be false, a ViscousSlider never comes to rest");

  Response response = std::move(storage);
  response.displacement.resize(motion.samples());
  response.velocity.resize(motion.samples());
  response.displacement[0] = options.displacement;
  response.velocity[0] = options.velocity;
  response.time_sliding = 0;
  response.energy = {};
  response.truncated = false;

  detail::ViscousMotion moving(slider, options.displacement, options.velocity);
  const auto kinetic = [&] { return moving.velocity() * moving.velocity() / 2; };
  const auto elastic = [&] { return slider.stiffness() * moving.displacement() * moving.displacement() / 2; };
  response.energy.initial = kinetic() + elastic();

  detail::ViscousStep step(slider, 0);
  detail::ViscousEnergy energy(slider, 0);
  double duration = 0, count = 1;
  std::size_t beats = 0;
  for (std::size_t i = 0; i < motion.segments(); ++i) {
    const Segment segment = motion.segment(i);
    if (segment.duration != duration) {
      duration = segment.duration;
      count = moving.pieces(duration);
      if (!(count <= 1e6))
        throw ConvergenceError("integrate: the spring swings " + detail::shortest(count) +
                               " half periods within one piece of the motion, more than a million");
      step = detail::ViscousStep(slider, duration / count);
      energy = detail::ViscousEnergy(slider, duration / count);
    }
    const double slope = duration > 0 ? (segment.start - segment.end) / duration : 0;
    for (double piece = 0; piece < count; ++piece) {
      if (++beats % 16384 == 0 && options.heartbeat) options.heartbeat();
      const double load = -segment.start + slope * (piece * step.duration), x0 = moving.displacement(),
                   v0 = moving.velocity(), q0 = load - slider.stiffness() * x0;
      moving.advance(step, load, slope);
      response.energy.input += load * step.distance(v0, q0, slope) + slope * energy.first_moment(v0, q0, slope);
      response.energy.dissipated += energy.dissipated(slider, v0, q0, slope);
      if (v0 != 0 || q0 != 0 || slope != 0) response.time_sliding += step.duration;
    }
    response.displacement[i + 1] = moving.displacement();
    response.velocity[i + 1] = moving.velocity();
  }

  response.state = State::at(moving.displacement(), moving.velocity());
  response.events.assign(1, {motion.time(motion.segments()), moving.displacement(), moving.velocity(), EventKind::end});
  response.peak = moving.peak();
  response.residual = moving.displacement();
  response.sliding_distance = moving.way();
  response.energy.kinetic = kinetic();
  response.energy.elastic = elastic();
  if (!std::isfinite(response.energy.imbalance()) || !std::isfinite(response.peak))
    throw std::overflow_error("integrate: the motion leaves the range of doubles, in displacement (peak " +
                              detail::shortest(response.peak) + " m), velocity or energy");
  return response;
}

}  // namespace stickslip
