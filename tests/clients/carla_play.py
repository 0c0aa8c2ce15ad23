"""Runs in an environment with CARLA's wheel: plays a garage in a world that is not there, and tells where actors stand.

Places, boxes and commands are those of CARLA's module; the world keeps the transforms that it is given.
"""

import importlib.util
import itertools
import json
import sys
import types
from pathlib import Path

import carla

SIZES = {"vehicle.a.small": (3.6, 1.6, 1.5), "vehicle.a.middle": (4.6, 1.9, 1.5), "vehicle.a.long": (5.4, 2.0, 2.0)}
OFFSET = carla.Location(0.11, -0.02, 0.75)
numbers = itertools.count(1)


class Blueprint:
    def __init__(self, name, values):
        self.id, self.values = name, values

    def has_attribute(self, name):
        return name in self.values

    def get_attribute(self, name):
        return self.values[name]

    def set_attribute(self, name, value):
        self.values[name] = value


class Library(list):
    def filter(self, pattern):
        return [own for own in self if own.id.startswith(pattern.rstrip("*"))]

    def find(self, name):
        return next(own for own in self if own.id == name)


class Actor:
    def __init__(self, world, blueprint, transform):
        self.id, self.type_id, self.transform, self.world = next(numbers), blueprint.id, transform, world
        self.attributes = {"role_name": blueprint.values.get("role_name", "")}
        size = SIZES.get(blueprint.id, (0.5, 0.5, 1.8))
        offset = OFFSET if blueprint.id in SIZES else carla.Location()
        self.bounding_box = carla.BoundingBox(offset, carla.Vector3D(*(side / 2 for side in size)))
        self.physics = True

    def set_simulate_physics(self, on):
        self.physics = on

    def set_transform(self, transform):
        self.transform = transform

    def destroy(self):
        self.world.actors.remove(self)


class World:
    def __init__(self):
        self.actors, self.ticks, self.frames, self.settings = [], 0, [], types.SimpleNamespace(synchronous_mode=False)
        self.library = Library(
            [
                *(Blueprint(name, {"number_of_wheels": "4", "role_name": ""}) for name in SIZES),
                Blueprint("vehicle.a.bike", {"number_of_wheels": "2", "role_name": ""}),
                Blueprint("walker.pedestrian.0001", {"role_name": ""}),
                Blueprint("static.prop.shoppingcart", {"role_name": ""}),
            ]
        )

    def get_blueprint_library(self):
        return self.library

    def get_map(self):
        return types.SimpleNamespace(name="Carla/Maps/Elsewhere")

    def get_actors(self):
        return list(self.actors)

    def try_spawn_actor(self, blueprint, transform):
        assert blueprint.id != "vehicle.a.bike"
        self.actors.append(Actor(self, blueprint, transform))
        return self.actors[-1]

    def get_settings(self):
        return types.SimpleNamespace(**vars(self.settings))

    def apply_settings(self, settings):
        self.settings = settings

    def tick(self):
        assert self.settings.synchronous_mode
        self.frames.append([placed(actor) for actor in self.actors])


def placed(actor):
    assert not actor.physics
    offset = actor.bounding_box.location
    middle = actor.transform.transform(carla.Location(offset.x, offset.y, 0.0))  # below the body, on the floor
    turn = actor.transform.rotation
    feet = actor.transform.location.z - (actor.bounding_box.extent.z if actor.type_id.startswith("walker") else 0)
    return [actor.type_id, middle.x, middle.y, feet, turn.yaw, turn.pitch]


def main(program, target, *arguments):
    world, loaded = World(), []
    client = types.SimpleNamespace(
        set_timeout=lambda _: None,
        get_world=World,
        load_world=lambda name: loaded.append(name) or world,
        apply_batch_sync=lambda commands, _: [
            next(actor for actor in world.actors if actor.id == each.actor_id).set_transform(each.transform)
            for each in commands
        ],
    )
    carla.Client = lambda *_: client
    spec = importlib.util.spec_from_file_location("program", program)
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    module.main(list(arguments))
    left = [placed(actor) for actor in world.actors]
    roles = sorted({actor.attributes["role_name"] for actor in world.actors})
    module.main(["--clear"])
    said = {"loaded": loaded, "left": left, "frames": world.frames, "roles": roles, "cleared": len(world.actors)}
    said["is_synchronous"] = world.settings.synchronous_mode
    Path(target).write_text(json.dumps(said))


main(*sys.argv[1:])
