"""The alternatives, each written as well as it allows: numba, SciPy, heyoka.

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

    # Ensembles. Only where something may happen in a segment is it looked into; slips and rests
    # have a short loop each. dt is the unit of time.

    @nb.njit
    def numba_phases(random, amplitudes, first, lines):
        for record in lines:
            for k in range(len(amplitudes)):
                phase = 2 * math.pi * random.random()
                record[first + k] = amplitudes[k] * complex(math.cos(phase), math.sin(phase))

    @nb.njit
    def numba_segment(load, end, a, x, v):
        """One segment in which an event may lie."""
        rate = end - load
        left = 1.0
        while True:
            s = 1.0 if v > 0 else -1.0
            if v == 0.0:
                if abs(load) > a:
                    s = math.copysign(1.0, load)
                else:
                    if abs(end) <= a:
                        return x, v
                    s = math.copysign(1.0, end)
                    load = s * a
                    left = (end - load) / rate
            u = s * v
            net = s * load - a
            gain = s * rate
            last = u + left * (net + gain * left / 2)
            stop = np.inf
            if not (last > 0 and (net >= 0 or net + gain * left <= 0)):
                discriminant = net * net - 2 * gain * u
                if net < 0:
                    if discriminant >= 0:
                        stop = 2 * u / (math.sqrt(discriminant) - net)
                elif gain < 0:
                    stop = (net + math.sqrt(discriminant)) / -gain
            t = min(stop, left)
            x += s * t * (u + t * (net / 2 + gain * t / 6))
            if stop > left:
                return x, s * last
            v = 0.0
            load += rate * stop
            left -= stop

    @nb.njit
    def numba_sums(xs, vs, sums):
        for i in range(len(xs)):
            x, v = xs[i], vs[i]
            sums[0, i] += x
            sums[1, i] += v
            sums[2, i] += x * x
            sums[3, i] += x * v
            sums[4, i] += v * v

    @nb.njit
    def numba_records(n, dt, a, sums):
        """Adds the sums of x, v, x^2, x v, v^2 at each sample over Coulomb records from rest."""
        last = n.shape[1] - 1
        p, xs, vs = np.empty(last + 1), np.zeros(last + 1), np.zeros(last + 1)
        unit = 1 / dt
        level = a * dt * dt
        for record in n:
            for i in range(last + 1):
                p[i] = -record[i] * dt * dt
            x = v = 0.0
            i = 0
            while True:
                if v == 0.0:
                    while i < last and abs(p[i]) <= level and abs(p[i + 1]) <= level:
                        i += 1
                        xs[i] = x
                        vs[i] = 0.0
                else:
                    s = 1.0 if v > 0 else -1.0
                    distance, speed, net = s * x, s * v, s * p[i] - level
                    while i < last:
                        next_net = s * p[i + 1] - level
                        following = speed + (net + next_net) / 2
                        if not (following > 0 and (net >= 0 or next_net <= 0)):
                            break
                        distance += speed + net * (1 / 3) + next_net * (1 / 6)
                        speed = following
                        net = next_net
                        i += 1
                        xs[i] = s * distance
                        vs[i] = s * speed * unit
                    x, v = s * distance, s * speed
                if i == last:
                    break
                x, v = numba_segment(p[i], p[i + 1], level, x, v)
                i += 1
                xs[i] = x
                vs[i] = v * unit
            numba_sums(xs, vs, sums)

    def numba_ensemble(random, first, amplitudes, samples, dt, a, members) -> np.ndarray:
        """Random phases in a band of lines, thesis (4.49), a batch that stays in the cache at once.

        The lines by numba and the transform by NumPy is the quickest of NumPy, SciPy and numba.
        """
        batch = 40
        sums = np.zeros((5, samples))
        lines = np.zeros((batch, samples // 2 + 1), complex)
        n = np.empty((batch, samples))
        for done in range(0, members, batch):
            rows = min(batch, members - done)
            numba_phases(random, amplitudes, first, lines[:rows])
            np.fft.irfft(lines[:rows], samples, axis=1, norm="forward", out=n[:rows])
            numba_records(n[:rows], dt, a, sums)
        return sums

    @nb.njit
    def numba_slide(left, load, a, x, v):
        """A load that is held."""
        if v != 0.0:
            net = load - math.copysign(a, v)
            last = v + net * left
            if last * v > 0:
                return x + left * (v + last) / 2, last
            stop = -v / net
            x += stop * v / 2
            v = 0.0
            left -= stop
        if abs(load) <= a:
            return x, v
        v = (load - math.copysign(a, load)) * left
        return x + v * left / 2, v

    @nb.njit
    def numba_pulses(random, rate, half_width, sigma, dt, samples, a, members):
        """Poisson pulses, thesis 5.4: b for the half width, then -b for as long.

        The steps of all pulses and the sampling times are merged as they come. Returns the sums,
        as above, and the number of steps.
        """
        sums = np.zeros((5, samples))
        xs, vs = np.zeros(samples), np.zeros(samples)
        duration = (samples - 1) * dt
        arrivals = np.empty(int(rate * duration + 20 * math.sqrt(rate * duration) + 20))
        amplitudes = np.empty(len(arrivals))
        steps = 0
        for _ in range(members):
            count = 0
            t = random.standard_exponential() / rate
            while t < duration:
                arrivals[count] = t
                amplitudes[count] = sigma * random.standard_normal()
                count += 1
                t += random.standard_exponential() / rate
            arrivals[count] = np.inf
            begins = turns = ends = 0
            begin, turn = arrivals[0], arrivals[0] + half_width
            end = arrivals[0] + 2 * half_width
            t = load = x = v = 0.0
            sample = 1
            while sample < samples:
                time = sample * dt
                following = min(min(begin, turn), min(end, time))
                x, v = numba_slide(following - t, load, a, x, v)
                t = following
                steps += 1
                if t == time:
                    xs[sample], vs[sample] = x, v
                    sample += 1
                elif t == begin:
                    load -= amplitudes[begins]
                    begins += 1
                    begin = arrivals[begins]
                elif t == turn:
                    load += 2 * amplitudes[turns]
                    turns += 1
                    turn = arrivals[turns] + half_width
                else:
                    load -= amplitudes[ends]
                    ends += 1
                    end = arrivals[ends] + 2 * half_width
            numba_sums(xs, vs, sums)
        return sums, steps

    @nb.njit
    def numba_lanes(n, dt, a, reach, xs, vs, place, clock, stopped, h, state, pars, done):
        """Between two steps of heyoka's batch mode: lanes that have stopped or come to a sample.

        Returns how many times a lane has asked for a record.
        """
        last = n.shape[1] - 1
        for lane in range(len(h)):
            record, i = place[0, lane], place[1, lane]
            if record == len(n):
                continue
            t, x, rests = clock[0, lane] + h[lane], state[0, lane], stopped[lane]
            slips = True
            if record < 0:  # its first record
                i, rests = last, True
            elif not rests and h[lane] == clock[1, lane]:
                i += 1
                t = 0.0
                xs[record, i] = x
                vs[record, i] = pars[1, lane] * state[1, lane]
                state[2, lane] = -n[record, i]
                rests = i == last
            stopped[lane] = False
            while rests:
                if i == last:
                    record, i, t, x = min(done, len(n)), 0, 0.0, 0.0
                    done += 1
                    if record == len(n):
                        slips = False
                        break
                load = -n[record, i] - (n[record, i + 1] - n[record, i]) * t / dt
                end = -n[record, i + 1]
                e = math.exp(-abs(x) / reach)
                level = 2 * a * e / (1 + e * e)
                if abs(load) > level or abs(end) > level:
                    s = math.copysign(1.0, load if abs(load) > level else end)
                    if abs(load) <= level:
                        t += (dt - t) * (s * level - load) / (end - load)
                        load = s * level
                    if t < dt:
                        # A net force below zero, by rounding, would stop it on the spot;
                        # and from a speed of exactly 0 the stop to come is not found.
                        least = 2e-15 * (abs(load) + level)
                        state[0, lane] = x
                        state[1, lane] = 1e-20
                        state[2, lane] = s * (level + max(s * load - level, least))
                        pars[1, lane] = s
                        break
                i += 1
                t = 0.0
                xs[record, i] = x
                vs[record, i] = 0.0
            place[0, lane], place[1, lane] = record, i
            clock[0, lane] = t
            clock[1, lane] = dt - t
            if slips:
                pars[0, lane] = (n[record, i] - n[record, i + 1]) / dt
                pars[2, lane] = -1.0 if state[0, lane] < 0 else 1.0
            else:  # nothing left to do
                state[0, lane], state[1, lane], state[2, lane] = 0.0, 1.0, a
                pars[0, lane], pars[1, lane], pars[2, lane] = 0.0, 1.0, 1.0
                clock[1, lane] = dt
        return done


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
                    # A net force below zero, by rounding, would stop it on the spot; and
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
    """Steps of one sample inside heyoka, without our loop: its own cost.

    The load follows the spring, so that nothing stops on the way.
    """
    ta, wn = heyoka.integrator, heyoka.wn
    for _ in range(steps // 100):
        ta.state[:] = [0.0, 1.0, SLIP_LEVEL]
        ta.pars[:] = [wn * wn, 1.0, 1.0][: len(ta.pars)]
        ta.propagate_for(100 * DT, max_delta_t=DT)


class HeyokaBatch:
    """Many records of a caster at once, in the lanes of heyoka's batch mode, compiled once.

    Each lane goes at its own pace, and takes the next record when it has done with one. What there
    is to do between two steps of heyoka is done by numba; rests are skipped in closed form.
    """

    def __init__(self, hy, lanes: int, slip_level: float, reach: float, tol: float = 0.0):
        self.lanes, self.slip_level, self.reach = lanes, slip_level, reach
        self.stopped = np.zeros(lanes, bool)
        x, w, load = hy.make_vars("x", "w", "load")
        rate, s, side = hy.par[0], hy.par[1], hy.par[2]
        e = hy.exp(side * x * (-1 / reach))
        net = s * load - 2 * slip_level * e / (1 + e * e)

        def stop(ta, sign, lane):
            self.stopped[lane] = True
            return True

        self.integrator = hy.taylor_adaptive_batch(
            [(x, s * w), (w, net), (load, rate)],
            np.zeros((3, lanes)),
            pars=np.ones((3, lanes)),
            tol=tol,
            t_events=[
                hy.t_event_batch(w, direction=hy.event_direction.negative, callback=stop),
            ],
        )

    def __call__(self, n: np.ndarray, dt: float) -> tuple[np.ndarray, np.ndarray]:
        """Displacement and velocity at the samples of each record, from rest."""
        ta, stopped = self.integrator, self.stopped
        step, reset, state, pars = ta.step, ta.reset_cooldowns, ta.state, ta.pars
        xs, vs = np.zeros(n.shape), np.zeros(n.shape)
        place = np.full((2, self.lanes), -1)  # record and sample of each lane
        clock = np.zeros((2, self.lanes))  # since that sample, and until the next
        stopped[:] = False
        law = self.slip_level, self.reach
        start = np.zeros(self.lanes)
        done = numba_lanes(n, dt, *law, xs, vs, place, clock, stopped, start, state, pars, 0)
        while done < len(n) + self.lanes:
            step(clock[1])
            reset()
            h = ta.last_h
            done = numba_lanes(n, dt, *law, xs, vs, place, clock, stopped, h, state, pars, done)
        return xs, vs


def heyoka_batch_steps(heyoka: HeyokaBatch, steps: int) -> None:
    """Steps of one sample inside heyoka, without our loop: its own cost."""
    ta, lanes = heyoka.integrator, heyoka.lanes
    for _ in range(steps // (100 * lanes)):
        ta.state[:] = np.array([[0.0], [1.0], [heyoka.slip_level]])
        ta.pars[:] = np.array([[0.0], [1.0], [1.0]])
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
