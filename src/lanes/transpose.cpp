#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "lanes/transpose.cpp"
#include "stickslip/lanes/transpose.hpp"

#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace stickslip::detail::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using Tag = hn::CappedTag<double, 4>;
inline constexpr std::size_t lanes = HWY_MAX_BYTES / sizeof(double) < 4 ? HWY_MAX_BYTES / sizeof(double) : 4;

// As many rows as a vector has lanes, that many columns of each.
HWY_INLINE void block(const double* HWY_RESTRICT from, std::size_t from_stride, double* HWY_RESTRICT to,
                      std::size_t to_stride) {
#if HWY_TARGET == HWY_SCALAR
  (void)from_stride, (void)to_stride;
  *to = *from;
#else
  const Tag d;
  const auto a = hn::LoadU(d, from), b = hn::LoadU(d, from + from_stride);
  const auto ab_even = hn::InterleaveLower(a, b), ab_odd = hn::InterleaveUpper(d, a, b);
  if constexpr (lanes == 2) {
    hn::StoreU(ab_even, d, to);
    hn::StoreU(ab_odd, d, to + to_stride);
  } else {
    const auto c = hn::LoadU(d, from + 2 * from_stride), e = hn::LoadU(d, from + 3 * from_stride);
    const auto ce_even = hn::InterleaveLower(c, e), ce_odd = hn::InterleaveUpper(d, c, e);
    hn::StoreU(hn::ConcatLowerLower(d, ce_even, ab_even), d, to);
    hn::StoreU(hn::ConcatLowerLower(d, ce_odd, ab_odd), d, to + to_stride);
    hn::StoreU(hn::ConcatUpperUpper(d, ce_even, ab_even), d, to + 2 * to_stride);
    hn::StoreU(hn::ConcatUpperUpper(d, ce_odd, ab_odd), d, to + 3 * to_stride);
  }
#endif
}

void Transpose(const double* HWY_RESTRICT from, std::size_t rows, std::size_t columns, std::size_t from_stride,
               double* HWY_RESTRICT to, std::size_t to_stride) {
  std::size_t i = 0;
  for (; i + lanes <= columns; i += lanes)
    for (std::size_t k = 0; k < rows; k += lanes)
      block(from + k * from_stride + i, from_stride, to + i * to_stride + k, to_stride);
  for (; i < columns; ++i)
    for (std::size_t k = 0; k < rows; ++k) to[i * to_stride + k] = from[k * from_stride + i];
}

}  // namespace stickslip::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace stickslip::detail {

HWY_EXPORT(Transpose);

void transpose(const double* from, std::size_t rows, std::size_t columns, std::size_t from_stride, double* to,
               std::size_t to_stride) {
  HWY_DYNAMIC_DISPATCH(Transpose)(from, rows, columns, from_stride, to, to_stride);
}

}  // namespace stickslip::detail
#endif
