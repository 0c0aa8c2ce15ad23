"""``garage2usd drive``."""

import sys
from collections import Counter
from pathlib import Path
from typing import TYPE_CHECKING

import click

from garage2usd.cli.bars import Bars
from garage2usd.cli.parameters import INPUT_FILE, refuse_seed, seed_option
from garage2usd.errors import ConfigError

if TYPE_CHECKING:
    from collections.abc import Sequence

    from garage2usd.driving import StallProof
    from garage2usd.progress import Progress

__all__ = ["drive"]

_FORMATS = (".json", ".usda", ".usdc")


@click.command(short_help="Prove that a car gets into each stall and out again.")
@click.argument("path", required=False, type=INPUT_FILE)
@seed_option
@click.option(
    "--output",
    "-o",
    metavar="FILE",
    type=click.Path(path_type=Path),
    help="Write the ways: .json with poses and moves, .usda or .usdc as curves to put over the stage.",
)
def drive(*, path: Path | None, seed: int | None, output: Path | None) -> None:
    """Prove that a car drives into each stall and out again without a touch.

    PATH is a configuration, and the garage the one that `build` makes of it and the seed; or a stage, also one that
    other tools have edited, or the report of a build. Without PATH it is the default garage. The car is 4.8 x 1.8 m
    with a turning radius of 6 m. Access aisles and stalls for turning hold no car and are left out. Stalls without ways
    are named with what is in the way, and the exit code is 1.

    \b
    Examples:
      garage2usd drive garage.usdz
      garage2usd drive --seed 7 -o ways.json
    """  # noqa: D301 - click's mark for a block that is not wrapped
    from garage2usd.output import check_name, check_writable  # noqa: PLC0415 - keeps --help instant
    from garage2usd.reading.files import STAGE_SUFFIXES  # noqa: PLC0415

    if output is not None:
        if output.suffix not in _FORMATS:
            raise ConfigError("output", str(output), f"a path that ends in {', '.join(_FORMATS)}")
        check_name(output)
        check_writable(output.parent)
    with Bars(sys.stderr) as progress:
        if path is not None and path.suffix.lower() in (*STAGE_SUFFIXES, ".json"):
            refuse_seed(seed)
            proofs = _proofs_of_file(path, progress)
        else:
            proofs = _proofs_of_config(path, seed, progress)
    if output is not None:
        _write(output, proofs)
    _describe(proofs)
    if not all(proof.is_proven for proof in proofs):
        raise click.exceptions.Exit(1)


def _proofs_of_config(path: Path | None, seed: int | None, progress: "Progress") -> "tuple[StallProof, ...]":
    from garage2usd.config import load_config  # noqa: PLC0415 - keeps --help instant
    from garage2usd.driving import prove_stalls  # noqa: PLC0415
    from garage2usd.pipeline import generate  # noqa: PLC0415

    garage = generate(load_config(path) if path else None, seed=seed, progress=progress)
    return prove_stalls(garage.layout, garage.graph, progress=progress)


def _proofs_of_file(path: Path, progress: "Progress") -> "tuple[StallProof, ...]":
    from garage2usd.checks import read_subject  # noqa: PLC0415 - keeps --help instant
    from garage2usd.checks.driven_ground import driven_garage  # noqa: PLC0415
    from garage2usd.driving import prove_garage  # noqa: PLC0415

    return prove_garage(driven_garage(read_subject(path)[0]), progress=progress)


def _write(output: Path, proofs: "Sequence[StallProof]") -> None:
    from garage2usd.driving.witness import write_witness  # noqa: PLC0415 - keeps --help instant
    from garage2usd.output import publish, staging_folder  # noqa: PLC0415
    from garage2usd.stage.driving_layer import write_driving_layer  # noqa: PLC0415

    with staging_folder() as staging:
        file = staging / output.name
        if output.suffix == ".json":
            write_witness(file, proofs)
        else:
            write_driving_layer(file, proofs)
        publish([file], output.parent)


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
            click.echo(f"{proof.stall}: no way; {alone}: {', '.join(proof.touched[:6]) or 'no lane to begin at'}")
