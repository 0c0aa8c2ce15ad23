"""A garage that is checked, as plain geometry that a car drives in."""

import math
from collections.abc import Collection, Iterator
from dataclasses import replace

import numpy as np
import shapely

from garage2usd.checks.aisle import dead_ends
from garage2usd.checks.openings import section_of
from garage2usd.checks.shapes import Thing
from garage2usd.checks.subject import Subject
from garage2usd.driving import DrivenGarage
from garage2usd.driving.assembly import BELONGINGS, StandingThing, assembled
from garage2usd.limits import allow_seconds
from garage2usd.reading.ground import Point, StallOutline

__all__ = ["CAR_HEIGHT_M", "driven_garage"]

CAR_HEIGHT_M = 2.0
"""Height of the design car where a profile gives none."""

_DRIVEN_THROUGH = {"vehicle_door", "ramp"}
"""What a convex outline would close; it counts by its section instead."""
_DRIVEN_OVER = {"speed_bump"}
_CAR = "car"
_SKIN_M = 0.02
"""What stands out of a car less than that counts as its colliders."""
_CORNERS, _DIRECTIONS = 4, 8
_SLACK_M2 = 0.05
"""Ground that the convex outline of an object may have over its pieces to stand for them: 1 cm along a car."""
_COMPILING_S, _STALL_S = 60.0, 5.0
"""Processor time that is allowed for a proof: for compiling, which is done once, and for each stall."""
_DIGITS = 4
"""Metres are rounded to so many, so that the single precision of a stage makes no difference."""


def driven_garage(subject: Subject, *, height_m: float = CAR_HEIGHT_M, left_out: Collection[str] = ()) -> DrivenGarage:
    """The stalls, the lanes by direction, and what stands on the floor; each thing by its prim path.

    Parameters
    ----------
    subject
        The garage.
    height_m
        What begins higher touches no car.
    left_out
        Prim paths of objects to leave out.

    Notes
    -----
    A process with limits gets the time for the proof.
    """
    allow_seconds(_COMPILING_S + _STALL_S * len(subject.parking_stalls))
    garage = assembled(
        ((stall.name, _rounded(stall.centre), _yaw_rad(stall), stall.access) for stall in subject.parking_stalls),
        ((_rounded(node.position), node.widths_m, node.kind) for node in subject.nodes),
        (edge._replace(width_m=round(edge.width_m, _DIGITS)) for edge in subject.edges),
        dead_ends(subject),
        (thing for thing in _standing(subject, height_m) if thing.name not in left_out),
    )
    return replace(garage, standing=replace(garage.standing, pieces=np.round(garage.standing.pieces, _DIGITS)))


def _standing(subject: Subject, height_m: float) -> Iterator[StandingThing]:
    """Each thing that a car could touch; doors and ramps by their sections."""
    cars = {thing.name: thing for thing in subject.things if thing.label == _CAR}
    for name, label, pieces in subject.solids.grounds(height_m):
        if label not in _DRIVEN_THROUGH | _DRIVEN_OVER:
            ground = _simple(pieces)
            if name in cars:
                ground = shapely.GeometryCollection(
                    [*shapely.get_parts(ground), *_standing_out(cars[name], ground, height_m)]
                )
            home = subject.home_of(ground.convex_hull) if label in BELONGINGS else None
            yield StandingThing(name, label, ground, home.name if home else None)
    for thing in subject.things:
        if thing.label in _DRIVEN_THROUGH:
            cuts = shapely.MultiLineString([cut for cut in section_of(thing) if len(cut) > 1])
            yield StandingThing(thing.name, thing.label, cuts)


def _standing_out(car: Thing, ground: shapely.Geometry, height_m: float) -> Iterator[shapely.Geometry]:
    """The pieces of a car that stand out of the ground of its colliders, which are its mirrors."""
    within = shapely.convex_hull(ground).buffer(_SKIN_M)
    shapely.prepare(within)
    for body in car.bodies:
        if body.touches or shapely.contains_xy(within, body.world_points()[:, [0, 2]]).all():
            continue
        for outline, low, _ in body.pieces():
            piece = shapely.convex_hull(shapely.multipoints(outline))
            if low < height_m and not within.covers(piece):
                yield shapely.oriented_envelope(piece)


def _simple(pieces: list[shapely.Polygon]) -> shapely.Geometry:
    """Convex pieces as fewer ones that hold them: one where they nearly fill it, none with more than eight corners."""
    if len(pieces) > 1:
        whole = shapely.union_all(pieces)
        hull = whole.convex_hull
        # what is as thin as a line has no area to be filled
        if isinstance(hull, shapely.Polygon) and hull.area - whole.area <= _SLACK_M2:
            pieces = [hull]
    return shapely.GeometryCollection([_eight_cornered(piece) for piece in pieces])


def _eight_cornered(piece: shapely.Polygon) -> shapely.Geometry:
    """A convex polygon, or the tightest one around it with eight sides along and halfway between those of its box.

    One that is as thin as a line becomes that line.
    """
    hull = piece.convex_hull
    if not isinstance(hull, shapely.Polygon):
        return hull
    corners = np.asarray(piece.exterior.coords)[:-1]
    if len(corners) <= _CORNERS:
        return piece
    box = np.asarray(shapely.oriented_envelope(piece).exterior.coords)
    angles = math.atan2(*(box[1] - box[0])[::-1]) + np.arange(_DIRECTIONS) * math.tau / _DIRECTIONS
    normals = np.stack([np.cos(angles), np.sin(angles)], axis=1)
    reach = (corners @ normals.T).max(axis=0)
    meets = [
        np.linalg.solve(normals[[side, side - 1]], reach[[side, side - 1]]).tolist() for side in range(_DIRECTIONS)
    ]
    return shapely.Polygon(meets).convex_hull


def _yaw_rad(stall: StallOutline) -> float:
    x, z = stall.outwards
    return round(math.atan2(x, z), _DIGITS + 1) if abs(x * z) > 10**-_DIGITS else _quarter_rad(x, z)


def _quarter_rad(x: float, z: float) -> float:
    return math.atan2(round(x) + 0.0, round(z) + 0.0)


def _rounded(point: Point) -> Point:
    return round(point[0], _DIGITS), round(point[1], _DIGITS)
