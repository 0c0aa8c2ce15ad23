"""A garage from the file that a command is given: a configuration, the report of a build, or a stage."""

from collections.abc import Sequence
from pathlib import Path
from typing import NamedTuple

from garage2usd import checks
from garage2usd.as_built.garage import BuiltGarage, garage_as_made, garage_of_file
from garage2usd.as_built.plan_reader import garage_of_plan, report_differences
from garage2usd.as_built.proofs import prove_built
from garage2usd.as_built.stage_reader import profile_name
from garage2usd.checks import Finding
from garage2usd.common.documents import MAX_REPORT_BYTES, is_file, read_json
from garage2usd.common.errors import ConfigError, ReportError
from garage2usd.common.progress import Progress, silent
from garage2usd.config import GarageConfig, load_config
from garage2usd.config.outputs import DriveConfig, Leg
from garage2usd.config.traffic import TrafficConfig
from garage2usd.driving import StallProof
from garage2usd.garage import Fault
from garage2usd.garage_model import Garage
from garage2usd.maps.drives import Drive, DrivePlanner
from garage2usd.pipeline import generate
from garage2usd.profiles import DEFAULT_PROFILE, PROFILE_NAMES, Profile, load_profile
from garage2usd.reading.files import STAGE_SUFFIXES
from garage2usd.reading.report import LevelReport, Report, read_report, report_of
from garage2usd.stage import StageFormat

_SETTINGS, _REPORT = ".toml", ".json"


class BuiltSource(NamedTuple):
    """A garage as built, the profile to check it against, and the settings of drives and traffic in it."""

    garage: BuiltGarage
    profile: Profile
    drive: DriveConfig
    traffic: TrafficConfig = TrafficConfig()

    def findings(self, *, progress: Progress = silent) -> list[Finding]:
        """Return the findings under the profile and by the rules that need none, errors first."""
        return checks.findings_of(self.garage, self.profile, progress=progress)

    def not_checked(self) -> dict[str, str]:
        """Return the profile clauses that no rule can check on the garage, each with the reason."""
        return checks.not_checked(self.garage.levels[0], self.profile)

    def proofs(self, *, progress: Progress = silent) -> tuple[StallProof, ...]:
        """Prove for each stall that the design car drives in and out, from the street and back to it."""
        return prove_built(self.garage, progress=progress)


def check(source: str | Path | Garage, *, profile: Profile | None = None) -> tuple[list[Finding], Profile]:
    """Check a garage against a profile.

    Parameters
    ----------
    source
        A garage as `generate` and `import_layout` make it, or a file: a stage (``.usd``, ``.usda``, ``.usdc``,
        ``.usdz``), also one that was edited, a report (``.json``), a configuration with a structure (``.toml``), or a
        structure as text, JSON, ``.npy`` or ``.npz``.
    profile
        Profile to check against. The default is the one that the source names, or else ``cn-jgj100``.

    Returns
    -------
    tuple
        The findings, errors first, and the profile.

    Raises
    ------
    ConfigError, ReportError, StageError
        If the file is none of these.
    """
    built = _built(source, profile=profile)
    return built.findings(), built.profile


def drive(
    source: str | Path | Garage,
    stall: str | None = None,
    *,
    entrance: int | None = None,
    exit: int | None = None,  # noqa: A002 - the garage's word
    leg: Leg = Leg.BOTH,
    settings: DriveConfig | None = None,
) -> Drive:
    """Drive from the street into a stall and back.

    Parameters
    ----------
    source
        A garage, or the file of one, as for `check`.
    stall, entrance, exit, leg
        As for `garage2usd.maps.drives.DrivePlanner.drive`.
    settings
        Limits of the car's motion; those of the source if left out.

    Raises
    ------
    ConfigError, ReportError, StageError
        If the file is not a garage, the stall or portal does not exist, or no drive joins them.
    """
    built = _built(source)
    return DrivePlanner(built.garage, settings or built.drive).drive(stall, entrance=entrance, exit=exit, leg=leg)


def _built(source: str | Path | Garage, *, profile: Profile | None = None) -> BuiltSource:
    if not isinstance(source, Garage):
        return read_built(source, profile=profile)
    built = built_source(source, source="a garage")
    return built._replace(profile=profile or built.profile)


def read_built(path: str | Path, *, profile: Profile | None = None, progress: Progress = silent) -> BuiltSource:
    """Read a garage as it is in a stage, a report, or a plan.

    Parameters
    ----------
    path
        A stage, the report of a build, a configuration with a structure, or a structure as text, JSON or a NumPy file.
    profile
        Profile to check against. The default is the one that the file names, or else ``cn-jgj100``.
    progress
        Told how many levels of a stage are read, or how far those of a report are, which are made again from its tape.

    Raises
    ------
    ConfigError, ReportError, StageError
        If the file is none of these.
    """
    path = Path(path)
    if not is_file(path):
        raise ConfigError("PATH", str(path), "an existing file")
    if path.suffix.lower() in STAGE_SUFFIXES:
        garage = garage_of_file(path, progress=progress)
        name = profile_name(garage.stage)
        against = profile or load_profile(name if name in PROFILE_NAMES else DEFAULT_PROFILE)
        return BuiltSource(garage, against, DriveConfig())
    report = _report_in(path)
    # a plan of one level is read as it is, so that its faults become findings
    if report is None or len(report.levels) == 1:
        plan, config = garage_of_plan(path, report=report, profile=profile)
        return BuiltSource(plan, profile or config.standard, config.maps.drive, config.traffic)
    made = generate(report.config, seed=report.seed, tape=report.tape, progress=progress)
    source = built_source(made, source=str(path), faults=_differences(made, report.levels))
    return source._replace(profile=profile or source.profile)


def _report_in(path: Path) -> Report | None:
    """Read a report; None from a file of another kind, or JSON that is a plan."""
    if path.suffix.lower() != _REPORT:
        return None
    document = read_json(path, field="PATH", max_bytes=MAX_REPORT_BYTES)
    if not (isinstance(document, dict) and "config" in document):
        return None
    try:
        return report_of(document, path)
    except ReportError as error:
        raise ReportError(path, f"{error.reason}; check reads a report with config, S, R and C") from None


def built_source(garage: Garage, *, source: str, faults: tuple[Fault, ...] = ()) -> BuiltSource:
    """Return a generated garage as built; `faults` are contradictions in the file that it comes from."""
    built = garage_as_made(garage, source=source, kind="plan", faults=faults)
    return BuiltSource(built, garage.config.standard, garage.config.maps.drive, garage.config.traffic)


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
    config, tape = settings_and_tape(read_report(report))
    return generate(config, tape=tape, progress=progress)


def settings_and_tape(report: Report) -> tuple[GarageConfig, str | None]:
    """Return the settings and the tape by which `garage2usd.generate` makes a reported garage again.

    The settings of a single level have its lanes, and need no tape.
    """
    if len(report.levels) == 1:
        return report.garage_config(), None
    return report.config.with_seed(report.seed), report.tape


def refuse_seed(seed: int | None) -> None:
    """Raise `ConfigError` for a seed in addition to a finished garage."""
    if seed is not None:
        raise ConfigError("seed", seed, "a seed beside a configuration only, as this garage is made already")


def _differences(garage: Garage, told: Sequence[LevelReport]) -> tuple[Fault, ...]:
    """Compare the matrices and stalls of the levels of a report with those that its tape gives."""
    faults = [] if len(told) == len(garage.levels) else [Fault("report-stalls", "", None, "its tape has other levels")]
    for level, each in zip(garage.levels, told, strict=False):
        structure = level.plan.structure
        matrices = tuple(str(structure).splitlines()), tuple(structure.R[0].tolist()), tuple(structure.C[:, 0].tolist())
        if matrices != (each.S, each.R, each.C):
            faults.append(Fault("report-stalls", level.name, None, "the report has another plan than its tape"))
        found = [] if each.stalls is None else report_differences(level.layout, each.stalls)
        faults += [fault._replace(place=level.place.in_whole(fault.place)) for fault in found]
    return tuple(faults)
