"""Import of existing layouts: a garage in metres, without a grid, from a map or a drawing."""

import hashlib
import math
import time
from collections.abc import Mapping, Sequence
from dataclasses import replace
from functools import partial
from itertools import pairwise
from pathlib import Path
from typing import cast

import networkx as nx

from garage2usd.as_built.garage import garage_as_made
from garage2usd.as_built.proofs import prove_built
from garage2usd.checks import judged_layout
from garage2usd.common.errors import ConfigError
from garage2usd.common.processes import without_collector
from garage2usd.common.progress import Progress, silent
from garage2usd.config import GarageConfig
from garage2usd.config.fittings import CEILING_ROOM_M
from garage2usd.driving import StallProof, prove_stalls
from garage2usd.garage.levels import level_places, places_at
from garage2usd.garage_model import Garage, GarageLevel
from garage2usd.layout.surveyed import FloorAbove, LevelPart, SurveyedFloor, lay_out_survey
from garage2usd.layout.surveyed.heights import LEAST_SLAB_M, level_config
from garage2usd.layout.surveyed.ramp_places import lanes_to_landings, placed_ramps, with_ramps_inside
from garage2usd.layout.surveyed.ramps import LevelRamps
from garage2usd.pipeline import Build, Judged, checked_output, with_things, written
from garage2usd.profiles import DEFAULT_PROFILE
from garage2usd.profiles.countries import profile_at
from garage2usd.reading.report import SurveyFigures
from garage2usd.report import make_report
from garage2usd.structure.building import Building
from garage2usd.survey.lots import in_lots
from garage2usd.survey.reader import read_building
from garage2usd.survey.survey import Alignment, Survey, Unplaced
from garage2usd.survey.surveyed_building import SurveyedBuilding, SurveyedLevel, aligned_building
from garage2usd.view.thumbnails import draw_pictures

_ROUNDING_M = 1e-6


@without_collector()
def import_layout(
    source: str | Path | Survey | SurveyedBuilding,
    output: str | Path,
    *,
    config: GarageConfig | None = None,
    level: str | None = None,
    proves: bool = True,
    progress: Progress = silent,
) -> Build:
    """Make a garage of an existing layout, and write its stage, plan, labels and report.

    Parameters
    ----------
    source
        A file: a Lanelet2 map or OpenStreetMap extract (``.osm``), OpenDRIVE (``.xodr``), GeoJSON (``.geojson``), IMDF
        (``.zip`` or its folder), a CAD drawing (``.dxf``), a building model (``.ifc``), a table of rectangles
        (``.csv``) or a drawing in metres (``.toml``); or a survey, or one of a building of several levels.
    output
        Path of the stage; ``.usda``, ``.usdc`` or ``.usdz``. The other files are written beside it under its name.
    config
        Fittings, parking, look and seed; site, bay, stalls and plan do not apply. The default ones if left out. If it
        gives no profile, that of the country counts where the source has geographic coordinates. Where the source has
        no heights of floors, levels are `building.storey_m` apart.
    level
        Name in the source of the only level to import. All levels if left out.
    proves
        True to prove for each stall that a car drives in and out, to put the proofs into the report, and to check the
        garage by the rules that need them.
    progress
        Called with the progress of long steps.

    Returns
    -------
    Build
        The garage and its files. `surveyed_floors` returns the parts of the source that the garage lacks.

    Raises
    ------
    ConfigError
        If the source or a setting is invalid, there is no such level, or none of the stalls can be placed.
    OutputError
        If the files cannot be written. They appear whole or not at all.
    """
    config = config or GarageConfig()
    checked_output(output, config)
    start = time.perf_counter()
    progress("reading", 0, 1)
    building = read_building(Path(source)) if isinstance(source, str | Path) else SurveyedBuilding.of(source)
    if level is not None:
        building = building.only(level)
    config, told = _of_country(config, building)
    garage, alignment, remarks = _laid_out(building, config, _origin(source), progress)
    remarks = (*told, *remarks)
    path = checked_output(output, config, places=garage.building.places)
    proofs: tuple[StallProof, ...] = ()
    if proves and len(garage.levels) == 1:
        proofs = prove_stalls(garage.layout, progress=progress)
    elif proves:
        proofs = prove_built(garage_as_made(garage, source=str(path), kind="a layout"), progress=progress)
    seconds = {"import": time.perf_counter() - start}

    def judge() -> tuple[Judged, ...]:
        judged = (judged_layout(each.layout, each.config, with_ways=proves) for each in garage.levels)
        return tuple(Judged(tuple(findings), unmet) for findings, unmet in judged)

    report = partial(make_report, garage, survey=_survey_figures(garage, alignment), proofs=proofs, remarks=remarks)
    draw = partial(draw_pictures, garage)
    made = written(garage, path, seconds, draw=draw, judge=judge, report=report, progress=progress)
    return replace(made, proofs=proofs, remarks=remarks)


def _of_country(config: GarageConfig, building: SurveyedBuilding) -> tuple[GarageConfig, tuple[str, ...]]:
    """Return settings with the profile of the country of a survey with coordinates, and the remark that says so."""
    origin_deg = next((level.survey.origin_deg for level in building.levels), None)
    if origin_deg is None or "profile" in config.model_fields_set:
        return config, ()
    place = "{:.2f}, {:.2f}".format(*origin_deg)
    name = profile_at(*origin_deg)
    if name is None:
        told = f"no profile is of the country at {place} (latitude, longitude); {DEFAULT_PROFILE} is used"
        return config, (told,)
    told = f"the profile {name} is used, that of the country at {place} (latitude, longitude)"
    return config.with_usual_profile(name), (told,)


def surveyed_floor(garage: Garage) -> SurveyedFloor:
    """Return the source of an imported garage of one level: its survey, its stalls, and parts that are not placed."""
    (floor,) = surveyed_floors(garage)
    return floor


def surveyed_floors(garage: Garage) -> tuple[SurveyedFloor, ...]:
    """Return the source of each level of an imported garage, as `surveyed_floor` does of an only one."""
    floors = tuple(level.layout.source for level in garage.levels)
    assert all(isinstance(floor, SurveyedFloor) for floor in floors)
    return cast("tuple[SurveyedFloor, ...]", floors)


def unplaced_parts(garage: Garage) -> tuple[Unplaced, ...]:
    """Return the parts of the source that an imported garage lacks, each once."""
    return tuple(dict.fromkeys(part for floor in surveyed_floors(garage) for part in floor.unplaced))


def _laid_out(
    building: SurveyedBuilding, config: GarageConfig, origin: Mapping[str, str], progress: Progress
) -> tuple[Garage, Alignment, tuple[str, ...]]:
    """Lay out the levels of a building, and return also how it was moved, and remarks on its levels."""
    building, remarks = _with_lanes(building)
    building, alignment = aligned_building(building)
    levels = building.levels
    floors_m, told = _floors_m(levels, config)
    storeys_m = [0.0, *(round(upper - lower, 6) for upper, lower in pairwise(floors_m))]
    heights = [
        level_config(config, number, storey_m, level.survey)
        for number, (level, storey_m) in enumerate(zip(levels, storeys_m, strict=True))
    ]
    configs = [settings for settings, _ in heights]
    ramps, unbuilt = placed_ramps(building, floors_m, configs)
    surveys = [
        replace(
            with_ramps_inside(level.survey, own),
            lanes=lanes_to_landings(level.survey.lanes, own.gates) if own.gates else level.survey.lanes,
            # numbers do not begin with the name of their level, which the whole garage adds
            stalls=tuple(replace(stall, number=place.own_name(stall.number)) for stall in level.survey.stalls)
            if len(levels) > 1
            else level.survey.stalls,
        )
        for level, own, place in zip(levels, ramps, places_at(floors_m), strict=True)
    ]
    has_street = _have_street(levels, ramps)
    found: list[GarageLevel] = []
    for number, (level, place) in enumerate(zip(levels, places_at(floors_m), strict=True)):
        above = None
        if number:
            above = FloorAbove(storeys_m[number], surveys[number - 1].ground, ramps[number - 1].openings)
        part = LevelPart(above, ramps[number], has_street=has_street[number])
        layout = lay_out_survey(surveys[number], configs[number], part=part)
        layout = with_things(layout, configs[number], progress=progress)
        found.append(GarageLevel(place, configs[number], layout, planned=None, source_name=level.name))
    structures = tuple(level.layout.structure for level in found)
    whole = Building(structures, None, config.building.storey_m, tuple(floors_m) if len(found) > 1 else None)
    frame = alignment.frame(levels[0].survey.origin_deg)
    garage = Garage(configs[0], whole, tuple(found), {**origin, **frame})
    of_levels = [
        remark if len(found) == 1 else f"level {level.source_name}: {remark}"
        for level, floor, (_, of_heights) in zip(found, surveyed_floors(garage), heights, strict=True)
        for remark in (*floor.survey.remarks, *of_heights)
    ]
    return garage, alignment, (*remarks, *told, *of_levels, *unbuilt, *_unjoined(garage))


def _with_lanes(building: SurveyedBuilding) -> tuple[SurveyedBuilding, list[str]]:
    """Return the levels that have stalls and lanes, those without lanes with derived ones; name the others."""
    if len(building.levels) == 1:
        (level,) = building.levels
        survey = in_lots(level.survey)
        return replace(building, levels=(replace(level, survey=survey),)), []
    levels, remarks = [], []
    for level in building.in_order:
        if not level.survey.stalls:
            remarks.append(f"level {level.name} is left out: it has no stall")
            continue
        try:
            levels.append(replace(level, survey=in_lots(level.survey)))
        except ConfigError as error:
            remarks.append(f"level {level.name} is left out: {error}")
    if not levels:
        raise ConfigError("levels", "; ".join(remarks), "a level that can be laid out")
    top, *lower = levels
    top = replace(top, survey=replace(top.survey, unread=(*top.survey.unread, *building.unread)))
    return replace(building, levels=(top, *lower)), remarks


def _floors_m(levels: Sequence[SurveyedLevel], config: GarageConfig) -> tuple[list[float], list[str]]:
    """Return the height of the floor of each level below the top one, as surveyed where that leaves room for cars."""
    heights_m = [level.height_m for level in levels]
    known = [height_m for height_m in heights_m if height_m is not None]
    least_m = config.fittings.clear_height_m + CEILING_ROOM_M + LEAST_SLAB_M
    remarks = []
    if len(known) == len(levels) > 1:
        storeys_m = [upper - lower for upper, lower in pairwise(known)]
        if min(storeys_m) > least_m - _ROUNDING_M:
            return [round(height_m - known[0], 3) + 0.0 for height_m in known], []
        placed_m, near_m = config.building.storey_m, min(storeys_m)
        needed = f"{least_m:.2f} m or more leave room for cars"
        remarks = [f"floors that are {near_m:.2f} m apart in the source are placed {placed_m:g} m apart: {needed}"]
    return [place.floor_m for place in level_places(len(levels), config.building.storey_m)], remarks


def _have_street(levels: Sequence[SurveyedLevel], ramps: Sequence[LevelRamps]) -> list[bool]:
    """Tell for each level if it has a door to the street: the ground level of those that ramps join, or the top one.

    Where the source has portals on one of these levels, the others have none.
    """
    joined: nx.Graph[int] = nx.Graph()
    joined.add_nodes_from(range(len(levels)))
    joined.add_edges_from((number, number + 1) for number, own in enumerate(ramps) if own.down)
    doors = set()
    for part in nx.connected_components(joined):
        if not any(levels[number].survey.portals for number in part):
            doors.add(min(part, key=lambda number: (levels[number].ordinal != 0, number)))
    return [number in doors for number in range(len(levels))]


def _unjoined(garage: Garage) -> list[str]:
    """Name the levels that no ramp joins with others."""
    parts = (floor.part.ramps for floor in surveyed_floors(garage))
    return [
        f"level {level.source_name} ({level.name}) is placed alone: no ramp of the source joins it with another level"
        for level, ramps in zip(garage.levels, parts, strict=True)
        if len(garage.levels) > 1 and not ramps.up and not ramps.down
    ]


def _origin(source: str | Path | Survey | SurveyedBuilding) -> Mapping[str, str]:
    """Return the name of an imported file or folder and the digest of its bytes."""
    if not isinstance(source, str | Path):
        return {}
    path, digest = Path(source), hashlib.sha256()
    for file in sorted(path.iterdir()) if path.is_dir() else [path]:
        digest.update(file.read_bytes() if file.is_file() else b"")
    return {"source": path.resolve().name, "sourceDigest": digest.hexdigest()}


def _survey_figures(garage: Garage, alignment: Alignment) -> SurveyFigures:
    """Return the figures of an import for its report: source, frame, and parts that are missing or changed."""
    floors, lanes = surveyed_floors(garage), garage.lanes
    notes = [(stall.source.name, stall.note) for floor in floors for stall in floor.fitted if stall.note]
    return SurveyFigures(
        source=garage.origin.get("source"),
        source_digest=garage.origin.get("sourceDigest"),
        turn_deg=round(math.degrees(alignment.turn_rad), 6),
        shift_m=alignment.shift_m,
        origin_deg=floors[0].survey.origin_deg,
        unplaced=tuple({"id": part.name, "reason": part.reason} for part in unplaced_parts(garage)),
        changed=tuple({"id": name, "change": note} for name, note in notes),
        lane_m=round(sum(lanes.length_m(edge.start, edge.end) for edge in lanes.edges), 2),
    )
