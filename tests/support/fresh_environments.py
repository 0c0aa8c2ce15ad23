"""Environments that are made anew, of the Pythons that a machine has and of versions that `pyproject.toml` allows."""

import os
import re
import subprocess
import sys
import tomllib
from pathlib import Path

import pytest
from uv import find_uv_bin

from support.sample_files import REPOSITORY

PROJECT = tomllib.loads((REPOSITORY / "pyproject.toml").read_text())["project"]
NAMED = re.findall(r"^Programming Language :: Python :: (3\.\d+)$", "\n".join(PROJECT["classifiers"]), re.MULTILINE)
EXTRAS = ("dataset", "gymnasium", "maps", "sensors")
"""All that any of the Pythons can have; Blender is for one alone."""
WITHOUT_WHEELS = {("3.14", "maps")}
"""What a Python must compile for an extra: pyclothoids, of scenariogeneration."""
UNREACHABLE = ("error sending request", "dns error")


def uv(*arguments):
    run = subprocess.run(
        [find_uv_bin(), "--quiet", "--no-python-downloads", *map(str, arguments)],
        capture_output=True,
        text=True,
        check=False,
    )
    if any(said in run.stderr for said in UNREACHABLE):
        pytest.skip(f"the package index cannot be reached: {run.stderr.strip().splitlines()[-1]}")
    assert run.returncode == 0, run.stderr
    return run.stdout


def pythons():
    """The Pythons of this machine that the project names, by version; of the tests' own version the one they run on."""
    found = {}
    candidates = [Path(folder) / f"python{version}" for version in NAMED for folder in os.get_exec_path()]
    installed = Path(os.environ.get("PYENV_ROOT", Path.home() / ".pyenv")) / "versions"
    candidates += sorted(installed.glob("3.*/bin/python3"), reverse=True)
    for candidate in [Path(sys.executable), *candidates]:
        asked = [candidate, "-c", "import sys; print('%d.%d' % sys.version_info[:2])"]
        try:
            version = subprocess.run(asked, capture_output=True, text=True, check=False, timeout=60).stdout.strip()
        except OSError:
            continue
        if version in NAMED:
            found.setdefault(version, candidate)
    return found


def make_environment(folder, python, resolution, wheel):
    """An environment with a wheel, whose dependencies have the lowest or the newest versions that are allowed."""
    uv("venv", "--python", python, folder)
    place = ["--python", folder / "bin" / "python", "--resolution", resolution]
    uv("pip", "install", *place, "--requirements", REPOSITORY / "pyproject.toml", *_options(EXTRAS), wheel)
    return folder


def compiled(version, resolution, extras, *options):
    """The distributions that a Python gets, on a Linux of 2018 or later, as lines of requirements."""
    place = ["--python-version", version, "--python-platform", "x86_64-manylinux_2_28", "--resolution", resolution]
    shown = ["--no-header", "--no-annotate"]
    return uv("pip", "compile", *place, *shown, *_options(extras), *options, REPOSITORY / "pyproject.toml").split()


def _options(extras):
    return [word for extra in extras for word in ("--extra", extra)]
