"""Prototypes of whole tiles: in a large garage equal tiles share one, in a layer beside the assets."""

from collections import defaultdict
from collections.abc import Sequence
from dataclasses import dataclass
from itertools import islice, pairwise
from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from pxr import Sdf

from garage2usd.layout import Layout
from garage2usd.layout.table import KINDS
from garage2usd.stage.arrangement import Arrangement
from garage2usd.stage.authoring import set_units
from garage2usd.stage.instances import InstanceWriter
from garage2usd.stage.prim_text import group_text, place_text
from garage2usd.stage.variants import SWITCHES, Switch

__all__ = ["TILES_FILE", "TilePrototypes", "share_tiles", "write_tile_prototypes"]

TILES_FILE = "Tiles.usdc"
"""Layer of the tile prototypes, beside the assets."""
_SAME_PLACE_M = 1e-5
_SAME_YAW_RAD = 1e-6


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
        Of instances whose assets stand in the folder of the prototypes, without classes.
    """
    objects = layout.placements
    borders = arrangement.borders
    order = arrangement.on_all_tiles()
    origins = np.repeat(arrangement.origins_m, np.diff(borders), axis=0)
    local = objects.position_m[order]
    local[:, [0, 2]] -= origins
    content = np.column_stack(
        [
            arrangement.name[order],
            objects.kind[order],
            objects.spec[order],
            np.rint(local / _SAME_PLACE_M).astype(np.int32),
            np.rint(objects.yaw_rad[order] / _SAME_YAW_RAD).astype(np.int32),
        ]
    )
    names: dict[tuple[str, bytes], str] = {}
    first: list[int] = []
    name_of: list[str] = []
    spans = pairwise((borders - borders[0]).tolist())
    for tile, (label, (start, end)) in enumerate(zip(labels, spans, strict=True)):
        key = label, content[start:end].tobytes()
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


def _followers(layout: Layout, arrangement: Arrangement, rows: NDArray[np.intp]) -> dict[Switch, list[str]]:
    """Names of the objects in some rows that follow each variant set."""
    followers: dict[Switch, list[str]] = defaultdict(list)
    for row in rows.tolist():
        switch = SWITCHES.get(KINDS[layout.placements.kind[row]])
        if switch is not None:
            followers[switch].append(arrangement.names[arrangement.name[row]])
    return dict(followers)


def write_tile_prototypes(shared: TilePrototypes, path: Path) -> None:
    """Write the layer of the prototypes, each a root prim."""
    layer = Sdf.Layer.CreateAnonymous(path.suffix)
    layer.ImportFromString("#usda 1.0\n" + "".join(shared.texts.values()))
    with Sdf.ChangeBlock():
        set_units(layer)
        layer.defaultPrim = next(iter(shared.texts))
    layer.Export(str(path))
