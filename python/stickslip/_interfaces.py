"""Coefficients of friction of real interfaces."""

from __future__ import annotations

from ._rows import Rows

__all__ = ["interfaces"]

_KASIMZADE = "quoted by Kasimzade et al., EJERS 4 (2), 2019"

# Interface, lowest and highest coefficient, note, source.
_TABLE = (
    (
        "steel on mortar",
        0.5,
        0.8,
        "0.78 on average; begins at 0.5 and rises to 0.8 with wear; 0.5 in design",
        "Ikenaga et al. 2008; AIJ",
    ),
    ("wood on stone", 0.5, 0.5, "stable", "14th World Conf. Earthquake Eng. 2008, 12-01-0050"),
    (
        "PTFE bearing, unlubricated",
        0.05,
        0.16,
        "from slow to fast sliding, less under high pressure; the source's example has mu_slow"
        " 0.085, mu_fast 0.163 and a rate of 0.77 s/inch (30.3 s/m): use VelocityDependent",
        "OpenSees manual, friction models",
    ),
    (
        "marble on marble, HDPE or geosynthetic",
        0.05,
        0.15,
        "averages of tests under 10 to 50 kN",
        "Nanda, Agarwal, Shrikhande 2012, Shock and Vibration 19, 1327-1339",
    ),
    ("Delrin below masonry", 0.2, 0.2, "", _KASIMZADE),
    (
        "graphite on concrete",
        0.23,
        0.4,
        "on a shaking table: 0.23 at peak accelerations of 0.2 to 0.3 g, 0.4 at 0.3 to 0.6 g",
        _KASIMZADE,
    ),
    ("graphite powder", 0.25, 0.25, "", _KASIMZADE),
    ("dry sand", 0.34, 0.34, "", _KASIMZADE),
    ("wet sand", 0.41, 0.41, "", _KASIMZADE),
    ("asphalt below masonry", 0.6, 0.6, "", _KASIMZADE),
    ("vinyl flooring below masonry", 0.7, 0.7, "", _KASIMZADE),
)


def interfaces() -> Rows:
    """Coefficients of friction of real interfaces, as published.

    Each value comes from one series of tests: surfaces, wear, pressure and speed change it by tens
    of percent, so measure yours, or run a range. The table omits interfaces for which we have not
    seen a published source.

    Returns
    -------
    list of dict
        For each interface, its name, ``interface``; the lowest and highest coefficient, ``mu_low``
        and ``mu_high`` [-], equal where the source gives one; a ``note``; the ``source``. It
        prints as a table; `pandas.DataFrame(interfaces())` is the same as a DataFrame.
    """
    names = ("interface", "mu_low", "mu_high", "note", "source")
    return Rows(dict(zip(names, row)) for row in _TABLE)
