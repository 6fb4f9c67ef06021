// A response held against an outcome that was computed elsewhere.
#pragma once

#include "support/catch.hpp"
#include "support/motions.hpp"
#include "support/reference.hpp"

namespace test {

inline void check_samples(const stickslip::Response& r, const reference::Value& expected, double x, double v) {
  const auto nodes = expected["nodes"].as<std::vector<std::size_t>>();
  const std::vector<double> displacements = expected["displacements"].list(),
                            velocities = expected["velocities"].list();
  for (std::size_t k = 0; k < nodes.size(); ++k) {
    CHECK(std::abs(r.displacement[nodes[k]] - displacements[k]) <= x);
    CHECK(std::abs(r.velocity[nodes[k]] - velocities[k]) <= v);
  }
}

/// To 1e-12 of the scale, energy too, and event by event.
/// @param at_once  whether the slider breaks away at t = 0, which the reference does not count
inline void check_outcome(const stickslip::Response& r, const reference::Value& expected, bool at_once) {
  const double x = 1e-12 * expected["peak"], v = 1e-12 * largest(r.velocity);
  CHECK(std::abs(r.residual - expected["displacement"]) <= x);
  CHECK(std::abs(r.state.velocity - expected["velocity"]) <= v);
  CHECK(std::abs(r.peak - expected["peak"]) <= x);
  CHECK(std::abs(r.sliding_distance - expected["sliding_distance"]) <= 1e-12 * expected["sliding_distance"]);
  CHECK(std::abs(r.energy.imbalance()) <= 1e-12 * turnover(r.energy));
  CHECK(count(r.events) == Counts{expected["breakaways"].as<int>() + at_once, expected["arrests"].as<int>(),
                                  expected["reversals"].as<int>()});
  check_samples(r, expected, x, v);
}

}  // namespace test
