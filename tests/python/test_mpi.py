"""Ensembles and sweeps on processes that talk by MPI, a real one: the same bits as here."""

import os
import shutil
import subprocess
import sys

import pytest

MPIEXEC = shutil.which("mpiexec")

PROGRAM = """
import os
import numpy as np
import stickslip as ss
from mpi4py import MPI
from mpi4py.futures import MPIPoolExecutor


def rank(_):
    return MPI.COMM_WORLD.rank


if __name__ == "__main__":
    waves = [np.sin(np.arange(900) / (3 + i)) for i in range(12)]
    quakes = [ss.GroundMotion(2 * n, dt=0.01) for n in waves]
    sliders = ss.grid(ss.Slider, law=ss.grid(ss.Coulomb, mu=[0.05, 0.1]), period=[1, 2])
    band = ss.Spectrum.band_pass(s0=1.0, low=2.0, high=12.0)
    source = ss.GaussianExcitation(band, dt=0.1, samples=256)
    block = ss.Coulomb(mu=0.05)
    with MPIPoolExecutor() as pool:
        assert set(pool.map(rank, range(50))) == {1, 2}
        table = ss.sweep(sliders, quakes, executor=pool)
        ensemble = ss.run_ensemble(block, source, members=500, seed=1, executor=pool)
    assert table == ss.sweep(sliders, quakes)
    assert ensemble == ss.run_ensemble(block, source, members=500, seed=1)
    print("the same bits")
"""


@pytest.mark.slow
@pytest.mark.skipif(MPIEXEC is None, reason="needs mpiexec, as of Open MPI")
def test_processes_of_mpi_find_the_same_bits(tmp_path):
    pytest.importorskip("mpi4py", reason="needs MPI: pip install mpi4py")
    program = tmp_path / "program.py"
    program.write_text(PROGRAM)
    # What Open MPI asks for in a container: more processes than cores, and root.
    environment = {
        "OMPI_ALLOW_RUN_AS_ROOT": "1",
        "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1",
        "OMPI_MCA_rmaps_base_oversubscribe": "1",
    }
    run = subprocess.run(
        [MPIEXEC, "-n", "3", sys.executable, "-m", "mpi4py.futures", str(program)],
        env=os.environ | environment,
        capture_output=True,
        text=True,
        timeout=300,
        check=False,
    )
    assert run.returncode == 0, run.stderr
    assert run.stdout.strip().endswith("the same bits")
