#include <pybind11/complex.h>
#include <pybind11/stl.h>

#include "parts.hpp"
#include "sliding/response.hpp"

namespace stickslip::python {
namespace {

/// An orbit with its slider.
struct SliderOrbit {
  Orbit orbit;
  AnySlider slider;
};

struct SliderBranch {
  std::vector<Orbit> orbits;
  std::vector<std::size_t> folds;
  AnySlider slider;
};

std::vector<SliderOrbit> orbits_of(const AnySlider& slider, double load, double omega) {
  std::vector<Orbit> found = [&] {
    const py::gil_scoped_release released;
    return with_position_law(slider, "orbits",
                             [&](const auto& s) { return orbits(s, load, omega, check_for_interrupt); });
  }();
  std::vector<SliderOrbit> result;
  for (Orbit& orbit : found) result.push_back({std::move(orbit), slider});
  return result;
}

SliderBranch continuation_of(const AnySlider& slider, const SliderOrbit& from, double low, double high, double max_step,
                             double max_amplitude, std::size_t max_orbits) {
  OrbitBranch branch = [&] {
    const py::gil_scoped_release released;
    const ContinuationOptions options{max_step, max_amplitude, max_orbits, check_for_interrupt};
    return with_position_law(slider, "continuation",
                             [&](const auto& s) { return continuation(s, from.orbit, low, high, options); });
  }();
  return {std::move(branch.orbits), std::move(branch.folds), slider};
}

// x and x' at given times.
py::tuple histories_of(const SliderOrbit& self, const py::object& times) {
  const std::vector<double> t = to_vector(times, "Orbit.histories: times", "s");
  for (const double time : t) detail::require(std::isfinite(time), "Orbit.histories: times must be finite", time, "s");
  const auto states =
      with_position_law(self.slider, "Orbit.histories", [&](const auto& s) { return states_at(s, self.orbit, t); });
  std::vector<double> displacement, velocity;
  for (const State& state : states) {
    displacement.push_back(state.displacement);
    velocity.push_back(state.velocity);
  }
  return py::make_tuple(array_of(std::move(displacement)), array_of(std::move(velocity)));
}

template <class Value>
auto each(Value&& value) {
  return [value](const SliderBranch& branch) {
    using T = std::remove_cvref_t<decltype(value(branch.orbits[0]))>;
    std::vector<std::conditional_t<std::same_as<T, bool>, std::uint8_t, T>> values;
    for (const Orbit& orbit : branch.orbits) values.push_back(value(orbit));
    py::array array = array_of(std::move(values));
    if constexpr (std::same_as<T, bool>) array = array.attr("view")("bool");
    return array;
  };
}

template <auto member>
auto each() {
  return each([](const Orbit& orbit) { return orbit.*member; });
}

template <auto member>
auto each_pair() {
  return [](const SliderBranch& branch) {
    std::vector<std::complex<double>> values;
    for (const Orbit& orbit : branch.orbits)
      values.insert(values.end(), (orbit.*member).begin(), (orbit.*member).end());
    return array_of(std::move(values)).attr("reshape")(branch.orbits.size(), 2);
  };
}

template <auto member>
auto of_orbit() {
  return [](const SliderOrbit& self) { return self.orbit.*member; };
}

}  // namespace

template <>
inline constexpr auto parts<SliderOrbit> = std::tuple(&SliderOrbit::orbit, &SliderOrbit::slider);
template <>
inline constexpr auto parts<SliderBranch> = std::tuple(&SliderBranch::orbits, &SliderBranch::folds,
                                                       &SliderBranch::slider);

void bind_harmonic(py::module_& m) {
  value_class<SliderOrbit>(
      m, "Orbit", R"(A periodic response to -n(t) = B cos(omega t), thesis (2.28), as `harmonic.orbits` returns it.

It is symmetric about a center c, x(t + T/2) - c = c - x(t) with T = 2 pi / omega.)")
      .def_property_readonly(
          "slider", [](const SliderOrbit& self) { return py::cast(self.slider); }, "The slider.")
      .def_property_readonly("B", of_orbit<&Orbit::load>(), "Amplitude of the load [m/s^2].")
      .def_property_readonly("omega", of_orbit<&Orbit::omega>(), "Angular frequency [rad/s].")
      .def_property_readonly(
          "period", [](const SliderOrbit& self) { return self.orbit.period(); }, "T = 2 pi / omega [s].")
      .def_property_readonly("amplitude", of_orbit<&Orbit::amplitude>(),
                             "Half the peak-to-peak displacement [m]; 0 for rest at the center.")
      .def_property_readonly("phase", of_orbit<&Orbit::phase>(),
                             R"(Phase in x - center = amplitude cos(omega t + phase), in (-pi, pi] [rad].

It is -omega times the time of the first maximum of x; nan at rest. Thesis (2.2), (2.17), corrected.)")
      .def_property_readonly("stops_per_cycle", of_orbit<&Orbit::stops_per_cycle>(), "Number of arrests in a cycle.")
      .def_property_readonly("reversals_per_cycle", of_orbit<&Orbit::reversals_per_cycle>(),
                             "Number of reversals without a stop in a cycle.")
      .def_property_readonly("multipliers", of_orbit<&Orbit::multipliers>(),
                             R"(The two Floquet multipliers: growth factors of a small perturbation over a period.

Complex, the larger one first; one of them is 0 if the slider stops.)")
      .def_property_readonly(
          "half_period_multipliers", of_orbit<&Orbit::half_period_multipliers>(),
          "Multipliers of the half-period map (x - c, x') -> -(x - c, x')(T/2 later); `multipliers` are their squares.")
      .def_property_readonly("stable", of_orbit<&Orbit::stable>(),
                             R"(Whether the orbit is stable under small perturbations.

No multiplier is more than 1e-10 outside the unit circle. One on the circle is neutral: with Coulomb friction and no
spring the mean position is arbitrary, and a slider at rest stays where it is.)")
      .def_property_readonly(
          "mean_arbitrary", of_orbit<&Orbit::mean_arbitrary>(),
          "Whether the mean position is arbitrary (Coulomb friction without a spring); this orbit is about 0.")
      .def_property_readonly(
          "center", of_orbit<&Orbit::center>(),
          "Center c: (backward - forward) / (2 wn^2) for unequal levels with a spring, otherwise 0 [m].")
      .def_property_readonly(
          "displacement", [](const SliderOrbit& self) { return self.orbit.state.displacement; },
          "x at t = 0 [m]; `integrate` from it and `velocity` stays on the orbit.")
      .def_property_readonly(
          "velocity", [](const SliderOrbit& self) { return self.orbit.state.velocity; }, "x' at t = 0 [m/s].")
      .def_property_readonly("dissipated", of_orbit<&Orbit::dissipated>(),
                             "Work of friction in a period, equal to the input of the ground [m^2/s^2].")
      .def_property_readonly(
          "events", [](const SliderOrbit& self) { return events_array(self.orbit.events); },
          "Events of one period from t = 0, a structured array like `Response.events`, without 'end'.")
      .def("histories", &histories_of, py::arg("times"), R"(Compute displacement and velocity at given times.

Parameters
----------
times : array_like, shape (N,)
    Times [s], finite, in any order.

Returns
-------
displacement : ndarray, shape (N,)
    x [m].
velocity : ndarray, shape (N,)
    x' [m/s].)")
      .def("__repr__", [](const SliderOrbit& self) {
        const Orbit& o = self.orbit;
        return "<Orbit: amplitude " + digits(o.amplitude) + " m at " + digits(o.omega) + " rad/s, " +
               std::to_string(o.stops_per_cycle) + " stops a cycle, " + (o.stable ? "stable>" : "unstable>");
      });

  value_class<SliderBranch>(
      m, "OrbitBranch",
      R"(A branch of the response curve: connected orbits in order, as `harmonic.continuation` returns them.

Arrays are over the orbits, read-only.)")
      .def_property_readonly("omega", each<&Orbit::omega>(), "Angular frequency [rad/s], shape (N,).")
      .def_property_readonly("amplitude", each<&Orbit::amplitude>(),
                             "Half the peak-to-peak displacement [m], shape (N,).")
      .def_property_readonly("phase", each<&Orbit::phase>(), "As `Orbit.phase` [rad], shape (N,).")
      .def_property_readonly("stable", each<&Orbit::stable>(), "As `Orbit.stable`, shape (N,).")
      .def_property_readonly("stops_per_cycle", each<&Orbit::stops_per_cycle>(), "Arrests, shape (N,).")
      .def_property_readonly("multipliers", each_pair<&Orbit::multipliers>(), "Floquet multipliers, shape (N, 2).")
      .def_property_readonly("half_period_multipliers", each_pair<&Orbit::half_period_multipliers>(),
                             "As `Orbit.half_period_multipliers`, shape (N, 2).")
      .def_property_readonly(
          "folds", [](const SliderBranch& b) { return b.folds; },
          "Indices of the orbits at which the curve reverses in frequency.")
      .def("__len__", [](const SliderBranch& b) { return b.orbits.size(); })
      .def("__getitem__",
           [](const SliderBranch& b, py::ssize_t i) {
             const auto size = static_cast<py::ssize_t>(b.orbits.size());
             if (i < -size || i >= size) throw py::index_error("OrbitBranch: no such orbit");
             return SliderOrbit{b.orbits[static_cast<std::size_t>(i < 0 ? i + size : i)], b.slider};
           })
      .def("__repr__", [](const SliderBranch& b) {
        return "<OrbitBranch: " + std::to_string(b.orbits.size()) + " orbits, " + std::to_string(b.folds.size()) +
               " folds>";
      });

  m.def("orbits", &orbits_of, py::arg("slider"), py::arg("B"), py::arg("omega"),
        R"(Find the exact symmetric periodic responses of a slider to -n(t) = B cos(omega t).

x'' + resist(x) sgn(x') + wn^2 x = B cos(omega t), thesis (2.27), (2.28), (2.50); slowly varying parameters, (2.16), are
an approximation to it.

Constant friction: there is one orbit if B > a. Without stops it is Den Hartog's, in closed form; without a spring it is
A = sqrt(B^2 - (pi a/2)^2) / omega^2 for B/a >= sqrt(1 + pi^2/4), and below that the slider stops twice per cycle. At
resonance, wn = omega, there is no orbit for B >= 4 a/pi: the amplitude grows without bound. Caster: all orbits that a
search of the turning points finds, stable or not. Rest at x = 0 is included, with amplitude 0, if B is at most the slip
level there. Asymmetric orbits are not searched.

Parameters
----------
slider : Slider, Coulomb or Caster
    Without a spring, the levels of both directions must be equal.
B : float
    Amplitude of the load [m/s^2], positive and at most 1e100.
omega : float
    Angular frequency [rad/s], positive, with a finite square.

Returns
-------
list of Orbit
    Sorted by amplitude.

Raises
------
ValueError
    A value out of range; levels that differ by direction without a spring (the slider drifts).
ConvergenceError
    A caster under extreme accelerations.

Notes
-----
Orbits are accurate to some 1e-13 of their amplitude, times their largest multiplier. Constant friction takes 7 us
without a spring, 20 us with one and 2 ms with stops; a caster 10 to 200 ms, proportionally longer if a stiff spring
oscillates many times per period. Releases the interpreter lock.

References
----------
J. P. Den Hartog, Forced vibrations with combined Coulomb and viscous friction, Trans. ASME 53 (1931).)");

  m.def("continuation", &continuation_of, py::arg("slider"), py::arg("orbit"), py::arg("low"), py::arg("high"),
        py::kw_only(), py::arg("max_step") = 0.05, py::arg("max_amplitude") = std::numeric_limits<double>::infinity(),
        py::arg("max_orbits") = 10'000,
        R"(Follow an orbit along the response curve as the frequency changes.

Uses pseudo-arclength continuation over the frequency, which passes folds to the unstable orbits beyond them.

Parameters
----------
slider : Slider, Coulomb or Caster
    The slider of `orbit`.
orbit : Orbit
    Orbit to start from, not at rest.
low, high : float
    Bounds of the frequency [rad/s], positive; `orbit` must lie between them.
max_step : float, optional
    Maximum relative change of state and frequency from orbit to orbit, positive and at most 0.5.
max_amplitude : float, optional
    Amplitude at which to stop [m]: near resonance a branch may extend to infinity.
max_orbits : int, optional
    Maximum number of orbits in each direction.

Returns
-------
OrbitBranch
    `orbit` and those on both sides of it, up to where the branch leaves the bounds, ends, or closes. The folds are
    among its orbits.

Raises
------
ValueError
    A value out of range.

Notes
-----
Takes 20 to 40 us per orbit with constant friction, 1 to 4 ms for a caster. Releases the interpreter lock.

References
----------
H. B. Keller, Numerical solution of bifurcation and nonlinear eigenvalue problems (1977).)");
}

}  // namespace stickslip::python
