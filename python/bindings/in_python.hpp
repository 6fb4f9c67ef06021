// Methods that are implemented in Python: tables and HTML. Their modules are imported on first use.
#pragma once

#include <string>

#include "bindings.hpp"

namespace stickslip::python {

/// A method or property that a function of a module of the package implements.
inline auto in_python(const char* module, const char* function) {
  return [=](const py::object& self) { return py::module_::import(module).attr(function)(self); };
}

/// A method that takes a path, which a function of a module of the package implements.
inline auto csv_in(const char* module, const char* function) {
  return [=](const py::object& self, const py::object& path) {
    return py::module_::import(module).attr(function)(self, path);
  };
}

/// The method that shows a response as a picture that moves, and its documentation.
inline auto animation() {
  return [](const py::object& self, const py::object& time, double speed, double fps, const py::object& title,
            const py::object& size) {
    return py::module_::import("stickslip.plotting")
        .attr("animate")(self, py::arg("time") = time, py::arg("speed") = speed, py::arg("fps") = fps,
                         py::arg("title") = title, py::arg("size") = size);
  };
}
inline constexpr const char* animation_doc = R"(Show the object sliding on its moving floor, with its history below.

Needs matplotlib. Takes `time`, the begin and end of the part to show [s], `speed`, seconds of the motion in a second of
the animation, `fps`, frames in a second, `title`, and `size`, width and height [inches]. Returns an animation: a
notebook shows it, its `write` saves it as .gif, .mp4 or .html; see `stickslip.plotting.animate`.)";

/// The method that plots loops of force over displacement, and its documentation.
inline auto hysteresis() {
  return [](const py::object& self, const py::object& figure, const py::object& title, const py::object& ax,
            const py::object& time) {
    return py::module_::import("stickslip.plotting")
        .attr("plot_hysteresis")(self, figure, title, py::arg("ax") = ax, py::arg("time") = time);
  };
}
inline constexpr const char* hysteresis_doc = R"(Plot force over displacement; of a structure, those of its interface.

Needs matplotlib. Takes `ax`, matplotlib Axes, or `figure`, a Figure or SubFigure, to draw in, `title`, and `time`, the
begin and end of the part to draw [s]. Returns the axes or the figure, see `stickslip.plotting.plot_hysteresis`.)";

/// The documentation of a method that takes a path: a sentence, and notes if there are any.
inline std::string csv_doc(const std::string& sentence, const std::string& notes = "") {
  return sentence + R"(

Parameters
----------
path : path-like
    An existing file is replaced.

Returns
-------
Path

Raises
------
OSError
    The folder is missing or cannot be written; the file is read-only or not a regular file.
TypeError
    It is not a path.)" +
         (notes.empty() ? "" : "\n\nNotes\n-----\n" + notes);
}

/// What the tables of the responses of a system hold, for their documentation; further lines are indented by four.
struct TableTexts {
  std::string system;       // the attribute with what responds
  std::string columns;      // sentences: the columns of a DataFrame, with units
  std::string attributes;   // a list: the results in the attributes of a Dataset
  std::string results;      // a list: the results in JSON, with units
  std::string floors = "";  // sentences: what a Dataset holds of floors
  std::string peaks = "";   // a list: what JSON holds of floors, with units
};

/// Defines the methods that make tables of a response, on its class: those of `stickslip._responses`.
template <class Response>
void define_tables(const py::module_& m, const char* name, const TableTexts& texts) {
  constexpr const char* module = "stickslip._responses";
  py::class_<Response>(m.attr(name))
      .def("to_dataframe", in_python(module, "to_dataframe"),
           (R"(Convert the histories to a pandas DataFrame.

Returns
-------
pandas.DataFrame
    The index is `time` [s]. )" +
            texts.columns + R"(
    `frame.attrs["units"]` has the units by name. The ground acceleration is 0 after the ground motion.

Raises
------
ImportError
    pandas is missing.)")
               .c_str())
      .def("to_xarray", in_python(module, "to_xarray"),
           (R"(Convert the histories to an xarray Dataset over the coordinate `time` [s].

Returns
-------
xarray.Dataset
    The variables are the columns of `to_dataframe`, each with the attributes `long_name` and, if it has one, `units`.
    )" + texts.floors +
            "Attributes of the Dataset: `" + texts.system + "`, `motion` (its name), " + texts.attributes + R"(;
    the name of a unit ends in `_units`.

Raises
------
ImportError
    xarray is missing.)")
               .c_str())
      .def("to_csv", csv_in(module, "to_csv"), py::arg("path"),
           csv_doc("Write the histories to a CSV file, whole or not at all.",
                   "A line of names with units, then one line per sample; every number reads back as the same double.")
               .c_str())
      .def("to_json", in_python(module, "to_json"),
           (R"(The results and histories as one JSON document, for instance for a web page.

Returns
-------
str
    An object: `stickslip` (the version), `)" +
            texts.system + "`, `motion` (its name), `components`,\n    " + texts.results + R"(;
    `units` of the histories by name; `time` and the columns of `to_dataframe`, each a list with one value per sample;
    `events`, each an object with the fields of the attribute of this name)" +
            texts.peaks + R"(.
    Every number reads back as the same double; NaN and infinity, which JSON lacks, are null.)")
               .c_str())
      .def("_repr_html_", in_python(module, "response_html"));
}

}  // namespace stickslip::python
