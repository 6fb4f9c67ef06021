#include "stickslip/theory/displacement_distribution.hpp"

#include <fftw3.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>

#include "numerics/fftw_plan.hpp"
#include "stickslip/error.hpp"

namespace stickslip::theory {
namespace {

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

/// The node at a multiple k of the step, of a grid without ends.
std::size_t wrapped(double k) {
  const double turn = static_cast<double>(nodes);
  return static_cast<std::size_t>(k - turn * std::floor(k / turn));
}

/// Shares the slips out among the two nodes beside each, so that their number and mean stay.
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

DisplacementDistribution::DisplacementDistribution(const detail::Slips& slips) : count_(slips.count) {
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
  require(probability >= least_probability && probability <= 1 - least_probability,
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
