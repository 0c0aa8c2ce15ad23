"""Bring a garage to life in CARLA: parked cars as actors, and the traffic of ``garage2usd traffic``.

    garage2usd traffic garage.usdz -o run.csv        # where garage2usd is installed
    python play_in_carla.py                          # parked cars
    python play_in_carla.py --tracks run.csv         # parked cars and traffic
    python play_in_carla.py --clear                  # removes all of them

It needs CARLA's Python module and a server; garage.json lies beside it.
"""

import argparse
import csv
import json
import math
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from itertools import groupby
from pathlib import Path
from typing import Any, NamedTuple

import carla

_ROLE = "garage2usd"
_WHEELS = 4
_FAR_M = 500.0
"""Height at which a vehicle of each kind is spawned for its size."""
_ABOVE_M = 0.5
"""Height over its place at which an actor is spawned, as CARLA spawns none that touches the floor."""
_TROLLEY = "static.prop.shoppingcart"
Values = dict[str, Any]


def main(arguments: list[str] | None = None) -> None:
    """Place parked cars, and play the tracks named on the command line."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--host", default="localhost")
    parser.add_argument("--port", type=int, default=2000)
    parser.add_argument("--garage", type=Path, default=Path(__file__).with_name("garage.json"), metavar="FILE")
    parser.add_argument("--tracks", type=Path, metavar="FILE", help="a table .csv of tracks, with its .json beside it")
    parser.add_argument("--free", nargs="*", default=[], metavar="STALL", help="stalls without their parked cars")
    parser.add_argument("--no-parked", action="store_true", help="place no parked cars")
    parser.add_argument("--here", action="store_true", help="play in the map that is loaded, whatever its name")
    parser.add_argument("--clear", action="store_true", help="remove what an earlier run has placed, and end")
    given = parser.parse_args(arguments)
    garage = json.loads(given.garage.read_text(encoding="utf-8"))
    client = carla.Client(given.host, given.port)
    client.set_timeout(120.0)
    world = client.get_world()
    if not given.here and world.get_map().name.rpartition("/")[2] != garage["map"]:
        world = client.load_world(garage["map"])
    for actor in world.get_actors():
        if actor.attributes.get("role_name") == _ROLE:
            actor.destroy()
    if given.clear:
        return
    tracks = read_tracks(given.tracks) if given.tracks else Tracks({}, {}, 0.05, 0.0)
    fleet = Fleet(world)
    if not given.no_parked:
        leave = {agent["prim"] for agent in tracks.agents.values()}
        cars = [car for car in garage["parked_cars"] if {car["stall"], car["number"]}.isdisjoint(given.free)]
        park(world, fleet, cars, leave)
    if tracks.agents:
        play(client, world, fleet, tracks)


class Tracks(NamedTuple):
    """The agents of a table and their samples by name, the step of the samples, and the end."""

    agents: dict[str, Values]
    samples: dict[str, list[tuple[float, ...]]]
    step_s: float
    duration_s: float

    def at(self, name: str, time_s: float) -> tuple[float, ...] | None:
        """Return (x, y, z, yaw, pitch) of the stage at a time; None where the agent is not in the garage."""
        samples = self.samples[name]
        if not samples or not samples[0][0] <= time_s <= samples[-1][0]:
            return None
        low, high = 0, len(samples) - 1
        while high - low > 1:
            middle = (low + high) // 2
            low, high = (middle, high) if samples[middle][0] <= time_s else (low, middle)
        before, after = samples[low], samples[high]
        # between samples further apart than a step an agent stands still
        begin_s = max(before[0], after[0] - self.step_s)
        share = min(max((time_s - begin_s) / max(after[0] - begin_s, 1e-9), 0.0), 1.0)
        return tuple(a + (b - a) * share for a, b in zip(before[1:], after[1:], strict=True))


def read_tracks(path: Path) -> Tracks:
    """Read a table of tracks and the agents beside it."""
    heading = json.loads(path.with_suffix(".json").read_text(encoding="utf-8"))
    names = "time_s", "x_m", "y_m", "z_m", "yaw_rad", "pitch_rad"
    with path.open(encoding="utf-8", newline="") as file:
        rows = groupby(csv.DictReader(file), key=lambda row: row["agent"])
        samples = {agent: [tuple(float(row[name]) for name in names) for row in own] for agent, own in rows}
    agents = {agent["name"]: agent for agent in heading["agents"]}
    return Tracks(agents, {name: samples.get(name, []) for name in agents}, heading["step_s"], heading["duration_s"])


class Fleet:
    """Blueprints of CARLA, chosen by the size of what they stand for."""

    def __init__(self, world: "carla.World") -> None:
        self._world, self._library = world, world.get_blueprint_library()
        self._boxes: dict[str, Any] = {}

    def blueprint(self, agent: Mapping[str, Any]) -> "carla.ActorBlueprint":
        """Return the blueprint of a person or trolley, or the vehicle whose size is nearest."""
        kind = agent.get("kind", "car")
        if kind == "person":
            people = sorted(self._library.filter("walker.pedestrian.*"), key=lambda each: str(each.id))
            chosen = people[sum(map(ord, agent["name"])) % len(people)]
        elif kind == "shopping_trolley":
            chosen = self._library.find(_TROLLEY)
        else:
            chosen = self._library.find(self._nearest(agent))
        if chosen.has_attribute("role_name"):
            chosen.set_attribute("role_name", _ROLE)
        return chosen

    def _nearest(self, agent: Mapping[str, Any]) -> str:
        size_m = agent["length_m"], agent["width_m"], agent["height_m"]
        boxes = self._measured()
        if not boxes:
            raise SystemExit("the server has no blueprints of cars")

        def distance_m(name: str) -> float:
            extent = boxes[name].extent
            own_m = 2 * extent.x, 2 * extent.y, 2 * extent.z
            return float(sum(abs(own - side) for own, side in zip(own_m, size_m, strict=True)))

        return min(sorted(boxes), key=distance_m)

    def _measured(self) -> dict[str, Any]:
        """Spawn a vehicle of each blueprint once, high above the map, to learn its bounding box."""
        for blueprint in [] if self._boxes else self._library.filter("vehicle.*"):
            wheels = (
                blueprint.get_attribute("number_of_wheels") if blueprint.has_attribute("number_of_wheels") else None
            )
            if wheels is not None and int(wheels) != _WHEELS:
                continue
            actor = self._world.try_spawn_actor(blueprint, carla.Transform(carla.Location(0.0, 0.0, _FAR_M)))
            if actor is not None:
                self._boxes[blueprint.id] = actor.bounding_box
                actor.destroy()
        return self._boxes


def standing(actor: "carla.Actor", place: Mapping[str, float]) -> "carla.Transform":
    """Return the transform that puts the middle of an actor's box over a place, and its feet or wheels on it."""
    yaw, offset = math.radians(place["yaw_deg"]), actor.bounding_box.location
    x = place["x"] - offset.x * math.cos(yaw) + offset.y * math.sin(yaw)
    y = place["y"] - offset.x * math.sin(yaw) - offset.y * math.cos(yaw)
    # the origin of a walker is the middle of its body
    z = place["z"] + (actor.bounding_box.extent.z if actor.type_id.startswith("walker.") else 0.0)
    return carla.Transform(carla.Location(x, y, z), carla.Rotation(pitch=place["pitch_deg"], yaw=place["yaw_deg"]))


def spawned(world: "carla.World", fleet: Fleet, agent: Mapping[str, Any], place: Mapping[str, float]) -> Any:  # noqa: ANN401
    """Spawn an actor without physics at a place; None where CARLA refuses it."""
    over = carla.Location(place["x"], place["y"], place["z"] + _ABOVE_M)
    if agent.get("kind") == "person":
        over.z += agent["height_m"] / 2
    turned = carla.Rotation(pitch=place["pitch_deg"], yaw=place["yaw_deg"])
    actor = world.try_spawn_actor(fleet.blueprint(agent), carla.Transform(over, turned))
    if actor is not None:
        actor.set_simulate_physics(False)
        actor.set_transform(standing(actor, place))
    return actor


def park(world: "carla.World", fleet: Fleet, cars: list[Values], leave: set[str]) -> None:
    """Place parked cars, except those that drive in the tracks."""
    count = 0
    for car in cars:
        if car["prim"] in leave:
            continue
        if spawned(world, fleet, car, car) is None:
            print(f"CARLA spawns no car in stall {car['stall'] or car['name']}")  # noqa: T201
        else:
            count += 1
    print(f"{count} parked cars")  # noqa: T201


def play(client: "carla.Client", world: "carla.World", fleet: Fleet, tracks: Tracks) -> None:
    """Move an actor along each track, one step of the simulation after another."""
    actors: dict[str, Any] = {}
    with stepped(world, tracks.step_s):
        try:
            for step in range(math.floor(tracks.duration_s / tracks.step_s) + 1):
                commands = []
                for name, agent in tracks.agents.items():
                    sample = tracks.at(name, step * tracks.step_s)
                    if sample is None:
                        if name in actors:
                            actors.pop(name).destroy()
                        continue
                    place = in_carla(sample)
                    if name not in actors:
                        actor = spawned(world, fleet, agent, place)
                        if actor is None:
                            continue  # the next step tries again
                        actors[name] = actor
                    commands.append(carla.command.ApplyTransform(actors[name].id, standing(actors[name], place)))
                client.apply_batch_sync(commands, False)
                world.tick()
        finally:
            for actor in actors.values():
                actor.destroy()


def in_carla(sample: tuple[float, ...]) -> dict[str, float]:
    """Convert (x, y, z, yaw, pitch) of the stage, Y up and yaw 0 towards -Z, to CARLA's frame."""
    x, y, z, yaw, pitch = sample
    return {"x": x, "y": z, "z": y, "yaw_deg": -90.0 - math.degrees(yaw), "pitch_deg": math.degrees(pitch)}


@contextmanager
def stepped(world: "carla.World", step_s: float) -> Iterator[None]:
    """Let the simulation wait for `world.tick`, and go on by itself afterwards."""
    before, settings = world.get_settings(), world.get_settings()
    settings.synchronous_mode, settings.fixed_delta_seconds = True, step_s
    world.apply_settings(settings)
    try:
        yield
    finally:
        world.apply_settings(before)


if __name__ == "__main__":
    main()
