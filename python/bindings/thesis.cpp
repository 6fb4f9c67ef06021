#include "reproduction/thesis.hpp"

#include <pybind11/functional.h>
#include <pybind11/stl.h>

#include "parts.hpp"

namespace stickslip::python {
namespace {

template <std::vector<double> ThesisCurve::*part>
py::array_t<double> numbers(const py::object& self) {
  return view(self.cast<const ThesisCurve&>().*part, self);
}

py::object limits(const std::vector<double>& two) {
  return two.empty() ? py::object(py::none()) : py::object(py::make_tuple(two[0], two[1]));
}

void bind_figure(py::module_& m) {
  value_class<ThesisCurve>(m, "ThesisCurve", "One curve or set of points of a figure.")
      .def_readonly("label", &ThesisCurve::label,
                    "What is drawn, in TeX between dollar signs; curves of one label belong together.")
      .def_property_readonly(
          "kind", [](const ThesisCurve& curve) { return name_of(curve.kind); },
          R"(What it is, str:

'thesis'
    What the thesis drew, or its method as printed.
'theory'
    A theory corrected, or one that the thesis did not have.
'exact', 'unstable'
    An exact answer; one that no disturbed motion comes back to.
'points'
    Single exact answers.
'simulation'
    An ensemble, with standard errors.
'limit', 'region'
    A line to compare with; an outline, whose inside is meant.)")
      .def_property_readonly("x", &numbers<&ThesisCurve::x>, "Abscissae, shape (N,).")
      .def_property_readonly("y", &numbers<&ThesisCurve::y>, "Ordinates, shape (N,).")
      .def_property_readonly("error", &numbers<&ThesisCurve::error>,
                             "Standard errors of y, shape (N,); empty where there are none.")
      .def_readonly("members", &ThesisCurve::members, "Of the ensemble, int; 0 where there is none.")
      .def("__repr__", [](const ThesisCurve& curve) {
        return "<ThesisCurve '" + curve.label + "', " + name_of(curve.kind) + ", " + std::to_string(curve.x.size()) +
               " points>";
      });

  value_class<ThesisPanel>(m, "ThesisPanel", "One pair of axes of a figure.")
      .def_readonly("title", &ThesisPanel::title, "What is seen, str.")
      .def_readonly("x", &ThesisPanel::x, "What the axis along shows, with its unit or as a group without one.")
      .def_readonly("y", &ThesisPanel::y, "The same of the axis upward.")
      .def_readonly("log_x", &ThesisPanel::log_x, "Whether the axis is logarithmic.")
      .def_readonly("log_y", &ThesisPanel::log_y, "Whether the axis is logarithmic.")
      .def_readonly("curves", &ThesisPanel::curves, "list of ThesisCurve.")
      .def_property_readonly(
          "x_limits", [](const ThesisPanel& panel) { return limits(panel.x_limits); },
          "What of it is shown, (float, float), or None for all.")
      .def_property_readonly(
          "y_limits", [](const ThesisPanel& panel) { return limits(panel.y_limits); },
          "What of it is shown, (float, float), or None for all.")
      .def("__repr__", [](const ThesisPanel& panel) { return "<ThesisPanel '" + panel.title + "'>"; });

  value_class<ThesisStatement>(
      m, "ThesisStatement",
      "Something that the thesis, or this library's documentation, says with a number, and what was found.")
      .def_readonly("where", &ThesisStatement::where,
                    "Section or equation of the thesis; '' where this library says it.")
      .def_readonly("claim", &ThesisStatement::claim, "In the sense of who says it, with the unit.")
      .def_readonly("said", &ThesisStatement::said, "By the thesis, or by this library.")
      .def_readonly("found", &ThesisStatement::found, "By this library.")
      .def_readonly("error", &ThesisStatement::error, "Standard error of `found`; 0 where it is no estimate.")
      .def_readonly("agrees", &ThesisStatement::agrees,
                    "Whether it lies within the digits or the bound that is given, and 3 standard errors.")
      .def_readonly("why", &ThesisStatement::why, "What is different, or how it was found.")
      .def_readonly("members", &ThesisStatement::members,
                    "Of the ensembles behind `found`, int; 0 where it is no estimate.")
      .def("__repr__", [](const ThesisStatement& s) {
        return "<ThesisStatement " + s.where + ": " + s.claim + ": said " + detail::shortest(s.said) + ", found " +
               detail::shortest(s.found) + ">";
      });

  value_class<ThesisCheck>(m, "ThesisCheck", "A number of a figure beside the one that is expected.")
      .def_readonly("what", &ThesisCheck::what,
                    "Figure, and panel / curve / point or statement; says so where a number is missing.")
      .def_readonly("found", &ThesisCheck::found, "What it is; NaN where the figure lacks it.")
      .def_readonly("expected", &ThesisCheck::expected,
                    "What it was when the expectations were made; NaN where nothing is expected of it.")
      .def_readonly("allowed", &ThesisCheck::allowed, "By how much it may be off.")
      .def_readonly("holds", &ThesisCheck::holds, "Whether it is off by no more.")
      .def_readonly("loose", &ThesisCheck::loose,
                    "Whether `allowed` is more than half of `expected`, the members being few.")
      .def("__repr__", [](const ThesisCheck& c) {
        return "<ThesisCheck " + c.what + ": found " + detail::shortest(c.found) + ", expected " +
               detail::shortest(c.expected) + " +- " + detail::shortest(c.allowed) + ">";
      });

  value_class<ThesisFigure>(m, "ThesisFigure", "A figure or table of the thesis, as it comes out here.")
      .def_readonly("number", &ThesisFigure::number, "'2.1' to '5.7', 'A.2', 'Table 5.1'.")
      .def_readonly("caption", &ThesisFigure::caption, "What is seen.")
      .def_readonly("thesis_cost", &ThesisFigure::thesis_cost, "What the thesis says it took; '' where it doesn't.")
      .def_readonly("panels", &ThesisFigure::panels, "list of ThesisPanel.")
      .def_readonly("statements", &ThesisFigure::statements, "list of ThesisStatement.")
      .def_readonly("seconds", &ThesisFigure::seconds, "That it took here [s].")
      .def("csv", &thesis_csv,
           "Every curve and point as CSV, str: panel, label, kind, members, x, y, error; a line each, 17 digits.")
      .def("check", &thesis_check,
           R"(Holds the figure against what is expected of it: every number that is expected is looked for.

Numbers are every simulated point, every statement and up to nine points of each other curve. One that is missing, or
that nothing is expected of, does not hold. They are expected as 100,000 members and seed 1 have them, so that another
seed is an independent trial. A simulated number may be off by 5 standard errors of the difference, its own error being
the expectation's times the root of the ratio of their members: a false alarm in 2 million for each, if Gaussian. Where
one member in a hundred moves it is not: with 2000 members 16 seeds of 8000 numbers had three alarms, all at such points.
Any other number may be off by 1e-6 of the largest that is expected of its curve.

Returns
-------
list of ThesisCheck)")
      .def("__repr__", [](const ThesisFigure& figure) {
        return "<ThesisFigure " + figure.number + ": " + std::to_string(figure.panels.size()) + " panels, " +
               std::to_string(figure.statements.size()) + " statements>";
      });
}

}  // namespace

void bind_thesis(py::module_& m) {
  bind_figure(m);

  py::class_<Thesis>(m, "Thesis",
                     R"(Draws the figures of the thesis, number by number; what figures share is computed once.

Groups without dimension are had by a slip level, a level S0 of the spectrum and a half width of 1.

Parameters
----------
members : int, default 100000
    Of each ensemble, at least 100. All figures together take some minutes on two threads with 100,000 members, and some
    seconds with 1000.
seed : int, default 1
    Names the random numbers.
threads : int, optional
    At most; as many as the machine has, if not given.
heartbeat : callable, optional
    Called some times a second with what is being done, str, and how much of it is, from 0 to 1. What it raises ends the
    work.

Raises
------
ValueError
    Fewer than 100 members; naming the value.)")
      .def(py::init([](std::uint64_t members, std::uint64_t seed, std::optional<unsigned> threads,
                       const std::optional<py::function>& heartbeat) {
             ThesisOptions options{.members = members, .seed = seed, .threads = threads.value_or(0)};
             std::optional<HeldFunction> held;
             if (heartbeat) held.emplace(*heartbeat);
             options.heartbeat = [held](std::string_view what, double share) {
               const py::gil_scoped_acquire lock;
               if (PyErr_CheckSignals() != 0) throw py::error_already_set();
               if (held) held->function()(what, share);
             };
             return Thesis(std::move(options));
           }),
           py::kw_only(), py::arg("members") = 100'000, py::arg("seed") = 1, py::arg("threads") = py::none(),
           py::arg("heartbeat") = py::none())
      .def_property_readonly_static(
          "numbers",
          [](const py::object&) {
            py::tuple numbers(Thesis::numbers().size());
            for (std::size_t i = 0; i < numbers.size(); ++i) numbers[i] = py::str(std::string(Thesis::numbers()[i]));
            return numbers;
          },
          "What there is, tuple of str, in the thesis's order.")
      .def(
          "figure", [](Thesis& thesis, const std::string& number) { return thesis.figure(number); }, py::arg("number"),
          py::call_guard<py::gil_scoped_release>(), R"(Draws one figure.

Parameters
----------
number : str
    One of `numbers`.

Returns
-------
ThesisFigure

Raises
------
ValueError
    Another number; lists those there are.
KeyboardInterrupt
    Within a second of Ctrl-C.)");

  m.def(
      "thesis_verdict", [](const std::vector<ThesisCheck>& checks) { return thesis_verdict(checks); },
      py::arg("checks"),
      "What checks come to, in one line: how many were made, how many are loose, how many are off; str.");

  m.def(
      "thesis_summary", [](const std::vector<ThesisFigure>& figures) { return thesis_summary(figures); },
      py::arg("figures"),
      "What the thesis says in numbers and what was found, and the time each figure took beside the thesis's own; "
      "str.");
}

}  // namespace stickslip::python
