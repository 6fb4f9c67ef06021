#include "stickslip/theory/stationary_velocity.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <type_traits>
#include <variant>

#include "stickslip/base/equal.hpp"
#include "stickslip/base/error.hpp"
#include "stickslip/friction/law.hpp"
#include "stickslip/numerics/gauss_legendre.hpp"

namespace stickslip::theory {
namespace {

constexpr std::size_t points = 10;

template <class Law>
constexpr bool covered = MemorylessLaw<Law>&& form_of<Law> != Form::numeric && !requires(const Law& law) {
  law.length_scale();
}
&&!requires(const Law& law) { law.sliding(); };

/// The speed over which friction changes; infinite if it does not.
double scale_of(const AnySlider& slider) {
  return std::visit(
      []<class Law>(const Slider<Law>& s) {
        if constexpr (requires { s.law().speed_scale(); })
          return static_cast<double>(s.law().speed_scale());
        else
          return std::numeric_limits<double>::infinity();
      },
      slider);
}

/// The resistance of friction and damper to sliding at a speed [m/s^2].
double resistance(const AnySlider& slider, double speed, Direction direction) {
  return std::visit(
      [&]<class Law>(const Slider<Law>& s) -> double {
        if constexpr (covered<Law>)
          return resist(s.law(), 0.0, speed, direction) + s.damping() * speed;
        else
          throw std::invalid_argument(
              "StationaryVelocity: covers friction that is constant or depends on the speed alone");
      },
      slider);
}

/// U / D at a speed, from that at a lower one.
double climb(const AnySlider& slider, Direction direction, double noise, double from, double at_from, double to) {
  double sum = at_from;
  numerics::gauss_points<points>(
      from, to, [&](double v, double weight) { sum += weight * resistance(slider, v, direction) / noise; });
  return sum;
}

}  // namespace

StationaryVelocity::StationaryVelocity(const AnySlider& slider, WhiteLevel s0) : slider_(slider), s0_(s0.s0()) {
  const double noise = std::numbers::pi * s0_, scale = scale_of(slider_);
  (void)resistance(slider_, 0, Direction::forward);  // refuses laws
  const Mounting& on = mounting_of(slider_);
  if (on.stiffness() > 0 || on.slope_degrees > 0 || std::isfinite(on.stops.forward()) ||
      std::isfinite(on.stops.backward()))
    throw std::invalid_argument(
        "StationaryVelocity: covers sliders on level ground, without a spring and without stops");
  constexpr double farthest = 90;  // in U / D: beyond lies a probability below 1e-38
  const auto lay = [&](Side& side, Direction direction) {
    double v = 0, u = 0;
    side = {{0}, {0}};
    if (direction == Direction::backward && (on.one_way || !std::isfinite(resistance(slider_, 0, direction)))) return;
    while (u < farthest) {
      const double here = resistance(slider_, v, direction);
      double width = std::min(scale / 8, here > 0 ? noise / here : std::numeric_limits<double>::infinity());
      if (on.damping > 0) width = std::min(width, std::sqrt(noise / on.damping) / 2);
      detail::require(std::isfinite(width) && side.speed.size() < 100'000,
                      "StationaryVelocity: friction must bound the velocity; the resistance at high speed", here,
                      "m/s^2");
      u = climb(slider_, direction, noise, v, u, v + width);
      side.speed.push_back(v += width);
      side.potential.push_back(u);
    }
  };
  lay(forward_, Direction::forward);
  lay(backward_, Direction::backward);

  // Calls `use(v, probability)` at the points of the panels of a side.
  const auto integrate = [&](const Side& side, Direction direction, const auto& use) {
    for (std::size_t i = 1; i < side.speed.size(); ++i)
      numerics::gauss_points<points>(side.speed[i - 1], side.speed[i], [&](double v, double weight) {
        use(v, weight * std::exp(-climb(slider_, direction, noise, side.speed[i - 1], side.potential[i - 1], v)));
      });
  };
  double first[2] = {}, second = 0;
  for (const Direction direction : {Direction::forward, Direction::backward}) {
    const bool ahead = direction == Direction::forward;
    integrate(ahead ? forward_ : backward_, direction, [&](double v, double part) {
      total_ += part;
      first[ahead ? 0 : 1] += part * v;
      second += part * v * v;
    });
  }
  mean_ = (first[0] - first[1]) / total_;
  mean_speed_ = (first[0] + first[1]) / total_;
  variance_ = second / total_ - mean_ * mean_;

  // G from the far end of each side on.
  const auto growth = [&](const Side& side, Direction direction) {
    const double m = direction == Direction::forward ? mean_ : -mean_;
    double sum = 0, beyond = 0;  // beyond: G at the upper edge, times the total
    for (std::size_t i = side.speed.size() - 1; i > 0; --i) {
      const double low = side.speed[i - 1], high = side.speed[i], at_low = side.potential[i - 1];
      const auto from = [&](double v, double u) {
        double g = beyond;
        numerics::gauss_points<points>(v, high, [&](double w, double weight) {
          g += weight * (w - m) * std::exp(-climb(slider_, direction, noise, v, u, w));
        });
        return g;
      };
      numerics::gauss_points<points>(low, high, [&](double v, double weight) {
        const double u = climb(slider_, direction, noise, low, at_low, v), g = from(v, u);
        sum += weight * g * g * std::exp(u);
      });
      beyond = from(low, at_low);
    }
    return sum;
  };
  growth_rate_ = 2 / noise * (growth(forward_, Direction::forward) + growth(backward_, Direction::backward)) / total_;
}

double StationaryVelocity::density(double velocity) const {
  if (std::isnan(velocity)) return velocity;
  const Direction direction = velocity < 0 ? Direction::backward : Direction::forward;
  const Side& side = velocity < 0 ? backward_ : forward_;
  const double speed = std::abs(velocity);
  const auto next = std::ranges::upper_bound(side.speed, speed);
  if (next == side.speed.end()) return 0;
  const auto i = static_cast<std::size_t>(next - side.speed.begin()) - 1;
  return std::exp(-climb(slider_, direction, std::numbers::pi * s0_, side.speed[i], side.potential[i], speed)) / total_;
}

}  // namespace stickslip::theory
