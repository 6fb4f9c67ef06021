"""The viscous slider in Python: functions that accept it, their results, and its lifetime."""

import json
from concurrent.futures import ProcessPoolExecutor

import numpy as np
import pytest
import stickslip as ss
from scipy.integrate import solve_ivp

NAN, INF = float("nan"), float("inf")


def quake(samples=200, seed=1):
    return ss.GroundMotion(np.random.default_rng(seed).standard_normal(samples), dt=0.1)


@pytest.mark.parametrize("damping, wn", [(0.0, 0.0), (1.3, 0.0), (0.4, 3.0), (30.0, 2.0)])
def test_it_moves_as_its_equation_says(damping, wn):
    motion = quake()
    r = ss.integrate(ss.ViscousSlider(damping, wn), motion, displacement=0.2, velocity=-0.1)

    def rate(t, y):
        n = np.interp(t, motion.time, motion.acceleration)
        return y[1], -n - damping * y[1] - wn**2 * y[0]

    solution = solve_ivp(
        rate,
        (0, motion.time[-1]),
        (0.2, -0.1),
        t_eval=motion.time,
        max_step=0.1,
        rtol=1e-9,
        atol=1e-10,
    )
    # The kinks between samples cost the solver the digits.
    assert np.abs(solution.y[0] - r.displacement).max() < 1e-5 * r.peak
    assert np.abs(solution.y[1] - r.velocity).max() < 1e-5 * np.abs(r.velocity).max()
    assert "arrest" not in r.events["kind"]
    assert r.energy.dissipated == 0
    assert abs(r.energy.imbalance) < 1e-11 * max(r.energy.damped, abs(r.energy.input))


def test_a_response_knows_its_viscous_slider():
    slider = ss.ViscousSlider(1.5, natural_frequency=2)
    r = ss.integrate(slider, quake())
    assert r.slider == slider
    assert not r.at_rest
    assert slider.damping == 1.5
    assert slider.natural_frequency == 2.0
    assert repr(slider) == "Slider(Coulomb(slip_level=0), natural_frequency=2, damping=1.5)"
    assert slider == ss.Slider(ss.Coulomb(slip_level=0), 2, 1.5)
    assert slider != ss.ViscousSlider(1.5)
    assert slider != ss.Slider(ss.Coulomb(slip_level=1.5), 2.0)


def test_an_ensemble_of_it_is_its_members_anywhere():
    spectrum = ss.Spectrum.band_pass(s0=1.0, low=2.0, high=4.0)
    shaking = ss.GaussianExcitation(spectrum, dt=0.1, samples=128, period=1024)
    slider = ss.ViscousSlider(0.7)
    e = ss.run_ensemble(slider, shaking, members=130, seed=5)
    member = ss.integrate(slider, shaking.sample(seed=5, member=77))
    assert e.peak[77] == pytest.approx(member.peak, rel=1e-12)
    assert e.residual[77] == pytest.approx(member.residual, abs=1e-12)
    assert e.configuration["slider"] == {
        "law": "Coulomb",
        "slip_level": 0,
        "backward": 0,
        "natural_frequency": 0,
        "damping": 0.7,
    }
    with ProcessPoolExecutor(1) as pool:
        elsewhere = ss.run_ensemble(slider, shaking, members=130, seed=5, executor=pool)
    assert np.array_equal(elsewhere.velocity_variance, e.velocity_variance)

    class Mine:
        duration, dt, configuration = 12.7, 0.1, "mine"

        def sample(self, *, seed, member):
            return shaking.sample(seed=seed, member=member)

    mine = ss.run_ensemble(slider, Mine(), members=130, seed=5)
    assert mine.peak == pytest.approx(e.peak, rel=1e-12)
    assert json.dumps(mine.configuration)


@pytest.mark.parametrize("wn", [0.0, 2.0])
def test_it_can_be_drawn(wn):
    pytest.importorskip("matplotlib")
    slider = ss.ViscousSlider(1.0, wn)
    from stickslip import plotting

    r = ss.integrate(slider, quake())
    assert plotting.sticks(r).shape == (0, 2)
    figure = r.plot()
    assert "viscous damping 1.00 1/s" in texts(figure)
    plotting.plot_responses([r, ss.integrate(ss.Coulomb(mu=0.01), r.motion)])
    spectrum = ss.Spectrum.band_pass(s0=1, low=2, high=4)
    shaking = ss.GaussianExcitation(spectrum, 0.1, 128, period=1024)
    figure = ss.run_ensemble(slider, shaking, members=64, seed=1).plot()
    assert "viscous damping 1.00 1/s" in texts(figure)


def texts(figure):
    return "".join(t.get_text() for t in figure.findobj(match=lambda a: hasattr(a, "get_text")))


@pytest.mark.filterwarnings("ignore:.* natural_frequency = :stickslip.PlausibilityWarning")
def test_what_it_cannot_be_or_do_is_refused():
    for damping, wn in ((-1, 0), (NAN, 0), (INF, 0), (1, -1), (1, NAN), (1, 1e200)):
        with pytest.raises(ValueError, match="Slider"):
            ss.ViscousSlider(damping, wn)
    with pytest.raises(TypeError):
        ss.ViscousSlider("1")
    slider = ss.ViscousSlider(1)
    with pytest.raises(ss.ConvergenceError, match="does not come to rest"):
        ss.integrate(slider, quake(), settle=True)
    with pytest.raises(TypeError, match="GroundMotion"):
        ss.integrate(slider, [1, 2])
    with pytest.raises(ss.ConvergenceError, match="does not come to rest"):
        ss.run_ensemble(
            slider, ss.PoissonPulses.event("great near field"), members=2, seed=1, settle=True
        )
    with pytest.raises(ss.ConvergenceError, match="events"):
        ss.integrate(ss.ViscousSlider(0, 1e9), quake())
    histories = ss.histories(slider, quake())
    assert np.array_equal(histories[0], ss.integrate(slider, quake()).displacement)
