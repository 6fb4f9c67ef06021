// The peaks of the floors of structures, of the members of an ensemble.
#pragma once

#include <cstddef>
#include <stdexcept>
#include <string>
#include <vector>

#include "stickslip/statistics/tally.hpp"

namespace stickslip {

/// The largest magnitude of one quantity on each floor of each member, over all time; see
/// Ensemble::peak_floor_acceleration.
struct FloorPeaks {
  std::vector<double> values;  ///< member by member; of each the floors, the lowest first
  std::size_t floors = 0;

  std::size_t members() const noexcept { return floors > 0 ? values.size() / floors : 0; }
  /// The peaks of all members on one floor.
  /// @param floor  counted from 1, the lowest
  /// @throws std::invalid_argument  a floor that does not exist
  std::vector<double> on_floor(std::size_t floor) const;

  /// Mean over the members, by floor.
  /// @throws std::domain_error with fewer than two members; the following functions also do
  Estimates mean() const;
  /// Standard deviation over the members, with the divisor members - 1, by floor.
  Estimates deviation() const;
  /// Quantile over the members, by floor, with bounds as of Ensemble::quantile.
  /// @param probability, confidence  in (0, 1)
  std::vector<Interval> quantile(double probability, double confidence = 0.95) const;

  friend bool operator==(const FloorPeaks&, const FloorPeaks&) = default;
};

namespace detail {

/// The numbers that an ensemble keeps of the floors of a structure: the peak acceleration of the base, the peak base
/// shear, and of each floor the peak accelerations and the peak drifts.
constexpr std::size_t floor_numbers(std::size_t floors) noexcept { return 2 + 2 * floors; }
/// In place of a peak drift, for a structure whose `influence` is not ones.
inline constexpr double no_drift = -1;
constexpr std::size_t floors_of_numbers(std::size_t numbers) noexcept { return (numbers - 2) / 2; }

/// Rejects two structures with different numbers of floors.
inline void need_same_floors(std::size_t numbers, std::size_t others) {
  if (numbers != others)
    throw std::invalid_argument("the structures of an ensemble must have the same number of floors, got " +
                                std::to_string(floors_of_numbers(numbers)) + " and " +
                                std::to_string(floors_of_numbers(others)));
}

}  // namespace detail
}  // namespace stickslip
