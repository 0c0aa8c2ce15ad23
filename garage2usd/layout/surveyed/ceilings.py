"""Ceilings of a surveyed garage, open over the ramps to the level above."""

from collections.abc import Iterator
from dataclasses import replace
from typing import NamedTuple

import shapely

from garage2usd.config import GarageConfig
from garage2usd.layout.placement import Placement, placed
from garage2usd.layout.surveyed.ground import GroundTile, SurveyedGround
from garage2usd.layout.tiles import CEILING_THICKNESS_M, LEAST_FLOOR_M2
from garage2usd.objects.ceiling import CeilingSpec, OpenCeilingSpec

_UNDER_FLOOR_M = 0.02
"""Distance of a ceiling slab's upper face from a floor above that covers a part of it."""


class FloorAbove(NamedTuple):
    """The level above a surveyed one: height of its floor over that of this level, its ground and its openings."""

    storey_m: float
    ground: shapely.Geometry
    openings: shapely.Geometry


def surveyed_ceiling(ground: SurveyedGround, config: GarageConfig, above: FloorAbove | None) -> Iterator[Placement]:
    """Yield the ceiling slab over the part of each tile inside the outline; its upper face may be a floor."""
    ceiling_m = config.fittings.ceiling_height_m
    for tile in ground:
        left, back, right, front = shapely.intersection(tile.box, ground.polygon).bounds
        spec = CeilingSpec(round(right - left, 6), round(front - back, 6), CEILING_THICKNESS_M)
        if above is not None:
            room_m = round(above.storey_m - ceiling_m, 6)
            box = shapely.box(left, back, right, front)
            if above.openings.intersects(box):
                yield from _open_ceiling(tile, ground, above, config)
                continue
            if above.ground.covers(box):
                spec = replace(spec, thickness_m=room_m, bears_floor=True)
            else:
                spec = replace(spec, thickness_m=min(spec.thickness_m, round(room_m - _UNDER_FLOOR_M, 6)))
        place = (left + right) / 2, (back + front) / 2
        yield placed("Ceiling", spec, place, height_m=ceiling_m, square=tile.square)


def _open_ceiling(
    tile: GroundTile, ground: SurveyedGround, above: FloorAbove, config: GarageConfig
) -> Iterator[Placement]:
    """Yield the ceiling slab of a tile around the openings in the floor above."""
    thickness_m = round(above.storey_m - config.fittings.ceiling_height_m - _UNDER_FLOOR_M, 6)
    openings = tile.local(above.openings) + tile.local(shapely.difference(tile.box, ground.polygon))
    spec = OpenCeilingSpec(
        round(tile.width_m, 6), round(tile.depth_m, 6), thickness_m, bears_floor=False, openings=tuple(openings)
    )
    if spec.ground.area > LEAST_FLOOR_M2:
        ceiling_m = config.fittings.ceiling_height_m
        yield placed("Ceiling", spec, tile.middle_m, height_m=ceiling_m, square=tile.square)
