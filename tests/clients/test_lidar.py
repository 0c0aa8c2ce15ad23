"""What a LiDAR measures agrees with rays of Open3D, with what Cycles draws, and with the boxes of the objects."""

import importlib.util
import json
from types import SimpleNamespace

import numpy as np
import pytest
from PIL import Image
from pxr import Usd
from support.label_tables import cars_of_plates, labelled_objects
from support.sample_files import REPOSITORY
from support.sensor_judges import HAS_SENSOR_JUDGES, open3d_cast, run_judge
from support.soak import soak_but
from support.solid_triangles import solid_triangles

from garage2usd.reading.files import open_stage
from garage2usd.reading.labels import read_labels
from garage2usd.reading.lanes import read_lanes
from garage2usd.render import Picture, render_stage
from garage2usd.sensors.rays.lidar import rosette_beams, scan, spinning_beams
from garage2usd.sensors.rays.point_cloud import CloudFormat, write_cloud
from garage2usd.sensors.rays.ray_scene import read_ray_scene

pytestmark = pytest.mark.client
needs_open3d = pytest.mark.skipif(not HAS_SENSOR_JUDGES, reason="no environment with Open3D")
needs_blender = pytest.mark.skipif(
    importlib.util.find_spec("bpy") is None, reason="Blender's bpy is made for Python 3.11 only"
)

PAPER = REPOSITORY / "samples" / "paper_7x9.toml"
HAND_DRAWN = REPOSITORY / "samples" / "hand_drawn.toml"
RANGE_M = (0.3, 100.0)
MILLIMETRE = 0.001
NEAR_M = 20.0
SIZE = 320, 180


@pytest.fixture(scope="module")
def paper(builds):
    """The 7x9 garage with its rays, seen from a car's roof on a crossing of lanes."""
    built = builds(PAPER, "usdc")
    stage = open_stage(built.stage)
    labels = read_labels(stage, built.stage)
    node = [node.position for node in read_lanes(stage).nodes if not node.is_portal][5]
    place = np.eye(4)
    # x ahead along +X, y to the left along -Z, z up along +Y
    place[:3, :3] = np.array([[1, 0, 0], [0, 0, 1], [0, -1, 0]])
    place[:3, 3] = node[0], 1.8, node[1]
    table = {entry["path"]: entry for entry in labelled_objects(built.labels)}
    return SimpleNamespace(
        stage=Usd.Stage.Open(str(built.stage)),
        table=table,
        car_of=cars_of_plates(built.labels),
        scene=read_ray_scene(stage, labels),
        place=place,
        beams=spinning_beams(np.linspace(-25, 15, 64), 1024),
    )


def in_world(cloud, place):
    return cloud.points_m @ place[:3, :3].T + place[:3, 3]


@needs_open3d
def test_65536_ranges_are_those_of_open3d(paper, tmp_path):
    cloud = scan(paper.scene, paper.beams, paper.place, range_m=RANGE_M)
    ids = {path: paper.car_of.get(entry["id"], entry["id"]) for path, entry in paper.table.items()}
    sky = {entry["id"] for entry in paper.table.values() if entry["class"] == "sky"}
    vertices, triangles, owner = solid_triangles(paper.stage, ids, left_out=sky)
    directions = paper.beams.directions @ paper.place[:3, :3].T
    assert len(directions) == 65536
    origins = np.broadcast_to(paper.place[:3, 3], directions.shape)
    expected_m, hit = open3d_cast(vertices, triangles, origins, directions, tmp_path)
    measured_m, instance = np.full(65536, np.inf), np.zeros(65536, dtype=int)
    measured_m[cloud.beam] = np.linalg.norm(cloud.points_m.astype(float), axis=1)
    instance[cloud.beam] = cloud.instance
    # stains, which lie on what Open3D meets, were left out for it
    stain = np.isin(instance, [entry["id"] for entry in paper.table.values() if entry["class"] == "floor_stain"])
    assert stain.mean() < 0.01
    assert (np.isfinite(measured_m) == np.isfinite(expected_m)).mean() > 0.9999
    both = np.isfinite(measured_m) & np.isfinite(expected_m) & ~stain
    assert both.mean() > 0.98
    assert np.quantile(np.abs(measured_m - expected_m)[both], 0.999) < MILLIMETRE
    assert (instance[both] == owner[hit[both]]).mean() > 0.999


@needs_open3d
def test_cars_in_sight_have_points_and_none_outside_of_their_boxes(paper, tmp_path):
    cloud = scan(paper.scene, paper.beams, paper.place, range_m=RANGE_M)
    points = in_world(cloud, paper.place)
    cars = [entry for entry in paper.table.values() if entry["class"] == "car"]
    for car in cars:
        own = points[cloud.instance == car["id"]]
        pieces = [each for each in paper.table.values() if paper.car_of.get(each["id"], each["id"]) == car["id"]]
        assert (own > np.min([each["min_m"] for each in pieces], axis=0) - MILLIMETRE).all()
        assert (own < np.max([each["max_m"] for each in pieces], axis=0) + MILLIMETRE).all()
    for car, share in zip(cars, seen_shares(paper, cars, tmp_path), strict=True):
        if share > 0.01:
            assert (cloud.instance == car["id"]).sum() > 0, car["path"]


def seen_shares(paper, cars, folder):
    """Which share of each car's surface is near, between the lowest and highest beam, and in line of sight."""
    ids = {path: entry["id"] for path, entry in paper.table.items()}
    vertices, triangles, owner = solid_triangles(paper.stage, ids)
    chance, targets = np.random.default_rng(1), []
    for car in cars:
        own = vertices[triangles[owner == car["id"]]]
        area = np.linalg.norm(np.cross(own[:, 1] - own[:, 0], own[:, 2] - own[:, 0]), axis=1)
        chosen = own[chance.choice(len(own), 1000, p=area / area.sum())]
        weights = chance.dirichlet([1, 1, 1], 1000)
        targets.append((chosen * weights[:, :, None]).sum(axis=1))
    eye = paper.place[:3, 3]
    ways = np.concatenate(targets) - eye
    far = np.linalg.norm(ways, axis=1)
    met_m, _ = open3d_cast(vertices, triangles, np.broadcast_to(eye, ways.shape), ways / far[:, None], folder)
    elevation = np.degrees(np.arcsin(ways[:, 1] / far))
    seen = (met_m > far - MILLIMETRE) & (far < NEAR_M) & (elevation > -25) & (elevation < 15)
    shares = seen.reshape(len(cars), -1).mean(axis=1)
    assert (shares > 0.01).sum() > 10
    return shares


@needs_blender
@pytest.mark.parametrize("form", soak_but(1, ["instanced", "nested"]))
def test_rays_meet_what_cycles_draws(form, builds, tmp_path):
    import OpenEXR

    built = builds(HAND_DRAWN, "usdc", form)
    kinds = Picture.DEPTH, Picture.INSTANCE
    render_stage(built.stage, tmp_path, cameras=("Inside", "Drive"), frames="96", size_px=SIZE, pictures=kinds)
    stage = open_stage(built.stage)
    scene = read_ray_scene(stage, read_labels(stage, built.stage))
    class_of = {entry["id"]: entry["class"] for entry in labelled_objects(built.labels)} | {0: ""}
    frames = json.loads((tmp_path / "frames.json").read_text())["frames"]
    assert len(frames) == 2
    for frame in frames:
        with OpenEXR.File(str(tmp_path / frame["files"]["depth"]), separate_channels=True) as file:
            depth_m = np.array(file.channels()["Z"].pixels).ravel()
        drawn = np.asarray(Image.open(tmp_path / frame["files"]["instance"])).astype(int) @ [1, 256, 65536]
        rows, columns = np.mgrid[: SIZE[1], : SIZE[0]]
        middles = np.stack([columns + 0.5, rows + 0.5, np.ones_like(rows)], axis=-1).reshape(-1, 3)
        to_world = np.linalg.inv(frame["world_to_camera"])
        ways = middles @ np.linalg.inv(frame["intrinsics"]).T @ to_world[:3, :3].T
        long = np.linalg.norm(ways, axis=1)
        hits = scene.cast(to_world[:3, 3], ways / long[:, None])
        met = np.where(hits.triangle >= 0, scene.instance[hits.triangle], 0)
        is_sky = np.vectorize(class_of.get)(drawn.ravel()) == "sky"
        same = met == drawn.ravel()
        assert same[~is_sky].mean() > 1 - 0.002
        assert (scene.class_id[hits.triangle[hits.triangle >= 0]] > 0).all()
        solid = same & ~is_sky & (met > 0)
        # of the picture's depth, which is of single precision, as tests/clients/test_render.py finds it
        off_m = np.abs(hits.range_m - depth_m * long)[solid]
        assert np.quantile(off_m, 0.999) < MILLIMETRE


def test_a_rosette_scans_its_ellipse_alone(paper):
    beams = rosette_beams(70, 50, 20000, begins_s=0.3, lasts_s=0.1)
    ahead, left, up = beams.directions.T
    azimuth, elevation = np.degrees(np.arctan2(left, ahead)), np.degrees(np.arcsin(up))
    reach = np.hypot(azimuth / 35, elevation / 25)
    assert reach.max() < 1 + 1e-9
    assert reach.max() > 0.99
    cloud = scan(paper.scene, beams, paper.place, range_m=RANGE_M)
    assert len(cloud) > 15000


@needs_open3d
def test_open3d_and_pypcd4_read_the_same_pcd(paper, tmp_path):
    cloud = scan(paper.scene, paper.beams, paper.place, range_m=RANGE_M, range_noise_m=0.02)
    write_cloud(cloud, tmp_path / "a.pcd", CloudFormat.PCD)
    run_judge("pcd_dump.py", tmp_path / "a.pcd", tmp_path / "a.npz", folder=tmp_path)
    expected = {"intensity": cloud.intensity, "instance": cloud.instance, "class": cloud.class_id, "ring": cloud.ring}
    with np.load(tmp_path / "a.npz") as found:
        assert (found["open3d_positions"] == cloud.points_m).all()
        assert (np.stack([found[f"pypcd4_{axis}"] for axis in "xyz"], axis=1) == cloud.points_m).all()
        for name, values in expected.items():
            assert (found[f"pypcd4_{name}"] == values).all(), name
            assert (found[f"open3d_{name}"].ravel() == values).all(), name
