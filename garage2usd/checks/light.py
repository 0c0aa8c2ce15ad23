"""Rules of lighting: mean direct illuminance on the floor of lanes and stalls."""

from collections.abc import Iterator

from garage2usd.as_built.level import BuiltLevel
from garage2usd.checks.rule import Miss, RuleBook
from garage2usd.profiles import Profile

__all__ = ["BOOK", "DEAD_LAMPS"]

BOOK = RuleBook()
DEAD_LAMPS = "lamps give no light"
"""End of a message that names dead lamps as the cause."""
_ROUNDING = 0.99


def _dark(what: str, level: BuiltLevel) -> str:
    """Return the message that lanes or stalls are too dark, with the number of dead lamps as a possible cause."""
    because = f": {level.dead_lamps} of {level.lamps} {DEAD_LAMPS}" if level.dead_lamps else ""
    return f"the {what} are too dark{because}"


def _lights_are_told(level: BuiltLevel, _: Profile) -> str:
    """Explain why illuminance cannot be checked: the plan has no layout, or the stage has no lights."""
    return "" if level.lane_lux is not None else "no illuminance of the floor is known"


@BOOK.rule(
    "lane-illuminance",
    "lane_illuminance",
    asks="the lanes' floor is bright enough",
    hindrance=_lights_are_told,
)
def _lanes(level: BuiltLevel, profile: Profile) -> Iterator[Miss]:
    required, measured = profile.lane_illuminance, level.lane_lux
    if required and measured is not None and measured < required.amount * _ROUNDING:
        yield Miss("", None, _dark("lanes", level), measured, required.amount)


@BOOK.rule(
    "stall-illuminance",
    "stall_illuminance",
    asks="the stalls' floor is bright enough",
    hindrance=_lights_are_told,
)
def _stalls(level: BuiltLevel, profile: Profile) -> Iterator[Miss]:
    required, measured = profile.stall_illuminance, level.stall_lux
    if required and measured is not None and measured < required.amount * _ROUNDING:
        yield Miss("", None, _dark("stalls", level), measured, required.amount)
