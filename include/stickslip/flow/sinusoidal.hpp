// Constant friction under a load that is a cosine in time: the displacement is the sum of a parabola and a cosine.
#pragma once

#include <array>
#include <cmath>
#include <numbers>

#include "stickslip/base/equal.hpp"
#include "stickslip/base/min_max.hpp"
#include "stickslip/flow/closed_form.hpp"
#include "stickslip/flow/oscillator.hpp"
#include "stickslip/state/state.hpp"

namespace stickslip {

/// The start of a slip under a load that is a cosine, expressed in the direction of sliding as in `Start`: the load is
/// amplitude cos(phase + frequency t).
struct SinusoidalStart {
  double speed;         ///< [m/s], at least 0
  double acceleration;  ///< net [m/s^2]; exactly 0 on breaking away
  double amplitude;     ///< of the load, in the direction of sliding; may be negative [m/s^2]
  double frequency;     ///< omega [rad/s], positive
  double phase;         ///< of the load at the start [rad]

  /// Change of the load since the start [m/s^2], in a form free of cancellation.
  double gain_within(double t, double /*duration*/) const noexcept {
    const double half = frequency * t / 2;
    return -2 * amplitude * std::sin(phase + half) * std::sin(half);
  }

  /// Work of the load up to time t, where `load` is its value at the start [m^2/s^2].
  template <class Flow>
  double work(const Flow& flow, double load, double /*gain*/, double t, const Progress& end) const noexcept {
    return load * end.distance + flow.work_of_gain(t);
  }
};

/// Constant friction without a spring under a load A cos(phase + omega t), in closed form: thesis (2.28). With
/// speed u and net acceleration a at the start,
///     speed = u + a t + V,  V = -A (omega^2 cos(phase) b3 + omega sin(phase) b2),
/// where b0 = cos(omega t) and each further b is the integral of the previous one, as in `Harmonic`. This form has no
/// differences of large numbers, however short the time.
///
/// The net acceleration is A cos(phase + omega t) minus the slip level. Its zeros are known, the speed is monotonic
/// between them, and the minimum speed decreases by 2 pi level / omega from cycle to cycle.
class SinusoidalFlow {
 public:
  SinusoidalFlow(const Harmonic& oscillator, const SinusoidalStart& start, double duration) noexcept
      : oscillator_(oscillator),
        start_(start),
        cosine_(start.amplitude * std::cos(start.phase)),
        sine_(start.amplitude * std::sin(start.phase)),
        square_(start.frequency * start.frequency),
        duration_(duration),
        end_(oscillator.basis(duration)) {}

  double horizon() const noexcept { return duration_; }

  /// As `ClosedForm::first_stop`.
  double first_stop() const noexcept {
    // No structured binding: clang captures none in a lambda before version 16.
    const double u = start_.speed, a = start_.acceleration, amplitude = start_.amplitude;
    const double omega = start_.frequency, phase = start_.phase;
    if (detail::equal(u, 0) && (a < 0 || (detail::equal(a, 0) && sine_ >= 0))) return 0;

    // The speed is too high for any load to stop the slip within the duration; most short segments end here.
    if (u > (std::abs(amplitude) + std::abs(cosine_ - a)) * duration_) return never;

    // With the phase measured from the maximum of the load, the speed rises between -turn and turn and falls elsewhere.
    constexpr double cycle = 2 * std::numbers::pi;
    const double push = std::abs(amplitude), level = cosine_ - a;
    const double room = (push - level) / (2 * push);
    const double turn = room > 0 ? 2 * std::asin(std::sqrt(std::min(room, 1.0))) : 0;
    const double now = std::remainder(amplitude < 0 ? phase + std::numbers::pi : phase, cycle);
    const bool rises = a > 0 || (detail::equal(a, 0) && sine_ < 0);
    double falls_from = rises ? std::max(turn - now, 0.0) : 0;                               // phase elapsed until then
    double least = rises || now >= -turn ? std::max(cycle - turn - now, 0.0) : -turn - now;  // at the end of the fall
    if (falls_from >= omega * duration_) return never;

    const auto speed_after = [&](double time) { return speed(oscillator_.basis(time), time); };
    const double first_least = least / omega < duration_ ? speed_after(least / omega) : 0;
    if (first_least > 0) {  // some cycles later
      const double lost = cycle * level / omega;
      if (!(lost > 0)) return never;
      const double cycles = std::ceil(first_least / lost);
      least += cycle * cycles;
      falls_from = least - (cycle - 2 * turn);
      if (!(falls_from < omega * duration_)) return never;
    }
    const double low = falls_from / omega, high = std::min(least / omega, duration_);
    if (detail::equal(high, duration_) && speed(end_, duration_) > 0) return never;
    return polish(low, high);
  }

  Progress at(double t) const noexcept { return progress(oscillator_.basis(t), t); }
  Progress at_horizon() const noexcept { return progress(end_, duration_); }

  /// Net, at the start [m/s^2].
  double acceleration() const noexcept { return start_.acceleration; }

  /// Sensitivity of the distance and the speed at time t to those at the start: a 2 x 2 matrix in row-major order.
  std::array<double, 4> variation(double t) const noexcept { return {1, t, 0, 1}; }

  /// Work of the change of the load since the start [m^2/s^2]: the integral of V' (u + a t + V).
  double work_of_gain(double t) const noexcept {
    const Harmonic::Basis b = detail::equal(t, duration_) ? end_ : oscillator_.basis(t);
    const double v = gained_speed(b, t);
    return v * (start_.speed + start_.acceleration * t + v / 2) - start_.acceleration * gained_distance(b, t);
  }

 private:
  double gained_speed(const Harmonic::Basis& b, double t) const noexcept {
    return -(cosine_ * (square_ * t * b.c3) + sine_ * (start_.frequency * b.b2));
  }
  double gained_distance(const Harmonic::Basis& b, double t) const noexcept {
    return -t * (cosine_ * (square_ * t * b.c4) + sine_ * (start_.frequency * b.c3));
  }
  double speed(const Harmonic::Basis& b, double t) const noexcept {
    return start_.speed + start_.acceleration * t + gained_speed(b, t);
  }
  double acceleration(const Harmonic::Basis& b) const noexcept {
    return start_.acceleration - (cosine_ * (square_ * b.b2) + sine_ * (start_.frequency * b.b1));
  }
  Progress progress(const Harmonic::Basis& b, double t) const noexcept {
    return {t * (start_.speed + t * (start_.acceleration / 2)) + gained_distance(b, t), speed(b, t), acceleration(b),
            0};
  }

  // The zero of a speed that falls from `low` to `high` and is at or below zero at `high`, by bracketed Newton
  // iteration. The slope is available at no cost; `numerics::root` would not use it.
  double polish(double low, double high) const noexcept {
    for (double t = low + (high - low) / 2;;) {
      const Harmonic::Basis b = oscillator_.basis(t);
      const double value = speed(b, t);
      (value > 0 ? low : high) = t;
      double next = t - value / acceleration(b);
      if (std::abs(next - t) <= 0x1p-52 * t) return t;
      if (!(next > low && next < high)) next = low + (high - low) / 2;
      if (next <= low || next >= high) return high;
      t = next;
    }
  }

  const Harmonic& oscillator_;
  SinusoidalStart start_;
  double cosine_, sine_;  // of the load at the start [m/s^2]
  double square_;         // of omega
  double duration_;
  Harmonic::Basis end_;
};

/// Makes the flows of constant friction without a spring under a load of one frequency.
class Sinusoidal {
 public:
  /// @param usual_duration  as in `Harmonic`
  explicit Sinusoidal(double omega, double usual_duration) noexcept : oscillator_(omega, usual_duration) {}

  /// Zero: there is no spring.
  static constexpr double pull(double) noexcept { return 0; }
  static constexpr double drag(double) noexcept { return 0; }

  SinusoidalFlow flow(const SinusoidalStart& start, double duration) const noexcept {
    return {oscillator_, start, duration};
  }

 private:
  Harmonic oscillator_;
};

}  // namespace stickslip
