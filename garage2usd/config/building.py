"""Settings of a building of several levels."""

from pydantic import Field

from garage2usd.common.settings import Settings

__all__ = ["BuildingConfig"]


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
