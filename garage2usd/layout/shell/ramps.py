"""Vehicle ramps from street level to the portals, with their lights, sky and barrier gates."""

from collections.abc import Iterable
from dataclasses import replace

import numpy as np
import shapely

from garage2usd.config import FittingsConfig
from garage2usd.config.look import WallsLook
from garage2usd.config.site import DOOR_FRAME_M
from garage2usd.garage import Point
from garage2usd.layout.ceiling.lighting import TUBE
from garage2usd.layout.fittings import TUBE_DEPTH_M
from garage2usd.layout.placement import Placement, of_spec, placed
from garage2usd.objects.barrier import ARM_BEFORE_M, ARM_HALF_M, PIVOT_M, BarrierSpec
from garage2usd.objects.beam import BeamSpec
from garage2usd.objects.lit_sign import LEAST_SIGN_M
from garage2usd.objects.portal import PortalSpec
from garage2usd.objects.ramp import RampSpec
from garage2usd.objects.sky import SkySpec

_PARAPET_M = 1.3
_SKY_M = 3.0
_KERB_ROOM_M = 0.1
_BARRIER_GAP_M = 0.32
_BARRIER_NEAR_M, _BARRIER_FAR_M = 0.9, 2.6
_LEGIBLE_SIGN_M = 0.2
"""Least height of a sign below a raised arm."""
_LIGHTS_AT = (0.25, 0.6)
"""Places of the ramp lights, as shares of the covered part's length."""
_ARM_GAP_M = 0.005


def with_ramps(
    walls: list[Placement], inside: shapely.Geometry, fittings: FittingsConfig, look: WallsLook
) -> list[Placement]:
    """Add a ramp and its sky behind each vehicle door with enough room, and open these doors.

    Parameters
    ----------
    walls
        The outer walls with a closed door in each portal.
    inside
        The garage's squares, (x, z) in metres.
    fittings
        Heights, and the switch of ramps.
    look
        Look of the walls.

    Notes
    -----
    The footprint of a ramp must be clear of the garage, its walls and the previous ramps.
    """
    if not fittings.ramps:
        return walls
    taken = inside.buffer(fittings.wall_thickness_m, join_style="mitre")
    opened: list[Placement] = []
    ramps: list[Placement] = []
    for wall in walls:
        if not isinstance(wall.spec, PortalSpec):
            opened.append(wall)
            continue
        spec = _ramp(wall.spec, fittings, look)
        ground = _ground(spec, wall)
        if ground.intersection(taken).area > 1e-6:  # noqa: PLR2004 - they may touch
            opened.append(wall)
            continue
        taken = taken.union(ground)
        opened.append(replace(wall, spec=replace(wall.spec, is_open=True)))
        for kind, shape in (("Ramp", spec), ("Sky", _sky(spec))):
            name = wall.name.replace("Portal", kind)
            ramps.append(Placement(name, shape, wall.position_m, wall.yaw_rad))
    return [*opened, *ramps]


def _ramp(portal: PortalSpec, fittings: FittingsConfig, look: WallsLook) -> RampSpec:
    """Return the ramp behind a vehicle door."""
    runs, heights = zip(*fittings.ramp_profile, strict=True)
    rise, transition = heights[-1], heights[2]
    # the slab over the ramp's foot ends at the clear height over the ramp's floor
    room = max(portal.height_m - fittings.clear_height_m, transition / 2)
    cover_end = float(np.interp(room, heights[1:-1], runs[1:-1]))
    return RampSpec(
        width_m=round(portal.door_width_m + 2 * _KERB_ROOM_M, 6),
        wall_m=portal.thickness_m,
        threshold_width_m=round(portal.door_width_m - 2 * DOOR_FRAME_M, 6),
        profile=fittings.ramp_profile,
        cover_end_m=round(cover_end, 6),
        cover_height_m=portal.height_m,
        wall_top_m=round(rise + _PARAPET_M, 6),
        dado_m=look.dado_m,
        has_stripe=look.has_stripe,
    )


def _sky(ramp: RampSpec) -> SkySpec:
    """Return the sky over the open part of a ramp."""
    end, ground = ramp.profile[-1]
    return SkySpec(
        width_m=round(ramp.width_m + 2 * ramp.wall_m, 6),
        start_m=ramp.cover_end_m,
        end_m=round(end + 0.01, 6),
        ground_m=round(ground - 0.05, 6),
        low_m=ramp.wall_top_m,
        high_m=round(ramp.wall_top_m + _SKY_M, 6),
    )


def _ground(ramp: RampSpec, wall: Placement) -> shapely.Polygon:
    """Return the footprint (x, z) of a ramp with its side walls, from the back of the door's wall."""
    half, near, far = ramp.width_m / 2 + ramp.wall_m, -ramp.profile[0][0], -ramp.profile[-1][0]
    corners = ((-half, near), (half, near), (half, far), (-half, far))
    return shapely.Polygon([wall.to_world(corner) for corner in corners])


def ramp_lights(walls: Iterable[Placement], fittings: FittingsConfig) -> list[Placement]:
    """Place tube lights across each ramp's covered part, above the clear height only."""
    lights: list[Placement] = []
    for ramp, spec in of_spec(walls, RampSpec):
        runs, heights = zip(*spec.profile, strict=True)
        for number, share in enumerate(_LIGHTS_AT, start=1):
            run = runs[0] + share * (spec.cover_end_m - runs[0])
            floor = float(np.interp(run, runs, heights))
            if spec.cover_height_m - TUBE.drop_m - floor < fittings.clear_height_m:
                continue
            name, height = f"{ramp.name.replace('Ramp', 'Tube')}_{number}", spec.cover_height_m
            lights.append(placed(name, TUBE, ramp.to_world((0.0, -run)), height_m=height, yaw_rad=ramp.yaw_rad))
    return lights


def with_barriers(
    walls: list[Placement],
    fittings: FittingsConfig,
    beams: Iterable[Placement] = (),
    kept_clear: shapely.Geometry | None = None,
) -> tuple[list[Placement], list[Placement]]:
    """Place a barrier gate inside each open vehicle door, on the driver's left; every other gate is raised.

    Doors for both directions have none, nor have those beside which ground is kept clear.

    A raised arm folds under the lights and the beams beside the door, above the clear height and above the sign over
    the door, so that nobody's view of the sign passes through it. The gate is lowered instead where that leaves no
    legible sign.

    Returns
    -------
    tuple of list of Placement
        The walls, with the signs of their doors below raised arms, and the gates.
    """
    if not fittings.barriers:
        return walls, []
    seen: list[Placement] = []
    gates: list[Placement] = []
    for wall in walls:
        portal = wall.spec
        if not isinstance(portal, PortalSpec) or not portal.is_open or portal.is_entrance is None:
            seen.append(wall)
            continue
        half = portal.door_width_m / 2 - DOOR_FRAME_M
        arm_m = round(2 * half + _BARRIER_GAP_M, 3)
        left, along, turn = (1, _BARRIER_FAR_M, 0.0) if portal.is_entrance else (-1, _BARRIER_NEAR_M, np.pi)
        place = wall.to_world((left * (half + _BARRIER_GAP_M), along))
        if kept_clear is not None and kept_clear.intersects(shapely.Point(place)):
            seen.append(wall)
            continue
        upright = wall.to_world((left * (half + _BARRIER_GAP_M), along + left * ARM_BEFORE_M))
        top_m = min(portal.height_m - TUBE_DEPTH_M, _underside_m(beams, upright)) - _ARM_GAP_M - ARM_HALF_M
        upright_m = PIVOT_M + 2 * half
        elbow_m, below = min(top_m, upright_m), portal
        if top_m < upright_m:  # else the raised arm stands beside the opening
            below = replace(portal, raised_arm_m=round(elbow_m - ARM_HALF_M - _ARM_GAP_M, 3))
        has_room = elbow_m - ARM_HALF_M >= fittings.clear_height_m + _ARM_GAP_M
        is_raised = has_room and len(gates) % 2 == 0 and (_is_legible(below) or not _has_sign(portal))
        seen.append(replace(wall, spec=below) if is_raised else wall)
        spec = BarrierSpec(arm_m, is_raised=is_raised, elbow_m=round(elbow_m, 3))
        yaw = round(float(np.remainder(wall.yaw_rad + turn + np.pi, 2 * np.pi) - np.pi), 6)
        gates.append(placed(wall.name.replace("Portal", "Barrier"), spec, place, yaw_rad=yaw))
    return seen, gates


def _underside_m(beams: Iterable[Placement], place: Point) -> float:
    """Return the height of the lowest beam over the upright arm of a gate, infinite without one."""
    lowest_m = np.inf
    for beam, spec in of_spec(beams, BeamSpec):
        x, z = (beam.position_m[k] - there for k, there in zip((0, 2), place, strict=True))
        cos, sin = np.cos(beam.yaw_rad), np.sin(beam.yaw_rad)
        across_m, along_m = abs(cos * x - sin * z), abs(sin * x + cos * z)
        if across_m < spec.width_m / 2 + 2 * ARM_HALF_M and along_m < spec.length_m / 2 + 2 * ARM_HALF_M:
            lowest_m = min(lowest_m, beam.position_m[1] - spec.depth_m)
    return float(lowest_m)


def _has_sign(portal: PortalSpec) -> bool:
    low_m, high_m = portal.sign_heights_m
    return high_m - low_m >= LEAST_SIGN_M


def _is_legible(portal: PortalSpec) -> bool:
    low_m, high_m = portal.sign_heights_m
    return high_m - low_m >= _LEGIBLE_SIGN_M
