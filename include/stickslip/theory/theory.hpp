// What a theory is: it says whether it covers a slider under an excitation, and predicts the moments of the motion.
#pragma once

#include <concepts>
#include <span>
#include <stdexcept>
#include <string>

#include "stickslip/error.hpp"
#include "stickslip/statistics/moments.hpp"

namespace stickslip::theory {

/// Whether a theory covers a slider under an excitation and, if not, why.
struct Coverage {
  std::string reason{};    ///< why not, in one sentence; empty where it does
  bool excitation = true;  ///< false where the theory is for excitations of another kind, whatever slides

  explicit operator bool() const noexcept { return reason.empty(); }
};

/// A theory T predicts the moments of a slider S under an excitation E without simulating it. It has
///
///     name()                                the name, with the options that tell it from its variants
///     covers(slider, excitation)            a Coverage, from the slider and the excitation alone, in microseconds
///     predict(slider, excitation, times)    Moments at `times` [s] from rest on
///
/// `covers` can be asked about any slider and excitation. Where it says no, `predict` does not compile or throws
/// std::invalid_argument with the same reason. Where it says yes, `predict` may still throw what only the computation
/// finds: std::invalid_argument for times out of range or a caster that escapes, ConvergenceError.
///
/// An excitation is white noise by its level S0 [m^2/s^3], a `Spectrum`, a `GaussianExcitation`, `PoissonPulses` or a
/// `HarmonicMotion`.
template <class T, class S, class E>
concept Theory = requires(const T& theory, const S& slider, const E& excitation, std::span<const double> times) {
  { theory.name() } -> std::convertible_to<std::string>;
  { theory.covers(slider, excitation) } -> std::same_as<Coverage>;
  { theory.predict(slider, excitation, times) } -> std::same_as<Moments>;
};

}  // namespace stickslip::theory

namespace stickslip::detail {

/// What a theory that takes an `Excitation` answers about an excitation `e` of any type: no where `e` cannot be one,
/// else what `check` throws.
/// @param other  says what is covered instead
template <class Excitation, class E, class Check>
theory::Coverage coverage(const E& e, const char* other, const Check& check) {
  if constexpr (!std::convertible_to<const E&, const Excitation&>) {
    return {other, false};
  } else {
    bool converted = false;
    try {
      const Excitation& excitation = e;
      converted = true;
      check(excitation);
    } catch (const std::invalid_argument& refusal) {
      return {refusal.what(), converted};
    }
    return {};
  }
}

/// Refuses a slider with a damper, for all theories: none has one beside friction.
template <class S>
void require_undamped(const S& slider, const char* theory) {
  if constexpr (requires { slider.damping(); })
    require(slider.damping() == 0, std::string(theory) + ": a slider with a damper is not covered, damping must be 0",
            slider.damping(), "1/s");
}

}  // namespace stickslip::detail
