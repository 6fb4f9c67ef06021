// Units that record files state.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace stickslip::records {

/// A unit of acceleration: its name and how many m/s^2 it is.
struct AccelerationUnit {
  std::string_view name;
  double value;
};

/// The unit of acceleration with that name, in any spelling.
std::optional<AccelerationUnit> find_acceleration_unit(std::string_view name);

/// The same.
/// @throws std::invalid_argument  unknown unit; lists the known ones
AccelerationUnit acceleration_unit_named(std::string_view name);

/// Seconds in a unit of time, if it is one.
std::optional<double> find_time_unit(std::string_view name);

/// The quantity that has this unit, if it is a known unit of something other than acceleration and time: "a velocity".
std::string quantity_with_unit(std::string_view name);

}  // namespace stickslip::records
