#include "stickslip/theory/velocity_distribution.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <utility>

#include "numerics/monotone_cubic.hpp"
#include "stickslip/base/error.hpp"
#include "stickslip/numerics/root.hpp"

namespace stickslip::theory {

using detail::require;

struct VelocityDistribution::Spline : numerics::MonotoneCubic {
  using MonotoneCubic::MonotoneCubic;
};

VelocityDistribution::VelocityDistribution(detail::VelocityTable table, double error, double atom_error,
                                           std::string remark)
    : table_(std::move(table)), error_(error), atom_error_(atom_error), remark_(std::move(remark)) {
  const auto& v = table_.velocity;
  const std::span<const double> below = table_.below;
  const auto rest = static_cast<std::size_t>(std::ranges::lower_bound(v, 0.0) - v.begin());
  if (rest > 1) backward_ = std::make_shared<const Spline>(std::span(v).first(rest + 1), below.first(rest + 1));
  if (v.size() - rest > 2) forward_ = std::make_shared<const Spline>(std::span(v).subspan(rest), below.subspan(rest));
}

double VelocityDistribution::cdf(double v) const {
  require(!std::isnan(v), "VelocityDistribution: v must be a number", v, "m/s");
  const Spline* const side = (v < 0 ? backward_ : forward_).get();
  const double inside = std::clamp(v, table_.velocity.front(), table_.velocity.back());
  const double below = side == nullptr ? (v < 0 ? 0 : table_.below.back()) : (*side)(inside);
  return std::min(below + (v < 0 ? 0 : table_.atom), 1.0);
}

double VelocityDistribution::density(double v) const {
  require(!std::isnan(v), "VelocityDistribution: v must be a number", v, "m/s");
  const Spline* const side = (v < 0 ? backward_ : forward_).get();
  if (side == nullptr || v < table_.velocity.front() || v > table_.velocity.back()) return 0;
  return side->slope(v);
}

double VelocityDistribution::quantile(double probability) const {
  require(probability > 0 && probability < 1, "VelocityDistribution: probability must be between 0 and 1", probability);
  const double low = table_.velocity.front(), high = table_.velocity.back();
  if (cdf(low) >= probability) return low;
  return numerics::first_where(low, high, [&](double v) { return cdf(v) >= probability; });
}

}  // namespace stickslip::theory
