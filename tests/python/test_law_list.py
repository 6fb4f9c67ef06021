"""The laws of the library: one base class, one list, and what their parts say."""

import inspect
import re

import pytest
import stickslip as ss
from pages import ROOT
from stickslip import _core
from stickslip.plotting import words

LAWS = [
    one
    for one in vars(ss).values()
    if inspect.isclass(one) and issubclass(one, ss.FrictionLaw) and one is not ss.FrictionLaw
]

# The files that may name a law: those of every law, and those that treat one law alone, or say so.
EVERYWHERE = {
    "include/stickslip/friction/laws.hpp",  # the list
    "python/stickslip/__init__.py",
    "python/stickslip/_core.pyi",
    "python/stickslip/referee/adapters/own.py",  # the laws of the referee's problems
    "web/page/settings.js",  # what the page shows of each law
    "web/tests/problems.py",
}
ALONE = {
    "Stribeck": {
        "include/stickslip/friction/stribeck.hpp",
        "python/bindings/friction/stribeck.cpp",
        "include/stickslip/theory/transport.hpp",  # what it covers
        "python/bindings/theory/transport.cpp",
    },
    "KumarFriction": {
        "include/stickslip/friction/kumar.hpp",
        "python/bindings/friction/kumar.cpp",
    },
    "VelocityDependent": {
        "include/stickslip/friction/velocity_dependent.hpp",
        "python/bindings/friction/velocity_dependent.cpp",
        "include/stickslip/theory/transport.hpp",
        "python/bindings/theory/transport.cpp",
        "include/stickslip/ensemble/detail/lanes_simulator.hpp",  # has vector lanes
        "include/stickslip/lanes/series_lanes.hpp",
        "src/ensemble/lanes_simulator.cpp",
        "src/lanes/series_lanes.cpp",
        "python/bindings/slider/slider.cpp",  # FrictionPendulum(mu_slow=..., mu_fast=..., rate=...)
        "python/stickslip/_interfaces.py",
    },
    "Degrading": {
        "include/stickslip/friction/degrading.hpp",
        "python/bindings/friction/degrading.cpp",
        "include/stickslip/sliding/integrate.hpp",  # its accuracy
        "python/bindings/sliding/integrate.cpp",
        "include/stickslip/structure/flexible_slope.hpp",  # a yield acceleration that decreases
        "src/structure/flexible_slope.cpp",
        "src/structure/sweep.cpp",
        "python/bindings/structure/flexible_slope.cpp",
    },
}


def test_all_laws_have_one_base_class():
    assert {one.__name__ for one in LAWS} >= {"Coulomb", "Law", "StaticKinetic", "MultiPendulum"}
    assert set(_core._laws()) <= {one.__name__ for one in LAWS}
    assert isinstance(ss.Slider(ss.Law(resist=max)).law, ss.FrictionLaw)
    assert not isinstance(ss.Slider(ss.Coulomb(mu=0.1)), ss.FrictionLaw)
    with pytest.raises(TypeError, match="FrictionLaw: cannot be constructed directly"):
        ss.FrictionLaw()


def test_an_object_that_only_says_that_it_is_a_law_is_refused():
    class Mine(ss.FrictionLaw):
        def __init__(self):
            pass

    with pytest.raises(TypeError):
        ss.Slider(Mine())


@pytest.mark.parametrize("law", ALONE)
def test_no_file_names_a_law_but_those_that_treat_it_alone(law):
    found = {
        str(path.relative_to(ROOT))
        for folder in ("include", "src", "python", "web")
        for path in (ROOT / folder).rglob("*")
        if path.suffix in {".hpp", ".cpp", ".h", ".inl", ".py", ".pyi", ".js", ".html"}
        and not {"node_modules", "__pycache__"} & set(path.parts)
        and re.search(rf"\b{law}\b", path.read_text(encoding="utf-8"))
    }
    own = {path for path in ALONE[law] if "/friction/" in path}
    assert own <= found
    assert found <= EVERYWHERE | ALONE[law]


def test_a_picture_names_the_parts_of_a_law_that_has_no_words():
    parts = [("slip_level", "a", "m/s^2", ""), ("drag", "c", "1/s", ""), ("turns", "", "", "")]
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(_core, "_laws", lambda: {"Sand": parts})
        sand = {"law": "Sand", "slip_level": 9.80665, "drag": 0.3, "turns": 2}
        said = words.in_words({**sand, "natural_frequency": 2})
        assert said == ["slip level 1.00 g", "drag 0.300 1/s", "turns 2.00", "period 3.14 s"]
    assert words.in_words({"law": "typeinfo", "levels": [1, 2]}) == ["law from functions"]
