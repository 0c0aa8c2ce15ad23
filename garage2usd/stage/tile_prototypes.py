"""Prototypes of tiles and of their parts: in a large garage equal ones share one, a class that they inherit."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import islice, pairwise

import numpy as np

from garage2usd.layout import Layout
from garage2usd.stage.arrangement import Arrangement
from garage2usd.stage.instances import InstanceWriter
from garage2usd.stage.prim_text import group_text, inherits_text, place_text

__all__ = ["TilePrototypes", "share_tiles"]

_SAME_PLACE_M = 1e-5
_SAME_YAW_RAD = 1e-6
_TILES_AT_ONCE = 4096
"""Whose objects are compared in one go, so that those of a large garage are not all there twice."""
_SHARED = "instanceable = true\n"


@dataclass(frozen=True)
class TilePrototypes:
    """Which prototype each tile shares.

    Attributes
    ----------
    name_of
        Name of the prototype of each tile, in the arrangement's order.
    texts
        USDA text of each prototype, a class, by its name: those of parts, then those of tiles.
    """

    name_of: list[str]
    texts: dict[str, str]


def share_tiles(
    layout: Layout, arrangement: Arrangement, labels: Sequence[str], writer: InstanceWriter, folder: str
) -> TilePrototypes:
    """Find the parts of tiles that hold the same objects at the same places, and the tiles of same label and parts.

    Parameters
    ----------
    layout, arrangement
        The objects, and which prim each object is.
    labels
        What a label says of each tile.
    writer
        Of instances.
    folder
        Path of the prim below which the prototypes are to stand.
    """
    names: dict[tuple[str, tuple[bytes, ...]], str] = {}
    name_of: list[str] = []
    first_part: dict[tuple[str, bytes], int] = {}
    for tile, key in enumerate(zip(labels, _contents(layout, arrangement), strict=True)):
        name = names.get(key)
        if name is None:
            name = names[key] = f"Tile_{len(names) + 1:04d}"
            for number, part in enumerate(zip(arrangement.parts, key[1], strict=True), len(arrangement.parts) * tile):
                first_part.setdefault(part, number)
        name_of.append(name)
    part_names = {
        part: f"{part[0]}_{number:04d}" for number, part in enumerate((part for part in first_part if part[1]), 1)
    }
    rows_of = [arrangement.on_part(first_part[part]) for part in part_names]
    tile_of = np.array([first_part[part] for part in part_names]) // len(arrangement.parts)
    origins = np.repeat(arrangement.origins_m[tile_of], [len(rows) for rows in rows_of], axis=0)
    objects = writer.texts(np.concatenate(rows_of), origins)
    texts = {
        name: group_text(name, islice(objects, len(rows)), specifier="class", metadata=_SHARED)
        for name, rows in zip(part_names.values(), rows_of, strict=True)
    }
    place = place_text(0, 0, 0)
    for (label, pieces), name in names.items():
        children = (
            f'def "{part}" (\n{inherits_text(f"{folder}/{part_names[part, piece]}")})\n{{\n}}\n'
            for part, piece in zip(arrangement.parts, pieces, strict=True)
            if piece
        )
        texts[name] = group_text(name, children, specifier="class", label=label, metadata=_SHARED, place=place)
    return TilePrototypes(name_of, texts)


def _contents(layout: Layout, arrangement: Arrangement) -> Iterator[tuple[bytes, ...]]:
    """What each part of each tile holds, in names, kinds, shapes and places from the tile's origin, as bytes."""
    objects, count = layout.placements, len(arrangement.parts)
    for begin in range(0, len(arrangement.squares), _TILES_AT_ONCE):
        origins_m = arrangement.origins_m[begin : begin + _TILES_AT_ONCE]
        borders = arrangement.borders[count * begin : count * (begin + len(origins_m)) + 1]
        rows = arrangement.order[borders[0] : borders[-1]]
        local = objects.position_m[rows]
        local[:, [0, 2]] -= np.repeat(origins_m, np.diff(borders[::count]), axis=0)
        content = np.column_stack(
            [
                arrangement.name[rows],
                objects.kind[rows],
                objects.spec[rows],
                np.rint(local / _SAME_PLACE_M).astype(np.int32),
                np.rint(objects.yaw_rad[rows] / _SAME_YAW_RAD).astype(np.int32),
            ]
        )
        in_bytes, ends = content.tobytes(), ((borders - borders[0]) * content.strides[0]).tolist()
        pieces = (in_bytes[start:end] for start, end in pairwise(ends))
        yield from zip(*[pieces] * count, strict=True)
