"""Writes the problems: solves each by the independent program, and compares the library.

    python referee/make_problems.py [ID ...]

A problem is kept if two runs of the independent program, of other order and steps, agree to 1e-20
of the scale, and the library agrees with them to the uncertainty that is stated.
"""

from __future__ import annotations

import json
import math
import sys
import time
from multiprocessing import Pool
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).parent))
import independent
from stickslip.referee.adapters import own
from stickslip.referee.problems import CLASSES, parse

FOLDER = Path(__file__).parent / "problems"
G = 9.80665
ROUNDED = "rounded to 1e-4 m/s^2; straight lines between samples"


def rounded(values) -> list[float]:
    return [round(float(v), 4) + 0.0 for v in values]


def times(dt: float, duration: float):
    return dt * np.arange(round(duration / dt) + 1)


def hum(factor=1.0, dt=0.05, duration=10.0, vertical=None, transverse=None):
    t = times(dt, duration)
    ground = {
        "dt": dt,
        "formula": f"along = {factor:g} (2 sin(4.1 t) + 1.3 cos(9.7 t + 0.4))",
        "along": rounded(factor * (2 * np.sin(4.1 * t) + 1.3 * np.cos(9.7 * t + 0.4))),
    }
    if transverse:
        ground["formula"] += (
            f"; transverse = {transverse:g} (1.5 sin(5.3 t + 1.1) + 0.8 cos(11.3 t))"
        )
        ground["transverse"] = rounded(
            transverse * (1.5 * np.sin(5.3 * t + 1.1) + 0.8 * np.cos(11.3 * t))
        )
    if vertical:
        ground["formula"] += f"; vertical = {vertical:g} cos(7.9 t + 0.2)"
        ground["vertical"] = rounded(vertical * np.cos(7.9 * t + 0.2))
    ground["formula"] += f", t = 0, {dt:g} s, .., {duration:g} s [m/s^2], {ROUNDED}"
    return ground


def burst(factor=1.0, dt=0.02, duration=8.0, vertical=None, transverse=None):
    """Grows and decays as an earthquake does."""
    t = times(dt, duration)
    shape = (t / 2) ** 2 * np.exp(2 - t)
    along = shape * (
        2.4 * np.sin(7.3 * t) + 1.6 * np.sin(13.1 * t + 1) + 0.9 * np.sin(23.7 * t + 2)
    )
    ground = {
        "dt": dt,
        "formula": f"along = {factor:g} e(t) (2.4 sin(7.3 t) + 1.6 sin(13.1 t + 1)"
        " + 0.9 sin(23.7 t + 2)),"
        " e(t) = (t/2)^2 exp(2 - t)",
        "along": rounded(factor * along),
    }
    if transverse:
        ground["formula"] += (
            f"; transverse = {transverse:g} e(t) (2 sin(6.1 t + 0.5) + 1.5 sin(15.3 t))"
        )
        ground["transverse"] = rounded(
            transverse * shape * (2 * np.sin(6.1 * t + 0.5) + 1.5 * np.sin(15.3 * t))
        )
    if vertical:
        ground["formula"] += f"; vertical = {vertical:g} e(t) sin(17.9 t + 0.7)"
        ground["vertical"] = rounded(vertical * shape * np.sin(17.9 * t + 0.7))
    ground["formula"] += f", t = 0, {dt:g} s, .., {duration:g} s [m/s^2], {ROUNDED}"
    return ground


def pulse(amplitude, period=1.0, dt=0.02, duration=4.0, cycles=1.0):
    t = times(dt, duration)
    along = np.where(t < cycles * period, amplitude * np.sin(2 * math.pi * t / period), 0.0)
    return {
        "dt": dt,
        "formula": f"along = {amplitude:g} sin(2 pi t/{period:g}) for t < {cycles * period:g} s,"
        f" then 0, t = 0, {dt:g} s, .., {duration:g} s [m/s^2], {ROUNDED}",
        "along": rounded(along),
    }


def constant(along=0.0, duration=4.0, dt=0.1, **others):
    count = round(duration / dt) + 1
    ground = {
        "dt": dt,
        "formula": f"constant: along = {along:g}"
        + "".join(f", {name} = {value:g}" for name, value in others.items())
        + " m/s^2",
        "along": [float(along)] * count,
    }
    for name, value in others.items():
        ground[name] = [float(value)] * count
    return ground


def sine(amplitude, frequency, dt=0.02, duration=10.0, **others):
    t = times(dt, duration)
    ground = {
        "dt": dt,
        "formula": f"along = {amplitude:g} sin({frequency:g} t)",
        "along": rounded(amplitude * np.sin(frequency * t)),
    }
    for name, (a, w, phase) in others.items():
        ground["formula"] += f"; {name} = {a:g} sin({w:g} t + {phase:g})"
        ground[name] = rounded(a * np.sin(w * t + phase))
    ground["formula"] += f", t = 0, {dt:g} s, .., {duration:g} s [m/s^2], {ROUNDED}"
    return ground


def coulomb(mu, **more):
    return {"kind": "coulomb", "mu": mu, **more}


def slider(friction, **more):
    return {"kind": "slider", "gravity": G, "friction": friction, **more}


def planar(mu, **more):
    return {"kind": "planar", "gravity": G, "friction": coulomb(mu), **more}


def isolated(mu, modes, **more):
    keys = ("mass_fraction", "frequency", "damping_ratio")
    one_way = {"one_way": True} if more.pop("one_way", False) else {}
    return {
        "kind": "isolated",
        "gravity": G,
        "friction": coulomb(mu, **one_way),
        "modes": [dict(zip(keys, m)) for m in modes],
        **more,
    }


def column(mu, count, height, velocity, damping, **more):
    modes = []
    for j in range(1, count + 1):
        modes.append(
            (
                8 / ((2 * j - 1) ** 2 * math.pi**2),
                (2 * j - 1) * math.pi * velocity / (2 * height),
                damping,
            )
        )
    system = isolated(mu, modes, one_way=True, **more)
    system["column"] = {"height": height, "shear_velocity": velocity, "damping_ratio": damping}
    return system


def on_floor(mu, frequency, damping, ratio, **more):
    floor = {"frequency": frequency, "damping_ratio": damping, "mass_ratio": ratio}
    return {"kind": "floor", "gravity": G, "friction": coulomb(mu), "floor": floor, **more}


def rocking(p, alpha, restitution, **more):
    return {
        "kind": "rocking",
        "gravity": G,
        "p": p,
        "alpha": alpha,
        "restitution": restitution,
        **more,
    }


def rigid(width, height, mu, **more):
    return {
        "kind": "rigid_block",
        "gravity": G,
        "width": width,
        "height": height,
        "mu": mu,
        **more,
    }


def caster(x, y, heading, share=0.25, side_mu=0.1, rolling_mu=0.01, reach=0.04):
    return {
        "at": [x, y],
        "share": share,
        "heading": heading,
        "side_mu": side_mu,
        "rolling_mu": rolling_mu,
        "reach": reach,
    }


def wheel(x, y, share=0.25, side_mu=0.5, rolling_mu=0.01):
    one = caster(x, y, 0.0, share, side_mu, rolling_mu)
    del one["reach"]
    return one


def cart(*supports, radius=0.25):
    return {
        "kind": "cart",
        "gravity": G,
        "radius_of_gyration": radius,
        "supports": list(supports),
    }


def bearing(*elements):
    keys = ("radius", "mu", "capacity")
    return slider({"kind": "series", "elements": [dict(zip(keys, e)) for e in elements]})


def triple(radii, mu, capacities):
    """Elements of a triple pendulum: inner twice, then what each outer surface adds."""
    (l1, l2, l3), (m1, m2, m3), (d1, d2, d3) = radii, mu, capacities
    return bearing(
        (l1, m1, d1 + l1 * d2 / l2),
        (l1, m1, d1 + l1 * d3 / l3),
        (l2 - l1, m2, d2 * (1 - l1 / l2)),
        (l3 - l1, m3, d3 * (1 - l1 / l3)),
    )


STICK, RECORD, SPEED, VERTICAL, TWO, SPRINGS, STRUCTURES, ROCKING, CARTS = CLASSES
MILLIMETER = 1e-3


FLIES = (
    "The ground falls away faster than the block: it flies, lands without rebound, and the impulse "
    "of friction at landing is mu times that of landing."
)
CLIPPED = (
    "The same, but the block never leaves the ground: without normal force it slides without "
    "friction."
)
MISSES = (
    "A push against the motion brakes the block. Because it also moves across at 1e-{} m/s, it "
    "just misses the rest, and turns round."
)


def listed():
    """(class, id, description, system, ground, more)."""
    # ---- stick
    rest = "It must not move at all. "
    yield (
        STICK,
        "stick-sine",
        rest + "A sine of 0.98 of the friction.",
        slider(coulomb(0.2)),
        sine(1.92, 6.3),
        {},
    )
    yield (
        STICK,
        "stick-slope",
        rest + "A slope of 11 degrees, no ground motion: tan(11) = 0.194 < 0.2.",
        slider(coulomb(0.2), slope_degrees=11.0),
        constant(0.0, 20.0),
        {},
    )
    yield (
        STICK,
        "stick-slope-sine",
        rest + "The same slope, with a sine that takes what is left.",
        slider(coulomb(0.25), slope_degrees=11.0),
        sine(0.5, 9.0),
        {},
    )
    yield (
        STICK,
        "stick-vertical",
        rest + "Vertical motion lightens the block; together just below the friction.",
        slider(coulomb(0.3)),
        sine(1.5, 5.0, vertical=(4.0, 5.0, 0.0)),
        {},
    )
    yield (
        STICK,
        "stick-displaced",
        rest + "A spring pulls it with 0.99 of the friction, no ground motion.",
        slider(coulomb(0.1), spring=3.0),
        constant(0.0, 20.0),
        {"start": {"displacement": [0.1078]}},
    )
    yield (
        STICK,
        "stick-static",
        rest + "The load is above kinetic and below static friction.",
        slider({"kind": "static_kinetic", "mu_static": 0.3, "mu_kinetic": 0.2}),
        sine(2.9, 4.0),
        {},
    )
    yield (
        STICK,
        "stick-planar",
        rest + "A load that turns in a circle within the circle of friction.",
        planar(0.2),
        sine(1.94, 5.0, transverse=(1.94, 5.0, 1.5707963)),
        {},
    )
    yield (
        STICK,
        "stick-after-slip",
        "It slides once, early; then it must stay for 18 s under half of the friction.",
        slider(coulomb(0.1)),
        pulse_then_sine(),
        {},
    )

    # ---- one record
    yield (
        RECORD,
        "record-hum",
        "Two tones, friction of 0.1: it slides most of the time.",
        slider(coulomb(0.1)),
        hum(),
        {},
    )
    yield (
        RECORD,
        "record-hum-high",
        "Two tones, friction of 0.25: short slips.",
        slider(coulomb(0.25)),
        hum(),
        {},
    )
    yield (
        RECORD,
        "record-burst",
        "A burst of three tones, friction of 0.15.",
        slider(coulomb(0.15)),
        burst(),
        {},
    )
    yield (
        RECORD,
        "record-newmark",
        "Newmark's block: it cannot slide back.",
        slider(coulomb(0.12, one_way=True)),
        burst(1.2),
        {},
    )
    yield (
        RECORD,
        "record-slope",
        "A slope of 15 degrees, friction of 0.35, both ways.",
        slider(coulomb(0.35), slope_degrees=15.0),
        burst(0.8),
        {},
    )
    yield (
        RECORD,
        "record-unequal",
        "Unequal friction forward and backward.",
        slider(coulomb(0.08, mu_backward=0.16)),
        hum(),
        {},
    )
    yield (
        RECORD,
        "record-pulse",
        "One cycle of a sine, as near a fault.",
        slider(coulomb(0.2)),
        pulse(5.0),
        {},
    )
    yield (
        RECORD,
        "record-braking",
        "No ground motion: a block that slides at 2 m/s comes to rest after v^2/(2 mu g).",
        slider(coulomb(0.3)),
        constant(0.0, 2.0),
        {"start": {"velocity": [2.0]}, "closed": braking},
    )

    # ---- laws of the speed
    velocity = {"kind": "velocity", "mu_slow": 0.06, "mu_fast": 0.15, "rate": 20.0}
    yield (
        SPEED,
        "speed-teflon",
        "Friction rises with the speed, as on PTFE.",
        slider(velocity),
        hum(),
        {},
    )
    yield (
        SPEED,
        "speed-teflon-spring",
        "The same with a spring.",
        slider(velocity, spring=2.5),
        burst(1.2),
        {},
    )
    yield (
        SPEED,
        "speed-stribeck",
        "Friction falls with the speed (exponent 1), with a spring.",
        slider(
            {
                "kind": "stribeck",
                "mu_static": 0.16,
                "mu_kinetic": 0.1,
                "velocity": 0.1,
                "exponent": 1,
            },
            spring=4.0,
        ),
        hum(),
        {},
    )
    yield (
        SPEED,
        "speed-stribeck-2",
        "Friction falls with the speed (exponent 2).",
        slider(
            {
                "kind": "stribeck",
                "mu_static": 0.16,
                "mu_kinetic": 0.1,
                "velocity": 0.1,
                "exponent": 2,
            }
        ),
        burst(),
        {},
    )
    yield (
        SPEED,
        "speed-static",
        "Static friction above kinetic.",
        slider({"kind": "static_kinetic", "mu_static": 0.16, "mu_kinetic": 0.1}),
        hum(),
        {},
    )
    yield (
        SPEED,
        "speed-static-spring",
        "Static friction far above kinetic, with a spring: every breakaway is a jump.",
        slider({"kind": "static_kinetic", "mu_static": 0.2, "mu_kinetic": 0.06}, spring=5.0),
        burst(1.5),
        {},
    )

    # ---- vertical motion
    yield (
        VERTICAL,
        "vertical-mild",
        "Vertical motion of a quarter of gravity.",
        slider(coulomb(0.1)),
        hum(vertical=2.5),
        {},
    )
    yield (
        VERTICAL,
        "vertical-unloading",
        "It breaks away because the ground drops under it, at constant push.",
        slider(coulomb(0.3)),
        sine_on_constant(),
        {},
    )
    yield (
        VERTICAL,
        "vertical-spring",
        "With a spring.",
        slider(coulomb(0.1), spring=4.0),
        burst(vertical=4.0),
        {},
    )
    yield (
        VERTICAL,
        "vertical-slope",
        "On a slope: both components change load and normal force.",
        slider(coulomb(0.35), slope_degrees=12.0),
        burst(vertical=3.0),
        {},
    )
    yield (
        VERTICAL,
        "vertical-pendulum",
        "A friction pendulum: its spring is the normal force over the radius.",
        slider(coulomb(0.06), pendulum_radius=1.5),
        burst(vertical=4.0),
        {},
    )
    yield VERTICAL, "vertical-flight", FLIES, slider(coulomb(0.15)), burst(vertical=14.0), {}
    yield (
        VERTICAL,
        "vertical-clipped",
        CLIPPED,
        slider(coulomb(0.15), contact="clipped"),
        burst(vertical=14.0),
        {},
    )

    # ---- two directions
    yield (
        TWO,
        "planar-braking",
        "A sliding block under a constant load across its path comes to rest: one stop.",
        planar(0.2),
        constant(0.4, 3.0, transverse=-0.7),
        {"start": {"velocity": [1.0, 0.2]}},
    )
    yield (
        TWO,
        "planar-hum",
        "Two components of two tones each.",
        planar(0.1),
        hum(transverse=1.0),
        {},
    )
    yield TWO, "planar-burst", "Two components of a burst.", planar(0.15), burst(transverse=1.0), {}
    yield (
        TWO,
        "planar-spring",
        "Two components and a spring.",
        planar(0.1, spring=2.0),
        burst(transverse=1.0),
        {},
    )
    yield (
        TWO,
        "planar-vertical",
        "Three components.",
        planar(0.12),
        burst(transverse=1.0, vertical=4.0),
        {},
    )
    for digits in (3, 6, 9):
        miss = float(f"1e-{digits}")
        yield (
            TWO,
            f"planar-miss-1e-{digits}",
            MISSES.format(digits),
            planar(0.1),
            constant(-2.0, 1.0, transverse=0.0),
            {"start": {"velocity": [-1.0, miss]}},
        )

    # ---- springs, stops and bearings
    yield (
        SPRINGS,
        "spring-free",
        "A block on a spring comes to rest from 0.3 m without ground motion.",
        slider(coulomb(0.05), spring=5.0),
        constant(0.0, 6.0),
        {"start": {"displacement": [0.3]}, "closed": ring_down},
    )
    yield (
        SPRINGS,
        "spring-soft",
        "An isolator of 3.1 s.",
        slider(coulomb(0.05), spring=2.0),
        burst(1.5),
        {},
    )
    yield SPRINGS, "spring-stiff", "A stiff spring.", slider(coulomb(0.1), spring=20.0), hum(), {}
    yield (
        SPRINGS,
        "spring-damper",
        "A spring and a damper.",
        slider(coulomb(0.05), spring=4.0, damping=0.8),
        hum(),
        {},
    )
    yield (
        SPRINGS,
        "spring-overdamped",
        "A damper beyond the critical one.",
        slider(coulomb(0.03), spring=3.0, damping=15.0),
        burst(1.5),
        {},
    )
    yield (
        SPRINGS,
        "stops-rebound",
        "Stops at 5 cm, restitution 0.6.",
        slider(coulomb(0.05), stops={"gap": 0.05, "restitution": 0.6}),
        hum(),
        {},
    )
    yield (
        SPRINGS,
        "stops-plastic",
        "Stops at 8 cm, without rebound.",
        slider(coulomb(0.05), stops={"gap": 0.08, "restitution": 0.0}),
        hum(),
        {},
    )
    yield (
        SPRINGS,
        "bearing-double",
        "A double pendulum.",
        bearing((1.2, 0.03, 0.3), (2.0, 0.08, 0.4)),
        burst(1.2),
        {},
    )
    yield (
        SPRINGS,
        "bearing-triple",
        "A triple pendulum, as four elements in series.",
        triple((0.3, 1.5, 1.5), (0.02, 0.05, 0.09), (0.03, 0.4, 0.4)),
        burst(2.0),
        {},
    )

    # ---- structures
    yield (
        STRUCTURES,
        "isolated-one",
        "A building of one mode on a sliding base.",
        isolated(0.1, [(0.7, 12.0, 0.03)]),
        hum(),
        {},
    )
    yield (
        STRUCTURES,
        "isolated-pendulum",
        "A building of two modes on a base with a spring.",
        isolated(0.06, [(0.6, 9.0, 0.02), (0.15, 27.0, 0.03)], spring=2.2),
        burst(1.5),
        {},
    )
    yield (
        STRUCTURES,
        "isolated-stuck",
        "Friction above what the building can ask for: the base must not move.",
        isolated(0.6, [(0.7, 12.0, 0.05)]),
        burst(0.5),
        {},
    )
    yield (
        STRUCTURES,
        "floor-light",
        "Light equipment on a floor of 2 Hz.",
        on_floor(0.2, 12.566, 0.03, 0.0),
        burst(0.8),
        {},
    )
    yield (
        STRUCTURES,
        "floor-heavy",
        "Equipment of a third of the mass of the floor.",
        on_floor(0.15, 9.0, 0.02, 0.333),
        hum(),
        {},
    )
    yield (
        STRUCTURES,
        "slope-decoupled",
        "The average acceleration of a soil column drives Newmark's block.",
        column(0.1, 1, 20.0, 150.0, 0.1, decoupled=True),
        burst(),
        {},
    )
    yield (
        STRUCTURES,
        "slope-coupled",
        "A soil column of three modes slides itself, downhill only.",
        column(0.1, 3, 20.0, 150.0, 0.1),
        burst(),
        {},
    )

    # ---- rocking
    yield (
        ROCKING,
        "rocking-free",
        "A slender block is released at half of its critical angle.",
        rocking(2.0, 0.2, 0.9),
        constant(0.0, 3.0),
        {"start": {"rotation": 0.1}, "uncertain": 1e-11, "closed": released},
    )
    yield (
        ROCKING,
        "rocking-record",
        "Two tones.",
        rocking(2.0, 0.15, 0.9),
        hum(0.6, duration=6.0),
        {"uncertain": 1e-9},
    )
    yield (
        ROCKING,
        "rocking-burst",
        "A burst; it comes to rest.",
        rocking(1.5, 0.2, 0.85),
        burst(0.9),
        {"uncertain": 1e-9},
    )
    yield (
        ROCKING,
        "rocking-vertical",
        "Horizontal and vertical motion.",
        rocking(2.0, 0.18, 0.88),
        burst(vertical=3.0),
        {"uncertain": 1e-9},
    )
    yield (
        ROCKING,
        "rocking-stays",
        "Below the level of uplift: it must not rock.",
        rocking(2.0, 0.25, 0.9),
        sine(2.4, 5.0),
        {},
    )
    yield (
        ROCKING,
        "rocking-stands",
        "A sine of 10 rad/s, 2.95 times the level of uplift: it stands.",
        rocking(2.0, 0.2, 0.9),
        sine_cycle(2.95),
        {"uncertain": 1e-9},
    )
    yield (
        ROCKING,
        "rocking-falls",
        "The same with 3.1 times: it falls after one impact.",
        rocking(2.0, 0.2, 0.9),
        sine_cycle(3.1),
        {},
    )

    # ---- rigid blocks
    yield (
        ROCKING,
        "block-slides",
        "A rigid block with little friction only slides.",
        rigid(0.6, 1.5, 0.2),
        burst(),
        {},
    )
    yield (
        ROCKING,
        "block-released",
        "A rigid block is released from a rotation; it does not slip, and its impacts are plastic.",
        rigid(0.6, 1.8, 1.2),
        constant(0.0, 4.0),
        {"start": {"rotation": 0.15}, "uncertain": 1e-10},
    )
    yield (
        ROCKING,
        "block-slips",
        "It rocks on corners that slip.",
        rigid(0.5, 1.5, 0.36),
        burst(1.5, duration=6.0),
        {"uncertain": 1e-9},
    )
    yield (
        ROCKING,
        "block-flies",
        "Strong vertical motion throws it up while it rocks.",
        rigid(0.8, 2.0, 0.7),
        burst(1.2, duration=5.0, vertical=11.0),
        {"uncertain": 1e-9},
    )
    yield (
        ROCKING,
        "block-off-center",
        "Its center of mass is neither in the middle nor half way up.",
        rigid(0.7, 1.6, 0.8, center=[0.08, 0.7], gyration_radius=0.45),
        burst(1.9, duration=6.0),
        {"uncertain": 1e-9},
    )
    yield (
        ROCKING,
        "block-lever",
        "Its impacts act at 0.7 of the way to the new corner, and take less.",
        rigid(0.6, 1.8, 0.9, lever=0.7),
        burst(1.6, duration=5.0),
        {"uncertain": 1e-9},
    )

    # ---- carts
    yield (
        CARTS,
        "cart-stays",
        "Four casters, braced: the load is below all that they can carry. It must not move.",
        cart(
            caster(0.3, 0.2, 1.2),
            caster(0.3, -0.2, -1.3),
            caster(-0.3, 0.2, 0.3),
            caster(-0.3, -0.2, 2.9),
        ),
        sine(0.25, 5.0, duration=8.0, transverse=(0.25, 5.0, 1.5707963)),
        {},
    )
    yield (
        CARTS,
        "cart-casters",
        "Four casters at four headings.",
        cart(
            caster(0.3, 0.2, 0.3),
            caster(0.3, -0.2, 2.0),
            caster(-0.3, 0.2, -2.5),
            caster(-0.3, -0.2, -0.7),
        ),
        hum(0.7, duration=2.0, transverse=0.7),
        {"uncertain": 1e-11},
    )
    yield (
        CARTS,
        "cart-wheels",
        "Two casters in front and two fixed wheels behind: it goes along curves.",
        cart(
            caster(0.3, 0.2, 0.3),
            caster(0.3, -0.2, 2.0),
            wheel(-0.3, 0.2),
            wheel(-0.3, -0.2),
        ),
        hum(0.8, duration=2.0, transverse=-0.6),
        {"uncertain": 1e-11},
    )
    yield (
        CARTS,
        "cart-unequal",
        "Three casters of unequal loads, levels and reaches.",
        cart(
            caster(0.3, 0.0, 0.5, share=0.4, side_mu=0.12, reach=0.03),
            caster(-0.2, 0.25, 2.2, share=0.3, side_mu=0.08, reach=0.05),
            caster(-0.2, -0.25, -1.1, share=0.3, side_mu=0.1, rolling_mu=0.02),
            radius=0.22,
        ),
        hum(-0.7, duration=2.0, transverse=0.6),
        {"uncertain": 1e-11},
    )
    yield (
        CARTS,
        "cart-vertical",
        "Four casters under three components.",
        cart(
            caster(0.3, 0.2, -0.4),
            caster(0.3, -0.2, 1.1),
            caster(-0.3, 0.2, 2.6),
            caster(-0.3, -0.2, -2.1),
        ),
        hum(0.7, duration=2.0, transverse=-0.7, vertical=4.0),
        {"uncertain": 1e-11},
    )
    yield (
        CARTS,
        "cart-spins",
        "It spins on the spot, its wheels trail on a circle, and friction brakes it to rest.",
        cart(
            *(
                caster(x, y, round(math.atan2(y, x) + math.pi / 2 + math.asin(0.04 / 0.35), 12))
                for x, y in ((0.28, 0.21), (0.28, -0.21), (-0.28, 0.21), (-0.28, -0.21))
            )
        ),
        constant(0.0, 1.5, transverse=0.0),
        {"start": {"velocity": [0.0, 0.0], "rate": 1.5}, "uncertain": 1e-9},
    )


def sine_cycle(times_uplift):
    n = -0.2 * times_uplift * G * np.sin(2 * np.pi * np.arange(41) / 40)
    n[-1] = 0
    along = rounded([*n, *np.zeros(310)])
    return {
        "dt": 0.0157,
        "formula": f"along = -{times_uplift:g} 0.2 g sin(2 pi m/40) for m < 40, then 0, "
        f"m = 0 .. 350, dt = 0.0157 s [m/s^2], {ROUNDED}",
        "along": along,
    }


def pulse_then_sine():
    t = times(0.02, 20.0)
    along = np.where(t < 0.5, -3 * np.sin(2 * np.pi * t), 0) + np.where(
        t > 2, 0.49 * np.sin(8 * t), 0
    )
    return {
        "dt": 0.02,
        "formula": "along = -3 sin(2 pi t) for t < 0.5 s, 0.49 sin(8 t) for t > 2 s, 0 between, "
        f"t = 0, 0.02 s, .., 20 s [m/s^2], {ROUNDED}",
        "along": rounded(along),
    }


def sine_on_constant():
    t = times(0.02, 6.0)
    return {
        "dt": 0.02,
        "formula": f"along = -2; vertical = 5 sin(6 t), t = 0, 0.02 s, .., 6 s [m/s^2], {ROUNDED}",
        "along": [-2.0] * len(t),
        "vertical": rounded(5 * np.sin(6 * t)),
    }


# ---- closed forms


def braking():
    arb = independent.arb
    return 4 / (2 * arb(0.3) * arb(G))


def ring_down():
    """Each half swing loses 2 mu g/w^2, until the spring is weaker than friction."""
    arb = independent.arb
    step = arb(0.05) * arb(G) / 25
    x, side = arb(0.3), 1
    while x > step:
        x, side = x - 2 * step, -side
        if not x > 0:
            x, side = -x, -side
    return side * x


def released():
    """The rotation 3 s after the release, from Housner's quarter periods."""
    arb = independent.arb
    p, alpha, r = arb(2), arb(0.2), arb(0.9)
    phi, left, side = arb(0.1) / alpha, 30 * arb(0.1), 1

    def acosh(one):
        return (one + (one * one - 1).sqrt()).log()

    quarter = acosh(1 / (1 - phi)) / p
    begun = True
    while left > quarter:
        # A quarter down (a whole half swing is two of them); then the other side.
        left = left - quarter
        speed = r * (1 - (1 - phi) ** 2).sqrt()
        phi = 1 - (1 - speed * speed).sqrt()
        side, begun = -side, False
        quarter = 2 * acosh(1 / (1 - phi)) / p
        rising = speed
    if begun:
        return alpha * side * (1 - (1 - phi) * (p * left).cosh())
    cosh, sinh = (p * left).cosh(), (p * left).sinh()
    return alpha * side * (1 - cosh + rising * sinh)


# ---- write


def printed(number) -> str:
    return number.str(20, radius=False)


UNITS = {
    "final_displacement": "m",
    "peak_displacement": "m",
    "final_rotation": "rad",
    "peak_rotation": "rad",
}


def make(entry):
    group, name, words, system, ground, more = entry
    began = time.time()
    problem = {
        "id": name,
        "class": group,
        "description": words,
        "system": system,
        "start": more.get("start", {}),
        "ground": ground,
    }
    try:
        first = independent.answer(problem)
        again = independent.answer(problem, order=30, fineness=2, leave=46)
    except Exception:
        import traceback

        return f"{name}: {traceback.format_exc()}"
    first.pop("events", None)
    again.pop("events", None)
    fell = "overturned" in first and first["overturned"][0] != 0
    if fell:
        first = {"overturned": first["overturned"]}
    peak = first.get("peak_displacement") or first.get("peak_rotation") or [1.0]
    scale = abs(float(independent.mid(peak[0])))
    if system["kind"] in ("rigid_block", "cart"):  # whichever is larger, in m or rad
        scale = max([scale, *(float(abs(independent.mid(v))) for n in first for v in first[n])])
    start = more.get("start", {})
    moved = (
        scale > abs(start.get("displacement", [0.0])[0]) or "velocity" in start or group != STICK
    )
    if not moved or scale == 0:
        scale = MILLIMETER
    scale = float(f"{scale:.3g}")
    own_spread = max(
        float(abs(independent.mid(a - b))) for q in first for a, b in zip(first[q], again[q])
    )
    uncertain = more.get("uncertain", 1e-12)
    still = (group == STICK and name != "stick-after-slip") or name in (
        "isolated-stuck",
        "rocking-stays",
        "cart-stays",
    )
    answers = {}
    for quantity, values in first.items():
        answers[quantity] = {
            "value": [printed(independent.mid(v)) for v in values],
            "uncertainty": "0" if quantity == "overturned" or still else f"{uncertain * scale:.0e}",
            "unit": UNITS.get(quantity, "1: to the right, -1: to the left, 0: stands"),
        }
    origin = (
        "referee/independent.py: Taylor series in 60 digits with events, twice with other orders "
        f"and steps, which differ by {own_spread:.0e}"
    )
    if "closed" in more:
        final = "final_rotation" if "final_rotation" in first else "final_displacement"
        apart = float(abs(independent.mid(more["closed"]() - first[final][0])))
        assert apart < 1e-20, (name, apart)
        origin += f"; a closed form, which differs by {apart:.0e}"
    problem["scale"] = scale
    problem["answers"] = answers
    problem["origin"] = ""
    text = json.dumps(problem)
    found = own.solve(parse(text, name), 0)
    worst = 0.0 if set(found) >= set(answers) else float("inf")
    for quantity, asked in answers.items():
        for got, right in zip(found.get(quantity, ()), asked["value"]):
            worst = max(worst, abs(got - float(right)))
    allowed = max(float(a["uncertainty"]) for a in answers.values())
    problem["origin"] = f"{origin}; stickslip, which differs by {worst:.0e}"
    verdict = "" if worst <= allowed and own_spread <= 1e-20 * max(scale, 1e-3) else "   <-- LOOK"
    if not verdict:
        lines = []
        for key, value in problem.items():
            if key == "ground":
                inner = ",\n".join(
                    f"    {json.dumps(k)}: {json.dumps(v)}" for k, v in value.items()
                )
                lines.append(f'  "ground": {{\n{inner}\n  }}')
            elif key == "answers":
                inner = ",\n".join(
                    f"    {json.dumps(k)}: {json.dumps(v)}" for k, v in value.items()
                )
                lines.append(f'  "answers": {{\n{inner}\n  }}')
            else:
                lines.append(f"  {json.dumps(key)}: {json.dumps(value)}")
        (FOLDER / f"{name}.json").write_text("{\n" + ",\n".join(lines) + "\n}\n")
    shown = {q: [float(v) for v in a["value"]] for q, a in answers.items()}
    said = f"{name:24} {time.time() - began:5.1f} s  self {own_spread:.0e}  library {worst:.0e}"
    return f"{said} of {scale:g} {shown}{verdict}"


def main() -> None:
    asked = sys.argv[1:]
    entries = [e for e in listed() if not asked or e[1].startswith(tuple(asked))]
    with Pool(2) as pool:
        for line in pool.imap(make, entries):
            print(line, flush=True)
    for group in CLASSES:
        print(group, sum(e[0] == group for e in listed()))


if __name__ == "__main__":
    main()
