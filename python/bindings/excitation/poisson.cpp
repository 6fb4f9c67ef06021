#include <pybind11/stl.h>

#include <algorithm>
#include <memory>

#include "bindings.hpp"

namespace stickslip::python {
namespace {

using Shape = std::pair<py::object, py::object>;

/// A Python function as the quantile function.
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

}  // namespace

void bind_poisson(py::module_& m) {
  py::class_<PoissonPulses>(m, "PoissonPulses",
                            R"(Ground acceleration as a sum of pulses of random amplitude at random times.

n(t) = sum_k b_k w(t - t_k), thesis (5.16), (5.29), (5.30). The t_k arrive as a Poisson process of rate lambda; the b_k
are independent, by default Gaussian with mean zero and standard deviation sigma; the pulse w is +1 for the half width
Dt, then -1 for Dt, so that it moves the ground by b Dt^2 and leaves it without velocity. A motion is cut at its
duration, where pulses may still act.

Parameters
----------
rate : float
    lambda, pulses per second, positive and finite.
half_width : float
    Dt [s], positive and finite; the unit of the times of `shape`.
sigma : float
    Rms amplitude of the pulses [m/s^2], positive and finite.
duration : float
    Of a motion [s], positive and finite.
stationary_start : bool, optional
    Pulses arrive from one pulse length before time zero on: the whole motion is a portion of a stationary one.
    Otherwise, as thesis 5.4 starts up, no pulse begins before time zero, and the variance rises from 0 to its
    stationary value within one pulse length, 2 Dt.
shape : (array_like, array_like), optional
    Another pulse w, piecewise constant: the times where its pieces begin and end, in units of half_width, from 0 and
    increasing, and their values, one fewer. The default is ([0, 1, 2], [1, -1]).
quantile : callable, optional
    Another distribution of the amplitudes, b = sigma * quantile(u): takes an array of uniform numbers in (0, 1) and
    returns as many values, each computed from its own number alone. Its mean square must be 1, for sigma is the rms
    amplitude: what is off by a quarter is refused. It runs under Python's global lock, so that threads wait for each
    other; to be pickled it must be a function of a module.
envelope : Envelope, optional
    Multiplies the amplitude of each pulse by its value where the pulse arrives (at time zero, where it arrives before).
    Not the acceleration: so each pulse still leaves no net velocity, and the motion stays exact.

Raises
------
ValueError
    A value out of range; more than 3e8 steps in a motion (rate x duration x the times of the shape); a quantile
    function that is not finite or whose mean square is not 1.

Notes
-----
The closed forms (`variance` to `ground_displacement_variance`) are of the stationary process without envelope. With the
thesis's start-up they hold from one pulse length, 2 Dt, on.

References
----------
Thesis 5.3, 5.4, 5.6 with the errata to (5.6); Y. K. Lin, Probabilistic Theory of Structural Dynamics (1967), 87-94.)")
      .def(py::init([](double rate, double half_width, double sigma, double duration, bool stationary_start,
                       const std::optional<Shape>& shape, std::optional<py::function> quantile,
                       std::optional<Envelope> envelope) {
             return PoissonPulses(rate, half_width, sigma, duration,
                                  options_of(stationary_start, shape, std::move(quantile), std::move(envelope)));
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
          R"(One of the four events of thesis, Table 5.1, with lambda Dt = 0.5.

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
    As in the table, or of `events()`.
stationary_start, shape, quantile, envelope
    As of PoissonPulses; sigma follows from sigma_n for any shape.

Raises
------
ValueError
    An unknown name; the message lists the known ones.)")
      .def_static(
          "from_earthquake",
          [](double rms_acceleration, double centre_frequency_hz, double duration, double overlap,
             bool stationary_start, const std::optional<Shape>& shape, std::optional<py::function> quantile,
             std::optional<Envelope> envelope) {
            return PoissonPulses::from_earthquake(
                rms_acceleration, centre_frequency_hz, duration, overlap,
                options_of(stationary_start, shape, std::move(quantile), std::move(envelope)));
          },
          py::kw_only(), py::arg("rms_acceleration"), py::arg("centre_frequency_hz"), py::arg("duration"),
          py::arg("overlap") = 0.5, py::arg("stationary_start") = false, py::arg("shape") = py::none(),
          py::arg("quantile") = py::none(), py::arg("envelope") = py::none(),
          R"(Pulses like the strong motion of an earthquake, thesis 5.6.

Dt = pi / omega_c = 1 / (2 f_c), (5.60); sigma = sigma_n / sqrt(2 lambda Dt), (5.61).

Parameters
----------
rms_acceleration : float
    sigma_n [m/s^2], positive and finite.
centre_frequency_hz : float
    f_c [Hz], positive and finite. It is a definition, not the peak of the spectrum, which is at 0.742 f_c.
duration : float
    Of the strong motion [s], positive and finite.
overlap : float, optional
    lambda Dt, positive and finite; 0.5 leaves few gaps, and a peak of 3 to 4 sigma_n.
stationary_start, shape, quantile, envelope
    As of PoissonPulses.

Raises
------
ValueError
    A value out of range.)")
      .def_static(
          "from_spectrum",
          [](const Spectrum& spectrum, double rate, double duration, double dt, double tolerance, bool stationary_start,
             std::optional<py::function> quantile, std::optional<Envelope> envelope) {
            return PoissonPulses::from_spectrum(
                spectrum, rate, duration, dt, tolerance,
                options_of(stationary_start, std::nullopt, std::move(quantile), std::move(envelope)));
          },
          py::arg("spectrum"), py::kw_only(), py::arg("rate"), py::arg("duration"), py::arg("dt"),
          py::arg("tolerance") = 1e-3, py::arg("stationary_start") = false, py::arg("quantile") = py::none(),
          py::arg("envelope") = py::none(),
          R"(Pulses of minimum phase whose spectral density is a given one.

The spectrum gives the amplitude of the pulse's Fourier transform, by (5.20). That it is zero before it begins gives the
phase, the Hilbert transform of the amplitude's logarithm (thesis 5.3): of all causal pulses with this amplitude it is the
one of minimum phase, which has its energy earliest. It is found by FFT on the cepstrum, in pieces of length dt, for whose
steps the amplitude is corrected. A spectrum that is zero at omega = 0 gets a shape that leaves no velocity, exactly but
for rounding, and one that falls as omega^4 no displacement either.

The half width is 1 s, so that the times of `shape` are seconds, and the largest value of the shape is 1: sigma is the rms
of the largest acceleration of a pulse. Rate and sigma share lambda sigma^2. Many pulses at a time, a large rate times the
length of the pulse, make a process that is nearly Gaussian.

Parameters
----------
spectrum : Spectrum
    Of the ground acceleration: positive from 0 to pi / dt but for single frequencies, where it may be zero. Of other
    spectra no pulse that begins at a time exists (Paley and Wiener); that of a record or a band can be given a floor.
rate : float
    lambda, pulses per second, positive and finite.
duration : float
    Of a motion [s], positive and finite.
dt : float
    Length of a piece [s], positive and finite. The spectrum is had below pi / dt; beyond, steps leave an image of it.
tolerance : float, optional
    The integral of abs(density - S) over that of S, from 0 to pi / dt; from 1e-6 to 0.1. The shape is cut where that
    allows it: a tighter one takes more pieces.
stationary_start, quantile, envelope
    As of PoissonPulses.

Raises
------
ValueError
    A value out of range; a spectrum that ends below pi / dt, or is zero over a band, with the frequency; one that half
    a million pieces do not hold.

Notes
-----
1 to 20 ms.

References
----------
Thesis 5.3; A. V. Oppenheim, R. W. Schafer, Discrete-Time Signal Processing (1989), 12.)")
      .def_static(
          "events",
          [] {
            const auto names = PoissonPulses::events();
            return std::vector<std::string>(names.begin(), names.end());
          },
          "The names that `event` knows.")
      .def("sample", &PoissonPulses::sample, py::kw_only(), py::arg("seed"), py::arg("member"),
           py::call_guard<py::gil_scoped_release>(),
           R"(One motion, from 0 to `duration`: values held between uneven times, exact.

Parameters
----------
seed, member : int
    From 0 to 2^64 - 1. The same two give the same motion for ever.

Returns
-------
GroundMotion
    Where no pulse acts its acceleration is exactly zero, elsewhere the sum of the acting pulses to about one rounding.

Notes
-----
About three steps for each pulse, and 20 ns for each step.)")
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
          py::kw_only(), py::arg("seed"), py::arg("member"), R"(The pulses that a motion is the sum of.

Parameters
----------
seed, member : int
    From 0 to 2^64 - 1.

Returns
-------
arrivals : ndarray, shape (K,)
    Times t_k [s], ascending, below `duration`; K differs from member to member.
amplitudes : ndarray, shape (K,)
    b_k [m/s^2].)")
      .def_property_readonly("rate", &PoissonPulses::rate, "lambda, pulses per second.")
      .def_property_readonly("half_width", &PoissonPulses::half_width, "Dt [s].")
      .def_property_readonly("sigma", &PoissonPulses::sigma, "Rms amplitude of the pulses [m/s^2].")
      .def_property_readonly("duration", &PoissonPulses::duration, "Of a motion [s].")
      .def_property_readonly(
          "stationary_start", [](const PoissonPulses& p) { return p.options().stationary_start; },
          "Whether the motion is stationary from time zero on.")
      .def_property_readonly("shape", &shape_of,
                             "Times of the pulse's pieces, in units of half_width, and their values; read-only.")
      .def_property_readonly("quantile", &quantile_of, "Of b / sigma; None where the amplitudes are Gaussian.")
      .def_property_readonly(
          "envelope", [](const PoissonPulses& p) { return p.options().envelope; }, "Of the amplitudes, or None.")
      .def_property_readonly(
          "variance", &PoissonPulses::variance,
          "Of the acceleration [m^2/s^4]: lambda sigma^2 int w^2, thesis (5.19); 2 lambda Dt sigma^2, (5.61).")
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
    [rad/s], of either sign.

Returns
-------
float or ndarray
    Of the same shape [m^2/s^3].)")
      .def_property_readonly(
          "ground_velocity_variance", &PoissonPulses::ground_velocity_variance,
          R"(Stationary, of the ground velocity [m^2/s^2]: thesis (5.44), (5.46), 2 lambda Dt^3 sigma^2 / 3.

Exact. Infinite for a shape that leaves a net velocity: there is no stationary one.)")
      .def(
          "ground_displacement_variance",
          [](const PoissonPulses& self, const py::object& t) {
            return of_each(t, "PoissonPulses: t", [&self](double at) { return self.ground_displacement_variance(at); });
          },
          py::arg("t"), R"(Variance of the ground displacement at large times: thesis (5.49), lambda Dt^4 sigma^2 t.

From the thesis's start-up the exact value beyond 2 Dt has t - 37/30 Dt instead of t. Infinite for a shape that leaves a
net velocity: the displacement then grows faster than any line.

Parameters
----------
t : float or array_like
    [s], finite and at least 0.

Returns
-------
float or ndarray
    Of the same shape [m^2].)")
      .def_property_readonly("configuration", &PoissonPulses::configuration,
                             "All that the motions depend on, as one JSON object; a quantile function by a hash.")
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
