// What the files of the C interface share: how a call ends, and how C keeps numbers.
#pragma once

#include <cmath>
#include <stdexcept>
#include <string>

#include "stickslip/base/error.hpp"
#include "stickslip/base/vector2.hpp"
#include "stickslip/stickslip.h"

namespace stickslip::detail {

/// Stores the message of the current exception and returns its status.
int c_failure() noexcept;

/// Calls `work` and returns its status.
template <class Work>
int c_status_of(Work&& work) noexcept {
  try {
    work();
    return STICKSLIP_OK;
  } catch (...) {
    return c_failure();
  }
}

[[noreturn, gnu::noinline]] inline void refuse_null(const char* name) {
  throw std::invalid_argument(std::string("stickslip: ") + name + " must not be null");
}
inline void require_pointer(const void* pointer, const char* name) {
  if (pointer == nullptr) refuse_null(name);
}

inline Vector2 vector(const double (&components)[2]) noexcept { return {components[0], components[1]}; }
inline void store(Vector2 v, double (&components)[2]) noexcept { components[0] = v.axis, components[1] = v.transverse; }

/// A whole number of a state, which C keeps as a double.
/// @param name  of the struct and its member, for the message
template <class Whole>
Whole whole(double value, int least, int most, const char* name) {
  if (!(value >= least && value <= most && std::nearbyint(value) == value)) [[unlikely]]
    refuse(std::string(name) + " must be a whole number from " + std::to_string(least) + " to " + std::to_string(most),
           value);
  return static_cast<Whole>(static_cast<int>(value));
}

}  // namespace stickslip::detail
