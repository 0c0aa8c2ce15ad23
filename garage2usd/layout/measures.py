"""Measures of a garage: its floor area, of which each stall has its share, and the clear width of lanes and doors."""

import math
from typing import NamedTuple

from garage2usd.common.errors import ConfigError
from garage2usd.layout.tiles import Tile, TileGrid

_LEAST_M = 2.5
"""Least clear width of a lane and an open door: a van including mirrors, and 0.2 m on both sides."""
_ROUNDING_M = 1e-6


class FloorArea(NamedTuple):
    """Floor of a level or of a garage.

    Attributes
    ----------
    net_m2
        Floor inside the outline, without ramps between levels and other obstacles.
    gross_m2
        Ground inside the outline, ramps and obstacles included.
    """

    net_m2: float
    gross_m2: float

    def per_stall(self, stalls: int) -> "FloorArea":
        """Return the net and gross area per stall; infinite without stalls."""
        return FloorArea(*(area / stalls if stalls else math.inf for area in self))

    def in_words(self) -> str:
        """Describe the area per stall: ``27.4 m2 a stall net, 31.0 gross``."""
        return f"{self.net_m2:.1f} m2 a stall net, {self.gross_m2:.1f} gross"


def check_carriageways(grid: TileGrid) -> None:
    """Check the width of the carriageway on all lane and portal squares.

    Raises
    ------
    ConfigError
        If the clear width of a carriageway is less than 2.5 m.
    """
    for tile in grid:
        up, down, left, right = tile.drivable
        for along_x, is_driven, beside, side_m in (
            (True, up or down, (left, right), tile.width_m),
            (False, left or right, (up, down), tile.depth_m),
        ):
            if is_driven:
                check_clear_width(tile, side_m - grid.setback_m * beside.count(False), along_x=along_x)


def check_clear_width(tile: Tile, clear_m: float, *, along_x: bool) -> None:
    """Check the clear width of a lane square in a layout.

    Parameters
    ----------
    tile
        Square of the garage.
    clear_m
        Clear width, metres.
    along_x
        True if the width is measured along X, False along Z.

    Raises
    ------
    ConfigError
        If the width is less than 2.5 m.
    """
    if clear_m >= _LEAST_M - _ROUNDING_M:
        return
    field, side_m = ("bay.column_widths_m", tile.width_m) if along_x else ("bay.row_depths_m", tile.depth_m)
    least_m = side_m - clear_m + _LEAST_M
    where = f"on square {list(tile.square)}, so that {_LEAST_M} m are clear between columns, walls or a door's frame"
    raise ConfigError(field, side_m, f"at least {least_m:.2f} m {where}")
