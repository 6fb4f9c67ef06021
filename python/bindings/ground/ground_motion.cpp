#include <pybind11/stl.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "ground/plausibility.hpp"
#include "in_python.hpp"
#include "parts.hpp"
#include "statistics/estimate.hpp"

namespace stickslip::python {
namespace {

GroundMotion make(const py::object& acceleration, std::optional<double> dt, const std::optional<py::object>& times,
                  const std::string& interpolation, std::string name, const std::string& units,
                  const std::optional<py::object>& transverse, const std::optional<py::object>& vertical,
                  std::string orientation) {
  if (dt.has_value() == times.has_value())
    throw std::invalid_argument(std::string("GroundMotion: give either dt or times, got ") + (dt ? "both" : "neither"));
  const double unit = acceleration_unit(units);
  const auto samples = [&](const py::object& values, const char* array) {
    const std::string what = std::string("GroundMotion: ") + array;
    const py::object numbers = without_unit(values, what, "m/s^2");
    if (!numbers.is(values) && units != "m/s^2")
      throw std::invalid_argument("GroundMotion: units is for plain numbers, got a quantity and units='" + units + "'");
    std::vector<double> result = to_vector(numbers, what);
    if (unit != 1)
      for (double& n : result) n *= unit;
    return result;
  };
  const Interpolation between = interpolation_of(interpolation, "GroundMotion");
  std::vector<double> axis = samples(acceleration, "acceleration");
  const GroundMotion motion =
      (dt ? GroundMotion(std::move(axis), *dt, between, std::move(name))
          : GroundMotion(std::move(axis), to_vector(*times, "GroundMotion: times", "s"), between, std::move(name)))
          .with_orientation(std::move(orientation));
  if (!transverse && !vertical) return motion;
  const auto other = [&](const std::optional<py::object>& values, const char* array) {
    std::vector<double> result;
    if (values) result = samples(*values, array);
    if (values && result.empty())
      throw std::invalid_argument(std::string("GroundMotion: ") + array +
                                  " must have as many samples as acceleration, " + std::to_string(motion.samples()) +
                                  ", got 0");
    return result;
  };
  return motion.with_components(other(transverse, "transverse"), other(vertical, "vertical"));
}

// The step of times that begin at 0 and are even to 1e-9 of a step, which is the round-off of sums of many steps.
std::optional<double> even_step(const py::object& times, std::size_t samples) {
  const std::vector<double> t = to_vector(times, "GroundMotion: times", "s");
  if (t.size() != samples || samples < 2 || t[0] != 0 || !(t.back() > 0) || std::isinf(t.back())) return std::nullopt;
  const auto largest_error = [&t](double dt) {
    double largest = 0;
    for (std::size_t i = 0; i < t.size(); ++i)
      largest = std::max(largest, std::abs(t[i] - static_cast<double>(i) * dt));
    return largest;
  };
  const double mean = t.back() / static_cast<double>(t.size() - 1);
  const double dt = largest_error(t[1]) < largest_error(mean) ? t[1] : mean;  // one of them gave the times
  return largest_error(dt) <= 1e-9 * dt ? std::optional(dt) : std::nullopt;
}

// `make`, with a warning about what no record would be.
GroundMotion made(const py::object& acceleration, std::optional<double> dt, const std::optional<py::object>& times,
                  const std::string& interpolation, std::string name, const std::string& units,
                  const std::optional<py::object>& transverse, const std::optional<py::object>& vertical,
                  std::string orientation) {
  std::optional<double> step = dt;
  if (times && !dt && py::hasattr(acceleration, "__len__")) step = even_step(*times, py::len(acceleration));
  const GroundMotion motion = make(acceleration, step, step && !dt ? std::nullopt : times, interpolation,
                                   std::move(name), units, transverse, vertical, std::move(orientation));
  warn_if_implausible(motion, "GroundMotion", 1, false);
  return motion;
}

Component component_of(const std::string& name) {
  for (const Component component : {Component::axis, Component::transverse, Component::vertical})
    if (name == name_of(component)) return component;
  throw std::invalid_argument("GroundMotion: component must be 'axis', 'transverse' or 'vertical', got '" + name + "'");
}

// A component as a read-only array, or None.
template <std::span<const double> (GroundMotion::*member)() const noexcept>
py::object samples_of(const py::object& self) {
  const std::span<const double> samples = (self.cast<const GroundMotion&>().*member)();
  return samples.empty() ? py::object(py::none()) : py::object(view(samples, self));
}

py::array_t<double> times_of(const GroundMotion& motion) {
  py::array_t<double> times(static_cast<py::ssize_t>(motion.samples()));
  double* t = times.mutable_data();
  for (std::size_t i = 0; i < motion.samples(); ++i) t[i] = motion.time(i);
  return times;
}

GroundMotion from_obspy(const py::object& trace, const std::optional<std::string>& units,
                        const std::optional<std::string>& name) {
  const GroundMotion motion =
      py::module_::import("stickslip.motions.traces").attr("motion_of")(trace, units, name).cast<GroundMotion>();
  warn_if_implausible(motion, "GroundMotion.from_obspy");
  return motion;
}

std::optional<double> dt_of(const GroundMotion& motion) {
  return std::isnan(motion.dt()) ? std::nullopt : std::optional(motion.dt());
}

}  // namespace

void bind_ground_motion(py::module_& m) {
  py::class_<GroundMotion> type(m, "GroundMotion", R"(The acceleration history n(t) of the ground.

`acceleration` is the component along the axis of the slider. A motion may also have the other horizontal component and
the vertical one. Peaks, integrals and intensity measures are those along the axis; `component` selects another
component.

Motions with the same samples, dt or times, interpolation, name and orientation are equal; they can be hashed, copied
and pickled.

N samples make N - 1 segments; the motion lasts from the first time to the last.

Parameters
----------
acceleration : array_like, shape (N,)
    n at the samples [m/s^2]; N at least 2, finite, at most 1e100 in magnitude. Copied.
dt : float, optional
    Time between samples [s], positive: the times are 0, dt, 2 dt, ... Give dt or times.
times : array_like, shape (N,), optional
    Times of the samples [s], finite and increasing. With 'constant', successive times may be equal. Times that begin
    at 0 and are even to 1e-9 of a step become `dt`, which is faster.
interpolation : {'linear', 'constant'}, optional
    A straight line between samples (thesis 4.56), or a constant value until the next time; the last value then marks
    the end and does not act.
name : str, optional
    Name of the motion, shown in plots.
units : str, optional
    Unit of the given accelerations: 'm/s^2', 'g', 'cm/s^2', 'gal', 'mm/s^2', 'ft/s^2', 'in/s^2'. The motion stores
    m/s^2.
transverse : array_like, shape (N,), optional
    The horizontal component across the axis, at the same times. It does not act on sliders.
vertical : array_like, shape (N,), optional
    The vertical component, positive upward, at the same times. `integrate` includes it in the normal force; use
    `component('axis')` to exclude it.
orientation : str, optional
    Direction of the axis: an azimuth in degrees clockwise from north, such as 'N28W' or '332', or 'up'. The transverse
    component then points 90 degrees clockwise from it. Not checked.

Raises
------
ValueError
    An invalid value; the message names it and its index.

Warns
-----
PlausibilityWarning
    With 100 samples or more: the largest acceleration is not from 1e-5 to 3 g, nor zero; or the mean is more than
    0.5 % of it in a motion that begins and ends at rest, as a record does: ten samples at either end within 5 % of the
    peak of the mean.

Notes
-----
`2 * motion`, `motion / 2` and `-motion` return motions `scaled` by the factor. Methods that return a motion treat all
components alike. `np.asarray(motion)` is `motion.acceleration`. `motion[a:b]` is the part from sample a to sample
b - 1, with times from 0; `motion.cut(begin, end)` takes seconds. A sample is `motion.acceleration[i]`.)");
  type.attr("__iter__") = py::none();         // it has parts, but no items
  type.attr("__array_ufunc__") = py::none();  // NumPy factors then use the operators of the motion
  const auto with_arguments = [](auto&& define) {
    define(py::arg("acceleration"), py::arg("dt") = py::none(), py::kw_only(), py::arg("times") = py::none(),
           py::arg("interpolation") = "linear", py::arg("name") = "", py::arg("units") = "m/s^2",
           py::arg("transverse") = py::none(), py::arg("vertical") = py::none(), py::arg("orientation") = "");
  };
  // For what was checked when it was read.
  with_arguments([&](auto&&... arguments) { m.def("_ground_motion", &make, arguments...); });
  with_arguments([&](auto&&... arguments) { type.def(py::init(&made), arguments...); });
  type.def_static("from_obspy", &from_obspy, py::arg("trace"), py::kw_only(), py::arg("units") = py::none(),
                  py::arg("name") = py::none(),
                  R"(Convert an ObsPy trace, or a stream of the components of one station, to a ground motion.

Parameters
----------
trace : obspy.Trace or obspy.Stream
    One component of acceleration without gaps, as after `trace.remove_response(inventory, output="ACC")`; the samples
    are copied. Counts are multiplied by `trace.stats.calib` unless it is 1. The last letter of a channel code of three
    letters is the orientation: N, E, or Z for up; so are the codes NS, EW and UD. A stream of one trace is that trace.
    A stream of several holds the components of one station, as for `read_station`; the axis is the first horizontal
    component.
units : str, optional
    Unit of the samples, as for the constructor. Default: the one that the trace states, else m/s^2.
name : str, optional
    Default: the id of the trace; for a station, that of the trace along the axis.

Returns
-------
GroundMotion
    Linear between samples; times start at 0.

Raises
------
TypeError
    An object that is neither a trace nor a stream.
ValueError
    Velocity, displacement or counts, by the processing that the trace states, its unit, its channel code (HHZ, BHZ) or
    its type of samples; the message says what to do. Also a gap, several segments of one channel, a sample that is not
    finite; `units` other than the stated ones; a stream that is not one station, as for `read_station`.

Warns
-----
PlausibilityWarning
    As for `read_record`.)")
      .def_property_readonly(
          "acceleration",
          [](const py::object& self) { return view(self.cast<const GroundMotion&>().acceleration(), self); },
          "Ground acceleration along the axis at the samples [m/s^2], shape (N,); read-only, not copied.")
      .def_property_readonly(
          "transverse", &samples_of<&GroundMotion::transverse>,
          "The horizontal component across the axis [m/s^2], shape (N,), read-only; None if missing.")
      .def_property_readonly("vertical", &samples_of<&GroundMotion::vertical>,
                             "The vertical component, positive upward [m/s^2], shape (N,), read-only; None if missing.")
      .def(
          "component", [](const GroundMotion& g, const std::string& which) { return g.component(component_of(which)); },
          py::arg("which"),
          R"(Extract one component as a motion along the axis.

Parameters
----------
which : {'axis', 'transverse', 'vertical'}
    A component that the motion has.)")
      .def_property_readonly("time", &times_of, "Times of the samples [s], shape (N,).")
      .def_property_readonly("dt", &dt_of, "Time between samples [s]; None if the times are uneven.")
      .def_property_readonly("duration", &GroundMotion::duration, "Time from the first sample to the last [s].")
      .def_property_readonly("peak_acceleration", &GroundMotion::peak_acceleration,
                             "Largest magnitude of the ground acceleration along the axis [m/s^2], the PGA.")
      .def_property_readonly(
          "interpolation", [](const GroundMotion& g) { return name_of(g.interpolation()); }, "'linear' or 'constant'.")
      .def_property_readonly("name", &GroundMotion::name, "Name of the motion.")
      .def_property_readonly("orientation", &GroundMotion::orientation,
                             "Direction of the axis, such as 'N28W', '332' (an azimuth) or 'up'; '' if unknown.")
      .def("scaled", &GroundMotion::scaled, py::arg("factor"),
           R"(Multiply all accelerations by `factor` (finite).

A negative factor reverses the horizontal components but not the vertical one, which is multiplied by the magnitude.)")
      .def(
          "scaled_to",
          [](const GroundMotion& motion, std::optional<double> pga_g, std::optional<double> arias,
             std::optional<double> pgv, std::optional<double> sa_g, std::optional<double> period, double damping) {
            if (sa_g.has_value() != period.has_value())
              throw std::invalid_argument("GroundMotion: scaled_to needs sa_g and period together, got one of them");
            const std::string who = "GroundMotion.scaled_to";
            check_unit("ground acceleration in g", who, "pga_g", pga_g);
            check_unit("ground acceleration in g", who, "sa_g", sa_g);
            check_unit("ground velocity", who, "pgv", pgv);
            check_unit("Arias intensity", who, "arias", arias);
            check_unit("period", who, "period", period);
            if (pga_g) *pga_g *= standard_gravity;
            if (!sa_g) return scaled_to(motion, {pga_g, arias, pgv});
            if (pga_g || arias || pgv)
              throw std::invalid_argument(
                  "GroundMotion: scaled_to needs one of pga_g, arias, pgv and sa_g, got several");
            detail::require(std::isfinite(*sa_g) && *sa_g > 0,
                            "GroundMotion: scaled_to needs a positive and finite sa_g", *sa_g, "g");
            if (!(motion.peak_acceleration() > 0))
              throw std::invalid_argument(
                  "GroundMotion: scaled_to needs a motion with an acceleration, got zeros only");
            const double own = response_spectrum(motion, {*period}, {damping}).values[0];
            return motion.scaled(*sa_g * standard_gravity / own);
          },
          py::kw_only(), py::arg("pga_g") = py::none(), py::arg("arias") = py::none(), py::arg("pgv") = py::none(),
          py::arg("sa_g") = py::none(), py::arg("period") = py::none(), py::arg("damping") = 0.05,
          R"(Scale the motion by a positive factor, to a given PGA, Arias intensity, PGV or spectral acceleration.

The target is that of the component along the axis; all components are scaled.

Parameters
----------
pga_g : float, optional
    Peak acceleration [g], positive. Give exactly one of `pga_g`, `arias`, `pgv` and `sa_g`.
arias : float, optional
    Arias intensity [m/s], positive.
pgv : float, optional
    Peak ground velocity [m/s], positive; from rest at the first sample, without baseline correction.
sa_g : float, optional
    Pseudo-acceleration at `period` and `damping` [g], positive.
period : float, optional
    Period [s] for `sa_g`, 0 (the PGA) or from 1e-6 to 1e6.
damping : float, optional
    Damping ratio for `sa_g`, at least 0 and below 2.

Raises
------
ValueError
    No or several targets; one that is not positive and finite; `sa_g` without `period`, or the reverse; a motion of
    zeros.

Warns
-----
PlausibilityWarning
    A pga_g or sa_g of 6 or more, which may be in m/s^2; a pgv of 10 m/s or more, or an arias of 100 m/s or more, which may
    be in cm/s; a period of 60 s or more, which may be in ms.)")
      .def("resampled", &resampled, py::arg("dt"),
           R"(Resample the motion at 0, dt, 2 dt, ... after its first sample.

Values are interpolated as the motion is between samples. There is no filter: a shorter step adds no information, and a
longer step aliases higher frequencies. If the duration is not a multiple of dt, the remainder at the end is dropped.
Times start at 0.

Parameters
----------
dt : float
    Time between samples [s], positive, at most the duration.)")
      .def("cut", &cut, py::arg("begin"), py::arg("end"),
           R"(Cut out the part of the motion from `begin` to `end`.

If there is no sample at an end, the value is interpolated. Times start at 0; even times stay even if both ends are
samples.

Parameters
----------
begin, end : float
    Times of the motion [s], begin < end.)")
      .def("rotated", &rotated, py::arg("degrees"),
           R"(Rotate the horizontal axes.

The new axis is at `degrees` from the old one toward the transverse one: n' = n cos a + t sin a, t' = t cos a - n sin a,
where n is along the axis, t across it, and a is the angle. The vertical component does not change. Rotations by
multiples of 90 degrees are exact. An orientation that is an azimuth rotates too; any other is dropped.

Parameters
----------
degrees : float
    Angle, finite.

Raises
------
ValueError
    A motion without a transverse component; an angle that is not finite.)")
      .def("detrended", &detrended, py::arg("order") = 0,
           R"(Remove the polynomial trend fitted by least squares over time.

Order 0 removes the mean, after which the ground velocity ends at zero; order 1 a straight line. The fit is exact for
linear and constant interpolation. A fraction of about (dt / duration)^2 remains of a trend that is curved between
samples, or inclined with constant interpolation.

Parameters
----------
order : int, optional
    From 0 to 10.)")
      .def_property_readonly(
          "velocity", [](const GroundMotion& g) { return array_of(ground_history(g).velocity); },
          "Ground velocity along the axis [m/s], shape (N,): the exact integral, from rest; recomputed on each access.")
      .def_property_readonly(
          "displacement", [](const GroundMotion& g) { return array_of(ground_history(g).displacement); },
          "Ground displacement along the axis [m], shape (N,): exact integral, from rest; recomputed on each access.")
      .def("plot", plot_in("plot_ground_motion", "ax"), py::kw_only(), py::arg("ax") = py::none(),
           py::arg("title") = py::none(),
           R"(Plot the acceleration [g] over time.

Needs matplotlib (`pip install stickslip[plot]`). Draws into `ax=`, a matplotlib Axes, or into a new figure; `title=`
replaces the name. Returns the axes that were given, otherwise the new Figure.)")
      .def("to_dataframe", in_python("stickslip.motions.tables", "motion_to_dataframe"),
           R"(Convert the histories to a pandas DataFrame over the index `time` [s].

The columns are `acceleration`, `transverse` and `vertical` [m/s^2] if the motion has them, `velocity` [m/s] and
`displacement` [m] of the ground; `df.attrs["units"]` has the units. ImportError without pandas.)")
      .def("to_csv", csv_in("stickslip.motions.tables", "motion_to_csv"), py::arg("path"),
           csv_doc("Write times and accelerations to a CSV file that `read_record` reads, whole or not at all.",
                   R"(A line of names with units, then one line per sample: time [s] and the components [m/s^2] that the
motion has. `read_record` returns the same samples and the same time step or times, one component per motion. The file
does not contain the name, the orientation or the interpolation: use `pickle` or a `Suite` to keep all.)")
               .c_str())
      .def("to_json", in_python("stickslip.motions.tables", "motion_to_json"),
           R"(The motion as one JSON object (str): name, orientation, interpolation, units, times and components.

Every number reads back as the same double.)")
      .def("_repr_html_", in_python("stickslip._html", "motion_html"))
      .def(
          "__array__",
          [](const py::object& self, const py::object& dtype, const py::object& copy) {
            // The acceleration is a view of memory that the motion owns: read-only, and of type double.
            const py::array samples = view(self.cast<const GroundMotion&>().acceleration(), self);
            if (dtype.is_none() || py::dtype::from_args(dtype).equal(samples.dtype()))
              return copy.is_none() || !copy.cast<bool>() ? py::object(samples) : py::object(samples.attr("copy")());
            if (!copy.is_none() && !copy.cast<bool>())
              throw std::invalid_argument("GroundMotion: samples are float64; another dtype needs a copy");
            return py::object(samples.attr("astype")(dtype));
          },
          py::arg("dtype") = py::none(), py::arg("copy") = py::none(),
          "The ground acceleration along the axis [m/s^2], as `acceleration`.")
      .def(
          "__mul__", [](const GroundMotion& g, double factor) { return g.scaled(factor); }, py::is_operator())
      .def(
          "__rmul__", [](const GroundMotion& g, double factor) { return g.scaled(factor); }, py::is_operator())
      .def(
          "__truediv__",
          [](const GroundMotion& g, double divisor) {
            detail::require(std::isfinite(divisor) && divisor != 0,
                            "GroundMotion: a divisor must be finite and not zero", divisor);
            return g.scaled(1 / divisor);
          },
          py::is_operator())
      .def("__neg__", [](const GroundMotion& g) { return g.scaled(-1); })
      .def("__len__", &GroundMotion::samples)
      .def("__getitem__",
           [](const py::object& self, const py::object& index) {
             return py::module_::import("stickslip.motions.pieces").attr("piece")(self, index);
           })
      .def("__repr__",
           [](const GroundMotion& g) {
             const auto dt = dt_of(g);
             return "<GroundMotion" + (g.name().empty() ? "" : " '" + g.name() + "'") + ": " +
                    std::to_string(g.samples()) + " samples" +
                    (dt ? ", dt = " + digits(*dt) + " s" : ", uneven times") + ", " + digits(g.duration()) +
                    " s, peak " + digits(g.peak_acceleration()) + " m/s^2 (" +
                    digits(g.peak_acceleration() / standard_gravity) + " g), " + name_of(g.interpolation()) +
                    (g.has_transverse() || g.has_vertical() ? ", with " : "") +
                    (g.has_transverse() ? "transverse" : "") + (g.has_transverse() && g.has_vertical() ? " and " : "") +
                    (g.has_vertical() ? "vertical" : "") + ">";
           })
      .def(
          "__eq__", [](const GroundMotion& a, const GroundMotion& b) { return a == b; }, py::is_operator())
      .def("__hash__",
           [](const GroundMotion& g) {
             return py::hash(py::make_tuple(hash_of(g.acceleration()), hash_of(g.transverse()), hash_of(g.vertical()),
                                            name_of(g.interpolation()), g.name()));
           })
      .def(py::pickle(
          [](const GroundMotion& g) {
            const auto array = [](std::span<const double> samples) -> py::object {
              if (samples.empty()) return py::none();
              return py::array_t<double>(static_cast<py::ssize_t>(samples.size()), samples.data());
            };
            const auto dt = dt_of(g);
            return py::make_tuple(array(g.acceleration()), dt, dt ? py::object(py::none()) : py::object(times_of(g)),
                                  name_of(g.interpolation()), g.name(), array(g.transverse()), array(g.vertical()),
                                  g.orientation());
          },
          [](const py::tuple& t) {
            return make(t[0], t[1].cast<std::optional<double>>(), t[2].cast<std::optional<py::object>>(),
                        t[3].cast<std::string>(), t[4].cast<std::string>(), "m/s^2",
                        t[5].cast<std::optional<py::object>>(), t[6].cast<std::optional<py::object>>(),
                        t[7].cast<std::string>());
          }));
}

}  // namespace stickslip::python
