#include "stickslip/sweep/sweep.hpp"

#include <pybind11/stl.h>

#include "ensemble/sources.hpp"
#include "stickslip/planar/any_planar_slider.hpp"
#include "stickslip/structure/equipment_on_floor.hpp"
#include "stickslip/structure/isolated_structure.hpp"
#include "stickslip/structure/sweep.hpp"
#include "stickslip/sweep/planar_sweep.hpp"
#include "structure/contact.hpp"

namespace stickslip::python {
namespace {

Polarity polarity_of(const std::string& name) {
  if (name == "both") return Polarity::both;
  if (name == "recorded") return Polarity::recorded;
  if (name == "reversed") return Polarity::reversed;
  throw std::invalid_argument("sweep: polarity must be 'recorded', 'reversed' or 'both', got '" + name + "'");
}

template <class T, class Table>
py::array_t<T> shaped(const Table& table, std::vector<T> values) {
  return array_of(std::move(values)).attr("reshape")(table.sliders, table.records, table.polarities);
}

/// A value of each combination.
template <class Table, class Item, class Value>
auto column(const Table& table, const std::vector<Item>& items, Value&& value) {
  std::vector<std::remove_cvref_t<std::invoke_result_t<Value, const Item&>>> values;
  values.reserve(items.size());
  for (const Item& item : items) values.push_back(std::invoke(value, item));
  return shaped(table, std::move(values));
}

void add_results(py::dict& result, SweepTable& table) {
  result["residual"] = shaped(table, std::move(table.residual));
  if (table.impacts.empty()) return;
  for (const auto& [side, name] : {std::pair(&Impacts::forward, "forward"), {&Impacts::backward, "backward"}}) {
    result[(std::string("impacts_") + name).c_str()] =
        column(table, table.impacts, [&, side = side](const Impacts& one) { return (one.*side).count; });
    result[(std::string("impact_speed_") + name).c_str()] =
        column(table, table.impacts, [&, side = side](const Impacts& one) { return (one.*side).speed; });
  }
}

void add_results(py::dict& result, PlanarSweepTable& table) {
  result["residual"] = column(table, table.residual, norm);
  result["residual_axis"] = column(table, table.residual, &Vector2::axis);
  result["residual_transverse"] = column(table, table.residual, &Vector2::transverse);
  if (table.impacts.empty()) return;
  result["impacts"] = column(table, table.impacts, &SideImpacts::count);
  result["impact_speed"] = column(table, table.impacts, &SideImpacts::speed);
}

template <class Slider>
py::dict run(const std::vector<Slider>& sliders, const std::vector<const GroundMotion*>& motions,
             const SweepOptions& options) {
  auto table = [&] {
    const py::gil_scoped_release released;
    return sweep(sliders, motions, options);
  }();
  py::list failures;
  for (const SweepFailure& failure : table.failures)
    failures.append(py::make_tuple(failure.slider, failure.record,
                                   failure.polarity == Polarity::reversed ? "reversed" : "recorded", failure.message));
  py::dict result;
  result["peak"] = shaped(table, std::move(table.peak));
  result["sliding_distance"] = shaped(table, std::move(table.sliding_distance));
  result["events"] = shaped(table, std::move(table.events));
  result["airborne"] = shaped(table, std::move(table.airborne)).attr("astype")("bool");
  add_results(result, table);
  result["failures"] = failures;
  return result;
}

/// The items of a list, as objects of one class each.
template <class Slider, class Make>
std::vector<Slider> items_of(const py::sequence& sliders, const char* expected, Make&& make) {
  std::vector<Slider> these;
  for (const py::handle item : sliders) {
    std::optional<Slider> slider = make(item);
    if (!slider)
      throw py::type_error("sweep: sliders[" + std::to_string(these.size()) + "] must be a " + expected + ", got " +
                           type_of(item));
    these.push_back(*std::move(slider));
  }
  return these;
}

std::optional<AnyPlanarSlider> planar_slider_of(const py::handle& object) {
  if (py::isinstance<AnyPlanarSlider>(object)) return object.cast<const AnyPlanarSlider&>();
  return std::nullopt;
}

std::optional<AnySlidingStructure> structure_of(const py::handle& object) {
  if (py::isinstance<FlexibleSlope>(object)) return object.cast<const FlexibleSlope&>();
  if (py::isinstance<IsolatedStructure>(object)) return object.cast<const IsolatedStructure&>();
  if (py::isinstance<EquipmentOnFloor>(object)) return object.cast<const EquipmentOnFloor&>();
  return std::nullopt;
}

py::dict run_any(const py::sequence& sliders, const py::sequence& motions, const std::string& polarity, bool settle,
                 const std::string& contact, unsigned threads, const py::object& progress) {
  SweepOptions options{polarity_of(polarity), settle, contact_of(contact, "sweep"), threads};
  options.progress = [&](const SweepProgress& status) {
    const py::gil_scoped_acquire held;
    if (PyErr_CheckSignals() != 0) throw py::error_already_set();
    if (!progress.is_none()) progress(status.done, status.combinations);
  };
  std::vector<py::object> kept;  // a sequence may create its items on access
  std::vector<const GroundMotion*> those;
  for (const py::handle item : motions) {
    if (!py::isinstance<GroundMotion>(item))
      throw py::type_error("sweep: motions[" + std::to_string(those.size()) + "] must be a GroundMotion, got " +
                           type_of(item));
    kept.push_back(py::reinterpret_borrow<py::object>(item));
    those.push_back(&item.cast<const GroundMotion&>());
  }
  if (py::len(sliders) > 0 && py::isinstance<AnyPlanarSlider>(sliders[0]))
    return run(items_of<AnyPlanarSlider>(sliders, "PlanarSlider, as sliders[0] is", planar_slider_of), those, options);
  if (py::len(sliders) > 0 && structure_of(sliders[0]))
    return run(items_of<AnySlidingStructure>(sliders, "structure, as sliders[0] is", structure_of), those, options);
  return run(items_of<AnySlider>(sliders, "Slider or friction law", slider_of), those, options);
}

}  // namespace

void bind_sweep(py::module_& m) {
  m.def(
      "_contact_of",
      [](const std::optional<std::string>& contact, const std::string& owner, bool structures) {
        return name_of(contact_of(contact, owner, structures));
      },
      py::arg("contact"), py::arg("owner"), py::arg("structures"),
      "The argument `contact` of a function of many sliders, with its default; checks it.");
  m.def("sweep", &run_any, py::arg("sliders"), py::arg("motions"), py::kw_only(), py::arg("polarity"),
        py::arg("settle"), py::arg("contact"), py::arg("threads"), py::arg("progress"),
        R"(Implementation of `stickslip.sweep` (see there).

Calls `progress(done, combinations)` ten times a second with the interpreter lock held. Returns the arrays of the table
by name, and its failures; impacts only if a slider has stops. The sliders are all on one axis, all in the plane or all structures.)");
}

}  // namespace stickslip::python
