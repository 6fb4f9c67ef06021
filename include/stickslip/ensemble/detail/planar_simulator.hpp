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
#include "stickslip/planar/integrate.hpp"
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

/// Computes the largest |r| and the impacts of a member, and checks regularly whether the run was stopped.
class PlanarPeakObserver final : public PlanarSink {
 public:
  PlanarPeakObserver(const Block& block, std::size_t event_limit) : block_(block), event_limit_(event_limit) {}

  double peak() const noexcept { return peak_; }
  /// Those on the circular stop, as impacts forward; their speed is the radial velocity.
  const Impacts& impacts() const noexcept { return impacts_; }

  void follow(const PlanarSlipFlow& flow, double last, double) override {
    count_work();
    double where = last;
    peak_ = std::max(peak_, flow.largest_radius(last, peak_, where));
  }
  void event(EventKind kind, double, const PlanarState& state) override {
    if (kind == EventKind::impact) {
      const double radius = norm(state.displacement);
      impacts_.add(radius, dot(state.displacement, state.velocity) / radius);
    }
    count_work();
    if (++events_ > event_limit_) refuse_more_events(event_limit_);
  }

 private:
  void count_work() {
    if (++work_ % PlanarRecorder::work_per_report == 0) block_.check_stopped();
  }
  const Block& block_;
  std::size_t event_limit_, events_ = 0;
  std::uint32_t work_ = 0;
  double peak_ = 0;
  Impacts impacts_;
};

/// Simulate one member from rest at r = 0, by the event loop of `advance`. A member may end in flight.
/// @param settle  whether to continue without ground acceleration until it comes to rest
/// @throws std::invalid_argument  the ground motion has no transverse component
template <IsotropicLaw Law>
void simulate_member(const PlanarSlider<Law>& slider, const GroundMotion& motion, bool settle, Contact contact,
                     const PlanarMemberPlace& place) {
  Block& block = place.block();
  const PlanarPieces pieces(motion, slider.slope());
  PlanarState state;
  PlanarPeakObserver observer(block, max_events(motion.segments() + block.times().count));
  const auto go = [&](const PlanarLoadSegment& segment) { advance_plane(slider, segment, contact, state, observer); };
  go_through(pieces, motion.segments(), block, go, [&](std::size_t time) { place.keep(time, state); });
  if (settle) {
    const Slope slope(slider.slope());
    detail::settle(slider, state, [&](double duration) {
      block.check_stopped();
      go(load_segment(PlanarSegment{duration, {}, {}}, slope));
    });
  }
  place.end(observer.peak(), state.displacement);
  constexpr double none = std::numeric_limits<double>::infinity();
  if (const Stops& stops = slider.mounting().stops)
    block.impacts(place.axis.index, {stops.forward(), none}, observer.impacts());
  if (state.in_flight) block.ends_airborne();
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
