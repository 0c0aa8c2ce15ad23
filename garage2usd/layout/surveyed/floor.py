"""Floor panels of a surveyed garage: those of its pieces, laid on the tiles that group its objects."""

from collections.abc import Iterable, Iterator, Sequence

import shapely

from garage2usd.layout.placement import PlacedStall, Placement, of_spec
from garage2usd.layout.surveyed.ground import SurveyedGround
from garage2usd.objects.floor import FloorSpec
from garage2usd.objects.panel import Marking, PanelSpec, Surface

__all__ = ["surveyed_floor"]

_LEAST_FLOOR_M2 = 0.01


def surveyed_floor(
    ground: SurveyedGround, panels: Iterable[Placement], stalls: Sequence[PlacedStall]
) -> Iterator[Placement]:
    """Yield the floor panel of each tile, with openings for the stalls and for what lies outside the outline.

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
        closed = shapely.union_all([shapely.Polygon(opening) for opening in openings])
        if closed.area > tile.box.area - _LEAST_FLOOR_M2:
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
