// The exact stationary velocity of a slider without a spring under white noise, for friction of any dependence on speed.
#pragma once

#include <vector>

#include "stickslip/sliding/any_slider.hpp"
#include "stickslip/theory/noise.hpp"

namespace stickslip::theory {

/// The stationary velocity under white noise of a slider whose friction depends on its speed alone, with or without a
/// damper. The velocity is a diffusion in a potential,
///
///     dv = -f(v) dt + sqrt(2 D) dW,   D = pi S0,   U' = f,   p(v) ~ exp(-U(v) / D),
///
/// where f is the resistance, with the sign of v. With the mean m, the displacement has a variance that grows at
///
///     R = (2 / D) int G(v)^2 / p(v) dv,   G(v) = int_v^inf (u - m) p(u) du.
///
/// For Coulomb friction these are the values of `WhiteNoise`, which has moments by time, too. Static friction above
/// kinetic has no effect under continuous white noise, which exceeds any friction at rest at once: give the kinetic law.
///
/// Accuracy: round-off, some 1e-13, by Gauss-Legendre quadrature on panels that resolve friction and density. Cost: some
/// milliseconds; 1 us for a density.
///
/// References: H. Risken, The Fokker-Planck Equation (1989), 5.2; dry and viscous friction: H. Touchette, T. Prellberg,
/// W. Just, J. Phys. A 45 (2012), 395002.
class StationaryVelocity {
 public:
  /// @param slider  a law whose friction is constant or depends on the speed alone, on level
  ///                ground, without spring and stops; a damper is optional. Backward sliding may be excluded
  /// @param s0      level S0 of the white ground acceleration, two-sided [m^2/s^3], positive and finite, or a white
  ///                Spectrum
  /// @throws std::invalid_argument  another slider; friction that does not bound the velocity
  StationaryVelocity(const AnySlider& slider, WhiteLevel s0);

  const AnySlider& slider() const noexcept { return slider_; }
  double s0() const noexcept { return s0_; }

  /// Probability density of the velocity [s/m]; NaN for NaN.
  double density(double velocity) const;

  double mean() const noexcept { return mean_; }                ///< the drift [m/s]
  double mean_speed() const noexcept { return mean_speed_; }    ///< of |v| [m/s]
  double variance() const noexcept { return variance_; }        ///< [m^2/s^2]
  double growth_rate() const noexcept { return growth_rate_; }  ///< of the variance of x [m^2/s]

 private:
  /// Panels in the speed to one side of rest, and U / D at their edges.
  struct Side {
    std::vector<double> speed{}, potential{};
  };

  AnySlider slider_;
  double s0_;
  Side forward_{}, backward_{};
  double total_ = 0;  // the integral of exp(-U / D)
  double mean_ = 0, mean_speed_ = 0, variance_ = 0, growth_rate_ = 0;
};

}  // namespace stickslip::theory
