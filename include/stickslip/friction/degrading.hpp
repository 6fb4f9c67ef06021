// Friction that degrades, or wears in, with the distance slid.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "stickslip/base/error.hpp"
#include "stickslip/base/min_max.hpp"
#include "stickslip/base/parts.hpp"
#include "stickslip/friction/law.hpp"
#include "stickslip/state/state.hpp"

namespace stickslip {

/// Friction whose slip level a(s) depends on the total sliding distance s, State::sliding_distance [m]: forward plus
/// backward. It is linear between knots (s_i, a_i) and constant before the first knot and after the last. At rest the
/// level does not change.
///
/// Between two knots, in a slip in one direction, x'' = p(t) - sgn(x') (a + k (s - s_0)) with k = (a_(i+1) - a_i) /
/// (s_(i+1) - s_i). This is the motion under constant friction with a spring of stiffness k. Where the level falls, k
/// is negative and the motion grows or decays exponentially with the rate sqrt(-k); where the level rises, it
/// oscillates with the angular frequency sqrt(k).
class Degrading {
 public:
  /// The law between two knots, for a slip in one direction from a given state.
  class Piece {
   public:
    template <class T>
    auto resist(const T& x, Direction direction) const {
      const Line& line = direction == Direction::forward ? forward_ : backward_;
      return line.level + (sign(direction) * line.slope) * (x - from_);
    }
    /// The derivative of the level with respect to the sliding distance [1/s^2].
    double slope(Direction direction) const noexcept {
      return (direction == Direction::forward ? forward_ : backward_).slope;
    }

   private:
    friend class Degrading;
    struct Line {
      double level, slope;
    };
    Piece(Line forward, Line backward, double from) : forward_(forward), backward_(backward), from_(from) {}

    Line forward_, backward_;
    double from_;
  };

  /// @param distance  s_i of the knots [m]: at least one, finite, at least 0 and increasing
  /// @param levels    a_i of the knots [m/s^2], one for each distance, finite and at least 0
  /// @throws std::invalid_argument naming the value
  Degrading(std::vector<double> distance, std::vector<double> levels)
      : Degrading(std::move(distance), levels, levels) {}

  /// @param levels    against forward sliding [m/s^2]
  /// @param backward  against backward sliding [m/s^2], with the same requirements
  Degrading(std::vector<double> distance, std::vector<double> levels, std::vector<double> backward)
      : distances_(std::move(distance)), forward_(std::move(levels)), backward_(std::move(backward)) {
    detail::require(!distances_.empty(), "Degrading: distance must hold at least one", 0);
    check_count("levels", forward_);
    check_count("backward", backward_);
    for (std::size_t i = 0; i < distances_.size(); ++i) {
      detail::require(std::isfinite(distances_[i]) && distances_[i] >= 0,
                      at_index("distance", i) + " must be finite and at least 0", distances_[i], "m");
      if (i > 0)
        detail::require(
            distances_[i] > distances_[i - 1],
            at_index("distance", i) + " must be above the one before, " + detail::shortest(distances_[i - 1]) + " m",
            distances_[i], "m");
      check_level("levels", i, forward_[i]);
      check_level("backward", i, backward_[i]);
    }
  }

  const std::vector<double>& distances() const noexcept { return distances_; }
  const std::vector<double>& levels() const noexcept { return forward_; }
  const std::vector<double>& backward() const noexcept { return backward_; }

  /// Whether the levels are equal in both directions.
  bool isotropic() const noexcept { return forward_ == backward_; }

  static constexpr const char* class_name = "Degrading";
  static constexpr auto parts() {
    return std::tuple(Part{"distances", &Degrading::distances, "s_i", "m", Range::at_least(0)},
                      Part{"levels", &Degrading::levels, "a_i", "m/s^2", Range::at_least(0)},
                      Part{"backward", &Degrading::backward, "", "m/s^2", Range::at_least(0)});
  }

  /// The law that applies from a state on.
  Piece at(const State& state) const noexcept {
    const std::size_t next = next_knot(state.sliding_distance);
    return {line(forward_, next, state.sliding_distance), line(backward_, next, state.sliding_distance),
            state.displacement};
  }
  /// Distance to the next knot [m].
  double ahead(const State& state, Direction) const noexcept {
    return knot_after(state.sliding_distance) - state.sliding_distance;
  }
  void pass(State& state, Direction direction) const noexcept {
    state.displacement += sign(direction) * ahead(state, direction);
    state.sliding_distance = knot_after(state.sliding_distance);
  }

 private:
  std::size_t next_knot(double slid) const noexcept {
    return static_cast<std::size_t>(std::upper_bound(distances_.begin(), distances_.end(), slid) - distances_.begin());
  }

  double knot_after(double slid) const noexcept {
    const std::size_t next = next_knot(slid);
    return next < distances_.size() ? distances_[next] : std::numeric_limits<double>::infinity();
  }

  Piece::Line line(const std::vector<double>& levels, std::size_t next, double slid) const noexcept {
    if (next == 0) return {levels.front(), 0};
    if (next == levels.size()) return {levels.back(), 0};
    const double slope = (levels[next] - levels[next - 1]) / (distances_[next] - distances_[next - 1]);
    return {std::max(levels[next - 1] + slope * (slid - distances_[next - 1]), 0.0), slope};
  }

  static std::string at_index(const char* name, std::size_t i) {
    return std::string("Degrading: ") + name + "[" + std::to_string(i) + "]";
  }
  void check_count(const char* name, const std::vector<double>& levels) const {
    detail::require(
        levels.size() == distances_.size(),
        std::string("Degrading: ") + name + " must be as many as distances, " + std::to_string(distances_.size()),
        static_cast<double>(levels.size()));
  }
  static void check_level(const char* name, std::size_t i, double level) {
    detail::require(std::isfinite(level) && level >= 0, at_index(name, i) + " must be finite and at least 0", level,
                    "m/s^2");
  }

  std::vector<double> distances_, forward_, backward_;
};

}  // namespace stickslip
