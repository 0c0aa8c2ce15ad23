"""Readers of a garage of several levels, judged by programs and computations that are not ours."""

import json

import numpy as np
import pytest
import trimesh
from support.glb_reader import Glb, assert_like_the_stage
from support.gltf_validator import find_node, find_validator, validated
from support.label_tables import labelled_objects
from support.level_judge import LevelJudge
from support.places import MILLIMETRE
from support.small_levels import FLOORS_M, SMALL_LEVELS

import garage2usd

pytestmark = pytest.mark.client


@pytest.fixture(scope="module")
def built(tmp_path_factory):
    return garage2usd.build_levels(SMALL_LEVELS, tmp_path_factory.mktemp("levels") / "garage.usdz")


@pytest.fixture(scope="module")
def judge(built):
    return LevelJudge(built.stage)


@pytest.fixture(scope="module")
def scene(built):
    path = built.stage.with_suffix(".glb")
    garage2usd.export(built.stage, [path])
    return path


@pytest.mark.skipif(
    find_node() is None or find_validator() is None, reason="environment.sh test installs the validator"
)
def test_the_validator_finds_nothing_in_a_scene_of_levels(scene):
    issues = validated(scene)["issues"]
    assert (issues["numErrors"], issues["numWarnings"]) == (0, 0), issues["messages"]


def test_a_scene_has_all_objects_of_all_levels_where_the_stage_has_them(built, scene):
    assert_like_the_stage(scene.read_bytes(), built.stage, labelled_objects(built.labels))


def test_trimesh_finds_each_level_below_its_node(scene, judge):
    read = trimesh.load(scene)
    tree = read.graph.transforms
    for name, floor_m in FLOORS_M.items():
        node = f"/Garage/Levels/{name}"
        assert tree.parents[node] == "world"
        assert read.graph.get(node)[0][1, 3] == pytest.approx(floor_m)
        floors = [each for each in read.graph.nodes_geometry if each.startswith(node) and each.endswith("/Floor")]
        assert floors
        for floor in floors:
            matrix, shape = read.graph.get(floor)
            assert trimesh.transform_points(read.geometry[shape].vertices, matrix)[:, 1].max() < floor_m + 0.05
        stalls = [each for each in tree.nodes if each.startswith(f"stalls/{name}/")]
        assert len(stalls) == judge.stall_levels.count([*FLOORS_M].index(name))
        for stall in stalls:
            outline = judge.outlines[judge.stall_ids.index(stall.partition("/")[2])]
            assert np.abs(read.graph.get(stall)[0][:3, 3] - outline.mean(axis=0)).max() < MILLIMETRE


def test_no_material_of_a_scene_is_written_twice_and_cars_stand_in_stalls_of_their_level(scene):
    glb = Glb(scene.read_bytes())
    materials = [json.dumps(material, sort_keys=True) for material in glb.json["materials"]]
    assert len(set(materials)) == len(materials)
    cars = [node for node in glb.nodes if node.get("extras", {}).get("class") == "car"]
    homes = {(node["name"].split("/")[3], node["extras"]["stall"]["id"].partition("/")[0]) for node in cars}
    assert homes == {(name, name) for name in FLOORS_M}
