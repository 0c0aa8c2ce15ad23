"""Cameras of a stage as views: pose and lens at each frame."""

import re
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import asdict, dataclass, field, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray
from pxr import Usd, UsdGeom

from garage2usd.common.errors import ConfigError
from garage2usd.common.spelling import find_named
from garage2usd.scenes.values import metres_per_unit
from garage2usd.sensors.rays.around_view import SEAM_M, AroundView
from garage2usd.sensors.rays.birds_eye import Orthographic
from garage2usd.sensors.rays.lenses import Fisheye, Pinhole
from garage2usd.sensors.rays.lenses import Lens as SensorLens
from garage2usd.sensors.rig.poses import Twist
from garage2usd.sensors.rig.sensors import CameraEffects

_EVERY = 48
_MOST_FRAMES = 100_000
_LEAST_STRIDE = 0.001
_ROUNDING = 1e-6
_NUMBER = r"(-?\d{1,9}(?:\.\d{1,6})?)"
_SPAN = re.compile(rf"{_NUMBER}(?::{_NUMBER}(?:x{_NUMBER})?)?")
_MM_PER_TENTH = 100.0
_CLIP_M = (0.01, 2000.0)
"""Clipping range of a rig's sensors."""
USD_FROM_OPENCV = np.diag([1.0, -1.0, -1.0, 1.0])
"""Rotation between an OpenCV camera (+Z forward, +Y down) and a USD camera (-Z forward, +Y up), in both directions."""


@dataclass(frozen=True)
class Lens:
    """The perspective lens of a USD camera; the picture's width takes the whole horizontal aperture.

    Attributes
    ----------
    focal_mm, aperture_mm
        Focal length and horizontal aperture.
    shift
        Offset of the aperture's middle to the right of and above the optical axis, as shares of its width.
    clip_m
        Near and far clipping distance along the optical axis.
    """

    focal_mm: float
    aperture_mm: float
    shift: tuple[float, float]
    clip_m: tuple[float, float]

    def matrix(self, size_px: tuple[int, int]) -> NDArray[np.float64]:
        """Return the intrinsic matrix K, with pixel corners at whole numbers; float64, shape (3, 3)."""
        width, height = size_px
        focal_px = width * self.focal_mm / self.aperture_mm
        right, up = self.shift
        return np.array([[focal_px, 0, width * (0.5 - right)], [0, focal_px, height / 2 + width * up], [0, 0, 1]])


@dataclass(frozen=True, eq=False)
class View:
    """A view to render: a camera with pose, lens and picture size.

    Attributes
    ----------
    name
        Name of the camera, with the frame if the camera moves; the stem of the picture's files.
    camera
        Path of the camera's prim, or name of the sensor.
    frame
        Time code; None for static cameras and for sensors.
    lens
        Lens of a stage's camera or of a rig's sensor.
    size_px
        Width and height of the picture.
    camera_to_world
        Transform from the camera's axes (-Z forward, +Y up) to the stage's, in metres; float64, shape (4, 4).
    facts
        Further entries of the view in the table of frames.
    effects
        Imperfections of the camera's colour picture; None for a perfect camera.
    twist
        Motion of the camera relative to the moving objects, in axes with +Z forward and +Y down; None if the effects do
        not show motion.
    is_carried
        True if the camera is mounted on the vehicle, so that everything except the vehicle moves in its picture;
        otherwise only the vehicle moves.
    """

    name: str
    camera: str
    frame: float | None
    lens: Lens | SensorLens
    size_px: tuple[int, int]
    camera_to_world: NDArray[np.float64]
    facts: Mapping[str, object] = field(default_factory=dict)
    effects: CameraEffects | None = None
    twist: Twist | None = None
    is_carried: bool = False

    @property
    def shows_motion(self) -> bool:
        """True if the colour picture depends on the camera's motion, and so on depth and instances."""
        return self.twist is not None and self.effects is not None and self.effects.shows_motion

    def with_facts(self, **facts: object) -> "View":
        """Return the view with further entries in the table of frames."""
        return replace(self, facts={**self.facts, **facts})

    def world_to_camera(self) -> NDArray[np.float64]:
        """Return the transform from the stage's axes to the camera's (+Z forward, +X right, +Y down); shape (4, 4)."""
        matrix: NDArray[np.float64] = USD_FROM_OPENCV @ np.linalg.inv(self.camera_to_world)
        return matrix

    def intrinsics(self) -> NDArray[np.float64] | None:
        """Return the intrinsic matrix K, pixel corners at whole numbers; None for lenses that are not pinholes."""
        if isinstance(self.lens, Lens):
            return self.lens.matrix(self.size_px)
        if isinstance(self.lens, Pinhole):
            (focal_x, focal_y), (across, down) = self.lens.focal_px, self.lens.centre_px
            return np.array([[focal_x, 0, across], [0, focal_y, down], [0, 0, 1]])
        return None

    def sensor_lens(self) -> SensorLens:
        """Return the view's lens as a sensor lens; a stage camera's lens is converted for the picture's size."""
        if isinstance(self.lens, SensorLens):
            return self.lens
        (focal_x, _, across), (_, focal_y, down), _ = self.lens.matrix(self.size_px).tolist()
        return Pinhole(size_px=self.size_px, centre_px=(across, down), focal_px=(focal_x, focal_y))

    def starts_m(self) -> NDArray[np.float64] | None:
        """Return the starting points of an around view's rays in the stage's axes; float64, shape (rows, columns, 3).

        Pixels without a ray are NaN. None for other lenses.
        """
        if not isinstance(self.lens, AroundView):
            return None
        middles = self.lens.middles()
        to_world = self.camera_to_world @ USD_FROM_OPENCV
        starts = self.lens.starts(middles) @ to_world[:3, :3].T + to_world[:3, 3]
        seen = np.isfinite(self.lens.rays(middles)).all(axis=1)
        return np.where(seen[:, None], starts, np.nan).reshape(*self.size_px[::-1], 3)

    def lens_job(self) -> dict[str, Any]:
        """Return the view's lens as plain values for Blender."""
        lens = self.lens
        if isinstance(lens, Lens):
            return {"kind": "perspective", **asdict(lens)}
        if isinstance(lens, Orthographic):
            width_m = self.size_px[0] * lens.metres_per_px
            return {"kind": "orthographic", "width_m": width_m, "clip_m": _CLIP_M}
        job: dict[str, Any] = {"kind": "rays", "centre_px": lens.centre_px, "clip_m": _CLIP_M}
        if isinstance(lens, Fisheye):
            fisheye = {"coefficients": lens.radius.coefficients, "max_angle_rad": lens.max_angle_rad}
            return {**job, "stretch": lens.stretch, **fisheye}
        if isinstance(lens, Pinhole):
            return {**job, "stretch": lens.focal_px}
        if isinstance(lens, AroundView):
            eyes = [eye.place_m.tolist() for eye in lens.eyes]
            return {**job, "stretch": [1 / lens.metres_per_px] * 2, "car_m": lens.car_m, "seam_m": SEAM_M, "eyes": eyes}
        raise TypeError(type(lens).__name__)


def find_views(
    stage: Usd.Stage,
    *,
    cameras: Sequence[str] = (),
    frames: str | None = None,
    size_px: tuple[int, int] = (1280, 720),
) -> list[View]:
    """Find the views of a stage's cameras and frames.

    Parameters
    ----------
    stage
        The stage.
    cameras
        Names or paths of cameras, case-insensitive, in the order of the pictures; all cameras of the stage if empty.
    frames
        Frames of moving cameras in usdrecord's notation: ``0``, ``0:96``, ``0:960x24``, several with commas; every 48th
        from first to last if left out.
    size_px
        Width and height of the pictures.

    Raises
    ------
    ConfigError
        If a camera or frame does not exist, or a camera is not perspective.
    """
    found = {
        prim.GetPath().pathString: UsdGeom.Camera(prim)
        for prim in Usd.PrimRange.Stage(stage, Usd.TraverseInstanceProxies(Usd.PrimDefaultPredicate))
        if prim.IsA(UsdGeom.Camera)
    }
    chosen = list(dict.fromkeys(path for name in cameras for path in _named(name, found))) if cameras else list(found)
    if not chosen:
        raise ConfigError("camera", stage.GetRootLayer().realPath, "a stage with cameras")
    times = _times(stage, frames)
    names = [path.rpartition("/")[2] for path in chosen]
    views: list[View] = []
    for path, name in zip(chosen, names, strict=True):
        own = name if names.count(name) == 1 else path.strip("/").replace("/", "_")
        views += _views_of(found[path], path, own, times, size_px)
    return views


def _named(name: str, found: dict[str, UsdGeom.Camera]) -> list[str]:
    matching = find_named(name, {path: (path, path.rpartition("/")[2]) for path in found})
    if not matching:
        raise ConfigError("camera", name, ", ".join(found) or "a stage with cameras")
    return matching


def _times(stage: Usd.Stage, frames: str | None) -> list[float]:
    if frames is None:
        frames = f"{stage.GetStartTimeCode():g}:{stage.GetEndTimeCode():g}x{_EVERY}"
    times: list[float] = []
    for part in frames.split(","):
        found = _SPAN.fullmatch(part.strip())
        if found is None:
            raise ConfigError("frames", frames, "frames as 0, 0:96 or 0:960x24, several with commas")
        start, end, stride = float(found[1]), float(found[2] or found[1]), float(found[3] or 1)
        if end < start or stride < _LEAST_STRIDE or (end - start) / stride + len(times) >= _MOST_FRAMES:
            raise ConfigError("frames", frames, f"a first frame, a last one and a step, {_MOST_FRAMES} frames at most")
        times += [start + step * stride for step in range(int((end - start) / stride + _ROUNDING) + 1)]
    return list(dict.fromkeys(times))


def _views_of(
    camera: UsdGeom.Camera, path: str, name: str, times: Sequence[float], size_px: tuple[int, int]
) -> Iterator[View]:
    if not _moves(camera.GetPrim()):
        yield _view(camera, path, name, None, size_px)
        return
    for time in times:
        number = f"{time:04.0f}" if time == round(time) else f"{time:g}".replace(".", "_")
        yield _view(camera, path, f"{name}_{number}", time, size_px)


def _moves(prim: Usd.Prim) -> bool:
    while prim:
        if prim.IsA(UsdGeom.Xformable) and UsdGeom.Xformable(prim).TransformMightBeTimeVarying():
            return True
        prim = prim.GetParent()
    return False


def _view(camera: UsdGeom.Camera, path: str, name: str, frame: float | None, size_px: tuple[int, int]) -> View:
    time = Usd.TimeCode.EarliestTime() if frame is None else Usd.TimeCode(frame)
    if camera.GetProjectionAttr().Get(time) != UsdGeom.Tokens.perspective:
        raise ConfigError("camera", path, "cameras in perspective")
    metres = metres_per_unit(camera.GetPrim().GetStage())
    seen = camera.GetCamera(time)
    width = seen.horizontalAperture
    lens = Lens(
        # in tenths of a unit; only the ratio of the two matters
        seen.focalLength * metres * _MM_PER_TENTH,
        width * metres * _MM_PER_TENTH,
        (seen.horizontalApertureOffset / width, seen.verticalApertureOffset / width),
        (seen.clippingRange.min * metres, seen.clippingRange.max * metres),
    )
    place = np.array(camera.ComputeLocalToWorldTransform(time).GetOrthonormalized()).T
    place[:3, 3] = metres * np.array(camera.ComputeLocalToWorldTransform(time).ExtractTranslation())
    return View(name, path, frame, lens, size_px, place)
