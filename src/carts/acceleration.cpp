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
  const double l11 = std::sqrt(std::max(h[3] - l10 * l10, 1e-16 * h[3])), l21 = (h[4] - l20 * l10) / l11;
  const double l22 = std::sqrt(std::max(h[5] - l20 * l20 - l21 * l21, 1e-16 * h[5]));
  const double z0 = b[0] / l00, z1 = (b[1] - l10 * z0) / l11, z2 = (b[2] - l20 * z0 - l21 * z1) / l22;
  Vector3 x{};
  x[2] = z2 / l22;
  x[1] = (z1 - l21 * x[2]) / l11;
  x[0] = (z0 - l10 * x[1] - l20 * x[2]) / l00;
  return x;
}

constexpr int last_barrier = 12;  // its negative power of 10
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
  rates_.assign(lines_.size(), 0);
  const Vector3 target = scaled(1 / scale, p);
  // All is over the scale: no square overflows.
  const auto size = [](double x, double y) { return std::sqrt(x * x + y * y); };
  const auto push = [&size](double x, double level, double mu) {
    const double q = size(mu, x * level);
    return x * level * level / (mu + q);
  };
  const auto residual = [&](const Vector3& at, double mu) {
    Vector3 f = at;
    add_to(f, -1, target);
    for (const Line& line : lines_) {
      const double x = dot(line.row, at) + line.beta / scale, level = line.level / scale;
      if (!line.foot) {
        add_to(f, push(x, level, mu), line.row);
        continue;
      }
      const double z = dot(line.other, at), speed = size(x, z);
      const double by = level * level / (mu + size(mu, speed * level));  // the force over the speed
      add_to(f, by * x, line.row);
      add_to(f, by * z, line.other);
    }
    return f;
  };
  for (int tens = 0; tens <= last_barrier; ++tens) {
    const double mu = std::pow(10.0, -tens);
    if (tens == last_barrier - 1)
      for (std::size_t j = 0; j < lines_.size(); ++j) rates_[j] = lines_[j].rate(a, scale);
    Vector3 f = residual(a, mu);
    for (int steps = 0; steps < 30; ++steps) {
      double h[6] = {1, 0, 0, 1, 0, 1};
      const auto stiffen = [&h](double by, const Vector3& r, const Vector3& o) {
        h[0] += by * r[0] * o[0], h[1] += by * (r[0] * o[1] + r[1] * o[0]) / 2;
        h[2] += by * (r[0] * o[2] + r[2] * o[0]) / 2, h[3] += by * r[1] * o[1];
        h[4] += by * (r[1] * o[2] + r[2] * o[1]) / 2, h[5] += by * r[2] * o[2];
      };
      for (const Line& line : lines_) {
        const double level = line.level / scale, x = dot(line.row, a) + line.beta / scale;
        const double z = line.foot ? dot(line.other, a) : 0, speed = line.foot ? size(x, z) : x;
        const double q = size(mu, speed * level), steep = level * level * mu / (q * (mu + q));
        if (!line.foot) {
          stiffen(steep, line.row, line.row);
          continue;
        }
        const double flat = level * level / (mu + q);  // across the direction of its speed
        const double c = speed > 0 ? x / speed : 1, s = speed > 0 ? z / speed : 0;
        stiffen(steep * c * c + flat * s * s, line.row, line.row);
        stiffen(steep * s * s + flat * c * c, line.other, line.other);
        stiffen(2 * (steep - flat) * c * s, line.row, line.other);
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
                                                        const std::vector<std::int8_t>& modes, const Vector3& guess) {
  Vector3 target = p;
  stuck_.clear();
  betas_.clear();
  bool foot_slides = false;
  std::size_t feet_stuck = 0;
  double foot_level = 0;
  for (std::size_t j = 0; j < lines_.size(); ++j) {
    const Line& line = lines_[j];
    if (modes[j] != 0) {
      if (line.foot)
        foot_slides = true;
      else
        add_to(target, -modes[j] * line.level, line.row);
      continue;
    }
    stuck_.add(line.row, line.level);
    betas_.push_back(line.beta);
    if (!line.foot) continue;
    stuck_.add(line.other, line.level);
    betas_.push_back(0);
    ++feet_stuck;
    foot_level = line.level;
  }
  stuck_.close();

  // The point nearest to the target at which the basis sticks: by Gram-Schmidt, each axis meets its own condition. From
  // within what the rows leave free, round-off is not magnified where they are almost parallel.
  Trial trial;
  trial.a = stuck_.outside(foot_slides ? guess : target);
  Vector3 axes[3];
  for (std::size_t i = 0; i < stuck_.rank(); ++i) {
    const Vector3& row = stuck_.row(stuck_.basis(i));
    Vector3 axis = row;
    for (int twice = 0; twice < 2; ++twice)
      for (std::size_t l = 0; l < i; ++l) add_to(axis, -dot(axes[l], axis), axes[l]);
    axes[i] = scaled(1 / norm(axis), axis);
    // moving along the axis does not change the conditions before
    add_to(trial.a, -(dot(row, trial.a) + betas_[stuck_.basis(i)]) / dot(row, axes[i]), axes[i]);
  }
  if (foot_slides) trial.a = slide_feet(target, modes, trial.a);
  Vector3 carried = target;
  add_to(carried, -1, trial.a);
  trial.gap = std::numeric_limits<double>::infinity();
  for (std::size_t j = 0; j < lines_.size(); ++j) {
    const double length = norm(lines_[j].row);
    if (!(length > 0)) continue;
    const double x = lines_[j].rate(trial.a, 1) / (length * scale);
    if (modes[j] == 0) {
      trial.violation = std::max(trial.violation, std::abs(x));
    } else {
      trial.violation = std::max(trial.violation, -modes[j] * x);
      trial.gap = std::min(trial.gap, modes[j] * x);
    }
  }
  if (stuck_.rank() > 0) {
    for (std::size_t j = 0; j < lines_.size(); ++j) {
      if (modes[j] == 0 || !lines_[j].foot) continue;
      const double x = dot(lines_[j].row, trial.a), z = dot(lines_[j].other, trial.a), speed = std::hypot(x, z);
      if (!(speed > 0)) continue;
      add_to(carried, -lines_[j].level * x / speed, lines_[j].row);
      add_to(carried, -lines_[j].level * z / speed, lines_[j].other);
    }
    double margin;
    if (feet_stuck == 0) {
      margin = stuck_.margin(carried) / scale;
    } else if (feet_stuck == 1 && stuck_.size() == 2) {
      margin = (foot_level - std::hypot(carried[0], carried[1])) / scale;  // its rows are (1, 0, .) and (0, 1, .)
    } else {
      // What several feet, or a foot with lines, carry together is not checked: the mode must lead to where the barrier does.
      Vector3 off = trial.a;
      add_to(off, -1, guess);
      margin = 1e-5 - norm(off) / scale;
    }
    trial.violation = std::max(trial.violation, -margin);
    trial.gap = std::min(trial.gap, margin);
  }
  return trial;
}

// Newton's method for the directions of the feet that slide, within what the rows that stick leave free.
// Near a tie, where all rates are round-off, the guess stays.
Vector3 AccelerationProblem::slide_feet(const Vector3& target, const std::vector<std::int8_t>& modes, Vector3 a) const {
  const Vector3 start = a;
  const double least = tie * norm(target);
  for (int steps = 0; steps < 40; ++steps) {
    Vector3 f = a;
    add_to(f, -1, target);
    double h[3][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    for (std::size_t j = 0; j < lines_.size(); ++j) {
      const Line& line = lines_[j];
      if (!line.foot || modes[j] == 0) continue;
      const double x = dot(line.row, a), z = dot(line.other, a), speed = std::hypot(x, z);
      if (!(speed > least)) return start;
      add_to(f, line.level * x / speed, line.row);
      add_to(f, line.level * z / speed, line.other);
      Vector3 across = scaled(-z / speed, line.row);
      add_to(across, x / speed, line.other);
      for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t l = 0; l < 3; ++l) h[i][l] += line.level / speed * across[i] * across[l];
    }
    // A direction that the stuck rows forbid is made infinitely stiff by leaving it out.
    f = stuck_.outside(f);
    double k[6];
    const auto project = [&](const Vector3& v) { return stuck_.outside(v); };
    Vector3 columns[3];
    for (std::size_t l = 0; l < 3; ++l) {
      Vector3 unit{};
      unit[l] = 1;
      const Vector3 free = project(unit);
      Vector3 column{};
      for (std::size_t i = 0; i < 3; ++i) column[i] = h[i][0] * free[0] + h[i][1] * free[1] + h[i][2] * free[2];
      columns[l] = project(column);
      Vector3 rest = unit;
      add_to(rest, -1, free);
      add_to(columns[l], 1, rest);
    }
    k[0] = columns[0][0], k[1] = columns[1][0], k[2] = columns[2][0];
    k[3] = columns[1][1], k[4] = columns[2][1], k[5] = columns[2][2];
    Vector3 step = stuck_.outside(solve_symmetric(k, f));
    // A foot does not pass its turning point in one step.
    double part = 1;
    for (std::size_t j = 0; j < lines_.size(); ++j) {
      const Line& line = lines_[j];
      if (!line.foot || modes[j] == 0) continue;
      const double speed = std::hypot(dot(line.row, a), dot(line.other, a));
      const double change = std::hypot(dot(line.row, step), dot(line.other, step));
      if (change > speed / 2) part = std::min(part, speed / (2 * change));
    }
    add_to(a, -part, step);
    if (norm(step) <= 1e-16 * (norm(a) + norm(step))) break;
  }
  return norm(a) <= 2 * norm(target) + norm(start) ? a : start;
}

// The mode to which the barrier leads, and those about which it is not certain in every way.
AccelerationProblem::Trial AccelerationProblem::search(const Vector3& p, double scale, const Vector3& guess) {
  const std::size_t count = lines_.size();
  // x (L - |lambda|) is about the barrier parameter, and two powers of ten lie between both rates: of what sticks x falls
  // with it, of what slides L - |lambda|.
  certainty_.resize(count);
  for (std::size_t j = 0; j < count; ++j) {
    const double x = lines_[j].rate(scaled(1 / scale, guess), scale), before = rates_[j];
    const double falls = std::abs(before) / std::max(std::abs(x), 1e-300);
    modes_[j] = static_cast<std::int8_t>(falls > 10 ? 0 : x > 0 ? 1 : -1);
    certainty_[j] = std::abs(std::log(std::max(falls, 1e-300) / 10));
  }
  Trial best = attempt(p, scale, modes_, guess);
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
        const Trial trial = attempt(p, scale, tried_, guess);
        if (!(trial.violation < best.violation)) continue;
        best = trial;
        modes_ = tried_;
      }
    }
  }
  return best;
}

// Without feet the sum is quadratic between planes r.a + beta = 0: from the acceleration without friction to the minimum of
// each cell, along which signs change, a line joins those that stick where the slope changes its sign, and those that leave
// a face of what sticks are released. The sum falls with each step, so no cell comes twice.
void AccelerationProblem::walk(const Vector3& p, double scale) {
  const std::size_t count = lines_.size();
  Vector3 a = p;
  for (std::size_t j = 0; j < count; ++j) modes_[j] = static_cast<std::int8_t>(lines_[j].rate(a, 1) < 0 ? -1 : 1);
  for (int steps = 0; steps < 200; ++steps) {
    Vector3 target = p;
    stuck_.clear();
    for (std::size_t j = 0; j < count; ++j) {
      if (modes_[j] != 0)
        add_to(target, -modes_[j] * lines_[j].level, lines_[j].row);
      else
        stuck_.add(lines_[j].row, lines_[j].level);
    }
    stuck_.close();
    Vector3 pull = target;
    add_to(pull, -1, a);
    const Vector3 way = stuck_.outside(pull);
    const double square = dot(way, way);
    if (norm(way) > 1e-15 * scale) {
      // Where the slope along the way vanishes or changes its sign.
      double slope = -square, part = 0;
      for (;;) {
        double next = 2;
        std::size_t which = count;
        for (std::size_t j = 0; j < count; ++j) {
          const double along = modes_[j] * dot(lines_[j].row, way);
          if (!(along < 0)) continue;
          const double at = std::max(-modes_[j] * lines_[j].rate(a, 1) / along, part);
          if (at < next) next = at, which = j;
        }
        const double free = part - slope / square;  // where the slope would vanish
        if (which == count || next >= free) {
          part = free;
          break;
        }
        slope += square * (next - part);
        part = next;
        const double jump = 2 * lines_[which].level * std::abs(dot(lines_[which].row, way));
        if (slope + jump >= 0) {
          modes_[which] = 0;
          break;
        }
        slope += jump;
        modes_[which] = static_cast<std::int8_t>(-modes_[which]);
      }
      add_to(a, part, way);
      continue;
    }
    // The minimum of the cell: what sticks carries the rest, or leaves through its most loaded face.
    const Zonotope::Face* worst = nullptr;
    double least = -1e-14 * scale;
    for (const Zonotope::Face& face : stuck_.faces()) {
      const double margin = face.reach - dot(face.normal, pull);
      if (margin < least) least = margin, worst = &face;
    }
    if (worst == nullptr) return;
    const Vector3 normal = worst->normal;
    std::size_t i = 0;
    for (std::size_t j = 0; j < count; ++j) {
      if (modes_[j] != 0) continue;
      modes_[j] = static_cast<std::int8_t>(stuck_.leaves(normal, i));
      ++i;
    }
  }
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
  Trial best;
  Vector3 guess{};
  if (std::any_of(lines_.begin(), lines_.end(), [](const Line& line) { return line.foot; })) {
    guess = scaled(scale, barrier(p, scale));
    best = search(p, scale, guess);
  } else {
    walk(p, scale);
    best = attempt(p, scale, modes_, guess);
  }
  // Ties stick.
  for (std::size_t j = 0; j < count; ++j) {
    const double length = norm(lines_[j].row);
    const double x = lines_[j].rate(best.a, 1);
    if (modes_[j] == 0 || !(std::abs(x) <= tie * scale * length)) continue;
    tried_ = modes_;
    tried_[j] = 0;
    const Trial trial = attempt(p, scale, tried_, guess);
    if (trial.violation > tie) continue;
    best = trial;
    modes_ = tried_;
  }
  a_ = best.a;
  gap_ = best.gap;
  rests_ = norm(a_) <= tie * scale;
}

}  // namespace stickslip::detail
