#include "stickslip/theory/white_noise.hpp"

#include <gsl/gsl_sf_bessel.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <cstddef>
#include <limits>
#include <numbers>
#include <string>
#include <utility>

#include "stickslip/base/error.hpp"
#include "theory/isotropic_noise.hpp"
#include "theory/laplace_inversion.hpp"
#include "theory/theory_moments.hpp"

namespace stickslip::theory {
namespace {

using std::numbers::pi;
using Complex = std::complex<double>;

/// One side of rest, in the units in which D and the time are 1. The transform of the density is B exp(-k |v|).
struct Side {
  Side(double level, Complex z) {
    if (std::isinf(level)) return;
    root = level > 1 ? level * std::sqrt(1.0 + 4.0 * (z / level) / level) : std::sqrt(level * level + 4.0 * z);
    length = 2.0 / (level + root);
    inverse_root = 1.0 / root;
    // 1 / root less 1 / level, which nearly cancel at late times
    if (level > 0) late = -4.0 * (z / level) / (root * (level + root));
  }

  Complex root = 0;          // 2 k - a
  Complex length = 0;        // 1 / k
  Complex inverse_root = 0;  // 1 / (2 k - a)
  Complex late = 0;
};

struct Units {
  double velocity, forward, backward;  // sqrt(D t), and levels of friction per sqrt(D / t)

  Units(const Coulomb& law, double s0, double time)
      : velocity(std::sqrt(pi * s0) * std::sqrt(time)),
        forward(level(law.forward(), s0, time)),
        backward(level(law.backward(), s0, time)) {}

  static double level(double a, double s0, double time) { return a / std::sqrt(pi * s0) * std::sqrt(time); }
};

struct FromRest {
  double velocity_mean, velocity_square, displacement_mean, covariance, displacement_variance;
};

// With levels a and b, transforms p = B exp(-k v) of the density, and g = (c2 v^2 + c1 v + c0) exp(-k v) of E[y; v], y
// = x - m t, solve
//     z p = (sgn(v) a p)' + p'' + delta(v),   z g = (sgn(v) a g)' + g'' + (v - m) p
// with p and g and their fluxes continuous at v = 0. m is the late drift, so that E[y^2] is not the small difference of
// two squares; early on it is nothing.
FromRest from_rest(double a, double b) {
  const bool late = a > 1 && b > 1;
  const double drift = late ? 1 / a - 1 / b : 0;
  const auto f = detail::inverted<5>([&](Complex z) {
    const Side up(a, z), down(b, z);
    const Complex B = 1.0 / (z * (up.length + down.length));
    const Complex excess = late ? up.late - down.late : up.inverse_root - down.inverse_root;  // less the drift
    const Complex c0 = B * B * (up.inverse_root + down.inverse_root) * excess;
    Complex sum = 0, first = 0;  // of g and of v g
    for (const auto& [side, sign] : {std::pair{up, 1.0}, std::pair{down, -1.0}}) {
      const Complex k = side.length, r = side.inverse_root;
      const Complex c2 = sign * B * r / 2.0, c1 = B * r * (sign * r - drift);
      sum += k * (c0 + k * (c1 + 2.0 * k * c2));
      first += sign * (k * k) * (c0 + 2.0 * k * (c1 + 3.0 * k * c2));
    }
    const Complex p = up.length, q = down.length;
    return std::array<Complex, 5>{B * (p * p - q * q), 2.0 * B * (p * p * p + q * q * q), sum, first,
                                  2.0 * (first - drift * sum) / z};
  });
  return {f[0], f[1], drift + f[2], f[3] - f[2] * f[0], f[4] - f[2] * f[2]};
}

FromRest from_rest(const Units& units, int dimensions) {
  const detail::IsotropicFromRest f = detail::isotropic_from_rest(units.forward, dimensions);
  return {0, f.velocity_square, 0, f.covariance, f.displacement_variance};
}

/// Of v / (D / a), v >= 0, in d dimensions: the marginal of exp(-|v|).
double component_density(double v, int dimensions) {
  const double order = dimensions / 2.0;
  const double scale = 1 / (2 * std::sqrt(pi) * std::tgamma(order + 0.5));
  if (v < 1e-9) return scale * std::tgamma(order);
  if (v > 1e4) return 0;
  return scale * 2 * std::pow(v / 2, order) * std::exp(-v) * gsl_sf_bessel_Knu_scaled(order, v);
}

double equal_level(const Coulomb& law, const std::string& what) {
  if (law.forward() != law.backward())
    throw std::invalid_argument("WhiteNoise: " + what + " is known for equal levels only, got " +
                                detail::shortest(law.forward()) + " and " + detail::shortest(law.backward()) +
                                " m/s^2");
  return law.forward();
}

double stationary_level(const Coulomb& law, const std::string& what) {
  const double a = equal_level(law, what);
  detail::require(a > 0, "WhiteNoise: a level of 0 leaves no stationary velocity: slip_level must be positive", a,
                  "m/s^2");
  return a;
}

}  // namespace

WhiteNoise::WhiteNoise(const Coulomb& law, WhiteLevel s0, int dimensions)
    : law_(law), s0_(s0.s0()), dimensions_(dimensions) {
  detail::require(dimensions >= 1 && dimensions <= max_dimensions, "WhiteNoise: dimensions must be from 1 to 6",
                  dimensions);
  if (dimensions > 1 && law.forward() != law.backward())
    throw std::invalid_argument("WhiteNoise: in " + std::to_string(dimensions) +
                                " dimensions the levels must be equal, because friction opposes the velocity vector, "
                                "got " +
                                detail::shortest(law.forward()) + " and " + detail::shortest(law.backward()) +
                                " m/s^2");
  for (const double level : {law.forward(), law.backward()}) {
    const double velocity = pi * s0_ / level;
    if (level > 0 && std::isfinite(level))
      detail::require(
          std::isfinite(velocity) && velocity > 0,
          "WhiteNoise: pi s0 / slip_level exceeds the range of doubles: slip_level must be nearer to s0 = " +
              detail::shortest(s0_) + " m^2/s^3",
          level, "m/s^2");
  }
}

WhiteNoise::WhiteNoise(const Slider<Coulomb>& slider, WhiteLevel s0, int dimensions)
    : WhiteNoise(slider.law(), s0, dimensions) {
  detail::require_plain(slider, "WhiteNoise");
  detail::require(slider.natural_frequency() == 0,
                  "WhiteNoise: nothing exact is known with a spring: natural_frequency must be 0",
                  slider.natural_frequency(), "rad/s");
}

std::string WhiteNoise::name() const {
  return dimensions_ == 1 ? "WhiteNoise" : "WhiteNoise, " + std::to_string(dimensions_) + " dimensions";
}

double WhiteNoise::density(double velocity) const {
  if (std::isnan(velocity)) return velocity;
  if (dimensions_ > 1) {
    const double scale = law_.forward() / (pi * s0_);
    return scale == 0 ? 0 : scale * component_density(std::abs(velocity) * scale, dimensions_);
  }
  const double d = pi * s0_, level = velocity < 0 ? law_.backward() : law_.forward();
  if (velocity < 0 && std::isinf(level)) return 0;
  const double peak = 1 / (d / law_.forward() + d / law_.backward());
  return peak == 0 ? 0 : peak * std::exp(-std::abs(velocity) * (level / d));
}

double WhiteNoise::speed_density(double speed) const {
  if (std::isnan(speed)) return speed;
  if (speed < 0) return 0;
  if (dimensions_ == 1) return density(speed) + (speed > 0 ? density(-speed) : density(0));
  const double scale = law_.forward() / (pi * s0_), u = speed * scale;
  if (scale == 0 || std::isinf(u)) return 0;
  double power = scale * std::exp(-u);
  for (int j = 1; j < dimensions_; ++j) power *= u / j;
  return power;
}

double WhiteNoise::transition_density(double velocity, double time, double start) const {
  detail::require(dimensions_ == 1, "WhiteNoise: the transition density is known in one dimension only: dimensions",
                  dimensions_);
  equal_level(law_, "the transition density");
  detail::require(std::isfinite(velocity), "WhiteNoise: velocity must be finite", velocity, "m/s");
  detail::require(std::isfinite(time) && time > 0, "WhiteNoise: time must be positive and finite", time, "s");
  detail::require(std::isfinite(start), "WhiteNoise: start must be finite", start, "m/s");
  const Units units(law_, s0_, time);
  detail::check_range("WhiteNoise", time, units.forward);
  if (start < 0) velocity = -velocity;
  const double y = std::abs(velocity) / units.velocity, y0 = std::abs(start) / units.velocity, level = units.forward;
  const double ahead = (y + y0 - level) / 2, decay = std::exp(-level * y);
  const double distance = (y - y0 + level) / 2;
  const double travelled = velocity >= 0 ? std::exp(-distance * distance) : decay * std::exp(-ahead * ahead);
  const double pi_root = std::sqrt(pi);
  return (travelled / (2 * pi_root) + level / 4 * decay * std::erfc(ahead)) / units.velocity;
}

double WhiteNoise::mean() const {
  return law_.forward() == law_.backward() ? 0 : pi * s0_ / law_.forward() - pi * s0_ / law_.backward();
}

double WhiteNoise::mean_speed() const {
  const double up = pi * s0_ / law_.forward(), down = pi * s0_ / law_.backward();
  if (dimensions_ > 1) return dimensions_ * up;
  return std::isinf(up) || std::isinf(down) ? std::numeric_limits<double>::infinity()
                                            : up * (up / (up + down)) + down * (down / (up + down));
}

double WhiteNoise::variance() const {
  const double up = pi * s0_ / law_.forward(), down = pi * s0_ / law_.backward();
  return dimensions_ > 1 ? (dimensions_ + 1) * up * up : up * up + down * down;
}

double WhiteNoise::growth_rate() const {
  const double d = pi * s0_, up = d / law_.forward(), down = d / law_.backward(), up2 = up * up, down2 = down * down;
  if (dimensions_ > 1) return (dimensions_ + 1) * (2 * dimensions_ + 3) * up2 * (up2 / d);
  const double both =
      down > 0 ? up * down : 0;  // a block that never slides in one direction has no such term, whatever its velocity
  return 2 * (up2 * (2 * up2 / d) + both * (both / d) + down2 * (2 * down2 / d));
}

double WhiteNoise::relaxation_rate() const {
  const double level = std::min(law_.forward(), law_.backward()), n = dimensions_;
  return n / (n + 1) * (level / (n + 1)) * (level / (pi * s0_));
}

double WhiteNoise::velocity_autocovariance(double lag) const {
  const double a = stationary_level(law_, "the velocity's autocovariance"), d = pi * s0_;
  if (std::isnan(lag)) return lag;
  const double time = std::abs(lag) * (a / d) * a;
  if (time == 0) return variance();
  // Relative to the variance it is exp(-time / 4) or less, which is nothing here
  if (time > 1e5) return 0;
  return d / a * (d / a) * detail::isotropic_autocovariance(time, dimensions_);
}

double WhiteNoise::velocity_spectrum(double omega) const {
  const double a = stationary_level(law_, "the velocity's spectrum"), d = pi * s0_;
  const double up = d / a;
  if (dimensions_ > 1)
    return std::isnan(omega) ? omega
                             : up * up * (up / a) * detail::isotropic_spectrum(std::abs(omega) * (up / a), dimensions_);
  const Complex k = (1.0 + std::sqrt(Complex(1, 4 * omega * up / a))) / 2.0, inverse = 1.0 / k;
  const Complex shape = inverse * inverse * (2.0 + inverse * (2.0 + inverse));
  return up * up * (up / a) * (shape.real() / pi);
}

double WhiteNoise::absolute_moment(int order, double time) const {
  detail::require(order >= 1 && order <= 8, "WhiteNoise: order must be from 1 to 8", order);
  detail::require(std::isfinite(time) && time >= 0, "WhiteNoise: time must be finite and at least 0", time, "s");
  if (time == 0) return 0;
  const Units units(law_, s0_, time);
  const double relative = dimensions_ > 1 ? detail::isotropic_moment(units.forward, order, dimensions_)
                                          : detail::inverted<1>([&](Complex z) {
                                              const Complex up = Side(units.forward, z).length,
                                                            down = Side(units.backward, z).length;
                                              Complex p = up, q = down;
                                              for (int i = 1; i <= order; ++i) {
                                                p *= double(i) * up;
                                                q *= double(i) * down;
                                              }
                                              return std::array<Complex, 1>{(p + q) / (z * (up + down))};
                                            })[0];
  const double moment = relative * std::pow(units.velocity, order);
  detail::check_range("WhiteNoise", time, moment);
  return moment;
}

Moments WhiteNoise::predict(std::span<const double> times) const {
  detail::check_times("WhiteNoise", times);
  Moments moments = detail::moments_at(times);
  for (std::size_t i = 0; i < times.size(); ++i) {
    if (times[i] == 0) continue;
    const Units units(law_, s0_, times[i]);
    const FromRest f = dimensions_ == 1 ? from_rest(units.forward, units.backward) : from_rest(units, dimensions_);
    const double v = units.velocity, x = v * times[i];
    const bool even = law_.forward() == law_.backward();
    moments.velocity_mean.value[i] = even ? 0 : v * f.velocity_mean;
    moments.displacement_mean.value[i] = even ? 0 : x * f.displacement_mean;
    moments.velocity_variance.value[i] = v * (v * (f.velocity_square - f.velocity_mean * f.velocity_mean));
    moments.covariance.value[i] = x * (v * f.covariance);
    moments.displacement_variance.value[i] = x * (x * f.displacement_variance);
    for (const Estimates* moment : {&moments.displacement_mean, &moments.displacement_variance, &moments.covariance,
                                    &moments.velocity_mean, &moments.velocity_variance})
      detail::check_range("WhiteNoise", times[i], moment->value[i]);
  }
  if (law_.forward() > 0 && law_.backward() > 0) moments.growth_rate.value = growth_rate();
  return moments;
}

}  // namespace stickslip::theory
