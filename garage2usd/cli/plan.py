"""The command ``garage2usd plan``."""

import sys
from pathlib import Path
from typing import TYPE_CHECKING

import click

from garage2usd.cli.bars import Bars
from garage2usd.cli.options import INPUT_FILE, echo_table, output_option, seed_option

if TYPE_CHECKING:
    from collections.abc import Sequence

    from garage2usd.common.progress import Progress
    from garage2usd.garage_model import Garage, GarageLevel
    from garage2usd.view.plan_sheet import Mark

_FORMATS = (".png", ".svg")
_ROUNDING = 1e-6
"""Rounding of scores summed in different orders."""


@click.command(short_help="Draw a plan with dimensions, as SVG or PNG.")
@click.argument("path", type=INPUT_FILE)
@click.option("--stall", "number", metavar="NUMBER|ID", help="A stall whose route is drawn, as B2-07 or U2/B2-07.")
@click.option("--findings", "with_findings", is_flag=True, help="Draw what `check` finds in PATH at its place.")
@click.option(
    "--optimum",
    "with_optimum",
    is_flag=True,
    help="Prove the best score that any lanes have on the garage's squares, and print the plan's beside it. For sites "
    "of up to about 9 x 9 squares.",
)
@click.option("--tracks", metavar="FILE", type=INPUT_FILE, help="Draw tracks of cars and people: .parquet or .csv.")
@seed_option
@output_option(
    "The picture, .svg or .png; may be repeated.  [default: PATH's name with _plan.svg, in this folder]",
    several=True,
    dir_okay=False,
)
def plan(
    *,
    path: Path,
    number: str | None,
    with_findings: bool,
    with_optimum: bool,
    tracks: Path | None,
    seed: int | None,
    outputs: tuple[Path, ...],
) -> None:
    """Draw the plan of a garage with dimensions, stall numbers and lanes.

    PATH is a configuration (.toml), the report of a build (.json), or a stage beside its report. A garage of several
    levels has a picture for each of them, as garage_plan_U2.svg, and a section along its ramps,
    garage_plan_section.svg. The route to a stall is drawn on each level that it leads over.

    \b
    Examples:
      garage2usd plan garage.usdz
      garage2usd plan garage_report.json --stall B2-07 -o route.png -o route.svg
      garage2usd plan two_levels.usdz --stall U2/B2-07
      garage2usd plan garage.usdz --findings -o findings.png
      garage2usd plan garage.usdz --tracks run.parquet
      garage2usd plan samples/paper_7x9.toml --optimum
    """  # noqa: D301 - click's mark for a block that is not wrapped
    from garage2usd.common.errors import ConfigError  # noqa: PLC0415 - keeps --help instant
    from garage2usd.common.output import check_file, drafting, publish_at, staging_folder  # noqa: PLC0415
    from garage2usd.garage_sources import generated_of  # noqa: PLC0415
    from garage2usd.view.drawing import to_image, to_svg, write_png  # noqa: PLC0415
    from garage2usd.view.garage_plans import draw_levels  # noqa: PLC0415
    from garage2usd.view.plan_picture import find_stall  # noqa: PLC0415

    outputs = outputs or (Path(f"{path.stem.removesuffix('_report')}_plan.svg"),)
    for output in outputs:
        if output.suffix.lower() not in _FORMATS or not output.stem:
            raise ConfigError("output", str(output), f"a path that ends in {', '.join(_FORMATS)}")
        check_file(output)
    with Bars(sys.stderr) as progress:
        garage = generated_of(path, seed, progress=progress)
        # before the check of a stage, which limits the processor time of all later work
        told = _beside_optimum(garage, progress) if with_optimum else []
        marks = _marks(path, garage, progress) if with_findings else {}
    driven = None
    if tracks is not None:
        from garage2usd.maps.track_tables import read_tracks  # noqa: PLC0415 - needs an extra

        driven = read_tracks(tracks)
    drawings = draw_levels(
        garage,
        stall=find_stall(garage.stalls, number) if number else None,
        marks=marks,
        tracks=driven,
    )
    sheets = [
        (output.with_name("_".join(filter(None, (output.stem, name))) + output.suffix), drawing)
        for output in outputs
        for name, drawing in drawings.items()
    ]
    for place, _ in sheets:
        check_file(place)
    with staging_folder(outputs[0]) as staging:
        places = {staging / str(number): place for number, (place, _) in enumerate(sheets)}
        for file, (place, drawing) in zip(places, sheets, strict=True):
            with drafting(place):
                if place.suffix.lower() == ".svg":
                    file.write_text(to_svg(drawing), encoding="utf-8", newline="\n")
                else:
                    write_png(to_image(drawing), file)
        publish_at(places)
    echo_table([*(("picture", str(place)) for place, _ in sheets), *told])


def _marks(path: Path, garage: "Garage", progress: "Progress") -> "dict[str, list[Mark]]":
    """Findings of a check that have places, by the name of their level."""
    from garage2usd.garage_sources import read_built  # noqa: PLC0415 - keeps --help instant
    from garage2usd.view.plan_sheet import Mark  # noqa: PLC0415

    marks: dict[str, list[Mark]] = {}
    for finding in read_built(path, progress=progress).findings(progress=progress):
        if finding.position_m is not None:
            words = f"{finding.rule}: {finding.message}"
            level = _level_of(finding.place, garage.levels)
            marks.setdefault(level, []).append(Mark(*finding.position_m, finding.severity.value, words))
    return marks


def _level_of(place: str, levels: "Sequence[GarageLevel]") -> str:
    """Return the name of the level of a prim path, stall or square; the top level if the place names none."""
    parts = place.split("/")
    return next((level.name for level in levels if level.name in parts), levels[0].name)


def _beside_optimum(garage: "Garage", progress: "Progress") -> list[tuple[str, str]]:
    """Score of each level's plan, and its share of the proven optimum on the same squares."""
    return [
        (level.place.in_whole(name, joint=" "), words)
        for level in garage.levels
        for name, words in _beside_level_optimum(level, progress)
    ]


def _beside_level_optimum(level: "GarageLevel", progress: "Progress") -> list[tuple[str, str]]:
    from garage2usd.planning import find_optimum  # noqa: PLC0415 - keeps --help instant

    plan, config = level.plan, level.config
    best = find_optimum(
        plan.structure, bay=config.bay, plan=config.plan, known=plan.structure, progress=progress
    ).score.value
    value = plan.score.value
    if value > best + _ROUNDING:
        share = "this plan has more, as it breaks the rules of circulation"
    elif best > 0:
        share = f"this plan has {100 * value / best:.1f} % of it"
    else:
        share = f"this plan has {best - value:.2f} less"
    return [("score", f"{value:.2f}"), ("optimum", f"proven optimum {best:.2f}; {share}")]
