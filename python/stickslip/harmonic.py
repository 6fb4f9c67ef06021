"""Exact periodic responses to harmonic ground motion, -n(t) = B cos(omega t).

`orbits` finds them, stable and unstable; `continuation` follows them as the frequency changes::

    slider = ss.Caster(slip_level=1.0, reach=1.0)
    small, large = ss.harmonic.orbits(slider, B=1.0, omega=0.5)[1:]
    branch = ss.harmonic.continuation(slider, large, low=0.1, high=2.0)  # past the fold to `small`
"""

from ._core import Orbit, OrbitBranch, continuation, orbits

__all__ = ["Orbit", "OrbitBranch", "continuation", "orbits"]
