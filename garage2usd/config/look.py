"""Settings of a garage's look: floor, markings, numbers, columns, walls, ceiling, lights and signs.

Each axis is given, drawn by the seed, or left at its default. None of them moves a stall, a column or a car.
"""
# Over 300 lines: a model for each axis of a look, and their text.

import json
import re
from enum import StrEnum
from typing import Annotated, Any

from pydantic import AfterValidator, Field, ValidationInfo, field_validator

from garage2usd.common.settings import Settings
from garage2usd.config.font_file import FontFile, read_font
from garage2usd.config.texture_sets import TextureFolder, read_texture_sets

NATURAL = "natural"
"""The material's natural colour."""
NO_DADO = "none"
"""No dado, in place of a colour."""
AISLE = "aisle"
"""The stalls' floor has the finish of the aisle."""
_HEX = re.compile(r"#[0-9a-f]{6}")
COLOURS = {
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
"""Named colours, as #rrggbb in sRGB."""
_TOLD = (
    ("floor", ("finish", "colour", "gloss")),
    ("markings", ("pattern", "colour", "wear")),
    ("columns", ("section", "guard")),
    ("walls", ("finish",)),
    ("lights", ("temperature_k",)),
)
"""Axes in the one-line summary, by group."""


def _colour(value: str) -> str:
    """Validate a colour, a name or ``#rrggbb``."""
    colour = COLOURS.get(value.lower(), value.lower())
    if not _HEX.fullmatch(colour):
        raise ValueError(f"#rrggbb in sRGB, or one of {', '.join(COLOURS)}")
    return colour


def _colour_or(*words: str) -> AfterValidator:
    return AfterValidator(lambda value: value if value in words else _colour(value))


Colour = Annotated[str, AfterValidator(_colour)]

NaturalColour = Annotated[str, _colour_or(NATURAL)]
"""A colour, or 'natural' for the material's own."""


class FloorFinish(StrEnum):
    """Finish of the floor."""

    CONCRETE = "concrete"
    """Concrete with dust in its pores."""
    TROWELLED = "trowelled"
    """Power-trowelled concrete with swirls."""
    SAWN = "sawn"
    """Power-trowelled concrete with sawn joints."""
    CRACKED = "cracked"
    """Concrete with hairline cracks and patches."""
    EPOXY = "epoxy"
    """A smooth epoxy coating of any colour."""
    ASPHALT = "asphalt"
    PATCHED = "patched"
    """Asphalt with patches and sealed cracks, at places that the seed draws."""
    PAVERS = "pavers"
    """Interlocking blocks of 0.1 x 0.2 m."""


class Gloss(StrEnum):
    """Gloss of the floor."""

    MATT = "matt"
    SATIN = "satin"
    POLISHED = "polished"
    MIRROR = "mirror"
    """Mirror-like: lamps reflect as long streaks."""


class Dirt(StrEnum):
    """Tyre dirt on the lanes."""

    SWEPT = "swept"
    """None: freshly cleaned."""
    FAINT = "faint"
    USUAL = "usual"
    FILTHY = "filthy"
    """Black along the tracks, grey between them."""


class Drains(StrEnum):
    """Drains of the lanes."""

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
    """Floor of the stalls: 'coated' with blue-grey epoxy, 'aisle' for the aisle's finish, or a fill colour."""
    dirt: Dirt = Dirt.USUAL
    """Tyre dirt on the lanes: 'swept', 'faint', 'usual' or 'filthy'."""
    wet: float = Field(0.0, ge=0, le=1)
    """Share of the lane squares without a speed bump that have a puddle; squares with drains and before ramps come
    first."""
    drains: Drains = Drains.NONE
    """'none', 'gratings' or 'channels'."""


class StallPattern(StrEnum):
    """Pattern of the lines that bound a stall."""

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
    HAIRPIN = "hairpin"
    """As 'double', joined by half a circle and further apart."""
    CORNERS = "corners"
    """An angle in each corner at the aisle only."""
    DASHED = "dashed"
    """As 'closed', by dashes."""
    NONE = "none"
    """No lines; numbers may remain."""


class LineEnds(StrEnum):
    """Form of the free ends of stalls' lines."""

    SQUARE = "square"
    ROUND = "round"
    """Half discs; closed stalls have rounded corners."""


class BandForm(StrEnum):
    """Marking along the aisle at the stalls' entries."""

    NONE = "none"
    LINE = "line"
    """A second line."""
    BAND = "band"
    """A coloured band between two lines, as for walkways and guide strips."""


class Pictogram(StrEnum):
    """Pictogram on coloured bands, in every other square."""

    WALKER = "walker"
    CAR = "car"
    LIFT = "lift"
    NONE = "none"


class Wear(StrEnum):
    """Wear of the paint by traffic."""

    LIGHT = "light"
    """A few worn spots, the default."""
    FRESH = "fresh"
    WORN = "worn"
    FADED = "faded"
    """Almost gone."""


class MarkingsLook(Settings):
    """Markings on the floor."""

    pattern: StallPattern = StallPattern.SIDES
    """'sides', 'closed', 't_marks', 'l_marks', 'double', 'hairpin', 'corners', 'dashed' or 'none'."""
    line_ends: LineEnds = LineEnds.SQUARE
    """Free ends of the stalls' lines: 'square', or 'round'; then the corners of closed stalls are rounded too."""
    corner_radius_m: float = Field(0.25, ge=0.15, le=0.4)
    """Outer radius of the corners of 'closed' stalls with round ends."""
    closed_behind: bool = True
    """Lines or marks at the rear of the stalls too; patterns without any there, such as 'corners', have none."""
    colour: Colour = "white"
    """Colour of the stalls' lines."""
    line_width_m: float = Field(0.12, ge=0.05, le=0.3)
    """Width of the stalls' lines."""
    wear: Wear = Wear.LIGHT
    """'fresh', 'light', 'worn' or 'faded'."""
    band: BandForm = BandForm.NONE
    """Marking along the aisle at the stalls' entries: 'none', a 'line' or a coloured 'band' between lines."""
    band_gap_m: float = Field(0.3, ge=0.1, le=0.6)
    """Distance of the marking from the stalls' entries."""
    band_width_m: float = Field(0.6, ge=0.3, le=1.2)
    """Width of a coloured band."""
    band_colour: Colour = "green"
    """Colour of a coloured band."""
    band_both_sides: bool = True
    """A coloured band on both sides of aisles; if false, the band on one side and a line on the other."""
    pictogram: Pictogram = Pictogram.WALKER
    """Pictograms on a coloured band, with chevrons between them: 'walker', 'car', 'lift' or 'none'."""
    hatching: bool = False
    """Hatching of the floor between rows of stalls, beside columns and at the ends of rows."""
    lane_colour: Colour = "yellow"
    """Colour of the lines along the edges of lanes."""
    arrow_colour: Colour = "white"
    """Colour of arrows, dashes and crossings."""
    ghosts: float = Field(0.0, ge=0, le=1)
    """Share of the squares with stalls where older lines at other positions still show through."""
    zebra: float = Field(0.0, ge=0, le=1)
    """Share of the straight lane squares with a zebra crossing that leads to no door."""


class NumberPlace(StrEnum):
    """Position of a stall's number."""

    MOUTH = "mouth"
    """On the stall, at its entry."""
    MIDDLE = "middle"
    REAR = "rear"
    LANE = "lane"
    """On the lane before the stall, if the marking along the aisle leaves room; else at its entry."""
    WALL = "wall"
    """On the wall behind the stall, if there is one; else at its entry."""
    NONE = "none"


class NumberForm(StrEnum):
    """Format of a painted stall number."""

    SHORT = "short"
    """Number within the zone: 07."""
    FULL = "full"
    """Zone and number: A1-07."""
    BOXED = "boxed"
    """Number within the zone, in a frame."""


class NumbersLook(Settings):
    """Stall numbers."""

    place: NumberPlace = NumberPlace.MOUTH
    """'mouth', 'middle', 'rear', 'lane', 'wall' or 'none'."""
    form: NumberForm = NumberForm.SHORT
    """'short', 'full' or 'boxed'."""
    height_m: float = Field(0.45, ge=0.12, le=1.0)
    """Height of the characters, reduced where the number would be wider than its stall."""
    colour: Colour = "white"
    """Colour of the characters."""


class ColumnSection(StrEnum):
    """Cross-section of columns, within the square of side `bay.column_size_m`."""

    SQUARE = "square"
    ROUND = "round"
    RECTANGULAR = "rectangular"


class Guard(StrEnum):
    """Guard at the foot of columns."""

    YELLOW_BLACK = "yellow_black"
    RED_WHITE = "red_white"
    BLUE_YELLOW = "blue_yellow"
    RUBBER = "rubber"
    """Black and yellow rubber on the corners."""
    NONE = "none"


class ColumnsLook(Settings):
    """Look of the columns."""

    section: ColumnSection = ColumnSection.SQUARE
    """Cross-section: 'square', 'round' or 'rectangular', within the square of side `bay.column_size_m`."""
    colour: NaturalColour = NATURAL
    """Colour of the shaft, or 'natural' for bare concrete."""
    guard: Guard = Guard.YELLOW_BLACK
    """Guard at the foot: 'yellow_black', 'red_white', 'blue_yellow', 'rubber' corners or 'none'."""
    guard_height_m: float = Field(1.2, ge=0.3, le=2.0)
    """Height of the guard."""


class WallFinish(StrEnum):
    """Finish of walls."""

    RAW = "raw"
    """Concrete as the formwork left it."""
    PAINTED = "painted"
    BLOCKWORK = "blockwork"
    PANELS = "panels"


class WallsLook(Settings):
    """Look of the walls."""

    finish: WallFinish = WallFinish.RAW
    """'raw' concrete, 'painted', 'blockwork' or 'panels'."""
    colour: NaturalColour = NATURAL
    """Colour of the wall, or 'natural'."""
    dado: Annotated[str, _colour_or(NATURAL, NO_DADO)] = NATURAL
    """Painted band at the wall's foot: 'natural' for blue-green under a yellow stripe, a colour, or 'none'."""
    dado_height_m: float = Field(1.1, ge=0.3, le=1.8)
    """Height of the painted band."""

    @property
    def dado_m(self) -> float:
        """Height of the painted band in metres; 0 if there is none."""
        return 0.0 if self.dado == NO_DADO else self.dado_height_m

    @property
    def has_stripe(self) -> bool:
        """True if a yellow stripe runs above the painted band; only with the 'natural' one."""
        return self.dado == NATURAL


class CeilingFinish(StrEnum):
    """Finish of the ceiling's underside."""

    RAW = "raw"
    WHITE = "white"
    BLACK = "black"
    BOARDS = "boards"
    """Insulation boards of mineral wool."""


class CeilingLook(Settings):
    """Look of the ceiling and the services below it."""

    finish: CeilingFinish = CeilingFinish.RAW
    """'raw' concrete, 'white', 'black' or insulation 'boards'."""
    services: NaturalColour = NATURAL
    """Colour of ducts, trays and pipes, or 'natural' for galvanised steel and red pipes."""
    round_ducts: bool = False
    """Round ducts instead of rectangular ones."""


class LampKind(StrEnum):
    """Type of the lamps."""

    TUBES = "tubes"
    PANELS = "panels"
    ROUND = "round"


class Daylight(StrEnum):
    """Daylight at the doors."""

    OVERCAST = "overcast"
    SUN = "sun"
    DUSK = "dusk"
    NIGHT = "night"


class LightsLook(Settings):
    """Look of the lights."""

    lamps: LampKind = LampKind.TUBES
    """Type of the lamps: 'tubes', square 'panels' or 'round'."""
    temperature_k: float = Field(5200.0, ge=2200, le=9000)
    """Colour temperature."""
    spread_k: float = Field(0.0, ge=0, le=2000)
    """Standard deviation of the colour temperature between lamps."""
    dead_share: float = Field(0.0, ge=0, le=0.9)
    """Share of the lamps that do not burn."""
    emergency_only: bool = False
    """Emergency lighting: only one lamp in eight burns, as after a power failure."""
    daylight: Daylight = Daylight.OVERCAST
    """Daylight at the doors: 'overcast', 'sun', 'dusk' or 'night'."""


class SignsOf(StrEnum):
    """Convention that signs follow: words, colours and emergency numbers."""

    INTERNATIONAL = "international"
    """EXIT, and 119 for the fire brigade."""
    PROFILE = "profile"
    """Those of the profile's country."""


class SignsLook(Settings):
    """Look of signs and plates."""

    of: SignsOf = SignsOf.INTERNATIONAL
    """'international', or 'profile' for the convention of the profile's country."""


class LookConfig(Settings):
    """Look of the garage."""

    floor: FloorLook = FloorLook()
    """Floor."""
    markings: MarkingsLook = MarkingsLook()
    """Markings on the floor."""
    numbers: NumbersLook = NumbersLook()
    """Stall numbers."""
    columns: ColumnsLook = ColumnsLook()
    """Columns."""
    walls: WallsLook = WallsLook()
    """Walls."""
    ceiling: CeilingLook = CeilingLook()
    """Ceiling and the services below it."""
    lights: LightsLook = LightsLook()
    """Lights."""
    signs: SignsLook = SignsLook()
    """Signs and plates."""
    drawn: bool | tuple[str, ...] = False
    """Axes drawn by the seed: true for each axis that is not given, or a list of axes ('floor.gloss') and of groups
    ('markings', for all axes in it that are not given)."""

    textures: TextureFolder | None = None
    """Folder of the user's textures by role (see the page on looks); they replace those of the chosen finishes."""
    font: FontFile | None = Field(None, exclude_if=lambda font: font is None)
    """The user's font for stall numbers (.ttf, .otf), in place of the package's lettering."""

    @field_validator("font", mode="before")
    @classmethod
    def _file(cls, font: object) -> object:
        return {"file": font} if isinstance(font, str) else font

    @field_validator("font")
    @classmethod
    def _with_digest(cls, font: FontFile | None) -> FontFile | None:
        """Add the digest of the font; one that has a digest is read on use."""
        return read_font(font) if font is not None and not font.sha256 else font

    @field_validator("textures", mode="before")
    @classmethod
    def _folder(cls, textures: object) -> object:
        return {"folder": textures} if isinstance(textures, str) else textures

    @field_validator("textures")
    @classmethod
    def _read(cls, textures: TextureFolder | None) -> TextureFolder | None:
        """Add a digest of the folder's contents; a folder that has a digest is read on use."""
        return read_texture_sets(textures)[0] if textures is not None and not textures.sha256 else textures

    @property
    def may_be_dim(self) -> bool:
        """True if lamps may be dead, so that the floor gets less light than the standard asks for."""
        drawn = {"lights.dead_share", "lights.emergency_only"} & {*self.axes}
        return bool(drawn or self.lights.dead_share or self.lights.emergency_only)

    @field_validator("drawn")
    @classmethod
    def _axes(cls, drawn: "bool | tuple[str, ...]", info: ValidationInfo) -> tuple[str, ...]:
        """Expand `drawn` to the full names of axes, so that a stored configuration names each of them."""
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
        """Full names of the drawn axes, in declaration order."""
        return self.drawn if isinstance(self.drawn, tuple) else ()


def look_text(look: LookConfig) -> str:
    """Write a look as TOML tables of a configuration, with the values that the seed drew."""
    tables = {name: group for name in type(look).model_fields if isinstance(group := getattr(look, name), Settings)}
    of_user = {"textures": look.textures and look.textures.folder, "font": look.font and look.font.file}
    given = {name: path for name, path in of_user.items() if tables.pop(name, None) is not None}
    blocks = [_table("look", given)] if given else []
    blocks += [_table(f"look.{name}", group.model_dump(mode="json")) for name, group in tables.items()]
    return "\n\n".join(blocks) + "\n"


def look_in_words(look: LookConfig) -> str:
    """Summarise the settings of a look in one line."""
    values = look.model_dump(mode="json")
    parts = (
        " ".join(f"{values[group][axis]:g}" if axis.endswith("_k") else str(values[group][axis]) for axis in axes)
        for group, axes in _TOLD
    )
    return ", ".join(parts).replace("_", " ") + " K"


def _table(name: str, values: dict[str, Any]) -> str:
    # strings, numbers and booleans are written alike in JSON and in TOML
    return "\n".join([f"[{name}]", *(f"{key} = {json.dumps(value)}" for key, value in values.items())])
