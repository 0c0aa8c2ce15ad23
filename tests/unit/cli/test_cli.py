import io
import json
import os
import re
import signal
import subprocess
import sys
import time
from pathlib import Path
from types import SimpleNamespace

import pytest
from click.testing import CliRunner
from PIL import Image
from support.sample_files import REPOSITORY
from support.soak import soak_but

import garage2usd
from garage2usd.cli import bars, main
from garage2usd.cli.build import _learnt, _planned
from garage2usd.cli.process import Termination
from garage2usd.common.limits import ONE_THREAD
from garage2usd.common.progress import time_in_words
from garage2usd.config import config_schema
from garage2usd.profiles import PROFILE_NAMES
from garage2usd.reading.label_table import read_label_table
from garage2usd.stage.prototypes import MESH_FILE

QUICK = "[plan]\nepisodes = 200\n"


def run(*arguments):
    return CliRunner().invoke(main, [str(argument) for argument in arguments])


@pytest.fixture
def config(tmp_path):
    folder = tmp_path / "in"
    folder.mkdir()

    def write(text):
        path = folder / "garage.toml"
        path.write_text(text)
        return path

    return write


@pytest.mark.parametrize("extension", soak_but(["usdz"], ["usda", "usdc", "usdz"]))
def test_build_says_what_it_made(tmp_path, config, extension):
    out = tmp_path / "out" / f"g.{extension}"
    result = run("build", config(QUICK), "--seed", 4, "--output", out)
    assert result.exit_code == 0, result.output
    report = json.loads((tmp_path / "out" / "g_report.json").read_text())
    (level,) = report["levels"]
    stalls = level["score"]["stalls"] - sum(len(core["in_place_of"]) for core in level["stair_cores"])
    assert report["seed"] == 4
    assert [part["name"] for part in level["fire_compartments"]] == ["F1"]
    parking = report["parking_stalls"]
    assert level["fire_compartments"][0]["stalls"] == parking
    assert level["object_counts"]["stall"] == stalls == len(level["stalls"])
    assert sum(level["stall_uses"].values()) == stalls
    assert level["stall_uses"]["standard"] > stalls / 2
    assert f"stalls  {parking} ({level['stall_uses']['standard']} standard, " in result.output
    assert "every stall, from an entrance and to an exit" in result.output
    assert f"{level['score']['value']:.2f} (N_S {level['score']['stalls']}, " in result.output
    assert f"{len(level['stair_cores'])} in the place of {level['score']['stalls'] - stalls} stalls" in result.output
    for name in (out, out.with_name("g_plan.png"), out.with_name("g_report.json")):
        assert name.is_file()
        assert str(name) in result.output
    assets = "" if extension == "usdz" else " and g_assets/"
    assert f"drop {out.name}{assets} into Assets" in result.output
    names = {"g_plan.png", "g_report.json", "g_labels.json", out.name} | (
        set() if extension == "usdz" else {"g_assets"}
    )
    assert {path.name for path in out.parent.iterdir()} == names


def test_a_build_without_an_output_says_what_it_replaces(tmp_path, config, monkeypatch):
    monkeypatch.chdir(tmp_path)
    small = config('[site]\nstructure = """\n...\nE=X\n...\n"""\n[bay]\ndimensioned = false\n')
    assert "replaced" not in run("build", small, "-o", "garage.usdz").output
    result = run("build", small)
    names = "garage.usdz, garage_plan.png, garage_report.json, garage_labels.json"
    assert f"replaced  {names} of before; -o FILE names others" in result.output
    assert "replaced" not in run("build", small, "-o", "garage.usdz").output


@pytest.mark.parametrize(
    ("settings", "said"),
    [
        ("sed = 1\n", "sed: got 1; allowed: one of the keys seed, site"),
        ("[site]\nwidth_cells = -4\n", "site.width_cells: got -4; allowed: greater than or equal to 3"),
        ('[site]\nstructure = """\n...\nE==\n"""\n', "allowed: at least one exit 'X' (3)"),
        ("[site]\nmin_portal_distance_cells = 90\n", "portals: 2 portals at least 90 squares apart found no place"),
        (
            '[site]\nstructure = """\nE=X\n...\n"""\n[bay]\ncolumn_widths_m = [[8.1, 8.1, 8.1], [8.1, 8.0, 8.1]]\n',
            "bay.column_widths_m[1, 1]: got 8.0; allowed: 8.1, constant along a column",
        ),
        ("seed = \n", "CONFIG: got"),
    ],
)
def test_bad_settings_end_in_one_line_and_no_file(tmp_path, config, settings, said):
    result = run("build", config(settings), "--output", tmp_path / "out" / "g.usda")
    assert result.exit_code == 1
    (line,) = result.output.strip().splitlines()
    assert said in line
    assert not (tmp_path / "out").exists()


def test_learning_is_drawn_on_request(tmp_path, config):
    out = tmp_path / "out" / "g.usdz"
    result = run("build", config(QUICK), "--learning-curve", "--best-plans", 6, "--output", out)
    assert result.exit_code == 0, result.output
    assert {path.name for path in out.parent.glob("*.png")} == {"g_plan.png", "g_learning.png", "g_best.png"}
    curve, best = (Image.open(out.parent / f"g_{name}.png").convert("RGB") for name in ("learning", "best"))
    assert curve.size == (960, 540)
    assert {colour for _, colour in curve.getcolors(1 << 20)} >= {(176, 52, 40), (170, 190, 214)}
    report = json.loads((tmp_path / "out" / "g_report.json").read_text())
    for row, line in enumerate(report["levels"][0]["S"]):
        for col, symbol in enumerate(line):
            colour = best.getpixel((20 + col * 16 + 8, 20 + 24 + row * 16 + 8))
            expected = {".": (176, 204, 228), "=": (148, 156, 166), "E": (72, 160, 96), "X": (206, 84, 72)}[symbol]
            assert colour == expected
    refused = run(
        "build", REPOSITORY / "samples" / "hand_drawn.toml", "--learning-curve", "--output", tmp_path / "h.usdz"
    )
    assert refused.exit_code == 1
    assert "learning_curve" in refused.output
    assert not (tmp_path / "h.usdz").exists()


def test_a_tape_rebuilds_the_very_structure(tmp_path, config):
    run("build", config(QUICK), "--seed", 8, "--output", tmp_path / "a.usdz")
    first = json.loads((tmp_path / "a_report.json").read_text())
    learnt_otherwise = config("[plan]\nepisodes = 1\nclimb = false\n")
    run("build", learnt_otherwise, "--seed", 8, "--tape", first["tape"], "--output", tmp_path / "b.usdz")
    second = json.loads((tmp_path / "b_report.json").read_text())
    (made,), (again,) = first["levels"], second["levels"]
    for key in ("structure_digest", "rank", "score"):
        assert again[key] == made[key], key
    assert run("build", config(QUICK), "--tape", "S", "--output", tmp_path / "c.usdz").exit_code == 1
    assert not (tmp_path / "c.usdz").exists()


def test_a_tape_rebuilds_directions_and_stalls(tmp_path, config):
    mixed = "[stalls]\nkinds = { angled = 0.7, parallel = 0.3 }\n" + QUICK + 'aisles = "one-way"\n'
    run("build", config(mixed), "--seed", 8, "--output", tmp_path / "a.usdz")
    first = json.loads((tmp_path / "a_report.json").read_text())
    run("build", config(QUICK), "--seed", 8, "--tape", first["tape"], "--output", tmp_path / "b.usdz")
    second = json.loads((tmp_path / "b_report.json").read_text())
    (made,), (again,) = first["levels"], second["levels"]
    assert made["stall_runs"]
    for key in ("S", "R", "C", "stall_runs", "one_way", "directions", "tape", "rank", "score", "stalls"):
        assert again[key] == made[key], key
    cut = run("build", config(QUICK), "--seed", 8, "--tape", first["tape"][:-1], "--output", tmp_path / "c.usdz")
    assert cut.exit_code == 1
    assert "the tape ends here" in cut.output


def test_a_stall_without_a_route_is_drawn(tmp_path, config):
    drawing = '[site]\nstructure = """\nE=X...\n......\n...===\n"""\n'
    result = run("build", config(drawing), "--output", tmp_path / "g.usda")
    assert result.exit_code == 1
    assert "(1, 3), (1, 4), (1, 5), (2, 2) have no route" in result.output
    assert "\n.." in result.output
    assert "?===" in result.output


@pytest.mark.parametrize("mark", soak_but(["\ufeff"], ["\ufeff", ""]))
def test_files_of_text_begin_with_a_byte_order_mark_or_not(tmp_path, config, mark):
    made = garage2usd.build(garage2usd.load_config(config(QUICK)), tmp_path / "g.usdz")
    report = json.loads(made.report.read_text())
    (level,) = report["levels"]
    texts = {
        "c.toml": '[site]\nstructure_file = "s.txt"\n[bay]\ncolumn_widths_file = "r.csv"\nrow_depths_file = "c.csv"\n',
        "s.txt": "\n".join(level["S"]),
        "r.csv": ",".join(map(str, level["R"])),
        "c.csv": "\n".join(map(str, level["C"])),
        "s.json": json.dumps(level["S"]),
        "p.toml": 'name = "mine"\nbased_on = "cn-jgj100"\n',
        "g_report.json": made.report.read_text(),
        "g_labels.json": made.labels.read_text(),
    }
    for name, text in texts.items():
        (tmp_path / name).write_text(mark + text, encoding="utf-8")
    for name in ("c.toml", "s.txt", "s.json", "g_report.json"):
        checked = run("check", tmp_path / name)
        assert "checked against" in checked.output, (name, checked.output)
    assert "checked against mine" in run("check", tmp_path / "s.txt", "--profile", tmp_path / "p.toml").output
    assert read_label_table(made.stage) is not None
    assert run("plan", tmp_path / "g_report.json", "-o", tmp_path / "p.svg").exit_code == 0


@pytest.mark.parametrize(
    "arguments", [["--output", "g.obj"], ["--output", "g"], ["--output", "a@b.usda"], ["--seed", "-1"], ["--sed", "1"]]
)
def test_bad_usage_ends_in_two(tmp_path, monkeypatch, arguments):
    monkeypatch.chdir(tmp_path)
    result = run("build", *arguments)
    assert result.exit_code == 2
    assert list(tmp_path.iterdir()) == []
    if arguments[0] == "--output":
        allowed = "a file name in UTF-8 without" if "@" in arguments[1] else "a path that ends in .usda, .usdc, .usdz"
        assert f"allowed: {allowed}" in result.output


@pytest.mark.parametrize("output", ["/proc/garage/g.usda", "/dev/null/g.usda"])
def test_an_unwritable_output_is_named_before_the_work(config, output):
    result = run("build", config(QUICK), "--output", output)
    assert result.exit_code == 1
    assert str(Path(output).parent) in result.output
    assert len(result.output.strip().splitlines()) == 1


@pytest.mark.parametrize(
    "arguments",
    [
        ["build", "--output", "n" * 300 + ".usda"],
        ["build", "--output", "n" * 300 + "/g.usda"],
        ["textures", "n" * 300],
        ["meshes", "n" * 300],
        ["check", "n" * 300 + ".usda"],
        ["plan", "n" * 300 + ".usda"],
        ["drive", "--output", "n" * 300 + ".json"],
    ],
)
def test_names_that_no_file_can_have_are_refused_in_one_line(tmp_path, monkeypatch, arguments):
    monkeypatch.chdir(tmp_path)
    result = run(*arguments)
    assert result.exit_code in {1, 2}
    assert result.output.startswith("Error: ")
    assert len(result.output.strip().splitlines()) == 1
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize("deadly", soak_but([signal.SIGKILL], [signal.SIGTERM, signal.SIGKILL, signal.SIGINT]))
def test_a_kill_in_mid_build_leaves_no_file(tmp_path, config, deadly):
    path = config("[site]\nwidth_cells = 30\nheight_cells = 20\n[plan]\nepisodes = 1000000\n")
    out = tmp_path / "out"
    out.mkdir()
    temporary = tmp_path / "tmp"
    temporary.mkdir()
    command = [sys.executable, "-m", "garage2usd", "build", str(path), "--output", str(out / "g.usda")]
    process = subprocess.Popen(
        command,
        env={"TMPDIR": str(temporary), "PATH": "/usr/bin"},
        stderr=subprocess.DEVNULL,
    )
    time.sleep(2.0)
    assert process.poll() is None
    process.send_signal(deadly)
    assert process.wait(timeout=30) != 0
    assert list(out.iterdir()) == []
    if deadly != signal.SIGKILL:
        assert list(temporary.iterdir()) == []


def test_a_termination_that_was_swallowed_is_made_up_for(monkeypatch):
    termination = Termination()
    monkeypatch.setattr(bars, "TERMINATION", termination)
    with bars.Bars(io.StringIO()) as progress:
        progress("plan", 1, 3)
        with pytest.raises(SystemExit) as first:
            termination(signal.SIGTERM, None)
        with pytest.raises(SystemExit) as second:
            progress("plan", 2, 3)
    assert first.value.code == second.value.code == 128 + signal.SIGTERM


def test_where_there_is_no_terminal_a_line_says_every_ten_seconds_how_far_it_is(monkeypatch):
    now = [1000.0]
    monkeypatch.setattr(bars.time, "monotonic", lambda: now[0])
    stream = io.StringIO()
    with bars.Bars(stream) as progress:
        for second in range(46):
            now[0] = 1000.0 + second
            progress("render", 2 * second, 100)
        progress.announce("a picture takes 9.0 s")
    assert stream.getvalue().splitlines() == [
        "render: 20 %, about 40 s left",
        "render: 40 %, about 30 s left",
        "render: 60 %, about 20 s left",
        "render: 80 %, about 10 s left",
        "a picture takes 9.0 s",
    ]


def test_what_takes_less_than_ten_seconds_says_nothing_where_there_is_no_terminal():
    stream = io.StringIO()
    with bars.Bars(stream, unit="garages") as progress:
        for done in range(3):
            progress("garages", done, 2)
    assert stream.getvalue() == ""


@pytest.mark.parametrize(
    ("seconds", "words"),
    [(0.04, "0.0 s"), (9.94, "9.9 s"), (9.96, "10 s"), (59.6, "1 min 0 s"), (130.2, "2 min 10 s"), (3900, "1 h 5 min")],
)
def test_seconds_in_words(seconds, words):
    assert time_in_words(seconds) == words


def test_a_ctrl_c_that_was_swallowed_is_made_up_for(monkeypatch):
    termination = Termination()
    monkeypatch.setattr(bars, "TERMINATION", termination)
    with bars.Bars(io.StringIO()) as progress:
        with pytest.raises(KeyboardInterrupt):
            termination(signal.SIGINT, None)
        with pytest.raises(KeyboardInterrupt):
            progress("plan", 2, 3)


def test_the_schema_command_prints_the_schema():
    assert json.loads(run("schema").output) == config_schema()


@pytest.mark.soak
def test_the_textures_are_baked_again_byte_for_byte(tmp_path):
    result = run("textures", tmp_path / "baked")
    assert result.exit_code == 0, result.output
    baked, kept = (
        {path.relative_to(folder): path.read_bytes() for path in folder.rglob("*.*")}
        for folder in (tmp_path / "baked", REPOSITORY / "textures")
    )
    assert baked == kept


@pytest.mark.soak
def test_the_meshes_are_baked_again_byte_for_byte(tmp_path):
    result = run("meshes", tmp_path / "baked")
    assert result.exit_code == 0, result.output
    assert (tmp_path / "baked" / "meshes.npz").read_bytes() == MESH_FILE.read_bytes()


def test_version_and_help():
    assert "garage2usd" in run("--version").output
    for command in ("build", "meshes", "plan", "render", "schema", "textures"):
        assert run(command, "--help").exit_code == 0


def test_every_command_has_its_whole_summary_in_the_list_of_commands():
    listed = run("--help").output.partition("Commands:")[2]
    assert "..." not in listed
    assert all(f"  {name}  " in listed for name in main.commands)


def test_the_help_of_a_profile_names_all_that_are_shipped():
    for command in ("build", "check"):
        (option,) = (parameter for parameter in main.commands[command].params if parameter.name == "profile")
        assert all(name in option.help for name in PROFILE_NAMES)


@pytest.mark.parametrize("command", ["build", "check", "drive", "plan", "render", "view"])
@pytest.mark.parametrize(("path", "code"), [("none.usda", 1), (".", 2)])
def test_a_file_that_is_missing_is_refused_alike_by_all_commands(tmp_path, monkeypatch, command, path, code):
    monkeypatch.chdir(tmp_path)
    result = run(command, path)
    assert result.exit_code == code, result.output
    assert path in result.output
    if code == 1:
        assert len(result.output.strip().splitlines()) == 1
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize(
    ("command", "given", "threads"),
    [
        ("build", {}, "1"),
        ("check", {}, "1"),
        ("export", {"PXR_WORK_THREAD_LIMIT": "3"}, "3"),
        ("render", {}, "None"),
        ("dataset", {}, "None"),
    ],
)
def test_libraries_keep_to_one_thread_unless_they_are_told_otherwise(command, given, threads):
    code = """
import os, garage2usd.cli as cli
cli.main = lambda: print(os.environ.get("PXR_WORK_THREAD_LIMIT"))
cli.supervise = lambda *_, **__: None
cli.run()
"""
    environment = {name: value for name, value in os.environ.items() if name not in ONE_THREAD} | given
    done = subprocess.run(
        [sys.executable, "-c", code, command], env=environment, stdout=subprocess.PIPE, check=True, text=True
    )
    assert done.stdout.split() == [threads]


@pytest.mark.parametrize("name", soak_but(1, ["g.usdz", "g.usdc", "g.usda"]))
def test_a_file_that_cannot_be_written_is_one_error_and_leaves_nothing(tmp_path, name):
    code = """
import resource, sys
from garage2usd.cli import main
resource.setrlimit(resource.RLIMIT_FSIZE, (100_000, 100_000))
main(sys.argv[1:])
"""
    config = tmp_path / "c.toml"
    config.write_text("[plan]\nepisodes = 50\n")
    command = [sys.executable, "-c", code, "build", str(config), "-o", str(tmp_path / "out" / name)]
    done = subprocess.run(command, capture_output=True, check=False, text=True)
    assert done.returncode == 1
    error = done.stderr.strip().splitlines()[-1]
    assert error.startswith("Error: ")
    assert error.startswith(f"Error: {tmp_path / 'out' / name}: File too large in ")
    assert "Traceback" not in done.stderr
    assert not (tmp_path / "out").exists()


@pytest.mark.parametrize(
    ("lane", "stall", "decides"), [(200, 1, "lane"), (1, 200, "stall")], ids=["the lanes", "the stalls"]
)
def test_build_says_which_illuminance_decides(tmp_path, config, lane, stall, decides):
    settings = f"{QUICK}[fittings]\nlane_lux = {lane}\nstall_lux = {stall}\n[stage]\ntexture_quality = 'low'\n"
    result = run("build", config(settings), "-o", tmp_path / "g.usda")
    light = json.loads((tmp_path / "g_report.json").read_text())["levels"][0]["illuminance"]
    (told,) = (line for line in result.output.splitlines() if line.split()[0] == "light")
    parts = {
        name: f"{name}s {light[f'{name}s']['mean']:.0f} lx ({name}_lux asks for {wanted}"
        f"{', which decides' if name == decides else ''})"
        for name, wanted in (("lane", lane), ("stall", stall))
    }
    assert told.split("light  ")[1] == ", ".join(parts.values())


def test_the_summary_tells_what_became_of_the_planned_stalls_and_of_the_learnt_score():
    settings = {"site": {"width_cells": 6, "height_cells": 6}, "plan": {"episodes": 60, "starts": 1}}
    garage = garage2usd.generate(garage2usd.GarageConfig(seed=3, **settings))
    made = SimpleNamespace(garage=garage)
    ((_, planned),) = _planned(made)
    layout, stalls = garage.layout, garage.plan.score.stalls
    total, parked, *others = map(int, re.findall(r"\d+", planned))
    assert (total, parked) == (stalls, layout.parking_stalls)
    assert "by size classes" not in planned
    assert parked + sum(others) == total
    ((_, learning),) = _learnt(made)
    scores = list(map(float, re.findall(r"score (\S+)", learning)))
    assert scores == sorted(scores)
    assert scores[-1] == round(garage.plan.score.value, 2) or "no better" in learning
