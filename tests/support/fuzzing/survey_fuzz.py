"""Damaged surveys into ``import``: ``python -m support.fuzzing.survey_fuzz [--count N] [--seed N] [--first N]`` in
``tests``.

Each is imported, or ends in one line, without a traceback, within a minute of processor time and 1 GB, and writes
nothing outside its output folder nor what drives a terminal.
"""

import argparse
import sys
import tempfile
from functools import partial
from pathlib import Path

from support.fuzzing.command_fuzz import Fuzz, load_commands, made_apart, told
from support.fuzzing.survey_inputs import draw_survey_case, sound_surveys

SLOWEST_S, _HARD_S, MOST_MB = 60, 70, 1024


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--count", type=int, default=600)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--first", type=int, default=0)
    options = parser.parse_args()
    folder = Path(tempfile.mkdtemp(prefix="garage2usd-fuzz-"))
    draw = partial(draw_survey_case, made_apart(sound_surveys, folder), options.seed)
    runner = Fuzz(draw, folder, slowest_s=SLOWEST_S, hard_s=_HARD_S, most_mb=MOST_MB)
    load_commands()
    for number in range(options.first, options.first + options.count):
        runner.run(number)
    return told(runner)


if __name__ == "__main__":
    sys.exit(main())
