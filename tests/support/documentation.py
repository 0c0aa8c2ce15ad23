"""The fenced blocks of a page, and a reader that does what they say, in order and in one folder."""

import contextlib
import functools
import io
import itertools
import os
import re
import shlex
import shutil
import signal
import subprocess
import sys
import tempfile
import tomllib
import urllib.request
from dataclasses import dataclass
from pathlib import Path

import click
import pytest
from click.testing import CliRunner

import garage2usd
from garage2usd.cli import main
from garage2usd.common.settings import validated
from garage2usd.config import config_from_mapping
from garage2usd.datasets import Recipe
from garage2usd.datasets.drives import check_drives
from garage2usd.profiles import read_profile
from garage2usd.sensors.rig.rig import rig_from_mapping
from garage2usd.survey.toml_survey import DrawnGarage

REPOSITORY = Path(__file__).parents[2]  # test_wheel.py loads this module alone, without other helpers

README = REPOSITORY / "README.md"
PAGES = [README, *sorted((REPOSITORY / "docs").rglob("*.md"))]
RUN = {"sh", "python", "toml"}
SHOWN = {"", "csharp", "json", "xml", "yaml"}

_BLOCK = re.compile(
    r"(?:^<!-- not run: (?P<reason>.+?) -->\n)?^```(?P<language>\S*)\n(?P<text>.*?)^```$", re.MULTILINE | re.DOTALL
)
_FILE = re.compile(r"# (?P<name>[\w.]+\.(?:py|toml))\b")
_EXIT_CODE = re.compile(r"#.*\bexit code (\d)")
_CHANGES_THE_MACHINE = {"pip", "make", "apt-get", "sudo", "npm"}
_SHELL = {">", "|", "&&", ";"}
_SMALL = """
.......
E=====.
.=...=.
.=====X
.......
"""
_BUILDS_THE_GARAGE = re.compile(r"^garage2usd build(?!.*-o)", re.MULTILINE)


@functools.cache
def _garage():
    """A folder with the garage that pages start with, which is built once."""
    folder = tempfile.TemporaryDirectory()
    garage2usd.build(garage2usd.GarageConfig(site={"structure": _SMALL}), Path(folder.name) / "garage.usdz")
    return folder


@dataclass(frozen=True)
class Block:
    """A fenced block; `reason` says why it is not run, if it is not."""

    page: Path
    line: int
    language: str
    text: str
    reason: str | None

    def __str__(self):
        return f"{self.page.relative_to(REPOSITORY)}:{self.line}"

    @property
    def file_name(self):
        """The file that the reader is told to save it as, in its first line."""
        named = _FILE.match(self.text)
        return named["name"] if named else None

    def commands(self):
        """Each command of a shell block with the exit code that it is to have."""
        for line in self.text.replace("\\\n", " ").splitlines():
            if line.split("#")[0].strip():
                code = _EXIT_CODE.search(line)
                yield line, int(code[1]) if code else 0


def blocks(page):
    """All blocks of a page but Sphinx's directives."""
    text = page.read_text()
    for found in _BLOCK.finditer(text):
        line = text.count("\n", 0, found.start("text"))
        if not found["language"].startswith("{"):
            yield Block(page, line, found["language"], found["text"], found["reason"])


def checked_settings(block):
    """Check a file by what it is: a drawn garage, a rig, a recipe or a profile; return settings of a garage."""
    settings = tomllib.loads(block.text)
    if isinstance(settings.get("stalls"), list) or not settings.keys().isdisjoint({"runs", "lanes"}):
        assert validated(DrawnGarage, settings), block
    elif "sensors" in settings:
        assert rig_from_mapping(settings).sensors, block
    elif not settings.keys().isdisjoint({"garage", "make"}):
        recipe = Recipe(**{"name": "page", **settings})
        recipe.check()
        if recipe.make.drives:
            check_drives(recipe.make.drives)
    elif "name" in settings:
        assert list(read_profile(settings).clauses()), block
    else:
        assert config_from_mapping(settings)
        return settings
    return None


class Reader:
    """Someone who goes through a page in a folder that has the samples and, as after the first page, a garage."""

    def __init__(self, folder):
        self.folder = folder
        self.names = {"__name__": "page"}
        (folder / "samples").symlink_to(REPOSITORY / "samples")
        shims = folder / "bin"
        shims.mkdir()
        for name, text in (
            ("garage2usd", f"#!{sys.executable}\nfrom garage2usd.cli import run\nrun()\n"),
            ("python", f'#!/bin/sh\nexec "{sys.executable}" "$@"\n'),
        ):
            shim = shims / name
            shim.write_text(text)
            shim.chmod(0o755)

    def start_with_a_garage(self):
        shutil.copytree(_garage().name, self.folder, dirs_exist_ok=True)

    def follow(self, block):
        """Do what a block says."""
        {"sh": self._shell, "python": self._python, "toml": self._toml}[block.language](block)

    def _toml(self, block):
        if block.file_name:
            (self.folder / block.file_name).write_text(block.text)
        settings = checked_settings(block)
        if settings is not None and not block.file_name:
            # that it can be built is told as well by lanes that were learnt for a moment only
            settings["plan"] = {**settings.get("plan", {}), "episodes": 100}
            config = config_from_mapping(settings)
            assert garage2usd.generate(config).stalls, block

    def _python(self, block):
        if block.file_name:
            (self.folder / block.file_name).write_text(block.text)
            return
        code = compile("\n" * block.line + block.text, str(block.page), "exec")
        with contextlib.chdir(self.folder), contextlib.redirect_stdout(io.StringIO()):
            exec(code, self.names)  # noqa: S102 - our own pages

    def _shell(self, block):
        for line, code in block.commands():
            words = shlex.split(line, comments=True)
            assert not _CHANGES_THE_MACHINE & set(words), f"{block}: {line} needs a mark why it is not run"
            if words[0] == "garage2usd" and words[1] in {"view", "draw"}:
                self._view(words[1:])
            elif words[0] == "garage2usd" and not _SHELL & set(words):
                self._command(words[1:], code, f"{block}: {line}")
            else:
                self._bash(line, code, block)

    def _command(self, arguments, code, place):
        if arguments[0] == "render":
            pytest.importorskip("bpy", reason="Blender's bpy is made for Python 3.11 only")
            apart = ["--every-s", "8"] if "--tracks" in arguments else ["--every-m", "40"]
            small = ["--scale", "0.05", *apart] if "--rig" in arguments else ["--size", "32x18"]
            arguments = [*arguments, *small, "--samples", "1"]
        elif arguments[0] == "look" and "--contact-sheet" in arguments:
            pytest.importorskip("bpy", reason="Blender's bpy is made for Python 3.11 only")
            arguments = [*arguments, "--seeds", "0", "--size", "32x18", "--samples", "1"]
        elif arguments[0] == "dataset":
            # the last of an option counts: two garages of many, and not a worker for each core, which all load all
            few = ["--count", "2"] if "--count" in arguments else []
            arguments = [*arguments, *few, "--workers", "1"]
        with contextlib.chdir(self.folder):
            run = CliRunner().invoke(main, arguments)
        assert run.exit_code == code, f"{place}\n{run.output}{run.exception!r}"

    def _view(self, arguments):
        command = [sys.executable, "-u", "-m", "garage2usd", *arguments, "--no-browser", "--port", "0"]
        # in a process group of its own, to which Ctrl-C in a terminal goes as a whole
        with subprocess.Popen(
            command, cwd=self.folder, stdout=subprocess.PIPE, text=True, start_new_session=True
        ) as server:
            address = re.search(r"http://127\.0\.0\.1:\d+/\S*", server.stdout.readline())[0]
            assert re.search("objects|Ctrl-C ends", server.stdout.readline())
            with urllib.request.urlopen(address, timeout=30) as page:  # noqa: S310 - http by the pattern above
                assert b"<script" in page.read()
            os.killpg(server.pid, signal.SIGINT)
            server.wait(timeout=30)
        assert server.returncode == 0

    def _bash(self, line, code, block):
        for module in ("bpy", "newton"):
            script = next((self.folder / word for word in shlex.split(line) if word.endswith(".py")), None)
            if script and f"import {module}\n" in script.read_text():
                pytest.importorskip(module)
        run = subprocess.run(
            ["bash", "-ec", line],
            cwd=self.folder,
            env={**os.environ, "PATH": f"{self.folder / 'bin'}:{os.environ['PATH']}"},
            capture_output=True,
            text=True,
            timeout=300,
            check=False,
        )
        assert run.returncode == code, f"{block}: {line}\n{run.stdout}{run.stderr}"


def check_text(block):
    """Check what a block tells without doing it: its syntax, its settings, and that its commands and options exist."""
    if block.language == "toml" and block.reason is None:
        checked_settings(block)
    elif block.language == "toml":
        tomllib.loads(block.text)
    elif block.language == "python":
        compile(block.text, str(block), "exec")
    elif block.language == "sh":
        for line, _ in block.commands():
            words = list(itertools.takewhile(lambda word: word not in _SHELL, shlex.split(line, comments=True)))
            if words[0] == "garage2usd":
                group = click.Context(main)
                name, command, rest = main.resolve_command(group, words[1:])
                command.make_context(name, rest, parent=group)


def follow_page(page, folder):
    """Do all that a page says."""
    reader = Reader(folder)
    to_run = [block for block in blocks(page) if block.language in RUN and block.reason is None]
    said = "".join(block.text for block in to_run)
    if re.search(r"\bgarage(\.usdz|_report)", said) and not _BUILDS_THE_GARAGE.search(said):
        reader.start_with_a_garage()
    for block in to_run:
        reader.follow(block)
