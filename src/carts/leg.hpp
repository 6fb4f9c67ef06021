// The motion of a cart while each line of its wheels slides in one direction or sticks, as a power series in time.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "carts/acceleration.hpp"
#include "carts/model.hpp"
#include "carts/zonotope.hpp"
#include "stickslip/base/equal.hpp"
#include "stickslip/base/error.hpp"
#include "stickslip/flow/closed_form.hpp"
#include "stickslip/flow/power_series.hpp"
#include "stickslip/series/series.hpp"

namespace stickslip::detail {

/// A leg: y, the yaw phi and the headings chi relative to the cart, from
///     u' = w phi' + F_x,   w' = -u phi' + F_y,   (k phi')' = F_3,   chi' = V.n/reach - phi'
/// in the cart's frame, in which the arms are constant. The forces of the lines that stick follow order by order from
/// sigma = 0. Times are in units of its duration, which is shortened until the series converges. Its memory is used again by
/// the next leg.
class CartLeg {
 public:
  using Coefficients = std::array<double, series::highest_order + 1>;

  enum class What { nothing, line, face, foot };
  struct Event {
    double time = never;
    What what = What::nothing;
    std::size_t which = 0;  // the line, the face of the lines that stick, or the foot
    bool tied = false;      // several faces meet
  };

  explicit CartLeg(const CartModel& model)
      : model_(model), rolls_(model.wheels.size()), slides_(model.feet.size()), fresh_(model.contacts()) {}

  /// @param fresh  of each line, how many of the first derivatives of its slip vanish at the start because it begins there
  void begin(const CartState& state, const CartSegment& ground, double begin, const std::vector<std::uint8_t>& fresh) {
    state_ = &state;
    fresh_ = fresh;
    duration_ = ground.duration - begin;
    const Vector2 a0 = ground.ground(begin);
    load_ = -1 * a0;
    load_rate_ = {};
    heavy_ = ground.heavy(begin);
    heavy_rate_ = 0;
    if (ground.duration > 0) {
      load_rate_ = (-1 / ground.duration) * (ground.end - ground.start);
      heavy_rate_ = (ground.heavy_end - ground.heavy_start) / ground.duration;
      // Where N vanishes a leg ends.
      const double turn = ground.weightless();
      if (turn > begin && turn < ground.duration) duration_ = std::min(duration_, turn - begin);
      const bool falls = ground.heavy(begin + duration_ / 2) < 0;
      if (falls) heavy_ = heavy_rate_ = 0;
    }
    heavy_ = std::max(heavy_, 0.0);
    y0_ = model_.velocities(state);
    stick();
    // The terms of the leg before tell how far a series of this cart converges.
    if (radius_ > 0) duration_ = std::min(duration_, 0.16 * radius_);
    const double asked = duration_;
    for (double part; (part = expand()) < 1;) {
      duration_ *= part;
      if (!(duration_ > 0x1p-100 * asked) && asked > 0) refuse();
    }
  }

  double duration() const noexcept { return duration_; }
  const Zonotope& stuck() const noexcept { return stuck_; }
  std::size_t stuck_line(std::size_t j) const noexcept { return stuck_lines_[j]; }
  /// The largest distance of the forces that stick beyond what they can carry, at the start, over what they can carry.
  double excess() const {
    double most = 0;
    if (stuck_foot_ != none) return std::max(foot_part(0) - 1, 0.0);
    for (const Zonotope::Face& face : stuck_.faces())
      most = std::max(most, -margin_at_start(face) / (face.reach * heavy_ + size_of_forces()));
    return most;
  }

  /// The first event.
  Event next() const {
    Event first;
    double w[series::highest_order + 1];
    const auto look = [&](What what, std::size_t which, int degree) {
      int leading = 0;
      while (leading <= degree && equal(w[leading], 0)) ++leading;
      if (leading > degree) return never;
      const double part = w[leading] < 0 ? 0 : FirstRoot(w + leading, degree - leading).find();
      const double time = part < never ? part * duration_ : never;
      if (time < first.time) first = {time, what, which, first.tied};
      return time;
    };
    if (stuck_foot_ != none) {
      const double level = model_.feet[stuck_foot_].coefficient;
      if (stuck_.size() == 0) {
        const int degree = std::min(2 * order_, series::highest_order);
        for (int k = 0; k <= degree; ++k) {
          w[k] = 0;
          for (int i = std::max(0, k - order_); i <= std::min(k, order_); ++i)
            for (std::size_t j = 0; j < 2; ++j)
              w[k] -= margins_[j][static_cast<std::size_t>(i)] * margins_[j][static_cast<std::size_t>(k - i)];
        }
        const double most = level * heavy_, rate = level * heavy_rate_ * duration_;
        w[0] += most * most;
        w[1] += 2 * most * rate;
        w[2] += rate * rate;
        if (w[0] < 1e-12 * most * most) w[0] = 0;  // it has just been found to stick
        look(What::foot, stuck_foot_, degree);
      } else if (const double time = foot_slips(); time < first.time) {
        first = {time, What::foot, stuck_foot_, false};
      }
    }
    const auto& faces = stuck_.faces();
    for (std::size_t f = 0; f < faces.size() && stuck_foot_ == none; ++f) {
      for (int k = 0; k <= order_; ++k) {
        double carried = 0;
        for (std::size_t i = 0; i < rank_; ++i)
          carried += faces[f].normal[i] * margins_[i][static_cast<std::size_t>(k)];
        w[k] = -carried;
      }
      const double size = faces[f].reach * heavy_ + std::abs(w[0]);
      w[0] += faces[f].reach * heavy_;
      if (order_ > 0) w[1] += faces[f].reach * heavy_rate_ * duration_;
      if (w[0] < 1e-12 * size) w[0] = 0;  // it has just been found to stick
      const double before = first.time;
      const double time = look(What::face, f, order_);
      if (time < never && std::abs(time - before) <= 1e-9 * duration_)
        first.tied = true;
      else if (time < before)
        first.tied = false;
    }
    for (std::size_t l = 0; l < model_.lines.size(); ++l) {
      const int sign = state_->lines[l];
      if (sign == 0) continue;
      const Coefficients& sigma = speed(l);
      for (int k = 0; k <= order_; ++k) w[k] = sign * sigma[static_cast<std::size_t>(k)];
      for (int k = 0; k < fresh_[l]; ++k) w[k] = 0;
      if (fresh_[l] == 0 && w[0] < model_.slow) w[0] = std::max(w[0], 0.0);
      look(What::line, l, order_);
    }
    // While the cart turns about a point, a foot can stop on a straight way: |V| changes its sign.
    for (std::size_t f = 0; f < model_.feet.size(); ++f) {
      if (state_->lines[model_.lines.size() + f] == 0 || !(slides_[f].speed[0] > 0)) continue;
      for (int k = 0; k <= order_; ++k) w[k] = slides_[f].speed[static_cast<std::size_t>(k)];
      look(What::line, model_.lines.size() + f, order_);
    }
    return first;
  }

  /// The state at a time from the start of the leg.
  void at(double t, CartState& state) const noexcept {
    const double s = duration_ > 0 ? t / duration_ : 0;
    if (&state != state_) state = *state_;
    Vector3 y;
    for (std::size_t i = 0; i < 3; ++i) y[i] = value(y_[i], s);
    for (const CartModel::Wheel& wheel : model_.wheels) {
      if (wheel.caster == CartModel::none) continue;
      const Roll& roll = rolls_[static_cast<std::size_t>(&wheel - model_.wheels.data())];
      state.headings[wheel.caster] = value(roll.heading, s);
    }
    state.yaw = value(yaw_, s);
    state.displacement = place_ + Vector2{value(x_, s), value(z_, s)};
    model_.set_velocities(state, y);
  }

  // For what watches the motion: coefficients in units of the duration.
  int order() const noexcept { return order_; }
  Vector2 place() const noexcept { return place_; }             // at the start [m]
  const Coefficients& way_axis() const noexcept { return x_; }  // of the center, since the start [m]
  const Coefficients& way_transverse() const noexcept { return z_; }
  const Coefficients& yaw() const noexcept { return yaw_; }
  const Coefficients& cosine() const noexcept { return cosine_; }  // of the yaw
  const Coefficients& sine() const noexcept { return sine_; }

  /// Work of the ground until a time, per unit mass [m^2/s^2].
  double input(double t) const noexcept {
    const double s = duration_ > 0 ? t / duration_ : 0;
    const double dx = value(x_, s), dz = value(z_, s);
    const double mx = t * mean(x_, s), mz = t * mean(z_, s);
    return (load_.axis + load_rate_.axis * t) * dx - load_rate_.axis * mx +
           (load_.transverse + load_rate_.transverse * t) * dz - load_rate_.transverse * mz;
  }
  /// Work against the friction of a line, or after those of a foot, until a time [m^2/s^2].
  double friction(std::size_t l, double t) const noexcept {
    const int sign = state_->lines[l];
    if (sign == 0) return 0;
    const double s = duration_ > 0 ? t / duration_ : 0;
    const bool foot = l >= model_.lines.size();
    const Coefficients& sigma = foot ? slides_[l - model_.lines.size()].speed : speed(l);
    double way = 0, moment = 0;
    for (int k = order_; k >= 0; --k) {
      way = way * s + sigma[static_cast<std::size_t>(k)] * series::reciprocal[k + 1];
      moment = moment * s +
               sigma[static_cast<std::size_t>(k)] * series::reciprocal[std::min(k + 2, series::highest_order + 1)];
    }
    return sign * model_.coefficient(l) * (heavy_ * t * way + heavy_rate_ * t * t * moment);
  }

  double value(const Coefficients& c, double s) const noexcept {
    double sum = 0;
    for (int k = order_; k >= 0; --k) sum = sum * s + c[static_cast<std::size_t>(k)];
    return sum;
  }

 private:
  static constexpr int highest = 24;
  static constexpr double small = 2e-17;

  // The mean over a time since the start.
  double mean(const Coefficients& c, double s) const noexcept {
    double sum = 0;
    for (int k = order_; k >= 0; --k) sum = sum * s + c[static_cast<std::size_t>(k)] * series::reciprocal[k + 1];
    return sum;
  }

  struct Slide {
    Coefficients speed, inverse, x, y;  // of a foot: |V|, 1/|V|, V/|V|
  };
  struct Roll {
    Coefficients heading, turning, cosine, sine;  // relative to the cart; `turning` is its rate
    Coefficients pivot_x, pivot_y;                // velocity of the pivot
    Coefficients across, along;
  };

  const Coefficients& speed(std::size_t l) const noexcept {
    const CartModel::Line& line = model_.lines[l];
    return line.along ? rolls_[line.wheel].along : rolls_[line.wheel].across;
  }
  // What the foot that sticks must carry beside the lines through it, over what it can carry: 1 where it slips. By
  // halving, from 16 equal parts on.
  double foot_part(double s) const {
    Vector3 f{};
    for (std::size_t i = 0; i < 2; ++i) f[i] = value(margins_[i], s);
    const double weight = heavy_ + heavy_rate_ * duration_ * s;
    const double most = model_.feet[stuck_foot_].coefficient * weight;
    if (stuck_.size() == 0) return norm(f) / most;
    // The nearest point of the zonogon of the lines.
    AccelerationProblem& problem = beside_;
    problem.clear();
    for (std::size_t j = 0; j < stuck_.size(); ++j) problem.add(stuck_.row(j), 0, weight * stuck_.level(j));
    problem.solve(f);
    return norm(problem.acceleration()) / most;
  }
  double foot_slips() const {
    constexpr int parts = 16;
    for (int i = 1; i <= parts; ++i) {
      double low = (i - 1.0) / parts, high = static_cast<double>(i) / parts;
      if (!(foot_part(high) > 1)) continue;
      while (high - low > 1e-15) {
        const double middle = low + (high - low) / 2;
        if (middle <= low || middle >= high) break;
        (foot_part(middle) > 1 ? high : low) = middle;
      }
      return high * duration_;
    }
    return never;
  }
  double margin_at_start(const Zonotope::Face& face) const noexcept {
    double carried = 0;
    for (std::size_t i = 0; i < rank_; ++i) carried += face.normal[i] * margins_[i][0];
    return face.reach * heavy_ - carried;
  }
  double size_of_forces() const noexcept {
    double size = norm(load_);
    for (std::size_t i = 0; i < rank_; ++i) size = std::max(size, std::abs(margins_[i][0]));
    return size;
  }

  struct Basis {
    std::size_t wheel;
    bool along;
    Vector3 row;
  };

  // What sticks: the basis, and the lines in terms of it. A foot that sticks gives the basis, and what sticks beside it
  // passes through it.
  void stick() {
    sticking_.clear();
    stuck_lines_.clear();
    stuck_foot_ = none;
    for (std::size_t f = 0; f < model_.feet.size(); ++f)
      if (state_->lines[model_.lines.size() + f] == 0) stuck_foot_ = f;
    if (stuck_foot_ != none) {
      const CartModel::Foot& foot = model_.feet[stuck_foot_];
      sticking_.add(model_.row_axis(foot), 0);
      sticking_.add(model_.row_transverse(foot), 0);
    } else {
      for (std::size_t l = 0; l < model_.lines.size(); ++l)
        if (state_->lines[l] == 0) sticking_.add(model_.row(model_.lines[l], *state_), 0);
    }
    sticking_.close();
    for (std::size_t l = 0; l < model_.lines.size(); ++l)
      if (state_->lines[l] == 0) stuck_lines_.push_back(l);
    rank_ = sticking_.rank();
    Vector3 rows[3], dual[3];  // f = sum (f.dual) row
    for (std::size_t i = 0; i < rank_; ++i) {
      const std::size_t j = stuck_foot_ != none ? i : sticking_.basis(i);
      rows[i] = sticking_.row(j);
      if (stuck_foot_ != none)
        basis_[i] = {model_.feet[stuck_foot_].wheel, i == 0, rows[i]};
      else
        basis_[i] = {model_.lines[stuck_lines_[j]].wheel, model_.lines[stuck_lines_[j]].along, rows[i]};
    }
    if (rank_ == 1) {
      dual[0] = scaled(1 / dot(rows[0], rows[0]), rows[0]);
    } else if (rank_ == 2) {
      const Vector3 w = cross(rows[0], rows[1]);
      dual[0] = scaled(1 / dot(w, w), cross(rows[1], w));
      dual[1] = scaled(1 / dot(w, w), cross(w, rows[0]));
    }
    stuck_.clear();
    for (const std::size_t l : stuck_lines_) {
      const Vector3 row = model_.row(model_.lines[l], *state_);
      Vector3 part{};
      for (std::size_t i = 0; i < rank_; ++i) part[i] = dot(row, dual[i]);
      for (std::size_t i = 0; i < rank_; ++i)
        if (row == rows[i]) part = {}, part[i] = 1;
      stuck_.add(part, model_.lines[l].coefficient);
    }
    stuck_.close();
  }

  // The coefficients. Returns 1, or the part of the duration over which they converge.
  double expand() {
    using series::convolve;
    const double h = duration_, k_gyr = model_.gyration;
    const std::size_t wheels = model_.wheels.size(), rank = rank_;
    place_ = state_->displacement;
    for (std::size_t i = 0; i < 3; ++i) y_[i][0] = y0_[i];
    yaw_[0] = state_->yaw;
    cosine_[0] = std::cos(state_->yaw);
    sine_[0] = std::sin(state_->yaw);
    x_[0] = z_[0] = 0;
    const auto& basis = basis_;
    double gram[3][3]{}, inverse[3][3]{};
    for (std::size_t i = 0; i < rank; ++i)
      for (std::size_t j = 0; j < rank; ++j) gram[i][j] = dot(basis[i].row, basis[j].row);
    if (rank == 1) {
      inverse[0][0] = 1 / gram[0][0];
    } else if (rank == 2) {
      const Vector3 w = cross(basis[0].row, basis[1].row);
      const double det = dot(w, w);
      inverse[0][0] = gram[1][1] / det, inverse[1][1] = gram[0][0] / det;
      inverse[0][1] = inverse[1][0] = -gram[0][1] / det;
    }
    for (std::size_t i = 0; i < wheels; ++i) {
      const CartModel::Wheel& wheel = model_.wheels[i];
      Roll& roll = rolls_[i];
      if (wheel.caster == CartModel::none) {
        roll.cosine[0] = wheel.cosine, roll.sine[0] = wheel.sine;
      } else {
        roll.heading[0] = state_->headings[wheel.caster];
        roll.cosine[0] = std::cos(roll.heading[0]), roll.sine[0] = std::sin(roll.heading[0]);
      }
    }
    double largest = norm(y0_);
    // From rest y ~ t^2, and a wheel across the motion answers with t^7: gaps are no convergence.
    int quiet = 0;
    for (int k = 0; k + 1 <= highest; ++k) {
      const auto at = static_cast<std::size_t>(k), next = at + 1;
      const double per_next = series::reciprocal[k + 1];
      const double yaw_rate = y_[2][at] / k_gyr;
      turning_[at] = h * yaw_rate;
      // The yaw, the way, and the load in the cart's frame.
      yaw_[next] = turning_[at] * per_next;
      cosine_[next] = -convolve(turning_, sine_, 0, k) * per_next;
      sine_[next] = convolve(turning_, cosine_, 0, k) * per_next;
      x_[next] = h * (convolve(y_[0], cosine_, 0, k) - convolve(y_[1], sine_, 0, k)) * per_next;
      z_[next] = h * (convolve(y_[0], sine_, 0, k) + convolve(y_[1], cosine_, 0, k)) * per_next;
      Vector3 force{};
      force[0] = load_.axis * cosine_[at] + load_.transverse * sine_[at];
      force[1] = load_.transverse * cosine_[at] - load_.axis * sine_[at];
      if (k > 0) {
        const std::size_t before = at - 1;
        force[0] += h * (load_rate_.axis * cosine_[before] + load_rate_.transverse * sine_[before]);
        force[1] += h * (load_rate_.transverse * cosine_[before] - load_rate_.axis * sine_[before]);
      }
      if (h > 0) {
        force[0] += convolve(turning_, y_[1], 0, k) / h;
        force[1] -= convolve(turning_, y_[0], 0, k) / h;
      }
      double turns = std::max(std::abs(cosine_[next]), std::abs(sine_[next]));
      for (std::size_t i = 0; i < wheels; ++i) {
        const CartModel::Wheel& wheel = model_.wheels[i];
        Roll& roll = rolls_[i];
        roll.pivot_x[at] = y_[0][at] - y_[2][at] * wheel.lever_y;
        roll.pivot_y[at] = y_[1][at] + y_[2][at] * wheel.lever_x;
        const int across_sign = wheel.across == CartModel::none ? 0 : state_->lines[wheel.across];
        const int along_sign = wheel.along == CartModel::none ? 0 : state_->lines[wheel.along];
        const double across_level =
            wheel.across == CartModel::none ? 0 : across_sign * model_.lines[wheel.across].coefficient;
        const double along_level =
            wheel.along == CartModel::none ? 0 : along_sign * model_.lines[wheel.along].coefficient;
        const bool rolls_straight = wheel.across != CartModel::none && across_sign == 0;
        if (wheel.caster == CartModel::none) {
          roll.across[at] = rolls_straight ? 0 : wheel.cosine * roll.pivot_y[at] - wheel.sine * roll.pivot_x[at];
          roll.along[at] = wheel.along != CartModel::none && along_sign == 0
                               ? 0
                               : wheel.cosine * roll.pivot_x[at] + wheel.sine * roll.pivot_y[at];
          if (k > 0) roll.cosine[at] = roll.sine[at] = 0;
        } else {
          roll.across[at] =
              rolls_straight ? 0 : convolve(roll.cosine, roll.pivot_y, 0, k) - convolve(roll.sine, roll.pivot_x, 0, k);
          if (along_sign != 0)
            roll.along[at] = convolve(roll.cosine, roll.pivot_x, 0, k) + convolve(roll.sine, roll.pivot_y, 0, k);
          else
            roll.along[at] = 0;
          roll.turning[at] = h * (roll.across[at] * wheel.per_reach - yaw_rate);
          roll.heading[next] = roll.turning[at] * per_next;
          roll.cosine[next] = -convolve(roll.turning, roll.sine, 0, k) * per_next;
          roll.sine[next] = convolve(roll.turning, roll.cosine, 0, k) * per_next;
          turns = std::max(turns, std::max(std::abs(roll.cosine[next]), std::abs(roll.sine[next])));
        }
        // -(across n + along e) N, n = (-sin, cos)
        const auto push = [&](std::size_t order, double weight) {
          const double fx = (across_level * roll.sine[order] - along_level * roll.cosine[order]) * weight;
          const double fy = -(across_level * roll.cosine[order] + along_level * roll.sine[order]) * weight;
          force[0] += fx;
          force[1] += fy;
          force[2] += wheel.lever_x * fy - wheel.lever_y * fx;
        };
        push(at, heavy_);
        if (k > 0) push(at - 1, h * heavy_rate_);
      }
      for (std::size_t f = 0; f < model_.feet.size(); ++f) {
        if (state_->lines[model_.lines.size() + f] == 0) continue;
        if (!(heavy_ > 0 || heavy_rate_ > 0)) {
          slides_[f].speed[at] = 0;
          continue;
        }
        const CartModel::Foot& foot = model_.feet[f];
        const CartModel::Wheel& wheel = model_.wheels[foot.wheel];
        const Roll& roll = rolls_[foot.wheel];
        Slide& slide = slides_[f];
        const double square = convolve(roll.pivot_x, roll.pivot_x, 0, k) + convolve(roll.pivot_y, roll.pivot_y, 0, k);
        if (k == 0) {
          slide.speed[0] = std::sqrt(square);
          slide.inverse[0] = 1 / slide.speed[0];
        } else {
          // speed^2 = square, speed inverse = 1
          slide.speed[at] = 0;
          slide.speed[at] = (square - convolve(slide.speed, slide.speed, 0, k)) / (2 * slide.speed[0]);
          slide.inverse[at] = 0;
          slide.inverse[at] = -convolve(slide.speed, slide.inverse, 0, k) / slide.speed[0];
        }
        slide.x[at] = convolve(slide.inverse, roll.pivot_x, 0, k);
        slide.y[at] = convolve(slide.inverse, roll.pivot_y, 0, k);
        const auto push = [&](std::size_t order, double weight) {
          const double fx = -foot.coefficient * weight * slide.x[order],
                       fy = -foot.coefficient * weight * slide.y[order];
          force[0] += fx;
          force[1] += fy;
          force[2] += wheel.lever_x * fy - wheel.lever_y * fx;
        };
        push(at, heavy_);
        if (k > 0) push(at - 1, h * heavy_rate_);
      }
      // The forces of the basis, as far as they are known.
      for (std::size_t i = 0; i < rank; ++i) {
        const Roll& roll = rolls_[basis[i].wheel];
        margins_[i][at] = 0;
        push_line(force, basis[i].wheel, basis[i].along, convolve(margins_[i], roll.cosine, 0, k),
                  convolve(margins_[i], roll.sine, 0, k));
      }
      Vector3 y{};
      for (std::size_t i = 0; i < 3; ++i) y[i] = h * force[i] * per_next;
      if (rank > 0) {
        double known[3];  // of the rate of each speed, without the next order of the velocities
        for (std::size_t i = 0; i < rank; ++i) {
          Roll& roll = rolls_[basis[i].wheel];
          roll.pivot_x[next] = roll.pivot_y[next] = 0;
          if (model_.wheels[basis[i].wheel].caster == CartModel::none) roll.cosine[next] = roll.sine[next] = 0;
          known[i] = basis[i].along
                         ? convolve(roll.cosine, roll.pivot_x, 0, k + 1) + convolve(roll.sine, roll.pivot_y, 0, k + 1)
                         : convolve(roll.cosine, roll.pivot_y, 0, k + 1) - convolve(roll.sine, roll.pivot_x, 0, k + 1);
        }
        // Twice, so that what is left is round-off of the velocities, not of the forces.
        for (int twice = 0; twice < 2; ++twice) {
          double rest[3];
          for (std::size_t i = 0; i < rank; ++i) rest[i] = known[i] + dot(basis[i].row, y);
          for (std::size_t i = 0; i < rank; ++i) {
            double change = 0;  // lambda_k h / (k + 1)
            for (std::size_t j = 0; j < rank; ++j) change += inverse[i][j] * rest[j];
            if (h > 0) margins_[i][at] += change * (k + 1) / h;
            add_to(y, -change, basis[i].row);
          }
        }
      }
      for (std::size_t i = 0; i < 3; ++i) y_[i][next] = y[i];
      const double term = norm(y);
      largest = std::max(largest, term);
      quiet = term <= small * largest && turns <= small ? quiet + 1 : 0;
      if (k >= 3 && quiet >= (model_.casters > 0 && norm(y0_) < 1e-6 * largest ? 5 : 2)) {
        order_ = k;
        radius_ = h * std::pow(small, -1.0 / std::max(k, 8));
        return 1;
      }
      if (k + 2 > highest) {
        const double over = std::max(largest > 0 ? term / largest : 0, turns) / small;
        const double part = over < never ? std::pow(over, -1.0 / k) : 0.01;
        return std::min(std::max(part, 0.01), 0.75);
      }
    }
    return 0.5;
  }

  void push_line(Vector3& force, std::size_t wheel, bool along, double c, double s) const noexcept {
    // -lambda d, with lambda cos = c and lambda sin = s
    const double fx = along ? -c : s, fy = along ? -s : -c;
    const CartModel::Wheel& at = model_.wheels[wheel];
    force[0] += fx;
    force[1] += fy;
    force[2] += at.lever_x * fy - at.lever_y * fx;
  }

  [[noreturn]] void refuse() const {
    throw ConvergenceError("the motion of the cart has no finite power series at " + shortest(norm(y0_)) + " m/s");
  }

  const CartModel& model_;
  const CartState* state_ = nullptr;
  double duration_ = 0;
  double radius_ = 0;  // of convergence, about [s]
  Vector2 load_{}, load_rate_{};
  double heavy_ = 0, heavy_rate_ = 0;  // N [m/s^2] and its rate
  Vector3 y0_{};
  Vector2 place_{};
  int order_ = 0;
  std::array<Coefficients, 3> y_;
  Coefficients yaw_, turning_, cosine_, sine_, x_, z_;
  std::vector<Roll> rolls_;
  std::vector<Slide> slides_;
  static constexpr std::size_t none = CartModel::none;
  std::array<Basis, 3> basis_{};
  std::size_t rank_ = 0;
  std::size_t stuck_foot_ = none;
  std::array<Coefficients, 3> margins_;  // the forces of the basis
  std::vector<std::uint8_t> fresh_;
  Zonotope sticking_, stuck_;  // of rows; of the parts of lines in the basis
  mutable AccelerationProblem beside_;
  std::vector<std::size_t> stuck_lines_;
};

}  // namespace stickslip::detail
