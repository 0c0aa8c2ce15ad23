"""A stage, or the garage that a report tells of, in the formats of programs that read no USD."""

from collections.abc import Callable, Sequence
from pathlib import Path

from garage2usd.checks.stage_reader import subject_of_stage
from garage2usd.config.maps import MapsConfig
from garage2usd.errors import ConfigError
from garage2usd.maps.glb import write_glb
from garage2usd.maps.occupancy import write_grid
from garage2usd.output import check_name, check_writable, publish, staging_folder
from garage2usd.pipeline import build
from garage2usd.progress import Progress, silent
from garage2usd.reading.files import STAGE_SUFFIXES, open_stage
from garage2usd.reading.report import read_report

__all__ = ["EXPORT_SUFFIXES", "check_exports", "export"]

_REPORT = ".json"
_Write = Callable[["_Source", Path, MapsConfig], Sequence[Path]]


class _Source:
    """A stage that is open, and what is read in it once for several formats."""

    def __init__(self, path: Path) -> None:
        self.path, self.stage = path, open_stage(path)


def _glb(source: _Source, path: Path, _settings: MapsConfig) -> Sequence[Path]:
    write_glb(source.stage, path)
    return (path,)


def _grid(source: _Source, path: Path, settings: MapsConfig) -> Sequence[Path]:
    return write_grid(subject_of_stage(source.stage, source=str(source.path)), path, settings.grid)


_WRITERS: dict[str, _Write] = {".glb": _glb, ".yaml": _grid}

EXPORT_SUFFIXES = tuple(_WRITERS)
"""What the files that `export` makes end in: GLB scenes, and the YAML files of occupancy grids."""


def export(
    source: str | Path,
    outputs: Sequence[str | Path],
    *,
    settings: MapsConfig | None = None,
    progress: Progress = silent,
) -> tuple[Path, ...]:
    """Write a garage in other formats.

    Parameters
    ----------
    source
        A stage, also one that other tools have edited, which is exported as it stands; or the report of a build
        (``.json``), whose garage is made again.
    outputs
        The files, one or more. What they end in says what they are: ``.glb`` a scene as binary glTF 2.0, ``.yaml`` an
        occupancy grid for robots with its picture (``.pgm``) beside it.
    settings
        Cells of the grid and the like; left out, those of a report's configuration, else the defaults.
    progress
        Told of each file, and how far the garage of a report is.

    Returns
    -------
    tuple of Path
        All files that were written, in the order of `outputs`. They appear whole or not at all.

    Raises
    ------
    ConfigError
        If an output ends in something else, is asked for twice, or would be too large.
    StageError, ReportError
        If the source cannot be read, or lacks what a format needs.
    OutputError
        If the files cannot be written.
    """
    source, places = Path(source), check_exports(outputs)
    with staging_folder() as staging:
        stage = source
        if source.suffix.lower() == _REPORT:
            config = read_report(source).garage_config()
            settings = settings or config.maps
            stage = build(config, staging / "source" / f"{source.stem}.usdc", progress=progress).stage
        elif source.suffix.lower() not in STAGE_SUFFIXES:
            raise ConfigError("PATH", str(source), f"a path that ends in {', '.join((*STAGE_SUFFIXES, _REPORT))}")
        opened = _Source(stage)
        made: list[tuple[Path, list[Path]]] = []
        for number, place in enumerate(places):
            progress("export", number, len(places))
            folder = staging / str(number)
            folder.mkdir()
            files = _WRITERS[place.suffix](opened, folder / place.name, settings or MapsConfig())
            made.append((place.parent, list(files)))
        progress("export", len(places), len(places))
        return tuple(place for folder, files in made for place in publish(files, folder))


def check_exports(outputs: Sequence[str | Path]) -> tuple[Path, ...]:
    """The paths of exports, which can be written; raises as `export`."""
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
    return places
