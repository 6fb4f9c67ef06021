#include "friction/callable_law.hpp"

#include <cstdint>
#include <memory>
#include <string>
#include <utility>

#include "parts.hpp"
#include "stickslip/base/error.hpp"

namespace stickslip::python {

namespace {

/// Keeps the interpreter's state of a thread that the library started until the thread ends: to make one for each call
/// takes longer than the call.
class ThreadState {
 public:
  static void keep() { thread_local const ThreadState kept; }
  ~ThreadState() {
    if (saved_ == nullptr) return;
    PyEval_RestoreThread(saved_);
    PyGILState_Release(ensured_);
  }
  ThreadState(const ThreadState&) = delete;
  ThreadState& operator=(const ThreadState&) = delete;

 private:
  ThreadState() {
    if (PyGILState_GetThisThreadState() != nullptr) return;  // Python's own thread
    ensured_ = PyGILState_Ensure();
    saved_ = PyEval_SaveThread();
  }

  PyGILState_STATE ensured_{};
  PyThreadState* saved_ = nullptr;
};

/// An exception of Python that a function raised. A trial step that meets it is shortened; see NoLevel.
class RaisedByFunction : public py::error_already_set, public NoLevel {
 public:
  explicit RaisedByFunction(const py::error_already_set& error) : py::error_already_set(error) {}
};

}  // namespace

struct CallableLaw::Function {
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
    const py::object result = prototype.attr("restype");
    bool fits = static_cast<int>(types.size()) == arguments && result.is(c_double);
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
    ThreadState::keep();
    const py::gil_scoped_acquire locked;
    const py::object result = [&] {
      try {
        return object(numbers...);
      } catch (const py::error_already_set& error) {
        if (error.matches(PyExc_Exception)) throw RaisedByFunction(error);
        throw;  // such as KeyboardInterrupt
      }
    }();
    const double value = PyFloat_AsDouble(result.ptr());
    if (value == -1 && PyErr_Occurred()) {
      PyErr_Clear();
      throw py::type_error(std::string("Law: ") + name + " must return a number, got " +
                           py::type::of(result).attr("__name__").template cast<std::string>());
    }
    return value;
  }
};
struct CallableLaw::Functions {
  Function hold, resist;
};

CallableLaw::CallableLaw(py::object hold, py::object resist)
    : functions_(new Functions{{std::move(hold), "hold", 2}, {std::move(resist), "resist", 3}}, [](Functions* all) {
        const py::gil_scoped_acquire locked;
        delete all;
      }) {}

py::object CallableLaw::hold_function() const { return functions_->hold.object; }
py::object CallableLaw::resist_function() const { return functions_->resist.object; }

double CallableLaw::operator()(double x, double speed, Direction direction) const {
  const Function& f = functions_->resist;
  return f.compiled3 ? f.compiled3(x, speed, sign(direction)) : f.call(x, speed, sign(direction));
}

FunctionLaw CallableLaw::law() const {
  if (functions_->hold.missing) return FunctionLaw(*this);
  return FunctionLaw(*this, [functions = functions_](double x, Direction direction) {
    const Function& f = functions->hold;
    return f.compiled2 ? f.compiled2(x, sign(direction)) : f.call(x, sign(direction));
  });
}

template <>
void bind_law<FunctionLaw>(py::module_& m) {
  auto type = value_class<CallableLaw>(m, "Law", R"doc(A friction law of your own, from functions.

Parameters
----------
resist : function of (x, speed, direction)
    Level against sliding [m/s^2]: friction force per unit mass where the normal force is g. x is the displacement [m],
    speed is |x'| [m/s], and direction is +1.0 (forward) or -1.0 (backward). Finite, at least 0, and continuous in x and
    speed.
hold : function of (x, direction), optional
    Level at rest against sliding in a direction [m/s^2]; finite and at least that of `resist` at zero speed, which is the
    default.

Raises
------
TypeError
    Not a function; a compiled function of other types; a function that does not return a number.
ValueError
    During integration: a level that is negative or not finite. The message states it, and x and speed.

Notes
-----
The motion is computed by collocation in time, to 1e-10 of the scale. Each step of the collocation calls `resist` 30 to
60 times, and a sample in which slips begin and end takes several steps. A Python function holds the interpreter lock; a
compiled one, such as one from `numba.cfunc("float64(float64, float64, float64)")`, runs without it and costs about a
tenth. The section "A law of your own" of the documentation has a table of costs. Trial steps may go beyond the motion:
one in which a function raises an exception, or returns a level that is not valid, is shortened. If the motion itself
goes there, the exception ends the integration and is raised again.

Laws compare by their functions. They can be pickled if their functions can: those of modules, not lambdas. Theories and
sensitivities do not cover them.

Examples
--------
>>> law = Law(resist=lambda x, speed, direction: 2.0 + 0.5 * speed)
>>> Slider(law).resist(speed=1.0)
2.5)doc");
  type.def(py::init<py::object, py::object>(), py::kw_only(), py::arg("hold") = py::none(), py::arg("resist"))
      .def_property_readonly("hold", &CallableLaw::hold_function, "The function of (x, direction), or None.")
      .def_property_readonly("resist", &CallableLaw::resist_function, "The function of (x, speed, direction).")
      .def("__repr__", [](const CallableLaw& law) {
        const auto name = [](const py::object& f) { return py::repr(f).cast<std::string>(); };
        return "<Law: " + (law.hold_function().is_none() ? "" : "hold " + name(law.hold_function()) + ", ") +
               "resist " + name(law.resist_function()) + ">";
      });
}

}  // namespace stickslip::python
