"""Compare what the C# readers make of every stage of a folder with what ``pxr`` makes of it.

``python -m support.unity.foreign_stages FOLDER [--list]`` in ``tests``: how many stages ``pxr`` opens, how many of
these are equal to the last value, how many differ and name what was skipped, and how many differ in silence. The exit
status is 1 where a stage is refused or differs in silence, or where fewer than 97 % are equal.
"""

import argparse
import os
import sys
import tempfile
from collections import Counter
from multiprocessing import Pipe, get_context
from multiprocessing.connection import Connection
from pathlib import Path

from pxr import Tf, Usd

from support.unity import reader, stages_of_pxr, values_of_pxr

ENDINGS = {".usd", ".usda", ".usdc", ".usdz"}
LEAST_EQUAL = 0.97
PXR_LIMIT_S = 120
MOST_LINES = 20
POINTER = b"version https://git-lfs"
ABSENT = ("does not exist", "is not in the package")
"""What a warning ends with that ``pxr`` shares, as neither has the file: it is no reason to differ."""


def serve(asked: Connection) -> None:
    """Answer each path with what ``pxr`` says of the stage, or with why it does not open it."""
    os.dup2(os.open(os.devnull, os.O_WRONLY), 2)  # what pxr warns of is in what it composes
    while True:
        try:
            asked.send(stages_of_pxr.stage_dump(Usd.Stage.Open(asked.recv())))
        except (Tf.ErrorException, MemoryError, RuntimeError) as failure:
            asked.send(f"{type(failure).__name__}: {failure}")


class Pxr:
    """``pxr`` in a process of its own, as some of the files that others test with end it or keep it for ever."""

    def __init__(self) -> None:
        self.process = None

    def ask(self, path: Path) -> dict | str:
        if self.process is None:
            self.asked, theirs = Pipe()
            self.process = get_context("spawn").Process(target=serve, args=(theirs,), daemon=True)
            self.process.start()
            theirs.close()
        self.asked.send(str(path))
        try:
            if self.asked.poll(PXR_LIMIT_S):
                return self.asked.recv()
            failure = f"pxr takes more than {PXR_LIMIT_S} s"
        except EOFError:
            failure = "pxr dies of it"
        self.process.kill()
        self.process = None
        return failure


def verdict(wanted: dict, found: dict) -> tuple[str, list[str]]:
    """``equal``, ``refused``, ``named`` or ``silent``, and lines that say why."""
    if "refused" in found:
        return "refused", [": ".join(found["refused"])]
    warnings = found.pop("warnings")
    stages_of_pxr.numbered_alike(wanted, found)
    lines = stages_of_pxr.misplaced(wanted, found) + values_of_pxr.differences(wanted, found)
    if not lines:
        return "equal", warnings
    skipped = [warning for warning in warnings if not warning.endswith(ABSENT)]
    return ("named" if skipped else "silent"), [*warnings, *lines]


def compared(folder: Path, *, lists_equal: bool) -> Counter:
    """How many stages of the folder end in which way; prints all but the equal ones, and these too if asked."""
    counts = Counter()
    pxr = Pxr()
    with tempfile.TemporaryDirectory() as scratch:
        usd_dump = reader.Reader(reader.compile_program(Path(scratch)))
        for path in sorted(path for path in folder.rglob("*") if path.suffix.lower() in ENDINGS and path.is_file()):
            if path.read_bytes().startswith(POINTER):
                counts["pointer"] += 1
                continue
            wanted = pxr.ask(path)
            if isinstance(wanted, str):
                kind, lines = "unread", [" ".join(wanted.split())[:300]]
            else:
                kind, lines = verdict(wanted, usd_dump.ask("stage", path, folder))
            counts[kind] += 1
            if kind != "equal" or (lists_equal and lines):
                print(f"{kind} {path.relative_to(folder)}", *lines[:MOST_LINES], sep="\n  ", flush=True)  # noqa: T201
        usd_dump.close()
    return counts


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("folder", type=Path, help="all stages in it and below; it is the root of what they refer to")
    parser.add_argument("--list", action="store_true", help="print the warnings of equal stages too")
    arguments = parser.parse_args()
    counts = compared(arguments.folder.resolve(), lists_equal=arguments.list)
    opened = sum(counts[kind] for kind in ("equal", "named", "silent", "refused"))
    share = counts["equal"] / max(opened, 1)
    print(  # noqa: T201
        f"{counts.total()} stages, {counts['pointer']} of them pointers without the file; pxr opens {opened}: "
        f"{counts['equal']} equal ({share:.1%}), {counts['named']} that name what they skipped, "
        f"{counts['silent']} different in silence, {counts['refused']} refused"
    )
    return 0 if share >= LEAST_EQUAL and not counts["silent"] and not counts["refused"] else 1


if __name__ == "__main__":
    sys.exit(main())
