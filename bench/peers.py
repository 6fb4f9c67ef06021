"""What one might take instead, each written as well as it allows: numba, SciPy, heyoka.

And Coulomb friction in long double, as a reference.
"""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np
from measure import peer

DT = 0.1  # [s]
SLIP_LEVEL = 1.0  # [m/s^2]
FREQUENCY = 1.3  # of the spring [rad/s]
REACH = 0.5  # of the caster [m]


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
    if law == "Coulomb":
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
        if law == "Caster":
            # sech(x / reach) in a form that stays finite where |x| is large: the third parameter is
            # the sign of x (near 0 either will do). Quicker, too, than a division by cosh.
            e = hy.exp(hy.par[2] * x * (-one / number(REACH)))
            level = level * (number(2) * e / (one + e * e))
        net = s * (load - number(wn) * number(wn) * x) - level if wn else s * load - level
        self.integrator = hy.taylor_adaptive(
            [(x, s * w), (w, net), (load, rate)],
            [number(0)] * 3,
            pars=[number(0), one, one][: 3 if law == "Caster" else 2],
            t_events=[hy.t_event(w, direction=hy.event_direction.negative, fp_type=number)],
            fp_type=number,
        )

    def __call__(self, n: np.ndarray) -> np.ndarray:
        ta, wn, number = self.integrator, self.wn, self.number
        step, state, pars = ta.step, ta.state, ta.pars
        time_limit, success = self.hy.taylor_outcome.time_limit, self.hy.taylor_outcome.success
        level = level_of(self.law, number)
        dt, tiny = number(DT), np.finfo(number).eps
        values = n.tolist() if number is float else n.astype(number)
        xs = np.zeros(len(n), number)
        state[:] = 0
        stuck, caster = True, self.law == "Caster"
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
                    # A net force of less than nothing, by rounding, would stop it on the spot; and
                    # from a speed of exactly 0 the stop to come is not found.
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


def heyoka_steps(heyoka: Heyoka, steps: int) -> None:
    """Steps of one sample inside heyoka, without our loop: what it costs itself.

    The load follows the spring, so that nothing stops on the way.
    """
    ta, wn = heyoka.integrator, heyoka.wn
    for _ in range(steps // 100):
        ta.state[:] = [0.0, 1.0, SLIP_LEVEL]
        ta.pars[:] = [wn * wn, 1.0, 1.0][: len(ta.pars)]
        ta.propagate_for(100 * DT, max_delta_t=DT)


# ---- a reference


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
