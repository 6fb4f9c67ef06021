// Many sliders in the plane under many ground motions.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "stickslip/base/equal.hpp"
#include "stickslip/base/vector2.hpp"
#include "stickslip/ground/ground_motion.hpp"
#include "stickslip/planar/integrate.hpp"
#include "stickslip/planar/response.hpp"
#include "stickslip/planar/slider.hpp"
#include "stickslip/sliding/impacts.hpp"
#include "stickslip/sweep/sweep.hpp"

namespace stickslip {

/// The results of a sweep in the plane. Impacts are those on circular stops, with radial speeds.
using PlanarSweepTable = SweepTableOf<Vector2, SideImpacts>;

namespace detail {

template <class S>
inline constexpr bool is_planar_slider = false;
template <class Law>
inline constexpr bool is_planar_slider<PlanarSlider<Law>> = true;
template <class... Laws>
inline constexpr bool is_planar_slider<std::variant<PlanarSlider<Laws>...>> = true;

/// One slider of a sweep in the plane.
struct PlanarSweepSlider {
  bool mirrors, has_stops;
  std::function<PlanarResponse(const GroundMotion&, const PlanarIntegrateOptions&, PlanarResponse)> integrate;
};

PlanarSweepTable sweep(std::span<const PlanarSweepSlider> sliders, std::span<const GroundMotion* const> motions,
                       const SweepOptions& options);

}  // namespace detail

/// Whether the response to -n(t), -t(t) is minus the response to n(t), t(t): the ground is level.
template <IsotropicLaw Law>
bool mirrors(const PlanarSlider<Law>& slider) {
  return detail::equal(slider.mounting().slope_degrees, 0);
}

/// Integrate many sliders in the plane under many ground motions, from rest at r = 0, each combination as by
/// `integrate`; see PlanarSlider for the equation.
///
/// @param sliders  PlanarSliders of one law, or each an AnyPlanarSlider
/// @param motions  records with a transverse component, of any lengths and steps. `reversed` reverses both horizontal
///                 components. On level ground it mirrors the response, which is then computed once, with the same bits
///                 for any polarity
/// @param options  polarity, whether to continue until the sliders rest, threads
/// @return peak, residual, sliding distance, number of events and impacts on stops of each. A slider that is in flight
///         at the end of the motion counts with its state there. A combination that fails (a motion without a
///         transverse component, a slider that does not come to rest, a motion beyond the range of doubles) is NaN, and
///         `failures` has the reason; the sweep continues
///
/// Cost: that of `integrate` for each combination, on all threads. The bits are the same for any number of threads.
template <class P>
requires detail::is_planar_slider<P> PlanarSweepTable sweep(const std::vector<P>& sliders,
                                                            const std::vector<const GroundMotion*>& motions,
                                                            const SweepOptions& options = {}) {
  std::vector<detail::PlanarSweepSlider> these;
  const auto add = [&](const auto& slider, const auto& one) {
    these.push_back({mirrors(one), static_cast<bool>(one.mounting().stops),
                     [&slider](const GroundMotion& motion, const PlanarIntegrateOptions& how, PlanarResponse storage) {
                       return integrate(slider, motion, how, std::move(storage));
                     }});
  };
  for (const P& slider : sliders)
    if constexpr (requires { slider.mounting(); })
      add(slider, slider);
    else
      std::visit([&](const auto& one) { add(slider, one); }, slider);
  return detail::sweep(these, motions, options);
}
template <class P>
requires detail::is_planar_slider<P> PlanarSweepTable sweep(const std::vector<P>& sliders,
                                                            const std::vector<GroundMotion>& motions,
                                                            const SweepOptions& options = {}) {
  std::vector<const GroundMotion*> these;
  for (const GroundMotion& motion : motions) these.push_back(&motion);
  return sweep(sliders, these, options);
}

}  // namespace stickslip
