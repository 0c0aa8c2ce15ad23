"""Looks of prims: what is the same is found once, and what only seems the same is told apart."""

import pytest
from pxr import Usd

from garage2usd.scenes.looks import MeshLooks

ASSET = """#usda 1.0
(
    defaultPrim = "Asset"
)
def Xform "Asset"
{
    class "Base"
    {
    }
    def Material "Look"
    {
        token outputs:surface.connect = </Asset/Look/Surface.outputs:surface>
        def Shader "Surface"%s
        {
            uniform token info:id = "UsdPreviewSurface"
            token outputs:surface
        }
    }
    def Mesh "Sheet" (
        prepend apiSchemas = ["MaterialBindingAPI"]
    )
    {
        rel material:binding = </Asset/Look>
        int[] faceVertexCounts = [3]
        int[] faceVertexIndices = [0, 1, 2]
        point3f[] points = [(0, 0, 0), (1, 0, 0), (0, 1, 0)]
    }
}
"""
STAGE = """#usda 1.0
def "One" (
    references = @asset.usda@
)
{
}
def "Other" (
    references = @asset.usda@
)
{
%s
}
"""
GREY, RED = (0.18, 0.18, 0.18), (1.0, 0.0, 0.0)
MADE_RED = "{\n color3f inputs:diffuseColor = (1, 0, 0)\n}\n"
INHERITS = " (\n inherits = </Asset/Base>\n)"


@pytest.mark.parametrize(
    ("arc", "edit", "colours"),
    [
        ("", "", [GREY]),
        ("", f'over "Look"\n{{\n over "Surface"\n{MADE_RED}}}', [GREY, RED]),
        (INHERITS, "", [GREY]),
        (INHERITS, f'over "Base"\n{MADE_RED}', [GREY, RED]),
    ],
    ids=["alike", "a shader edited in place", "alike with a class", "a class edited from afar"],
)
def test_materials_are_one_if_they_are_made_of_the_same_opinions(tmp_path, arc, edit, colours):
    (tmp_path / "asset.usda").write_text(ASSET % arc)
    (tmp_path / "stage.usda").write_text(STAGE % edit)
    stage = Usd.Stage.Open(str(tmp_path / "stage.usda"))
    looks = MeshLooks()
    drawn = [looks.of_prim(stage.GetPrimAtPath(f"/{name}/Sheet")) for name in ("One", "Other")]
    assert [surface.colour_rgb for surface in looks.surfaces.values] == [pytest.approx(colour) for colour in colours]
    assert [surface for ((_, surface, _),) in drawn] == [0, len(colours) - 1]
    assert len(looks.meshes.values) == 1
