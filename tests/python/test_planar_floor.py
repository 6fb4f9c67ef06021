"""Floor spectra of sliders in two horizontal directions."""

import numpy as np
import pytest
import stickslip as ss

PERIODS = [0.1, 0.3, 1.0, 3.0]


def station(seed=1, samples=600, dt=0.01):
    """Two smooth random histories of some 2 m/s^2, which fade in and out."""
    rng = np.random.default_rng(seed)
    window = np.sin(np.pi * np.arange(samples) / samples) ** 2
    white = [np.convolve(rng.standard_normal(samples), np.hanning(25), "same") for _ in range(2)]
    faded = [window * (w - (window * w).sum() / window.sum()) for w in white]
    n, t = (2 * f / f.std() for f in faded)
    return ss.GroundMotion(n, dt=dt, transverse=t)


def test_a_floor_that_does_not_slide_is_the_ground():
    ground = station()
    r = ss.integrate(ss.PlanarSlider(ss.Coulomb(mu=2)), ground)
    for direction in (0, 35, 90):
        floor = ss.response_spectrum(r, PERIODS, direction=direction)
        rotated = ss.response_spectrum(ground.rotated(direction), PERIODS)
        assert floor.values == pytest.approx(rotated.values, rel=1e-12)
        same = ss.response_spectrum(ground, PERIODS, direction=direction)
        assert np.array_equal(same.values, rotated.values)


@pytest.mark.slow
def test_rotd_of_a_floor():
    r = ss.integrate(ss.PlanarSlider(ss.Coulomb(mu=0.1)), station(samples=200), settle=True)
    table = ss.rotd(r, PERIODS, damping=0.02)
    assert table.values.shape == (180, 4)
    for degrees in (0, 90, 133):
        one = ss.response_spectrum(r, PERIODS, 0.02, direction=degrees)
        assert np.array_equal(table.values[degrees], one.values)
    assert (table.rotd50 <= table.rotd100).all()
    # A floor that slides is accelerated as strongly as friction allows, in some direction.
    rigid = ss.rotd(r)
    assert r.peak_force * np.cos(np.radians(0.5)) <= rigid.rotd100[0] <= r.peak_force * (1 + 1e-12)
    assert table.to_dataframe().shape == (4, 5)


def test_impacts_on_the_circular_stop_are_impulses():
    slider = ss.PlanarSlider(ss.Coulomb(mu=0.05), stops=ss.Stops(gap=0.02, restitution=0.5))
    r = ss.integrate(slider, station(), settle=True)
    assert len(r.impacts)
    with pytest.raises(ValueError, match="impulse; give periods above 0"):
        ss.rotd(r)
    free = ss.integrate(ss.PlanarSlider(ss.Coulomb(mu=0.05)), station(), settle=True)
    for direction in (0, 60, 120):
        with_stops, without = (ss.response_spectrum(f, 0.1, direction=direction) for f in (r, free))
        assert with_stops.values > 2 * without.values


def test_directions_that_do_not_exist_are_refused():
    ground = station()
    along = ss.GroundMotion(ground.acceleration, dt=0.01)
    one = ss.integrate(ss.Coulomb(mu=0.1), along)
    with pytest.raises(ValueError, match=r"direction needs .* two horizontal components"):
        ss.response_spectrum(one, 1.0, direction=90)
    with pytest.raises(ValueError, match="needs a transverse component"):
        ss.response_spectrum(along, 1.0, direction=90)
    with pytest.raises(ValueError, match="direction must be finite"):
        ss.response_spectrum(ground, 1.0, direction=np.nan)
    with pytest.raises(TypeError, match="a PlanarResponse or a CartResponse, got Response"):
        ss.rotd(one)
