// The motion of a cart under one ground motion.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "stickslip/base/vector2.hpp"
#include "stickslip/carts/state.hpp"

namespace stickslip {

enum class CartEventKind : std::uint8_t {
  breakaway,  ///< the cart leaves its rest (or moves already at the start)
  rest,       ///< it comes to rest
  slip,       ///< a line of a wheel that stuck begins to slide: across a wheel it scrubs, along it rolls
  stick,      ///< a line of a wheel sticks: across a wheel it rolls straight
  reversal,   ///< a line changes its direction without sticking
  end         ///< the motion is over
};

struct CartEvent {
  static constexpr std::size_t no_support = static_cast<std::size_t>(-1);

  double time;             ///< [s]
  Vector2 displacement{};  ///< of the center of mass [m]
  double yaw = 0;          ///< [rad]
  CartEventKind kind{};
  std::size_t support = no_support;  ///< whose line it is, counted from 0
  bool along = false;                ///< the line along the wheel, or that across it
};

/// A straight wall, for what it would meet.
struct Wall {
  Vector2 point{};      ///< on it, relative to the center of mass at the start [m], finite
  Vector2 direction{};  ///< along it, not zero, finite

  friend bool operator==(const Wall&, const Wall&) = default;
};

/// How near the outline of a cart came to a wall.
struct Clearance {
  double least = std::numeric_limits<double>::infinity();       ///< [m]; negative: it would have hit
  double time = 0;                                              ///< of the least distance [s]
  double hit_time = std::numeric_limits<double>::quiet_NaN();   ///< of the first contact [s]; NaN without one
  double hit_speed = std::numeric_limits<double>::quiet_NaN();  ///< of the corner toward the wall then [m/s]
};

/// Work against friction at one support, per unit mass of the cart [m^2/s^2].
struct SupportWork {
  double scrub = 0;  ///< of a wheel, across it
  double roll = 0;   ///< of a wheel, along it
  double slide = 0;  ///< of a foot
};

/// The energy balance, per unit mass [m^2/s^2]: initial + input = dissipated + kinetic.
struct CartEnergy {
  double initial = 0;
  double input = 0;       ///< work of the ground, the integral of -(a_x x' + a_y y') dt
  double dissipated = 0;  ///< work against friction
  double kinetic = 0;     ///< at the end
  double elastic = 0;     ///< a cart has no spring
  std::vector<SupportWork> by_support{};

  double imbalance() const noexcept { return initial + input - dissipated - kinetic; }
};

/// The range of the outline in the room, relative to the center of mass at the start [m].
struct Reach {
  Vector2 low{std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
  Vector2 high{-std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
};

/// The motion of a cart. Peaks are over all time, not only at samples.
struct CartResponse {
  std::vector<Vector2> displacement;  ///< of the center of mass at the samples, relative to the ground [m]
  std::vector<Vector2> velocity;      ///< [m/s]
  std::vector<double> yaw;            ///< [rad]
  std::vector<double> yaw_rate;       ///< [rad/s]
  /// Of the casters at the samples, relative to the cart [rad]: those of a sample follow each other.
  std::vector<double> headings;
  std::vector<CartEvent> events;  ///< in order of time; the last is the end
  double peak = 0;                ///< largest displacement of the center of mass [m]
  double peak_time = 0;           ///< [s]
  double peak_yaw = 0;            ///< largest change of the yaw since the start [rad]
  double peak_outline = 0;        ///< largest displacement of a corner of the outline [m]
  double peak_outline_time = 0;   ///< [s]
  std::size_t peak_corner = 0;    ///< the corner that moved farthest
  Reach reach{};                  ///< what the outline swept
  Vector2 residual{};             ///< displacement at the end [m]
  double residual_yaw = 0;        ///< change of the yaw at the end [rad]
  double time_moving = 0;         ///< [s]
  std::size_t rests = 0;          ///< how often it rests, at the start too
  /// The smallest distance of a decision between stick and slip from the other one, over the accelerations that take part.
  double margin = std::numeric_limits<double>::infinity();
  std::vector<Clearance> clearances;  ///< of the walls in the options
  CartEnergy energy;
  bool truncated = false;  ///< as ResponseOf::truncated
  std::string components = "axis";
  CartState state;
};

}  // namespace stickslip
