// The mean of a sample.
#pragma once

#include <cmath>

namespace test {

/// Mean of independent numbers and its standard error.
struct Mean {
  double sum = 0, squares = 0, count = 0;
  void add(double x) { sum += x, squares += x * x, ++count; }
  double value() const { return sum / count; }
  double error() const { return std::sqrt((squares / count - value() * value()) / (count - 1)); }
};

}  // namespace test
