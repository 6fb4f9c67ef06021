"""HDF5 files in which damage is found."""

import numpy as np
import pytest

h5py = pytest.importorskip("h5py")

from stickslip._hdf5 import creating, opening, read, read_columns, write, write_columns  # noqa: E402

NUMBERS = np.random.default_rng(3).normal(size=(40, 7, 2))
TEXTS = ["Kobe", "Tabas", "", "é, ß"]
COLUMNS = {"magnitude": np.array([6.9, 7.4, np.nan, 5.0]), "a/b": TEXTS, "rank": [1, 2, 3, 4]}


@pytest.fixture
def file(tmp_path):
    path = tmp_path / "x.h5"
    with creating(path, "form 1", "test") as h5:
        write(h5, "numbers", NUMBERS)
        write(h5, "texts", TEXTS)
        write(h5, "nothing", np.zeros(0))
        write_columns(h5, "columns", COLUMNS)
    return path


def contents(path):
    with opening(path, "form 1", "test") as h5:
        return (
            read(h5, "numbers", NUMBERS.shape),
            read(h5, "texts", (4,)),
            read(h5, "nothing"),
            read_columns(h5, "columns", 4),
        )


def test_arrays_and_columns_come_back(file):
    numbers, texts, nothing, columns = contents(file)
    assert np.array_equal(numbers, NUMBERS)
    assert texts.tolist() == TEXTS
    assert nothing.size == 0
    assert list(columns) == list(COLUMNS)
    for name, column in columns.items():
        assert column.dtype.kind == np.asarray(COLUMNS[name]).dtype.kind or name == "a/b"
        assert np.array_equal(column.astype(str), np.asarray(COLUMNS[name]).astype(str))


def test_every_changed_byte_is_found_or_changes_nothing(file):
    """Bytes of padding may change; values may not."""
    whole, expected = file.read_bytes(), contents(file)
    found = 0
    for place in range(0, len(whole), 131):
        damaged = bytearray(whole)
        damaged[place] ^= 0x10
        file.write_bytes(damaged)
        try:
            numbers, texts, _, columns = contents(file)
        except ValueError:
            found += 1
            continue
        assert np.array_equal(numbers, expected[0]), place
        assert texts.tolist() == TEXTS, place
        assert columns.keys() == expected[3].keys(), place
        for name, column in columns.items():
            assert column.tolist() == pytest.approx(expected[3][name].tolist(), nan_ok=True), place
    assert found > NUMBERS.nbytes // 131


@pytest.mark.parametrize(
    "change, message",
    [
        (lambda h5: h5.__delitem__("texts"), "texts"),
        (lambda h5: rewritten(h5, "numbers", NUMBERS[:2]), r"must have shape .*, has \(2, 7, 2\)"),
        (lambda h5: rewritten(h5["columns"], "rank", [1, 2]), r"'rank' must have shape \(4,\)"),
        (lambda h5: linked(h5, h5py.ExternalLink("other.h5", "numbers")), "is a link"),
        (lambda h5: linked(h5, h5py.SoftLink("/nothing")), "is a link"),
        (lambda h5: h5["texts"].__setitem__(1, "Tabus"), "checksum of 'texts' differs"),
        (lambda h5: h5["texts"].attrs.__delitem__("crc32"), "crc32"),
        (lambda h5: h5.attrs.__setitem__("format", "other"), "must be of format 'form 1', got"),
    ],
)
def test_rewritten_files_are_refused(file, change, message):
    with h5py.File(file, "r+") as h5:
        change(h5)
    with pytest.raises(ValueError, match=message):
        contents(file)


def rewritten(group, name, values):
    del group[name]
    group[name] = values


def linked(h5, link):
    del h5["numbers"]
    h5["numbers"] = link
