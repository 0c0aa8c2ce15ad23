"""Settings of how a garage looks: its floor, markings, columns, walls, ceiling, lights and signs.

Each axis is given, or drawn by the seed, or stays what it usually is. None of them moves a stall, a column or a car.
"""
# Over 300 lines: every axis of a look, with its values, is told in one place.

import re
from enum import StrEnum
from typing import Annotated

from pydantic import AfterValidator, Field, ValidationInfo, field_validator

from garage2usd.common.settings import Settings
from garage2usd.config.texture_sets import TextureFolder, read_texture_sets

__all__ = [
    "AISLE",
    "NATURAL",
    "NO_DADO",
    "BandForm",
    "CeilingFinish",
    "CeilingLook",
    "ColumnSection",
    "ColumnsLook",
    "Daylight",
    "Dirt",
    "Drains",
    "FloorFinish",
    "FloorLook",
    "Gloss",
    "Guard",
    "LampKind",
    "LightsLook",
    "LookConfig",
    "MarkingsLook",
    "NumberForm",
    "NumberPlace",
    "NumbersLook",
    "Pictogram",
    "SignsLook",
    "SignsOf",
    "StallPattern",
    "WallFinish",
    "WallsLook",
    "Wear",
]

NATURAL = "natural"
"""The colour that a material has by itself."""
NO_DADO = "none"
"""Instead of its colour: there is none."""
AISLE = "aisle"
"""The floor of stalls that have that of the aisle."""
_HEX = re.compile(r"#[0-9a-f]{6}")
_COLOURS = {
    "white": "#dedede",
    "light grey": "#b4b4b2",
    "grey": "#8c8c8a",
    "dark grey": "#4a4b4d",
    "black": "#1c1c1e",
    "yellow": "#dda72a",
    "orange": "#d87822",
    "red": "#a83226",
    "green": "#2f7d54",
    "blue": "#2b5fa8",
    "beige": "#c9b896",
}


def _colour(value: str) -> str:
    """A colour as ``#rrggbb``."""
    colour = _COLOURS.get(value.lower(), value.lower())
    if not _HEX.fullmatch(colour):
        raise ValueError(f"#rrggbb in sRGB, or one of {', '.join(_COLOURS)}")
    return colour


def _colour_or(*words: str) -> AfterValidator:
    return AfterValidator(lambda value: value if value in words else _colour(value))


Colour = Annotated[str, AfterValidator(_colour)]
NaturalColour = Annotated[str, _colour_or(NATURAL)]
"""A colour, or the one that the material has by itself."""


class FloorFinish(StrEnum):
    """What the floor is made of."""

    CONCRETE = "concrete"
    """Concrete with dust in its pores."""
    TROWELLED = "trowelled"
    """Concrete that a power trowel closed, with its swirls."""
    SAWN = "sawn"
    """The same, with sawn joints."""
    CRACKED = "cracked"
    """Concrete with hairline cracks and patches."""
    EPOXY = "epoxy"
    """A smooth coating, of any colour."""
    ASPHALT = "asphalt"
    PATCHED = "patched"
    """Asphalt with patches."""
    PAVERS = "pavers"
    """Interlocking blocks of 0.1 x 0.2 m."""


class Gloss(StrEnum):
    """How much a floor mirrors."""

    MATT = "matt"
    SATIN = "satin"
    POLISHED = "polished"
    MIRROR = "mirror"
    """Lamps stand in it as long streaks."""


class Dirt(StrEnum):
    """How dark wheels have made the lanes."""

    SWEPT = "swept"
    """Not at all: as just cleaned."""
    FAINT = "faint"
    USUAL = "usual"
    FILTHY = "filthy"
    """Black along the tracks, grey between them."""


class Drains(StrEnum):
    """What takes water off the lanes."""

    NONE = "none"
    GRATINGS = "gratings"
    """Gullies of 0.3 m, one in three squares along a lane."""
    CHANNELS = "channels"
    """Channels 0.15 m wide along straight lanes, and across portals at their doors."""


class FloorLook(Settings):
    """The floor."""

    finish: FloorFinish = FloorFinish.CONCRETE
    """'concrete', 'trowelled', 'sawn', 'cracked', 'epoxy', 'asphalt', 'patched' or 'pavers'."""
    colour: NaturalColour = NATURAL
    """Mean colour of the aisles' floor: #rrggbb in sRGB, a name such as 'green', or 'natural'."""
    gloss: Gloss = Gloss.SATIN
    """'matt', 'satin', 'polished' or 'mirror'."""
    bays: Annotated[str, _colour_or("coated", AISLE)] = "coated"
    """Floor of the stalls: 'coated' with blue-grey epoxy, as the 'aisle' is, or a colour that fills them."""
    dirt: Dirt = Dirt.USUAL
    """'swept', 'faint', 'usual' or 'filthy': how dark wheels have made the lanes."""
    wet: float = Field(0.0, ge=0, le=1)
    """Share of the lane squares without a speed bump that have a puddle; those with drains and before ramps first."""
    drains: Drains = Drains.NONE
    """'none', 'gratings' or 'channels'."""


class StallPattern(StrEnum):
    """Which lines bound a stall."""

    SIDES = "sides"
    """Both sides and the rear."""
    CLOSED = "closed"
    """The entry as well."""
    T_MARKS = "t_marks"
    """A T where two stalls meet at the aisle, and one at their rear."""
    L_MARKS = "l_marks"
    """An angle in each of the four corners."""
    DOUBLE = "double"
    """Two parallel lines between neighbours, joined at the aisle."""
    CORNERS = "corners"
    """An angle in each corner at the aisle only."""
    DASHED = "dashed"
    """As 'closed', by dashes."""
    NONE = "none"
    """No lines: numbers at most."""


class BandForm(StrEnum):
    """What runs along the aisle before the stalls' entries."""

    NONE = "none"
    LINE = "line"
    """A second line."""
    BAND = "band"
    """A coloured band between two lines, as walkways and guide strips are."""


class Pictogram(StrEnum):
    """What is painted on coloured bands, every other square."""

    WALKER = "walker"
    CAR = "car"
    LIFT = "lift"
    NONE = "none"


class Wear(StrEnum):
    """How much of the paint traffic has taken."""

    LIGHT = "light"
    """As usual: spots."""
    FRESH = "fresh"
    WORN = "worn"
    FADED = "faded"
    """Nearly gone."""


class MarkingsLook(Settings):
    """Lines on the floor."""

    pattern: StallPattern = StallPattern.SIDES
    """'sides', 'closed', 't_marks', 'l_marks', 'double', 'corners', 'dashed' or 'none'."""
    colour: Colour = "white"
    """Of the stalls' lines."""
    line_width_m: float = Field(0.12, ge=0.05, le=0.3)
    """Of the stalls' lines."""
    wear: Wear = Wear.LIGHT
    """'fresh', 'light', 'worn' or 'faded'."""
    band: BandForm = BandForm.NONE
    """Along the aisle, before entries: 'none', a 'line' or a coloured 'band' between lines."""
    band_gap_m: float = Field(0.3, ge=0.1, le=0.6)
    """From the stalls' entries to it."""
    band_width_m: float = Field(0.6, ge=0.3, le=1.2)
    """Of a coloured band."""
    band_colour: Colour = "green"
    """Of a coloured band."""
    band_both_sides: bool = True
    """Whether a coloured band runs on both sides of aisles; else one side has it and the other a line."""
    pictogram: Pictogram = Pictogram.WALKER
    """On a coloured band: 'walker', 'car', 'lift' or 'none', with chevrons between them."""
    hatching: bool = False
    """Whether the floor between rows of stalls, beside columns and at the ends of rows, is hatched."""
    lane_colour: Colour = "yellow"
    """Of the lines along the edges of lanes."""
    arrow_colour: Colour = "white"
    """Of arrows, dashes and crossings."""
    ghosts: float = Field(0.0, ge=0, le=1)
    """Share of the squares with stalls before which older lines, at other places, still show."""
    zebra: float = Field(0.0, ge=0, le=1)
    """Share of the straight lane squares with a crossing that leads to no door."""


class NumberPlace(StrEnum):
    """Where a stall's number stands."""

    MOUTH = "mouth"
    """On the stall, at its entry."""
    MIDDLE = "middle"
    REAR = "rear"
    LANE = "lane"
    """Before the stall, on the lane, where what runs along the aisle leaves room; else at its entry."""
    WALL = "wall"
    """On the wall behind it, where there is one; else at its entry."""
    NONE = "none"


class NumberForm(StrEnum):
    """How much of a number is painted."""

    SHORT = "short"
    """Without its zone: 07."""
    FULL = "full"
    """With it: A1-07."""
    BOXED = "boxed"
    """Short, in a frame."""


class NumbersLook(Settings):
    """The numbers of stalls."""

    place: NumberPlace = NumberPlace.MOUTH
    """'mouth', 'middle', 'rear', 'lane', 'wall' or 'none'."""
    form: NumberForm = NumberForm.SHORT
    """'short', 'full' or 'boxed'."""
    height_m: float = Field(0.45, ge=0.12, le=1.0)
    """Of the characters; they are lower where the number would be wider than its stall."""
    colour: Colour = "white"
    """Of the characters."""


class ColumnSection(StrEnum):
    """Shape of a column's section, within the square that the bay gives it."""

    SQUARE = "square"
    ROUND = "round"
    RECTANGULAR = "rectangular"


class Guard(StrEnum):
    """What protects the foot of a column."""

    YELLOW_BLACK = "yellow_black"
    RED_WHITE = "red_white"
    BLUE_YELLOW = "blue_yellow"
    RUBBER = "rubber"
    """Black and yellow rubber on the corners."""
    NONE = "none"


class ColumnsLook(Settings):
    """Columns."""

    section: ColumnSection = ColumnSection.SQUARE
    """'square', 'round' or 'rectangular', within the square that `bay.column_size_m` gives them."""
    colour: NaturalColour = NATURAL
    """Of the shaft: a colour, or 'natural' for bare concrete."""
    guard: Guard = Guard.YELLOW_BLACK
    """'yellow_black', 'red_white', 'blue_yellow', 'rubber' corners or 'none'."""
    guard_height_m: float = Field(1.2, ge=0.3, le=2.0)
    """How high it reaches."""


class WallFinish(StrEnum):
    """What walls are made of."""

    RAW = "raw"
    """Concrete as the formwork left it."""
    PAINTED = "painted"
    BLOCKWORK = "blockwork"
    PANELS = "panels"


class WallsLook(Settings):
    """Walls."""

    finish: WallFinish = WallFinish.RAW
    """'raw' concrete, 'painted', 'blockwork' or 'panels'."""
    colour: NaturalColour = NATURAL
    """Of the wall: a colour, or 'natural'."""
    dado: Annotated[str, _colour_or(NATURAL, NO_DADO)] = NATURAL
    """The painted band at its foot: 'natural' for blue-green under a yellow stripe, a colour, or 'none'."""
    dado_height_m: float = Field(1.1, ge=0.3, le=1.8)
    """How high it reaches."""

    @property
    def dado_m(self) -> float:
        """How high it reaches, 0 without any."""
        return 0.0 if self.dado == NO_DADO else self.dado_height_m

    @property
    def has_stripe(self) -> bool:
        """Whether there is a stripe over it: over the usual one alone."""
        return self.dado == NATURAL


class CeilingFinish(StrEnum):
    """What the ceiling's underside is."""

    RAW = "raw"
    WHITE = "white"
    BLACK = "black"
    BOARDS = "boards"
    """Insulation boards of mineral wool."""


class CeilingLook(Settings):
    """The ceiling and what hangs below it."""

    finish: CeilingFinish = CeilingFinish.RAW
    """'raw' concrete, 'white', 'black' or insulation 'boards'."""
    services: NaturalColour = NATURAL
    """Colour of ducts, trays and pipes, or 'natural' for galvanised steel and red pipes."""
    round_ducts: bool = False
    """Whether ducts are round."""


class LampKind(StrEnum):
    """What the lamps are."""

    TUBES = "tubes"
    PANELS = "panels"
    ROUND = "round"


class Daylight(StrEnum):
    """What comes in at the doors."""

    OVERCAST = "overcast"
    SUN = "sun"
    DUSK = "dusk"
    NIGHT = "night"


class LightsLook(Settings):
    """Lights."""

    lamps: LampKind = LampKind.TUBES
    """'tubes', square 'panels' or 'round' ones."""
    temperature_k: float = Field(5200.0, ge=2200, le=9000)
    """Colour temperature."""
    spread_k: float = Field(0.0, ge=0, le=2000)
    """Standard deviation of it from lamp to lamp."""
    dead_share: float = Field(0.0, ge=0, le=0.9)
    """Share of the lamps that are dead."""
    emergency_only: bool = False
    """Whether only one lamp in eight burns, as when the mains have failed."""
    daylight: Daylight = Daylight.OVERCAST
    """At the doors: 'overcast', 'sun', 'dusk' or 'night'."""


class SignsOf(StrEnum):
    """Whose words, colours and numbers signs have."""

    INTERNATIONAL = "international"
    """EXIT, and 119 for the fire brigade."""
    PROFILE = "profile"
    """Those of the country of the profile."""


class SignsLook(Settings):
    """Signs and plates."""

    of: SignsOf = SignsOf.INTERNATIONAL
    """'international', or those of the country of the 'profile'."""


class LookConfig(Settings):
    """How the garage looks."""

    floor: FloorLook = FloorLook()
    """The floor."""
    markings: MarkingsLook = MarkingsLook()
    """Lines on it."""
    numbers: NumbersLook = NumbersLook()
    """The numbers of stalls."""
    columns: ColumnsLook = ColumnsLook()
    """Columns."""
    walls: WallsLook = WallsLook()
    """Walls."""
    ceiling: CeilingLook = CeilingLook()
    """The ceiling and what hangs below it."""
    lights: LightsLook = LightsLook()
    """Lights."""
    signs: SignsLook = SignsLook()
    """Signs and plates."""
    drawn: bool | tuple[str, ...] = False
    """What the seed draws: true for each axis that is not given, or a list of axes ('floor.gloss') and of groups
    ('markings', for all in it that are not given)."""

    textures: TextureFolder | None = None
    """Textures of one's own by role: a folder (see the page of looks), in place of those that the axes ask for."""

    @field_validator("textures", mode="before")
    @classmethod
    def _folder(cls, textures: object) -> object:
        return {"folder": textures} if isinstance(textures, str) else textures

    @field_validator("textures")
    @classmethod
    def _read(cls, textures: TextureFolder | None) -> TextureFolder | None:
        """The folder with the digest of what it holds; one that has a digest is read when it is used."""
        return read_texture_sets(textures)[0] if textures is not None and not textures.sha256 else textures

    @field_validator("drawn")
    @classmethod
    def _axes(cls, drawn: "bool | tuple[str, ...]", info: ValidationInfo) -> tuple[str, ...]:
        """Every axis that is drawn by its full name, so that a configuration says so by itself."""
        sections = {name: section for name, section in info.data.items() if isinstance(section, Settings)}
        left = {
            name: [key for key in type(section).model_fields if key not in section.model_fields_set]
            for name, section in sections.items()
        }
        if isinstance(drawn, bool):
            drawn = tuple(left) if drawn else ()
        axes: set[str] = set()
        for asked in drawn:
            name, _, key = asked.partition(".")
            keys = list(type(sections[name]).model_fields) if name in sections else []
            if (key not in keys) if key else (name not in left):
                known = ", ".join(left)
                raise ValueError(f"true, false, or a list of groups ({known}) and of their axes, such as floor.gloss")
            axes.update(f"{name}.{each}" for each in ([key] if key else left[name]))
        return tuple(sorted(axes))

    @property
    def axes(self) -> tuple[str, ...]:
        """The axes that are drawn, by their full names in order."""
        return self.drawn if isinstance(self.drawn, tuple) else ()
