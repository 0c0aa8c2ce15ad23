"""The pictures of one view as files: depth, normals, instances, classes."""

import colorsys
from collections.abc import Collection, Iterable, Mapping
from dataclasses import dataclass
from enum import StrEnum
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray
from PIL import Image

from garage2usd.reading.labels import Labels

__all__ = [
    "Picture",
    "Surfaces",
    "VisibleInstance",
    "class_colour",
    "classes_of",
    "read_depth",
    "read_ids",
    "read_light",
    "read_surfaces",
    "visible_instances",
    "with_needed",
    "write_colour",
    "write_ids",
    "write_mask",
    "write_picture",
    "write_pixels",
]

INDEX_LIMIT = 32768
"""Blender's object indices are below this; larger ids come as several digits."""
_FARTHEST_M = 1e9
_GOLDEN = 0.618034
_SHIFTS = 0, 8, 16
"""Bits of an id before red, green and blue."""


class Picture(StrEnum):
    """The kinds of pictures, each in a folder of its name."""

    COLOUR = "colour"
    DEPTH = "depth"
    NORMALS = "normals"
    INSTANCE = "instance"
    SEMANTIC = "semantic"
    SEMANTIC_PREVIEW = "semantic_preview"

    @property
    def extension(self) -> str:
        """Of its files."""
        return ".exr" if self in {Picture.DEPTH, Picture.NORMALS} else ".png"


def with_needed(kinds: Collection[Picture], needed: Collection[Picture]) -> tuple[Picture, ...]:
    """The kinds of pictures to draw where some are asked for and some are needed to tell something from."""
    return tuple(kind for kind in Picture if kind in kinds or kind in needed)


@dataclass(frozen=True, eq=False)
class Surfaces:
    """What the ray through the middle of each pixel meets first.

    Attributes
    ----------
    depth_m
        Distance as Blender measures it, or from the start of the ray where that is not the camera; infinite where there
        is nothing; float32, shape (rows, columns).
    normal
        Towards the camera's side, in the stage's axes, 0 where there is nothing; float32, shape (rows, columns, 3).
    instance
        Id of the object, 0 for none; int32, shape (rows, columns).
    """

    depth_m: NDArray[np.float32]
    normal: NDArray[np.float32]
    instance: NDArray[np.int32]


@dataclass(frozen=True)
class VisibleInstance:
    """An object that can be seen in a picture.

    Attributes
    ----------
    id
        Its instance id.
    box_px
        Left, top, right and bottom; the last two are the first that it does not reach.
    pixels
        How many show it.
    """

    id: int
    box_px: tuple[int, int, int, int]
    pixels: int

    def joined(self, part: "VisibleInstance") -> "VisibleInstance":
        """The object together with another that is a part of it."""
        (left, top, right, bottom), (part_left, part_top, part_right, part_bottom) = self.box_px, part.box_px
        box = min(left, part_left), min(top, part_top), max(right, part_right), max(bottom, part_bottom)
        return VisibleInstance(self.id, box, self.pixels + part.pixels)


def write_colour(drawn: Path, path: Path, *, seeing: NDArray[np.bool_] | None = None) -> None:
    """Keep the pixels of a picture that Blender drew, without when and how long it drew.

    Where an array of shape (rows, columns) is False they become black.
    """
    with Image.open(drawn) as image:
        pixels = np.asarray(image)
    Image.fromarray(pixels if seeing is None else np.where(seeing[..., None], pixels, 0)).save(path)


def write_pixels(pixels: NDArray[np.uint8], path: Path) -> None:
    """Write a picture of red, green and blue; shape (rows, columns, 3)."""
    Image.fromarray(pixels).save(path)


def read_light(drawn: Path) -> NDArray[np.float32]:
    """The linear red, green and blue of a picture that Blender drew; float32, shape (rows, columns, 3)."""
    import OpenEXR  # noqa: PLC0415 - of an extra

    with OpenEXR.File(str(drawn), separate_channels=True) as file:
        channels = {name.rpartition(".")[2]: np.array(channel.pixels) for name, channel in file.channels().items()}
    light: NDArray[np.float32] = np.stack([channels[name] for name in "RGB"], axis=-1)
    return light


def read_surfaces(
    files: Iterable[Path], from_blender: NDArray[np.float64], starts_m: NDArray[np.float64] | None = None
) -> Surfaces:
    """Read Blender's passes, one file for each digit of the ids.

    Parameters
    ----------
    files
        OpenEXR files of several layers, the least digit first.
    from_blender
        Turn from Blender's axes to the stage's; shape (3, 3).
    starts_m
        Where the rays start in the stage's axes, from where their depth is measured; NaN for pixels that show nothing;
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
    """Each pass of the file by its name; shape (rows, columns, channels), channels X, Y, Z as they are named."""
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
    """The objects of an instance picture by their ids."""
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
    """Colour of a class in previews: hues a golden cut apart; black for 0."""
    if number == 0:
        return 0, 0, 0
    value = (0.95, 0.75, 0.55)[number % 3]
    red, green, blue = colorsys.hsv_to_rgb(number * _GOLDEN % 1.0, 0.65, value)
    return round(red * 255), round(green * 255), round(blue * 255)


def write_picture(kind: Picture, path: Path, surfaces: Surfaces, labels: Labels) -> None:
    """Write one kind of picture of what is seen.

    Parameters
    ----------
    kind
        Any but colour, which Blender writes.
    path
        The file.
    surfaces
        What is seen.
    labels
        Which object is what.
    """
    if kind is Picture.DEPTH:
        _write_exr(path, {"Z": surfaces.depth_m})
    elif kind is Picture.NORMALS:
        _write_exr(path, {axis: surfaces.normal[..., number] for number, axis in enumerate("XYZ")})
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
    """Write ids, shape (rows, columns), as a picture: red + 256 green + 65536 blue."""
    digits = [(ids >> shift & 255).astype(np.uint8) for shift in _SHIFTS]
    Image.fromarray(np.stack(digits, axis=-1)).save(path, optimize=True)


def read_ids(path: Path) -> NDArray[np.int32]:
    """The ids of a picture that `write_ids` wrote; int32, shape (rows, columns)."""
    with Image.open(path) as picture:
        digits = np.asarray(picture).astype(np.int32)
    ids: NDArray[np.int32] = (digits << np.array(_SHIFTS, dtype=np.int32)).sum(axis=-1, dtype=np.int32)
    return ids


def read_depth(path: Path) -> NDArray[np.float32]:
    """The depth of a picture of it; float32, shape (rows, columns)."""
    import OpenEXR  # noqa: PLC0415 - of an extra

    with OpenEXR.File(str(path), separate_channels=True) as file:
        return np.array(file.channels()["Z"].pixels)


def write_mask(mask: NDArray[np.bool_], path: Path) -> None:
    """Write a mask, shape (rows, columns), as a grey picture: white where it holds, black elsewhere."""
    Image.fromarray(np.where(mask, 255, 0).astype(np.uint8)).save(path, optimize=True)


def classes_of(instance: NDArray[np.int32], class_ids: Mapping[int, int]) -> NDArray[np.uint8]:
    """Id of the class of each pixel's object, 0 for none; uint8, shape (rows, columns)."""
    ids, which = np.unique(instance, return_inverse=True)
    classes: NDArray[np.uint8] = np.array([class_ids.get(number, 0) for number in ids.tolist()], dtype=np.uint8)
    return classes[which].reshape(instance.shape)


def _write_exr(path: Path, channels: Mapping[str, NDArray[np.float32]]) -> None:
    import OpenEXR  # noqa: PLC0415 - of an extra

    header: dict[str, Any] = {"compression": OpenEXR.ZIP_COMPRESSION, "type": OpenEXR.scanlineimage}
    whole = {name: np.ascontiguousarray(values, dtype=np.float32) for name, values in channels.items()}
    with OpenEXR.File(header, whole) as file:
        file.write(str(path))
