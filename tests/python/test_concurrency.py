"""Threads, processes and Ctrl-C: an integration does not block other threads."""

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


# Each would take minutes, the last one several seconds; a test fails a minute after Ctrl-C.
LONG = {
    "many samples": "ss.integrate(cart(1e4), ss.GroundMotion(noise(5_000_000), dt=0.1))",
    "long samples": "ss.integrate(cart(1.3), ss.GroundMotion(noise(5_000_000), dt=1000.0))",
    "settling": """ss.integrate(
            ss.Slider(ss.Caster(slip_level=1.0, reach=0.05), 100.0),
            ss.GroundMotion(0 * noise(1_000_000), dt=1e-9), displacement=30.0, settle=True)""",
    "casters under pulses": """ss.theory.PulseSuperposition().predict(
            ss.Caster(slip_level=1.0, reach=10.0),
            ss.PoissonPulses(rate=0.5, half_width=1.0, sigma=10.0, duration=60.0), [60.0])""",
}

SCRIPT = """
import numpy as np
import stickslip as ss

cart = lambda natural_frequency: ss.Slider(ss.Caster(slip_level=1.0, reach=0.5), natural_frequency)
noise = lambda samples: np.random.default_rng(1).normal(0, 2, samples)
try:
    print("run", flush=True)
    {work}
    print("ended")
except KeyboardInterrupt:
    print("interrupted")
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
def test_ctrl_c_ends_an_integration(work):
    script = SCRIPT.format(work=LONG[work])
    with subprocess.Popen(
        [sys.executable, "-c", script], stdout=subprocess.PIPE, text=True
    ) as process:
        try:
            assert process.stdout.readline() == "run\n"
            time.sleep(0.5)  # for it to have begun in earnest; if it has not, nothing fails
            process.send_signal(signal.SIGINT)
            output, _ = process.communicate(timeout=60)
        except subprocess.TimeoutExpired:
            pytest.fail("a minute after Ctrl-C it still ran")
        finally:
            process.kill()
    assert output == "interrupted\n"


def test_a_subinterpreter_is_refused_not_hung():
    code = """
try:
    import _interpreters as interpreters
except ImportError:
    import _xxsubinterpreters as interpreters
one = interpreters.create()
text = "try:\\n import stickslip._core\\nexcept ImportError as error:\\n print(error)"
interpreters.run_string(one, text)
"""
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, timeout=60)
    assert "does not support subinterpreters" in done.stdout + done.stderr
