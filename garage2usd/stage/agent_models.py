"""Models that the agents of tracks refer to: cars whose wheels turn, people with skeletons, and plain bodies."""

from collections.abc import Mapping, Sequence

from pxr import Sdf

from garage2usd.assets import Asset
from garage2usd.assets.faces import box_faces
from garage2usd.assets.mesh import make_part
from garage2usd.common.errors import ConfigError
from garage2usd.config.vehicles import CAR_BODIES, PAINTS, CarBody
from garage2usd.driving.tracks import Agent, AgentClass
from garage2usd.objects import trolley
from garage2usd.objects.car import car_spec
from garage2usd.stage.authoring import define, operation, order_operations
from garage2usd.stage.moving_car import define_car, define_looks, define_parts
from garage2usd.stage.prototypes import asset_of
from garage2usd.stage.track_people import figure_of
from garage2usd.stage.walkers import define_figure

CARS = (AgentClass.CAR, AgentClass.VAN, AgentClass.TRUCK)
_TYPES = Sdf.ValueTypeNames
_CATALOGUE = {body.name: body for body in CAR_BODIES}
_OBJECTS = {trolley.KIND.label: trolley.TrolleySpec()}
"""Objects by the classes of agents that are neither cars nor people."""


class AgentModels:
    """Models below a scope of a layer, each defined where the first agent needs it.

    Parameters
    ----------
    layer, scope
        The layer, and the path of the scope.
    cars
        Cars by the names of their bodies besides those of the catalogue: models of the user.

    Attributes
    ----------
    assets
        Meshes and materials of the models but people, for their textures.
    """

    def __init__(self, layer: Sdf.Layer, scope: Sdf.Path, cars: Mapping[str, CarBody] | None = None) -> None:
        self._layer, self._scope = layer, scope
        self._bodies = _CATALOGUE | dict(cars or {})
        self._paths: dict[str, Sdf.Path] = {}
        self.assets: list[Asset] = []

    def body_of(self, agent: Agent) -> CarBody:
        """Return the body of a car, as `body_of` does, among those of the user too."""
        return body_of(agent, self._bodies)

    def of(self, agent: Agent) -> Sdf.Path:
        """Return the path of an agent's model.

        The origin of a car is the middle of its rear axle on the floor, with the nose to -Z; people face +Z.

        Raises
        ------
        ConfigError
            If the body or paint of a car is unknown.
        """
        if agent.kind is AgentClass.PERSON:
            name, figure, _ = figure_of(agent)
            if name not in self._paths:
                self._paths[name] = define_figure(self._layer, self._scope.AppendChild(name), figure).path
            return self._paths[name]
        if agent.kind not in CARS:
            return self.plain(agent)
        body = self.body_of(agent)
        key = "_".join(("Car", *filter(None, (body.name, agent.paint))))
        if key not in self._paths:
            asset = asset_of(car_spec(body, agent.paint))
            path = self._new(key, asset)
            define_car(self._layer, path, body, asset, paint=agent.paint, turned=_unturned)
        return self._paths[key]

    def plain(self, agent: Agent) -> Sdf.Path:
        """Return the path of a model that needs no body: the object of the agent's kind, or a block of its size."""
        spec = _OBJECTS.get(agent.kind.value)
        size = agent.width_m, agent.height_m, agent.length_m
        key = agent.kind.value.capitalize() if spec else "Block_" + "_".join(f"{1000 * part:.0f}" for part in size)
        if key not in self._paths:
            half, height, ahead = size[0] / 2, size[1], size[2] / 2
            block = box_faces((-half, 0.0, -ahead), (half, height, ahead))
            asset = asset_of(spec) if spec else Asset((make_part("Block", block, "rubber_black"),))
            path = self._new(key, asset)
            shape = define(self._layer, path.AppendChild("Body"), "Xform")
            if spec:  # objects look to +Z, agents to -Z
                operation(shape, "rotateY", _TYPES.Float, 180.0)
                order_operations(shape, ["rotateY"])
            looks = define_looks(self._layer, path, asset)
            define_parts(self._layer, shape.path, asset.parts, asset, looks)
        return self._paths[key]

    def _new(self, key: str, asset: Asset) -> Sdf.Path:
        """Define the root of a model."""
        self.assets.append(asset)
        self._paths[key] = define(self._layer, self._scope.AppendChild(prim_name(key)), "Xform").path
        return self._paths[key]


def body_of(agent: Agent, bodies: Mapping[str, CarBody] = _CATALOGUE) -> CarBody:
    """Return the body of a car among some by their names.

    Raises
    ------
    ConfigError
        If there is no such body, or a body of the catalogue has no such paint.
    """
    body = bodies.get(agent.body)
    if body is None:
        raise ConfigError(f"tracks.{agent.name}.body", agent.body, f"one of {', '.join(bodies)}")
    if agent.paint not in PAINTS and body in CAR_BODIES:
        raise ConfigError(f"tracks.{agent.name}.paint", agent.paint, f"one of {', '.join(PAINTS)}")
    return body


def prim_name(name: str) -> str:
    """Make a name of a prim of any name."""
    fit = "".join(letter if letter.isascii() and (letter.isalnum() or letter == "_") else "_" for letter in name)
    return fit if fit[:1].isalpha() else f"Agent_{fit}"


def _unturned(wheel: Sdf.PrimSpec, is_front: bool) -> Sequence[str]:  # noqa: FBT001 - a callback of two
    names = ["rotateY", "rotateX"] if is_front else ["rotateX"]
    for name in names:
        operation(wheel, name, _TYPES.Float, 0.0)
    return names
