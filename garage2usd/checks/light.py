"""Rules of light: the mean direct illuminance of the floor of lanes and stalls."""

from collections.abc import Iterator

from garage2usd.checks.rule import Miss, RuleBook
from garage2usd.checks.subject import Subject
from garage2usd.profiles import Profile

__all__ = ["BOOK"]

BOOK = RuleBook()
_ROUNDING = 0.99


def _dark(what: str, subject: Subject) -> str:
    """That something is too dark, and how many lamps are dead, which may be why."""
    because = f": {subject.dead_lamps} of {subject.lamps} lamps give no light" if subject.dead_lamps else ""
    return f"the {what} are too dark{because}"


def _lights_are_told(subject: Subject, _: Profile) -> str:
    """A plan that could not be laid out has no lights, and not every stage of others has."""
    return "" if subject.lane_lux is not None else "no illuminance of the floor is known"


@BOOK.rule(
    "lane-illuminance",
    "lane_illuminance",
    asks="the lanes' floor is bright enough",
    hindrance=_lights_are_told,
)
def _lanes(subject: Subject, profile: Profile) -> Iterator[Miss]:
    required, measured = profile.lane_illuminance, subject.lane_lux
    if required and measured is not None and measured < required.amount * _ROUNDING:
        yield Miss("", None, _dark("lanes", subject), measured, required.amount)


@BOOK.rule(
    "stall-illuminance",
    "stall_illuminance",
    asks="the stalls' floor is bright enough",
    hindrance=_lights_are_told,
)
def _stalls(subject: Subject, profile: Profile) -> Iterator[Miss]:
    required, measured = profile.stall_illuminance, subject.stall_lux
    if required and measured is not None and measured < required.amount * _ROUNDING:
        yield Miss("", None, _dark("stalls", subject), measured, required.amount)
