"""Independent footprints of placements, by shapely's own affine transforms."""

import math

import shapely
from shapely import affinity

from garage2usd.config.vehicles import CAR_BODIES
from garage2usd.layout import specs as s


def footprint(placement):
    """The (x, z) polygon that an object covers."""
    shape = _local(placement.spec)
    # turning by +yaw about +Y takes +Z to +X: in (x, z) that is a turn by -yaw
    turned = affinity.rotate(shape, -math.degrees(placement.yaw_rad), origin=(0, 0))
    x, _, z = placement.position_m
    return affinity.translate(turned, x, z)


def _local(spec):  # noqa: PLR0912 - a case for each kind of object
    match spec:
        case s.PanelSpec():
            panel = _centred(spec.width_m, spec.depth_m)
            return panel.difference(shapely.union_all([shapely.Polygon(opening) for opening in spec.openings]))
        case s.CeilingSpec() | s.ObstacleSpec():
            return _centred(spec.width_m, spec.depth_m)
        case s.WallSpec() | s.PortalSpec():
            return shapely.box(-spec.length_m / 2, -spec.thickness_m, spec.length_m / 2, 0)
        case s.RampSpec():
            half = spec.width_m / 2 + spec.wall_m
            return shapely.box(-half, -spec.profile[-1][0], half, -spec.profile[0][0])
        case s.BarrierSpec():
            return shapely.box(-0.2, -1.9, 0.2, 0.2)
        case s.WallPostSpec():
            return _centred(spec.side_m, spec.side_m)
        case s.ColumnSpec():
            return _centred(spec.size_m, spec.size_m)
        case s.TubeLightSpec():
            return _centred(spec.length_m, spec.width_m)
        case s.BeamSpec():
            return _centred(spec.width_m, spec.length_m)
        case s.BeamNodeSpec():
            return shapely.union_all([shapely.box(*box) for box in spec.boxes])
        case s.DuctSpec() | s.CableTraySpec():
            return _centred(spec.width_m, spec.length_m)
        case s.SpeedBumpSpec():
            return _centred(spec.length_m, 0.35)
        case s.WheelStopSpec():
            return _centred(spec.length_m, 0.15)
        case s.CarSpec():
            body = next(body for body in CAR_BODIES if body.name == spec.body)
            return _centred(body.overall_width_m, body.length_m)
        case s.NumberSpec():
            return _centred((0.56 + 0.71 * (len(spec.digits) - 1)) * spec.height_m, spec.height_m)
        case s.ZonePlateSpec():
            return _centred(spec.column_size_m + 0.01, spec.column_size_m + 0.01)
        case s.SprinklerSpec():
            return _centred(2 * spec.radius_m, spec.length_m)
        case s.ExitSignSpec():
            return _centred(0.8, 0.05)
        case s.MirrorSpec():
            return _centred(2 * spec.radius_m, 0.2)
        case s.ChargerSpec():
            return _centred(0.32, 0.1)
        case s.ConeSpec():
            return _centred(0.38, 0.38)
        case s.StainSpec():
            return _centred(spec.width_m, spec.depth_m)
        case s.TyreMarkSpec():
            return _centred(1.8, 2 * spec.length_m)
        case s.NoParkingSignSpec():
            return _centred(0.5, 0.5)
    raise TypeError(spec)


def _centred(width, depth):
    return shapely.box(-width / 2, -depth / 2, width / 2, depth / 2)
