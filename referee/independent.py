"""The independent program of the referee: Taylor series in 60 digits, with events.

It shares no line with the library, knows no closed form of a slip, and reads the problems as anyone
would. Between events a motion is a power series in time, whose coefficients follow one by one from
the equations (python-flint); an event is the first zero of the series of a guard. A step ends where
the last terms fall below 1e-28.

    pip install python-flint numpy
    python referee/independent.py referee/problems/*.json
"""

from __future__ import annotations

import itertools
import json
import math
import sys
from pathlib import Path

import flint
import numpy as np
from flint import arb, arb_poly, arb_series

flint.ctx.prec = 200
ORDER = 36
SMALL = arb("1e-28")
POINTS = 24


def mid(number):
    return arb(number).mid()


def positive(number) -> bool:
    return mid(number) > 0


class Model:
    """States are lists; a mode is any value. Guards are positive within a mode.

    `field(mode, state, load)` are derivatives, `guards(mode, state, load)` pairs of a name and a
    series, `change(mode, name, state, load)` the mode and the state after an event; `load` holds
    the components of the ground motion. The number watched for its peak is `watched(state)`.
    """

    def watched(self, state):
        return state[0]

    def peak(self, largest):
        return largest

    def ready(self, mode, state, load, rate):
        """The mode at the start of a step."""
        return mode, state


def taylor(model, mode, state, load, order):
    """Coefficients of the states; `load` are lines (value, rate)."""
    flint.ctx.cap = order + 1
    columns = [[value] for value in state]
    for k in range(order):
        flint.ctx.cap = k + 1
        series = [arb_series(c, k + 1) for c in columns]
        lines = [arb_series([a, b][: k + 1], k + 1) for a, b in load]
        for column, rate in zip(columns, model.field(mode, series, lines)):
            rate = arb_series(rate) if not isinstance(rate, arb_series) else rate
            column.append(mid(rate[k] / (k + 1)))
    flint.ctx.cap = order + 1
    return columns


def first_zero(poly, h, eps):
    """First zero in (0, h] after which the polynomial is negative; it starts at 0 or above."""
    at_start = 0  # a zero at the start is divided out: the next one may follow closely
    while at_start < poly.degree() and abs(mid(poly[at_start])) < arb("1e-48"):
        at_start += 1
    if at_start:
        poly = arb_poly(poly.coeffs()[at_start:])
    slope = poly.derivative()
    times = [h * i / POINTS for i in range(POINTS + 1)]
    values = [mid(poly(t)) for t in times]
    for i in range(1, POINTS + 1):
        low, high = times[i - 1], times[i]
        if values[i] < -eps:
            pass
        else:
            here, there = mid(slope(low)), mid(slope(high))
            if not (here < 0 and there > 0):
                continue
            a, b = low, high  # a minimum within
            for _ in range(90):
                m = mid((a + b) / 2)
                if mid(slope(m)) < 0:
                    a = m
                else:
                    b = m
            if not mid(poly(a)) < -eps:
                continue
            high = a
        a, b = low, high
        for _ in range(40):
            m = mid((a + b) / 2)
            if mid(poly(m)) > 0:
                a = m
            else:
                b = m
        t = mid((a + b) / 2)
        for _ in range(4):
            d = mid(slope(t))
            if d == 0:
                break
            n = mid(t - poly(t) / d)
            if not (a <= n <= b):
                break
            t = n
        return t
    return None


def shift(columns, t):
    return [mid(arb_poly(c)(t)) for c in columns]


def peak_of(model, columns, h):
    """Largest |watched| on the piece."""
    flint.ctx.cap = ORDER + 1
    watched = model.watched([arb_series(c, ORDER + 1) for c in columns])
    poly = arb_poly([mid(watched[i]) for i in range(ORDER + 1)])
    slope = poly.derivative()
    times = [h * i / POINTS for i in range(POINTS + 1)]
    best = max(abs(mid(poly(t))) for t in times)
    slopes = [mid(slope(t)) for t in times]
    for i in range(POINTS):
        if slopes[i] * slopes[i + 1] < 0:
            a, b = times[i], times[i + 1]
            for _ in range(100):
                m = mid((a + b) / 2)
                if mid(slope(m)) * slopes[i] > 0:
                    a = m
                else:
                    b = m
            best = max(best, abs(mid(poly(a))))
    return mid(best)


def solve(model, mode, state, dt, components, order=ORDER, fineness=1):
    """The state at the end, the peak and the number of events."""
    dt = arb(dt)
    state = [arb(s) for s in state]
    peak, events = abs(mid(model.watched(state))), 0
    for i in range(len(components[0]) - 1):
        ends = [(arb(c[i]), arb(c[i + 1])) for c in components]
        t, stalled = arb(0), 0
        while t < dt:
            load = [(mid(a + (b - a) * t / dt), mid((b - a) / dt)) for a, b in ends]
            mode, state = model.ready(mode, state, [a for a, _ in load], [b for _, b in load])
            if (model_start := getattr(model, "start", None)) and mode == "start":
                h, mode, state, more = model_start(state, load, mid(dt - t))
                peak = max(peak, more)
                t = mid(t + h)
                continue
            columns = taylor(model, mode, state, load, order)
            h = mid((dt - t) / fineness) if fineness > 1 and dt - t > dt / 1000 else mid(dt - t)
            for c in columns:
                for k in (order - 1, order):
                    size = abs(c[k])
                    if size > 0:
                        limit = arb(math.exp((math.log(float(SMALL)) - log(size)) / k))
                        if limit < h:
                            h = mid(limit)
            series = [arb_series(c, order + 1) for c in columns]
            lines = [arb_series([a, b], order + 1) for a, b in load]
            found, name = None, None
            for one, guard in model.guards(mode, series, lines):
                if not isinstance(guard, arb_series):
                    guard = arb_series([guard], order + 1)
                poly = arb_poly([mid(guard[k]) for k in range(order + 1)])
                zero = first_zero(poly, h if found is None else found, arb("1e-50"))
                if zero is not None and (found is None or zero < found):
                    found, name = zero, one
            step = h if found is None else found
            if step > 0:
                peak = max(peak, peak_of(model, columns, step))
            state = shift(columns, step)
            t = mid(t + step)
            if dt - t < dt * arb("1e-40"):
                t = dt
            if found is not None:
                stalled = stalled + 1 if step < dt * arb("1e-30") else 0
                assert stalled < 20, (mode, name)
                events += 1
                now = [mid(a + (b - a) * t / dt) for a, b in ends]
                mode, state = model.change(mode, name, state, now)
                peak = max(peak, abs(mid(model.watched(state))))
    return mode, state, model.peak(peak), events


def log(size):
    text = size.str(8, radius=False)
    mantissa, _, exponent = text.partition("e")
    return math.log(float(mantissa)) + (int(exponent) if exponent else 0) * math.log(10)


def sign(number):
    return 1 if mid(number) > 0 else -1


# ---- one axis


class Slider(Model):
    """States x, v, gap, its rate. Loads: along, vertical."""

    def __init__(self, system):
        self.g = arb(system["gravity"])
        f = system["friction"]
        self.f, self.kind = f, f["kind"]
        self.w2 = arb(system.get("spring", 0)) ** 2
        self.c = arb(system.get("damping", 0))
        angle = arb(system.get("slope_degrees", 0)) * arb.pi() / 180
        self.sin, self.cos = angle.sin(), angle.cos()
        self.radius = arb(system["pendulum_radius"]) if "pendulum_radius" in system else None
        self.stops = system.get("stops")
        self.flight = system.get("contact", "flight") == "flight"

    def loads(self, load):
        g = load[1] + self.g
        return g * self.sin - load[0] * self.cos, g * self.cos + load[0] * self.sin

    def hold(self, s):
        f = self.f
        if s < 0 and f.get("one_way"):
            return None
        if self.kind == "coulomb":
            return arb(f["mu_backward"] if s < 0 and "mu_backward" in f else f["mu"])
        return arb(f["mu_slow"] if self.kind == "velocity" else f["mu_static"])

    def resist(self, s, speed):
        f = self.f
        if self.kind == "coulomb":
            return self.hold(s)
        if self.kind == "static_kinetic":
            return arb(f["mu_kinetic"])
        if self.kind == "velocity":
            slow, fast, rate = arb(f["mu_slow"]), arb(f["mu_fast"]), arb(f["rate"])
            return fast + (slow - fast) * (speed * -rate).exp()
        static, kinetic = arb(f["mu_static"]), arb(f["mu_kinetic"])
        ratio = speed / arb(f["velocity"])
        power = ratio * ratio if f["exponent"] == 2 else ratio
        return kinetic + (static - kinetic) * (power * -1).exp()

    def pull(self, state, load):
        p, normal = self.loads(load)
        if self.radius is not None:
            return p - normal * state[0] / self.radius, normal
        return p - state[0] * self.w2, normal

    def field(self, mode, state, load):
        x, v, _gap, fall = state
        q, normal = self.pull(state, load)
        still = x * 0
        if mode in ("stuck", "held+", "held-"):
            return still, still, still, still
        if mode == "free":
            return v, q - v * self.c, still, still
        if mode == "flight":
            return v, q - v * self.c, fall, -normal
        s = mode
        return v, q - v * self.c - normal * self.resist(s, v * s) * s, still, still

    def guards(self, mode, state, load):
        x, v, gap, _fall = state
        q, normal = self.pull(state, load)
        if mode == "flight":
            yield "landing", gap
        elif mode == "free":
            yield "contact", -normal
        else:
            yield "off", normal
            if mode in (1, -1):
                yield "stop", v * mode
            elif mode == "held+":
                yield -1, normal * self.hold(-1) + q
            elif mode == "held-":
                yield 1, normal * self.hold(1) - q
            else:
                yield 1, normal * self.hold(1) - q
                if self.hold(-1) is not None:
                    yield -1, normal * self.hold(-1) + q
        if self.stops and mode not in ("stuck", "held+", "held-"):
            yield "wall+", -x + arb(self.stops["gap"])
            yield "wall-", x + arb(self.stops["gap"])

    def at_rest(self, state, load):
        x, _v, _gap, _fall = state
        state = [x, arb(0), arb(0), arb(0)]
        q, normal = self.pull(state, load)
        if self.stops and abs(x) > arb(self.stops["gap"]) - arb("1e-30"):
            side = sign(x)
            if q * side > 0:
                return ("held+" if side > 0 else "held-"), state
        if mid(q - normal * self.hold(1)) > arb("1e-45"):
            return 1, state
        if self.hold(-1) is not None and mid(-q - normal * self.hold(-1)) > arb("1e-45"):
            return -1, state
        return "stuck", state

    def begin(self, state, load):
        return self.at_rest(state, load) if state[1] == 0 else (sign(state[1]), state)

    def ready(self, mode, state, load, rate):
        if mode == "begin":
            if not self.loads(load)[1] > 0:
                return ("flight" if self.flight else "free"), state
            return self.begin(state, load)
        return mode, state

    def change(self, mode, name, state, load):
        x, v, gap, fall = state
        if name == "off":
            return ("flight" if self.flight else "free"), state
        if name == "contact":
            return (sign(v), state) if v != 0 else self.at_rest(state, load)
        if name == "landing":
            impulse = self.hold(sign(v)) * abs(fall)
            if abs(v) <= impulse:
                return self.at_rest(state, load)
            return sign(v), [x, mid(v - sign(v) * impulse), arb(0), arb(0)]
        if name in ("wall+", "wall-"):
            side = 1 if name == "wall+" else -1
            after = mid(-v * arb(self.stops["restitution"]))
            x = mid(side * arb(self.stops["gap"]))
            if abs(after) < arb("1e-17"):
                return self.at_rest([x, arb(0), gap, fall], load)
            return -side, [x, after, gap, fall]
        if name == "stop":
            return self.at_rest(state, load)
        return name, [x, arb(0), gap, fall]  # breakaway


# ---- two directions


class Planar(Model):
    """States x, y, vx, vy. Loads: along, transverse, vertical."""

    def __init__(self, system, leave=50):
        self.g, self.mu = arb(system["gravity"]), arb(system["friction"]["mu"])
        self.w2 = arb(system.get("spring", 0)) ** 2
        self.leave = leave

    def pull(self, state, load):
        x, y = state[:2]
        return -load[0] - x * self.w2, -load[1] - y * self.w2, (load[2] + self.g) * self.mu

    def field(self, mode, state, load):
        x, _y, vx, vy = state
        if mode == "stuck":
            return (x * 0,) * 4
        qx, qy, a = self.pull(state, load)
        u = (vx * vx + vy * vy).sqrt()
        return vx, vy, qx - a * vx / u, qy - a * vy / u

    def guards(self, mode, state, load):
        if mode == "stuck":
            qx, qy, a = self.pull(state, load)
            yield "breakaway", a * a - qx * qx - qy * qy
        else:  # a series that is smooth enough leaps over a stop
            vx, vy = state[2:]
            yield "turn", vx * mid(vx[0]) + vy * mid(vy[0])

    def watched(self, state):
        x, y = state[:2]
        return x * x + y * y  # its root is no power series where the path passes the origin

    def peak(self, largest):
        return mid(largest.sqrt())

    def ready(self, mode, state, load, rate):
        x, y, vx, vy = state
        qx, qy, a = (mid(q) for q in self.pull(state, load))
        if mode == "begin" and vx == 0 and vy == 0:
            over = mid((qx * qx + qy * qy).sqrt() - a)
            if over <= 0:
                return "stuck", state
            tiny = arb("1e-26")  # along the load, which jumped past the level
            return "slide", [x, y, mid(qx * tiny), mid(qy * tiny)]
        if mode in ("begin", "slide"):
            u = mid((vx * vx + vy * vy).sqrt())
            if u < arb("1e-13") and qx * qx + qy * qy < a * a and mode == "slide":
                return "stuck", [x, y, arb(0), arb(0)]
            return "slide", state
        return mode, state

    def change(self, mode, name, state, load):
        return ("slide" if name == "turn" else "start"), state

    def start(self, state, load, left):
        """From a smooth breakaway, with |v| and its direction: a formal series, cut where small."""
        order = 44
        flint.ctx.cap = order
        x, y = state[:2]
        t = arb_series([0, 1], order)
        lines = [arb_series([a, b], order) for a, b in load]
        qx, qy, a = -lines[0] - x * self.w2, -lines[1] - y * self.w2, (lines[2] + self.g) * self.mu
        # In axes along the load at the start, in which it is (q, 0).
        q0 = mid((qx[0] * qx[0] + qy[0] * qy[0]).sqrt())
        c, s = mid(qx[0] / q0), mid(qy[0] / q0)
        speed, phi = t * 0, t * 0
        px, py = t * 0, t * 0
        for _ in range(order):
            lx = qx * c + qy * s - (px * c + py * s) * self.w2
            ly = qy * c - qx * s - (py * c - px * s) * self.w2
            size = (lx * lx + ly * ly).sqrt()
            psi = (ly / lx).atan()
            phi = psi - ((speed * phi.derivative()) / size).asin()
            speed = (size * (phi - psi).cos() - a).integral()
            speed = arb_series([mid(speed[k]) for k in range(order)], order)
            phi = arb_series([mid(phi[k]) for k in range(order)], order)
            vx, vy = speed * phi.cos(), speed * phi.sin()
            px, py = (vx * c - vy * s).integral(), (vx * s + vy * c).integral()
        h = left
        for series in (speed, phi):
            for k in range(order // 2, order - 2):
                if series[k] != 0:
                    h = min(h, arb(math.exp((-self.leave - log(abs(mid(series[k])))) / k)))
        h = mid(h)

        def at(one):
            return mid(arb_poly([mid(one[k]) for k in range(order - 2)])(h))

        dx, dy = at(px), at(py)
        u, f = at(speed), at(phi)
        vx, vy = u * f.cos(), u * f.sin()
        flint.ctx.cap = ORDER + 1
        new = [mid(x + dx), mid(y + dy), mid(vx * c - vy * s), mid(vx * s + vy * c)]
        return h, "slide", new, mid(self.watched(new))


# ---- bearings with several surfaces


class Series(Model):
    """States x, v, u of each element. A mode is (direction, moving set), or "stuck"."""

    def __init__(self, system):
        self.g = arb(system["gravity"])
        self.parts = [
            (arb(e["radius"]), arb(e["mu"]), arb(e["capacity"]))
            for e in system["friction"]["elements"]
        ]

    def thresholds(self, s, state):
        """s phi from which each element moves in the direction s; None at its stop."""
        out = []
        for (radius, mu, capacity), u in zip(self.parts, state[2:]):
            at_stop = mid(capacity - s * u) < arb("1e-35")
            out.append(None if at_stop else mid(s * u / radius + mu))
        return out

    def moving(self, s, state):
        found = self.thresholds(s, state)
        least = min(t for t in found if t is not None)
        near = least + arb("1e-35")
        return s, tuple(k for k, t in enumerate(found) if t is not None and t < near)

    def phi(self, mode, state):
        s, moving = mode
        radius, mu, _ = self.parts[moving[0]]
        return state[2 + moving[0]] / radius + mu * s

    def field(self, mode, state, load):
        still = state[0] * 0
        if mode == "stuck":
            return [still] * len(state)
        _s, moving = mode
        total = sum((self.parts[k][0] for k in moving), arb(0))
        v = state[1]
        rates = [v, -load[0] - (load[1] + self.g) * self.phi(mode, state)]
        for k, (radius, _, _) in enumerate(self.parts):
            rates.append(v * (radius / total) if k in moving else still)
        return rates

    def guards(self, mode, state, load):
        if mode == "stuck":
            values = [mid(u[0]) for u in state[2:]]
            for s in (1, -1):
                least = min(t for t in self.thresholds(s, [0, 0, *values]) if t is not None)
                yield s, (load[1] + self.g) * least + load[0] * s
            return
        s, moving = mode
        yield "stop", state[1] * s
        phi = self.phi(mode, state) * s
        for k, (radius, mu, capacity) in enumerate(self.parts):
            if k in moving:
                yield ("limit", k), -state[2 + k] * s + capacity
            elif mid(capacity - s * state[2 + k][0]) > arb("1e-35"):
                yield ("join", k), state[2 + k] * s / radius + mu - phi

    def at_rest(self, state, load):
        state = [state[0], arb(0), *state[2:]]
        for s in (1, -1):
            least = min(t for t in self.thresholds(s, state) if t is not None)
            if mid(-load[0] * s - (load[1] + self.g) * least) > arb("1e-40"):
                return self.moving(s, state), state
        return "stuck", state

    def ready(self, mode, state, load, rate):
        return self.at_rest(state, load) if mode == "begin" else (mode, state)

    def change(self, mode, name, state, load):
        if name == "stop":
            return self.at_rest(state, load)
        if name in (1, -1):
            return self.moving(name, state), state
        s, moving = mode
        for k in moving:  # exactly at their stops, also where two arrive together
            capacity = self.parts[k][2]
            if mid(capacity - s * state[2 + k]) < arb("1e-35"):
                state[2 + k] = mid(s * capacity)
        return self.moving(s, state), state


# ---- structures


class Isolated(Model):
    """A structure with modes on a sliding base: x, v, and y, y' of each mode."""

    def __init__(self, system):
        self.a = arb(system["friction"]["mu"]) * arb(system["gravity"])
        self.one_way = system["friction"].get("one_way", False)
        self.w2 = arb(system.get("spring", 0)) ** 2
        self.c = arb(system.get("damping", 0))
        self.modes = [
            (arb(m["mass_fraction"]), arb(m["frequency"]), arb(m["damping_ratio"]))
            for m in system["modes"]
        ]
        self.base = 1 - sum((m[0] for m in self.modes), arb(0))
        self.decoupled = system.get("decoupled", False)

    def springs(self, state):
        for (fraction, w, z), y, rate in zip(self.modes, state[2::2], state[3::2]):
            yield fraction, rate * (2 * z * w) + y * (w * w)

    def demand(self, state, load):
        q = -load[0] * self.base - state[0] * self.w2
        for fraction, force in self.springs(state):
            q = q + force * fraction
        return q

    def field(self, mode, state, load):
        still = state[0] * 0
        x2 = still
        if mode != "stuck":
            x2 = self.demand(state, load) - state[1] * self.c - mode * self.a
            if not self.decoupled:
                x2 = x2 / self.base
        rates = [still if mode == "stuck" else state[1], x2]
        for rate, (_, force) in zip(state[3::2], self.springs(state)):
            rates += [rate, -load[0] - force - (still if self.decoupled else x2)]
        return rates

    def guards(self, mode, state, load):
        if mode == "stuck":
            q = self.demand(state, load)
            yield 1, self.a - q
            if not self.one_way:
                yield -1, self.a + q
        else:
            yield "stop", state[1] * mode

    def at_rest(self, state, load):
        state = [state[0], arb(0), *state[2:]]
        q = mid(self.demand(state, load))
        if q - self.a > arb("1e-45"):
            return 1, state
        if -q - self.a > arb("1e-45") and not self.one_way:
            return -1, state
        return "stuck", state

    def ready(self, mode, state, load, rate):
        return self.at_rest(state, load) if mode == "begin" else (mode, state)

    def change(self, mode, name, state, load):
        return self.at_rest(state, load) if name == "stop" else (name, state)


class OnFloor(Model):
    """A slider on a floor of one mode: x, v, and z, z' of the floor."""

    def __init__(self, system):
        self.a = arb(system["friction"]["mu"]) * arb(system["gravity"])
        floor = system["floor"]
        self.w, self.z = arb(floor["frequency"]), arb(floor["damping_ratio"])
        self.ratio = arb(floor["mass_ratio"])
        self.w2 = arb(system.get("spring", 0)) ** 2

    def force(self, state):
        return state[3] * (2 * self.z * self.w) + state[2] * (self.w * self.w)

    def demand(self, state):
        """Of the bond, over the mass of the slider, while it holds."""
        # stuck: (1 + r)(z'' + n) = -force; the slider needs -(z'' + n) - w^2 x
        return self.force(state) / (1 + self.ratio) - state[0] * self.w2

    def field(self, mode, state, load):
        still = state[0] * 0
        if mode == "stuck":
            return still, still, state[3], -load[0] - self.force(state) / (1 + self.ratio)
        pull = state[0] * self.w2 + mode * self.a  # of the slider on the floor
        floor = -load[0] - self.force(state) + pull * self.ratio
        return state[1], -(floor + load[0]) - pull, state[3], floor

    def guards(self, mode, state, load):
        if mode == "stuck":
            yield 1, self.a - self.demand(state)
            yield -1, self.a + self.demand(state)
        else:
            yield "stop", state[1] * mode

    def at_rest(self, state, load):
        state = [state[0], arb(0), *state[2:]]
        q = mid(self.demand(state))
        if abs(q) - self.a > arb("1e-45"):
            return sign(q), state
        return "stuck", state

    def ready(self, mode, state, load, rate):
        return self.at_rest(state, load) if mode == "begin" else (mode, state)

    def change(self, mode, name, state, load):
        return self.at_rest(state, load) if name == "stop" else (name, state)


# ---- rocking


class Rocking(Model):
    """The slender block: theta, theta'. Loads: along, vertical."""

    def __init__(self, system):
        self.g, self.p = arb(system["gravity"]), arb(system["p"])
        self.alpha = {1: arb(system["alpha"]), -1: arb(system.get("alpha_left", system["alpha"]))}
        self.r = arb(system["restitution"])

    def field(self, mode, state, load):
        theta, rate = state
        if mode in ("rest", "over"):
            return theta * 0, theta * 0
        lever = theta - mode * self.alpha[mode]
        p2 = self.p * self.p / self.g
        return rate, ((load[1] + self.g) * lever - load[0]) * p2

    def guards(self, mode, state, load):
        if mode == "rest":
            for s in (1, -1):
                yield s, (load[1] + self.g) * self.alpha[s] + load[0] * s
        elif mode != "over":
            yield "impact", state[0] * mode
            yield "fallen", -state[0] * mode + 10 * self.alpha[mode]

    def at_rest(self, state, load):
        for s in (1, -1):
            if mid(-load[0] * s - (load[1] + self.g) * self.alpha[s]) > arb("1e-45"):
                return s, [arb(0), arb(0)]
        return "rest", [arb(0), arb(0)]

    def ready(self, mode, state, load, rate):
        if mode == "begin":
            return self.at_rest(state, load) if state[0] == 0 else (sign(state[0]), state)
        return mode, state

    def change(self, mode, name, state, load):
        if name == "impact":
            after = mid(state[1] * self.r)
            if abs(after) < arb("1e-18"):
                return self.at_rest(state, load)
            return -mode, [arb(0), after]
        if name == "fallen":
            self.fell = mode
            return "over", state
        return name, state


class RigidBlock(Model):
    """A rigid block: X, Y of its center of mass, theta and their rates. Loads: along, vertical.

    Modes: "rest", "flight", "over", ("slide", s), ("rock", corner), ("slip", corner, s); the right
    corner is 1, and s the direction in which the base or the corner slips.
    """

    def __init__(self, system):
        self.g = arb(system["gravity"])
        self.mu = arb(system["mu"]) if "mu" in system else None
        width, height = arb(system["width"]), arb(system["height"])
        aside, self.h = (arb(c) for c in system.get("center", (0, 0)))
        if "center" not in system:
            self.h = height / 2
        square = (width * width + height * height) / 12
        self.k2 = arb(system["gyration_radius"]) ** 2 if "gyration_radius" in system else square
        self.ahead = {1: mid(width / 2 - aside), -1: mid(-width / 2 - aside)}
        self.lever = arb(system.get("lever", 1))

    def begin(self, start):
        """A block that leans stands on the corner on that side, at rest."""
        theta, rate = arb(start.get("rotation", 0)), arb(start.get("rate", 0))
        side = sign(theta)
        rx, ry = self.arm(side, theta) if theta != 0 else (arb(0), -self.h)
        middle = (self.ahead[1] + self.ahead[-1]) / 2
        x = middle - middle * theta.cos() + self.h * theta.sin()  # the base has not moved yet
        corner = self.ahead[side] - middle
        x = mid(x + corner - corner * theta.cos()) if theta != 0 else arb(0)
        return [x, mid(-ry), theta, mid(-rate * ry), mid(rate * rx), rate]

    def arm(self, side, theta):
        """From the center of mass to a corner."""
        c, s = theta.cos(), theta.sin()
        return c * self.ahead[side] - s * self.h, -s * self.ahead[side] - c * self.h

    def forces(self, mode, state, load):
        """T, N and theta'' on one corner."""
        push, weight = load[0], load[1] + self.g
        w = state[5]
        rx, ry = self.arm(mode[1], state[2])
        if mode[0] == "rock":
            turn = (ry * push - rx * weight) / (self.k2 + rx * rx + ry * ry)
            return push - turn * ry + w * w * rx, weight + turn * rx + w * w * ry, turn
        lean = rx + ry * self.mu * mode[2]
        normal = (weight + w * w * ry) / (1 + rx * lean / self.k2)
        return normal * self.mu * -mode[2], normal, -lean * normal / self.k2

    def field(self, mode, state, load):
        still = state[0] * 0
        if mode in ("rest", "over"):
            return (still,) * 6
        push, weight = load[0], load[1] + self.g
        if mode == "flight":
            rates = -push, -weight, still
        elif mode[0] == "slide":
            rates = -push - weight * self.mu * mode[1], still, still
        else:
            tangent, normal, turn = self.forces(mode, state, load)
            rates = tangent - push, normal - weight, turn
        return (*state[3:], *rates)

    def guards(self, mode, state, load):
        push, weight = load[0], load[1] + self.g
        if mode == "rest":
            yield "leave", weight
            for s in (1, -1):
                if self.mu is not None:
                    yield "leave", weight * self.mu + push * s
                yield "leave", weight * abs(self.ahead[s]) + push * self.h * s
        elif mode == "flight":
            for side in (1, -1):
                yield ("lands", side), state[1] + self.arm(side, state[2])[1]
        elif mode != "over" and mode[0] == "slide":
            yield "off", weight
            yield "stop", state[3] * mode[1]
        elif mode != "over":
            tangent, normal, _ = self.forces(mode, state, load)
            yield "base", state[2] * mode[1]
            yield "off", normal
            if mode[0] == "slip":
                yield "stop", (state[3] + state[5] * self.arm(mode[1], state[2])[1]) * mode[2]
            elif self.mu is not None:
                yield ("slip", -1), normal * self.mu - tangent
                yield ("slip", 1), normal * self.mu + tangent
        if mode not in ("rest", "over") and mode[0] != "slide":
            yield "fallen", arb.pi() / 2 - state[2] * sign(state[2][0] or state[5][0])

    def watched(self, state):
        return state[2]

    def final(self, state):
        """The displacement of the middle of the base."""
        middle, theta = (self.ahead[1] + self.ahead[-1]) / 2, state[2]
        return mid(state[0] + middle * theta.cos() - self.h * theta.sin() - middle)

    def on_base(self, state, load):
        """The base lies on the ground."""
        push, weight = mid(load[0]), mid(load[1] + self.g)
        speed = state[3] if abs(state[3]) > arb("1e-40") else arb(0)
        state = [state[0], self.h, arb(0), speed, arb(0), arb(0)]
        if not weight > 0:
            return "flight", state
        if speed == 0:
            s = 1 if push < 0 else -1
            over = abs(push) * self.h - weight * abs(self.ahead[s])
            slides = self.mu is not None and abs(push) - weight * self.mu > arb("1e-45")
            if not slides and not over > arb("1e-45"):
                return "rest", state
            tips = self.mu is None or self.mu * self.h > abs(self.ahead[s])
            return self.on_corner(s, state, load) if tips else (("slide", s), state)
        s = sign(speed)
        assert self.mu * self.h <= abs(self.ahead[s]), "a base that slides and tips"
        return ("slide", s), state

    def on_corner(self, side, state, load, slip=None):
        """One corner is on the ground and does not move into it."""
        ry = self.arm(side, state[2])[1]
        state[1] = mid(-ry)
        across = mid(state[3] + state[5] * ry)
        if slip is None and abs(across) < arb("1e-40"):
            tangent, normal, _ = (mid(f) for f in self.forces(("rock", side), state, load))
            if not normal > 0:
                return "flight", state
            if self.mu is None or abs(tangent) <= normal * self.mu:
                return ("rock", side), state
            slip = -sign(tangent)
        elif slip is None:
            slip = sign(across)
        mode = ("slip", side, slip)
        return (mode if self.forces(mode, state, load)[1] > 0 else "flight"), state

    def hit(self, side, state):
        """An impulse at one corner: the state after it, and where it slips (0: it sticks)."""
        x, y, theta, vx, vy, w = state
        rx, ry = self.arm(side, theta)
        across, down = vx + w * ry, vy - w * rx
        nn, nt, tt = 1 + rx * rx / self.k2, -rx * ry / self.k2, 1 + ry * ry / self.k2
        whole = nn * tt - nt * nt
        t, n = (nt * down - nn * across) / whole, (nt * across - tt * down) / whole
        slip = 0
        if self.mu is not None and mid(abs(t)) > mid(self.mu * n):
            for slip in (-sign(t), sign(t)):
                n = -down / (nn - nt * self.mu * slip)
                t = -n * self.mu * slip
                if n > 0 and (across + tt * t + nt * n) * slip > 0:
                    break
            else:
                raise ArithmeticError("an impact without an answer")
        turned = mid(w + (ry * t - rx * n) / self.k2)
        return [x, y, theta, mid(vx + t), mid(vy + n), turned], slip

    def on_both(self, state, load):
        """Both corners arrive."""
        state = [state[0], self.h, arb(0), *state[3:]]
        down = {side: mid(state[4] - state[5] * self.ahead[side]) for side in (1, -1)}
        for side in sorted(down, key=lambda one: float(down[one])):
            if not down[side] < 0:
                continue
            at = self.lever * self.ahead[side]
            w = self.k2 * state[5] + self.h * state[3] + at * state[4]
            w = mid(w / (self.k2 + self.h**2 + at * self.ahead[side]))
            after, slip = [*state[:3], mid(self.h * w), mid(self.ahead[side] * w), w], 0
            push, pull = after[4] - state[4], abs(after[3] - state[3])
            if self.mu is not None and pull > self.mu * push:  # then the lever is 1
                after, slip = self.hit(side, state)
            if after[5] * side > 0:
                if abs(after[5]) < arb("1e-18"):  # the end of infinitely many impacts
                    along = after[3] if slip else arb(0)
                    return self.on_base([*after[:3], along, arb(0), arb(0)], load)
                return self.on_corner(side, after, load, slip or None)
        impulse = self.mu * abs(state[4]) if self.mu is not None else None
        if impulse is None or abs(state[3]) <= impulse:
            return self.on_base([*state[:3], arb(0), arb(0), arb(0)], load)
        state[3] = mid(state[3] - sign(state[3]) * impulse)
        return self.on_base(state, load)

    def ready(self, mode, state, load, rate):
        if mode == "begin":
            if state[2] == 0:
                return self.on_base(state, load)
            return self.on_corner(sign(state[2]), state, load)
        return mode, state

    def change(self, mode, name, state, load):
        if name == "fallen":
            self.fell = sign(state[2])
            return "over", [*state[:3], arb(0), arb(0), arb(0)]
        if name == "off":
            return "flight", state
        if name == "leave" or (name == "stop" and mode[0] == "slide"):
            return self.on_base([*state[:3], arb(0), arb(0), arb(0)], load)
        if name == "base":
            return self.on_both(state, load)
        if name == "stop":
            state[3] = mid(-state[5] * self.arm(mode[1], state[2])[1])
            return self.on_corner(mode[1], state, load)
        if name[0] == "slip":
            return ("slip", mode[1], name[1]), state
        if abs(state[2]) < arb("1e-30"):
            return self.on_both(state, load)
        after, slip = self.hit(name[1], state)
        return self.on_corner(name[1], after, load, slip or None)


# ---- carts


class Cart(Model):
    """A cart in the plane: x, y, yaw, vx, vy, k yaw', and the heading of each caster in the room.

    Loads: along, transverse, vertical. Friction acts along lines, across each wheel and along it.
    A mode is "rest" or a sign for each line, 0 where it does not slip. The limit that a set of
    lines without slip reaches is a face of what they can carry: along its normal u they slip, and
    those across it do not. Lines that meet 0 are decided by Newton's method on a smoothed convex
    function in doubles; the guards of the next step would be negative if that were wrong.
    """

    def __init__(self, system):
        self.g, self.k = arb(system["gravity"]), arb(system["radius_of_gyration"])
        self.casters, self.lines = [], []  # place, angle, level over the weight, across or along
        for one in system["supports"]:
            place, share = [arb(c) for c in one["at"]], arb(one["share"])
            steered = "reach" in one
            angle = 6 + len(self.casters) if steered else arb(one["heading"])
            if steered:
                self.casters.append((place, arb(one["heading"]), arb(one["reach"])))
            self.lines.append((place, angle, share * arb(one["side_mu"]), True))
            if one.get("rolling_mu"):
                self.lines.append((place, angle, share * arb(one["rolling_mu"]), False))

    def begin(self, start):
        x, v = start.get("displacement", [0, 0]), start.get("velocity", [0, 0])
        yaw, rate = arb(start.get("rotation", 0)), arb(start.get("rate", 0))
        headings = [yaw + heading for _, heading, _ in self.casters]
        return [*(arb(c) for c in (*x, yaw)), *(arb(c) for c in v), rate * self.k, *headings]

    def geometry(self, state):
        """For each line its row, slip rate and the rate of that without forces; and the rates of
        the headings."""
        _, _, yaw, vx, vy, kw = state[:6]
        c, s, w = yaw.cos(), yaw.sin(), kw / self.k
        found, turning, last = [], [], None
        for place, angle, _, across in self.lines:
            key = id(place)
            if key != last:
                last = key
                ax, ay = c * place[0] - s * place[1], s * place[0] + c * place[1]
                px, py = vx - w * ay, vy + w * ax
                if isinstance(angle, int):
                    ex, ey = state[angle].cos(), state[angle].sin()
                    rate = (py * ex - px * ey) / self.casters[angle - 6][2]
                    turning.append(rate)
                else:
                    ca, sa = angle.cos(), angle.sin()
                    ex, ey, rate = c * ca - s * sa, s * ca + c * sa, w
            dx, dy = (-ey, ex) if across else (ex, ey)
            # The direction turns by `rate`, and the place goes round the center of mass.
            free = rate * (dx * py - dy * px) - w * w * (dx * ax + dy * ay)
            row = dx, dy, (ax * dy - ay * dx) / self.k
            found.append((row, dx * px + dy * py, free))
        return found, turning

    def basis(self, rows, stuck):
        """One or two lines without slip on which the others depend."""
        chosen = []
        for j in stuck:
            if not chosen or (
                len(chosen) == 1 and size(cross(rows[chosen[0]], rows[j])) > arb("1e-9")
            ):
                chosen.append(j)
        return chosen

    def pull(self, mode, state, load):
        """Geometry, the load with the friction that is known, and the basis with its rates."""
        lines, turning = self.geometry(state)
        weight = load[2] + self.g
        free = [-load[0], -load[1], load[0] * 0]
        for (row, _, _), (_, _, level, _), s in zip(lines, self.lines, mode):
            if s:
                free = [f - weight * level * s * r for f, r in zip(free, row)]
        stuck = [j for j, s in enumerate(mode) if not s]
        first = [[mid(start(c)) for c in row] for row, _, _ in lines]
        return lines, turning, free, stuck, self.basis(first, stuck)

    def hold(self, lines, free, basis):
        """The acceleration that keeps the slip rates of the basis at zero."""
        rows = [lines[j][0] for j in basis]
        need = [dot(row, free) + lines[j][2] for row, j in zip(rows, basis)]
        if not basis:
            return free
        if len(basis) == 1:
            carried = [need[0] / dot(rows[0], rows[0])]
        else:
            a, b, d = dot(rows[0], rows[0]), dot(rows[0], rows[1]), dot(rows[1], rows[1])
            whole = a * d - b * b
            carried = [
                (d * need[0] - b * need[1]) / whole,
                (a * need[1] - b * need[0]) / whole,
            ]
        for row, force in zip(rows, carried):
            free = [f - force * r for f, r in zip(free, row)]
        return free

    def field(self, mode, state, load):
        still = state[0] * 0
        if mode == "rest":
            return (still,) * len(state)
        lines, turning, free, _, basis = self.pull(mode, state, load)
        rates = self.hold(lines, free, basis)
        return (state[3], state[4], state[5] / self.k, *rates, *turning)

    def guards(self, mode, state, load):
        weight = load[2] + self.g
        yield "off", weight
        if mode == "rest":
            rows = [[mid(start(c)) for c in row] for row, _, _ in self.geometry(state)[0]]
            for i, j in itertools.combinations(range(len(rows)), 2):
                u = cross(rows[i], rows[j])
                if size(u) > arb("1e-9"):
                    reach = [dot(u, row) for row in rows]
                    total = sum((abs(r) * line[2] for r, line in zip(reach, self.lines)), arb(0))
                    for s in (1, -1):
                        push = (load[0] * u[0] + load[1] * u[1]) * s
                        yield ("face", signs(reach, s)), weight * total + push
            return
        lines, _, free, stuck, basis = self.pull(mode, state, load)
        for j, s in enumerate(mode):
            if s:
                yield ("meets", j), lines[j][1] * s
        if not basis:
            return
        held = self.hold(lines, free, basis)
        force = [f - a for f, a in zip(free, held)]
        rows = {j: lines[j][0] for j in stuck}
        if len(basis) == 1:
            normals = [rows[basis[0]]]
        else:
            w = cross(rows[basis[0]], rows[basis[1]])
            normals = [cross(w, rows[j]) for j in stuck]
        for u in normals:
            reach = {j: dot(u, rows[j]) for j in stuck}
            now = {j: mid(start(r)) for j, r in reach.items()}
            carried = dot(u, force)
            total = carried * 0
            for j in stuck:
                if abs(now[j]) > arb("1e-12"):
                    total = total + reach[j] * sign(now[j]) * weight * self.lines[j][2]
            for s in (1, -1):
                after = list(mode)
                for j in stuck:
                    after[j] = 0 if abs(now[j]) < arb("1e-12") else s * sign(now[j])
                yield ("face", tuple(after)), total - carried * s

    def watched(self, state):
        return state[0] * state[0] + state[1] * state[1]

    def peak(self, largest):
        return mid(largest.sqrt())

    def from_rest(self, state, load):
        """At zero velocity: at rest if every face holds, else off along the least of all."""
        state = [*state[:3], arb(0), arb(0), arb(0), *state[6:]]
        below = [g for name, g in self.guards("rest", state, load) if mid(g) < arb("-1e-45")]
        if not below:
            return "rest", state
        return self.decide(range(len(self.lines)), state, load, (0,) * len(self.lines)), state

    def decide(self, among, state, load, mode):
        """The signs of lines whose slip rate is zero: where the acceleration takes them."""
        if not among:
            return tuple(mode)
        lines, _ = self.geometry(state)
        weight = load[2] + self.g
        free = [-load[0], -load[1], arb(0)]
        for j, s in enumerate(mode):
            if s and j not in among:
                row, level = lines[j][0], self.lines[j][2]
                free = [f - weight * level * s * r for f, r in zip(free, row)]
        rows = np.array([[float(mid(c)) for c in lines[j][0]] for j in among])
        rest = np.array([float(mid(lines[j][2])) for j in among])
        levels = np.array([float(mid(weight * self.lines[j][2])) for j in among])
        slips = least(np.array([float(mid(f)) for f in free]), rows, rest, levels)
        after = list(mode)
        for j, slip in zip(among, slips):
            after[j] = 0 if abs(slip) < 1e-7 else int(np.sign(slip))
        return tuple(after)

    def ready(self, mode, state, load, rate):
        if mode == "begin":
            lines, _ = self.geometry(state)
            slips = [mid(slip) for _, slip, _ in lines]
            still = [j for j, slip in enumerate(slips) if abs(slip) < arb("1e-40")]
            if len(still) == len(slips):
                return self.from_rest(state, load)
            now = tuple(0 if j in still else sign(slip) for j, slip in enumerate(slips))
            return self.decide(still, state, load, now), state
        return mode, state

    def change(self, mode, name, state, load):
        assert name != "off", "a cart that leaves the ground"
        if name[0] == "face":
            return name[1], self.clean(mode, state) if mode != "rest" else state
        lines, _ = self.geometry(state)
        if all(abs(v) < arb("1e-22") for v in state[3:6]):
            return self.from_rest(state, load)
        among = [j for j, s in enumerate(mode) if not s or abs(lines[j][1]) < arb("1e-25")]
        state = self.clean([0 if j in among else 1 for j in range(len(mode))], state)
        return self.decide(among, state, load, mode), state

    def clean(self, mode, state):
        """Without what rounding left of the slip of lines that do not slip."""
        rows = [[mid(c) for c in row] for row, _, _ in self.geometry(state)[0]]
        basis = self.basis(rows, [j for j, s in enumerate(mode) if not s])
        lines = [(row, arb(0), arb(0)) for row in rows]
        return [*state[:3], *(mid(v) for v in self.hold(lines, state[3:6], basis)), *state[6:]]


def start(one):
    """The number at the start of a series."""
    return one[0] if isinstance(one, arb_series) else one


def dot(a, b):
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def cross(a, b):
    return [
        a[1] * b[2] - a[2] * b[1],
        a[2] * b[0] - a[0] * b[2],
        a[0] * b[1] - a[1] * b[0],
    ]


def size(a):
    return mid(dot(a, a).sqrt())


def signs(reach, s):
    return tuple(0 if abs(r) < arb("1e-12") else s * sign(r) for r in reach)


def least(free, rows, rest, levels):
    """Slip accelerations r.a + rest where |a - free|^2/2 + sum of levels |r.a + rest| is least.

    The absolute values are rounded, step by step less; what does not slip falls with the rounding.
    """
    a, eps = free.copy(), 1.0
    while eps > 1e-10:
        for _ in range(100):
            slip = rows @ a + rest
            length = np.hypot(slip, eps)
            gradient = a - free + (levels * slip / length) @ rows
            hessian = np.eye(3) + (rows.T * (levels * eps**2 / length**3)) @ rows
            step = -np.linalg.solve(hessian, gradient)
            part, fall = 1.0, gradient @ step
            if -fall < 1e-26:
                break
            value = ((a - free) ** 2).sum() / 2 + levels @ length
            while part > 1e-8:
                b = a + part * step
                there = ((b - free) ** 2).sum() / 2 + levels @ np.hypot(rows @ b + rest, eps)
                if there <= value + 1e-4 * part * fall + 1e-15:
                    break
                part /= 2
            a = a + part * step
        eps /= 4
    return rows @ a + rest


MODELS = {
    "slider": Slider,
    "planar": Planar,
    "series": Series,
    "isolated": Isolated,
    "floor": OnFloor,
    "rocking": Rocking,
    "rigid_block": RigidBlock,
    "cart": Cart,
}


def answer(problem, order=ORDER, fineness=1, leave=50):
    """The answers to a problem, by quantity, each a list of numbers in 60 digits."""
    system, ground = problem["system"], problem["ground"]
    kind = system["kind"]
    if kind == "slider" and system["friction"]["kind"] == "series":
        kind = "series"
    model = MODELS[kind](system) if kind != "planar" else Planar(system, leave)
    along = ground["along"]
    none = [0.0] * len(along)
    components = [along]
    if kind in ("planar", "cart"):
        components.append(ground.get("transverse", none))
    components.append(ground.get("vertical", none))
    start = problem.get("start", {})
    x, v = start.get("displacement", [0.0]), start.get("velocity", [0.0])
    if kind == "slider":
        state = [x[0], v[0], 0, 0]
    elif kind == "planar":
        state = [*(x if len(x) == 2 else (0, 0)), *(v if len(v) == 2 else (0, 0))]
    elif kind == "rocking":
        state = [start.get("rotation", 0), start.get("rate", 0)]
    elif kind in ("rigid_block", "cart"):
        state = model.begin(start)
    else:
        more = {"series": lambda: len(model.parts), "floor": lambda: 2}.get(
            kind, lambda: 2 * len(model.modes)
        )()
        state = [x[0], v[0], *(0,) * more]
    _mode, state, peak, events = solve(
        model, "begin", state, ground["dt"], components, order, fineness
    )
    if kind == "rocking":
        fell = getattr(model, "fell", 0)
        return {"overturned": [arb(fell)], "final_rotation": [state[0]], "peak_rotation": [peak]}
    if kind == "rigid_block":
        fell = {"overturned": [arb(getattr(model, "fell", 0))]}
        moved = {"final_displacement": [model.final(state)], "final_rotation": [state[2]]}
        return {**fell, **moved, "peak_rotation": [peak]}
    if kind == "cart":
        moved = {"final_displacement": state[:2], "final_rotation": [state[2]]}
        return {**moved, "peak_displacement": [peak], "events": [arb(events)]}
    final = state[:2] if kind == "planar" else state[:1]
    return {"final_displacement": final, "peak_displacement": [peak], "events": [arb(events)]}


def main() -> None:
    for name in sys.argv[1:]:
        problem = json.loads(Path(name).read_text())
        found = answer(problem)
        for quantity, asked in problem["answers"].items():
            off = max(
                abs(float(mid(a - arb(text)))) for a, text in zip(found[quantity], asked["value"])
            )
            print(f"{problem['id']:32}{quantity:20}{off:10.1e}", flush=True)


if __name__ == "__main__":
    main()
