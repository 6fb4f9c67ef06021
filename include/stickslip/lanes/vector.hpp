// Vectors of doubles, from the vector extensions of the compiler, so that formulas read like the equations. Operations
// apply to each lane.
//
// There is one vector type for each instruction set. All code that uses its operations, also a user-defined law, must
// be inlined into one function that is compiled for that set, [[gnu::target(...), gnu::flatten]]; the code is written
// once.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>

#include "stickslip/series/series.hpp"

#ifdef __GNUC__  // also Clang; other compilers do not use lanes
#define STICKSLIP_VECTORS

namespace stickslip::detail {

#define STICKSLIP_VECTOR BaselineVector
#define STICKSLIP_VECTOR_SIZE 2
#define STICKSLIP_VECTOR_TARGET
#define STICKSLIP_VECTOR_FMA(a, b, c) (a * b + c)
#define STICKSLIP_VECTOR_BITS(lanes) ((lanes[0] & 1) | (lanes[1] & 2))
#include "stickslip/lanes/vector.inl"

// With sanitizers, flattened functions take minutes to compile; Clang flattens one level only.
#ifdef __SANITIZE_ADDRESS__
#define STICKSLIP_FLATTEN
#else
#define STICKSLIP_FLATTEN [[gnu::flatten]]
#endif
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && !defined(__SANITIZE_ADDRESS__)
#define STICKSLIP_AVX2
#define STICKSLIP_VECTOR Avx2Vector
#define STICKSLIP_VECTOR_SIZE 4
#define STICKSLIP_VECTOR_TARGET [[gnu::target("avx2,fma")]]
#define STICKSLIP_VECTOR_FMA(a, b, c) __builtin_ia32_vfmaddpd256(a, b, c)
#define STICKSLIP_VECTOR_BITS(lanes) __builtin_ia32_movmskpd256(Doubles(lanes))
#include "stickslip/lanes/vector.inl"
#endif

}  // namespace stickslip::detail
#endif
