"""Export of a stage or a report to maps, scenarios, occupancy grids, glTF and packages of simulators."""

# Over 300 lines: a few lines for each format, and the common validation, writing and publication of outputs.

from collections.abc import Callable, Iterable, Iterator, Sequence
from functools import cached_property, partial
from pathlib import Path
from typing import NamedTuple

from garage2usd.as_built.garage import BuiltGarage, garage_of_stage
from garage2usd.common.errors import ConfigError, MissingExtraError
from garage2usd.common.output import check_file, check_name, check_writable, drafting, publish_at, staging_folder
from garage2usd.common.package import RAYS, require
from garage2usd.common.processes import run_in_forks, without_collector
from garage2usd.common.progress import Progress, counted, silent, unheard
from garage2usd.config.outputs import MapsConfig, ScenarioConfig
from garage2usd.garage.levels import ONLY_LEVEL, LevelPlace
from garage2usd.garage_sources import settings_and_tape
from garage2usd.maps.drives import DrivePlanner
from garage2usd.maps.facts import stage_facts
from garage2usd.maps.glb import write_glb
from garage2usd.maps.ground_plan import GroundPlan, ground_plan
from garage2usd.maps.level_networks import LevelNetwork, level_networks
from garage2usd.maps.occupancy import grid_files, write_grid
from garage2usd.maps.opendrive import write_opendrive
from garage2usd.maps.parked_cars import parked_cars
from garage2usd.maps.sdf_files import check_meshes, sdf_files
from garage2usd.maps.sumo import NETWORK_SUFFIX, write_parking_areas
from garage2usd.pipeline import build
from garage2usd.reading.files import STAGE_SUFFIXES
from garage2usd.reading.levels import levels_of
from garage2usd.reading.report import read_report
from garage2usd.reading.whole_garage import open_garage
from garage2usd.render.blender_process import INSTALLED, find_blender, run_blender
from garage2usd.scenes.prims import PlacedObject
from garage2usd.scenes.remarks import Remarks
from garage2usd.scenes.values import metres_y_up
from garage2usd.scenes.walk import placed_objects

_REPORT, _SCENE, _LANELET2, _MAP, _SCENARIO, _GRID = ".json", ".glb", ".osm", ".xodr", ".xosc", ".yaml"
_GEOJSON, _DRAWING, _WORLD, _AUTOWARE = ".geojson", ".dxf", ".sdf", ".autoware"
_FOLDERS = frozenset({_AUTOWARE})
"""Formats that are folders; other files in such a folder stay."""
_AREAS, _OPENSTREETMAP, _CARLA = _COMPOUND = ".add.xml", ".osm.xml", ".carla.zip"
_OF_EXTRA = {
    _AUTOWARE: ("a folder for Autoware", "pyproj", *RAYS),
    _LANELET2: ("a Lanelet2 map", "pyproj"),
    _SCENARIO: ("a scenario", "scenariogeneration"),
    _GEOJSON: ("GeoJSON", "pyproj"),
    _OPENSTREETMAP: ("an OpenStreetMap file", "pyproj"),
    _DRAWING: ("a drawing in DXF", "ezdxf"),
    _CARLA: ("a map for CARLA", "bpy"),
}
"""Formats that need modules of extras, with their description and those modules, by extension."""
_MAP_OF = {_SCENARIO: _MAP, _AREAS: _MAP, _WORLD: _GRID}
"""Extensions of the maps that files of other formats name and bring with them."""
Notice = Callable[[str], None]
"""Callback for a line on data that a format cannot represent."""


class _Source:
    """An open stage; its garage, objects and road network are read once for all formats."""

    def __init__(self, stage: Path, name: str) -> None:
        self.name, self.stage = name, open_garage(stage)

    def read_for(self, formats: Sequence[str]) -> None:
        """Read the data that several files need, so that forks of this process share it."""
        of_lanes = [suffix for suffix in formats if suffix != _SCENE]
        if {_SCENE, _WORLD} & {*formats} and of_lanes:
            _ = self.objects
        if len(of_lanes) > 1:
            for level in self.garage.levels:
                _ = level.taken_stalls
        if len({_LANELET2, _MAP, _AREAS, _CARLA} & {*of_lanes}) > 1:
            _ = self.networks
        if len({_AUTOWARE, _LANELET2, _MAP, _AREAS, _DRAWING, _GEOJSON, _OPENSTREETMAP, _CARLA} & {*of_lanes}) > 1:
            for ground in self.plan.levels:
                _ = ground.lanes

    @cached_property
    def objects(self) -> list[PlacedObject]:
        """All visible objects of the stage, in metres, Y up."""
        return placed_objects(self.stage, metres_y_up(self.stage))

    @cached_property
    def garage(self) -> BuiltGarage:
        """The garage: levels with lanes, stalls and objects."""
        return garage_of_stage(self.stage, source=self.name, objects=lambda: self.objects, is_judged=False)

    @cached_property
    def networks(self) -> tuple[LevelNetwork, ...]:
        """The road networks of all levels."""
        return level_networks(self.garage)

    @cached_property
    def plan(self) -> GroundPlan:
        """The ground plan."""
        return ground_plan(self.garage)


class _Asked(NamedTuple):
    """A requested output file.

    Attributes
    ----------
    place
        Path of the file.
    settings
        Settings of the export.
    joint
        Separator between the stem and the names of a grid's masks.
    road_file
        Name of the map beside it to which a scenario and SUMO's parking areas refer.
    levels
        The levels, each of which has an occupancy grid of its own.
    """

    place: Path
    settings: MapsConfig
    joint: str
    road_file: str
    levels: tuple[LevelPlace, ...] = (ONLY_LEVEL,)

    @property
    def format(self) -> str:
        """The file extension in lower case."""
        return _format_of(self.place)

    def files(self, folder: Path) -> tuple[Path, ...]:
        """Paths in `folder` of the file and of files that are written with it, or of what is in the written folder."""
        path = folder / self.place.name
        if self.format in _FOLDERS:
            return tuple(sorted(path.iterdir()))
        if self.format == _AREAS:
            return path, path.with_name(f"{_stem_of(path)}{NETWORK_SUFFIX}")
        if self.format == _WORLD:
            return sdf_files(path, joint=self.joint)
        if self.format != _GRID:
            return (path,)
        grids = [grid_files(grid, self.settings.grid, joint=self.joint) for grid in self.grids(folder)]
        return tuple(file for files in grids for file in files)

    def grids(self, folder: Path) -> list[Path]:
        """Paths in `folder` of the occupancy grids, one for each level."""
        path = folder / self.place.name
        return [path.with_stem(level.after(path.stem, joint=self.joint)) for level in self.levels]


_Write = Callable[["_Source", Path, _Asked, Remarks], object]


def _glb(source: _Source, path: Path, _asked: _Asked, remarks: Remarks) -> None:
    write_glb(source.stage, path, objects=source.objects, remarks=remarks)


def _world(source: _Source, path: Path, asked: _Asked, remarks: Remarks) -> None:
    from garage2usd.maps.sdf import write_sdf  # noqa: PLC0415 - slow to import, and other formats do without it

    maps = [grid.name for grid in asked._replace(place=asked.place.with_name(asked.road_file)).grids(path.parent)]
    write_sdf(source.garage, path, objects=source.objects, maps=maps, remarks=remarks, joint=asked.joint)


def _opendrive(source: _Source, path: Path, asked: _Asked, _remarks: Remarks) -> None:
    write_opendrive(source.garage, path, asked.settings, networks=source.networks, plan=source.plan)


def _grid(source: _Source, path: Path, asked: _Asked, _remarks: Remarks) -> None:
    for level, file in zip(source.garage.levels, asked.grids(path.parent), strict=True):
        write_grid(level, file, asked.settings.grid, joint=asked.joint)


def _lanelet2(source: _Source, path: Path, asked: _Asked, _remarks: Remarks) -> None:
    from garage2usd.maps.lanelet2 import write_lanelet2  # noqa: PLC0415 - other formats do without its extra

    write_lanelet2(source.garage, path, asked.settings, networks=source.networks, plan=source.plan)


def _autoware(source: _Source, path: Path, asked: _Asked, _remarks: Remarks) -> None:
    from garage2usd.maps.autoware import write_autoware  # noqa: PLC0415 - other formats do without its extras

    write_autoware(source.garage, path, asked.settings, plans=source.plan.levels)


def _geojson(source: _Source, path: Path, asked: _Asked, _remarks: Remarks) -> None:
    from garage2usd.maps.geojson import write_geojson  # noqa: PLC0415 - other formats do without its extra

    write_geojson(source.garage, path, asked.settings, plan=source.plan)


def _openstreetmap(source: _Source, path: Path, asked: _Asked, _remarks: Remarks) -> None:
    from garage2usd.maps.openstreetmap import write_openstreetmap  # noqa: PLC0415 - other formats do without its extra

    write_openstreetmap(source.garage, path, asked.settings, plan=source.plan)


def _drawing(source: _Source, path: Path, _asked: _Asked, _remarks: Remarks) -> None:
    from garage2usd.maps.dxf import write_dxf  # noqa: PLC0415 - other formats do without its extra

    write_dxf(source.garage, path, plan=source.plan)


def _scenario(source: _Source, path: Path, asked: _Asked, _remarks: Remarks) -> None:
    from garage2usd.maps.openscenario import write_scenario  # noqa: PLC0415 - other formats do without its extra

    driven, garage = asked.settings.scenario, source.garage
    drive = DrivePlanner(garage, asked.settings.drive).drive(
        driven.stall, entrance=driven.entrance, exit=driven.exit, leg=driven.leg
    )
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


def _parking_areas(source: _Source, path: Path, asked: _Asked, remarks: Remarks) -> None:
    _, network_file = asked.files(path.parent)
    write_parking_areas(
        source.networks,
        path,
        asked.settings.sumo,
        network_file=network_file,
        road_file=asked.road_file,
        remarks=remarks,
    )


def _carla(source: _Source, path: Path, asked: _Asked, remarks: Remarks) -> None:
    from garage2usd.maps.carla import FBX_PROGRAM, write_carla  # noqa: PLC0415 - for this format only

    write_carla(
        source.stage,
        path,
        source.garage,
        asked.settings,
        name=_stem_of(path),
        run_blender=lambda job, folder: run_blender(job, folder, lambda _: None, find_blender(), script=FBX_PROGRAM),
        objects=source.objects,
        networks=source.networks,
        plan=source.plan,
        remarks=remarks,
    )


_WRITERS: dict[str, _Write] = {
    _WORLD: _world,
    _CARLA: _carla,
    _AUTOWARE: _autoware,
    _SCENE: _glb,
    _SCENARIO: _scenario,
    _LANELET2: _lanelet2,
    _GRID: _grid,
    _MAP: _opendrive,
    _AREAS: _parking_areas,
    _DRAWING: _drawing,
    _GEOJSON: _geojson,
    _OPENSTREETMAP: _openstreetmap,
}
"""Writers by extension, the slowest first, so that parallel tasks finish together."""
_ON_THE_RIGHT = {_LANELET2, _MAP, _AREAS, _CARLA}
"""Formats whose lanes keep to the right in any garage, since netconvert does not read the rule of OpenDRIVE's roads."""


def _write(source: _Source, folder: Path, asked: _Asked) -> tuple[tuple[Path, ...], list[str]]:
    """Write a requested file, and the files that accompany it, into a new folder.

    Returns
    -------
    tuple
        The files, and lines on data that the format cannot represent.
    """
    remarks = Remarks()
    if asked.format in _ON_THE_RIGHT and any(level.keeps_left for level in source.garage.levels):
        remarks.add("lanes keep to the right, while cars in this garage keep to the left", source.name)
    with drafting(asked.place):
        folder.mkdir()
        _WRITERS[asked.format](source, folder / asked.place.name, asked, remarks)
    return asked.files(folder), remarks.lines()


EXPORT_SUFFIXES = tuple(sorted(_WRITERS))
"""Extensions of what `export` writes: folders for Autoware, SUMO's parking areas, packages for CARLA, DXF drawings,
GeoJSON, GLB scenes, Lanelet2 maps, OpenStreetMap's XML, SDF worlds, OpenDRIVE maps, OpenSCENARIO scenarios, grids."""


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
    """Export a garage to other formats.

    Parameters
    ----------
    source
        A stage, whose current content is exported even if other tools have edited it; or the report of a build
        (``.json``), whose garage is rebuilt.
    outputs
        One or more files, whose extensions select the formats: ``.autoware`` a folder of maps for Autoware, ``.glb`` a
        scene as binary glTF 2.0, ``.osm`` a Lanelet2 map, ``.osm.xml`` OpenStreetMap's XML, ``.geojson`` GeoJSON,
        ``.dxf`` a drawing, ``.sdf`` a world for Gazebo (SDF 1.9) with its meshes, launch file and occupancy grid beside
        it, ``.xodr`` an OpenDRIVE 1.8 map, ``.xosc`` an OpenSCENARIO 1.2 scenario with a ``.xodr`` map of the same stem
        beside it, ``.yaml`` an occupancy grid for robots with its image (``.pgm``) and, depending on the settings,
        masks, for each level of a garage of several levels (``a_U1.yaml``), ``.add.xml`` the stalls as parking areas of
        SUMO, with the map that their network is made of and netconvert's configuration for it (``.netccfg``) beside it,
        ``.carla.zip`` an archive for CARLA's importer (`garage2usd.maps.carla`).
    settings
        Settings of maps, grids and drives; if left out, those of the report, else the defaults.
    scenario
        Drive of the scenario's car, which overrides the settings.
    progress
        Called after each file, and during the rebuild of a report's garage.
    workers
        Number of files written in parallel, each by a fork of this process; sequential if this process has several
        threads, as USD and NumPy start them, or outside Linux. The files do not depend on it.
    notice
        Called with a line for each kind of data that a format cannot represent: the file's name, the reason, the number
        of cases, and the first few places.
    joint
        Separator between the stem of a grid and the names of its level and masks: ``a_keepout.yaml``.

    Returns
    -------
    tuple of Path
        All files, in the order of `outputs`; the map of a scenario, of parking areas or of a world follows it if it is
        not an output itself. Either all files appear or none.

    Raises
    ------
    ConfigError
        If an output has an unknown extension, is listed twice, is already written with another output, or would be too
        large; if a scenario's stall, entrance or exit does not exist, or no drive is found for it.
    StageError, ReportError
        If the source cannot be read, or lacks data that a format needs.
    OutputError
        If the files cannot be written.
    MissingExtraError
        If a format is requested whose extra, ``maps``, ``sensors``, ``cad`` or ``blender``, is not installed.
    RenderError
        If Blender fails to write a mesh.
    """
    source, reported = Path(source), None
    if source.suffix.lower() == _REPORT:
        reported = settings_and_tape(read_report(source))
        settings = settings or reported[0].maps
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
        if reported is not None:
            place = staging / "source" / "garage.usdc"
            config, tape = reported
            stage = build(config, place, tape=tape, progress=progress).stage
        order = sorted(range(len(files)), key=lambda number: [*_WRITERS].index(files[number].format))
        drafts: dict[int, tuple[Path, ...]] = {}  # by index of the output
        with without_collector():
            progress("reading", 0, 1)
            opened = _Source(stage, str(source))
            opened.read_for([asked.format for asked in files])
            levels = tuple(levels_of(opened.stage))
            if levels != files[0].levels:
                files = [asked._replace(levels=levels) for asked in files]
                _check_files(files)
            tasks = [partial(_write, opened, staging / str(number), files[number]) for number in order]
            made = counted("export", run_in_forks(tasks, workers), len(files), progress)
            for number, (written, lines) in zip(order, made, strict=True):
                drafts[number] = written
                for line in lines:
                    notice(f"{files[number].place.name}: {line}")
        return publish_at(
            {
                draft: asked.place.parent / draft.relative_to(staging / str(number))
                for number, asked in enumerate(files)
                for draft in drafts[number]
            }
        )


def check_exports(
    outputs: Sequence[str | Path], *, settings: MapsConfig | None = None, joint: str = "_"
) -> tuple[Path, ...]:
    """Validate exports; return their paths and those of the maps that they name; raises as `export`."""
    asked = tuple(map(Path, outputs))
    if not asked:
        raise ConfigError("output", "", f"one or more paths that end in {', '.join(EXPORT_SUFFIXES)}")
    for number, place in enumerate(asked):
        if _format_of(place) not in _WRITERS or not _stem_of(place):
            raise ConfigError("output", str(place), f"a path that ends in {', '.join(EXPORT_SUFFIXES)}")
        if place in asked[:number]:
            raise ConfigError("output", str(place), "each file once")
    places = tuple(_with_maps(asked))
    _check_files(_asked(places, settings or MapsConfig(), joint))
    check_formats(map(_format_of, places))
    return places


def _check_files(asked: Sequence[_Asked]) -> None:
    """Check that no two outputs write the same file, and that all can be written."""
    for each in asked:
        if each.format in _FOLDERS:
            check_name(each.place)
            if each.place.exists() and not each.place.is_dir():
                raise ConfigError("output", str(each.place), "a path at which no file stands, for a folder")
            check_writable(each.place)
    brought = [file for each in asked if each.format not in _FOLDERS for file in each.files(each.place.parent)]
    meshes = {each.files(each.place.parent)[-1] for each in asked if each.format == _WORLD}
    for number, file in enumerate(brought):
        if file in brought[:number]:
            raise ConfigError("output", str(file), "paths of which none is a file that another one brings with it")
        check_name(file)
        if file in meshes:
            check_meshes(file)
        else:
            check_file(file)


def check_formats(suffixes: Iterable[str]) -> None:
    """Check that the packages for the formats with these extensions are installed.

    Raises
    ------
    MissingExtraError
        If one is missing.
    """
    wanted = {*suffixes}
    if _CARLA in wanted and find_blender().program is not None:
        wanted.remove(_CARLA)
    asked = [needed for suffix, needed in _OF_EXTRA.items() if suffix in wanted]
    modules = dict.fromkeys(module for _, *needed in asked for module in needed)
    require(" and ".join(purpose for purpose, *_ in asked), modules, without=INSTALLED)


def without_lacking(outputs: Sequence[Path]) -> tuple[tuple[Path, ...], tuple[str, ...]]:
    """Split outputs into those whose extra is installed or not needed, and a line on each of the others.

    Raises
    ------
    MissingExtraError
        If no output is left.
    """
    lacking: dict[Path, str] = {}
    for output in outputs:
        try:
            check_formats([_format_of(output)])
        except MissingExtraError as error:
            lacking[output] = f"{output} is not written: {error}"
    written = tuple(output for output in outputs if output not in lacking)
    if not written:
        check_formats(map(_format_of, outputs))
    return written, tuple(lacking.values())


def _asked(places: Sequence[Path], settings: MapsConfig, joint: str) -> list[_Asked]:
    return [_Asked(place, settings, joint, (_map_beside(place, places) or place).name) for place in places]


def _with_maps(places: Sequence[Path]) -> Iterator[Path]:
    brought: list[Path] = []
    for place in places:
        yield place
        kind = _MAP_OF.get(_format_of(place))
        if kind is not None and _map_beside(place, [*places, *brought]) is None:
            brought.append(place.with_name(f"{_stem_of(place)}{kind}"))
            yield brought[-1]


def _map_beside(place: Path, places: Sequence[Path]) -> Path | None:
    """Return the path of the map that a file names, with the same stem in the same folder."""
    wanted = _MAP_OF.get(_format_of(place)), place.parent, _stem_of(place)
    return next((map_ for map_ in places if (_format_of(map_), map_.parent, map_.stem) == wanted), None)


def _format_of(path: Path) -> str:
    name = path.name.lower()
    return next((suffix for suffix in _COMPOUND if name.endswith(suffix)), path.suffix.lower())


def _stem_of(path: Path) -> str:
    """Return a file's name without the ending of its format; empty if there is no more to it."""
    return path.name[: -len(_format_of(path))] if _format_of(path) in _COMPOUND else path.stem
