"""Strips of a data set whose garages a car with `strips_rig.toml` drove through, as a folder of drawn garages."""

import json
import tarfile
import zipfile
from collections.abc import Iterator
from io import BytesIO
from pathlib import Path

import numpy as np
from drawn_folder import write_drawn
from drawn_strips import entry_corners
from strips import SIDES, write_strips

from garage2usd.common.errors import ConfigError
from garage2usd.datasets import load_recipe
from garage2usd.datasets.recipe import RECIPE_FILE
from garage2usd.datasets.shards import SHARD_FOLDER, shard_members

__all__ = ["convert"]

_DRIVE = ".drive_0.zip"


def convert(dataset: Path, folder: Path, *, pictures: int) -> Iterator[tuple[Path, int]]:
    """Write strips with an entry corner in them of each garage's first drive.

    Parameters
    ----------
    dataset
        The data set. Its drives have colour pictures and slots of the cameras ``left`` and ``right``.
    folder
        Gets a folder of strips for each garage, and the file that `drawn_folder.read_drawn` reads.
    pictures
        How many of each garage at most, spread over the drive; fewer where fewer show a corner.

    Yields
    ------
    tuple
        Folder of each garage that has such strips, and their number.

    Raises
    ------
    ConfigError
        If the data set cannot be read, or none of its garages has a strip; names the shard.
    """
    form = load_recipe(dataset / RECIPE_FILE).shards.form
    garages = []
    for shard in sorted(rows.stem for rows in (dataset / SHARD_FOLDER).glob("*.jsonl")):  # those that are complete
        try:
            for name, packed in shard_members(dataset, shard, form):
                if name.endswith(_DRIVE):
                    garage = folder / name.removesuffix(_DRIVE)
                    if written := _strips(packed, garage, pictures):
                        garages.append(garage)
                        yield garage, written
        except (OSError, tarfile.TarError, zipfile.BadZipFile, KeyError, ValueError):
            raise ConfigError("DATASET", f"{dataset}, {shard}", "drives with colour and slots of strips") from None
    if not garages:
        raise ConfigError("DATASET", str(dataset), f"drives with entry corners in pictures of {' or '.join(SIDES)}")
    write_drawn(folder, garages)


def _strips(packed: bytes, folder: Path, pictures: int) -> int:
    """Write the strips of a drive; none if no corner is in them."""
    named = {}
    with zipfile.ZipFile(BytesIO(packed)) as drive:
        corners = entry_corners(json.loads(drive.read("slots.json")))
        frames = json.loads(drive.read("frames.json"))["frames"]
        shown = [frame for frame in frames if frame["camera"] in SIDES and corners[frame["name"]]]
        for number in np.unique(np.linspace(0, len(shown) - 1, min(pictures, len(shown))).round().astype(int)).tolist():
            frame = shown[number]
            source = Path(frame["files"]["colour"])
            place = Path(f"{folder.name}_{frame['camera']}", source.name)
            (folder / place).parent.mkdir(parents=True, exist_ok=True)
            (folder / place).write_bytes(drive.read(source.as_posix()))
            named[place.as_posix()] = corners[frame["name"]]
    if named:
        write_strips(folder, named)
    return len(named)
