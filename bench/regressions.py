"""The referee page of regressions: 18 records, all models, 50 levels, both polarities.

Measures from the records, the predictions of all models and the exact displacements. The answers
are checked first: a worked example of each author, and exact displacements by `integrate`.
"""

from __future__ import annotations

import argparse
import math
import sys
from pathlib import Path

import numpy as np
import stickslip as ss
from measure import UNRELIABLE, bar, machine, take_turns
from stickslip import regressions

sys.path.append(str(Path(__file__).parents[1] / "docs"))
import measure_regressions as page


def check() -> None:
    examples = (
        (regressions.BrayTravasarou2007(), {"ky": 0.14, "Ts": 0.33, "M": 7.5, "Sa": 0.483}, 9.77),
        (regressions.RathjeSaygili2009(), {"ky": 0.1, "pga": 0.54, "M": 6.75}, 43.7),
        (regressions.FotopoulouPitilakis2015("a"), {"ky": 0.02, "pgv": 14, "M": 6.5}, 4.01623),
    )
    for model, given, expected in examples:
        found = 100 * model.predict(**given).median
        if not abs(found / expected - 1) < 1e-3:
            sys.exit(f"wrong answer: {model!r} gives {found} cm, expected {expected}")
    exact = page.exact()
    for record, level in ((0, 10), (6, 25), (17, 40)):
        motion = page.samples()[record]
        block = ss.Coulomb(mu=page.LEVELS[level], backward=math.inf)
        for polarity, one in enumerate((motion, -motion)):
            slid = ss.integrate(block, one, settle=True).peak
            if not abs(exact[record, level, polarity] - slid) <= 1e-12 * max(slid, 1e-3):
                sys.exit(f"wrong answer: {motion.name}, {exact[record, level, polarity]}, {slid} m")


def whole_page() -> None:
    for cached in (page.exact, page.arguments, page.referees):
        cached.cache_clear()
    page.referees()


def predictions() -> np.ndarray:
    return np.array([page.predict(form).median for form in page.FORMS])


def sliding() -> None:
    page.exact.cache_clear()
    page.exact()


def main() -> None:
    ask = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    ask.add_argument("--rounds", type=int, default=9)
    args = ask.parse_args()
    check()
    print(machine())
    works = {
        "the whole page": (whole_page, 1),
        f"predictions, {len(page.FORMS)} forms, with measures": (predictions, 1),
        "exact displacements": (sliding, 1),
    }
    times = take_turns(works, args.rounds)
    print("seconds of processor time")
    for name, timing in times.items():
        mark = "" if timing.reliable else " !"
        print(f"  {name:46}{timing.median / 1e9:8.3f}{mark}")
    if not all(timing.reliable for timing in times.values()):
        print(UNRELIABLE)
    whole = times["the whole page"].median / 1e9
    print(bar("18 records, all models, 50 levels [s]", whole, 1))


if __name__ == "__main__":
    main()
