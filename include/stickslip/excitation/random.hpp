// Random numbers that have names instead of a state.
#pragma once

#include <complex>
#include <cstdint>
#include <span>

#include "stickslip/detail/requirements.hpp"

namespace stickslip {

/// One of the endless rows of random numbers, named: Philox4x32-10 with
///     key = seed,  counter = (block, purpose, member low, member high).
///
/// A number is a function of the row's name and its place alone: not of how many are asked for, nor of the thread, the
/// process or what was drawn before. Uniform numbers and words have the same bits everywhere; what is computed from
/// them (logarithms, sines) the same on processors of the same instruction set, and elsewhere the same to round-off.
///
/// A row has 2^32 blocks of four 32-bit words (2^33 uniform numbers); it then begins again.
///
/// Reference: J. K. Salmon, M. A. Moraes, R. O. Dror, D. E. Shaw, Parallel random numbers: as easy as 1, 2, 3,
/// SC11 (2011), doi:10.1145/2063384.2063405.
struct RandomStream {
  std::uint64_t seed = 0;
  std::uint64_t member = 0;
  std::uint32_t purpose = 0;  ///< what the numbers are for: two rows used together must differ in it
};

/// The row's words from word 0 of block `first_block` on. Cost: 0.8 ns each (AVX2, 2.4 GHz).
void random_words(const RandomStream& stream, std::uint32_t first_block, std::span<std::uint32_t> words);

/// Uniform in (0, 1), never 0 nor 1: the odd multiples of 2^-53, so that u and 1 - u are equally likely. Number i takes
/// words 2i and 2i + 1 of the row.
void uniforms(const RandomStream& stream, std::span<double> numbers);

/// Exponential with mean 1: -log of the uniform number i, to 4 units in the last place; at most 37.
void exponentials(const RandomStream& stream, std::span<double> numbers);

/// Gaussian with mean 0 and variance 1, by Box and Muller, thesis (5.57), (5.58): numbers 2j and 2j + 1 are the cosine
/// and the sine of one angle, from block j. At most 8.6 in magnitude.
void normals(const RandomStream& stream, std::span<double> numbers);

/// e^{i phi}, phi uniform on the circle (2^32 angles, evenly spaced), to 3e-16. Number i takes word i of the row.
void phasors(const RandomStream& stream, std::span<std::complex<double>> numbers);

}  // namespace stickslip
