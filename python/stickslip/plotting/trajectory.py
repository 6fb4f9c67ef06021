"""Contact during a response, and what friction resists. Nothing here draws."""

from __future__ import annotations

from typing import Any

import numpy as np

from .._core import STANDARD_GRAVITY, PlanarResponse, Response, StructureResponse


def sticks(response: Response | PlanarResponse | StructureResponse) -> np.ndarray:
    """The intervals in which the slider stuck.

    Parameters
    ----------
    response : Response, PlanarResponse or StructureResponse

    Returns
    -------
    ndarray, shape (S, 2)
        Begin and end of each stick [s], sorted by time; the last may end with the response.
    """
    events = response.events
    kinds, times = events["kind"], events["time"]
    begins = np.append(response.time[0], times[kinds == "arrest"])
    ends = np.append(times[kinds == "breakaway"], times[-1])[: len(begins)]
    spans = np.column_stack([begins, ends])
    return spans[ends > begins]


def without_contact(response: Response) -> np.ndarray:
    """When nothing pressed the slider on the ground.

    Parameters
    ----------
    response : Response

    Returns
    -------
    ndarray, shape (S, 2)
        Begin and end [s], in order of time: of each flight, or with ``contact='clipped'`` of each
        time in which the ground fell faster than the slider. The last may end with the response.
    """
    events = response.events
    end = events["time"][-1]
    if response.contact == "flight":
        begins = events["time"][events["kind"] == "liftoff"]
        ends = np.append(events["time"][events["kind"] == "landing"], end)[: len(begins)]
        return np.column_stack([begins, ends])
    curve = response._curve()
    free = curve["normal"] <= 1e-12 * STANDARD_GRAVITY  # zero up to round-off
    free = np.concatenate([[False], free, [False]])
    edges = np.flatnonzero(free[1:] != free[:-1])
    spans = np.column_stack([curve["time"][edges[::2]], curve["time"][edges[1::2] - 1]])
    return spans[spans[:, 1] > spans[:, 0]]


def has_friction(slider: Any) -> bool:
    return bool(slider.hold() > 0 or slider.hold(backward=True) > 0)


def slip_bounds(slider: Any, curve: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Bounds [g] of the ground acceleration that friction resists at rest, along a curve.

    On a slope, bounds of its horizontal part, which changes the normal force. Without friction the
    bounds are infinite, so that nothing is drawn.
    """
    x = curve["displacement"]
    if not has_friction(slider):
        return np.full(x.shape, -np.inf), np.full(x.shape, np.inf)
    slope = np.radians(slider.slope_degrees)
    sin, cos = np.sin(slope), np.cos(slope)
    heavy = curve["gravity"]
    spring = slider.natural_frequency**2 * x
    if slider.pendulum:
        spring = spring * heavy / STANDARD_GRAVITY
    forward, backward = (curve[name] / STANDARD_GRAVITY for name in ("hold", "hold_backward"))
    lower = (heavy * (sin - forward * cos) - spring) / (cos + forward * sin)
    # Uphill, friction may resist any ground acceleration.
    gives = np.isfinite(backward) & (np.where(np.isfinite(backward), backward, 0) * sin < cos)
    level = np.where(gives, backward, 0)
    upper = np.where(gives, (heavy * (sin + level * cos) - spring) / (cos - level * sin), np.inf)
    return lower / STANDARD_GRAVITY, upper / STANDARD_GRAVITY


def window(
    who: str,
    response: Response | PlanarResponse | StructureResponse,
    time: tuple[float, float] | None,
) -> tuple[float, float]:
    """The begin and end of the part of a response to draw [s]."""
    first, last = (
        float(response.time[0]),
        float(max(response.time[-1], response.events["time"][-1])),
    )
    if time is None:
        return first, last
    try:
        begin, end = map(float, time)
    except (TypeError, ValueError):
        raise TypeError(
            f"{who}: time must be a begin and an end [s], such as (0, 25), got {time!r}"
        ) from None
    if not first <= begin < end or not begin < last:
        raise ValueError(
            f"{who}: time must be a begin and a later end within {first:g} to {last:g} s, got"
            f" {begin:g}, {end:g}"
        )
    return begin, min(end, last)


def within(t: np.ndarray, begin: float, end: float) -> slice:
    """The part of sorted times from `begin` to `end`, and one more on either side."""
    first = int(np.searchsorted(t, begin, "right")) - 1
    return slice(max(first, 0), int(np.searchsorted(t, end)) + 1)
