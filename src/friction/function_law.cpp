#include "stickslip/friction/function_law.hpp"

#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>

#include "stickslip/error.hpp"
#include "stickslip/friction/law.hpp"

namespace stickslip {
namespace {

double checked(double level, const char* name, double x, double speed) {
  if (level >= 0 && std::isfinite(level)) return level;
  throw InvalidLevel(std::string("Law: ") + name + " must be finite and at least 0, got " + detail::shortest(level) +
                     " m/s^2 at x = " + detail::shortest(x) + " m and a speed of " + detail::shortest(speed) + " m/s");
}

}  // namespace

FunctionLaw::FunctionLaw(Resist resist, Hold hold)
    : functions_(std::make_shared<Functions>(std::move(resist), std::move(hold))) {
  if (!functions_->resist) throw std::invalid_argument("FunctionLaw: needs a function `resist`, got an empty one");
}

double FunctionLaw::resist(double x, double speed, Direction direction) const {
  return checked(functions_->resist(x, speed, direction), "resist", x, speed);
}

double FunctionLaw::hold(double x, Direction direction) const {
  if (!functions_->hold) return resist(x, 0, direction);
  return checked(functions_->hold(x, direction), "hold", x, 0);
}

}  // namespace stickslip
