// A slip in the plane along a circular stop.
#pragma once

#include <cmath>
#include <concepts>

#include "stickslip/base/equal.hpp"
#include "stickslip/base/min_max.hpp"
#include "stickslip/base/vector2.hpp"
#include "stickslip/flow/closed_form.hpp"
#include "stickslip/flow/power_series.hpp"
#include "stickslip/planar/detail/level_along.hpp"
#include "stickslip/planar/detail/path_series.hpp"
#include "stickslip/planar/detail/radius.hpp"
#include "stickslip/planar/path.hpp"
#include "stickslip/series/series.hpp"

namespace stickslip::detail {

/// Along a circular stop through the present place, as a power series in time: its angle psi, and
///     u' = p.e - w a - c u,   psi' = +-u/d,   reaction = p.r/d - wn^2 d + u^2/d.
/// Up to a stop of the motion, the first term of the reaction that is not round-off decides whether it leaves at once;
/// without one it does not.
/// @param side      1 if it moves in the direction of the place turned clockwise, -1 if in the opposite one
/// @param at_level  whether it starts from rest under a load that equals the level
/// @return false if it leaves at once
template <class Law>
bool move_along(PlanarPath& path, const Law& law, int side, bool at_level) {
  const PlanarLoad& p = path.load;
  auto& [t, u, x, y, vx, vy, s, l, order] = path.series;
  const double gap = norm(path.place), speed = norm(path.velocity), way = side;
  const Vector2 outward = (1 / gap) * path.place, sideways = turned(outward);
  const double spring = path.spring.under(p.weight), spring_rate = path.spring.rate(p.weight_rate);
  const double centrifugal = speed * speed / gap, unknown = graze * (path.largest_load() + spring * gap + centrifugal);
  const double pa = dot(p.start, outward), pb = dot(p.start, sideways);
  PathSeries::Array c, d, reaction;
  reaction[0] = pa - spring * gap + centrifugal;
  if (reaction[0] < -unknown) return false;
  series::Coefficients length, swift, when;
  length[0] = when[0] = 0, swift[0] = speed;
  auto resistance = series::series_of<double>(
      level_along(law, series::Variable{&length}, series::Variable{&swift}, series::Variable{&when}));
  resistance.update(0);
  path.constant_level = std::same_as<decltype(resistance), series::Constant> && equal(p.weight_rate, 0);
  path.level = l[0] = p.weight * resistance[0];
  double h = path.duration;
  const double rate = speed / gap + std::sqrt((norm(p.start) + path.level) / gap) +
                      std::cbrt((norm(p.rate) + resistance[0] * std::abs(p.weight_rate)) / gap) + path.damping;
  if (rate > 0) h = std::min(h, 1 / rate);
  // The direction of the place, cosine and sine in the frame of the start; the load in this frame.
  const double ga = h * dot(p.rate, outward), gb = h * dot(p.rate, sideways);
  c[0] = 1, d[0] = 0;
  u[0] = speed;
  t[0] = x[0] = y[0] = s[0] = 0;
  vx[0] = path.velocity.axis, vy[0] = path.velocity.transverse;
  bool rests = !(speed > 0);
  for (int k = 0; k < PathSeries::highest_order; ++k) {
    const double by = h * series::reciprocal[k + 1];
    if (k > 0) {
      resistance.update(k);
      l[k] = p.weight * resistance[k] + p.weight_rate * h * resistance[k - 1];
    }
    double along = -pa * d[k] + pb * c[k];
    if (k > 0) along += -ga * d[k - 1] + gb * c[k - 1];
    u[k + 1] = by * (way * along - l[k] - path.damping * u[k]);
    // It departs. Under a load that equals the level, the speed grows with the square of the time.
    if (rests) {
      if ((k == 0 && at_level) || !(u[k + 1] > 0)) u[k + 1] = 0;
      rests = !(u[k + 1] > 0);
    }
    const double angle = way / gap * h;  // per unit of u
    c[k + 1] = -angle * series::reciprocal[k + 1] * series::convolve(u, d, 0, k);
    d[k + 1] = angle * series::reciprocal[k + 1] * series::convolve(u, c, 0, k);
    s[k + 1] = by * u[k];
    t[k + 1] = k == 0 ? h : 0;
    swift[k + 1] = u[k + 1];
    length[k + 1] = s[k + 1];
    when[k + 1] = t[k + 1];
    const int j = k + 1;
    reaction[j] = pa * c[j] + pb * d[j] + ga * c[j - 1] + gb * d[j - 1] - (j == 1 ? spring_rate * h * gap : 0) +
                  series::convolve(u, u, 0, j) / gap;
    x[j] = gap * (c[j] * outward.axis + d[j] * sideways.axis);
    y[j] = gap * (c[j] * outward.transverse + d[j] * sideways.transverse);
    const double va = -way * series::convolve(u, d, 0, j), vb = way * series::convolve(u, c, 0, j);
    vx[j] = va * outward.axis + vb * sideways.axis;
    vy[j] = va * outward.transverse + vb * sideways.transverse;
  }
  path.series.end(PathSeries::highest_order);
  const double fastest = speed + h * (norm(p.start) + path.level + h * norm(p.rate));
  path.last = 1;
  for (const int k : {order - 1, order}) {
    const double term = std::max(std::abs(u[k]), fastest / gap * gap * std::max(std::abs(c[k]), std::abs(d[k])));
    if (term > PathSeries::round_off * fastest)
      path.last = std::min(path.last, std::exp2(std::log2(PathSeries::round_off * fastest / term) / k));
  }
  PathSeries::Array slower, presses;
  double power = 1;
  for (int k = 0; k <= order; ++k, power *= path.last) slower[k] = power * u[k];
  if (const double stops = first_zero(slower, order); stops < never) path.last *= stops, path.stops = true;
  power = 1;
  bool grazes = true;
  for (int k = 0; k <= order; ++k, power *= path.last) {
    presses[k] = power * reaction[k];
    if (!grazes) continue;
    if (presses[k] < -unknown) return path.stops = path.constant_level = false;
    grazes = presses[k] <= unknown;
    if (grazes) presses[k] = 0;
  }
  if (const double leaves = first_zero(presses, order); leaves < 1 || (leaves < never && !path.stops)) {
    path.last *= leaves;
    path.stops = false;
    path.leaves = true;
  }
  if constexpr (!std::same_as<decltype(resistance), series::Constant>) {
    const double reached = path.last;
    keep_to(path, law);
    if (path.last < reached) path.stops = path.leaves = false;
  }
  path.finish();
  if (path.end.time >= path.duration && path.last * h > path.duration * (1 + 0x1p-50)) path.stops = path.leaves = false;
  return true;
}

}  // namespace stickslip::detail
