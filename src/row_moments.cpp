#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "row_moments.cpp"
#include "row_moments.hpp"

#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "stickslip/statistics.hpp"

HWY_BEFORE_NAMESPACE();
namespace stickslip::detail::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;
using D = hn::CappedTag<double, row_padding>;
using V = hn::Vec<D>;

// The sums of (x - e)^p (v - f)^q become those about a mean that lies e, f lower.
struct Sums {
  V xx, xv, vv, xxx, xxv, xvv, vvv, xxxx, xxvv, vvvv;

  HWY_INLINE void shift(V n, V e, V f) {
    const D d;
    const V two = hn::Set(d, 2), three = hn::Set(d, 3), four = hn::Set(d, 4), six = hn::Set(d, 6);
    const V ee = hn::Mul(e, e), ef = hn::Mul(e, f), ff = hn::Mul(f, f);
    const auto sum = [](auto... terms) HWY_ATTR {
      V total = hn::Zero(D());
      ((total = hn::Add(total, terms)), ...);
      return total;
    };
    const auto times = [](V first, auto... factors) HWY_ATTR {
      ((first = hn::Mul(first, factors)), ...);
      return first;
    };
    xxxx = sum(xxxx, times(four, e, xxx), times(six, ee, xx), times(n, ee, ee));
    vvvv = sum(vvvv, times(four, f, vvv), times(six, ff, vv), times(n, ff, ff));
    xxvv = sum(xxvv, times(two, f, xxv), times(two, e, xvv), times(ff, xx), times(ee, vv), times(four, ef, xv),
               times(n, ee, ff));
    xxx = sum(xxx, times(three, e, xx), times(n, ee, e));
    xxv = sum(xxv, times(two, e, xv), times(f, xx), times(n, ee, f));
    xvv = sum(xvv, times(two, f, xv), times(e, vv), times(n, e, ff));
    vvv = sum(vvv, times(three, f, vv), times(n, ff, f));
    xx = hn::Add(xx, hn::Mul(n, ee));
    xv = hn::Add(xv, hn::Mul(n, ef));
    vv = hn::Add(vv, hn::Mul(n, ff));
  }

  template <class F>
  static HWY_INLINE void each(F use) {
    use(&Sums::xx, Tally::xx), use(&Sums::xv, Tally::xv), use(&Sums::vv, Tally::vv);
    use(&Sums::xxx, Tally::xxx), use(&Sums::xxv, Tally::xxv), use(&Sums::xvv, Tally::xvv), use(&Sums::vvv, Tally::vvv);
    use(&Sums::xxxx, Tally::xxxx), use(&Sums::xxvv, Tally::xxvv), use(&Sums::vvvv, Tally::vvvv);
  }
};

// Lanes past the last member are left out.
template <bool whole, class Use>
HWY_INLINE void each_vector(std::size_t members, Use use) {
  const D d;
  for (std::size_t i = 0; i < members; i += hn::Lanes(d)) {
    const auto counted = hn::FirstN(d, members - i);
    use(i, [counted](V value) HWY_ATTR { return whole ? value : hn::IfThenElseZero(counted, value); });
  }
}

template <bool whole, bool central>
HWY_INLINE void row(const double* HWY_RESTRICT x, const double* HWY_RESTRICT v, std::size_t members,
                    double* HWY_RESTRICT sums, std::size_t stride, const CentralSums* central_sums) {
  const D d;
  V mean_x = hn::Zero(d), mean_v = hn::Zero(d);
  each_vector<whole>(members, [&](std::size_t i, auto keep) HWY_ATTR {
    mean_x = hn::Add(mean_x, keep(hn::LoadU(d, x + i)));
    mean_v = hn::Add(mean_v, keep(hn::LoadU(d, v + i)));
  });
  const V share = hn::Set(d, 1.0 / static_cast<double>(members));
  mean_x = hn::Mul(hn::SumOfLanes(d, mean_x), share);
  mean_v = hn::Mul(hn::SumOfLanes(d, mean_v), share);

  const V zero = hn::Zero(d);
  V xx = zero, xv = zero, vv = zero, xxx = zero, xxv = zero, xvv = zero, vvv = zero, xxxx = zero, xxvv = zero,
    vvvv = zero;
  each_vector<whole>(members, [&](std::size_t i, auto keep) HWY_ATTR {
    const V velocity = hn::LoadU(d, v + i);
    const V e = keep(hn::Sub(hn::LoadU(d, x + i), mean_x));
    const V f = keep(hn::Sub(velocity, mean_v));
    const V ee = hn::Mul(e, e), ef = hn::Mul(e, f), ff = hn::Mul(f, f);
    xx = hn::Add(xx, ee);
    xv = hn::Add(xv, ef);
    vv = hn::Add(vv, ff);
    xxx = hn::MulAdd(ee, e, xxx);
    xxv = hn::MulAdd(ee, f, xxv);
    xvv = hn::MulAdd(e, ff, xvv);
    vvv = hn::MulAdd(ff, f, vvv);
    xxxx = hn::MulAdd(ee, ee, xxxx);
    xxvv = hn::MulAdd(ee, ff, xxvv);
    vvvv = hn::MulAdd(ff, ff, vvvv);
    if constexpr (central) {
      const auto add = [d, i](double* to, V value)
                           HWY_ATTR { hn::StoreU(hn::Add(hn::LoadU(d, to + i), value), d, to + i); };
      add(central_sums->velocity, velocity);
      add(central_sums->velocity_square, ff);
      hn::StoreU(hn::MulAdd(ff, ff, hn::LoadU(d, central_sums->velocity_fourth + i)), d,
                 central_sums->velocity_fourth + i);
      add(central_sums->product, ef);
    }
  });
  sums[Tally::x * stride] = hn::GetLane(mean_x);
  sums[Tally::v * stride] = hn::GetLane(mean_v);
  const Sums all{xx, xv, vv, xxx, xxv, xvv, vvv, xxxx, xxvv, vvvv};
  Sums::each([&](auto member, std::size_t m)
                 HWY_ATTR { sums[m * stride] = hn::GetLane(hn::SumOfLanes(d, all.*member)); });
}

void RowMoments(const double* x, const double* v, std::size_t members, double* sums, std::size_t stride,
                const CentralSums* central) {
  const bool whole = members % row_padding == 0;
  if (whole)
    central ? row<true, true>(x, v, members, sums, stride, central)
            : row<true, false>(x, v, members, sums, stride, central);
  else
    central ? row<false, true>(x, v, members, sums, stride, central)
            : row<false, false>(x, v, members, sums, stride, central);
}

void MergeMoments(double left_members, double right_members, double* left, const double* right, std::size_t times) {
  const D d;
  const V n_left = hn::Set(d, left_members), n_right = hn::Set(d, right_members);
  const V share = hn::Set(d, right_members / (left_members + right_members));
  const auto at = [times](auto* sums, std::size_t m, std::size_t i) HWY_ATTR { return sums + m * times + i; };
  // The last vector ends with the last time: what it shares with the one before must not be merged twice.
  alignas(64) double padded[2][Tally::moments][row_padding];
  const auto vector = [&](double* l, const double* r, std::size_t stride) HWY_ATTR {
    const V x = hn::LoadU(d, l), v = hn::LoadU(d, l + stride);
    const V dx = hn::Sub(hn::LoadU(d, r), x), dv = hn::Sub(hn::LoadU(d, r + stride), v);
    const V ex = hn::Mul(dx, share), ev = hn::Mul(dv, share);
    Sums a, b;
    Sums::each([&](auto member, std::size_t m) HWY_ATTR {
      a.*member = hn::LoadU(d, l + m * stride);
      b.*member = hn::LoadU(d, r + m * stride);
    });
    a.shift(n_left, hn::Neg(ex), hn::Neg(ev));
    b.shift(n_right, hn::Sub(dx, ex), hn::Sub(dv, ev));
    hn::StoreU(hn::Add(x, ex), d, l);
    hn::StoreU(hn::Add(v, ev), d, l + stride);
    Sums::each([&](auto member, std::size_t m)
                   HWY_ATTR { hn::StoreU(hn::Add(a.*member, b.*member), d, l + m * stride); });
  };
  std::size_t i = 0;
  for (; i + hn::Lanes(d) <= times; i += hn::Lanes(d)) vector(left + i, right + i, times);
  if (i == times) return;
  const std::size_t rest = times - i;
  for (std::size_t m = 0; m < Tally::moments; ++m)
    for (std::size_t k = 0; k < row_padding; ++k) {
      padded[0][m][k] = k < rest ? *at(left, m, i + k) : 0;
      padded[1][m][k] = k < rest ? *at(right, m, i + k) : 0;
    }
  vector(padded[0][0], padded[1][0], row_padding);
  for (std::size_t m = 0; m < Tally::moments; ++m)
    for (std::size_t k = 0; k < rest; ++k) *at(left, m, i + k) = padded[0][m][k];
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
