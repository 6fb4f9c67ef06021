// How the resistance of a law changes with a parameter.
#pragma once

#include <array>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "stickslip/base/min_max.hpp"
#include "stickslip/base/units.hpp"
#include "stickslip/flow/closed_form.hpp"
#include "stickslip/friction/coulomb.hpp"
#include "stickslip/friction/law.hpp"
#include "stickslip/friction/multi_pendulum.hpp"
#include "stickslip/friction/static_kinetic.hpp"
#include "stickslip/sliding/observer.hpp"
#include "stickslip/sliding/parameter.hpp"
#include "stickslip/state/pendulum_memory.hpp"
#include "stickslip/state/state.hpp"

namespace stickslip::detail {

[[noreturn]] inline void refuse_sensitivity(const std::string& reason) {
  throw std::invalid_argument("sensitivity: " + reason);
}

/// Only some parameters belong to a surface.
inline void refuse_surface(Parameter parameter, std::optional<std::size_t> surface) {
  if (surface && parameter != Parameter::radius && parameter != Parameter::mu && parameter != Parameter::capacity)
    refuse_sensitivity("only radius, mu and capacity belong to a surface");
}

/// The force of a law toward negative x during a slip, under the weight, as a line in x, and its change with the
/// parameter at a fixed x, likewise [m/s^2].
struct LevelLine {
  double from, value, slope = 0;
  double change = 0, change_of_slope = 0;

  double at(double x) const noexcept { return value + slope * (x - from); }
  double change_at(double x) const noexcept { return change + change_of_slope * (x - from); }
};

/// A jump of that force during a slip [m/s^2], and the change of its place [m].
struct LevelJump {
  double size = 0, place = 0;
};

/// Follows a law along a motion and its variation. The primary template is that of constant levels; all of them define
///
///     FrictionVariation(law, parameter, surface)  // refuses a parameter that belongs to another law
///     depends_on_place            // whether lines have slopes
///     begin(state)                // at the start of the motion
///     line(direction, x)          // from a place on, in a direction
///     slide(slip, dx)             // moves to the end of a slip, where the displacement changes by dx; the jump there
///     strike(x)                   // stops at a stop; how that moves [m]
///     change_of_hold()            // change of the levels at rest [m/s^2]
///     steepest()                  // largest slope of a line [1/s^2]
template <class Law>
class FrictionVariation {
 public:
  static constexpr bool depends_on_place = false;

  FrictionVariation(const Law& law, Parameter parameter, std::optional<std::size_t> surface) : law_(law) {
    switch (parameter) {
      case Parameter::slip_level:
        kinetic_ = held_ = 1;
        break;
      case Parameter::kinetic:
      case Parameter::static_level:
        if constexpr (std::same_as<Law, Coulomb>)
          refuse_sensitivity("Coulomb friction has one level for sliding and rest, by which slip_level differentiates");
        (parameter == Parameter::kinetic ? kinetic_ : held_) = 1;
        break;
      case Parameter::radius:
      case Parameter::mu:
      case Parameter::capacity:
        refuse_sensitivity("only a MultiPendulum has surfaces with radius, mu and capacity");
      default:
        break;
    }
    refuse_surface(parameter, surface);
  }

  void begin(const State&) const noexcept {}
  LevelLine line(Direction direction, double x) const {
    const double s = sign(direction);
    return {.from = x, .value = s * resist(law_, x, 0.0, direction), .change = s * kinetic_};
  }
  LevelJump slide(const Slip&, double) const noexcept { return {}; }
  double strike(double) const noexcept { return 0; }
  double change_of_hold() const noexcept { return held_; }
  double steepest() const noexcept { return 0; }

 private:
  const Law& law_;
  double kinetic_ = 0, held_ = 0;
};

/// The force of a bearing with several surfaces follows from where the elements are that do not move. With S the
/// elements that do, R the sum of their radii, and phi = F/N,
///     x = sum over S of R_k (phi - s mu_k) + sum over the others of u_k,
///     R dphi = dx - sum over the others of du_k + s sum over S of d(R_k mu_k) - phi dR.
/// An element that comes to rest where the motion turns keeps its du_k, and du_k = +-d(d_k) at its stop. Where an
/// element joins, or stops while others move on, phi is continuous and the variation too.
template <>
class FrictionVariation<MultiPendulum> {
 public:
  static constexpr bool depends_on_place = true;

  FrictionVariation(const MultiPendulum& law, Parameter parameter, std::optional<std::size_t> surface)
      : law_(law), changes_(law.change_of_elements(changes_of_surfaces(law, parameter, surface))) {
    for (const MultiPendulum::Element& element : law.elements())
      steepest_ = std::max(steepest_, standard_gravity / element.radius);
  }

  void begin(const State& state) {
    // In one motion from the center.
    const Direction direction = state.displacement > 0 ? Direction::forward : Direction::backward;
    for (double left = std::abs(state.displacement); left > 0;) {
      const double way = std::min(left, law_.ahead(state_, direction));
      slide({direction, state_.displacement, way, 0, 0}, 0);
      left -= way;
    }
    state_ = state;
  }

  LevelLine line(Direction direction, double x) const {
    const unsigned moving = law_.moving(state_.pendulum, direction);
    const double s = sign(direction), phi = law_.force(state_.pendulum, direction);
    double radii = 0, change_of_radii = 0, shift = 0;
    double flats = 0, by_flats = 0;  // a flat element alone determines the force
    for (std::size_t k = 0; k < changes_.size(); ++k) {
      const auto& [radius, mu, capacity] = law_.elements()[k];
      const MultiPendulum::Element& change = changes_[k];
      if (!(moving >> k & 1)) {
        shift -= moved_[k];
      } else if (flat(k)) {
        ++flats;
        by_flats += change.mu;
      } else {
        radii += radius;
        change_of_radii += change.radius;
        shift += s * (change.radius * mu + radius * change.mu);
      }
    }
    if (flats > 0)
      return {.from = x, .value = standard_gravity * phi, .change = standard_gravity * s * by_flats / flats};
    const double slope = standard_gravity / radii;
    return {x, standard_gravity * phi, slope, slope * (shift - phi * change_of_radii),
            -slope * change_of_radii / radii};
  }

  LevelJump slide(const Slip& slip, double dx) {
    last_ = {line(slip.direction, slip.from), slip.direction, slip.to(), law_.moving(state_.pendulum, slip.direction)};
    place(dx);
    state_.mode = mode_of(slip.direction);
    law_.slide(state_, slip.distance);
    state_.displacement = slip.to();
    const PendulumMemory& now = state_.pendulum;
    const unsigned all = (1U << changes_.size()) - 1;
    for (std::size_t k = 0; k < changes_.size(); ++k)
      if ((now.at_forward | now.at_backward) >> k & 1)
        moved_[k] = (now.at_forward >> k & 1 ? 1 : -1) * changes_[k].capacity;
    if (now.moving != 0 || (slip.direction == Direction::forward ? now.at_forward : now.at_backward) == all) return {};
    double stops = 0;
    for (const double one : moved_) stops += one;
    return {standard_gravity * law_.force(now, slip.direction) - last_.line.at(last_.to), stops};
  }

  double strike(double x) {
    const double s = x > 0 ? 1 : -1;
    if (std::abs(x) < law_.capacity()) {  // a stop of the mounting
      place(0);
      return 0;
    }
    double sum = 0;
    for (std::size_t k = 0; k < changes_.size(); ++k) sum += moved_[k] = s * changes_[k].capacity;
    return sum;
  }

  double change_of_hold() const noexcept { return 0; }  // none is held by more than slides
  double steepest() const noexcept { return steepest_; }

 private:
  bool flat(std::size_t k) const noexcept { return !(law_.elements()[k].radius < never); }

  // Where the elements that moved are at the end of the last slip, if the displacement changes by dx.
  void place(double dx) noexcept {
    const auto& [line, direction, to, moving] = last_;
    const double s = sign(direction), phi = line.at(to) / standard_gravity;
    const double change_of_phi = (line.change_at(to) + line.slope * dx) / standard_gravity;
    double rest = dx, flats = 0;
    for (std::size_t k = 0; k < changes_.size(); ++k) {
      const auto& [radius, mu, capacity] = law_.elements()[k];
      if (moving >> k & 1) {
        if (flat(k)) {
          ++flats;
          continue;
        }
        moved_[k] = changes_[k].radius * (phi - s * mu) + radius * (change_of_phi - s * changes_[k].mu);
      }
      rest -= moved_[k];
    }
    for (std::size_t k = 0; k < changes_.size(); ++k)
      if ((moving >> k & 1) && flat(k)) moved_[k] = rest / flats;
  }

  // A unit change of the parameter, by surface.
  static std::vector<MultiPendulum::Element> changes_of_surfaces(const MultiPendulum& law, Parameter parameter,
                                                                 std::optional<std::size_t> surface) {
    refuse_surface(parameter, surface);
    const std::size_t count = law.radii().size();
    if (surface && *surface >= count)
      refuse_sensitivity("the index of a surface must be from 0 to " + std::to_string(count - 1) + ", got " +
                         std::to_string(*surface));
    std::vector<MultiPendulum::Element> changes(count, {0, 0, 0});
    for (std::size_t i = 0; i < count; ++i) {
      if (surface && i != *surface) continue;
      const auto require_finite = [i](const char* list, double value) {
        if (!(value < never))
          refuse_sensitivity(std::string(list) + "[" + std::to_string(i) +
                             "] is infinite, by which there is no derivative");
      };
      switch (parameter) {
        case Parameter::slip_level:
          changes[i].mu = 1 / standard_gravity;
          break;
        case Parameter::mu:
          changes[i].mu = 1;
          break;
        case Parameter::radius:
          require_finite("radii", law.radii()[i]);
          changes[i].radius = 1;
          break;
        case Parameter::capacity:
          require_finite("capacities", law.capacities()[i]);
          changes[i].capacity = 1;
          break;
        case Parameter::kinetic:
        case Parameter::static_level:
          refuse_sensitivity("a MultiPendulum has one level for sliding and rest, by which mu differentiates");
        default:
          break;
      }
    }
    return changes;
  }

  struct Last {
    LevelLine line;
    Direction direction;
    double to;
    unsigned moving;
  };

  const MultiPendulum& law_;
  std::vector<MultiPendulum::Element> changes_;
  std::array<double, PendulumMemory::most_elements> moved_{};  // du_k
  State state_;
  Last last_{{0, 0}, Direction::forward, 0, 0};
  double steepest_ = 0;
};

/// Laws whose resistance is linear in x between changes that are known.
template <class Law>
concept DifferentiableLaw =
    std::same_as<Law, Coulomb> || std::same_as<Law, StaticKinetic<Coulomb>> || std::same_as<Law, MultiPendulum>;

}  // namespace stickslip::detail
