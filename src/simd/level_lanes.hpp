// Coulomb blocks of many slip levels side by side, all under one ground motion.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "stickslip/friction/coulomb.hpp"
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

/// A block on Coulomb friction, which starts from rest at 0.
struct LevelLane {
  Coulomb law;
  bool turned;                  ///< under the flipped motion
  State state{};                ///< at the end
  double peak = 0;              ///< largest |x| [m]
  double sliding_distance = 0;  ///< [m]
  double slip_from = 0;         ///< x where the slip at hand began [m]
  std::size_t events = 0;
  std::string failure{};  ///< why it does not settle
};

/// Whether `slide_levels` takes a motion: with even steps, and accelerations and times whose products neither overflow
/// nor underflow.
bool has_level_lanes(const GroundMotion& motion) noexcept;
/// The same of the levels.
bool has_level_lanes(const Coulomb& law) noexcept;

/// Moves all lanes through the motion, as `integrate` does each: thesis (4.51) to (4.53).
///
/// The lanes are taken as many at a time as a vector holds. Those next to each other should be alike: a vector that is
/// stuck in all lanes skips to the next segment that moves one of them; where each goes on as it was, sliding or stuck,
/// it is one step without a branch; a segment in which some may have an event takes one with all that may happen
/// (blocks-inl.hpp), and those lanes whose velocity comes to zero at its very end the event loop (sliding/advance.hpp).
///
/// @param settle  go on without ground acceleration until they rest; one that does not says so in `failure`
/// @pre has_level_lanes
void slide_levels(const LevelGround& ground, std::span<LevelLane> lanes, bool settle);

}  // namespace stickslip::detail
