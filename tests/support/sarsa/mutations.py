"""Plant faults in the C text of Sarsa and see its property find them.

``python -m support.sarsa.mutations [--only NAME]`` in ``tests``. Each fault of ``mutants.py`` is planted alone in a
copy of its C files, whose library then runs on the random sites of the property. Ends with 1 if a fault survives.
"""

import argparse
import multiprocessing
import shutil
import sys
import tempfile
import time
from pathlib import Path

from garage2usd.native import LIBRARY, using
from support.hatch_building import compile_loops
from support.sarsa.following import Case, Course, cases_of, check_states, compare, course_of
from support.sarsa.mutants import MUTANTS, Mutant

EXAMPLES = 200
FILES = (
    "arrays.h",
    "elementary.h",
    "planning.h",
    "archive.c",
    "board.c",
    "digest.c",
    "elementary.c",
    "sarsa.c",
    "survey.c",
)
"""What Sarsa over squares is made of."""
FORK = multiprocessing.get_context("fork")


def library_of(folder: Path, mutant: Mutant | None = None) -> Path:
    """A library with the fault in it, or with none, compiled in a new folder."""
    folder.mkdir()
    for name in FILES:
        shutil.copy(LIBRARY.with_name(name), folder)
    if mutant:
        file = folder / f"{mutant.file}.c"
        text = file.read_text(encoding="utf-8")
        assert text.count(mutant.old) == 1, f"{mutant.name}: its text is {text.count(mutant.old)} times in {file.name}"
        file.write_text(text.replace(mutant.old, mutant.new), encoding="utf-8")
    compile_loops(folder / LIBRARY.name, folder, ("-O0", "-w"))
    return folder / LIBRARY.name


def failure_of(library: Path, examples: list[tuple[Case, Course]]) -> str | None:
    """How the property fails of a library on some cases; None if it holds."""
    try:
        with using(library):
            for case, course in examples:
                compare(case, course)
            # most faults are found before, and this takes as long as many cases
            check_states()
    except Exception as failure:
        return type(failure).__name__
    return None


def failure_apart(library: Path, examples: list[tuple[Case, Course]]) -> str | None:
    """`failure_of` in a process of its own, as a fault may write where it must not."""
    receiver, sender = FORK.Pipe(duplex=False)
    child = FORK.Process(target=lambda: sender.send(failure_of(library, examples)))
    child.start()
    sender.close()
    try:
        failure = receiver.recv()
    except EOFError:
        failure = "a crash"
    child.join()
    return failure


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--only", metavar="NAME", help="plant the faults alone whose names hold this")
    only = parser.parse_args().only or ""
    chosen = [mutant for mutant in MUTANTS if only in mutant.name]
    survivors = 0
    # what the reference does is the same whatever the fault
    examples = [(case, course_of(case)) for case in cases_of(EXAMPLES)]
    with tempfile.TemporaryDirectory() as folder:
        control = failure_apart(library_of(Path(folder, "control")), examples)
        assert control is None, f"the property fails of Sarsa as it is: {control}"
        for number, mutant in enumerate(chosen):
            start = time.perf_counter()
            failure = failure_apart(library_of(Path(folder, str(number)), mutant), examples)
            survivors += failure is None
            verdict = f"caught ({failure})" if failure else "SURVIVED"
            print(f"{mutant.name}: {verdict}, {time.perf_counter() - start:.1f} s", flush=True)
    print(f"{len(chosen) - survivors} of {len(chosen)} caught")
    sys.exit(survivors > 0)


if __name__ == "__main__":
    main()
