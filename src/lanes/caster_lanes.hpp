// Many casters in parallel, each over its own segment of a ground motion.
#pragma once

#include <cstddef>

#include "lanes/coulomb_lanes.hpp"
#include "stickslip/friction/caster.hpp"

namespace stickslip::detail {

/// A caster without a spring, and the length of a segment. `SeriesLanes` do the same for any law; series of fixed
/// order, in units that suit this one, take a quarter of their time.
struct CasterLanes {
  Caster law;
  double duration;  ///< of each segment [s]
};

/// Moves each caster over its segment of ground acceleration, from start[i] to end[i] [m/s^2]:
///     x'' + a sech(x/l) sgn(x') = -n(t)
/// by Taylor series in time of fixed order, in steps so short that what is left out is 1e-13 l as a rule and 2e-11 l at
/// worst (over a thousand segments 1e-10 of the displacement), with the same events as `advance`. Where the velocity's
/// polynomial has one change of sign in its Bernstein coefficients it has one zero, where it has none, none; else the
/// step is halved. The few that this does not settle go through `advance`.
/// @param members  at most `max_lanes`
void advance_lanes(const CasterLanes& slider, std::size_t members, const double* start, const double* end,
                   const LaneStates& states);

}  // namespace stickslip::detail
