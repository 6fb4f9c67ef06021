"""What a user sees of the package is Python: signatures, help and errors without the words of the
library that binds it."""

import inspect
import pydoc
import re
from types import ModuleType

import numpy as np
import pytest
import stickslip as ss
from objects import EXAMPLES
from stickslip import ensemble, harmonic, plotting, regressions, theory
from stickslip._refusals import explain

FOREIGN = re.compile(
    r"pybind11|\b_core\b|\barg\d\b|Invoked with|incompatible|numpy\.ndarray\[|std::|Sequence\["
    r"|Supports(Float|Int|Index)|Overloaded|Annotated\[|C\+\+ type|typing\."
)
SEEN = ("__call__", "__init__", "__mul__", "__rmul__", "__truediv__", "__eq__", "__len__")


def public():
    """Everything that a user can call or read, by its name."""
    found = {}

    def add(name, thing):
        found[name] = thing
        if inspect.isclass(thing):
            for member in dir(thing):
                shown = not member.startswith("_") and member not in dir(Exception)
                if shown or (member in SEEN and member in vars(thing)):
                    found[f"{name}.{member}"] = inspect.getattr_static(thing, member)

    for module in (ss, theory, harmonic, plotting, ensemble, regressions):
        for name in getattr(module, "__all__", ()):
            thing = getattr(module, name)
            if not isinstance(thing, ModuleType):
                add(f"{module.__name__}.{name}", thing)
    return found


PUBLIC = public()
BOUND = {
    name: thing
    for name, thing in PUBLIC.items()
    if type(thing).__name__ in ("instancemethod", "builtin_function_or_method", "staticmethod")
}


def function(thing):
    return thing.__func__ if isinstance(thing, staticmethod) else thing


def test_all_of_it_is_looked_at():
    assert len(PUBLIC) > 400 and len(BOUND) > 150


def test_no_docstring_has_a_word_of_the_binding_library():
    for name, thing in PUBLIC.items():
        text = inspect.getdoc(function(thing)) or ""
        assert FOREIGN.search(text) is None, name
        assert (
            text
            or name.rpartition(".")[2].startswith("__")
            or isinstance(thing, float | str | property)
        ), f"{name} says nothing"


def test_every_function_has_a_signature_that_help_shows():
    for name, bound in BOUND.items():
        thing = function(bound)
        signature = inspect.signature(thing)
        assert FOREIGN.search(str(signature)) is None, name
        text = pydoc.plain(pydoc.render_doc(thing, renderer=pydoc.plaintext))
        first = thing.__name__ + str(signature)
        assert first.replace("Ellipsis", "...") in text.replace("Ellipsis", "..."), name


def test_every_class_can_be_looked_into():
    for name, cls in PUBLIC.items():
        if not inspect.isclass(cls):
            continue
        assert cls.__module__.startswith("stickslip") and "_core" not in cls.__module__, name
        if not issubclass(cls, Exception):
            inspect.signature(cls)
            assert FOREIGN.search(repr(cls)) is None, name


@pytest.mark.parametrize("thing", [ss.integrate, ss.strong_motion, ss.advance])
def test_help_of_a_function_has_no_word_of_the_binding_library(thing):
    text = pydoc.plain(pydoc.render_doc(thing, renderer=pydoc.plaintext))
    assert "pybind11" not in text
    assert "stickslip.function" in text


def test_signatures_say_what_a_call_takes():
    for thing, text in (
        (ss.Coulomb, "(*, mu=None, slip_level=None, backward=None, mu_backward=None)"),
        (
            ss.Slider,
            "(law, natural_frequency=None, damping=None, *, period=None, damping_ratio=None,"
            " slope_degrees=0.0, one_way=False, stops=None, pendulum=False)",
        ),
        (
            ss.integrate,
            "(slider, motion, *, displacement=0.0, velocity=0.0, settle=False, contact='flight',"
            " sliding_distance=0.0, heat=None, rotation=0.0, rate=0.0, yaw=0.0, yaw_rate=0.0,"
            " walls=())",
        ),
        (ss.GroundMotion.scaled, "(self, factor)"),
        (ss.Response.plot, "(self, *, figure=None, title=None, time=None)"),
    ):
        assert str(inspect.signature(thing)) == text
    motion = ss.GroundMotion([1, 2], dt=1)
    assert str(inspect.signature(motion.scaled)) == "(factor)"
    inspect.signature(ss.integrate).bind(ss.Coulomb(mu=0.1), motion, settle=True)


# ---- errors


class Strange:
    def __repr__(self):
        return "Strange()"


BLOCK = ss.Coulomb(mu=0.1)
QUAKE = ss.GroundMotion([1.0, -2.0, 3.0, 0.0], dt=0.1)
OF_CLASS = {kind.__name__: examples[0] for kind, examples in EXAMPLES.items()}


def test_no_refusal_has_a_word_of_the_binding_library():
    """Every function, called with invalid arguments."""
    calls = [((), {}), ((Strange(),), {}), ((Strange(),) * 9, {}), ((), {"nope": Strange()})]
    for name, bound in BOUND.items():
        *_, owner, short = name.split(".")
        thing = function(bound)
        if short == "__init__":
            modules = (ss, theory, harmonic)
            thing = next(getattr(m, owner) for m in modules if hasattr(m, owner))
        elif type(bound).__name__ == "instancemethod":
            thing = thing.__get__(OF_CLASS[owner])
        said = []
        for args, kwargs in calls:
            try:
                thing(*args, **kwargs)
            except (TypeError, ValueError, ss.ConvergenceError) as error:
                said.append(str(error))
        for text in said:
            assert FOREIGN.search(text) is None, (name, text)
        assert said or short.startswith("__"), name


SAID = {
    "law": (lambda: ss.Slider(0.2), "Slider: law must be a friction law, such as Coulomb"),
    "slider": (
        lambda: ss.integrate(0.2, QUAKE),
        "integrate: slider must be a Slider, a friction law, a PlanarSlider",
    ),
    "motion": (lambda: ss.integrate(BLOCK, [1, 2]), "integrate: motion must be a GroundMotion or"),
    "missing": (lambda: ss.integrate(BLOCK), "integrate: needs motion, got none"),
    "text": (lambda: QUAKE.scaled("x"), "GroundMotion.scaled: factor must be a number, got 'x'"),
    "too many": (lambda: QUAKE.scaled(1, 2), "takes at most 1 argument without a name, got 2"),
    "by name": (lambda: ss.Spectrum.white(1.0), "Spectrum.white: takes its arguments by name"),
    "unknown": (
        lambda: ss.Slider(BLOCK, perod=3),
        "Slider: has no argument 'perod'; its arguments are law, natural_frequency, damping,",
    ),
    "dt": (lambda: ss.GroundMotion([1, 2], "a"), "GroundMotion: dt must be a number, got 'a'"),
    "path": (lambda: ss.read_record(3), "read_record: file must be a string"),
    "overloads": (
        lambda: theory.WhiteNoise(3),
        "WhiteNoise: takes WhiteNoise(*, dimensions=...) or "
        "WhiteNoise(slider, s0, *, dimensions=...), got WhiteNoise(3)",
    ),
    "not made by a call": (
        ss.Response,
        "Response: cannot be constructed directly; other functions return it",
    ),
    "spectrum": (
        lambda: ss.response_spectrum(3, [1]),
        "response_spectrum: motion must be a GroundMotion, a Suite, or the response of a slider,"
        " a structure or a cart, got 3",
    ),
    "operator": (lambda: QUAKE + 1, "unsupported operand type(s) for +: 'stickslip.GroundMotion'"),
}


@pytest.mark.parametrize("case", SAID)
def test_a_wrong_type_is_named_with_what_would_be_right(case):
    call, text = SAID[case]
    with pytest.raises(TypeError) as caught:
        call()
    assert text in str(caught.value)


def test_an_error_of_the_users_own_function_comes_through():
    def broken(_):
        raise TypeError("mine: incompatible with everything")

    with pytest.raises(TypeError, match=r"^mine: incompatible with everything$"):
        ss.Spectrum.from_function(broken)(1.0)


def test_what_is_not_in_the_stubs_is_said_as_it_was_given():
    assert explain("nowhere", [1, "x"], {"y": 2}) == "nowhere: got nowhere(1, 'x', y=2)"


# ---- quantities that carry their unit


def test_quantities_are_converted_to_si_or_refused_with_the_reason():
    pint = pytest.importorskip("pint")
    q = pint.UnitRegistry().Quantity
    n = [0.1, -0.2, 0.3]
    plain = ss.GroundMotion(np.array(n), times=[0, 0.01, 0.02])
    made = ss.GroundMotion(q(np.array(n) * 100, "cm/s^2"), times=q([0, 10, 20], "ms"))
    assert np.allclose(made.acceleration, plain.acceleration, rtol=1e-15)
    assert np.allclose(made.time, plain.time, rtol=1e-15)
    in_g = ss.GroundMotion(q(n, "g_0"), dt=0.01)
    assert np.allclose(
        in_g.acceleration, ss.GroundMotion(n, dt=0.01, units="g").acceleration, rtol=1e-15
    )
    spectra = [
        ss.response_spectrum(plain, periods, damping).values
        for periods, damping in (([0.5], 0.05), (q([500], "ms"), q(5, "percent")))
    ]
    assert spectra[0] == pytest.approx(spectra[1], rel=1e-12)
    assert ss.Coulomb(mu=q(20, "percent")) == ss.Coulomb(mu=0.2)  # a pure number
    slope = ss.Slider(ss.Coulomb(mu=0.6), slope_degrees=q(20, "degree"))
    assert slope == ss.Slider(ss.Coulomb(mu=0.6), slope_degrees=20)
    with pytest.raises(ValueError, match=r"must be a quantity in m/s\^2 or .* got meter"):
        ss.GroundMotion(q(n, "m"), dt=0.01)
    with pytest.raises(ValueError, match=r"got gram"):  # Pint's g
        ss.GroundMotion(q(n, "g"), dt=0.01)
    with pytest.raises(ValueError, match="units is for plain numbers"):
        ss.GroundMotion(q(n, "m/s^2"), dt=0.01, units="g")
    with pytest.raises(ValueError, match=r"plain numbers in SI units, got a quantity in .*hertz"):
        ss.Spectrum.band_pass(s0=1, low=1, high=2)(q([1.0], "hertz"))  # of 2 pi, which Pint hides
    for call in (
        lambda: ss.GroundMotion(n, q(0.01, "s")),
        lambda: ss.Slider(BLOCK, period=q(2, "s")),
        lambda: plain.cut(q(0, "s"), 1),
    ):
        with pytest.raises(TypeError, match=r"for a quantity with a unit pass the number in SI"):
            call()
    with pytest.raises(TypeError, match=r"slip_level=.*Quantity"):
        ss.Coulomb(slip_level=q(2, "m/s^2"))


def test_a_list_of_quantities_is_refused():
    pint = pytest.importorskip("pint")
    q = pint.UnitRegistry().Quantity
    with pytest.raises(TypeError, match="Cannot convert from 'meter / second"):
        ss.GroundMotion([q(1, "m/s^2"), q(2, "m/s^2")], dt=0.01)


def test_xarray_with_and_without_units():
    xarray, pint = pytest.importorskip("xarray"), pytest.importorskip("pint")
    n = xarray.DataArray([1.0, 2.0, 3.0], dims="time", attrs={"units": "m/s^2"})
    assert ss.GroundMotion(n, dt=0.1).acceleration.tolist() == [1, 2, 3]
    within = xarray.DataArray(pint.UnitRegistry().Quantity([100.0, 200.0], "cm/s^2"), dims="time")
    assert ss.GroundMotion(within, dt=0.1).acceleration == pytest.approx([1, 2], rel=1e-15)
