#include "carts/acceleration.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace stickslip::detail {
namespace {

// The solution of a symmetric positive definite system.
Vector3 solve_symmetric(const double (&h)[6], const Vector3& b) noexcept {
  // h: xx, xy, xz, yy, yz, zz
  const double l00 = std::sqrt(h[0]), l10 = h[1] / l00, l20 = h[2] / l00;
  const double l11 = std::sqrt(std::max(h[3] - l10 * l10, 1e-300)), l21 = (h[4] - l20 * l10) / l11;
  const double l22 = std::sqrt(std::max(h[5] - l20 * l20 - l21 * l21, 1e-300));
  const double z0 = b[0] / l00, z1 = (b[1] - l10 * z0) / l11, z2 = (b[2] - l20 * z0 - l21 * z1) / l22;
  Vector3 x{};
  x[2] = z2 / l22;
  x[1] = (z1 - l21 * x[2]) / l11;
  x[0] = (z0 - l10 * x[1] - l20 * x[2]) / l00;
  return x;
}

constexpr double last_barrier = 1e-12;
// What decides within this part of the accelerations is a tie.
constexpr double tie = 1e-10;

}  // namespace

double AccelerationProblem::scale_of(const Vector3& p) const noexcept {
  double scale = norm(p);
  for (const Line& line : lines_) {
    const double length = norm(line.row);
    scale = std::max(scale, line.level * length);
    if (length > 0) scale = std::max(scale, std::abs(line.beta) / length);
  }
  return scale;
}

// Newton's method on the conditions of the smoothed problem, in which |x| L is replaced by the largest
// lambda x + mu log(L^2 - lambda^2).
Vector3 AccelerationProblem::barrier(const Vector3& p, double scale) {
  Vector3 a{};
  const Vector3 target = scaled(1 / scale, p);
  const auto push = [](double x, double level, double mu) {
    const double q = std::hypot(mu, x * level);
    return x * level * level / (mu + q);
  };
  const auto residual = [&](const Vector3& at, double mu) {
    Vector3 f = at;
    add_to(f, -1, target);
    for (const Line& line : lines_)
      add_to(f, push(dot(line.row, at) + line.beta / scale, line.level / scale, mu), line.row);
    return f;
  };
  for (double mu = 1; mu >= last_barrier; mu *= 0.1) {
    Vector3 f = residual(a, mu);
    for (int steps = 0; steps < 30; ++steps) {
      double h[6] = {1, 0, 0, 1, 0, 1};
      for (const Line& line : lines_) {
        const double level = line.level / scale, x = dot(line.row, a) + line.beta / scale;
        const double q = std::hypot(mu, x * level), steep = level * level * mu / (q * (mu + q));
        const Vector3& r = line.row;
        h[0] += steep * r[0] * r[0], h[1] += steep * r[0] * r[1], h[2] += steep * r[0] * r[2];
        h[3] += steep * r[1] * r[1], h[4] += steep * r[1] * r[2], h[5] += steep * r[2] * r[2];
      }
      const Vector3 step = solve_symmetric(h, f);
      const double decrement = dot(step, f);
      double part = 1;
      Vector3 next{}, f_next{};
      for (int halvings = 0; halvings < 30; ++halvings, part /= 2) {
        next = a;
        add_to(next, -part, step);
        f_next = residual(next, mu);
        if (dot(step, f_next) > -0.5 * decrement) break;  // not beyond the minimum along the step
      }
      a = next;
      f = f_next;
      if (!(decrement > 1e-3 * mu)) break;
    }
  }
  return a;
}

AccelerationProblem::Trial AccelerationProblem::attempt(const Vector3& p, double scale,
                                                        const std::vector<std::int8_t>& modes) {
  Vector3 target = p;
  stuck_.clear();
  for (std::size_t j = 0; j < lines_.size(); ++j) {
    if (modes[j] == 0)
      stuck_.add(lines_[j].row, lines_[j].level);
    else
      add_to(target, -modes[j] * lines_[j].level, lines_[j].row);
  }
  stuck_.close();
  std::vector<std::size_t> which;  // of the lines that stick
  for (std::size_t j = 0; j < lines_.size(); ++j)
    if (modes[j] == 0) which.push_back(j);

  // The point nearest to the target at which the basis sticks: by Gram-Schmidt, each axis meets its own condition.
  Trial trial;
  trial.a = target;
  Vector3 axes[3];
  for (std::size_t i = 0; i < stuck_.rank(); ++i) {
    const Line& line = lines_[which[stuck_.basis(i)]];
    Vector3 axis = line.row;
    for (int twice = 0; twice < 2; ++twice)
      for (std::size_t l = 0; l < i; ++l) add_to(axis, -dot(axes[l], axis), axes[l]);
    axes[i] = scaled(1 / norm(axis), axis);
    // moving along the axis does not change the conditions before
    add_to(trial.a, -(dot(line.row, trial.a) + line.beta) / dot(line.row, axes[i]), axes[i]);
  }
  Vector3 carried = target;
  add_to(carried, -1, trial.a);
  trial.gap = std::numeric_limits<double>::infinity();
  for (std::size_t j = 0; j < lines_.size(); ++j) {
    const double length = norm(lines_[j].row);
    if (!(length > 0)) continue;
    const double x = (dot(lines_[j].row, trial.a) + lines_[j].beta) / (length * scale);
    if (modes[j] == 0) {
      trial.violation = std::max(trial.violation, std::abs(x));
    } else {
      trial.violation = std::max(trial.violation, -modes[j] * x);
      trial.gap = std::min(trial.gap, modes[j] * x);
    }
  }
  if (stuck_.rank() > 0) {
    const double margin = stuck_.margin(carried) / scale;
    trial.violation = std::max(trial.violation, -margin);
    trial.gap = std::min(trial.gap, margin);
  }
  return trial;
}

void AccelerationProblem::solve(const Vector3& p) {
  const std::size_t count = lines_.size();
  modes_.assign(count, 0);
  rests_ = false;
  gap_ = std::numeric_limits<double>::infinity();
  const double scale = scale_of(p);
  if (!(scale > 0)) {
    a_ = {};
    rests_ = true;
    return;
  }
  const Vector3 guess = barrier(p, scale);
  // x (L - |lambda|) is about the barrier parameter: what is small decides.
  certainty_.resize(count);
  for (std::size_t j = 0; j < count; ++j) {
    const double x = dot(lines_[j].row, guess) + lines_[j].beta / scale;
    const double size = std::abs(x) / std::sqrt(last_barrier);
    modes_[j] = static_cast<std::int8_t>(size < 1 ? 0 : x > 0 ? 1 : -1);
    certainty_[j] = std::abs(std::log(std::max(size, 1e-300)));
  }
  Trial best = attempt(p, scale, modes_);
  if (best.violation > tie) {
    // The least certain lines in every way.
    doubtful_.resize(count);
    std::iota(doubtful_.begin(), doubtful_.end(), std::size_t{0});
    std::sort(doubtful_.begin(), doubtful_.end(),
              [&](std::size_t i, std::size_t j) { return certainty_[i] < certainty_[j]; });
    const std::vector<std::int8_t> first = modes_;
    std::size_t tries = 1;
    for (std::size_t some = 1; some <= std::min<std::size_t>(count, 5) && best.violation > tie; ++some) {
      tries *= 3;
      for (std::size_t number = 0; number < tries && best.violation > tie; ++number) {
        tried_ = first;
        std::size_t digits = number;
        for (std::size_t i = 0; i < some; ++i, digits /= 3)
          tried_[doubtful_[i]] = static_cast<std::int8_t>(static_cast<int>(digits % 3) - 1);
        const Trial trial = attempt(p, scale, tried_);
        if (!(trial.violation < best.violation)) continue;
        best = trial;
        modes_ = tried_;
      }
    }
  }
  // Ties stick.
  for (std::size_t j = 0; j < count; ++j) {
    const double length = norm(lines_[j].row);
    const double x = dot(lines_[j].row, best.a) + lines_[j].beta;
    if (modes_[j] == 0 || !(std::abs(x) <= tie * scale * length)) continue;
    tried_ = modes_;
    tried_[j] = 0;
    const Trial trial = attempt(p, scale, tried_);
    if (trial.violation > tie) continue;
    best = trial;
    modes_ = tried_;
  }
  a_ = best.a;
  gap_ = best.gap;
  rests_ = std::all_of(modes_.begin(), modes_.end(), [](int mode) { return mode == 0; }) && norm(a_) <= tie * scale;
}

}  // namespace stickslip::detail
