"""Files of a garage of several levels in a data set: stage, exports, labels, pictures of plans, and difficulty."""

from collections.abc import Mapping, Sequence
from dataclasses import asdict, replace
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

from garage2usd.buildings import LevelsGarage, levels_metadata
from garage2usd.common.json_text import json_text
from garage2usd.datasets.difficulty import StallDifficulty, garage_difficulty, stall_difficulties
from garage2usd.datasets.recipe import MakeConfig
from garage2usd.driving import StallProof, prove_stalls
from garage2usd.exports import export
from garage2usd.stage import StageFormat
from garage2usd.stage.levels import LevelLayout, write_level_labels, write_levels_stage
from garage2usd.view.plan_picture import draw_plan
from garage2usd.view.raster import to_image, write_png

__all__ = ["levels_difficulties", "levels_proofs", "write_difficulty", "write_level_files"]


def write_level_files(garage: LevelsGarage, place: Path, make: MakeConfig, assets: Path | None) -> Path | None:
    """Write stage, exports, labels and the plan of each level of a garage; return the stage, if any.

    Parameters
    ----------
    garage
        The garage.
    place
        Folder and stem of the files: ``00000312`` gives ``00000312.usdc``, ``00000312.U1.usdc`` and so on.
    make
        Settings of the outputs.
    assets
        Folder of the assets shared by all stages; None if each stage is self-contained.
    """
    folder, stem = place.parent, place.name
    levels = garage.layouts
    stage = None
    if make.stage:
        stage = _write_stage(garage, levels, place, make, assets)
        if make.exports:
            files = [folder / f"{stem}.{name}" for name in make.exports]
            export(stage, files, settings=garage.config.maps, joint=".")
    if make.labels:
        write_level_labels(levels, folder / f"{stem}.labels.json", garage.config.stage)
    if make.plan:
        for level in levels:
            write_png(to_image(draw_plan(level.layout)), folder / f"{stem}.{level.name}.plan.png")
    return stage


def levels_proofs(garage: LevelsGarage) -> dict[str, Sequence[StallProof]]:
    """Prove the stalls of each level, by its name, among its own obstacles and between its portals and landings."""
    return {level.name: prove_stalls(level.layout, most_explained=0) for level in garage.layouts}


def levels_difficulties(
    garage: LevelsGarage, proofs: Mapping[str, Sequence[StallProof]]
) -> tuple[StallDifficulty, ...]:
    """Rate the difficulty of each stall of a garage, level by level; names of stalls begin with that of the level.

    Parameters
    ----------
    garage
        The garage.
    proofs
        Its `levels_proofs`.
    """
    return tuple(
        replace(stall, stall=f"{name}/{stall.stall}", features=replace(stall.features, stall=f"{name}/{stall.stall}"))
        for (name, proven), level in zip(proofs.items(), garage.levels, strict=True)
        for stall in stall_difficulties(level, proofs=proven)
    )


def write_difficulty(stalls: Sequence[StallDifficulty], path: Path) -> dict[str, Any]:
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


def _write_stage(
    garage: LevelsGarage, levels: Sequence[LevelLayout], place: Path, make: MakeConfig, assets: Path | None
) -> Path:
    metadata, config = levels_metadata(garage), garage.config.stage
    if not make.self_contained:
        stage = place.with_name(f"{place.name}{StageFormat.USDC}")
        write_levels_stage(
            levels, garage.joined, stage, metadata=metadata, config=config, shared=assets, own=f"{place.name}."
        )
        return stage
    with TemporaryDirectory(dir=place.parent) as room:  # it is written in an empty folder
        packed = Path(room) / f"{place.name}{StageFormat.USDZ}"
        write_levels_stage(levels, garage.joined, packed, metadata=metadata, config=config)
        return packed.replace(place.with_name(packed.name))
