"""Cameras of the stage: at the entrance, above the garage, and moving from an entrance to an exit."""

import math
from itertools import pairwise
from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from pxr import Gf, Sdf

from garage2usd.driving.tracks import knots
from garage2usd.garage import LaneGraph, LaneKind
from garage2usd.layout import Layout
from garage2usd.native import elementary
from garage2usd.stage.authoring import attribute, define, new_layer, operation, order_operations
from garage2usd.stage.labels import world_bounds_m

FRAMES_PER_SECOND = 24.0
EYE_M = 1.5
"""Height of a driver's eye above the floor."""
FOCAL_MM = 20.0
APERTURE_MM = (36.0, 20.25)
"""Horizontal and vertical aperture of all cameras, for the focal length above."""
_MARGIN = 1.05
_SPEED_M_S = 2.7
_CORNER_CUTS = 3
_STEADY = 1e-9
"""Rounding errors of a constant speed, in metres or degrees per frame."""
_UNSEEN_DEG = 0.02
"""Angle by which a camera may deviate from its path: half a pixel of an image 2000 pixels wide."""
_LOOK_AHEAD_M = 4.0
_NEAR_M, _FAR_M = 0.1, 2000.0
_SHELL = ("wall", "portal", "ramp", "sky")
"""Kinds of objects that enclose every garage."""

DRIVE_NAME = "Drive"
"""Name of the driving camera and of its asset."""


def write_drive(path: Path, lanes: LaneGraph) -> int:
    """Write the driving camera as a separate layer, as text is slow with many samples; return the last frame.

    Notes
    -----
    The camera takes the shortest route from the first entrance with a path to an exit to the nearest exit, at 2.7 m/s,
    with rounded corners, looking 4 m ahead; its first frame is 0. Frames of steady motion, and of a steady turn up to
    0.02 degrees, have no samples, as USD interpolates linearly.
    """
    with new_layer(path, default_prim=DRIVE_NAME) as layer:
        camera = _camera(layer, Sdf.Path.absoluteRootPath.AppendChild(DRIVE_NAME))
        last_frame = _drive(camera, layer, _way(lanes))
        set_frames(layer, last_frame)
    return last_frame


def set_frames(layer: Sdf.Layer, last_frame: int) -> None:
    """Set the frame range of a layer, from 0."""
    layer.framesPerSecond = layer.timeCodesPerSecond = FRAMES_PER_SECOND
    layer.startTimeCode, layer.endTimeCode = 0.0, float(last_frame)


def author_cameras(layer: Sdf.Layer, path: Sdf.Path, layout: Layout, *, own: str) -> None:
    """Author a camera at a driver's eye at the entrance and one over the whole garage; refer to the one that drives."""
    define(layer, path, "Scope")
    entrance = layout.lane_graph.portals(LaneKind.ENTRANCE)[0]
    x, z = layout.lane_graph.nodes[entrance].position
    lane_x, lane_z = layout.lane_graph.nodes[min(layout.lane_graph.onward[entrance])].position
    yaw = math.degrees(elementary.arctan2(x - lane_x, z - lane_z))
    _fixed(_camera(layer, path.AppendChild("Inside")), (x, EYE_M, z), yaw_deg=yaw)

    low, high = world_bounds_m(layout.placements, layout.placements.rows_of(*_SHELL))
    (left, _, back), (right, top, front) = low.min(axis=0).tolist(), high.max(axis=0).tolist()
    distance = _MARGIN * FOCAL_MM * max((right - left) / APERTURE_MM[0], (front - back) / APERTURE_MM[1])
    over = ((left + right) / 2, top + distance, (back + front) / 2)
    above = _camera(layer, path.AppendChild("Above"), far_m=max(_FAR_M, math.ceil(over[1])))
    _fixed(above, over, pitch_deg=-90.0)
    drive = define(layer, path.AppendChild(DRIVE_NAME), "Camera")
    reference = Sdf.Reference(f"./{own}{DRIVE_NAME}.usdc")
    drive.SetInfo("references", Sdf.ReferenceListOp.Create(prependedItems=[reference]))


def _way(lanes: LaneGraph) -> NDArray[np.float64]:
    """Middles of the lane nodes from the first entrance that leads to an exit to the nearest one; shape (n, 2).

    There is one, as stalls are reached.
    """
    exits = lanes.portals(LaneKind.EXIT)
    found = (
        list(filter(None, (lanes.shortest_way(entrance, exit_) for exit_ in exits)))
        for entrance in lanes.portals(LaneKind.ENTRANCE)
    )
    return lanes.positions_m[min(next(filter(None, found)), key=lanes.way_m)]


def _drive(camera: Sdf.PrimSpec, layer: Sdf.Layer, way: NDArray[np.float64]) -> int:
    way = _rounded(way)
    reached = np.concatenate(([0.0], np.cumsum(np.linalg.norm(np.diff(way, axis=0), axis=1))))
    frames = int(reached[-1] / _SPEED_M_S * FRAMES_PER_SECOND)

    driven = np.arange(frames + 1) * (_SPEED_M_S / FRAMES_PER_SECOND)
    here, ahead = (
        np.stack([np.interp(arc_m, reached, way[:, axis]) for axis in (0, 1)], axis=1).tolist()
        for arc_m in (driven, driven + _LOOK_AHEAD_M)
    )
    start = (float(way[0, 0]), EYE_M, float(way[0, 1]))
    moves = operation(camera, "translate", Sdf.ValueTypeNames.Float3, Gf.Vec3f(*start))
    turns = operation(camera, "rotateY", Sdf.ValueTypeNames.Float, 0.0)
    order_operations(camera, ["translate", "rotateY"])
    yaw, yaws_deg = 0.0, []
    for (x, z), (ahead_x, ahead_z) in zip(here, ahead, strict=True):
        if math.hypot(ahead_x - x, ahead_z - z) > 1e-3:  # noqa: PLR2004 - at the end it looks on as before
            target = math.degrees(elementary.arctan2(x - ahead_x, z - ahead_z))
            yaw += math.remainder(target - yaw, 360.0)
        yaws_deg.append(yaw)
    turns.default = yaws_deg[0]
    for frame in bends(np.array(here)):
        x, z = here[frame]
        layer.SetTimeSample(moves.path, float(frame), Gf.Vec3f(x, EYE_M, z))
    for frame in knots(np.arange(float(len(yaws_deg))), np.array(yaws_deg), _UNSEEN_DEG).tolist():
        layer.SetTimeSample(turns.path, float(frame), round(yaws_deg[frame], 3))
    return frames


def bends(values: NDArray[np.float64]) -> list[int]:
    """The frames between which values, shape (frames, n), change steadily, which USD interpolates linearly."""
    bends = np.ones(len(values), dtype=bool)
    bends[1:-1] = (np.abs(np.diff(values, 2, axis=0)) > _STEADY).any(axis=1)
    frames: list[int] = np.flatnonzero(bends).tolist()
    return frames


def _rounded(way: NDArray[np.float64]) -> NDArray[np.float64]:
    """Round the corners of the moving camera's route by Chaikin's corner cutting (1974)."""
    for _ in range(_CORNER_CUTS):
        cut = [way[0]]
        for one, other in pairwise(way):
            cut += [0.75 * one + 0.25 * other, 0.25 * one + 0.75 * other]
        way = np.array([*cut, way[-1]])
    return way


def _camera(layer: Sdf.Layer, path: Sdf.Path, *, far_m: float = _FAR_M) -> Sdf.PrimSpec:
    camera = define(layer, path, "Camera")
    # focal length and aperture are tenths of a stage unit
    lens = {"focalLength": FOCAL_MM, "horizontalAperture": APERTURE_MM[0], "verticalAperture": APERTURE_MM[1]}
    for name, value_mm in lens.items():
        attribute(camera, name, Sdf.ValueTypeNames.Float, value_mm / 100)
    attribute(camera, "clippingRange", Sdf.ValueTypeNames.Float2, Gf.Vec2f(_NEAR_M, far_m))
    return camera


def _fixed(
    camera: Sdf.PrimSpec, position_m: tuple[float, float, float], *, yaw_deg: float = 0.0, pitch_deg: float = 0.0
) -> None:
    operation(camera, "translate", Sdf.ValueTypeNames.Float3, Gf.Vec3f(*position_m))
    names = ["translate"]
    for name, value in (("rotateY", yaw_deg), ("rotateX", pitch_deg)):
        if value:
            operation(camera, name, Sdf.ValueTypeNames.Float, value)
            names.append(name)
    order_operations(camera, names)
