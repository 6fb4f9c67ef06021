// The acceleration of a cart where lines of its wheels may stick or slide.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "carts/zonotope.hpp"

namespace stickslip::detail {

/// The acceleration of a cart some of whose lines have no velocity,
///     a = argmin |a - P|^2/2 + sum over lines L |r.a + beta| + sum over feet L |J a|,
/// with P the acceleration under the load and what slides, and beta the rate of sigma without a. Strictly convex in three
/// unknowns: a is unique. Lines with r.a + beta != 0 and feet with J a != 0 start to slide in that direction, the others
/// stick.
///
/// Without feet the sum is quadratic in each cell between planes, and its minimum is found exactly. With feet a logarithmic
/// barrier on the dual, |lambda| <= L, gives a and what sticks without a starting guess, and does not mind dependent rows; the
/// mode is then solved exactly and checked, and what the barrier is not certain of is tried in every way. A tie sticks.
class AccelerationProblem {
 public:
  void clear() noexcept { lines_.clear(); }
  void add(const Vector3& row, double beta, double level) { lines_.push_back({row, {}, beta, level, false}); }
  /// A foot, with the rows of both directions.
  void add(const Vector3& axis, const Vector3& transverse, double level) {
    lines_.push_back({axis, transverse, 0, level, true});
  }
  std::size_t size() const noexcept { return lines_.size(); }

  void solve(const Vector3& p);

  const Vector3& acceleration() const noexcept { return a_; }
  /// +1 or -1, of a foot +1; 0 if it sticks.
  int slides(std::size_t j) const noexcept { return modes_[j]; }
  const std::vector<std::int8_t>& slides() const noexcept { return modes_; }
  /// Whether nothing accelerates.
  bool rests() const noexcept { return rests_; }
  /// How far the mode is from another one, over the accelerations that take part.
  double gap() const noexcept { return gap_; }

 private:
  struct Line {
    Vector3 row, other;
    double beta, level;
    bool foot;

    /// The rate of its speed.
    double rate(const Vector3& a, double scale) const noexcept {
      const double x = dot(row, a) + beta / scale;
      return foot ? std::hypot(x, dot(other, a)) : x;
    }
  };
  struct Trial {
    Vector3 a{};
    double violation = 0;  // over the scale
    double gap = 0;        // the same, of what holds
  };

  double scale_of(const Vector3& p) const noexcept;
  Vector3 barrier(const Vector3& p, double scale);
  void walk(const Vector3& p, double scale);
  Trial search(const Vector3& p, double scale, const Vector3& guess);
  Trial attempt(const Vector3& p, double scale, const std::vector<std::int8_t>& modes, const Vector3& guess);
  Vector3 slide_feet(const Vector3& target, const std::vector<std::int8_t>& modes, Vector3 a) const;

  std::vector<Line> lines_;
  std::vector<std::int8_t> modes_, tried_;
  std::vector<double> certainty_, betas_, rates_;
  std::vector<std::size_t> doubtful_;
  Zonotope stuck_;
  Vector3 a_{};
  double gap_ = 0;
  bool rests_ = false;
};

}  // namespace stickslip::detail
