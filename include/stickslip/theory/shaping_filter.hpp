// A linear filter that shapes white noise into a ground acceleration with a given spectrum.
#pragma once

#include <vector>

#include "stickslip/detail/requirements.hpp"
#include "stickslip/excitation/poisson.hpp"
#include "stickslip/excitation/spectrum.hpp"

namespace stickslip::theory {

/// White noise of level s0, two-sided, through sections of second order, one after the other:
///
///     n = H(d/dt) w,   H(s) = product of (b2 s^2 + b1 s + b0) / (s^2 + d1 s + d0),   S(omega) = s0 |H(i omega)|^2
///
/// Without a section it is white noise. Immutable.
class ShapingFilter {
 public:
  struct Section {
    double b2, b1, b0;  ///< numerator: a number, [1/s], [1/s^2]; not all zero
    double d1, d0;      ///< denominator [1/s], [1/s^2]; both positive, or the section is unstable
    bool operator==(const Section&) const = default;
  };

  /// What `of` fits to a spectrum that has no filter of its own.
  struct Fit {
    int order = 8;             ///< states of the filter at most, two a section: 2, 4, ... 16
    double max_misfit = 0.25;  ///< largest `misfit()` that is not refused, above 0
    bool operator==(const Fit&) const = default;
  };

  /// @param s0        level of the white noise [m^2/s^3], positive and finite
  /// @param sections  in any order, at most 8
  /// @param misfit    to a spectrum that it stands for, finite and at least 0, see `misfit()`
  /// @throws std::invalid_argument naming the section and the value, for an unstable section too
  explicit ShapingFilter(double s0, std::vector<Section> sections = {}, double misfit = 0);

  /// The filter of a spectrum. White noise, Kanai-Tajimi and Clough-Penzien have one, of 0, 2 and 4 states, exactly. To
  /// any other the best filter of the order asked for is fitted, with as many zeros at zero frequency as the spectrum
  /// has, up to four: it minimizes the integral of (sqrt(S) - sqrt(S_filter))^2 over the logarithm of omega, and has
  /// fewer states where the last ones do not help.
  /// @throws std::invalid_argument for an order or a misfit out of its range, and where the misfit exceeds
  ///         `fit.max_misfit`, with the misfit found
  /// Cost: 1 us; a fit of order 8 some 50 to 200 ms.
  static ShapingFilter of(const Spectrum& spectrum, const Fit& fit);
  static ShapingFilter of(const Spectrum& spectrum) { return of(spectrum, Fit{}); }

  /// The filter fitted to the spectral density of Poisson pulses, `PoissonPulses::density`.
  static ShapingFilter of(const PoissonPulses& pulses, const Fit& fit);
  static ShapingFilter of(const PoissonPulses& pulses) { return of(pulses, Fit{}); }

  double s0() const noexcept { return s0_; }
  const std::vector<Section>& sections() const noexcept { return sections_; }

  /// Number of states.
  int order() const noexcept { return 2 * static_cast<int>(sections_.size()); }

  /// By how much a fit misses its spectrum, integral of |S - S_filter| over integral of S; 0 where it is exact.
  double misfit() const noexcept { return misfit_; }

  /// Two-sided spectral density of the acceleration [m^2/s^3] at `omega` [rad/s].
  double operator()(double omega) const noexcept;

  friend bool operator==(const ShapingFilter&, const ShapingFilter&) = default;

 private:
  double s0_;
  std::vector<Section> sections_;
  double misfit_;
};

}  // namespace stickslip::theory
