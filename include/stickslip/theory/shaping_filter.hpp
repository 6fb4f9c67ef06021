// A linear filter that shapes white noise into a ground acceleration with a given spectrum.
#pragma once

#include <vector>

#include "stickslip/base/requirements.hpp"
#include "stickslip/excitation/poisson.hpp"
#include "stickslip/excitation/spectrum.hpp"

namespace stickslip::theory {

/// White noise of the two-sided level s0 through second-order sections in series:
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

  /// How `of` fits a filter to a spectrum for which no exact filter is known.
  struct Fit {
    int order = 8;             ///< maximum number of states, two per section: 2, 4, ... 16
    double max_misfit = 0.25;  ///< largest accepted `misfit()`, above 0
    bool operator==(const Fit&) const = default;
  };

  /// @param s0        level of the white noise [m^2/s^3], positive and finite
  /// @param sections  in any order, at most 8
  /// @param misfit    relative to the spectrum that it represents, finite and at least 0, see `misfit()`
  /// @throws std::invalid_argument naming the section and the value; also for an unstable section
  explicit ShapingFilter(double s0, std::vector<Section> sections = {}, double misfit = 0);

  /// The filter of a spectrum. White noise, Kanai-Tajimi and Clough-Penzien have one, of 0, 2 and 4 states, exactly.
  /// For any other spectrum, a filter of the given order is fitted with as many zeros at zero frequency as the spectrum
  /// has, up to four. It minimizes the integral of (sqrt(S) - sqrt(S_filter))^2 over the logarithm of omega, and has
  /// fewer states if more do not improve the fit.
  /// @throws std::invalid_argument for an order or a misfit out of range, and if the misfit exceeds
  ///         `fit.max_misfit`, with the misfit
  /// Cost: 1 us; a fit of order 8 takes 50 to 200 ms.
  static ShapingFilter of(const Spectrum& spectrum, const Fit& fit);
  static ShapingFilter of(const Spectrum& spectrum) { return of(spectrum, Fit{}); }

  /// The filter fitted to the spectral density of Poisson pulses, `PoissonPulses::density`.
  static ShapingFilter of(const PoissonPulses& pulses, const Fit& fit);
  static ShapingFilter of(const PoissonPulses& pulses) { return of(pulses, Fit{}); }

  double s0() const noexcept { return s0_; }
  const std::vector<Section>& sections() const noexcept { return sections_; }

  /// Number of states.
  int order() const noexcept { return 2 * static_cast<int>(sections_.size()); }

  /// Misfit: the integral of |S - S_filter| over the integral of S; 0 for an exact filter.
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
