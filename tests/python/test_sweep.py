"""Sweeps and their tables; C++ tests each combination against `integrate`."""

import csv
import json
import math
import pickle
import subprocess
import sys
import threading
import warnings
from concurrent.futures import Future, ProcessPoolExecutor

import numpy as np
import pytest
import stickslip as ss
from clusters import losing_a_worker
from stickslip import cli

RNG = np.random.default_rng(20)


def quake(seed: int, samples: int = 800) -> ss.GroundMotion:
    n = np.random.default_rng(seed).normal(0, 3, samples)
    t = np.arange(samples) / samples
    n *= t * (1 - t) * 4
    return ss.GroundMotion(n - n.mean(), dt=0.02, name=f"quake {seed}")


QUAKES = ss.Suite([quake(i) for i in range(6)], {"magnitude": [5, 5.5, 6, 6.5, 7, 7.5]})
MU = [0.05, 0.1, 0.2, 0.4]


def test_each_combination_is_what_integrate_says():
    sliders = [
        ss.Coulomb(mu=0.1),
        ss.Coulomb(mu=0.1, backward=math.inf),
        ss.Slider(ss.Coulomb(mu=0.05), period=2),
        ss.VelocityDependent(mu_slow=0.05, mu_fast=0.1, rate=50),
        ss.Degrading(distance=[0, 0.2], mu=[0.1, 0.05]),
    ]
    table = ss.sweep(sliders, QUAKES, settle=True)
    assert table.peak.shape == (5, 6, 2)
    for s, slider in enumerate(sliders):
        for r, motion in enumerate(QUAKES):
            for p, sign in enumerate((1, -1)):
                one = ss.integrate(slider, motion * sign, settle=True)
                allowed = 1e-12 * (1 + one.sliding_distance)
                assert table.peak[s, r, p] == pytest.approx(one.peak, abs=allowed)
                assert table.residual[s, r, p] == pytest.approx(one.residual, abs=allowed)
                assert table.sliding_distance[s, r, p] == pytest.approx(
                    one.sliding_distance, abs=allowed
                )
                assert table.events[s, r, p] == len(one.events) - 1


def test_one_slider_one_motion_and_one_polarity_make_a_table_of_one():
    table = ss.sweep(ss.Coulomb(mu=0.1), QUAKES[0], polarity="reversed")
    assert table.peak.shape == (1, 1, 1)
    assert table.polarity == ("reversed",)
    assert table.residual[0, 0, 0] == pytest.approx(
        ss.integrate(ss.Coulomb(mu=0.1), -QUAKES[0]).residual, rel=1e-12
    )


def test_a_grid_has_each_combination_and_knows_its_parameters():
    floors = ss.grid(ss.Slider, law=ss.grid(ss.Coulomb, mu=[0.05, 0.1]), period=[2.0, 3.0, 4.0])
    assert len(floors) == 6
    assert floors[4] == ss.Slider(ss.Coulomb(mu=0.1), period=3)
    assert floors.parameters == {
        "mu": [0.05, 0.05, 0.05, 0.1, 0.1, 0.1],
        "period": [2, 3, 4, 2, 3, 4],
    }
    assert pickle.loads(pickle.dumps(floors)).parameters == floors.parameters
    with pytest.raises(ValueError, match=r"grid: with \{'mu': -0.1\}: .* got -0.1"):
        ss.grid(ss.Coulomb, mu=[0.1, -0.1])
    with pytest.raises(ValueError, match="mu must have at least one value"):
        ss.grid(ss.Coulomb, mu=[])


def test_a_failed_combination_is_nan_and_told_once_and_ends_nothing():
    sliders = [ss.Coulomb(mu=0.1), ss.Slider(ss.Coulomb(mu=0), period=1)]
    with pytest.warns(RuntimeWarning, match="12 of 24 combinations failed.*slider 1 under"):
        table = ss.sweep(sliders, QUAKES, settle=True)
    assert np.isfinite(table.peak[0]).all()
    assert np.isnan(table.peak[1]).all()
    assert len(table.failures) == 12
    assert "does not come to rest" in table.failures[0].message
    assert np.isnan(table.quantile(0.5)[1])


@pytest.mark.parametrize(
    "arguments, error",
    [
        (([], QUAKES), "needs at least one slider, got an empty list"),
        ((ss.Coulomb(mu=0.1), []), "needs at least one ground motion, got an empty list"),
    ],
)
def test_nothing_to_sweep_is_refused(arguments, error):
    with pytest.raises(ValueError, match=error):
        ss.sweep(*arguments)


def test_what_is_no_slider_motion_or_option_is_refused_by_name():
    one = ss.Coulomb(mu=0.1)
    with pytest.raises(
        TypeError,
        match=r"sliders\[1\] must be a Slider, friction law, PlanarSlider or structure, got int",
    ):
        ss.sweep([one, 3], QUAKES)
    with pytest.raises(TypeError, match=r"motions\[0\] must be a GroundMotion, got str"):
        ss.sweep(one, "kobe.AT2")
    with pytest.raises(
        ValueError, match=r"polarity must be 'recorded', 'reversed' or 'both', got 'up'"
    ):
        ss.sweep(one, QUAKES, polarity="up")
    with pytest.raises(ValueError, match="threads must be from 1 to 65536, got 0"):
        ss.sweep(one, QUAKES, threads=0)
    with pytest.raises(ValueError, match="give threads or executor"):
        ss.sweep(one, QUAKES, threads=1, executor=ProcessPoolExecutor())
    with pytest.raises(TypeError, match="executor must be"):
        ss.sweep(one, QUAKES, executor=3)


def test_the_interpreter_goes_on_and_progress_is_told():
    told = []
    table = ss.sweep(ss.grid(ss.Coulomb, mu=MU), QUAKES, progress=lambda *p: told.append(p))
    assert told[-1] == (48, 48)
    assert table.done.all()


def test_a_sweep_can_be_interrupted_by_its_progress():
    class Enough(Exception): ...

    def stop(done, total):
        raise Enough

    casters = [ss.Caster(mu=0.1, reach=0.05)] * 500
    began = threading.active_count()
    with pytest.raises(Enough):
        ss.sweep(casters, QUAKES, progress=stop)
    assert threading.active_count() == began


def test_the_table_goes_to_frames_files_and_back(tmp_path):
    table = ss.sweep(ss.grid(ss.Coulomb, mu=MU), QUAKES)
    frame = table.to_dataframe()
    assert len(frame) == 48
    row = frame[(frame.mu == 0.1) & (frame.magnitude == 6.5) & (frame.polarity == "reversed")]
    assert row.peak.item() == table.peak[1, 3, 1]
    assert frame.attrs["units"] == dict.fromkeys(("peak", "residual", "sliding_distance"), "m")
    texts = [name for name, kind in frame.dtypes.items() if kind == "category"]
    assert texts == ["slider", "record", "polarity"]
    assert frame.record.tolist() == [name for name in QUAKES.names for _ in (0, 1)] * 4
    assert len(frame.query("peak > 0.01 and mu < 0.3")) == (table.peak[:3] > 0.01).sum()
    data = table.to_xarray()
    assert data.peak.sel(polarity="reversed").values == pytest.approx(table.peak[:, :, 1], rel=0)
    assert data.magnitude.values.tolist() == QUAKES.magnitude.tolist()
    assert ss.SweepTable.open(table.save(tmp_path / "t.h5")) == table
    assert table != ss.sweep(ss.grid(ss.Coulomb, mu=MU), QUAKES, settle=True)


def test_a_table_goes_to_json_and_back():
    sliders = [ss.Coulomb(mu=0.1), ss.Slider(ss.Coulomb(mu=0), period=1)]
    with pytest.warns(RuntimeWarning, match="combinations failed"):
        failed = ss.sweep(sliders, QUAKES, settle=True)
    known = QUAKES.with_metadata({"depth": [1.0, math.nan, 3, 4, 5, 6], "event": [*"abcdef"]})
    whole = ss.sweep(ss.grid(ss.Coulomb, mu=MU, backward=[2.0, math.inf]), known)
    assert np.isinf(whole.parameters["backward"]).any()
    for table in (failed, whole):
        text = table.to_json()
        assert ss.SweepTable.from_json(text) == table
        document = json.loads(text, parse_constant=pytest.fail)  # NaN and Infinity are no JSON
        for name in ("peak", "residual", "sliding_distance"):
            values = np.array(document[name], float)  # of null NaN
            assert np.array_equal(values, getattr(table, name), equal_nan=True)
            assert document["units"][name] == "m"
    document = json.loads(failed.to_json())
    (place, *_) = np.argwhere(np.isnan(failed.peak)).tolist()
    i, j, k = place
    assert document["peak"][i][j][k] is None
    assert document["failures"][0]["message"] == failed.failures[0].message
    assert json.loads(whole.to_json())["metadata"]["depth"][1] is None
    assert "Infinity" in json.loads(whole.to_json())["parameters"]["backward"]


@pytest.mark.parametrize(
    "change, message",
    [
        (lambda text: text[:-5], "needs a JSON document"),
        (lambda text: "[1, 2]", "must be of format 'stickslip sweep table 1', got None"),
        (lambda text: text.replace("table 1", "table 0"), "got 'stickslip sweep table 0'"),
        (lambda text: text.replace('"peak": [', '"top": ['), "lacks 'peak'"),
        (lambda text: text.replace('"peak": [[', '"peak": [[],['), "damaged"),
    ],
)
def test_json_that_is_no_table_is_refused(change, message):
    text = ss.sweep(ss.Coulomb(mu=0.1), QUAKES[:2]).to_json()
    with pytest.raises(ValueError, match=f"SweepTable.from_json: .*{message}"):
        ss.SweepTable.from_json(change(text))


def test_a_file_that_is_no_table_is_refused(tmp_path):
    (tmp_path / "x.h5").write_text("no table")
    with pytest.raises(ValueError, match="is not an HDF5 file, or is damaged"):
        ss.SweepTable.open(tmp_path / "x.h5")
    QUAKES.save(tmp_path / "s.h5")
    with pytest.raises(ValueError, match="must be of format 'stickslip sweep table 1', got"):
        ss.SweepTable.open(tmp_path / "s.h5")
    with pytest.raises(FileNotFoundError):
        ss.SweepTable.open(tmp_path / "none.h5")


def test_quantiles_are_those_of_all_histories():
    table = ss.sweep(ss.grid(ss.Coulomb, mu=MU), QUAKES)
    expected = np.quantile(table.peak.reshape(4, -1), [0.16, 0.5], axis=1)
    assert np.array_equal(table.quantile([0.16, 0.5]), expected)
    assert table.quantile(0.5, "residual") == pytest.approx(
        np.median(np.abs(table.residual).reshape(4, -1), axis=1), rel=1e-15
    )


def test_a_table_draws_records_thin_and_their_median():
    pytest.importorskip("matplotlib")
    table = ss.sweep(ss.grid(ss.Coulomb, mu=MU), QUAKES)
    (axes,) = table.plot().axes
    lines = axes.get_lines()
    assert len(lines) == 13  # 12 histories and the median
    assert lines[-1].get_ydata() == pytest.approx(100 * table.quantile(0.5), rel=1e-12)
    assert table.plot("residual").axes
    floors = ss.grid(ss.Slider, law=ss.grid(ss.Coulomb, mu=MU), period=[2, 3])
    both = ss.sweep(floors, QUAKES[:2])
    assert len(both.plot(against="mu").axes[0].get_lines()) == 2
    with pytest.raises(ValueError, match="against must be one of mu, period, got 'law'"):
        both.plot(against="law")


def test_many_histories_are_drawn_as_bands():
    pytest.importorskip("matplotlib")
    many = ss.sweep(ss.grid(ss.Coulomb, mu=MU), [quake(i, 50) for i in range(101)])
    (axes,) = many.plot().axes
    (median,) = axes.get_lines()
    assert median.get_ydata() == pytest.approx(100 * many.quantile(0.5), rel=1e-12)
    outer, inner = (band.get_paths()[0].vertices[:, 1] for band in axes.collections)
    for band, ends in ((outer, (0.05, 0.95)), (inner, (0.16, 0.84))):
        low, high = 100 * many.quantile(ends)
        assert {*np.round(low, 9), *np.round(high, 9)} <= {*np.round(band, 9)}
    labels = [text.get_text() for text in axes.get_legend().get_texts()]
    assert labels == ["5 to 95 %", "16 to 84 %", "median of 202 histories"]


def test_a_list_of_sliders_is_drawn_by_place():
    pytest.importorskip("matplotlib")
    sliders = [ss.Slider(ss.Coulomb(mu=0.1), period=2), ss.Coulomb(mu=0.1, backward=math.inf)]
    (axes,) = ss.sweep(sliders, QUAKES).plot("residual").axes
    assert [" ".join(tick.get_text().split()) for tick in axes.get_xticklabels()] == [
        "Slider(Coulomb(mu=0.1), natural_frequency=3.142)",
        "Coulomb(mu=0.1, backward=float('inf'))",
    ]
    (axes,) = ss.sweep([sliders[0]] * 20, QUAKES).plot().axes
    assert axes.get_xlabel() == "slider, by its place in the list"


def test_polarities_that_are_the_same_are_one_line():
    pytest.importorskip("matplotlib")
    (axes,) = ss.sliding_spectrum(QUAKES[5], MU, period=[1, 2, math.inf]).plot().axes
    labels = [text.get_text() for text in axes.get_legend().get_texts()]
    assert labels == [f"period = {p}, recorded and reversed" for p in ("1", "2", "inf")]
    assert len(axes.get_lines()) == 3
    (axes,) = ss.sliding_spectrum(QUAKES[5], MU, one_way=True).plot().axes
    labels = [text.get_text() for text in axes.get_legend().get_texts()]
    assert labels == ["recorded", "reversed"]


def test_a_grid_has_an_axis_for_each_parameter_in_xarray():
    pytest.importorskip("xarray")
    floors = ss.grid(ss.Slider, law=ss.grid(ss.Coulomb, mu=MU), period=[2, 3])
    table = ss.sweep(floors, QUAKES)
    data = table.to_xarray()
    assert data.peak.dims == ("mu", "period", "record", "polarity")
    for i, (mu, period) in enumerate(zip(*table.parameters.values())):
        there = data.sel(mu=mu, period=period)
        assert np.array_equal(there.peak, table.peak[i])
        assert there.slider.item() == table.sliders[i]
    assert data.peak.sel(mu=0.11, method="nearest").mu == 0.1
    assert "slider" in ss.sweep([*floors[:3], *floors[5:]], QUAKES).to_xarray().dims


@pytest.mark.slow
@pytest.mark.parametrize("engine, package", [("h5netcdf", "h5netcdf"), ("netcdf4", "netCDF4")])
def test_a_saved_table_is_a_netcdf_file(tmp_path, engine, package):
    xarray = pytest.importorskip("xarray")
    pytest.importorskip(package)
    floors = ss.grid(ss.Slider, law=ss.grid(ss.Coulomb, mu=MU), period=[2, 3])
    table = ss.sweep(floors, QUAKES)
    file = table.save(tmp_path / "t.h5")
    with xarray.open_dataset(file, engine=engine) as stored:
        assert stored.peak.dims == ("slider", "record", "polarity")
        assert np.array_equal(stored.peak, table.peak)
        assert stored.peak.attrs["units"] == "m"
        assert stored.coords["mu"].dims == ("slider",)
        assert stored.record.values.tolist() == list(QUAKES.names)
        assert stored.polarity.values.tolist() == ["recorded", "reversed"]
        assert np.array_equal(stored.coords["magnitude"], QUAKES.magnitude)


def test_columns_with_the_names_of_results_are_kept(tmp_path):
    pytest.importorskip("h5py")
    pytest.importorskip("pandas")
    suite = QUAKES.with_metadata({"peak": np.arange(6), "depth/km": np.arange(6.0)})
    table = ss.sweep(ss.Coulomb(mu=0.1), suite)
    frame = table.to_dataframe()
    assert frame.peak_.tolist() == np.arange(6).repeat(2).tolist()
    assert np.array_equal(frame.peak, table.peak.ravel())
    again = ss.SweepTable.open(table.save(tmp_path / "t.h5"))
    assert again == table
    assert list(again.metadata) == list(table.metadata)


def test_damage_to_a_saved_table_is_found(tmp_path):
    pytest.importorskip("h5py")
    table = ss.sweep(ss.grid(ss.Coulomb, mu=MU), QUAKES)
    file = table.save(tmp_path / "t.h5")
    whole = file.read_bytes()
    place = whole.index(table.peak.tobytes())
    for offset in (0, 7, table.peak.nbytes - 1):
        damaged = bytearray(whole)
        damaged[place + offset] ^= 1
        file.write_bytes(damaged)
        with pytest.raises(ValueError, match=r"SweepTable.open: .* is damaged"):
            ss.SweepTable.open(file)


def test_a_law_of_a_lambda_names_the_remedy_for_processes():
    law = ss.Law(resist=lambda x, speed, direction: 1.0)
    with ProcessPoolExecutor(1) as pool:
        with pytest.raises(ss.SweepError, match="define the functions of laws in a module"):
            ss.sweep(law, QUAKES[:1], executor=pool)
        with pytest.raises(ss.EnsembleError, match="define the functions of laws in a module"):
            ss.run_ensemble(law, QUAKES[0], members=2, seed=1, executor=pool)


def test_a_sliding_spectrum_is_a_sweep_of_one_record():
    table = ss.sliding_spectrum(QUAKES[5], MU)
    assert table.settle
    assert table.parameters["mu"].tolist() == MU
    assert table.peak[2, 0, 0] == pytest.approx(
        ss.integrate(ss.Coulomb(mu=0.2), QUAKES[5], settle=True).peak, rel=1e-12
    )
    one_way = ss.sliding_spectrum(QUAKES[5], MU, one_way=True)
    assert (one_way.residual == one_way.peak).all()
    sprung = ss.sliding_spectrum(QUAKES[5], MU, period=[1, math.inf])
    assert sprung.peak.shape == (8, 1, 2)
    assert sprung.peak[1::2, 0] == pytest.approx(table.peak[:, 0], rel=1e-12)


class Refusing:
    """An executor that fails after some parts."""

    def __init__(self, good):
        self.good = good

    def submit(self, function, *arguments):
        future: Future = Future()
        self.good -= 1
        if self.good >= 0:
            future.set_result(function(*arguments))
        else:
            future.set_exception(OSError("the node is gone"))
        return future


def test_processes_find_the_same_bits():
    sliders = ss.grid(ss.Coulomb, mu=MU)
    with ProcessPoolExecutor(2) as pool:
        assert ss.sweep(sliders, QUAKES, executor=pool) == ss.sweep(sliders, QUAKES)


@pytest.mark.slow
def test_a_cluster_one_worker_of_which_is_killed_finds_the_same_bits():
    sliders = ss.grid(ss.Slider, law=ss.grid(ss.Coulomb, mu=np.linspace(0.01, 0.3, 40)), period=2)
    quakes = [quake(i, 4000) for i in range(64)]
    with losing_a_worker() as (pool, kill_one):
        table = ss.sweep(sliders, quakes, executor=pool, progress=kill_one)
    assert table == ss.sweep(sliders, quakes)


def test_a_sweep_that_broke_off_resumes_to_the_same_bits(tmp_path):
    sliders = [*ss.grid(ss.Coulomb, mu=MU), ss.Slider(ss.Coulomb(mu=0.1), period=2)]
    file = tmp_path / "sweep.npz"
    whole = ss.sweep(sliders, QUAKES)
    with pytest.raises(ss.SweepError, match="failed in the executor: OSError: the node") as error:
        ss.sweep(sliders, QUAKES, executor=Refusing(3), checkpoint=file)
    assert error.value.partial.done.sum() == 3
    assert error.value.records == range(3, 4)
    counted = []
    resumed = ss.sweep(
        sliders, QUAKES, checkpoint=file, progress=lambda done, total: counted.append(done)
    )
    assert resumed == whole
    assert counted[0] > 30  # three of six records were there already
    assert ss.sweep(sliders, QUAKES, checkpoint=file) == whole


def test_a_checkpoint_of_another_sweep_is_refused(tmp_path):
    file = tmp_path / "sweep.npz"
    ss.sweep(ss.Coulomb(mu=0.1), QUAKES, checkpoint=file)
    with_transverse = [
        ss.GroundMotion(q.acceleration, dt=q.dt, transverse=q.acceleration / 2) for q in QUAKES
    ]
    for sliders, motions, options in (
        (ss.Coulomb(mu=0.2), QUAKES, {}),
        (ss.Coulomb(mu=0.1), QUAKES.scaled(2), {}),
        (ss.Coulomb(mu=0.1), QUAKES, {"settle": True}),
        (ss.Coulomb(mu=0.1), with_transverse, {}),
    ):
        with pytest.raises(ValueError, match="is of another sweep"):
            ss.sweep(sliders, motions, checkpoint=file, **options)
    file.write_bytes(b"PK\x03\x04 and no more")
    with pytest.raises(ValueError, match=r"sweep: checkpoint '.*sweep.npz'"):
        ss.sweep(ss.Coulomb(mu=0.1), QUAKES, checkpoint=file)


def test_a_law_of_functions_resumes_in_a_new_process(tmp_path):
    """Its functions are other objects there."""
    program = """
import sys
import stickslip as ss

def resist(x, speed, direction):
    if abs(x) > 0.15:
        raise ValueError("beyond the plate")
    return 1.0 + 0.1 * speed

table = ss.sweep(
    ss.Law(resist=resist),
    [ss.GroundMotion([0.0, 2.0, -2.0, 0.0], dt=0.1)],
    checkpoint=sys.argv[1],
    progress=lambda done, total: print(done, total),
)
print(table.peak[0, 0, 0])
"""
    run = [sys.executable, "-c", program, str(tmp_path / "sweep.npz")]
    first, second = (
        subprocess.run(run, check=True, capture_output=True, text=True, timeout=300).stdout.split()
        for _ in range(2)
    )
    *progress, peak = first
    assert progress == ["2", "2"]
    assert second == [peak]  # nothing was left to do
    assert 0 < float(peak) < 0.15


def test_failures_survive_a_checkpoint(tmp_path):
    sliders = [ss.Coulomb(mu=0.1), ss.Slider(ss.Coulomb(mu=0), period=1)]
    for _ in range(2):
        with pytest.warns(RuntimeWarning, match="combinations failed"):
            table = ss.sweep(sliders, QUAKES, settle=True, checkpoint=tmp_path / "c.npz")
        assert len(table.failures) == 12
    assert ss.SweepTable.open(table.save(tmp_path / "t.h5")).failures == table.failures


def test_slammers_table_of_a_sample_record(capsys, tmp_path):
    """SLAMMER's own numbers for Kobe TAK-090 at ky = 0.1 g: normal 194.24, inverse 167.82 cm."""
    pytest.importorskip("pyslammer")
    from stickslip.cli import main

    file = tmp_path / "t.csv"
    assert main(["newmark", "sample:Kobe", "--ky", "0.1", "--csv", str(file)]) == 0
    line = capsys.readouterr().out.splitlines()[1].split()
    assert line[-3:] == ["194.24", "167.82", "181.03"]
    (row,) = csv.DictReader(file.read_text().splitlines())
    assert float(row["normal_m"]) == pytest.approx(1.9424, abs=5e-5)


def test_the_command_tells_mean_median_and_deviation_and_what_it_left_out(capsys, tmp_path):
    from stickslip.cli import main

    for i in range(3):
        m = QUAKES[i]
        text = "".join(f"{t},{a}\n" for t, a in zip(m.time.tolist(), m.acceleration.tolist()))
        (tmp_path / f"r{i}.csv").write_text(f"Time (s), Acceleration (m/s^2)\n{text}")
    (tmp_path / "notes.txt").write_text("no record")
    code = main(["newmark", str(tmp_path), "--ky", "0.05", "0.02", "--scale-pga", "0.4", "--json"])
    out, err = capsys.readouterr()
    assert code == 1
    assert "notes.txt" in err
    document = json.loads(out)
    assert [row["ky_g"] for row in document["results"]] == [0.02, 0.05] * 3
    assert [row["pga_g"] for row in document["results"]] == pytest.approx([0.4] * 6)
    values = [row["normal_m"] for row in document["results"] if row["ky_g"] == 0.05]
    found = {s["statistic"]: s["normal_m"] for s in document["statistics"] if s["ky_g"] == 0.05}
    assert found["mean"] == pytest.approx(np.mean(values), rel=1e-12)
    assert found["median"] == np.median(values)
    assert found["sd"] == pytest.approx(np.std(values, ddof=1), rel=1e-12)
    assert main(["newmark", "sample:Kobe", "--ky", "-1"]) == 2
    assert "--ky must be positive and finite, got -1 g" in capsys.readouterr().err


# ---- in the plane


def station(seed: int, up: float = 0.0) -> ss.GroundMotion:
    n, t, z = (quake(100 * seed + i, 500).acceleration for i in range(3))
    return ss.GroundMotion(
        n, dt=0.02, transverse=t, vertical=up * z if up else None, name=f"station {seed}"
    )


STATIONS = ss.Suite([station(i) for i in range(4)], {"magnitude": [5, 6, 6.5, 7]})
PLANAR = [
    ss.PlanarSlider(ss.Coulomb(mu=0.1)),
    ss.PlanarSlider(ss.Coulomb(mu=0.05), period=2, stops=ss.Stops(gap=0.05, restitution=0.6)),
    ss.PlanarSlider(ss.FrictionPendulum(radius=2, mu_slow=0.03, mu_fast=0.06, rate=50)),
    ss.PlanarSlider(ss.Coulomb(mu=0.3), slope_degrees=10),
]


def test_in_the_plane_each_combination_is_what_integrate_says():
    motions = [*STATIONS, station(7, up=0.5)]
    table = ss.sweep(PLANAR, motions, settle=True)
    assert table.planar
    assert table.peak.shape == (4, 5, 2)
    for s, slider in enumerate(PLANAR):
        for r, motion in enumerate(motions):
            one = ss.integrate(slider, motion, settle=True)
            place = s, r, 0
            assert table.peak[place] == one.peak
            assert (table.residual_axis[place], table.residual_transverse[place]) == tuple(
                one.residual
            )
            assert table.residual[place] == pytest.approx(math.hypot(*one.residual), rel=1e-15)
            assert table.sliding_distance[place] == one.sliding_distance
            assert table.events[place] == len(one.events) - 1
            hits = one.events[one.events["kind"] == "impact"]
            assert table.impacts[place] == len(hits)
            if len(hits):
                radial = (hits["velocity"] * hits["displacement"]).sum(axis=1)
                radial /= np.hypot(*hits["displacement"].T)
                assert table.impact_speed[place] == pytest.approx(radial.max(), rel=1e-12)
    # Reversing both components mirrors the response on level ground; downhill remains downhill.
    level, slope = slice(3), 3
    assert np.array_equal(table.peak[level, :, 0], table.peak[level, :, 1])
    for residual in (table.residual_axis, table.residual_transverse):
        assert np.array_equal(residual[level, :, 0], -residual[level, :, 1])
    other = ss.integrate(PLANAR[slope], -motions[1], settle=True)
    assert table.peak[slope, 1, 1] == other.peak != table.peak[slope, 1, 0]
    assert table.impact_fraction[1] == 1
    assert (table.impact_fraction[[0, 2, 3]] == 0).all()
    for polarity, p in (("recorded", 0), ("reversed", 1)):
        alone = ss.sweep(PLANAR, motions, settle=True, polarity=polarity, threads=1)
        assert np.array_equal(alone.residual_axis[:, :, 0], table.residual_axis[:, :, p])


def test_a_motion_without_a_transverse_component_fails_alone():
    with pytest.warns(RuntimeWarning, match="2 of 6 combinations failed.*transverse component"):
        table = ss.sweep(PLANAR[0], [STATIONS[0], QUAKES[0], STATIONS[1]], settle=True)
    assert np.isnan(table.peak[0, 1]).all()
    assert np.isnan(table.residual_axis[0, 1]).all()
    assert np.isfinite(table.peak[0, [0, 2]]).all()
    assert {one.record for one in table.failures} == {1}


def test_sliders_on_one_axis_and_in_the_plane_are_not_mixed():
    with pytest.raises(
        TypeError, match=r"sliders\[0\] is of type PlanarSlider, sliders\[1\] of type Coulomb"
    ):
        ss.sweep([PLANAR[0], ss.Coulomb(mu=0.1)], STATIONS)
    with pytest.raises(
        TypeError, match=r"sliders\[0\] is of type Slider, sliders\[2\] of type PlanarSlider"
    ):
        ss.sweep([ss.Slider(ss.Coulomb(mu=0.1)), ss.Coulomb(mu=0.1), PLANAR[0]], STATIONS)


def test_tables_of_the_plane_go_to_frames_files_and_back(tmp_path):
    floors = ss.grid(ss.PlanarSlider, law=ss.grid(ss.Coulomb, mu=MU), period=[2.0, 3.0])
    assert isinstance(floors[0], ss.PlanarSlider)
    table = ss.sweep(floors, STATIONS, settle=True)
    assert ss.SweepTable.open(table.save(tmp_path / "t.h5")) == table
    frame = table.to_dataframe()
    assert frame.attrs["units"]["residual_transverse"] == "m"
    row = frame[(frame.mu == 0.1) & (frame.period == 3) & (frame.magnitude == 6)]
    assert row.residual.tolist() == pytest.approx(
        np.hypot(row.residual_axis, row.residual_transverse).tolist(), rel=1e-15
    )
    assert "impacts" not in frame
    with_stops = ss.sweep(PLANAR, STATIONS)
    assert ss.SweepTable.open(with_stops.save(tmp_path / "s.h5")) == with_stops
    assert {"impacts", "impact_speed"} <= set(with_stops.to_dataframe())
    assert with_stops.to_xarray().impact_speed.attrs["units"] == "m/s"
    assert (table.quantile(0.5, "residual_axis") <= table.quantile(0.5, "residual")).all()
    one_axis = ss.sweep(ss.Coulomb(mu=0.1), STATIONS)
    with pytest.raises(ValueError, match="residual_axis is known of sliders in the plane"):
        _ = one_axis.residual_axis
    with pytest.raises(ValueError, match="quantity must be one of peak, residual, sliding_dist"):
        one_axis.quantile(0.5, "residual_axis")
    with pytest.raises(ValueError, match="in the plane; see impacts and impact_speed"):
        _ = with_stops.impacts_forward
    with pytest.raises(ValueError, match="no slider has stops"):
        _ = table.impacts


def test_a_table_of_the_plane_is_drawn():
    pytest.importorskip("matplotlib")
    table = ss.sweep(
        ss.grid(ss.PlanarSlider, law=ss.grid(ss.Coulomb, mu=MU)), STATIONS, settle=True
    )
    for quantity in ("peak", "residual", "residual_axis"):
        (axes,) = table.plot(quantity).axes
        line = axes.get_lines()[-1].get_ydata()
        assert line == pytest.approx(100 * table.quantile(0.5, quantity), rel=1e-12)


def test_in_the_plane_executors_and_checkpoints_find_the_same_bits(tmp_path):
    whole = ss.sweep(PLANAR, STATIONS)
    with ProcessPoolExecutor(2) as pool:
        assert ss.sweep(PLANAR, STATIONS, executor=pool) == whole
    file = tmp_path / "sweep.npz"
    with pytest.raises(ss.SweepError, match="the node is gone"):
        ss.sweep(PLANAR, STATIONS, executor=Refusing(2), checkpoint=file)
    assert ss.sweep(PLANAR, STATIONS, checkpoint=file) == whole
    ss.sweep(PLANAR[0], STATIONS, checkpoint=tmp_path / "one.npz")
    turned = [
        ss.GroundMotion(s.acceleration, dt=s.dt, transverse=-s.transverse, name=s.name)
        for s in STATIONS
    ]
    for sliders, motions in (
        (ss.Slider(ss.Coulomb(mu=0.1)), STATIONS),
        (ss.PlanarSlider(ss.Coulomb(mu=0.1), period=2), STATIONS),
        (PLANAR[0], turned),
    ):
        with pytest.raises(ValueError, match="is of another sweep"):
            ss.sweep(sliders, motions, checkpoint=tmp_path / "one.npz")


def test_units_of_pairs_that_move_nothing_are_doubted():
    with pytest.warns(ss.PlausibilityWarning, match="sweep: nothing slips: .* in g"):
        ss.sweep(PLANAR[0], STATIONS.scaled(0.05))


def test_a_suite_of_recorded_pairs_in_the_plane(agency_files):
    """The peaks of blocks against the larger of those on one axis, as docs/sweeps.md states."""
    pairs = agency_files / "usgs_pairs"
    if not pairs.exists():
        pytest.skip("no usgs_pairs among the agency files")
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # offsets, and the column pga_g
        suite = ss.Suite.read(
            pairs, stations=True, metadata=pairs / "pairs.csv", units="g", dt="dt_s"
        )
    assert len(suite) == 11
    levels = [0.05, 0.1, 0.2]
    blocks = ss.grid(ss.PlanarSlider, law=ss.grid(ss.Coulomb, mu=levels))
    table = ss.sweep(blocks, suite, settle=True)
    assert not table.failures
    assert np.array_equal(table.peak[..., 0], table.peak[..., 1])
    axis, across = (
        ss.sweep(ss.grid(ss.Coulomb, mu=levels), motions, settle=True, polarity="recorded")
        for motions in (suite, [motion.component("transverse") for motion in suite])
    )
    ratio = (table.peak / np.maximum(axis.peak, across.peak))[..., 0]
    assert [ratio.min(), ratio.max()] == pytest.approx([0.79, 4.37], abs=0.005)
    assert np.median(ratio, axis=1) == pytest.approx([1.17, 1.19, 1.57], abs=0.005)


def test_pendulums_beyond_their_linear_range_are_remarked_once(tmp_path):
    quake = ss.GroundMotion(3 * np.sin(2 * np.arange(0, 20, 0.02)), dt=0.02)
    sliders = ss.grid(ss.FrictionPendulum, radius=[0.5, 2.0, 15.0], mu=[0.03])
    table = ss.sweep(sliders, quake, polarity="recorded")
    beyond = table.peak[:, 0, 0] > 0.2 * np.array([0.5, 2.0, 15.0])
    assert 0 < beyond.sum() < 3
    peaks = np.where(beyond, table.peak[:, 0, 0], 0)
    worst = ss.integrate(sliders[peaks.argmax()], quake)
    assert (
        table.remark == f"{beyond.sum()} of 3 sliders: as slider {peaks.argmax()}, {worst.remark}"
    )
    assert table.remark in repr(table)
    table.save(tmp_path / "t.h5")
    assert ss.SweepTable.open(tmp_path / "t.h5").remark == table.remark
    assert ss.SweepTable.from_json(table.to_json()) == table
    assert ss.sweep(sliders[2], quake).remark == ""
    both = ss.GroundMotion(quake.acceleration, dt=0.02, transverse=quake.acceleration)
    assert "beyond 0.2" in ss.sweep(ss.PlanarSlider(sliders[1]), both).remark


def test_the_command_says_once_that_pendulums_go_too_far(tmp_path, capsys):
    file = tmp_path / "a.txt"
    np.savetxt(file, 3 * np.sin(2 * np.arange(0, 20, 0.02)) * np.hanning(1000))
    command = ["sweep", str(file), "--dt", "0.02", "--units", "m/s^2", "--law", "pendulum"]
    command += ["--radii", "0.1", "0.6", "0.6", "--mu", "0.01", "0.04", "0.08"]
    assert cli.main([*command, "--capacities", "0.1", "0.5", "0.5"]) == 0
    lines = [x for x in capsys.readouterr().err.splitlines() if "linear to 2 %" in x]
    assert len(lines) == 1
