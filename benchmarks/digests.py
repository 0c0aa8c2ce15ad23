"""Digests of fifty garages in every format, by which a change of structure is held to the same bytes.

``python benchmarks/digests.py --write`` stores them in ``digests.json``; without it each garage is compared with that
file, and the exit code is 1 where one differs. Names choose garages: ``python benchmarks/digests.py plain_1 wide``.
``--file`` names another file, such as one written on another machine; then ``--portable`` leaves out what differs
there. A configuration file such as ``samples/looks.toml`` is taken as well as a name.
"""

import argparse
import hashlib
import json
import sys
import tempfile
import tomllib
from collections.abc import Iterator, Mapping
from dataclasses import asdict
from pathlib import Path
from typing import Any

import numpy as np

from garage2usd.as_built.stage_reader import garage_of_stage
from garage2usd.checks import as_json, check_file
from garage2usd.common.errors import Garage2UsdError
from garage2usd.config import config_from_mapping
from garage2usd.config.maps import GridConfig, MapsConfig
from garage2usd.datasets.difficulty import stall_difficulties
from garage2usd.driving import prove_stalls
from garage2usd.exports import export
from garage2usd.layout import Layout
from garage2usd.maps.drives import DrivePlanner
from garage2usd.pipeline import build
from garage2usd.reading.content import stage_digest
from garage2usd.reading.files import open_stage
from garage2usd.sensors.slots import read_slots
from garage2usd.view.plan_picture import draw_plan
from garage2usd.view.svg import to_svg

STORED = Path(__file__).with_suffix(".json")
QUICK = ("plain_1", "angled_contour_2", "given_loop", "two_portals_3", "uk_1", "no_ramps", "misparked", "uniform")
"""Eight of them, which touch most of the road."""

_PROFILES = ("cn-jgj100", "de-garvo", "uk-istructe", "us-ada")
_OF_MACHINE = {"stage", "xosc"}
"""OpenUSD writes other bytes on other machines, and OpenSCENARIO's package has no wheel for all."""
_LOOP = "......\n.====E\n.=..=.\n.=..=.\n.====X\n......"
_SMALL = "....\nE==X\n...."
_DEAD_END = "......\nE====X\n..=...\n..=...\n......"


def _site(size: int = 6, **more: object) -> dict[str, Any]:
    return {"site": {"width_cells": size, "height_cells": size, **more}}


def configurations() -> Iterator[tuple[str, dict[str, Any]]]:
    """Name and settings of each garage."""
    for seed in range(1, 7):
        yield f"plain_{seed}", _site(5 + seed % 3) | {"seed": seed}
    for seed in range(1, 7):
        yield f"angled_contour_{seed}", _site(8, rectangles=3, min_fill=0.5) | {"seed": seed}
    for seed in range(1, 7):
        yield f"two_portals_{seed}", _site(8, entrances=2, exits=2) | {"seed": seed}
    for name in _PROFILES:
        for seed in (1, 2):
            yield f"{name[:2]}_{seed}", _site(6 + seed % 2) | {"seed": seed, "profile": name}
    for name, drawing in (("small", _SMALL), ("loop", _LOOP), ("dead_end", _DEAD_END)):
        for dimensioned in (True, False):
            settings = {"site": {"structure": drawing}, "bay": {"dimensioned": dimensioned}}
            yield f"given_{name}{'' if dimensioned else '_uniform'}", settings | {"seed": 3}
    options: Mapping[str, dict[str, Any]] = {
        "no_ramps": {"fittings": {"ramps": False}},
        "no_barriers": {"fittings": {"barriers": False, "beams": False, "ducts": False}},
        "misparked": {"parking": {"misparked": 0.3, "over_line": 0.2}},
        "empty": {"parking": {"occupancy": 0.0}},
        "full": {"parking": {"occupancy": 1.0, "ev_share": 0.5}},
        "cluttered": {"clutter": {"amount": "usual"}},
        "accessible": {"parking": {"accessible_share": 0.2}},
        "drawn_look": {"look": {"drawn": True}},
        "uniform": {"bay": {"dimensioned": False}},
        "wide": {"bay": {"aisle_width_m": 7.0, "stall_width_m": 2.6}},
        "short": {"bay": {"stall_length_m": 4.8, "column_size_m": 0.4}},
        "paper": {"plan": {"preset": "paper", "episodes": 300}},
        "no_dead_ends": {"plan": {"dead_ends": "forbid"}},
        "marked": {"plan": {"unreachable_stalls": "mark"}, "bay": {"aisle_width_m": 5.0}},
        "nested": {"stage": {"form": "nested"}},
        "narrow": {"bay": {"aisle_width_m": 5.0}},
        "cores": {"fittings": {"stair_cores": False}},
        "pairs": {"fittings": {"wheel_stops": "pairs", "speed_bump_rate": 1.0, "cone_rate": 0.2}},
    }
    for seed, (name, settings) in enumerate(options.items(), 40):
        yield name, _site(7, obstacles=1) | settings | {"seed": seed}


def digests_of(settings: Mapping[str, Any]) -> dict[str, str]:
    """Digest of each thing that a garage is written as; the words of the refusal where there is none."""
    config = config_from_mapping({"stage": {"texture_quality": "low"}} | dict(settings))
    found: dict[str, str] = {}
    with tempfile.TemporaryDirectory() as place:
        folder = Path(place)
        try:
            built = build(config, folder / "garage.usdc")
        except Garage2UsdError as error:
            return {"refused": _digest(str(error))}
        garage = built.garage
        structure = garage.plan.structure
        found["plan"] = _digest([str(structure), structure.column_widths_mm.tolist(), structure.row_depths_mm.tolist()])
        found["layout"] = layout_digest(garage.layout)
        found["svg"] = _digest(to_svg(draw_plan(garage.layout)))
        report = json.loads(built.report.read_text())
        del report["seconds"]
        found["report"] = _digest(report)
        layers = sorted(path for path in folder.rglob("*") if path.is_file() and path.suffix in {".usda", ".usdc"})
        found["stage"] = _digest([hashlib.sha256(path.read_bytes()).hexdigest() for path in layers])
        found["content"] = stage_digest(built.stage, digits=16)
        found["labels"] = _digest(built.labels.read_text())
        maps = MapsConfig(grid=GridConfig(resolution_m=0.1, keepout=True, speed=True))
        for suffix in (".glb", ".xodr", ".osm", ".yaml", ".xosc"):
            try:
                files = export(built.stage, [folder / f"out{suffix}"], settings=maps)
            except Garage2UsdError as error:
                found[suffix[1:]] = _digest(str(error).replace(place, ""))
            else:
                found[suffix[1:]] = _digest([hashlib.sha256(path.read_bytes()).hexdigest() for path in files])
        for name, path in (("check_stage", built.stage), ("check_report", built.report)):
            found[name] = _digest(as_json(check_file(path)[0]))
        slots = read_slots(open_stage(built.stage)).slots
        found["slots"] = _digest([_plain(slot.facts | {"at": slot.corners_m}) for slot in slots])
        proofs = prove_stalls(garage.layout)
        found["proofs"] = _digest([repr(proof) for proof in proofs])
        found["difficulty"] = _digest([_plain(asdict(each)) for each in stall_difficulties(garage, proofs=proofs)])
        found["drive"] = _digest(_drive(built.stage))
    return found


def layout_digest(layout: Layout) -> str:
    """Digest of the stalls and the objects of a layout, whatever their classes are called."""
    return _digest([repr(each).partition("(")[2] for each in (*layout.stalls, *layout.placements)])


def _drive(stage: Path) -> dict[str, Any]:
    """The states of a drive to the first stall of a stage, or why there is none."""
    try:
        drive = DrivePlanner(garage_of_stage(open_stage(stage), source="")).drive()
    except Garage2UsdError as error:
        return {"refused": str(error)}
    return {**drive.facts, "columns": drive.trajectory.columns()}


def _plain(value: Any) -> Any:  # noqa: ANN401 - whatever a record holds
    if isinstance(value, np.ndarray):
        return value.tolist()
    if isinstance(value, Mapping):
        return {str(key): _plain(each) for key, each in value.items()}
    return value


def _digest(value: object) -> str:
    text = value if isinstance(value, str) else json.dumps(value, sort_keys=True, default=str)
    return hashlib.sha256(text.encode()).hexdigest()[:16]


def main() -> int:
    """Compare or store the digests of some garages."""
    parser = argparse.ArgumentParser(description=__doc__.split("\n", maxsplit=1)[0])
    parser.add_argument("names", nargs="*", help="which garages; left out, all")
    parser.add_argument("--quick", action="store_true", help="the eight that touch most of the road")
    parser.add_argument("--write", action="store_true", help="store what is found")
    parser.add_argument("--portable", action="store_true", help="leave out bytes of .usdc and OpenSCENARIO")
    parser.add_argument("--file", type=Path, default=STORED, help="the file to compare with or to write")
    asked = parser.parse_args()
    wanted = {*asked.names} or ({*QUICK} if asked.quick else None)
    stored = json.loads(asked.file.read_text()) if asked.file.exists() else {}
    differ = 0
    files = [Path(name) for name in asked.names if name.endswith(".toml")]
    given = [(path.stem, tomllib.loads(path.read_text(encoding="utf-8"))) for path in files]
    wanted = wanted and wanted | {name for name, _ in given}
    for name, settings in (*configurations(), *given):
        if wanted is not None and name not in wanted:
            continue
        found = {
            key: each for key, each in digests_of(settings).items() if not asked.portable or key not in _OF_MACHINE
        }
        if asked.write:
            stored[name] = found
            asked.file.write_text(json.dumps(stored, indent=1, sort_keys=True) + "\n")
            print(name, len(found), flush=True)
            continue
        known = stored.get(name, {})
        changed = sorted(key for key in {*known, *found} if known.get(key) != found.get(key))
        differ += bool(changed)
        print(f"{name}: {', '.join(changed) or 'same'}", flush=True)
    return min(differ, 1)


if __name__ == "__main__":
    sys.exit(main())
