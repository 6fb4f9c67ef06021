"""Threads, processes and Ctrl-C: an integration holds up nobody."""

import concurrent.futures
import multiprocessing
import os
import signal
import subprocess
import sys
import threading
import time

import numpy as np
import pytest
import stickslip as ss

CART = ss.Slider(ss.Caster(slip_level=1.0, reach=0.5), 1.3)


def peak(slider, motion):
    return ss.integrate(slider, motion).peak


def noise(seed, samples=2000):
    return ss.GroundMotion(np.random.default_rng(seed).normal(0, 2, samples), dt=0.1)


def test_other_threads_run_during_an_integration():
    # If the interpreter were held, the counter could advance once or twice at the ends.
    motion, ticks, done = noise(1, 5_000_000), 0, threading.Event()

    def count():
        nonlocal ticks
        while not done.wait(1e-3):
            ticks += 1

    thread = threading.Thread(target=count)
    thread.start()
    try:
        before = ticks
        ss.integrate(CART.law, motion)
        assert ticks - before >= 20
    finally:
        done.set()
        thread.join()


def test_threads_get_the_answers_of_one():
    motions = [noise(seed) for seed in range(32)]
    alone = [ss.integrate(CART, motion).displacement for motion in motions]
    with concurrent.futures.ThreadPoolExecutor(4) as pool:
        together = list(pool.map(lambda m: ss.integrate(CART, m).displacement, motions))
    assert all(np.array_equal(a, b) for a, b in zip(alone, together))


def test_processes_get_the_answers_of_one():
    sliders = [ss.Coulomb(slip_level=1.0, backward=1.6), CART] * 2
    motions = [noise(seed) for seed in range(4)]
    with multiprocessing.get_context("spawn").Pool(2) as pool:
        assert pool.starmap(peak, zip(sliders, motions)) == [*map(peak, sliders, motions)]


LONG = {
    "many samples": "ss.integrate(cart, ss.GroundMotion(noise(5_000_000), dt=0.1))",
    "long samples": "ss.integrate(cart, ss.GroundMotion(noise(60_000), dt=10.0))",
    "settling": """ss.integrate(
            ss.Slider(ss.Caster(slip_level=1.0, reach=0.05), 100.0),
            ss.GroundMotion([0, 0], dt=1), displacement=3.0, settle=True)""",
    "casters under pulses": """ss.theory.PulseSuperposition().predict(
            ss.Caster(slip_level=1.0, reach=10.0),
            ss.PoissonPulses(rate=0.5, half_width=1.0, sigma=10.0, duration=60.0), [60.0])""",
}

SCRIPT = """
import time
import numpy as np
import stickslip as ss

cart = ss.Slider(ss.Caster(slip_level=1.0, reach=0.5), 1.3)
noise = lambda samples: np.random.default_rng(1).normal(0, 2, samples)
try:
    for runs in range(1000):
        print("run", flush=True)
        {work}
except KeyboardInterrupt:
    print("interrupted", runs, time.time(), flush=True)
"""


@pytest.mark.skipif(os.name == "nt", reason="Windows has no SIGINT to send")
@pytest.mark.parametrize(
    "work",
    [
        "many samples",
        "long samples",
        "settling",
        "casters under pulses",
    ],
)
def test_ctrl_c_ends_an_integration_within_a_second(work):
    script = SCRIPT.format(work=LONG[work])
    with subprocess.Popen(
        [sys.executable, "-c", script], stdout=subprocess.PIPE, text=True
    ) as process:
        try:
            assert process.stdout.readline() == "run\n"
            time.sleep(0.5)
            sent = time.time()
            process.send_signal(signal.SIGINT)
            output, _ = process.communicate(timeout=2)
        except subprocess.TimeoutExpired:
            pytest.fail("two seconds after Ctrl-C it still ran")
        finally:
            process.kill()
    word, runs, caught = output.split()
    assert word == "interrupted"
    assert runs == "0"  # within an integration, not between two
    assert float(caught) - sent < 1
