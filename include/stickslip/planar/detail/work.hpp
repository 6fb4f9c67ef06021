// The work done during a slip in the plane.
#pragma once

#include "stickslip/base/equal.hpp"
#include "stickslip/base/min_max.hpp"
#include "stickslip/base/vector2.hpp"
#include "stickslip/planar/detail/path_series.hpp"
#include "stickslip/planar/path.hpp"
#include "stickslip/series/series.hpp"

namespace stickslip::detail {

/// The work of the load on a slider, and that against friction and on the damper, per unit mass [m^2/s^2].
struct PlanarWork {
  double load = 0, friction = 0, damper = 0;
};

/// The work up to a parameter.
inline PlanarWork work(const PlanarPath& path, double s) noexcept {
  const PlanarProgress to = path.at_parameter(s);
  const PlanarLoad& load = path.load;
  const Spring& spring = path.spring;
  PlanarWork work{dot(load.start, to.way), 0, 0};
  // The spring of a pendulum does work against the deviation of the weight from 1.
  if (spring.pendulum) work.load += spring.rate(1 - load.weight) * (dot(path.place, to.way) + dot(to.way, to.way) / 2);
  if (path.kind == PlanarPath::Kind::stop) {
    work.load += dot(load.rate, to.way) * to.time / 3;
    work.friction = path.level * to.distance;
    work.damper = path.damping * to.distance * norm(path.velocity) * 2 / 3;
    return work;
  }
  if (path.constant_level) work.friction = path.level * to.distance;
  if (path.kind == PlanarPath::Kind::held) return work;
  const auto& [t, u, x, y, vx, vy, length, l, order] = path.series;
  const bool weighed = spring.pendulum && !equal(load.weight_rate, 0);
  const int degree = path.series.square_degree();
  PathSeries::Array energy;  // of the spring, per stiffness
  if (weighed) {
    for (int k = 1; k <= degree; ++k) {
      double terms = 0;
      energy[k] = path.series.square_of_distance(path.place, k, terms) / 2;
    }
  }
  // Integrals of products with the derivatives of the path.
  double power = s;
  for (int k = 1; k <= degree; ++k, power *= s) {
    double loads = 0, friction = 0, damper = 0;
    if (weighed)
      for (int i = 0; i < std::min(k, order); ++i)
        loads -= (k - i) * t[i] * load.weight_rate * spring.stiffness * energy[k - i];
    for (int i = std::max(0, k - order); i < std::min(k, order); ++i) {
      const int rest = k - i;
      loads += rest * t[i] * (load.rate.axis * x[rest] + load.rate.transverse * y[rest]);
      if (!path.constant_level) friction += rest * l[i] * length[rest];
      damper += rest * u[i] * length[rest];
    }
    const double share = power * series::reciprocal[k];
    work.load += loads * share;
    work.friction += friction * share;
    work.damper += path.damping * damper * share;
  }
  return work;
}

}  // namespace stickslip::detail
