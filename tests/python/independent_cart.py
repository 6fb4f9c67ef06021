"""Rigid carts on casters, fixed wheels and feet, computed apart from this library: NumPy and SciPy.

Two programs that share the geometry of the lines of friction and nothing else. `moreau` steps
through time implicitly, without events or modes, to first order; it takes feet too. `events`
follows wheels from event to event to round-off; the mode after each event is the one, of all modes
with at most two independent lines at rest, that passes every check of bounds and signs.

Velocities are y = (x', y', k yaw'), so that the mass matrix is the identity. A line of friction is
a direction d of a support, with the row r = (d, (Rb x d)/k), the slip rate sigma = r.y and the
level L: the force is -L sgn(sigma) r. A wheel has a line across it, and one along it if it resists
rolling. A heading points from the wheel to its pivot, in the room.

    python independent_cart.py carts.json [id ...]
"""

import itertools
import json
import math
import sys
import time

import numpy as np
from scipy.integrate import DOP853
from scipy.optimize import brentq, minimize_scalar

G = 9.80665
WORK = ("scrub", "roll", "slide")
OUTLINE = ((0.4, 0.3), (-0.4, 0.3), (-0.4, -0.3), (0.4, -0.3))


class Cart:
    """The supports of a file of values, and the lines of friction that they make."""

    def __init__(self, params):
        self.k = params["radius_of_gyration"]
        self.outline = np.array(params.get("outline", OUTLINE))
        self.start = params.get("start", [0.0, 0.0, 0.0, 0.0])
        self.headings, lines, self.feet, steered = [], [], [], []
        for kind, x, y, share, level, rho, heading, *reach in params["supports"]:
            if kind == "foot":
                self.feet.append((x, y, share * level))
                continue
            # The angle of the line: that of the caster, or the yaw and a constant.
            angle, offset = (6 + len(self.headings), 0.0) if reach else (2, heading)
            if reach:
                steered.append((angle, len(lines), reach[0]))
                self.headings.append(heading)
            work = 0 if reach else 2
            lines.append((x, y, share * level, angle, offset, 0.0, 1.0, work, *(reach or [0.0])))
            if rho > 0.0:
                lines.append((x, y, share * rho, angle, offset, 1.0, 0.0, 1, *(reach or [0.0])))
        table = np.array(lines).reshape(-1, 9)
        self.bx, self.by, self.level, _, self.offset, self.along, self.across = table.T[:7]
        self.angle, self.work = table[:, 3].astype(int), table[:, 7].astype(int)
        self.caster = table[:, 8] > 0.0
        self.reach = np.where(self.caster, table[:, 8], 1.0)
        self.steered = [np.array(column, dtype=int) for column in list(zip(*steered))[:2]]
        self.swivel = np.array([reach for _, _, reach in steered])

    def initial(self):
        vx, vy, rate, yaw = self.start
        psi = [yaw + heading for heading in self.headings]
        return np.array([0.0, 0.0, yaw, vx, vy, self.k * rate, *psi, 0.0, 0.0, 0.0])

    def lines(self, z):
        """The rows, their slip rates, and the rates of these that do not stem from forces."""
        vx, vy, omega = z[..., 3:4], z[..., 4:5], z[..., 5:6] / self.k
        c, s = np.cos(z[..., 2:3]), np.sin(z[..., 2:3])
        arm_x, arm_y = c * self.bx - s * self.by, s * self.bx + c * self.by
        angle = z[..., self.angle] + self.offset
        c, s = np.cos(angle), np.sin(angle)
        dx, dy = self.along * c - self.across * s, self.along * s + self.across * c
        row = np.stack((dx, dy, (arm_x * dy - arm_y * dx) / self.k), axis=-1)
        sigma = dx * vx + dy * vy + row[..., 2] * z[..., 5:6]
        pivot_x, pivot_y = vx - omega * arm_y, vy + omega * arm_x
        rate = np.where(self.caster, (c * pivot_y - s * pivot_x) / self.reach, omega)
        beta = rate * (dx * pivot_y - dy * pivot_x) - omega**2 * (dx * arm_x + dy * arm_y)
        return row, sigma, beta


def ground(params):
    """The samples of the three components of the ground's acceleration."""
    m = np.arange(params["samples"], dtype=float)
    a = np.zeros((3, m.size))
    if not params.get("at_rest"):
        a[0] = params["factor"] * (2 * np.sin(0.7 * m) + 1.3 * np.cos(1.9 * m + 0.4))
        if "y" in params["components"]:
            a[1] = params["factor"] * (1.5 * np.sin(0.9 * m + 1.1) + 0.8 * np.cos(2.3 * m))
        if params.get("vertical"):
            a[2] = params.get("vertical_factor", 1.0) * 2.5 * np.cos(0.5 * m + 0.2)
    return a


# Time stepping ----------------------------------------------------------------------------------


def slope(y, free, rows, discs, eps):
    """The gradient and the Hessian of |y - free|^2/2 + sum of impulse |slip rate|.

    Below eps [m/s] the absolute value is rounded to a parabola: supports at rest creep that fast.
    """
    g0, g1, g2 = y[0] - free[0], y[1] - free[1], y[2] - free[2]
    h00 = h11 = h22 = 1.0
    h01 = h02 = h12 = 0.0
    for p, q, r, impulse in rows:
        sigma = p * y[0] + q * y[1] + r * y[2]
        if -eps < sigma < eps:
            c = impulse / eps
            f = c * sigma
            h00, h11, h22 = h00 + c * p * p, h11 + c * q * q, h22 + c * r * r
            h01, h02, h12 = h01 + c * p * q, h02 + c * p * r, h12 + c * q * r
        else:
            f = impulse if sigma > 0.0 else -impulse
        g0, g1, g2 = g0 + f * p, g1 + f * q, g2 + f * r
    for p, q, impulse in discs:  # the velocity is (y0 + p y2, y1 + q y2)
        u, v = y[0] + p * y[2], y[1] + q * y[2]
        speed = math.hypot(u, v)
        if speed < eps:
            c = impulse / eps
            a, b, d = c, 0.0, c
            fu, fv = c * u, c * v
        else:
            u, v, c = u / speed, v / speed, impulse / speed
            a, b, d = c * v * v, -c * u * v, c * u * u
            fu, fv = impulse * u, impulse * v
        g0, g1, g2 = g0 + fu, g1 + fv, g2 + p * fu + q * fv
        h00, h01, h11 = h00 + a, h01 + b, h11 + d
        h02, h12 = h02 + a * p + b * q, h12 + b * p + d * q
        h22 += a * p * p + 2 * b * p * q + d * q * q
    return (g0, g1, g2), (h00, h01, h02, h11, h12, h22)


def newton(g, h):
    h00, h01, h02, h11, h12, h22 = h
    a, b, c = h11 * h22 - h12 * h12, h02 * h12 - h01 * h22, h01 * h12 - h02 * h11
    det = h00 * a + h01 * b + h02 * c
    d, e, f = h00 * h22 - h02 * h02, h01 * h02 - h00 * h12, h00 * h11 - h01 * h01
    return (
        -(a * g[0] + b * g[1] + c * g[2]) / det,
        -(b * g[0] + d * g[1] + e * g[2]) / det,
        -(c * g[0] + e * g[1] + f * g[2]) / det,
    )


def least(y, free, rows, discs, eps):
    """The velocity after a step: Newton's method on a convex function, with a search."""
    for _ in range(200):
        g, h = slope(y, free, rows, discs, eps)
        d = newton(g, h)
        if max(abs(d[0]), abs(d[1]), abs(d[2])) < 1e-13:
            break
        fall = g[0] * d[0] + g[1] * d[1] + g[2] * d[2]
        low, high, part = 0.0, 1.0, 1.0
        for _ in range(60):
            trial = (y[0] + part * d[0], y[1] + part * d[1], y[2] + part * d[2])
            g, _ = slope(trial, free, rows, discs, eps)
            rise = g[0] * d[0] + g[1] * d[1] + g[2] * d[2]
            if abs(rise) <= -0.5 * fall or (part == 1.0 and rise < 0.0):
                break
            low, high = (low, part) if rise > 0.0 else (part, high)
            part = 0.5 * (low + high)
        y = trial
    return y


def moreau(cart, a, dt, steps, eps=1e-10):
    """The states (x, y, yaw, headings) at the samples; `steps` in each sampling interval."""
    z, h = [float(value) for value in cart.initial()], dt / steps
    casters = len(cart.headings)
    x, y, phi = z[:3]
    v, psi = tuple(z[3:6]), z[6 : 6 + casters]
    lines = list(zip(cart.bx, cart.by, cart.level, cart.angle, cart.offset, cart.along, cart.reach))
    lines = [tuple(entry.item() for entry in line) for line in lines]
    k, states, count = cart.k, [[x, y, phi, *psi]], a.shape[1] - 1
    for i in range(count * steps):
        m, part = i // steps, (i % steps + 0.5) / steps
        ax, ay, az = (a[:, m] + part * (a[:, m + 1] - a[:, m])).tolist()
        weight = max(0.0, G + az) * h
        # Angles half a step ahead, by the velocity before the step.
        mid = [x, y, phi + 0.5 * h * v[2] / k, *v, *psi]
        rows, discs, turned = [], [], []
        c, s = math.cos(mid[2]), math.sin(mid[2])
        for bx, by, level, angle, offset, along, reach in lines:
            px, py = c * bx - s * by, s * bx + c * by
            if angle > 2 and not along:  # the line across a caster comes first: turn the wheel
                e = mid[angle]
                slip = (v[1] + v[2] * px / k) * math.cos(e) - (v[0] - v[2] * py / k) * math.sin(e)
                mid[angle] += 0.5 * h * slip / reach
                turned.append((angle - 6, px, py, reach))
            e = mid[angle] + offset
            dx, dy = (math.cos(e), math.sin(e)) if along else (-math.sin(e), math.cos(e))
            rows.append((dx, dy, (px * dy - py * dx) / k, level * weight))
        for bx, by, level in cart.feet:
            discs.append((-(s * bx + c * by) / k, (c * bx - s * by) / k, level * weight))
        old, v = v, least(v, (v[0] - h * ax, v[1] - h * ay, v[2]), rows, discs, eps)
        mean = [0.5 * (before + after) for before, after in zip(old, v)]
        x, y, phi = x + h * mean[0], y + h * mean[1], phi + h * mean[2] / k
        for caster, px, py, reach in turned:  # a tractrix, while its pivot moves straight
            vx, vy = mean[0] - mean[2] * py / k, mean[1] + mean[2] * px / k
            chi, shrink = math.atan2(vy, vx), math.exp(-math.hypot(vx, vy) * h / reach)
            off = psi[caster] - chi
            turns = math.floor(off / (2 * math.pi) + 0.5)
            half = 0.5 * (off - 2 * math.pi * turns)
            half = math.atan2(shrink * math.sin(half), math.cos(half))
            psi[caster] = chi + 2 * half + 2 * math.pi * turns
        if (i + 1) % steps == 0:
            states.append([x, y, phi, *psi])
    return np.array(states)


# From event to event ----------------------------------------------------------------------------


def independent(rows, members):
    """At most two of the members: those whose rows are furthest from parallel."""
    unit = rows / np.linalg.norm(rows, axis=1)[:, None]
    pairs = list(itertools.combinations(members, 2))
    sines = [np.linalg.norm(np.cross(unit[i], unit[j])) for i, j in pairs]
    return pairs[int(np.argmax(sines))] if pairs and max(sines) > 1e-9 else tuple(members[:1])


def accelerate(free, rows, beta, basis):
    """The acceleration next to `free` that keeps the slip rates of the basis."""
    if not basis:
        return free
    r = rows[..., basis[0], :]
    rr = (r * r).sum(-1)
    p = (r * free).sum(-1) + beta[..., basis[0]]
    if len(basis) == 1:
        return free - r * (p / rr)[..., None]
    s = rows[..., basis[1], :]
    ss, rs = (s * s).sum(-1), (r * s).sum(-1)
    q = (s * free).sum(-1) + beta[..., basis[1]]
    det = (np.cross(r, s) ** 2).sum(-1)
    first, second = (p * ss - q * rs) / det, (q * rr - p * rs) / det
    return free - r * first[..., None] - s * second[..., None]


def margins(force, rows, levels, basis, stuck):
    """By how much the stuck lines can carry more than this force, by face of their zonotope."""
    held = rows[..., stuck, :]
    if len(basis) == 1:
        u = rows[..., list(basis), :]
    else:
        w = np.cross(rows[..., basis[0], :], rows[..., basis[1], :])
        u = np.cross(w[..., None, :], held)
    u = u / np.linalg.norm(u, axis=-1)[..., None]
    reach = np.abs(u @ np.swapaxes(held, -1, -2)) @ levels[..., stuck, None]
    return reach[..., 0] - np.abs((u * force[..., None, :]).sum(-1))


def faces(rows, levels):
    """Unit normals of the faces of the zonotope, both ways, and its support there per load."""
    size = np.linalg.norm(rows, axis=1)
    unit = rows[levels > 0.0] / size[levels > 0.0, None]
    _, spread, axes = np.linalg.svd(np.vstack((unit, np.zeros((1, 3)))))
    rank = int((spread > 1e-9).sum())
    if rank == 3:
        normals = [np.cross(a, b) for a, b in itertools.combinations(unit, 2)]
    elif rank == 2:
        normals = [np.cross(axes[2], a) for a in unit] + [axes[2]]
    else:
        normals = [*axes]
    u = np.array([n / np.linalg.norm(n) for n in normals if np.linalg.norm(n) > 1e-9])
    u = np.vstack((u, -u))
    pulls = np.abs(u @ rows.T)
    return u, np.where(pulls > 1e-12, pulls, 0.0) @ levels


class Events:
    """A run from event to event. Times are local to the sampling interval."""

    def __init__(self, cart, rtol=1e-13, atol=1e-15, longest=0.01):
        assert not cart.feet, "wheels only"
        self.cart, self.rtol, self.atol, self.longest = cart, rtol, atol, longest
        self.z, self.signs, self.basis, self.resting = cart.initial(), None, (), False
        self.rests = self.count = self.crowds = 0
        self.now, self.flight = 0.0, False  # the time of the interval; whether the loads are gone
        self.gap, self.peak = math.inf, np.zeros(3)
        self.work_of = np.array([cart.work == kind for kind in range(3)])

    def load(self, tau):
        tau = np.asarray(tau)[..., None]
        a = self.a0 + self.a1 * tau
        q = np.concatenate((-a[..., :2], np.zeros_like(tau)), axis=-1)
        return q, self.cart.level * np.maximum(0.0, 0.0 if self.flight else G + a[..., 2:])

    def terms(self, tau, z):
        rows, sigma, beta = self.cart.lines(z)
        q, levels = self.load(tau)
        free = q - ((levels * self.signs)[..., None] * rows).sum(-2)
        return rows, sigma, beta, levels, free, accelerate(free, rows, beta, self.basis)

    def rate(self, tau, z):
        _, sigma, _, levels, _, a = self.terms(tau, z)
        out = np.zeros_like(z)
        out[:2], out[2], out[3:6] = z[3:5], z[5] / self.cart.k, a
        if self.cart.headings:
            angle, line = self.cart.steered
            out[angle] = sigma[line] / self.cart.swivel
        out[-3:] = self.work_of @ (levels * self.signs * sigma)
        return out

    def decide(self, tau, z, among):
        """Sets the mode: the signs of all lines, and a basis of those at rest."""
        rows, sigma, beta = self.cart.lines(z)
        q, levels = self.load(tau)
        among = np.array(sorted(among), dtype=int)
        signs = np.sign(sigma)
        signs[among] = 0.0
        free = q - (levels * signs) @ rows
        best = (-math.inf, None)
        for size in range(3):
            for basis in itertools.combinations(among, size):
                candidate = self.best_signs(rows, beta, levels, free, among, basis)
                if candidate and candidate[0] > best[0]:
                    best = candidate
        slack, chosen = best
        if slack < -1e-9:
            print(f"  warning: the best mode fails by {slack:.1e} at {self.now + tau}")
        signs[among] = chosen
        self.signs, self.basis = signs, independent(rows, np.flatnonzero(signs == 0.0))
        return slack

    @staticmethod
    def best_signs(rows, beta, levels, free, among, basis):
        """The best signs of the lines among which the basis is at rest, with their slack."""
        rest = [j for j in among if j not in basis]
        closed = list(basis)
        if basis:
            frame = rows[list(basis)]
            size = np.linalg.norm(frame, axis=1)
            if size.min() == 0.0:
                return None
            if len(basis) == 2 and np.linalg.norm(np.cross(*frame)) < 1e-9 * size.prod():
                return None
            some = accelerate(np.zeros(3), rows, beta, basis)
            _, _, axes = np.linalg.svd(frame)
            for j in rest:  # a line that follows from the basis is at rest too
                off = np.linalg.norm(axes[len(basis) :] @ rows[j])
                same = abs(rows[j] @ some + beta[j]) < 1e-10
                if off < 1e-9 * np.linalg.norm(rows[j]) and same:
                    closed.append(j)
            rest = [j for j in rest if j not in closed]
        signs = np.array([*itertools.product((-1.0, 1.0), repeat=len(rest))], ndmin=2)
        after = free - (signs * levels[rest]) @ rows[rest]
        shape = (len(signs), *rows.shape)
        a = accelerate(after, np.broadcast_to(rows, shape), beta[None], basis)
        slack = np.full(len(signs), math.inf)
        if rest:
            slack = (signs * (a @ rows[rest].T + beta[rest])).min(-1)
        if basis:
            all_levels = np.broadcast_to(levels, (len(signs), len(levels)))
            room = margins(after - a, np.broadcast_to(rows, shape), all_levels, basis, closed)
            slack = np.minimum(slack, room.min(-1))
        i = int(np.argmax(slack))
        chosen = np.zeros(len(among))
        for j, sign in zip(rest, signs[i]):
            chosen[np.searchsorted(among, j)] = sign
        return slack[i], chosen

    def start_anew(self, tau, among):
        """At an event or a jump of the load: a new mode, or rest if nothing moves."""
        if np.linalg.norm(self.z[3:6]) <= 1e-12:
            self.z[3:6] = 0.0
            rows = self.cart.lines(self.z)[0]
            self.normals, self.supports = faces(rows, self.cart.level)
            if self.room(tau)[0].min() >= 0.0:
                self.resting = True
                return
            self.resting, among = False, range(len(self.cart.level))
        slack = self.decide(tau, self.z, among)
        self.gap = min(self.gap, slack)
        self.clean()

    def clean(self):
        """Takes round-off out of the slip rates of lines at rest."""
        rows = self.cart.lines(self.z)[0]
        self.z[3:6] = accelerate(self.z[3:6], rows, np.zeros(len(rows)), self.basis)

    def room(self, tau):
        """What each face leaves, and how fast that falls; a flat one that is not pulled holds."""
        force, trend = self.load(tau)[0], np.array([-self.a1[0], -self.a1[1], 0.0])
        room = self.supports * (G + self.a0[2] + self.a1[2] * tau) - self.normals @ force
        fall = self.normals @ trend - self.supports * self.a1[2]
        flat = (self.supports == 0.0) & (abs(room) < 1e-12) & (abs(fall) < 1e-11)
        return np.where(flat, math.inf, room), fall

    def rest_until(self, tau, end):
        """The time of breakaway: the load and the weight are linear in time."""
        room, fall = self.room(tau)
        falls = fall > 0.0
        best = min(tau + np.maximum(0.0, room[falls]) / fall[falls], default=end)
        if best >= end:
            return end
        self.resting = False
        self.decide(best + 1e-6, self.z, range(len(self.cart.level)))
        self.count += 1
        return best

    def watched(self, tau, z):
        """What must stay positive: slip rates with their signs, then margins of lines at rest."""
        rows, sigma, _, levels, free, a = self.terms(tau, z)
        moving = self.signs != 0.0
        values = [(sigma * self.signs)[..., moving]]
        if self.basis:
            stuck = np.flatnonzero(~moving)
            values.append(margins(free - a, rows, levels, self.basis, stuck))
        return np.concatenate(values, axis=-1), moving

    def first_crossing(self, dense, low, high, fresh):
        """The earliest zero within a step, with the number of what passes it."""
        times = low + (high - low) * np.linspace(0.0, 1.0, 13)
        if fresh:
            early = low + (high - low) * 2.0 ** np.arange(-30.0, -3.0)
            times = np.unique(np.concatenate((times, early)))
        states = dense(times).T
        values, _ = self.watched(times, states)
        found = (math.inf, -1)
        for j in range(values.shape[1]):

            def one(t, j=j):
                return self.watched(t, dense(t))[0][j]

            g, t = values[:, j], times
            dips = np.flatnonzero((g[1:-1] < g[:-2]) & (g[1:-1] <= g[2:]) & (g[1:-1] > 0.0)) + 1
            for i in dips:
                if g[i] < 0.3 * max(g[i - 1], g[i + 1]):
                    way = {"xatol": 1e-6 * (t[i + 1] - t[i - 1])}
                    dip = minimize_scalar(
                        one, bounds=(t[i - 1], t[i + 1]), method="bounded", options=way
                    )
                    if dip.fun < -2e-13:
                        at = np.searchsorted(t, dip.x)
                        t, g = np.insert(t, at, dip.x), np.insert(g, at, dip.fun)
                        break
            below = np.flatnonzero(g < -2e-13)
            if not below.size or t[below[0]] <= low:
                if below.size and low < found[0]:
                    found = (low, j)
                continue
            above = np.flatnonzero(g[: below[0]] > 0.0)
            if not above.size:
                found = min(found, (low, j))
                continue
            root = brentq(one, t[above[-1]], t[below[0]], xtol=1e-17, rtol=1e-14)
            found = min(found, (root, j))
        return found

    def note_peaks(self, dense, low, high):
        times = np.linspace(low, high, 13)
        start = self.cart.start[3]
        c0, s0 = math.cos(start), math.sin(start)
        bx, by = self.cart.outline.T

        def sizes(z):
            c, s = np.cos(z[..., 2:3]), np.sin(z[..., 2:3])
            dx = z[..., 0:1] + (c - c0) * bx - (s - s0) * by
            dy = z[..., 1:2] + (s - s0) * bx + (c - c0) * by
            center = np.hypot(z[..., 0], z[..., 1])
            return np.stack((center, abs(z[..., 2] - start), np.hypot(dx, dy).max(-1)), axis=-1)

        values = sizes(dense(times).T)
        for j in range(3):
            i = int(np.argmax(values[:, j]))
            best = values[i, j]
            if high > low and best > 0.999 * self.peak[j]:
                near = times[max(i - 1, 0)], times[min(i + 1, 12)]
                way = {"xatol": 1e-9 * (near[1] - near[0])}
                refined = minimize_scalar(
                    lambda t, j=j: -sizes(dense(t))[j], bounds=near, method="bounded", options=way
                )
                best = max(best, -refined.fun)
            self.peak[j] = max(self.peak[j], best)

    def solver(self, tau, z, end):
        first, accuracy = min(1e-5, end - tau), {"rtol": self.rtol, "atol": self.atol}
        return DOP853(self.rate, tau, z, end, self.longest, first_step=first, **accuracy)

    def move(self, tau, end):
        """Up to the next event, or to the end of the interval."""
        solver, fresh = self.solver(tau, self.z, end), True
        while solver.status == "running":
            low, state = solver.t, solver.y.copy()
            message = solver.step()
            assert solver.status != "failed", message
            dense = solver.dense_output()
            if self.flight:
                self.note_peaks(dense, low, solver.t)
                continue
            root, which = self.first_crossing(dense, low, solver.t, fresh)
            self.note_peaks(dense, low, min(root, solver.t))
            fresh = False
            if which >= 0:
                return self.at_event(low, state, root, which)
        self.z = solver.y.copy()
        return end

    def at_event(self, low, state, root, which):
        """Goes to the event, free of the error of the interpolation, and changes the mode."""
        tau, z = low, state
        if root > low:
            solver = self.solver(low, state, root)
            while solver.status == "running":
                solver.step()
            tau, z = root, solver.y.copy()
            for _ in range(3):
                value = self.watched(tau, z)[0][which]
                small = 1e-9
                trend = self.watched(tau + small, z + small * self.rate(tau, z))[0][which] - value
                shift = -value * small / trend if trend else 0.0
                if not abs(shift) < 1e-8:
                    break
                tau, z = tau + shift, z + shift * self.rate(tau, z)
        self.z, moving = z, np.flatnonzero(self.signs)
        stuck = set(np.flatnonzero(self.signs == 0.0))
        self.count += 1
        if which < len(moving):
            sigma = self.cart.lines(z)[1]
            touching = set(np.flatnonzero(abs(sigma) <= 1e-13)) | {moving[which]}
            self.start_anew(tau, stuck | touching)
            self.rests += self.resting
        else:
            self.decide(tau + 1e-6, z + 1e-6 * self.rate(tau, z), stuck)
            self.clean()
        return tau

    def interval(self, a0, a1, dt):
        """One sampling interval; it is cut where the supports leave the floor or land."""
        self.a0, self.a1 = a0, (a1 - a0) / dt
        cuts, normal = [0.0, dt], (G + a0[2], G + a1[2])
        if normal[0] * normal[1] < 0.0:
            cuts.insert(1, dt * normal[0] / (normal[0] - normal[1]))
        for tau, end in itertools.pairwise(cuts):
            was, middle = self.flight, 0.5 * (tau + end)
            self.flight = bool(G + a0[2] + self.a1[2] * middle <= 0.0)
            if self.flight:
                self.resting, self.basis, self.signs = False, (), np.zeros(len(self.cart.level))
            elif was:
                sigma = self.cart.lines(self.z)[1]
                self.start_anew(tau, np.flatnonzero(abs(sigma) <= 1e-13))
            self.within(tau, end)
        self.now += dt

    def within(self, tau, end):
        crowd, anchor = 0, tau
        while end - tau > 1e-16:
            if self.resting:
                tau = self.rest_until(tau, end)
                continue
            tau = self.move(tau, end)
            crowd = crowd + 1 if tau - anchor < 1e-9 else 0
            anchor = anchor if crowd else tau
            if crowd > 30 and tau + 1e-9 < end:
                self.creep(tau)
                tau, crowd = tau + 1e-9, 0

    def creep(self, tau):
        """Over a crowd of events: all lines that hardly slip are decided anew, then 1e-9 s pass."""
        sigma = self.cart.lines(self.z)[1]
        self.decide(tau, self.z, np.flatnonzero(abs(sigma) < 1e-9))
        self.z = self.z + 1e-9 * self.rate(tau, self.z)
        sigma = self.cart.lines(self.z)[1]
        self.decide(tau + 1e-9, self.z, np.flatnonzero(abs(sigma) < 1e-9))
        self.crowds += 1


def events(cart, a, dt, settle=False, **accuracy):
    """States, velocities, peaks, work and counts, in the words of the files of values."""
    run = Events(cart, **accuracy)
    run.a0, run.a1 = a[:, 0], (a[:, 1] - a[:, 0]) / dt
    sigma = cart.lines(run.z)[1]
    run.start_anew(0.0, np.flatnonzero(abs(sigma) <= 1e-13))
    run.rests += run.resting  # a rest from the start counts
    states = [run.z.copy()]
    for m in range(a.shape[1] - 1):
        run.interval(a[:, m], a[:, m + 1], dt)
        states.append(run.z.copy())
    if settle:
        run.a0 = run.a1 = still = np.zeros(3)
        run.start_anew(0.0, () if run.resting else np.flatnonzero(run.signs == 0.0))
        for _ in range(10000):
            if run.resting:
                break
            run.interval(still, still, dt)
    states = np.array(states)
    place = [0, 1, 2, *range(6, 6 + len(cart.headings))]
    return {
        "states": states[:, place], "velocity": states[:, 3:6] / (1.0, 1.0, cart.k),
        "settled": run.z[place] if settle else None,
        "peak": run.peak[0], "peak_yaw": run.peak[1], "peak_corner": run.peak[2],
        "friction": run.z[-3:].sum(), **dict(zip(WORK, run.z[-3:])),
        "rests": run.rests, "events": run.count, "gap": run.gap, "crowds": run.crowds,
    }  # fmt: skip


def values_of(params, **accuracy):
    return events(Cart(params), ground(params), params["dt"], params.get("settle"), **accuracy)


def differences(states, entry):
    """The largest difference of a place or an angle at each time for which the entry has one."""
    found = {}
    for key, value in entry["value"].items():
        if key.startswith("at ") or key == "end":
            i = -1 if key == "end" else int(key[3:])
            found[key] = float(abs(states[i] - np.array(value, dtype=float)).max())
    return found


def main():
    path, *wanted = sys.argv[1:]
    with open(path, encoding="utf-8") as file:
        entries = json.load(file)["carts"]["rows"]
    for entry in entries:
        if wanted and entry["id"] not in wanted:
            continue
        params, begun = entry["params"], time.monotonic()
        print(f"{entry['id']}: uncertainty {entry['uncertainty']}")
        if all(support[0] != "foot" for support in params["supports"]):
            found = values_of(params)
            worst = differences(found["states"], entry)
            for key in ("peak", "peak_yaw", "peak_corner", "friction", "rests"):
                worst[key] = float(abs(found[key] - float(entry["value"][key])))
            text = ", ".join(f"{key} {value:.1e}" for key, value in worst.items())
            print(f"  events: {text}; {found['events']} events, gap {found['gap']:.1e},", end=" ")
            print(f"{found['crowds']} crowds, {time.monotonic() - begun:.1f} s")
            continue
        for steps in (400, 1600):
            begun = time.monotonic()
            states = moreau(Cart(params), ground(params), params["dt"], steps)
            worst = differences(states, entry)
            text = ", ".join(f"{key} {value:.1e}" for key, value in worst.items())
            print(f"  time stepping, {steps}: {text}; {time.monotonic() - begun:.1f} s")


if __name__ == "__main__":
    main()
