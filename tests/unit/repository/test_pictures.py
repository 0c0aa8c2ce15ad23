"""The check of pictures names those that are out of date, and those of README and documentation are as they were drawn.

A picture that is missing, was altered or stands in no table is an error everywhere. One that is older than what it
shows is only told by ``make soak``, as most changes of the output make some older; ``release/release.sh`` wants none.
"""

import json
import tomllib

import draw
import pytest
from gallery_page import PAGE, configuration, page
from PIL import Image
from support.documentation import blocks
from support.sample_files import REPOSITORY
from table import MADE_OF, Picture, check, file_digest, read_records, read_table

import garage2usd
from garage2usd.config import config_from_mapping
from garage2usd.config.starting_points import STARTING_POINTS, starting_point
from garage2usd.imports import import_layout

GALLERY = {name: entry for name, entry in read_table().items() if entry.title}
SMALL = ["residential_de", "motorcycles", "lot"]
TABLE = """
["pictures/inside.png"]
of = "build a.toml"
commands = ["garage2usd render garage.usdc --camera Inside -o d"]
take = ["d/colour/*.png"]

["pictures/page.png"]
elsewhere = "a page in a browser"
"""


@pytest.fixture
def repository(tmp_path):
    """A repository with a page, two pictures of it, and the record of the one that is drawn."""
    folder = tmp_path / "docs" / "pictures"
    folder.mkdir(parents=True)
    (tmp_path / "README.md").write_text(
        "[![inside](docs/pictures/inside.png)](https://x.org) ![](docs/pictures/page.png)"
    )
    (folder / "pictures.toml").write_text(TABLE)
    for name in ("inside.png", "page.png"):
        (folder / name).write_bytes(name.encode())
    entry = read_table(tmp_path)["docs/pictures/inside.png"]
    record = {"entry": entry.told(), "stage": "abc", "picture": file_digest(folder / "inside.png")}
    (tmp_path / MADE_OF).write_text(json.dumps({"docs/pictures/inside.png": record}))
    return tmp_path


STAGES = {"build a.toml": "abc"}


def test_nothing_is_found_where_all_is_as_it_was_drawn(repository):
    assert check(repository, STAGES).lines() == []


def test_a_garage_that_has_changed_makes_its_pictures_older(repository):
    found = check(repository, {"build a.toml": "xyz"})
    assert not found.wrong
    assert found.lines() == ["docs/pictures/inside.png: shows build a.toml of another content: abc, now xyz"]


def test_another_camera_in_the_table_makes_its_picture_older_and_other_words_do_not(repository):
    table = repository / "docs/pictures/pictures.toml"
    table.write_text(TABLE.replace("--camera Inside", "--camera Above"))
    assert check(repository, STAGES).older == {"docs/pictures/inside.png": "is drawn otherwise now, by its entry"}
    table.write_text(TABLE.replace('of = "build a.toml"', 'of = "build a.toml"\ntitle = "T"\nwords = "W"'))
    assert check(repository, STAGES).lines() == []


@pytest.mark.parametrize(
    ("change", "name", "reason"),
    [
        (lambda r: (r / "docs/pictures/inside.png").write_bytes(b"!"), "inside.png", "was altered after it was drawn"),
        (lambda r: (r / "docs/pictures/inside.png").unlink(), "inside.png", "is missing; README.md shows it"),
        (lambda r: (r / "docs/pictures/new.jpg").write_bytes(b"!"), "new.jpg", "has no entry"),
        (lambda r: (r / "docs/a.md").write_text("![](pictures/own.svg)"), "own.svg", "has no entry"),
        (lambda r: (r / "README.md").write_text("![](docs/pictures/page.png)"), "inside.png", "is shown on no page"),
        (lambda r: (r / MADE_OF).unlink(), "inside.png", "has no record"),
    ],
)
def test_each_fault_is_found_at_the_picture_that_has_it(repository, change, name, reason):
    change(repository)
    found = check(repository, STAGES)
    assert list(found.wrong) == [f"docs/pictures/{name}"]
    assert reason in found.wrong[f"docs/pictures/{name}"]
    assert not found.older


def test_an_entry_with_an_unknown_key_is_refused(repository):
    (repository / "docs/pictures/pictures.toml").write_text('["pictures/a.png"]\ncamera = "Inside"\n')
    with pytest.raises(TypeError, match="camera"):
        check(repository)


def test_pictures_are_joined_cut_made_smaller_and_brighter(tmp_path):
    for name, grey in (("a", 40), ("b", 80)):
        Image.new("RGB", (100, 50), (grey,) * 3).save(tmp_path / f"{name}.png")
    entry = Picture(take=("a.png", "b.png"), columns=2, width=40, crop=(0.0, 0.0, 0.8, 0.4), brighter=0.5)
    draw._save(entry, tmp_path, tmp_path / "out.png")
    whole = Image.open(tmp_path / "out.png").convert("RGB")
    assert whole.size == (80, 10)
    left, right = whole.getpixel((10, 5))[0], whole.getpixel((70, 5))[0]
    assert 100 < left < 200
    assert 130 < right < 200
    with pytest.raises(ValueError, match=r"draw no c\.png"):
        draw._save(Picture(take=("c.png",)), tmp_path, tmp_path / "out.png")


def test_the_pictures_here_are_those_that_were_drawn():
    found = check()
    assert found.wrong == {}


@pytest.mark.soak
def test_garages_are_those_that_the_pictures_show(record_property):
    stages = draw.garage_digests({entry.of for entry in read_table().values() if not entry.elsewhere}, jobs=1)
    found = check(stages=stages)
    assert found.wrong == {}
    record_property("older", [f"older than what it shows: {line}" for line in found.lines()])


def test_the_gallery_has_twenty_four_garages_of_one_level_to_four_of_each_profile_and_imported():
    assert len(GALLERY) == 24
    records = read_records()
    assert {records[name]["figures"]["levels"] for name in GALLERY} == {1, 2, 3, 4}
    texts = [configuration(entry.of) for entry in GALLERY.values()]
    for profile in ("cn-jgj100", "de-garvo", "uk-istructe", "us-ada"):
        assert sum(f'profile = "{profile}"' in text for text in texts) >= 2
    assert sum(entry.of.startswith("import ") for entry in GALLERY.values()) >= 2
    assert {entry.of.split()[2] for entry in GALLERY.values() if "--like" in entry.of} == set(STARTING_POINTS)


def test_the_page_of_the_gallery_is_made_from_its_garages():
    assert (REPOSITORY / PAGE).read_text() == page(), "run python docs/pictures/gallery_page.py"


def test_the_gallery_is_small_enough_for_the_repository():
    files = [path for path in (REPOSITORY / "docs/gallery").iterdir() if path.is_file()]
    assert sum(path.stat().st_size for path in files) < 5_000_000


@pytest.mark.parametrize("name", STARTING_POINTS)
def test_a_starting_point_on_the_page_is_the_one_that_is_shipped(name):
    (of,) = {entry.of for entry in GALLERY.values() if f"--like {name} " in entry.of}
    settings = tomllib.loads(configuration(of))
    assert str(settings.pop("seed")) == of.split()[-1]
    assert config_from_mapping(settings) == starting_point(name)


@pytest.mark.parametrize("stem", SMALL)
def test_a_garage_is_built_from_what_stands_on_the_page_alone(stem, tmp_path):
    """The page is followed with all garages by test_documentation.py, in `make soak`."""
    (block,) = [each for each in blocks(REPOSITORY / PAGE) if each.file_name == f"{stem}.toml"]
    file = tmp_path / block.file_name
    file.write_text(block.text)
    make = import_layout if GALLERY[f"docs/gallery/{stem}.jpg"].of.startswith("import") else load_and_build
    report = json.loads(make(file, tmp_path / "garage.usdc").report.read_text())
    figures = read_records()[f"docs/gallery/{stem}.jpg"]["figures"]
    assert report["parking_stalls"] == figures["stalls"]
    assert len(report["levels"]) == figures["levels"]


def load_and_build(file, stage):
    return garage2usd.build(garage2usd.load_config(file), stage)
