"""Random problems with the answers of the native library, as one JSON document on stdout.

python web/tests/problems.py 1000 > build/web/problems.json
"""

import json
import math
import sys
from collections.abc import Callable
from typing import Any

import numpy as np
import stickslip as ss

LAWS = ("coulomb", "caster", "one-way", "speed", "degrading", "stribeck", "pendulum")
PLANAR = ("coulomb", "speed", "degrading", "stribeck", "kumar")
KUMAR = (
    "static_pressure",
    "reference_pressure",
    "contact_radius",
    "temperature",
    "rate",
    "diffusivity",
    "conductivity",
)
PENDULUMS = {2: ss.DoublePendulum, 3: ss.TriplePendulum, 5: ss.QuintuplePendulum}


def settings(rng: np.random.Generator, number: int) -> dict[str, Any]:
    """Settings of the page; absent ones are not given."""

    def chance(probability: float) -> bool:
        return bool(rng.random() < probability)

    law = LAWS[int(rng.integers(len(LAWS)))]
    if number % 50 == 49:  # few, because they take long
        law = "kumar"
    mu = float(rng.uniform(0.02, 0.3))
    given = {"law": law, "mu": mu, "scale": float(rng.choice([1.0, -1.0, rng.uniform(0.5, 2)]))}
    if chance(0.3):
        given["mu_static"] = mu * float(rng.uniform(1, 1.5))
    if law == "caster":
        given["reach"] = float(rng.uniform(0.02, 0.5))
    if law == "speed":
        given |= {"mu_fast": mu * float(rng.uniform(0.5, 2)), "rate": float(rng.uniform(1, 60))}
    if law == "degrading":
        given |= {
            "mu_residual": mu * float(rng.uniform(0.3, 1)),
            "distance": float(rng.uniform(0.01, 0.3)),
        }
    if law == "stribeck":
        given |= {
            "mu_static": mu * float(rng.uniform(1, 2)),
            "stribeck_speed": float(rng.uniform(0.01, 0.2)),
            "exponent": float(rng.integers(1, 4)),
        }
    if law == "kumar":
        given.pop("mu_static", None)
        given |= {
            "static_pressure": float(rng.uniform(5e6, 60e6)),
            "reference_pressure": 50e6,
            "contact_radius": float(rng.uniform(0.02, 0.3)),
            "temperature": float(rng.uniform(-20, 60)),
            "rate": float(rng.uniform(5, 100)),
            "diffusivity": 4.44e-6,
            "conductivity": float(rng.uniform(10, 40)),
        }
    if law == "pendulum":
        given.pop("mu_static", None)
        surfaces = int(rng.choice([2, 3, 5]))
        radii = np.cumsum(rng.uniform(0.3, 1.5, size=surfaces))
        mus = np.sort(rng.uniform(0.1, 1, size=surfaces))
        given |= {"radii": radii.tolist(), "mus": (mu * mus / mus[-1]).tolist(), "capacities": []}
        given["mu"] = given["mus"][-1]
        if chance(0.5):
            given |= {
                "capacities": (0.4 * radii).tolist(),
                "restitution": float(rng.uniform(0, 0.9)),
            }
    if chance(0.5):
        given["period"] = float(rng.uniform(0.5, 5))
        if chance(0.5):
            given["damping_ratio"] = float(rng.uniform(0, 0.3))
        given["pendulum"] = float(law != "pendulum" and chance(0.5))
    elif law in ("coulomb", "one-way") and chance(0.3):
        given["slope"] = math.degrees(math.atan(mu)) * float(rng.uniform(0, 0.95))
    if chance(0.2):
        given |= {
            "stop_gap": float(rng.uniform(0.005, 0.1)),
            "restitution": float(rng.uniform(0, 0.9)),
        }
    given["vertical"] = float(chance(0.3))
    given["clipped"] = float(chance(0.3))
    return given


def slider(given: dict[str, Any]) -> ss.Slider:
    """The slider of the settings, as the page writes it in Python."""
    mu, law = given["mu"], given["law"]
    mounting = {}
    one_way = law == "one-way"
    if law == "caster":
        friction = ss.Caster(mu=mu, reach=given["reach"])
    elif law == "speed":
        friction = ss.VelocityDependent(mu_slow=mu, mu_fast=given["mu_fast"], rate=given["rate"])
    elif law == "degrading":
        friction = ss.Degrading(distance=[0.0, given["distance"]], mu=[mu, given["mu_residual"]])
    elif law == "stribeck":
        friction = ss.Stribeck(
            mu_static=given["mu_static"],
            mu_kinetic=mu,
            velocity=given["stribeck_speed"],
            exponent=given["exponent"],
        )
    elif law == "kumar":
        friction = ss.KumarFriction(mu_ref=mu, **{name: given[name] for name in KUMAR})
    elif law == "pendulum":
        friction = PENDULUMS[len(given["radii"])](
            given["radii"],
            given["mus"],
            given["capacities"] or None,
            given["restitution"] if given["capacities"] else 0.0,
        )
    elif one_way and "slope" not in given and "mu_static" not in given:
        friction, one_way = ss.Coulomb(mu=mu, backward=math.inf), False
    else:
        friction = ss.Coulomb(mu=mu)
    if "mu_static" in given and law != "stribeck":
        friction = ss.StaticKinetic(friction, mu_static=given["mu_static"])
    if "period" in given:
        mounting = {"period": given["period"], "damping_ratio": given.get("damping_ratio")}
    if "slope" in given:
        mounting["slope_degrees"] = given["slope"]
    if "stop_gap" in given:
        mounting["stops"] = ss.Stops(gap=given["stop_gap"], restitution=given["restitution"])
    if "period" in given and given["pendulum"]:
        mounting["pendulum"] = True
    return ss.Slider(friction, one_way=one_way, **mounting)


def motion(rng: np.random.Generator, vertical: bool) -> ss.GroundMotion:
    """Filtered noise in two or three directions, of which a slider slides in some parts only."""
    samples = int(rng.integers(200, 1500))
    dt = float(rng.choice([0.005, 0.01, 0.02]))

    def noise(size: float) -> np.ndarray:
        white = rng.normal(size=samples + 20)
        smooth = np.convolve(white, np.hanning(int(rng.integers(3, 20))), "same")[:samples]
        rise = np.sin(np.linspace(0, np.pi, samples))
        return size * rise * smooth / np.abs(smooth).max()

    size = float(rng.uniform(1, 8))
    axis, up, transverse = noise(size), noise(0.7 * size), noise(0.8 * size)
    return ss.GroundMotion(axis, dt, transverse=transverse, vertical=up if vertical else None)


def finite(value: float) -> float | None:
    """As JSON has it."""
    return value if math.isfinite(value) else None


def answer(block: ss.Slider | ss.PlanarSlider, ground: ss.GroundMotion, contact: str) -> dict:
    """What the page computes; in the plane, the residual is a distance."""
    try:
        response = ss.integrate(block, ground, settle=True, contact=contact)
    except ss.ConvergenceError:
        response = ss.integrate(block, ground, contact=contact)
    return {
        "peak": response.peak,
        "residual": float(np.linalg.norm(response.residual)),
        "sliding_distance": response.sliding_distance,
        "time_sliding": response.time_sliding,
        "input": response.energy.input,
        "end": float(response.events["time"][-1]),
        "events": len(response.events),
        "slips": response.slips,
        "samples": len(response.displacement),
        "margin": finite(min(response.margin, response.impact_margin)),
        "last": np.ravel(response.displacement[-1]).tolist(),
    }


def answer_or_error(make: Callable[[], ss.Slider | ss.PlanarSlider], *how: Any) -> dict:
    try:
        return answer(make(), *how)
    except ValueError as error:
        return {"error": str(error)}


def problem(number: int) -> dict:
    rng = np.random.default_rng([20260101, number])
    given = settings(rng, number)
    ground = motion(rng, bool(given["vertical"]))
    contact = "clipped" if given["clipped"] else "flight"
    scaled = ground.scaled(given["scale"])
    axis = ss.GroundMotion(scaled.acceleration, scaled.dt, vertical=scaled.vertical)
    planar = given["law"] in PLANAR
    return {
        "settings": given,
        "dt": ground.dt,
        "acceleration": ground.acceleration.tolist(),
        "transverse": ground.transverse.tolist(),
        "vertical": None if ground.vertical is None else ground.vertical.tolist(),
        "axis": answer_or_error(lambda: slider(given), axis, contact),
        "plane": answer_or_error(lambda: ss.PlanarSlider(slider(given)), scaled, contact)
        if planar
        else None,
    }


def rocks(given: dict[str, Any], ground: ss.GroundMotion) -> dict:
    """A block of the settings, until it rests if it can."""
    size = {"width": given["width"], "height": given["height"]}
    if "restitution" in given:
        size["restitution"] = given["restitution"]
    if "mu" in given:
        block = ss.RockingBlock(**size, mu=given["mu"])
    else:
        block = ss.SlenderBlock.from_size(**size)
    response = ss.integrate(block, ground, settle=True)
    return {
        "peak_rotation": response.peak_rotation,
        "peak_ratio": finite(response.peak_rotation_ratio),
        "overturned": {None: 0, "right": 1, "left": -1}[response.overturned],
        "overturned_at": response.overturned_at,
        "impacts": response.impacts,
        "events": len(response.events),
        "samples": len(response.rotation),
        "residual": response.residual or 0.0,
        "sliding_distance": response.sliding_distance or 0.0,
        "p": block.p,
        "alpha": block.alpha,
        "restitution": block.restitution,
        "margin": finite(response.margin),
        "last": float(response.rotation[-1]),
    }


def cart(given: dict[str, Any]) -> ss.Cart:
    """The cart of the settings."""
    rolling = {"mu": given["mu"], "rolling_mu": given["rolling_mu"]}
    size = {"trail": given["trail"], "wheel_width": given["wheel_width"]}
    locked = (0, 1, 2, 4, 0)[int(given["wheels"])]
    supports = []
    for i, (x, y) in enumerate([(1, 1), (1, -1), (-1, 1), (-1, -1)]):
        at = (x * given["base_length"] / 2, y * given["base_width"] / 2)
        heading = math.radians(given["headings"][i])
        if given["wheels"] == 4 and i >= 2:
            supports.append(ss.FixedWheel(at=at, **rolling))
        elif i < locked:
            lock = {"mu": given["mu"], "lock": "both"}
            supports.append(ss.SwivelCaster(at=at, heading=heading, **size, **lock))
        else:
            supports.append(ss.SwivelCaster(at=at, heading=heading, **size, **rolling))
    long, wide = given["body_length"] / 2, given["body_width"] / 2
    outline = [(long, wide), (long, -wide), (-long, -wide), (-long, wide)]
    return ss.Cart(supports, radius_of_gyration=given["gyration"], outline=outline)


def rolls(given: dict[str, Any], ground: ss.GroundMotion) -> dict:
    response = ss.integrate(cart(given), ground, settle=True)
    return {
        "peak": response.peak,
        "peak_yaw": response.peak_yaw,
        "peak_outline": response.peak_outline,
        "residual_axis": float(response.residual[0]),
        "residual_transverse": float(response.residual[1]),
        "residual_yaw": response.residual_yaw,
        "time_moving": response.time_moving,
        "rests": response.rests,
        "events": len(response.events),
        "samples": len(response.displacement),
        "margin": finite(response.margin),
    }


def in_words(work: Callable[[], dict]) -> dict:
    """What it returns, or its message."""
    try:
        return work()
    except (ValueError, ss.ConvergenceError) as error:
        return {"error": str(error)}


def components(ground: ss.GroundMotion, settings: dict[str, Any], answer: dict) -> dict:
    return {
        "settings": settings,
        "dt": ground.dt,
        "acceleration": ground.acceleration.tolist(),
        "transverse": ground.transverse.tolist(),
        "vertical": None if ground.vertical is None else ground.vertical.tolist(),
        "answer": answer,
    }


def block_problem(number: int) -> dict:
    rng = np.random.default_rng([20260102, number])
    width = float(rng.uniform(0.2, 1))
    given = {
        "law": "slender-block",
        "width": width,
        "scale": float(rng.uniform(0.5, 2)),
    }
    given["height"] = width * float(rng.uniform(1.5, 6))
    if number % 2:
        given |= {"law": "rigid-block", "mu": float(rng.uniform(0.1, 0.9))}
    if rng.random() < 0.5:
        given["restitution"] = float(rng.uniform(0.3, 0.95))
    given["vertical"] = float(rng.random() < 0.3)
    ground = motion(rng, bool(given["vertical"]))
    scaled = ground.scaled(given["scale"])
    axis = ss.GroundMotion(scaled.acceleration, scaled.dt, vertical=scaled.vertical)
    return components(ground, given, in_words(lambda: rocks(given, axis)))


def cart_problem(number: int) -> dict:
    rng = np.random.default_rng([20260103, number])
    given = {
        "law": "cart",
        "scale": float(rng.uniform(0.5, 1.5)),
        "wheels": float(number % 5),
        "mu": float(rng.uniform(0.2, 0.8)),
        "headings": rng.uniform(-180, 180, size=4).tolist(),
        "base_length": float(rng.uniform(0.4, 1)),
        "base_width": float(rng.uniform(0.3, 0.6)),
        "body_length": 1.2,
        "body_width": 0.7,
        "gyration": float(rng.uniform(0.2, 0.4)),
        "trail": float(rng.uniform(0.02, 0.05)),
        "wheel_width": float(rng.uniform(0.01, 0.03)),
        "rolling_mu": float(rng.uniform(0.01, 0.05)),
        "vertical": float(rng.random() < 0.3),
    }
    ground = motion(rng, bool(given["vertical"]))
    return components(ground, given, in_words(lambda: rolls(given, ground.scaled(given["scale"]))))


def main() -> None:
    count = int(sys.argv[1])
    problems = {
        "sliders": [problem(number) for number in range(count)],
        "blocks": [block_problem(number) for number in range(count // 2)],
        "carts": [cart_problem(number) for number in range(count // 10)],
    }
    json.dump(problems, sys.stdout)


if __name__ == "__main__":
    main()
