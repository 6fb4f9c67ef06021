// The motions of the floors of a structure, as ground motions for what stands on them.
#pragma once

#include <optional>
#include <vector>

#include "stickslip/ground/ground_motion.hpp"
#include "stickslip/structure/structure.hpp"

namespace stickslip {

/// The absolute accelerations of the floors of a structure, from rest, that stands on the ground and does not feel what
/// is on it: ground motions for many light sliders, all of which share one response of the structure. They are named
/// after the motion and the floor, "... floor 1" the lowest; a vertical component is that of the ground.
///
/// They are exact to round-off at the samples. Between them a slider sees straight lines, an EquipmentOnFloor without
/// mass sees the exact motion: the difference falls with the square of the step, 1 / parts. They end with the ground
/// motion.
///
/// The transverse component shakes the structure in its other direction; the two directions are not coupled by torsion.
/// @param structure  with floors: `from_modes` needs shapes
/// @param transverse  the structure in the transverse direction, with as many floors; the same one if not given
/// @param parts      equal parts of each segment, at least 1: the result has that many times more samples
/// @return one motion per floor, the lowest first
/// @throws std::invalid_argument  a structure without floors, parts below 1, another number of floors, or a transverse
///                                structure without such a component
/// @throws std::overflow_error    accelerations above 1e100 m/s^2
std::vector<GroundMotion> floor_motions(const Structure& structure, const GroundMotion& motion, int parts = 1,
                                        const std::optional<Structure>& transverse = {});

}  // namespace stickslip
