"""The server of the page to draw on: who reaches it, what its messages do, and that no work is lost."""

import http.client
import json
import re
import signal
import socket
import subprocess
import sys
import time
from types import SimpleNamespace

import pytest
from click.testing import CliRunner

from garage2usd import load_config
from garage2usd.cli import main
from garage2usd.common.errors import ConfigError, OutputError
from garage2usd.drafts.draft import NEW
from garage2usd.drafts.draft_file import DraftFile
from garage2usd.drafts.garage_desk import GarageDesk
from garage2usd.drafts.server import DrawServer

SMALL = '# mine\nseed = 3\n\n[site]\nstructure = """\n......\n=====E\n=.....\n=====X\n......\n"""\n'
OPEN = 'seed = 1\n[site]\nstructure = """\n......\n.....E\n......\nX.....\n......\n"""\n[plan]\nepisodes = 200\n'


@pytest.fixture
def path(tmp_path):
    found = tmp_path / "garage.toml"
    found.write_text(SMALL)
    return found


@pytest.fixture
def desk(path):
    return GarageDesk(DraftFile(path))


def edit(desk, edit, **more):
    return desk.edit({"number": desk.draft.number, "edit": edit, **more})


def paint(symbol, *at, **more):
    return {"kind": "paint", "symbol": symbol, "at": at, **more}


def ask(server, path, message=None, *, host=None, origin=None, method=None):
    connection = http.client.HTTPConnection("127.0.0.1", server.port, timeout=60)
    headers = {"Host": host or f"127.0.0.1:{server.port}"}
    if message is not None:
        headers["Origin"] = origin or f"http://127.0.0.1:{server.port}"
    body = None if message is None else message if isinstance(message, bytes) else json.dumps(message)
    connection.request(method or ("GET" if message is None else "POST"), path, body, headers)
    answer = connection.getresponse()
    found = SimpleNamespace(status=answer.status, body=answer.read(), headers=answer.headers)
    connection.close()
    return found


@pytest.fixture
def server(desk):
    with DrawServer(desk) as running:
        running.root = "/" + running.url.split("/", 3)[3]
        yield running


def test_the_page_stands_behind_its_token_and_may_be_framed_by_itself_only(server):
    page = ask(server, server.root)
    assert page.status == 200
    assert sorted(re.findall(rb'(?:src|href)="\./([^"]+)"', page.body)) == [b"draw.js", b"file_bar.css"]
    assert "frame-ancestors 'self'" in page.headers["Content-Security-Policy"]
    assert "unsafe-inline" not in page.headers["Content-Security-Policy"]
    for name in ("draw.js", "file_bar.css", "licenses.txt", "state", "controls", "findings", "progress", "files"):
        assert ask(server, server.root + name).status == 200
    for path in ("/", "/state", "/draw.js", server.root[:-2] + "/state", server.root[:-1], server.root + "../state"):
        assert ask(server, path).status == 404


@pytest.mark.parametrize(
    ("more", "status"),
    [({"origin": "http://evil.example"}, 403), ({"origin": "null"}, 403), ({"host": "evil.example"}, 421)],
)
def test_another_page_changes_nothing(server, more, status):
    assert ask(server, server.root + "undo", {}, **more).status == status
    assert ask(server, "/undo", {}).status == 404
    assert ask(server, server.root + "close", {}).status == 404


@pytest.mark.parametrize("body", [b"", b"{", b"[1]", b"\xff", b'{"edit":' + b"[" * 99_999, b'{"number":0,"edit":1}'])
def test_a_message_that_is_none_is_refused_in_a_line(server, body):
    answer = ask(server, server.root + "edit", body)
    assert answer.status in {400, 409}
    assert "\n" not in json.loads(answer.body)["error"]
    assert server.desk.draft.text == SMALL


def test_an_edit_answers_with_the_plan_drawn_again(server):
    message = {"number": 0, "edit": paint("#", [0, 0], [0, 1])}
    state = json.loads(ask(server, server.root + "edit", message).body)
    (level,) = state["sketch"]["levels"]
    assert level["rows"][0] == "##...."
    assert state["sketch"]["state"] == "drawn"
    assert (state["number"], state["can_undo"], state["is_saved"]) == (1, True, False)
    stale = ask(server, server.root + "edit", message)
    assert stale.status == 409
    assert "another window" in json.loads(stale.body)["error"]


def test_the_plan_is_that_of_a_build(desk):
    from garage2usd import generate

    garage = generate(desk.draft.config)
    sketch, laid_out = desk.state()["sketch"], desk.findings()["levels"]
    made = {stall.name: [[round(x, 3), round(z, 3)] for x, z in stall.corners] for stall in garage.stalls}
    assert {stall["name"]: stall["corners"] for stall in laid_out[0]["stalls"]} == made
    # the squares alone do not tell where stair cores take stalls
    assert made.items() <= {stall["name"]: stall["corners"] for stall in sketch["levels"][0]["stalls"]}.items()
    structure = garage.plan.structure
    assert sketch["rows_m"] == (structure.row_depths_mm / 1000).tolist()
    assert sketch["cols_m"] == (structure.column_widths_mm / 1000).tolist()


def test_findings_stand_where_check_finds_them(desk, path):
    edit(desk, paint(".", [3, 5]))
    desk.save({})
    run = CliRunner().invoke(main, ["check", str(path), "--json"])
    found = json.loads(run.output)["findings"]
    told = desk.findings()["findings"]
    assert [(each["rule"], each["place"], each["message"]) for each in told] == [
        (each["rule"], each["place"], each["message"]) for each in found
    ]
    assert "exit-missing" in {each["rule"] for each in told}
    # those of the squares alone come at once
    assert "exit-missing" in {each["rule"] for each in desk.state()["sketch"]["findings"]}


def test_a_site_that_is_no_garage_is_drawn_with_the_reason(desk):
    edit(desk, paint("#", [0, 0], [9, 9], shape="rectangle"))
    sketch = desk.state()["sketch"]
    assert sketch["state"] == "refused"
    assert sketch["levels"][0]["rows"] == ["######"] * 5
    assert len(sketch["findings"]) == 1


def test_a_run_without_room_is_told(desk):
    run = {"kind": "run", "first": [0, 0], "last": [0, 5], "edge": "down", "run": {"kind": "angled", "angle_deg": 60}}
    edit(desk, {"kind": "sides", "axis": "rows", "metres": [5.4, 6.7, 5.4, 6.7, 5.4]})
    edit(desk, {"kind": "sides", "axis": "cols", "metres": [6.7, 8.1, 8.1, 8.1, 8.1, 6.7]})
    told = edit(desk, run)["sketch"]
    assert told["state"] == "drawn"
    empty = [each["at"] for each in told["findings"] if each["rule"] == "stalls.runs"]
    # the last square lies beside the entrance, where none can stand
    assert empty == [[sum(told["cols_m"][:5]) / 2, 2.7]]


def test_unsaved_work_is_kept_and_offered_again(desk, path):
    edit(desk, paint("#", [0, 0]))
    kept = path.with_name(".garage.toml.unsaved")
    assert kept.read_text() == desk.draft.text
    assert path.read_text() == SMALL
    again = GarageDesk(DraftFile(path))
    assert again.state()["kept"]
    assert again.draft.text == SMALL
    assert kept.exists()
    again.restore({"take": True})
    assert again.draft.text == desk.draft.text
    again.save({})
    assert path.read_text() == desk.draft.text
    assert not kept.exists()
    assert not GarageDesk(DraftFile(path)).state()["kept"]


def test_work_that_is_undone_is_not_kept(desk, path):
    edit(desk, paint("#", [0, 0]))
    desk.undo({})
    assert not path.with_name(".garage.toml.unsaved").exists()
    assert desk.state()["is_saved"]


def test_changes_of_the_file_by_others_are_never_written_over_unasked(desk, path):
    edit(desk, paint("#", [0, 0]))
    path.write_text(SMALL.replace("seed = 3", "seed = 9"))
    assert desk.changed_outside()["changed"]
    with pytest.raises(Exception, match=r"garage\.toml has changed since it was read here"):
        desk.save({})
    assert "seed = 9" in path.read_text()
    mine = desk.draft.text
    desk.reload({})
    assert desk.draft.config.seed == 9
    desk.undo({})
    assert desk.draft.text == mine
    path.write_text(SMALL.replace("seed = 3", "seed = 11"))
    desk.save({"over": True})
    assert path.read_text() == mine


def test_save_as_takes_names_of_this_folder_that_are_free(desk, path):
    for name in ("../a.toml", "a.txt", "/a.toml", ".toml"):
        with pytest.raises(ConfigError, match="name: got"):
            desk.save({"name": name})
    path.with_name("b.toml").write_text("seed = 1\n")
    with pytest.raises(Exception, match=r"b\.toml is there already"):
        desk.save({"name": "b.toml"})
    assert desk.save({"name": "c.toml"})["name"] == "c.toml"
    assert load_config(path.with_name("c.toml")) == desk.draft.config
    edit(desk, paint("#", [0, 0]))
    assert path.with_name(".c.toml.unsaved").exists()


def test_lanes_are_planned_kept_and_built(tmp_path):
    path = tmp_path / "open.toml"
    path.write_text(OPEN)
    desk = GarageDesk(DraftFile(path))
    assert desk.state()["sketch"]["state"] == "open"
    with pytest.raises(ConfigError, match="plan them first"):
        desk.build({})
    desk.learn({})
    while (progress := desk.progress())["is_working"]:
        assert progress["error"] == ""
    state = desk.state()
    assert state["sketch"]["state"] == "planned"
    assert state["sketch"]["levels"][0]["stalls"]
    # neither looks nor cars change the lanes
    edit(desk, {"kind": "put", "name": "parking.occupancy", "value": 0.1})
    assert desk.state()["sketch"]["state"] == "planned"
    built = desk.build({})
    assert built["stalls"] > 10
    assert desk.view(built["view"]).answer("/scene.bin")[1][:4] == b"G2UV"
    assert desk.view("0") is None
    assert built["view"] == desk.state()["view"]
    rows = state["sketch"]["levels"][0]["rows"]
    assert desk.adopt({})["sketch"]["levels"][0]["rows"] == rows
    assert desk.state()["sketch"]["state"] == "drawn"
    desk.undo({})
    edit(desk, paint("#", [0, 0]))
    assert desk.state()["sketch"]["state"] == "open"


def test_planning_stops_when_asked(tmp_path):
    path = tmp_path / "open.toml"
    path.write_text(OPEN.replace("200", "1000000"))
    desk = GarageDesk(DraftFile(path))
    desk.learn({})
    time.sleep(0.3)
    desk.stop({})
    while (progress := desk.progress())["is_working"]:
        pass
    assert progress["error"] == "stopped"
    assert desk.state()["sketch"]["state"] == "open"


def test_a_new_drawing_is_a_garage_and_takes_a_free_name(tmp_path):
    (tmp_path / "garage.toml").write_text(SMALL)
    file = DraftFile.new(tmp_path)
    assert (file.path.name, file.saved) == ("garage_2.toml", None)
    desk = GarageDesk(file)
    assert desk.draft.text == NEW
    assert desk.state()["sketch"]["state"] == "drawn"
    assert not desk.state()["is_saved"]
    desk.save({})
    assert file.path.read_text() == NEW


def test_a_file_stands_open_once(path):
    with DraftFile(path).held():
        with pytest.raises(OutputError, match=r"garage\.toml: it stands open on another page"), DraftFile(path).held():
            pass
        with DraftFile(path.with_name("other.toml")).held():
            pass


@pytest.mark.parametrize(
    ("text", "said"),
    [("seed = ", "TOML"), ("sead = 1", "sead: got 1"), ("[site]\nwidth_cells = 1", "site.width_cells: got 1")],
)
def test_a_faulty_file_is_told_in_a_line(tmp_path, text, said):
    path = tmp_path / "bad.toml"
    path.write_text(text)
    run = subprocess.run(
        [sys.executable, "-m", "garage2usd", "draw", str(path), "--no-browser"],
        capture_output=True,
        text=True,
        check=False,
    )
    assert run.returncode == 1
    assert run.stdout == ""
    assert run.stderr.count("\n") == 1
    assert said in run.stderr


def test_a_taken_port_is_told_in_a_line(path):
    with socket.socket() as other:
        other.bind(("127.0.0.1", 0))
        other.listen()
        port = other.getsockname()[1]
        run = CliRunner().invoke(main, ["draw", str(path), "--no-browser", "--port", str(port)])
    assert run.exit_code == 1
    assert f"127.0.0.1:{port}: cannot listen here" in run.output


def test_ctrl_c_ends_it(path):
    command = [sys.executable, "-u", "-m", "garage2usd", "draw", str(path), "--no-browser"]
    with subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True) as running:
        assert re.fullmatch(r"garage.toml at http://127\.0\.0\.1:\d+/[\w-]{22}/\n", running.stdout.readline())
        assert "Ctrl-C ends" in running.stdout.readline()
        running.send_signal(signal.SIGINT)
        assert running.wait(timeout=60) == 0
    assert [file.name for file in path.parent.iterdir()] == ["garage.toml"]
