"""What a scene shows: transforms, meshes, materials, lights and bindings, against ``pxr`` and by formulas."""

import math

import numpy as np
import pytest
from pxr import Gf, Sdf, Usd, UsdGeom, UsdLux, UsdPhysics, UsdShade, Vt
from support.sample_files import SAMPLES
from support.unity.agreement import scene_of

PAPER = next(sample for sample in SAMPLES if sample.stem == "paper_7x9")


def shown(stage: Usd.Stage):
    """All prims that a scene shows, through instances."""
    yield from Usd.PrimRange(stage.GetPseudoRoot(), Usd.TraverseInstanceProxies(Usd.PrimDefaultPredicate))


def newell(points: np.ndarray, counts: np.ndarray, indices: np.ndarray) -> tuple[float, np.ndarray]:
    """Area of all polygons, and the sum of their area vectors."""
    following = np.arange(1, len(indices) + 1)
    ends = np.cumsum(counts)
    following[ends - 1] = ends - counts
    products = np.cross(points[indices], points[indices[following]]) / 2
    vectors = np.add.reduceat(products, ends - counts)
    return float(np.linalg.norm(vectors, axis=1).sum()), vectors.sum(axis=0)


def areas(points: np.ndarray, counts: np.ndarray, indices: np.ndarray) -> tuple[float, float]:
    """Least and greatest area of the triangles of faces that need not be quite flat: a quad has two diagonals."""
    starts = np.cumsum(counts) - counts
    quads = points[indices[starts[counts == 4][:, np.newaxis] + np.arange(4)]]
    flat, _ = (
        newell(points, counts[counts != 4], indices[np.repeat(counts != 4, counts)]) if (counts != 4).any() else (0, 0)
    )

    def halves(a: int, b: int, c: int, d: int) -> np.ndarray:
        first = np.cross(quads[:, b] - quads[:, a], quads[:, c] - quads[:, a])
        second = np.cross(quads[:, c] - quads[:, a], quads[:, d] - quads[:, a])
        return (np.linalg.norm(first, axis=1) + np.linalg.norm(second, axis=1)) / 2

    one, other = halves(0, 1, 2, 3), halves(1, 2, 3, 0)
    least = np.minimum(one, other)
    # where the diagonals differ by much, the face has a corner inwards and only one of them is within it
    most = np.where(np.maximum(one, other) < 1.05 * least, np.maximum(one, other), least)
    return flat + least.sum(), flat + most.sum()


@pytest.mark.parametrize("sample", [None, pytest.param(PAPER, marks=pytest.mark.soak)], ids=["small", "paper"])
@pytest.mark.parametrize(("extension", "form"), [("usda", "nested"), ("usdz", None)])
def test_sample(usd_dump, builds, small_builds, sample, extension, form):
    path = (builds(sample, extension, form) if sample else small_builds(extension, form)).stage
    scene = scene_of(usd_dump, path)
    assert scene["warnings"] == []
    stage = Usd.Stage.Open(str(path))
    cache = UsdGeom.XformCache()
    found = 0
    for prim in shown(stage):
        node = scene["nodes"].pop(str(prim.GetPath()), None)
        if prim.IsPseudoRoot():
            continue
        assert node is not None, prim
        if UsdGeom.Xformable(prim) and not UsdGeom.Xformable(prim).TransformMightBeTimeVarying():
            wanted = np.array(cache.GetLocalToWorldTransform(prim)).reshape(-1)
            assert np.allclose(node["world"], wanted, rtol=1e-9, atol=1e-6), prim
        material = UsdShade.MaterialBindingAPI(prim).ComputeBoundMaterial(UsdShade.Tokens.preview)[0]
        assert node.get("material") == (str(material.GetPath()) if material else None), prim
        if prim.IsA(UsdGeom.Mesh):
            check_mesh(UsdGeom.Mesh(prim), node["mesh"])
        if prim.HasAPI(UsdPhysics.CollisionAPI):
            assert node["collider"]
            physics = UsdShade.MaterialBindingAPI(prim).ComputeBoundMaterial("physics")[0]
            friction = UsdPhysics.MaterialAPI(physics).GetStaticFrictionAttr().Get() if physics else None
            assert node.get("friction") == (None if friction is None else pytest.approx(friction)), prim
        labels = prim.GetAttribute("semantics:labels:class").Get()
        assert node.get("labels", {}).get("class") == (list(labels) if labels else None), prim
        if prim.IsA(UsdLux.BoundableLightBase):
            assert node["light"]["luminance"] > 0
        if prim.IsA(UsdGeom.PointInstancer):
            wanted = UsdGeom.PointInstancer(prim).ComputeInstanceTransformsAtTime(
                0, 0, UsdGeom.PointInstancer.ExcludeProtoXform
            )
            # pxr takes quaternions of half precision as they are, which are not quite of length 1
            assert np.allclose(node["instances"], np.array(wanted).reshape(-1, 16), atol=1e-3)
        found += 1
    assert found > 300
    assert not scene["nodes"]
    textures = [one for material in scene["materials"].values() for one in material.values() if "asset" in one]
    assert textures
    assert all(one["identifier"] for one in textures)


checked = {}


def check_mesh(mesh: UsdGeom.Mesh, found: dict) -> None:
    # the same mesh stands in many places: once is enough
    key = str(mesh.GetPrim().GetPrimInPrototype().GetPath() if mesh.GetPrim().IsInstanceProxy() else mesh.GetPath())
    if checked.get(key) == found["area"]:
        return
    checked[key] = found["area"]
    points = np.array(mesh.GetPointsAttr().Get(), dtype=float)
    counts = np.array(mesh.GetFaceVertexCountsAttr().Get())
    indices = np.array(mesh.GetFaceVertexIndicesAttr().Get())
    assert found["triangles"] == int((counts - 2).sum())
    _, vector = newell(points, counts, indices)
    least, most = areas(points, counts, indices)
    assert least * (1 - 1e-5) <= found["area"] <= most * (1 + 1e-5)
    assert np.allclose(found["sum"], vector, atol=1e-5 * most)


def test_every_transform_operation(usd_dump, tmp_path):
    stage = Usd.Stage.CreateNew(str(tmp_path / "transforms.usda"))
    parent = UsdGeom.Xform.Define(stage, "/P")
    parent.AddTranslateOp().Set(Gf.Vec3d(1, 2, 3))
    parent.AddRotateXYZOp().Set(Gf.Vec3f(10, 20, 30))
    operations = {
        "scale": lambda x: x.AddScaleOp().Set(Gf.Vec3f(1, -2, 3)),
        "orient": lambda x: x.AddOrientOp().Set(Gf.Quatf(0.5, 0.1, 0.7, -0.2)),
        "half": lambda x: x.AddOrientOp(UsdGeom.XformOp.PrecisionHalf).Set(Gf.Quath(0.5, 0.5, 0.5, -0.5)),
        "matrix": lambda x: x.AddTransformOp().Set(Gf.Matrix4d(1, 2, 0, 0, 0, 1, 3, 0, 0, 0, 1, 0, 7, 8, 9, 1)),
        "X": lambda x: x.AddRotateXOp().Set(33.0),
        "Y": lambda x: x.AddRotateYOp(UsdGeom.XformOp.PrecisionDouble).Set(33.0),
        "Z": lambda x: x.AddRotateZOp().Set(33.0),
        "moveX": lambda x: x.AddTranslateXOp().Set(4.0),
        "scaleZ": lambda x: x.AddScaleZOp().Set(4.0),
    }
    for order in ("XYZ", "XZY", "YXZ", "YZX", "ZXY", "ZYX"):
        operations[order] = lambda x, order=order: getattr(x, f"AddRotate{order}Op")().Set(Gf.Vec3f(11, -22, 133))
    for index, (_, add) in enumerate(operations.items()):
        child = UsdGeom.Xform.Define(stage, f"/P/C{index}")
        child.AddTranslateOp().Set(Gf.Vec3d(index, 0, 1))
        child.AddTranslateOp(opSuffix="pivot").Set(Gf.Vec3d(0, 5, 1))
        add(child)
        child.AddTranslateOp(opSuffix="pivot", isInverseOp=True)
        UsdGeom.Xform.Define(stage, f"/P/C{index}/Deep").AddScaleOp().Set(Gf.Vec3f(2, 1, 1))
    reset = UsdGeom.Xform.Define(stage, "/P/C0/Reset")
    reset.SetResetXformStack(True)
    reset.AddTranslateOp().Set(Gf.Vec3d(9, 9, 9))
    UsdGeom.Xform.Define(stage, "/P/C0/Reset/Below")
    inverse = UsdGeom.Xform.Define(stage, "/P/Inverse")
    inverse.AddTransformOp().Set(Gf.Matrix4d(1, 2, 0, 0, 0, 1, 3, 0, 0, 0, 1, 0, 7, 8, 9, 1))
    inverse.AddTransformOp(isInverseOp=True)
    inverse.AddScaleOp(opSuffix="b").Set(Gf.Vec3f(3, 3, 3))
    stage.Save()
    scene = scene_of(usd_dump, tmp_path / "transforms.usda")
    cache = UsdGeom.XformCache()
    for prim in stage.Traverse():
        wanted = np.array(cache.GetLocalToWorldTransform(prim)).reshape(-1)
        assert np.allclose(scene["nodes"][str(prim.GetPath())]["world"], wanted, atol=1e-6), prim.GetPath()


def concave_star(corners: int) -> np.ndarray:
    angle = np.arange(corners) * 2 * math.pi / corners
    radius = np.where(np.arange(corners) % 2, 0.3, 1.0)
    return np.stack([radius * np.cos(angle), radius * np.sin(angle), 0.5 * radius * np.cos(angle)], axis=1)


@pytest.mark.parametrize("orientation", ["rightHanded", "leftHanded"])
@pytest.mark.parametrize("interpolation", ["constant", "uniform", "vertex", "faceVarying"])
def test_mesh(usd_dump, tmp_path, orientation, interpolation):
    """Concave faces, a hole, subsets, indexed primvars: each corner of each triangle has what its face says."""
    stage = Usd.Stage.CreateNew(str(tmp_path / "mesh.usda"))
    mesh = UsdGeom.Mesh.Define(stage, "/M")
    star = concave_star(14)
    extra = np.array([[3, 0, 0], [4, 0, 0], [4, 1, 0], [3.2, 0.2, 0], [5, 0, 0], [5, 1, 0]], dtype=float)
    points = np.concatenate([star, extra])
    counts = [14, 4, 3, 3, 2]
    indices = [*range(14), 14, 15, 16, 17, 15, 18, 16, 18, 19, 16, 0, 1]
    mesh.CreatePointsAttr(Vt.Vec3fArray.FromNumpy(points.astype(np.float32)))
    mesh.CreateFaceVertexCountsAttr(counts)
    mesh.CreateFaceVertexIndicesAttr(indices)
    mesh.CreateHoleIndicesAttr([3])
    mesh.CreateOrientationAttr(orientation)
    mesh.CreateSubdivisionSchemeAttr("none")
    size = {"constant": 1, "uniform": len(counts), "vertex": len(points), "faceVarying": len(indices)}[interpolation]
    st = UsdGeom.PrimvarsAPI(mesh).CreatePrimvar("st", Sdf.ValueTypeNames.TexCoord2fArray, interpolation)
    values = [(i / 8, i / 16) for i in range(5)]
    st.Set(values)
    st.SetIndices([i % 5 for i in range(size)])
    subset = UsdGeom.Subset.Define(stage, "/M/Part")
    subset.CreateIndicesAttr([1, 2])
    subset.CreateFamilyNameAttr("materialBind")
    UsdShade.Material.Define(stage, "/Mat")
    UsdShade.MaterialBindingAPI.Apply(subset.GetPrim()).Bind(UsdShade.Material.Get(stage, "/Mat"))
    stage.Save()
    found = scene_of(usd_dump, tmp_path / "mesh.usda")["nodes"]["/M"]["mesh"]
    assert found["parts"] == [12, 3]
    corners = np.array(found["corners"]).reshape(-1, 3)
    sign = 1 if orientation == "rightHanded" else -1
    area, vector = newell(points, np.array(counts[:3]), np.array(indices[:21]))
    assert found["area"] == pytest.approx(area, rel=1e-6)
    assert np.allclose(found["sum"], sign * vector, atol=1e-6)
    triangles = points[corners]
    normals = np.cross(triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 0])
    shown_normals = np.array(found["normals"]).reshape(-1, 3, 3)
    assert (np.einsum("ij,ikj->ik", normals, shown_normals) > 0).all()
    faces = [0] * 12 + [1] * 2 + [2]
    starts = np.cumsum([0, *counts])
    for triangle, face, st_found in zip(corners, faces, np.array(found["primvars:st"]).reshape(-1, 3, 2), strict=True):
        for point, coordinate in zip(triangle, st_found, strict=True):
            corner = starts[face] + indices[starts[face] : starts[face + 1]].index(point)
            element = {"constant": 0, "uniform": face, "vertex": point, "faceVarying": corner}[interpolation]
            assert tuple(coordinate) == pytest.approx(values[element % 5])


@pytest.mark.parametrize(
    ("define", "wanted"),
    [
        (lambda s: light(UsdLux.RectLight, s, width=2, height=3), {"candela": 600, "lumen": math.pi * 600}),
        (
            lambda s: light(UsdLux.RectLight, s, width=2, height=3, normalize=True),
            {"luminance": 100 / 6, "candela": 100},
        ),
        (lambda s: light(UsdLux.DiskLight, s, radius=2), {"candela": 400 * math.pi}),
        (lambda s: light(UsdLux.SphereLight, s, radius=2), {"candela": 400 * math.pi, "lumen": 1600 * math.pi**2}),
        (lambda s: light(UsdLux.CylinderLight, s, radius=2, length=5), {"candela": 2000}),
        (lambda s: light(UsdLux.DistantLight, s, angle=60), {"lux": 100 * math.pi / 4}),
        (lambda s: light(UsdLux.DistantLight, s, angle=60, normalize=True), {"lux": 100}),
        (lambda s: light(UsdLux.RectLight, s, width=1, height=1, exposure=3), {"luminance": 800}),
    ],
)
def test_light(usd_dump, tmp_path, define, wanted):
    stage = Usd.Stage.CreateNew(str(tmp_path / "light.usda"))
    UsdGeom.SetStageMetersPerUnit(stage, 1)
    define(stage)
    stage.Save()
    found = scene_of(usd_dump, tmp_path / "light.usda")["nodes"]["/L"]["light"]
    for key, value in wanted.items():
        assert found[key] == pytest.approx(value), key


def light(kind, stage, **inputs):
    made = kind.Define(stage, "/L")
    made.CreateIntensityAttr(100)
    for name, value in inputs.items():
        getattr(made, f"Create{name.capitalize()}Attr")(value)


def test_material(usd_dump, tmp_path):
    """Inputs by the interface of the material, a texture with all that belongs to one, strengths of bindings."""
    (tmp_path / "t").mkdir()
    (tmp_path / "t" / "wood.png").write_bytes(b"not looked at")
    (tmp_path / "m.usda").write_text("""#usda 1.0
def Scope "G" (
    prepend apiSchemas = ["MaterialBindingAPI"]
)
{
    rel material:binding = </Mat> (
        bindMaterialAs = "strongerThanDescendants"
    )
    def Mesh "Weak" (
        prepend apiSchemas = ["MaterialBindingAPI"]
    )
    {
        rel material:binding = </Other>
    }
}
def Mesh "Own" (
    prepend apiSchemas = ["MaterialBindingAPI"]
)
{
    rel material:binding = </Mat>
    rel material:binding:preview = </Other>
}
def Material "Other" {
}
def Material "Mat"
{
    float inputs:rough = 0.25
    token inputs:varname = "uv1"
    token outputs:surface.connect = </Mat/S.outputs:surface>
    def Shader "S"
    {
        uniform token info:id = "UsdPreviewSurface"
        color3f inputs:diffuseColor = (1, 0, 0)
        color3f inputs:diffuseColor.connect = </Mat/T.outputs:rgb>
        float inputs:roughness.connect = </Mat.inputs:rough>
        float inputs:metallic.connect = </Mat/T.outputs:g>
        float inputs:opacity = 0.5
        token outputs:surface
    }
    def Shader "T"
    {
        uniform token info:id = "UsdUVTexture"
        asset inputs:file = @./t/wood.png@
        token inputs:wrapS = "repeat"
        token inputs:sourceColorSpace = "sRGB"
        float4 inputs:scale = (2, 2, 2, 1)
        float4 inputs:bias = (0.1, 0, 0, 0)
        float2 inputs:st.connect = </Mat/X.outputs:result>
        float3 outputs:rgb
        float outputs:g
    }
    def Shader "X"
    {
        uniform token info:id = "UsdTransform2d"
        float2 inputs:in.connect = </Mat/R.outputs:result>
        float inputs:rotation = 30
        float2 inputs:scale = (3, 4)
        float2 inputs:translation = (0.5, 0.25)
        float2 outputs:result
    }
    def Shader "R"
    {
        uniform token info:id = "UsdPrimvarReader_float2"
        string inputs:varname.connect = </Mat.inputs:varname>
        float2 outputs:result
    }
}
""")
    scene = scene_of(usd_dump, tmp_path / "m.usda")
    assert {
        path: node.get("material") for path, node in scene["nodes"].items() if path in {"/G", "/G/Weak", "/Own"}
    } == {
        "/G": "/Mat",
        "/G/Weak": "/Mat",
        "/Own": "/Other",
    }
    material = scene["materials"]["/Mat"]
    assert material["roughness"] == {"value": [0.25]}
    assert material["opacity"] == {"value": [0.5]}
    assert material["metallic"]["channel"] == "g"
    texture = material["diffuseColor"]
    assert texture.pop("bias")[0] == pytest.approx(0.1)
    assert texture == {
        "value": [1, 0, 0],
        "asset": "./t/wood.png",
        "identifier": "t/wood.png",
        "channel": "rgb",
        "wrapS": "repeat",
        "colorSpace": "sRGB",
        "coordinates": "uv1",
        "scale": [2, 2, 2, 1],
        "transform": [[3, 4], 30, [0.5, 0.25]],
    }


def test_bad_meshes_are_left_out_with_a_warning(usd_dump, tmp_path):
    (tmp_path / "bad.usda").write_text("""#usda 1.0
def Mesh "Index" { point3f[] points = [(0, 0, 0)]; int[] faceVertexCounts = [3]; int[] faceVertexIndices = [0, 1, 2] }
def Mesh "Count" { point3f[] points = [(0, 0, 0)]; int[] faceVertexCounts = [4]; int[] faceVertexIndices = [0, 0, 0] }
def Mesh "Negative" { point3f[] points = [(0, 0, 0)]; int[] faceVertexCounts = [-1]; int[] faceVertexIndices = [] }
def Mesh "Empty" {}
""")
    scene = scene_of(usd_dump, tmp_path / "bad.usda")
    assert all("mesh" not in node for node in scene["nodes"].values())
    assert len(scene["warnings"]) == 4


def comb(teeth: int) -> np.ndarray:
    """Points around a comb, whose area is half of what is around it."""
    top = [(x + shift, 1 - x % 2) for x in range(2 * teeth) for shift in (0, 1)]
    return np.array([(0, -1), *top, (2 * teeth, -1)], dtype=float)


@pytest.mark.parametrize("turned", [False, True])
def test_intricate_faces_keep_their_area(usd_dump, tmp_path, turned):
    """A comb of 1200 corners, and a ring with a hole that a cut through it joins to the outside."""
    ring = [(0, 0), (10, 0), (10, 10), (0, 10), (0, 0), (2, 2), (2, 8), (8, 8), (8, 2), (2, 2)]
    faces = {"Comb": comb(300), "Ring": np.array(ring, dtype=float)}
    stage = Usd.Stage.CreateNew(str(tmp_path / "faces.usda"))
    expected = {}
    for name, outline in faces.items():
        points = np.column_stack([outline, np.zeros(len(outline))])
        if turned:
            points = points[:, [2, 0, 1]][::-1]
        x, y = outline.T
        expected[name] = abs(np.dot(x, np.roll(y, -1)) - np.dot(y, np.roll(x, -1))) / 2
        mesh = UsdGeom.Mesh.Define(stage, f"/{name}")
        mesh.CreatePointsAttr(Vt.Vec3fArray.FromNumpy(points.astype(np.float32)))
        mesh.CreateFaceVertexCountsAttr([len(points)])
        mesh.CreateFaceVertexIndicesAttr(list(range(len(points))))
    stage.Save()
    scene = scene_of(usd_dump, tmp_path / "faces.usda")
    assert scene["warnings"] == []
    for name, area in expected.items():
        assert scene["nodes"][f"/{name}"]["mesh"]["area"] == pytest.approx(area, rel=1e-5), name
    assert expected["Ring"] == 64
