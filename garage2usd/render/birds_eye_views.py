"""Bird's-eye views of a stage: an orthographic camera over a vehicle, and the objects hidden from it."""

import numpy as np
from numpy.typing import NDArray

from garage2usd.as_built.driven_ground import CAR_HEIGHT_M
from garage2usd.objects import CAR_LABELS
from garage2usd.reading.labels import Labels
from garage2usd.render.cameras import USD_FROM_OPENCV, View
from garage2usd.sensors.rays.birds_eye import BirdsEye
from garage2usd.stage.labels import OBJECT_LABELS
from garage2usd.stage.variants import SWITCHES

__all__ = ["OVERHEAD", "birds_eye_view", "looked_through"]

OVERHEAD = frozenset(OBJECT_LABELS[kind] for kind, switch in SWITCHES.items() if switch.variant_set == "ceiling")
"""Semantic classes of overhead objects, except for lights, which a stage switches by themselves."""
_LIGHT = frozenset({OBJECT_LABELS["light"]})
_CAR = CAR_LABELS | {OBJECT_LABELS["number_plate"]}
_NAME = "birds_eye"
_ASIDE_M = np.array([1.3e-5, 0.7e-5, 0.0])
"""Offset of the camera, so that no row of rays passes exactly between two floor tiles and misses both."""


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
    return View(name, _NAME, None, settings.lens, settings.size_px, to_world, facts)


def looked_through(labels: Labels, settings: BirdsEye) -> list[int]:
    """Return the ids of objects hidden from a bird's-eye view: overhead ones, and parked cars if switched off.

    Hidden lights still shine. Other objects above a car are found by their height, see `garage2usd.render.overhead`.
    """
    return [labels.ids[path] for path in labels.paths_of(_hidden_classes(settings))]


def _hidden_classes(settings: BirdsEye) -> frozenset[str]:
    return OVERHEAD | _LIGHT if settings.cars else OVERHEAD | _LIGHT | _CAR
