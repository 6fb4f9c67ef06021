"""One record of 100,000 samples: what a sample costs here, and with what else one might take.

The answers are checked before they are timed, and each peer's largest error in x stands beside its
time. Peers that are not installed are left out and named. The ground accelerations are those of
long_record.cpp.
"""

from __future__ import annotations

import argparse
import json
import math
import subprocess
import sys
import warnings
from collections.abc import Callable
from pathlib import Path

import numpy as np
import stickslip as ss
from command_line import SAMPLES as RECORD_SAMPLES
from command_line import seconds_of_command
from measure import UNRELIABLE, Timing, bar, machine, peer, take_turns, versions

N = 100_000
DT = 0.1  # [s]
DEVIATION = 2.0  # of the ground acceleration [m/s^2]
SLIP_LEVEL = 1.0  # [m/s^2]
FREQUENCY = 1.3  # of the spring [rad/s]
REACH = 0.5  # of the caster [m]


# ---- ground accelerations


def splitmix(seed: int, count: int) -> np.ndarray:
    """SplitMix64 (Steele, Lea & Flood 2014), as doubles from 0 to 1."""
    z = np.uint64(seed) + np.arange(1, count + 1, dtype=np.uint64) * np.uint64(0x9E3779B97F4A7C15)
    z = (z ^ (z >> np.uint64(30))) * np.uint64(0xBF58476D1CE4E5B9)
    z = (z ^ (z >> np.uint64(27))) * np.uint64(0x94D049BB133111EB)
    return ((z ^ (z >> np.uint64(31))) >> np.uint64(11)).astype(float) * 2.0**-53


def independent() -> np.ndarray:
    u = splitmix(1, 2 * N)
    return DEVIATION * np.sqrt(-2 * np.log(1 - u[::2])) * np.cos(2 * math.pi * u[1::2])


def band(low: float, high: float) -> np.ndarray:
    """Cosines of random phase, one at a random place in each of many strips of the band."""
    strips = 400
    u = splitmix(2, 2 * strips)
    n, t = np.zeros(N), np.arange(N) * DT
    for k in range(strips):
        omega = low + (high - low) * (k + u[2 * k]) / strips
        n += np.cos(omega * t + 2 * math.pi * u[2 * k + 1])
    return DEVIATION * math.sqrt(2 / strips) * n


def inputs() -> dict[str, np.ndarray]:
    return {
        "independent": independent(),
        "broad": band(0.5, 15),
        "narrow": band(20 / math.pi**2, 40 / math.pi**2),  # thesis (4.49)
    }


# ---- numba: closed forms in a loop, with and without the account that integrate keeps

nb = peer("numba")
BREAKAWAY, REVERSAL, ARREST, END = range(4)
EVENT = np.dtype([("time", "f8"), ("displacement", "f8"), ("velocity", "f8"), ("kind", "u1")])

if nb:

    @nb.njit
    def numba_coulomb(n, dt, a):
        x, v = np.empty(len(n)), np.empty(len(n))
        position = velocity = 0.0
        x[0] = v[0] = 0.0
        for i in range(len(n) - 1):
            rate = (n[i] - n[i + 1]) / dt  # of the load -n
            t = 0.0
            while True:
                left = dt - t
                load = -n[i] + rate * t
                if velocity == 0.0:
                    if load > a:
                        s = 1.0
                    elif load < -a:
                        s = -1.0
                    else:
                        if -n[i + 1] > a:
                            s = 1.0
                        elif -n[i + 1] < -a:
                            s = -1.0
                        else:
                            break
                        t = (s * a + n[i]) / rate
                        left = dt - t
                        load = s * a
                    net = s * load - a
                    gain = s * rate
                    stop = -2 * net / gain if gain < 0 else np.inf
                    if stop >= left:
                        position += s * left * left * (net / 2 + gain * left / 6)
                        velocity = s * left * (net + gain * left / 2)
                        break
                    position += s * stop * stop * (net / 2 + gain * stop / 6)
                    t += stop
                else:
                    s = 1.0 if velocity > 0 else -1.0
                    u = abs(velocity)
                    net = s * load - a
                    gain = s * rate
                    last = u + left * (net + gain * left / 2)
                    stop = np.inf
                    if not (last > 0 and (net >= 0 or net + gain * left <= 0)):
                        discriminant = net * net - 2 * gain * u
                        if net < 0:
                            if discriminant >= 0:
                                stop = 2 * u / (np.sqrt(discriminant) - net)
                        elif gain < 0:
                            stop = (net + np.sqrt(discriminant)) / -gain
                    if stop > left:
                        position += s * left * (u + left * (net / 2 + gain * left / 6))
                        velocity = s * last
                        break
                    position += s * stop * (u + stop * (net / 2 + gain * stop / 6))
                    velocity = 0.0
                    t += stop
            x[i + 1] = position
            v[i + 1] = velocity
        return x, v

    @nb.njit
    def numba_account(n, dt, a):
        """The same with events, peak, distance, time sliding and energies, as a Response has."""
        x, v = np.empty(len(n)), np.empty(len(n))
        events = np.empty(1024, EVENT)
        count = 0
        position = velocity = 0.0
        x[0] = v[0] = 0.0
        peak = distance = sliding = work = 0.0
        was = 0.0  # the direction of a slip that stopped just now
        for i in range(len(n) - 1):
            rate = (n[i] - n[i + 1]) / dt
            t = 0.0
            while True:
                if count + 2 > len(events):
                    more = np.empty(2 * len(events), EVENT)
                    more[:count] = events[:count]
                    events = more
                left = dt - t
                load = -n[i] + rate * t
                if velocity == 0.0:
                    s = 0.0
                    start = t
                    if load > a:
                        s = 1.0
                    elif load < -a:
                        s = -1.0
                    else:
                        if -n[i + 1] > a:
                            s = 1.0
                        elif -n[i + 1] < -a:
                            s = -1.0
                        if s != 0.0:
                            start = (s * a + n[i]) / rate
                            load = s * a
                    if was != 0.0 and (s == 0.0 or start > t):
                        add_event(events, count, i * dt + t, position, ARREST)
                        count += 1
                        was = 0.0
                    if s == 0.0:
                        break
                    if was == 0.0:
                        add_event(events, count, i * dt + start, position, BREAKAWAY)
                        count += 1
                    elif was != s:
                        add_event(events, count, i * dt + t, position, REVERSAL)
                        count += 1
                    t = start
                    left = dt - t
                else:
                    s = 1.0 if velocity > 0 else -1.0
                u = abs(velocity)
                net = s * load - a
                gain = s * rate
                last = u + left * (net + gain * left / 2)
                stop = np.inf
                if not (last > 0 and (net >= 0 or net + gain * left <= 0)):
                    discriminant = net * net - 2 * gain * u
                    if net < 0:
                        if discriminant >= 0:
                            stop = 2 * u / (np.sqrt(discriminant) - net)
                    elif gain < 0:
                        stop = (net + np.sqrt(discriminant)) / -gain
                slides = min(stop, left)
                way = slides * (u + slides * (net / 2 + gain * slides / 6))
                position += s * way
                distance += way
                sliding += slides
                work += s * load * way + gain * slides * slides * (
                    u / 2 + slides * (net / 3 + gain * slides / 8)
                )
                if stop > left:
                    velocity = s * last
                    was = 0.0
                    break
                velocity = 0.0
                was = s
                t += stop
                peak = max(peak, abs(position))
            x[i + 1] = position
            v[i + 1] = velocity
        peak = max(peak, abs(position))
        return x, v, events[:count], peak, distance, sliding, work, a * distance, velocity**2 / 2

    @nb.njit(inline="always")
    def add_event(events, count, time, displacement, kind):
        events[count].time = time
        events[count].displacement = displacement
        events[count].velocity = 0.0
        events[count].kind = kind

    @nb.njit
    def numba_spring(n, dt, a, w):
        """With u the speed, A the net force, J its rate, w t = y; tan(y/2) solves a quadratic."""
        x, v = np.empty(len(n)), np.empty(len(n))
        position = velocity = 0.0
        x[0] = v[0] = 0.0
        w2 = w * w
        dt_c, dt_s = np.cos(w * dt), np.sin(w * dt)
        for i in range(len(n) - 1):
            rate = (n[i] - n[i + 1]) / dt
            t = 0.0
            while True:
                left = dt - t
                load = -n[i] + rate * t - w2 * position
                if velocity == 0.0:
                    if load > a:
                        s = 1.0
                    elif load < -a:
                        s = -1.0
                    else:
                        last_load = -n[i + 1] - w2 * position
                        if last_load > a:
                            s = 1.0
                        elif last_load < -a:
                            s = -1.0
                        else:
                            break
                        t += left * (s * a - load) / (last_load - load)
                        left = dt - t
                        load = s * a
                else:
                    s = 1.0 if velocity > 0 else -1.0
                u = abs(velocity)
                net = s * load - a
                gain = s * rate
                if left == dt:
                    c, si = dt_c, dt_s
                else:
                    c, si = np.cos(w * left), np.sin(w * left)
                last = u * c + net * si / w + gain * (1 - c) / w2
                last_net = net * c - u * w * si + gain * si / w
                stop = np.inf
                if not (last > 0 and (net >= 0 or last_net <= 0)):
                    p, q = net / w, 2 * gain / w2 - u  # q y^2 + 2 p y + u = 0, y = tan(w t / 2)
                    discriminant = p * p - q * u
                    if discriminant >= 0:
                        root = np.sqrt(discriminant)
                        y = u / (root - p) if p < 0 else -(p + root) / q
                        if y > 0:
                            stop = 2 / w * np.arctan(y)
                if stop > left:
                    position += s * (
                        u * si / w + net * (1 - c) / w2 + gain * (w * left - si) / (w2 * w)
                    )
                    velocity = s * last
                    break
                c, si = np.cos(w * stop), np.sin(w * stop)
                position += s * (
                    u * si / w + net * (1 - c) / w2 + gain * (w * stop - si) / (w2 * w)
                )
                velocity = 0.0
                t += stop
            x[i + 1] = position
            v[i + 1] = velocity
        return x, v


# ---- what steps an equation of motion from outside: sticks in closed form, slips by the peer


def next_slip(x: float, n0: float, n1: float, dt: float, t: float, level: float, wn: float):
    """(time, direction) at which a slider at rest at time t of a segment slips, or None."""
    pull = wn * wn * x
    load = -n0 - (n1 - n0) * t / dt - pull
    if abs(load) > level:
        return t, math.copysign(1.0, load)
    last = -n1 - pull
    if abs(last) <= level:
        return None
    s = math.copysign(1.0, last)
    return t + (dt - t) * (s * level - load) / (last - load), s


def level_of(law: str, number=float) -> Callable:
    level, reach = number(SLIP_LEVEL), number(REACH)
    if law == "coulomb":
        return lambda x: level
    exp = math.exp if number is float else np.exp

    def sech(x):
        e = exp(-abs(x) / reach)
        return level * (2 * e / (1 + e * e))

    return sech


def scipy_slider(solve_ivp, n: np.ndarray, law: str, wn: float) -> np.ndarray:
    level = level_of(law)

    def stopped(t, y, s, n0, rate):
        return s * y[1]

    stopped.terminal, stopped.direction = True, -1.0

    def motion(t, y, s, n0, rate):
        return y[1], -n0 - rate * t - s * level(y[0]) - wn * wn * y[0]

    xs, x, v, s = [0.0], 0.0, 0.0, 0.0
    for n0, n1 in zip(n[:-1].tolist(), n[1:].tolist()):
        t, rate = 0.0, (n1 - n0) / DT
        while t < DT:
            if s == 0:
                slip = next_slip(x, n0, n1, DT, t, level(x), wn)
                if slip is None or slip[0] >= DT:
                    break
                t, s = slip
            r = solve_ivp(
                motion, (t, DT), (x, v), events=stopped, rtol=1e-6, atol=1e-9, args=(s, n0, rate)
            )
            t, x, v = r.t[-1], r.y[0, -1], r.y[1, -1]
            if r.status == 1:
                v = s = 0.0
        xs.append(x)
    return np.array(xs)


class Heyoka:
    """A Taylor integrator of speed w = s x', compiled once; s and the load's rate are parameters.

    The load is a variable of its own, so that neither time nor its origin need be set.
    """

    def __init__(self, hy, law: str, wn: float, number=float):
        self.hy, self.law, self.wn, self.number = hy, law, wn, number
        x, w, load = hy.make_vars("x", "w", "load")
        rate, s = hy.par[0], hy.par[1]
        one = number(1)
        level = one * number(SLIP_LEVEL)
        if law == "caster":
            # sech(x / reach) in a form that stays finite where |x| is large: the third parameter is
            # the sign of x (near 0 either will do). Quicker, too, than a division by cosh.
            e = hy.exp(hy.par[2] * x * (-one / number(REACH)))
            level = level * (number(2) * e / (one + e * e))
        net = s * (load - number(wn) * number(wn) * x) - level if wn else s * load - level
        self.integrator = hy.taylor_adaptive(
            [(x, s * w), (w, net), (load, rate)],
            [number(0)] * 3,
            pars=[number(0), one, one][: 3 if law == "caster" else 2],
            t_events=[hy.t_event(w, direction=hy.event_direction.negative, fp_type=number)],
            fp_type=number,
        )

    def __call__(self, n: np.ndarray) -> np.ndarray:
        ta, wn, number = self.integrator, self.wn, self.number
        step, state, pars = ta.step, ta.state, ta.pars
        time_limit, success = self.hy.taylor_outcome.time_limit, self.hy.taylor_outcome.success
        level = level_of(self.law)
        if number is not float:
            cosh = np.cosh
            level = lambda x: (
                number(SLIP_LEVEL)
                / (cosh(x / number(REACH)) if self.law == "caster" else number(1))
            )
        dt, tiny = number(DT), np.finfo(number).eps
        values = n.tolist() if number is float else n.astype(number)
        xs = np.zeros(len(n), number)
        state[:] = 0
        stuck, caster = True, self.law == "caster"
        for i in range(len(n) - 1):
            n0, n1 = values[i], values[i + 1]
            pars[0] = (n0 - n1) / dt
            t = number(0)
            if caster:
                pars[2] = -1 if state[0] < 0 else 1
            if not stuck:
                state[2] = -n0
            while True:
                if stuck:
                    x = number(state[0])
                    slip = next_slip(x, n0, n1, dt, t, level(x), wn)
                    if slip is None:
                        break
                    t, s = slip
                    load, pull, held = -n0 - (n1 - n0) * t / dt, number(wn) ** 2 * x, level(x)
                    # A net force of less than nothing, by rounding, would stop it on the spot; from a
                    # speed of exactly 0 the stop to come is not found.
                    least = 8 * tiny * (abs(load) + abs(pull) + held)
                    net = max(s * (load - pull) - held, least)
                    state[1], state[2], pars[1] = 1e-20, s * (held + net) + pull, s
                    ta.reset_cooldowns()
                    stuck = False
                    if t >= dt:
                        break
                outcome, h = step(dt - t)
                if outcome == time_limit:
                    break
                t += h
                if outcome != success:
                    state[1] = 0
                    stuck = True
            xs[i + 1] = state[0]
        return xs


def heyoka_step(heyoka: Heyoka, steps: int) -> Callable[[], object]:
    """Steps of one sample, one after another inside heyoka: what remains without our loop."""
    ta = heyoka.integrator

    def run():
        ta.state[:] = [0.3, 1.0, SLIP_LEVEL]
        ta.pars[:] = [1e-9, 1.0, 1.0][: len(ta.pars)]
        for _ in range(steps // 100):  # away and back: the place decides what a caster costs
            ta.state[:] = [0.3, 1.0, SLIP_LEVEL]
            ta.propagate_for(100 * DT, max_delta_t=DT)

    return run


# ---- references


def long_double(n: np.ndarray, wn: float) -> np.ndarray:
    """Coulomb friction in the closed form of any friction-free motion, in numpy's long double."""
    f = np.longdouble
    a, dt, w, half, sixth = f(SLIP_LEVEL), f(DT), f(wn), f(1) / 2, f(1) / 6
    values = n.astype(f)
    xs = np.zeros(len(n), f)
    x = v = s = f(0)

    def position_speed(u, net, gain, t):
        if not wn:
            return t * (u + t * (net * half + gain * t * sixth)), u + t * (net + gain * t * half)
        c, si = np.cos(w * t), np.sin(w * t)
        if w * t < 0.01:  # (w t - sin(w t)) cancels
            z = w * w * t * t
            cubic = t**3 * sixth * (1 - z / 20 * (1 - z / 42 * (1 - z / 72 * (1 - z / 110))))
            square = 2 * (np.sin(w * t / 2) / w) ** 2
        else:
            cubic, square = (w * t - si) / w**3, 2 * (np.sin(w * t / 2) / w) ** 2
        return u * si / w + net * square + gain * cubic, u * c + net * si / w + gain * square

    for i in range(len(n) - 1):
        n0, n1 = values[i], values[i + 1]
        rate = (n0 - n1) / dt
        t = f(0)
        while True:
            if s == 0:
                slip = next_slip(x, n0, n1, dt, t, a, w)
                if slip is None:
                    break
                breaks, s = f(slip[0]), f(slip[1])
                net = max(f(0), s * (-n0 + rate * breaks - w * w * x) - a) if breaks == t else f(0)
                t = breaks
            else:
                net = s * (-n0 + rate * t - w * w * x) - a
            u, gain, left = abs(v), s * rate, dt - t
            d, last = position_speed(u, net, gain, left)
            stop = None
            q = gain - w * w * u / 2  # q y^2 / 2 + net y + u = 0, y = 2 / w tan(w t / 2)
            discriminant = net * net - 2 * q * u
            if discriminant >= 0:
                root = np.sqrt(discriminant)
                y = f(0)
                if net < 0:
                    y = 2 * u / (root - net)
                elif q != 0:
                    y = -(net + root) / q
                if y > 0:
                    stop = 2 / w * np.arctan(w * y / 2) if wn else y
            if stop is None or stop > left:
                x, v = x + s * d, s * last
                break
            x, v, t = x + s * position_speed(u, net, gain, stop)[0], f(0), t + stop
            s = f(0)
        xs[i + 1] = x
    return xs


def error(x: np.ndarray, reference: np.ndarray) -> float:
    """Largest, over the samples that both have [m]."""
    count = min(len(x), len(reference))
    return float(np.max(np.abs(x[:count] - reference[:count])))


def halved(n: np.ndarray) -> ss.GroundMotion:
    fine = np.empty(2 * len(n) - 1)
    fine[::2] = n
    fine[1::2] = n[:-1] + np.diff(n) / 2
    return ss.GroundMotion(fine, dt=DT / 2)


def require(what: str, found: float, allowed: float) -> None:
    if not found <= allowed:
        sys.exit(f"wrong answer: {what}: {found:.3g}, allowed {allowed:.3g}")


# ---- the run

SLIDERS = {
    "Coulomb": ss.Slider(ss.Coulomb(slip_level=SLIP_LEVEL)),
    "Coulomb, spring": ss.Slider(ss.Coulomb(slip_level=SLIP_LEVEL), natural_frequency=FREQUENCY),
    "Coulomb, one-way": ss.Slider(ss.Coulomb(slip_level=SLIP_LEVEL, backward=math.inf)),
    "Caster": ss.Slider(ss.Caster(slip_level=SLIP_LEVEL, reach=REACH)),
    "Caster, spring": ss.Slider(
        ss.Caster(slip_level=SLIP_LEVEL, reach=REACH), natural_frequency=FREQUENCY
    ),
}


def compiled_figures(path: Path | None, rounds: int) -> dict | None:
    found = [path] if path else sorted(Path(__file__).parents[1].glob("build/*/bench/long_record"))
    if not found:
        return None
    command = [found[0], "--json", "--rounds", str(rounds)]
    return json.loads(subprocess.run(command, check=True, capture_output=True, text=True).stdout)


class Run:
    """One input: every work with its answer and its time."""

    def __init__(self, n: np.ndarray, shares: dict[str, int]):
        self.n, self.shares = n, shares
        self.motion = ss.GroundMotion(n, dt=DT)
        self.works: dict[str, dict[str, tuple[Callable, int]]] = {}
        self.errors: dict[str, dict[str, float]] = {}
        self.ours = {}
        self.references = {}
        for name, slider in SLIDERS.items():
            r = ss.integrate(slider, self.motion)
            self.ours[name] = r
            largest = np.max(r.velocity**2) / 2
            require(
                f"{name}: energy that does not add up",
                abs(r.energy.imbalance),
                1e-11 * (r.energy.dissipated + largest),
            )
            self.references[name] = ss.integrate(slider, halved(n)).displacement[::2]
            self.works[name] = {}
            self.errors[name] = {}
        for name, wn in (("Coulomb", 0.0), ("Coulomb, spring", FREQUENCY)):
            self.references[name] = long_double(n[: shares["long double"]], wn)
        for name, slider in SLIDERS.items():
            self.add(
                name,
                "stickslip",
                lambda slider=slider: ss.integrate(slider, self.motion),
                N,
                self.ours[name].displacement,
            )
            require(f"{name}: x", self.errors[name]["stickslip"], 1e-9 * self.ours[name].peak)

    def add(self, slider: str, name: str, work: Callable, items: int, x: np.ndarray) -> None:
        self.works[slider][name] = (work, items)
        self.errors[slider][name] = error(x, self.references[slider])

    def add_numba(self) -> None:
        n = self.n
        for slider, name, loop, *more in (
            ("Coulomb", "numba", numba_coulomb),
            ("Coulomb", "numba, with events and energies", numba_account),
            ("Coulomb, spring", "numba", numba_spring, FREQUENCY),
        ):
            work = lambda loop=loop, more=more: loop(n, DT, SLIP_LEVEL, *more)  # noqa: E731
            self.add(slider, name, work, N, work()[0])
            require(f"numba: {slider}", self.errors[slider][name], 1e-9 * self.ours[slider].peak)
        _, _, events, peak, distance, sliding, work, lost, _ = numba_account(n, DT, SLIP_LEVEL)
        r = self.ours["Coulomb"]
        require("numba's number of events", abs(len(events) - (len(r.events) - 1)), 0)
        for ours, theirs in (
            (r.peak, peak),
            (r.sliding_distance, distance),
            (r.time_sliding, sliding),
            (r.energy.input, work),
            (r.energy.dissipated, lost),
        ):
            require("numba's account", abs(ours - theirs), 1e-9 * abs(theirs))

    def add_scipy(self, solve_ivp) -> None:
        part = self.n[: self.shares["scipy"]]
        for slider, law, wn in (
            ("Coulomb", "coulomb", 0.0),
            ("Coulomb, spring", "coulomb", FREQUENCY),
            ("Caster", "caster", 0.0),
            ("Caster, spring", "caster", FREQUENCY),
        ):
            work = lambda law=law, wn=wn: scipy_slider(solve_ivp, part, law, wn)  # noqa: E731
            self.add(slider, "scipy solve_ivp, rtol 1e-6", work, len(part) - 1, work())

    def add_heyoka(self, hy, compiled: dict) -> None:
        part = self.n[: self.shares["heyoka"]]
        motion = ss.GroundMotion(part, dt=DT)
        for slider, law, wn in (
            ("Coulomb", "coulomb", 0.0),
            ("Coulomb, spring", "coulomb", FREQUENCY),
            ("Caster", "caster", 0.0),
            ("Caster, spring", "caster", FREQUENCY),
        ):
            key = (law, wn)
            if key not in compiled:
                compiled[key] = Heyoka(hy, law, wn), Heyoka(hy, law, wn, np.longdouble)
            heyoka, reference = compiled[key]
            if law == "caster":
                self.references[slider] = reference(part)
                self.errors[slider]["stickslip"] = error(
                    self.ours[slider].displacement, self.references[slider]
                )
            work = lambda heyoka=heyoka: heyoka(part)  # noqa: E731
            self.add(slider, "heyoka", work, len(part) - 1, work())
            bare = heyoka_step(heyoka, len(part))
            self.works[slider]["heyoka, one bare step"] = (bare, len(part) // 100 * 100)
            slice_ = lambda slider=slider: ss.integrate(SLIDERS[slider], motion)  # noqa: E731
            self.works[slider]["stickslip, heyoka's samples"] = (slice_, len(part) - 1)

    def add_pyslammer(self, slam) -> None:
        part = self.n[: self.shares["pyslammer"]]
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")  # it finds 0.1 s long
            ground = slam.GroundMotion(-part / ss.STANDARD_GRAVITY, DT)
        run = lambda: slam.RigidAnalysis(SLIP_LEVEL / ss.STANDARD_GRAVITY, ground)  # noqa: E731
        self.add("Coulomb, one-way", "pySLAMMER, rigid", run, len(part), run().sliding_disp)

    def time(self, rounds: int) -> dict[str, dict[str, Timing]]:
        slow = ("scipy", "pySLAMMER", "heyoka")
        result = {}
        for slider, works in self.works.items():
            quick = {k: w for k, w in works.items() if not k.startswith(slow)}
            rest = {k: w for k, w in works.items() if k not in quick}
            few = {"stickslip, heyoka's samples", "heyoka", "heyoka, one bare step"} & set(works)
            timings = take_turns({k: w for k, w in quick.items() if k not in few}, rounds)
            timings |= take_turns({k: works[k] for k in works if k in few}, max(3, rounds // 3))
            timings |= take_turns({k: w for k, w in rest.items() if k not in few}, 3)
            result[slider] = {k: timings[k] for k in works}
        return result


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--cpp", type=Path, help="long_record as CMake built it")
    parser.add_argument("--rounds", type=int, default=21)
    args = parser.parse_args()

    print(machine())
    print(versions("numpy", "numba", "scipy", "heyoka", "pyslammer"))
    print(
        f"{N} samples, dt = {DT} s, standard deviation {DEVIATION} m/s^2,"
        f" slip level {SLIP_LEVEL} m/s^2;\nns of processor time per sample; ratio to stickslip;"
        " largest error in x against\nlong double (Coulomb), heyoka in long double (caster), or"
        " stickslip on halved segments"
    )
    scipy, hy, slam = peer("scipy.integrate"), peer("heyoka"), peer("pyslammer")
    shares = {"scipy": 501, "heyoka": 5001, "pyslammer": 20_000, "long double": 20_001}
    compiled: dict = {}
    compiled_run = compiled_figures(args.cpp, args.rounds)
    if compiled_run is None:
        print("C++: no build/*/bench/long_record found, and no --cpp given")
    else:
        print(f"C++: {compiled_run['compiler']} {compiled_run['flags']}")

    table = {}
    for name, n in inputs().items():
        run = Run(n, shares)
        if compiled_run:
            residual = compiled_run["inputs"][name]["residual"]
            require(
                f"C++, {name}: residual",
                abs(residual - run.ours["Coulomb"].residual),
                1e-6 * run.ours["Coulomb"].peak,
            )
        if nb:
            run.add_numba()
        if scipy:
            run.add_scipy(scipy.solve_ivp)
        if hy:
            run.add_heyoka(hy, compiled)
        if slam:
            run.add_pyslammer(slam)
        timings = run.time(args.rounds)
        table[name] = run, timings
        r = run.ours["Coulomb"]
        print(f"\n{name}: {len(r.events) / N:.2f} events a sample with Coulomb friction")
        unreliable = False
        for slider, rows in timings.items():
            peak = run.ours[slider].peak
            print(f"  {slider:40} {'median':>9} {'spread':>7} {'ratio':>9}   error [m]", end="")
            print(f"   (peak {peak:.3g} m)")
            base = rows["stickslip"]
            for row, timing in rows.items():
                own = "heyoka's" in row or "bare" in row
                found = "" if own else f"{run.errors[slider][row]:11.1e}"
                print(f"    {row:38} {timing} {timing.ratio(base):9.3g} {found}")
                unreliable |= not timing.reliable
            if compiled_run:
                cpp = compiled_run["inputs"][name]["rows"].get(f"integrate: {slider}")
                if cpp:
                    timing = Timing([cpp["median"]])
                    flag = " " if cpp["spread"] <= 0.1 else "!"
                    spread = f"{100 * cpp['spread']:6.0f}%{flag}"
                    print(f"    {'stickslip in C++':38} {cpp['median']:9.1f} {spread}", end="")
                    print(f" {timing.median / base.median:9.3g}")
        if unreliable:
            print(UNRELIABLE)

    missing = [
        m
        for m, p in (("numba", nb), ("scipy", scipy), ("heyoka", hy), ("pyslammer", slam))
        if not p
    ]
    if missing:
        print(f"\nnot installed: {', '.join(missing)}")

    print("\nbars")
    for name, (run, timings) in table.items():
        print(name)
        coulomb, spring = timings["Coulomb"], timings["Coulomb, spring"]
        if nb:
            numba = coulomb["numba"]
            print(bar("Coulomb through Python, to numba", coulomb["stickslip"].ratio(numba), 1))
            if compiled_run:
                cpp = compiled_run["inputs"][name]["rows"]["integrate: Coulomb"]["median"]
                print(bar("Coulomb in C++, to numba", cpp / numba.median, 0.9))
            value = spring["stickslip"].median / numba.median
            print(bar("Coulomb with spring through Python, to numba without", value, 3))
        if hy:
            for slider in ("Caster", "Caster, spring"):
                rows = timings[slider]
                own = rows["stickslip, heyoka's samples"]
                print(bar(f"{slider}: heyoka, to ours", rows["heyoka"].ratio(own), 8, True))
                errors = run.errors[slider]
                value = errors["stickslip"] / errors["heyoka"]
                print(bar(f"{slider}: our error, to heyoka's", value, 1))
    seconds = seconds_of_command(10)
    print("the command")
    print(bar(f"stickslip slide, {RECORD_SAMPLES} samples, whole process [s]", seconds.median, 0.3))


if __name__ == "__main__":
    main()
