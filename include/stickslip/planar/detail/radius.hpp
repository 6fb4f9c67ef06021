// The distance from the origin during a slip in the plane.
#pragma once

#include <cmath>

#include "stickslip/base/equal.hpp"
#include "stickslip/base/min_max.hpp"
#include "stickslip/base/vector2.hpp"
#include "stickslip/flow/closed_form.hpp"
#include "stickslip/flow/power_series.hpp"
#include "stickslip/planar/detail/path_series.hpp"
#include "stickslip/planar/path.hpp"

namespace stickslip::detail {

/// A difference of radial terms that is round-off, as a fraction of them.
inline constexpr double graze = 0x1p-42;

/// The first parameter at which a path crosses a circle about the origin, outward or inward; `never` if it does not. A
/// start on the circle is not counted.
/// @param radius   [m]
/// @param outward  whether the start is inside
inline double parameter_at_radius(const PlanarPath& path, double radius, bool outward) noexcept {
  const double from = norm(path.place);
  if (outward ? from + path.end.distance < radius * (1 - 0x1p-50) : from - path.end.distance > radius * (1 + 0x1p-50))
    return never;
  if (path.kind == PlanarPath::Kind::stop) {
    const double to = norm(path.place + path.end.way);
    return (outward ? to > radius * (1 + 0x1p-50) : to < radius * (1 - 0x1p-50)) ? path.last : never;
  }
  const bool at_circle = std::abs(radius - from) <= 0x1p-48 * radius;
  const PathSeries& series = path.series;
  PathSeries::Array room;
  const int degree = series.square_degree();
  double power = 1;
  const double sign = outward ? -1 : 1;
  for (int k = 0; k <= degree; ++k, power *= path.last) {
    double terms = 0;
    const double square = series.square_of_distance(path.place, k, terms);
    // Along the circle, and where a slider leaves it, what is left of the first terms is round-off: also of the load,
    // which is the small difference of larger ones where its radial part changes sign.
    if (k == 2) terms += from * path.largest_load() * series.t[1] * series.t[1];
    room[k] =
        at_circle && (k < 4 || path.leaves_at_once) && std::abs(square) <= graze * terms ? 0 : sign * power * square;
  }
  room[0] = at_circle ? 0 : sign * (from - radius) * (from + radius);
  if (at_circle && path.leaves_at_once)  // what says otherwise is round-off
    for (int k = 0; k < degree && !(room[k] > 0); ++k) room[k] = 0;
  const double part = first_zero(room, degree);
  return part < never ? part * path.last : never;
}

/// The largest distance from the origin up to a parameter [m], where it may exceed `peak`; otherwise any value that is
/// not larger. `where` receives its parameter.
inline double largest_radius(const PlanarPath& path, double until, double peak, double& where) noexcept {
  const double from = norm(path.place);
  if (from + path.end.distance <= peak) return 0;
  if (path.kind == PlanarPath::Kind::held) return path.held.largest_radius(path.place, until, where);
  const auto radius = [&](double s) { return norm(path.place + path.at_parameter(s).way); };
  where = until;
  double largest = radius(until);
  if (path.kind == PlanarPath::Kind::stop) {
    // A slip may turn sharply on its last way.
    const HeldSlip slip = path.closing.slip();
    double tau = 0;
    const double reached = slip.largest_radius(path.place, slip.parameter(never), tau);
    if (reached > largest) largest = reached, where = -std::expm1(-(path.closing.level + path.closing.load) * tau);
    return largest;
  }
  // Where |r|^2 stops growing. After each such zero the search continues where it grows again.
  PathSeries::Array square, growth;
  const int degree = path.series.square_degree() - 1;
  double power = until;
  for (int k = 1; k <= degree + 1; ++k, power *= until) {
    double terms = 0;
    growth[k - 1] = k * power * path.series.square_of_distance(path.place, k, terms);
  }
  double begin = 0, sign = 1;
  for (int turns = 0; turns < 2 * PathSeries::highest_order && begin < 1; ++turns) {
    // The polynomial in z, with s = begin + (1 - begin) z.
    for (int k = 0; k <= degree; ++k) square[k] = sign * growth[k];
    for (int i = 0; i < degree; ++i)
      for (int k = degree - 1; k >= i; --k) square[k] += begin * square[k + 1];
    double scale = 1;
    for (int k = 0; k <= degree; ++k, scale *= 1 - begin) square[k] *= scale;
    int leading = turns > 0 ? 1 : 0;  // the zero at which it starts
    while (leading < degree && equal(square[leading], 0)) ++leading;
    if (leading == degree && !(std::abs(square[leading]) > 0)) break;
    if (square[leading] < 0) {
      sign = -sign;
      for (int k = leading; k <= degree; ++k) square[k] = -square[k];
    }
    const double z = leading < degree ? FirstRoot(square + leading, degree - leading).find() : never;
    if (!(z < 1)) break;
    begin += (1 - begin) * z;
    if (sign > 0) {
      const double there = radius(begin * until);
      if (there > largest) largest = there, where = begin * until;
    }
    sign = -sign;
  }
  return largest;
}

}  // namespace stickslip::detail
