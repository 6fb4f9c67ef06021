// The acceleration of a cart where lines of its wheels may stick or slide.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "carts/zonotope.hpp"

namespace stickslip::detail {

/// The acceleration of a cart some of whose lines have no velocity,
///     a = argmin |a - P|^2/2 + sum L |r.a + beta|,
/// with P the acceleration under the load and the lines that slide, and beta the rate of sigma without a. Strictly convex in
/// three unknowns: a is unique. Lines with r.a + beta != 0 start to slide with that sign, the others stick.
///
/// A logarithmic barrier on the dual, |lambda| <= L, gives a and the lines that stick without a starting guess, and does not
/// mind dependent rows. The mode is then solved exactly and checked; those lines about which the barrier is not certain are
/// tried in every way. A tie sticks.
class AccelerationProblem {
 public:
  void clear() noexcept { lines_.clear(); }
  void add(const Vector3& row, double beta, double level) { lines_.push_back({row, beta, level}); }
  std::size_t size() const noexcept { return lines_.size(); }

  void solve(const Vector3& p);

  const Vector3& acceleration() const noexcept { return a_; }
  /// +1, -1, or 0 if it sticks.
  int slides(std::size_t j) const noexcept { return modes_[j]; }
  /// Whether all lines stick and nothing accelerates.
  bool rests() const noexcept { return rests_; }
  /// How far the mode is from another one, over the accelerations that take part.
  double gap() const noexcept { return gap_; }

 private:
  struct Line {
    Vector3 row;
    double beta, level;
  };
  struct Trial {
    Vector3 a{};
    double violation = 0;  // over the scale
    double gap = 0;        // the same, of what holds
  };

  double scale_of(const Vector3& p) const noexcept;
  Vector3 barrier(const Vector3& p, double scale);
  Trial attempt(const Vector3& p, double scale, const std::vector<std::int8_t>& modes);

  std::vector<Line> lines_;
  std::vector<std::int8_t> modes_, tried_;
  std::vector<double> certainty_;
  std::vector<std::size_t> doubtful_;
  Zonotope stuck_;
  Vector3 a_{};
  double gap_ = 0;
  bool rests_ = false;
};

}  // namespace stickslip::detail
