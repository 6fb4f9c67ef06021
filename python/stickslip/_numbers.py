"""Numbers from arguments, with errors that name the argument."""

from __future__ import annotations

import operator
import reprlib
from typing import Any, SupportsIndex

import numpy as np
from numpy.typing import ArrayLike, NDArray

__all__ = ["real", "reals", "whole_number"]


def real(value: Any, what: str) -> float:
    """A number, from anything but text that converts to one.

    Raises
    ------
    TypeError
        Another type; the message begins with `what`.
    """
    try:
        if not isinstance(value, (str, bytes)):
            return float(value)
    except (TypeError, ValueError):
        pass
    raise TypeError(f"{what} must be a number, got {reprlib.repr(value)}")


def reals(value: ArrayLike, what: str) -> NDArray[np.float64]:
    """An array of numbers, of any shape.

    Raises
    ------
    ValueError
        Other values; the message begins with `what`.
    """
    try:
        # A masked cell is no number.
        if isinstance(value, np.ma.MaskedArray):
            return np.ma.filled(value.astype(float), np.nan)
        return np.asarray(value, float)
    except (TypeError, ValueError):
        pass
    raise ValueError(f"{what} must hold real numbers, got {reprlib.repr(value)}")


def whole_number(value: SupportsIndex, what: str, least: int, most: int = 2**64 - 1) -> int:
    """An integer from `least` to `most`.

    Raises
    ------
    TypeError
        Another type; the message begins with `what`, as that of the next.
    ValueError
        An integer out of its bounds.
    """
    try:
        number = operator.index(value)
    except TypeError:
        raise TypeError(f"{what} must be a whole number, got {value!r}") from None
    if not least <= number <= most:
        bound = f"at least {least}" if number < least else f"at most {most}"
        raise ValueError(f"{what} must be {bound}, got {number}")
    return number
