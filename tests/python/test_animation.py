"""Pictures that move: frames, files, messages."""

import numpy as np
import pytest
import stickslip as ss

pytest.importorskip("matplotlib", reason="pictures need matplotlib")
image = pytest.importorskip("PIL.Image")

T = np.arange(0, 2, 0.02)
QUAKE = ss.GroundMotion(3 * np.sin(6 * T), dt=0.02, name="pulse")
PAIR = ss.GroundMotion(3 * np.sin(6 * T), dt=0.02, transverse=2 * np.cos(4 * T))
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
    ground = []
    for i in (0, 4, 10):
        animation._func(i)
        t = 0.5 + 0.1 * i
        (dot,) = [line for line in way.lines if line.get_marker() == "o"]
        assert dot.get_xdata()[0] == pytest.approx(t)
        x = r.at(t).displacement
        assert dot.get_ydata()[0] == pytest.approx(100 * x, abs=1e-9)
        floor, body = scene.patches[:2]
        middle = body.get_x() + body.get_width() / 2
        ground.append(middle - x - floor.get_x())  # the same at all times: x is relative to it
    assert ground == pytest.approx([ground[0]] * 3, abs=1e-9)


def test_in_the_plane_the_object_is_on_its_path():
    r = ss.integrate(ss.PlanarSlider(ss.Coulomb(mu=0.1)), PAIR)
    animation = r.animate(fps=5)
    animation._func(5)
    (plan,) = animation._fig.axes
    (dot,) = [line for line in plan.lines if line.get_marker() == "s"]
    last = max(r.time[-1], r.events["time"][-1])
    along, across = 100 * r.at(5 * last / round(5 * last)).displacement
    assert dot.get_xdata()[0] == pytest.approx(across, abs=1e-9)
    assert dot.get_ydata()[0] == pytest.approx(along, abs=1e-9)


def test_files_have_all_frames(tmp_path):
    r = ss.integrate(SLIDERS["block"], QUAKE)
    animation = r.animate(time=(0, 1), fps=5)
    file = animation.write(tmp_path / "a.gif")
    with image.open(file) as picture:
        assert picture.n_frames == 6
    page = animation.write(tmp_path / "a.html")
    assert "<script" in page.read_text()
    assert "<script" in animation._repr_html_()
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


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ({"speed": 0}, "speed must be positive"),
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
    assert "<img" in (tmp_path / "a.html").read_text()

    def full(*args, **options):
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(type(film), "_film", full)
    with pytest.raises(OSError, match="No space"):
        film.save(tmp_path / "b.gif")
    assert [file.name for file in tmp_path.iterdir()] == ["a.html"]
