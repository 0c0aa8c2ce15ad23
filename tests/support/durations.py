"""How long each test file takes, as `make test` last wrote it with ``--write-durations``."""

import json
from collections import Counter
from pathlib import Path

FILE = Path(__file__).parents[1] / "durations.json"


def read_durations():
    """Seconds on one core by file, relative to the repository."""
    return json.loads(FILE.read_text())


def write_durations(reports):
    """Replace the seconds of the files of which there are reports."""
    found = Counter()
    for report in reports:
        found[report.nodeid.partition("::")[0]] += report.duration
    durations = read_durations() | {file: round(seconds, 1) for file, seconds in found.items()}
    FILE.write_text(json.dumps(dict(sorted(durations.items())), indent=1) + "\n")
