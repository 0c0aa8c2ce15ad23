"""Manoeuvres on published scenes: ParkBench, HOPE's Dragon Lake set and TPCAP, each way checked by shapely every 5 cm.

``python benchmarks/manoeuvres.py --parkbench FOLDER --dragon-lake FILE --tpcap FOLDER`` reads what is given; how to get
the sets is told in docs/driving.md. Nothing of them is part of the repository.
"""

import argparse
import math
import time
from pathlib import Path
from typing import Any

import numpy as np
import shapely

from garage2usd.driving import Manoeuvre, Pose
from garage2usd.environment import ParkingTask, dragon_lake_tasks, parkbench_tasks, searched_way, tpcap_tasks

_CHECKED_M = 0.05


def driven(scene: ParkingTask, gear_changes: int) -> dict[str, Any]:
    """What came of the search for one scene."""
    begun = time.process_time()
    found = searched_way(scene, gear_changes=gear_changes)
    seconds = time.process_time() - begun
    row: dict[str, Any] = {"scene": scene.name, "found": found.way is not None, "seconds": round(seconds, 2)}
    if found.way is None:
        return {**row, "why": "none at its resolution" if found.is_exhausted else "undecided", "met": found.touched[:3]}
    return {**row, **checked(scene, found.way)}


def checked(scene: ParkingTask, way: Manoeuvre) -> dict[str, Any]:
    """How near a way comes to the shapes and to where the car comes from, by shapely."""
    poses = way.poses(_CHECKED_M)[0]
    bodies = shapely.polygons([scene.car.corners(Pose(*pose)) for pose in poses.tolist()])
    pieces = shapely.union_all([shapely.MultiPoint(piece).convex_hull for piece in scene.obstacles.pieces])
    clearance_m = math.inf if pieces.is_empty else float(shapely.distance(bodies, pieces).min())
    x, z, yaw = poses[-1]
    turned = abs(math.remainder(yaw - scene.start.yaw_rad, math.tau))
    return {
        "changes": way.gear_changes,
        "metres": round(way.length_m, 1),
        "clearance_m": round(clearance_m, 4),
        "is_clear": clearance_m >= max(scene.margin_m - 1e-6, 0.0) and (clearance_m > 0 or scene.margin_m > 0),
        "off_m": round(math.dist((x, z), (scene.start.x_m, scene.start.z_m)), 4),
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
        ("ParkBench", parkbench_tasks, asked.parkbench),
        ("Dragon Lake", dragon_lake_tasks, asked.dragon_lake),
        ("TPCAP", tpcap_tasks, asked.tpcap),
    ):
        if path is None:
            continue
        rows = []
        for scene in read(path)[:: asked.every]:
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
