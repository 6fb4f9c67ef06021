// A friction law whose levels are functions of Python, or compiled functions that Python knows.
#pragma once

#include <memory>

#include <pybind11/pybind11.h>

#include "stickslip/friction/function_law.hpp"

namespace stickslip::python {

namespace py = pybind11;

/// The Python class Law: the functions of a FunctionLaw.
class CallableLaw {
 public:
  /// @param hold    of (x, direction), or None
  /// @param resist  of (x, speed, direction)
  CallableLaw(py::object hold, py::object resist);

  py::object hold_function() const;
  py::object resist_function() const;

  /// The law of these functions; its `resist_function` is a copy of this object.
  FunctionLaw law() const;

  double operator()(double x, double speed, Direction direction) const;  // `resist`

 private:
  struct Function;
  struct Functions;

  std::shared_ptr<const Functions> functions_;
};

}  // namespace stickslip::python
