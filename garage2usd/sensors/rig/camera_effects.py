"""Imperfections of cameras: settings of exposure, noise, lens errors, motion blur and compression."""

from typing import Annotated, Literal

from pydantic import Field

from garage2usd.common.settings import Settings

_Share = Annotated[float, Field(ge=0.0, le=1.0)]
_Ev = Annotated[float, Field(ge=-12.0, le=12.0)]


class CameraEffects(Settings):
    """Settings of a camera's exposure and of the errors of its lens and sensor; effects left out are absent.

    An around view applies them to each of its cameras, so that exposure and colour jump at the seams.
    """

    exposure: Literal["fixed", "automatic"] = "automatic"
    """`"automatic"`: the mean of the picture, clipped at white, becomes `grey`. `"fixed"`: light of 1 is white."""
    grey: float = Field(0.18, gt=0.0, lt=1.0)
    """Target mean of automatic exposure in linear light, where white is 1."""
    exposure_ev: _Ev = 0.0
    """Exposure compensation in stops; positive is brighter."""
    exposure_spread_ev: float = Field(0.0, ge=0.0, le=3.0)
    """Standard deviation of exposure between cameras, in stops."""
    most_gain_ev: float = Field(6.0, ge=0.0, le=12.0)
    """Maximum gain of automatic exposure, in stops."""
    full_well_electrons: float = Field(0.0, ge=0.0, le=1e7)
    """Electrons of a white pixel at a gain of 1, from which Poisson shot noise is drawn; larger gains need
    proportionally fewer. 0 for no shot noise."""
    read_noise_electrons: float = Field(0.0, ge=0.0, le=1e5)
    """Standard deviation of the sensor's read noise in electrons; needs `full_well_electrons`."""
    bits: int = Field(12, ge=8, le=16)
    """Bit depth of the sensor's values; applies if the sensor has noise."""
    white_balance_spread: float = Field(0.0, ge=0.0, le=0.5)
    """Standard deviation of the red and blue white-balance factors between cameras."""
    vignetting: _Share = 0.0
    """Share of the light lost at the edge of the field of view; grows as the square of the angle from the optical
    axis."""
    chromatic_error: float = Field(0.0, ge=-0.02, le=0.02)
    """Lateral chromatic aberration: share by which red is magnified relative to green, and blue reduced. Not for around
    views."""
    bloom: _Share = 0.0
    """Share of the light beyond white that spreads around its source."""
    bloom_width: float = Field(0.02, gt=0.0, le=0.5)
    """Standard deviation of bloom, as a share of the picture's width."""
    flare: _Share = 0.0
    """Share of the light beyond white that appears as a ghost, mirrored about the optical axis."""
    dirt: int = Field(0, ge=0, le=100)
    """Number of smudges on the lens."""
    headroom: float = Field(1.0, ge=1.0, le=64.0)
    """Dynamic range of the sensor as a multiple of white; light above half of white is compressed into the rest. 1
    clips at white."""
    tone: Literal["srgb", "linear"] = "srgb"
    """Transfer curve from linear light to pixel values."""
    exposure_s: float = Field(0.0, ge=0.0, le=0.2)
    """Exposure time of each row in seconds, which gives motion blur; 0 for no blur. Brightness is set by `exposure`.
    Not for around views."""
    readout_s: float = Field(0.0, ge=0.0, le=0.2)
    """Delay in seconds between the first and the last row of a rolling shutter; 0 for a global shutter. Not for around
    views."""
    jpeg_quality: int | None = Field(None, ge=1, le=100)
    """JPEG quality by which the picture is compressed, then decoded and written; no compression if left out."""

    @property
    def shows_motion(self) -> bool:
        """True if pictures depend on the camera's motion."""
        return bool(self.exposure_s or self.readout_s)
