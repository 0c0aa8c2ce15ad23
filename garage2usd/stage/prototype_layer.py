"""One asset as a layer of its own: ``/Name`` with its meshes, materials and light."""

from pathlib import Path

from pxr import Gf, Kind, Sdf, Usd, UsdGeom, UsdLux, UsdPhysics, UsdSemantics, UsdShade, Vt

from garage2usd.assets import MATERIALS, Asset, Collider, Part, RectLight
from garage2usd.stage.looks import define_material

__all__ = ["LABEL_TAXONOMY", "write_prototype"]

LABEL_TAXONOMY = "class"
"""Instance name of the semantic labels: ``semantics:labels:class``."""

_TUBE_COLOUR = (1.0, 0.97, 0.92)


def write_prototype(asset: Asset, path: Path) -> None:
    """Author `asset` as a ``.usdc`` whose default prim is named like the file.

    Parameters
    ----------
    asset
        Meshes in metres, Y up.
    path
        The file; its stem is the prim's name.
    """
    stage = Usd.Stage.CreateNew(str(path))
    UsdGeom.SetStageUpAxis(stage, UsdGeom.Tokens.y)
    UsdGeom.SetStageMetersPerUnit(stage, 1.0)
    UsdPhysics.SetStageKilogramsPerUnit(stage, 1.0)
    root = UsdGeom.Xform.Define(stage, Sdf.Path.absoluteRootPath.AppendChild(path.stem)).GetPrim()
    stage.SetDefaultPrim(root)
    model = Usd.ModelAPI(root)
    model.SetKind(Kind.Tokens.component)
    model.SetAssetName(path.stem)
    model.SetAssetIdentifier(Sdf.AssetPath(f"./{path.name}"))
    UsdSemantics.LabelsAPI.Apply(root, LABEL_TAXONOMY).CreateLabelsAttr([asset.label])

    geometry = UsdGeom.Scope.Define(stage, root.GetPath().AppendChild("Geom")).GetPath()
    looks = UsdGeom.Scope.Define(stage, root.GetPath().AppendChild("Looks")).GetPath()
    materials = {
        key: define_material(stage, looks.AppendChild(_pascal(key)), MATERIALS[key])
        for key in sorted({part.material for part in asset.parts})
    }
    for part in asset.parts:
        _define_mesh(stage, geometry.AppendChild(part.name), part, materials[part.material])
    if asset.light is not None:
        _define_light(stage, root.GetPath().AppendChild("Light"), asset.light)
    stage.GetRootLayer().Save()


def _define_mesh(stage: Usd.Stage, path: Sdf.Path, part: Part, material: UsdShade.Material) -> None:
    mesh = UsdGeom.Mesh.Define(stage, path)
    points = Vt.Vec3fArray.FromNumpy(part.points)
    mesh.CreatePointsAttr(points)
    mesh.CreateFaceVertexCountsAttr(Vt.IntArray.FromNumpy(part.face_counts))
    mesh.CreateFaceVertexIndicesAttr(Vt.IntArray.FromNumpy(part.face_indices))
    mesh.CreateSubdivisionSchemeAttr(UsdGeom.Tokens.none)
    mesh.CreateExtentAttr(UsdGeom.PointBased.ComputeExtent(points))
    mesh.CreateNormalsAttr(Vt.Vec3fArray.FromNumpy(part.normals))
    mesh.SetNormalsInterpolation(UsdGeom.Tokens.faceVarying)
    coordinates = UsdGeom.PrimvarsAPI(mesh).CreatePrimvar(
        "st", Sdf.ValueTypeNames.TexCoord2fArray, UsdGeom.Tokens.faceVarying
    )
    coordinates.Set(Vt.Vec2fArray.FromNumpy(part.st))
    coordinates.SetIndices(Vt.IntArray.FromNumpy(part.st_indices))
    UsdShade.MaterialBindingAPI.Apply(mesh.GetPrim()).Bind(material)
    if part.collider is not None:
        _define_collider(mesh.GetPrim(), part.collider)


def _define_collider(prim: Usd.Prim, collider: Collider) -> None:
    UsdPhysics.CollisionAPI.Apply(prim)
    UsdPhysics.MeshCollisionAPI.Apply(prim).CreateApproximationAttr(collider.value)


def _define_light(stage: Usd.Stage, path: Sdf.Path, light: RectLight) -> None:
    rect = UsdLux.RectLight.Define(stage, path)
    rect.CreateWidthAttr(light.width_m)
    rect.CreateHeightAttr(light.depth_m)
    rect.CreateIntensityAttr(light.intensity_nit)
    rect.CreateColorAttr(Gf.Vec3f(*_TUBE_COLOUR))
    rect.CreateNormalizeAttr(False)
    extent = [Gf.Vec3f(-light.width_m / 2, -light.depth_m / 2, 0), Gf.Vec3f(light.width_m / 2, light.depth_m / 2, 0)]
    rect.CreateExtentAttr(extent)
    # a rect light shines along its -Z; turned by -90 degrees about X it shines down
    rect.AddTranslateOp(UsdGeom.XformOp.PrecisionFloat).Set(Gf.Vec3f(0, light.height_m, 0))
    rect.AddRotateXOp().Set(-90.0)


def _pascal(key: str) -> str:
    return "".join(word.capitalize() for word in key.split("_"))
