"""Parts of ground motions, by the numbers of their samples."""

from __future__ import annotations

from typing import Any

from .. import _core
from .._core import GroundMotion

__all__ = ["piece"]


def piece(motion: GroundMotion, index: Any) -> GroundMotion:
    """The part of a motion that a slice chooses; see `GroundMotion`."""
    if not isinstance(index, slice):
        raise TypeError(
            "GroundMotion: an index must be a slice, such as motion[100:2000], got"
            f" {index!r}; a sample is motion.acceleration[i]"
        )
    begin, end, step = index.indices(len(motion))
    if step != 1:
        raise ValueError(
            f"GroundMotion: a slice must have the step 1, got {step}; resampled() changes dt"
        )
    if end - begin < 2:
        raise ValueError(
            f"GroundMotion: a slice must hold at least 2 samples, got {max(end - begin, 0)} of"
            f" {len(motion)}"
        )
    part = slice(begin, end)
    times: dict[str, Any] = {"dt": motion.dt}
    if motion.dt is None:
        uneven = motion.time[part]
        times = {"times": uneven - uneven[0]}
    others: dict[str, Any] = {
        name: None if samples is None else samples[part]
        for name, samples in (("transverse", motion.transverse), ("vertical", motion.vertical))
    }
    return _core._ground_motion(
        motion.acceleration[part],
        **times,
        **others,
        interpolation=motion.interpolation,
        name=motion.name,
        orientation=motion.orientation,
    )
