"""Pairs of portable fire extinguishers on brackets, below their sign."""

from dataclasses import dataclass
from itertools import pairwise

import numpy as np
import shapely

from garage2usd.assets.faces import box_faces, lathe_faces, level_lathe_faces, moved, tube_faces, upright_lathe_faces
from garage2usd.assets.flat import upright_triangles
from garage2usd.assets.mesh import Asset, Collider, Face, Part, make_part
from garage2usd.objects.kind import Kind, Mounted, Polygon, Spec, rectangle

KIND = Kind("fire_extinguisher", number=28, label="fire_extinguisher", cityscapes="static", group="FireProtection")

_SIDES_M = (-0.105, 0.105)
"""Offsets of the two fire extinguishers across the wall, in metres."""
_RADIUS_M, _FROM_WALL_M, _FOOT_M = 0.067, 0.090, 0.55
"""Radius of a 4 kg powder extinguisher, distance from the wall to its axis, and from the floor to its foot."""
_BODY_M = ((0.0, 0.052), (0.012, 0.064), (0.020, 0.067), (0.350, 0.067), (0.375, 0.062), (0.395, 0.048), (0.408, 0.026))
"""(height, radius) pairs along an extinguisher's body, from its foot to its shoulder."""
_NECK_M = ((0.406, 0.022), (0.440, 0.022), (0.442, 0.016), (0.455, 0.016))
_SIGN_M = (1.13, 1.33)
"""Lower and upper edge of the extinguisher sign, below the zone plates."""


@dataclass(frozen=True)
class FireExtinguisherSpec(Spec, kind=KIND):
    """Two fire extinguishers on a wall; origin on the floor in the middle of their back, labels to +Z."""

    def asset(self) -> Asset:
        """Make the meshes of two fire extinguishers with valves, hoses and labels, on a rail below an ISO 7010 sign."""
        pieces = [_extinguisher(side) for side in _SIDES_M]
        faces = {name: [face for piece in pieces for face in piece[name]] for name in pieces[0]}
        bodies = [
            make_part(f"Body{number}", piece["Body"], "pipe_red", collider=Collider.CONVEX_HULL)
            for number, piece in enumerate(pieces, start=1)
        ]
        rail = box_faces((-0.19, _FOOT_M + 0.20, 0.0), (0.19, _FOOT_M + 0.26, 0.012))
        return Asset(
            (
                *bodies,
                make_part("Valves", faces["Valve"], "brass", crease_deg=40),
                make_part("Levers", faces["Lever"], "steel_dark"),
                make_part("Gauges", faces["Gauge"], "zone_green", crease_deg=40),
                make_part("Hoses", faces["Hose"], "rubber_black", crease_deg=60),
                make_part("Straps", faces["Strap"], "rubber_black"),
                make_part("Labels", faces["Label"], "sign_white"),
                make_part("Prints", faces["Print"], "sign_blue"),
                make_part("Rail", rail, "steel_galvanised", collider=Collider.BOX),
                *_sign(),
            )
        )

    def outlines(self) -> tuple[Polygon, ...]:
        """Return the outline of both fire extinguishers with their hoses, up to the wall."""
        return (rectangle(-0.20, 0.0, 0.20, 0.18),)


MOUNTED = Mounted(FireExtinguisherSpec(), setting="fire_extinguishers", clause="extinguisher_distance", reach_m=20.0)


def _extinguisher(x_m: float) -> dict[str, list[Face]]:
    """Return the faces of one fire extinguisher in its place, by part."""
    top = _NECK_M[-1][0]
    squeeze = box_faces((-0.012, top + 0.012, -0.035), (0.012, top + 0.020, 0.075))
    carry = box_faces((-0.012, top - 0.012, -0.030), (0.012, top - 0.004, 0.070))
    gauge = level_lathe_faces([(0.0, 0.0), (0.0, 0.014), (0.012, 0.014), (0.012, 0.0)], segments=12)
    # from the valve's side down along the body, to where its nozzle is clipped
    bend = [(-0.016, 0.430), (-0.050, 0.437), (-0.078, 0.410), (-0.083, 0.340), (-0.083, 0.120)]
    hose = tube_faces([(across, up, 0.0) for across, up in bend], 0.0085, segments=6)
    hose += tube_faces([(-0.083, 0.121, 0.0), (-0.083, 0.050, 0.0)], 0.0125, segments=6)
    strap = lathe_faces(
        [
            (0.0, _RADIUS_M + 0.003),
            (0.022, _RADIUS_M + 0.003),
            (0.022, _RADIUS_M),
            (0.0, _RADIUS_M),
            (0.0, _RADIUS_M + 0.003),
        ],
        segments=18,
    )
    parts = {
        "Body": upright_lathe_faces(list(_BODY_M), segments=18),
        "Valve": upright_lathe_faces(list(_NECK_M), segments=10),
        "Lever": squeeze + carry + box_faces((-0.010, top - 0.004, -0.030), (0.010, top + 0.012, 0.005)),
        "Gauge": moved(gauge, (0.0, 0.424, 0.018)),
        "Hose": hose,
        "Strap": [face[:, [1, 0, 2]] * (-1.0, 1.0, 1.0) + np.array((0.0, 0.22, 0.0)) for face in strap],
        "Label": _wrapped(_RADIUS_M + 0.0008, (0.075, 0.195), 62.0),
        "Print": _wrapped(_RADIUS_M + 0.0016, (0.165, 0.185), 50.0)
        + _wrapped(_RADIUS_M + 0.0016, (0.095, 0.100), 50.0),
    }
    return {name: moved(faces, (x_m, _FOOT_M, _FROM_WALL_M)) for name, faces in parts.items()}


def _wrapped(radius_m: float, heights_m: tuple[float, float], half_deg: float) -> list[Face]:
    """Return the faces of a label around the front of a fire extinguisher."""
    low, high = heights_m
    angles = np.radians(np.linspace(-half_deg, half_deg, 7))
    rim = [(radius_m * np.sin(angle), radius_m * np.cos(angle)) for angle in angles.tolist()]
    return [
        np.array([(x0, low, z0), (x1, low, z1), (x1, high, z1), (x0, high, z0)]) for (x0, z0), (x1, z1) in pairwise(rim)
    ]


def _sign() -> list[Part]:
    """Make the fire extinguisher sign F001 of ISO 7010: an extinguisher and flames in white on red."""
    low, high = _SIGN_M
    half = (high - low) / 2
    plate = box_faces((-half, low, 0.006), (half, high, 0.009))
    drawn = shapely.union_all(
        [
            shapely.box(-0.052, -0.030, -0.008, 0.080),  # the body, its neck, its lever and its hose
            shapely.Point(-0.030, -0.030).buffer(0.022, quad_segs=3),
            shapely.box(-0.038, -0.068, -0.022, -0.040),
            shapely.LineString([(-0.056, -0.068), (-0.004, -0.078)]).buffer(0.006, cap_style="flat"),
            shapely.LineString([(-0.022, -0.060), (0.010, -0.050), (0.014, 0.000)]).buffer(0.006, cap_style="flat"),
            shapely.Polygon(
                [
                    (0.030, 0.080),
                    (0.022, 0.040),
                    (0.034, 0.050),
                    (0.040, -0.010),
                    (0.056, 0.030),
                    (0.068, 0.014),
                    (0.072, 0.080),
                ]
            ),
        ],
        grid_size=1e-5,
    )
    symbol = upright_triangles(drawn, middle_m=(low + high) / 2, front_m=0.0105)
    return [
        make_part("Sign", plate, "sign_ring"),
        make_part("Symbol", symbol, "sign_white"),
    ]
