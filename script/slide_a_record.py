"""Check an installed wheel: slide a record, and find its license texts."""

from importlib import metadata

import pyslammer
import stickslip as ss

record = pyslammer.sample_ground_motions()["Kobe_1995_TAK-090"]
quake = ss.GroundMotion(record.accel * ss.STANDARD_GRAVITY, dt=record.dt)
r = ss.integrate(ss.Coulomb(mu=0.1), quake)
assert r.slips > 10, r
assert abs(r.energy.imbalance) < 1e-12 * r.energy.dissipated, r.energy
texts = [file.name for file in metadata.files("stickslip") or [] if "licenses" in file.parts]
assert {"LICENSE", "NOTICE.md", "GPL-3.0.txt"} <= set(texts), texts
print(f"Kobe, TAK-090, mu = 0.1: peak {r.peak:.4f} m, {r.slips} slips")
