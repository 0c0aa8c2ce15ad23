"""ir-sim loads what its LiDAR reaches of the occupancy grid of every sample, and measures how far things are."""

import json
import os
import subprocess
from pathlib import Path

import numpy as np
import pytest
import shapely
from support.map_judges import JUDGES, has
from support.sample_files import REPOSITORY, SMALL_SAMPLES
from support.soak import soak_but

from garage2usd.config.outputs import GridConfig
from garage2usd.garage_sources import read_built
from garage2usd.maps.frame import map_points
from garage2usd.maps.occupancy import write_grid

IRSIM_PYTHON = Path(os.environ.get("IRSIM_PYTHON", JUDGES / "bin" / "python"))
pytestmark = [
    pytest.mark.client,
    pytest.mark.skipif(not ("IRSIM_PYTHON" in os.environ or has("irsim")), reason="no environment with ir-sim"),
]
LOOKS = REPOSITORY / "samples/looks.toml"
RANGE_M, RAYS = 30.0, 361
NEAR_M = 0.15
"""A cell's diagonal, a quarter of a cell, and the step of ir-sim's LiDAR."""


def ground_of(level):
    """What stands between two heights, seen by the checks, less doors and ramps; (x, y) of the map."""
    solids = level.solids.between(0.1, 1.8)
    shapes = [solid.footprint for solid in solids if solid.label not in {"vehicle_door", "ramp", "speed_bump"}]
    return shapely.STRtree([shapely.transform(shape, map_points) for shape in shapes])


def distances(tree, place, angles):
    """From a place to the first thing in each direction."""
    origin, found = shapely.Point(place), []
    for angle in angles:
        end = (place[0] + RANGE_M * np.cos(angle), place[1] + RANGE_M * np.sin(angle))
        ray = shapely.LineString([place, end])
        hits = [ray.intersection(tree.geometries[index]) for index in tree.query(ray, predicate="intersects")]
        found.append(min((origin.distance(hit) for hit in hits), default=RANGE_M))
    return np.array(found)


@pytest.mark.parametrize("sample", soak_but([LOOKS], SMALL_SAMPLES), ids=lambda path: path.stem)
def test_the_lidar_sees_what_stands_there(sample, builds, tmp_path):
    subject = read_built(builds(sample, "usdc").stage).garage
    (level,) = subject.levels
    write_grid(level, tmp_path / "map.yaml", GridConfig())
    tree = ground_of(level)
    crossing = next(node for node in subject.lanes.nodes if not node.is_portal)
    place = map_points(crossing.position)
    script, output = Path(__file__).with_name("irsim_scan.py"), tmp_path / "scan.json"
    command = [str(IRSIM_PYTHON), str(script), str(tmp_path / "map.yaml"), str(output), json.dumps(place.tolist())]
    environment = {name: value for name, value in os.environ.items() if name != "PYTHONPATH"}
    subprocess.run(command, check=True, capture_output=True, timeout=600, cwd=tmp_path, env=environment)
    scan = json.loads(output.read_text())
    assert not scan["collision"]
    assert scan["state"][:2] == pytest.approx(place.tolist())
    angles = np.linspace(scan["low"], scan["high"], RAYS)
    expected, measured = distances(tree, place, angles), np.array(scan["ranges"])
    assert len(measured) == RAYS
    # a ray along a face may pass it or not, and doors and ramps are left out of what is expected
    same = np.abs(measured - expected) < NEAR_M
    assert same.mean() > 0.9
    assert (measured <= expected + NEAR_M).mean() > 0.97
    assert (expected < RANGE_M).mean() > 0.5
