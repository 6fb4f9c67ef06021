// The force of a pendulum with several surfaces under an imposed displacement.
#pragma once

#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

#include "stickslip/base/error.hpp"
#include "stickslip/friction/multi_pendulum.hpp"
#include "stickslip/state/state.hpp"

namespace stickslip {

/// The force of a MultiPendulum along a slow path of its displacement.
struct PendulumLoop {
  /// Where the stiffness or the force changes: at a join, at a stop, and where the path turns.
  struct Corner {
    double displacement;  ///< [m]
    double force;         ///< F/N
    unsigned moving;  ///< the surfaces that slide from here on, or up to the turn or the end; a bit each, from bottom
  };
  std::vector<double> force;    ///< F/N at each point of the path, on arrival
  std::vector<Corner> corners;  ///< from the start of the first motion on; two at one place: the force jumps
  std::vector<std::vector<double>> displacement;  ///< of each element at each point [m]
  std::vector<std::vector<double>> surfaces;      ///< of each surface, from bottom to top, at each point [m]
  std::vector<double> dissipated;                 ///< work against friction by each element, over the weight [m]
  std::vector<double> sliding_distance;           ///< of each element [m]
  std::vector<std::size_t> slides;                ///< how many times each element began to move in one direction
  std::vector<std::size_t> stops;                 ///< how many times it came to its stop
  std::vector<std::size_t> surface_stops;         ///< the same of each surface
};

namespace detail {

/// Whether an element is at its stop in a direction, up to the round-off of its motion, by which it may miss the
/// memory's flag.
inline bool at_stop(const MultiPendulum& law, const PendulumMemory& memory, std::size_t k,
                    Direction direction) noexcept {
  const double most = law.elements()[k].capacity;
  return most - sign(direction) * law.displacement(memory, static_cast<int>(k)) <= 0x1p-40 * most;
}

/// The elements of those that move which come to their stops between two places, one bit each.
inline unsigned arrivals(const MultiPendulum& law, const PendulumMemory& from, const PendulumMemory& to,
                         unsigned moving, Direction direction) noexcept {
  unsigned found = 0;
  for (std::size_t k = 0; k < law.elements().size(); ++k)
    if ((moving >> k & 1) && at_stop(law, to, k, direction) && !at_stop(law, from, k, direction)) found |= 1U << k;
  return found;
}

}  // namespace detail

/// Impose a displacement on a bearing that starts at its center.
/// @param path  displacements, one after the other [m]: finite, within the capacity
/// @throws std::invalid_argument naming the value
inline PendulumLoop trace(const MultiPendulum& law, std::span<const double> path) {
  PendulumLoop loop;
  const std::size_t count = law.elements().size();
  loop.displacement.assign(count, {});
  loop.surfaces.assign(count, {});
  loop.dissipated.assign(count, 0);
  loop.sliding_distance.assign(count, 0);
  loop.slides.assign(count, 0);
  loop.stops.assign(count, 0);
  loop.surface_stops.assign(count, 0);
  const double most = law.capacity();
  State state;
  double arrived = 0;
  unsigned moved = 0;  // the elements that move since the last turn
  Mode before = Mode::stuck;
  for (std::size_t i = 0; i < path.size(); ++i) {
    const double to = path[i];
    detail::require(std::isfinite(to) && std::abs(to) <= most * (1 + 0x1p-50),
                    "trace: path[" + std::to_string(i) + "] must be finite and within the capacity of " +
                        detail::shortest(most) + " m",
                    to, "m");
    const double from = state.displacement;
    if (to > from || to < from) {
      const Direction direction = to > from ? Direction::forward : Direction::backward;
      state.mode = mode_of(direction);
      if (state.mode != before) moved = 0;
      before = state.mode;
      const auto slide_now = [&] { return law.sliding_surfaces(law.moving(state.pendulum, direction)); };
      loop.corners.push_back({from, law.force(state.pendulum, direction), slide_now()});
      for (double left = std::abs(to - from); left > 0;) {
        const double way = std::min(left, law.ahead(state, direction));
        const unsigned moving = law.moving(state.pendulum, direction);
        const unsigned begin = moving & ~moved;
        moved = moving;
        const double force = law.force_after(state.pendulum, direction, way);
        const PendulumMemory before_it = state.pendulum;
        law.slide(state, way);
        state.displacement += sign(direction) * way;
        left -= way;
        const unsigned stops = detail::arrivals(law, before_it, state.pendulum, moving, direction);
        for (std::size_t k = 0; k < count; ++k) {
          const double part = law.share(moving, static_cast<int>(k)) * way;
          if (!(part > 0)) continue;
          loop.dissipated[k] += law.elements()[k].mu * part;
          loop.sliding_distance[k] += part;
          loop.slides[k] += begin >> k & 1;
          loop.stops[k] += stops >> k & 1;
          loop.surface_stops[law.surface_of(k)] += stops >> k & 1;
        }
        arrived = force;
        const double then = law.force(state.pendulum, direction);
        const bool jumps = left > 0 && std::abs(then - force) > 0x1p-40 * std::abs(force);
        if (jumps || !(left > 0))
          loop.corners.push_back({left > 0 ? state.displacement : to, force, law.sliding_surfaces(moving)});
        if (left > 0) loop.corners.push_back({state.displacement, jumps ? then : force, slide_now()});
      }
      state.displacement = to;
    }
    loop.force.push_back(arrived);
    const std::vector<double> elements = law.displacements(state.pendulum), surfaces = law.surfaces(elements);
    for (std::size_t k = 0; k < count; ++k) {
      loop.displacement[k].push_back(elements[k]);
      loop.surfaces[k].push_back(surfaces[k]);
    }
  }
  return loop;
}

}  // namespace stickslip
