"""Stalls of a drawing: rings, blocks and cells between lines of the size of stalls, in the unit that gives them."""

from collections import Counter, defaultdict
from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
import shapely
from numpy.typing import NDArray

from garage2usd.garage import Point
from garage2usd.survey.drawing_words import PartKind
from garage2usd.survey.dxf_drawing import Drawing, DrawnShape
from garage2usd.survey.stall_cells import quad_corners, stall_cells, stall_corners
from garage2usd.survey.survey import Unplaced
from garage2usd.survey.text import MOST_M

Floats = NDArray[np.float64]

_UNITS = {"millimetres": 0.001, "metres": 1.0, "centimetres": 0.01, "inches": 0.0254, "feet": 0.3048}
LEAST_STOREY_M = 1.8
"""Difference in height from which on stalls lie on different levels."""
_FEWEST = 4
"""Stalls on a layer from which on it is read as stalls whatever its name."""
_MOST_EXTENT_M, _MOST_UNNAMED = 5000.0, 20_000
"""Extent and number of shapes up to which a layer without a word for stalls is searched for these."""
_COMMON = 0.5
"""Share of a stall that another one covers if both are the same."""
_BESIDE_M, _SIDE_M = 0.15, 3.0
"""Distance between two stalls of a row, and the length of their common side."""


class FoundStall(NamedTuple):
    """A stall of a drawing: its name, corners (x, z) in metres, names of its layer and blocks, and height."""

    name: str
    corners: tuple[Point, ...]
    told: tuple[str, ...]
    height_m: float


class ShapesInMetres:
    """The shapes of a drawing in metres, (x, z), by the part that they are."""

    def __init__(self, drawing: Drawing, unit_m: float) -> None:
        self.unit_m = unit_m
        self._of: defaultdict[PartKind | None, list[tuple[DrawnShape, Floats]]] = defaultdict(list)
        for shape in drawing.shapes:
            points = shape.points * (unit_m, -unit_m)
            if np.abs(points).max() <= MOST_M:
                self._of[shape.kind].append((shape, points))

    def pairs(self, kind: PartKind | None, plan: shapely.Geometry | None = None) -> list[tuple[DrawnShape, Floats]]:
        """Return the shapes that are a part, on the ground of a plan."""
        if plan is None:
            return self._of[kind]
        return [(shape, points) for shape, points in self._of[kind] if plan.intersects(line_or_point(points))]

    def of(self, kind: PartKind, plan: shapely.Geometry | None, *, rings: bool = False) -> list[Floats]:
        """Return the lines of a part, those of rings closed, or only its rings, also those of joined lines."""
        pairs = self.pairs(kind, plan)
        lines = [np.concatenate([points, points[:1]]) if shape.is_closed else points for shape, points in pairs]
        if not rings:
            return [line for line, (shape, _) in zip(lines, pairs, strict=True) if not shape.is_filled] or lines
        closed = [line for line, (shape, _) in zip(lines, pairs, strict=True) if shape.is_closed]
        open_lines = [line for line, (shape, _) in zip(lines, pairs, strict=True) if not shape.is_closed]
        joined = shapely.polygonize([shapely.union_all([line_or_point(line) for line in open_lines if len(line) > 1])])
        return closed + [np.array(face.exterior.coords) for face in shapely.get_parts(joined)]


def line_or_point(points: Floats) -> shapely.Geometry:
    """Return points (x, z) as a line, or a single one as a point."""
    return shapely.LineString(points) if len(points) > 1 else shapely.Point(points[0])


def stalls_in_metres(drawing: Drawing, unread: list[Unplaced]) -> tuple[float, list[FoundStall]]:
    """Return the metres of the drawing's unit, and its stalls: in its own unit, or in the one that gives the most."""
    declared = drawing.unit_m
    found = _stalls(ShapesInMetres(drawing, declared), unread) if declared else []
    if found and declared:
        return declared, found
    best: tuple[int, str, float, list[FoundStall], list[Unplaced]] | None = None
    for name, unit_m in _UNITS.items():
        if unit_m != declared:
            notes: list[Unplaced] = []
            stalls = _stalls(ShapesInMetres(drawing, unit_m), notes, anywhere=declared is None)
            if stalls and (best is None or len(stalls) > best[0]):
                best = len(stalls), name, unit_m, stalls, notes
    if best is None:
        return declared or 1.0, []
    _, name, unit_m, found, notes = best
    told = "no unit" if declared is None else f"a unit of {declared:g} m, in which nothing has the size of a stall"
    unread += [*notes, Unplaced("$INSUNITS", f"{told}; read in {name}, by the size of its stalls")]
    return unit_m, found


def _stalls(shapes: ShapesInMetres, unread: list[Unplaced], *, anywhere: bool = True) -> list[FoundStall]:
    """Return the stalls on layers and of blocks that are named so, or else, if wanted, those on any layers."""
    walls = shapes.of(PartKind.WALL, None) + shapes.of(PartKind.OUTLINE, None)
    named: defaultdict[int, list[tuple[DrawnShape, Floats]]] = defaultdict(list)
    for shape, points in shapes.pairs(PartKind.STALL):
        named[round(shape.heights[0] * shapes.unit_m / LEAST_STOREY_M)].append((shape, points))
    found = [stall for pairs in named.values() for stall in _on_layers(pairs, walls, shapes.unit_m, odd=True)]
    if found or not anywhere:
        return found
    of_layers: defaultdict[str, list[tuple[DrawnShape, Floats]]] = defaultdict(list)
    for shape, points in shapes.pairs(None):
        of_layers[shape.layer].append((shape, points))
    for layer, pairs in sorted(of_layers.items()):
        extent_m = np.ptp(np.concatenate([points for _, points in pairs]), axis=0).max()
        if extent_m > _MOST_EXTENT_M or len(pairs) > _MOST_UNNAMED:
            continue
        stalls = _in_rows(_on_layers(pairs, walls, shapes.unit_m))
        if len(stalls) >= _FEWEST:
            found += stalls
            reason = f"a layer without a word for stalls; read as {len(stalls)} stalls by their size"
            unread.append(Unplaced(f"layer {layer}", reason))
    return _distinct(found)


def _on_layers(
    pairs: Sequence[tuple[DrawnShape, Floats]], walls: Sequence[Floats], unit_m: float, *, odd: bool = False
) -> list[FoundStall]:
    """Return the stalls of shapes: rings of their size, blocks, cells between lines, and rings of odd sizes."""
    found, lines, others = [], [], []
    groups: defaultdict[tuple[str, tuple[str, ...]], list[Floats]] = defaultdict(list)
    heights = [shape.heights[0] * unit_m for shape, _ in pairs]
    for (shape, points), height_m in zip(pairs, heights, strict=True):
        corners = stall_corners(points.tolist()) if shape.is_closed else None
        if corners is not None:
            found.append(FoundStall(shape.name, corners, shape.told, height_m))
        elif not shape.is_filled and len(points) > 1:
            lines.append(np.concatenate([points, points[:1]]) if shape.is_closed else points)
            if odd and shape.is_closed and (corners := quad_corners(points.tolist())) is not None:
                others.append(FoundStall(shape.name, corners, shape.told, height_m))
            if shape.name.startswith("INSERT"):
                groups[shape.name, shape.told].append(points)
    common = Counter(shape.told for shape, _ in pairs).most_common(1)
    told, height_m = (common[0][0], float(np.median(heights))) if common else ((), 0.0)
    for corners in stall_cells(lines, walls):
        x, z = np.mean(corners, axis=0)
        found.append(FoundStall(f"the stall at x {x:.1f} m, y {-z:.1f} m", corners, told, height_m))
    for (name, names), members in groups.items():
        around = shapely.oriented_envelope(shapely.MultiPoint(np.concatenate(members)))
        corners = stall_corners(around.exterior.coords) if around.geom_type == "Polygon" else None
        if corners is not None:
            found.append(FoundStall(name, corners, names, height_m))
    return _distinct([*found, *others] if found else [])


def _distinct(found: Sequence[FoundStall]) -> list[FoundStall]:
    """Return stalls without those that lie on an earlier one for the greater part."""
    grounds = [shapely.Polygon(stall.corners) for stall in found]
    tree = shapely.STRtree(grounds)
    kept: list[int] = []
    gone: set[int] = set()
    for number, ground in enumerate(grounds):
        if number in gone:
            continue
        kept.append(number)
        for other in tree.query(ground, predicate="intersects").tolist():
            is_level = abs(found[other].height_m - found[number].height_m) < LEAST_STOREY_M
            if (
                other > number
                and is_level
                and ground.intersection(grounds[other]).area > _COMMON * min(ground.area, grounds[other].area)
            ):
                gone.add(other)
    return [found[number] for number in kept]


def _in_rows(found: Sequence[FoundStall]) -> list[FoundStall]:
    """Return the stalls that share a side with another one, as lamps and desks of their size do not."""
    grounds = np.array([shapely.Polygon(stall.corners) for stall in found])
    if len(grounds) == 0:
        return []
    first, second = shapely.STRtree(grounds).query(grounds, predicate="dwithin", distance=_BESIDE_M)
    wider = shapely.buffer(grounds[first], _BESIDE_M, join_style="mitre")
    common_m = shapely.length(shapely.intersection(wider, shapely.boundary(grounds[second])))
    beside = {
        int(one)
        for one, other, length_m in zip(first, second, common_m, strict=True)
        if one != other and length_m > _SIDE_M
    }
    return [stall for number, stall in enumerate(found) if number in beside]
