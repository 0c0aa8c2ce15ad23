"""Fire hydrant cabinets on walls and columns, with valve, hose and nozzle behind glass."""

from dataclasses import dataclass

import numpy as np
import shapely
from shapely import affinity

from garage2usd.assets.countries import Country
from garage2usd.assets.faces import box_faces, level_lathe_faces, moved, ring_faces, tube_faces, upright_lathe_faces
from garage2usd.assets.flat import upright_triangles
from garage2usd.assets.glyphs import text_length, text_shape
from garage2usd.assets.mesh import Asset, Collider, Face, Part, make_part
from garage2usd.objects.kind import Kind, Mounted, Polygon, Spec, rectangle
from garage2usd.objects.signage import SIGNAGE

KIND = Kind("hydrant_cabinet", number=27, label="hydrant_cabinet", cityscapes="static", group="FireProtection")

_WIDTH_M, _HEIGHT_M, _DEPTH_M = 0.65, 0.80, 0.24
"""Width, height and depth of the smallest cabinet of GB/T 14561-2019."""
_FOOT_M = 0.88
"""Height of the hydrant cabinet's bottom, which puts its outlet at 1.10 m and its top below zone plates' letters."""
_OUTLET_M = 1.10
_SHEET_M, _DOOR_M, _FRAME_M = 0.012, 0.022, 0.055
_PANEL_M = 0.26
"""Height of the steel panel under the cabinet's glass."""
_TEXT_LENGTH_M = 0.46
_REEL_M = 0.20
_PIPE_M = 0.038
_PIPE_DROP_M, _BRACKET_M, _BRACKET_HALF_M = 0.16, 0.2, 0.02
"""Drop of the supply pipe below the cabinet, and the length of the brackets' legs and half their width."""


@dataclass(frozen=True)
class HydrantCabinetSpec(Spec, kind=KIND):
    """A fire hydrant cabinet on brackets; origin on the floor below the middle of its back, front to +Z.

    Attributes
    ----------
    country
        Country of the cabinet's words and fire number.
    """

    country: Country = Country.NONE

    def asset(self) -> Asset:
        """Make the meshes of a red hydrant cabinet: glass door, lettered panel, valve, hose and nozzle.

        The cabinet hangs on two brackets, and the supply pipe comes out of the wall below it.
        """
        x, low, high, front = _WIDTH_M / 2, _FOOT_M, _FOOT_M + _HEIGHT_M, _DEPTH_M - _DOOR_M
        inside = (-x + _SHEET_M, low + _SHEET_M, 0.0), (x - _SHEET_M, high - _SHEET_M, front)
        back = box_faces(inside[0], (inside[1][0], inside[1][1], _SHEET_M))
        at_pipe = (-x + 0.13, 0.0, 0.11)
        return Asset(
            (
                make_part("Sides", ring_faces(*inside, _SHEET_M), "pipe_red", collider=Collider.BOX),
                make_part("Back", back, "housing_white"),
                make_part("Pipe", _supply(at_pipe), "pipe_red", collider=Collider.CONVEX_HULL),
                make_part("Brackets", _brackets(), "steel_galvanised", collider=Collider.CONVEX_HULL),
                *_door(x, low, high, front, self.country),
                *_fittings(at_pipe),
            )
        )

    def outlines(self) -> tuple[Polygon, ...]:
        """Return the outline of the hydrant cabinet with its handle."""
        return (rectangle(-_WIDTH_M / 2, 0.0, _WIDTH_M / 2, _DEPTH_M + 0.03),)


MOUNTED = Mounted(
    HydrantCabinetSpec(),
    setting="hydrant_cabinets",
    clause="hydrant_reach",
    reach_m=27.1,
    count=2,
    spacing="hydrant_spacing",
    is_walked=False,
)


def _supply(at_pipe: tuple[float, float, float]) -> list[Face]:
    """Return the faces of the supply pipe, from a flange on the wall into the bottom of the cabinet."""
    x, _, z = at_pipe
    foot, bend = _FOOT_M - _PIPE_DROP_M, 0.04
    line = [(x, _FOOT_M, z), (x, foot + bend, z), (x, foot, z - bend), (x, foot, 0.0)]
    flange = level_lathe_faces([(0.0, 0.0), (0.0, 0.065), (0.014, 0.065), (0.014, 0.0)], segments=16)
    return [*tube_faces(line, _PIPE_M, segments=16), *moved(flange, (x, foot, 0.0))]


def _brackets() -> list[Face]:
    """Return the faces of the two angle brackets on the wall that the cabinet rests on."""
    faces: list[Face] = []
    for x in (0.01, 0.26):
        left, right = x - _BRACKET_HALF_M, x + _BRACKET_HALF_M
        faces += box_faces((left, _FOOT_M - 0.008, 0.0), (right, _FOOT_M, _BRACKET_M))
        # it overlaps the upper leg and is off the wall, because a common edge of both would belong to four faces
        faces += box_faces((left, _FOOT_M - _BRACKET_M, 0.0005), (right, _FOOT_M - 0.004, 0.008))
        web = [(0.008, -0.008), (_BRACKET_M, -0.008), (0.008, -_BRACKET_M)]
        for side in (-0.004, 0.004):
            face = np.array([(x + side, _FOOT_M + up, out) for out, up in web])
            faces.append(face if side < 0 else face[::-1])
        (z0, y0), (z1, y1) = web[1], web[2]
        edge = [(-0.004, y0, z0), (0.004, y0, z0), (0.004, y1, z1), (-0.004, y1, z1)]
        faces.append(np.array([(x + across, _FOOT_M + up, out) for across, up, out in edge]))
    return faces


def _door(x: float, low: float, high: float, back: float, country: Country) -> list[Part]:
    """Make the door of a hydrant cabinet: frame, glass, lettered panel, handle and two hinges."""
    frame = _FRAME_M
    opening = (-x + frame, low + frame, back), (x - frame, high - frame, _DEPTH_M)
    sill = low + frame + _PANEL_M
    panel = box_faces((opening[0][0], opening[0][1], back + 0.004), (opening[1][0], sill, _DEPTH_M - 0.003))
    glass = box_faces((opening[0][0], sill, back + 0.008), (opening[1][0], opening[1][1], back + 0.013))
    handle = box_faces((x - 0.036, low + 0.36, _DEPTH_M), (x - 0.020, low + 0.48, _DEPTH_M + 0.028))
    hinges: list[Face] = []
    for at in (low + 0.10, high - 0.16):
        hinges += box_faces((-x + 0.004, at, _DEPTH_M), (-x + 0.018, at + 0.06, _DEPTH_M + 0.008))
    middle = low + frame + _PANEL_M / 2
    signs = SIGNAGE[country]
    letters = shapely.union_all(
        [
            affinity.translate(
                text_shape(signs.hydrant, min(0.088, _TEXT_LENGTH_M / text_length(signs.hydrant))), 0.0, -0.048
            ),
            affinity.translate(text_shape(signs.fire_number, 0.075), 0.0, 0.062),
        ]
    )
    text = upright_triangles(letters, middle_m=middle, front_m=_DEPTH_M - 0.001)
    return [
        make_part("Door", ring_faces(*opening, frame), "pipe_red", collider=Collider.BOX),
        make_part("Panel", panel, "pipe_red"),
        make_part("Glass", glass, "cabinet_glass"),
        make_part("Handle", handle, "chrome"),
        make_part("Hinges", hinges, "steel_dark"),
        make_part("Letters", text, "sign_white"),
    ]


def _fittings(at_pipe: tuple[float, float, float]) -> list[Part]:
    """Make the inside of a hydrant cabinet: riser with valve and hand wheel, hose on its reel, and nozzle."""
    top = _OUTLET_M + 0.06
    riser = upright_lathe_faces([(_FOOT_M + _SHEET_M, _PIPE_M), (top, _PIPE_M)], segments=16)
    # the outlet looks to +Z, the wheel's stem to the top
    outlet = level_lathe_faces([(0.0, 0.0), (0.0, 0.032), (0.075, 0.032), (0.075, 0.0)], segments=16)
    outlet = moved(outlet, (0.0, _OUTLET_M, 0.02))
    wheel = upright_lathe_faces(
        [(top, 0.012), (top + 0.05, 0.012), (top + 0.051, 0.05), (top + 0.066, 0.05)], segments=16
    )
    reel_y, reel_z = _FOOT_M + _HEIGHT_M - 0.29, _SHEET_M + 0.03
    # turns of flat hose with grooves between them
    turns = [(depth, _REEL_M - at * 0.033) for at in range(6) for depth in (0.065, 0.058)]
    section = [(0.0, 0.0), (0.0, _REEL_M), *turns, (0.058, 0.0)]
    coils = moved(level_lathe_faces(section, segments=20), (0.08, reel_y, reel_z))
    hub = level_lathe_faces([(0.0, 0.0), (0.0, 0.03), (0.11, 0.03), (0.11, 0.0)], segments=12)
    hub = moved(hub, (0.08, reel_y, _SHEET_M))
    nozzle = upright_lathe_faces([(0.0, 0.026), (0.05, 0.026), (0.06, 0.019), (0.26, 0.011)], segments=14)
    nozzle = moved(nozzle, (0.24, _FOOT_M + _SHEET_M + 0.01, 0.14))
    return [
        make_part("Riser", moved(riser, at_pipe), "pipe_red"),
        make_part("Valve", moved(outlet, at_pipe), "brass"),
        make_part("Wheel", moved(wheel, at_pipe), "sign_ring"),
        make_part("Hose", coils, "hose"),
        make_part("Hub", hub, "steel_dark"),
        make_part("Nozzle", nozzle, "brass"),
    ]
