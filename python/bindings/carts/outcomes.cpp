#include "stickslip/carts/outcomes.hpp"

#include <atomic>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "carts/carts.hpp"
#include "ensemble/outcomes.hpp"
#include "ensemble/sources.hpp"
#include "planar/response.hpp"

namespace stickslip::python {
namespace {

// Arrays by name, of shape (runs,), (runs, 2) or (runs, walls), and the failures: (run, message).
py::dict columns_of(const std::vector<CartOutcome>& outcomes, std::size_t walls) {
  const auto column = [&](auto member) { return array_of(column_of(outcomes, member)); };
  py::dict result;
  result["peak"] = column(&CartOutcome::peak);
  result["peak_yaw"] = column(&CartOutcome::peak_yaw);
  result["peak_outline"] = column(&CartOutcome::peak_outline);
  result["residual"] = column(&CartOutcome::residual);
  result["residual_yaw"] = column(&CartOutcome::residual_yaw);
  result["rests"] = column(&CartOutcome::rests).attr("astype")("int64");
  result["margin"] = column(&CartOutcome::margin);
  const auto of_walls = [&](double Clearance::*member) {
    std::vector<double> values;
    for (const CartOutcome& one : outcomes)
      for (const Clearance& clearance : one.clearances) values.push_back(clearance.*member);
    return array_of(std::move(values)).attr("reshape")(outcomes.size(), walls);
  };
  result["clearance"] = of_walls(&Clearance::least);
  result["hit_time"] = of_walls(&Clearance::hit_time);
  result["hit_speed"] = of_walls(&Clearance::hit_speed);
  result["failures"] = failures_of(outcomes);
  return result;
}

py::dict sweep_carts(const std::vector<CartAsGiven>& carts, const std::vector<const GroundMotion*>& motions,
                     const std::vector<double>& scales, bool settle, const py::object& walls, unsigned threads,
                     const py::object& progress) {
  std::atomic<bool> ended = false;
  const CartRunOptions options{settle, walls_of(walls, "sweep: walls"), threads, reporting(progress, ended)};
  for (const GroundMotion* motion : motions) both_components(*motion, "sweep", "Cart");
  const std::size_t records = motions.size(), factors = scales.size();
  const auto outcomes = [&] {
    const py::gil_scoped_release released;
    return cart_outcomes(
        carts.size() * records * factors,
        [&](std::size_t i) -> const Cart& { return carts[i / (records * factors)].cart(); },
        [&](std::size_t i, const auto& use) { use(motions[i / factors % records]->scaled(scales[i % factors])); },
        options);
  }();
  return columns_of(outcomes, options.walls.size());
}

py::dict run_carts(const std::vector<CartAsGiven>& carts, const py::object& motions, std::uint64_t members,
                   std::uint64_t first_member, std::uint64_t seed, bool settle, const py::object& walls,
                   unsigned threads, const py::object& progress) {
  std::atomic<bool> ended = false;
  const CartRunOptions options{settle, walls_of(walls, "run_ensemble: walls"), threads, reporting(progress, ended)};
  const Motions source(motions, ended);
  const auto base = source.time_base();
  const auto outcomes = [&] {
    const py::gil_scoped_release released;
    return cart_outcomes(
        members, [&](std::size_t i) -> const Cart& { return carts[i % carts.size()].cart(); },
        [&](std::size_t i, const auto& use) {
          const MadeOrListed made = source.sample(seed, first_member + i);
          use(both_components(static_cast<const GroundMotion&>(made),
                              "run_ensemble: member " + std::to_string(first_member + i), "Cart"));
        },
        options);
  }();
  py::dict result = columns_of(outcomes, options.walls.size());
  result["configuration"] = source.configuration();
  result["duration"] = base ? py::object(py::float_(base->duration)) : py::object(py::none());
  return result;
}

}  // namespace

void bind_cart_outcomes(py::module_& m) {
  m.def("sweep_carts", &sweep_carts, py::arg("carts"), py::arg("motions"), py::kw_only(), py::arg("scales"),
        py::arg("settle"), py::arg("walls"), py::arg("threads"), py::arg("progress"),
        R"(Implementation of `stickslip.sweep` with carts (see there).

Arrays by name, of shape (carts * records * scales,), and `failures`, tuples of a place there and a message.)");
  m.def("run_carts", &run_carts, py::arg("carts"), py::arg("motions"), py::kw_only(), py::arg("members"),
        py::arg("first_member"), py::arg("seed"), py::arg("settle"), py::arg("walls"), py::arg("threads"),
        py::arg("progress"),
        R"(Implementation of `stickslip.run_ensemble` with carts (see there).

As `sweep_carts`, of shape (members,), with the `configuration` of the motions and their `duration`, or None.)");
}

}  // namespace stickslip::python
