"""Drives through the garages of a data set, recorded with a rig and packed into one file each."""

import zipfile
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import TYPE_CHECKING, Annotated

from pydantic import Field, field_validator

from garage2usd.common.errors import ConfigError
from garage2usd.common.randomness import Step, generator
from garage2usd.common.settings import Settings
from garage2usd.config.outputs import DriveConfig
from garage2usd.recordings import CloudFormat, Device, check_recording, record
from garage2usd.recordings import Sequence as SequenceFormat
from garage2usd.render import Picture, SlotFormat
from garage2usd.sensors.rays.birds_eye import BirdsEye
from garage2usd.sensors.rig.rig import RIG_NAMES, Rig, read_rig

if TYPE_CHECKING:
    from collections.abc import Sequence

    from garage2usd.driving import StallProof

_TEXTS = {".json", ".yaml"}
_FIRST_DATE = (1980, 1, 1, 0, 0, 0)
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
    scale: float = Field(1.0, gt=0, le=16)
    """Scale of the sides of the pictures."""
    samples: int = Field(64, ge=1, le=65_536)
    """Samples per pixel of the colour picture."""
    pictures: Annotated[tuple[Picture, ...], Field(min_length=1)] = tuple(Picture)
    """Kinds of pictures of the cameras."""
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
        check_recording(
            config.rig.scaled(config.scale),
            pictures=config.pictures,
            slots=config.slots or None,
            birds_eye=config.birds_eye,
            points=config.points,
            sequences=config.also,
        )
    except ConfigError as error:
        raise ConfigError(f"make.drives.{error.field}", error.value, error.allowed) from None


def record_drives(
    stage: Path, config: DrivesConfig, proofs: "Sequence[StallProof]", *, seed: int, settings: DriveConfig
) -> tuple[Path, ...]:
    """Record drives through a garage of a data set.

    Parameters
    ----------
    stage
        Stage of the garage.
    config
        Settings of the drives.
    proofs
        Swept-path proofs of the stalls.
    seed
        Seed of the drawn stalls, the render samples and the LiDARs' noise.
    settings
        Limits of the car's motion.

    Returns
    -------
    tuple of Path
        A file for each drive beside the stage, ``<stem>.drive_0.zip``, with the files of `recordings.record`.
    """
    names = [proof.stall for proof in proofs if proof.way_in is not None]
    drawn = generator(seed, Step.DRIVES).permutation(len(names))[: config.count].tolist()
    packed = []
    for number, place in enumerate(drawn):
        with TemporaryDirectory() as room:
            folder = Path(room) / "drive"
            record(
                stage,
                folder,
                rig=config.rig,
                along=f":{names[place]}",
                every_m=config.every_m,
                scale=config.scale,
                samples=config.samples,
                seed=seed % _SEEDS,
                device=Device.CPU,  # gives the same bytes on every worker
                pictures=config.pictures,
                slots=config.slots or None,
                birds_eye=config.birds_eye,
                points=config.points,
                sequences=config.also,
                settings=settings,
            )
            packed.append(stage.with_name(f"{stage.stem}.drive_{number}.zip"))
            _pack(folder, packed[-1])
    return tuple(packed)


def _pack(folder: Path, path: Path) -> None:
    """Pack a folder into a reproducible ZIP archive, without compression of compressed files."""
    with zipfile.ZipFile(path, "w") as archive:
        for file in sorted(folder.rglob("*")):
            if file.is_file():
                entry = zipfile.ZipInfo(file.relative_to(folder).as_posix(), _FIRST_DATE)
                entry.compress_type = zipfile.ZIP_DEFLATED if file.suffix in _TEXTS else zipfile.ZIP_STORED
                archive.writestr(entry, file.read_bytes())
