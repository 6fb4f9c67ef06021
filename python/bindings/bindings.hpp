// Shared by the binding files: one `bind_` function for each noun, and a type for sliders of any law.
#pragma once

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <cmath>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "friction/callable_law.hpp"
#include "plausibility.hpp"
#include "statistics/estimate.hpp"
#include "stickslip/stickslip.hpp"

namespace py = pybind11;

namespace stickslip::python {

/// The Python class SurfaceMotion: what an ElementMotion says of the surfaces.
struct SurfaceMotion {
  ElementMotion motion;
};

template <class Law>
using IsStaticKinetic = std::bool_constant<is_static_kinetic<Law>>;
template <class... Laws>
std::variant<Laws...> any_of(LawList<Laws...>);  // for types only

/// The Python class StaticKinetic.
using StaticKineticLaws = LibraryLaws::where<IsStaticKinetic>;
using AnyStaticKinetic = decltype(any_of(StaticKineticLaws()));

}  // namespace stickslip::python

// These variants are classes in Python, not converted as by pybind11/stl.h.
PYBIND11_MAKE_OPAQUE(stickslip::AnyPlanarSlider)
PYBIND11_MAKE_OPAQUE(stickslip::python::AnyStaticKinetic)

namespace pybind11::detail {

/// A law where a slider is expected is the slider of that law alone. It is found at the first attempt: an implicit
/// conversion would come after all overloads have been tried without one.
template <>
class type_caster<stickslip::AnySlider> : public type_caster_base<stickslip::AnySlider> {
 public:
  bool load(handle source, bool convert);

 private:
  std::optional<stickslip::AnySlider> made_;
};

}  // namespace pybind11::detail

namespace stickslip::python {

/// A number as Python reads it back.
inline std::string literal(double value) {
  return std::isfinite(value) ? detail::shortest(value) : "float('" + detail::shortest(value) + "')";
}

void bind_errors(py::module_& m);
void bind_laws(py::module_& m);
void bind_static_kinetic(py::module_& m);
void bind_element_motion(py::module_& m);
void bind_stops(py::module_& m);
void bind_slider(py::module_& m);
void bind_identity(py::module_& m);
void bind_ground_motion(py::module_& m);
void bind_harmonic_motion(py::module_& m);
void bind_harmonic(py::module_& m);
void bind_histories(py::module_& m);
void bind_records(py::module_& m);
void bind_response(py::module_& m);
void bind_state(py::module_& m);
void bind_advance(py::module_& m);
void bind_integrate(py::module_& m);
void bind_planar_slider(py::module_& m);
void bind_planar_advance(py::module_& m);
void bind_planar_response(py::module_& m);
void bind_planar_integrate(py::module_& m);
void bind_planar_histories(py::module_& m);
void bind_envelope(py::module_& m);
void bind_spectrum(py::module_& m);
void bind_response_spectrum(py::module_& m);
void bind_strong_motion(py::module_& m);
void bind_pulse_fit(py::module_& m);
void bind_viscous(py::module_& m);
void bind_gaussian(py::module_& m);
void bind_poisson(py::module_& m);
void bind_with_vertical(py::module_& m);
void bind_with_transverse(py::module_& m);
void bind_moments(py::module_& m);
void bind_theory(py::module_& m);
void bind_stationary_linearization(py::module_& m);
void bind_estimates(py::module_& m);
void bind_distributions(py::module_& m);
void bind_stationary(py::module_& m);
void bind_floor_peaks(py::module_& m);
void bind_velocity_spectrum(py::module_& m);
void bind_drawn(py::module_& m);
void bind_ensemble(py::module_& m);
void bind_run_ensemble(py::module_& m);
void bind_ensemble_sensitivity(py::module_& m);
void bind_run_ensemble_sensitivity(py::module_& m);
void bind_sweep(py::module_& m);
void bind_orientations(py::module_& m);
void bind_slowly_varying_parameters(py::module_& m);
void bind_white_noise(py::module_& m);
void bind_shaping_filter(py::module_& m);
void bind_equivalent_linearization(py::module_& m);
void bind_pulse_response(py::module_& m);
void bind_displacement_distribution(py::module_& m);
void bind_pulse_superposition(py::module_& m);
void bind_pulse_chain(py::module_& m);
void bind_transport(py::module_& m);
void bind_thesis(py::module_& m);
void bind_build_info(py::module_& m);
void bind_number_texts(py::module_& m);

/// Binds a law of the library, in friction/<law>.cpp. (StaticKinetic is one class.)
template <FrictionLaw Law>
void bind_law(py::module_& m);
#define STICKSLIP_BOUND(...) \
  template <>                \
  void bind_law<__VA_ARGS__>(py::module_ & m);
STICKSLIP_LAWS(STICKSLIP_BOUND)
#undef STICKSLIP_BOUND

/// The Python class FrictionLaw, from which all laws are derived there.
class AnyLaw {};

/// Gives all functions and classes of the module signatures that Python can read, and plain-language errors.
void make_plain(py::module_& m);

/// Calls `work` with the slider in its static type. Rejects, as theories do, laws that depend on the speed or on the
/// sliding distance, and laws that hold more at rest than while sliding.
template <class Work>
auto with_position_law(const AnySlider& slider, const char* who, Work&& work) {
  return std::visit(
      [&]<class Law>(const Slider<Law>& one) -> decltype(work(std::get<0>(slider))) {
        if constexpr (!PositionLaw<Law>)
          detail::refuse_law<Law>(who);
        else if constexpr (LawWithHold<Law>)
          throw std::invalid_argument(std::string(who) + ": does not cover static friction above kinetic");
        else
          return work(one);
      },
      slider);
}

/// A law as an object.
template <FrictionLaw Law>
py::object law_object(const Law& law) {
  return py::cast(law);
}
template <FrictionLaw Law>
py::object law_object(const StaticKinetic<Law>& law) {
  return py::cast(AnyStaticKinetic(law));
}
inline py::object law_object(const FunctionLaw& law) { return py::cast(*law.resist_function().target<CallableLaw>()); }

/// The C++ class of a law that is bound to Python.
template <class Law>
struct BoundLaw {
  using type = Law;
};
template <>
struct BoundLaw<FunctionLaw> {
  using type = CallableLaw;
};
template <class Law>
struct BoundLaw<StaticKinetic<Law>> {
  using type = AnyStaticKinetic;
};

/// The slider without spring of a law; nullopt if the object is not a law.
inline std::optional<AnySlider> slider_of_law(const py::handle& object) {
  std::optional<AnySlider> slider;
  LibraryLaws::for_each([&]<class Law>() {
    using Bound = typename BoundLaw<Law>::type;
    if (slider || !py::isinstance<Bound>(object)) return;
    const auto& law = object.cast<const Bound&>();
    if constexpr (std::same_as<Law, Bound>) {
      slider = Slider(law);
    } else if constexpr (is_static_kinetic<Law>) {
      if (const auto* const one = std::get_if<Law>(&law)) slider = Slider(*one);
    } else {
      slider = Slider(law.law());
    }
  });
  return slider;
}

}  // namespace stickslip::python

inline bool pybind11::detail::type_caster<stickslip::AnySlider>::load(handle source, bool convert) {
  if (!isinstance<stickslip::python::AnyLaw>(source))
    return type_caster_base<stickslip::AnySlider>::load(source, convert);
  made_ = stickslip::python::slider_of_law(source);
  value = made_ ? &*made_ : nullptr;
  return made_.has_value();
}

namespace stickslip::python {

/// The slider that an object is, or that it defines as a law; nullopt if it is neither.
inline std::optional<AnySlider> slider_of(const py::handle& object) {
  if (py::isinstance<AnySlider>(object)) return object.cast<const AnySlider&>();
  return slider_of_law(object);
}

/// The slider of the arguments of `Slider`.
AnySlider slider_from(const py::object& law, std::optional<double> natural_frequency, std::optional<double> damping,
                      std::optional<double> period, std::optional<double> damping_ratio, const py::object& slope,
                      bool one_way, const Stops* stops, bool pendulum);

inline const char* name_of(Contact contact) { return contact == Contact::flight ? "flight" : "clipped"; }
inline Contact contact_of(const std::string& name, const std::string& owner) {
  if (name == "flight") return Contact::flight;
  if (name == "clipped") return Contact::clipped;
  throw std::invalid_argument(owner + ": contact must be 'flight' or 'clipped', got '" + name + "'");
}

/// A Python function that may be copied and destroyed without the interpreter lock; calls need the lock.
class HeldFunction {
 public:
  explicit HeldFunction(py::function function)
      : function_(new py::function(std::move(function)), [](py::function* f) {
          if (!Py_IsInitialized()) return;
          const py::gil_scoped_acquire lock;
          delete f;
        }) {}

  const py::function& function() const { return *function_; }

 private:
  std::shared_ptr<py::function> function_;
};

/// Handles Ctrl-C while the interpreter lock is released.
inline void check_for_interrupt() {
  const py::gil_scoped_acquire held;
  if (PyErr_CheckSignals() != 0) throw py::error_already_set();
}

/// Calls `work`; an overflow names what may have caused it: the slider, and its velocity at the start.
template <class Work>
auto naming_cause(const py::object& slider, const std::string& velocity, Work&& work) {
  try {
    return work();
  } catch (const std::overflow_error& error) {
    throw std::overflow_error(std::string(error.what()) + "; the slider is " + py::repr(slider).cast<std::string>() +
                              ", its velocity at the start " + velocity + " m/s");
  }
}

/// A read-only array over `values`, which `owner` keeps alive.
inline py::array_t<double> view(std::span<const double> values, py::handle owner) {
  py::array_t<double> array(static_cast<py::ssize_t>(values.size()), values.data(), owner);
  array.attr("setflags")(py::arg("write") = false);
  return array;
}

/// The same over vectors in the plane, of shape (N, 2).
inline py::array_t<double> view(std::span<const Vector2> values, py::handle owner) {
  static_assert(sizeof(Vector2) == 2 * sizeof(double));
  py::array_t<double> array({static_cast<py::ssize_t>(values.size()), py::ssize_t{2}},
                            values.empty() ? nullptr : &values.front().axis, owner);
  array.attr("setflags")(py::arg("write") = false);
  return array;
}

/// A read-only array of rows of equal length.
inline py::array_t<double> array_of_rows(const std::vector<std::vector<double>>& values) {
  const std::size_t columns = values.empty() ? 0 : values.front().size();
  py::array_t<double> array({static_cast<py::ssize_t>(values.size()), static_cast<py::ssize_t>(columns)});
  double* to = array.mutable_data();
  for (const auto& row : values) to = std::copy(row.begin(), row.end(), to);
  array.attr("setflags")(py::arg("write") = false);
  return array;
}

/// A vector in the plane as a read-only array of shape (2,).
inline py::array_t<double> array_of(Vector2 v) {
  py::array_t<double> array(2);
  array.mutable_at(0) = v.axis;
  array.mutable_at(1) = v.transverse;
  array.attr("setflags")(py::arg("write") = false);
  return array;
}

/// A read-only array that takes ownership of the values.
template <class T>
py::array_t<T> array_of(std::vector<T> values) {
  auto* const kept = new std::vector<T>(std::move(values));
  const py::capsule owner(kept, [](void* p) { delete static_cast<std::vector<T>*>(p); });
  py::array_t<T> array(static_cast<py::ssize_t>(kept->size()), kept->data(), owner);
  array.attr("setflags")(py::arg("write") = false);
  return array;
}

/// The same of vectors in the plane, of shape (N, 2).
inline py::array_t<double> array_of(std::vector<Vector2> values) {
  auto* const kept = new std::vector<Vector2>(std::move(values));
  return view(*kept, py::capsule(kept, [](void* p) { delete static_cast<std::vector<Vector2>*>(p); }));
}

/// A new array with a copy of the values.
inline py::array_t<double> to_array(const std::vector<double>& values) {
  return py::array_t<double>(static_cast<py::ssize_t>(values.size()), values.data());
}

/// A contiguous array of doubles.
using Numbers = py::array_t<double, py::array::c_style | py::array::forcecast>;

/// The float value of each object; an object without one is an error that names its index.
inline Numbers values_of(const py::array& objects, const std::string& name) {
  Numbers numbers(std::vector<py::ssize_t>(objects.shape(), objects.shape() + objects.ndim()));
  double* to = numbers.mutable_data();
  std::size_t index = 0;
  for (const py::handle object : objects.attr("ravel")()) {
    *to++ = PyFloat_AsDouble(object.ptr());
    if (PyErr_Occurred()) {
      py::error_already_set error;
      if (!error.matches(PyExc_TypeError) && !error.matches(PyExc_ValueError) && !error.matches(PyExc_OverflowError))
        throw error;
      const auto text = py::module_::import("reprlib").attr("repr")(object).cast<std::string>();
      throw std::invalid_argument(name + " must hold real numbers, got " + text +
                                  (objects.ndim() > 0 ? " at index " + std::to_string(index) : ""));
    }
    ++index;
  }
  return numbers;
}

/// Whether an object is of a plain type, which has neither unit nor mask. It costs less than to look for them.
inline bool is_plain(const py::handle& object) {
  const PyTypeObject* const type = Py_TYPE(object.ptr());
  return type == py::detail::npy_api::get().PyArray_Type_ || type == &PyList_Type || type == &PyTuple_Type ||
         type == &PyFloat_Type || type == &PyLong_Type;
}

/// The numbers of a quantity that carries a unit (Pint, Astropy), converted to `unit`; otherwise `values` unchanged.
/// @param unit  the SI unit to convert to, "" for a pure number; if it is null, quantities with units are rejected
inline py::object without_unit(const py::object& values, const std::string& name, const char* unit) {
  if (is_plain(values)) return values;
  const bool pint = py::hasattr(values, "magnitude") && py::hasattr(values, "dimensionality");
  if (!pint && !(py::hasattr(values, "unit") && py::hasattr(values, "to_value"))) {
    // xarray over Pint: NumPy would drop the unit
    if (!py::hasattr(values, "dims") || !py::hasattr(values, "data")) return values;
    const py::object inside = values.attr("data"), numbers = without_unit(inside, name, unit);
    return numbers.is(inside) ? values : numbers;
  }
  const auto its_unit = py::str(values.attr(pint ? "units" : "unit")).cast<std::string>();
  if (unit == nullptr) {
    const std::string number = pint ? "quantity.to_base_units().magnitude" : "quantity.si.value";
    throw std::invalid_argument(name + " must be plain numbers in SI units, got a quantity in " + its_unit + "; give " +
                                number);
  }
  try {
    return pint ? values.attr("to")(unit).attr("magnitude") : values.attr("to_value")(unit);
  } catch (const py::error_already_set&) {
    const std::string wanted = *unit == 0 ? "without a dimension" : std::string("in ") + unit;
    throw std::invalid_argument(name + " must be a quantity " + wanted + " or in a convertible unit, got " + its_unit);
  }
}

/// Real numbers in an array of any shape, from a list, NumPy, pandas, xarray or Pint. `name` is for error messages;
/// `unit` is as for `without_unit`.
inline Numbers to_numbers(const py::object& given, const std::string& name, const char* unit = nullptr) {
  const py::object values = without_unit(given, name, unit);
  if (!is_plain(values) && py::hasattr(values, "mask")) {  // pandas has one, too
    const py::module_ ma = py::module_::import("numpy.ma");
    if (py::isinstance(values, ma.attr("MaskedArray"))) {
      const py::object mask = ma.attr("getmaskarray")(values);
      if (mask.attr("any")().cast<bool>())
        throw std::invalid_argument(name + " must not be masked, got a masked value at index " +
                                    std::to_string(mask.attr("argmax")().cast<std::size_t>()) +
                                    "; fill the gaps first");
    }
  }
  const py::array array =
      is_plain(values) && py::isinstance<py::array>(values)
          ? py::reinterpret_borrow<py::array>(values)
          : py::array(py::module_::import("numpy").attr("asarray")(values));  // its errors say what is wrong
  if (array.dtype().kind() == 'O') return values_of(array, name);
  if (std::string_view("biuf").find(array.dtype().kind()) == std::string_view::npos)
    throw std::invalid_argument(
        name + " must hold real numbers, got " +
        (array.size() == 1 ? py::repr(values).cast<std::string>() : py::str(array.dtype()).cast<std::string>()));
  return Numbers::ensure(array);
}

/// A one-dimensional array of real numbers as a vector.
inline std::vector<double> to_vector(const py::object& values, const std::string& name, const char* unit = nullptr) {
  const Numbers numbers = to_numbers(values, name, unit);
  if (numbers.ndim() != 1)
    throw std::invalid_argument(name + " must be one-dimensional, got " + std::to_string(numbers.ndim()) +
                                " dimensions");
  return {numbers.data(), numbers.data() + numbers.size()};
}

/// A number, or a one-dimensional array of them, as a vector.
inline std::vector<double> to_vector_or_number(const py::object& values, const std::string& name,
                                               const char* unit = nullptr) {
  const Numbers numbers = to_numbers(values, name, unit);
  if (numbers.ndim() > 1)
    throw std::invalid_argument(name + " must be a number or one-dimensional, got " + std::to_string(numbers.ndim()) +
                                " dimensions");
  return {numbers.data(), numbers.data() + numbers.size()};
}

/// One real number.
inline double to_number(const py::object& value, const std::string& name, const char* unit = nullptr) {
  const Numbers numbers = to_numbers(value, name, unit);
  if (numbers.ndim() != 0)
    throw std::invalid_argument(name + " must be one number, got " + std::to_string(numbers.size()));
  return *numbers.data();
}

/// A vector in the plane: its components along the axis and along the transverse direction.
inline Vector2 to_vector2(const py::object& value, const std::string& name, const char* unit = nullptr) {
  const Numbers numbers = to_numbers(value, name, unit);
  if (numbers.ndim() != 1 || numbers.size() != 2)
    throw std::invalid_argument(
        name + " must be two numbers, along the axis and along the transverse direction, got " +
        (numbers.ndim() == 0 ? "one" : "an array of shape " + py::str(numbers.attr("shape")).cast<std::string>()));
  return {numbers.at(0), numbers.at(1)};
}

/// A plot of `stickslip.plotting` as a method with the options `where`= ("ax" or "figure") and title=.
inline auto plot_in(const char* function, const char* where) {
  return [=](const py::object& self, const py::object& place, const py::object& title) {
    return py::module_::import("stickslip.plotting")
        .attr(function)(self, py::arg(where) = place, py::arg("title") = title);
  };
}

/// A function of each number: returns a float for a number, an array of the same shape for an array.
template <class F>
py::object of_each(const py::object& values, const std::string& name, F&& f, const char* unit = nullptr) {
  return py::vectorize(std::forward<F>(f))(to_numbers(values, name, unit));
}

inline Interpolation interpolation_of(const std::string& name, const std::string& owner) {
  if (name == "linear") return Interpolation::linear;
  if (name == "constant") return Interpolation::constant;
  throw std::invalid_argument(owner + ": interpolation must be 'linear' or 'constant', got '" + name + "'");
}

inline const char* name_of(Interpolation interpolation) {
  return interpolation == Interpolation::linear ? "linear" : "constant";
}

/// The slip level, given as such or as a coefficient of friction.
inline double slip_level_of(std::optional<double> mu, std::optional<double> slip_level, const std::string& law,
                            const std::string& mu_name = "mu", const std::string& level_name = "slip_level") {
  if (mu.has_value() == slip_level.has_value())
    throw std::invalid_argument(law + ": give either " + mu_name + " or " + level_name + ", got " +
                                (mu ? "both (" + mu_name + " = " + detail::shortest(*mu) + ", " + level_name + " = " +
                                          detail::shortest(*slip_level) + " m/s^2)"
                                    : "neither"));
  if (!mu) {
    check_unit("slip level", law, level_name, *slip_level);
    return *slip_level;
  }
  detail::require(std::isfinite(*mu) && *mu >= 0, law + ": " + mu_name + " must be finite and at least 0", *mu);
  check_unit("coefficient of friction", law, mu_name, *mu);
  return *mu * standard_gravity;
}

}  // namespace stickslip::python
