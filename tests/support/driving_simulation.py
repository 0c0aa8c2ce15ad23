"""A kinematic bicycle among the stage's own meshes: drives what garage2usd.driving claims, with no code of its own.

``python tests/support/driving_simulation.py 1000`` drives 1000 stalls of default garages, and says what it found.
"""

import math
import sys
from functools import cache
from itertools import pairwise

import networkx as nx
import numpy as np
import shapely
from shapely import affinity

from garage2usd.stage.prototypes import asset_of
from garage2usd.structure.grid import Cell

LENGTH_M, WIDTH_M, WHEELBASE_M, REAR_M, TRACK_M, TURNING_RADIUS_M = 4.8, 1.8, 2.7, 1.2, 1.55, 6.0
STEP_M = 0.02
LOCK_RAD = math.atan(WHEELBASE_M / (math.sqrt(TURNING_RADIUS_M**2 - WHEELBASE_M**2) - TRACK_M / 2))
_HARMLESS = {
    "floor",
    "stall",
    "ceiling",
    "light",
    "beam",
    "duct",
    "cable_tray",
    "sprinkler",
    "exit_sign",
    "lane_sign",
    "mirror",
    "speed_bump",
    "sky",
    "stall_number",
    "zone_plate",
    "number_plate",
    "floor_stain",
    "drain",
}
_OWN = {"car", "wheel_stop", "cone"}
_OVERHEAD_M = 2.0


def simulate(start, moves):
    """Poses (x, z, yaw) every 2 cm of a bicycle model integrated by Runge and Kutta at 1 m/s."""
    state = np.array(start, dtype=float)
    track = [state]
    for gear, curvature, length in moves:
        steer = math.atan(curvature * WHEELBASE_M)
        assert abs(steer) <= LOCK_RAD + 1e-9
        speed = {"forward": 1.0, "reverse": -1.0}[gear]
        count = max(1, math.ceil(length / STEP_M))
        for _ in range(count):
            state = _step(state, speed, steer, length / count)
            track.append(state)
    return np.array(track)


def _step(state, speed, steer, seconds):
    def rate(at):
        return np.array(
            [-math.sin(at[2]) * speed, -math.cos(at[2]) * speed, speed * math.tan(steer) / WHEELBASE_M], dtype=float
        )

    k1 = rate(state)
    k2 = rate(state + seconds / 2 * k1)
    k3 = rate(state + seconds / 2 * k2)
    k4 = rate(state + seconds * k3)
    return state + seconds / 6 * (k1 + 2 * k2 + 2 * k3 + k4)


def outlines(track):
    """The car's rectangle in each pose, as an array of polygons."""
    return shapely.polygons(corners(track))


def corners(track):
    """The corners (x, z) of the car's rectangle in each pose; float64, shape (poses, 4, 2)."""
    track = np.atleast_2d(track)
    ahead = np.array([LENGTH_M - REAR_M, LENGTH_M - REAR_M, -REAR_M, -REAR_M])
    right = np.array([-1, 1, 1, -1]) * WIDTH_M / 2
    x, z, yaw = track.T[:, :, None]
    return np.stack(
        [x - np.sin(yaw) * ahead + np.cos(yaw) * right, z - np.cos(yaw) * ahead - np.sin(yaw) * right], axis=2
    )


@cache
def _hulls(spec):
    """Convex hulls on the floor of the parts of a shape that are between a kerb's height and 2 m."""
    hulls = []
    for part in asset_of(spec).parts:
        points = np.asarray(part.points, dtype=float)
        if points[:, 1].min() > _OVERHEAD_M or part.name in {"Threshold", "Floor", "Drain"} or "Kerb" in part.name:
            continue
        groups = [points]
        if part.name in {"Frame", "Mirrors"}:  # a pair
            groups = [points[points[:, 0] < 0], points[points[:, 0] > 0]]
        low = [group[group[:, 1] <= _OVERHEAD_M] for group in groups]
        hulls += [shapely.MultiPoint(group[:, [0, 2]]).convex_hull for group in low if len(group)]
    return shapely.union_all(hulls) if hulls else shapely.Polygon()


def ground(place):
    """The (x, z) ground that an object's meshes stand on."""
    # turning by +yaw about +Y takes +Z to +X: in (x, z) that is a turn by -yaw
    turned = affinity.rotate(_hulls(place.spec), -math.degrees(place.yaw_rad), origin=(0, 0))
    return affinity.translate(turned, place.position_m[0], place.position_m[2])


class World:
    """The things of a garage, and a car in each stall that has none."""

    def __init__(self, garage):
        self.garage = garage
        self.items = [(place, ground(place)) for place in garage.layout.placements if place.kind not in _HARMLESS]
        held = {car.stall for car in garage.layout.of_kind("car")}
        for stall in garage.layout.stalls:
            if stall.use.takes_cars and stall.name not in held:
                middle = np.mean(stall.corners_m(), axis=0)
                box = affinity.rotate(
                    shapely.box(-WIDTH_M / 2, -LENGTH_M / 2, WIDTH_M / 2, LENGTH_M / 2),
                    -math.degrees(stall.yaw_rad),
                    origin=(0, 0),
                )
                self.items.append((stall, affinity.translate(box, *middle)))
        self.tree = shapely.STRtree([shape for _, shape in self.items])
        x, z = garage.plan.structure.column_edges_m, garage.plan.structure.row_edges_m
        cells = garage.plan.structure.cells
        self.road = shapely.union_all(
            [shapely.box(x[c], z[r], x[c + 1], z[r + 1]) for r, c in np.argwhere(cells >= Cell.LANE)]
        ).buffer(1e-6)
        self.lines = self._lines()

    def _lines(self):
        """Pairs of squares by direction, joined where a car drives on from one to the next."""
        cells, graph = self.garage.plan.structure.cells, self.garage.graph.graph
        driven = nx.DiGraph(graph)
        driven.remove_edges_from([(end, start) for start, end in self.garage.plan.directions.one_way])
        lines = nx.line_graph(driven)
        turns = [(one, other) for one, other in lines.edges if one[0] == other[1] or cells[one[1]] != Cell.LANE]
        lines.remove_edges_from(turns)
        return lines

    def touched(self, track, stall):
        """What the car touches on its way, but for the stall's own things."""
        found = self.tree.query(outlines(track), predicate="intersects")[1]

        def is_own(thing):
            """An absent car is its stall."""
            return thing == stall or (getattr(thing, "stall", None) == stall.name and thing.kind in _OWN)

        return {thing.name for thing in (self.items[item][0] for item in set(found.tolist())) if not is_own(thing)}

    def stands_in(self, pose, stall):
        """Whether the whole car stands within a stall, in line with it."""
        askew = math.remainder(pose[2] - stall.yaw_rad, math.pi)
        return shapely.Polygon(stall.corners_m()).contains(outlines(pose)[0]) and abs(askew) < 1e-3

    def edges_at(self, pose):
        """The pairs of squares that the car is on, if it is in line with a lane and wholly on the road."""
        body = outlines(pose)[0]
        step_x, step_z = -math.sin(pose[2]), -math.cos(pose[2])
        is_in_line = abs(math.remainder(pose[2], math.pi / 2)) < 1e-3
        if not is_in_line or not self.road.contains(body):
            return []
        step = round(step_z), round(step_x)
        edges = []
        for one, other in self.lines:
            if (other[0] - one[0], other[1] - one[1]) == step:
                ends = [
                    (self.garage.graph.graph.nodes[s]["x_m"], self.garage.graph.graph.nodes[s]["z_m"])
                    for s in (one, other)
                ]
                if shapely.LineString(ends).distance(body.centroid) < 4.1:
                    edges.append((one, other))
        return edges

    def comes_from_entrance(self, pose):
        """Whether cars drive from an entrance to this pose without turning round."""
        starts = [edge for edge in self.lines if self.garage.plan.structure.cells[edge[0]] == Cell.ENTRANCE]
        return any(nx.has_path(self.lines, start, edge) for edge in self.edges_at(pose) for start in starts)

    def leads_to_exit(self, pose):
        """Whether cars drive on from this pose to an exit without turning round."""
        ends = [edge for edge in self.lines if self.garage.plan.structure.cells[edge[1]] == Cell.EXIT]
        return any(nx.has_path(self.lines, edge, end) for edge in self.edges_at(pose) for end in ends)

    def faults(self, stall, proof):
        """What the simulation holds against a stall's proof."""
        faults = []
        for name, way in (("in", proof.way_in), ("out", proof.way_out)):
            start = (way.start.x_m, way.start.z_m, way.start.yaw_rad)
            moves = [(str(move.gear), move.curvature_per_m, move.length_m) for move in way.moves]
            gears = [gear for gear, _, _ in moves]
            if sum(a != b for a, b in pairwise(gears)) > 4:
                faults.append(f"{name}: more than four changes of gear")
            track = simulate(start, moves)
            if proof.is_full and (touched := self.touched(track, stall)):
                faults.append(f"{name}: touches {sorted(touched)}")
            parked, lane = (track[-1], track[0]) if name == "in" else (track[0], track[-1])
            if not self.stands_in(parked, stall):
                faults.append(f"{name}: does not stand in the stall, {parked}")
            if name == "in" and not self.comes_from_entrance(lane):
                faults.append(f"in: does not come from an entrance, {lane}")
            if name == "out" and not proof.backs_out and not self.leads_to_exit(lane):
                faults.append(f"out: does not lead to an exit, {lane}")
        return faults


def drive_stalls(count, seed, settings=None):
    """Drive the stalls of garages from a seed on until there are so many: (stalls driven, faults, unproven).

    The garages have the default settings, or those that a function gives for a seed.
    """
    import garage2usd
    from garage2usd.driving import prove_stalls

    driven, faults, unproven = 0, [], []
    while driven < count:
        garage = garage2usd.generate(garage2usd.GarageConfig(**(settings(seed) if settings else {"seed": seed})))
        world = World(garage)
        proofs = prove_stalls(garage.layout)
        stalls = {stall.name: stall for stall in garage.layout.stalls}
        for proof in proofs[: count - driven]:
            driven += 1
            if proof.is_proven:
                faults += [f"seed {seed}, {proof.stall}: {fault}" for fault in world.faults(stalls[proof.stall], proof)]
            else:
                unproven.append(f"seed {seed}, {proof.stall}: {proof.touched[:4]}")
        seed += 1
    return driven, faults, unproven


if __name__ == "__main__":
    driven, faults, unproven = drive_stalls(int(sys.argv[1]), int(sys.argv[2]) if len(sys.argv) > 2 else 1000)
    sys.stdout.write("\n".join([*faults, *unproven, ""]))
    sys.stdout.write(f"{driven} stalls driven, {len(faults)} faults, {len(unproven)} without ways\n")
    sys.exit(bool(faults))
