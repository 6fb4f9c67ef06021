// A warning about implausible recorded ground motions.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <string>

#include "bindings.hpp"

namespace stickslip::python {

/// A mean above this fraction of the peak is an offset: in processed records it is below 2e-4, and 0.01 g in a record
/// of 0.6 g is 1.6e-2.
inline constexpr double max_plausible_mean = 0.005;

/// Motions with fewer samples are examples, not records, and are not checked.
inline constexpr std::size_t fewest_samples = 100;

/// Whether a motion begins and ends as records do: ten samples at either end within 5 % of the peak of the mean.
/// Stationary noise and harmonic motions, whose mean is rarely zero, do not.
inline bool begins_and_ends_at_rest(std::span<const double> n, double mean, double peak) {
  constexpr std::size_t ends = 10;
  const auto quiet = [&](double value) { return std::abs(value - mean) <= 0.05 * peak; };
  return std::ranges::all_of(n.first(ends), quiet) && std::ranges::all_of(n.last(ends), quiet);
}

/// Warns through Python's `warnings`; throws if warnings are errors.
/// @param depth     stack level that the warning names: 1 is the calling Python function
/// @param recorded  whether the motion was read as a record; else it may be zero throughout, and its mean is checked
///                  only if it begins and ends at rest
inline void warn_if_implausible(const GroundMotion& motion, const std::string& who, int depth = 1,
                                bool recorded = true) {
  if (motion.samples() < fewest_samples) return;
  const auto warn = [&](const std::string& what) {
    warn_of_unit(who + (motion.name().empty() ? "" : " (" + motion.name() + ")") + ": " + what, depth);
  };
  const double peak = motion.peak_acceleration(), duration = motion.duration();
  const double step = duration / static_cast<double>(motion.segments());
  if (!recorded && peak == 0) return;
  const auto odd = [&](const char* quantity, const char* name, double value) {
    const std::string text = implausibility(quantity, name, value);
    if (!text.empty()) warn(text);
    return !text.empty();
  };
  if (recorded &&
      (odd("time step of a record", "the time step", step) || odd("duration of a record", "the duration", duration)))
    return;
  if (odd("peak of a record", "the largest acceleration", peak)) return;
  const double velocity = ground_history(motion).velocity.back(), mean = velocity / motion.duration();
  if (std::abs(mean) > max_plausible_mean * peak &&
      (recorded || begins_and_ends_at_rest(motion.acceleration(), mean, peak)))
    warn("the mean acceleration, " + digits(mean) +
         " m/s^2, is more than 0.5 % of the peak and leaves the ground moving at " + digits(velocity) +
         " m/s; this is a baseline error, which .detrended() removes");
}

}  // namespace stickslip::python
