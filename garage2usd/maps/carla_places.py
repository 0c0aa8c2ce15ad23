"""Places of a garage in CARLA's frame: spawn points, parking spots, parked cars and lamps, as plain values."""

import math
from collections.abc import Iterator, Sequence
from typing import Any

import numpy as np
from pxr import Usd

from garage2usd.as_built.garage import BuiltGarage
from garage2usd.garage import LaneKind
from garage2usd.maps.level_networks import LevelNetwork
from garage2usd.maps.network import LEFT, Road
from garage2usd.maps.parked_cars import parked_cars
from garage2usd.maps.placed_lights import placed_lights
from garage2usd.scenes.prims import PlacedObject
from garage2usd.scenes.remarks import Remarks

FRAME = "metres and degrees; x is the stage's X, y its Z, z its Y; yaw from x to y, pitch with the nose up"
_DIGITS = 4
_LEAST_M = 5.0
"""Length of a road on which a car spawns."""
_ALL_ROUND_DEG = 90.0


def spawn_points(networks: Sequence[LevelNetwork]) -> Iterator[dict[str, Any]]:
    """Yield a place in the middle of each lane outside junctions, with the numbers of its road and lane in the map."""
    for level, network in networks:
        portals = level.street_portals
        entrances = {number for number in portals if level.lanes.nodes[number].kind == LaneKind.ENTRANCE}
        for road in network.roads:
            if road.junction is None and road.line.length_m >= _LEAST_M:
                # the road of a ramp to the street has no node, and nothing leads to it
                is_entrance = not entrances.isdisjoint(road.nodes) or not (road.nodes or road.predecessor)
                for lane in road.lanes:
                    yield {
                        "road": road.number,
                        "lane": lane,
                        "level": level.place.name,
                        "is_entrance": is_entrance,
                        **_on_lane(road, lane),
                    }


def _on_lane(road: Road, lane: int) -> dict[str, Any]:
    """Return the pose in the middle of a lane, along its middle line; the left lane leads against the road."""
    run_m, step_m, sign = road.line.length_m / 2, min(0.1, road.line.length_m / 4), -1 if lane == LEFT else 1
    runs_m = [run_m - sign * step_m, run_m, run_m + sign * step_m]
    before, (x, y), after = road.middle_points(lane, np.array(runs_m)).tolist()
    yaw_deg = -math.degrees(math.atan2(after[1] - before[1], after[0] - before[0]))
    low_m, height_m, high_m = map(road.height_m, runs_m)
    pitch_deg = math.degrees(math.atan2(high_m - low_m, 2 * step_m))
    return _pose(x, -y, road.floor_m + height_m, yaw_deg=yaw_deg, pitch_deg=pitch_deg)


def parking_spots(networks: Sequence[LevelNetwork]) -> Iterator[dict[str, Any]]:
    """Yield the stalls for parking; `yaw_deg` is that of a car parked nose in, `corners` begin at the mouth's left."""
    for level, _ in networks:
        taken = level.taken_stalls
        for stall in level.stalls:
            if not stall.is_parked_in:
                continue
            corners = np.array(stall.corners)
            mouth, rear = corners[:2].mean(axis=0), corners[2:].mean(axis=0)
            along_x, along_z = (rear - mouth).tolist()
            x, z = ((mouth + rear) / 2).tolist()
            yield {
                "stall": stall.name,
                **({} if stall.number is None else {"number": stall.number}),
                "use": str(stall.use),
                "level": level.place.name,
                "is_occupied": stall in taken,
                "width_m": round(float(np.linalg.norm(corners[1] - corners[0])), _DIGITS),
                "length_m": round(math.hypot(along_x, along_z), _DIGITS),
                **_pose(x, z, level.place.floor_m, yaw_deg=math.degrees(math.atan2(along_z, along_x))),
                "corners": np.round(corners, _DIGITS).tolist(),
            }


def parked(garage: BuiltGarage) -> Iterator[dict[str, Any]]:
    """Yield the parked cars as boxes, with the middle of their footprint on the floor."""
    number_of = {stall.name: stall.number for stall in garage.stalls}
    for car in parked_cars(garage):
        x, z = car.middle_m
        yield {
            "name": car.name,
            "class": car.label,
            "stall": car.stall,
            "number": number_of.get(car.stall),
            "prim": car.prim,
            "length_m": round(car.length_m, _DIGITS),
            "width_m": round(car.width_m, _DIGITS),
            "height_m": round(car.height_m, _DIGITS),
            **_pose(x, z, car.floor_m, yaw_deg=-90.0 - math.degrees(car.yaw_rad)),
        }


def lamps(stage: Usd.Stage, objects: Sequence[PlacedObject], remarks: Remarks) -> Iterator[dict[str, Any]]:
    """Yield the lights as lamps of Unreal: ``rect``, ``point``, ``spot`` or ``sun``, which shine along `forward`."""
    for path, (matrix, light, nits_per_unit) in placed_lights(stage, objects, remarks):
        brightest = max(light.colour_rgb)
        factor = nits_per_unit / light.brightness * brightest
        is_spot = light.cone_deg < _ALL_ROUND_DEG
        form = "spot" if is_spot else "rect" if light.kind in {"RectLight", "DiskLight"} else "point"
        axes = matrix[:3, :3] / np.maximum(np.linalg.norm(matrix[:3, :3], axis=1, keepdims=True), 1e-12)
        yield {
            "prim": path,
            "kind": "sun" if light.kind == "DistantLight" else form,
            **dict(zip("xyz", _swapped(matrix[3, :3]), strict=True)),
            "forward": _swapped(-axes[2]),
            "up": _swapped(axes[1]),
            "width_m": round(light.width_m, _DIGITS),
            "height_m": round(light.height_m, _DIGITS),
            "candela": round(light.candela * factor, _DIGITS),
            "lux": round(light.lux * factor, _DIGITS),
            "cone_deg": round(min(light.cone_deg, 180.0), _DIGITS),
            "colour_rgb": [round(float(part) / brightest, _DIGITS) for part in light.colour_rgb],
        }


def _swapped(vector: Any) -> list[float]:  # noqa: ANN401 - three numbers
    """Convert (x, y, z) of the stage to CARLA's left-handed (x, z, y)."""
    x, y, z = (np.round(np.asarray(vector, dtype=np.float64), _DIGITS) + 0.0).tolist()
    return [x, z, y]


def _pose(x: float, y: float, z: float, *, yaw_deg: float, pitch_deg: float = 0.0) -> dict[str, float]:
    yaw = round(math.remainder(yaw_deg, 360.0), _DIGITS)
    values = {"x": x, "y": y, "z": z, "pitch_deg": pitch_deg}
    return {name: round(value, _DIGITS) + 0.0 for name, value in values.items()} | {"yaw_deg": yaw + 0.0}
