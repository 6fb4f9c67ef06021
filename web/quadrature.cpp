// Stands in for the adaptive quadrature of the library, which needs GSL.
#include "numerics/quadrature.hpp"

#include <functional>
#include <span>
#include <stdexcept>

namespace stickslip::detail {

double integral(const std::function<double(double)>&, double, double, std::span<const double>) {
  throw std::logic_error("the page computes no integral over a spectrum");
}

}  // namespace stickslip::detail
