"""Floor panels of squares with their markings: lanes, portals, and the floor around stalls."""

import itertools
import math
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, replace
from typing import NamedTuple

import shapely

from garage2usd.common.randomness import Step
from garage2usd.config import BayConfig
from garage2usd.config.look import BandForm, MarkingsLook, Wear
from garage2usd.layout.draws import SquareDraws
from garage2usd.layout.egress.cores import Core
from garage2usd.layout.floor.guide_strips import ClosedSides, guide_strips, strip_depth_m
from garage2usd.layout.floor.markings import (
    LINE_WIDTH_M,
    arrow,
    corner_lines,
    dashes,
    edge_line,
    hatching,
    stripes,
    two_way_arrows,
    zebra,
)
from garage2usd.layout.floor.stall_lines import (
    GHOST_ROWS,
    ghosts_on_lane,
    outer_round_lines,
    outer_spans,
    row_end_hatching,
)
from garage2usd.layout.placement import Placement, of_spec
from garage2usd.layout.tiles import (
    LEAST_FLOOR_M2,
    StallPlace,
    Tile,
    Tiles,
    lane_edges,
    row_polygon,
    row_strip,
)
from garage2usd.objects.floor import FloorSpec
from garage2usd.objects.kind import Polygon
from garage2usd.objects.panel import Marking, Paint, Surface
from garage2usd.structure.grid import Cell
from garage2usd.structure.lane_graph import Square
from garage2usd.structure.stalls import Edge

_WORN = {Surface.PAINT_WHITE: Surface.PAINT_WHITE_WORN}
_DRIVEN = {Cell.LANE, Cell.ENTRANCE, Cell.EXIT}
_DRAWS = 3
"""Random numbers of each square: presence and number of older lines, and presence of a lane crossing."""


class DrawnMarkings(NamedTuple):
    """Markings drawn by the seed.

    Attributes
    ----------
    ghosts
        Number of the older row visible at each square with stalls, if any.
    zebras
        Straight lane squares with a crossing that leads to no door.
    """

    ghosts: dict[Square, int]
    zebras: frozenset[Square]


def drawn_markings_of(grid: Tiles, look: MarkingsLook, draws: SquareDraws) -> DrawnMarkings:
    """Draw older lines and crossings from independent numbers of each square, so that squares stay independent."""
    if not look.ghosts and not look.zebra:
        return DrawnMarkings({}, frozenset())
    numbers = draws.of_step(Step.FLOOR_MARKINGS, _DRAWS)
    ghosts, zebras = {}, []
    for tile in grid:
        shows, row, crosses = numbers[tile.square].tolist()
        if grid.has_upright_stalls(tile.square) and shows < look.ghosts:
            ghosts[tile.square] = int(row * GHOST_ROWS)
        elif tile.cell is Cell.LANE and tile.axis_is_x is not None and crosses < look.zebra:
            zebras.append(tile.square)
    return DrawnMarkings(ghosts, frozenset(zebras))


@dataclass(frozen=True)
class _Panels:
    """Common inputs of all floor panels of a garage."""

    grid: Tiles
    bay: BayConfig
    look: MarkingsLook
    drawn: DrawnMarkings

    def markings(
        self, tile: Tile, *, has_bump: bool, crossing_m: float | None, core: Core | None
    ) -> tuple[Marking, ...]:
        """Markings of one square's floor."""
        if tile.cell is Cell.LANE:
            return tuple(self._lane(tile, has_bump=has_bump, crossing_m=crossing_m))
        if tile.cell is not Cell.FREE:
            return (*self._strips(tile), *self._portal(tile))
        places = self.grid.stall_places.get(tile.square, [])
        if core is not None:
            landing = stripes(*core.landing(tile)) if core.has_door else ()
            return (*self._row_ends(tile, places), *landing)
        if self.grid.is_bare(tile):
            return hatching(tile.half_x_m, tile.half_z_m)
        hatched = row_end_hatching(tile, places, self.look) if self.look.hatching else ()
        return (*self._row_ends(tile, places), *hatched)

    def openings(self, tile: Tile) -> tuple[Polygon, ...]:
        """Openings of a square's floor, at its stalls."""
        return self.grid.openings(tile) if tile.cell is Cell.FREE else ()

    def _row_ends(self, tile: Tile, places: list[StallPlace]) -> Iterator[Marking]:
        """Outer halves of the stall lines at sides without a neighbouring stall."""
        half_line = self.look.line_width_m / 2
        for place in places:
            row, start = place.row, place.row.starts_m[place.slot]
            spans = outer_spans(row.shape.depth_m, self.look)
            ends = [start - half_line] * place.is_first + [start + row.shape.pitch_m] * place.is_last
            for end, span in itertools.product(ends, spans):
                shape = row_strip(tile, row, end, end + half_line, span)
                yield Marking(shape, Surface.PAINT_STALL, Paint.STALL_LINE)
            # along an angled row, both directions are longer than across the stall and down the row
            slant = math.hypot(1.0, row.shape.slope)
            outer = outer_round_lines(row.shape.pitch_m / slant, row.shape.depth_m * slant, self.look)
            sides = [(start, -slant)] * place.is_first + [(start + row.shape.pitch_m, slant)] * place.is_last
            for (side, away), marking in itertools.product(sides, outer):
                points = [(side + away * beyond, inwards / slant) for beyond, inwards in marking.polygon]
                yield replace(marking, polygon=row_polygon(tile, row, points))

    def _lane(self, tile: Tile, *, has_bump: bool, crossing_m: float | None) -> Iterator[Marking]:
        half_x, half_z = tile.half_x_m, tile.half_z_m
        if self.look.band is BandForm.NONE:
            yield from self._edge_lines(tile)
        else:
            yield from self._strips(tile)
        along_x, setback = tile.axis_is_x, max(self.grid.setback_m, strip_depth_m(self.look) - LINE_WIDTH_M)
        if crossing_m is None and tile.square in self.drawn.zebras and not has_bump:
            crossing_m = 0.0
        if along_x is not None and crossing_m is not None:
            yield from zebra(half_x, half_z, setback, along_x=along_x, offset_m=crossing_m)
        elif along_x is not None and not has_bump:
            if tile.way is None:
                yield from map(self._driven, dashes(half_x, half_z, along_x=along_x))
            if sum(tile.square) % 2 == 0 and tile.way is not None:
                yield self._driven(arrow(0.0, 0.0, tile.way))
            elif sum(tile.square) % 2 == 0:
                arrows = two_way_arrows(half_x, half_z, self.grid.setback_m, along_x=along_x)
                yield from map(self._driven, arrows)
        yield from self._ghosts(tile)

    def _driven(self, marking: Marking) -> Marking:
        """Increase the wear of paint in the middle of a lane."""
        worn = _WORN.get(marking.surface) if self.look.wear is Wear.WORN else None
        return replace(marking, surface=worn) if worn else marking

    def _edge_lines(self, tile: Tile) -> Iterator[Marking]:
        """Yellow lines along closed edges without stalls, and around columns."""
        half_x, half_z, setback = tile.half_x_m, tile.half_z_m, self.grid.setback_m
        for edge in Edge:
            if not tile.drivable[edge] and not tile.stall_mouths[edge]:
                low, high = (_trim(tile, edge, side, setback) for side in edge.ends)
                yield edge_line(edge, half_x, half_z, setback, (low, high))
        for vertical, horizontal in sorted(self._around(tile).corners):
            yield from corner_lines(vertical, horizontal, half_x, half_z, setback)

    def _strips(self, tile: Tile) -> tuple[Marking, ...]:
        return guide_strips(
            self._around(tile), tile.half_x_m, tile.half_z_m, self.look, has_pictogram=sum(tile.square) % 2 == 0
        )

    def _around(self, tile: Tile) -> ClosedSides:
        """Closed edges and corners of a square; a door is open."""
        is_open = {edge for edge in Edge if tile.drivable[edge] or self.grid.doors.get(tile.square) is edge}
        corners = set()
        for corner in itertools.product((Edge.UP, Edge.DOWN), (Edge.LEFT, Edge.RIGHT)):
            beyond = self.grid.neighbour(tile, *corner)
            if is_open.issuperset(corner) and (beyond is None or beyond.cell not in _DRIVEN):
                corners.add(corner)
        return ClosedSides(frozenset(Edge) - is_open, frozenset(corners))

    def _portal(self, tile: Tile) -> Iterator[Marking]:
        """Arrows on a portal: inwards on an entrance, outwards on an exit."""
        inwards = lane_edges(tile)[0]
        yield self._driven(arrow(0.0, 0.0, inwards if tile.cell is Cell.ENTRANCE else inwards.opposite))

    def _ghosts(self, tile: Tile) -> Iterator[Marking]:
        """Ghost lines in front of the stalls at a lane square's edges."""
        for edge in Edge:
            other = self.grid.neighbour(tile, edge)
            beyond = other.square if other is not None else None
            if not tile.stall_mouths[edge] or beyond not in self.drawn.ghosts:
                continue
            count = max(place.row.count for place in self.grid.stall_places[beyond])
            shape, half = self.grid.stall_places[beyond][0].row.shape, (tile.half_x_m, tile.half_z_m)
            stall = shape.width_m, shape.length_m
            row_half = count * shape.width_m / 2
            yield from ghosts_on_lane(self.drawn.ghosts[beyond], edge, half, row_half, stall, self.look.line_width_m)


def floor_panels(
    grid: Tiles,
    look: MarkingsLook,
    drawn: DrawnMarkings,
    *,
    bumps: Iterable[Placement],
    crossings: Mapping[Square, float],
    cores: Mapping[Square, Core],
) -> list[Placement]:
    """Make the floor panel of each square with its markings, with openings for stalls.

    Parameters
    ----------
    grid
        Squares of the garage in metres.
    look, drawn
        Settings of the look, and the drawn markings.
    bumps
        The speed bumps.
    crossings
        Positions of the crossings to the doors of cores, in metres along their lanes from the square's centre.
    cores
        Cores among stalls by their squares; their landings are kept free of markings.
    """
    panels = _Panels(grid, grid.bay, look, drawn)
    placements, with_bump = [], {bump.square for bump in bumps}
    for tile in grid:
        square = tile.square
        markings = panels.markings(
            tile, has_bump=square in with_bump, crossing_m=crossings.get(square), core=cores.get(square)
        )
        spec = FloorSpec(tile.width_m, tile.depth_m, Surface.LANE, markings, panels.openings(tile))
        placements.append(Placement("Floor", spec, (tile.x_m, 0.0, tile.z_m), tile.yaw_rad, square))
    return placements


def with_floor(panels: Iterable[Placement]) -> Iterator[Placement]:
    """Yield the floor panels of squares without those that are all openings, for angled stalls on both sides."""
    for panel, spec in of_spec(panels, FloorSpec):
        open_m2 = sum(shapely.Polygon(opening).area for opening in spec.openings)
        if open_m2 < spec.width_m * spec.depth_m - LEAST_FLOOR_M2:
            yield panel


def _trim(tile: Tile, edge: Edge, side: Edge, setback: float) -> float:
    """Trim of an edge line at the end on `side`, so that lines meet in a corner without overlap."""
    if tile.drivable[side]:
        return 0.0
    runs_behind = not edge.along_x and not tile.stall_mouths[side]
    return setback + (LINE_WIDTH_M if runs_behind else 0.0)
