"""One asset as a layer of its own: ``/Asset`` with its meshes, materials and light."""

from collections.abc import Mapping
from pathlib import Path
from typing import NamedTuple

import numpy as np
from pxr import Gf, Sdf, Usd, UsdGeom, UsdLux, UsdPhysics, UsdSemantics, UsdShade, Vt
from pxr import Kind as ModelKind

from garage2usd.assets import MATERIALS, VARYING, Asset, Collider, Part, RectLight, Touch, pascal_case
from garage2usd.config.stage import TextureQuality
from garage2usd.objects import Kind
from garage2usd.objects.car import PAINT_SET
from garage2usd.reading.taxonomy import OBJECT_TAXONOMY
from garage2usd.stage.looks import define_material, set_varying
from garage2usd.stage.texture_files import named_textures
from garage2usd.stage.variants import POWER_SET

__all__ = ["NITS_PER_INTENSITY", "write_prototype"]

NITS_PER_INTENSITY = 27.0
"""What a UsdLux intensity of 1 stands for, cd/m2: with it a garage lit to 50 lx shows well at an exposure of 0."""

_ROOT = "Asset"
"""Name of the root prim of every asset, so that equal assets have equal bytes whatever their files are called."""
_TUBE_COLOUR = (1.0, 0.97, 0.92)


class _Friction(NamedTuple):
    """Coefficients of a dry surface against a tyre."""

    static: float
    dynamic: float
    restitution: float


_FRICTION = {
    Touch.CONCRETE: _Friction(0.8, 0.7, 0.05),
    Touch.COATING: _Friction(0.7, 0.6, 0.05),
    Touch.RUBBER: _Friction(1.0, 0.9, 0.2),
    Touch.STEEL: _Friction(0.45, 0.35, 0.1),
    Touch.PLASTIC: _Friction(0.5, 0.4, 0.2),
}


def write_prototype(asset: Asset, path: Path, *, kind: Kind, quality: TextureQuality) -> None:
    """Author `asset` as a ``.usdc``; its bytes do not depend on the name of the file.

    Parameters
    ----------
    asset
        Meshes in metres, Y up.
    path
        The file.
    kind
        What it is: its semantic class, and its name in the model's assetInfo.
    quality
        Of the textures that it refers to, in the folder ``textures`` beside the file.
    """
    stage = Usd.Stage.CreateNew(str(path))
    UsdGeom.SetStageUpAxis(stage, UsdGeom.Tokens.y)
    UsdGeom.SetStageMetersPerUnit(stage, 1.0)
    UsdPhysics.SetStageKilogramsPerUnit(stage, 1.0)
    root = UsdGeom.Xform.Define(stage, Sdf.Path.absoluteRootPath.AppendChild(_ROOT)).GetPrim()
    stage.SetDefaultPrim(root)
    model = Usd.ModelAPI(root)
    model.SetKind(ModelKind.Tokens.component)
    model.SetAssetName(pascal_case(kind.name))
    UsdSemantics.LabelsAPI.Apply(root, OBJECT_TAXONOMY).CreateLabelsAttr([kind.label])

    geometry = UsdGeom.Scope.Define(stage, root.GetPath().AppendChild("Geom")).GetPath()
    looks = UsdGeom.Scope.Define(stage, root.GetPath().AppendChild("Looks")).GetPath()
    materials = {
        key: define_material(
            stage,
            looks.AppendChild(pascal_case(key)),
            named_textures(MATERIALS[key], quality),
            varying=key in VARYING,
        )
        for key in sorted({part.material for part in asset.parts})
    }
    frictions = {touch: _define_friction(stage, looks, touch) for touch in sorted(_touched(asset))}
    for part in asset.parts:
        mesh = _define_mesh(stage, geometry.AppendChild(part.name), part, materials[part.material])
        if part.collider is not None:
            _define_collider(mesh, part.collider, frictions[MATERIALS[part.material].touch])
    if asset.paints:
        _define_paints(stage, root, looks, asset.paints)
    if asset.light is not None:
        light = _define_light(stage, root.GetPath().AppendChild("Light"), asset.light)
        _define_power(root, light, asset.light, [materials[key] for key in sorted(_glowing(asset))])
    stage.GetRootLayer().Save()


def _touched(asset: Asset) -> set[Touch]:
    return {MATERIALS[part.material].touch for part in asset.parts if part.collider is not None}


def _glowing(asset: Asset) -> set[str]:
    return {part.material for part in asset.parts if any(MATERIALS[part.material].emissive_rgb)}


def _define_friction(stage: Usd.Stage, looks: Sdf.Path, touch: Touch) -> UsdShade.Material:
    """A physics material with the friction of dry surfaces."""
    friction = _FRICTION[touch]
    material = UsdShade.Material.Define(stage, looks.AppendChild(f"Friction{touch.capitalize()}"))
    physics = UsdPhysics.MaterialAPI.Apply(material.GetPrim())
    physics.CreateStaticFrictionAttr(friction.static)
    physics.CreateDynamicFrictionAttr(friction.dynamic)
    physics.CreateRestitutionAttr(friction.restitution)
    return material


def _define_paints(stage: Usd.Stage, root: Usd.Prim, looks: Sdf.Path, paints: Mapping[str, str]) -> None:
    """A variant for each paint; the first is selected where an instance selects none."""
    choices = root.GetVariantSets().AddVariantSet(PAINT_SET)
    for name, key in paints.items():
        choices.AddVariant(name)
        choices.SetVariantSelection(name)
        with choices.GetVariantEditContext():
            set_varying(stage, looks.AppendChild(pascal_case("car_paint")), MATERIALS[key])
    choices.SetVariantSelection(next(iter(paints)))


def _define_power(root: Usd.Prim, rect: UsdLux.RectLight, light: RectLight, glowing: list[UsdShade.Material]) -> None:
    """Light and glow as the variants on and off, on being selected."""
    choices = root.GetVariantSets().AddVariantSet(POWER_SET)
    glows = [UsdShade.Shader(material.GetPrim().GetChild("Surface")).GetInput("emissiveColor") for material in glowing]
    colours = [glow.Get() for glow in glows]
    for name, share in (("on", 1.0), ("off", 0.0)):
        choices.AddVariant(name)
        choices.SetVariantSelection(name)
        with choices.GetVariantEditContext():
            rect.CreateIntensityAttr(share * light.luminance_nit / NITS_PER_INTENSITY)
            for glow, colour in zip(glows, colours, strict=True):
                glow.Set(share * colour)
    # opinions of variants are weaker than those beside them
    for glow in glows:
        glow.GetAttr().Clear()
    choices.SetVariantSelection("on")


def _define_mesh(stage: Usd.Stage, path: Sdf.Path, part: Part, material: UsdShade.Material) -> Usd.Prim:
    mesh = UsdGeom.Mesh.Define(stage, path)
    points = Vt.Vec3fArray.FromNumpy(part.points)
    mesh.CreatePointsAttr(points)
    mesh.CreateFaceVertexCountsAttr(Vt.IntArray.FromNumpy(part.face_counts))
    mesh.CreateFaceVertexIndicesAttr(Vt.IntArray.FromNumpy(part.face_indices))
    mesh.CreateSubdivisionSchemeAttr(UsdGeom.Tokens.none)
    mesh.CreateExtentAttr(UsdGeom.PointBased.ComputeExtent(points))
    primvars = UsdGeom.PrimvarsAPI(mesh)
    # the attribute of the schema takes no indices, with which a car is half as large
    normals, normal_indices = np.unique(np.round(part.normals, 4) + 0.0, axis=0, return_inverse=True)
    shading = primvars.CreatePrimvar("normals", Sdf.ValueTypeNames.Normal3fArray, UsdGeom.Tokens.faceVarying)
    shading.Set(Vt.Vec3fArray.FromNumpy(normals.astype(np.float32)))
    shading.SetIndices(Vt.IntArray.FromNumpy(normal_indices.ravel().astype(np.int32)))
    if MATERIALS[part.material].textures():
        coordinates = primvars.CreatePrimvar("st", Sdf.ValueTypeNames.TexCoord2fArray, UsdGeom.Tokens.faceVarying)
        coordinates.Set(Vt.Vec2fArray.FromNumpy(part.st))
        coordinates.SetIndices(Vt.IntArray.FromNumpy(part.st_indices))
    UsdShade.MaterialBindingAPI.Apply(mesh.GetPrim()).Bind(material)
    return mesh.GetPrim()


def _define_collider(prim: Usd.Prim, collider: Collider, friction: UsdShade.Material) -> None:
    UsdPhysics.CollisionAPI.Apply(prim)
    UsdPhysics.MeshCollisionAPI.Apply(prim).CreateApproximationAttr(collider.value)
    UsdShade.MaterialBindingAPI(prim).Bind(friction, materialPurpose="physics")


def _define_light(stage: Usd.Stage, path: Sdf.Path, light: RectLight) -> UsdLux.RectLight:
    rect = UsdLux.RectLight.Define(stage, path)
    rect.CreateWidthAttr(light.width_m)
    rect.CreateHeightAttr(light.depth_m)
    rect.CreateColorAttr(Gf.Vec3f(*_TUBE_COLOUR))
    rect.CreateNormalizeAttr(False)
    luminance = rect.GetPrim().CreateAttribute("garage:light:luminance", Sdf.ValueTypeNames.Float)
    luminance.Set(light.luminance_nit)
    extent = [Gf.Vec3f(-light.width_m / 2, -light.depth_m / 2, 0), Gf.Vec3f(light.width_m / 2, light.depth_m / 2, 0)]
    rect.CreateExtentAttr(extent)
    # a rect light shines along its -Z; turned by -90 degrees about X it shines down
    rect.AddTranslateOp(UsdGeom.XformOp.PrecisionFloat).Set(Gf.Vec3f(0, light.height_m, 0))
    rect.AddRotateXOp().Set(-90.0)
    return rect
