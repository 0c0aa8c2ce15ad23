"""NVIDIA's validator of SimReady assets finds what is written in docs/stage.md, and nothing else."""

import json
import os
import re
import subprocess
from pathlib import Path

import pytest
from pxr import Usd, UsdShade
from support.sample_files import REPOSITORY
from support.small_garage import SETTINGS

import garage2usd

VALIDATOR = (
    Path(os.environ.get("GARAGE2USD_SIMREADY", REPOSITORY / ".venv/simready/bin/python")).parent / "simready-validate"
)
pytestmark = [
    pytest.mark.client,
    pytest.mark.skipif(not VALIDATOR.is_file(), reason=".venv/simready is not there"),
]
OF_EVERY_ASSET = {"NP.005", "RB.001", "SR.002", "SR.004", "UN.006"}
OF_EVERY_STAGE = OF_EVERY_ASSET - {"NP.005", "UN.006"} | {"VG.025", "NP.006", "SR.001", "RV.001", "RV.004", "RV.007"}
OF_SOME_ASSETS = {"GSP.001", "NVM.002", "VM.MDL.003", "VM.PBR.001", "VM.TEX.003"}


CLUTTER = ("people", "bicycles", "motorbikes", "trolleys", "prams", "bins", "boxes", "pallets", "bags", "open_boots")


@pytest.fixture(scope="module")
def assets(builds, tmp_path_factory):
    """One asset of each kind of object, by the kind."""
    made = builds(REPOSITORY / "samples" / "paper_7x9.toml", "usdc", "instanced")
    small = {"height_cells": 5, "width_cells": 5}
    config = garage2usd.GarageConfig(
        seed=4, site=small, clutter=dict.fromkeys(CLUTTER, 12.0), stage={"form": "instanced", "texture_quality": "low"}
    )
    crowded = garage2usd.build(config, tmp_path_factory.mktemp("crowded") / "garage.usdc")
    found = {}
    for folder in (made.asset_folder, crowded.asset_folder):
        for file in sorted(folder.glob("*_*.usdc")):
            found.setdefault(file.name.partition("_")[0], file)
    assert found.keys() >= {
        "Person",
        "Bicycle",
        "Motorbike",
        "Trolley",
        "Pram",
        "WasteBin",
        "CardboardBox",
        "Pallet",
        "Bag",
    }
    assert len(found) > 30
    return found


def findings_of(files, folder):
    """The codes of the requirements that each of some files misses."""
    listed, output = folder / "assets.txt", folder / "findings.json"
    listed.write_text("".join(f"{file}\n" for file in files))
    command = [VALIDATOR, "--profile", "Robotics-Prop", "--asset_list", listed, "--output", output]
    inherited = {name: value for name, value in os.environ.items() if name != "PYTHONPATH"}
    run = subprocess.run(command, capture_output=True, text=True, timeout=600, check=False, env=inherited, cwd=folder)
    assert output.is_file(), run.stderr[-2000:]
    assert json.loads(output.read_text())
    found = {}
    for part in run.stdout.split("Asset: ")[1:]:
        file, _, said = part.partition("\n")
        found[Path(file.strip())] = set(re.findall(r"com\.nvidia\.simready\.([A-Z.]+\.\d+)", said))
    return found


@pytest.mark.soak
def test_simready_finds_what_is_documented(assets, tmp_path):
    named = findings_of(assets.values(), tmp_path)
    found = {file.name.partition("_")[0]: findings for file, findings in named.items()}
    assert found.keys() == assets.keys()
    for kind, findings in found.items():
        assert findings - OF_SOME_ASSETS == OF_EVERY_ASSET, kind
    assert {kind for kind, findings in found.items() if "NVM.002" in findings} == {"Sky"}
    assert {kind for kind, findings in found.items() if "VM.TEX.003" in findings} == {"FloorStain"}
    text = (REPOSITORY / "docs" / "stage.md").read_text()
    assert all(f"| `{code}` |" in text for code in OF_EVERY_ASSET | OF_SOME_ASSETS)


@pytest.mark.soak
def test_simready_finds_of_a_garage_whose_z_points_up_what_is_documented(tmp_path):
    config = garage2usd.GarageConfig(**{**SETTINGS, "stage": {"texture_quality": "low", "up_axis": "Z"}})
    # as it asks, in a folder of its own within one that is named like the file
    made = garage2usd.build(config, tmp_path / "garage" / "usd" / "garage.usdc")
    found = set.union(*findings_of([made.stage], tmp_path).values())
    assert found == OF_EVERY_STAGE | OF_SOME_ASSETS
    text = (REPOSITORY / "docs" / "stage.md").read_text()
    assert all(re.search(rf"^\| .*`{code}`.* \|", text, re.MULTILINE) for code in OF_EVERY_STAGE)


def test_materials_and_display_colours_tell_what_things_are(assets):
    said = {}
    for kind, file in assets.items():
        stage = Usd.Stage.Open(str(file))
        for prim in stage.Traverse():
            if prim.IsA(UsdShade.Material) and "PhysicsMaterialAPI" not in prim.GetAppliedSchemas():
                base, coating, attributes = (
                    prim.GetAttribute(f"omni:simready:nonvisual:{name}").Get()
                    for name in ("base", "coating", "attributes")
                )
                assert list(prim.GetAttribute("semantics:labels:material").Get()) == [base]
                assert said.setdefault(prim.GetName(), (base, coating, *attributes)) == (base, coating, *attributes)
        colours = stage.GetDefaultPrim().GetAttribute("primvars:displayColor").Get()
        assert len(colours) == 1
        assert all(0 <= channel <= 1 for channel in colours[0]), kind
    assert said["FloorConcrete"] == ("concrete", "none", "none")
    assert said["PaintWhite"] == ("concrete", "paint", "none")
    assert said["CarPaint"] == ("steel", "paint_clearcoat", "none")
    assert said["Glass"] == ("clear_glass", "none", "visually_transparent")
    assert said["TubeGlow"] == ("plexiglass", "none", "emissive")
    assert said["NumberPlate"] == ("aluminum", "paint", "retroreflective")
    assert said["Tyre"] == ("rubber", "none", "none")
    assert said["SteelGalvanised"] == ("steel", "none", "none")


def test_a_car_is_displayed_in_its_paint(assets):
    stage = Usd.Stage.Open(str(assets["Car"]))
    paints = stage.GetDefaultPrim().GetVariantSets().GetVariantSet("paint")
    seen = {}
    for paint in paints.GetVariantNames():
        paints.SetVariantSelection(paint)
        surface = stage.GetPrimAtPath("/Asset/Looks/CarPaint/Surface")
        seen[paint] = tuple(stage.GetDefaultPrim().GetAttribute("primvars:displayColor").Get()[0])
        assert seen[paint] == tuple(surface.GetAttribute("inputs:diffuseColor").Get())
    assert len(set(seen.values())) == len(seen) == 9


def test_the_floor_is_displayed_in_the_mean_of_its_texture(assets):
    from PIL import Image

    stage = Usd.Stage.Open(str(assets["Floor"]))
    colour = stage.GetDefaultPrim().GetAttribute("primvars:displayColor").Get()[0]
    texture = next(assets["Floor"].parent.glob("textures/floor_colour*.jpg"))
    values = [value / 255 for value in Image.open(texture).resize((1, 1), Image.Resampling.BOX).getpixel((0, 0))]
    linear = [
        ((value + 0.055) / 1.055) ** 2.4 for value in values
    ]  # of the mean, where the asset has the mean of these
    assert list(colour) == pytest.approx(linear, rel=0.05)
