#include "stickslip/ground/strong_motion.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>

#include "stickslip/base/units.hpp"
#include "stickslip/ground/intensity_measures.hpp"
#include "stickslip/numerics/gauss_legendre.hpp"
#include "stickslip/numerics/root.hpp"

namespace stickslip {
namespace {

/// int n^2 dt over the first `time` of a segment.
double intensity(const Segment& segment, double time) {
  const double a = segment.start, b = a + (segment.end - a) * (time / segment.duration);
  return time * (a * a + a * b + b * b) / 3;
}

/// Calls f(start time, segment) for each segment of the motion between two times, cut at both.
template <class F>
void for_each_piece(const GroundMotion& motion, double begin, double end, F&& f) {
  for (std::size_t i = 0; i < motion.segments(); ++i) {
    Segment segment = motion.segment(i);
    const double from = motion.time(i), low = std::max(begin - from, 0.0),
                 high = std::min(end - from, segment.duration);
    if (!(low < high)) continue;
    const auto at = [&](double t) { return segment.start + (segment.end - segment.start) * (t / segment.duration); };
    f(from + low, Segment{high - low, at(low), at(high)});
  }
}

}  // namespace

StrongMotion strong_motion(const GroundMotion& motion) {
  // In units of the peak, whose square may be beyond the range of doubles.
  const double peak = motion.peak_acceleration();
  if (!(peak > 0)) throw std::invalid_argument("strong_motion: the motion must have an acceleration, got zeros only");
  const GroundMotion unit = motion.scaled(1 / peak);
  double total = 0;
  for (std::size_t i = 0; i < unit.segments(); ++i)
    if (const Segment s = unit.segment(i); s.duration > 0) total += intensity(s, s.duration);

  const auto time_of = [&](double share) {
    double sum = 0;
    for (std::size_t i = 0; i < unit.segments(); ++i) {
      const Segment s = unit.segment(i);
      if (!(s.duration > 0)) continue;
      const double here = intensity(s, s.duration);
      if (sum + here >= share * total) {
        const auto reached = [&](double t) { return !(sum + intensity(s, t) < share * total); };
        return unit.time(i) + numerics::first_where(0, s.duration, reached);
      }
      sum += here;
    }
    return unit.time(unit.segments());
  };
  StrongMotion result{};
  result.begin = time_of(0.05);
  result.end = time_of(0.95);
  result.duration_5_75 = time_of(0.75) - result.begin;
  result.peak_acceleration = peak;
  result.peak_velocity = peak_velocity(motion);
  result.peak_displacement = peak_displacement(motion);
  result.cumulative_absolute_velocity = cumulative_absolute_velocity(motion);
  result.mean_period = mean_period(motion);
  const double duration = result.duration = result.end - result.begin;
  result.arias_intensity = std::numbers::pi / (2 * standard_gravity) * total * peak * peak;
  result.rms_acceleration = std::sqrt(0.9 * total / duration) * peak;

  // The velocity's mean square about c0 + c1 s, s = 2 (t - begin) / duration - 1 (Legendre: 1 and s are orthogonal).
  const auto mean = [&](auto&& f) {
    double sum = 0, velocity = 0;
    for_each_piece(unit, result.begin, result.end, [&](double from, const Segment& s) {
      const double slope = (s.end - s.start) / s.duration;
      sum += numerics::gauss_integral<3>(0, s.duration, [&](double t) {  // exact for polynomials of degree 5
        return f(velocity + t * (s.start + slope * t / 2), 2 * (from + t - result.begin) / duration - 1);
      });
      velocity += s.duration * (s.start + s.end) / 2;
    });
    return sum / duration;
  };
  const double constant = mean([](double v, double) { return v; });
  const double inclination = 3 * mean([](double v, double s) { return v * s; });
  const double size = mean([](double v, double) { return v * v; });
  const double square = mean([&](double v, double s) { return std::pow(v - constant - inclination * s, 2); });
  if (!(square > 1e-16 * size))
    throw std::invalid_argument(
        "strong_motion: the ground velocity must not be a straight line over the strong part, from " +
        detail::shortest(result.begin) + " to " + detail::shortest(result.end) + " s");
  result.rms_velocity = std::sqrt(square) * peak;
  const double raw = result.rms_acceleration / (2 * std::sqrt(3.0) * result.rms_velocity);  // thesis (5.46), (5.60)
  result.center_frequency_hz = raw / std::sqrt(1 + 1.5 / (raw * duration));
  return result;
}

}  // namespace stickslip
