// Arrays of numbers as texts for files: what `repr` gives, but many times as fast.
#include <array>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <string>
#include <string_view>

#include "bindings.hpp"

namespace stickslip::python {
namespace {

using Doubles = py::array_t<double, py::array::c_style | py::array::forcecast>;

/// The text of a double as Python writes it: the shortest that reads back to the same double.
class NumberText {
 public:
  template <class Double>  // so that the branch not taken is not compiled
  std::string_view of(Double value) {
    if constexpr (requires(char* text) { std::to_chars(text, text, value, std::chars_format::fixed); }) {
      if (!std::isfinite(value)) return std::isnan(value) ? "nan" : value < 0 ? "-inf" : "inf";
      const double size = std::abs(value);
      const bool fixed = size == 0 || (size >= 1e-4 && size < 1e16);
      char* const begin = text_.data();
      char* end = std::to_chars(begin, begin + text_.size(), value,
                                fixed ? std::chars_format::fixed : std::chars_format::scientific)
                      .ptr;
      const std::string_view text(begin, static_cast<std::size_t>(end - begin));
      if (fixed && text.find('.') == std::string_view::npos) {
        *end++ = '.';
        *end++ = '0';
      }
      return {begin, static_cast<std::size_t>(end - begin)};
    } else {  // older versions of libc++
      char* const printed = PyOS_double_to_string(value, 'r', 0, Py_DTSF_ADD_DOT_0, nullptr);
      if (printed == nullptr) throw py::error_already_set();
      const std::string text(printed);
      PyMem_Free(printed);
      return {text_.data(), text.copy(text_.data(), text_.size())};
    }
  }

 private:
  std::array<char, 64> text_;
};

py::list texts_of(const Doubles& values) {
  NumberText text;
  py::list texts(values.size());
  for (py::ssize_t i = 0; i < values.size(); ++i) {
    const std::string_view one = text.of(values.data()[i]);
    PyList_SET_ITEM(texts.ptr(), i, py::str(one.data(), one.size()).release().ptr());
  }
  return texts;
}

std::string json_of(const Doubles& values) {
  NumberText text;
  std::string list = "[";
  list.reserve(static_cast<std::size_t>(values.size()) * 20 + 2);
  for (py::ssize_t i = 0; i < values.size(); ++i) {
    if (i > 0) list += ", ";
    const double value = values.data()[i];
    list += std::isfinite(value) ? text.of(value) : std::string_view("null");
  }
  return list + "]";
}

}  // namespace

void bind_number_texts(py::module_& m) {
  m.def("number_texts", &texts_of, py::arg("values"), "The doubles of an array as `repr` writes them.");
  m.def("number_list", &json_of, py::arg("values"),
        "The doubles of an array as a list of JSON: as `repr` writes them, null for NaN and infinity.");
}

}  // namespace stickslip::python
