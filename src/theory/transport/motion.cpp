#include "theory/transport/motion.hpp"

#include <algorithm>
#include <cmath>
#include <span>

#include "numerics/bicgstab.hpp"

namespace stickslip::detail {
namespace {

using Vector = Chain::Vector;
using Parity = Chain::Parity;

Eigen::Map<const Vector> vector(std::span<const double> x) { return {x.data(), static_cast<Eigen::Index>(x.size())}; }

/// Solves x - T'x + start (sum of x) = b, or without the last term.
Vector solve(const Chain& chain, const Vector& b, Parity parity, bool conserving, Vector x,
             const std::function<void()>& progress) {
  const auto multiply = [&](std::span<const double> from, std::span<double> to) {
    if (progress) progress();
    const auto p = vector(from);
    Eigen::Map<Vector> result(to.data(), p.size());
    result = p - chain.carry(p, parity);
    if (conserving) result += chain.start() * p.sum();
  };
  const auto size = static_cast<std::size_t>(b.size());
  // Strong shaking forgets slowly: the residual must be far below the error.
  solve_bicgstab(multiply, {b.data(), size}, {x.data(), size}, 1e-14, "Transport");
  return x;
}

}  // namespace

std::vector<MotionMoments> history_from_rest(const Chain& chain, std::size_t steps,
                                             const std::function<void()>& progress) {
  const Parity other = chain.mirrored() ? Parity::odd : Parity::even;
  std::vector<MotionMoments> found(1);
  found.reserve(steps + 1);
  Vector p = chain.start(), q = Vector::Zero(p.size());  // p times the displacement less its mean
  double x = 0, xx = 0;
  MotionMoments growth;
  const double still = chain.pulses() ? 1e-5 : 1e-7;  // their lattice errs by percents
  while (found.size() <= steps) {
    if (progress) progress();
    Chain::Means now = chain.seen(p), end = chain.end(p);
    if (chain.mirrored()) now.x = now.v = end.x = 0;
    MotionMoments next{x + now.x, xx + now.xx - now.x * now.x, now.xv - now.x * now.v, now.v, now.vv - now.v * now.v};
    if (!chain.with_displacement()) {
      const Chain::Means by_x = chain.seen(q);
      next.xx += 2 * by_x.x;
      next.xv += by_x.v;
      x += end.x, xx += end.xx - end.x * end.x + 2 * chain.end(q).x;
      q = chain.carry(q, p, end.x, other);
    }
    const Vector carried = chain.carry(p);
    const double change = (carried - p).lpNorm<1>();
    p = carried;
    const MotionMoments& last = found.back();
    const MotionMoments grown{next.x - last.x, next.xx - last.xx, next.xv - last.xv, next.v - last.v,
                              next.vv - last.vv};
    // What remains of a slow decay is its change in a step times the steps that it takes; it has taken more so far.
    const auto remaining = [&](double in_step) { return in_step * static_cast<double>(found.size()); };
    const bool even = remaining(change) < still && remaining(std::abs(grown.xx - growth.xx)) <=
                                                       still * std::abs(chain.with_displacement() ? next.xx : grown.xx);
    found.push_back(next);
    growth = grown;
    if (!even) continue;
    while (found.size() <= steps) {
      next.x += chain.with_displacement() ? 0 : grown.x;
      next.xx += chain.with_displacement() ? 0 : grown.xx;
      found.push_back(next);
    }
  }
  return found;
}

Vector weights_from_rest(const Chain& chain, std::size_t steps, const std::function<void()>& progress) {
  Vector p = chain.start();
  for (std::size_t k = 0; k < steps; ++k) {
    if (progress) progress();
    p = chain.carry(p);
  }
  return p;
}

double chance_of_loads(const LoadGrid& load, double least, double most, std::size_t steps) {
  // Of each load, the part of those for which it stands that are within.
  std::vector<double> within;
  for (std::size_t i = 0; i < load.loads(); ++i) {
    double& part = within.emplace_back();
    std::vector<double> cuts;
    if (load.white()) cuts = {least, most};
    load.average(i, cuts, [&](double n, double weight) { part += n >= least && n <= most ? weight : 0; });
  }
  Vector p = load.start();
  std::vector<double> given(load.largest_share());
  for (std::size_t k = 0; k < steps; ++k) {
    Vector next = Vector::Zero(p.size());
    for (std::size_t i = 0; i < load.loads(); ++i) {
      const auto [first, count] = load.share(i);
      load.give(i, p.data(), given.data());
      for (std::size_t j = 0; j < count; ++j) next[static_cast<Eigen::Index>(first + j)] += within[i] * given[j];
    }
    p = load.adjoint_step() ? Vector(*load.adjoint_step() * next) : next;
  }
  return p.sum();
}

double stationary_velocity(const Chain& chain, const std::function<void()>& progress) {
  return chain.seen(solve(chain, chain.start(), Parity::even, true, chain.start(), progress)).vv;
}

StationaryMotion stationary_motion(const Chain& chain, bool with_rest, const Vector& guess,
                                   const std::function<void()>& progress) {
  const Vector p = solve(chain, chain.start(), Parity::even, true, guess, progress);
  StationaryMotion found;
  const Chain::Means now = chain.seen(p);
  MotionMoments& m = found.moments = {now.x, now.xx, now.xv, now.v, now.vv};
  if (chain.mirrored()) m.x = m.v = 0;
  if (chain.with_displacement()) {
    m.xx -= m.x * m.x;
    m.xv = 0;
  } else {
    // The weights times the displacement less its mean: those of the increments before, carried.
    const Chain::Means end = chain.end(p);
    const double drift = chain.mirrored() ? 0 : end.x;  // in a step
    const Parity parity = chain.mirrored() ? Parity::odd : Parity::even;
    Vector b = chain.carry(Vector::Zero(p.size()), p, drift, parity);
    if (!chain.mirrored()) b -= chain.start() * b.sum();  // 0 but for round-off
    const Vector q = solve(chain, b, parity, !chain.mirrored(), b, progress);
    m.xx = (end.xx - drift * drift + 2 * (chain.end(q).x - drift * q.sum())) / chain.step();
    m.x = 0;
    m.xv = m.xx / 2;
  }
  m.vv -= m.v * m.v;
  if (with_rest) found.rest = chain.pulses() ? now.rest : chain.below(p, 0, true) - chain.below(p, 0, false);
  return found;
}

double between(const std::vector<MotionMoments>& moments, double MotionMoments::*figure, double place) {
  const std::size_t points = std::min<std::size_t>(6, moments.size());
  const double from = std::clamp(std::floor(place) - 2, 0.0, static_cast<double>(moments.size() - points));
  const auto first = static_cast<std::size_t>(from);
  double value = 0;
  for (std::size_t i = 0; i < points; ++i) {
    double weight = 1;
    for (std::size_t j = 0; j < points; ++j)
      if (j != i) weight *= (place - from - static_cast<double>(j)) / (static_cast<double>(i) - static_cast<double>(j));
    value += weight * moments[first + i].*figure;
  }
  return value;
}

}  // namespace stickslip::detail
