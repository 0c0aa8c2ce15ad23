"""What a profile asks of the settings: sizes that a garage needs to pass its own check."""

import math
from collections.abc import Iterator, Mapping
from typing import Any

from garage2usd.config.fittings import CEILING_ROOM_M, FittingsConfig
from garage2usd.config.site import CARRIAGEWAY_MARGIN_M, DEFAULT_SIDE_M, BayConfig, SiteConfig
from garage2usd.profiles import Length, Profile
from garage2usd.settings import Settings

__all__ = ["designed_settings"]

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
    for section, key, value in _design(profile, settings):
        given = result.get(section)
        if given is None:
            result[section] = {key: value}
        elif isinstance(given, Settings):
            if key not in given.model_fields_set:
                result[section] = type(given)(**{**_set_fields(given), key: value})
        elif isinstance(given, Mapping) and key not in given:
            result[section] = {**given, key: value}
    return result


def _set_fields(section: Settings) -> dict[str, Any]:
    return {name: getattr(section, name) for name in section.model_fields_set}


def _design(profile: Profile, settings: Mapping[str, Any]) -> Iterator[tuple[str, str, Any]]:
    """Section, key and value of each setting whose default does not satisfy the profile."""
    width_m = _or_default(profile.stall_width, BayConfig, "stall_width_m")
    length_m = _or_default(profile.stall_length, BayConfig, "stall_length_m")
    column_m = _given(settings, "bay", "column_size_m", BayConfig)
    aisle_m = _at_least(profile.aisle_width, BayConfig, "aisle_width_m")
    side_m = max(
        DEFAULT_SIDE_M,
        _rounded_up(column_m + _CARS_BETWEEN_COLUMNS * width_m),
        _rounded_up(aisle_m + column_m + 2 * CARRIAGEWAY_MARGIN_M),
    )
    clear_m = max(
        _at_least(profile.clear_height, FittingsConfig, "clear_height_m"),
        _at_least(profile.van_clear_height, FittingsConfig, "clear_height_m"),
    )
    chosen = {
        ("bay", "stall_width_m"): width_m,
        ("bay", "stall_length_m"): length_m,
        ("bay", "aisle_width_m"): aisle_m,
        ("bay", "wall_gap_m"): _wall_gap_m(profile, _given(settings, "bay", "stall_width_m", BayConfig, width_m)),
        ("bay", "square_side_m"): side_m,
        ("bay", "portal_width_m"): min(_at_least(profile.portal_width, BayConfig, "portal_width_m"), _WIDEST_DOOR_M),
        ("fittings", "clear_height_m"): clear_m,
        ("fittings", "ceiling_height_m"): max(
            _default(FittingsConfig, "ceiling_height_m"),
            _rounded_up(clear_m + CEILING_ROOM_M),
        ),
        ("fittings", "lane_lux"): max(
            _default(FittingsConfig, "lane_lux"), profile.lane_illuminance.amount if profile.lane_illuminance else 0.0
        ),
        ("fittings", "stall_lux"): max(
            _default(FittingsConfig, "stall_lux"),
            profile.stall_illuminance.amount if profile.stall_illuminance else 0.0,
        ),
        ("fittings", "ramp_slope_percent"): min(
            _default(FittingsConfig, "ramp_slope_percent"),
            profile.ramp_slope.amount if profile.ramp_slope else math.inf,
        ),
        ("fittings", "ramp_transition_m"): _at_least(
            profile.ramp_transition_length, FittingsConfig, "ramp_transition_m"
        ),
        ("site", "exits"): _exits(profile, settings, side_m, column_m, width_m),
    }
    if side_m != DEFAULT_SIDE_M and not _is_given(settings, "bay", "square_side_m"):
        # a side that only the profile asks for is not a wish for a uniform grid
        yield "bay", "dimensioned", _default(BayConfig, "dimensioned")
    models: dict[str, type[Settings]] = {"bay": BayConfig, "fittings": FittingsConfig, "site": SiteConfig}
    for (section, key), value in chosen.items():
        if value != _default(models[section], key):
            yield section, key, value


def _wall_gap_m(profile: Profile, stall_width_m: float) -> float:
    """What a stall's line keeps from a wall, so that the design car in the middle keeps its distance."""
    default = float(_default(BayConfig, "wall_gap_m"))
    if profile.wall_clearance is None or profile.design_car_width is None:
        return default
    return max(
        default, _rounded_up(profile.wall_clearance.amount - (stall_width_m - profile.design_car_width.amount) / 2)
    )


def _exits(profile: Profile, settings: Mapping[str, Any], side_m: float, column_m: float, width_m: float) -> int:
    """Exits with which there are enough portals for any number of stalls that the site can hold.

    Lanes that form one network serve at most two squares each and two more, so that at most two thirds of the squares
    hold stalls.
    """
    default = int(_default(SiteConfig, "exits"))
    if profile.portals is None:
        return default
    height, width = SiteConfig().shape
    rows, cols = _whole(settings, "height_cells", height), _whole(settings, "width_cells", width)
    site = settings.get("site")
    contour = site.get("contour") if isinstance(site, Mapping) else getattr(site, "contour", None)
    if isinstance(contour, str):
        rows, cols = 1, contour.count(".")
    in_a_square = max(math.floor((side_m - column_m + 1e-9) / width_m), 1)
    most_stalls = (2 * rows * cols + 2) // 3 * in_a_square
    entrances = _whole(settings, "entrances", int(_default(SiteConfig, "entrances")))
    return max(default, profile.portals.required(most_stalls) - entrances)


def _whole(settings: Mapping[str, Any], key: str, fallback: int) -> int:
    value = _given(settings, "site", key, SiteConfig, fallback)
    return value if isinstance(value, int) and 0 < value < 10_000 else fallback  # noqa: PLR2004 - validated later


def _given(
    settings: Mapping[str, Any], section: str, key: str, model: type[Settings], fallback: float | None = None
) -> Any:  # noqa: ANN401 - whatever the user gave, before it is validated
    """What the user gave for a setting, if it is a number, else `fallback` or the default."""
    given = settings.get(section)
    value = None
    if isinstance(given, Mapping):
        value = given.get(key)
    elif isinstance(given, Settings) and key in given.model_fields_set:
        value = getattr(given, key)
    if isinstance(value, int | float) and not isinstance(value, bool) and abs(value) <= _LARGEST:
        return value
    return _default(model, key) if fallback is None else fallback


def _is_given(settings: Mapping[str, Any], section: str, key: str) -> bool:
    given = settings.get(section)
    if isinstance(given, Settings):
        return key in given.model_fields_set
    return isinstance(given, Mapping) and key in given


def _or_default(clause: Length | None, model: type[Settings], key: str) -> float:
    return _rounded_up(clause.amount) if clause else float(_default(model, key))


def _at_least(clause: Length | None, model: type[Settings], key: str) -> float:
    default = float(_default(model, key))
    return max(default, _rounded_up(clause.amount)) if clause else default


def _rounded_up(length_m: float) -> float:
    return round(max(math.ceil(length_m / _STEP_M - 1e-6), 1) * _STEP_M, 6)


def _default(model: type[Settings], key: str) -> Any:  # noqa: ANN401
    return model.model_fields[key].default
