"""What tables show of the response of a block that rocks."""

from __future__ import annotations

from .._core import RockingBlock, RockingResponse
from .._responses import GROUND, VERTICAL, Described, History, ground_motion_row

__all__ = ["describe"]

_RELATIVE = "relative to the ground"
_ROTATION = (
    History("rotation", "rad", f"rotation {_RELATIVE}, positive about the right corner"),
    History("rate", "rad/s", "rate of the rotation"),
)
_RESULTS = (
    *("peak_rotation", "peak_time", "peak_rotation_ratio", "overturned", "overturned_at"),
    *("impacts", "uplifts", "time_rocking", "at_rest", "margin", "condition", "remark"),
)
# Beside these of a `RockingBlock`.
_SLIDING = (
    History("displacement", "m", f"displacement of the middle of the base {_RELATIVE}"),
    History("top_displacement", "m", f"displacement of the middle of the top {_RELATIVE}"),
)
_OF_SLIDING = ("residual", "sliding_distance", "time_sliding", "liftoffs", "impacts_with_slip")


def describe(response: RockingResponse) -> Described:
    """What tables show of a response."""
    slides = isinstance(response.block, RockingBlock)
    lifted = response.motion.vertical is not None
    return Described(
        system="block",
        title="Response of a block that rocks",
        histories=(
            GROUND,
            *([VERTICAL] if lifted else []),
            *_ROTATION,
            *(_SLIDING if slides else []),
        ),
        results=_RESULTS + _OF_SLIDING if slides else _RESULTS,
        attributes={"peak_rotation": "rad", "overturned": ""},
        rows=_rows,
    )


def _rows(response: RockingResponse) -> list[tuple[str, str]]:
    if response.overturned:
        outcome = ("overturned", f"to the {response.overturned}")
        when = ("certain at", f"{response.overturned_at:.4g} s")
    else:
        ratio = f"{response.peak_rotation_ratio:.4g} alpha"
        outcome = ("peak rotation", f"{response.peak_rotation:.4g} rad, {ratio}")
        when = ("time of the peak", f"{response.peak_time:.4g} s")
    rows = [
        ("block", repr(response.block)),
        ground_motion_row(response),
        outcome,
        when,
        ("impacts", f"{response.impacts:,}"),
        ("time rocking", f"{response.time_rocking:.4g} s"),
        ("margin of the nearest decision", f"{response.margin:.3g}"),
    ]
    if isinstance(response.block, RockingBlock):
        return [
            *rows,
            ("displacement of the base at the end", f"{response.residual:.4g} m"),
            ("path slipped", f"{response.sliding_distance:.4g} m"),
        ]
    return [*rows, ("condition", f"{response.condition:.3g}")]
