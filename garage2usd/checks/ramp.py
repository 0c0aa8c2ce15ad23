"""Rules of ramps: their slope, and the transition slopes at their foot and top."""

from collections.abc import Iterator

from garage2usd.as_built.level import BuiltLevel
from garage2usd.checks.rule import Miss, RuleBook, where_laid_out
from garage2usd.profiles import Profile

__all__ = ["BOOK"]

BOOK = RuleBook()
_SLOPE_ROUNDING = 0.15
_RUN_ROUNDING_M = 0.06


@BOOK.rule("ramp-slope", "ramp_slope", asks="a straight ramp is not too steep", hindrance=where_laid_out)
def _slope(level: BuiltLevel, profile: Profile) -> Iterator[Miss]:
    if profile.ramp_slope is None:
        return
    for ramp in level.ramps:
        steepest = max((stretch.slope_percent for stretch in ramp.stretches), default=0.0)
        if steepest > profile.ramp_slope.amount + _SLOPE_ROUNDING:
            yield Miss(ramp.name, ramp.position, "the ramp is too steep", steepest, profile.ramp_slope.amount)


@BOOK.rule(
    "ramp-transition",
    "ramp_transition_length",
    "ramp_transition_slope",
    asks="a steep ramp has pieces of half its slope at its foot and its top",
    asking=2,
    hindrance=where_laid_out,
)
def _transition(level: BuiltLevel, profile: Profile) -> Iterator[Miss]:
    required = profile.transition_length_m
    for ramp in level.ramps:
        steepest = max((stretch.slope_percent for stretch in ramp.stretches), default=0.0)
        if steepest <= profile.transition_slope_percent + _SLOPE_ROUNDING:
            continue
        for end, where in ((ramp.stretches[0], "foot"), (ramp.stretches[-1], "top")):
            gentle = end.slope_percent <= steepest / 2 + _SLOPE_ROUNDING
            measured = end.length_m if gentle else 0.0
            if measured < required - _RUN_ROUNDING_M:
                message = f"the ramp's {where} has too short a piece of half its slope"
                yield Miss(ramp.name, ramp.position, message, measured, required)
                break
