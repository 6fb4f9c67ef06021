"""What a response does between its samples: path, forces, contact. Nothing here draws."""

from __future__ import annotations

from typing import Any

import numpy as np

from .._core import STANDARD_GRAVITY, HarmonicMotion, Response


def sticks(response: Response) -> np.ndarray:
    """The intervals in which the slider stuck.

    Parameters
    ----------
    response : Response

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
    t = response.time
    if response.motion.interpolation == "constant":
        falls = np.append(pressing_at(response, t[:-1]) < 0, False)
        edges = np.flatnonzero(np.diff(np.concatenate([[False], falls])))
        return np.column_stack([t[edges[::2]], t[edges[1::2]]])
    pressing = pressing_at(response, t)
    falls = pressing < 0
    edges = np.flatnonzero(falls[1:] != falls[:-1])  # N is a straight line from one to the next
    before, after = pressing[edges], pressing[edges + 1]
    crossings = t[edges] + (t[edges + 1] - t[edges]) * before / (before - after)
    crossings = np.concatenate([t[:1][falls[:1]], crossings, t[-1:][falls[-1:]]])
    return crossings.reshape(-1, 2)


def path_of(response: Response) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Times [s], displacements [m] and velocities [m/s] to draw: samples, events and the tail.

    In the tail, after the last sample, there are 31 more between events.
    """
    events, last = response.events, response.time[-1]
    t = np.concatenate([response.time, events["time"]])
    x = np.concatenate([response.displacement, events["displacement"]])
    v = np.concatenate([response.velocity, events["velocity"]])
    order = np.argsort(t, kind="stable")
    t, x, v = t[order], x[order], v[order]
    knots = np.flatnonzero((t[:-1] >= last) & (np.diff(t) > 0))
    if not len(knots):
        return t, x, v
    parts = np.linspace(0, 1, 33)[1:-1]
    between = response.at((t[knots, None] + np.diff(t)[knots, None] * parts).ravel())
    where = np.repeat(knots + 1, len(parts))
    dense = (between[name] for name in ("time", "displacement", "velocity"))
    t, x, v = (np.insert(a, where, b) for a, b in zip((t, x, v), dense))
    return t, x, v


def force_path(response: Response) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Times [s], displacements [m], forces [m/s^2]: at samples, and on both sides of events."""
    slider, events = response.slider, response.events
    t, x, v = (events[name] for name in ("time", "displacement", "velocity"))
    ways = np.sign(np.diff(x))  # of slips between events; 0 for sticks
    slid = slid_at(response, t)

    # An impact keeps the velocity before it.
    rebound = -slider.stops.restitution if slider.stops is not None else 1.0
    v_after = np.where(events["kind"] == "impact", rebound * v, v)

    def force(k: np.ndarray, way: np.ndarray, velocity: np.ndarray) -> np.ndarray:
        at, speed, far = x[k], velocity[k], slid[k]
        weight = normal_force(response, t[k]) / STANDARD_GRAVITY
        friction = [
            w * slider.resist(one, abs(u), backward=w < 0, sliding_distance=d, temperature=warm)
            for one, u, w, d, warm in zip(
                at.tolist(),
                speed.tolist(),
                way.tolist(),
                far.tolist(),
                temperature_at(response, t[k]),
            )
        ]
        spring = slider.natural_frequency**2 * at * (weight if slider.pendulum else 1)
        return np.array(friction) * weight + slider.damping * speed + spring

    ends, begins = np.flatnonzero(ways) + 1, np.flatnonzero(ways)
    times = np.concatenate([t[ends], t[begins], response.time])
    places = np.concatenate([x[ends], x[begins], response.displacement])
    forces = np.concatenate(
        [
            force(ends, ways[ends - 1], v),
            force(begins, ways[begins], v_after),
            response.force,
        ]
    )
    order = np.argsort(times, kind="stable")
    return times[order], places[order], forces[order]


def ground_at(response: Response, t: np.ndarray, component: str) -> np.ndarray:
    """A component of the ground acceleration at given times [m/s^2]; 0 after its end."""
    motion = response.motion
    samples = getattr(motion, component, None)
    if samples is None:
        return np.zeros(np.shape(t))
    if motion.interpolation == "linear":
        return np.interp(t, motion.time, samples, right=0)
    after = np.searchsorted(motion.time, t, "right") - 1
    return np.where(t < motion.time[-1], samples[np.minimum(after, len(samples) - 1)], 0)


def pressing_at(response: Response, t: np.ndarray) -> np.ndarray:
    """N at given times [m/s^2], also where it is negative."""
    if isinstance(response.motion, HarmonicMotion):
        return np.full(np.shape(t), STANDARD_GRAVITY)
    slope = np.radians(response.slider.slope_degrees)
    heavy = STANDARD_GRAVITY + ground_at(response, t, "vertical")
    return heavy * np.cos(slope) + ground_at(response, t, "acceleration") * np.sin(slope)


def normal_force(response: Response, t: np.ndarray) -> np.ndarray:
    """Normal force per unit mass at given times [m/s^2], 0 in flight."""
    normal = pressing_at(response, t)
    changes = response.events[np.isin(response.events["kind"], ("liftoff", "landing"))]
    flies = np.searchsorted(changes["time"], t, "right") % 2 == 1
    return np.where(flies, 0, np.maximum(normal, 0))


def slid_at(response: Response, t: np.ndarray) -> np.ndarray:
    """Sliding distance [m] at given times, exact at samples and events."""
    times, x, _ = path_of(response)
    slid = np.append(0, np.cumsum(np.abs(np.diff(x))))
    before = max(response.state.sliding_distance - response.sliding_distance, 0)
    return before + np.interp(t, times, slid)


def temperature_at(response: Response, t: np.ndarray) -> list[float | None]:
    """Surface temperature [degrees Celsius] at given times, where friction depends on it."""
    celsius = response.temperature
    if celsius is None:
        return [None] * t.size
    warm: list[float | None] = np.interp(t, response.time, celsius).tolist()
    return warm


def has_friction(slider: Any) -> bool:
    return bool(slider.hold() > 0 or slider.hold(backward=True) > 0)


def slip_bounds(response: Response, t: np.ndarray, x: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Bounds [g] of the ground acceleration that friction resists at rest, at displacements x [m].

    On a slope, bounds of its horizontal part, which changes the normal force. Without friction the
    bounds are infinite, so that nothing is drawn.
    """
    slider = response.slider
    if not has_friction(slider):
        return np.full(x.shape, -np.inf), np.full(x.shape, np.inf)
    spring = slider.natural_frequency**2 * x
    slope = np.radians(slider.slope_degrees)
    sin, cos = np.sin(slope), np.cos(slope)
    up = 0 if isinstance(response.motion, HarmonicMotion) else ground_at(response, t, "vertical")
    heavy = np.maximum(STANDARD_GRAVITY + up, 0)
    if slider.pendulum:
        spring = spring * heavy / STANDARD_GRAVITY
    slid = slid_at(response, t)
    forward, backward = (
        np.array(
            [
                slider.hold(at, backward=back, sliding_distance=far, temperature=warm)
                for at, far, warm in zip(x.tolist(), slid.tolist(), temperature_at(response, t))
            ]
        )
        / STANDARD_GRAVITY
        for back in (False, True)
    )
    lower = (heavy * (sin - forward * cos) - spring) / (cos + forward * sin)
    # Uphill, friction may resist any ground acceleration.
    gives = np.isfinite(backward) & (np.where(np.isfinite(backward), backward, 0) * sin < cos)
    level = np.where(gives, backward, 0)
    upper = np.where(gives, (heavy * (sin + level * cos) - spring) / (cos - level * sin), np.inf)
    return lower / STANDARD_GRAVITY, upper / STANDARD_GRAVITY


def window(who: str, response: Response, time: tuple[float, float] | None) -> tuple[float, float]:
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
