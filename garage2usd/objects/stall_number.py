"""Stall numbers painted on stalls, lanes and walls."""

from dataclasses import dataclass

import shapely

from garage2usd.assets.flat import flat_part, upright_triangles
from garage2usd.assets.lettering import number_shape
from garage2usd.assets.mesh import Asset, make_part
from garage2usd.config.font_file import FontFile
from garage2usd.objects.kind import Kind, Spec

KIND = Kind(
    "stall_number", number=20, label="stall_number", cityscapes="parking", is_solid=False, scattered="StallNumbers"
)

PAINT_LIFT_M = 0.003
_FRAME_LINE_M = 0.05


@dataclass(frozen=True)
class NumberSpec(Spec, kind=KIND):
    """A stall number painted on the floor, its top to -Z; origin in its middle on the floor."""

    digits: str
    height_m: float

    @property
    def font(self) -> FontFile | None:
        """The user's font, if any."""
        return None

    def asset(self) -> Asset:
        """Make the mesh of a painted stall number a few millimetres over the floor."""
        shape = number_shape(self.digits, self.height_m, self.font)
        return Asset((flat_part("Paint", shape, "paint_number", height_m=PAINT_LIFT_M, collider=None),))


@dataclass(frozen=True)
class FontNumberSpec(NumberSpec, kind=KIND):
    """A stall number painted on the floor in the user's font."""

    own_font: FontFile

    @property
    def font(self) -> FontFile:
        """The user's font."""
        return self.own_font


@dataclass(frozen=True)
class NumberFrameSpec(Spec, kind=KIND):
    """A painted frame around a stall number; origin in its middle on the floor."""

    width_m: float
    depth_m: float

    def asset(self) -> Asset:
        """Make the mesh of a stall number's frame a few millimetres over the floor."""
        x, z = self.width_m / 2, self.depth_m / 2
        inside = shapely.box(_FRAME_LINE_M - x, _FRAME_LINE_M - z, x - _FRAME_LINE_M, z - _FRAME_LINE_M)
        shape = shapely.difference(shapely.box(-x, -z, x, z), inside)
        return Asset((flat_part("Paint", shape, "paint_number", height_m=PAINT_LIFT_M, collider=None),))


@dataclass(frozen=True)
class WallNumberSpec(Spec, kind=KIND):
    """A stall number painted on a wall, facing +Z; origin in its middle on the wall."""

    digits: str
    height_m: float

    @property
    def font(self) -> FontFile | None:
        """The user's font, if any."""
        return None

    def asset(self) -> Asset:
        """Make the mesh of an upright stall number on a wall."""
        shape = number_shape(self.digits, self.height_m, self.font)
        faces = list(upright_triangles(shape, middle_m=0.0, front_m=0.0))
        return Asset((make_part("Paint", faces, "paint_number", collider=None),))


@dataclass(frozen=True)
class WallFontNumberSpec(WallNumberSpec, kind=KIND):
    """A stall number painted on a wall in the user's font."""

    own_font: FontFile

    @property
    def font(self) -> FontFile:
        """The user's font."""
        return self.own_font
