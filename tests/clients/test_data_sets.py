"""Data sets on real Dask clusters: the same bytes whoever is killed, and loaded by the programs of others."""

import contextlib
import json
import os
import re
import shutil
import signal
import subprocess
import sys
import time

import pyarrow.parquet as pq
import pytest
from click.testing import CliRunner
from support.data_sets import SMALL, tree_of

from garage2usd.cli import main
from garage2usd.datasets import Recipe
from garage2usd.datasets import cluster as cluster_of_dask

pytestmark = pytest.mark.client
COMMAND = [sys.executable, "-m", "garage2usd", "dataset"]
EXPORTS = ["xodr", "osm"]


def dataset(*arguments, command=COMMAND, check=True, **options):
    """Run `garage2usd dataset`."""
    done = subprocess.run([*command, *map(str, arguments)], capture_output=True, text=True, check=False, **options)
    if check:
        assert done.returncode == 0, done.stderr
    return done


@pytest.fixture(scope="module")
def recipe_file(tmp_path_factory):
    """A recipe of six small garages in three shards, with maps."""
    path = tmp_path_factory.mktemp("recipe") / "recipe.json"
    path.write_text(Recipe(**SMALL, make={"exports": EXPORTS}).record())
    return path


@pytest.fixture(scope="module")
def whole(recipe_file, tmp_path_factory):
    """The data set by one worker, without interruption, and its files."""
    folder = tmp_path_factory.mktemp("whole") / "garages"
    dataset(recipe_file, "-o", folder, "--workers", 1)
    return folder, tree_of(folder)


@contextlib.contextmanager
def cluster(folder, count):
    """A Dask scheduler and workers without nannies, as on a cluster: address, and the workers' processes."""
    note = folder / "scheduler.json"
    quiet = {"stdout": subprocess.DEVNULL, "stderr": subprocess.DEVNULL}
    dask = [sys.executable, "-m", "dask"]
    started = [
        subprocess.Popen([*dask, "scheduler", "--port", "0", "--no-dashboard", "--scheduler-file", note], **quiet)
    ]
    try:
        while not (note.exists() and note.read_text().strip().endswith("}")):
            assert started[0].poll() is None
            time.sleep(0.1)
        worker = [*dask, "worker", "--scheduler-file", note, "--no-nanny", "--nthreads", "1", "--no-dashboard"]
        started += [subprocess.Popen([*worker, "--local-directory", folder], **quiet) for _ in range(count)]
        yield json.loads(note.read_text())["address"], started[1:]
    finally:
        for process in started:
            process.kill()  # asked to end, workers wait for a scheduler that is gone
        for process in started:
            process.wait(30)


@pytest.mark.soak
def test_two_workers_of_which_one_is_killed_give_the_same_bytes(recipe_file, whole, tmp_path):
    folder = tmp_path / "garages"
    with cluster(tmp_path, 2) as (address, processes):
        run = subprocess.Popen([*COMMAND, recipe_file, "-o", folder, "--scheduler", address], stderr=subprocess.PIPE)
        while not list((folder / "shards").glob(".garage2usd-*")):  # until a shard is being made
            assert run.poll() is None, run.stderr.read().decode()
            time.sleep(0.05)
        # it has no nanny, so that nobody restarts it, as when a machine is lost
        os.kill(processes[0].pid, signal.SIGKILL)
        _, said = run.communicate(timeout=300)
        assert run.returncode == 0, said.decode()
    assert tree_of(folder) == whole[1]


@pytest.mark.soak
def test_a_run_that_is_killed_three_times_goes_on_to_the_same_bytes(recipe_file, whole, tmp_path):
    folder = tmp_path / "garages"
    shards = folder / "shards"
    for goal in (".garage2usd-plans.jsonl", "shards", "shards/*.jsonl"):
        run = subprocess.Popen(
            [*COMMAND, recipe_file, "-o", folder, "--workers", "2", "--resume"],
            stderr=subprocess.DEVNULL,
            start_new_session=True,
        )
        while not list(folder.glob(goal)):
            assert run.poll() is None
            time.sleep(0.02)
        os.killpg(run.pid, signal.SIGKILL)
        run.wait()
    assert len(list(shards.glob("*.jsonl"))) < 3
    refused = dataset(recipe_file, "-o", folder, check=False)
    assert refused.returncode == 2
    assert re.search(r"output: got .*; allowed: .* or resume, as", refused.stderr)
    dataset(recipe_file, "-o", folder, "--workers", 2, "--resume")
    assert tree_of(folder) == whole[1]


def flipped(path, place):
    data = bytearray(path.read_bytes())
    data[place] ^= 1
    path.write_bytes(data)


@pytest.mark.soak
def test_what_is_damaged_is_found_and_repaired(recipe_file, whole, tmp_path):
    folder = tmp_path / "garages"
    shutil.copytree(whole[0], folder)
    assert dataset("--verify", folder).stdout.startswith("Nothing is wrong")
    manifest = folder / "manifest.parquet"
    manifest.write_bytes(manifest.read_bytes()[:1000])
    asset = min((folder / "assets").glob("Column_*.usdc"))
    flipped(asset, 500)
    flipped(folder / "shards" / "train-000001.tar", 5000)
    flipped(folder / "plans.parquet", 300)
    (folder / "shards" / "test-000000.jsonl").unlink()
    (folder / "shards" / "notes.txt").write_text("mine")
    found = dataset("--verify", folder, "--workers", 1, check=False)
    assert found.returncode == 1
    for name in (
        "manifest.parquet: is not as", f"assets/{asset.name}: is not as", "shards/train-000001.tar: is not as",
        "shards/test-000000.jsonl: is missing", "shards/notes.txt: is not of this data set",
    ):  # fmt: skip
        assert name in found.stdout
    (folder / "shards" / "notes.txt").unlink()
    dataset(recipe_file, "-o", folder, "--workers", 1, "--resume")
    assert tree_of(folder) == whole[1]


def test_verifying_compares_rows_plans_and_stages(whole, tmp_path):
    folder = tmp_path / "garages"
    shutil.copytree(whole[0], folder)
    # as if somebody had replaced a garage by another one and made the sums anew
    plans = pq.read_table(folder / "plans.parquet").to_pylist()
    table = pq.read_table(folder / "plans.parquet")
    twice = [{**row, **{key: plans[0][key] for key in ("rows", "column_widths_mm", "row_depths_mm")}} for row in plans]
    pq.write_table(table.from_pylist(twice, schema=table.schema), folder / "plans.parquet")
    sums = folder / "SHA256SUMS"
    sums.write_text("".join(f"{digest}  {name}\n" for name, digest in tree_of(folder).items() if name != sums.name))
    found = dataset("--verify", folder, "--workers", 1, check=False)
    assert found.returncode == 1
    assert "has another plan in plans.parquet" in found.stdout
    assert "has the plan of" in found.stdout


@pytest.mark.soak
def test_a_disk_that_is_full_ends_in_one_error_and_the_run_goes_on_when_there_is_room(recipe_file, whole, tmp_path):
    folder = tmp_path / "garages"
    limit = "import resource, sys; resource.setrlimit(resource.RLIMIT_FSIZE, (100_000, 100_000));"
    run = f"{limit} from garage2usd.cli import run; run()"
    done = subprocess.run(
        [sys.executable, "-c", run, "dataset", str(recipe_file), "-o", str(folder)],
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 1
    # a slow machine tells the progress before
    assert re.fullmatch(r"((plans|garages): .*\n)*Error: .*: File too large\n", done.stderr)
    assert not list((folder / "shards").glob("*.tar"))
    dataset(recipe_file, "-o", folder, "--workers", 1, "--resume")
    assert tree_of(folder) == whole[1]


def test_sha256sum_agrees(whole):
    command = ["sha256sum", "--check", "--strict", "SHA256SUMS"]
    done = subprocess.run(command, cwd=whole[0], capture_output=True, text=True, check=False)
    assert done.returncode == 0
    assert done.stdout.count(": OK\n") == len(whole[1]) - 1


def test_the_lines_of_the_data_card_load_it(whole, tmp_path):
    folder = tmp_path / "garages"
    shutil.copytree(whole[0], folder)
    card = (folder / "README.md").read_text()
    subprocess.run(re.search(r"`(tar -xf .*)`", card)[1].split(), cwd=folder, check=True)
    blocks = re.findall(r"```python\n(.*?)```", card, re.DOTALL)
    assert len(blocks) == 3
    said = """
import json
print(json.dumps(dict(
    rows=garages_of_table.num_rows, keys=garages_of_table["key"][:],
    samples=[[garage["__key__"], sorted(garage)] for garage in webdataset.WebDataset(
        sorted(glob.glob("shards/train-*.tar")), shardshuffle=False)],
    seed=json.loads(report)["seed"], prims=len(list(stage.Traverse())),
)))
"""
    script = "\n".join([blocks[0], "garages_of_table = garages", *blocks[1:], said])
    environment = {**os.environ, "HF_HUB_OFFLINE": "1", "HF_HOME": str(tmp_path / "cache")}
    done = subprocess.run(
        [sys.executable, "-c", script], cwd=folder, env=environment, capture_output=True, text=True, check=False
    )
    assert done.returncode == 0, done.stderr
    found = json.loads(done.stdout.splitlines()[-1])
    rows = pq.read_table(folder / "manifest.parquet").to_pylist()
    train = [row for row in rows if row["split"] == "train"]
    assert found["rows"] == len(train) == 4
    assert found["keys"] == [row["key"] for row in train]
    assert sorted(key for key, _ in found["samples"]) == sorted(found["keys"])
    for key, kinds in found["samples"]:
        row = next(row for row in train if row["key"] == key)
        assert {kind for kind in kinds if not kind.startswith("__")} == {
            file["suffix"].removeprefix(".").lower() for file in row["files"]
        }
    assert found["seed"] in {row["seed"] for row in train}
    assert found["prims"] > 100


@pytest.mark.soak
def test_the_lines_of_the_data_card_load_a_set_that_is_compressed(tmp_path):
    grid = {"maps": {"grid": {"resolution_m": 0.5, "keepout": True}}}
    settings = {**SMALL, "count": 2, "splits": {"part": 1}, "garage": {**SMALL["garage"], **grid}}
    recipe = tmp_path / "recipe.json"
    recipe.write_text(Recipe(**settings, make={"gzip": True, "exports": ["yaml"], "labels": False}).record())
    folder = tmp_path / "garages"
    dataset(recipe, "-o", folder, "--workers", 1)
    assert dataset("--verify", folder, "--workers", 1).stdout.startswith("Nothing is wrong")
    block = re.findall(r"```python\n(.*?)```", (folder / "README.md").read_text(), re.DOTALL)[1]
    said = """
import json
print(json.dumps([json.loads(report)["seed"], sorted(garage)]))
"""
    done = subprocess.run([sys.executable, "-c", block + said], cwd=folder, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    seed, kinds = json.loads(done.stdout)
    last = pq.read_table(folder / "manifest.parquet").to_pylist()[-1]
    assert seed == last["seed"]
    assert {kind for kind in kinds if not kind.startswith("__")} == {
        file["suffix"].removeprefix(".").lower() for file in last["files"]
    }
    assert {"yaml.gz", "pgm", "keepout.yaml.gz", "keepout.pgm", "report.json.gz"} <= set(kinds)


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        (["RECIPE", "-o", "garages", "--scheduler", "tcp://127.0.0.1:9"], "scheduler: got"),
        (["RECIPE", "-o", "garages", "--scheduler", "nonsense"], "scheduler: got"),
        (["missing.toml", "-o", "garages"], "RECIPE: got"),
        (["RECIPE", "-o", "full"], "output: got"),
        (["--verify", "full"], "verify: got"),
        (["--verify", "half"], "verify: got"),
        (["RECIPE"], "--output"),
        (["RECIPE", "-o", "garages", "--verify", "full"], "alone"),
    ],
)
def test_what_cannot_be_done_is_said_in_one_error(recipe_file, tmp_path, monkeypatch, arguments, said):
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr(cluster_of_dask, "_CONNECT_S", 1.0)
    for name, file in (("full", "mine.txt"), ("half", "recipe.json")):
        (tmp_path / name).mkdir()
        (tmp_path / name / file).write_text("mine")
    before = tree_of(tmp_path)
    words = [str(recipe_file) if word == "RECIPE" else word for word in arguments]
    done = CliRunner().invoke(main, ["dataset", *words])
    assert done.exit_code in {1, 2}, done.exception
    assert said in done.stderr
    assert tree_of(tmp_path) == before
    assert not (tmp_path / "garages").exists()
