"""Sliders in two horizontal directions: symmetries, forces, tables, pictures."""

import json
import math
import pickle

import numpy as np
import pytest
import stickslip as ss

G = ss.STANDARD_GRAVITY


def noise(seed, samples=600, dt=0.01):
    """A smooth random history of some 2 m/s^2, which fades in and out."""
    rng = np.random.default_rng(seed)
    window = np.sin(np.pi * np.arange(samples) / samples) ** 2
    white = np.convolve(rng.standard_normal(samples), np.hanning(25), "same")
    faded = window * (white - (window * white).sum() / window.sum())  # the ground ends at rest
    return 2 * faded / faded.std()


def station(seed=1, orientation="", **more):
    return ss.GroundMotion(
        noise(seed), dt=0.01, transverse=noise(seed + 100), orientation=orientation, **more
    )


SLIDERS = {
    "coulomb": ss.PlanarSlider(ss.Coulomb(mu=0.1)),
    "static": ss.PlanarSlider(ss.StaticKinetic(ss.Coulomb(mu=0.08), mu_static=0.12)),
    "pendulum": ss.PlanarSlider(
        ss.FrictionPendulum(radius=1.5, mu_slow=0.04, mu_fast=0.08, rate=50)
    ),
    "spring and damper": ss.PlanarSlider(ss.Coulomb(mu=0.06), period=1.2, damping_ratio=0.1),
    "stribeck": ss.PlanarSlider(
        ss.Stribeck(mu_static=0.12, mu_kinetic=0.08, velocity=0.1, exponent=1)
    ),
    "stop": ss.PlanarSlider(ss.Coulomb(mu=0.05), stops=ss.Stops(gap=0.05, restitution=0.5)),
}


@pytest.mark.parametrize("name", SLIDERS)
def test_forces_balance_and_friction_opposes_the_velocity(name):
    slider, quake = SLIDERS[name], station(7, vertical=0.5 * noise(70))
    r = ss.integrate(slider, quake)
    assert r.components == "axis + transverse + vertical"
    assert abs(r.energy.imbalance) < 1e-12 * (r.energy.initial + r.energy.dissipated)
    assert np.array_equal(r.force, r.friction + r.damper + r.spring)
    assert np.allclose(r.acceleration, -r.force, rtol=0, atol=1e-14)
    ground = np.column_stack([quake.acceleration, quake.transverse])
    # At rest on level ground the force is the load.
    assert np.allclose(r.force[r.stuck], -ground[r.stuck], rtol=0, atol=1e-12)
    speed = np.hypot(*r.velocity.T)
    slides = ~r.stuck & (speed > 1e-6)
    if slider.stops is not None:  # which holds the slider where it slides along it
        slides &= np.hypot(*r.displacement.T) < slider.stops.gap * (1 - 1e-9)
    level = np.array([slider.resist(one) for one in speed[slides].tolist()])
    expected = level * r.normal_force[slides] / G
    along = (r.friction[slides] * r.velocity[slides]).sum(1) / speed[slides]
    assert np.allclose(along, expected, rtol=0, atol=1e-10)
    assert np.allclose(np.hypot(*r.friction[slides].T), expected, rtol=0, atol=1e-10)


def test_the_peak_force_is_that_of_continuous_time():
    # Without a spring the resultant is the friction, at most the level at rest.
    r = ss.integrate(SLIDERS["coulomb"], station(8))
    assert r.peak_force == pytest.approx(0.1 * G, rel=1e-12)
    assert ss.integrate(SLIDERS["static"], station(8)).peak_force == pytest.approx(
        0.12 * G, rel=1e-12
    )
    slider = SLIDERS["spring and damper"]
    r = ss.integrate(slider, station(8))
    around = r.peak_force_time + np.linspace(-1e-3, 1e-3, 2001)
    there = r.at(around[(around >= 0) & (around <= r.time[-1])])
    velocity, place = there["velocity"], there["displacement"]
    friction = slider.hold() * velocity / np.hypot(*velocity.T)[:, None]
    force = friction + slider.damping * velocity + slider.natural_frequency**2 * place
    assert np.hypot(*force.T).max() == pytest.approx(r.peak_force, rel=1e-9)
    assert r.peak_force >= np.hypot(*r.force.T).max() * (1 - 1e-12)


def test_the_heat_of_a_surface_is_kept_and_continued():
    law = ss.KumarFriction(
        mu_ref=0.06, static_pressure=50e6, reference_pressure=50e6, contact_radius=0.2
    )
    slider = ss.PlanarSlider(ss.Slider(law, period=3.0, pendulum=True))
    n, t = noise(7, 120), noise(8, 120)
    whole = ss.integrate(slider, ss.GroundMotion(n, dt=0.01, transverse=t))
    assert whole.temperature.shape == (120,)
    assert whole.temperature[0] == 20 < whole.temperature.max()
    first = ss.integrate(slider, ss.GroundMotion(n[:61], dt=0.01, transverse=t[:61]))
    state = first.state
    second = ss.integrate(
        slider,
        ss.GroundMotion(n[60:], dt=0.01, transverse=t[60:]),
        displacement=state.displacement,
        velocity=state.velocity,
        sliding_distance=state.sliding_distance,
        heat=state.heat,
    )
    # The iteration of level and heat is accurate to 1e-8; the motion to 1e-7 of its scale.
    assert np.abs(second.residual - whole.residual).max() < 1e-7 * whole.peak
    assert second.temperature[-1] == pytest.approx(whole.temperature[-1], rel=1e-7)
    cold = ss.integrate(slider, ss.GroundMotion(n[60:], dt=0.01, transverse=t[60:]))
    assert cold.temperature[0] == 20
    # What reads the motion again begins with the same heat.
    assert (
        np.abs(second.at(0.25).displacement - whole.at(0.85).displacement).max() < 1e-7 * whole.peak
    )
    assert second.peak_force > 0
    other = pickle.loads(pickle.dumps(second))
    assert other == second
    assert np.array_equal(other.temperature, second.temperature)
    assert np.array_equal(other.at([0.3])["displacement"], second.at([0.3])["displacement"])
    assert other.margin == second.margin
    table = second.to_dataframe()
    assert np.array_equal(table["temperature"], second.temperature)
    assert table.attrs["units"]["temperature"] == "degC"
    assert json.loads(second.to_json())["temperature"] == second.temperature.tolist()
    assert ss.integrate(SLIDERS["coulomb"], station()).temperature is None


def test_at_any_time_and_step_by_step():
    slider, quake = SLIDERS["pendulum"], station(9, vertical=0.5 * noise(90))
    r = ss.integrate(slider, quake, settle=True)
    states = r.at(r.time[::7])
    assert np.allclose(states["displacement"], r.displacement[::7], rtol=0, atol=1e-12)
    peak = r.at(r.peak_time)
    assert isinstance(peak, ss.PlanarState)
    assert np.allclose(peak.displacement, r.peak_displacement, rtol=0, atol=1e-10)
    assert np.hypot(*r.peak_displacement) == pytest.approx(r.peak, rel=1e-12)
    assert r.at(r.events["time"][-1]).stuck
    with pytest.raises(ValueError, match="must be from 0 to"):
        r.at(-1)

    state = ss.PlanarState()
    n, t, up = quake.acceleration, quake.transverse, quake.vertical
    for i in range(len(quake) - 1):
        state = ss.advance(
            slider,
            state,
            0.01,
            (n[i], t[i]),
            (n[i + 1], t[i + 1]),
            vertical_start=up[i],
            vertical_end=up[i + 1],
        )
    assert np.allclose(state.displacement, r.displacement[len(quake) - 1], rtol=0, atol=1e-12)
    assert state.sliding_distance > 0
    assert repr(ss.PlanarState((0.1, 0), (0, 0.5))) == (
        "<PlanarState: r (0.1, 0) m, r' (0, 0.5) m/s, sliding>"
    )


def test_the_margin_of_a_load_that_all_but_moves_a_block():
    quiet = ss.GroundMotion([0, 0.6, 0], dt=1.0, transverse=[0, 0.45, 0])
    r = ss.integrate(ss.PlanarSlider(ss.Coulomb(slip_level=1)), quiet)
    assert r.margin == pytest.approx(0.25, rel=1e-14)
    assert r.impact_margin == math.inf


@pytest.mark.parametrize("name", SLIDERS)
def test_histories_are_those_of_integrate(name):
    quake = station(5, vertical=noise(205))
    r = ss.integrate(SLIDERS[name], quake)
    x, v = ss.histories(SLIDERS[name], quake)
    assert x.shape == v.shape == (len(quake), 2)
    assert np.array_equal(x, r.displacement)
    assert np.array_equal(v, r.velocity)
    with pytest.raises(ValueError, match="read-only"):
        x[0, 0] = 1
    with pytest.raises(ValueError, match="histories: a PlanarSlider needs both horizontal comp"):
        ss.histories(SLIDERS[name], ss.GroundMotion(noise(1), dt=0.01, name="x"))
    with pytest.raises(TypeError, match="histories: the motion of a PlanarSlider must be a Ground"):
        ss.histories(SLIDERS[name], [1.0, 2.0])


def test_a_start_in_motion_and_a_circular_stop():
    slider = SLIDERS["stop"]
    quiet = ss.GroundMotion(np.zeros(300), dt=0.01, transverse=np.zeros(300))
    # It stops after v^2 / (2 mu g), along the velocity.
    r = ss.integrate(slider, quiet, displacement=(0.01, 0), velocity=(0, 0.1))
    way = 0.1**2 / (2 * 0.05 * G)
    assert r.residual == pytest.approx([0.01, way], abs=1e-15)
    assert r.sliding_distance == pytest.approx(way, rel=1e-13)
    # Straight at the stop: half of the speed is left.
    r = ss.integrate(slider, quiet, velocity=(0.3, 0.4))
    assert r.peak == pytest.approx(0.05, rel=1e-14)
    speed = math.sqrt(0.5**2 - 2 * 0.05 * G * 0.05)
    (impact,) = r.impacts[:1]
    assert np.hypot(*impact["velocity"]) == pytest.approx(speed, rel=1e-12)
    assert r.energy.impact >= (1 - 0.25) * speed**2 / 2 * (1 - 1e-12)
    with pytest.raises(ValueError, match=r"within the stop at 0.05 m, got \|r\| = 0.06 m"):
        ss.integrate(slider, quiet, displacement=(0, 0.06))
    with pytest.raises(ValueError, match="velocity must be two numbers, along the axis"):
        ss.integrate(slider, quiet, velocity=0.1)
    with pytest.raises(ValueError, match=r"displacement must be two numbers.*shape \(3,\)"):
        ss.integrate(slider, quiet, displacement=[1, 2, 3])


@pytest.mark.parametrize(
    ("axis", "pulse", "azimuth"),
    [
        ("north", "axis", 0),
        ("north", "transverse", 90),
        ("E", "axis", 90),
        ("90", "transverse", 180),
        ("300", "transverse", 30),
    ],
)
def test_the_azimuth_of_the_peak(axis, pulse, azimuth):
    ground = np.r_[np.zeros(10), -3 * np.ones(20), np.zeros(70)]  # the slider is left behind
    still = np.zeros(100)
    both = (ground, still) if pulse == "axis" else (still, ground)
    quake = ss.GroundMotion(both[0], dt=0.01, transverse=both[1], orientation=axis)
    r = ss.integrate(ss.PlanarSlider(ss.Coulomb(mu=0.1)), quake, settle=True)
    assert r.peak_azimuth == pytest.approx(azimuth, abs=1e-9)


def test_the_azimuth_is_unknown_without_orientation_or_motion():
    r = ss.integrate(SLIDERS["coulomb"], station(1))
    assert r.peak > 0
    assert r.peak_azimuth is None
    r = ss.integrate(ss.PlanarSlider(ss.Coulomb(mu=2.5)), station(1, orientation="30"))
    assert r.peak == 0
    assert r.peak_azimuth is None


def test_what_cannot_slide_in_the_plane_is_refused():
    for law, why in (
        (ss.Caster(mu=0.1, reach=0.05), "Caster .* every wheel of a caster"),
        (ss.Coulomb(mu=0.1, backward=3.0), "Coulomb must have equal levels"),
        (
            ss.Law(hold=lambda x, d: 1.0, resist=lambda x, v, d: 1.0),
            "law from functions|FunctionLaw",
        ),
    ):
        with pytest.raises(
            ValueError, match=f"PlanarSlider: .*{why}.*laws for the plane are Coulomb"
        ):
            ss.PlanarSlider(law)
    with pytest.raises(ValueError, match="one_way has no meaning in the plane"):
        ss.PlanarSlider(ss.Slider(ss.Coulomb(mu=0.1), one_way=True))
    with pytest.raises(ValueError, match=r"gaps of 0.1 m forward and 0.2 m"):
        ss.PlanarSlider(ss.Coulomb(mu=0.1), stops=ss.Stops(gap=0.1, backward=0.2, restitution=0))
    with pytest.raises(ValueError, match="has its own spring"):
        ss.PlanarSlider(ss.Slider(ss.Coulomb(mu=0.1)), period=2)
    with pytest.raises(ValueError, match=r"needs both horizontal components; 'A'.*read_station"):
        ss.integrate(SLIDERS["coulomb"], ss.GroundMotion(noise(1), dt=0.01, name="A"))
    with pytest.raises(TypeError, match="must be a GroundMotion, got HarmonicMotion"):
        ss.integrate(SLIDERS["coulomb"], ss.HarmonicMotion(1, 2, duration=10))
    with pytest.raises(TypeError, match="law must be a friction law"):
        ss.PlanarSlider(3)
    others = (
        "an IsolatedStructure, an EquipmentOnFloor, a FlexibleSlope, a Cart, a SlenderBlock"
        " or a RockingBlock"
    )
    with pytest.raises(
        TypeError, match=rf"slider must be a Slider.*, a PlanarSlider, {others}, got 0\.3$"
    ):
        ss.integrate(0.3, station())
    with pytest.raises(TypeError, match=r"contact must be .*got 3"):
        ss.integrate(SLIDERS["coulomb"], station(), contact=3)
    with pytest.raises(TypeError, match="state must be a PlanarState, got <State"):
        ss.advance(SLIDERS["coulomb"], ss.State(), 0.1, (1, 0))


def test_sliders_compare_and_print():
    slider = ss.PlanarSlider(ss.Coulomb(mu=0.3), period=2, damping_ratio=0.05)
    same = ss.PlanarSlider(ss.Slider(ss.Coulomb(mu=0.3), period=2, damping_ratio=0.05))
    assert slider == same
    assert hash(slider) == hash(same)
    assert slider != same.along_axis
    assert slider.period == pytest.approx(2)
    assert slider.law == ss.Coulomb(mu=0.3)
    assert slider.hold() == slider.resist(0.5) == 0.3 * G
    assert repr(ss.PlanarSlider(ss.Coulomb(mu=0.3))) == "PlanarSlider(Coulomb(mu=0.3))"
    dish = ss.PlanarSlider(ss.FrictionPendulum(radius=2.2, mu=0.05))
    assert repr(dish) == "PlanarSlider(FrictionPendulum(radius=2.2, mu=0.05))"


def test_remarks():
    dish = ss.PlanarSlider(ss.FrictionPendulum(radius=0.3, mu=0.02))
    r = ss.integrate(dish, station(4))
    assert r.peak > 0.06
    assert "beyond 0.2 of the radius of 0.3 m" in r.remark
    quiet = ss.GroundMotion(noise(1) / G, dt=0.01, transverse=noise(2) / G)
    r = ss.integrate(ss.PlanarSlider(ss.Coulomb(mu=0.2)), quiet)
    assert 'if the accelerations are in g, give units="g"' in r.remark


def test_tables(tmp_path):
    r = ss.integrate(
        SLIDERS["coulomb"], station(3, orientation="N", vertical=0.3 * noise(33)), settle=True
    )
    pytest.importorskip("pandas")
    frame = r.to_dataframe()
    assert list(frame.columns)[:4] == [
        "ground_acceleration_axis",
        "ground_acceleration_transverse",
        "displacement_axis",
        "displacement_transverse",
    ]
    assert np.array_equal(frame.displacement_transverse, r.displacement[:, 1])
    assert np.array_equal(frame.force_axis, r.force[:, 0])
    assert frame.attrs["units"]["velocity_axis"] == "m/s"
    assert frame.ground_acceleration_transverse[5 * 0.01] == r.motion.transverse[5]
    assert "vertical_ground_acceleration" in frame
    document = json.loads(r.to_json())
    assert document["residual"] == r.residual.tolist()
    assert document["peak_azimuth"] == r.peak_azimuth
    assert document["events"][-1]["displacement"] == r.residual.tolist()
    assert document["displacement_axis"] == r.displacement[:, 0].tolist()
    head, *rows = r.to_csv(tmp_path / "r.csv").read_text().splitlines()
    assert head.startswith("time [s],ground_acceleration_axis [m/s^2],")
    assert len(rows) == len(r.time)
    html = r._repr_html_()
    assert "toward azimuth" in html
    assert "Response in the plane" in html


def test_the_map_has_the_axis_upward_and_the_transverse_direction_at_the_right():
    pytest.importorskip("matplotlib")
    # The ground moves south, then west: the slider is left behind to the north, then to the east.
    pulse = np.r_[np.zeros(5), -4 * np.ones(15), np.zeros(30)]
    for axis, north, east in (("0", (0, 1), (1, 0)), ("90", (-1, 0), (0, 1))):
        for toward, place in (("north", north), ("east", east)):
            azimuth = {"north": 0, "east": 90}[toward]
            turn = math.radians(azimuth - float(axis))
            quake = ss.GroundMotion(
                pulse * math.cos(turn), dt=0.01, transverse=pulse * math.sin(turn), orientation=axis
            )
            r = ss.integrate(ss.PlanarSlider(ss.Coulomb(mu=0.1)), quake, settle=True)
            assert math.cos(math.radians(r.peak_azimuth - azimuth)) == pytest.approx(1)
            figure = r.plot()
            plan = figure.axes[0]
            (path,) = (line for line in plan.lines if line.get_label() == "path")
            end = np.array([path.get_xdata()[-1], path.get_ydata()[-1]])
            assert end / np.hypot(*end) == pytest.approx(place, abs=1e-9)
            (letter,) = (text for text in plan.texts if text.get_text() == "N")
            from_center = np.array(letter.get_position()) - (34, -30)
            assert from_center / np.hypot(*from_center) == pytest.approx(north, abs=1e-9)
            assert plan.get_aspect() == 1


def test_plots_of_rest_and_stops(tmp_path):
    plotting = pytest.importorskip("stickslip.plotting")
    still = ss.integrate(ss.PlanarSlider(ss.Coulomb(mu=2.5)), station(1))
    assert any(text.get_text() == "never slips" for text in still.plot().axes[0].texts)
    r = ss.integrate(SLIDERS["stop"], station(1))
    figure = r.plot()
    assert "stop" in [line.get_label() for line in figure.axes[0].lines]
    assert r.plot(time=(0, 2)).axes[1].get_xlim() == (0, 2)
    plotting.save(figure, tmp_path / "r.png")


def test_the_command_slides_stations(capsys, tmp_path):
    from stickslip.cli import main

    quake = station(3, vertical=0.4 * noise(33))
    columns = (quake.time, *(c / G for c in (quake.acceleration, quake.transverse, quake.vertical)))
    rows = "".join(",".join(map(repr, row)) + "\n" for row in np.column_stack(columns).tolist())
    file = tmp_path / "station.csv"
    file.write_text("Time (s), NS (g), EW (g), UD (g)\n" + rows)
    motion = ss.read_station(file)
    options = ["slide", str(file), "--planar", "--mu", "0.1", "--stop-gap", "0.1"]
    options += ["--restitution", "0.5"]
    main([*options, "--json"])
    (row,) = json.loads(capsys.readouterr().out)["results"]
    slider = ss.PlanarSlider(ss.Coulomb(mu=0.1), stops=ss.Stops(gap=0.1, restitution=0.5))
    r = ss.integrate(slider, motion, settle=True)
    assert row["components"] == "axis + transverse + vertical"
    assert (row["peak_m"], row["peak_time_s"]) == (r.peak, r.peak_time)
    assert row["residual_m"] == math.hypot(*r.residual)
    assert [row["residual_axis_m"], row["residual_transverse_m"]] == r.residual.tolist()
    assert row["peak_azimuth_degrees"] == r.peak_azimuth
    assert (row["impacts"], row["impacts_forward"]) == (len(r.impacts), None)
    assert row["pga_g"] * G == pytest.approx(np.hypot(motion.acceleration, motion.transverse).max())

    table = [*options, "--csv", str(tmp_path / "t.csv")]
    main(table)
    lines = capsys.readouterr().out.splitlines()
    assert lines[0].endswith("azimuth of peak")
    assert f"{r.peak_azimuth:.0f}" in lines[1]
    head = (tmp_path / "t.csv").read_text().splitlines()[0]
    assert "peak_azimuth_degrees" in head

    for more, why in (
        (["--law", "caster", "--reach", "0.1"], "--planar goes with --law coulomb"),
        (["--both"], "--planar has no --polarity"),
        (["--vertical", str(file)], "--planar takes the vertical component from the station"),
    ):
        assert main([*options, *more]) == 2
        assert why in capsys.readouterr().err


@pytest.mark.filterwarnings("ignore:.* rate = :stickslip.PlausibilityWarning")
def test_an_overflow_names_what_may_have_caused_it():
    pair = ss.GroundMotion([0, 3, 0, 3, 0], dt=0.5, transverse=[0, 2, 0, 2, 0])
    with pytest.raises(OverflowError, match=r"velocity at the start \(1e\+200, 0\) m/s"):
        ss.integrate(ss.PlanarSlider(ss.Coulomb(mu=0.1)), pair, velocity=(1e200, 0))
    law = ss.VelocityDependent(mu_slow=0.1, mu_fast=0.2, rate=1e150)
    with pytest.raises(OverflowError, match=r"the slider is .*rate=1e\+150"):
        ss.integrate(ss.PlanarSlider(law), pair)
