"""A car that drives a trajectory over time, in a layer over a garage's stage."""

import math
from collections.abc import Sequence
from dataclasses import replace
from functools import lru_cache
from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from pxr import Gf, Kind, Sdf

from garage2usd.assets import Asset
from garage2usd.assets.number_plates import painted_plates
from garage2usd.config.vehicles import DRIVEN_BODIES, DRIVEN_PAINT, DRIVEN_PLATE, CarBody
from garage2usd.driving import DesignCar
from garage2usd.driving.timing import Motion
from garage2usd.driving.trajectory import Trajectory
from garage2usd.objects.car import car_spec
from garage2usd.stage.authoring import attribute, define, new_layer, operation, order_operations
from garage2usd.stage.cameras import FRAMES_PER_SECOND, bends, set_frames
from garage2usd.stage.moving_car import define_car, write_textures
from garage2usd.stage.prototypes import asset_of

CAR_NAME = "DrivingCar"
"""Name of the car below ``/Garage``."""
_TYPES = Sdf.ValueTypeNames


def body_within(car: DesignCar) -> CarBody:
    """Select the longest driving body that lies within a car, with the rear axles at the same place.

    Mirrors may protrude, as those of the design car do. If no body fits, the shortest is selected.
    """
    fitting = [body for body in DRIVEN_BODIES if car.holds(body)]
    return (
        max(fitting, key=lambda body: body.length_m) if fitting else min(DRIVEN_BODIES, key=lambda body: body.length_m)
    )


def write_driving_car(path: Path, motion: Motion, car: CarBody | None = None) -> tuple[Path, ...]:
    """Write a layer ``over /Garage`` with the car at ``/Garage/DrivingCar`` and its wheels below it.

    Parameters
    ----------
    path
        The file.
    motion
        Trajectory of the design car.
    car
        Visible car, of the catalogue or a model of the user; if left out, the result of `body_within`.

    Returns
    -------
    tuple of Path
        Textures beside the file that it refers to, which only a model of the user has.

    Notes
    -----
    24 frames per second, as in the stage, from frame 0. The car's origin is the centre of its rear axle on the floor.
    The wheels roll, and the front ones steer. Samples are left out where a value changes linearly, as USD interpolates.
    """
    last = math.ceil(motion.ends_s * FRAMES_PER_SECOND - 1e-6)
    frames = np.arange(last + 1)
    states = motion.at(frames / FRAMES_PER_SECOND)
    body = car or body_within(motion.car)
    with new_layer(path, default_prim="Garage") as layer:
        set_frames(layer, last)
        garage = Sdf.CreatePrimInLayer(layer, "/Garage")
        garage.specifier = Sdf.SpecifierOver
        place = garage.path.AppendChild(CAR_NAME)
        root = define(layer, place, "Xform", kind=Kind.Tokens.component, label=body.semantic_class.value)
        _author_drive(layer, root, states)
        _author_body(layer, root.path, body, states)
    return write_textures(path.parent, driven_asset(body))


def _author_drive(layer: Sdf.Layer, car: Sdf.PrimSpec, states: Trajectory) -> None:
    places = np.stack([states.x_m, states.y_m, states.z_m], axis=1)
    _sampled(layer, car, "translate", places)
    _sampled(layer, car, "rotateY", np.degrees(states.yaw_rad)[:, None])
    _sampled(layer, car, "rotateX", np.degrees(states.pitch_rad)[:, None])
    order_operations(car, ["translate", "rotateY", "rotateX"])
    for name in ("speed_m_s", "acceleration_m_s2", "steering_rad"):
        values = getattr(states, name)
        spec = attribute(car, f"garage:drive:{name.split('_', maxsplit=1)[0]}", _TYPES.Double, float(values[0]))
        for frame in bends(values[:, None]):
            layer.SetTimeSample(spec.path, float(frame), round(float(values[frame]), 6))


@lru_cache(maxsize=32)
def driven_asset(body: CarBody) -> Asset:
    """Return the asset of a driving car with its own number plates, in the axes of a parked car.

    Raises
    ------
    ConfigError
        If the file of a model of the user has changed since the settings were read.
    """
    asset = asset_of(car_spec(body, DRIVEN_PAINT))
    return replace(asset, parts=(*asset.parts, *painted_plates(body, DRIVEN_PLATE)))


def _author_body(layer: Sdf.Layer, car: Sdf.Path, body: CarBody, states: Trajectory) -> None:
    rolled = np.concatenate([[0.0], np.cumsum(states.gear[1:] * np.diff(states.arc_m))])
    rolled_deg = -np.degrees(rolled / body.wheel_radius_m)

    def turned(wheel: Sdf.PrimSpec, is_front: bool) -> Sequence[str]:  # noqa: FBT001 - a callback of two
        if is_front:
            _sampled(layer, wheel, "rotateY", np.degrees(states.steering_rad)[:, None])
        _sampled(layer, wheel, "rotateX", rolled_deg[:, None])
        return ["rotateY", "rotateX"] if is_front else ["rotateX"]

    define_car(layer, car, body, driven_asset(body), paint=DRIVEN_PAINT, turned=turned)


def _sampled(layer: Sdf.Layer, prim: Sdf.PrimSpec, name: str, values: NDArray[np.float64]) -> None:
    """Author a transform operation with samples at the frames where its values, shape (frames, n), change slope."""
    is_vector = values.shape[1] > 1

    def value(frame: int) -> object:
        row = np.round(values[frame], 6).tolist()
        return Gf.Vec3d(*row) if is_vector else row[0]

    spec = operation(prim, name, _TYPES.Double3 if is_vector else _TYPES.Double, value(0))
    for frame in bends(np.round(values, 6)):
        layer.SetTimeSample(spec.path, float(frame), value(frame))
