#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "lanes/row_moments.cpp"
#include "lanes/row_moments.hpp"

#include <hwy/foreach_target.h>

#include "lanes/pack-inl.hpp"
#include "stickslip/statistics/tally.hpp"

HWY_BEFORE_NAMESPACE();
namespace stickslip::detail::HWY_NAMESPACE {

using Real = Pack<1>;
using Bool = Real::Mask;

// Sums of (x - mean)^p (x' - mean)^q.
struct Sums {
  Real xx, xv, vv, xxx, xxv, xvv, vvv, xxxx, xxvv, vvvv;

  // To means that lie e and f lower, of n members.
  HWY_INLINE void shift(const Real& n, const Real& e, const Real& f) {
    const Real ee = e * e, ef = e * f, ff = f * f;
    xxxx = xxxx + (e * 4.0 * xxx + ee * 6.0 * xx) + n * ee * ee;
    vvvv = vvvv + (f * 4.0 * vvv + ff * 6.0 * vv) + n * ff * ff;
    xxvv = xxvv + (f * xxv + e * xvv) * 2.0 + (ff * xx + ee * vv + ef * 4.0 * xv) + n * ee * ff;
    xxx = xxx + e * 3.0 * xx + n * ee * e;
    xxv = xxv + (e * 2.0 * xv + f * xx) + n * ee * f;
    xvv = xvv + (f * 2.0 * xv + e * vv) + n * e * ff;
    vvv = vvv + f * 3.0 * vv + n * ff * f;
    xx = xx + n * ee;
    xv = xv + n * ef;
    vv = vv + n * ff;
  }

  template <class Use>
  static HWY_INLINE void each(Use use) {
    use(&Sums::xx, Tally::xx), use(&Sums::xv, Tally::xv), use(&Sums::vv, Tally::vv);
    use(&Sums::xxx, Tally::xxx), use(&Sums::xxv, Tally::xxv), use(&Sums::xvv, Tally::xvv), use(&Sums::vvv, Tally::vvv);
    use(&Sums::xxxx, Tally::xxxx), use(&Sums::xxvv, Tally::xxvv), use(&Sums::vvvv, Tally::vvvv);
  }
};

// `whole`: the row has no lanes past the last member, which are left out.
template <bool whole, bool central>
HWY_INLINE void row(const double* HWY_RESTRICT x, const double* HWY_RESTRICT v, std::size_t members,
                    double* HWY_RESTRICT sums, std::size_t stride, const CentralSums* HWY_RESTRICT to) {
  const auto counted = [members](std::size_t i, const Real& value)
                           HWY_ATTR { return whole ? value : where(Bool::first(members - i), value); };
  Real total_x = 0.0, total_v = 0.0;
  for (std::size_t i = 0; i < members; i += Real::size) {
    total_x = total_x + counted(i, Real::load(x + i));
    total_v = total_v + counted(i, Real::load(v + i));
  }
  const double mean_x = sum(total_x) / static_cast<double>(members);
  const double mean_v = sum(total_v) / static_cast<double>(members);

  const Real zero = 0.0;
  Sums s{zero, zero, zero, zero, zero, zero, zero, zero, zero, zero};
  for (std::size_t i = 0; i < members; i += Real::size) {
    const Real velocity = Real::load(v + i);
    const Real e = counted(i, Real::load(x + i) - mean_x), f = counted(i, velocity - mean_v);
    const Real ee = e * e, ef = e * f, ff = f * f;
    s.xx = s.xx + ee;
    s.xv = s.xv + ef;
    s.vv = s.vv + ff;
    s.xxx = multiply_add(ee, e, s.xxx);
    s.xxv = multiply_add(ee, f, s.xxv);
    s.xvv = multiply_add(e, ff, s.xvv);
    s.vvv = multiply_add(ff, f, s.vvv);
    s.xxxx = multiply_add(ee, ee, s.xxxx);
    s.xxvv = multiply_add(ee, ff, s.xxvv);
    s.vvvv = multiply_add(ff, ff, s.vvvv);
    if constexpr (central) {
      (Real::load(to->velocity + i) + velocity).store(to->velocity + i);
      (Real::load(to->velocity_square + i) + ff).store(to->velocity_square + i);
      multiply_add(ff, ff, Real::load(to->velocity_fourth + i)).store(to->velocity_fourth + i);
      (Real::load(to->product + i) + ef).store(to->product + i);
    }
  }
  sums[Tally::x * stride] = mean_x;
  sums[Tally::v * stride] = mean_v;
  Sums::each([&](auto member, std::size_t m) HWY_ATTR { sums[m * stride] = sum(s.*member); });
}

void RowMoments(const double* x, const double* v, std::size_t members, double* sums, std::size_t stride,
                const CentralSums* central) {
  const bool whole = members % row_padding == 0;
  const auto work =
      whole ? (central ? &row<true, true> : &row<true, false>) : (central ? &row<false, true> : &row<false, false>);
  work(x, v, members, sums, stride, central);
}

// One pack of times; moments lie `stride` apart.
HWY_INLINE void merge(double left_members, double right_members, double* left, const double* right,
                      std::size_t stride) {
  const Real x = Real::load(left), v = Real::load(left + stride);
  const Real dx = Real::load(right) - x, dv = Real::load(right + stride) - v;
  const double share = right_members / (left_members + right_members);
  const Real ex = dx * share, ev = dv * share;
  Sums a, b;
  Sums::each([&](auto member, std::size_t m) HWY_ATTR {
    a.*member = Real::load(left + m * stride);
    b.*member = Real::load(right + m * stride);
  });
  a.shift(left_members, -ex, -ev);
  b.shift(right_members, dx - ex, dv - ev);
  (x + ex).store(left);
  (v + ev).store(left + stride);
  Sums::each([&](auto member, std::size_t m) HWY_ATTR { (a.*member + b.*member).store(left + m * stride); });
}

void MergeMoments(double left_members, double right_members, double* left, const double* right, std::size_t times) {
  std::size_t i = 0;
  for (; i + Real::size <= times; i += Real::size) merge(left_members, right_members, left + i, right + i, times);
  if (i == times) return;
  // The last few go by way of a padded copy.
  double l[Tally::moments][row_padding] = {}, r[Tally::moments][row_padding] = {};
  for (std::size_t m = 0; m < Tally::moments; ++m)
    for (std::size_t k = i; k < times; ++k) {
      l[m][k - i] = left[m * times + k];
      r[m][k - i] = right[m * times + k];
    }
  merge(left_members, right_members, l[0], r[0], row_padding);
  for (std::size_t m = 0; m < Tally::moments; ++m)
    for (std::size_t k = i; k < times; ++k) left[m * times + k] = l[m][k - i];
}

}  // namespace stickslip::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace stickslip::detail {

HWY_EXPORT(RowMoments);
HWY_EXPORT(MergeMoments);

void row_moments(const double* x, const double* v, std::size_t members, double* sums, std::size_t stride,
                 const CentralSums* central) {
  HWY_DYNAMIC_DISPATCH(RowMoments)(x, v, members, sums, stride, central);
}

void merge_moments(double left_members, double right_members, double* left, const double* right, std::size_t times) {
  HWY_DYNAMIC_DISPATCH(MergeMoments)(left_members, right_members, left, right, times);
}

}  // namespace stickslip::detail
#endif
