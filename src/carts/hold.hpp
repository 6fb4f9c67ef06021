// What a cart at rest can carry.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

#include "carts/acceleration.hpp"
#include "carts/model.hpp"
#include "carts/zonotope.hpp"
#include "stickslip/flow/closed_form.hpp"

namespace stickslip::detail {

/// The loads that a resting cart carries, over its weight: a zonotope of its lines, to which each foot adds a disc.
class CartHold {
 public:
  CartHold() = default;
  CartHold(const CartModel& model, const CartState& state) { set(model, state); }

  void set(const CartModel& model, const CartState& state) {
    lines_.clear();
    feet_.clear();
    known_.clear();
    for (const CartModel::Line& line : model.lines) lines_.add(model.row(line, state), line.coefficient);
    for (const CartModel::Foot& foot : model.feet)
      feet_.push_back({model.row_axis(foot), model.row_transverse(foot), foot.coefficient});
    lines_.close();
  }

  const Zonotope& lines() const noexcept { return lines_; }
  bool has_feet() const noexcept { return !feet_.empty(); }

  /// The largest load that is carried against a direction: sum level |u.row| + sum level |J u|.
  double support(const Vector3& u) const noexcept {
    double sum = 0;
    for (std::size_t j = 0; j < lines_.size(); ++j) sum += lines_.level(j) * std::abs(dot(u, lines_.row(j)));
    for (const Disc& foot : feet_) sum += foot.level * std::hypot(dot(u, foot.axis), dot(u, foot.transverse));
    return sum;
  }
  /// Where a load leaves what holds, with weight N: a normal to its surface. False if it does not, or by less than 1e-7 of it
  /// or the round-off of what holds: without a load the problem finds no exact zero.
  bool leaves(const Vector3& load, double weight, Vector3& normal) {
    problem_.clear();
    double held = 0;
    for (std::size_t j = 0; j < lines_.size(); ++j) {
      problem_.add(lines_.row(j), 0, weight * lines_.level(j));
      held += weight * lines_.level(j);
    }
    for (const Disc& foot : feet_) {
      problem_.add(foot.axis, foot.transverse, weight * foot.level);
      held += weight * foot.level;
    }
    problem_.solve(load);
    if (norm(problem_.acceleration()) <= 1e-7 * norm(load) + 1e-13 * held) return false;
    normal = scaled(1 / norm(problem_.acceleration()), problem_.acceleration());
    return true;
  }
  /// Whether a load in the plane is carried, as far as is known: what is carried is convex, and so is what is known of it.
  bool surely_carries(const Vector3& load, double weight) const noexcept {
    for (std::size_t i = 0; i < known_.size(); ++i) {
      const Vector2& b = known_[i];
      // Along one direction, what is known is narrow.
      const double square = stickslip::dot(b, b), along = b.axis * load[0] + b.transverse * load[1],
                   beside = b.axis * load[1] - b.transverse * load[0];
      if (std::abs(along) <= weight * square && std::abs(beside) <= 1e-9 * weight * square) return true;
      for (std::size_t j = i + 1; j < known_.size(); ++j) {
        const Vector2& c = known_[j];
        const double area = std::abs(stickslip::cross(b, c)), other = c.axis * load[1] - c.transverse * load[0];
        // Between two loads along one line there is nothing.
        if (area > 1e-6 * norm(b) * norm(c) && std::abs(beside) + std::abs(other) <= weight * area) return true;
      }
    }
    return false;
  }
  /// Finds what is carried in the direction of a load in the plane, for `surely_carries`.
  void learn(const Vector3& load) {
    constexpr std::size_t most = 8;
    if (!(norm(load) > 0)) return;
    if (known_.size() == most) known_.erase(known_.begin());
    const double part = 0.999 * along(load);
    known_.push_back({part * load[0], part * load[1]});
  }
  /// The largest multiple of a load that is carried.
  double along(const Vector3& load) {
    if (feet_.empty()) {
      if (norm(lines_.outside(load)) > 1e-12 * norm(load)) return 0;
      double least = std::numeric_limits<double>::infinity();
      for (const Zonotope::Face& face : lines_.faces())
        if (const double to = dot(face.normal, load); to > 0) least = std::min(least, face.reach / to);
      return least;
    }
    // From outside each plane cuts nearer.
    Vector3 normal = scaled(1 / norm(load), load);
    double most = support(normal) / dot(normal, load);
    for (int steps = 0; steps < 100 && leaves(scaled(most, load), 1, normal); ++steps) {
      const double next = support(normal) / dot(normal, load);
      if (!(next < most)) break;
      most = next;
    }
    return most;
  }

 private:
  struct Disc {
    Vector3 axis, transverse;
    double level;
  };
  Zonotope lines_;
  std::vector<Disc> feet_;
  std::vector<Vector2> known_;  // loads that are carried, over the weight; their opposites are too
  AccelerationProblem problem_;
};

}  // namespace stickslip::detail
