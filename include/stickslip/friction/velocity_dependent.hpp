// Friction that changes with speed, from a level at rest to a level at high speed.
#pragma once

#include <cmath>
#include <tuple>

#include "stickslip/base/error.hpp"
#include "stickslip/base/parts.hpp"
#include "stickslip/friction/law.hpp"
#include "stickslip/series/series.hpp"

namespace stickslip {

/// Friction that depends on the speed |x'|, as for PTFE and other liners of sliding isolators:
///     a(|x'|) = a_fast - (a_fast - a_slow) exp(-rate |x'|)
/// The limit of friction at rest is a_slow. Liners have a_slow < a_fast. If a_slow > a_fast, friction decreases with
/// speed.
///
/// Source: M. C. Constantinou, A. Mokha, A. Reinhorn, Teflon bearings in base isolation II: Modeling, Journal of
/// Structural Engineering 116 (1990), 455-474.
class VelocityDependent {
 public:
  static constexpr bool symmetric = true;

  static constexpr const char* class_name = "VelocityDependent";
  static constexpr auto parts() {
    return std::tuple(Part{"slow", &VelocityDependent::slow, "a_slow", "m/s^2", Range::at_least(0)},
                      Part{"fast", &VelocityDependent::fast, "a_fast", "m/s^2", Range::at_least(0)},
                      Part{"rate", &VelocityDependent::rate, "rate", "s/m", Range::at_least(0)});
  }

  /// @param slow  a_slow, force per unit mass at rest [m/s^2], finite and at least 0
  /// @param fast  a_fast, force per unit mass at high speed [m/s^2], finite and at least 0
  /// @param rate  [s/m], finite and at least 0; 63 % of the change is reached at a speed of 1 / rate
  /// @throws std::invalid_argument naming the value
  VelocityDependent(double slow, double fast, double rate) : slow_(slow), fast_(fast), rate_(rate) {
    detail::check_parts(*this, class_name);
  }

  double slow() const noexcept { return slow_; }
  double fast() const noexcept { return fast_; }
  double rate() const noexcept { return rate_; }
  /// The speed over which the level changes [m/s].
  double speed_scale() const noexcept { return 1 / rate_; }

  static constexpr bool isotropic() noexcept { return true; }

  template <class X, class Speed>
  auto resist(const X&, const Speed& speed, Direction) const {
    return decaying(-rate_ * speed, slow_, fast_);
  }

 private:
  double slow_, fast_, rate_;
};

}  // namespace stickslip
