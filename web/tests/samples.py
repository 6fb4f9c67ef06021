"""Files for the test of the page, and the native library's numbers for them.

python web/tests/samples.py build/web/samples
"""

import gzip
import json
import sys
import tarfile
import zipfile
from pathlib import Path

import numpy as np
import stickslip as ss

MU = (0.1, 0.15)


def record(path: Path, units: str = "(g)") -> None:
    """Three components of noise."""
    rng = np.random.default_rng(33)
    time = np.arange(3000) * 0.01
    shape = np.exp(-(((time - 10) / 5) ** 2))
    smooth = np.hanning(9) / np.hanning(9).sum()
    columns = [
        size * shape * np.convolve(rng.normal(size=time.size), smooth, "same")
        for size in (1.0, 0.8, 0.6)
    ]
    heading = f"Time (s), N00E {units}, N90E {units}, Up {units}"
    rows = np.column_stack([time, *columns])
    lines = [",".join(f"{value:.6f}" for value in row) for row in rows]
    path.write_text("\n".join([heading, *lines]) + "\n")


def station(folder: Path, three: Path) -> None:
    """The components of a station, a file each, in PEER's layout; bare columns and their table."""
    directed = [
        (1, "1_MADE", "0", "NOW000"),
        (2, "1_MADE", "90", "NOW090"),
        (3, "1_MADE", "UP", "NOW-UP"),
    ]
    paired = [
        (1, "2_PAIR", "H1", "NOW-H1"),
        (2, "2_PAIR", "H2", "NOW-H2"),
        (3, "2_PAIR", "UP", "NOW-UP"),
    ]
    for component, number, title, end in directed + paired:
        motion = ss.read_record(three, component=component)
        values = [f"{value / ss.STANDARD_GRAVITY: .7E}" for value in motion.acceleration]
        lines = [
            "PEER NGA STRONG MOTION DATABASE RECORD",
            f"Made-up-01, 1/1/2000, Nowhere, {title}",
            "ACCELERATION TIME SERIES IN UNITS OF G",
            f"NPTS=   {len(values)}, DT=   .0100 SEC,",
            *("  ".join(values[k : k + 5]) for k in range(0, len(values), 5)),
        ]
        (folder / f"RSN{number}_{end}.AT2").write_text("\n".join(lines) + "\n")
    for end, step in (("SLO-000", 2), ("SLO-090", 2), ("FAS-045", 1)):
        values = ss.read_record(three, component=2 if end == "SLO-090" else 1).acceleration[::step]
        column = (f"{value / ss.STANDARD_GRAVITY:.6f}" for value in values)
        (folder / f"{end}.txt").write_text("\n".join(column) + "\n")
    (folder / "steps.csv").write_text(
        "station,file,dt_s\nSLO,SLO-000.txt,0.02\nSLO,SLO-090.txt,0.02\nFAS,FAS-045.txt,0.01\n"
    )


def numbers(motion: ss.GroundMotion, mu: float, **mounting: float) -> dict[str, float]:
    """As the table of the page has them."""
    response = ss.integrate(ss.Slider(ss.Coulomb(mu=mu), **mounting), motion, settle=True)
    strong = ss.strong_motion(motion)
    return {
        "peak": response.peak,
        "residual": response.residual,
        "sliding distance": response.sliding_distance,
        "time sliding": response.time_sliding,
        "slips": response.slips,
        "PGA": motion.peak_acceleration,
        "PGV": strong.peak_velocity,
        "Arias intensity": strong.arias_intensity,
        "D5-95": strong.duration,
        "Tm": strong.mean_period,
        "events": len(response.events),
        "margin of the closest decision": min(response.margin, response.impact_margin),
    }


def both_ways(motion: ss.GroundMotion, mu: float) -> list[float]:
    """Peaks, then magnitudes of residuals: of the reversed motion, of the motion, and the means."""
    slider = ss.Slider(ss.Coulomb(mu=mu))
    normal, inverse = (
        ss.integrate(slider, motion.scaled(sign), settle=True) for sign in (-1.0, 1.0)
    )
    peaks = [normal.peak, inverse.peak]
    residuals = [abs(normal.residual), abs(inverse.residual)]
    return [*peaks, float(np.mean(peaks)), *residuals, float(np.mean(residuals))]


def main() -> None:
    folder = Path(sys.argv[1])
    folder.mkdir(parents=True, exist_ok=True)
    three = folder / "three.csv"
    record(three)
    one = folder / "column.txt"
    one.write_text(
        "\n".join(f"{value:.5f}" for value in ss.read_record(three, component=1).acceleration)
    )
    rows = [row.split(",") for row in three.read_text().splitlines()]
    (folder / "up.csv").write_text("\n".join(f"{row[0]},{row[3]}" for row in rows))
    (folder / "broken.csv").write_text("Time (s), Acceleration (g)\n0, 0\n0.01, oops\n0.02, 0.1\n")
    station(folder, three)
    (folder / "packed.csv.gz").write_bytes(gzip.compress(three.read_bytes()))
    with zipfile.ZipFile(folder / "many.zip", "w", zipfile.ZIP_DEFLATED) as archive:
        archive.write(three, "folder/three.csv")
        archive.writestr("broken.csv", "nothing\n")

    with tarfile.open(folder / "many.tar.gz", "w:gz") as archive:
        archive.add(three, "folder/three.csv")

    first = ss.read_record(three, component=1)
    spectrum = ss.Spectrum.kanai_tajimi(s0=0.01, frequency=15, damping=0.6)
    noise = ss.GaussianExcitation(spectrum, 0.01, 2048).sample(seed=1, member=0)
    horizontal = ss.read_station(three, along=first.orientation)
    horizontal = ss.GroundMotion(
        horizontal.acceleration, horizontal.dt, transverse=horizontal.transverse
    )
    plane = ss.integrate(ss.PlanarSlider(ss.Slider(ss.Coulomb(mu=MU[0]))), horizontal, settle=True)
    answers = {
        "many": [both_ways(ss.read_record(three, component=i), MU[0]) for i in (1, 2)],
        "spectrum": ss.response_spectrum(first, np.geomspace(0.01, 10, 100), 0.05).values.tolist(),
        "path": {
            "peak": plane.peak,
            "residual": float(np.hypot(*plane.residual)),
            "sliding distance": plane.sliding_distance,
            "time sliding": plane.time_sliding,
            "slips": plane.slips,
            "events": len(plane.events),
            "margin of the closest decision": min(plane.margin, plane.impact_margin),
        },
        "components": [numbers(ss.read_record(three, component=i), MU[0]) for i in (1, 2)],
        "first": {str(mu): numbers(first, mu) for mu in MU},
        "vertical": numbers(ss.read_station(three, along=first.orientation), MU[0]),
        "column": numbers(ss.read_record(one, units="m/s^2", dt=0.01), MU[0]),
        "kanai-tajimi": numbers(noise, MU[0], period=2.0),
    }
    (folder / "answers.json").write_text(json.dumps(answers))


if __name__ == "__main__":
    main()
