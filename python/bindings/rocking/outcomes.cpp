#include "stickslip/rocking/outcomes.hpp"

#include <atomic>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "ensemble/outcomes.hpp"
#include "ensemble/sources.hpp"
#include "rocking/rocking.hpp"
#include "stickslip/statistics/binomial.hpp"

namespace stickslip::python {
namespace {

// Arrays by name, of shape (runs,), and the failures: (run, message).
py::dict columns_of(const std::vector<RockingOutcome>& outcomes) {
  const auto column = [&](auto member) { return column_of(outcomes, member); };
  py::dict result;
  result["peak_rotation"] = array_of(column(&RockingOutcome::peak));
  result["peak_rotation_ratio"] = array_of(column(&RockingOutcome::peak_ratio));
  result["overturned"] = array_of(column(&RockingOutcome::overturned)).attr("astype")("int8");
  result["overturned_at"] = array_of(column(&RockingOutcome::overturned_at));
  result["impacts"] = array_of(column(&RockingOutcome::impacts)).attr("astype")("int64");
  result["margin"] = array_of(column(&RockingOutcome::margin));
  result["condition"] = array_of(column(&RockingOutcome::condition));
  result["residual"] = array_of(column(&RockingOutcome::residual));
  result["sliding_distance"] = array_of(column(&RockingOutcome::sliding_distance));
  result["failures"] = failures_of(outcomes);
  return result;
}

template <class Block>
py::dict sweep_blocks(const std::vector<Block>& blocks, const std::vector<const GroundMotion*>& motions,
                      const std::vector<double>& scales, bool settle, unsigned threads, const py::object& progress) {
  std::atomic<bool> ended = false;
  const RockingRunOptions options{settle, threads, reporting(progress, ended)};
  const std::size_t records = motions.size(), factors = scales.size();
  const auto outcomes = [&] {
    const py::gil_scoped_release released;
    return rocking_outcomes(
        blocks.size() * records * factors,
        [&](std::size_t i) -> const Block& { return blocks[i / (records * factors)]; },
        [&](std::size_t i, const auto& use) { use(motions[i / factors % records]->scaled(scales[i % factors])); },
        options);
  }();
  return columns_of(outcomes);
}

template <class Block>
py::dict run_blocks(const std::vector<Block>& blocks, const py::object& motions, std::uint64_t members,
                    std::uint64_t first_member, std::uint64_t seed, bool settle, unsigned threads,
                    const py::object& progress) {
  std::atomic<bool> ended = false;
  const RockingRunOptions options{settle, threads, reporting(progress, ended)};
  const Motions source(motions, ended);
  const auto base = source.time_base();
  const auto outcomes = [&] {
    const py::gil_scoped_release released;
    return rocking_outcomes(
        members, [&](std::size_t i) -> const Block& { return blocks[i % blocks.size()]; },
        [&](std::size_t i, const auto& use) {
          const MadeOrListed made = source.sample(seed, first_member + i);
          const GroundMotion& motion = made;
          use(motion);
        },
        options);
  }();
  py::dict result = columns_of(outcomes);
  result["configuration"] = source.configuration();
  result["duration"] = base ? py::object(py::float_(base->duration)) : py::object(py::none());
  return result;
}

template <class Block>
py::object scales_of(const Block& block, const GroundMotion& motion, double up_to, std::size_t steps) {
  const auto ranges = [&] {
    const py::gil_scoped_release released;
    return critical_scales(block, motion, up_to, steps, check_for_interrupt);
  }();
  std::vector<double> bounds;
  for (const ScaleRange& range : ranges) bounds.insert(bounds.end(), {range.begin, range.end});
  return array_of(std::move(bounds)).attr("reshape")(ranges.size(), 2);
}

template <class Block>
void bind_runs(py::module_& m) {
  m.def("sweep_blocks", &sweep_blocks<Block>, py::arg("blocks"), py::arg("motions"), py::kw_only(), py::arg("scales"),
        py::arg("settle"), py::arg("threads"), py::arg("progress"),
        R"(Implementation of `stickslip.sweep` with blocks (see there).

Arrays by name, of shape (blocks * records * scales,), and `failures`, tuples of a place there and a message.)");
  m.def("run_blocks", &run_blocks<Block>, py::arg("blocks"), py::arg("motions"), py::kw_only(), py::arg("members"),
        py::arg("first_member"), py::arg("seed"), py::arg("settle"), py::arg("threads"), py::arg("progress"),
        R"(Implementation of `stickslip.run_ensemble` with blocks (see there).

As `sweep_blocks`, of shape (members,), with the `configuration` of the motions and their `duration`, or None.)");
}

}  // namespace

void bind_rocking_outcomes(py::module_& m) {
  bind_runs<SlenderBlock>(m);
  bind_runs<RockingBlock>(m);
  m.def("critical_scales", &scales_of<SlenderBlock>, py::arg("block"), py::arg("motion"), py::kw_only(),
        py::arg("up_to"), py::arg("steps") = 400,
        R"(The scales of a ground motion at which a block overturns.

A set of ranges: a block may stand at a larger scale than one at which it overturns (islands of safety). The lowest critical
scale is ``critical_scales(...)[0, 0]``.

Parameters
----------
block : SlenderBlock or RockingBlock
motion : GroundMotion
    All its components are multiplied by the scale.
up_to : float
    Largest scale, positive; a range that reaches it ends there.
steps : int, optional
    Number of scales, spaced evenly up to `up_to`, at which the outcome is computed, at least 1; default 400. Between two
    with unequal outcomes the bound is found by bisection, to 1e-12 of `up_to`. A range or a gap narrower than up_to/steps
    may be missed.

Returns
-------
ndarray, shape (R, 2)
    Begin and end of each range, in increasing order; empty if the block stands at all these scales.

Raises
------
ValueError
    up_to or steps out of range; a vertical motion with g + a_z <= 0 at a scale.
ConvergenceError
    A restitution of 1, with which the block never comes to rest.)");
  m.def("critical_scales", &scales_of<RockingBlock>, py::arg("block"), py::arg("motion"), py::kw_only(),
        py::arg("up_to"), py::arg("steps") = 400);
  m.def(
      "_binomial_interval",
      [](std::uint64_t count, std::uint64_t trials, double confidence) {
        return binomial_interval(count, trials, confidence);
      },
      py::arg("count"), py::arg("trials"), py::arg("confidence"),
      "A fraction of trials with the bounds of Clopper and Pearson (1934).");
  m.def(
      "_quantile",
      [](const py::object& values, double probability, double confidence) {
        return FloorPeaks{to_vector(values, "_quantile: values"), 1}.quantile(probability, confidence).front();
      },
      py::arg("values"), py::arg("probability"), py::arg("confidence"),
      "A quantile of the values of members, with bounds as of `Ensemble.quantile`.");
}

}  // namespace stickslip::python
