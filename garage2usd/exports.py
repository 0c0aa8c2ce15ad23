"""A stage, or the garage that a report tells of, in the formats of programs that read no USD."""

from collections.abc import Callable, Iterable, Iterator, Sequence
from functools import cached_property, partial
from pathlib import Path

from garage2usd.checks import Subject
from garage2usd.checks.stage_reader import subject_of_stage
from garage2usd.config.maps import MapsConfig, ScenarioConfig
from garage2usd.errors import ConfigError
from garage2usd.extras import require
from garage2usd.maps.drives import DrivePlanner
from garage2usd.maps.glb import write_glb
from garage2usd.maps.network import Network
from garage2usd.maps.occupancy import write_grid
from garage2usd.maps.opendrive import write_opendrive
from garage2usd.maps.parked_cars import parked_cars
from garage2usd.maps.road_builder import network_of
from garage2usd.maps.stage_facts import stage_facts
from garage2usd.output import check_name, check_writable, publish, staging_folder
from garage2usd.pipeline import build
from garage2usd.processes import each_in_a_copy, without_collector
from garage2usd.progress import Progress, silent
from garage2usd.reading.files import STAGE_SUFFIXES, open_stage
from garage2usd.reading.objects import PlacedObject
from garage2usd.reading.remarks import Remarks
from garage2usd.reading.report import read_report
from garage2usd.reading.values import metres_y_up
from garage2usd.reading.walk import placed_objects

__all__ = ["EXPORT_SUFFIXES", "check_exports", "check_formats", "export"]

_REPORT, _SCENE, _LANELET2, _MAP, _SCENARIO = ".json", ".glb", ".osm", ".xodr", ".xosc"
_OF_EXTRA = {_LANELET2: ("a Lanelet2 map", "pyproj"), _SCENARIO: ("a scenario", "scenariogeneration")}
"""What needs a module of an extra, and which, by what its files end in."""
_Write = Callable[["_Source", Path, MapsConfig, Remarks], Sequence[Path]]
Notice = Callable[[str], None]
"""Takes a line on what a format cannot say."""


class _Source:
    """A stage that is open, and what is read in it once for several formats."""

    def __init__(self, path: Path) -> None:
        self.path, self.stage = path, open_stage(path)

    def read_for(self, places: Sequence[Path]) -> None:
        """Read all that several files need, so that copies of this process share it."""
        of_lanes = [place.suffix for place in places if place.suffix != _SCENE]
        if len(places) > 1:
            _ = self.objects
        if len(of_lanes) > 1:
            _ = self.subject.taken_stalls
        if {_LANELET2, _MAP} <= {*of_lanes}:
            _ = self.network

    @cached_property
    def objects(self) -> list[PlacedObject]:
        """Everything that it draws, in metres, Y up."""
        return placed_objects(self.stage, metres_y_up(self.stage))

    @cached_property
    def subject(self) -> Subject:
        """Its lanes, stalls and objects."""
        return subject_of_stage(self.stage, source=str(self.path), objects=self.objects, is_judged=False)

    @cached_property
    def network(self) -> Network:
        """Its roads."""
        return network_of(self.subject)


def _glb(source: _Source, path: Path, _settings: MapsConfig, remarks: Remarks) -> Sequence[Path]:
    write_glb(source.stage, path, objects=source.objects, remarks=remarks)
    return (path,)


def _opendrive(source: _Source, path: Path, settings: MapsConfig, _remarks: Remarks) -> Sequence[Path]:
    write_opendrive(source.subject, path, settings, network=source.network)
    return (path,)


def _grid(source: _Source, path: Path, settings: MapsConfig, _remarks: Remarks) -> Sequence[Path]:
    return write_grid(source.subject, path, settings.grid)


def _lanelet2(source: _Source, path: Path, settings: MapsConfig, _remarks: Remarks) -> Sequence[Path]:
    from garage2usd.maps.lanelet2 import write_lanelet2  # noqa: PLC0415 - other formats do without its extra

    write_lanelet2(source.subject, path, settings, network=source.network)
    return (path,)


def _scenario(source: _Source, path: Path, settings: MapsConfig, _remarks: Remarks) -> Sequence[Path]:
    from garage2usd.maps.openscenario import write_scenario  # noqa: PLC0415 - other formats do without its extra

    subject, asked = source.subject, settings.scenario
    planner = DrivePlanner(subject, settings.drive)
    drive = planner.drive(asked.stall, entrance=asked.entrance, exit=asked.exit, leg=asked.leg)
    seed = stage_facts(source.stage).get("seed")
    write_scenario(
        path,
        drive.trajectory,
        car=drive.car,
        settings=drive.settings,
        road_file=path.with_suffix(_MAP).name,
        parked=parked_cars(subject, free=[drive.route.stall]),
        name=f"{drive.route.stall} {drive.leg}",
        seed=None if seed is None else int(seed),
    )
    return (path,)


_WRITERS: dict[str, _Write] = {
    _SCENE: _glb,
    _SCENARIO: _scenario,
    _LANELET2: _lanelet2,
    ".yaml": _grid,
    _MAP: _opendrive,
}
"""The longest first: so files are begun, so that those that are written at a time end together."""


def _write(source: _Source, path: Path, settings: MapsConfig) -> tuple[list[Path], list[str]]:
    """The files that are written, and what their format cannot say."""
    path.parent.mkdir(exist_ok=True)
    remarks = Remarks()
    files = list(_WRITERS[path.suffix](source, path, settings, remarks))
    return files, remarks.lines()


def _unheard(_line: str) -> None:
    """Take no notice."""


EXPORT_SUFFIXES = tuple(sorted(_WRITERS))
"""What the files that `export` makes end in: GLB scenes, Lanelet2 maps, OpenDRIVE maps, OpenSCENARIO scenarios, and
YAML files of occupancy grids."""


def export(
    source: str | Path,
    outputs: Sequence[str | Path],
    *,
    settings: MapsConfig | None = None,
    scenario: ScenarioConfig | None = None,
    progress: Progress = silent,
    workers: int = 1,
    notice: Notice = _unheard,
) -> tuple[Path, ...]:
    """Write a garage in other formats.

    Parameters
    ----------
    source
        A stage, also one that other tools have edited, which is exported as it stands; or the report of a build
        (``.json``), whose garage is made again.
    outputs
        The files, one or more. What they end in says what they are: ``.glb`` a scene as binary glTF 2.0, ``.osm`` a
        Lanelet2 map, ``.xodr`` an OpenDRIVE 1.8 map, ``.xosc`` an OpenSCENARIO 1.2 scenario with the map that it names,
        a ``.xodr`` of the same stem beside it, ``.yaml`` an occupancy grid for robots with its picture (``.pgm``), and
        the masks that the settings ask for, beside it.
    settings
        Cells and masks of the grid and the like; left out, those of a report's configuration, else the defaults.
    scenario
        What the car of a scenario drives, in place of what the settings say.
    progress
        Told of each file, and how far the garage of a report is.
    workers
        How many files are written at a time, each by a copy of this process; one after the other where it has more than
        one thread, as USD and NumPy start them, and where the system is not Linux. The files are the same.
    notice
        Told of what a format cannot say, a line for each reason: the file's name, the reason, how often it came up, and
        the first few places.

    Returns
    -------
    tuple of Path
        All files that were written, in the order of `outputs`, the map of a scenario after it if it is not asked for as
        well. They appear whole or not at all.

    Raises
    ------
    ConfigError
        If an output ends in something else, is asked for twice, is brought by another, or would be too large; if a
        scenario's stall, entrance or exit is none of the garage's, or no drive is found for it.
    StageError, ReportError
        If the source cannot be read, or lacks what a format needs.
    OutputError
        If the files cannot be written.
    MissingExtraError
        If a Lanelet2 map or a scenario is asked for, and the extra ``maps`` is not installed.
    """
    source, places = Path(source), check_exports(outputs)
    if scenario is not None and not any(place.suffix == _SCENARIO for place in places):
        raise ConfigError("output", ", ".join(map(str, places)), f"a path that ends in {_SCENARIO}, for a scenario")
    with staging_folder() as staging:
        stage = source
        if source.suffix.lower() == _REPORT:
            config = read_report(source).garage_config()
            settings = settings or config.maps
            stage = build(config, staging / "source" / f"{source.stem}.usdc", progress=progress).stage
        elif source.suffix.lower() not in STAGE_SUFFIXES:
            raise ConfigError("PATH", str(source), f"a path that ends in {', '.join((*STAGE_SUFFIXES, _REPORT))}")
        settings = settings or MapsConfig()
        if scenario is not None:
            settings = settings.model_copy(update={"scenario": scenario})
        in_order = [staging / str(number) / place.name for number, place in enumerate(places)]
        drafts = sorted(in_order, key=lambda draft: [*_WRITERS].index(draft.suffix))
        files_of: dict[Path, list[Path]] = {}
        with without_collector():
            opened = _Source(stage)
            opened.read_for(places)
            written = each_in_a_copy([partial(_write, opened, draft, settings) for draft in drafts], workers)
            progress("export", 0, len(places))
            for number, (draft, (files, lines)) in enumerate(zip(drafts, written, strict=True)):
                files_of[draft] = files
                for line in lines:
                    notice(f"{draft.name}: {line}")
                progress("export", number + 1, len(places))
        made = [(place.parent, files_of[draft]) for place, draft in zip(places, in_order, strict=True)]
        _refuse_twice([folder / file.name for folder, files in made for file in files])
        return tuple(place for folder, files in made for place in publish(files, folder))


def _refuse_twice(files: Sequence[Path]) -> None:
    """Refuse outputs of which one is what another one brings, as a grid brings its masks."""
    for number, file in enumerate(files):
        if file in files[:number]:
            raise ConfigError("output", str(file), "paths of which none is a file that another one brings with it")


def check_exports(outputs: Sequence[str | Path]) -> tuple[Path, ...]:
    """The paths of exports and of the maps that scenarios name, which can be written; raises as `export`."""
    places = tuple(map(Path, outputs))
    if not places:
        raise ConfigError("output", "", f"one or more paths that end in {', '.join(EXPORT_SUFFIXES)}")
    for number, place in enumerate(places):
        if place.suffix not in _WRITERS or not place.stem:
            raise ConfigError("output", str(place), f"a path that ends in {', '.join(EXPORT_SUFFIXES)}")
        if place in places[:number]:
            raise ConfigError("output", str(place), "each file once")
        check_name(place)
        check_writable(place.parent)
    check_formats(place.suffix for place in places)
    return tuple(_with_maps(places))


def check_formats(suffixes: Iterable[str]) -> None:
    """Find out whether what writes files that end so is installed, each format by itself.

    Raises
    ------
    MissingExtraError
        If not.
    """
    wanted = {*suffixes}
    asked = [needed for suffix, needed in _OF_EXTRA.items() if suffix in wanted]
    require(" and ".join(purpose for purpose, _ in asked), [module for _, module in asked])


def _with_maps(places: Sequence[Path]) -> Iterator[Path]:
    for place in places:
        yield place
        if place.suffix == _SCENARIO and (beside := place.with_suffix(_MAP)) not in places:
            check_name(beside)
            yield beside
