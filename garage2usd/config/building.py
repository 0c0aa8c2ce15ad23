"""Settings of a building of several levels."""

from pydantic import Field

from garage2usd.common.errors import ConfigError
from garage2usd.common.settings import Settings

__all__ = ["BuildingConfig", "check_one_level"]


class BuildingConfig(Settings):
    """The levels of the building and the ramps that link them."""

    levels: int = Field(1, ge=1, le=6)
    """Number of levels, U1 at the top with the entrances and exits to the street. From two on, a pair of straight
    one-way ramps side by side, one down and one up, links each level with the next one below."""
    storey_m: float = Field(3.6, ge=2.65, le=10)
    """Height from the floor of a level to the floor above; at least 0.25 m over `fittings.ceiling_height_m`."""
    ramp_slope_percent: float = Field(15.0, ge=5, le=20)
    """Steepest slope of the ramps between levels. They fill their squares, and are gentler where these are longer."""
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
