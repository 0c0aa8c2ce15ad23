"""Where people and things of many garages stand: a judge that shares nothing with their placement but the meshes.

PYTHONPATH=tests python -m support.clutter_judge --seeds 200

lays out garages of mixed profiles, contours, obstacles and occupancies, and compares by shapely the outlines of meshes
with cars, walls, doors, lanes, stalls, floors and the ground that cars sweep on their proven ways. Ends in 1 if
anything stands where it must not.
"""

import argparse
import math
import sys
from collections import Counter
from concurrent.futures import ProcessPoolExecutor
from dataclasses import astuple, replace
from functools import lru_cache

import numpy as np
import shapely
from shapely import affinity

from garage2usd.checks.swept_path import design_car
from garage2usd.common.errors import Garage2UsdError
from garage2usd.config import GarageConfig
from garage2usd.driving import DesignCar
from garage2usd.driving.layout_garage import prove_stalls
from garage2usd.layout import ObjectTable
from garage2usd.objects.car import CarSpec, OpenCarSpec
from garage2usd.pipeline import generate
from garage2usd.stage.prototypes import asset_of
from garage2usd.structure.grid import Cell

PROFILES = ("cn-jgj100", "de-garvo", "us-ada", "uk-istructe")
FLAT = {"floor", "stall", "ceiling", "sky", "floor_stain", "drain", "stall_number", "number_plate"}
PERSON_M = 2.0
"""What hangs higher is in nobody's way."""
CAR_PATH_M = 1.8
"""Width of a car on the middle of a lane."""
LEAF_M, ENTERED_M = 1.0, 3.0
"""Width of the door of a stair core; ground behind the door of an entrance or an exit."""
STEP_M = 0.05
TOUCH_M = 1e-4
"""Of pieces that only meet."""


def settings_of(seed):
    """A configuration, drawn by its seed alone."""
    draw = np.random.default_rng([35, seed])
    return {
        "seed": seed,
        "profile": PROFILES[seed % len(PROFILES)],
        "site": {
            "height_cells": int(draw.integers(4, 8)),
            "width_cells": int(draw.integers(5, 8)),
            "rectangles": int(draw.integers(2, 5)) if seed % 3 else 0,
            "obstacles": seed % 2,
            "min_portal_distance_cells": 3,
        },
        "plan": {"unreachable_stalls": "mark"},
        "parking": {
            "occupancy": round(float(draw.uniform(0.1, 0.95)), 2),
            "misparked": (0.0, 0.05)[seed // 2 % 2],
            "turned_wheels": 0.2,
        },
        "clutter": {"amount": ("usual", "crowded")[seed // 4 % 2]},
    }


def faults_of(garage):
    """What stands where it must not, as (kind, name, what it meets)."""
    layout = garage.layout
    clutter = [place for place in layout.placements if place.spec.kind.group == "Clutter"]
    shapes = [shapely.union_all([shape for shape, _ in pieces(place)]).convex_hull for place in clutter]
    taken = [*objects(layout), *grounds(garage)]
    grown = np.array([shape.buffer(-TOUCH_M) for shape in shapes], dtype=object)
    found = [
        (clutter[one].kind, clutter[one].name, taken[other][1])
        for one, other in shapely.STRtree([shape for shape, _, _ in taken]).query(grown, predicate="intersects").T
    ]
    one, other = shapely.STRtree(grown).query(grown, predicate="intersects")
    found += [(clutter[i].kind, clutter[i].name, clutter[j].name) for i, j in zip(one, other, strict=True) if i < j]
    found += boots_in_the_way(layout, taken)
    inside = floors(layout)
    for place, shape in zip(clutter, shapes, strict=True):
        low = min(float(part.points[:, 1].min()) for part in asset_of(place.spec).parts)
        if place.position_m[1] or not -0.001 < low < 0.003:
            found.append((place.kind, place.name, f"the floor, {place.position_m[1] + low} m below it"))
        if not inside.contains(shape):
            found.append((place.kind, place.name, "the edge of the floor"))
    return sorted(set(found)), clutter


def objects(layout):
    """Each piece of an object, as high as people are, seen from above, with its name and the stall that it is of."""
    for place in layout.placements:
        if place.spec.kind.group != "Clutter" and place.kind not in FLAT:
            for shape, low in pieces(place):
                if place.position_m[1] + low < PERSON_M:
                    yield shape, place.name, place.stall


def boots_in_the_way(layout, taken):
    """What an open boot meets that is not of the stall where its car stands."""
    tree = shapely.STRtree([shape for shape, _, _ in taken])
    for place in layout.placements:
        if isinstance(place.spec, OpenCarSpec):
            parts = [part for part in asset_of(place.spec).parts if part.name.startswith("Boot")]
            points = np.concatenate([part.points[:, [0, 2]] for part in parts]).astype(float)
            boot = placed_at(shapely.MultiPoint(points).convex_hull, place).buffer(-TOUCH_M)
            for other in tree.query(boot, predicate="intersects").tolist():
                if taken[other][2] != place.stall:
                    yield "car", f"the boot of {place.name} in {place.stall}", taken[other][1]


def pieces(place):
    """The convex hull of each mesh of an object seen from above, and how low it reaches, by shapely's own turns."""
    return ((placed_at(shape, place), low) for shape, low in _hulls(place.spec.shape))


def placed_at(shape, place):
    """A shape on the floor where an object's origin is."""
    x, _, z = place.position_m
    return affinity.translate(affinity.rotate(shape, -math.degrees(place.yaw_rad), origin=(0, 0)), x, z)


@lru_cache(maxsize=4096)
def _hulls(spec):
    parts = [part for part in asset_of(spec).parts if len(part.points)]
    return [
        (shapely.MultiPoint(part.points[:, [0, 2]].astype(float)).convex_hull, float(part.points[:, 1].min()))
        for part in parts
    ]


def floors(layout):
    """The squares inside that are no obstacles, by the matrices."""
    structure = layout.structure
    x, z = structure.column_edges_m, structure.row_edges_m
    squares = np.argwhere(structure.cells != Cell.OBSTACLE).tolist()
    return shapely.union_all([shapely.box(x[col], z[row], x[col + 1], z[row + 1]) for row, col in squares])


def grounds(garage):
    """The ground that is somebody's: stalls, doors and what they swing over, lanes, what cars sweep on their ways."""
    layout = garage.layout
    yield from ((shapely.Polygon(stall.corners_m()), stall.name, stall.name) for stall in layout.stalls)
    for core in layout.cores:
        yield swing(core), f"the door of a core on {core.square}", None
    yield from entered(layout)
    yield from driven_lines(garage.graph)
    for car in dict.fromkeys((DesignCar(), design_car(garage.config.standard))):
        for proof in prove_stalls(without_clutter(layout), car=car):
            for way in (proof.way_in, proof.way_out):
                if way is not None and way.moves:
                    yield from ((shape, f"a way of {proof.stall}", proof.stall) for shape in swept(way, car))


def without_clutter(layout):
    """The layout with closed boots and without people and things, on which ways are proven that these keep clear."""
    kept = [place for place in layout.placements if place.spec.kind.group != "Clutter"]
    closed = [
        replace(place, spec=CarSpec(*astuple(place.spec))) if isinstance(place.spec, OpenCarSpec) else place
        for place in kept
    ]
    return replace(layout, placements=ObjectTable([closed]))


def swing(core):
    """The quarter disc of its door, hung on either side."""
    x, z = core.door_m
    out = np.array((x - core.centre_m[0], z - core.centre_m[1]))
    out /= np.hypot(*out)
    along = np.array((-out[1], out[0]))
    door = np.array((x, z))
    before = shapely.Polygon([door - along, door + along, door + along + LEAF_M * out, door - along + LEAF_M * out])
    discs = [shapely.Point(door + side * LEAF_M / 2 * along).buffer(LEAF_M) for side in (-1, 1)]
    return shapely.union_all(discs).intersection(before)


def entered(layout):
    """The ground behind each vehicle door, as wide as it."""
    for place in layout.placements:
        if place.kind == "portal":
            half = place.spec.door_width_m / 2
            corners = map(place.to_world, ((-half, 0.0), (half, 0.0), (half, ENTERED_M), (-half, ENTERED_M)))
            yield shapely.Polygon(corners), f"the door {place.name}", None


def driven_lines(graph):
    """A car's width along the middle of each lane from square to square."""
    for edge in graph.lanes.edges:
        line = shapely.LineString(graph.lanes.positions_m[[edge.start, edge.end]])
        yield line.buffer(CAR_PATH_M / 2, cap_style="flat"), f"the lane from {edge.start} to {edge.end}", None


def swept(way, car):
    """What a car covers at poses a hand's breadth apart, by complex numbers that turn it."""
    poses = np.array([(at.pose.x_m, at.pose.z_m, at.pose.yaw_rad) for at in way.waypoints(STEP_M)])
    half = car.width_m / 2
    body = np.array(
        (
            -half - 1j * car.ahead_m,
            half - 1j * car.ahead_m,
            half + 1j * car.rear_overhang_m,
            -half + 1j * car.rear_overhang_m,
        )
    )
    turned = body * np.exp(-1j * poses[:, 2:]) + poses[:, :1] + 1j * poses[:, 1:2]
    return shapely.polygons(np.stack([turned.real, turned.imag], axis=2))


def judged(seed):
    """What is said of one garage: number of stalls, what stands there, and what stands where it must not."""
    settings = settings_of(seed)
    try:
        garage = generate(GarageConfig(**settings))
    except Garage2UsdError as error:
        return seed, 0, Counter(), [("none", "garage", f"{type(error).__name__}: {error}")]
    faults, clutter = faults_of(garage)
    kinds = Counter(place.kind for place in clutter)
    kinds["open boot"] = sum(isinstance(place.spec, OpenCarSpec) for place in garage.layout.placements)
    return seed, len(garage.layout.stalls), kinds, faults


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--seeds", type=int, default=200)
    parser.add_argument("--first", type=int, default=0)
    parser.add_argument("--workers", type=int, default=1)
    asked = parser.parse_args()
    stalls, kinds, bad = 0, Counter(), 0
    with ProcessPoolExecutor(asked.workers) as pool:
        for seed, count, found, faults in pool.map(judged, range(asked.first, asked.first + asked.seeds)):
            stalls, bad = stalls + count, bad + bool(faults)
            if seed % 20 == 0:
                print(f"{seed}: {stalls} stalls and {kinds.total()} objects so far", flush=True)
            kinds += found
            for kind, name, what in faults:
                print(f"{seed}: {name} ({kind}) meets {what}", flush=True)
    told = ", ".join(f"{number} {kind}" for kind, number in sorted(kinds.items()))
    print(f"{asked.seeds} garages, {stalls} stalls, {kinds.total()} objects ({told}); {bad} garages with faults")
    sys.exit(bool(bad))


if __name__ == "__main__":
    main()
