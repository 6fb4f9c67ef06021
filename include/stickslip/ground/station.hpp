// One ground motion from the components that a station recorded.
#pragma once

#include <span>
#include <string>

#include "stickslip/ground/records.hpp"

namespace stickslip {

/// The components of one station as one motion: along an azimuth, across it and up.
///
/// Horizontal components are those whose orientation has an azimuth (`azimuth_of`); the motion along an azimuth a is
///
///     n(a) = (u sin(b2 - a) + w sin(a - b1)) / sin(b2 - b1)
///
/// of u recorded along b1 and w along b2, which is u itself along b1. The transverse component is that along a + 90
/// degrees, and the vertical one is positive upward.
///
/// @param components     one or two horizontal ones, and a vertical one or none, of one time base
/// @param along          one of the names or orientations of the horizontal components, or an azimuth [degrees]; empty:
///                       the first of them
/// @param common_length  cuts to the shortest component what is longer; otherwise different lengths are refused
/// @return  named as the first component, with the orientation along its axis
/// @throws std::invalid_argument  other components than those; one without orientation; horizontal ones that are more
///                                than 10 degrees from perpendicular; different time steps, starts or lengths
GroundMotion station_motion(std::span<const RecordComponent> components, const std::string& along = {},
                            bool common_length = false);

}  // namespace stickslip
