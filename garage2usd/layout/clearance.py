"""Whether cars get through: the clear width of lanes and doors."""

from garage2usd.common.errors import ConfigError
from garage2usd.layout.tiles import Tile, TileGrid

__all__ = ["check_carriageways", "check_clear_width"]

_LEAST_M = 2.5
"""Clear width that a lane and an open door leave at least: a van over its mirrors, and 0.2 m on both sides."""
_ROUNDING_M = 1e-6


def check_carriageways(grid: TileGrid) -> None:
    """Refuse lanes and portals on which the carriageway is too narrow.

    Raises
    ------
    ConfigError
        If one leaves less than 2.5 m along a way that cars take over it.
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
    """Refuse a square that leaves cars too little width.

    Parameters
    ----------
    tile
        The square.
    clear_m
        What it leaves.
    along_x
        Whether that is measured along X.

    Raises
    ------
    ConfigError
        If it is less than 2.5 m.
    """
    if clear_m >= _LEAST_M - _ROUNDING_M:
        return
    field, side_m = ("bay.column_widths_m", tile.width_m) if along_x else ("bay.row_depths_m", tile.depth_m)
    least_m = side_m - clear_m + _LEAST_M
    where = f"on square {list(tile.square)}, so that {_LEAST_M} m are clear between columns, walls or a door's frame"
    raise ConfigError(field, side_m, f"at least {least_m:.2f} m {where}")
