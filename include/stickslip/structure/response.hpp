// The response of a structure with one sliding interface to a ground motion.
#pragma once

#include <vector>

#include "stickslip/sliding/response.hpp"
#include "stickslip/state/state.hpp"
#include "stickslip/structure/matrix.hpp"

namespace stickslip {

/// Everything on which the future motion of a structure with one sliding interface depends.
struct StructureState {
  double displacement = 0;                   ///< x of the sliding interface [m]
  double velocity = 0;                       ///< x' [m/s]; 0 if stuck, else never opposite to the mode
  Mode mode = Mode::stuck;                   ///< of the interface; the structure moves while it is stuck, too
  double sliding_distance = 0;               ///< so far [m]; updated only if the law depends on it
  std::vector<double> modal_displacement{};  ///< in the modes of Structure::modes [m kg^(1/2); with from_modes m]
  std::vector<double> modal_velocity{};      ///< their rates
  SurfaceHeat heat{};         ///< left in the sliding surface; updated only if the law depends on its temperature
  PendulumMemory pendulum{};  ///< where the elements of a MultiPendulum are
};

/// The motion of the floors of a structure. Rows are samples; columns are floors, the lowest first. Peaks are taken
/// over all time, not only at samples.
struct Floors {
  RealMatrix displacement;  ///< relative to the base (of an EquipmentOnFloor: to the ground) [m]
  RealMatrix acceleration;  ///< absolute [m/s^2]
  RealMatrix drift;         ///< of each floor relative to the one below [m]; empty if `influence` is not ones
  RealMatrix shear;         ///< sum of the inertia forces of a floor and those above it [N]; with from_modes, per
                            ///< total mass; empty where it is unknown
  std::vector<double> peak_acceleration, peak_drift, peak_shear;
};

/// The motion of a structure with one sliding interface under one ground motion. `displacement` to `energy` are those
/// of the interface; energies are those of the whole system, per reference mass, and the work of the dampers of the
/// structure is part of `energy.damped`. `state` is that of the interface alone.
struct StructureResponse : Response {
  Floors floors;                          ///< empty if the structure has no shapes
  RealMatrix modal_displacement;          ///< at the samples, one column per mode; as in StructureState
  RealMatrix modal_velocity;              ///< at the samples
  std::vector<double> base_acceleration;  ///< absolute, of what the structure stands on, at the samples [m/s^2]
  std::vector<double> interface_demand;   ///< force that the bond would have to carry, per reference mass [m/s^2]
  /// Force of friction, spring and damper between both sides of the interface, per reference mass, at the samples
  /// [m/s^2]; positive where it pulls toward negative x. At a sample at which it jumps, the value after the jump.
  std::vector<double> interface_force;
  double soil_strain = 0;             ///< effective, of an equivalent-linear FlexibleSlope
  double peak_base_acceleration = 0;  ///< over all time [m/s^2]
  double peak_base_shear = 0;         ///< largest sum of the inertia forces of the structure; unit as Floors::shear
  /// Smallest difference between the demand and a static level when the velocity became zero, per reference mass
  /// [m/s^2]; infinite if that never happened. If it is tiny, the response depends on round-off.
  double margin = 0;
  /// With `settle`, whether the interface is known to stick forever: |demand| cannot reach a level again.
  bool settled = false;
  StructureState initial_state;
  StructureState final_state;
};

}  // namespace stickslip
