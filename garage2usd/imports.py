"""Import of existing layouts: a garage in metres, without a grid, from a map or a drawing."""

import hashlib
import math
import time
from collections.abc import Mapping
from dataclasses import replace
from functools import partial
from pathlib import Path

from garage2usd.checks import judged_layout
from garage2usd.common.processes import without_collector
from garage2usd.common.progress import Progress, silent
from garage2usd.config import GarageConfig
from garage2usd.driving import prove_stalls
from garage2usd.garage_model import Garage, GarageLevel
from garage2usd.layout.surveyed import SurveyedFloor, lay_out_survey
from garage2usd.pipeline import Build, Judged, checked_output, with_things, written
from garage2usd.profiles import DEFAULT_PROFILE
from garage2usd.profiles.countries import profile_at
from garage2usd.reading.report import SurveyFigures
from garage2usd.report import make_report
from garage2usd.structure.building import Building
from garage2usd.survey.clear_ground import with_medial_lanes
from garage2usd.survey.enclosure import enclosed
from garage2usd.survey.reader import read_survey
from garage2usd.survey.survey import Alignment, Survey, aligned
from garage2usd.view.thumbnails import draw_pictures


@without_collector()
def import_layout(
    source: str | Path | Survey,
    output: str | Path,
    *,
    config: GarageConfig | None = None,
    proves: bool = True,
    progress: Progress = silent,
) -> Build:
    """Make a garage of an existing layout, and write its stage, plan, labels and report.

    Parameters
    ----------
    source
        A file: a Lanelet2 map or OpenStreetMap extract (``.osm``), OpenDRIVE (``.xodr``), GeoJSON (``.geojson``), a
        table of rectangles (``.csv``) or a drawing (``.toml``); or a survey.
    output
        Path of the stage; ``.usda``, ``.usdc`` or ``.usdz``. The other files are written beside it under its name.
    config
        Fittings, parking, look and seed; site, bay, stalls and plan do not apply. The default ones if left out. If it
        gives no profile, that of the country counts where the source has geographic coordinates.
    proves
        True to prove for each stall that a car drives in and out, to put the proofs into the report, and to check the
        garage by the rules that need them.
    progress
        Called with the progress of long steps.

    Returns
    -------
    Build
        The garage and its files. `surveyed_floor` returns the parts of the source that the garage lacks.

    Raises
    ------
    ConfigError
        If the source or a setting is invalid, or none of the stalls can be placed.
    OutputError
        If the files cannot be written. They appear whole or not at all.
    """
    config = config or GarageConfig()
    path = checked_output(output, config)
    start = time.perf_counter()
    survey = source if isinstance(source, Survey) else read_survey(Path(source))
    config, survey = _of_country(config, survey)
    survey, alignment = aligned(with_medial_lanes(enclosed(survey)))
    layout = with_things(lay_out_survey(survey, config), config, progress=progress)
    proofs = prove_stalls(layout, progress=progress) if proves else ()
    building = Building((layout.structure,), None, config.building.storey_m)
    level = GarageLevel(building.places[0], config, layout, planned=None)
    garage = Garage(config, building, (level,), _origin(source))
    seconds = {"import": time.perf_counter() - start}

    def judge() -> tuple[Judged, ...]:
        findings, unmet = judged_layout(layout, config, with_ways=proves)
        return (Judged(tuple(findings), unmet),)

    figures, remarks = _survey_figures(garage, alignment), surveyed_floor(garage).survey.remarks
    report = partial(make_report, garage, survey=figures, proofs=proofs, remarks=remarks)
    draw = partial(draw_pictures, garage)
    made = written(garage, path, seconds, draw=draw, judge=judge, report=report, progress=progress)
    return replace(made, proofs=proofs)


def _of_country(config: GarageConfig, survey: Survey) -> tuple[GarageConfig, Survey]:
    """Return settings with the profile of the country of a survey with coordinates, and a survey that says so."""
    if survey.origin_deg is None or "profile" in config.model_fields_set:
        return config, survey
    place = "{:.2f}, {:.2f}".format(*survey.origin_deg)
    name = profile_at(*survey.origin_deg)
    if name is None:
        told = f"no profile is of the country at {place} (latitude, longitude); {DEFAULT_PROFILE} is used"
    else:
        told = f"the profile {name} is used, that of the country at {place} (latitude, longitude)"
        config = config.with_usual_profile(name)
    return config, replace(survey, remarks=(*survey.remarks, told))


def surveyed_floor(garage: Garage) -> SurveyedFloor:
    """Return the source of an imported garage: its survey, its stalls, and the parts that could not be placed."""
    floor = garage.layout.source
    assert isinstance(floor, SurveyedFloor)
    return floor


def _origin(source: str | Path | Survey) -> Mapping[str, str]:
    """Return the name of an imported file and the digest of its bytes."""
    if isinstance(source, Survey):
        return {}
    return {"source": Path(source).name, "sourceDigest": hashlib.sha256(Path(source).read_bytes()).hexdigest()}


def _survey_figures(garage: Garage, alignment: Alignment) -> SurveyFigures:
    """Return the figures of an import for its report: source, frame, and parts that are missing or changed."""
    surveyed, lanes = surveyed_floor(garage), garage.lanes
    return SurveyFigures(
        source=garage.origin.get("source"),
        source_digest=garage.origin.get("sourceDigest"),
        turn_deg=round(math.degrees(alignment.turn_rad), 6),
        shift_m=alignment.shift_m,
        origin_deg=surveyed.survey.origin_deg,
        unplaced=tuple({"id": part.name, "reason": part.reason} for part in surveyed.unplaced),
        changed=tuple({"id": stall.source.name, "change": stall.note} for stall in surveyed.fitted if stall.note),
        lane_m=round(sum(lanes.length_m(edge.start, edge.end) for edge in lanes.edges), 2),
    )
