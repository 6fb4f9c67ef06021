"""`ensemble_sensitivity`: derivatives of the statistics of an ensemble."""

from __future__ import annotations

from typing import SupportsIndex

from .. import _core
from .._core import EnsembleSensitivity
from .._numbers import whole_number
from ..runs.progress import Progress, shown
from .sources import AnyMotions, AnySliders


def ensemble_sensitivity(
    sliders: AnySliders,
    motions: AnyMotions,
    parameter: str,
    *,
    members: SupportsIndex,
    seed: SupportsIndex,
    first_member: SupportsIndex = 0,
    threads: SupportsIndex | None = None,
    settle: bool = False,
    contact: str = "flight",
    progress: bool | Progress | None = None,
) -> EnsembleSensitivity:
    """Differentiate the statistics of an ensemble with respect to a parameter.

    The derivatives are means of the derivatives of the members, each as by `Response.sensitivity`:
    d E[peak] = E[d peak], d E[x^2] = 2 E[x dx], d rms = E[x dx] / rms.

    Parameters
    ----------
    sliders : Slider, Coulomb, a list of these, Drawn, Random or SliderSource
        As for `run_ensemble`, with Coulomb friction and any mounting but stops.
    motions : GaussianExcitation, PoissonPulses, WithTransverse, WithVertical, GroundMotion, ...
        As for `run_ensemble`.
    parameter : str
        'mu' or 'slip_level' [m/s^2]; 'natural_frequency' [rad/s]; 'damping' [1/s]; 'slope_degrees';
        'scale', a factor on all components of the ground motion.
    members : int
        Number of members, at least 2.
    seed : int
        From 0 to 2^64 - 1.
    first_member : int, optional
        Number of the first member, at least 0; default 0.
    threads : int, optional
        Maximum number of threads, at least 1; default: all cores.
    settle : bool, optional
        Differentiate peaks and residuals after each slider has come to rest.
    contact : 'flight' or 'clipped', optional
        What sliders do when they lose contact with the ground. There are no derivatives of a
        flight: with 'flight', a member that leaves the ground is an error.
    progress : bool or callable, optional
        As for `run_ensemble`.

    Returns
    -------
    EnsembleSensitivity
        Per unit of the parameter, with standard errors; the same bits for any threads.

    Raises
    ------
    ValueError
        Another law, or stops; a parameter that the slider does not have; a member that
        leaves the ground or whose response is not differentiable (names it); a value out of range.
    TypeError
        An argument of the wrong type.
    ConvergenceError
        A member does not settle; names it.

    Notes
    -----
    Mean and derivative may be exchanged because the response of Coulomb friction is continuous in
    the parameter, with a bounded derivative. With static friction above kinetic friction, or
    friction that weakens with speed, the response jumps where a decision changes, and the mean of
    the derivatives leaves the jumps out. For these, for stops and for flights, take differences of
    two ensembles with the same seed: the members are the same, and most of the scatter cancels. The
    guide on random vibration shows how. Each member costs `integrate` and `Response.sensitivity`.

    Examples
    --------
    >>> import stickslip as ss
    >>> quakes = ss.PoissonPulses.event("great near field")
    >>> s = ss.ensemble_sensitivity(ss.Coulomb(mu=0.1), quakes, "mu", members=100, seed=1)
    >>> s.peak_mean.value < 0  # m per unit of mu
    True
    """

    def checked(name: str, value: SupportsIndex, least: int, most: int = 2**64 - 1) -> int:
        return whole_number(value, f"ensemble_sensitivity: {name}", least, most)

    if isinstance(sliders, _core.PlanarSlider):
        raise TypeError(
            "ensemble_sensitivity: covers sliders on one axis, got a PlanarSlider; take"
            " differences of two ensembles with the same seed"
        )
    with shown(progress, "ensemble_sensitivity", "member") as show:
        return _core.ensemble_sensitivity(
            sliders,
            motions,
            parameter,
            members=checked("members", members, 2),
            first_member=checked("first_member", first_member, 0),
            seed=checked("seed", seed, 0),
            threads=0 if threads is None else checked("threads", threads, 1, 2**16),
            settle=settle,
            contact=contact,
            progress=show,
        )
