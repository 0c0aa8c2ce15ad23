"""Surveys that are traced: what edits write, that comments stay and undo returns the same bytes, and opening beside."""

import json
import random
import tomllib
from pathlib import Path

import pytest
from support.sample_files import REPOSITORY

from garage2usd.common.errors import ConfigError, Garage2UsdError, OutputError
from garage2usd.drafts.draft import Draft
from garage2usd.drafts.draft_file import DraftFile
from garage2usd.drafts.garage_desk import GarageDesk
from garage2usd.drafts.opening import desk_of, files_beside, opened_beside
from garage2usd.drafts.survey_desk import SurveyDesk
from garage2usd.drafts.survey_edits import NEW, survey_edit_of, survey_in
from garage2usd.survey.toml_survey import read_toml_survey

LOT = (REPOSITORY / "samples" / "surveys" / "lot.toml").read_text()
INLINE = "lanes = [{points = [[0, 8], [30, 8]]}]  # one\nportals = [\n    {at = [0, 8]},  # the gate\n]\n"
RUN = {"first": [4, 5], "last": [24, 5], "side": "left", "count": 8}


def draft(text):
    return Draft(text, Path(), survey_in)


def edit(survey, **message):
    survey.edit(survey_edit_of(message))


def test_parts_are_added_after_the_others_and_the_outline_before_all_tables():
    survey = draft(NEW)
    edit(survey, kind="add", part="runs", value=RUN)
    edit(survey, kind="add", part="runs", value={**RUN, "side": "right"})
    edit(survey, kind="add", part="lanes", value={"points": [[0, 8], [30, 8]], "one_way": True})
    edit(survey, kind="outline", points=[[0, 0], [30, 0], [30, 16]])
    assert survey.text == NEW + (
        "outline = [[0.0, 0.0], [30.0, 0.0], [30.0, 16.0]]\n"
        '\n[[runs]]\nfirst = [4, 5]\nlast = [24, 5]\nside = "left"\ncount = 8\n'
        '\n[[runs]]\nfirst = [4, 5]\nlast = [24, 5]\nside = "right"\ncount = 8\n'
        "\n[[lanes]]\npoints = [[0, 8], [30, 8]]\none_way = true\n"
    )


def test_comments_stay_when_parts_beside_them_change():
    survey = draft(LOT)
    edit(survey, kind="alter", part="runs", at=0, value={"count": 10, "number": None})
    edit(survey, kind="remove", part="columns", at=0)
    wanted = LOT.replace("count = 11", "count = 10").replace(
        "number = 1                    # painted in the first; the others follow\n", ""
    )
    assert survey.text == wanted.replace("[[columns]]\nat = [3, 15]\nsize_m = 0.4\n\n", "")
    for _ in range(2):
        survey.undo()
    assert survey.text == LOT


def test_lists_in_one_line_are_changed_where_they_stand():
    survey = draft(INLINE)
    edit(survey, kind="add", part="lanes", value={"points": [[3, 8], [3, 12]]})
    edit(survey, kind="alter", part="portals", at=0, value={"kind": "exit"})
    assert tomllib.loads(survey.text)["lanes"][1] == {"points": [[3, 8], [3, 12]]}
    assert survey.config.portals[0].kind.value == "exit"
    assert "# one" in survey.text
    assert "# the gate" in survey.text


@pytest.mark.parametrize(
    ("message", "said"),
    [
        ({"kind": "alter", "part": "runs", "at": 2, "value": {}}, "at: got 2; allowed: a number below 2, of runs"),
        ({"kind": "remove", "part": "stalls", "at": 0}, "a number below 0, of stalls"),
        ({"kind": "add", "part": "walls", "value": {}}, "part: got 'walls'"),
        ({"kind": "add", "part": "runs", "value": {**RUN, "side": "up"}}, "runs.2.side: got 'up'"),
        ({"kind": "add", "part": "portals", "value": {"at": [0, None]}}, "value: got None"),
        ({"kind": "outline", "points": [[0, 0]]}, "outline"),
        ({"kind": "add", "part": "lanes", "value": {"points": [[0, 0], [1e9, 0]]}}, "lanes.1.points"),
    ],
)
def test_an_edit_that_does_not_fit_is_refused_in_a_line(message, said):
    survey = draft(LOT)
    with pytest.raises(ConfigError) as refused:
        edit(survey, **message)
    assert said in str(refused.value)
    assert "\n" not in str(refused.value)
    assert survey.text == LOT


def _random_edit(draw):
    part = draw.choice(["stalls", "runs", "lanes", "columns", "portals", "solids"])
    place = lambda: [round(draw.uniform(0, 40), 2), round(draw.uniform(0, 20), 2)]  # noqa: E731
    values = {
        "stalls": {"corners": [place() for _ in range(4)]},
        "runs": {**RUN, "first": place(), "last": place()},
        "lanes": {"points": [place(), place()]},
        "columns": {"at": place()},
        "portals": {"at": place(), "kind": draw.choice(["entrance", "exit", "way"])},
        "solids": {"corners": [place() for _ in range(3)]},
    }
    kind = draw.choice(["add", "alter", "remove", "outline"])
    if kind == "outline":
        return {"kind": kind, "points": draw.choice([None, [place() for _ in range(4)]])}
    if kind == "add":
        return {"kind": kind, "part": part, "value": values[part]}
    at = {"kind": kind, "part": part, "at": draw.randrange(3)}
    return at if kind == "remove" else {**at, "value": values[part]}


@pytest.mark.parametrize("text", [LOT, NEW, INLINE], ids=["sample", "new", "inline"])
@pytest.mark.parametrize("seed", range(10))
def test_any_edits_leave_a_survey_that_loads_and_undo_returns_the_same_bytes(text, seed, tmp_path):
    draw, survey, steps = random.Random(seed), draft(text), []  # noqa: S311
    for _ in range(12):
        before = survey.text
        try:
            edit(survey, **_random_edit(draw))
        except Garage2UsdError:
            assert survey.text == before
            continue
        steps += [before] * (survey.text != before)
    (tmp_path / "lot.toml").write_text(survey.text)
    read_toml_survey(tmp_path / "lot.toml")
    for before in reversed(steps):
        survey.undo()
        assert survey.text == before
    assert survey.text == text


def test_the_parts_that_import_leaves_out_are_found_at_their_places(tmp_path):
    path = tmp_path / "lot.toml"
    path.write_text(LOT + '\n[[stalls]]\nid = "twice"\ncorners = [[6, 0.5], [8.5, 0.5], [8.5, 5.8], [6, 5.8]]\n')
    desk = SurveyDesk(DraftFile(path))
    told = desk.findings()
    (found,) = [each for each in told["findings"] if each["severity"] == "warning"]
    assert "twice" in found["message"] or "runs.0.0" in found["message"]
    assert found["at"] == pytest.approx([7.25, 3.15], abs=0.1)
    assert told["stalls"] == len(desk.state()["stalls"]) - 1
    assert desk.view(desk.state()["view"]).answer("/scene.bin")[1][:4] == b"G2UV"
    json.dumps(desk.state())


def test_a_survey_without_stalls_is_told_in_a_line(tmp_path):
    told = SurveyDesk(DraftFile(tmp_path / "lot.toml")).findings()
    assert told["stalls"] == 0
    assert len(told["findings"]) == 1
    assert "\n" not in told["findings"][0]["message"]


@pytest.fixture
def folder(tmp_path):
    (tmp_path / "lot.toml").write_text(LOT)
    (tmp_path / "garage.toml").write_text("seed = 3\n")
    (tmp_path / "empty.toml").write_text(NEW)
    return tmp_path


def test_each_kind_of_file_is_opened_by_its_own_page(folder):
    kinds = {"lot.toml": SurveyDesk, "empty.toml": SurveyDesk, "garage.toml": GarageDesk, "new.toml": GarageDesk}
    for name, kind in kinds.items():
        assert type(desk_of(DraftFile(folder / name))) is kind
    assert type(desk_of(DraftFile(folder / "new.toml"), is_new_survey=True)) is SurveyDesk
    with pytest.raises(ConfigError, match="a survey or a new file"):
        desk_of(DraftFile(folder / "garage.toml"), is_new_survey=True)
    for sample in (REPOSITORY / "samples").glob("*.toml"):
        assert type(desk_of(DraftFile(sample))) is GarageDesk


def test_opening_another_file_holds_it_and_lets_the_first_go(folder):
    desk = desk_of(DraftFile(folder / "garage.toml"))
    desk.hold()
    desk.edit({"number": 0, "edit": {"kind": "put", "name": "seed", "value": 4}})
    assert files_beside(desk.file) == ["empty.toml", "garage.toml", "lot.toml"]
    other = opened_beside(desk, {"name": "lot.toml"})
    desk.close()
    assert other.draft.number > desk.draft.number
    with pytest.raises(OutputError, match="it stands open on another page"):
        desk_of(DraftFile(folder / "lot.toml")).hold()
    again = opened_beside(other, {"name": "garage.toml"})
    other.close()
    assert again.state()["kept"]
    again.close()


def test_work_on_a_new_file_that_was_never_saved_is_listed_and_opened(folder):
    desk = desk_of(DraftFile(folder / "fresh.toml"), is_new_survey=True)
    desk.edit({"number": 0, "edit": {"kind": "add", "part": "columns", "value": {"at": [1, 2]}}})
    other = opened_beside(desk, {"name": "garage.toml"})
    assert "fresh.toml" in files_beside(other.file)
    again = opened_beside(other, {"name": "fresh.toml"})
    assert isinstance(again, SurveyDesk)
    assert again.restore({"take": True})["drawing"] == {"columns": [{"at": [1, 2]}]}
    for each in (desk, other, again):
        each.close()


@pytest.mark.parametrize(
    ("message", "said"),
    [
        ({"name": "../lot.toml"}, "name: got '../lot.toml'"),
        ({"name": "none.toml"}, "a file of this folder"),
        ({"name": "garage.toml"}, "another file than the one that is open"),
        ({"name": 3}, "name: got 3"),
        ({"name": "a.toml", "text": "seed = "}, "a.toml: got 'text'; allowed: a.toml: got 'text'; allowed: TOML"),
        ({"name": "a.toml", "text": "sead = 1"}, "sead: got 1"),
        ({"name": "a.toml", "text": "lanes = 1"}, "lanes: got 1"),
    ],
)
def test_what_cannot_be_opened_is_told_in_a_line_and_the_first_stays(folder, message, said):
    desk = desk_of(DraftFile(folder / "garage.toml"))
    with pytest.raises(Garage2UsdError) as refused:
        opened_beside(desk, message)
    assert said in str(refused.value)
    assert "\n" not in str(refused.value)
    assert not (folder / "a.toml").exists()
