// Long records, in pieces side by side; of the compiled library.
#pragma once

#include <cmath>

#include "stickslip/detail/equal.hpp"
#include "stickslip/detail/min_max.hpp"
#include "stickslip/detail/recorder.hpp"
#include "stickslip/friction/coulomb.hpp"
#include "stickslip/ground/ground_motion.hpp"
#include "stickslip/slider.hpp"
#include "stickslip/state.hpp"

namespace stickslip::detail {

struct HistorySpans;

/// Coulomb friction without a spring forgets where it came from when it sticks: two motions of it that are stuck at the
/// same sample are the same from there on, but for a constant in x. So a long record is cut in pieces, which start from
/// rest and are computed side by side, in vector lanes; then each is done again from its true beginning, until both
/// are stuck.
/// @pre worth_pieces
void run_by_pieces(const Coulomb& law, const GroundMotion& motion, State& state, Recorder<Coulomb>& recorder,
                   const HistorySpans& histories);
void run_by_pieces(const Coulomb& law, const GroundMotion& motion, State& state, NoRecorder& none,
                   const HistorySpans& histories);

/// Whether that is possible and quicker. The lanes take squares of speeds and accelerations, which must not underflow;
/// above a slip level of that size no load does that matters.
inline bool worth_pieces(const Slider<Coulomb>& slider, const GroundMotion& motion) noexcept {
  return equal(slider.stiffness(), 0) && equal(slider.damping(), 0) && std::isfinite(motion.dt()) &&
         motion.samples() >= 8192 && std::min(slider.law().forward(), slider.law().backward()) > 1e-100 &&
         motion.peak_acceleration() > 1e-100 && motion.dt() > 1e-100;
}

}  // namespace stickslip::detail
