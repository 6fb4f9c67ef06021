"""What tables show of the response of a structure."""

from __future__ import annotations

from typing import TYPE_CHECKING

from ._core import EquipmentOnFloor, StructureResponse
from ._responses import GROUND, TEMPERATURE, Described, History, ground_motion_row, loop_rows

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

__all__ = ["describe", "has_drifts", "has_floors"]

_HISTORIES = (
    GROUND,
    History("displacement", "m", "displacement of the interface"),
    History("velocity", "m/s", "velocity of the interface"),
    History("base_acceleration", "m/s^2", "absolute acceleration of what the structure stands on"),
    History(
        "demand", "m/s^2", "force that the bond would have to carry per unit of the reference mass"
    ),
    History(
        "force",
        "m/s^2",
        "sum of friction, spring and damper force per unit of the reference mass",
    ),
)


def has_floors(response: StructureResponse) -> bool:
    """Whether `StructureResponse.floors` exists: the column of a slope has its top."""
    structure = getattr(response.system, "structure", None)
    return structure is None or structure.floors > 0


def has_drifts(response: StructureResponse) -> bool:
    """Whether the floors have drifts: each must be above another."""
    structure = getattr(response.system, "structure", None)
    return has_floors(response) and (structure is None or bool((structure.influence == 1).all()))


def describe(response: StructureResponse) -> Described:
    """What tables show of a response."""
    floors: list[History] = []
    columns: list[History] = []
    peaks: dict[str, NDArray[np.float64]] = {}
    if has_floors(response):
        moving = response.floors
        below = "ground" if isinstance(response.system, EquipmentOnFloor) else "base"
        of_each = (
            ("displacement", "m", f"displacement relative to the {below}", moving.displacement),
            ("acceleration", "m/s^2", "absolute acceleration", moving.acceleration),
        )
        floors = [
            History(f"floor_{name}", unit, what, values) for name, unit, what, values in of_each
        ]
        columns = [
            History(f"floor_{i}_{name}", unit, f"{what}, floor {i}", values[:, i - 1])
            for i in range(1, moving.displacement.shape[1] + 1)
            for name, unit, what, values in of_each
        ]
        peaks = {"peak_floor_acceleration": moving.peak_acceleration}
    if has_drifts(response):
        what = "displacement relative to the floor below"
        floors.append(History("floor_drift", "m", what, response.floors.drift))
        peaks["peak_drift"] = response.floors.peak_drift
    return Described(
        system="system",
        title="Response of a structure",
        histories=_HISTORIES if response.temperature is None else (*_HISTORIES, TEMPERATURE),
        results=(
            *("peak", "residual", "sliding_distance", "at_rest", "settled", "margin"),
            *("peak_base_acceleration", "peak_base_shear"),
        ),
        attributes={"peak": "m", "residual": "m"},
        rows=_rows,
        floor_columns=columns,
        floors=floors,
        floor_peaks=peaks,
    )


def _rows(response: StructureResponse) -> list[tuple[str, str]]:
    rows = [
        ("structure", repr(response.system)),
        ground_motion_row(response),
        ("peak displacement", f"{response.peak:.4g} m"),
        (
            "residual displacement" if response.at_rest else "displacement at the end, sliding",
            f"{response.residual:.4g} m",
        ),
        ("slips", f"{response.slips:,}"),
        ("time sliding", f"{response.time_sliding:.4g} s"),
        ("peak acceleration of the base", f"{response.peak_base_acceleration:.4g} m/s²"),
    ]
    if has_floors(response):
        largest = response.floors.peak_acceleration
        rows.append(
            (
                "largest floor acceleration",
                f"{largest.max():.4g} m/s², floor {largest.argmax() + 1}",
            )
        )
    if has_drifts(response):
        largest = response.floors.peak_drift
        rows.append(("largest drift", f"{largest.max():.4g} m, floor {largest.argmax() + 1}"))
    if response.temperature is not None:
        rows.append(("highest temperature", f"{response.temperature.max():.4g} °C, at samples"))
    if len(response.impacts):
        rows.append(("impacts on stops", f"{len(response.impacts):,}"))
    return rows + loop_rows(response)
