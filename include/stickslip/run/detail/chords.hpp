// Straight lines in place of an acceleration that curves.
#pragma once

#include <algorithm>
#include <cmath>

#include "stickslip/base/requirements.hpp"
#include "stickslip/base/vector2.hpp"
#include "stickslip/ground/floor_motion.hpp"

namespace stickslip::detail {

/// An acceleration at a time, which is a function of a parameter.
struct CurvePoint {
  double parameter, time;
  Vector2 acceleration;
};

/// Adds chords of a curve between two of its points to a floor, halved until the curve is close to them.
/// @param at         `at(parameter)`: the point of the curve
/// @param tolerance  largest error [m/s^2]
/// @param shortest   parts of the parameter that are not divided
template <class At>
void add_chords(const At& at, const CurvePoint& first, const CurvePoint& last, double tolerance, double shortest,
                PlanarFloorMotion& floor) {
  const double duration = last.time - first.time;
  if (last.parameter - first.parameter > shortest && duration > 0) {
    constexpr double margin = 4.0 / 3;  // the curvature between the points
    const auto between = [&](double part) { return at(std::lerp(first.parameter, last.parameter, part)); };
    const auto deviation = [&](const CurvePoint& p) {
      const double part = (p.time - first.time) / duration;
      return norm(p.acceleration - first.acceleration - part * (last.acceleration - first.acceleration));
    };
    const CurvePoint middle = between(0.5);
    if (margin * std::max({deviation(middle), deviation(between(0.25)), deviation(between(0.75))}) > tolerance) {
      add_chords(at, first, middle, tolerance, shortest, floor);
      return add_chords(at, middle, last, tolerance, shortest, floor);
    }
  }
  if (duration > 0) floor.segments.push_back({duration, first.acceleration, last.acceleration});
}

}  // namespace stickslip::detail
