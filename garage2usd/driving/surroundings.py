"""What stands on the floor of a garage and a car could touch, as named shapes."""

from collections.abc import Iterator

import shapely

from garage2usd.config.vehicles import CAR_BODIES
from garage2usd.driving.obstacles import Obstacles
from garage2usd.layout import Layout, ObjectKind, Placement
from garage2usd.layout import specs as s
from garage2usd.layout.building import DOOR_FRAME_M
from garage2usd.layout.placement import to_world

__all__ = ["fixed_objects", "object_name", "parked_cars"]

_TOUCHABLE = (
    ObjectKind.WALL,
    ObjectKind.PORTAL,
    ObjectKind.RAMP,
    ObjectKind.OBSTACLE,
    ObjectKind.COLUMN,
    ObjectKind.BARRIER,
    ObjectKind.NO_PARKING_SIGN,
    ObjectKind.CONE,
    ObjectKind.CHARGER,
    ObjectKind.WHEEL_STOP,
)
_BODIES = {body.name: body for body in CAR_BODIES}
_ARCHES_M = 0.01
"""How far the wheel arches stand out of a car's body."""
_MIRRORS_FROM_NOSE_M = (1.05, 1.75)
"""Where the mirrors of all bodies are."""
_WHEEL_STOP_M, _CONE_M, _SIGN_M = 0.15, 0.38, 0.6
_CHARGER = s.rectangle(-0.16, -0.045, 0.16, 0.065)
_GATE = (s.rectangle(-0.2, -0.2, 0.2, 0.2), s.rectangle(-0.17, -1.9, 0.17, -1.5))
_CORE_DOOR_M = (1.2, 0.09)
"""Width of the door of a stair core with its frame, and how far it stands out of the wall."""
_FRAME_PROUD_M = 0.02
_ARM_Z_M = (0.18, 0.26)


def fixed_objects(layout: Layout) -> Obstacles:
    """Everything in a garage that a car could touch, but the parked cars; each by its `object_name`.

    Notes
    -----
    Wheel stops count, as no tyre goes over them; the arms of all gates are down; speed bumps do not count, nor does
    what hangs over the cars or is painted.
    """
    placements = layout.placements
    return _named_shapes(placements.at(placements.rows_of(*_TOUCHABLE)))


def parked_cars(layout: Layout) -> Obstacles:
    """The cars of a garage with their mirrors, each by its `object_name`."""
    return _named_shapes(layout.of_kind(ObjectKind.CAR))


def object_name(place: Placement) -> str:
    """A name that no other object of the garage has: ``r03_c07/Car_2`` on a square, else its own."""
    if place.square is None:
        return place.name
    row, col = place.square
    return f"r{row:02d}_c{col:02d}/{place.name}"


def _named_shapes(placements: tuple[Placement, ...] | list[Placement]) -> Obstacles:
    return Obstacles.of(
        (
            object_name(place),
            shapely.MultiPolygon(
                [
                    shapely.Polygon([to_world(corner, place.position_m[::2], place.yaw_rad) for corner in outline])
                    for outline in _outlines(place.spec)
                ]
            ),
        )
        for place in placements
    )


def _outlines(spec: s.Spec) -> Iterator[s.Polygon]:  # noqa: C901, PLR0912 - a case for each kind of object
    """Convex outlines on the floor, in the coordinates of a spec, that hold all of it that a car could touch."""
    match spec:
        case s.WallSpec():
            yield s.rectangle(-spec.length_m / 2, -spec.thickness_m, spec.length_m / 2, 0.0)
        case s.PortalSpec():
            half, opening = spec.length_m / 2, spec.door_width_m / 2 - DOOR_FRAME_M if spec.is_open else 0.0
            yield s.rectangle(-half, -spec.thickness_m, -opening, _FRAME_PROUD_M)
            yield s.rectangle(opening, -spec.thickness_m, half, _FRAME_PROUD_M)
        case s.RampSpec():
            inner, outer = spec.width_m / 2, spec.width_m / 2 + spec.wall_m
            near, far = -spec.profile[0][0], -spec.profile[-1][0]
            yield s.rectangle(-outer, far, -inner, near)
            yield s.rectangle(inner, far, outer, near)
        case s.WallPostSpec():
            yield _square(spec.side_m)
        case s.ObstacleSpec():
            yield s.rectangle(-spec.width_m / 2, -spec.depth_m / 2, spec.width_m / 2, spec.depth_m / 2)
            if not spec.has_door:
                return
            half, face = min(_CORE_DOOR_M[0] / 2, spec.width_m / 2), spec.depth_m / 2
            yield s.rectangle(-half, face, half, face + _CORE_DOOR_M[1])
        case s.ColumnSpec():
            yield _square(spec.size_m)
        case s.BarrierSpec():
            yield from _GATE
            yield s.rectangle(-spec.arm_m, _ARM_Z_M[0], _ARM_Z_M[1] - _ARM_Z_M[0], _ARM_Z_M[1])
        case s.WheelStopSpec():
            yield s.rectangle(-spec.length_m / 2, -_WHEEL_STOP_M / 2, spec.length_m / 2, _WHEEL_STOP_M / 2)
        case s.ChargerSpec():
            yield _CHARGER
        case s.ConeSpec():
            yield _square(_CONE_M)
        case s.NoParkingSignSpec():
            yield _square(_SIGN_M)
        case s.CarSpec():
            body = _BODIES[spec.body]
            half, end = body.width_m / 2 + _ARCHES_M, body.length_m / 2
            yield s.rectangle(-half, -end, half, end)
            half, (first, last) = body.overall_width_m / 2, _MIRRORS_FROM_NOSE_M
            yield s.rectangle(-half, first - end, half, last - end)


def _square(side_m: float) -> s.Polygon:
    return s.rectangle(-side_m / 2, -side_m / 2, side_m / 2, side_m / 2)
