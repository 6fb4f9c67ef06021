#include "excitation/pulse_shape.hpp"

#include <fftw3.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstddef>
#include <numbers>
#include <stdexcept>
#include <string>
#include <utility>

#include "excitation/interpolation_loss.hpp"
#include "numerics/fftw_plan.hpp"
#include "stickslip/base/error.hpp"

namespace stickslip {
namespace {

using Complex = std::complex<double>;
using std::numbers::pi;

constexpr std::size_t fewest_points = std::size_t{1} << 12, max_points = std::size_t{1} << 20;
constexpr int max_zeros = 8;

fftw_complex* fftw(std::vector<Complex>& values) { return reinterpret_cast<fftw_complex*>(values.data()); }

/// sum_k x_k exp(-i 2 pi j k / n) for j = 0 ... n / 2, of a real x.
std::vector<Complex> transform(std::vector<double> x) {
  std::vector<Complex> to(x.size() / 2 + 1);
  const auto plan = detail::make_plan(
      [&] { return fftw_plan_dft_r2c_1d(static_cast<int>(x.size()), x.data(), fftw(to), FFTW_ESTIMATE); });
  fftw_execute(plan.get());
  return to;
}

/// The inverse transform, which overwrites its input.
std::vector<double> inverse(std::vector<Complex> from) {
  std::vector<double> to(2 * (from.size() - 1));
  const auto plan = detail::make_plan(
      [&] { return fftw_plan_dft_c2r_1d(static_cast<int>(to.size()), fftw(from), to.data(), FFTW_ESTIMATE); });
  fftw_execute(plan.get());
  for (double& value : to) value /= static_cast<double>(to.size());
  return to;
}

/// Squared amplitudes of the values of a pulse's pieces, at frequencies from 0 to pi / dt, where one pulse arrives a
/// second: density (5.20) = 1 / 2 pi |sum_k w_k exp(-i omega dt k)|^2 (dt sinc(omega dt / 2))^2.
class Target {
 public:
  Target(const Spectrum& spectrum, double dt) : spectrum_(spectrum), dt_(dt) {
    const double low = 1e-6 * pi / dt;
    if (spectrum(0) > 0 || !(spectrum(low) > 0)) return;
    const double power = std::log2(spectrum(2 * low) / spectrum(low));
    zeros_ = static_cast<int>(std::lround(power / 2));
    detail::require(
        zeros_ >= 1 && zeros_ <= max_zeros && std::abs(power - 2 * zeros_) < 0.01,
        "PulseShape: where the spectrum is 0 at omega = 0 it must rise as an even power of omega, 2 to 16, or "
        "the pulse does not end; its power there is",
        power);
  }

  /// Zeros of the amplitude at omega = 0: the values are differences, as many times.
  int zeros() const { return zeros_; }

  double density(double omega) const { return spectrum_(omega); }

  double amplitude(double omega) const {
    const double loss = detail::interpolation_loss(Interpolation::constant, omega * dt_ / 2) * dt_;
    return std::sqrt(2 * pi * spectrum_(omega)) / loss;
  }

  /// Logarithm of the amplitude without its zeros at omega = 0, about a frequency that stands for a cell of this width.
  double log_amplitude(double omega, double width) const {
    const auto at = [&](double w) {
      const double s = amplitude(w);
      return std::log(s) - zeros_ * std::log(2 * std::abs(std::sin(w * dt_ / 2)));
    };
    // Where a zero lies in the cell: a power's logarithm has its mean over the cell at this distance.
    const double aside = width / (2 * std::numbers::e), w = omega + (omega < pi / (2 * dt_) ? aside : -aside);
    if (omega > 0 && spectrum_(omega) > 1e-3 * spectrum_(w)) return at(omega);
    detail::require(spectrum_(w) > 0,
                    "PulseShape: the spectrum must be positive from 0 to pi / dt = " + detail::shortest(pi / dt_) +
                        " rad/s, or no pulse that begins at a time has it; at omega = " + detail::shortest(omega) +
                        " rad/s",
                    spectrum_(w), "m^2/s^3");
    return at(w);
  }

 private:
  const Spectrum& spectrum_;
  double dt_;
  int zeros_ = 0;
};

/// The minimum-phase sequence with this amplitude, except for its zeros at omega = 0, by FFTs of n points: the cepstrum
/// of a causal sequence with a causal inverse is zero before time zero.
std::vector<double> minimum_phase(const Target& target, double dt, std::size_t n) {
  const double width = 2 * pi / (static_cast<double>(n) * dt);
  std::vector<Complex> spectrum(n / 2 + 1);
  for (std::size_t k = 0; k < spectrum.size(); ++k)
    spectrum[k] = target.log_amplitude(static_cast<double>(k) * width, width);
  std::vector<double> cepstrum = inverse(std::move(spectrum));
  for (std::size_t k = 1; k < n / 2; ++k) {
    cepstrum[k] *= 2;
    cepstrum[n - k] = 0;
  }
  spectrum = transform(std::move(cepstrum));
  for (Complex& value : spectrum) value = std::exp(value);
  return inverse(std::move(spectrum));
}

/// As many values from a sequence, whose differences they are.
std::vector<double> pieces(const std::vector<double>& sequence, std::size_t count, int differences) {
  std::vector<double> values(sequence.begin(), sequence.begin() + static_cast<std::ptrdiff_t>(count) - differences);
  for (int i = 0; i < differences; ++i) {
    values.push_back(0);
    for (std::size_t k = values.size() - 1; k > 0; --k) values[k] -= values[k - 1];
  }
  return values;
}

}  // namespace

namespace detail {

SpectralPulse spectral_pulse(const Spectrum& spectrum, double dt, double tolerance) {
  require(std::isfinite(dt) && dt > 0, "PulseShape: dt must be positive and finite", dt, "s");
  require(tolerance >= 1e-6 && tolerance <= 0.1, "PulseShape: the tolerance must be from 1e-6 to 0.1", tolerance);
  require(spectrum.high() >= pi / dt,
          "PulseShape: the spectrum must reach pi / dt = " + shortest(pi / dt) + " rad/s, but ends at", spectrum.high(),
          "rad/s");
  const Target target(spectrum, dt);
  const auto least = static_cast<std::size_t>(target.zeros()) + 1;

  for (std::size_t n = fewest_points; n <= max_points; n *= 4) {
    const std::vector<double> sequence = minimum_phase(target, dt, n);
    // Also between the frequencies at which it was computed.
    const double step = pi / (static_cast<double>(n) * dt);
    std::vector<double> wanted(n + 1), loss(n + 1);
    double all = 0;
    for (std::size_t k = 0; k <= n; ++k) {
      const double omega = static_cast<double>(k) * step;
      loss[k] = interpolation_loss(Interpolation::constant, omega * dt / 2) * dt;
      all += wanted[k] = target.density(omega);
    }
    const auto misfit = [&](std::size_t count) {
      std::vector<double> values = pieces(sequence, count, target.zeros());
      values.resize(2 * n);
      const std::vector<Complex> found = transform(std::move(values));
      double sum = 0;
      for (std::size_t k = 0; k <= n; ++k)
        sum += std::abs(std::norm(found[k]) * loss[k] * loss[k] / (2 * pi) - wanted[k]);
      return sum / all;
    };
    if (!(misfit(n / 2) <= tolerance)) continue;
    std::size_t count = n / 2;
    for (std::size_t below = least - 1; count - below > 1;) {
      const std::size_t middle = below + (count - below) / 2;
      (misfit(middle) <= tolerance ? count : below) = middle;
    }
    std::vector<double> values = pieces(sequence, count, target.zeros()), times(count + 1);
    for (std::size_t k = 0; k <= count; ++k) times[k] = static_cast<double>(k) * dt;
    double peak = 0;
    for (const double value : values) peak = std::max(peak, std::abs(value));
    for (double& value : values) value /= peak;
    return {PulseShape(std::move(times), std::move(values)), peak};
  }
  throw std::invalid_argument("PulseShape: a pulse with this spectrum is not within the tolerance " +
                              shortest(tolerance) + " in " + std::to_string(max_points / 2) + " pieces of " +
                              shortest(dt) + " s: its peaks or its zeros are too sharp for so short a dt");
}

}  // namespace detail

PulseShape PulseShape::from_spectrum(const Spectrum& spectrum, double dt, double tolerance) {
  return detail::spectral_pulse(spectrum, dt, tolerance).shape;
}

PulseShape::PulseShape(std::vector<double> times, std::vector<double> values)
    : times_(std::move(times)), values_(std::move(values)) {
  const auto element = [](const char* array, std::size_t i) {
    return "PulseShape: " + std::string(array) + "[" + std::to_string(i) + "]";
  };
  if (values_.empty() || times_.size() != values_.size() + 1)
    throw std::invalid_argument("PulseShape: needs one time more than values, and a value, got " +
                                std::to_string(times_.size()) + " times for " + std::to_string(values_.size()) +
                                " values");
  for (std::size_t i = 0; i < times_.size(); ++i)
    detail::require(std::isfinite(times_[i]), element("times", i) + " must be finite", times_[i]);
  detail::require(times_[0] == 0, "PulseShape: times[0] must be 0, where the pulse arrives", times_[0]);
  for (std::size_t i = 1; i < times_.size(); ++i)
    detail::require(times_[i] > times_[i - 1],
                    element("times", i) + " must be greater than " + detail::shortest(times_[i - 1]), times_[i]);
  for (std::size_t i = 0; i < values_.size(); ++i)
    detail::require(std::isfinite(values_[i]), element("values", i) + " must be finite", values_[i]);
  if (std::ranges::all_of(values_, [](double value) { return value == 0; }))
    throw std::invalid_argument("PulseShape: values must not all be 0");
}

}  // namespace stickslip
