"""Numbers from anywhere: pandas, masked arrays, objects, at every place that takes an array."""

from decimal import Decimal
from fractions import Fraction

import numpy as np
import pytest
import stickslip as ss
from stickslip import harmonic, theory

pd = pytest.importorskip("pandas")
xr = pytest.importorskip("xarray")
pint = pytest.importorskip("pint")

BLOCK, WHEEL = ss.Coulomb(slip_level=0.5), ss.Caster(slip_level=0.5, reach=1.0)
BAND = ss.Spectrum.band_pass(s0=1.0, low=1.0, high=2.5)
PULSES = ss.PoissonPulses(rate=3, half_width=1 / 6, sigma=2.5, duration=6)
ENVELOPE = ss.Envelope(build_up=2, strong_duration=2, decay_rate=1)
CHEAP = theory.PulseSuperposition("none")
METHOD = theory.SlowlyVaryingParameters(WHEEL)
EXACT = theory.WhiteNoise(BLOCK, 1)
PREDICTED = theory.StationaryLinearization().predict(BLOCK, BAND)
ORBIT = harmonic.orbits(WHEEL, 1.5, 1.0)[-1]

# Each takes three numbers, which increase.
TAKES = {
    "GroundMotion": lambda a: ss.GroundMotion(a, dt=0.1).acceleration,
    "GroundMotion, times": lambda a: ss.GroundMotion([1, 2, 3], times=a).time,
    "Spectrum": BAND,
    "Spectrum.from_table, omega": lambda a: ss.Spectrum.from_table(a, [1, 1, 1])(1.5),
    "Spectrum.from_table, density": lambda a: ss.Spectrum.from_table([1, 2, 3], a)(1.5),
    "Envelope": ENVELOPE,
    "Envelope.from_table, time": lambda a: ss.Envelope.from_table(a, [1, 1, 1]).table[0],
    "Envelope.from_table, factor": lambda a: ss.Envelope.from_table([1, 2, 3], a).table[1],
    "PoissonPulses, shape": lambda a: ss.PoissonPulses(
        rate=3, half_width=1, sigma=1, duration=6, shape=([0, 1, 2, 3], a)
    ).shape[1],
    "PoissonPulses.density": PULSES.density,
    "PoissonPulses.ground_displacement_variance": PULSES.ground_displacement_variance,
    "Orbit.histories": lambda a: ORBIT.histories(a)[0],
    "StationaryPrediction.velocity_spectrum": PREDICTED.velocity_spectrum,
    "StationaryPrediction.transient": lambda a: PREDICTED.transient(a).velocity_variance,
    "SlowlyVaryingParameters.dissipative": METHOD.dissipative,
    "SlowlyVaryingParameters.dissipative_slope": METHOD.dissipative_slope,
    "SlowlyVaryingParameters.in_phase": METHOD.in_phase,
    "SlowlyVaryingParameters.in_phase_slope": METHOD.in_phase_slope,
    "SlowlyVaryingParameters.frequency": lambda a: METHOD.frequency(5, a)[1],
    "SlowlyVaryingParameters.stability_boundary": lambda a: METHOD.stability_boundary(a)[1],
    "SlowlyVaryingParameters.transient": lambda a: METHOD.transient(5, 1, 0.1, 0, a)[0],
    "WhiteNoise.density": EXACT.density,
    "WhiteNoise.transition_density": lambda a: EXACT.transition_density(a, a, a),
    "WhiteNoise.transition_density, time": lambda a: EXACT.transition_density(1, a),
    "WhiteNoise.transition_density, start": lambda a: EXACT.transition_density(1, 1, a),
    "WhiteNoise.speed_density": EXACT.speed_density,
    "WhiteNoise.velocity_autocovariance": EXACT.velocity_autocovariance,
    "WhiteNoise.velocity_spectrum": EXACT.velocity_spectrum,
    "WhiteNoise.absolute_moment": lambda a: EXACT.absolute_moment(2, a),
    "WhiteNoise.predict": lambda a: EXACT.predict(a).velocity_variance,
    "EquivalentLinearization.predict": lambda a: (
        theory.EquivalentLinearization().predict(WHEEL, 1, a).velocity_variance
    ),
    "PulseSuperposition.predict": lambda a: (
        theory.PulseSuperposition().predict(BLOCK, PULSES, a).displacement_variance
    ),
    "PulseChain.predict": lambda a: theory.PulseChain().predict(BLOCK, PULSES, a).velocity_variance,
    "pulse_response": lambda a: theory.pulse_response(BLOCK, 2, 0.1, times=a).displacement,
    "pulse_response, shape": lambda a: (
        theory.pulse_response(BLOCK, 2, 0.1, shape=([0, 1, 2, 3], a)).displacement
    ),
    "viscous_pulse_response": lambda a: theory.viscous_pulse_response(1, 2, 0.1, times=a).velocity,
    "compare": lambda a: ss.compare(BLOCK, PULSES, a, members=64, theories=[CHEAP]).time,
}
NONE_IS_THE_DEFAULT = ("GroundMotion, times", "compare", "pulse_response", "viscous_pulse_response")
NUMBERS = [1.0, 2.0, 3.0]
IN_KELVIN = pint.UnitRegistry().Quantity(NUMBERS, "kelvin")
GIVEN = {
    "Series": pd.Series(NUMBERS, index=[7, 8, 9]),
    "column": pd.DataFrame({"a": NUMBERS, "mask": NUMBERS})["mask"],
    "Index": pd.Index(NUMBERS),
    "integers": pd.Series([1, 2, 3]),
    "Float64": pd.Series(NUMBERS, dtype="Float64"),
    "Int64": pd.array([1, 2, 3], dtype="Int64"),
    "objects": pd.Series(NUMBERS, dtype=object),
    "DataArray": xr.DataArray(NUMBERS, dims="time"),
    "variable": xr.Dataset({"a": ("time", NUMBERS)})["a"],
    "tuple": (1, 2, 3),
    "fractions": [Fraction(1), Decimal(2), 3],
    "nothing masked": np.ma.masked_invalid(NUMBERS),
    "mask of False": np.ma.array(NUMBERS, mask=[False, False, False]),
    "single precision": np.array(NUMBERS, np.float32)[::1],
}


@pytest.mark.parametrize("take", TAKES.values(), ids=TAKES)
def test_numbers_are_taken_from_whatever_holds_them(take):
    expected = take(NUMBERS)
    for name, given in GIVEN.items():
        assert np.array_equal(take(given), expected), name


@pytest.mark.parametrize("take", TAKES.values(), ids=TAKES)
def test_masked_samples_are_refused_by_index(take):
    with pytest.raises(ValueError, match=r": .* must not be masked, got a masked value at index 1"):
        take(np.ma.array(NUMBERS, mask=[False, True, True]))


@pytest.mark.parametrize("take", TAKES.values(), ids=TAKES)
def test_a_quantity_of_another_unit_is_refused_with_the_reason(take):
    """Pint's would lose its unit on the way through NumPy."""
    with pytest.raises(ValueError, match=r": .*quantity (in|without) .*kelvin"):
        take(IN_KELVIN)


REFUSED = {
    "missing": (pd.Series([1.0, None, 3.0], dtype=object), "real numbers, got None at index 1"),
    "NA": ([1.0, pd.NA, 3.0], "real numbers, got <NA> at index 1"),
    "text among numbers": ([1.0, 2.0, Fraction(1), "3"], "real numbers, got '3' at index 3"),
    "strings": (pd.Series(["1", "2", "3"]), "must hold real numbers, got .*(object|at index 0)"),
    "complex": ([1, 2j, 3], "must hold real numbers, got complex128"),
    "dates": (pd.date_range("2024-01-01", periods=3), "must hold real numbers, got datetime64"),
    "None": (None, "must hold real numbers, got None"),
    "dict": ({0: 1.0, 1: 2.0}, r"must hold real numbers, got \{0: 1.0, 1: 2.0\}"),
}


@pytest.mark.parametrize("where", TAKES)
def test_what_is_no_number_is_refused_with_its_index(where):
    for what, (given, message) in REFUSED.items():
        if what != "None" or where not in NONE_IS_THE_DEFAULT:
            with pytest.raises(ValueError, match=": .*" + message):
                TAKES[where](given)


# pandas makes NaN of what is missing, or leaves it: either way it is named with its index.
@pytest.mark.parametrize("dtype", ["Float64", "Int64", "float64"])
def test_a_missing_sample_is_named_with_its_index(dtype):
    with pytest.raises(ValueError, match=r"got nan m/s\^2|got <NA> at index 1") as caught:
        ss.GroundMotion(pd.Series([1, None, 3], dtype=dtype), dt=0.1)
    assert "[1]" in str(caught.value) or "index 1" in str(caught.value)


def test_what_a_number_raises_when_asked_for_its_value_comes_through():
    class Broken:
        def __float__(self):
            raise LookupError("mine")

    with pytest.raises(LookupError, match="mine"):
        ss.GroundMotion([1.0, Broken()], dt=0.1)


def test_a_quantile_function_may_answer_with_pandas():
    def uniform(u):
        return pd.Series(np.sqrt(3) * (2 * u - 1))

    made = ss.PoissonPulses(rate=3, half_width=1, sigma=1, duration=6, quantile=uniform)
    assert made.pulses(seed=1, member=0)[1].size > 0


def test_a_function_of_one_number_gives_a_number_and_of_a_table_a_table():
    assert type(BAND(2)) is float
    assert BAND(pd.DataFrame({"a": NUMBERS, "b": NUMBERS})).shape == (3, 2)
    with pytest.raises(ValueError, match="masked value at index 4"):
        BAND(np.ma.array([NUMBERS, NUMBERS], mask=[[0, 0, 0], [0, 1, 0]]))
