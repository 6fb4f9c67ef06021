"""Random sources of the tests' own: in a module, so that they pickle into other processes."""

import os
import time

import numpy as np
import stickslip as ss

BAND = ss.Spectrum.band_pass(s0=1.0, low=2.0, high=12.0)
SHAKING = ss.GaussianExcitation(BAND, dt=0.1, samples=256)
BLOCK = ss.Coulomb(slip_level=2.0)


class Delayed:
    """The motions of SHAKING, each after a while [s], but for a member that does something else."""

    def __init__(self, delay=0.0, strange_member=None, strange=None):
        self.delay, self.strange_member, self.strange = delay, strange_member, strange
        self.duration, self.dt, self.configuration = SHAKING.duration, SHAKING.dt, {"of": "tests"}

    def sample(self, *, seed, member):
        time.sleep(self.delay)
        if member == self.strange_member:
            self.strange()
        return SHAKING.sample(seed=seed, member=member)


def refuse():
    raise LookupError("no motion here")


def die():
    os._exit(1)


def same_bits(a, b):
    """Whether two ensembles hold the same, to the bit."""
    left, right = a.__getstate__(), b.__getstate__()
    return left.keys() == right.keys() and all(
        np.array_equal(np.asarray(left[name]), np.asarray(right[name])) for name in left
    )


def waiting_for(there, child):
    """Returns once something is there; a child that ends before, or hangs for a minute, fails."""
    deadline = time.monotonic() + 60
    while not there():
        assert child.poll() is None
        assert time.monotonic() < deadline
        time.sleep(0.02)
