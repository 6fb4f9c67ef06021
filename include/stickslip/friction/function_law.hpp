// A friction law from functions that are known only when the program runs.
#pragma once

#include <cmath>
#include <functional>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>

#include "stickslip/base/error.hpp"
#include "stickslip/friction/law.hpp"
#include "stickslip/state/state.hpp"

namespace stickslip {

/// A friction law whose levels are functions, such as those of another language or of an input file. Its
/// form is numeric: its motion is computed by collocation, to 1e-10 of the scale. A law that is known when the program
/// is compiled is faster as a class of its own; see FrictionLaw.
class FunctionLaw {
 public:
  static constexpr bool numeric = true;
  static constexpr const char* class_name = "FunctionLaw";

  /// A level [m/s^2] at x [m] and the speed |x'| [m/s].
  using Resist = std::function<double(double x, double speed, Direction)>;
  using Hold = std::function<double(double x, Direction)>;

  /// @param resist  resistance to sliding; at least 0, finite, and continuous in x and speed
  /// @param hold    largest friction at rest; at least the resistance at zero speed, which is the default
  /// @throws std::invalid_argument  `resist` is empty
  explicit FunctionLaw(Resist resist, Hold hold = {})
      : functions_(std::make_shared<Functions>(std::move(resist), std::move(hold))) {
    if (!functions_->resist) throw std::invalid_argument("FunctionLaw: needs a function `resist`, got an empty one");
  }

  /// @throws InvalidLevel  the function returned a level that is negative or not finite
  double resist(double x, double speed, Direction direction) const {
    return checked(functions_->resist(x, speed, direction), "resist", x, speed);
  }
  double hold(double x, Direction direction) const {
    if (!functions_->hold) return resist(x, 0, direction);
    return checked(functions_->hold(x, direction), "hold", x, 0);
  }

  const Resist& resist_function() const noexcept { return functions_->resist; }
  /// Empty if it was not given.
  const Hold& hold_function() const noexcept { return functions_->hold; }

 private:
  struct Functions {
    Resist resist;
    Hold hold;
    Functions(Resist resists, Hold holds) : resist(std::move(resists)), hold(std::move(holds)) {}
  };

  static double checked(double level, const char* name, double x, double speed) {
    if (level >= 0 && std::isfinite(level)) return level;
    throw InvalidLevel(std::string("Law: ") + name + " must be finite and at least 0, got " + detail::shortest(level) +
                       " m/s^2 at x = " + detail::shortest(x) + " m and a speed of " + detail::shortest(speed) +
                       " m/s");
  }

  std::shared_ptr<const Functions> functions_;
};

}  // namespace stickslip
