#include "stickslip/statistics/distribution.hpp"

#include <gsl/gsl_cdf.h>

#include <algorithm>
#include <cmath>

#include "base/json.hpp"
#include "stickslip/base/error.hpp"

namespace stickslip {
namespace {

void check_probability(double probability) {
  detail::require(probability > 0 && probability < 1, "quantile: probability must lie between 0 and 1", probability);
}

// The quantile of a standard normal variate that is known to lie between `low` and `high`, low < high. Probabilities
// are measured from the nearer tail, where they are not rounded to 1.
double quantile_between(double low, double high, double probability) {
  if (low > 0) return -quantile_between(-high, -low, 1 - probability);
  const double below = gsl_cdf_ugaussian_P(low), inside = gsl_cdf_ugaussian_P(high) - below;
  const double p = below + probability * inside;
  return std::clamp(p < 0.5 ? gsl_cdf_ugaussian_Pinv(p)
                            : gsl_cdf_ugaussian_Qinv(gsl_cdf_ugaussian_Q(high) + (1 - probability) * inside),
                    low, high);
}

}  // namespace

Lognormal::Lognormal(double median, double beta) : median_(median), beta_(beta) {
  detail::require(std::isfinite(median) && median > 0, "Lognormal: median must be positive and finite", median);
  detail::require(std::isfinite(beta) && beta >= 0, "Lognormal: beta must be finite and at least 0", beta);
}

double Lognormal::quantile(double probability) const {
  check_probability(probability);
  return median_ * std::exp(beta_ * gsl_cdf_ugaussian_Pinv(probability));
}

Normal::Normal(double mean, double std, double low, double high) : mean_(mean), std_(std), low_(low), high_(high) {
  detail::require(std::isfinite(mean), "Normal: mean must be finite", mean);
  detail::require(std::isfinite(std) && std >= 0, "Normal: std must be finite and at least 0", std);
  detail::require(low < high, "Normal: low must be less than high, " + detail::shortest(high), low);
  const double nearest = std::clamp(mean, low, high);
  // Within 37 standard deviations probabilities are normal doubles.
  detail::require(
      std::abs(nearest - mean) <= 37 * std,
      "Normal: the bounds must leave some probability, and be within 37 std of the mean, " + detail::shortest(mean),
      nearest);
}

double Normal::quantile(double probability) const {
  check_probability(probability);
  if (std_ == 0) return mean_;
  const double z = quantile_between((low_ - mean_) / std_, (high_ - mean_) / std_, probability);
  return std::clamp(mean_ + std_ * z, low_, high_);
}

Uniform::Uniform(double low, double high) : low_(low), high_(high) {
  detail::require(std::isfinite(low), "Uniform: low must be finite", low);
  detail::require(std::isfinite(high) && low <= high,
                  "Uniform: high must be finite and at least low, " + detail::shortest(low), high);
}

double Uniform::quantile(double probability) const {
  check_probability(probability);
  return std::clamp((1 - probability) * low_ + probability * high_, low_, high_);
}

double quantile(const Distribution& distribution, double probability) {
  check_probability(probability);
  return std::visit(
      [&](const auto& one) -> double {
        if constexpr (requires { one.quantile(probability); })
          return one.quantile(probability);
        else
          return one;
      },
      distribution);
}

namespace detail {
namespace {

std::string describe(double value) { return json(value); }
std::string describe(const Lognormal& d) {
  return "{\"distribution\": \"Lognormal\", \"median\": " + json(d.median()) + ", \"beta\": " + json(d.beta()) + "}";
}
std::string describe(const Normal& d) {
  return "{\"distribution\": \"Normal\", \"mean\": " + json(d.mean()) + ", \"std\": " + json(d.std()) +
         ", \"low\": " + json(d.low()) + ", \"high\": " + json(d.high()) + "}";
}
std::string describe(const Uniform& d) {
  return "{\"distribution\": \"Uniform\", \"low\": " + json(d.low()) + ", \"high\": " + json(d.high()) + "}";
}

}  // namespace

std::string describe(const Distribution& distribution) {
  return std::visit([](const auto& one) { return describe(one); }, distribution);
}

}  // namespace detail
}  // namespace stickslip
