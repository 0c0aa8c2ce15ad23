"""Reading of surveys: one format for each suffix of a file."""

from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

from garage2usd.common.errors import ConfigError
from garage2usd.common.package import require
from garage2usd.survey.csv_survey import read_csv_survey
from garage2usd.survey.geojson_survey import read_geojson_survey
from garage2usd.survey.opendrive_survey import read_opendrive_survey
from garage2usd.survey.osm_survey import read_osm_survey
from garage2usd.survey.survey import Survey, Unplaced
from garage2usd.survey.surveyed_building import SurveyedBuilding
from garage2usd.survey.toml_survey import read_toml_survey


def _read_dxf(path: Path) -> Survey | SurveyedBuilding:
    require("a survey as DXF", ["ezdxf"])
    from garage2usd.survey.dxf_survey import read_dxf_survey  # noqa: PLC0415 - other files do without its extra

    return read_dxf_survey(path)


def _read_ifc(path: Path) -> Survey | SurveyedBuilding:
    require("a survey as IFC", ["ifcopenshell"])
    from garage2usd.survey.ifc_survey import read_ifc_survey  # noqa: PLC0415

    return read_ifc_survey(path)


_READERS: dict[str, Callable[[Path], Survey | SurveyedBuilding]] = {
    ".toml": read_toml_survey,
    ".csv": read_csv_survey,
    ".geojson": read_geojson_survey,
    ".json": read_geojson_survey,
    ".osm": read_osm_survey,
    ".xodr": read_opendrive_survey,
    ".dxf": _read_dxf,
    ".ifc": _read_ifc,
}
SURVEY_SUFFIXES = tuple(_READERS)
"""Suffixes of files that `read_survey` reads."""
_REASONS = 3


def read_survey(path: Path) -> Survey:
    """Read the layout of an existing garage.

    Parameters
    ----------
    path
        A drawing in metres (``.toml``), rectangles (``.csv``), GeoJSON (``.geojson``, ``.json``), OpenStreetMap or
        Lanelet2 (``.osm``), or OpenDRIVE (``.xodr``).

    Raises
    ------
    ConfigError
        For other suffixes, files that cannot be read or are malformed, and files without a stall.
    MissingExtraError
        For coordinates in degrees, without the extra ``maps``.
    """
    read = _READERS.get(path.suffix.lower())
    if read is None:
        raise ConfigError("SOURCE", str(path), f"a path that ends in {', '.join(SURVEY_SUFFIXES)}")
    survey = _largest(read(path))
    if not survey.stalls:
        reasons = "; ".join(f"{name}: {reason}" for name, reason in survey.unread[:_REASONS])
        raise ConfigError(
            "SOURCE", str(path), "a file with a stall of four corners" + (f" ({reasons})" if reasons else "")
        )
    return survey


def _largest(source: Survey | SurveyedBuilding) -> Survey:
    """Return the level with the most stalls, and name the others."""
    if isinstance(source, Survey):
        return source
    level = max(source.in_order, key=lambda level: len(level.survey.stalls))
    others = tuple(
        Unplaced(f"level {other.name}", f"{len(other.survey.stalls)} stalls on another level than {level.name}")
        for other in source.in_order
        if other is not level
    )
    return replace(level.survey, unread=(*level.survey.unread, *source.unread, *others))
