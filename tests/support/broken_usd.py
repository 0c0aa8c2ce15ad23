"""A small stage of the shape of ours with one mistake, and the rule of USD meant for it."""

from PIL import Image
from pxr import Usd

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
