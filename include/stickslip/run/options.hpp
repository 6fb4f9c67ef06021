// How a motion starts and ends.
#pragma once

#include <cmath>
#include <functional>
#include <string>

#include "stickslip/base/error.hpp"
#include "stickslip/run/response.hpp"
#include "stickslip/state/surface_heat.hpp"

namespace stickslip {

/// @tparam Place  of a slider: a number on one axis, a Vector2 in the plane
template <class Place>
struct RunOptions {
  Place displacement{};  ///< at the start [m], finite
  Place velocity{};      ///< at the start [m/s], finite
  bool settle = false;   ///< continue under zero ground acceleration after the last sample until the slider rests
  Contact contact = Contact::flight;  ///< what the slider does while the ground falls away from under it
  std::function<void()> progress{};   ///< called about once per second or more often; may throw to stop the work
  double sliding_distance = 0;     ///< sliding distance before the start [m], finite and at least 0; used by laws that
                                   ///< depend on it
  SurfaceHeat heat{};              ///< of the sliding surface at the start; used by laws that depend on its temperature
  bool may_end_in_flight = false;  ///< whether a response without `settle` may end before the slider has landed
};

namespace detail {

inline void require_finite(double value, const std::string& name, const char* unit) {
  require(std::isfinite(value), "integrate: " + name + " must be finite", value, unit);
}
template <class Vector>
requires requires(const Vector& value) { value.transverse; }
void require_finite(const Vector& value, const std::string& name, const char* unit) {
  require_finite(value.axis, name, unit);
  require_finite(value.transverse, name, unit);
}

/// Throw unless a motion can start so.
template <class Options>
void check_start(const Options& options) {
  require_finite(options.displacement, "displacement", "m");
  require_finite(options.velocity, "velocity", "m/s");
  require(std::isfinite(options.sliding_distance) && options.sliding_distance >= 0,
          "integrate: sliding_distance must be finite and at least 0", options.sliding_distance, "m");
}

}  // namespace detail
}  // namespace stickslip
