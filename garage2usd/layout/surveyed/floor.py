"""The floor panels, numbered stalls and ceiling beams of a surveyed garage, on the tiles that group its objects."""

from collections import Counter
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import replace
from itertools import count

import numpy as np
import shapely
from numpy.typing import NDArray

from garage2usd.assets.lettering import lacks, unpainted
from garage2usd.config import BayConfig
from garage2usd.config.font_file import FontFile
from garage2usd.layout.ceiling.beams import beams
from garage2usd.layout.placement import PlacedStall, Placement, of_spec
from garage2usd.layout.surveyed.ground import OFF_LINE_M, SurveyedGround
from garage2usd.layout.tiles import LEAST_FLOOR_M2
from garage2usd.objects.floor import FloorSpec
from garage2usd.objects.panel import Marking, PanelSpec, Surface
from garage2usd.structure.lane_graph import StallType
from garage2usd.structure.stalls import Edge
from garage2usd.survey.fitted_stalls import FittedStall

_BEAMS = -3
"""First number of the pairs by which beams are known until they are put on their tiles."""
_OUTWARDS = {Edge.UP: (0.0, -1.0), Edge.DOWN: (0.0, 1.0), Edge.LEFT: (-1.0, 0.0), Edge.RIGHT: (1.0, 0.0)}


def surveyed_floor(
    ground: SurveyedGround, panels: Iterable[Placement], stalls: Sequence[PlacedStall], opened: shapely.Geometry
) -> Iterator[Placement]:
    """Yield the floor panel of each tile, with openings for stalls, for ramps, and for the ground outside the outline.

    A tile that is all stalls has none. The markings are those of the panels of the floor's pieces, as far as they lie
    on the tile and outside the stalls; where pieces overlap, those of the first one.
    """
    stall_panels = shapely.STRtree([shapely.Polygon(stall.corners_m()) for stall in stalls])
    taken = stall_panels.geometries
    paints = list(_paints(panels))
    painted = shapely.STRtree([shape for shape, _ in paints])
    for tile in ground:
        near = sorted(stall_panels.query(tile.box).tolist())
        openings = [shape for index in near for shape in tile.local(taken[index])]
        openings += tile.local(shapely.difference(tile.box, ground.polygon))
        openings += tile.local(opened) if opened.intersects(tile.box) else []
        closed = shapely.union_all([shapely.Polygon(opening) for opening in openings])
        if closed.area > tile.box.area - LEAST_FLOOR_M2:
            continue
        markings = [
            Marking(polygon, paint.surface, paint.paint)
            for index in sorted(painted.query(tile.box).tolist())
            for shape, paint in [paints[index]]
            for polygon in tile.local(shapely.difference(shape, shapely.union_all(taken[near])))
        ]
        spec = FloorSpec(round(tile.width_m, 6), round(tile.depth_m, 6), Surface.LANE, tuple(markings), tuple(openings))
        x, z = tile.middle_m
        yield Placement("Floor", spec, (x, 0.0, z), square=tile.square)


def _paints(panels: Iterable[Placement]) -> Iterator[tuple[shapely.Geometry, Marking]]:
    """Yield the markings of panels as ground (x, z), each without that of the panels before it."""
    before: list[shapely.Polygon] = []
    for panel, spec in of_spec(panels, PanelSpec):
        x, z = spec.width_m / 2, spec.depth_m / 2
        outline = shapely.Polygon([panel.to_world(corner) for corner in ((-x, -z), (x, -z), (x, z), (-x, z))])
        over = shapely.union_all([ground for ground in before if ground.intersects(outline)])
        for marking in spec.markings:
            shape = shapely.Polygon([panel.to_world(corner) for corner in marking.polygon])
            yield shapely.difference(shape, over), marking
        before.append(outline)


def surveyed_beams(
    ground: SurveyedGround, bay: BayConfig, ceiling_m: float, depth_m: float, pillars: Sequence[Placement]
) -> list[Placement]:
    """Place beams along the rows of columns in both directions, from wall to wall, as under a plan's squares.

    Parameters are those of `garage2usd.layout.ceiling.beams.beams`.
    """
    fields = ground.fields
    if fields is None:
        return []
    lines = fields.column_edges_m, fields.row_edges_m
    snapped = [_on_lines(place, lines) for place in pillars]
    found = beams(fields, bay, ceiling_m, depth_m, snapped)
    return [replace(place, square=(_BEAMS, number)) for number, place in enumerate(found)]


def _on_lines(place: Placement, lines: tuple[NDArray[np.float64], NDArray[np.float64]]) -> Placement:
    """Return a column moved onto the nearest lines, if it is near them."""
    x, y, z = place.position_m
    at = [float(own[np.argmin(np.abs(own - value))]) for own, value in zip(lines, (x, z), strict=True)]
    if abs(at[0] - x) > OFF_LINE_M or abs(at[1] - z) > OFF_LINE_M:
        return place
    return replace(place, position_m=(at[0], y, at[1]))


def placed_stalls(
    fitted: Iterable[FittedStall], ground: SurveyedGround, font: FontFile | None
) -> tuple[tuple[PlacedStall, ...], tuple[FittedStall, ...]]:
    """Return the stalls in reading order of their tiles, with numbers, and the fitted stalls likewise.

    Stalls whose number `font` or the lettering cannot paint as it is written have a note.
    """
    fitted = list(fitted)
    square_of = [ground.square_at(stall.shape.centre) for stall in fitted]
    numbers = _numbers(fitted)
    order = sorted(range(len(fitted)), key=lambda index: (square_of[index], index))
    ordinals: Counter[tuple[int, int]] = Counter()
    stalls = []
    for index in order:
        stall, square = fitted[index], square_of[index]
        shape = stall.shape
        ordinals[square] += 1
        out_x, out_z = shape.outwards
        stalls.append(
            PlacedStall(
                square=square,
                ordinal=ordinals[square],
                edge=max(Edge, key=lambda edge: _OUTWARDS[edge][0] * out_x + _OUTWARDS[edge][1] * out_z),
                stall_type=StallType.TYPE_3,
                centre_m=shape.centre,
                width_m=shape.width_m,
                length_m=shape.length_m,
                yaw_rad=shape.yaw_rad,
                use=stall.source.use,
                number=numbers[index] if stall.source.use.takes_cars else "",
                angle_deg=shape.angle_deg,
                turn=shape.turn,
                size=stall.source.size.value,
            )
        )
    return tuple(stalls), tuple(_noted(fitted[index], numbers[index], font) for index in order)


def _noted(stall: FittedStall, number: str, font: FontFile | None) -> FittedStall:
    """Return a stall with a note if its number cannot be painted, or if the user's font lacks a part of it."""
    if lacking := unpainted(number, font):
        has_it = "the lettering has" if font is None else "the lettering and the font have"
        note = f"its number '{number}' is not painted, as {has_it} no {lacking}; look.font may name a font that has it"
    elif font is not None and (lacking := lacks(number, font)):
        note = f"its number '{number}' is not all in the font, which has no {lacking}"
    else:
        return stall
    return replace(stall, note=f"{stall.note}; {note}" if stall.note else note)


def _numbers(fitted: Iterable[FittedStall]) -> list[str]:
    """Return the number of each stall: as the survey gives it, also twice; where it gives none, the next that is free.

    Stalls in which nobody parks need none. Without any number in the survey, all stalls are counted.
    """
    stalls = [stall.source for stall in fitted]
    taken = {stall.number for stall in stalls}
    if taken <= {""}:
        return [f"{number:02d}" for number in range(1, len(stalls) + 1)]
    free = (text for number in count(1) if (text := f"{number:02d}") not in taken and str(number) not in taken)
    return [stall.number if stall.number or not stall.use.is_parked_in else next(free) for stall in stalls]
