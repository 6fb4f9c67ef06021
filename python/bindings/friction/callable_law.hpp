// A friction law whose levels are functions of Python, or compiled functions that Python knows.
#pragma once

#include <memory>

#include <pybind11/pybind11.h>

#include "stickslip/friction/law.hpp"

namespace stickslip::python {

namespace py = pybind11;

/// The Python class Law.
class CallableLaw {
 public:
  static constexpr bool numeric = true;

  /// @param hold    of (x, direction), or None
  /// @param resist  of (x, speed, direction)
  CallableLaw(py::object hold, py::object resist);

  py::object hold_function() const;
  py::object resist_function() const;

  // Out of line: inlined into the event loop, calls of Python would take a compiler many minutes.
  double resist(double x, double speed, Direction direction) const;
  double hold(double x, Direction direction) const;

 private:
  struct Function;
  struct Functions;

  std::shared_ptr<const Functions> functions_;
};

}  // namespace stickslip::python
