"""Every law and mounting in ensembles, files, tables, JSON and pictures."""

import json

import numpy as np
import pytest
import stickslip as ss

G = ss.STANDARD_GRAVITY
M = np.arange(401)
RECORD = 2 * np.sin(0.7 * M) + 1.3 * np.cos(1.9 * M + 0.4)
UPWARD = 2.5 * np.cos(0.5 * M + 0.2)
QUAKE = ss.GroundMotion(RECORD, dt=0.1)
SHAKEN = ss.GroundMotion(RECORD, dt=0.1, vertical=4.2 * UPWARD)
SHAKING = ss.GaussianExcitation(
    ss.Spectrum.band_pass(s0=0.3, low=2, high=30),
    dt=0.05,
    samples=201,
    envelope=ss.Envelope.from_table([0, 1, 8, 10], [0, 1, 1, 0]),
)
STOPS = ss.Stops(gap=0.05, restitution=0.5, backward=0.1)

# By name: the slider, what a picture says of it, and parts of its configuration.
SLIDERS = {
    "static": (
        ss.Slider(ss.StaticKinetic(mu_static=0.13, mu_kinetic=0.1)),
        "static level 0.130 g, slip level 0.100 g",
        {"law": "Coulomb", "slip_level": 0.1 * G, "static": [0.13 * G] * 2},
    ),
    "static both ways": (
        ss.Slider(ss.StaticKinetic(static=(0.2 * G, 0.3 * G), kinetic=0.1 * G)),
        "static level 0.200 g forward, 0.300 g backward, slip level 0.100 g",
        {"static": [0.2 * G, 0.3 * G]},
    ),
    "static caster": (
        ss.Slider(ss.StaticKinetic(ss.Caster(mu=0.1, reach=0.2), mu_static=0.2)),
        "static level 0.200 g, slip level 0.100 g, caster, reach 20.0 cm",
        {"law": "Caster", "reach": 0.2, "static": [0.2 * G] * 2},
    ),
    "by speed": (
        ss.Slider(ss.VelocityDependent(mu_slow=0.05, mu_fast=0.1, rate=20), 2.0),
        "slip level 0.0500 g slow, 0.100 g fast, period 3.14 s",
        {"law": "VelocityDependent", "fast": 0.1 * G, "rate": 20},
    ),
    "static by speed": (
        ss.Slider(
            ss.StaticKinetic(
                ss.VelocityDependent(mu_slow=0.05, mu_fast=0.1, rate=20), mu_static=0.12
            )
        ),
        "static level 0.120 g, slip level 0.0500 g slow, 0.100 g fast",
        {"law": "VelocityDependent", "static": [0.12 * G] * 2},
    ),
    "Stribeck": (
        ss.Slider(ss.Stribeck(mu_static=0.13, mu_kinetic=0.08, velocity=0.1, exponent=2)),
        "slip level 0.130 g at rest, 0.0800 g fast",
        {"law": "Stribeck", "velocity": 0.1, "exponent": 2},
    ),
    "degrading": (
        ss.Slider(ss.Degrading(distance=[0, 0.5], mu=[0.12, 0.05])),
        "slip level 0.120 g, 0.0500 g after 50.0 cm",
        {"law": "Degrading", "distances": [0, 0.5]},
    ),
    "static degrading": (
        ss.Slider(
            ss.StaticKinetic(
                ss.Degrading(distance=[0, 1], mu=[0.1, 0.05], mu_backward=[0.1, 0.08]),
                mu_static=0.15,
            )
        ),
        "static level 0.150 g, slip level 0.100 g, 0.0500 g after 100 cm, different backward",
        {"law": "Degrading", "static": [0.15 * G] * 2},
    ),
    "pendulum": (
        ss.FrictionPendulum(radius=2, mu=0.05),
        "slip level 0.0500 g, pendulum, radius 2.00 m, period 2.84 s",
        {"pendulum": True},
    ),
    "stops": (
        ss.Slider(ss.Coulomb(mu=0.05), 2, 0.1, stops=STOPS),
        "stops at 5.00 cm forward, 10.0 cm backward, restitution 0.500",
        {"stops": [0.05, 0.1, 0.5], "damping": 0.1},
    ),
    "one stop": (
        ss.Slider(
            ss.Coulomb(mu=0.05), stops=ss.Stops(gap=0.1, restitution=0, backward=float("inf"))
        ),
        "stops at 10.0 cm forward, restitution 0.00",
        {"stops": [0.1, None, 0]},
    ),
    "slope": (
        ss.Slider(ss.Coulomb(mu=0.2), slope_degrees=5, one_way=True),
        "slip level 0.200 g, slope 5.00\N{DEGREE SIGN}, one way",
        {"slope_degrees": 5, "one_way": True},
    ),
    "degrading slope": (
        ss.Slider(ss.Degrading(distance=[0, 0.5], mu=[0.3, 0.15]), slope_degrees=5, one_way=True),
        "slip level 0.300 g, 0.150 g after 50.0 cm, slope 5.00\N{DEGREE SIGN}, one way",
        {"law": "Degrading", "slope_degrees": 5},
    ),
}


@pytest.fixture(params=SLIDERS)
def case(request):
    return SLIDERS[request.param]


def test_an_ensemble_keeps_the_slider_in_its_files(case, tmp_path):
    slider, _, known = case
    for motions in (SHAKING, ss.WithVertical(SHAKING, ratio=0.7), [QUAKE, SHAKEN]):
        e = ss.run_ensemble(slider, motions, members=20, seed=1, contact="clipped")
        e.save(tmp_path / "e.npz")
        again = ss.Ensemble.load(tmp_path / "e.npz")
        assert again == e
        configuration = json.loads(json.dumps(again.configuration))
        for name, value in known.items():
            assert configuration["slider"][name] == value, name
        assert configuration["contact"] == "clipped"
        resumed = ss.run_ensemble(
            slider,
            motions,
            members=20,
            seed=1,
            contact="clipped",
            checkpoint=tmp_path / "e.npz",
        )
        assert resumed == e


def test_ensembles_of_different_sliders_do_not_merge():
    runs = {
        name: ss.run_ensemble(slider, [QUAKE], members=1, seed=1)
        for name, (slider, _, _) in SLIDERS.items()
    }
    for name, run in runs.items():
        for other, there in runs.items():
            if name != other:
                with pytest.raises(ValueError, match="slider"):
                    there.merge(run)


def test_pictures_say_what_slid(case):
    pytest.importorskip("matplotlib", reason="pictures need matplotlib")
    slider, words, _ = case
    e = ss.run_ensemble(slider, SHAKING, members=20, seed=1)
    assert e.plot().get_suptitle().replace("\n", " ").endswith(words)
    for motion in (QUAKE, SHAKEN):
        r = ss.integrate(slider, motion)
        for figure in (r.plot(), r.plot_hysteresis()):
            axes = figure.axes[0]
            assert any(text.get_text().replace("\n", " ").endswith(words) for text in axes.texts)
            figure.draw_without_rendering()
            assert axes.get_position().width > 0.7  # the text leaves room for the curves


def test_the_band_of_accelerations_that_friction_resists_ends_where_slips_begin(case):
    """At each breakaway on level ground the drawn bound is the ground acceleration."""
    pytest.importorskip("matplotlib", reason="pictures need matplotlib")
    from stickslip.plotting import trajectory

    slider, _, _ = case
    fading = ss.GroundMotion(RECORD * np.sin(0.04 * M) ** 2, dt=0.1)  # begins and ends at rest
    r = ss.integrate(slider, fading)
    starts = r.events[r.events["kind"] == "breakaway"]
    if slider.stops is not None:  # at a stop the load that leaves it is another
        starts = starts[np.abs(starts["displacement"]) < 0.9 * slider.stops.gap]
    n = np.interp(starts["time"], fading.time, fading.acceleration) / G
    curve = r._curve()
    curve = curve[np.abs(curve["time"][:, None] - starts["time"]).argmin(axis=0)]
    lower, upper = trajectory.slip_bounds(slider, curve)
    assert len(starts) > 2
    assert np.minimum(abs(n - lower), abs(n - upper)).max() < 1e-9


FAR = ss.Degrading(distance=[0, 20], mu=[0.1, 0.02], mu_backward=[0.1, 0.05])


@pytest.mark.parametrize(
    "law",
    [
        ss.StaticKinetic(mu_static=0.13, mu_kinetic=0.1),
        ss.StaticKinetic(static=(0.2 * G, 0.3 * G), kinetic=0.1 * G),
        FAR,
        ss.StaticKinetic(FAR, mu_static=0.11),
    ],
    ids=["static", "both ways", "degrading", "static degrading"],
)
def test_the_area_of_the_drawn_loop_is_the_dissipated_energy(law):
    """Friction that is constant or linear in the distance has a loop of straight lines."""
    r = ss.integrate(law, QUAKE, settle=True)
    assert 0.5 < r.sliding_distance < 20
    curve = r._curve()
    x, force = curve["displacement"], curve["force"]
    area = ((force[1:] + force[:-1]) / 2 * np.diff(x)).sum()
    assert area == pytest.approx(r.energy.dissipated, rel=1e-10)


def test_the_drawn_force_after_an_impact_is_that_of_the_rebound():
    slider = SLIDERS["stops"][0]
    r = ss.integrate(slider, QUAKE)
    curve = r._curve()
    x, force = curve["displacement"], curve["force"]
    hits = r.impacts[np.abs(r.impacts["velocity"]) > 0.1]
    assert len(hits) > 5
    for hit in hits:
        at, before = hit["displacement"], hit["velocity"]
        after, way = -0.5 * before, np.sign(before)
        for v, s in ((before, way), (after, -way)):
            expected = s * 0.05 * G + slider.damping * v + slider.natural_frequency**2 * at
            assert np.abs(force[np.abs(x - at) < 1e-12] - expected).min() < 1e-12


def test_tables_have_the_normal_force_and_the_gap_where_the_ground_moves_vertically():
    pytest.importorskip("pandas", reason="needs pandas")
    slider = ss.Slider(ss.Coulomb(mu=0.1), 2, 0.1, stops=STOPS)
    r = ss.integrate(slider, SHAKEN, settle=True)
    assert "liftoff" in r.events["kind"]
    frame = r.to_dataframe()
    n = len(SHAKEN)
    vertical = frame["vertical_ground_acceleration"].to_numpy()
    assert np.array_equal(vertical[:n], SHAKEN.vertical)
    assert not vertical[n:].any()
    assert {"normal_force", "gap"} <= set(frame)
    document = json.loads(r.to_json())
    assert document["contact"] == "flight"
    assert document["units"]["vertical_ground_acceleration"] == "m/s^2"
    kinds = {event["kind"] for event in document["events"]}
    assert {"liftoff", "landing", "impact"} <= kinds
    flights = (r.events["kind"] == "liftoff").sum()
    text = r._repr_html_()
    assert f"flight, {flights} flights" in text
    assert f'<td style="text-align: left">{len(r.impacts)}</td>' in text


def test_tables_of_a_slope_have_the_normal_force_and_level_ground_has_neither():
    slope = ss.integrate(SLIDERS["slope"][0], QUAKE)
    document = json.loads(slope.to_json())
    assert document["normal_force"] == slope.normal_force.tolist()
    assert "gap" not in document
    level = json.loads(ss.integrate(ss.Coulomb(mu=0.1), QUAKE).to_json())
    assert not {"gap", "normal_force", "vertical_ground_acceleration"} & level.keys()
