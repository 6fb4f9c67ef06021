"""Files as people have them: compressed, in the archives that agencies send, and from ObsPy."""

import bz2
import gzip
import io
import json
import lzma
import tarfile
import zipfile
from types import SimpleNamespace

import numpy as np
import pytest
import stickslip as ss
from stickslip.cli import main

G = ss.STANDARD_GRAVITY
CSV = "# units: g\n0,1\n.1,2\n"
COMPRESSED = {"bzip2": bz2.compress, "xz": lzma.compress, "gzip": gzip.compress}


def peer(component, quantity="ACCELERATION", units="G", peak=0.2):
    samples = peak * np.sin(np.arange(200) / 3) * np.hanning(200)
    rows = [" ".join(f"{a:.7E}" for a in samples[i : i + 5]) for i in range(0, 200, 5)]
    return "\n".join(
        [
            "PEER NGA STRONG MOTION DATABASE RECORD",
            f"Somewhere, 1/1/2001, Station A, {component}",
            f"{quantity} TIME SERIES IN UNITS OF {units}",
            "NPTS=    200, DT=   .0100 SEC,",
            *rows,
            "",
        ]
    )


def as_peer_sends_it(file, **more):
    """An archive of one station: accelerations, velocities, displacements and the search."""
    members = {}
    parts = {"H1": ("000", 0.2), "H2": ("090", 0.15), "UP": ("UP", 0.1)}
    for name, (component, peak) in parts.items():
        members[f"RSN1_A_{name}.AT2"] = peer(component, peak=peak)
        members[f"RSN1_A_{name}.VT2"] = peer(component, "VELOCITY", "CM/S")
        members[f"RSN1_A_{name}.DT2"] = peer(component, "DISPLACEMENT", "CM")
    members["_SearchResults.csv"] = (
        " -- Summary of PEER Ground Motion Database Search Criteria --,,\n"
        "Search Criteria,,\nDamping Ratio:,0.05,\n\n"
        "Period (sec),Target pSa (g),Mean pSa (g)\n0.01,0.2,0.2\n0.02,0.3,0.3\n"
    )
    members["DISCLAIMER.txt"] = "These data are provided as they are.\n"
    with zipfile.ZipFile(file, "w", zipfile.ZIP_DEFLATED) as archive:
        for name, content in {**members, **more}.items():
            archive.writestr(name, content)
    return file


def run(capsys, *arguments):
    code = main([*map(str, arguments)])
    out, err = capsys.readouterr()
    return code, out, err


# ---- compressed files


@pytest.mark.parametrize("pack", COMPRESSED.values(), ids=COMPRESSED)
def test_what_compresses_a_file_does_not_matter(tmp_path, pack):
    (tmp_path / "plain.csv").write_text(CSV)
    plain = ss.read_record(tmp_path / "plain.csv")
    file = tmp_path / "packed"
    for content in (pack(CSV.encode()), pack(gzip.compress(CSV.encode()))):
        file.write_bytes(content)
        assert np.array_equal(ss.read_record(file).acceleration, plain.acceleration)
    stream = io.BytesIO()
    with tarfile.open(fileobj=stream, mode="w") as tar:
        for name in ("a.csv", "b.csv"):
            about = tarfile.TarInfo(name)
            about.size = len(CSV)
            tar.addfile(about, io.BytesIO(CSV.encode()))
    file.write_bytes(pack(stream.getvalue()))
    assert np.array_equal(ss.read_record(f"{file}::b.csv").acceleration, plain.acceleration)
    with pytest.raises(ValueError, match=r"name one as archive.zip::member; .* 2 files"):
        ss.read_record(file)


@pytest.mark.parametrize("name", COMPRESSED)
def test_a_damaged_compressed_file_is_said_to_be_one(tmp_path, name):
    packed = COMPRESSED[name](CSV.encode() * 50)
    file = tmp_path / "packed"
    for content in (packed[:-12], packed[:40] + b"\xff" * 20 + packed[60:]):
        file.write_bytes(content)
        with pytest.raises(ValueError, match=f"read_record: .*packed: damaged {name} file: ."):
            ss.read_record(file)


@pytest.mark.slow
@pytest.mark.parametrize("pack", COMPRESSED.values(), ids=COMPRESSED)
def test_no_compressed_file_fills_the_memory(tmp_path, pack):
    file = tmp_path / "bomb"
    file.write_bytes(pack(bytes(80 << 20)))
    with pytest.raises(ValueError, match="unpacks to more than 64 MiB; unpack it to read it"):
        ss.read_record(file)


def test_xz_is_not_given_all_the_memory_that_it_asks_for(tmp_path, monkeypatch):
    def full(*_):
        raise MemoryError

    monkeypatch.setattr(lzma.LZMAFile, "read", full)
    (tmp_path / "a.xz").write_bytes(lzma.compress(CSV.encode()))
    with pytest.raises(ValueError, match="damaged xz file: MemoryError"):
        ss.read_record(tmp_path / "a.xz")


# ---- archives of several files


def test_the_command_reads_the_archive_that_peer_sends(capsys, tmp_path):
    file = as_peer_sends_it(tmp_path / "RSN1.zip")
    csv = tmp_path / "out.csv"
    code, out, err = run(capsys, "slide", file, "--mu", 0.05, "--csv", csv)
    assert code == 0
    rows = csv.read_text().splitlines()[1:]
    assert [row.partition(",")[0] for row in rows] == [
        f"{file}::RSN1_A_H1.AT2",
        f"{file}::RSN1_A_H2.AT2",
    ]
    assert "RSN1_A_UP.AT2: a vertical component" in err
    assert all("left out" in line for line in err.splitlines())
    _, out, _ = run(capsys, "slide", file, "--mu", 0.05, "--json")
    said = json.loads(out)
    assert said["errors"] == []
    left = {one["file"].partition("::")[2]: one["reason"] for one in said["left_out"]}
    assert len(left) == 9
    assert "expected a PEER file of acceleration" in left["RSN1_A_H1.VT2"]
    assert {"_SearchResults.csv", "DISCLAIMER.txt", "RSN1_A_UP.DT2"} < left.keys()
    code, out, err = run(capsys, "slide", file, "--mu", 0.05, "--station", "--strict", "--json")
    assert code == 0
    (row,) = json.loads(out)["results"]
    assert row["file"] == str(file)
    assert all("left out" in line for line in err.splitlines())


def test_the_only_record_in_an_archive_has_its_own_name(capsys, tmp_path):
    file = tmp_path / "one.zip"
    with zipfile.ZipFile(file, "w") as archive:
        archive.writestr("a.AT2", peer("000"))
        archive.writestr("readme.txt", "Read me.")
    _, out, err = run(capsys, "slide", file, "--mu", 0.1, "--json")
    assert json.loads(out)["results"][0]["file"] == f"{file}::a.AT2"
    assert "left out" in err


def test_archives_in_an_archive_are_read(capsys, tmp_path):
    inner = as_peer_sends_it(tmp_path / "inner.zip")
    with zipfile.ZipFile(tmp_path / "one.zip", "w") as archive:
        archive.writestr("B_UP.csv", CSV)
    with zipfile.ZipFile(tmp_path / "outer.zip", "w") as archive:
        archive.write(inner, "a/inner.zip")
        archive.write(tmp_path / "one.zip", "one.zip")
        archive.writestr("broken.zip", b"PK\3\4 and no more")
    with pytest.warns(RuntimeWarning) as said:
        suite = ss.Suite.read(tmp_path / "outer.zip", on_error="skip")
    assert "cannot read 1 of 13 files" in str(said[0].message) and "broken.zip" in str(
        said[0].message
    )
    assert [name.rpartition("zip::")[2] for name in suite.file] == [
        "RSN1_A_H1.AT2",
        "RSN1_A_H2.AT2",
    ]
    assert all(ss.read_record(name).name for name in suite.file)  # under the names they have
    assert any("one.zip" in one.file and "vertical" in one.reason for one in suite.left_out)


def test_what_systems_and_people_put_into_archives_is_no_failure(tmp_path):
    junk = {"a/.DS_Store": b"\0\1Bud1", "Thumbs.db": b"\xd0\xcf\0", "desktop.ini": b"[x]\n"}
    with zipfile.ZipFile(tmp_path / "a.zip", "w") as archive:
        for name, content in {**junk, "readme.txt": b"Records.\n", "b.csv": CSV}.items():
            archive.writestr(name, content)
    with pytest.warns(RuntimeWarning, match="no records: .*readme.txt"):
        assert len(ss.Suite.read(tmp_path / "a.zip")) == 1
    with zipfile.ZipFile(tmp_path / "b.zip", "w") as archive:
        for name, content in {**junk, "b.csv": CSV}.items():
            archive.writestr(name, content)
    assert ss.read_record(tmp_path / "b.zip").dt == 0.1


@pytest.mark.parametrize("end", ["at a header", "within a header"])
def test_a_tar_archive_that_is_cut_off_is_refused(tmp_path, end):
    stream = io.BytesIO()
    with tarfile.open(fileobj=stream, mode="w") as archive:
        for number in range(1, 4):
            content = f"# units: g\n0,{number}\n.1,2\n".encode()
            about = tarfile.TarInfo(f"{number}.csv")
            about.size = len(content)
            archive.addfile(about, io.BytesIO(content))
    whole = stream.getvalue()
    (tmp_path / "whole.tar").write_bytes(whole)
    assert len(ss.Suite.read(tmp_path / "whole.tar")) == 3
    (tmp_path / "cut.tar").write_bytes(whole[: 2048 + (100 if end == "within a header" else 0)])
    with pytest.raises(ValueError, match="the archive is cut off"):
        ss.Suite.read(tmp_path / "cut.tar")


@pytest.mark.filterwarnings("ignore:Duplicate name")
def test_two_files_of_one_name_in_an_archive_are_refused(tmp_path):
    with zipfile.ZipFile(tmp_path / "a.zip", "w") as archive:
        archive.writestr("a.AT2", peer("000"))
        archive.writestr("a.AT2", peer("090"))
    with pytest.raises(ValueError, match=r"two files in the archive are named a\.AT2"):
        ss.Suite.read(tmp_path / "a.zip")


def test_a_workbook_is_no_archive_of_records(tmp_path):
    with zipfile.ZipFile(tmp_path / "a.xlsx", "w") as archive:
        archive.writestr("[Content_Types].xml", "<Types/>")
        archive.writestr("xl/workbook.xml", "<workbook/>")
    for read in (ss.read_record, ss.Suite.read):
        with pytest.raises(ValueError, match="a workbook or document: save its table as CSV"):
            read(tmp_path / "a.xlsx")


@pytest.mark.parametrize(("name", "value"), [("units", 9.81), ("component", True)])
def test_units_and_components_of_another_type_are_refused(tmp_path, name, value):
    file = tmp_path / "a.csv"
    file.write_text(CSV)
    with pytest.raises(TypeError, match=f"read_record: {name} must be .*, got {value}"):
        ss.read_record(file, **{name: value})


def test_a_vertical_component_does_not_go_with_an_archive(capsys, tmp_path):
    file = as_peer_sends_it(tmp_path / "RSN1.zip")
    up = f"{file}::RSN1_A_UP.AT2"
    code, _, err = run(capsys, "slide", file, "--mu", 0.05, "--vertical", up)
    assert code == 1
    assert f"{file}: --vertical goes with one record, got 3" in err
    code, _, err = run(capsys, "slide", f"{file}::RSN1_A_H1.AT2", "--mu", 0.1, "--vertical", up)
    assert (code, err) == (0, "")


def test_pictures_of_an_archive_have_the_names_of_its_files(capsys, tmp_path):
    pytest.importorskip("matplotlib")
    file = as_peer_sends_it(tmp_path / "RSN1.zip")
    assert run(capsys, "slide", file, "--mu", 0.05, "--plot", tmp_path / "p.svg")[0] == 0
    pictures = sorted(picture.name for picture in tmp_path.glob("*.svg"))
    assert pictures == ["p-RSN1_A_H1.svg", "p-RSN1_A_H2.svg"]


def test_a_damaged_record_in_an_archive_is_a_failure(capsys, tmp_path):
    damaged = peer("045")[:2000]
    file = as_peer_sends_it(tmp_path / "RSN1.zip", **{"RSN2_B.AT2": damaged})
    code, out, err = run(capsys, "slide", file, "--mu", 0.05)
    assert code == 1
    assert len(out.splitlines()) == 3
    assert "RSN2_B.AT2: " in next(line for line in err.splitlines() if "left out" not in line)
    assert run(capsys, "slide", file, "--mu", 0.05, "--strict")[0] == 2
    with pytest.raises(ValueError, match=r"cannot read 1 of 12 files: .*RSN2_B"):
        ss.Suite.read(file)


def test_a_suite_and_a_station_are_read_of_the_archive_that_peer_sends(tmp_path):
    file = as_peer_sends_it(tmp_path / "RSN1.zip")
    with pytest.warns(RuntimeWarning) as caught:
        suite = ss.Suite.read(file)
    said = [str(one.message).partition(":")[2].partition(":")[0] for one in caught]
    assert " left out, because they are no records" in said
    assert list(suite.file) == [f"{file}::RSN1_A_H{k}.AT2" for k in (1, 2)]
    assert sum(one.file.endswith((".VT2", ".DT2")) for one in suite.left_out) == 6
    station = ss.read_station(file)
    assert station.transverse is not None and station.vertical is not None
    with pytest.warns(RuntimeWarning):
        (same,) = ss.Suite.read(file, stations=True)
    assert np.array_equal(same.acceleration, station.acceleration)
    with pytest.raises(ValueError, match=r"archive.zip::member; read_station and") as no:
        ss.read_record(file)
    assert "RSN1_A_H1.AT2, RSN1_A_H1.VT2" in str(no.value)


def test_columns_without_units_are_a_failure_beside_columns_with_them(tmp_path):
    file = tmp_path / "own.zip"
    with zipfile.ZipFile(file, "w") as archive:
        archive.writestr("a.csv", CSV)
        archive.writestr("b.csv", "0,1\n.1,2\n")
    with pytest.raises(ValueError, match=r"b.csv: the file states no units"):
        ss.Suite.read(file)
    with pytest.raises(ValueError, match=r"b.csv: the file states no units"):
        ss.read_station(file)


# ---- baselines


OFFSET = np.sin(np.arange(400) / 4) * np.hanning(400) + 0.02


def write_offset(file):
    rows = "".join(f"{0.01 * i:.2f},{a!r}\n" for i, a in enumerate(OFFSET.tolist()))
    file.write_text("# time (s), acc (m/s^2)\n" + rows)
    return file


def test_the_command_removes_the_mean(capsys, tmp_path):
    file = write_offset(tmp_path / "a.csv")
    _, plain, err = run(capsys, "slide", file, "--mu", 0.02)
    assert "baseline error, which --detrend removes" in err
    answers = {}
    for what in ((), ("mean",), ("line",)):
        code, answers[what], err = run(capsys, "slide", file, "--mu", 0.02, "--detrend", *what)
        assert (code, err) == (0, "")
    assert answers[()] == answers[("mean",)] != plain
    motion = ss.read_record(file, detrend="mean")
    peak = ss.integrate(ss.Coulomb(mu=0.02), motion, settle=True).peak
    assert f"{100 * peak:.2f}" in answers[()]
    for command in (["newmark", "--ky", 0.02], ["sweep", "--mu", 0.02], ["records"], ["spectrum"]):
        code, _, err = run(capsys, command[0], file, *command[1:], "--detrend")
        assert (code, err) == (0, "")


def test_a_trend_is_removed_by_the_same_word_everywhere(tmp_path):
    file = write_offset(tmp_path / "a.csv")
    with pytest.warns(ss.PlausibilityWarning, match="baseline"):
        plain = ss.read_record(file)
    for word, order in (("mean", 0), ("line", 1)):
        right = plain.detrended(order)
        assert ss.read_record(file, detrend=word) == right
        assert ss.read_record(file, detrend=word, component="all") == [right]
        assert list(ss.Suite.read(file, detrend=word)) == [right]
        assert np.array_equal(
            ss.read_station(file, orientations=["N"], detrend=word).acceleration,
            right.acceleration,
        )
    for read in (ss.read_record, ss.read_station, ss.Suite.read):
        with pytest.raises(ValueError, match=f"{read.__name__}: detrend must be 'mean' or 'line'"):
            read(file, detrend="linear")


# ---- events of SimCenter


def event(**about):
    series = [
        {"name": f"a{dof}", "type": "Value", "dT": 0.01, "data": [0.1 * dof, -0.2, 0.3]}
        for dof in (1, 2, 3)
    ]
    pattern = [
        {"dof": dof, "timeSeries": f"a{dof}", "type": "UniformAcceleration"} for dof in (1, 2, 3)
    ]
    return {"name": "A", "type": "Seismic", "timeSeries": series, "pattern": pattern} | about


def test_an_event_of_simcenter_is_a_record(tmp_path):
    file = tmp_path / "event.json"
    file.write_text(json.dumps({"Events": [event()], "randomVariables": []}))
    motions = ss.read_record(file, units="g", component="all")
    assert [m.name for m in motions] == ["A, H1", "A, H2", "A, UP"]
    assert [m.orientation for m in motions] == ["", "", "up"]
    assert motions[1].acceleration == pytest.approx([0.2 * G, -0.2 * G, 0.3 * G])
    assert ss.read_record(file, units="g", component="H2", dt=0.01) == motions[1]
    station = ss.read_station(file, units="g", orientations=[0, 90, "up"])
    assert np.array_equal(station.transverse, motions[1].acceleration)
    assert np.array_equal(station.vertical, motions[2].acceleration)
    with pytest.raises(ValueError, match=r"the file states no units .*: pass units"):
        ss.read_record(file, component=1)
    with pytest.raises(ValueError, match="available: 1 H1, 2 H2, 3 UP; got ''"):
        ss.read_record(file, units="g")
    with pytest.raises(ValueError, match=r"states a time step of 0.01 s, got dt=0.02"):
        ss.read_record(file, units="g", component=1, dt=0.02)
    model = {"force": "kip", "length": "in", "time": "sec"}  # says nothing of the series
    file.write_text(json.dumps({"Events": [event(units=model)]}))
    assert ss.read_record(file, units="g", component=1) == motions[0]
    file.write_text("\n" + json.dumps(event(units={"acceleration": "g"})))
    assert ss.read_record(file, component=1) == motions[0]
    with pytest.raises(ValueError, match="the file states the unit 'g', got units='gal'"):
        ss.read_record(file, component=1, units="gal")
    twice = event()
    twice["timeSeries"][0]["factor"] = 2
    file.write_text(json.dumps(twice))
    assert ss.read_record(file, component=1, units="g") == motions[0].scaled(2)


def test_what_is_no_event_of_simcenter_is_refused(tmp_path):
    file = tmp_path / "event.json"
    velocity = event()
    velocity["pattern"][0]["type"] = "UniformVelocity"
    file.write_text(json.dumps(velocity))
    with pytest.raises(ValueError, match="expected UniformAcceleration, got 'UniformVelocity'"):
        ss.read_record(file, units="g", component=1)
    rotation = event(pattern=[{"dof": 4, "timeSeries": "a1"}])
    empty = event(timeSeries=[{"name": f"a{dof}", "dT": 0.01} for dof in (1, 2, 3)])
    texts = [{"name": f"a{dof}", "dT": 0.01, "data": ["a", [], {}]} for dof in (1, 2, 3)]
    documents = [
        *({}, {"Events": []}, {"Events": 3}, {"Events": [3]}, {"Events": [event(), event()]}),
        *(rotation, empty, event(timeSeries=[]), event(timeSeries=texts), event(pattern=3)),
    ]
    broken = ["{", "{" * 10**5, '{"a": ' + "[" * 10**5, '{"a": NaN}']
    for text in [*map(json.dumps, documents), *broken]:
        file.write_text(text)
        with pytest.raises(ValueError, match=r"read_record: .*event.json: "):
            ss.read_record(file, units="g", component=1)


# ---- ObsPy: rules, with what a trace has

ACC = "ObsPy 1.4.0: remove_response(fig=None::inventory=None::output='ACC'::water_level=60)"
VEL, DISP, DEF = (ACC.replace("ACC", output) for output in ("VEL", "DISP", "DEF"))
BARE = "ObsPy 1.4.0: remove_response(inventory=None)"
GAIN = "ObsPy 1.4.0: remove_sensitivity(inventory=None)"
INTEGRATE, DIFFERENTIATE = (
    f"ObsPy 1.4.0: {name}(method='{name}')" for name in ("integrate", "differentiate")
)
FILTER = "ObsPy 1.4.0: filter(options={'freq': 1.0}::type='highpass')"


def trace(channel="HNE", *processing, data=(0.1, -0.25, 0.3), **about):
    stats = SimpleNamespace(delta=0.01, channel=channel, processing=list(processing), **about)
    return SimpleNamespace(data=np.array(data), stats=stats, id=f"XX.STA..{channel}")


ACCELERATIONS = {
    "as simulated": trace(),
    "its channel unknown": trace(""),
    "its response removed": trace("HHE", FILTER, ACC, FILTER),
    "its gain removed": trace("HNE", GAIN),
    "differentiated velocity": trace("HHE", VEL, DIFFERENTIATE),
    "differentiated twice": trace("HHE", DISP, DIFFERENTIATE, DIFFERENTIATE),
    "differentiated of an unknown channel": trace("", DIFFERENTIATE),
    "an accelerometer's own unit": trace("HNE", DEF),
    "integrated and differentiated": trace("HNE", INTEGRATE, DIFFERENTIATE),
    "a unit in the header": trace(ascii=SimpleNamespace(unit="M/S**2")),
    "counts in the header before": trace("HNE", ACC, ascii=SimpleNamespace(unit="COUNTS")),
    "calibration before": trace("HNE", ACC, calib=2.5),
    "SAC": trace(sac=SimpleNamespace(idep=8)),
}


@pytest.mark.parametrize("one", ACCELERATIONS.values(), ids=ACCELERATIONS)
def test_acceleration_of_obspy_is_taken(one):
    motion = ss.GroundMotion.from_obspy(one)
    assert motion.acceleration == pytest.approx([0.1, -0.25, 0.3], abs=0)


OTHERS = {
    "the default output": (trace("HNE", BARE), "velocity, .* had the output VEL"),
    "velocity": (trace("HNE", VEL), r"velocity, not acceleration: remove_response had .* VEL"),
    "displacement": (trace("HHE", FILTER, DISP, FILTER), "displacement, .* output DISP"),
    "a seismometer's own unit": (trace("HHE", DEF), "velocity"),
    "integrated": (trace("HNE", ACC, INTEGRATE), "velocity, .*: integrate was the last"),
    "integrated of an unknown channel": (trace("", INTEGRATE), "velocity"),
    "integrated twice": (trace("HNE", INTEGRATE, INTEGRATE), "displacement"),
    "differentiated acceleration": (trace("HNE", DIFFERENTIATE), "no acceleration"),
    "a broadband channel": (trace("BHZ"), "velocity, .*: the channel BHZ"),
    "a geophone": (trace("DPZ"), "velocity"),
    "the gain of a seismometer": (trace("HHE", GAIN), "velocity"),
    "the gain of an unknown instrument": (trace("", GAIN), "may be velocity: the channel ''"),
    "the gain of a low-gain instrument": (trace("HLE", GAIN), "may be velocity"),
    "M/S": (trace(ascii=SimpleNamespace(unit="M/S")), "its header states the unit 'M/S', which"),
    "counts": (trace(ascii=SimpleNamespace(unit="Counts")), "counts, and calib is 1"),
    "whole numbers": (trace(data=[1, -2, 3]), "counts, and calib is 1; remove the response"),
    "SAC's velocity": (
        trace(sac=SimpleNamespace(idep=7)),
        "velocity, .*: its header says idep = 7",
    ),
}


@pytest.mark.parametrize("one, what", OTHERS.values(), ids=OTHERS)
def test_what_is_no_acceleration_is_refused(one, what):
    for units in (None, "m/s^2"):
        with pytest.raises(ValueError, match=f"from_obspy: XX.STA..*: {what}") as refused:
            ss.GroundMotion.from_obspy(one, **({"units": units} if units else {}))
        assert 'trace.remove_response(inventory, output="ACC")' in str(refused.value)
    with pytest.raises(ValueError, match=what):
        ss.read_station(SimpleNamespace(traces=[one, trace("HNN")]))


def test_counts_are_multiplied_by_their_calibration():
    for data in ([100, -250, 300], [100.0, -250.0, 300.0]):
        motion = ss.GroundMotion.from_obspy(trace(data=data, calib=0.001), units="gal")
        assert motion.acceleration == pytest.approx([0.001, -0.0025, 0.003])
    with pytest.raises(ValueError, match=r"calib is 0.001, and the samples are no whole numbers"):
        ss.GroundMotion.from_obspy(trace(calib=0.001))
    with pytest.raises(ValueError, match=r"calib is 0.001, and in GSE2 files this is no accel"):
        ss.GroundMotion.from_obspy(trace(data=[1, 2, 3], calib=0.001, _format="GSE2"))


def test_the_unit_in_the_header_counts():
    one = trace(ascii=SimpleNamespace(unit="CM/S**2"), data=[1, 2, 3])
    assert ss.GroundMotion.from_obspy(one).acceleration == pytest.approx([0.01, 0.02, 0.03])
    assert ss.GroundMotion.from_obspy(one, units="gal") == ss.GroundMotion.from_obspy(one)
    with pytest.raises(ValueError, match=r"the trace states the unit 'CM/S..2', got units='g'"):
        ss.GroundMotion.from_obspy(one, units="g")


def test_gaps_and_segments_of_obspy_are_refused():
    gap = trace(starttime=100.0)
    gap.data = np.ma.masked_array([0.1, 2, 3, 0.2], [0, 1, 1, 0])
    with pytest.raises(ValueError, match=r"a gap, .* at index 1: from 100.01 to 100.02; .*merge"):
        ss.GroundMotion.from_obspy(gap)
    gap.data = np.ma.masked_array([0.1, 2, 3, 0.2], [0, 0, 0, 0])
    assert len(ss.GroundMotion.from_obspy(gap)) == 4
    parts = [trace(starttime=10.0, endtime=20.0), trace(starttime=30.0, endtime=40.0)]
    for read in (ss.GroundMotion.from_obspy, ss.read_station):
        with pytest.raises(ValueError, match=r"segments, from 10.0 to 20.0 and from 30.0 to 40.0"):
            read(SimpleNamespace(traces=parts))


# ---- ObsPy itself


@pytest.fixture
def obspy():
    return pytest.importorskip("obspy", reason="obspy is not installed: pip install obspy")


@pytest.mark.slow
def test_what_obspy_says_of_its_processing_is_understood(obspy):
    with pytest.raises(ValueError, match=r"velocity, .*: the channel EHZ"):
        ss.GroundMotion.from_obspy(obspy.read()[0])
    for output, what in (({}, "VEL"), ({"output": "DISP"}, "DISP")):
        one = obspy.read()[0].remove_response(**output)
        with pytest.raises(ValueError, match=f"remove_response had the output {what}"):
            ss.GroundMotion.from_obspy(one)
    right = obspy.read()[0].remove_response(output="ACC").filter("highpass", freq=0.5)
    right.taper(0.1)
    with pytest.warns(ss.PlausibilityWarning, match="the largest acceleration"):  # a quarry
        motion = ss.GroundMotion.from_obspy(right)
    assert np.array_equal(motion.acceleration, right.data)
    with pytest.raises(ValueError, match=r"velocity, .*: integrate was the last"):
        ss.GroundMotion.from_obspy(right.copy().integrate())
    with pytest.raises(ValueError, match="velocity"):
        ss.GroundMotion.from_obspy(obspy.read()[0].remove_sensitivity())


@pytest.mark.slow
@pytest.mark.parametrize("form", ["MSEED", "SLIST", "TSPAIR", "SAC", "GSE2"])
def test_files_that_obspy_reads_obey_the_rules(obspy, tmp_path, form):
    file = tmp_path / "file"
    header = {"delta": 0.01, "network": "XX", "station": "STA", "channel": "HNE"}
    counts = np.array([1, -250, 300, 20], np.int32)
    obspy.Trace(counts, header).write(str(file), format=form)
    if form != "SAC":  # which has floats only
        for more in ({}, {"dt": 0.01}):
            with pytest.raises(ValueError, match=r"XX.STA..HNE: counts, and calib is 1"):
                ss.read_record(file, units="gal", **more)
    if form in ("SLIST", "TSPAIR"):
        text = file.read_text()
        assert text.startswith("TIMESERIES") and "INTEGER" in text
        head, rest = text.split("\n", 1)
        file.write_text(head.replace("INTEGER, ", "FLOAT, M/S") + "\n" + rest)
        with pytest.raises(ValueError, match="states the unit 'M/S', which is none"):
            ss.read_record(file, units="m/s^2")
        file.write_text(head.replace("INTEGER, ", "FLOAT, CM/S**2") + "\n" + rest)
        assert ss.read_record(file).acceleration == pytest.approx(0.01 * counts)
    if form != "GSE2":
        obspy.Trace(0.5 * counts, {**header, "channel": "BHE"}).write(str(file), format=form)
        with pytest.raises(ValueError, match=r"velocity, not acceleration: the channel BHE"):
            ss.read_record(file, units="gal")


@pytest.mark.slow
def test_two_segments_in_a_file_are_no_two_records(obspy, tmp_path):
    header = {"delta": 0.01, "network": "XX", "station": "STA", "channel": "HNE"}
    start = obspy.UTCDateTime(2020, 1, 1)
    samples = np.linspace(0.1, 1, 50)
    parts = [obspy.Trace(samples, {**header, "starttime": start + 10 * k}) for k in range(2)]
    file = tmp_path / "file"
    stream = obspy.Stream(parts)
    stream.write(str(file), format="MSEED")
    for options in ({}, {"component": 1}, {"component": "all"}):
        with pytest.raises(ValueError, match=r"two segments, from 2020-01-01T00:00:00.* and from"):
            ss.read_record(file, units="gal", **options)
    with pytest.raises(ValueError, match=r"a gap, masked value at index 50: from 2020-01-01T00"):
        ss.GroundMotion.from_obspy(stream.merge())


# ---- stations


def knet(direction: str, start: str = "2001/02/03 04:05:21", rate: int = 100) -> str:
    """A file of KiK-net with 200 samples."""
    head = (
        "Origin Time       2001/02/03 04:05:06\nLat.              35.0\nLong.             135.0\n"
        "Depth. (km)       10\nMag.              6.0\nStation Code      XXXH01\n"
        "Station Lat.      35.0\nStation Long.     135.0\nStation Height(m) 10\n"
        f"Record Time       {start}\nSampling Freq(Hz) {rate}Hz\n"
        f"Duration Time(s)  {200 // rate}\nDir.              {direction}\n"
        "Scale Factor      2000(gal)/8388608\nMax. Acc. (gal)   100\n"
        "Last Correction   2001/02/03 04:05:06\nMemo.\n"
    )
    samples = (400000 + 1000 * int(direction)) * np.sin(np.arange(200) / 10) * np.hanning(200)
    rows = [" ".join(f"{n:8.0f}" for n in samples[i : i + 8]) for i in range(0, 200, 8)]
    return head + "\n".join(rows) + "\n"


def test_two_sensors_are_no_station_and_are_named_apart(tmp_path, capsys):
    files = {}
    for number, end in enumerate(("NS1", "EW1", "UD1", "NS2", "EW2", "UD2"), 1):
        files[end] = tmp_path / f"XXXH01.{end}"
        files[end].write_text(knet(str(number)))
    with pytest.raises(ValueError, match=r"same sensor, got borehole \(E\) and surface \(N\)"):
        ss.read_station([files["EW1"], files["NS2"]])
    surface = ss.read_station([files["EW2"], files["NS2"], files["UD2"]])
    assert surface.vertical is not None
    suite = ss.Suite.read(tmp_path, stations=True)
    names = [motion.name for motion in suite]
    assert [("borehole" in name, "surface" in name) for name in names] == [
        (True, False),
        (False, True),
    ]
    assert main(["slide", str(tmp_path), "--station", "--mu", "0.1"]) == 0
    out = capsys.readouterr().out
    assert "XXXH01 borehole" in out and "XXXH01 surface" in out


@pytest.mark.parametrize(
    "start, rate, what",
    [("2001/02/03 04:05:22", 100, "start"), ("2001/02/03 04:05:21", 200, "time step")],
)
def test_other_starts_and_rates_are_no_station(tmp_path, start, rate, what):
    one, other = tmp_path / "a.NS2", tmp_path / "a.EW2"
    one.write_text(knet("4"))
    other.write_text(knet("5", start, rate))
    with pytest.raises(ValueError, match=f"components must have the same {what}, got"):
        ss.read_station([one, other])


def test_numbered_channels_of_seed_are_a_station(tmp_path):
    for channel in ("BH100", "BH200", "BHZ00"):
        (tmp_path / f"{channel}.AT2").write_text(
            "PEER NGA STRONG MOTION DATABASE RECORD\nMade-up, 10/20/2011, CCM, "
            f"{channel}\nACCELERATION TIME HISTORY IN UNITS OF G\nNPTS=  200, DT=    0.05 SEC\n"
            + "\n".join(f"{n:.6e}" for n in np.sin(np.arange(200) / 5) * np.hanning(200))
        )
    (motion,) = ss.Suite.read(tmp_path, stations=True)
    assert (motion.orientation, motion.name) == ("H1", "Made-up, 10/20/2011, CCM, H1")
    assert motion.vertical is not None and motion.transverse is not None
