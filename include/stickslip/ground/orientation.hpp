// Orientation of a component of a ground motion, as stated in record files.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "stickslip/base/requirements.hpp"

namespace stickslip {

/// The azimuth of an orientation [degrees clockwise from north], from 0 up to but not including 360.
/// @param orientation  an azimuth such as "332", "332 deg" or "N28W"; N, E, S, W or north, east, south, west, in upper
///                     or lower case. Any other text has no azimuth
std::optional<double> azimuth_of(std::string_view orientation);

/// 1 for an upward orientation (up, vertical, U, Z ...), -1 for a downward one (down, D ...), otherwise 0.
int upward(std::string_view orientation);

/// The text for an azimuth, such as "332".
/// @param azimuth  [degrees], finite; taken modulo 360
std::string orientation_at(double azimuth);

}  // namespace stickslip
