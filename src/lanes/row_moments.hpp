// The moments of one row: all members of a block at one time.
#pragma once

#include <cstddef>

#include "stickslip/lanes/row.hpp"

namespace stickslip::detail {

/// What the central part of the motion adds up for each member of a block (padded like the rows).
struct CentralSums {
  double* velocity;         ///< of x'
  double* velocity_square;  ///< of (x' - mean)^2
  double* velocity_fourth;  ///< of (x' - mean)^4
  double* product;          ///< of (x - mean) (x' - mean)
};

/// Means and central sums of one row, in the order of Tally::Moment.
/// @param x, v      displacements and velocities, padded
/// @param members   how many of them count, at least 1
/// @param sums      where the first moment goes; the next lies `stride` doubles on
/// @param central   added to, if the time lies in the central part; or null
void row_moments(const double* x, const double* v, std::size_t members, double* sums, std::size_t stride,
                 const CentralSums* central);

/// Moments of both sets, about the common means, into the left one; `times` of each, `times` apart.
void merge_moments(double left_members, double right_members, double* left, const double* right, std::size_t times);

}  // namespace stickslip::detail
