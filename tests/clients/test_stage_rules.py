"""Our own rules for what the validators let pass, each proven on a stage that breaks it."""

from pathlib import Path, PureWindowsPath

import pytest
from pxr import Sdf, Usd, UsdGeom, UsdPhysics, UsdShade, UsdUtils
from sample_files import each_format, each_sample

LABELS = "semantics:labels"
APPROXIMATIONS = {"none", "boundingCube", "convexHull"}


def prims_of(stage):
    return Usd.PrimRange(stage.GetPseudoRoot(), Usd.TraverseInstanceProxies())


def nested_rigid_bodies(stage):
    for prim in prims_of(stage):
        if prim.HasAPI(UsdPhysics.RigidBodyAPI):
            above = prim.GetParent()
            while above and not above.HasAPI(UsdPhysics.RigidBodyAPI):
                above = above.GetParent()
            if above:
                yield prim.GetPath()


def unknown_approximations(stage):
    """A collision mesh that names no approximation or one that physics engines do not know."""
    for prim in prims_of(stage):
        if prim.HasAPI(UsdPhysics.CollisionAPI) and prim.IsA(UsdGeom.Mesh):
            token = UsdPhysics.MeshCollisionAPI(prim).GetApproximationAttr()
            named = prim.HasAPI(UsdPhysics.MeshCollisionAPI) and token.HasAuthoredValue()
            if not named or token.Get() not in APPROXIMATIONS:
                yield prim.GetPath()


def colliders_without_shape(stage):
    for prim in prims_of(stage):
        if prim.HasAPI(UsdPhysics.CollisionAPI) and not prim.IsA(UsdGeom.Gprim):
            yield prim.GetPath()


def empty_labels(stage):
    for prim in prims_of(stage):
        for schema in prim.GetAppliedSchemas():
            if schema.startswith("SemanticsLabelsAPI:"):
                labels = prim.GetAttribute(f"{LABELS}:{schema.partition(':')[2]}").Get()
                if not labels or not all(labels):
                    yield prim.GetPath()


def labels_without_schema(stage):
    """A reader that asks for the schema does not find these."""
    for prim in prims_of(stage):
        schemas = prim.GetAppliedSchemas()
        for label in prim.GetAuthoredPropertiesInNamespace(LABELS):
            if f"SemanticsLabelsAPI:{label.GetBaseName()}" not in schemas:
                yield label.GetPath()


def opinions_inside_instances(stage):
    """Composition ignores what a layer says below a prim that it makes an instance."""
    for layer in stage.GetUsedLayers():
        found = []

        def visit(path, layer=layer, found=found):
            spec = layer.GetPrimAtPath(path) if path.IsPrimPath() else None
            if spec is not None and spec.instanceable and spec.nameChildren:
                found.append(path)

        layer.Traverse(Sdf.Path.absoluteRootPath, visit)
        yield from found


def absolute_paths(stage):
    for layer in stage.GetUsedLayers():
        for paths in UsdUtils.ExtractExternalReferences(layer.identifier):
            yield from (path for path in paths if Path(path).is_absolute() or PureWindowsPath(path).is_absolute())


def unbound_meshes(stage):
    for prim in prims_of(stage):
        if prim.IsA(UsdGeom.Mesh) and not UsdShade.MaterialBindingAPI(prim).ComputeBoundMaterial()[0]:
            yield prim.GetPath()


RULES = [
    nested_rigid_bodies,
    unknown_approximations,
    colliders_without_shape,
    empty_labels,
    labels_without_schema,
    opinions_inside_instances,
    absolute_paths,
    unbound_meshes,
]


@each_sample
@each_format
def test_stages_break_no_rule(sample, extension, builds):
    stage = Usd.Stage.Open(str(builds(sample, extension).stage))
    assert stage.GetDefaultPrim().GetPath() == "/Garage"
    assert not [prim for prim in prims_of(stage) if prim.HasAPI(UsdPhysics.RigidBodyAPI)]
    assert {rule.__name__: list(rule(stage)) for rule in RULES} == {rule.__name__: [] for rule in RULES}


# A small stage of the shape of ours, for one mistake at a time.

ASSET = """#usda 1.0
( defaultPrim = "Box" )
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
( defaultPrim = "Garage" )
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
        nested_rigid_bodies,
        [
            ('def Xform "Group"', 'def Xform "Group" ( prepend apiSchemas = ["PhysicsRigidBodyAPI"] )'),
            ('["SemanticsLabelsAPI:class"]', '["SemanticsLabelsAPI:class", "PhysicsRigidBodyAPI"]'),
        ],
    ),
    "bogus approximation": (unknown_approximations, [('"boundingCube"', '"roundingCube"')]),
    "no approximation": (unknown_approximations, [('uniform token physics:approximation = "boundingCube"', "")]),
    "approximation without its schema": (unknown_approximations, [('"PhysicsMeshCollisionAPI", ', "")]),
    "collider on an Xform": (
        colliders_without_shape,
        [('["SemanticsLabelsAPI:class"]', '["SemanticsLabelsAPI:class", "PhysicsCollisionAPI"]')],
    ),
    "no labels": (empty_labels, [('["box"]', "[]")]),
    "a label without letters": (empty_labels, [('["box"]', '["box", ""]')]),
    "labels never written": (empty_labels, [('token[] semantics:labels:class = ["box"]', "")]),
    "labels without their schema": (
        labels_without_schema,
        [('prepend apiSchemas = ["SemanticsLabelsAPI:class"]', "")],
    ),
    "an opinion inside an instance": (
        opinions_inside_instances,
        [("        {\n        }", '        {\n            over "Mesh"\n{\n}\n        }')],
    ),
    "an absolute texture": (absolute_paths, [("@./texture.png@", "@/home/me/texture.png@")]),
    "an absolute texture on Windows": (absolute_paths, [("@./texture.png@", "@C:/me/texture.png@")]),
    "an absolute asset": (absolute_paths, [("@./box.usda@", "@{folder}/box.usda@")]),
    "a mesh without material": (unbound_meshes, [("rel material:binding = </Box/Look>", "")]),
}


def open_small_stage(folder, changes=()):
    root, asset = ROOT, ASSET
    for old, new in changes:
        assert root.count(old) + asset.count(old) == 1
        root, asset = (text.replace(old, new.replace("{folder}", str(folder))) for text in (root, asset))
    (folder / "box.usda").write_text(asset)
    (folder / "garage.usda").write_text(root)
    return Usd.Stage.Open(str(folder / "garage.usda"))


def test_the_small_stage_breaks_no_rule(tmp_path):
    stage = open_small_stage(tmp_path)
    assert [prim for prim in prims_of(stage) if prim.HasAPI(UsdPhysics.CollisionAPI)]
    assert {rule.__name__: list(rule(stage)) for rule in RULES} == {rule.__name__: [] for rule in RULES}


@pytest.mark.parametrize(("rule", "changes"), BROKEN.values(), ids=BROKEN)
def test_a_broken_stage_breaks_one_rule(rule, changes, tmp_path):
    stage = open_small_stage(tmp_path, changes)
    assert [broken.__name__ for broken in RULES if list(broken(stage))] == [rule.__name__]


def test_every_rule_has_a_stage_that_breaks_it():
    assert {rule for rule, _ in BROKEN.values()} == set(RULES)
