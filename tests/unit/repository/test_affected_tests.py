"""`make check` finds the tests that a change can affect, and tells what it leaves out."""

import os
import subprocess
import sys

import pytest
from support import affected_tests
from support.affected_tests import ROOT, affected, changed_since, chosen, files_of_tests, main
from support.soak import soak_but

# those that use several rooms, in a second
WATCHED = [
    "tests/unit/checks/test_drive_of_a_file.py",
    "tests/unit/maps/test_heights.py",
    "tests/unit/planning/test_score.py",
    "tests/unit/scenes/test_looks.py",
]
WATCH = """
import sys
import pytest
called = set()
def note(frame, event, _):
    if event == "call" and frame.f_code.co_name != "<module>":
        called.add(frame.f_code.co_filename)
@pytest.hookimpl(wrapper=True)
def pytest_runtest_protocol():
    sys.setprofile(note)
    try:
        return (yield)
    finally:
        sys.setprofile(None)
def pytest_unconfigure():
    print("called", *called, sep="\\n")
"""


@pytest.mark.parametrize("file", soak_but(["tests/unit/planning/test_score.py"], WATCHED))
def test_no_module_whose_functions_a_test_file_calls_changes_without_it(file, tmp_path):
    (tmp_path / "watch.py").write_text(WATCH)
    command = [sys.executable, "-m", "pytest", "-q", "-p", "watch", "-p", "no:cacheprovider", file]
    environment = {key: value for key, value in os.environ.items() if not key.startswith("PYTEST_")}
    environment["PYTHONPATH"] = str(tmp_path)
    ran = subprocess.run(command, cwd=ROOT, env=environment, check=False, capture_output=True, text=True, timeout=300)
    assert ran.returncode == 0, ran.stdout
    package = f"{ROOT / 'garage2usd'}/"
    called = [line.removeprefix(f"{ROOT}/") for line in ran.stdout.splitlines() if line.startswith(package)]
    # only conftest.py calls the one, for all; which names the __init__ of a package hands on is seen by its users
    called = [
        source for source in called if not source.endswith("/__init__.py") and source != "garage2usd/common/limits.py"
    ]
    assert len(called) >= 3
    assert [source for source in called if file not in affected([source])] == []


@pytest.mark.parametrize(
    ("changed", "nearest"),
    [
        ("garage2usd/checks/safety.py", {"tests/unit/checks/test_egress.py"}),
        ("garage2usd/objects/zone_plate.py", {"tests/unit/layout/test_zones.py", "tests/unit/objects/test_objects.py"}),
        ("garage2usd/maps/opendrive.py", {"tests/clients/test_opendrive.py"}),
        ("garage2usd/profiles/de-garvo.toml", {"tests/unit/profiles/test_profiles.py"}),
        ("garage2usd/native/board.c", {"tests/unit/native/test_native.py"}),
        ("garage2usd/stage/meshes.npz", {"tests/unit/assets/test_baked_meshes.py"}),
        ("garage2usd/render/blender.py", {"tests/clients/test_render.py"}),
        ("garage2usd/cli/view.py", {"tests/unit/view/test_viewer_server.py", "tests/clients/test_viewer.py"}),
        ("garage2usd/view/web/src/levels.ts", {"tests/clients/test_viewer_page.py"}),
        ("garage2usd/view/page/viewer.js", {"tests/clients/test_viewer_page.py"}),
        ("unity_importer/Editor/StageReader.cs", {"tests/unity/test_package.py", "tests/unity/test_prefabs.py"}),
        ("docs/viewer.md", {"tests/unit/repository/test_documentation.py"}),
        ("tests/support/pictures.py", {"tests/clients/test_blender.py", "tests/clients/test_threejs.py"}),
        ("tests/clients/blender_dump.py", {"tests/clients/test_blender.py"}),
        ("tests/unit/layout/test_zones.py", {"tests/unit/layout/test_zones.py"}),
    ],
)
def test_the_tests_of_what_changed_are_among_the_nearest(changed, nearest):
    steps = affected([changed])
    assert nearest <= steps.keys()
    assert all(sum(other < steps[file] for other in steps.values()) <= 12 for file in nearest)


def test_all_tests_can_be_affected_by_what_they_all_use_and_none_by_nothing():
    assert affected(["tests/conftest.py"]).keys() == set(files_of_tests())
    assert affected(["pyproject.toml"]).keys() == set(files_of_tests())
    assert affected([]) == {}


def test_a_change_to_one_room_does_not_run_the_tests_of_rooms_beside_it():
    steps = affected(["garage2usd/datasets/difficulty.py"])
    assert "tests/unit/datasets/test_difficulty.py" in steps
    assert len(steps) < len(files_of_tests()) / 3
    assert not [file for file in steps if file.startswith(("tests/unit/planning", "tests/unit/driving"))]


def test_as_many_are_run_as_fit_the_nearest_first_and_none_is_lost():
    steps = {"far": 3, "near": 1, "long": 1, "nearer": 0, "new": 2}
    durations = {"far": 1.0, "near": 2.0, "long": 90.0, "nearer": 4.0}
    assert chosen(steps, durations, 100.0) == (["nearer", "near", "long", "far"], ["new"])
    assert chosen(steps, durations, 20.0) == (["nearer", "near", "new", "far"], ["long"])
    assert chosen(steps, durations, 3.0) == (["near", "far"], ["nearer", "long", "new"])


@pytest.fixture
def repository(tmp_path, monkeypatch):
    def git(*words):
        done = subprocess.run(
            ["git", "-c", "user.name=A", "-c", "user.email=a@example.org", *words],
            cwd=tmp_path, check=True, capture_output=True, text=True,
        )  # fmt: skip
        return done.stdout.strip()

    monkeypatch.setattr(affected_tests, "ROOT", tmp_path)
    git("init", "-q", "-b", "main")
    for name in ("kept.py", "edited.py", "gone.py"):
        (tmp_path / name).write_text("1\n")
    (tmp_path / ".gitignore").write_text("ignored.py\n")
    git("add", "-A")
    git("commit", "-qm", "first")
    return tmp_path, git


def test_what_is_committed_edited_deleted_and_new_since_the_branch_left_is_changed(repository):
    folder, git = repository
    left = git("rev-parse", "HEAD")
    git("checkout", "-qb", "work")
    (folder / "committed \u00fc.py").write_text("2\n")
    git("add", "-A")
    git("commit", "-qm", "second")
    (folder / "edited.py").write_text("3\n")
    (folder / "gone.py").unlink()
    (folder / "new.py").write_text("4\n")
    (folder / "ignored.py").write_text("5\n")
    assert affected_tests.branched_from() == left
    assert changed_since(left) == ["committed \u00fc.py", "edited.py", "gone.py", "new.py"]
    assert changed_since("HEAD") == ["edited.py", "gone.py", "new.py"]


def test_what_is_left_out_is_told(monkeypatch, capsys):
    monkeypatch.setattr(affected_tests, "changed_since", lambda _: ["garage2usd/checks/safety.py"])
    monkeypatch.setattr(affected_tests, "read_durations", lambda: dict.fromkeys(files_of_tests(), 10.0))
    monkeypatch.setattr(sys, "argv", ["affected_tests", "--list", "--seconds", "15", "--base", "HEAD"])
    assert main() == 0
    said = capsys.readouterr().out.splitlines()
    count = len(affected(["garage2usd/checks/safety.py"]))
    room = [file for file in files_of_tests() if file.startswith("tests/unit/checks/")]
    run = f"{len(room)} are run, about {5 * len(room)} s on 2 cores of the {5 * count} s that all of them take"
    assert f"{count} of {len(files_of_tests())} test files can be affected, {run}" in said[0]
    assert said[1].startswith("left to `make test`, the nearest first: ")
    assert said[1].endswith(f"(10 s), and {count - len(room) - 12} more")
    assert sorted(said[2:]) == room
    assert said[2] == "tests/unit/checks/test_egress.py"


def test_the_tests_of_a_changed_room_are_all_run():
    assert affected_tests.rooms_of(["garage2usd/checks/safety.py", "docs/check.md"]) == {"tests/unit/checks"}
    steps = {"tests/unit/checks/far.py": 9, "tests/unit/maps/near.py": 0, "tests/unit/maps/nearer.py": 0}
    run, left = chosen(steps, dict.fromkeys(steps, 10.0), 15.0, rooms={"tests/unit/checks"})
    assert (run, left) == (["tests/unit/checks/far.py"], ["tests/unit/maps/near.py", "tests/unit/maps/nearer.py"])
