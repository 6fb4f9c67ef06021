#include "stickslip/structure/trajectory.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <utility>

#include "stickslip/run/detail/largest.hpp"
#include "stickslip/run/detail/reading.hpp"
#include "structure/modal_interface.hpp"
#include "structure/move.hpp"
#include "structure/recorder.hpp"

namespace stickslip {
namespace {

using detail::Expansion;
using detail::StructureReader;
using detail::value_at;

// Shows the motion of a response to a reader.
void read(const SlidingStructure& system, const GroundMotion& motion, const StructureResponse& response,
          StructureReader& reader) {
  StructureIntegrateOptions options;
  options.displacement = response.initial_state.displacement;
  options.velocity = response.initial_state.velocity;
  options.settle = response.settled;
  options.sliding_distance = response.initial_state.sliding_distance;
  options.heat = response.initial_state.heat;
  options.floors = false;
  detail::integrate(system, motion, options, &reader);
}

class StatesAt final : public StructureReader {
 public:
  StatesAt(const SlidingStructure& system, std::span<const double> times, std::vector<std::size_t> order)
      : StructureReader(false), states(times.size()), system_(system), times_(times), order_(std::move(order)) {}

  void segment(double begin, double end, const LoadSegment& whole, const StructureState& start) override {
    if (next_ == order_.size() || !(times_[order_[next_]] < end)) return;
    StructureState state = start;
    double now = 0;
    for (; next_ < order_.size() && times_[order_[next_]] < end; ++next_) {
      const std::size_t i = order_[next_];
      const double then = std::clamp(times_[i] - begin, now, whole.duration);
      const LoadSegment part{then - now, whole.load(now), whole.load(then), whole.normal(now), whole.normal(then)};
      if (part.duration > 0) advance(system_, part, state);
      now = then;
      states[i] = state;
    }
  }

  /// The rest have the state at the end.
  void finish(const StructureState& last) {
    for (; next_ < order_.size(); ++next_) states[order_[next_]] = last;
  }

  std::vector<StructureState> states;

 private:
  const SlidingStructure& system_;
  std::span<const double> times_;
  std::vector<std::size_t> order_;
  std::size_t next_ = 0;
};

class Curve final : public StructureReader {
 public:
  Curve() : StructureReader(true) {}

  void arc(double begin, double end, const Expansion& motion, Mode mode) override {
    const int parts = mode == Mode::stuck ? 2 : 4;
    const detail::Polynomial forces = motion.force(mode);
    for (int i = 0; i <= parts; ++i) {
      const double u = static_cast<double>(i) / parts, force = value_at(forces.data(), motion.order(), u);
      const InterfacePoint next{std::min(begin + u * motion.duration(), end),
                                value_at(motion.displacement(), motion.order(), u), force};
      if (i > 0 || points.empty() || std::abs(points.back().force - force) > 1e-12 * std::abs(force))
        points.push_back(next);
    }
  }

  std::vector<InterfacePoint> points;
};

class LargestForce final : public StructureReader {
 public:
  LargestForce(double begin, double displacement) : StructureReader(true), peak{begin, displacement, 0} {}

  void arc(double begin, double end, const Expansion& motion, Mode mode) override {
    const detail::Polynomial forces = motion.force(mode);
    const int order = motion.order();
    const double largest = detail::largest_magnitude(forces.data(), order, std::abs(peak.force));
    if (!(largest > (1 + 1e-13) * std::abs(peak.force))) return;
    double most = 0, where = 0;
    detail::look_for_largest(1, 16, largest, [&](double u) {
      const double force = std::abs(value_at(forces.data(), order, u));
      if (force > (1 + 1e-13) * most) most = force, where = u;
      return force;
    });
    peak = {std::min(begin + where * motion.duration(), end), value_at(motion.displacement(), order, where),
            std::copysign(largest, value_at(forces.data(), order, where))};
  }

  InterfacePoint peak;
};

// Sums the distance slid, and the work on friction and damper, between two times.
class Swing final : public StructureReader {
 public:
  Swing(double from, double to) : StructureReader(true), from_(from), to_(to) {}

  void arc(double begin, double end, const Expansion& motion, Mode mode) override {
    const double middle = std::midpoint(begin, end);
    if (mode == Mode::stuck || !(middle > from_ && middle < to_)) return;
    const double s = static_cast<double>(static_cast<int>(mode));
    distance += motion.distance(s, 1);
    work += motion.friction_work(s) + motion.damper_work();
    force = value_at(motion.pull(), motion.order(), 1) + s * value_at(motion.friction(), motion.order(), 1);
  }

  double distance = 0, work = 0;
  double force = 0;  // of spring and friction at the end [m/s^2]

 private:
  double from_, to_;
};

}  // namespace

std::vector<StructureState> states_at(const SlidingStructure& system, const GroundMotion& motion,
                                      const StructureResponse& response, std::span<const double> times) {
  StatesAt reader(system, times,
                  detail::order_of(times, motion.time(0), response.events.back().time,
                                   motion.time(response.displacement.size() - 1)));
  if (!times.empty()) read(system, motion, response, reader);
  reader.finish(response.final_state);
  return std::move(reader.states);
}

std::vector<InterfacePoint> interface_loops(const SlidingStructure& system, const GroundMotion& motion,
                                            const StructureResponse& response) {
  Curve reader;
  read(system, motion, response, reader);
  return std::move(reader.points);
}

InterfacePoint peak_force(const SlidingStructure& system, const GroundMotion& motion,
                          const StructureResponse& response) {
  LargestForce reader(motion.time(0), response.displacement.front());
  read(system, motion, response, reader);
  return reader.peak;
}

Loop largest_loop(const SlidingStructure& system, const GroundMotion& motion, const StructureResponse& response) {
  bool has_spring = system.modal().spring.stiffness > 0;
  detail::with_interface_law(system.slider(),
                             [&]<class Law>(const Law&) { has_spring |= detail::LawWithSprings<Law>; });
  const detail::HalfCycle half = detail::half_cycle(response, has_spring, 0);
  Swing swing(response.events[half.turn].time, response.events[half.peak].time);
  read(system, motion, response, swing);
  return half.loop(swing.force, swing.work, swing.distance);
}

}  // namespace stickslip
