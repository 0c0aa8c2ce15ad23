"""Faults planted in the modules of maps: a text of one is replaced, and all of them are imported anew around it."""

import importlib
import importlib.util
import sys
from contextlib import contextmanager
from dataclasses import dataclass
from types import ModuleType

ROOM = "garage2usd.maps"


@dataclass(frozen=True)
class Fault:
    """A text that stands once in a module of maps, and what takes its place.

    Whether it stands there is asked when the tests are collected, so that a change of the module is heard at once, not
    only by the wide tests.
    """

    name: str
    module: str
    old: str
    new: str

    def __post_init__(self):
        assert self.source.count(self.old) == 1, f"{self.name}: its text is not once in {ROOM}.{self.module}"

    @property
    def source(self):
        """The text of the module."""
        return importlib.util.find_spec(f"{ROOM}.{self.module}").loader.get_source(f"{ROOM}.{self.module}")


@contextmanager
def planted(fault, module):
    """The module of maps with the name `module`, in whose room a fault is planted."""
    name, source = f"{ROOM}.{fault.module}", fault.source
    healthy = {other: sys.modules.pop(other) for other in list(sys.modules) if other.startswith(f"{ROOM}.")}
    try:
        sys.modules[name] = faulty = ModuleType(name)
        exec(compile(source.replace(fault.old, fault.new), f"faulty {name}", "exec"), faulty.__dict__)  # noqa: S102
        yield importlib.import_module(f"{ROOM}.{module}")
    finally:
        for other in [other for other in sys.modules if other.startswith(f"{ROOM}.")]:
            del sys.modules[other]
        sys.modules.update(healthy)
        for other, own in healthy.items():
            setattr(sys.modules[ROOM], other.rpartition(".")[2], own)


def first_complaint(*judges):
    """What the first of some judges that finds something says; a map that one does not even read is one."""
    for complaints in judges:
        try:
            for complaint in complaints():
                return complaint
        except (AssertionError, KeyError, ValueError) as error:
            return str(error) or type(error).__name__
    return None
