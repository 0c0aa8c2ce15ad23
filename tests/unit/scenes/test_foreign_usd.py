"""Models of USD as other programs write them, beside pxr's own values."""

import io

import numpy as np
import pytest
from PIL import Image
from pxr import Usd, UsdGeom

from garage2usd.scenes.foreign_models import read_model

STAGE = """#usda 1.0
(
    defaultPrim = "Car"
    metersPerUnit = 0.01
    upAxis = "Z"
)
def Xform "Car" {{
    double3 xformOp:translate = (100, 200, 300)
    uniform token[] xformOpOrder = ["xformOp:translate"]
    {body}
    def Scope "Looks" {{
    {looks}
    }}
}}
"""
SQUARE = """
    def Mesh "{name}" (prepend apiSchemas = ["MaterialBindingAPI"]) {{
        int[] faceVertexCounts = [4]
        int[] faceVertexIndices = [0, 1, 2, 3]
        point3f[] points = [(0, 0, 0), (100, 0, 0), (100, 100, 0), (0, 100, 0)]
        uniform token subdivisionScheme = "none"
        {more}
    }}
"""
ST = 'texCoord2f[] primvars:st = [(0, 0), (1, 0), (1, 1), (0, 1)] (interpolation = "vertex")'
BOUND = f"{ST}\n rel material:binding = </Car/Looks/Paint>"
PREVIEW = 'uniform token info:id = "UsdPreviewSurface"\n token outputs:surface'
READER = """
    def Shader "Reader" {
        uniform token info:id = "UsdPrimvarReader_float2"
        string inputs:varname = "st"
        float2 outputs:result
    }
"""


def square(more="", name="Body"):
    return SQUARE.format(name=name, more=more)


def paint(inputs, nodes="", interface=""):
    return f"""
        def Material "Paint" {{
            {interface}
            token outputs:surface.connect = <Surface.outputs:surface>
            def Shader "Surface" {{
                {PREVIEW}
                {inputs}
            }}
            {nodes}
        }}
    """


def textured(said="", file="paint.png", st="</Car/Looks/Paint/Reader.outputs:result>"):
    """A picture as base colour."""
    return f"""{READER}
        def Shader "Picture" {{
            uniform token info:id = "UsdUVTexture"
            asset inputs:file = @./{file}@
            float2 inputs:st.connect = {st}
            {said}
            float3 outputs:rgb
            float outputs:r
        }}
    """


COLOURED = "color3f inputs:diffuseColor.connect = </Car/Looks/Paint/Picture.outputs:rgb>"


def read(tmp_path, body, looks=""):
    (tmp_path / "c.usda").write_text(STAGE.format(body=body, looks=looks))
    return read_model(tmp_path / "c.usda", field="models")


def only(model):
    (part,) = model.parts
    return part


def halves(tmp_path, left=(255, 0, 0), right=(0, 0, 255)):
    Image.fromarray(np.array([[left, right]], np.uint8)).save(tmp_path / "paint.png")


def area_m2(model):
    corners = np.concatenate([part.triangles_m for part in model.parts])
    across = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    return np.linalg.norm(across, axis=1).sum() / 2


def test_coordinates_that_vary_over_a_body_are_those_of_pxr_corner_by_corner(tmp_path):
    """Indexed, one for each corner, by the name that the reader gives, after two transforms."""
    halves(tmp_path)
    rng = np.random.default_rng(7)
    points = rng.uniform(-200, 200, (40, 3)).round(3)
    faces = np.stack([rng.permutation(40)[:3] for _ in range(60)])
    values, indices = rng.uniform(0, 1, (25, 2)).round(4), rng.integers(0, 25, 180)

    def rows(array):
        return ", ".join(str(tuple(row)) for row in array.tolist())

    body = f"""
    def Mesh "Body" (prepend apiSchemas = ["MaterialBindingAPI"]) {{
        int[] faceVertexCounts = {[3] * 60}
        int[] faceVertexIndices = {faces.ravel().tolist()}
        point3f[] points = [{rows(points)}]
        uniform token subdivisionScheme = "none"
        texCoord2f[] primvars:aaa = [(7, 7)] (interpolation = "constant")
        texCoord2f[] primvars:skin = [{rows(values)}] (interpolation = "faceVarying")
        int[] primvars:skin:indices = {indices.tolist()}
        rel material:binding = </Car/Looks/Paint>
    }}
    """
    moves = """
        def Shader "First" {
            uniform token info:id = "UsdTransform2d"
            float2 inputs:in.connect = </Car/Looks/Paint/Reader.outputs:result>
            float2 inputs:scale = (0.5, 2)
            float2 inputs:translation = (0.25, 0)
            float2 outputs:result
        }
        def Shader "Second" {
            uniform token info:id = "UsdTransform2d"
            float2 inputs:in.connect = </Car/Looks/Paint/First.outputs:result>
            float inputs:rotation = 90
            float2 outputs:result
        }
    """
    nodes = textured(st="</Car/Looks/Paint/Second.outputs:result>").replace('"st"', '"skin"') + moves
    part = only(read(tmp_path, body, paint(COLOURED, nodes)))
    stage = Usd.Stage.Open(str(tmp_path / "c.usda"))
    prim = stage.GetPrimAtPath("/Car/Body")
    told = np.array(UsdGeom.PrimvarsAPI(prim).GetPrimvar("skin").ComputeFlattened(), float).reshape(60, 3, 2)
    u, v = 0.5 * told[..., 0] + 0.25, 2 * told[..., 1]
    place = np.array(UsdGeom.XformCache().GetLocalToWorldTransform(prim))
    x, y, z = np.moveaxis(points[faces] @ place[:3, :3] + place[3, :3], -1, 0) / 100
    assert np.abs(part.triangles_m - np.stack([x, z, -y], axis=2)).max() < 1e-5
    assert np.abs(part.st - np.stack([-v, u], axis=2)).max() < 1e-6


def test_scale_and_bias_darken_a_picture_and_wraps_are_kept(tmp_path):
    halves(tmp_path)
    said = 'float4 inputs:scale = (0.5, 0.25, 0.5, 1)\n token inputs:wrapS = "clamp"\n token inputs:wrapT = "mirror"'
    surface = only(read(tmp_path, square(BOUND), paint(COLOURED, textured(said)))).surface
    assert (surface.colour_rgb, surface.wraps) == ((0.5, 0.25, 0.5), ("clamp", "mirror"))
    said = "float4 inputs:bias = (0, 1, 0, 0)"
    surface = only(read(tmp_path, square(BOUND), paint(COLOURED, textured(said)))).surface
    shown = np.asarray(Image.open(io.BytesIO(surface.picture.data)))
    assert shown[0].tolist() == [[255, 255, 0], [0, 255, 255]]


def test_tiles_are_one_picture_over_their_squares(tmp_path):
    for tile, grey in ((1001, 10), (1012, 200)):
        Image.new("RGB", (2, 2), (grey,) * 3).save(tmp_path / f"paint.{tile}.png")
    part = only(read(tmp_path, square(BOUND), paint(COLOURED, textured(file="paint.<UDIM>.png"))))
    shown = np.asarray(Image.open(io.BytesIO(part.surface.picture.data)))[..., 0]
    assert (shown[3, 0], shown[0, 3]) == (10, 200)
    assert part.st.max() == 0.5  # the square of tile 1001


INTERFACE = "color3f inputs:tint = (0.7, 0.1, 0.2)"
GRAPH = """
    def NodeGraph "Graph" {
        color3f inputs:tint.connect = </Car/Looks/Paint.inputs:tint>
        color3f outputs:tint.connect = </Car/Looks/Paint/Graph.inputs:tint>
    }
"""


@pytest.mark.parametrize(
    ("inputs", "nodes"),
    [
        ("color3f inputs:diffuseColor = (0.7, 0.1, 0.2)", ""),
        ("color3f inputs:diffuseColor.connect = </Car/Looks/Paint.inputs:tint>", ""),
        ("color3f inputs:diffuseColor.connect = </Car/Looks/Paint/Graph.outputs:tint>", GRAPH),
    ],
)
@pytest.mark.parametrize("purpose", ["", ":preview", ":full"])
def test_colours_come_through_interfaces_graphs_and_purposes(tmp_path, inputs, nodes, purpose):
    body = square(f"rel material:binding{purpose} = </Car/Looks/Paint>")
    model = read(tmp_path, body, paint(inputs, nodes, INTERFACE))
    assert only(model).surface.colour_rgb == pytest.approx((0.7, 0.1, 0.2))
    assert model.remarks == ()


def test_a_picture_through_an_interface(tmp_path):
    halves(tmp_path)
    nodes = textured().replace(
        "asset inputs:file = @./paint.png@", "asset inputs:file.connect = </Car/Looks/Paint.inputs:f>"
    )
    part = only(read(tmp_path, square(BOUND), paint(COLOURED, nodes, "asset inputs:f = @./paint.png@")))
    assert np.asarray(Image.open(io.BytesIO(part.surface.picture.data)))[0].tolist() == [[255, 0, 0], [0, 0, 255]]


def test_materials_of_other_renderers_leave_the_colour_of_the_mesh_and_are_named(tmp_path):
    mdl = """
        def Material "Paint" {
            token outputs:mdl:surface.connect = </Car/Looks/Paint/Mdl.outputs:out>
            def Shader "Mdl" {
                uniform token info:implementationSource = "sourceAsset"
                uniform asset info:mdl:sourceAsset = @OmniPBR.mdl@
                token outputs:out
            }
        }
    """
    body = f'def Xform "Group" {{\n color3f[] primvars:displayColor = [(0.1, 0.2, 0.3)]\n {square(BOUND)} }}'
    model = read(tmp_path, body, mdl)
    assert only(model).surface.colour_rgb == pytest.approx((0.1, 0.2, 0.3))
    assert model.remarks == ("materials without a UsdPreviewSurface are plain (1): /Car/Looks/Paint",)


def test_sixteen_bits_of_roughness_keep_their_value(tmp_path):
    Image.fromarray(np.full((2, 2), 76 * 257, np.uint16)).save(tmp_path / "paint.png")
    rough = "float inputs:roughness.connect = </Car/Looks/Paint/Picture.outputs:r>"
    surface = only(read(tmp_path, square(BOUND), paint(rough, textured()))).surface
    assert np.asarray(Image.open(io.BytesIO(surface.packed.data)))[0, 0].tolist() == [255, 76, 0]


def test_faces_may_be_concave_or_holes_and_shapes_simple(tmp_path):
    concave = """
    def Mesh "Arch" {
        int[] faceVertexCounts = [8, 4]
        int[] faceVertexIndices = [0, 1, 2, 3, 4, 5, 6, 7, 0, 1, 2, 3]
        int[] holeIndices = [1]
        point3f[] points = [(0, 0, 0), (100, 0, 0), (100, 200, 0), (200, 200, 0), (200, 0, 0), (300, 0, 0),
            (300, 300, 0), (0, 300, 0)]
        uniform token subdivisionScheme = "none"
    }
    """
    assert area_m2(read(tmp_path, concave)) == pytest.approx(9 - 2)
    cube = 'def Cube "Box" { double size = 100; }'
    assert area_m2(read(tmp_path, cube)) == pytest.approx(6)
    points = f"""
    def PointInstancer "Points" {{
        rel prototypes = </Car/Points/Box>
        int[] protoIndices = [0, 0]
        point3f[] positions = [(0, 0, 0), (500, 0, 0)]
        {cube}
    }}
    """
    assert area_m2(read(tmp_path, points)) == pytest.approx(12)


def test_what_stands_beside_the_default_prim_is_named(tmp_path):
    ground = 'def Cube "Ground" { double size = 5000; }\n'
    (tmp_path / "c.usda").write_text(STAGE.format(body=square(), looks="") + ground)
    model = read_model(tmp_path / "c.usda", field="models")
    assert area_m2(model) == pytest.approx(1)
    assert model.remarks == ("what stands beside the default prim is left out (1): /Ground",)


def test_coordinates_that_do_not_fit_are_named(tmp_path):
    halves(tmp_path)
    body = square(BOUND.replace(", (0, 1)]", "]"))  # three for four points
    (line,) = read(tmp_path, body, paint(COLOURED, textured())).remarks
    assert line == "textures show one pixel without the coordinates st (1): /Car/Body"


def test_prims_that_are_not_read_are_named(tmp_path):
    others = """
    def BasisCurves "Wire" { int[] curveVertexCounts = [2]; point3f[] points = [(0, 0, 0), (1, 0, 0)]; }
    def SphereLight "Lamp" { }
    """
    model = read(tmp_path, square() + others)
    assert sorted(model.remarks) == [
        "lights are not used (1): /Car/Lamp",
        "prims of the type BasisCurves are left out (1): /Car/Wire",
    ]


SKIN = """
def SkelRoot "Root" {
    def Skeleton "Skeleton" {
        uniform token[] joints = ["Hip", "Hip/Knee"]
        uniform matrix4d[] bindTransforms = [
            ((1, 0, 0, 0), (0, 1, 0, 0), (0, 0, 1, 0), (0, 0, 0, 1)),
            ((1, 0, 0, 0), (0, 1, 0, 0), (0, 0, 1, 0), (0, 100, 0, 1))]
        uniform matrix4d[] restTransforms = [
            ((1, 0, 0, 0), (0, 1, 0, 0), (0, 0, 1, 0), (0, 0, 0, 1)),
            ((1, 0, 0, 0), (0, 1, 0, 0), (0, 0, 1, 0), (50, 100, 0, 1))]
    }
    def Mesh "Body" (prepend apiSchemas = ["SkelBindingAPI"]) {
        int[] faceVertexCounts = [4]
        int[] faceVertexIndices = [0, 1, 2, 3]
        point3f[] points = [(0, 0, 0), (100, 0, 0), (100, 100, 0), (0, 100, 0)]
        uniform token subdivisionScheme = "none"
        rel skel:skeleton = </Car/Root/Skeleton>
        int[] primvars:skel:jointIndices = [0, 0, 1, 1] (elementSize = 1; interpolation = "vertex")
        float[] primvars:skel:jointWeights = [1, 1, 1, 1] (elementSize = 1; interpolation = "vertex")
    }
}
"""


def test_skins_rest(tmp_path):
    """The knee rests half a metre beside where it is bound, and takes two points along."""
    points = only(read(tmp_path, SKIN)).triangles_m.reshape(-1, 3)
    found = np.unique((points - (1, 3, -2)).round(4) + 0.0, axis=0)
    assert found.tolist() == [[0, 0, 0], [0.5, 0, -1], [1, 0, 0], [1.5, 0, -1]]
