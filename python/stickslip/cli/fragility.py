"""``stickslip fragility``: probabilities that blocks slide further than thresholds."""

from __future__ import annotations

import argparse
import math
import sys
from collections.abc import Iterable
from pathlib import Path
from typing import TYPE_CHECKING, Any

from .. import Coulomb, Lognormal
from .._text import printable
from .batch import Batch, add_files
from .output import check_outputs, check_whole, json_text, write_csv
from .parser import number, numbers, ratio, ratios, whole

if TYPE_CHECKING:
    from ..risk.fragility import Bands, Fragility

__all__ = ["add_fragility"]

_LEVEL = 0.9  # of the printed intervals


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
        epilog="--mu-beta makes the coefficient of friction lognormal, with the median --mu. A file"
        " that cannot be read is reported in one line on stderr; the others count, and the exit"
        " code is 1.",
    )
    add = parser.add_argument
    add_files(parser)
    add("--mu", type=ratio, required=True, help="coefficient of friction [-]; its median")
    add("--mu-beta", type=number, default=0.0, metavar="B", help="its ln deviation (default 0)")
    add("--members", type=whole, metavar="N", help="draws of it (default 100); with --mu-beta")
    add("--seed", type=whole, default=1, metavar="N", help="random seed (default 1)")
    add("--pga", nargs="+", type=ratios, metavar="G", help="levels of PGA [g] or ranges")
    add(
        "--thresholds",
        nargs="+",
        type=numbers,
        required=True,
        metavar="M",
        help="peak displacements [m] or ranges",
    )
    add(
        "--method",
        choices=("lognormal", "logit", "cloud"),
        help="the fit (default: lognormal with --pga, otherwise cloud)",
    )
    add("--separate", action="store_true", help="a dispersion for each threshold")
    add(
        "--hazard",
        type=Path,
        metavar="FILE",
        help="hazard curve of PGA [g] and annual rate, or a file of OpenQuake or USGS: prints the"
        " annual rates of exceedance",
    )
    add("--years", type=number, metavar="T", help="time for --hazard (default 50)")
    add("--plot", type=Path, dest="curves", metavar="FILE", help="picture (.png, .pdf, .svg)")
    add("--csv", type=Path, metavar="FILE", help="write the table to a file, with all digits")
    add("--json", action="store_true", help="one JSON document, SI units, exact doubles")
    parser.set_defaults(horizontal=True, run=_fragility, plot=None)


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
    batch = Batch(args)
    if args.curves:
        check_outputs([("--plot", args.curves)], batch.inputs)
    motions = [found.motion for _, _, found in batch.motions()]
    said = batch.finish()
    if not motions:
        return json_text({"results": [], **said}) if args.json else ""
    # Both components of a station are one record for the intervals.
    suite = Suite(motions, {"record": records_of_names([motion.name for motion in motions])})
    records = len(set(suite.metadata["record"].tolist()))
    if args.pga:
        suite = suite.stripes(pga_g=sorted(args.pga))
    shown = sys.stderr is not None and sys.stderr.isatty()
    f = Fragility.fit(
        sweep(block, suite, settle=True, progress=shown, **drawn),
        im="pga_g",
        thresholds=sorted(args.thresholds),
        separate=args.separate,
        method=args.method or ("lognormal" if args.pga else "cloud"),
    )
    bands = f.bands(_LEVEL, progress=shown) if records > 1 else None
    rows = _rows(f, bands)
    if hazard is not None:
        h = f.rate_of_exceedance(hazard)
        rates = (h.rate.tolist(), h.extrapolated.tolist(), h.probability(years).tolist())
        for row, rate, share, p in zip(rows, *rates):
            row |= {"rate_per_year": rate, "rate_extrapolated": share}
            row |= {"years": years, "probability": p}
    written = [str(args.csv)] if args.csv else []
    if args.csv:
        write_csv(args.csv, list(rows[0]), rows)
    if args.curves:
        from ..plotting import save

        friction = f"mu = {args.mu:g}" + (f", beta = {args.mu_beta:g}" if args.mu_beta else "")
        title = f"{records} record{'s' if records > 1 else ''}, {friction}"
        save(f.plot(level=_LEVEL if records > 1 else None, title=title), args.curves)
        written.append(str(args.curves))
    if args.json:
        figures = [str(args.curves)] if args.curves else []
        about = {"records": records, "method": f.method}
        return json_text({**about, "results": rows, **said, "figures": figures})
    return "\n".join([*_lines(rows, f.im_range), *(f"wrote {printable(name)}" for name in written)])


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
