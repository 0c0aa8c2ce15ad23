"""No stage of ours breaks a rule of USD, and a stage with one mistake breaks the one rule meant for it."""

import pytest
from PIL import Image
from pxr import Usd, UsdPhysics
from support.sample_files import each_build

from garage2usd.checks import check
from garage2usd.checks.consistency import BOOK as CONSISTENCY
from garage2usd.checks.stage_reader import subject_of_stage
from garage2usd.checks.usd import BOOK
from garage2usd.profiles import Profile

NO_CLAUSES = Profile(name="none")
RULES = {rule.name: rule for rule in BOOK.rules}
VALIDATORS = "usd-validation"  # proven on the samples by tests/clients/test_validators.py


def prims_of(stage):
    return Usd.PrimRange(stage.GetPseudoRoot(), Usd.TraverseInstanceProxies())


@each_build
def test_stages_break_no_rule(sample, extension, builds):
    stage = Usd.Stage.Open(str(builds(sample, extension).stage))
    assert stage.GetDefaultPrim().GetPath() == "/Garage"
    assert not [prim for prim in prims_of(stage) if prim.HasAPI(UsdPhysics.RigidBodyAPI)]
    subject = subject_of_stage(stage, source=sample.stem)
    rules = [rule for rule in (*RULES.values(), *CONSISTENCY.rules) if rule.name != VALIDATORS]
    assert [finding for rule in rules for finding in rule.findings(subject, NO_CLAUSES)] == []


# A small stage of the shape of ours, for one mistake at a time.

ASSET = """#usda 1.0
(
    defaultPrim = "Box"
    metersPerUnit = 1
    upAxis = "Y"
)
def Xform "Box" (
    prepend apiSchemas = ["SemanticsLabelsAPI:class"]
)
{
    token[] semantics:labels:class = ["box"]
    def Mesh "Mesh" (
        prepend apiSchemas = ["PhysicsCollisionAPI", "PhysicsMeshCollisionAPI", "MaterialBindingAPI"]
    )
    {
        uniform token physics:approximation = "boundingCube"
        rel material:binding = </Box/Look>
    }
    def Material "Look"
    {
        def Shader "Texture"
        {
            asset inputs:file = @./texture.png@
        }
    }
}
"""
ROOT = """#usda 1.0
(
    defaultPrim = "Garage"
    metersPerUnit = 1
    upAxis = "Y"
)
def Xform "Garage"
{
    def Xform "Group"
    {
        def "Box_1" (
            instanceable = true
            prepend references = @./box.usda@
        )
        {
        }
    }
}
"""
MESH_SCHEMAS = '["PhysicsCollisionAPI", "PhysicsMeshCollisionAPI", "MaterialBindingAPI"]'
BROKEN = {
    "rigid body in a rigid body": (
        "nested-rigid-body",
        [
            ('def Xform "Group"', 'def Xform "Group" ( prepend apiSchemas = ["PhysicsRigidBodyAPI"] )'),
            ('["SemanticsLabelsAPI:class"]', '["SemanticsLabelsAPI:class", "PhysicsRigidBodyAPI"]'),
        ],
    ),
    "bogus approximation": ("collider-approximation", [('"boundingCube"', '"roundingCube"')]),
    "no approximation": ("collider-approximation", [('uniform token physics:approximation = "boundingCube"', "")]),
    "approximation without its schema": ("collider-approximation", [('"PhysicsMeshCollisionAPI", ', "")]),
    "collider on an Xform": (
        "collider-without-shape",
        [('["SemanticsLabelsAPI:class"]', '["SemanticsLabelsAPI:class", "PhysicsCollisionAPI"]')],
    ),
    "no labels": ("empty-label", [('["box"]', "[]")]),
    "a label without letters": ("empty-label", [('["box"]', '["box", ""]')]),
    "labels never written": ("empty-label", [('token[] semantics:labels:class = ["box"]', "")]),
    "labels without their schema": (
        "label-without-schema",
        [('prepend apiSchemas = ["SemanticsLabelsAPI:class"]', "")],
    ),
    "an opinion inside an instance": (
        "opinion-in-instance",
        [("        {\n        }", '        {\n            over "Mesh"\n{\n}\n        }')],
    ),
    "an absolute texture": ("absolute-path", [("@./texture.png@", "@/home/me/texture.png@")]),
    "an absolute texture on Windows": ("absolute-path", [("@./texture.png@", "@C:/me/texture.png@")]),
    "an absolute asset": ("absolute-path", [("@./box.usda@", "@{folder}/box.usda@")]),
    "a mesh without material": ("unbound-mesh", [("rel material:binding = </Box/Look>", "")]),
}


def open_small_stage(folder, changes=()):
    root, asset = ROOT, ASSET
    for old, new in changes:
        assert root.count(old) + asset.count(old) == 1
        root, asset = (text.replace(old, new.replace("{folder}", str(folder))) for text in (root, asset))
    Image.new("RGB", (2, 2)).save(folder / "texture.png")
    (folder / "box.usda").write_text(asset)
    (folder / "garage.usda").write_text(root)
    return Usd.Stage.Open(str(folder / "garage.usda"))


def rules_broken(stage):
    """Rules that a stage breaks, apart from being no garage."""
    return {finding.rule for finding in check(subject_of_stage(stage, source=""), NO_CLAUSES)} - {"lane-graph"}


def test_the_small_stage_breaks_no_rule(tmp_path):
    stage = open_small_stage(tmp_path)
    assert [prim for prim in prims_of(stage) if prim.HasAPI(UsdPhysics.CollisionAPI)]
    assert rules_broken(stage) == set()


@pytest.mark.parametrize(("rule", "changes"), BROKEN.values(), ids=BROKEN)
def test_a_broken_stage_breaks_one_rule(rule, changes, tmp_path):
    assert rules_broken(open_small_stage(tmp_path, changes)) == {rule}
