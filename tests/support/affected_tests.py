"""The test files that a change can affect: those of its rooms, then the nearest others, as many as fit into a time.

``python -m support.affected_tests`` runs them by pytest. A test file is as near to a changed file as the shortest way
from file to file that uses it: by imports, which grimp knows of the package; by starting one of its commands; and, for
what is not imported, by naming it: who says ``"blender.py"`` uses that file, who says ``"docs"`` any in there.
"""

import argparse
import ast
import re
import subprocess
import sys
from functools import cache
from pathlib import Path

import grimp
import networkx as nx

from support.durations import UNKNOWN_S, read_durations

ROOT = Path(__file__).parents[2]

_CORES = 2
_WORKERS_FROM_S = 10.0  # for less, it takes longer to start them than they save
_OF_THE_ROOM = 99  # steps to a test that uses nothing of what changed
_TOLD = 12  # of those that are left
_PACKAGE = "garage2usd"
_CHANGED = "changed"
_EVERYWHERE = {"pyproject.toml", "environment.sh", "tests/conftest.py"}
_ANY_MODULE_OF = re.compile(rf"f\"({_PACKAGE}\.[\w.]+)\.\{{")  # import_module(f"garage2usd.maps.{module}")
_ALL_BESIDE = "iter_modules(__path__"  # a package that loads whatever module it has


def main():
    """Run the tests that changes can affect; the exit code is that of pytest."""
    parser = argparse.ArgumentParser(description=main.__doc__)
    parser.add_argument("--base", help="the commit to compare with; by default where the branch left its upstream")
    parser.add_argument("--seconds", type=float, default=75.0, help="how long the tests may take on two cores")
    parser.add_argument("--list", action="store_true", help="only say which")
    arguments = parser.parse_args()
    base = arguments.base or branched_from()
    changed = changed_since(base)
    steps, durations, everything = affected(changed), read_durations(), files_of_tests()
    run, left = chosen(steps, durations, _CORES * arguments.seconds, rooms=rooms_of(changed))
    time_s, all_s = (sum(_duration(durations, file) for file in files) / _CORES for files in (run, steps))
    say = sys.stdout.write
    say(
        f"{len(changed)} files differ from {base[:12]}: {len(steps)} of {len(everything)} test files can be affected,"
        f" {len(run)} are run, about {time_s:.0f} s on {_CORES} cores of the {all_s:.0f} s that all of them take\n"
    )
    if left:
        told = [f"{file.removeprefix('tests/')} ({_duration(durations, file):.0f} s)" for file in left[:_TOLD]]
        if more := len(left) - len(told):
            told.append(f"and {more} more")
        say(f"left to `make test`, the nearest first: {', '.join(told)}\n")
    if arguments.list:
        say("".join(f"{file}\n" for file in run))
    sys.stdout.flush()
    if arguments.list or not run:
        return 0
    workers = ["-n", "auto", "--dist", "worksteal"] if time_s > _WORKERS_FROM_S else []
    command = [sys.executable, "-m", "pytest", "-q", *workers, *run]
    return subprocess.run(command, cwd=ROOT, check=False).returncode


def branched_from():
    """The commit where the branch left its upstream, else ``main``; HEAD where there is neither."""
    for other in ("@{upstream}", "origin/main", "main"):
        found = _git("merge-base", "HEAD", other, check=False).strip()
        if found:
            return found
    return _git("rev-parse", "HEAD").strip()


def changed_since(base):
    """Files of the working tree that differ from a commit, and those that git does not know yet."""
    differ = _git("diff", "--name-only", "--no-renames", "-z", base)
    unknown = _git("ls-files", "--others", "--exclude-standard", "-z")
    return sorted(set(filter(None, (differ + unknown).split("\0"))))


def files_of_tests():
    """All, relative to the repository."""
    return sorted(file for file in _texts() if file.startswith("tests/") and Path(file).name.startswith("test_"))


def affected(changed):
    """Steps from the changed files to each test file that they can affect, or that is of their rooms."""
    if _EVERYWHERE & set(changed):
        return dict.fromkeys(files_of_tests(), 1)
    uses = _uses().copy()
    for file in changed:
        uses.add_edge(_CHANGED, file, weight=0)
        uses.add_weighted_edges_from((file, user, steps) for user, steps in _named_by(file).items())
    steps = nx.single_source_dijkstra_path_length(uses, _CHANGED) if changed else {}
    rooms = rooms_of(changed)
    beside = {file for file in files_of_tests() if Path(file).parent.as_posix() in rooms}
    return {file: steps.get(file, _OF_THE_ROOM) for file in files_of_tests() if file in steps or file in beside}


def rooms_of(changed):
    """Folders of unit tests whose rooms hold a changed file of the package."""
    parts = [Path(file).parts for file in changed]
    rooms = {Path(part[1]).stem for part in parts if len(part) > 1 and part[0] == _PACKAGE}
    return {f"tests/unit/{room}" for room in rooms}


def chosen(steps, durations, seconds, *, rooms=frozenset()):
    """Test files that are run and those that are left: all of the rooms, then the nearest and shortest that fit."""
    run, left = [], []
    beside = {file: Path(file).parent.as_posix() not in rooms for file in steps}
    for file in sorted(steps, key=lambda file: (beside[file], steps[file], _duration(durations, file), file)):
        fits = not beside[file] or _duration(durations, file) <= seconds
        (run if fits else left).append(file)
        seconds -= fits * _duration(durations, file)
    return run, left


@cache
def _uses():
    """Python files of package and tests, with an edge from each to all that use it."""
    graph = grimp.build_graph(_PACKAGE, cache_dir=None)
    file_of = {module: _file_of(module) for module in graph.modules}
    uses = nx.DiGraph()
    for module, file in file_of.items():
        uses.add_edges_from((file, file_of[user]) for user in graph.find_modules_that_directly_import(module))
        packages = _ANY_MODULE_OF.findall(_texts()[file])
        if _ALL_BESIDE in _texts()[file]:
            packages.append(module)
        uses.add_edges_from((file_of[child], file) for package in packages for child in graph.find_children(package))
    helpers = {_test_module(file): file for file in _texts() if file.startswith("tests/")}
    modules = file_of | helpers
    fixtures = {part.name for part in _tree("tests/conftest.py").body if isinstance(part, ast.FunctionDef)}
    for file in helpers.values():
        tree = _tree(file)
        commands = (f"{_PACKAGE}.cli.{command}" for command in _started(tree))
        used = {modules[name] for name in _imported(tree) if name in modules}
        used |= {file_of.get(command, file_of[f"{_PACKAGE}.cli"]) for command in commands}
        if fixtures & {part.arg for part in ast.walk(tree) if isinstance(part, ast.arg)}:
            used.add("tests/conftest.py")
        uses.add_edges_from((one, file) for one in used)
    return uses


def _named_by(file):
    """Steps from a file to those that name it or folders that it is in: more where they name fewer of these."""
    path = Path(file)
    names = [f'"{name}"' for name in path.parts[path.parts[0] in {_PACKAGE, "tests"} :]]
    is_data = path.suffix != ".py"
    names = names if is_data else names[-1:]
    count = {user: sum(name in text for name in names) for user, text in _texts().items()}
    most = max(count.values())
    steps = {user: 1 + most - found for user, found in count.items() if found}
    if is_data and path.parts[0] == _PACKAGE:
        steps |= {user: 1 for user in count if Path(user).parent == path.parent}
    return steps


@cache
def _texts():
    """What stands in each Python file of package and tests."""
    places = [f"{folder}/*.py" for folder in (_PACKAGE, "tests")]
    files = _git("ls-files", "-z", "--cached", "--others", "--exclude-standard", "--", *places).split("\0")
    return {file: (ROOT / file).read_text() for file in files if file and (ROOT / file).exists()}


def _imported(tree):
    """Names that may be modules, of imports wherever they stand."""
    for part in ast.walk(tree):
        if isinstance(part, ast.Import):
            yield from (name.name for name in part.names)
        elif isinstance(part, ast.ImportFrom) and part.module:
            yield part.module
            yield from (f"{part.module}.{name.name}" for name in part.names)


def _started(tree):
    """Commands of the package that are started; an empty one where that is not written out."""
    for part in ast.walk(tree):
        words = part.elts if isinstance(part, ast.List | ast.Tuple) else part.args if isinstance(part, ast.Call) else []
        values = [word.value if isinstance(word, ast.Constant) else "" for word in words] + [""]
        yield from (values[k + 1] for k, value in enumerate(values) if value == _PACKAGE)


def _tree(file):
    return ast.parse(_texts()[file])


def _file_of(module):
    path = Path(*module.split("."))
    return (path / "__init__.py" if (ROOT / path).is_dir() else path.with_suffix(".py")).as_posix()


def _test_module(file):
    """The name by which tests import a file."""
    return ".".join(Path(file).with_suffix("").parts[1:]).removesuffix(".__init__")


def _duration(durations, file):
    return durations.get(file, UNKNOWN_S)


def _git(*words, check=True):
    return subprocess.run(["git", *words], cwd=ROOT, check=check, capture_output=True, text=True).stdout


if __name__ == "__main__":
    sys.exit(main())
