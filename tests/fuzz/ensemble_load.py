"""Fuzz `Ensemble.load`: damaged and edited files raise ValueError, or load to what may be.

python tests/fuzz/ensemble_load.py [--seconds S] [--seed N]

Bytes of valid files are flipped, cut off and moved: such a file must raise ValueError or load with
the bits that were saved. Arrays are edited and saved with right checksums: such a file must raise
ValueError or load to an ensemble whose peaks, sums and members are possible, and which can be
saved, resumed from and asked for its statistics. Memory is limited to 500 MB. A case that fails is
printed in base64; nothing is written. A file is the same for the same seed and case.
"""

import argparse
import base64
import io
import json
import math
import os
import pickle
import resource
import sys
import tempfile
import time
import zipfile
from collections.abc import Callable
from contextlib import suppress
from pathlib import Path

import numpy as np
import stickslip as ss

SLIDER = ss.Coulomb(slip_level=2.0)
BAND = ss.Spectrum.band_pass(s0=1.0, low=2.0, high=12.0)
EXCITATION = ss.GaussianExcitation(BAND, dt=0.1, samples=64, period=256)
MEMORY = 500 * 2**20  # bytes beyond those of the libraries

# As edges of types, ranges and blocks.
NUMBERS = [
    *(0, 1, -1, 2, 3, 7, 8, 63, 64, 65, 128, 2**24, 2**24 + 1, 2**31 - 1, 2**32, 2**53),
    *(2**57, 2**58, 2**60, 2**61, 2**63 - 1, 2**63, 2**64 - 64, 2**64 - 1),
    *(0.1, -0.0, 5e-324, 1e-200, 1e34, 1e142, 1e285, 1e308, math.inf, -math.inf, math.nan),
]


def run(members: int, first: int = 0, spectrum: bool = True) -> ss.Ensemble:
    return ss.run_ensemble(
        SLIDER,
        EXCITATION,
        members=members,
        first_member=first,
        seed=1,
        velocity_spectrum=spectrum,
        threads=1,
    )


def valid() -> list[ss.Ensemble]:
    """One block, a part of one, several parts, no spectrum, no times, peaks that are counted."""
    several = run(64)
    several.merge(run(200, 640))
    counted = run(200)
    state = counted.__getstate__()
    state |= {"bin": np.array([-5, 9], "i4"), "bin_count": np.array([190, 10], "u8")}
    for name in ("kept_block", "kept_size", "peak", "residual"):
        state[name] = state[name][:0]
    counted.__setstate__(state)
    records = [EXCITATION.sample(seed=1, member=0), ss.GroundMotion([1.0, 9.0, -3.0], dt=0.5)]
    timeless = ss.run_ensemble(SLIDER, records, members=70, seed=1, threads=1)
    return [run(64), run(3), several, run(130, spectrum=False), timeless, counted]


def saved(ensemble: ss.Ensemble, file: Path) -> bytes:
    ensemble.save(file)
    return file.read_bytes()


def damage(content: bytes, random: np.random.Generator) -> bytes:
    """Flip, cut off, insert, remove or repeat some bytes."""
    data = bytearray(content)
    for _ in range(int(random.integers(1, 4))):
        place = int(random.integers(len(data)))
        if random.random() < 0.5:  # in the table of contents, or a header
            place = int(random.choice([len(data) - 1 - place % 1500, place % 200])) % len(data)
        length = int(random.integers(1, 64))
        match random.integers(6):
            case 0:
                data[place] ^= 1 << int(random.integers(8))
            case 1:
                data[place] = int(random.integers(256))
            case 2:
                del data[place:]
            case 3:
                del data[place : place + length]
            case 4:
                data[place:place] = random.bytes(length)
            case 5:
                data[place : place + length] = data[:length]
        if not data:
            break
    return bytes(data)


def edit(content: bytes, random: np.random.Generator) -> bytes:
    """Edit arrays, and save them with checksums that are right."""
    with np.load(io.BytesIO(content)) as arrays:
        state = dict(arrays)
    for _ in range(int(random.integers(1, 4))):
        name = str(random.choice(list(state)))
        with suppress(OverflowError, TypeError, ValueError):  # what NumPy cannot make
            state[name] = edit_array(state[name], random)
        if random.random() < 0.1:
            state[name] = state.pop(str(random.choice(list(state))))
        if not state:
            break
    stream = io.BytesIO()
    save = np.savez_compressed if random.random() < 0.02 else np.savez
    save(stream, **state)
    if random.random() < 0.1:  # the text of a header
        return rewritten(stream.getvalue(), random)
    return stream.getvalue()


def edit_array(array: np.ndarray, random: np.random.Generator) -> np.ndarray:
    if array.dtype.kind == "U":
        return np.array(edit_text(str(array), random))
    with np.errstate(all="ignore"):
        number = np.array(random.choice(np.array(NUMBERS, object))).item()
        match random.integers(8):
            case 0:
                return array[..., : array.shape[-1] // 2] if array.ndim else array.reshape(1)
            case 1:
                return np.concatenate([array, array], axis=-1) if array.ndim else array + 1
            case 2:
                return array.astype(random.choice(["f4", "f8", "i8", "u8", "u1", "?", "S3", "U3"]))
            case 3:
                return array.reshape(-1)
            case 4:
                return array[::-1].copy() if array.ndim else -array
            case 5:
                return np.asfortranarray(array)
            case _:
                return with_number(array, number, random)


def with_number(array: np.ndarray, number: float, random: np.random.Generator) -> np.ndarray:
    """One entry, or all, replaced."""
    changed = np.array(array)
    if not changed.size:
        return np.array([number], array.dtype.kind if array.dtype.kind == "f" else None)
    if random.random() < 0.2:
        changed[...] = number
    else:
        changed.flat[int(random.integers(changed.size))] = number
    return changed


def edit_text(text: str, random: np.random.Generator) -> str:
    place = int(random.integers(len(text) + 1))
    match random.integers(5):
        case 0:
            return text[:place]
        case 1:
            return text[:place] + chr(int(random.integers(1, 0xD7FF))) + text[place:]
        case 2:
            return text.replace(str(random.integers(10)), str(random.integers(10)))
        case 3:
            return "[" * int(random.integers(1, 200_000)) + text
        case _:
            try:
                entries = json.loads(text)
                entries[int(random.integers(len(entries)))][1] = str(random.choice(NUMBERS))
                return json.dumps(entries)
            except (IndexError, RecursionError, TypeError, ValueError):
                return text + text


def rewritten(content: bytes, random: np.random.Generator) -> bytes:
    """Bytes of an entry changed, with a checksum that is right."""
    stream = io.BytesIO()
    with zipfile.ZipFile(io.BytesIO(content)) as old, zipfile.ZipFile(stream, "w") as new:
        chosen = random.choice(old.namelist())
        for info in old.infolist():
            data = bytearray(old.read(info))
            if info.filename == chosen:
                data[int(random.integers(min(len(data), 128)))] = int(random.integers(32, 127))
            new.writestr(info.filename, bytes(data))
    return stream.getvalue()


def same_bits(a: ss.Ensemble, b: ss.Ensemble) -> bool:
    left, right = a.__getstate__(), b.__getstate__()
    return all(
        np.array_equal(np.asarray(left[name]), np.asarray(right[name])) for name in left | right
    )


def check_possible(ensemble: ss.Ensemble, file: Path) -> None:
    """Whether an ensemble is consistent, finite, and of use."""
    members = sum(end - begin for begin, end in ensemble.member_ranges)
    assert members == ensemble.members, f"{members} members of {ensemble.members}"
    state = ensemble.__getstate__()
    assert np.isfinite(state["sums"]).all(), "sums"
    assert np.isfinite(state["residual"]).all(), "residuals"
    assert (state["peak"] >= 0).all() and np.isfinite(state["peak"]).all(), "peaks"
    assert same_bits(pickle.loads(pickle.dumps(ensemble)), ensemble), "pickle"
    ensemble.save(file)
    assert same_bits(ss.Ensemble.load(file), ensemble), "saved again"
    repr(ensemble)
    dict(ensemble.configuration)
    if members >= 2:
        low = ensemble.quantile(0.5)
        assert 0 <= low.low <= low.value <= low.high
    if members >= 2 and ensemble.time.size:
        for values in (ensemble.displacement_variance, ensemble.velocity_mean):
            assert np.isfinite(values).all(), "statistics"
        assert (ensemble.velocity_variance >= -1e-300).all(), "variances"
        assert np.isfinite(ensemble.displacement_variance_error).all(), "errors"
        assert ensemble.stationary.velocity_variance.value >= -1e-300
    try:
        ensemble.merge(run(64, 64 * 1000))
    except ValueError:  # of another configuration
        pass
    else:
        assert np.isfinite(ensemble.__getstate__()["sums"]).all(), "merged"


def case(seed: int, number: int, seeds: list[tuple[ss.Ensemble, bytes]]) -> tuple[bytes, Callable]:
    """The content of a file, and the check of what it loads to."""
    random = np.random.default_rng([seed, number])
    ensemble, content = seeds[int(random.integers(len(seeds)))]
    if random.random() < 0.5:
        return damage(content, random), lambda loaded, file: same_or_fail(loaded, ensemble)
    return edit(content, random), check_possible


def same_or_fail(loaded: ss.Ensemble, ensemble: ss.Ensemble) -> None:
    assert same_bits(loaded, ensemble), "damage changed bits"


def fuzz(seconds: float, seed: int, folder: Path) -> int:
    file = folder / "run.npz"
    seeds = [(ensemble, saved(ensemble, file)) for ensemble in valid()]
    limit_memory()
    began, cases, loaded = time.monotonic(), 0, 0
    while not seconds or time.monotonic() - began < seconds:
        content, check = case(seed, cases, seeds)
        file.write_bytes(content)
        try:
            try:
                ensemble = ss.Ensemble.load(file)
            except ValueError as error:
                assert str(file) in str(error), "the error does not name the file"
            else:
                loaded += 1
                check(ensemble, file)
        except Exception as error:
            print(f"ensemble_load: seed {seed}, case {cases}: {type(error).__name__}: {error}")
            print(base64.b64encode(content).decode())
            return 1
        cases += 1
    speed = cases / max(time.monotonic() - began, 1e-9)
    print(f"ensemble_load: seed {seed}: {cases} cases, {loaded} loaded, {speed:.0f} cases/s")
    return 0


def limit_memory() -> None:
    try:
        pages = int(Path("/proc/self/statm").read_text().split()[0])
    except OSError:  # no Linux
        return
    limit = pages * resource.getpagesize() + MEMORY
    resource.setrlimit(resource.RLIMIT_AS, (limit, resource.RLIM_INFINITY))


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--seconds", type=float, default=10.0, help="0: without end (default 10)")
    parser.add_argument("--seed", type=int, default=0, help="random seed (default 0)")
    args = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        return fuzz(args.seconds, args.seed, Path(folder))


if __name__ == "__main__":
    os.environ.setdefault("PYTHONWARNINGS", "ignore")
    sys.exit(main())
