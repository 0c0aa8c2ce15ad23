"""The motorcycles parked in the stalls for them."""

import math
from statistics import NormalDist

from garage2usd.common.randomness import Step
from garage2usd.config import ParkingConfig
from garage2usd.garage import StallUse
from garage2usd.layout.draws import SquareDraws
from garage2usd.layout.parking.parked_cars import occupancy_of
from garage2usd.layout.placement import PlacedStall, Placement
from garage2usd.objects.motorbike import MOTORBIKE_COLOURS, MotorbikeSpec

__all__ = ["park_motorbikes"]

_DRAWS = 7
_SCOOTER_SHARE, _REVERSED_SHARE = 0.4, 0.3
"""Assumptions."""
_YAW_SPREAD_DEG, _MOST_YAW_DEG = 2.0, 5.0
_BESIDE_SPREAD_M, _MOST_BESIDE_M = 0.04, 0.1
"""Of the middle of a motorcycle from that of its stall, across it. Assumption."""
_FROM_END_M = 0.1
_USUAL = NormalDist()


def park_motorbikes(stalls: tuple[PlacedStall, ...], parking: ParkingConfig, draws: SquareDraws) -> list[Placement]:
    """Random motorcycles upright on their stands, none of which leaves its stall or touches another.

    Parameters
    ----------
    stalls
        All stalls.
    parking
        Share of the stalls that are taken, and those that are named.
    draws
        Random numbers, a part of the step of cars with a name of its own, so that no car moves.
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
    """A motorcycle with its yaw and its place across and along its stall by their shares from 0 to 1."""
    (corners,) = spec.outlines()
    half_x, half_z = (max(abs(corner[axis]) for corner in corners) for axis in (0, 1))
    lean = math.radians(_normal(yaw, _YAW_SPREAD_DEG, _MOST_YAW_DEG))
    reach_z = half_z + half_x * abs(lean)
    side_m = _normal(beside, _BESIDE_SPREAD_M, _MOST_BESIDE_M)
    room_m = max(stall.length_m / 2 - _FROM_END_M - reach_z, 0.0)
    # nose in it faces away from the mouth, which is at +Z
    ahead = 0.0 if is_reversed else math.pi
    turned = round(math.remainder(stall.yaw_rad + ahead + lean, math.tau), 6)
    return stall.placement("Motorbike", spec, (side_m, (2 * along - 1) * room_m), yaw_rad=turned)


def _normal(share: float, spread: float, most: float) -> float:
    """The value at a share from 0 to 1 of a normal distribution around 0, at most as far from it as given."""
    return min(max(_USUAL.inv_cdf(min(max(share, 1e-9), 1 - 1e-9)) * spread, -most), most)
