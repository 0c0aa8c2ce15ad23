"""The garage's own layer: tiles, building, lane graph and cameras over instances of the prototypes.

Authored as Sdf specs inside one change block with no stage open, so that nothing is composed while writing.
"""

from collections.abc import Mapping
from pathlib import Path

from pxr import Gf, Kind, Sdf, Vt

from garage2usd.grid import Cell, Structure
from garage2usd.lanes import LaneGraph, Square
from garage2usd.layout import Layout, ObjectKind, Placement, Stall
from garage2usd.layout.specs import Spec
from garage2usd.stage.authoring import attribute, define, place, set_units
from garage2usd.stage.cameras import author_cameras, set_frames
from garage2usd.stage.labels import OBJECT_LABELS
from garage2usd.stage.lane_curves import author_lane_graph, square_name
from garage2usd.stage.prototypes import Prototype
from garage2usd.stage.variants import author_variants

__all__ = ["ROOT_NAME", "prim_paths", "write_garage_layer"]

ROOT_NAME = "Garage"

_BUILDING_GROUPS = {
    ObjectKind.WALL: "Walls",
    ObjectKind.PORTAL: "Walls",
    ObjectKind.OBSTACLE: "Obstacles",
    ObjectKind.COLUMN: "Columns",
    ObjectKind.RAMP: "Ramps",
    ObjectKind.SKY: "Ramps",
    ObjectKind.BARRIER: "Ramps",
}
"""Group of each kind of object that belongs to the building, not to a tile."""


def prim_paths(layout: Layout) -> dict[int, str]:
    """Prim path of each placement by its index in ``layout.placements``."""
    return {index: str(_path(placement)) for index, placement in enumerate(layout.placements)}


def write_garage_layer(
    layout: Layout,
    graph: LaneGraph,
    *,
    prototypes: Mapping[Spec, Prototype],
    asset_folder: str,
    metadata: Mapping[str, str | int],
    setback_m: float,
    last_frame: int,
    path: Path,
) -> None:
    """Author the layer that places every prototype.

    Parameters
    ----------
    layout, graph
        What to place, and the kinds of the lane squares.
    prototypes
        Asset and look of every spec in the layout.
    asset_folder
        Folder of the assets, relative to `path`.
    metadata
        Written into the root's customData beside S, R and C.
    setback_m
        How far the carriageway stays from squares that are no lane.
    last_frame
        Last frame of the driving camera, whose asset stands beside the others.
    path
        The file; ``.usda`` or ``.usdc``.
    """
    layer = Sdf.Layer.CreateNew(str(path))
    root_path = Sdf.Path.absoluteRootPath.AppendChild(ROOT_NAME)
    with Sdf.ChangeBlock():
        layer.defaultPrim = ROOT_NAME
        set_units(layer)
        set_frames(layer, last_frame)
        root = define(layer, root_path, "Xform", kind=Kind.Tokens.assembly)
        root.SetInfo("customData", {**metadata, **_matrices(layout.structure)})
        define(layer, root_path.AppendChild("PhysicsScene"), "PhysicsScene")
        _author_tiles(layer, root_path.AppendChild("Tiles"), layout, graph)
        for group in dict.fromkeys(_BUILDING_GROUPS[p.kind] for p in layout.placements if p.square is None):
            define(layer, root_path.AppendChild(group), "Xform", kind=Kind.Tokens.group)
        _author_instances(layer, layout, prototypes, asset_folder)
        author_lane_graph(layer, root_path.AppendChild("LaneGraph"), layout.structure, graph, setback_m=setback_m)
        author_cameras(layer, root_path.AppendChild("Cameras"), layout, graph, asset_folder=asset_folder)
        author_variants(root, layout, prim_paths(layout))
    layer.Save()


def _path(placement: Placement) -> Sdf.Path:
    root = Sdf.Path.absoluteRootPath.AppendChild(ROOT_NAME)
    if placement.square is None:
        return root.AppendChild(_BUILDING_GROUPS[placement.kind]).AppendChild(placement.name)
    return _tile_path(placement.square).AppendChild(placement.name)


def _tile_path(square: Square) -> Sdf.Path:
    return Sdf.Path(f"/{ROOT_NAME}/Tiles/Row_r{square[0]:02d}/Tile_{square_name(square)}")


def _author_tiles(layer: Sdf.Layer, path: Sdf.Path, layout: Layout, graph: LaneGraph) -> None:
    """Row and tile groups; a tile's origin is the middle of its square, where its floor lies."""
    define(layer, path, "Xform", kind=Kind.Tokens.group)
    for floor in layout.of_kind(ObjectKind.FLOOR):
        if floor.square is None:  # pragma: no cover - a floor lies on a square
            continue
        tile_path = _tile_path(floor.square)
        if layer.GetPrimAtPath(tile_path.GetParentPath()) is None:
            define(layer, tile_path.GetParentPath(), "Xform", kind=Kind.Tokens.group)
        label = _tile_label(layout.structure, graph, floor.square)
        place(define(layer, tile_path, "Xform", kind=Kind.Tokens.group, label=label), floor.position_m)


def _author_instances(
    layer: Sdf.Layer, layout: Layout, prototypes: Mapping[Spec, Prototype], asset_folder: str
) -> None:
    """One instanceable reference for each placement, relative to its tile's origin."""
    references = {
        prototype.name: Sdf.ReferenceListOp.Create(
            prependedItems=[Sdf.Reference(f"./{asset_folder}/{prototype.name}.usdc")]
        )
        for prototype in prototypes.values()
    }
    origins = {floor.square: floor.position_m for floor in layout.of_kind(ObjectKind.FLOOR)}
    stalls = {stall.name: stall for stall in layout.stalls}
    for placement in layout.placements:
        prototype = prototypes[placement.spec]
        prim = define(layer, _path(placement), "Xform", label=OBJECT_LABELS[placement.kind])
        prim.SetInfo("references", references[prototype.name])
        prim.instanceable = True
        for name, choice in prototype.look:
            prim.variantSelections[name] = choice
        x, y, z = placement.position_m
        origin_x, _, origin_z = origins.get(placement.square, (0.0, 0.0, 0.0)) if placement.square else (0.0, 0.0, 0.0)
        place(prim, (x - origin_x, y, z - origin_z), placement.yaw_rad)
        if placement.kind is ObjectKind.STALL:
            _describe_stall(prim, stalls[placement.name])


def _describe_stall(prim: Sdf.PrimSpec, stall: Stall) -> None:
    """Id, type, use, lane, mouth and corners (x, z in the world) of a stall as attributes of its prim."""
    types = Sdf.ValueTypeNames
    attribute(prim, "garage:stall:id", types.String, stall.name)
    attribute(prim, "garage:stall:type", types.Token, stall.stall_type.value)
    attribute(prim, "garage:stall:use", types.Token, stall.use.value)
    attribute(prim, "garage:stall:square", types.Int2, Gf.Vec2i(*stall.square))
    attribute(prim, "garage:stall:accessSquare", types.Int2, Gf.Vec2i(*stall.access_square))
    attribute(prim, "garage:stall:entryEdge", types.Token, stall.edge.name.lower())
    corners = Vt.Vec2fArray([Gf.Vec2f(*corner) for corner in stall.corners_m()])
    attribute(prim, "garage:stall:corners", types.Float2Array, corners)


def _tile_label(structure: Structure, graph: LaneGraph, square: Square) -> str:
    if structure.cells[square] == Cell.FREE:
        return f"stall_{graph.stall_types[square].value}"
    return graph.kind(square).value


def _matrices(structure: Structure) -> dict[str, object]:
    """S as rows of symbols, R and C in metres for each column and row."""
    return {
        "S": str(structure),
        "R": Vt.DoubleArray(structure.R[0].tolist()),
        "C": Vt.DoubleArray(structure.C[:, 0].tolist()),
    }
