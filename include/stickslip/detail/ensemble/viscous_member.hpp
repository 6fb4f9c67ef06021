// The viscous slider as a member of an ensemble.
#pragma once

#include <cmath>
#include <cstddef>
#include <stdexcept>

#include "stickslip/detail/ensemble/simulator.hpp"
#include "stickslip/viscous.hpp"

namespace stickslip::detail {

/// @throws std::invalid_argument  `settle`
inline void refuse_to_settle(const ViscousSlider&, bool settle) {
  if (settle) throw std::invalid_argument("run_ensemble: settle must be false, a ViscousSlider never comes to rest");
}

inline void simulate_member(const ViscousSlider& slider, const GroundMotion& motion, bool settle,
                            const MemberPlace& place) {
  refuse_to_settle(slider, settle);
  ViscousStep step(slider, 0);
  ViscousMotion moving(slider, 0, 0);
  const auto go = [&](const Segment& segment) {
    const double pieces = moving.pieces(segment.duration), slope = (segment.start - segment.end) / segment.duration;
    if (step.duration != segment.duration / pieces) step = ViscousStep(slider, segment.duration / pieces);
    for (double piece = 0; piece < pieces; ++piece) {
      moving.advance(step, -segment.start + slope * (piece * step.duration), slope);
      if (std::fmod(piece, 1024) == 1023) place.block.beat();
    }
  };
  go_through(
      motion, place.block, [&](const Segment& segment) { segment.duration > 0 ? go(segment) : void(); },
      [&](std::size_t time) { place.keep(time, moving.displacement(), moving.velocity()); });
  place.end(moving.peak(), moving.displacement());
}

}  // namespace stickslip::detail
