"""What holds against a trajectory, computed from its rows alone and from the stage's meshes, with no code of drives."""

import math

import numpy as np
import shapely
from shapely import affinity

from garage2usd.stage.prototypes import asset_of
from support.driving_simulation import LOCK_RAD, WHEELBASE_M, World, corners

FOOT_M = 0.5
MOVED_M = 0.02


class OpenWorld(World):
    """A garage whose gates are open: of each only what stands on the floor counts."""

    def __init__(self, garage):
        super().__init__(garage)
        self.items = [
            (thing, gate_ground(thing) if getattr(thing, "kind", "") == "barrier" else shape)
            for thing, shape in self.items
        ]
        self.tree = shapely.STRtree([shape for _, shape in self.items])

    def swept(self, rows, stall):
        """What the ground touches that a car sweeps between each two rows, but for the stall's own things."""
        bodies = corners(np.stack([rows["x_m"], rows["z_m"], rows["yaw_rad"]], axis=1))
        both = np.concatenate([bodies[:-1], bodies[1:]], axis=1)
        hulls = shapely.convex_hull(shapely.linestrings(both))
        found = self.tree.query(hulls, predicate="intersects")[1]
        things = {id(thing): thing for thing in (self.items[item][0] for item in set(found.tolist()))}.values()
        return {
            thing.name
            for thing in things
            if thing != stall
            and not (getattr(thing, "stall", None) == stall.name and thing.kind in {"car", "wheel_stop", "cone"})
        }


def gate_ground(place):
    """The (x, z) ground of those parts of a gate that stand on the floor."""
    hulls = []
    for part in asset_of(place.spec).parts:
        points = np.asarray(part.points, dtype=float)
        if points[:, 1].min() < FOOT_M:
            hulls.append(shapely.MultiPoint(points[:, [0, 2]]).convex_hull)
    turned = affinity.rotate(shapely.union_all(hulls), -math.degrees(place.yaw_rad), origin=(0, 0))
    return affinity.translate(turned, place.position_m[0], place.position_m[2])


def faults(rows, settings):
    """What the rows hold against the settings and against themselves; rows are arrays by the name of the column."""
    found = []

    def most(name, values, limit):
        worst = float(np.max(np.abs(values), initial=0.0))
        if not worst <= limit:
            found.append(f"{name}: {worst:.6f}, limit {limit:.6f}")

    time, speed = rows["time_s"], rows["speed_m_s"]
    seconds = np.diff(time)
    if not (seconds > 0).all() or time[0] != 0:
        found.append("time does not run from 0 on")
        return found
    steps = np.stack([np.diff(rows[name]) for name in ("x_m", "y_m", "z_m")], axis=1)
    way, plan = np.linalg.norm(steps, axis=1), np.hypot(steps[:, 0], steps[:, 2])
    gear = rows["gear"][:-1]

    # over the break of a ramp, by 7.5 %, the chord is shorter than the way
    most("jump of pose", way - np.diff(rows["arc_m"]), 3e-4)
    most("speed", speed, settings["lane_speed_m_s"] + 1e-6)
    most("speed of the places", way / seconds, settings["lane_speed_m_s"] + 5e-3)
    most("acceleration", np.diff(speed) / seconds, settings["acceleration_m_s2"] + 1e-3)
    most("acceleration that is said", rows["acceleration_m_s2"], settings["acceleration_m_s2"] + 1e-6)
    # between two rows the car may change from speeding up to braking
    off = np.diff(rows["arc_m"]) / seconds - _means(np.abs(speed))
    most("speed that is not that of the places", off, settings["acceleration_m_s2"] * seconds.max() / 4 + 1e-3)
    most("gear against speed", np.minimum(speed * rows["gear"], 0.0), 0.0)
    most("move in another gear", np.where(rows["gear"][1:] == gear, 0.0, way), 1e-6)

    # the heading is that of the way, and its change the curvature: between two rows, where the car has moved
    moves = plan > MOVED_M
    middle_yaw = _means(rows["yaw_rad"])
    sideways = steps[:, 0] * np.cos(middle_yaw) - steps[:, 2] * np.sin(middle_yaw)
    most("slip across the wheels", sideways[moves], 2e-4)
    ahead = -steps[:, 0] * np.sin(middle_yaw) - steps[:, 2] * np.cos(middle_yaw)
    most("move against the gear", np.minimum(ahead * gear, 0.0)[moves], 0.0)
    curvature = np.diff(rows["yaw_rad"])[moves] / (plan * gear)[moves]
    tightest = math.tan(LOCK_RAD) / WHEELBASE_M
    most("curvature of the places", curvature, tightest + 1e-3)
    most("curvature that is said", rows["curvature_per_m"], tightest + 1e-6)
    most("curvature that is not that of the places", curvature - _means(rows["curvature_per_m"])[moves], 4e-3)
    most("turn at a standstill", np.diff(rows["yaw_rad"])[way < 1e-9], 1e-9)
    across = _means(np.abs(speed))[moves] ** 2 * curvature
    most("acceleration across the path", across, settings["lateral_acceleration_m_s2"] + 0.02)

    most(
        "steering that is not the curvature's",
        np.tan(rows["steering_rad"]) / WHEELBASE_M - rows["curvature_per_m"],
        1e-5,
    )
    rate = settings["steering_rate_rad_s"]
    most("steering rate that is said", np.diff(rows["steering_rad"]) / seconds, rate + 1e-3)
    both = moves[1:] & moves[:-1] & (gear[1:] == gear[:-1])
    angle = np.full(len(plan), np.nan)
    angle[moves] = np.arctan(WHEELBASE_M * curvature)
    of_places = (np.diff(angle) / ((seconds[1:] + seconds[:-1]) / 2))[both]
    most("steering rate of the places", of_places, rate * 1.02 + 5e-3)
    return found


def _means(values):
    return (values[1:] + values[:-1]) / 2
