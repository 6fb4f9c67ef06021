// The linear system of the hysteresis loop with the largest displacement.
#pragma once

#include <cmath>
#include <concepts>
#include <cstddef>
#include <numbers>
#include <stdexcept>
#include <vector>

#include "stickslip/base/equal.hpp"
#include "stickslip/base/min_max.hpp"
#include "stickslip/error.hpp"
#include "stickslip/friction/law.hpp"
#include "stickslip/ground/motion.hpp"
#include "stickslip/ground/segment.hpp"
#include "stickslip/slider.hpp"
#include "stickslip/sliding/advance.hpp"
#include "stickslip/sliding/detail/load.hpp"
#include "stickslip/sliding/detail/load_history.hpp"
#include "stickslip/sliding/detail/recorder.hpp"
#include "stickslip/sliding/detail/run.hpp"
#include "stickslip/sliding/forces.hpp"
#include "stickslip/sliding/observer.hpp"
#include "stickslip/sliding/response.hpp"
#include "stickslip/sliding/trajectory.hpp"
#include "stickslip/state.hpp"
#include "stickslip/units.hpp"

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

/// Sums the distance slid, and the work on friction and damper, of a motion from a time on.
template <FrictionLaw Law, bool loaded>
struct SwingWork {
  const Law& law;
  double distance = 0, work = 0;

  template <class Flow>
  void follow(const Flow& flow, double taken) {
    if constexpr (FlowWithDamper<Flow>) work += flow.damped_work(taken);
    if constexpr (!PositionLaw<Law> && !loaded) work += flow.friction_work(taken);
  }
  void dissipate(double done) requires loaded { work += done; }
  void lose(double) requires loaded {}  // a stop is not in the loop
  void slide(const Slip& slip) {
    distance += slip.distance;
    if constexpr (PositionLaw<Law> && !loaded) work += friction_work(law, slip.from, slip.distance, slip.direction);
  }
  void event(EventKind, double, const State&) const noexcept {}
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
/// @param slider    the slider, on a spring
/// @param motion    its ground motion
/// @param response  the result of `integrate` for them
/// @throws std::invalid_argument  no spring; it never slips; |x| is largest at the start, or at the end of the motion
///                                during a slip, or in flight without a force
/// Accuracy: that of `integrate`; for a law that depends on the temperature, with a surface that is heated as by the
/// response alone. Cost: one pass over the events, and the integration up to the peak.
template <FrictionLaw Law, Motion M>
Loop largest_loop(const Slider<Law>& slider, const M& motion, const Response& response) {
  if (!(slider.stiffness() > 0))
    throw std::invalid_argument(
        "effective period and damping: needs a slider on a spring (natural_frequency, period or radius): without one "
        "no "
        "force draws the mass back");
  if (!(response.time_sliding > 0)) throw std::invalid_argument("effective period and damping: the slider never slips");
  const bool pendulum = slider.mounting().pendulum;
  const double downhill = slider.slope() > 0 ? standard_gravity * std::sin(slider.slope()) : 0;
  const double center = downhill / (slider.stiffness() * (pendulum ? std::cos(slider.slope()) : 1));
  const std::vector<Event>& events = response.events;
  const auto x_of = [&](const Event& e) { return e.displacement - center; };
  double largest = std::abs(response.displacement.front() - center);
  for (const Event& e : events) largest = std::max(largest, std::abs(x_of(e)));
  std::size_t peak = 1;
  const auto turns = [](EventKind kind) {
    return kind == EventKind::reversal || kind == EventKind::arrest || kind == EventKind::impact;
  };
  while (peak < events.size() && !(turns(events[peak].kind) && detail::equal(std::abs(x_of(events[peak])), largest)))
    ++peak;
  if (peak >= events.size())
    throw std::invalid_argument("effective period and damping: |x| is largest, " + detail::shortest(largest) +
                                " m, where no slip ends: at the start, or at the end of a motion that is not over "
                                "(settle continues it)");

  // Back to the last reversal from the other direction, or to the start.
  const double s = x_of(events[peak]) < 0 ? -1 : 1;
  const auto way = [&](std::size_t k) { return s * (events[k].displacement - events[k - 1].displacement); };
  std::size_t turn = peak;
  while (turn > 0 && way(turn) >= 0) --turn;

  State state = detail::start_of(slider.law(), motion, response);
  const double begin = motion.time(0), from = events[turn].time, end = events[peak].time;
  NoObserver none;
  detail::advance_between(slider, motion, response.contact, begin, from, state, none);
  detail::SwingWork<Law, std::same_as<M, GroundMotion>> swing{slider.law()};
  detail::advance_between(slider, motion, response.contact, from, end, state, swing);

  const Event& e = events[peak];
  const double normal = std::max(detail::load_history(motion, slider.slope()).after(end).normal, 0.0);
  const double weight = state.in_flight ? 0 : normal / standard_gravity;
  const double pull = slider.stiffness() * (pendulum ? weight : 1) * e.displacement;
  const double friction =
      detail::weigh(weight, resist(law_at(slider.law(), state, weight), e.displacement, std::abs(e.velocity),
                                   s < 0 ? Direction::backward : Direction::forward));
  const double force = s * (pull - downhill) + friction;
  if (!(force > 0))
    throw std::invalid_argument(
        "effective period and damping: no force draws the slider back where |x| is largest; it is off the ground");
  return {largest, force, 4 * largest * swing.work / swing.distance};
}

}  // namespace stickslip
