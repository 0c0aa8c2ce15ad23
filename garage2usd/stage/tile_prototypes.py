"""Prototypes of whole tiles: in a large garage equal tiles share one, a class that they inherit."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import islice, pairwise

import numpy as np

from garage2usd.layout import Layout
from garage2usd.stage.arrangement import Arrangement
from garage2usd.stage.instances import InstanceWriter
from garage2usd.stage.prim_text import group_text, place_text

__all__ = ["TilePrototypes", "share_tiles"]

_SAME_PLACE_M = 1e-5
_SAME_YAW_RAD = 1e-6
_TILES_AT_ONCE = 4096
"""Whose objects are compared in one go, so that those of a large garage are not all there twice."""


@dataclass(frozen=True)
class TilePrototypes:
    """Which prototype each tile shares.

    Attributes
    ----------
    name_of
        Name of the prototype of each tile, in the arrangement's order.
    texts
        USDA text of each prototype, a class, by its name.
    """

    name_of: list[str]
    texts: dict[str, str]


def share_tiles(
    layout: Layout, arrangement: Arrangement, labels: Sequence[str], writer: InstanceWriter
) -> TilePrototypes:
    """Find the tiles of the same label that hold the same objects at the same places.

    Parameters
    ----------
    layout, arrangement
        The objects, and which prim each object is.
    labels
        What a label says of each tile.
    writer
        Of instances.
    """
    names: dict[tuple[str, bytes], str] = {}
    first: list[int] = []
    name_of: list[str] = []
    for tile, key in enumerate(zip(labels, _contents(layout, arrangement), strict=True)):
        name = names.get(key)
        if name is None:
            name = names[key] = f"Tile_{len(names) + 1:04d}"
            first.append(tile)
        name_of.append(name)
    rows_of = [arrangement.on_tile(tile) for tile in first]
    origins = np.repeat(arrangement.origins_m[first], [len(rows) for rows in rows_of], axis=0)
    objects_of_all = writer.texts(np.concatenate(rows_of), origins)
    metadata, place = "instanceable = true\n", place_text(0, 0, 0)
    texts = {
        name: group_text(
            name, islice(objects_of_all, len(rows)), specifier="class", label=label, metadata=metadata, place=place
        )
        for (label, _), name, rows in zip(names, names.values(), rows_of, strict=True)
    }
    return TilePrototypes(name_of, texts)


def _contents(layout: Layout, arrangement: Arrangement) -> Iterator[bytes]:
    """What each tile holds, in names, kinds, shapes and places from its origin; equal for tiles that hold the same."""
    objects, borders = layout.placements, arrangement.borders
    for begin in range(0, len(borders) - 1, _TILES_AT_ONCE):
        tiles = slice(begin, min(begin + _TILES_AT_ONCE, len(borders) - 1))
        spans = borders[tiles.start : tiles.stop + 1]
        rows = arrangement.order[spans[0] : spans[-1]]
        local = objects.position_m[rows]
        local[:, [0, 2]] -= np.repeat(arrangement.origins_m[tiles], np.diff(spans), axis=0)
        content = np.column_stack(
            [
                arrangement.name[rows],
                objects.kind[rows],
                objects.spec[rows],
                np.rint(local / _SAME_PLACE_M).astype(np.int32),
                np.rint(objects.yaw_rad[rows] / _SAME_YAW_RAD).astype(np.int32),
            ]
        )
        for start, end in pairwise((spans - spans[0]).tolist()):
            yield content[start:end].tobytes()
