"""Maps and scenarios of many garages, judged by programs of others.

PYTHONPATH=tests python -m support.map_batch --seeds 500 --log maps.jsonl

builds garages of mixed sizes and settings, exports each to every format and lets ASAM's checkers, CARLA, SUMO, Lanelet2
and the standard's equations judge what came out. Each garage is one line of the log; a second run goes on where the
first one ended. Ends in 1 if a judge has a complaint.
"""

import argparse
import json
import tempfile
import time
from concurrent.futures import ProcessPoolExecutor, as_completed
from pathlib import Path

import numpy as np

import garage2usd
from support.lanelet2_judge import Lanelet2Judge
from support.map_judges import asam_issues
from support.opendrive_judge import MapJudge
from support.openscenario_checker import issues_of as openscenario_issues

SIZES = [(5, 5), (6, 8), (7, 9), (7, 9), (9, 12), (12, 16), (12, 16), (16, 20), (20, 30)]
SHARES = [0.12, 0.16, 0.22, 0.16, 0.12, 0.1, 0.08, 0.03, 0.01]


def settings_of(seed):
    """A configuration, drawn by its seed alone."""
    draw = np.random.default_rng([16, seed])
    rows, cols = SIZES[draw.choice(len(SIZES), p=SHARES)]
    is_large = rows * cols >= 150
    portals = 1 + int(is_large and draw.random() < 0.4)
    dimensioned = bool(draw.random() < 0.7)
    return {
        "seed": seed,
        "profile": str(draw.choice(["cn-jgj100", "de-garvo", "us-ada", "uk-istructe"], p=[0.7, 0.1, 0.1, 0.1])),
        "site": {
            "height_cells": rows,
            "width_cells": cols,
            "rectangles": int(draw.integers(0, 4)) if is_large else 0,
            "obstacles": int(draw.integers(0, 4)) if is_large else 0,
            "entrances": portals,
            "exits": portals,
        },
        "plan": {"circulation": str(draw.choice(["loops", "allow"], p=[0.8, 0.2]))},
        "bay": {"dimensioned": dimensioned},
        "parking": {"occupancy": round(float(draw.uniform(0.0, 0.95)), 2), "ev_share": 0.1, "accessible_share": 0.05},
        "stage": {"texture_quality": "low"},
        "maps": {
            "latitude_deg": round(float(draw.uniform(-60, 70)), 3),
            "longitude_deg": round(float(draw.uniform(-179, 179)), 3),
        },
    }


def judged(seed):
    """What is said of one garage: its size, seconds, and complaints by judge."""
    start, settings = time.perf_counter(), settings_of(seed)
    site = settings["site"]
    found = {"seed": seed, "rows": site["height_cells"], "cols": site["width_cells"], "complaints": {}}
    with tempfile.TemporaryDirectory() as folder:
        place = Path(folder)
        try:
            config = garage2usd.GarageConfig(**settings)
            built = garage2usd.build(config, place / "garage.usdc")
            found["stalls"] = len(built.garage.layout.stalls)
            outputs = [place / f"garage.{suffix}" for suffix in ("xodr", "osm", "xosc")]
            path, lanelets, scenario = garage2usd.export(built.stage, outputs, settings=config.maps)
            origin = config.maps.latitude_deg, config.maps.longitude_deg
            judge = MapJudge(built.stage, path, place)
            judges = {
                "asam-qc-opendrive": lambda: asam_issues(path, place),
                "asam-qc-openscenarioxml": lambda: openscenario_issues(scenario, place),
                "carla": judge.of_carla,
                "sumo": judge.of_sumo,
                "equations": judge.of_objects,
                "lanelet2": Lanelet2Judge(built.stage, lanelets, place, origin=origin).complaints,
            }
            for name, complaints in judges.items():
                found["complaints"][name] = list(complaints())
        except Exception as error:  # noqa: BLE001 - a garage that fails is a line of the log, not the end of the run
            found["complaints"]["failure"] = [f"{type(error).__name__}: {error}"[:500]]
    return {**found, "seconds": round(time.perf_counter() - start, 1)}


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--seeds", type=int, default=500)
    parser.add_argument("--workers", type=int, default=1)
    parser.add_argument("--log", type=Path, required=True)
    asked = parser.parse_args()
    lines = [json.loads(line) for line in asked.log.read_text().splitlines()] if asked.log.exists() else []
    done = {line["seed"] for line in lines}
    with ProcessPoolExecutor(asked.workers) as pool, asked.log.open("a") as log:
        runs = [pool.submit(judged, seed) for seed in range(asked.seeds) if seed not in done]
        for run in as_completed(runs):
            lines.append(run.result())
            log.write(json.dumps(lines[-1]) + "\n")
            log.flush()
    bad = [line for line in lines if any(line["complaints"].values())]
    for line in bad:
        print(line["seed"], {name: said[:3] for name, said in line["complaints"].items() if said})
    print(
        f"{len(lines)} garages with {sum(line.get('stalls', 0) for line in lines)} stalls, {len(bad)} with a complaint"
    )
    return int(bool(bad))


if __name__ == "__main__":
    raise SystemExit(main())
