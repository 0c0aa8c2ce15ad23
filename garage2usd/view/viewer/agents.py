"""Agents of tracks prepared for the viewer: their bodies as shapes, wheels that turn, and skins that follow joints."""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field, replace

import numpy as np
from numpy.typing import NDArray
from pxr import Kind, Sdf, Usd, UsdGeom

from garage2usd.assets.figures import Figure, skinned_figure
from garage2usd.assets.mesh import WELD_DECIMALS
from garage2usd.assets.skeletons import strongest
from garage2usd.common.errors import ConfigError
from garage2usd.driving.tracks import Agent, AgentClass, Track, Tracks, knots
from garage2usd.stage.agent_models import CARS, AgentModels
from garage2usd.stage.authoring import set_units
from garage2usd.stage.cameras import FRAMES_PER_SECOND
from garage2usd.stage.track_people import Gait, figure_of, gait_of
from garage2usd.view.viewer.reading import Looks
from garage2usd.view.viewer.scene import Placed, Shape

_ROOT = Sdf.Path("/ModelsOfAgents")
_NEAR_RAD = 3e-4


@dataclass(frozen=True, eq=False)
class ShownSkin:
    """The skin of a shape: for each vertex its four strongest joints and their weights, and the joints at rest.

    Attributes
    ----------
    joints, weights
        uint8, and weights in 255ths as uint8; shape (vertices, 4).
    rest_m
        float64, shape (joints, 3).
    """

    joints: NDArray[np.uint8]
    weights: NDArray[np.uint8]
    rest_m: NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class ShownAgent:
    """An agent with its body.

    Attributes
    ----------
    track
        Its track; the heading is that of the body.
    parts
        Body and wheels, in the axes of the agent with the origin in the middle of the footprint.
    rolled_rad
        Turn of the wheels at the samples, forwards positive; float64, shape (n,).
    gait
        The motion of a person.
    """

    track: Track
    parts: tuple[Placed, ...]
    rolled_rad: NDArray[np.float64]
    gait: Gait | None = None


@dataclass(frozen=True, eq=False)
class ShownTraffic:
    """Tracks to play.

    Attributes
    ----------
    step_s, duration_s
        Step of the time line and its end.
    agents
        The agents.
    skins
        Skins by the numbers of their shapes.
    """

    step_s: float
    duration_s: float
    agents: tuple[ShownAgent, ...]
    skins: Mapping[int, ShownSkin] = field(default_factory=dict)


def read_agents(tracks: Tracks, looks: Looks) -> ShownTraffic:
    """Make the bodies of agents as a layer of traffic has them, and number their shapes with those of a stage.

    A car whose body or paint is unknown is a block of its size.
    """
    layer = Sdf.Layer.CreateAnonymous(".usda")
    set_units(layer)
    Sdf.CreatePrimInLayer(layer, _ROOT).specifier = Sdf.SpecifierDef
    models, is_known, paths = AgentModels(layer, _ROOT), {}, []
    for track in tracks:
        try:
            paths.append(models.of(track.agent))
            is_known[track.agent.name] = track.agent.kind in CARS
        except ConfigError:
            paths.append(models.plain(track.agent))
    for path in {*paths}:
        for child in [] if layer.GetPrimAtPath(path).kind else layer.GetPrimAtPath(path).nameChildren:
            child.kind = Kind.Tokens.component
    parts: dict[Sdf.Path, list[Placed]] = {}
    stage = Usd.Stage.Open(layer)
    UsdGeom.SetStageUpAxis(stage, UsdGeom.Tokens.y)
    for placed in looks.objects(stage, np.eye(4)):
        path = Sdf.Path(placed.path)
        parts.setdefault(path if path in paths else path.GetParentPath(), []).append(placed)
    agents, skins = [], {}
    for track, path in zip(tracks, paths, strict=True):
        agent = track.agent
        if agent.kind is AgentClass.PERSON:
            agents.append(_walker(track, parts[path]))
            for placed in parts[path]:
                if placed.shape not in skins:
                    skins[placed.shape] = _skin(figure_of(agent)[1], looks.shapes.values[placed.shape])
        else:
            body = models.body_of(agent) if is_known.get(agent.name) else None
            rolled = track.rolled_m(body.rear_axle_m) / body.wheel_radius_m if body else np.zeros(len(track))
            back_m = body.rear_axle_m if body else 0.0
            agents.append(ShownAgent(track, tuple(_placed(agent, parts[path], back_m)), rolled))
    return ShownTraffic(tracks.step_s, tracks.duration_s, tuple(agents), skins)


def _placed(agent: Agent, parts: list[Placed], back_m: float) -> Iterator[Placed]:
    """Yield parts of a model around the middle of the footprint, with the label and a name of the agent's."""
    for part in parts:
        matrix = part.matrix.copy()
        matrix[3, 2] += back_m
        name = part.path.rpartition("/")[2]
        yield replace(part, path=f"{agent.name}/{name}", label=agent.kind.value, matrix=matrix)


def _walker(track: Track, parts: list[Placed]) -> ShownAgent:
    """Give a person a gait, and samples that are close enough for the heading of its figure."""
    gait, agent = gait_of(track), track.agent
    bends = gait.frames[knots(gait.frames, gait.yaw_rad, _NEAR_RAD)] / FRAMES_PER_SECOND
    dense = track.sampled(np.union1d(track.time_s, np.round(bends, 6)))
    turned = replace(dense, yaw_rad=np.interp(dense.time_s * FRAMES_PER_SECOND, gait.frames, gait.yaw_rad))
    return ShownAgent(turned, tuple(_placed(agent, parts, 0.0)), np.zeros(len(turned)), gait)


def _skin(figure: Figure, shape: Shape) -> ShownSkin:
    """Find the skin of a shape's vertices by their places in the figure."""
    skin = skinned_figure(figure)
    places = np.round(np.concatenate([part.points for part in skin.parts]), WELD_DECIMALS)
    number_of = {bytes(place): number for number, place in enumerate((places + 0.0).astype(np.float32))}
    vertices = np.round(np.concatenate([piece.mesh.positions_m for piece in shape.pieces]), WELD_DECIMALS) + 0.0
    own = [number_of[bytes(place)] for place in vertices.astype(np.float32)]
    joints, weights = strongest(np.concatenate(skin.weights)[own])
    shares = np.round(255 * weights).astype(np.int64)
    shares[:, 0] += 255 - shares.sum(axis=1)
    return ShownSkin(joints.astype(np.uint8), shares.astype(np.uint8), skin.skeleton.rest_m)
