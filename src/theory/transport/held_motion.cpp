#include "theory/transport/held_motion.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <variant>

#include "stickslip/base/equal.hpp"
#include "stickslip/base/units.hpp"
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

/// Friction as the ground acceleration that it resists, and back.
class Incline {
 public:
  explicit Incline(const Mounting& on)
      : sine_(std::sin(on.slope())), cosine_(std::cos(on.slope())), one_way_(on.one_way) {}

  double load(double level, Direction direction) const {
    const bool forward = direction == Direction::forward;
    if (one_way_ && !forward) return infinity;
    if (equal(sine_, 0) || !std::isfinite(level)) return level;
    const double down = forward ? sine_ : -sine_, by_load = cosine_ + level / standard_gravity * down;
    return by_load > 0 ? (level * cosine_ - standard_gravity * down) / by_load : infinity;
  }
  /// The level that resists a finite load.
  double level(double load, Direction direction) const {
    if (equal(sine_, 0)) return load;
    const double down = direction == Direction::forward ? sine_ : -sine_;
    return (load * cosine_ + standard_gravity * down) / (cosine_ - load / standard_gravity * down);
  }
  double lift_off() const { return sine_ > 0 ? standard_gravity * cosine_ / sine_ : infinity; }

 private:
  double sine_, cosine_;
  bool one_way_;
};

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
              if (one.mounting().stops) throw std::invalid_argument("Transport: covers sliders without stops");
              // without a slope and vertical motion a pendulum is a spring
              return one.plain() ? Slider<Law>(one.law(), one.natural_frequency(), one.damping()) : one;
            }
          },
          slider)) {
  std::visit(
      [this]<class Law>(const Slider<Law>& one) {
        if constexpr (covered<Law>) {
          const Incline incline(one.mounting());
          const auto friction = [&](Direction direction) -> Friction {
            return {incline.load(stickslip::hold(one.law(), 0, direction), direction),
                    incline.load(stickslip::resist(one.law(), 0.0, 0.0, direction), direction)};
          };
          forward_ = friction(Direction::forward);
          backward_ = friction(Direction::backward);
          reach_ = reach_of(one.law());
          speed_ = speed_of(one.law());
          lift_off_ = incline.lift_off();
          least_ = std::min(forward_.start, backward_.start);
          if (std::isfinite(speed_))
            for (const Direction direction : {Direction::forward, Direction::backward})
              least_ =
                  std::min(least_, incline.load(stickslip::resist(one.law(), 0.0, 1e3 * speed_, direction), direction));
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
          advance(one, Segment{step, load, load}, state, farthest, Contact::clipped);
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
          const Incline incline(one.mounting());
          const auto less = [&](const Friction& friction, Direction direction, double level) {
            if (!std::isfinite(friction.hold)) return level;
            return std::max(incline.level(friction.hold - by, direction),
                            stickslip::resist(one.law(), 0.0, 0.0, direction));
          };
          return HeldMotion(
              Slider(StaticKinetic(one.law().sliding(), less(forward_, Direction::forward, one.law().static_forward()),
                                   less(backward_, Direction::backward, one.law().static_backward())),
                     one.mounting()));
        } else {
          return *this;
        }
      },
      slider_);
}

}  // namespace stickslip::detail
