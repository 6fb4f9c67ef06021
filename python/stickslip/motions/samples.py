"""Sample records: the 18 earthquake records of the package pyslammer, which is not imported.

Install them with ``pip install stickslip[records]``.
"""

from __future__ import annotations

import importlib.util
import re
from pathlib import Path

from .._core import GroundMotion
from .records import read_record

TYPE_CHECKING = False  # instead of importing `typing`, which takes long
if TYPE_CHECKING:
    from .suite import Suite

__all__ = ["sample_files", "sample_record", "sample_records"]


def sample_files() -> list[Path]:
    """The files of the sample records.

    Returns
    -------
    list of Path
        Sorted by name. Each holds times [s] and accelerations [g], as `read_record` takes them.

    Raises
    ------
    ImportError
        pyslammer is not installed, or lacks its records.
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
        Sorted by name, with the columns `event` and `year`.

    Raises
    ------
    ImportError
        pyslammer is not installed, or lacks its records.
    """
    from .suite import Suite  # it imports NumPy, which one record does not need

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
    """Read one of the sample records.

    Parameters
    ----------
    name : str
        A part of the name that matches one record only, in upper or lower case: ``"Kobe"``,
        ``"northridge_1994_pac"``.

    Returns
    -------
    GroundMotion

    Raises
    ------
    ValueError
        The name matches no record, or several.
    ImportError
        pyslammer is not installed, or lacks its records.
    """
    files = sample_files()
    found = [f for f in files if name.lower().replace(" ", "_") in f.stem.lower()]
    if len(found) != 1:
        names = ", ".join(f.stem for f in found or files)
        many = "matches several" if found else "matches none"
        raise ValueError(f"sample_record: '{name}' {many} of the sample records: {names}")
    return read_record(found[0])
