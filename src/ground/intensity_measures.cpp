#include "stickslip/ground/intensity_measures.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <cstddef>
#include <limits>
#include <numbers>
#include <vector>

#include "numerics/fftw_plan.hpp"
#include "stickslip/base/units.hpp"
#include "stickslip/ground/processing.hpp"

namespace stickslip {
namespace {

/// Calls f(segment, velocity, displacement) for each segment with the values at its start, then for the end of the
/// motion with a segment of zero length.
template <class F>
void for_each_segment(const GroundMotion& motion, F&& f) {
  double v = 0, d = 0;
  for (std::size_t i = 0; i < motion.segments(); ++i) {
    const Segment s = motion.segment(i);
    f(s, v, d);
    d += s.duration * (v + s.duration * (2 * s.start + s.end) / 6);
    v += s.duration * (s.start + s.end) / 2;
  }
  f(Segment{0, 0, 0}, v, d);
}

}  // namespace

double peak_velocity(const GroundMotion& motion) {
  double peak = 0;
  for_each_segment(motion, [&](const Segment& s, double v, double) {
    peak = std::max(peak, std::abs(v));
    if ((s.start < 0) != (s.end < 0) && s.start != s.end)  // to where n = 0
      peak = std::max(peak, std::abs(v + s.duration * (s.start / (s.start - s.end)) * s.start / 2));
  });
  return peak;
}

double peak_displacement(const GroundMotion& motion) {
  double peak = 0;
  for_each_segment(motion, [&](const Segment& s, double v, double d) {
    peak = std::max(peak, std::abs(d));
    if (!(s.duration > 0)) return;
    // Where v + n t + slope t^2 / 2 = 0.
    const double slope = (s.end - s.start) / s.duration, inside = s.start * s.start - 2 * slope * v;
    if (!(inside >= 0)) return;
    const double sum = -(s.start + std::copysign(std::sqrt(inside), s.start));
    for (const double t : {sum / slope, 2 * v / sum})
      if (t > 0 && t < s.duration) peak = std::max(peak, std::abs(d + t * (v + t * (s.start / 2 + slope * t / 6))));
  });
  return peak;
}

double cumulative_absolute_velocity(const GroundMotion& motion) {
  double sum = 0;
  for_each_segment(motion, [&](const Segment& s, double, double) {
    const double a = std::abs(s.start), b = std::abs(s.end);
    const bool crosses = (s.start < 0) != (s.end < 0) && a + b > 0;
    sum += s.duration / 2 * (crosses ? a * (a / (a + b)) + b * (b / (a + b)) : a + b);
  });
  return sum;
}

double arias_intensity(const GroundMotion& motion) {
  const double peak = motion.peak_acceleration();  // whose square may be beyond the range of doubles
  if (!(peak > 0)) return 0;
  double sum = 0;
  for_each_segment(motion, [&](const Segment& s, double, double) {
    const double a = s.start / peak, b = s.end / peak;
    sum += s.duration * (a * a + a * b + b * b) / 3;
  });
  return std::numbers::pi / (2 * standard_gravity) * sum * peak * peak;
}

double mean_period(const GroundMotion& motion) {
  constexpr double low = 0.25, high = 20, span = 20;
  constexpr std::size_t most = std::size_t{1} << 24;
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  if (std::isnan(motion.dt()))
    return mean_period(resampled(motion, motion.duration() / static_cast<double>(motion.segments())));
  const double peak = motion.peak_acceleration(), dt = motion.dt();
  if (!(peak > 0) || !(span / dt < static_cast<double>(most)) || motion.samples() > most) return none;
  const std::size_t count = std::max(motion.samples(), static_cast<std::size_t>(std::ceil(span / dt)));
  std::vector<double> samples(count);
  std::ranges::transform(motion.acceleration(), samples.begin(), [&](double n) { return n / peak; });
  std::vector<std::complex<double>> amplitudes(count / 2 + 1);
  const detail::FftwPlan plan = detail::make_plan([&] {
    return fftw_plan_dft_r2c_1d(static_cast<int>(count), samples.data(),
                                reinterpret_cast<fftw_complex*>(amplitudes.data()), FFTW_ESTIMATE);
  });
  fftw_execute(plan.get());
  double sum = 0, by_period = 0;
  for (std::size_t i = 1; i < amplitudes.size(); ++i) {
    const double frequency = static_cast<double>(i) / (static_cast<double>(count) * dt);
    if (frequency < low || frequency > high) continue;
    sum += std::norm(amplitudes[i]);
    by_period += std::norm(amplitudes[i]) / frequency;
  }
  return sum > 0 ? by_period / sum : none;
}

}  // namespace stickslip
