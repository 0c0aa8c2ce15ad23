"""Hostile inputs into all commands: ``python -m support.fuzzing.command_fuzz [--count N] [--seed N]
[--first N]`` in ``tests``.

Each call succeeds or ends in one line of error, without a traceback, within ten seconds of processor time, and writes
nothing outside its output folder. What does not is kept in a folder and named by its number.

Each call is a process forked from one that has the program loaded. Commands that read stages have the limits that
`garage2usd.cli.process` gives them, and crashes of USD and ends by a limit count as the errors that it makes of
them.
`view` ends once the page could be shown; of `render`, what comes before Blender is run.
"""

import argparse
import multiprocessing
import os
import pickle
import resource
import shutil
import signal
import sys
import tempfile
import time
from collections import Counter
from collections.abc import Callable
from contextlib import suppress
from functools import partial
from math import inf
from pathlib import Path
from typing import TypeVar

from support.fuzzing.command_inputs import Case, draw_case, lay_out, make_corpus

Made = TypeVar("Made")

SLOWEST_S = 10.0
"""A default build, which some damaged configurations are, plans in metres and checks itself: some five seconds."""
HANGS_S = 300
_HARD_S = 30
_OUTPUT = "out"


class Fuzz:
    """Runs cases in a folder of its own."""

    def __init__(
        self,
        draw: Callable[[int], Case],
        folder: Path,
        *,
        slowest_s: float = SLOWEST_S,
        hard_s: int = _HARD_S,
        most_mb: float = inf,
    ) -> None:
        self.draw, self.folder = draw, folder
        self.slowest_s, self.hard_s, self.most_mb = slowest_s, hard_s, most_mb
        self.outcomes: Counter[str] = Counter()
        self.kinds: Counter[str] = Counter()
        self.slowest = (0.0, -1)
        self.failures: list[str] = []

    def run(self, number: int) -> None:
        """Run one case and note what was wrong with it."""
        case = self.draw(number)
        place = self.folder / f"case_{number}"
        work, temporary = place / "work", place / "temporary"
        work.mkdir(parents=True)
        temporary.mkdir()
        lay_out(case, work)
        before = _listing(work)
        status, seconds, used_mb = _call(case, work, temporary, self.hard_s)
        said = (place / "stderr").read_text(errors="replace")
        outcome, wrong = _judge(case, status, said)
        wrong += [f"{seconds:.1f} s"] if seconds > self.slowest_s else []
        wrong += [f"{used_mb:.0f} MB"] if used_mb > self.most_mb else []
        wrong += ["wrote outside its output"] if _listing(work) != before else []
        wrong += ["left temporary files"] if outcome == "answered" and any(temporary.iterdir()) else []
        self.outcomes[outcome] += 1
        self.kinds[case.kind] += 1
        self.slowest = max(self.slowest, (seconds, number))
        if wrong:
            self.failures.append(f"{number} {case.kind}: {', '.join(wrong)}: {' '.join(case.arguments)!r:.200}")
        else:
            shutil.rmtree(place)


def _call(case: Case, work: Path, temporary: Path, hard_s: int) -> tuple[int, float, float]:
    """Exit code, negative for a signal, processor time and most memory in MB of a call."""
    child = os.fork()
    if child == 0:
        _become_command(case, work, temporary, hard_s)
    deadline = time.monotonic() + HANGS_S
    while True:
        found, status, used = os.wait4(child, os.WNOHANG)
        if found:
            return os.waitstatus_to_exitcode(status), used.ru_utime + used.ru_stime, used.ru_maxrss / 1024
        if time.monotonic() > deadline:
            os.kill(child, signal.SIGKILL)
            deadline = float("inf")
        time.sleep(0.002)


def _become_command(case: Case, work: Path, temporary: Path, hard_s: int) -> None:
    code = 70
    try:
        for stream, name in ((0, "/dev/null"), (1, "stdout"), (2, "stderr")):
            os.dup2(os.open(work.parent / name, os.O_RDWR | os.O_CREAT), stream)
        os.chdir(work)
        os.environ["TMPDIR"] = tempfile.tempdir = str(temporary)
        resource.setrlimit(resource.RLIMIT_CPU, (hard_s, hard_s))
        from garage2usd.cli import main
        from garage2usd.cli.process import SUPERVISED
        from garage2usd.common import limits

        if case.arguments[0] in SUPERVISED:
            limits.enforce()
        with suppress(KeyboardInterrupt):
            main([word for word in case.arguments if word != "\0"], prog_name="garage2usd")
        code = 0
    except SystemExit as end:
        code = end.code if isinstance(end.code, int) else 0 if end.code is None else 1
    except BaseException:
        sys.excepthook(*sys.exc_info())
    finally:
        for stream in (sys.stdout, sys.stderr):
            with suppress(ValueError, OSError):
                stream.flush()
        os._exit(code)


def _judge(case: Case, status: int, said: str) -> tuple[str, list[str]]:
    from garage2usd.cli.process import CRASHES, SUPERVISED

    wrong = ["a traceback"] if "Traceback (most recent call last)" in said else []
    if status >= 0:
        wrong += [] if status in {0, 1, 2} else [f"ended with {status}"]
        if case.arguments[0] == "import" and status:
            wrong += [] if said.startswith("Error: ") and len(said.splitlines()) == 1 else ["other than one line"]
        wrong += ["no word of what is wrong"] if status == 2 and "rror" not in said and "Usage" not in said else []
        return "answered", wrong
    number = -status
    if case.arguments[0] in SUPERVISED and number in {*CRASHES, signal.SIGXCPU} and number != signal.SIGKILL:
        return f"ended by {signal.Signals(number).name}", wrong
    return "ended by a signal", [*wrong, f"ended by {signal.Signals(number).name}"]


def _listing(folder: Path) -> dict[str, tuple[int, int]]:
    """All paths but the output's, with size and time of the last change."""
    found = {}
    for parent, folders, files in os.walk(folder.parent):
        if parent == str(folder.parent):
            folders[:] = [folder.name]
            continue
        if parent == str(folder):
            folders[:] = [name for name in folders if name != _OUTPUT]
        for name in (*folders, *files):
            status = os.lstat(Path(parent) / name)
            found[str(Path(parent) / name)] = (0, 0) if name in folders else (status.st_size, status.st_mtime_ns)
    return found


def made_apart(make: Callable[[Path], Made], folder: Path) -> Made:
    """The sound files, made by a process of its own: this one must not start USD's threads, as it forks."""
    maker = multiprocessing.get_context("spawn").Process(target=_store, args=(make, folder))
    maker.start()
    maker.join()
    if maker.exitcode:
        raise SystemExit("no sound files to begin with")
    return pickle.loads((folder / "corpus").read_bytes())


def _store(make: Callable[[Path], object], folder: Path) -> None:
    (folder / "corpus").write_bytes(pickle.dumps(make(folder)))


def load_commands() -> None:
    """Load what the commands load, compiled code included, and end `view` and `render` where they would go on."""
    import garage2usd
    import garage2usd.checks
    import garage2usd.cli
    import garage2usd.pipeline
    import garage2usd.render
    from garage2usd.common.errors import RenderError
    from garage2usd.driving import prove_stalls
    from garage2usd.render import drawing
    from garage2usd.view import viewer

    garage = garage2usd.generate(garage2usd.GarageConfig(site={"width_cells": 4, "height_cells": 5}))
    prove_stalls(garage.layout)
    show = viewer.ViewerServer.show

    def show_and_end(server: viewer.ViewerServer, *shown: object) -> None:
        show(server, *shown)
        raise KeyboardInterrupt

    def run_blender(*_arguments: object) -> None:
        raise RenderError(0, "it is not run here")

    viewer.ViewerServer.show = show_and_end
    drawing.run_blender = run_blender
    garage2usd.render.require = lambda *_arguments, **_named: None


def fuzz(count: int, seed: int, folder: Path, *, first: int = 0, say: bool = False) -> Fuzz:
    """Run so many cases; the folder keeps what was wrong."""
    corpus = made_apart(make_corpus, folder)
    runner = Fuzz(partial(draw_case, corpus, seed), folder)
    load_commands()
    for number in range(first, first + count):
        runner.run(number)
        if say and (number + 1) % 500 == 0:
            print(f"{number + 1}: {len(runner.failures)} wrong, slowest {runner.slowest[0]:.1f} s", flush=True)
    return runner


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--count", type=int, default=10_000)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--first", type=int, default=0)
    options = parser.parse_args()
    folder = Path(tempfile.mkdtemp(prefix="garage2usd-fuzz-"))
    return told(fuzz(options.count, options.seed, folder, first=options.first, say=True))


def told(runner: Fuzz) -> int:
    """Print what was wrong, and return the exit code."""
    for failure in runner.failures:
        print(failure)
    print(dict(runner.outcomes.most_common()))
    print(
        f"{sum(runner.kinds.values())} inputs of {len(runner.kinds)} kinds, {len(runner.failures)} wrong, "
        f"slowest {runner.slowest[0]:.1f} s (number {runner.slowest[1]})"
    )
    if not runner.failures:
        shutil.rmtree(runner.folder)
        return 0
    print(f"kept in {runner.folder}")
    return 1


if __name__ == "__main__":
    sys.exit(main())
