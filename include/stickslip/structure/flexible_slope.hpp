// A flexible sliding mass, such as an earth dam or a slope in soil.
#pragma once

#include <optional>

#include "stickslip/friction/degrading.hpp"
#include "stickslip/ground/ground_motion.hpp"
#include "stickslip/structure/sliding_structure.hpp"

namespace stickslip {

/// Soil whose shear modulus and damping depend on the strain: a hyperbola with Masing's rule and the corrections of
/// Darendeli (2001),
///     G/Gmax = 1 / (1 + g/gr)
///     damping ratio = 0.62 (G/Gmax)^0.1 D_Masing + 0.01
///     D_Masing = (4/pi) (1 + gr/g) (1 - (gr/g) ln(1 + g/gr)) - 2/pi.
class HyperbolicSoil {
 public:
  /// @param reference_strain  gr, at which the modulus is half of Gmax; positive and finite
  explicit HyperbolicSoil(double reference_strain);

  double reference_strain() const noexcept { return reference_strain_; }
  double modulus_ratio(double strain) const;  ///< G/Gmax at a strain of at least 0
  double damping_ratio(double strain) const;  ///< at a strain of at least 0

 private:
  double reference_strain_;
};

/// Sliding of a flexible mass, as in coupled and decoupled sliding-block analysis.
enum class SlopeMethod {
  coupled,   ///< sliding changes the motion of the mass
  decoupled  ///< the mass moves as if it did not slide; its base shear drives a rigid block
};

/// A uniform shear column of height H and shear-wave velocity Vs on an inclined surface, which slides downhill only. It
/// has the modes
///     w_j = (2 j - 1) pi Vs / (2 H),   gamma_j = 8 / ((2 j - 1)^2 pi^2),
/// of which the first `modes` move and the others ride with the base. On rock of shear-wave velocity Vr, radiation adds
/// min(0.55016 (Vr/Vs)^-0.9904, 0.20) to the damping ratio.
struct FlexibleSlope {
  static constexpr int most_modes = 1000;

  double ky_g = 0;                        ///< yield acceleration [g], finite and at least 0
  double height = 0;                      ///< H [m], positive and finite
  double shear_velocity = 0;              ///< Vs [m/s], at small strains; positive and finite
  double damping_ratio = 0;               ///< of each mode, finite and at least 0; with `soil`, it must be 0
  int modes = 1;                          ///< from 1 to `most_modes`
  std::optional<double> rock_velocity{};  ///< Vr [m/s]; rigid rock if not given
  std::optional<HyperbolicSoil> soil{};   ///< linear if not given
  SlopeMethod method = SlopeMethod::coupled;
  std::optional<Degrading> degrading{};  ///< instead of `ky_g`, a level that depends on the distance slid downhill
};

/// @throws std::invalid_argument  naming a value that is out of range
void check(const FlexibleSlope& slope);

/// The damping ratio that radiation into rock adds.
/// @param rock, soil  shear-wave velocities [m/s], positive and finite
double radiation_damping(double rock, double soil);

/// Shear-wave velocity and damping ratio of the column under a ground motion.
struct SlopeProperties {
  double shear_velocity;  ///< [m/s]
  double damping_ratio;   ///< with the part of radiation
  double strain = 0;      ///< effective, of an equivalent-linear column
  int iterations = 0;
};

/// The properties of a slope under a ground motion. Without `soil` they do not depend on it. With `soil`, the column
/// that does not slide has the effective strain g = 0.65 (pi/2) u_max / H, u_max the largest displacement of its top
/// relative to the base, over all time; velocity and damping are iterated, by secants within a bracket, until neither
/// changes by more than 1e-12 of itself. The radiation formula takes Vs at small strains.
/// @throws std::invalid_argument  naming the value
/// @throws ConvergenceError       no convergence within 200 iterations
SlopeProperties properties(const FlexibleSlope& slope, const GroundMotion& motion);

/// The column with given properties, on its sliding surface.
SlidingStructure sliding_structure(const FlexibleSlope& slope, const SlopeProperties& properties);

/// Integrate the sliding of a slope. Positive ground acceleration points downhill; x is positive downhill.
/// @throws as `properties` and as for a SlidingStructure
StructureResponse integrate(const FlexibleSlope& slope, const GroundMotion& motion,
                            const StructureIntegrateOptions& options = StructureIntegrateOptions::settled());

}  // namespace stickslip
