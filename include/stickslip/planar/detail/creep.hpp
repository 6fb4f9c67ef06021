// Creep in the plane.
#pragma once

#include <cmath>

#include "stickslip/base/equal.hpp"
#include "stickslip/base/min_max.hpp"
#include "stickslip/base/vector2.hpp"
#include "stickslip/flow/closed_form.hpp"
#include "stickslip/friction/law.hpp"
#include "stickslip/planar/detail/along_load.hpp"
#include "stickslip/planar/detail/level_along.hpp"
#include "stickslip/planar/detail/path_series.hpp"
#include "stickslip/planar/path.hpp"
#include "stickslip/series/series.hpp"

namespace stickslip::detail {

/// Whether the level may depend on the speed.
template <class Law>
inline constexpr bool creeps = [] {
  if constexpr (MemorylessLaw<Law>)
    return form_of<Law> == Form::analytic;
  else
    return true;
}();

/// Under a constant load creep slows down without end. A speed that is the round-off of the load displaces nothing more.
inline bool is_held_up(PlanarPath& path, double speed, double unresolved) noexcept {
  const PlanarLoad& p = path.load;
  if (speed > unresolved || !(p.rate == Vector2{}) || !equal(p.weight_rate, 0)) return false;
  PathSeries& to = path.series;
  for (double* c : {to.t, to.x, to.y, to.s, to.u, to.vx, to.vy, to.l}) c[0] = c[1] = 0;
  to.t[1] = path.duration;
  to.u[0] = speed;
  to.vx[0] = path.velocity.axis, to.vy[0] = path.velocity.transverse;
  to.end(1);
  path.last = 1;
  path.finish();
  return true;
}

/// Creep under the load q at the start, over a step [s].
/// @param allowed  error of the speed at the start that displaces the path by less than round-off [m/s]
template <class Law>
bool creep(PlanarPath& path, const Law& law, Vector2 q, double step, double speed, double allowed) {
  const PlanarLoad& p = path.load;
  auto& [t, u, x, y, vx, vy, s, l, order] = path.series;
  series::Coefficients length, swift, when;
  length[0] = when[0] = 0, swift[0] = speed;
  auto resistance = series::series_of<double>(
      level_along(law, series::Variable{&length}, series::Variable{&swift}, series::Variable{&when}));
  AlongLoad slip(q, p.rate - path.spring.rate(p.weight_rate) * path.place, step);
  const double gains = p.weight_rate * step;
  t[0] = x[0] = y[0] = s[0] = 0;
  for (double& value : u) value = 0;
  u[0] = speed;
  // A coefficient is set twice. GCC 12 at -O1 drops the first of two such stores (-fipa-modref), although the update
  // between them reads it; an empty statement that may read all memory keeps it.
  const auto update = [&](int k, double speed_k) {
    swift[k] = speed_k;
#if defined(__GNUC__)
    asm volatile("" : : "r"(&swift) : "memory");
#endif
    resistance.update(k);
  };
  double previous = never, steep = 0;
  for (int sweep = 0;; ++sweep) {
    double changed = 0;
    for (int k = 0; k <= lagging_order; ++k) {
      if (k > 0) slip.lead(path, k);
      changed = std::max(changed, slip.turn_into(path.series, k));
      // What friction and damper take: the level is linear in the last coefficient of the speed.
      const double taken = slip.sigma[k] - (k + 1) * u[k + 1] / step, before = u[k];
      if (k == 0) {
        for (int i = 0; i < 3; ++i) {
          length[1] = when[1] = 0;
          update(0, u[0]), update(1, 1);
          steep = p.weight * resistance[1] + path.damping;
          if (!(steep > 0)) return false;
          u[0] -= (p.weight * resistance[0] + path.damping * u[0] - taken) / steep;
          if (!(u[0] > 0)) return false;
        }
        update(0, u[0]);
        l[0] = p.weight * resistance[0];
      } else {
        length[k] = s[k], when[k] = t[k];
        update(k, 0);
        const double rest = p.weight * resistance[k] + gains * resistance[k - 1];
        update(k, u[k] = (taken - rest) / steep);
        l[k] = p.weight * resistance[k] + gains * resistance[k - 1];
      }
      // The round-off of the load remains.
      const double change = std::abs(u[k] - before) - 0x1p-51 * slip.load / steep;
      changed = std::max(changed, change / speed);
    }
    if (changed <= PathSeries::round_off) break;
    if (sweep > 1 && !(changed < previous / 4)) {
      if (changed <= 0x1p-48) break;
      return false;
    }
    if (sweep == 20) return false;
    previous = changed;
  }
  path.level = l[0];
  path.constant_level = false;
  const double misaligned = std::abs(cross(slip.to, path.velocity) / speed - slip.d[0]);
  if (!(std::abs(u[0] - speed) <= allowed) || !(misaligned <= tolerated(path, speed, slip.load))) return false;
  return end_along(path, law, slip, lagging_order, true, false);
}

/// Creep: a slow slip under a level that rises so steeply with the speed that the speed follows the load, too. Its
/// equation u' = q.e - w a(u) - c u is solved for the u in a(u), and iterated with that of the direction. Without the
/// fast decay that any other speed would have, the series holds for as long as the load hardly changes.
/// @return false if the slip is too fast for it, or its speed still decays
template <class Law>
bool creep([[maybe_unused]] PlanarPath& path, [[maybe_unused]] const Law& law, [[maybe_unused]] int& patience) {
  if constexpr (creeps<Law>) {
    const PlanarLoad& p = path.load;
    if (--patience > 0) return false;
    const Vector2 q = p.start - path.pull();
    const double load = norm(q), speed = norm(path.velocity);
    if (!(dot(path.velocity, q) > 0) || nears_stop(path)) return false;
    series::Coefficients length, swift, when;
    length[0] = length[1] = when[0] = when[1] = 0, swift[0] = speed, swift[1] = 1;
    auto resistance = series::series_of<double>(
        level_along(law, series::Variable{&length}, series::Variable{&swift}, series::Variable{&when}));
    resistance.update(0), resistance.update(1);
    const double resists = resistance[0], steep = p.weight * resistance[1] + path.damping;
    if (!(steep * path.duration > follows)) return false;
    const Vector2 rate =
        p.rate - path.spring.rate(p.weight_rate) * path.place - path.spring.under(p.weight) * path.velocity;
    // The rate of the level at this speed.
    double drift = resists * p.weight_rate;
    if constexpr (heated_step<Law>) {
      const double soon = 0x1p-8 * path.duration;
      drift += p.weight * (level_along(law, 0.0, speed, soon) - resists) / soon;
    }
    const double growth = norm(rate) + std::abs(drift);
    const double step =
        growth > 0 ? std::min(path.duration, std::min(load, steep * speed) / (2 * growth)) : path.duration;
    if (!(steep * step > follows) || !(load * step > follows * speed)) return false;
    // The speed lags behind that at which friction balances the load, to first order.
    const double lag = (dot(q, rate) / load - drift) / steep;
    const double error = std::abs(load - p.weight * resists - path.damping * speed - lag) / steep;
    const double allowed = std::max(steep * (0x1p-55 * path.duration * speed + 0x1p-58 * norm(path.place)),
                                    heated_step<Law> ? level_error * p.weight * resists / steep : 0.0);
    const double second_order = 16 * std::abs(lag) / (steep * steep * step);
    if (error > second_order + allowed) {
      patience = flows_to_decay(error / (second_order + allowed));
      return false;
    }
    if (!heated_step<Law> && is_held_up(path, speed, 0x1p-46 * load / steep)) return true;
    if (creep(path, law, q, step, speed, allowed)) return true;
    patience = 10;
  }
  return false;
}

}  // namespace stickslip::detail
