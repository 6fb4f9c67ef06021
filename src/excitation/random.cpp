#include "stickslip/excitation/random.hpp"

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstring>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "excitation/random.cpp"
#include "hwy/foreach_target.h"
#include "hwy/highway.h"
// After highway.h
#include "hwy/contrib/math/math-inl.h"

HWY_BEFORE_NAMESPACE();
namespace stickslip {
namespace HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

const hn::ScalableTag<double> real;
const hn::ScalableTag<std::uint64_t> wide;
const hn::ScalableTag<std::uint32_t> narrow;
using Real = hn::Vec<decltype(real)>;
using Wide = hn::Vec<decltype(wide)>;

constexpr std::size_t max_lanes = HWY_MAX_BYTES / sizeof(double);
constexpr std::size_t chunk_blocks = 256;
static_assert(std::endian::native == std::endian::little);        // rows are read as pairs of words and as single ones
using Words = std::uint64_t[2 * (chunk_blocks + 2 * max_lanes)];  // a block is two of these; the last step overshoots

/// Words of `blocks` blocks or a few more, in their order; a lane is a block.
HWY_ATTR void philox(const RandomStream& stream, std::uint32_t first_block, std::size_t blocks, Words& out) {
  const std::size_t lanes = hn::Lanes(wide);
  const auto product = [](Wide a, Wide b)
                           HWY_ATTR {  // of the low halves of the lanes: what is in the high ones does not matter
                             return hn::MulEven(hn::BitCast(narrow, a), hn::BitCast(narrow, b));
                           };
  const Wide m0 = hn::Set(wide, 0xD2511F53u), m1 = hn::Set(wide, 0xCD9E8D57u);
  const Wide low = hn::Set(wide, 0xFFFFFFFFu);
  struct {
    std::uint64_t low, high;
  } keys[10];
  auto k0 = static_cast<std::uint32_t>(stream.seed), k1 = static_cast<std::uint32_t>(stream.seed >> 32);
  for (auto& key : keys) {
    key = {k0, k1};
    k0 += 0x9E3779B9u;
    k1 += 0xBB67AE85u;
  }
  for (std::size_t done = 0; done < blocks; done += 2 * lanes) {
    const Wide block = hn::Add(hn::Iota(wide, 0), hn::Set(wide, first_block + done));
    // Two vectors of blocks, a and b: their chains of multiplications overlap in time.
    Wide a0 = block, b0 = hn::Add(block, hn::Set(wide, lanes));
    Wide a1 = hn::Set(wide, stream.purpose), b1 = a1;
    Wide a2 = hn::Set(wide, stream.member), b2 = a2;
    Wide a3 = hn::Set(wide, stream.member >> 32), b3 = a3;
    for (const auto& key : keys) {
      const Wide key0 = hn::Set(wide, key.low), key1 = hn::Set(wide, key.high);
      const Wide pa = product(a0, m0), qa = product(a2, m1), pb = product(b0, m0), qb = product(b2, m1);
      a0 = hn::Xor(hn::ShiftRight<32>(qa), hn::Xor(a1, key0));
      b0 = hn::Xor(hn::ShiftRight<32>(qb), hn::Xor(b1, key0));
      a2 = hn::Xor(hn::ShiftRight<32>(pa), hn::Xor(a3, key1));
      b2 = hn::Xor(hn::ShiftRight<32>(pb), hn::Xor(b3, key1));
      a1 = qa, a3 = pa, b1 = qb, b3 = pb;
    }
    const auto pair = [&](Wide x, Wide y) HWY_ATTR { return hn::Or(hn::And(x, low), hn::ShiftLeft<32>(y)); };
    hn::StoreInterleaved2(pair(a0, a1), pair(a2, a3), wide, out + 2 * done);
    hn::StoreInterleaved2(pair(b0, b1), pair(b2, b3), wide, out + 2 * (done + lanes));
  }
}

/// The bits as a number in [1, 2), those of the exponent being clear.
HWY_ATTR HWY_INLINE Real from_one_to_two(Wide bits) {
  return hn::BitCast(real, hn::Or(bits, hn::Set(wide, 0x3FF0000000000000u)));
}

HWY_ATTR HWY_INLINE Real uniform(Wide word) {
  return hn::Sub(from_one_to_two(hn::ShiftRight<12>(word)), hn::Set(real, 1 - 0x1p-53));
}

/// Cosine and sine of an angle on the circle: `angle` in the first eighth, three bits say in which of eight it is.
/// The polynomials are fdlibm's (Sun Microsystems, 1993), kernels of sine and cosine within pi/4, to 2^-58.
HWY_ATTR HWY_INLINE void on_the_circle(Real angle, Wide bits, Real& cosine, Real& sine) {
  const auto polynomial = [](Real z, double first, auto... others) HWY_ATTR {
    Real sum = hn::Set(real, first);
    ((sum = hn::MulAdd(sum, z, hn::Set(real, others))), ...);
    return sum;
  };
  const Real z = hn::Mul(angle, angle);
  const Real s =
      hn::MulAdd(hn::Mul(angle, z),
                 polynomial(z, 1.58969099521155010221e-10, -2.50507602534068634195e-08, 2.75573137070700676789e-06,
                            -1.98412698298579493134e-04, 8.33333333332248946124e-03, -1.66666666666666324348e-01),
                 angle);
  const Real c =
      polynomial(z, -1.13596475577881948265e-11, 2.08757232129817482790e-09, -2.75573143513906633035e-07,
                 2.48015872894767294178e-05, -1.38888888888741095749e-03, 4.16666666666666019037e-02, -0.5, 1.0);
  const auto swapped = hn::MaskFromVec(hn::BitCast(real, hn::Sub(hn::Zero(wide), hn::And(bits, hn::Set(wide, 1)))));
  const Wide sign = hn::Set(wide, 0x8000000000000000u);
  const auto flip = [](Real x, Wide by) HWY_ATTR { return hn::Xor(x, hn::BitCast(real, by)); };
  cosine = flip(hn::IfThenElse(swapped, s, c), hn::And(hn::ShiftLeft<62>(bits), sign));
  sine = flip(hn::IfThenElse(swapped, c, s), hn::And(hn::ShiftLeft<61>(bits), sign));
}

constexpr double eighth = 0.78539816339744830962;  // pi / 4

HWY_ATTR HWY_INLINE void phasor(const std::uint32_t* word, Real& cosine, Real& sine) {
  const hn::Rebind<std::uint32_t, decltype(wide)> half;
  const Wide bits = hn::PromoteTo(wide, hn::LoadU(half, word));
  // 29 bits of 32 make the angle, in the middle of its cell
  const Wide fraction = hn::Or(hn::ShiftLeft<23>(hn::ShiftRight<3>(bits)), hn::Set(wide, 1u << 22));
  const Real turn = hn::Sub(from_one_to_two(fraction), hn::Set(real, 1.0));
  on_the_circle(hn::Mul(turn, hn::Set(real, eighth)), bits, cosine, sine);
}

/// Fills `numbers`, `per_block` to a block, chunk by chunk: `step(words, i, to)` writes those from number i of the
/// chunk on, as many as a vector has lanes (`doubles` to a number).
template <class Step>
HWY_ATTR HWY_INLINE void fill(const RandomStream& stream, double* numbers, std::size_t count, std::size_t per_block,
                              std::size_t doubles, std::size_t per_step, Step step) {
  HWY_ALIGN Words words;
  HWY_ALIGN double rest[2 * max_lanes];
  std::uint32_t block = 0;
  while (count > 0) {
    const std::size_t size = std::min(count, chunk_blocks * per_block);
    philox(stream, block, (size + per_block - 1) / per_block, words);
    std::size_t i = 0;
    for (; i + per_step <= size; i += per_step) step(words, i, numbers + doubles * i);
    if (i < size) {  // the same instructions for the last ones, so that they have the same bits
      step(words, i, rest);
      std::copy_n(rest, doubles * (size - i), numbers + doubles * i);
    }
    numbers += doubles * size;
    count -= size;
    block += static_cast<std::uint32_t>(chunk_blocks);
  }
}

HWY_ATTR void fill_words(const RandomStream& stream, std::uint32_t first_block, std::span<std::uint32_t> out) {
  HWY_ALIGN Words words;
  while (!out.empty()) {
    const std::size_t size = std::min(out.size(), 4 * chunk_blocks);
    philox(stream, first_block, (size + 3) / 4, words);
    std::memcpy(out.data(), words, size * sizeof(std::uint32_t));
    out = out.subspan(size);
    first_block += static_cast<std::uint32_t>(chunk_blocks);
  }
}

HWY_ATTR void fill_uniforms(const RandomStream& stream, std::span<double> numbers) {
  fill(stream, numbers.data(), numbers.size(), 2, 1, hn::Lanes(real),
       [](const Words& words, std::size_t i, double* to)
           HWY_ATTR { hn::StoreU(uniform(hn::LoadU(wide, words + i)), real, to); });
}

HWY_ATTR void fill_exponentials(const RandomStream& stream, std::span<double> numbers) {
  fill(stream, numbers.data(), numbers.size(), 2, 1, hn::Lanes(real),
       [](const Words& words, std::size_t i, double* to)
           HWY_ATTR { hn::StoreU(hn::Neg(hn::Log(real, uniform(hn::LoadU(wide, words + i)))), real, to); });
}

HWY_ATTR void fill_normals(const RandomStream& stream, std::span<double> numbers) {
  fill(stream, numbers.data(), numbers.size(), 2, 1, 2 * hn::Lanes(real),
       [](const Words& words, std::size_t i, double* to) HWY_ATTR {
         Wide first, second;
         hn::LoadInterleaved2(wide, words + i, first, second);
         // The twelve bits of a word that a uniform number leaves unused choose the eighth of the circle.
         Real cosine, sine;
         on_the_circle(hn::Mul(uniform(second), hn::Set(real, eighth)), second, cosine, sine);
         const Real radius = hn::Sqrt(hn::Mul(hn::Set(real, -2.0), hn::Log(real, uniform(first))));
         hn::StoreInterleaved2(hn::Mul(radius, cosine), hn::Mul(radius, sine), real, to);  // thesis (5.57), (5.58)
       });
}

HWY_ATTR void fill_phasors(const RandomStream& stream, std::span<std::complex<double>> numbers) {
  // [complex.numbers]: an array of complex numbers is one of pairs of doubles
  fill(stream, reinterpret_cast<double*>(numbers.data()), numbers.size(), 4, 2, hn::Lanes(real),
       [](const Words& words, std::size_t i, double* to) HWY_ATTR {
         Real cosine, sine;
         phasor(reinterpret_cast<const std::uint32_t*>(words) + i, cosine, sine);
         hn::StoreInterleaved2(cosine, sine, real, to);
       });
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace stickslip
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace stickslip {

HWY_EXPORT(fill_words);
HWY_EXPORT(fill_uniforms);
HWY_EXPORT(fill_exponentials);
HWY_EXPORT(fill_normals);
HWY_EXPORT(fill_phasors);

void random_words(const RandomStream& stream, std::uint32_t first_block, std::span<std::uint32_t> words) {
  HWY_DYNAMIC_DISPATCH(fill_words)(stream, first_block, words);
}
void uniforms(const RandomStream& stream, std::span<double> numbers) {
  HWY_DYNAMIC_DISPATCH(fill_uniforms)(stream, numbers);
}
void exponentials(const RandomStream& stream, std::span<double> numbers) {
  HWY_DYNAMIC_DISPATCH(fill_exponentials)(stream, numbers);
}
void normals(const RandomStream& stream, std::span<double> numbers) {
  HWY_DYNAMIC_DISPATCH(fill_normals)(stream, numbers);
}
void phasors(const RandomStream& stream, std::span<std::complex<double>> numbers) {
  HWY_DYNAMIC_DISPATCH(fill_phasors)(stream, numbers);
}

}  // namespace stickslip
#endif  // HWY_ONCE
