"""Plant faults in the C# sources and see the tests find them: ``python -m support.unity.mutations [--only NAME]`` in
``tests``.

Each fault is planted alone in a copy of the sources; the quick tests run first and stop at their first failure, the
rest only where they pass. Ends with 1 if a fault survives all of them. ``mutants.py`` has the list.
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

from support.unity import reader
from support.unity.mutants import MUTANTS, Mutant

REPOSITORY = Path(__file__).parents[3]
CORE_TESTS = ("test_layers", "test_stages", "test_scenes", "test_scene_parts", "test_fuzz", "test_foreign_stages")
LAYER_TESTS = ("test_handedness", "test_lights", "test_materials", "test_lanes", "test_imports", "test_prefabs")
NOTHING_SELECTED = 5
SLOW = "sample or installed_packages or damaged"


def planted(mutant: Mutant, package: Path) -> None:
    """Write a copy of the package with the fault."""
    hidden = shutil.ignore_patterns("*.meta", "Documentation~", "Samples~")
    shutil.copytree(reader.PACKAGE, package, ignore=hidden)
    source = package / mutant.source
    text = source.read_text()
    assert text.count(mutant.old) == 1, f"{mutant.name}: its text is {text.count(mutant.old)} times in {mutant.source}"
    source.write_text(text.replace(mutant.old, mutant.new))


def found_by(package: Path, tests: tuple[str, ...]) -> str | None:
    """The first test that fails of the package, the quick ones first; None if none does."""
    files = [REPOSITORY / "tests" / "unity" / f"{name}.py" for name in tests]
    for selection in (f"not ({SLOW})", SLOW):
        command = [sys.executable, "-m", "pytest", "-q", "-x", "--tb=no", "-p", "no:cacheprovider", "-k", selection]
        environment = os.environ | {reader.PACKAGE_VARIABLE: str(package)}
        done = subprocess.run(
            [*command, *files], check=False, capture_output=True, text=True, env=environment, cwd=REPOSITORY
        )
        failed = re.search(r"^(?:FAILED|ERROR) \S*?::(.+?)(?: - .*)?$", done.stdout, re.MULTILINE)
        if failed:
            return failed.group(1)
        assert done.returncode in {0, NOTHING_SELECTED}, done.stdout + done.stderr
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
            package = Path(folder) / "unity_importer"
            planted(mutant, package)
            test = found_by(package, CORE_TESTS if mutant.source.startswith("Core/") else LAYER_TESTS)
        survivors += test is None
        verdict = f"caught by {test}" if test else "SURVIVED"
        print(f"{mutant.name}: {verdict} ({time.perf_counter() - start:.0f} s)", flush=True)  # noqa: T201
    print(f"{len(chosen) - survivors} of {len(chosen)} caught")  # noqa: T201
    sys.exit(survivors > 0)


if __name__ == "__main__":
    main()
