#include "stickslip/structure/flexible_slope.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "stickslip/base/error.hpp"
#include "stickslip/base/units.hpp"
#include "stickslip/friction/coulomb.hpp"
#include "stickslip/structure/isolated_structure.hpp"
#include "structure/modal_interface.hpp"
#include "structure/stuck_motion.hpp"

namespace stickslip {
namespace {

using std::numbers::pi;

Structure column(const FlexibleSlope& slope, const SlopeProperties& properties) {
  const auto modes = static_cast<std::size_t>(slope.modes);
  std::vector<double> fractions(modes), frequencies(modes);
  for (std::size_t j = 0; j < modes; ++j) {
    const double odd = 2 * static_cast<double>(j) + 1;
    fractions[j] = 8 / (odd * odd * pi * pi);
    frequencies[j] = odd * pi * properties.shear_velocity / (2 * slope.height);
  }
  // The top of the column moves by (4/pi) (-1)^j / (2 j + 1) times the mode.
  RealMatrix top(1, slope.modes);
  for (int j = 0; j < slope.modes; ++j) top(0, j) = (j % 2 == 0 ? 4 : -4) / (pi * (2 * j + 1));
  return Structure::from_modes(fractions, frequencies, std::vector(modes, properties.damping_ratio), top);
}

// Downhill only.
AnySlider at_level(double level) { return Slider<Coulomb>(Coulomb(level, std::numeric_limits<double>::infinity())); }

SlidingStructure on_surface(const FlexibleSlope& slope, const SlopeProperties& properties, const AnySlider& slider) {
  if (slope.method == SlopeMethod::coupled) return IsolatedStructure(slider, column(slope, properties));
  return DecoupledStructure(slider, column(slope, properties));
}

// The largest displacement of the top of a column that does not slide, over all time [m].
double largest_top_of(const FlexibleSlope& slope, const SlopeProperties& properties, const GroundMotion& motion) {
  const Structure structure = column(slope, properties);
  const Modes& modes = structure.modes();
  detail::ModalInterface of;
  of.stiffness = detail::view(modes.frequencies).cwiseAbs2();
  of.damping = detail::view(structure.modal_damping());
  of.load = detail::view(modes.participation);
  of.demand = of.reaction = of.jump = Eigen::VectorXd::Zero(slope.modes);
  of.shapes = detail::view(modes.shapes);
  of.fastest = std::max(std::ranges::max(modes.frequencies), of.damping.diagonal().maxCoeff());
  if (const auto largest = detail::largest_top(of, motion)) return *largest;
  const double never_reached = 1e100;
  return integrate(on_surface(slope, properties, at_level(never_reached)), motion).floors.peak_drift[0];
}

}  // namespace

void check(const FlexibleSlope& slope) {
  using detail::require;
  const auto positive = [](double value) { return std::isfinite(value) && value > 0; };
  require(std::isfinite(slope.ky_g) && slope.ky_g >= 0, "FlexibleSlope: ky_g must be finite and at least 0", slope.ky_g,
          "g");
  require(positive(slope.height), "FlexibleSlope: height must be positive and finite", slope.height, "m");
  require(positive(slope.shear_velocity), "FlexibleSlope: shear_velocity must be positive and finite",
          slope.shear_velocity, "m/s");
  require(std::isfinite(slope.damping_ratio) && slope.damping_ratio >= 0,
          "FlexibleSlope: damping_ratio must be finite and at least 0", slope.damping_ratio);
  require(slope.modes >= 1 && slope.modes <= FlexibleSlope::most_modes,
          "FlexibleSlope: modes must be from 1 to " + std::to_string(FlexibleSlope::most_modes), slope.modes);
  if (slope.rock_velocity)
    require(positive(*slope.rock_velocity), "FlexibleSlope: rock_velocity must be positive and finite",
            *slope.rock_velocity, "m/s");
  if (slope.degrading && slope.ky_g > 0)
    detail::refuse("FlexibleSlope: with a Degrading law, ky_g must be left out", slope.ky_g, "g");
  if (slope.soil && slope.damping_ratio > 0)
    detail::refuse("FlexibleSlope: with a soil, which has its own damping, damping_ratio must be left out",
                   slope.damping_ratio);
}

HyperbolicSoil::HyperbolicSoil(double reference_strain) : reference_strain_(reference_strain) {
  detail::require(std::isfinite(reference_strain) && reference_strain > 0,
                  "HyperbolicSoil: reference_strain must be positive and finite", reference_strain);
}

double HyperbolicSoil::modulus_ratio(double strain) const {
  detail::require(std::isfinite(strain) && strain >= 0, "HyperbolicSoil: strain must be finite and at least 0", strain);
  return 1 / (1 + strain / reference_strain_);
}

double HyperbolicSoil::damping_ratio(double strain) const {
  const double ratio = modulus_ratio(strain), g = strain / reference_strain_;
  // For small g the formula cancels: its series is (4/pi) (g/6 - g^2/12 + g^3/20 - ...).
  double masing = 0;
  if (g < 1e-2) {
    double power = 1, sum = 0;
    for (int k = 1; k <= 8; ++k) {
      power *= k == 1 ? g : -g;
      sum += power / ((k + 1.0) * (k + 2.0));
    }
    masing = 4 / pi * sum;
  } else {
    masing = 4 / pi * (1 + 1 / g) * (1 - std::log1p(g) / g) - 2 / pi;
  }
  return 0.62 * std::pow(ratio, 0.1) * masing + 0.01;
}

double radiation_damping(double rock, double soil) {
  for (const double velocity : {rock, soil})
    detail::require(std::isfinite(velocity) && velocity > 0,
                    "radiation_damping: velocities must be positive and finite", velocity, "m/s");
  return std::min(0.55016 * std::pow(rock / soil, -0.9904), 0.20);
}

SlopeProperties properties(const FlexibleSlope& slope, const GroundMotion& motion) {
  check(slope);
  const double radiates = slope.rock_velocity ? radiation_damping(*slope.rock_velocity, slope.shear_velocity) : 0;
  if (!slope.soil) return {slope.shear_velocity, slope.damping_ratio + radiates};
  const auto at = [&](double strain, int iterations) {
    return SlopeProperties{slope.shear_velocity * std::sqrt(slope.soil->modulus_ratio(strain)),
                           slope.soil->damping_ratio(strain) + radiates, strain, iterations};
  };
  const auto close = [](double a, double b) { return std::abs(a - b) <= 1e-12 * std::abs(b); };
  // The strain that a column of assumed strain has exceeds it at 0, and is below it at high strains. Secants find where
  // both are equal, also where the iteration by itself would swing; where they leave the bracket, it is halved.
  constexpr int most = 200;
  double low = 0, high = std::numeric_limits<double>::infinity();
  double last_strain = 0, last_excess = 0;
  SlopeProperties now = at(0, 0);
  for (int i = 1; i <= most; ++i) {
    const double found = 0.65 * pi / 2 * largest_top_of(slope, now, motion) / slope.height;
    const SlopeProperties next = at(found, i);
    if (close(now.shear_velocity, next.shear_velocity) && close(now.damping_ratio, next.damping_ratio)) return next;
    const double excess = found - now.strain;
    (excess > 0 ? low : high) = now.strain;
    double strain = found;
    if (i > 1) strain = now.strain - excess * (now.strain - last_strain) / (excess - last_excess);
    if (!(strain > low && strain < high)) strain = std::isfinite(high) ? low + (high - low) / 2 : found;
    last_strain = std::exchange(now, at(strain, i)).strain;
    last_excess = excess;
  }
  throw ConvergenceError("FlexibleSlope: the equivalent-linear column does not converge within " +
                         std::to_string(most) + " iterations, at an effective strain of " +
                         detail::shortest(now.strain));
}

SlidingStructure sliding_structure(const FlexibleSlope& slope, const SlopeProperties& properties) {
  check(slope);
  if (slope.degrading) return on_surface(slope, properties, Slider(*slope.degrading, Mounting{.one_way = true}));
  return on_surface(slope, properties, at_level(slope.ky_g * standard_gravity));
}

StructureResponse integrate(const FlexibleSlope& slope, const GroundMotion& motion,
                            const StructureIntegrateOptions& options) {
  const SlopeProperties found = properties(slope, motion);
  StructureResponse response = integrate(sliding_structure(slope, found), motion, options);
  response.soil_strain = found.strain;
  return response;
}

}  // namespace stickslip
