"""Garages of several levels: every level a garage of its own, linked by ramps; generated, and written as one stage.

The ramps are drawn first, from a random stream of their own. Each level is then planned by the planner of one level,
with the landings as its portals; the levels below take over R and C of the top one.
"""
# Over 300 lines: the whole road of several levels is told in one place, as the pipeline tells that of one.

import time
from collections.abc import Iterator
from dataclasses import dataclass, replace
from functools import cached_property
from itertools import pairwise
from pathlib import Path

import numpy as np

from garage2usd.as_built.levels import laid_out_levels
from garage2usd.checks import Finding, judged_layout
from garage2usd.common.errors import ConfigError, GenerationError
from garage2usd.common.json_text import json_text
from garage2usd.common.output import check_file, check_name, check_writable, publish_at, staging_folder
from garage2usd.common.processes import without_collector
from garage2usd.common.progress import Progress, silent
from garage2usd.common.randomness import Step, derived_seed
from garage2usd.common.version import VERSION
from garage2usd.config import BayConfig, GarageConfig
from garage2usd.config.building import BuildingConfig
from garage2usd.garage.joined_levels import JoinedLevels, LevelLanes, RampLane, join_levels, unreached_stalls
from garage2usd.layout.egress.exits import plan_egress
from garage2usd.layout.egress.shafts import LevelPlan
from garage2usd.layout.shell.well import SLAB_M
from garage2usd.layout.shell.wells import make_well
from garage2usd.maps.level_drives import LevelsDrivePlanner
from garage2usd.pipeline import Garage, laid_out, lane_squares_of, planned, stage_metadata
from garage2usd.planning import Plan, evaluate, tape_of
from garage2usd.planning.dimensions import aisle_side_mm, lines_with_aisles
from garage2usd.reading.levels_report import LevelReport, LevelsReport, ReportedLink
from garage2usd.reading.report import UnmetClause
from garage2usd.report import area_figures, make_report
from garage2usd.site.level_ramps import ramps_are_free, ramps_of_tape, with_ramps_room
from garage2usd.site.levels import LevelSites, make_level_sites, make_street_site
from garage2usd.stage import StageFormat, shared_folder
from garage2usd.stage.levels import LevelLayout, write_level_labels, write_levels_stage
from garage2usd.structure.building import Building, level_name
from garage2usd.structure.grid import Structure
from garage2usd.view.plan_picture import draw_plan
from garage2usd.view.raster import to_image, write_png

__all__ = [
    "LevelsBuild",
    "LevelsGarage",
    "build_levels",
    "generate_levels",
    "levels_metadata",
    "levels_report",
]

_TAPE_JOINT = "/"
_ATTEMPTS = 4
"""Most places of the ramps that are tried until cars reach every stall: some leave no room to turn before a ramp."""
_MOST_CHECKED_STALLS = 10_000
_NAMED_STALLS = 6


@dataclass(frozen=True, eq=False)
class LevelsGarage:
    """A garage of several levels.

    Attributes
    ----------
    config
        The settings of the whole.
    building
        S of each level, R and C of all, and the ramps.
    levels
        Each level as a garage of its own whose landings are portals, the top one first.
    """

    config: GarageConfig
    building: Building
    levels: tuple[Garage, ...]

    @cached_property
    def joined(self) -> JoinedLevels:
        """Lanes and stalls of the whole garage."""
        return _joined(self.building, self.levels)

    @property
    def layouts(self) -> list[LevelLayout]:
        """Layout, floor and description of each level, as its stage is written from."""
        return [
            LevelLayout(name, self.building.floor_m(number), level.layout, stage_metadata(level))
            for number, (name, level) in enumerate(zip(self.building.names(), self.levels, strict=True))
        ]

    @property
    def tape(self) -> str:
        """Canonical random process of the garage: the ramps, then the tape of each level, with slashes between."""
        return _TAPE_JOINT.join([self.building.ramps.tape, *(tape_of(structure) for structure in self.building.levels)])

    @property
    def parking_stalls(self) -> int:
        """Number of stalls that cars park in, on all levels."""
        return sum(level.layout.parking_stalls for level in self.levels)


@dataclass(frozen=True, eq=False)
class LevelsBuild:
    """A garage of several levels written to files.

    Attributes
    ----------
    garage
        The garage.
    stage, report, labels
        The stage, the JSON report, and the JSON table of all objects with their classes.
    pictures
        The picture of each level's plan, the top one first.
    asset_folder
        Folder of the levels' layers and assets; None where the stage holds them itself.
    shared_assets
        Folder of the assets that it shares with other stages; None where it has its own.
    seconds
        Seconds that each step took.
    findings
        Findings of the quick rules on each level, errors first; None for more than 10,000 stalls.
    unmet
        The clauses of its profile that each level is not designed to; None likewise.
    """

    garage: LevelsGarage
    stage: Path
    report: Path
    labels: Path
    pictures: tuple[Path, ...]
    asset_folder: Path | None
    shared_assets: Path | None
    seconds: dict[str, float]
    findings: tuple[tuple[Finding, ...], ...] | None
    unmet: tuple[tuple[UnmetClause, ...], ...] | None


def generate_levels(
    config: GarageConfig, *, seed: int | None = None, tape: str | None = None, progress: Progress = silent
) -> LevelsGarage:
    """Make a garage of several levels.

    Parameters
    ----------
    config
        Its settings, with ``building.levels`` of 2 or more.
    seed
        Takes the place of the configuration's seed.
    tape
        The tape of such a garage, as its report has it: ramps and lanes are made again instead of drawn and learnt.
    progress
        Told how far long steps are.

    Raises
    ------
    ConfigError
        If a setting cannot be used, or not together with several levels.
    GenerationError
        If a random step found no valid result, such as a place for the ramps from and to which cars reach every stall;
        names the step and the seed.
    UnreachableStallError
        If a level leaves stalls without a lane.
    """
    return _generate(config, seed=seed, tape=tape, progress=progress)[0]


@without_collector()
def build_levels(
    config: GarageConfig,
    output: str | Path = "garage.usdz",
    *,
    seed: int | None = None,
    tape: str | None = None,
    progress: Progress = silent,
) -> LevelsBuild:
    """Make a garage of several levels and write its stage, a picture of each level's plan, its labels and its report.

    Parameters
    ----------
    config, seed, tape, progress
        As for `generate_levels`.
    output
        The stage's path; ``.usda``, ``.usdc`` or ``.usdz``. Pictures, report, labels and assets go beside it, under its
        name.

    Raises
    ------
    ConfigError, GenerationError, UnreachableStallError
        As `generate_levels`, and if the extension is unknown.
    OutputError
        If the files cannot be written. They appear whole or not at all.
    """
    path = Path(output)
    if path.suffix.lower() not in set(StageFormat) or not path.stem:
        raise ConfigError("output", str(output), f"a path that ends in {', '.join(StageFormat)}")
    check_name(path, of_layer=True)
    names = [level_name(level) for level in range(config.building.levels)]
    beside = [*(f"{name}_plan.png" for name in names), "labels.json", "report.json"]
    check_file(path, with_it=(path.with_name(f"{path.stem}_{name}") for name in beside))
    if shared := shared_folder(path, config.stage):
        check_writable(shared)
    garage, seconds = _generate(config, seed=seed, tape=tape, progress=progress)
    with staging_folder(path) as staging:
        start = time.perf_counter()
        folder = staging / "stage"
        folder.mkdir()
        levels = garage.layouts
        made = write_levels_stage(
            levels,
            garage.joined,
            folder / f"{path.stem}{path.suffix.lower()}",
            metadata=levels_metadata(garage),
            config=garage.config.stage,
            shared=shared,
            progress=progress,
        )
        labels = staging / f"{path.stem}_labels.json"
        write_level_labels(levels, labels, garage.config.stage)
        drawn = [staging / f"{path.stem}_{name}_plan.png" for name in names]
        for picture, level in zip(drawn, garage.levels, strict=True):
            write_png(to_image(draw_plan(level.layout)), picture)
        seconds["stage"] = time.perf_counter() - start
        start = time.perf_counter()
        judged = None
        if garage.parking_stalls <= _MOST_CHECKED_STALLS:
            judged = [judged_layout(level.layout, level.config) for level in garage.levels]
        seconds["check"] = time.perf_counter() - start
        report = staging / f"{path.stem}_report.json"
        unmet = None if judged is None else [clauses for _, clauses in judged]
        report.write_text(
            json_text(levels_report(garage, seconds, unmet).model_dump(mode="json")), encoding="utf-8", newline="\n"
        )
        progress("files", 0, 1)
        files = [*filter(None, [made.assets]), *drawn, labels, report]
        place_of = {file: path.with_name(file.name) for file in files} | {made.stage: path}
        publish_at(place_of)
    return LevelsBuild(
        garage=garage,
        stage=place_of[made.stage],
        report=place_of[report],
        labels=place_of[labels],
        pictures=tuple(place_of[picture] for picture in drawn),
        asset_folder=place_of[made.assets] if made.assets else None,
        shared_assets=shared,
        seconds=seconds,
        findings=None if judged is None else tuple(tuple(findings) for findings, _ in judged),
        unmet=None if unmet is None else tuple(unmet),
    )


def _generate(
    config: GarageConfig, *, seed: int | None, tape: str | None, progress: Progress
) -> tuple[LevelsGarage, dict[str, float]]:
    if seed is not None:
        config = config.with_seed(seed)
    seconds = dict.fromkeys(("site", "plan", "layout"), 0.0)
    if tape is not None:
        garage = _planned(config, tape, 0, seconds, progress)
        if unreached := unreached_stalls(garage.joined, may_turn_back=True):
            raise ConfigError("tape", tape, f"ramps and lanes without {_unreached_in_words(unreached)}")
        return garage, seconds
    tight: list[LevelsGarage] = []
    for garage in _drawn(config, seconds, progress):
        if not unreached_stalls(garage.joined, may_turn_back=False):
            return garage, seconds
        tight.append(garage)
    # cars turn back at once on the way to some stalls, if there is the room
    for garage in tight:
        if _is_driven_through(garage):
            return garage, seconds
    lack = _unreached_in_words(unreached_stalls(tight[0].joined, may_turn_back=False))
    place, tried = config.building.place, len(tight)
    if place is not None:
        wanted = f"a place with room to turn before the ramps, without {lack}"
        raise ConfigError("building.place", place.model_dump(exclude_none=True), wanted)
    reason = f"none of {tried} places of the ramps has room to turn before them; {lack}; a larger site has more places"
    raise GenerationError("links", reason, seed=config.seed, attempts=tried)


def _drawn(config: GarageConfig, seconds: dict[str, float], progress: Progress) -> Iterator[LevelsGarage]:
    """Yield garages with the ramps drawn at one place after the other, or at the given place."""
    for attempt in range(1 if config.building.place else _ATTEMPTS):
        try:
            garage = _planned(config, None, attempt, seconds, progress)
        except GenerationError:
            if not attempt:
                raise
            return
        yield garage


def _is_driven_through(garage: LevelsGarage) -> bool:
    """Return True if the design car drives from the street to the lowest level, and back."""
    built = laid_out_levels(garage.layouts, garage.joined, source="a layout")
    return LevelsDrivePlanner(built).is_driven_through()


def _unreached_in_words(stalls: list[str]) -> str:
    named = ", ".join(stalls[:_NAMED_STALLS]) + (", ..." if len(stalls) > _NAMED_STALLS else "")
    return f"stalls without a way from the street and to it: {named}"


def _planned(
    config: GarageConfig, tape: str | None, attempt: int, seconds: dict[str, float], progress: Progress
) -> LevelsGarage:
    """Plan and lay out all levels; the time that each step takes is added to `seconds`."""
    clock = [time.perf_counter()]
    sites, tapes = _sites_and_tapes(config, tape, attempt)
    clock.append(time.perf_counter())
    plans = _plans(sites, config, tapes, progress)
    clock.append(time.perf_counter())
    garage = _laid_out(sites, config, plans, progress)
    clock.append(time.perf_counter())
    for step, (begin, end) in zip(seconds, pairwise(clock), strict=True):
        seconds[step] += end - begin
    return garage


def _laid_out(
    sites: LevelSites, config: GarageConfig, plans: list[tuple[Plan, GarageConfig]], progress: Progress
) -> LevelsGarage:
    """Lay out all levels around the ramps, with stair cores above one another."""
    ramps = sites.ramps
    building = Building(tuple(plan.structure for plan, _ in plans), ramps, config.building.storey_m)
    graphs = [lane_squares_of(plan, of_level) for plan, of_level in plans]
    egresses = plan_egress(
        [LevelPlan(plan.structure, graph, of) for (plan, of), graph in zip(plans, graphs, strict=True)], ramps.squares
    )
    levels = []
    for number, ((plan, of_level), graph, egress) in enumerate(zip(plans, graphs, egresses, strict=True)):
        well = make_well(ramps, number, config)
        static = plan.structure.with_cells(sites.cells(number))
        levels.append(laid_out(static, plan, of_level, graph, well=well, egress=egress, progress=progress))
    return LevelsGarage(config, building, tuple(levels))


def _sites_and_tapes(config: GarageConfig, tape: str | None, attempt: int) -> tuple[LevelSites, list[str | None]]:
    """Make the sites of the levels and their tapes; ramps are read, or drawn, in each attempt at another place."""
    levels = config.building.levels
    if tape is None:
        return make_level_sites(config, attempt), [None] * levels
    street = make_street_site(config)
    links, *tapes = tape.split(_TAPE_JOINT)
    wanted = f"the tape of {config.building.ramps} ramps and the tapes of {levels} levels, joined by {_TAPE_JOINT}"
    try:
        ramps = ramps_of_tape(links, config)
    except (ValueError, KeyError):
        raise ConfigError("tape", tape, wanted) from None
    if len(tapes) != levels or not ramps_are_free(street.cells, ramps, levels):
        raise ConfigError("tape", tape, f"{wanted}, on free squares of the site")
    return LevelSites(street, ramps, levels), list(tapes)


def _plans(
    sites: LevelSites, config: GarageConfig, tapes: list[str | None], progress: Progress
) -> list[tuple[Plan, GarageConfig]]:
    """Plan all levels, the lower ones on R and C of the top one; each comes with its settings.

    Where R and C are chosen, lines along which only a lower level has an aisle are widened for it on all levels.
    """
    found: list[tuple[Plan, GarageConfig]] = []
    bay = config.bay
    for level, tape in enumerate(tapes):
        seed = derived_seed(config.seed, Step.LEVELS, level) if level else config.seed
        changes = {"seed": seed, "building": BuildingConfig(), "bay": bay}
        of_level = config.model_copy(update=changes)
        sides = found[0][0].structure if found else sites.street
        static = sides.with_cells(sites.cells(level))
        plan = planned(static, of_level, tape=tape, progress=progress)
        if not found:
            bay = _fixed(bay, plan.structure)
        found.append((plan, of_level))
    sides = with_ramps_room(_with_aisles([plan.structure for plan, _ in found], config.bay), sites.ramps, config)
    bay = _fixed(bay, sides)
    return [(_on_sides(plan, sides, bay, config), of.model_copy(update={"bay": bay})) for plan, of in found]


def _with_aisles(levels: list[Structure], bay: BayConfig) -> Structure:
    """Return the top level with lines of squares wide enough for the aisles of all levels, where sides are chosen."""
    top = levels[0]
    sides = [top.row_depths_mm.copy(), top.column_widths_mm.copy()]
    for level in levels[1:]:
        for axis, (is_chosen, are_aisles) in enumerate(zip(bay.chosen_sides, lines_with_aisles(level), strict=True)):
            if is_chosen:
                sides[axis][are_aisles] = np.maximum(sides[axis][are_aisles], aisle_side_mm(bay))
    return Structure(top.cells, sides[1], sides[0])


def _on_sides(plan: Plan, sides: Structure, bay: BayConfig, config: GarageConfig) -> Plan:
    """Return a plan with the sides of another structure."""
    structure = sides.with_cells(plan.structure.cells)
    if structure == plan.structure:
        return plan
    return replace(plan, structure=structure, score=evaluate(structure, bay=bay, plan=config.plan))


def _fixed(bay: BayConfig, structure: Structure) -> BayConfig:
    """Return the sizes with R and C given."""
    sides = {
        "column_widths_m": tuple((structure.column_widths_mm / 1000).tolist()),
        "row_depths_m": tuple((structure.row_depths_mm / 1000).tolist()),
    }
    return bay.model_copy(update=sides)


def _joined(building: Building, levels: tuple[Garage, ...]) -> JoinedLevels:
    """Join the lanes of all levels by the ramps."""
    of_levels = [
        LevelLanes(
            name, building.floor_m(number), level.layout.lane_graph, level.layout.quads, level.layout.node_squares()
        )
        for number, (name, level) in enumerate(zip(building.names(), levels, strict=True))
    ]
    ramps = []
    for lower in range(1, len(levels)):
        layout = levels[lower].layout
        lanes = layout.well.lanes(layout.structure) if layout.well else ()
        for link, lane in zip(building.ramps.links, lanes, strict=True):
            head = lower - 1, levels[lower - 1].graph.number_of[link.head]
            foot = lower, levels[lower].graph.number_of[link.foot]
            start, end = (head, foot) if link.is_down else (foot, head)
            floor_m = building.floor_m(lower)
            points = tuple((x, round(floor_m + height, 6), z) for x, height, z in lane.points)
            squares = tuple(_square_of(layout.structure, link.squares, x, z) for x, _, z in points)
            ramps.append(RampLane(start, end, points, squares, lower, lane.width_m))
    return join_levels(of_levels, ramps)


def _square_of(structure: Structure, squares: tuple[tuple[int, int], ...], x: float, z: float) -> tuple[int, int]:
    """Return the square of a ramp that a point lies on, the nearest one at an end."""
    edges_x, edges_z = structure.column_edges_m, structure.row_edges_m
    middles = [((edges_x[col] + edges_x[col + 1]) / 2, (edges_z[row] + edges_z[row + 1]) / 2) for row, col in squares]
    far = [abs(mid_x - x) + abs(mid_z - z) for mid_x, mid_z in middles]
    return squares[int(np.argmin(far))]


def levels_metadata(garage: LevelsGarage) -> dict[str, str | int]:
    """Describe how the garage was made, for its stage."""
    return {
        "generator": "garage2usd",
        "version": VERSION,
        "seed": garage.config.seed,
        "configDigest": garage.config.digest(),
        "profile": garage.config.standard.name,
    }


def levels_report(
    garage: LevelsGarage, seconds: dict[str, float], unmet: list[tuple[UnmetClause, ...]] | None
) -> LevelsReport:
    """Make the report; it is reproducible, except for ``seconds``.

    Parameters
    ----------
    garage
        The garage.
    seconds
        Duration of each step in seconds.
    unmet
        Clauses of the profile that the design of each level violates; None if unknown.
    """
    building, names = garage.building, garage.building.names()
    clear_m = min(garage.config.fittings.ceiling_height_m, building.storey_m - SLAB_M)
    links = []
    for upper, lower in pairwise(range(len(names))):
        layout = garage.levels[lower].layout
        lanes = layout.well.lanes(layout.structure) if layout.well else ()
        links += [
            ReportedLink(
                kind=link.kind,
                upper=names[upper],
                lower=names[lower],
                direction="down" if link.is_down else "up",
                squares=link.squares,
                head=link.head,
                foot=link.foot,
                rise_m=building.storey_m,
                run_m=round(lane.run_m, 6),
                steepest_percent=round(100 * lane.slope, 3),
                clear_width_m=lane.width_m,
                clear_height_m=round(clear_m, 6),
            )
            for link, lane in zip(building.ramps.links, lanes, strict=True)
        ]
    return LevelsReport(
        version=VERSION,
        seed=garage.config.seed,
        config_digest=garage.config.digest(),
        config=garage.config,
        tape=garage.tape,
        parking_stalls=garage.parking_stalls,
        **area_figures([level.layout for level in garage.levels]),
        remarks=garage.config.remarks(),
        links=tuple(links),
        levels=tuple(
            LevelReport(
                name=name,
                floor_m=building.floor_m(number),
                report=make_report(
                    config=level.config,
                    plan=level.plan,
                    layout=level.layout,
                    seconds={},
                    unmet=None if unmet is None else unmet[number],
                ),
            )
            for number, (name, level) in enumerate(zip(names, garage.levels, strict=True))
        ),
        seconds={step: round(value, 4) for step, value in seconds.items()},
    )
