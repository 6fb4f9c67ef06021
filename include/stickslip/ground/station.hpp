// One ground motion from the components that a station recorded.
#pragma once

#include <span>
#include <string>

#include "stickslip/ground/records.hpp"

namespace stickslip {

/// The components of one station as one motion: along an azimuth, perpendicular to it and up.
///
/// Horizontal components are those whose orientation has an azimuth (`azimuth_of`); the motion along an azimuth a is
///
///     n(a) = (u sin(b2 - a) + w sin(a - b1)) / sin(b2 - b1)
///
/// with u recorded along b1 and w along b2; along b1 it is u itself. The transverse component is the motion along
/// a + 90 degrees, and the vertical one is positive upward.
///
/// @param components     one or two horizontal components and at most one vertical one, with the same time base
/// @param along          name or orientation of one of the horizontal components, or an azimuth [degrees]; empty: the
///                       first horizontal component
/// @param common_length  cut all components to the shortest; otherwise different lengths are rejected
/// @return  named after the first component, with the orientation of its axis
/// @throws std::invalid_argument  other components than these; a component without orientation; horizontal components
///                                more than 10 degrees from perpendicular; different time steps, starts or lengths
GroundMotion station_motion(std::span<const RecordComponent> components, const std::string& along = {},
                            bool common_length = false);

}  // namespace stickslip
