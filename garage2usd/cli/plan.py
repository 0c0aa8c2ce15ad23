"""The command ``garage2usd plan``."""

import sys
from pathlib import Path
from typing import TYPE_CHECKING

import click

from garage2usd.cli.bars import Bars
from garage2usd.cli.parameters import INPUT_FILE, echo_table, refuse_seed, seed_option

if TYPE_CHECKING:
    from collections.abc import Mapping

    from garage2usd.buildings import LevelsGarage
    from garage2usd.common.progress import Progress
    from garage2usd.pipeline import Garage
    from garage2usd.view.plan_sheet import Mark

__all__ = ["plan"]

_FORMATS = (".png", ".svg")
_ROUNDING = 1e-6
"""Rounding of scores summed in different orders."""


@click.command(short_help="Draw a plan with dimensions, as SVG or PNG.")
@click.argument("path", type=INPUT_FILE)
@click.option("--stall", "number", metavar="NUMBER|ID", help="A stall whose route is drawn, as B2-07.")
@click.option("--findings", "with_findings", is_flag=True, help="Draw what `check` finds in PATH at its place.")
@click.option(
    "--optimum",
    "with_optimum",
    is_flag=True,
    help="Prove the best score that any lanes have on the garage's squares, and print the plan's beside it. For sites "
    "of up to about 9 x 9 squares.",
)
@seed_option
@click.option(
    "--output",
    "-o",
    "outputs",
    metavar="FILE",
    type=click.Path(dir_okay=False, path_type=Path),
    multiple=True,
    help="The picture, .svg or .png; may be repeated.  [default: PATH's name with _plan.svg, in this folder]",
)
def plan(
    *,
    path: Path,
    number: str | None,
    with_findings: bool,
    with_optimum: bool,
    seed: int | None,
    outputs: tuple[Path, ...],
) -> None:
    """Draw the plan of a garage with dimensions, stall numbers and lanes.

    PATH is a configuration (.toml), the report of a build (.json), or a stage beside its report. A garage of several
    levels has a picture for each of them, as garage_plan_U2.svg, and a section along its ramps,
    garage_plan_section.svg.

    \b
    Examples:
      garage2usd plan garage.usdz
      garage2usd plan garage_report.json --stall B2-07 -o route.png -o route.svg
      garage2usd plan garage.usdz --findings -o findings.png
      garage2usd plan samples/paper_7x9.toml --optimum
    """  # noqa: D301 - click's mark for a block that is not wrapped
    from garage2usd.common.errors import ConfigError  # noqa: PLC0415 - keeps --help instant
    from garage2usd.common.output import check_file, drafting, publish_at, staging_folder  # noqa: PLC0415
    from garage2usd.view.plan_picture import draw_plan  # noqa: PLC0415
    from garage2usd.view.raster import to_image, write_png  # noqa: PLC0415
    from garage2usd.view.route import find_stall  # noqa: PLC0415
    from garage2usd.view.svg import to_svg  # noqa: PLC0415

    several = _levels(path, seed)
    if several is not None:
        asked = {"stall": number, "findings": with_findings, "optimum": with_optimum}
        _draw_levels(several, outputs or (Path(f"{path.stem.removesuffix('_report')}_plan.svg"),), asked)
        return
    outputs = outputs or (Path(f"{path.stem.removesuffix('_report')}_plan.svg"),)
    for output in outputs:
        if output.suffix.lower() not in _FORMATS or not output.stem:
            raise ConfigError("output", str(output), f"a path that ends in {', '.join(_FORMATS)}")
        check_file(output)
    with Bars(sys.stderr) as progress:
        garage = _garage(path, seed, progress)
        # before the check of a stage, which limits the processor time of all later work
        told = _beside_optimum(garage, progress) if with_optimum else []
    stall = find_stall(garage.layout, number) if number else None
    marks = _marks(path) if with_findings else []
    drawing = draw_plan(garage.layout, stall=stall, marks=marks)
    with staging_folder(outputs[0]) as staging:
        places = {staging / str(number): output for number, output in enumerate(outputs)}
        for file, output in places.items():
            with drafting(output):
                if output.suffix.lower() == ".svg":
                    file.write_text(to_svg(drawing), encoding="utf-8", newline="\n")
                else:
                    write_png(to_image(drawing), file)
        publish_at(places)
    echo_table([*(("picture", str(output)) for output in outputs), *told])


def _levels(path: Path, seed: int | None) -> "LevelsGarage | None":
    """The garage of several levels of a configuration, a report, or a stage beside its report; None of another."""
    from garage2usd.buildings import generate_levels  # noqa: PLC0415 - keeps --help instant
    from garage2usd.common.documents import is_file  # noqa: PLC0415
    from garage2usd.config import load_config  # noqa: PLC0415
    from garage2usd.reading.levels_report import read_levels_report  # noqa: PLC0415
    from garage2usd.stage import StageFormat  # noqa: PLC0415

    suffix = path.suffix.lower()
    if suffix == ".toml":
        config = load_config(path)
        return None if config.building.levels == 1 else generate_levels(config, seed=seed)
    report = path.with_name(f"{path.stem}_report.json") if suffix in set(StageFormat) else path
    if report.suffix.lower() != ".json" or not is_file(report):
        return None
    found = read_levels_report(report)
    if found is None:
        return None
    refuse_seed(seed)
    return generate_levels(found.config, seed=found.seed, tape=found.tape)


def _draw_levels(garage: "LevelsGarage", outputs: tuple[Path, ...], refused: "Mapping[str, object]") -> None:
    """Draw a sheet for each level and a section, named after the picture; `refused` goes with one level only."""
    from garage2usd.common.errors import ConfigError  # noqa: PLC0415 - keeps --help instant
    from garage2usd.common.output import check_file, publish_at, staging_folder  # noqa: PLC0415
    from garage2usd.view.plan_picture import draw_plan  # noqa: PLC0415
    from garage2usd.view.raster import to_image, write_png  # noqa: PLC0415
    from garage2usd.view.section import draw_section  # noqa: PLC0415
    from garage2usd.view.svg import to_svg  # noqa: PLC0415

    for option, value in refused.items():
        if value:
            raise ConfigError(option, value, "not with several levels, for which it is not built yet")
    for output in outputs:
        if output.suffix.lower() not in _FORMATS or not output.stem:
            raise ConfigError("output", str(output), f"a path that ends in {', '.join(_FORMATS)}")
    drawings = {
        name: draw_plan(level.layout) for name, level in zip(garage.building.names(), garage.levels, strict=True)
    }
    drawings["section"] = draw_section(garage.layouts, storey_m=garage.building.storey_m)
    sheets = [
        (output.with_name(f"{output.stem}_{name}{output.suffix}"), drawing)
        for output in outputs
        for name, drawing in drawings.items()
    ]
    for place, _ in sheets:
        check_file(place)
    with staging_folder(outputs[0]) as staging:
        places = {staging / str(number): place for number, (place, _) in enumerate(sheets)}
        for file, (place, drawing) in zip(places, sheets, strict=True):
            if place.suffix.lower() == ".svg":
                file.write_text(to_svg(drawing), encoding="utf-8", newline="\n")
            else:
                write_png(to_image(drawing), file)
        publish_at(places)
    echo_table(("picture", str(place)) for place, _ in sheets)


def _marks(path: Path) -> "list[Mark]":
    """Findings of a check that have places."""
    from garage2usd.checks import check_file  # noqa: PLC0415 - keeps --help instant
    from garage2usd.view.plan_sheet import Mark  # noqa: PLC0415

    findings, _ = check_file(path)
    return [
        Mark(*finding.position_m, finding.severity.value, f"{finding.rule}: {finding.message}")
        for finding in findings
        if finding.position_m is not None
    ]


def _beside_optimum(garage: "Garage", progress: "Progress") -> list[tuple[str, str]]:
    """Score of a garage's plan, and its share of the proven optimum on the same squares."""
    from garage2usd.planning import find_optimum  # noqa: PLC0415 - keeps --help instant

    plan, config = garage.plan, garage.config
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


def _garage(path: Path, seed: int | None, progress: "Progress") -> "Garage":
    """Make a garage from a configuration, or rebuild it from a report."""
    from garage2usd.common.documents import is_file  # noqa: PLC0415
    from garage2usd.common.errors import ConfigError  # noqa: PLC0415
    from garage2usd.config import load_config  # noqa: PLC0415 - keeps --help instant
    from garage2usd.pipeline import generate  # noqa: PLC0415
    from garage2usd.reading.report import read_report  # noqa: PLC0415
    from garage2usd.stage import StageFormat  # noqa: PLC0415

    suffix = path.suffix.lower()
    if suffix == ".toml":
        return generate(load_config(path), seed=seed, progress=progress)
    refuse_seed(seed)
    if suffix == ".json":
        return generate(read_report(path).garage_config(), progress=progress)
    if suffix in set(StageFormat):
        if not is_file(path):
            raise ConfigError("PATH", str(path), "an existing file")
        report = path.with_name(f"{path.stem}_report.json")
        if not is_file(report):
            raise ConfigError("PATH", str(path), f"a stage with the report of its build beside it, {report.name}")
        return generate(read_report(report).garage_config(), progress=progress)
    raise ConfigError("PATH", str(path), f"a path that ends in .toml, .json, {', '.join(StageFormat)}")
