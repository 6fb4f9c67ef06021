#include <pybind11/stl.h>

#include "parts.hpp"

namespace stickslip::python {
namespace {

GroundMotion make(const py::object& acceleration, std::optional<double> dt, const std::optional<py::object>& times,
                  const std::string& interpolation, std::string name) {
  if (dt.has_value() == times.has_value())
    throw std::invalid_argument(std::string("GroundMotion: give either dt or times, got ") + (dt ? "both" : "neither"));
  std::vector<double> samples = to_vector(acceleration, "GroundMotion: acceleration");
  if (dt) return {std::move(samples), *dt, interpolation_of(interpolation, "GroundMotion"), std::move(name)};
  return {std::move(samples), to_vector(*times, "GroundMotion: times"), interpolation_of(interpolation, "GroundMotion"),
          std::move(name)};
}

py::array_t<double> times_of(const GroundMotion& motion) {
  py::array_t<double> times(static_cast<py::ssize_t>(motion.samples()));
  double* t = times.mutable_data();
  for (std::size_t i = 0; i < motion.samples(); ++i) t[i] = motion.time(i);
  return times;
}

std::optional<double> dt_of(const GroundMotion& motion) {
  return std::isnan(motion.dt()) ? std::nullopt : std::optional(motion.dt());
}

}  // namespace

void bind_ground_motion(py::module_& m) {
  py::class_<GroundMotion>(m, "GroundMotion", R"(The acceleration history n(t) of the ground.

Motions with the same samples, dt or times, interpolation and name are equal; they can be hashed, copied and pickled.

N samples make N - 1 pieces; the motion lasts from the first time to the last.

Parameters
----------
acceleration : array_like, shape (N,)
    n at the samples [m/s^2]; N at least 2, finite, at most 1e100 in magnitude. Copied.
dt : float, optional
    Time between samples [s], positive: the times are 0, dt, 2 dt, ... Give dt or times.
times : array_like, shape (N,), optional
    Times of the samples [s], finite and increasing. Values that are held may share a time.
interpolation : {'linear', 'constant'}, optional
    A straight line between samples (thesis 4.56), or each value held until the next time; the last value then closes
    the motion without acting.
name : str, optional
    Where the motion comes from; shown in plots.

Raises
------
ValueError
    Naming the value refused and its index.)")
      .def(py::init(&make), py::arg("acceleration"), py::arg("dt") = py::none(), py::kw_only(),
           py::arg("times") = py::none(), py::arg("interpolation") = "linear", py::arg("name") = "")
      .def_property_readonly(
          "acceleration",
          [](const py::object& self) { return view(self.cast<const GroundMotion&>().acceleration(), self); },
          "Ground acceleration at the samples [m/s^2], shape (N,); read-only, not copied.")
      .def_property_readonly("time", &times_of, "Times of the samples [s], shape (N,).")
      .def_property_readonly("dt", &dt_of, "Time between samples [s]; None where the times are uneven.")
      .def_property_readonly("duration", &GroundMotion::duration, "From the first sample to the last [s].")
      .def_property_readonly("peak_acceleration", &GroundMotion::peak_acceleration,
                             "Largest magnitude of the ground acceleration [m/s^2], the PGA.")
      .def_property_readonly(
          "interpolation", [](const GroundMotion& g) { return name_of(g.interpolation()); }, "'linear' or 'constant'.")
      .def_property_readonly("name", &GroundMotion::name, "Where the motion comes from.")
      .def("scaled", &GroundMotion::scaled, py::arg("factor"),
           R"(The same motion with every acceleration multiplied by `factor` (finite; -1 mirrors it).)")
      .def("__len__", &GroundMotion::samples)
      .def("__repr__",
           [](const GroundMotion& g) {
             const auto dt = dt_of(g);
             return "<GroundMotion" + (g.name().empty() ? "" : " '" + g.name() + "'") + ": " +
                    std::to_string(g.samples()) + " samples" +
                    (dt ? ", dt = " + detail::shortest(*dt) + " s" : ", uneven times") + ", " +
                    detail::shortest(std::round(g.duration() * 1e3) / 1e3) + " s, peak " +
                    detail::shortest(std::round(g.peak_acceleration() * 1e4) / 1e4) + " m/s^2, " +
                    name_of(g.interpolation()) + ">";
           })
      .def(
          "__eq__", [](const GroundMotion& a, const GroundMotion& b) { return a == b; }, py::is_operator())
      .def("__hash__",
           [](const GroundMotion& g) {
             return py::hash(py::make_tuple(hash_of(g.acceleration()), name_of(g.interpolation()), g.name()));
           })
      .def(py::pickle(
          [](const GroundMotion& g) {
            py::array_t<double> samples(static_cast<py::ssize_t>(g.samples()), g.acceleration().data());
            const auto dt = dt_of(g);
            return py::make_tuple(samples, dt, dt ? py::object(py::none()) : py::object(times_of(g)),
                                  name_of(g.interpolation()), g.name());
          },
          [](const py::tuple& t) {
            return make(t[0], t[1].cast<std::optional<double>>(), t[2].cast<std::optional<py::object>>(),
                        t[3].cast<std::string>(), t[4].cast<std::string>());
          }));
}

}  // namespace stickslip::python
