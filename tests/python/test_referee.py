"""The referee: its problems, and the adapters that need nothing beyond the package's extras."""

import json
import subprocess
import sys

import pytest
from pages import ROOT
from stickslip import referee
from stickslip.referee import __main__ as command
from stickslip.referee import report, time_steps, tools
from stickslip.referee.adapters import own
from stickslip.referee.problems import NotTriedError

FOLDER = ROOT / "referee" / "problems"
PROBLEMS = referee.problems(FOLDER)
SCIPY = 2e-6  # of the scale: it ends a slip in the plane at 3e-8 m/s


def test_there_are_72_problems_in_nine_classes():
    assert len(PROBLEMS) == 72
    assert {one.group for one in PROBLEMS} == set(referee.CLASSES)
    assert len({one.id for one in PROBLEMS}) == 72
    assert all((FOLDER / f"{one.id}.json").is_file() for one in PROBLEMS)


def test_every_problem_follows_the_schema():
    jsonschema = pytest.importorskip("jsonschema")
    schema = json.loads((ROOT / "referee" / "schema.json").read_text(encoding="utf-8"))
    validator = jsonschema.Draft202012Validator(schema)
    for file in FOLDER.glob("*.json"):
        validator.validate(json.loads(file.read_text(encoding="utf-8")))


def test_the_description_names_every_field_of_the_schema():
    words = (ROOT / "referee" / "SCHEMA.md").read_text(encoding="utf-8")
    schema = json.loads((ROOT / "referee" / "schema.json").read_text(encoding="utf-8"))
    kinds = [one["properties"]["kind"]["const"] for one in schema["$defs"]["friction"]["oneOf"]]
    systems = schema["properties"]["system"]["properties"]
    for name in (
        *schema["properties"],
        *systems["kind"]["enum"],
        *kinds,
        *systems["stops"]["properties"],
    ):
        assert f"`{name}`" in words, name


@pytest.mark.parametrize("problem", PROBLEMS, ids=lambda one: one.id)
def test_answers_have_15_digits_and_a_ground_motion_for_each_sample(problem):
    file = json.loads((FOLDER / f"{problem.id}.json").read_text(encoding="utf-8"))
    lengths = {
        len(file["ground"][name])
        for name in ("along", "transverse", "vertical")
        if problem.has(name)
    }
    assert len(lengths) == 1
    for name, asked in file["answers"].items():
        for value in asked["value"]:
            digits = value.partition("e")[0].replace(".", "").lstrip("-0")
            exact = name == "overturned" or asked["uncertainty"] == "0"
            assert exact or len(digits) >= 15 or float(value) == round(float(value), 10)
    assert "independent.py" in problem.origin


@pytest.mark.parametrize("problem", PROBLEMS, ids=lambda one: one.id)
@pytest.mark.filterwarnings("ignore::stickslip.PlausibilityWarning")
def test_the_library_answers_within_the_uncertainty(problem):
    found = own.solve(problem, 0)
    assert problem.error(found) < 1e-9
    for name, asked in problem.answers.items():
        for one, right in zip(found[name], asked.value, strict=True):
            assert abs(one - right) <= asked.uncertainty, name


@pytest.mark.slow
@pytest.mark.parametrize(
    "problem", [one for one in PROBLEMS if one.kind != "cart"], ids=lambda one: one.id
)
def test_scipy_with_events_finds_the_same_answers(problem):
    """Other equations than those of independent.py, and another method."""
    pytest.importorskip("scipy")
    from stickslip.referee.adapters import scipy_ivp

    assert problem.error(scipy_ivp.solve(problem, 2)) <= (
        SCIPY if problem.kind == "planar" else 1e-9
    )


def test_a_wrong_answer_has_its_error_and_a_missing_one_is_refused():
    (braking,) = (one for one in PROBLEMS if one.id == "record-braking")
    right = {name: list(asked.value) for name, asked in braking.answers.items()}
    assert braking.error(right) == 0
    off = right["final_displacement"][0] + 0.01 * braking.scale
    assert braking.error({**right, "final_displacement": [off]}) == pytest.approx(0.01)
    with pytest.raises(ValueError, match="expected 1 numbers as peak_displacement"):
        braking.error({"final_displacement": [0.0]})
    (falls,) = (one for one in PROBLEMS if one.id == "rocking-falls")
    assert falls.error({"overturned": [0.0]}) == 1


def test_a_file_that_is_no_problem_is_refused(tmp_path):
    (tmp_path / "one.json").write_text('{"id": "one"}')
    with pytest.raises(ValueError, match="expected a problem of the referee"):
        referee.read(tmp_path / "one.json")
    with pytest.raises(FileNotFoundError, match="no problems"):
        referee.problems(tmp_path / "none")


def test_every_adapter_states_its_purpose_and_its_settings():
    for adapter in tools.adapters():
        assert adapter.PURPOSE
        assert len(adapter.COSTS) == (1 if adapter is own else 3)
    with pytest.raises(referee.NotExpressibleError, match="sliding in both directions"):
        tools.adapters()[tools.MODULES.index("pyslammer_rigid")].solve(PROBLEMS[0], 0)


def test_an_engine_steps_a_cart_under_the_means_of_the_ground():
    (cart,) = (one for one in PROBLEMS if one.id == "cart-stays")
    forces = []

    def build(built):
        assert (built.step, len(built.supports)) == (0.01, 4)

        def roll(*force):
            forces.append(force)
            return 0.0, 0.0, 0.0

        return roll

    assert cart.error(time_steps.march(cart, 0.01, None, roll=build)) == 0
    along, g = cart.component("along"), cart.system["gravity"]
    assert len(forces) == 2 * (len(along) - 1)
    assert forces[1][0] == pytest.approx(-(along[0] + 3 * along[1]) / 4, rel=1e-12)
    assert {force[2] for force in forces} == {-g}
    with pytest.raises(NotTriedError):
        time_steps.march(cart, 0.01, None)


def test_the_command_runs_a_tool_keeps_its_results_and_reads_them(tmp_path, capsys):
    file = tmp_path / "own.json"
    asked = ["--problems", str(FOLDER), "--problem", "record-braking", "stick-sine"]
    assert command.main([*asked, "--tool", "stickslip", "--results", str(file)]) == 0
    first = capsys.readouterr().out
    assert "| stickslip |" in first
    assert command.main([*asked, "--read", str(file)]) == 0
    assert capsys.readouterr().out in first
    (results,) = report.read_results([file])
    assert {one["problem"] for one in results["results"]} == {"record-braking", "stick-sine"}
    with pytest.raises(SystemExit):
        command.main([*asked, "--tool", "no such"])
    assert "no such tool: no such" in capsys.readouterr().err


def test_the_picture_has_a_panel_for_each_class():
    pytest.importorskip("matplotlib")
    few = [one for one in PROBLEMS if one.id in ("record-braking", "spring-free")]
    figure = report.plot(report.gather([tools.run_all(own, few)], few))
    assert [axes.get_title(loc="left") for axes in figure.axes] == list(referee.CLASSES)


@pytest.mark.slow
def test_the_independent_program_solves_a_problem_again():
    pytest.importorskip("flint", reason="needs python-flint")
    program = [sys.executable, ROOT / "referee" / "independent.py", FOLDER / "record-hum.json"]
    done = subprocess.run(program, capture_output=True, text=True, check=True)
    assert all(float(line.split()[-1]) < 1e-19 for line in done.stdout.splitlines())
