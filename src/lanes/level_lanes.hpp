// Blocks with many slip levels in parallel, all under one ground motion.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "stickslip/friction/coulomb.hpp"
#include "stickslip/friction/static_kinetic.hpp"
#include "stickslip/ground/ground_motion.hpp"
#include "stickslip/state/state.hpp"

namespace stickslip::detail {

/// A ground motion of even steps as blocks without a spring feel it, with the extremes over blocks of segments of the
/// ground acceleration that must be held: what is stuck skips those in which it is held. Refers to the motion.
///
/// Under a normal force N that varies, on a slope or with vertical motion, that is -p / W, where p is the load and
/// W = N / g: what holds at rest has a level of at least its magnitude.
class LevelGround {
 public:
  static constexpr std::size_t block = 32;  ///< segments

  /// Level ground that moves horizontally.
  /// @pre motion.dt() is a number
  explicit LevelGround(const GroundMotion& motion);

  /// With the loads and weights of `LoadSegment`, also of vertical motion.
  /// @param flipped  under -n
  LevelGround(const GroundMotion& motion, double slope_degrees, bool flipped);

  LevelGround(const LevelGround&) = delete;
  LevelGround& operator=(const LevelGround&) = delete;

  /// Whether `slide_levels` takes it: even steps, accelerations and times whose products neither overflow nor
  /// underflow, and a normal force that is positive throughout.
  bool usable() const noexcept;

  std::size_t segments() const noexcept { return segments_; }
  double duration() const noexcept { return duration_; }                 ///< of a segment [s]
  bool held() const noexcept { return next_ == 0; }                      ///< or it runs straight
  const double* start() const noexcept { return start_; }                ///< what must be held at segments' beginnings
  const double* end() const noexcept { return start_ + next_; }          ///< and at their ends [m/s^2]
  std::span<const double> lowest() const noexcept { return lowest_; }    ///< of that in each block, and
  std::span<const double> highest() const noexcept { return highest_; }  ///< the highest

  bool weighed() const noexcept { return !weight_.empty(); }  ///< if not, it is n itself
  double slope_degrees() const noexcept { return slope_degrees_; }
  const double* load() const noexcept { return load_.data(); }      ///< p at segments' beginnings [m/s^2]
  const double* weight() const noexcept { return weight_.data(); }  ///< and W
  std::size_t next() const noexcept { return next_; }               ///< from a beginning to the end: 0 or 1 places

 private:
  void find_extremes();

  std::vector<double> held_back_, load_, weight_;  // empty where it is not weighed
  const double* start_;
  std::size_t next_, segments_;
  double duration_, peak_, slope_degrees_ = 0;
  std::vector<double> lowest_, highest_;
};

/// A block without a spring, which starts from rest at 0.
struct LevelLane {
  StaticKinetic<Coulomb> law;
  bool turned;                  ///< under the flipped motion; not where the ground is weighed
  State state{};                ///< at the end
  double peak = 0;              ///< largest |x| [m]
  double sliding_distance = 0;  ///< [m]
  double slip_from = 0;         ///< x where the current slip began [m]
  std::size_t events = 0;
  std::string failure{};  ///< why it does not settle
};

/// Whether `slide_levels` takes these levels: see LevelGround::usable.
bool has_level_lanes(const StaticKinetic<Coulomb>& law) noexcept;

/// Moves all lanes through the motion, as `integrate` does each: thesis (4.51) to (4.53).
///
/// The lanes are taken as many at a time as a vector holds. Those next to each other should be alike: a vector that is
/// stuck in all lanes skips to the next segment that moves one of them; where each goes on as it was, sliding or stuck,
/// it is one step without a branch; a segment in which some may have an event takes one with all that may happen
/// (blocks-inl.hpp), and those lanes whose velocity comes to zero at its very end the event loop (sliding/advance.hpp).
/// Where the ground is weighed all lanes that may have an event take the event loop.
///
/// @param settle  go on without ground acceleration until they rest; one that does not says so in `failure`
/// @pre ground.usable() and has_level_lanes; static levels equal the kinetic ones unless the ground is weighed
void slide_levels(const LevelGround& ground, std::span<LevelLane> lanes, bool settle);

}  // namespace stickslip::detail
