// Pickling, copying, comparison and hash of a class, from one list of its parts.
#pragma once

#include <pybind11/complex.h>
#include <pybind11/stl.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <concepts>
#include <cstddef>
#include <cstring>
#include <functional>
#include <ranges>
#include <tuple>
#include <type_traits>

#include "bindings.hpp"
#include "reproduction/thesis.hpp"

namespace stickslip::python {

/// Data members or getters, in the order in which T{...} takes them. A class with this list gets all of the above:
///     template <> inline constexpr auto parts<Interval> = std::tuple(&Interval::value, &Interval::low, ...);
template <class T>
inline constexpr auto parts = nullptr;

template <class T>
concept MadeOfParts = !std::same_as<std::remove_cvref_t<decltype(parts<T>)>, std::nullptr_t>;

// All in one place: wherever a class is used, the parts of its members must be known too.

/// Friction laws list theirs in the library.
template <WithParts T>
inline constexpr auto parts<T> = std::apply([](auto... part) { return std::tuple(part.get...); }, T::parts());

template <>
inline constexpr auto parts<CallableLaw> = std::tuple(&CallableLaw::hold_function, &CallableLaw::resist_function);
template <>
inline constexpr auto parts<SurfaceHeat> = std::tuple(&SurfaceHeat::values);
template <>
inline constexpr auto parts<Stops> = std::tuple(&Stops::forward, &Stops::backward, &Stops::restitution);
template <>
inline constexpr auto parts<HarmonicMotion> = std::tuple(&HarmonicMotion::amplitude, &HarmonicMotion::omega,
                                                         &HarmonicMotion::duration, &HarmonicMotion::dt);

template <>
inline constexpr auto parts<PendulumMemory> = std::tuple(&PendulumMemory::place, &PendulumMemory::force,
                                                         &PendulumMemory::direction, &PendulumMemory::moving,
                                                         &PendulumMemory::at_forward, &PendulumMemory::at_backward);
template <>
inline constexpr auto parts<State> = std::tuple(&State::displacement, &State::velocity, &State::mode, &State::in_flight,
                                                &State::gap, &State::gap_velocity, &State::sliding_distance,
                                                &State::heat, &State::pendulum);
template <>
inline constexpr auto parts<PendulumLoop::Corner> = std::tuple(&PendulumLoop::Corner::displacement,
                                                               &PendulumLoop::Corner::force,
                                                               &PendulumLoop::Corner::moving);
template <>
inline constexpr auto parts<PendulumLoop> = std::tuple(&PendulumLoop::force, &PendulumLoop::corners,
                                                       &PendulumLoop::displacement, &PendulumLoop::surfaces,
                                                       &PendulumLoop::dissipated, &PendulumLoop::sliding_distance,
                                                       &PendulumLoop::slides, &PendulumLoop::stops,
                                                       &PendulumLoop::surface_stops);
template <>
inline constexpr auto parts<ElementMotion> = std::tuple(&ElementMotion::displacement, &ElementMotion::surfaces,
                                                        &ElementMotion::dissipated, &ElementMotion::sliding_distance,
                                                        &ElementMotion::peak, &ElementMotion::surface_peak,
                                                        &ElementMotion::slides, &ElementMotion::stops,
                                                        &ElementMotion::surface_stops);
template <>
inline constexpr auto parts<SurfaceMotion> = std::tuple(&SurfaceMotion::motion);
template <>
inline constexpr auto parts<Event> = std::tuple(&Event::time, &Event::displacement, &Event::velocity, &Event::kind);
template <>
inline constexpr auto parts<Energy> = std::tuple(&Energy::initial, &Energy::input, &Energy::dissipated, &Energy::damped,
                                                 &Energy::kinetic, &Energy::elastic, &Energy::impact);
template <>
inline constexpr auto parts<Sensitivity> = std::tuple(&Sensitivity::peak, &Sensitivity::residual,
                                                      &Sensitivity::velocity);
template <>
inline constexpr auto parts<Response> = std::tuple(&Response::displacement, &Response::velocity, &Response::events,
                                                   &Response::peak, &Response::residual, &Response::sliding_distance,
                                                   &Response::time_sliding, &Response::energy, &Response::gap,
                                                   &Response::truncated, &Response::contact, &Response::components,
                                                   &Response::state, &Response::temperature);
template <>
inline constexpr auto parts<Vector2> = std::tuple(&Vector2::axis, &Vector2::transverse);
template <>
inline constexpr auto parts<PlanarState> = std::tuple(&PlanarState::displacement, &PlanarState::velocity,
                                                      &PlanarState::mode, &PlanarState::in_flight, &PlanarState::gap,
                                                      &PlanarState::gap_velocity, &PlanarState::sliding_distance,
                                                      &PlanarState::heat);
template <>
inline constexpr auto parts<PlanarEvent> = std::tuple(&PlanarEvent::time, &PlanarEvent::displacement,
                                                      &PlanarEvent::velocity, &PlanarEvent::kind);
template <>
inline constexpr auto parts<PlanarResponse> =
    std::tuple(&PlanarResponse::displacement, &PlanarResponse::velocity, &PlanarResponse::events, &PlanarResponse::peak,
               &PlanarResponse::residual, &PlanarResponse::sliding_distance, &PlanarResponse::time_sliding,
               &PlanarResponse::energy, &PlanarResponse::gap, &PlanarResponse::truncated, &PlanarResponse::contact,
               &PlanarResponse::components, &PlanarResponse::state, &PlanarResponse::temperature,
               &PlanarResponse::peak_time, &PlanarResponse::peak_displacement, &PlanarResponse::heat);
template <>
inline constexpr auto parts<Orbit> = std::tuple(&Orbit::load, &Orbit::omega, &Orbit::amplitude, &Orbit::phase,
                                                &Orbit::stops_per_cycle, &Orbit::reversals_per_cycle,
                                                &Orbit::half_period_multipliers, &Orbit::multipliers, &Orbit::stable,
                                                &Orbit::mean_arbitrary, &Orbit::center, &Orbit::state, &Orbit::events,
                                                &Orbit::dissipated);

template <>
inline constexpr auto parts<Estimate> = std::tuple(&Estimate::value, &Estimate::error);
template <>
inline constexpr auto parts<Estimates> = std::tuple(&Estimates::value, &Estimates::error);
template <>
inline constexpr auto parts<Interval> = std::tuple(&Interval::value, &Interval::low, &Interval::high);
template <>
inline constexpr auto parts<FloorPeaks> = std::tuple(&FloorPeaks::values, &FloorPeaks::floors);
template <>
inline constexpr auto parts<Moments> = std::tuple(&Moments::time, &Moments::displacement_mean,
                                                  &Moments::displacement_variance, &Moments::covariance,
                                                  &Moments::velocity_mean, &Moments::velocity_variance,
                                                  &Moments::growth_rate, &Moments::remark);
template <>
inline constexpr auto parts<Stationary> = std::tuple(&Stationary::begin, &Stationary::end, &Stationary::velocity_mean,
                                                     &Stationary::velocity_variance, &Stationary::velocity_kurtosis,
                                                     &Stationary::covariance, &Stationary::growth_rate,
                                                     &Stationary::velocity_trend, &Stationary::remark);
template <>
inline constexpr auto parts<VelocitySpectrum> = std::tuple(&VelocitySpectrum::omega, &VelocitySpectrum::density,
                                                           &VelocitySpectrum::error);
template <>
inline constexpr auto parts<ResponseSpectrum> = std::tuple(&ResponseSpectrum::kind, &ResponseSpectrum::periods,
                                                           &ResponseSpectrum::damping, &ResponseSpectrum::values);
template <>
inline constexpr auto parts<StrongMotion> =
    std::tuple(&StrongMotion::peak_acceleration, &StrongMotion::peak_velocity, &StrongMotion::peak_displacement,
               &StrongMotion::cumulative_absolute_velocity, &StrongMotion::mean_period, &StrongMotion::arias_intensity,
               &StrongMotion::begin, &StrongMotion::end, &StrongMotion::duration, &StrongMotion::duration_5_75,
               &StrongMotion::rms_acceleration, &StrongMotion::rms_velocity, &StrongMotion::center_frequency_hz);
template <>
inline constexpr auto parts<PulseFit> = std::tuple(&PulseFit::half_width, &PulseFit::half_width_error,
                                                   &PulseFit::intensity, &PulseFit::rms_acceleration,
                                                   &PulseFit::center_frequency_hz, &PulseFit::misfit);

template <>
inline constexpr auto parts<theory::Coverage> = std::tuple(&theory::Coverage::reason, &theory::Coverage::excitation);
template <>
inline constexpr auto parts<theory::WhiteNoise> = std::tuple(&theory::WhiteNoise::law, &theory::WhiteNoise::s0,
                                                             &theory::WhiteNoise::dimensions);
template <>
inline constexpr auto parts<theory::ShapingFilter::Section> = std::tuple(&theory::ShapingFilter::Section::b2,
                                                                         &theory::ShapingFilter::Section::b1,
                                                                         &theory::ShapingFilter::Section::b0,
                                                                         &theory::ShapingFilter::Section::d1,
                                                                         &theory::ShapingFilter::Section::d0);
template <>
inline constexpr auto parts<theory::ShapingFilter> = std::tuple(&theory::ShapingFilter::s0,
                                                                &theory::ShapingFilter::sections,
                                                                &theory::ShapingFilter::misfit);
template <>
inline constexpr auto parts<theory::ShapingFilter::Fit> = std::tuple(&theory::ShapingFilter::Fit::order,
                                                                     &theory::ShapingFilter::Fit::max_misfit);
template <>
inline constexpr auto parts<theory::EquivalentLinearization::Options> =
    std::tuple(&theory::EquivalentLinearization::Options::force, &theory::EquivalentLinearization::Options::start,
               &theory::EquivalentLinearization::Options::tolerance, &theory::EquivalentLinearization::Options::filter,
               &theory::EquivalentLinearization::Options::dimensions);
template <>
inline constexpr auto parts<theory::EquivalentLinearization> = std::tuple(&theory::EquivalentLinearization::options);
template <>
inline constexpr auto parts<theory::TransitionTime> = std::tuple(&theory::TransitionTime::thesis,
                                                                 &theory::TransitionTime::with_intercept);
template <>
inline constexpr auto parts<theory::PulseChain> = std::tuple(&theory::PulseChain::refined);
template <>
inline constexpr auto parts<theory::PulseSuperposition> = std::tuple(&theory::PulseSuperposition::overlap);
template <>
inline constexpr auto parts<theory::PulseResponse> =
    std::tuple(&theory::PulseResponse::time, &theory::PulseResponse::displacement, &theory::PulseResponse::velocity,
               &theory::PulseResponse::offset, &theory::PulseResponse::peak, &theory::PulseResponse::stop,
               &theory::PulseResponse::velocity_square);
template <>
inline constexpr auto parts<theory::HarmonicSolution> = std::tuple(&theory::HarmonicSolution::amplitude,
                                                                   &theory::HarmonicSolution::phase,
                                                                   &theory::HarmonicSolution::stable);
template <>
inline constexpr auto parts<theory::StationaryLinearization> = std::tuple();
template <>
inline constexpr auto parts<theory::StationaryPrediction> =
    std::tuple(&theory::StationaryPrediction::damping, &theory::StationaryPrediction::velocity_std,
               &theory::StationaryPrediction::displacement_std, &theory::StationaryPrediction::growth_rate,
               &theory::StationaryPrediction::remark, &theory::StationaryPrediction::spectrum,
               &theory::StationaryPrediction::natural_frequency);

template <>
inline constexpr auto parts<ThesisCurve> = std::tuple(&ThesisCurve::label, &ThesisCurve::kind, &ThesisCurve::x,
                                                      &ThesisCurve::y, &ThesisCurve::error, &ThesisCurve::members);
template <>
inline constexpr auto parts<ThesisPanel> = std::tuple(&ThesisPanel::title, &ThesisPanel::x, &ThesisPanel::y,
                                                      &ThesisPanel::log_x, &ThesisPanel::log_y, &ThesisPanel::curves,
                                                      &ThesisPanel::x_limits, &ThesisPanel::y_limits);
template <>
inline constexpr auto parts<ThesisStatement> = std::tuple(&ThesisStatement::where, &ThesisStatement::claim,
                                                          &ThesisStatement::bound, &ThesisStatement::said,
                                                          &ThesisStatement::within, &ThesisStatement::found,
                                                          &ThesisStatement::error, &ThesisStatement::why,
                                                          &ThesisStatement::members);
template <>
inline constexpr auto parts<ThesisCheck> = std::tuple(&ThesisCheck::what, &ThesisCheck::found, &ThesisCheck::expected,
                                                      &ThesisCheck::allowed, &ThesisCheck::holds, &ThesisCheck::loose);
template <>
inline constexpr auto parts<ThesisFigure> = std::tuple(&ThesisFigure::number, &ThesisFigure::caption,
                                                       &ThesisFigure::thesis_cost, &ThesisFigure::panels,
                                                       &ThesisFigure::statements, &ThesisFigure::seconds);

template <class T>
concept Sequence = std::ranges::random_access_range<T> && !std::convertible_to<T, std::string_view> &&
                   !std::derived_from<T, py::handle>;

/// Converts a value to plain Python objects, for pickling.
template <class T>
py::object pack(const T& value) {
  if constexpr (MadeOfParts<T>) {
    return std::apply([&](auto... part) { return py::make_tuple(pack(std::invoke(part, value))...); }, parts<T>);
  } else if constexpr (std::is_enum_v<T>) {
    return py::int_(static_cast<int>(value));
  } else if constexpr (std::same_as<T, std::vector<double>>) {
    return to_array(value);
  } else if constexpr (std::same_as<T, std::vector<Vector2>>) {
    py::array_t<double> array({static_cast<py::ssize_t>(value.size()), py::ssize_t{2}});
    std::memcpy(array.mutable_data(), value.data(), value.size() * sizeof(Vector2));
    return array;
  } else if constexpr (Sequence<T>) {
    py::list list;
    for (const auto& element : value) list.append(pack(element));
    return list;
  } else if constexpr (std::derived_from<T, py::object>) {
    return value;
  } else {
    return py::cast(value);
  }
}

template <class T>
T unpack(const py::object& packed);

template <class T, std::size_t... i>
T unpack_parts(const py::tuple& packed, std::index_sequence<i...>) {
  if (packed.size() != sizeof...(i))
    throw std::invalid_argument("unpickling: expected " + std::to_string(sizeof...(i)) + " values, got " +
                                std::to_string(packed.size()));
  return T{unpack<std::remove_cvref_t<std::invoke_result_t<decltype(std::get<i>(parts<T>)), const T&>>>(
      packed[i].template cast<py::object>())...};
}

template <class T>
T unpack(const py::object& packed) {
  if constexpr (MadeOfParts<T>) {
    return unpack_parts<T>(packed.cast<py::tuple>(),
                           std::make_index_sequence<std::tuple_size_v<std::remove_cvref_t<decltype(parts<T>)>>>());
  } else if constexpr (std::is_enum_v<T>) {
    return static_cast<T>(packed.cast<int>());
  } else if constexpr (std::same_as<T, std::vector<double>>) {
    return to_vector(packed, "unpickling: values");
  } else if constexpr (std::same_as<T, std::vector<Vector2>>) {
    const Numbers numbers = to_numbers(packed, "unpickling: values");
    if (numbers.ndim() != 2 || numbers.shape(1) != 2)
      throw std::invalid_argument("unpickling: values must have the shape (N, 2)");
    std::vector<Vector2> vectors;
    vectors.reserve(static_cast<std::size_t>(numbers.shape(0)));
    for (py::ssize_t i = 0; i < numbers.shape(0); ++i) vectors.push_back({*numbers.data(i, 0), *numbers.data(i, 1)});
    return vectors;
  } else if constexpr (Sequence<T> && requires(T list) { list.reserve(0); }) {
    T list;
    for (const py::handle element : packed)
      list.push_back(unpack<typename T::value_type>(py::reinterpret_borrow<py::object>(element)));
    return list;
  } else {
    return packed.cast<T>();
  }
}

/// Whether both have the same content. All NaNs are equal.
template <class T>
bool same(const T& a, const T& b) {
  if constexpr (MadeOfParts<T>)
    return std::apply([&](auto... part) { return (same(std::invoke(part, a), std::invoke(part, b)) && ...); },
                      parts<T>);
  else if constexpr (std::floating_point<T>)
    return a == b || (std::isnan(a) && std::isnan(b));
  else if constexpr (std::same_as<T, std::complex<double>>)
    return same(a.real(), b.real()) && same(a.imag(), b.imag());
  else if constexpr (Sequence<T>)
    return std::ranges::equal(a, b, [](const auto& x, const auto& y) { return same(x, y); });
  else
    return pack(a).equal(pack(b));
}

/// A hash that is equal for objects with the same content.
template <class T>
std::size_t hash_of(const T& value) {
  const auto join = [](std::size_t hash, std::size_t next) { return hash * 1'000'003 ^ next; };
  std::size_t hash = 0;
  if constexpr (MadeOfParts<T>) {
    std::apply([&](auto... part) { ((hash = join(hash, hash_of(std::invoke(part, value)))), ...); }, parts<T>);
  } else if constexpr (std::floating_point<T>) {
    hash = std::isnan(value) ? 0 : std::hash<T>()(value);
  } else if constexpr (std::same_as<T, std::complex<double>>) {
    hash = join(hash_of(value.real()), hash_of(value.imag()));
  } else if constexpr (Sequence<T>) {
    for (const auto& element : value) hash = join(hash, hash_of(element));
  } else {
    hash = static_cast<std::size_t>(py::hash(pack(value)));
  }
  return hash;
}

/// A class of immutable objects, which compare by content and can be hashed, copied and pickled.
/// @tparam Bases  bound classes from which it is derived
template <MadeOfParts T, class... Bases>
py::class_<T, Bases...> value_class(py::module_& m, const char* name, std::string doc) {
  doc.insert(std::min(doc.find("\n\n"), doc.size()),
             "\n\nObjects compare by content; they can be hashed, copied and pickled.");
  py::class_<T, Bases...> type(m, name, doc.c_str());
  type.def(
          "__eq__",
          [](const T& self, const py::object& other) -> py::object {  // `const T&` would convert a law to a slider
            if (!py::isinstance<T>(other)) return py::reinterpret_borrow<py::object>(Py_NotImplemented);
            return py::bool_(same(self, other.cast<const T&>()));
          },
          py::is_operator())
      .def("__hash__", [](const T& self) { return static_cast<py::ssize_t>(hash_of(self) >> 1); })
      .def(py::pickle([](const T& self) { return py::tuple(pack(self)); },
                      [](const py::tuple& state) { return unpack<T>(state); }));
  return type;
}

}  // namespace stickslip::python
