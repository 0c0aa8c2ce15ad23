"""People's clothes, by generalized winding numbers, and the skin of their joints."""

import numpy as np
import pytest
from support.soak import soak_but

from garage2usd.assets.figures import Outfit, figure_asset, skinned_figure
from garage2usd.assets.gait import walking
from garage2usd.assets.poses import POSES
from garage2usd.assets.skeletons import JOINTS, quaternions, turns_of
from garage2usd.objects.person import PEOPLE

HEM_M = 0.07
"""Height above a hem from which on nothing is seen from below."""


def triangles(part, points):
    """The triangles of a part's faces, as fans; shape (n, 3, 3)."""
    corners, ends = part.face_indices, np.cumsum(part.face_counts)
    fans = [
        (loop[0], loop[at], loop[at + 1]) for loop in np.split(corners, ends[:-1]) for at in range(1, len(loop) - 1)
    ]
    return points[np.array(fans)]


def winding(points, faces):
    """How often closed faces go around each point, by solid angles (van Oosterom and Strackee)."""
    a, b, c = (faces[None, :, corner] - points[:, None] for corner in range(3))
    la, lb, lc = (np.linalg.norm(side, axis=2) for side in (a, b, c))
    volume = np.einsum("pti,pti->pt", a, np.cross(b, c))
    rest = la * lb * lc + (a * b).sum(2) * lc + (b * c).sum(2) * la + (c * a).sum(2) * lb
    return np.arctan2(volume, rest).sum(axis=1) / (2 * np.pi)


def shown_through(skin, posed, *, under="Bottom", over="Top"):
    """Points of clothes or legs above the hem over them that are not inside of it."""
    parts = skin.parts
    under, over = (next(at for at, part in enumerate(parts) if part.name == name) for name in (under, over))
    # sleeves reach lower than hems, further out
    middle = np.abs(parts[over].points[:, 0]) < 0.05
    hem, waist = parts[over].points[middle, 1].min(), 0.53 * skin.skeleton.height_m
    height, x = parts[under].points[:, 1], np.abs(parts[under].points[:, 0])
    # hands hang beside the skirt
    above = (height > hem + HEM_M) & (parts[under].name == "Bottom") | (
        (height > hem + HEM_M) & (height < waist) & (x < 0.1 * skin.skeleton.height_m)
    )
    inside = winding(posed[under][above], triangles(parts[over], posed[over]))
    return int((inside < 0.5).sum()), int(above.sum())


def moves(skin):
    """Poses of a stride, and all poses of people who stand."""
    stride = walking(skin.skeleton, 1.5, poses=8).motion
    yield from zip(stride.turns, stride.hips_m, strict=True)
    yield from ((pose.turns(), np.array([0.0, 0.9, 0.0])) for pose in POSES.values())


@pytest.mark.parametrize(
    "number", soak_but([7, 10], [at for at, own in enumerate(PEOPLE) if own.outfit is not Outfit.DRESS])
)
def test_trousers_stay_inside_of_the_upper_garment_in_all_poses_and_over_a_stride(number):
    skin = skinned_figure(PEOPLE[number])
    for turns, hips_m in moves(skin):
        through, asked = shown_through(skin, skin.posed_m(turns, hips_m))
        assert asked > 10
        assert through == 0


@pytest.mark.parametrize("number", [9, 12])
def test_legs_stay_inside_of_the_skirt(number):
    skin = skinned_figure(PEOPLE[number])
    for turns, hips_m in moves(skin):
        through, asked = shown_through(skin, skin.posed_m(turns, hips_m), under="Skin", over="Bottom")
        assert asked > 50
        assert through == 0


def test_the_winding_number_finds_trousers_that_come_through():
    skin = skinned_figure(PEOPLE[2])
    scales = [(1.2, 1.0, 1.2) if part.name == "Bottom" else (1.0, 1.0, 1.0) for part in skin.parts]
    wide = [part.points.astype(float) * scale for part, scale in zip(skin.parts, scales, strict=True)]
    assert shown_through(skin, wide)[0] > 5


@pytest.mark.parametrize("number", [0, 9])
def test_the_skin_follows_at_most_four_joints_and_stays_at_rest(number):
    skin = skinned_figure(PEOPLE[number])
    still = np.broadcast_to(np.eye(3), (len(JOINTS), 3, 3))
    for part, weights, posed in zip(
        skin.parts, skin.weights, skin.posed_m(still, skin.skeleton.rest_m[0]), strict=True
    ):
        assert weights.shape == (len(part.points), len(JOINTS))
        assert np.allclose(weights.sum(axis=1), 1.0)
        assert weights.min() >= 0.0
        assert (weights > 0).sum(axis=1).max() <= 4
        assert np.abs(posed - part.points).max() < 1e-6


def test_a_pose_moves_the_mesh_as_its_joints_move_the_skin():
    figure, pose = PEOPLE[0], POSES["walking"]
    skin, made = skinned_figure(figure), figure_asset(figure, pose)
    posed = skin.posed_m(pose.turns(), np.zeros(3))
    low = next(own[:, 1].min() for part, own in zip(skin.parts, posed, strict=True) if part.name == "Shoes")
    for part, own in zip(made.parts, posed, strict=False):
        assert np.abs(part.points.min(axis=0) - (own.min(axis=0) - (0.0, low, 0.0))).max() < 1e-4
        assert np.abs(part.points.max(axis=0) - (own.max(axis=0) - (0.0, low, 0.0))).max() < 1e-4


def test_quaternions_of_joints_give_their_rotations_back():
    turns = np.array([pose.turns() for pose in POSES.values()])
    assert np.abs(turns_of(quaternions(turns)) - turns).max() < 1e-12
