#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "lanes/oscillator_lanes.cpp"
#include "lanes/oscillator_lanes.hpp"

#include <hwy/foreach_target.h>

#include <bit>
#include <cstdint>

#include "lanes/pack-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace stickslip::detail::HWY_NAMESPACE {

using Real = Pack < lanes<8 ? 2 : 1>;
using Bool = Real::Mask;

template <bool within>
HWY_INLINE void sweep(OscillatorLanes& o, const SegmentRow& row, const Inspector& inspector) {
  const Real duration = row.duration, steepness = 1 / row.duration;
  for (std::size_t i = 0; i < o.peak.size(); i += Real::size) {
    const auto of = [i](const std::vector<double>& values) HWY_ATTR { return Real::load(values.data() + i); };
    const Real xx = of(o.x_of[0]), xv = of(o.x_of[1]), xs = of(o.x_of[2]), xe = of(o.x_of[3]);
    const Real vx = of(o.v_of[0]), vv = of(o.v_of[1]), vs = of(o.v_of[2]), ve = of(o.v_of[3]);
    const Real of_x = of(o.of_displacement), of_v = of(o.of_velocity), c = of(o.damping), k = of(o.stiffness);
    const Real rise_bend = of(o.rise[0]), rise_twist = of(o.rise[1]), soon = of(o.soon), softness = of(o.softness);
    Real x = of(o.state.x), v = of(o.state.v), peak = of(o.peak);
    Real f = multiply_add(of_x, x, of_v * v);
    for (std::size_t s = 0; s < row.count; ++s) {
      const Real start = row.start[s], end = row.end[s];
      const Real next_x = multiply_add(xx, x, multiply_add(xv, v, multiply_add(xs, start, xe * end)));
      const Real next_v = multiply_add(vx, x, multiply_add(vv, v, multiply_add(vs, start, ve * end)));
      const Real next_f = multiply_add(of_x, next_x, of_v * next_v);
      peak = max(peak, abs(next_f));
      if constexpr (within) {
        const Real a = -multiply_add(k, x, multiply_add(c, v, start));  // x''
        const Real j = nfma(end - start, steepness, -multiply_add(c, a, k * v));
        const Real bend = multiply_add(of_x, a, of_v * j);  // f'', f'''
        const Real twist = nfma(of_v, multiply_add(c, j, k * a), of_x * j);
        Bool open = max(abs(f), abs(next_f)) + multiply_add(rise_bend, abs(bend), rise_twist * abs(twist)) > peak;
        if (any(open)) {
          const Real slope = multiply_add(of_x, v, of_v * a);
          const Real next_slope = nfma(of_v, multiply_add(k, next_x, multiply_add(c, next_v, end)), of_x * next_v);
          // Where f' has the same sign at both ends and cannot reach zero between them, f has no extremum.
          const Bool far = abs(slope) + abs(next_slope) > duration * multiply_add(soon, abs(twist), abs(bend));
          open = but_not(open, ((slope < 0) ^ (next_slope > 0)) & far);
          // f is a straight line plus a free oscillation, whose energy only decreases.
          const Real swing_slope = -(multiply_add(c, bend, twist) * softness);
          const Real swing = -(multiply_add(c, swing_slope, bend) * softness);
          const Real line = f - swing, line_end = multiply_add(slope - swing_slope, duration, line);
          const Real size = sqrt(multiply_add(swing, swing, swing_slope * swing_slope * softness));
          open = open & (max(abs(line), abs(line_end)) + size > peak);
          if (any(open)) {
            alignas(64) double xs_now[Real::size], vs_now[Real::size], peaks[Real::size];
            x.store(xs_now);
            v.store(vs_now);
            peak.store(peaks);
            for (std::uint64_t left = bits(open); left != 0; left &= left - 1) {
              const auto lane = static_cast<std::size_t>(std::countr_zero(left));
              const double found = inspector.inspect(inspector.context, i + lane, row, s, xs_now[lane], vs_now[lane]);
              if (found > peaks[lane]) peaks[lane] = found;
            }
            peak = Real::load(peaks);
          }
        }
      }
      x = next_x;
      v = next_v;
      f = next_f;
    }
    x.store(o.state.x.data() + i);
    v.store(o.state.v.data() + i);
    peak.store(o.peak.data() + i);
  }
}

void SweepEnds(OscillatorLanes& lanes_, const SegmentRow& row) { sweep<false>(lanes_, row, {}); }
void SweepWithin(OscillatorLanes& lanes_, const SegmentRow& row, const Inspector& inspector) {
  sweep<true>(lanes_, row, inspector);
}

}  // namespace stickslip::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace stickslip::detail {

HWY_EXPORT(SweepEnds);
HWY_EXPORT(SweepWithin);

void sweep_ends(OscillatorLanes& lanes, const SegmentRow& row) { HWY_DYNAMIC_DISPATCH(SweepEnds)(lanes, row); }

void sweep_within(OscillatorLanes& lanes, const SegmentRow& row, const Inspector& inspector) {
  HWY_DYNAMIC_DISPATCH(SweepWithin)(lanes, row, inspector);
}

}  // namespace stickslip::detail
#endif
