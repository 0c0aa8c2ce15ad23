"""Lamps in the places of tube lights, and their luminance for the required floor illuminance."""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from garage2usd.common.randomness import Step, named_generator
from garage2usd.config import FittingsConfig
from garage2usd.config.look import LampKind, LightsLook
from garage2usd.layout.draws import SquareDraws
from garage2usd.layout.grounds import Points
from garage2usd.layout.placement import PlacedStall, Placement, of_spec
from garage2usd.native import elementary
from garage2usd.objects.lamp import LampSpec

UTILISATION, MAINTENANCE = 1.0, 0.8
"""Utilisation factor of downlights in a room with an index above 5 and grey surfaces, and maintenance factor of tubes
that are cleaned yearly."""
_REACH_M = 25.0
_POINTS_AT_ONCE = 4096
"""Number of points computed at once, which limits memory."""
_SEGMENTS = 3
_POINTS_A_SIDE = 3
TUBE = LampSpec(length_m=1.5, width_m=0.12)
"""Tube light without a luminance; the places of lamps are independent of their form."""
_FORMS = {
    LampKind.TUBES: TUBE,
    LampKind.PANELS: LampSpec(length_m=0.595, width_m=0.595, drop_m=0.064, form=LampKind.PANELS),
    LampKind.ROUND: LampSpec(length_m=0.4, width_m=0.4, drop_m=0.105, form=LampKind.ROUND),
}
_EMERGENCY_OF = 8
"""One lamp in this many has a battery."""
_STEPS = (-1.463, -0.599, 0.0, 0.599, 1.463)
"""Medians of the quintiles of a normal distribution, scaled to a standard deviation of 1."""
_LEAST_K = 1700.0
_DEAD, _TEMPERATURE = range(2)


@dataclass(frozen=True)
class Lux:
    """Illuminance over points of the floor."""

    minimum: float
    mean: float
    maximum: float


@dataclass(frozen=True)
class LightLevels:
    """Light levels of a garage.

    Attributes
    ----------
    luminance_nit
        Luminance of the lit face of each working lamp, cd/m2.
    flux_lm
        Luminous flux of each working lamp: pi x luminance x area.
    lanes, stalls
        Direct illuminance of the floor by the point-by-point method: at nine points of each lane square, and at the
        centre of each stall; None if there are none.
    lumen_method_lux
        Mean illuminance of the whole floor by the lumen method, reflections included.
    lamps, dead_lamps
        Numbers of lamps over lanes and stalls, and of dead ones among them.
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
    """Set the luminance of lamps to the least that the floor requires, and compute the resulting light levels.

    Notes
    -----
    ``E(p) = MF L sum dA h^2 / r^4`` for level lamps over a level floor, each divided into three pieces, without
    shadows; beams block less than half a per cent. L is the least luminance for which the mean direct illuminance
    reaches ``lane_lux`` on lanes and ``stall_lux`` on stalls while all lamps burn. The returned levels exclude dead
    lamps. The lumen method is ``E = N Phi UF MF / A``.
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

    Dead lamps contribute nothing.
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
    """Centres (x, z), areas and heights above the floor of equal pieces of all working lamps."""
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
    """Nine points (x, z) on each lane square, given by its centre (x, z) and its extent along X and Z."""
    shares = (np.arange(_POINTS_A_SIDE) + 0.5) / _POINTS_A_SIDE - 0.5
    points = [(x + u * width, z + v * depth) for x, z, width, depth in squares for u in shares for v in shares]
    return np.array(points).reshape(-1, 2)


def _lux(values: NDArray[np.float64]) -> Lux | None:
    if not values.size:
        return None
    return Lux(*(round(float(value), 2) for value in (values.min(), values.mean(), values.max())))


def installed_lamps(
    tubes: Sequence[Placement], lights: LightsLook, draws: SquareDraws, *, seed: int
) -> tuple[Placement, ...]:
    """Replace the tube lights over squares by the lamps of the look.

    Parameters
    ----------
    tubes
        Tube lights in reading order, those of a square in sequence.
    lights
        Form, colour and share of dead lamps.
    draws
        Random numbers of each square. Lamps in equal places of squares with equal numbers are equal, except for the
        emergency lighting.
    seed
        Seed of the garage.
    """
    numbers = draws.of_part(Step.LOOK, "lights.lamps", 1 + max(map(_index_on_square, tubes), default=0), 2)
    rows = [numbers[tube.square][_index_on_square(tube)] for tube in tubes if tube.square is not None]
    return _lamps(tubes, lights, np.array(rows).reshape(-1, 2), named_generator(seed, Step.LOOK, "lights.emergency"))


def ramp_lamps(
    tubes: Sequence[Placement], lights: LightsLook, luminance_nit: float, *, seed: int
) -> tuple[Placement, ...]:
    """Give the tube lights over ramps the luminance of those over squares; return none if that is 0."""
    if not luminance_nit:
        return ()
    generator = named_generator(seed, Step.LOOK, "lights.ramps")
    numbers = generator.random((len(tubes), 2))
    return tuple(
        lamp if spec.is_dead else replace(lamp, spec=replace(spec, luminance_nit=luminance_nit))
        for lamp, spec in of_spec(_lamps(tubes, lights, numbers, generator), LampSpec)
    )


def _lamps(
    tubes: Iterable[Placement], lights: LightsLook, numbers: NDArray[np.float64], emergency: np.random.Generator
) -> tuple[Placement, ...]:
    """Return the lamps; two random numbers for each decide if it is dead, and its colour temperature."""
    is_dead = numbers[:, _DEAD] < lights.dead_share
    if lights.emergency_only:
        is_dead |= ~_with_battery(len(numbers), emergency)
    step = (numbers[:, _TEMPERATURE] * len(_STEPS)).astype(int)
    kelvin = np.maximum(np.round(lights.temperature_k + lights.spread_k * np.array(_STEPS)[step]), _LEAST_K)
    if not lights.spread_k:
        kelvin = np.full(len(numbers), lights.temperature_k)
    usual = _FORMS[lights.lamps]
    return tuple(
        replace(tube, spec=replace(usual, temperature_k=temperature_k, is_dead=dead))
        for tube, temperature_k, dead in zip(tubes, kelvin.tolist(), is_dead.tolist(), strict=True)
    )


def _with_battery(count: int, generator: np.random.Generator) -> NDArray[np.bool_]:
    """Choose one random lamp of every eight consecutive ones for battery supply; bool, shape (count,)."""
    starts = np.arange(0, count, _EMERGENCY_OF)
    chosen = np.zeros(count, dtype=bool)
    chosen[starts + generator.integers(np.minimum(_EMERGENCY_OF, count - starts))] = True
    return chosen


def _index_on_square(tube: Placement) -> int:
    """Return the index of a lamp on its square, from 0."""
    return int(tube.name.rpartition("_")[2]) - 1
