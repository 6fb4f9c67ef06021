// A slider in the plane whose law is known only when the program runs.
#pragma once

#include <functional>
#include <span>
#include <type_traits>
#include <variant>
#include <vector>

#include "stickslip/friction/laws.hpp"
#include "stickslip/ground/ground_motion.hpp"
#include "stickslip/planar/floor_motion.hpp"
#include "stickslip/planar/forces.hpp"
#include "stickslip/planar/histories.hpp"
#include "stickslip/planar/integrate.hpp"
#include "stickslip/planar/margins.hpp"
#include "stickslip/planar/response.hpp"
#include "stickslip/planar/segment.hpp"
#include "stickslip/planar/slider.hpp"
#include "stickslip/planar/state.hpp"
#include "stickslip/planar/trajectory.hpp"
#include "stickslip/sliding/any_slider.hpp"

namespace stickslip {

namespace detail {

template <class Law>
using IsIsotropic = std::bool_constant<IsotropicLaw<Law>>;
template <class... Laws>
std::variant<PlanarSlider<Laws>...> planar_sliders_of(LawList<Laws...>);  // for types only

}  // namespace detail

/// The laws of the library that can be the same in all directions.
using PlanarLaws = LibraryLaws::where<detail::IsIsotropic>;

/// A slider in the plane of any of these laws. The library contains all computations for it, compiled, as for
/// AnySlider.
using AnyPlanarSlider = decltype(detail::planar_sliders_of(PlanarLaws()));

/// The same law and mounting in the plane.
/// @throws std::invalid_argument  a law that is not the same in all directions, `one_way`, or stops with unequal gaps
AnyPlanarSlider planar(const AnySlider& slider);

/// The same law and mounting on one axis.
AnySlider along_axis(const AnyPlanarSlider& slider);

/// The mounting of a slider of any law.
inline const Mounting& mounting_of(const AnyPlanarSlider& slider) {
  return std::visit([](const auto& one) -> const Mounting& { return one.mounting(); }, slider);
}

/// As the template of the same name.
PlanarResponse integrate(const AnyPlanarSlider& slider, const GroundMotion& motion,
                         const PlanarIntegrateOptions& options = {}, PlanarResponse storage = {});

/// As the template of the same name.
PlanarHistories histories(const AnyPlanarSlider& slider, const GroundMotion& motion,
                          const std::function<void()>& progress = {});

/// As the template of the same name, with a function that is called now and then during a long segment, and may throw.
void advance(const AnyPlanarSlider& slider, const PlanarSegment& segment, PlanarState& state,
             Contact contact = Contact::flight, const std::function<void()>& progress = {});
void advance(const AnyPlanarSlider& slider, const PlanarLoadSegment& segment, PlanarState& state,
             Contact contact = Contact::flight, const std::function<void()>& progress = {});

/// As the templates of the same names.
PlanarForces forces(const AnyPlanarSlider& slider, const GroundMotion& motion, const PlanarResponse& response);
Margins margins(const AnyPlanarSlider& slider, const GroundMotion& motion, const PlanarResponse& response);
std::vector<PlanarState> states_at(const AnyPlanarSlider& slider, const GroundMotion& motion,
                                   const PlanarResponse& response, std::span<const double> times);
PlanarFloorMotion floor_motion(const AnyPlanarSlider& slider, const GroundMotion& motion,
                               const PlanarResponse& response, double tolerance = 1e-6);

}  // namespace stickslip
