"""Clusters for tests: of several processes, one of which is lost."""

import os
import signal
from contextlib import contextmanager

import pytest


@contextmanager
def losing_a_worker():
    """The executor of a Dask cluster of two processes, and a progress callback that kills one of
    them when a quarter of the work is done. At the end one must be dead."""
    distributed = pytest.importorskip(
        "distributed", reason="needs a cluster: pip install dask[distributed]"
    )
    killed = []

    def kill_one(done, total):
        if done > total // 4 and not killed:
            killed.append(pids.pop())
            os.kill(killed[0], signal.SIGKILL)

    with (
        distributed.LocalCluster(
            n_workers=2, threads_per_worker=1, processes=True, dashboard_address=":0"
        ) as cluster,
        distributed.Client(cluster) as client,
    ):
        pids = list(client.run(os.getpid).values())
        assert len(set(pids)) == 2
        with client.get_executor() as pool:
            yield pool, kill_one
    assert len(killed) == 1
