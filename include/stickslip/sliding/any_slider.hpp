// A slider whose law is known only when the program runs.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <variant>

#include "stickslip/friction/laws.hpp"
#include "stickslip/ground/ground_motion.hpp"
#include "stickslip/ground/harmonic_motion.hpp"
#include "stickslip/ground/segment.hpp"
#include "stickslip/slider/slider.hpp"
#include "stickslip/sliding/histories.hpp"
#include "stickslip/sliding/integrate.hpp"
#include "stickslip/sliding/sensitivity.hpp"
#include "stickslip/state/state.hpp"

namespace stickslip {

class Trajectory;

namespace detail {

template <class... Laws>
std::variant<Slider<Laws>...> sliders_of(LawList<Laws...>);  // for types only

}  // namespace detail

/// A slider of any law of the library (friction/laws.hpp). The library contains all computations for it, compiled: a
/// program that uses this type, such as the Python package, compiles no integrator.
///
///     const AnySlider slider = Slider(Coulomb(3), 1.5);
///     const Response response = integrate(slider, motion);
using AnySlider = decltype(detail::sliders_of(LibraryLaws()));

/// The mounting of a slider of any law.
inline const Mounting& mounting_of(const AnySlider& slider) {
  return std::visit([](const auto& one) -> const Mounting& { return one.mounting(); }, slider);
}

/// As the templates of the same names.
Response integrate(const AnySlider& slider, const GroundMotion& motion, const IntegrateOptions& options = {},
                   Response storage = {});
Response integrate(const AnySlider& slider, const HarmonicMotion& motion, const IntegrateOptions& options = {},
                   Response storage = {});
Histories histories(const AnySlider& slider, const GroundMotion& motion, const std::function<void()>& progress = {},
                    Histories storage = {});

/// As the template of the same name, with a function that is called now and then during a long segment, and may throw.
void advance(const AnySlider& slider, const Segment& segment, State& state, Contact contact = Contact::flight,
             const std::function<void()>& progress = {});
void advance(const AnySlider& slider, const LoadSegment& segment, State& state, Contact contact = Contact::flight,
             const std::function<void()>& progress = {});

/// As the template of the same name, under a GroundMotion or a HarmonicMotion. Forces, margins, floor motions, loops
/// and states at any time read it.
template <Motion M>
std::unique_ptr<const Trajectory> trajectory(const AnySlider& slider, const M& motion, const Response& response);

Sensitivity sensitivity(const AnySlider& slider, const GroundMotion& motion, const Response& response,
                        Parameter parameter, std::optional<std::size_t> surface = {});

}  // namespace stickslip
