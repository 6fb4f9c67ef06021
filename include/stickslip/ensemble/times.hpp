// When the statistics of an ensemble are taken.
#pragma once

#include <cstddef>
#include <optional>

#include "stickslip/detail/requirements.hpp"

namespace stickslip {

/// The time that all ground motions of an ensemble have in common.
struct TimeBase {
  double duration = 0;  ///< from the first sample to the last [s]
  double dt = 0;        ///< between samples [s]; 0: they have none in common
};

/// The times of the statistics: 0, dt, 2 dt, ... of the motion; none where the members' motions differ in duration.
struct EnsembleTimes {
  double dt = 0;          ///< [s]
  std::size_t count = 0;  ///< at least 2, or 0

  /// Stationary averages are taken over the central half, thesis 4.4: `central` times from `begin` on.
  std::size_t begin() const noexcept { return count / 4; }
  std::size_t central() const noexcept { return count / 2; }
  friend bool operator==(const EnsembleTimes&, const EnsembleTimes&) = default;
};

namespace detail {

/// @param dt    as in EnsembleOptions
/// @param base  where it has samples, times may be every second, third, ... of them
/// @return no times where there is no base
/// @throws std::invalid_argument  a dt that does not fit, or that is given without a base
EnsembleTimes ensemble_times(double dt, const std::optional<TimeBase>& base);

}  // namespace detail

}  // namespace stickslip
