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

}  // namespace stickslip::python
