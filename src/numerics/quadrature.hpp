// Integrals over a spectrum, by GSL.
#pragma once

#include <functional>
#include <span>

namespace stickslip::detail {

/// Integral of `f` from `low` to `high` (which may be infinite), split at those of the ascending `breakpoints` that lie
/// between, to a relative error of 1e-10 where round-off allows. Exceptions from `f` propagate.
/// @throws ConvergenceError if not even 1e-6 is reached: `f` is hardly integrable
double integral(const std::function<double(double)>& f, double low, double high,
                std::span<const double> breakpoints = {});

/// Integral of `f(x) cos(frequency x)`, or of `f(x) sin(frequency x)`, from `low` to `high` (which may be infinite),
/// for a smooth `f` and any frequency: by moments, Clenshaw and Curtis (QAWO, QAWF). Exceptions from `f` propagate.
/// @param frequency  positive and finite
/// @param tolerance  absolute, positive
/// @throws ConvergenceError if not even a thousand times the tolerance is reached
double cosine_integral(const std::function<double(double)>& f, double frequency, double low, double high,
                       double tolerance);
double sine_integral(const std::function<double(double)>& f, double frequency, double low, double high,
                     double tolerance);

}  // namespace stickslip::detail
