"""Edits of a configuration: what they write, that comments stay, and that undo returns the same bytes."""

import random
import tomllib
from pathlib import Path

import pytest
from support.sample_files import REPOSITORY

from garage2usd import load_config
from garage2usd.common.errors import ConfigError, Garage2UsdError
from garage2usd.config import config_in
from garage2usd.drafts.change import rows_of
from garage2usd.drafts.draft import NEW, Draft
from garage2usd.drafts.edits import edit_of

SAMPLES = sorted((REPOSITORY / "samples").glob("*.toml"))
SMALL = '''# a garage of mine
seed = 3  # lucky

[site]
# the drawing
structure = """
....
===E
....
X===
"""

[bay]  # measured on site
row_depths_m = [
    5.4,  # by the wall
    6.5,
    5.4,
    6.5,
]
'''


def draft_of(text, *edits):
    draft = Draft(text, REPOSITORY / "samples", config_in)
    for edit in edits:
        draft.edit(edit_of(edit))
    return draft


def paint(symbol, *at, **more):
    return {"kind": "paint", "symbol": symbol, "at": at, **more}


@pytest.mark.parametrize(
    ("edit", "rows"),
    [
        (paint("#", [0, 0], [3, 3]), ["#...", "===E", "....", "X==#"]),
        (paint("=", [2, 1]), ["....", "===E", ".=..", "X==="]),
        (paint("#", [2, 0], [0, 2], shape="rectangle"), ["###.", "###E", "###.", "X==="]),
        (paint("=", [2, 3], shape="flood"), ["....", "===E", "====", "X==="]),
        (paint("#", [0, 1], symmetry="left-right"), [".##.", "===E", "....", "X==="]),
        (paint("#", [0, 1], symmetry="up-down"), [".#..", "===E", "....", "X#=="]),
        (paint("#", [0, 1], symmetry="turned"), [".#..", "===E", "....", "X=#="]),
        (paint("#", [0, 0], symmetry="both"), ["#..#", "===E", "....", "#==#"]),
        (paint("#", [0, 0], [40, 40], shape="rectangle"), ["####"] * 4),
        (paint("=", [9, 9], [0, 0]), ["=...", "===E", "....", "X==="]),
        ({"kind": "insert", "axis": "rows", "after": 1}, ["....", "===E", "===.", "....", "X==="]),
        ({"kind": "insert", "axis": "cols", "after": 0}, [".....", "====E", ".....", "X.==="]),
        ({"kind": "delete", "axis": "cols", "at": 1}, ["...", "==E", "...", "X=="]),
        ({"kind": "resize", "rows": 3, "cols": 5}, [".....", "===E.", "....."]),
        ({"kind": "adopt", "rows": ["====", "===E", "....", "X==="]}, ["====", "===E", "....", "X==="]),
    ],
)
def test_an_edit_of_squares_gives_these_rows(edit, rows):
    assert rows_of_text(draft_of(SMALL, edit).text) == rows


def rows_of_text(text):
    return tomllib.loads(text)["site"]["structure"].split()


def test_comments_stay_where_they_are():
    draft = draft_of(
        SMALL,
        paint("#", [0, 0]),
        {"kind": "sides", "axis": "rows", "metres": [5.5, 6.5, 5.4, 6.5]},
        {"kind": "put", "name": "seed", "value": 4},
        {"kind": "put", "name": "parking.occupancy", "value": 0.5},
        {"kind": "put", "name": "look.floor.finish", "value": "epoxy"},
    )
    changed = (
        SMALL.replace("\n....\n===E", "\n#...\n===E")
        .replace("seed = 3", "seed = 4")
        .replace("5.4,  # by", "5.5,  # by")
    )
    assert draft.text == changed + '\n[parking]\noccupancy = 0.5\n\n[look.floor]\nfinish = "epoxy"\n'


def test_the_sides_of_lines_move_with_them():
    draft = draft_of(SMALL, {"kind": "insert", "axis": "rows", "after": 0}, {"kind": "delete", "axis": "rows", "at": 4})
    assert tomllib.loads(draft.text)["bay"]["row_depths_m"] == [5.4, 5.4, 6.5, 5.4]


def test_runs_follow_their_squares_and_go_with_their_lanes():
    run = {"kind": "run", "first": [0, 0], "last": [0, 2], "edge": "down", "run": {"kind": "angled", "angle_deg": 60}}
    draft = draft_of(SMALL, run)
    entry = {"first": [0, 0], "last": [0, 2], "edge": "down", "kind": "angled", "angle_deg": 60}
    assert tomllib.loads(draft.text)["stalls"]["runs"] == [entry]
    draft.edit(edit_of({"kind": "insert", "axis": "rows", "after": 3}))
    draft.edit(edit_of({"kind": "delete", "axis": "cols", "at": 1}))
    assert tomllib.loads(draft.text)["stalls"]["runs"] == [{**entry, "last": [0, 1]}]
    draft.edit(edit_of({**run, "last": [0, 0], "run": {"kind": "parallel"}}))
    assert [each["kind"] for each in tomllib.loads(draft.text)["stalls"]["runs"]] == ["angled", "parallel"]
    draft.edit(edit_of(paint("#", [1, 0], [1, 1], shape="rectangle")))
    assert "runs" not in draft.text


def test_a_second_level_takes_the_lanes_out_and_undo_brings_them_back():
    draft = draft_of(SMALL, {"kind": "levels", "count": 2})
    assert rows_of_text(draft.text) == ["....", "...E", "....", "X..."]
    with pytest.raises(ConfigError, match="no lanes with building"):
        draft.edit(edit_of(paint("=", [0, 0])))
    draft.edit(edit_of({"kind": "ramps", "square": [1, 1], "way": "left"}))
    draft.edit(edit_of({"kind": "insert", "axis": "cols", "after": 0}))
    assert draft.config.building.place.square == (1, 2)
    for _ in range(3):
        draft.undo()
    assert draft.text == SMALL


def test_a_site_that_the_seed_draws_becomes_a_structure_when_one_paints():
    text = (REPOSITORY / "samples" / "irregular.toml").read_text()
    draft = Draft(text, REPOSITORY / "samples", config_in)
    drawn = rows_of(draft.config)
    row, col = next((row, line.index(".")) for row, line in enumerate(drawn) if "." in line)
    draft.edit(edit_of(paint("#", [row, col])))
    drawn[row] = drawn[row][:col] + "#" + drawn[row][col + 1 :]
    assert tomllib.loads(draft.text)["site"] == {"structure": "\n".join(drawn) + "\n"}
    assert draft.text.startswith("# A random irregular contour")


@pytest.mark.parametrize(
    ("edit", "said"),
    [
        ({"kind": "put", "name": "seed", "value": -1}, "seed: got -1"),
        ({"kind": "put", "name": "look.floor.finish", "value": "velvet"}, "look.floor.finish: got 'velvet'"),
        ({"kind": "put", "name": "site.contour", "value": "..."}, "name: got 'site.contour'"),
        ({"kind": "put", "name": "seed.of", "value": 1}, "seed: got 3; allowed: a table"),
        ({"kind": "sides", "axis": "rows", "metres": [5.4]}, "bay.row_depths_m: got 1; allowed: 4 numbers"),
        ({"kind": "sides", "axis": "rows", "metres": [5.4, 0.2, 5.4, 5.4]}, "bay.row_depths_m: got "),
        ({"kind": "levels", "count": 9}, "count: got 9"),
        ({"kind": "delete", "axis": "rows", "at": 7}, "at: got 7"),
        ({"kind": "adopt", "rows": ["..."]}, "rows: got 1; allowed: a plan of 4 x 4"),
        ({"kind": "run", "first": [2, 3], "last": [2, 3], "edge": "right", "run": {}}, "stalls.runs: got"),
        ({"kind": "dig"}, "edit: got"),
        (paint("~", [0, 0]), "symbol"),
    ],
)
def test_a_refused_edit_names_its_field_and_changes_nothing(edit, said):
    draft = Draft(SMALL, Path(), config_in)
    with pytest.raises(ConfigError, match=said):
        draft.edit(edit_of(edit))
    assert (draft.text, draft.number, draft.can_undo) == (SMALL, 0, False)


def test_a_stroke_is_undone_at_once():
    draft = Draft(SMALL, Path(), config_in)
    for col in range(3):
        draft.edit(edit_of(paint("#", [0, col])), stroke="a")
    draft.edit(edit_of(paint("#", [2, 0])), stroke="b")
    draft.undo()
    assert rows_of_text(draft.text)[0] == "###."
    draft.undo()
    assert draft.text == SMALL


SETTINGS = {
    "seed": [0, 7, None],
    "profile": ["us-ada", "de-garvo", None],
    "parking.occupancy": [0, 0.5, None],
    "look.floor.finish": ["epoxy", "asphalt", None],
    "look.markings.colour": ["yellow", "#102030", None],
    "look.drawn": [True, ["floor"], None],
    "stalls.kinds": [{"angled": 1.0}, {"perpendicular": 0.5, "parallel": 0.5}, None],
    "bay.stall_width_m": [2.5, None],
    "plan.aisles": ["one-way", None],
    "building.ramps": ["helix", None],
}


def random_edit(draw, rows, cols):
    """Any edit of a site of this size; some of them are refused."""

    def square():
        return [draw.randrange(rows), draw.randrange(cols)]

    axis = draw.choice(["rows", "cols"])
    count = rows if axis == "rows" else cols
    line = square()
    edge = draw.choice(["up", "down", "left", "right"])
    along = 1 if edge in {"up", "down"} else 0
    last = list(line)
    last[along] = draw.randrange(line[along], (rows, cols)[along])
    name = draw.choice(list(SETTINGS))
    symmetry = draw.choice(["none", "left-right", "up-down", "both", "turned"])
    shape = draw.choice(["squares", "rectangle", "flood"])
    painted = paint(draw.choice("#.=EX"), square(), square(), shape=shape, symmetry=symmetry)
    return draw.choice(
        [
            painted,
            painted,
            {"kind": "sides", "axis": axis, "metres": draw.choice([None, [draw.randrange(50, 90) / 10] * count])},
            {"kind": "insert", "axis": axis, "after": draw.randrange(count)},
            {"kind": "delete", "axis": axis, "at": draw.randrange(count)},
            {"kind": "resize", "rows": draw.randrange(3, 12), "cols": draw.randrange(3, 12)},
            {"kind": "levels", "count": draw.choice([1, 1, 2])},
            {"kind": "ramps", "square": draw.choice([None, square()]), "way": edge},
            {
                "kind": "run",
                "first": line,
                "last": last,
                "edge": edge,
                "run": draw.choice([None, {"kind": "parallel"}]),
            },
            {"kind": "put", "name": name, "value": draw.choice(SETTINGS[name])},
        ]
    )


def comments(text):
    return [line.partition("#")[2] for line in text.splitlines() if "# " in line]


@pytest.mark.parametrize("seed", range(200))
def test_any_edits_leave_a_file_that_loads_and_undo_returns_the_same_bytes(seed, tmp_path):
    draw = random.Random(seed)  # noqa: S311
    texts = [SMALL, NEW, *(sample.read_text() for sample in SAMPLES if "20x30" not in sample.name)]
    begun = texts[seed % len(texts)]
    draft = Draft(begun, REPOSITORY / "samples", config_in)
    versions, taken = [draft.text], 0
    for _ in range(12):
        try:
            rows = rows_of(draft.config)
        except Garage2UsdError:  # a drawing that is not a garage yet
            rows = tomllib.loads(draft.text)["site"].get("structure", "........\n" * 8).split()
        try:
            draft.edit(edit_of(random_edit(draw, len(rows), len(rows[0]))))
            taken += 1
        except Garage2UsdError:
            assert draft.text == versions[-1]
        if draft.text != versions[-1]:
            versions.append(draft.text)
    assert taken >= 4
    file = tmp_path / "drawn.toml"
    file.write_text(draft.text)
    assert load_config(file) == draft.config
    for version in reversed(versions):
        assert draft.text == version
        draft.undo()
    assert draft.text == begun
    assert not draft.can_undo
    for version in versions:
        assert draft.text == version
        draft.redo()
    assert draft.text == versions[-1]
