"""The forms of tracks: one function that writes them as the extension of a file asks."""

from collections.abc import Callable, Mapping
from pathlib import Path
from typing import NamedTuple

from garage2usd.as_built.garage import BuiltGarage
from garage2usd.common.errors import ConfigError
from garage2usd.common.output import check_file, check_name, publish_at, staging_folder
from garage2usd.common.package import require
from garage2usd.config.outputs import MapsConfig
from garage2usd.config.vehicles import CarBody
from garage2usd.driving.tracks import Tracks


class _Asked(NamedTuple):
    """Tracks to write, with their garage, settings of maps, and cars besides those of the catalogue."""

    tracks: Tracks
    garage: BuiltGarage
    settings: MapsConfig
    cars: Mapping[str, CarBody]


_Write = Callable[[Path, _Asked], tuple[Path, ...]]


def _parquet(path: Path, asked: _Asked) -> tuple[Path, ...]:
    from garage2usd.maps.track_tables import write_track_parquet  # noqa: PLC0415 - other forms do without its extra

    write_track_parquet(path, asked.tracks)
    return ()


def _csv(path: Path, asked: _Asked) -> tuple[Path, ...]:
    from garage2usd.maps.track_tables import write_track_csv  # noqa: PLC0415 - other forms do without its extra

    return write_track_csv(path, asked.tracks)[1:]


def _layer(path: Path, asked: _Asked) -> tuple[Path, ...]:
    from garage2usd.stage.traffic import write_traffic_layer  # noqa: PLC0415 - its meshes are read on import

    return write_traffic_layer(path, asked.tracks, asked.cars)


def _scenario(path: Path, asked: _Asked) -> tuple[Path, ...]:
    from garage2usd.maps.opendrive import write_opendrive  # noqa: PLC0415 - for scenarios only
    from garage2usd.maps.openscenario import write_traffic_scenario  # noqa: PLC0415 - other forms do without its extra
    from garage2usd.maps.parked_cars import parked_cars  # noqa: PLC0415 - for scenarios only

    road = path.with_suffix(".xodr")
    write_opendrive(asked.garage, road, asked.settings)
    prims = {track.agent.prim for track in asked.tracks} - {""}
    parked = parked_cars(asked.garage, left_out=prims)
    write_traffic_scenario(path, asked.tracks, road_file=road.name, parked=parked)
    return (road,)


def _floating_car_data(path: Path, asked: _Asked) -> tuple[Path, ...]:
    from garage2usd.maps import floating_car_data as data  # noqa: PLC0415 - for this form only

    data.write_floating_car_data(path, asked.tracks)
    types = _beside(path, ".fcd.xml")
    data.write_vehicle_types(types, asked.tracks)
    return (types,)


def _osi(path: Path, asked: _Asked) -> tuple[Path, ...]:
    from garage2usd.maps.osi_trace import write_osi_trace  # noqa: PLC0415 - other forms do without its extra

    write_osi_trace(path, asked.tracks)
    return ()


def _scenario_net(path: Path, asked: _Asked) -> tuple[Path, ...]:
    from garage2usd.maps.scenario_net import write_scenario_net  # noqa: PLC0415 - for this form only

    write_scenario_net(path, asked.tracks, asked.garage)
    return ()


_LAYERS = (".usda", ".usdc")
_WRITERS: dict[str, _Write] = {
    ".parquet": _parquet,
    ".csv": _csv,
    **dict.fromkeys(_LAYERS, _layer),
    ".xosc": _scenario,
    ".fcd.xml": _floating_car_data,
    ".mcap": _osi,
    ".pkl": _scenario_net,
}
_OF_EXTRA = {".parquet": "pyarrow", ".csv": "pyarrow", ".xosc": "scenariogeneration", ".mcap": "osi3"}
_BESIDE = {".csv": ".json", ".xosc": ".xodr", ".fcd.xml": ".types.xml"}
"""Extensions of files that are written beside those of a form."""
TRACK_SUFFIXES = tuple(_WRITERS)
"""Extensions of the files that `write_tracks` writes: Parquet and CSV tables, USD layers, OpenSCENARIO scenarios,
SUMO's floating car data, OSI traces and ScenarioNet's dictionaries."""


def check_tracks_file(path: str | Path) -> str:
    """Check before the work that tracks can be written to a file; return its extension in lower case.

    Raises
    ------
    ConfigError
        If the extension is none of `TRACK_SUFFIXES`, or the name cannot be written.
    OutputError
        If the folder is not writable.
    MissingExtraError
        If the form needs an extra that is not installed.
    """
    place = Path(path)
    suffix = next((suffix for suffix in TRACK_SUFFIXES if place.name.lower().endswith(suffix)), "")
    if not suffix or len(place.name) == len(suffix):
        raise ConfigError("output", str(path), f"a path that ends in {', '.join(TRACK_SUFFIXES)}")
    check_name(place, of_layer=suffix in _LAYERS)
    check_file(place, with_it=[_beside(place, suffix)] if suffix in _BESIDE else [])
    require_form(suffix)
    return suffix


def require_form(suffix: str) -> None:
    """Check that the packages for the form of an extension are installed; raise MissingExtraError if not."""
    if suffix in _OF_EXTRA:
        require(f"tracks as {suffix}", [_OF_EXTRA[suffix]], extra="traffic")


def write_tracks(
    path: str | Path,
    tracks: Tracks,
    garage: BuiltGarage,
    *,
    settings: MapsConfig | None = None,
    cars: Mapping[str, CarBody] | None = None,
) -> tuple[Path, ...]:
    """Write tracks in the form that the extension of a file asks for.

    Parameters
    ----------
    path
        The file: ``.parquet`` or ``.csv`` a table with a row for each sample (a CSV has a ``.json`` of the same stem
        beside it), ``.usda`` or ``.usdc`` a layer to put over the stage, ``.xosc`` an OpenSCENARIO 1.3 scenario with a
        ``.xodr`` map of the same stem beside it, ``.fcd.xml`` SUMO's floating car data with the types of agents in an
        ``.types.xml`` beside it, ``.mcap`` ground truth of ASAM OSI, ``.pkl`` ScenarioNet's dictionary.
    tracks
        The tracks.
    garage
        The garage that they are in.
    settings
        Settings of a scenario's map; if left out, the defaults.
    cars
        Models of the user by the names of their bodies, for a layer.

    Returns
    -------
    tuple of Path
        The file, and the files beside it. Either all files appear or none.

    Raises
    ------
    ConfigError, OutputError, MissingExtraError
        As `check_tracks_file`; ConfigError also if a layer has no body or paint of a car's name.
    """
    place, suffix = Path(path), check_tracks_file(path)
    with staging_folder(place) as staging:
        draft = staging / f"{place.name[: -len(suffix)]}{suffix}"
        beside = _WRITERS[suffix](draft, _Asked(tracks, garage, settings or MapsConfig(), cars or {}))
        places = {file: place.parent / file.relative_to(staging) for file in beside}
        published = publish_at({**places, draft: place})
    return published[-1], *published[:-1]


def write_predictions(path: Path, tracks: Tracks, garage: BuiltGarage) -> int:
    """Write the prediction tasks of tracks to a Parquet table, or to a new folder of ScenarioNet; return their number.

    Raises
    ------
    ConfigError
        If the folder exists.
    OutputError
        If it cannot be written; it appears whole or not at all.
    MissingExtraError
        If a table needs an extra that is not installed.
    """
    from garage2usd.maps import prediction_tasks as forms  # noqa: PLC0415 - tracks do without it

    tasks = forms.prediction_tasks(tracks)
    is_table = path.suffix.lower() == ".parquet"
    if is_table:
        require("prediction tasks as a table", ["pyarrow"], extra="traffic")
        check_file(path)
    elif path.exists():
        raise ConfigError("predictions", str(path), "a table that ends in .parquet, or a new folder")
    with staging_folder(path) as staging:
        draft = staging / path.name
        if is_table:
            forms.write_prediction_table(draft, tasks)
        else:
            forms.write_prediction_scenarios(draft, tasks, garage)
        publish_at({draft: path})
    return len(tasks)


def _beside(place: Path, suffix: str) -> Path:
    return place.with_name(f"{place.name[: -len(suffix)]}{_BESIDE[suffix]}")
