"""An asset as a separate layer: ``/Asset`` with its meshes, materials, colliders and light."""
# Over 300 lines: an asset, its meshes, materials and variants are authored together.

from collections.abc import Iterable, Iterator, Mapping
from pathlib import Path
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray
from pxr import Gf, Sdf, UsdGeom, Vt
from pxr import Kind as ModelKind

from garage2usd.assets import (
    BASE_OF_TOUCH,
    MATERIALS,
    NON_VISUAL,
    VARYING,
    AreaLight,
    Asset,
    Finish,
    Material,
    Part,
    Touch,
    finished,
    pascal_case,
)
from garage2usd.assets.colours import material_colour
from garage2usd.assets.light import USUAL_LAMP_RGB
from garage2usd.config.outputs import TextureQuality
from garage2usd.objects import Kind
from garage2usd.objects.car import PAINT_SET
from garage2usd.objects.kind import piece_name, pieces_of
from garage2usd.reading.lights import luminance_of
from garage2usd.stage.authoring import (
    apply_schemas,
    attribute,
    define,
    new_layer,
    numbers,
    operation,
    order_operations,
    relationship,
)
from garage2usd.stage.looks import (
    TEXTURE_FOLDER,
    define_material,
    display_colour,
    label_material,
    named_textures,
    set_glow,
    set_varying,
)
from garage2usd.stage.variants import POWER_SET

NITS_PER_INTENSITY = 27.0
"""Luminance in cd/m2 of a UsdLux intensity of 1, so that a garage lit to 50 lx renders well at an exposure of 0."""
USUAL: Mapping[str, Finish] = {}
"""Finishes of a garage with standard materials."""

_ROOT = "Asset"
"""Name of the root prim of every asset, so that equal assets have equal bytes under any file name."""
_TYPES = Sdf.ValueTypeNames
_NORMAL_DECIMALS = 4
_POSE = ("translate", "rotateXYZ")
"""Transform operations of an asset, by which instances are placed."""


class _Friction(NamedTuple):
    """Friction coefficients of a dry surface against a tyre."""

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


def write_prototype(
    asset: Asset,
    path: Path,
    *,
    kind: Kind,
    quality: TextureQuality,
    finishes: Mapping[str, Finish] = USUAL,
    mass_kg: float | None = None,
) -> None:
    """Author an asset as a ``.usdc`` whose bytes do not depend on the file's name.

    Parameters
    ----------
    asset
        Meshes in metres, Y up.
    path
        The file.
    kind
        Kind of object: its semantic class, and its name in the model's assetInfo.
    quality
        Quality of its textures, which are in the folder ``textures`` beside the file.
    finishes
        Finishes that replace materials, by the materials' keys.
    mass_kg
        Total mass of the colliders; None for a static object.
    """
    with new_layer(path, default_prim=_ROOT) as layer:
        define_prototype(layer, _ROOT, asset, kind=kind, quality=quality, finishes=finishes, mass_kg=mass_kg)


def define_prototype(
    layer: Sdf.Layer,
    name: str,
    asset: Asset,
    *,
    kind: Kind,
    quality: TextureQuality,
    finishes: Mapping[str, Finish],
    textures: str = f"./{TEXTURE_FOLDER}",
    shared: Sdf.Path | None = None,
    mass_kg: float | None = None,
) -> None:
    """Define an asset as a root prim of a layer; parameters as for `write_prototype`.

    `textures` is the folder of the textures. Materials refer to those below the prim `shared`, which are defined once
    for all assets of the layer, except for materials that variants change. Without `shared`, the asset has all of its
    own.
    """
    of = {key: finished(key, finishes) for key in sorted(asset.materials)}
    path = Sdf.Path.absoluteRootPath.AppendChild(name)
    root = define(layer, path, "Xform", kind=ModelKind.Tokens.component, label=kind.label)
    root.SetInfo("assetInfo", {"name": pascal_case(kind.name)})
    # instances author values only: the order of operations would be a fifth of the text of a garage
    for operator in _POSE:
        operation(root, operator, _TYPES.Float3, Gf.Vec3f(0, 0, 0))
    order_operations(root, _POSE)
    define(layer, root.path.AppendChild("Geom"), "Scope")
    looks = define(layer, root.path.AppendChild("Looks"), "Scope").path
    glowing = {key: finish.material for key, finish in of.items() if any(finish.material.emissive_rgb)}
    switched = glowing if asset.light is not None else {}
    for key, finish in of.items():
        is_altered = key in VARYING or key in switched
        place = _look(looks, key) if is_altered else _place_of_look(layer, _look(looks, key), shared)
        if place is not None:
            define_material(
                layer,
                place,
                named_textures(finish.material, quality, folder=textures),
                non_visual=NON_VISUAL[finish.key],
                finish=finish.key if finish.key != key else "",
                varies=key in VARYING,
                is_switched=key in switched,
            )
    touches = {part.material: of[part.material].material.touch for part in asset.parts if part.collider is not None}
    for touch in sorted(set(touches.values())):
        place = _place_of_look(layer, _friction(looks, touch), shared)
        if place is not None:
            _define_friction(layer, place, touch)
    for label in pieces_of(asset):
        define(layer, root.path.AppendChild(piece_name(label)), "Xform", label=label)
    masses_kg = {} if mass_kg is None else _masses_kg(asset, mass_kg)
    for part in asset.parts:
        define_mesh(
            layer,
            # below its labelled piece, else below the prim with the asset's label
            root.path.AppendChild(piece_name(part.piece) if part.piece else "Geom").AppendChild(part.name),
            part,
            looks,
            finish=of[part.material].material,
            is_compact=shared is not None,
            mass_kg=masses_kg.get(part.name),
        )
    if asset.paints:
        _define_paints(root, asset.paints)
    else:
        _display(root, display_colour(asset, finishes))
    if asset.light is not None:
        _define_light(layer, root.path.AppendChild("Light"), asset.light)
        _define_power(root, asset.light, switched)


def _masses_kg(asset: Asset, mass_kg: float) -> dict[str, float]:
    """Distribute a mass over colliders by the volumes of their bounding boxes; by the names of their parts."""
    volumes = {
        part.name: float(np.ptp(part.points.astype(float), axis=0).prod())
        for part in asset.parts
        if part.collider is not None
    }
    return {name: round(mass_kg * volume / sum(volumes.values()), 3) for name, volume in volumes.items()}


def _look(looks: Sdf.Path, key: str) -> Sdf.Path:
    return looks.AppendChild(pascal_case(key))


def _friction(looks: Sdf.Path, touch: Touch) -> Sdf.Path:
    return looks.AppendChild(f"Friction{touch.capitalize()}")


def _place_of_look(layer: Sdf.Layer, path: Sdf.Path, shared: Sdf.Path | None) -> Sdf.Path | None:
    """Path at which a material is to be defined; None if it is defined already and `path` only refers to it."""
    if shared is None:
        return path
    place = shared.AppendChild(path.name)
    is_there = layer.GetPrimAtPath(place) is not None
    define(layer, path, "Material").referenceList.prependedItems = [Sdf.Reference("", place)]
    return None if is_there else place


def _define_friction(layer: Sdf.Layer, path: Sdf.Path, touch: Touch) -> None:
    """Define a physics material with the friction of a dry surface."""
    friction = _FRICTION[touch]
    material = define(layer, path, "Material")
    label_material(material, BASE_OF_TOUCH[touch], "PhysicsMaterialAPI")
    attribute(material, "physics:staticFriction", _TYPES.Float, friction.static)
    attribute(material, "physics:dynamicFriction", _TYPES.Float, friction.dynamic)
    attribute(material, "physics:restitution", _TYPES.Float, friction.restitution)


def _define_paints(root: Sdf.PrimSpec, paints: Mapping[str, str]) -> None:
    """Define a variant for each paint; the first is the default."""
    for name, variant in _define_variants(root, PAINT_SET, paints):
        _display(variant, material_colour(MATERIALS[paints[name]]))
        surface = _over(variant, "Looks", pascal_case("car_paint"), "Surface")
        set_varying(surface, MATERIALS[paints[name]])


def _display(prim: Sdf.PrimSpec, colour_rgb: tuple[float, float, float]) -> None:
    """Author a display colour, which all meshes below inherit, for viewers that do not draw materials."""
    attribute(prim, "primvars:displayColor", _TYPES.Color3fArray, Vt.Vec3fArray([Gf.Vec3f(*colour_rgb)]))


def _define_power(root: Sdf.PrimSpec, light: AreaLight, glowing: Mapping[str, Material]) -> None:
    """Define light and glow of an asset by the variants on and off.

    Lights of any colour with equal luminance appear equally bright.
    """
    shares = {"on": 1.0, "off": 0.0}
    brighter = luminance_of(USUAL_LAMP_RGB) / luminance_of(light.colour_rgb)
    tint = [brighter * channel / usual for channel, usual in zip(light.colour_rgb, USUAL_LAMP_RGB, strict=True)]
    for name, variant in _define_variants(root, POWER_SET, shares):
        intensity = shares[name] * light.luminance_nit / NITS_PER_INTENSITY * brighter
        attribute(_over(variant, "Light"), "inputs:intensity", _TYPES.Float, intensity)
        for key, material in glowing.items():
            red, green, blue = (
                shares[name] * channel * factor for channel, factor in zip(material.emissive_rgb, tint, strict=True)
            )
            set_glow(_over(variant, "Looks", pascal_case(key), "Surface"), (red, green, blue))


def _define_variants(root: Sdf.PrimSpec, name: str, variants: Iterable[str]) -> Iterator[tuple[str, Sdf.PrimSpec]]:
    """Define a variant set with the first variant selected; yield the name and the prim of each variant."""
    root.SetInfo("variantSetNames", Sdf.StringListOp.Create(prependedItems=[name]))
    root.SetInfo("variantSelection", {name: next(iter(variants))})
    choices = Sdf.VariantSetSpec(root, name)
    for variant in variants:
        yield variant, Sdf.VariantSpec(choices, variant).primSpec


def _over(variant: Sdf.PrimSpec, *names: str) -> Sdf.PrimSpec:
    """Over spec in a variant for a prim, by the names of its ancestors and its own."""
    path = variant.path
    for name in names:
        path = path.AppendChild(name)
    return Sdf.CreatePrimInLayer(variant.layer, path)


def define_mesh(
    layer: Sdf.Layer,
    path: Sdf.Path,
    part: Part,
    looks: Sdf.Path,
    *,
    finish: Material | None = None,
    is_compact: bool = False,
    mass_kg: float | None = None,
) -> None:
    """Define a mesh with the material of its key, or the finish that replaces it, and its collider if it has one.

    A compact mesh has texture coordinates in the order of its points, if each point has only one, so that the layer
    stores the indices of both once.
    """
    finish = finish or MATERIALS[part.material]
    usual = MATERIALS.get(part.material, finish)
    mesh = define(layer, path, "Mesh")
    if part.double_sided:
        attribute(mesh, "doubleSided", _TYPES.Bool, value=True, uniform=True)
    points = Vt.Vec3fArray.FromNumpy(part.own_points)
    attribute(mesh, "points", _TYPES.Point3fArray, points)
    numbers(mesh, "faceVertexCounts", part.face_counts)
    numbers(mesh, "faceVertexIndices", part.face_indices)
    attribute(mesh, "subdivisionScheme", _TYPES.Token, UsdGeom.Tokens.none, uniform=True)
    attribute(mesh, "extent", _TYPES.Float3Array, UsdGeom.PointBased.ComputeExtent(points))
    # as a primvar, since the schema's attribute takes no indices, which halve the size of a car
    normals = Vt.Vec3fArray.FromNumpy(_own_normals(part))
    _define_primvar(mesh, "normals", _TYPES.Normal3fArray, normals, part.normal_indices)
    if part.pose is not None:
        x_m, y_m, z_m, yaw_deg = part.pose
        operation(mesh, "translate", _TYPES.Float3, Gf.Vec3f(x_m, y_m, z_m))
        operation(mesh, "rotateY", _TYPES.Float, yaw_deg)
        order_operations(mesh, ["translate", "rotateY"])
    if len(part.st):
        st, st_indices = _as_points(part) if is_compact else (part.st, part.st_indices)
        st = st * _repeats(usual, finish) if finish != usual else st
        _define_primvar(mesh, "st", _TYPES.TexCoord2fArray, Vt.Vec2fArray.FromNumpy(st), st_indices)
    relationship(mesh, "material:binding", [_look(looks, part.material)])
    if part.collider is None:
        apply_schemas(mesh, "MaterialBindingAPI")
        return
    weighed = () if mass_kg is None else ("PhysicsMassAPI",)
    apply_schemas(mesh, "MaterialBindingAPI", "PhysicsCollisionAPI", "PhysicsMeshCollisionAPI", *weighed)
    if mass_kg is not None:
        attribute(mesh, "physics:mass", _TYPES.Float, mass_kg)
    attribute(mesh, "physics:approximation", _TYPES.Token, part.collider.value, uniform=True)
    relationship(mesh, "material:binding:physics", [_friction(looks, finish.touch)])


def _own_normals(part: Part) -> NDArray[np.float32]:
    """Normals of a part in the axes of its pose, rounded so that equal parts have equal arrays."""
    if part.pose is None:
        return part.normals
    normals = np.round(part.normals.astype(np.float64) @ part.pose.turn.T, _NORMAL_DECIMALS) + 0.0
    return np.asarray(normals, np.float32)


def _as_points(part: Part) -> tuple[NDArray[np.float32], NDArray[np.int32]]:
    """Texture coordinates and their indices in the order of the points, if each point has one pair at all corners."""
    st_of = np.empty(len(part.points), dtype=np.int32)
    st_of[part.face_indices] = part.st_indices
    is_one = (st_of[part.face_indices] == part.st_indices).all()
    return (part.st[st_of], part.face_indices) if is_one else (part.st, part.st_indices)


def _repeats(usual: Material, finish: Material) -> NDArray[np.float32]:
    """Ratio of a finish's texture repeats to those of the standard material, along U and V."""
    return np.array(
        [
            usual.repeat_m / finish.repeat_m,
            (usual.repeat_up_m or usual.repeat_m) / (finish.repeat_up_m or finish.repeat_m),
        ],
        dtype=np.float32,
    )


def _define_primvar(
    mesh: Sdf.PrimSpec, name: str, type_name: Sdf.ValueTypeName, values: object, indices: NDArray[np.int32]
) -> None:
    """Define a face-varying primvar, with indices if given."""
    primvar = attribute(mesh, f"primvars:{name}", type_name, values)
    primvar.SetInfo("interpolation", UsdGeom.Tokens.faceVarying)
    numbers(mesh, f"primvars:{name}:indices", indices)


def _define_light(layer: Sdf.Layer, path: Sdf.Path, light: AreaLight) -> None:
    area = define(layer, path, "DiskLight" if light.is_round else "RectLight")
    if light.is_round:
        attribute(area, "inputs:radius", _TYPES.Float, light.width_m / 2)
    else:
        attribute(area, "inputs:width", _TYPES.Float, light.width_m)
        attribute(area, "inputs:height", _TYPES.Float, light.depth_m)
    attribute(area, "inputs:color", _TYPES.Color3f, Gf.Vec3f(*light.colour_rgb))
    attribute(area, "inputs:normalize", _TYPES.Bool, value=False)
    attribute(area, "garage:light:luminance", _TYPES.Float, light.luminance_nit)
    corner_m = np.array([light.width_m, light.depth_m]) / 2
    extent = np.array([[*-corner_m, 0.0], [*corner_m, 0.0]], dtype=np.float32)
    attribute(area, "extent", _TYPES.Float3Array, Vt.Vec3fArray.FromNumpy(extent))
    # the light shines along -Z; a rotation by -90 degrees about X turns it down
    operation(area, "translate", _TYPES.Float3, Gf.Vec3f(0, light.height_m, 0))
    operation(area, "rotateX", _TYPES.Float, -90.0)
    order_operations(area, ["translate", "rotateX"])
