// What a header states of the samples below it must be true of them.
#pragma once

#include <cstddef>
#include <string_view>

#include "ground/records/formats.hpp"

namespace stickslip::records {

/// Rejects samples whose peak, with or without their mean, differs from the stated one by more than a quarter and by more
/// than a unit of its last digit: the samples are damaged, or one of the two is in another unit. An empty text, or an
/// unknown unit, states no peak.
/// @param stated  begins with the number
/// @param line    of the statement
void check_peak(const Channel& channel, std::string_view stated, std::string_view unit, std::size_t line);

/// The same for a peak in the unit of the samples.
inline void check_peak(const Channel& channel, std::string_view stated, std::size_t line) {
  check_peak(channel, stated, channel.units, line);
}

/// Rejects a time step for which the samples are longer or shorter than the stated duration by more than a quarter and
/// by more than a second. A duration that is not positive states nothing.
/// @param seconds  the duration
void check_duration(const Channel& channel, double seconds, std::size_t line);

/// Rejects a time step that differs from one stated elsewhere.
void check_step(const Channel& channel, double seconds, std::size_t line);

/// Rejects a time step that no strong-motion record has.
/// @return  the step
double checked_step(double seconds, std::size_t line);

}  // namespace stickslip::records
