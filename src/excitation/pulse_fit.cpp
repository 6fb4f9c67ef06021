#include "stickslip/excitation/pulse_fit.hpp"

#include <fftw3.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstddef>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <string>
#include <vector>

#include "excitation/interpolation_loss.hpp"
#include "numerics/fftw_plan.hpp"
#include "stickslip/base/error.hpp"
#include "stickslip/ground/strong_motion.hpp"

namespace stickslip {
namespace {

using std::numbers::pi;

constexpr std::size_t max_samples = std::size_t{1} << 22;

/// Values of a two-sided density at frequencies that are evenly spaced: (j + offset) x step.
struct Densities {
  double step, offset;
  std::vector<double> value;

  double omega(std::size_t j) const { return (static_cast<double>(j) + offset) * step; }
};

/// The ground velocity at evenly spaced times, exactly.
std::vector<double> velocities(const GroundMotion& motion, double begin, double end, std::size_t count) {
  std::vector<double> velocity(count + 1);
  double reached = 0;
  std::size_t next = 0;
  const auto time = [&](std::size_t k) {
    return begin + (end - begin) * (static_cast<double>(k) / static_cast<double>(count));
  };
  for (std::size_t i = 0; i < motion.segments() && next <= count; ++i) {
    const Segment s = motion.segment(i);
    if (!(s.duration > 0)) continue;
    const double from = motion.time(i), slope = (s.end - s.start) / s.duration;
    const auto gained = [&](double t) { return t * (s.start + slope * t / 2); };
    for (; next <= count && (time(next) <= from + s.duration || i + 1 == motion.segments()); ++next)
      velocity[next] = reached + gained(std::clamp(time(next) - from, 0.0, s.duration));
    reached += gained(s.duration);
  }
  return velocity;
}

/// Of the strong part, up to a quarter of the frequency of its samples, which are means over their intervals.
/// @param finer  values per 1 / duration: with 2, as if zeros followed the strong part for as long again. A sum over
///               all values then has no products of the beginning with the end, which for a few pulses matter.
Densities periodogram(const GroundMotion& motion, const StrongMotion& strong, std::size_t finer) {
  const double whole = motion.time(motion.segments()) - motion.time(0);
  const double steps = 8 * static_cast<double>(motion.segments()) * strong.duration / whole;
  std::size_t n = 4096;
  while (static_cast<double>(n) < steps && n < max_samples) n *= 2;
  const double peak = motion.peak_acceleration(), dt = strong.duration / static_cast<double>(n);
  const std::vector<double> velocity = velocities(motion.scaled(1 / peak), strong.begin, strong.end, n);
  std::vector<double> sample(finer * n);
  const double mean = (velocity[n] - velocity[0]) / static_cast<double>(n);
  for (std::size_t k = 0; k < n; ++k) sample[k] = (velocity[k + 1] - velocity[k] - mean) / dt;
  std::vector<std::complex<double>> lines(sample.size() / 2 + 1);
  const auto plan = detail::make_plan([&] {
    return fftw_plan_dft_r2c_1d(static_cast<int>(sample.size()), sample.data(),
                                reinterpret_cast<fftw_complex*>(lines.data()), FFTW_ESTIMATE);
  });
  fftw_execute(plan.get());
  Densities densities{2 * pi / strong.duration / static_cast<double>(finer), 0, std::vector<double>(finer * n / 4)};
  for (std::size_t j = 0; j < densities.value.size(); ++j) {
    const double loss = detail::interpolation_loss(Interpolation::constant, densities.omega(j) * dt / 2);
    densities.value[j] = std::norm(lines[j]) / (loss * loss) * (dt / static_cast<double>(n)) / (2 * pi) * peak * peak;
  }
  return densities;
}

/// Averages over 2 half + 1 values; those before zero mirror those beyond, and the one at zero, of the mean, does not
/// count.
std::vector<double> average(const std::vector<double>& value, std::size_t half) {
  const auto size = static_cast<std::ptrdiff_t>(value.size()), h = static_cast<std::ptrdiff_t>(half);
  std::vector<double> sums = {0};  // of value[1] to value[j]
  for (std::size_t j = 1; j < value.size(); ++j) sums.push_back(sums.back() + value[j]);
  const auto sum_to = [&](std::ptrdiff_t j) {
    return j >= 0 ? sums[static_cast<std::size_t>(j)] : -sums[static_cast<std::size_t>(std::min(-j - 1, size - 1))];
  };
  std::vector<double> means(value.size());
  for (std::ptrdiff_t j = 0; j < size; ++j) {
    const std::ptrdiff_t last = std::min(j + h, size - 1), first = std::max(j - h, 1 - size);
    const std::ptrdiff_t count = last - first + (first > 0 || last < 0 ? 1 : 0);
    // Zero alone has nothing without the mean; sums of what is far stronger leave their round-off.
    means[static_cast<std::size_t>(j)] =
        count == 0 ? 0 : std::max((sum_to(last) - sum_to(first - 1)) / static_cast<double>(count), 0.0);
  }
  return means;
}

/// Corrected (5.6) with lambda sigma^2 = 1.
double unit_density(double omega, double half_width) {
  const double sine = std::sin(omega * half_width / 2), u = omega == 0 ? 0 : sine * sine / omega;
  return 8 / pi * u * u;
}

/// The pulses that least squares give for this half width: all are integrals over both sides.
struct Trial {
  double overlap;  // of S and that of the pulses, lambda sigma^2 = 1
  double square;   // int S^2 of the pulses is 4 Dt^3 / (3 pi)

  double intensity() const { return overlap / square; }
  double gain() const { return overlap * overlap / square; }
};

Trial trial(const Densities& s, double half_width) {
  double sum = 0;
  for (std::size_t j = 0; j < s.value.size(); ++j) sum += s.value[j] * unit_density(s.omega(j), half_width);
  return {2 * sum * s.step, 4 * half_width * half_width * half_width / (3 * pi)};
}

PulseFit fit(const Densities& s, double shortest_half, double longest_half, const std::string& range) {
  const double largest = *std::ranges::max_element(s.value);
  if (!(largest > 0)) throw std::invalid_argument("fit_pulses: the spectrum must not be zero everywhere");
  // A grid finer than the structure of (5.6), and golden section about its best point: our own, because these few lines
  // need neither the callback, the state nor the error codes of gsl_min_fminimizer.
  const int points = static_cast<int>(std::ceil(std::log(longest_half / shortest_half) / 0.04)) + 1;
  const double ratio = std::log(longest_half / shortest_half) / (points - 1);
  const auto gain = [&](double at) { return trial(s, shortest_half * std::exp(ratio * at)).gain(); };
  int best = 0;
  double highest = -1;
  for (int i = 0; i < points; ++i)
    if (const double here = gain(i); here > highest) {
      highest = here;
      best = i;
    }
  if (best == 0 || best == points - 1)
    throw std::invalid_argument("fit_pulses: no pulses fit: the nearest have a half width of " +
                                std::string(best == 0 ? "less than " : "more than ") +
                                detail::shortest(best == 0 ? shortest_half : longest_half) + " s, " + range);
  double low = best - 1, high = best + 1;
  const double golden = std::numbers::phi - 1;
  double left = high - golden * (high - low), right = low + golden * (high - low), at_left = gain(left),
         at_right = gain(right);
  while (high - low > 1e-6) {
    if (at_left > at_right) {
      high = right;
      right = left;
      at_right = at_left;
      at_left = gain(left = high - golden * (high - low));
    } else {
      low = left;
      left = right;
      at_left = at_right;
      at_right = gain(right = low + golden * (high - low));
    }
  }
  PulseFit result{};
  result.half_width = shortest_half * std::exp(ratio * (low + high) / 2);
  result.intensity = trial(s, result.half_width).intensity();
  result.rms_acceleration = std::sqrt(2 * result.half_width * result.intensity);
  result.center_frequency_hz = 1 / (2 * result.half_width);
  return result;
}

void find_misfit(PulseFit& fit, const Densities& s) {
  double off = 0, all = 0;
  for (std::size_t j = 0; j < s.value.size(); ++j) {
    off += std::abs(s.value[j] - fit.intensity * unit_density(s.omega(j), fit.half_width));
    all += s.value[j];
  }
  fit.misfit = off / all;
  detail::require(
      fit.misfit < 1,
      "fit_pulses: no pulses fit: the spectrum must differ from that of the nearest pulses, of half width " +
          detail::shortest(fit.half_width) + " s, by less than from zero; the integral of the difference, over its own",
      fit.misfit);
}

/// Of ln Dt, for values of a periodogram 1 / duration apart, which are independent, each as scattered as it is large.
/// (If they are n times as close, n neighbors are as one: the variance is n times as large.) With the derivatives of
/// the fitted density f by the two logarithms, f and g, least squares have the covariance A^-1 B A^-1, A = sum (f,
/// g)(f, g)^T, B the same sum weighted with S^2. Filtered Poisson pulses are not Gaussian: to B comes kappa sum (f S)
/// (sum (f S))^T, kappa = E[b^4] / (E[b^2]^2 lambda T) (D. R. Brillinger, Time Series (1981), 5.10, with the
/// fourth-order spectrum of the pulses). As S is f that is in the direction of the intensity and leaves Dt as it is.
double relative_error(const PulseFit& fit, const Densities& s) {
  double a11 = 0, a12 = 0, a22 = 0, b11 = 0, b12 = 0, b22 = 0;
  for (std::size_t j = 1; j < s.value.size(); ++j) {
    const double u = s.omega(j) * fit.half_width / 2, f = fit.intensity * unit_density(s.omega(j), fit.half_width),
                 g = std::sin(u) == 0 ? 0 : f * 4 * u / std::tan(u), weight = s.value[j] * s.value[j];
    a11 += f * f;
    a12 += f * g;
    a22 += g * g;
    b11 += weight * f * f;
    b12 += weight * f * g;
    b22 += weight * g * g;
  }
  const double determinant = a11 * a22 - a12 * a12;
  return std::sqrt(a12 * a12 * b11 - 2 * a12 * a11 * b12 + a11 * a11 * b22) / determinant;
}

}  // namespace

Spectrum estimate_spectrum(const GroundMotion& motion, double bandwidth) {
  const StrongMotion strong = strong_motion(motion);
  detail::require(std::isfinite(bandwidth) && bandwidth * strong.duration >= 1 - 1e-9,
                  "estimate_spectrum: the bandwidth must be finite and at least 1 / duration of the strong part, " +
                      detail::shortest(1 / strong.duration) + " Hz",
                  bandwidth, "Hz");
  const Densities raw = periodogram(motion, strong, 1);
  const double half =
      std::min(std::max(bandwidth * strong.duration - 1, 0.0) / 2, static_cast<double>(raw.value.size()));
  std::vector<double> omega(raw.value.size());
  for (std::size_t j = 0; j < omega.size(); ++j) omega[j] = raw.omega(j);
  return Spectrum::from_table(std::move(omega), average(raw.value, static_cast<std::size_t>(std::lround(half))));
}

PulseFit fit_pulses(const GroundMotion& motion) {
  const StrongMotion strong = strong_motion(motion);
  // In units of the peak, whose fourth power may be beyond the range of doubles.
  const double peak = motion.peak_acceleration();
  const auto values = [&](std::size_t finer) {
    Densities s = periodogram(motion, strong, finer);
    for (double& value : s.value) value /= peak * peak;
    return s;
  };
  const auto averaged = [&](Densities s, std::size_t finer, double frequency) {
    const double neighbors = static_cast<double>(finer) * strong.duration * frequency / 6;
    s.value = average(s.value, static_cast<std::size_t>(std::lround(neighbors)));
    return s;
  };
  constexpr std::size_t finer = 2;
  const Densities s = values(finer);
  const double highest = s.omega(s.value.size());
  PulseFit result = fit(s, 4 * pi / highest, strong.duration / 8,
                        "where the strong part has " + detail::shortest(strong.duration) + " s");
  find_misfit(result, averaged(values(1), 1, result.center_frequency_hz));
  result.half_width_error = std::sqrt(static_cast<double>(finer)) *
                            relative_error(result, averaged(s, finer, result.center_frequency_hz)) * result.half_width;
  result.intensity *= peak * peak;
  result.rms_acceleration *= peak;
  return result;
}

PulseFit fit_pulses(const Spectrum& spectrum) {
  constexpr std::size_t points = 1 << 14;
  const double variance = spectrum.variance(0, std::numeric_limits<double>::infinity());
  detail::require(std::isfinite(variance), "fit_pulses: the spectrum must have a finite variance", variance, "m^2/s^4");
  double highest = spectrum.high();
  if (std::isinf(highest)) {
    highest = 1e-6;
    while (spectrum.variance(0, highest) < 0.99 * variance) highest *= 2;
  }
  Densities s{highest / static_cast<double>(points), 0.5, std::vector<double>(points)};
  const double scale = variance / highest;
  for (std::size_t j = 0; j < points; ++j) s.value[j] = spectrum(s.omega(j)) / scale;
  // (5.6) has its peak at omega Dt = 2.33.
  PulseFit result = fit(s, 2.4 / highest, 2.3 / (20 * s.step),
                        "and 99 % of the variance lies below " + detail::shortest(highest) + " rad/s");
  find_misfit(result, s);
  result.intensity *= scale;
  result.rms_acceleration *= std::sqrt(scale);
  return result;
}

}  // namespace stickslip
