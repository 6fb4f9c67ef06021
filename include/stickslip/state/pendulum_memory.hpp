// What a pendulum with several surfaces remembers of its motion.
#pragma once

#include <array>
#include <cstdint>

#include "stickslip/base/requirements.hpp"

namespace stickslip {

/// The elements of a MultiPendulum at one time. By default all of them are at their centers, where they were installed.
struct PendulumMemory {
  static constexpr int most_elements = 8;

  /// u_k / R_k of each element, or u_k of a flat one [m].
  std::array<double, most_elements> place{};
  double force = 0;           ///< F/N in the direction of the last motion
  std::int8_t direction = 0;  ///< of the last motion, +1 or -1; 0 before the first
  std::uint8_t moving = 0;    ///< the elements that took part in it, one bit each; 0: all of them are at their stops
  std::uint8_t at_forward = 0, at_backward = 0;  ///< those at their stops in either direction

  friend bool operator==(const PendulumMemory&, const PendulumMemory&) = default;
};

}  // namespace stickslip
