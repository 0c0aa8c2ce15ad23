"""Defaults derived from a profile: sizes with which a garage passes the checks of its own standard."""

import math
from collections.abc import Iterator, Mapping
from typing import Any

from garage2usd.common.settings import Settings
from garage2usd.config.fittings import CEILING_ROOM_M, FittingsConfig
from garage2usd.config.plan import PlanConfig
from garage2usd.config.site import DEFAULT_SIDE_M, BayConfig, SiteConfig
from garage2usd.profiles import Length, Profile
from garage2usd.profiles.access import least_stall_width_m
from garage2usd.profiles.clauses import Illuminance
from garage2usd.profiles.profile import USUAL_CAR_WIDTH_M

_Sections = Mapping[str, Mapping[str, Any]]
"""Settings given by the user, by section and key."""
_MODELS: dict[str, type[Settings]] = {
    "bay": BayConfig,
    "fittings": FittingsConfig,
    "plan": PlanConfig,
    "site": SiteConfig,
}
_CARS_BETWEEN_COLUMNS = 3
_STEP_M, _FINE_STEP_M = 0.01, 0.001
_WIDEST_DOOR_M = 5.8
"""Widest clear door: vehicle doors are at most 6 m wide, and the posts of their frame take the rest."""
_DRAWN = ("contour", "structure", "structure_file", "entrance_cells", "exit_cells")
_LARGEST = 1e6
"""Upper bound of computed sizes; a larger value from the user is refused by the validation."""


def designed_settings(profile: Profile, settings: Mapping[str, Any]) -> dict[str, Any]:
    """Add the values that a profile requires to settings; values given by the user are kept.

    Parameters
    ----------
    profile
        The standard that the garage is designed to.
    settings
        The user's sections, as mappings or models; anything else is left to their validation.

    Notes
    -----
    A default that satisfies the profile is kept, so that an empty profile changes nothing.
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
    """Keys and values that the user gives in a section, a mapping or a model; empty for any other object."""
    if isinstance(section, Settings):
        return {name: getattr(section, name) for name in section.model_fields_set}
    return section if isinstance(section, Mapping) else {}


def _design(profile: Profile, given: _Sections) -> Iterator[tuple[str, str, Any]]:
    """Yield section, key and value of each setting whose default violates the profile."""
    width_m, length_m = _stall_m(profile)
    column_m = _number(given, "bay", "column_size_m")
    aisle_m = _at_least(profile.aisle_width, "bay", "aisle_width_m")
    wall_gap_m = _wall_gap_m(profile, column_m, _number(given, "bay", "stall_width_m", width_m))
    bay = BayConfig(
        **{
            key: _within("bay", key, value)
            for key, value in {
                "stall_width_m": width_m,
                "stall_length_m": length_m,
                "column_size_m": column_m,
                "aisle_width_m": aisle_m,
                "wall_gap_m": wall_gap_m,
                "portal_width_m": min(_at_least(profile.portal_width, "bay", "portal_width_m"), _WIDEST_DOOR_M),
            }.items()
        }
    )
    row_m = bay.row_m(_CARS_BETWEEN_COLUMNS)
    side_m = max(DEFAULT_SIDE_M, _rounded_up(row_m), _rounded_up(bay.aisle_side_m))
    grid_m = _grid_m(profile, bay, side_m)
    exits = _exits(profile, given, side_m, column_m, width_m)
    clear_m = max(
        _at_least(profile.clear_height, "fittings", "clear_height_m"),
        _at_least(profile.van_clear_height, "fittings", "clear_height_m"),
    )
    longest_m = grid_m or max(row_m, bay.aisle_side_m, bay.portal_side_m, length_m)
    chosen = {
        ("bay", "stall_width_m"): width_m,
        ("bay", "stall_length_m"): length_m,
        ("bay", "aisle_width_m"): aisle_m,
        ("bay", "wall_gap_m"): wall_gap_m,
        ("bay", "square_side_m"): grid_m or side_m,
        ("bay", "portal_width_m"): bay.portal_width_m,
        ("plan", "dead_end_cells"): _dead_end_cells(profile, longest_m),
        ("plan", "longest_stretch_cells"): _stretch_cells(profile, longest_m),
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
        ("fittings", "ramp_transition_m"): max(
            _default("fittings", "ramp_transition_m"), _rounded_up(profile.transition_length_m)
        ),
        ("site", "exits"): exits,
        ("site", "min_portal_distance_cells"): _portal_cells(profile, given, grid_m or length_m, exits),
    }
    if (grid_m or side_m != DEFAULT_SIDE_M) and "square_side_m" not in given["bay"]:
        # a side length from the profile forces a uniform grid only if it comes from the clause on columns
        yield "bay", "dimensioned", grid_m is None
    for (section, key), value in chosen.items():
        allowed = _within(section, key, value)
        if allowed != _default(section, key):
            yield section, key, allowed


def _stall_m(profile: Profile) -> tuple[float, float]:
    """Width and length of a stall in metres.

    One stall holds the design car; two adjacent ones hold an accessible stall with its access aisle.
    """
    width_m = _or_default(profile.stall_width, "bay", "stall_width_m")
    length_m = _or_default(profile.stall_length, "bay", "stall_length_m")
    if profile.design_car_width and not profile.stall_width:
        width_m = max(width_m, _rounded_up(profile.car_width_m + width_m - USUAL_CAR_WIDTH_M))
    behind_m = profile.end_clearance.amount if profile.end_clearance else 0.0
    length_m = max(length_m, _rounded_up(profile.car_length_m + behind_m))
    return max(width_m, _rounded_up(least_stall_width_m(profile))), length_m


def _wall_gap_m(profile: Profile, column_m: float, stall_width_m: float) -> float:
    """Gap from a stall's line to walls and columns, in metres, that gives a centred design car its clearances."""
    beside_car_m = (stall_width_m - profile.car_width_m) / 2
    gaps = [float(_default("bay", "wall_gap_m"))]
    if profile.wall_clearance:
        gaps.append(_rounded_up(profile.wall_clearance.amount - beside_car_m))
    if profile.column_clearance:
        gaps.append(_rounded_up(column_m / 2 + profile.column_clearance.amount - beside_car_m))
    return max(gaps)


def _grid_m(profile: Profile, bay: BayConfig, side_m: float) -> float | None:
    """Side in metres of the uniform grid for the clause on column spacing; None if none is needed or possible."""
    if profile.column_spacing is None:
        return None
    least_m, most_m = profile.column_spacing.bounds
    rows_m = [bay.row_m(count) for count in range(1, _CARS_BETWEEN_COLUMNS + 1)]
    sides_m = [bay.stall_length_m, bay.aisle_side_m, bay.portal_side_m, *rows_m[1:]]
    if least_m <= min(sides_m) and max(sides_m) <= most_m:
        return None
    needed_m = max(bay.stall_length_m, bay.aisle_side_m, bay.portal_side_m)
    fitting = (max(least_m, needed_m, row_m) for row_m in (side_m, *reversed(rows_m)))
    return next((_rounded_up(grid_m, _FINE_STEP_M) for grid_m in fitting if grid_m <= most_m), None)


def _dead_end_cells(profile: Profile, longest_m: float) -> int:
    """Greatest depth of a dead end, counted in squares of the longest side."""
    default = int(_default("plan", "dead_end_cells"))
    return min(default, int(profile.dead_end_depth.amount / longest_m)) if profile.dead_end_depth else default


def _stretch_cells(profile: Profile, longest_m: float) -> int | None:
    """Longest stretch without a junction, counted in squares of the longest side; at least 1, as 0 means no limit."""
    return max(int(profile.stretch_length.amount / longest_m), 1) if profile.stretch_length else None


def _portal_cells(profile: Profile, given: _Sections, shortest_m: float, exits: int) -> int:
    """Least Manhattan distance of portals, in squares, that keeps the profile's distance around a corner of the site.

    Two doors at a given Manhattan distance are closest if both are equally far from the corner. The result is limited
    to what every draw on a rectangle can reach; drawn or given contours keep the default.
    """
    default = int(_default("site", "min_portal_distance_cells"))
    is_plain = all(given["site"].get(key) is None for key in _DRAWN) and not _number(given, "site", "rectangles")
    if profile.portal_distance is None or not is_plain:
        return default
    portals = _whole(given, "exits", exits) + _whole(given, "entrances", int(_default("site", "entrances")))
    needed = math.ceil(math.sqrt(2) * profile.portal_distance.amount / shortest_m - 1)
    return max(default, min(needed, sum(_shape(given)) // portals - 1))


def _exits(profile: Profile, given: _Sections, side_m: float, column_m: float, width_m: float) -> int:
    """Number of exits that gives enough portals for the most stalls that the site can hold.

    A connected network of n lane squares serves at most 2 n + 2 squares, so that at most two thirds of the squares hold
    stalls.
    """
    default = int(_default("site", "exits"))
    if profile.portals is None:
        return default
    rows, cols = _shape(given)
    contour = given["site"].get("contour")
    if isinstance(contour, str):
        rows, cols = 1, contour.count(".")
    in_a_square = max(math.floor((side_m - column_m + 1e-9) / width_m), 1)
    most_stalls = (2 * rows * cols + 2) // 3 * in_a_square
    entrances = _whole(given, "entrances", int(_default("site", "entrances")))
    return max(default, profile.portals.required(most_stalls) - entrances)


def _shape(given: _Sections) -> tuple[int, int]:
    """Rows and columns of a site that is not given as a drawing."""
    height, width = SiteConfig().shape
    return _whole(given, "height_cells", height), _whole(given, "width_cells", width)


def _whole(given: _Sections, key: str, fallback: int) -> int:
    value = _number(given, "site", key, fallback)
    return value if isinstance(value, int) and 0 < value < 10_000 else fallback  # noqa: PLR2004 - validated later


def _number(given: _Sections, section: str, key: str, fallback: float | None = None) -> Any:  # noqa: ANN401 - not validated
    """The user's value of a setting if it is a number, else `fallback` or the default."""
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


def _rounded_up(length_m: float, step_m: float = _STEP_M) -> float:
    return round(max(math.ceil(length_m / step_m - 1e-6), 1) * step_m, 6)


def _within(section: str, key: str, value: float | None) -> Any:  # noqa: ANN401
    """The allowed value of a setting that is nearest to `value`."""
    if value is None:
        return None
    bounds = _MODELS[section].model_fields[key].metadata
    least = max((bound.ge for bound in bounds if hasattr(bound, "ge")), default=-math.inf)
    most = min((bound.le for bound in bounds if hasattr(bound, "le")), default=math.inf)
    return min(max(value, least), most)


def _default(section: str, key: str) -> Any:  # noqa: ANN401
    return _MODELS[section].model_fields[key].default
