"""The light that the layout predicts on the floor is what Blender traces there."""

import importlib.util
import json
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from support.sample_files import SAMPLES

from garage2usd.config import GarageConfig, load_config
from garage2usd.layout.ceiling.lighting import MAINTENANCE, direct_lux
from garage2usd.pipeline import build
from garage2usd.stage.prototype_layer import NITS_PER_INTENSITY
from garage2usd.structure.grid import Cell

pytestmark = [
    pytest.mark.client,
    pytest.mark.skipif(importlib.util.find_spec("bpy") is None, reason="Blender's bpy is made for Python 3.11 only"),
]

SIDE = 48


@pytest.fixture(scope="module")
def garage(tmp_path_factory):
    """A garage with little between its lights and its floor, as the prediction has it."""
    config = GarageConfig(
        bay={"dimensioned": False},
        parking={"occupancy": 0},
        fittings={"ducts": False, "stair_cores": False},
        plan={"episodes": 300},
    )
    return build(config, tmp_path_factory.mktemp("lux") / "garage.usdc")


@pytest.fixture(scope="module")
def measured(garage, tmp_path_factory):
    return measure(garage, tmp_path_factory.mktemp("lux"))


def measure(garage, folder):
    """Lux on SIDE x SIDE squares of the floor, direct and in all, of new tubes."""
    structure = garage.garage.layout.structure
    output = folder / "lux.json"
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


def places(structure):
    """Middles (x, z) of the squares of the floor that are measured; shape (SIDE, SIDE, 2)."""
    steps = (np.arange(SIDE) + 0.5) / SIDE
    x, z = structure.column_edges_m[-1] * steps, structure.row_edges_m[-1] * (1 - steps)
    return np.stack(np.meshgrid(x, z), axis=2)


def test_direct_light_is_as_predicted(garage, measured):
    layout = garage.garage.layout
    unit = direct_lux(places(layout.structure).reshape(-1, 2), layout.of_kind("light")) / MAINTENANCE
    predicted = (unit * layout.illuminance.luminance_nit).reshape(SIDE, SIDE)
    assert measured["direct"].mean() == pytest.approx(predicted.mean(), rel=0.08)
    assert np.corrcoef(measured["direct"].ravel(), predicted.ravel())[0, 1] > 0.9
    ratio = np.median(measured["direct"] / predicted)
    assert ratio == pytest.approx(1.0, abs=0.1)


def test_the_lumen_method_lies_between_direct_and_all_light(garage, measured):
    maintained = {name: MAINTENANCE * values.mean() for name, values in measured.items()}
    assert 0.9 * maintained["direct"] < garage.garage.layout.illuminance.lumen_method_lux < maintained["total"]


@pytest.mark.soak
def test_the_sample_is_as_bright_as_estimated(builds, tmp_path):
    """With its cars and ducts: the lanes by the point-by-point method, the whole floor by the lumen method."""
    sample = next(sample for sample in SAMPLES if sample.stem == "paper_7x9")
    garage = builds(sample, "usdc")
    structure, illuminance = garage.garage.layout.structure, garage.garage.layout.illuminance
    maintained = {name: MAINTENANCE * values for name, values in measure(garage, tmp_path).items()}
    x, z = np.moveaxis(places(structure), 2, 0)
    rows, cols = np.searchsorted(structure.row_edges_m, z) - 1, np.searchsorted(structure.column_edges_m, x) - 1
    cells = structure.cells[rows, cols]
    assert maintained["direct"][cells == Cell.LANE].mean() == pytest.approx(illuminance.lanes.mean, rel=0.1)
    inside = maintained["total"][cells != Cell.OBSTACLE].mean()
    assert inside == pytest.approx(illuminance.lumen_method_lux, rel=0.2)
    wanted = load_config(sample).fittings.lane_lux
    assert wanted <= maintained["total"][cells == Cell.LANE].mean() <= 1.5 * wanted
