"""Sliders as JSON files, and the commands that read them."""

import json
import math

import pytest
import stickslip as ss
from stickslip.cli import main

BEARING = ss.TriplePendulum([0.3, 3, 3], [0.01, 0.04, 0.08], [0.07, 0.5, math.inf])
SLIDERS = [
    ss.Slider(
        ss.Stribeck(mu_static=0.2, mu_kinetic=0.1, velocity=0.1, exponent=2),
        period=2,
        damping_ratio=0.05,
    ),
    ss.FrictionPendulum(period=3, mu=0.05),
    ss.FrictionPendulum(radius=2, mu_slow=0.03, mu_fast=0.06, rate=20),
    ss.Slider(
        ss.StaticKinetic(ss.Coulomb(mu=0.1), mu_static=0.2),
        slope_degrees=5,
        stops=ss.Stops(gap=0.1, restitution=0.5),
    ),
    ss.Slider(BEARING),
    ss.Slider(ss.DoublePendulum([2, 2], [0.05, 0.06])),
    ss.Slider(ss.Coulomb(slip_level=1, backward=math.inf)),
    ss.Slider(ss.Coulomb(mu=0.1), one_way=True, damping=0.2),
    ss.Slider(ss.Caster(mu=0.1, reach=0.1, rolling=0.01)),
    ss.Slider(ss.VelocityDependent(mu_slow=0.1, mu_fast=0.2, rate=20)),
    ss.Slider(ss.Degrading(distance=[0.1, 0.2], mu=[0.2, 0.1])),
    ss.Slider(
        ss.KumarFriction(
            mu_ref=0.06, static_pressure=2e7, reference_pressure=2e7, contact_radius=0.2
        )
    ),
    ss.Slider.in_cup(ss.Coulomb(mu=0.1), cup_radius=2),
    ss.ViscousSlider(0.3, 2.0),
]


@pytest.mark.parametrize("slider", SLIDERS, ids=repr)
def test_a_slider_comes_back_from_its_file(slider, tmp_path):
    file = tmp_path / "slider.json"
    file.write_text(slider.to_json())
    assert ss.Slider.from_json(file) == ss.Slider.from_json(slider.to_json()) == slider


def test_every_law_of_numbers_has_a_file():
    laws = {type(one.law).__name__ for one in SLIDERS}
    assert laws == {law.__name__ for law in ss.FrictionLaw.__subclasses__()} - {"Law"}


def test_a_law_alone_is_a_slider_on_level_ground():
    assert ss.Slider.from_json('{"kind": "Coulomb", "mu": 0.2}') == ss.Slider(ss.Coulomb(mu=0.2))


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("{", "not JSON"),
        ("{}", "kind must be Slider, .*, got None"),
        ('{"kind": "Slider"}', "needs law"),
        ('{"kind": "Slider", "law": {"kind": "Coulomb", "mu": -1}}', "law: Coulomb: mu must be"),
        ('{"kind": "Slider", "law": {"kind": "Rust"}}', "law: kind must be .*, got 'Rust'"),
        ('{"kind": "Stops", "gap": 1, "restitution": 0}', "or a law, got 'Stops'"),
    ],
)
def test_bad_files_say_what_is_wrong(text, message):
    with pytest.raises(ValueError, match=f"Slider.from_json: .*{message}"):
        ss.Slider.from_json(text)


def test_a_law_from_functions_has_no_file():
    slider = ss.Slider(ss.Law(resist=lambda displacement: 1.0))
    with pytest.raises(ValueError, match="a law from functions has no description"):
        slider.to_json()


def run(arguments, capsys):
    assert main([str(one) for one in arguments]) == 0
    return capsys.readouterr().out


def test_the_commands_slide_what_files_describe(pyslammer_files, capsys, tmp_path):
    bearing, other = ss.Slider(BEARING), SLIDERS[0]
    for name, slider in (("bearing", bearing), ("stribeck", other)):
        (tmp_path / f"{name}.json").write_text(slider.to_json())
    files = ["--slider", tmp_path / "bearing.json", tmp_path / "stribeck.json", "--json"]
    kobe = ss.sample_record("Kobe")
    found = json.loads(run(["slide", "sample:Kobe", *files], capsys))["results"]
    for row, slider, name in zip(found, (bearing, other), ("bearing", "stribeck"), strict=True):
        assert row["slider"] == name
        assert row["law"] == type(slider.law).__name__
        assert row["peak_m"] == ss.integrate(slider, kobe, settle=True).peak
    swept = json.loads(run(["sweep", "sample:Kobe", *files], capsys))["results"]
    assert [row["slider"] for row in swept] == ["bearing", "bearing", "stribeck", "stribeck"]


def test_an_ensemble_of_what_a_file_describes(capsys, tmp_path):
    slider, file = SLIDERS[0], tmp_path / "stribeck.json"
    file.write_text(slider.to_json())
    how = ["--event", "great very near field", "--members", 20, "--seed", 3, "--json"]
    found = json.loads(run(["ensemble", "--slider", file, *how], capsys))
    quake = ss.PoissonPulses.event("great very near field")
    expected = ss.run_ensemble(slider, quake, members=20, seed=3)
    assert found["peak_m"][0]["value"] == expected.quantile(0.5).value


def test_a_file_excludes_the_options_that_it_contains(capsys, tmp_path):
    file = tmp_path / "slider.json"
    file.write_text(SLIDERS[1].to_json())
    for more in (["--mu", "0.1"], ["--period", "2"], ["--law", "caster"]):
        assert main(["slide", "sample:Kobe", "--slider", str(file), *more]) == 2
        assert f"{more[0]} belongs into the file of --slider" in capsys.readouterr().err
    for command in (["slide", "sample:Kobe"], ["ensemble", "--event", "great near field"]):
        assert main(command) == 2
        assert "give --mu, or --slider with a file" in capsys.readouterr().err
