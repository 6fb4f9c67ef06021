// The motion of a structure with one sliding interface at any time, and the force of the interface.
#pragma once

#include <concepts>
#include <span>
#include <vector>

#include "stickslip/ground/ground_motion.hpp"
#include "stickslip/sliding/effective.hpp"
#include "stickslip/structure/response.hpp"
#include "stickslip/structure/sliding_structure.hpp"

namespace stickslip {

/// The states of a structure at any times of a response, also between its samples and while it settles.
///
/// @param system    the structure
/// @param motion    its ground motion
/// @param response  the result of `integrate` for them
/// @param times     in any order, from the start of the motion to the last event or sample of the response [s]
/// @return a state for each time, in their order; at an event, that after it
/// @throws std::invalid_argument  a time before the start or after the end
/// As exact as `integrate`. Cost: about that of `integrate`, and a step for each time.
std::vector<StructureState> states_at(const SlidingStructure& system, const GroundMotion& motion,
                                      const StructureResponse& response, std::span<const double> times);

/// A point of the motion of an interface.
struct InterfacePoint {
  double time;          ///< [s]
  double displacement;  ///< x [m]
  double force;         ///< as StructureResponse::interface_force [m/s^2]
};

/// Points that draw the loops of force over displacement with straight lines between them: two where the force jumps.
/// Cost: that of `integrate` without passing segments by one step.
std::vector<InterfacePoint> interface_loops(const SlidingStructure& system, const GroundMotion& motion,
                                            const StructureResponse& response);

/// Where the force of the interface is largest in magnitude over all time, not only at samples: friction, damper and
/// spring together, per reference mass. The first such point, where the force is constant.
/// Exact to round-off; its time to 1e-6 of a step. Cost: as `interface_loops`.
InterfacePoint peak_force(const SlidingStructure& system, const GroundMotion& motion,
                          const StructureResponse& response);

/// The hysteresis loop of the interface with the largest displacement, per reference mass: as the template of the same
/// name, with the damper of the interface and not those of the structure.
/// @throws std::invalid_argument  as that
/// Accuracy: that of `integrate`. Cost: as `interface_loops`.
Loop largest_loop(const SlidingStructure& system, const GroundMotion& motion, const StructureResponse& response);

/// The same of what derives from SlidingStructure, for which the templates of sliders would be as good.
template <std::derived_from<SlidingStructure> System>
std::vector<StructureState> states_at(const System& system, const GroundMotion& motion,
                                      const StructureResponse& response, std::span<const double> times) {
  return states_at(static_cast<const SlidingStructure&>(system), motion, response, times);
}
template <std::derived_from<SlidingStructure> System>
InterfacePoint peak_force(const System& system, const GroundMotion& motion, const StructureResponse& response) {
  return peak_force(static_cast<const SlidingStructure&>(system), motion, response);
}
template <std::derived_from<SlidingStructure> System>
Loop largest_loop(const System& system, const GroundMotion& motion, const StructureResponse& response) {
  return largest_loop(static_cast<const SlidingStructure&>(system), motion, response);
}

}  // namespace stickslip
