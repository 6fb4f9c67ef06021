// Rests of many sliders side by side: the next segment that moves one of them.
//
// Included once for each instruction set, as Highway's own -inl headers are.
#if defined(STICKSLIP_RESTS_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef STICKSLIP_RESTS_INL
#undef STICKSLIP_RESTS_INL
#else
#define STICKSLIP_RESTS_INL
#endif

#include <algorithm>
#include <bit>
#include <cstddef>

#include "lanes/level_lanes.hpp"
#include "lanes/pack-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace stickslip::detail::HWY_NAMESPACE {

// The first of `count` indices starting at `from` at which `a` is below `lowest` or `b` above `highest`; count if there
// is none.
HWY_INLINE std::size_t first_outside(const double* a, const double* b, std::size_t from, std::size_t count,
                                     double lowest, double highest) {
  const Pack<1> low = lowest, high = highest;
  std::size_t i = from;
  for (; i + lanes <= count; i += lanes) {
    const PackMask<1> outside = (Pack<1>::load(a + i) < low) | (Pack<1>::load(b + i) > high);
    if (HWY_UNLIKELY(any(outside))) return i + static_cast<std::size_t>(std::countr_zero(bits(outside)));
  }
  while (i < count && !(a[i] < lowest || b[i] > highest)) ++i;
  return i;
}

// The next segment, from i on, in which the ground acceleration leaves what holds all lanes of a vector.
HWY_INLINE std::size_t next_departure(const LevelGround& ground, std::size_t i, double lowest, double highest) {
  constexpr std::size_t block = LevelGround::block;
  const double *const start = ground.start(), *const end = ground.end();
  const std::size_t segments = ground.segments();
  // What holds a lane at the end of a segment holds it at the beginning of the next one.
  if (i == 0 && (start[0] < lowest || start[0] > highest)) return 0;
  const std::size_t begun = std::min((i + block - 1) / block * block, segments);
  i = first_outside(end, end, i, begun, lowest, highest);
  if (i < begun || begun == segments) return i;
  const std::size_t in = first_outside(ground.lowest().data(), ground.highest().data(), begun / block,
                                       ground.lowest().size(), lowest, highest);
  return first_outside(end, end, std::min(in * block, segments), segments, lowest, highest);
}

}  // namespace stickslip::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
