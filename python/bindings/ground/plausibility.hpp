// A warning about implausible recorded ground motions.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <span>
#include <string>

#include "bindings.hpp"

namespace stickslip::python {

/// Recorded peaks are between these; what is above 3 g is nearly always in other units. (The largest ever recorded is some
/// 4 g.)
inline constexpr double min_plausible_peak = 1e-5 * standard_gravity, max_plausible_peak = 3 * standard_gravity;
/// Time steps and durations of records [s].
inline constexpr double min_plausible_step = 0.0005, max_plausible_step = 0.1;
inline constexpr double min_plausible_duration = 1, max_plausible_duration = 3600;
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
    const py::object type = py::module_::import("stickslip._core").attr("PlausibilityWarning");
    const std::string text = who + (motion.name().empty() ? std::string() : " (" + motion.name() + ")") + ": " + what;
    if (PyErr_WarnEx(type.ptr(), text.c_str(), depth) != 0) throw py::error_already_set();
  };
  const auto rounded = [](double value) {
    char text[32];
    std::snprintf(text, sizeof text, "%.3g", value);
    return std::string(text);
  };
  const double peak = motion.peak_acceleration(), duration = motion.duration();
  const double step = duration / static_cast<double>(motion.segments());
  if (!recorded && peak == 0) return;
  constexpr double margin = 1e-9;  // for steps that are these limits
  if (recorded && !(step >= min_plausible_step * (1 - margin) && step <= max_plausible_step * (1 + margin))) {
    warn(
        "the time step, " + rounded(step) +
        " s, is not from 0.0005 to 0.1 s as in recorded earthquakes; check whether milliseconds or numbers of rows were"
        " taken for seconds");
    return;
  }
  if (recorded && !(duration >= min_plausible_duration && duration <= max_plausible_duration)) {
    warn("the duration, " + rounded(duration) +
         " s, is not from 1 s to an hour as in recorded earthquakes; check the time step");
    return;
  }
  if (!(peak >= min_plausible_peak && peak <= max_plausible_peak)) {
    warn("the largest acceleration, " + rounded(peak) +
         " m/s^2, is not from 0.0001 to 29.4 m/s^2 (1e-5 to 3 g) as in recorded earthquakes; check the units");
    return;
  }
  const double velocity = ground_history(motion).velocity.back(), mean = velocity / motion.duration();
  if (std::abs(mean) > max_plausible_mean * peak &&
      (recorded || begins_and_ends_at_rest(motion.acceleration(), mean, peak)))
    warn("the mean acceleration, " + rounded(mean) +
         " m/s^2, is more than 0.5 % of the peak and leaves the ground moving at " + rounded(velocity) +
         " m/s; this is a baseline error, which .detrended() removes");
}

}  // namespace stickslip::python
