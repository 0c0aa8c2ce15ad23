"""Heights of a surveyed level: its ceiling under the floor above, and what the survey says of both."""

from garage2usd.common.randomness import Step, derived_seed
from garage2usd.config import GarageConfig
from garage2usd.config.fittings import CEILING_ROOM_M, FittingsConfig
from garage2usd.survey.survey import Survey

LEAST_SLAB_M = 0.25
"""Least distance of a ceiling's underside from the floor above."""
_LEAST_CLEAR_M, _MOST_CLEAR_M, _LEAST_CEILING_M, _MOST_CEILING_M = 2.0, 6.0, 2.4, 8.0


def level_config(config: GarageConfig, number: int, storey_m: float, survey: Survey) -> tuple[GarageConfig, list[str]]:
    """Return the settings of a level, and remarks on its heights.

    Below the top level these have a seed of their own, and a ceiling under the floor above. Heights of the survey count
    where the settings give none, within those for which garages are built.
    """
    given, fittings, told = config.fittings.model_fields_set, config.fittings, []
    changed: dict[str, float] = {}
    if survey.ceiling_height_m is not None and "ceiling_height_m" not in given:
        most_m = min(_MOST_CEILING_M, storey_m - LEAST_SLAB_M) if number else _MOST_CEILING_M
        ceiling_m = _within(survey.ceiling_height_m, _LEAST_CEILING_M, most_m)
        changed["ceiling_height_m"] = ceiling_m
        told.append(f"the ceiling is {ceiling_m:g} m high{_asked(survey.ceiling_height_m, ceiling_m)}")
    clear_m = fittings.clear_height_m
    if survey.clear_height_m is not None and "clear_height_m" not in given:
        clear_m = _within(survey.clear_height_m, _LEAST_CLEAR_M, _MOST_CLEAR_M)
    ceiling_m = changed.get("ceiling_height_m", fittings.ceiling_height_m)
    if "ceiling_height_m" not in given | changed.keys():
        ceiling_m = max(ceiling_m, clear_m + CEILING_ROOM_M)
    if number:
        ceiling_m = min(ceiling_m, storey_m - LEAST_SLAB_M)
    clear_m = min(clear_m, ceiling_m - CEILING_ROOM_M) if changed or clear_m != fittings.clear_height_m else clear_m
    if clear_m != fittings.clear_height_m:
        asked = _asked(survey.clear_height_m, clear_m) if survey.clear_height_m else ", under that ceiling"
        told.append(f"the clear height is {clear_m:g} m{asked}")
    return _with(config, number, fittings, round(clear_m, 6), round(ceiling_m, 6)), told


def _with(config: GarageConfig, number: int, old: FittingsConfig, clear_m: float, ceiling_m: float) -> GarageConfig:
    heights = {"clear_height_m": clear_m, "ceiling_height_m": ceiling_m}
    if not number and heights == {name: getattr(old, name) for name in heights}:
        return config
    changed: dict[str, object] = {"fittings": old.model_copy(update=heights)}
    if number:
        changed["seed"] = derived_seed(config.seed, Step.LEVELS, number)
    return config.model_copy(update=changed)


def _within(height_m: float, least_m: float, most_m: float) -> float:
    return round(max(least_m, min(height_m, most_m)), 6)


def _asked(surveyed_m: float | None, built_m: float) -> str:
    same = surveyed_m is not None and abs(surveyed_m - built_m) < 1e-3  # noqa: PLR2004 - a millimetre
    return ", as surveyed" if same else f", as near as garages are built to the {surveyed_m:g} m of the survey"
