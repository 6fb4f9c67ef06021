// The table of contents of `stickslip._core`.
#include <algorithm>
#include <string>

#include "bindings.hpp"
#include "carts/carts.hpp"
#include "rocking/rocking.hpp"
#include "structure/structure.hpp"

namespace {

/// Closes two ways in which pybind11 lets Python code crash the interpreter.
void make_safe(py::type type) {
  auto* const info = py::detail::get_type_info(reinterpret_cast<PyTypeObject*>(type.ptr()));
  if (info == nullptr) return;
  // An object made only by `__new__` would get uninitialized memory at its first use.
  info->operator_new = [](std::size_t) -> void* {
    throw py::type_error("an object was used whose __init__ was never called");
  };
  // Pickle protocols 0 and 1 call the common base class of all objects, which ends the program.
  type.attr("__reduce_ex__") = py::cpp_function(
      [](const py::object& self, int protocol) {
        return py::handle(reinterpret_cast<PyObject*>(&PyBaseObject_Type))
            .attr("__reduce_ex__")(self, std::max(protocol, 2));
      },
      py::name("__reduce_ex__"), py::is_method(type));
}

}  // namespace

// In a subinterpreter pybind11 would wait without end for the lock of the main one, before any code of this module runs.
extern "C" PYBIND11_EXPORT PyObject* PyInit_in_main_interpreter();
extern "C" PYBIND11_EXPORT PyObject* PyInit__core() {
  if (PyInterpreterState_Get() == PyInterpreterState_Main()) return PyInit_in_main_interpreter();
  PyErr_SetString(PyExc_ImportError,
                  "stickslip does not support subinterpreters; use the main interpreter of a process");
  return nullptr;
}
#define PyInit__core PyInit_in_main_interpreter  // which the macro defines

PYBIND11_MODULE(_core, m) {
  using namespace stickslip::python;
  m.attr("STANDARD_GRAVITY") = stickslip::standard_gravity;
  // Classes report the module in which users find them.
  const auto in = [&m](const char* module) { m.attr("__name__") = module; };
  const std::string compiled = py::str(m.attr("__name__"));
  in("stickslip");
  bind_errors(m);
  bind_state(m);
  bind_laws(m);
  bind_stops(m);
  bind_slider(m);
  bind_viscous(m);
  bind_ground_motion(m);
  bind_harmonic_motion(m);
  bind_records(m);
  bind_advance(m);
  bind_element_motion(m);
  bind_response(m);
  bind_integrate(m);
  bind_planar_slider(m);
  bind_planar_advance(m);
  bind_planar_response(m);
  bind_planar_integrate(m);
  bind_structure(m);
  bind_isolated_structure(m);
  bind_equipment_on_floor(m);
  bind_flexible_slope(m);
  bind_structure_advance(m);
  bind_structure_response(m);
  bind_slender_block(m);
  bind_rocking_block(m);
  bind_rocking_advance(m);
  bind_rocking_response(m);
  bind_supports(m);
  bind_cart(m);
  bind_cart_advance(m);
  bind_cart_response(m);
  bind_histories(m);
  bind_planar_histories(m);
  bind_envelope(m);
  bind_spectrum(m);
  bind_gaussian(m);
  bind_poisson(m);
  bind_with_vertical(m);
  bind_with_transverse(m);
  bind_moments(m);
  bind_response_spectrum(m);
  bind_strong_motion(m);
  bind_pulse_fit(m);
  bind_estimates(m);
  bind_distributions(m);
  bind_stationary(m);
  bind_floor_peaks(m);
  bind_velocity_spectrum(m);
  bind_drawn(m);
  bind_ensemble(m);
  bind_ensemble_sensitivity(m);
  bind_rocking_outcomes(m);
  bind_cart_outcomes(m);
  bind_identity(m);
  bind_sweep(m);
  bind_orientations(m);
  bind_build_info(m);
  in("stickslip.harmonic");
  bind_harmonic(m);
  in("stickslip.theory");
  bind_theory(m);
  bind_stationary_linearization(m);
  bind_slowly_varying_parameters(m);
  bind_white_noise(m);
  bind_shaping_filter(m);
  bind_equivalent_linearization(m);
  bind_pulse_response(m);
  bind_displacement_distribution(m);
  bind_pulse_superposition(m);
  bind_pulse_chain(m);
  bind_transport(m);
  in(compiled.c_str());
  bind_run_ensemble(m);
  bind_run_ensemble_sensitivity(m);
  bind_thesis(m);
  m.def(
      "to_vector", [](const py::object& values, const std::string& name) { return to_array(to_vector(values, name)); },
      py::arg("values"), py::arg("name"),
      "Convert to a one-dimensional array of real numbers, as all functions do; `name` is for error messages.");
  bind_number_texts(m);
  for (const auto& [name, thing] : m.attr("__dict__").cast<py::dict>())
    if (py::isinstance<py::type>(thing)) make_safe(py::reinterpret_borrow<py::type>(thing));
  make_plain(m);
}
