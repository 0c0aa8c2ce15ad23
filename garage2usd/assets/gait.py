"""Walking: footholds along a way, and the rotations of a skeleton's joints that keep the feet on them.

The joint angles of the reference stride are those that M. H. Schwartz, A. Rozumalski and J. P. Trost measured at freely
chosen speed (The effect of walking speed on the gait of typically developing children, J. Biomech. 41, 2008); pitch of
the feet, bend of the standing leg and way of the swinging foot follow them. Its stride, 0.81 of the stature, is that at
which they carry a foot of `garage2usd.assets.skeletons` along the floor. The knees are solved from hip and ankle, so a
foot on the floor stays where it is: it turns about its heel, rests, then turns about its ball and its tip.

The phase goes by the distance walked, not by time. Footholds are laid from stop to stop in whole steps. The first and
the last step are half ones, from and to feet side by side. A turn on the spot counts as distance, so the feet step.
"""
# Over 300 lines: footholds, the feet that follow them and the legs that reach them are one computation.

from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from garage2usd.assets.poses import TOES_BEND_DEG, arm_turns
from garage2usd.assets.skeletons import (
    ANKLE,
    BALL_Z,
    HEEL_Z,
    HIP_X,
    HIPS,
    JOINTS,
    SHIN,
    SIDES,
    THIGH,
    TIP_Z,
    TOES_OUT_DEG,
    Skeleton,
    Vectors,
    about,
    quaternions,
)

REFERENCE_DEG = np.array(
    [
        (23.6, 5.6, -2.1), (23.7, 10.9, -5.6), (23.0, 16.9, -4.1), (20.3, 19.3, -0.2), (16.2, 18.6, 2.9),
        (11.5, 16.5, 5.2), (6.7, 13.9, 6.8), (2.0, 11.3, 8.0), (-2.5, 9.0, 9.1), (-6.8, 7.2, 10.2),
        (-10.8, 6.2, 11.1), (-14.2, 6.8, 11.8), (-16.6, 9.5, 11.5), (-17.7, 14.5, 8.4), (-16.3, 22.6, -0.2),
        (-11.7, 33.9, -13.8), (-4.4, 46.3, -19.8), (3.4, 55.7, -14.7), (10.4, 59.1, -7.9), (16.0, 56.9, -2.4),
        (20.4, 49.8, 1.1), (23.3, 38.8, 2.5), (24.4, 25.5, 1.8), (24.1, 12.5, 0.1), (23.5, 4.6, -1.1),
        (23.6, 5.6, -2.1),
    ]
)  # fmt: skip
"""Thigh to the vertical (hip less tilt of the pelvis), knee and ankle each 4 % of a stride from heel strike on."""
_STRIDE = 0.81
"""Length of the reference stride by stature."""
_LANDED, _LIFTED = 0.23, 0.61
"""Phases at which a foot is below the hips and leaves the floor; at 0 its heel touches the floor."""
_BOTH = _LIFTED - 0.5
"""Share of a stride with both feet on the floor."""
_FIRST, _LAST = 0.5, 0.16
"""Phase at which a first step begins, and share of a stride before a stop at which the last foot lifts."""
_FOOT_X = 0.042
"""Distance of a foothold from the way."""
_REACH = 0.9995 * (THIGH + SHIN)
_TURNING_M = 0.3
"""Distance that counts for a turn by one radian."""
_STILL_M_S, _STOP_S = 0.02, 0.3
"""Greatest speed and least duration of a stop."""
_LEAST_WAY_M = 0.02
_YAW_DEG, _LIST_DEG, _SWAY, _LEAN_DEG = 4.0, 3.5, 0.010, 3.0
"""Amplitudes of the pelvis, by Schwartz et al., and of its way to the side; lean of the trunk."""
_SHOULDER_DEG, _ELBOW_DEG = 19.0, 9.0
"""Amplitudes of the arms, chosen by eye."""
_GRAVITY_M_S2 = 9.81


class Motion(NamedTuple):
    """Poses of a person over time.

    Attributes
    ----------
    rotations
        Rotation of each joint to its parent, quaternions (x, y, z, w); float64, shape (poses, joints, 4).
    hips_m
        Place of the hips from the person's origin on the floor, in its axes; float64, shape (poses, 3).
    turns
        Rotations of the joints in the axes of the person; float64, shape (poses, joints, 3, 3).
    """

    rotations: Vectors
    hips_m: Vectors
    turns: Vectors


class Cycle(NamedTuple):
    """A stride at constant speed, from the heel strike of the left foot to the next.

    Attributes
    ----------
    period_s, stride_m
        Duration and length of the stride.
    motion
        Poses at equal steps of the stride; the last is that before the first again.
    """

    period_s: float
    stride_m: float
    motion: Motion


class _Footholds(NamedTuple):
    """Footholds of one foot in order: shapes (n,).

    `on` and `off` are the distances at which it lands and lifts, `under_on` and `under_off` those at which the foot is
    below the hips for the strides that end and begin there, of lengths `stride_on` and `stride_off`.
    """

    x: Vectors
    z: Vectors
    yaw: Vectors
    on: Vectors
    off: Vectors
    under_on: Vectors
    under_off: Vectors
    stride_on: Vectors
    stride_off: Vectors


def stride_m(height_m: float, speed_m_s: float) -> float:
    """Length of a stride by R. McN. Alexander: 2.3 leg lengths times the Froude number to the power of 0.3.

    Estimates of speeds of dinosaurs, Nature 261 (1976); the hips are at 0.53 of the stature.
    """
    leg_m = HIPS * height_m
    return float(2.3 * leg_m * (speed_m_s**2 / (_GRAVITY_M_S2 * leg_m)) ** 0.3)


def walking(skeleton: Skeleton, speed_m_s: float, *, poses: int = 32) -> Cycle:
    """Make a stride at constant speed straight ahead.

    Parameters
    ----------
    skeleton
        The person.
    speed_m_s
        Speed, greater than 0.
    poses
        Number of poses.
    """
    length_m = stride_m(skeleton.height_m, speed_m_s)
    # the left foot lands before its third foothold, at 2.5 strides
    strides = np.concatenate([[0.0], 2.5 - _LANDED + np.arange(poses) / poses, [6.0]])
    times = strides * length_m / speed_m_s
    ahead = np.column_stack([np.zeros_like(times), strides * length_m])
    whole = walked(skeleton, times, ahead, np.zeros_like(times))
    turns, hips_m = whole.turns[1:-1], whole.hips_m[1:-1]
    return Cycle(length_m / speed_m_s, length_m, Motion(quaternions(turns), hips_m, turns))


def walked(skeleton: Skeleton, times_s: ArrayLike, places_m: ArrayLike, yaws_rad: ArrayLike) -> Motion:
    """Make a person walk along a way, with feet that stay where they are on the floor.

    Parameters
    ----------
    skeleton
        The person.
    times_s
        Ascending times; shape (k,). Ways are straight between them.
    places_m
        Where the person's origin is on the floor, (x, z); shape (k, 2).
    yaws_rad
        Rotation of the person about +Y, 0 facing +Z; shape (k,).

    Returns
    -------
    Motion
        One pose for each time. Where the person stops for 0.3 s the feet come to stand side by side.
    """
    times, unit = np.asarray(times_s, dtype=float), skeleton.height_m
    x, z = np.asarray(places_m, dtype=float).T / unit
    yaw = np.unwrap(np.asarray(yaws_rad, dtype=float))
    parts = np.diff(x), np.diff(z), np.diff(yaw) * _TURNING_M / unit
    gone = np.concatenate([[0.0], np.cumsum(np.linalg.norm(parts, axis=0))])
    ways = _ways(times, gone, unit)
    path = gone, x, z, yaw
    beat, vigour = _beats(gone, ways)
    turns = np.empty((len(gone), len(JOINTS), 3, 3))
    turns[:, 0] = about(1, -_YAW_DEG * vigour * np.cos(beat)) @ about(2, _LIST_DEG * vigour * np.cos(beat - 0.75))
    hips = np.zeros((len(gone), 3))
    hips[:, 0] = _SWAY * vigour * np.sin(beat - 0.3)
    sockets = turns[:, 0] @ np.array([(HIP_X, 0.0, 0.0), (-HIP_X, 0.0, 0.0)]).T
    feet = [_foot(footholds, path) for footholds in _footholds(ways, path)]
    hips[:, 1] = _hip_height(feet, hips[:, None] + np.swapaxes(sockets, 1, 2))
    for index, foot in enumerate(feet):
        turns[:, 7 + 4 * index : 11 + 4 * index] = _leg(foot, hips + sockets[..., index], SIDES[index])
    _carry(turns, beat, vigour)
    return Motion(quaternions(turns), unit * hips, turns)


def _ways(times: Vectors, gone: Vectors, unit_m: float) -> list[tuple[float, float, float]]:
    """First and last distance of each way between stops, and the length of its strides."""
    lasting = np.diff(times)
    still = np.diff(gone) * unit_m <= _STILL_M_S * lasting
    edges = np.flatnonzero(np.diff(np.concatenate([[True], still, [True]]).astype(int)))
    runs = [(int(first), int(last)) for first, last in edges.reshape(-1, 2)]
    joined: list[tuple[int, int]] = []
    for first, last in runs:
        if joined and times[first] - times[joined[-1][1]] < _STOP_S:
            first = joined.pop()[0]  # noqa: PLW2901 - a pause on the way
        joined.append((first, last))
    ways = []
    for first, last in joined:
        way = float(gone[last] - gone[first])
        if way * unit_m >= _LEAST_WAY_M:
            usual = stride_m(unit_m, way * unit_m / float(times[last] - times[first])) / unit_m
            ways.append((float(gone[first]), float(gone[last]), 2 * way / max(1, round(2 * way / usual))))
    return ways


def _beats(gone: Vectors, ways: list[tuple[float, float, float]]) -> tuple[Vectors, Vectors]:
    """Phase of the left foot in radians, and size of the motion of the trunk, at distances."""
    beat, vigour = np.zeros_like(gone), np.zeros_like(gone)
    for first, last, stride in ways:
        on = (gone >= first) & (gone <= last)
        beat[on] = 2 * np.pi * ((gone[on] - first) / stride - 0.5 + _LANDED)
        near = np.minimum(gone[on] - first, last - gone[on]) / stride
        vigour[on] = _ramp(near, 0.0, 0.5) * min(stride / _STRIDE, 1.2)
    return beat, vigour


def _footholds(ways: list[tuple[float, float, float]], path: tuple[Vectors, ...]) -> list[_Footholds]:
    """Footholds of the left and the right foot; the left one begins each way."""
    start = ways[0][0] if ways else 0.0
    never = np.inf
    # where, on, off, under_on, under_off, stride_on, stride_off
    rows = [[[start, -never, never, -never, never, 1.0, 1.0]] for _ in SIDES]
    for first, last, stride in ways:
        steps = round(2 * (last - first) / stride)
        for row, lifts in zip(rows, (first, first + (_LIFTED - _LANDED) * stride), strict=True):
            row[-1][2::2] = lifts, first, stride
        for step in range(1, steps + 1):
            at = first + step * stride / 2 if step < steps else last
            lands, lifts = at - _LANDED * stride, at + (_LIFTED - _LANDED) * stride
            rows[(step - 1) % 2].append([at, lands, lifts, at, at, stride, stride])
        stands, closes = rows[(steps - 1) % 2], rows[steps % 2]
        stands[-1][2::2] = never, never, 1.0
        closes[-1][2] = last - _LAST * stride
        closes.append([last, last, never, last, never, stride, 1.0])
    found = []
    for foot, side in zip(rows, SIDES, strict=True):
        at, *events = np.array(foot).T
        x, z, yaw = (np.interp(at, path[0], values) for values in path[1:])
        out = side * _FOOT_X
        found.append(_Footholds(x + out * np.cos(yaw), z - out * np.sin(yaw), yaw, *events))
    return found


class _Foot(NamedTuple):
    """A foot over time, in the axes of the person and shares of the stature.

    `ankle` has shape (k, 3); yaw in radians, `pitch` and `bend` in degrees, toes upwards; `knee` is the bend of the
    standing leg in degrees, and `load` its share of the weight.
    """

    ankle: Vectors
    yaw: Vectors
    pitch: Vectors
    bend: Vectors
    knee: Vectors
    load: Vectors


def _foot(holds: _Footholds, path: tuple[Vectors, ...]) -> _Foot:
    """Follow a foot from foothold to foothold."""
    gone, x, z, yaw = path
    index = np.searchsorted(holds.on, gone, side="right") - 1
    following = np.minimum(index + 1, len(holds.on) - 1)
    held = _Footholds(*(values[index] for values in holds))
    then = _Footholds(*(values[following] for values in holds))
    swings = (gone > held.off) & (following > index)
    begin = np.where(swings, held.off, 0.0)
    share = np.where(swings, (gone - begin) / np.where(swings, then.on - begin, 1.0), 0.0)

    from_phase = np.where(swings, np.maximum(_standing_phase(held, begin), _FIRST), 0.0)
    phase = np.where(swings, from_phase + share * (1 - from_phase), _standing_phase(held, gone))
    stride = np.where(~swings & (gone < held.under_on), held.stride_on, held.stride_off)
    size = np.minimum(stride / _STRIDE, 1.2)
    pitch = _pitch(phase) * size
    # feet that stood side by side, or will, begin and end flat
    pitch *= np.where(swings & (held.off == held.under_off), _ramp(share, 0.0, 0.3), 1.0)
    pitch *= np.where(swings & (then.on == then.under_on), 1 - _ramp(share, 0.7, 1.0), 1.0)
    bend = np.clip(-pitch, 0.0, TOES_BEND_DEG) * (1 - _ramp(share, 0.0, 0.3))

    lift = np.where(held.off == held.under_off, 0.0, _pitch(_standing_phase(held, begin)) * size)
    land = np.where(then.on == then.under_on, 0.0, _pitch(np.zeros_like(gone)) * size)
    ahead, high = _contact(np.where(swings, lift, pitch))
    ahead_then, high_then = _contact(land)
    way, height = _swing(from_phase, phase, share)
    x_then, z_then = then.x + ahead_then * np.sin(then.yaw), then.z + ahead_then * np.cos(then.yaw)
    x_held, z_held = held.x + ahead * np.sin(held.yaw), held.z + ahead * np.cos(held.yaw)
    across, along = (
        now + np.where(swings, way * (later - now), 0.0) - own
        for now, later, own in ((x_held, x_then, x), (z_held, z_then, z))
    )
    high = high + np.where(swings, share * (high_then - high) + size * height, 0.0)
    low = high + _lowest(pitch, bend)
    high = high + np.where(swings, np.maximum(0.05 * share * (1 - share) - low, 0.0), 0.0)
    ankle = np.column_stack(
        [across * np.cos(yaw) - along * np.sin(yaw), high, across * np.sin(yaw) + along * np.cos(yaw)]
    )
    return _Foot(
        ankle,
        held.yaw + np.where(swings, way * (then.yaw - held.yaw), 0.0) - yaw,
        pitch,
        bend,
        5.6 + (_reference(1, phase) - 5.6) * np.minimum(size, 1.0),
        np.where(swings, 0.0, _load(held, gone)),
    )


def _standing_phase(held: _Footholds, gone: Vectors) -> Vectors:
    """Phase of a foot on the floor; it rests at `_LANDED` while the person stands."""
    before, after = np.minimum(gone - held.under_on, 0.0), np.maximum(gone - held.under_off, 0.0)
    return _LANDED + before / held.stride_on + after / held.stride_off


def _load(held: _Footholds, gone: Vectors) -> Vectors:
    """Weight on a foot: it changes from foot to foot while both are on the floor."""
    on, off = np.maximum(held.on, gone[0] - 10.0), np.minimum(held.off, gone[-1] + 10.0)
    rise = np.where(held.on == held.under_on, 1.0, _ramp((gone - on) / held.stride_on, 0.0, _BOTH))
    fall = np.where(held.off == held.under_off, 0.0, _ramp((gone - off) / held.stride_off, -_BOTH, 0.0))
    return np.asarray(np.maximum(rise * (1 - fall), 1e-6))


def _reference(column: int, phase: Vectors) -> Vectors:
    """An angle of the reference stride between its keys, by trigonometric interpolation; degrees."""
    keys = REFERENCE_DEG[:-1, column]
    shares = np.fft.rfft(keys) / len(keys)
    waves = np.polyval(shares[::-1], np.exp(2j * np.pi * np.asarray(phase)))
    return np.asarray(2 * waves.real - shares[0].real)


def _pitch(phase: Vectors) -> Vectors:
    """Pitch of the foot in the reference stride, toes upwards; flat within a degree."""
    pitch = _reference(0, phase) - _reference(1, phase) + _reference(2, phase)
    return np.asarray(np.sign(pitch) * np.maximum(np.abs(pitch) - 1.0, 0.0))


def _contact(pitch_deg: Vectors) -> tuple[Vectors, Vectors]:
    """Place of the ankle of a pitched foot that touches the floor: ahead of its place when flat, and height.

    The foot turns about its heel, or about its ball with the toes on the floor, and then about its tip.
    """
    pitch, toes = np.radians(pitch_deg), np.radians(np.minimum(pitch_deg + TOES_BEND_DEG, 0.0))
    heel = HEEL_Z - HEEL_Z * np.cos(pitch) - ANKLE * np.sin(pitch), ANKLE * np.cos(pitch) - HEEL_Z * np.sin(pitch)
    bone = TIP_Z - BALL_Z
    ball_z, ball_y = TIP_Z - bone * np.cos(toes), -bone * np.sin(toes)
    ball = (
        ball_z - BALL_Z * np.cos(pitch) - ANKLE * np.sin(pitch),
        ball_y - BALL_Z * np.sin(pitch) + ANKLE * np.cos(pitch),
    )
    return np.where(pitch > 0, heel[0], ball[0]), np.where(pitch > 0, heel[1], ball[1])


def _lowest(pitch_deg: Vectors, bend_deg: Vectors) -> Vectors:
    """Height of the lowest point of a shoe above its ankle."""
    pitch, toes = np.radians(pitch_deg), np.radians(pitch_deg + bend_deg)
    ball = BALL_Z * np.sin(pitch)
    lowest = np.minimum(np.minimum(HEEL_Z * np.sin(pitch), ball), ball + (TIP_Z - BALL_Z) * np.sin(toes))
    return np.asarray(lowest - ANKLE * np.cos(pitch))


def _bones(phase: Vectors) -> tuple[Vectors, Vectors]:
    """Place of the ankle from the hip in the reference stride: ahead, and below."""
    thigh, shin = np.radians(_reference(0, phase)), np.radians(_reference(0, phase) - _reference(1, phase))
    return THIGH * np.sin(thigh) + SHIN * np.sin(shin), THIGH * np.cos(thigh) + SHIN * np.cos(shin)


def _swing(first: Vectors, phase: Vectors, share: Vectors) -> tuple[Vectors, Vectors]:
    """Share of the way that a foot in the air has gone, and its height above a straight line."""

    def ankle(at: Vectors) -> tuple[Vectors, Vectors]:
        ahead, below = _bones(at)
        other = _bones(at - 0.5)[1] + _contact(_pitch(at - 0.5))[1]
        return ahead + _STRIDE * at, other - below

    (ahead, high), (ahead_0, high_0), (ahead_1, high_1) = (ankle(at) for at in (phase, first, np.ones_like(phase)))
    return (ahead - ahead_0) / (ahead_1 - ahead_0), high - high_0 - share * (high_1 - high_0)


def _hip_height(feet: list[_Foot], sockets: Vectors) -> Vectors:
    """Height of the hips over the standing legs, at which none of them is too short.

    Parameters
    ----------
    feet
        Both feet.
    sockets
        Places of the hip joints with the hips at height 0; shape (k, 2, 3).
    """
    heights, most = [], np.full(len(sockets), np.inf)
    for index, foot in enumerate(feet):
        off = ((foot.ankle - sockets[:, index])[:, [0, 2]] ** 2).sum(axis=1)
        base = foot.ankle[:, 1] - sockets[:, index, 1]
        reach = THIGH**2 + SHIN**2 + 2 * THIGH * SHIN * np.cos(np.radians(foot.knee))
        heights.append(base + np.sqrt(np.maximum(reach - off, 0.01)))
        most = np.where(foot.load > 0, np.minimum(most, base + np.sqrt(np.maximum(_REACH**2 - off, 0.01))), most)
    loads = np.array([foot.load for foot in feet])
    return np.asarray(np.minimum((loads * heights).sum(axis=0) / loads.sum(axis=0), most))


def _leg(foot: _Foot, socket: Vectors, side: float) -> Vectors:
    """Rotations of thigh, shin, foot and toes of a leg between hip joint and ankle; shape (k, 4, 3, 3)."""
    way = foot.ankle - socket
    length = np.linalg.norm(way, axis=1, keepdims=True)
    way /= length
    length = np.minimum(length, _REACH)
    heading = foot.yaw / 2
    ahead = np.column_stack([np.sin(heading), np.zeros_like(heading), np.cos(heading)])
    hinge = np.cross(-way, ahead)
    hinge /= np.linalg.norm(hinge, axis=1, keepdims=True)
    middle = (THIGH**2 - SHIN**2 + length**2) / (2 * length)
    knee = middle * way + np.sqrt(np.maximum(THIGH**2 - middle**2, 0.0)) * np.cross(hinge, -way)
    up = -knee / THIGH, (knee - length * way) / SHIN
    bones = [np.stack([hinge, bone, np.cross(hinge, bone)], axis=2) for bone in up]
    out = about(1, np.degrees(foot.yaw) + side * TOES_OUT_DEG)
    back = about(1, -side * TOES_OUT_DEG)
    feet = [out @ about(0, -pitch) @ back for pitch in (foot.pitch, foot.pitch + foot.bend)]
    return np.stack([*bones, *feet], axis=1)


def _carry(turns: Vectors, beat: Vectors, vigour: Vectors) -> None:
    """Fill in the rotations of trunk, head and arms, which swing against the legs."""
    lean = _LEAN_DEG * vigour
    turns[:, 1] = about(1, _YAW_DEG * 0.7 * vigour * np.cos(beat)) @ about(0, lean)
    turns[:, 2] = about(0, lean * 0.4)
    for index, side in enumerate(SIDES):
        swing = -side * np.cos(beat) * vigour
        upper, forearm = arm_turns(
            index, 2.0 + _SHOULDER_DEG * swing, 14.0 + _ELBOW_DEG * (np.minimum(vigour, 1.0) + swing), 9.0, 3.0
        )
        turns[:, 3 + 2 * index], turns[:, 4 + 2 * index] = turns[:, 1] @ upper, turns[:, 1] @ forearm


def _ramp(values: Vectors, start: float, end: float) -> Vectors:
    """Smooth step from 0 at `start` to 1 at `end`."""
    share = np.clip((values - start) / (end - start), 0.0, 1.0)
    return np.asarray(share * share * (3 - 2 * share))
