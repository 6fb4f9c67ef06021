#include "numerics/ode.hpp"

#include <arkode/arkode_erkstep.h>
#include <cvode/cvode.h>
#include <nvector/nvector_serial.h>
#include <sunlinsol/sunlinsol_dense.h>
#include <sunmatrix/sunmatrix_dense.h>
#include <sunnonlinsol/sunnonlinsol_fixedpoint.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <exception>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>

#include "numerics/sundials.hpp"
#include "stickslip/base/error.hpp"

#if SUNDIALS_VERSION_MAJOR >= 7 && defined(__GNUC__)
#pragma GCC diagnostic ignored "-Wdeprecated-declarations"  // ERKStep's functions have a second name since 7.1
#endif

namespace stickslip::detail {
namespace {

using sundials::Context, sundials::LinearSolver, sundials::made, sundials::make_context, sundials::Matrix,
    sundials::NonlinearSolver, sundials::Vector;

constexpr long steps_a_beat = 1000;

// SUNDIALS's serial vectors are designed for many components: with three, an operation mostly distinguishes special
// cases. The operations that CVODE performs tens of times per step are plain loops here, which saves a third of all
// instructions.
double* numbers(N_Vector vector) { return NV_DATA_S(vector); }
sunindextype length(N_Vector vector) { return NV_LENGTH_S(vector); }

void linear_sum(double a, N_Vector x, double b, N_Vector y, N_Vector sum) {
  const double *const from = numbers(x), *const other = numbers(y);
  double* const to = numbers(sum);
  for (sunindextype i = 0, n = length(sum); i < n; ++i) to[i] = a * from[i] + b * other[i];
}

void scale(double factor, N_Vector x, N_Vector scaled) {
  const double* const from = numbers(x);
  double* const to = numbers(scaled);
  for (sunindextype i = 0, n = length(scaled); i < n; ++i) to[i] = factor * from[i];
}

double weighted_rms(N_Vector x, N_Vector weight) {
  const double *const value = numbers(x), *const by = numbers(weight);
  double sum = 0;
  const sunindextype n = length(x);
  for (sunindextype i = 0; i < n; ++i) sum += value[i] * by[i] * (value[i] * by[i]);
  return std::sqrt(sum / static_cast<double>(n));
}

int scale_add_multi(int count, double* factors, N_Vector x, N_Vector* y, N_Vector* sums) {
  for (int i = 0; i < count; ++i) linear_sum(factors[i], x, 1, y[i], sums[i]);
  return 0;
}

int linear_combination(int count, double* factors, N_Vector* x, N_Vector sum) {
  const sunindextype n = length(sum);
  for (sunindextype i = 0; i < n; ++i) {
    double total = 0;
    for (int j = 0; j < count; ++j) total += factors[j] * numbers(x[j])[i];
    numbers(sum)[i] = total;
  }
  return 0;
}

int scale_vector_array(int count, double* factors, N_Vector* x, N_Vector* scaled) {
  for (int i = 0; i < count; ++i) scale(factors[i], x[i], scaled[i]);
  return 0;
}

struct Problem {
  const OdeRightSide& right_side;
  std::size_t dimension;
  std::exception_ptr thrown{};  // must not propagate through SUNDIALS, which is C
};

int slope(double t, N_Vector y, N_Vector dy, void* data) noexcept {
  auto& problem = *static_cast<Problem*>(data);
  const std::span<double> out(N_VGetArrayPointer(dy), problem.dimension);
  if (problem.thrown) return -1;  // CVODE 6 retries with a shorter step
  try {
    problem.right_side(t, {N_VGetArrayPointer(y), problem.dimension}, out);
  } catch (...) {
    problem.thrown = std::current_exception();
    return -1;
  }
  return std::ranges::all_of(out, [](double value) { return std::isfinite(value); }) ? 0 : 1;
}

void set(int flag) {
  if (flag == CV_MEM_FAIL) throw std::bad_alloc();
  if (flag != CV_SUCCESS) throw std::invalid_argument("solve_ode: flag " + std::to_string(flag));
}

#if SUNDIALS_VERSION_MAJOR < 7
void say_nothing(int, const char*, const char*, char*, void*) {}
#endif

/// The common interface of CVODE and ARKODE, with CVODE's flags.
class Solver {
 public:
  Solver() = default;
  Solver(const Solver&) = delete;
  Solver& operator=(const Solver&) = delete;
  virtual ~Solver() = default;
  virtual int advance(double time, N_Vector y, double* reached) = 0;
  virtual long steps() = 0;
  virtual long evaluations() = 0;
  virtual char* name(int flag) = 0;
};

static_assert(int{ARK_SUCCESS} == int{CV_SUCCESS} && int{ARK_TOO_MUCH_WORK} == int{CV_TOO_MUCH_WORK} &&
              int{ARK_ILL_INPUT} == int{CV_ILL_INPUT} && int{ARK_TOO_CLOSE} == int{CV_TOO_CLOSE} &&
              int{ARK_MEM_FAIL} == int{CV_MEM_FAIL});

class Multistep : public Solver {
 public:
  Multistep(Problem& problem, double t0, double last, N_Vector y, N_Vector tolerance, const OdeOptions& options,
            SUNContext context)
      : bdf_(options.method == OdeMethod::bdf), memory_(made(CVodeCreate(bdf_ ? CV_BDF : CV_ADAMS, context))) {
#if SUNDIALS_VERSION_MAJOR < 7
    CVodeSetErrHandlerFn(memory_.get(), &say_nothing, nullptr);
#endif
    set(CVodeInit(memory_.get(), &slope, t0, y));
    set(CVodeSetUserData(memory_.get(), &problem));
    set(CVodeSVtolerances(memory_.get(), options.relative_tolerance, tolerance));
    set(CVodeSetMaxNumSteps(memory_.get(), steps_a_beat));
    set(CVodeSetMaxHnilWarns(memory_.get(), -1));
    set(CVodeSetStopTime(memory_.get(), last));  // the equations may be invalid beyond it
    if (bdf_) {
      const auto size = static_cast<sunindextype>(problem.dimension);
      matrix_.reset(made(SUNDenseMatrix(size, size, context)));
      linear_.reset(made(SUNLinSol_Dense(y, matrix_.get(), context)));
      set(CVodeSetLinearSolver(memory_.get(), linear_.get(), matrix_.get()));
    } else {
      nonlinear_.reset(made(SUNNonlinSol_FixedPoint(y, 0, context)));
      set(CVodeSetNonlinearSolver(memory_.get(), nonlinear_.get()));
    }
  }

  int advance(double time, N_Vector y, double* reached) override {
    return CVode(memory_.get(), time, y, reached, CV_NORMAL);
  }
  long steps() override {
    long steps = 0;
    CVodeGetNumSteps(memory_.get(), &steps);
    return steps;
  }
  long evaluations() override {
    long evaluations = 0, jacobian = 0;
    CVodeGetNumRhsEvals(memory_.get(), &evaluations);
    if (bdf_) CVodeGetNumLinRhsEvals(memory_.get(), &jacobian);
    return evaluations + jacobian;
  }
  char* name(int flag) override { return CVodeGetReturnFlagName(flag); }

 private:
  struct Free {
    void operator()(void* memory) const { CVodeFree(&memory); }
  };

  bool bdf_;
  Matrix matrix_;
  LinearSolver linear_;
  NonlinearSolver nonlinear_;
  std::unique_ptr<void, Free> memory_;
};

class RungeKutta : public Solver {
 public:
  RungeKutta(Problem& problem, double t0, double last, N_Vector y, N_Vector tolerance, const OdeOptions& options,
             SUNContext context)
      : memory_(made(ERKStepCreate(&slope, t0, y, context))) {
#if SUNDIALS_VERSION_MAJOR < 7
    ERKStepSetErrHandlerFn(memory_.get(), &say_nothing, nullptr);
#endif
    set(ERKStepSetTableNum(memory_.get(), ARKODE_DORMAND_PRINCE_7_4_5));
    set(ERKStepSetUserData(memory_.get(), &problem));
    set(ERKStepSVtolerances(memory_.get(), options.relative_tolerance, tolerance));
    set(ERKStepSetMaxNumSteps(memory_.get(), steps_a_beat));
    set(ERKStepSetMaxHnilWarns(memory_.get(), -1));
    set(ERKStepSetStopTime(memory_.get(), last));
  }

  int advance(double time, N_Vector y, double* reached) override {
    return ERKStepEvolve(memory_.get(), time, y, reached, ARK_NORMAL);
  }
  long steps() override {
    long steps = 0;
    ERKStepGetNumSteps(memory_.get(), &steps);
    return steps;
  }
  long evaluations() override {
    long evaluations = 0;
    ERKStepGetNumRhsEvals(memory_.get(), &evaluations);
    return evaluations;
  }
  char* name(int flag) override { return ERKStepGetReturnFlagName(flag); }

 private:
  struct Free {
    void operator()(void* memory) const { ERKStepFree(&memory); }
  };

  std::unique_ptr<void, Free> memory_;
};

void check(std::size_t dimension, double t0, std::span<const double> times, const OdeOptions& options) {
  const auto& absolute = options.absolute_tolerance;
  if (dimension == 0 || (absolute.size() != 1 && absolute.size() != dimension))
    throw std::invalid_argument("solve_ode: one absolute tolerance, or one a component");
  require(options.relative_tolerance > 0, "solve_ode: the relative tolerance must be positive",
          options.relative_tolerance);
  for (const double tolerance : absolute)
    require(tolerance >= 0, "solve_ode: an absolute tolerance must be at least 0", tolerance);
  double last = t0;
  for (std::size_t i = 0; i < times.size(); ++i) {
    require(std::isfinite(times[i]) && (i == 0 ? times[i] >= last : times[i] > last),
            "solve_ode: times must increase from t0 = " + shortest(t0) + " on", times[i]);
    last = times[i];
  }
}

}  // namespace

OdeSolution solve_ode(const OdeRightSide& right_side, double t0, std::span<const double> y0,
                      std::span<const double> times, const OdeOptions& options) {
  const std::size_t dimension = y0.size();
  check(dimension, t0, times, options);
  OdeSolution solution{dimension, {}};
  solution.states.reserve(times.size() * dimension);
  std::vector<double> state(y0.begin(), y0.end()), absolute = options.absolute_tolerance;
  absolute.resize(dimension, absolute.front());
  const auto keep = [&] { solution.states.insert(solution.states.end(), state.begin(), state.end()); };

  if (!times.empty() && times.front() == t0) {
    keep();
    times = times.subspan(1);
  }
  if (times.empty()) return solution;

  const auto size = static_cast<sunindextype>(dimension);
  Problem problem{right_side, dimension};
  const Context context(make_context());
  const Vector y(made(N_VMake_Serial(size, state.data(), context.get())));
  const Vector tolerance(made(N_VMake_Serial(size, absolute.data(), context.get())));
  N_Vector_Ops operations = y->ops;  // its clones have them too
  operations->nvlinearsum = &linear_sum;
  operations->nvscale = &scale;
  operations->nvwrmsnorm = &weighted_rms;
  operations->nvscaleaddmulti = &scale_add_multi;
  operations->nvlinearcombination = &linear_combination;
  operations->nvscalevectorarray = &scale_vector_array;
  std::unique_ptr<Solver> solver;
  if (options.method == OdeMethod::runge_kutta)
    solver = std::make_unique<RungeKutta>(problem, t0, times.back(), y.get(), tolerance.get(), options, context.get());
  else
    solver = std::make_unique<Multistep>(problem, t0, times.back(), y.get(), tolerance.get(), options, context.get());

  double reached = t0;
  const auto give_up = [&](const std::string& why) { throw OdeFailure(reached, times.back(), why); };
  double last_reached = t0;
  for (const double time : times) {
    int flag;
    while ((flag = solver->advance(time, y.get(), &reached)) == CV_TOO_MUCH_WORK) {
      solution.steps = solver->steps();
      if (solution.steps >= options.max_steps)
        give_up(std::to_string(solution.steps) + " steps done, no more are allowed");
      if (reached == std::exchange(last_reached, reached)) give_up("steps have become too short to get on");
      if (options.progress) options.progress();
    }
    if (problem.thrown) std::rethrow_exception(problem.thrown);
    if (flag == CV_ILL_INPUT)
      throw std::invalid_argument("solve_ode: an absolute tolerance of 0 for a component that is 0");
    if (flag == CV_TOO_CLOSE)  // to t0, by round-off
      std::ranges::copy(y0, state.begin());
    else if (flag < 0)
      give_up(std::unique_ptr<char, decltype(&std::free)>(solver->name(flag), &std::free).get());
    keep();
  }
  solution.steps = solver->steps();
  solution.evaluations = solver->evaluations();
  return solution;
}

}  // namespace stickslip::detail
