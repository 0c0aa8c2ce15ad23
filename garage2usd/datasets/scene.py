"""Generation of one garage of a data set as files whose names begin with its number."""

import gzip
import hashlib
from collections import Counter
from collections.abc import Sequence
from dataclasses import asdict
from pathlib import Path

from garage2usd.checks import Severity, judged_layout
from garage2usd.common.json_text import json_text
from garage2usd.datasets.difficulty import garage_difficulty, stall_difficulties
from garage2usd.datasets.drives import record_drives
from garage2usd.datasets.manifest import FileEntry, ManifestRow
from garage2usd.datasets.plans import DrawnPlan, replanned
from garage2usd.datasets.recipe import MakeConfig, Recipe
from garage2usd.driving import StallProof, prove_stalls
from garage2usd.exports import export
from garage2usd.garage import StallUse
from garage2usd.pipeline import Garage, generate, stage_metadata
from garage2usd.planning import measured_circulation
from garage2usd.reading.report import Report
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
    garage = generate(config, plan=replanned(drawn, config))
    stem = f"{drawn.number:0{_DIGITS}}"
    found, unmet = judged_layout(garage.layout, config)
    report = make_report(
        config=config,
        plan=garage.plan,
        layout=garage.layout,
        seconds={},
        learning=drawn.learning,
        unmet=unmet,
    )
    write_report(folder / f"{stem}.report.json", report)
    make, difficulty = recipe.make, dict[str, str | int | float]()
    stage = _write_files(garage, folder, stem, make, assets)
    if make.difficulty or make.drives:
        proofs = prove_stalls(garage.layout, most_explained=0)
        if make.difficulty:
            difficulty = _difficulty(garage, proofs, folder / f"{stem}.difficulty.json")
        if make.drives and stage:
            record_drives(stage, make.drives, proofs, seed=drawn.seed, settings=config.maps.drive)
    if make.gzip:
        _compress(folder, stem)
    findings = Counter(finding.severity for finding in found)
    return ManifestRow(
        number=drawn.number,
        key=key_of(shard, drawn.number),
        split=split,
        shard=shard,
        seed=drawn.seed,
        attempt=drawn.attempt,
        alternatives=alternatives,
        plan_digest=drawn.digest,
        check_errors=findings[Severity.ERROR],
        check_warnings=findings[Severity.WARNING],
        **difficulty,
        files=tuple(_entry(path, stem) for path in sorted(folder.glob(f"{stem}.*"))),
        **_figures(garage, report),
    )


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


def _difficulty(garage: Garage, proofs: Sequence[StallProof], path: Path) -> dict[str, str | int | float]:
    """Write the difficulty of each stall to a file, and return the manifest's difficulty fields."""
    stalls = stall_difficulties(garage, proofs=proofs)
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


def _figures(garage: Garage, report: Report) -> dict[str, str | int | float]:
    layout, uses = garage.layout, Counter(stall.use for stall in garage.layout.quads)
    counts = layout.counts()
    circulation = measured_circulation(layout.structure)
    light = layout.illuminance
    return {
        "config_digest": report.config_digest,
        "structure_digest": report.structure_digest,
        "rows": layout.structure.shape[0],
        "cols": layout.structure.shape[1],
        "squares": counts["floor"],
        "stalls": layout.parking_stalls,
        "standard_stalls": uses[StallUse.STANDARD],
        "ev_stalls": uses[StallUse.EV],
        "accessible_stalls": uses[StallUse.ACCESSIBLE],
        "cars": counts["car"],
        "loops": circulation.circulation.loops,
        "longest_dead_end_m": circulation.dead_end_m,
        "area_per_stall_m2": report.area_per_stall_m2 or 0.0,
        "stair_cores": len(layout.cores),
        "mean_lux": light.stalls.mean if light and light.stalls else 0.0,
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
