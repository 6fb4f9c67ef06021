// Long records, divided into pieces that are integrated in parallel; part of the compiled library.
#pragma once

#include <cmath>

#include "stickslip/base/equal.hpp"
#include "stickslip/base/min_max.hpp"
#include "stickslip/friction/coulomb.hpp"
#include "stickslip/ground/ground_motion.hpp"
#include "stickslip/slider.hpp"
#include "stickslip/sliding/detail/recorder.hpp"
#include "stickslip/state.hpp"

namespace stickslip::detail {

struct HistorySpans;

/// A block with Coulomb friction and no spring loses its memory when it sticks: two motions that are stuck at the same
/// sample are identical from then on, except for a constant in x. A long record is therefore divided into pieces, which
/// start from rest and are integrated in parallel vector lanes. Each piece is then integrated again from its true
/// initial state, until both motions are stuck.
/// @pre worth_pieces
void run_by_pieces(const Coulomb& law, const GroundMotion& motion, State& state, Recorder<Coulomb>& recorder,
                   const HistorySpans& histories);
void run_by_pieces(const Coulomb& law, const GroundMotion& motion, State& state, NoRecorder& none,
                   const HistorySpans& histories);

/// Whether this is possible and faster. The lanes square speeds and accelerations, which must not underflow; above this
/// slip level no relevant load does.
inline bool worth_pieces(const Slider<Coulomb>& slider, const GroundMotion& motion) noexcept {
  return equal(slider.stiffness(), 0) && equal(slider.damping(), 0) && std::isfinite(motion.dt()) &&
         motion.samples() >= 8192 && std::min(slider.law().forward(), slider.law().backward()) > 1e-100 &&
         motion.peak_acceleration() > 1e-100 && motion.dt() > 1e-100;
}

}  // namespace stickslip::detail
