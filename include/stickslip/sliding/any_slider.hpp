// A slider whose law is known only when the program runs.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <variant>

#include "stickslip/friction/caster.hpp"
#include "stickslip/friction/coulomb.hpp"
#include "stickslip/friction/degrading.hpp"
#include "stickslip/friction/function_law.hpp"
#include "stickslip/friction/kumar.hpp"
#include "stickslip/friction/multi_pendulum.hpp"
#include "stickslip/friction/static_kinetic.hpp"
#include "stickslip/friction/stribeck.hpp"
#include "stickslip/friction/velocity_dependent.hpp"
#include "stickslip/ground/ground_motion.hpp"
#include "stickslip/ground/harmonic_motion.hpp"
#include "stickslip/ground/segment.hpp"
#include "stickslip/slider.hpp"
#include "stickslip/sliding/histories.hpp"
#include "stickslip/sliding/integrate.hpp"
#include "stickslip/sliding/sensitivity.hpp"
#include "stickslip/state.hpp"

namespace stickslip {

class Trajectory;

/// A slider of any law of the library; this is the list of its laws. The library contains all computations for it,
/// compiled: a program that uses this type, such as the Python package, compiles no integrator.
///
///     const AnySlider slider = Slider(Stribeck(3, 2, 0.05), 1.5);
///     const Response response = integrate(slider, motion);
using AnySlider = std::variant<Slider<Coulomb>, Slider<Caster>, Slider<VelocityDependent>, Slider<Stribeck>,
                               Slider<Degrading>, Slider<KumarFriction>, Slider<MultiPendulum>, Slider<FunctionLaw>,
                               Slider<StaticKinetic<Coulomb>>, Slider<StaticKinetic<Caster>>,
                               Slider<StaticKinetic<VelocityDependent>>, Slider<StaticKinetic<Degrading>>>;

/// The mounting of a slider of any law.
inline const Mounting& mounting_of(const AnySlider& slider) {
  return std::visit([](const auto& one) -> const Mounting& { return one.mounting(); }, slider);
}

/// As the templates of the same names.
Response integrate(const AnySlider& slider, const GroundMotion& motion, const IntegrateOptions& options = {},
                   Response storage = {});
Response integrate(const AnySlider& slider, const HarmonicMotion& motion, const IntegrateOptions& options = {},
                   Response storage = {});
Histories histories(const AnySlider& slider, const GroundMotion& motion, const std::function<void()>& progress = {});

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
