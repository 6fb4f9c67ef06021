// What the readers of a motion ask of a response.
#pragma once

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include "stickslip/base/error.hpp"
#include "stickslip/base/min_max.hpp"

namespace stickslip::detail {

/// The order of times at which states are wanted.
/// @param samples  time of the last sample, which may be later than the end [s]
/// @throws std::invalid_argument  a time outside of the response
inline std::vector<std::size_t> order_of(std::span<const double> times, double begin, double end, double samples) {
  end = std::max(end, samples);
  for (const double time : times)
    require(time >= begin && time <= end,
            "states at times: must be from " + shortest(begin) + " to " + shortest(end) +
                " s, the start and the end of the response",
            time, "s");
  std::vector<std::size_t> order(times.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(), [&](std::size_t i, std::size_t k) { return times[i] < times[k]; });
  return order;
}

/// Throw if a floor motion cannot be made of a response.
/// @param samples  of the ground motion
template <class Response>
void check_floor(const Response& response, std::size_t samples, double tolerance) {
  require(tolerance >= 1e-10 && tolerance <= 1, "floor_motion: tolerance must be from 1e-10 to 1", tolerance);
  if (response.truncated)
    throw std::invalid_argument(
        "floor motion: the samples of the response must reach the final rest, but they are truncated; extend the "
        "ground motion by zeros");
  if (response.displacement.size() < samples || response.events.empty())
    throw std::invalid_argument("floor_motion: the response must be that to the motion of " + std::to_string(samples) +
                                " samples, got " + std::to_string(response.displacement.size()));
}

}  // namespace stickslip::detail
