"""The command ``garage2usd import``."""

import sys
from collections import Counter
from pathlib import Path
from typing import TYPE_CHECKING

import click

from garage2usd.cli.bars import Bars
from garage2usd.cli.options import INPUT_FILE, echo_notices, echo_table, output_option, profile_option, seed_option
from garage2usd.common.errors import printable

if TYPE_CHECKING:
    from garage2usd.pipeline import Build

_MOST_NAMED = 20


@click.command("import", short_help="Make a garage of a layout that others made.")
@click.argument("source", type=click.Path(path_type=Path))
@click.option(
    "--config",
    "-c",
    metavar="FILE",
    type=INPUT_FILE,
    help="Fittings, parking, look and seed (TOML). Its site, bay, stalls and plan do not apply.",
)
@seed_option
@profile_option("The standard whose clauses apply, in place of the configuration's")
@click.option("--level", metavar="NAME", help="Import this level alone, by its name in SOURCE, such as -1.")
@click.option("--no-proofs", is_flag=True, help="Do not prove for each stall that a car drives in and out.")
@output_option(
    "The stage: .usda, .usdc or .usdz. Its folder is made; files of that name are replaced.", default="garage.usdz"
)
def import_layout(
    *,
    source: Path,
    config: Path | None,
    seed: int | None,
    profile: str | None,
    level: str | None,
    no_proofs: bool,
    output: Path,
) -> None:
    """Make a garage of the stalls, lanes and columns in SOURCE and write it as a USD stage.

    SOURCE is a CAD drawing (.dxf) or a building model (.ifc), which need the extra `cad`; a Lanelet2 map or an
    OpenStreetMap extract (.osm), an OpenDRIVE map (.xodr), GeoJSON (.geojson), IMDF (.zip or its folder), a table of
    rectangles (.csv), or a drawing in metres (.toml). Its stalls stay where they are, on no grid. Without lanes, these
    are derived from the ground between the stalls.

    Levels in SOURCE (in .osm by level, repeat_on, layer or the heights of nodes, in .dxf by height, in .ifc and IMDF
    by storey) become the levels of one garage, U1 being the top one. --level picks one of them.

    Parts that the garage lacks are named on stderr, a line each with the reason, and under unplaced in the report,
    which stands beside the stage with a plan (out/a_plan.png) and the table of all objects (a_labels.json).

    \b
    Examples:
      garage2usd import samples/surveys/lot.toml -o out/lot.usdz
      garage2usd import map.osm --config look.toml --seed 3 -o out/lot.usda
    """  # noqa: D301 - click's mark for a block that is not wrapped
    from garage2usd.config import GarageConfig, load_config, profile_setting  # noqa: PLC0415 - keeps --help instant
    from garage2usd.imports import import_layout as make  # noqa: PLC0415
    from garage2usd.imports import surveyed_floors, unplaced_parts  # noqa: PLC0415

    if config:
        settings = load_config(config, profile=profile)
    else:
        settings = GarageConfig(**({} if profile is None else {"profile": profile_setting(profile)}))
    if seed is not None:
        settings = settings.with_seed(seed)
    echo_notices(settings.remarks())
    with Bars(sys.stderr) as progress:
        made = make(source, output, config=settings, level=level, proves=not no_proofs, progress=progress)
    echo_notices(map(printable, made.remarks))
    unplaced = unplaced_parts(made.garage)
    for name, reason in unplaced[:_MOST_NAMED]:
        click.echo(f"not placed: {printable(name)}: {printable(reason)}", err=True)
    if len(unplaced) > _MOST_NAMED:
        click.echo(f"not placed: {len(unplaced) - _MOST_NAMED} more, see {made.report}", err=True)
    for stall in (stall for floor in surveyed_floors(made.garage) for stall in floor.fitted if stall.note):
        click.echo(f"changed: {printable(stall.source.name)}: {printable(stall.note)}", err=True)
    _describe(made, len(unplaced))


def _describe(made: "Build", unplaced: int) -> None:
    from garage2usd.checks import clauses_checked, found_in_words  # noqa: PLC0415 - keeps --help instant

    rows = []
    for level in made.garage.levels:
        layout = level.layout
        kinds = Counter(stall.kind.value for stall in layout.quads if stall.takes_cars)
        of_kinds = ", ".join(f"{count} {kind}" for kind, count in kinds.most_common())
        name = "" if level.place.is_only else f"{level.name}, level {printable(level.source_name)}: "
        rows.append(("stalls", f"{name}{layout.parking_stalls} ({of_kinds}); {layout.uses_in_words()}"))
    rows.append(("not placed", str(unplaced)))
    if made.proofs:
        outcomes = Counter(proof.outcome.value for proof in made.proofs)
        rows.append(("driven", ", ".join(f"{count} {outcome}" for outcome, count in outcomes.most_common())))
    profile = made.garage.config.standard
    clauses = clauses_checked(profile, [entry.clause for entry in made.unmet or () if not entry.places])
    found = found_in_words(made.findings or (), clauses, profile.name)
    ways = "" if made.proofs else ", without ways into stalls"
    rows.append(("check", f"{found}{ways}: garage2usd check {made.stage}"))
    rows += [("stage", str(made.stage)), *(("plan", str(each)) for each in made.pictures)]
    rows.append(("report", str(made.report)))
    echo_table(rows)
