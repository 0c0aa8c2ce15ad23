"""Manoeuvres on published scenes: ParkBench, HOPE's Dragon Lake set and TPCAP, each way checked by shapely every 5 cm.

``python benchmarks/manoeuvres.py --parkbench FOLDER --dragon-lake FILE --tpcap FOLDER`` reads what is given; how to get
the sets is told in docs/driving.md. Nothing of them is part of the repository.
"""

import argparse
import csv
import json
import math
import pickle
import time
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import shapely

from garage2usd.driving import DesignCar, LanePose, Limits, Manoeuvre, Obstacles, Pose, find_way

_CHECKED_M = 0.05
_WITHIN_M = 0.05
_LINE_M, _ROUNDING_M2 = 0.005, 1e-9


@dataclass(frozen=True)
class ParkingScene:
    """A scene: a car that comes from one pose and parks in another, between shapes in (x, z)."""

    name: str
    car: DesignCar
    come_from: Pose
    parked: Pose
    shapes: tuple[shapely.Geometry, ...]
    margin_m: float

    @property
    def reach_m(self) -> float:
        """How far around the parked pose is looked."""
        apart_m = math.dist((self.come_from.x_m, self.come_from.z_m), (self.parked.x_m, self.parked.z_m))
        return max(20.0, apart_m + 10.0)


def car_of(wheelbase_m: float, front_m: float, rear_m: float, width_m: float, steering_rad: float) -> DesignCar:
    """A car whose rear axle turns on wheelbase / tan(steering)."""
    track_m = 0.82 * width_m
    outer_m = wheelbase_m / math.tan(steering_rad) + track_m / 2
    return DesignCar(
        length_m=wheelbase_m + front_m + rear_m,
        width_m=width_m,
        wheelbase_m=wheelbase_m,
        rear_overhang_m=rear_m,
        track_m=track_m,
        turning_radius_m=math.hypot(outer_m, wheelbase_m),
    )


def pose_of(values: Any) -> Pose:  # noqa: ANN401 - three numbers of a file
    """A pose from x, y and the heading from +x to the left."""
    return Pose(float(values[0]), -float(values[1]), float(values[2]) - math.pi / 2)


def parkbench(folder: Path) -> Iterator[ParkingScene]:
    """The scenes of `rear_in`, with the default design car as they come without one and 0.05 m to spare.

    What lies on the parked car is left out, as the set's own reader does, and so is what lies nearer than the margin to
    where the car stands at either end.
    """
    car, margin_m = DesignCar(), 0.05
    for path in sorted(folder.rglob("*.json")):
        frame = json.loads(path.read_text())["Frames"]["0"]
        request = frame["PlanningRequest"]
        origin = frame.get("m_nfmOrigin", [0, 0])
        if isinstance(origin, dict):
            origin = [origin.get("m_x", 0), origin.get("m_y", 0)]
        moved = np.append(np.subtract(request.get("m_origin", [0, 0])[:2], origin[:2]), 0.0)
        target = request["m_targetArea"] if "m_targetArea" in request else request["m_targetAreas"]
        target = target["m_targetPosture"]
        target = target[0] if isinstance(target, list) else target
        come_from, parked = (pose_of(moved + at["m_pose"]) for at in (request["m_startPosture"], target))
        ends = shapely.polygons([car.corners(come_from), car.corners(parked)])
        own = shapely.union_all(shapely.buffer(ends, margin_m + 0.001))
        lines = []
        for thing in frame["NfmAggregatedPolygonObjects"]:
            nodes = [(at["m_x"], -at["m_y"]) for at in thing["nfmPolygonObjectNodes"]]
            lines.append(shapely.LineString(nodes) if len(nodes) > 1 else shapely.Point(nodes[0]))
        shapes = [line.difference(own) for line in lines]
        yield ParkingScene(path.stem, car, come_from, parked, tuple(at for at in shapes if not at.is_empty), margin_m)


class _Ring:
    """A ring of shapely 1 or 2 as it was pickled."""

    def __setstate__(self, state: Any) -> None:  # noqa: ANN401
        self.state = state


class _RingReader(pickle.Unpickler):
    """Reads rings and arrays, and refuses all else that a pickle may hold."""

    def find_class(self, module: str, name: str) -> Any:  # noqa: ANN401
        if name == "LinearRing" and module.startswith("shapely"):
            return _Ring
        if name == "scalar" and module.startswith("numpy"):
            from numpy._core.multiarray import scalar  # noqa: PLC0415

            return scalar
        if (module, name) == ("numpy", "dtype"):
            return np.dtype
        raise pickle.UnpicklingError(f"{module}.{name} in a file of rings and numbers")


def dragon_lake(path: Path) -> Iterator[ParkingScene]:
    """The scenes of HOPE's `dlp.data`, by its car; the first start of each."""
    car = car_of(2.8, 0.96, 0.93, 1.94, 0.75)
    with path.open("rb") as file:
        scenes = _RingReader(file).load()
    for number, (start, parked, rings, *_) in enumerate(scenes):
        shapes = []
        for ring in rings:
            state = ring.state
            corners = shapely.get_coordinates(shapely.from_wkb(state) if isinstance(state, bytes) else state)
            shape = shapely.Polygon(corners * (1, -1)).convex_hull
            shapes.append(shape if shape.area > _ROUNDING_M2 else shape.buffer(_LINE_M))
        first = start[0] if isinstance(start, list) else start
        yield ParkingScene(f"{number}", car, pose_of(first), pose_of(parked), tuple(shapes), 0.0)


def tpcap(folder: Path) -> Iterator[ParkingScene]:
    """The cases of the competition, by its car."""
    car = car_of(2.8, 0.96, 0.929, 1.942, 0.75)
    for path in sorted(folder.glob("Case*.csv"), key=lambda path: int(path.stem[4:])):
        with path.open() as file:
            values = [float(value) for value in next(csv.reader(file)) if value.strip()]
        counts = [int(value) for value in values[7 : 7 + int(values[6])]]
        corners = np.array(values[7 + len(counts) :]).reshape(-1, 2) * (1, -1)
        shapes = tuple(shapely.Polygon(ring) for ring in np.split(corners, np.cumsum(counts)[:-1]) if len(ring))
        yield ParkingScene(path.stem, car, pose_of(values[:3]), pose_of(values[3:6]), shapes, 0.0)


def driven(scene: ParkingScene, gear_changes: int) -> dict[str, Any]:
    """What came of the search for one scene."""
    obstacles = Obstacles.of((str(number), shape) for number, shape in enumerate(scene.shapes))
    ahead_m = scene.car.length_m / 2 - scene.car.rear_overhang_m
    at = scene.come_from
    middle = at.x_m - math.sin(at.yaw_rad) * ahead_m, at.z_m - math.cos(at.yaw_rad) * ahead_m
    lane = LanePose(middle, at.yaw_rad, _WITHIN_M, _WITHIN_M)
    limits = Limits(margin_m=scene.margin_m, gear_changes=gear_changes, reach_m=scene.reach_m)
    begun = time.process_time()
    found = find_way(scene.car, scene.parked, obstacles, [lane], limits)
    seconds = time.process_time() - begun
    row: dict[str, Any] = {"scene": scene.name, "found": found.way is not None, "seconds": round(seconds, 2)}
    if found.way is None:
        return {**row, "why": "none at its resolution" if found.is_exhausted else "undecided", "met": found.touched[:3]}
    return {**row, **checked(scene, found.way)}


def checked(scene: ParkingScene, way: Manoeuvre) -> dict[str, Any]:
    """How near a way comes to the shapes and to where the car comes from, by shapely."""
    poses = way.poses(_CHECKED_M)[0]
    bodies = shapely.polygons([scene.car.corners(Pose(*pose)) for pose in poses.tolist()])
    clearance_m = float(shapely.distance(bodies, shapely.union_all(scene.shapes)).min()) if scene.shapes else math.inf
    x, z, yaw = poses[-1]
    turned = abs(math.remainder(yaw - scene.come_from.yaw_rad, math.tau))
    return {
        "changes": way.gear_changes,
        "metres": round(way.length_m, 1),
        "clearance_m": round(clearance_m, 4),
        "is_clear": clearance_m >= max(scene.margin_m - 1e-6, 0.0) and (clearance_m > 0 or scene.margin_m > 0),
        "off_m": round(math.dist((x, z), (scene.come_from.x_m, scene.come_from.z_m)), 4),
        "off_degrees": round(math.degrees(turned), 4),
    }


def main() -> None:
    """Drive the scenes of the sets that are given."""
    arguments = argparse.ArgumentParser(description=__doc__)
    arguments.add_argument("--parkbench", type=Path)
    arguments.add_argument("--dragon-lake", type=Path)
    arguments.add_argument("--tpcap", type=Path)
    arguments.add_argument("--every", type=int, default=1, help="only every n-th scene")
    arguments.add_argument("--changes", type=int, default=4, help="most changes of gear")
    arguments.add_argument("--rows", action="store_true", help="a line a scene")
    asked = arguments.parse_args()
    print("set            found  clear  of   within m  changes  median s  most s")
    for name, read, path in (
        ("ParkBench", parkbench, asked.parkbench),
        ("Dragon Lake", dragon_lake, asked.dragon_lake),
        ("TPCAP", tpcap, asked.tpcap),
    ):
        if path is None:
            continue
        rows = []
        for scene in list(read(path))[:: asked.every]:
            rows.append(driven(scene, asked.changes))
            if asked.rows:
                print(rows[-1], flush=True)
        found = [row for row in rows if row["found"]]
        seconds = [row["seconds"] for row in rows]
        print(
            f"{name:14} {len(found):5}  {sum(row['is_clear'] for row in found):5}  {len(rows):3}"
            f"  {max((row['off_m'] for row in found), default=math.nan):8.4f}"
            f"  {max((row['changes'] for row in found), default=0):7}"
            f"  {float(np.median(seconds)):8.2f}  {max(seconds):6.2f}",
            flush=True,
        )


if __name__ == "__main__":
    main()
