// The times of the statistics of an ensemble.
#pragma once

#include <cstddef>
#include <optional>

#include "stickslip/base/requirements.hpp"

namespace stickslip {

/// The common times of all ground motions of an ensemble.
struct TimeBase {
  double duration = 0;  ///< from the first sample to the last [s]
  double dt = 0;        ///< between samples [s]; 0: no common step
};

/// The times of the statistics: 0, dt, 2 dt, ... of the motion; none if the ground motions differ in duration.
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
/// @param base  if it has a time step, the times are multiples of that step
/// @return no times without a base
/// @throws std::invalid_argument  a dt that does not fit, or that is given without a base
EnsembleTimes ensemble_times(double dt, const std::optional<TimeBase>& base);

}  // namespace detail

}  // namespace stickslip
