"""Walkers in glTF: skinned by the rules of its specification with json and numpy alone, and by Khronos' validator."""

import numpy as np
import pytest
from scipy.spatial.transform import Rotation
from support.glb_reader import Glb
from support.gltf_validator import find_node, find_validator, validated

from garage2usd.assets.figures import skinned_figure
from garage2usd.assets.gait import walked
from garage2usd.maps.glb_walkers import walkers_glb
from garage2usd.objects.person import PEOPLE
from garage2usd.stage.walkers import Walker

TIMES = np.arange(40) / 20


def a_walker(name="Person_1", number=9):
    yaws = 0.3 + 0.4 * TIMES
    ground = np.cumsum(np.column_stack([np.sin(yaws), np.cos(yaws)]) * 1.3 / 20, axis=0)
    places = np.column_stack([ground[:, 0], np.full(len(TIMES), 0.2), ground[:, 1]])
    figure = PEOPLE[number]
    return Walker(name, figure, places, yaws, walked(skinned_figure(figure).skeleton, TIMES, ground, yaws))


def world_matrices(document, values_at):
    """Matrices of all nodes for columns, with animated values in place of the nodes' own."""
    nodes = document["nodes"]
    local = []
    for number, node in enumerate(nodes):
        own = {name: node.get(name) for name in ("translation", "rotation")} | values_at.get(number, {})
        matrix = np.eye(4)
        matrix[:3, :3] = Rotation.from_quat(
            own["rotation"] if own["rotation"] is not None else (0, 0, 0, 1)
        ).as_matrix()
        matrix[:3, 3] = own["translation"] if own["translation"] is not None else (0, 0, 0)
        local.append(matrix)
    parents = {child: number for number, node in enumerate(nodes) for child in node.get("children", [])}

    def world(number):
        return world(parents[number]) @ local[number] if number in parents else local[number]

    return [world(number) for number in range(len(nodes))]


@pytest.mark.parametrize("frame", [0, 17, 39])
def test_gltf_moves_the_skin_as_the_gait_does(frame):
    walker = a_walker()
    glb = Glb(walkers_glb([a_walker("Person_0", 3), walker], TIMES))
    document, values = glb.json, {}
    for animation in document["animations"]:
        for channel in animation["channels"]:
            sampler = animation["samplers"][channel["sampler"]]
            assert np.allclose(glb.array(sampler["input"]).ravel(), TIMES)
            node, path = channel["target"]["node"], channel["target"]["path"]
            values.setdefault(node, {})[path] = glb.array(sampler["output"])[frame]
    world = world_matrices(document, values)
    skin = skinned_figure(walker.figure)
    posed = skin.posed_m(walker.motion.turns[frame], walker.motion.hips_m[frame])
    cos, sin = np.cos(walker.yaws_rad[frame]), np.sin(walker.yaws_rad[frame])
    turn = np.array([(cos, 0.0, sin), (0.0, 1.0, 0.0), (-sin, 0.0, cos)])
    for part, points in zip(skin.parts, posed, strict=True):
        node = next(own for own in document["nodes"] if own["name"] == f"Person_1_{part.name}")
        (primitive,) = document["meshes"][node["mesh"]]["primitives"]
        own = document["skins"][node["skin"]]
        binds = glb.array(own["inverseBindMatrices"]).reshape(-1, 4, 4).transpose(0, 2, 1)
        moves = np.array([world[joint] @ bind for joint, bind in zip(own["joints"], binds, strict=True)])
        at = {name: glb.array(number) for name, number in primitive["attributes"].items()}
        blended = np.einsum("vj,vjab->vab", at["WEIGHTS_0"], moves[at["JOINTS_0"].astype(int)])
        found = np.einsum("vab,vb->va", blended, np.column_stack([at["POSITION"], np.ones(len(at["POSITION"]))]))[:, :3]
        expected = points @ turn.T + walker.places_m[frame]
        # each vertex is one of the points, with one of its normals
        nearest = np.abs(found[:, None] - expected[None]).max(axis=2).min(axis=1)
        assert nearest.max() < 2e-4, part.name
        assert len(found) >= len(points)


@pytest.mark.skipif(not (find_node() and find_validator()), reason="gltf-validator is not installed")
def test_khronos_validator_finds_nothing(tmp_path):
    (tmp_path / "walkers.glb").write_bytes(walkers_glb([a_walker(), a_walker("Person_2", 3)], TIMES))
    issues = validated(tmp_path / "walkers.glb")["issues"]
    assert not issues["numErrors"] + issues["numWarnings"], issues["messages"]


def test_the_same_walkers_give_the_same_bytes():
    assert walkers_glb([a_walker()], TIMES) == walkers_glb([a_walker()], TIMES)
