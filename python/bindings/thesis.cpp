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

/// The content of thesis_expected.txt, which is installed beside this module.
std::string expected() {
  const py::object file =
      py::module_::import("importlib.resources").attr("files")("stickslip") / py::str("thesis_expected.txt");
  return file.attr("read_text")("utf-8").cast<std::string>();
}

py::object limits(const std::vector<double>& two) {
  return two.empty() ? py::object(py::none()) : py::object(py::make_tuple(two[0], two[1]));
}

void bind_figure(py::module_& m) {
  value_class<ThesisCurve>(m, "ThesisCurve", "One curve or set of points of a figure.")
      .def_readonly("label", &ThesisCurve::label,
                    "Label, with TeX between dollar signs; curves with the same label belong together.")
      .def_property_readonly(
          "kind", [](const ThesisCurve& curve) { return name_of(curve.kind); },
          R"(Kind of the curve, str:

'thesis'
    A curve of the thesis, or its method as printed.
'theory'
    A corrected theory, or one that is not in the thesis.
'exact', 'unstable'
    An exact solution; an unstable exact solution.
'points'
    Individual exact values.
'simulation'
    An ensemble, with standard errors.
'limit', 'region'
    A line for comparison; the outline of a region.)")
      .def_property_readonly("x", &numbers<&ThesisCurve::x>, "Abscissae, shape (N,).")
      .def_property_readonly("y", &numbers<&ThesisCurve::y>, "Ordinates, shape (N,).")
      .def_property_readonly("error", &numbers<&ThesisCurve::error>,
                             "Standard errors of y, shape (N,); empty if there are none.")
      .def_readonly("members", &ThesisCurve::members, "Number of members of the ensemble, int; 0 without an ensemble.")
      .def("__repr__", [](const ThesisCurve& curve) {
        return "<ThesisCurve '" + curve.label + "', " + name_of(curve.kind) + ", " + std::to_string(curve.x.size()) +
               " points>";
      });

  value_class<ThesisPanel>(m, "ThesisPanel", "One panel of a figure.")
      .def_readonly("title", &ThesisPanel::title, "Title, str.")
      .def_readonly("x", &ThesisPanel::x, "Quantity on the horizontal axis, with its unit or as a dimensionless group.")
      .def_readonly("y", &ThesisPanel::y, "Quantity on the vertical axis, likewise.")
      .def_readonly("log_x", &ThesisPanel::log_x, "Whether the horizontal axis is logarithmic.")
      .def_readonly("log_y", &ThesisPanel::log_y, "Whether the vertical axis is logarithmic.")
      .def_readonly("curves", &ThesisPanel::curves, "list of ThesisCurve.")
      .def_property_readonly(
          "x_limits", [](const ThesisPanel& panel) { return limits(panel.x_limits); },
          "Range of the horizontal axis, (float, float), or None for all.")
      .def_property_readonly(
          "y_limits", [](const ThesisPanel& panel) { return limits(panel.y_limits); },
          "Range of the vertical axis, (float, float), or None for all.")
      .def("__repr__", [](const ThesisPanel& panel) { return "<ThesisPanel '" + panel.title + "'>"; });

  value_class<ThesisStatement>(m, "ThesisStatement",
                               "A numerical claim of the thesis, or of this library's documentation, and our result.")
      .def_readonly("where", &ThesisStatement::where,
                    "Section or equation of the thesis; '' for a claim of this library.")
      .def_readonly("claim", &ThesisStatement::claim, "The claim, in the sense of its source, with the unit.")
      .def_property_readonly(
          "bound", [](const ThesisStatement& s) { return name_of(s.bound); },
          "Whether `said` is a value or a bound, str: 'about', 'at most' or 'at least'.")
      .def_readonly("said", &ThesisStatement::said, "The claimed value or bound.")
      .def_readonly("found", &ThesisStatement::found, "Our result.")
      .def_readonly("error", &ThesisStatement::error, "Standard error of `found`; 0 if it is not an estimate.")
      .def_property_readonly("agrees", &ThesisStatement::agrees,
                             "Whether `found` agrees to the digits or bound of the claim, plus 3 standard errors.")
      .def_readonly("why", &ThesisStatement::why, "The difference, or how the result was computed.")
      .def_readonly("members", &ThesisStatement::members,
                    "Number of members of the ensembles behind `found`, int; 0 if it is not an estimate.")
      .def("__repr__", [](const ThesisStatement& s) {
        return "<ThesisStatement " + s.where + ": " + s.claim + ": said " + digits(s.said) + ", found " +
               digits(s.found) + ">";
      });

  value_class<ThesisCheck>(m, "ThesisCheck", "A number or a text of a figure next to what is expected.")
      .def_readonly("what", &ThesisCheck::what,
                    "Figure, and panel / curve / point or statement; notes a missing number; contains the texts.")
      .def_readonly("found", &ThesisCheck::found, "The number; NaN if the figure lacks it, and for texts.")
      .def_readonly("expected", &ThesisCheck::expected, "The stored value; NaN if there is none, and for texts.")
      .def_readonly("allowed", &ThesisCheck::allowed, "Tolerance.")
      .def_readonly("holds", &ThesisCheck::holds,
                    "Whether the number is within the tolerance, or the text is the expected one.")
      .def_readonly("loose", &ThesisCheck::loose,
                    "Whether half of a nonzero expected value would hold too, because there are few members.")
      .def("__repr__", [](const ThesisCheck& c) {
        return "<ThesisCheck " + c.what + ": found " + digits(c.found) + ", expected " + digits(c.expected) + " +- " +
               digits(c.allowed) + ">";
      });

  value_class<ThesisFigure>(m, "ThesisFigure", "A figure or table of the thesis, recomputed.")
      .def_readonly("number", &ThesisFigure::number, "'2.1' to '5.7', 'A.2', 'Table 5.1'.")
      .def_readonly("caption", &ThesisFigure::caption, "Caption.")
      .def_readonly("thesis_cost", &ThesisFigure::thesis_cost,
                    "Computing time according to the thesis; '' if not stated.")
      .def_readonly("panels", &ThesisFigure::panels, "list of ThesisPanel.")
      .def_readonly("statements", &ThesisFigure::statements, "list of ThesisStatement.")
      .def_readonly("seconds", &ThesisFigure::seconds, "Time taken here [s].")
      .def(
          "csv", &thesis_csv,
          "All curves and points as CSV, str: panel, label, kind, members, x, y, error; one line per point, 17 digits.")
      .def(
          "check", [](const ThesisFigure& figure) { return thesis_check(figure, expected()); },
          R"(Compare every number of the figure with its expected value.

Numbers are all simulated points, up to nine points of each other curve, and of each statement the number found, the
number claimed and the deviation that the claim allows. A number that is missing, or for which there is no expected
value, does not hold. The expected values are from 100,000 members and seed 1, so that another seed is an independent
trial. The tolerance of a number is 1e-6 of its expected value and, for round-off, 1e-12 of the largest expected value
of the curve. For a simulated number, 5 standard errors of the difference are added, where the error of the number is
that of the expected value times the root of the ratio of their members: one false alarm in 2 million for each number,
if it is Gaussian. Numbers that depend on one member in a hundred are not: with 2000 members, 16 seeds of 8000 numbers
had three alarms, all at such points.

Texts must be equal: titles and axes of panels, labels and kinds of curves, and of each statement the claim and whether
the expected number agrees with it.

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
                     R"(Computes the figures of the thesis one by one; results that figures share are computed once.

Dimensionless groups use a slip level, a spectral level S0 and a half width of 1.

Parameters
----------
members : int, default 100000
    Number of members of each ensemble, at least 100. All figures together take some minutes on two threads with 100,000
    members, and some seconds with 1000.
seed : int, default 1
    Random seed.
threads : int, optional
    Maximum number of threads; default: all cores.
progress : callable, optional
    Called several times a second with the current task, str, and the fraction of it that is done, from 0 to 1. An
    exception that it raises ends the work.

Raises
------
ValueError
    Fewer than 100 members; the message names the value.)")
      .def(py::init([](std::uint64_t members, std::uint64_t seed, std::optional<unsigned> threads,
                       const std::optional<py::function>& progress) {
             ThesisOptions options{.members = members, .seed = seed, .threads = threads.value_or(0)};
             std::optional<HeldFunction> held;
             if (progress) held.emplace(*progress);
             options.progress = [held](std::string_view what, double share) {
               const py::gil_scoped_acquire lock;
               if (PyErr_CheckSignals() != 0) throw py::error_already_set();
               if (held) held->function()(what, share);
             };
             return Thesis(std::move(options));
           }),
           py::kw_only(), py::arg("members") = 100'000, py::arg("seed") = 1, py::arg("threads") = py::none(),
           py::arg("progress") = py::none())
      .def_property_readonly_static(
          "numbers",
          [](const py::object&) {
            py::tuple numbers(Thesis::numbers().size());
            for (std::size_t i = 0; i < numbers.size(); ++i) numbers[i] = py::str(std::string(Thesis::numbers()[i]));
            return numbers;
          },
          "Numbers of all figures and tables, tuple of str, in the order of the thesis.")
      .def(
          "figure", [](Thesis& thesis, const std::string& number) { return thesis.figure(number); }, py::arg("number"),
          py::call_guard<py::gil_scoped_release>(), R"(Compute one figure.

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
    An unknown number; the message lists the known ones.
KeyboardInterrupt
    Within a second of Ctrl-C.)");

  m.def(
      "thesis_verdict", [](const std::vector<ThesisCheck>& checks) { return thesis_verdict(checks); },
      py::arg("checks"), "Summary of checks in one line, str: number of checks, of loose ones, of failed ones.");

  m.def(
      "thesis_summary", [](const std::vector<ThesisFigure>& figures) { return thesis_summary(figures); },
      py::arg("figures"),
      "The numerical claims of the thesis next to our results, and the time of each figure next to that of the "
      "thesis, str.");
}

}  // namespace stickslip::python
