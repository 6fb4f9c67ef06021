// Doubles side by side, on any instruction set, in formulas that read like the equations: `Pack<1>` is one vector, of
// two (SSE, NEON), four (AVX2) or eight (AVX-512) doubles; `Pack<2>` is two of them, to keep the processor busy where
// one step waits for another.
//
// Included once for each instruction set, as Highway's own -inl headers are.
#if defined(STICKSLIP_PACK_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef STICKSLIP_PACK_INL
#undef STICKSLIP_PACK_INL
#else
#define STICKSLIP_PACK_INL
#endif

#include <hwy/highway.h>

#include <cstddef>
#include <cstdint>
#include <limits>

#include "stickslip/lanes/row.hpp"

#include <hwy/contrib/math/math-inl.h>

HWY_BEFORE_NAMESPACE();
namespace stickslip::detail::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using Tag = hn::CappedTag<double, 8>;
using Vector = hn::Vec<Tag>;
inline constexpr std::size_t lanes = HWY_MAX_BYTES / sizeof(double) < 8 ? HWY_MAX_BYTES / sizeof(double) : 8;

template <std::size_t parts>
struct PackMask {
  hn::Mask<Tag> part[parts];

  /// The first `count` of them.
  static HWY_INLINE PackMask first(std::size_t count) {
    PackMask result;
    for (std::size_t i = 0; i < parts; ++i)
      result.part[i] = hn::FirstN(Tag(), count > i * lanes ? count - i * lanes : 0);
    return result;
  }
  friend HWY_INLINE PackMask operator&(const PackMask& a, const PackMask& b) {
    PackMask result;
    for (std::size_t i = 0; i < parts; ++i) result.part[i] = hn::And(a.part[i], b.part[i]);
    return result;
  }
  friend HWY_INLINE PackMask operator|(const PackMask& a, const PackMask& b) {
    PackMask result;
    for (std::size_t i = 0; i < parts; ++i) result.part[i] = hn::Or(a.part[i], b.part[i]);
    return result;
  }
  friend HWY_INLINE PackMask operator^(const PackMask& a, const PackMask& b) {
    PackMask result;
    for (std::size_t i = 0; i < parts; ++i) result.part[i] = hn::Xor(a.part[i], b.part[i]);
    return result;
  }
  friend HWY_INLINE PackMask operator~(const PackMask& a) {
    PackMask result;
    for (std::size_t i = 0; i < parts; ++i) result.part[i] = hn::Not(a.part[i]);
    return result;
  }
  /// a, and not b
  friend HWY_INLINE PackMask but_not(const PackMask& a, const PackMask& b) {
    PackMask result;
    for (std::size_t i = 0; i < parts; ++i) result.part[i] = hn::AndNot(b.part[i], a.part[i]);
    return result;
  }
  friend HWY_INLINE bool any(const PackMask& a) {
    bool found = false;
    for (std::size_t i = 0; i < parts; ++i) found |= !hn::AllFalse(Tag(), a.part[i]);
    return found;
  }
  friend HWY_INLINE bool all(const PackMask& a) { return !any(~a); }
  /// one bit each
  friend HWY_INLINE std::uint64_t bits(const PackMask& a) {
    std::uint64_t result = 0;
    for (std::size_t i = 0; i < parts; ++i) {
      alignas(8) std::uint8_t bytes[8] = {};
      hn::StoreMaskBits(Tag(), a.part[i], bytes);
      result |= std::uint64_t{bytes[0]} << (i * lanes);
    }
    return result;
  }
};

template <std::size_t parts>
struct Pack {
  static constexpr std::size_t size = parts * lanes;
  using Mask = PackMask<parts>;

  Vector part[parts];

  Pack() = default;
  HWY_INLINE Pack(double value) {  // NOLINT(google-explicit-constructor): numbers in formulas
    for (std::size_t i = 0; i < parts; ++i) part[i] = hn::Set(Tag(), value);
  }
  static HWY_INLINE Pack load(const double* from) {
    Pack result;
    for (std::size_t i = 0; i < parts; ++i) result.part[i] = hn::LoadU(Tag(), from + i * lanes);
    return result;
  }
  HWY_INLINE void store(double* to) const {
    for (std::size_t i = 0; i < parts; ++i) hn::StoreU(part[i], Tag(), to + i * lanes);
  }

#define STICKSLIP_UNARY(name, operation)                                               \
  friend HWY_INLINE Pack name(const Pack& a) {                                         \
    Pack result;                                                                       \
    for (std::size_t i = 0; i < parts; ++i) result.part[i] = hn::operation(a.part[i]); \
    return result;                                                                     \
  }
#define STICKSLIP_BINARY(type, name, operation)                                                   \
  friend HWY_INLINE type name(const Pack& a, const Pack& b) {                                     \
    type result;                                                                                  \
    for (std::size_t i = 0; i < parts; ++i) result.part[i] = hn::operation(a.part[i], b.part[i]); \
    return result;                                                                                \
  }
  STICKSLIP_UNARY(operator-, Neg)
  STICKSLIP_UNARY(abs, Abs)
  STICKSLIP_UNARY(sqrt, Sqrt)
  STICKSLIP_BINARY(Pack, operator+, Add)
  STICKSLIP_BINARY(Pack, operator-, Sub)
  STICKSLIP_BINARY(Pack, operator*, Mul)
  STICKSLIP_BINARY(Pack, operator/, Div)
  STICKSLIP_BINARY(Pack, min, Min)
  STICKSLIP_BINARY(Pack, max, Max)
  STICKSLIP_BINARY(Pack, copysign, CopySign)
  STICKSLIP_BINARY(Mask, operator<, Lt)
  STICKSLIP_BINARY(Mask, operator>, Gt)
  STICKSLIP_BINARY(Mask, operator<=, Le)
  STICKSLIP_BINARY(Mask, operator>=, Ge)
  STICKSLIP_BINARY(Mask, operator==, Eq)
  STICKSLIP_BINARY(Mask, operator!=, Ne)
#undef STICKSLIP_UNARY
#undef STICKSLIP_BINARY

  /// a b + c, and c - a b; with one rounding where the processor can
  friend HWY_INLINE Pack multiply_add(const Pack& a, const Pack& b, const Pack& c) {
    Pack result;
    for (std::size_t i = 0; i < parts; ++i) result.part[i] = hn::MulAdd(a.part[i], b.part[i], c.part[i]);
    return result;
  }
  friend HWY_INLINE Pack nfma(const Pack& a, const Pack& b, const Pack& c) {
    Pack result;
    for (std::size_t i = 0; i < parts; ++i) result.part[i] = hn::NegMulAdd(a.part[i], b.part[i], c.part[i]);
    return result;
  }
  friend HWY_INLINE Pack exp(const Pack& a) {
    Pack result;
    for (std::size_t i = 0; i < parts; ++i) result.part[i] = hn::Exp(Tag(), a.part[i]);
    return result;
  }
  friend HWY_INLINE Pack select(const Mask& mask, const Pack& yes, const Pack& no) {
    Pack result;
    for (std::size_t i = 0; i < parts; ++i) result.part[i] = hn::IfThenElse(mask.part[i], yes.part[i], no.part[i]);
    return result;
  }
  /// the value, or 0
  friend HWY_INLINE Pack where(const Mask& mask, const Pack& value) {
    Pack result;
    for (std::size_t i = 0; i < parts; ++i) result.part[i] = hn::IfThenElseZero(mask.part[i], value.part[i]);
    return result;
  }
  friend HWY_INLINE double sum(const Pack& a) {
    Vector total = a.part[0];
    for (std::size_t i = 1; i < parts; ++i) total = hn::Add(total, a.part[i]);
    return hn::GetLane(hn::SumOfLanes(Tag(), total));
  }
};

/// Places in arrays, side by side.
template <std::size_t parts>
struct Places {
  using Integers = hn::RebindToSigned<Tag>;
  using Mask = PackMask<parts>;

  hn::Vec<Integers> part[parts];

  static HWY_INLINE Places load(const std::int64_t* from) {
    Places result;
    for (std::size_t i = 0; i < parts; ++i) result.part[i] = hn::LoadU(Integers(), from + i * lanes);
    return result;
  }
  static HWY_INLINE Places counting(std::int64_t from) {
    Places result;
    for (std::size_t i = 0; i < parts; ++i)
      result.part[i] = hn::Iota(Integers(), from + static_cast<std::int64_t>(i * lanes));
    return result;
  }
  /// Further, where the mask says so.
  HWY_INLINE void step(const Mask& mask, std::int64_t by = 1) {
    for (std::size_t i = 0; i < parts; ++i)
      part[i] = hn::Add(part[i], hn::IfThenElseZero(hn::RebindMask(Integers(), mask.part[i]), hn::Set(Integers(), by)));
  }
  HWY_INLINE Pack<parts> gather(const double* from) const {
    Pack<parts> result;
    for (std::size_t i = 0; i < parts; ++i) result.part[i] = hn::GatherIndex(Tag(), from, part[i]);
    return result;
  }
  HWY_INLINE void scatter(const Pack<parts>& values, double* to) const {
    for (std::size_t i = 0; i < parts; ++i) hn::ScatterIndex(values.part[i], Tag(), to, part[i]);
  }
  friend HWY_INLINE Mask operator!=(const Places& a, const Places& b) {
    Mask result;
    for (std::size_t i = 0; i < parts; ++i) result.part[i] = hn::RebindMask(Tag(), hn::Ne(a.part[i], b.part[i]));
    return result;
  }
  friend HWY_INLINE Places select(const Mask& mask, const Places& yes, const Places& no) {
    Places result;
    for (std::size_t i = 0; i < parts; ++i)
      result.part[i] = hn::IfThenElse(hn::RebindMask(Integers(), mask.part[i]), yes.part[i], no.part[i]);
    return result;
  }
};

#define STICKSLIP_LANES_INLINE HWY_INLINE
#include "stickslip/lanes/kernel.inl"
#undef STICKSLIP_LANES_INLINE

}  // namespace stickslip::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
