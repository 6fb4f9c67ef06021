#include "excitation/components.hpp"

#include <pybind11/stl.h>

#include <stdexcept>

#include "parts.hpp"

namespace stickslip::python {

template <>
inline constexpr auto parts<HeldWithVertical> = std::tuple(&HeldWithVertical::horizontal, &HeldWithVertical::vertical,
                                                           &HeldWithVertical::ratio);
template <>
inline constexpr auto parts<HeldWithTransverse> = std::tuple(&HeldWithTransverse::horizontal,
                                                             &HeldWithTransverse::transverse,
                                                             &HeldWithTransverse::ratio, &HeldWithTransverse::coherence,
                                                             &HeldWithTransverse::arrivals);

std::optional<ExcitationReference> excitation_of(const py::handle& object) {
  if (py::isinstance<GaussianExcitation>(object)) return {{&object.cast<const GaussianExcitation&>()}};
  if (py::isinstance<PoissonPulses>(object)) return {{&object.cast<const PoissonPulses&>()}};
  return std::nullopt;
}

namespace {

/// @param other  another class that `name` may be, such as "WithTransverse"
[[noreturn]] void refuse_type(const std::string& who, const std::string& name, const std::string& other,
                              const py::object& object) {
  const std::string component = who == "WithVertical" ? "vertical" : "transverse";
  throw py::type_error(who + ": " + name + " must be a GaussianExcitation" + (other.empty() ? " or " : ", ") +
                       "PoissonPulses" + (other.empty() ? "" : " or " + other) + ", got " +
                       py::type::of(object).attr("__name__").cast<std::string>() +
                       "; a user-defined excitation gives its motions a " + component +
                       " component itself, GroundMotion(..., " + component + "=...)");
}

ExcitationReference required_reference(const std::string& who, const std::string& name, const py::object& object) {
  if (const auto reference = excitation_of(object)) return *reference;
  refuse_type(who, name, "", object);
}

Arrivals arrivals_of(const std::string& name) {
  if (name == "common") return Arrivals::common;
  if (name == "independent") return Arrivals::independent;
  throw std::invalid_argument("WithTransverse: arrivals must be 'common' or 'independent', got '" + name + "'");
}

/// Without vertical motion, what is under a WithVertical; without a transverse component, what is under a
/// WithTransverse: the excitation along the axis.
py::object axis_of(py::object object) {
  while (true)
    if (py::isinstance<HeldWithVertical>(object))
      object = object.cast<const HeldWithVertical&>().horizontal;
    else if (py::isinstance<HeldWithTransverse>(object))
      object = object.cast<const HeldWithTransverse&>().horizontal;
    else
      return object;
}

void require_one_interpolation(const std::string& who, const ExcitationReference& a, const ExcitationReference& b) {
  if (a.interpolation() != b.interpolation())
    throw std::invalid_argument(
        who + ": both components must be lines between samples or both held values, got interpolation='" +
        name_of(a.interpolation()) + "' and '" + name_of(b.interpolation()) + "' (pulses are held values)");
}

std::string text_of(const py::object& object) { return py::repr(object).cast<std::string>(); }

/// What both classes have in common.
template <class Held>
void bind_common(py::class_<Held>& type, const char* sample_doc) {
  type.def(
          "sample",
          [](const py::object& self, std::uint64_t seed, std::uint64_t member) {
            const Components excitation = *components_of(self);
            const py::gil_scoped_release released;
            return excitation.sample(seed, member);
          },
          py::kw_only(), py::arg("seed"), py::arg("member"), sample_doc)
      .def_property_readonly(
          "duration", [](const py::object& self) { return components_of(self)->duration(); },
          "Duration of a motion [s].")
      .def_property_readonly(
          "configuration", [](const py::object& self) { return components_of(self)->configuration(); },
          "Everything that determines the motions, as a JSON object.");
}

}  // namespace

std::optional<Components> components_of(const py::object& object) {
  if (py::isinstance<HeldWithVertical>(object)) {
    const auto& held = object.cast<const HeldWithVertical&>();
    const Components::Vertical vertical{required_reference("WithVertical", "vertical", held.vertical), held.ratio};
    if (const auto reference = excitation_of(held.horizontal)) return Components{*reference, {}, vertical};
    auto components = components_of(held.horizontal);
    if (!components || components->vertical)
      refuse_type("WithVertical", "horizontal", "WithTransverse", held.horizontal);
    components->vertical = vertical;
    return components;
  }
  if (py::isinstance<HeldWithTransverse>(object)) {
    const auto& held = object.cast<const HeldWithTransverse&>();
    const Components::Transverse transverse{
        required_reference("WithTransverse", "transverse", held.transverse), held.ratio, held.coherence,
        held.arrivals.empty() ? std::nullopt : std::optional(arrivals_of(held.arrivals))};
    if (const auto reference = excitation_of(held.horizontal)) return Components{*reference, transverse, {}};
    auto components = components_of(held.horizontal);
    if (!components || components->transverse)
      refuse_type("WithTransverse", "horizontal", "WithVertical", held.horizontal);
    components->transverse = transverse;
    return components;
  }
  return std::nullopt;
}

void bind_with_vertical(py::module_& m) {
  auto type = value_class<HeldWithVertical>(m, "WithVertical",
                                            R"(An excitation whose motions also have a vertical component.

The vertical component is drawn independently of the horizontal one. The slider moves under n(t) and a_z(t), and
friction is proportional to the normal force, on level ground N = g + a_z; see `integrate`. (seed, member) determines
both components. The horizontal one has the same bits as without a vertical one, so an ensemble with the vertical
component can be compared member by member with one without.

Parameters
----------
horizontal : GaussianExcitation, PoissonPulses or WithTransverse
    Excitation of the horizontal component, or of both.
vertical : GaussianExcitation or PoissonPulses, optional
    Excitation of the vertical component, positive upward, with the same duration and interpolation. Its step may
    differ: the motion then has the times of both. Default: the excitation of the component along the axis, drawn
    independently.
ratio : float, optional
    Factor on the vertical component, finite and at least 0; default 1. With the default of `vertical` it is the ratio
    V/H of the rms accelerations, in earthquakes often near 2/3.

Raises
------
ValueError
    A ratio out of range; durations or interpolations that differ.
TypeError
    Another excitation. A user-defined excitation gives its motions a vertical component itself.

Warns
-----
PlausibilityWarning
    A ratio of 10 or more, which may be in percent.

Notes
-----
The components of an earthquake are not independent, and the vertical one has more of high frequencies. This model
leaves the dependence out; the frequencies are those of `vertical`. A member of an ensemble that is in flight at the end
of its motion counts with its state there (`Ensemble.airborne`); with `settle` it lands.

Theories and `compare` do not cover vertical motion.)");
  type.def(py::init([](const py::object& horizontal, const py::object& vertical, double ratio) {
             check_unit("ratio of components", "WithVertical", "ratio", ratio);
             HeldWithVertical held{horizontal, vertical.is_none() ? axis_of(horizontal) : vertical, ratio};
             if (!excitation_of(horizontal) && !py::isinstance<HeldWithTransverse>(horizontal))
               refuse_type("WithVertical", "horizontal", "WithTransverse", horizontal);
             const Components components = *components_of(py::cast(held));
             components.visit([](const auto&) {});  // checks the ratio and the durations
             require_one_interpolation("WithVertical", components.horizontal, components.vertical->excitation);
             return held;
           }),
           py::arg("horizontal"), py::arg("vertical") = py::none(), py::kw_only(), py::arg("ratio") = 1.0)
      .def_property_readonly(
          "horizontal", [](const HeldWithVertical& self) { return self.horizontal; },
          "Excitation of the horizontal component, or of both.")
      .def_property_readonly(
          "vertical", [](const HeldWithVertical& self) { return self.vertical; },
          "Excitation of the vertical component, before it is multiplied by the ratio.")
      .def_property_readonly(
          "ratio", [](const HeldWithVertical& self) { return self.ratio; }, "Factor on the vertical component.")
      .def("__repr__", [](const HeldWithVertical& self) {
        return "WithVertical(" + text_of(self.horizontal) +
               (self.vertical.is(axis_of(self.horizontal)) ? "" : ", " + text_of(self.vertical)) +
               ", ratio=" + detail::shortest(self.ratio) + ")";
      });
  bind_common(type, R"(Generate the motion of a member, with its vertical component.

Parameters
----------
seed, member : int
    From 0 to 2^64 - 1.

Returns
-------
GroundMotion)");
}

void bind_with_transverse(py::module_& m) {
  auto type = value_class<HeldWithTransverse>(m, "WithTransverse",
                                              R"(An excitation whose motions have two horizontal components.

The transverse component is 90 degrees clockwise of the axis, seen from above, as in `GroundMotion`:

    transverse = ratio (coherence (s_t / s_n) n + sqrt(1 - coherence^2) t)

n is the component along the axis, a motion of `horizontal`; t is an independent motion of `transverse`; s_n and s_t are
their rms accelerations, the roots of `variance`. The transverse component then has the rms acceleration ratio s_t. For
equal excitations s_t / s_n is exactly 1. (seed, member) determines both components; the one along the axis has the same
bits as without a transverse one.

Parameters
----------
horizontal : GaussianExcitation, PoissonPulses or WithVertical
    Excitation of the component along the axis. The motions keep the vertical component of a WithVertical.
transverse : GaussianExcitation or PoissonPulses, optional
    Excitation of t, with the same duration and interpolation. Its step may differ: the motion then has the times of
    both. Default: the excitation of the component along the axis, with other random numbers.
ratio : float, optional
    Factor on the transverse component, finite and at least 0; default 1. With the default of `transverse` it is the
    ratio of the rms accelerations.
coherence : float, optional
    Correlation of the two components at equal times, from -1 to 1; default 0. Both are in proportion if it is 1 or -1.
arrivals : {'common', 'independent'}, optional
    When the pulses of both components arrive, if both have the same PoissonPulses. With 'common', their default, pulse
    k has the amplitudes (b_k, ratio (coherence b_k + sqrt(1 - coherence^2) b'_k)) with independent b_k and b'_k: each
    pulse has a random direction. With Gaussian amplitudes, ratio 1 and coherence 0 all azimuths are equally likely.
    With 'independent', each component has its own pulses.

Raises
------
ValueError
    A ratio or coherence out of range; durations or interpolations that differ; common arrivals of excitations that are
    not the same PoissonPulses.
TypeError
    Another excitation. A user-defined excitation gives its motions a transverse component itself.

Warns
-----
PlausibilityWarning
    A ratio of 10 or more, which may be in percent.

Notes
-----
`coherence` is the correlation at any time in a stationary motion, and wherever the envelopes of both excitations are
equal. If the excitations differ, the spectral density of the transverse component is the sum of both, weighted by
ratio^2 coherence^2 (s_t / s_n)^2 and ratio^2 (1 - coherence^2).

Nests with `WithVertical` in either order. Both orders give the same motions to the bit and have the same
`configuration`, so that ensembles under them can be merged; the vertical component is independent of both others.

Sliders on one axis do not feel the transverse component. An ensemble of them does not generate it: it has the bits, and
takes the time, of one under `horizontal`. `sample` returns the motion of a member with all components.

The components of an earthquake are also correlated at different times. This model has the correlation at equal times
only; records have their own pairs.

Examples
--------
>>> import stickslip as ss
>>> pulses = ss.PoissonPulses.event("great near field")
>>> pair = ss.WithTransverse(pulses, ratio=0.8, coherence=0.3).sample(seed=1, member=0)
>>> bool((pair.acceleration == pulses.sample(seed=1, member=0).acceleration).all())
True)");
  type.def(py::init([](const py::object& horizontal, const py::object& transverse, double ratio, double coherence,
                       const std::optional<std::string>& arrivals) {
             if (!excitation_of(horizontal) && !py::isinstance<HeldWithVertical>(horizontal))
               refuse_type("WithTransverse", "horizontal", "WithVertical", horizontal);
             check_unit("ratio of components", "WithTransverse", "ratio", ratio);
             HeldWithTransverse held{horizontal, transverse.is_none() ? axis_of(horizontal) : transverse, ratio,
                                     coherence, arrivals.value_or("")};
             const Components components = *components_of(py::cast(held));
             held.arrivals = name_of(components.pairs().arrivals());  // checks the values and the durations
             require_one_interpolation("WithTransverse", components.horizontal, components.transverse->excitation);
             return held;
           }),
           py::arg("horizontal"), py::arg("transverse") = py::none(), py::arg("ratio") = 1.0,
           py::arg("coherence") = 0.0, py::kw_only(), py::arg("arrivals") = py::none())
      .def_property_readonly(
          "horizontal", [](const HeldWithTransverse& self) { return self.horizontal; },
          "Excitation of the component along the axis.")
      .def_property_readonly(
          "transverse", [](const HeldWithTransverse& self) { return self.transverse; },
          "Excitation of the independent part of the transverse component.")
      .def_property_readonly(
          "ratio", [](const HeldWithTransverse& self) { return self.ratio; }, "Factor on the transverse component.")
      .def_property_readonly(
          "coherence", [](const HeldWithTransverse& self) { return self.coherence; },
          "Correlation of the two components at equal times.")
      .def_property_readonly(
          "arrivals", [](const HeldWithTransverse& self) { return self.arrivals; },
          "When pulses of both components arrive: 'common' or 'independent'.")
      .def("__repr__", [](const HeldWithTransverse& self) {
        const Components components = *components_of(py::cast(self));
        const auto& transverse = *components.transverse;
        const Pairs usual(components.horizontal, transverse.excitation);
        return "WithTransverse(" + text_of(self.horizontal) +
               (self.transverse.is(axis_of(self.horizontal)) ? "" : ", " + text_of(self.transverse)) +
               ", ratio=" + detail::shortest(self.ratio) + ", coherence=" + detail::shortest(self.coherence) +
               (self.arrivals == name_of(usual.arrivals()) ? "" : ", arrivals='" + self.arrivals + "'") + ")";
      });
  bind_common(type, R"(Generate the motion of a member, with its transverse component.

Parameters
----------
seed, member : int
    From 0 to 2^64 - 1.

Returns
-------
GroundMotion)");
}

}  // namespace stickslip::python
