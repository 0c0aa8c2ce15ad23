"""Rules of inconsistent garage files: lane graphs with gaps, duplicate stalls, and plans that are refused."""

from collections.abc import Callable, Iterator

from garage2usd.as_built.level import BuiltLevel
from garage2usd.checks.rule import Miss, RuleBook
from garage2usd.profiles import Profile

BOOK = RuleBook()


def _faults(name: str) -> Callable[[BuiltLevel, Profile], Iterator[Miss]]:
    def find(level: BuiltLevel, _: Profile) -> Iterator[Miss]:
        for fault in level.faults:
            if fault.rule == name:
                yield Miss(fault.place, fault.position, fault.message)

    return find


for _name, _asks in (
    ("lane-graph", "a stage has a lane graph whose nodes, edges and stalls fit together"),
    ("stall-outline", "a stall's prim lies where the lane graph has its outline"),
    ("plan-refused", "a garage can be built from a plan"),
    ("report-stalls", "a report lists the stalls that its configuration and matrices give"),
):
    BOOK.rule(_name, asks=_asks)(_faults(_name))
