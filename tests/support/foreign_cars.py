"""Models of cars as other programs write them: GLB, USD in centimetres with Z up, and USD of several files."""

import tempfile
from functools import lru_cache
from pathlib import Path

import numpy as np
import trimesh
from PIL import Image
from pxr import Gf, Sdf, Usd, UsdGeom, UsdShade

from garage2usd.config.own_cars import ModelFolder, read_own_cars

LENGTH_M, WIDTH_M, HEIGHT_M, RADIUS_M, AXLE_M = 4.2, 1.7, 1.5, 0.32, 1.25
"""Of the body, with the axles as far before and behind its middle."""


def boxes(length_m=LENGTH_M):
    """The parts by name, as meshes of trimesh with Y up and the nose to -Z."""
    half = length_m / 2
    box = trimesh.creation.box
    parts = {
        "body": box((WIDTH_M, 0.6, length_m)).apply_translation((0, 0.55, 0)),
        "cabin": box((1.4, 0.65, 2.0)).apply_translation((0, HEIGHT_M - 0.325, 0.2)),
        "front_bumper": box((1.5, 0.2, 0.1)).apply_translation((0, 0.4, 0.05 - half)),
        "door_mirror_left": box((0.15, 0.15, 0.2)).apply_translation((-0.92, 0.95, -0.7)),
        "door_mirror_right": box((0.15, 0.15, 0.2)).apply_translation((0.92, 0.95, -0.7)),
    }
    for side in (-1, 1):
        for end in (-1, 1):
            wheel = trimesh.creation.cylinder(radius=RADIUS_M, height=0.2, sections=32)
            wheel.apply_transform(trimesh.transformations.rotation_matrix(np.pi / 2, (0, 1, 0)))
            parts[f"wheel_{side}_{end}".replace("-1", "a")] = wheel.apply_translation(
                (side * 0.74, RADIUS_M, end * AXLE_M)
            )
    return parts


def lamps():
    """Two head lamps and two tail lamps, which stand out of the body."""
    return {
        f"{name}_{side}": trimesh.creation.box((0.3, 0.15, 0.04)).apply_translation((0.5 * x, 0.7, z))
        for name, z in (("headlight", -LENGTH_M / 2), ("taillight", LENGTH_M / 2))
        for side, x in (("left", -1), ("right", 1))
    }


ROUGH_RGB, NORMAL_RGB, OCCLUSION_RGB = (9, 200, 100), (140, 120, 250), (180, 180, 180)
"""Of the pictures of a finish: what glTF reads of the first is green for roughness and blue for metallic."""


def plain(rgb, side=8):
    return Image.fromarray(np.full((side, side, 3), rgb, np.uint8))


def write_glb(path, *, wheels=True, lit=False, finish=False, **measures):
    """Y up, metres, with a picture on its body; with lamps where it is to be lit, with pictures of its finish too."""
    scene = trimesh.Scene()
    for name, mesh in {**boxes(**measures), **(lamps() if lit else {})}.items():
        if not wheels and name.startswith("wheel"):
            continue
        material = trimesh.visual.material.PBRMaterial(
            name=name, baseColorFactor=(20, 60, 200, 255), metallicFactor=0.0
        )
        if name == "body":
            pictures = {"baseColorTexture": plain((10, 160, 40)), "metallicFactor": 0.0}
            if finish:
                pictures |= {
                    "metallicRoughnessTexture": plain(ROUGH_RGB),
                    "normalTexture": plain(NORMAL_RGB),
                    "occlusionTexture": plain(OCCLUSION_RGB, side=4),
                    "roughnessFactor": 0.5,
                    "metallicFactor": 1.0,
                    "baseColorFactor": (255, 255, 51, 255),
                }
            material = trimesh.visual.material.PBRMaterial(name=name, **pictures)
        mesh.visual = trimesh.visual.TextureVisuals(uv=mesh.vertices[:, :2] * 0.3, material=material)
        scene.add_geometry(mesh, node_name=name, geom_name=name)
    Path(path).write_bytes(scene.export(file_type="glb"))


def _mesh(stage, path, mesh, points):
    made = UsdGeom.Mesh.Define(stage, path)
    made.CreatePointsAttr(points.astype(np.float32))
    made.CreateFaceVertexCountsAttr([3] * len(mesh.faces))
    made.CreateFaceVertexIndicesAttr(mesh.faces.ravel().astype(np.int32))
    return made


def write_z_up(path, *, finish=False):
    """Centimetres, Z up, the nose to +X, one mesh without names that tell anything but its front, and a material."""
    stage = Usd.Stage.CreateNew(str(path))
    UsdGeom.SetStageUpAxis(stage, UsdGeom.Tokens.z)
    UsdGeom.SetStageMetersPerUnit(stage, 0.01)
    stage.SetDefaultPrim(UsdGeom.Xform.Define(stage, "/Van").GetPrim())
    material = UsdShade.Material.Define(stage, "/Van/Red")
    shader = UsdShade.Shader.Define(stage, "/Van/Red/Surface")
    shader.CreateIdAttr("UsdPreviewSurface")
    shader.CreateInput("diffuseColor", Sdf.ValueTypeNames.Color3f).Set(Gf.Vec3f(0.6, 0.02, 0.02))
    if finish:
        plain(ROUGH_RGB).save(Path(path).with_name("finish.png"))
        reader = UsdShade.Shader.Define(stage, "/Van/Red/Finish")
        reader.CreateIdAttr("UsdUVTexture")
        reader.CreateInput("file", Sdf.ValueTypeNames.Asset).Set("./finish.png")
        for key, channel in (("roughness", "r"), ("metallic", "b")):
            given = shader.CreateInput(key, Sdf.ValueTypeNames.Float)
            given.ConnectToSource(reader.CreateOutput(channel, Sdf.ValueTypeNames.Float))
    material.CreateSurfaceOutput().ConnectToSource(shader.ConnectableAPI(), "surface")
    whole = trimesh.util.concatenate(list(boxes().values()))
    x, y, z = whole.vertices.T
    mesh = _mesh(stage, "/Van/Mesh", whole, np.stack([-z, -x, y], axis=1) * 100)
    UsdShade.MaterialBindingAPI.Apply(mesh.GetPrim()).Bind(material)
    stage.Save()
    Path(path).with_name("models.toml").write_text(f'[{Path(path).stem}]\nfront = "+X"\n')


def write_parts(folder, name="parts.usda"):
    """Several files without semantics: a layer whose parts are references, its wheels instances of one."""
    folder = Path(folder)
    inner = folder / "inner"
    inner.mkdir()
    meshes = boxes()
    for part, mesh in meshes.items():
        centre = mesh.bounds.mean(axis=0) if part.startswith("wheel") else np.zeros(3)
        if part.startswith("wheel") and part != "wheel_a_a":
            continue
        stage = Usd.Stage.CreateNew(str(inner / f"{part}.usdc"))
        stage.SetDefaultPrim(UsdGeom.Xform.Define(stage, "/Part").GetPrim())
        made = _mesh(stage, "/Part/Mesh", mesh, mesh.vertices - centre)
        made.CreateDisplayColorAttr([Gf.Vec3f(0.02, 0.3, 0.1)])
        stage.Save()
    stage = Usd.Stage.CreateNew(str(folder / name))
    UsdGeom.SetStageUpAxis(stage, UsdGeom.Tokens.y)
    UsdGeom.SetStageMetersPerUnit(stage, 1.0)
    stage.SetDefaultPrim(UsdGeom.Xform.Define(stage, "/Car").GetPrim())
    for part, mesh in meshes.items():
        is_wheel = part.startswith("wheel")
        prim = UsdGeom.Xform.Define(stage, f"/Car/{part}")
        prim.GetPrim().GetReferences().AddReference(f"inner/{'wheel_a_a' if is_wheel else part}.usdc")
        if is_wheel:
            prim.AddTranslateOp().Set(Gf.Vec3d(*map(float, mesh.bounds.mean(axis=0))))
            prim.GetPrim().SetInstanceable(True)
    stage.Save()


@lru_cache(maxsize=1)
def own_car():
    """A car of one's own from a GLB, in a folder that stays until the machine cleans up."""
    folder = Path(tempfile.mkdtemp())
    write_glb(folder / "box.glb")
    _, (car,) = read_own_cars(ModelFolder(folder=str(folder)))
    return car
