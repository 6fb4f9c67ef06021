#include <pybind11/stl.h>

#include "bindings.hpp"

namespace stickslip::python {
namespace {

py::tuple table_of(const py::object& self) {
  const auto& envelope = self.cast<const Envelope&>();
  return py::make_tuple(view(envelope.time(), self), view(envelope.factor(), self));
}

bool is_table(const Envelope& envelope) { return !envelope.time().empty(); }

template <auto Get>
std::optional<double> unless_table(const Envelope& envelope) {
  return is_table(envelope) ? std::nullopt : std::optional((envelope.*Get)());
}

}  // namespace

void bind_envelope(py::module_& m) {
  py::class_<Envelope>(m, "Envelope", R"(A function of time that modulates a stationary acceleration like an earthquake.

It builds up, stays constant, and decays::

    e(t) = (t / build_up)^2                                    for 0 <= t < build_up
    e(t) = 1                                                   for build_up <= t <= build_up + strong_duration
    e(t) = exp(-decay_rate (t - build_up - strong_duration))   after that; 0 for t < 0

Parameters
----------
build_up : float
    Duration of the build-up [s], finite and at least 0; with 0 the motion starts at full strength.
strong_duration : float
    Duration of the strong phase [s], at least 0, may be inf.
decay_rate : float
    Rate of the decay [1/s], finite and at least 0.

Raises
------
ValueError
    A value out of range.

Warns
-----
PlausibilityWarning
    A duration of an hour or more, which may be in ms.

References
----------
P. C. Jennings, G. W. Housner, N. C. Tsai, Simulated earthquake motions, Caltech (1968).)")
      .def(py::init([](double build_up, double strong_duration, double decay_rate) {
             check_unit("time in an earthquake", "Envelope", "build_up", build_up);
             check_unit("time in an earthquake", "Envelope", "strong_duration", strong_duration);
             return Envelope(build_up, strong_duration, decay_rate);
           }),
           py::kw_only(), py::arg("build_up"), py::arg("strong_duration"), py::arg("decay_rate"))
      .def_static(
          "from_table",
          [](const py::object& time, const py::object& factor) {
            const auto times = to_vector(time, "Envelope: time", "s");
            check_unit("time in an earthquake", "Envelope.from_table", "time", times);
            return Envelope::from_table(times, to_vector(factor, "Envelope: factor", ""));
          },
          py::arg("time"), py::arg("factor"), R"(Interpolate linearly between given points; zero outside.

Parameters
----------
time : array_like, shape (N,)
    Times [s], at least two, finite and increasing.
factor : array_like, shape (N,)
    Factors, finite and at least 0.

Raises
------
ValueError
    An invalid value; the message names it and its index.

Warns
-----
PlausibilityWarning
    A time of an hour or more, which may be in ms.)")
      .def(
          "__call__",
          [](const Envelope& self, const py::object& t) {
            return of_each(t, "Envelope: t", [&self](double at) { return self(at); });
          },
          py::arg("t"), R"(Evaluate the envelope.

Parameters
----------
t : float or array_like
    Times [s].

Returns
-------
float or ndarray
    Factors, at least 0, of the same shape.)")
      .def_property_readonly("build_up", &unless_table<&Envelope::build_up>,
                             "Duration of the build-up [s]; None for a table.")
      .def_property_readonly("strong_duration", &unless_table<&Envelope::strong_duration>,
                             "Duration of the strong phase [s]; None for a table.")
      .def_property_readonly("decay_rate", &unless_table<&Envelope::decay_rate>,
                             "Rate of the decay [1/s]; None for a table.")
      .def_property_readonly(
          "table",
          [](const py::object& self) {
            return is_table(self.cast<const Envelope&>()) ? py::object(table_of(self)) : py::object(py::none());
          },
          "Times [s] and factors of a table, read-only; None without a table.")
      .def("__repr__",
           [](const Envelope& e) {
             if (is_table(e))
               return "<Envelope: table of " + std::to_string(e.time().size()) + " points, " +
                      digits(e.time().front()) + " to " + digits(e.time().back()) + " s>";
             return "Envelope(build_up=" + literal(e.build_up()) + ", strong_duration=" + literal(e.strong_duration()) +
                    ", decay_rate=" + literal(e.decay_rate()) + ")";
           })
      .def(
          "__eq__", [](const Envelope& a, const Envelope& b) { return a == b; }, py::is_operator())
      .def("__hash__", [](const Envelope& e) { return py::hash(py::str(e.configuration())); })
      .def(py::pickle(
          [](const Envelope& e) -> py::tuple {
            if (!is_table(e)) return py::make_tuple(e.build_up(), e.strong_duration(), e.decay_rate());
            return py::make_tuple(std::vector<double>(e.time().begin(), e.time().end()),
                                  std::vector<double>(e.factor().begin(), e.factor().end()));
          },
          [](const py::tuple& t) {
            if (t.size() == 3) return Envelope(t[0].cast<double>(), t[1].cast<double>(), t[2].cast<double>());
            return Envelope::from_table(t[0].cast<std::vector<double>>(), t[1].cast<std::vector<double>>());
          }));
}

}  // namespace stickslip::python
