"""The command ``garage2usd drive``."""

import sys
from collections import Counter
from pathlib import Path
from typing import TYPE_CHECKING

import click

from garage2usd.cli.bars import Bars
from garage2usd.cli.options import INPUT_FILE, drive_options, echo_notices, output_option, seed_option
from garage2usd.common.errors import ConfigError

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping, Sequence

    from garage2usd.common.progress import Progress
    from garage2usd.config.vehicles import CarBody
    from garage2usd.driving import StallProof
    from garage2usd.garage_sources import BuiltSource
    from garage2usd.maps.drives import Drive

_FORMATS = (".json", ".usda", ".usdc")
_TRAJECTORY_FORMATS, _ANIMATION_FORMATS = (".csv", ".json"), (".usda", ".usdc")


@click.command(short_help="Prove that a car gets into each stall and out again.")
@click.argument("path", required=False, type=INPUT_FILE)
@seed_option
@output_option(
    "Write the ways: .json with poses and moves, .usda or .usdc as curves to put over the stage. With --stall the "
    "trajectory: .csv or .json; with --animate .usda or .usdc."
)
@drive_options("With --stall", "Drive from an entrance to this stall, park, and drive to an exit")
@click.option("--animate", is_flag=True, help="With --stall: write the car in time, to put over the stage.")
@click.option("--rig", metavar="RIG", help="With --animate: draw the car of a rig, which may be a model of one's own.")
def drive(
    *,
    path: Path | None,
    seed: int | None,
    output: Path | None,
    stall: str | None,
    entrance: int | None,
    exit_: int | None,
    leg: str | None,
    animate: bool,
    rig: str | None,
) -> None:
    """Prove that a car can drive into each stall and out again without a collision.

    PATH is a configuration, from which the garage is made as by `build`; a stage, including one edited in other tools;
    or the report of a build. Without PATH the default garage is used. The car is 4.8 x 1.8 m with a turning radius of
    6 m. Access aisles, turning stalls and stalls for motorcycles are left out, since no car parks there. Stalls without
    a path are listed with the objects in the way, and the exit code is 1. In a garage of several levels the stalls of
    all levels are proven, from the street and back to it.

    With --stall the car drives from an entrance into the stall and on to an exit, over ramps and lanes. Its speed
    follows the settings `maps.drive` of a configuration or report, else the defaults. Gates are open. In a stage of
    several levels it drives over the ramps between them; the number of a stall begins with its level, U2/A1-08.

    \b
    Examples:
      garage2usd drive garage.usdz
      garage2usd drive --seed 7 -o ways.json
      garage2usd drive garage.usdz --stall A1-08 -o trajectory.csv
      garage2usd drive garage.usdz --stall A1-08 --animate -o car.usdc
      garage2usd drive garage.usdz --stall A1-08 --animate --rig own.toml -o car.usdc
    """  # noqa: D301 - click's mark for a block that is not wrapped
    from garage2usd.common.output import check_file, check_name  # noqa: PLC0415 - keeps --help instant

    if rig is not None and not animate:
        raise ConfigError("rig", rig, "only with --animate")
    if stall is None:
        _refuse_without_stall(entrance=entrance, exit=exit_, leg=leg, animate=animate or None)
    elif animate and output is None:
        raise ConfigError("output", None, f"a path that ends in {', '.join(_ANIMATION_FORMATS)}, with --animate")
    if output is not None:
        formats = _FORMATS if stall is None else _ANIMATION_FORMATS if animate else _TRAJECTORY_FORMATS
        if output.suffix.lower() not in formats:
            with_stall = "" if stall is None else " with --stall and --animate" if animate else " with --stall"
            raise ConfigError("output", str(output), f"a path that ends in {', '.join(formats)}{with_stall}")
        check_name(output, of_layer=output.suffix.lower() in _ANIMATION_FORMATS)
        check_file(output)
    if stall is not None:
        _drive_to(path, seed, stall, entrance=entrance, exit_=exit_, leg=leg or "both", output=output, rig=rig)
        return
    from garage2usd.as_built.proofs import floors_m_of_stalls  # noqa: PLC0415 - keeps --help instant

    with Bars(sys.stderr) as progress:
        source = _source(path, seed, progress)
        proofs, floors_m = source.proofs(progress=progress), floors_m_of_stalls(source.garage)
    if output is not None:
        _write(output, proofs, floors_m)
    _describe(proofs)
    if not all(proof.is_proven for proof in proofs):
        raise click.exceptions.Exit(1)


def _refuse_without_stall(**given: object) -> None:
    for option, value in given.items():
        if value is not None:
            raise ConfigError(option, value, "only with --stall")


def _drive_to(
    path: Path | None,
    seed: int | None,
    stall: str,
    *,
    entrance: int | None,
    exit_: int | None,
    leg: str,
    output: Path | None,
    rig: str | None,
) -> None:
    """Drive to one stall and print the result."""
    from garage2usd.config.outputs import Leg  # noqa: PLC0415 - keeps --help instant
    from garage2usd.maps.drives import DrivePlanner  # noqa: PLC0415
    from garage2usd.sensors.rig.rig import read_rig  # noqa: PLC0415

    carrier = None if rig is None else read_rig(rig)
    if carrier is not None:
        echo_notices(carrier.remarks)
    car = None if carrier is None else carrier.body
    with Bars(sys.stderr) as progress:
        source = _source(path, seed, progress)
        progress("drive", 0, 1)
        driven = DrivePlanner(source.garage, source.drive).drive(stall, entrance=entrance, exit=exit_, leg=Leg(leg))
    if output is not None:
        _write_drive(output, driven, car)
    route, states = driven.route, driven.trajectory
    ways = {"in": ("arrival", route.arrival), "out": ("departure", route.departure)}
    for name, (word, way) in ways.items():
        if leg in {"both", name}:
            portal = route.entrance if name == "in" else route.exit
            click.echo(f"{word:>12}  {way.length_m:.1f} m {'from' if name == 'in' else 'to'} the portal {portal.name}")
    click.echo(f"{'nose':>12}  {route.nose.value}")
    click.echo(f"{'seconds':>12}  {states.time_s[-1]:.1f}")
    click.echo(f"{'fastest':>12}  {abs(states.speed_m_s).max():.2f} m/s")
    for aisle in driven.narrow_aisles:
        click.echo(f"{'in the middle':>12}  of {aisle}, too narrow for two cars")
    if not route.is_full:
        click.echo(f"{route.stall}: only while the stalls that are empty now stay empty")


def _source(path: Path | None, seed: int | None, progress: "Progress") -> "BuiltSource":
    """Read a finished garage from a stage or a report, or make that of a configuration."""
    from garage2usd.config import load_config  # noqa: PLC0415 - keeps --help instant
    from garage2usd.garage_sources import built_source, read_built, refuse_seed  # noqa: PLC0415
    from garage2usd.pipeline import generate  # noqa: PLC0415
    from garage2usd.reading.files import STAGE_SUFFIXES  # noqa: PLC0415

    if path is not None and path.suffix.lower() in {*STAGE_SUFFIXES, ".json"}:
        refuse_seed(seed)
        return read_built(path, progress=progress)
    made = generate(load_config(path) if path else None, seed=seed, progress=progress)
    return built_source(made, source=str(path or ""))


def _write_drive(output: Path, driven: "Drive", car: "CarBody | None") -> None:
    from garage2usd.driving.trajectory import write_trajectory_csv, write_trajectory_json  # noqa: PLC0415
    from garage2usd.stage.driving_car import write_driving_car  # noqa: PLC0415

    def write(file: Path) -> "Sequence[Path]":
        if file.suffix == ".csv":
            write_trajectory_csv(file, driven.trajectory)
        elif file.suffix == ".json":
            write_trajectory_json(file, driven.trajectory, driven.car, driven.facts)
        else:
            return write_driving_car(file, driven.motion, car)
        return ()

    _publish(output, write)


def _write(output: Path, proofs: "Sequence[StallProof]", floors_m: "Mapping[str, float]") -> None:
    from garage2usd.driving.trajectory import write_witness  # noqa: PLC0415 - keeps --help instant
    from garage2usd.stage.curves import write_driving_layer  # noqa: PLC0415

    def write(file: Path) -> "Sequence[Path]":
        if file.suffix == ".json":
            write_witness(file, proofs, floors_m=floors_m)
        else:
            write_driving_layer(file, proofs, floors_m=floors_m)
        return ()

    _publish(output, write)


def _publish(output: Path, write: "Callable[[Path], Sequence[Path]]") -> None:
    """Write a file under its name with a lower-case extension, then move it and its dependencies into place."""
    from garage2usd.common.output import publish_at, staging_folder  # noqa: PLC0415 - keeps --help instant

    with staging_folder(output) as staging:
        file = staging / f"drive{output.suffix.lower()}"
        beside = write(file)
        publish_at({**{path: output.parent / path.relative_to(staging) for path in beside}, file: output})


def _describe(proofs: "Sequence[StallProof]") -> None:
    proven = [proof for proof in proofs if proof.way_in is not None and proof.way_out is not None]
    click.echo(f"{len(proven)} of {len(proofs)} stalls are driven into and out of without a touch")
    noses = Counter(f"nose {proof.nose}" for proof in proven)
    changes = Counter(proof.way_in.gear_changes for proof in proven if proof.way_in)
    for name, count in noses.most_common():
        click.echo(f"{count:6}  {name}")
    for number, count in sorted(changes.items()):
        click.echo(f"{count:6}  with {number} change{'' if number == 1 else 's'} of gear on the way in")
    for proof in proven:
        if not proof.is_full:
            click.echo(f"{proof.stall}: only while the stalls that are empty now stay empty")
        if proof.backs_out:
            click.echo(f"{proof.stall}: backs out along a dead-end aisle")
    for proof in proofs:
        if not proof.is_proven:
            alone = "in the way" if proof.is_single_cause else "touched"
            outcome = "undecided, as the search ended at its bound" if proof.is_undecided else "no way"
            nothing = "nothing" if proof.is_undecided else "no lane to begin at"
            click.echo(f"{proof.stall}: {outcome}; {alone}: {', '.join(proof.touched[:6]) or nothing}")
