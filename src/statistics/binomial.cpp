#include "stickslip/statistics/binomial.hpp"

#include <gsl/gsl_cdf.h>

#include "stickslip/base/error.hpp"
#include "stickslip/numerics/root.hpp"

namespace stickslip {

Interval binomial_interval(std::uint64_t count, std::uint64_t trials, double confidence) {
  detail::require(trials > 0, "binomial_interval: trials must be at least 1", static_cast<double>(trials));
  detail::require(count <= trials, "binomial_interval: count must be at most trials", static_cast<double>(count));
  detail::require(confidence > 0 && confidence < 1, "binomial_interval: confidence must lie between 0 and 1",
                  confidence);
  const auto k = static_cast<double>(count), n = static_cast<double>(trials);
  const double tail = (1 - confidence) / 2;
  // GSL's inverse of the beta distribution fails to converge for one count in ten of 20,000, and would end the process.
  const auto low = [&](double p) { return !(gsl_cdf_beta_P(p, k, n - k + 1) < tail); };
  const auto high = [&](double p) { return !(gsl_cdf_beta_Q(p, k + 1, n - k) > tail); };
  return {k / n, count == 0 ? 0 : numerics::first_where(0, 1, low),
          count == trials ? 1 : numerics::first_where(0, 1, high)};
}

}  // namespace stickslip
