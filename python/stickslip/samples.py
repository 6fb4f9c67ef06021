"""Real records to begin with: the 18 of the package pyslammer, which is not imported.

They come with ``pip install stickslip[records]``.
"""

from __future__ import annotations

import importlib.util
import re
from pathlib import Path

from ._core import GroundMotion
from .records import read_record

TYPE_CHECKING = False  # that of `typing`, whose import takes long
if TYPE_CHECKING:
    from .suite import Suite

__all__ = ["sample_files", "sample_record", "sample_records"]


def sample_files() -> list[Path]:
    """The files of the sample records.

    Returns
    -------
    list of Path
        In order of name: seconds and g, for `read_record`.

    Raises
    ------
    ImportError
        pyslammer is not installed, or without its records.
    """
    found = importlib.util.find_spec("pyslammer")
    folders = (found and found.submodule_search_locations) or []
    files = [f for folder in folders for f in Path(folder).glob("sample_ground_motions/*.csv")]
    if not files:
        raise ImportError(
            "stickslip: the sample records are those of the package pyslammer, which is missing;"
            " pip install stickslip[records]"
        )
    return sorted(files)


def sample_records() -> Suite:
    """Eighteen strong-motion records of earthquakes from 1979 to 2001.

    Returns
    -------
    Suite
        In order of name, with the columns `event` and `year`.

    Raises
    ------
    ImportError
        pyslammer is not installed, or without its records.
    """
    from .suite import Suite  # and NumPy: who asks for one record waits for neither

    files = sample_files()
    parts = [re.fullmatch(r"(.+)_(\d{4})_.+", file.stem) for file in files]
    return Suite(
        map(read_record, files),
        {
            "event": [part[1].replace("_", " ") if part else "" for part in parts],
            "year": [int(part[2]) if part else 0 for part in parts],
        },
    )


def sample_record(name: str) -> GroundMotion:
    """One of the sample records.

    Parameters
    ----------
    name : str
        A part of the name of one of them alone, in any case: ``"Kobe"``, ``"northridge_1994_pac"``.

    Returns
    -------
    GroundMotion

    Raises
    ------
    ValueError
        The name is a part of none of their names, or of several.
    ImportError
        pyslammer is not installed, or without its records.
    """
    files = sample_files()
    found = [f for f in files if name.lower().replace(" ", "_") in f.stem.lower()]
    if len(found) != 1:
        names = ", ".join(f.stem for f in found or files)
        many = "names several" if found else "names none"
        raise ValueError(f"sample_record: '{name}' {many} of the sample records: {names}")
    return read_record(found[0])
