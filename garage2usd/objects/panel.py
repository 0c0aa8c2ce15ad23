"""Floor panels: flat pieces of floor partitioned by their markings, so that no face covers another."""

from collections import defaultdict
from dataclasses import dataclass
from enum import StrEnum
from functools import cached_property

import numpy as np
import shapely

from garage2usd.assets.flat import GRID_M, flat_part, level_triangles
from garage2usd.assets.mesh import MIN_AREA_M2, WELD_DECIMALS, Asset, pascal_case
from garage2usd.objects.kind import Polygon, Spec


class Surface(StrEnum):
    """The coating of a floor panel."""

    LANE = "lane"
    STALL = "stall"
    STALL_EV = "stall_ev"
    STALL_ACCESSIBLE = "stall_accessible"
    PAINT_WHITE = "paint_white"
    PAINT_YELLOW = "paint_yellow"
    PAINT_WHITE_WORN = "paint_white_worn"
    PAINT_STALL = "paint_stall"
    PAINT_STALL_WORN = "paint_stall_worn"
    PAINT_EDGE = "paint_edge"
    PAINT_BAND = "paint_band"
    PAINT_GHOST = "paint_ghost"


_MATERIALS = {
    Surface.LANE: "floor_concrete",
    Surface.STALL: "stall_epoxy",
    Surface.STALL_EV: "stall_green",
    Surface.STALL_ACCESSIBLE: "stall_blue",
    Surface.PAINT_WHITE: "paint_white",
    Surface.PAINT_YELLOW: "paint_yellow",
    Surface.PAINT_WHITE_WORN: "paint_white_worn",
    Surface.PAINT_STALL: "paint_stall",
    Surface.PAINT_STALL_WORN: "paint_stall_worn",
    Surface.PAINT_EDGE: "paint_edge",
    Surface.PAINT_BAND: "paint_band",
    Surface.PAINT_GHOST: "paint_ghost",
}


class Paint(StrEnum):
    """The semantic class of a marking painted on a floor panel."""

    STALL_LINE = "stall_line"
    LANE_LINE = "lane_line"
    LANE_ARROW = "lane_arrow"
    CROSSING = "crossing"
    HATCHING = "hatching"
    STALL_SYMBOL = "stall_symbol"


@dataclass(frozen=True)
class Marking:
    """A painted polygon on a floor panel.

    Attributes
    ----------
    polygon
        Polygon without holes.
    surface
        Paint or coating of the polygon.
    paint
        Semantic class; None for a part of the floor, such as coloured strips and traces of older lines.
    """

    polygon: Polygon
    surface: Surface
    paint: Paint | None


@dataclass(frozen=True)
class PanelSpec(Spec):
    """A floor panel: a flat piece of floor with its markings; origin in its middle.

    Attributes
    ----------
    width_m, depth_m
        Extent along X and Z.
    surface
        Coating of the unmarked floor.
    markings
        Painted polygons; each class and surface becomes one mesh in the same plane. The first class wins an overlap.
    openings
        Polygons cut out of the panel, where other panels lie.
    """

    width_m: float
    depth_m: float
    surface: Surface
    markings: tuple[Marking, ...] = ()
    openings: tuple[Polygon, ...] = ()

    def __hash__(self) -> int:
        """Return the cached hash of the floor panel, since hashing its many polygons is slow."""
        return self._hash

    @cached_property
    def _hash(self) -> int:
        return hash((self.width_m, self.depth_m, self.surface, self.markings, self.openings))

    @property
    def ground(self) -> shapely.Polygon:
        """The whole panel, openings too."""
        return shapely.box(-self.width_m / 2, -self.depth_m / 2, self.width_m / 2, self.depth_m / 2)

    def asset(self) -> Asset:
        """Make the meshes of a floor panel: coating and paints, each a level sheet."""
        groups: dict[tuple[Paint | None, Surface], list[shapely.Polygon]] = defaultdict(list)
        for marking in self.markings:
            groups[marking.paint, marking.surface].append(shapely.Polygon(marking.polygon))
        base = self.ground
        openings = shapely.union_all([shapely.Polygon(shape) for shape in self.openings])
        base = _level(shapely.difference(base, openings, grid_size=GRID_M))
        painted = []
        for (paint, surface), shapes in groups.items():
            area = _level(shapely.intersection(shapely.union_all(shapes, grid_size=GRID_M), base, grid_size=GRID_M))
            if _is_sheet(area):
                colour = surface.removeprefix("paint_")
                name = pascal_case(f"{paint}_{colour}" if paint else surface)
                painted.append(flat_part(name, area, _MATERIALS[surface], piece=paint or ""))
                base = _level(shapely.difference(base, area, grid_size=GRID_M))
        material = _MATERIALS[self.surface]
        coating = [flat_part(pascal_case(material), base, material)] if _is_sheet(base) else []
        return Asset((*coating, *painted))


def _level(shape: shapely.Geometry) -> shapely.Geometry:
    """Return the polygons of a shape, without the lines and points where paints only touch."""
    if shape.geom_type in {"Polygon", "MultiPolygon"}:
        return shape
    parts = shapely.get_parts(shape)
    return shapely.multipolygons(parts[shapely.get_dimensions(parts) == _AREA])


def _is_sheet(shape: shapely.Geometry) -> bool:
    """True if a shape has a face left after cutting; micrometres between corners of adjacent stalls may leave none."""
    if shape.area > _SURE_M2:
        return True
    corners = np.round(level_triangles(shape), WELD_DECIMALS) if shape.area > 0 else np.empty((0, 3, 2))
    ab, ac = corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]
    return bool((np.abs(ab[:, 0] * ac[:, 1] - ab[:, 1] * ac[:, 0]) > MIN_AREA_M2).any())


_SURE_M2 = 1e-3
_AREA = 2
"""Dimension of a polygon in shapely."""
