"""Garages of several levels, judged on their meshes, by their drives, and by programs of others that read their maps.

PYTHONPATH=tests python -m support.level_batch --seeds 100 --workers 2 --log levels.jsonl

A garage that is refused by name, as no ramps find a place in it, is a line with the reason and not a complaint. The
programs that have to be compiled, esmini and libOpenDRIVE, are those that the variables GARAGE2USD_ESMINI and
GARAGE2USD_LIBOPENDRIVE name; without them they are left out.
"""

import os
import subprocess
import sys
from itertools import pairwise

import numpy as np

import garage2usd
from garage2usd.common.errors import ConfigError, GenerationError
from garage2usd.profiles import PROFILE_NAMES
from support import batch
from support.coil_judge import CoilJudge
from support.drive_judge import assert_driven_on, cars_drive_to_each_level
from support.esmini_player import ESMINI, played
from support.level_judge import (
    a_ray_down_each_stall_meets_one_floor,
    above,
    built_and_judged,
    columns_stand_above_one_another,
    findings_of,
    levels_keep_apart,
    stairs_lead_up_to_the_street,
)
from support.level_map_judge import LevelMapJudge
from support.map_judges import CLIENTS, asam_issues
from support.openscenario_checker import issues_of as openscenario_issues
from support.openscenario_reader import OpenScenario
from support.ramp_judge import a_car_drives_over, a_large_car_drives_over
from support.sign_judge import signs_are_right

LIBOPENDRIVE = os.environ.get("GARAGE2USD_LIBOPENDRIVE")
ASAM_SQUARES = 300
"""Of all levels together: ASAM's checker takes minutes for a larger garage."""
KINDS = "straight", "helix"


def settings_of(seed):
    """A configuration, drawn by its seed alone: profiles, numbers of levels and kinds of ramps take turns."""
    draw = np.random.default_rng([38, seed])
    kind, levels = KINDS[seed % 2], 2 + seed // 2 % 3
    large = {"straight": (10, 11), "helix": (10, 10)}[kind]
    rows, cols = (int(size + draw.integers(0, 4)) for size in large)
    return {
        "seed": seed,
        "profile": PROFILE_NAMES[seed // 6 % len(PROFILE_NAMES)],
        "site": {
            "height_cells": rows,
            "width_cells": cols,
            "rectangles": int(draw.integers(0, 3)),
            "obstacles": int(draw.integers(0, 3)),
        },
        "building": {"levels": levels, "ramps": kind, "storey_m": float(draw.choice([3.6, 3.75, 3.9]))},
        "plan": {"episodes": 60, "starts": 1, "aisles": str(draw.choice(["two-way", "mixed"]))},
        "parking": {"occupancy": round(float(draw.uniform(0.0, 0.2)), 2)},
        "bay": {"square_side_m": 8.1} if draw.random() < 0.7 else {"dimensioned": True},
    }


def judges_of(seed, folder):
    """Facts of a garage of several levels, and its judges."""
    settings = settings_of(seed)
    site, building = settings["site"], settings["building"]
    facts = {"profile": settings["profile"], **building}
    try:
        made, judge = built_and_judged(garage2usd.GarageConfig(**settings), folder / "garage.usdc")
    except (ConfigError, GenerationError) as error:
        return {**facts, "refused": str(error)}, {}
    config = made.garage.config
    facts |= {"stalls": len(judge.stall_ids), "found": findings_of(made)}
    road, lanelets = garage2usd.export(made.stage, [folder / f"garage.{suffix}" for suffix in ("xodr", "osm")])
    maps = LevelMapJudge(judge, config.building.storey_m, folder)
    judges = {
        "columns": lambda: columns_stand_above_one_another(judge, made.garage),
        "apart": lambda: levels_keep_apart(judge, config),
        "stairs": lambda: stairs_lead_up_to_the_street(judge),
        "floors": lambda: a_ray_down_each_stall_meets_one_floor(judge, config),
        "signs": lambda: signs_are_right(judge, config),
        "ramps": lambda: _ramps(judge, config),
        "drives": lambda: cars_drive_to_each_level(made.stage, judge),
        "carla": lambda: maps.of_carla(road),
        "sumo": lambda: maps.of_sumo(road),
        "lanelet2": lambda: maps.of_lanelet2(lanelets),
        "scenario": lambda: _scenario(made.stage, maps),
    }
    if LIBOPENDRIVE:
        judges["libopendrive"] = lambda: maps.of_libopendrive(road, LIBOPENDRIVE)
    if site["height_cells"] * site["width_cells"] * building["levels"] <= ASAM_SQUARES:
        judges["asam-qc-opendrive"] = lambda: asam_issues(road, folder)
    return facts, judges


def _ramps(judge, config):
    walls = CoilJudge(judge)
    ramps = judge.ramps()
    assert len(ramps) == 2 * (config.building.levels - 1)
    for ramp in ramps:
        if config.building.ramps == "helix":
            a_large_car_drives_over(ramp, walls, config)
        else:
            a_car_drives_over(ramp, judge, config)


def _scenario(stage, maps):
    """From the street to the lowest level and back, as written, as newton's rays meet it and as esmini drives it."""
    (path, *_) = garage2usd.export(stage, [stage.with_suffix(".xosc")])
    yield from openscenario_issues(path, maps.folder)
    track = OpenScenario(path).track()
    _drives(track[:, 1:4], maps)
    if ESMINI:
        rows, collisions = played(ESMINI, path, track[-1, 0])
        yield from collisions
        _drives(rows[:, 1:4], maps)
        assert np.abs(rows[-1, 1:4] - track[-1, 1:4]).max() < 1e-3
    yield from _newton(stage, maps, np.stack([track[:, 1], track[:, 3], -track[:, 2]], axis=1))


def _drives(places, maps):
    """Places (x, y, height) on the floors and ramps, from above and back there by way of the lowest level."""
    assert_driven_on(maps.ground, np.stack([places[:, 0], places[:, 2], -places[:, 1]], axis=1), maps.floors_m)
    assert abs(places[:, 2].min() - maps.floors_m[-1]) < 1e-4
    assert places[[0, -1], 2].min() > 2.5


def _newton(stage, maps, places):
    """Newton's rays down meet the ramps between levels where the car drives."""
    rays, output = maps.folder / "rays.npz", maps.folder / "far.npy"
    for (upper_m, lower_m), name in zip(pairwise(maps.floors_m), maps.judge.names[1:], strict=True):
        on_ramp = places[(places[:, 1] > lower_m + 0.05) & (places[:, 1] < upper_m - 0.05)]
        eyes = above(on_ramp, 1.0)
        np.savez(rays, origins=eyes, directions=np.tile([0.0, -1.0, 0.0], (len(eyes), 1)))
        command = [sys.executable, CLIENTS / "newton_rays.py", stage, f"/Garage/Levels/{name}/Ramps", rays, output]
        subprocess.run([str(word) for word in command], check=True, capture_output=True)
        deep = np.load(output) - 1.0
        if np.median(np.abs(deep)) > 1e-5 or deep.min() < -1e-3 or (deep > 1e-3).mean() > 0.25:
            yield f"newton's floor is {deep.min():.4f} to {deep.max():.4f} m lower on the ramps of {name}"


if __name__ == "__main__":
    raise SystemExit(batch.main(judges_of, __doc__))
