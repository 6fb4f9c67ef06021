"""A slider with random parameters."""

from __future__ import annotations

import json
import operator
from collections import Counter
from collections.abc import Callable, Iterator, Sequence
from statistics import NormalDist
from typing import Any, SupportsIndex, TypeAlias

import numpy as np
from numpy.typing import NDArray

from .. import _core
from .._core import Cart, Lognormal, Normal, RockingBlock, SlenderBlock, Uniform
from .._optional import optional
from .sources import AnyMember

Distribution: TypeAlias = Lognormal | Normal | Uniform | float
AnyMade: TypeAlias = "AnyMember | SlenderBlock | RockingBlock | Cart"
_Path: TypeAlias = tuple[str, ...]  # the names of the arguments that lead to a parameter


class Random:
    """A slider for each member of an ensemble or a sweep, made from random parameters.

    Parameters are independent of the ground motions, and of each other unless `correlated` says
    otherwise. (seed, member) determines them, and a parameter keeps its value if the distribution
    of another one changes.

    Parameters
    ----------
    kind : callable
        Makes the slider, the law, the structure or the block: a law such as `Coulomb`, `Slider`,
        `PlanarSlider`, one of their constructors, such as `SlenderBlock.from_size`, or a function.
        For other processes it must pickle, as classes and module functions do.
    **parameters
        Its keyword arguments. A `Lognormal`, `Normal` or `Uniform` is sampled for each member; a
        `Random` makes an object for each member, such as the law of a slider; all other values are
        passed on unchanged.

    Raises
    ------
    TypeError
        `kind` is not callable, or returns None.
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
    quantile at the j-th uniform random number of the member (Philox), in C++ as in Python;
    correlated parameters mix the normal scores of these numbers. A value
    that the law rejects, such as a negative mu, ends a run with a ValueError that names the member
    and the value: give a `Normal` bounds. A member costs some 20 us, one thread at a time.
    """

    def __init__(self, kind: Callable[..., AnyMade], /, **parameters: Any) -> None:
        if not callable(kind):
            raise TypeError(f"Random: kind must be callable, such as Coulomb, got {kind!r}")
        self._kind = kind
        self._parameters = parameters
        self._drawn = [one for _, one in self._leaves()]
        self._correlations: dict[tuple[str, str], float] = {}
        self._mixing: NDArray[np.float64] | None = self._cholesky()
        # The name of a function does not tell what it does: its results identify it.
        self._quartiles = [
            repr(self._make(_core.quantile(one, p) for one in self._drawn))
            for p in (0.25, 0.5, 0.75)
        ]

    @property
    def _name(self) -> str:
        return getattr(self._kind, "__name__", None) or repr(self._kind)

    @property
    def kind(self) -> Callable[..., AnyMade]:
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
        about: dict[str, Any] = {"random": parameters, "quartiles": self._quartiles}
        if self._correlations:
            about["correlations"] = [[a, b, rho] for (a, b), rho in self._correlations.items()]
        return about

    @property
    def names(self) -> tuple[str, ...]:
        """The names of the random parameters, those of a nested `Random` included.

        A name that occurs twice is preceded by the argument that leads to it: ``law.mu``.
        """
        varying = [path for path, one in self._leaves() if not isinstance(one, (int, float))]
        counts = Counter(path[-1] for path in varying)
        return tuple(path[-1] if counts[path[-1]] == 1 else ".".join(path) for path in varying)

    def correlated(self, first: str, second: str, coefficient: float) -> Random:
        """The same random sliders, with two parameters correlated.

        The normal scores of the two parameters are jointly normal (a Gaussian copula); each keeps
        its distribution. Call it again for other pairs.

        Parameters
        ----------
        first, second : str
            Two of `names`.
        coefficient : float
            Correlation of the normal scores, between -1 and 1; for two `Lognormal` parameters, that
            of the logarithms.

        Returns
        -------
        Random

        Raises
        ------
        ValueError
            Another name; a coefficient out of range; correlations that contradict each other.

        Examples
        --------
        >>> import stickslip as ss
        >>> block = ss.Random(
        ...     ss.StaticKinetic,
        ...     mu_static=ss.Lognormal(median=0.4, beta=0.1),
        ...     mu_kinetic=ss.Lognormal(median=0.3, beta=0.1),
        ... ).correlated("mu_static", "mu_kinetic", 0.9)
        """
        for name in (first, second):
            if name not in self.names:
                raise ValueError(
                    f"Random.correlated: '{name}' must be one of {', '.join(self.names) or 'none'}"
                )
        if first == second:
            raise ValueError(f"Random.correlated: needs two parameters, got '{first}' twice")
        rho = float(coefficient)
        if not -1 < rho < 1:
            raise ValueError(
                "Random.correlated: coefficient must lie strictly between -1 and 1, got"
                f" {coefficient}"
            )
        result = Random(self._kind, **self._parameters)
        a, b = sorted((first, second), key=self.names.index)
        result._correlations = {**self._correlations, (a, b): rho}
        result._mixing = result._cholesky()
        return result

    def _pairs(self) -> Iterator[tuple[_Path, _Path, float]]:
        """The correlated parameters, those of a nested `Random` included."""
        paths = [path for path, one in self._leaves() if not isinstance(one, (int, float))]
        of = dict(zip(self.names, paths))
        for name, value in self._parameters.items():
            if isinstance(value, Random):
                yield from (((name, *a), (name, *b), rho) for a, b, rho in value._pairs())
        yield from ((of[a], of[b], rho) for (a, b), rho in self._correlations.items())

    def _cholesky(self) -> NDArray[np.float64] | None:
        """The matrix that correlates independent normal scores; None if none are correlated."""
        pairs = list(self._pairs())
        if not pairs:
            return None
        places = {path: i for i, (path, _) in enumerate(self._leaves())}
        matrix = np.eye(len(places))
        for a, b, rho in pairs:
            matrix[places[a], places[b]] = matrix[places[b], places[a]] = rho
        try:
            factor: NDArray[np.float64] = np.linalg.cholesky(matrix)
        except np.linalg.LinAlgError:
            raise ValueError(
                "Random.correlated: the correlations contradict each other: their matrix has a"
                " negative or zero eigenvalue"
            ) from None
        return factor

    def _values(self, uniforms: Sequence[float]) -> list[float]:
        """The parameters at independent uniform random numbers, one for each."""
        if self._mixing is not None:
            normal = NormalDist()
            scores = self._mixing @ [normal.inv_cdf(u) for u in uniforms]
            # An extreme score may round to a probability of 1, of which there is no quantile.
            uniforms = [min(normal.cdf(score), 1 - 2**-53) for score in scores]
        return [_core.quantile(one, u) for one, u in zip(self._drawn, uniforms)]

    def sample(self, *, seed: SupportsIndex, member: SupportsIndex) -> AnyMember:
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
        return self._member(number, self._draw(operator.index(seed), number))

    def draw(
        self, members: SupportsIndex, *, seed: SupportsIndex, stratified: bool = False
    ) -> tuple[list[AnyMember], dict[str, list[float]]]:
        """Make the sliders of the members 0 to members - 1, with the parameters of each.

        Parameters
        ----------
        members : int
            At least 1.
        seed : int
            From 0 to 2^64 - 1.
        stratified : bool, optional
            Draw a Latin hypercube (`scipy.stats.qmc`): each parameter has one value in each of
            `members` intervals of equal probability. Otherwise slider i is that of `sample`.

        Returns
        -------
        sliders : list
        parameters : dict of list
            By name, as in `names`, the values of the random parameters for all sliders.

        Raises
        ------
        ValueError
            A number out of range; parameters that the law rejects.
        ImportError
            SciPy is missing, if `stratified`.
        """
        count, number = operator.index(members), operator.index(seed)
        if count < 1:
            raise ValueError(f"Random: members must be at least 1, got {count}")
        if not 0 <= number < 2**64:
            raise ValueError(f"Random: seed must be from 0 to 2^64 - 1, got {number}")
        if stratified:
            qmc = optional("scipy.stats.qmc", "risk", "Random.draw")
            cube = qmc.LatinHypercube(max(len(self._drawn), 1), seed=np.random.default_rng(number))
            tiny = np.finfo(float).tiny  # there is no quantile of 0
            rows = [self._values(row) for row in np.maximum(cube.random(count), tiny).tolist()]
        else:
            rows = [self._draw(number, member) for member in range(count)]
        sliders = [self._member(i, row) for i, row in enumerate(rows)]
        varying = [i for i, d in enumerate(self._drawn) if not isinstance(d, (int, float))]
        return sliders, {name: [row[i] for row in rows] for name, i in zip(self.names, varying)}

    def _draw(self, seed: int, member: int) -> list[float]:
        """The parameters of a member."""
        if self._mixing is None:
            return _core.draw(self._drawn, seed=seed, member=member)
        even = [Uniform(0, 1)] * len(self._drawn)
        return self._values(_core.draw(even, seed=seed, member=member))

    def _member(self, number: int, values: Sequence[float]) -> AnyMember:
        try:
            return self._make(iter(values))
        except ValueError as error:
            raise ValueError(f"Random: member {number}: {error}") from error

    def _leaves(self) -> Iterator[tuple[_Path, Distribution]]:
        """The distributions of all numbers that `kind` gets; a fixed number is one, too."""
        for name, value in self._parameters.items():
            if isinstance(value, Random):
                yield from (((name, *path), one) for path, one in value._leaves())
            elif _is_distribution(value):
                yield (name,), value

    def _make(self, values: Iterator[float]) -> AnyMember:
        def argument(value: Any) -> Any:
            if isinstance(value, Random):
                return value._make(values)
            return next(values) if _is_distribution(value) else value

        made = self._kind(**{name: argument(value) for name, value in self._parameters.items()})
        if made is None:
            raise TypeError(f"Random: {self._name} must return what it makes, got None")
        return made

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, Random):
            return NotImplemented
        mine, its = ((r._kind, r._parameters, r._correlations) for r in (self, other))
        return mine == its

    def __hash__(self) -> int:
        return hash((self._kind, tuple(self._parameters.items())))

    def __repr__(self) -> str:
        arguments = "".join(f", {name}={value!r}" for name, value in self._parameters.items())
        pairs = "".join(
            f".correlated({a!r}, {b!r}, {rho!r})" for (a, b), rho in self._correlations.items()
        )
        return f"Random({self._name}{arguments}){pairs}"


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
