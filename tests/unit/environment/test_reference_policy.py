"""The planner as a policy: it parks in garages and in scenes of the forms that others publish."""

import csv
import json
import pickle

import numpy as np
import pytest
import shapely
from support.soak import soak_but

from garage2usd.common.errors import UnreadableFileError
from garage2usd.config import GarageConfig
from garage2usd.environment import (
    ParkingEnvironment,
    dragon_lake_tasks,
    parkbench_tasks,
    reference_actions,
    tpcap_tasks,
)

SMALL = GarageConfig(site={"structure": "......\nE....X\n......\n"})


def parked(environment, **reset):
    environment.reset(**reset)
    actions = reference_actions(environment.task, gear_changes=10)
    assert actions.dtype == np.float32
    assert environment.action_space.contains(actions[0])
    for action in actions:
        *_, terminated, truncated, info = environment.step(action)
        if terminated or truncated:
            break
    return info["is_success"]


@pytest.mark.parametrize(
    ("settings", "seeds"),
    soak_but(
        2,
        [
            ({"source": SMALL}, 12),
            ({"source": SMALL, "task": "leave"}, 6),
            ({"source": [GarageConfig(), GarageConfig(seed=1, stalls={"kinds": {"angled": 1}})]}, 500),
            ({"source": GarageConfig(building={"levels": 2}), "distance_m": (15.0, 50.0), "filled": 0.5}, 100),
        ],
    ),
)
def test_the_planner_parks(settings, seeds):
    environment = ParkingEnvironment(observation="kinematics", **settings)
    failed = [seed for seed in range(seeds) if not parked(environment, seed=seed)]
    assert len(failed) <= seeds // 100, failed


def square(x, y, half=0.5):
    return [(x - half, y - half), (x + half, y - half), (x + half, y + half), (x - half, y + half)]


def write_parkbench(folder):
    frame = {
        "PlanningRequest": {
            "m_origin": [2.0, 1.0, 0.0],
            "m_startPosture": {"m_pose": [0.0, 0.0, 0.0]},
            "m_targetArea": {"m_targetPosture": {"m_pose": [-2.0, -5.0, np.pi / 2]}},
        },
        "m_nfmOrigin": {"m_x": 2.0, "m_y": 1.0},
        "NfmAggregatedPolygonObjects": [
            {"nfmPolygonObjectNodes": [{"m_x": x, "m_y": y} for x, y in line]}
            for line in ([(-5.0, -4.0), (-3.5, -4.0)], [(-0.5, -4.0), (3.0, -4.0)], [(-8.0, 6.0)])
        ],
    }
    (folder / "1.json").write_text(json.dumps({"Frames": {"0": frame}}))
    return parkbench_tasks(folder)


class LinearRing:
    """A ring that is pickled by the name of shapely's class, with its state as WKB."""

    __module__, __qualname__ = "shapely.geometry.polygon", "LinearRing"

    def __init__(self, points):
        self.points = points

    def __reduce__(self):
        return LinearRing, (), shapely.to_wkb(shapely.linearrings(self.points))


def write_dragon_lake(folder):
    rings = [LinearRing(square(-5.0, 2.0)), LinearRing([(0.0, 5.0), (8.0, 5.0), (0.0, 5.0)])]
    start, goal = [np.float64(0.0), np.float64(0.0), np.float64(0.0)], [-7.0, -1.0, 0.0]
    path = folder / "dlp.data"
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr("shapely.geometry.polygon.LinearRing", LinearRing)
        path.write_bytes(pickle.dumps([[[start, start], goal, rings]]))
    return dragon_lake_tasks(path)


def write_tpcap(folder):
    shapes = [square(-5.0, 3.0), square(4.0, -4.0)[:3]]
    values = [0.0, 0.0, 0.0, -7.0, -1.0, 0.1, 2.0, *map(len, shapes), *np.ravel([*shapes[0], *shapes[1]])]
    with (folder / "Case1.csv").open("w", newline="") as file:
        csv.writer(file).writerow(values)
    (folder / "Case10.csv").write_bytes((folder / "Case1.csv").read_bytes())
    return tpcap_tasks(folder)


SETS = {write_parkbench: (1, 3), write_dragon_lake: (1, 2), write_tpcap: (2, 2)}


@pytest.mark.parametrize("write", SETS)
def test_published_scenes_are_tasks(write, tmp_path):
    tasks = write(tmp_path)
    count, obstacles = SETS[write]
    assert (len(tasks), len(tasks[0].obstacles.names)) == (count, obstacles)
    assert len({task.name for task in tasks}) == count
    # their x is east and y north, their heading counterclockwise from east
    start, goal = tasks[0].start, tasks[0].goal
    assert (start.x_m, start.z_m, start.yaw_rad) == pytest.approx((0.0, 0.0, -np.pi / 2))
    assert goal.x_m == pytest.approx(-2.0 if count == 1 and obstacles == 3 else -7.0)
    assert goal.z_m == pytest.approx(5.0 if count == 1 and obstacles == 3 else 1.0)
    environment = ParkingEnvironment(tasks, steps=600)
    assert parked(environment, options={"task": tasks[0]})
    assert environment.task is tasks[0]


@pytest.mark.parametrize("read", [parkbench_tasks, dragon_lake_tasks, tpcap_tasks])
def test_other_files_are_refused_by_name(read, tmp_path):
    name = {parkbench_tasks: "1.json", dragon_lake_tasks: "dlp.data", tpcap_tasks: "Case1.csv"}[read]
    place = tmp_path / name if read is dragon_lake_tasks else tmp_path
    with pytest.raises(UnreadableFileError):
        read(place)
    for data in (b"", b"{}", b"1,2,3", pickle.dumps([print])):
        (tmp_path / name).write_bytes(data)
        with pytest.raises(UnreadableFileError, match=name):
            read(place)
