"""The command ``garage2usd build``."""

# Over 300 lines: the summary has a function for each of its lines.

import sys
from pathlib import Path
from typing import TYPE_CHECKING

import click
from click.core import ParameterSource

from garage2usd.cli.bars import Bars
from garage2usd.cli.options import (
    INPUT_FILE,
    echo_notices,
    echo_table,
    end_incomplete,
    like_option,
    log_steps,
    output_option,
    profile_option,
    seed_option,
)
from garage2usd.cli.view import view
from garage2usd.common.errors import ConfigError

if TYPE_CHECKING:
    from collections.abc import Sequence

    from garage2usd.config.outputs import MapsConfig
    from garage2usd.garage_model import GarageLevel
    from garage2usd.layout import Layout
    from garage2usd.pipeline import Build
    from garage2usd.planning import Score

_COLUMNS_NAMED = 3


@click.command(short_help="Build a garage and write it as a USD stage.")
@click.argument("config", required=False, type=INPUT_FILE)
@like_option
@seed_option
@profile_option("The standard to design to, in place of the configuration's")
@click.option(
    "--tape",
    metavar="TAPE",
    help="The tape of a plan, as its report has it: make its lanes, directions and stalls again instead of planning.",
)
@click.option("--learning-curve", is_flag=True, help="Draw the return of each episode as well (a_learning.png).")
@click.option(
    "--best-plans",
    metavar="N",
    type=click.IntRange(0, 200),
    default=0,
    help="Draw the N best plans as well (a_best.png).",
)
@click.option(
    "--with",
    "formats",
    metavar="FORMAT,...",
    help="Export the stage as well, beside it: add.xml, autoware, carla.zip, dxf, geojson, glb, osm, "
    "osm.xml, sdf, xodr, xosc, yaml, "
    "several with commas; see `garage2usd export`.",
)
@click.option(
    "--jobs",
    metavar="N",
    type=click.IntRange(1, 4096),
    help="How many levels are planned and laid out at a time; one a core. The files do not depend on it.",
)
@click.option(
    "--open", "is_opened", is_flag=True, help="Show the stage in the browser afterwards, as `garage2usd view` does."
)
@click.option("--verbose", is_flag=True, help="Say on stderr what each step decides and how long it takes.")
@output_option(
    "The stage: .usda, .usdc or .usdz. Its folder is made; files of that name are replaced.", default="garage.usdz"
)
@click.pass_context
def build(
    ctx: click.Context,
    *,
    config: Path | None,
    like: str | None,
    seed: int | None,
    profile: str | None,
    tape: str | None,
    learning_curve: bool,
    best_plans: int,
    formats: str | None,
    jobs: int | None,
    is_opened: bool,
    verbose: bool,
    output: Path,
) -> None:
    """Build the garage of the configuration CONFIG (TOML), or one --like a usual garage; else one of 7 x 9 squares.

    Beside the stage, such as out/a.usda, the command writes a picture of the plan (out/a_plan.png; of several levels
    a_U1_plan.png and so on, and likewise the pictures that the options below ask for), a report
    (a_report.json), the classes and bounds of all objects (a_labels.json) and, unless the stage is a .usdz, its assets
    (a_assets/, or a folder shared by many garages with the setting stage.assets).

    The garage is designed to all clauses of its profile that the given settings allow. Violated clauses are printed on
    stderr, one per line, and listed under not_designed_to in the report. So are, under remarks, the files of folders of
    your own, which are used for what and which are not, and shares of stalls that the site does not hold.

    \b
    Examples:
      garage2usd build --like residential-de --seed 7 --output garage.usdz
      garage2usd build --like mall-cn --open
      garage2usd build samples/paper_7x9.toml -o out/paper.usda
    """  # noqa: D301 - click's mark for a block that is not wrapped
    from garage2usd.common.system import cores  # noqa: PLC0415
    from garage2usd.config import GarageConfig, load_config, profile_setting  # noqa: PLC0415 - keeps --help instant
    from garage2usd.pipeline import build as build_garage  # noqa: PLC0415

    if config and like is not None:
        raise click.UsageError("Give either a CONFIG or --like NAME.")
    if config:
        settings = load_config(config, profile=profile)
    elif like is not None:
        from garage2usd.config.starting_points import starting_point  # noqa: PLC0415 - most builds have a configuration

        settings = starting_point(like, profile=profile)
    else:
        settings = GarageConfig(**({} if profile is None else {"profile": profile_setting(profile)}))
    echo_notices(settings.remarks())
    exports, lacking = _exports(output, formats, settings.maps)
    earlier = _earlier(ctx, output)
    notices: list[str] = []
    with Bars(sys.stderr) as progress:
        if verbose:
            log_steps(progress.announce)
        made = build_garage(
            settings,
            output,
            seed=seed,
            tape=tape,
            learning_curve=learning_curve,
            best_plans=best_plans,
            jobs=jobs or cores(),
            progress=progress,
        )
        if exports:
            from garage2usd.exports import export  # noqa: PLC0415 - most builds are not exported

            exports = export(
                made.stage, exports, settings=settings.maps, progress=progress, workers=cores(), notice=notices.append
            )
    echo_notices([*notices, *made.garage.remarks])
    for entry in made.unmet or ():
        click.echo(f"not designed to {entry.clause}: {entry.reason}", err=True)
    _describe(made)
    echo_table(("export", str(file)) for file in exports)
    _say_replaced(earlier, made.stage, *made.pictures, made.report, made.labels, *exports)
    if is_opened:
        ctx.invoke(view, path=made.stage)
    end_incomplete(lacking)


def _earlier(ctx: click.Context, output: Path) -> frozenset[str]:
    """Names of the files that a build without a given output would replace; none if the output is given."""
    if ctx.get_parameter_source("output") is not ParameterSource.DEFAULT:
        return frozenset()
    return frozenset(file.name for file in output.parent.glob("*"))


def _say_replaced(earlier: frozenset[str], *files: Path) -> None:
    """Say which files of a build replaced earlier ones."""
    replaced = [file.name for file in files if file.name in earlier]
    if replaced:
        echo_table([("replaced", f"{', '.join(replaced)} of before; -o FILE names others")])


def _exports(output: Path, formats: str | None, settings: "MapsConfig") -> tuple[tuple[Path, ...], tuple[str, ...]]:
    """Validate the exports beside a stage; return their paths, and a line on each whose extra is missing."""
    if formats is None:
        return (), ()
    from garage2usd.exports import check_exports, without_lacking  # noqa: PLC0415 - most builds are not exported

    if not output.name:
        raise ConfigError("output", str(output), "a path with a name, beside which exports go")
    files = [output.with_name(f"{output.stem}.{name.strip()}") for name in formats.split(",")]
    written, lacking = without_lacking(files)
    return check_exports(written, settings=settings), lacking


def _describe(made: "Build") -> None:
    garage = made.garage
    ramps, (first, *lower) = garage.building.ramps, garage.levels
    lines = [
        *(_level(made, first) if ramps is None else _levels(made)),
        ("m2/stall", _areas([level.layout for level in garage.levels])),
        *(() if lower else _scores(made)),
        *(
            (level.place.in_whole("gave way", joint=" "), f"{name}: {reason}")
            for level in garage.levels
            for name, reason in level.plan.gave_way.items()
        ),
        ("reachable", f"every stall, from an entrance{' on the street' if lower else ''} and to an exit"),
        ("check", _checked(made)),
        ("seed", str(garage.config.seed)),
        ("stage", str(made.stage)),
        *(("assets", f"{folder}/") for folder in (made.asset_folder, made.shared_assets) if folder),
        *(("picture", str(picture)) for picture in made.pictures),
        ("report", str(made.report)),
        ("labels", str(made.labels)),
        ("Unity", f"add the package unity_importer, then drop {_dropped(made)} into Assets"),
        ("seconds", ", ".join(f"{step} {value:.2f}" for step, value in made.seconds.items())),
    ]
    echo_table(lines)


def _level(made: "Build", level: "GarageLevel") -> list[tuple[str, str]]:
    """Summarise a garage of one level: squares, stalls, columns, cores and light."""
    layout, counts = level.layout, level.layout.counts()
    rows, cols = layout.structure.shape
    return [
        ("squares", f"{rows} x {cols}, {counts['floor']} inside"),
        ("stalls", f"{layout.parking_stalls} ({layout.uses_in_words()}), {counts['car']} with a car"),
        *_planned(made),
        *_columns(made),
        ("cores", f"{len(layout.cores)} in the place of {_displaced(layout)} stalls; {_parts(layout)}"),
        ("light", _lit(made)),
    ]


def _levels(made: "Build") -> list[tuple[str, str]]:
    """Summarise several levels: a line for each, the ramps, and all stalls."""
    garage, lines = made.garage, list[tuple[str, str]]()
    for level in garage.levels:
        layout = level.layout
        cars = f"{layout.parking_stalls} stalls, {layout.counts()['car']} with a car"
        lines.append((level.name, f"floor at {level.floor_m:g} m, {cars}, {len(layout.cores)} cores"))
    ramps = garage.building.ramps
    told = [] if ramps is None else [("ramps", ramps.in_words)]
    return [*lines, ("stalls", f"{garage.parking_stalls} on {len(garage.levels)} levels"), *told]


def _parts(layout: "Layout") -> str:
    count = int(layout.compartments.max())
    return f"{count} fire compartment{'s' if count > 1 else ''}"


def _scores(made: "Build") -> list[tuple[str, str]]:
    """Summarise the score of the plan of the only level, and what learning and polish contributed."""
    score = made.garage.plan.score
    figures = f"N_S {score.stalls}, T_S {score.parking_time_squares:.2f} squares, U_S {score.unused_squares}"
    return [("score", f"{score.value:.2f} ({figures})"), *_learnt(made)]


def _areas(layouts: "Sequence[Layout]") -> str:
    """Summarise the floor per stall, net and gross."""
    from garage2usd.report import area_figures  # noqa: PLC0415 - keeps --help instant

    net_m2, gross_m2 = area_figures(layouts).values()
    return "no stalls" if net_m2 is None else f"{net_m2:.1f} net, {gross_m2:.1f} gross, with ramps and obstacles"


def _planned(made: "Build") -> list[tuple[str, str]]:
    """Summarise how many of the planned stalls cores, access aisles and turning stalls replace."""
    layout, planned = made.garage.layout, made.garage.plan.score.stalls
    kept_free, for_cores = layout.kept_free_stalls, _displaced(layout)
    others = planned - layout.parking_stalls - kept_free - for_cores
    if planned == layout.parking_stalls:
        return []
    became = [(f"{kept_free} kept free", kept_free), (f"{for_cores} given to cores", for_cores)]
    became.append((f"{abs(others)} {'fewer' if others > 0 else 'more'} by size classes", others))
    told = ", ".join(words for words, count in became if count)
    return [("planned", f"{planned} (N_S): {layout.parking_stalls} to park in, {told}")]


def _learnt(made: "Build") -> list[tuple[str, str]]:
    """Scores of the learnt plan and, after hill climbing, of the polished one."""
    from garage2usd.planning import dimensioned, evaluate  # noqa: PLC0415 - keeps --help instant

    plan, config = made.garage.plan, made.garage.config
    if plan.learnt is None:
        return []
    found = dimensioned(plan.learnt.structure, config.bay)
    learnt = _scored(evaluate(found, bay=config.bay, plan=config.plan), found.floor_m2)
    if plan.learnt.structure == plan.archive[0].structure:
        return [("learning", f"{learnt}; polish found no better one")]
    return [("learning", f"{learnt}; polished: {_scored(plan.score, plan.structure.floor_m2)}")]


def _scored(score: "Score", floor_m2: float) -> str:
    return f"score {score.value:.2f} with {score.stalls} stalls planned on {floor_m2:.0f} m2"


def _columns(made: "Build") -> list[tuple[str, str]]:
    """Summarise the columns that are set back from the mouths of stalls, and those that cannot be."""
    layout, bay = made.garage.layout, made.garage.config.bay
    if not bay.column_setback_m:
        return []
    stay = layout.columns_at_mouths()
    named = ", ".join(stay[:_COLUMNS_NAMED]) + (", ..." if len(stay) > _COLUMNS_NAMED else "")
    others = f"; at the corner stay {len(stay)}: {named}" if stay else ""
    return [("columns", f"set back {bay.column_setback_m:g} m from the mouths{others}")]


def _lit(made: "Build") -> str:
    """Illuminance of lanes and stalls with the required values, and the deciding one: lanes, stalls or dead lamps."""
    light, fittings = made.garage.layout.illuminance, made.garage.config.fittings
    both = (("lane", light.lanes, fittings.lane_lux), ("stall", light.stalls, fittings.stall_lux))
    lit = [(name, lux.mean, wanted) for name, lux, wanted in both if lux and lux.mean]
    if not lit:
        return "no lamp burns" if light.dead_lamps else "no tubes over lanes or stalls"
    decides = "" if light.dead_lamps else min(lit, key=lambda part: part[1] / part[2])[0]
    parts = [
        f"{name}s {mean:.0f} lx ({name}_lux asks for {wanted:g}{', which decides' if name == decides else ''})"
        for name, mean, wanted in lit
    ]
    return ", ".join(parts) + (f"; {light.dead_lamps} of {light.lamps} lamps give no light" if light.dead_lamps else "")


def _displaced(layout: "Layout") -> int:
    """Number of the plan's stalls replaced by stair cores."""
    return sum(len(core.stalls) for core in layout.cores)


def _checked(made: "Build") -> str:
    """Number of clauses checked, what was found, and the command that lists it."""
    from garage2usd.checks import clauses_checked, found_in_words  # noqa: PLC0415 - keeps --help instant

    if made.findings is None:
        return f"not done here for so many stalls: garage2usd check {made.report}"
    profile = made.garage.config.standard
    clauses = clauses_checked(profile, [entry.clause for entry in made.unmet or () if not entry.places])
    found = found_in_words(made.findings, clauses, profile.name)
    return f"{found}: garage2usd check {made.report}" if made.findings else found


def _dropped(made: "Build") -> str:
    """Files of a build that a Unity project needs."""
    own = [f"{made.asset_folder.name}/"] if made.asset_folder else []
    shared = [f"{made.garage.config.stage.asset_folder}/"] if made.shared_assets else []
    return " and ".join([made.stage.name, *own, *shared])
