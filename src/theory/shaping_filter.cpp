#include "stickslip/theory/shaping_filter.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <limits>
#include <span>
#include <string>
#include <utility>
#include <variant>

#include "stickslip/base/error.hpp"

namespace stickslip::theory {
namespace {

using detail::require;
using detail::shortest;
using Section = ShapingFilter::Section;
using Vector = Eigen::VectorXd;
using Matrix = Eigen::MatrixXd;

const std::string noun = "ShapingFilter";
constexpr int max_sections = 8;

double squared(double x) { return x * x; }

/// A sampled spectrum: frequencies, the weight of each in an integral over their logarithm, and the density.
struct Grid {
  std::vector<double> omega, weight, density;

  /// @param cuts  frequencies at which the density jumps: points are concentrated there
  Grid(const std::function<double(double)>& spectrum, double low, double high, int each_decade,
       std::span<const double> cuts) {
    const int count = static_cast<int>(std::ceil(std::log10(high / low) * each_decade));
    for (int i = 0; i <= count; ++i) omega.push_back(low * std::pow(high / low, static_cast<double>(i) / count));
    for (const double cut : cuts)
      for (double apart = 0.2; apart > 1e-10; apart *= apart > 0.003 ? 0.7 : 1e-7)
        for (const double point : {cut * (1 - apart), cut * (1 + apart)})
          if (point > low && point < high) omega.push_back(point);
    std::ranges::sort(omega);
    weight.resize(omega.size());
    for (std::size_t i = 1; i < omega.size(); ++i) {
      const double half = std::log(omega[i] / omega[i - 1]) / 2;
      weight[i - 1] += half;
      weight[i] += half;
    }
    for (const double w : omega) {
      density.push_back(spectrum(w));
      require(std::isfinite(density.back()) && density.back() >= 0,
              noun + ": a spectrum must be finite and at least 0; at " + shortest(w) + " rad/s", density.back(),
              "m^2/s^3");
    }
  }

  std::size_t size() const { return omega.size(); }
  double variance(std::size_t i) const { return density[i] * omega[i] * weight[i]; }
};

/// The band that holds all but a hundredth of the variance, half of it on each side.
struct Band {
  double low, high;
};

Band band_of(const Grid& grid) {
  double whole = 0, below = 0;
  for (std::size_t i = 0; i < grid.size(); ++i) whole += grid.variance(i);
  Band band{grid.omega.back(), grid.omega.back()};
  for (std::size_t i = 0; i < grid.size(); ++i) {
    below += grid.variance(i);
    if (below > 0.005 * whole) band.low = std::min(band.low, grid.omega[i]);
    if (below > 0.995 * whole) {
      band.high = grid.omega[i];
      break;
    }
  }
  return band;
}

/// Filters of one order as points in an unbounded space: logarithms of the frequency and damping of each section's
/// poles; of the frequency and damping of its zeros; and of the two coefficients of the first section's numerator, b0^2
/// + b1^2 omega^2. Every point is a stable filter with a nonnegative density.
class Family {
 public:
  /// @param zeros  at zero frequency, of the density: 0, 2 or 4
  Family(int sections, int zeros) : sections_(sections), zeros_(zeros) {}

  int dimension() const { return 2 * sections_ + (zeros_ == 2 ? 1 : 2) + 2 * (sections_ - 1) - (zeros_ == 4 ? 2 : 0); }

  /// Logarithm of the density, and its slopes.
  double log_density(const Vector& p, double omega, Eigen::Ref<Vector> slopes) const {
    const double w2 = omega * omega;
    int at = 0;
    double log = 0;
    const auto factor = [&](double frequency, double damping, double sign, bool log_damping) {
      const double f2 = frequency * frequency, cross = 4 * damping * damping * f2 * w2,
                   whole = squared(w2 - f2) + cross + std::numeric_limits<double>::min();
      log += sign * std::log(whole);
      slopes[at++] = sign * (-4 * f2 * (w2 - f2) + 2 * cross) / whole;
      slopes[at++] = sign * (log_damping ? 2 * cross : 8 * damping * f2 * w2) / whole;
    };
    for (int j = 0; j < sections_; ++j) factor(std::exp(p[at]), std::exp(p[at + 1]), -1, true);
    if (zeros_ == 2) {
      log += p[at] + std::log(w2);
      slopes[at++] = 1;
    } else {
      const double b0 = std::exp(p[at]), b1 = std::exp(p[at + 1]) * w2, sum = b0 + b1;
      log += std::log(sum);
      slopes[at++] = b0 / sum;
      slopes[at++] = b1 / sum;
    }
    for (int j = 1; j < sections_ - (zeros_ == 4 ? 1 : 0); ++j) factor(std::exp(p[at]), p[at + 1], 1, false);
    if (zeros_ == 4) log += 2 * std::log(w2);
    return log;
  }

  std::vector<Section> sections(const Vector& p) const {
    std::vector<Section> all;
    for (int j = 0; j < sections_; ++j) {
      const double f = std::exp(p[2 * j]);
      all.push_back({1, 0, 0, 2 * std::exp(p[2 * j + 1]) * f, f * f});
    }
    int at = 2 * sections_;
    all[0].b2 = 0;
    if (zeros_ != 2) all[0].b0 = std::exp(p[at++] / 2);
    all[0].b1 = std::exp(p[at++] / 2);
    for (int j = 1; j < sections_ - (zeros_ == 4 ? 1 : 0); ++j, at += 2) {
      const double f = std::exp(p[at]);
      all[static_cast<std::size_t>(j)].b1 = 2 * std::abs(p[at + 1]) * f;
      all[static_cast<std::size_t>(j)].b0 = f * f;
    }
    return all;
  }

  /// Poles spread over the band; its zeros apart from those at zero frequency far above it.
  Vector start(const Band& band) const {
    Vector p(dimension());
    const double ratio = std::pow(band.high / band.low, 1.0 / sections_);
    int at = 0;
    for (int j = 0; j < sections_; ++j) {
      p[at++] = std::log(band.low) + (j + 0.5) * std::log(ratio);
      p[at++] = std::log(std::clamp((ratio - 1) / 2, 0.1, 0.7));
    }
    p[at++] = zeros_ == 2 ? 0 : std::log(band.low * band.high);
    if (zeros_ != 2) p[at++] = 0;
    for (int j = 1; j < sections_ - (zeros_ == 4 ? 1 : 0); ++j) {
      p[at++] = std::log(3 * band.high);
      p[at++] = 0.5;
    }
    return p;
  }

  /// A point of the family of one section more, with poles and zeros that nearly cancel.
  Vector extended(const Vector& p, double pole, double pole_damping, double zero, double zero_damping) const {
    const int poles = 2 * sections_;
    Vector q(p.size() + 4);
    q << p.head(poles), std::log(pole), std::log(pole_damping), p.tail(p.size() - poles), std::log(zero), zero_damping;
    return q;
  }

  /// Keeps poles near the band and oscillating or nearly so: others make the filter stiff and hardly improve the fit.
  void bound(Vector& p, const Band& band) const {
    for (int j = 0; j < sections_; ++j) {
      p[2 * j] = std::clamp(p[2 * j], std::log(band.low / 10), std::log(band.high * 10));
      p[2 * j + 1] = std::clamp(p[2 * j + 1], std::log(0.003), std::log(1.5));
    }
  }

  void add_gain(Vector& p, double log) const {
    p[2 * sections_] += log;
    if (zeros_ != 2) p[2 * sections_ + 1] += log;
  }

 private:
  int sections_, zeros_;
};

/// Least squares of sqrt(S) by Levenberg and Marquardt, from the point given; the cost found. Our own, because every
/// step is kept within the bounds of the family and of the band, which GSL's gsl_multifit_nlinear cannot do.
double improve(const Family& family, const Grid& grid, const Band& band, Vector& p) {
  const auto count = static_cast<Eigen::Index>(grid.size());
  const int n = family.dimension();
  const double unit = std::sqrt(*std::ranges::max_element(grid.density));
  Matrix jacobian(count, n);
  Vector residual(count), slopes(n);
  const auto evaluate = [&](const Vector& at, bool whole) {
    for (Eigen::Index i = 0; i < count; ++i) {
      const auto k = static_cast<std::size_t>(i);
      const double found = std::exp(family.log_density(at, grid.omega[k], slopes) / 2) / unit,
                   weight = std::sqrt(grid.weight[k]);
      residual[i] = weight * (found - std::sqrt(grid.density[k]) / unit);
      if (whole) jacobian.row(i) = (weight * found / 2) * slopes.transpose();
    }
    return residual.squaredNorm();
  };

  double log_found = 0, weights = 0;  // the gain, where the spectrum is strong
  for (std::size_t i = 0; i < grid.size(); ++i) {
    if (grid.density[i] < 0.1 * unit * unit) continue;
    log_found += grid.weight[i] * (std::log(grid.density[i]) - family.log_density(p, grid.omega[i], slopes));
    weights += grid.weight[i];
  }
  family.add_gain(p, log_found / weights);

  double cost = evaluate(p, true), damping = 1e-2;
  for (int i = 0; i < 200 && damping < 1e10; ++i) {
    const Matrix normal = jacobian.transpose() * jacobian;
    const Vector slope = jacobian.transpose() * residual;
    double better = cost;
    Vector next;
    for (; damping < 1e10; damping *= 4) {
      Matrix damped = normal;
      damped.diagonal() += damping * (normal.diagonal().array() + 1e-9 * normal.diagonal().maxCoeff()).matrix();
      const Vector step = damped.ldlt().solve(slope);
      next = p - step * std::min(1.0, 1.5 / step.cwiseAbs().maxCoeff());
      family.bound(next, band);
      better = evaluate(next, false);
      if (better < cost) break;
    }
    if (!(better < cost)) break;
    const bool done = better > cost * (1 - 1e-7);
    p = next;
    cost = evaluate(p, true);
    damping /= 6;
    if (done) break;
  }
  return cost;
}

ShapingFilter fitted(const std::function<double(double)>& spectrum, double low, double high,
                     std::span<const double> cuts, const ShapingFilter::Fit& fit) {
  require(fit.order >= 2 && fit.order <= 2 * max_sections && fit.order % 2 == 0,
          noun + ": order must be 2, 4, ... or 16", fit.order);
  require(fit.max_misfit > 0, noun + ": max_misfit must be above 0", fit.max_misfit);
  const int sections = fit.order / 2;
  std::vector<double> jumps;
  for (const double cut : cuts) {
    const double before = spectrum(cut * (1 - 1e-9)), after = spectrum(cut * (1 + 1e-9));
    if (std::abs(after - before) > 0.01 * std::max(before, after)) jumps.push_back(cut);
  }

  // First over all possible scales, then over those that matter.
  const double first = low > 0        ? low / 10
                       : cuts.empty() ? 1e-8
                                      : 1e-4 * cuts.front(),
               last = std::isfinite(high) ? high * 10
                      : cuts.empty()      ? 1e8
                                          : 1e4 * cuts.back();
  const Band band = band_of(Grid(spectrum, first, last, 200, jumps));
  Grid grid(spectrum, band.low / 30, band.high * 100, 50, jumps);
  for (std::size_t i = 0; i < grid.size(); ++i) grid.weight[i] *= 1 + grid.omega[i] / band.high;
  const double zero = band.low * 1e-4, at_zero = spectrum(zero), beyond = spectrum(2 * zero);
  const double slope = at_zero > 0 ? std::log2(beyond / at_zero) : beyond > 0 ? 2 : 4;
  const int zeros = slope > 3 && sections > 1 ? 4 : slope > 1 ? 2 : 0;

  // Adds one section at a time where it helps most: in the middle of the band or at its edges, smooth or with poles
  // just inside and zeros just outside.
  const double middle = std::sqrt(band.low * band.high);
  const std::array<std::array<double, 4>, 5> places = {{{middle, 0.4, 1.1 * middle, 0.5},
                                                        {band.low, 0.4, 1.1 * band.low, 0.5},
                                                        {band.high, 0.4, 1.1 * band.high, 0.5},
                                                        {1.03 * band.low, 0.05, 0.93 * band.low, 0.03},
                                                        {0.97 * band.high, 0.05, 1.07 * band.high, 0.03}}};
  int order = zeros == 4 ? 2 : 1;
  Vector best = Family(order, zeros).start(band);
  double least = improve(Family(order, zeros), grid, band, best);
  for (; order < sections && least > 1e-12; ++order) {
    const Vector fewer = best;
    const double before = least;
    for (const auto& [pole, pole_damping, zero_at, zero_damping] : places) {
      Vector p = Family(order, zeros).extended(fewer, pole, pole_damping, zero_at, zero_damping);
      const double cost = improve(Family(order + 1, zeros), grid, band, p);
      if (!(cost < least)) continue;
      least = cost;
      best = p;
    }
    if (least > 0.97 * before) {
      best = fewer;
      break;
    }
  }
  const Family family(order, zeros);

  double missed = 0, whole = 0;
  Vector slopes(family.dimension());
  const Grid wide(spectrum, band.low / 1000, band.high * 1000, 400, jumps);
  for (std::size_t i = 0; i < wide.size(); ++i) {
    const double found = std::exp(family.log_density(best, wide.omega[i], slopes));
    missed += std::abs(found - wide.density[i]) * wide.omega[i] * wide.weight[i];
    whole += wide.variance(i);
  }
  const double misfit = missed / whole;
  if (!(misfit <= fit.max_misfit))
    throw std::invalid_argument(noun + ": no filter of order " + std::to_string(fit.order) +
                                " fits the spectrum: the best misplaces " + shortest(std::round(1e3 * misfit) / 1e3) +
                                " of its variance, max_misfit is " + shortest(fit.max_misfit));
  return ShapingFilter(1, family.sections(best), misfit);
}

}  // namespace

ShapingFilter::ShapingFilter(double s0, std::vector<Section> sections, double misfit)
    : s0_(s0), sections_(std::move(sections)), misfit_(misfit) {
  require(std::isfinite(misfit) && misfit >= 0, noun + ": misfit must be finite and at least 0", misfit);
  require(std::isfinite(s0) && s0 > 0, noun + ": s0 must be positive and finite", s0, "m^2/s^3");
  require(sections_.size() <= max_sections, noun + ": must have at most 8 sections",
          static_cast<double>(sections_.size()));
  for (std::size_t i = 0; i < sections_.size(); ++i) {
    const Section& s = sections_[i];
    const std::string at = noun + ": section " + std::to_string(i);
    for (const auto& [name, value] : {std::pair{"b2", s.b2}, {"b1", s.b1}, {"b0", s.b0}})
      require(std::isfinite(value), at + ": " + name + " must be finite", value);
    require(s.b2 != 0 || s.b1 != 0 || s.b0 != 0, at + ": b2, b1 or b0 must differ from 0", 0);
    for (const auto& [name, value, unit] : {std::tuple{"d1", s.d1, "1/s"}, {"d0", s.d0, "1/s^2"}})
      require(std::isfinite(value) && value > 0, at + " is unstable: " + name + " must be positive and finite", value,
              unit);
  }
}

ShapingFilter ShapingFilter::of(const Spectrum& spectrum, const Fit& fit) {
  const Spectrum::Form& form = spectrum.form();
  if (const auto* s = std::get_if<Spectrum::White>(&form)) return ShapingFilter(s->s0);
  const auto layer = [](double frequency, double damping) {
    const double d1 = 2 * damping * frequency, d0 = frequency * frequency;
    return Section{0, d1, d0, d1, d0};
  };
  if (const auto* s = std::get_if<Spectrum::KanaiTajimi>(&form))
    return ShapingFilter(s->s0, {layer(s->frequency, s->damping)});
  if (const auto* s = std::get_if<Spectrum::CloughPenzien>(&form)) {
    const double f = s->filter_frequency;
    return ShapingFilter(s->s0, {layer(s->frequency, s->damping), {1, 0, 0, 2 * s->filter_damping * f, f * f}});
  }
  return fitted(spectrum, spectrum.low(), spectrum.high(), spectrum.breakpoints(), fit);
}

ShapingFilter ShapingFilter::of(const PoissonPulses& pulses, const Fit& fit) {
  // From far below the first lobe to far above: the half width is the only scale of the density.
  const double unit = 1 / pulses.half_width();
  return fitted([&](double omega) { return pulses.density(omega); }, 0, std::numeric_limits<double>::infinity(),
                std::span(&unit, 1), fit);
}

double ShapingFilter::operator()(double omega) const noexcept {
  const double w2 = omega * omega;
  double density = s0_;
  for (const Section& s : sections_)
    density *= (squared(s.b0 - s.b2 * w2) + squared(s.b1) * w2) / (squared(s.d0 - w2) + squared(s.d1) * w2);
  return density;
}

}  // namespace stickslip::theory
