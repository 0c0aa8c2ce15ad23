"""The wheel brings up all of garage2usd where there is no checkout, and with it the README can be followed."""

import os
import subprocess
import sys
import zipfile
from pathlib import Path

import pytest
from support.sample_files import REPOSITORY

DATA_FILES = (
    "datasets/*.jinja",
    "datasets/*.json",
    "assets/*.toml",
    "assets/fonts/*",
    "datasets/*.toml",
    "native/*.[ch]",
    "native/loops.so",
    "look/*.toml",
    "maps/*.md",
    "objects/*.toml",
    "survey/*.toml",
    "config/*.toml",
    "config/markets/*.toml",
    "config/starting_points/*.toml",
    "profiles/*.toml",
    "profiles/countries.json",
    "render/*.osl",
    "sensors/formats/*.toml",
    "sensors/rays/*.toml",
    "sensors/rigs/*.toml",
    "stage/*.npz",
    "view/page/*",
)


# no file, which each worker of a data set would load again
FOLLOW_THE_README = """
import sys
from pathlib import Path
sys.path.append(sys.argv[1])
import documentation
documentation.follow_page(documentation.README, Path.cwd())
print(Path(documentation.garage2usd.__file__).parent)
"""


def pip(*arguments):
    run = subprocess.run(
        [sys.executable, "-m", "pip", "--disable-pip-version-check", "--quiet", *arguments],
        capture_output=True,
        text=True,
        check=False,
    )
    assert run.returncode == 0, run.stderr


@pytest.fixture(scope="module")
def wheel(tmp_path_factory):
    folder = tmp_path_factory.mktemp("wheel")
    pip("wheel", REPOSITORY, "--no-deps", "--no-build-isolation", "--wheel-dir", folder)
    (file,) = folder.glob("garage2usd-*-py3-none-linux_*.whl")
    return file


@pytest.fixture(scope="module")
def installed(wheel, tmp_path_factory):
    """Run something from another folder with the wheel's garage2usd before any other."""
    packages = tmp_path_factory.mktemp("packages")
    pip("install", "--no-deps", "--no-index", "--target", packages, wheel)
    environment = {**os.environ, "PYTHONPATH": str(packages)}

    def run(*command, folder):
        program = str(packages / "bin" / "garage2usd") if command[0] == "garage2usd" else command[0]
        return subprocess.run(
            [program, *command[1:]], cwd=folder, env=environment, capture_output=True, text=True, check=False
        )

    run.packages = packages
    return run


def test_the_wheel_holds_what_runs_and_nothing_else(wheel):
    names = zipfile.ZipFile(wheel).namelist()
    assert {name.split("/")[0].partition("-")[0] for name in names} == {"garage2usd"}
    held = {name.partition("/")[2] for name in names if name.startswith("garage2usd/")}

    package, textures = REPOSITORY / "garage2usd", REPOSITORY / "textures"
    code = {path.relative_to(package) for path in package.rglob("*.py") if "web" not in path.parts}
    pictures = {Path("textures") / path.relative_to(textures) for path in textures.rglob("*") if path.is_file()}
    data = {path.relative_to(package) for part in DATA_FILES for path in package.glob(part)}
    assert len(pictures) > 10
    expected = (
        "assets/fonts/DejaVuSansCondensed.LICENSE.txt",
        "config/markets/world.toml",
        "datasets/card.md.jinja",
        "datasets/world.toml",
        "native/loops.so",
        "profiles/cn-jgj100.toml",
        "stage/meshes.npz",
        "view/page/index.html",
        "view/page/viewer.js",
    )
    assert set(map(Path, expected)) <= data
    assert held == {path.as_posix() for path in code | pictures | data | {Path("py.typed")}}


def test_commands_run_where_there_is_no_checkout(installed, tmp_path):
    where = installed(sys.executable, "-c", "import garage2usd; print(garage2usd.__file__)", folder=tmp_path)
    assert Path(where.stdout.strip()).is_relative_to(installed.packages)
    plan = tmp_path / "plan.txt"
    plan.write_text(".....\nE===X\n.....\n")
    (tmp_path / "small.toml").write_text('[site]\nstructure_file = "plan.txt"\n')
    for command in (["build", "small.toml"], ["check", "garage.usdz"], ["view", "--help"], ["--version"]):
        run = installed("garage2usd", *command, folder=tmp_path)
        assert run.returncode == 0, run.stderr
        assert run.stdout
    assert (tmp_path / "garage.usdz").stat().st_size > 100_000


@pytest.mark.soak
def test_the_readme_can_be_followed_with_the_wheel_alone(installed, tmp_path):
    run = installed(sys.executable, "-c", FOLLOW_THE_README, REPOSITORY / "tests" / "support", folder=tmp_path)
    assert run.returncode == 0, run.stderr
    assert Path(run.stdout.splitlines()[-1]).is_relative_to(installed.packages)
    assert (tmp_path / "garage.usdz").exists()
    assert (tmp_path / "out" / "hand_drawn.usda").exists()
    assert (tmp_path / "ways.usda").exists()


def test_bash_completes_commands_options_and_values(installed, tmp_path):
    from garage2usd.cli import main

    def completions(*words, begun=""):
        script = f"""
            PATH="{installed.packages}/bin:$PATH"
            eval "$(_GARAGE2USD_COMPLETE=bash_source garage2usd)"
            COMP_WORDS=({" ".join(words)} "{begun}") COMP_CWORD={len(words)}
            _garage2usd_completion garage2usd
            printf '%s\\n' "${{COMPREPLY[@]}}"
        """
        run = installed("bash", "-ec", script, folder=tmp_path)
        assert run.returncode == 0, run.stderr
        return set(run.stdout.split())

    assert completions("garage2usd") == set(main.commands)
    assert completions("garage2usd", "build", begun="--se") == {"--seed"}
    assert completions("garage2usd", "check", "--profile", begun="u") == {"uk-istructe", "us-ada"}
    assert completions("garage2usd", "render", "--only", begun="depth,se") == {
        "depth,semantic",
        "depth,semantic_preview",
    }
