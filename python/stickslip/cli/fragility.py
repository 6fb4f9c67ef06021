"""``stickslip fragility``: probabilities that blocks slide further than thresholds."""

from __future__ import annotations

import argparse
import math
from collections.abc import Iterable
from typing import TYPE_CHECKING, Any

from .. import Coulomb, Lognormal
from .options import add_options
from .output import check_whole, json_text
from .reading import RECORDS, Records

if TYPE_CHECKING:
    from ..risk.fragility import Bands, Fragility

__all__ = ["add_fragility"]

_LEVEL = 0.9  # of the printed intervals
_OPTIONS = """
--mu ratio required
    coefficient of friction [-]; its median
--mu-beta number B = 0
    its ln deviation (default 0)
--members whole N
    draws of it (default 100); with --mu-beta
--seed whole N = 1
    random seed (default 1)
--pga ratios... G
    levels of PGA [g] or ranges
--thresholds numbers... M required
    peak displacements [m] or ranges
--method lognormal|logit|cloud
    the fit (default: lognormal with --pga, otherwise cloud)
--separate
    a dispersion for each threshold
--hazard file FILE
    hazard curve of PGA [g] and annual rate, or a file of OpenQuake or USGS: prints the annual rates
    of exceedance
--years number T
    time for --hazard (default 50)
--plot file FILE
    picture (.png, .pdf, .svg)
--csv file FILE
    write the table to a file, with all digits
--json
    one JSON document, SI units, exact doubles
"""


def add_fragility(commands: argparse._SubParsersAction) -> None:
    """Add the subcommand."""
    parser = commands.add_parser(
        "fragility",
        help="probability of sliding further than thresholds, against PGA",
        description="Slides a block, or random ones, through all records, fits the probability that"
        " its peak displacement exceeds each threshold, and prints the median PGA [g] with its 90 %"
        " interval over the records, the dispersion and its parts from records and from the"
        " friction, and the HCLPF, the PGA at 1 %. With --pga each record is scaled to each level"
        " and exceedances are counted; without it, the records count as they are (a cloud).",
        epilog="For example, `stickslip fragility sample:all --mu 0.2 --pga 0.1 0.2 0.4 0.8 1.6"
        " --thresholds 0.05`."
        " --mu-beta makes the coefficient of friction lognormal, with the median --mu. A file"
        " that cannot be read is reported in one line on stderr; the others count, and the exit"
        " code is 1.",
    )
    add_options(parser, RECORDS, _OPTIONS)
    parser.set_defaults(horizontal=True, one_picture=True, run=_fragility)


def _fragility(args: argparse.Namespace) -> str:
    from ..ensemble import Random  # these import NumPy, slowly
    from ..motions.stations import records_of_names
    from ..motions.suite import Suite
    from ..risk.fragility import Fragility
    from ..risk.hazard import read_pga_hazard
    from ..sweeps import sweep

    if args.members is not None:
        check_whole("--members", args.members, 1)
        if not args.mu_beta:
            raise ValueError(f"--members goes with --mu-beta, got {args.members} without")
    if args.years is not None and args.hazard is None:
        raise ValueError(f"--years goes with --hazard, got {args.years:g} without")
    if not args.mu > 0:
        raise ValueError(f"--mu must be positive, got {args.mu:g}: nothing holds the block")
    years = 50.0 if args.years is None else args.years
    check_whole("--seed", args.seed, 0)
    if not 0 <= args.mu_beta < math.inf:
        raise ValueError(f"--mu-beta must be at least 0 and finite, got {args.mu_beta:g}")
    block: Any = Coulomb(mu=args.mu)
    drawn: dict[str, Any] = {}
    if args.mu_beta > 0:
        block = Random(Coulomb, mu=Lognormal(median=args.mu, beta=args.mu_beta))
        drawn = {"members": args.members or 100, "seed": args.seed}
    hazard = read_pga_hazard(args.hazard) if args.hazard else None
    records = Records(args)
    report = records.report
    motions = [found.motion for found in records]
    failures = report.failures  # before the progress of the sweep
    if not motions:
        return json_text({"results": [], **failures}) if args.json else ""
    # Both components of a station are one record for the intervals.
    suite = Suite(motions, {"record": records_of_names([motion.name for motion in motions])})
    count = len(set(suite.metadata["record"].tolist()))
    if args.pga:
        suite = suite.stripes(pga_g=sorted(args.pga))
    f = Fragility.fit(
        sweep(block, suite, settle=True, **drawn),
        im="pga_g",
        thresholds=sorted(args.thresholds),
        separate=args.separate,
        method=args.method or ("lognormal" if args.pga else "cloud"),
    )
    bands = f.bands(_LEVEL) if count > 1 else None
    rows = _rows(f, bands)
    if hazard is not None:
        h = f.rate_of_exceedance(hazard)
        rates = (h.rate.tolist(), h.extrapolated.tolist(), h.probability(years).tolist())
        for row, rate, share, p in zip(rows, *rates):
            row |= {"rate_per_year": rate, "rate_extrapolated": share}
            row |= {"years": years, "probability": p}
    if args.plot:
        friction = f"mu = {args.mu:g}" + (f", beta = {args.mu_beta:g}" if args.mu_beta else "")
        title = f"{count} record{'s' if count > 1 else ''}, {friction}"
        report.save(f.plot(level=_LEVEL if count > 1 else None, title=title))
    lines = _lines(rows, f.im_range)
    return report.answer(rows[0], rows, lines, records=count, method=f.method)


def _rows(f: Fragility, bands: Bands | None) -> list[dict[str, Any]]:
    rows = []
    for i, threshold in enumerate(f.thresholds):
        low, high = bands.median[i].tolist() if bands else (0.0, math.inf)
        rows.append(
            {
                "threshold_m": threshold,
                "median_g": float(f.median[i]),
                "median_low_g": low,
                "median_high_g": high,
                "beta": float(f.beta[i]),
                "beta_records": float(f.beta_records[i]),
                "beta_parameters": float(f.beta_parameters[i]),
                "hclpf_g": float(f.hclpf[i]),
                "extrapolated": [
                    name for name, out in zip(("median_g", "hclpf_g"), f.extrapolated[i]) if out
                ],
            }
        )
    return rows


def _lines(rows: list[dict[str, Any]], known: tuple[float, float]) -> Iterable[str]:
    def shown(row: dict[str, Any], name: str) -> str:
        return f"{row[name]:.3g}" + "*" * (name in row["extrapolated"])

    head = (
        f"{'exceeds [m]':>11}  {'median [g]':>10}  {f'{100 * _LEVEL:.0f} % interval':>16}  beta"
        f"  records  parameters  {'HCLPF [g]':>9}"
    )
    from ..risk.hazard import MUCH_BEYOND

    rated = "rate_per_year" in rows[0]
    years = f"in {rows[0]['years']:g} years" if rated else ""
    yield head + (f"  {'rate [1/year]':>13}  {years:>12}" if rated else "")
    marked = False
    for row in rows:
        interval = f"{row['median_low_g']:.3g} to {row['median_high_g']:.3g}"
        line = (
            f"{row['threshold_m']:11.4g}  {shown(row, 'median_g'):>10}  {interval:>16}"
            f"  {row['beta']:4.2f}  {row['beta_records']:7.2f}  {row['beta_parameters']:10.2f}"
            f"  {shown(row, 'hclpf_g'):>9}"
        )
        if rated:
            mark = "*" * (row["rate_extrapolated"] > MUCH_BEYOND)
            line += (
                f"  {row['rate_per_year']:.3g}{mark}".rjust(15) + f"  {row['probability']:12.3g}"
            )
        yield line
        marked |= "*" in line
    if marked:
        yield f"*: extrapolated, outside {known[0]:.4g} to {known[1]:.4g} g"
