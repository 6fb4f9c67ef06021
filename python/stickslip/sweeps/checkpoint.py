"""The file from which a sweep resumes."""

from __future__ import annotations

import hashlib
import json
import os
import zipfile
from pathlib import Path
from typing import Any

import numpy as np

from .._core import GroundMotion, identity
from .._files import replacing
from ..runs import checkpoint
from .error import SweepError
from .parameter_grid import AnySwept
from .table import SweepFailure, SweepTable

_FORMAT = "stickslip sweep 1"


class Checkpoint(checkpoint.Checkpoint[SweepTable]):
    """The file that saves the progress of a sweep; inactive if no file is given."""

    error = SweepError

    def __init__(
        self,
        file: str | os.PathLike[str] | None,
        every: float,
        sliders: list[AnySwept],
        motions: list[GroundMotion],
        how: dict[str, Any],
    ) -> None:
        super().__init__(file, every)
        self.key = "" if self.file is None else _key(sliders, motions, how)

    def load(self, table: SweepTable) -> None:
        """Fill the table from the file, if it exists."""
        file = self.found()
        if file is None:
            return
        try:
            with file.open("rb") as stream, np.load(stream, allow_pickle=False) as kept:
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
            raise ValueError(f"sweep: checkpoint '{file}' {error}") from error
        for name, array in values.items():
            table.arrays()[name][...] = array
        table.done[...] = done
        table.failures = tuple(SweepFailure(*one) for one in failures)

    def write(self, file: Path, results: SweepTable) -> None:
        with replacing(file) as stream:
            np.savez(
                stream,
                format=_FORMAT,
                key=self.key,
                done=results.done,
                failures=json.dumps([list(one) for one in results.failures]),
                **results.arrays(),
            )


def _key(sliders: list[AnySwept], motions: list[GroundMotion], how: dict[str, Any]) -> str:
    """A digest that identifies a sweep."""
    each = [list(map(identity, sliders)), list(map(identity, motions)), how]
    return hashlib.blake2b(json.dumps(each).encode()).hexdigest()
