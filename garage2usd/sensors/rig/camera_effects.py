"""What a camera does to light that a perfect one does not: settings of exposure, noise, lens errors, compression."""

from typing import Annotated, Literal

from pydantic import Field

from garage2usd.common.settings import Settings

__all__ = ["CameraEffects"]

_Share = Annotated[float, Field(ge=0.0, le=1.0)]
_Ev = Annotated[float, Field(ge=-12.0, le=12.0)]


class CameraEffects(Settings):
    """How a camera exposes, and which errors its lens and its sensor have; those that are left out it has not.

    An around view has them for each camera that serves it, so that exposure and colour jump at its seams.
    """

    exposure: Literal["fixed", "automatic"] = "automatic"
    """`"automatic"`: the mean of the picture, white at most, becomes `grey`. `"fixed"`: light of 1 is white."""
    grey: float = Field(0.18, gt=0.0, lt=1.0)
    """Mean that automatic exposure aims at; white is 1, in linear light."""
    exposure_ev: _Ev = 0.0
    """By how many stops pictures are brighter than that."""
    exposure_spread_ev: float = Field(0.0, ge=0.0, le=3.0)
    """Standard deviation by which cameras differ in exposure, in stops."""
    most_gain_ev: float = Field(6.0, ge=0.0, le=12.0)
    """By how many stops automatic exposure brightens at most."""
    full_well_electrons: float = Field(0.0, ge=0.0, le=1e7)
    """Electrons of a white pixel at a gain of 1, whose number varies as Poisson says; at larger gains as many fewer. 0
    for no shot noise."""
    read_noise_electrons: float = Field(0.0, ge=0.0, le=1e5)
    """Standard deviation of what reading a pixel adds; needs `full_well_electrons`."""
    bits: int = Field(12, ge=8, le=16)
    """Of the numbers that the sensor gives out, where it has noise."""
    white_balance_spread: float = Field(0.0, ge=0.0, le=0.5)
    """Standard deviation by which cameras differ in the factors of red and blue."""
    vignetting: _Share = 0.0
    """Share of the light that is lost at the edge of the field; it grows as the square of the angle from the axis."""
    chromatic_error: float = Field(0.0, ge=-0.02, le=0.02)
    """By which share red is larger about the optical axis than green, and blue smaller. Not for around views."""
    bloom: _Share = 0.0
    """Share of light beyond white that spreads around it."""
    bloom_width: float = Field(0.02, gt=0.0, le=0.5)
    """How far it spreads: a standard deviation, as a share of the picture's width."""
    flare: _Share = 0.0
    """Share of light beyond white that lenses mirror to the other side of the optical axis."""
    dirt: int = Field(0, ge=0, le=100)
    """Smudges on the lens."""
    headroom: float = Field(1.0, ge=1.0, le=64.0)
    """How many times white the sensor takes before it is full; what is beyond half of white is compressed into the
    rest. 1 burns out at white."""
    tone: Literal["srgb", "linear"] = "srgb"
    """Curve from linear light to the numbers of the picture."""
    exposure_s: float = Field(0.0, ge=0.0, le=0.2)
    """How long each row is open: what moves is blurred along its way meanwhile. 0 for no blur. Brightness stays that of
    `exposure`. Not for around views."""
    readout_s: float = Field(0.0, ge=0.0, le=0.2)
    """By how much the last row is open later than the first: a rolling shutter. 0 for all at once. Not for around
    views."""
    jpeg_quality: int | None = Field(None, ge=1, le=100)
    """The picture is compressed as a JPEG of this quality, and written as it is read from it; none if left out."""

    @property
    def shows_motion(self) -> bool:
        """Whether pictures depend on how the camera moves."""
        return bool(self.exposure_s or self.readout_s)
