#include "theory/linear_friction.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <string>
#include <variant>

#include "stickslip/base/error.hpp"
#include "stickslip/numerics/root.hpp"
#include "stickslip/series/series.hpp"

namespace stickslip::detail {
namespace {

using std::numbers::pi;
using Force = theory::EquivalentLinearization::Force;

const double root_2_over_pi = std::sqrt(2 / pi);

// All expectations are integrals over x by the trapezoidal rule in u, x = scale sinh(u): its error falls as exp(-pi^2 /
// 2 h) where the integrand decays within |arg x| < pi/4 and has no pole there, as Gaussian densities, error functions
// and sech do. The scale is that of the narrowest factor; the wider ones cost a few nodes for each factor e.
constexpr double step = 0.125;  // 1e-17
constexpr double gaussian_end = 9;

struct Node {
  double x, weight;
};

const auto& sinh_nodes() {
  static const auto nodes = [] {
    std::array<Node, 400> all;
    for (std::size_t k = 0; k < all.size(); ++k) {
      const double u = step * static_cast<double>(k);
      all[k] = {std::sinh(u), step * std::cosh(u) * (k == 0 ? 1 : 2)};
    }
    return all;
  }();
  return nodes;
}

Friction caster(double slip_level, double reach, double displacement, double c, double s) {
  const double eta = displacement / reach;
  if (eta == 0) return {slip_level, 0};
  if (std::isinf(eta)) return {0, 0};
  s = std::max(s, 1e-8);  // what round-off leaves of it
  const double scale = std::min(s, 1 / eta), steepness = c / (s * std::numbers::sqrt2);
  double level = 0, pull = 0;
  for (const Node& node : sinh_nodes()) {
    const double x = scale * node.x, y = eta * x, narrow = x / s;
    if (x > gaussian_end || y > 42) break;
    const double less = std::expm1(-y), e = 1 + less, sech = 2 * e / (1 + e * e),
                 tanh = -less * (2 + less) / (1 + e * e);
    if (narrow < gaussian_end) level += node.weight * sech * std::exp(-narrow * narrow / 2);
    pull += node.weight * sech * tanh * std::erf(steepness * x) * std::exp(-x * x / 2);
  }
  const double density = scale / std::sqrt(2 * pi);
  return {slip_level * (density / s) * level, slip_level * eta * density * pull};
}

/// Any law, split into its even part, a level, and its odd part, a separate force.
struct Level {
  double even, odd;
};

using AnyLaw = std::function<double(double, Direction)>;

Level level(const AnyLaw& law, double x) {
  const double forward = law(x, Direction::forward), backward = law(x, Direction::backward);
  for (const double value : {forward, backward})
    require(std::isfinite(value) && value >= 0,
            "EquivalentLinearization: the slip level must be finite and at least 0; at " + shortest(x) + " m", value,
            "m/s^2");
  return {(forward + backward) / 2, (forward - backward) / 2};
}

class Quadrature {
 public:
  Quadrature(AnyLaw law, double farthest) : law_(std::move(law)) {
    // The scale is the distance at which the level first departs from that at rest.
    constexpr int places = 256;
    std::array<double, places> x, even;
    for (int i = 0; i < places; ++i) {
      const auto at = static_cast<std::size_t>(i);
      x[at] = i == 0 ? 0 : farthest * std::exp2((i - places + 1) / 4.0);
      const Level here = level(law_, x[at]), mirrored = level(law_, -x[at]);
      const double error = std::max(std::abs(here.even - mirrored.even), std::abs(here.odd + mirrored.odd));
      if (error > 1e-9 * (here.even + mirrored.even))
        throw std::invalid_argument(
            "EquivalentLinearization: covers laws that are the same both ways, level(x, forward) = level(-x, "
            "backward); got " +
            shortest(here.even + here.odd) + " and " + shortest(mirrored.even - mirrored.odd) +
            " m/s^2 at x = " + shortest(x[at]) + " m");
      even[at] = here.even;
    }
    largest_ = *std::ranges::max_element(even);
    const auto departs =
        std::ranges::find_if(even, [&](double value) { return std::abs(value - even[0]) > 0.2 * largest_; });
    if (departs != even.end()) scale_ = x[static_cast<std::size_t>(departs - even.begin())];
  }

  Friction operator()(double displacement, double c, double s) const {
    s = std::max(s, 1e-8);
    const double scale = std::min(s, scale_ / displacement);
    Sums sums;
    double h = 0.25;
    add(sums, displacement, c, s, scale, h, 0);
    Friction last = friction(sums, c, s, scale * h);
    for (int halving = 0; halving < 12; ++halving) {
      add(sums, displacement, c, s, scale, h, h / 2);
      h /= 2;
      const Friction now = friction(sums, c, s, scale * h);
      const double change = std::max(std::abs(now.level - last.level), std::abs(now.pull - last.pull));
      if (change <= 3e-8 * largest_) return now;  // the error is squared by each halving
      last = now;
    }
    throw ConvergenceError("EquivalentLinearization: the expectation of the slip level for a displacement of " +
                           shortest(displacement) + " m rms did not converge: the law must be analytic in x");
  }

 private:
  struct Sums {
    double level = 0, first = 0;  // E[level | x' = 0], E[level sgn(x') x]
  };

  void add(Sums& sums, double displacement, double c, double s, double scale, double h, double from) const {
    for (double u = from;; u += h) {
      const double x = scale * std::sinh(u), narrow = x / s;
      if (x > gaussian_end) break;
      const Level here = detail::level(law_, displacement * x);
      const double width = std::cosh(u) * (u == 0 ? 1 : 2);
      if (narrow < gaussian_end) sums.level += width * here.even * std::exp(-narrow * narrow / 2);
      const double whole = here.even * std::erf(c / (s * std::numbers::sqrt2) * x) + here.odd;
      sums.first += width * whole * x * std::exp(-x * x / 2);
    }
  }

  // [a21 a22] Q = -E[level sgn(x') [x x']], solved; the integral over x' is done.
  static Friction friction(const Sums& sums, double c, double s, double width) {
    const double density = width / std::sqrt(2 * pi), level = density / s * sums.level;
    return {level, root_2_over_pi * c * level - density * sums.first};
  }

  AnyLaw law_;
  double largest_ = 0;
  double scale_ = std::numeric_limits<double>::infinity();
};

Expectation without_a21(Expectation whole) {
  return [whole = std::move(whole)](double displacement, double c, double s) {
    return Friction{whole(displacement, c, s).level, 0};
  };
}

}  // namespace

double scaled_erfc(double z) {
  if (z < 8) return z * std::exp(z * z) * std::erfc(z);
  double sum = 1, term = 1;  // asymptotic: its terms decrease until 2 n = 2 z^2
  for (int n = 1; std::abs(term) > 1e-17; ++n) sum += term *= -(2 * n - 1) / (2 * z * z);
  return sum / std::sqrt(pi);
}

Expectation expectation(const LinearizedLaw& law, Force force, double farthest) {
  const bool a21 = force == Force::gaussian;
  if (force == Force::laplace && !std::holds_alternative<Coulomb>(law))
    throw std::invalid_argument("EquivalentLinearization: the Laplacian density is that of Coulomb friction");
  if (const auto* const coulomb = std::get_if<Coulomb>(&law)) {
    const double a = coulomb->forward();
    if (a != coulomb->backward())
      throw std::invalid_argument("EquivalentLinearization: covers laws that are the same both ways, got levels of " +
                                  shortest(a) + " and " + shortest(coulomb->backward()) + " m/s^2");
    // E[F x'] / q22 = a E|x'| / q22, and E|x'| is sqrt(q22 / 2) for a Laplacian density
    const double level = force == Force::laplace ? a * std::sqrt(pi) / 2 : a;
    return [level](double, double, double) { return Friction{level, 0}; };
  }
  if (const auto* const wheel = std::get_if<Caster>(&law)) {
    const double a = wheel->slip_level(), reach = wheel->reach();
    if (force == Force::thesis)
      return [a, reach](double displacement, double, double s) {  // thesis (3.29), (3.30)
        return Friction{a * std::sqrt(pi) * scaled_erfc(reach / (std::numbers::sqrt2 * displacement * s)), 0};
      };
    const Expectation whole = [a, reach](double displacement, double c, double s) {
      return caster(a, reach, displacement, c, s);
    };
    return a21 ? whole : without_a21(whole);
  }
  if (force == Force::thesis)
    throw std::invalid_argument("EquivalentLinearization: the thesis's force (3.28) is that of Coulomb and Caster");
  const Expectation whole = Quadrature(std::get<AnyLaw>(law), farthest);
  return a21 ? whole : without_a21(whole);
}

std::optional<double> far_level(const LinearizedLaw& law, double distance) {
  if (const auto* const wheel = std::get_if<Caster>(&law)) return std::isinf(wheel->reach()) ? wheel->slip_level() : 0;
  const auto* const any = std::get_if<AnyLaw>(&law);
  if (any == nullptr) return {};
  if (const auto* const rolls = any->target<LevelOf<Caster>>())
    return rolls->law.rolling() + (std::isinf(rolls->law.reach()) ? rolls->law.slip_level() : 0);
  const double level = (*any)(10 * distance, Direction::forward);
  if (!(std::abs((*any)(5 * distance, Direction::forward) - level) <= 1e-12 * level)) return {};
  return level;
}

namespace {

/// Constant levels under a Gaussian velocity of mean m and standard deviation s.
MeanFriction gaussian_average(double forward, double backward, double m, double s) {
  const double z = m / s;
  return {(forward - backward) / 2 + (forward + backward) / 2 * std::erf(z / std::numbers::sqrt2), 0,
          -(forward + backward) / s * std::exp(-z * z / 2) / std::sqrt(2 * pi)};
}

/// The same with the exact density under white noise, exp(-v / up) / (up + down) for v > 0 and exp(v / down) / (up +
/// down) for v < 0: m = up - down, s^2 = up^2 + down^2. If |m| > s, the density is one-sided.
MeanFriction laplace_average(double forward, double backward, double m, double s) {
  if (std::abs(m) >= s) return {m > 0 ? forward : -backward, 0, 0};
  const double root = std::sqrt(2 * s * s - m * m), up = (root + m) / 2, down = (root - m) / 2;
  return {(forward * up - backward * down) / root, 0, -(forward + backward) * (up / s) * (down / s) / root};
}

}  // namespace

AverageFriction::AverageFriction(const LinearizedLaw& law, Force force, double farthest)
    : laplace_(force == Force::laplace) {
  if (const auto* const coulomb = std::get_if<Coulomb>(&law)) {
    forward_ = coulomb->forward();
    backward_ = coulomb->backward();
    require(std::isfinite(backward_), "EquivalentLinearization: both slip levels must be finite; backward", backward_,
            "m/s^2");
    none_ = forward_ == 0 && backward_ == 0;
    return;
  }
  expectation_ = expectation(law, force, farthest);
  const auto* const wheel = std::get_if<Caster>(&law);
  forward_ = backward_ = wheel != nullptr ? wheel->slip_level() : std::get<AnyLaw>(law)(0, Direction::forward);
  none_ = wheel != nullptr && forward_ == 0;
}

double AverageFriction::threshold(bool spring) const {
  if (spring || !drifts()) return strength() * level();
  if (laplace_) return forward_ * (backward_ / std::hypot(forward_, backward_));
  const auto mean = [&](double z) { return gaussian_average(forward_, backward_, z, 1).mean; };
  const double z = numerics::root(mean, -40, mean(-40), 40, mean(40));
  return -gaussian_average(forward_, backward_, z, 1).a22;
}

MeanFriction AverageFriction::operator()(double velocity, double q11, double q12, double q22) const {
  const double s = std::sqrt(q22);
  if (!expectation_)
    return laplace_ ? laplace_average(forward_, backward_, velocity, s)
                    : gaussian_average(forward_, backward_, velocity, s);
  const double displacement = std::sqrt(q11);
  const double c = displacement > 0 ? std::clamp(q12 / displacement / s, -1.0, 1.0) : 0;
  const Friction friction = expectation_(displacement, c, std::sqrt((1 - c) * (1 + c)));
  return {0, displacement > 0 ? friction.pull / displacement : 0, -root_2_over_pi * friction.level / s};
}

}  // namespace stickslip::detail
