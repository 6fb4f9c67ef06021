// The times of samples: their printed precision, and the step of even ones.
#pragma once

#include <limits>
#include <string_view>
#include <vector>

#include "ground/records/formats.hpp"

namespace stickslip::records {

/// The precision of printed times: a number of decimal places, as with %.2f, or of significant digits, as with %.3e
/// and %g.
///
/// Trailing zeros may be left out: the maximum number of places and of digits counts.
class Resolution {
 public:
  void add(std::string_view token);

  /// One unit of the last place of each time [s].
  std::vector<double> units() const;

 private:
  int max_places_ = std::numeric_limits<int>::min() / 2;
  int max_digits_ = 0;
  std::vector<int> decades_{};  // of the first digit of each time
};

/// Sets the step of times that are even within their printed precision, the shortest decimal that fits them all;
/// otherwise keeps the times.
/// @param units  one unit of the last place of each time [s]
void set_times(Channel& channel, const std::vector<double>& times, const std::vector<double>& units);

}  // namespace stickslip::records
