"""From records to money: sliding cabinets in pelicun's loss calculation.

A floor has 20 cabinets with a coefficient of friction of 0.3, known to 30 %. Sliding by 5 cm
breaks their connections, by 30 cm destroys them. What does an earthquake cost? pelicun (SimCenter)
draws the PGA, the damage of each block of cabinets, and the cost of each repair.

    pip install stickslip[risk,records] pelicun
    python examples/loss_pelicun.py
"""

from __future__ import annotations

import tempfile
from pathlib import Path

import numpy as np
import pandas as pd
import stickslip as ss
from pelicun.assessment import Assessment

CABINETS, REPAIR, REPLACEMENT = 20, 500.0, 8000.0  # costs in USD
SAMPLES = 10_000


def fragility() -> ss.Fragility:
    """Curves of sliding by 5 and 30 cm against PGA."""
    mu = ss.Random(ss.Coulomb, mu=ss.Lognormal(median=0.3, beta=0.3))
    stripes = ss.sample_records().stripes(pga_g=[0.1, 0.2, 0.4, 0.8, 1.6, 3])
    table = ss.sweep(mu, stripes, members=100, seed=1, settle=True)
    return ss.Fragility.fit(table, im="pga_g", thresholds=[0.05, 0.3], separate=True)


def losses(f: ss.Fragility, pga_g: float, beta: float) -> np.ndarray:
    """The cost of an earthquake [USD] in each realization, for a lognormal PGA."""
    model = Assessment({"PrintLog": False, "Seed": 1})
    model.stories = 1
    pga = pga_g * np.exp(beta * np.random.default_rng(1).standard_normal(SAMPLES))
    demand = pd.DataFrame({"1-PGA-0-1": ["g", *pga]}, index=["Units", *range(SAMPLES)])
    model.demand.load_sample(demand)

    cabinets = {"Units": "ea", "Location": "0", "Direction": "1", "Theta_0": CABINETS}
    cabinets |= {"Blocks": CABINETS, "Family": np.nan, "Theta_1": np.nan}
    model.asset.load_cmp_model({"marginals": pd.DataFrame(cabinets, index=["sliding"])})
    model.asset.generate_cmp_sample(SAMPLES)

    with tempfile.TemporaryDirectory() as folder:
        file = f.to_pelicun(Path(folder) / "fragility.csv", id="sliding")
        model.damage.load_model_parameters([str(file)], {"sliding"})
    model.damage.calculate()

    costs = {
        ("Quantity", "Unit"): "1 EA",
        ("DV", "Unit"): "USD_2011",
        ("DS1", "Theta_0"): REPAIR,
        ("DS2", "Theta_0"): REPLACEMENT,
    }
    index = pd.MultiIndex.from_tuples([("sliding", "Cost")])
    model.calculate_loss(("Cost",), [pd.DataFrame(costs, index=index)], loss_map_policy="fill")
    total, _ = model.aggregate_loss()
    return total["repair_cost"].to_numpy(float).reshape(-1)


def main() -> None:
    f = fragility()
    print(f)
    for pga_g in (0.4, 0.8, 1.6):
        cost = losses(f, pga_g, beta=0.4)
        print(
            f"median PGA {pga_g} g: mean cost {cost.mean():,.0f} USD,"
            f" 90 % below {np.quantile(cost, 0.9):,.0f} USD"
        )


if __name__ == "__main__":
    main()
