"""Views without a camera prim: a free camera at a position, and bird's-eye views over a vehicle."""

from collections.abc import Collection, Sequence

import numpy as np
from numpy.typing import NDArray
from pxr import Usd, UsdGeom

from garage2usd.as_built.driven_ground import CAR_HEIGHT_M
from garage2usd.common.errors import ConfigError
from garage2usd.objects import CAR_LABELS
from garage2usd.reading.labels import Labels
from garage2usd.render.cameras import USD_FROM_OPENCV, Lens, View
from garage2usd.sensors.rays.birds_eye import BirdsEye
from garage2usd.stage.cameras import APERTURE_MM, FOCAL_MM
from garage2usd.stage.labels import OBJECT_LABELS
from garage2usd.stage.variants import SWITCHES

_FREE_CAMERA = "FreeCamera"
_FARTHEST_M = 1e5
_NEAREST_M = 0.001
_CLIP_M = (0.01, 2000.0)
_UPRIGHT = 1e-6
"""Sine of the angle to the vertical below which a camera's axis counts as vertical."""
_Vector = NDArray[np.float64]
OVERHEAD = frozenset(OBJECT_LABELS[kind] for kind, switch in SWITCHES.items() if switch.variant_set == "ceiling")
"""Semantic classes of overhead objects, except for lights, which a stage switches by themselves."""
_LIGHT = frozenset({OBJECT_LABELS["light"]})
_CAR = CAR_LABELS | {OBJECT_LABELS["number_plate"]}
_BIRDS_EYE = "birds_eye"
_ASIDE_M = np.array([1.3e-5, 0.7e-5, 0.0])
"""Offset of the camera, so that no row of rays passes exactly between two floor tiles and misses both."""


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
    name = _FREE_CAMERA
    while name in taken:
        name += "_"
    facts = {"at_m": eye.tolist(), "look_at_m": target.tolist()}
    return View(name, name, None, Lens(FOCAL_MM, APERTURE_MM[0], (0.0, 0.0), _CLIP_M), size_px, to_world, facts)


def _place(field: str, place_m: Sequence[float]) -> _Vector:
    place = np.array(place_m, dtype=np.float64)
    if place.shape != (3,) or not (np.abs(place) <= _FARTHEST_M).all():
        raise ConfigError(field, list(place_m), f"X,Y,Z in metres, each from -{_FARTHEST_M:g} to {_FARTHEST_M:g}")
    return place


def birds_eye_view(name: str, settings: BirdsEye, vehicle_to_world: NDArray[np.float64]) -> View:
    """Create the bird's-eye view over a vehicle, forwards up.

    Parameters
    ----------
    name
        Base name of the view's files.
    settings
        Settings of the view.
    vehicle_to_world
        Transform from the vehicle's axes (ISO 8855, the middle of the rear axle on the ground) to the stage's, in
        metres; float64, shape (4, 4).
    """
    to_world = vehicle_to_world @ settings.sensor_to_vehicle() @ USD_FROM_OPENCV
    to_world[:3, 3] += to_world[:3, :3] @ _ASIDE_M
    facts = {
        "metres_per_px": settings.metres_per_px,
        "vehicle_px": settings.places([(0.0, 0.0)])[0].tolist(),
        "vehicle_to_world": vehicle_to_world.tolist(),
        "lens": settings.lens.parameters(),
        "depth": "along_axis",
        "hidden_classes": sorted(_hidden_classes(settings)),
        "hidden_from_m": CAR_HEIGHT_M,
    }
    return View(name, _BIRDS_EYE, None, settings.lens, settings.size_px, to_world, facts)


def looked_through(labels: Labels, settings: BirdsEye) -> list[int]:
    """Return the ids of objects hidden from a bird's-eye view: overhead ones, and parked cars if switched off.

    Hidden lights still shine. Other objects above a car are found by their height, see `garage2usd.render.drawn_prims`.
    """
    return [labels.ids[path] for path in labels.paths_of(_hidden_classes(settings))]


def _hidden_classes(settings: BirdsEye) -> frozenset[str]:
    return OVERHEAD | _LIGHT if settings.cars else OVERHEAD | _LIGHT | _CAR
