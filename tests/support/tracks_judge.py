"""A judge of tracks that shares no code with the simulation: outlines by shapely at 20 Hz, and differences of samples.

``judge(tracks, garage)`` finds for each kind of pair (car-car, car-person, person-person, car-building and
person-building) all overlaps and the least clearance, the meetings of two moving cars, and the extremes of motion.
``PYTHONPATH=tests python -m support.tracks_judge STAGE TRACKS`` prints them and exits with 1 where something overlaps.
"""

import math
import sys
from collections import defaultdict
from itertools import combinations
from typing import NamedTuple

import numpy as np
import shapely

from garage2usd.as_built.openings import section_of
from garage2usd.objects import CAR_LABELS
from garage2usd.objects.car import CarSpec

HZ = 20.0
NEAR_M = 8.0
CLEAR_M = 0.05
LOOK_M = 1.0
"""Outlines further apart than this are not measured: the least clearance is then told as this."""
MOVES_M_S = 0.1
APART_S = 5.0
"""Two cars that were apart for so long meet again."""
UNDER_M = 0.17
"""Clearance of a car's floor: what is lower, a wheel stop or a kerb, it stands over."""
STOREY_M = 1.5
SECTION_M = 0.25
OVER_FLOOR_M = 1.0
"""Doors and ramps, which are hollow, are cut at this height over the floor below the agent."""
GATE_M = 0.5
"""Gates are open: only what begins lower stands in the way."""
HOLLOW, FLAT = {"vehicle_door", "ramp"}, {"speed_bump"}
OVERLAP_M2 = 1e-6
"""Rounding: outlines that share less touch."""


_KINDS = {"person": "person", "shopping_trolley": "trolley"}
"""Classes of agents that are no cars."""


class Touch(NamedTuple):
    """Two things that overlap or are close, from a first to a last time; the least clearance or most area, and when."""

    kind: str
    one: str
    other: str
    from_s: float
    to_s: float
    least_m: float
    area_m2: float
    at_s: float

    def __str__(self):
        what = f"overlap by {self.area_m2:.4f} m2" if self.area_m2 > OVERLAP_M2 else f"are {self.least_m:.3f} m apart"
        span = f"{self.from_s:.2f}-{self.to_s:.2f} s"
        return f"{self.kind}: {self.one} and {self.other} {what} at {self.at_s:.2f} s ({span})"


class Verdict(NamedTuple):
    """What was found; `least_m` and `extremes` by kind of pair and class of agent."""

    overlaps: list
    close: list
    least_m: dict
    meetings: int
    extremes: dict
    faults: list

    def beyond(self, limits):
        """Extremes beyond limits, which are mappings like `extremes`, as lines."""
        return [
            f"{kind}: {name} {value:.3f} of {agent} at {at:.2f} s, limit {limits[kind][name]}"
            for kind, found in self.extremes.items()
            for name, (value, agent, at) in found.items()
            if value > limits.get(kind, {}).get(name, math.inf)
        ]


class _Moving:
    """An agent at each step from `first` on: poses and outlines."""

    def __init__(self, track, steps, mirrors):
        agent, times = track.agent, np.asarray(track.time_s)
        self.name, self.agent = agent.name, agent
        self.kind = _KINDS.get(agent.kind, "car")
        # a car of the stage stands there before its track begins
        begins = 0.0 if agent.prim else times[0]
        at = np.arange(math.ceil(begins * HZ - 1e-6), math.floor(times[-1] * HZ + 1e-6) + 1)
        at = at[at < steps]
        self.first, self.last = int(at[0]) if len(at) else 0, int(at[-1]) + 1 if len(at) else 0
        seconds = at / HZ
        columns = (track.x_m, track.y_m, track.z_m, track.yaw_rad, track.pitch_rad)
        self.x, self.y, self.z, self.yaw, self.pitch = (np.interp(seconds, times, column) for column in columns)
        speed = np.hypot(np.gradient(self.x), np.gradient(self.z)) * HZ if len(at) > 1 else np.zeros(len(at))
        self.moves = speed > MOVES_M_S
        self.shape = _outline(agent, mirrors)
        corners = shapely.get_coordinates(self.shape)
        self.reach_m = float(np.hypot(*corners.T).max())
        # standing agents have one outline for all of their steps
        poses = np.stack([self.x, self.z, self.yaw], axis=1)
        self.pose = np.concatenate([[0], np.cumsum((np.diff(poses, axis=0) != 0).any(axis=1))]).astype(int)
        self.firsts = np.flatnonzero(np.concatenate([[True], np.diff(self.pose) > 0])) if len(at) else self.pose[:0]
        cos, sin = np.cos(self.yaw[self.firsts])[:, None], np.sin(self.yaw[self.firsts])[:, None]
        x = self.x[self.firsts][:, None] + corners[:, 0] * cos + corners[:, 1] * sin
        z = self.z[self.firsts][:, None] - corners[:, 0] * sin + corners[:, 1] * cos
        self.outlines = shapely.polygons(np.stack([x, z], axis=2)) if len(at) else np.empty(0, dtype=object)


def _outline(agent, mirrors):
    """The outline at the origin, nose to -Z, in (x, z): a car's body, with mirrors if asked for, or a person's box."""
    wide, long = agent.width_m / 2, agent.length_m / 2
    body = shapely.box(-wide, -long, wide, long)
    if mirrors and agent.body and agent.kind not in _KINDS:
        body = shapely.union_all([body, *map(shapely.Polygon, CarSpec(agent.body, agent.paint).outlines())])
    return body


class _Building:
    """The pieces of all levels that an agent can touch, with the heights at which they begin and end."""

    def __init__(self, garage, gone):
        names, labels, grounds, lows, highs, hollow = [], [], [], [], [], []
        for level in garage.levels:
            floor_m = level.place.floor_m
            for solid in level.solids.between(UNDER_M, 1000.0):
                name = level.place.path_in_whole(solid.name)
                is_open = solid.label == "barrier" and solid.bottom_m > GATE_M
                if {name, solid.name} & gone or solid.label in HOLLOW | FLAT or is_open:
                    continue
                names.append(name)
                labels.append(solid.label)
                grounds.append(solid.footprint)
                lows.append(floor_m + solid.bottom_m)
                highs.append(floor_m + solid.top_m)
            hollow += [(thing, floor_m) for thing in level.things if thing.label in HOLLOW]
        self.names, self.labels = names, labels
        self.grounds = np.array(grounds, dtype=object)
        self.low, self.high = np.array(lows), np.array(highs)
        self.tree, self.hollow, self.cuts = shapely.STRtree(self.grounds), hollow, {}

    def section(self, height_m):
        """Names and lines of what is hollow, cut at a height."""
        if height_m not in self.cuts:
            cuts = [(thing.name, section_of(thing, height_m - floor_m)) for thing, floor_m in self.hollow]
            lines = [(name, shapely.LineString(cut)) for name, found in cuts for cut in found if len(cut) > 1]
            shapes = np.array([line for _, line in lines], dtype=object)
            self.cuts[height_m] = [name for name, _ in lines], shapes, shapely.STRtree(shapes)
        return self.cuts[height_m]


class _Found:
    """Clearances as they are found, joined to intervals by pair."""

    def __init__(self, own):
        self.own, self.least, self.pairs = own, {}, {}

    def add(self, kind, one, other, seconds, apart_m, area_m2):
        """Add clearances at times; arrays."""
        if not len(seconds):
            return
        is_own = frozenset((one, other)) in self.own
        at = int(np.argmin(apart_m))
        if not is_own and apart_m[at] < self.least.get(kind, (math.inf,))[0]:
            self.least[kind] = float(apart_m[at]), one, other, float(seconds[at])
        bad = (area_m2 > OVERLAP_M2) | ((apart_m < CLEAR_M) & (not is_own))
        if bad.any():
            seconds, apart_m, area_m2 = seconds[bad], apart_m[bad], area_m2[bad]
            at = int(np.argmax(area_m2)) if area_m2.any() else int(np.argmin(apart_m))
            new = Touch(kind, one, other, seconds.min(), seconds.max(), apart_m.min(), area_m2.max(), seconds[at])
            old = self.pairs.get((one, other))
            if old is not None:
                worse = new if (new.area_m2, -new.least_m) > (old.area_m2, -old.least_m) else old
                new = worse._replace(from_s=min(old.from_s, new.from_s), to_s=max(old.to_s, new.to_s))
            self.pairs[one, other] = new


def judge(tracks, garage, *, mirrors=False, own=()):
    """Judge tracks in a `BuiltGarage`.

    `own` holds pairs of names of a person and its own car, whose clearance does not count, though an overlap does.
    With `mirrors` the outlines of cars of the catalogue have mirrors.
    """
    steps = math.floor(tracks.duration_s * HZ + 1e-6) + 1
    moving = [_Moving(track, steps, mirrors) for track in tracks]
    moving = [agent for agent in moving if agent.last > agent.first]
    found = _Found({frozenset(pair) for pair in own})
    meetings = sum(_pair(one, other, found) for one, other in combinations(moving, 2))
    building = _Building(garage, {track.agent.prim for track in tracks if track.agent.prim})
    for agent in moving:
        _beside_building(agent, building, found)
    extremes, faults = _motion(tracks)
    bad = sorted(found.pairs.values(), key=lambda touch: touch.at_s)
    return Verdict(
        [touch for touch in bad if touch.area_m2 > OVERLAP_M2],
        [touch for touch in bad if touch.area_m2 <= OVERLAP_M2],
        found.least,
        meetings,
        extremes,
        faults,
    )


def _pair(one, other, found):
    """Find clearances of two agents; return how often they meet, if both are cars."""
    first, last = max(one.first, other.first), min(one.last, other.last)
    if last <= first:
        return 0
    own, others = slice(first - one.first, last - one.first), slice(first - other.first, last - other.first)
    far_m = np.hypot(one.x[own] - other.x[others], one.z[own] - other.z[others])
    is_level = np.abs(one.y[own] - other.y[others]) < STOREY_M
    near = np.flatnonzero((far_m < one.reach_m + other.reach_m + LOOK_M) & is_level)
    kind = "-".join(sorted((one.kind, other.kind)))
    if len(near):
        poses, back = np.unique(np.stack([one.pose[own][near], other.pose[others][near]]), axis=1, return_inverse=True)
        _measure(
            found, kind, one.name, other.name, one.outlines[poses[0]], other.outlines[poses[1]], first + near, back
        )
    if kind != "car-car":
        return 0
    meet = np.flatnonzero((far_m < NEAR_M) & is_level & one.moves[own] & other.moves[others])
    return int(len(meet) > 0) + int((np.diff(meet) > APART_S * HZ).sum())


def _measure(found, kind, one, other, grounds, others, steps, back):
    """Measure outlines pair by pair; `back` gives the pair of each step."""
    apart_m, area_m2 = shapely.distance(grounds, others), np.zeros(len(grounds))
    touching = np.flatnonzero(apart_m == 0)
    crossed = shapely.intersection(grounds[touching], others[touching])
    # lines, of which sections are, have no area: each that is crossed counts by its length
    are_lines = shapely.get_dimensions(others[touching]) == 1
    area_m2[touching] = np.where(are_lines, shapely.length(crossed), shapely.area(crossed))
    back = back.ravel()
    found.add(kind, one, other, steps / HZ, apart_m[back], area_m2[back])


def _beside_building(agent, building, found):
    """Find clearances of an agent to what stands in the building."""
    at = agent.firsts
    y, lean = agent.y[at], agent.agent.length_m / 2 * np.abs(np.sin(agent.pitch[at]))
    pose, piece = building.tree.query(agent.outlines, predicate="dwithin", distance=LOOK_M)
    reaches = (building.high[piece] > y[pose] + UNDER_M + lean[pose]) & (
        building.low[piece] < y[pose] + agent.agent.height_m - lean[pose]
    )
    for number, own in _by_thing(pose[reaches], piece[reaches]):
        label = building.labels[number]
        other = "car" if label in CAR_LABELS else "person" if label == "person" else "building"
        kind = f"{agent.kind}-building" if other == "building" else "-".join(sorted((agent.kind, other)))
        _beside_thing(agent, own, building.names[number], building.grounds[number], kind, found)
    heights = np.round((y + OVER_FLOOR_M) / SECTION_M) * SECTION_M
    for height in np.unique(heights).tolist():
        names, lines, tree = building.section(height)
        poses = np.flatnonzero(heights == height)
        pose, line = tree.query(agent.outlines[poses], predicate="dwithin", distance=LOOK_M)
        for number, own in _by_thing(poses[pose], line):
            _beside_thing(agent, own, names[number], lines[number], f"{agent.kind}-building", found)


def _by_thing(poses, things):
    for number in np.unique(things).tolist():
        yield number, poses[things == number]


def _beside_thing(agent, poses, name, ground, kind, found):
    steps = agent.first + agent.firsts[poses]
    grounds = np.full(len(poses), ground)
    _measure(found, kind, agent.name, name, agent.outlines[poses], grounds, steps, np.arange(len(poses)))


def _motion(tracks):
    """Extremes of motion by class from differences of samples, and samples that contradict themselves."""
    extremes, faults = defaultdict(dict), []
    for track in tracks:
        agent, time = track.agent, np.asarray(track.time_s)
        if not (np.diff(time) > 0).all():
            faults.append(f"{agent.name}: times do not ascend")
            continue
        off = np.abs(time / tracks.step_s - np.round(time / tracks.step_s)).max(initial=0.0)
        if off > 1e-6 or time[0] < 0 or time[-1] > tracks.duration_s + 1e-6:
            faults.append(f"{agent.name}: times are no steps within the tracks")
        seconds = np.diff(time)
        places = np.stack([track.x_m, track.y_m, track.z_m], axis=1)
        way = np.linalg.norm(np.diff(places, axis=0), axis=1)
        gaps = seconds > 1.5 * tracks.step_s
        if way[gaps].max(initial=0.0) > 1e-6:
            faults.append(f"{agent.name}: moves between samples that are further apart than a step")
        speed = way / seconds
        said = np.abs(track.speed_m_s)
        rate = np.abs(np.diff(track.speed_m_s)) / seconds
        yaw = np.abs(np.diff(track.yaw_rad)) / seconds
        values = {
            "speed": speed,
            "acceleration": rate,
            "yaw_rate": yaw,
            "speed_error": np.abs(speed - (said[1:] + said[:-1]) / 2),
        }
        if agent.kind not in _KINDS:
            # the rear axle does not slip sideways
            back = agent.rear_axle_m
            axle_x = track.x_m + back * np.sin(track.yaw_rad)
            axle_z = track.z_m + back * np.cos(track.yaw_rad)
            middle = (track.yaw_rad[1:] + track.yaw_rad[:-1]) / 2
            values["slip"] = np.abs(np.diff(axle_x) * np.cos(middle) - np.diff(axle_z) * np.sin(middle)) / seconds
            values["acceleration_across"] = speed * yaw
        for name, column in values.items():
            if len(column):
                at = int(np.argmax(column))
                old = extremes[str(agent.kind)].get(name, (-1.0,))
                if column[at] > old[0]:
                    extremes[str(agent.kind)][name] = float(column[at]), agent.name, float(time[at])
    return dict(extremes), faults


def main(stage, file):
    from garage2usd.as_built.garage import garage_of_file
    from garage2usd.maps.track_tables import read_tracks

    verdict = judge(read_tracks(file), garage_of_file(stage))
    for line in (*verdict.overlaps, *verdict.close, *verdict.faults):
        print(line)
    for kind, (apart_m, one, other, at) in sorted(verdict.least_m.items()):
        print(f"least clearance {kind}: {apart_m:.3f} m, {one} and {other} at {at:.2f} s")
    for kind, found in sorted(verdict.extremes.items()):
        print(f"most of a {kind}:", ", ".join(f"{name} {value:.3f}" for name, (value, *_) in found.items()))
    print(f"{verdict.meetings} meetings, {len(verdict.overlaps)} overlaps")
    return bool(verdict.overlaps or verdict.faults)


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
