"""Ceiling beams on the column lines, and the vertical layers of beams, cable trays, pipes and ducts."""

import math
from collections.abc import Collection, Iterable
from dataclasses import dataclass
from functools import lru_cache
from itertools import product

import numpy as np

from garage2usd.config import BayConfig, FittingsConfig
from garage2usd.layout.placement import Placement, placed
from garage2usd.objects.beam import BeamNodeSpec, BeamSpec
from garage2usd.objects.kind import Box, Point
from garage2usd.structure.grid import Cell, Structure
from garage2usd.structure.lane_graph import Square

_QUARTER_TURN = np.pi / 2
_BEAM_STEP_M = 0.05
_LEAST_BEAM_M, _MOST_BEAM_M = 0.2, 0.6
_BEAM_TO_COLUMN = 2 / 3
PIPE_RADIUS_M = 0.03
_HEAD_M = 0.07
DUCT_WIDTH_M, DUCT_HEIGHT_M = 0.8, 0.3
TRAY_WIDTH_M, TRAY_HEIGHT_M = 0.3, 0.06
_TRAY_BAR_M = 0.02
_FLANGE_M, _DUCT_BAR_M = 0.025, 0.05
_GAP_M = 0.02
_BELOW_TUBES_M = 0.13
_TRAY_LAYER_M = _GAP_M + TRAY_HEIGHT_M + _TRAY_BAR_M
_PIPE_LAYER_M = _GAP_M + 2 * PIPE_RADIUS_M
_DUCT_LAYER_M = _GAP_M + DUCT_HEIGHT_M + 2 * _FLANGE_M + _DUCT_BAR_M
_SIGN_TOP_M, _SIGN_BELOW_BEAM_M = 0.58, 0.18
_CORNERS = {(0, 0): "DownRight", (0, 1): "DownLeft", (1, 0): "UpRight", (1, 1): "UpLeft"}
"""Name of a corner as seen from a tile, by the tile's place among the four tiles around the corner."""


@dataclass(frozen=True)
class CeilingLevels:
    """Distances of beams, services and exit signs below the ceiling slab; None for services without room.

    Attributes
    ----------
    beam_depth_m
        Depth of the beams; 0 without any.
    tray_drop_m
        Distance from the slab to the bottom of the cable trays.
    pipe_drop_m
        Distance from the slab to the middle of the sprinkler pipes.
    duct_top_m
        Distance from the slab to the top of the ducts.
    sign_top_m
        Distance from the slab to the top of the exit signs.
    """

    beam_depth_m: float
    tray_drop_m: float | None
    pipe_drop_m: float | None
    duct_top_m: float | None
    sign_top_m: float

    @property
    def lines_beside_tubes(self) -> bool:
        """Return True if pipes or ducts are at the height of tube lights, as without beams and cable trays."""
        tops = (self.pipe_drop_m, self.duct_top_m)
        return any(top_m is not None and top_m < _BELOW_TUBES_M for top_m in tops)


def ceiling_levels(fittings: FittingsConfig) -> CeilingLevels:
    """Divide the height between clear height and ceiling into layers: beams, cable trays, pipes, ducts from the top.

    If the height is limited, the priority is pipes, ducts, cable trays, beams.
    """
    left = fittings.ceiling_height_m - fittings.clear_height_m
    has_pipes = fittings.sprinklers and left >= _PIPE_LAYER_M + _HEAD_M
    left -= _PIPE_LAYER_M if has_pipes else 0.0
    has_ducts = fittings.ducts and left >= _DUCT_LAYER_M
    left -= _DUCT_LAYER_M if has_ducts else _HEAD_M if has_pipes else 0.0
    has_trays = fittings.cable_trays and left >= _TRAY_LAYER_M + _BELOW_TUBES_M
    left -= _TRAY_LAYER_M if has_trays else 0.0
    steps = math.floor(left / _BEAM_STEP_M + 1e-6) if fittings.beams else 0
    depth = round(min(steps * _BEAM_STEP_M, _MOST_BEAM_M), 6)
    depth = depth if depth >= _LEAST_BEAM_M else 0.0
    tray_top = max(depth, _BELOW_TUBES_M if has_trays else 0.0) + _GAP_M
    pipe_top = tray_top + (_TRAY_LAYER_M if has_trays else 0.0)
    duct_top = pipe_top + (_PIPE_LAYER_M if has_pipes else 0.0) + _FLANGE_M
    return CeilingLevels(
        beam_depth_m=depth,
        tray_drop_m=round(tray_top + TRAY_HEIGHT_M, 6) if has_trays else None,
        pipe_drop_m=round(pipe_top + PIPE_RADIUS_M, 6) if has_pipes else None,
        duct_top_m=round(duct_top, 6) if has_ducts else None,
        sign_top_m=max(_SIGN_TOP_M, round(depth + _SIGN_BELOW_BEAM_M, 6)),
    )


def beams(
    structure: Structure, bay: BayConfig, ceiling_m: float, depth_m: float, pillars: Iterable[Placement]
) -> list[Placement]:
    """Place concrete beams under the borders of the squares, from column to column and from wall to wall.

    Parameters
    ----------
    structure, bay
        The squares, and the size of the columns.
    ceiling_m, depth_m
        Height of the ceiling, and depth of the beams.
    pillars
        The columns; at a corner whose column is set back, a node fills the gap.

    Notes
    -----
    Every beam ends half a column width before the corner. A node fills the gap at corners without a column, so that
    equal squares have equal beams.
    """
    size = bay.column_size_m
    x, z = structure.column_edges_m, structure.row_edges_m
    if depth_m <= 0 or min(np.diff(x).min(), np.diff(z).min()) < 2 * size:
        return []
    inside = structure.cells != Cell.OBSTACLE
    width = round(_BEAM_TO_COLUMN * size, 3)

    def beam(name: str, length_m: float, middle: Point, yaw_rad: float, square: Square) -> Placement:
        """Return a beam of a length at its middle (x, z)."""
        spec = BeamSpec(round(length_m, 6), width, depth_m)
        return placed(name, spec, middle, height_m=ceiling_m, yaw_rad=yaw_rad, square=square)

    found: list[Placement] = []
    for row, col in np.argwhere(inside[:, :-1] & inside[:, 1:]).tolist():
        middle = (float(x[col + 1]), float(z[row] + z[row + 1]) / 2)
        found.append(beam("BeamRight", float(z[row + 1] - z[row]) - size, middle, 0.0, (row, col)))
    for row, col in np.argwhere(inside[:-1] & inside[1:]).tolist():
        middle = (float(x[col] + x[col + 1]) / 2, float(z[row + 1]))
        found.append(beam("BeamDown", float(x[col + 1] - x[col]) - size, middle, _QUARTER_TURN, (row, col)))
    feet = {(place.position_m[0], place.position_m[2]) for place in pillars}
    return found + _node_beams(structure, size, width, ceiling_m, depth_m, feet)


def _node_beams(
    structure: Structure,
    size_m: float,
    width_m: float,
    ceiling_m: float,
    depth_m: float,
    feet: Collection[Point],
) -> list[Placement]:
    """Return the beam nodes at corners without a column: in lanes, at walls, and where a column is set back."""
    cells = np.pad(structure.cells, 1, constant_values=Cell.OBSTACLE)
    rows, cols = structure.shape
    nodes: list[Placement] = []
    for row, col in product(range(rows + 1), range(cols + 1)):
        around = cells[row : row + 2, col : col + 2]
        inside = around != Cell.OBSTACLE
        boxes = _node_boxes(tuple(inside.ravel().tolist()), size_m, width_m)
        has_column = inside.all() and (around == Cell.FREE).any()
        corner = structure.column_edges_m[col], structure.row_edges_m[row]
        if not boxes or (has_column and tuple(map(float, corner)) in feet):
            continue
        down, right = np.argwhere(inside)[0].tolist()
        name = f"BeamNode_{_CORNERS[down, right]}"
        position = (float(structure.column_edges_m[col]), ceiling_m, float(structure.row_edges_m[row]))
        square = (row - 1 + down, col - 1 + right)
        nodes.append(Placement(name, BeamNodeSpec(boxes, depth_m), position, 0.0, square))
    return nodes


@lru_cache(maxsize=64)
def _node_boxes(inside: tuple[bool, bool, bool, bool], size_m: float, width_m: float) -> tuple[Box, ...]:
    """Return the rectangles (left, top, right, bottom) of a node, by the inside flags of the four squares around it.

    The arm along X is continuous; the arms along Z end at its sides.
    """
    up_left, up_right, down_left, down_right = inside
    half, end = width_m / 2, size_m / 2
    left, right = up_left and down_left, up_right and down_right
    up, down = up_left and up_right, down_left and down_right
    # the strip of the arms along X, above and below the line
    spans = []
    for side_left, side_right, low, high in ((up_left, up_right, -half, 0.0), (down_left, down_right, 0.0, half)):
        begin = (-end if left else -half) if side_left else 0.0
        finish = (end if right else half) if side_right else 0.0
        has_arm = left or right or (up if low < 0 else down)
        if begin < finish and has_arm:
            spans.append((begin, low, finish, high))
    if len(spans) == 2 and (spans[0][0], spans[0][2]) == (spans[1][0], spans[1][2]):  # noqa: PLR2004
        spans = [(spans[0][0], -half, spans[0][2], half)]
    if up:
        spans.append((-half, -end, half, -half))
    if down:
        spans.append((-half, half, half, end))
    rounded = ((round(x0, 6), round(z0, 6), round(x1, 6), round(z1, 6)) for x0, z0, x1, z1 in spans)
    return tuple(rounded) if left or right or up or down else ()
