"""A building on the slider of the command line."""

from __future__ import annotations

import argparse

from .. import IsolatedStructure, PlanarSlider, Slider, Structure
from .output import check_not_negative, check_positive

__all__ = ["BUILDING", "building_on"]

_OPTIONS = ("story_masses", "story_stiffnesses", "base_mass", "story_damping_ratio")
BUILDING = """
[building]
--story-masses number*... KG
    a shear building on the block, which is its base: masses of its floors, bottom up [kg]
--story-stiffnesses number*... K
    building: stiffness of each story [N/m]
--base-mass number KG
    building: mass of the base [kg]
--story-damping-ratio ratio Z
    building: damping ratio of each mode on a fixed base
"""


def building_on(
    slider: Slider | PlanarSlider, args: argparse.Namespace
) -> Slider | PlanarSlider | IsolatedStructure:
    """The slider, with the building of the command line if there is one."""
    options = {name: f"--{name.replace('_', '-')}" for name in _OPTIONS}
    missing = [option for name, option in options.items() if getattr(args, name) is None]
    if len(missing) == len(options):
        return slider
    if missing:
        raise ValueError(f"a building needs {' and '.join(missing)}, got none")
    if isinstance(slider, PlanarSlider):
        raise ValueError("a building moves on one axis: leave out --planar or --story-masses")
    count = len(args.story_masses)
    if len(args.story_stiffnesses) != count:
        raise ValueError(
            "--story-stiffnesses needs one for each of --story-masses,"
            f" {count}, got {len(args.story_stiffnesses)}"
        )
    for option, values, unit in (
        ("--story-masses", args.story_masses, "kg"),
        ("--story-stiffnesses", args.story_stiffnesses, "N/m"),
        ("--base-mass", [args.base_mass], "kg"),
    ):
        for value in values:
            check_positive(option, value, unit)
    check_not_negative("--story-damping-ratio", args.story_damping_ratio)
    structure = Structure.shear_building(
        masses=args.story_masses,
        stiffnesses=args.story_stiffnesses,
        damping_ratio=args.story_damping_ratio,
    )
    return IsolatedStructure(slider, structure, base_mass=args.base_mass)
