"""Object boxes (annotations) of a recording in nuScenes' tables."""

from collections import defaultdict
from collections.abc import Mapping, Sequence

import numpy as np

from garage2usd.objects import CAR_LABELS
from garage2usd.reading.labels import Labels
from garage2usd.sensors.boxes import ObjectBox, share_in_sight
from garage2usd.sensors.formats.nuscenes_classes import BOXED
from garage2usd.sensors.formats.nuscenes_map import GlobalFrame
from garage2usd.sensors.formats.nuscenes_scenes import Stretch
from garage2usd.sensors.formats.nuscenes_tables import Record, Tables, place_fields, token_of
from garage2usd.sensors.rays.point_cloud import PointCloud
from garage2usd.sensors.rays.ray_scene import RayScene

__all__ = ["PARKED", "VISIBILITY", "add_boxes"]

PARKED = "vehicle.parked"
"""nuScenes attribute of parked cars."""
VISIBILITY = (("1", "v0-40", 0.0), ("2", "v40-60", 0.4), ("3", "v60-80", 0.6), ("4", "v80-100", 0.8))
"""Token, level and least share in sight of each nuScenes visibility."""
_BOX_MARGIN_M = 0.01


def add_boxes(
    tables: Tables,
    stretch: Stretch,
    boxes: Sequence[ObjectBox],
    clouds: Mapping[int, Sequence[PointCloud]],
    world: GlobalFrame,
    labels: Labels,
    scene: RayScene,
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
    """
    chains: dict[int, list[Record]] = defaultdict(list)
    by_id = {box.id: box for box in boxes}
    for shots in stretch.by_pose:
        pose = shots[0].pose
        eyes = np.array([(shot.mount_to_world @ shot.sensor.sensor_to_vehicle)[:3, 3] for shot in shots])
        instances = np.concatenate([cloud.instance for cloud in clouds.get(pose, ())] or [np.zeros(0, np.uint32)])
        numbers, counts = (each.tolist() for each in np.unique(instances, return_counts=True))
        measured = dict(zip(numbers, counts, strict=True))
        for box in boxes:
            share, points = share_in_sight(scene, box, eyes), measured.get(box.id, 0)
            if not points and not share:
                continue
            name = labels.classes[box.class_id].name
            tables.add(
                "sample_annotation",
                f"{pose} {box.id}",
                sample_token=token_of("sample", pose),
                instance_token=token_of("instance", stretch.key(box.id)),
                visibility_token=next(token for token, _, least in reversed(VISIBILITY) if share >= least),
                attribute_tokens=[token_of("attribute", PARKED)] if name in CAR_LABELS else [],
                **_box_fields(box, world),
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
                category_token=token_of("category", BOXED[labels.classes[by_id[instance].class_id].name]),
                nbr_annotations=len(chain),
                first_annotation_token=chain[0]["token"],
                last_annotation_token=chain[-1]["token"],
                path=paths[instance],
                id=instance,
            )


def _box_fields(box: ObjectBox, world: GlobalFrame) -> Record:
    place = np.eye(4)
    place[:3, :3], place[:3, 3] = box.axes, box.centre_m
    length_m, width_m, height_m = (box.size_m + 2 * _BOX_MARGIN_M).tolist()
    return {**place_fields(world.matrix @ place), "size": [width_m, length_m, height_m]}
