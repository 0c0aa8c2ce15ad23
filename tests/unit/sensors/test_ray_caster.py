"""Rays without Embree meet what Embree's meet."""

import numpy as np
import pytest
import trimesh
from pxr import Usd
from support.sample_files import REPOSITORY

from garage2usd.reading.labels import read_labels
from garage2usd.recordings.birds_eye import ego_mask
from garage2usd.sensors.rays import ray_caster
from garage2usd.sensors.rays.ray_caster import BoxTree, _Embree
from garage2usd.sensors.rays.ray_scene import read_ray_scene
from garage2usd.sensors.rig.rig import read_rig

SINGLE_M = 1e-4
"""How far apart two surfaces may be of which single precision does not tell the nearer one."""


def rays(count, low, high, seed=0):
    draws = np.random.default_rng(seed)
    directions = draws.normal(size=(count, 3))
    directions /= np.linalg.norm(directions, axis=1)[:, None]
    return low + (high - low) * draws.random((count, 3)), directions


def nearest_of_all(corners, origin, direction):
    """The nearest triangle by solving for the place in each: no tree, and another formula."""
    best, found = np.inf, -1
    for number, (first, second, third) in enumerate(corners):
        matrix = np.stack([second - first, third - first, -direction], axis=1)
        if abs(np.linalg.det(matrix)) > 1e-12:
            u, v, along = np.linalg.solve(matrix, origin - first)
            if u >= 0 and v >= 0 and u + v <= 1 and 0 < along < best:
                best, found = along, number
    return found


@pytest.mark.parametrize("count", [1, 2, 3, 4, 5, 63, 300])
def test_the_nearest_of_all_triangles_is_found(count):
    draws = np.random.default_rng(count)
    corners = draws.random((count, 1, 3)) * 10 + draws.normal(size=(count, 3, 3))
    tree = BoxTree(corners.reshape(-1, 3), np.arange(3 * count).reshape(-1, 3))
    origins, directions = rays(200, np.zeros(3), np.full(3, 10.0), count)
    aims = corners[np.arange(100) % count].mean(axis=1) - origins[:100]  # the others mostly miss
    directions[:100] = aims / np.linalg.norm(aims, axis=1)[:, None]
    expected = [nearest_of_all(corners, *ray) for ray in zip(origins, directions, strict=True)]
    assert tree.first(origins, directions).tolist() == expected
    assert len(set(expected)) > 1


def test_rays_along_axes_and_through_edges_and_corners_pass_no_gap():
    box = trimesh.creation.box((2.0, 2.0, 2.0)).subdivide().subdivide()
    tree = BoxTree(box.vertices, box.faces)
    middles = (box.vertices[box.edges[:, 0]] + box.vertices[box.edges[:, 1]]) / 2
    aims = np.concatenate([box.vertices, middles, np.eye(3), -np.eye(3)])
    directions = aims / np.linalg.norm(aims, axis=1)[:, None]
    assert (tree.first(np.zeros_like(directions), directions) >= 0).all()
    away = tree.first(3 * directions, directions)
    assert (away == -1).all()


def test_no_rays_and_triangles_without_area():
    tree = BoxTree(np.zeros((3, 3)), np.array([[0, 1, 2], [0, 0, 0]]))
    assert tree.first(np.empty((0, 3)), np.empty((0, 3))).tolist() == []
    assert tree.first(*rays(5, np.full(3, -1.0), np.ones(3))).tolist() == [-1] * 5


@pytest.mark.soak
def test_a_garage_gives_the_same_hits_as_by_embree(builds, monkeypatch):
    made = builds(REPOSITORY / "samples" / "hand_drawn.toml", "usdc", "instanced")
    stage = Usd.Stage.Open(str(made.stage))
    scene = read_ray_scene(stage, read_labels(stage, made.stage))
    low, high = scene.vertices_m.min(axis=0), scene.vertices_m.max(axis=0)
    origins, directions = rays(3000, low, high)
    assert isinstance(scene._caster, _Embree)
    expected = scene.cast(origins, directions)
    monkeypatch.setattr(ray_caster, "HAS_EMBREE", False)
    vars(scene).pop("_caster")
    found = scene.cast(origins, directions)
    assert isinstance(scene._caster, BoxTree)
    assert ((found.triangle >= 0) == (expected.triangle >= 0)).all()
    hit = found.triangle >= 0
    assert hit.mean() > 0.5
    assert found.range_m[hit] == pytest.approx(expected.range_m[hit], abs=SINGLE_M)
    assert (found.triangle[hit] == expected.triangle[hit]).mean() > 0.98


def test_the_mask_of_the_own_car_is_the_same(monkeypatch):
    rig = read_rig("avp_surround").scaled(0.1)
    camera = rig.cameras[0]
    expected = ego_mask(camera, rig.body)
    monkeypatch.setattr(ray_caster, "HAS_EMBREE", False)
    found = ego_mask(camera, rig.body)
    assert 0.01 < found.mean() < 0.9
    assert (found == expected).mean() > 0.999
