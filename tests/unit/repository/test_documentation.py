"""What README and documentation show runs as it stands there, and the documentation is built without a warning."""

import html
import json
import re
import subprocess
import sys
import tomllib
from collections import Counter
from importlib import import_module

import pytest
from support.documentation import PAGES, README, RUN, SHOWN, Reader, blocks, check_text, follow_page
from support.sample_files import REPOSITORY
from support.soak import soak_but

EVERY_BLOCK = [block for page in PAGES for block in blocks(page)]
# test_wheel.py follows the README, as someone who has the wheel alone
PAGES_THAT_RUN = [page for page in PAGES if page != README and any(block.language in RUN for block in blocks(page))]
FIRST_PAGES = [REPOSITORY / "docs/guides/lane_graph.md"]
MOST_THAT_ARE_NOT_RUN = 17
MOST_LINES = 300


def test_the_page_of_a_builds_files_names_every_key_in_them(tmp_path):
    Reader(tmp_path).start_with_a_garage()
    report, labels = (json.loads((tmp_path / f"garage_{name}.json").read_text()) for name in ("report", "labels"))
    keys = {
        *report,
        *report["levels"][0],
        *report["levels"][0]["circulation"],
        *report["levels"][0]["stalls"][0],
        *labels,
        *labels["classes"][0],
        *labels["columns"],
    }
    told = set(re.findall(r"`(\w+)`", (REPOSITORY / "docs" / "files.md").read_text()))
    assert keys <= told


def page_name(page):
    return page.relative_to(REPOSITORY).as_posix()


@pytest.mark.parametrize("page", soak_but(FIRST_PAGES, PAGES_THAT_RUN), ids=page_name)
def test_a_page_can_be_followed_from_top_to_bottom(page, tmp_path):
    follow_page(page, tmp_path)


def test_blocks_that_are_not_run_are_few_and_well_formed():
    unrun = [block for block in EVERY_BLOCK if block.reason]
    assert len(unrun) <= MOST_THAT_ARE_NOT_RUN, [str(block) for block in unrun]


@pytest.mark.parametrize("page", PAGES, ids=page_name)
def test_settings_commands_and_options_of_every_page_exist(page, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    for block in blocks(page):
        check_text(block)


def test_every_block_says_what_it_is():
    assert {block.language for block in EVERY_BLOCK} <= RUN | SHOWN
    fences = sum(page.read_text().count("\n```") for page in PAGES)
    directives = sum(len(re.findall(r"^```\{", page.read_text(), re.MULTILINE)) for page in PAGES)
    at_the_top = sum(page.read_text().startswith("```") for page in PAGES)
    assert fences + at_the_top == 2 * (len(EVERY_BLOCK) + directives)


def test_pictures_and_files_that_pages_link_to_are_there():
    for page in PAGES:
        for target in re.findall(r"\]\(([^)#:]+)(?:#[^)]*)?\)", page.read_text()):
            assert (page.parent / target).exists(), f"{page_name(page)} links to {target}"


def test_names_of_code_that_pages_mention_exist():
    for page in PAGES:
        for name in re.findall(r"`(garage2usd(?:\.\w+)+)(?:\(\))?`", page.read_text()):
            assert resolve(name) is not None, f"{page_name(page)} mentions {name}"


def resolve(name):
    """A module, or what a module holds under a dotted name."""
    parts = name.split(".")
    for end in range(len(parts), 0, -1):
        try:
            found = import_module(".".join(parts[:end]))
        except ModuleNotFoundError:
            continue
        for part in parts[end:]:
            found = getattr(found, part, None)
        return found
    return None


def test_contributing_names_every_room_in_the_order_of_imports():
    settings = tomllib.loads((REPOSITORY / "pyproject.toml").read_text())
    layers = settings["tool"]["importlinter"]["contracts"][0]["layers"]
    rooms = [name.strip().removeprefix("garage2usd.") for layer in layers for name in layer.split("|")]
    table = re.findall(r"^\| (`.*?) \|", (REPOSITORY / "CONTRIBUTING.md").read_text(), re.MULTILINE)
    listed = [name.rstrip("/") for row in table for name in re.findall(r"`([\w/]+)`", row)]
    assert sorted(listed) == sorted(rooms)
    place = {room: number for number, layer in enumerate(layers) for room in re.findall(r"garage2usd\.(\w+)", layer)}
    assert [place[room] for room in listed] == sorted(place[room] for room in listed)


def test_long_modules_and_no_others_say_why_they_are_long():
    texts = {path: path.read_text() for path in sorted((REPOSITORY / "garage2usd").rglob("*.py"))}
    is_long = {path.as_posix() for path, text in texts.items() if text.count("\n") > MOST_LINES}
    says_why = {
        path.as_posix() for path, text in texts.items() if re.search(r"^# Over 300 lines: \w", text, re.MULTILINE)
    }
    assert is_long == says_why


@pytest.fixture(scope="module")
def site(tmp_path_factory):
    """The documentation as HTML, with warnings as errors."""
    folder = tmp_path_factory.mktemp("site")
    run = subprocess.run(
        [sys.executable, "-m", "sphinx", "-W", "--keep-going", "-q", "-d", folder / "doctrees", ".", folder / "html"],
        cwd=REPOSITORY / "docs",
        capture_output=True,
        text=True,
        check=False,
    )
    assert run.returncode == 0, run.stderr
    return folder / "html"


def text_of(page):
    article = re.search(r"<article.*</article>", page.read_text(), re.DOTALL)[0]
    return " ".join(html.unescape(re.sub(r"<[^>]+>", "", article)).split())


@pytest.mark.soak
def test_the_built_reference_has_all_that_the_code_has(site):
    from garage2usd.checks import RULES
    from garage2usd.cli import main
    from garage2usd.config import GarageConfig
    from garage2usd.profiles import PROFILE_NAMES, Profile, load_profile
    from garage2usd.reading.labels import CITYSCAPES

    configuration = text_of(site / "reference" / "configuration.html")
    for name, field in GarageConfig.model_fields.items():
        assert name in configuration
        for setting in getattr(field.annotation, "model_fields", {}):
            assert re.search(rf"\b{setting}\b", configuration), f"{name}.{setting}"
    assert "0.1 paper, 0.1 tuned, 0.03 over aisles Learning rate" in configuration

    commands = text_of(site / "reference" / "command_line.html")
    for name, command in main.commands.items():
        assert f"garage2usd {name}" in commands
        for option in (word for parameter in command.params for word in parameter.opts if word.startswith("--")):
            assert option in commands, f"{name} {option}"

    classes = text_of(site / "reference" / "classes.html")
    for number, (name, cityscapes) in enumerate(CITYSCAPES.items(), 1):
        assert f"{number} {name} {cityscapes}" in classes

    profiles = text_of(site / "reference" / "profiles.html")
    listed = Counter(key for name in PROFILE_NAMES for key, _ in load_profile(name).clauses())
    for clause in Profile.model_fields.keys() - {"name", "title"}:
        assert len(re.findall(rf"\b{clause}\b", profiles)) >= 1 + listed[clause]

    rules = text_of(site / "reference" / "rules.html")
    for rule in RULES:
        assert f"{rule.name} {rule.asks}" in rules


def test_every_deviation_in_the_code_is_listed(site):
    listed = text_of(site / "reference" / "paper.html")
    found = 0
    for file in (REPOSITORY / "garage2usd").rglob("*.py"):
        for words in re.findall(r"Deviation:\s+((?:[\w-]+\s+){5})", file.read_text()):
            found += 1
            assert " ".join(words.split()) in listed, f"{file}: {words}"
    assert found == sum(file.read_text().count("Deviation:") for file in (REPOSITORY / "garage2usd").rglob("*.py"))
    assert found
