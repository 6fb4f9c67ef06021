#include "numerics/quadrature.hpp"

#include <gsl/gsl_errno.h>
#include <gsl/gsl_integration.h>

#include <cmath>
#include <cstddef>
#include <exception>
#include <limits>
#include <memory>

#include "stickslip/base/error.hpp"

namespace stickslip::detail {
namespace {

constexpr std::size_t max_intervals = 2000;

struct Integrand {
  const std::function<double(double)>& f;
  std::exception_ptr thrown{};  // must not propagate through GSL, which is C
};

double value(double x, void* data) noexcept {
  auto& integrand = *static_cast<Integrand*>(data);
  if (integrand.thrown) return 0;
  try {
    return integrand.f(x);
  } catch (...) {
    integrand.thrown = std::current_exception();
    return 0;
  }
}

using Workspace = std::unique_ptr<gsl_integration_workspace, decltype(&gsl_integration_workspace_free)>;

Workspace make_workspace() {
  // GSL's default handler would end the program. The handler is global to the process, so it is set once.
  [[maybe_unused]] static const auto handler = gsl_set_error_handler_off();
  Workspace workspace(gsl_integration_workspace_alloc(max_intervals), &gsl_integration_workspace_free);
  if (!workspace) throw std::bad_alloc();
  return workspace;
}

double oscillating_integral(const std::function<double(double)>& f, double frequency, double low, double high,
                            double tolerance, gsl_integration_qawo_enum which) {
  if (!(low < high)) return 0;
  constexpr std::size_t levels = 60;  // of bisection
  const Workspace workspace = make_workspace();
  const std::unique_ptr<gsl_integration_qawo_table, decltype(&gsl_integration_qawo_table_free)> table(
      gsl_integration_qawo_table_alloc(frequency, std::isinf(high) ? 1 : high - low, which, levels),
      &gsl_integration_qawo_table_free);
  if (!table) throw std::bad_alloc();
  Integrand integrand{f};
  gsl_function function{&value, &integrand};
  double result = 0, error = 0;
  if (std::isinf(high)) {
    const Workspace cycles = make_workspace();
    gsl_integration_qawf(&function, low, tolerance, max_intervals, workspace.get(), cycles.get(), table.get(), &result,
                         &error);
  } else {
    gsl_integration_qawo(&function, low, tolerance, 0, max_intervals, workspace.get(), table.get(), &result, &error);
  }
  if (integrand.thrown) std::rethrow_exception(integrand.thrown);
  if (!(error <= 1e3 * tolerance))
    throw ConvergenceError("integral from " + shortest(low) + " to " + shortest(high) + ": reached " +
                           shortest(result) + " with an uncertainty of " + shortest(error));
  return result;
}

}  // namespace

double integral(const std::function<double(double)>& f, double low, double high, std::span<const double> breakpoints) {
  const Workspace workspace = make_workspace();
  double sum = 0, error = 0;
  const auto add = [&](const std::function<double(double)>& g, double from, double to) {
    if (!(from < to)) return;
    Integrand integrand{g};
    gsl_function function{&value, &integrand};
    double result = 0, uncertainty = 0;
    const int status = std::isinf(to) ? gsl_integration_qagiu(&function, from, 0, 1e-10, max_intervals, workspace.get(),
                                                              &result, &uncertainty)
                                      : gsl_integration_qags(&function, from, to, 0, 1e-10, max_intervals,
                                                             workspace.get(), &result, &uncertainty);
    if (integrand.thrown) std::rethrow_exception(integrand.thrown);
    sum += result;
    // If only round-off prevents convergence, the uncertainty says how far it came; otherwise it is not reliable.
    error += status == GSL_SUCCESS || status == GSL_EROUND ? uncertainty : std::numeric_limits<double>::infinity();
  };

  double from = low;
  for (const double breakpoint : breakpoints)
    if (breakpoint > from && breakpoint < high) {
      add(f, from, breakpoint);
      from = breakpoint;
    }
  if (std::isinf(high) && from > 0)  // scaled by `from`, because GSL cannot determine the scale
    add([&](double u) { return from * f(from * u); }, 1, high);
  else
    add(f, from, high);
  if (!(error <= 1e-6 * std::abs(sum)))
    throw ConvergenceError("integral from " + shortest(low) + " to " + shortest(high) + ": reached " + shortest(sum) +
                           " with an uncertainty of " + shortest(error));
  return sum;
}

double cosine_integral(const std::function<double(double)>& f, double frequency, double low, double high,
                       double tolerance) {
  return oscillating_integral(f, frequency, low, high, tolerance, GSL_INTEG_COSINE);
}

double sine_integral(const std::function<double(double)>& f, double frequency, double low, double high,
                     double tolerance) {
  return oscillating_integral(f, frequency, low, high, tolerance, GSL_INTEG_SINE);
}

}  // namespace stickslip::detail
