"""Optical flow between the poses of a recording, exact for rigid bodies and for the lens of each camera."""

from collections.abc import Mapping, Sequence
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from garage2usd.recordings.scene import Scene
from garage2usd.render import Picture
from garage2usd.render.cameras import View
from garage2usd.render.pictures import read_depth, read_ids, write_exr
from garage2usd.sensors.rays.sight import seen_points
from garage2usd.sensors.rig.poses import Matrix

FLOW_FOLDER = "flow"
"""Folder of the flow, with a file for each camera and each pose but the last."""


def write_flow(scene: Scene, views: Sequence[View], finished: Path) -> tuple[list[Path], list[View]]:
    """Write the flow of each view to that of the same camera at the next pose.

    Parameters
    ----------
    scene, views
        The scene of the recording, and its views.
    finished
        Folder of its pictures, with depth and instances.

    Returns
    -------
    tuple
        The folder, and the views with the name of their file in their facts.

    Notes
    -----
    Channels U and V of a file are the pixels to the right and down by which what a pixel shows has moved at the next
    pose, also if something hides it by then; NaN where nothing is seen, or is outside of the field of view by then.
    People move as a whole.
    """
    (finished / FLOW_FOLDER).mkdir(exist_ok=True)
    numbers = {(camera.name, number): index for index, (camera, number, _) in enumerate(scene.shots)}
    found = list(views)
    for index, (camera, number, _) in enumerate(scene.shots):
        after = numbers.get((camera.name, number + 1))
        if after is None:
            continue
        view, ends = views[index], views[after]
        depth_m = read_depth(finished / Picture.DEPTH / f"{view.name}{Picture.DEPTH.extension}")
        ids = read_ids(finished / Picture.INSTANCE / f"{view.name}{Picture.INSTANCE.extension}")
        flow = _flow(view, ends, depth_m, ids, scene.moves(number))
        path = f"{FLOW_FOLDER}/{view.name}.exr"
        write_exr(finished / path, {"U": flow[..., 0], "V": flow[..., 1]})
        found[index] = view.with_facts(flow=path)
    return [finished / FLOW_FOLDER], found


def _flow(
    view: View, ends: View, depth_m: NDArray[np.float32], ids: NDArray[np.int32], moves: Mapping[int, Matrix]
) -> NDArray[np.float32]:
    lens = view.sensor_lens()
    places = seen_points(lens, depth_m, np.linalg.inv(view.world_to_camera()))
    for instance, move in moves.items():
        own = ids == instance
        places[own] = places[own] @ move[:3, :3].T + move[:3, 3]
    to_camera, seen = ends.world_to_camera(), np.isfinite(places).all(axis=-1)
    flow = np.full((*depth_m.shape, 2), np.nan, dtype=np.float32)
    there = lens.project(places[seen] @ to_camera[:3, :3].T + to_camera[:3, 3])
    flow[seen] = there - lens.middles().reshape(*depth_m.shape, 2)[seen]
    return flow
