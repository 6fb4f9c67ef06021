"""Random problems with the answers of the native library, as one JSON document on stdout.

python web/tests/problems.py 1000 > build/web/problems.json
"""

import json
import math
import sys

import numpy as np
import stickslip as ss

LAWS = ("coulomb", "caster", "one-way", "speed", "degrading")


def settings(rng: np.random.Generator) -> dict[str, float]:
    """Settings of the page; absent ones are not given."""

    def chance(probability: float) -> bool:
        return bool(rng.random() < probability)

    law = int(rng.integers(len(LAWS)))
    mu = float(rng.uniform(0.02, 0.3))
    given = {"law": law, "mu": mu, "scale": float(rng.choice([1.0, -1.0, rng.uniform(0.5, 2)]))}
    if chance(0.3):
        given["mu_static"] = mu * float(rng.uniform(1, 1.5))
    if LAWS[law] == "caster":
        given["reach"] = float(rng.uniform(0.02, 0.5))
    if LAWS[law] == "speed":
        given |= {"mu_fast": mu * float(rng.uniform(0.5, 2)), "rate": float(rng.uniform(1, 60))}
        given.pop("mu_static", None)
    if LAWS[law] == "degrading":
        given |= {
            "mu_residual": mu * float(rng.uniform(0.3, 1)),
            "distance": float(rng.uniform(0.01, 0.3)),
        }
    if chance(0.5):
        given["period"] = float(rng.uniform(0.5, 5))
        if chance(0.5):
            given["damping_ratio"] = float(rng.uniform(0, 0.3))
        given["pendulum"] = float(chance(0.5))
    elif LAWS[law] in ("coulomb", "one-way") and chance(0.3):
        given["slope"] = math.degrees(math.atan(mu)) * float(rng.uniform(0, 0.95))
    if chance(0.2):
        given |= {
            "stop_gap": float(rng.uniform(0.005, 0.1)),
            "restitution": float(rng.uniform(0, 0.9)),
        }
    given["vertical"] = float(chance(0.3))
    given["clipped"] = float(chance(0.3))
    return given


def slider(given: dict[str, float]) -> ss.Slider:
    """The slider of the settings, as the page writes it in Python."""
    mu, law = given["mu"], LAWS[int(given["law"])]
    mounting = {}
    one_way = law == "one-way"
    if law == "caster":
        friction = ss.Caster(mu=mu, reach=given["reach"])
    elif law == "speed":
        friction = ss.VelocityDependent(mu_slow=mu, mu_fast=given["mu_fast"], rate=given["rate"])
    elif law == "degrading":
        friction = ss.Degrading(distance=[0.0, given["distance"]], mu=[mu, given["mu_residual"]])
    elif one_way and "slope" not in given and "mu_static" not in given:
        friction, one_way = ss.Coulomb(mu=mu, backward=math.inf), False
    else:
        friction = ss.Coulomb(mu=mu)
    if "mu_static" in given:
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
    """Filtered noise, of which a slider slides in some parts only."""
    samples = int(rng.integers(200, 1500))
    dt = float(rng.choice([0.005, 0.01, 0.02]))

    def noise(size: float) -> np.ndarray:
        white = rng.normal(size=samples + 20)
        smooth = np.convolve(white, np.hanning(int(rng.integers(3, 20))), "same")[:samples]
        rise = np.sin(np.linspace(0, np.pi, samples))
        return size * rise * smooth / np.abs(smooth).max()

    size = float(rng.uniform(1, 8))
    return ss.GroundMotion(noise(size), dt, vertical=noise(0.7 * size) if vertical else None)


def finite(value: float) -> float | None:
    """As JSON has it."""
    return value if math.isfinite(value) else None


def problem(number: int) -> dict:
    rng = np.random.default_rng([20260101, number])
    given = settings(rng)
    ground = motion(rng, bool(given["vertical"]))
    found: dict = {
        "settings": given,
        "dt": ground.dt,
        "acceleration": ground.acceleration.tolist(),
        "vertical": None if ground.vertical is None else ground.vertical.tolist(),
    }
    options = {"contact": "clipped" if given["clipped"] else "flight"}
    scaled = ground.scaled(given["scale"])
    try:
        block = slider(given)
        try:
            response = ss.integrate(block, scaled, settle=True, **options)
        except ss.ConvergenceError:
            response = ss.integrate(block, scaled, **options)
    except ValueError as error:
        return found | {"error": str(error)}
    return found | {
        "answer": {
            "peak": response.peak,
            "residual": response.residual,
            "sliding_distance": response.sliding_distance,
            "time_sliding": response.time_sliding,
            "input": response.energy.input,
            "end": float(response.events["time"][-1]),
            "events": len(response.events),
            "slips": response.slips,
            "samples": response.displacement.size,
            "margin": finite(min(response.margin, response.impact_margin)),
            "last": float(response.displacement[-1]),
        },
    }


def main() -> None:
    count = int(sys.argv[1])
    json.dump([problem(number) for number in range(count)], sys.stdout)


if __name__ == "__main__":
    main()
