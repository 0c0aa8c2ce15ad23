"""What Autoware makes of an exported folder: lanelets next to poses, routes, and the points of the cloud."""

import math

import networkx as nx
import numpy as np
import shapely
import trimesh
import yaml

from support.autoware_judge import CODES, AutowareMap, complaints
from support.sensor_judges import run_judge
from support.solid_triangles import solid_triangles

IN_LANE_M = 0.01
"""Distance from a lanelet below which Autoware's scenario selector takes a goal for one on it, and does not park."""
NEAR_M = 0.01
"""Greatest distance of a point of the cloud from a surface."""
TURN_RAD = math.radians(45)


class AutowareFolder:
    """A folder with the map of one level, or of all of them."""

    def __init__(self, folder, level=""):
        self.folder, self.level = folder, level
        self.map = AutowareMap(folder / (f"lanelet2_map_{level}.osm" if level else "lanelet2_map.osm"))
        told = yaml.safe_load((folder / "goal_poses.yaml").read_text(encoding="utf-8"))
        assert told["frame_id"] == "map"
        self.starts = [start for start in told["starts"] if start["name"].startswith(level)]
        self.goals = [goal for goal in told["goals"] if goal["level"] == level]
        self.numbers = list(self.map.lanelets)
        self.grounds = np.array([shapely.make_valid(self.map.lanelets[number].ground) for number in self.numbers])

    def complaints(self, *, but=()):
        for code in CODES:
            if code not in but:
                yield from (f"{code} {words}" for words in complaints(self.map, code))
        yield from self._routes()

    def _routes(self):
        """A route leads to the lanelet next to each goal, and on from it to where a car leaves the level."""
        ways = nx.DiGraph()
        ways.add_nodes_from(self.numbers)
        ways.add_edges_from((one, other) for one, onward in self.map.following.items() for other in onward)
        spaces = {tags["name"]: points for points, tags in self.map.typed("parking_space").values()}
        lots = [self.map.polygon(way) for way in self.map.typed("parking_lot")]
        starts = [self.closest(start["pose"]) for start in self.starts]
        if not starts or not self.goals:
            yield f"{len(starts)} starts and {len(self.goals)} goals"
        for number, far_m, turned in starts:
            if far_m > 0 or turned > TURN_RAD:
                yield f"a start {far_m:.2f} m from lanelet {number} and turned by {turned:.2f}"
        reached = {number for number, _, _ in starts}
        reached = reached.union(*(nx.descendants(ways, number) for number in reached))
        left = {number for number in self.numbers if not self.map.following[number]}
        left = left.union(*(nx.ancestors(ways, number) for number in left))
        for goal in self.goals:
            if goal["stall"] not in spaces:
                yield f"no space {goal['stall']}"
                continue
            space = shapely.LineString(self.map.flat(spaces[goal["stall"]]))
            for nose in ("nose_in", "nose_out"):
                place = _place(goal[nose])
                number, far_m, _ = self.closest(goal[nose])
                if number not in reached or number not in left:
                    yield f"no route to or from {goal['stall']}"
                if far_m < IN_LANE_M:
                    yield f"{goal['stall']}, {nose}, lies on lanelet {number}"
                if space.distance(place) > 0.05 or not any(lot.contains(place) for lot in lots):
                    yield f"{goal['stall']}, {nose}, lies {space.distance(place):.2f} m from its space"

    def closest(self, pose):
        """The lanelet that Autoware finds: the nearest one seen from above, of several the one that is turned least."""
        place = _place(pose)
        far = shapely.distance(self.grounds, place)
        turned = {
            self.numbers[index]: self._turned(self.numbers[index], pose, place)
            for index in np.flatnonzero(far <= far.min() + 1e-9)
        }
        number = min(turned, key=turned.get)
        return number, float(far.min()), turned[number]

    def _turned(self, number, pose, place):
        centre = self.map.centres[number]
        run = centre.project(place)
        (x0, y0), (x1, y1) = (centre.interpolate(max(run + step, 0.0)).coords[0] for step in (-0.2, 0.2))
        yaw = 2 * math.atan2(pose["orientation"]["z"], pose["orientation"]["w"])
        return abs(math.remainder(math.atan2(y1 - y0, x1 - x0) - yaw, math.tau))


def _place(pose):
    return shapely.Point(pose["position"]["x"], pose["position"]["y"])


def cloud_complaints(folder, stage, work):
    """What Open3D finds wrong with the point cloud of a folder, by distances to the stage's own meshes."""
    whole = folder / "pointcloud_map.pcd"
    files = sorted(whole.iterdir()) if whole.is_dir() else [whole]
    vertices, triangles, _ = solid_triangles(stage, {})
    mesh, output = work / "mesh.npz", work / "cloud.npz"
    np.savez(mesh, vertices=vertices @ np.array([[1.0, 0, 0], [0, 0, 1], [0, -1, 0]]), triangles=triangles)
    run_judge("open3d_cloud.py", mesh, output, *files, folder=work)
    with np.load(output) as found:
        points, far, counts = found["points"], found["far"], found["counts"]
    # single precision errs on slivers, such as the edge of a long wall
    corners = (vertices @ np.array([[1.0, 0, 0], [0, 0, 1], [0, -1, 0]]))[triangles]
    for number in np.flatnonzero(far > NEAR_M):
        place = points[number]
        near = (corners.min(axis=1) < place + NEAR_M).all(axis=1) & (corners.max(axis=1) > place - NEAR_M).all(axis=1)
        feet = trimesh.triangles.closest_point(corners[near], np.tile(place, (near.sum(), 1)))
        far[number] = min(np.linalg.norm(feet - place, axis=1), default=far[number])
    if far.max() > NEAR_M:
        yield f"{(far > NEAR_M).sum()} of {len(far)} points are off the surfaces, by up to {far.max():.3f} m"
    if len(points) < 10_000 or counts.min() == 0:
        yield f"{len(points)} points"
    yield from _tiles(folder, files, np.split(points, np.cumsum(counts)[:-1]))


def _tiles(folder, files, parts):
    sides = np.ptp(np.concatenate(parts)[:, :2], axis=0)
    told = folder / "pointcloud_map_metadata.yaml"
    if told.exists() != (sides.max() > 100) or (len(files) > 1) > told.exists():
        yield f"{len(files)} files for {sides.round()} m, with metadata: {told.exists()}"
    if not told.exists():
        return
    metadata = yaml.safe_load(told.read_text())
    side = metadata.pop("x_resolution")
    if metadata.pop("y_resolution") != side or {file.name for file in files} != metadata.keys():
        yield "the metadata are of other files"
    for file, points in zip(files, parts, strict=True):
        low = metadata[file.name]
        if any(type(value) is not int or value % side for value in low):
            yield f"{file.name} begins at {low}"
        if (points[:, :2] < low).any() or (points[:, :2] > np.array(low) + side).any():
            yield f"points of {file.name} lie beyond it"
