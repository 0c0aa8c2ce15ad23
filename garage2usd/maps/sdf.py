"""Worlds for Gazebo: SDF 1.9 with GLB visuals, simple collisions, lights and frames, and a launch file of ROS 2."""

import math
import xml.etree.ElementTree as ET
from collections.abc import Iterator, Sequence
from pathlib import Path

import numpy as np
from scipy.spatial.transform import Rotation

from garage2usd.as_built import BuiltGarage
from garage2usd.common.errors import StageError
from garage2usd.garage.levels import GARAGE_NAME
from garage2usd.maps.facts import stage_facts
from garage2usd.maps.frame import heading_rad, map_point
from garage2usd.maps.gazebo_launch import launch_text
from garage2usd.maps.placed_lights import placed_lights
from garage2usd.maps.sdf_collisions import Collision, Collisions
from garage2usd.maps.sdf_files import VISUALS, mesh_file, sdf_files
from garage2usd.maps.sdf_lights import add_light
from garage2usd.maps.sdf_models import Model, Visual, Visuals, models_of
from garage2usd.maps.sdf_text import add_pose, add_text, numbers_text, sdf_name
from garage2usd.maps.xml_text import child, number_text, write_xml
from garage2usd.reading.levels import levels_of
from garage2usd.scenes.prims import Matrix, PlacedObject
from garage2usd.scenes.remarks import Remarks

WORLD = "garage"
"""Name of the world, in Gazebo's topics and services."""
_AMBIENT = 0.12
"""Ambient light, as a share of white, in place of the light that walls and floors reflect."""
_PLUGINS = {
    "gz-sim-physics-system": "gz::sim::systems::Physics",
    "gz-sim-user-commands-system": "gz::sim::systems::UserCommands",
    "gz-sim-scene-broadcaster-system": "gz::sim::systems::SceneBroadcaster",
    "gz-sim-contact-system": "gz::sim::systems::Contact",
    "gz-sim-imu-system": "gz::sim::systems::Imu",
}


def write_sdf(
    garage: BuiltGarage,
    path: Path,
    *,
    objects: Sequence[PlacedObject],
    maps: Sequence[str],
    remarks: Remarks,
    joint: str = "_",
) -> None:
    """Write a garage as a world for Gazebo, with its meshes and a launch file of ROS 2 beside it.

    Parameters
    ----------
    garage
        The garage, read from a stage.
    path
        The world, in an existing folder; `sdf_files` names the files that accompany it.
    objects
        Objects of the stage from `garage2usd.scenes.walk.placed_objects`, in metres with Y up.
    maps
        Names of the occupancy grids beside the world, one for each level.
    remarks
        Receives remarks on features that SDF or glTF lack.
    joint
        Separator between the stem and the name of the folder.

    Raises
    ------
    StageError
        If the stage has nothing to draw.

    Notes
    -----
    The frame is that of all maps (`garage2usd.maps.frame`), so the occupancy grids fit. Each level is a static model,
    and so is each parked car. Paths of prims name collisions and lights. The visual of a level has one mesh per
    material; cars of equal look share theirs. Collisions are those of `garage2usd.maps.sdf_collisions`. Frames mark
    each entrance, in the direction of driving, and the middle of each stall, in the direction of its mouth.
    """
    if garage.stage is None:
        raise StageError(garage.source, "a world is made of a stage")
    _, launch, folder = sdf_files(path, joint=joint)
    folder.mkdir()
    models = list(models_of(levels_of(garage.stage), objects))
    visuals, collisions, root = Visuals(remarks), Collisions(), ET.Element("sdf", version="1.9")
    world = child(root, "world", name=WORLD)
    _add_systems(world)
    uri = f"{folder.name}/"
    for model in models:
        _add_model(world, model, visuals, collisions, uri)
    if not visuals.count:
        raise StageError(garage.source, "nothing in it can be drawn")
    for name, light in placed_lights(garage.stage, objects, remarks):
        add_light(world, name, light)
    frames = dict(_frames(garage))
    for name, place in frames.items():
        add_pose(child(world, "frame", name=name), place)
    facts = {name: str(value) for name, value in stage_facts(garage.stage).items()}
    (folder / VISUALS).write_bytes(visuals.glb.data(facts))
    collisions.write(folder)
    write_xml(root, path)
    spawns = {name: _spawn(place) for name, place in frames.items()}
    levels = dict(zip([level.place.name or GARAGE_NAME for level in garage.levels], maps, strict=True))
    launch.write_text(launch_text(path.name, WORLD, levels, spawns), encoding="utf-8", newline="\n")


def _add_model(world: ET.Element, model: Model, visuals: Visuals, collisions: Collisions, uri: str) -> None:
    element = child(world, "model", name=model.name)
    add_text(element, "static", "true")
    add_pose(element, model.place)
    link = child(element, "link", name="link")
    for number, visual in enumerate(visuals.of(model), 1):
        _add_visual(link, f"visual_{number}", visual, uri)
    to_model = np.linalg.inv(model.place)
    for collision in collisions.of(model.objects):
        _add_collision(link, collision, to_model @ collision.place, uri)


def _add_systems(world: ET.Element) -> None:
    physics = child(world, "physics", name="fast", type="ignored")
    add_text(physics, "max_step_size", 0.004)
    add_text(physics, "real_time_factor", 1.0)
    for file, name in _PLUGINS.items():
        child(world, "plugin", filename=file, name=name)
    sensors = child(world, "plugin", filename="gz-sim-sensors-system", name="gz::sim::systems::Sensors")
    add_text(sensors, "render_engine", "ogre2")
    add_text(world, "gravity", "0 0 -9.81")
    scene = child(world, "scene")
    add_text(scene, "ambient", " ".join([number_text(_AMBIENT)] * 3) + " 1")
    add_text(scene, "background", "0.02 0.02 0.02 1")
    add_text(scene, "shadows", "false")
    add_text(scene, "grid", "false")


def _add_visual(link: ET.Element, name: str, visual: Visual, uri: str) -> None:
    element = child(link, "visual", name=name)
    add_text(element, "cast_shadows", "false")
    scale = np.linalg.norm(visual.place[:3, :3], axis=0)
    place = visual.place.copy()
    if np.linalg.det(place[:3, :3]) < 0:
        scale[0] *= -1
    place[:3, :3] /= scale
    add_pose(element, place)
    mesh = child(child(element, "geometry"), "mesh")
    add_text(mesh, "uri", f"{uri}{VISUALS}")
    submesh = child(mesh, "submesh")
    add_text(submesh, "name", visual.node)
    add_text(submesh, "center", "false")
    if not np.allclose(scale, 1.0):
        add_text(mesh, "scale", numbers_text(scale))


def _add_collision(link: ET.Element, collision: Collision, place: Matrix, uri: str) -> None:
    element = child(link, "collision", name=sdf_name(collision.name))
    add_pose(element, place)
    shape = collision.shape
    geometry = child(child(element, "geometry"), shape.kind)
    if shape.kind == "box":
        add_text(geometry, "size", numbers_text(shape.sizes_m))
    elif shape.kind == "cylinder":
        add_text(geometry, "radius", shape.sizes_m[0])
        add_text(geometry, "length", shape.sizes_m[1])
    else:
        add_text(geometry, "uri", f"{uri}{mesh_file(shape.mesh)}")


def _frames(garage: BuiltGarage) -> Iterator[tuple[str, Matrix]]:
    """Yield the names and places of frames at entrances and stalls, x forward and z up."""
    lanes = garage.lanes
    for number, entrance in enumerate(lanes.portals("entrance"), 1):
        node = lanes.nodes[entrance]
        ways = [lanes.nodes[end].position for start, end in _arcs(garage) if start == entrance]
        x, z = node.position
        ahead = (ways[0][0] - x, ways[0][1] - z) if ways else (1.0, 0.0)
        yield f"entrance_{number}", _upright(node.position, node.height_m, ahead)
    for stall in garage.stalls:
        floor_m = garage.levels[stall.level].place.floor_m
        yield f"stall_{stall.name.replace('::', ':')}", _upright(stall.centre, floor_m, stall.outwards)


def _arcs(garage: BuiltGarage) -> Iterator[tuple[int, int]]:
    return (arc for edge in garage.lanes.edges for arc in edge.arcs)


def _upright(ground: tuple[float, float], height_m: float, ahead: tuple[float, float]) -> Matrix:
    """Return the place of a frame at a ground point (x, z) of the stage, whose x leads along a vector (x, z)."""
    heading = heading_rad(math.atan2(-ahead[0], -ahead[1]))
    place = np.eye(4)
    place[:3, :3] = Rotation.from_euler("z", heading).as_matrix()
    place[:3, 3] = *map_point(ground), height_m
    return place


def _spawn(place: Matrix) -> tuple[float, ...]:
    """Return x, y, z and yaw of a frame."""
    yaw = math.atan2(place[1, 0], place[0, 0])
    return tuple(round(float(value), 4) + 0.0 for value in (*place[:3, 3], yaw))
