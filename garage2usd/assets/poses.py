"""Poses of people who stand still: angles of their limbs, and the rotations of the joints."""

from dataclasses import dataclass, replace

import numpy as np

from garage2usd.assets.skeletons import (
    INWARDS_DEG,
    SIDES,
    SPREAD_DEG,
    TOES_OUT_DEG,
    Vectors,
    about,
)

TOES_BEND_DEG = 35.0
"""Greatest angle between a foot and its toes on the floor; then the foot turns about the tip."""


@dataclass(frozen=True)
class Pose:
    """Pose of a person: angles of the left and right limbs in degrees, forwards positive.

    Attributes
    ----------
    hips, knees, feet
        Angles of the thighs to the vertical, of the shins backwards to the thighs, and of the toes downwards.
    shoulders, elbows, spread, inwards
        Angles of the upper arms to the trunk, of the forearms to the upper arms, of the upper arms outwards and of the
        forearms inwards.
    lean, nod, turn
        Angles of the trunk, and of the head forwards and to the left.
    """

    hips: tuple[float, float] = (0.0, 0.0)
    knees: tuple[float, float] = (2.0, 2.0)
    feet: tuple[float, float] = (0.0, 0.0)
    shoulders: tuple[float, float] = (3.0, 3.0)
    elbows: tuple[float, float] = (14.0, 14.0)
    spread: tuple[float, float] = (9.0, 9.0)
    inwards: tuple[float, float] = (3.0, 3.0)
    lean: float = 0.0
    nod: float = 0.0
    turn: float = 0.0
    has_phone: bool = False
    has_bag: bool = False

    def turns(self) -> Vectors:
        """Rotations of the joints in the axes of the figure; shape (joints, 3, 3)."""
        spine = about(0, self.lean)
        turns = [np.eye(3), spine, about(1, self.turn) @ about(0, self.lean * 0.4 + self.nod)]
        for index in (0, 1):
            arm = self.shoulders[index], self.elbows[index], self.spread[index], self.inwards[index]
            turns += [spine @ bone for bone in arm_turns(index, *arm)]
        for index in (0, 1):
            thigh, foot = self.hips[index], self.feet[index]
            out = about(1, SIDES[index] * TOES_OUT_DEG)
            toes = max(foot - TOES_BEND_DEG, min(foot, 0.0))
            turns += [about(0, -thigh), about(0, self.knees[index] - thigh)]
            turns += [out @ about(0, pitch) @ out.T for pitch in (foot, toes)]
        return np.array(turns)


def arm_turns(
    index: int, shoulder_deg: Vectors | float, elbow_deg: Vectors | float, spread_deg: float, inwards_deg: float
) -> tuple[Vectors, Vectors]:
    """Rotations of upper arm and forearm in the axes of the trunk: forwards, bent, outwards and inwards."""
    side = SIDES[index]
    upper = about(0, -np.asarray(shoulder_deg)) @ about(2, side * (spread_deg - SPREAD_DEG))
    forearm = about(0, -np.asarray(shoulder_deg) - elbow_deg) @ about(2, side * (INWARDS_DEG - inwards_deg))
    return upper, forearm


_STANDING = Pose(hips=(4.0, -2.0), knees=(8.0, 2.0), shoulders=(2.0, -2.0), elbows=(16.0, 10.0), turn=18.0)
_STRIDE = Pose(hips=(23.6, -17.2), knees=(5.6, 12.0), feet=(-16.0, 19.0))
"""A stride as the heel touches the floor, by the angles of `garage2usd.assets.gait`."""
POSES: dict[str, Pose] = {
    "standing": _STANDING,
    "walking": replace(_STRIDE, shoulders=(-20.0, 24.0), elbows=(18.0, 30.0), spread=(7.0, 7.0), lean=4.0),
    "phone": replace(
        _STANDING,
        shoulders=(-2.0, 28.0),
        elbows=(12.0, 92.0),
        spread=(9.0, 4.0),
        nod=28.0,
        turn=-6.0,
        has_phone=True,
        inwards=(3.0, 24.0),
    ),
    "carrying": replace(
        _STANDING, shoulders=(2.0, 4.0), elbows=(10.0, 6.0), spread=(8.0, 12.0), turn=-20.0, has_bag=True
    ),
    "pushing": replace(_STRIDE, shoulders=(34.0, 34.0), elbows=(46.0, 46.0), spread=(6.0, 6.0), lean=8.0, nod=4.0),
    "folded": replace(
        _STANDING, shoulders=(22.0, 16.0), elbows=(66.0, 76.0), spread=(5.0, 5.0), inwards=(64.0, 62.0), turn=30.0
    ),
}
"""Poses by name."""
