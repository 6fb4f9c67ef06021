// The elastic response spectrum of a ground motion.
#pragma once

#include <cstddef>
#include <vector>

#include "stickslip/ground/ground_motion.hpp"

namespace stickslip {

/// What a response spectrum gives of each oscillator.
enum class SpectrumKind {
  pseudo_acceleration,  ///< wn^2 max |x| [m/s^2]
  pseudo_velocity,      ///< wn max |x| [m/s]
  displacement,         ///< max |x|, relative to the ground [m]
  velocity,             ///< max |x'|, relative to the ground [m/s]
  acceleration          ///< max |x'' + n|, absolute [m/s^2]
};

/// An elastic response spectrum: see `response_spectrum`.
struct ResponseSpectrum {
  SpectrumKind kind;
  std::vector<double> periods;  ///< undamped natural periods T [s]
  std::vector<double> damping;  ///< ratios of critical damping
  std::vector<double> values;   ///< one row of periods for each damping ratio

  double value(std::size_t damping_index, std::size_t period_index) const {
    return values[damping_index * periods.size() + period_index];
  }
};

/// The largest response over all time of linear oscillators under a ground motion,
///
///     x'' + 2 zeta wn x' + wn^2 x = -n(t),   wn = 2 pi / T,
///
/// at rest when the motion begins. The response is exact for lines and for steps, and so is its maximum: in continuous
/// time, not at the samples, whatever the ratio of T to the time step. After the last sample n is zero: the free
/// vibration that follows belongs to the maximum. (Under a record whose ground velocity does not end at zero the ground
/// keeps this velocity, and oscillators of long period go on to x' / wn: correct the baseline first.)
///
/// @param motion   lines or steps, at even or uneven times; the component along its axis acts
/// @param periods  T [s], in any order; each from 1e-6 to 1e6 s, or 0, a rigid oscillator: max |n| for accelerations,
///                 0 for the others
/// @param damping  zeta, each at least 0 and below 2; 1 is critical
/// @throws std::invalid_argument  no periods or no damping ratios; one out of range
/// Accuracy: round-off, some 1e-15 of the largest value times the number of radians in a time step, where that is above
/// 1, and times the square root of the number of samples.
/// Cost: 100 periods of 10,000 samples in some 2 ms with even times (AVX-512), up to 15 ms of white noise at critical
/// damping. Uneven times cost some 0.3 us for each period, damping ratio and change of the time step.
/// Reference: N. C. Nigam, P. C. Jennings, Bull. Seism. Soc. Am. 59 (1969), 909-922, for the response at the samples.
ResponseSpectrum response_spectrum(const GroundMotion& motion, std::vector<double> periods,
                                   std::vector<double> damping = {0.05},
                                   SpectrumKind kind = SpectrumKind::pseudo_acceleration);

/// The same under straight pieces that may jump where they meet, such as the absolute acceleration of a sliding mass
/// (sliding/floor_motion.hpp): a floor spectrum.
///
/// @param motion  one piece after the other [s], [m/s^2]: durations at least 0 and finite, accelerations finite and at
///                most 1e100; the sum of the durations positive
/// @throws std::invalid_argument  also for a piece that is not so, with its index
ResponseSpectrum response_spectrum(const std::vector<Segment>& motion, std::vector<double> periods,
                                   std::vector<double> damping = {0.05},
                                   SpectrumKind kind = SpectrumKind::pseudo_acceleration);

}  // namespace stickslip
