// The parts of an object, listed once: their names, symbols, units and ranges.
#pragma once

#include <cmath>
#include <concepts>
#include <functional>
#include <limits>
#include <string>
#include <tuple>

#include "stickslip/base/error.hpp"
#include "stickslip/base/requirements.hpp"

namespace stickslip {

/// The numbers that a part may be.
struct Range {
  double low = -std::numeric_limits<double>::infinity(), high = std::numeric_limits<double>::infinity();
  bool open = false;     ///< `low` itself is not in the range
  bool infinite = true;  ///< infinite numbers are

  static constexpr Range at_least(double low) { return {.low = low, .infinite = false}; }
  static constexpr Range above(double low) { return {.low = low, .open = true, .infinite = false}; }
  static constexpr Range between(double low, double high) { return {.low = low, .high = high}; }
  constexpr Range or_infinite() const { return {low, high, open, true}; }

  bool contains(double value) const noexcept {
    return (open ? value > low : value >= low) && value <= high && (infinite || std::isfinite(value));
  }
  /// Such as "finite and at least 0".
  std::string rule() const {
    const std::string from = detail::shortest(low);
    if (std::isfinite(high)) return "from " + from + " to " + detail::shortest(high);
    if (open && low >= 0 && low <= 0) return infinite ? "positive" : "positive and finite";
    return (infinite ? "" : "finite and ") + std::string(open ? "above " : "at least ") + from;
  }
};

enum class Listed { always, unless_zero };

/// A part of an object: a data member or a getter, and what descriptions say of it.
template <class Get>
struct Part {
  constexpr Part(const char* of_part, Get from, const char* in_equations = "", const char* of_numbers = "",
                 Range allowed = {}, Listed when = Listed::always)
      : name(of_part), get(from), symbol(in_equations), unit(of_numbers), range(allowed), listed(when) {}

  const char* name;
  Get get;
  const char* symbol;  ///< as in the equation of the class; may be empty
  const char* unit;    ///< empty for a pure number
  Range range;         ///< of a number, or of each number of a list
  Listed listed;       ///< whether descriptions leave it out while it is zero
};

/// A class that lists its parts, in the order of the arguments of its constructor:
///     static constexpr auto parts() { return std::tuple(Part{"rate", &Liner::rate, "r", "s/m", Range::at_least(0)}); }
/// A friction law with a `class_name` and with parts has JSON, an identity, equality, a hash, pickles and a repr.
template <class T>
concept WithParts = requires {
  T::parts();
};

namespace detail {

/// Throw unless each number of an object is in its range.
/// @param who  begins the message
/// @throws std::invalid_argument naming the value
template <WithParts T>
void check_parts(const T& of, const char* who) {
  const auto check = [&](const auto& part) {
    const auto& value = std::invoke(part.get, of);
    using Value = std::remove_cvref_t<decltype(value)>;
    if constexpr (std::convertible_to<Value, double>) {
      if (!part.range.contains(value)) [[unlikely]]
        refuse(std::string(who) + ": " + part.name + " must be " + (std::integral<Value> ? "a whole number " : "") +
                   part.range.rule(),
               value, part.unit);
    }
  };
  static constexpr auto all = T::parts();
  std::apply([&](const auto&... part) { (check(part), ...); }, all);
}

}  // namespace detail
}  // namespace stickslip
