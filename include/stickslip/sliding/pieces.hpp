// Long records, in pieces side by side.
#pragma once

#include <algorithm>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <utility>

#include "stickslip/detail/recorder.hpp"
#include "stickslip/detail/run.hpp"
#include "stickslip/friction/coulomb.hpp"
#include "stickslip/ground/ground_motion.hpp"
#include "stickslip/slider.hpp"
#include "stickslip/sliding/integrate.hpp"
#include "stickslip/sliding/response.hpp"
#include "stickslip/state.hpp"

namespace stickslip {
namespace detail {

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
  return slider.stiffness() == 0 && slider.damping() == 0 && std::isfinite(motion.dt()) && motion.samples() >= 8192 &&
         std::min(slider.law().forward(), slider.law().backward()) > 1e-100 && motion.peak_acceleration() > 1e-100 &&
         motion.dt() > 1e-100;
}

}  // namespace detail

/// What `integrate` gives, sooner where it can: Coulomb friction without a spring under a long record of even steps is
/// cut in pieces that move side by side, in vector lanes (AVX-512, AVX2, SSE4, NEON, as the processor has). All else
/// is left to `integrate`. Needs the library; `integrate` is of the header-only core.
///
/// Arguments, answers, errors and accuracy are those of `integrate`. The last bits may differ, and with them what they
/// decide: whether a velocity that only touches zero stops there. Some 12 to 30 ns a sample with AVX2, where
/// `integrate` takes 20 to 42, and up to 7 MB of memory meanwhile.
template <FrictionLaw Law, Motion M>
Response integrate_by_pieces(const Slider<Law>& slider, const M& motion, const IntegrateOptions& options = {},
                             Response storage = {}) {
  if constexpr (std::same_as<Law, Coulomb> && std::same_as<M, GroundMotion>) {
    if (detail::worth_pieces(slider, motion))
      return detail::integrate_by(slider, motion, options, std::move(storage),
                                  [&](State& state, auto& recorder, const detail::HistorySpans& histories) {
                                    detail::run_by_pieces(slider.law(), motion, state, recorder, histories);
                                  });
  }
  return integrate(slider, motion, options, std::move(storage));
}

template <FrictionLaw Law, Motion M>
Response integrate_by_pieces(const Law& law, const M& motion, const IntegrateOptions& options = {},
                             Response storage = {}) {
  return integrate_by_pieces(Slider<Law>(law), motion, options, std::move(storage));
}

}  // namespace stickslip

#ifdef STICKSLIP_LIBRARY  // linked to: it holds these
namespace stickslip {
extern template Response integrate_by_pieces(const Slider<Coulomb>&, const GroundMotion&, const IntegrateOptions&,
                                             Response);
}  // namespace stickslip
#endif
