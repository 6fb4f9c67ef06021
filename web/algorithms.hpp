// What Debian's Emscripten lacks of C++20's library, included before every source: its libc++ has no algorithms over
// ranges and no std::bit_cast.
#pragma once

#include <algorithm>
#include <iterator>
#include <version>

#if !defined(__cpp_lib_ranges)
namespace std::ranges {  // NOLINT: on behalf of the library

template <class Range, class Rule>
bool all_of(const Range& range, Rule rule) {
  return std::all_of(std::begin(range), std::end(range), rule);
}
template <class Range, class Rule>
bool any_of(const Range& range, Rule rule) {
  return std::any_of(std::begin(range), std::end(range), rule);
}
template <class Range, class Rule>
auto count_if(const Range& range, Rule rule) {
  return std::count_if(std::begin(range), std::end(range), rule);
}
template <class Range, class Value>
auto find(Range&& range, const Value& value) {
  return std::find(std::begin(range), std::end(range), value);
}
template <class Range, class Rule>
auto find_if(Range&& range, Rule rule) {
  return std::find_if(std::begin(range), std::end(range), rule);
}
template <class Range>
auto max_element(Range&& range) {
  return std::max_element(std::begin(range), std::end(range));
}
template <class Range, class Value>
void replace(Range& range, const Value& from, const Value& to) {
  std::replace(std::begin(range), std::end(range), from, to);
}
template <class One, class Other, class Same>
bool equal(const One& one, const Other& other, Same same) {
  return std::equal(std::begin(one), std::end(one), std::begin(other), std::end(other), same);
}
template <class Range, class To, class Change>
void transform(const Range& range, To to, Change change) {
  std::transform(std::begin(range), std::end(range), to, change);
}
template <class Range, class Value>
auto upper_bound(const Range& range, const Value& value) {
  return std::upper_bound(std::begin(range), std::end(range), value);
}

}  // namespace std::ranges
#endif

#if !defined(__cpp_lib_bit_cast)
namespace std {

template <class To, class From>
constexpr To bit_cast(const From& from) noexcept {
  static_assert(sizeof(To) == sizeof(From));
  return __builtin_bit_cast(To, from);
}

}  // namespace std
#endif
