"""What a profile asks of the settings: sizes that a garage needs to pass its own check."""

import math
from collections.abc import Iterator, Mapping
from typing import Any

from garage2usd.config.fittings import CEILING_ROOM_M, FittingsConfig
from garage2usd.config.site import CARRIAGEWAY_MARGIN_M, DEFAULT_SIDE_M, BayConfig, SiteConfig
from garage2usd.profiles import Length, Profile
from garage2usd.profiles.clauses import Illuminance
from garage2usd.settings import Settings

__all__ = ["designed_settings"]

_Sections = Mapping[str, Mapping[str, Any]]
"""What the user gives, by section and key."""
_MODELS: dict[str, type[Settings]] = {"bay": BayConfig, "fittings": FittingsConfig, "site": SiteConfig}
_CARS_BETWEEN_COLUMNS = 3
_STEP_M = 0.01
_WIDEST_DOOR_M = 5.8
"""A vehicle door is made 6 m wide at most, and is clear between the posts of its frame."""
_LARGEST = 1e6
"""No setting of a size is larger; what is larger is refused where it is validated."""


def designed_settings(profile: Profile, settings: Mapping[str, Any]) -> dict[str, Any]:
    """The settings with what a profile asks for, section by section; whatever the user gives stays.

    Parameters
    ----------
    profile
        What the garage is designed to.
    settings
        The user's sections, as mappings or models; anything else is left to their validation.

    Notes
    -----
    A default stays where it satisfies the profile, so that a profile that asks for nothing else changes nothing.
    """
    result = dict(settings)
    for section, key, value in _design(profile, {name: _given(settings.get(name)) for name in _MODELS}):
        section_given = result.get(section)
        if section_given is None:
            result[section] = {key: value}
        elif key in _given(section_given):
            continue
        elif isinstance(section_given, Settings):
            result[section] = type(section_given)(**{**_given(section_given), key: value})
        elif isinstance(section_given, Mapping):
            result[section] = {**section_given, key: value}
    return result


def _given(section: object) -> Mapping[str, Any]:
    """What the user gives of a section, as a mapping or a model; nothing of what is neither."""
    if isinstance(section, Settings):
        return {name: getattr(section, name) for name in section.model_fields_set}
    return section if isinstance(section, Mapping) else {}


def _design(profile: Profile, given: _Sections) -> Iterator[tuple[str, str, Any]]:
    """Section, key and value of each setting whose default does not satisfy the profile."""
    width_m = _or_default(profile.stall_width, "bay", "stall_width_m")
    length_m = _or_default(profile.stall_length, "bay", "stall_length_m")
    column_m = _number(given, "bay", "column_size_m")
    aisle_m = _at_least(profile.aisle_width, "bay", "aisle_width_m")
    side_m = max(
        DEFAULT_SIDE_M,
        _rounded_up(column_m + _CARS_BETWEEN_COLUMNS * width_m),
        _rounded_up(aisle_m + column_m + 2 * CARRIAGEWAY_MARGIN_M),
    )
    clear_m = max(
        _at_least(profile.clear_height, "fittings", "clear_height_m"),
        _at_least(profile.van_clear_height, "fittings", "clear_height_m"),
    )
    chosen = {
        ("bay", "stall_width_m"): width_m,
        ("bay", "stall_length_m"): length_m,
        ("bay", "aisle_width_m"): aisle_m,
        ("bay", "wall_gap_m"): _wall_gap_m(profile, _number(given, "bay", "stall_width_m", width_m)),
        ("bay", "square_side_m"): side_m,
        ("bay", "portal_width_m"): min(_at_least(profile.portal_width, "bay", "portal_width_m"), _WIDEST_DOOR_M),
        ("fittings", "clear_height_m"): clear_m,
        ("fittings", "ceiling_height_m"): max(
            _default("fittings", "ceiling_height_m"),
            _rounded_up(clear_m + CEILING_ROOM_M),
        ),
        ("fittings", "lane_lux"): _lux(profile.lane_illuminance, "lane_lux"),
        ("fittings", "stall_lux"): _lux(profile.stall_illuminance, "stall_lux"),
        ("fittings", "ramp_slope_percent"): min(
            _default("fittings", "ramp_slope_percent"),
            profile.ramp_slope.amount if profile.ramp_slope else math.inf,
        ),
        ("fittings", "ramp_transition_m"): _at_least(profile.ramp_transition_length, "fittings", "ramp_transition_m"),
        ("site", "exits"): _exits(profile, given, side_m, column_m, width_m),
    }
    if side_m != DEFAULT_SIDE_M and "square_side_m" not in given["bay"]:
        # a side that only the profile asks for is not a wish for a uniform grid
        yield "bay", "dimensioned", _default("bay", "dimensioned")
    for (section, key), value in chosen.items():
        if value != _default(section, key):
            yield section, key, value


def _wall_gap_m(profile: Profile, stall_width_m: float) -> float:
    """What a stall's line keeps from a wall, so that the design car in the middle keeps its distance."""
    default = float(_default("bay", "wall_gap_m"))
    if profile.wall_clearance is None or profile.design_car_width is None:
        return default
    return max(
        default, _rounded_up(profile.wall_clearance.amount - (stall_width_m - profile.design_car_width.amount) / 2)
    )


def _exits(profile: Profile, given: _Sections, side_m: float, column_m: float, width_m: float) -> int:
    """Exits with which there are enough portals for any number of stalls that the site can hold.

    Lanes that form one network serve at most two squares each and two more, so that at most two thirds of the squares
    hold stalls.
    """
    default = int(_default("site", "exits"))
    if profile.portals is None:
        return default
    height, width = SiteConfig().shape
    rows, cols = _whole(given, "height_cells", height), _whole(given, "width_cells", width)
    contour = given["site"].get("contour")
    if isinstance(contour, str):
        rows, cols = 1, contour.count(".")
    in_a_square = max(math.floor((side_m - column_m + 1e-9) / width_m), 1)
    most_stalls = (2 * rows * cols + 2) // 3 * in_a_square
    entrances = _whole(given, "entrances", int(_default("site", "entrances")))
    return max(default, profile.portals.required(most_stalls) - entrances)


def _whole(given: _Sections, key: str, fallback: int) -> int:
    value = _number(given, "site", key, fallback)
    return value if isinstance(value, int) and 0 < value < 10_000 else fallback  # noqa: PLR2004 - validated later


def _number(given: _Sections, section: str, key: str, fallback: float | None = None) -> Any:  # noqa: ANN401 - not validated
    """What the user gives for a setting, if it is a number, else `fallback` or the default."""
    value = given[section].get(key)
    if isinstance(value, int | float) and not isinstance(value, bool) and abs(value) <= _LARGEST:
        return value
    return _default(section, key) if fallback is None else fallback


def _or_default(clause: Length | None, section: str, key: str) -> float:
    return _rounded_up(clause.amount) if clause else float(_default(section, key))


def _at_least(clause: Length | None, section: str, key: str) -> float:
    return max(float(_default(section, key)), _or_default(clause, section, key))


def _lux(clause: Illuminance | None, key: str) -> float:
    default = float(_default("fittings", key))
    return max(default, clause.amount) if clause else default


def _rounded_up(length_m: float) -> float:
    return round(max(math.ceil(length_m / _STEP_M - 1e-6), 1) * _STEP_M, 6)


def _default(section: str, key: str) -> Any:  # noqa: ANN401
    return _MODELS[section].model_fields[key].default
