#include "stickslip/sweep/orientations.hpp"

#include "bindings.hpp"

namespace stickslip::python {
namespace {

AnySlider required_slider(const py::object& object) {
  if (auto slider = slider_of(object)) return *std::move(slider);
  throw py::type_error("orientations: slider must be a Slider or friction law, got " +
                       py::type::of(object).attr("__name__").cast<std::string>());
}

py::dict run_orientations(const py::object& slider, const GroundMotion& station, const py::object& degrees, bool settle,
                          const std::string& contact, unsigned threads, const py::object& progress) {
  OrientationsOptions options{settle, contact_of(contact, "orientations"), threads};
  options.progress = [&](std::size_t done, std::size_t directions) {
    const py::gil_scoped_acquire held;
    if (PyErr_CheckSignals() != 0) throw py::error_already_set();
    if (!progress.is_none()) progress(done, directions);
  };
  const std::vector<double> angles = to_vector(degrees, "orientations: degrees", "degrees");
  const AnySlider one = required_slider(slider);
  Orientations found = [&] {
    const py::gil_scoped_release released;
    return orientations(one, station, angles, options);
  }();
  py::list failures;
  for (const OrientationFailure& failure : found.failures)
    failures.append(py::make_tuple(failure.place, failure.message));
  py::dict result;
  result["peak"] = array_of(std::move(found.peak));
  result["residual"] = array_of(std::move(found.residual));
  result["failures"] = failures;
  return result;
}

}  // namespace

void bind_orientations(py::module_& m) {
  m.def("orientations", &run_orientations, py::arg("slider"), py::arg("station"), py::arg("degrees"), py::kw_only(),
        py::arg("settle"), py::arg("contact"), py::arg("threads"), py::arg("progress"),
        R"(Implementation of `stickslip.orientations` (see there).

`degrees` are angles from the axis of the station. Calls `progress(done, directions)` ten times a second with the
interpreter lock held.)");
  m.def(
      "_mirrors", [](const py::object& slider) { return mirrors(required_slider(slider)); }, py::arg("slider"),
      "Whether a reversed ground motion is known to give the mirrored response.");
}

}  // namespace stickslip::python
