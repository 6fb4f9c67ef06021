// Ground motions from two sources at common times.
#pragma once

#include <string>
#include <vector>

#include "stickslip/ground/ground_motion.hpp"

namespace stickslip::detail {

/// A motion with all its components, and the acceleration of another motion at the same times.
struct Joined {
  GroundMotion motion;
  std::vector<double> other;
};

/// Brings both to the times of both, if they differ; each component is as before between them.
/// @param who    the excitation, such as "WithVertical"
/// @param which  the component that `other` becomes, such as "vertical"
/// @throws std::invalid_argument  different interpolations or durations; an `other` of several components
Joined join(GroundMotion motion, const GroundMotion& other, const std::string& who, const std::string& which);

}  // namespace stickslip::detail
