"""Where a drive over several levels is divided into scenes of nuScenes, and where one over one level is not."""

from pathlib import Path
from types import SimpleNamespace

import numpy as np

from garage2usd.garage.levels import LevelPlace, nearest_floor
from garage2usd.reading.levels import paths_from_above
from garage2usd.sensors.formats.nuscenes_scenes import Location, stretches_of
from garage2usd.sensors.formats.recording import Shot

FLOORS_M = {"U1": 0.0, "U2": -3.0, "U3": -6.0}
LEVELS = [LevelPlace(name, f"/Garage/Levels/{name}", floor_m) for name, floor_m in FLOORS_M.items()]
PLACES = [Location(f"two_{name}", f"two.usdc {name}", floor_m, ("",)) for name, floor_m in FLOORS_M.items()]
WORLD = SimpleNamespace(matrix=np.array([[1.0, 0, 0, 9], [0, 0, -1, 9], [0, 1, 0, 0], [0, 0, 0, 1]]))
"""A stage with Y up."""


def shots_at(*heights_m):
    """Two shots of each pose, in another order than they were taken in."""
    shots = []
    for pose, height_m in enumerate(heights_m):
        place = np.eye(4)
        place[1, 3] = height_m
        shots += [Shot(f"{name}_{pose}", None, pose, float(pose), place, {"npz": Path()}) for name in ("a", "b")]
    return sorted(shots, key=lambda shot: shot.name)


def told(stretches):
    return [(each.name, each.location.name, [shots[0].pose for shots in each.by_pose]) for each in stretches]


def test_each_stretch_on_one_level_is_a_scene_also_where_the_drive_comes_back():
    stretches = stretches_of(shots_at(3.2, 0.0, -1.4, -1.6, -3.0, -1.0, -4.6), PLACES, WORLD)
    assert told(stretches) == [
        ("scene-0001", "two_U1", [0, 1, 2]),
        ("scene-0002", "two_U2", [3, 4]),
        ("scene-0003", "two_U1", [5]),
        ("scene-0004", "two_U3", [6]),
    ]
    assert all(len(shots) == 2 for stretch in stretches for shots in stretch.by_pose)
    assert len({stretch.key(17) for stretch in stretches}) == len(stretches)


def test_a_drive_over_one_level_is_one_scene_at_any_height():
    whole = Location("two", "two.usdc", None, ("",))
    (stretch,) = stretches_of(shots_at(3.2, 0.0, -3.0), [whole], WORLD)
    assert (stretch.location, len(stretch.by_pose), stretch.key(17)) == (whole, 3, "17")


def test_a_level_is_seen_from_above_with_the_ramps_down_from_it():
    assert paths_from_above(LEVELS, 0) == ("/Garage/Levels/U1/", "/Garage/Levels/U2/Ramps/")
    assert paths_from_above(LEVELS, 2) == ("/Garage/Levels/U3/",)
    assert [nearest_floor([*FLOORS_M.values()], height_m) for height_m in (9.0, -1.6, -99.0)] == [0, 1, 2]
