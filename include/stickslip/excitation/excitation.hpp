// What a random source of ground motions is.
#pragma once

#include <concepts>
#include <cstdint>
#include <string>

#include "stickslip/ground/ground_motion.hpp"

namespace stickslip {

/// A random source of ground motions: (seed, member) always names the same one. All motions begin at the same time and
/// last `duration()` [s]; `configuration()` tells all that they depend on, so that only what belongs together is
/// merged. It must be safe to call concurrently.
template <class E>
concept Excitation = requires(const E& excitation, std::uint64_t number) {
  { excitation.sample(number, number) } -> std::same_as<GroundMotion>;
  { excitation.duration() } -> std::convertible_to<double>;
  { excitation.configuration() } -> std::convertible_to<std::string>;
};

}  // namespace stickslip
