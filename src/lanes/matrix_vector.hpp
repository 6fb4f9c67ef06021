// Products of a matrix with one vector.
#pragma once

#include <cstddef>

namespace stickslip::detail {

/// Its rows are a multiple of this number.
inline constexpr std::size_t rows_of_matrix_vector = 8;

/// result = matrix times vector, in the widest vectors of the processor.
/// @param matrix   rows x columns, column by column
/// @param result   apart from the others
void matrix_vector(const double* matrix, std::size_t rows, std::size_t columns, const double* vector, double* result);

}  // namespace stickslip::detail
