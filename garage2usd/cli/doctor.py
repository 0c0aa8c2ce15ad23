"""The command ``garage2usd doctor``."""

import hashlib
import sys
import time

import click

from garage2usd.cli.options import count_option, echo_table
from garage2usd.common.errors import Garage2UsdError
from garage2usd.common.package import VERSION
from garage2usd.common.system import HAS_EMBREE, in_words

_PACKAGES = {"numpy": "NumPy", "scipy": "SciPy", "shapely": "Shapely", "usd-core": "USD"}
_SIDES = 7, 9
_DIGITS = 12


@click.command(short_help="Check this installation and print a report.")
@count_option("--seeds", 1000, 3, "How many garages are made, of the seeds from 1 on.")
def doctor(*, seeds: int) -> None:
    """Check this installation and print a report: packages, compiled loops, rays, Blender and small garages.

    Each garage is planned, built, checked and driven in a temporary folder. Two machines make the same
    garages if they print the same digests of plan, stage and drives. The exit code is 1 if an installed component does
    not work.

    \b
    Example:
      garage2usd doctor > report.txt
    """  # noqa: D301 - click's mark for a block that is not wrapped
    from garage2usd.native import LIBRARY, load  # noqa: PLC0415 - keeps --help instant

    python = ".".join(map(str, sys.version_info[:3]))
    echo_table([("garage2usd", f"{VERSION}, Python {python}, {in_words()}"), ("packages", _versions())])
    faults: list[str] = []
    try:
        load()
        echo_table([("loops", LIBRARY.name)])
    except (OSError, RuntimeError) as error:
        faults.append(f"loops: {error}")
    echo_table([("rays", _rays()), ("Blender", _blender())])
    for seed in range(1, seeds + 1) if not faults else ():
        begun = time.perf_counter()
        try:
            told, wrong = _garage(seed)
        except Garage2UsdError as error:
            faults.append(f"seed {seed}: {error}")
            continue
        faults += [f"seed {seed}: {each}" for each in wrong]
        echo_table([(f"seed {seed}", f"{told}, {time.perf_counter() - begun:.1f} s")])
    echo_table([("faults", fault) for fault in faults] or [("faults", "none")])
    if faults:
        raise click.exceptions.Exit(1)


def _versions() -> str:
    from importlib.metadata import version  # noqa: PLC0415 - keeps --help instant

    return ", ".join(f"{words} {version(name)}" for name, words in _PACKAGES.items())


def _rays() -> str:
    from garage2usd.common.package import RAYS, is_there  # noqa: PLC0415 - keeps --help instant

    if not all(is_there(module) for module in RAYS):
        return "not installed (extra sensors)"
    return "by Embree" if HAS_EMBREE else "by NumPy, slowly, as embreex has no package for this machine"


def _blender() -> str:
    from garage2usd.common.package import is_there  # noqa: PLC0415 - keeps --help instant
    from garage2usd.render.blender_process import find_blender, modules_of  # noqa: PLC0415

    blender = find_blender()
    missing = [module for module in modules_of(blender) if not is_there(module)]
    if missing:
        return f"not there: {', '.join(missing)} (extra blender)"
    return "the Python module bpy" if blender.program is None else str(blender.program)


def _garage(seed: int) -> tuple[str, list[str]]:
    """Make a garage; return its line of the report, and its errors."""
    from garage2usd.checks import Severity  # noqa: PLC0415 - keeps --help instant
    from garage2usd.common.output import staging_folder  # noqa: PLC0415
    from garage2usd.config import GarageConfig  # noqa: PLC0415
    from garage2usd.driving import prove_stalls  # noqa: PLC0415
    from garage2usd.driving.trajectory import write_witness  # noqa: PLC0415
    from garage2usd.garage_sources import check  # noqa: PLC0415
    from garage2usd.pipeline import build  # noqa: PLC0415
    from garage2usd.reading.files import stage_digest  # noqa: PLC0415
    from garage2usd.structure.symmetry import plan_digest  # noqa: PLC0415

    height, width = _SIDES
    config = GarageConfig(seed=seed, site={"width_cells": width, "height_cells": height})
    with staging_folder() as folder:
        made = build(config, folder / "garage.usdc")
        stage = stage_digest(made.stage, digits=_DIGITS)
        findings, _ = check(made.stage)
        proofs = prove_stalls(made.garage.layout)
        ways = folder / "ways.json"
        write_witness(ways, proofs)
        driven = hashlib.sha256(ways.read_bytes()).hexdigest()[:_DIGITS]
    wrong = [f"{each.rule}: {each.place} {each.message}" for each in findings if each.severity is Severity.ERROR]
    plan = plan_digest(made.garage.layout.structure.cells)[:_DIGITS]
    proven = sum(proof.is_proven for proof in proofs)
    return f"plan {plan}, stage {stage}, ways {driven}, {proven} of {len(proofs)} stalls driven", wrong
