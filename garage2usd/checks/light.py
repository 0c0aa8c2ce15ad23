"""Rules of light: the mean direct illuminance of the floor of lanes and stalls."""

from collections.abc import Iterator

from garage2usd.checks.rule import Miss, RuleBook
from garage2usd.checks.subject import Subject
from garage2usd.profiles import Profile

__all__ = ["BOOK"]

BOOK = RuleBook()
_ROUNDING = 0.99


@BOOK.rule("lane-illuminance", "lane_illuminance", asks="the lanes' floor is bright enough")
def _lanes(subject: Subject, profile: Profile) -> Iterator[Miss]:
    required, measured = profile.lane_illuminance, subject.lane_lux
    if required and measured is not None and measured < required.amount * _ROUNDING:
        yield Miss("", None, "the lanes are too dark", measured, required.amount)


@BOOK.rule("stall-illuminance", "stall_illuminance", asks="the stalls' floor is bright enough")
def _stalls(subject: Subject, profile: Profile) -> Iterator[Miss]:
    required, measured = profile.stall_illuminance, subject.stall_lux
    if required and measured is not None and measured < required.amount * _ROUNDING:
        yield Miss("", None, "the stalls are too dark", measured, required.amount)
