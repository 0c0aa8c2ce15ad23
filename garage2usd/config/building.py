"""Settings of a building of several levels."""

from enum import StrEnum

from pydantic import Field

from garage2usd.common.errors import ConfigError
from garage2usd.common.settings import Settings

__all__ = ["BuildingConfig", "LinkKind", "check_one_level"]


class LinkKind(StrEnum):
    """Kinds of ramps between two levels."""

    STRAIGHT = "straight"
    """A straight ramp."""
    HELIX = "helix"
    """A ramp round three quarters of a circle from level to level."""


class BuildingConfig(Settings):
    """The levels of the building and the ramps that link them."""

    levels: int = Field(1, ge=1, le=6)
    """Number of levels, U1 at the top with the entrances and exits to the street. From two on, a pair of one-way ramps
    side by side, one down and one up, links each level with the next one below."""
    ramps: LinkKind = Field(LinkKind.STRAIGHT, exclude_if=lambda kind: kind is LinkKind.STRAIGHT)
    """Ramps between levels: 'straight', or 'helix' for ramps that turn in blocks of usually 3 x 3 squares."""
    storey_m: float = Field(3.6, ge=2.65, le=10)
    """Height from the floor of a level to the floor above; at least 0.25 m over `fittings.ceiling_height_m`."""
    ramp_slope_percent: float = Field(15.0, ge=5, le=20)
    """Steepest slope of the ramps between levels, for helices along their inner wall, where the profile's
    `curved_ramp_slope` may be gentler. They fill their squares, and are gentler where these are longer."""
    ramp_transition_m: float = Field(3.6, ge=1, le=10)
    """Length of the parts of half that slope at the foot and the head of a ramp between levels."""


def check_one_level(building: BuildingConfig) -> None:
    """Refuse several levels where a garage of one level is made.

    Raises
    ------
    ConfigError
        If there is more than one level.
    """
    if building.levels > 1:
        wanted = "1 here; garage2usd.build_levels and `garage2usd build` make garages of several levels"
        raise ConfigError("building.levels", building.levels, wanted)
