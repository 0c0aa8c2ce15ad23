"""Prototypes of whole tiles: in a large garage equal tiles share one, in a layer of their own."""

from collections import defaultdict
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import islice, pairwise
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from garage2usd.layout import Layout
from garage2usd.objects import KINDS
from garage2usd.stage.arrangement import Arrangement
from garage2usd.stage.authoring import new_layer
from garage2usd.stage.instances import InstanceWriter
from garage2usd.stage.prim_text import group_text, place_text
from garage2usd.stage.variants import SWITCHES, Switch

__all__ = ["TILES_FILE", "TilePrototypes", "share_tiles", "write_tile_prototypes"]

TILES_FILE = "Tiles.usdc"
"""Layer of the tile prototypes."""
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
        USDA text of each prototype by its name.
    followers
        Names of the objects on each prototype that follow each variant set.
    """

    name_of: list[str]
    texts: dict[str, str]
    followers: dict[str, dict[Switch, list[str]]]


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
        Of instances for the layer of the prototypes, without classes.
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
        name: group_text(name, islice(objects_of_all, len(rows)), label=label, metadata=metadata, place=place)
        for (label, _), name, rows in zip(names, names.values(), rows_of, strict=True)
    }
    followers = {
        name: _followers(layout, arrangement, rows) for name, rows in zip(names.values(), rows_of, strict=True)
    }
    return TilePrototypes(name_of, texts, followers)


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


def _followers(layout: Layout, arrangement: Arrangement, rows: NDArray[np.intp]) -> dict[Switch, list[str]]:
    """Names of the objects in some rows that follow each variant set."""
    followers: dict[Switch, list[str]] = defaultdict(list)
    for row in rows.tolist():
        switch = SWITCHES.get(KINDS[layout.placements.kind[row]].name)
        if switch is not None:
            followers[switch].append(arrangement.names[arrangement.name[row]].decode("ascii"))
    return dict(followers)


def write_tile_prototypes(shared: TilePrototypes, path: Path) -> None:
    """Write the layer of the prototypes, each a root prim."""
    text = "#usda 1.0\n" + "".join(shared.texts.values())
    with new_layer(path, default_prim=next(iter(shared.texts)), text=text):
        pass
