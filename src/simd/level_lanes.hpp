// Coulomb blocks of many slip levels side by side, all under one ground motion.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "stickslip/ground/ground_motion.hpp"
#include "stickslip/state.hpp"

namespace stickslip::detail {

/// A ground motion of even steps, with the extremes of the ground acceleration in blocks of segments: what is stuck
/// skips a block that stays within its levels. Refers to the motion.
class LevelGround {
 public:
  static constexpr std::size_t block = 32;  ///< segments

  /// @pre motion.dt() is a number
  explicit LevelGround(const GroundMotion& motion);

  std::size_t segments() const noexcept { return segments_; }
  double duration() const noexcept { return duration_; }               ///< of a segment [s]
  bool held() const noexcept { return start_ == end_; }                ///< or it runs straight
  const double* start() const noexcept { return start_; }              ///< n at the beginning of each segment [m/s^2]
  const double* end() const noexcept { return end_; }                  ///< and at its end
  std::span<const double> lowest() const noexcept { return lowest_; }  ///< n in each block, and
  std::span<const double> highest() const noexcept { return highest_; }

 private:
  const double *start_, *end_;
  std::size_t segments_;
  double duration_;
  std::vector<double> lowest_, highest_;
};

/// A block on Coulomb friction, which starts from rest at 0. Unlike `Coulomb` it may be one that never slides forward,
/// which a block that never slides backward is under the flipped motion.
struct LevelLane {
  double forward, backward;  ///< slip levels [m/s^2], at least 0
  State state{};             ///< at the end
  double peak = 0;           ///< largest |x| at the events and at the end [m]
  double sliding_distance = 0;
  double slip_from = 0;  ///< x where the slip at hand began [m]
  std::size_t events = 0;
  std::string failure{};  ///< why it does not settle
};

/// Whether `slide_levels` takes a motion: with even steps, and accelerations and times whose products neither overflow
/// nor underflow.
bool has_level_lanes(const GroundMotion& motion) noexcept;
/// Whether it takes these levels.
inline bool has_level_lanes(double forward, double backward) noexcept {
  const auto usual = [](double level) { return level == 0 || (level > 1e-60 && level < 1e60); };
  return usual(std::min(forward, backward)) && (usual(std::max(forward, backward)) || std::isinf(forward + backward));
}

/// Moves all lanes through the motion, as `integrate` does each: thesis (4.51) to (4.53).
///
/// The lanes are taken as many at a time as a vector holds. Those next to each other should be alike: a vector that is
/// stuck in all lanes skips to the next segment that moves one of them; where each goes on as it was, sliding or stuck,
/// it is one step without a branch; those lanes that may have an event in a segment take the event loop
/// (sliding/advance.hpp).
///
/// @param settle  go on without ground acceleration until they rest; one that does not says so in `failure`
/// @pre has_level_lanes
void slide_levels(const LevelGround& ground, std::span<LevelLane> lanes, bool settle);

}  // namespace stickslip::detail
