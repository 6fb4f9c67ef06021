// Arrays of Eigen, and classes of immutable objects that are made from their inputs.
#pragma once

#include <pybind11/eigen.h>

#include <algorithm>
#include <stdexcept>
#include <string>
#include <vector>

#include "bindings.hpp"
#include "stickslip/structure/matrix.hpp"

namespace stickslip::python {

inline RealVector vector_from(const py::object& values, const std::string& name, const char* unit = nullptr) {
  const std::vector<double> numbers = to_vector(values, name, unit);
  return Eigen::Map<const RealVector>(numbers.data(), static_cast<Eigen::Index>(numbers.size()));
}

inline RealMatrix matrix_from(const py::object& values, const std::string& name, const char* unit = nullptr) {
  const Numbers numbers = to_numbers(values, name, unit);
  if (numbers.ndim() != 2)
    throw std::invalid_argument(name + " must be two-dimensional, got " + std::to_string(numbers.ndim()) +
                                (numbers.ndim() == 1 ? " dimension" : " dimensions"));
  RealMatrix matrix(numbers.shape(0), numbers.shape(1));
  for (Eigen::Index i = 0; i < matrix.rows(); ++i)
    for (Eigen::Index j = 0; j < matrix.cols(); ++j) matrix(i, j) = *numbers.data(i, j);
  return matrix;
}

/// A read-only copy.
template <class Values>
py::array array_from(const Values& values) {
  py::array array = py::cast(values);
  array.attr("setflags")(py::arg("write") = false);
  return array;
}

/// Numbers that compare and can be hashed.
template <class Values>
py::object plain(const Values& values) {
  if (values.size() == 0) return py::none();
  const py::list rows = py::cast(values).attr("tolist")();
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
