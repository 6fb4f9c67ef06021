// Products of a matrix with many columns.
#pragma once

#include <cstddef>

namespace stickslip::detail {

/// result = matrix times columns, in the widest vectors of the processor. All are stored column by column.
/// @param matrix   size x size
/// @param columns  size x count
/// @param result   size x count, apart from the others
void matrix_product(const double* matrix, std::size_t size, const double* columns, std::size_t count, double* result);

}  // namespace stickslip::detail
