#include <pybind11/stl.h>

#include <algorithm>
#include <memory>

#include "bindings.hpp"

namespace stickslip::python {
namespace {

using Shape = std::pair<py::object, py::object>;

/// A quantile function in Python.
class PythonQuantile : public HeldFunction {
 public:
  using HeldFunction::HeldFunction;

  void operator()(std::span<double> numbers) const {
    const py::gil_scoped_acquire lock;
    const py::array_t<double> uniform(static_cast<py::ssize_t>(numbers.size()), numbers.data());  // a copy
    const std::vector<double> values = to_vector(function()(uniform), "PoissonPulses: what quantile returns");
    if (values.size() != numbers.size())
      throw std::invalid_argument("PoissonPulses: quantile must return one number for each it is given, got " +
                                  std::to_string(values.size()) + " for " + std::to_string(numbers.size()));
    std::ranges::copy(values, numbers.begin());
  }
};

PoissonOptions options_of(bool stationary_start, const std::optional<Shape>& shape,
                          std::optional<py::function> quantile, std::optional<Envelope> envelope) {
  PoissonOptions options;
  options.stationary_start = stationary_start;
  if (shape)
    options.shape =
        PulseShape(to_vector(shape->first, "PulseShape: times", "s"), to_vector(shape->second, "PulseShape: values"));
  if (quantile) options.quantile = PythonQuantile(std::move(*quantile));
  options.envelope = std::move(envelope);
  return options;
}

py::object quantile_of(const PoissonPulses& excitation) {
  const auto* quantile = excitation.options().quantile.target<PythonQuantile>();
  return quantile ? py::object(quantile->function()) : py::object(py::none());
}

py::tuple shape_of(const py::object& self) {
  const PulseShape& shape = self.cast<const PoissonPulses&>().options().shape;
  return py::make_tuple(view(shape.times(), self), view(shape.values(), self));
}

std::string repr_of_pulses(const py::object& self) {
  const auto& excitation = self.cast<const PoissonPulses&>();
  const PoissonOptions& options = excitation.options();
  std::string text = "PoissonPulses(rate=" + detail::shortest(excitation.rate()) +
                     ", half_width=" + detail::shortest(excitation.half_width()) +
                     ", sigma=" + detail::shortest(excitation.sigma()) +
                     ", duration=" + detail::shortest(excitation.duration());
  if (options.stationary_start) text += ", stationary_start=True";
  if (options.shape != PulseShape()) {
    const py::tuple shape = shape_of(self);
    text += ", shape=(" + py::str(shape[0].attr("tolist")()).cast<std::string>() + ", " +
            py::str(shape[1].attr("tolist")()).cast<std::string>() + ")";
  }
  if (options.quantile) text += ", quantile=" + py::repr(quantile_of(excitation)).cast<std::string>();
  if (options.envelope) text += ", envelope=" + py::repr(py::cast(*options.envelope)).cast<std::string>();
  return text + ")";
}

PoissonPulses plausible_pulses(const std::string& who, PoissonPulses made) {
  check_unit("pulses or cycles of a motion", who, "the mean number of pulses", made.rate() * made.duration());
  return made;
}

}  // namespace

void bind_poisson(py::module_& m) {
  py::class_<PoissonPulses>(m, "PoissonPulses",
                            R"(Ground acceleration as a sum of pulses of random amplitude at random times.

n(t) = sum_k b_k w(t - t_k), thesis (5.16), (5.29), (5.30). The t_k arrive as a Poisson process of rate lambda; the b_k
are independent, by default Gaussian with mean zero and standard deviation sigma; the pulse w is +1 for the half width
Dt, then -1 for Dt, so that it displaces the ground by b Dt^2 and leaves no velocity. A motion is truncated at its
duration, when pulses may still act.

Parameters
----------
rate : float
    lambda, pulses per second, positive and finite.
half_width : float
    Dt [s], positive and finite; the unit of the times of `shape`.
sigma : float
    Rms amplitude of the pulses [m/s^2], positive and finite.
duration : float
    Duration of a motion [s], positive and finite.
stationary_start : bool, optional
    Let pulses arrive from one pulse length before time zero, so that the whole motion is stationary. Otherwise, as in
    thesis 5.4, no pulse begins before time zero, and the variance rises from 0 to its stationary value within one pulse
    length, 2 Dt.
shape : (array_like, array_like), optional
    Another piecewise constant pulse w: the times at which its steps begin and end, in units of half_width, increasing
    from 0, and their values, one fewer. The default is ([0, 1, 2], [1, -1]).
quantile : callable, optional
    Another distribution of the amplitudes, b = sigma * quantile(u): takes an array of uniform numbers in (0, 1) and
    returns as many values, each computed from its own number alone. Its mean square must be 1, because sigma is the rms
    amplitude; a deviation by a quarter is an error. It runs under Python's global lock, so that threads wait for each
    other; to pickle the excitation it must be a function of a module.
envelope : Envelope, optional
    Envelope whose value at the arrival of a pulse multiplies its amplitude (at time zero for earlier pulses). It does
    not multiply the acceleration; each pulse therefore still leaves no net velocity, and the motion stays exact.

Raises
------
ValueError
    A value out of range; more than 3e8 steps in a motion (rate x duration x the times of the shape); a quantile
    function that is not finite or whose mean square is not 1.

Warns
-----
PlausibilityWarning
    A half_width of 60 s or more, which may be in ms; a sigma from 100 to 10,000 m/s^2, which may be in cm/s^2; more than
    10,000 pulses in a motion: the duration may be in ms.

Notes
-----
The closed forms (`variance` to `ground_displacement_variance`) are for the stationary process without envelope. Without
`stationary_start` they hold after one pulse length, 2 Dt.

References
----------
Thesis 5.3, 5.4, 5.6 with the errata to (5.6); Y. K. Lin, Probabilistic Theory of Structural Dynamics (1967), 87-94.)")
      .def(py::init([](double rate, double half_width, double sigma, double duration, bool stationary_start,
                       const std::optional<Shape>& shape, std::optional<py::function> quantile,
                       std::optional<Envelope> envelope) {
             check_unit("period", "PoissonPulses", "half_width", half_width);
             check_unit("ground acceleration", "PoissonPulses", "sigma", sigma);
             return plausible_pulses("PoissonPulses",
                                     {rate, half_width, sigma, duration,
                                      options_of(stationary_start, shape, std::move(quantile), std::move(envelope))});
           }),
           py::kw_only(), py::arg("rate"), py::arg("half_width"), py::arg("sigma"), py::arg("duration"),
           py::arg("stationary_start") = false, py::arg("shape") = py::none(), py::arg("quantile") = py::none(),
           py::arg("envelope") = py::none())
      .def_static(
          "event",
          [](const std::string& name, bool stationary_start, const std::optional<Shape>& shape,
             std::optional<py::function> quantile, std::optional<Envelope> envelope) {
            return PoissonPulses::event(name,
                                        options_of(stationary_start, shape, std::move(quantile), std::move(envelope)));
          },
          py::arg("name"), py::kw_only(), py::arg("stationary_start") = false, py::arg("shape") = py::none(),
          py::arg("quantile") = py::none(), py::arg("envelope") = py::none(),
          R"(One of the four scenario earthquakes of the thesis, Table 5.1, with lambda Dt = 0.5.

========================  ===============  ========  ============
name                      sigma_n [m/s^2]  f_c [Hz]  duration [s]
========================  ===============  ========  ============
great very near field     2.5              3         60
great near field          1                2.5       60
moderate very near field  2                4         15
moderate near field       0.5              3         15
========================  ===============  ========  ============

Very near field: within 20 km of the fault; near field: 20 to 50 km.

Parameters
----------
name : str
    A name from the table, or from `events()`.
stationary_start, shape, quantile, envelope
    As for PoissonPulses; sigma follows from sigma_n for any shape.

Raises
------
ValueError
    An unknown name; the message lists the known ones.)")
      .def_static(
          "from_earthquake",
          [](double rms_acceleration, double center_frequency_hz, double duration, double overlap,
             bool stationary_start, const std::optional<Shape>& shape, std::optional<py::function> quantile,
             std::optional<Envelope> envelope) {
            const std::string who = "PoissonPulses.from_earthquake";
            check_unit("ground acceleration", who, "rms_acceleration", rms_acceleration);
            check_unit("frequency in Hz", who, "center_frequency_hz", center_frequency_hz);
            return plausible_pulses(who,
                                    PoissonPulses::from_earthquake(
                                        rms_acceleration, center_frequency_hz, duration, overlap,
                                        options_of(stationary_start, shape, std::move(quantile), std::move(envelope))));
          },
          py::kw_only(), py::arg("rms_acceleration"), py::arg("center_frequency_hz"), py::arg("duration"),
          py::arg("overlap") = 0.5, py::arg("stationary_start") = false, py::arg("shape") = py::none(),
          py::arg("quantile") = py::none(), py::arg("envelope") = py::none(),
          R"(Pulses equivalent to the strong motion of an earthquake, thesis 5.6.

Dt = pi / omega_c = 1 / (2 f_c), (5.60); sigma = sigma_n / sqrt(2 lambda Dt), (5.61).

Parameters
----------
rms_acceleration : float
    sigma_n [m/s^2], positive and finite.
center_frequency_hz : float
    f_c [Hz], positive and finite, as defined by (5.60); the peak of the spectrum is at 0.742 f_c.
duration : float
    Duration of the strong motion [s], positive and finite.
overlap : float, optional
    lambda Dt, positive and finite; with 0.5 there are few gaps, and the peak is 3 to 4 sigma_n.
stationary_start, shape, quantile, envelope
    As of PoissonPulses.

Raises
------
ValueError
    A value out of range.

Warns
-----
PlausibilityWarning
    As for `PoissonPulses`, about rms_acceleration and duration; a frequency of 100 Hz or more, which may be in rad/s.)")
      .def_static(
          "from_spectrum",
          [](const Spectrum& spectrum, double rate, double duration, double dt, double tolerance, bool stationary_start,
             std::optional<py::function> quantile, std::optional<Envelope> envelope) {
            return plausible_pulses("PoissonPulses.from_spectrum",
                                    PoissonPulses::from_spectrum(spectrum, rate, duration, dt, tolerance,
                                                                 options_of(stationary_start, std::nullopt,
                                                                            std::move(quantile), std::move(envelope))));
          },
          py::arg("spectrum"), py::kw_only(), py::arg("rate"), py::arg("duration"), py::arg("dt"),
          py::arg("tolerance") = 1e-3, py::arg("stationary_start") = false, py::arg("quantile") = py::none(),
          py::arg("envelope") = py::none(),
          R"(Minimum-phase pulses with a given spectral density.

The spectrum determines the amplitude of the pulse's Fourier transform, by (5.20). Causality determines the phase, the
Hilbert transform of the amplitude's logarithm (thesis 5.3): of all causal pulses with this amplitude, the result is the
minimum-phase one, whose energy comes earliest. It is computed by FFT on the cepstrum, in steps of length dt, with the
amplitude corrected for the steps. If the spectrum is zero at omega = 0, the pulse leaves no velocity, exactly except
for rounding; if it falls as omega^4, no displacement either.

The half width is 1 s, so that the times of `shape` are in seconds, and the largest value of the shape is 1: sigma is
the rms peak acceleration of a pulse. Rate and sigma determine lambda sigma^2 together. Many simultaneous pulses, that
is, a large rate times the length of the pulse, make a nearly Gaussian process.

Parameters
----------
spectrum : Spectrum
    Spectrum of the ground acceleration, positive from 0 to pi / dt except at single frequencies, where it may be zero.
    For other spectra no causal pulse exists (Paley and Wiener); add a floor to that of a record or a band.
rate : float
    lambda, pulses per second, positive and finite.
duration : float
    Duration of a motion [s], positive and finite.
dt : float
    Length of a step of the pulse [s], positive and finite. The spectrum holds below pi / dt; the steps cause an image
    of it above.
tolerance : float, optional
    The integral of abs(density - S) over that of S, from 0 to pi / dt; from 1e-6 to 0.1. It determines where the shape
    is truncated: a smaller tolerance needs more steps.
stationary_start, quantile, envelope
    As of PoissonPulses.

Raises
------
ValueError
    A value out of range; a spectrum that ends below pi / dt, or is zero over a band (names the frequency); one that
    needs more than half a million steps.

Warns
-----
PlausibilityWarning
    More than 10,000 pulses in a motion: the duration may be in ms.

Notes
-----
Takes 1 to 20 ms.

References
----------
Thesis 5.3; A. V. Oppenheim, R. W. Schafer, Discrete-Time Signal Processing (1989), 12.)")
      .def_static(
          "events",
          [] {
            const auto names = PoissonPulses::events();
            return std::vector<std::string>(names.begin(), names.end());
          },
          "The names that `event` accepts.")
      .def("sample", py::overload_cast<std::uint64_t, std::uint64_t>(&PoissonPulses::sample, py::const_), py::kw_only(),
           py::arg("seed"), py::arg("member"), py::call_guard<py::gil_scoped_release>(),
           R"(Generate the motion of a member, from 0 to `duration`: exact, with constant interpolation at uneven times.

Parameters
----------
seed, member : int
    From 0 to 2^64 - 1. They determine the motion.

Returns
-------
GroundMotion
    The acceleration is exactly zero where no pulse acts, otherwise the sum of the acting pulses to about one rounding.

Notes
-----
A motion has about three steps for each pulse; it takes 20 ns for each step.)")
      .def(
          "pulses",
          [](const PoissonPulses& self, std::uint64_t seed, std::uint64_t member) {
            std::vector<double> arrivals, amplitudes;
            {
              const py::gil_scoped_release free;
              self.pulses(seed, member, arrivals, amplitudes);
            }
            return py::make_tuple(to_array(arrivals), to_array(amplitudes));
          },
          py::kw_only(), py::arg("seed"), py::arg("member"), R"(Generate the pulses of a member's motion.

Parameters
----------
seed, member : int
    From 0 to 2^64 - 1.

Returns
-------
arrivals : ndarray, shape (K,)
    Times t_k [s], ascending, below `duration`; K differs between members.
amplitudes : ndarray, shape (K,)
    b_k [m/s^2].)")
      .def_property_readonly("rate", &PoissonPulses::rate, "lambda, pulses per second.")
      .def_property_readonly("half_width", &PoissonPulses::half_width, "Dt [s].")
      .def_property_readonly("sigma", &PoissonPulses::sigma, "Rms amplitude of the pulses [m/s^2].")
      .def_property_readonly("duration", &PoissonPulses::duration, "Duration of a motion [s].")
      .def_property_readonly(
          "stationary_start", [](const PoissonPulses& p) { return p.options().stationary_start; },
          "Whether the motion is stationary from time zero.")
      .def_property_readonly("shape", &shape_of,
                             "Times of the steps of the pulse, in units of half_width, and their values; read-only.")
      .def_property_readonly("quantile", &quantile_of, "Quantile function of b / sigma; None for Gaussian amplitudes.")
      .def_property_readonly(
          "envelope", [](const PoissonPulses& p) { return p.options().envelope; },
          "Envelope of the amplitudes, or None.")
      .def_property_readonly(
          "variance", &PoissonPulses::variance,
          "Variance of the acceleration [m^2/s^4]: lambda sigma^2 int w^2, thesis (5.19); 2 lambda Dt sigma^2, (5.61).")
      .def(
          "density",
          [](const PoissonPulses& self, const py::object& omega) {
            return of_each(omega, "PoissonPulses: omega", [&self](double w) { return self.density(w); });
          },
          py::arg("omega"),
          R"(Two-sided spectral density of the acceleration; its integral over the whole line is `variance`.

2 pi lambda sigma^2 |w_hat|^2, thesis (5.20); for the symmetric pulse 8 lambda sigma^2 sin^4(omega Dt / 2) /
(pi omega^2), four times that of the misprinted (5.6).

Parameters
----------
omega : float or array_like
    Angular frequency [rad/s], of either sign.

Returns
-------
float or ndarray
    Density [m^2/s^3], of the same shape.)")
      .def_property_readonly(
          "ground_velocity_variance", &PoissonPulses::ground_velocity_variance,
          R"(Stationary variance of the ground velocity [m^2/s^2]: thesis (5.44), (5.46), 2 lambda Dt^3 sigma^2 / 3.

Exact. Infinite for a shape that leaves a net velocity, whose ground velocity is not stationary.)")
      .def(
          "ground_displacement_variance",
          [](const PoissonPulses& self, const py::object& t) {
            return of_each(t, "PoissonPulses: t", [&self](double at) { return self.ground_displacement_variance(at); });
          },
          py::arg("t"), R"(Variance of the ground displacement at large times: thesis (5.49), lambda Dt^4 sigma^2 t.

Without `stationary_start` the exact value after 2 Dt has t - 37/30 Dt instead of t. Infinite for a shape that leaves a
net velocity, with which the displacement variance grows faster than linearly.

Parameters
----------
t : float or array_like
    Times [s], finite and at least 0.

Returns
-------
float or ndarray
    Variance [m^2], of the same shape.)")
      .def_property_readonly(
          "configuration", &PoissonPulses::configuration,
          "Everything that determines the motions, as a JSON object; a hash stands for a quantile function.")
      .def("__repr__", &repr_of_pulses)
      .def(
          "__eq__", [](const PoissonPulses& a, const PoissonPulses& b) { return a == b; }, py::is_operator())
      .def("__hash__", [](const PoissonPulses& p) { return py::hash(py::str(p.configuration())); })
      .def(py::pickle(
          [](const py::object& self) {
            const auto& p = self.cast<const PoissonPulses&>();
            const PulseShape& shape = p.options().shape;
            return py::make_tuple(p.rate(), p.half_width(), p.sigma(), p.duration(), p.options().stationary_start,
                                  py::make_tuple(std::vector<double>(shape.times().begin(), shape.times().end()),
                                                 std::vector<double>(shape.values().begin(), shape.values().end())),
                                  quantile_of(p), p.options().envelope);
          },
          [](const py::tuple& t) {
            return PoissonPulses(
                t[0].cast<double>(), t[1].cast<double>(), t[2].cast<double>(), t[3].cast<double>(),
                options_of(t[4].cast<bool>(), t[5].cast<Shape>(), t[6].cast<std::optional<py::function>>(),
                           t[7].cast<std::optional<Envelope>>()));
          }));
}

}  // namespace stickslip::python
