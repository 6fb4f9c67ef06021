#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include "bindings.hpp"
#include "ground/plausibility.hpp"

namespace stickslip::python {

void bind_records(py::module_& m) {
  // The system's code makes it FileNotFoundError, PermissionError, IsADirectoryError ...
  py::register_exception_translator([](std::exception_ptr error) {
    try {
      if (error) std::rethrow_exception(error);
    } catch (const std::filesystem::filesystem_error& e) {
      const auto filename = py::reinterpret_steal<py::object>(PyUnicode_DecodeFSDefault(e.path1().string().c_str()));
      const py::object os_error =
          py::reinterpret_borrow<py::object>(PyExc_OSError)(e.code().value(), e.code().message(), filename);
      PyErr_SetObject(py::type::handle_of(os_error).ptr(), os_error.ptr());
    }
  });

  m.attr("PlausibilityWarning") = py::reinterpret_steal<py::object>(PyErr_NewExceptionWithDoc(
      "stickslip.PlausibilityWarning",
      "A record that is hardly what it is taken for: in other units, or with an error of the baseline.\n\n"
      "`read_record` and `GroundMotion.from_obspy` warn where the largest acceleration is below 0.01 or above\n"
      "30 m/s^2, and where the mean acceleration is above 0.5 % of the largest; fewer than 100 samples are not\n"
      "looked at. Of processed records the mean is below 0.02 % of the largest; an offset of 0.01 g in a record of\n"
      "0.6 g, 1.6 %, can double a displacement. Silence the warning by Python's own filter:\n"
      "`warnings.simplefilter(\"ignore\", stickslip.PlausibilityWarning)`.",
      PyExc_UserWarning, nullptr));

  m.def(
      "read_record",
      [](const std::filesystem::path& file, const std::optional<std::string>& units,
         const std::optional<std::variant<int, std::string>>& component) {
        RecordOptions options{units.value_or(""), ""};
        if (component)
          options.component = std::holds_alternative<int>(*component) ? std::to_string(std::get<int>(*component))
                                                                      : std::get<std::string>(*component);
        GroundMotion record = [&] {
          const py::gil_scoped_release released;
          return read_record(file, options);
        }();
        warn_if_implausible(record, "read_record");
        return record;
      },
      py::arg("file"), py::kw_only(), py::arg("units") = py::none(), py::arg("component") = py::none(),
      R"(Reads one component of a strong-motion record.

The format is told by the content: PEER AT2 (both header forms), COSMOS V1 and V2, GeoNet V1A and V2A, USGS SMC, and
text of two columns, seconds and acceleration, parted by a comma, a semicolon, a tab or blanks, with any comments and
labels before. Byte-order marks and CRLF line ends are fine. Even times become a step dt and start at 0; uneven times
are kept.

Parameters
----------
file : path-like
    The file.
units : str, optional
    Unit of acceleration where the file does not state one: 'g', 'm/s^2', 'cm/s^2', 'gal', 'mm/s^2', 'ft/s^2', 'in/s^2'.
    Refused if the file states another.
component : str or int, optional
    Where the file has several: the name in the file, or the number from 1.

Returns
-------
GroundMotion
    The acceleration [m/s^2], linear between samples, named after event, station and component.

Raises
------
OSError
    The file is missing (FileNotFoundError), unreadable or not a regular file.
ValueError
    Naming the file and the line or value: no known format, velocity or displacement, no or unknown units, text, NaN or
    infinity among the numbers, another count of samples than the header states, a time step that is not positive.

Warns
-----
PlausibilityWarning
    The largest acceleration is below 0.01 or above 30 m/s^2; or the mean acceleration is above 0.5 % of the largest,
    which is an error of the baseline: `detrended` takes it away. Fewer than 100 samples are not looked at.

Notes
-----
About 1 ms for 10,000 samples.)");
  m.def("acceleration_unit", &acceleration_unit, py::arg("name"),
        R"(How many m/s^2 one unit of acceleration is: `acceleration_unit("gal")` is 0.01.

Parameters
----------
name : str
    A unit as `read_record` takes it.

Raises
------
ValueError
    Unknown unit; lists the known ones.)");
}

}  // namespace stickslip::python
