// Simulates members that slide in the plane.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <variant>
#include <vector>

#include "stickslip/ensemble/detail/block.hpp"
#include "stickslip/ensemble/detail/simulator.hpp"
#include "stickslip/ensemble/member.hpp"
#include "stickslip/ground/ground_motion.hpp"
#include "stickslip/planar/any_planar_slider.hpp"
#include "stickslip/planar/detail/radius.hpp"
#include "stickslip/planar/integrate.hpp"
#include "stickslip/planar/path.hpp"
#include "stickslip/sliding/impacts.hpp"

namespace stickslip::detail {

/// The output of one member of a block in the plane.
struct PlanarMemberPlace {
  MemberPlace axis, transverse;  ///< of the components of r and r'

  Block& block() const noexcept { return axis.block; }
  void keep(std::size_t time, const PlanarState& state) const noexcept {
    axis.keep(time, state.displacement.axis, state.velocity.axis);
    transverse.keep(time, state.displacement.transverse, state.velocity.transverse);
  }
  void end(double peak, Vector2 residual) const noexcept {
    axis.end(peak, residual.axis);
    block().residual_transverse()[axis.index] = residual.transverse;
  }
};

/// Keeps the impacts on the circular stop as impacts forward; their speed is the radial velocity.
class PlanarPeakObserver final : public PlanarSink, public MemberTally {
 public:
  using MemberTally::MemberTally;

  void follow(const PlanarPath& path, double last, double) override {
    count_work();
    double where = last;
    reach(largest_radius(path, last, peak(), where));
  }
  void event(EventKind kind, double, const PlanarState& state) override {
    const double radius = norm(state.displacement);
    count_event(kind, radius, radius > 0 ? dot(state.displacement, state.velocity) / radius : 0);
  }
};

/// Simulate one member from rest at r = 0, by the event loop of `advance`. A member may end in flight.
/// @param settle  whether to continue without ground acceleration until it comes to rest
/// @throws std::invalid_argument  the ground motion has no transverse component
inline void simulate_member(const PlanarEngine& engine, const GroundMotion& motion, bool settle, Contact contact,
                            const PlanarMemberPlace& place) {
  Block& block = place.block();
  const PlanarPieces pieces(motion, engine.mounting().slope());
  PlanarState state;
  PlanarPeakObserver observer(block, max_events(motion.segments() + block.times().count));
  const auto go = [&](const PlanarLoadSegment& segment) { engine.move(segment, contact, state, observer); };
  go_through(pieces, motion.segments(), block, go, [&](std::size_t time) { place.keep(time, state); });
  if (settle)
    detail::settle(engine, state, [&](double duration) {
      block.check_stopped();
      engine.calm(duration, contact, state, observer);
    });
  place.end(observer.peak(), state.displacement);
  constexpr double none = std::numeric_limits<double>::infinity();
  if (const Stops& stops = engine.mounting().stops)
    block.impacts(place.axis.index, {stops.forward(), none}, observer.impacts());
  if (state.in_flight) block.ends_airborne();
}

template <IsotropicLaw Law>
void simulate_member(const PlanarSlider<Law>& slider, const GroundMotion& motion, bool settle, Contact contact,
                     const PlanarMemberPlace& place) {
  simulate_member(PlanarEngineOf(slider), motion, settle, contact, place);
}

/// The same for a slider of any law, compiled in the library.
void simulate_member(const AnyPlanarSlider& slider, const GroundMotion& motion, bool settle, Contact contact,
                     const PlanarMemberPlace& place);

/// Simulates any members in the plane, one after the other.
template <MemberSource Source>
class PlanarMemberSimulator final : public Simulator {
 public:
  /// @param source  held by reference
  PlanarMemberSimulator(const Source& source, std::uint64_t seed, bool settle, Contact contact)
      : source_(source), seed_(seed), settle_(settle), contact_(contact) {}

  void simulate(std::uint64_t first_member, std::size_t members, Block& block) override {
    const std::size_t times = block.times().count, width = block.width();
    for (auto* values : {&x_, &vx_, &y_, &vy_}) values->resize(times * width);
    for (std::size_t i = 0; i < members; ++i) {
      const auto& member = source_.member(seed_, first_member + i);
      naming_member(first_member + i, [&] {
        const PlanarMemberPlace place{{block, i, x_.data(), vx_.data()}, {block, i, y_.data(), vy_.data()}};
        simulate_member(member.slider, member.motion, settle_, contact_, place);
      });
    }
    for (std::size_t k = 0; k < times; ++k)
      block.row(k, {&x_[k * width], &vx_[k * width]}, {&y_[k * width], &vy_[k * width]});
  }

 private:
  const Source& source_;
  std::uint64_t seed_;
  bool settle_;
  Contact contact_;
  std::vector<double> x_, vx_, y_, vy_;  // by time and member
};

}  // namespace stickslip::detail
