#include "stickslip/theory/pulse_response.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "stickslip/numerics/gauss_legendre.hpp"
#include "stickslip/numerics/root.hpp"

namespace stickslip::theory {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// (1 - exp(-x)) / x
double phi1(double x) { return x == 0 ? 1 : -std::expm1(-x) / x; }

/// (x - 1 + exp(-x)) / x^2
double phi2(double x) {
  if (x > 0.5) return (x + std::expm1(-x)) / (x * x);
  double sum = 0, term = 0.5;
  for (int k = 3; k < 18; ++k) {
    sum += term;
    term *= -x / k;
  }
  return sum;
}

/// Displacement and velocity at time t, all in units of b and dt; thesis (5.14), corrected (5.15).
std::pair<double, double> viscous(double z, double t) {
  if (t > 2) {
    const double decayed = phi1(z) * phi1(z) * std::exp(-z * (t - 2));
    return {-decayed, z * decayed};
  }
  double x = 0, v = 0;
  const auto step = [&](double from, double height) {
    const double s = t - from;
    if (s <= 0) return;
    v -= height * s * phi1(z * s);
    x -= height * s * s * phi2(z * s);
  };
  step(0, 1);
  step(1, -2);
  return {x, v};
}

/// Integral of the squared velocity from 0 to `window`, in units of b and dt. Each piece of the velocity is
/// c + d exp(-z s), s from 0 to `length`.
double viscous_square(double z, double window) {
  const auto piece = [&](double begin, double length) {  // within which nothing jumps
    if (length <= 0) return 0.0;
    const double v = begin == 0 ? 0 : viscous(z, 1).second, n = begin == 0 ? 1 : -1;
    // v(s) = v exp(-z s) - n s phi1(z s). With (1 - exp(-z s)) / z for s phi1: by Gauss-Legendre where z is small,
    // else in closed form.
    if (z > 1) {
      const double c = -n / z, d = v + n / z;
      return c * c * length + 2 * c * d * length * phi1(z * length) + d * d * length * phi1(2 * z * length);
    }
    return numerics::gauss_integral<10>(0, length, [&](double s) {
      const double at = v * std::exp(-z * s) - n * s * phi1(z * s);
      return at * at;
    });
  };
  double square = piece(0, std::min(window, 1.0)) + piece(1, std::min(window, 2.0) - 1);
  if (window > 2 && z > 0) {
    const double last = viscous(z, 2).second;
    square += last * last * (std::isinf(window) ? 1 / (2 * z) : (window - 2) * phi1(2 * z * (window - 2)));
  }
  return square;
}

void check(double b, double dt, const char* who) {
  detail::require(std::isfinite(b), std::string(who) + ": b must be finite", b, "m/s^2");
  detail::require(std::isfinite(dt) && dt > 0, std::string(who) + ": dt must be positive and finite", dt, "s");
}

}  // namespace

PulseResponse viscous_pulse_response(double damping, double b, double dt, std::span<const double> times) {
  detail::check_pulse(b, dt, times);
  detail::require(std::isfinite(damping) && damping >= 0,
                  "viscous_pulse_response: damping must be finite and at least 0", damping, "1/s");
  const double z = damping * dt;
  PulseResponse response;
  if (times.empty())
    response.time = {0, dt, 2 * dt};
  else
    response.time.assign(times.begin(), times.end());
  for (const double time : response.time) {
    const auto [x, v] = viscous(z, time / dt);
    response.displacement.push_back(b * dt * dt * x);
    response.velocity.push_back(b * dt * v);
  }
  const double turn = 1 + (z == 0 ? 1 : std::log1p(-std::expm1(-z)) / z);  // the one zero of the velocity
  response.offset = z == 0 ? -b * dt * dt : 0;
  response.peak = std::abs(b) * dt * dt * std::abs(viscous(z, turn).first);
  response.stop = b == 0 ? 0 : infinity;
  response.velocity_square = b * b * dt * dt * dt * viscous_square(z, infinity);
  return response;
}

double viscous_damping_for(double velocity_square, double b, double dt, double window) {
  check(b, dt, "viscous_damping_for");
  detail::require(b != 0, "viscous_damping_for: b must not be 0", b, "m/s^2");
  detail::require(window > 0, "viscous_damping_for: window must be above 0", window, "s");
  const double until = window / dt, square = velocity_square / (b * b * dt * dt * dt);
  const double most = viscous_square(0, until);
  detail::require(square > 0 && square < most,
                  "viscous_damping_for: velocity_square must lie between 0 and the " +
                      detail::shortest(most * b * b * dt * dt * dt) + " m^2/s of no damping",
                  velocity_square, "m^2/s");
  const auto below = [&](double z) { return viscous_square(z, until) <= square; };  // it falls as the damping rises
  double high = 1;
  while (!below(high)) high *= 2;
  return numerics::first_where(0, high, below) / dt;
}

}  // namespace stickslip::theory

namespace stickslip::detail {

void check_pulse(double b, double dt, std::span<const double> times) {
  theory::check(b, dt, "pulse_response");
  double before = 0;
  for (const double time : times) {
    require(std::isfinite(time) && time >= before, "pulse_response: times must be finite, at least 0 and ascending",
            time, "s");
    before = time;
  }
}

}  // namespace stickslip::detail
