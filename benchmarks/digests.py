"""Digests of sixty garages in every format, by which a change of structure is held to the same bytes.

Fifty have one level, six several levels, and four are imported from layouts of others.

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
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import asdict
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

from garage2usd.as_built import BuiltGarage
from garage2usd.as_built.proofs import prove_built
from garage2usd.checks import as_json
from garage2usd.common.errors import Garage2UsdError
from garage2usd.config import config_from_mapping
from garage2usd.config.outputs import GridConfig, MapsConfig
from garage2usd.datasets.difficulty import stall_difficulties
from garage2usd.driving import prove_stalls
from garage2usd.exports import export
from garage2usd.garage_model import GarageLevel
from garage2usd.garage_sources import read_built
from garage2usd.imports import import_layout
from garage2usd.layout import Layout
from garage2usd.maps.drives import DrivePlanner
from garage2usd.pipeline import build
from garage2usd.reading.files import open_stage, stage_digest
from garage2usd.sensors.slots import read_slots
from garage2usd.view.drawing import to_svg
from garage2usd.view.plan_picture import draw_plan

STORED = Path(__file__).with_suffix(".json")
SAMPLES = Path(__file__).parents[1] / "samples"
QUICK = (
    "plain_1",
    "angled_contour_2",
    "given_loop",
    "two_portals_3",
    "uk_1",
    "no_ramps",
    "misparked",
    "uniform",
    "levels_2_straight",
    "import_rows",
)
"""Ten of them, which touch most of the road."""
OF_MACHINE = {"stage", "xosc"}
"""OpenUSD writes other bytes on other machines, and OpenSCENARIO's package has no wheel for all."""

_PROFILES = ("cn-jgj100", "de-garvo", "uk-istructe", "us-ada")
_ROWS = """
outline = [[0, 0], [40, 0], [40, 18.2], [0, 18.2]]
lanes = [{points = [[0, 8.8], [40, 8.8]], width_m = 6}]
portals = [{at = [0, 8.8], kind = "entrance"}, {at = [40, 8.8], kind = "exit"}]
[[runs]]
first = [6, 5.8]
last = [33.5, 5.8]
side = "left"
count = 11
length_m = 5.3
"""
_SURVEYS = {
    "rows": _ROWS,
    "turned": _ROWS.replace("[0, 0], [40, 0], [40, 18.2], [0, 18.2]", "[0, 0], [40, 0], [36, 18.2], [0, 18.2]"),
    "charged": _ROWS + 'number = 12\nuse = "ev"\n',
}
"""Layouts of others, as drawings in metres."""
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
    yield from _others()


def _others() -> Iterator[tuple[str, dict[str, Any]]]:
    """Name and settings of garages of several levels, and of layouts of others."""
    for levels, link in ((2, "straight"), (3, "straight"), (2, "helix"), (3, "helix")):
        building = {"levels": levels, "ramps": link}
        yield f"levels_{levels}_{link}", _site(10) | {"seed": levels, "building": building}
    for name in ("two_levels", "three_levels"):
        yield name, tomllib.loads((SAMPLES / f"{name}.toml").read_text(encoding="utf-8"))
    yield "import_lot", {"survey": SAMPLES / "surveys/lot.toml"}
    for name, drawn in _SURVEYS.items():
        yield f"import_{name}", {"survey": drawn}


class _Made(NamedTuple):
    """A garage that was made: its files, the layout of each level, and the levels of one that was planned."""

    stage: Path
    report: Path
    labels: Path
    layouts: Sequence[Layout]
    planned: Sequence[GarageLevel] = ()


def _made(settings: Mapping[str, Any], folder: Path) -> _Made:
    """Build or import a garage."""
    place, low = folder / "garage.usdc", {"stage": {"texture_quality": "low"}}
    if "survey" in settings:
        source = settings["survey"]
        if isinstance(source, str):
            source = folder / "drawing.toml"
            source.write_text(settings["survey"])
        imported = import_layout(source, place, config=config_from_mapping(low))
        return _Made(imported.stage, imported.report, imported.labels, [imported.garage.layout])
    config = config_from_mapping(low | dict(settings))
    built = build(config, place)
    levels = built.garage.levels
    return _Made(built.stage, built.report, built.labels, [level.layout for level in levels], levels)


def digests_of(settings: Mapping[str, Any]) -> dict[str, str]:
    """Digest of each thing that a garage is written as; the words of the refusal where there is none."""
    found: dict[str, str] = {}
    with tempfile.TemporaryDirectory() as place:
        folder = Path(place)
        try:
            made = _made(settings, folder)
        except Garage2UsdError as error:
            return {"refused": _digest(str(error).replace(place, ""))}
        structures = [garage.plan.structure for garage in made.planned]
        found["plan"] = _digest(
            [[str(each), each.column_widths_mm.tolist(), each.row_depths_mm.tolist()] for each in structures]
        )
        found["layout"] = _digest([layout_digest(layout) for layout in made.layouts])
        found["svg"] = _digest([to_svg(draw_plan(layout)) for layout in made.layouts])
        report = json.loads(made.report.read_text())
        _forget(report, place)
        found["report"] = _digest(report)
        layers = sorted(path for path in folder.rglob("*") if path.is_file() and path.suffix in {".usda", ".usdc"})
        found["stage"] = _digest([hashlib.sha256(path.read_bytes()).hexdigest() for path in layers])
        found["content"] = stage_digest(made.stage, digits=16)
        found["labels"] = _digest(made.labels.read_text())
        maps = MapsConfig(grid=GridConfig(resolution_m=0.1, keepout=True, speed=True))
        for suffix in (".glb", ".xodr", ".osm", ".yaml", ".xosc"):
            try:
                files = export(made.stage, [folder / f"out{suffix}"], settings=maps)
            except Garage2UsdError as error:
                found[suffix[1:]] = _digest(str(error).replace(place, ""))
            else:
                found[suffix[1:]] = _digest([hashlib.sha256(path.read_bytes()).hexdigest() for path in files])
        for name, path in (("check_stage", made.stage), ("check_report", made.report)):
            try:
                found[name] = _digest(as_json(read_built(path).findings()))
            except Garage2UsdError as error:
                found[name] = _digest(str(error).replace(place, ""))
        slots = read_slots(open_stage(made.stage)).slots
        found["slots"] = _digest([_plain(slot.facts | {"at": slot.corners_m}) for slot in slots])
        garage = read_built(made.stage).garage
        proofs = [prove_stalls(layout) for layout in made.layouts]
        found["proofs"] = _digest([repr(proof) for of_level in proofs for proof in of_level])
        if len(garage.levels) > 1:
            found["proofs_of_all"] = _digest([repr(proof) for proof in prove_built(garage)])
        found["difficulty"] = _digest(
            [
                [_plain(asdict(each)) for each in stall_difficulties(planned, proofs=of_level)]
                for planned, of_level in zip(made.planned, proofs, strict=False)
            ]
        )
        found["drive"] = _digest(_drive(garage))
    return found


def _forget(report: Any, place: str) -> None:  # noqa: ANN401 - JSON
    """Remove from a report how long steps took, and where it was written."""
    for key, value in list(report.items()) if isinstance(report, dict) else []:
        if key == "seconds":
            del report[key]
        elif isinstance(value, str):
            report[key] = value.replace(place, "")
        else:
            _forget(value, place)
    for value in report if isinstance(report, list) else []:
        _forget(value, place)


def layout_digest(layout: Layout) -> str:
    """Digest of the stalls and the objects of a layout, whatever their classes are called."""
    return _digest([repr(each).partition("(")[2] for each in (*layout.stalls, *layout.placements)])


def _drive(garage: BuiltGarage) -> dict[str, Any]:
    """The states of a drive to the first stall of a garage, or why there is none."""
    try:
        drive = DrivePlanner(garage).drive()
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
    parser.add_argument("--quick", action="store_true", help="the ten that touch most of the road")
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
        found = {key: each for key, each in digests_of(settings).items() if not asked.portable or key not in OF_MACHINE}
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
