"""From records to money: sliding cabinets in OpenQuake's calculation of scenario damage.

A site has 20 cabinets with a coefficient of friction of 0.3, known to 30 %. Sliding by 5 cm costs a
tenth of a cabinet, by 30 cm all of it. OpenQuake reads the curves, the cabinets (the exposure) and
ground motions at the site, and computes the mean damage and the mean loss.

    pip install stickslip[risk,records] openquake.engine
    oq engine --upgrade-db  # once, for its list of calculations
    python examples/loss_openquake.py
"""

from __future__ import annotations

import os
import tempfile
from pathlib import Path

import numpy as np
import stickslip as ss

CABINETS, COST, EVENTS = 20, 8000.0, 1000
RATIOS = (0.1, 1.0)  # loss over cost, of each limit state

EXPOSURE = f"""<?xml version="1.0" encoding="utf-8"?>
<nrml xmlns="http://openquake.org/xmlns/nrml/0.5">
  <exposureModel id="cabinets" category="contents" taxonomySource="stickslip">
    <description>cabinets</description>
    <conversions>
      <costTypes><costType name="contents" type="per_asset" unit="USD"/></costTypes>
    </conversions>
    <assets>
      <asset id="a1" taxonomy="sliding" number="{CABINETS}">
        <location lon="9.0" lat="45.0"/>
        <costs><cost type="contents" value="{COST}"/></costs>
      </asset>
    </assets>
  </exposureModel>
</nrml>
"""
JOB = """[general]
description = sliding cabinets
calculation_mode = scenario_damage
[exposure]
exposure_file = exposure.xml
[site_params]
reference_vs30_value = 760
[hazard]
gmfs_file = gmfs.csv
sites_csv = sites.csv
number_of_ground_motion_fields = {events}
[fragility]
contents_fragility_file = fragility.xml
[consequence]
consequence_file = {{'taxonomy': 'consequences.csv'}}
"""


def fragility() -> ss.Fragility:
    """Curves of sliding by 5 and 30 cm against PGA."""
    mu = ss.Random(ss.Coulomb, mu=ss.Lognormal(median=0.3, beta=0.3))
    stripes = ss.sample_records().stripes(pga_g=[0.1, 0.2, 0.4, 0.8, 1.6, 3])
    table = ss.sweep(mu, stripes, members=100, seed=1, settle=True)
    return ss.Fragility.fit(table, im="pga_g", thresholds=[0.05, 0.3], separate=True)


def write(f: ss.Fragility, pga_g: np.ndarray, folder: Path) -> Path:
    """The input of OpenQuake; the path of the job."""
    f.to_openquake(folder / "fragility.xml", id="sliding")
    (folder / "exposure.xml").write_text(EXPOSURE)
    (folder / "sites.csv").write_text("site_id,lon,lat\n0,9.0,45.0\n")
    rows = "".join(f"{i},0,{value:.9g}\n" for i, value in enumerate(pga_g))
    (folder / "gmfs.csv").write_text(f"event_id,site_id,gmv_PGA\n{rows}")
    states = [label.replace(" ", "_").replace(".", "p") for label in f.labels]
    ratios = ",".join(map(str, RATIOS))
    (folder / "consequences.csv").write_text(
        f"taxonomy,consequence,loss_type,{','.join(states)}\nsliding,losses,contents,{ratios}\n"
    )
    job = folder / "job.ini"
    job.write_text(JOB.format(events=len(pga_g)))
    return job


def mean_loss(f: ss.Fragility, pga_g: np.ndarray) -> float:
    """The mean loss over the ground motions [USD]."""
    from openquake.calculators.base import run_calc

    with tempfile.TemporaryDirectory() as folder:
        calc = run_calc(str(write(f, pga_g, Path(folder))))
        frame = calc.datastore.read_df("risk_by_event")
        total = frame[frame.agg_id == frame.agg_id.max()]
        calc.datastore.close()
    return float(total["losses"].sum() / len(pga_g))


def main() -> None:
    os.environ.setdefault("OQ_DISTRIBUTE", "no")
    f = fragility()
    print(f)
    for median in (0.4, 0.8, 1.6):
        pga = median * np.exp(0.4 * np.random.default_rng(1).standard_normal(EVENTS))
        print(f"median PGA {median} g: mean loss {mean_loss(f, pga):,.0f} USD")


if __name__ == "__main__":
    main()
