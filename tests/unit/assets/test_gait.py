"""Feet of walkers on the floor, by the soles of the built meshes, and joint angles against the measured ones."""

import numpy as np
import pytest
from support.soak import soak_but

from garage2usd.assets.figures import skinned_figure
from garage2usd.assets.gait import REFERENCE_DEG, stride_m, walked, walking
from garage2usd.objects.person import PEOPLE

TOUCH_M = 0.004
"""A point of a sole below this height is on the floor."""


def walker(height_m):
    return skinned_figure(PEOPLE[0]._replace(height_m=height_m))


def soles(skin, motion, places, yaws):
    """Points of both shoes in the world over time; shape (2, times, points, 3)."""
    at = next(index for index, part in enumerate(skin.parts) if part.name == "Shoes")
    points, weights = skin.parts[at].points.astype(float), skin.weights[at]
    posed = np.array(
        [
            skin.skeleton.skinned_m(points, weights, turns, hips)
            for turns, hips in zip(motion.turns, motion.hips_m, strict=True)
        ]
    )
    cos, sin = np.cos(yaws)[:, None], np.sin(yaws)[:, None]
    x, y, z = np.moveaxis(posed, 2, 0)
    world = np.stack([x * cos + z * sin + places[:, :1], y, z * cos - x * sin + places[:, 1:]], axis=2)
    is_left = points[:, 0] > 0
    return [world[:, is_left], world[:, ~is_left]]


def slides_m(world):
    """Way that a foot slides in each of its stances: of the point on the floor that moves least, step by step."""
    on = world[..., 1] < TOUCH_M
    moved = np.linalg.norm(np.diff(world, axis=0)[..., [0, 2]], axis=2)
    least = np.where(on[1:] & on[:-1], moved, np.inf).min(axis=1)
    found, total = [], 0.0
    for step in least:
        if np.isfinite(step):
            total += step
        elif total:
            found.append(total)
            total = 0.0
    return [*found, total]


WALKERS = [(1.1, 0.8), (1.1, 1.6), (1.75, 1.3), (1.9, 0.8), (1.9, 1.6)]


@pytest.mark.parametrize(
    ("height_m", "speed_m_s"),
    soak_but(WALKERS, [(h, v) for h in (1.1, 1.3, 1.5, 1.75, 1.9) for v in (0.8, 1.0, 1.2, 1.3, 1.4, 1.6)]),
)
def test_over_a_stride_feet_neither_slide_nor_sink_nor_float(height_m, speed_m_s):
    skin = walker(height_m)
    cycle = walking(skin.skeleton, speed_m_s, poses=60)
    ahead = np.column_stack([np.zeros(60), np.arange(60) * cycle.stride_m / 60])
    feet = soles(skin, cycle.motion, ahead, np.zeros(60))
    lows = np.array([world[..., 1].min(axis=1) for world in feet])
    assert lows.min() > -0.002
    assert lows.min(axis=0).max() < 0.002, "one foot is always on the floor"
    assert max(max(slides_m(world)) for world in feet) < 0.05
    assert lows.max() > 0.01 * height_m, "the other one is lifted"
    assert cycle.period_s * speed_m_s == pytest.approx(cycle.stride_m)


def test_joint_angles_are_those_of_the_measured_stride():
    skeleton = walker(1.75).skeleton
    # the speed whose stride is that of the measured children by stature
    speed = next(v for v in np.arange(0.8, 1.8, 0.01) if stride_m(1.75, v) > 0.81 * 1.75)
    motion = walking(skeleton, speed, poses=50).motion
    places = skeleton.places_m(motion.turns, motion.hips_m)
    for hip in (7, 11):
        bones = np.diff(places[:, hip : hip + 3], axis=1)
        thigh, shin = np.degrees(np.arctan2(bones[..., 2], -bones[..., 1])).T
        found = np.column_stack([thigh, thigh - shin])
        # the right leg follows half a stride later
        found = (found if hip == 7 else np.roll(found, -25, axis=0))[::2]
        assert np.sqrt(((found - REFERENCE_DEG[:-1, :2]) ** 2).mean(axis=0)).max() < 4.0


def test_strides_are_those_of_dynamically_similar_walkers():
    # R. McN. Alexander: a man with legs of 0.9 m at 1.3 m/s walks with strides of 2.3 * 0.9 * 0.191 ** 0.3 m
    assert stride_m(0.9 / 0.53, 1.3) == pytest.approx(1.26, abs=0.01)
    assert stride_m(1.9, 1.6) > stride_m(1.9, 0.8) > stride_m(1.1, 0.8)


def a_walk(rate_hz=60):
    """Two ways at changing speed around a bend, a stop of two seconds, a turn on the spot, and a short way back."""
    speeds = np.concatenate(
        [np.zeros(30), np.linspace(0, 1.5, 60), 1.5 + 0.3 * np.sin(np.arange(240) / 20), np.linspace(1.5, 0, 60)]
    )
    speeds = np.concatenate(
        [
            speeds,
            np.zeros(2 * rate_hz + 2 * rate_hz),
            np.linspace(0, 1.0, 30),
            np.ones(60),
            np.linspace(1, 0, 40),
            np.zeros(30),
        ]
    )
    turning = np.zeros_like(speeds)
    turning[150:250] = np.pi / 2 / 100
    turning[450:570] = np.pi / 120
    yaws = np.cumsum(turning)
    steps = np.column_stack([np.sin(yaws), np.cos(yaws)]) * speeds[:, None] / rate_hz
    return np.arange(len(speeds)) / rate_hz, np.cumsum(steps, axis=0), yaws


@pytest.mark.parametrize("height_m", [1.1, 1.8])
def test_feet_do_not_slide_when_a_walker_starts_bends_stops_and_turns(height_m):
    skin = walker(height_m)
    times, places, yaws = a_walk()
    motion = walked(skin.skeleton, times, places, yaws)
    feet = soles(skin, motion, places, yaws)
    lows = np.array([world[..., 1].min(axis=1) for world in feet])
    assert lows.min() > -0.003
    assert lows.min(axis=0).max() < 0.004
    assert max(max(slides_m(world)) for world in feet) < 0.05
    # while it stands both feet are flat on the floor below it
    still = slice(395, 445)
    assert lows[:, still].max() < 0.002
    assert max(np.abs(world[still] - world[still.start]).max() for world in feet) < 1e-3
    left, right = motion.turns[still, 9], motion.turns[still, 13]
    assert np.abs(left[:, 1, 1] - 1).max() + np.abs(right[:, 1, 1] - 1).max() < 1e-3
    # and no joint jumps between two frames
    assert np.abs(np.diff(motion.rotations, axis=0)).max() < 0.2
    assert np.abs(np.diff(motion.hips_m, axis=0)).max() < 0.02


def test_a_person_that_stands_all_the_time_stands():
    skin = walker(1.7)
    motion = walked(skin.skeleton, np.arange(5.0), np.zeros((5, 2)), np.full(5, 1.0))
    assert np.abs(motion.rotations - motion.rotations[0]).max() == 0
    assert soles(skin, motion, np.zeros((5, 2)), np.zeros(5))[0][..., 1].min() == pytest.approx(0.0, abs=1e-3)
