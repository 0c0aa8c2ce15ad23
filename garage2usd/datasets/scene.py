"""Generation of one garage of a data set as files whose names begin with its number."""

import gzip
import hashlib
from collections import Counter
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any, NamedTuple

from garage2usd.buildings import levels_report
from garage2usd.checks import Finding, Severity, judged_layout
from garage2usd.common.json_text import json_text
from garage2usd.config import GarageConfig
from garage2usd.datasets.difficulty import stall_difficulties
from garage2usd.datasets.drawn_plan import DrawnPlan
from garage2usd.datasets.drives import record_drives
from garage2usd.datasets.garage_figures import garage_figures
from garage2usd.datasets.level_files import levels_difficulties, levels_proofs, write_difficulty, write_level_files
from garage2usd.datasets.manifest import FileEntry, LinkEntry, ManifestRow
from garage2usd.datasets.plans import levels_replanned, replanned
from garage2usd.datasets.recipe import MakeConfig, Recipe
from garage2usd.driving import prove_stalls
from garage2usd.exports import export
from garage2usd.pipeline import Garage, generate, stage_metadata
from garage2usd.report import make_report, write_report
from garage2usd.stage import StageFormat, arrangement_of, write_labels, write_stage
from garage2usd.view.plan_picture import draw_plan
from garage2usd.view.raster import to_image, write_png

__all__ = ["key_of", "make_scene"]

_DIGITS = 8
_TEXTS = {".json", ".netccfg", ".osm", ".xml", ".xodr", ".xosc", ".yaml"}


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
    make = _level_files if config.building.levels == 1 else _levels_files
    made = make(recipe.make, drawn, config, folder / stem, assets)
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


def _level_files(make: MakeConfig, drawn: DrawnPlan, config: GarageConfig, place: Path, assets: Path | None) -> _Made:
    """Write the files of a garage of one level; `place` is their folder and stem."""
    garage = generate(config, plan=replanned(drawn, config))
    findings, unmet = judged_layout(garage.layout, config)
    report = make_report(
        config=config,
        plan=garage.plan,
        layout=garage.layout,
        seconds={},
        learning=drawn.learning,
        unmet=unmet,
    )
    write_report(place.with_name(f"{place.name}.report.json"), report)
    stage = _write_files(garage, place.parent, place.name, make, assets)
    difficulty = dict[str, Any]()
    if make.difficulty or make.drives:
        proofs = prove_stalls(garage.layout, most_explained=0)
        if make.difficulty:
            rated = stall_difficulties(garage, proofs=proofs)
            difficulty = write_difficulty(rated, place.with_name(f"{place.name}.difficulty.json"))
        if make.drives and stage:
            record_drives(stage, make.drives, proofs, seed=drawn.seed, settings=config.maps.drive)
    digests = {"config_digest": report.config_digest, "structure_digest": report.structure_digest}
    return _Made({**digests, **garage_figures([garage]), **difficulty}, findings)


def _levels_files(make: MakeConfig, drawn: DrawnPlan, config: GarageConfig, place: Path, assets: Path | None) -> _Made:
    """Write the files of a garage of several levels; `place` is their folder and stem."""
    garage = levels_replanned(drawn, config)
    judged = [judged_layout(level.layout, level.config) for level in garage.levels]
    report = levels_report(garage, {}, [unmet for _, unmet in judged])
    place.with_name(f"{place.name}.report.json").write_text(
        json_text(report.model_dump(mode="json")), encoding="utf-8", newline="\n"
    )
    stage = write_level_files(garage, place, make, assets)
    difficulty = dict[str, Any]()
    if make.difficulty or make.drives:
        proofs = levels_proofs(garage)
        if make.difficulty:
            rated = levels_difficulties(garage, proofs)
            difficulty = write_difficulty(rated, place.with_name(f"{place.name}.difficulty.json"))
        if make.drives and stage:
            every = [
                replace(proof, stall=f"{name}/{proof.stall}") for name, proven in proofs.items() for proof in proven
            ]
            record_drives(stage, make.drives, every, seed=drawn.seed, settings=config.maps.drive)
    structures = [structure.digest() for structure in garage.building.levels]
    figures = {
        "config_digest": report.config_digest,
        "structure_digest": hashlib.sha256("".join(structures).encode()).hexdigest(),
        "links": tuple(
            LinkEntry(kind=link.kind, upper=link.upper, lower=link.lower, direction=link.direction)
            for link in report.links
        ),
        **garage_figures(garage.levels),
        **difficulty,
    }
    return _Made(figures, [finding for findings, _ in judged for finding in findings])


def _write_files(garage: Garage, folder: Path, stem: str, make: MakeConfig, assets: Path | None) -> Path | None:
    """Write the report, labels, plan picture and stage of a garage; return the stage, if any."""
    stage = None
    arrangement = arrangement_of(garage.layout, garage.config.stage)
    if make.stage:
        suffix = StageFormat.USDZ if make.self_contained else StageFormat.USDC
        stage = folder / f"{stem}{suffix}"
        write_stage(
            garage.layout,
            stage,
            arrangement=arrangement,
            metadata=stage_metadata(garage),
            config=garage.config.stage,
            shared=assets,
            own=f"{stem}.",
        )
        if make.exports:
            files = [folder / f"{stem}.{name}" for name in make.exports]
            export(stage, files, settings=garage.config.maps, joint=".")
    if make.labels:
        write_labels(garage.layout, folder / f"{stem}.labels.json", arrangement=arrangement)
    if make.plan:
        write_png(to_image(draw_plan(garage.layout)), folder / f"{stem}.plan.png")
    return stage


def _compress(folder: Path, stem: str) -> None:
    """Compress a garage's text files reproducibly."""
    for path in sorted(folder.glob(f"{stem}.*")):
        if path.suffix in _TEXTS:
            path.with_name(f"{path.name}.gz").write_bytes(gzip.compress(path.read_bytes(), compresslevel=6, mtime=0))
            path.unlink()


def _entry(path: Path, stem: str) -> FileEntry:
    data = path.read_bytes()
    return FileEntry(suffix=path.name.removeprefix(stem), bytes=len(data), sha256=hashlib.sha256(data).hexdigest())
