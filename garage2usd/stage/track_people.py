"""People of tracks as figures that walk: their looks, and the poses of their joints along the track."""

import zlib
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from garage2usd.assets.figures import Figure
from garage2usd.assets.gait import Motion, walked
from garage2usd.assets.skeletons import ANKLE, BALL_Z, HEEL_Z, JOINTS, TIP_Z, Skeleton, turns_of
from garage2usd.driving.tracks import Agent, Track
from garage2usd.objects.person import PEOPLE
from garage2usd.stage.cameras import FRAMES_PER_SECOND

_Floats = NDArray[np.float64]
_ALIKE = 5
"""Number of figures of about a person's stature from which one is drawn by the person's name."""
_CHILD_M, _CHILD_HEAD = 1.45, 1.3
"""Stature of a child, and the size of its head."""
_TURN_S = np.linspace(-0.3, 0.3, 9)
"""Times around a time over which headings are averaged, as a person does not turn on the spot in one step."""
_ON_FLOOR_M, _ON_FLOOR_M_S = 0.02, 0.3
"""Height and speed below which a part of a foot is on the floor."""
_NEAR_M, _FAR_M = 0.008, 0.05
"""Deviations that save poses: of feet on the floor, also into it, and of feet in the air and hands."""
_FIRST_STEP = 3
_ENDS = [
    *((f"{side}_foot", (0.0, -ANKLE, HEEL_Z)) for side in ("left", "right")),
    *((f"{side}_toes", (0.0, 0.0, ahead)) for side in ("left", "right") for ahead in (0.0, TIP_Z - BALL_Z)),
    *((f"{joint}", (0.0, -0.15, 0.0)) for joint in ("head", "left_forearm", "right_forearm")),
]
"""Points of a body by which poses are compared, in shares of the stature from a joint; those of the feet come first."""
_FEET = 6


class Gait(NamedTuple):
    """The motion of a person of a track.

    Attributes
    ----------
    frames, yaw_rad
        Frames of the stage at which the person is there, and its heading as in `Track`; shape (n,).
    poses
        Indices of the frames that have a pose; between them rotations are interpolated; shape (k,).
    motion
        Poses of the joints at these.
    """

    frames: _Floats
    yaw_rad: _Floats
    poses: NDArray[np.int64]
    motion: Motion


def figure_of(agent: Agent) -> tuple[str, Figure, float]:
    """Choose the figure of a person, one of few; return its name, the figure, and the factor to its stature.

    The figure is the one with the number `Agent.body` of `PEOPLE`, or else one of those of about the stature.
    """
    drawn = zlib.crc32(agent.name.encode())
    alike = sorted(range(len(PEOPLE)), key=lambda number: abs(PEOPLE[number].height_m - agent.height_m))[:_ALIKE]
    number = int(agent.body) % len(PEOPLE) if agent.body.isdecimal() else alike[drawn % _ALIKE]
    figure, name = PEOPLE[number], f"Person_{number}"
    if agent.height_m < _CHILD_M:
        figure, name = figure._replace(is_woman=False, head=_CHILD_HEAD), f"Child_{number}"
    return name, figure, agent.height_m / figure.top_m


def gait_of(track: Track) -> Gait:
    """Make a person walk and stand along its track, with feet that stay where they are on the floor.

    Returns
    -------
    Gait
        Poses at as few frames as keep heels, balls and tips of feet on the floor within 8 mm.
    """
    first, last = (float(time) * FRAMES_PER_SECOND for time in track.time_s[[0, -1]])
    inner = np.arange(np.ceil(first + 0.1), np.floor(last - 0.1) + 1)
    frames = np.unique(np.round(np.concatenate([[first], inner, [last]]), 6))
    times = frames / FRAMES_PER_SECOND
    places = track.at(np.clip(times, track.time_s[0], track.time_s[-1]))[:, [0, 2]]
    yaw = np.mean([np.interp(times + off, track.time_s, track.yaw_rad) for off in _TURN_S], axis=0)
    _, figure, factor = figure_of(track.agent)
    skeleton = figure._replace(height_m=figure.height_m * factor).skeleton
    motion = walked(skeleton, times, places, yaw + np.pi)
    poses = _needed(skeleton, motion, times, places, yaw + np.pi)
    return Gait(frames, yaw, poses, Motion(*(values[poses] for values in motion)))


def _ends_m(skeleton: Skeleton, turns: _Floats, hips_m: _Floats) -> _Floats:
    """Places of `_ENDS` in poses; shape (poses, ends, 3)."""
    joints, numbers = skeleton.places_m(turns, hips_m), [JOINTS.index(joint) for joint, _ in _ENDS]
    reach = skeleton.height_m * np.array([off for _, off in _ENDS])
    ends: _Floats = joints[:, numbers] + np.einsum("pjab,jb->pja", turns[:, numbers], reach)
    return ends


def _needed(skeleton: Skeleton, motion: Motion, times: _Floats, places: _Floats, yaw: _Floats) -> NDArray[np.int64]:
    """Choose poses between which all others are interpolated well enough."""
    numbers = np.arange(len(times))
    exact = _ends_m(skeleton, motion.turns, motion.hips_m)
    if len(times) < 3:  # noqa: PLR2004 - the first and the last are needed
        return numbers
    cos, sin = np.cos(yaw)[:, None], np.sin(yaw)[:, None]
    x, z = exact[..., 0] * cos + exact[..., 2] * sin, exact[..., 2] * cos - exact[..., 0] * sin
    speeds = np.hypot(*(np.gradient(own, times, axis=0) for own in (x + places[:, :1], z + places[:, 1:])))
    is_down = (exact[..., 1] < _ON_FLOOR_M) & (speeds < _ON_FLOOR_M_S)
    is_down[:, _FEET:] = False
    near_m = np.where(is_down, _NEAR_M, _FAR_M)
    moves = np.abs(np.diff(exact, axis=0)).max(axis=(1, 2)) > 1e-4  # noqa: PLR2004 - a tenth of a millimetre
    changes = np.flatnonzero(np.diff(moves)) + 1
    steps = np.arange(0, len(times), _FIRST_STEP)
    kept = np.unique(np.concatenate([[0, len(times) - 1], changes, steps[moves[np.minimum(steps, len(moves) - 1)]]]))
    while True:
        before = np.clip(np.searchsorted(kept, numbers, side="right") - 1, 0, len(kept) - 2)
        start, end = kept[before], kept[before + 1]
        share = ((times - times[start]) / (times[end] - times[start]))[:, None]
        rotations = (1 - share[..., None]) * motion.rotations[start] + share[..., None] * motion.rotations[end]
        hips = (1 - share) * motion.hips_m[start] + share * motion.hips_m[end]
        found = _ends_m(skeleton, turns_of(rotations), hips)
        errors = (np.linalg.norm(found - exact, axis=2) / near_m).max(axis=1)
        errors = np.maximum(errors, -found[:, :_FEET, 1].min(axis=1) / _NEAR_M)
        worst = np.lexsort((errors, before))[np.append(np.flatnonzero(np.diff(before)), len(times) - 1)]
        added = worst[errors[worst] > 1]
        if not len(added):
            break
        kept = np.sort(np.concatenate([kept, added]))
    return np.asarray(kept)
