#include "stickslip/ensemble/velocity_spectrum.hpp"

#include "parts.hpp"
#include "statistics/estimate.hpp"

namespace stickslip::python {
namespace {

template <std::vector<double> VelocitySpectrum::*part>
py::array_t<double> by_frequency(const py::object& self) {
  return view(self.cast<const VelocitySpectrum&>().*part, self);
}

}  // namespace

void bind_velocity_spectrum(py::module_& m) {
  value_class<VelocitySpectrum>(m, "VelocitySpectrum",
                                R"(Spectral density of the velocity in the central half of the motions, two-sided.

Kaiser-Bessel window, thesis (4.62), beta = 8, with a mean square of one; dt / (2 pi M) |DFT|^2 of the M windowed
samples. The integral over the whole line is the mean square velocity.)")
      .def_property_readonly("omega", &by_frequency<&VelocitySpectrum::omega>,
                             "Angular frequencies from 0 to the Nyquist frequency [rad/s], shape (F,).")
      .def_property_readonly("density", &by_frequency<&VelocitySpectrum::density>,
                             "Density [m^2/s]: (m/s)^2 per rad/s, shape (F,).")
      .def_property_readonly("error", &by_frequency<&VelocitySpectrum::error>,
                             "Standard error of the density, shape (F,).")
      .def("__repr__", [](const VelocitySpectrum& s) {
        return "<VelocitySpectrum: " + std::to_string(s.omega.size()) + " frequencies to " +
               digits(s.omega.empty() ? 0 : s.omega.back()) + " rad/s>";
      });
}

}  // namespace stickslip::python
