#include "stickslip/theory/displacement_distribution.hpp"

#include <fftw3.h>
#include <gsl/gsl_cdf.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <numbers>

#include "numerics/fftw_plan.hpp"
#include "numerics/monotone_cubic.hpp"
#include "stickslip/base/equal.hpp"
#include "stickslip/base/error.hpp"
#include "stickslip/numerics/root.hpp"

namespace stickslip::detail {
namespace {

using Powers = std::array<double, 5>;  ///< means of the powers 0 to 4

/// The moments of theta if theta times a gamma variate of shape 1 / q and mean 1 has the moments `m`.
Powers of_scale(Powers m, double q) {
  double factor = 1;
  for (int n = 1; n < 5; ++n) m[static_cast<std::size_t>(n)] /= factor *= 1 + (n - 1) * q;
  return m;
}

/// Hankel's determinant: 0 for the moments of a two-point distribution, positive for those of a wider one.
double hankel(const Powers& m) {
  return m[2] * m[4] - m[3] * m[3] - m[1] * (m[1] * m[4] - m[2] * m[3]) + m[2] * (m[1] * m[3] - m[2] * m[2]);
}

}  // namespace

Slips gamma_slips(double count, const std::array<double, 4>& moments) {
  Slips slips;
  if (!(count > 0 && moments[1] > 0)) return slips;
  const double unit = std::sqrt(moments[1] / count);
  Powers m{1};
  for (std::size_t n = 1; n < 5; ++n) m[n] = moments[n - 1] / count / std::pow(unit, static_cast<double>(n));
  m[1] = std::clamp(m[1], -0.999, 0.999);
  const double least = (m[3] * m[3] + m[2] * m[2] * m[2] - 2 * m[1] * m[2] * m[3]) / (m[2] - m[1] * m[1]);
  require(
      m[4] >= least - 0.1 * count,
      "DisplacementDistribution: the kurtosis must be at least that of as many slips, " + shortest(3 + least / count),
      3 + m[4] / count);
  m[4] = std::max(m[4], least);
  const auto enough = [&](double q) { return hankel(of_scale(m, q)) <= 0; };
  double most = 1;
  while (!enough(most) && most < 1e6) most *= 2;
  const double q = hankel(m) <= 1e-12 * m[4] ? 0 : numerics::first_where(0, most, enough);
  const Powers s = of_scale(m, q);
  const double a = (s[3] - s[1] * s[2]) / (s[2] - s[1] * s[1]), b = s[2] - a * s[1];
  const double root = std::sqrt(std::max(a * a + 4 * b, 0.0));
  const std::array<double, 2> scales = {(a + root) / 2, (a - root) / 2};
  const double first = (s[1] - scales[1]) / root;
  const std::array<double, 2> counts = {count * first, count * (1 - first)};
  const double shape = 1 / std::max(q, 1e-3);

  slips.count = count;
  for (std::size_t n = 0; n < 4; ++n) slips.moments[n] = count * m[n + 1] * std::pow(unit, static_cast<double>(n + 1));
  constexpr int cells = 2000;
  double begin = 1, end = 1;
  while (begin > 1e-7 && gsl_cdf_gamma_P(begin, shape, 1 / shape) > 1e-9) begin /= 1.2;
  while (gsl_cdf_gamma_Q(end, shape, 1 / shape) > 1e-15) end *= 1.1;
  std::array<double, cells + 1> edges{}, below{};
  for (int i = 1; i <= cells; ++i)
    edges[static_cast<std::size_t>(i)] = begin * std::pow(end / begin, (i - 1.0) / (cells - 1));
  for (std::size_t i = 1; i <= cells; ++i) below[i] = gsl_cdf_gamma_P(edges[i], shape, 1 / shape);
  for (std::size_t k = 0; k < 2; ++k)
    for (std::size_t i = 0; i < cells; ++i)
      slips.pieces.push_back(
          {unit * scales[k] * edges[i], unit * scales[k] * edges[i + 1], counts[k] * (below[i + 1] - below[i])});
  // Chernoff's bounds, by the logarithm of the moment-generating function.
  const auto bound = [&](double sign) {
    constexpr double tail = 32;
    const double steepest = std::max({sign * scales[0], sign * scales[1], 0.0}) / shape;
    double best = std::numeric_limits<double>::infinity();
    for (double theta = 1e-4; theta < 1e4; theta *= 1.02) {
      if (theta * steepest >= 1) break;
      double log_mean = 0;
      for (std::size_t k = 0; k < 2; ++k)
        log_mean += counts[k] * std::expm1(-shape * std::log1p(-theta * sign * scales[k] / shape));
      best = std::min(best, (log_mean + tail) / theta);
    }
    return unit * best;
  };
  slips.greatest = bound(1);
  slips.least = -bound(-1);
  return slips;
}

}  // namespace stickslip::detail

namespace stickslip::theory {
namespace {

using detail::equal;
using detail::require;

constexpr std::size_t nodes = DisplacementDistribution::nodes;

struct Free {
  void operator()(void* memory) const noexcept { fftw_free(memory); }
};

template <class T>
std::unique_ptr<T[], Free> aligned(std::size_t count) {
  auto* memory = static_cast<T*>(fftw_malloc(count * sizeof(T)));
  if (memory == nullptr) throw std::bad_alloc();
  return std::unique_ptr<T[], Free>(memory);
}

/// The node at multiple k of the step, in a grid without ends.
std::size_t wrapped(double k) {
  const double turn = static_cast<double>(nodes);
  return static_cast<std::size_t>(k - turn * std::floor(k / turn));
}

/// Divides the slips between the two adjacent nodes so that their number and mean are preserved.
void lay(const detail::SlipPiece& piece, double step, double* grid) {
  const auto put = [&](double place, double cell, double count) {  // `place` in steps, within [cell, cell + 1]
    grid[wrapped(cell)] += count * (cell + 1 - place);
    grid[wrapped(cell + 1)] += count * (place - cell);
  };
  const double low = std::min(piece.from, piece.to) / step, high = std::max(piece.from, piece.to) / step;
  if (std::floor(low) == std::floor(high)) return put((low + high) / 2, std::floor(low), piece.count);
  for (double from = low; from < high;) {
    const double cell = std::floor(from), to = std::min(cell + 1, high);
    put((from + to) / 2, cell, piece.count * ((to - from) / (high - low)));
    from = to;
  }
}

}  // namespace

DisplacementDistribution::DisplacementDistribution(const detail::Slips& slips, std::string remark)
    : remark_(std::move(remark)), count_(slips.count) {
  std::copy_n(slips.moments, 4, cumulants_);
  if (!(slips.count > 0 && slips.greatest > slips.least)) return;
  atom_ = std::exp(-slips.count);
  step_ = (slips.greatest - slips.least) / static_cast<double>(nodes - 2);
  const double first = std::floor(slips.least / step_);

  const auto grid = aligned<double>(nodes);
  const auto transform = aligned<fftw_complex>(nodes / 2 + 1);
  const auto forward = detail::make_plan(
      [&] { return fftw_plan_dft_r2c_1d(static_cast<int>(nodes), grid.get(), transform.get(), FFTW_ESTIMATE); });
  const auto backward = detail::make_plan(
      [&] { return fftw_plan_dft_c2r_1d(static_cast<int>(nodes), transform.get(), grid.get(), FFTW_ESTIMATE); });

  std::fill_n(grid.get(), nodes, 0.0);
  for (const detail::SlipPiece& piece : slips.pieces) lay(piece, step_, grid.get());
  fftw_execute(forward.get());
  const double total = transform[0][0], atom = std::exp(-total);  // `count`, but for the pieces' round-off
  for (std::size_t i = 0; i <= nodes / 2; ++i) {
    // exp(z - total) - exp(-total), without cancellation where slips are rare
    const double re = transform[i][0], im = transform[i][1], half = std::sin(im / 2);
    const double size = std::exp(re - total);
    transform[i][0] = (re < 1 ? atom * std::expm1(re) : size - atom) - 2 * size * half * half;
    transform[i][1] = size * std::sin(im);
  }
  fftw_execute(backward.get());

  displacement_.resize(nodes);
  density_.resize(nodes);
  below_.resize(nodes + 1);
  double sum = 0;
  for (std::size_t i = 0; i < nodes; ++i) {
    const double k = first + static_cast<double>(i);
    const double mass = std::max(grid[wrapped(k)] / static_cast<double>(nodes), 0.0);
    displacement_[i] = k * step_;
    density_[i] = mass / step_;
    below_[i] = sum;
    sum += mass;
  }
  below_[nodes] = sum;
}

DisplacementDistribution::DisplacementDistribution(detail::DisplacementTable table, std::string remark)
    : remark_(std::move(remark)), atom_(table.atom), count_(-std::log(table.atom)), table_(std::move(table)) {
  const std::vector<double>&x = table_.displacement, &below = table_.below;
  step_ = (x.back() - x.front()) / static_cast<double>(nodes);
  displacement_.resize(nodes);
  density_.resize(nodes);
  below_.resize(nodes + 1);
  // On either side of 0, where the density may be unbounded.
  const auto rest = static_cast<std::size_t>(std::ranges::lower_bound(x, 0.0) - x.begin());
  const auto lay = [&](std::size_t first, std::size_t last) {
    if (first == last) return;
    const std::span<const double> places(x), values(below);
    const numerics::MonotoneCubic curve(places.subspan(first, last + 1 - first),
                                        values.subspan(first, last + 1 - first));
    for (std::size_t i = 0; i <= nodes; ++i) {
      const double edge = x.front() + step_ * static_cast<double>(i);
      if (edge >= x[first] && edge <= x[last]) below_[i] = curve(edge);
    }
  };
  lay(0, rest);
  lay(rest, x.size() - 1);
  below_[nodes] = below.back();
  double powers[5] = {};
  for (std::size_t i = 0; i < nodes; ++i) {
    displacement_[i] = x.front() + step_ * (static_cast<double>(i) + 0.5);
    double power = below_[i + 1] - below_[i];
    density_[i] = power / step_;
    for (double& one : powers) one += power, power *= displacement_[i];
  }
  const double mean = powers[1], variance = powers[2] - mean * mean;
  cumulants_[0] = mean;
  cumulants_[1] = variance;
  cumulants_[2] = powers[3] - 3 * mean * powers[2] + 2 * mean * mean * mean;
  cumulants_[3] = powers[4] - 4 * mean * powers[3] + 6 * mean * mean * powers[2] - 3 * mean * mean * mean * mean -
                  3 * variance * variance;
}

double DisplacementDistribution::error() const noexcept {
  return table_.error.empty() ? 0 : std::ranges::max(table_.error);
}

double DisplacementDistribution::error_at(double x) const {
  require(!std::isnan(x), "DisplacementDistribution: x must be a number", x, "m");
  if (table_.error.empty()) return 0;
  if (x < table_.displacement.front() && equal(table_.displacement.front(), 0)) return 0;  // it slides one way
  const auto next = std::ranges::lower_bound(table_.displacement, x);
  const auto i = static_cast<std::size_t>(std::min(next, table_.displacement.end() - 1) - table_.displacement.begin());
  return std::max(table_.error[i], table_.error[i > 0 ? i - 1 : 0]);
}

double DisplacementDistribution::skewness() const noexcept {
  return cumulants_[2] / (cumulants_[1] * std::sqrt(cumulants_[1]));
}

double DisplacementDistribution::kurtosis() const noexcept {
  return 3 + cumulants_[3] / (cumulants_[1] * cumulants_[1]);
}

double DisplacementDistribution::smooth_cdf(double x) const {
  if (below_.empty()) return 0;
  const double place = (x - displacement_.front()) / step_ + 0.5;
  if (!(place > 0)) return 0;
  if (place >= static_cast<double>(nodes)) return below_.back();
  const auto i = static_cast<std::size_t>(place);
  return below_[i] + (place - static_cast<double>(i)) * (below_[i + 1] - below_[i]);
}

double DisplacementDistribution::cdf(double x) const {
  require(!std::isnan(x), "DisplacementDistribution: x must be a number", x, "m");
  return std::min(smooth_cdf(x) + (x >= 0 ? atom_ : 0), 1.0);
}

double DisplacementDistribution::quantile(double probability) const {
  require(probability >= min_probability && probability <= 1 - min_probability,
          "DisplacementDistribution: probability must be at least 1e-9 and at most 1 - 1e-9", probability);
  const double before = smooth_cdf(0);
  if (probability >= before && probability <= before + atom_) return 0;
  const double mass = probability < before ? probability : probability - atom_;
  const auto edge = std::ranges::lower_bound(below_, mass);
  if (edge == below_.end()) return displacement_.back();  // beyond by round-off alone
  const auto i = static_cast<std::size_t>(edge - below_.begin());
  const double within = i == 0 ? 0.0 : (mass - below_[i - 1]) / (below_[i] - below_[i - 1]);
  return displacement_.front() + step_ * (static_cast<double>(i) - 1.5 + within);
}

std::complex<double> DisplacementDistribution::characteristic(double u) const {
  require(std::isfinite(u), "DisplacementDistribution: u must be finite", u, "1/m");
  std::complex<double> sum = atom_;
  for (std::size_t i = 0; i < density_.size(); ++i) sum += density_[i] * step_ * std::polar(1.0, u * displacement_[i]);
  return sum;
}

}  // namespace stickslip::theory
