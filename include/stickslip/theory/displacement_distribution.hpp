// The distribution of a displacement that is the sum of slips.
#pragma once

#include <array>
#include <complex>
#include <cstddef>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "stickslip/base/requirements.hpp"

namespace stickslip::detail {

/// An expected number of slips whose length is uniformly distributed between two bounds.
struct SlipPiece {
  double from, to;  ///< bounds in either order, [m]
  double count;     ///< expected number of slips
};

/// All expected slips, with count and moments that are more accurate than those of the pieces.
struct Slips {
  std::vector<SlipPiece> pieces{};
  double count = 0;                ///< expected number of slips
  double moments[4] = {};          ///< sum of their first to fourth powers, expected [m] to [m^4]
  double least = 0, greatest = 0;  ///< bounds that x exceeds with a probability below 1e-13 each [m]
};

/// The distribution of a displacement at some of its values.
struct DisplacementTable {
  std::vector<double> displacement{};  ///< ascending, 0 among them [m]; it lies beyond the ends with no probability
  std::vector<double> below{};         ///< the probability of at most each, without that of 0
  std::vector<double> error{};         ///< of each
  double atom = 0, atom_error = 0;     ///< the probability of 0
};

/// Slips of gamma-distributed lengths: in each direction the density is proportional to |d|^(k-1) exp(-|d| / theta),
/// with a common k and one theta per direction.
/// @param count    expected number, at least 0
/// @param moments  sums of their powers, expected [m] to [m^4]: four equations for k, both theta and the fraction of
///                 slips in each direction. A fourth moment below the minimum for that count is replaced by the minimum
/// @throws std::invalid_argument where the kurtosis is below that by more than 0.1
Slips gamma_slips(double count, const std::array<double, 4>& moments);

}  // namespace stickslip::detail

namespace stickslip::theory {

/// The distribution of the displacement x that is the sum of independent slips d_k, of Poisson's number: a compound
/// Poisson law. With nu(d) the expected number of slips per length,
///
///     E[exp(iux)] = exp(int (exp(iud) - 1) nu(d) dd),      cumulants kappa_n = int d^n nu(d) dd
///
/// This is the program that the thesis outlines at the end of 5.3: moments, characteristic function, density. There
/// is an atom at x = 0, the probability exp(-int nu) that nothing slips; the rest has a density. Made by
/// `PulseSuperposition::distribution` from what single pulses do; `PulseChain::distribution` fits slips of
/// gamma-distributed lengths to four cumulants and the atom. `TransportPrediction::displacement` carries the law itself,
/// by values, with an error of each.
///
/// Of slips the density is the Fourier transform of the characteristic function less the atom, by FFT over `nodes`
/// points of a window beyond which x lies with a probability below 2e-13. The slips are laid on that grid with their
/// number and mean kept. Atom and cumulants are accurate to 1e-12; the tabulated variance is up to 2e-4 too large for
/// up to 1e5 slips expected, which moves probabilities by some 3e-5; quantiles are to that and to one step of the grid.
/// Slips of vanishing length are frequent: near x = 0 the density may grow as x^-1/2, and there it is a mean over a
/// step.
///
/// Reference: thesis 5.3, (5.21) to (5.28); W. Feller, An Introduction to Probability Theory and Its Applications,
/// vol. 2 (1971), XVII.2; P. Embrechts and M. Frei, Math. Methods Oper. Res. 69 (2009), 497-508 (by FFT).
class DisplacementDistribution {
 public:
  static constexpr std::size_t nodes = std::size_t{1} << 17;

  /// `quantile` rejects probabilities closer to 0 or 1: the FFT leaves an error of 1e-13.
  static constexpr double min_probability = 1e-9;

  /// @param remark  the remark of the theory
  explicit DisplacementDistribution(const detail::Slips& slips, std::string remark = {});

  /// A law by a table, between whose values it is interpolated by monotone cubics (Steffen).
  explicit DisplacementDistribution(detail::DisplacementTable table, std::string remark = {});

  /// A bound on the numerical error of all probabilities; 0 if they have only the errors stated above.
  double error() const noexcept;

  /// The same of `cdf(x)`, which is smaller in the tails.
  /// @throws std::invalid_argument for NaN
  double error_at(double x) const;

  /// What the theory says of parameters outside its range of validity; empty within it.
  const std::string& remark() const noexcept { return remark_; }

  /// The probability that nothing slips: the probability of exactly x = 0. And a bound on its numerical error.
  double atom() const noexcept { return atom_; }
  double atom_error() const noexcept { return table_.atom_error; }

  /// Expected number of slips, if they are independent, -ln(`atom()`): infinite for a law without an atom.
  double slips() const noexcept { return count_; }

  double mean() const noexcept { return cumulants_[0]; }      ///< [m]
  double variance() const noexcept { return cumulants_[1]; }  ///< [m^2]
  double skewness() const noexcept;                           ///< kappa_3 / kappa_2^(3/2); NaN where nothing ever slips
  double kurtosis() const noexcept;  ///< 3 + kappa_4 / kappa_2^2, 3 of a Gaussian law; NaN where nothing ever slips

  /// Displacements at which the density is tabulated, ascending and evenly spaced [m]; empty where nothing ever slips.
  std::span<const double> displacement() const noexcept { return displacement_; }

  /// Density of the part without the atom [1/m]; its integral is 1 - `atom()`.
  std::span<const double> density() const noexcept { return density_; }

  /// The probability that the displacement is at most x [m].
  /// @throws std::invalid_argument for NaN
  double cdf(double x) const;

  /// The smallest displacement that x does not exceed with the given probability [m]; exactly 0 within the atom.
  /// @param probability  at least 1e-9 and at most 1 - 1e-9
  /// @throws std::invalid_argument naming the value
  double quantile(double probability) const;

  /// The characteristic function E[exp(iux)], from the tabulated law: its logarithm is accurate to a
  /// relative 2e-4 where u is of the order of 1 / std. Takes 2 ms.
  /// @param u  [1/m], finite
  /// @throws std::invalid_argument naming the value
  std::complex<double> characteristic(double u) const;

 private:
  double smooth_cdf(double x) const;

  std::string remark_;
  double atom_ = 1, count_ = 0;
  detail::DisplacementTable table_{};  ///< empty of slips
  double cumulants_[4] = {};
  double step_ = 0;
  std::vector<double> displacement_{}, density_{};
  std::vector<double> below_{};  ///< mass without the atom below the left edge of each node's cell, and all of it
};

}  // namespace stickslip::theory
