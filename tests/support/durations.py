"""Processor seconds of test files in `make test` and in `make soak`, as ``--write-durations`` last wrote them.

Processor time, of tests and of the programs that they start, hardly depends on what else a machine does.
"""

import json
import os
from collections import Counter
from pathlib import Path
from statistics import median

FILE = Path(__file__).parents[1] / "durations.json"
UNKNOWN_S = 5.0
"""What a file without an entry is taken for."""

_TICKS_IN_S = os.sysconf("SC_CLK_TCK")
_USER_TO_CHILDREN_SYSTEM = slice(11, 15)  # of /proc/PID/stat after the name: proc(5) counts them 14 to 17
_LEAST_S = 5.0  # less is mostly the start of a worker and the imports


def processor_time_s():
    """Of this process and all that it started, still running or not."""
    return sum(os.times()[:4]) + sum(map(_time_of_s, _children(os.getpid())))


def read_durations():
    """Seconds by file relative to the repository, and of its wide tests by ``file::soak``."""
    return json.loads(FILE.read_text())


def write_durations(reports, *, soak):
    """Replace the seconds of the files of which there are reports."""
    durations = read_durations() | {key: round(seconds, 1) for key, seconds in _measured(reports, soak=soak).items()}
    FILE.write_text(json.dumps(dict(sorted(durations.items())), indent=1) + "\n")


def outdated(reports, *, soak):
    """Entries that are off by more than half, as (key, noted, measured); a machine may be slower throughout."""
    noted = read_durations()
    measured = {key: seconds for key, seconds in _measured(reports, soak=soak).items() if seconds >= _LEAST_S}
    speed = median([seconds / noted[key] for key, seconds in measured.items() if noted.get(key)] or [1.0])
    return [
        (key, noted.get(key), round(seconds, 1))
        for key, seconds in sorted(measured.items())
        if not 0.5 <= seconds / speed / (noted.get(key) or UNKNOWN_S) <= 1.5
    ]


def soak_key(nodeid):
    """The entry of a wide test: those of a file are one, as they share what its fixtures make."""
    return f"{nodeid.partition('::')[0]}::soak"


def _measured(reports, *, soak):
    found = Counter()
    for report in reports:
        key = soak_key(report.nodeid) if soak else report.nodeid.partition("::")[0]
        found[key] += dict(report.user_properties).get("processor_time_s", 0.0) if report.when == "teardown" else 0.0
    return found


def _children(process):
    try:
        return [
            int(child)
            for task in Path(f"/proc/{process}/task").iterdir()
            for child in (task / "children").read_text().split()
        ]
    except OSError:  # ended meanwhile
        return []


def _time_of_s(process):
    try:
        fields = Path(f"/proc/{process}/stat").read_text().rpartition(")")[2].split()
    except OSError:
        return 0.0
    return sum(map(int, fields[_USER_TO_CHILDREN_SYSTEM])) / _TICKS_IN_S + sum(map(_time_of_s, _children(process)))
