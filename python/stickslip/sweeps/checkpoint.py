"""The file from which a sweep resumes."""

from __future__ import annotations

import hashlib
import json
import os
import time
import warnings
import zipfile
from pathlib import Path
from typing import Any

import numpy as np

from .._core import GroundMotion
from .._files import check_writable, replacing
from ..ensemble.sources import AnySlider
from .error import SweepError
from .table import SweepFailure, SweepTable

_FORMAT = "stickslip sweep 2"


class Checkpoint:
    """The file that saves the progress of a sweep; inactive if no file is given."""

    def __init__(
        self,
        file: str | os.PathLike[str] | None,
        every: float,
        sliders: list[AnySlider],
        motions: list[GroundMotion],
        how: dict[str, Any],
    ) -> None:
        if not every >= 0:
            raise ValueError(f"sweep: checkpoint_every must be at least 0, got {every} s")
        self.file = None if file is None else Path(os.fspath(file))
        self.every = every
        self.saved = time.monotonic()
        self.warned = False
        self.key = ""
        if self.file is not None:
            check_writable(self.file)
            self.key = _key(sliders, motions, how)

    def load(self, table: SweepTable) -> None:
        """Fill the table from the file, if it exists."""
        if self.file is None or not self.file.exists():
            return
        try:
            with self.file.open("rb") as stream, np.load(stream, allow_pickle=False) as kept:
                if str(kept["format"]) != _FORMAT:
                    raise ValueError(f"is of format '{kept['format']}', not '{_FORMAT}'")
                if str(kept["key"]) != self.key:
                    raise ValueError(
                        "is of another sweep: other sliders, motions, polarity, settle or contact"
                    )
                done = kept["done"]
                values = {name: kept[name] for name in table.arrays()}
                failures = json.loads(str(kept["failures"]))
                shapes = {array.shape for array in values.values()}
                if shapes != {table.peak.shape} or done.shape != table.done.shape:
                    raise ValueError("is damaged: its arrays have other shapes")
        except (KeyError, EOFError, zipfile.BadZipFile, ValueError) as error:
            raise ValueError(f"sweep: checkpoint '{self.file}' {error}") from error
        for name, array in values.items():
            table.arrays()[name][...] = array
        table.done[...] = done
        table.failures = tuple(SweepFailure(*one) for one in failures)

    def save_if_due(self, table: SweepTable) -> None:
        """Save if `every` seconds have passed; after a failure, warn once and retry later."""
        if self.file is None or time.monotonic() - self.saved < self.every:
            return
        try:
            self._write(table)
        except OSError as error:
            if not self.warned:
                self.warned = True
                warnings.warn(
                    f"sweep: cannot write checkpoint '{self.file}': {error}; the run continues and"
                    f" retries every {self.every:g} s",
                    RuntimeWarning,
                    stacklevel=4,
                )
        self.saved = time.monotonic()

    def save(self, table: SweepTable) -> None:
        """Save the final state; an error carries the table."""
        if self.file is None:
            return
        try:
            self._write(table)
        except OSError as error:
            raise SweepError(
                f"sweep: cannot write checkpoint '{self.file}': {error}; .partial has the"
                f" {int(table.done.sum())} records that are done",
                range(0),
                table,
            ) from error

    def _write(self, table: SweepTable) -> None:
        assert self.file is not None
        with replacing(self.file) as stream:
            np.savez(
                stream,
                format=_FORMAT,
                key=self.key,
                done=table.done,
                failures=json.dumps([list(one) for one in table.failures]),
                **table.arrays(),
            )


def _key(sliders: list[AnySlider], motions: list[GroundMotion], how: dict[str, Any]) -> str:
    """A digest that identifies a sweep."""
    digest = hashlib.blake2b(json.dumps([list(map(repr, sliders)), how]).encode())
    for motion in motions:
        digest.update(repr((len(motion), motion.dt, motion.interpolation)).encode())
        digest.update(np.ascontiguousarray(motion.acceleration))
        if motion.vertical is not None:
            digest.update(b"vertical")
            digest.update(np.ascontiguousarray(motion.vertical))
        if motion.dt is None:
            digest.update(np.ascontiguousarray(motion.time))
    return digest.hexdigest()
