"""Strangers' validators find nothing, and our own checks find nothing of what those miss."""

import csv
import shutil
import subprocess
import sys
from pathlib import Path

import pytest
from pxr import Usd, UsdGeom, UsdPhysics, UsdShade, UsdUtils, UsdValidation
from sample_files import each_format, each_sample

pytestmark = pytest.mark.client


@each_sample
@each_format
def test_usd_validation_finds_nothing(sample, extension, builds):
    build = builds(sample, extension)
    stage = Usd.Stage.Open(str(build.stage))
    registry = UsdValidation.ValidationRegistry()
    context = UsdValidation.ValidationContext(registry.GetOrLoadAllValidators())
    findings = context.Validate(stage)
    assert [f"{f.GetName()} {f.GetMessage()}" for f in findings] == []


@each_sample
@each_format
def test_nvidia_validation_finds_nothing(sample, extension, builds, tmp_path):
    build = builds(sample, extension)
    command = shutil.which("nvidia_usd_validate", path=str(Path(sys.executable).parent))
    output = tmp_path / "findings.csv"
    run = subprocess.run(
        [command, str(build.stage), "--csv-output", str(output)],
        capture_output=True,
        text=True,
        timeout=600,
        check=False,
    )
    with output.open() as file:
        findings = list(csv.DictReader(file))
    assert findings == [], run.stdout[-2000:]


@each_sample
@each_format
def test_what_the_validators_miss(sample, extension, builds):
    stage = Usd.Stage.Open(str(builds(sample, extension).stage))
    assert stage.GetDefaultPrim().GetPath() == "/Garage"
    for prim in Usd.PrimRange(stage.GetPseudoRoot(), Usd.TraverseInstanceProxies()):
        if prim.HasAPI(UsdPhysics.CollisionAPI):
            assert prim.IsA(UsdGeom.Mesh), prim
            token = UsdPhysics.MeshCollisionAPI(prim).GetApproximationAttr().Get()
            assert token in {"none", "boundingCube", "convexHull"}, prim
        assert not prim.HasAPI(UsdPhysics.RigidBodyAPI), prim
        for attribute in prim.GetAttributes():
            if attribute.GetName().startswith("semantics:labels:"):
                assert attribute.Get(), attribute
        if prim.IsA(UsdGeom.Mesh):
            assert UsdShade.MaterialBindingAPI(prim).ComputeBoundMaterial()[0], prim
    for layer in stage.GetUsedLayers():
        for external in UsdUtils.ExtractExternalReferences(layer.identifier):
            assert not any(Path(path).is_absolute() for path in external), layer
    # an opinion inside an instance is silently ignored
    for prim in stage.Traverse():
        if prim.IsInstance():
            assert not list(prim.GetPrimStack()[0].nameChildren), prim
