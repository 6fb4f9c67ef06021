// Large linear systems, by SUNDIALS.
#pragma once

#include <functional>
#include <span>
#include <string>

namespace stickslip::detail {

/// Solves A x = b by the stabilized method of biconjugate gradients (SPBCGS): two products an iteration, and the memory
/// of eight vectors. For operators whose products cost less than the orthogonalization of GMRES.
/// @param multiply  writes A times its first argument into the second; may throw
/// @param b         the right side
/// @param x         a first guess; the solution
/// @param tolerance  of the residual, relative to the right side
/// @param who       of the error message
/// @throws ConvergenceError  the residual does not reach the tolerance within 5000 iterations
void solve_bicgstab(const std::function<void(std::span<const double>, std::span<double>)>& multiply,
                    std::span<const double> b, std::span<double> x, double tolerance, const std::string& who);

}  // namespace stickslip::detail
