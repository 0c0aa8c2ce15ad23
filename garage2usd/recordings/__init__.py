"""Recordings of a rig's sensors along a drive: pictures with ground truth, point clouds, masks and calibration."""
# Over 300 lines: the one function that records, and the settings and results that it documents.

from collections.abc import Collection, Iterator
from dataclasses import dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING

from garage2usd.common.errors import ConfigError
from garage2usd.common.output import check_file, check_writable, publish, unfinished_folder
from garage2usd.common.package import RAYS, require
from garage2usd.common.progress import Announce, Progress, silent, unheard
from garage2usd.config.outputs import DriveConfig
from garage2usd.reading.labels import read_labels
from garage2usd.reading.whole_garage import open_garage
from garage2usd.recordings.birds_eye import check_birds_eye, ego_mask
from garage2usd.recordings.flow import write_flow
from garage2usd.recordings.own_drive import AVP
from garage2usd.recordings.scene import EGO_FOLDER, POINTS_FOLDER, Scene
from garage2usd.recordings.sequences import Sequence, check_sequences, write_sequence
from garage2usd.recordings.traffic import Traffic
from garage2usd.recordings.way import Way
from garage2usd.render import Picture, SlotFormat
from garage2usd.render.blender_process import WITHOUT_MODULE, find_blender
from garage2usd.render.devices import CPU, Device, check_birds_eye_device, default_samples, find_device, modules_for
from garage2usd.render.pictures import with_needed, write_mask
from garage2usd.render.tables import NEEDED, check_slots, write_frames
from garage2usd.sensors.formats.recording import Recording, write_calibration
from garage2usd.sensors.rays.birds_eye import BirdsEye
from garage2usd.sensors.rays.point_cloud import CloudFormat
from garage2usd.sensors.rays.ray_caster import SLOWLY
from garage2usd.sensors.rig.around_view_camera import AroundViewCamera
from garage2usd.sensors.rig.rig import Rig, read_rig
from garage2usd.sensors.rig.sensors import Camera
from garage2usd.sensors.slots import read_slots

if TYPE_CHECKING:
    from garage2usd.recordings.sweeps import Sweeps
    from garage2usd.render.pictures import VisibleInstance

__all__ = ["AVP", "CloudFormat", "Device", "Recorded", "Sequence", "Traffic", "check_recording", "record"]

_LEAST_STEP_M = 0.01
_LEAST_STEP_S = 0.01
_CALIBRATION = "calibration"


@dataclass(frozen=True)
class Recorded:
    """The files of a recording.

    Attributes
    ----------
    folder, frames
        Folder of the recording, and its table of frames.
    recording
        Files and times of each sensor, as input of the sequence formats.
    """

    folder: Path
    frames: Path
    recording: Recording


def _rig(rig: str | Path | Rig, scale: float, announce: Announce) -> Rig:
    """Read a rig, and report the unused parts of its car's model."""
    chosen = rig if isinstance(rig, Rig) else read_rig(rig)
    for line in chosen.remarks:
        announce(line)
    return chosen.scaled(scale)


def record(  # noqa: PLR0915 - all steps of a recording, in order
    stage: str | Path,
    output: str | Path,
    *,
    rig: str | Path | Rig,
    along: str | None = None,
    every_m: float = 1.0,
    traffic: Traffic | None = None,
    scale: float = 1.0,
    samples: int | None = None,
    seed: int = 0,
    pictures: Collection[Picture] = tuple(Picture),
    slots: Collection[SlotFormat] | None = None,
    birds_eye: BirdsEye | None = None,
    flow: bool = False,
    points: Collection[CloudFormat] = tuple(CloudFormat),
    sequences: Collection[Sequence] = (),
    settings: DriveConfig | None = None,
    device: Device = Device.AUTO,
    blender: str | Path | None = None,
    progress: Progress = silent,
    announce: Announce = unheard,
) -> Recorded:
    """Record a drive through a stage with the sensors of a rig.

    Parameters
    ----------
    stage
        A stage of garage2usd, also one that other tools have edited.
    output
        Folder of the recording; files of the same names are replaced. Finished frames are kept in
        ``<output>.unfinished`` until the recording is complete, and the same call resumes from there.
    rig
        A `Rig`, the name of a shipped one, or a TOML file.
    along
        ``ENTRANCE:STALL``, as ``1:A1-08``: the proven drive of the design car from an entrance, numbered from 1, to a
        stall, given by its name or painted number, of several levels with the level (``1:U2/A1-08``). Without an
        entrance, the shortest drive is taken. A car parked in the stall is hidden. Alternatively the name of a moving
        camera of the stage. None for one pose without a vehicle; all sensors of the rig must then be mounted in the
        world.
    every_m
        Distance between two poses along the drive.
    traffic
        Tracks of agents, which stand where they are at the time of each pose and move during the sweeps of LiDARs.
        Their car `ego` carries the sensors, and poses have equal steps of time. `along` only tells the stall of a car
        with a drive of its own. Parked cars of the stage that move are hidden.
    scale
        Scale of the sides of the pictures.
    samples, seed, pictures, slots, device, blender, announce
        As for `garage2usd.render.render_stage`; the seed also determines the LiDARs' noise. Without pictures, the
        cameras of a rig with LiDARs are ignored.
    birds_eye
        Settings of additional bird's-eye views at each pose, with masks of free space and of the vehicle; None for
        none.
    flow
        True to write the optical flow of each picture to that of the next pose, as `garage2usd.recordings.flow` does.
    points
        File formats of the LiDARs' point clouds.
    sequences
        Additional sequence formats, each in a folder of its name.
    settings
        Limits of the car's motion.
    progress
        Receives the progress of the drive and the number of finished samples.

    Raises
    ------
    ConfigError
        If the rig, the drive or the output is invalid, or the stall cannot be reached.
    MissingExtraError
        If Blender (needed for cameras only), the packages for ray casting or those for ROS bags are not installed.
    OutputError
        If the files cannot be written. They appear whole or not at all.
    RenderError
        If Blender fails.
    StageError
        If the stage cannot be read.
    """
    path, folder = Path(stage), Path(output)
    chosen = _rig(rig, scale, announce)
    if not pictures and chosen.cameras and chosen.lidars:
        announce(f"without the cameras of the rig: {', '.join(camera.name for camera in chosen.cameras)}")
        chosen = chosen.without_cameras()
    if every_m < _LEAST_STEP_M:
        raise ConfigError("every_m", every_m, f"{_LEAST_STEP_M} m or more")
    asked = frozenset(sequences)
    kinds, formats = check_recording(
        chosen,
        pictures=pictures,
        slots=slots,
        birds_eye=birds_eye,
        points=points,
        sequences=asked,
        device=device,
        blender=blender,
    )
    _check_way(chosen, traffic, along, birds_eye)
    check_writable(folder)
    check_file(folder / "frames.json")
    drawn_on = find_device(device, has_rays=True, blender=find_blender(blender)) if chosen.cameras else CPU
    opened = open_garage(path)
    progress("drive", 0, 1)
    way = Way(opened, path, along, every_m, settings or DriveConfig(), traffic)
    scene = Scene(opened, read_labels(opened, path), way, chosen, birds_eye)
    progress("drive", 1, 1)
    if slots is not None:
        read_slots(opened)  # raises before the work if there are no slots
    sweeps = None
    if formats or asked:
        from garage2usd.recordings.sweeps import Sweeps  # noqa: PLC0415 - pictures do not need its extra

        sweeps = Sweeps(opened, scene.labels, way, chosen, formats, seed)
    needed = {*(() if slots is None and birds_eye is None and not flow else NEEDED), *scene.needed(kinds)}
    drawn = with_needed(kinds, needed)
    count = samples or default_samples((view.size_px for view in scene.views), drawn_on)
    key = scene.key(path, drawn, samples=count, seed=seed, device=drawn_on)
    with unfinished_folder(folder, key) as unfinished:
        finished, work = unfinished / "finished", unfinished / "work"
        work.mkdir(exist_ok=True)
        finished.mkdir(exist_ok=True)
        visible: list[list[VisibleInstance] | None] = []
        views = scene.views
        made = [finished / kind for kind in kinds]
        about: dict[str, object] = {"rig": chosen.model_dump(mode="json"), "drive": way.about, **way.traffic_facts}
        if chosen.cameras:
            drawing = scene.drawing(work, finished, drawn, samples=count, seed=seed, device=drawn_on)
            visible = drawing.draw(work, progress, announce)
            views = [replace(view, facts=drawing.facts(view)) for view in views]
            made += _write_calibrations(chosen, finished)
            flowing, views = write_flow(scene, views, finished) if flow else ([], views)
            made += flowing
            if scene.birds_eye is not None:
                made.append(scene.birds_eye.write_masks(finished, chosen.body))
        if sweeps is not None and formats:
            if SLOWLY is not None:
                announce(SLOWLY)
            announce(sweeps.described)
            about["sweeps"] = sweeps.write(finished, work, progress)
            made.append(finished / POINTS_FOLDER)
        if sweeps is not None:
            whole = _recording(scene, sweeps, path, finished, kinds)
            made += _write_sequences(asked, whole, finished, sweeps, work, progress, announce)
        table = write_frames(
            finished / "frames.json",
            [(view, seen, []) for view, seen in zip(views, visible, strict=True)],
            scene.labels,
            kinds,
            stage=path,
            about=about,
        )
        told = [] if slots is None else scene.slot_labels(finished).write(slots)
        places = publish([*made, *told, table], folder)
    return Recorded(folder, places[-1], _recording(scene, sweeps, path, folder, kinds))


def check_recording(
    rig: Rig,
    *,
    pictures: Collection[Picture],
    slots: Collection[SlotFormat] | None,
    birds_eye: BirdsEye | None,
    points: Collection[CloudFormat],
    sequences: Collection[Sequence],
    device: Device = Device.AUTO,
    blender: str | Path | None = None,
) -> tuple[tuple[Picture, ...], tuple[CloudFormat, ...]]:
    """Check before the work that a rig can record with the arguments of `record`.

    Returns
    -------
    tuple
        The kinds of pictures of its cameras, and the formats of its LiDARs' points.

    Raises
    ------
    ConfigError
        If the rig does not support a requested output.
    MissingExtraError
        If a required package is not installed.
    """
    kinds = tuple(kind for kind in Picture if kind in pictures) if rig.cameras else ()
    if rig.cameras and not kinds:
        raise ConfigError("pictures", list(pictures), f"at least one of {', '.join(Picture)}, as the rig has no LiDAR")
    formats = tuple(kind for kind in CloudFormat if kind in points) if rig.lidars else ()
    if rig.lidars and not formats:
        raise ConfigError("points", list(points), f"at least one of {', '.join(CloudFormat)}")
    if birds_eye is not None:
        check_birds_eye(rig, kinds)
        check_birds_eye_device(device)
    if slots is not None:
        has_around_view = any(isinstance(camera, AroundViewCamera) for camera in rig.cameras)
        check_slots(slots, kinds, has_ground_view=birds_eye is not None or has_around_view)
    check_sequences(sequences, rig, kinds, formats)
    without = WITHOUT_MODULE + ("; not for LiDARs alone: --points without --only" if rig.lidars else "")
    draws = modules_for(device, find_blender(blender)) if rig.cameras else ()
    require(f"the rig {rig.name}", [*draws, *_modules_for(rig, sequences, birds_eye)], without=without)
    return kinds, formats


def _check_along(rig: Rig, along: str | None, birds_eye: BirdsEye | None) -> None:
    """Check before the work that a rig can record without a drive.

    Raises
    ------
    ConfigError
        If there is no drive, but a sensor or a bird's-eye view needs a vehicle.
    """
    if along is not None:
        return
    moving = next((sensor for sensor in rig.recorded if sensor.mount != "world"), None)
    if moving is not None:
        whose = f"for the sensor {moving.name}, which is mounted on the {moving.mount} and not in the world"
        raise ConfigError("along", None, f"ENTRANCE:STALL as 1:A1-08, or the name of a camera that moves, {whose}")
    if birds_eye is not None:
        raise ConfigError("along", None, "a drive, along which bird's-eye views are recorded")


def _check_way(rig: Rig, traffic: Traffic | None, along: str | None, birds_eye: BirdsEye | None) -> None:
    """Check before the work that a rig can record along a drive, or in traffic.

    Raises
    ------
    ConfigError
        If a sensor or a bird's-eye view needs an ego, a time is invalid, or a stall is given for a car of the tracks.
    """
    if traffic is None:
        _check_along(rig, along, birds_eye)
        return
    if traffic.every_s < _LEAST_STEP_S:
        raise ConfigError("every_s", traffic.every_s, f"{_LEAST_STEP_S} s or more")
    if along is not None and traffic.ego != AVP:
        raise ConfigError("along", along, f"only for the ego {AVP}, as a car of the tracks has a way of its own")
    moving = next((sensor for sensor in rig.recorded if sensor.mount != "world"), None)
    if not traffic.ego and (moving is not None or birds_eye is not None):
        whose = f"the sensor {moving.name}, which is not mounted in the world" if moving else "bird's-eye views"
        raise ConfigError("ego", None, f"{AVP}, or a car of the tracks, for {whose}")


def _modules_for(rig: Rig, sequences: Collection[Sequence], birds_eye: BirdsEye | None) -> Iterator[str]:
    """Yield the Python modules that recording with a rig requires besides Blender.

    Ray casting is also needed for ego masks, the boxes of sequences, and the headroom of free space.
    """
    is_on_car = any(camera.mount == "vehicle" for camera in rig.cameras)
    if rig.lidars or sequences or is_on_car or birds_eye is not None:
        yield from RAYS
    if Sequence.ROS2 in sequences:
        yield "rosbags"


def _write_calibrations(rig: Rig, finished: Path) -> list[Path]:
    """Write the calibration of each camera, and the ego mask of each camera on the car.

    Cameras that are not recorded are included. Around views have no calibration, since no format supports them.
    """
    folders = [finished / name for name in (EGO_FOLDER, _CALIBRATION)]
    for folder in folders:
        folder.mkdir(exist_ok=True)
    for sensor in rig.sensors:
        if isinstance(sensor, Camera) and not isinstance(sensor, AroundViewCamera):
            write_calibration(sensor, finished / _CALIBRATION)
    for camera in rig.cameras:
        if camera.mount == "vehicle":
            write_mask(ego_mask(camera, rig.body), finished / EGO_FOLDER / f"{camera.name}.png")
    return folders


def _write_sequences(
    asked: Collection[Sequence],
    recording: Recording,
    finished: Path,
    sweeps: "Sweeps",
    work: Path,
    progress: Progress,
    announce: Announce,
) -> Iterator[Path]:
    for kind in Sequence:
        if kind in asked:
            progress(kind.value, 0, 1)
            yield from write_sequence(kind, recording, finished, sweeps, work, announce)
            progress(kind.value, 1, 1)


def _recording(
    scene: Scene, sweeps: "Sweeps | None", path: Path, folder: Path, kinds: tuple[Picture, ...]
) -> Recording:
    """Combine the files of cameras and LiDARs to a recording, pose by pose."""
    pictures = scene.recording(path, folder, kinds)
    shots = [*pictures.shots, *(sweeps.shots(folder) if sweeps else ())]
    return replace(pictures, shots=tuple(sorted(shots, key=lambda shot: shot.pose)))
