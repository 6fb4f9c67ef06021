// The linear system of the hysteresis loop with the largest displacement.
#pragma once

#include <cmath>
#include <cstddef>
#include <numbers>
#include <numeric>
#include <optional>
#include <stdexcept>
#include <vector>

#include "stickslip/base/equal.hpp"
#include "stickslip/base/error.hpp"
#include "stickslip/base/min_max.hpp"
#include "stickslip/base/units.hpp"
#include "stickslip/ground/motion.hpp"
#include "stickslip/sliding/detail/load.hpp"
#include "stickslip/sliding/response.hpp"
#include "stickslip/sliding/trajectory.hpp"
#include "stickslip/state/state.hpp"

namespace stickslip {

/// The hysteresis loop with the largest displacement, per unit mass.
struct Loop {
  double displacement;  ///< D, the largest distance from the position where the spring balances the weight [m]
  double force;         ///< F, of spring and friction on arrival there, from that position on [m/s^2]
  double area;          ///< E_d, energy that a cycle of amplitude D dissipates [m^2/s^2]

  /// k_eff = F / D, of the secant [1/s^2].
  double stiffness() const noexcept { return force / displacement; }

  /// 2 pi / sqrt(k_eff) [s].
  double period() const noexcept { return 2 * std::numbers::pi / std::sqrt(stiffness()); }

  /// E_d / (2 pi k_eff D^2), a fraction of critical damping.
  double damping() const noexcept { return area / (2 * std::numbers::pi * force * displacement); }
};

namespace detail {

/// The half cycle up to the largest displacement: the events between which it is.
struct HalfCycle {
  std::size_t turn, peak;
  double displacement;  ///< the largest, D [m]
  double direction;     ///< sign

  /// The loop of which this is a part.
  /// @param force           on arrival at the peak, toward negative x [m/s^2]
  /// @param work, distance  of friction and damper in the half cycle [m^2/s^2], and its length [m]
  Loop loop(double force, double work, double distance) const {
    if (!(direction * force > 0))
      throw std::invalid_argument(
          "effective period and damping: no force draws the slider back where |x| is largest; it is off the ground");
    return {displacement, direction * force, 4 * displacement * work / distance};
  }
};

/// @param has_spring  whether a spring draws the slider back
/// @param center      where the spring balances the weight [m]
inline HalfCycle half_cycle(const Response& response, bool has_spring, double center) {
  if (!has_spring)
    throw std::invalid_argument(
        "effective period and damping: needs a slider on a spring (natural_frequency, period or radius): without one "
        "no force draws the mass back");
  if (!(response.time_sliding > 0)) throw std::invalid_argument("effective period and damping: the slider never slips");
  const std::vector<Event>& events = response.events;
  const auto x_of = [&](const Event& e) { return e.displacement - center; };
  double largest = std::abs(response.displacement.front() - center);
  for (const Event& e : events) largest = std::max(largest, std::abs(x_of(e)));
  std::size_t peak = 1;
  const auto turns = [](EventKind kind) {
    return kind == EventKind::reversal || kind == EventKind::arrest || kind == EventKind::impact;
  };
  while (peak < events.size() && !(turns(events[peak].kind) && equal(std::abs(x_of(events[peak])), largest))) ++peak;
  if (peak >= events.size())
    throw std::invalid_argument("effective period and damping: |x| is largest, " + shortest(largest) +
                                " m, where no slip ends: at the start, or at the end of a motion that is not over "
                                "(settle continues it)");

  // Back to the last reversal from the other direction, or to the start.
  const double s = x_of(events[peak]) < 0 ? -1 : 1;
  const auto way = [&](std::size_t k) { return s * (events[k].displacement - events[k - 1].displacement); };
  std::size_t turn = peak;
  while (turn > 0 && way(turn) >= 0) --turn;
  return {turn, peak, largest, s};
}

/// Sums the distance slid, and the work on friction and damper, between two times.
class SwingReader final : public TrajectoryReader {
 public:
  SwingReader(const Trajectory& trajectory, double from, double to) : trajectory_(trajectory), from_(from), to_(to) {}

  void arc(const Arc& arc) override {
    const double middle = std::midpoint(arc.begin, arc.end);
    if (!(middle > from_ && middle < to_)) return;
    if (landed_) work += (*landed_ * *landed_ - arc.start.velocity * arc.start.velocity) / 2;
    landed_.reset();
    last = arc.at(arc.duration);
    weight = arc.weight(arc.duration);
    distance += arc.distance;
    work += arc.work - (energy(last) - energy(arc.start));
  }
  void event(EventKind kind, double, const State& state, const Load&) override {
    if (kind == EventKind::landing) landed_ = state.velocity;
  }

  double distance = 0, work = 0;
  State last;         // at the end
  double weight = 0;  // N+/g there

 private:
  double energy(const State& at) const noexcept { return at.velocity * at.velocity / 2 + trajectory_.elastic(at); }

  const Trajectory& trajectory_;
  double from_, to_;
  std::optional<double> landed_;  // velocity before a landing
};

}  // namespace detail

/// The hysteresis loop with the largest displacement, as used in the design of sliding isolators.
///
/// D is the peak |x|, F the force of spring and friction there, before the slider reverses or stops. The response to an
/// earthquake does not close a loop. The area is therefore that of a cycle from D to -D and back: 4 D times the energy
/// per meter that friction and damper dissipated in the half cycle up to the peak. In a steady cycle about x = 0 this
/// is the area of the loop. With Coulomb friction of level a, and wn^2 of a spring,
///     k_eff = wn^2 + a / D,    E_d = 4 a D,    E_d / (2 pi k_eff D^2) = (2 / pi) a / (a + wn^2 D).
/// Under vertical motion F has the normal force at that instant, and the energy that of the half cycle. On a slope x
/// counts from the position where the spring balances the weight. Stops do not count: where |x| is largest at one, F is
/// the force of spring and friction on arrival, and the energy that the stop takes is not in the area.
///
/// @param trajectory  of the response of a slider on a spring
/// @throws std::invalid_argument  no spring; it never slips; |x| is largest at the start, or at the end of the motion
///                                during a slip, or in flight without a force
/// Accuracy: that of `integrate`. Cost: one pass over the events, and the integration up to the peak.
inline Loop largest_loop(const Trajectory& trajectory) {
  const Mounting& mounting = trajectory.mounting();
  const Response& response = trajectory.response();
  const double downhill = trajectory.downhill();
  const double center = downhill > 0 ? downhill / mounting.spring().under(std::cos(mounting.slope())) : 0;
  const detail::HalfCycle half = detail::half_cycle(response, trajectory.has_spring(), center);
  const Event& peak = response.events[half.peak];
  detail::SwingReader swing(trajectory, response.events[half.turn].time, peak.time);
  trajectory.read(swing, peak.time);

  State state = swing.last;
  state.displacement = peak.displacement;
  state.velocity = peak.velocity;
  const double friction = detail::weigh(
      swing.weight,
      trajectory.resist(state, swing.weight, half.direction < 0 ? Direction::backward : Direction::forward));
  const double force = trajectory.pull(state.displacement, swing.weight) - downhill + half.direction * friction;
  return half.loop(force, swing.work, swing.distance);
}

/// The same of a slider, or a law alone, under a ground motion.
template <class Slider, Motion M>
Loop largest_loop(const Slider& slider, const M& motion, const Response& response) {
  return largest_loop(*trajectory(slider, motion, response));
}

}  // namespace stickslip
