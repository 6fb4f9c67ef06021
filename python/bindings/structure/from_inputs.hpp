// Matrices from and to NumPy, and classes of immutable objects that are made from their inputs.
#pragma once

#include <pybind11/numpy.h>

#include <algorithm>
#include <stdexcept>
#include <string>
#include <vector>

#include "bindings.hpp"
#include "stickslip/structure/matrix.hpp"

namespace stickslip::python {

inline RealMatrix matrix_from(const py::object& values, const std::string& name, const char* unit = nullptr) {
  const Numbers numbers = to_numbers(values, name, unit);
  if (numbers.ndim() != 2)
    throw std::invalid_argument(name + " must be two-dimensional, got " + std::to_string(numbers.ndim()) +
                                (numbers.ndim() == 1 ? " dimension" : " dimensions"));
  RealMatrix matrix(numbers.shape(0), numbers.shape(1));
  for (py::ssize_t i = 0; i < matrix.rows(); ++i)
    for (py::ssize_t j = 0; j < matrix.cols(); ++j) matrix(i, j) = *numbers.data(i, j);
  return matrix;
}

/// A read-only array over a matrix, which `owner` keeps alive.
inline py::array view(const RealMatrix& values, py::handle owner) {
  constexpr auto item = static_cast<py::ssize_t>(sizeof(double));
  py::array array(py::dtype::of<double>(), std::vector<py::ssize_t>{values.rows(), values.cols()},
                  std::vector<py::ssize_t>{item, item * values.rows()}, values.data(), owner);
  array.attr("setflags")(py::arg("write") = false);
  return array;
}

/// A read-only copy: NumPy makes one where nobody keeps the values.
template <class Values>
py::array array_from(const Values& values) {
  return view(values, py::handle());
}

/// Numbers that compare and can be hashed.
template <class Values>
py::object plain(const Values& values) {
  if (values.size() == 0) return py::none();
  const py::list rows = array_from(values).attr("tolist")();
  py::list plain;
  for (const py::handle row : rows)
    plain.append(py::isinstance<py::list>(row) ? py::object(py::tuple(py::reinterpret_borrow<py::object>(row)))
                                               : py::reinterpret_borrow<py::object>(row));
  return py::tuple(plain);
}

/// A class of immutable objects that are made from `inputs(object)` by `make(inputs)`: they compare and hash by them,
/// and can be copied and pickled.
template <class T, class Inputs, class Make>
py::class_<T> made_from_inputs(py::module_& m, const char* name, std::string doc, Inputs inputs, Make make) {
  doc.insert(std::min(doc.find("\n\n"), doc.size()),
             "\n\nObjects compare by content; they can be hashed, copied and pickled.");
  py::class_<T> type(m, name, doc.c_str());
  type.def(
          "__eq__",
          [inputs](const T& self, const py::object& other) -> py::object {
            if (!py::isinstance<T>(other)) return py::reinterpret_borrow<py::object>(Py_NotImplemented);
            return py::bool_(inputs(self).equal(inputs(other.cast<const T&>())));
          },
          py::is_operator())
      .def("__hash__", [inputs](const T& self) { return py::hash(inputs(self)); })
      .def(py::pickle(inputs, make));
  return type;
}

}  // namespace stickslip::python
