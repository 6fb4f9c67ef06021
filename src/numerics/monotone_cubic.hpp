// Monotone interpolation.
#pragma once

#include <gsl/gsl_spline.h>

#include <cstddef>
#include <memory>
#include <new>
#include <span>

namespace stickslip::numerics {

/// Cubics through points, monotone wherever the points are.
///
/// Reference: M. Steffen, Astron. Astrophys. 239 (1990), 443-450.
class MonotoneCubic {
 public:
  /// @param x  ascending, at least three
  MonotoneCubic(std::span<const double> x, std::span<const double> y)
      : spline_(gsl_spline_alloc(gsl_interp_steffen, x.size()), &gsl_spline_free) {
    if (!spline_) throw std::bad_alloc();
    gsl_spline_init(spline_.get(), x.data(), y.data(), x.size());
  }

  /// @param x  within the points
  double operator()(double x) const { return gsl_spline_eval(spline_.get(), x, nullptr); }
  double slope(double x) const { return gsl_spline_eval_deriv(spline_.get(), x, nullptr); }

 private:
  std::unique_ptr<gsl_spline, decltype(&gsl_spline_free)> spline_;
};

}  // namespace stickslip::numerics
