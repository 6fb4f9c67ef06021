// A slow slip in the plane, which follows the load.
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
#include "stickslip/planar/path.hpp"
#include "stickslip/series/series.hpp"

namespace stickslip::detail {

/// Times in which a direction turns into that of the load, at least, in a slow slip.
inline constexpr double follows = 64;
/// Order of the series of a slow slip.
inline constexpr int lagging_order = 20;

/// A slip along the load as a power series in time, in the frame of the load at its start.
struct AlongLoad {
  Vector2 to;     ///< direction of the load
  double load;    ///< its magnitude [m/s^2]
  Vector2 rate;   ///< its rate, without that of the spring
  double step;    ///< for which the series is computed [s]
  bool unloaded;  ///< without any load the motion begins in the direction into which the load grows
  /// Along `to` and clockwise from it: the load q, the direction e of the motion, the path; and q.e.
  PathSeries::Array qa, qb, c, d, ra, rb, sigma;

  AlongLoad(Vector2 q, Vector2 its_rate, double duration)
      : to{1, 0}, load(norm(q)), rate(its_rate), step(duration), unloaded(!(load > 0)) {
    const double growth = norm(rate);
    if (!unloaded)
      to = (1 / load) * q;
    else if (growth > 0)
      to = (1 / growth) * rate;
    for (double& value : d) value = 0;
    for (double& value : sigma) value = 0;
    ra[0] = rb[0] = qb[0] = 0;
    qa[0] = load;
  }

  /// Coefficient k > 0 of time, path and load, from the speed and the direction up to k - 1.
  void lead(PlanarPath& path, int k) noexcept {
    const double by = step * series::reciprocal[k];
    const auto& u = path.series.u;
    path.series.t[k] = k == 1 ? step : 0;
    path.series.s[k] = by * u[k - 1];
    double gained_a = 0, gained_b = 0;
    for (int i = 0; i < k; ++i) gained_a += u[i] * c[k - 1 - i], gained_b += u[i] * d[k - 1 - i];
    ra[k] = by * gained_a, rb[k] = by * gained_b;
    double wa = ra[k], wb = rb[k];
    if (path.spring.pendulum) {
      const double gains = path.load.weight_rate * step;
      wa = path.load.weight * wa + gains * ra[k - 1];
      wb = path.load.weight * wb + gains * rb[k - 1];
    }
    qa[k] = (k == 1 ? dot(rate, to) * step : 0) - path.spring.stiffness * wa;
    qb[k] = (k == 1 && !unloaded ? cross(to, rate) * step : 0) - path.spring.stiffness * wb;
  }

  /// Coefficient k of the direction: u e' = q - (q.e) e, solved for the part of e perpendicular to the load. The part
  /// along it follows from |e| = 1. @return the change
  double turn_into(const PathSeries& path, int k) noexcept {
    const auto& u = path.u;
    double turned = 0;
    if (!unloaded) {
      double rest = step * qb[k] - u[0] * (k + 1) * d[k + 1];
      for (int i = 1; i <= k; ++i) rest -= step * sigma[i] * d[k - i];
      for (int i = 2; i <= k; ++i) rest -= u[i] * (k - i + 1) * d[k - i + 1];
      turned = rest / ((k > 0 ? k * u[1] : 0) + step * load);
    }
    const double change = std::abs(turned - d[k]);
    d[k] = turned;
    double square = d[0] * d[k];
    for (int i = 1; i < k; ++i) square += c[i] * c[k - i] + d[i] * d[k - i];
    if (k > 0) square += d[k] * d[0];
    c[k] = k > 0 ? -square / (2 * c[0]) : std::sqrt(1 - square);
    double sum = 0;
    for (int i = 0; i <= k; ++i) sum += qa[i] * c[k - i] + qb[i] * d[k - i];
    sigma[k] = sum;
    return change;
  }
};

/// Flows in which an error of the direction decays by a factor: by about e in each.
inline int flows_to_decay(double factor) noexcept {
  return factor > 1 ? static_cast<int>(std::min(std::log(factor), 40.0)) + 1 : 10;
}

/// The error of the direction that displaces the path by less than round-off while the slip turns into the load.
inline double tolerated(const PlanarPath& path, double speed, double load) noexcept {
  return load / speed * (0x1p-55 * path.duration + 0x1p-58 * norm(path.place) / speed);
}

/// The series of a slip along the load, up to where its terms reach round-off.
/// @param slow      whether it moves already, slowly
/// @param constant  whether the level is
template <class Law>
bool end_along(PlanarPath& path, const Law& law, const AlongLoad& slip, int orders, bool slow, bool constant) {
  PathSeries& series = path.series;
  auto &u = series.u, &vx = series.vx, &vy = series.vy;
  const double h = slip.step, load = slip.load;
  const Vector2 to = slip.to, aside = stickslip::turned(to);
  const auto &c = slip.c, &d = slip.d, &ra = slip.ra, &rb = slip.rb;
  for (int k = 0; k <= orders; ++k) {
    double va = 0, vb = 0;
    for (int i = 0; i <= k; ++i) va += u[i] * c[k - i], vb += u[i] * d[k - i];
    vx[k] = va * to.axis + vb * aside.axis;
    vy[k] = va * to.transverse + vb * aside.transverse;
    series.x[k] = ra[k] * to.axis + rb[k] * aside.axis;
    series.y[k] = ra[k] * to.transverse + rb[k] * aside.transverse;
  }
  // The order up to which the series can be used longest: from there on its terms may grow again.
  int leading = 0;
  while (leading < orders && equal(u[leading], 0)) ++leading;
  double scale = std::abs(u[leading]), longest = 0;
  int order = orders;
  if (slow)
    for (int k = 1; k <= 3; ++k) scale = std::max(scale, std::abs(u[k]));
  const auto part = [&](int k) {
    const double of = std::max(std::abs(u[k]), std::max(std::abs(vx[k]), std::abs(vy[k])));
    return of > 0 ? std::exp2(std::log2(PathSeries::round_off * scale / of) / (k - leading)) : never;
  };
  double before = leading + 1 <= orders ? part(leading + 1) : 0;
  // Terms that vanish do not end it if a law, or a pendulum without weight at the start, may act on later ones.
  const bool delayed = !constant || (path.spring.pendulum && !equal(path.load.weight_rate, 0));
  // Nor do those of a speed that is nearly zero: under a load that turns away from the level it grows as t^3.
  const int lowest = std::max(leading + 2, delayed ? orders - 8 : slow ? 5 : 0);
  for (int k = leading + 2; k <= orders && longest < 1; ++k) {
    const double now = part(k), both = std::min(before, now);
    before = now;
    if (k >= lowest && both > longest) longest = both, order = k;
  }
  path.last = longest > 0 ? std::min(longest, 1.0) : 1;
  series.end(order);
  if (!constant) keep_to(path, law);
  // Where the speed returns to zero, a slip along one line stops, and so does a slow one. Any other still turns: the
  // series ends before.
  PathSeries::Array slower{};  // for GCC, which takes it for uninitialized
  double power = 1;
  bool straight = true;
  for (int k = 0; k <= series.order; ++k, power *= path.last) {
    slower[k] = power * u[k];
    straight = straight && equal(d[k], 0);
  }
  if (const double stops = first_zero(slower, series.order); stops > 0 && stops < never) {
    path.last *= stops;
    if (straight || slow)
      path.stops = path.last * h <= path.duration;
    else
      path.last *= 0.75;
  }
  if (slow) {
    // It remains slow; otherwise steps in tau are as long.
    const double reached = path.last;
    while (path.last > 0x1p-10 &&
           follows * std::max(u[0] + series.value(u, path.last), u[0] + series.value(u, path.last / 2)) > load * h)
      path.last /= 2;
    if (!(load * h * path.last > 16 * (u[0] + std::abs(series.value(u, path.last))))) return path.stops = false;
    if (path.last < reached) path.stops = false;
  }
  path.finish();
  return true;
}

/// From rest, or slowly along the load. With a speed u at the start, the equation of the direction is iterated.
/// @param smooth  whether a slip from rest begins under a load that equals the level
/// @param misaligned  receives the angle from the direction to that in which a slow slip would follow the load
/// @return false if it is too fast for it, or still turns
template <class Law>
bool along_load(PlanarPath& path, const Law& law, double speed, bool smooth, double& misaligned) {
  const PlanarLoad& p = path.load;
  auto& [t, u, x, y, vx, vy, s, l, order] = path.series;
  const Vector2 q0 = p.start - path.pull();
  series::Coefficients length, swift, when;
  length[0] = when[0] = 0, swift[0] = speed;
  auto resistance = series::series_of<double>(
      level_along(law, series::Variable{&length}, series::Variable{&swift}, series::Variable{&when}));
  resistance.update(0);
  const double load = norm(q0), level = p.weight * resistance[0];
  path.level = level;
  path.constant_level = std::same_as<decltype(resistance), series::Constant> && equal(p.weight_rate, 0);
  const Vector2 rate = p.rate - path.spring.rate(p.weight_rate) * path.place;
  const double growth = norm(rate);
  const double wn = std::sqrt(path.spring.stiffness);
  double h = path.duration;
  if (wn > 0) h = std::min(h, 1 / wn);
  if (path.damping > 0) h = std::min(h, 1 / path.damping);
  const double steepest = growth + resistance[0] * std::abs(p.weight_rate);
  if (steepest > 0 && load > 0) h = std::min(h, load / steepest);
  if (speed > 0) {
    if (load < level) h = std::min(h, 2 * speed / (level - load));
    const double slope = 2 * p.weight * std::abs(level_along(law, 0.0, speed / 2, 0.0) - resistance[0]) / speed;
    if (slope > 0) h = std::min(h, 2 / slope);
    if (!(load * h > follows * speed)) return false;
  }

  AlongLoad slip(q0, rate, h);
  t[0] = x[0] = y[0] = s[0] = 0;
  u[0] = speed;
  l[0] = level;
  const double gains = p.weight_rate * h;
  const double net0 = smooth || slip.unloaded ? 0 : std::max(load - level, 0.0);
  const int orders = speed > 0 ? lagging_order : PathSeries::highest_order;
  double previous = never;
  for (int sweep = 0; sweep < 12; ++sweep) {
    double changed = 0;
    for (int k = 0; k <= orders; ++k) {
      if (k > 0) {
        const double by = h * series::reciprocal[k];
        u[k] = by * ((k == 1 && !(speed > 0) ? net0 : slip.sigma[k - 1] - l[k - 1]) - path.damping * u[k - 1]);
        slip.lead(path, k);
        swift[k] = u[k];
        length[k] = s[k];
        when[k] = t[k];
        resistance.update(k);
        l[k] = p.weight * resistance[k] + gains * resistance[k - 1];
      }
      changed = std::max(changed, slip.turn_into(path.series, k));
    }
    if (!(speed > 0) || changed <= PathSeries::round_off) break;
    if (sweep > 1 && !(changed < previous / 4)) {
      if (changed <= 0x1p-50) break;
      return false;
    }
    previous = changed;
    if (sweep == 11) return false;
  }
  if (speed > 0) {
    misaligned = std::abs(cross(slip.to, path.velocity) / speed - slip.d[0]);
    if (!(misaligned <= tolerated(path, speed, load))) return false;
  }
  constexpr bool constant = std::same_as<decltype(resistance), series::Constant>;
  return end_along(path, law, slip, orders, speed > 0, constant);
}

/// Whether a stop will soon turn its velocity.
inline bool nears_stop(const PlanarPath& path) noexcept {
  return norm(path.place) > path.gap * (1 - 0x1p-30) && !path.leaves_at_once && !(dot(path.place, path.velocity) < 0);
}

/// A slow slip whose direction follows the load, because it has had the time to turn into it: a power series in time,
/// without the singularity of a direction that is still turning. Near a stop, under a load that is nearly equal to the
/// level, and in creep it takes one step where the regularized time would take hundreds.
/// @return false if the slip is too fast for it, or still turns
template <class Law>
bool follow(PlanarPath& path, const Law& law, int& patience) {
  const PlanarLoad& p = path.load;
  if (--patience > 0) return false;
  const Vector2 q = p.start - path.pull();
  const double load = norm(q), speed = norm(path.velocity);
  if (!(load * path.duration > follows * speed) || !(dot(path.velocity, q) > 0)) return false;
  if (nears_stop(path)) return false;
  // The direction lags behind that of the load by u/Q times its rate, to first order.
  const Vector2 rate =
      p.rate - path.spring.rate(p.weight_rate) * path.place - path.spring.under(p.weight) * path.velocity;
  const double lag = speed / load, turns = cross(q, rate) / (load * load);
  const double actual = cross(q, path.velocity) / (load * speed), error = std::abs(actual + lag * turns);
  const double per_time =
      lag * (norm(rate) / load + path.damping) + std::abs(load - p.weight * level_along(law, 0.0, speed, 0.0)) / load;
  const double allowed = tolerated(path, speed, load), second_order = 4 * lag * std::abs(turns) * per_time;
  if (error > second_order + allowed) {
    patience = flows_to_decay(error / (second_order + allowed));
    return false;
  }
  double misaligned = 0;
  if (along_load(path, law, speed, false, misaligned)) return true;
  patience = flows_to_decay(misaligned / allowed);
  return false;
}

}  // namespace stickslip::detail
