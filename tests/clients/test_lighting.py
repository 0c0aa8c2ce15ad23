"""The light that the layout predicts on the floor is what Blender traces there."""

import importlib.util
import json
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

from garage2usd.config import GarageConfig
from garage2usd.layout import ObjectKind
from garage2usd.layout.lighting import MAINTENANCE, direct_lux
from garage2usd.pipeline import build
from garage2usd.stage.prototype_layer import NITS_PER_INTENSITY

pytestmark = [
    pytest.mark.client,
    pytest.mark.skipif(importlib.util.find_spec("bpy") is None, reason="Blender's bpy is made for Python 3.11 only"),
]

SIDE = 48


@pytest.fixture(scope="module")
def garage(tmp_path_factory):
    """A garage with little between its lights and its floor, as the prediction has it."""
    config = GarageConfig(parking={"occupancy": 0}, fittings={"ducts": False}, plan={"episodes": 300})
    return build(config, tmp_path_factory.mktemp("lux") / "garage.usdc")


@pytest.fixture(scope="module")
def measured(garage, tmp_path_factory):
    """Lux on SIDE x SIDE squares of the floor, direct and in all, of new tubes."""
    structure = garage.garage.layout.structure
    output = tmp_path_factory.mktemp("lux") / "lux.json"
    script = Path(__file__).with_name("blender_lux.py")
    size = [str(structure.column_edges_m[-1]), str(structure.row_edges_m[-1]), str(SIDE)]
    subprocess.run(
        [sys.executable, str(script), str(garage.stage), str(output), *size],
        check=True,
        capture_output=True,
        timeout=600,
    )
    # a bake of the diffuse light is irradiance over pi
    return {
        name: np.array(values) * np.pi * NITS_PER_INTENSITY for name, values in json.loads(output.read_text()).items()
    }


def test_direct_light_is_as_predicted(garage, measured):
    layout = garage.garage.layout
    width, depth = layout.structure.column_edges_m[-1], layout.structure.row_edges_m[-1]
    steps = (np.arange(SIDE) + 0.5) / SIDE
    points = np.array([(x, z) for z in depth * (1 - steps) for x in width * steps])
    unit = direct_lux(points, layout.of_kind(ObjectKind.LIGHT)) / MAINTENANCE
    predicted = (unit * layout.illuminance.luminance_nit).reshape(SIDE, SIDE)
    assert measured["direct"].mean() == pytest.approx(predicted.mean(), rel=0.08)
    assert np.corrcoef(measured["direct"].ravel(), predicted.ravel())[0, 1] > 0.9
    ratio = np.median(measured["direct"] / predicted)
    assert ratio == pytest.approx(1.0, abs=0.1)


def test_the_lumen_method_lies_between_direct_and_all_light(garage, measured):
    maintained = {name: MAINTENANCE * values.mean() for name, values in measured.items()}
    assert 0.9 * maintained["direct"] < garage.garage.layout.illuminance.lumen_method_lux < maintained["total"]
