"""A warning, once for a whole run, where nothing slips but would if accelerations were in g."""

from __future__ import annotations

import itertools
import warnings
from collections.abc import Iterable
from typing import Any

from . import _core
from ._core import Drawn, GroundMotion, PlausibilityWarning

__all__ = ["units_remark", "warn_of_units"]

# Sliders and ground motions that are tried: records of one source have one unit.
_MOST = 64


def units_remark(sliders: Iterable[Any], motions: Iterable[GroundMotion]) -> str:
    """`Response.remark` on the unit of the first of some combinations that do not slip; or ''."""
    return _core._units_remark(
        list(itertools.islice(sliders, _MOST)), list(itertools.islice(motions, _MOST))
    )


def warn_of_units(who: str, sliders: Any, motions: Any, seed: int = 0, stacklevel: int = 3) -> str:
    """Warn about a run in which nothing slips. Random ground motions are not records: no warning.

    Parameters
    ----------
    who : str
        The function, with which the message begins.
    sliders, motions
        As for `run_ensemble` or `sweep`.
    seed : int, optional
        Of a random source of sliders.
    stacklevel : int, optional
        Of the warning: 3 is the caller of the function.

    Returns
    -------
    str
        The remark; '' without a warning.
    """
    those = _listed(motions)
    if not all(isinstance(motion, GroundMotion) for motion in those):
        return ""
    if hasattr(sliders, "sample"):
        sliders = [sliders.sample(seed=seed, member=i) for i in range(_MOST)]
    remark = units_remark(_listed(sliders), those)
    if remark:
        warnings.warn(f"{who}: {remark}", PlausibilityWarning, stacklevel=stacklevel)
    return remark


def _listed(given: Any) -> list[Any]:
    """The first items of what a run takes: one, several, or a source that draws one of them."""
    if isinstance(given, Drawn):
        given = given.items
    if isinstance(given, GroundMotion) or not isinstance(given, Iterable):
        return [given]
    return list(itertools.islice(given, _MOST))
