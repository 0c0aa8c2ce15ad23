"""Import of layouts that others made: a garage in metres, without a grid, from a map or a drawing."""

import hashlib
import math
import time
from collections import Counter
from collections.abc import Mapping
from dataclasses import replace
from functools import partial
from pathlib import Path
from typing import Any

from garage2usd.checks import judged_layout
from garage2usd.common.processes import without_collector
from garage2usd.common.progress import Progress, silent
from garage2usd.config import GarageConfig
from garage2usd.driving import StallProof, prove_stalls
from garage2usd.garage_files import draw_pictures
from garage2usd.garage_model import Garage, GarageLevel
from garage2usd.layout.surveyed import SurveyedFloor, lay_out_survey
from garage2usd.pipeline import Build, Judged, checked_output, with_things, written
from garage2usd.structure.building import Building, level_name
from garage2usd.survey.alignment import Alignment, aligned
from garage2usd.survey.medial_lanes import with_medial_lanes
from garage2usd.survey.reader import SURVEY_SUFFIXES, read_survey
from garage2usd.survey.survey import Survey

__all__ = ["SURVEY_SUFFIXES", "import_layout", "read_survey", "surveyed_floor"]


@without_collector()
def import_layout(
    source: str | Path | Survey,
    output: str | Path,
    *,
    config: GarageConfig | None = None,
    proves: bool = True,
    progress: Progress = silent,
) -> Build:
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
        True to prove for each stall that a car drives in and out, which the report then has, and to check the garage by
        the rules that need these ways.
    progress
        Told how far long steps are.

    Returns
    -------
    Build
        The garage and its files. `surveyed_floor` of it has what the garage lacks of the source.

    Raises
    ------
    ConfigError
        If the source or a setting cannot be used, or none of the stalls can be placed.
    OutputError
        If the files cannot be written. They appear whole or not at all.
    """
    config = config or GarageConfig()
    path = checked_output(output, config)
    start = time.perf_counter()
    survey = source if isinstance(source, Survey) else read_survey(Path(source))
    survey, alignment = aligned(with_medial_lanes(survey))
    layout = with_things(lay_out_survey(survey, config), config, progress=progress)
    proofs = prove_stalls(layout, progress=progress) if proves else ()
    level = GarageLevel(level_name(0), 0.0, config, layout, is_only=True, planned=None)
    building = Building((layout.structure,), None, config.building.storey_m)
    garage = Garage(config, building, (level,), _origin(source))
    seconds = {"import": time.perf_counter() - start}

    def judge() -> tuple[Judged, ...]:
        findings, unmet = judged_layout(layout, config, with_ways=proves)
        return (Judged(tuple(findings), unmet),)

    def report(_: object) -> Mapping[str, Any]:
        return _report(garage, alignment, proofs, seconds=sum(seconds.values()))

    draw = partial(draw_pictures, garage)
    made = written(garage, path, seconds, draw=draw, judge=judge, report=report, progress=progress)
    return replace(made, proofs=proofs)


def surveyed_floor(garage: Garage) -> SurveyedFloor:
    """Return what an imported garage was laid out from: its survey, stalls, and the parts that it lacks."""
    floor = garage.layout.source
    assert isinstance(floor, SurveyedFloor)
    return floor


def _origin(source: str | Path | Survey) -> Mapping[str, str]:
    """Return the name of a file that is imported, and the digest of its bytes."""
    if isinstance(source, Survey):
        return {}
    return {"source": Path(source).name, "sourceDigest": hashlib.sha256(Path(source).read_bytes()).hexdigest()}


def _report(
    garage: Garage, alignment: Alignment, proofs: tuple[StallProof, ...], *, seconds: float
) -> Mapping[str, Any]:
    """The facts of an import; reproducible, except for ``seconds``."""
    config, layout, surveyed = garage.config, garage.layout, surveyed_floor(garage)
    proven = {proof.stall: proof for proof in proofs}
    origin = surveyed.survey.origin_deg
    return {
        **garage.metadata,
        "config": config.model_dump(mode="json"),
        "turn_deg": round(math.degrees(alignment.turn_rad), 6),
        "shift_m": alignment.shift_m,
        "origin_deg": origin,
        "parking_stalls": layout.parking_stalls,
        "stall_kinds": dict(sorted(Counter(stall.kind.value for stall in layout.quads).items())),
        "stall_uses": dict(sorted(Counter(stall.use.value for stall in layout.quads).items())),
        "unplaced": [{"id": part.name, "reason": part.reason} for part in surveyed.unplaced],
        "remarks": config.remarks(),
        "changed": [{"id": stall.source.name, "change": stall.note} for stall in surveyed.fitted if stall.note],
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
            for stall, source_stall in zip(layout.quads, surveyed.fitted, strict=True)
        ],
        "lane_m": round(sum(layout.lane_graph.length_m(edge.start, edge.end) for edge in layout.lane_graph.edges), 2),
        "object_counts": layout.counts(),
        "seconds": round(seconds, 4),
    }
