"""Plots: they show the computed values."""

import io
import math
import os
import re
import sys
import xml.etree.ElementTree

import numpy as np
import pytest
import stickslip as ss

pytest.importorskip("matplotlib", reason="pictures need matplotlib: pip install stickslip[plot]")
from stickslip import plotting
from stickslip.plotting import words

G = ss.STANDARD_GRAVITY


def motion(seed=1, samples=400):
    """Ground that shakes and ends abruptly, so that the slider has something to settle."""
    noise = np.random.default_rng(seed).standard_normal(samples)
    shaking = np.convolve(noise, np.repeat([0.8, -0.8], 6), "same")
    shaking[0] = 0
    return ss.GroundMotion(shaking, dt=0.02, name="shaking ground")


SLIDERS = {
    "block": ss.Slider(ss.Coulomb(mu=0.1)),
    "spring": ss.Slider(ss.Coulomb(mu=0.05), natural_frequency=2.0),
    "one-way": ss.Slider(ss.Coulomb(mu=0.1, backward=math.inf)),
    "slope": ss.Slider(ss.Coulomb(mu=0.3), slope_degrees=10),
    "caster": ss.Slider(ss.Caster(mu=0.1, reach=0.5)),
    "heavy": ss.Slider(ss.Coulomb(slip_level=45.0)),
}


@pytest.fixture(params=SLIDERS)
def response(request):
    return ss.integrate(SLIDERS[request.param], motion(), settle=True)


def test_every_axis_of_a_response_has_a_unit(response):
    ground, speed, way = response.plot().axes
    assert ground.get_ylabel().endswith("[g]")
    assert speed.get_ylabel().endswith("m/s]")
    assert way.get_ylabel().endswith("m]")
    assert way.get_xlabel() == "time [s]"


NAMES = [
    r"$\bad{$",
    r"5 $ and 6 $",
    r"a \$ b$",
    "\x1b[31m\b\0",
    "$\\frac$",
]


@pytest.mark.parametrize("name", NAMES)
def test_a_name_is_drawn_as_it_stands(tmp_path, name):
    """A dollar begins no formula, and a control character, which no SVG may hold, is escaped."""
    ground = ss.GroundMotion([0.0, 5.0, 0.0], dt=0.1, name=name)
    r = ss.integrate(ss.Coulomb(mu=0.1), ground)
    figures = [r.plot(), plotting.plot_responses([r, r])]
    for figure in figures:
        title = figure.axes[0].get_title(loc="left")
        assert title == "".join(c if c.isprintable() else repr(c)[1:-1] for c in name)
    figures.append(plotting.plot_friction_sweep([0.1, 0.2], [[1, 0.5]], [name], [name]))
    for figure in figures:
        picture = plotting.save(figure, tmp_path / "name.svg")
        xml.etree.ElementTree.parse(picture)


def test_a_title_that_the_caller_gives_may_hold_a_formula():
    ground = ss.GroundMotion([0.0, 5.0, 0.0], dt=0.1)
    title = ss.integrate(ss.Coulomb(mu=0.1), ground).plot(title=r"$\mu = 0.1$").axes[0]._left_title
    assert title.get_parse_math()


def test_sticks_and_slides_make_up_the_whole_time(response):
    spans = plotting.sticks(response)
    assert (np.diff(spans) > 0).all()
    assert (spans[1:, 0] >= spans[:-1, 1]).all()
    stuck = np.diff(spans).sum()
    whole = response.events["time"][-1] - response.time[0]
    assert stuck + response.time_sliding == pytest.approx(whole, rel=1e-12)


def test_a_slider_that_moves_from_start_to_end_never_sticks():
    r = ss.integrate(ss.Coulomb(mu=0), ss.GroundMotion([1.0, 1.0], dt=1), velocity=0.1)
    assert plotting.sticks(r).shape == (0, 2)
    plotting.plot_response(r)


def test_the_shaded_bands_are_the_sticks(response):
    speed = response.plot().axes[1]
    (bands,) = (c for c in speed.collections if c.get_label() == "stuck")
    drawn = [(path.vertices[:, 0].min(), path.vertices[:, 0].max()) for path in bands.get_paths()]
    assert np.array(drawn) == pytest.approx(plotting.sticks(response), rel=1e-12)


def test_velocity_is_drawn_as_zero_within_the_bands(response):
    line = response.plot().axes[1].lines[0]
    t, v = line.get_data()
    for begin, end in plotting.sticks(response):
        assert not v[(t > begin) & (t < end)].any()


def test_the_drawn_displacement_reaches_the_peak_and_ends_at_the_residual(response):
    way = response.plot().axes[2]
    unit = {"[mm]": 1e3, "[cm]": 1e2, "[m]": 1}[way.get_ylabel().split("\n")[1]]
    t, x = way.lines[0].get_data()
    assert np.abs(x).max() == pytest.approx(response.peak * unit, rel=1e-12)
    assert x[-1] == pytest.approx(response.residual * unit, rel=1e-12)
    assert t[-1] == response.time[-1] >= response.events["time"][-1]


def test_the_tail_after_the_last_sample_is_exact_without_a_spring():
    still = ss.GroundMotion(np.zeros(2), dt=0.5)
    r = ss.integrate(ss.Coulomb(slip_level=0.5), still, velocity=1.0, settle=True)
    t, x = r.plot().axes[2].lines[0].get_data()
    assert t[-1] == pytest.approx(2)
    assert x == pytest.approx(100 * (t - t**2 / 4), abs=1e-11)
    assert r.plot().axes[1].lines[0].get_ydata() == pytest.approx(100 * (1 - t / 2), abs=1e-11)


def test_a_resting_slider_breaks_away_where_the_ground_leaves_the_band(response):
    ground = response.plot().axes[0]
    bounds = {line.get_label(): line.get_data() for line in ground.lines}
    events = response.events
    for event in events[events["kind"] == "breakaway"]:
        quake = response.motion
        n = np.interp(event["time"], quake.time, quake.acceleration) / G
        if event["time"] >= quake.time[-1]:
            continue  # the ground jumps to rest there
        gaps = [
            abs(n - np.interp(event["time"], *bounds[name]))
            for name in ("slip level forward", "slip level backward")
            if name in bounds
        ]
        assert min(gaps) < 1e-9


def test_an_infinite_level_is_not_drawn():
    r = ss.integrate(SLIDERS["one-way"], motion())
    drawn = [line.get_label() for line in r.plot().axes[0].lines]
    assert "slip level forward" in drawn
    assert "slip level backward" not in drawn


def lifted(interpolation="linear", slope=0.0, contact="flight"):
    """A response to ground that throws the slider up."""
    quake = motion()
    up = 2 * G * np.sin(25 * quake.time) * np.sin(math.pi * quake.time / quake.duration)
    both = ss.GroundMotion(quake.acceleration, quake.dt, vertical=up, interpolation=interpolation)
    slider = ss.Slider(ss.Coulomb(mu=0.4), slope_degrees=slope)
    return ss.integrate(slider, both, settle=True, contact=contact)


def test_flights_are_shaded_and_without_normal_force():
    r = lifted()
    spans = plotting.without_contact(r)
    kinds, times = r.events["kind"], r.events["time"]
    assert len(spans) > 5
    assert (spans == np.column_stack([times[kinds == k] for k in ("liftoff", "landing")])).all()
    *_, normal, gap = r.plot().axes
    assert (normal.get_ylabel(), gap.get_xlabel()) == ("normal force\n[g]", "time [s]")
    for axes in (normal, gap):
        (bands,) = (c for c in axes.collections if c.get_label() == "without contact")
        drawn = [(p.vertices[:, 0].min(), p.vertices[:, 0].max()) for p in bands.get_paths()]
        assert np.array(drawn) == pytest.approx(spans, rel=1e-12)
    t, force = normal.lines[0].get_data()
    inside = np.zeros(t.shape, bool)
    for begin, end in spans:
        inside |= (t >= begin) & (t < end)
    assert force[inside] == pytest.approx(0, abs=1e-12)
    assert (force[~inside] >= 0).all()
    at_samples = np.interp(r.time, t, force) * G
    assert at_samples == pytest.approx(r.normal_force, abs=1e-9)
    # The gap is that of the response, in the unit of its axis.
    unit = {"[mm]": 1e3, "[cm]": 1e2, "[m]": 1}[gap.get_ylabel().split("\n")[1]]
    assert gap.lines[0].get_ydata() / unit == pytest.approx(r.gap, rel=1e-12)


@pytest.mark.parametrize("slope", [0.0, 8.0])
def test_clipped_times_are_those_of_a_negative_normal_force(slope):
    r = lifted(slope=slope, contact="clipped")
    spans = plotting.without_contact(r)
    assert len(spans) > 5
    assert len(r.plot().axes) == 4
    angle = math.radians(slope)
    n, up = (getattr(r.motion, name) for name in ("acceleration", "vertical"))
    pressing = (G + up) * math.cos(angle) + n * math.sin(angle)
    time = r.motion.time
    inside = np.zeros(time.shape, bool)
    for begin, end in spans:
        inside |= (time > begin) & (time < end)
    assert (inside == (pressing < 0)).all()
    assert np.interp(spans.ravel(), time, pressing) == pytest.approx(0, abs=1e-9 * G)


def test_held_values_lift_for_whole_steps():
    r = lifted("constant", contact="clipped")
    spans = plotting.without_contact(r)
    lasted = np.diff(spans).sum()
    falls = (r.motion.vertical[:-1] < -G).sum()
    assert lasted == pytest.approx(falls * r.motion.dt, rel=1e-9)
    assert len(r.plot().axes) == 4


def test_without_vertical_motion_contact_is_never_lost(response):
    assert plotting.without_contact(response).shape == (0, 2)


def test_stops_are_drawn_where_they_came_near():
    for gap, drawn in ((0.01, 2), (2.9, 0)):
        slider = ss.Slider(ss.Coulomb(mu=0.1), stops=ss.Stops(gap=gap, restitution=0.3))
        way = ss.integrate(slider, motion()).plot().axes[2]
        lines = [line for line in way.lines if line.get_label() == "stop"]
        assert len(lines) == drawn
        unit = {"[mm]": 1e3, "[cm]": 1e2, "[m]": 1}[way.get_ylabel().split("\n")[1]]
        assert sorted(line.get_ydata()[0] for line in lines) == pytest.approx(
            [-gap * unit, gap * unit][:drawn]
        )


def test_thousands_of_events_are_one_artist():
    shaking = ss.GroundMotion(5 * np.resize([1.0, -1.0], 20_001), dt=0.01)
    r = ss.integrate(ss.Coulomb(mu=0.45), shaking)
    assert len(r.events) > 5000
    assert len(r.plot().axes[1].collections) == 1


def test_the_area_under_the_drawn_force_is_the_energy(response):
    """Of Coulomb friction the force is straight between events, and the trapezoidal rule exact."""
    (axes,) = response.plot_hysteresis().axes
    unit = {"[mm]": 1e3, "[cm]": 1e2, "[m]": 1}[axes.get_xlabel().split()[-1]]
    assert axes.get_ylabel().endswith("[g]")
    x, f = axes.lines[0].get_data()
    x, f = x / unit, f * G
    work = np.sum((f[1:] + f[:-1]) * np.diff(x)) / 2
    e = response.energy
    # of a caster the force bends: h^2 / 12 of its second derivative, level / reach^2, of the way;
    # on a slope the normal force changes with time, and the force over the way bends, too
    slider = response.slider
    straight = isinstance(slider.law, ss.Coulomb) and slider.slope_degrees == 0
    allowed = 1e-12 if straight else 1e-3
    assert work == pytest.approx(e.dissipated + e.elastic, rel=allowed, abs=1e-15)


def test_the_drawn_secant_is_the_effective_stiffness():
    r = ss.integrate(SLIDERS["spring"], motion(), settle=True)
    (axes,) = r.plot_hysteresis().axes
    x, f = axes.lines[-1].get_data()
    slope = (f[1] - f[0]) / (x[1] - x[0]) * G * {"[mm]": 1e3, "[cm]": 1e2}[axes.get_xlabel()[-4:]]
    assert 2 * math.pi / math.sqrt(slope) == pytest.approx(r.effective_period)
    (text,) = axes.get_legend().get_texts()
    assert f"{r.effective_period:.2f} s" in text.get_text()
    assert ss.integrate(SLIDERS["block"], motion()).plot_hysteresis().axes[0].get_legend() is None
    building = ss.Structure.from_modes(
        mass_fractions=[0.5], frequencies=[20.0], damping_ratios=[0.05]
    )
    r = ss.integrate(ss.IsolatedStructure(SLIDERS["spring"], building), motion())
    (text,) = r.plot_hysteresis().axes[0].get_legend().get_texts()
    assert f"{r.effective_period:.2f} s" in text.get_text()


def test_a_picture_of_one_panel_is_drawn_into_given_axes():
    from matplotlib.figure import Figure

    r = ss.integrate(SLIDERS["spring"], motion())
    figure = Figure()
    left, right = figure.subplots(1, 2)
    assert r.plot_hysteresis(ax=left) is left
    assert plotting.plot_friction_sweep([0.1, 0.2], [[1, 0.5]], ["a"], ax=right) is right
    assert len(left.lines) > 1 < len(right.lines)
    assert figure.axes == [left, right]
    assert plotting.plot_friction_sweep([0.1, 0.2], [[1, 0.5]], ["a"], figure=Figure()).axes
    with pytest.raises(ValueError, match="plot_hysteresis: give figure or ax, got both"):
        r.plot_hysteresis(ax=left, figure=figure)
    with pytest.raises(ValueError, match="plot_friction_sweep: give figure or ax, got both"):
        plotting.plot_friction_sweep([0.1, 0.2], [[1, 0.5]], ["a"], figure=figure, ax=left)


def test_a_notebook_shows_the_picture_without_pyplot(response):
    assert response.plot()._repr_png_().startswith(b"\x89PNG")


def test_responses_laid_over_each_other_are_named_with_their_numbers():
    responses = [ss.integrate(ss.Coulomb(mu=mu), motion(), settle=True) for mu in (0.05, 0.1)]
    figure = plotting.plot_responses(responses, ["slick", "rough"])
    assert [axes.get_ylabel().split("\n")[1] for axes in figure.axes] == ["[g]", "[cm]"]
    names = [text.get_text() for text in figure.axes[1].get_legend().get_texts()]
    assert names[0].startswith(f"slick: peak {responses[0].peak * 100:.3g} cm")


def test_responses_to_different_ground_motions_are_not_laid_over_each_other():
    responses = [ss.integrate(ss.Coulomb(mu=0.1), motion(seed)) for seed in (1, 2)]
    with pytest.raises(ValueError, match="same ground motion"):
        plotting.plot_responses(responses)
    with pytest.raises(ValueError, match="got none"):
        plotting.plot_responses([])
    with pytest.raises(ValueError, match="each of 1 responses, got 2"):
        plotting.plot_responses(responses[:1], ["one", "two"])


SHAKING = ss.PoissonPulses.event("moderate near field")
SQUARE = {"mm": 1e6, "cm": 1e4, "m": 1}


@pytest.fixture(scope="module")
def ensemble():
    return ss.run_ensemble(ss.Coulomb(mu=0.02), SHAKING, members=2000, seed=1)


def unit_of(axes):
    return re.search(r"\[\(?(mm|cm|m)[\]/\N{SUPERSCRIPT TWO}]", axes.get_ylabel())[1]


def test_an_ensemble_is_drawn_with_its_units_and_errors(ensemble):
    way, peaks, speed, spectrum = ensemble.plot().axes
    for axes, name in ((way, "displacement"), (speed, "velocity")):
        assert axes.get_xlabel() == "time [s]"
        factor = SQUARE[unit_of(axes)]
        t, variance = axes.lines[0].get_data()
        assert np.array_equal(t, ensemble.time)
        assert variance == pytest.approx(factor * getattr(ensemble, f"{name}_variance"))
        band = axes.collections[0].get_paths()[0].vertices[:, 1].max()
        error = getattr(ensemble, f"{name}_variance_error")
        assert band == pytest.approx((variance + 2 * factor * error).max())
    omega, density = spectrum.lines[0].get_data()
    assert np.array_equal(omega, ensemble.velocity_spectrum.omega)
    assert density == pytest.approx(SQUARE[unit_of(spectrum)] * ensemble.velocity_spectrum.density)
    assert peaks.get_xlabel() == "peak displacement [cm]"
    assert peaks.get_yscale() == "log"


def test_the_drawn_distribution_of_peaks_is_the_count(ensemble):
    peaks = ensemble.plot().axes[1]
    level, share = peaks.lines[0].get_data()
    assert share == pytest.approx([(100 * ensemble.peak > x).mean() for x in level])
    marked = [tuple(np.ravel(line.get_data())) for line in peaks.lines[1:]]
    for (x, y), p in zip(marked, (0.5, 0.9, 0.99), strict=True):
        assert x == pytest.approx(100 * ensemble.quantile(p).value)
        assert y == pytest.approx(1 - p)


def test_an_ensemble_says_what_slid(ensemble):
    told = ensemble.plot().get_suptitle()
    assert told == "2,000 members of 15 s, slip level 0.0200 g"
    slider = ss.Slider(ss.Coulomb(mu=0.02, backward=math.inf), natural_frequency=math.pi)
    e = ss.run_ensemble(slider, SHAKING, members=2, seed=1, velocity_spectrum=False)
    figure = e.plot()
    assert figure.get_suptitle().endswith("slip level 0.0200 g, never backward, period 2.00 s")
    assert len(figure.axes) == 3
    liner = ss.VelocityDependent(mu_slow=0.02, mu_fast=0.06, rate=50)
    e = ss.run_ensemble(liner, SHAKING, members=2, seed=1, velocity_spectrum=False)
    assert e.plot().get_suptitle().endswith("slip level 0.0200 g slow, 0.0600 g fast")
    told = ss.integrate(liner, SHAKING.sample(seed=1, member=0)).plot().axes[0].texts
    assert any("0.0200 g slow, 0.0600 g fast" in text.get_text() for text in told)


def test_an_ensemble_that_never_slips_is_drawn():
    e = ss.run_ensemble(ss.Coulomb(slip_level=45), SHAKING, members=10, seed=1)
    texts = [text.get_text() for text in e.plot().axes[1].texts]
    assert "none slips" in texts
    with pytest.raises(ValueError, match="two members"):
        ss.run_ensemble(ss.Coulomb(slip_level=45), SHAKING, members=1, seed=1).plot()


def test_a_friction_sweep_shows_every_record_and_their_median():
    mu, d = [0.1, 0.2, 0.4], np.array([[3.0, 2, 1], [0.3, 0.1, 0], [1, 0.5, 0]])
    (axes,) = plotting.plot_friction_sweep(mu, d, ["a", "b", "c"], highlight=["b"]).axes
    assert axes.get_xlabel().startswith("coefficient of friction [")
    assert axes.get_ylabel() == "peak relative displacement [cm]"
    assert len(axes.lines) == 4
    assert axes.lines[-1].get_ydata()[:2] == pytest.approx([100, 50])
    assert [t.get_text() for t in axes.get_legend().get_texts()] == ["b", "median of 3 records"]


def test_a_friction_sweep_refuses_shapes_that_do_not_fit():
    with pytest.raises(ValueError, match=r"shape \(1, 2\), got \(1, 3\)"):
        plotting.plot_friction_sweep([0.1, 0.2], [[1, 2, 3]], ["a"])


@pytest.mark.parametrize(
    "suffix, begins", [(".png", b"\x89PNG"), (".pdf", b"%PDF"), (".SVG", b"<?")]
)
def test_a_picture_is_saved_in_the_format_of_its_suffix(tmp_path, suffix, begins):
    file = tmp_path / f"a{suffix}"
    figure = ss.integrate(SLIDERS["block"], motion()).plot()
    assert plotting.save(figure, file) == file
    assert file.read_bytes().startswith(begins)
    assert list(tmp_path.iterdir()) == [file]


def test_a_picture_is_saved_whole_or_not_at_all(tmp_path, monkeypatch):
    figure = ss.integrate(SLIDERS["block"], motion()).plot()
    file = tmp_path / "a.png"
    file.write_bytes(b"what was there")

    def fill_the_disk(descriptor):
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(os, "fsync", fill_the_disk)
    with pytest.raises(OSError, match="No space left"):
        plotting.save(figure, file)
    assert file.read_bytes() == b"what was there"
    assert list(tmp_path.iterdir()) == [file]


def test_an_unknown_suffix_or_folder_is_named(tmp_path):
    figure = ss.integrate(SLIDERS["block"], motion()).plot()
    with pytest.raises(ValueError, match=r"\.png, \.pdf, \.svg, got 'a\.jpg'"):
        plotting.save(figure, "a.jpg")
    with pytest.raises(FileNotFoundError, match="nowhere"):
        plotting.save(figure, tmp_path / "nowhere" / "a.png")


def test_without_matplotlib_the_message_says_what_to_install(monkeypatch):
    r = ss.integrate(SLIDERS["block"], motion())
    monkeypatch.delitem(sys.modules, "stickslip.plotting")
    monkeypatch.setitem(sys.modules, "matplotlib", None)
    with pytest.raises(ImportError, match=r"pip install stickslip\[plot\]"):
        r.plot()


def test_pyplot_shows_the_picture_where_it_has_windows(response, monkeypatch):
    pyplot = pytest.importorskip("matplotlib.pyplot")
    assert pyplot.get_fignums() == []
    response.plot()  # without windows no figure is kept
    assert pyplot.get_fignums() == []
    monkeypatch.setattr("matplotlib.get_backend", lambda: "TkAgg")
    figure = response.plot()
    assert [pyplot.figure(number) for number in pyplot.get_fignums()] == [figure]
    assert response.plot(figure=figure.add_subfigure(figure.add_gridspec(1, 1)[0])) is not figure
    assert len(pyplot.get_fignums()) == 1
    pyplot.close(figure)


# ---- what fits, and what is marked


LONG = "GeoNet 2016-11-13 Kaikoura WTMC 20161113 110259 Te Mara Farm Waiau North Canterbury, N26E"


def outside(figure):
    """The titles, labels and annotations that do not lie within the figure."""
    figure.canvas.draw()
    page = figure.bbox
    found = []
    for axes in figure.axes:
        parts = [axes.title, axes._left_title, axes.xaxis.label, axes.yaxis.label, *axes.texts]
        found += [(part.get_text(), part.get_window_extent()) for part in parts if part.get_text()]
    return [
        text
        for text, box in found
        if not (page.x0 <= box.x0 <= box.x1 <= page.x1 and page.y0 <= box.y0 <= box.y1 <= page.y1)
    ]


@pytest.mark.parametrize(
    "name",
    [LONG, 3 * LONG, "/".join(20 * ["folder"]), pytest.param("W" * 200, marks=pytest.mark.slow)],
    ids=["long", "longer", "path", "wide"],
)
def test_names_of_any_length_lie_within_the_picture(name):
    quake = ss.GroundMotion(motion().acceleration, dt=0.02, name=name)
    slider = ss.Slider(ss.Coulomb(mu=0.05, backward=0.1), natural_frequency=2.0, damping=0.1)
    r = ss.integrate(slider, quake, settle=True)
    for figure in (
        r.plot(),
        plotting.plot_response(r, time=(1, 3)),
        r.plot_hysteresis(),
        quake.plot(),
        plotting.plot_responses([r]),
    ):
        assert not outside(figure)
        title = figure.axes[0].get_title(loc="left")
        assert "".join(title.split()) == "".join(name.split())


def test_a_part_of_a_response_is_drawn():
    r = ss.integrate(SLIDERS["block"], motion(), settle=True)
    figure = plotting.plot_response(r, time=(2, 5.5))
    ground, speed, way = figure.axes
    for axes in figure.axes:
        assert axes.get_xlim() == (2, 5.5)
    # Inside the part the lines are those of the whole; outside it nothing is drawn but an end.
    whole = plotting.plot_response(r).axes
    for part, complete in zip((ground, speed, way), whole):
        t, values = part.lines[0].get_data()
        scale = (
            1.0 if part is not way else values[3] / np.interp(t[3], *complete.lines[0].get_data())
        )
        assert (t[0], t[-1]) == pytest.approx((2, 5.5), abs=0.0401)
        assert np.interp(t[1:-1], *complete.lines[0].get_data()) * scale == pytest.approx(
            values[1:-1], abs=1e-9 * np.abs(values).max()
        )
    x, _ = plotting.plot_hysteresis(r, time=(2, 5.5)).axes[0].lines[0].get_data()
    assert 0 < len(x) < len(plotting.plot_hysteresis(r).axes[0].lines[0].get_xdata())
    for wrong in ((5, 2), (-1, 3), (100, 200), (math.nan, 3)):
        with pytest.raises(ValueError, match="begin and a later end within 0 to"):
            plotting.plot_response(r, time=wrong)
    for wrong in (3, (1, 2, 3), ("a", 2)):
        with pytest.raises(TypeError, match=r"a begin and an end \[s\], such as \(0, 25\), got"):
            plotting.plot_hysteresis(r, time=wrong)
    # A part that ends after the response ends with it.
    assert plotting.plot_response(r, time=(0, 1e3)).axes[2].get_xlim() == whole[2].get_xlim()


def texts(axes):
    return " ".join(text.get_text() for text in axes.texts)


def test_the_peak_and_the_residual_are_marked_where_they_are_in_the_part():
    r = ss.integrate(SLIDERS["block"], motion(), settle=True)
    events = r.events
    at = events["time"][np.abs(events["displacement"]).argmax()]
    end = max(r.time[-1], events["time"][-1])
    whole = texts(r.plot().axes[2])
    assert "peak" in whole and "residual" in whole
    before, after = (
        plotting.plot_response(r, time=w).axes[2] for w in ((0, at / 2), (at + 0.5, end))
    )
    assert "peak" not in texts(before) and "here at" in texts(before)
    assert "peak" not in texts(after) and "residual" in texts(after)


def test_a_residual_has_no_more_digits_than_the_peak_gives_it():
    assert words.in_places(1.7e-5, 0.289, 100) == "0.00"
    assert words.in_places(-1.7e-5, 0.289, 100) == "0.00"
    assert words.in_places(-0.0595, 0.182, 100) == "\N{MINUS SIGN}5.95"
    assert words.in_places(0.182, 0.182, 100) == "18.2"
    assert words.in_places(0.0, 0.0, 100) == words.digits(0.0)
    for peak in (0.0012, 0.034, 0.5, 7.0, 30.0):
        length, _ = words.unit_for(peak)
        for value in np.geomspace(1e-7, 1, 30) * peak:
            shown = float(words.in_places(value, peak, length)) / length
            assert shown == pytest.approx(value, rel=0.006, abs=6e-4 * peak)


def test_stops_have_a_name_and_lie_in_the_picture():
    slider = ss.Slider(
        ss.Coulomb(mu=0.1), stops=ss.Stops(gap=0.02, backward=0.021, restitution=0.3)
    )
    push = ss.GroundMotion([0.0, -4.0, -4.0, 0.0, 0.0], dt=0.2)  # toward one stop alone
    r = ss.integrate(slider, push, settle=True)
    assert r.residual > 0 and len(r.impacts)
    way = r.plot().axes[2]
    low, high = way.get_ylim()
    assert low < -2.1 and high > 2
    assert "stop 2.00 cm" in texts(way) and "stop \N{MINUS SIGN}2.10 cm" in texts(way)


def test_a_tiny_gap_has_no_panel_and_short_flights_are_counted():
    quake = motion()
    up = np.zeros(len(quake))
    up[200] = -1.02 * G  # for a moment the ground falls faster than the block
    both = ss.GroundMotion(quake.acceleration, quake.dt, vertical=up)
    r = ss.integrate(ss.Coulomb(mu=0.1), both, settle=True)
    assert "liftoff" in r.events["kind"] and r.gap.max() < 1e-4
    figure = r.plot()
    assert len(figure.axes) == 4
    assert "no contact\n1 time" in texts(figure.axes[3])
    assert len(ss.integrate(ss.Coulomb(mu=0.4), lifted().motion).plot().axes) == 5


def test_a_spectrum_has_a_title_and_an_axis_that_suits_its_periods():
    quake = motion()
    periods = np.geomspace(0.05, 5, 30)
    (axes,) = ss.response_spectrum(quake, periods).plot().axes
    assert axes.get_title(loc="left") == "Elastic response spectrum"
    assert axes.get_xscale() == "log"
    labels = [label.get_text() for label in axes.get_xticklabels()]
    assert labels[0] == "0.05" and labels[-1] == "5" and "1" in labels
    (axes,) = ss.response_spectrum(quake, periods[::-1]).plot().axes
    assert axes.get_xscale() == "log"
    for even in (np.linspace(0.1, 4, 40), [0.0, 0.1, 0.2, 0.4], [1.0], [1.0, 1.1, 1.21]):
        (axes,) = ss.response_spectrum(quake, even).plot().axes
        assert axes.get_xscale() == "linear"


def test_a_spectrum_says_what_carries_the_oscillators():
    quake = motion()
    pair = ss.GroundMotion(quake.acceleration, quake.dt, transverse=quake.acceleration, name="pair")
    block, building = (
        SLIDERS["spring"],
        ss.Structure.shear_building(masses=[1], stiffnesses=[400], damping_ratio=0.05),
    )
    isolated = ss.integrate(ss.IsolatedStructure(ss.Coulomb(mu=0.1), building, base_mass=1), quake)
    for spectrum, name in (
        (ss.response_spectrum(quake, 1.0), "shaking ground"),
        (ss.response_spectrum(quake, 1.0, direction=0), "shaking ground"),
        (ss.response_spectrum(ss.integrate(block, quake), 1.0), "sliding mass, shaking ground"),
        (
            ss.response_spectrum(ss.integrate(ss.PlanarSlider(block), pair), 1.0),
            "sliding mass, pair",
        ),
        (ss.response_spectrum(isolated, 1.0), "base, shaking ground"),
        (ss.response_spectrum(isolated, 1.0, floor=1), "floor 1, shaking ground"),
    ):
        assert spectrum.name == name
        (axes,) = spectrum.plot().axes
        assert name in [text.get_text() for text in axes.texts]


def test_pictures_fit_into_figures_of_pyplot():
    """Into the axes of plt.subplots; and what a function returns has savefig."""
    pyplot = pytest.importorskip("matplotlib.pyplot")
    r = ss.integrate(SLIDERS["spring"], motion())
    spectrum = ss.response_spectrum(motion(), [0.5, 1.0])
    figure, axes = pyplot.subplots(1, 3)
    try:
        drawn = [
            motion().plot(ax=axes[0]),
            r.plot_hysteresis(ax=axes[1]),
            spectrum.plot(ax=axes[2]),
        ]
        assert all(one is ax for one, ax in zip(drawn, axes))
        assert all(ax.lines for ax in axes)
    finally:
        pyplot.close(figure)
    for picture in (r.plot(), r.plot_hysteresis(), motion().plot(), spectrum.plot()):
        content = io.BytesIO()
        picture.savefig(content)
        assert content.getvalue().startswith(b"\x89PNG")


# ---- structures


BUILDING = ss.Structure.shear_building(
    masses=[1, 1, 1], stiffnesses=[900, 800, 700], damping_ratio=0.03
)


def test_the_plot_of_a_structure_names_it_and_has_its_base_stops_sticks_and_peak():
    bearing = ss.Slider(
        ss.Coulomb(mu=0.03),
        period=3,
        pendulum=True,
        stops=ss.Stops(gap=0.02, restitution=0.3),
    )
    r = ss.integrate(ss.IsolatedStructure(bearing, BUILDING, base_mass=1), motion(), settle=True)
    figure = r.plot()
    top, accelerations, drifts = figure.axes
    assert "isolated structure of 3 floors, slip level 0.0300 g, pendulum" in texts(top)
    assert "radius 2.24 m" in texts(top).replace("\n", " ")
    assert f"peak {100 * r.peak:.3g}" in texts(top) and "residual" in texts(top)
    stops = [line.get_ydata()[0] for line in top.lines if line.get_label() == "stop"]
    assert sorted(stops) == pytest.approx([-2, 2])
    (bands,) = (c for c in top.collections if c.get_label() == "stuck")
    assert len(bands.get_paths()) == len(plotting.sticks(r)) > 1
    peaks, floor = accelerations.lines[0].get_data()
    assert list(floor) == [0, 1, 2, 3]
    expected = [r.peak_base_acceleration, *r.floors.peak_acceleration]
    assert peaks * G == pytest.approx(expected, rel=1e-14)
    assert accelerations.get_xlabel().endswith("[g]")
    assert accelerations.get_yticklabels()[0].get_text() == "base"
    assert drifts.get_xlabel().endswith("[mm]")
    assert drifts.lines[0].get_xdata() == pytest.approx(1e3 * r.floors.peak_drift, rel=1e-14)
    for panel in (accelerations, drifts):
        x, y = panel.lines[0].get_data()
        assert panel.get_xlim()[1] > x.max()
        assert panel.get_ylim()[0] < y.min() and y.max() < panel.get_ylim()[1]
        assert not panel.lines[0].get_clip_on()
    assert not outside(figure)


def test_equipment_stands_on_its_floor_and_a_slope_has_none():
    r = ss.integrate(ss.EquipmentOnFloor(ss.Coulomb(mu=0.05), BUILDING, floor=2), motion())
    top, accelerations, _ = r.plot().axes
    assert "equipment on floor 2 of 3, slip level 0.0500 g" in texts(top)
    (mark,) = accelerations.texts
    x, y = mark.xy
    assert (mark.get_text(), y) == ("equipment", 2)
    assert x * G == pytest.approx(r.floors.peak_acceleration[1])
    assert accelerations.get_yticklabels()[0].get_text() == "ground"
    assert accelerations.lines[0].get_xdata()[0] * G == pytest.approx(motion().peak_acceleration)
    slope = ss.FlexibleSlope(ky_g=0.05, height=20, shear_velocity=200, damping_ratio=0.05)
    (top,) = slope.coupled(motion()).plot().axes
    assert "flexible slope, yield acceleration 0.0500 g, height 20.0 m" in texts(top)
    assert "coupled" in texts(top)
    weaker = ss.Degrading(distance=[0, 1], mu=[0.05, 0.03])
    softens = ss.FlexibleSlope(ky_g=weaker, height=20, shear_velocity=200, damping_ratio=0.05)
    assert "yield acceleration 0.0500 g" in texts(softens.coupled(motion()).plot().axes[0])
    assert "flexible slope" in texts(slope.decoupled(motion()).plot_hysteresis().axes[0])


def test_the_lowest_floor_is_named_as_what_it_is():
    slope = ss.FlexibleSlope(ky_g=0.05, height=20, shear_velocity=200, damping_ratio=0.05)
    mu = ss.Coulomb(mu=0.05)
    for system, names in (
        (ss.IsolatedStructure(mu, BUILDING, base_mass=1), ["base", "1", "2", "3"]),
        (ss.EquipmentOnFloor(mu, BUILDING, floor=2), ["ground", "1", "2", "3"]),
        (slope, ["base", "top"]),
    ):
        responses = [ss.integrate(system, motion(k)) for k in (1, 2)]
        ensemble = ss.run_ensemble(system, SHAKING, members=2, seed=1)
        for figure in (plotting.plot_floors(responses), ensemble.plot_floors()):
            accelerations, drifts = figure.axes
            labels = [label.get_text() for label in accelerations.get_yticklabels()]
            assert labels == names
            assert [label.get_text() for label in drifts.get_yticklabels()] == names[1:]


def test_the_remark_of_a_response_is_over_its_plot():
    small = ss.FrictionPendulum(radius=0.05, mu=0.03)
    pair = ss.GroundMotion(motion().acceleration, 0.02, transverse=motion(2).acceleration)
    for system, quake in (
        (ss.IsolatedStructure(small, BUILDING, base_mass=1), motion()),
        (small, motion()),
        (ss.PlanarSlider(small), pair),
    ):
        r = ss.integrate(system, quake)
        assert "beyond 0.2 of the radius" in r.remark
        figure = r.plot()
        assert f"remark: {r.remark}" in texts(figure.axes[0]).replace("\n", " ")
        assert not outside(figure)


def test_the_text_of_the_peak_is_not_on_a_stop():
    slider = ss.Slider(ss.Coulomb(mu=0.05), stops=ss.Stops(gap=0.021, restitution=0.0))
    figure = ss.integrate(slider, motion(), settle=True).plot()
    way = figure.axes[2]
    figure.canvas.draw()
    (peak,) = (text for text in way.texts if text.get_text().startswith("peak"))
    boxes = [text.get_window_extent() for text in way.texts if text.get_text().startswith("stop")]
    box = peak.get_window_extent()
    stops = [line for line in way.lines if line.get_label() == "stop"]
    assert len(stops) == len(boxes) == 2
    for line in stops:
        (_, y), *_ = line.get_transform().transform(line.get_xydata())
        assert not box.y0 < y < box.y1
    assert not any(box.overlaps(other) for other in boxes)


def test_a_description_breaks_between_its_items():
    text = "slip level 0.0500 g, stops at 10.0 cm, restitution 0.300"
    for room in range(120, 320, 10):
        lines = plotting.styles.wrap_items(text, room, 8).splitlines()
        assert " ".join(lines) == text
        assert all(line.endswith(",") for line in lines[:-1])
    assert plotting.styles.wrap_items(text, 40, 8).count("\n") > 4


def test_the_ends_of_a_log_axis_have_labels_and_lines_end_where_nothing_slips():
    levels = np.geomspace(0.03, 0.4, 12)
    quakes = [motion(k).scaled(0.1 + 0.3 * k) for k in range(4)]
    table = ss.sweep([ss.Coulomb(mu=m) for m in levels], quakes)
    (axes,) = table.plot().axes
    labels = [label.get_text() for label in axes.get_xticklabels()]
    assert (labels[0], labels[-1]) == ("0.03", "0.4")
    still = table.peak.reshape(12, -1) == 0
    assert still.any()
    thin = np.column_stack([line.get_ydata() for line in axes.lines[: still.shape[1]]])
    assert (np.isnan(thin) == still).all()
    (axes,) = plotting.plot_friction_sweep([0.1, 0.3], [[1, 0], [2, 1]], ["a", "b"]).axes
    assert axes.yaxis.get_transform()._clip is False
    labels = [label.get_text() for label in axes.get_xticklabels()]
    assert (labels[0], labels[-1]) == ("0.1", "0.3")
