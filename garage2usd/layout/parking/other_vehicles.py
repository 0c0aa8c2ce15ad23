"""Parked vehicles that are not of the catalogue: cars of the user's models, and motorcycles."""

import math
from dataclasses import replace
from statistics import NormalDist

from garage2usd.common.randomness import Step
from garage2usd.config import ParkingConfig
from garage2usd.config.own_cars import OwnCar, VehiclesConfig, read_own_cars
from garage2usd.config.vehicles import PAINTS, CarBody
from garage2usd.garage import StallUse
from garage2usd.layout.draws import SquareDraws
from garage2usd.layout.parking.designation import room_for_charger_m
from garage2usd.layout.parking.parked_cars import ParkedCars, occupancy_of
from garage2usd.layout.placement import PlacedStall, Placement, rounded
from garage2usd.native import elementary
from garage2usd.objects.car import CarSpec, car_spec
from garage2usd.objects.motorbike import MOTORBIKE_COLOURS, MotorbikeSpec

_CLEARANCE_M = 0.1
"""Distance from the lines and the entry of a stall."""
_DRAWS = 7
_SCOOTER_SHARE, _REVERSED_SHARE = 0.4, 0.3
"""Assumptions."""
_YAW_SPREAD_DEG, _MOST_YAW_DEG = 2.0, 5.0
_BESIDE_SPREAD_M, _MOST_BESIDE_M = 0.04, 0.1
"""Spread and greatest distance of a motorcycle's middle from the middle line of its stall. Assumption."""
_FROM_END_M = 0.1
_USUAL = NormalDist()


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


def park_motorbikes(stalls: tuple[PlacedStall, ...], parking: ParkingConfig, draws: SquareDraws) -> list[Placement]:
    """Park random motorcycles upright on their stands, within their stalls and clear of each other.

    Parameters
    ----------
    stalls
        All stalls.
    parking
        Share of the stalls that are taken, and the stalls that the user names.
    draws
        Random numbers; those of motorcycles have a name of their own, so that they do not move any car.
    """
    own = [stall for stall in stalls if stall.use is StallUse.MOTORCYCLE]
    if not own:
        return []
    numbers = draws.of_part(Step.CARS, "motorcycles", max(stall.ordinal for stall in own), _DRAWS)
    is_taken = occupancy_of(stalls, parking)
    placements = []
    for stall in own:
        taken, colour, scooter, turned, yaw, beside, along = numbers[stall.square][stall.ordinal - 1].tolist()
        if is_taken.get(stall.name, taken < parking.occupancy):
            spec = MotorbikeSpec(MOTORBIKE_COLOURS[int(colour * len(MOTORBIKE_COLOURS))], scooter < _SCOOTER_SHARE)
            placements.append(_placement(stall, spec, yaw, beside, along, is_reversed=turned < _REVERSED_SHARE))
    return placements


def _placement(
    stall: PlacedStall, spec: MotorbikeSpec, yaw: float, beside: float, along: float, *, is_reversed: bool
) -> Placement:
    """Place a motorcycle; numbers from 0 to 1 decide its yaw and its position across and along the stall."""
    (corners,) = spec.outlines()
    half_x, half_z = (max(abs(corner[axis]) for corner in corners) for axis in (0, 1))
    lean = math.radians(_normal(yaw, _YAW_SPREAD_DEG, _MOST_YAW_DEG))
    reach_z = half_z + half_x * abs(lean)
    side_m = _normal(beside, _BESIDE_SPREAD_M, _MOST_BESIDE_M)
    room_m = max(stall.length_m / 2 - _FROM_END_M - reach_z, 0.0)
    # parked nose-in, it faces away from the mouth, which is at +Z
    ahead = 0.0 if is_reversed else math.pi
    turned = round(math.remainder(stall.yaw_rad + ahead + lean, math.tau), 6)
    return stall.placement("Motorbike", spec, (side_m, (2 * along - 1) * room_m), yaw_rad=turned)


def _normal(share: float, spread: float, most: float) -> float:
    """Quantile at a share from 0 to 1 of a normal distribution around 0, limited to a greatest distance from 0."""
    return min(max(_USUAL.inv_cdf(min(max(share, 1e-9), 1 - 1e-9)) * spread, -most), most)
