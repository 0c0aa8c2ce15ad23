"""Commands as on Windows and macOS: the real ones, less what these systems lack (`support.another_system`)."""

import ast
import os
import re
import subprocess
import sys

import pytest
from click.testing import CliRunner
from support.hatch_building import LIBRARY, TARGETS, asked_target
from support.sample_files import REPOSITORY
from support.soak import soak_but

from garage2usd import native
from garage2usd.cli import main
from garage2usd.common.errors import ConfigError
from garage2usd.common.output import check_file, check_name

PACKAGE = REPOSITORY / "garage2usd"
OTHERS = ("win32", "darwin")
PLAN = ".....\nE===X\n.....\n"
RECIPE = """
name = "two"
count = 2
[garage.site]
width_cells = 4
height_cells = 4
[garage.plan]
episodes = 60
[make]
exports = ["xodr"]
"""


@pytest.fixture(params=soak_but(1, OTHERS))
def system(request):
    return request.param


def run_as_on(system, folder, *arguments):
    """Run a command of garage2usd as on another system, None for this one."""
    modules = os.pathsep.join([str(REPOSITORY / "tests" / "support" / "another_system"), str(REPOSITORY)])
    environment = {**os.environ, "PYTHONPATH": modules}
    if system is not None:
        environment["AS_ON"] = system
    command = [sys.executable, "-m", "garage2usd", *arguments]
    return subprocess.run(command, cwd=folder, env=environment, capture_output=True, text=True, check=False)


def evaluate_as_on(system, folder, code):
    environment = {**os.environ, "AS_ON": system, "TMPDIR": str(folder)}
    environment["PYTHONPATH"] = os.pathsep.join(
        [str(REPOSITORY / "tests" / "support" / "another_system"), str(REPOSITORY)]
    )
    code = f"__name__ = 'garage2usd_of_tests'\n{code}"
    return subprocess.run(
        [sys.executable, "-c", code], cwd=folder, env=environment, capture_output=True, text=True, check=False
    )


@pytest.fixture
def site(tmp_path):
    (tmp_path / "plan.txt").write_text(PLAN)
    (tmp_path / "small.toml").write_text('[site]\nstructure_file = "plan.txt"\n')
    (tmp_path / "two.toml").write_text(RECIPE)
    return tmp_path


@pytest.mark.soak
def test_commands_run_and_make_the_same_garage(system, site):
    made = run_as_on(None, site, "build", "small.toml", "-o", "here/garage.usdz")
    assert made.returncode == 0, made.stderr
    for command in (
        ["build", "small.toml", "-o", "there/garage.usdz"],
        ["build", "small.toml", "-o", "there/garage.usdz"],  # in place of the first
        ["check", "there/garage.usdz"],
        ["drive", "there/garage.usdz", "-o", "drive.json"],
        ["export", "there/garage.usdz", "-o", "there.glb", "-o", "there.xodr"],
        ["plan", "there/garage.usdz", "-o", "plan.png"],
    ):
        done = run_as_on(system, site, *command)
        assert done.returncode == 0, (command, done.stdout, done.stderr)
    for path in (site / "here").iterdir():
        if path.name != "garage_report.json":  # which tells times
            assert (site / "there" / path.name).read_bytes() == path.read_bytes(), path.name
    assert not [path for path in site.rglob("*") if path.name.startswith(".")]


@pytest.mark.soak
def test_the_doctor_tells_of_the_same_garage(site):
    reports = [run_as_on(system, site, "doctor", "--seeds", "1") for system in (None, "win32")]
    for report in reports:
        assert report.returncode == 0, (report.stdout, report.stderr)
        assert "faults  none" in report.stdout
    here, there = (re.search("seed 1  (.* driven)", report.stdout)[1] for report in reports)
    assert here == there


def test_the_doctor_finds_loops_that_cannot_be_loaded(monkeypatch):
    def load():
        raise RuntimeError("loops.so is stale")

    monkeypatch.setattr("garage2usd.native.load", load)
    run = CliRunner().invoke(main, ["doctor"])
    assert run.exit_code == 1
    assert run.output.splitlines()[-1].endswith("faults  loops: loops.so is stale")


@pytest.mark.soak
def test_a_data_set_is_made_and_verified(system, site):
    done = run_as_on(system, site, "dataset", "two.toml", "-o", "two", "--workers", "1")
    assert done.returncode == 0, done.stderr
    verified = run_as_on(system, site, "dataset", "--verify", "two", "--workers", "1")
    assert verified.returncode == 0, (verified.stdout, verified.stderr)


@pytest.mark.parametrize("code", [
    "import resource", "import fcntl", "import os; os.fork", "import os; os.sched_getaffinity",
    "import signal; signal.SIGBUS", "import signal; signal.SIGKILL", "import os; os.symlink('a', 'b')",
    "from subprocess import Popen; Popen(['true'], pass_fds=[1])",
    "import os; file = open('a', 'w'); os.unlink('a')", "import os; open('b', 'w').close(); os.rename('b', 'b')",
])  # fmt: skip
def test_what_windows_lacks_is_not_there(code, tmp_path):
    assert evaluate_as_on("win32", tmp_path, code).returncode != 0


def test_a_stage_that_another_program_holds_open_is_tried_again(tmp_path):
    code = """
import threading
from pathlib import Path
from garage2usd.common.output import publish_at
Path("new").write_text("new")
Path("old").write_text("old")
{hold}
publish_at({{Path("new"): Path("old")}})
"""
    held = "file = open('old')"
    closed = evaluate_as_on("win32", tmp_path, code.format(hold=f"{held}; threading.Timer(0.4, file.close).start()"))
    assert closed.returncode == 0, closed.stderr
    assert (tmp_path / "old").read_text() == "new"
    kept = evaluate_as_on("win32", tmp_path, code.format(hold=held))
    assert "close the program that has it open" in kept.stderr
    assert (tmp_path / "old").read_text() == "old"
    assert {path.name for path in tmp_path.iterdir()} == {"new", "old"}


def test_no_file_is_replaced_where_another_program_holds_one_of_them(tmp_path):
    code = """
import atexit, os
from pathlib import Path
from garage2usd.common.output import publish_at
new = Path("new"); new.mkdir(); out = Path("out"); out.mkdir()
for folder, text in ((new, "new"), (out, "old")):
    for name in ("labels.json", "report.json", "stage.usdz"):
        (folder / name).write_text(text)
    (folder / "assets").mkdir()
    (folder / "assets" / text).write_text(text)
(out / "labels.json").unlink()
held = open(out / "stage.usdz")
names = ("assets", "labels.json", "report.json", "stage.usdz")
publish_at({new / name: out / name for name in names})
"""
    run = evaluate_as_on("win32", tmp_path, code)
    assert run.returncode == 1
    assert "out/stage.usdz: The process cannot access the file; close the program" in run.stderr
    files = [path for path in (tmp_path / "out").rglob("*") if path.is_file()]
    assert {path.relative_to(tmp_path / "out").as_posix() for path in files} == {
        "assets/old",
        "report.json",
        "stage.usdz",
    }
    assert {path.read_text() for path in files} == {"old"}


@pytest.mark.parametrize(
    "name", ["con.usdz", "NUL", "com1.usda", "a:b.usdz", 'a"b.usdz', "a?.usdz", "garage.usdz.", "garage "]
)
def test_names_that_windows_refuses_are_refused_there_alone(name, tmp_path, monkeypatch):
    check_name(tmp_path / name)
    monkeypatch.setattr("garage2usd.common.system.sys.platform", "win32")
    with pytest.raises(ConfigError, match="a file name that Windows takes"):
        check_name(tmp_path / name)
    check_name(tmp_path / "console.usdz")


def test_long_paths_are_refused_where_there_is_a_limit(tmp_path, monkeypatch):
    place = tmp_path / ("a" * 200) / "garage.usdz"
    check_file(place)
    monkeypatch.setattr("garage2usd.common.output.LONGEST_PATH", 200)
    with pytest.raises(ConfigError, match="a path of at most 200 characters"):
        check_file(place)


def test_a_wheel_is_made_for_a_target_that_there_is(monkeypatch):
    assert LIBRARY == native.LIBRARY
    for name, target in TARGETS.items():
        monkeypatch.setenv("GARAGE2USD_TARGET", name)
        assert asked_target() is target
    assert {target.suffix for target in TARGETS.values()} == {".so", ".dylib", ".dll"}
    monkeypatch.setenv("GARAGE2USD_TARGET", "amiga")
    with pytest.raises(SystemExit, match="GARAGE2USD_TARGET: got 'amiga'; allowed: linux-x86_64, linux-aarch64, macos"):
        asked_target()


def text_writers(tree):
    """Calls that write text: `write_text`, and `open` with a mode of text that writes."""
    for call in ast.walk(tree):
        if isinstance(call, ast.Call):
            name = call.func.attr if isinstance(call.func, ast.Attribute) else getattr(call.func, "id", None)
            modes = [word.value for word in [*call.args, *(each.value for each in call.keywords if each.arg == "mode")]
                     if isinstance(word, ast.Constant) and isinstance(word.value, str)]  # fmt: skip
            writes = any(set(mode) <= set("rwaxt+") and set(mode) & set("wax+") for mode in modes)
            is_of_other = getattr(getattr(call.func, "value", None), "id", None) in {"tarfile", "av"}
            if name == "write_text" or (name in {"open", "fdopen"} and writes and not is_of_other):
                yield call


def test_files_of_text_have_one_kind_of_newline_and_an_encoding():
    found = 0
    for path in PACKAGE.rglob("*.py"):
        if "web" in path.relative_to(PACKAGE).parts:
            continue
        for call in text_writers(ast.parse(path.read_text(encoding="utf-8"))):
            found += 1
            named = {each.arg for each in call.keywords}
            if (
                not {"newline", "encoding"} <= named and path.name != "process.py"
            ):  # where the system's newline is right
                pytest.fail(f"{path.relative_to(REPOSITORY)}:{call.lineno} writes text without newline and encoding")
    assert found > 15


def test_systems_are_told_apart_in_one_module():
    allowed = {"system.py", "blender.py", "carla_fbx.py"}  # the last two run in Blender, and find no module beside them
    asked = re.compile(
        r"\bsys\.platform\b|\bos\.name\b|^\s*(import|from) (resource|fcntl|msvcrt|platform)\b", re.MULTILINE
    )
    for path in PACKAGE.rglob("*.py"):
        found = asked.search(path.read_text(encoding="utf-8"))
        assert found is None or path.name in allowed, (path, found[0])
