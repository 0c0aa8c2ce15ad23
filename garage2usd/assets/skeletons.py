"""The skeleton of a person: joints, their places at rest, and the places of bones and skin in a pose.

Lengths are shares of the stature by Drillis and Contini (1966). At rest a person stands upright with hanging arms and
all axes of the joints are those of the figure: X to its left, Y up, Z ahead. Left is +1, right is -1.
"""

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

Vectors = NDArray[np.float64]
SIDES = (1.0, -1.0)
THIGH, SHIN, ANKLE = 0.245, 0.246, 0.039
"""Lengths of the bones of a leg, and the height of the ankle."""
UPPER_ARM, FOREARM, HAND = 0.182, 0.143, 0.102
HIPS, HIP_X, SPINE, SHOULDER_Y, NECK_Y, CHIN_Y = 0.53, 0.048, 0.05, 0.285, 0.322, 0.345
"""Height of the hips, distance of a hip from the middle, and heights of joints and chin above the hips."""
NECK_Z, SHOULDER_Z = -0.006, -0.004
SPREAD_DEG, INWARDS_DEG, TOES_OUT_DEG = 9.0, 3.0, 8.0
"""At rest: upper arms outwards, forearms inwards, and toes outwards."""
HEEL_Z, BALL_Z, TIP_Z = -0.040, 0.075, 0.116
"""Heel, ball and tip of a shoe ahead of the ankle."""

_LIMBS = ("upper_arm", "forearm"), ("thigh", "shin", "foot", "toes")
JOINTS: tuple[str, ...] = (
    "hips", "spine", "head",
    *(f"{side}_{bone}" for limb in _LIMBS for side in ("left", "right") for bone in limb),
)  # fmt: skip
"""Names of the joints; parents come before their children."""
PARENTS: tuple[int, ...] = (-1, 0, 1, 1, 3, 1, 5, 0, 7, 8, 9, 0, 11, 12, 13)
"""Index of each joint's parent; -1 for the root."""


class Skeleton(NamedTuple):
    """Joints of a person at rest.

    Attributes
    ----------
    height_m
        Stature.
    rest_m
        Places of the joints; float64, shape (joints, 3).
    """

    height_m: float
    rest_m: Vectors

    def places_m(self, turns: Vectors, hips_m: ArrayLike) -> Vectors:
        """Places of the joints in poses.

        Parameters
        ----------
        turns
            Rotations of all joints in the axes of the figure; shape (..., joints, 3, 3).
        hips_m
            Place of the hips; shape (..., 3).
        """
        places = np.empty((*turns.shape[:-2], 3))
        places[..., 0, :] = hips_m
        for joint, parent in enumerate(PARENTS[1:], start=1):
            bone = self.rest_m[joint] - self.rest_m[parent]
            places[..., joint, :] = places[..., parent, :] + turns[..., parent, :, :] @ bone
        return places

    def skinned_m(self, points_m: Vectors, weights: Vectors, turns: Vectors, hips_m: ArrayLike) -> Vectors:
        """Places of points of the skin in one pose, by linear blending; shape (points, 3).

        Parameters
        ----------
        points_m, weights
            Points at rest, shape (points, 3), and the weights of the joints, shape (points, joints).
        turns, hips_m
            The pose, as for `places_m`.
        """
        moves = self.places_m(turns, hips_m) - np.einsum("jab,jb->ja", turns, self.rest_m)
        blended: Vectors = np.einsum("pj,jab,pb->pa", weights, turns, points_m) + weights @ moves
        return blended


def skeleton_of(height_m: float, shoulder_x: float) -> Skeleton:
    """Make the skeleton of a person with shoulders `shoulder_x` of the stature from the middle."""
    places: list[ArrayLike] = [(0.0, HIPS, 0.0), (0.0, HIPS + SPINE, 0.0), (0.0, HIPS + NECK_Y, NECK_Z)]
    for side in SIDES:
        shoulder = np.array([side * shoulder_x, HIPS + SHOULDER_Y, SHOULDER_Z])
        places += [shoulder, shoulder + UPPER_ARM * hanging(0.0, side * SPREAD_DEG)]
    out = np.radians(TOES_OUT_DEG)
    for x in (HIP_X, -HIP_X):
        ball = x + np.sign(x) * BALL_Z * np.sin(out), 0.0, BALL_Z * np.cos(out)
        places += [(x, HIPS, 0.0), (x, HIPS - THIGH, 0.0), (x, ANKLE, 0.0), ball]
    return Skeleton(height_m, height_m * np.array(places))


def hanging(forwards_deg: float, outwards_deg: float) -> Vectors:
    """Direction of a hanging limb that is swung forwards and towards +X."""
    pitch, out = np.radians(forwards_deg), np.radians(outwards_deg)
    return np.array([np.sin(out), -np.cos(pitch) * np.cos(out), np.sin(pitch) * np.cos(out)])


def about(axis: int, degrees: ArrayLike) -> Vectors:
    """Rotations about X (0), Y (1) or Z (2); shape (..., 3, 3). A turn about X lowers what is ahead."""
    angle = np.radians(np.asarray(degrees, dtype=float))
    one, two = (axis + 1) % 3, (axis + 2) % 3
    turns = np.zeros((*angle.shape, 3, 3))
    turns[..., axis, axis] = 1.0
    turns[..., one, one] = turns[..., two, two] = np.cos(angle)
    turns[..., two, one] = np.sin(angle)
    turns[..., one, two] = -turns[..., two, one]
    return turns


def quaternions(turns: Vectors) -> Vectors:
    """Rotations of joints to their parents as unit quaternions (x, y, z, w) without jumps of sign.

    Parameters
    ----------
    turns
        Rotations in the axes of the figure in successive poses; shape (poses, joints, 3, 3).

    Returns
    -------
    numpy.ndarray
        float64, shape (poses, joints, 4).
    """
    from scipy.spatial.transform import Rotation  # noqa: PLC0415 - slow to import, and not always needed

    local = turns.copy()
    local[:, 1:] = np.swapaxes(turns[:, list(PARENTS[1:])], -1, -2) @ turns[:, 1:]
    found = Rotation.from_matrix(local.reshape(-1, 3, 3)).as_quat(canonical=True).reshape(*turns.shape[:2], 4)
    flips = np.where((found[1:] * found[:-1]).sum(axis=2) < 0, -1.0, 1.0)
    found[1:] *= np.cumprod(flips, axis=0)[:, :, None]
    return np.asarray(found)


def turns_of(rotations: Vectors) -> Vectors:
    """Rotations in the axes of the figure of `quaternions`; shape (poses, joints, 3, 3)."""
    from scipy.spatial.transform import Rotation  # noqa: PLC0415 - slow to import, and not always needed

    turns = Rotation.from_quat(rotations.reshape(-1, 4)).as_matrix().reshape(*rotations.shape[:2], 3, 3)
    for joint, parent in enumerate(PARENTS[1:], start=1):
        turns[:, joint] = turns[:, parent] @ turns[:, joint]
    return np.asarray(turns)


def joint_paths() -> list[str]:
    """Names of the joints with those of the joints above them, as USD and Unity write them: ``hips/spine/head``."""
    paths: list[str] = []
    for name, parent in zip(JOINTS, PARENTS, strict=True):
        paths.append(name if parent < 0 else f"{paths[parent]}/{name}")
    return paths


def strongest(weights: Vectors) -> tuple[NDArray[np.int32], NDArray[np.float32]]:
    """The four strongest joints of each point, strongest first, and their weights, which add up to 1; shapes (n, 4)."""
    joints = np.argsort(-weights, axis=1, kind="stable")[:, :4].astype(np.int32)
    chosen = np.take_along_axis(weights, joints, axis=1)
    # formats ask for joint 0 where there is no weight
    joints[chosen == 0] = 0
    return joints, (chosen / chosen.sum(axis=1, keepdims=True)).astype(np.float32)


def along(points: Sequence[Vectors], shares: Sequence[float]) -> list[Vectors]:
    """Points on a chain of two bones: 0 at its first joint, 1 at the second, 2 at the third."""
    first, second, third = points
    return [
        first + (second - first) * share if share <= 1 else second + (third - second) * (share - 1) for share in shares
    ]
