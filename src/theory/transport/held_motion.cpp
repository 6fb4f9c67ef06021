#include "theory/transport/held_motion.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <variant>

#include "stickslip/base/equal.hpp"
#include "stickslip/ground/segment.hpp"
#include "stickslip/sliding/advance.hpp"

namespace stickslip::detail {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// The laws that are covered: those whose friction changes over a distance and a speed that are known.
template <class Law>
constexpr bool covered = MemorylessLaw<Law>&& form_of<Law> != Form::numeric;

/// The distance over which friction changes.
template <class Law>
double reach_of(const Law& law) {
  if constexpr (requires { law.length_scale(); })
    return law.length_scale();
  else
    return infinity;
}
template <class Law>
double reach_of(const StaticKinetic<Law>& law) {
  return reach_of(law.sliding());
}

/// The speed over which friction changes.
template <class Law>
double speed_of(const Law& law) {
  if constexpr (requires { law.speed_scale(); })
    return law.speed_scale();
  else
    return infinity;
}
template <class Law>
double speed_of(const StaticKinetic<Law>& law) {
  return speed_of(law.sliding());
}

/// The largest |x| of a motion: it is at its ends or where the velocity is zero.
struct Farthest {
  double distance;

  template <class Slip>
  void slide(const Slip&) const noexcept {}
  template <class AnyState>
  void event(EventKind, double, const AnyState& state) noexcept {
    distance = std::max(distance, std::abs(state.displacement));
  }
};

}  // namespace

HeldMotion::HeldMotion(const AnySlider& slider)
    : slider_(std::visit(
          []<class Law>(const Slider<Law>& one) -> AnySlider {
            if constexpr (!covered<Law>) {
              throw std::invalid_argument("Transport: does not cover laws with memory, nor functions");
            } else {
              require_plain_mounting(one.mounting(), "Transport");
              return Slider<Law>(one.law(), one.natural_frequency(), one.damping());
            }
          },
          slider)) {
  std::visit(
      [this]<class Law>(const Slider<Law>& one) {
        if constexpr (covered<Law>) {
          const auto friction = [&](Direction direction) -> Friction {
            return {stickslip::hold(one.law(), 0, direction), stickslip::resist(one.law(), 0.0, 0.0, direction)};
          };
          forward_ = friction(Direction::forward);
          backward_ = friction(Direction::backward);
          reach_ = reach_of(one.law());
          speed_ = speed_of(one.law());
          least_ = std::min(forward_.start, backward_.start);
          if (std::isfinite(speed_))
            for (const Direction direction : {Direction::forward, Direction::backward})
              least_ = std::min<double>(least_, stickslip::resist(one.law(), 0.0, 1e3 * speed_, direction));
        }
      },
      slider_);
  mirrors_ = equal(forward_.hold, backward_.hold) && equal(forward_.start, backward_.start);
}

HeldMotion::End HeldMotion::operator()(double x, double v, double load, double step) const {
  return std::visit(
      [&]<class Law>(const Slider<Law>& one) -> End {
        if constexpr (covered<Law>) {
          State state = State::at(x, v);
          Farthest farthest{std::abs(x)};
          advance(one, Segment{step, load, load}, state, farthest);
          return {state.displacement, state.velocity, std::max(farthest.distance, std::abs(state.displacement))};
        } else {
          throw std::logic_error("Transport: a law that is not covered");
        }
      },
      slider_);
}

double HeldMotion::least_hold() const noexcept { return std::min(forward_.hold, backward_.hold); }

bool HeldMotion::breaks_away() const noexcept {
  return forward_.hold > forward_.start || backward_.hold > backward_.start;
}

HeldMotion HeldMotion::holding_less(double by) const {
  return std::visit(
      [&]<class Law>(const Slider<Law>& one) {
        if constexpr (covered<Law> && requires { one.law().sliding(); }) {
          const auto less = [&](const Friction& friction) { return std::max(friction.hold - by, friction.start); };
          return HeldMotion(Slider(StaticKinetic(one.law().sliding(), less(forward_), less(backward_)),
                                   one.natural_frequency(), one.damping()));
        } else {
          return *this;
        }
      },
      slider_);
}

}  // namespace stickslip::detail
