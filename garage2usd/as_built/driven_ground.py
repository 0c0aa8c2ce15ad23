"""The ground of a garage as built for driving, with the obstacles on it."""

import math
from collections.abc import Collection, Iterator, Mapping
from dataclasses import replace

import numpy as np
import shapely
from numpy.typing import NDArray

from garage2usd.as_built.level import BuiltLevel
from garage2usd.as_built.openings import section_of
from garage2usd.as_built.placed_pieces import placed_pieces
from garage2usd.as_built.shapes import Thing
from garage2usd.common.limits import allow_seconds
from garage2usd.driving import DrivenGarage
from garage2usd.driving.layout_garage import BELONGINGS, StandingThing, assembled
from garage2usd.garage import LaneGraph, Point
from garage2usd.layout.grounds import Grounds
from garage2usd.objects import CAR_LABELS

CAR_HEIGHT_M = 2.0
"""Height of the design car in metres if the profile gives none."""

_DRIVEN_THROUGH = {"vehicle_door", "ramp"}
"""Semantic classes of obstacles with an opening, which a convex outline would close; their section is used instead."""
_DRIVEN_OVER = {"speed_bump"}
_SKIN_M = 0.02
"""Greatest protrusion in metres from a car's colliders that is ignored."""
_CORNERS, _DIRECTIONS = 4, 8
_SLACK_M2 = 0.05
"""Greatest excess area of an object's convex outline over its pieces for which it replaces them: 1 cm along a car."""
_ONCE_S, _STALL_S = 60.0, 5.0
"""Processor time granted to a swept-path proof in seconds: once, and per stall."""
_DIGITS = 4
"""Decimals of rounded metres, so that the single precision of a stage makes no difference."""


def driven_garage(level: BuiltLevel, *, height_m: float = CAR_HEIGHT_M, left_out: Collection[str] = ()) -> DrivenGarage:
    """Assemble the garage for driving from a garage as built: stalls, lanes, and obstacles by prim path.

    Parameters
    ----------
    level
        The level.
    height_m
        Height of the car; pieces that begin higher are not obstacles.
    left_out
        Prim paths of objects to omit.

    Notes
    -----
    A process with limits of time is granted the time for the proof.
    """
    allow_seconds(_ONCE_S + _STALL_S * len(level.parking_stalls))
    driven = assembled(
        level.stalls,
        _rounded_lanes(level.lanes),
        (thing for thing in _standing(level, height_m) if thing.name not in left_out),
    )
    return replace(driven, standing=replace(driven.standing, pieces=np.round(driven.standing.pieces, _DIGITS)))


def _standing(level: BuiltLevel, height_m: float) -> Iterator[StandingThing]:
    """Return each obstacle to a car; doors and ramps by their sections."""
    grounds = [ground for ground in level.solids.grounds(height_m) if ground[1] not in _DRIVEN_THROUGH | _DRIVEN_OVER]
    owner = np.repeat(np.arange(len(grounds)), [len(pieces) for _, _, pieces in grounds])
    pieces = np.array([piece for _, _, pieces in grounds for piece in pieces], dtype=object)
    owner, pieces = _simple(owner, pieces)
    hulls = _hulls(owner, pieces)
    things = {thing.name: thing for thing in level.things if thing.label in CAR_LABELS}
    cars = {number: things[name] for number, (name, _, _) in enumerate(grounds) if name in things}
    out_of, mirrors = _standing_out(cars, hulls, height_m)
    owner = np.concatenate([owner, out_of])
    order = np.argsort(owner, kind="stable")
    owner, pieces = owner[order], np.concatenate([pieces, mirrors])[order]
    covered = shapely.geometrycollections(pieces, indices=owner) if len(pieces) else pieces
    belongings = [number for number, (_, label, _) in enumerate(grounds) if label in BELONGINGS]
    homes = dict(zip(belongings, level.stall_grounds.homes_of(_hulls(owner, pieces)[belongings]), strict=True))
    for number, ((name, label, _), ground) in enumerate(zip(grounds, covered, strict=True)):
        home = homes.get(number)
        yield StandingThing(name, label, ground, home.name if home else None)
    for thing in level.things:
        if thing.label in _DRIVEN_THROUGH:
            cuts = shapely.MultiLineString([cut for cut in section_of(thing) if len(cut) > 1])
            yield StandingThing(thing.name, thing.label, cuts)


def _standing_out(cars: Mapping[int, Thing], hulls: Grounds, height_m: float) -> tuple[NDArray[np.int64], Grounds]:
    """Return the pieces of cars that protrude from the ground of their colliders: their mirrors.

    Parameters
    ----------
    cars
        Cars by number.
    hulls
        Convex ground of the colliders by number.
    height_m
        Height of the design car; pieces that begin higher are not obstacles.

    Returns
    -------
    tuple
        Number of the car of each piece, and its ground.
    """
    bodies = [(number, body) for number, car in cars.items() for body in car.bodies if not body.touches]
    numbers, within = [*cars], np.full(len(hulls), None, dtype=object)
    within[numbers] = shapely.buffer(hulls[numbers], _SKIN_M)
    shapely.prepare(within)
    car = np.array([number for number, _ in bodies], dtype=np.int64)
    # what is convex holds a mesh where it holds the convex outline of that
    whole = placed_pieces([body for _, body in bodies], np.ones(len(bodies), dtype=bool))
    corner = whole.owner[whole.piece]
    inside = np.ones(len(bodies), dtype=bool)
    np.logical_and.at(inside, corner, shapely.contains_xy(within[car[corner]], whole.corners))
    rest = np.flatnonzero(~inside)
    pieces = placed_pieces([bodies[index][1] for index in rest.tolist()], np.zeros(len(rest), dtype=bool))
    pieces = pieces.kept(pieces.low_m < height_m)
    car, grounds = car[rest][pieces.owner], pieces.hulls
    stands_out = ~shapely.covers(within[car], grounds)
    return car[stands_out], shapely.oriented_envelope(grounds[stands_out])


def _hulls(owner: NDArray[np.int64], pieces: Grounds) -> Grounds:
    """Return the convex hull of the pieces of each owner; every owner has a piece."""
    if not len(pieces):
        return pieces
    hulls: Grounds = shapely.convex_hull(shapely.geometrycollections(pieces, indices=owner))
    return hulls


def _simple(owner: NDArray[np.int64], pieces: Grounds) -> tuple[NDArray[np.int64], Grounds]:
    """Cover convex pieces by fewer ones: by one if nearly filled, and by polygons of at most eight corners."""
    counts = np.bincount(owner)
    number = np.arange(len(owner)) - (np.cumsum(counts) - counts)[owner]
    table = np.full((len(counts), counts.max(initial=1)), None, dtype=object)
    table[owner, number] = pieces
    several = np.flatnonzero(counts > 1)
    hulls = shapely.convex_hull(shapely.geometrycollections(table[several]))
    areas_m2 = np.zeros(table.shape)
    areas_m2[owner, number] = shapely.area(pieces)
    least_m2 = shapely.area(hulls) - _SLACK_M2
    # what is as thin as a line has no area to be filled
    are_filled = (shapely.get_type_id(hulls) == shapely.GeometryType.POLYGON) & (
        areas_m2[several].sum(axis=1) >= least_m2
    )
    # most are filled by one of their pieces; only of the others it takes the union to know
    unsure = np.flatnonzero(are_filled & (areas_m2[several].max(axis=1, initial=0.0) < least_m2))
    are_filled[unsure] = shapely.area(shapely.union_all(table[several[unsure]], axis=1)) >= least_m2[unsure]
    kept = np.isin(owner, several[are_filled], invert=True)
    owner = np.concatenate([owner[kept], several[are_filled]])
    order = np.argsort(owner, kind="stable")
    return owner[order], _eight_cornered(np.concatenate([pieces[kept], hulls[are_filled]])[order])


def _eight_cornered(pieces: Grounds) -> Grounds:
    """Return convex polygons, or their tightest octagons with sides parallel and diagonal to a bounding box.

    A polygon as thin as a line becomes that line.
    """
    hulls = shapely.convex_hull(pieces)
    are_flat = shapely.get_type_id(hulls) != shapely.GeometryType.POLYGON
    simple = np.where(are_flat, hulls, pieces)
    many = np.flatnonzero(~are_flat & (shapely.get_num_coordinates(pieces) - 1 > _CORNERS))
    if not len(many):
        return simple
    boxes = shapely.get_coordinates(shapely.oriented_envelope(pieces[many])).reshape(-1, 5, 2)
    sides = boxes[:, 1] - boxes[:, 0]
    turns = np.arange(_DIRECTIONS) * math.tau / _DIRECTIONS
    angles = np.arctan2(sides[:, 1], sides[:, 0])[:, None] + turns
    normals = np.stack([np.cos(angles), np.sin(angles)], axis=2)
    corners, piece = shapely.get_coordinates(pieces[many], return_index=True)
    reaches = (corners[:, None] * normals[piece]).sum(axis=2)
    reach = np.maximum.reduceat(reaches, np.searchsorted(piece, np.arange(len(many))))
    before = np.arange(_DIRECTIONS) - 1
    lines = np.stack([normals, normals[:, before]], axis=2)
    meets = np.linalg.solve(lines, np.stack([reach, reach[:, before]], axis=2)[..., None])[..., 0]
    simple[many] = shapely.convex_hull(shapely.polygons(meets))
    return simple


def _rounded_lanes(lanes: LaneGraph) -> LaneGraph:
    """Return the lanes with rounded lengths; cars keep between the columns."""
    nodes = (replace(node, position=rounded(node.position), sides_m=None) for node in lanes.nodes)
    edges = (edge._replace(width_m=round(edge.width_m, _DIGITS)) for edge in lanes.edges)
    return LaneGraph(tuple(nodes), tuple(edges))


def rounded(point: Point) -> Point:
    """Round a point to 0.1 mm, which single precision preserves."""
    return round(point[0], _DIGITS), round(point[1], _DIGITS)
