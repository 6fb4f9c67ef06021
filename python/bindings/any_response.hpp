// What the responses of all systems share: the times of samples, the motion at any times, and tables.
#pragma once

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "bindings.hpp"
#include "in_python.hpp"
#include "structured.hpp"

namespace stickslip::python {

/// The array in `kept`, made by `make` on first access.
template <class Make>
py::object keep(py::object& kept, Make&& make) {
  if (!kept) {
    kept = make();
    kept.attr("setflags")(py::arg("write") = false);
  }
  return kept;
}

/// The times of the samples of a response, those of its motion as far as it goes.
template <Motion M>
py::object times_of(const py::object& motion, const M& ground, std::size_t samples) {
  if (py::len(motion.attr("time")) == samples) return motion.attr("time");
  std::vector<double> time(samples);
  for (std::size_t i = 0; i < samples; ++i) time[i] = ground.time(i);
  return to_array(time);
}

/// The property `time` of a response to a GroundMotion.
/// @param history  at whose samples
template <class Response, class History>
auto times_over(History history) {
  return [=](Response& r) {
    return keep(r.time, [&] {
      return times_of(r.motion, r.motion.template cast<const GroundMotion&>(), (r.response.*history).size());
    });
  };
}

/// `at` of a response: at one time a state, at several a structured array.
/// @param who     the class
/// @param find    `find(t)`: the states at times
/// @param row     `row(time, state)`
/// @param fields  as for `structured`
template <class Find, class MakeRow, class... Members>
py::object at(const char* who, const py::object& times, Find&& find, MakeRow&& row,
              const std::pair<const char*, Members>&... fields) {
  const std::vector<double> t = to_vector_or_number(times, std::string(who) + ".at: times", "s");
  const auto found = find(t);
  if (py::array::ensure(times).ndim() == 0) return py::cast(found.front());
  return structured(
      t.size(), [&](std::size_t i) { return row(t[i], found[i]); }, fields...);
}

/// What the documentation of a response says of its system; further lines of a text are indented by four.
struct ResponseTexts {
  std::string system;                   // the attribute with what responds
  std::string object;                   // what moves
  std::string rests = "comes to rest";  // what it does in the end
  std::string states;                   // sentences: what `at` returns
  std::string at_notes = "";            // what else there is to say of `at`
  std::string columns;                  // sentences: the columns of a DataFrame, with units
  std::string attributes;               // a list: the results in the attributes of a Dataset
  std::string results;                  // a list: the results in JSON, with units
  std::string floors = "";              // sentences: what a Dataset holds of floors
  std::string peaks = "";               // a list: what JSON holds of floors, with units
};

/// Defines what every response has on its class: `motion`, `time`, `at`, `truncated`, and the methods of
/// `stickslip._responses` that make tables.
template <class Response, class Times, class At>
void define_response(const py::module_& m, const char* name, Times&& times, At&& at, const ResponseTexts& texts) {
  constexpr const char* module = "stickslip._responses";
  py::class_<Response>(m.attr(name))
      .def_property_readonly(
          "motion", [](const Response& r) { return r.motion; }, "The ground motion.")
      .def_property_readonly("time", times,
                             (R"(Times of the samples [s], shape (N,).

The times of the ground motion. With `settle=True`, if it ends before the )" +
                              texts.object + " " + texts.rests + R"(, samples continue with
the last step of the motion up to the first at or after that; but see `truncated`.)")
                                 .c_str())
      .def_property_readonly(
          "truncated", [](const Response& r) { return r.response.truncated; },
          ("Whether the samples end before the " + texts.object + " " + texts.rests + R"( (bool).

Samples end at ten times the number of samples of the ground motion. Peaks, events and energy still include the motion
after them.)")
              .c_str())
      .def("at", at, py::arg("times"),
           ("The motion at any times, also between the samples and in the time until the " + texts.object + " " +
            texts.rests + R"(.

Parameters
----------
times : float or array_like, shape (T,)
    Times from the start of the motion to the last event or sample of the response [s], in any order.

Returns
-------
)" + texts.states +
            R"(

Raises
------
ValueError
    A time before the start or after the end.

Notes
-----
As exact as `integrate`: the motion is integrated again, and a step ends at each time.)" +
            texts.at_notes)
               .c_str())
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
