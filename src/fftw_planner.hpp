// FFTW's planner is not thread-safe, its plans are: whoever makes or destroys a plan takes this lock.
#pragma once

#include <mutex>

namespace stickslip::detail {

inline std::mutex& fftw_planner() {
  static std::mutex mutex;
  return mutex;
}

}  // namespace stickslip::detail
