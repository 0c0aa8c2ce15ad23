"""The place of a garage on the earth: from the frame of all maps to longitude and latitude."""

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray
from pxr import Usd

from garage2usd.common.package import of_extra
from garage2usd.config.outputs import MapsConfig
from garage2usd.garage import Point
from garage2usd.maps.frame import projection
from garage2usd.reading.whole_garage import garage_root
from garage2usd.survey.survey import FRAME_KEY

with of_extra("a map in degrees"):
    from pyproj import Transformer

_DIGITS = 10
"""Decimals of degrees: a hundredth of a millimetre, which PROJ gives alike on all processors."""
_NUMBERS = 5


class Georeference(NamedTuple):
    """The frame of a garage on the earth.

    Attributes
    ----------
    latitude_deg, longitude_deg
        The point around which a transverse Mercator of true scale projects the ground.
    turn_rad, shift_m
        Turn of that ground about the point, from x towards z, and the shift (x, z) that follow it into the stage.
    """

    latitude_deg: float
    longitude_deg: float
    turn_rad: float = 0.0
    shift_m: Point = (0.0, 0.0)

    def degrees(self, points: ArrayLike) -> NDArray[np.float64]:
        """Return longitude and latitude of points (x, y) of the map frame; float64, shape (n, 2)."""
        x, y = (np.asarray(points, np.float64).reshape(-1, 2) - (self.shift_m[0], -self.shift_m[1])).T
        cos, sin = math.cos(self.turn_rad), math.sin(self.turn_rad)
        to_degrees = Transformer.from_crs(
            projection(self.latitude_deg, self.longitude_deg), "EPSG:4326", always_xy=True
        )
        found = to_degrees.transform(x * cos - y * sin, x * sin + y * cos)
        degrees: NDArray[np.float64] = np.stack(found, axis=-1).round(_DIGITS) + 0.0
        return degrees


def georeference(stage: Usd.Stage | None, settings: MapsConfig) -> Georeference:
    """Return the place of a garage: that of its survey, if this had degrees, or else that of the settings."""
    root = garage_root(stage) if stage else None
    told = str(root.GetCustomDataByKey(FRAME_KEY) or "") if root else ""
    try:
        numbers = [float(word) for word in told.split()]
    except ValueError:  # edited by others
        numbers = []
    if len(numbers) != _NUMBERS or not all(map(math.isfinite, numbers)):
        return Georeference(settings.latitude_deg, settings.longitude_deg)
    latitude_deg, longitude_deg, turn_rad, x, z = numbers
    return Georeference(latitude_deg, longitude_deg, turn_rad, (x, z))
