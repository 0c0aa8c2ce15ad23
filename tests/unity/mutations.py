"""Plant faults in the C# sources and see the tests find them: ``python tests/unity/mutations.py [--only NAME]``.

Each fault is planted alone in a copy of the sources; the quick tests run first and stop at their first failure, the
rest only where they pass. Ends with 1 if a fault survives all of them.
"""

import argparse
import os
import re
import shutil
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import reader
from mutants import MUTANTS, Mutant

HERE = Path(__file__).parent
SLOW = "sample or installed_packages"
QUICK_FIRST = (f"not ({SLOW}) and not damaged", f"({SLOW}) or damaged")
"""Selections of tests in the order in which they run."""


def planted(mutant: Mutant, folder: Path) -> Path:
    """The compiled program of a copy of the sources with the fault."""
    package = folder / "unity_importer"
    for part in ("Core", "Tools~"):
        shutil.copytree(reader.PACKAGE / part, package / part)
    source = package / mutant.source
    text = source.read_text()
    assert text.count(mutant.old) == 1, f"{mutant.name}: its text is {text.count(mutant.old)} times in {mutant.source}"
    source.write_text(text.replace(mutant.old, mutant.new))
    return reader.compile_program(folder, package, flags=())


def found_by(program: Path) -> str | None:
    """The first test that fails of the program; None if none does."""
    for selection in QUICK_FIRST:
        command = [
            sys.executable,
            "-m",
            "pytest",
            "-q",
            "-x",
            "--tb=no",
            "-p",
            "no:cacheprovider",
            HERE,
            "-k",
            selection,
        ]
        environment = os.environ | {reader.PROGRAM_VARIABLE: str(program)}
        done = subprocess.run(
            command, check=False, capture_output=True, text=True, env=environment, cwd=HERE.parents[1]
        )
        failed = re.search(r"^(?:FAILED|ERROR) \S*?::(.+?)(?: - .*)?$", done.stdout, re.MULTILINE)
        if failed:
            return failed.group(1)
        assert done.returncode == 0, done.stdout + done.stderr
    return None


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--only", metavar="NAME", help="plant the faults alone whose names hold this")
    only = parser.parse_args().only or ""
    survivors = 0
    chosen = [mutant for mutant in MUTANTS if only in mutant.name]
    for mutant in chosen:
        start = time.perf_counter()
        with tempfile.TemporaryDirectory() as folder:
            test = found_by(planted(mutant, Path(folder)))
        survivors += test is None
        verdict = f"caught by {test}" if test else "SURVIVED"
        print(f"{mutant.name}: {verdict} ({time.perf_counter() - start:.0f} s)", flush=True)  # noqa: T201
    print(f"{len(chosen) - survivors} of {len(chosen)} caught")  # noqa: T201
    sys.exit(survivors > 0)


if __name__ == "__main__":
    main()
