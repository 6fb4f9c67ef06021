// A plan of FFTW. The planner is not thread-safe; plans are, through the new-array functions.
#pragma once

#include <fftw3.h>

#include <memory>
#include <mutex>
#include <new>
#include <type_traits>

namespace stickslip::detail {

/// The lock to hold while a plan is made or destroyed.
inline std::mutex& fftw_planner() {
  static std::mutex mutex;
  return mutex;
}

struct DestroyPlan {
  void operator()(fftw_plan plan) const {
    const std::scoped_lock lock(fftw_planner());
    fftw_destroy_plan(plan);
  }
};
using FftwPlan = std::unique_ptr<std::remove_pointer_t<fftw_plan>, DestroyPlan>;

/// The plan that `make` returns. It should use FFTW_ESTIMATE, which chooses by rule: measured plans may differ from run
/// to run, and so would the bits of the results.
/// @throws std::bad_alloc if there is no plan
template <class Make>
FftwPlan make_plan(Make&& make) {
  const std::scoped_lock lock(fftw_planner());
  FftwPlan plan(make());
  if (plan == nullptr) throw std::bad_alloc();
  return plan;
}

}  // namespace stickslip::detail
