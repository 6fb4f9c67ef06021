#include "theory/pulse_chain/lattice.hpp"

namespace stickslip::detail::pulse_chain {

double lattice_spacing(double sigma, double parts) {
  return sigma > 2 ? 1 : 1 / std::ceil(std::max(parts / sigma, 0.5 / (sigma * sigma)));
}

double lattice_spacing(double sigma, double parts, double other) {
  const double coarsest = lattice_spacing(sigma, parts);
  if (other == 1 || std::isinf(other)) return coarsest;
  double best = coarsest, least = 1;
  const double first = 1 / coarsest;
  for (double k = first; k <= std::max(1.5 * first, 4.0); ++k) {
    const double miss = std::abs(other * k - std::round(other * k));
    if (miss < least - 0.02) best = 1 / k, least = miss;
  }
  return best;
}

std::array<double, 4> lagrange(const double* x, double at) {
  std::array<double, 4> w;
  for (std::size_t i = 0; i < 4; ++i) {
    w[i] = 1;
    for (std::size_t j = 0; j < 4; ++j)
      if (j != i) w[i] *= (at - x[j]) / (x[i] - x[j]);
  }
  return w;
}

Weights gaussian(double sigma, double spacing, int reach, int count) {
  Weights law{spacing, reach, std::vector<double>(static_cast<std::size_t>(2 * reach + 1))};
  double sum = 0;
  for (int i = -reach; i <= reach; ++i) sum += law[i] = std::exp(-0.5 * std::pow(i * spacing / sigma, 2) / count);
  for (double& w : law.w) w /= sum;
  return law;
}

std::vector<double> amplitudes(const Quantile& quantile) {
  constexpr std::size_t count = 1 << 14;
  std::vector<double> u(count);
  for (std::size_t i = 0; i < count; ++i) u[i] = (static_cast<double>(i) + 0.5) / count;
  quantile(u);
  return u;
}

bool symmetric(const std::vector<double>& amplitudes) {
  for (std::size_t i = 0, j = amplitudes.size() - 1; i < j; ++i, --j)
    if (!(std::abs(amplitudes[i] + amplitudes[j]) <= 1e-9 * (1 + std::abs(amplitudes[i])))) return false;
  return true;
}

namespace {

/// Any law by its quantiles, each spread over the four nodes next to it.
Weights by_quantiles(const Quantile& quantile, double sigma, double spacing, int reach) {
  Weights law{spacing, reach, std::vector<double>(static_cast<std::size_t>(2 * reach + 1))};
  const std::vector<double> all = amplitudes(quantile);
  for (const double q : all) {
    const double place = std::clamp(sigma * q / spacing, -reach + 1.0, reach - 1.0);
    const int cell = std::clamp(static_cast<int>(std::floor(place)), 1 - reach, reach - 2);
    const double nodes[] = {cell - 1.0, cell + 0.0, cell + 1.0, cell + 2.0};
    const auto share = lagrange(nodes, place);
    for (int i = 0; i < 4; ++i)
      law[cell - 1 + i] += share[static_cast<std::size_t>(i)] / static_cast<double>(all.size());
  }
  return law;
}

/// The law of the sum of two; the probability that falls outside is dropped.
Weights convolved(const Weights& a, const Weights& b) {
  Weights sum{a.spacing, a.reach, std::vector<double>(a.w.size())};
  for (int i = -a.reach; i <= a.reach; ++i)
    for (int j = std::max(-a.reach, -a.reach - i); j <= std::min(a.reach, a.reach - i); ++j) sum[i + j] += a[i] * b[j];
  return sum;
}

}  // namespace

Weights Arrivals::single(double spacing, int reach) const {
  return quantile ? by_quantiles(quantile, sigma, spacing, reach) : gaussian(sigma, spacing, reach, 1);
}

Weights Arrivals::batch(double slot, double spacing, int reach) const {
  const double mean = rate * slot;
  Weights sum{spacing, reach, std::vector<double>(static_cast<std::size_t>(2 * reach + 1))};
  double probability = std::exp(-mean);
  sum[0] = probability;
  const Weights one = single(spacing, reach);
  Weights law = one;
  for (int k = 1; k < 2000; ++k) {
    probability *= mean / k;
    if (k > mean && probability < 1e-18) break;
    for (int i = -reach; i <= reach; ++i) sum[i] += probability * law[i];
    law = quantile ? convolved(law, one) : gaussian(sigma, spacing, reach, k + 1);
  }
  return sum;
}

}  // namespace stickslip::detail::pulse_chain
