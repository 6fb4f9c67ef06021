// What a slider in lanes is held against.
#pragma once

#include <algorithm>
#include <cmath>

#include "stickslip/sliding/advance.hpp"

namespace test {

/// Watches one slider: its largest |x| and how many events there were.
struct Watch {
  double peak = 0;
  int events = 0;
  void slide(const stickslip::Slip& slip) { peak = std::max(peak, std::abs(slip.to())); }
  void event(stickslip::EventKind, double, const stickslip::State&) { ++events; }
};

}  // namespace test
