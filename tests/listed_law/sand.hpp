// A law that no file of the library names: Coulomb friction and a force proportional to the speed.
#pragma once

#include <tuple>

#include "stickslip/base/parts.hpp"
#include "stickslip/friction/law.hpp"

namespace stickslip {

class Sand {
 public:
  static constexpr bool symmetric = true;
  static constexpr const char* class_name = "Sand";
  static constexpr auto parts() {
    return std::tuple(Part{"slip_level", &Sand::slip_level, "a", "m/s^2", Range::at_least(0)},
                      Part{"drag", &Sand::drag, "c", "1/s", Range::at_least(0)});
  }

  Sand(double slip_level, double drag) : slip_level_(slip_level), drag_(drag) {
    detail::check_parts(*this, class_name);
  }

  double slip_level() const noexcept { return slip_level_; }
  double drag() const noexcept { return drag_; }
  static constexpr bool isotropic() noexcept { return true; }

  template <class X, class Speed>
  auto resist(const X&, const Speed& speed, Direction) const {
    return slip_level_ + drag_ * speed;
  }

 private:
  double slip_level_, drag_;
};

}  // namespace stickslip
