// Integrals over a spectrum, by GSL.
#pragma once

#include <functional>
#include <span>

namespace stickslip::detail {

/// Integral of `f` from `low` to `high` (which may be infinite), split at those of the ascending `breakpoints` that lie
/// between, to a relative 1e-10 where round-off allows. What `f` throws comes through.
/// @throws ConvergenceError where not even 1e-6 is reached: `f` is hardly integrable
double integral(const std::function<double(double)>& f, double low, double high,
                std::span<const double> breakpoints = {});

}  // namespace stickslip::detail
