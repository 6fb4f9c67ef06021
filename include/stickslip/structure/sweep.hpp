// Sweeps of structures with one sliding interface.
#pragma once

#include <concepts>
#include <span>
#include <variant>
#include <vector>

#include "stickslip/ground/ground_motion.hpp"
#include "stickslip/structure/flexible_slope.hpp"
#include "stickslip/structure/sliding_structure.hpp"
#include "stickslip/sweep/sweep.hpp"

namespace stickslip {

/// A structure with one sliding interface: an IsolatedStructure, an EquipmentOnFloor, or a FlexibleSlope.
using AnySlidingStructure = std::variant<SlidingStructure, FlexibleSlope>;

namespace detail {
SweepTable sweep_structures(const std::vector<AnySlidingStructure>& structures,
                            std::span<const GroundMotion* const> motions, const SweepOptions& options);
}

/// Integrate many structures under many ground motions, from rest, each combination as by `integrate`, to 1e-12 of the
/// largest displacement, with stops to 1e-9.
///
/// @param structures  FlexibleSlopes, SlidingStructures or each an AnySlidingStructure
/// @param motions     records, of any lengths and steps
/// @param options     polarity, whether to continue until the interfaces have settled, threads. `contact` does not
///                    matter: where N < 0 an interface slides without friction
/// @return x of the interface: peak, residual, sliding distance, number of events and impacts on stops. A combination
///         that fails (a column of equivalent-linear soil that does not converge, an interface that does not settle) is
///         NaN, and `failures` has the reason; the sweep continues
/// @throws std::invalid_argument  a slope with a value out of range
///
/// While its interface is stuck, a structure moves as if it could not slide, except for the decay of what slips have
/// left. Structures that differ in the interface alone (its friction, spring, damper and stops; of slopes `ky_g`) share
/// that motion, computed once per record with bounds of the demand in each segment and in blocks of 32: only slips, and
/// segments in which the demand may exceed the friction, are integrated one by one. This needs even steps and classical
/// damping, and equipment without mass; elsewhere all segments are integrated. The bits are the same for any number of
/// threads.
template <class Sliding>
requires std::constructible_from<AnySlidingStructure, const Sliding&> SweepTable
sweep(const std::vector<Sliding>& structures, const std::vector<const GroundMotion*>& motions,
      const SweepOptions& options = {}) {
  return detail::sweep_structures(std::vector<AnySlidingStructure>(structures.begin(), structures.end()), motions,
                                  options);
}
template <class Sliding>
requires std::constructible_from<AnySlidingStructure, const Sliding&> SweepTable
sweep(const std::vector<Sliding>& structures, const std::vector<GroundMotion>& motions,
      const SweepOptions& options = {}) {
  std::vector<const GroundMotion*> these;
  for (const GroundMotion& motion : motions) these.push_back(&motion);
  return sweep(structures, these, options);
}

}  // namespace stickslip
