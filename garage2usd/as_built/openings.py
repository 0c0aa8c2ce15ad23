"""Openings of vehicle doors and slopes of ramps, measured on their meshes."""

from collections.abc import Iterable, Iterator
from itertools import pairwise
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from garage2usd.as_built.shapes import Array, Body, Thing

_CUT_M = 1.0
"""Height above the floor at which a door's width is measured; metres."""
_SHEET_M = 0.1
"""Greatest thickness in metres of a door leaf or a sign, which does not narrow the opening."""
_LEVEL_SLOPE, _STEEPEST_SLOPE, _EQUAL_SLOPES = 0.005, 0.6, 5e-4
_STEP_M = 0.05
_STRAIGHT = 0.99999
"""Least length of the mean direction downhill of a straight ramp's faces: its halves differ by half a degree."""


class Stretch(NamedTuple):
    """Part of a ramp with a constant slope.

    Attributes
    ----------
    start_m, end_m
        Runs along the ramp from its foot.
    slope_percent
        Rise over run.
    """

    start_m: float
    end_m: float
    slope_percent: float

    @property
    def length_m(self) -> float:
        """Run of the stretch of ramp in metres."""
        return self.end_m - self.start_m


class Door(NamedTuple):
    """A vehicle door.

    Attributes
    ----------
    name
        Prim path.
    position
        (x, z) of the middle of its opening in metres.
    clear_width_m, clear_height_m
        Size of the opening; None if the mesh has none.
    is_shut
        True if a sheet fills most of the opening.
    """

    name: str
    position: tuple[float, float]
    clear_width_m: float | None
    clear_height_m: float | None
    is_shut: bool = False


class Ramp(NamedTuple):
    """A ramp.

    Attributes
    ----------
    name
        Prim path.
    position
        (x, z) of the middle of its ground in metres.
    stretches
        Sloping parts from its foot upwards; none of a ramp that bends.
    """

    name: str
    position: tuple[float, float]
    stretches: tuple[Stretch, ...]


def doors_of(things: Iterable[Thing]) -> Iterator[Door]:
    """Measure the vehicle doors among all objects."""
    return (_door(thing) for thing in things if thing.label == "vehicle_door" and thing.bodies)


def ramps_of(things: Iterable[Thing]) -> Iterator[Ramp]:
    """Measure the ramps among all objects."""
    return (_ramp(thing) for thing in things if thing.label == "ramp" and thing.bodies)


def is_bent(downhill: Array, weights: Array) -> bool:
    """True if the faces of a ramp slope in different directions: it bends.

    Parameters
    ----------
    downhill
        Horizontal part (x, z) of the normals of its sloping faces; float64, shape (n, 2).
    weights
        How much each counts; float64, shape (n,).
    """
    whole = float(np.linalg.norm((downhill * weights[:, None]).sum(axis=0)))
    return whole < _STRAIGHT * float((np.linalg.norm(downhill, axis=1) * weights).sum())


def section_of(thing: Thing, level_m: float = _CUT_M) -> list[Array]:
    """Intersect an object with a level plane; return the points (x, z) of each line, float64, shapes (n, 2)."""
    cuts = (cut for body in thing.bodies for cut in face_cuts(body, np.array([0.0, 1.0, 0.0]), level_m))
    return [cut[:, [0, 2]] for cut in cuts]


def _door(thing: Thing) -> Door:
    axis = thing.bodies[0].matrix[0, [0, 2]]
    axis = axis / (np.linalg.norm(axis) or 1.0)
    across = np.array([-axis[1], axis[0]])
    sides = [body for body in thing.bodies if np.ptp(body.world_points()[:, [0, 2]] @ across) >= _SHEET_M]
    points = np.concatenate([body.world_points() for body in (sides or thing.bodies)])
    middle = (points.min(axis=0) + points.max(axis=0))[[0, 2]] / 2
    spans = sorted(span for body in sides for span in _spans(body, axis))
    gap = _widest_gap(spans)
    if gap is None:
        return Door(thing.name, _point(middle), None, None)
    centre = middle + axis * (sum(gap) / 2 - middle @ axis)
    heads = [height for body in sides for height in _heights_over(body, axis, sum(gap) / 2)]
    sheets = [span for body in thing.bodies if body not in sides for span in _spans(body, axis)]
    covered = max((min(end, gap[1]) - max(start, gap[0]) for start, end in sheets), default=0.0)
    is_shut = covered > (gap[1] - gap[0]) / 2
    return Door(thing.name, _point(centre), gap[1] - gap[0], min(heads, default=None), is_shut)


def _spans(body: Body, axis: Array) -> Iterator[tuple[float, float]]:
    """Return the interval of each face along an axis at the height of the cut."""
    for cut in face_cuts(body, np.array([0.0, 1.0, 0.0]), _CUT_M):
        along = cut[:, [0, 2]] @ axis
        yield float(along.min()), float(along.max())


def _heights_over(body: Body, axis: Array, place: float) -> Iterator[float]:
    """Return the heights above the floor, from the cut upwards, of the faces over a place along an axis."""
    for cut in face_cuts(body, np.array([axis[0], 0.0, axis[1]]), place):
        if cut[:, 1].min() > _CUT_M:
            yield float(cut[:, 1].min())


def face_cuts(body: Body, normal: Array, level: float) -> Iterator[Array]:
    """Return the points where the sides of each face cross a plane; float64, shape (n, 3).

    Parameters
    ----------
    body
        The placed mesh.
    normal, level
        Unit normal of the plane, float64, shape (3,), and its distance from the origin along it.
    """
    points = body.world_points()
    height = points @ normal - level
    edges = body.shape.edges
    start, end = height[edges[:, 0]], height[edges[:, 1]]
    crosses = start * end < 0
    share = np.divide(start, start - end, out=np.zeros(len(start)), where=crosses)[:, None]
    crossing = points[edges[:, 0]] + (points[edges[:, 1]] - points[edges[:, 0]]) * share
    face = np.repeat(np.arange(len(body.shape.counts)), body.shape.counts)
    for number in np.unique(face[crosses]).tolist():
        yield crossing[crosses & (face == number)]


def _widest_gap(spans: list[tuple[float, float]]) -> tuple[float, float] | None:
    """Return the widest gap between intervals in ascending order."""
    best: tuple[float, float] | None = None
    reach = spans[0][1] if spans else 0.0
    for start, end in spans[1:]:
        if start > reach and (best is None or start - reach > best[1] - best[0]):
            best = reach, start
        reach = max(reach, end)
    return best


class _Slopes(NamedTuple):
    """Sloping faces of a ramp: runs, widths and slopes; float64, shape (faces,) each."""

    start_m: Array
    end_m: Array
    width_m: Array
    slope: Array


def _ramp(thing: Thing) -> Ramp:
    points = np.concatenate([body.world_points() for body in thing.bodies])
    middle = (points.min(axis=0) + points.max(axis=0))[[0, 2]] / 2
    facets = [body.facets() for body in thing.bodies]
    normals, counts, corners = (np.concatenate(part) for part in zip(*facets, strict=True))
    slopes = np.full(len(normals), np.inf)
    np.divide(np.linalg.norm(normals[:, [0, 2]], axis=1), normals[:, 1], out=slopes, where=normals[:, 1] > 0)
    sloping = (slopes > _LEVEL_SLOPE) & (slopes < _STEEPEST_SLOPE)
    if not sloping.any():
        return Ramp(thing.name, _point(middle), ())
    downhill = normals[sloping][:, [0, 2]]
    if is_bent(downhill, np.ones(len(downhill))):
        return Ramp(thing.name, _point(middle), ())
    uphill = -downhill.sum(axis=0)
    uphill /= np.linalg.norm(uphill) or 1.0
    across = np.array([-uphill[1], uphill[0]])
    flat = corners[np.repeat(sloping, counts)][:, [0, 2]]
    starts = np.cumsum(counts[sloping]) - counts[sloping]
    along, aside = flat @ uphill, flat @ across
    faces = _Slopes(
        np.minimum.reduceat(along, starts),
        np.maximum.reduceat(along, starts),
        np.maximum.reduceat(aside, starts) - np.minimum.reduceat(aside, starts),
        slopes[sloping],
    )
    return Ramp(thing.name, _point(middle), tuple(_stretches(faces)))


def _stretches(faces: _Slopes) -> Iterator[Stretch]:
    """Return stretches of a ramp with the slope of the widest face along the run; equal slopes are merged."""
    runs = np.arange(faces.start_m.min() + _STEP_M / 2, faces.end_m.max(), _STEP_M)
    first, end = np.searchsorted(runs, faces.start_m, side="left"), np.searchsorted(runs, faces.end_m, side="right")
    slope = np.zeros(len(runs))
    # the widest comes last and stays, of equal ones the first
    order = np.argsort(-faces.width_m, kind="stable")[::-1]
    for face in order[(faces.width_m[order] > 0) & (first[order] < end[order])].tolist():
        slope[first[face] : end[face]] = faces.slope[face]
    # not by rounded values, which differ for equal slopes beside a border of rounding
    changes = np.flatnonzero(np.abs(np.diff(slope)) > _EQUAL_SLOPES) + 1
    borders = [0, *changes.tolist(), len(slope)]
    for first_run, end_run in pairwise(borders):
        if slope[first_run] > _LEVEL_SLOPE:
            percent = round(100 * float(slope[first_run]), 2)
            yield Stretch(round(first_run * _STEP_M, 6), round(end_run * _STEP_M, 6), percent)


def _point(middle: NDArray[np.float64]) -> tuple[float, float]:
    return round(float(middle[0]), 6), round(float(middle[1]), 6)
