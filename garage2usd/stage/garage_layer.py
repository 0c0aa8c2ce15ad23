"""The garage's root layer: tiles, building, lane graph and cameras, with instances of the prototypes.

The many instances are written as text, which USD parses faster than Python can author them; the frame around them is
authored as Sdf specs in one change block. No stage is open, so that nothing is composed while writing.
"""
# Over 300 lines: all that stands below the root is authored in one change block, point instancers too.

import math
import posixpath
from collections.abc import Iterable, Iterator, Mapping, Sequence
from itertools import islice
from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from pxr import Gf, Kind, Sdf, Vt

from garage2usd.common.processes import without_collector
from garage2usd.config.outputs import UpAxis
from garage2usd.garage.levels import GARAGE_NAME
from garage2usd.layout import Layout, ObjectTable
from garage2usd.objects import KINDS, Spec
from garage2usd.stage.arrangement import Arrangement, row_name, tile_name
from garage2usd.stage.asset_files import OWN_ASSETS
from garage2usd.stage.authoring import (
    anchored,
    attribute,
    define,
    group_pieces,
    group_text,
    inherits_text,
    moved_text,
    new_layer,
    numbers,
    place_text,
    reference_text,
    relationship,
    rounded_m,
    save,
    set_units,
    turn_text,
)
from garage2usd.stage.cameras import author_cameras, set_frames
from garage2usd.stage.curves import LANE_GRAPH_FILE, STALL_OUTLINES, write_lane_graph
from garage2usd.stage.instances import InstanceWriter, TilePrototypes, share_tiles
from garage2usd.stage.labels import world_bounds_m
from garage2usd.stage.prototypes import Prototype
from garage2usd.stage.variants import OCCUPIED_STALL, SWITCHES, variant_texts

_TYPES = Sdf.ValueTypeNames
_CLASSES = "Classes"
"""Scope of the classes from which objects of a variant set inherit."""
_TILE_CLASSES = "TilePrototypes"
"""Scope of the classes from which equal tiles, and equal parts of tiles, inherit."""
_PHYSICS = "PhysicsScene"
"""Type and name of the prim that follows the garage's content."""


def write_instancer(
    path: Path,
    objects: ObjectTable,
    rows: NDArray[np.intp],
    prototypes: Mapping[Spec, Prototype],
    *,
    name: str,
    asset_folder: str,
    own_assets: str,
) -> None:
    """Write a layer with a point instancer `name`, with a point for each object in `rows`, all of one kind.

    The paths `asset_folder` and `own_assets` of its assets are relative to the layer.

    Notes
    -----
    Objects with colliders are excluded, since physics engines ignore colliders of point instancers. Some browser
    viewers draw only one copy.
    """
    shapes, indices = np.unique(objects.spec[rows], return_inverse=True)
    specs = [objects.specs[shape] for shape in shapes]
    root = Sdf.Path.absoluteRootPath.AppendChild(name)
    with new_layer(path, default_prim=name) as layer:
        prim = define(layer, root, "PointInstancer", kind=Kind.Tokens.group, label=KINDS[objects.kind[rows[0]]].label)
        _author_prototypes(prim, [prototypes[spec] for spec in specs], (asset_folder, own_assets))
        _author_points(prim, objects, rows, indices)


def _author_prototypes(instancer: Sdf.PrimSpec, prototypes: Sequence[Prototype], assets: tuple[str, str]) -> None:
    folder = define(instancer.layer, instancer.path.AppendChild("Prototypes"), "Scope", kind=Kind.Tokens.group)
    targets = []
    for prototype in prototypes:
        child = define(instancer.layer, folder.path.AppendChild(prototype.name), "Xform")
        layer, root = prototype.place(*assets)
        reference = Sdf.Reference(layer, f"/{root}" if root else Sdf.Path.emptyPath)
        child.SetInfo("references", Sdf.ReferenceListOp.Create(prependedItems=[reference]))
        targets.append(child.path)
    relationship(instancer, "prototypes", targets)


def _author_points(prim: Sdf.PrimSpec, objects: ObjectTable, rows: NDArray[np.intp], indices: NDArray[np.intp]) -> None:
    positions, yaws_rad = objects.position_m[rows], objects.yaw_rad[rows]
    numbers(prim, "protoIndices", indices)
    attribute(prim, "positions", _TYPES.Point3fArray, Vt.Vec3fArray.FromNumpy(positions.astype(np.float32)))
    turns = {yaw: Gf.Quath(math.cos(yaw / 2), 0.0, math.sin(yaw / 2), 0.0) for yaw in set(yaws_rad.tolist())}
    attribute(prim, "orientations", _TYPES.QuathArray, Vt.QuathArray([turns[yaw] for yaw in yaws_rad.tolist()]))
    least, greatest = world_bounds_m(objects, rows)
    extent = np.stack([least.min(axis=0), greatest.max(axis=0)]).astype(np.float32)
    attribute(prim, "extent", _TYPES.Float3Array, Vt.Vec3fArray.FromNumpy(extent))


@without_collector()
def write_garage_layer(
    layout: Layout,
    *,
    arrangement: Arrangement,
    prototypes: Mapping[Spec, Prototype],
    own: str,
    asset_folder: str,
    metadata: Mapping[str, str | int],
    last_frame: int,
    path: Path,
    is_compact: bool = False,
    up_axis: UpAxis = UpAxis.Y,
) -> None:
    """Author the layer that places all prototypes, and beside the assets the layers of this garage alone.

    Parameters
    ----------
    layout
        The layout to write.
    arrangement
        Prim of each object.
    prototypes
        Asset and variant choices of every spec in the layout.
    own
        Path prefix of the layers of this garage alone, relative to the folder of `path`: the lane graph, assets that
        are not shared, and the point instancers if tiles share prototypes.
    asset_folder
        Folder of the assets, relative to that of `path`, with forward slashes.
    metadata
        Entries of the root's customData, in addition to S, R and C.
    last_frame
        Last frame of the driving camera, whose layer stands beside the lane graph.
    path
        The file; ``.usda`` or ``.usdc``.
    is_compact
        True to write a ``.usda`` without indentation, for programs: two thirds of the bytes and half of the time, as
        USD does not parse and rewrite it.
    up_axis
        Axis of the stage that points up.
    """
    writer = InstanceWriter(
        layout,
        arrangement,
        prototypes,
        anchored(asset_folder),
        f"./{own}{OWN_ASSETS}",
        classes=f"/{GARAGE_NAME}/{_CLASSES}",
        describe_stalls=not arrangement.nested,
    )
    frame = _frame(layout, arrangement, own, metadata, last_frame, up_axis)
    if is_compact:
        with path.open("w", encoding="utf-8", newline="\n") as file:
            file.writelines(_pieces(frame, layout, arrangement, writer, own))
    else:
        layer = Sdf.Layer.CreateAnonymous(path.suffix)
        layer.ImportFromString("".join(_pieces(frame, layout, arrangement, writer, own)))
        save(layer, path)
        # one layer at a time: in a large garage each takes 100 MB of memory
        del layer
    write_lane_graph(path.parent / f"{own}{LANE_GRAPH_FILE}", layout)
    beside = anchored(posixpath.relpath(asset_folder, posixpath.dirname(own) or "."))
    for name, rows in arrangement.scattered.items():
        layer_path = path.parent / f"{own}{name}.usdc"
        write_instancer(
            layer_path,
            layout.placements,
            rows,
            prototypes,
            name=name,
            asset_folder=beside,
            own_assets=f"./{posixpath.basename(own)}{OWN_ASSETS}",
        )


def _frame(
    layout: Layout,
    arrangement: Arrangement,
    own: str,
    metadata: Mapping[str, str | int],
    last_frame: int,
    up_axis: UpAxis,
) -> str:
    """The layer without the garage's content, as USD writes it."""
    variants = variant_texts(
        _CLASSES,
        outlines=STALL_OUTLINES,
        stalls=len(layout.stalls),
        are_blocked=bool(layout.blocked),
        selected=not arrangement.nested,
    )
    names = dict.fromkeys(switch.class_name for switch in SWITCHES.values())
    classes = "".join(f'class "{name}"\n{{\n}}\n' for name in (*names, OCCUPIED_STALL))
    layer = Sdf.Layer.CreateAnonymous(".usda")
    layer.ImportFromString(
        f'#usda 1.0\ndef Xform "{GARAGE_NAME}" (\nkind = "assembly"\n{variants.metadata})\n{{\n'
        f"{turn_text(up_axis)}{variants.body}"
        f'class "{_CLASSES}"\n{{\n{classes}}}\n}}\n'
    )
    root_path = Sdf.Path.absoluteRootPath.AppendChild(GARAGE_NAME)
    with Sdf.ChangeBlock():
        layer.defaultPrim = GARAGE_NAME
        set_units(layer, up_axis)
        set_frames(layer, last_frame)
        layer.GetPrimAtPath(root_path).SetInfo("customData", {**metadata, **_matrices(layout)})
        define(layer, root_path.AppendChild(_PHYSICS), _PHYSICS)
        author_cameras(layer, root_path.AppendChild("Cameras"), layout, own=own)
    text: str = layer.ExportToString()
    return text


def _pieces(
    frame: str,
    layout: Layout,
    arrangement: Arrangement,
    writer: InstanceWriter,
    own: str,
) -> Iterator[str]:
    """Yield the text of the layer: the content of the garage within its frame, then the prototypes of tiles."""
    before, physics, after = frame.partition(f'    def {_PHYSICS} "{_PHYSICS}"')
    yield before
    labels = [layout.source.label_of_square(row, col) for row, col in arrangement.squares.tolist()]
    tile_classes: Iterable[str] = ()
    if arrangement.nested:
        shared = share_tiles(layout, arrangement, labels, writer, f"/{_TILE_CLASSES}")
        tiles, tile_classes = _shared_tiles(arrangement, shared), _tile_classes(shared)
    else:
        tiles = _tiles(arrangement, labels, writer)
    yield from group_pieces("Tiles", tiles)
    for name, rows in arrangement.groups.items():
        yield from group_pieces(name, writer.texts(rows))
    for file in (LANE_GRAPH_FILE, *(f"{name}.usdc" for name in arrangement.scattered)):
        yield _part_text(own, file)
    yield physics + after
    yield from tile_classes


def _tiles(arrangement: Arrangement, labels: Iterable[str], writer: InstanceWriter) -> Iterator[str]:
    """Yield the groups of rows and tiles."""
    counts = np.diff(arrangement.borders)
    objects = writer.texts(arrangement.on_all_tiles(), np.repeat(arrangement.origins_m, counts, axis=0))
    texts = (
        group_text(tile_name(row, col), islice(objects, count), label=label, place=place_text(x, 0.0, 0.0))
        for (row, col), x, count, label in zip(
            arrangement.squares.tolist(), rounded_m(arrangement.origins_m[:, 0]), counts.tolist(), labels, strict=True
        )
    )
    return _rows(arrangement, texts)


def _shared_tiles(arrangement: Arrangement, shared: TilePrototypes) -> Iterator[str]:
    """Yield the groups of rows, with an instance of a prototype for each tile.

    A tile inherits from its prototype, which opens faster than a reference to another layer.
    """
    headers = {name: inherits_text(f"/{_TILE_CLASSES}/{name}") for name in shared.texts}
    texts = (
        f'def "{tile_name(row, col)}" (\n{headers[name]})\n{{\n{moved_text(x)}}}\n'
        for (row, col), x, name in zip(
            arrangement.squares.tolist(), rounded_m(arrangement.origins_m[:, 0]), shared.name_of, strict=True
        )
    )
    return _rows(arrangement, texts)


def _tile_classes(shared: TilePrototypes) -> Iterator[str]:
    """Yield the prototypes of tiles, outside the garage, whose variant sets USD would evaluate for each tile below it.

    They are composed only through the tiles: the classes themselves are inactive.
    """
    yield f'class "{_TILE_CLASSES}" (\nactive = false\n)\n{{\n'
    yield from shared.texts.values()
    yield "}\n"


def _rows(arrangement: Arrangement, tiles: Iterator[str]) -> Iterator[str]:
    """Yield the groups of rows with their tiles; the origin of a tile is the centre of its square on the floor.

    A row has the translation along Z and a tile the one along X, so that equal translations share one value.
    """
    first, counts = np.unique(arrangement.squares[:, 0], return_index=True, return_counts=True)[1:]
    rows, places = arrangement.squares[first, 0].tolist(), rounded_m(arrangement.origins_m[first, 1])
    for row, z, count in zip(rows, places, counts.tolist(), strict=True):
        yield from group_pieces(row_name(row), islice(tiles, count), place=place_text(0.0, 0.0, z))


def _part_text(own: str, file: str) -> str:
    """Text of a prim whose content is in a separate layer."""
    return f'def "{Path(file).stem}" (\n{reference_text(f"./{own}{file}")})\n{{\n}}\n'


def _matrices(layout: Layout) -> dict[str, object]:
    """Return S as rows of symbols, R and C in metres by column and row, and the fire compartment of each square."""
    structure = layout.matrices
    if structure is None:
        return {}
    return {
        "S": str(structure),
        "R": Vt.DoubleArray(structure.R[0].tolist()),
        "C": Vt.DoubleArray(structure.C[:, 0].tolist()),
        "fireCompartments": Vt.IntArray(layout.compartments.ravel().tolist()),
    }
