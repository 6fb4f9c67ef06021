// The elastic response spectrum of a ground motion.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "stickslip/ground/ground_motion.hpp"

namespace stickslip {

/// The response quantity of a spectrum.
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
  std::string name{};           ///< of the ground motion, or of what carries the oscillators

  double value(std::size_t damping_index, std::size_t period_index) const {
    return values[damping_index * periods.size() + period_index];
  }
};

/// The largest response over all time of linear oscillators under a ground motion,
///
///     x'' + 2 zeta wn x' + wn^2 x = -n(t),   wn = 2 pi / T,
///
/// at rest when the motion begins. The response is exact for both interpolations, and so is its maximum, which is taken
/// in continuous time, not at the samples, whatever the ratio of T to the time step. After the last sample n is zero,
/// and the maximum includes the free vibration that follows. (If the ground velocity of a record does not end at zero,
/// the ground keeps that velocity, and oscillators of long period go on to x' / wn: correct the baseline first.)
///
/// @param motion   either interpolation, even or uneven times; the component along its axis acts
/// @param periods  T [s], in any order; each from 1e-6 to 1e6 s, or 0, a rigid oscillator: max |n| for accelerations,
///                 0 for the others
/// @param damping  zeta, each at least 0 and below 2; 1 is critical
/// @throws std::invalid_argument  no periods or no damping ratios; one of them out of range
/// Accuracy: round-off, about 1e-15 of the largest value, times the square root of the number of samples, and times the
/// number of radians in a time step if that is above 1.
/// Cost: 100 periods and 10,000 samples take about 2 ms with even times (AVX-512), and up to 15 ms for white noise at
/// critical damping. Uneven times add about 0.3 us for each period, damping ratio and change of the time step.
/// Reference: N. C. Nigam, P. C. Jennings, Bull. Seism. Soc. Am. 59 (1969), 909-922, for the response at the samples.
ResponseSpectrum response_spectrum(const GroundMotion& motion, std::vector<double> periods,
                                   std::vector<double> damping = {0.05},
                                   SpectrumKind kind = SpectrumKind::pseudo_acceleration);

/// A jump of the velocity of the ground, or of a floor, between two segments of its acceleration.
struct Impulse {
  std::size_t before;  ///< index of the segment that follows
  double velocity;     ///< after minus before the jump [m/s]

  friend bool operator==(const Impulse&, const Impulse&) = default;
};

/// The same under straight segments with jumps between them, such as the absolute acceleration of a sliding mass
/// (sliding/floor_motion.hpp): a floor spectrum. An impulse changes the velocity x' of each oscillator by the opposite
/// jump, and adds nothing else; a rigid oscillator has no finite acceleration then.
///
/// @param motion    consecutive segments [s], [m/s^2]: durations at least 0 and finite, accelerations finite and at
///                  most 1e100; the sum of the durations positive
/// @param impulses  in order; `before` at most the number of segments, velocities finite
/// @throws std::invalid_argument  also for an invalid segment or impulse, named by its index; for the acceleration of a
///                                rigid oscillator (period 0) under impulses
ResponseSpectrum response_spectrum(const std::vector<Segment>& motion, std::vector<double> periods,
                                   std::vector<double> damping = {0.05},
                                   SpectrumKind kind = SpectrumKind::pseudo_acceleration,
                                   const std::vector<Impulse>& impulses = {});

}  // namespace stickslip
