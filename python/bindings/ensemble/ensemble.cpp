#include "stickslip/ensemble/ensemble.hpp"

#include <pybind11/stl.h>

#include <algorithm>
#include <utility>

#include "bindings.hpp"
#include "state.hpp"
#include "statistics/estimate.hpp"

namespace stickslip::python {
namespace {

template <Estimates (Ensemble::*figure)() const, std::vector<double> Estimates::*part>
py::array_t<double> statistic_by_time(const Ensemble& ensemble) {
  return array_of(std::move((ensemble.*figure)().*part));
}

/// Both components of values in the plane, as an array of shape (N, 2).
py::array_t<double> both_components(const std::vector<double>& along_axis, const std::vector<double>& transverse) {
  py::array_t<double> both({along_axis.size(), std::size_t{2}});
  auto values = both.mutable_unchecked<2>();
  for (py::ssize_t i = 0; i < both.shape(0); ++i) {
    values(i, 0) = along_axis[static_cast<std::size_t>(i)];
    values(i, 1) = transverse[static_cast<std::size_t>(i)];
  }
  both.attr("setflags")(py::arg("write") = false);
  return both;
}

template <Estimates (Ensemble::*statistic)(Component) const, std::vector<double> Estimates::*part>
py::array_t<double> components_by_time(const Ensemble& ensemble) {
  auto along_axis = std::move((ensemble.*statistic)(Component::axis).*part);
  if (!ensemble.in_plane()) return array_of(std::move(along_axis));
  return both_components(along_axis, (ensemble.*statistic)(Component::transverse).*part);
}

template <SideImpacts Impacts::*side, auto value>
py::object impacts_of(const Ensemble& ensemble) {
  const std::vector<Impacts> impacts = ensemble.impacts();
  std::vector<std::remove_cvref_t<decltype((impacts[0].*side).*value)>> values;
  values.reserve(impacts.size());
  for (const Impacts& one : impacts) values.push_back((one.*side).*value);
  return array_of(std::move(values));
}

/// Each entry is JSON, except the text of a user-defined source, which may be anything.
py::dict configuration_of(const Ensemble& ensemble) {
  const py::module_ json = py::module_::import("json");
  py::dict result;
  for (const auto& [name, text] : ensemble.configuration()) {
    try {
      result[name.c_str()] = json.attr("loads")(text);
    } catch (py::error_already_set& error) {
      if (!error.matches(PyExc_ValueError)) throw;
      result[name.c_str()] = text;
    }
  }
  return result;
}

/// First member and one past the last of each contiguous range of members.
std::vector<std::pair<std::uint64_t, std::uint64_t>> ranges_of(const Ensemble& ensemble) {
  const Ensemble::Parts& parts = ensemble.parts();
  const std::uint64_t size = Ensemble::block(parts.times.count);
  std::vector<std::pair<std::uint64_t, std::uint64_t>> pieces, ranges;
  for (const auto& [place, tally] : parts.tallies.nodes()) {
    std::uint64_t block = place.number << place.level;
    const std::uint64_t end = (place.number + 1) << place.level;
    for (auto cut = parts.cut.lower_bound(block); cut != parts.cut.end() && cut->first < end; ++cut) {
      pieces.emplace_back(block * size, cut->first * size + cut->second);
      block = cut->first + 1;
    }
    if (block < end) pieces.emplace_back(block * size, end * size);
  }
  std::ranges::sort(pieces);
  for (const auto& piece : pieces) {
    if (!ranges.empty() && ranges.back().second == piece.first)
      ranges.back().second = piece.second;
    else
      ranges.push_back(piece);
  }
  return ranges;
}

std::string repr_of_ensemble(const Ensemble& ensemble) {
  std::string seed;
  for (const auto& [name, text] : ensemble.configuration())
    if (name == "seed") seed = ", seed " + text;
  const EnsembleTimes& times = ensemble.parts().times;
  const std::string members = "<Ensemble: " + std::to_string(ensemble.members()) + " members" +
                              (ensemble.in_plane() ? " in the plane" : "") + seed + ", ";
  if (times.count == 0) return members + "motions of different durations>";
  return members + std::to_string(times.count) + " times to " +
         digits(static_cast<double>(times.count - 1) * times.dt) + " s>";
}

}  // namespace

void bind_ensemble(py::module_& m) {
  py::class_<Ensemble>(m, "Ensemble", R"(Statistics over the members of an ensemble, as `run_ensemble` returns them.

Every statistic has a standard error, from the scatter between members. All sums are computed in one pass, about means
(Pebay 2008), and merge in an order that the member numbers determine: the same members give identical bits on any
number of threads and in any parts that end on block boundaries.

Structures with a sliding interface (`has_floors`) have the statistics of the displacement of their interface, and those
of the peaks on their floors.

If ground motions differ in duration, `time` is empty, and statistics by time, stationary averages and the velocity
spectrum raise ValueError; peaks, residuals, quantiles and exceedances are always available.

Statistics by time have shape (T,), those by member shape (members,). Sliders in the plane (`in_plane`) have a
displacement vector r, with components along the axis of the ground motion and along its transverse direction: x is then
each of the two, with the shapes (T, 2) and (members, 2). Their peak is the largest |r|, their impacts on the circular
stop count as impacts forward, and they have no stationary averages, no velocity spectrum and no moments. Arrays are read-only and computed on access.
Ensembles with the same members and statistics are equal; they can be copied and pickled, but not hashed, because
`merge` changes them.)")
      .def_property_readonly("members", &Ensemble::members, "Number of members.")
      .def_property_readonly("in_plane", &Ensemble::in_plane, "Whether the sliders are in the plane.")
      .def_property_readonly("member_ranges", &ranges_of,
                             "The members: (first, one past the last) of each contiguous range.")
      .def_property_readonly(
          "block", [](const Ensemble& e) { return Ensemble::block(e.parts().times.count); },
          "Number of members in a block. Blocks are simulated and summed as a unit; parts begin at multiples of it.")
      .def_property_readonly(
          "configuration", &configuration_of,
          "Everything that determines the members, as a dict: slider, excitation, seed, times of the statistics.")
      .def_property_readonly(
          "time", [](const Ensemble& e) { return array_of(e.time()); },
          "Times of the statistics [s], from 0; empty if ground motions differ in duration.")
      .def_property_readonly("displacement_mean", &components_by_time<&Ensemble::displacement_mean, &Estimates::value>,
                             "Mean of x by time [m].")
      .def_property_readonly("displacement_mean_error",
                             &components_by_time<&Ensemble::displacement_mean, &Estimates::error>,
                             "Standard error [m].")
      .def_property_readonly("displacement_variance",
                             &components_by_time<&Ensemble::displacement_variance, &Estimates::value>,
                             "Variance of x about its mean by time, with the divisor members - 1 [m^2].")
      .def_property_readonly("displacement_variance_error",
                             &components_by_time<&Ensemble::displacement_variance, &Estimates::error>,
                             "Standard error [m^2], from the fourth moment.")
      .def_property_readonly("covariance", &components_by_time<&Ensemble::covariance, &Estimates::value>,
                             "Covariance of x and x' by time, with the divisor members - 1 [m^2/s].")
      .def_property_readonly("covariance_error", &components_by_time<&Ensemble::covariance, &Estimates::error>,
                             "Standard error [m^2/s], from the fourth moments.")
      .def_property_readonly(
          "displacement_covariance", &statistic_by_time<&Ensemble::displacement_covariance, &Estimates::value>,
          R"(Covariance of the two components of r by time, with the divisor members - 1 [m^2], shape (T,).

ValueError for sliders on one axis.)")
      .def_property_readonly("displacement_covariance_error",
                             &statistic_by_time<&Ensemble::displacement_covariance, &Estimates::error>,
                             "Standard error [m^2], from the fourth moments.")
      .def_property_readonly(
          "velocity_covariance", &statistic_by_time<&Ensemble::velocity_covariance, &Estimates::value>,
          R"(Covariance of the two components of r' by time, with the divisor members - 1 [m^2/s^2], shape (T,).

ValueError for sliders on one axis.)")
      .def_property_readonly("velocity_covariance_error",
                             &statistic_by_time<&Ensemble::velocity_covariance, &Estimates::error>,
                             "Standard error [m^2/s^2], from the fourth moments.")
      .def_property_readonly("velocity_mean", &components_by_time<&Ensemble::velocity_mean, &Estimates::value>,
                             "Mean of x' by time [m/s].")
      .def_property_readonly("velocity_mean_error", &components_by_time<&Ensemble::velocity_mean, &Estimates::error>,
                             "Standard error [m/s].")
      .def_property_readonly("velocity_variance", &components_by_time<&Ensemble::velocity_variance, &Estimates::value>,
                             "Variance of x' about its mean by time, with the divisor members - 1 [m^2/s^2].")
      .def_property_readonly("velocity_variance_error",
                             &components_by_time<&Ensemble::velocity_variance, &Estimates::error>,
                             "Standard error [m^2/s^2], from the fourth moment.")
      .def_property_readonly(
          "ground_acceleration_mean", &statistic_by_time<&Ensemble::ground_acceleration_mean, &Estimates::value>,
          "Mean of the ground acceleration by time [m/s^2]; ValueError if the run did not request it.")
      .def_property_readonly("ground_acceleration_mean_error",
                             &statistic_by_time<&Ensemble::ground_acceleration_mean, &Estimates::error>,
                             "Standard error [m/s^2].")
      .def_property_readonly(
          "ground_acceleration_variance",
          &statistic_by_time<&Ensemble::ground_acceleration_variance, &Estimates::value>,
          R"(Variance of the ground acceleration about its mean by time, with the divisor members - 1 [m^2/s^4].

Where the acceleration jumps, the variance after the jump. ValueError if the run did not request it.)")
      .def_property_readonly("ground_acceleration_variance_error",
                             &statistic_by_time<&Ensemble::ground_acceleration_variance, &Estimates::error>,
                             "Standard error [m^2/s^4], from the fourth moment.")
      .def_property_readonly(
          "peak", [](const Ensemble& e) { return array_of(e.peak()); },
          R"(Largest |x|, in the plane |r|, of each member, also between samples, ordered by member [m].

ValueError above 2^24 = 16,777,216 members: their peaks are counted in bins 0.1 % wide, which `quantile` and
`exceedance` use.)")
      .def_property_readonly(
          "residual",
          [](const Ensemble& e) {
            return e.in_plane() ? both_components(e.residual(), e.residual(Component::transverse))
                                : array_of(e.residual());
          },
          "Last x of each member [m]; in the plane both components, shape (members, 2). ValueError as for `peak`.")
      .def_property_readonly("has_floors", &Ensemble::has_floors,
                             "Whether the members are structures with a sliding interface.")
      .def_property_readonly("peak_floor_acceleration", &Ensemble::peak_floor_acceleration,
                             R"(Largest absolute acceleration on each floor of each member, as `FloorPeaks` [m/s^2].

Over all time, also between samples. ValueError for sliders, and as for `peak`.)")
      .def_property_readonly("peak_floor_drift", &Ensemble::peak_floor_drift,
                             R"(Largest drift of each floor relative to the one below, as `FloorPeaks` [m].

ValueError as for `peak_floor_acceleration`, and if the `influence` of a structure is not ones.)")
      .def_property_readonly(
          "peak_base_acceleration", [](const Ensemble& e) { return array_of(e.peak_base_acceleration()); },
          R"(Largest absolute acceleration of what the structure stands on, by member [m/s^2].

That of its sliding base, or of the ground below an `EquipmentOnFloor` and a decoupled `FlexibleSlope`. ValueError as for
`peak_floor_acceleration`.)")
      .def_property_readonly(
          "peak_base_shear", [](const Ensemble& e) { return array_of(e.peak_base_shear()); },
          R"(Largest sum of the inertia forces of the structure, by member.

[N] where masses are in kg; with `Structure.from_modes` per total mass [m/s^2]. ValueError as for
`peak_floor_acceleration`.)")
      .def_property_readonly(
          "moments", &Ensemble::moments,
          "Means, variances and covariance by time and the growth rate, as Moments, like those of theories.")
      .def_property_readonly("stationary", &Ensemble::stationary,
                             "Averages over the central half of the motions, as Stationary.")
      .def_property_readonly(
          "velocity_spectrum", &Ensemble::velocity_spectrum,
          "Spectrum of the velocity, as VelocitySpectrum; ValueError if the run did not request it, or without times.")
      .def(
          "quantile",
          [](const Ensemble& self, const py::object& probability, double confidence) -> py::object {
            const Numbers shares = to_numbers(probability, "quantile: probability");
            if (shares.ndim() == 0) return py::cast(self.quantile(*shares.data(), confidence));
            py::list intervals;
            for (const double share : to_vector(shares, "quantile: probability"))
              intervals.append(self.quantile(share, confidence));
            return intervals;
          },
          py::arg("probability"), py::arg("confidence") = 0.95,
          R"(Quantile of the peaks: the value that a fraction of the members does not exceed.

Parameters
----------
probability : float or array_like, shape (P,)
    The fraction, in (0, 1).
confidence : float, optional
    Probability that the true quantile lies between the bounds, in (0, 1).

Returns
-------
Interval or list of Interval
    Quantiles [m], one for each probability. The bounds are order statistics, by the binomial law; 0 and infinity if
    there are too few members.

Raises
------
ValueError
    A probability or confidence out of range; fewer than two members.)")
      .def("exceedance", &Ensemble::exceedance, py::arg("level"), py::arg("confidence") = 0.95,
           R"(Fraction of members whose peak exceeds a level.

A slider with stops reaches a stop but never exceeds it. At the smallest gap of a stop, the result is therefore the
fraction of members that hit a stop or exceed the level: with stops on both sides `impact_probability`, with one stop
also the members that move that far away from it. Larger levels are rejected.

Parameters
----------
level : float
    Displacement [m], finite and at least 0; at most the smallest gap of a stop of any member.
confidence : float, optional
    Probability that the true value lies between the bounds, in (0, 1).

Returns
-------
Interval
    From 0 to 1, with the bounds of Clopper and Pearson (1934), which hold for any number of members.

Raises
------
ValueError
    A level or confidence out of range, such as a level beyond a stop; fewer than two members.)")
      .def_property_readonly(
          "impact_probability", [](const Ensemble& e) { return e.impact_probability(); },
          R"(Fraction of members that hit a stop, on either side, with 95 % bounds (`Interval`).

The bounds are those of Clopper and Pearson (1934), which hold for any number of members. ValueError if no member has
stops; with fewer than two members.)")
      .def_property_readonly(
          "impact_probability_forward", [](const Ensemble& e) { return e.impact_probability(Direction::forward); },
          "Fraction of members that hit the stop forward; ValueError also if no member has a stop there.")
      .def_property_readonly(
          "impact_probability_backward", [](const Ensemble& e) { return e.impact_probability(Direction::backward); },
          "Fraction of members that hit the stop backward; ValueError also if no member has a stop there.")
      .def_property_readonly("impacts_forward", &impacts_of<&Impacts::forward, &SideImpacts::count>,
                             R"(Number of impacts on the stop forward, bounces included, by member.

ValueError if no member has stops; for more than 16,777,216 members.)")
      .def_property_readonly("impacts_backward", &impacts_of<&Impacts::backward, &SideImpacts::count>,
                             "Number of impacts on the stop backward by member; ValueError as for `impacts_forward`.")
      .def_property_readonly("impact_speed_forward", &impacts_of<&Impacts::forward, &SideImpacts::speed>,
                             "Largest speed just before an impact forward [m/s], by member; 0 without impacts. "
                             "ValueError as for `impacts_forward`.")
      .def_property_readonly("impact_speed_backward", &impacts_of<&Impacts::backward, &SideImpacts::speed>,
                             "Largest speed just before an impact backward [m/s], by member; 0 without impacts. "
                             "ValueError as for `impacts_forward`.")
      .def_property_readonly("airborne", &Ensemble::airborne,
                             R"(Number of members that end in flight, under vertical motion without `settle`.

Their residuals are x at the end of the ground motion.)")
      .def(
          "merge",
          [](Ensemble& self, const Ensemble& other) {
            const py::gil_scoped_release released;
            self.merge(other);
          },
          py::arg("other"),
          R"(Merge the members of another part of the same ensemble into this one.

Parameters
----------
other : Ensemble
    Part with the same configuration and other members; does not change.

Raises
------
ValueError
    Different configurations (names the difference), or common members; nothing changes then.

Notes
-----
Parts that begin at multiples of `block` can be merged in any order; the result has the same bits as a single run.)")
      .def(
          "save",
          [](const py::object& self, const py::object& file) {
            py::module_::import("stickslip.ensemble.files").attr("save")(self, file);
          },
          py::arg("file"),
          R"(Save the ensemble to a file, whole or not at all.

Parameters
----------
file : path-like
    A NumPy archive (.npz) without pickled objects; no suffix is added. Symbolic links are followed; an existing file
    keeps its mode, and its owner where permitted.

Raises
------
OSError
    The folder is missing or cannot be written; the file is read-only (except for root) or not a regular file.

Notes
-----
Files take some 100 bytes for each time, 16 for each member and 32 more for a member with stops.)")
      .def_static(
          "load",
          [](const py::object& file) { return py::module_::import("stickslip.ensemble.files").attr("load")(file); },
          py::arg("file"),
          R"(Load a saved ensemble, identical to the last bit.

Parameters
----------
file : path-like

Returns
-------
Ensemble

Raises
------
ValueError
    The file is truncated or damaged (CRC-32 protects every byte), is not an ensemble, or holds impossible values, such
    as a negative peak. Loading takes at most a few times the memory of the file.
OSError
    The file does not exist, cannot be read, or is not a regular file.)")
      .def("plot", plot_in("plot_ensemble", "figure"), py::kw_only(), py::arg("figure") = py::none(),
           py::arg("title") = py::none(),
           R"(Plot the variances of displacement and velocity, the distribution of the peaks, and the velocity spectrum.

Needs matplotlib (`pip install stickslip[plot]`). Takes `figure`, a matplotlib Figure or SubFigure to draw in, and
`title`. Returns the figure.)")
      .def("plot_floors", plot_in("plot_floors", "figure"), py::kw_only(), py::arg("figure") = py::none(),
           py::arg("title") = py::none(),
           R"(Plot the peak accelerations and drifts of the floors by height, with quantiles.

Needs matplotlib (`pip install stickslip[plot]`). Takes `figure`, a matplotlib Figure or SubFigure to draw in, and
`title`. Returns the figure. ValueError for sliders, for structures without floors, and with fewer than two members.)")
      .def(
          "to_dataframe",
          [](const py::object& self, const std::string& by) {
            return py::module_::import("stickslip.ensemble.tables").attr("to_dataframe")(self, by);
          },
          py::arg("by") = "member",
          R"(Convert the members, or the statistics by time, to a pandas DataFrame.

Parameters
----------
by : {'member', 'time'}
    A row for each member: `peak`, `residual` and, with stops, `impacts_forward`, `impact_speed_forward`,
    `impacts_backward`, `impact_speed_backward`; of structures also `peak_base_acceleration`, `peak_base_shear`,
    `floor_1_peak_acceleration`, `floor_1_peak_drift` and so on. Or a row for each time: `displacement_mean`, `displacement_variance`,
    `covariance`, `velocity_mean`, `velocity_variance`, and if they were requested `ground_acceleration_mean` and
    `ground_acceleration_variance`, each followed by its standard error, as `displacement_mean_error`.

Returns
-------
pandas.DataFrame
    Indexed by `member` (its number) or `time` [s]. `frame.attrs["units"]` has the units by name.

Raises
------
ValueError
    Another `by`; by time, if ground motions differ in duration or there are fewer than two members; by member, more
    than 16,777,216 members.
ImportError
    pandas is missing.)")
      .def(
          "to_xarray",
          [](const py::object& self) {
            return py::module_::import("stickslip.ensemble.tables").attr("to_xarray")(self);
          },
          R"(Convert the members and the statistics by time to an xarray Dataset.

Returns
-------
xarray.Dataset
    The columns of both forms of `to_dataframe`, over the coordinates `member` and `time`; without `time` where there
    are no statistics by time. The attribute `configuration` is JSON.

Raises
------
ImportError
    xarray is missing.)")
      .def(
          "to_csv",
          [](const py::object& self, const py::object& path, const std::string& by) {
            return py::module_::import("stickslip.ensemble.tables").attr("to_csv")(self, path, by);
          },
          py::arg("path"), py::arg("by") = "member",
          R"(Write the rows of `to_dataframe` to a CSV file, whole or not at all.

Parameters
----------
path : path-like
    An existing file is replaced.
by : {'member', 'time'}

Returns
-------
Path

Raises
------
ValueError
    As for `to_dataframe`.
OSError
    The file cannot be written.)")
      .def(
          "to_json",
          [](const py::object& self) { return py::module_::import("stickslip.ensemble.tables").attr("to_json")(self); },
          R"(Convert the ensemble to one JSON document.

Returns
-------
str
    An object: `stickslip`, `configuration`, `members`, `airborne`, `units`; `quantiles` of the peak, each with
    `probability`, `value`, `low` and `high`; with stops `impact_probability` (`value`, `low`, `high`, also `_forward`
    and `_backward` where there are stops); `by_member` and `by_time`, the columns of `to_dataframe` as lists. Numbers
    read back to the same double; NaN and infinity are null.)")
      .def("_repr_html_",
           [](const py::object& self) { return py::module_::import("stickslip._tables").attr("ensemble_html")(self); })
      .def_property_readonly(
          "remark",
          [](const py::object& self) { return py::module_::import("stickslip._tables").attr("ensemble_remark")(self); },
          R"(A sentence about limits of the result; empty if there are none (str).

Gaussian motions without the line at zero frequency that their spectrum has: over their whole period the ground comes
back, and displacements drift less than a theory of that spectrum predicts.)")
      .def("__repr__", &repr_of_ensemble)
      .def(
          "__eq__", [](const Ensemble& a, const Ensemble& b) { return a == b; }, py::is_operator())
      .def(py::pickle(&state_of, &ensemble_of));
}

}  // namespace stickslip::python
