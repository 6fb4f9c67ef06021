// Rows to columns: from records to lanes and back.
#pragma once

#include <cstddef>

#include "stickslip/detail/requirements.hpp"

namespace stickslip::detail {

/// Element (k, i) of the one becomes element (i, k) of the other; rows are `stride` apart.
/// @param rows  of what is transposed, a multiple of four
void transpose(const double* from, std::size_t rows, std::size_t columns, std::size_t from_stride, double* to,
               std::size_t to_stride);

}  // namespace stickslip::detail
