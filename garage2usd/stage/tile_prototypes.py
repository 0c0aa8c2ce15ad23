"""Prototypes of equal tiles, and of equal parts of tiles, in a large garage, from which the tiles inherit."""

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
"""Number of tiles whose objects are compared at once, which limits memory."""
_SHARED = "instanceable = true\n"


@dataclass(frozen=True)
class TilePrototypes:
    """Assignment of tiles to prototypes.

    Attributes
    ----------
    name_of
        Name of the prototype of each tile, in the arrangement's order.
    texts
        USDA text of each prototype, a class, by its name: parts first, then tiles.
    """

    name_of: list[str]
    texts: dict[str, str]


def share_tiles(
    layout: Layout, arrangement: Arrangement, labels: Sequence[str], writer: InstanceWriter, folder: str
) -> TilePrototypes:
    """Group equal parts of tiles (equal objects at equal places), and tiles with equal labels and parts.

    Parameters
    ----------
    layout, arrangement
        The objects, and the prim of each.
    labels
        Label of each tile.
    writer
        Writer of the instances.
    folder
        Path of the parent prim of the prototypes.
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
    """Yield the content of each part of each tile as bytes: names, kinds, shapes and places relative to the origin."""
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
