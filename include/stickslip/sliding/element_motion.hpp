// The motion of the elements of a pendulum with several surfaces.
#pragma once

#include <cmath>
#include <cstddef>
#include <optional>
#include <vector>

#include "stickslip/base/min_max.hpp"
#include "stickslip/friction/multi_pendulum.hpp"
#include "stickslip/friction/pendulum_loop.hpp"
#include "stickslip/numerics/gauss_legendre.hpp"
#include "stickslip/slider/slider.hpp"
#include "stickslip/sliding/trajectory.hpp"
#include "stickslip/state/state.hpp"

namespace stickslip {

/// The motion of the elements of a MultiPendulum, in their order, and of its surfaces, from bottom to top.
struct ElementMotion {
  std::vector<std::vector<double>> displacement;  ///< of each element at the samples [m]
  std::vector<std::vector<double>> surfaces;      ///< the same of each surface [m]
  std::vector<double> dissipated;                 ///< work against friction per unit mass [m^2/s^2]
  std::vector<double> sliding_distance;           ///< [m]
  std::vector<double> peak;                       ///< largest |u_k| over all time [m]
  std::vector<double> surface_peak;               ///< the same of each surface [m]
  std::vector<std::size_t> slides;                ///< how many times the element began to move in one direction
  std::vector<std::size_t> stops;                 ///< how many times it came to its stop
  std::vector<std::size_t> surface_stops;         ///< the same of each surface
};

namespace detail {

class ElementReader final : public TrajectoryReader {
 public:
  ElementReader(const MultiPendulum& law, const Trajectory& trajectory) : law_(law), trajectory_(trajectory) {
    const std::size_t count = law.elements().size(), samples = trajectory.response().displacement.size();
    for (auto* histories : {&motion_.displacement, &motion_.surfaces})
      histories->assign(count, std::vector<double>(samples));
    for (auto* sums : {&motion_.dissipated, &motion_.sliding_distance, &motion_.peak, &motion_.surface_peak})
      sums->assign(count, 0);
    motion_.slides.assign(count, 0);
    motion_.stops.assign(count, 0);
    motion_.surface_stops.assign(count, 0);
  }

  void arc(const Arc& arc) override {
    share_landing(arc.start.velocity);
    if (sample_ == 0) {
      last_ = arc.start;
      keep();
    }
    while (sample_ < samples() && trajectory_.time(sample_) < arc.end)
      store(arc.at(std::max(trajectory_.time(sample_) - arc.begin, 0.0)));
    last_ = arc.at(arc.duration);
    if (arc.rests()) return;
    const Direction direction = direction_of(arc.start.mode);
    const unsigned moving = law_.moving(arc.start.pendulum, direction), begin = moving & ~moving_;
    moving_ = moving;
    // The integral of N+/g over the way; 10-point Gauss-Legendre quadrature is exact for the motion during an arc.
    const double first = arc.weight(0), last = arc.weight(arc.duration);
    const double pressed =
        equal(first, 1) && equal(last, 1) ? arc.distance : numerics::gauss_integral<10>(0, arc.duration, [&](double t) {
          return arc.weight(t) * std::abs(arc.at(t).velocity);
        });
    const unsigned stops = arrivals(law_, arc.start.pendulum, last_.pendulum, moving, direction);
    for (std::size_t k = 0; k < motion_.peak.size(); ++k) {
      const int element = static_cast<int>(k);
      const double part = law_.share(moving, element);
      if (!(part > 0)) continue;
      motion_.dissipated[k] += standard_gravity * law_.elements()[k].mu * part * pressed;
      motion_.sliding_distance[k] += part * arc.distance;
      motion_.slides[k] += begin >> k & 1;
      motion_.stops[k] += stops >> k & 1;
      motion_.surface_stops[law_.surface_of(k)] += stops >> k & 1;  // a surface is at its stop where its element is
    }
    keep();
  }
  void event(EventKind kind, double, const State& state, const Load&) override {
    share_landing(state.velocity);
    if (kind == EventKind::landing && state.mode != Mode::stuck) landed_ = state;
    if (kind != EventKind::liftoff && kind != EventKind::landing) moving_ = 0;
  }

  ElementMotion finish() {
    while (sample_ < samples()) store(trajectory_.response().state);
    return std::move(motion_);
  }

 private:
  std::size_t samples() const { return motion_.displacement.front().size(); }

  // The impulse of a landing slows the slider down: friction in the elements that move.
  void share_landing(double velocity) {
    if (!landed_) return;
    const State& before = *landed_;
    const double lost = (before.velocity * before.velocity - velocity * velocity) / 2;
    const unsigned moving = law_.moving(before.pendulum, direction_of(before.mode));
    double whole = 0;
    for (std::size_t k = 0; k < motion_.peak.size(); ++k) whole += friction(moving, k);
    for (std::size_t k = 0; k < motion_.peak.size() && whole > 0; ++k)
      motion_.dissipated[k] += lost * (friction(moving, k) / whole);
    landed_.reset();
  }
  double friction(unsigned moving, std::size_t k) const {
    return law_.share(moving, static_cast<int>(k)) * law_.elements()[k].mu;
  }

  void store(const State& state) {
    const std::vector<double> elements = law_.displacements(state.pendulum), surfaces = law_.surfaces(elements);
    for (std::size_t k = 0; k < elements.size(); ++k) {
      motion_.displacement[k][sample_] = elements[k];
      motion_.surfaces[k][sample_] = surfaces[k];
    }
    ++sample_;
  }
  void keep() {
    const std::vector<double> elements = law_.displacements(last_.pendulum), surfaces = law_.surfaces(elements);
    for (std::size_t k = 0; k < elements.size(); ++k) {
      motion_.peak[k] = std::max(motion_.peak[k], std::abs(elements[k]));
      motion_.surface_peak[k] = std::max(motion_.surface_peak[k], std::abs(surfaces[k]));
    }
  }

  const MultiPendulum& law_;
  const Trajectory& trajectory_;
  ElementMotion motion_;
  State last_;
  std::optional<State> landed_{};  // before the impulse
  unsigned moving_ = 0;            // the elements that move since the last event
  std::size_t sample_ = 0;
};

}  // namespace detail

/// The motion of the elements of a pendulum during a response.
/// @param law         of the slider that moves
/// @param trajectory  of the response
/// As exact as `integrate`, which it repeats: the cost is twice that.
inline ElementMotion element_motion(const MultiPendulum& law, const Trajectory& trajectory) {
  detail::ElementReader reader(law, trajectory);
  trajectory.read(reader, trajectory.end());
  return reader.finish();
}

}  // namespace stickslip
