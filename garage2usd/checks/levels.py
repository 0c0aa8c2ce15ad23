"""Rules of the levels of a garage together: floors, ramps between them, and routes from and to the street."""

import math
from collections.abc import Iterator
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from garage2usd.as_built.driven_ground import CAR_HEIGHT_M
from garage2usd.as_built.garage import BuiltGarage
from garage2usd.checks.rule import ROUNDING_M, Finding
from garage2usd.garage import LaneKind
from garage2usd.profiles import Profile, Severity
from garage2usd.scenes.triangles import triangulated
from garage2usd.sensors.rays.ray_caster import BoxTree

_STREET = LaneKind.ENTRANCE, LaneKind.EXIT
_SIDE_ROOM_M = 0.5
"""Least distance in metres between the design car and the walls beside a ramp."""
_STEP_M = 0.5
_EYE_M, _AXLE_M = 0.05, 0.6
"""Heights over the ramp's floor of the rays upwards and sideways."""
_LEAST_RUN_M = 1e-6
_SLOPE_ROUNDING = 0.15
_IN_SURVEYS = {
    "level-height": Severity.INFO,
    "ramp-bend": Severity.INFO,
    "portal-count": Severity.WARNING,
    "ramp-headroom": Severity.WARNING,
    "ramp-width": Severity.WARNING,
}
"""Greatest severity in surveyed garages, as `Rule.in_surveys`; routes are errors there too."""
_FAR_M = 4.0
"""Distance around the box of a ramp in which triangles are cast at; more clearance than this is enough anywhere."""


def findings_of_whole(garage: BuiltGarage, profile: Profile) -> list[Finding]:
    """Return the findings on the levels of a garage together; an only level has none besides its own.

    Parameters
    ----------
    garage
        The garage.
    profile
        What it is checked against.
    """
    if garage.levels[0].place.is_only:
        return []
    found = [
        *(Finding(fault.rule, Severity.ERROR, fault.place, fault.message, fault.position) for fault in garage.faults),
        *_floors(garage, profile),
        *_routes(garage),
        *_portals(garage, profile),
        *_ramp_clearances(garage, profile),
        *_ramp_bends(garage, profile),
    ]
    if not garage.levels[0].is_surveyed:
        return found
    least_m = {"level-height": CAR_HEIGHT_M, "ramp-headroom": CAR_HEIGHT_M, "ramp-width": profile.car_width_m}
    return [
        each
        if each.measured is not None and each.measured < least_m.get(each.rule, 0.0)  # no car gets there
        else each.in_survey(_IN_SURVEYS.get(each.rule, Severity.ERROR))
        for each in found
    ]


def _floors(garage: BuiltGarage, profile: Profile) -> Iterator[Finding]:
    """Yield floors that lie closer together than the clear height, and levels that no ramp leads to."""
    required = CAR_HEIGHT_M if profile.clear_height is None else profile.clear_height.amount
    places = sorted((level.place for level in garage.levels), key=lambda place: -place.floor_m)
    for upper, lower in pairwise(places):
        apart_m = upper.floor_m - lower.floor_m
        if apart_m < required - ROUNDING_M:
            said = f"the floors of {upper.name} and {lower.name} lie too close together"
            yield Finding("level-height", Severity.ERROR, lower.name, said, None, round(apart_m, 4), required, "m")
    nodes = garage.lanes.nodes
    led = {nodes[number].level for ramp in garage.ramp_lines for number in (ramp.nodes[0], ramp.nodes[-1])}
    for number, level in enumerate(garage.levels):
        if number not in led and not any(nodes[portal].level == number for portal in garage.lanes.portals(*_STREET)):
            yield Finding("level-ramp", Severity.ERROR, level.place.name, "no ramp leads to this level")


def _routes(garage: BuiltGarage) -> Iterator[Finding]:
    """Yield stalls without a route from an entrance on the street, or to an exit on it."""
    for arcs, words in (
        (garage.lanes.arriving, "no route from an entrance on the street"),
        (garage.lanes.leaving, "no route to an exit on the street"),
    ):
        reached = {node for arc in arcs for node in arc}
        for stall in garage.stalls:
            if stall.access not in reached:
                yield Finding("level-route", Severity.ERROR, stall.name, words, stall.centre)


def _portals(garage: BuiltGarage, profile: Profile) -> Iterator[Finding]:
    """Yield a finding if there are too few entrances and exits on the street for the stalls of all levels."""
    if profile.portals is None:
        return
    count = len(garage.lanes.portals(*_STREET))
    stalls = sum(stall.takes_cars for stall in garage.stalls)
    required = profile.portals.required(stalls)
    if count < required:
        yield Finding(
            "portal-count",
            profile.portals.severity,
            "",
            f"too few entrances and exits for {stalls} stalls on {len(garage.levels)} levels",
            measured=count,
            required=required,
            source=f"{profile.portals.source} ({profile.portals.confidence})",
            clause="portals",
        )


def _ramp_clearances(garage: BuiltGarage, profile: Profile) -> Iterator[Finding]:
    """Yield the lowest place and the narrowest place of each ramp between levels that misses the requirement."""
    for ramp in garage.ramp_lines:
        name, points = garage.lanes.nodes[ramp.sloped[0]].name, _sampled(ramp.slope)
        corners = _near(garage, points)
        if not len(corners):
            continue
        caster = BoxTree(corners.reshape(-1, 3), np.arange(len(corners) * 3, dtype=np.int32).reshape(-1, 3))
        ahead = np.diff(points, axis=0, append=points[-1:] * 2 - points[-2:-1])[:, [0, 2]]
        ahead /= np.maximum(np.linalg.norm(ahead, axis=1, keepdims=True), _LEAST_RUN_M)
        up = np.tile([0.0, 1.0, 0.0], (len(points), 1))
        aside = np.stack([ahead[:, 1], np.zeros(len(points)), -ahead[:, 0]], axis=1)
        clear = profile.clear_height
        if clear is not None:
            heights = _distances(caster, corners, points + np.array([0.0, _EYE_M, 0.0]), up) + _EYE_M
            lowest = int(np.argmin(heights))
            if heights[lowest] < clear.amount - ROUNDING_M:
                yield Finding(
                    "ramp-headroom",
                    clear.severity,
                    name,
                    "something hangs too low over the ramp between levels",
                    (float(points[lowest, 0]), float(points[lowest, 2])),
                    round(float(heights[lowest]), 4),
                    clear.amount,
                    "m",
                    f"{clear.source} ({clear.confidence})",
                    "clear_height",
                )
        axle = points + np.array([0.0, _AXLE_M, 0.0])
        widths = _distances(caster, corners, axle, aside) + _distances(caster, corners, axle, -aside)
        narrowest, required = int(np.argmin(widths)), profile.car_width_m + 2 * _SIDE_ROOM_M
        if widths[narrowest] < required - ROUNDING_M:
            yield Finding(
                "ramp-width",
                Severity.ERROR,
                name,
                "the ramp between levels is too narrow",
                (float(points[narrowest, 0]), float(points[narrowest, 2])),
                round(float(widths[narrowest]), 4),
                required,
                "m",
            )


def _ramp_bends(garage: BuiltGarage, profile: Profile) -> Iterator[Finding]:
    """Yield the helices that are too steep along the inner edge of their carriageway."""
    clause = profile.curved_ramp_slope
    if clause is None:
        return
    for ramp in garage.ramp_lines:
        bend = ramp.bend
        if bend is None:
            continue
        places = ramp.places
        runs = np.linalg.norm(np.diff(places[:, [0, 2]], axis=0), axis=1)
        slopes = np.abs(np.diff(places[:, 1])) / np.maximum(runs, _LEAST_RUN_M)
        steepest, inner_m = int(np.argmax(slopes)), bend.radius_m - ramp.width_m / 2
        percent = 100 * float(slopes[steepest]) * bend.radius_m / inner_m if inner_m > 0 else math.inf
        if percent > clause.amount + _SLOPE_ROUNDING:
            yield Finding(
                "ramp-bend",
                clause.severity,
                garage.lanes.nodes[ramp.sloped[0]].name,
                "the helix between levels is too steep along its inner edge",
                (float(places[steepest, 0]), float(places[steepest, 2])),
                round(percent, 2),
                clause.amount,
                "%",
                f"{clause.source} ({clause.confidence})",
                "curved_ramp_slope",
            )


def _sampled(line: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return points along a line about every half metre; float64, shape (n, 3)."""
    along = np.concatenate([[0.0], np.cumsum(np.linalg.norm(np.diff(line, axis=0), axis=1))])
    places = np.linspace(0.0, along[-1], max(2, int(along[-1] / _STEP_M) + 1))
    return np.stack([np.interp(places, along, line[:, axis]) for axis in range(3)], axis=1)


def _near(garage: BuiltGarage, points: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return the corners of the triangles around some points; float64, shape (triangles, 3, 3)."""
    low, high = points.min(axis=0) - _FAR_M, points.max(axis=0) + _FAR_M
    parts = [np.zeros((0, 3, 3))]
    for body in (body for thing in garage.things for body in thing.bodies):
        at = body.matrix[3, :3]
        if np.any(at + body.shape.reach * 2 < low) or np.any(at - body.shape.reach * 2 > high):
            continue
        corners, _ = triangulated(body.shape.points, body.shape.indices, body.shape.counts)
        triangles = body.world_points()[body.shape.indices[corners]]
        is_near = ((triangles.max(axis=1) >= low) & (triangles.min(axis=1) <= high)).all(axis=1)
        parts.append(triangles[is_near])
    return np.concatenate(parts)


def _distances(
    caster: BoxTree, triangles: NDArray[np.float64], origins: NDArray[np.float64], directions: NDArray[np.float64]
) -> NDArray[np.float64]:
    """Return the distance to what each ray hits first, infinite for nothing; shape (n,)."""
    with np.errstate(invalid="ignore"):  # of triangles beside a ray, which it misses
        hit = caster.first(origins, directions)
    first, second, third = triangles[hit].transpose(1, 0, 2)
    normals = np.cross(second - first, third - first)
    share = (normals * directions).sum(axis=1)
    far = ((first - origins) * normals).sum(axis=1) / np.where(share == 0.0, np.inf, share)
    return np.where(hit >= 0, far, np.inf)
