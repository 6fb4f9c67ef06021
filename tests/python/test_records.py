"""Records from files: formats, units, and errors in files."""

import codecs
import csv
import gzip
import io
import os
import pickle
import subprocess
import sys
import tarfile
import warnings
import zipfile
from pathlib import Path

import numpy as np
import pytest
import stickslip as ss
from pages import ROOT

G = ss.STANDARD_GRAVITY

SAMPLES = [1e-3, -2.5e-2, 0.125, -0.5, 3e-2, 0.0, 1e-3]

AT2 = """PEER NGA STRONG MOTION DATABASE RECORD
Imperial Valley-06, 10/15/1979, Delta, 262
ACCELERATION TIME SERIES IN UNITS OF G
{header}
  .1000000E-02 -.2500000E-01  .1250000E+00 -.5000000E+00  .3000000E-01
  .0000000E+00  .1000000E-02
"""
NEW_HEADER = "NPTS=   7, DT=   .0050 SEC,"
OLD_HEADER = "   7    0.0050    NPTS, DT"

CSV = """# Time Series: Kobe, Japan 1995 - TAK-090
# Time (s),Acceleration (g's)
0.00,0.001
0.01,-0.025
0.02,0.125
0.03,-0.5
"""


@pytest.fixture
def write(tmp_path):
    def to_file(content, name="record.txt"):
        file = tmp_path / name
        file.write_bytes(content if isinstance(content, bytes) else content.encode())
        return file

    return to_file


def change(text, old, new):
    assert old in text
    return text.replace(old, new)


# ---- formats


@pytest.mark.parametrize("header", [NEW_HEADER, OLD_HEADER])
def test_a_peer_file_is_read_in_both_forms_of_its_header(write, header):
    motion = ss.read_record(write(AT2.format(header=header), "RSN169.AT2"))
    assert np.array_equal(motion.acceleration, np.multiply(SAMPLES, G))
    assert motion.dt == 0.005
    assert motion.interpolation == "linear"
    assert motion.name == "Imperial Valley-06, 10/15/1979, Delta, 262"


def test_two_columns_are_seconds_and_acceleration(write):
    motion = ss.read_record(write(CSV))
    assert np.array_equal(motion.acceleration, np.multiply([0.001, -0.025, 0.125, -0.5], G))
    assert motion.dt == 0.01
    assert motion.name == "Kobe, Japan 1995 - TAK-090"


@pytest.mark.parametrize("comma", [";", "\t", "  ", " , "])
def test_columns_are_parted_in_many_ways(write, comma):
    rows = "\n".join(row.replace(",", comma) for row in CSV.splitlines()[2:])
    motion = ss.read_record(write(rows), units="g")
    assert np.array_equal(motion.acceleration, np.multiply([0.001, -0.025, 0.125, -0.5], G))


def test_uneven_times_are_kept(write):
    motion = ss.read_record(write("t, a\n0, 1\n1, 2\n2, 3\n4, 4\n"), units="m/s^2")
    assert motion.dt is None
    assert np.array_equal(motion.time, [0, 1, 2, 4])


@pytest.mark.parametrize(
    "unit, factor",
    [
        ("g", G),
        ("G", G),
        ("m/s^2", 1),
        ("m/s2", 1),
        ("cm/s^2", 0.01),
        ("gal", 0.01),
        ("mm/s/s", 0.001),
        ("ft/s^2", 0.3048),
        ("in/s^2", 0.0254),
    ],
)
def test_units_are_given_or_stated(write, unit, factor):
    rows = "0.0,1\n0.1,2\n"
    expected = np.array([1.0, 2.0]) * factor
    given = ss.read_record(write(rows), units=unit)
    stated = ss.read_record(write(f"Time (s), Acceleration ({unit})\n" + rows))
    assert np.array_equal(given.acceleration, expected)
    assert np.array_equal(stated.acceleration, expected)


@pytest.mark.parametrize(
    "dress",
    [
        lambda text: codecs.BOM_UTF8 + text.encode(),
        lambda text: text.replace("\n", "\r\n").encode(),
        lambda text: codecs.BOM_UTF8 + text.replace("\n", "\r\n").encode() + b"\x1a",
        lambda text: text.rstrip("\n").encode(),
        lambda text: (text + "\n\n").encode(),
        lambda text: text.replace("Kobe", "K\u014dbe").replace("Delta", "Delt\u00e4").encode(),
        lambda text: text.replace("Kobe", "K\u00f4be").encode("latin-1"),
    ],
    ids=["BOM", "CRLF", "BOM, CRLF, DOS end", "no last newline", "blank lines", "UTF-8", "Latin-1"],
)
@pytest.mark.parametrize("text", [CSV, AT2.format(header=NEW_HEADER)], ids=["CSV", "AT2"])
def test_byte_order_marks_line_ends_and_accents_do_not_matter(write, dress, text):
    plain, dressed = ss.read_record(write(text, "a")), ss.read_record(write(dress(text), "b"))
    assert np.array_equal(dressed.acceleration, plain.acceleration)
    assert dressed.dt == plain.dt


def test_the_file_may_be_named_in_any_way_python_names_files(write):
    file = write(CSV)
    for name in (file, str(file), str(file).encode()):
        assert len(ss.read_record(name)) == 4


def test_a_file_with_one_component_calls_it_1(write):
    assert len(ss.read_record(write(CSV), component=1)) == 4
    with pytest.raises(ValueError, match=r"component .* got '2'"):
        ss.read_record(write(CSV), component=2)
    with pytest.raises(ValueError, match=r"component .* got 'north'"):
        ss.read_record(write(CSV), component="north")


# ---- errors in files

PEER = AT2.format(header=NEW_HEADER)
WRONG = {
    "empty": ("", "empty"),
    "blank": ("\n \n\r\n", "empty"),
    "truncated": (PEER[: PEER.index("  .0000000E+00")], "after 5 of the 7 samples"),
    "truncated header": ("\n".join(PEER.splitlines()[:3]), "no known format"),
    "header alone": ("\n".join(PEER.splitlines()[:4]), "after 0 of the 7 samples"),
    "more samples": (PEER + "  .1E+00\n", "line 7: more than the 7 samples"),
    "count too small": (change(PEER, "NPTS=   7", "NPTS=   6"), "line 6: more than the 6 samples"),
    "count too large": (change(PEER, "NPTS=   7", "NPTS=   8"), "after 7 of the 8 samples"),
    "count not whole": (change(PEER, "NPTS=   7", "NPTS= 7.5"), "whole number, got 7.5"),
    "count negative": (change(PEER, "NPTS=   7", "NPTS=  -7"), "whole number, got -7"),
    "count of one": (
        change(PEER[: PEER.index(" -.25")], "NPTS=   7", "NPTS=   1"),
        "at least two samples, got 1",
    ),
    "zero step": (change(PEER, ".0050", ".0000"), "dt must be positive and finite, got 0 s"),
    "negative step": (change(PEER, " .0050", "-.0050"), "dt must be positive .* got -0.005 s"),
    "velocity": (change(PEER, "ACCELERATION", "VELOCITY"), "line 3: .*acceleration.* 'VELOCITY"),
    "unknown units": (change(PEER, "OF G", "OF STONES"), "unknown unit .* 'STONES'; known are g"),
    "text among numbers": (change(PEER, " .1250000E+00", "    missing   "), "line 5: .*'missing"),
    "NaN among numbers": (change(PEER, " .1250000E+00", "          NaN"), "line 5: .*'NaN"),
    "infinity in a row": (change(CSV, "0.125", "inf"), "line 5: .* finite numbers, got 'inf'"),
    "NaN in a row": (change(CSV, "0.125", "nan"), "line 5: .* finite numbers, got 'nan'"),
    "row without a number": (change(CSV, "0.02,0.125", "0.02,"), "line 5: "),
    "row of text": (change(CSV, "0.02,0.125", "end of data"), "line 5: "),
    "three columns": (
        change(CSV, "0.02,0.125", "0.02,0.125,7"),
        "line 5: expected 2 columns .* got 3",
    ),
    "one row": ("t,a\n0.0,0.1\n", "at least two rows"),
    "times that stand still": (
        change(CSV, "0.02", "0.01"),
        "times must increase, got .* after 0.01",
    ),
    "times that turn back": (
        change(CSV, "0.03", "0.005"),
        "times must increase, got .* after 0.02",
    ),
    "unknown units of a column": (change(CSV, "(g's)", "(stone/s2)"), "unknown unit .* 'stone/s2'"),
    "velocity in a column": (change(CSV, "(g's)", "(cm/s)"), "line 2: no column .* a velocity"),
    "no units": ("0.0,0.1\n0.1,0.2\n", 'states no units .* pass units, such as "g"'),
    "prose": ("An earthquake, they say.\nNo number in it.\n", "no known format .* PEER AT2"),
    "another format": ('{"dt": 0.01, "acceleration": [0.1, 0.2]}\n', "no known format"),
    "binary": (bytes(range(256)) * 8, "plain text is needed, got a NUL byte at offset 0"),
    "UTF-16 without its mark": (
        CSV.encode("utf-16-le"),
        r"NUL byte .* \(a binary file, or UTF-16 w",
    ),
}


@pytest.mark.parametrize("content, message", WRONG.values(), ids=WRONG)
def test_what_is_wrong_with_a_file_is_said_with_its_name_and_line(write, content, message):
    with pytest.raises(ValueError, match=r"(?s)read_record: .*odd\.txt: .*" + message):
        ss.read_record(write(content, "odd.txt"))


def test_binary_without_a_zero_byte_is_refused_too(write):
    with pytest.raises(ValueError, match="no known format"):
        ss.read_record(write(bytes(range(128, 256)) * 20))


def test_units_may_be_given_but_not_against_the_file(write):
    assert ss.read_record(write(CSV), units="G").dt == 0.01
    with pytest.raises(ValueError, match=r"the file states .*, units given are 'm/s\^2'"):
        ss.read_record(write(CSV), units="m/s^2")
    with pytest.raises(ValueError, match="unknown unit of acceleration 'parsec'; known are g"):
        ss.read_record(write("0,1\n.1,2\n"), units="parsec")


def test_a_file_that_is_not_there_is_an_error_of_the_system(tmp_path):
    with pytest.raises(FileNotFoundError) as caught:
        ss.read_record(tmp_path / "missing.AT2")
    assert caught.value.filename == str(tmp_path / "missing.AT2")
    with pytest.raises(IsADirectoryError):
        ss.read_record(tmp_path)
    nameless = os.fsdecode(os.fsencode(tmp_path) + b"/\xff.AT2")
    with pytest.raises(FileNotFoundError) as caught:
        ss.read_record(nameless)
    assert caught.value.filename == nameless


@pytest.mark.parametrize("file", [3, None, 2.5, ["record.txt"]])
def test_what_is_no_file_name_is_a_type_error(file):
    with pytest.raises(TypeError):
        ss.read_record(file)


# ---- one column, several columns, gaps

COLUMN = "0.001\n-0.025\n0.125\n-0.5\n"
COLUMNS = "Time (s), NS (g), EW (g), UD (g)\n0,1,2,3\n0.01,4,5,6\n0.02,7,8,9\n"


def test_one_column_is_read_with_the_time_step_that_is_given(write):
    motion = ss.read_record(write(COLUMN), units="g", dt=np.float32(0.25))
    assert motion.dt == 0.25
    assert np.array_equal(motion.acceleration, np.multiply([0.001, -0.025, 0.125, -0.5], G))
    with pytest.raises(ValueError, match="states no time step: pass dt"):
        ss.read_record(write(COLUMN), units="g")
    for bad in (0, -0.01, float("nan"), float("inf")):
        with pytest.raises(ValueError, match="dt must be positive and finite, got"):
            ss.read_record(write(COLUMN), units="g", dt=bad)
    with pytest.raises(ValueError, match=r"a time step of 0.01 s, dt given is, got 0.02 s"):
        ss.read_record(write(CSV), dt=0.02)


def test_all_components_are_a_list(write):
    file = write(COLUMNS)
    motions = ss.read_record(file, component="all")
    assert [m.orientation for m in motions] == ["NS", "EW", "UD"]
    assert [m.acceleration[1] / G for m in motions] == [4, 5, 6]
    for number, motion in enumerate(motions, start=1):
        assert ss.read_record(file, component=number) == motion
        assert ss.read_record(file, component=motion.orientation) == motion
        assert pickle.loads(pickle.dumps(motion)) == motion
    other = write(CSV, "other.csv")
    assert ss.read_record(other, component="all") == [ss.read_record(other)]
    with pytest.raises(ValueError, match="1 NS, 2 EW, 3 UD; got ''"):
        ss.read_record(file)


def test_a_gap_is_refused_unless_it_is_kept(write):
    times = np.round(np.where(np.arange(50) < 30, 0, 0.5) + 0.01 * np.arange(50), 2)
    file = write("t a\n" + "".join(f"{t} 0.1\n" for t in times))
    with pytest.raises(ValueError, match=r"a gap of 0.51 s after 0.29 s.* pass gaps"):
        ss.read_record(file, units="g")
    assert np.array_equal(ss.read_record(file, units="g", gaps=True).time, times)


def test_decimal_commas(write):
    motion = ss.read_record(write("Zeit (s);a (g)\n0,00;0,5\n0,01;-0,25\n"))
    assert np.array_equal(motion.acceleration, [0.5 * G, -0.25 * G])
    assert motion.dt == 0.01


# ---- compressed files, archives, standard input


@pytest.fixture
def archive(tmp_path):
    def of(members, name="records.zip"):
        with zipfile.ZipFile(tmp_path / name, "w", zipfile.ZIP_DEFLATED) as file:
            for member, content in members.items():
                file.writestr(member, content)
        return tmp_path / name

    return of


def test_what_a_file_is_packed_in_does_not_matter(write, archive):
    plain = ss.read_record(write(CSV, "kobe.csv"))
    packed = gzip.compress(CSV.encode())
    for file in (
        write(packed, "kobe.csv.gz"),
        archive({"a/": "", "a/kobe.csv": CSV, "__MACOSX/a/._kobe.csv": b"\0"}),
        archive({"kobe.csv.gz": packed}, "b.zip"),
        f"{archive({'a/kobe.csv': CSV, 'b/other.csv': COLUMN}, 'c.zip')}::a/kobe.csv",
    ):
        assert ss.read_record(file) == plain
    nameless = "0 1\n.1 2\n"
    file = archive({"a/kobe.csv": nameless, "b": ""})
    assert ss.read_record(f"{file}::a/kobe.csv", units="g").name == "kobe"
    assert ss.read_record(write(nameless, "odd::name.txt"), units="g").name == "name"


def tarred(file, members, mode="w:gz"):
    """An archive, as NIED hands them out: with a folder, and with what a Mac adds."""
    with tarfile.open(file, mode) as archive:
        folder = tarfile.TarInfo("event")
        folder.type = tarfile.DIRTYPE
        archive.addfile(folder)
        for name, content in {"event/._x": "mac", **members}.items():
            data = content if isinstance(content, bytes) else content.encode()
            info = tarfile.TarInfo(name)
            info.size = len(data)
            archive.addfile(info, io.BytesIO(data))
    return file


@pytest.mark.parametrize("mode", ["w", "w:gz"])
def test_a_tar_archive_is_read_as_a_zip_archive_is(write, tmp_path, mode):
    plain = ss.read_record(write(CSV, "kobe.csv"))
    file = tarred(tmp_path / "one.tar.gz", {"event/kobe.csv": CSV}, mode)
    assert ss.read_record(file) == plain
    assert ss.read_record(f"{file}::event/kobe.csv") == plain
    packed = tarred(tmp_path / "packed.tar", {"kobe.csv.gz": gzip.compress(CSV.encode())}, mode)
    assert ss.read_record(packed) == plain
    two = tarred(tmp_path / "two.tgz", {"a.csv": CSV, "b.csv": COLUMN}, mode)
    assert ss.read_record(f"{two}::a.csv") == plain
    with pytest.raises(ValueError, match=r"name one as archive.zip::member; .* 2 files: a.csv, b"):
        ss.read_record(two)
    with pytest.raises(ValueError, match=r"no such member; the archive holds 2 files"):
        ss.read_record(f"{two}::c.csv")
    whole = two.read_bytes()
    for cut in (600, len(whole) - 1) if mode == "w:gz" else (1200,):
        with pytest.raises(ValueError, match=r"read_record: .*cut.tar"):
            ss.read_record(f"{write(whole[: min(cut, len(whole) - 1)], 'cut.tar')}::a.csv")


def test_an_archive_within_an_archive_is_named_by_two_members(write, tmp_path, archive):
    inner = tarred(tmp_path / "k.tar.gz", {"a.csv": CSV, "b.csv": CSV}).read_bytes()
    outer = archive({"k.tar.gz": inner, "readme.txt": "x"})
    motion = ss.read_record(f"{outer}::k.tar.gz::b.csv")
    assert motion == ss.read_record(write(CSV, "b.csv"))
    with pytest.raises(ValueError, match=r"name one as archive.zip::member"):
        ss.read_record(f"{outer}::k.tar.gz")
    with pytest.raises(ValueError, match=r"a.csv is not a zip archive, nor a tar archive"):
        ss.read_record(f"{outer}::k.tar.gz::a.csv::c")


def test_the_files_of_an_archive_are_a_station(tmp_path, archive):
    members = {}
    for k, name in enumerate(["262", "352", "UP"], start=1):
        text = AT2.format(header=NEW_HEADER).replace("262", name)
        members[f"{name}.AT2"] = text.replace(" .1250000E+00", f" {0.125 * k:.7E}")
    files = [tmp_path / name for name in members]
    for file, text in zip(files, members.values()):
        file.write_text(text)
    motion = ss.read_station(files, along=30)
    assert ss.read_station(tarred(tmp_path / "s.tar.gz", members), along=30) == motion
    assert ss.read_station(archive(members), along=30) == motion


def test_what_is_wrong_with_an_archive_is_said(write, archive):
    two = archive({"a.csv": CSV, "b.csv": CSV})
    with pytest.raises(ValueError, match=r"name one as archive.zip::member; .* 2 files: a.csv, b"):
        ss.read_record(two)
    with pytest.raises(ValueError, match=r"no such member; the archive holds 2 files: a.csv, b"):
        ss.read_record(f"{two}::c.csv")
    with pytest.raises(ValueError, match="holds 0 files"):
        ss.read_record(archive({}, "empty.zip"))
    with pytest.raises(ValueError, match=r"plain.csv is not a zip archive"):
        ss.read_record(f"{write(CSV, 'plain.csv')}::a.csv")
    with pytest.raises(ValueError, match=r"read_record: .*damaged.zip: "):
        ss.read_record(write(two.read_bytes()[:-30], "damaged.zip"))
    packed = gzip.compress(CSV.encode() * 20)
    for damaged in (packed[:-9], packed[:20] + b"\0\0\0\0" + packed[24:], packed[:2]):
        with pytest.raises(ValueError, match=r"read_record: .*damaged gzip file"):
            ss.read_record(write(damaged, "a.gz"))
    with pytest.raises(FileNotFoundError):
        ss.read_record("missing.zip::a.csv")


def test_a_hyphen_is_standard_input(write):
    script = "import stickslip as ss; print(repr(ss.read_record('-')))"
    result = subprocess.run(
        [sys.executable, "-c", script], input=CSV.encode(), capture_output=True, check=True
    )
    assert result.stdout.decode().strip() == repr(ss.read_record(write(CSV)))


@pytest.mark.skipif(not hasattr(os, "mkfifo"), reason="needs named pipes")
def test_a_pipe_that_may_never_end_is_not_waited_for(tmp_path):
    os.mkfifo(tmp_path / "pipe")
    with pytest.raises(OSError, match="not supported"):
        ss.read_record(tmp_path / "pipe")


def zeros_in(kind, size):
    """A small archive of a large file."""
    import io
    import zlib

    stream = io.BytesIO()
    if kind == "zip":
        with (
            zipfile.ZipFile(stream, "w", zipfile.ZIP_DEFLATED) as archive,
            archive.open("a.txt", "w") as file,
        ):
            for _ in range(size >> 20):
                file.write(b"0\n" * (1 << 19))
        return stream.getvalue()
    packer = zlib.compressobj(1, wbits=31)
    parts = [packer.compress(b"0\n" * (1 << 19)) for _ in range(size >> 20)]
    return b"".join([*parts, packer.flush()])


@pytest.mark.parametrize("kind", ["zip", "gz"])
def test_an_archive_never_fills_the_memory(tmp_path, kind):
    file = tmp_path / f"bomb.{kind}"
    file.write_bytes(zeros_in(kind, 70 << 20))
    assert file.stat().st_size < 400_000
    with pytest.raises(ValueError, match="unpacks to more than 64 MiB; unpack it to read it"):
        ss.read_record(file, units="g", dt=0.01)
    with pytest.raises(ValueError, match="cannot read 1 of 1 files"):
        ss.Suite.read(file, units="g", dt=0.01)


def test_ctrl_c_ends_the_wait_for_a_large_file(tmp_path):
    """The reader is stood in for by a sleep of C, which no interrupt of Python ends."""
    file = tmp_path / "large.txt"
    file.write_text("0.001\n" * 1_600_000)
    code = (
        "import _thread, ctypes, threading, stickslip as ss\n"
        "from stickslip.motions import records\n"
        "def endless(*arguments):\n"
        "    threading.Timer(0.05, _thread.interrupt_main).start()\n"
        "    ctypes.CDLL(None).sleep(600)\n"
        "records._core._parse_components = endless\n"
        "try:\n"
        f"    ss.read_record({str(file)!r}, units='g', dt=.01)\n"
        "except KeyboardInterrupt:\n"
        "    print('interrupted')\n"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, timeout=60)
    assert (done.returncode, done.stdout) == (0, "interrupted\n")


# ---- what ObsPy reads


@pytest.mark.slow
def test_what_obspy_reads_is_read_by_it(tmp_path):
    obspy = pytest.importorskip("obspy", reason="obspy is not installed: pip install obspy")
    samples = np.array([1.0, -2.5, 3.0, 0.5])
    header = {"delta": 0.02, "network": "NZ", "station": "WTMC"}
    north, up = (
        obspy.Trace(factor * samples, {**header, "channel": name})
        for name, factor in (("HNN", 1), ("HNZ", 2))
    )
    file = tmp_path / "two.mseed"
    obspy.Stream([north, up]).write(str(file), format="MSEED")
    motions = ss.read_record(file, units="cm/s^2", component="all")
    assert [m.orientation for m in motions] == ["N", "Z"]
    assert np.array_equal(motions[1].acceleration, 2 * samples * 0.01)
    assert motions[0].name == "NZ.WTMC..HNN"
    assert motions[0].dt == 0.02
    assert ss.read_record(file, units="cm/s^2", component="hnz") == motions[1]
    assert ss.read_record(file, units="cm/s^2", component=1) == motions[0]
    both = ss.read_station(file, units="cm/s^2")
    assert np.array_equal(both.vertical, motions[1].acceleration)
    with pytest.raises(ValueError, match=r"ObsPy .* does not state its units: pass units"):
        ss.read_record(file, component=1)
    with pytest.raises(ValueError, match="available: 1 HNN, 2 HNZ; got ''"):
        ss.read_record(file, units="g")
    north.write(str(file), format="SAC")  # binary, too
    assert len(ss.read_record(file, units="g")) == 4


def test_without_obspy_its_formats_are_unknown(write, monkeypatch):
    monkeypatch.setitem(sys.modules, "obspy", None)
    with pytest.raises(ValueError, match="plain text is needed, got a NUL byte"):
        ss.read_record(write(b"000001D \0\0\0x"), units="g")


# ---- stations


def test_the_files_of_a_station_are_one_motion(write):
    def component(name, factor):
        text = AT2.format(header=NEW_HEADER).replace("262", name)
        return write(text.replace(" .1250000E+00", f" {0.125 * factor:.7E}"), f"{name}.AT2")

    files = [component(name, k) for k, name in enumerate(["262", "352", "UP"], start=1)]
    motion = ss.read_station(files)
    one, two, up = (ss.read_record(file) for file in files)
    assert np.array_equal(motion.acceleration, one.acceleration)
    assert np.array_equal(motion.transverse, two.acceleration)
    assert np.array_equal(motion.vertical, up.acceleration)
    assert motion.orientation == "262"
    assert motion.name == "Imperial Valley-06, 10/15/1979, Delta, 262"
    assert ss.read_station(files, along=262) == ss.read_station(files, along="262") == motion
    other = ss.read_station(reversed(files), along="352")
    assert np.array_equal(other.acceleration, two.acceleration)
    assert np.array_equal(other.transverse, -np.asarray(one.acceleration))
    between = ss.read_station(files, along=292.0)
    np.testing.assert_allclose(between.acceleration, motion.rotated(30).acceleration, atol=1e-14)
    assert between.orientation == "292"
    with pytest.raises(ValueError, match=r"one of the horizontal components \(262, 352\)"):
        ss.read_station(files, along="fault normal")
    for bad in (float("nan"), float("inf")):
        with pytest.raises(ValueError, match="along must be a finite azimuth"):
            ss.read_station(files, along=bad)
    with pytest.raises(TypeError):
        ss.read_station(files, along=[262])


def test_the_axis_of_a_station_is_a_component_by_name_or_number(write):
    table = write(COLUMNS)
    one, two = (ss.read_station(table, along=name) for name in ("NS", "EW"))
    assert ss.read_station(table, component=1) == ss.read_station(table, component="ns") == one
    assert ss.read_station(table, component=2) == ss.read_station(table, component="2") == two
    assert one != two
    # A number of `along` is an azimuth, as before.
    assert ss.read_station(table, along=0.0).orientation == "NS"
    assert ss.read_station(table, along=2).orientation == "2"
    turned = ss.read_station(table, component=2, orientations=[10, 100, "up"])
    assert turned.orientation == "100"
    for chosen in (0, 4, -1, "", "Z9"):
        with pytest.raises(ValueError, match=r"name or number of one component.*1 NS, 2 EW, 3 UD"):
            ss.read_station(table, component=chosen)
    with pytest.raises(ValueError, match="must be a horizontal one, but 3 UD points 'UD'"):
        ss.read_station(table, component=3)
    with pytest.raises(ValueError, match="along and component must not both be given"):
        ss.read_station(table, component=1, along=0)
    with pytest.raises(TypeError):
        ss.read_station(table, component=1.5)


def test_orientations_and_a_common_length_may_be_given(write):
    one, two = write(COLUMN, "a.txt"), write(COLUMN + "0.25\n", "b.txt")
    options = {"units": "g", "dt": 0.01}
    with pytest.raises(ValueError, match="a does not say; give its orientation"):
        ss.read_station([one, two], **options)
    with pytest.raises(ValueError, match=r"number of samples .* got 4 \(45\) and 5"):
        ss.read_station([one, two], orientations=[45, 315], **options)
    motion = ss.read_station([one, two], orientations=[45, "315"], common_length=True, **options)
    assert len(motion) == 4
    assert np.array_equal(motion.transverse, -np.asarray(motion.acceleration))
    with pytest.raises(ValueError, match="as many as components, 2, got 1"):
        ss.read_station([one, two], orientations=[45], **options)
    with pytest.raises(ValueError, match="orientations must not be empty"):
        ss.read_station([one, two], orientations=[45, ""], **options)


def test_a_station_of_one_file(write):
    motion = ss.read_station(write(COLUMNS))
    assert np.array_equal(motion.vertical, np.multiply([3, 6, 9], G))
    assert motion.orientation == "NS"


def test_real_pairs_are_stations(agency_files):
    pairs = agency_files / "usgs_pairs"
    if not pairs.exists():
        pytest.skip("no usgs_pairs among the agency files")
    with (pairs / "pairs.csv").open() as stream:
        rows = list(csv.DictReader(stream))
    for first, second in zip(rows[::2], rows[1::2]):
        azimuths = [float(row["component_deg"]) for row in (first, second)]
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", ss.PlausibilityWarning)  # some have an offset
            motion = ss.read_station(
                [pairs / row["file"] for row in (first, second)],
                orientations=azimuths,
                units="g",
                dt=float(first["dt_s"]),
            )
        assert len(motion) == int(first["samples"])
        peaks = [motion.component(c).peak_acceleration / G for c in ("axis", "transverse")]
        for peak, row in zip(peaks, (first, second)):
            assert peak == pytest.approx(float(row["pga_g"]), abs=5.1e-4), row["file"]


def test_a_real_station_of_geonet(agency_files):
    for file in agency_files.glob("geonet/20161113_110259_WTMC_20.V2A"):
        motion = ss.read_station(file, along="S62W")
        assert motion.peak_acceleration == pytest.approx(7.9664, abs=0.06e-3)
        assert motion.component("vertical").peak_acceleration == pytest.approx(18.0219, abs=6e-5)
        assert motion.name.endswith("Te Mara Farm Waiau, S62W")
        return
    pytest.skip("no geonet/20161113_110259_WTMC_20.V2A among the agency files")


# ---- the table of formats


def test_the_table_of_formats_is_that_of_the_page():
    page = (ROOT / "docs" / "ground_motions.md").read_text(encoding="utf-8")
    formats = ss.record_formats()
    rows = [f"| {' | '.join(row.values())} |".replace("|  |", "| |") for row in formats]
    assert "\n".join(rows) in page


def test_the_error_names_all_formats(write):
    with pytest.raises(ValueError, match="no known format") as caught:
        ss.read_record(write("nothing"))
    assert all(row["name"] in str(caught.value) for row in ss.record_formats())


# ---- bytes that are no UTF-8

NO_UTF8 = {
    "a surrogate": b"\xed\xa0\x80",
    "the last surrogate": b"\xed\xbf\xbf",
    "overlong, two bytes": b"\xc1\xbf",
    "overlong, three bytes": b"\xe0\x9f\xbf",
    "overlong, four bytes": b"\xf0\x8f\xbf\xbf",
    "beyond Unicode": b"\xf4\x90\x80\x80",
    "five bytes": b"\xf8\x88\x80\x80\x80",
    "cut off": b"\xe2\x82",
    "a continuation alone": b"\x80",
}


@pytest.mark.parametrize("odd", NO_UTF8.values(), ids=NO_UTF8)
def test_names_and_messages_are_text_whatever_the_bytes(write, odd):
    motion = ss.read_record(write(b"# a " + odd + b" x\n# units: g\n0,1\n.1,2\n"))
    assert motion.name.encode("utf-8").startswith(b"a ")
    assert motion.name.endswith(" x")
    assert motion.name in repr(motion)
    assert pickle.loads(pickle.dumps(motion)) == motion
    with pytest.raises(ValueError, match="expected finite numbers, got") as caught:
        ss.read_record(write(b"# units: g\n0,1\n1," + odd + b"\n"))
    assert type(caught.value) is ValueError
    assert str(caught.value).encode("utf-8")


FIRST_AND_LAST = ["\u00a1\u07ff", "\u0800\ud7ff\ue000\uffff", "\U00010000\U0010ffff"]


@pytest.mark.parametrize("text", FIRST_AND_LAST, ids=["two bytes", "three", "four"])
def test_utf8_of_every_length_is_kept(write, text):
    assert ss.read_record(write(f"# {text}\n# units: g\n0,1\n.1,2\n".encode())).name == text


@pytest.mark.skipif(sys.platform != "linux", reason="where file names are bytes")
def test_a_file_name_may_be_any_bytes(tmp_path):
    file = Path(os.fsdecode(bytes(tmp_path) + b"/\xff\xed\xa0\x80.csv"))
    for name in (file, str(file), os.fsencode(file)):
        file.write_bytes(b"# units: g\n0,1\n.1,2\n")
        motion = ss.read_record(name)
        assert motion.name.encode("utf-8")
        assert motion.name in repr(motion)
        assert pickle.loads(pickle.dumps(motion)) == motion
        file.write_bytes(b"0,1\n.1,2\n")
        with pytest.raises(ValueError, match=r"[.]csv: the file states no units") as caught:
            ss.read_record(name)
        assert type(caught.value) is ValueError
    file.unlink()
    with pytest.raises(FileNotFoundError) as missing:
        ss.read_record(file)
    assert missing.value.filename == str(file)


# ---- real records


def test_real_records_read_as_numpy_reads_them(pyslammer_files):
    for file in pyslammer_files:
        t, a = np.loadtxt(file, delimiter=",", usecols=(0, 1), unpack=True, encoding="utf-8-sig")
        motion = ss.read_record(file)
        assert len(motion) == len(a), file.name
        assert np.array_equal(motion.acceleration, a * G), file.name
        assert motion.peak_acceleration == np.max(np.abs(a * G)), file.name
        # the times are printed with a few digits: dt is the mean step to half a unit of the last
        assert motion.dt == pytest.approx((t[-1] - t[0]) / (len(t) - 1), rel=1e-6), file.name
        assert motion.dt in (0.005, 0.01, 0.02), file.name


def test_geonet_three_components(agency_files):
    # Peaks as the file's own heading says, in mm/s^2 and to its digits.
    for file in agency_files.glob("geonet/20161113_110259_WTMC_20.V2A"):
        for number, (name, peak) in enumerate(
            [("N28W", 9733.1), ("S62W", 7966.4), ("Up", 18021.9)], start=1
        ):
            motion = ss.read_record(file, component=name)
            assert motion.dt == 0.02
            assert len(motion) == 8192
            assert motion.peak_acceleration == pytest.approx(peak / 1000, abs=0.06e-3)
            twin = ss.read_record(file, component=number)
            assert np.array_equal(motion.acceleration, twin.acceleration)
        with pytest.raises(ValueError, match="1 N28W, 2 S62W, 3 Up"):
            ss.read_record(file)
        return
    pytest.skip("no geonet/20161113_110259_WTMC_20.V2A among the agency files")


def test_smc(agency_files):
    # Number of points, sampling rate and peak as the file's header says: 6001, 200 1/s, 104.4078
    # cm/s^2; the samples are printed to 0.01 cm/s^2.
    for file in agency_files.glob("smc/0111a.smc"):
        motion = ss.read_record(file)
        assert (len(motion), motion.dt) == (6001, 0.005)
        assert motion.peak_acceleration == pytest.approx(1.044078, abs=0.5e-4)
        return
    pytest.skip("no smc/0111a.smc among the agency files")


def test_cosmos(agency_files):
    for file in agency_files.glob("cosmos/akbmr_bnz.v2c"):
        motion = ss.read_record(file)
        assert (len(motion), motion.dt) == (42000, 0.005)
        assert "Point MacKenzie" in motion.name
        return
    pytest.skip("no cosmos/akbmr_bnz.v2c among the agency files")


# ---- warnings


def written(file, acceleration, dt=0.01, unit="m/s^2"):
    rows = "\n".join(f"{i * dt:.6g}, {a:.17g}" for i, a in enumerate(acceleration))
    file.write_text(f"Time (s), Acceleration ({unit})\n{rows}\n")
    return file


WAVE = np.sin(2 * np.pi * np.arange(401) / 40)  # whole periods: no mean


def test_a_record_that_is_hardly_one_is_warned_of(tmp_path):
    file = tmp_path / "a.csv"
    for factor in (0.0002, 1, 29):
        ss.read_record(written(file, factor * WAVE))
    for factor in (9e-5, 30, 981, 0):
        with pytest.warns(ss.PlausibilityWarning, match=r"outside 0.0001 to 29.4 m/s\^2.*units"):
            record = ss.read_record(written(file, factor * WAVE))
        assert record.peak_acceleration == pytest.approx(factor, abs=1e-12)
    ss.read_record(written(file, WAVE + 0.0049))
    for offset in (-0.0052, 0.0052, 0.5):
        with pytest.warns(ss.PlausibilityWarning, match=r"the mean acceleration.*detrended"):
            record = ss.read_record(written(file, WAVE + offset))
        ss.read_record(written(file, record.detrended().acceleration))
    ss.read_record(written(file, 100 + WAVE[:99]))  # too few to be a record
    with pytest.raises(ss.PlausibilityWarning):  # the filter of these tests
        ss.read_record(written(file, 100 * WAVE))
    assert issubclass(ss.PlausibilityWarning, UserWarning)


@pytest.mark.parametrize(
    "dt, samples, what",
    [
        (1, 401, "time step = 1 s"),
        (1e-4, 20001, "time step = 0.0001 s"),
        (0.0005, 1001, "duration"),
    ],
)
def test_an_implausible_clock_is_warned_of(tmp_path, dt, samples, what):
    wave = np.sin(2 * np.pi * np.arange(samples) / (samples - 1))
    file = tmp_path / "a.txt"
    np.savetxt(file, wave)
    with pytest.warns(ss.PlausibilityWarning, match=f"{what}.*check"):
        ss.read_record(file, units="m/s^2", dt=dt)


def test_an_array_that_is_hardly_a_record_is_warned_of():
    for factor in (0, 0.0002, 1, 29):
        ss.GroundMotion(factor * WAVE, dt=0.01)
    for factor in (9e-5, 30, 981):
        with pytest.warns(ss.PlausibilityWarning, match=r"^GroundMotion: .*m/s\^2.*units") as said:
            ss.GroundMotion(factor * WAVE, dt=0.01)
        assert [warning.filename for warning in said] == [__file__]
    with pytest.warns(ss.PlausibilityWarning, match=r"^GroundMotion \(cm\): .*check the units"):
        ss.GroundMotion(100 * WAVE, dt=0.01, name="cm")
    ss.GroundMotion(100 * WAVE, dt=0.01, units="cm/s^2")
    ss.GroundMotion(100 * WAVE[:99], dt=0.01)
    # An offset shows if a motion begins and ends at rest; else its mean may be its own.
    ss.GroundMotion(WAVE + 0.5, dt=0.01)
    for seed in range(50):
        ss.GroundMotion(np.random.default_rng(seed).normal(size=400), dt=0.01)
    at_rest = np.concatenate([np.zeros(10), WAVE, np.zeros(10)])
    ss.GroundMotion(at_rest + 0.0049, dt=0.01)
    for offset in (-0.0052, 0.0052, 0.5):
        with pytest.warns(ss.PlausibilityWarning, match=r"the mean acceleration.*detrended"):
            ss.GroundMotion(at_rest + offset, dt=0.01)


def test_what_was_read_is_not_warned_of_again(tmp_path):
    # Neither by a pickle nor by the functions that change a motion.
    with pytest.warns(ss.PlausibilityWarning):
        motion = ss.GroundMotion(981 * WAVE, dt=0.01)
    assert pickle.loads(pickle.dumps(motion)) == motion
    assert (motion / 981 * 981).cut(0, 2).dt == motion.dt
    file = tmp_path / "suite.h5"
    ss.Suite([motion]).save(file)
    assert ss.Suite.open(file)[0] == motion


def test_real_records_are_plausible_and_with_an_offset_they_are_not(pyslammer_files, tmp_path):
    # Without a warning, which would be an error here. The offset of 0.01 g that no one saw.
    records = {file.stem: ss.read_record(file) for file in pyslammer_files}
    assert max(abs(r.velocity[-1]) / r.duration / r.peak_acceleration for r in records.values()) < (
        2e-4
    )
    kobe = records["Kobe_1995_TAK-090"]
    shifted = np.asarray(kobe.acceleration) + 0.01 * ss.STANDARD_GRAVITY
    with pytest.warns(ss.PlausibilityWarning, match=r"0.5 % of the peak"):
        ss.GroundMotion(shifted, dt=kobe.dt)
    with pytest.warns(ss.PlausibilityWarning, match=r"0.5 % of the peak"):
        off = ss.read_record(written(tmp_path / "kobe.csv", shifted, kobe.dt))
    peaks = [ss.integrate(ss.Coulomb(mu=0.1), q, settle=True).peak for q in (kobe, off)]
    assert np.round(peaks, 2).tolist() == [0.29, 0.55]  # docs/ground_motions.md
    fraction = 0.01 * ss.STANDARD_GRAVITY / kobe.peak_acceleration
    assert fraction == pytest.approx(0.016, abs=5e-4)
