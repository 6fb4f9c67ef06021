// Forces, margins, floor motions and states of sliders of any law in the plane: readers of one motion.
#include "stickslip/planar/any_planar_slider.hpp"

namespace stickslip {
namespace {

// The event loop for all of them, compiled once for each law.
void trace(const AnyPlanarSlider& slider, const PlanarLoadSegment& segment, Contact contact, PlanarState& state,
           detail::PlanarTracer& tracer) {
  std::visit([&](const auto& one) { detail::advance_plane(one, segment, contact, state, tracer); }, slider);
}

struct NoReader final : PlanarTrajectoryReader {
  void segment(double, const PlanarLoadSegment&) override {}
  void arc(const PlanarArc&) override {}
};

}  // namespace

PlanarForces forces(const AnyPlanarSlider& slider, const GroundMotion& motion, const PlanarResponse& response) {
  return detail::planar_forces(
      motion, mounting_of(slider).slope(), response,
      [&](const PlanarLoadSegment& segment, PlanarState& state, detail::PlanarTracer& tracer) {
        trace(slider, segment, response.contact, state, tracer);
      },
      [&](const PlanarState& state, Vector2 load, double normal) {
        return std::visit([&](const auto& one) { return detail::force_on(one, state, load, normal); }, slider);
      });
}

Margins margins(const AnyPlanarSlider& slider, const GroundMotion& motion, const PlanarResponse& response) {
  const detail::PlanarLevels levels{
      [&](const PlanarState& state, double weight) {
        return std::visit([&](const auto& one) { return detail::hold_at(one, state, weight); }, slider);
      },
      [&](const PlanarState& state, double weight, double speed) {
        return std::visit([&](const auto& one) { return detail::resist_at(one, state, weight, speed); }, slider);
      }};
  return detail::planar_margins(
      mounting_of(slider), levels, motion, response,
      [&](const PlanarLoadSegment& segment, PlanarState& state, detail::PlanarTracer& tracer) {
        trace(slider, segment, response.contact, state, tracer);
      });
}

PlanarFloorMotion floor_motion(const AnyPlanarSlider& slider, const GroundMotion& motion,
                               const PlanarResponse& response, double tolerance) {
  const double slope = mounting_of(slider).slope();
  return detail::planar_floor(motion, slope, response, tolerance, [&](double until, PlanarTrajectoryReader& reader) {
    return detail::trace_plane(motion, slope, response, until, reader,
                               [&](const PlanarLoadSegment& segment, PlanarState& state, auto& tracer) {
                                 trace(slider, segment, response.contact, state, tracer);
                               });
  });
}

std::vector<PlanarState> states_at(const AnyPlanarSlider& slider, const GroundMotion& motion,
                                   const PlanarResponse& response, std::span<const double> times) {
  NoReader none;
  detail::PlanarTracer tracer(none);
  return detail::planar_states(motion, mounting_of(slider).slope(), response, times,
                               [&](const PlanarLoadSegment& segment, PlanarState& state) {
                                 trace(slider, segment, response.contact, state, tracer);
                               });
}

}  // namespace stickslip
