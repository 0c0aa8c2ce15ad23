"""libsdformat loads worlds without a word; their collisions are the stage's colliders, by trimesh."""

import json
import shlex
from types import SimpleNamespace

import assimp_py
import numpy as np
import pytest
import shapely
import trimesh
from pxr import Usd, UsdGeom, UsdPhysics
from support.glb_reader import Glb
from support.gltf_validator import find_node, find_validator, validated
from support.label_tables import labelled_objects
from support.launch_files import launched, run
from support.sample_files import LEVELS_SAMPLE, REPOSITORY
from support.sdf_reader import SDFORMAT, compiled, read_world
from support.small_garage import SETTINGS
from support.small_levels import SMALL_LEVELS
from support.soak import soak_but

import garage2usd
from garage2usd.objects import CAR_LABELS

pytestmark = [
    pytest.mark.client,
    pytest.mark.skipif(not SDFORMAT, reason="no libsdformat of 12 or later with its headers (libsdformat-dev)"),
]

HAND_DRAWN, LOOKS, PAPER = (REPOSITORY / f"samples/{name}.toml" for name in ("hand_drawn", "looks", "paper_7x9"))
SMALL = "small_levels"
EACH = soak_but([LOOKS, SMALL], [LOOKS, SMALL, LEVELS_SAMPLE, HAND_DRAWN, PAPER])
Z_UP = np.array([[1.0, 0, 0], [0, 0, -1], [0, 1, 0]])
SHAPES = {"boundingCube": {"box"}, "convexHull": {"box", "cylinder", "mesh"}, "none": {"mesh"}}
NEAR_M, SLAB_M, WHITE_LX = 0.025, 0.05, 150.0


@pytest.fixture(scope="module", params=EACH, ids=lambda sample: getattr(sample, "stem", sample))
def world(request, builds, tmp_path_factory):
    """A world whose name has dots and blanks, as libsdformat reads it, and its stage."""
    folder = tmp_path_factory.mktemp("world")
    is_small = request.param == SMALL
    built = garage2usd.build(SMALL_LEVELS, folder / f"{SMALL}.usdc") if is_small else builds(request.param, "usdc")
    path = folder / "my gar.age.sdf"
    files = garage2usd.export(built.stage, [path])
    read = read_world(compiled(tmp_path_factory.mktemp("sdformat")), path)
    return SimpleNamespace(path=path, files=files, built=built, stage=Usd.Stage.Open(str(built.stage)), **read)


def in_world(points, matrix):
    """Points in metres with Z up."""
    return (points @ matrix[:3, :3] + matrix[3, :3]) @ Z_UP.T


def bounds_of(points):
    return np.array([points.min(axis=0), points.max(axis=0)])


def colliders(stage):
    """Kind, volume (of a mesh its area) and bounds of each collider; polygons of level sheets with their heights."""
    solids, sheets, places = {}, [], UsdGeom.XformCache()
    for prim in Usd.PrimRange(stage.GetPseudoRoot(), Usd.TraverseInstanceProxies()):
        if not prim.HasAPI(UsdPhysics.CollisionAPI) or UsdGeom.Imageable(prim).ComputeVisibility() == "invisible":
            continue
        mesh, matrix = UsdGeom.Mesh(prim), np.array(places.GetLocalToWorldTransform(prim))
        points = np.array(mesh.GetPointsAttr().Get(), dtype=float)
        placed, kind = in_world(points, matrix), UsdPhysics.MeshCollisionAPI(prim).GetApproximationAttr().Get()
        name = str(prim.GetPath()).strip("/").replace("/", ".")
        if kind == "boundingCube":
            sides = np.ptp(points, axis=0)
            corners = in_world(np.array([*np.ndindex(2, 2, 2)]) * sides + points.min(axis=0), matrix)
            solids[name] = kind, np.prod(sides) * abs(np.linalg.det(matrix[:3, :3])), bounds_of(corners)
            continue
        if kind == "convexHull":
            solids[name] = kind, trimesh.convex.convex_hull(placed).volume, bounds_of(placed)
            continue
        counts, corners = mesh.GetFaceVertexCountsAttr().Get(), np.array(mesh.GetFaceVertexIndicesAttr().Get())
        faces = np.split(corners, np.cumsum(counts)[:-1])
        if np.ptp(placed[:, 2]) < 1e-3:
            sheets += [(placed[face, 2].mean(), shapely.Polygon(placed[face, :2])) for face in faces]
        else:
            fans = [(face[0], face[k], face[k + 1]) for face in faces for k in range(1, len(face) - 1)]
            solids[name] = kind, trimesh.Trimesh(placed, fans, process=False).area, bounds_of(placed)
    return solids, sheets


def solid(world, entry):
    """A collision as a mesh in the world, and its volume."""
    if entry["shape"] == "box":
        made, volume = trimesh.creation.box(entry["size"]), np.prod(entry["size"])
    elif entry["shape"] == "cylinder":
        radius, length = entry["size"]
        made, volume = trimesh.creation.cylinder(radius, length, sections=720), np.pi * radius**2 * length
    else:
        assert entry["scale"] == [1, 1, 1]
        made = trimesh.load(world.path.parent / entry["uri"])
        with np.errstate(all="ignore"):  # an open mesh may have none
            volume = made.volume
    return made.apply_transform(entry["matrix"]), volume


def split(world):
    """The slabs of the ground, and all other collisions."""
    slabs = {name: entry for name, entry in world.collision.items() if name.split("/")[-1].startswith("Ground_")}
    return slabs, {name: entry for name, entry in world.collision.items() if name not in slabs}


def test_collisions_have_the_places_and_volumes_of_the_colliders(world):
    expected, _ = colliders(world.stage)
    _, collisions = split(world)
    assert collisions.keys() == expected.keys()
    for name, (kind, size, bounds) in expected.items():
        made, volume = solid(world, collisions[name])
        shape = collisions[name]["shape"]
        assert shape in SHAPES[kind], name
        assert made.area == pytest.approx(size, rel=1e-5) if kind == "none" else made.is_watertight, name
        if kind != "none":
            assert volume == pytest.approx(size, rel=2e-4), name
        near = NEAR_M if kind == "convexHull" and shape != "mesh" else 5e-5
        assert made.bounds == pytest.approx(bounds, abs=near), name
    shapes = [entry["shape"] for entry in collisions.values()]
    assert {*shapes} == {"box", "cylinder", "mesh"}
    assert shapes.count("mesh") < 0.45 * len(shapes)


def test_slabs_cover_the_floors_from_below(world):
    _, sheets = colliders(world.stage)
    slabs = [solid(world, entry) for entry in split(world)[0].values()]
    tops_m = sorted({round(slab.bounds[1, 2], 2) for slab, _ in slabs})
    for top in tops_m:
        here = shapely.union_all([own for height, own in sheets if abs(height - top) < 0.01], grid_size=1e-5)
        own = [(slab, volume) for slab, volume in slabs if abs(slab.bounds[1, 2] - top) < 0.01]
        assert all(np.ptp(slab.bounds[:, 2]) == pytest.approx(SLAB_M, abs=1e-6) for slab, _ in own)
        assert sum(volume for _, volume in own) == pytest.approx(SLAB_M * here.area, rel=1e-4)
        upper = [face[:, :2] for slab, _ in own for face in slab.triangles[slab.face_normals[:, 2] > 0.9]]
        assert (
            shapely.union_all(shapely.polygons(upper), grid_size=1e-5).symmetric_difference(here).area
            < 1e-3 * here.area
        )
    assert all(min(abs(height - top) for top in tops_m) < 0.01 for height, _ in sheets)


def test_models_are_levels_and_cars_that_stand(world):
    about = world.world["garage"]
    assert (about["version"], about["worlds"], about["physics"]) == ("1.9", 1, 1)
    assert all(model["static"] for model in world.model.values())
    cars = [entry for entry in labelled_objects(world.built.labels) if entry["class"] in CAR_LABELS]
    names = [name for name in world.model if not name.startswith("Car_")]
    assert len(world.model) - len(names) == len(cars)
    assert names == (["U1", "U2"] if "levels" in world.built.stage.stem else ["Garage"])
    text = world.path.read_text()
    for system in ("Physics", "UserCommands", "SceneBroadcaster", "Sensors", "Contact", "Imu"):
        assert f'name="gz::sim::systems::{system}"' in text


def test_visuals_are_where_the_stage_draws_them(world):
    glb = Glb((world.path.parent / "my gar.age_meshes/visuals.glb").read_bytes())
    number_of = {node["name"]: number for number, node in enumerate(glb.nodes)}
    assert len(number_of) == len(glb.nodes)
    points = {}
    for (model, _), visual in world.visual.items():
        assert visual["uri"] == "my gar.age_meshes/visuals.glb"
        placed = visual["matrix"] @ np.diag([*visual["scale"], 1.0])
        own = glb.points(number_of[visual["submesh"]])
        points.setdefault(model, []).append(own @ placed[:3, :3].T + placed[:3, 3])
    car_of = {entry["model"]: name.split(".Geom")[0] for name, entry in world.collision.items() if ".Geom." in name}
    boxes = UsdGeom.BBoxCache(Usd.TimeCode.EarliestTime(), [UsdGeom.Tokens.default_, UsdGeom.Tokens.render])
    expected = {model: f"/{name.replace('.', '/')}" for model, name in car_of.items() if model.startswith("Car_")}
    assert len(expected) > 3
    for model, path in [*expected.items(), (None, str(world.stage.GetDefaultPrim().GetPath()))]:
        box = boxes.ComputeWorldBound(world.stage.GetPrimAtPath(path)).ComputeAlignedRange()
        found = np.vstack([part for parts in points.values() for part in parts] if model is None else points[model])
        corners = np.array([[*box.GetMin()], [*box.GetMax()]]) @ Z_UP.T
        # the box of a turned car around the box of its mesh is wider than the mesh
        low, high = bounds_of(corners)
        assert (found.min(axis=0) > low - 2e-3).all()
        assert (found.max(axis=0) < high + 2e-3).all()
        assert [found[:, 2].min(), found[:, 2].max()] == pytest.approx([low[2], high[2]], abs=2e-3)
    # the nose of a car is ahead of its origin
    for model in expected:
        ahead = world.model[model]["matrix"][:3, 0]
        assert abs(ahead[2]) < 0.2


@pytest.mark.skipif(find_validator() is None or find_node() is None, reason="no Khronos validator")
def test_visuals_are_valid_gltf(world):
    issues = validated(world.path.parent / "my gar.age_meshes/visuals.glb")["issues"]
    assert (issues["numErrors"], issues["numWarnings"]) == (0, 0), issues["messages"][:5]


def test_assimp_reads_the_texture_coordinates_of_visuals(world):
    """It takes normalized integers for floats, so the file must have none; Gazebo loads GLB by it."""
    path = world.path.parent / "my gar.age_meshes/visuals.glb"
    glb, scene = Glb(path.read_bytes()), assimp_py.import_file(str(path), assimp_py.Process_Triangulate)
    primitives = [own for mesh in glb.json["meshes"] for own in mesh["primitives"]]
    assert len(scene.meshes) == len(primitives)
    names = [material["name"] for material in glb.json["materials"]]
    assert len({*names}) == len(names)
    compared = 0
    for mesh, own in zip(scene.meshes, primitives, strict=True):
        if "TEXCOORD_0" in own["attributes"]:
            expected = glb.array(own["attributes"]["TEXCOORD_0"])[np.unique(glb.array(own["indices"]))]
            found = np.array(mesh.texcoords[0]).reshape(mesh.num_vertices, -1)[:, :2]
            assert bounds_of(found * (1, -1) + (0, 1)) == pytest.approx(bounds_of(expected), abs=1e-3)
            compared += 1
    assert compared > 5


def test_lamps_shine_with_their_candela_over_white(world):
    places = UsdGeom.XformCache()
    expected = {}
    for prim in Usd.PrimRange(world.stage.GetPseudoRoot(), Usd.TraverseInstanceProxies()):
        nit = prim.GetAttribute("garage:light:luminance")
        if nit and nit.HasAuthoredValue() and prim.GetAttribute("inputs:intensity").Get() > 0:
            round_ = prim.GetTypeName() == "DiskLight"
            names = ("radius", "radius") if round_ else ("width", "height")
            sides = [prim.GetAttribute(f"inputs:{name}").Get() for name in names]
            name = str(prim.GetPath()).strip("/").replace("/", ".")
            middle = in_world(np.zeros(3), np.array(places.GetLocalToWorldTransform(prim)))
            expected[name] = nit.Get() * np.prod(sides) * (np.pi if round_ else 1.0), middle
    assert world.light.keys() == expected.keys()
    for name, (candela, middle) in expected.items():
        light = world.light[name]
        assert max(light["diffuse"]) == 1
        shines = light["intensity"] * np.dot(light["diffuse"], [0.2126, 0.7152, 0.0722])
        assert shines == pytest.approx(candela / WHITE_LX, rel=1e-4)
        assert (light["type"], light["quadratic"], light["outer"]) == (2, 1, 3.1)
        assert light["direction"] == pytest.approx([0, 0, -1], abs=1e-6)
        assert light["move"] == pytest.approx(middle, abs=1e-5)
        assert light["range"] == pytest.approx(np.sqrt(light["intensity"] * WHITE_LX / 0.5), rel=1e-4)


def test_frames_stand_at_entrances_and_stalls(world):
    stalls = {name: entry for name, entry in world.frame.items() if name.startswith("stall_")}
    assert [name for name in world.frame if name not in stalls] == ["entrance_1"]
    levels = json.loads(world.built.report.read_text())["levels"]
    expected = {}
    for level in levels:
        prefix = f"{level['name']}/" if len(levels) > 1 else ""
        for stall in level["stalls"]:
            x, z = stall["centre_m"]
            expected[f"stall_{prefix}{stall['name']}"] = x, -z, level.get("floor_m", 0.0)
    assert stalls.keys() == expected.keys()
    for name, place in expected.items():
        assert stalls[name]["move"] == pytest.approx(place, abs=1e-3), name


def test_the_launch_file_names_files_that_are_there(world):
    arguments, (started,) = launched(world.files[1])
    simulator, bridge, server, manager = run(started, arguments)
    assert simulator["source"] == "/opt/ros/share/ros_gz_sim/launch/gz_sim.launch.py"
    assert shlex.split(simulator["gz_args"]) == ["-r", str(world.path)]
    assert bridge["arguments"] == ["/clock@rosgraph_msgs/msg/Clock[gz.msgs.Clock"]
    (parameters,) = server["parameters"]
    assert parameters["yaml_filename"] == str(world.files[3])
    assert manager["parameters"][0]["node_names"] == ["map_server"]
    last = max(world.frame)
    *_, robot = run(started, arguments, robot="robot.sdf", spawn=last, headless="true")
    places = dict(zip(robot["arguments"][::2], robot["arguments"][1::2], strict=True))
    assert [float(places[f"-{axis}"]) for axis in "xyz"] == pytest.approx(world.frame[last]["move"], abs=1e-4)
    assert places["-world"] == "garage"
    with pytest.raises(RuntimeError, match="level: got 'attic'; allowed: "):
        run(started, arguments, level="attic")


def test_a_second_export_is_equal_and_takes_the_place_of_the_first(world):
    files = [path for path in world.path.parent.glob("my gar*/**/*") if path.is_file()] + [
        path for path in world.files if path.is_file()
    ]
    first = {path: path.read_bytes() for path in files}
    garage2usd.export(world.built.stage, [world.path])
    assert len(first) > 20
    assert {path: path.read_bytes() for path in files} == first


def test_the_axis_of_a_stage_changes_nothing(tmp_path):
    worlds = []
    for axis in "YZ":
        config = garage2usd.GarageConfig(**{**SETTINGS, "stage": {"up_axis": axis}})
        built = garage2usd.build(config, tmp_path / axis / "g.usdc")
        worlds.append(garage2usd.export(built.stage, [tmp_path / axis / "g.sdf"])[0].read_text())
    assert worlds[0] == worlds[1]
