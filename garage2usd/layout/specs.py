"""Shapes by their measures: what a placement places, without its mesh. Equal specs are one prototype."""

from dataclasses import dataclass
from enum import StrEnum
from functools import cached_property

__all__ = [
    "GLYPH_PITCH",
    "BarrierSpec",
    "BeamNodeSpec",
    "BeamSpec",
    "Box",
    "CableTraySpec",
    "CarSpec",
    "CeilingSpec",
    "ChargerSpec",
    "ColumnSpec",
    "ConeSpec",
    "DuctSpec",
    "ExitSignSpec",
    "Marking",
    "MirrorSpec",
    "NoParkingSignSpec",
    "NumberSpec",
    "ObstacleSpec",
    "PanelSpec",
    "Point",
    "Polygon",
    "PortalSpec",
    "RampSpec",
    "SkySpec",
    "Spec",
    "SpeedBumpSpec",
    "SprinklerSpec",
    "StainMark",
    "StainSpec",
    "Surface",
    "TubeLightSpec",
    "Turn",
    "TyreMarkSpec",
    "WallPostSpec",
    "WallSpec",
    "WheelStopSpec",
    "ZonePlateSpec",
    "rectangle",
]

Point = tuple[float, float]
Polygon = tuple[Point, ...]
"""Corners (x, z) in metres from the panel's centre, without holes."""
Box = tuple[float, float, float, float]
"""An axis-aligned rectangle: left, top, right, bottom, in x and z."""


class Surface(StrEnum):
    """What a floor panel is coated with."""

    LANE = "lane"
    STALL = "stall"
    STALL_EV = "stall_ev"
    STALL_ACCESSIBLE = "stall_accessible"
    PAINT_WHITE = "paint_white"
    PAINT_YELLOW = "paint_yellow"


@dataclass(frozen=True)
class Marking:
    """A painted polygon on a floor panel."""

    polygon: Polygon
    surface: Surface


@dataclass(frozen=True)
class PanelSpec:
    """A flat piece of floor with its markings; origin in its middle.

    Attributes
    ----------
    width_m, depth_m
        Extent along X and Z.
    surface
        Coating where nothing is marked.
    markings
        Painted polygons that do not overlap.
    openings
        Polygons where other panels lie, free of this one.
    """

    width_m: float
    depth_m: float
    surface: Surface
    markings: tuple[Marking, ...] = ()
    openings: tuple[Polygon, ...] = ()

    def __hash__(self) -> int:
        """As of any frozen value, but kept: the polygons are many and every object is looked up by its spec."""
        return self._hash

    @cached_property
    def _hash(self) -> int:
        return hash((self.width_m, self.depth_m, self.surface, self.markings, self.openings))


@dataclass(frozen=True)
class CeilingSpec:
    """A ceiling slab; origin in the middle of its underside."""

    width_m: float
    depth_m: float
    thickness_m: float


@dataclass(frozen=True)
class WallSpec:
    """A straight wall; origin at the middle of its inner face's foot, which looks to +Z."""

    length_m: float
    height_m: float
    thickness_m: float


@dataclass(frozen=True)
class WallPostSpec:
    """The square piece that closes a convex corner of two walls; origin in the middle of its foot."""

    side_m: float
    height_m: float


@dataclass(frozen=True)
class PortalSpec:
    """A wall with a vehicle door; origin and direction as `WallSpec`."""

    length_m: float
    height_m: float
    thickness_m: float
    door_width_m: float
    door_height_m: float
    is_entrance: bool
    is_open: bool = False
    """Whether its roller door is up, because a ramp lies behind it."""


@dataclass(frozen=True)
class RampSpec:
    """A straight ramp up to the ground outside; origin and direction as `PortalSpec`, rising towards -Z.

    Attributes
    ----------
    width_m
        Between its side walls.
    wall_m
        Thickness of the side walls.
    threshold_width_m
        Of the floor in the door's opening.
    profile
        (run, height) along the floor, from the back of the door's wall to the far end.
    cover_end_m, cover_height_m
        Run where the slab over its foot ends, and height of that slab's underside.
    wall_top_m
        Height of the side walls.
    """

    width_m: float
    wall_m: float
    threshold_width_m: float
    profile: tuple[Point, ...]
    cover_end_m: float
    cover_height_m: float
    wall_top_m: float


@dataclass(frozen=True)
class SkySpec:
    """Daylight over a ramp's open end, on its side walls from `low_m` to `high_m`; origin as `RampSpec`."""

    width_m: float
    start_m: float
    end_m: float
    ground_m: float
    low_m: float
    high_m: float


@dataclass(frozen=True)
class BarrierSpec:
    """A boom barrier whose arm reaches to -X, for traffic to +Z; origin in the middle of its housing's foot."""

    arm_m: float
    is_raised: bool
    elbow_m: float


@dataclass(frozen=True)
class ObstacleSpec:
    """A concrete core; origin in the middle of its foot, its door in the middle of the side that looks to +Z."""

    width_m: float
    depth_m: float
    height_m: float
    has_door: bool = True


@dataclass(frozen=True)
class ColumnSpec:
    """A square column; origin in the middle of its foot."""

    size_m: float
    height_m: float


@dataclass(frozen=True)
class TubeLightSpec:
    """A tube light with its housing, long along X; origin in the middle of its top.

    Attributes
    ----------
    drop_m
        From its top down to its lit face.
    luminance_nit
        Of that face, which looks down, cd/m2.
    """

    length_m: float
    width_m: float
    drop_m: float = 0.115
    luminance_nit: float = 0.0


@dataclass(frozen=True)
class BeamSpec:
    """A beam under the ceiling, long along Z; origin in the middle of its top."""

    length_m: float
    width_m: float
    depth_m: float


@dataclass(frozen=True)
class BeamNodeSpec:
    """Where beams meet without a column: rectangles that touch, `depth_m` deep; origin on the ceiling."""

    boxes: tuple[Box, ...]
    depth_m: float


@dataclass(frozen=True)
class DuctSpec:
    """A rectangular duct on hangers, long along Z; origin in the middle of its top.

    Attributes
    ----------
    hanger_m
        Length of the hangers from its top to the ceiling.
    hangers_at_m
        Places of the hangers along it, from its middle.
    """

    length_m: float
    width_m: float
    height_m: float
    hanger_m: float
    hangers_at_m: tuple[float, ...]


@dataclass(frozen=True)
class CableTraySpec:
    """A cable ladder with its cables, long along Z; origin over its middle, on the ceiling.

    Attributes
    ----------
    height_m
        Of its rails.
    drop_m
        From the ceiling down to its bottom.
    rods_at_m
        Places of its pairs of rods along it, from its middle.
    """

    length_m: float
    width_m: float
    height_m: float
    drop_m: float
    rods_at_m: tuple[float, ...]


@dataclass(frozen=True)
class SpeedBumpSpec:
    """A rubber speed bump, long along X; origin in the middle of its foot."""

    length_m: float


@dataclass(frozen=True)
class WheelStopSpec:
    """A wheel stop, long along X; origin in the middle of its foot."""

    length_m: float


@dataclass(frozen=True)
class NoParkingSignSpec:
    """A free-standing no-parking sign that looks to +Z; origin in the middle of its foot."""


@dataclass(frozen=True)
class ConeSpec:
    """A traffic cone; origin in the middle of its foot."""


GLYPH_PITCH = 0.71
"""From one character's middle to the next one's, as a share of their height."""


@dataclass(frozen=True)
class NumberSpec:
    """Digits painted on the floor, their tops to -Z; origin in their middle on the floor."""

    digits: str
    height_m: float


@dataclass(frozen=True)
class ZonePlateSpec:
    """A plate with a letter or a number on each side of a square column; origin in its middle, at its lower edge."""

    text: str
    column_size_m: float
    height_m: float


@dataclass(frozen=True)
class ChargerSpec:
    """A slim charging post that looks to +Z; origin in the middle of its foot."""


class Turn(StrEnum):
    """Where a sign's arrow sends who reads it."""

    LEFT = "left"
    AHEAD = "ahead"
    RIGHT = "right"


@dataclass(frozen=True)
class SprinklerSpec:
    """A sprinkler pipe, long along Z; origin over its middle, on the ceiling.

    Attributes
    ----------
    drop_m
        From the ceiling down to the pipe's middle.
    rods_at_m, heads_at_m
        Places of its rods and of its heads along it, from its middle.
    """

    length_m: float
    radius_m: float
    drop_m: float
    rods_at_m: tuple[float, ...]
    heads_at_m: tuple[float, ...]


@dataclass(frozen=True)
class ExitSignSpec:
    """A lit exit sign that looks to +Z; origin on the ceiling over its middle, its top `top_m` below that."""

    turn: Turn
    top_m: float
    height_m: float


@dataclass(frozen=True)
class MirrorSpec:
    """A convex traffic mirror that looks to +Z; origin in the middle of its rim, which an arm holds from behind."""

    radius_m: float
    arm_m: float


class StainMark(StrEnum):
    """What stains a floor."""

    WEAR_STRAIGHT = "wear_straight"
    """Wheels that rolled from -Z to +Z; a bend joins +Z and +X, a T-junction lets +Z into the lane along X."""
    WEAR_BEND = "wear_bend"
    WEAR_T = "wear_t"
    WEAR_CROSS = "wear_cross"
    OIL = "oil"
    DRIPS = "drips"
    DAMP = "damp"
    CRACK = "crack"
    PATCH = "patch"


@dataclass(frozen=True)
class StainSpec:
    """A stain on a rectangle of the floor; origin in its middle."""

    mark: StainMark
    variant: int
    width_m: float
    depth_m: float


@dataclass(frozen=True)
class TyreMarkSpec:
    """The marks of a car's wheels; origin in the middle of their end, where the car moved to -Z.

    Attributes
    ----------
    length_m
        Of the way between them.
    turn_rad
        By how much the car turned on it; positive where it came from +X.
    """

    variant: int
    length_m: float
    turn_rad: float = 0.0


@dataclass(frozen=True)
class CarSpec:
    """A parked car; origin in the middle of its footprint, nose to -Z."""

    body: str
    paint: str


Spec = (
    PanelSpec
    | CeilingSpec
    | WallSpec
    | WallPostSpec
    | PortalSpec
    | RampSpec
    | SkySpec
    | BarrierSpec
    | ObstacleSpec
    | ColumnSpec
    | TubeLightSpec
    | BeamSpec
    | BeamNodeSpec
    | DuctSpec
    | CableTraySpec
    | SpeedBumpSpec
    | WheelStopSpec
    | NoParkingSignSpec
    | ConeSpec
    | CarSpec
    | NumberSpec
    | ZonePlateSpec
    | ChargerSpec
    | SprinklerSpec
    | ExitSignSpec
    | MirrorSpec
    | StainSpec
    | TyreMarkSpec
)


def rectangle(left: float, top: float, right: float, bottom: float) -> Polygon:
    """The corners of an axis-aligned rectangle, x from left to right and z from top to bottom."""
    return (left, top), (left, bottom), (right, bottom), (right, top)
