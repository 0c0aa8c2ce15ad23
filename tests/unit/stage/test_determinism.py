"""The same configuration, seed and version give the same bytes, whatever the hash seed, heap, time and time zone."""

import json
import os
import subprocess
import sys
from pathlib import Path

import pytest
from support.sample_files import REPOSITORY
from support.small_garage import PLAN
from support.soak import soak_but

SCRIPT = """
import ctypes, random, sys
from pathlib import Path
# a heap with holes, as USD orders some things by the addresses of their names
libc = ctypes.CDLL(None)
libc.malloc.restype, libc.free.argtypes = ctypes.c_void_p, [ctypes.c_void_p]
random.seed(sys.argv[3])
blocks = [libc.malloc(random.randint(16, 400)) for _ in range(100_000)]
random.shuffle(blocks)
for block in blocks[:70_000]:
    libc.free(block)
import garage2usd
config = garage2usd.load_config(sys.argv[1])
for extension in ("usda", "usdc", "usdz"):
    garage2usd.build(config, Path(sys.argv[2]) / f"g_{extension}.{extension}")
"""


SMALL = f'''
seed = 2
clutter = {{amount = "usual"}}
parking = {{occupancy = 0.5}}
plan = {{episodes = 50}}
site = {{structure = """{PLAN}"""}}
'''


@pytest.fixture(scope="module", params=soak_but(["small"], ["small", "paper_7x9", "irregular"]))
def twice(request, tmp_path_factory):
    folders = []
    small = tmp_path_factory.mktemp("small") / "small.toml"
    small.write_text(SMALL)
    for hash_seed, zone in (("1", "UTC"), ("77", "Asia/Tokyo")):
        folder = tmp_path_factory.mktemp(f"{request.param}_{hash_seed}")
        sample = small if request.param == "small" else REPOSITORY / "samples" / f"{request.param}.toml"
        environment = {**os.environ, "PYTHONHASHSEED": hash_seed, "TZ": zone}
        subprocess.run(
            [sys.executable, "-c", SCRIPT, str(sample), str(folder), hash_seed],
            check=True,
            env=environment,
            timeout=600,
        )
        folders.append(folder)
    return folders


def files(folder):
    return {path.relative_to(folder).as_posix(): path for path in sorted(Path(folder).rglob("*")) if path.is_file()}


def test_same_bytes(twice):
    first, second = (files(folder) for folder in twice)
    assert set(first) == set(second)
    assert {Path(name).suffix for name in first} == {".usda", ".usdc", ".usdz", ".png", ".jpg", ".json"}
    for name in first:
        if not name.endswith("_report.json"):
            assert first[name].read_bytes() == second[name].read_bytes(), name


def test_same_report_apart_from_timings(twice):
    for name in files(twice[0]):
        if name.endswith("_report.json"):
            reports = [json.loads((folder / name).read_text()) for folder in twice]
            assert all(report.pop("seconds") for report in reports)
            assert reports[0] == reports[1]
