// Included once for each instruction set, by vector.hpp, which defines
//   STICKSLIP_VECTOR       the name
//   STICKSLIP_VECTOR_SIZE  number of doubles per instruction
//   STICKSLIP_VECTOR_TARGET  the attribute of its functions
//   STICKSLIP_VECTOR_FMA     a b + c, with one rounding if the processor supports it
//   STICKSLIP_VECTOR_BITS  one bit per lane of a vector of integers in which all bits or none are set
// Only the code in this file is compiled for that set.

/// Two vectors of the processor, because one instruction often waits for another. User-defined copy functions make the
/// compiler pass them in memory, in the same way for all instruction sets.
struct STICKSLIP_VECTOR {
  static constexpr std::size_t part_size = STICKSLIP_VECTOR_SIZE, size = 2 * part_size;
  typedef double Doubles __attribute__((vector_size(sizeof(double) * part_size)));
  typedef long long Integers __attribute__((vector_size(sizeof(double) * part_size)));

  struct Mask {
    Integers low, high;  // all bits or none, per lane

    STICKSLIP_VECTOR_TARGET Mask() noexcept : low{}, high{} {}
    STICKSLIP_VECTOR_TARGET Mask(const Integers& first, const Integers& second) noexcept : low(first), high(second) {}
    STICKSLIP_VECTOR_TARGET Mask(const Mask& a) noexcept : low(a.low), high(a.high) {}
    STICKSLIP_VECTOR_TARGET Mask& operator=(const Mask& a) noexcept {
      low = a.low;
      high = a.high;
      return *this;
    }
    STICKSLIP_VECTOR_TARGET friend Mask operator&(const Mask& a, const Mask& b) noexcept {
      return {a.low & b.low, a.high & b.high};
    }
    STICKSLIP_VECTOR_TARGET friend Mask operator|(const Mask& a, const Mask& b) noexcept {
      return {a.low | b.low, a.high | b.high};
    }
    STICKSLIP_VECTOR_TARGET friend Mask operator^(const Mask& a, const Mask& b) noexcept {
      return {a.low ^ b.low, a.high ^ b.high};
    }
    STICKSLIP_VECTOR_TARGET friend Mask operator~(const Mask& a) noexcept { return {~a.low, ~a.high}; }
    /// One bit per lane.
    STICKSLIP_VECTOR_TARGET friend std::uint64_t bits(const Mask& a) noexcept {
      return static_cast<std::uint64_t>(STICKSLIP_VECTOR_BITS(a.low)) |
             static_cast<std::uint64_t>(STICKSLIP_VECTOR_BITS(a.high)) << part_size;
    }
    STICKSLIP_VECTOR_TARGET friend bool any(const Mask& a) noexcept { return bits(a) != 0; }
    STICKSLIP_VECTOR_TARGET friend bool all(const Mask& a) noexcept {
      return bits(a) == (std::uint64_t{1} << size) - 1;
    }
  };

  Doubles low, high;

  STICKSLIP_VECTOR_TARGET STICKSLIP_VECTOR() noexcept {}
  STICKSLIP_VECTOR_TARGET STICKSLIP_VECTOR(double a) noexcept
      : low(Doubles{} + a), high(low) {}  // NOLINT(google-explicit-constructor)
  STICKSLIP_VECTOR_TARGET STICKSLIP_VECTOR(const Doubles& first, const Doubles& second) noexcept
      : low(first), high(second) {}
  STICKSLIP_VECTOR_TARGET STICKSLIP_VECTOR(const STICKSLIP_VECTOR& a) noexcept : low(a.low), high(a.high) {}
  STICKSLIP_VECTOR_TARGET STICKSLIP_VECTOR& operator=(const STICKSLIP_VECTOR& a) noexcept {
    low = a.low;
    high = a.high;
    return *this;
  }

  STICKSLIP_VECTOR_TARGET static STICKSLIP_VECTOR load(const double* from) noexcept {
    STICKSLIP_VECTOR result;
    std::memcpy(&result.low, from, sizeof result.low);
    std::memcpy(&result.high, from + part_size, sizeof result.high);
    return result;
  }
  STICKSLIP_VECTOR_TARGET void store(double* to) const noexcept {
    std::memcpy(to, &low, sizeof low);
    std::memcpy(to + part_size, &high, sizeof high);
  }

#define STICKSLIP_BINARY(type, operation)                                                      \
  STICKSLIP_VECTOR_TARGET friend type operator operation(const STICKSLIP_VECTOR& a,            \
                                                         const STICKSLIP_VECTOR& b) noexcept { \
    return {a.low operation b.low, a.high operation b.high};                                   \
  }
  STICKSLIP_BINARY(STICKSLIP_VECTOR, +)
  STICKSLIP_BINARY(STICKSLIP_VECTOR, -)
  STICKSLIP_BINARY(STICKSLIP_VECTOR, *)
  STICKSLIP_BINARY(STICKSLIP_VECTOR, /)
  STICKSLIP_BINARY(Mask, <)
  STICKSLIP_BINARY(Mask, >)
  STICKSLIP_BINARY(Mask, <=)
  STICKSLIP_BINARY(Mask, >=)
  STICKSLIP_BINARY(Mask, ==)
#undef STICKSLIP_BINARY
  STICKSLIP_VECTOR_TARGET friend STICKSLIP_VECTOR operator-(const STICKSLIP_VECTOR& a) noexcept {
    return {-a.low, -a.high};
  }
  STICKSLIP_VECTOR_TARGET STICKSLIP_VECTOR& operator+=(const STICKSLIP_VECTOR& a) noexcept {
    low += a.low;
    high += a.high;
    return *this;
  }
  STICKSLIP_VECTOR_TARGET STICKSLIP_VECTOR& operator-=(const STICKSLIP_VECTOR& a) noexcept {
    low -= a.low;
    high -= a.high;
    return *this;
  }

  STICKSLIP_VECTOR_TARGET friend STICKSLIP_VECTOR multiply_add(const STICKSLIP_VECTOR& a, const STICKSLIP_VECTOR& b,
                                                               const STICKSLIP_VECTOR& c) noexcept {
    return {STICKSLIP_VECTOR_FMA(a.low, b.low, c.low), STICKSLIP_VECTOR_FMA(a.high, b.high, c.high)};
  }
  STICKSLIP_VECTOR_TARGET friend STICKSLIP_VECTOR select(const Mask& mask, const STICKSLIP_VECTOR& yes,
                                                         const STICKSLIP_VECTOR& no) noexcept {
    return {mask.low ? yes.low : no.low, mask.high ? yes.high : no.high};
  }
  STICKSLIP_VECTOR_TARGET friend STICKSLIP_VECTOR min(const STICKSLIP_VECTOR& a, const STICKSLIP_VECTOR& b) noexcept {
    return {a.low < b.low ? a.low : b.low, a.high < b.high ? a.high : b.high};
  }
  STICKSLIP_VECTOR_TARGET friend STICKSLIP_VECTOR max(const STICKSLIP_VECTOR& a, const STICKSLIP_VECTOR& b) noexcept {
    return {a.low > b.low ? a.low : b.low, a.high > b.high ? a.high : b.high};
  }
  STICKSLIP_VECTOR_TARGET friend STICKSLIP_VECTOR abs(const STICKSLIP_VECTOR& a) noexcept {
    return {Doubles(Integers(a.low) & INT64_MAX), Doubles(Integers(a.high) & INT64_MAX)};
  }

  /// Applies a function of doubles to each lane.
  template <class Function>
  STICKSLIP_VECTOR_TARGET friend STICKSLIP_VECTOR each_lane(const STICKSLIP_VECTOR& a, Function function) {
    STICKSLIP_VECTOR result;
    for (std::size_t i = 0; i < part_size; ++i) {
      result.low[i] = function(a.low[i]);
      result.high[i] = function(a.high[i]);
    }
    return result;
  }
#define STICKSLIP_FUNCTION(name)                                                             \
  STICKSLIP_VECTOR_TARGET friend STICKSLIP_VECTOR name(const STICKSLIP_VECTOR& a) noexcept { \
    return each_lane(a, [](double x) noexcept { return std::name(x); });                     \
  }
  STICKSLIP_FUNCTION(exp)
  STICKSLIP_FUNCTION(log)
  STICKSLIP_FUNCTION(sqrt)
  STICKSLIP_FUNCTION(sin)
  STICKSLIP_FUNCTION(cos)
  STICKSLIP_FUNCTION(sinh)
  STICKSLIP_FUNCTION(cosh)
  STICKSLIP_FUNCTION(tanh)
#undef STICKSLIP_FUNCTION
  STICKSLIP_VECTOR_TARGET friend STICKSLIP_VECTOR pow(const STICKSLIP_VECTOR& a, double exponent) noexcept {
    return each_lane(a, [exponent](double x) noexcept { return std::pow(x, exponent); });
  }
  STICKSLIP_VECTOR_TARGET friend STICKSLIP_VECTOR decaying(const STICKSLIP_VECTOR& a, double first,
                                                           double last) noexcept {
    return each_lane(a, [first, last](double x) noexcept { return stickslip::decaying(x, first, last); });
  }
  STICKSLIP_VECTOR_TARGET friend SechTanh<STICKSLIP_VECTOR> sech_tanh(const STICKSLIP_VECTOR& a) noexcept {
    const STICKSLIP_VECTOR e = exp(-abs(a)), share = 1.0 / (e * e + 1.0), tanh = (1.0 - e * e) * share;
    return {2.0 * e * share, select(a < 0.0, -tanh, tanh)};
  }
  STICKSLIP_VECTOR_TARGET friend STICKSLIP_VECTOR sech(const STICKSLIP_VECTOR& a) noexcept { return sech_tanh(a).sech; }
};
#undef STICKSLIP_VECTOR
#undef STICKSLIP_VECTOR_SIZE
#undef STICKSLIP_VECTOR_TARGET
#undef STICKSLIP_VECTOR_FMA
#undef STICKSLIP_VECTOR_BITS
