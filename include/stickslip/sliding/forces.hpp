// The forces on a slider at the samples of its response, and the largest one.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "stickslip/base/equal.hpp"
#include "stickslip/base/min_max.hpp"
#include "stickslip/base/units.hpp"
#include "stickslip/ground/motion.hpp"
#include "stickslip/run/detail/largest.hpp"
#include "stickslip/sliding/detail/load.hpp"
#include "stickslip/sliding/detail/recall.hpp"
#include "stickslip/sliding/response.hpp"
#include "stickslip/sliding/trajectory.hpp"
#include "stickslip/state/state.hpp"

namespace stickslip {

/// Forces per unit mass at the samples of a response [m/s^2], positive where they pull toward negative x:
///     x'' + friction + damper + spring = p,    on level ground p = -n,
/// so that the absolute acceleration of the mass along x is g sin(slope) - (friction + damper + spring). The force of a
/// stop is an impulse; the force that holds a slider at a stop counts as friction.
struct Forces {
  std::vector<double> friction;     ///< resist N+/g sgn(x') during a slip; p - spring while the slider sticks
  std::vector<double> damper;       ///< c x'
  std::vector<double> spring;       ///< wn^2 x; of a pendulum times N+/g
  std::vector<double> normal;       ///< N+, 0 while the slider is in flight
  std::vector<std::uint8_t> stuck;  ///< 1 while the slider sticks, else 0
  double downhill = 0;              ///< g sin(slope)

  /// The sum of friction, damper and spring [m/s^2].
  double total(std::size_t i) const noexcept { return friction[i] + damper[i] + spring[i]; }

  /// Absolute acceleration of the mass along x [m/s^2].
  double acceleration(std::size_t i) const noexcept { return downhill - total(i) + 0.0; }  // no minus zero
};

namespace detail {

/// Reads the forces at the samples of a response.
class ForcesReader final : public TrajectoryReader {
 public:
  explicit ForcesReader(const Trajectory& trajectory)
      : trajectory_(trajectory),
        constant_(trajectory.has_constant_level()),
        level_{trajectory.resist(State(), 1, Direction::forward), trajectory.resist(State(), 1, Direction::backward)},
        end_of_motion_(trajectory.time(trajectory.samples() - 1)),
        time_(trajectory.time(0)) {
    const std::size_t samples = trajectory.response().displacement.size();
    for (auto* values : {&forces.friction, &forces.damper, &forces.spring, &forces.normal}) values->resize(samples);
    forces.stuck.resize(samples);
    forces.downhill = trajectory.downhill();
  }

  /// A sample has the forces of the arc that begins there, the last one of the motion those of the arc that ends there.
  void arc(const Arc& arc) override {
    const auto ends_here = [&](double time) {
      return equal(time, arc.end) && (equal(time, end_of_motion_) || next_ + 1 == forces.stuck.size());
    };
    while (next_ < forces.stuck.size()) {
      if (!(time_ < arc.end || ends_here(time_))) return;
      keep(arc, time_ < arc.end ? std::max(time_ - arc.begin, 0.0) : arc.duration);
      time_ = trajectory_.time(++next_);
    }
  }

  Forces forces;

 private:
  void keep(const Arc& arc, double t) {
    const std::size_t i = next_;
    const Response& response = trajectory_.response();
    const double x = response.displacement[i], v = response.velocity[i], weight = arc.weight(t),
                 load = arc.load(t).load;
    forces.normal[i] = weight * standard_gravity;
    forces.damper[i] = trajectory_.mounting().damping * v + 0.0;  // no minus zero
    forces.spring[i] = trajectory_.pull(x, weight) + 0.0;
    forces.stuck[i] = arc.rests();
    if (arc.rests()) {
      forces.friction[i] = load - forces.spring[i];
    } else {
      const Direction direction = direction_of(arc.start.mode);
      const auto resists = [&] {
        if (constant_) return direction == Direction::forward ? level_[0] : level_[1];
        if (trajectory_.has_memory()) there_ = arc.at(t);
        there_.displacement = x;
        there_.velocity = v;
        there_.mode = arc.start.mode;
        return trajectory_.resist(there_, weight, direction);
      };
      forces.friction[i] = sign(direction) * weigh(weight, resists()) + 0.0;
    }
  }

  const Trajectory& trajectory_;
  bool constant_;
  double level_[2];              // if it is constant, forward and backward [m/s^2]
  double end_of_motion_, time_;  // of the next sample [s]
  std::size_t next_ = 0;
  State there_;
};

}  // namespace detail

/// The forces on a slider during a response.
///
/// At a sample at which a slip begins, reverses or stops, or a held ground acceleration jumps, the values are those
/// just after it. At the end of the ground motion they balance its last value (of held values, the last that acts);
/// after that the ground acceleration is 0.
///
/// @param trajectory  of the response
/// @return vectors as long as `response.displacement`
/// Friction is as accurate as the displacement and the velocity. Cost: about that of `integrate`.
inline Forces forces(const Trajectory& trajectory) {
  detail::ForcesReader reader(trajectory);
  const double last_sample = trajectory.time(reader.forces.stuck.size() - 1);
  detail::read_ends(trajectory, reader, std::max(trajectory.end(), last_sample));
  return std::move(reader.forces);
}

/// The same of a slider, or a law alone, under a ground motion.
template <class Slider, Motion M>
Forces forces(const Slider& slider, const M& motion, const Response& response) {
  return forces(*trajectory(slider, motion, response));
}

/// The largest force on a slider.
struct LargestForce {
  double force = 0;  ///< |friction + damper + spring| per unit mass [m/s^2]
  double time = 0;   ///< [s], to 1e-6 of a slip; the first, where it is constant
};

namespace detail {

/// Reads the largest sum of the forces, p - x''.
class LargestForceReader final : public TrajectoryReader {
 public:
  explicit LargestForceReader(const Trajectory& trajectory)
      : trajectory_(trajectory), turns_(4 * std::sqrt(trajectory.mounting().stiffness())) {
    const Mounting& on = trajectory.mounting();
    at_ends = trajectory.has_constant_level() && !(on.stiffness() > 0) && !(on.damping > 0);
    largest.time = trajectory.begin();
  }

  // At rest the sum is the load, which is monotonic. In a slip it is smooth, and turns no faster than its spring.
  void arc(const Arc& arc) override {
    const auto keep = [&](double t, double force) {
      if (force > (1 + 1e-13) * largest.force) largest = {force, t < arc.duration ? arc.begin + t : arc.end};
      return force;
    };
    const auto sum = [&](double t) { return keep(t, std::abs(arc.load(t).load - arc.acceleration(t))); };
    if (arc.rests()) {
      sum(0);
      sum(arc.duration);
    } else if (at_ends) {
      const double level = trajectory_.resist(arc.start, 1, direction_of(arc.start.mode));
      for (const double t : {0.0, arc.duration}) keep(t, weigh(arc.weight(t), level));
    } else {
      const double parts = std::clamp(turns_ * arc.duration, 4.0, 4096.0);
      look_for_largest(arc.duration, static_cast<int>(parts), largest.force, sum);
    }
  }

  LargestForce largest;
  bool at_ends;  // of arcs: in a slip it is the friction, linear in time

 private:
  const Trajectory& trajectory_;
  double turns_;  // four times the rate of the spring [1/s]
};

}  // namespace detail

/// The largest |friction + damper + spring| on a slider over all time, not only at samples. Impulses of stops and
/// landings do not count.
///
/// @param trajectory  of the response
/// Found by a search within each slip; accurate to 1e-9. Cost: about that of `forces`.
inline LargestForce peak_force(const Trajectory& trajectory) {
  detail::LargestForceReader reader(trajectory);
  if (reader.at_ends)
    detail::read_ends(trajectory, reader, trajectory.end());
  else
    trajectory.read(reader, trajectory.end());
  return reader.largest;
}

/// The same of a slider, or a law alone, under a ground motion.
template <class Slider, Motion M>
LargestForce peak_force(const Slider& slider, const M& motion, const Response& response) {
  return peak_force(*trajectory(slider, motion, response));
}

}  // namespace stickslip
