#include "stickslip/ensemble/floor_peaks.hpp"

#include <pybind11/stl.h>

#include "parts.hpp"

namespace stickslip::python {
namespace {

template <Estimates (FloorPeaks::*statistic)() const, std::vector<double> Estimates::*part>
py::array_t<double> by_floor(const FloorPeaks& peaks) {
  return array_of(std::move((peaks.*statistic)().*part));
}

}  // namespace

void bind_floor_peaks(py::module_& m) {
  value_class<FloorPeaks>(m, "FloorPeaks",
                          R"(Peaks on the floors of structures, over the members of an ensemble.

The largest magnitude of one quantity on each floor, over all time: `Ensemble.peak_floor_acceleration` [m/s^2] or
`Ensemble.peak_floor_drift` [m]. Floors count from the lowest. Arrays are read-only.)")
      .def_property_readonly(
          "values",
          [](const py::object& self) {
            const auto& peaks = self.cast<const FloorPeaks&>();
            py::array_t<double> all({peaks.members(), peaks.floors}, peaks.values.data(), self);
            all.attr("setflags")(py::arg("write") = false);
            return all;
          },
          "By member and floor, shape (members, floors).")
      .def_property_readonly("mean", &by_floor<&FloorPeaks::mean, &Estimates::value>,
                             "Mean over the members, shape (floors,). ValueError with fewer than two members.")
      .def_property_readonly("mean_error", &by_floor<&FloorPeaks::mean, &Estimates::error>, "Standard error.")
      .def_property_readonly("std", &by_floor<&FloorPeaks::deviation, &Estimates::value>,
                             "Standard deviation over the members, with the divisor members - 1, shape (floors,).")
      .def_property_readonly("std_error", &by_floor<&FloorPeaks::deviation, &Estimates::error>,
                             "Standard error, from the fourth moment.")
      .def("quantile", &FloorPeaks::quantile, py::arg("probability"), py::arg("confidence") = 0.95,
           R"(Quantiles over the members: what a fraction of the members does not exceed.

Parameters
----------
probability : float
    The fraction, in (0, 1).
confidence : float, optional
    Probability that the true quantile lies between the bounds, in (0, 1).

Returns
-------
list of Interval
    One for each floor. The bounds are order statistics, by the binomial law; 0 and infinity if there are too few
    members.

Raises
------
ValueError
    A probability or confidence out of range; fewer than two members.)")
      .def("__repr__", [](const FloorPeaks& peaks) {
        return "<FloorPeaks: " + std::to_string(peaks.members()) + " members, " + std::to_string(peaks.floors) +
               (peaks.floors == 1 ? " floor>" : " floors>");
      });
}

}  // namespace stickslip::python
