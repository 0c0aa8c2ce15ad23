"""What a stage holds beside its meshes: lane graph, stalls, labels, variants, cameras, friction."""

import json
import re
import zipfile

import networkx as nx
import numpy as np
import pytest
from PIL import Image
from pxr import Sdf, Usd, UsdGeom, UsdLux, UsdPhysics, UsdShade
from support.label_tables import labelled_objects
from support.sample_files import REPOSITORY
from support.soak import soak_but

from garage2usd.config import GarageConfig, load_config
from garage2usd.config.vehicles import PAINTS
from garage2usd.objects import CAR_LABELS, CLASSES_VERSION, PIECE_LABELS, TilePart
from garage2usd.pipeline import build
from garage2usd.reading.labels import CITYSCAPES
from garage2usd.stage import cameras
from garage2usd.stage.cameras import write_drive
from garage2usd.stage.labels import OBJECT_LABELS
from garage2usd.structure.grid import Cell, Structure, cells_from_text
from garage2usd.structure.lane_graph import build_lane_graph

CONFIG = GarageConfig(
    seed=3,
    site={"rectangles": 3, "width_cells": 11, "height_cells": 9, "obstacles": 1, "min_portal_distance_cells": 3},
    plan={"episodes": 300},
)


@pytest.fixture(scope="module")
def made(tmp_path_factory):
    return build(CONFIG, tmp_path_factory.mktemp("stage") / "garage.usda")


@pytest.fixture
def stage(made):
    return Usd.Stage.Open(str(made.stage), Usd.Stage.LoadAll)


def everything(stage):
    return list(Usd.PrimRange(stage.GetPseudoRoot(), Usd.TraverseInstanceProxies()))


def curves(stage, name):
    """The guide curves of one part of the lane graph as (x, z) points, and what they say of each."""
    prim = stage.GetPrimAtPath(f"/Garage/LaneGraph/{name}")
    lines = UsdGeom.BasisCurves(prim)
    assert UsdGeom.Imageable(prim).ComputePurpose() == UsdGeom.Tokens.guide
    ends = np.cumsum(lines.GetCurveVertexCountsAttr().Get())
    points = np.split(np.array(lines.GetPointsAttr().Get())[:, [0, 2]], ends[:-1])
    attributes = {
        attribute.GetName().rpartition(":")[2]: list(attribute.Get())
        for attribute in prim.GetAttributes()
        if attribute.GetName().startswith("garage:")
    }
    assert {len(values) for values in attributes.values()} == {len(points)}
    return points, [dict(zip(attributes, values, strict=True)) for values in zip(*attributes.values(), strict=True)]


def test_a_program_can_drive_on_the_stage_alone(stage, made):
    roads = nx.Graph()
    rings, nodes = curves(stage, "Nodes")
    squares = [(node["row"], node["column"]) for node in nodes]
    for ring, node, square in zip(rings, nodes, squares, strict=True):
        assert 4.5 < min(node["widths"]) <= max(node["widths"]) < 8.1  # a stall is 5.3 m long, less both setbacks
        roads.add_node(square, kind=node["kind"], middle=ring.mean(axis=0))
    for points, edge in zip(*curves(stage, "Edges"), strict=True):
        start, end = squares[edge["from"]], squares[edge["to"]]
        assert points == pytest.approx(np.array([roads.nodes[start]["middle"], roads.nodes[end]["middle"]]), abs=1e-4)
        assert edge["length"] == pytest.approx(np.linalg.norm(points[1] - points[0]), abs=1e-4)
        assert 5.0 < edge["width"] < 8.1
        kinds = {roads.nodes[start]["kind"], roads.nodes[end]["kind"]}
        portals = kinds & {"entrance", "exit"}
        assert edge["direction"] == ("forward" if portals else "both")
        assert roads.nodes[end]["kind"] != "entrance"
        assert roads.nodes[start]["kind"] != "exit"
        roads.add_edge(start, end)
    graph = made.garage.graph.graph
    assert nx.utils.graphs_equal(nx.Graph(roads.edges), nx.Graph(graph.edges))
    assert {square: str(kind) for square, kind in graph.nodes(data="kind")} == dict(roads.nodes(data="kind"))


def test_stalls_describe_themselves(stage, made):
    stalls = {stall.name: stall for stall in made.garage.layout.stalls}
    outlines = {said["id"]: (outline, said) for outline, said in zip(*curves(stage, "Stalls"), strict=True)}
    assert outlines.keys() == stalls.keys()
    rings, nodes = curves(stage, "Nodes")
    cache = UsdGeom.BBoxCache(Usd.TimeCode.Default(), [UsdGeom.Tokens.default_])
    found = []
    for prim in stage.Traverse():
        identity = prim.GetAttribute("garage:stall:id")
        if not identity or prim.IsA(UsdGeom.BasisCurves):
            continue
        stall = stalls[identity.Get()]
        found.append(stall.name)
        assert (prim.GetAttribute("garage:stall:type").Get(), prim.GetAttribute("garage:stall:use").Get()) == (
            stall.stall_type,
            stall.use,
        )
        assert tuple(prim.GetAttribute("garage:stall:square").Get()) == stall.square
        assert tuple(prim.GetAttribute("garage:stall:accessSquare").Get()) == stall.access_square
        corners = np.array(prim.GetAttribute("garage:stall:corners").Get())
        box = cache.ComputeWorldBound(prim).ComputeAlignedRange()
        low, high = np.array(box.GetMin())[[0, 2]], np.array(box.GetMax())[[0, 2]]
        assert corners.min(axis=0) == pytest.approx(low, abs=1e-4)
        assert corners.max(axis=0) == pytest.approx(high, abs=1e-4)
        # the curve of the stall says the same
        outline, said = outlines[stall.name]
        assert outline == pytest.approx(corners, abs=1e-5)
        for name in ("type", "use", "entryEdge"):
            assert prim.GetAttribute(f"garage:stall:{name}").Get() == said[name]
        assert (said["row"], said["column"]) == stall.square
        lane = nodes[said["accessNode"]]
        assert (lane["row"], lane["column"]) == stall.access_square
        # the mouth, the first two corners, lies on the edge to the lane that it names
        mouth, rear = corners[:2].mean(axis=0), corners[2:].mean(axis=0)
        middle = rings[said["accessNode"]].mean(axis=0)
        assert np.linalg.norm(mouth - middle) < np.linalg.norm(rear - middle)
    assert sorted(found) == sorted(stalls)


def world_box(stage, path, cache):
    """World bounds of a prim, or of a point of an instancer: ``/Garage/StallNumbers[7]``."""
    prim, _, point = path.rstrip("]").partition("[")
    if not point:
        return cache.ComputeWorldBound(stage.GetPrimAtPath(prim)).ComputeAlignedRange()
    instancer = UsdGeom.PointInstancer(stage.GetPrimAtPath(prim))
    return cache.ComputePointInstanceWorldBound(instancer, int(point)).ComputeAlignedRange()


@pytest.fixture(scope="module")
def nested(tmp_path_factory):
    config = GarageConfig(**{**CONFIG.model_dump(), "stage": {"form": "nested", "arrangements": 5}})
    return build(config, tmp_path_factory.mktemp("nested") / "garage.usdc")


def test_equal_tiles_share_a_prototype_and_every_object_keeps_its_place(nested):
    stage = Usd.Stage.Open(str(nested.stage))
    layout = nested.garage.layout
    tiles = [prim for prim in stage.Traverse() if prim.GetName().startswith("Tile_")]
    assert len(tiles) == (layout.structure.cells != Cell.OBSTACLE).sum()
    assert all(tile.IsInstance() for tile in tiles)
    assert len({tile.GetPrototype() for tile in tiles}) < len(tiles)
    parts = [part for tile in tiles for part in tile.GetFilteredChildren(Usd.TraverseInstanceProxies())]
    assert {part.GetName() for part in parts} == set(TilePart)
    assert all(part.IsInstance() for part in parts)
    for name in TilePart:  # tiles that are different share them
        named = [part for part in parts if part.GetName() == name]
        assert len({part.GetPrototype() for part in named}) < len({part.GetParent().GetPrototype() for part in named})
    # what belongs to the building stands on tiles too
    assert not any(stage.GetPrimAtPath(f"/Garage/{group}") for group in ("Columns", "FireProtection"))
    table = labelled_objects(nested.labels)
    assert len({entry["path"] for entry in table}) == len(table)
    table, pieces = table[: len(layout.placements)], table[len(layout.placements) :]
    assert_pieces_agree(stage, pieces, {entry["path"] for entry in table})
    cache = UsdGeom.BBoxCache(Usd.TimeCode.Default(), [UsdGeom.Tokens.default_])
    for entry, placement in zip(table, layout.placements, strict=True):
        prim = stage.GetPrimAtPath(entry["path"].partition("[")[0])
        assert list(prim.GetAttribute("semantics:labels:class").Get()) == [entry["class"]]
        box = world_box(stage, entry["path"], cache)
        if placement.kind in {"car", "number_plate", "floor_stain", "mirror"}:  # turned: a turned box
            assert (np.array(entry["min_m"]) >= np.array(box.GetMin()) - 1e-3).all()
            assert (np.array(entry["max_m"]) <= np.array(box.GetMax()) + 1e-3).all()
        else:
            assert entry["min_m"] == pytest.approx(list(box.GetMin()), abs=1e-3)
            assert entry["max_m"] == pytest.approx(list(box.GetMax()), abs=1e-3)
        if "[" not in entry["path"]:
            place = UsdGeom.Xformable(prim).ComputeLocalToWorldTransform(Usd.TimeCode.Default())
            assert list(place.ExtractTranslation()) == pytest.approx(placement.position_m, abs=1e-4)
    # and nothing beside them
    shared = {*tiles, *parts}
    instances = [prim for prim in everything(stage) if is_placed(prim) and prim not in shared]
    scattered = sum("[" in entry["path"] for entry in table)
    assert len(instances) == len(table) - scattered


def is_placed(prim):
    """Whether a prim is an object: number plates, each with a text of its own, are no instances."""
    return prim.IsInstance() or prim.GetName().startswith("NumberPlate_")


def assert_pieces_agree(stage, pieces, objects):
    """All prims with a class below that of an object are in the table, with their bounds."""
    found = {}
    for prim in everything(stage):
        above = str(prim.GetParent().GetPath())
        if above in objects and prim.HasAPI("SemanticsLabelsAPI", "class"):
            found[str(prim.GetPath())] = list(prim.GetAttribute("semantics:labels:class").Get())
    assert {entry["path"]: [entry["class"]] for entry in pieces} == found
    assert found
    cache = UsdGeom.BBoxCache(Usd.TimeCode.Default(), [UsdGeom.Tokens.default_])
    for entry in pieces:
        box = world_box(stage, entry["path"], cache)
        assert entry["min_m"] == pytest.approx(list(box.GetMin()), abs=1e-3)
        assert entry["max_m"] == pytest.approx(list(box.GetMax()), abs=1e-3)


def test_the_label_table_agrees_with_the_stage(stage, made):
    objects = labelled_objects(made.labels)
    assert [entry["id"] for entry in objects] == list(range(1, len(objects) + 1))
    table, count = json.loads(made.labels.read_text()), len(made.garage.layout.placements)
    names = {entry["name"] for entry in table["classes"]}
    assert names == {*OBJECT_LABELS.values(), *CAR_LABELS, *PIECE_LABELS} == set(CITYSCAPES)
    assert table["classes_version"] == CLASSES_VERSION
    objects, pieces = objects[:count], objects[count:]
    assert_pieces_agree(stage, pieces, {entry["path"] for entry in objects})
    assert {entry["class"] for entry in pieces} == PIECE_LABELS
    cache = UsdGeom.BBoxCache(Usd.TimeCode.Default(), [UsdGeom.Tokens.default_])
    labelled = {
        str(prim.GetPath()): list(prim.GetAttribute("semantics:labels:class").Get())
        for prim in stage.Traverse()
        if is_placed(prim)
    }
    assert {entry["path"]: [entry["class"]] for entry in objects} == labelled
    for entry in objects:
        box = world_box(stage, entry["path"], cache)
        if entry["class"] in {"car", "number_plate", "floor_stain", "mirror"}:  # turned: the cache bounds a turned box
            assert (np.array(entry["min_m"]) >= np.array(box.GetMin()) - 1e-3).all()
            assert (np.array(entry["max_m"]) <= np.array(box.GetMax()) + 1e-3).all()
        else:
            assert entry["min_m"] == pytest.approx(list(box.GetMin()), abs=1e-3)
            assert entry["max_m"] == pytest.approx(list(box.GetMax()), abs=1e-3)


def test_every_paint_is_a_variant(stage, made):
    cars = made.garage.layout.of_kind("car")
    assert cars
    colours = {}
    for car in cars:
        row, col = car.square
        path = f"/Garage/Tiles/Row_r{row:02d}/Tile_r{row:02d}_c{col:02d}/{car.name}"
        prim = stage.GetPrimAtPath(path)
        assert prim.GetVariantSets().GetVariantSet("paint").GetVariantNames() == sorted(PAINTS)
        surface = stage.GetPrimAtPath(f"{path}/Looks/CarPaint/Surface")
        colours.setdefault(car.spec.paint, set()).add(tuple(surface.GetAttribute("inputs:diffuseColor").Get()))
    assert all(len(seen) == 1 for seen in colours.values())
    assert len(set().union(*colours.values())) == len(colours)


@pytest.mark.parametrize("form", ["made", "nested"])
@pytest.mark.parametrize("root", ["/Garage", "/City/Garage_7"])
def test_occupancy_lights_and_ceiling_are_variants(form, root, request):
    """Of the stage, and of another one that refers to it."""
    built = request.getfixturevalue(form)
    stage, layout = Usd.Stage.Open(str(built.stage)), built.garage.layout
    if root != "/Garage":
        stage = Usd.Stage.CreateInMemory()
        stage.DefinePrim(root).GetReferences().AddReference(str(built.stage))

    def state():
        prims = everything(stage)
        lights = [prim for prim in prims if prim.IsA(UsdLux.RectLight)]
        ceilings = [prim for prim in prims if prim.GetName() == "Ceiling"]
        return (
            sum(prim.GetName().startswith("Car_") for prim in prims),
            sum(UsdLux.RectLight(light).GetIntensityAttr().Get() > 0 for light in lights),
            sum(UsdGeom.Imageable(ceiling).ComputeVisibility() == UsdGeom.Tokens.inherited for ceiling in ceilings),
        )

    cars, lights, ceilings = (len(layout.of_kind(kind)) for kind in ("car", "light", "ceiling"))
    assert state() == (cars, lights, ceilings)
    sets = stage.GetPrimAtPath(root).GetVariantSets()
    for name, usual, other, expected in (
        ("occupancy", "parked", "empty", (0, lights, ceilings)),
        ("lights", "on", "off", (cars, 0, ceilings)),
        ("ceiling", "shown", "hidden", (cars, lights, 0)),
    ):
        assert sets.GetVariantSelection(name) == (usual if form == "made" else "")
        sets.SetSelection(name, other)
        assert state() == expected
        sets.SetSelection(name, usual)
        assert state() == (cars, lights, ceilings)


def test_the_drive_goes_from_an_entrance_to_an_exit_over_lanes(stage, made):
    structure = made.garage.layout.structure
    camera = UsdGeom.Camera(stage.GetPrimAtPath("/Garage/Cameras/Drive"))
    last = int(stage.GetEndTimeCode())
    x_edges, z_edges = structure.column_edges_m, structure.row_edges_m
    squares, places = [], []
    for frame in range(last + 1):
        pose = camera.ComputeLocalToWorldTransform(frame)
        x, y, z = pose.ExtractTranslation()
        assert y == pytest.approx(1.5)
        places.append((x, z))
        squares.append(
            structure.cells[np.searchsorted(z_edges, z, "right") - 1, np.searchsorted(x_edges, x, "right") - 1]
        )
    assert squares[0] == Cell.ENTRANCE
    assert squares[-1] == Cell.EXIT
    assert set(squares) == {Cell.ENTRANCE, Cell.LANE, Cell.EXIT}
    samples = [camera.GetPrim().GetAttribute(f"xformOp:{name}").GetTimeSamples() for name in ("translate", "rotateY")]
    assert all(times[0] == 0 and times[-1] == last and len(times) < 0.9 * (last + 1) for times in samples)
    steps = np.linalg.norm(np.diff(places, axis=0), axis=1)
    assert steps.max() < 2.7 / stage.GetFramesPerSecond() + 1e-3
    forward = camera.ComputeLocalToWorldTransform(0).TransformDir((0, 0, -1))
    ahead = np.subtract(places[20], places[0])
    assert np.dot((forward[0], forward[2]), ahead / np.linalg.norm(ahead)) > 0.9


def test_the_camera_that_drives_is_nowhere_seen_to_turn_otherwise_than_frame_by_frame(made, tmp_path, monkeypatch):
    lanes = made.garage.layout.lane_graph
    drives = []
    for name, unseen_deg in (("few", cameras._UNSEEN_DEG), ("all", 0.0)):
        monkeypatch.setattr(cameras, "_UNSEEN_DEG", unseen_deg)
        last = cameras.write_drive(tmp_path / f"{name}.usdc", lanes)
        drives.append(Usd.Stage.Open(str(tmp_path / f"{name}.usdc")))
    few, every = (drive.GetDefaultPrim().GetAttribute("xformOp:rotateY") for drive in drives)
    assert 10 < few.GetNumTimeSamples() < 0.6 * every.GetNumTimeSamples()
    off = [abs(few.Get(frame) - every.Get(frame)) for frame in range(last + 1)]
    assert max(off) <= 0.02 + 2 * 0.0005 + 1e-4  # both are in thousandths


def test_every_collider_has_friction(stage):
    frictions = {}
    for prim in everything(stage):
        if prim.HasAPI(UsdPhysics.CollisionAPI):
            material, _ = UsdShade.MaterialBindingAPI(prim).ComputeBoundMaterial("physics")
            physics = UsdPhysics.MaterialAPI(material)
            friction = physics.GetStaticFrictionAttr().Get(), physics.GetDynamicFrictionAttr().Get()
            assert 0 < friction[1] < friction[0] <= 1
            frictions[prim.GetName()] = friction
    assert frictions["Black"] > frictions["Shaft"]  # rubber grips better than concrete


@pytest.mark.parametrize("extension", soak_but(["usdz"], ["usdc", "usdz"]))
def test_the_flat_form_needs_no_composition(tmp_path, made, stage, extension):
    config = GarageConfig(**{**CONFIG.model_dump(), "stage": {"form": "flat", "texture_quality": "low"}})
    flat = build(config, tmp_path / f"flat.{extension}")
    opened = Usd.Stage.Open(str(flat.stage))
    assert [layer for layer in opened.GetUsedLayers() if not layer.anonymous] == [opened.GetRootLayer()]
    assert not opened.GetPrototypes()
    for prim in opened.Traverse():
        assert not prim.HasAuthoredReferences()
        assert not prim.HasVariantSets()
    # every mesh of the instanced stage is there, in its place
    mine = {str(prim.GetPath()): prim for prim in opened.Traverse() if prim.IsA(UsdGeom.Mesh)}
    theirs = {str(prim.GetPath()): prim for prim in everything(stage) if prim.IsA(UsdGeom.Mesh)}
    assert mine.keys() == theirs.keys()
    places, expected = UsdGeom.XformCache(), UsdGeom.XformCache()
    for path, prim in mine.items():
        assert places.GetLocalToWorldTransform(prim) == expected.GetLocalToWorldTransform(theirs[path])
        assert UsdShade.MaterialBindingAPI(prim).ComputeBoundMaterial()[0]
    textures = {
        prim.GetAttribute("inputs:file").Get() for prim in opened.Traverse() if prim.GetAttribute("inputs:file")
    }
    assert textures
    assert all(texture.path.startswith("./") and texture.resolvedPath for texture in textures)


def width_of(file):
    with Image.open(file) as picture:
        return picture.width


@pytest.mark.parametrize("form", ["instanced", "nested"])
def test_a_package_says_the_same_as_text_that_people_read(tmp_path, form):
    config = GarageConfig(**CONFIG.model_dump() | {"stage": {"form": form}})
    build(config, tmp_path / "g.usda")
    package = build(config, tmp_path / "g.usdz").stage
    layer = Sdf.Layer.FindOrOpen(str(package)).ExportToString()
    assert layer == (tmp_path / "g.usda").read_text().replace("@./g_assets/", "@./assets/")
    with zipfile.ZipFile(package) as files:
        own = sorted(path.relative_to(tmp_path / "g_assets") for path in (tmp_path / "g_assets").rglob("*.*"))
        assert files.namelist() == ["g.usda", *(f"assets/{path.as_posix()}" for path in own)]
        assert len(files.read("g.usda")) < 0.75 * len(layer)


def test_texture_quality_is_a_budget(tmp_path, made):
    sizes, widths = {}, {}
    for quality in ("low", "medium", "high"):
        config = GarageConfig(**{**CONFIG.model_dump(), "stage": {"texture_quality": quality}})
        folder = build(config, tmp_path / f"{quality}.usda").asset_folder / "textures"
        sizes[quality] = sum(file.stat().st_size for file in folder.iterdir())
        widths[quality] = {file.stem.rpartition("_")[0]: width_of(file) for file in folder.iterdir()}
    assert 3 * sizes["low"] < sizes["medium"] < sizes["high"] / 2
    for name, width in widths["high"].items():
        assert (widths["medium"][name], widths["low"][name]) == (width // 2, width // 4)
    assert sizes["medium"] < 700_000


OF_CARS = re.compile("/(Car|NumberPlate)_")


def test_the_papers_garage_without_its_cars_is_small(tmp_path):
    """At medium quality, as it is without a word about textures; half of it goes to pictures and to the root layer."""
    config = load_config(REPOSITORY / "samples" / "paper_7x9.toml")
    package = build(config, tmp_path / "paper.usdz", tape="ULUUUUUDDDDDDURRRUUUUUDDDDDRRRUUUUUDDDDDDULLLLLS").stage
    with zipfile.ZipFile(package) as archive:
        sizes = {entry.filename: entry.file_size for entry in archive.infolist()}
    assert sum(size for name, size in sizes.items() if not OF_CARS.search(name)) < 1_750_000
    assert sum(size for name, size in sizes.items() if "/textures/" in name) < 600_000


@pytest.mark.parametrize(
    ("text", "widths", "depths", "start", "end"),
    [
        ("E=#....\n##.....\nE======\n......X", 8.1, 8.1, (2, 0), (3, 6)),  # the first entrance leads nowhere
        ("X......\n=......\n=......\nE====X.", 4.0, 18.0, (3, 0), (3, 5)),  # the other exit is fewer squares away
    ],
)
def test_the_drive_leads_from_the_first_entrance_with_a_way_out_to_the_nearest_exit(
    tmp_path, text, widths, depths, start, end
):
    config = GarageConfig()
    structure = Structure.from_arrays(cells_from_text(text, field="S"), widths, depths)
    graph = build_lane_graph(structure, config.bay)
    path = tmp_path / "drive.usda"
    last = write_drive(path, graph.lanes)
    stage = Usd.Stage.Open(str(path))
    camera = UsdGeom.Camera(stage.GetDefaultPrim())
    for frame, square in ((0, start), (last, end)):
        x, _, z = camera.ComputeLocalToWorldTransform(frame).ExtractTranslation()
        node = graph.graph.nodes[square]
        assert np.hypot(x - node["x_m"], z - node["z_m"]) < 0.2


@pytest.mark.parametrize(
    ("sample", "most"),
    [(None, 3_200_000), pytest.param("large_20x30", 7_200_000, marks=pytest.mark.soak)],
    ids=["default", "20x30"],
)
def test_a_package_is_small(tmp_path, sample, most):
    config = load_config(REPOSITORY / f"samples/{sample}.toml") if sample else GarageConfig()
    assert build(config, tmp_path / "garage.usdz").stage.stat().st_size <= most
