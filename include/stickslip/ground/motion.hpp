// Any ground motion.
#pragma once

#include <concepts>

#include "stickslip/ground/ground_motion.hpp"
#include "stickslip/ground/harmonic_motion.hpp"

namespace stickslip {

/// A ground motion: straight segments between samples, or one harmonic.
template <class M>
concept Motion = std::same_as<M, GroundMotion> || std::same_as<M, HarmonicMotion>;

}  // namespace stickslip
