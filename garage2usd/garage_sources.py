"""A garage from the file that a command is given: a configuration, the report of a build, or a stage."""

from collections.abc import Mapping, Sequence
from dataclasses import replace
from pathlib import Path
from typing import NamedTuple

from garage2usd import checks
from garage2usd.as_built import BuiltGarage
from garage2usd.as_built.driven_ground import driven_garage
from garage2usd.as_built.driven_levels import floors_of_stalls, prove_levels
from garage2usd.as_built.layout_reader import garage_of_layout
from garage2usd.as_built.levels import BuiltLevels, laid_out_levels
from garage2usd.as_built.plan_reader import garage_of_plan, report_differences
from garage2usd.checks import Finding
from garage2usd.checks.levels import check_levels, read_stage
from garage2usd.common.documents import is_file
from garage2usd.common.errors import ConfigError
from garage2usd.common.progress import Progress, silent
from garage2usd.config import load_config
from garage2usd.config.maps import DriveConfig
from garage2usd.driving import StallProof, prove_garage, prove_stalls
from garage2usd.garage import Fault
from garage2usd.garage_files import read_garage_report
from garage2usd.garage_model import Garage
from garage2usd.layout import Layout
from garage2usd.pipeline import generate
from garage2usd.profiles import Profile
from garage2usd.reading.files import STAGE_SUFFIXES
from garage2usd.reading.levels_report import LevelReport, read_levels_report
from garage2usd.stage import StageFormat

__all__ = ["BuiltSource", "built_source", "generated_of", "read_built", "refuse_seed"]

_SETTINGS, _REPORT = ".toml", ".json"


class BuiltSource(NamedTuple):
    """A garage as built, the profile to check it against, and the settings of drives in it.

    Attributes
    ----------
    garage, profile, drive
        These three.
    layout
        The layout of a generated garage of one level, whose stalls are proven among its outlines.
    """

    garage: BuiltGarage | BuiltLevels
    profile: Profile
    drive: DriveConfig
    layout: Layout | None = None

    def findings(self) -> list[Finding]:
        """Return the findings under the profile and by the rules that need none, errors first."""
        if isinstance(self.garage, BuiltLevels):
            return check_levels(self.garage, self.profile, checks.RULES)
        return checks.check(self.garage, self.profile)

    def not_checked(self) -> dict[str, str]:
        """Return the profile clauses that no rule can check on the garage, each with the reason."""
        garage = self.garage
        return checks.not_checked(garage.levels[0].garage if isinstance(garage, BuiltLevels) else garage, self.profile)

    def proofs(self, *, progress: Progress = silent) -> tuple[StallProof, ...]:
        """Prove for each stall that the design car drives in and out, from the street and back to it."""
        if isinstance(self.garage, BuiltLevels):
            return prove_levels(self.garage, progress=progress)
        if self.layout is not None:
            return prove_stalls(self.layout, progress=progress)
        return prove_garage(driven_garage(self.garage), progress=progress)

    def floors_m(self) -> Mapping[str, float] | None:
        """Return the height of the floor under each stall, by its name; None in a garage of one level."""
        return floors_of_stalls(self.garage) if isinstance(self.garage, BuiltLevels) else None


def read_built(path: Path, *, profile: Profile | None = None, progress: Progress = silent) -> BuiltSource:
    """Read a garage as it is in a stage, a report, or a plan.

    Parameters
    ----------
    path
        A stage, the report of a build, a configuration with a structure, or a structure as text, JSON or a NumPy file.
    profile
        Profile to check against. The default is the one that the file names, or else ``cn-jgj100``.
    progress
        Told how far the levels of a report are, which are made again from its tape.

    Raises
    ------
    ConfigError, ReportError, StageError
        If the file is none of these.
    """
    if not is_file(path):
        raise ConfigError("PATH", str(path), "an existing file")
    if path.suffix.lower() in STAGE_SUFFIXES:
        garage, against = read_stage(path, profile=profile)
        return BuiltSource(garage, against, DriveConfig())
    levels = read_levels_report(path) if path.suffix.lower() == _REPORT else None
    if levels is None:
        plan, config = garage_of_plan(path, profile=profile)
        return BuiltSource(plan, profile or config.standard, config.maps.drive)
    made = generate(levels.config, seed=levels.seed, tape=levels.tape, progress=progress)
    source = built_source(made, source=str(path), faults=_differences(made, levels.levels))
    return source._replace(profile=profile or source.profile)


def built_source(garage: Garage, *, source: str, faults: tuple[Fault, ...] = ()) -> BuiltSource:
    """Return a generated garage as built; `faults` are contradictions in the file that it comes from."""
    profile, drive = garage.config.standard, garage.config.maps.drive
    if garage.building.ramps is None:
        layout = garage.layout
        return BuiltSource(garage_of_layout(layout, source=source, kind="plan", faults=faults), profile, drive, layout)
    built = laid_out_levels(garage.layouts, garage.joined, source=source)
    return BuiltSource(replace(built, faults=faults), profile, drive)


def generated_of(path: Path, seed: int | None, *, progress: Progress = silent) -> Garage:
    """Make the garage of a configuration, or that of a report or of the report beside a stage again.

    Raises
    ------
    ConfigError
        If the file is none of these, has no report beside it, or a seed is given for a garage that is made already.
    """
    suffix = path.suffix.lower()
    if suffix == _SETTINGS:
        return generate(load_config(path), seed=seed, progress=progress)
    if suffix not in {_REPORT, *StageFormat}:
        raise ConfigError("PATH", str(path), f"a path that ends in .toml, .json, {', '.join(StageFormat)}")
    refuse_seed(seed)
    report = path
    if suffix != _REPORT:
        if not is_file(path):
            raise ConfigError("PATH", str(path), "an existing file")
        report = path.with_name(f"{path.stem}_report.json")
        if not is_file(report):
            raise ConfigError("PATH", str(path), f"a stage with the report of its build beside it, {report.name}")
    reported = read_garage_report(report)
    return generate(reported.config, tape=reported.tape, progress=progress)


def refuse_seed(seed: int | None) -> None:
    """Raise `ConfigError` for a seed in addition to a finished garage."""
    if seed is not None:
        raise ConfigError("seed", seed, "a seed beside a configuration only, as this garage is made already")


def _differences(garage: Garage, told: Sequence[LevelReport]) -> tuple[Fault, ...]:
    """Compare the matrices and stalls of the levels of a report with those that its tape gives."""
    faults = [] if len(told) == len(garage.levels) else [Fault("report-stalls", "", None, "its tape has other levels")]
    for level, each in zip(garage.levels, told, strict=False):
        structure, report = level.plan.structure, each.report
        matrices = tuple(str(structure).splitlines()), tuple(structure.R[0].tolist()), tuple(structure.C[:, 0].tolist())
        if matrices != (report.S, report.R, report.C):
            faults.append(Fault("report-stalls", level.name, None, "the report has another plan than its tape"))
        found = [] if report.stalls is None else report_differences(level.layout, report.stalls)
        faults += [fault._replace(place=level.in_whole(fault.place)) for fault in found]
    return tuple(faults)
