"""Responses as tables: of pandas and xarray, in files, and in notebooks."""

import csv
import io
import json
import os
import xml.etree.ElementTree

import numpy as np
import pytest
import stickslip as ss
from stickslip._core import number_list, number_texts
from stickslip._tables import Repeated, json_text, write_csv

UNITS = {
    "ground_acceleration": "m/s^2",
    "displacement": "m",
    "velocity": "m/s",
    "acceleration": "m/s^2",
    "friction": "m/s^2",
    "spring": "m/s^2",
    "damper": "m/s^2",
    "force": "m/s^2",
    "stuck": "",
}
HEADS = [f"{name} [{unit}]" if unit else name for name, unit in UNITS.items()]  # of a CSV file
SLIDER = ss.Slider(ss.Coulomb(mu=0.05), period=3, damping_ratio=0.1)


@pytest.fixture(
    params=[
        ss.GroundMotion([0, 3, -4, 2, 0.1], dt=0.3, name="shaking"),
        ss.GroundMotion([0, 3, -4, 2, 0.1], times=[0, 0.3, 0.5, 1, 2]),
        ss.HarmonicMotion(2, 3, 4),
    ],
    ids=["even", "uneven", "harmonic"],
)
def response(request):
    return ss.integrate(SLIDER, request.param, settle=True)


def histories(r):
    """What the columns must hold, in order."""
    ground = np.zeros(r.time.size)
    ground[: r.motion.time.size] = r.motion.acceleration
    named = ("displacement", "velocity", "acceleration", "friction", "spring", "damper", "force")
    return [ground, *(getattr(r, name) for name in named), r.stuck]


def test_a_data_frame_has_every_history_and_its_unit(response):
    pandas = pytest.importorskip("pandas")
    frame = response.to_dataframe()
    assert isinstance(frame, pandas.DataFrame)
    assert frame.index.name == "time"
    assert np.array_equal(frame.index, response.time)
    assert list(frame.columns) == list(UNITS)
    assert all(name.isidentifier() for name in frame.columns)
    assert frame.attrs["units"] == {"time": "s"} | {n: u for n, u in UNITS.items() if u}
    for name, history in zip(UNITS, histories(response), strict=True):
        assert np.array_equal(frame[name], history), name
    assert frame["stuck"].dtype == bool
    assert frame.displacement.abs().max() <= response.peak
    assert len(frame.query("velocity != 0")) == (response.velocity != 0).sum()
    frame["mine"] = frame.force * 2  # a table of one's own
    frame.loc[frame.index[0], "displacement"] = 5.0
    assert response.displacement[0] == 0


def test_a_dataset_has_every_history_with_its_unit(response):
    xarray = pytest.importorskip("xarray")
    data = response.to_xarray()
    assert isinstance(data, xarray.Dataset)
    assert np.array_equal(data["time"], response.time)
    assert data["time"].attrs["units"] == "s"
    for (name, unit), history in zip(UNITS.items(), histories(response), strict=True):
        variable = data[name]
        assert variable.dims == ("time",)
        assert np.array_equal(variable, history), name
        assert variable.attrs.get("units", "") == unit
        assert variable.attrs["long_name"]
    assert data.attrs["peak"] == response.peak
    assert data.attrs["residual"] == response.residual
    assert data.attrs["peak_units"] == data.attrs["residual_units"] == "m"
    assert data.attrs["motion"] == response.motion.name
    assert eval(data.attrs["slider"], vars(ss)) == response.slider
    # positions by time, as xarray's users ask
    at = float(data["displacement"].interp(time=0.15))
    assert at == pytest.approx(np.interp(0.15, response.time, response.displacement))


def test_a_file_reads_back_to_the_bit(response, tmp_path):
    pandas = pytest.importorskip("pandas")
    path = tmp_path / "r.csv"
    assert response.to_csv(path) == path
    frame = pandas.read_csv(path, index_col=0)
    assert frame.index.name == "time [s]"
    assert list(frame.columns) == HEADS
    # a reader that may round, by a unit of the last digit; NumPy's does not
    assert frame["displacement [m]"].to_numpy() == pytest.approx(response.displacement, rel=5e-16)
    table = np.loadtxt(path, delimiter=",", skiprows=1)
    assert np.array_equal(table[:, 0], response.time)
    for column, history in zip(table.T[1:], histories(response), strict=True):
        assert np.array_equal(column, history)
    assert set(table[:, -1]) <= {0, 1}


def test_texts_in_a_file_are_quoted_where_they_must_be(tmp_path):
    names = ["plain", "a, b", 'say "no"', "two\nlines", ""]
    columns = {
        "record": Repeated(np.array(names), np.array([0, 1, 2, 3, 4, 1])),
        "event": np.array([*names, "é"]),
        "peak": np.array([0.1, 1e300, -0.0, np.inf, np.nan, 5e-324]),
        "sliding": np.array([True, False] * 3),
    }
    path = write_csv(columns, {"peak": "m"}, tmp_path / "t.csv")
    head, *rows = csv.reader(io.StringIO(path.read_text(), newline=""))
    assert head == ["record", "event", "peak [m]", "sliding"]
    record, event, peak, sliding = zip(*rows)
    assert list(record) == [*names, "a, b"]
    assert list(event) == [*names, "é"]
    assert np.array_equal([float(p) for p in peak], columns["peak"], equal_nan=True)
    assert sliding == ("1", "0") * 3


def test_a_long_file_has_all_its_lines(tmp_path):
    r = ss.integrate(SLIDER, ss.GroundMotion(np.sin(np.arange(10_001)), dt=0.01))
    r.to_csv(str(tmp_path / "r.csv"))
    table = np.loadtxt(tmp_path / "r.csv", delimiter=",", skiprows=1)
    assert np.array_equal(table[:, 0], r.time)
    assert np.array_equal(table[:, 8], r.force)


def test_a_file_is_written_whole_or_not_at_all(response, tmp_path, monkeypatch):
    path = tmp_path / "r.csv"
    path.write_text("what was there")
    with pytest.raises(FileNotFoundError, match="nowhere"):
        response.to_csv(tmp_path / "nowhere" / "r.csv")

    def fill_the_disk(descriptor):
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(os, "fsync", fill_the_disk)
    with pytest.raises(OSError, match="No space left"):
        response.to_csv(path)
    assert path.read_text() == "what was there"
    assert list(tmp_path.iterdir()) == [path]


def test_a_number_is_no_path_though_it_is_that_of_an_open_file(response, tmp_path):
    quake = ss.GroundMotion([0, 3, 0], dt=0.1)
    table = ss.sweep(ss.Coulomb(mu=0.1), [quake])
    with (tmp_path / "open").open("w+b") as stream:
        stream.write(b"mine")
        stream.flush()
        for thing in (response, quake, table):
            for number in (stream.fileno(), 0.5, None):
                with pytest.raises(TypeError, match=f"must be given as a path, got {number}"):
                    thing.to_csv(number)
        stream.seek(0)
        assert stream.read() == b"mine"
    assert table.to_csv(os.fsencode(tmp_path / "t.csv")) == tmp_path / "t.csv"


# ---- notebooks

NAME = "<script>alert('$')</script> & \x1b"


def cells(page):
    """Rows of the tables, as text; fails where the markup is not well-formed."""
    root = xml.etree.ElementTree.parse(io.StringIO(f"<div>{page}</div>")).getroot()
    assert not root.findall(".//script")
    for address in ("http", "src=", "href="):
        assert address not in page
    return {row[0].text: [cell.text for cell in row[1:]] for row in root.iter("tr") if len(row) > 1}


def test_a_response_shows_its_numbers_with_units_in_a_notebook():
    quake = ss.GroundMotion([0, 3, -4, 2, 0.1], dt=0.3, name=NAME)
    r = ss.integrate(SLIDER, quake, settle=True)
    shown = cells(r._repr_html_())
    assert shown["ground motion"] == [NAME.replace("\x1b", r"\x1b")]
    assert eval(shown["slider"][0], vars(ss)) == SLIDER
    assert shown["peak displacement"] == [f"{r.peak:.4g} m"]
    assert shown["residual displacement"] == [f"{r.residual:.4g} m"]
    assert shown["time sliding"] == [f"{r.time_sliding:.4g} s"]
    assert shown["effective period"] == [f"{r.effective_period:.4g} s"]
    assert shown["dissipated by the damper"] == [f"{r.energy.damped:.4g} m²/s²"]
    moving = cells(ss.integrate(SLIDER.law, ss.GroundMotion([0, 3], dt=0.3))._repr_html_())
    assert "displacement at the end, sliding" in moving
    assert "effective period" not in moving


def test_an_ensemble_shows_quantiles_with_bounds_in_a_notebook():
    pulses = ss.PoissonPulses.event("moderate near field")
    e = ss.run_ensemble(ss.Coulomb(mu=0.02), pulses, members=500, seed=7)
    shown = cells(e._repr_html_())
    assert (shown["members"], shown["seed"]) == (["500"], ["7"])
    median = e.quantile(0.5)
    text = f"{median.value:.4g} m (95 % confidence: {median.low:.3g} to {median.high:.3g})"
    assert shown["peak displacement, median"] == [text]
    assert shown["growth of the variance of x"][0].endswith("m²/s")
    alone = cells(ss.run_ensemble(ss.Coulomb(mu=0.02), pulses, members=1, seed=7)._repr_html_())
    assert alone["members"] == ["1"]
    suite = [ss.GroundMotion([0, 2, -2], dt=dt) for dt in (0.1, 0.2)]
    shown = cells(ss.run_ensemble(ss.Coulomb(mu=0.02), suite, members=9, seed=7)._repr_html_())
    assert "growth of the variance of x" not in shown


def test_a_comparison_shows_theory_over_simulation_in_a_notebook():
    pulses = ss.PoissonPulses(rate=3, half_width=1 / 6, sigma=2.5, duration=6)
    c = ss.compare(ss.Coulomb(slip_level=0.5), pulses, [2, 4], members=640)
    shown = cells(c._repr_html_())
    assert shown["time"] == ["2 s", "4 s"]
    ratio, _ = c.ratio("PulseChain", "velocity_variance")
    assert shown["PulseChain / simulation"] == [f"{r:.3f}" for r in ratio]
    value, error = c.simulated("velocity_variance")
    assert shown["simulation [m²/s²]"] == [f"{v:.4g} ± {e:.1g}" for v, e in zip(value, error)]
    for name, why in c.refused.items():
        assert shown[name] == [why]


def test_a_sweep_shows_its_first_rows_in_a_notebook():
    quakes = [ss.GroundMotion([0, 3 + i, 0], dt=0.5, name=f"<{i}>") for i in range(6)]
    table = ss.sweep(ss.grid(ss.Coulomb, mu=[0.1, 0.2]), quakes, settle=True)
    page = xml.etree.ElementTree.fromstring(table._repr_html_())
    assert page.findtext("caption") == "SweepTable: 24 rows, the first 20"
    head, *rows = ([cell.text for cell in row] for row in page.iter("tr"))
    assert head[:6] == ["slider", "mu", "record", "polarity", "peak [m]", "residual [m]"]
    assert [row[2] for row in rows[:12:2]] == [f"<{i}>" for i in range(6)]
    peaks = np.array([row[4] for row in rows], float)
    assert peaks == pytest.approx(table.peak.ravel()[:20], rel=1e-3)


def test_json_has_every_number_and_no_nan(response):
    document = json.loads(response.to_json(), parse_constant=pytest.fail)
    assert document["peak"] == response.peak
    assert document["residual"] == response.residual
    assert document["slider"] == repr(response.slider)
    assert document["time"] == response.time.tolist()
    for name, values in zip(UNITS, histories(response), strict=True):
        assert document[name] == np.asarray(values).tolist(), name
        assert document["units"].get(name, "") == UNITS[name]
    assert [one["time"] for one in document["events"]] == response.events["time"].tolist()
    assert [one["kind"] for one in document["events"]] == response.events["kind"].tolist()


def test_numbers_are_written_as_repr_does():
    # A double may need 1 to 17 digits, with the point or the exponent anywhere.
    rng = np.random.default_rng(1)
    bits = rng.integers(0, 2**64, 20_000, dtype=np.uint64).view(np.float64)
    decimal = rng.integers(1, 10**6, 2000) * 10.0 ** rng.integers(-12, 20, 2000)
    edges = [0.0, -0.0, 1e-4, 9.999e-5, 1e16, 9999999999999998.0, 5e-324, 1.7976931348623157e308]
    for values in (bits, decimal, np.array([*edges, np.inf, -np.inf, np.nan])):
        assert number_texts(values) == [repr(value) for value in values.tolist()]
    finite = bits[np.isfinite(bits)]
    assert json.loads(number_list(finite)) == finite.tolist()
    assert number_list(finite[::2][:2]) == f"[{finite[0].item()!r}, {finite[2].item()!r}]"


def test_json_of_arrays_in_lists_of_any_depth():
    document = {
        "rows": [{"at": np.array([1.0, np.nan]), "n": 1}, {"at": (np.inf, None), "n": True}],
        "table": np.array([[0.1, -np.inf], [1e-7, 2.0]]),
        "whole": np.arange(3),
        "names": np.array(["a", 'b"']),
    }
    assert json.loads(json_text(document)) == {
        "rows": [{"at": [1.0, None], "n": 1}, {"at": [None, None], "n": True}],
        "table": [[0.1, None], [1e-7, 2.0]],
        "whole": [0, 1, 2],
        "names": ["a", 'b"'],
    }
    with pytest.raises(TypeError, match="not JSON serializable"):
        json_text({"a": [object()]})
