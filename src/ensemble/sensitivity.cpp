#include "stickslip/ensemble/sensitivity.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstddef>
#include <span>
#include <stdexcept>

#include "base/threads.hpp"

namespace stickslip::detail {
namespace {

double mean(std::span<const double> values) {
  double sum = 0;
  for (const double value : values) sum += value;
  return sum / static_cast<double>(values.size());
}

Estimate mean_of(std::span<const double> values) {
  const double middle = mean(values), n = static_cast<double>(values.size());
  double squares = 0;
  for (const double value : values) squares += (value - middle) * (value - middle);
  return {middle, std::sqrt(squares / (n - 1) / n)};
}

}  // namespace

EnsembleSensitivity ensemble_sensitivity(const EnsembleSensitivityOptions& options,
                                         const std::function<MemberSensitivity(std::uint64_t member)>& differentiate) {
  if (options.members < 2)
    throw std::invalid_argument("ensemble_sensitivity: members must be at least 2, for standard errors, got " +
                                std::to_string(options.members));
  if (options.members > UINT64_MAX - options.first_member)
    throw std::invalid_argument("ensemble_sensitivity: first_member + members must be less than 2^64, got members = " +
                                std::to_string(options.members));
  const auto count = static_cast<std::size_t>(options.members);
  EnsembleSensitivity result;
  result.peak.resize(count);
  result.residual.resize(count);
  std::vector<double> x(count);

  std::atomic<bool> stopped = false;
  std::atomic<std::size_t> done = 0;
  const auto work = [&](const NextTask& next) {
    for (std::size_t i; next(i); ++done) {
      const MemberSensitivity one = differentiate(options.first_member + i);
      x[i] = one.residual;
      result.peak[i] = one.derivative.peak;
      result.residual[i] = one.derivative.residual;
    }
  };
  run_on_threads(options.threads, count, stopped, work, [&] {
    if (options.progress) options.progress(done, options.members);
  });

  result.peak_mean = mean_of(result.peak);
  result.residual_mean = mean_of(result.residual);
  double largest = 0;  // squares of x over it stay within the range of doubles
  for (const double value : x) largest = std::max(largest, std::abs(value));
  if (!(largest > 0)) return result;  // nothing moves, and a small change would move nothing
  std::vector<double> products(count), squares(count);
  for (std::size_t i = 0; i < count; ++i) {
    products[i] = x[i] / largest * result.residual[i];
    squares[i] = (x[i] / largest) * (x[i] / largest);
  }
  const Estimate product = mean_of(products);
  result.residual_mean_square = {2 * largest * product.value, 2 * largest * product.error};
  // To first order, rms' = E[x dx] / rms scatters as the mean over members of (x dx - rms' x^2 / (2 rms)) / rms.
  const double rms = std::sqrt(mean(squares)), derivative = product.value / rms;
  for (std::size_t i = 0; i < count; ++i) products[i] = (products[i] - derivative * squares[i] / (2 * rms)) / rms;
  result.residual_rms = {derivative, mean_of(products).error};
  return result;
}

}  // namespace stickslip::detail
