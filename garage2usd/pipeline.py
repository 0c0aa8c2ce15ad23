"""The pipeline from a configuration to site, plan, lane graph, layout, stage and files."""
# Over 300 lines: the whole road is told in one place, as far as the garage and as far as its files.

import time
from dataclasses import dataclass
from itertools import pairwise
from pathlib import Path

from PIL import Image

from garage2usd.checks import Finding, judged_layout
from garage2usd.checks.swept_path import design_car
from garage2usd.common.errors import ConfigError
from garage2usd.common.output import check_file, check_name, check_writable, publish_at, staging_folder
from garage2usd.common.processes import without_collector
from garage2usd.common.progress import Progress, silent
from garage2usd.common.version import VERSION
from garage2usd.config import GarageConfig
from garage2usd.config.building import check_one_level
from garage2usd.config.plan import UnreachableStalls
from garage2usd.driving import DesignCar, with_clutter, with_truth_of_misparked, without_unreachable
from garage2usd.driving.refusal import refuse_undrivable
from garage2usd.layout import Layout, lay_out
from garage2usd.layout.egress.exits import Egress
from garage2usd.layout.parking.tight import tight_stalls
from garage2usd.layout.shell.well import Well
from garage2usd.planning import (
    Plan,
    completed,
    given_plan,
    is_of_lanes_alone,
    plan_lanes,
    play_plan,
)
from garage2usd.reading.report import UnmetClause
from garage2usd.report import make_report, write_report
from garage2usd.site.room import make_roomy_site
from garage2usd.stage import StageFormat, arrangement_of, shared_folder, write_labels, write_stage
from garage2usd.structure.grid import Cell, Structure
from garage2usd.structure.lane_graph import LaneSquares, build_lane_graph
from garage2usd.view.learning_picture import draw_learning_curve, draw_structures
from garage2usd.view.plan_picture import draw_plan
from garage2usd.view.raster import to_image, write_png

__all__ = ["Build", "Garage", "build", "generate", "generate_plan", "laid_out", "planned", "stage_metadata"]

_MOST_CHECKED_STALLS = 10_000
_NAMES_BESIDE = ("plan.png", "learning.png", "best.png", "labels.json", "report.json")
"""Of the files that may come with a stage, after its stem and a line."""


@dataclass(frozen=True, eq=False)
class Garage:
    """A generated garage with all intermediate results of the pipeline.

    Attributes
    ----------
    config
        What it was made from.
    site
        Static objects only.
    plan
        The structure with its lanes, its score, and the archive of other plans.
    graph
        The lane graph; every stall is reached from an entrance and reaches an exit.
    layout
        Every object in metres.
    """

    config: GarageConfig
    site: Structure
    plan: Plan
    graph: LaneSquares
    layout: Layout


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
        The picture of the plan, then the learning curve and the best plans where they were asked for.
    asset_folder
        Folder of the stage's own layers, and of its assets unless it shares them; None where it holds all that itself.
    shared_assets
        Folder of the assets that it shares with other stages; None where it has its own.
    seconds
        Seconds that each step took.
    findings
        What the garage misses of its profile by the rules that are quick (see `garage2usd.checks.check_layout`), errors
        first; None for more than 10,000 stalls, which take longer.
    unmet
        The clauses of its profile that it is not designed to: that it misses, or that nothing checks; None likewise.
    """

    garage: Garage
    stage: Path
    report: Path
    labels: Path
    pictures: tuple[Path, ...]
    asset_folder: Path | None
    shared_assets: Path | None
    seconds: dict[str, float]
    findings: tuple[Finding, ...] | None = None
    unmet: tuple[UnmetClause, ...] | None = None


def generate(
    config: GarageConfig | None = None,
    *,
    seed: int | None = None,
    tape: str | None = None,
    plan: Plan | None = None,
    progress: Progress = silent,
) -> Garage:
    """Make a garage.

    Parameters
    ----------
    config
        Its settings; the default garage if left out.
    seed
        Takes the place of the configuration's seed.
    tape
        The tape of a plan, as its report has it: its lanes, directions and stalls are made again on the site instead of
        learnt and drawn. Where it has lanes alone, the settings decide the rest.
    plan
        What was planned before with these settings and this seed, which takes the place of tape and learning.
    progress
        Told how far long steps are.

    Raises
    ------
    ConfigError
        If a setting cannot be used.
    GenerationError
        If a random step found no valid result; names the step and the seed.
    UnreachableStallError
        If stalls of a given structure have no route from an entrance and to an exit.
    """
    return _generate(config or GarageConfig(), seed=seed, tape=tape, plan=plan, progress=progress)[0]


def generate_plan(config: GarageConfig, *, progress: Progress = silent) -> Plan:
    """Make a garage as far as its plan, directions and stalls included; raises as `generate`, which goes on from it."""
    plan = planned(_site(config), config, tape=None, progress=progress)
    lane_squares_of(plan, config)
    return plan


@without_collector()
def build(
    config: GarageConfig | None = None,
    output: str | Path = "garage.usdz",
    *,
    seed: int | None = None,
    tape: str | None = None,
    learning_curve: bool = False,
    best_plans: int = 0,
    progress: Progress = silent,
) -> Build:
    """Make a garage and write its stage, the picture of its plan and its report.

    Parameters
    ----------
    config, seed, tape, progress
        As for `generate`.
    output
        The stage's path; ``.usda``, ``.usdc`` or ``.usdz``. Picture, report and assets go beside it, under its name.
    learning_curve
        Whether to draw the return of each episode as well.
    best_plans
        How many of the best plans to draw side by side as well.

    Raises
    ------
    ConfigError
        If a setting cannot be used, the extension is unknown, or pictures of learning are asked for without learning.
    GenerationError, UnreachableStallError
        As `generate`.
    OutputError
        If the files cannot be written. They appear whole or not at all.
    """
    path = Path(output)
    if path.suffix.lower() not in set(StageFormat) or not path.stem:
        raise ConfigError("output", str(output), f"a path that ends in {', '.join(StageFormat)}")
    check_name(path, of_layer=True)
    config = config or GarageConfig()
    check_file(path, with_it=(path.with_name(f"{path.stem}_{name}") for name in _NAMES_BESIDE))
    if shared := shared_folder(path, config.stage):
        check_writable(shared)
    garage, seconds = _generate(config, seed=seed, tape=tape, progress=progress)
    _check_learnt(garage.plan, learning_curve=learning_curve, best_plans=best_plans)
    with staging_folder(path) as staging:
        start = time.perf_counter()
        folder = staging / "stage"
        folder.mkdir()
        arrangement = arrangement_of(garage.layout, garage.config.stage)
        made = write_stage(
            garage.layout,
            folder / f"{path.stem}{path.suffix.lower()}",
            arrangement=arrangement,
            metadata=stage_metadata(garage),
            config=garage.config.stage,
            shared=shared,
            progress=progress,
        )
        labels = staging / f"{path.stem}_labels.json"
        write_labels(garage.layout, labels, arrangement=arrangement)
        pictures = _pictures(garage, learning_curve=learning_curve, best_plans=best_plans)
        drawn = [staging / f"{path.stem}_{name}.png" for name in pictures]
        for picture, image in zip(drawn, pictures.values(), strict=True):
            write_png(image, picture)
        seconds["stage"] = time.perf_counter() - start
        start = time.perf_counter()
        findings, unmet = _judged(garage)
        seconds["check"] = time.perf_counter() - start
        report = staging / f"{path.stem}_report.json"
        write_report(
            report,
            make_report(
                config=garage.config,
                plan=garage.plan,
                layout=garage.layout,
                seconds=seconds,
                unmet=unmet,
            ),
        )
        progress("files", 0, 1)
        # the stage comes last: where it stands, all of it does
        files = [*filter(None, [made.assets]), *drawn, labels, report]
        place_of = {file: path.with_name(file.name) for file in files} | {made.stage: path}
        publish_at(place_of)
    return Build(
        garage=garage,
        stage=place_of[made.stage],
        report=place_of[report],
        labels=place_of[labels],
        pictures=tuple(place_of[picture] for picture in drawn),
        asset_folder=place_of[made.assets] if made.assets else None,
        shared_assets=shared,
        seconds=seconds,
        findings=findings,
        unmet=unmet,
    )


def _generate(
    config: GarageConfig, *, seed: int | None, tape: str | None, progress: Progress, plan: Plan | None = None
) -> tuple[Garage, dict[str, float]]:
    if seed is not None:
        config = config.with_seed(seed)
    clock = [time.perf_counter()]
    site = _site(config)
    clock.append(time.perf_counter())
    if plan is None:
        plan = planned(site, config, tape=tape, progress=progress)
    clock.append(time.perf_counter())
    garage = laid_out(site, plan, config, lane_squares_of(plan, config), progress=progress)
    clock.append(time.perf_counter())
    steps = zip(("site", "plan", "layout"), pairwise(clock), strict=True)
    return garage, {step: end - start for step, (start, end) in steps}


def planned(site: Structure, config: GarageConfig, *, tape: str | None, progress: Progress) -> Plan:
    """Plan the lanes of a site, their directions and the kinds of stalls; parameters and errors as for `generate`.

    Given ones are taken, a tape is replayed, and the others are learnt and drawn.
    """
    if tape is not None and (site.cells == Cell.LANE).any():
        raise ConfigError("tape", tape, "no tape beside a structure that has lanes")
    if tape is not None and not is_of_lanes_alone(tape):
        return play_plan(site, tape, config)
    return completed(_lanes(site, config, tape=tape, progress=progress), config)


def laid_out(
    site: Structure,
    plan: Plan,
    config: GarageConfig,
    graph: LaneSquares,
    *,
    well: Well | None = None,
    egress: Egress | None = None,
    progress: Progress = silent,
) -> Garage:
    """Lay out a plan as a garage.

    `graph` is from `lane_squares_of`; `well` has the ramps to other levels, `egress` the stair cores that this level
    shares with them. Errors as for `generate`.
    """
    layout = lay_out(plan.structure, graph, config, well=well, egress=egress)
    layout = _driven(layout, config, progress)
    if config.clutter.is_any:
        layout = with_clutter(layout, config, cars=(DesignCar(), design_car(config.standard)), progress=progress)
    return Garage(config, site, plan, graph, layout)


def _site(config: GarageConfig) -> Structure:
    check_one_level(config.building)
    return make_roomy_site(config)


def lane_squares_of(plan: Plan, config: GarageConfig) -> LaneSquares:
    """Return the lanes and rows of stalls of a plan. Errors as for `generate`."""
    graph = build_lane_graph(plan.structure, config.bay, plan.runs, plan.directions)
    if not graph.stall_rows:
        raise ConfigError(
            "site.structure", str(plan.structure), "at least one free square beside a lane that takes a stall"
        )
    return graph


def _lanes(site: Structure, config: GarageConfig, *, tape: str | None, progress: Progress) -> Plan:
    """Plan the lanes: take the given ones, replay a tape, or learn."""
    if (site.cells == Cell.LANE).any():
        return given_plan(site, bay=config.bay, plan=config.plan)
    if tape is not None:
        return play_plan(site, tape, config)
    return plan_lanes(site, plan=config.plan, bay=config.bay, seed=config.seed, progress=progress)


def _judged(garage: Garage) -> tuple[tuple[Finding, ...] | None, tuple[UnmetClause, ...] | None]:
    """Check a garage against its profile; both results are None for garages with too many stalls."""
    if len(garage.layout.stalls) > _MOST_CHECKED_STALLS:
        return None, None
    findings, unmet = judged_layout(garage.layout, garage.config)
    return tuple(findings), unmet


def _driven(layout: Layout, config: GarageConfig, progress: Progress) -> Layout:
    """The layout with what is asked of stalls that no car gets into, and the truth beside cars over lines."""
    choice = config.plan.unreachable_stalls
    if choice.are_proven:
        layout = without_unreachable(layout, config, progress=progress)
    tight = tight_stalls(layout.lane_graph, layout.quads) if choice is UnreachableStalls.REFUSE else ()
    if tight:
        refuse_undrivable(layout, config, tight, progress=progress)
    return with_truth_of_misparked(layout, config, progress=progress)


def _check_learnt(plan: Plan, *, learning_curve: bool, best_plans: int) -> None:
    for field, asked in (("learning_curve", learning_curve), ("best_plans", best_plans)):
        if asked and not plan.archive:
            raise ConfigError(field, asked, "only where lanes are learnt, not with a tape or lanes that are given")


def _pictures(garage: Garage, *, learning_curve: bool, best_plans: int) -> dict[str, Image.Image]:
    """Draw the pictures of a build, keyed by name."""
    plan = garage.plan
    pictures = {"plan": to_image(draw_plan(garage.layout))}
    if learning_curve:
        pictures["learning"] = draw_learning_curve(plan.learning_curve)
    if best_plans:
        pictures["best"] = draw_structures(
            [
                (entry.structure, f"{entry.score.value:.2f} {'polished' if entry.is_polished else 'learnt'}")
                for entry in plan.archive[:best_plans]
            ]
        )
    return pictures


def stage_metadata(garage: Garage) -> dict[str, str | int]:
    """What a stage says of how its garage was made, which makes it again."""
    return {
        "generator": "garage2usd",
        "version": VERSION,
        "seed": garage.config.seed,
        "configDigest": garage.config.digest(),
        "structureDigest": garage.plan.structure.digest(),
        "profile": garage.config.standard.name,
    }
