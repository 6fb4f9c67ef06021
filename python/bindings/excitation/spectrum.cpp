#include <pybind11/stl.h>

#include <cmath>
#include <limits>
#include <memory>

#include "bindings.hpp"

namespace stickslip::python {
namespace {

/// A density in Python.
class PythonDensity : public HeldFunction {
 public:
  using HeldFunction::HeldFunction;

  double operator()(double omega) const {
    const py::gil_scoped_acquire lock;
    const py::object value = function()(omega);
    const double result = PyFloat_AsDouble(value.ptr());
    if (result == -1 && PyErr_Occurred()) throw py::error_already_set();
    return result;
  }
};

struct Described {
  const char* kind;
  py::dict parameters;
};

/// The constructor of a spectrum and its arguments.
struct Describe {
  Described operator()(const Spectrum::White& s) const {
    using namespace py::literals;
    return {"white", py::dict("s0"_a = s.s0)};
  }
  Described operator()(const Spectrum::BandPass& s) const {
    using namespace py::literals;
    return {"band_pass", py::dict("s0"_a = s.s0, "low"_a = s.low, "high"_a = s.high)};
  }
  Described operator()(const Spectrum::KanaiTajimi& s) const {
    using namespace py::literals;
    return {"kanai_tajimi", py::dict("s0"_a = s.s0, "frequency"_a = s.frequency, "damping"_a = s.damping)};
  }
  Described operator()(const Spectrum::CloughPenzien& s) const {
    using namespace py::literals;
    return {"clough_penzien",
            py::dict("s0"_a = s.s0, "frequency"_a = s.frequency, "damping"_a = s.damping,
                     "filter_frequency"_a = s.filter_frequency, "filter_damping"_a = s.filter_damping)};
  }
  Described operator()(const Spectrum::Table& s) const {
    using namespace py::literals;
    return {"from_table", py::dict("omega"_a = to_array(s.omega), "density"_a = to_array(s.density))};
  }
  Described operator()(const Spectrum::Function& s) const {
    using namespace py::literals;
    return {"from_function",
            py::dict("density"_a = s.density->target<PythonDensity>()->function(), "low"_a = s.low, "high"_a = s.high)};
  }
};

Described described(const Spectrum& spectrum) { return std::visit(Describe(), spectrum.form()); }

Spectrum from_table(const py::object& omega, const py::object& density) {
  return Spectrum::from_table(to_vector(omega, "Spectrum: omega"), to_vector(density, "Spectrum: density"));
}

Spectrum from_function(py::function density, double low, double high) {
  return Spectrum::from_function(PythonDensity(std::move(density)), low, high);
}

Spectrum restored(const std::string& kind, const py::dict& p) {
  const auto number = [&](const char* name) { return p[name].cast<double>(); };
  if (kind == "white") return Spectrum::white(number("s0"));
  if (kind == "band_pass") return Spectrum::band_pass(number("s0"), number("low"), number("high"));
  if (kind == "kanai_tajimi") return Spectrum::kanai_tajimi(number("s0"), number("frequency"), number("damping"));
  if (kind == "clough_penzien")
    return Spectrum::clough_penzien(number("s0"), number("frequency"), number("damping"), number("filter_frequency"),
                                    number("filter_damping"));
  if (kind == "from_table") return from_table(p["omega"], p["density"]);
  if (kind == "from_function") return from_function(p["density"], number("low"), number("high"));
  throw std::invalid_argument("Spectrum: unknown kind '" + kind + "'");
}

std::string repr_of_spectrum(const Spectrum& spectrum) {
  if (const auto* table = std::get_if<Spectrum::Table>(&spectrum.form()))
    return "<Spectrum: table of " + std::to_string(table->omega.size()) + " points, " + digits(spectrum.low()) +
           " to " + digits(spectrum.high()) + " rad/s>";
  const auto [kind, parameters] = described(spectrum);
  std::string text;
  for (const auto& [name, value] : parameters) {
    text += (text.empty() ? "" : ", ") + py::str(name).cast<std::string>() + "=";
    if (!py::isinstance<py::float_>(value))
      text += py::repr(value).cast<std::string>();
    else
      text += literal(value.cast<double>());
  }
  return "Spectrum." + std::string(kind) + "(" + text + ")";
}

}  // namespace

void bind_spectrum(py::module_& m) {
  const auto check = [](const char* of, double s0, double frequency = 0, double damping = 0) {
    const std::string who = std::string("Spectrum.") + of;
    check_unit("spectral density", who, "s0", s0);
    check_unit("angular frequency", who, "frequency", frequency);
    check_unit("damping ratio of one mode", who, "damping", damping);
  };
  py::class_<Spectrum>(m, "Spectrum", R"(The two-sided spectral density of a stationary ground acceleration.

S(omega) [m^2/s^3], omega in rad/s. The integral over the whole line is the variance; S(-omega) = S(omega); white noise
has R(t) = 2 pi S0 delta(t). A one-sided density G(omega) is 2 S(omega); one over hertz, G(f), is 4 pi S(2 pi f).

The constructors are `white`, `band_pass`, `kanai_tajimi`, `clough_penzien`, `from_table` and `from_function`; each
raises ValueError for a value out of range. Spectra are immutable; a call returns the density::

    s = Spectrum.band_pass(s0=1.0, low=2.0, high=4.0)
    s([1.0, 3.0])  # 0 and 1
    s.variance  # 4.0: both sides count)")
      .def_static(
          "white",
          [check](double s0) {
            check("white", s0);
            return Spectrum::white(s0);
          },
          py::kw_only(), py::arg("s0"), R"(White noise: S = s0 everywhere.

Parameters
----------
s0 : float
    [m^2/s^3], positive and finite.

Warns
-----
PlausibilityWarning
    An s0 of 50 m^2/s^3 or more, which may be in cm^2/s^3.)")
      .def_static(
          "band_pass",
          [check](double s0, double low, double high) {
            check("band_pass", s0);
            return Spectrum::band_pass(s0, low, high);
          },
          py::kw_only(), py::arg("s0"), py::arg("low"), py::arg("high"),
          R"(Ideal band-pass: S = s0 for low <= |omega| <= high, thesis (4.24).

Parameters
----------
s0 : float
    [m^2/s^3], positive and finite.
low, high : float
    [rad/s], 0 <= low < high, finite.

Warns
-----
PlausibilityWarning
    As for `white`.)")
      .def_static(
          "kanai_tajimi",
          [check](double s0, double frequency, double damping) {
            check("kanai_tajimi", s0, frequency, damping);
            return Spectrum::kanai_tajimi(s0, frequency, damping);
          },
          py::kw_only(), py::arg("s0"), py::arg("frequency"), py::arg("damping"),
          R"(White noise filtered by a soil layer with one mode, at the surface.

S = s0 (wg^4 + 4 z^2 wg^2 omega^2) / ((wg^2 - omega^2)^2 + 4 z^2 wg^2 omega^2). S(0) = s0, so that ground velocity
and displacement grow without bound; see `clough_penzien`.

Parameters
----------
s0 : float
    Level in the rock [m^2/s^3], positive and finite.
frequency : float
    wg [rad/s], positive and finite.
damping : float
    z, fraction of critical damping, positive and finite.

Warns
-----
PlausibilityWarning
    As for `white`; a damping ratio from 2 to 100, which may be in percent.

References
----------
K. Kanai, Bull. Earthq. Res. Inst. 35 (1957), 309-325; H. Tajimi, 2nd WCEE (1960), 781-797.)")
      .def_static(
          "clough_penzien",
          [check](double s0, double frequency, double damping, double filter_frequency, double filter_damping) {
            check("clough_penzien", s0, frequency, damping);
            check_unit("angular frequency", "Spectrum.clough_penzien", "filter_frequency", filter_frequency);
            check_unit("damping ratio of one mode", "Spectrum.clough_penzien", "filter_damping", filter_damping);
            return Spectrum::clough_penzien(s0, frequency, damping, filter_frequency, filter_damping);
          },
          py::kw_only(), py::arg("s0"), py::arg("frequency"), py::arg("damping"), py::arg("filter_frequency"),
          py::arg("filter_damping"),
          R"(Kanai-Tajimi spectrum with a second filter that removes low frequencies.

S = S_KT omega^4 / ((wf^2 - omega^2)^2 + 4 zf^2 wf^2 omega^2).

Parameters
----------
s0, frequency, damping : float
    As for `kanai_tajimi`.
filter_frequency : float
    wf [rad/s], positive and finite.
filter_damping : float
    zf, positive and finite.

Warns
-----
PlausibilityWarning
    As for `kanai_tajimi`.

References
----------
R. W. Clough, J. Penzien, Dynamics of Structures (1975), 26-2.)")
      .def_static("from_table", &from_table, py::arg("omega"), py::arg("density"),
                  R"(Interpolate linearly between given points; zero outside.

Parameters
----------
omega : array_like, shape (N,)
    Angular frequencies [rad/s], at least two, the first at least 0, increasing, finite.
density : array_like, shape (N,)
    S [m^2/s^3], at least 0, finite, not all zero.)")
      .def_static("from_function", &from_function, py::arg("density"), py::kw_only(), py::arg("low") = 0.0,
                  py::arg("high") = std::numeric_limits<double>::infinity(),
                  R"(Use any function of omega >= 0; zero outside [low, high].

Parameters
----------
density : callable
    S(omega) [m^2/s^3] at one omega [rad/s], finite and at least 0. Called some thousand times here, and once for each
    line by an excitation, but not while motions are generated. To pickle the spectrum it must be a function of a
    module.
low, high : float, optional
    [rad/s], 0 <= low < high; high may be inf.

Raises
------
ValueError
    The function is negative or NaN (names omega), or not integrable.)")
      .def(
          "__call__",
          [](const Spectrum& self, const py::object& omega) {
            return of_each(omega, "Spectrum: omega", [&self](double w) { return self(w); });
          },
          py::arg("omega"), R"(Evaluate the density.

Parameters
----------
omega : float or array_like
    Angular frequency [rad/s], of either sign.

Returns
-------
float or ndarray
    S [m^2/s^3], of the same shape.)")
      .def_property_readonly(
          "kind", [](const Spectrum& s) { return described(s).kind; }, "Name of the constructor.")
      .def_property_readonly(
          "parameters", [](const Spectrum& s) { return described(s).parameters; }, "Arguments of the constructor.")
      .def_property_readonly("low", &Spectrum::low, "Lower edge of the band [rad/s]: S is zero below.")
      .def_property_readonly("high", &Spectrum::high, "Upper edge of the band [rad/s]: S is zero above; may be inf.")
      .def_property_readonly("variance", py::overload_cast<>(&Spectrum::variance, py::const_),
                             R"(Integral over the whole line [m^2/s^4]; inf for white noise.

In closed form; by quadrature to 1e-10 for Clough-Penzien and functions.)")
      .def("band_variance", py::overload_cast<double, double>(&Spectrum::variance, py::const_), py::kw_only(),
           py::arg("low") = 0.0, py::arg("high") = std::numeric_limits<double>::infinity(),
           R"(Variance in a band, from positive and negative frequencies.

Parameters
----------
low, high : float, optional
    [rad/s], 0 <= low <= high; high may be inf.

Returns
-------
float
    [m^2/s^4].

Raises
------
ValueError
    Limits out of range.)")
      .def_property_readonly("configuration", &Spectrum::configuration,
                             "The spectrum as a JSON object; a hash of 1024 values stands for a function.")
      .def("__repr__", &repr_of_spectrum)
      .def(
          "__eq__", [](const Spectrum& a, const Spectrum& b) { return a == b; }, py::is_operator())
      .def("__hash__", [](const Spectrum& s) { return py::hash(py::str(s.configuration())); })
      .def(py::pickle(
          [](const Spectrum& s) {
            const auto [kind, parameters] = described(s);
            return py::make_tuple(kind, parameters);
          },
          [](const py::tuple& t) { return restored(t[0].cast<std::string>(), t[1].cast<py::dict>()); }));
}

}  // namespace stickslip::python
