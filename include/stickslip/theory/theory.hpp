// The concept of a theory: it reports whether it covers a slider under an excitation, and predicts the moments.
#pragma once

#include <concepts>
#include <span>
#include <stdexcept>
#include <string>

#include "stickslip/base/equal.hpp"
#include "stickslip/base/error.hpp"
#include "stickslip/friction/law.hpp"
#include "stickslip/slider/slider.hpp"
#include "stickslip/state/state.hpp"
#include "stickslip/statistics/moments.hpp"

namespace stickslip::theory {

/// Whether a theory covers a slider under an excitation and, if not, why.
struct Coverage {
  std::string reason{};    ///< why not, in one sentence; empty where it does
  bool excitation = true;  ///< false if the theory does not cover this kind of excitation for any slider

  explicit operator bool() const noexcept { return reason.empty(); }
};

/// A theory T predicts the moments of a slider S under an excitation E without simulating it. It has
///
///     name()                                the name, with the options that distinguish its variants
///     covers(slider, excitation)            a Coverage, from the slider and the excitation alone, in microseconds
///     predict(slider, excitation, times)    Moments at `times` [s] from rest on, or a class derived from them
///
/// `covers` accepts any slider and excitation. If it returns false, `predict` does not compile or throws
/// std::invalid_argument with the same reason. If it returns true, `predict` may still throw for conditions that only
/// the computation detects: std::invalid_argument for times out of range or a caster that escapes, ConvergenceError.
///
/// An excitation is white noise, given by its level S0 [m^2/s^3], a `Spectrum`, a `GaussianExcitation`, `PoissonPulses`
/// or a `HarmonicMotion`.
template <class T, class S, class E>
concept Theory = requires(const T& theory, const S& slider, const E& excitation, std::span<const double> times) {
  { theory.name() } -> std::convertible_to<std::string>;
  { theory.covers(slider, excitation) } -> std::same_as<Coverage>;
  { theory.predict(slider, excitation, times) } -> std::convertible_to<Moments>;
};

}  // namespace stickslip::theory

namespace stickslip::detail {

/// The coverage by a theory that takes an `Excitation`, for an excitation `e` of any type. The theory does not cover
/// `e` if `e` does not convert to `Excitation`, or if `check` throws; the reason is then the message of the exception.
/// @param other  the reason given if the types do not convert; lists what the theory covers
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

/// Rejects a law whose level depends on more than the position.
template <FrictionLaw Law>
[[noreturn]] void refuse_law(const std::string& theory) {
  throw std::invalid_argument(theory + ": a resistance that depends on the " +
                              (MemoryLaw<Law> ? "distance slid" : "speed") + " is not covered");
}

/// Rejects what no theory covers: slopes, stops and one-way sliding, a resistance that depends on the speed or the
/// distance slid, and static friction that differs from kinetic.
template <FrictionLaw Law>
void require_one_level(const Slider<Law>& slider, const std::string& theory) {
  require_plain_mounting(slider.mounting(), theory);
  if constexpr (!PositionLaw<Law>) {
    refuse_law<Law>(theory);
  } else if constexpr (LawWithHold<Law>) {
    for (const Direction direction : {Direction::forward, Direction::backward}) {
      const double kinetic = slider.law().resist(0.0, direction);
      require(equal(slider.law().hold(0.0, direction), kinetic),
              theory + ": static friction that differs from kinetic is not covered, it must hold " + shortest(kinetic) +
                  " m/s^2 at x = 0",
              slider.law().hold(0.0, direction), "m/s^2");
    }
  }
}

/// Rejects what `require_one_level` rejects, and a damper in addition to friction.
template <FrictionLaw Law>
void require_plain(const Slider<Law>& slider, const std::string& theory) {
  require(equal(slider.damping(), 0), theory + ": a slider with a damper is not covered, damping must be 0",
          slider.damping(), "1/s");
  require_one_level(slider, theory);
}

}  // namespace stickslip::detail
