// Transposition between records and lanes.
#pragma once

#include <cstddef>

#include "stickslip/base/requirements.hpp"

namespace stickslip::detail {

/// Transpose: element (k, i) of the source becomes element (i, k) of the result; rows are `stride` apart.
/// @param rows  number of rows, a multiple of four
void transpose(const double* from, std::size_t rows, std::size_t columns, std::size_t from_stride, double* to,
               std::size_t to_stride);

}  // namespace stickslip::detail
