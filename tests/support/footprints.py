"""Independent footprints of placements, by shapely's own affine transforms."""

import math

import numpy as np
import shapely
from shapely import affinity

from garage2usd.config.vehicles import CAR_BODIES
from garage2usd.objects.barrier import BarrierSpec
from garage2usd.objects.beam import BeamNodeSpec, BeamSpec
from garage2usd.objects.cable_tray import CableTraySpec
from garage2usd.objects.car import CarSpec
from garage2usd.objects.ceiling import CeilingSpec
from garage2usd.objects.charger import ChargerSpec
from garage2usd.objects.coil import CoilSpec, CrossingSpec
from garage2usd.objects.column import ColumnSpec
from garage2usd.objects.cone import ConeSpec
from garage2usd.objects.drain import DrainSpec
from garage2usd.objects.duct import DuctSpec
from garage2usd.objects.exit_sign import ExitSignSpec
from garage2usd.objects.fire_extinguisher import FireExtinguisherSpec
from garage2usd.objects.fire_shutter import FireShutterSpec
from garage2usd.objects.flight import FlightSpec
from garage2usd.objects.floor_stain import PuddleSpec, StainSpec, TyreMarkSpec
from garage2usd.objects.hydrant_cabinet import HydrantCabinetSpec
from garage2usd.objects.lamp import LampSpec
from garage2usd.objects.lane_sign import LaneSignSpec
from garage2usd.objects.level_plate import LevelPlateSpec
from garage2usd.objects.level_sign import LevelSignSpec
from garage2usd.objects.mirror import MirrorSpec
from garage2usd.objects.no_parking_sign import NoParkingSignSpec
from garage2usd.objects.number_plate import NumberPlateSpec
from garage2usd.objects.obstacle import ObstacleSpec
from garage2usd.objects.panel import PanelSpec
from garage2usd.objects.portal import PortalSpec
from garage2usd.objects.ramp import RampSpec
from garage2usd.objects.speed_bump import SpeedBumpSpec
from garage2usd.objects.sprinkler import SprinklerSpec
from garage2usd.objects.stall import StallSpec
from garage2usd.objects.stall_number import NumberFrameSpec, NumberSpec, WallNumberSpec
from garage2usd.objects.wall import WallPostSpec, WallSpec
from garage2usd.objects.wheel_stop import WheelStopSpec
from garage2usd.objects.zone_plate import ColumnPlatesSpec, ZonePlateSpec


def footprint(placement):
    """The (x, z) polygon that an object covers."""
    shape = _local(placement.spec)
    # turning by +yaw about +Y takes +Z to +X: in (x, z) that is a turn by -yaw
    turned = affinity.rotate(shape, -math.degrees(placement.yaw_rad), origin=(0, 0))
    x, _, z = placement.position_m
    return affinity.translate(turned, x, z)


def _local(spec):  # noqa: PLR0912 - a case for each kind of object
    match spec:
        case StallSpec() if spec.slope:
            corners = ((-1, -1), (1, -1), (1, 1), (-1, 1))
            half_x, half_z = spec.width_m / 2, spec.depth_m / 2
            return shapely.Polygon([(x * half_x, z * half_z + spec.slope * x * half_x) for x, z in corners])
        case PanelSpec():
            panel = _centred(spec.width_m, spec.depth_m)
            return panel.difference(shapely.union_all([shapely.Polygon(opening) for opening in spec.openings]))
        case CeilingSpec() | ObstacleSpec() | CrossingSpec():
            return _centred(spec.width_m, spec.depth_m)
        case WallSpec() | PortalSpec():
            return shapely.box(-spec.length_m / 2, -spec.thickness_m, spec.length_m / 2, 0)
        case FlightSpec():
            return shapely.box(-spec.width_m / 2, -spec.profile[-1][0], spec.width_m / 2, 0.0)
        case CoilSpec():
            return _coil(spec)
        case RampSpec():
            half = spec.width_m / 2 + spec.wall_m
            return shapely.box(-half, -spec.profile[-1][0], half, -spec.profile[0][0])
        case BarrierSpec():
            return shapely.box(-0.2, -1.9, 0.2, 0.2)
        case WallPostSpec():
            return _centred(spec.side_m, spec.side_m)
        case ColumnSpec():
            return _centred(spec.size_m, spec.size_m)
        case LampSpec():
            return _centred(spec.length_m, spec.width_m)
        case BeamSpec():
            return _centred(spec.width_m, spec.length_m)
        case BeamNodeSpec():
            return shapely.union_all([shapely.box(*box) for box in spec.boxes])
        case DuctSpec() | CableTraySpec():
            return _centred(spec.width_m, spec.length_m)
        case SpeedBumpSpec():
            return _centred(spec.length_m, 0.35)
        case WheelStopSpec():
            return _centred(spec.length_m, 0.15) - _centred(spec.gap_m, 0.15)
        case CarSpec():
            body = next(body for body in CAR_BODIES if body.name == spec.body)
            return _centred(body.overall_width_m, body.length_m)
        case NumberPlateSpec():
            body = next(body for body in CAR_BODIES if body.name == spec.body)
            return _centred(0.52, body.length_m)
        case NumberSpec():
            return _centred((0.56 + 0.71 * (len(spec.digits) - 1)) * spec.height_m, spec.height_m)
        case NumberFrameSpec():
            return _centred(spec.width_m, spec.depth_m)
        case WallNumberSpec():
            return _centred((0.56 + 0.71 * (len(spec.digits) - 1)) * spec.height_m, 0.0)
        case ColumnPlatesSpec():
            return _centred(spec.column_size_m + 0.01, spec.column_size_m + 0.01)
        case ZonePlateSpec():
            return shapely.box(-spec.width_m / 2, 0, spec.width_m / 2, 0.01)
        case SprinklerSpec():
            return _centred(2 * spec.radius_m, spec.length_m)
        case ExitSignSpec():
            return _centred(0.8, 0.05)
        case LaneSignSpec():
            return _centred(spec.height_m, 0.03)
        case LevelSignSpec():
            return _centred(spec.width_m, 0.03)
        case FireShutterSpec():
            return shapely.box(-spec.width_m / 2 - 0.1, 0, spec.width_m / 2 + 0.1, spec.depth_m + 0.08)
        case LevelPlateSpec():
            return shapely.box(-0.23, 0, 0.23, 0.01)
        case MirrorSpec():
            return _centred(2 * spec.radius_m, 0.2)
        case ChargerSpec():
            return shapely.box(-0.23, -0.045, 0.23, 0.135)
        case HydrantCabinetSpec():
            return shapely.box(-0.325, 0, 0.325, 0.27)
        case FireExtinguisherSpec():
            return shapely.box(-0.2, 0, 0.2, 0.18)
        case ConeSpec():
            return _centred(0.38, 0.38)
        case StainSpec() | PuddleSpec():
            return _centred(spec.width_m, spec.depth_m)
        case DrainSpec():
            return _centred(spec.width_m, spec.length_m)
        case TyreMarkSpec():
            return _centred(1.8, 2 * spec.length_m)
        case NoParkingSignSpec():
            return _centred(0.6, 0.4)
    raise TypeError(spec)


def _coil(spec):
    """The band around a line from one corner's edge round three quarters of a circle to the other edge."""
    line = spec.line
    u0, v0, radius = line.last_u_m, line.first_v_m, line.radius_m
    turn = np.linspace(-np.pi / 2, np.pi, 55)
    circle = np.stack([u0 + radius + radius * np.cos(turn), v0 + radius + radius * np.sin(turn)], axis=1)
    corner_u, corner_v = line.corner
    places = [(corner_u, v0), *circle.tolist(), (u0, corner_v)]
    band = shapely.LineString([(spec.turn * v, u) for u, v in places])
    return band.buffer(line.width_m / 2 + spec.wall_m, cap_style="flat", join_style="mitre")


def _centred(width, depth):
    return shapely.box(-width / 2, -depth / 2, width / 2, depth / 2)
