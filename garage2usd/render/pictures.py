"""Picture files of a view: colour, depth, normals, instances and classes."""

import colorsys
from collections.abc import Collection, Iterable, Mapping
from dataclasses import dataclass, replace
from enum import StrEnum
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray
from PIL import Image

from garage2usd.reading.labels import Labels
from garage2usd.sensors.rays.lenses import Pinhole

INDEX_LIMIT = 32768
"""Limit of Blender's object indices; larger ids are rendered as several digits."""
_FARTHEST_M = 1e9
_GOLDEN = 0.618034
_SHIFTS = 0, 8, 16
"""Bit shifts of an id's red, green and blue byte."""


class Picture(StrEnum):
    """Kinds of pictures; each kind has a folder of its name."""

    COLOUR = "colour"
    DEPTH = "depth"
    NORMALS = "normals"
    INSTANCE = "instance"
    SEMANTIC = "semantic"
    SEMANTIC_PREVIEW = "semantic_preview"

    @property
    def extension(self) -> str:
        """Extension of the picture's files."""
        return ".exr" if self in {Picture.DEPTH, Picture.NORMALS} else ".png"


def with_needed(kinds: Collection[Picture], needed: Collection[Picture]) -> tuple[Picture, ...]:
    """Return the kinds of pictures to render: the requested ones and those that labels are derived from."""
    return tuple(kind for kind in Picture if kind in kinds or kind in needed)


@dataclass(frozen=True, eq=False)
class Surfaces:
    """First hit of the ray through the middle of each pixel.

    Attributes
    ----------
    depth_m
        Depth as measured by Blender, or distance from the start of the ray for rays that do not start at the camera;
        infinite without a hit; float32, shape (rows, columns).
    normal
        Normal towards the camera's side in the stage's axes, 0 without a hit; float32, shape (rows, columns, 3).
    instance
        Instance id of the object, 0 for none; int32, shape (rows, columns).
    """

    depth_m: NDArray[np.float32]
    normal: NDArray[np.float32]
    instance: NDArray[np.int32]

    def along_axis(self, lens: object) -> "Surfaces":
        """Return the surfaces with depth along the axis of a pinhole, in place of along its rays; others unchanged."""
        if not isinstance(lens, Pinhole):
            return self
        along = lens.rays(lens.middles())[:, 2].reshape(self.depth_m.shape)
        return replace(self, depth_m=(self.depth_m * along).astype(np.float32))


@dataclass(frozen=True)
class VisibleInstance:
    """A visible object of a picture, with its 2D bounding box.

    Attributes
    ----------
    id
        Instance id of the object.
    box_px
        Left, top, right and bottom of the bounding box; right and bottom are exclusive.
    pixels
        Number of pixels that show the object.
    """

    id: int
    box_px: tuple[int, int, int, int]
    pixels: int

    def joined(self, part: "VisibleInstance") -> "VisibleInstance":
        """Merge a visible object with a part of it."""
        (left, top, right, bottom), (part_left, part_top, part_right, part_bottom) = self.box_px, part.box_px
        box = min(left, part_left), min(top, part_top), max(right, part_right), max(bottom, part_bottom)
        return VisibleInstance(self.id, box, self.pixels + part.pixels)


def write_colour(drawn: Path, path: Path, *, seeing: NDArray[np.bool_] | None = None) -> None:
    """Copy the pixels of a picture rendered by Blender, without its metadata of time and duration.

    Pixels become black where `seeing`, of shape (rows, columns), is False.
    """
    with Image.open(drawn) as image:
        pixels = np.asarray(image)
    Image.fromarray(pixels if seeing is None else np.where(seeing[..., None], pixels, 0)).save(path)


def write_pixels(pixels: NDArray[np.uint8], path: Path) -> None:
    """Write an RGB picture; shape (rows, columns, 3)."""
    Image.fromarray(pixels).save(path)


def read_light(drawn: Path) -> NDArray[np.float32]:
    """Read the linear RGB light of a picture rendered by Blender; float32, shape (rows, columns, 3)."""
    import OpenEXR  # noqa: PLC0415 - of an extra

    with OpenEXR.File(str(drawn), separate_channels=True) as file:
        channels = {name.rpartition(".")[2]: np.array(channel.pixels) for name, channel in file.channels().items()}
    return np.stack([channels[name] for name in "RGB"], axis=-1)


def read_surfaces(
    files: Iterable[Path], from_blender: NDArray[np.float64], starts_m: NDArray[np.float64] | None = None
) -> Surfaces:
    """Read Blender's passes of depth, normals and instance ids, one file for each digit of the ids.

    Parameters
    ----------
    files
        Multilayer OpenEXR files, least significant digit first.
    from_blender
        Rotation from Blender's axes to the stage's; shape (3, 3).
    starts_m
        Starting points of the rays in the stage's axes, from which depth is measured; NaN for pixels without a ray;
        shape (rows, columns, 3). None for rays that start at the camera.
    """
    passes = [_passes(path) for path in files]
    first = passes[0]
    depth = first["Depth"][..., 0].astype(np.float32)
    nothing = depth > _FARTHEST_M
    if starts_m is not None:
        places_m = np.stack([first["Position"][..., axis] for axis in range(3)], axis=-1) @ from_blender.T
        depth = np.linalg.norm(places_m - starts_m, axis=-1).astype(np.float32)
        nothing |= np.isnan(depth)
    normal = np.stack([first["Normal"][..., axis] for axis in range(3)], axis=-1) @ from_blender.T
    instance = sum(np.rint(each["IndexOB"][..., 0]).astype(np.int64) * INDEX_LIMIT**d for d, each in enumerate(passes))
    return Surfaces(
        np.where(nothing, np.float32(np.inf), depth),
        np.where(nothing[..., None], 0.0, normal).astype(np.float32),
        np.where(nothing, 0, instance).astype(np.int32),
    )


def _passes(path: Path) -> dict[str, NDArray[np.float32]]:
    """Read the passes of an OpenEXR file by name; shape (rows, columns, channels), channels ordered X, Y, Z."""
    import OpenEXR  # noqa: PLC0415 - of an extra

    found: dict[str, dict[str, NDArray[np.float32]]] = {}
    with OpenEXR.File(str(path), separate_channels=True) as file:
        for part in file.parts:
            for name, channel in part.channels.items():
                *_, of, axis = name.split(".")
                found.setdefault(_NAMES.get(of, of), {})[axis] = np.array(channel.pixels)
    return {of: np.stack([axes[axis] for axis in sorted(axes)], axis=-1) for of, axes in found.items()}


_NAMES = {"Object Index": "IndexOB"}


def visible_instances(instance: NDArray[np.int32]) -> list[VisibleInstance]:
    """List the visible objects of an instance picture, ordered by id."""
    rows, columns = np.nonzero(instance)
    ids, which, counts = np.unique(instance[rows, columns], return_inverse=True, return_counts=True)
    boxes = np.empty((len(ids), 4), dtype=np.int64)
    boxes[:, :2], boxes[:, 2:] = np.iinfo(np.int64).max, 0
    np.minimum.at(boxes[:, 0], which, columns)
    np.minimum.at(boxes[:, 1], which, rows)
    np.maximum.at(boxes[:, 2], which, columns + 1)
    np.maximum.at(boxes[:, 3], which, rows + 1)
    return [
        VisibleInstance(number, (left, top, right, bottom), count)
        for number, (left, top, right, bottom), count in zip(ids.tolist(), boxes.tolist(), counts.tolist(), strict=True)
    ]


def class_colour(number: int) -> tuple[int, int, int]:
    """Return the preview colour of a semantic class: hues spaced by the golden ratio; black for 0."""
    if number == 0:
        return 0, 0, 0
    value = (0.95, 0.75, 0.55)[number % 3]
    red, green, blue = colorsys.hsv_to_rgb(number * _GOLDEN % 1.0, 0.65, value)
    return round(red * 255), round(green * 255), round(blue * 255)


def write_picture(kind: Picture, path: Path, surfaces: Surfaces, labels: Labels) -> None:
    """Write one kind of picture of the visible surfaces.

    Parameters
    ----------
    kind
        Any kind except colour, which Blender writes.
    path
        The file.
    surfaces
        Visible surfaces of the view.
    labels
        Table of labels of the stage.
    """
    if kind is Picture.DEPTH:
        write_exr(path, {"Z": surfaces.depth_m})
    elif kind is Picture.NORMALS:
        write_exr(path, {axis: surfaces.normal[..., number] for number, axis in enumerate("XYZ")})
    elif kind is Picture.INSTANCE:
        write_ids(labels.instances_of(surfaces.instance), path)
    else:
        classes = classes_of(surfaces.instance, labels.class_ids)
        if kind is Picture.SEMANTIC_PREVIEW:
            colours = np.array([class_colour(number) for number in range(256)], dtype=np.uint8)
            Image.fromarray(colours[classes]).save(path, optimize=True)
        else:
            Image.fromarray(classes).save(path, optimize=True)


def write_ids(ids: NDArray[np.int32], path: Path) -> None:
    """Write an id picture, shape (rows, columns), as PNG with the id red + 256 green + 65536 blue."""
    digits = [(ids >> shift & 255).astype(np.uint8) for shift in _SHIFTS]
    Image.fromarray(np.stack(digits, axis=-1)).save(path, optimize=True)


def read_ids(path: Path) -> NDArray[np.int32]:
    """Read the ids of a picture written by `write_ids`; int32, shape (rows, columns)."""
    with Image.open(path) as picture:
        digits = np.asarray(picture).astype(np.int32)
    ids: NDArray[np.int32] = (digits << np.array(_SHIFTS, dtype=np.int32)).sum(axis=-1, dtype=np.int32)
    return ids


def read_depth(path: Path) -> NDArray[np.float32]:
    """Read a depth picture; float32, shape (rows, columns)."""
    import OpenEXR  # noqa: PLC0415 - of an extra

    with OpenEXR.File(str(path), separate_channels=True) as file:
        return np.array(file.channels()["Z"].pixels)


def write_mask(mask: NDArray[np.bool_], path: Path) -> None:
    """Write a mask, shape (rows, columns), as a grey picture: white for True, black for False."""
    Image.fromarray(np.where(mask, 255, 0).astype(np.uint8)).save(path, optimize=True)


def classes_of(instance: NDArray[np.int32], class_ids: Mapping[int, int]) -> NDArray[np.uint8]:
    """Return the class id of each pixel's object, 0 for none; uint8, shape (rows, columns)."""
    ids, which = np.unique(instance, return_inverse=True)
    classes: NDArray[np.uint8] = np.array([class_ids.get(number, 0) for number in ids.tolist()], dtype=np.uint8)
    return classes[which].reshape(instance.shape)


def write_exr(path: Path, channels: Mapping[str, NDArray[np.float32]]) -> None:
    """Write channels, shape (rows, columns), as an OpenEXR file of 32-bit floats."""
    import OpenEXR  # noqa: PLC0415 - of an extra

    header: dict[str, Any] = {"compression": OpenEXR.ZIP_COMPRESSION, "type": OpenEXR.scanlineimage}
    whole = {name: np.ascontiguousarray(values, dtype=np.float32) for name, values in channels.items()}
    with OpenEXR.File(header, whole) as file:
        file.write(str(path))
