// A response held against an outcome that was computed elsewhere.
#pragma once

#include "support/catch.hpp"
#include "support/motions.hpp"
#include "support/reference_values.hpp"

namespace test {

/// To 1e-12 of the scale, energy too, and event by event.
/// @param at_once  whether the slider breaks away at t = 0, which the reference does not count
inline void check_outcome(const stickslip::Response& r, const reference::Outcome& expected, bool at_once) {
  const double x = 1e-12 * expected.peak, v = 1e-12 * largest(r.velocity);
  CHECK(std::abs(r.residual - expected.displacement) <= x);
  CHECK(std::abs(r.state.velocity - expected.velocity) <= v);
  CHECK(std::abs(r.peak - expected.peak) <= x);
  CHECK(std::abs(r.sliding_distance - expected.sliding_distance) <= 1e-12 * expected.sliding_distance);
  CHECK(std::abs(r.energy.imbalance()) <= 1e-12 * turnover(r.energy));
  CHECK(count(r.events) == Counts{expected.breakaways + at_once, expected.arrests, expected.reversals});
  for (const auto& sample : expected.samples) {
    const auto node = static_cast<std::size_t>(sample.node);
    CHECK(std::abs(r.displacement[node] - sample.displacement) <= x);
    CHECK(std::abs(r.velocity[node] - sample.velocity) <= v);
  }
}

}  // namespace test
