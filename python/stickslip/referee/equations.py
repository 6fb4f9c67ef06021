"""The equations of all problems, once, for numbers and symbols of any kind.

A model has a state (a list), a mode, and the load: the components of the ground acceleration.
Within a mode `field` gives the derivatives, and every guard is positive; where one reaches zero,
`change` gives the next mode and state. What integrates them passes its own kind of numbers.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from .problems import NotTriedError

State = list[Any]
Load = Sequence[Any]  # along, transverse, vertical
Guards = Iterator[tuple[Any, Any]]


@dataclass(frozen=True)
class Numbers:
    """What a kind of numbers offers, and what counts as nothing in it."""

    number: Callable[[Any], Any] = float
    value: Callable[[Any], Any] = float  # of a result, without an interval
    exp: Callable[[Any], Any] = math.exp
    sqrt: Callable[[Any], Any] = math.sqrt
    sin: Callable[[Any], Any] = math.sin
    cos: Callable[[Any], Any] = math.cos
    pi: Any = math.pi
    slack: Any = 1e-12  # of a force or a place
    speed: Any = 1e-10  # after an impact, with which no rebound follows
    nudge: Any = 1e-13  # speed with which a slip starts
    crawl: Any = 1e-8  # speed in the plane at which a slip ends


class Model:
    """What all models share."""

    names: Sequence[str] = ("displacement",)

    def __init__(self, system: Mapping[str, Any], numbers: Numbers) -> None:
        self.system, self.on = system, numbers
        self.g = numbers.number(system["gravity"])

    def begin(self, start: Mapping[str, Any]) -> State:
        place, speed = start.get("displacement", [0.0]), start.get("velocity", [0.0])
        return [self.on.number(place[0]), self.on.number(speed[0])]

    def field(self, mode: Any, state: State, load: Load) -> Sequence[Any]:
        raise NotImplementedError

    def guards(self, mode: Any, state: State, load: Load, now: State) -> Guards:
        """`now` is the state in numbers, at the start of the step."""
        raise NotImplementedError

    def at_rest(self, state: State, load: Load) -> tuple[Any, State]:
        """What follows once nothing moves."""
        raise NotImplementedError

    def first(self, state: State, load: Load) -> tuple[Any, State]:
        return self.at_rest(state, load)

    def change(self, mode: Any, name: Any, state: State, load: Load) -> tuple[Any, State]:
        raise NotImplementedError

    def watched(self, state: State) -> Any:
        """The number whose largest size is the peak."""
        return state[0]

    def turning(self, state: State) -> Any:
        """Zero where `watched` turns."""
        return state[1]

    def final(self, state: State) -> list[Any]:
        return [state[0]]

    def sign(self, number: Any) -> int:
        return 1 if self.on.value(number) > 0 else -1

    def level(self) -> Any:
        return self.on.number(self.system["friction"]["mu"]) * self.g


class Slider(Model):
    """x, v, and the gap under a block that flies, with its rate."""

    def __init__(self, system: Mapping[str, Any], numbers: Numbers) -> None:
        super().__init__(system, numbers)
        number = numbers.number
        self.friction = system["friction"]
        self.stiffness = number(system.get("spring", 0.0)) ** 2
        self.damping = number(system.get("damping", 0.0))
        angle = number(system.get("slope_degrees", 0.0)) * numbers.pi / 180
        self.sine, self.cosine = numbers.sin(angle), numbers.cos(angle)
        radius = system.get("pendulum_radius")
        self.radius = None if radius is None else number(radius)
        stops = system.get("stops")
        self.gap: Any = None if stops is None else number(stops["gap"])
        self.restitution = number(stops["restitution"]) if stops else None
        self.off = "flight" if system.get("contact", "flight") == "flight" else "free"

    def begin(self, start: Mapping[str, Any]) -> State:
        zero = self.on.number(0.0)
        return [*super().begin(start), zero, zero]

    def hold(self, s: int) -> Any:
        """Friction at rest against a push in the direction s, over the normal force."""
        f = self.friction
        if s < 0 and f.get("one_way"):
            return None
        if f["kind"] == "coulomb":
            mu = f["mu_backward"] if s < 0 and "mu_backward" in f else f["mu"]
        else:
            mu = f["mu_slow"] if f["kind"] == "velocity" else f["mu_static"]
        return self.on.number(mu)

    def resist(self, s: int, speed: Any) -> Any:
        f, number = self.friction, self.on.number
        if f["kind"] == "coulomb":
            return self.hold(s)
        if f["kind"] == "static_kinetic":
            return number(f["mu_kinetic"])
        if f["kind"] == "velocity":
            slow, fast = number(f["mu_slow"]), number(f["mu_fast"])
            return fast + (slow - fast) * self.on.exp(speed * -number(f["rate"]))
        static, kinetic = number(f["mu_static"]), number(f["mu_kinetic"])
        ratio = speed / number(f["velocity"])
        power = ratio * ratio if f["exponent"] == 2 else ratio
        return kinetic + (static - kinetic) * self.on.exp(-power)

    def pull(self, state: State, load: Load) -> tuple[Any, Any]:
        """Net load without friction, and normal force, per unit mass."""
        up = load[2] + self.g
        push = up * self.sine - load[0] * self.cosine
        normal = up * self.cosine + load[0] * self.sine
        if self.radius is not None:
            return push - normal * state[0] / self.radius, normal
        return push - state[0] * self.stiffness, normal

    def field(self, mode: Any, state: State, load: Load) -> Sequence[Any]:
        x, v, _, fall = state
        still = x * 0
        if mode in ("stuck", "held+", "held-"):
            return still, still, still, still
        q, normal = self.pull(state, load)
        if mode == "free":
            return v, q - v * self.damping, still, still
        if mode == "flight":
            return v, q - v * self.damping, fall, -normal
        slowed = q - v * self.damping - normal * self.resist(mode, v * mode) * mode
        return v, slowed, still, still

    def guards(self, mode: Any, state: State, load: Load, now: State) -> Guards:
        x, v, gap, _ = state
        q, normal = self.pull(state, load)
        if mode == "flight":
            yield "landing", gap
        elif mode == "free":
            yield "contact", -normal
        else:
            yield "off", normal
            if mode in (1, -1):
                yield "stop", v * mode
            if mode in ("stuck", "held-"):
                yield 1, normal * self.hold(1) - q
            if mode in ("stuck", "held+") and self.hold(-1) is not None:
                yield -1, normal * self.hold(-1) + q
        if self.gap is not None and mode not in ("stuck", "held+", "held-"):
            yield "wall+", -x + self.gap
            yield "wall-", x + self.gap

    def at_rest(self, state: State, load: Load) -> tuple[Any, State]:
        value, zero = self.on.value, self.on.number(0.0)
        state = [state[0], zero, zero, zero]
        q, normal = self.pull(state, load)
        if self.gap is not None and abs(value(state[0])) > value(self.gap - self.on.slack):
            side = self.sign(state[0])
            if value(q * side) > 0:
                return ("held+" if side > 0 else "held-"), state
        for s in (1, -1):
            hold = self.hold(s)
            if hold is not None and value(q * s - normal * hold) > self.on.slack:
                return s, [state[0], zero + s * self.on.nudge, zero, zero]
        return "stuck", state

    def first(self, state: State, load: Load) -> tuple[Any, State]:
        if self.on.value(self.pull(state, load)[1]) <= 0:
            return self.off, state
        return (self.sign(state[1]), state) if state[1] != 0 else self.at_rest(state, load)

    def change(self, mode: Any, name: Any, state: State, load: Load) -> tuple[Any, State]:
        x, v, gap, fall = state
        value, zero = self.on.value, self.on.number(0.0)
        if name == "off":
            return self.off, state
        if name == "contact":
            return self.first(state, load) if v == 0 else (self.sign(v), state)
        if name == "landing":
            s = self.sign(v)
            impulse = self.hold(s) * abs(fall)
            if value(v * s) <= value(impulse):
                return self.at_rest(state, load)
            return s, [x, value(v - impulse * s), zero, zero]
        if name in ("wall+", "wall-"):
            side = 1 if name == "wall+" else -1
            after = value(-v * self.restitution)
            if abs(after) < self.on.speed:
                return self.at_rest([value(self.gap * side), zero, zero, zero], load)
            slides = mode if mode in ("free", "flight") else -side
            return slides, [value(self.gap * side), after, gap, fall]
        if name == "stop":
            return self.at_rest(state, load)
        return name, [x, zero + name * self.on.nudge, zero, zero]  # breakaway


class Planar(Model):
    """x, y and their rates: friction opposes the velocity vector."""

    def __init__(self, system: Mapping[str, Any], numbers: Numbers) -> None:
        super().__init__(system, numbers)
        self.mu = numbers.number(system["friction"]["mu"])
        self.stiffness = numbers.number(system.get("spring", 0.0)) ** 2

    def begin(self, start: Mapping[str, Any]) -> State:
        none = [0.0, 0.0]
        both = (*start.get("displacement", none), *start.get("velocity", none))
        return [self.on.number(one) for one in both]

    def pull(self, state: State, load: Load) -> tuple[Any, Any, Any]:
        """Net load without friction, and the friction."""
        level = (load[2] + self.g) * self.mu
        qx = -load[0] - state[0] * self.stiffness
        return qx, -load[1] - state[1] * self.stiffness, level

    def field(self, mode: Any, state: State, load: Load) -> Sequence[Any]:
        x, _, vx, vy = state
        if mode == "stuck":
            return (x * 0,) * 4
        qx, qy, a = self.pull(state, load)
        speed = self.on.sqrt(vx * vx + vy * vy)
        return vx, vy, qx - a * vx / speed, qy - a * vy / speed

    def guards(self, mode: Any, state: State, load: Load, now: State) -> Guards:
        if mode == "stuck":
            qx, qy, a = self.pull(state, load)
            yield "breakaway", a * a - qx * qx - qy * qy
        else:
            vx, vy = state[2:]
            yield "stop", vx * vx + vy * vy - self.on.crawl**2

    def at_rest(self, state: State, load: Load) -> tuple[Any, State]:
        zero = self.on.number(0.0)
        qx, qy, a = self.pull(state, load)
        if self.on.value(qx * qx + qy * qy - a * a) > self.on.slack:
            return self.change("stuck", "breakaway", state, load)
        return "stuck", [state[0], state[1], zero, zero]

    def first(self, state: State, load: Load) -> tuple[Any, State]:
        moves = state[2] != 0 or state[3] != 0
        return ("slide", state) if moves else self.at_rest(state, load)

    def change(self, mode: Any, name: Any, state: State, load: Load) -> tuple[Any, State]:
        if name == "stop":
            return self.at_rest(state, load)
        qx, qy, a = self.pull(state, load)
        start = 2 * self.on.crawl / a
        return "slide", [state[0], state[1], qx * start, qy * start]

    def watched(self, state: State) -> Any:
        return self.on.sqrt(state[0] * state[0] + state[1] * state[1])

    def turning(self, state: State) -> Any:
        return state[0] * state[2] + state[1] * state[3]

    def final(self, state: State) -> list[Any]:
        return list(state[:2])


class Series(Model):
    """A bearing of elements in series: x, v and the displacement of each.

    A mode is "stuck", or the direction and which elements move.
    """

    def __init__(self, system: Mapping[str, Any], numbers: Numbers) -> None:
        super().__init__(system, numbers)
        self.parts: Any = [
            tuple(numbers.number(one[name]) for name in ("radius", "mu", "capacity"))
            for one in system["friction"]["elements"]
        ]

    def begin(self, start: Mapping[str, Any]) -> State:
        return [*super().begin(start), *(self.on.number(0.0) for _ in self.parts)]

    def thresholds(self, s: int, state: State) -> list[Any]:
        """Force over the weight from which each moves in the direction s; None at its stop."""
        found: list[Any] = []
        for (radius, mu, capacity), u in zip(self.parts, state[2:], strict=True):
            stopped = self.on.value(capacity - u * s) < self.on.slack
            found.append(None if stopped else self.on.value(u * s / radius + mu))
        return found

    def least(self, s: int, state: State) -> Any:
        return min(one for one in self.thresholds(s, state) if one is not None)

    def moving(self, s: int, state: State) -> Any:
        limit = self.least(s, state) + self.on.slack
        found = enumerate(self.thresholds(s, state))
        return s, tuple(k for k, one in found if one is not None and one < limit)

    def field(self, mode: Any, state: State, load: Load) -> Sequence[Any]:
        still = state[0] * 0
        if mode == "stuck":
            return [still] * len(state)
        _s, moving = mode
        total = sum((self.parts[k][0] for k in moving), self.on.number(0.0))
        v = state[1]
        rates = [v, -load[0] - (load[2] + self.g) * self.ratio(mode, state)]
        for k, (radius, _, _) in enumerate(self.parts):
            rates.append(v * (radius / total) if k in moving else still)
        return rates

    def ratio(self, mode: Any, state: State) -> Any:
        """Force over the normal force."""
        s, moving = mode
        radius, mu, _ = self.parts[moving[0]]
        return state[2 + moving[0]] / radius + mu * s

    def guards(self, mode: Any, state: State, load: Load, now: State) -> Guards:
        if mode == "stuck":
            for s in (1, -1):
                yield s, (load[2] + self.g) * self.least(s, now) + load[0] * s
            return
        s, moving = mode
        yield "stop", state[1] * s
        ratio = self.ratio(mode, state) * s
        waiting = self.thresholds(s, now)
        for k, (radius, mu, capacity) in enumerate(self.parts):
            if k in moving:
                yield ("limit", k), -state[2 + k] * s + capacity
            elif waiting[k] is not None:
                yield ("join", k), state[2 + k] * s / radius + mu - ratio

    def at_rest(self, state: State, load: Load) -> tuple[Any, State]:
        zero = self.on.number(0.0)
        state = [state[0], zero, *state[2:]]
        for s in (1, -1):
            pull = -load[0] * s - (load[2] + self.g) * self.least(s, state)
            if self.on.value(pull) > self.on.slack:
                return self.moving(s, state), [state[0], zero + s * self.on.nudge, *state[2:]]
        return "stuck", state

    def change(self, mode: Any, name: Any, state: State, load: Load) -> tuple[Any, State]:
        if name == "stop":
            return self.at_rest(state, load)
        if name in (1, -1):
            zero = self.on.number(0.0)
            return self.moving(name, state), [state[0], zero + name * self.on.nudge, *state[2:]]
        s, moving = mode
        for k in moving:  # exactly at their stops, also where two arrive together
            capacity = self.parts[k][2]
            if self.on.value(capacity - state[2 + k] * s) < self.on.slack:
                state[2 + k] = self.on.value(capacity * s)
        return self.moving(s, state), state


class OneInterface(Model):
    """A slider on or under a structure; the demand is what its bond would have to carry."""

    def demand(self, state: State, load: Load) -> Any:
        raise NotImplementedError

    def guards(self, mode: Any, state: State, load: Load, now: State) -> Guards:
        if mode == "stuck":
            q = self.demand(state, load)
            yield 1, self.level() - q
            if not self.system["friction"].get("one_way"):
                yield -1, self.level() + q
        else:
            yield "stop", state[1] * mode

    def at_rest(self, state: State, load: Load) -> tuple[Any, State]:
        zero = self.on.number(0.0)
        state = [state[0], zero, *state[2:]]
        q = self.demand(state, load)
        s = self.sign(q)
        held = s < 0 and self.system["friction"].get("one_way")
        if self.on.value(q * s - self.level()) > self.on.slack and not held:
            return s, [state[0], zero + s * self.on.nudge, *state[2:]]
        return "stuck", state

    def change(self, mode: Any, name: Any, state: State, load: Load) -> tuple[Any, State]:
        if name == "stop":
            return self.at_rest(state, load)
        return name, [state[0], self.on.number(0.0) + name * self.on.nudge, *state[2:]]


class Isolated(OneInterface):
    """A structure on a sliding base: x, v, and y, y' of each mode on a fixed base.

    Decoupled: a rigid block under the average acceleration of a structure that does not feel it.
    """

    def __init__(self, system: Mapping[str, Any], numbers: Numbers) -> None:
        super().__init__(system, numbers)
        number = numbers.number
        self.stiffness = number(system.get("spring", 0.0)) ** 2
        self.damping = number(system.get("damping", 0.0))
        self.modes = [
            tuple(number(one[name]) for name in ("mass_fraction", "frequency", "damping_ratio"))
            for one in system["modes"]
        ]
        self.base = number(1.0) - sum((one[0] for one in self.modes), number(0.0))
        self.decoupled = bool(system.get("decoupled"))

    def begin(self, start: Mapping[str, Any]) -> State:
        return [*super().begin(start), *(self.on.number(0.0) for _ in self.modes * 2)]

    def forces(self, state: State) -> list[Any]:
        """Of spring and damper of each mode, over its mass."""
        found: list[Any] = []
        for (_, w, z), y, rate in zip(self.modes, state[2::2], state[3::2], strict=True):
            found.append(rate * (2 * z * w) + y * (w * w))
        return found

    def demand(self, state: State, load: Load) -> Any:
        q = -load[0] * self.base - state[0] * self.stiffness
        for (fraction, _, _), force in zip(self.modes, self.forces(state), strict=True):
            q = q + force * fraction
        return q

    def field(self, mode: Any, state: State, load: Load) -> Sequence[Any]:
        still = state[0] * 0
        slip = still
        if mode != "stuck":
            slip = self.demand(state, load) - state[1] * self.damping - mode * self.level()
            if not self.decoupled:
                slip = slip / self.base
        felt = still if self.decoupled else slip
        rates = [still if mode == "stuck" else state[1], slip]
        for rate, force in zip(state[3::2], self.forces(state), strict=True):
            rates += [rate, -load[0] - force - felt]
        return rates


class OnFloor(OneInterface):
    """Equipment on a floor of one mode: x, v relative to the floor, and z, z' of the floor."""

    def __init__(self, system: Mapping[str, Any], numbers: Numbers) -> None:
        super().__init__(system, numbers)
        floor, number = system["floor"], numbers.number
        self.w, self.z = number(floor["frequency"]), number(floor["damping_ratio"])
        self.mass_ratio = number(floor["mass_ratio"])

    def begin(self, start: Mapping[str, Any]) -> State:
        return [*super().begin(start), self.on.number(0.0), self.on.number(0.0)]

    def force(self, state: State) -> Any:
        return state[3] * (2 * self.z * self.w) + state[2] * (self.w * self.w)

    def demand(self, state: State, load: Load) -> Any:
        return self.force(state) / (1 + self.mass_ratio)

    def field(self, mode: Any, state: State, load: Load) -> Sequence[Any]:
        still = state[0] * 0
        if mode == "stuck":
            return still, still, state[3], -load[0] - self.demand(state, load)
        friction = mode * self.level()
        absolute = -self.force(state) + friction * self.mass_ratio
        return state[1], -absolute - friction, state[3], absolute - load[0]


class Rocking(Model):
    """The slender block: theta, theta'. A mode is "rest", "over" or the side."""

    names = ("rotation",)

    def __init__(self, system: Mapping[str, Any], numbers: Numbers) -> None:
        super().__init__(system, numbers)
        number = numbers.number
        self.p2 = number(system["p"]) ** 2 / self.g
        right = system["alpha"]
        self.alpha = {1: number(right), -1: number(system.get("alpha_left", right))}
        self.restitution = number(system["restitution"])
        self.fell = 0

    def begin(self, start: Mapping[str, Any]) -> State:
        number = self.on.number
        return [number(start.get("rotation", 0.0)), number(start.get("rate", 0.0))]

    def field(self, mode: Any, state: State, load: Load) -> Sequence[Any]:
        theta, rate = state
        if mode in ("rest", "over"):
            return theta * 0, theta * 0
        lever = theta - mode * self.alpha[mode]
        return rate, ((load[2] + self.g) * lever - load[0]) * self.p2

    def guards(self, mode: Any, state: State, load: Load, now: State) -> Guards:
        if mode == "rest":
            for s in (1, -1):
                yield s, (load[2] + self.g) * self.alpha[s] + load[0] * s
        elif mode != "over":
            yield "impact", state[0] * mode
            yield "fallen", -state[0] * mode + self.alpha[mode] * 10

    def at_rest(self, state: State, load: Load) -> tuple[Any, State]:
        zero = self.on.number(0.0)
        for s in (1, -1):
            pull = -load[0] * s - (load[2] + self.g) * self.alpha[s]
            if self.on.value(pull) > self.on.slack:
                return s, [zero + s * self.on.nudge, zero]
        return "rest", [zero, zero]

    def first(self, state: State, load: Load) -> tuple[Any, State]:
        return self.at_rest(state, load) if state[0] == 0 else (self.sign(state[0]), state)

    def change(self, mode: Any, name: Any, state: State, load: Load) -> tuple[Any, State]:
        zero = self.on.number(0.0)
        if name == "impact":
            after = self.on.value(state[1] * self.restitution)
            if abs(after) < self.on.speed:
                return self.at_rest(state, load)
            # Off the zero, by a tiny part of the height of the rebound.
            return -mode, [zero - mode * 1e-12 * after * after, after]
        if name == "fallen":
            self.fell = mode
            return "over", state
        return name, [zero + name * self.on.nudge, zero]


class RigidBlock(Model):
    """A rigid block on the corners of its base: x of its middle or corner, theta and their rates.

    The state is that of the center of mass: X, Y, theta, X', Y', theta'. Modes are "rest", "over",
    "flight", (0, s) sliding on its base, (c, 0) turning about the corner c, and (c, s) while that
    slips in the direction s.
    """

    names = ("rotation",)

    def __init__(self, system: Mapping[str, Any], numbers: Numbers) -> None:
        super().__init__(system, numbers)
        number = numbers.number
        width, height = system["width"], system["height"]
        aside, up = system.get("center", (0.0, height / 2))
        self.up = number(up)
        self.foot = {1: number(width / 2 - aside), -1: number(-width / 2 - aside)}
        self.inertia = (
            number(system.get("gyration_radius", math.hypot(width, height) / math.sqrt(12))) ** 2
        )
        self.mu = None if system.get("mu") is None else number(system["mu"])
        self.lever = number(system.get("lever", 1.0))
        self.fell = 0

    def begin(self, start: Mapping[str, Any]) -> State:
        on = self.on
        theta, rate = on.number(start.get("rotation", 0.0)), on.number(start.get("rate", 0.0))
        if on.value(theta) == 0:
            return [theta, self.up, theta, theta, theta, rate]
        x, y = self.corner(self.sign(theta), theta)
        # The corner stands where it stood while the base was down.
        return [self.foot[self.sign(theta)] - x, -y, theta, -rate * y, rate * x, rate]

    def corner(self, side: int, theta: Any) -> tuple[Any, Any]:
        """From the center of mass."""
        sine, cosine = self.on.sin(theta), self.on.cos(theta)
        x, y = self.foot[side], -self.up
        return x * cosine + y * sine, y * cosine - x * sine

    def contact(self, mode: Any, state: State, load: Load) -> tuple[Any, Any, Any]:
        """Friction and pressure on the corner, per unit mass, and the angular acceleration."""
        side, slip = mode
        n, weight, w = load[0], load[2] + self.g, state[5]
        x, y = self.corner(side, state[2])
        if slip:
            drag = self.mu * -slip  # the friction over the pressure
            pressure = (weight + w * w * y) / (1 + x * (x - y * drag) / self.inertia)
            return drag * pressure, pressure, (y * drag - x) * pressure / self.inertia
        turn = (y * n - x * weight) / (self.inertia + x * x + y * y)
        return n - turn * y + w * w * x, weight + turn * x + w * w * y, turn

    def field(self, mode: Any, state: State, load: Load) -> Sequence[Any]:
        zero = state[0] * 0
        n, weight = load[0], load[2] + self.g
        if mode in ("rest", "over"):
            return (zero,) * 6
        if mode == "flight":
            return (*state[3:], -n, -weight, zero)
        if mode[0] == 0:
            return (state[3], zero, zero, -n - weight * self.mu * mode[1], zero, zero)
        friction, pressure, turn = self.contact(mode, state, load)
        return (*state[3:], friction - n, pressure - weight, turn)

    def guards(self, mode: Any, state: State, load: Load, now: State) -> Guards:
        n, weight = load[0], load[2] + self.g
        if mode == "rest":
            yield "off", weight
            for s in (1, -1):
                if self.mu is not None:
                    yield ("slides", s), weight * self.mu + n * s
                yield ("tips", s), weight * self.foot[s] * s + n * s * self.up
        elif mode == "flight":
            for side in (1, -1):
                yield ("lands", side), state[1] + self.corner(side, state[2])[1]
        elif mode != "over" and mode[0] == 0:
            yield "off", weight
            yield "stop", state[3] * mode[1]
        elif mode != "over":
            side, slip = mode
            friction, pressure, _ = self.contact(mode, state, load)
            yield "base", state[2] * side
            yield "off", pressure
            yield "fallen", self.on.pi / 2 - state[2] * side
            if slip:
                yield "stop", (state[3] + state[5] * self.corner(side, state[2])[1]) * slip
            elif self.mu is not None:
                yield ("slips", -1), pressure * self.mu - friction
                yield ("slips", 1), pressure * self.mu + friction

    def watched(self, state: State) -> Any:
        return state[2]

    def turning(self, state: State) -> Any:
        return state[5]

    def displacement(self, state: State) -> Any:
        """Of the middle of the base."""
        middle = (self.foot[1] + self.foot[-1]) / 2
        sine, cosine = self.on.sin(state[2]), self.on.cos(state[2])
        return state[0] + middle * cosine - self.up * sine - middle

    def final(self, state: State) -> list[Any]:
        return [state[2]]

    def first(self, state: State, load: Load) -> tuple[Any, State]:
        if self.on.value(state[2]) == 0:
            return self.at_rest(state, load)
        return self.stand(self.sign(state[2]), state, load, 0)

    def at_rest(self, state: State, load: Load) -> tuple[Any, State]:
        """On its base: at rest, or sliding with the speed that it has, or off."""
        value, zero, on = self.on.value, self.on.number(0.0), self.on
        n, weight, speed = value(load[0]), value(load[2] + self.g), value(state[3])
        flat = [state[0], self.up, zero, zero, zero, zero]
        if weight <= 0:
            return "flight", [*flat[:3], state[3], zero, zero]
        if abs(speed) > on.speed:
            s = 1 if speed > 0 else -1
            return (0, s), [*flat[:3], state[3], zero, zero]
        s = -1 if n > 0 else 1
        if self.mu is not None and abs(n) - value(self.mu) * weight > on.slack:
            return self.leave("slides", s, flat, load)
        if abs(n) * value(self.up) - weight * value(self.foot[s] * s) > on.slack:
            return self.leave("tips", s, flat, load)
        return "rest", flat

    def leave(self, way: str, s: int, flat: State, load: Load) -> tuple[Any, State]:
        """From rest to the side s."""
        nudge, zero = self.on.number(0.0) + s * self.on.nudge, self.on.number(0.0)
        slides = self.mu is not None and self.on.value(self.mu * self.up - self.foot[s] * s) <= 0
        if way == "slides" and slides:
            return (0, s), [*flat[:3], nudge, zero, zero]
        y = self.corner(s, nudge)[1]
        return self.stand(s, [flat[0], -y, nudge, zero, zero, zero], load, 0)

    def stand(self, side: int, state: State, load: Load, slip: int) -> tuple[Any, State]:
        """On one corner, that slips, or not, or moves off to a side."""
        value = self.on.value
        if not slip:
            friction, pressure, _ = self.contact((side, 0), state, load)
            if value(pressure) <= 0:
                return "flight", state
            if self.mu is None or abs(value(friction)) <= value(self.mu * pressure):
                return (side, 0), state
            slip = -self.sign(friction)
        if value(self.contact((side, slip), state, load)[1]) <= 0:
            return "flight", state
        return (side, slip), state

    def struck(self, side: int, state: State) -> tuple[State, int]:
        """An impulse stops a corner: Coulomb's law for impulses. The state, and how it slips."""
        value = self.on.value
        x, y = self.corner(side, state[2])
        vx, vy, w, k = state[3], state[4], state[5], self.inertia
        slide, fall = value(vx + w * y), value(vy - w * x)
        # About the corner the moment of momentum stays.
        after = (k * w - y * vx + x * vy) / (k + x * x + y * y)
        pull, push = value(-after * y - vx), value(after * x - vy)
        if self.mu is None or abs(pull) <= value(self.mu) * push:
            return [*state[:3], -after * y, after * x, after], 0
        for slip in (1, -1) if pull < 0 else (-1, 1):
            ratio = self.mu * -slip
            push = -fall / (1 + x * x / k - x * y * ratio / k)
            turned = w + (y * ratio - x) * push / k
            moved = vx + ratio * push
            if value(push) > 0 and value(moved + turned * y) * slip > 0:
                return [*state[:3], moved, vy + push, turned], slip
        raise ArithmeticError(f"an impact at {slide:g} m/s, {fall:g} m/s that no law describes")

    def landed(self, state: State, load: Load) -> tuple[Any, State]:
        """Both corners are down: one of them stays, if the other then leaves; or both do."""
        value, zero = self.on.value, self.on.number(0.0)
        state = [state[0], self.up, zero, *state[3:]]
        speeds = {s: value(state[4] - state[5] * self.foot[s]) for s in (1, -1)}
        for side in sorted(speeds, key=lambda one: speeds[one]):
            if speeds[side] >= 0:
                continue
            foot, inner = self.foot[side], self.foot[side] * self.lever
            after = self.inertia * state[5] + self.up * state[3] + inner * state[4]
            after = after / (self.inertia + self.up**2 + inner * foot)
            push, pull = value(foot * after - state[4]), value(self.up * after - state[3])
            found, slip = [*state[:3], self.up * after, foot * after, after], 0
            if self.mu is not None and abs(pull) > value(self.mu) * push:
                found, slip = self.struck(side, state)
            if value(found[5]) * side > self.on.speed:
                theta = zero + side * 1e-12 * found[5] * found[5]
                found[1:3] = -self.corner(side, theta)[1], theta
                return self.stand(side, found, load, slip)
        impulse = math.inf if self.mu is None else abs(value(state[4])) * value(self.mu)
        if abs(value(state[3])) <= max(impulse, self.on.speed):
            state[3] = zero
        else:
            state[3] = state[3] - self.sign(state[3]) * impulse
        return self.at_rest(state, load)

    def change(self, mode: Any, name: Any, state: State, load: Load) -> tuple[Any, State]:
        zero = self.on.number(0.0)
        if name == "fallen":
            self.fell = self.sign(state[2])
            return "over", [*state[:3], zero, zero, zero]
        if name == "off":
            # Off the ground, by next to nothing.
            return "flight", [state[0], state[1] + self.on.nudge, *state[2:]]
        if name[0] in ("slides", "tips"):
            return self.leave(name[0], name[1], state, load)
        if name == "stop" and mode[0] == 0:
            return self.at_rest([*state[:3], zero, zero, zero], load)
        if name == "base":
            return self.landed(state, load)
        if name == "stop":
            side = mode[0]
            x, y = self.corner(side, state[2])
            state = [state[0], -y, state[2], -state[5] * y, state[5] * x, state[5]]
            found, state = self.stand(side, state, load, 0)
            return found, self.nudged(found, state)
        if name[0] == "slips":
            found = mode[0], name[1]
            return found, self.nudged(found, state)
        if abs(self.on.value(state[2])) < 1e-10:
            return self.landed(state, load)
        struck, slip = self.struck(name[1], state)
        return self.stand(name[1], struck, load, slip)

    def nudged(self, mode: Any, state: State) -> State:
        """With next to no speed in the direction in which a corner begins to slip."""
        slip = 0 if isinstance(mode, str) else mode[1]
        return [*state[:3], state[3] + slip * self.on.nudge, *state[4:]]


MODELS: Mapping[str, type[Model]] = {
    "slider": Slider,
    "planar": Planar,
    "series": Series,
    "isolated": Isolated,
    "floor": OnFloor,
    "rocking": Rocking,
    "rigid_block": RigidBlock,
}


def kind_of(system: Mapping[str, Any]) -> str:
    series = system["kind"] == "slider" and system["friction"]["kind"] == "series"
    return "series" if series else str(system["kind"])


def model_of(system: Mapping[str, Any], numbers: Numbers) -> Model:
    if system["kind"] == "cart":
        raise NotTriedError("which lines of friction slip next")
    return MODELS[kind_of(system)](system, numbers)


def answers_of(model: Model, state: State, peak: Any) -> dict[str, list[Any]]:
    """By quantity, as a problem asks for them."""
    name = model.names[0]
    found = {f"final_{name}": model.final(state), f"peak_{name}": [peak]}
    if isinstance(model, RigidBlock):
        found["final_displacement"] = [model.displacement(state)]
    if isinstance(model, Rocking | RigidBlock):
        fell: dict[str, list[Any]] = {"overturned": [model.on.number(float(model.fell))]}
        return fell if model.fell else {**fell, **found}
    return found
