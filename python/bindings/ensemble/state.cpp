#include "state.hpp"

#include <pybind11/stl.h>

#include <algorithm>
#include <map>
#include <utility>

namespace stickslip::python {
namespace {

/// Rejects arrays of other types: a conversion would change what was saved.
template <class T>
py::array_t<T, py::array::c_style> table(const py::dict& state, const char* name, py::ssize_t dimensions) {
  const py::object value = state[name];
  if (!py::isinstance<py::array_t<T, 0>>(value) || value.cast<py::array>().ndim() != dimensions)
    throw std::invalid_argument(std::string("Ensemble: ") + name + " must be an array of " +
                                std::to_string(dimensions) + " dimensions and type " +
                                py::str(py::dtype::of<T>()).cast<std::string>());
  return py::array_t<T, py::array::c_style>::ensure(value);
}

template <class T>
std::vector<T> column(const py::dict& state, const char* name) {
  const auto values = table<T>(state, name, 1);
  return {values.data(), values.data() + values.size()};
}

void expect(bool holds, const char* what) {
  if (!holds) throw std::invalid_argument(std::string("Ensemble: ") + what);
}

}  // namespace

py::dict state_of(const Ensemble& ensemble) {
  const Ensemble::Parts& parts = ensemble.parts();
  const auto& nodes = parts.tallies.nodes();
  std::vector<std::uint64_t> level, number, count;
  const std::size_t width = nodes.empty() ? 0 : nodes.begin()->second.sums().size();
  py::array_t<double> sums({nodes.size(), width});
  double* row = sums.mutable_data();
  for (const auto& [place, tally] : nodes) {
    level.push_back(place.level);
    number.push_back(place.number);
    count.push_back(tally.count);
    row = std::ranges::copy(tally.sums(), row).out;
  }
  std::vector<std::uint64_t> cut_block, cut_size, kept_block, kept_size, bin_count;
  for (const auto& [block, size] : parts.cut) {
    cut_block.push_back(block);
    cut_size.push_back(size);
  }
  std::vector<double> peak, residual, residual_transverse, floor_peaks, speed_forward, speed_backward;
  std::vector<std::uint64_t> impact_block, impacts_forward, impacts_backward;
  for (const auto& [block, kept] : parts.kept) {
    kept_block.push_back(block);
    kept_size.push_back(kept.peak.size());
    peak.insert(peak.end(), kept.peak.begin(), kept.peak.end());
    residual.insert(residual.end(), kept.residual.begin(), kept.residual.end());
    residual_transverse.insert(residual_transverse.end(), kept.residual_transverse.begin(),
                               kept.residual_transverse.end());
    floor_peaks.insert(floor_peaks.end(), kept.floor_peaks.begin(), kept.floor_peaks.end());
    if (!kept.impacts.empty()) impact_block.push_back(block);
    for (const Impacts& one : kept.impacts) {
      impacts_forward.push_back(one.forward.count);
      impacts_backward.push_back(one.backward.count);
      speed_forward.push_back(one.forward.speed);
      speed_backward.push_back(one.backward.speed);
    }
  }
  std::vector<std::int32_t> bin;
  for (const auto& [b, n] : parts.peaks.bins()) {
    bin.push_back(b);
    bin_count.push_back(n);
  }
  py::dict state;
  state["configuration"] = parts.configuration;
  state["dt"] = parts.times.dt;
  state["times"] = parts.times.count;
  state["velocity_spectrum"] = parts.velocity_spectrum;
  state["ground_acceleration"] = parts.ground_acceleration;
  state["in_plane"] = parts.in_plane;
  state["level"] = array_of(std::move(level));
  state["number"] = array_of(std::move(number));
  state["count"] = array_of(std::move(count));
  state["sums"] = sums;
  state["cut_block"] = array_of(std::move(cut_block));
  state["cut_size"] = array_of(std::move(cut_size));
  state["kept_block"] = array_of(std::move(kept_block));
  state["kept_size"] = array_of(std::move(kept_size));
  state["peak"] = array_of(std::move(peak));
  state["residual"] = array_of(std::move(residual));
  state["residual_transverse"] = array_of(std::move(residual_transverse));
  state["floor_peaks"] = array_of(std::move(floor_peaks));
  state["bin"] = array_of(std::move(bin));
  state["bin_count"] = array_of(std::move(bin_count));
  state["airborne"] = parts.airborne;
  state["gaps"] = array_of(std::vector{parts.gaps.forward, parts.gaps.backward});
  state["hits"] = array_of(std::vector{parts.hits.either, parts.hits.forward, parts.hits.backward});
  state["impact_block"] = array_of(std::move(impact_block));
  state["impacts_forward"] = array_of(std::move(impacts_forward));
  state["impacts_backward"] = array_of(std::move(impacts_backward));
  state["impact_speed_forward"] = array_of(std::move(speed_forward));
  state["impact_speed_backward"] = array_of(std::move(speed_backward));
  return state;
}

/// Floors of the first structure in a configuration; 0 if there is none.
std::size_t floors_of(const py::object& configuration) {
  if (py::isinstance<py::list>(configuration)) {
    for (const py::handle one : configuration)
      if (const std::size_t floors = floors_of(py::reinterpret_borrow<py::object>(one)); floors > 0) return floors;
    return 0;
  }
  if (!py::isinstance<py::dict>(configuration)) return 0;
  if (configuration.contains("flexible_slope")) return 1;
  for (const char* const rows : {"mass", "shapes"})
    if (configuration.contains(rows) && py::isinstance<py::list>(configuration[rows]))
      return py::len(configuration[rows]);
  return floors_of(py::list(configuration.attr("values")()));
}

Ensemble ensemble_of(const py::dict& state) {
  Ensemble::Parts parts;
  parts.configuration = state["configuration"].cast<Ensemble::Configuration>();
  parts.times = {state["dt"].cast<double>(), state["times"].cast<std::size_t>()};
  parts.velocity_spectrum = state["velocity_spectrum"].cast<bool>();
  parts.ground_acceleration = state["ground_acceleration"].cast<bool>();
  parts.in_plane = state["in_plane"].cast<bool>();
  expect(parts.times.count <= Ensemble::max_times, "there are too many times");

  const auto level = column<std::uint64_t>(state, "level"), number = column<std::uint64_t>(state, "number"),
             count = column<std::uint64_t>(state, "count");
  const auto sums = table<double>(state, "sums", 2);
  const std::size_t frequencies = parts.velocity_spectrum ? parts.times.central() / 2 + 1 : 0;
  const auto rows = static_cast<std::size_t>(sums.shape(0)), width = static_cast<std::size_t>(sums.shape(1));
  expect(level.size() == rows && number.size() == rows && count.size() == rows,
         "level, number, count and sums must go together");
  // Checked before memory is allocated.
  expect(rows == 0 ||
             width == detail::Tally::size(parts.times.count, frequencies, parts.ground_acceleration, parts.in_plane),
         "sums must have one column for each sum");
  for (std::size_t i = 0; i < rows; ++i) {
    constexpr unsigned most = 61;  // a block has at least eight members
    expect(level[i] < most && number[i] < (std::uint64_t{1} << (most - level[i])), "invalid position of a part");
    const detail::TallyTree::Place place{static_cast<unsigned>(level[i]), number[i]};
    detail::Tally tally(parts.times.count, frequencies, parts.ground_acceleration, parts.in_plane);
    expect(!parts.tallies.overlaps(place), "two parts hold the same members");
    tally.count = count[i];
    std::copy_n(sums.data() + i * width, width, tally.sums().data());
    parts.tallies.insert(place, std::move(tally));
  }

  const auto cut_block = column<std::uint64_t>(state, "cut_block"), cut_size = column<std::uint64_t>(state, "cut_size");
  expect(cut_block.size() == cut_size.size(), "cut_block and cut_size must go together");
  for (std::size_t i = 0; i < cut_block.size(); ++i) {
    expect(parts.cut.emplace(cut_block[i], cut_size[i]).second, "a block is cut twice");
  }

  const auto kept_block = column<std::uint64_t>(state, "kept_block"),
             kept_size = column<std::uint64_t>(state, "kept_size");
  const auto peak = column<double>(state, "peak"), residual = column<double>(state, "residual"),
             residual_transverse = column<double>(state, "residual_transverse"),
             floor_peaks = column<double>(state, "floor_peaks");
  expect(kept_block.size() == kept_size.size() && peak.size() == residual.size(),
         "kept_block and kept_size, peak and residual must go together");
  expect(residual_transverse.size() == (parts.in_plane ? residual.size() : 0),
         "sliders in the plane, and only they, must have transverse residuals");
  const std::size_t numbers = peak.empty() ? 0 : floor_peaks.size() / peak.size();
  expect(floor_peaks.size() == numbers * peak.size(), "peaks of floors must be those of the members");
  for (const auto& [name, value] : parts.configuration) {
    if (numbers == 0 || name != "slider") continue;
    const std::size_t floors = floors_of(py::module_::import("json").attr("loads")(value));
    expect(floors == 0 || numbers == detail::floor_numbers(floors), "peaks of floors must be those of the structure");
  }
  std::size_t from = 0;
  for (std::size_t i = 0; i < kept_block.size(); ++i) {
    expect(kept_size[i] <= peak.size() - from, "a block has more members than peaks");
    const auto begin = static_cast<std::ptrdiff_t>(from), end = static_cast<std::ptrdiff_t>(from += kept_size[i]);
    Ensemble::Kept kept{{peak.begin() + begin, peak.begin() + end}, {residual.begin() + begin, residual.begin() + end}};
    if (parts.in_plane)
      kept.residual_transverse.assign(residual_transverse.begin() + begin, residual_transverse.begin() + end);
    const auto floors = floor_peaks.begin();
    const auto each = static_cast<std::ptrdiff_t>(numbers);
    kept.floor_peaks.assign(floors + begin * each, floors + end * each);
    parts.kept.emplace_hint(parts.kept.end(), kept_block[i], std::move(kept));
  }
  expect(from == peak.size(), "there are more peaks than members");

  parts.airborne = state["airborne"].cast<std::uint64_t>();
  const auto gaps = column<double>(state, "gaps");
  const auto hits = column<std::uint64_t>(state, "hits");
  expect(gaps.size() == 2 && hits.size() == 3, "gaps must be two and hits three numbers");
  parts.gaps = {gaps[0], gaps[1]};
  parts.hits = {hits[0], hits[1], hits[2]};
  const auto impact_block = column<std::uint64_t>(state, "impact_block"),
             impacts_forward = column<std::uint64_t>(state, "impacts_forward"),
             impacts_backward = column<std::uint64_t>(state, "impacts_backward");
  const auto speed_forward = column<double>(state, "impact_speed_forward"),
             speed_backward = column<double>(state, "impact_speed_backward");
  const std::size_t all = impacts_forward.size();
  expect(impacts_backward.size() == all && speed_forward.size() == all && speed_backward.size() == all,
         "counts and speeds of impacts must go together");
  from = 0;
  for (const std::uint64_t block : impact_block) {
    const auto kept = parts.kept.find(block);
    expect(kept != parts.kept.end() && kept->second.impacts.empty() && kept->second.peak.size() <= all - from,
           "impacts must be those of the members");
    for (const std::size_t end = from + kept->second.peak.size(); from < end; ++from)
      kept->second.impacts.push_back(
          {{impacts_forward[from], speed_forward[from]}, {impacts_backward[from], speed_backward[from]}});
  }
  expect(from == all, "there are more impacts than members");

  const auto bin = column<std::int32_t>(state, "bin");
  const auto bin_count = column<std::uint64_t>(state, "bin_count");
  expect(bin.size() == bin_count.size(), "bin and bin_count must go together");
  std::map<std::int32_t, std::uint64_t> bins;
  for (std::size_t i = 0; i < bin.size(); ++i) bins.emplace(bin[i], bin_count[i]);
  parts.peaks = detail::Sketch::from_bins(std::move(bins));
  return Ensemble(std::move(parts));
}

}  // namespace stickslip::python
