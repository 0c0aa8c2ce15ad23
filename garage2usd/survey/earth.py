"""Points of the earth in the metres of a survey: a transverse Mercator of true scale around their middle."""

import numpy as np
from numpy.typing import ArrayLike, NDArray

from garage2usd.common.errors import ConfigError
from garage2usd.common.package import of_extra

with of_extra("a survey in degrees"):
    from pyproj import Transformer

Floats = NDArray[np.float64]

_ORIGIN_DIGITS = 6
"""Decimals of the origin in degrees: a tenth of a metre."""
_REACH_M = 100_000.0
_HALF_TURN_DEG, _TURN_DEG = 180.0, 360.0


def ground_of(degrees: ArrayLike, place: str, *, around: ArrayLike | None = None) -> tuple[Floats, tuple[float, float]]:
    """Project points of WGS 84 to the ground of a survey.

    Parameters
    ----------
    degrees
        Longitude and latitude of each point; shape (n, 2).
    place
        Place of the points in messages.
    around
        Longitude and latitude of the points in whose middle the origin lies; None for `degrees`.

    Returns
    -------
    ground
        (x, z) in metres, x east and z south; float64, shape (n, 2).
    origin_deg
        Latitude and longitude of (0, 0).

    Raises
    ------
    ConfigError
        If points are too far from each other for one plane.
    """
    points = np.array(degrees, np.float64)
    middles = points if around is None else np.array(around, np.float64)
    if np.ptp(middles[:, 0]) > _HALF_TURN_DEG:  # on both sides of the antimeridian
        points[:, 0], middles[:, 0] = points[:, 0] % _TURN_DEG, middles[:, 0] % _TURN_DEG
    middle = (middles.min(axis=0) + middles.max(axis=0)) / 2
    longitude, latitude = (round(degree, _ORIGIN_DIGITS) + 0.0 for degree in middle.tolist())
    longitude -= _TURN_DEG * (longitude > _HALF_TURN_DEG)
    projection = f"+proj=tmerc +lat_0={latitude!r} +lon_0={longitude!r} +k=1 +x_0=0 +y_0=0 +datum=WGS84 +units=m"
    to_metres = Transformer.from_crs("EPSG:4326", projection, always_xy=True)
    x, y = to_metres.transform(points[:, 0], points[:, 1])
    ground: Floats = np.stack([x, -np.asarray(y)], axis=-1)
    far = np.flatnonzero(~(np.abs(ground).max(axis=1) < _REACH_M))
    if len(far):
        longitude_deg, latitude_deg = points[far[0]].tolist()
        allowed = f"points within {_REACH_M / 1000:g} km of the others, around {latitude}, {longitude}"
        raise ConfigError(f"{place}: latitude and longitude", (latitude_deg, longitude_deg), allowed)
    return ground, (latitude, longitude)
