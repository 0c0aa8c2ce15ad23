"""Boxes of objects: oriented bounding boxes, the share of an object in sight, and nuScenes' annotations."""

from collections import defaultdict
from collections.abc import Callable, Collection, Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from pxr import Usd

from garage2usd.common.randomness import Step, generator
from garage2usd.driving.tracks import AgentState
from garage2usd.reading.labels import Labels
from garage2usd.scenes.values import up_axis
from garage2usd.sensors.formats.nuscenes_scenes import GlobalFrame, Stretch
from garage2usd.sensors.formats.nuscenes_tables import BOXED, Record, Tables, place_fields, token_of
from garage2usd.sensors.rays.moved_scene import MovedScene
from garage2usd.sensors.rays.point_cloud import PointCloud
from garage2usd.sensors.rays.ray_scene import RayScene

_SIGHT_RAYS = 256
PARKED = "vehicle.parked"
"""nuScenes attribute of parked cars."""
ATTRIBUTES = {
    AgentState.DRIVES: "vehicle.moving",
    AgentState.WAITS: "vehicle.stopped",
    AgentState.MANOEUVRES: "vehicle.moving",
    AgentState.PARKED: PARKED,
    AgentState.WALKS: "pedestrian.moving",
    AgentState.STANDS: "pedestrian.standing",
}
"""nuScenes attributes of agents of tracks."""
VISIBILITY = (("1", "v0-40", 0.0), ("2", "v40-60", 0.4), ("3", "v60-80", 0.6), ("4", "v80-100", 0.8))
"""Token, level and least share in sight of each nuScenes visibility."""
_BOX_MARGIN_M = 0.01


@dataclass(frozen=True, eq=False)
class ObjectBox:
    """An oriented bounding box of an object.

    Attributes
    ----------
    id, class_id
        Ids of the object and its class, as in the table of labels.
    centre_m
        Centre in the stage's axes; float64, shape (3,).
    axes
        Columns: the object's forward, left and up in the stage's axes; float64, shape (3, 3).
    size_m
        Extent along `axes`; float64, shape (3,).
    surface_m
        Points sampled evenly on the object's surface; float64, shape (n, 3).
    margin_m
        Margin of the annotated box on each side.
    attribute
        nuScenes attribute; empty for none.
    velocity_m_s
        Velocity in the stage's axes of what moves by tracks; float64, shape (3,).
    """

    id: int
    class_id: int
    centre_m: NDArray[np.float64]
    axes: NDArray[np.float64]
    size_m: NDArray[np.float64]
    surface_m: NDArray[np.float64]
    margin_m: float = _BOX_MARGIN_M
    attribute: str = ""
    velocity_m_s: NDArray[np.float64] | None = None


TrafficAt = Callable[[int], tuple[MovedScene, list[ObjectBox]]]
"""Function that returns the surfaces at a pose of a recording in traffic, and the boxes of agents there."""


def object_boxes(
    stage: Usd.Stage, scene: RayScene, class_ids: Collection[int], *, parked_ids: Collection[int] = ()
) -> list[ObjectBox]:
    """Compute the oriented bounding boxes of all objects of some classes, ordered by object id.

    Parameters
    ----------
    stage
        The stage.
    scene
        Solid surfaces of the stage.
    class_ids
        Ids of the classes.
    parked_ids
        Ids of the classes of cars, which are parked.

    Notes
    -----
    Objects look to -Z of their own axes where their Y is up, as those of garage2usd do, and to Y where their Z is up.
    """
    up = up_axis(stage)
    wanted = np.isin(scene.class_id, list(class_ids))
    numbers = np.flatnonzero(wanted & (scene.instance > 0))
    order = numbers[np.argsort(scene.instance[numbers], kind="stable")]
    ids, first = np.unique(scene.instance[order], return_index=True)
    boxes = []
    for instance, own in zip(ids.tolist(), np.split(order, first)[1:], strict=True):
        matrix = scene.placed[instance].matrix[:3, :3]
        is_y_up = abs(matrix[1, up]) >= abs(matrix[2, up])
        axes = _axes(-matrix[2], matrix[1]) if is_y_up else _axes(matrix[1], matrix[2])
        corners = scene.vertices_m[scene.triangles[own]]
        turned = corners.reshape(-1, 3) @ axes
        low, high = turned.min(axis=0), turned.max(axis=0)
        boxes.append(
            ObjectBox(
                instance,
                int(scene.class_id[own[0]]),
                axes @ (low + high) / 2,
                axes,
                high - low,
                spread_points(corners, instance),
                attribute=PARKED if int(scene.class_id[own[0]]) in parked_ids else "",
            )
        )
    return boxes


def share_in_sight(scene: RayScene | MovedScene, box: ObjectBox, eyes_m: NDArray[np.float64]) -> float:
    """Estimate the share of an object in line of sight, from the sensor position that sees most of it.

    Parameters
    ----------
    scene
        Surfaces that may hide the object.
    box
        The object.
    eyes_m
        Sensor positions in the stage's axes; shape (n, 3).

    Returns
    -------
    float
        Share of the rays to points of the object's surface, the far side included, that hit the object first.
    """
    ways = (box.surface_m[None] - eyes_m[:, None]).reshape(-1, 3)
    ways /= np.linalg.norm(ways, axis=1, keepdims=True)
    hits = scene.cast(np.repeat(eyes_m, len(box.surface_m), axis=0), ways)
    seen = (hits.triangle >= 0) & (scene.instance[hits.triangle] == box.id)
    return float(seen.reshape(len(eyes_m), -1).mean(axis=1).max())


def _axes(forward: NDArray[np.float64], up: NDArray[np.float64]) -> NDArray[np.float64]:
    """Compute an orthonormal frame of forward, left and up."""
    up = up / np.linalg.norm(up)
    forward = forward - up * (forward @ up)
    forward /= np.linalg.norm(forward)
    return np.stack([forward, np.cross(up, forward), up], axis=1)


def spread_points(corners: NDArray[np.float64], instance: int) -> NDArray[np.float64]:
    """Draw points evenly on triangles of an object, shape (n, 3, 3), by its id."""
    draws = generator(instance, Step.LIDAR)
    areas = np.linalg.norm(np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]), axis=1)
    chosen = corners[draws.choice(len(corners), _SIGHT_RAYS, p=areas / areas.sum() if areas.any() else None)]
    weights = draws.dirichlet((1.0, 1.0, 1.0), _SIGHT_RAYS)
    points: NDArray[np.float64] = (chosen * weights[:, :, None]).sum(axis=1)
    return points


def add_boxes(
    tables: Tables,
    stretch: Stretch,
    boxes: Sequence[ObjectBox],
    clouds: Mapping[int, Sequence[PointCloud]],
    world: GlobalFrame,
    labels: Labels,
    scene: RayScene,
    traffic: TrafficAt | None = None,
) -> None:
    """Add the annotations of each pose of a scene and their instances to nuScenes' tables.

    Parameters
    ----------
    tables
        The tables to fill.
    stretch
        The poses of the scene; an object that is seen in several scenes is an instance of each.
    boxes
        Boxes of all objects that may be annotated.
    clouds
        Point clouds of each pose, by its index.
    world, labels, scene
        The global frame, the table of labels, and the surfaces that may hide objects.
    traffic
        Function that returns the surfaces at a pose, by its number, and further boxes there.
    """
    chains: dict[int, list[Record]] = defaultdict(list)
    class_of: dict[int, int] = {}
    for shots in stretch.by_pose:
        pose = shots[0].pose
        eyes = np.array([(shot.mount_to_world @ shot.sensor.sensor_to_vehicle)[:3, 3] for shot in shots])
        instances = np.concatenate([cloud.instance for cloud in clouds.get(pose, ())] or [np.zeros(0, np.uint32)])
        numbers, counts = (each.tolist() for each in np.unique(instances, return_counts=True))
        measured = dict(zip(numbers, counts, strict=True))
        surfaces, others = (scene, []) if traffic is None else traffic(pose)
        for box in [*boxes, *others]:
            share, points = share_in_sight(surfaces, box, eyes), measured.get(box.id, 0)
            if not points and not share:
                continue
            class_of[box.id] = box.class_id
            tables.add(
                "sample_annotation",
                f"{pose} {box.id}",
                sample_token=token_of("sample", pose),
                instance_token=token_of("instance", stretch.key(box.id)),
                visibility_token=next(token for token, _, least in reversed(VISIBILITY) if share >= least),
                attribute_tokens=[token_of("attribute", box.attribute)] if box.attribute else [],
                **_box_fields(box, world),
                **({} if traffic is None else {"velocity": _velocity(box, world)}),
                prev=chains[box.id][-1]["token"] if chains[box.id] else "",
                next="",
                num_lidar_pts=points,
                num_radar_pts=0,
            )
            record = tables.records["sample_annotation"][-1]
            if chains[box.id]:
                chains[box.id][-1]["next"] = record["token"]
            chains[box.id].append(record)
    paths = {number: path for path, number in labels.ids.items()}
    for instance, chain in chains.items():
        if chain:
            tables.add(
                "instance",
                stretch.key(instance),
                category_token=token_of("category", BOXED[labels.classes[class_of[instance]].name]),
                nbr_annotations=len(chain),
                first_annotation_token=chain[0]["token"],
                last_annotation_token=chain[-1]["token"],
                path=paths[instance],
                id=instance,
            )


def _box_fields(box: ObjectBox, world: GlobalFrame) -> Record:
    place = np.eye(4)
    place[:3, :3], place[:3, 3] = box.axes, box.centre_m
    length_m, width_m, height_m = (box.size_m + 2 * box.margin_m).tolist()
    return {**place_fields(world.matrix @ place), "size": [width_m, length_m, height_m]}


def _velocity(box: ObjectBox, world: GlobalFrame) -> list[float]:
    """Return the velocity of a box in the global frame, as in files of nuScenes' detections but with z."""
    own = np.zeros(3) if box.velocity_m_s is None else box.velocity_m_s
    velocity: list[float] = (np.round(world.matrix[:3, :3] @ own, 4) + 0.0).tolist()
    return velocity
