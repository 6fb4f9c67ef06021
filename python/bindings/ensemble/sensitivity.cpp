#include "stickslip/ensemble/sensitivity.hpp"

#include <atomic>
#include <stdexcept>

#include "ensemble/sources.hpp"
#include "parts.hpp"
#include "sliding/response.hpp"

namespace stickslip::python {

template <>
inline constexpr auto parts<EnsembleSensitivity> = std::tuple(&EnsembleSensitivity::peak,
                                                              &EnsembleSensitivity::residual,
                                                              &EnsembleSensitivity::peak_mean,
                                                              &EnsembleSensitivity::residual_mean,
                                                              &EnsembleSensitivity::residual_mean_square,
                                                              &EnsembleSensitivity::residual_rms);

namespace {

EnsembleSensitivity run_sensitivity(const py::object& sliders, const py::object& motions, const std::string& name,
                                    std::uint64_t members, std::uint64_t first_member, std::uint64_t seed,
                                    unsigned threads, bool settle, const std::string& contact,
                                    const py::object& progress) {
  const auto [parameter, factor, surface] = parameter_of(name, "ensemble_sensitivity");
  if (surface)
    throw std::invalid_argument("ensemble_sensitivity: covers Coulomb friction, which has no surfaces, got '" + name +
                                "'");
  EnsembleSensitivityOptions options{members, first_member, seed,
                                     threads, settle,       contact_of(contact, "ensemble_sensitivity")};
  std::atomic<bool> ended = false;
  options.progress = [&](std::uint64_t done, std::uint64_t total) {
    const py::gil_scoped_acquire held;
    try {
      if (PyErr_CheckSignals() != 0) throw py::error_already_set();
      progress(done, total);
    } catch (const py::error_already_set&) {
      ended = true;
      throw;
    }
  };
  const Motions these(motions, ended);
  EnsembleSensitivity result = with_sliders(sliders, ended, [&, by = parameter](const auto& those) {
    const py::gil_scoped_release released;
    return ensemble_sensitivity(those, these, by, options);
  });
  for (auto* values : {&result.peak, &result.residual})
    for (double& value : *values) value *= factor;
  for (Estimate* estimate :
       {&result.peak_mean, &result.residual_mean, &result.residual_mean_square, &result.residual_rms}) {
    estimate->value *= factor;
    estimate->error *= factor;
  }
  return result;
}

template <std::vector<double> EnsembleSensitivity::*values>
py::array_t<double> by_member(const py::object& self) {
  return view(self.cast<const EnsembleSensitivity&>().*values, self);
}

}  // namespace

void bind_ensemble_sensitivity(py::module_& m) {
  value_class<EnsembleSensitivity>(m, "EnsembleSensitivity",
                                   R"(Derivatives of the statistics of an ensemble with respect to a parameter.

Returned by `ensemble_sensitivity`, per unit of the parameter. Arrays have shape (members,) and are read-only. Standard
errors are from the scatter between members.)")
      .def_property_readonly("peak", &by_member<&EnsembleSensitivity::peak>,
                             "Derivative of the peak of each member [m], in order.")
      .def_property_readonly("residual", &by_member<&EnsembleSensitivity::residual>,
                             "Derivative of the last x of each member [m], in order.")
      .def_readonly("peak_mean", &EnsembleSensitivity::peak_mean, "Derivative of E[peak] [m].")
      .def_readonly("residual_mean", &EnsembleSensitivity::residual_mean, "Derivative of E[x] at the end [m].")
      .def_readonly("residual_mean_square", &EnsembleSensitivity::residual_mean_square,
                    "Derivative of E[x^2] at the end, 2 E[x dx] [m^2].")
      .def_readonly("residual_rms", &EnsembleSensitivity::residual_rms,
                    "Derivative of sqrt(E[x^2]) at the end, E[x dx] / rms [m].")
      .def("__repr__", [](const EnsembleSensitivity& s) {
        const auto text_of = [](const Estimate& one) { return py::str(py::cast(one)).cast<std::string>(); };
        return "<EnsembleSensitivity: " + std::to_string(s.peak.size()) + " members, E[peak] " + text_of(s.peak_mean) +
               ", rms " + text_of(s.residual_rms) + ">";
      });
}

void bind_run_ensemble_sensitivity(py::module_& m) {
  m.def("ensemble_sensitivity", &run_sensitivity, py::arg("sliders"), py::arg("motions"), py::arg("parameter"),
        py::kw_only(), py::arg("members"), py::arg("first_member"), py::arg("seed"), py::arg("threads"),
        py::arg("settle"), py::arg("contact"), py::arg("progress"),
        R"(Implementation of `stickslip.ensemble_sensitivity` (see there).

Calls `progress(done, members)` ten times a second with the interpreter lock held.)");
}

}  // namespace stickslip::python
