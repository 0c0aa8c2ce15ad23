"""Generation of one garage of a data set: its numbered files, and the figures of its row of the manifest."""

import gzip
import hashlib
import math
from collections import Counter
from collections.abc import Iterator, Sequence
from dataclasses import asdict, replace
from pathlib import Path
from statistics import median_low
from tempfile import TemporaryDirectory
from typing import Any, NamedTuple

import numpy as np

from garage2usd.checks import Finding, Severity, judged_layout
from garage2usd.common.documents import json_text
from garage2usd.config import GarageConfig
from garage2usd.datasets.difficulty import StallDifficulty, garage_difficulty, stall_difficulties
from garage2usd.datasets.drawn_plan import DrawnPlan
from garage2usd.datasets.drives import record_drives
from garage2usd.datasets.manifest import FileEntry, LinkEntry, ManifestRow
from garage2usd.datasets.operated import operate
from garage2usd.datasets.plans import remade
from garage2usd.datasets.recipe import MakeConfig, Recipe
from garage2usd.driving import StallProof, prove_stalls
from garage2usd.exports import export
from garage2usd.garage import LaneGraph, StallKind, StallUse
from garage2usd.garage_model import Garage, GarageLevel
from garage2usd.layout import Layout
from garage2usd.planning import measured_circulation
from garage2usd.report import area_figures, make_report, reported_links, write_report
from garage2usd.stage import StageFormat, write_labels, write_stage
from garage2usd.view.drawing import write_png
from garage2usd.view.thumbnails import draw_pictures

_FIGURE_DIGITS = 6
_DIGITS = 8
_TEXTS = {".dxf", ".geojson", ".json", ".netccfg", ".osm", ".xml", ".xodr", ".xosc", ".yaml"}


def garage_figures(levels: Sequence[GarageLevel]) -> dict[str, Any]:
    """Measure the figures of a garage.

    Parameters
    ----------
    levels
        Its levels, the top one first.

    Returns
    -------
    dict
        Fields of `garage2usd.datasets.manifest.ManifestRow`.
    """
    layouts = [level.layout for level in levels]
    stalls = [stall for layout in layouts for stall in layout.quads]
    uses = Counter(stall.use for stall in stalls)
    kinds = Counter(stall.kind for stall in stalls if stall.takes_cars)
    circulations = [measured_circulation(layout.structure) for layout in layouts]
    level_stalls = [layout.parking_stalls for layout in layouts]
    lanes = [_lane_metres(layout.lane_graph) for layout in layouts]
    parked = [nose_out for layout in layouts for nose_out in _nose_out(layout)]
    return {
        "rows": layouts[0].structure.shape[0],
        "cols": layouts[0].structure.shape[1],
        "squares": sum(layout.counts()["floor"] for layout in layouts),
        "levels": len(levels),
        "level_stalls": tuple(level_stalls),
        "stalls": sum(level_stalls),
        "standard_stalls": uses[StallUse.STANDARD],
        "ev_stalls": uses[StallUse.EV],
        "accessible_stalls": uses[StallUse.ACCESSIBLE],
        "angled_stalls": kinds[StallKind.ANGLED],
        "parallel_stalls": kinds[StallKind.PARALLEL],
        **_sizes(layouts),
        "cars": sum(layout.counts()["car"] for layout in layouts),
        "perpendicular_cars": len(parked),
        "nose_out_cars": sum(parked),
        "lanes_m": round(math.fsum(all_m for all_m, _ in lanes), _FIGURE_DIGITS),
        "one_way_lanes_m": round(math.fsum(one_way_m for _, one_way_m in lanes), _FIGURE_DIGITS),
        "loops": sum(found.circulation.loops for found in circulations),
        "longest_dead_end_m": max(found.dead_end_m for found in circulations),
        **{name: area_m2 or 0.0 for name, area_m2 in area_figures(layouts).items()},
        "stair_cores": sum(len(layout.cores) for layout in layouts),
        "mean_lux": _mean_lux(layouts),
    }


def _sizes(layouts: Sequence[Layout]) -> dict[str, float]:
    """Measure the usual size of stalls and the clear width of the aisles in front of them, as medians."""
    pairs = [(layout.lane_graph, stall) for layout in layouts for stall in layout.quads if stall.takes_cars]
    usual = [pair for pair in pairs if pair[1].is_usual] or pairs
    measured = {
        "stall_width_m": [stall.width_m for _, stall in usual],
        "stall_length_m": [stall.length_m for _, stall in usual],
        "aisle_width_m": [lanes.clear_aisle_m(stall.access, stall.outwards) for lanes, stall in usual],
    }
    return {name: round(median_low(values), _FIGURE_DIGITS) for name, values in measured.items() if values}


def _lane_metres(lanes: LaneGraph) -> tuple[float, float]:
    """Return the length of all lanes between two lane nodes, without portals, and that of one-way lanes."""
    inside = [edge for edge in lanes.edges if not lanes.nodes[edge.start].is_portal | lanes.nodes[edge.end].is_portal]
    lengths = [(lanes.length_m(edge.start, edge.end), edge.one_way) for edge in inside]
    return math.fsum(length for length, _ in lengths), math.fsum(length for length, one_way in lengths if one_way)


def _nose_out(layout: Layout) -> Iterator[bool]:
    """Yield True for each car in a perpendicular stall that stands nose out, False for the others."""
    rows = layout.cars_in_stalls().tolist()
    for stall, row in zip(layout.quads, rows, strict=True):
        if row >= 0 and stall.takes_cars and stall.kind is StallKind.PERPENDICULAR:
            turned_rad = math.remainder(float(layout.placements.yaw_rad[row]) - stall.yaw_rad, math.tau)
            yield abs(turned_rad) > math.pi / 2


def _mean_lux(layouts: Sequence[Layout]) -> float:
    """Return the mean illuminance of stalls, levels weighted by their stalls; 0 without lamps."""
    lit = [(layout.illuminance.stalls.mean, layout.parking_stalls) for layout in layouts if layout.illuminance.stalls]
    total = sum(count for _, count in lit)
    return round(float(np.dot(*np.array(lit).T)) / total, _FIGURE_DIGITS) if total else 0.0


def key_of(shard: str, number: int) -> str:
    """Return the key of a garage: the prefix of its files' paths within the folder of shards."""
    return f"{shard}/{number:0{_DIGITS}}"


def make_scene(
    recipe: Recipe, drawn: DrawnPlan, folder: Path, *, split: str, shard: str, assets: Path | None
) -> ManifestRow:
    """Generate the files of one garage of a data set.

    Parameters
    ----------
    recipe
        The recipe, which selects the outputs.
    drawn
        Plan of the garage.
    folder
        An existing folder, at the same depth of the data set as the final one, so that relative paths stay valid.
    split, shard
        Split and shard of the garage.
    assets
        Folder of the assets shared by all stages; None if each stage is self-contained.

    Returns
    -------
    ManifestRow
        Manifest row of the garage.

    Raises
    ------
    Garage2UsdError
        If the garage cannot be built.
    """
    config, alternatives = recipe.drawn(drawn.seed, drawn.number)
    stem = f"{drawn.number:0{_DIGITS}}"
    made = _write_all(recipe.make, drawn, config, folder / stem, assets)
    if recipe.make.gzip:
        _compress(folder, stem)
    severities = Counter(finding.severity for finding in made.findings)
    return ManifestRow(
        number=drawn.number,
        key=key_of(shard, drawn.number),
        split=split,
        shard=shard,
        seed=drawn.seed,
        attempt=drawn.attempt,
        alternatives=alternatives,
        country=config.standard.country,
        plan_digest=drawn.digest,
        check_errors=severities[Severity.ERROR],
        check_warnings=severities[Severity.WARNING],
        files=tuple(_entry(path, stem) for path in sorted(folder.glob(f"{stem}.*"))),
        **made.figures,
    )


class _Made(NamedTuple):
    """Fields of a garage's manifest row, and the findings of the quick rules on it."""

    figures: dict[str, Any]
    findings: Sequence[Finding]


def _write_all(make: MakeConfig, drawn: DrawnPlan, config: GarageConfig, place: Path, assets: Path | None) -> _Made:
    """Write the files of a garage; `place` is their folder and stem."""
    garage = remade(drawn, config)
    judged = [judged_layout(level.layout, level.config) for level in garage.levels]
    unmet = [clauses for _, clauses in judged]
    report = make_report(garage, seconds={}, unmet=unmet, learning=drawn.learning)
    write_report(place.with_name(f"{place.name}.report.json"), report)
    stage = _write_files(garage, place, make, assets)
    difficulty = dict[str, Any]()
    tracks, operated = None, dict[str, Any]()
    if make.traffic and stage:
        tracks, operated = operate(stage, make.traffic, config.traffic, seed=drawn.seed)
    if make.difficulty or (make.drives and tracks is None):
        proofs = [prove_stalls(level.layout, most_explained=0) for level in garage.levels]
        if make.difficulty:
            rated = _difficulties(garage, proofs)
            difficulty = _write_difficulty(rated, place.with_name(f"{place.name}.difficulty.json"))
        if make.drives and stage and tracks is None:
            every = [
                replace(proof, stall=level.place.in_whole(proof.stall))
                for level, proven in zip(garage.levels, proofs, strict=True)
                for proof in proven
            ]
            record_drives(stage, make.drives, every, seed=drawn.seed, settings=config.maps.drive)
    if make.drives and stage and tracks is not None:
        record_drives(stage, make.drives, (), seed=drawn.seed, settings=config.maps.drive, tracks=tracks)
    links = (
        LinkEntry(kind=link.kind, upper=link.upper, lower=link.lower, direction=link.direction)
        for link in reported_links(garage)
    )
    figures = {
        "config_digest": report.config_digest,
        "structure_digest": garage.building.digest(),
        "links": tuple(links),
        **garage_figures(garage.levels),
        **difficulty,
        **operated,
    }
    return _Made(figures, [finding for findings, _ in judged for finding in findings])


def _write_files(garage: Garage, place: Path, make: MakeConfig, assets: Path | None) -> Path | None:
    """Write the stage, exports, labels and plan pictures of a garage; return the stage, if any."""
    folder, stem = place.parent, place.name
    stage = None
    if make.stage and make.self_contained:
        stage = folder / f"{stem}{StageFormat.USDZ}"
        with TemporaryDirectory(dir=folder) as room:  # USD needs an empty folder to write a package
            packed = Path(room) / stage.name
            write_stage(garage, packed, own=f"{stem}.")
            packed.replace(stage)
    elif make.stage:
        stage = folder / f"{stem}{StageFormat.USDC}"
        write_stage(garage, stage, shared=assets, own=f"{stem}.")
    if stage and make.exports:
        export(stage, [folder / f"{stem}.{name}" for name in make.exports], settings=garage.config.maps, joint=".")
    if make.labels:
        write_labels(garage, folder / f"{stem}.labels.json")
    if make.plan:
        for name, picture in draw_pictures(garage, joint=".").items():
            write_png(picture, folder / f"{stem}.{name}.png")
    return stage


def _difficulties(garage: Garage, proofs: Sequence[Sequence[StallProof]]) -> list[StallDifficulty]:
    """Rate the difficulty of each stall of a garage, level by level, by the proofs of each level."""
    found = []
    for level, proven in zip(garage.levels, proofs, strict=True):
        for each in stall_difficulties(level, proofs=proven):
            name = level.place.in_whole(each.stall)
            found.append(replace(each, stall=name, features=replace(each.features, stall=name)))
    return found


def _write_difficulty(stalls: Sequence[StallDifficulty], path: Path) -> dict[str, Any]:
    """Write the difficulty of each stall to a file, and return the difficulty fields of the garage's manifest row."""
    table = [{"score": stall.score, "level": stall.level, **asdict(stall.features)} for stall in stalls]
    path.write_text(json_text({"stalls": table}), encoding="utf-8", newline="\n")
    found = garage_difficulty(stalls)
    return {
        "difficulty": str(found.level or ""),
        "difficulty_score": -1.0 if found.score is None else found.score,
        "normal_stalls": found.normal,
        "complex_stalls": found.complex,
        "extreme_stalls": found.extreme,
        "unproven_stalls": found.unproven,
    }


def _compress(folder: Path, stem: str) -> None:
    """Compress a garage's text files reproducibly."""
    for path in sorted(folder.glob(f"{stem}.*")):
        if path.suffix in _TEXTS:
            path.with_name(f"{path.name}.gz").write_bytes(gzip.compress(path.read_bytes(), compresslevel=6, mtime=0))
            path.unlink()


def _entry(path: Path, stem: str) -> FileEntry:
    data = path.read_bytes()
    return FileEntry(suffix=path.name.removeprefix(stem), bytes=len(data), sha256=hashlib.sha256(data).hexdigest())
