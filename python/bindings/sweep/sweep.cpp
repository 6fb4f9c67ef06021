#include "stickslip/sweep/sweep.hpp"

#include <pybind11/stl.h>

#include "ensemble/sources.hpp"

namespace stickslip::python {
namespace {

Polarity polarity_of(const std::string& name) {
  if (name == "both") return Polarity::both;
  if (name == "recorded") return Polarity::recorded;
  if (name == "reversed") return Polarity::reversed;
  throw std::invalid_argument("sweep: polarity must be 'recorded', 'reversed' or 'both', got '" + name + "'");
}

template <class T>
py::array_t<T> shaped(const SweepTable& table, std::vector<T> values) {
  return array_of(std::move(values)).attr("reshape")(table.sliders, table.records, table.polarities);
}

py::dict run(const py::sequence& sliders, const py::sequence& motions, const std::string& polarity, bool settle,
             const std::string& contact, unsigned threads, const py::object& progress) {
  SweepOptions options{polarity_of(polarity), settle, contact_of(contact, "sweep"), threads};
  options.progress = [&](const SweepProgress& status) {
    const py::gil_scoped_acquire held;
    if (PyErr_CheckSignals() != 0) throw py::error_already_set();
    if (!progress.is_none()) progress(status.done, status.combinations);
  };
  std::vector<AnySlider> these;
  for (const py::handle item : sliders) {
    auto slider = slider_of(item);
    if (!slider)
      throw py::type_error("sweep: sliders[" + std::to_string(these.size()) +
                           "] must be a Slider or friction law, got " + type_of(item));
    these.push_back(*std::move(slider));
  }
  std::vector<py::object> kept;  // a sequence may create its items on access
  std::vector<const GroundMotion*> those;
  for (const py::handle item : motions) {
    if (!py::isinstance<GroundMotion>(item))
      throw py::type_error("sweep: motions[" + std::to_string(those.size()) + "] must be a GroundMotion, got " +
                           type_of(item));
    kept.push_back(py::reinterpret_borrow<py::object>(item));
    those.push_back(&item.cast<const GroundMotion&>());
  }
  SweepTable table = [&] {
    const py::gil_scoped_release released;
    return sweep(these, those, options);
  }();
  py::list failures;
  for (const SweepFailure& failure : table.failures)
    failures.append(py::make_tuple(failure.slider, failure.record,
                                   failure.polarity == Polarity::reversed ? "reversed" : "recorded", failure.message));
  py::dict result;
  result["peak"] = shaped(table, std::move(table.peak));
  result["residual"] = shaped(table, std::move(table.residual));
  result["sliding_distance"] = shaped(table, std::move(table.sliding_distance));
  result["events"] = shaped(table, std::move(table.events));
  result["airborne"] = shaped(table, std::move(table.airborne)).attr("astype")("bool");
  for (const auto& [side, name] : {std::pair(&Impacts::forward, "forward"), {&Impacts::backward, "backward"}}) {
    std::vector<std::uint64_t> counts;
    std::vector<double> speeds;
    for (const Impacts& one : table.impacts) {
      counts.push_back((one.*side).count);
      speeds.push_back((one.*side).speed);
    }
    if (table.impacts.empty()) continue;
    result[(std::string("impacts_") + name).c_str()] = shaped(table, std::move(counts));
    result[(std::string("impact_speed_") + name).c_str()] = shaped(table, std::move(speeds));
  }
  result["failures"] = failures;
  return result;
}

}  // namespace

void bind_sweep(py::module_& m) {
  m.def("sweep", &run, py::arg("sliders"), py::arg("motions"), py::kw_only(), py::arg("polarity"), py::arg("settle"),
        py::arg("contact"), py::arg("threads"), py::arg("progress"),
        R"(Implementation of `stickslip.sweep` (see there).

Calls `progress(done, combinations)` ten times a second with the interpreter lock held. Returns the arrays of the table
by name, and its failures; impacts only if a slider has stops.)");
}

}  // namespace stickslip::python
