#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "lanes/matrix_product.cpp"
#include "lanes/matrix_product.hpp"

#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include <algorithm>
#include <vector>

HWY_BEFORE_NAMESPACE();
namespace stickslip::detail::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

// Two vectors of rows of `wide` columns of the result: the sums stay in registers, the rows of the matrix in the cache.
template <std::size_t wide>
HWY_INLINE void rows_product(const double* HWY_RESTRICT rows, std::size_t size, const double* HWY_RESTRICT columns,
                             double* HWY_RESTRICT result, std::size_t stride) {
  const hn::ScalableTag<double> d;
  const std::size_t lanes = hn::Lanes(d);
  auto low0 = hn::Zero(d), low1 = low0, low2 = low0, low3 = low0;
  auto high0 = low0, high1 = low0, high2 = low0, high3 = low0;
  for (std::size_t k = 0; k < size; ++k, rows += 2 * lanes) {
    const auto low = hn::LoadU(d, rows), high = hn::LoadU(d, rows + lanes);
    const auto times = [&](auto& sum_low, auto& sum_high, std::size_t column) HWY_ATTR {
      const auto factor = hn::Set(d, columns[column * size + k]);
      sum_low = hn::MulAdd(low, factor, sum_low);
      sum_high = hn::MulAdd(high, factor, sum_high);
    };
    times(low0, high0, 0);
    if constexpr (wide > 1) times(low1, high1, 1), times(low2, high2, 2), times(low3, high3, 3);
  }
  const auto store = [&](const auto& sum_low, const auto& sum_high, std::size_t column) HWY_ATTR {
    hn::StoreU(sum_low, d, result + column * stride);
    hn::StoreU(sum_high, d, result + column * stride + lanes);
  };
  store(low0, high0, 0);
  if constexpr (wide > 1) store(low1, high1, 1), store(low2, high2, 2), store(low3, high3, 3);
}

void MatrixProduct(const double* matrix, std::size_t size, const double* columns, std::size_t count, double* result) {
  const std::size_t wide = 2 * hn::Lanes(hn::ScalableTag<double>());
  std::vector<double> rows(wide * size), rest(4 * wide);
  for (std::size_t row = 0; row < size; row += wide) {
    const std::size_t some = std::min(wide, size - row);  // the last rows are filled up with zeros
    std::ranges::fill(rows, 0.0);
    for (std::size_t k = 0; k < size; ++k) std::copy_n(matrix + k * size + row, some, rows.data() + k * wide);
    for (std::size_t column = 0; column < count;) {
      const std::size_t group = column + 4 <= count ? 4 : 1;
      double* const to = result + column * size + row;
      double* const into = some == wide ? to : rest.data();
      const std::size_t stride = some == wide ? size : wide;
      if (group == 4)
        rows_product<4>(rows.data(), size, columns + column * size, into, stride);
      else
        rows_product<1>(rows.data(), size, columns + column * size, into, stride);
      if (some < wide)
        for (std::size_t k = 0; k < group; ++k) std::copy_n(rest.data() + k * wide, some, to + k * size);
      column += group;
    }
  }
}

}  // namespace stickslip::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace stickslip::detail {

HWY_EXPORT(MatrixProduct);

void matrix_product(const double* matrix, std::size_t size, const double* columns, std::size_t count, double* result) {
  HWY_DYNAMIC_DISPATCH(MatrixProduct)(matrix, size, columns, count, result);
}

}  // namespace stickslip::detail
#endif
