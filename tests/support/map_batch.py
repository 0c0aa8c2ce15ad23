"""Maps and scenarios of many garages, judged by programs of others.

PYTHONPATH=tests python -m support.map_batch --seeds 500 --log maps.jsonl

builds garages of mixed sizes and settings, exports each to every format and lets ASAM's checkers, CARLA, SUMO, Lanelet2
and the standard's equations judge what came out. Each garage is one line of the log; a second run goes on where the
first one ended. Ends in 1 if a judge has a complaint.
"""

import numpy as np

import garage2usd
from support import batch
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


def judges_of(seed, folder):
    """The size of a garage, and the judges of its maps."""
    settings = settings_of(seed)
    config = garage2usd.GarageConfig(**settings)
    built = garage2usd.build(config, folder / "garage.usdc")
    outputs = [folder / f"garage.{suffix}" for suffix in ("xodr", "osm", "xosc")]
    path, lanelets, scenario = garage2usd.export(built.stage, outputs, settings=config.maps)
    origin = config.maps.latitude_deg, config.maps.longitude_deg
    judge = MapJudge(built.stage, path, folder)
    facts = {
        "rows": config.site.height_cells,
        "cols": config.site.width_cells,
        "stalls": len(built.garage.layout.stalls),
    }
    return facts, {
        "asam-qc-opendrive": lambda: asam_issues(path, folder),
        "asam-qc-openscenarioxml": lambda: openscenario_issues(scenario, folder),
        "carla": judge.of_carla,
        "sumo": judge.of_sumo,
        "equations": judge.of_objects,
        "lanelet2": Lanelet2Judge(built.stage, lanelets, folder, origin=origin).complaints,
    }


if __name__ == "__main__":
    raise SystemExit(batch.main(judges_of, __doc__))
