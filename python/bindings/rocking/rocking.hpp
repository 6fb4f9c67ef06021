// Blocks that rock, and their responses together with the block and the ground motion.
#pragma once

#include <optional>
#include <string>
#include <utility>

#include "parts.hpp"
#include "stickslip/rocking/response.hpp"
#include "stickslip/rocking/rocking_block.hpp"
#include "stickslip/rocking/sensitivity.hpp"
#include "stickslip/rocking/slender_block.hpp"

namespace stickslip::python {

template <>
inline constexpr auto parts<SlenderBlock> = std::tuple(&SlenderBlock::p, &SlenderBlock::alpha_right,
                                                       &SlenderBlock::alpha_left, &SlenderBlock::restitution);
template <>
inline constexpr auto parts<RockingBlockSize> = std::tuple(&RockingBlockSize::width, &RockingBlockSize::height,
                                                           &RockingBlockSize::mu, &RockingBlockSize::restitution,
                                                           &RockingBlockSize::lever, &RockingBlockSize::center,
                                                           &RockingBlockSize::gyration_radius);
template <>
inline constexpr auto parts<RockingBlock> = std::tuple(&RockingBlock::size);
template <>
inline constexpr auto parts<RockingState> = std::tuple(&RockingState::rotation, &RockingState::rate,
                                                       &RockingState::mode, &RockingState::overturned,
                                                       &RockingState::slip, &RockingState::displacement,
                                                       &RockingState::velocity, &RockingState::rise,
                                                       &RockingState::climb);
template <>
inline constexpr auto parts<RockingSensitivity> = std::tuple(&RockingSensitivity::peak, &RockingSensitivity::rotation,
                                                             &RockingSensitivity::rate);
template <>
inline constexpr auto parts<RockingEvent> = std::tuple(&RockingEvent::time, &RockingEvent::rotation,
                                                       &RockingEvent::rate, &RockingEvent::kind,
                                                       &RockingEvent::rate_after, &RockingEvent::displacement,
                                                       &RockingEvent::speed, &RockingEvent::side);
template <>
inline constexpr auto parts<RockingResponse> = std::tuple(
    &RockingResponse::rotation, &RockingResponse::rate, &RockingResponse::events, &RockingResponse::peak,
    &RockingResponse::peak_time, &RockingResponse::peak_ratio, &RockingResponse::overturned,
    &RockingResponse::overturned_at, &RockingResponse::impacts, &RockingResponse::uplifts, &RockingResponse::liftoffs,
    &RockingResponse::impacts_with_slip, &RockingResponse::displacement, &RockingResponse::top_displacement,
    &RockingResponse::gap, &RockingResponse::residual, &RockingResponse::sliding_distance,
    &RockingResponse::time_sliding, &RockingResponse::time_rocking, &RockingResponse::energy, &RockingResponse::margin,
    &RockingResponse::condition, &RockingResponse::truncated, &RockingResponse::components, &RockingResponse::state);

/// The name of a side, +1 or -1; nothing for 0.
inline std::optional<std::string> side_name(int side) {
  if (side == 0) return std::nullopt;
  return side > 0 ? "right" : "left";
}

/// The Python class RockingEnergy: `dissipated` is friction, `damped` the fall on the side, `elastic` the potential energy.
struct RockingEnergy {
  Energy energy;
  bool per_mass;
};

struct RockingResponseWithInputs {
  RockingResponse response;
  py::object block;
  py::object motion;
  py::object time{}, events{};  // arrays, made on first access

  RockingResponseWithInputs(RockingResponse&& answer, py::object what, py::object under)
      : response(std::move(answer)), block(std::move(what)), motion(std::move(under)) {}
};

template <>
inline constexpr auto parts<RockingEnergy> = std::tuple(&RockingEnergy::energy, &RockingEnergy::per_mass);
template <>
inline constexpr auto parts<RockingResponseWithInputs> = std::tuple(&RockingResponseWithInputs::response,
                                                                    &RockingResponseWithInputs::block,
                                                                    &RockingResponseWithInputs::motion);

void bind_slender_block(py::module_& m);
void bind_rocking_block(py::module_& m);
void bind_rocking_advance(py::module_& m);
void bind_rocking_response(py::module_& m);
void bind_rocking_outcomes(py::module_& m);

}  // namespace stickslip::python
