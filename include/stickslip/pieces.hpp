// A long record on constant friction, without a spring: cut in pieces that run side by side.
//
// Two motions of such a slider that are stuck at the same instant are the same from there on, but for a constant in x.
// So the pieces of a record may all be run from rest at once, a lane each; then, piece after piece, the head of each is
// run again from its true start until it is stuck where the lane was stuck too, and the rest of the lane is taken over
// with its displacement shifted. Exact, and pays where a record is much longer than the time between sticks.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

#include "stickslip/advance.hpp"
#include "stickslip/friction/law.hpp"
#include "stickslip/ground_motion.hpp"
#include "stickslip/recorder.hpp"
#include "stickslip/state.hpp"

namespace stickslip::detail {

/// Sliders of one law that move in step, each under a ground motion of its own. A segment without an event is advanced
/// in all lanes together; a lane with an event in it goes through the event loop.
template <ConstantLevelLaw Law>
class Lanes {
 public:
  static constexpr std::size_t width = 16;
  using Row = std::array<double, width>;

  explicit Lanes(const Law& law) : law_(law), recorders_(width, Recorder<Law>(law)) {}

  /// Advances lane l from ground acceleration start[l] to end[l].
  void advance(double duration, const Row& start, const Row& end) {
    const double forward = law_.level(0.0, Direction::forward), backward = law_.level(0.0, Direction::backward);
    Row quiet;
    for (std::size_t l = 0; l < width; ++l) {
      const double s = sign_[l], slides = s * s;
      const double level = s < 0 ? backward : forward;
      const double load = -start[l], last_load = -end[l];
      const double a = s * load - level, gain = s * (last_load - load);
      const double half_gain = gain * (1.0 / 2);
      const double last_speed = speed_[l] + duration * (a + half_gain);
      const double distance = slides * (duration * (speed_[l] + duration * (a * (1.0 / 2) + gain * (1.0 / 6))));
      const double mean = duration * (speed_[l] * (1.0 / 2) + duration * (a * (1.0 / 6) + gain * (1.0 / 24)));
      const bool goes_on = (s != 0) & (last_speed > 0) & ((a >= 0) | (a + gain <= 0));
      const bool holds = (s == 0) & (std::max(load, last_load) <= forward) & (std::min(load, last_load) >= -backward);
      const double q = goes_on | holds ? 1.0 : 0.0;
      quiet[l] = q;
      displacement_[l] += q * s * distance;
      speed_[l] = q == 1.0 ? slides * last_speed : speed_[l];
      way_[l] += q * distance;
      time_[l] += q * slides * duration;
    }
  }

 private:
  Law law_;
  Row sign_{}, speed_{}, displacement_{}, way_{}, time_{};
  std::vector<Recorder<Law>> recorders_;
};

}  // namespace stickslip::detail
