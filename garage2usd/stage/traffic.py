"""Cars and people of tracks over time, in a layer over a garage's stage."""

import math
import re
from collections.abc import Iterator, Mapping
from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from pxr import Gf, Kind, Sdf, UsdGeom

from garage2usd.config.vehicles import CarBody
from garage2usd.driving.tracks import Agent, AgentClass, AgentState, Track, Tracks, knots
from garage2usd.stage.agent_models import CARS, AgentModels, prim_name
from garage2usd.stage.authoring import attribute, define, new_layer, operation, order_operations
from garage2usd.stage.cameras import FRAMES_PER_SECOND, set_frames
from garage2usd.stage.moving_car import write_textures
from garage2usd.stage.track_people import figure_of, gait_of
from garage2usd.stage.walkers import HIPS_MOVE, animate_figure

TRAFFIC_NAME, MODELS_NAME = "Traffic", "Models"
"""Names of the scope of agents below ``/Garage``, and of that of their models below it, which is abstract."""
_TYPES = Sdf.ValueTypeNames
_NEAR_M, _NEAR_DEG, _ROLL_DEG = 5e-4, 0.02, 1.0
"""Deviations from the tracks that save samples: of places, of headings and pitches, and of wheels."""
_CAR_OF_STAGE = re.compile(r"Car_(\d+)")
_Floats = NDArray[np.float64]


def write_traffic_layer(path: Path, tracks: Tracks, cars: Mapping[str, CarBody] | None = None) -> tuple[Path, ...]:
    """Write a layer ``over /Garage`` with an agent for each track at ``/Garage/Traffic/<name>``.

    Parameters
    ----------
    path
        The file.
    tracks
        The tracks.
    cars
        Cars by the names of their bodies besides those of the catalogue: models of the user.

    Returns
    -------
    tuple of Path
        Textures beside the file that it refers to, which only models of the user have.

    Raises
    ------
    ConfigError
        If the body or paint of a car is unknown.

    Notes
    -----
    24 time codes per second, as in the stage, from 0. Places are within 0.5 mm of the tracks, as USD interpolates
    linearly, and headings within 0.02 degrees. An agent is invisible while it is not in the garage. A car of the stage
    that moves is deactivated in the stage, with its number plates, and stands as an agent at its first place from the
    beginning on. The origin of a car is the centre of its rear axle on the floor; its wheels roll and steer.
    """
    last = math.ceil(tracks.duration_s * FRAMES_PER_SECOND - 1e-6)
    with new_layer(path, default_prim="Garage") as layer:
        set_frames(layer, last)
        garage = Sdf.CreatePrimInLayer(layer, "/Garage")
        garage.specifier = Sdf.SpecifierOver
        traffic = define(layer, garage.path.AppendChild(TRAFFIC_NAME), "Scope").path
        shared = define(layer, traffic.AppendChild(MODELS_NAME), "Scope")
        shared.specifier = Sdf.SpecifierClass
        models = AgentModels(layer, shared.path, cars)
        for track, name in zip(tracks, _prim_names(track.agent.name for track in tracks), strict=True):
            agent = define(
                layer, traffic.AppendChild(name), "Xform", kind=Kind.Tokens.component, label=track.agent.kind.value
            )
            _describe(agent, track.agent)
            if track.agent.kind is AgentClass.PERSON:
                _author_person(layer, agent, track, models)
            elif track.agent.kind in CARS:
                _author_car(layer, agent, track, models)
            else:
                _refer(agent, models.of(track.agent))
                _author_pose(layer, agent, track, np.stack([track.x_m, track.y_m, track.z_m], axis=1))
            _author_presence(layer, agent, track, last)
            _hide(layer, track.agent.prim)
    return write_textures(path.parent, *models.assets)


def _prim_names(names: Iterator[str]) -> Iterator[str]:
    """Names of prims for names of agents, each once."""
    used = {MODELS_NAME}
    for name in names:
        own = prim_name(name)
        while own in used:
            own += "_"
        used.add(own)
        yield own


def _describe(prim: Sdf.PrimSpec, agent: Agent) -> None:
    attribute(prim, "garage:agent:name", _TYPES.String, agent.name)
    sizes = Gf.Vec3f(agent.width_m, agent.height_m, agent.length_m)
    attribute(prim, "garage:agent:size", _TYPES.Float3, sizes)
    if agent.behaviour:
        attribute(prim, "garage:agent:behaviour", _TYPES.Token, agent.behaviour)


def _author_presence(layer: Sdf.Layer, prim: Sdf.PrimSpec, track: Track, last: int) -> None:
    """Show the agent from its first sample to its last, and write its states."""
    frames = _frames(track)
    begins = 0.0 if track.agent.prim else float(frames[0])
    shown = {0.0: begins == 0, begins: True, float(frames[-1]) + 1.0: False}
    _switched(layer, prim, "visibility", {at: _shown(is_shown) for at, is_shown in shown.items() if at <= last})
    states = np.flatnonzero(np.diff(track.state, prepend=-1))
    words = {float(frames[at]): AgentState(track.state[at]).name.lower() for at in states.tolist()}
    _switched(layer, prim, "garage:agent:state", words)


def _shown(is_shown: bool) -> str:  # noqa: FBT001 - a predicate in words
    return str(UsdGeom.Tokens.inherited if is_shown else UsdGeom.Tokens.invisible)


def _switched(layer: Sdf.Layer, prim: Sdf.PrimSpec, name: str, values: Mapping[float, str]) -> None:
    """Author a token that holds from time to time; it is constant if it has one value."""
    spec = attribute(prim, name, _TYPES.Token, next(iter(values.values())))
    if len({*values.values()}) > 1:
        for frame, value in values.items():
            layer.SetTimeSample(spec.path, frame, value)


def _frames(track: Track) -> _Floats:
    return np.round(track.time_s * FRAMES_PER_SECOND, 6)


def _sampled(
    layer: Sdf.Layer, prim: Sdf.PrimSpec, name: str, frames: _Floats, values: _Floats, tolerance: float
) -> None:
    """Author an operation whose values, shape (n,) or (n, 3), are linear between the samples kept."""
    columns = values.reshape(len(frames), -1)
    is_vector = columns.shape[1] > 1
    rounded = np.round(columns, 6) + 0.0
    rows = [Gf.Vec3f(*row) if is_vector else row[0] for row in rounded.tolist()]
    spec = operation(prim, name, _TYPES.Float3 if is_vector else _TYPES.Float, rows[0])
    if len(frames) == 1 or np.ptp(columns, axis=0).max() <= tolerance:
        return
    for number in np.unique(np.concatenate([knots(frames, column, tolerance) for column in columns.T])).tolist():
        layer.SetTimeSample(spec.path, float(frames[number]), rows[number])


def _author_pose(layer: Sdf.Layer, prim: Sdf.PrimSpec, track: Track, places: _Floats) -> None:
    frames = _frames(track)
    _sampled(layer, prim, "translate", frames, places, _NEAR_M)
    _sampled(layer, prim, "rotateY", frames, np.degrees(track.yaw_rad), _NEAR_DEG)
    _sampled(layer, prim, "rotateX", frames, np.degrees(track.pitch_rad), _NEAR_DEG)
    order_operations(prim, ["translate", "rotateY", "rotateX"])


def _author_car(layer: Sdf.Layer, prim: Sdf.PrimSpec, track: Track, models: AgentModels) -> None:
    body, model, frames = models.body_of(track.agent), models.of(track.agent), _frames(track)
    _refer(prim, model)
    _author_pose(layer, prim, track, track.axle_m(body.rear_axle_m))
    rolled_deg = -np.degrees(track.rolled_m(body.rear_axle_m) / body.wheel_radius_m)
    for name in ("FrontLeftWheel", "FrontRightWheel", "RearLeftWheel", "RearRightWheel"):
        if layer.GetPrimAtPath(model.AppendChild(name)):
            wheel = Sdf.CreatePrimInLayer(layer, prim.path.AppendChild(name))
            if name.startswith("Front"):
                _sampled(layer, wheel, "rotateY", frames, np.degrees(track.steering_rad), _ROLL_DEG)
            _sampled(layer, wheel, "rotateX", frames, rolled_deg, _ROLL_DEG)


def _author_person(layer: Sdf.Layer, prim: Sdf.PrimSpec, track: Track, models: AgentModels) -> None:
    """Author a figure that walks and stands along the track."""
    _, figure, factor = figure_of(track.agent)
    gait = gait_of(track)
    places = np.stack([track.x_m, track.y_m, track.z_m], axis=1)
    _sampled(layer, prim, "translate", _frames(track), places, _NEAR_M)
    _sampled(layer, prim, "rotateY", gait.frames, np.degrees(gait.yaw_rad), _NEAR_DEG)
    order_operations(prim, ["translate", "rotateY"])
    root = define(layer, prim.path.AppendChild("Figure"), "SkelRoot")
    _refer(root, models.of(track.agent))
    # figures look to +Z, agents to -Z
    operation(root, "rotateY", _TYPES.Float, 180.0)
    operation(root, "scale", _TYPES.Float3, Gf.Vec3f(factor))
    order_operations(root, ["rotateY", "scale", HIPS_MOVE])
    motion = gait.motion._replace(hips_m=gait.motion.hips_m / factor)
    animate_figure(layer, root, figure.skeleton, gait.frames[gait.poses].tolist(), motion)


def _refer(prim: Sdf.PrimSpec, model: Sdf.Path) -> None:
    prim.referenceList.prependedItems = [Sdf.Reference("", model)]


def _hide(layer: Sdf.Layer, place: str) -> None:
    """Deactivate a car of the stage, and its number plates beside it."""
    if not place:
        return
    path = Sdf.Path(place)
    number = _CAR_OF_STAGE.fullmatch(path.name)
    plates = [path.ReplaceName(f"NumberPlate_{number[1]}")] if number else []
    for hidden in (path, *plates):
        over = Sdf.CreatePrimInLayer(layer, hidden)
        over.active = False
