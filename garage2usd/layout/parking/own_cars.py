"""Parked cars of the user's models, in place of cars of the catalogue."""

from dataclasses import replace

from garage2usd.common.randomness import Step
from garage2usd.config.own_cars import OwnCar, VehiclesConfig, read_own_cars
from garage2usd.config.vehicles import PAINTS, CarBody
from garage2usd.layout.draws import SquareDraws
from garage2usd.layout.parking.designation import room_for_charger_m
from garage2usd.layout.parking.parked_cars import ParkedCars
from garage2usd.layout.placement import PlacedStall, Placement, rounded
from garage2usd.native import elementary
from garage2usd.objects.car import CarSpec, car_spec

__all__ = ["with_own_cars"]

_CLEARANCE_M = 0.1
"""Distance from the lines and the entry of a stall."""


def with_own_cars(
    parked: ParkedCars, stalls: tuple[PlacedStall, ...], vehicles: VehiclesConfig, draws: SquareDraws
) -> ParkedCars:
    """Replace a share of the parked cars by models of the user.

    A model has the yaw of the car that it replaces, and its rear (or its nose) at the same distance from the stall's
    rear. A car is kept if no model fits between the lines at its pose, or if it stands over a line. These draws move no
    other car.

    Raises
    ------
    ConfigError
        If the models have changed since the settings were read.
    """
    if vehicles.models is None:
        return parked
    _, models = read_own_cars(vehicles.models)
    by_name = {stall.name: stall for stall in stalls}
    most = max((stall.ordinal for stall in stalls), default=0)
    numbers = draws.of_part(Step.CARS, "own_models", most, 2)
    result = []
    for car in parked.cars:
        stall = by_name.get(car.stall or "")
        stays = car.stall in parked.reaching or car.stall in parked.misparked
        if stays or stall is None or car.ordinal is None or not isinstance(car.spec, CarSpec):
            result.append(car)
            continue
        is_own, which = numbers[stall.square][car.ordinal - 1].tolist()
        asked = models if is_own < vehicles.share else ()
        fitting = [placed for model in asked if (placed := _in_place_of(car, car.spec, model, stall)) is not None]
        result.append(fitting[int(which * len(fitting))] if fitting else car)
    return parked._replace(cars=result)


def _in_place_of(car: Placement, spec: CarSpec, model: OwnCar, stall: PlacedStall) -> Placement | None:
    """Place a model instead of a car, moved so that it is within the stall; None if the stall is too small."""
    turn = car.yaw_rad - stall.yaw_rad
    is_reversed = elementary.cos(turn) < 0
    # in the stall's coordinates, with its entry at +Z
    dx, dz = car.position_m[0] - stall.centre_m[0], car.position_m[2] - stall.centre_m[1]
    cos, sin = elementary.cos(stall.yaw_rad), elementary.sin(stall.yaw_rad)
    x, z = dx * cos - dz * sin, dx * sin + dz * cos
    half_x, half_z = model.half_extents_m(turn)
    side = stall.width_m / 2 - _CLEARANCE_M - half_x
    # the rear wheels keep their position in front of the wheel stop
    rear = z - _behind_wheels(spec.measures, is_reversed=is_reversed)
    z = rear + _behind_wheels(model, is_reversed=is_reversed)
    behind_m = max(_CLEARANCE_M, room_for_charger_m(stall))
    mouth = stall.length_m / 2 - _CLEARANCE_M - half_z
    if side < 0 or z > mouth or z < half_z - stall.length_m / 2 + behind_m:
        return None
    point = rounded(stall.to_world((min(max(x, -side), side), z)))
    return replace(car, spec=car_spec(model, PAINTS[0]), position_m=(point[0], car.position_m[1], point[1]))


def _behind_wheels(body: CarBody, *, is_reversed: bool) -> float:
    """Distance from the tyres nearest to the stall's rear to the centre of the car."""
    axle_m = body.rear_axle_m if is_reversed else body.length_m / 2 - body.front_overhang_m
    return axle_m + body.wheel_radius_m
