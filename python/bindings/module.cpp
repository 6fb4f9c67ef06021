// The table of contents of `stickslip._core`.
#include "bindings.hpp"

PYBIND11_MODULE(_core, m) {
  using namespace stickslip::python;
  m.attr("STANDARD_GRAVITY") = stickslip::standard_gravity;
  bind_errors(m);
  bind_coulomb(m);
  bind_caster(m);
  bind_slider(m);
  bind_viscous(m);
  bind_ground_motion(m);
  bind_harmonic_motion(m);
  bind_records(m);
  bind_response(m);
  bind_integrate(m);
  bind_histories(m);
  bind_harmonic(m);
  bind_envelope(m);
  bind_spectrum(m);
  bind_gaussian(m);
  bind_poisson(m);
  bind_moments(m);
  bind_strong_motion(m);
  bind_stationary_linearization(m);
  bind_ensemble(m);
  bind_slowly_varying_parameters(m);
  bind_white_noise(m);
  bind_equivalent_linearization(m);
  bind_pulse_response(m);
  bind_pulse_superposition(m);
  bind_pulse_chain(m);
  bind_thesis(m);
  bind_build_info(m);
  m.def(
      "to_vector", [](const py::object& values, const std::string& name) { return to_array(to_vector(values, name)); },
      py::arg("values"), py::arg("name"),
      "Real numbers in a row, as all functions take them; `name` is for the message where they are none.");
}
