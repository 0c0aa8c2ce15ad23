"""Parking tasks of published scenes, read from files that users download: ParkBench, Dragon Lake and TPCAP."""

import csv
import json
import math
import pickle
from collections.abc import Callable, Iterable
from pathlib import Path
from typing import Any, TypeVar

import numpy as np
import shapely

from garage2usd.common.errors import UnreadableFileError
from garage2usd.driving import DesignCar, Obstacles, Pose
from garage2usd.environment.task import ParkingTask

_Kind = TypeVar("_Kind")
_LINE_M, _ROUNDING_M2 = 0.005, 1e-9
_TRACK = 0.82
_CASE = "Case"
_READ = (
    *(OSError, EOFError, ValueError, LookupError, TypeError, AttributeError),
    *(pickle.UnpicklingError, shapely.GEOSException),
)


def parkbench_tasks(folder: str | Path) -> list[ParkingTask]:
    """Read the scenes of ParkBench's folder ``rear_in``, with the design car and 0.05 m to spare.

    The set has no car. What lies on the parked car is left out, as the set's own reader does, and so is what lies
    nearer than the margin to where the car stands at either end.

    Raises
    ------
    UnreadableFileError
        If a file is not such a scene, or there is none.
    """
    return [_read(_parkbench, path) for path in _found(folder, Path(folder).rglob("*.json"))]


def dragon_lake_tasks(path: str | Path) -> list[ParkingTask]:
    """Read the scenes of HOPE's ``dlp.data``, with its car; the first start of each.

    Raises
    ------
    UnreadableFileError
        If the file does not hold such scenes. Of a pickle only rings and numbers are read.
    """
    car = _car_of(2.8, 0.96, 0.93, 1.94, 0.75)

    def tasks(path: Path) -> list[ParkingTask]:
        with path.open("rb") as file:
            return [_lake(f"{number}", car, scene) for number, scene in enumerate(_RingReader(file).load())]

    return _read(tasks, Path(path))


def tpcap_tasks(folder: str | Path) -> list[ParkingTask]:
    """Read the cases of the competition TPCAP, ``Case1.csv`` and so on, with its car.

    Raises
    ------
    UnreadableFileError
        If a file is not such a case, or there is none.
    """
    paths = _found(folder, Path(folder).glob(f"{_CASE}*.csv"))
    return [_read(_tpcap, path) for path in sorted(paths, key=lambda path: (len(path.stem), path.stem))]


def _found(folder: str | Path, paths: Iterable[Path]) -> list[Path]:
    found = sorted(paths)
    if not found:
        raise UnreadableFileError(folder, "holds no scenes")
    return found


def _read(reader: Callable[[Path], _Kind], path: Path) -> _Kind:
    try:
        return reader(path)
    except _READ as error:
        raise UnreadableFileError(path, f"is no scene of its set: {error}") from None


def _car_of(wheelbase_m: float, front_m: float, rear_m: float, width_m: float, steering_rad: float) -> DesignCar:
    """Return a car whose rear axle turns on wheelbase / tan(steering)."""
    track_m = _TRACK * width_m
    turning_radius_m = math.hypot(wheelbase_m / math.tan(steering_rad) + track_m / 2, wheelbase_m)
    return DesignCar(wheelbase_m + front_m + rear_m, width_m, wheelbase_m, rear_m, track_m, turning_radius_m)


def _pose_of(values: Any) -> Pose:  # noqa: ANN401 - three numbers of a file
    """Return a pose from x, y and the heading from +x to the left."""
    return Pose(float(values[0]), -float(values[1]), float(values[2]) - math.pi / 2)


def _obstacles(shapes: Iterable[shapely.Geometry]) -> Obstacles:
    return Obstacles.of((str(number), shape) for number, shape in enumerate(shapes) if not shape.is_empty)


def _parkbench(path: Path) -> ParkingTask:
    car, margin_m = DesignCar(), 0.05
    frame = json.loads(path.read_text(encoding="utf-8"))["Frames"]["0"]
    request = frame["PlanningRequest"]
    origin = frame.get("m_nfmOrigin", [0, 0])
    if isinstance(origin, dict):
        origin = [origin.get("m_x", 0), origin.get("m_y", 0)]
    moved = np.append(np.subtract(request.get("m_origin", [0, 0])[:2], origin[:2]), 0.0)
    target = request["m_targetArea"] if "m_targetArea" in request else request["m_targetAreas"]
    target = target["m_targetPosture"]
    target = target[0] if isinstance(target, list) else target
    start, goal = (_pose_of(moved + at["m_pose"]) for at in (request["m_startPosture"], target))
    own = shapely.union_all(shapely.buffer(shapely.polygons([car.corners(start), car.corners(goal)]), margin_m + 0.001))
    lines = []
    for thing in frame["NfmAggregatedPolygonObjects"]:
        nodes = [(at["m_x"], -at["m_y"]) for at in thing["nfmPolygonObjectNodes"]]
        lines.append(shapely.LineString(nodes) if len(nodes) > 1 else shapely.Point(nodes[0]))
    return ParkingTask(path.stem, car, start, goal, _obstacles(line.difference(own) for line in lines))


class _Ring:
    """A ring of shapely 1 or 2 as it was pickled."""

    def __setstate__(self, state: Any) -> None:  # noqa: ANN401
        self.state = state


class _RingReader(pickle.Unpickler):
    """Reader of rings and arrays, which refuses all else that a pickle may hold."""

    def find_class(self, module: str, name: str) -> Any:  # noqa: ANN401
        if name == "LinearRing" and module.startswith("shapely"):
            return _Ring
        if name == "scalar" and module.startswith("numpy"):
            return np.float64(0).__reduce__()[0]
        if (module, name) == ("numpy", "dtype"):
            return np.dtype
        raise pickle.UnpicklingError(f"{module}.{name} in a file of rings and numbers")


def _lake(name: str, car: DesignCar, scene: Any) -> ParkingTask:  # noqa: ANN401
    start, goal, rings, *_ = scene
    shapes = []
    for ring in rings:
        state = ring.state
        corners = shapely.get_coordinates(shapely.from_wkb(state) if isinstance(state, bytes) else state)
        shape = shapely.Polygon(corners * (1, -1)).convex_hull
        shapes.append(shape if shape.area > _ROUNDING_M2 else shape.buffer(_LINE_M))
    first = start[0] if isinstance(start, list) else start
    return ParkingTask(name, car, _pose_of(first), _pose_of(goal), _obstacles(shapes), margin_m=0.0)


def _tpcap(path: Path) -> ParkingTask:
    with path.open(encoding="utf-8") as file:
        values = [float(value) for value in next(csv.reader(file), []) if value.strip()]
    counts = [int(value) for value in values[7 : 7 + int(values[6])]]
    corners = np.array(values[7 + len(counts) :]).reshape(-1, 2) * (1, -1)
    rings = np.split(corners, np.cumsum(counts)[:-1])
    shapes = [shapely.Polygon(ring) for ring in rings if len(ring)]
    car = _car_of(2.8, 0.96, 0.929, 1.942, 0.75)
    return ParkingTask(path.stem, car, _pose_of(values[:3]), _pose_of(values[3:6]), _obstacles(shapes), margin_m=0.0)
