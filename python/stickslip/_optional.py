"""Libraries that only some functions need."""

from __future__ import annotations

import importlib
from typing import Any

__all__ = ["optional"]


def optional(library: str, extra: str, who: str) -> Any:
    """Import a library of one of the package's extras; `who` needs it.

    Raises
    ------
    ImportError
        The library is missing; the message names who needs it and how to install it.
    """
    try:
        return importlib.import_module(library)
    except ImportError as error:
        raise ImportError(
            f"{who}: needs {library}, which is missing; pip install stickslip[{extra}]"
        ) from error
