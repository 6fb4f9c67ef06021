"""Executors: threads, processes, a cluster; the same bits, whatever fails."""

import multiprocessing
import queue
import threading
from concurrent.futures import Executor, Future, ProcessPoolExecutor, ThreadPoolExecutor

import pytest
import stickslip as ss
from clusters import losing_a_worker
from sources import BLOCK, SHAKING, Delayed, die, refuse, same_bits

MEMBERS = 2000


@pytest.fixture(scope="module")
def whole():
    return ss.run_ensemble(BLOCK, SHAKING, members=MEMBERS, seed=1)


@pytest.fixture(scope="module")
def slow_whole():
    return ss.run_ensemble(BLOCK, Delayed(), members=MEMBERS, seed=1)


def run(executor, source=SHAKING, **more):
    return ss.run_ensemble(BLOCK, source, members=MEMBERS, seed=1, executor=executor, **more)


@pytest.fixture(scope="module")
def processes():
    with ProcessPoolExecutor(2, mp_context=multiprocessing.get_context("spawn")) as pool:
        yield pool


@pytest.mark.parametrize("threads", [1, 3])
def test_threads_give_the_same_bits(whole, threads):
    with ThreadPoolExecutor(threads) as pool:
        assert same_bits(run(pool), whole)


def test_processes_give_the_same_bits(whole, processes):
    assert same_bits(run(processes), whole)


@pytest.mark.skipif(
    "forkserver" not in multiprocessing.get_all_start_methods(), reason="needs forkserver"
)
def test_processes_of_a_server_give_the_same_bits(whole):
    with ProcessPoolExecutor(2, mp_context=multiprocessing.get_context("forkserver")) as pool:
        assert same_bits(run(pool), whole)


class Backwards(Executor):
    """Gathers what it is given for a while, and then does the last first."""

    def __init__(self):
        self.waiting, self.order = queue.LifoQueue(), []
        self.ended = threading.Event()
        self.thread = threading.Thread(target=self.work)
        self.thread.start()

    def submit(self, function, /, *args):
        future = Future()
        self.waiting.put((future, function, args))
        return future

    def work(self):
        while not self.ended.wait(0.02):
            while self.waiting.qsize() > (0 if self.order else 1):  # at first, two to choose from
                future, function, args = self.waiting.get()
                self.order.append(args[-2])
                future.set_result(function(*args))

    def shutdown(self, wait=True, *, cancel_futures=False):
        self.ended.set()
        self.thread.join()


def test_parts_may_come_back_in_any_order(whole):
    with Backwards() as pool:
        assert same_bits(run(pool), whole)
    assert sorted(pool.order) != pool.order


def test_parts_begin_and_end_on_whole_blocks_and_grow():
    class Noting(ThreadPoolExecutor):
        def submit(self, function, /, *args):
            parts.append(args[-2:])
            return super().submit(lambda: (function(*args)[0], 1e-5 * args[-1]))  # however fast

    parts = []
    with Noting(1) as pool:
        ss.run_ensemble(BLOCK, SHAKING, members=50_000, seed=1, executor=pool)
    assert sum(count for _, count in parts) == 50_000
    for first, count in parts[:-1]:
        blocks = count // 64
        assert count % 64 == 0
        assert blocks & (blocks - 1) == 0
        assert first % count == 0
    sizes = [count for _, count in parts]
    assert max(sizes) > 4 * sizes[0]
    assert len(parts) < 200


def test_a_run_goes_on_in_an_executor_from_where_it_was(whole, tmp_path):
    file = tmp_path / "run.npz"
    odd = ss.run_ensemble(BLOCK, SHAKING, members=64, first_member=192, seed=1)
    odd.merge(ss.run_ensemble(BLOCK, SHAKING, members=128, first_member=640, seed=1))
    odd.save(file)
    with ThreadPoolExecutor(2) as pool:
        assert same_bits(run(pool, checkpoint=file), whole)
        assert same_bits(ss.Ensemble.load(file), whole)
        assert same_bits(run(pool, checkpoint=file), whole)  # nothing is left to do
        ss.run_ensemble(BLOCK, SHAKING, members=100, seed=1).save(file)
        with pytest.raises(ValueError, match=r"run\.npz': .*ends at member 100, within a block"):
            run(pool, checkpoint=file)
        with pytest.raises(ValueError, match=r"run\.npz': .*seed 2 against seed 1"):
            ss.run_ensemble(BLOCK, SHAKING, members=MEMBERS, seed=2, executor=pool, checkpoint=file)


def test_a_cut_last_block_and_another_first_member():
    one = ss.run_ensemble(BLOCK, SHAKING, members=333, first_member=6400, seed=1)
    with ThreadPoolExecutor(2) as pool:
        other = ss.run_ensemble(
            BLOCK, SHAKING, members=333, first_member=6400, seed=1, executor=pool
        )
    assert same_bits(one, other)


def test_threads_and_an_executor_exclude_each_other():
    with ThreadPoolExecutor(1) as pool, pytest.raises(ValueError, match="threads or executor"):
        run(pool, threads=2)


def test_progress_counts_members():
    seen = []
    with ThreadPoolExecutor(2) as pool:
        run(pool, progress=lambda *now: seen.append(now))
    assert seen[-1] == (MEMBERS, MEMBERS)
    assert [d for d, _ in seen] == sorted(d for d, _ in seen)


# ---- what fails


@pytest.mark.parametrize("kind", ["threads", "processes"])
def test_a_part_that_fails_is_named_and_the_rest_is_kept(kind, processes, slow_whole, tmp_path):
    file = tmp_path / "run.npz"
    with ThreadPoolExecutor(2) as threads:
        pool = {"threads": threads, "processes": processes}[kind]
        with pytest.raises(ss.EnsembleError) as failure:
            run(pool, Delayed(2e-4, 1200, refuse), checkpoint=file)
        error = failure.value
        assert 1200 in error.members
        named = f"members {error.members[0]} to {error.members[-1]} failed"
        assert named in str(error)
        assert "LookupError: no motion here" in str(error)
        assert isinstance(error.__cause__, LookupError)
        assert 0 < error.partial.members < MEMBERS
        assert same_bits(ss.Ensemble.load(file), error.partial)
        # The executor is still good, and what was done need not be done again.
        assert same_bits(run(pool, Delayed(), checkpoint=file), slow_whole)


def test_processes_that_die_leave_what_was_done(slow_whole, tmp_path):
    file = tmp_path / "run.npz"
    with ProcessPoolExecutor(1, mp_context=multiprocessing.get_context("spawn")) as pool:
        with pytest.raises(ss.EnsembleError, match="BrokenProcessPool") as failure:
            run(pool, Delayed(0, 1200, die), checkpoint=file)
        assert 0 < failure.value.partial.members <= 1216
        with pytest.raises(ss.EnsembleError, match="BrokenProcessPool"):
            run(pool, Delayed(), checkpoint=file)
    assert same_bits(
        ss.run_ensemble(BLOCK, Delayed(), members=MEMBERS, seed=1, checkpoint=file), slow_whole
    )


def test_what_cannot_be_pickled_is_said(processes, monkeypatch):
    class Local(Delayed):
        pass

    # Said before the pool has it, which might otherwise wait for ever where it ends.
    monkeypatch.setattr(processes, "submit", lambda *task: pytest.fail("was submitted"))
    with pytest.raises(ss.EnsembleError, match="pickle"):
        run(processes, Local())


# ---- Dask


@pytest.mark.slow
def test_a_cluster_one_worker_of_which_is_killed_gives_the_same_bits(slow_whole):
    with losing_a_worker() as (pool, kill_one):
        e = run(pool, Delayed(1e-3), progress=kill_one)
    assert same_bits(e, slow_whole)
