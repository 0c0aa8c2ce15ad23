"""Packages for CARLA: the FBX as Blender and assimp read it, roads as CARLA's parser does, and the client's program."""

import json
import os
import subprocess
import sys
import zipfile
from collections import defaultdict
from pathlib import Path

import numpy as np
import pytest
from pxr import Usd, UsdGeom, UsdPhysics, UsdShade
from scipy.spatial import ConvexHull, cKDTree
from support.carla_importer import Collisions
from support.label_tables import labelled_objects
from support.map_judges import HAS_JUDGES, JUDGES, carla_map
from support.opendrive_judge import MapJudge
from support.sample_files import LEVELS_SAMPLE

import garage2usd
from garage2usd.config import TrafficConfig
from garage2usd.garage_sources import read_built
from garage2usd.maps.carla_names import plain_name
from garage2usd.track_forms import write_tracks
from garage2usd.traffic import Operation

pytest.importorskip("bpy", reason="Blender's bpy is made for Python 3.11 only")
assimp = pytest.importorskip("assimp_py")
pytestmark = pytest.mark.client
NEAR_M = 1e-3
MOST_S, MOST_BYTES = 60, 60e6
ACTORS = {"car", "van", "truck", "number_plate"}
CLIENTS = Path(__file__).parent
needs_judges = pytest.mark.skipif(not HAS_JUDGES, reason="no environment with CARLA's wheel")


class Package:
    """A package, unpacked, and the stage that it was made of."""

    def __init__(self, config, folder):
        self.folder = folder
        self.stage = garage2usd.build(config, folder / "a garage.v2.usdc").stage
        begin = sum(os.times()[:4])  # of Blender too
        (self.archive,) = garage2usd.export(self.stage, [folder / "a garage.v2.carla.zip"])
        self.seconds = sum(os.times()[:4]) - begin
        with zipfile.ZipFile(self.archive) as packed:
            packed.extractall(folder / "out")
        self.whole = folder / "out" / "a_garage_v2"
        self.map = self.whole / "Import" / "a_garage_v2" / "a_garage_v2"
        self.fbx, self.xodr = self.map / "a_garage_v2.fbx", self.map / "a_garage_v2.xodr"
        self.garage = json.loads((self.whole / "garage.json").read_text())
        self.expected = Expected(self.stage)


class Expected:
    """Triangles and colliders of each object of a stage, as USD alone has them; metres, Z up, y to the north."""

    def __init__(self, path):
        stage, self.places = Usd.Stage.Open(str(path)), UsdGeom.XformCache()
        entries = labelled_objects(path.with_name(f"{path.stem}_labels.json"))
        self.number_of = {entry["path"]: entry["id"] for entry in entries}
        self.class_of = {entry["id"]: entry["class"] for entry in entries}
        self.triangles = defaultdict(lambda: defaultdict(list))
        self.hulls = defaultdict(list)
        for prim in Usd.PrimRange(stage.GetPseudoRoot(), Usd.TraverseInstanceProxies()):
            if prim.IsA(UsdGeom.PointInstancer):
                self._of_points(prim)
            elif prim.IsA(UsdGeom.Mesh) and UsdGeom.Imageable(prim).ComputeVisibility() != "invisible":
                number = self._owner(str(prim.GetPath()))
                if number and self.class_of[number] not in ACTORS:
                    self._add(number, prim, np.array(self.places.GetLocalToWorldTransform(prim)))

    def _of_points(self, prim):
        raise AssertionError(f"{prim.GetPath()}: instancers are for forms that this test does not build")

    def _owner(self, path):
        while path and path not in self.number_of:
            path = path.rpartition("/")[0]
        return self.number_of.get(path, 0)

    def _add(self, number, prim, matrix):
        mesh = UsdGeom.Mesh(prim)
        points = np.array(mesh.GetPointsAttr().Get(), dtype=float) @ matrix[:3, :3] + matrix[3, :3]
        points = points[:, [0, 2, 1]] * (1, -1, 1)
        counts, corners = (
            np.array(own.Get()) for own in (mesh.GetFaceVertexCountsAttr(), mesh.GetFaceVertexIndicesAttr())
        )
        starts = np.cumsum(counts) - counts
        children = prim.GetFilteredChildren(Usd.TraverseInstanceProxies())
        subsets = [UsdGeom.Subset(child) for child in children if child.IsA(UsdGeom.Subset)]
        bound = {face: finish_of(own) for own in subsets for face in own.GetIndicesAttr().Get()}
        usual = finish_of(mesh) if len(bound) < len(counts) else ""
        for face, (start, count) in enumerate(zip(starts.tolist(), counts.tolist(), strict=True)):
            polygon = points[corners[start : start + count]]
            # signed areas of a fan add up to that of the polygon, convex or not
            fan = np.stack([np.repeat(polygon[:1], count - 2, axis=0), polygon[1:-1], polygon[2:]], axis=1)
            self.triangles[number][bound.get(face, usual)].append(fan)
        if prim.HasAPI(UsdPhysics.CollisionAPI):
            form = prim.GetAttribute("physics:approximation").Get()
            if form == "convexHull":
                self.hulls[number].append(ConvexHull(points))
            if form == "boundingCube":
                own = np.array(mesh.GetPointsAttr().Get(), dtype=float)
                low, high = own.min(axis=0), own.max(axis=0)
                box = np.array([[x, y, z] for x in (0, 1) for y in (0, 1) for z in (0, 1)]) * (high - low) + low
                box = (box @ matrix[:3, :3] + matrix[3, :3])[:, [0, 2, 1]] * (1, -1, 1)
                if min(np.linalg.svd(box - box.mean(axis=0), compute_uv=False)) > 1e-5:
                    self.hulls[number].append(ConvexHull(box))


def finish_of(bound):
    """The name of the substance of what is bound to a mesh or a subset."""
    material = UsdShade.MaterialBindingAPI(bound.GetPrim()).ComputeBoundMaterial()[0].GetPrim()
    finish = material.GetAttribute("garage:material:finish")
    return (finish.Get() if finish else None) or material.GetName()


def area(triangles):
    """The vector area: it tells sides apart, and a mirrored mesh from its image."""
    return np.cross(triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 0]).sum(axis=0) / 2


def by_blender(package):
    """Triangles of each mesh by material in metres, and the pictures, by Blender."""
    output = package.folder / "blender.npz"
    command = [sys.executable, "-P", CLIENTS / "carla_fbx_dump.py", package.fbx, output]
    subprocess.run([str(word) for word in command], check=True, capture_output=True)
    with np.load(output) as arrays:
        said, found = json.loads(str(arrays["said"])), {}
        for number, mesh in enumerate(said["meshes"]):
            triangles, surfaces = arrays[f"triangles_{number}"], arrays[f"materials_{number}"]
            names = mesh["materials"] or [""]
            found[mesh["name"]] = {name: triangles[surfaces == place] for place, name in enumerate(names)}
            if mesh["materials"]:  # normals point to the side from which a triangle is drawn
                a, b, c = np.moveaxis(triangles, 1, 0)
                faced = np.einsum("ij,ikj->ik", np.cross(b - a, c - a), arrays[f"normals_{number}"])
                assert (faced > -1e-9).mean() > 0.99, mesh["name"]
    return found, said["images"]


def by_assimp(package):
    """The same by assimp, which turns scenes to Y up and leaves centimetres."""
    scene = assimp.import_file(str(package.fbx), assimp.Process_Triangulate)
    found, pictures = defaultdict(dict), set()

    def visit(node, above):
        matrix = above @ np.array(node.transformation)
        for number in node.mesh_indices:
            mesh = scene.meshes[number]
            points = np.array(mesh.vertices, dtype=float).reshape(-1, 3) @ matrix[:3, :3].T + matrix[:3, 3]
            x, y, z = np.moveaxis(points / 100, 1, 0)
            material = scene.materials[mesh.material_index]
            pictures.update(name for names in material["TEXTURES"].values() for name in names)
            name = material["NAME"] if not node.name.startswith("UCX_") else ""
            found[node.name][name] = np.stack([x, -z, y], axis=1)[np.array(mesh.indices).reshape(-1, 3)]
        for child in node.children:
            visit(child, matrix)

    visit(scene.root_node, np.eye(4))
    return dict(found), pictures


def complaints(package, found):
    """What differs between the meshes of a file and the objects of the stage."""
    expected = package.expected
    table = {mesh["mesh"]: mesh for mesh in package.garage["meshes"]}
    if (drawn := {name for name in found if not name.startswith("UCX_")}) != table.keys():
        yield f"meshes: {drawn ^ table.keys()}"
    if {mesh["id"] for mesh in table.values()} != expected.triangles.keys():
        yield "not one mesh for each object of the labels"
    colliders = Collisions(list(found)).of
    for name, mesh in table.items():
        if mesh["class"] != expected.class_of[mesh["id"]]:
            yield f"{name} is {mesh['class']}"
        stage = {own: np.concatenate(parts) for own, parts in expected.triangles[mesh["id"]].items()}
        yield from (f"{name}: {fault}" for fault in of_triangles(found[name], stage))
        own = [ConvexHull(np.concatenate([*found[each].values()]).reshape(-1, 3)) for each in colliders[name]]
        yield from (f"{name}: {fault}" for fault in of_colliders(own, expected.hulls[mesh["id"]]))


def of_triangles(found, stage):
    file = defaultdict(list)
    for material, triangles in found.items():
        file[next((own for own in stage if plain_name(own) == material.rpartition("_")[0]), material)].append(triangles)
    if file.keys() != stage.keys():
        yield f"materials {sorted(file)} for {sorted(stage)}"
        return
    for own, parts in file.items():
        triangles = np.concatenate(parts)
        if np.abs(area(triangles) - area(stage[own])).max() > 1e-3 * max(1.0, np.abs(area(stage[own])).max()):
            yield f"area of {own} {area(triangles)} for {area(stage[own])}"
        points = triangles.reshape(-1, 3), stage[own].reshape(-1, 3)
        off = max(cKDTree(one).query(other)[0].max() for one, other in (points, points[::-1]))
        if off > NEAR_M:
            yield f"{own} is off by {off}"


def of_colliders(own, stage):
    own, stage = (sorted(each, key=lambda hull: hull.volume) for each in (own, stage))
    if len(own) != len(stage):
        yield f"{len(own)} colliders for {len(stage)}"
    elif any(abs(a.volume - b.volume) > 1e-6 + 1e-3 * b.volume for a, b in zip(own, stage, strict=True)):
        yield "colliders of other volumes"
    elif own:
        points = [np.concatenate([hull.points[hull.vertices] for hull in each]) for each in (own, stage)]
        if cKDTree(points[1]).query(points[0])[0].max() > NEAR_M:
            yield "colliders elsewhere"


@pytest.fixture(scope="module")
def default(tmp_path_factory):
    return Package(garage2usd.GarageConfig(), tmp_path_factory.mktemp("default"))


@pytest.fixture(scope="module")
def levels(tmp_path_factory):
    config = garage2usd.load_config(LEVELS_SAMPLE)
    smaller = config.site.model_copy(update={"width_cells": 8, "height_cells": 9})
    return Package(config.model_copy(update={"site": smaller}), tmp_path_factory.mktemp("levels"))


@pytest.fixture(scope="module")
def small(tmp_path_factory):
    return Package(
        garage2usd.GarageConfig(site={"width_cells": 5, "height_cells": 6}), tmp_path_factory.mktemp("small")
    )


@pytest.fixture(params=["default", pytest.param("levels", marks=pytest.mark.soak)])
def package(request):
    return request.getfixturevalue(request.param)


@pytest.mark.parametrize("reader", [by_blender, by_assimp])
def test_the_meshes_are_those_of_the_stage(package, reader):
    found, pictures = reader(package)
    assert list(complaints(package, found)) == []
    there = {path.name for path in package.map.iterdir() if path.suffix in {".png", ".jpg"}}
    assert set(pictures) == there
    if isinstance(pictures, dict):
        assert all(min(size) > 0 for size in pictures.values())


def test_the_reader_would_notice(default):
    found, _ = by_assimp(default)
    name = next(mesh["mesh"] for mesh in default.garage["meshes"] if mesh["class"] == "wall")
    for changed in (lambda own: own * (1, -1, 1), lambda own: own + np.array([0, 0, 0.002]), lambda own: own[:, ::-1]):
        planted = {**found, name: {key: changed(own) for key, own in found[name].items()}}
        assert list(complaints(default, planted))


def test_an_archive_takes_a_minute_and_sixty_megabytes_at_most(default):
    assert default.archive.stat().st_size < MOST_BYTES
    assert default.seconds < MOST_S


def test_the_same_stage_gives_the_same_bytes(small, tmp_path, monkeypatch):
    monkeypatch.setenv("PYTHONHASHSEED", "7")  # of which Blender's ids are made
    (again,) = garage2usd.export(small.stage, [tmp_path / "other" / small.archive.name])
    assert again.read_bytes() == small.archive.read_bytes()


@needs_judges
def test_carla_drives_as_the_lane_graph_does(default, tmp_path):
    assert list(MapJudge(default.stage, default.xodr, tmp_path).of_carla()) == []


@needs_judges
def test_spawn_points_lie_on_lanes_of_carla_s_map(package, tmp_path):
    points, _ = carla_map(package.xodr, tmp_path)
    spawns = package.garage["spawn_points"]
    assert any(spawn["is_entrance"] for spawn in spawns)
    for spawn in spawns:
        lane = points[(points[:, 0] == spawn["road"]) & (points[:, 1] == spawn["lane"])]
        place = np.array([spawn["x"], spawn["y"], spawn["z"]])
        near = lane[np.linalg.norm(lane[:, 2:5] - place, axis=1).argmin()]
        yaw = np.radians(near[5])
        aside = (place - near[2:5])[:2] @ (-np.sin(yaw), np.cos(yaw))
        assert abs(aside) < 0.02
        assert abs(place[2] - near[4]) < 0.06
        assert np.cos(np.radians(spawn["yaw_deg"]) - yaw) > 0.999
    assert {spawn["level"] for spawn in spawns} == {spot["level"] for spot in package.garage["parking_spots"]}


@needs_judges
def test_the_client_parks_the_cars_of_the_stage_and_plays_tracks(small, tmp_path):
    operation = Operation(read_built(small.stage).garage)
    tracks = operation.run(TrafficConfig(minutes=1, arrivals_per_hour=300, trolleys=0.5), seed=3)
    write_tracks(tmp_path / "run.csv", tracks, operation.garage)
    output = tmp_path / "played.json"
    command = [JUDGES / "bin/python", CLIENTS / "carla_play.py", small.whole / "play_in_carla.py", output]
    run = subprocess.run(
        [str(word) for word in (*command, "--tracks", tmp_path / "run.csv")],
        capture_output=True,
        text=True,
        check=False,
    )
    assert run.returncode == 0, run.stderr
    said = json.loads(output.read_text())
    assert said["loaded"][0] == "a_garage_v2"
    assert said["roles"] == ["garage2usd"]
    assert said["cleared"] == 0
    assert not said["is_synchronous"]
    moving = {track.agent.prim for track in tracks} - {""}
    expected = [car for car in small.garage["parked_cars"] if car["prim"] not in moving]
    assert len(said["left"]) == len(expected) > 10
    for (kind, x, y, z, yaw, _), car in zip(said["left"], expected, strict=True):
        assert np.allclose((x, y, z), (car["x"], car["y"], car["z"]), atol=NEAR_M)
        assert np.cos(np.radians(yaw - car["yaw_deg"])) > 1 - 1e-6
        assert kind.startswith("vehicle.a.")
    times = np.arange(len(said["frames"])) * tracks.step_s
    assert len(said["frames"]) == round(tracks.duration_s / tracks.step_s) + 1
    states = np.stack([track.at(times) for track in tracks])
    for number in range(0, len(times), 50):
        own = [state for state in states[:, number] if np.isfinite(state).all()]
        actors = np.array([row[1:] for row in said["frames"][number][len(expected) :]]).reshape(-1, 5)
        assert len(own) == len(actors)
        for x, y, z, yaw, pitch in own:
            off = np.linalg.norm(actors[:, :3] - (x, z, y), axis=1)
            nearest = off.argmin()
            assert off[nearest] < 0.02
            heading = np.radians(actors[nearest, 3])
            assert np.allclose((np.cos(heading), np.sin(heading)), (-np.sin(yaw), -np.cos(yaw)), atol=1e-3)
            assert np.radians(actors[nearest, 4]) == pytest.approx(pitch, abs=1e-3)


def test_parked_cars_stand_where_those_of_the_stage_do(package):
    stage, places = Usd.Stage.Open(str(package.stage)), UsdGeom.XformCache()
    for car in package.garage["parked_cars"]:
        prim = stage.GetPrimAtPath(car["prim"])
        forward = -np.array(places.GetLocalToWorldTransform(prim))[2, :3]
        yaw = np.radians(car["yaw_deg"])
        assert np.allclose((np.cos(yaw), np.sin(yaw)), forward[[0, 2]] / np.hypot(*forward[[0, 2]]), atol=1e-4)
