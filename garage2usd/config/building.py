"""Settings of a building of several levels."""

from enum import StrEnum
from typing import Self

from pydantic import Field, model_validator

from garage2usd.common.errors import ConfigError
from garage2usd.common.settings import Settings
from garage2usd.config.side import Side
from garage2usd.config.site import SquareIndex

__all__ = ["BuildingConfig", "LinkKind", "RampsPlace", "check_one_level"]


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
    """Refuse several levels in a configuration whose given lanes are read as they are.

    Raises
    ------
    ConfigError
        If there is more than one level.
    """
    if building.levels > 1:
        wanted = "1 in a plan; build a garage of several levels, and check its stage or its report"
        raise ConfigError("building.levels", building.levels, wanted)
