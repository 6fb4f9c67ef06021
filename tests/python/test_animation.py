"""Pictures that move: frames, files, messages."""

import json
import re
import shutil
import subprocess
import xml.etree.ElementTree

import numpy as np
import pytest
import stickslip as ss

pytest.importorskip("matplotlib", reason="pictures need matplotlib")
from matplotlib.patches import Circle, Polygon
from stickslip.plotting.planar import path_of

image = pytest.importorskip("PIL.Image")

T = np.arange(0, 2, 0.02)
QUAKE = ss.GroundMotion(3 * np.sin(6 * T), dt=0.02, name="pulse")
PAIR = ss.GroundMotion(3 * np.sin(6 * T), dt=0.02, transverse=2 * np.cos(4 * T), orientation="30")
SLIDERS = {
    "block": ss.Slider(ss.Coulomb(mu=0.1)),
    "cart": ss.Slider(ss.Caster(mu=0.1, reach=0.1), stops=ss.Stops(gap=0.2, restitution=0.3)),
    "floor": ss.FrictionPendulum(radius=2, mu=0.05),
    "triple": ss.TriplePendulum([0.4, 2, 2], [0.02, 0.04, 0.08]),
}


@pytest.mark.parametrize("name", SLIDERS)
def test_the_object_is_where_the_response_is(name):
    r = ss.integrate(SLIDERS[name], QUAKE)
    animation = r.animate(time=(0.5, 1.5), fps=10)
    scene, way = animation._fig.axes
    floor, body = (next(p for p in scene.patches if p.get_zorder() == z) for z in (2, 4))

    def middle(patch):
        box = scene.transData.inverted().transform_bbox(patch.get_window_extent())
        return (box.x0 + box.x1) / 2

    ground = []
    for i in (0, 4, 10):
        animation._func(i)
        t = 0.5 + 0.1 * i
        (dot,) = [line for line in way.lines if line.get_marker() == "o"]
        assert dot.get_xdata()[0] == pytest.approx(t)
        x = r.at(t).displacement
        assert dot.get_ydata()[0] == pytest.approx(100 * x, abs=1e-9)
        assert middle(body) - middle(floor) == pytest.approx(x, abs=1e-9)
        ground.append(middle(floor))
    assert np.ptp(ground) > 0.01


BUILDING = ss.Structure.shear_building(
    masses=[2e5, 2e5, 1.6e5], stiffnesses=[2.4e8, 2e8, 1.6e8], damping_ratio=0.03
)
STOPS = ss.Stops(gap=0.03, restitution=0.3)
STRUCTURES = {
    "isolated": ss.IsolatedStructure(
        ss.Slider(ss.Coulomb(mu=0.05), stops=STOPS), BUILDING, base_mass=2e5
    ),
    "equipment": ss.EquipmentOnFloor(ss.Coulomb(mu=0.1), BUILDING, floor=2),
    "base alone": ss.IsolatedStructure(
        ss.Coulomb(mu=0.05),
        ss.Structure.from_modes(mass_fractions=[0.7], frequencies=[8.0], damping_ratios=[0.05]),
    ),
}


@pytest.mark.parametrize("name", STRUCTURES)
def test_floors_and_what_slides_are_where_the_response_is(name, tmp_path):
    r = ss.integrate(STRUCTURES[name], QUAKE)
    animation = r.animate(fps=10, size=(5, 4))
    assert animation._fig.get_size_inches() == pytest.approx((5, 4))
    scene = animation._fig.axes[0]
    floors = [p for p in scene.patches if p.get_zorder() == 3 and p.get_label() != "stop"]
    (body,) = (p for p in scene.patches if p.get_zorder() == 4)
    mark = scene.patches[1]
    assert len(floors) == (0 if name == "base alone" else 3)

    def middle(patch):
        box = scene.transData.inverted().transform_bbox(patch.get_window_extent())
        return (box.x0 + box.x1) / 2

    for i in (0, 7, 15):
        animation._func(i)
        t = animation._film.times[i]
        x = np.interp(t, r.time, r.displacement)
        base = 0 if name == "equipment" else x
        u = [np.interp(t, r.time, one) for one in r.floors.displacement.T] if floors else []
        for floor, moved in zip(floors, u):
            assert middle(floor) - middle(mark) == pytest.approx(base + moved, abs=1e-9)
        on = u[1] if name == "equipment" else 0
        assert middle(body) - middle(mark) == pytest.approx(on + x, abs=1e-9)
    assert ("stop" in [p.get_label() for p in scene.patches]) == (name == "isolated")
    page = animation.write(tmp_path / "a.html").read_text()
    assert "<svg" in page and len(page) < 400_000


def test_a_slope_has_no_floors_to_show():
    slope = ss.FlexibleSlope(ky_g=0.1, height=50, shear_velocity=600, damping_ratio=0.15)
    with pytest.raises(ValueError, match="got a flexible slope"):
        ss.integrate(slope, QUAKE).animate()


def test_a_movie_shows_the_progress_of_its_frames(tmp_path, capsys):
    film = ss.integrate(SLIDERS["block"], QUAKE).animate(time=(0, 1), fps=5)
    told = []
    film.write(tmp_path / "a.gif", progress=lambda done, total: told.append((done, total)))
    assert told == [(i, 6) for i in range(1, 7)]
    film.write(tmp_path / "a.gif", progress=True)
    assert "6/6" in capsys.readouterr().err
    film.write(tmp_path / "a.gif")
    assert capsys.readouterr().err == ""


def test_a_bearing_is_a_dish_with_a_puck_in_it():
    """A puck stays within its dish; what a spring that is no pendulum draws back slides flat."""
    flat = ss.Slider(ss.Coulomb(mu=0.05), period=2)
    for slider, dishes in ((SLIDERS["floor"], 2), (SLIDERS["triple"], 4), (flat, 2)):
        r = ss.integrate(slider, QUAKE, settle=True)
        animation = r.animate(fps=20)
        scene = animation._fig.axes[0]
        parts = [patch for patch in scene.patches if isinstance(patch, Polygon)]
        assert len(parts) == dishes + 2
        assert not any(isinstance(patch, Circle) for patch in scene.patches)  # no wheels
        dish, puck = parts[0], parts[dishes // 2]
        if dishes == 2:
            assert np.ptp(dish.get_xy()[:41, 1]) > 0 or slider is flat
        for i in range(0, 40, 3):
            animation._func(i)
            outer, inner = (part.get_window_extent() for part in (dish, puck))
            assert outer.x0 < inner.x0 < inner.x1 < outer.x1
            assert inner.y0 > outer.y0


def test_the_curve_of_a_part_has_its_scale_and_all_labels_lie_in_the_picture():
    slider = ss.Slider(ss.Coulomb(mu=0.1), stops=ss.Stops(gap=0.02, restitution=0.3))
    r = ss.integrate(slider, QUAKE)
    figure = r.animate(time=(0, 0.3), fps=10)._fig
    scene, way = figure.axes
    assert [patch.get_label() for patch in scene.patches].count("stop") == 2
    x = np.abs(r.at(np.linspace(0, 0.3, 100))["displacement"]).max()
    factor = {"[mm]": 1e3, "[cm]": 1e2}[way.get_ylabel().split("\n")[1]]
    assert x * factor < max(np.abs(way.get_ylim())) < 1.5 * x * factor
    for animation in (r.animate(fps=5), r.animate(time=(0, 1)), r.animate(time=(0, 0.3), fps=10)):
        page = animation._fig.bbox
        for label in (way.yaxis.label, way.xaxis.label):
            box = label.get_window_extent()
            assert page.x0 <= box.x0 and page.y0 <= box.y0


def test_in_the_plane_the_object_is_on_its_path():
    slider = ss.Slider(ss.Coulomb(mu=0.1), stops=ss.Stops(gap=0.05, restitution=0.3))
    r = ss.integrate(ss.PlanarSlider(slider), PAIR)
    animation = r.animate(fps=5)
    animation._func(5)
    (plan,) = animation._fig.axes
    assert "N" in [text.get_text() for text in plan.texts]
    lines = {line.get_label(): line for line in plan.lines}
    assert np.hypot(*lines["stop"].get_data()) == pytest.approx(5, rel=1e-12)
    (dot,) = [line for line in plan.lines if line.get_marker() == "o"]
    last = max(r.time[-1], r.events["time"][-1])
    along, across = 100 * r.at(5 * last / round(5 * last)).displacement
    assert dot.get_xdata()[0] == pytest.approx(across, abs=1e-9)
    assert dot.get_ydata()[0] == pytest.approx(along, abs=1e-9)


def test_a_path_in_the_plane_is_the_exact_motion_between_samples():
    slider = ss.Slider(ss.Coulomb(mu=0.1), stops=ss.Stops(gap=0.05, restitution=0.3))
    r = ss.integrate(ss.PlanarSlider(slider), PAIR, settle=True)
    exact_at = np.linspace(0, r.time[-1], 3001)
    exact = r.at(np.minimum(exact_at, r.events["time"][-1]))["displacement"]
    t, place = path_of(r)

    def error(t, place):
        drawn = np.column_stack([np.interp(exact_at, t, place[:, k]) for k in (0, 1)])
        return np.hypot(*(drawn - exact).T).max()

    # Chords are off by h^2 / 8 times the acceleration, and 32 parts make h^2 1024 times smaller.
    samples = error(r.time, r.displacement)
    assert error(t, place) < samples / 100
    figure = r.plot()
    (path,) = (line for line in figure.axes[0].lines if line.get_label() == "path")
    assert np.column_stack(path.get_data()) == pytest.approx(100 * place[:, ::-1], abs=1e-12)
    film = r.animate(fps=5, time=(0.5, 1.5))
    (path,) = (line for line in film._fig.axes[0].lines if line.get_label() == "path")
    first = np.column_stack(path.get_data())[0, ::-1] / 100
    assert first == pytest.approx(r.at(0.5).displacement, abs=1e-3)
    assert len(path.get_xdata()) > 1000


def test_files_have_all_frames(tmp_path):
    r = ss.integrate(SLIDERS["block"], QUAKE)
    animation = r.animate(time=(0, 1), fps=5)
    file = animation.write(tmp_path / "a.gif")
    with image.open(file) as picture:
        assert picture.n_frames == 6
    page = animation.write(tmp_path / "a.html")
    assert "<script" in page.read_text()
    assert "&lt;script" in animation._repr_html_()
    assert sorted(p.name for p in tmp_path.iterdir()) == ["a.gif", "a.html"]


def test_the_command_writes_an_animation(capsys, tmp_path):
    from stickslip.cli import main

    quake = tmp_path / "q.csv"
    quake.write_text("\n".join(f"{t:.2f}, {3 * np.sin(6 * t):.9g}" for t in T[:40]))
    gif = tmp_path / "q.gif"
    options = ["slide", str(quake), "--units", "m/s^2", "--animate", str(gif)]
    assert main([*options, "--mu", "0.1"]) == 0
    assert f"wrote {gif}" in capsys.readouterr().out
    with image.open(gif) as picture:
        assert picture.n_frames > 5
    assert main([*options, "--mu", "0.1", "0.2"]) == 2
    assert "one response" in capsys.readouterr().err
    assert main([*options[:-1], str(tmp_path / "q.avi"), "--mu", "0.1"]) == 2
    assert "must end in .gif, .mp4, .html" in capsys.readouterr().err


@pytest.mark.parametrize("name", [*SLIDERS, "plane"])
def test_a_page_is_one_drawing_with_the_places_of_its_parts(tmp_path, name):
    planar = ss.PlanarSlider(ss.Coulomb(mu=0.1))
    r = ss.integrate(planar, PAIR) if name == "plane" else ss.integrate(SLIDERS[name], QUAKE)
    animation = r.animate(fps=10)
    page = animation.write(tmp_path / "a.html").read_text()
    assert len(page) < 400_000 and "<image" not in page
    film = json.loads(re.search(r"const film = (.*);", page)[1])
    drawing = xml.etree.ElementTree.fromstring(re.search(r"<svg.*</svg>", page, re.DOTALL)[0])
    parts = {part.get("id"): part for part in drawing.iter() if part.get("id")}
    assert parts["trail"].find(".//{*}path") is not None
    frames = len(film["time"])
    assert film["time"][-1] == pytest.approx(r.events["time"][-1], abs=1e-4)
    for part, x, y in film["moves"]:
        assert part in parts and len(x) == len(y) == frames
    for part, colors in film["fills"]:
        assert parts[part].find(".//{*}path") is not None and len(colors) == frames
    assert film["shown"][-1] == len(film["trail"])
    # Where matplotlib draws the dot, the page does.
    axes, dot = animation._film.axes, animation._film.dot
    x, y = film["moves"][-1][1:]
    places = []
    for i in (0, frames // 2, frames - 1):
        animation._func(i)
        places.append(axes.transData.transform(np.column_stack(dot.get_data()))[0])
        last = film["trail"][film["shown"][i] - 1]
        on_page = np.array(places[-1]) * 0.72
        on_page[1] = animation._fig.bbox.height * 0.72 - on_page[1]
        assert last == pytest.approx(on_page, abs=0.06)
    moved = 0.72 * (np.array(places) - places[-1])
    for k, i in enumerate((0, frames // 2, frames - 1)):
        assert (x[i], -y[i]) == pytest.approx(moved[k], abs=0.02)


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ({"speed": 0}, "speed must be positive"),
        ({"size": (6, 0)}, "size must be a width and a height"),
        ({"size": 6}, "size must be a width and a height"),
        ({"fps": 100}, "fps must be from 1 to 60"),
        ({"speed": 1e-3, "fps": 60}, "frames are more than 2000"),
        ({"time": (3, 1)}, "time must be a begin and a later end"),
    ],
)
def test_messages(options, message):
    r = ss.integrate(SLIDERS["block"], QUAKE)
    with pytest.raises(ValueError, match=message):
        r.animate(**options)


def test_save_writes_whole_files_and_pages(tmp_path, monkeypatch):
    r = ss.integrate(ss.Coulomb(mu=0.1), ss.GroundMotion([0, 3, -3, 0, 2, 0], dt=0.2))
    film = r.animate(fps=5)
    film.save(tmp_path / "a.html")
    assert "<svg" in (tmp_path / "a.html").read_text()

    def full(*args, **options):
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(type(film), "_movie", full)
    with pytest.raises(OSError, match="No space"):
        film.save(tmp_path / "b.gif")
    assert [file.name for file in tmp_path.iterdir()] == ["a.html"]


# A clock that the test moves, in place of the browser's.
CLOCK = """<script>
let now = 0;
const waiting = [];
performance.now = () => now;
window.requestAnimationFrame = (draw) => waiting.push(draw);
</script>"""
WATCH = """<script>
const seen = [];
function wait(frames) {
  for (let i = 0; i < frames; ++i) {
    now += 1000 / film.fps;
    for (const draw of waiting.splice(0)) draw(now + 1);
    seen.push(clock.textContent);
  }
}
wait(9);
button.click(); wait(2);
slider.value = 4; slider.dispatchEvent(new Event("input")); wait(1);
button.click(); wait(4);
document.body.innerHTML = `<output>${seen.join(" ")}</output>`;
</script>"""


@pytest.mark.slow
def test_a_page_plays_again_and_again(tmp_path):
    browser = shutil.which("chromium")
    if browser is None:
        pytest.skip("needs chromium")
    film = ss.integrate(SLIDERS["block"], QUAKE).animate(time=(0, 1), fps=5)
    file = film.write(tmp_path / "a.html")
    page = file.read_text()
    file.write_text(page.replace("<script>", CLOCK + "<script>").replace("</html>", WATCH))
    command = [browser, "--headless", "--no-sandbox", "--disable-gpu", "--dump-dom", file.as_uri()]
    shown = subprocess.run(command, capture_output=True, text=True, check=True).stdout
    seen = re.search("<output>(.*)</output>", shown)[1].replace(" s", "").split()
    played = ["0.20", "0.40", "0.60", "0.80", "1.00", "1.00", "0.20", "0.40", "0.60"]
    paused, moved, again = ["0.60"] * 2, ["0.80"], ["1.00", "1.00", "0.20", "0.40"]
    assert seen == played + paused + moved + again
