// A slip in the plane as power series in regularized time.
#pragma once

#include <cmath>
#include <concepts>
#include <utility>

#include "stickslip/base/equal.hpp"
#include "stickslip/base/min_max.hpp"
#include "stickslip/base/vector2.hpp"
#include "stickslip/planar/detail/level_along.hpp"
#include "stickslip/planar/detail/path_series.hpp"
#include "stickslip/planar/path.hpp"
#include "stickslip/series/series.hpp"

namespace stickslip::detail {

/// Largest step of tau times the rate of the motion.
inline constexpr double largest_step = 2;

/// Products of four series at a time, in one loop that a compiler can put into vectors.
struct Four {
  double of[4];
};
inline Four convolve(const double* a, const Four* b, int k) noexcept {
  Four even{}, odd{};
  int i = 0;
  for (; i + 1 <= k; i += 2)
    for (int j = 0; j < 4; ++j) {
      even.of[j] += a[i] * b[k - i].of[j];
      odd.of[j] += a[i + 1] * b[k - i - 1].of[j];
    }
  for (int j = 0; j < 4; ++j) even.of[j] += (i <= k ? a[k] * b[0].of[j] : 0) + odd.of[j];
  return even;
}
inline Four convolve(const Four* a, const Four* b, int k) noexcept {
  Four even{}, odd{};
  int i = 0;
  for (; i + 1 <= k; i += 2)
    for (int j = 0; j < 4; ++j) {
      even.of[j] += a[i].of[j] * b[k - i].of[j];
      odd.of[j] += a[i + 1].of[j] * b[k - i - 1].of[j];
    }
  for (int j = 0; j < 4; ++j) even.of[j] += (i <= k ? a[k].of[j] * b[0].of[j] : 0) + odd.of[j];
  return even;
}

/// A slip as power series in regularized time, up to where their terms reach round-off.
template <class Law>
void expand(PlanarPath& path, const Law& law) {
  const PlanarLoad& p = path.load;
  auto& [t, u, x, y, vx, vy, s, l, order] = path.series;
  const double speed = norm(path.velocity);
  const Vector2 q0 = p.start - path.pull();
  series::Coefficients length, swift, when;
  length[0] = when[0] = 0, swift[0] = speed;
  auto resistance = series::series_of<double>(
      level_along(law, series::Variable{&length}, series::Variable{&swift}, series::Variable{&when}));
  constexpr bool constant = std::same_as<decltype(resistance), series::Constant>;
  path.constant_level = constant && equal(p.weight_rate, 0);
  resistance.update(0);
  const double a = resistance[0], level = p.weight * a;
  path.level = level;
  const double load = norm(q0), wn = std::sqrt(path.spring.stiffness);
  const double steepest = norm(p.rate) + a * std::abs(p.weight_rate);
  const double rate = level + load + (path.damping + wn) * speed + std::sqrt(steepest * speed);
  // The step in tau that takes as long as the segment, at a constant acceleration along the velocity.
  const double speeds_up = dot(q0, path.velocity) / speed - level - path.damping * speed,
               grows = speeds_up * path.duration / speed;
  double h = largest_step / rate;
  if (grows > -0.99) {
    const double needed = path.duration / speed * (std::abs(grows) < 1e-3 ? 1 - grows / 2 : std::log1p(grows) / grows);
    h = std::min(h, 1.0625 * needed);
  }
  const bool springs = path.spring.stiffness > 0, weighed = !equal(p.weight_rate, 0);
  t[0] = x[0] = y[0] = s[0] = 0;
  vx[0] = path.velocity.axis, vy[0] = path.velocity.transverse, u[0] = speed;
  l[0] = level;
  constexpr int highest = PathSeries::highest_order;
  double fastest = speed, farthest = 0, term = 1, longest = 1;
  PathSeries::Array grows_along;  // the velocity along the rate of the load
  // Series side by side, whose products are computed together: r', and u, t; and those with q.
  Four moving[highest + 1], with_load[highest + 1], load_on[highest + 1];
  int k = 0;
  for (;; ++k) {
    const auto conv = [k](const double* c, const double* d) { return series::convolve(c, d, 0, k); };
    if (k > 0) {
      resistance.update(k);
      l[k] = p.weight * resistance[k];
      if (weighed) {
        const auto& level_of = resistance;
        double sum = 0;
        for (int i = 1; i <= k; ++i) sum += t[i] * level_of[k - i];
        l[k] += p.weight_rate * sum;
      }
    }
    moving[k] = {vx[k], vy[k], u[k], t[k]};
    const Four by_speed = convolve(u, moving, k);
    const auto [rx, ry, e, ut] = by_speed.of;
    double ux, uy, qv;
    if (springs) {
      double wx = x[k], wy = y[k];
      if (k == 0) wx = path.place.axis, wy = path.place.transverse;
      if (path.spring.pendulum) {
        double gx = 0, gy = 0;
        if (weighed) {
          gx = t[k] * path.place.axis, gy = t[k] * path.place.transverse;
          for (int i = 1; i < k; ++i) gx += t[i] * x[k - i], gy += t[i] * y[k - i];
        }
        wx = p.weight * wx + p.weight_rate * gx;
        wy = p.weight * wy + p.weight_rate * gy;
      }
      const double qx = p.rate.axis * t[k] - path.spring.stiffness * wx + (k == 0 ? p.start.axis : 0);
      const double qy = p.rate.transverse * t[k] - path.spring.stiffness * wy + (k == 0 ? p.start.transverse : 0);
      load_on[k] = {qx, qy, qx, qy};
      with_load[k] = {u[k], u[k], vx[k], vy[k]};
      const Four products = convolve(load_on, with_load, k);
      const auto [of_x, of_y, work_x, work_y] = products.of;
      ux = of_x, uy = of_y, qv = work_x + work_y;
    } else {
      grows_along[k] = p.rate.axis * vx[k] + p.rate.transverse * vy[k];
      ux = p.start.axis * u[k] + p.rate.axis * ut;
      uy = p.start.transverse * u[k] + p.rate.transverse * ut;
      qv = p.start.axis * vx[k] + p.start.transverse * vy[k] + conv(t, grows_along);
    }
    double lx, ly, lu;
    if (path.constant_level) {
      lx = level * vx[k], ly = level * vy[k], lu = level * u[k];
    } else {
      lx = conv(l, vx), ly = conv(l, vy), lu = conv(l, u);
    }
    const double by = h * series::reciprocal[k + 1];
    vx[k + 1] = by * (ux - lx - path.damping * rx);
    vy[k + 1] = by * (uy - ly - path.damping * ry);
    u[k + 1] = by * (qv - lu - path.damping * e);
    t[k + 1] = by * u[k];
    x[k + 1] = by * rx;
    y[k + 1] = by * ry;
    s[k + 1] = by * e;
    swift[k + 1] = u[k + 1];
    length[k + 1] = s[k + 1];
    when[k + 1] = t[k + 1];
    // The path is a product of two speeds: its terms fall more slowly.
    const double of_speed = std::max(std::abs(vx[k + 1]), std::max(std::abs(vy[k + 1]), std::abs(u[k + 1])));
    fastest = std::max(fastest, of_speed);
    farthest = std::max(farthest, s[k + 1]);
    const double previous = std::exchange(term, std::max(of_speed / fastest, std::abs(s[k + 1]) / farthest));
    if (k >= 2 && std::max(term, previous) <= PathSeries::round_off) break;
    if (k + 1 == highest) {
      // With a shorter step the terms shrink; the largest of them may then be the first.
      const double larger = std::max(std::max(of_speed / speed, std::abs(s[k + 1]) / s[1]), previous);
      longest = larger > 0 ? std::exp2(std::log2(PathSeries::round_off / larger) / (k + 1)) : 1;
      longest = std::max(std::min(longest, 1.0), 0x1p-40);
      break;
    }
  }
  path.series.end(k + 1);
  path.last = longest;
  if constexpr (!constant) keep_to(path, law);
  path.finish();
}

}  // namespace stickslip::detail
