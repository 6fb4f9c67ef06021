// Structured arrays: a row for each of several things.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>

#include "bindings.hpp"

namespace stickslip::python {

/// A text in a row.
/// @tparam size  at least that of the longest one
template <std::size_t size>
struct TextField {
  char32_t characters[size]{};

  TextField() = default;
  TextField(std::u32string_view text) { std::ranges::copy(text.substr(0, size), characters); }
  TextField(const char32_t* text) : TextField(std::u32string_view(text)) {}
};

/// How NumPy calls the type of a field.
template <class Value>
std::string format_of() {
  if constexpr (std::is_same_v<Value, double>)
    return "f8";
  else if constexpr (std::is_same_v<Value, Vector2>)
    return "(2,)f8";
  else if constexpr (std::is_same_v<Value, bool>)
    return "?";
  else if constexpr (std::is_same_v<Value, std::int64_t>)
    return "i8";
  else
    return "U" + std::to_string(sizeof(Value) / sizeof(char32_t));
}

/// A structured array with the rows `row(i)` from 0 to the one before `count`.
/// @param fields  pairs of the name and the member of a row
template <class MakeRow, class... Members>
py::array structured(std::size_t count, MakeRow&& row, const std::pair<const char*, Members>&... fields) {
  using Row = std::remove_cvref_t<std::invoke_result_t<MakeRow, std::size_t>>;
  const Row probe{};
  py::list names, formats, offsets;
  const auto add = [&]<class Member>(const char* name, Member member) {
    using Value = std::remove_cvref_t<decltype(probe.*member)>;
    names.append(name);
    formats.append(format_of<Value>());
    offsets.append(reinterpret_cast<const std::byte*>(&(probe.*member)) - reinterpret_cast<const std::byte*>(&probe));
  };
  (add(fields.first, fields.second), ...);
  py::dict layout;
  layout["names"] = names;
  layout["formats"] = formats;
  layout["offsets"] = offsets;
  layout["itemsize"] = sizeof(Row);
  py::array rows(py::dtype::from_args(layout), static_cast<py::ssize_t>(count));
  auto* next = static_cast<Row*>(rows.mutable_data());
  for (std::size_t i = 0; i < count; ++i) next[i] = row(i);
  return rows;
}

}  // namespace stickslip::python
