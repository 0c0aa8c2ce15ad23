"""Fire shutters in the openings of a level to the ramps that lead up from it."""

from garage2usd.config import FittingsConfig
from garage2usd.layout.placement import Placement, edge_yaw_rad, placed
from garage2usd.layout.shell.well import Well
from garage2usd.objects.fire_shutter import FireShutterSpec
from garage2usd.structure.grid import Structure

__all__ = ["fire_shutters"]

_LEAST_M, _MOST_M = 0.26, 0.42
"""Height of a shutter that is rolled up."""
_DEPTH_M = 0.3
_OVER_CLEAR_M = 0.02


def fire_shutters(well: Well, structure: Structure, fittings: FittingsConfig) -> list[Placement]:
    """Place a fire shutter in each opening of a level to a ramp up from it.

    They keep a fire from the levels above. There are none without space above the clear height.
    """
    ceiling_m = fittings.ceiling_height_m
    height_m = round(min(_MOST_M, ceiling_m - fittings.clear_height_m - _OVER_CLEAR_M), 3)
    if not fittings.fire_shutters or height_m < _LEAST_M:
        return []
    return [
        placed(
            f"FireShutter_{opening.name}",
            FireShutterSpec(opening.width_m, ceiling_m, round(ceiling_m - height_m, 3), _DEPTH_M),
            opening.middle_m,
            yaw_rad=edge_yaw_rad(opening.faces),
        )
        for opening in well.openings(structure)
    ]
