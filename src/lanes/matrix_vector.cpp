#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "lanes/matrix_vector.cpp"
#include "lanes/matrix_vector.hpp"

#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace stickslip::detail::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

// Eight vectors of rows: the sums stay in registers.
HWY_INLINE void eight_vectors(const double* HWY_RESTRICT matrix, std::size_t rows, std::size_t columns,
                              const double* HWY_RESTRICT vector, double* HWY_RESTRICT result) {
  const hn::ScalableTag<double> d;
  const std::size_t lanes = hn::Lanes(d);
  auto a0 = hn::Zero(d), a1 = a0, a2 = a0, a3 = a0, a4 = a0, a5 = a0, a6 = a0, a7 = a0;
  for (std::size_t k = 0; k < columns; ++k, matrix += rows) {
    const auto factor = hn::Set(d, vector[k]);
    a0 = hn::MulAdd(hn::LoadU(d, matrix), factor, a0);
    a1 = hn::MulAdd(hn::LoadU(d, matrix + lanes), factor, a1);
    a2 = hn::MulAdd(hn::LoadU(d, matrix + 2 * lanes), factor, a2);
    a3 = hn::MulAdd(hn::LoadU(d, matrix + 3 * lanes), factor, a3);
    a4 = hn::MulAdd(hn::LoadU(d, matrix + 4 * lanes), factor, a4);
    a5 = hn::MulAdd(hn::LoadU(d, matrix + 5 * lanes), factor, a5);
    a6 = hn::MulAdd(hn::LoadU(d, matrix + 6 * lanes), factor, a6);
    a7 = hn::MulAdd(hn::LoadU(d, matrix + 7 * lanes), factor, a7);
  }
  hn::StoreU(a0, d, result);
  hn::StoreU(a1, d, result + lanes);
  hn::StoreU(a2, d, result + 2 * lanes);
  hn::StoreU(a3, d, result + 3 * lanes);
  hn::StoreU(a4, d, result + 4 * lanes);
  hn::StoreU(a5, d, result + 5 * lanes);
  hn::StoreU(a6, d, result + 6 * lanes);
  hn::StoreU(a7, d, result + 7 * lanes);
}

// One vector of rows: four columns at a time, whose sums do not wait for each other.
HWY_INLINE void one_vector(const double* HWY_RESTRICT matrix, std::size_t rows, std::size_t columns,
                           const double* HWY_RESTRICT vector, double* HWY_RESTRICT result) {
  const hn::ScalableTag<double> d;
  auto a0 = hn::Zero(d), a1 = a0, a2 = a0, a3 = a0;
  std::size_t k = 0;
  for (; k + 4 <= columns; k += 4, matrix += 4 * rows) {
    a0 = hn::MulAdd(hn::LoadU(d, matrix), hn::Set(d, vector[k]), a0);
    a1 = hn::MulAdd(hn::LoadU(d, matrix + rows), hn::Set(d, vector[k + 1]), a1);
    a2 = hn::MulAdd(hn::LoadU(d, matrix + 2 * rows), hn::Set(d, vector[k + 2]), a2);
    a3 = hn::MulAdd(hn::LoadU(d, matrix + 3 * rows), hn::Set(d, vector[k + 3]), a3);
  }
  for (; k < columns; ++k, matrix += rows) a0 = hn::MulAdd(hn::LoadU(d, matrix), hn::Set(d, vector[k]), a0);
  hn::StoreU(hn::Add(hn::Add(a0, a1), hn::Add(a2, a3)), d, result);
}

void MatrixVector(const double* matrix, std::size_t rows, std::size_t columns, const double* vector, double* result) {
  const std::size_t lanes = hn::Lanes(hn::ScalableTag<double>());
  std::size_t row = 0;
  for (; row + 8 * lanes <= rows; row += 8 * lanes) eight_vectors(matrix + row, rows, columns, vector, result + row);
  for (; row < rows; row += lanes) one_vector(matrix + row, rows, columns, vector, result + row);
}

}  // namespace stickslip::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace stickslip::detail {

HWY_EXPORT(MatrixVector);

void matrix_vector(const double* matrix, std::size_t rows, std::size_t columns, const double* vector, double* result) {
  HWY_DYNAMIC_DISPATCH(MatrixVector)(matrix, rows, columns, vector, result);
}

}  // namespace stickslip::detail
#endif
