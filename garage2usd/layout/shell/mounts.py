"""Mounting places of equipment on walls, columns and cores, clear of stalls, carriageways and doors."""

from collections.abc import Iterable, Iterator, Sequence
from typing import NamedTuple

import numpy as np
import shapely
from numpy.typing import NDArray

from garage2usd.assets import pascal_case
from garage2usd.config import GarageConfig
from garage2usd.layout.egress.cores import Core
from garage2usd.layout.grounds import Grounds, Points, grounds_of
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
from garage2usd.layout.tiles import Tile, Tiles
from garage2usd.objects import MOUNTED, Mounted
from garage2usd.objects.column import ColumnSpec
from garage2usd.objects.kind import Point, Polygon, rectangle
from garage2usd.objects.obstacle import ObstacleSpec
from garage2usd.objects.wall import WallSpec
from garage2usd.structure.grid import NEIGHBOUR_STEPS, Cell
from garage2usd.structure.stalls import Edge

_APPROACH_M = 0.6
"""Depth of the clear ground in front of equipment, for access by people."""
_OVERHANG_M = 0.05
"""Greatest total overhang of equipment over a column's side, on both sides equally or on one side."""
_SLACK_M = 1.0
"""Reduction of the reach, since distances are measured to the middles of stalls and lanes."""
_PITCH_M = 1.0
"""Spacing of the candidate places along a wall."""
_PREFERRED_SPACING = 0.5
"""Preferred distance between objects of a kind, as a share of their reach."""
_LEAST_SPACING_M = 3.0
"""Least distance between objects of a kind: two side by side, or on one column, serve no more than one."""
_TOUCH_M = 1e-3


class _MountPlace(NamedTuple):
    """Candidate mounting place on a column, a wall or a block: floor point below its middle, yaw, width and name.

    Places at the edge of a column are for equipment wider than the column's side (`wider_than_m`). Free places also
    have `is_on_lane`, True beside a lane, and `foot`, the ground below the equipment.
    """

    place: Point
    yaw_rad: float
    width_m: float
    name: str
    wider_than_m: float = 0.0
    is_on_lane: bool = False
    foot: shapely.Polygon | None = None


def mounted_objects(
    grid: Tiles,
    pillars: Iterable[Placement],
    walls: Iterable[Placement],
    blocks: Iterable[Placement],
    stalls: Sequence[PlacedStall],
    cores: Iterable[Core],
    standing: Iterable[Placement],
    config: GarageConfig,
) -> list[Placement]:
    """Place equipment on columns, walls and cores, each kind within its reach of all stalls and lanes.

    Parameters
    ----------
    grid, pillars, walls, blocks, stalls, cores
        Parts of the garage; blocks are its obstacles and stair cores. Faces beside lanes are the last choice.
    standing
        Other objects on squares without stalls.
    config
        Switches of the kinds of equipment, and their reach by the profile.

    Notes
    -----
    Greedy set cover (Chvatal 1979): for the first unserved stall or lane in reading order, the free face within reach
    that serves the most unserved places is chosen. A place without a free face within reach remains unserved.
    """
    pillars, walls, blocks = tuple(pillars), tuple(walls), tuple(blocks)
    faces = [*_column_faces(pillars), *_wall_faces(walls), *_block_faces(blocks)]
    driven = [carriageway(tile, grid.setback_m) for tile in grid if tile.cell is not Cell.FREE]
    parked = shapely.buffer(grounds_of([stall.rectangle_m() for stall in stalls]), -_TOUCH_M / 2, join_style="mitre")
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
            hung = [_mount(mounted, face) for face in _set_cover(mounted, reach_m, spacing_m, free, places)]
            used = np.concatenate([used, grounds_of(_outlines(hung))])
            objects += hung
    return objects


def _column_faces(pillars: Iterable[Placement]) -> Iterator[_MountPlace]:
    """Yield the candidate places of columns: three on each face, in the middle and shifted to both edges."""
    for pillar, spec in of_spec(pillars, ColumnSpec):
        for edge in Edge:
            yaw = edge_yaw_rad(edge)
            name = f"{pillar.name}_{edge.name.capitalize()}"
            for across, end in ((0.0, ""), (-_OVERHANG_M / 2, "_Left"), (_OVERHANG_M / 2, "_Right")):
                place = to_world((across, spec.size_m / 2), (pillar.position_m[0], pillar.position_m[2]), yaw)
                least_m = spec.size_m if end else 0.0
                yield _MountPlace(rounded(place), yaw, spec.size_m + _OVERHANG_M, f"{name}{end}", least_m)


def _wall_faces(walls: Iterable[Placement]) -> Iterator[_MountPlace]:
    """Yield the candidate places of walls, at a regular pitch and at the joints of collinear walls."""
    ends: set[tuple[Point, float]] = set()
    for wall, spec in of_spec(walls, WallSpec):
        yaw, length = wall.yaw_rad, spec.length_m
        yield from _places_along((wall.position_m[0], wall.position_m[2]), yaw, length, wall.name)
        for across in (-length / 2, length / 2):
            end = rounded(wall.to_world((across, 0.0)))
            if (end, yaw) in ends:
                yield _MountPlace(end, yaw, length, f"{wall.name}_End")
            ends.add((end, yaw))


def _block_faces(blocks: Iterable[Placement]) -> Iterator[_MountPlace]:
    """Yield the candidate places of obstacles and stair cores, at a regular pitch along each side."""
    for block, spec in of_spec(blocks, ObstacleSpec):
        x, _, z = block.position_m
        is_along_x = cos_sin(block.yaw_rad)[1] == 0
        width, depth = (spec.width_m, spec.depth_m) if is_along_x else (spec.depth_m, spec.width_m)
        for edge in Edge:
            down, right = NEIGHBOUR_STEPS[edge]
            middle = x + right * width / 2, z + down * depth / 2
            name = f"{block.name}_{edge.name.capitalize()}"
            yield from _places_along(middle, edge_yaw_rad(edge), width if edge.along_x else depth, name)


def _places_along(middle: Point, yaw_rad: float, length_m: float, name: str) -> Iterator[_MountPlace]:
    """Yield places at a regular pitch along a face, symmetric to its middle."""
    count = max(int(length_m / _PITCH_M), 1)
    for number in range(count):
        across = (number - (count - 1) / 2) * _PITCH_M
        place = rounded(to_world((across, 0.0), middle, yaw_rad))
        yield _MountPlace(place, yaw_rad, length_m - 2 * abs(across), f"{name}_{number + 1}")


def _free_faces(
    mounted: Mounted, faces: Iterable[_MountPlace], driven: shapely.STRtree, used: shapely.STRtree
) -> list[_MountPlace]:
    """Return the wide enough faces with clear ground in front, outside carriageways, stalls and objects."""
    left, right, depth = _extent_m(mounted)
    wide = [face for face in faces if face.wider_than_m < right - left <= face.width_m]
    feet = _in_front_of(wide, rectangle(left, _TOUCH_M, right, depth))
    approaches = _in_front_of(wide, rectangle(left, _TOUCH_M, right, depth + _APPROACH_M))

    def intersecting(grounds: Grounds, tree: shapely.STRtree) -> set[int]:
        """Return the indices of the grounds that intersect a tree's polygons."""
        return set(tree.query(grounds, predicate="intersects")[0].tolist())

    taken, on_lanes = intersecting(feet, driven) | intersecting(approaches, used), intersecting(approaches, driven)
    return [
        face._replace(is_on_lane=index in on_lanes, foot=feet[index])
        for index, face in enumerate(wide)
        if index not in taken
    ]


def _set_cover(
    mounted: Mounted,
    reach_m: float,
    spacing_m: float | None,
    faces: Sequence[_MountPlace],
    places: NDArray[np.float64],
) -> list[_MountPlace]:
    """Choose faces by greedy set cover to serve all places (x, z), shape (n, 2).

    A chosen face without another one within `spacing_m` gets an additional face there.
    """
    if not faces or not len(places):
        return []
    beside = Points([face.place for face in faces])
    place_near, face_near, _ = beside.within(reach_m, places, norm=mounted.norm)
    within = _group_by_owner(place_near, face_near, len(places))
    served = _group_by_owner(face_near, place_near, len(faces))
    needed = np.full(len(places), mounted.count)
    feet = shapely.STRtree([face.foot for face in faces])
    chosen: dict[int, _MountPlace] = {}
    near: set[int] = set()
    covered: set[int] = set()

    def rank(face: int) -> tuple[bool, bool, int]:
        """Return the rank of a face: off lanes, away from chosen faces, number of unserved places."""
        return not faces[face].is_on_lane, face not in near, int((needed[served[face]] > 0).sum())

    def choose(face: int) -> None:
        """Choose a face and update the served places."""
        chosen[face] = faces[face]
        covered.update(feet.query(faces[face].foot, predicate="dwithin", distance=_LEAST_SPACING_M).tolist())
        near.update(beside.within(_PREFERRED_SPACING * reach_m, beside.at_m[[face]])[1].tolist())
        needed[served[face]] -= 1

    for place in range(len(places)):
        while needed[place] > 0:
            open_faces = [face for face in within[place].tolist() if face not in covered]
            if not open_faces:
                break
            choose(max(open_faces, key=rank))
    if spacing_m is not None and len(chosen) > 1:
        for face in tuple(chosen):
            others = beside.within(spacing_m, beside.at_m[[face]])[1].tolist()
            open_faces = [other for other in others if other not in covered]
            if open_faces and chosen.keys().isdisjoint({*others} - {face}):
                choose(max(open_faces, key=rank))
    return list(chosen.values())


def _group_by_owner(owners: NDArray[np.int64], members: NDArray[np.int64], count: int) -> list[NDArray[np.int64]]:
    """Group members by owner, 0 to `count` - 1, in ascending order."""
    order = np.lexsort((members, owners))
    return np.split(members[order], np.searchsorted(owners[order], np.arange(1, count)))


def _mount(mounted: Mounted, face: _MountPlace) -> Placement:
    """Place equipment on a face."""
    return placed(f"{pascal_case(mounted.kind.name)}_{face.name}", mounted.spec, face.place, yaw_rad=face.yaw_rad)


def _extent_m(mounted: Mounted) -> tuple[float, float, float]:
    """Return the extent of equipment to the left (negative), to the right, and out of the wall."""
    xs, zs = zip(*(corner for outline in mounted.spec.outlines() for corner in outline), strict=True)
    return min(xs), max(xs), max(zs)


def core_and_landing(core: Core) -> Polygon:
    """Return the outline of a core with its landing."""
    x, z = core.width_m / 2, core.depth_m / 2
    outline = rectangle(-x, -z, x, z + core.recess_m)
    return tuple(to_world(corner, core.centre_m, edge_yaw_rad(core.edge)) for corner in outline)


def _outlines(placements: Iterable[Placement]) -> list[Polygon]:
    """Return the outlines of all placements."""
    return [outline for place in placements for outline in place.outlines()]


def _in_front_of(faces: Sequence[_MountPlace], outline: Polygon) -> Grounds:
    """Return an outline on the floor in front of each face, as polygons; a vectorized `to_world`."""
    x, z = np.array(outline).T
    cos, sin = np.array([cos_sin(face.yaw_rad) for face in faces]).reshape(-1, 2, 1).swapaxes(0, 1)
    origin_x, origin_z = np.array([face.place for face in faces]).reshape(-1, 2, 1).swapaxes(0, 1)
    corners = np.stack([origin_x + x * cos + z * sin, origin_z - x * sin + z * cos], axis=2)
    grounds: Grounds = shapely.polygons(corners)
    return grounds


def carriageway(tile: Tile, setback_m: float) -> shapely.Polygon:
    """Return the carriageway of a lane square, inside its margins; all of a portal square."""
    margin = 0.0 if tile.cell in {Cell.ENTRANCE, Cell.EXIT} else setback_m
    up, down, left, right = (0.0 if drivable else margin for drivable in tile.drivable)
    x, z = tile.half_x_m, tile.half_z_m
    if not tile.yaw_rad:
        # objects that touch the piece are placed with exactly these sums
        return shapely.box(tile.x_m - x + left, tile.z_m - z + up, tile.x_m + x - right, tile.z_m + z - down)
    ground = shapely.box(left - x, up - z, x - right, z - down)
    return shapely.Polygon([tile.at(corner) for corner in shapely.get_coordinates(ground.exterior)[:-1].tolist()])
