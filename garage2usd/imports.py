"""Import of layouts that others made: a garage in metres, without a grid, from a map or a drawing."""

import hashlib
import math
import time
from collections import Counter
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from garage2usd.checks import Finding, judged_layout
from garage2usd.checks.swept_path import design_car
from garage2usd.common.errors import ConfigError
from garage2usd.common.json_text import json_text
from garage2usd.common.output import check_file, check_name, check_writable, publish_at, staging_folder
from garage2usd.common.processes import without_collector
from garage2usd.common.progress import Progress, silent
from garage2usd.common.version import VERSION
from garage2usd.config import GarageConfig
from garage2usd.driving import DesignCar, StallProof, prove_stalls, with_clutter, with_truth_of_misparked
from garage2usd.layout.surveyed import SurveyedLayout, lay_out_survey
from garage2usd.reading.report import UnmetClause
from garage2usd.stage import StageFormat, arrangement_of, shared_folder, write_labels, write_stage
from garage2usd.survey.alignment import Alignment, aligned
from garage2usd.survey.medial_lanes import with_medial_lanes
from garage2usd.survey.reader import SURVEY_SUFFIXES, read_survey
from garage2usd.survey.survey import Survey
from garage2usd.view.plan_picture import draw_plan
from garage2usd.view.raster import to_image, write_png

__all__ = ["SURVEY_SUFFIXES", "ImportedGarage", "import_layout", "read_survey"]

_NAMES_BESIDE = ("plan.png", "labels.json", "report.json")


@dataclass(frozen=True, eq=False)
class ImportedGarage:
    """A garage that was made of a layout of others.

    Attributes
    ----------
    config
        Sizes, fittings, parking, look and seed.
    layout
        The garage, with the parts that it lacks and why under `SurveyedLayout.unplaced`.
    alignment
        How the source was turned and shifted.
    proofs
        For each stall that takes cars, whether a car drives in and out; empty if no proof was asked for.
    stage, report, labels, plan
        The files: the USD stage, a JSON report, a JSON table of all objects, and a picture from above.
    findings
        What the garage misses of its profile, errors first: by all rules but those of USD, without proofs by the quick
        ones.
    unmet
        The clauses of its profile that it misses, or that nothing checks.
    """

    config: GarageConfig
    layout: SurveyedLayout
    alignment: Alignment
    proofs: tuple[StallProof, ...]
    stage: Path
    report: Path
    labels: Path
    plan: Path
    findings: tuple[Finding, ...]
    unmet: tuple[UnmetClause, ...]


@without_collector()
def import_layout(
    source: str | Path | Survey,
    output: str | Path,
    *,
    config: GarageConfig | None = None,
    proves: bool = True,
    progress: Progress = silent,
) -> ImportedGarage:
    """Make a garage of a layout that others made, and write its stage, plan, labels and report.

    Parameters
    ----------
    source
        A file: a Lanelet2 map or OpenStreetMap extract (``.osm``), OpenDRIVE (``.xodr``), GeoJSON (``.geojson``), a
        table of rectangles (``.csv``) or a drawing (``.toml``); or a survey.
    output
        The stage's path; ``.usda``, ``.usdc`` or ``.usdz``. The other files go beside it, under its name.
    config
        Fittings, parking, look and seed; site, bay, stalls and plan do not apply. The default ones if left out.
    proves
        True to prove for each stall that a car drives in and out, which the report then has.
    progress
        Told how far long steps are.

    Raises
    ------
    ConfigError
        If the source or a setting cannot be used, or none of the stalls can be placed.
    OutputError
        If the files cannot be written. They appear whole or not at all.
    """
    path, config = Path(output), config or GarageConfig()
    if path.suffix.lower() not in set(StageFormat) or not path.stem:
        raise ConfigError("output", str(output), f"a path that ends in {', '.join(StageFormat)}")
    check_name(path, of_layer=True)
    check_file(path, with_it=(path.with_name(f"{path.stem}_{name}") for name in _NAMES_BESIDE))
    if shared := shared_folder(path, config.stage):
        check_writable(shared)
    start = time.perf_counter()
    survey = source if isinstance(source, Survey) else read_survey(Path(source))
    survey, alignment = aligned(with_medial_lanes(survey))
    layout = lay_out_survey(survey, config)
    truthful = with_truth_of_misparked(layout, config, progress=progress)
    if config.clutter.is_any:
        truthful = with_clutter(truthful, config, cars=(DesignCar(), design_car(config.standard)), progress=progress)
    assert isinstance(truthful, SurveyedLayout)
    layout = truthful
    proofs = prove_stalls(layout, progress=progress) if proves else ()
    findings, unmet = judged_layout(layout, config, with_ways=proves)
    metadata = _metadata(source, config)
    with staging_folder(path) as staging:
        folder = staging / "stage"
        folder.mkdir()
        arrangement = arrangement_of(layout, config.stage)
        made = write_stage(
            layout,
            folder / f"{path.stem}{path.suffix.lower()}",
            arrangement=arrangement,
            metadata=metadata,
            config=config.stage,
            shared=shared,
            progress=progress,
        )
        labels, plan, report = (staging / f"{path.stem}_{name}" for name in ("labels.json", "plan.png", "report.json"))
        write_labels(layout, labels, arrangement=arrangement)
        write_png(to_image(draw_plan(layout)), plan)
        facts = _report(metadata, config, layout, alignment, proofs, seconds=time.perf_counter() - start)
        report.write_text(json_text(facts), encoding="utf-8", newline="\n")
        progress("files", 0, 1)
        # the stage comes last: where it stands, all of it does
        place_of = {file: path.with_name(file.name) for file in (*filter(None, [made.assets]), plan, labels, report)}
        publish_at(place_of | {made.stage: path})
    beside = {file: path.with_name(file.name) for file in (report, labels, plan)}
    return ImportedGarage(
        config, layout, alignment, proofs, path, beside[report], beside[labels], beside[plan], tuple(findings), unmet
    )


def _metadata(source: str | Path | Survey, config: GarageConfig) -> dict[str, str | int]:
    """What a stage says of how its garage was made."""
    facts: dict[str, str | int] = {
        "generator": "garage2usd",
        "version": VERSION,
        "seed": config.seed,
        "configDigest": config.digest(),
        "profile": config.standard.name,
    }
    if not isinstance(source, Survey):
        facts |= {"source": Path(source).name, "sourceDigest": hashlib.sha256(Path(source).read_bytes()).hexdigest()}
    return facts


def _report(
    metadata: Mapping[str, str | int],
    config: GarageConfig,
    layout: SurveyedLayout,
    alignment: Alignment,
    proofs: tuple[StallProof, ...],
    *,
    seconds: float,
) -> Mapping[str, Any]:
    """The facts of an import; reproducible, except for ``seconds``."""
    proven = {proof.stall: proof for proof in proofs}
    origin = layout.survey.origin_deg
    return {
        **metadata,
        "config": config.model_dump(mode="json"),
        "turn_deg": round(math.degrees(alignment.turn_rad), 6),
        "shift_m": alignment.shift_m,
        "origin_deg": origin,
        "parking_stalls": layout.parking_stalls,
        "stall_kinds": dict(sorted(Counter(stall.kind.value for stall in layout.quads).items())),
        "stall_uses": dict(sorted(Counter(stall.use.value for stall in layout.quads).items())),
        "unplaced": [{"id": part.name, "reason": part.reason} for part in layout.unplaced],
        "remarks": config.remarks(),
        "changed": [{"id": stall.source.name, "change": stall.note} for stall in layout.fitted if stall.note],
        "stalls": [
            {
                "id": source_stall.source.name,
                "name": stall.name,
                "number": str(stall.number or ""),
                "use": stall.use.value,
                "kind": stall.kind.value,
                "angle_deg": round(stall.slant_deg, 3),
                "size": stall.size,
                "corners_m": [[round(x, 4), round(z, 4)] for x, z in stall.corners],
                "occupied": stall.is_occupied,
                **({} if stall.blocked_by is None else {"blocked_by": stall.blocked_by}),
                **({"proof": proven[stall.name].outcome.value} if stall.name in proven else {}),
            }
            for stall, source_stall in zip(layout.quads, layout.fitted, strict=True)
        ],
        "lane_m": round(sum(layout.network.length_m(edge.start, edge.end) for edge in layout.network.edges), 2),
        "object_counts": layout.counts(),
        "seconds": round(seconds, 4),
    }
