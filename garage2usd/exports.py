"""Export of a stage or a report to maps, scenarios, occupancy grids and glTF."""

# Over 300 lines: every format is a few lines here, and what is asked for is checked, written and published as one.

from collections.abc import Callable, Iterable, Iterator, Sequence
from functools import cached_property, partial
from pathlib import Path
from typing import NamedTuple

from garage2usd.as_built import BuiltGarage
from garage2usd.as_built.levels import BuiltLevels, built_levels
from garage2usd.as_built.stage_reader import garage_of_stage
from garage2usd.common.errors import ConfigError
from garage2usd.common.extras import require
from garage2usd.common.output import check_file, check_name, drafting, publish_at, staging_folder
from garage2usd.common.processes import each_in_a_copy, without_collector
from garage2usd.common.progress import Progress, silent, unheard
from garage2usd.config.maps import MapsConfig, ScenarioConfig
from garage2usd.maps.drives import DrivePlanner
from garage2usd.maps.glb import write_glb
from garage2usd.maps.level_networks import LevelNetwork, level_networks
from garage2usd.maps.network import Network
from garage2usd.maps.occupancy import grid_files, write_grid
from garage2usd.maps.opendrive import write_opendrive, write_opendrive_levels
from garage2usd.maps.parked_cars import parked_cars
from garage2usd.maps.road_builder import network_of
from garage2usd.maps.stage_facts import stage_facts
from garage2usd.pipeline import build
from garage2usd.reading.files import STAGE_SUFFIXES, open_stage
from garage2usd.reading.levels import refuse_levels
from garage2usd.reading.objects import PlacedObject
from garage2usd.reading.remarks import Remarks
from garage2usd.reading.report import read_report
from garage2usd.reading.values import metres_y_up
from garage2usd.reading.walk import placed_objects

__all__ = ["EXPORT_SUFFIXES", "check_exports", "check_formats", "export"]

_REPORT, _SCENE, _LANELET2, _MAP, _SCENARIO, _GRID = ".json", ".glb", ".osm", ".xodr", ".xosc", ".yaml"
_OF_EXTRA = {_LANELET2: ("a Lanelet2 map", "pyproj"), _SCENARIO: ("a scenario", "scenariogeneration")}
"""What needs a module of an extra, and which, by what its files end in."""
_OF_LEVELS = frozenset({_LANELET2, _MAP})
"""Formats that a garage of several levels is written in."""
Notice = Callable[[str], None]
"""Takes a line on what a format cannot say."""


class _Source:
    """An open stage; its garage, objects and roads are read once for all formats."""

    def __init__(self, stage: Path, name: str) -> None:
        self.name, self.stage = name, open_stage(stage)

    def read_for(self, formats: Sequence[str]) -> None:
        """Read all that several files need, so that copies of this process share it."""
        if self.levels is not None:
            for suffix in formats:
                if suffix not in _OF_LEVELS:
                    refuse_levels(self.stage, self.name, f"export to {suffix}")
            return
        of_lanes = [suffix for suffix in formats if suffix != _SCENE]
        if len(formats) > 1:
            _ = self.objects
        if len(of_lanes) > 1:
            _ = self.garage.taken_stalls
        if {_LANELET2, _MAP} <= {*of_lanes}:
            _ = self.network

    @cached_property
    def levels(self) -> BuiltLevels | None:
        """The levels of a garage of several; None of a garage of one level."""
        return built_levels(self.stage, self.name)

    @cached_property
    def level_networks(self) -> tuple[LevelNetwork, ...]:
        """The road networks of all levels of a garage of several."""
        return () if self.levels is None else level_networks(self.levels)

    @cached_property
    def objects(self) -> list[PlacedObject]:
        """All drawn objects of the stage, in metres, Y up."""
        return placed_objects(self.stage, metres_y_up(self.stage))

    @cached_property
    def garage(self) -> BuiltGarage:
        """The garage: lanes, stalls and objects."""
        return garage_of_stage(self.stage, source=self.name, objects=self.objects, is_judged=False)

    @cached_property
    def network(self) -> Network:
        """The road network of the garage."""
        return network_of(self.garage)


class _Asked(NamedTuple):
    """A requested output file.

    Attributes
    ----------
    place
        Where it goes.
    settings
        How it is made.
    joint
        What stands between its stem and the names of the masks of a grid.
    road_file
        Name of the map that stands beside it, which a scenario refers to.
    """

    place: Path
    settings: MapsConfig
    joint: str
    road_file: str

    @property
    def format(self) -> str:
        """The file extension in lower case."""
        return _format_of(self.place)

    def files(self, folder: Path) -> tuple[Path, ...]:
        """The file, and what it brings, in a folder."""
        path = folder / self.place.name
        return grid_files(path, self.settings.grid, joint=self.joint) if self.format == _GRID else (path,)


_Write = Callable[["_Source", Path, _Asked, Remarks], object]


def _glb(source: _Source, path: Path, _asked: _Asked, remarks: Remarks) -> None:
    write_glb(source.stage, path, objects=source.objects, remarks=remarks)


def _opendrive(source: _Source, path: Path, asked: _Asked, _remarks: Remarks) -> None:
    if source.levels is not None:
        levels = [(level.garage, level.network) for level in source.level_networks]
        write_opendrive_levels(levels, path, asked.settings, stage=source.stage)
        return
    write_opendrive(source.garage, path, asked.settings, network=source.network)


def _grid(source: _Source, path: Path, asked: _Asked, _remarks: Remarks) -> None:
    write_grid(source.garage, path, asked.settings.grid, joint=asked.joint)


def _lanelet2(source: _Source, path: Path, asked: _Asked, _remarks: Remarks) -> None:
    from garage2usd.maps.lanelet2 import (  # noqa: PLC0415 - other formats do without its extra
        write_lanelet2,
        write_lanelet2_levels,
    )

    if source.levels is not None:
        write_lanelet2_levels(source.level_networks, path, asked.settings, stage=source.stage)
        return
    write_lanelet2(source.garage, path, asked.settings, network=source.network)


def _scenario(source: _Source, path: Path, asked: _Asked, _remarks: Remarks) -> None:
    from garage2usd.maps.openscenario import write_scenario  # noqa: PLC0415 - other formats do without its extra

    garage, driven = source.garage, asked.settings.scenario
    planner = DrivePlanner(garage, asked.settings.drive)
    drive = planner.drive(driven.stall, entrance=driven.entrance, exit=driven.exit, leg=driven.leg)
    seed = stage_facts(source.stage).get("seed")
    write_scenario(
        path,
        drive.trajectory,
        car=drive.car,
        settings=drive.settings,
        road_file=asked.road_file,
        parked=parked_cars(garage, free=[drive.route.stall]),
        name=f"{drive.route.stall} {drive.leg}",
        seed=None if seed is None else int(seed),
    )


_WRITERS: dict[str, _Write] = {
    _SCENE: _glb,
    _SCENARIO: _scenario,
    _LANELET2: _lanelet2,
    _GRID: _grid,
    _MAP: _opendrive,
}
"""The longest first: so files are begun, so that those that are written at a time end together."""


def _write(source: _Source, folder: Path, asked: _Asked) -> tuple[tuple[Path, ...], list[str]]:
    """Write a file that is asked for, with what it brings, into a folder that is made.

    Returns
    -------
    tuple
        The files, and what their format cannot say.
    """
    remarks = Remarks()
    with drafting(asked.place):
        folder.mkdir()
        _WRITERS[asked.format](source, folder / asked.place.name, asked, remarks)
    return asked.files(folder), remarks.lines()


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
    notice: Notice = unheard,
    joint: str = "_",
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
    joint
        What stands between the stem of a grid and the names of its masks: ``a_keepout.yaml``.

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
    source, config = Path(source), None
    if source.suffix.lower() == _REPORT:
        config = read_report(source).garage_config()
        settings = settings or config.maps
    elif source.suffix.lower() not in STAGE_SUFFIXES:
        raise ConfigError("PATH", str(source), f"a path that ends in {', '.join((*STAGE_SUFFIXES, _REPORT))}")
    settings = settings or MapsConfig()
    places = check_exports(outputs, settings=settings, joint=joint)
    if scenario is not None:
        if not any(_format_of(place) == _SCENARIO for place in places):
            raise ConfigError("output", ", ".join(map(str, places)), f"a path that ends in {_SCENARIO}, for a scenario")
        settings = settings.model_copy(update={"scenario": scenario})
    files = _asked(places, settings, joint)
    with staging_folder(places[0]) as staging:
        stage = source
        if config is not None:
            stage = build(config, staging / "source" / "garage.usdc", progress=progress).stage
        order = sorted(range(len(files)), key=lambda number: [*_WRITERS].index(files[number].format))
        drafts: dict[int, tuple[Path, ...]] = {}  # of each file that is asked for, by its number
        with without_collector():
            opened = _Source(stage, str(source))
            opened.read_for([asked.format for asked in files])
            tasks = [partial(_write, opened, staging / str(number), files[number]) for number in order]
            progress("export", 0, len(files))
            for number, (written, lines) in zip(order, each_in_a_copy(tasks, workers), strict=True):
                drafts[number] = written
                for line in lines:
                    notice(f"{files[number].place.name}: {line}")
                progress("export", len(drafts), len(files))
        parents = [asked.place.parent for asked in files]
        return publish_at(
            {draft: parent / draft.name for number, parent in enumerate(parents) for draft in drafts[number]}
        )


def check_exports(
    outputs: Sequence[str | Path], *, settings: MapsConfig | None = None, joint: str = "_"
) -> tuple[Path, ...]:
    """The paths of exports and of the maps that scenarios name, which can be written; raises as `export`."""
    asked = tuple(map(Path, outputs))
    if not asked:
        raise ConfigError("output", "", f"one or more paths that end in {', '.join(EXPORT_SUFFIXES)}")
    for number, place in enumerate(asked):
        if _format_of(place) not in _WRITERS or not place.stem:
            raise ConfigError("output", str(place), f"a path that ends in {', '.join(EXPORT_SUFFIXES)}")
        if place in asked[:number]:
            raise ConfigError("output", str(place), "each file once")
    places = tuple(_with_maps(asked))
    brought = [
        file for each in _asked(places, settings or MapsConfig(), joint) for file in each.files(each.place.parent)
    ]
    for number, file in enumerate(brought):
        if file in brought[:number]:
            raise ConfigError("output", str(file), "paths of which none is a file that another one brings with it")
        check_name(file)
        check_file(file)
    check_formats(map(_format_of, places))
    return places


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


def _asked(places: Sequence[Path], settings: MapsConfig, joint: str) -> list[_Asked]:
    return [_Asked(place, settings, joint, (_map_beside(place, places) or place).name) for place in places]


def _with_maps(places: Sequence[Path]) -> Iterator[Path]:
    for place in places:
        yield place
        if _format_of(place) == _SCENARIO and _map_beside(place, places) is None:
            yield place.with_suffix(_MAP)


def _map_beside(place: Path, places: Sequence[Path]) -> Path | None:
    """Return the path of the map with the same stem in the same folder."""
    return next((map_ for map_ in places if _format_of(map_) == _MAP and map_.with_suffix(place.suffix) == place), None)


def _format_of(path: Path) -> str:
    return path.suffix.lower()
