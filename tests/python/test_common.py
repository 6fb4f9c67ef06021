"""What every public object of the package does: the same checks over one list, in `objects.py`."""

import ast
import copy
import csv
import inspect
import io
import json
import math
import multiprocessing
import pickle
import pkgutil
import re
import subprocess
import sys
import xml.etree.ElementTree
from concurrent.futures import ProcessPoolExecutor
from importlib import import_module

import numpy as np
import objects
import pytest
import stickslip as ss
import stickslip.thesis
from objects import BLOCK, DAMPER, ENSEMBLE, EVEN, EXAMPLES, SHAKING
from stickslip import harmonic, regressions, theory
from stickslip._rows import Rows
from stickslip._structures import Modes


def every(names):
    """A test for each class of the list."""
    return pytest.mark.parametrize("kind", names, ids=lambda kind: kind.__name__)


def having(method):
    """The classes of the list that have a method."""
    return every([kind for kind in EXAMPLES if hasattr(kind, method)])


def content(thing):
    """All that an object shows, to the bit, in what Python compares."""
    if isinstance(thing, np.ndarray):
        return thing.dtype.str, thing.shape, thing.tobytes()
    if isinstance(thing, float | complex | np.generic):
        return content(np.asarray(thing))
    if isinstance(thing, list | tuple | range):
        return type(thing), [content(element) for element in thing]
    if hasattr(thing, "toarray"):  # a sparse matrix
        return content(thing.toarray())
    if isinstance(thing, dict):
        return {name: content(value) for name, value in thing.items()}
    if type(thing) not in EXAMPLES:
        part = type(thing).__module__.startswith("stickslip.") and hasattr(thing, "__dict__")
        return content(vars(thing)) if part and type(thing).__eq__ is object.__eq__ else thing
    shown = {"repr": repr(thing)} if type(thing) is not ss.Comparison else {}
    for name in dir(thing):
        if name.startswith("__") or name == "with_traceback":
            continue
        try:
            value = getattr(thing, name)
        except ValueError as error:
            value = str(error)
        if not callable(value):
            shown[name] = content(value)
    return shown


def twins(thing):
    return [
        *(pickle.loads(pickle.dumps(thing, p)) for p in range(pickle.HIGHEST_PROTOCOL + 1)),
        copy.copy(thing),
        copy.deepcopy(thing),
    ]


def is_same(twin, thing, expected):
    assert type(twin) is type(thing)
    assert twin is not thing
    assert content(twin) == expected
    if not isinstance(thing, Exception):
        assert twin == thing
        assert not twin != thing  # noqa: SIM202
        assert type(thing).__hash__ is None or hash(twin) == hash(thing)


# Its parts are of other packages, or belong to the command line, the referee or a private module.
INNER = ("cli", "referee", "demo", "__main__", "_hdf5", "_tables", "_responses", "plotting")
INNER += ("runs.parts", "runs.checkpoint", "ensemble.parts", "ensemble.checkpoint")
INNER += ("motions.records", "motions.stations", "motions.archives", "motions.metadata")
INNER += ("sweeps.checkpoint", "risk.exceedance", "risk.observations", "risk.cloud", "risk.levels")


def test_every_public_class_is_in_the_list():
    """Those that users construct, and those that functions return."""

    def inner(name):
        return f"{name}.".startswith(tuple(f"stickslip.{one}." for one in INNER))

    modules = [one.name for one in pkgutil.walk_packages(ss.__path__, "stickslip.")]
    found = {
        one
        for module in modules
        if not inner(module)
        for name, one in vars(import_module(module)).items()
        if inspect.isclass(one) and one.__module__.startswith("stickslip")
        if not name.startswith("_") and not inner(one.__module__)
    }
    left = {one for one in found if one.__name__ in set().union(*objects.ELSEWHERE.values())}
    assert found - left == set(EXAMPLES)
    assert all(EXAMPLES.values())


# Read from a file, this class carries the motion again.
SLOW = {theory.DisplacementDistribution}


@pytest.mark.parametrize(
    "kind",
    [pytest.param(kind, marks=[pytest.mark.slow] * (kind in SLOW)) for kind in EXAMPLES],
    ids=lambda kind: kind.__name__,
)
def test_pickled_and_copied_all_is_the_same_to_the_bit(kind):
    for thing in EXAMPLES[kind]:
        expected = content(thing)
        for twin in twins(thing):
            is_same(twin, thing, expected)


@having("sample")
def test_a_copy_draws_the_same_members(kind):
    for thing in EXAMPLES[kind]:
        drawn = thing.sample(seed=5, member=6)
        assert all(twin.sample(seed=5, member=6) == drawn for twin in twins(thing))


@pytest.mark.slow
def test_all_go_through_other_processes():
    things = [example for examples in EXAMPLES.values() for example in examples]
    with ProcessPoolExecutor(1, mp_context=multiprocessing.get_context("spawn")) as pool:
        for twin, thing in zip(pool.map(copy.deepcopy, things), things, strict=True):
            is_same(twin, thing, content(thing))


@every(EXAMPLES)
def test_what_differs_compares_different(kind):
    examples = EXAMPLES[kind]
    for i, one in enumerate(examples):
        assert [one == other for other in examples] == [i == k for k in range(len(examples))]
        assert [one != other for other in examples] == [i != k for k in range(len(examples))]
        for stranger in (None, 1.0, "", kind, EVEN if kind is not ss.GroundMotion else DAMPER):
            assert not one == stranger  # noqa: SIM201
            assert one != stranger


def test_what_can_change_has_no_hash_and_all_else_has_one():
    unhashable = {kind for kind in EXAMPLES if kind.__hash__ is None}
    tables = {ss.SweepTable, ss.IntensityMeasures, ss.SuiteSpectra, ss.RotD, ss.Orientations}
    tables |= {ss.RockingTable, ss.RockingEnsemble, ss.RockingSpectrum}
    tables |= {ss.CartTable, ss.CartEnsemble}
    tables |= {ss.Fragility, ss.Hazard, ss.Exceedances, ss.DesignChart, ss.IntensityEfficiency}
    tables |= {regressions.Prediction, Modes, Rows}
    assert unhashable == {ss.Ensemble, ss.Comparison, ss.Grid} | tables
    for kind in EXAMPLES.keys() - unhashable:
        assert len({*EXAMPLES[kind], *EXAMPLES[kind]}) == len(EXAMPLES[kind])


def test_a_response_keeps_what_it_came_from_when_it_is_pickled():
    first, *others = pickle.loads(pickle.dumps([ss.integrate(BLOCK, EVEN) for _ in range(3)]))
    assert first.motion == EVEN
    assert all(other.motion is first.motion for other in others)
    assert not first.displacement.flags.writeable


def test_zeros_of_either_sign_are_equal_and_hash_alike():
    plus, minus = (ss.GroundMotion([0, zero, 1], dt=0.1) for zero in (0.0, -0.0))
    assert plus == minus
    assert hash(plus) == hash(minus)


def test_an_ensemble_is_equal_however_it_was_put_together():
    parts = [
        ss.run_ensemble(BLOCK, SHAKING, members=n, seed=1, first_member=first)
        for first, n in ((64, 6), (0, 64))
    ]
    whole = parts[0]
    assert whole != ENSEMBLE
    whole.merge(parts[1])
    assert whole == ENSEMBLE


class OwnMotion(ss.GroundMotion):
    pass


def test_what_is_derived_from_a_class_stays_what_it_is():
    own = OwnMotion([0.0, 2.0, -2.0, 0.1], dt=0.1, name="M\u00e9xico")
    for twin in twins(own):
        assert type(twin) is OwnMotion
        assert twin == own == EVEN


# ---- what they show


NAMES = {**vars(harmonic), **vars(theory), **vars(regressions), **vars(ss), **vars(objects)}


@every([kind for kind in EXAMPLES if not issubclass(kind, list)])  # which look like lists
def test_a_repr_is_a_call_or_a_line_with_the_digits_that_people_read(kind):
    for thing in EXAMPLES[kind]:
        text = repr(thing)
        assert "\n" not in text
        if not text.startswith("<"):
            if "<" not in text and not issubclass(kind, Exception):
                assert eval(text, {**NAMES, kind.__name__: kind}) == thing
            continue
        assert text.startswith(f"<{kind.__name__}") and text.endswith(">")
        assert not re.search(r"0x|array\(|float64|_core", text)
        digits = re.findall(r"\d[\d.]*", text.replace("1e-300", ""))
        assert all(len(one.strip("0.").replace(".", "")) < 6 for one in digits)


def well_formed(page):
    root = xml.etree.ElementTree.fromstring(f"<div>{page}</div>")
    assert not list(root.iter("script"))
    assert not re.search("http|src=|href=", page)
    return root


@having("_repr_html_")
def test_a_notebook_shows_a_table(kind):
    for thing in EXAMPLES[kind]:
        root = well_formed(thing._repr_html_())
        rows = [["".join(cell.itertext()) for cell in row] for row in root.iter("tr")]
        assert rows
        assert all(row for row in rows)


def strict(text):
    return json.loads(text, parse_constant=pytest.fail)


@having("to_json")
def test_json_is_strict_and_says_units(kind):
    for thing in EXAMPLES[kind]:
        document = strict(thing.to_json())
        assert isinstance(document, dict)
        if hasattr(kind, "from_json"):
            assert kind.from_json(thing.to_json()) == thing
            continue
        assert document["stickslip"] == ss.__version__
        for name, value in document.items():
            own = getattr(thing, name, None)
            if isinstance(own, bool | int | float) and not isinstance(value, list):
                assert as_read([own]) == as_read([value]), name
            elif isinstance(own, np.ndarray) and own.shape == np.shape(value):
                assert isinstance(value[0], str | dict) or as_read(own) == as_read(value), name


def as_read(values):
    """Values of a column as they are in files of text: NaN is None, truth a number."""
    return [
        None if one is None or (isinstance(one, float) and not math.isfinite(one)) else one
        for one in (float(v) if isinstance(v, bool) else v for v in np.asarray(values).tolist())
    ]


@having("to_dataframe")
def test_tables_have_the_same_columns_units_and_values(kind, tmp_path):
    pytest.importorskip("pandas")
    for thing in EXAMPLES[kind]:
        frame = thing.to_dataframe()
        units = frame.attrs["units"]
        if frame.index.name is not None:
            frame = frame.reset_index()
        assert all(name.isidentifier() for name in frame)
        assert units.keys() <= set(frame)
        assert all(units.values())
        file = thing.to_csv(tmp_path / "t.csv")
        heads, *rows = csv.reader(io.StringIO(file.read_text(encoding="utf-8"), newline=""))
        expected = [f"{name} [{units[name]}]" if name in units else name for name in frame]
        # A file of a motion reads back as a record: without what follows from the acceleration.
        assert heads == (expected[: len(heads)] if kind is ss.GroundMotion else expected)
        document = strict(thing.to_json())
        document = document.get("by_member", document) | {"units": document.get("units", {})}
        data = thing.to_xarray() if hasattr(kind, "to_xarray") else None
        assert len(rows) == len(frame)
        for name, cells in zip(frame, zip(*rows)):
            values = as_read(frame[name])
            own = getattr(thing, name, None)
            if isinstance(own, np.ndarray) and own.shape == (len(frame),):
                assert isinstance(values[0], str) or as_read(own) == values, name
            numbers = not any(isinstance(one, str) for one in values)
            assert as_read([float(one) for one in cells] if numbers else cells) == values, name
            if np.shape(document.get(name)) == (len(frame),):
                assert as_read(document[name]) == values, name
            if data is not None and name in data.variables:
                assert data[name].attrs.get("units", "") == units.get(name, ""), name
                if data[name].dims == (frame.columns[0],) and data[name].dtype.kind in "fib":
                    assert np.array_equal(data[name], frame[name]), name


@having("to_xarray")
def test_a_dataset_says_what_each_variable_is(kind):
    pytest.importorskip("xarray")
    for thing in EXAMPLES[kind]:
        for name, variable in thing.to_xarray().data_vars.items():
            assert variable.attrs["long_name"], name


CONVERSIONS = [
    (kind, library, method)
    for library, method in (("pandas", "to_dataframe"), ("xarray", "to_xarray"))
    for kind in EXAMPLES
    if hasattr(kind, method)
]


@pytest.mark.parametrize("kind, library, method", CONVERSIONS)
def test_without_the_library_the_message_says_what_to_install(kind, library, method, monkeypatch):
    monkeypatch.setitem(sys.modules, library, None)
    message = rf"^{kind.__name__}\.{method}: needs {library},.*pip install stickslip\[tables\]"
    for thing in EXAMPLES[kind]:
        with pytest.raises(ImportError, match=message):
            getattr(thing, method)()


PICTURES = [(kind, name) for kind in EXAMPLES for name in dir(kind) if name.startswith("plot")]


@pytest.mark.filterwarnings("ignore:Fragility.bands")
@pytest.mark.parametrize("kind, name", PICTURES, ids=lambda one: getattr(one, "__name__", one))
def test_a_picture_takes_a_title_and_a_place_and_nothing_else(kind, name):
    matplotlib = pytest.importorskip("matplotlib")
    from stickslip import plotting

    for thing in EXAMPLES[kind]:
        draw = getattr(thing, name)
        try:
            figure = draw(title="mine")
            break
        except ValueError as error:  # such as of floors without floors
            assert len(str(error)) > 20
    texts = figure.findobj(matplotlib.text.Text)
    assert any(text.get_text().startswith("mine") for text in texts)
    figure.draw_without_rendering()
    places = inspect.signature(draw).parameters.keys() & {"ax", "figure"}
    assert places
    for place in places:
        other = plotting.new_figure(6, 4)
        given = other.subplots() if place == "ax" else other
        assert draw(**{place: given}) is given
        with pytest.raises(TypeError, match=rf"{place} must be a matplotlib"):
            draw(**{place: 3})
    with pytest.raises(TypeError, match="tittle"):
        draw(tittle="mine")


def said(parameter, text):
    return re.search(rf"(?<![\w.]){re.escape(parameter)}\b", text)


@every([kind for kind in EXAMPLES if not issubclass(kind, Warning)])
def test_help_describes_each_attribute_and_each_parameter(kind):
    whole = inspect.getdoc(kind) or ""
    assert re.match(r"[A-Z`].*\.", whole.replace("\n", " "))
    returned = re.search(r"returns? (it|them)", whole)  # no user calls the constructor
    if (
        kind.__init__ is not object.__init__
        and not returned
        and not issubclass(kind, list | Exception)
    ):
        both = whole + (inspect.getdoc(kind.__init__) or "")
        for parameter in inspect.signature(kind).parameters.values():
            if parameter.kind in (parameter.POSITIONAL_OR_KEYWORD, parameter.KEYWORD_ONLY):
                assert said(parameter.name, both), parameter.name
    for name in public_attributes(kind):
        if kind is ss.Ensemble and name.startswith("plot"):  # of the bindings
            continue
        thing = getattr(kind, name)
        text = inspect.getdoc(thing) if hasattr(thing, "__doc__") else ""
        if not callable(thing):
            assert text or said(name, whole), name
            continue
        assert re.match(rf"({name}\(.*)?[A-Z`\|\d].*\.", (text or "").replace("\n", " ")), name
        for parameter in inspect.signature(thing).parameters:
            if parameter not in ("self", "args", "kwargs"):
                assert said(parameter, text), f"{name}: {parameter}"


# ---- what they refuse


VALUES = [kind for kind in EXAMPLES if kind.__hash__ and not issubclass(kind, Exception)]
FREE = (regressions.Regression, ss.Suite, ss.Random)  # as other classes of Python


def public_attributes(thing):
    inherited = {*dir(Exception), *dir(list), *dir(tuple)}
    return [name for name in dir(thing) if name[0] != "_" and name not in inherited]


@every([kind for kind in VALUES if not issubclass(kind, FREE)])
def test_attributes_cannot_be_set(kind):
    thing = EXAMPLES[kind][0]
    others = [] if hasattr(thing, "__dict__") else ["color"]
    for name in [*public_attributes(kind), *others]:
        with pytest.raises(AttributeError):
            setattr(thing, name, 1)


@every(VALUES)
def test_who_writes_to_an_array_changes_no_object(kind):
    for thing in EXAMPLES[kind]:
        for name in public_attributes(thing):
            try:
                value = getattr(thing, name)
            except ValueError:
                continue
            if isinstance(value, np.ndarray) and value.flags.writeable:
                assert not np.shares_memory(value, getattr(thing, name)), name


def changed(text, value):
    """A call, with each number in turn replaced, and the argument that it is of."""
    call = ast.parse(text, mode="eval").body
    names = list(inspect.signature(eval(ast.unparse(call.func), NAMES)).parameters)
    given = [*zip(names, call.args), *((one.arg, one.value) for one in call.keywords)]
    for i, (name, node) in enumerate(given):
        if isinstance(node, ast.List | ast.Tuple) and isinstance(node.elts[0], ast.Constant):
            new = type(node)([ast.Name(value), *node.elts[1:]], ast.Load())
        elif isinstance(node, ast.Constant) and type(node.value) in (int, float):
            new = ast.Name(value)
        else:
            continue
        args = [new if i == k else one for k, one in enumerate(call.args)]
        keywords = [
            ast.keyword(one.arg, new if i == len(args) + k else one.value)
            for k, one in enumerate(call.keywords)
        ]
        yield name, ast.unparse(ast.fix_missing_locations(ast.Call(call.func, args, keywords)))


CALLS = {
    "integrate": "integrate(BLOCK, EVEN, displacement=0.1, velocity=0.1, sliding_distance=0.1)",
    "in the plane": "integrate(PlanarSlider(ROUND), PAIR, displacement=(0, 0), velocity=(0, 0))",
    "integrate a block": "integrate(ROCKS[0], EVEN, rotation=0.001, rate=0.001)",
    "integrate a cart": "integrate(CARTS[0], PAIR, velocity=(0, 0), yaw=0.1, yaw_rate=0.1)",
    "State": "State(0.1, 0.2, 0.3)",
    "StructureState": "StructureState([0.1], [0.2], displacement=0.1, velocity=0.2)",
    "cut": "EVEN.cut(0, 0.2)",
    "resampled": "EVEN.resampled(0.05)",
    "scaled_to": "EVEN.scaled_to(pga_g=0.5)",
    "advance": "advance(BLOCK, State(), 0.1, 9, 8)",
    "PlanarState": "PlanarState((1.0, 0.5), (0.0, 2.0), 1.0)",
    "RockingState": "RockingState(0.1, 0.1)",
    "GroundMotion": "GroundMotion([0, 1], dt=0.1, transverse=[0, 1], vertical=[0, 1])",
    "GroundMotion, times": "GroundMotion([0, 1], times=[0, 1])",
    "scaled": "EVEN.scaled(2)",
    "rotated": "TWO.rotated(30)",
    "response_spectrum": "response_spectrum(EVEN, [0.5], 0.05)",
    "rotd": "rotd(TWO, [0.5], 0.05)",
    "orientations": "orientations(BLOCK, TWO, [0, 45])",
    "rocking_spectrum": "rocking_spectrum(EVEN, alpha=0.1, periods=[2], restitution=0.9)",
    "critical_scales": "critical_scales(ROCKS[0], EVEN, up_to=2)",
    "asce43": "asce43(mu=0.1, motion=EVEN)",
    "yield_acceleration": "ss.yield_acceleration(slope_degrees=20, factor_of_safety=1.2)",
    "exceedance": "ENSEMBLE.exceedance(0.1)",
    "quantile": "ENSEMBLE.quantile(0.5)",
    "at": "RESPONSES[0].at(0.1)",
    "shear_building": "Structure.shear_building(masses=[2], stiffnesses=[30], damping_ratio=0.05)",
    "from_modes": "Structure.from_modes(mass_fractions=[1], frequencies=[8], damping_ratios=[0])",
    "from_geometry": "Caster.from_geometry(mu=0.2, trail=0.03, wheel_width=0.02, rolling_mu=0.1)",
    "from_size": "SlenderBlock.from_size(width=0.6, height=2, restitution=0.9)",
    "in_cup": "Slider.in_cup(BLOCK, cup_radius=0.5, wheel_radius=0.04, damping=0.1)",
    "pulse_response": "pulse_response(BLOCK, 2, 0.1)",
    "orbits": "orbits(WHEEL, 1.5, 1.0)",
    "continuation": "continuation(WHEEL, BRANCH[0], 0.9, 1.1)",
    "transition_time": "transition_time(WHEEL, 0.01)",
    "thresholds": "Fragility.fit(STRIPES, im='pga_g', thresholds=0.05)",
    "Hazard": "Hazard([0.1, 1], [0.01, 1e-05], name='pga_g', unit='g')",
}
CALLS |= {
    text: text
    for kind, examples in EXAMPLES.items()
    for text in map(repr, examples)
    if kind in VALUES and "<" not in text and not issubclass(kind, tuple)
}


@pytest.mark.filterwarnings("ignore::stickslip.PlausibilityWarning")  # of infinity
@pytest.mark.parametrize("name", CALLS)
def test_what_is_no_number_is_refused_by_the_name_of_the_argument(name):
    for value, got in (("nan", "nan"), ("text", "got"), ("inf", "inf")):
        for argument, call in changed(CALLS[name], value):
            try:
                eval(call, {**NAMES, "nan": math.nan, "text": "x", "inf": math.inf})
            except (TypeError, ValueError) as refusal:
                message = str(refusal)
                assert got in message, call
                assert value == "inf" or re.search(rf"\b{argument}", message), call
            else:
                assert value == "inf", call


@pytest.mark.parametrize("name", CALLS)
def test_an_unknown_argument_is_named(name):
    call = ast.parse(CALLS[name], mode="eval").body
    call.keywords.append(ast.keyword("nope", ast.Constant(1)))
    with pytest.raises(TypeError, match=r"nope|takes no arguments"):
        eval(ast.unparse(call), NAMES)


# ---- objects that were never initialized

UNFINISHED = """
import pickle
import stickslip as ss
from stickslip import harmonic, theory, thesis

motion = ss.GroundMotion([0, 1], dt=1)

def check(kind, what, use):
    try:
        use()
    except TypeError:
        return
    except Exception as error:
        print(kind.__name__, what, "raises", repr(error))
    else:
        print(kind.__name__, what, "works")

for module in (ss, harmonic, theory, thesis):
    for kind in map(vars(module).get, module.__all__):
        if type(kind).__name__ != "pybind11_type":
            continue
        def make():
            return kind.__new__(kind)
        check(kind, "pickle", lambda: pickle.dumps(make()))
        if kind not in (thesis.Thesis, ss.FrictionLaw):
            check(kind, "repr", lambda: repr(make()))
            check(kind, "==", lambda: make() == make())
            check(kind, "hash", lambda: hash(make()))
            check(kind, "len", lambda: len(make()))
        for name, member in vars(kind).items():
            if type(member) is property:
                check(kind, name, lambda: getattr(make(), name))
        for name, member in vars(kind).items():
            if not name.startswith("__") and type(member).__name__ == "instancemethod":
                check(kind, name + "()", lambda: getattr(make(), name)(*[1] * 2))
                check(kind, name + "()", lambda: getattr(make(), name)())

class Early(ss.GroundMotion):
    def __init__(self):
        check(Early, "repr", lambda: repr(self))
        super().__init__([0, 1], dt=1)

repr(Early())
slider = ss.Slider.__new__(ss.Slider)
check(ss.Slider, "argument", lambda: ss.integrate(slider, motion))
check(ss.Coulomb, "argument", lambda: ss.integrate(ss.Coulomb.__new__(ss.Coulomb), motion))
empty = ss.GroundMotion.__new__(ss.GroundMotion)
check(ss.GroundMotion, "argument", lambda: ss.integrate(ss.Coulomb(mu=1), empty))
check(ss.Coulomb, "law", lambda: ss.Slider(ss.Coulomb.__new__(ss.Coulomb)))
print("alive")
"""


def test_an_object_that_was_never_initialized_is_a_type_error_wherever_it_is_used():
    result = subprocess.run([sys.executable, "-c", UNFINISHED], capture_output=True, text=True)
    assert (result.returncode, result.stdout, result.stderr) == (0, "alive\n", "")
