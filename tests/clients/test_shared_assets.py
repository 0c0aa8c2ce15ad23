"""Clients see the same in a stage whose assets are in a folder that garages share as in one that has its own."""

import importlib.util
import json
import subprocess
import sys
from pathlib import Path

import pytest
from support.newton_reader import needs_newton, running_newton
from support.small_garage import SETTINGS

from garage2usd import GarageConfig, build

pytestmark = pytest.mark.client


@pytest.fixture(scope="module", params=["instanced", "nested"])
def both(request, tmp_path_factory):
    """A garage with assets of its own, and the same one with shared assets."""

    def one(place):
        stage = {**SETTINGS["stage"], "form": request.param, "assets": place}
        return build(GarageConfig(**{**SETTINGS, "stage": stage}), tmp_path_factory.mktemp(place) / "a" / "g.usdc")

    return one("own"), one("shared")


@pytest.mark.soak
@needs_newton
def test_newton_finds_the_same_colliders(both):
    with running_newton() as load:
        own, shared = (load(made.stage) for made in both)
    assert own["shapes"]
    assert shared == own


def blender_dump(made, folder):
    output = folder / f"{made.garage.config.stage.assets}.json"
    command = [sys.executable, str(Path(__file__).with_name("blender_dump.py")), str(made.stage), str(output)]
    subprocess.run(command, check=True, capture_output=True, timeout=600)
    return json.loads(output.read_text())


@pytest.mark.skipif(importlib.util.find_spec("bpy") is None, reason="Blender's bpy is made for Python 3.11 only")
def test_blender_finds_the_same_objects_and_reads_all_images(both, tmp_path):
    own, shared = (blender_dump(made, tmp_path) for made in both)
    assert own["drawn"]
    assert all(image["read"] for image in shared["images"])
    # in which order depends on Blender's threads
    for key in ("objects", "drawn", "images"):
        assert sorted(map(str, shared[key])) == sorted(map(str, own[key]))
