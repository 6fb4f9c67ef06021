// The lattices of times and amplitudes of the synchronized-arrival chain, and the excitation on them.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <span>
#include <vector>

namespace stickslip::detail::pulse_chain {

// The unit of acceleration is the slip level, the smaller of two; the unit of time is the step of the pulse.

/// A pulse of equal steps.
struct Steps {
  std::vector<int> values{};  ///< of the steps, as multiples of the unit
  double unit = 1;            ///< of those multiples, as a part of the pulse's amplitude
};

/// Of a lattice of amplitudes on which the slip level is a node, `parts` to sigma or more.
double lattice_spacing(double sigma, double parts);

/// The spacing of a lattice with at least `parts` nodes to sigma, of which the level 1 is a node, and the other level
/// as nearly as possible.
double lattice_spacing(double sigma, double parts, double other);

/// Lagrange's weights of the nodes at x[0..3] for the value at `at`.
std::array<double, 4> lagrange(const double* x, double at);

/// Weights of the nodes -reach..reach, `spacing` apart.
struct Weights {
  double spacing;
  int reach;
  std::vector<double> w;

  double& operator[](int i) { return w[static_cast<std::size_t>(i + reach)]; }
  double operator[](int i) const { return w[static_cast<std::size_t>(i + reach)]; }
};

/// Sums of `count` Gaussian amplitudes, normalized on the lattice.
Weights gaussian(double sigma, double spacing, int reach, int count);

using Quantile = std::function<void(std::span<double>)>;

/// The amplitudes in the middle of intervals of equal probability.
std::vector<double> amplitudes(const Quantile& quantile);

/// Whether the distribution of the amplitudes is symmetric.
bool symmetric(const std::vector<double>& amplitudes);

/// The excitation as the chain sees it.
struct Arrivals {
  double rate;   ///< pulses to a step
  double sigma;  ///< rms amplitude
  Quantile quantile{};
  bool mirrored = true;  ///< amplitudes are as likely as their mirror images
  double fourth = 3;     ///< mean of the fourth power of the amplitudes, over sigma^4

  Weights single(double spacing, int reach) const;

  /// Sums of as many as arrive at a node of the lattice.
  Weights batch(double slot, double spacing, int reach) const;
};

/// The strength of the acceleration relative to the slip level.
inline double strength_of(const Arrivals& arrivals) {
  return arrivals.sigma * std::sqrt(std::max(1.0, arrivals.rate / 2));
}

}  // namespace stickslip::detail::pulse_chain
