#include <pybind11/stl.h>

#include <array>
#include <exception>
#include <utility>

#include "bindings.hpp"
#include "ground/plausibility.hpp"

namespace stickslip::python {
namespace {

// motion, name, start time, units, sensor; then format, and where units, time step and orientation stand
using Part = std::tuple<GroundMotion, std::string, std::string, std::string, std::string, std::array<std::string, 4>>;

RecordComponent component_of(const Part& part) {
  const auto& [motion, name, start, units, sensor, sources] = part;
  return {motion, name, start, units, sensor, {}};
}

Part part_of(RecordComponent&& one) {
  RecordSources& from = one.sources;
  return {std::move(one.motion),
          std::move(one.name),
          std::move(one.start),
          std::move(one.units),
          std::move(one.sensor),
          {std::move(from.format), std::move(from.units), std::move(from.time_step), std::move(from.orientation)}};
}

/// The components of a file. Each of several options that it accepts gives the same, because what is given must agree
/// with what the file states.
std::vector<RecordComponent> parse_any(std::string_view content, const std::string& file,
                                       const std::vector<RecordOptions>& several) {
  std::exception_ptr failure;
  bool is_about_options = false;
  for (const RecordOptions& options : several) try {
      return parse_components(content, file, options);
    } catch (const std::invalid_argument& error) {
      const bool about_options = std::string_view(error.what()).find("the file states") != std::string_view::npos;
      if (!failure || (is_about_options && !about_options)) {
        failure = std::current_exception();
        is_about_options = about_options;
      }
    }
  std::rethrow_exception(failure);
}

/// A default applies where the file states nothing: it is omitted if the file contradicts it.
std::vector<Part> parse(const py::bytes& content, const std::string& file, const std::string& units,
                        const std::string& component, std::optional<double> dt, bool gaps, bool only_one,
                        const std::string& default_units, std::optional<double> default_dt) {
  std::vector<RecordOptions> several{{units, component, dt, gaps}};
  if (units.empty() && !default_units.empty()) several.push_back({default_units, component, dt, gaps});
  for (std::size_t i = several.size(); !dt && default_dt && i-- > 0;)
    several.push_back({several[i].units, component, default_dt, gaps});
  std::swap(several.front(), several[several.size() / 2]);  // begin with all that is given
  const std::string_view bytes = content;
  const py::gil_scoped_release released;
  std::vector<RecordComponent> found = parse_any(bytes, file, several);
  if (only_one && found.size() != 1) (void)parse_record(bytes, file, several[0]);  // says which there are
  std::vector<Part> parts;
  for (RecordComponent& one : found) parts.push_back(part_of(std::move(one)));
  return parts;
}

GroundMotion station(const std::vector<Part>& parts, const std::vector<std::optional<std::string>>& orientations,
                     const std::string& along, bool common_length) {
  std::vector<RecordComponent> components;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    components.push_back(component_of(parts[i]));
    if (orientations[i]) components[i].motion = components[i].motion.with_orientation(*orientations[i]);
  }
  return station_motion(components, along, common_length);
}

py::dict row_of(const RecordFormat& format) {
  py::dict row;
  row["name"] = format.name;
  row["units"] = format.units;
  row["time_step"] = format.time_step;
  row["reference"] = format.reference;
  row["extension"] = format.extension;
  return row;
}

py::list formats() {
  py::list all;
  for (const RecordFormat& format : record_formats()) all.append(row_of(format));
  return all;
}

py::object format_of(const py::bytes& content) {
  const std::optional<RecordFormat> format = record_format(std::string_view(content));
  return format ? py::object(row_of(*format)) : py::object(py::none());
}

}  // namespace

// Functions for `stickslip.motions.records`, which has the documentation.
void bind_records(py::module_& m) {
  m.attr("PlausibilityWarning") = py::reinterpret_steal<py::object>(PyErr_NewExceptionWithDoc(
      "stickslip.PlausibilityWarning",
      "Warning about an implausible argument or record, probably in other units or with a baseline error.\n\n"
      "Constructors warn of values beyond the range of their quantity and name the likely unit. Beside that:\n"
      "`read_record`, `read_station`, `Suite.read` and `GroundMotion.from_obspy` warn if the time step is below "
      "0.0005\n"
      "or above 0.1 s, the duration below 1 s or above an hour, the maximum acceleration below 1e-5 or above 3 g, or\n"
      "the mean acceleration above 0.5 % of the maximum; they do not check motions of fewer than 100 samples.\n"
      "`GroundMotion(...)` warns of such accelerations, but accepts a motion that is zero, and checks the mean only of "
      "a motion\n"
      "that begins and ends at rest, as a record does: synthetic noise and harmonic motions rarely have no mean.\n"
      "In processed records the mean is below 0.02 % of the maximum; an offset of 0.01 g in a record of 0.6 g, 1.6 %,\n"
      "can double a displacement. Silence the warning with Python's filter:\n"
      "`warnings.simplefilter(\"ignore\", stickslip.PlausibilityWarning)`.",
      PyExc_UserWarning, nullptr));

  m.def("_parse_components", &parse, py::arg("content"), py::arg("file"), py::arg("units"), py::arg("component"),
        py::arg("dt"), py::arg("gaps"), py::arg("only_one"), py::arg("default_units") = "",
        py::arg("default_dt") = py::none());
  m.def("_azimuth_of", &azimuth_of, py::arg("orientation"));
  m.def("_upward", &upward, py::arg("orientation"));
  m.def("_orientation_in", &orientation_in, py::arg("text"));
  m.def("_orientation_in_file_name", &orientation_in_file_name, py::arg("name"));
  m.def(
      "_with_orientation",
      [](const GroundMotion& motion, std::string orientation) {
        return motion.with_orientation(std::move(orientation));
      },
      py::arg("motion"), py::arg("orientation"));
  m.def("_record_format", &format_of, py::arg("content"));
  m.def("_record_formats", &formats);
  m.def("_station_motion", &station, py::arg("components"), py::arg("orientations"), py::arg("along"),
        py::arg("common_length"));
  m.def(
      "_check_unit",
      [](const std::string& quantity, const std::string& who, const std::string& name, const py::object& values,
         int depth) { check_unit(quantity, who, name, to_vector_or_number(values, name), depth); },
      py::arg("quantity"), py::arg("who"), py::arg("name"), py::arg("values"), py::arg("depth") = 2);
  m.def("_plausible_ranges", [] {
    py::dict all;
    for (const PlausibleRange& range : plausible::ranges)
      all[py::str(std::string(range.quantity))] = py::make_tuple(range.low, range.high);
    return all;
  });
  m.def("_warn_if_implausible", &warn_if_implausible, py::arg("motion"), py::arg("who"), py::arg("depth") = 1,
        py::arg("recorded") = true);

  m.def("acceleration_unit", &acceleration_unit, py::arg("name"),
        R"(Value of a unit of acceleration in m/s^2: `acceleration_unit("gal")` is 0.01.

Parameters
----------
name : str
    A unit, as for `read_record`.

Raises
------
ValueError
    Unknown unit; the message lists the known ones.)");
}

}  // namespace stickslip::python
