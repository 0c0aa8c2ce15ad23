"""Flat pieces of floor with their markings, partitioned so that nothing lies on anything else."""

from collections import defaultdict
from dataclasses import dataclass
from enum import StrEnum
from functools import cached_property

import shapely

from garage2usd.assets.flat import GRID_M, flat_part
from garage2usd.assets.mesh import Asset, pascal_case
from garage2usd.objects.kind import Spec
from garage2usd.objects.outline import Polygon

__all__ = ["Marking", "PanelSpec", "Surface"]


class Surface(StrEnum):
    """What a floor panel is coated with."""

    LANE = "lane"
    STALL = "stall"
    STALL_EV = "stall_ev"
    STALL_ACCESSIBLE = "stall_accessible"
    PAINT_WHITE = "paint_white"
    PAINT_YELLOW = "paint_yellow"


_MATERIALS = {
    Surface.LANE: "floor_concrete",
    Surface.STALL: "stall_epoxy",
    Surface.STALL_EV: "stall_green",
    Surface.STALL_ACCESSIBLE: "stall_blue",
    Surface.PAINT_WHITE: "paint_white",
    Surface.PAINT_YELLOW: "paint_yellow",
}


@dataclass(frozen=True)
class Marking:
    """A painted polygon on a floor panel."""

    polygon: Polygon
    surface: Surface


@dataclass(frozen=True)
class PanelSpec(Spec):
    """A flat piece of floor with its markings; origin in its middle.

    Attributes
    ----------
    width_m, depth_m
        Extent along X and Z.
    surface
        Coating where nothing is marked.
    markings
        Painted polygons that do not overlap; each surface becomes a mesh of its own in the same plane.
    openings
        Polygons where other panels lie, free of this one.
    """

    width_m: float
    depth_m: float
    surface: Surface
    markings: tuple[Marking, ...] = ()
    openings: tuple[Polygon, ...] = ()

    def __hash__(self) -> int:
        """As of any frozen value, but kept: the polygons are many and every object is looked up by its spec."""
        return self._hash

    @cached_property
    def _hash(self) -> int:
        return hash((self.width_m, self.depth_m, self.surface, self.markings, self.openings))

    def asset(self) -> Asset:
        """Coating and paint, each a level sheet."""
        by_material: dict[str, list[shapely.Polygon]] = defaultdict(list)
        for marking in self.markings:
            by_material[_MATERIALS[marking.surface]].append(shapely.Polygon(marking.polygon))
        areas = {material: shapely.union_all(shapes, grid_size=GRID_M) for material, shapes in by_material.items()}
        base = shapely.box(-self.width_m / 2, -self.depth_m / 2, self.width_m / 2, self.depth_m / 2)
        openings = shapely.union_all([shapely.Polygon(shape) for shape in self.openings])
        base = shapely.difference(base, openings, grid_size=GRID_M)
        areas = {material: shapely.intersection(area, base, grid_size=GRID_M) for material, area in areas.items()}
        base = shapely.difference(base, shapely.union_all(list(areas.values())), grid_size=GRID_M)
        return Asset(
            tuple(
                flat_part(pascal_case(material), area, material)
                for material, area in [(_MATERIALS[self.surface], base), *areas.items()]
                if area.area > 0
            )
        )
