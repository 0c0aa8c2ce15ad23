"""The garage's own layer: tiles, building and cameras as instances of the prototypes.

Authored as Sdf specs inside one change block with no stage open, so that nothing is composed while writing.
"""

import math
from collections.abc import Mapping
from itertools import groupby
from pathlib import Path

from pxr import Gf, Kind, Sdf, UsdGeom, UsdPhysics, Vt

from garage2usd.grid import Cell, Structure
from garage2usd.lanes import LaneGraph, Square
from garage2usd.layout import Layout, ObjectKind, Placement
from garage2usd.layout.specs import Spec
from garage2usd.stage.prototype_layer import LABEL_TAXONOMY

__all__ = ["OBJECT_LABELS", "ROOT_NAME", "write_garage_layer"]

ROOT_NAME = "Garage"

OBJECT_LABELS: dict[ObjectKind, str] = {
    ObjectKind.FLOOR: "floor",
    ObjectKind.STALL: "parking_stall",
    ObjectKind.CEILING: "ceiling",
    ObjectKind.WALL: "wall",
    ObjectKind.PORTAL: "vehicle_door",
    ObjectKind.OBSTACLE: "obstacle",
    ObjectKind.COLUMN: "column",
    ObjectKind.LIGHT: "light",
    ObjectKind.DUCT: "duct",
    ObjectKind.SPEED_BUMP: "speed_bump",
    ObjectKind.WHEEL_STOP: "wheel_stop",
    ObjectKind.NO_PARKING_SIGN: "traffic_sign",
    ObjectKind.CAR: "car",
    ObjectKind.RAMP: "ramp",
    ObjectKind.SKY: "sky",
    ObjectKind.BARRIER: "barrier",
    ObjectKind.STALL_NUMBER: "stall_number",
    ObjectKind.CHARGER: "charger",
    ObjectKind.SPRINKLER: "sprinkler",
    ObjectKind.EXIT_SIGN: "exit_sign",
    ObjectKind.MIRROR: "mirror",
}
"""Semantic class of each kind of object, authored on every instance root."""

_BUILDING_GROUPS = {
    "Walls": (ObjectKind.WALL, ObjectKind.PORTAL),
    "Obstacles": (ObjectKind.OBSTACLE,),
    "Columns": (ObjectKind.COLUMN,),
    "Ramps": (ObjectKind.RAMP, ObjectKind.SKY, ObjectKind.BARRIER),
}


def write_garage_layer(
    layout: Layout,
    graph: LaneGraph,
    *,
    prototypes: Mapping[Spec, str],
    asset_folder: str,
    metadata: Mapping[str, str | int],
    path: Path,
) -> None:
    """Author the layer that places every prototype.

    Parameters
    ----------
    layout, graph
        What to place, and the kinds of the lane squares.
    prototypes
        Asset name of every spec in the layout.
    asset_folder
        Folder of the assets, relative to `path`.
    metadata
        Written into the root's customData beside S, R and C.
    path
        The file; ``.usda`` or ``.usdc``.
    """
    layer = Sdf.Layer.CreateNew(str(path))
    root_path = Sdf.Path.absoluteRootPath.AppendChild(ROOT_NAME)
    with Sdf.ChangeBlock():
        layer.defaultPrim = ROOT_NAME
        pseudo_root = layer.pseudoRoot
        pseudo_root.SetInfo(UsdGeom.Tokens.upAxis, UsdGeom.Tokens.y)
        pseudo_root.SetInfo(UsdGeom.Tokens.metersPerUnit, 1.0)
        pseudo_root.SetInfo(UsdPhysics.Tokens.kilogramsPerUnit, 1.0)
        root = _prim(layer, root_path, "Xform", kind=Kind.Tokens.assembly)
        root.SetInfo("customData", {**metadata, **_matrices(layout.structure)})

        author = _InstanceAuthor(layer, prototypes, asset_folder)
        _prim(layer, root_path.AppendChild("PhysicsScene"), "PhysicsScene")
        _author_tiles(layer, root_path.AppendChild("Tiles"), layout, graph, author)
        _author_building(layer, root_path, layout, author)
        _author_cameras(layer, root_path.AppendChild("Cameras"), layout, graph)
    layer.Save()


class _InstanceAuthor:
    """Authors instances of prototypes with what all of them share."""

    def __init__(self, layer: Sdf.Layer, prototypes: Mapping[Spec, str], asset_folder: str) -> None:
        self._layer = layer
        self._references = {
            spec: Sdf.ReferenceListOp.Create(
                prependedItems=[Sdf.Reference(f"./{asset_folder}/{name}.usdc")],
            )
            for spec, name in prototypes.items()
        }

    def instance(self, path: Sdf.Path, placement: Placement, origin_m: tuple[float, float]) -> None:
        """One instanceable reference, placed relative to its parent's origin."""
        prim = _prim(self._layer, path, "Xform", label=OBJECT_LABELS[placement.kind])
        prim.SetInfo("references", self._references[placement.spec])
        prim.instanceable = True
        x, y, z = placement.position_m
        _place(prim, (x - origin_m[0], y, z - origin_m[1]), placement.yaw_rad)


def _author_tiles(layer: Sdf.Layer, path: Sdf.Path, layout: Layout, graph: LaneGraph, author: _InstanceAuthor) -> None:
    """Row and tile groups; a tile's origin is the middle of its square, where its floor lies."""
    _prim(layer, path, "Xform", kind=Kind.Tokens.group)
    on_tiles = [placement for placement in layout.placements if placement.square is not None]
    for row, in_row in groupby(on_tiles, key=lambda placement: (placement.square or (0, 0))[0]):
        row_path = path.AppendChild(f"Row_r{row:02d}")
        _prim(layer, row_path, "Xform", kind=Kind.Tokens.group)
        for square, on_tile in groupby(in_row, key=lambda placement: placement.square or (0, 0)):
            placements = list(on_tile)
            tile_path = row_path.AppendChild(f"Tile_r{square[0]:02d}_c{square[1]:02d}")
            label = _tile_label(layout.structure, graph, square)
            tile = _prim(layer, tile_path, "Xform", kind=Kind.Tokens.group, label=label)
            x, _, z = next(p.position_m for p in placements if p.kind is ObjectKind.FLOOR)
            _place(tile, (x, 0.0, z), 0.0)
            for placement in placements:
                author.instance(tile_path.AppendChild(placement.name), placement, (x, z))


def _tile_label(structure: Structure, graph: LaneGraph, square: Square) -> str:
    if structure.cells[square] == Cell.FREE:
        return f"stall_{graph.stall_types[square].value}"
    return graph.kind(square).value


def _author_building(layer: Sdf.Layer, root: Sdf.Path, layout: Layout, author: _InstanceAuthor) -> None:
    for group, kinds in _BUILDING_GROUPS.items():
        placements = [placement for placement in layout.placements if placement.kind in kinds]
        if not placements:
            continue
        path = root.AppendChild(group)
        _prim(layer, path, "Xform", kind=Kind.Tokens.group)
        for placement in placements:
            author.instance(path.AppendChild(placement.name), placement, (0.0, 0.0))


def _author_cameras(layer: Sdf.Layer, path: Sdf.Path, layout: Layout, graph: LaneGraph) -> None:
    """A camera at a driver's eye on the lane behind the first entrance, and one over the whole garage."""
    _prim(layer, path, "Scope")
    entrance = layout.structure.where(Cell.ENTRANCE)[0]
    nodes = graph.graph.nodes
    lane = min(graph.graph[entrance])
    x, z = nodes[entrance]["x_m"], nodes[entrance]["z_m"]
    yaw = math.degrees(math.atan2(x - nodes[lane]["x_m"], z - nodes[lane]["z_m"]))
    _camera(layer, path.AppendChild("Inside"), (x, 1.5, z), (0.0, yaw), focal_mm=20)

    width, depth = layout.structure.column_edges_m[-1], layout.structure.row_edges_m[-1]
    height = 1.15 * max(width * 20 / 36, depth * 20 / 20.25)
    _camera(
        layer,
        path.AppendChild("Above"),
        (width / 2, height + layout.ceiling_height_m, depth / 2),
        (-90.0, 0.0),
        focal_mm=20,
    )


def _camera(
    layer: Sdf.Layer,
    path: Sdf.Path,
    position: tuple[float, float, float],
    turn_deg: tuple[float, float],
    *,
    focal_mm: float,
) -> None:
    camera = _prim(layer, path, "Camera")
    # focal length and aperture are tenths of a stage unit
    for name, value in (("focalLength", focal_mm / 100), ("horizontalAperture", 0.36), ("verticalAperture", 0.2025)):
        Sdf.AttributeSpec(camera, name, Sdf.ValueTypeNames.Float).default = value
    clipping = Sdf.AttributeSpec(camera, "clippingRange", Sdf.ValueTypeNames.Float2)
    clipping.default = Gf.Vec2f(0.1, 2000.0)
    _operation(camera, "translate", Sdf.ValueTypeNames.Float3, Gf.Vec3f(*position))
    order = ["xformOp:translate"]
    for name, value in (("rotateY", turn_deg[1]), ("rotateX", turn_deg[0])):
        if value:
            _operation(camera, name, Sdf.ValueTypeNames.Float, value)
            order.append(f"xformOp:{name}")
    _order(camera, order)


def _place(prim: Sdf.PrimSpec, position: tuple[float, float, float], yaw_rad: float) -> None:
    # float3, not double3: three.js cannot read a double3 from a crate file
    _operation(prim, "translate", Sdf.ValueTypeNames.Float3, Gf.Vec3f(*position))
    order = ["xformOp:translate"]
    if yaw_rad:
        _operation(prim, "rotateY", Sdf.ValueTypeNames.Float, round(math.degrees(yaw_rad), 4))
        order.append("xformOp:rotateY")
    _order(prim, order)


def _operation(prim: Sdf.PrimSpec, name: str, type_name: Sdf.ValueTypeName, value: object) -> None:
    Sdf.AttributeSpec(prim, f"xformOp:{name}", type_name).default = value


def _order(prim: Sdf.PrimSpec, names: list[str]) -> None:
    order = Sdf.AttributeSpec(prim, "xformOpOrder", Sdf.ValueTypeNames.TokenArray, Sdf.VariabilityUniform)
    order.default = Vt.TokenArray(names)


def _prim(
    layer: Sdf.Layer, path: Sdf.Path, type_name: str, *, kind: str | None = None, label: str | None = None
) -> Sdf.PrimSpec:
    prim = Sdf.CreatePrimInLayer(layer, path)
    prim.specifier = Sdf.SpecifierDef
    prim.typeName = type_name
    if kind is not None:
        prim.kind = kind
    if label is not None:
        prim.SetInfo("apiSchemas", Sdf.TokenListOp.Create(prependedItems=[f"SemanticsLabelsAPI:{LABEL_TAXONOMY}"]))
        name = f"semantics:labels:{LABEL_TAXONOMY}"
        Sdf.AttributeSpec(prim, name, Sdf.ValueTypeNames.TokenArray).default = Vt.TokenArray([label])
    return prim


def _matrices(structure: Structure) -> dict[str, object]:
    """S as rows of symbols, R and C in metres for each column and row."""
    return {
        "S": str(structure),
        "R": Vt.DoubleArray(structure.R[0].tolist()),
        "C": Vt.DoubleArray(structure.C[:, 0].tolist()),
    }
