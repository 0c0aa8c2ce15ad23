"""How bright the floor is: lamps get the luminance that reaches the wanted illuminance, if all of them burn."""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from garage2usd.config import FittingsConfig
from garage2usd.layout.nearness import Points
from garage2usd.layout.placement import PlacedStall, Placement, of_spec
from garage2usd.native import elementary
from garage2usd.objects.lamp import LampSpec

__all__ = ["LightLevels", "Lux", "direct_lux", "lane_points_of", "light_up"]

UTILISATION, MAINTENANCE = 1.0, 0.8
"""Of lights that shine down only in a room with an index over 5 and grey surfaces, and of tubes cleaned once a year."""
_REACH_M = 25.0
_POINTS_AT_ONCE = 4096
"""Bounds the memory that pairs of points and lamps take."""
_SEGMENTS = 3
_POINTS_A_SIDE = 3


@dataclass(frozen=True)
class Lux:
    """Illuminance over points of the floor."""

    minimum: float
    mean: float
    maximum: float


@dataclass(frozen=True)
class LightLevels:
    """The light of a garage.

    Attributes
    ----------
    luminance_nit
        Of the lit face of each lamp that burns, cd/m2.
    flux_lm
        Of each of them: pi x luminance x area.
    lanes, stalls
        Direct light on the floor by the point-by-point method: on nine points of each lane square, and in the middle
        of each stall; None where there is none.
    lumen_method_lux
        Mean over the whole floor by the lumen method, reflections included.
    lamps, dead_lamps
        How many there are over lanes and stalls, and how many of them give no light.
    """

    luminance_nit: float
    flux_lm: float
    lanes: Lux | None
    stalls: Lux | None
    lumen_method_lux: float
    lamps: int = 0
    dead_lamps: int = 0


def light_up(
    lamps: Sequence[Placement],
    lane_points: NDArray[np.float64],
    floor_m2: float,
    stalls: Sequence[PlacedStall],
    fittings: FittingsConfig,
) -> tuple[list[Placement], LightLevels]:
    """The same lamps with the luminance that the floor needs, and what the floor then gets.

    Notes
    -----
    ``E(p) = MF L sum dA h^2 / r^4`` for level lamps over a level floor, each in three pieces, without what stands in
    the way; beams cut off less than half a per cent. L is the least with which the mean direct light on lanes reaches
    ``lane_lux`` and that on stalls ``stall_lux`` while all lamps burn; what is told is without those that are dead.
    The lumen method has ``E = N Phi UF MF / A``.
    """
    stall_points = np.array([stall.centre_m for stall in stalls]).reshape(-1, 2)
    new = [replace(lamp, spec=replace(spec, is_dead=False)) for lamp, spec in of_spec(lamps, LampSpec)]
    unit_lanes, unit_stalls = (direct_lux(points, new) for points in (lane_points, stall_points))
    needs = [
        target / unit.mean()
        for target, unit in ((fittings.lane_lux, unit_lanes), (fittings.stall_lux, unit_stalls))
        if unit.size and unit.mean() > 0
    ]
    luminance = round(max(needs), 1) if needs else 0.0
    lit = [
        replace(lamp, spec=replace(spec, luminance_nit=0.0 if spec.is_dead else luminance))
        for lamp, spec in of_spec(lamps, LampSpec)
    ]
    burning = [spec for _, spec in of_spec(lit, LampSpec) if not spec.is_dead]
    if len(burning) < len(lit):
        unit_lanes, unit_stalls = (direct_lux(points, lit) for points in (lane_points, stall_points))
    flux = sum(np.pi * luminance * spec.area_m2 for spec in burning)
    each = flux / len(burning) if burning else 0.0
    return lit, LightLevels(
        luminance,
        each,
        _lux(luminance * unit_lanes),
        _lux(luminance * unit_stalls),
        flux * UTILISATION * MAINTENANCE / floor_m2,
        len(lit),
        len(lit) - len(burning),
    )


def direct_lux(points: NDArray[np.float64], lamps: Sequence[Placement]) -> NDArray[np.float64]:
    """Direct, maintained illuminance of points (x, z) on the floor for a luminance of 1 cd/m2; shape (n,).

    Dead lamps give none.
    """
    pieces, areas, heights = _pieces(lamps)
    if not len(points) or not len(pieces):
        return np.zeros(len(points))
    sources = Points(pieces)
    total = np.zeros(len(points))
    for start in range(0, len(points), _POINTS_AT_ONCE):
        some = points[start : start + _POINTS_AT_ONCE]
        point, source, far_m = sources.within(_REACH_M, some)
        squared_m2 = far_m**2 + heights[source] ** 2
        lux = MAINTENANCE * areas[source] * heights[source] ** 2 / squared_m2**2
        total[start : start + len(some)] = np.bincount(point, weights=lux, minlength=len(some))
    return total


def _pieces(lamps: Sequence[Placement]) -> tuple[NDArray[np.float64], NDArray[np.float64], NDArray[np.float64]]:
    """Middles (x, z), areas and heights over the floor of equal pieces of all lamps that burn."""
    middles, areas, heights = [], [], []
    for lamp, spec in of_spec(lamps, LampSpec):
        if spec.is_dead:
            continue
        x, y, z = lamp.position_m
        for index in range(_SEGMENTS):
            along = ((index + 0.5) / _SEGMENTS - 0.5) * spec.length_m
            middles.append((x + along * elementary.cos(lamp.yaw_rad), z - along * elementary.sin(lamp.yaw_rad)))
            areas.append(spec.area_m2 / _SEGMENTS)
            heights.append(y - spec.drop_m)
    return np.array(middles), np.array(areas), np.array(heights)


def lane_points_of(squares: Iterable[tuple[float, float, float, float]]) -> NDArray[np.float64]:
    """Nine points (x, z) on each lane square, given by its middle (x, z) and its extent along X and Z."""
    shares = (np.arange(_POINTS_A_SIDE) + 0.5) / _POINTS_A_SIDE - 0.5
    points = [(x + u * width, z + v * depth) for x, z, width, depth in squares for u in shares for v in shares]
    return np.array(points).reshape(-1, 2)


def _lux(values: NDArray[np.float64]) -> Lux | None:
    if not values.size:
        return None
    return Lux(*(round(float(value), 2) for value in (values.min(), values.mean(), values.max())))
