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

/// Where the component points that a text names: the text itself if it is an orientation, otherwise the one it contains.
///
/// A title, the label of a column or a phrase contains an orientation as
///   - words: up, vertical, UD, N-S, north ..., also joined by underscores: `acc_z`, `Up-Down`, `Vertical component`;
///   - an azimuth with its unit or its quadrants: 230 deg, N28W;
///   - the code of a SEED channel, whose last letter is Z, N or E: HNZ, BHE00.
/// Remarks in brackets do not count: `180 (USGS STATION 117)` points to 180.
/// @return  empty if the text contains none, or two that differ
std::string orientation_in(std::string_view text);

/// The orientation in a file's name: letters at its end after a mark, as in `CPM-UP.txt`, `site_V.csv`, `KMM.UD`; empty
/// if there is none. Numbers in file names are rarely azimuths and do not count.
std::string orientation_in_file_name(std::string_view name);

/// The text for an azimuth, such as "332".
/// @param azimuth  [degrees], finite; taken modulo 360
std::string orientation_at(double azimuth);

}  // namespace stickslip
