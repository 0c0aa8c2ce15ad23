"""Settings of the site: contour, portals, obstacles, size of squares, and several levels with ramps."""

from enum import StrEnum
from pathlib import Path
from typing import Annotated, Literal, Self

import numpy as np
from pydantic import BeforeValidator, Field, model_validator

from garage2usd.common.errors import ConfigError
from garage2usd.common.settings import Settings

SquareIndex = tuple[Annotated[int, Field(ge=0)], Annotated[int, Field(ge=0)]]
MAX_SQUARES = 250_000
DEFAULT_SIDE_M = 8.1
"""Side in metres of squares whose size is not given."""
_DEFAULT_SHAPE = 7, 9
CARRIAGEWAY_MARGIN_M = 0.05
DOOR_JAMB_M, DOOR_FRAME_M = 0.6, 0.08
"""Widths of wall and steel frame on each side of a vehicle door."""
_MAX_GIVEN_SQUARES = 4_000_000
_CELLS = (-1, 0, 1, 2, 3)
Side = Literal["up", "down", "left", "right"]
"""A direction in the plan, or an edge of a square: ``up`` leads to the first row, ``left`` to the first column."""


def _drawing(value: object) -> object:
    """Convert an array or a list of rows, of numbers -1 to 3 or of symbols, to the text form."""
    if isinstance(value, list | tuple) and value and all(isinstance(row, str) for row in value):
        return "\n".join(value)
    if not isinstance(value, np.ndarray | list | tuple):
        return value
    try:
        cells = np.asarray(value)
    except ValueError:
        raise ValueError("rows of equal length") from None
    if cells.ndim != 2 or not 0 < cells.size <= _MAX_GIVEN_SQUARES:  # noqa: PLR2004 - rows and columns
        raise ValueError(f"rows and columns of at most {_MAX_GIVEN_SQUARES} squares, not the shape {cells.shape}")
    if cells.dtype.kind not in "iuf" or not np.isin(cells, _CELLS).all():
        raise ValueError("whole numbers -1 outside or obstacle, 0 free, 1 lane, 2 entrance, 3 exit")
    return "\n".join(" ".join(map(str, row)) for row in cells.astype(np.int64).tolist())


def _lists(value: object) -> object:
    """Convert arrays to lists of numbers."""
    return value.tolist() if isinstance(value, np.ndarray) else value


Drawing = Annotated[str, BeforeValidator(_drawing)]

SideM = Annotated[float, Field(ge=1, le=50)]

SidesM = Annotated[SideM | tuple[SideM, ...] | tuple[tuple[SideM, ...], ...], BeforeValidator(_lists)]


class SiteConfig(Settings):
    """Contour, portals and obstacles: drawn by the paper's rules, or given in part or in whole."""

    width_cells: int | None = Field(None, ge=3, le=1000)
    """Columns of the structure matrix, the paper's w; 9 unless this or a drawing of the site is given."""
    height_cells: int | None = Field(None, ge=3, le=1000)
    """Rows of the structure matrix, the paper's h; 7 unless this or a drawing of the site is given."""
    rectangles: int = Field(0, ge=0, le=64)
    """Number of random rectangles whose union is the contour, the paper's n; 0 fills the whole width and height."""
    min_fill: float = Field(0.5, ge=0, le=0.9)
    """Least share of the squares that a random contour covers; 0 accepts any, as in the paper."""
    entrances: int = Field(1, ge=1, le=16)
    """Number of entrances to draw."""
    exits: int = Field(1, ge=1, le=16)
    """Number of exits to draw."""
    min_portal_distance_cells: int = Field(4, ge=1, le=2000)
    """Least Manhattan distance between two portals, the paper's sigma_1."""
    obstacles: int = Field(0, ge=0, le=10_000)
    """Number of inner squares that become obstacles."""
    min_obstacle_distance_cells: int = Field(3, ge=1, le=2000)
    """Least Manhattan distance between two obstacles, the paper's sigma_2."""

    contour: Drawing | None = None
    """The contour as text: one line per row, '#' outside and '.' inside; also a list of rows, and in Python an array of
    -1 and 0."""
    entrance_cells: tuple[SquareIndex, ...] | None = None
    """[row, col] of each entrance, instead of drawing them."""
    exit_cells: tuple[SquareIndex, ...] | None = None
    """[row, col] of each exit, instead of drawing them."""
    obstacle_cells: tuple[SquareIndex, ...] | None = None
    """[row, col] of each obstacle, instead of drawing them."""
    structure: Drawing | None = None
    """The paper's S as text: '#', '.', '=' lane, 'E' entrance, 'X' exit, or numbers -1 to 3; also a list of rows, of
    symbols or of numbers, and in Python an array. Lanes are planned if there are none, else kept unchanged."""
    structure_file: Path | None = None
    """A text file with such a matrix, or an .npy or .npz file of NumPy; an .npz file may hold S, R and C. A relative
    path starts at the configuration file."""

    @model_validator(mode="after")
    def _one_source(self) -> Self:
        if self.structure is not None and self.structure_file is not None:
            raise ValueError("only one of structure and structure_file")
        whole = self.structure is not None or self.structure_file is not None
        parts = ("contour", "entrance_cells", "exit_cells", "obstacle_cells")
        given = [name for name in parts if getattr(self, name) is not None]
        if whole and given:
            raise ValueError(f"no {given[0]} beside a complete structure")
        height, width = self.shape
        if width * height > MAX_SQUARES:
            raise ValueError(f"at most {MAX_SQUARES} squares in width_cells x height_cells")
        return self

    @property
    def shape(self) -> tuple[int, int]:
        """Rows and columns of a site that is not given as a drawing."""
        return self.height_cells or _DEFAULT_SHAPE[0], self.width_cells or _DEFAULT_SHAPE[1]


class BayConfig(Settings):
    """Sizes of squares, stalls, columns, aisles and doors."""

    square_side_m: float = Field(DEFAULT_SIDE_M, ge=1, le=50)
    """Side of the squares whose size is neither given nor chosen by `dimensioned`: three stalls between columns. A
    given value means a uniform grid: `dimensioned` is then false by default."""
    column_widths_m: SidesM | None = None
    """The paper's R: widths of the columns along X, one value for all, one each, or one for each square, constant along
    a column; if left out, `square_side_m` or the result of `dimensioned`."""
    row_depths_m: SidesM | None = None
    """The paper's C: depths of the rows along Z, one value for all, one each, or one for each square, constant along a
    row; if left out, `square_side_m` or the result of `dimensioned`."""
    column_widths_file: Path | None = None
    """A file that holds R: numbers as text, an .npy file, or R in an .npz file. A relative path starts at the
    configuration file."""
    row_depths_file: Path | None = None
    """A file that holds C: numbers as text, an .npy file, or C in an .npz file. A relative path starts at the
    configuration file."""
    stall_width_m: float = Field(2.4, ge=1.8, le=6)
    """Width of one stall between its lines."""
    stall_length_m: float = Field(5.3, ge=3.5, le=12)
    """Length of one stall from its entry on the lane to its rear line."""
    column_size_m: float = Field(0.6, ge=0.2, le=1.2)
    """Side of the square structural columns between bays."""
    column_setback_m: float = Field(0, ge=0, le=3)
    """How far the columns between two bays of stalls stand back from the mouths, so that cars turn in more easily.
    Those that cannot, beside lanes on two sides or with a stall in the way, stay at the corner."""
    wall_gap_m: float = Field(0.3, ge=0, le=3)
    """Least gap between a wall and the line of the adjacent stall; half a column leaves at least as much."""
    dimensioned: bool = True
    """Choose R and C for the finished plan, unless they are given: aisles of `aisle_width_m`, stalls that just fit, and
    the least floor area per stall."""
    aisle_width_m: float = Field(6.0, ge=5, le=12)
    """Clear width of the aisles between columns if R and C are chosen."""
    portal_width_m: float = Field(5.0, ge=2.5, le=6)
    """Least clear width of vehicle doors if R and C are chosen."""

    @model_validator(mode="before")
    @classmethod
    def _uniform_if_asked(cls, given: object) -> object:
        if isinstance(given, dict) and "square_side_m" in given and "dimensioned" not in given:
            return {**given, "dimensioned": False}
        return given

    @property
    def chosen_sides(self) -> tuple[bool, bool]:
        """True for C (row depths), and for R (column widths), if they are chosen with the plan."""
        return self.dimensioned and self.row_depths_m is None, self.dimensioned and self.column_widths_m is None

    @model_validator(mode="after")
    def _one_source(self) -> Self:
        for sides, file in (("column_widths_m", "column_widths_file"), ("row_depths_m", "row_depths_file")):
            if getattr(self, sides) is not None and getattr(self, file) is not None:
                raise ValueError(f"only one of {sides} and {file}")
        return self

    @property
    def carriageway_setback_m(self) -> float:
        """Distance of the carriageway from squares that are not lanes, in metres: half a column and a margin."""
        return self.column_size_m / 2 + CARRIAGEWAY_MARGIN_M

    @property
    def row_ends_m(self) -> float:
        """Length in metres that both ends of a row of stalls take from a square's edge: half a column or a wall gap."""
        return max(self.column_size_m, 2 * self.wall_gap_m)

    @property
    def aisle_side_m(self) -> float:
        """Side of a line of squares across an aisle of `aisle_width_m`, in metres."""
        return self.aisle_width_m + 2 * self.carriageway_setback_m

    def row_m(self, stalls: int) -> float:
        """Side in metres of a square with `stalls` stalls between columns along its edge."""
        return stalls * self.stall_width_m + self.row_ends_m

    @property
    def portal_side_m(self) -> float:
        """Least side in metres of a square with a door of `portal_width_m`."""
        return self.portal_width_m + 2 * (DOOR_JAMB_M + DOOR_FRAME_M)


class LinkKind(StrEnum):
    """Kinds of ramps between two levels."""

    STRAIGHT = "straight"
    """A straight ramp."""
    HELIX = "helix"
    """A ramp round three quarters of a circle from level to level."""


class RampsPlace(Settings):
    """The squares of the ramps between levels, given instead of drawn."""

    square: SquareIndex
    """(row, col) of the landing at the head of the ramp down; for helices, of the corner square of the one down,
    between its landings."""
    way: Side
    """Direction of the straight ramp down, in the plan; for helices, from the landings of both in a row into their
    blocks."""
    aside: Side | None = None
    """For helices: direction from the one down to the one up. Of straight ramps it follows from the side of the road
    that cars keep to."""
    count: int | None = Field(None, ge=1, le=40)
    """Number of squares of each straight ramp, or along each side of a helix; left out, the least that does."""


class BuildingConfig(Settings):
    """The levels of the building and the ramps that link them."""

    levels: int = Field(1, ge=1, le=6)
    """Number of levels, U1 at the top with the entrances and exits to the street. From two on, a pair of one-way ramps
    side by side, one down and one up, links each level with the next one below."""
    ramps: LinkKind = Field(LinkKind.STRAIGHT, exclude_if=lambda kind: kind is LinkKind.STRAIGHT)
    """Ramps between levels: 'straight', or 'helix' for ramps that turn in blocks of usually 3 x 3 squares."""
    place: RampsPlace | None = Field(None, exclude_if=lambda place: place is None)
    """Squares of the ramps, the same between all levels; left out, they are drawn."""
    storey_m: float = Field(3.6, ge=2.65, le=10)
    """Height from the floor of a level to the floor above; at least 0.25 m over `fittings.ceiling_height_m`."""
    ramp_slope_percent: float = Field(15.0, ge=5, le=20)
    """Steepest slope of the ramps between levels, for helices along their inner wall, where the profile's
    `curved_ramp_slope` may be gentler. They fill their squares, and are gentler where these are longer."""
    ramp_transition_m: float = Field(3.6, ge=1, le=10)
    """Length of the parts of half that slope at the foot and the head of a ramp between levels."""

    @model_validator(mode="after")
    def _of_kind(self) -> Self:
        if self.place is not None:
            if self.ramps is LinkKind.STRAIGHT and self.place.aside is not None:
                raise ValueError("place.aside only with ramps = 'helix'")
            across = {"up", "down"} if self.place.way in {"left", "right"} else {"left", "right"}
            if self.ramps is LinkKind.HELIX and self.place.aside not in across:
                raise ValueError(f"place.aside of helices across place.way: {' or '.join(sorted(across))}")
        return self


def check_one_level(building: BuildingConfig) -> None:
    """Refuse several levels in a configuration that gives the lanes.

    Raises
    ------
    ConfigError
        If there is more than one level.
    """
    if building.levels > 1:
        wanted = "1 in a plan; build a garage of several levels, and check its stage or its report"
        raise ConfigError("building.levels", building.levels, wanted)
