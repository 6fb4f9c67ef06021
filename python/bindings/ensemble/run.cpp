#include "stickslip/ensemble/run.hpp"

#include <atomic>
#include <memory>

#include "sources.hpp"
#include "structure/contact.hpp"

namespace stickslip::python {
namespace {

Ensemble run(const py::object& sliders, const py::object& motions, std::uint64_t members, std::uint64_t first_member,
             std::uint64_t seed, unsigned threads, double dt, bool settle, const std::optional<std::string>& contact,
             bool velocity_spectrum, bool ground_acceleration, const Ensemble* start, const py::object& progress,
             const py::object& interrupted) {
  FirstSample first;
  const py::object kind = first_of(sliders, seed, first_member, first);
  const bool structures = structure_of(kind).has_value();
  const Contact chosen = contact_of(contact, "run_ensemble", structures);
  // The configuration of structures has no contact, because there is nothing to choose.
  EnsembleOptions options{
      members,           first_member,       seed, threads, dt, settle, structures ? Contact::flight : chosen,
      velocity_spectrum, ground_acceleration};
  std::atomic<bool> ended = false;
  options.progress = [&](const EnsembleProgress& status) {
    const py::gil_scoped_acquire held;
    // The partial ensemble is copied only on request, and only while it does not change.
    const auto place = std::make_shared<const Ensemble*>(&status.so_far);
    const std::unique_ptr<const Ensemble*, void (*)(const Ensemble**)> shut(place.get(),
                                                                            [](const Ensemble** p) { *p = nullptr; });
    const py::cpp_function so_far([place] {
      if (!*place) throw std::runtime_error("run_ensemble: so_far() must be called within the progress callback");
      return **place;
    });
    try {
      if (PyErr_CheckSignals() != 0) throw py::error_already_set();
      if (!progress.is_none()) progress(status.done, status.members, so_far);
    } catch (const py::error_already_set&) {
      ended = true;
      if (!interrupted.is_none()) interrupted(so_far);
      throw;
    }
  };
  const Motions these(motions, ended);
  const auto run_those = [&](const auto& those) {
    const py::gil_scoped_release released;
    return run_ensemble(those, these, options, start);
  };
  if (MemberKind<AnyPlanarSlider>::read(kind)) return with_members<AnyPlanarSlider>(sliders, ended, run_those, first);
  if (structures) return with_members<AnyStructure>(sliders, ended, run_those, first);
  return with_sliders(sliders, ended, run_those, first);
}

/// An ensemble without members, into which to merge the parts of a run.
Ensemble run_nothing(const py::object& sliders, const py::object& motions, std::uint64_t first_member,
                     std::uint64_t seed, double dt, bool settle, const std::optional<std::string>& contact,
                     bool velocity_spectrum, bool ground_acceleration) {
  const py::none nobody;
  const Ensemble one =  // checks the arguments
      run(sliders, motions, 1, first_member, seed, 1, dt, settle, contact, velocity_spectrum, ground_acceleration,
          nullptr, nobody, nobody);
  const auto& parts = one.parts();
  Ensemble::Parts none;
  none.configuration = parts.configuration;
  none.times = parts.times;
  none.velocity_spectrum = parts.velocity_spectrum;
  none.ground_acceleration = parts.ground_acceleration;
  none.in_plane = parts.in_plane;
  return Ensemble(std::move(none));
}

}  // namespace

void bind_run_ensemble(py::module_& m) {
  m.def("run_ensemble", &run, py::arg("sliders"), py::arg("motions"), py::kw_only(), py::arg("members"),
        py::arg("first_member"), py::arg("seed"), py::arg("threads"), py::arg("dt"), py::arg("settle"),
        py::arg("contact"), py::arg("velocity_spectrum"), py::arg("ground_acceleration"), py::arg("start"),
        py::arg("progress"), py::arg("interrupted"),
        R"(Implementation of `stickslip.run_ensemble` (see there).

Calls `progress(done, members, so_far)` ten times a second with the interpreter lock held, and `interrupted(so_far)` if
that raised or Ctrl-C was pressed. `so_far()` copies the partial ensemble.)");
  m.def("run_nothing", &run_nothing, py::arg("sliders"), py::arg("motions"), py::kw_only(), py::arg("first_member"),
        py::arg("seed"), py::arg("dt"), py::arg("settle"), py::arg("contact"), py::arg("velocity_spectrum"),
        py::arg("ground_acceleration"),
        "The ensemble of a run without members; simulates one member to check the arguments.");
}

}  // namespace stickslip::python
