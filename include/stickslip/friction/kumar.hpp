// Friction of sliding isolators that depends on pressure, speed and temperature.
#pragma once

#include <cmath>
#include <limits>
#include <numbers>
#include <tuple>

#include "stickslip/base/equal.hpp"
#include "stickslip/base/error.hpp"
#include "stickslip/base/min_max.hpp"
#include "stickslip/base/parts.hpp"
#include "stickslip/base/units.hpp"
#include "stickslip/friction/law.hpp"
#include "stickslip/series/series.hpp"
#include "stickslip/state/state.hpp"

namespace stickslip {

/// Friction of a PTFE-type liner on stainless steel:
///     mu = mu_ref kp kv kT,
///     kp = 0.7^(0.02 (p - p0)),            p and p0 in MPa
///     kv = 1 - 0.5 exp(-rate |v|),
///     kT = 0.79 (0.7^(0.02 T) + 0.40),     T in degrees Celsius
/// p = static_pressure N/g is the pressure under the normal force N per unit mass. Friction at rest is limited by the
/// resistance at zero speed. T is the temperature at the middle of the sliding surface, which friction heats while the
/// slider covers it,
///     T = T0 + sqrt(D) / (k sqrt(pi)) times the integral of q(t - tau) / sqrt(tau) over tau > 0,
///     q = mu p |v| while |x| < contact_radius sqrt(pi/4), else 0
///
/// Source: M. Kumar, A. S. Whittaker, M. C. Constantinou, Characterizing friction in sliding isolation bearings,
/// Earthquake Engineering & Structural Dynamics 44 (2015), 1409-1425.
class KumarFriction {
 public:
  static constexpr bool symmetric = true;

  struct Parameters {
    double mu_ref = 0;              ///< mu at high speed, p = p0 and 20 degrees Celsius [1], from 0 to 1e300
    double static_pressure = 0;     ///< p where N = g [Pa], positive and finite
    double reference_pressure = 0;  ///< p0 [Pa], positive and finite
    double contact_radius = 0;      ///< of the slider [m], positive; infinite if it always covers the middle
    double temperature = 20;        ///< T0 [degrees Celsius], from -100 to 400
    double rate = 100;              ///< [s/m], finite and at least 0
    double diffusivity = 4.44e-6;   ///< D, of the steel [m^2/s], positive and finite
    double conductivity = 18;       ///< k, of the steel [W/(m K)], positive; infinite for a surface that stays cold

    static constexpr auto parts() {
      constexpr Range positive = Range::above(0);
      return std::tuple(
          Part{"mu_ref", &Parameters::mu_ref, "mu_ref", "", Range::between(0, 1e300)},
          Part{"static_pressure", &Parameters::static_pressure, "static_pressure", "Pa", positive},
          Part{"reference_pressure", &Parameters::reference_pressure, "p0", "Pa", positive},
          Part{"contact_radius", &Parameters::contact_radius, "contact_radius", "m", positive.or_infinite()},
          Part{"temperature", &Parameters::temperature, "T0", "degrees Celsius", Range::between(-100, 400)},
          Part{"rate", &Parameters::rate, "rate", "s/m", Range::at_least(0)},
          Part{"diffusivity", &Parameters::diffusivity, "D", "m^2/s", positive},
          Part{"conductivity", &Parameters::conductivity, "k", "W/(m K)", positive.or_infinite()});
    }
    friend bool operator==(const Parameters&, const Parameters&) = default;
  };

  /// The law at one temperature and normal force.
  class Now {
   public:
    static constexpr bool numeric = true;

    double resist(double, double speed, Direction) const noexcept {
      return law_->level(speed, weight_, half_integral_);
    }

   private:
    friend class KumarFriction;
    Now(const KumarFriction& law, double weight, double half_integral) noexcept
        : law_(&law), weight_(weight), half_integral_(half_integral) {}

    const KumarFriction* law_;
    double weight_, half_integral_;
  };

  /// @throws std::invalid_argument naming the value
  explicit KumarFriction(const Parameters& parameters) : parameters_(parameters) {
    const Parameters& p = parameters_;
    detail::check_parts(p, class_name);
    detail::require(p.static_pressure < 1e9 && p.reference_pressure < 1e9,
                    "KumarFriction: pressures are in Pa and must be below 1e9 Pa",
                    std::max(p.static_pressure, p.reference_pressure), "Pa");
    warming_ = std::sqrt(p.diffusivity) * std::numbers::inv_sqrtpi / p.conductivity;
    edge_ = p.contact_radius * std::sqrt(std::numbers::pi / 4);
    static_scale_ = scale(1);
  }

  const Parameters& parameters() const noexcept { return parameters_; }

  static constexpr bool isotropic() noexcept { return true; }

  static constexpr const char* class_name = "KumarFriction";
  static constexpr auto parts() { return std::tuple(Part{"parameters", &KumarFriction::parameters}); }

  /// Resistance under a normal force of `weight` times g, divided by `weight` [m/s^2]. `half_integral` is H, the
  /// half-integral of the heat [W s^(1/2)/m^2].
  double level(double speed, double weight, double half_integral) const noexcept {
    return level_at_high_speed(weight, half_integral) * (1 - 0.5 * std::exp(-parameters_.rate * speed));
  }

  /// The factors of `level`: that of the speed, for numbers and series, and those of normal force and heat [m/s^2].
  template <class Speed>
  auto speed_factor(const Speed& speed) const {
    return decaying(-parameters_.rate * speed, 0.5, 1.0);
  }
  double level_at_high_speed(double weight, double half_integral) const noexcept {
    const double celsius = parameters_.temperature + warming_ * half_integral;
    return (detail::equal(weight, 1) ? static_scale_ : scale(weight)) * (power_of_seven_tenths(0.02 * celsius) + 0.40);
  }
  /// Largest |r| at which a slider in the plane covers the middle of the surface [m].
  double edge() const noexcept { return edge_; }

  /// Temperature T of the surface [degrees Celsius].
  double temperature(const State& state) const noexcept {
    return parameters_.temperature + warming_ * state.heat.half_integral();
  }
  /// Half-integral of the heat at a temperature [W s^(1/2)/m^2].
  double half_integral_at(double temperature) const noexcept {
    return warming_ > 0 ? (temperature - parameters_.temperature) / warming_ : 0;
  }

  Now at(const State& state, double weight = 1) const noexcept { return {*this, weight, state.heat.half_integral()}; }

  /// Heat flux into the middle of the surface, divided by the speed and the friction force per unit mass [kg/m^2].
  double heating(const State& state, Direction direction) const noexcept {
    const double place = sign(direction) * state.displacement;
    return place >= -edge_ && place < edge_ ? parameters_.static_pressure / standard_gravity : 0;
  }

  /// Distance to the next position at which the slider begins or ceases to cover the middle of the surface [m].
  double ahead(const State& state, Direction direction) const noexcept {
    const double place = sign(direction) * state.displacement;
    return place < -edge_ ? -edge_ - place : place < edge_ ? edge_ - place : std::numeric_limits<double>::infinity();
  }
  void pass(State& state, Direction direction) const noexcept {
    const double place = sign(direction) * state.displacement;
    state.sliding_distance += ahead(state, direction);
    state.displacement = sign(direction) * (place < -edge_ ? -edge_ : edge_);
  }

 private:
  // g mu_ref kp times the constant factor of kT [m/s^2].
  double scale(double weight) const noexcept {
    const double pressure = (parameters_.static_pressure * weight - parameters_.reference_pressure) * 1e-6;
    return 0.79 * standard_gravity * parameters_.mu_ref * power_of_seven_tenths(0.02 * pressure);
  }
  static double power_of_seven_tenths(double exponent) noexcept {
    return std::exp(-0.35667494393873237891 * exponent);  // ln 0.7
  }

  Parameters parameters_;
  double warming_;  // temperature rise of the surface per half-integral [K m^2 / (W s^(1/2))]
  double static_scale_;
  double edge_;  // |x| beyond which the slider does not cover the middle of the surface [m]
};

}  // namespace stickslip
