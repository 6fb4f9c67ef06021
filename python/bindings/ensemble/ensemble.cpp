#include <pybind11/stl.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdio>
#include <map>
#include <memory>
#include <mutex>
#include <utility>

#include "parts.hpp"
#include "stickslip/ensemble/ensemble.hpp"

namespace stickslip::python {
namespace {

// ---- arrays and figures

template <Estimates (Ensemble::*figure)() const, std::vector<double> Estimates::*part>
py::array_t<double> by_time(const Ensemble& ensemble) {
  return array_of(std::move((ensemble.*figure)().*part));
}

template <class T, auto member>
auto array() {
  return [](const py::object& self) { return view(self.cast<const T&>().*member, self); };
}

/// A number to four significant digits.
std::string digits(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.4g", value);
  return text;
}

/// As "0.59712 +- 0.00021": the error to two digits, the value as far.
std::string with_error(const Estimate& estimate) {
  if (!(estimate.error > 0) || !std::isfinite(estimate.error) || !std::isfinite(estimate.value))
    return digits(estimate.value) + " +- " + digits(estimate.error);
  const double largest = std::max(std::abs(estimate.value), estimate.error);
  const int places = 1 - static_cast<int>(std::floor(std::log10(estimate.error)));
  const int before = static_cast<int>(std::floor(std::log10(largest)));
  char text[96];
  if (places >= 0 && places <= 12)
    std::snprintf(text, sizeof text, "%.*f +- %.*f", places, estimate.value, places, estimate.error);
  else
    std::snprintf(text, sizeof text, "%.*e +- %.1e", std::clamp(places + before, 1, 16), estimate.value,
                  estimate.error);
  return text;
}

// ---- what an ensemble holds, as arrays

/// What is of another type is refused: converted, it would not be what was saved.
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
  std::vector<double> peak, residual;
  for (const auto& [block, kept] : parts.kept) {
    kept_block.push_back(block);
    kept_size.push_back(kept.peak.size());
    peak.insert(peak.end(), kept.peak.begin(), kept.peak.end());
    residual.insert(residual.end(), kept.residual.begin(), kept.residual.end());
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
  state["bin"] = array_of(std::move(bin));
  state["bin_count"] = array_of(std::move(bin_count));
  return state;
}

Ensemble ensemble_of(const py::dict& state) {
  Ensemble::Parts parts;
  parts.configuration = state["configuration"].cast<Ensemble::Configuration>();
  parts.times = {state["dt"].cast<double>(), state["times"].cast<std::size_t>()};
  parts.velocity_spectrum = state["velocity_spectrum"].cast<bool>();
  expect(parts.times.count <= Ensemble::max_times, "there are too many times");

  const auto level = column<std::uint64_t>(state, "level"), number = column<std::uint64_t>(state, "number"),
             count = column<std::uint64_t>(state, "count");
  const auto sums = table<double>(state, "sums", 2);
  const std::size_t frequencies = parts.velocity_spectrum ? parts.times.central() / 2 + 1 : 0;
  const auto rows = static_cast<std::size_t>(sums.shape(0)), width = static_cast<std::size_t>(sums.shape(1));
  expect(level.size() == rows && number.size() == rows && count.size() == rows,
         "level, number, count and sums must go together");
  // Before any room is made for them.
  expect(rows == 0 || width == detail::Tally::size(parts.times.count, frequencies),
         "sums must have one column for each sum");
  for (std::size_t i = 0; i < rows; ++i) {
    constexpr unsigned most = 61;  // blocks have eight members at least
    expect(level[i] < most && number[i] < (std::uint64_t{1} << (most - level[i])), "a part is at no possible place");
    const detail::TallyTree::Place place{static_cast<unsigned>(level[i]), number[i]};
    detail::Tally tally(parts.times.count, frequencies);
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
  const auto peak = column<double>(state, "peak"), residual = column<double>(state, "residual");
  expect(kept_block.size() == kept_size.size() && peak.size() == residual.size(),
         "kept_block and kept_size, peak and residual must go together");
  std::size_t from = 0;
  for (std::size_t i = 0; i < kept_block.size(); ++i) {
    expect(kept_size[i] <= peak.size() - from, "a block has more members than peaks");
    const auto begin = static_cast<std::ptrdiff_t>(from), end = static_cast<std::ptrdiff_t>(from += kept_size[i]);
    parts.kept.emplace_hint(
        parts.kept.end(), kept_block[i],
        Ensemble::Kept{{peak.begin() + begin, peak.begin() + end}, {residual.begin() + begin, residual.begin() + end}});
  }
  expect(from == peak.size(), "there are more peaks than members");

  const auto bin = column<std::int32_t>(state, "bin");
  const auto bin_count = column<std::uint64_t>(state, "bin_count");
  expect(bin.size() == bin_count.size(), "bin and bin_count must go together");
  std::map<std::int32_t, std::uint64_t> bins;
  for (std::size_t i = 0; i < bin.size(); ++i) bins.emplace(bin[i], bin_count[i]);
  parts.peaks = detail::Sketch::from_bins(std::move(bins));
  return Ensemble(std::move(parts));
}

/// Each entry is JSON, but for the text of a source of somebody's own, which may be anything.
py::dict configuration_of(const Ensemble& ensemble) {
  const py::module_ json = py::module_::import("json");
  py::dict result;
  for (const auto& [name, text] : ensemble.configuration()) {
    try {
      result[name.c_str()] = json.attr("loads")(text);
    } catch (py::error_already_set& error) {
      if (!error.matches(PyExc_ValueError)) throw;
      result[name.c_str()] = text;
    }
  }
  return result;
}

/// First member and the one past the last of each unbroken row of members.
std::vector<std::pair<std::uint64_t, std::uint64_t>> ranges_of(const Ensemble& ensemble) {
  const Ensemble::Parts& parts = ensemble.parts();
  const std::uint64_t size = Ensemble::block(parts.times.count);
  std::vector<std::pair<std::uint64_t, std::uint64_t>> pieces, ranges;
  for (const auto& [place, tally] : parts.tallies.nodes()) {
    std::uint64_t block = place.number << place.level;
    const std::uint64_t end = (place.number + 1) << place.level;
    for (auto cut = parts.cut.lower_bound(block); cut != parts.cut.end() && cut->first < end; ++cut) {
      pieces.emplace_back(block * size, cut->first * size + cut->second);
      block = cut->first + 1;
    }
    if (block < end) pieces.emplace_back(block * size, end * size);
  }
  std::ranges::sort(pieces);
  for (const auto& piece : pieces) {
    if (!ranges.empty() && ranges.back().second == piece.first)
      ranges.back().second = piece.second;
    else
      ranges.push_back(piece);
  }
  return ranges;
}

// ---- the run

/// A source of ground motions that is written in Python; called by threads that do not hold the interpreter. Once the
/// run has `ended` it is not asked any more.
class PythonExcitation {
 public:
  PythonExcitation(const py::object& object, const std::atomic<bool>& ended) : sample_(method(object)), ended_(ended) {
    duration_ = attribute(object, "duration").cast<double>();
    detail::require(std::isfinite(duration_) && duration_ > 0,
                    "run_ensemble: the excitation's duration must be positive and finite", duration_, "s");
    if (py::hasattr(object, "dt") && !object.attr("dt").is_none()) dt_ = object.attr("dt").cast<double>();
    const py::object configuration = attribute(object, "configuration");
    configuration_ =
        py::isinstance<py::str>(configuration)
            ? configuration.cast<std::string>()
            : py::module_::import("json").attr("dumps")(configuration, py::arg("sort_keys") = true).cast<std::string>();
  }

  GroundMotion sample(std::uint64_t seed, std::uint64_t member) const {
    const std::scoped_lock turn(one_at_a_time_);  // before the interpreter's, which whoever is within may let go of
    if (ended_) throw detail::Block::Stopped{};
    const py::gil_scoped_acquire held;
    const py::object made = sample_(py::arg("seed") = seed, py::arg("member") = member);
    if (!py::isinstance<GroundMotion>(made))
      throw py::type_error("run_ensemble: the excitation's sample must return a GroundMotion, got " + type_of(made));
    auto motion = made.cast<GroundMotion>();
    if (std::abs(motion.duration() - duration_) > 1e-9 * duration_)
      throw std::invalid_argument("run_ensemble: the excitation's motions must last " + detail::shortest(duration_) +
                                  " s, its duration; member " + std::to_string(member) + " lasts " +
                                  detail::shortest(motion.duration()) + " s");
    return motion;
  }

  double duration() const noexcept { return duration_; }
  double dt() const noexcept { return dt_; }
  std::string configuration() const { return configuration_; }

 private:
  static std::string type_of(const py::object& object) {
    return py::type::of(object).attr("__name__").cast<std::string>();
  }

  static py::object attribute(const py::object& object, const char* name) {
    if (!py::hasattr(object, name))
      throw py::type_error(
          "run_ensemble: excitation must be a GaussianExcitation, PoissonPulses, or an object with "
          "sample(*, seed, member), duration and configuration; " +
          type_of(object) + " has no " + name);
    return object.attr(name);
  }

  static py::object method(const py::object& object) { return attribute(object, "sample"); }

  py::object sample_;
  const std::atomic<bool>& ended_;
  mutable std::mutex one_at_a_time_;
  double duration_ = 0, dt_ = 0;
  std::string configuration_;
};

/// Calls with the excitation as what it is.
template <class F>
auto with_excitation(const py::object& excitation, const std::atomic<bool>& ended, F&& f) {
  if (py::isinstance<GaussianExcitation>(excitation)) return f(excitation.cast<const GaussianExcitation&>());
  if (py::isinstance<PoissonPulses>(excitation)) return f(excitation.cast<const PoissonPulses&>());
  return f(PythonExcitation(excitation, ended));
}

template <class E>
Ensemble run_members(const AnySlider& slider, const E& source, const EnsembleOptions& options, const Ensemble* start) {
  return std::visit([&](const auto& s) { return run_ensemble(s, source, options, start); }, slider);
}
template <class E>
Ensemble run_members(const ViscousSlider& slider, const E& source, const EnsembleOptions& options,
                     const Ensemble* start) {
  return run_ensemble(slider, source, options, start);
}

template <class S>
Ensemble run(const S& slider, const py::object& excitation, std::uint64_t members, std::uint64_t first_member,
             std::uint64_t seed, unsigned threads, double dt, bool settle, bool velocity_spectrum,
             const Ensemble* start, const py::object& heartbeat, const py::object& interrupted) {
  EnsembleOptions options{members, first_member, seed, threads, dt, settle, velocity_spectrum};
  std::atomic<bool> ended = false;
  options.heartbeat = [&](const EnsembleProgress& progress) {
    const py::gil_scoped_acquire held;
    // What is there so far is copied only for who asks, and only while it stands still.
    const auto place = std::make_shared<const Ensemble*>(&progress.so_far);
    const std::unique_ptr<const Ensemble*, void (*)(const Ensemble**)> shut(place.get(),
                                                                            [](const Ensemble** p) { *p = nullptr; });
    const py::cpp_function so_far([place] {
      if (!*place) throw std::runtime_error("run_ensemble: so_far() is to be called within the heartbeat");
      return **place;
    });
    try {
      if (PyErr_CheckSignals() != 0) throw py::error_already_set();
      if (!heartbeat.is_none()) heartbeat(progress.done, progress.members, so_far);
    } catch (const py::error_already_set&) {
      ended = true;
      if (!interrupted.is_none()) interrupted(so_far);
      throw;
    }
  };
  return with_excitation(excitation, ended, [&](const auto& source) {
    const py::gil_scoped_release released;
    return run_members(slider, source, options, start);
  });
}

/// An ensemble of no members yet, for the parts of a run to be merged into.
template <class S>
Ensemble run_nothing(const S& slider, const py::object& excitation, std::uint64_t first_member, std::uint64_t seed,
                     double dt, bool settle, bool velocity_spectrum) {
  const py::none nobody;
  const Ensemble one =  // which tells whether all is as it must be
      run(slider, excitation, 1, first_member, seed, 1, dt, settle, velocity_spectrum, nullptr, nobody, nobody);
  const auto& parts = one.parts();
  return Ensemble(Ensemble::Parts{parts.configuration, parts.times, parts.velocity_spectrum, {}, {}, {}, {}});
}

std::string repr(const Ensemble& ensemble) {
  std::string seed;
  for (const auto& [name, text] : ensemble.configuration())
    if (name == "seed") seed = ", seed " + text;
  const EnsembleTimes& times = ensemble.parts().times;
  return "<Ensemble: " + std::to_string(ensemble.members()) + " members" + seed + ", " + std::to_string(times.count) +
         " times to " + digits(static_cast<double>(times.count - 1) * times.dt) + " s>";
}

/// Both for one kind of slider.
template <class S>
void add_runs(py::module_& m) {
  m.def("run_ensemble", &run<S>, py::arg("slider"), py::arg("excitation"), py::kw_only(), py::arg("members"),
        py::arg("first_member"), py::arg("seed"), py::arg("threads"), py::arg("dt"), py::arg("settle"),
        py::arg("velocity_spectrum"), py::arg("start"), py::arg("heartbeat"), py::arg("interrupted"),
        R"(What `stickslip.run_ensemble` calls, which see.

`heartbeat(done, members, so_far)` is called ten times a second with the interpreter held; `interrupted(so_far)` where
that raised, or Ctrl-C was pressed. `so_far()` copies what is there.)");
  m.def("run_nothing", &run_nothing<S>, py::arg("slider"), py::arg("excitation"), py::kw_only(),
        py::arg("first_member"), py::arg("seed"), py::arg("dt"), py::arg("settle"), py::arg("velocity_spectrum"),
        "The ensemble of a run that has no members yet; simulates one to see that all is as it must be.");
}

}  // namespace

void bind_ensemble(py::module_& m) {
  value_class<Estimate>(m, "Estimate", "A figure and its standard error, in the same unit.")
      .def_readonly("value", &Estimate::value, "The figure.")
      .def_readonly("error", &Estimate::error, "Its standard error, from the scatter between members.")
      .def("__repr__", [](const Estimate& e) { return "<Estimate: " + with_error(e) + ">"; });

  value_class<Interval>(m, "Interval", "A figure between its confidence bounds, in the same unit.")
      .def_readonly("value", &Interval::value, "The figure.")
      .def_readonly("low", &Interval::low, "Lower bound.")
      .def_readonly("high", &Interval::high, "Upper bound; infinite where the members are too few to bound it.")
      .def("__repr__", [](const Interval& i) {
        return "<Interval: " + digits(i.value) + ", from " + digits(i.low) + " to " + digits(i.high) + ">";
      });

  value_class<Stationary>(m, "Stationary",
                          R"(Averages over the central half of the motions, thesis 4.4, with standard errors.

The errors are those of the scatter between members.)")
      .def_readonly("begin", &Stationary::begin, "From when on it was averaged [s].")
      .def_readonly("end", &Stationary::end, "Until when [s].")
      .def_readonly("velocity_mean", &Stationary::velocity_mean, "Of x' [m/s].")
      .def_readonly("velocity_variance", &Stationary::velocity_variance, "Of x' [m^2/s^2].")
      .def_readonly("velocity_kurtosis", &Stationary::velocity_kurtosis,
                    "Mean fourth power over the variance squared (Gaussian: 3, Laplace: 6); NaN at rest.")
      .def_readonly("covariance", &Stationary::covariance,
                    "Of x and x' [m^2/s]: half of the growth rate, thesis (5.59), with more scatter.")
      .def_readonly("growth_rate", &Stationary::growth_rate,
                    R"(Growth of the displacement variance [m^2/s].

Of D(t) = Var[x(begin + t) - x(begin)]: (D(T) - D(T/2)) / (T/2), with T from begin to end. What does not grow cancels.)")
      .def("__repr__", [](const Stationary& s) {
        return "<Stationary: from " + digits(s.begin) + " to " + digits(s.end) + " s, velocity_variance " +
               with_error(s.velocity_variance) + " m^2/s^2, growth_rate " + with_error(s.growth_rate) + " m^2/s>";
      });

  value_class<VelocitySpectrum>(m, "VelocitySpectrum",
                                R"(Spectral density of the velocity in the central half of the motions, two-sided.

Kaiser-Bessel window, thesis (4.62), beta = 8, with a mean square of one; dt / (2 pi M) |DFT|^2 of the M windowed
samples. The integral over the whole line is the mean square velocity.)")
      .def_property_readonly("omega", array<VelocitySpectrum, &VelocitySpectrum::omega>(),
                             "From 0 to the Nyquist frequency [rad/s], shape (F,).")
      .def_property_readonly("density", array<VelocitySpectrum, &VelocitySpectrum::density>(),
                             "[m^2/s]: (m/s)^2 for each rad/s, shape (F,).")
      .def_property_readonly("error", array<VelocitySpectrum, &VelocitySpectrum::error>(),
                             "Its standard error, shape (F,).")
      .def("__repr__", [](const VelocitySpectrum& s) {
        return "<VelocitySpectrum: " + std::to_string(s.omega.size()) + " frequencies to " +
               digits(s.omega.empty() ? 0 : s.omega.back()) + " rad/s>";
      });

  py::class_<Ensemble>(m, "Ensemble", R"(Statistics over the members of an ensemble; what `run_ensemble` returns.

Every figure comes with its standard error, from the scatter between members. All sums are taken in one pass, about
means (Pebay 2008), and merge in an order that the members' numbers fix: the same members give the same bits on any
number of threads and in any parts that end on whole blocks.

Times are shape (T,), members shape (members,). Arrays are read-only and made when asked for. Ensembles with the same
members and figures are equal; they can be copied and pickled, but not hashed, for `merge` changes them.)")
      .def_property_readonly("members", &Ensemble::members, "How many members it holds.")
      .def_property_readonly("member_ranges", &ranges_of,
                             "Which members: (first, one past the last) of each unbroken row of them.")
      .def_property_readonly(
          "block", [](const Ensemble& e) { return Ensemble::block(e.parts().times.count); },
          "Members are simulated and summed in blocks of this many: a part begins on a multiple of it.")
      .def_property_readonly(
          "configuration", &configuration_of,
          "What the members depend on, as a dict: slider, excitation, seed, times of the statistics.")
      .def_property_readonly(
          "time", [](const Ensemble& e) { return array_of(e.time()); }, "Times of the statistics [s], from 0 on.")
      .def_property_readonly("displacement_mean", &by_time<&Ensemble::displacement_mean, &Estimates::value>,
                             "Mean of x by time [m].")
      .def_property_readonly("displacement_mean_error", &by_time<&Ensemble::displacement_mean, &Estimates::error>,
                             "Its standard error [m].")
      .def_property_readonly("displacement_variance", &by_time<&Ensemble::displacement_variance, &Estimates::value>,
                             "Variance of x about its mean by time, with the divisor members - 1 [m^2].")
      .def_property_readonly("displacement_variance_error",
                             &by_time<&Ensemble::displacement_variance, &Estimates::error>,
                             "Its standard error [m^2], from the fourth moment.")
      .def_property_readonly("covariance", &by_time<&Ensemble::covariance, &Estimates::value>,
                             "Covariance of x and x' by time, with the divisor members - 1 [m^2/s].")
      .def_property_readonly("covariance_error", &by_time<&Ensemble::covariance, &Estimates::error>,
                             "Its standard error [m^2/s], from the fourth moments.")
      .def_property_readonly("velocity_mean", &by_time<&Ensemble::velocity_mean, &Estimates::value>,
                             "Mean of x' by time [m/s].")
      .def_property_readonly("velocity_mean_error", &by_time<&Ensemble::velocity_mean, &Estimates::error>,
                             "Its standard error [m/s].")
      .def_property_readonly("velocity_variance", &by_time<&Ensemble::velocity_variance, &Estimates::value>,
                             "Variance of x' about its mean by time, with the divisor members - 1 [m^2/s^2].")
      .def_property_readonly("velocity_variance_error", &by_time<&Ensemble::velocity_variance, &Estimates::error>,
                             "Its standard error [m^2/s^2], from the fourth moment.")
      .def_property_readonly(
          "peak", [](const Ensemble& e) { return array_of(e.peak()); },
          R"(Largest |x| of each member, between samples too, in the order of the members [m].

ValueError where there are more than 2^24 = 16,777,216 members: their peaks are counted in bins 0.1 % wide instead, from
which `quantile` and `exceedance` come.)")
      .def_property_readonly(
          "residual", [](const Ensemble& e) { return array_of(e.residual()); },
          "Last x of each member [m]; ValueError as for `peak`.")
      .def_property_readonly(
          "moments", &Ensemble::moments,
          "Means, variances and covariance by time and the growth rate, as Moments: what theories give.")
      .def_property_readonly("stationary", &Ensemble::stationary,
                             "Averages over the central half of the motions, as Stationary.")
      .def_property_readonly("velocity_spectrum", &Ensemble::velocity_spectrum,
                             "As VelocitySpectrum; ValueError where it was not asked for.")
      .def("quantile", &Ensemble::quantile, py::arg("probability"), py::arg("confidence") = 0.95,
           R"(The peak that a share of the members does not exceed.

Parameters
----------
probability : float
    The share, in (0, 1).
confidence : float, optional
    That the true quantile lies between the bounds, in (0, 1).

Returns
-------
Interval
    [m]. The bounds are order statistics, by the binomial law; 0 and infinity where the members are too few.

Raises
------
ValueError
    Another share or confidence; fewer than two members.)")
      .def("exceedance", &Ensemble::exceedance, py::arg("level"), py::arg("confidence") = 0.95,
           R"(The share of members whose peak exceeds a level.

Parameters
----------
level : float
    [m], finite and at least 0.
confidence : float, optional
    That the true probability lies between the bounds, in (0, 1).

Returns
-------
Interval
    From 0 to 1; bounds of Clopper and Pearson (1934), which hold for any number of members.

Raises
------
ValueError
    Another level or confidence; fewer than two members.)")
      .def(
          "merge",
          [](Ensemble& self, const Ensemble& other) {
            const py::gil_scoped_release released;
            self.merge(other);
          },
          py::arg("other"),
          R"(Takes in the members of another part of the same ensemble, in place.

Parameters
----------
other : Ensemble
    Of the same configuration, with other members; it stays as it was.

Raises
------
ValueError
    Another configuration (says what differs), or members that are here already; nothing has changed then.

Notes
-----
Parts that begin on a multiple of `block` may be merged in any order: the bits are those of one run of all members.)")
      .def(
          "save",
          [](const py::object& self, const py::object& file) {
            py::module_::import("stickslip.ensemble").attr("save")(self, file);
          },
          py::arg("file"),
          R"(Writes all that it holds to a file, whole or not at all.

Parameters
----------
file : path-like
    A NumPy archive (.npz), without pickled objects; the name is taken as it is. A symbolic link is followed; a file
    that is there already keeps its mode, and its owner where that is permitted.

Raises
------
OSError
    The folder is missing or cannot be written; the file is read-only (which does not stop root), or is no regular file.

Notes
-----
Some 100 bytes for each time and 16 for each member.)")
      .def_static(
          "load", [](const py::object& file) { return py::module_::import("stickslip.ensemble").attr("load")(file); },
          py::arg("file"),
          R"(Reads what `save` wrote, to the bit.

Parameters
----------
file : path-like

Returns
-------
Ensemble

Raises
------
ValueError
    The file is truncated or damaged (every byte of it is checked by CRC-32), or is something else; it holds what no
    members can have left, as a negative peak. Takes no more memory than a few times the file's size.
OSError
    There is no such file, it cannot be read, or is no regular file.)")
      .def(
          "plot",
          [](const py::object& self, const py::kwargs& options) {
            return py::module_::import("stickslip.plotting").attr("plot_ensemble")(self, **options);
          },
          R"(Draws the variances of displacement and velocity, the distribution of the peaks, the velocity's spectrum.

Needs matplotlib (`pip install stickslip[plot]`). Returns the matplotlib Figure.)")
      .def("__repr__", &repr)
      .def(
          "__eq__", [](const Ensemble& a, const Ensemble& b) { return a == b; }, py::is_operator())
      .def(py::pickle(&state_of, &ensemble_of));

  add_runs<AnySlider>(m);
  add_runs<ViscousSlider>(m);
}

}  // namespace stickslip::python
