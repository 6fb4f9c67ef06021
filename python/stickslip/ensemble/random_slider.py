"""A slider with random parameters."""

from __future__ import annotations

import json
import operator
from collections.abc import Callable, Iterator
from typing import Any, SupportsIndex, TypeAlias

from .. import _core
from .._core import Lognormal, Normal, Uniform
from .sources import AnySlider

Distribution: TypeAlias = Lognormal | Normal | Uniform | float


class Random:
    """A slider for each member of an ensemble, made from random parameters.

    Parameters are independent of each other and of the ground motions. (seed, member) determines
    them, and a parameter keeps its value if the distribution of another one changes.

    Parameters
    ----------
    kind : callable
        Makes the slider or the law: a law such as `Coulomb`, `Slider`, `PlanarSlider`, one of
        their constructors, such as `Caster.from_geometry`, or a function. For other processes it
        must pickle, as classes and module functions do.
    **parameters
        Its keyword arguments. A `Lognormal`, `Normal` or `Uniform` is sampled for each member; a
        `Random` makes an object for each member, such as the law of a slider; all other values are
        passed on unchanged.

    Raises
    ------
    TypeError
        `kind` is not callable.
    Exception
        Whatever `kind` raises at the quartiles of all parameters: the constructor calls it there.

    Examples
    --------
    >>> import stickslip as ss
    >>> blocks = ss.Random(ss.Coulomb, mu=ss.Lognormal(median=0.3, beta=0.3))
    >>> floors = ss.Random(ss.Slider, law=blocks, natural_frequency=ss.Uniform(1.5, 2.5))
    >>> floors.sample(seed=1, member=0) == floors.sample(seed=1, member=0)
    True

    Notes
    -----
    Parameter j, counted in the order of the arguments that are numbers or distributions, is the
    quantile at the j-th uniform random number of the member (Philox), in C++ as in Python. A value
    that the law rejects, such as a negative mu, ends a run with a ValueError that names the member
    and the value: give a `Normal` bounds. A member costs some 20 us, one thread at a time.
    """

    def __init__(self, kind: Callable[..., AnySlider], /, **parameters: Any) -> None:
        if not callable(kind):
            raise TypeError(f"Random: kind must be callable, such as Coulomb, got {kind!r}")
        self._kind = kind
        self._parameters = parameters
        self._drawn = list(self._distributions())
        # The name of a function does not tell what it does: its results identify it.
        self._quartiles = [
            repr(self._make(_core.quantile(one, p) for one in self._drawn))
            for p in (0.25, 0.5, 0.75)
        ]

    @property
    def kind(self) -> Callable[..., AnySlider]:
        """The callable that makes the slider or the law."""
        return self._kind

    @property
    def parameters(self) -> dict[str, Any]:
        """Its keyword arguments: distributions, and values passed on unchanged."""
        return dict(self._parameters)

    @property
    def configuration(self) -> dict[str, Any]:
        """Everything that determines the sliders, as JSON types."""
        parameters = {name: _description(value) for name, value in self._parameters.items()}
        return {"random": parameters, "quartiles": self._quartiles}

    def sample(self, *, seed: SupportsIndex, member: SupportsIndex) -> AnySlider:
        """Make the slider of a member.

        Parameters
        ----------
        seed, member : int
            From 0 to 2^64 - 1.

        Returns
        -------
        Slider or friction law
            The result of `kind`.

        Raises
        ------
        ValueError
            The law rejects the parameters; the message names the member and the value.
        """
        number = operator.index(member)
        values = _core.draw(self._drawn, seed=operator.index(seed), member=number)
        try:
            return self._make(iter(values))
        except ValueError as error:
            raise ValueError(f"Random: member {number}: {error}") from error

    def _distributions(self) -> Iterator[Distribution]:
        """The distributions of all numbers that `kind` gets; a fixed number is one, too."""
        for value in self._parameters.values():
            if isinstance(value, Random):
                yield from value._distributions()
            elif _is_distribution(value):
                yield value

    def _make(self, values: Iterator[float]) -> AnySlider:
        def argument(value: Any) -> Any:
            if isinstance(value, Random):
                return value._make(values)
            return next(values) if _is_distribution(value) else value

        return self._kind(**{name: argument(value) for name, value in self._parameters.items()})

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, Random):
            return NotImplemented
        return (self._kind, self._parameters) == (other._kind, other._parameters)

    def __hash__(self) -> int:
        return hash((self._kind, tuple(self._parameters.items())))

    def __repr__(self) -> str:
        kind = getattr(self._kind, "__name__", None) or repr(self._kind)
        arguments = "".join(f", {name}={value!r}" for name, value in self._parameters.items())
        return f"Random({kind}{arguments})"


def _is_distribution(value: Any) -> bool:
    if isinstance(value, bool):
        return False
    return isinstance(value, (Lognormal, Normal, Uniform, int, float))


def _description(value: Any) -> Any:
    if isinstance(value, Random):
        return value.configuration
    if _is_distribution(value):
        return json.loads(_core.describe(value))
    return value if isinstance(value, (bool, str)) else repr(value)
