// A plan of FFTW, whose planner is not thread-safe; plans themselves are, through the new-array functions.
#pragma once

#include <fftw3.h>

#include <memory>
#include <mutex>
#include <new>
#include <type_traits>

namespace stickslip::detail {

/// Whoever makes or destroys a plan takes this lock.
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

/// The plan that `make` makes; it should be one by FFTW_ESTIMATE, which chooses by rule: measured plans may differ from
/// one run to the next, and with them the bits.
/// @throws std::bad_alloc if there is none
template <class Make>
FftwPlan make_plan(Make&& make) {
  const std::scoped_lock lock(fftw_planner());
  FftwPlan plan(make());
  if (plan == nullptr) throw std::bad_alloc();
  return plan;
}

}  // namespace stickslip::detail
