#include "stickslip/ground/response_spectrum.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>
#include <utility>
#include <vector>

#include "carts/carts.hpp"
#include "ground/suite.hpp"
#include "in_python.hpp"
#include "parts.hpp"
#include "planar/response.hpp"
#include "sliding/response.hpp"
#include "statistics/estimate.hpp"

namespace stickslip::python {
namespace {

using namespace std::string_view_literals;

constexpr std::array kinds{std::pair(SpectrumKind::pseudo_acceleration, "pseudo_acceleration"sv),
                           std::pair(SpectrumKind::pseudo_velocity, "pseudo_velocity"sv),
                           std::pair(SpectrumKind::displacement, "displacement"sv),
                           std::pair(SpectrumKind::velocity, "velocity"sv),
                           std::pair(SpectrumKind::acceleration, "acceleration"sv)};

SpectrumKind kind_of(const std::string& name) {
  for (const auto& [kind, known] : kinds)
    if (name == known) return kind;
  std::string all;
  for (const auto& [kind, known] : kinds) all.append(all.empty() ? "'" : ", '").append(known).append("'");
  throw std::invalid_argument("response_spectrum: kind must be one of " + all + ", got '" + name + "'");
}

std::string name_of(SpectrumKind kind) {
  return std::string(std::ranges::find(kinds, kind, [](const auto& pair) { return pair.first; })->second);
}

py::array_t<double> rows_of(const py::object& self) {
  const auto& spectrum = self.cast<const ResponseSpectrum&>();
  py::array_t<double> flat = view(spectrum.values, self);
  if (spectrum.damping.size() == 1) return flat;
  return flat.attr("reshape")(spectrum.damping.size(), spectrum.periods.size());
}

bool is_in_plane(const py::object& response) {
  return py::isinstance<PlanarResponseWithInputs>(response) || py::isinstance<CartResponseWithInputs>(response);
}

PlanarFloorMotion floor_in_plane(const py::object& of) {
  const auto floor = [](const auto& system, const auto& response) {
    const auto& ground = response.motion.template cast<const GroundMotion&>();
    const py::gil_scoped_release released;
    return floor_motion(system, ground, response.response);
  };
  if (py::isinstance<CartResponseWithInputs>(of)) {
    const auto& response = of.cast<const CartResponseWithInputs&>();
    return floor(response.cart.cast<const CartAsGiven&>().cart(), response);
  }
  const auto& response = of.cast<const PlanarResponseWithInputs&>();
  return floor(response.slider.cast<const AnyPlanarSlider&>(), response);
}

}  // namespace

void bind_response_spectrum(py::module_& m) {
  value_class<ResponseSpectrum>(m, "ResponseSpectrum",
                                "An elastic response spectrum, as `response_spectrum` returns it.")
      .def_property_readonly(
          "kind", [](const ResponseSpectrum& s) { return name_of(s.kind); },
          "Kind of the values, as for `response_spectrum`.")
      .def_readonly("name", &ResponseSpectrum::name,
                    "Name of the ground motion, or of what carries the oscillators, such as 'floor 2, Kobe'.")
      .def_property_readonly(
          "periods", [](const py::object& self) { return view(self.cast<const ResponseSpectrum&>().periods, self); },
          "Undamped natural periods [s], shape (P,); read-only.")
      .def_property_readonly(
          "damping", [](const py::object& self) { return view(self.cast<const ResponseSpectrum&>().damping, self); },
          "Ratios of critical damping, shape (D,); read-only.")
      .def_property_readonly("values", &rows_of,
                             "The maximum response [m/s^2, m/s or m], shape (P,) for one damping ratio, (D, P) for "
                             "several; read-only.")
      .def("plot", plot_in("plot_response_spectrum", "ax"), py::kw_only(), py::arg("ax") = py::none(),
           py::arg("title") = py::none(),
           R"(Plot the values over the period, with a line for each damping ratio.

Needs matplotlib (`pip install stickslip[plot]`). Draws into `ax=`, a matplotlib Axes, or into a new figure; `title=`
replaces the default. Returns the axes that were given, otherwise the new Figure.)")
      .def("__repr__",
           [](const ResponseSpectrum& s) {
             return "<ResponseSpectrum: " + name_of(s.kind) + ", " + std::to_string(s.periods.size()) +
                    (s.periods.size() == 1 ? " period, " : " periods, ") +
                    (s.damping.size() == 1 ? "damping " + digits(s.damping[0])
                                           : std::to_string(s.damping.size()) + " damping ratios") +
                    ", largest " + digits(*std::ranges::max_element(s.values)) + " " +
                    (s.kind == SpectrumKind::displacement                                          ? "m"
                     : s.kind == SpectrumKind::velocity || s.kind == SpectrumKind::pseudo_velocity ? "m/s"
                                                                                                   : "m/s^2") +
                    ">";
           })
      .def("to_dataframe", in_python("stickslip.motions.tables", "spectrum_to_dataframe"),
           R"(Convert the spectrum to a pandas DataFrame, a row for each period and damping ratio.

The columns are `period` [s], `damping` and the kind of the values, such as `pseudo_acceleration`; `df.attrs["units"]`
has their units. ImportError without pandas.)")
      .def("to_csv", csv_in("stickslip.motions.tables", "spectrum_to_csv"), py::arg("path"),
           csv_doc("Write the spectrum to a CSV file, whole or not at all, with the rows of `to_dataframe`.",
                   "Every number reads back as the same double.")
               .c_str())
      .def("to_json", in_python("stickslip.motions.tables", "spectrum_to_json"),
           R"(The spectrum as one JSON object (str): `kind`, `units`, `period`, `damping`, `values`.

The values are nested lists of shape (D, P); every number reads back as the same double.)")
      .def("_repr_html_", in_python("stickslip._html", "spectrum_html"));

  m.def(
      "response_spectrum",
      [](const py::object& motion, const py::object& periods, const py::object& damping, const std::string& kind,
         double direction) -> py::object {
        detail::require(std::isfinite(direction), "response_spectrum: direction must be finite", direction, "degrees");
        if (is_suite(motion))
          return py::module_::import("stickslip.motions.intensity").attr("spectra")(motion, periods, damping, kind);
        auto all_periods = to_vector_or_number(periods, "response_spectrum: periods", "s");
        auto all_damping = to_vector_or_number(damping, "response_spectrum: damping", "");
        check_unit("period", "response_spectrum", "periods", all_periods, 2);
        const SpectrumKind which = kind_of(kind);
        const auto answer = [&](const auto& accelerations, const auto&... impulses) {
          return py::cast([&] {
            const py::gil_scoped_release released;
            return response_spectrum(accelerations, std::move(all_periods), std::move(all_damping), which, impulses...);
          }());
        };
        if (py::isinstance<GroundMotion>(motion)) {
          const auto& ground = motion.cast<const GroundMotion&>();
          return direction == 0 ? answer(ground) : answer(rotated(ground, direction));
        }
        const auto of_mass = [&](const py::object& spectrum) {
          const py::object ground = motion.attr("motion");
          const std::string name =
              py::isinstance<GroundMotion>(ground) ? ground.cast<const GroundMotion&>().name() : std::string();
          const char* what = py::isinstance<CartResponseWithInputs>(motion) ? "cart" : "sliding mass";
          spectrum.cast<ResponseSpectrum&>().name = what + (name.empty() ? name : ", " + name);
          return spectrum;
        };
        if (is_in_plane(motion)) {
          const FloorMotion floor = floor_in_plane(motion).along(direction);
          return of_mass(answer(floor.segments, floor.impulses));
        }
        if (direction != 0)
          throw std::invalid_argument(
              "response_spectrum: direction needs a ground motion or a response with two horizontal components");
        if (!py::isinstance<ResponseWithInputs>(motion))
          throw py::type_error(
              "response_spectrum: motion must be a GroundMotion, a Suite, or the response of a slider, a structure or "
              "a cart, got " +
              py::repr(motion).cast<std::string>());
        const auto& response = motion.cast<const ResponseWithInputs&>();
        const FloorMotion floor = with_inputs(response, [&](const auto& slider, const auto& ground) {
          return floor_motion(slider, ground, response.response);
        });
        return of_mass(answer(floor.segments, floor.impulses));
      },
      py::arg("motion"), py::arg("periods"), py::arg("damping") = 0.05, py::kw_only(),
      py::arg("kind") = "pseudo_acceleration", py::arg("direction") = 0.0,
      "The spectrum of all but structures, see `stickslip.response_spectrum`.");

  py::class_<PlanarFloorMotion>(m, "_PlanarFloorMotion",
                                "The floor motion of a response in the plane or of a cart, for `rotd`.")
      .def(py::init(&floor_in_plane), py::arg("response"))
      .def(
          "spectrum",
          [](const PlanarFloorMotion& self, double direction, const py::object& periods, double damping,
             const std::string& kind) {
            std::vector<double> all = to_vector_or_number(periods, "rotd: periods", "s");
            const SpectrumKind which = kind_of(kind);
            const py::gil_scoped_release released;
            const FloorMotion along = self.along(direction);
            return response_spectrum(along.segments, std::move(all), {damping}, which, along.impulses);
          },
          py::arg("direction"), py::arg("periods"), py::arg("damping"), py::arg("kind"),
          "The floor spectrum in a direction [degrees], as `response_spectrum`.");
}

}  // namespace stickslip::python
