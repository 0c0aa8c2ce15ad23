"""Drives through the garages of a data set, recorded with a rig and packed into one file each."""

import zipfile
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import TYPE_CHECKING, Annotated, Literal, NamedTuple

import numpy as np
from pydantic import Field, field_validator

from garage2usd.common.errors import ConfigError
from garage2usd.common.randomness import Step, generator
from garage2usd.common.settings import Settings
from garage2usd.config.outputs import DriveConfig
from garage2usd.driving.tracks import AgentState, Tracks
from garage2usd.recordings import AVP, CloudFormat, Device, Traffic, check_recording, record
from garage2usd.recordings import Sequence as SequenceFormat
from garage2usd.render import Picture, SlotFormat
from garage2usd.sensors.rays.birds_eye import BirdsEye
from garage2usd.sensors.rig.rig import RIG_NAMES, Rig, read_rig
from garage2usd.stage.agent_models import CARS

if TYPE_CHECKING:
    from collections.abc import Sequence

    from garage2usd.driving import StallProof

_TEXTS = {".json", ".yaml"}
_FIRST_DATE = (1980, 1, 1, 0, 0, 0)
_LEAST_DRIVE_S = 5.0
_SEEDS = 2**31
"""Upper limit of Blender's seeds."""


class DrivesConfig(Settings):
    """Settings of the drives recorded in each garage; names as in `garage2usd render --rig`."""

    rig: Rig
    """Name of a shipped rig; in a recipe file also the path of a TOML file, or its table."""
    count: int = Field(1, ge=1, le=1000)
    """Number of drives, each from the nearest entrance to a stall with a proven drive, drawn by the garage's seed;
    fewer if there are fewer such stalls."""
    every_m: float = Field(5.0, ge=0.01, le=1000)
    """Distance in metres between two poses of the drive."""
    ego: Literal["car", "avp"] = "car"
    """In traffic: 'car': cars of the tracks carry the rig, each from the beginning of its first drive; 'avp': a car of
    its own drives to a free stall and back."""
    every_s: float = Field(0.5, ge=0.01, le=60)
    """In traffic: seconds between two poses."""
    longest_s: float = Field(60.0, gt=0, le=3600)
    """In traffic: greatest duration of the recording of a car of the tracks in seconds."""
    scale: float = Field(1.0, gt=0, le=16)
    """Scale of the sides of the pictures."""
    samples: int = Field(64, ge=1, le=65_536)
    """Samples per pixel of the colour picture."""
    device: Literal[Device.CPU, Device.RAYS] = Device.CPU
    """What draws the pictures: 'cpu': Blender; 'rays': few rays without Blender, several times as quick."""
    pictures: tuple[Picture, ...] = tuple(Picture)
    """Kinds of pictures of the cameras; none for the LiDARs of the rig alone."""
    points: Annotated[tuple[CloudFormat, ...], Field(min_length=1)] = tuple(CloudFormat)
    """File formats of the LiDARs' point clouds."""
    slots: tuple[SlotFormat, ...] = ()
    """Formats of the slot labels of each frame."""
    also: tuple[SequenceFormat, ...] = ()
    """Additional sequence formats of the drive."""
    birds_eye: BirdsEye | None = None
    """Settings of additional bird's-eye views at each pose; none if left out."""

    @field_validator("rig", mode="before")
    @classmethod
    def _shipped(cls, rig: object) -> object:
        if not isinstance(rig, str):
            return rig
        if rig not in RIG_NAMES:
            raise ValueError(f"one of {', '.join(RIG_NAMES)}, a path that ends in .toml, or the table of a rig")
        return read_rig(rig)


def check_drives(config: DrivesConfig) -> None:
    """Check that the drives of a data set can be recorded.

    Raises
    ------
    ConfigError
        If the rig does not support the requested output.
    MissingExtraError
        If a required package is not installed.
    """
    try:
        rig = config.rig.scaled(config.scale)
        check_recording(
            rig if config.pictures or not rig.lidars else rig.without_cameras(),
            pictures=config.pictures,
            slots=config.slots or None,
            birds_eye=config.birds_eye,
            points=config.points,
            sequences=config.also,
            device=config.device,
        )
    except ConfigError as error:
        raise ConfigError(f"make.drives.{error.field}", error.value, error.allowed) from None


def record_drives(
    stage: Path,
    config: DrivesConfig,
    proofs: "Sequence[StallProof]",
    *,
    seed: int,
    settings: DriveConfig,
    tracks: Tracks | None = None,
) -> tuple[Path, ...]:
    """Record drives through a garage of a data set.

    Parameters
    ----------
    stage
        Stage of the garage.
    config
        Settings of the drives.
    proofs
        Swept-path proofs of the stalls; not needed in traffic.
    seed
        Seed of the drawn stalls or cars, the render samples and the LiDARs' noise.
    settings
        Limits of the car's motion.
    tracks
        The traffic, in which the drives are recorded; None for empty aisles.

    Returns
    -------
    tuple of Path
        A file for each drive beside the stage, ``<stem>.drive_0.zip``, with the files of `recordings.record`.
    """
    draw = generator(seed, Step.DRIVES)
    if tracks is None:
        names = [f":{proof.stall}" for proof in proofs if proof.way_in is not None]
        drawn = draw.permutation(len(names))[: config.count].tolist()
        ways = [_Way(along=names[place]) for place in drawn]
    else:
        ways = [_Way(traffic=each) for each in _in_traffic(config, tracks, draw)]
    packed: list[Path] = []
    for way in ways:
        with TemporaryDirectory() as room:
            folder = Path(room) / "drive"
            try:
                record(
                    stage,
                    folder,
                    rig=config.rig,
                    along=way.along,
                    every_m=config.every_m,
                    traffic=way.traffic,
                    scale=config.scale,
                    samples=config.samples,
                    seed=seed % _SEEDS,
                    device=config.device,  # none but the processor gives the same bytes on every worker
                    pictures=config.pictures,
                    slots=config.slots or None,
                    birds_eye=config.birds_eye,
                    points=config.points,
                    sequences=config.also,
                    settings=settings,
                )
            except ConfigError as error:
                if error.field != "ego":
                    raise
                continue  # the traffic leaves no gap for a drive of its own
            packed.append(stage.with_name(f"{stage.stem}.drive_{len(packed)}.zip"))
            _pack(folder, packed[-1])
    return tuple(packed)


class _Way(NamedTuple):
    """Way of a recording: along a proven drive, or in traffic."""

    along: str | None = None
    traffic: Traffic | None = None


def _in_traffic(config: DrivesConfig, tracks: Tracks, draw: np.random.Generator) -> list[Traffic]:
    """Return the recordings of drawn cars that drive; of cars of their own, one from each equal part of the time."""
    if config.ego == AVP:
        begins = (tracks.duration_s / config.count * np.arange(config.count)).tolist()
        return [Traffic(tracks, AVP, config.every_s, (begin, tracks.duration_s)) for begin in begins]
    driven = []
    for track in tracks:
        moves = np.flatnonzero(np.isin(track.state, (AgentState.DRIVES, AgentState.MANOEUVRES)))
        if track.agent.kind in CARS and len(moves) * tracks.step_s >= _LEAST_DRIVE_S:
            driven.append((track.agent.name, float(track.time_s[moves[0]])))
    chosen = [driven[place] for place in draw.permutation(len(driven))[: config.count].tolist()]
    return [Traffic(tracks, name, config.every_s, (begin, begin + config.longest_s)) for name, begin in chosen]


def _pack(folder: Path, path: Path) -> None:
    """Pack a folder into a reproducible ZIP archive, without compression of compressed files."""
    with zipfile.ZipFile(path, "w") as archive:
        for file in sorted(folder.rglob("*")):
            if file.is_file():
                entry = zipfile.ZipInfo(file.relative_to(folder).as_posix(), _FIRST_DATE)
                entry.compress_type = zipfile.ZIP_DEFLATED if file.suffix in _TEXTS else zipfile.ZIP_STORED
                archive.writestr(entry, file.read_bytes())
