#include "numerics/bicgstab.hpp"

#include <nvector/nvector_serial.h>
#include <sunlinsol/sunlinsol_spbcgs.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <exception>

#include "numerics/sundials.hpp"
#include "stickslip/base/error.hpp"

namespace stickslip::detail {
namespace {

struct Product {
  const std::function<void(std::span<const double>, std::span<double>)>& multiply;
  std::size_t size;
  std::exception_ptr thrown{};  // must not propagate through SUNDIALS, which is C
};

int multiply(void* data, N_Vector from, N_Vector to) noexcept {
  auto& product = *static_cast<Product*>(data);
  try {
    product.multiply({N_VGetArrayPointer(from), product.size}, {N_VGetArrayPointer(to), product.size});
  } catch (...) {
    product.thrown = std::current_exception();
    return -1;
  }
  return 0;
}

}  // namespace

void solve_bicgstab(const std::function<void(std::span<const double>, std::span<double>)>& by,
                    std::span<const double> b, std::span<double> x, double tolerance, const std::string& who) {
  constexpr int iterations = 5000;
  const sundials::Context context(sundials::make_context());
  const auto length = static_cast<sunindextype>(b.size());
  const sundials::Vector solution(sundials::made(N_VNew_Serial(length, context.get()))),
      right(sundials::made(N_VNew_Serial(length, context.get())));
  std::ranges::copy(x, N_VGetArrayPointer(solution.get()));
  std::ranges::copy(b, N_VGetArrayPointer(right.get()));
  const double norm = std::sqrt(N_VDotProd(right.get(), right.get()));
  const sundials::LinearSolver solver(
      sundials::made(SUNLinSol_SPBCGS(solution.get(), SUN_PREC_NONE, iterations, context.get())));
  Product product{by, b.size()};
  SUNLinSolSetATimes(solver.get(), &product, &multiply);
  SUNLinSolSetZeroGuess(solver.get(), SUNFALSE);
  SUNLinSolInitialize(solver.get());
  SUNLinSolSetup(solver.get(), nullptr);
  const int flag = SUNLinSolSolve(solver.get(), nullptr, solution.get(), right.get(), tolerance * norm);
  if (product.thrown) std::rethrow_exception(product.thrown);
  if (flag != 0)
    throw ConvergenceError(who + ": the residual of a linear system must fall to " + shortest(tolerance) + ", is " +
                           shortest(SUNLinSolResNorm(solver.get()) / norm) + " after " +
                           std::to_string(SUNLinSolNumIters(solver.get())) + " iterations");
  std::copy_n(N_VGetArrayPointer(solution.get()), x.size(), x.begin());
}

}  // namespace stickslip::detail
