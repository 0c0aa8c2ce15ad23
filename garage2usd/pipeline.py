"""The pipeline from a configuration to plans, layouts, a stage and its files, for any number of levels."""
# Over 300 lines: all steps from a configuration to the files stand together.

import logging
import time
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager, suppress
from dataclasses import dataclass, replace
from functools import partial
from pathlib import Path

from PIL import Image

from garage2usd.as_built.garage import garage_as_made
from garage2usd.checks import Finding, judged_layout
from garage2usd.checks.swept_path import design_car
from garage2usd.common.documents import json_text
from garage2usd.common.errors import ConfigError, Garage2UsdError, GenerationError, OutputError
from garage2usd.common.output import check_file, check_name, check_writable, publish_at, staging_folder
from garage2usd.common.processes import run_in_forks, without_collector
from garage2usd.common.progress import Progress, counted, silent, time_in_words
from garage2usd.config import GarageConfig
from garage2usd.config.plan import UnreachableStalls
from garage2usd.config.site import BayConfig
from garage2usd.driving import DesignCar, StallProof, with_clutter, with_truth_of_misparked, without_unreachable
from garage2usd.driving.layout_garage import refuse_undrivable
from garage2usd.garage import StallKind
from garage2usd.garage.levels import LevelPlace, level_places, unreached_stalls
from garage2usd.garage_model import Garage, GarageLevel, PlannedParts
from garage2usd.layout import Layout, lay_out
from garage2usd.layout.egress.exits import Egress, plan_egress
from garage2usd.layout.egress.shafts import LevelPlan
from garage2usd.layout.parking.stalls import tight_stalls
from garage2usd.layout.shell.wells import make_well
from garage2usd.level_plans import ATTEMPTS, PlannedLevel, lane_squares_of, plan_levels, sites_and_tapes, sites_of_plans
from garage2usd.maps.drives import DrivePlanner
from garage2usd.planning import Plan
from garage2usd.reading.report import Report, UnmetClause
from garage2usd.report import make_report, write_report
from garage2usd.site.levels import LevelSites
from garage2usd.stage import StageFormat, shared_folder, write_labels, write_stage
from garage2usd.structure.building import Building
from garage2usd.structure.grid import Structure
from garage2usd.structure.lane_graph import LaneSquares
from garage2usd.view.drawing import write_png
from garage2usd.view.notebook import garage_html
from garage2usd.view.thumbnails import draw_pictures, draw_structures

_LOG = logging.getLogger(__name__)
_MOST_CHECKED_STALLS = 10_000
_NAMED_STALLS = 6
_ROUNDING_M = 1e-3
_PICTURES = ("plan", "learning", "best")


@dataclass(frozen=True)
class Judged:
    """Result of the quick rules on a level under its profile (see `garage2usd.checks.check_layout`).

    Attributes
    ----------
    findings
        The findings, errors first.
    unmet
        The clauses that the level violates, and those that no rule can check on it.
    """

    findings: tuple[Finding, ...]
    unmet: tuple[UnmetClause, ...]


@dataclass(frozen=True, eq=False)
class Build:
    """A garage written to files.

    Attributes
    ----------
    garage
        The garage.
    stage, report, labels
        The stage, the JSON report, and the JSON table of all objects with their classes.
    pictures
        Picture of the plan of each level, the top level first; if requested, the learning curve and the best plans of
        the level follow it.
    asset_folder
        Folder of the stage's own layers, and of its assets unless they are shared; None if the stage is a single file.
    shared_assets
        Folder of the assets that are shared with other stages; None if the assets are the stage's own.
    seconds
        Duration of each step in seconds.
    judged
        Result of the quick rules on each level; None for more than 10,000 stalls, which would take too long.
    proofs
        For each stall of an imported garage that takes cars, whether a car drives in and out; empty unless requested.
    remarks
        Remarks on the levels of an imported garage.
    """

    garage: Garage
    stage: Path
    report: Path
    labels: Path
    pictures: tuple[Path, ...]
    asset_folder: Path | None
    shared_assets: Path | None
    seconds: dict[str, float]
    judged: tuple[Judged, ...] | None = None
    proofs: tuple[StallProof, ...] = ()
    remarks: tuple[str, ...] = ()

    def _repr_html_(self) -> str:
        """Draw the garage for a notebook, with the files, the duration and the findings."""
        found = "too many stalls to check" if self.findings is None else f"{len(self.findings)} findings"
        made = f"{self.stage} in {time_in_words(sum(self.seconds.values()))}, {found}"
        return garage_html(self.garage, lines=[made])

    @property
    def findings(self) -> tuple[Finding, ...] | None:
        """The findings on all levels, errors first; with several levels, places are paths in the whole stage."""
        if self.judged is None:
            return None
        found = [
            replace(finding, place=level.place.path_in_whole(finding.place))
            for level, judged in zip(self.garage.levels, self.judged, strict=True)
            for finding in judged.findings
        ]
        return tuple(sorted(found, key=Finding.sort_key))

    @property
    def unmet(self) -> tuple[UnmetClause, ...] | None:
        """The clauses of `Judged.unmet` of all levels; with several levels, reasons begin with the level's name."""
        if self.judged is None:
            return None
        return tuple(
            entry.model_copy(update={"reason": level.place.in_whole(entry.reason, joint=": ")})
            for level, judged in zip(self.garage.levels, self.judged, strict=True)
            for entry in judged.unmet
        )


def generate(
    config: GarageConfig | None = None,
    *,
    seed: int | None = None,
    tape: str | None = None,
    plan: Plan | Sequence[Plan] | None = None,
    jobs: int = 1,
    progress: Progress = silent,
) -> Garage:
    """Generate a garage of one level or, with ``building.levels``, of several levels.

    Parameters
    ----------
    config
        Settings; the default garage if left out.
    seed
        Seed; overrides that of the configuration.
    tape
        Tape of a plan, from its report. Its lanes, directions and stalls are replayed on the site instead of being
        learnt and drawn. If a tape has lanes alone, the settings decide the rest. The tape of several levels has the
        ramps and the lanes of each level.
    plan
        Earlier plan for these settings and this seed, one for each level; replaces tape and learning.
    jobs
        Maximum number of levels that are planned and laid out at the same time, each in a fork of this process. The
        garage does not depend on it.
    progress
        Called with the progress of long steps.

    Raises
    ------
    ConfigError
        If a setting is invalid, or cannot be combined with several levels.
    GenerationError
        If a random step finds no valid result, for example no place for the ramps over which cars reach every stall;
        names the step and the seed.
    UnreachableStallError
        If a stall of a given structure has no route from an entrance, or none to an exit.
    """
    plans = [plan] if isinstance(plan, Plan) else plan
    return _generate(config or GarageConfig(), seed=seed, tape=tape, plans=plans, jobs=jobs, progress=progress)[0]


def generate_plan(config: GarageConfig, *, progress: Progress = silent) -> Plan:
    """Generate the plan of a garage of one level, with directions and stalls; raises as `generate`."""
    (planned,) = plan_levels(*_sites(config, None, None, 0), progress=progress)
    lane_squares_of(planned.plan, config)
    return planned.plan


@without_collector()
def build(
    config: GarageConfig | None = None,
    output: str | Path = "garage.usdz",
    *,
    seed: int | None = None,
    tape: str | None = None,
    learning_curve: bool = False,
    best_plans: int = 0,
    jobs: int = 1,
    progress: Progress = silent,
) -> Build:
    """Generate a garage and write its stage, the pictures of its plans, its labels and its report.

    Parameters
    ----------
    config, seed, tape, jobs, progress
        As for `generate`.
    output
        Path of the stage; ``.usda``, ``.usdc`` or ``.usdz``. Pictures, report, labels and assets are written beside it
        and begin with its name; with several levels, pictures also have the name of their level, ``_U1_plan.png``.
    learning_curve
        True to draw the return of each episode.
    best_plans
        Number of the best plans of each level to draw side by side; 0 for no such picture.

    Raises
    ------
    ConfigError
        If a setting is invalid, the extension is unknown, or pictures of learning are requested for a given plan.
    GenerationError, UnreachableStallError
        As `generate`.
    OutputError
        If the files cannot be written. Either all files appear or none.

    Notes
    -----
    If generation fails after the lanes were planned, ``garage_failed_plan.json`` holds S, R and C of the plan, which
    `check` reads, and ``garage_failed_plan.png`` shows it; the attribute ``kept`` of the error lists these files.
    """
    config = config or GarageConfig()
    path = checked_output(output, config)
    with _keeping_plans(path):
        garage, seconds = _generate(config, seed=seed, tape=tape, jobs=jobs, progress=progress)
    draw = partial(draw_pictures, garage, learning_curve=learning_curve, best_plans=best_plans)

    judge, report = partial(_judged, garage), partial(make_report, garage)
    return written(garage, path, seconds, draw=draw, judge=judge, report=report, progress=progress)


def checked_output(output: str | Path, config: GarageConfig, *, places: Sequence[LevelPlace] = ()) -> Path:
    """Check that a stage and the files beside it can be written, and return its path; raises as `build`.

    Its levels are at `places`, or else as many as the settings tell.
    """
    path = Path(output)
    if path.suffix.lower() not in set(StageFormat) or not path.stem:
        raise ConfigError("output", str(output), f"a path that ends in {', '.join(StageFormat)}")
    check_name(path, of_layer=True)
    check_file(path, with_it=(path.with_name(f"{path.stem}_{name}") for name in _names_beside(config, places)))
    if shared := shared_folder(path, config.stage):
        check_writable(shared)
    return path


def written(
    garage: Garage,
    path: Path,
    seconds: dict[str, float],
    *,
    draw: Callable[[], Mapping[str, Image.Image]],
    judge: Callable[[], tuple[Judged, ...] | None],
    report: Callable[..., Report],
    progress: Progress = silent,
) -> Build:
    """Write the files of a garage; either all of them appear or none.

    Parameters
    ----------
    garage
        The garage.
    path
        Path of the stage, from `checked_output`.
    seconds
        Duration of each earlier step in seconds; the steps of writing are added.
    draw
        Function that returns the pictures by name.
    judge
        Function that checks each level against its profile.
    report
        `garage2usd.report.make_report` of the garage, which is given ``seconds`` and ``unmet``.
    progress
        As for `build`.
    """
    shared = shared_folder(path, garage.config.stage)
    with staging_folder(path) as staging:
        with _timed(seconds, "stage") as told:
            pictures = draw()
            drawn = [staging / f"{path.stem}_{name}.png" for name in pictures]
            for picture, image in zip(drawn, pictures.values(), strict=True):
                write_png(image, picture)
            folder = staging / "stage"
            folder.mkdir()
            place = folder / f"{path.stem}{path.suffix.lower()}"
            made = write_stage(garage, place, shared=shared, progress=progress)
            labels = staging / f"{path.stem}_labels.json"
            write_labels(garage, labels)
            told.append(f"{place.name}, its labels and {len(drawn)} pictures")
        with _timed(seconds, "check") as told:
            judged = judge()
            told.append(
                "too many stalls" if judged is None else f"{sum(len(each.findings) for each in judged)} findings"
            )
        facts = staging / f"{path.stem}_report.json"
        unmet = None if judged is None else [each.unmet for each in judged]
        write_report(facts, report(seconds=seconds, unmet=unmet))
        progress("files", 0, 1)
        # the stage is published last: once it exists, all other files do
        files = [*filter(None, [made.assets]), *drawn, labels, facts]
        place_of = {file: path.with_name(file.name) for file in files} | {made.stage: path}
        publish_at(place_of)
    return Build(
        garage=garage,
        stage=place_of[made.stage],
        report=place_of[facts],
        labels=place_of[labels],
        pictures=tuple(place_of[picture] for picture in drawn),
        asset_folder=place_of[made.assets] if made.assets else None,
        shared_assets=shared,
        seconds=seconds,
        judged=judged,
    )


def _names_beside(config: GarageConfig, places: Sequence[LevelPlace]) -> Iterator[str]:
    """Yield the names of the files that may be written beside a stage, without ``STEM_``."""
    for place in places or level_places(config.building.levels, config.building.storey_m):
        for picture in _PICTURES:
            yield place.in_whole(f"{picture}.png", joint="_")
    yield "labels.json"
    yield "report.json"


def _generate(
    config: GarageConfig,
    *,
    seed: int | None,
    tape: str | None,
    plans: Sequence[Plan] | None = None,
    jobs: int = 1,
    progress: Progress,
) -> tuple[Garage, dict[str, float]]:
    if seed is not None:
        config = config.with_seed(seed)
    seconds = dict.fromkeys(("site", "plan", "layout"), 0.0)
    is_given = tape is not None or plans is not None
    tight: list[Garage] = []
    lacks: list[str] = []
    for attempt in range(1 if is_given or config.building.place else ATTEMPTS):
        try:
            garage = _made(config, tape, plans, attempt, seconds, jobs, progress)
        except GenerationError:
            if not attempt:
                raise
            break
        # routes on a single level are proven earlier, when its lane graph is built
        unreached = unreached_stalls(garage.joined, may_turn_back=is_given) if garage.building.links else []
        if not unreached:
            return garage, seconds
        tight.append(garage)
        lacks.append(_unreached_in_words(unreached))
        _LOG.info("ramps at place %d: %s", attempt + 1, lacks[-1])
    lack = lacks[0]
    if is_given:
        raise ConfigError("tape", tape, f"ramps and lanes without {lack}")
    # routes on which cars turn back at once will do if the design car has room for them
    for garage in tight:
        if DrivePlanner(garage_as_made(garage, source="a layout", kind="layout")).is_driven_through():
            return garage, seconds
    place, tried = config.building.place, len(tight)
    if place is not None:
        wanted = f"a place with room to turn before the ramps, without {lack}"
        raise ConfigError("building.place", place.model_dump(exclude_none=True), wanted)
    reason = f"none of {tried} places of the ramps has room to turn before them; {lack}; a larger site has more places"
    with _telling_plans(tight[0].building.levels):
        raise GenerationError("links", reason, seed=config.seed, attempts=tried)


def _made(
    config: GarageConfig,
    tape: str | None,
    plans: Sequence[Plan] | None,
    attempt: int,
    seconds: dict[str, float],
    jobs: int,
    progress: Progress,
) -> Garage:
    """Plan and lay out all levels, and add the duration of each step to `seconds`."""
    with _timed(seconds, "site") as told:
        sites, config, tapes = _sites(config, tape, plans, attempt)
        rows, cols = sites.street.shape
        told.append(f"{rows} x {cols} squares")
        if sites.ramps is not None:
            told.append(f"ramps {sites.ramps.in_words}")
    with _timed(seconds, "plan") as told:
        planned = plan_levels(sites, config, tapes, given=plans or (), jobs=jobs, progress=progress)
        told.extend(f"{plan.score.stalls} stalls at a score of {plan.score.value:.2f}" for plan, _, _ in planned)
    with _timed(seconds, "layout") as told, _telling_plans([each.plan.structure for each in planned]):
        garage = _laid_out(sites, config, planned, jobs, progress)
        told.append(f"{garage.parking_stalls} stalls to park in, {len(garage.levels)} level(s)")
    return garage


@contextmanager
def _telling_plans(structures: Sequence[Structure]) -> Iterator[None]:
    """Attach the plans of all levels to an error that ends the garage."""
    try:
        yield
    except Garage2UsdError as error:
        names = (place.in_whole("plan", joint="_") for place in level_places(len(structures), 0.0))
        error.plans = dict(zip(names, structures, strict=True))
        raise


@contextmanager
def _keeping_plans(path: Path) -> Iterator[None]:
    """Write the plans attached to an error beside the place of the stage."""
    try:
        yield
    except Garage2UsdError as error:
        with suppress(OutputError), staging_folder(path) as staging:
            places: dict[Path, Path] = {}
            for name, each in error.plans.items():
                file = staging / f"{path.stem}_failed_{name}.json"
                matrices = {"S": str(each).splitlines(), "R": each.R[0].tolist(), "C": each.C[:, 0].tolist()}
                file.write_text(json_text(matrices), encoding="utf-8", newline="\n")
                picture = file.with_suffix(".png")
                write_png(draw_structures([(each, name)]), picture)
                places |= {draft: path.with_name(draft.name) for draft in (file, picture)}
            error.kept = publish_at(places) if places else ()
        raise


def _sites(
    config: GarageConfig, tape: str | None, plans: Sequence[Plan] | None, attempt: int
) -> tuple[LevelSites, GarageConfig, Sequence[str | None]]:
    if plans is not None:
        return sites_of_plans(config, plans), config, [None] * len(plans)
    sites, tapes = sites_and_tapes(config, tape, attempt)
    return sites, config, tapes


def _laid_out(
    sites: LevelSites, config: GarageConfig, planned: Sequence[PlannedLevel], jobs: int, progress: Progress
) -> Garage:
    """Lay out all levels around the ramps, with stair cores above one another."""
    building = Building(tuple(each.plan.structure for each in planned), sites.ramps, config.building.storey_m)
    graphs = [lane_squares_of(each.plan, each.config) for each in planned]
    plans = [LevelPlan(each.plan.structure, graph, each.config) for each, graph in zip(planned, graphs, strict=True)]
    egresses = plan_egress(plans, building.ramp_squares)
    in_forks = jobs > 1 and len(planned) > 1
    told = silent if in_forks else progress
    parts = zip(planned, graphs, egresses, strict=True)
    tasks = [
        partial(_layout, each, graph, egress, sites, config, number, told)
        for number, (each, graph, egress) in enumerate(parts)
    ]
    made = run_in_forks(tasks, jobs)
    layouts = counted("layout", made, len(tasks), progress) if in_forks else made
    levels = tuple(
        GarageLevel(
            place=place,
            config=each.config,
            layout=layout,
            planned=PlannedParts(each.site, each.plan, graph),
        )
        for place, each, graph, layout in zip(building.places, planned, graphs, layouts, strict=True)
    )
    return Garage(config, building, levels)


def _layout(
    planned: PlannedLevel,
    graph: LaneSquares,
    egress: Egress,
    sites: LevelSites,
    config: GarageConfig,
    number: int,
    progress: Progress,
) -> Layout:
    """Lay out a level: place its objects, prove its stalls, and add clutter beside the ways into them."""
    well = None if sites.ramps is None else make_well(sites.ramps, number, config)
    layout = lay_out(planned.plan.structure, graph, planned.config, well=well, egress=egress)
    layout = _driven(layout, planned.config, config.bay, progress)
    return with_things(layout, planned.config, progress=progress)


def with_things(layout: Layout, config: GarageConfig, *, progress: Progress = silent) -> Layout:
    """Return a layout with the stalls that misparked cars block, and clutter beside the ways into stalls."""
    layout = with_truth_of_misparked(layout, config, progress=progress)
    if config.clutter.is_any:
        layout = with_clutter(layout, config, cars=(DesignCar(), design_car(config.standard)), progress=progress)
    return layout


def _driven(layout: Layout, config: GarageConfig, bay: BayConfig, progress: Progress) -> Layout:
    """Mark, drop or refuse the stalls that no car gets into, as ``plan.unreachable_stalls`` says.

    None is refused where the planner decides how cars get in: beside columns in the triangles of angled stalls, and on
    aisles that it made narrower than ``bay.aisle_width_m``. There such stalls are marked.
    """
    choice, lanes = config.plan.unreachable_stalls, layout.lane_graph
    if choice.are_proven:
        return without_unreachable(layout, config, progress=progress)
    if choice is not UnreachableStalls.REFUSE:
        return layout
    tight = tight_stalls(lanes, layout.quads)
    is_narrowed = any(bay.chosen_sides) and any(
        lanes.clear_aisle_m(stall.access, stall.outwards) < bay.aisle_width_m - _ROUNDING_M for stall in tight
    )
    if is_narrowed or any(stall.kind is StallKind.ANGLED for stall in layout.quads):
        plan = config.plan.model_copy(update={"unreachable_stalls": UnreachableStalls.MARK})
        marking = config.model_copy(update={"plan": plan})
        return without_unreachable(layout, marking, in_full=True, progress=progress)
    if tight:
        refuse_undrivable(layout, config, tight, progress=progress)
    return layout


def _unreached_in_words(stalls: list[str]) -> str:
    named = ", ".join(stalls[:_NAMED_STALLS]) + (", ..." if len(stalls) > _NAMED_STALLS else "")
    return f"stalls without a way from the street and to it: {named}"


def _judged(garage: Garage) -> tuple[Judged, ...] | None:
    """Check each level against its profile; return None for more than 10,000 stalls."""
    if sum(len(level.layout.stalls) for level in garage.levels) > _MOST_CHECKED_STALLS:
        return None
    found = [judged_layout(level.layout, level.config) for level in garage.levels]
    return tuple(Judged(tuple(findings), unmet) for findings, unmet in found)


@contextmanager
def _timed(seconds: dict[str, float], step: str) -> Iterator[list[str]]:
    """Add the duration of a step to `seconds`, and log it with the decisions that the caller appends to the list."""
    start, told = time.perf_counter(), list[str]()
    yield told
    took = time.perf_counter() - start
    seconds[step] = seconds.get(step, 0.0) + took
    _LOG.info("%s: %s; %.2f s", step, ", ".join(told), took)
