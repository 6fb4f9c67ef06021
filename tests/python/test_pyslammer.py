"""Newmark's one-way block against pySLAMMER, on its 18 records.

`pyslammer.RigidAnalysis` (version 0.2.2) solves the same problem: a block that slides one way
while the ground's acceleration exceeds ky g, with the same g = 9.80665 m/s^2, no correction of
the base line, and the acceleration a straight line between samples. It counts the way of the
ground under the block, so ground that accelerates forward makes it grow; here the block then goes
backward. The mirrored record with `Coulomb(slip_level=ky g, backward=inf)` is its block.

It steps from sample to sample by the trapezoidal rule, for velocity and displacement both. While
the block slides, the velocity is then exact and the displacement off by dt^3/12 of the
acceleration's slope a step. The rest is in how a slip starts and ends, which it knows only to the
sample:

- It starts at the last sample below the yield level, with a relative acceleration that rises from
  zero there: too early, too fast by up to dt^2/8 of the slope. That is most of the difference,
  and why its displacements are nearly always too large.
- A slip that ends within a step ends at the step's beginning: the last bit of way is left out.
- Below 1e-5 m/s it takes the block as stuck but leaves its velocity, so that the block creeps on
  at that velocity until the next slip. At steps of 1/8 of a record's this makes up to a
  thousandth of the displacement (Kocaeli), and it does not shrink with the step.

Measured over 18 records and ky = 0.02, 0.05, 0.1: the relative difference has the median 1.1e-3
and the maximum 3.3e-2 (Northridge PAC-175, dt = 0.02 s, ky = 0.1); 52 of 54 displacements are too
large. The records resampled finer on the same straight lines, which does not change the block's
motion: over the 14 shorter ones at ky = 0.05 the median is 1.3e-3, 4.3e-4, 9.2e-5 and 2.5e-5 at
dt, dt/2, dt/4 and dt/8, so it shrinks as dt^1.9. What settles which of the two is right is the
third integrator below. Its difference from this library shrinks as h^2.0 of its step: the median
over all 54 is 1.5e-5, 7.8e-7 and 5.7e-8, the maximum 2.9e-4, 2.4e-5 and 1.6e-6, at dt/8, dt/32
and dt/128.
"""

import math

import numpy as np
import pytest
import stickslip as ss

G = ss.STANDARD_GRAVITY
YIELD_COEFFICIENTS = (0.02, 0.05, 0.1)  # in g


@pytest.fixture(scope="module")
def records(pyslammer_files):
    return {file.stem: ss.read_record(file) for file in pyslammer_files}


def refined(samples, parts):
    """The same straight lines, with `parts` times as many samples."""
    count = (len(samples) - 1) * parts + 1
    return np.interp(np.arange(count) / parts, np.arange(len(samples)), samples)


def slid(record, ky):
    law = ss.Coulomb(slip_level=ky * G, backward=math.inf)
    return ss.integrate(law, record.scaled(-1)).residual


def slid_by_pyslammer(record, ky, parts=1):
    pyslammer = pytest.importorskip("pyslammer")
    motion = pyslammer.GroundMotion(refined(record.acceleration / G, parts), record.dt / parts)
    return pyslammer.RigidAnalysis(ky, motion).max_sliding_disp


def slid_by_reflection(record, ky, parts):
    """The same block with no events at all (Skorokhod's reflection).

    With S the integral of n - ky g, the velocity is S less its running minimum, S(0) = 0 included.
    S is exact at the nodes; the minimum over nodes, and the trapezoidal rule for the displacement,
    are off by h^2.
    """
    h = record.dt / parts
    net = refined(record.acceleration, parts) - ky * G
    s = np.concatenate([[0.0], np.cumsum((net[1:] + net[:-1]) * (h / 2))])
    velocity = s - np.minimum.accumulate(s)
    return np.sum(velocity[1:] + velocity[:-1]) * (h / 2)


def test_pyslammer_comes_close_with_steps_of_the_record(records):
    differences = []
    for record in records.values():
        for ky in YIELD_COEFFICIENTS:
            ours = slid(record, ky)
            assert ours > 1e-3  # every block slides, so the ratios mean something
            differences.append(slid_by_pyslammer(record, ky) / ours - 1)
    assert np.median(np.abs(differences)) < 1.5e-3
    assert np.max(np.abs(differences)) < 4e-2
    assert np.mean(np.array(differences) > 0) > 0.9  # nearly always too large


def test_the_difference_shrinks_as_the_square_of_the_step(records):
    shorter = [record for record in records.values() if len(record) < 10_000]
    medians = []
    for parts in (1, 2, 4):
        relative = [slid_by_pyslammer(r, 0.05, parts) / slid(r, 0.05) - 1 for r in shorter]
        medians.append(np.median(np.abs(relative)))
    order = math.log2(medians[0] / medians[2]) / 2
    assert 1.7 < order < 2.3


@pytest.mark.slow
def test_steps_fine_enough_come_to_our_answer_without_events(records):
    errors = {parts: [] for parts in (8, 32, 128)}
    for record in records.values():
        for ky in YIELD_COEFFICIENTS:
            ours = slid(record, ky)
            for parts, error in errors.items():
                error.append(abs(slid_by_reflection(record, ky, parts) / ours - 1))
    assert max(errors[128]) < 4e-6
    assert np.median(errors[128]) < 1e-7
    order = math.log2(np.median(errors[8]) / np.median(errors[128])) / 4
    assert 1.7 < order < 2.3
