// The concept of a random source of ground motions.
#pragma once

#include <concepts>
#include <cstdint>
#include <string>

#include "stickslip/ground/ground_motion.hpp"

namespace stickslip {

/// A random source of ground motions: the same (seed, member) always gives the same motion. All motions begin at the
/// same time and last `duration()` [s]. `configuration()` contains everything that they depend on, so that only
/// ensembles under the same excitation are merged. It must be safe to call concurrently.
template <class E>
concept Excitation = requires(const E& excitation, std::uint64_t number) {
  { excitation.sample(number, number) } -> std::same_as<GroundMotion>;
  { excitation.duration() } -> std::convertible_to<double>;
  { excitation.configuration() } -> std::convertible_to<std::string>;
};

}  // namespace stickslip
