"""Where things hang on walls, columns and cores: on faces that neither a stall nor a carriageway nor a door needs."""

from collections.abc import Iterable, Iterator, Sequence
from typing import NamedTuple

import numpy as np
import shapely
from numpy.typing import NDArray

from garage2usd.assets import pascal_case
from garage2usd.config import GarageConfig
from garage2usd.layout.egress.cores import Core
from garage2usd.layout.grounds import Grounds, grounds_of
from garage2usd.layout.nearness import Points
from garage2usd.layout.placement import (
    PlacedStall,
    Placement,
    cos_sin,
    edge_yaw_rad,
    of_spec,
    placed,
    rounded,
    to_world,
)
from garage2usd.layout.tiles import Tile, TileGrid
from garage2usd.objects import MOUNTED, Mounted
from garage2usd.objects.column import ColumnSpec
from garage2usd.objects.obstacle import ObstacleSpec
from garage2usd.objects.outline import Point, Polygon, rectangle
from garage2usd.objects.wall import WallSpec
from garage2usd.structure.grid import NEIGHBOUR_STEPS, Cell
from garage2usd.structure.stalls import Edge

__all__ = ["carriageway", "core_and_landing", "mounted_objects"]

_APPROACH_M = 0.6
"""What is kept free in front, so that people get there."""
_OVERHANG_M = 0.05
"""How much wider than a column's side something on it may be, in all: on both sides alike, or on one."""
_SLACK_M = 1.0
"""How much nearer than asked something hangs, as only the middles of stalls and lanes are measured."""
_PITCH_M = 1.0
"""Of the places along a wall."""
_APART = 0.5
"""How far objects of a kind hang from each other where they can, as a share of their reach."""
_LEAST_APART_M = 3.0
"""The same wherever they hang: two side by side, or on one column, serve no more than one does."""
_TOUCH_M = 1e-3


class _Face(NamedTuple):
    """A place on a column, a wall or a block: the foot of its middle, the way that it looks, its width, its name.

    At the edge of a column hangs only what is wider than its side, which is the least width then. Of a free place also
    whether it is beside a lane, and the ground that what hangs there takes.
    """

    place: Point
    yaw_rad: float
    width_m: float
    name: str
    wider_than_m: float = 0.0
    is_on_lane: bool = False
    foot: shapely.Polygon | None = None


def mounted_objects(
    grid: TileGrid,
    pillars: Iterable[Placement],
    walls: Iterable[Placement],
    blocks: Iterable[Placement],
    stalls: Sequence[PlacedStall],
    cores: Iterable[Core],
    standing: Iterable[Placement],
    config: GarageConfig,
) -> list[Placement]:
    """Everything that hangs on columns, walls and cores, each kind so that every place has enough of it within reach.

    Parameters
    ----------
    grid, pillars, walls, blocks, stalls, cores
        The garage; blocks are its obstacles and stair cores. Things hang beside lanes only where no other face serves.
    standing
        What else stands on squares without stalls.
    config
        Which kinds there are, and how far each serves by the profile.

    Notes
    -----
    A greedy set cover (Chvatal 1979): of all free faces within reach of the first stall or lane in reading order that
    is not yet served, the one that serves most of the places in need is taken. A place without a free face in reach
    stays unserved.
    """
    pillars, walls, blocks = tuple(pillars), tuple(walls), tuple(blocks)
    faces = [*_column_faces(pillars), *_wall_faces(walls), *_block_faces(blocks)]
    driven = [carriageway(tile, grid.setback_m) for tile in grid if tile.cell is not Cell.FREE]
    parked = shapely.buffer(grounds_of([stall.corners_m() for stall in stalls]), -_TOUCH_M / 2, join_style="mitre")
    taken = [core_and_landing(core) for core in cores] + _outlines((*pillars, *walls, *blocks, *standing))
    used = np.concatenate([parked, grounds_of(taken)])
    lanes = [tile.middle_m for tile in grid if tile.cell is Cell.LANE]
    places = np.array([stall.centre_m for stall in stalls] + lanes)
    objects: list[Placement] = []
    for mounted in MOUNTED:
        if getattr(config.fittings, mounted.setting):
            free = _free_faces(mounted, faces, shapely.STRtree(driven), shapely.STRtree(used))
            clause = getattr(config.standard, mounted.clause)
            reach_m = (clause.amount if clause else mounted.reach_m) - _SLACK_M
            spacing = getattr(config.standard, mounted.spacing) if mounted.spacing else None
            spacing_m = spacing.amount - _SLACK_M if spacing else None
            hung = [_hung(mounted, face) for face in _covering(mounted, reach_m, spacing_m, free, places)]
            used = np.concatenate([used, grounds_of(_outlines(hung))])
            objects += hung
    return objects


def _column_faces(pillars: Iterable[Placement]) -> Iterator[_Face]:
    """The four faces of every column, each in its middle and at both ends of what may hang over its edges."""
    for pillar, spec in of_spec(pillars, ColumnSpec):
        for edge in Edge:
            yaw = edge_yaw_rad(edge)
            name = f"{pillar.name}_{edge.name.capitalize()}"
            for across, end in ((0.0, ""), (-_OVERHANG_M / 2, "_Left"), (_OVERHANG_M / 2, "_Right")):
                place = to_world((across, spec.size_m / 2), (pillar.position_m[0], pillar.position_m[2]), yaw)
                least_m = spec.size_m if end else 0.0
                yield _Face(rounded(place), yaw, spec.size_m + _OVERHANG_M, f"{name}{end}", least_m)


def _wall_faces(walls: Iterable[Placement]) -> Iterator[_Face]:
    """Places along every wall, a pitch apart, and where it meets the next one in its line."""
    ends: set[tuple[Point, float]] = set()
    for wall, spec in of_spec(walls, WallSpec):
        yaw, length = wall.yaw_rad, spec.length_m
        yield from _along((wall.position_m[0], wall.position_m[2]), yaw, length, wall.name)
        for across in (-length / 2, length / 2):
            end = rounded(wall.to_world((across, 0.0)))
            if (end, yaw) in ends:
                yield _Face(end, yaw, length, f"{wall.name}_End")
            ends.add((end, yaw))


def _block_faces(blocks: Iterable[Placement]) -> Iterator[_Face]:
    """Places along every side of an obstacle or a stair core, a pitch apart."""
    for block, spec in of_spec(blocks, ObstacleSpec):
        x, _, z = block.position_m
        is_along_x = cos_sin(block.yaw_rad)[1] == 0
        width, depth = (spec.width_m, spec.depth_m) if is_along_x else (spec.depth_m, spec.width_m)
        for edge in Edge:
            down, right = NEIGHBOUR_STEPS[edge]
            middle = x + right * width / 2, z + down * depth / 2
            name = f"{block.name}_{edge.name.capitalize()}"
            yield from _along(middle, edge_yaw_rad(edge), width if edge.along_x else depth, name)


def _along(middle: Point, yaw_rad: float, length_m: float, name: str) -> Iterator[_Face]:
    """Places a pitch apart on a face of a length, around its middle."""
    count = max(int(length_m / _PITCH_M), 1)
    for number in range(count):
        across = (number - (count - 1) / 2) * _PITCH_M
        place = rounded(to_world((across, 0.0), middle, yaw_rad))
        yield _Face(place, yaw_rad, length_m - 2 * abs(across), f"{name}_{number + 1}")


def _free_faces(
    mounted: Mounted, faces: Iterable[_Face], driven: shapely.STRtree, used: shapely.STRtree
) -> list[_Face]:
    """The faces that are wide enough, with ground before them on which nobody drives, parks or stands in the way."""
    left, right, depth = _extent_m(mounted)
    wide = [face for face in faces if face.wider_than_m < right - left <= face.width_m]
    feet = _before(wide, rectangle(left, _TOUCH_M, right, depth))
    approaches = _before(wide, rectangle(left, _TOUCH_M, right, depth + _APPROACH_M))

    def met(grounds: Grounds, tree: shapely.STRtree) -> set[int]:
        return set(tree.query(grounds, predicate="intersects")[0].tolist())

    taken, on_lanes = met(feet, driven) | met(approaches, used), met(approaches, driven)
    return [
        face._replace(is_on_lane=index in on_lanes, foot=feet[index])
        for index, face in enumerate(wide)
        if index not in taken
    ]


def _covering(
    mounted: Mounted, reach_m: float, spacing_m: float | None, faces: Sequence[_Face], places: NDArray[np.float64]
) -> list[_Face]:
    """As few faces as a greedy choice needs to serve all places that can be; places are (x, z), shape (n, 2).

    Where one has no other within its spacing then, one more is taken there.
    """
    if not faces or not len(places):
        return []
    beside = Points([face.place for face in faces])
    place_near, face_near, _ = beside.within(reach_m, places, norm=mounted.norm)
    within = _grouped(place_near, face_near, len(places))
    served = _grouped(face_near, place_near, len(faces))
    needed = np.full(len(places), mounted.count)
    feet = shapely.STRtree([face.foot for face in faces])
    chosen: dict[int, _Face] = {}
    near: set[int] = set()
    covered: set[int] = set()

    def worth(face: int) -> tuple[bool, bool, int]:
        return not faces[face].is_on_lane, face not in near, int((needed[served[face]] > 0).sum())

    def take(face: int) -> None:
        chosen[face] = faces[face]
        covered.update(feet.query(faces[face].foot, predicate="dwithin", distance=_LEAST_APART_M).tolist())
        near.update(beside.within(_APART * reach_m, beside.at_m[[face]])[1].tolist())
        needed[served[face]] -= 1

    for place in range(len(places)):
        while needed[place] > 0:
            open_faces = [face for face in within[place].tolist() if face not in covered]
            if not open_faces:
                break
            take(max(open_faces, key=worth))
    if spacing_m is not None and len(chosen) > 1:
        for face in tuple(chosen):
            others = beside.within(spacing_m, beside.at_m[[face]])[1].tolist()
            open_faces = [other for other in others if other not in covered]
            if open_faces and chosen.keys().isdisjoint({*others} - {face}):
                take(max(open_faces, key=worth))
    return list(chosen.values())


def _grouped(owners: NDArray[np.int64], members: NDArray[np.int64], count: int) -> list[NDArray[np.int64]]:
    """For each of so many owners its members in ascending order."""
    order = np.lexsort((members, owners))
    return np.split(members[order], np.searchsorted(owners[order], np.arange(1, count)))


def _hung(mounted: Mounted, face: _Face) -> Placement:
    return placed(f"{pascal_case(mounted.kind.name)}_{face.name}", mounted.spec, face.place, yaw_rad=face.yaw_rad)


def _extent_m(mounted: Mounted) -> tuple[float, float, float]:
    """How far something reaches to the left, to the right, and out of the wall."""
    xs, zs = zip(*(corner for outline in mounted.spec.outlines() for corner in outline), strict=True)
    return min(xs), max(xs), max(zs)


def core_and_landing(core: Core) -> Polygon:
    """A core with the floor before its door."""
    x, z = core.width_m / 2, core.depth_m / 2
    outline = rectangle(-x, -z, x, z + core.recess_m)
    return tuple(to_world(corner, core.centre_m, edge_yaw_rad(core.edge)) for corner in outline)


def _outlines(placements: Iterable[Placement]) -> list[Polygon]:
    return [outline for place in placements for outline in place.outlines()]


def _before(faces: Sequence[_Face], outline: Polygon) -> Grounds:
    """The ground of an outline before each face; as `to_world` moves it, all at once."""
    x, z = np.array(outline).T
    cos, sin = np.array([cos_sin(face.yaw_rad) for face in faces]).reshape(-1, 2, 1).swapaxes(0, 1)
    origin_x, origin_z = np.array([face.place for face in faces]).reshape(-1, 2, 1).swapaxes(0, 1)
    corners = np.stack([origin_x + x * cos + z * sin, origin_z - x * sin + z * cos], axis=2)
    grounds: Grounds = shapely.polygons(corners)
    return grounds


def carriageway(tile: Tile, setback_m: float) -> shapely.Polygon:
    """The ground of a lane between its margins; all of a portal's."""
    margin = 0.0 if tile.cell in {Cell.ENTRANCE, Cell.EXIT} else setback_m
    up, down, left, right = (0.0 if drivable else margin for drivable in tile.drivable)
    x, z = tile.half_x_m, tile.half_z_m
    return shapely.box(tile.x_m - x + left, tile.z_m - z + up, tile.x_m + x - right, tile.z_m + z - down)
