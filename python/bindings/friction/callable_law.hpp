// A friction law whose levels are functions of Python, or compiled functions that Python knows.
#pragma once

#include <cmath>
#include <memory>
#include <string>
#include <utility>

#include <pybind11/pybind11.h>

#include "stickslip/error.hpp"
#include "stickslip/friction/law.hpp"

namespace stickslip::python {

namespace py = pybind11;

/// The Python class Law.
class CallableLaw {
 public:
  static constexpr bool numeric = true;

  /// @param hold    of (x, direction), or None
  /// @param resist  of (x, speed, direction)
  CallableLaw(py::object hold, py::object resist)
      : functions_(new Functions{{std::move(hold), "hold", 2}, {std::move(resist), "resist", 3}}, [](Functions* all) {
          const py::gil_scoped_acquire locked;
          delete all;
        }) {}

  py::object hold_function() const { return functions_->hold.object; }
  py::object resist_function() const { return functions_->resist.object; }

  double resist(double x, Direction direction, double speed) const {
    const Function& f = functions_->resist;
    return f.checked(f.compiled3 ? f.compiled3(x, speed, sign(direction)) : f.call(x, speed, sign(direction)), x,
                     speed);
  }
  double hold(double x, Direction direction) const {
    const Function& f = functions_->hold;
    if (f.missing) return resist(x, direction, 0);
    return f.checked(f.compiled2 ? f.compiled2(x, sign(direction)) : f.call(x, sign(direction)), x, 0);
  }

 private:
  struct Function {
    py::object object;
    const char* name;
    bool missing = false;
    double (*compiled2)(double, double) = nullptr;
    double (*compiled3)(double, double, double) = nullptr;

    Function(py::object given, const char* what, int arguments) : object(std::move(given)), name(what) {
      missing = object.is_none();
      if (missing) return;
      if (!PyCallable_Check(object.ptr()))
        throw py::type_error(std::string("Law: ") + name + " must be a function, got " +
                             py::type::of(object).attr("__name__").cast<std::string>());
      if (!py::hasattr(object, "address") || !py::hasattr(object, "ctypes")) return;
      // As numba.cfunc makes them.
      const py::object c_double = py::module_::import("ctypes").attr("c_double"), prototype = object.attr("ctypes");
      const py::tuple types = prototype.attr("argtypes");
      bool fits = static_cast<int>(types.size()) == arguments && prototype.attr("restype").is(c_double);
      for (const py::handle type : types) fits = fits && type.is(c_double);
      if (!fits)
        throw py::type_error(std::string("Law: the compiled function ") + name + " must take " +
                             std::to_string(arguments) + " numbers and return one, all float64");
      const auto address = object.attr("address").cast<std::uintptr_t>();
      if (arguments == 2)
        compiled2 = reinterpret_cast<double (*)(double, double)>(address);
      else
        compiled3 = reinterpret_cast<double (*)(double, double, double)>(address);
    }

    template <class... Numbers>
    double call(Numbers... numbers) const {
      const py::gil_scoped_acquire locked;
      const py::object result = object(numbers...);
      const double value = PyFloat_AsDouble(result.ptr());
      if (value == -1 && PyErr_Occurred()) {
        PyErr_Clear();
        throw py::type_error(std::string("Law: ") + name + " must return a number, got " +
                             py::type::of(result).attr("__name__").template cast<std::string>());
      }
      return value;
    }

    double checked(double level, double x, double speed) const {
      if (level >= 0 && std::isfinite(level)) return level;
      throw std::invalid_argument(std::string("Law: ") + name + " must be finite and at least 0, got " +
                                  detail::shortest(level) + " m/s^2 at x = " + detail::shortest(x) +
                                  " m and a speed of " + detail::shortest(speed) + " m/s");
    }
  };
  struct Functions {
    Function hold, resist;
  };

  std::shared_ptr<const Functions> functions_;
};

}  // namespace stickslip::python
