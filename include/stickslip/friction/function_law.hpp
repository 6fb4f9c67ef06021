// A friction law from functions that are known only when the program runs.
#pragma once

#include <functional>
#include <memory>

#include "stickslip/state.hpp"

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
  explicit FunctionLaw(Resist resist, Hold hold = {});

  /// @throws InvalidLevel  the function returned a level that is negative or not finite
  double resist(double x, double speed, Direction direction) const;
  double hold(double x, Direction direction) const;

  const Resist& resist_function() const noexcept { return functions_->resist; }
  /// Empty if it was not given.
  const Hold& hold_function() const noexcept { return functions_->hold; }

 private:
  struct Functions {
    Resist resist;
    Hold hold;
  };
  std::shared_ptr<const Functions> functions_;
};

}  // namespace stickslip
