// Where a component of a ground motion points, as files say it.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "stickslip/detail/requirements.hpp"

namespace stickslip {

/// The azimuth of an orientation [degrees clockwise from north], from 0 up to but not including 360.
/// @param orientation  an azimuth as "332", "332 deg" or "N28W"; N, E, S, W or north, east, south, west, in either
/// case.
///                     Nothing else has an azimuth
std::optional<double> azimuth_of(std::string_view orientation);

/// 1 for an orientation upward (up, vertical, U, Z ...), -1 for one downward (down, D ...), otherwise 0.
int upward(std::string_view orientation);

/// The orientation of an azimuth, as "332".
/// @param azimuth  [degrees], finite; taken modulo 360
std::string orientation_at(double azimuth);

}  // namespace stickslip
