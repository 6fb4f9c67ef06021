// Derivatives of the statistics of an ensemble with respect to a parameter.
#pragma once

#include <concepts>
#include <cstdint>
#include <functional>
#include <stdexcept>
#include <string>
#include <variant>
#include <vector>

#include "stickslip/ensemble/detail/simulator.hpp"
#include "stickslip/ensemble/member.hpp"
#include "stickslip/friction/coulomb.hpp"
#include "stickslip/friction/law.hpp"
#include "stickslip/slider/slider.hpp"
#include "stickslip/sliding/integrate.hpp"
#include "stickslip/sliding/response.hpp"
#include "stickslip/sliding/sensitivity.hpp"
#include "stickslip/statistics/tally.hpp"

namespace stickslip {

struct EnsembleSensitivityOptions {
  std::uint64_t members = 1000;  ///< at least 2
  std::uint64_t first_member = 0;
  std::uint64_t seed = 0;
  unsigned threads = 0;               ///< maximum number; 0: all cores
  bool settle = false;                ///< differentiate peaks and residuals after each slider has come to rest
  Contact contact = Contact::flight;  ///< a member that leaves the ground is an error; `clipped` keeps it there
  /// Called about ten times a second with the numbers of members done and in total, in the calling thread. It may throw
  /// to end the work.
  std::function<void(std::uint64_t done, std::uint64_t members)> progress{};
};

/// Derivatives of the statistics of an ensemble with respect to a parameter, per unit of the parameter. Standard errors
/// are from the scatter between members.
struct EnsembleSensitivity {
  std::vector<double> peak;       ///< of the peak of each member [m], in order
  std::vector<double> residual;   ///< of the last x of each member [m], in order
  Estimate peak_mean;             ///< of E[peak] [m]
  Estimate residual_mean;         ///< of E[x] at the end [m]
  Estimate residual_mean_square;  ///< of E[x^2] at the end, 2 E[x dx] [m^2]
  Estimate residual_rms;          ///< of sqrt(E[x^2]) at the end, E[x dx] / rms [m]
};

namespace detail {

/// The last x of a member, and its derivatives.
struct MemberSensitivity {
  double residual = 0;
  Sensitivity derivative{};
};

EnsembleSensitivity ensemble_sensitivity(const EnsembleSensitivityOptions& options,
                                         const std::function<MemberSensitivity(std::uint64_t member)>& differentiate);

/// Rejects sliders for which the mean of the derivatives is not the derivative of the mean, or is unknown.
template <FrictionLaw Law>
void require_differentiable_mean(const Slider<Law>& slider) {
  const auto refuse = [](const std::string& reason) {
    throw std::invalid_argument("ensemble_sensitivity: covers Coulomb friction without stops, got " + reason +
                                "; take differences of two ensembles with the same seed");
  };
  if constexpr (form_of<Law> == Form::numeric)
    refuse("a law given as functions of numbers, whose derivatives are not known");
  else if constexpr (LawWithHold<Law> || requires { requires Law::static_above_kinetic; })
    refuse(
        "static friction above kinetic: its response jumps where a decision changes, and the mean of the derivatives "
        "leaves the jumps out");
  else if constexpr (!std::same_as<Law, Coulomb>)
    refuse("a law whose level changes during a slip, for which derivatives are not known or have no bound");
  if (slider.mounting().stops)
    refuse("stops: near a grazing impact derivatives have no bound, and their mean has no standard error");
}

template <FrictionLaw Law>
MemberSensitivity member_sensitivity(const Slider<Law>& slider, const GroundMotion& motion, Parameter parameter,
                                     const IntegrateOptions& how) {
  if constexpr (std::same_as<Law, Coulomb>) {
    const Response response = integrate(slider, motion, how);
    return {response.residual, sensitivity(slider, motion, response, parameter)};
  } else {
    return {};  // rejected before
  }
}

/// Calls `work` with a slider in its static type.
template <FrictionLaw Law, class Work>
auto with_slider(const Slider<Law>& slider, Work&& work) {
  return work(slider);
}
template <class... Sliders, class Work>
auto with_slider(const std::variant<Sliders...>& slider, Work&& work) {
  return std::visit(work, slider);
}

}  // namespace detail

/// Derivatives of the statistics of an ensemble with respect to a parameter: means of the derivatives of the members,
/// each by `sensitivity`,
///     d E[peak] = E[d peak],   d E[x^2] = 2 E[x dx],   d rms = E[x dx] / rms.
/// Mean and derivative may be exchanged because the response of Coulomb friction is continuous in the parameter, with a
/// bounded derivative. Where a response jumps, as with static friction above kinetic, the mean of the derivatives
/// leaves the jumps out; such sliders are rejected. Take differences of two ensembles with the same seed then: the
/// members are the same, and most of the scatter cancels.
///
/// @param source     of members with Coulomb friction, any mounting but stops; see MemberSource
/// @param parameter  the parameter; `kinetic` and `static_level` belong to other laws
/// @return the same bits for any number of threads
/// @throws std::invalid_argument  fewer than two members; another law; stops; a parameter that the slider
///                                does not have; a member that leaves the ground (use `Contact::clipped`) or whose
///                                response is not differentiable (names it)
/// @throws ConvergenceError       a member does not settle; names it
///
/// Cost: `integrate` and `sensitivity` for each member, one by one, on all threads. Memory: 24 bytes a member.
template <MemberSource Source>
EnsembleSensitivity ensemble_sensitivity(const Source& source, Parameter parameter,
                                         const EnsembleSensitivityOptions& options = {}) {
  IntegrateOptions how;
  how.settle = options.settle;
  how.contact = options.contact;
  return detail::ensemble_sensitivity(options, [&](std::uint64_t index) {
    const auto& member = source.member(options.seed, index);
    return detail::with_slider(member.slider, [&](const auto& slider) {
      detail::require_differentiable_mean(slider);
      detail::MemberSensitivity result;
      detail::naming_member(
          index, [&] { result = detail::member_sensitivity(slider, member.motion, parameter, how); },
          "ensemble_sensitivity");
      return result;
    });
  });
}

/// The same for members by index: one slider, or one of a source of sliders, under the motions of a source.
///
///     ensemble_sensitivity(Coulomb(2), PoissonPulses::event("great near field"), Parameter::slip_level,
///                          {.members = 10'000});
template <class S, MotionSource M>
requires(!FrictionLaw<S>) EnsembleSensitivity
    ensemble_sensitivity(const S& sliders, const M& motions, Parameter parameter,
                         const EnsembleSensitivityOptions& options = {}) {
  return ensemble_sensitivity(PairedMembers<S, M>(sliders, motions), parameter, options);
}

template <FrictionLaw Law, MotionSource M>
EnsembleSensitivity ensemble_sensitivity(const Law& law, const M& motions, Parameter parameter,
                                         const EnsembleSensitivityOptions& options = {}) {
  return ensemble_sensitivity(Slider<Law>(law), motions, parameter, options);
}

}  // namespace stickslip
