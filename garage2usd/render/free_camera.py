"""A free camera at a given position and target, without a camera prim in the stage."""

from collections.abc import Collection, Sequence

import numpy as np
from numpy.typing import NDArray
from pxr import Usd, UsdGeom

from garage2usd.common.errors import ConfigError
from garage2usd.render.cameras import Lens, View
from garage2usd.stage.cameras import APERTURE_MM, FOCAL_MM

__all__ = ["free_view"]

_NAME = "FreeCamera"
_FARTHEST_M = 1e5
_NEAREST_M = 0.001
_CLIP_M = (0.01, 2000.0)
_UPRIGHT = 1e-6
"""Sine of the angle to the vertical below which a camera's axis counts as vertical."""

_Vector = NDArray[np.float64]


def free_view(
    stage: Usd.Stage,
    at_m: Sequence[float],
    look_at_m: Sequence[float],
    size_px: tuple[int, int],
    taken: Collection[str],
) -> View:
    """Create the view of a free camera from its position and target, with the lens of garage cameras.

    Parameters
    ----------
    stage
        The stage, in whose axes the points are given.
    at_m, look_at_m
        Position of the camera and the point in the middle of its picture, in metres. The stage's up is up in the
        picture. For a camera that looks straight up or down, the top of the picture points to -Z, or to +Y in a stage
        with Z up.
    size_px
        Width and height; the width takes the whole horizontal aperture.
    taken
        Names already used by other views.

    Raises
    ------
    ConfigError
        If a point is invalid, or both are equal.
    """
    eye, target = _place("at", at_m), _place("look_at", look_at_m)
    back = eye - target
    distance_m = np.linalg.norm(back)
    if distance_m < _NEAREST_M:
        raise ConfigError("look_at", list(look_at_m), "another place than that of the camera (at)")
    back /= distance_m
    is_y_up = UsdGeom.GetStageUpAxis(stage) == UsdGeom.Tokens.y
    up, level = (np.eye(3)[1], -np.eye(3)[2]) if is_y_up else (np.eye(3)[2], np.eye(3)[1])
    if np.linalg.norm(np.cross(up, back)) < _UPRIGHT:
        up = level
    right = np.cross(up, back)
    right /= np.linalg.norm(right)
    to_world = np.eye(4)
    to_world[:3] = np.stack([right, np.cross(back, right), back, eye], axis=1)
    name = _NAME
    while name in taken:
        name += "_"
    facts = {"at_m": eye.tolist(), "look_at_m": target.tolist()}
    return View(name, name, None, Lens(FOCAL_MM, APERTURE_MM[0], (0.0, 0.0), _CLIP_M), size_px, to_world, facts)


def _place(field: str, place_m: Sequence[float]) -> _Vector:
    place = np.array(place_m, dtype=np.float64)
    if place.shape != (3,) or not (np.abs(place) <= _FARTHEST_M).all():
        raise ConfigError(field, list(place_m), f"X,Y,Z in metres, each from -{_FARTHEST_M:g} to {_FARTHEST_M:g}")
    return place
