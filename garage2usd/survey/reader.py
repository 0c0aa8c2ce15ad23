"""Reading of surveys: one format for each suffix of a file."""

from collections.abc import Callable
from pathlib import Path

from garage2usd.common.errors import ConfigError
from garage2usd.common.package import require
from garage2usd.survey.csv_survey import read_csv_survey
from garage2usd.survey.geojson_survey import read_geojson_survey
from garage2usd.survey.opendrive_survey import read_opendrive_survey
from garage2usd.survey.osm_survey import read_osm_survey
from garage2usd.survey.survey import Survey
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


def _read_imdf(path: Path) -> SurveyedBuilding:
    require("a survey as IMDF", ["pyproj"])
    from garage2usd.survey.imdf_survey import read_imdf_survey  # noqa: PLC0415

    return read_imdf_survey(path)


_READERS: dict[str, Callable[[Path], Survey | SurveyedBuilding]] = {
    ".toml": read_toml_survey,
    ".csv": read_csv_survey,
    ".geojson": read_geojson_survey,
    ".json": read_geojson_survey,
    ".osm": read_osm_survey,
    ".osm.xml": read_osm_survey,
    ".xodr": read_opendrive_survey,
    ".dxf": _read_dxf,
    ".ifc": _read_ifc,
    ".zip": _read_imdf,
}
SURVEY_SUFFIXES = tuple(_READERS)
"""Suffixes of files that `read_survey` reads."""
_REASONS = 3


def read_survey(path: Path) -> Survey:
    """Read the level with the most stalls of an existing garage; parameters and errors are those of `read_building`."""
    levels = read_building(path).in_order
    return max(levels, key=lambda level: len(level.survey.stalls)).survey


def read_building(path: Path) -> SurveyedBuilding:
    """Read the layout of an existing garage, level by level.

    Parameters
    ----------
    path
        A drawing in metres (``.toml``), rectangles (``.csv``), GeoJSON (``.geojson``, ``.json``), OpenStreetMap
        (``.osm``, ``.osm.xml``) or Lanelet2 (``.osm``), OpenDRIVE (``.xodr``), a CAD drawing (``.dxf``), a building
        model (``.ifc``), or IMDF (``.zip``, or its folder).

    Raises
    ------
    ConfigError
        For other suffixes, files that cannot be read or are malformed, and files without a stall.
    MissingExtraError
        For coordinates in degrees, without the extra ``maps``; for DXF and IFC, without the extra ``cad``.
    """
    compound = "".join(path.suffixes[-2:]).lower()
    read = _read_imdf if path.is_dir() else _READERS.get(path.suffix.lower()) or _READERS.get(compound)
    if read is None:
        raise ConfigError("SOURCE", str(path), f"a path that ends in {', '.join(SURVEY_SUFFIXES)}")
    building = SurveyedBuilding.of(read(path))
    if not any(level.survey.stalls for level in building.levels):
        unread = [part for level in building.levels for part in level.survey.unread]
        reasons = "; ".join(f"{name}: {reason}" for name, reason in unread[:_REASONS])
        raise ConfigError(
            "SOURCE", str(path), "a file with a stall of four corners" + (f" ({reasons})" if reasons else "")
        )
    return building
