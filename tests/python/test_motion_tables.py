"""Tables of ground motions, intensity measures and spectra; reprs with the digits people read."""

import csv
import json
import re
import xml.etree.ElementTree

import numpy as np
import pytest
import stickslip as ss

G = ss.STANDARD_GRAVITY
RANDOM = np.random.default_rng(5)
NOISE = RANDOM.standard_normal(300)
UNEVEN = np.cumsum(0.01 + 0.02 * RANDOM.random(300))


def motions():
    """Motions whose files must read back: even and uneven times, one and several components."""
    for dt in (0.01, 0.005, 1 / 128, 0.02, 1 / 3):
        yield pytest.param(ss.GroundMotion(NOISE, dt=dt), id=f"dt {dt:.4g}")
    yield pytest.param(ss.GroundMotion(NOISE, times=UNEVEN), id="uneven")
    yield pytest.param(ss.GroundMotion(0.01 * NOISE, dt=0.01), id="small")
    both = {"transverse": NOISE[::-1], "vertical": NOISE / 3}
    yield pytest.param(ss.GroundMotion(NOISE, dt=0.01, **both), id="three")


@pytest.mark.filterwarnings("ignore::stickslip.PlausibilityWarning")
@pytest.mark.parametrize("motion", list(motions()))
def test_a_motion_reads_back_from_its_file(motion, tmp_path):
    file = motion.to_csv(tmp_path / "mine.csv")
    assert file == tmp_path / "mine.csv"
    components = ss.read_record(file, component="all")
    samples = [motion.acceleration, motion.transverse, motion.vertical]
    samples = [one for one in samples if one is not None]
    if len(samples) == 1:
        components = [ss.read_record(file)]
    assert len(components) == len(samples)
    for component, expected in zip(components, samples):
        assert np.array_equal(component.acceleration, expected)
        assert component.interpolation == "linear"
        if motion.dt is None:
            assert np.array_equal(component.time, motion.time)
        else:
            assert component.dt == pytest.approx(motion.dt, rel=1e-14)


def test_an_array_of_a_motion_is_its_acceleration():
    motion = ss.GroundMotion([0.1, 2.0, 3.0], dt=0.5)
    array = np.asarray(motion)
    assert array.dtype == np.float64 and np.array_equal(array, motion.acceleration)
    assert np.shares_memory(array, motion.acceleration) and not array.flags.writeable
    copied = np.array(motion)
    assert copied.flags.writeable and not np.shares_memory(copied, motion.acceleration)
    assert np.asarray(motion, np.float32).dtype == np.float32
    assert np.abs(np.asarray(motion)).max() == motion.peak_acceleration
    # A number times a motion is still a motion, not an array.
    assert isinstance(np.float64(2) * motion, ss.GroundMotion)
    with pytest.raises(TypeError, match=r"must be a slice, .*a sample is motion.acceleration\[i\]"):
        motion[0]


@pytest.fixture(scope="module")
def record(pyslammer_files):
    return ss.read_record(next(f for f in pyslammer_files if f.name.startswith("Kobe")))


def read_csv(file):
    """Heads and numbers, each number as Python reads it."""
    heads, *rows = csv.reader(file.read_text(encoding="utf-8").splitlines())
    return heads, np.array([[float(cell) for cell in row] for row in rows])


def test_intensity_measures_become_tables(record, tmp_path):
    pytest.importorskip("pandas")
    measures = ss.strong_motion(record)
    frame = measures.to_dataframe()
    assert len(frame) == 1
    public = [n for n in dir(measures) if not n.startswith("_") and not n.startswith("to_")]
    assert sorted(frame.columns) == sorted(public) == sorted(frame.attrs["units"])
    for name in public:
        assert frame[name][0] == getattr(measures, name)
    heads, rows = read_csv(measures.to_csv(tmp_path / "m.csv"))
    assert heads[0] == "peak_acceleration [m/s^2]"
    assert np.array_equal(rows, frame.to_numpy())
    document = json.loads(measures.to_json())
    assert document["units"]["arias_intensity"] == "m/s"
    assert document["arias_intensity"] == measures.arias_intensity


@pytest.mark.parametrize("damping", [0.05, [0.02, 0.05, 0.1]])
@pytest.mark.parametrize("kind, unit", [("pseudo_acceleration", "m/s^2"), ("displacement", "m")])
def test_a_spectrum_becomes_tables(record, damping, kind, unit, tmp_path):
    pytest.importorskip("pandas")
    spectrum = ss.response_spectrum(record, [0.2, 1.0, 3.0], damping, kind=kind)
    frame = spectrum.to_dataframe()
    assert list(frame.columns) == ["period", "damping", kind]
    assert frame.attrs["units"] == {"period": "s", kind: unit}
    for (_, group), values in zip(frame.groupby("damping"), np.atleast_2d(spectrum.values)):
        assert np.array_equal(group.period, spectrum.periods)
        assert np.array_equal(group[kind], values)
    heads, rows = read_csv(spectrum.to_csv(tmp_path / "s.csv"))
    assert heads == ["period [s]", "damping", f"{kind} [{unit}]"]
    assert np.array_equal(rows, frame.to_numpy())
    document = json.loads(spectrum.to_json())
    assert np.array_equal(document["values"], np.atleast_2d(spectrum.values))
    assert document["units"]["values"] == unit


# ---- reprs


def numbers(text):
    return re.findall(r"-?\d[\d.]*(?:e[+-]?\d+)?", text)


def significant(number):
    return len(number.partition("e")[0].replace(".", "").lstrip("-0"))


def test_reprs_have_the_digits_that_a_person_reads(record):
    r = ss.integrate(ss.Coulomb(mu=0.1), record, settle=True)
    measures = ss.strong_motion(record)
    for shown in (r, r.energy, r.sensitivity("mu"), measures):
        text = repr(shown)
        assert numbers(text), text
        assert all(significant(number) <= 5 for number in numbers(text)), text
    assert f"peak {r.peak:.4g} m" in repr(r)
    assert f"dissipated {r.energy.dissipated:.4g}" in repr(r.energy)
    assert f"PGA {measures.peak_acceleration:.4g} m/s^2" in repr(measures)
    assert f"({measures.peak_acceleration / G:.4g} g)" in repr(measures)
    assert f"PGV {measures.peak_velocity:.4g} m/s" in repr(measures)
    assert f"Arias intensity {measures.arias_intensity:.4g} m/s" in repr(measures)
    small = ss.response_spectrum(record.scaled(1e-8), [1.0], kind="displacement")
    assert f"largest {small.values[0]:.4g} m" in repr(small)


def test_a_notebook_shows_a_table(record):
    r = ss.integrate(ss.Coulomb(mu=0.1), record, settle=True)
    interval = ss.run_ensemble(
        ss.Coulomb(mu=0.1), ss.PoissonPulses.event("great near field"), members=200, seed=1
    ).quantile(0.5)
    shown = [
        (record, f"{record.peak_acceleration / G:.4g} g"),
        (ss.strong_motion(record), "Arias intensity"),
        (interval, f"{interval.low:.4g} to {interval.high:.4g}"),
        (r.energy, f"{r.energy.dissipated:.4g} m"),
        (ss.response_spectrum(record, [0.5, 1.0], [0.02, 0.05]), "pseudo-acceleration, 2 periods"),
        (ss.interfaces(), "PTFE bearing"),
        (ss.record_formats(), "PEER"),
    ]
    for one, words in shown:
        html = one._repr_html_()
        xml.etree.ElementTree.fromstring(html)
        assert words in html


def test_a_name_of_a_motion_is_escaped():
    html = ss.GroundMotion([0.0, 1.0], dt=0.1, name="<b>\x1b</b>")._repr_html_()
    assert "&lt;b&gt;\\x1b&lt;/b&gt;" in html


@pytest.mark.parametrize("rows", [ss.interfaces, ss.record_formats])
def test_a_list_of_rows_prints_as_a_table(rows):
    table = rows()
    assert isinstance(table, list) and isinstance(table[0], dict)
    lines = repr(table).splitlines()
    assert len(lines) > len(table)
    assert max(map(len, lines)) < 180
    for key in table[0]:
        assert key.replace("_", " ") in lines[0]
    column = lines[0].index(list(table[0])[1].replace("_", " "))
    assert all(line[column - 2 : column].strip() == "" for line in lines)
    assert type(table)() == []
    assert repr(type(table)()) == "[]"
