"""People who walk, in a layer: skinned meshes on skeletons with animations, by UsdSkel."""

from collections.abc import Iterable
from dataclasses import replace
from pathlib import Path
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray
from pxr import Gf, Kind, Sdf, Vt

from garage2usd.assets import MATERIALS, NON_VISUAL, pascal_case
from garage2usd.assets.figures import Figure, SkinnedFigure, skinned_figure
from garage2usd.assets.gait import Motion
from garage2usd.assets.skeletons import PARENTS, joint_paths, strongest
from garage2usd.config.outputs import TextureQuality
from garage2usd.objects.person import KIND
from garage2usd.stage.authoring import (
    apply_schemas,
    attribute,
    define,
    new_layer,
    operation,
    order_operations,
    relationship,
)
from garage2usd.stage.cameras import set_frames
from garage2usd.stage.looks import define_material, named_textures
from garage2usd.stage.prototype_layer import define_mesh

GROUP = "Walkers"
"""Name of the group of walkers below ``/Garage``."""
_TYPES = Sdf.ValueTypeNames
_STRONGEST = 4


class Walker(NamedTuple):
    """A person at the frames of a layer, from frame 0.

    Attributes
    ----------
    name, figure
        Name of its prim, and its looks.
    places_m
        Origin on the floor, (x, y, z); float64, shape (frames, 3).
    yaws_rad
        Rotation about +Y, 0 facing +Z; float64, shape (frames,).
    motion
        Poses of the joints at the frames.
    """

    name: str
    figure: Figure
    places_m: NDArray[np.float64]
    yaws_rad: NDArray[np.float64]
    motion: Motion


def write_walkers(path: Path, walkers: Iterable[Walker]) -> None:
    """Write a layer ``over /Garage`` with each person as a SkelRoot below ``/Garage/Walkers``.

    Notes
    -----
    24 frames per second, as in the stage, from frame 0. Blender 4 and later and usdview play the skins.
    """
    people = tuple(walkers)
    with new_layer(path, default_prim="Garage") as layer:
        set_frames(layer, max((len(walker.yaws_rad) for walker in people), default=1) - 1)
        garage = Sdf.CreatePrimInLayer(layer, "/Garage")
        garage.specifier = Sdf.SpecifierOver
        define(layer, garage.path.AppendChild(GROUP), "Scope")
        for walker in people:
            define_walker(layer, garage.path.AppendChild(GROUP).AppendChild(walker.name), walker)


def define_walker(layer: Sdf.Layer, path: Sdf.Path, walker: Walker) -> None:
    """Define a person as a SkelRoot with its skeleton, animation, meshes and materials."""
    skin = skinned_figure(walker.figure)
    root = define(layer, path, "SkelRoot", kind=Kind.Tokens.component, label=KIND.label)
    tall = walker.figure.height_m
    extent = Vt.Vec3fArray([Gf.Vec3f(-tall / 2, -0.05, -tall / 2), Gf.Vec3f(tall / 2, tall * 1.05, tall / 2)])
    attribute(root, "extent", _TYPES.Float3Array, extent)
    frames = range(len(walker.yaws_rad))
    place = operation(root, "translate", _TYPES.Double3, Gf.Vec3d(*walker.places_m[0]))
    turn = operation(root, "rotateY", _TYPES.Double, float(np.degrees(walker.yaws_rad[0])))
    order_operations(root, ["translate", "rotateY"])
    yaws = np.degrees(np.unwrap(walker.yaws_rad))
    for frame in frames:
        layer.SetTimeSample(place.path, frame, Gf.Vec3d(*np.round(walker.places_m[frame], 5).tolist()))
        layer.SetTimeSample(turn.path, frame, round(float(yaws[frame]), 4))
    skeleton = _define_skeleton(layer, path, skin, walker.motion)
    looks = define(layer, path.AppendChild("Looks"), "Scope").path
    for key in sorted({part.material for part in skin.parts}):
        material = named_textures(MATERIALS[key], TextureQuality.HIGH)
        define_material(layer, looks.AppendChild(pascal_case(key)), material, non_visual=NON_VISUAL[key])
    define(layer, path.AppendChild("Geom"), "Scope")
    for part, weights in zip(skin.parts, skin.weights, strict=True):
        mesh = path.AppendChild("Geom").AppendChild(part.name)
        define_mesh(layer, mesh, replace(part, collider=None), looks)
        _bind(layer.GetPrimAtPath(mesh), weights, skeleton)


def _define_skeleton(layer: Sdf.Layer, path: Sdf.Path, skin: SkinnedFigure, motion: Motion) -> Sdf.Path:
    """Define skeleton and animation; return the path of the skeleton."""
    skeleton, names = define(layer, path.AppendChild("Skeleton"), "Skeleton"), joint_paths()
    rest = skin.skeleton.rest_m
    bones = rest - np.array([rest[parent] if parent >= 0 else np.zeros(3) for parent in PARENTS])
    for name, places in (("bindTransforms", rest), ("restTransforms", bones)):
        matrices = [Gf.Matrix4d(1.0).SetTranslate(Gf.Vec3d(*row)) for row in np.round(places, 6).tolist()]
        attribute(skeleton, name, _TYPES.Matrix4dArray, Vt.Matrix4dArray(matrices), uniform=True)
    animation = define(layer, path.AppendChild("Animation"), "SkelAnimation")
    for prim in (skeleton, animation):
        joints = Vt.TokenArray(names)
        attribute(prim, "joints", _TYPES.TokenArray, joints, uniform=True)
    apply_schemas(skeleton, "SkelBindingAPI")
    relationship(skeleton, "skel:animationSource", [animation.path])
    attribute(animation, "scales", _TYPES.Half3Array, Vt.Vec3hArray([Gf.Vec3h(1.0, 1.0, 1.0)] * len(names)))
    moves = attribute(animation, "translations", _TYPES.Float3Array)
    turns = attribute(animation, "rotations", _TYPES.QuatfArray)
    for frame, (rotations, hips) in enumerate(zip(motion.rotations, motion.hips_m, strict=True)):
        translations = np.vstack([hips, bones[1:]]).round(6).astype(np.float32)
        layer.SetTimeSample(moves.path, frame, Vt.Vec3fArray.FromNumpy(translations))
        quaternions = [Gf.Quatf(w, x, y, z) for x, y, z, w in rotations.round(6).tolist()]
        layer.SetTimeSample(turns.path, frame, Vt.QuatfArray(quaternions))
    return skeleton.path


def _bind(mesh: Sdf.PrimSpec, weights: NDArray[np.float64], skeleton: Sdf.Path) -> None:
    """Bind the points of a mesh to the joints."""
    apply_schemas(mesh, "MaterialBindingAPI", "SkelBindingAPI")
    relationship(mesh, "skel:skeleton", [skeleton])
    indices, shares = strongest(weights)
    attribute(mesh, "primvars:skel:geomBindTransform", _TYPES.Matrix4d, Gf.Matrix4d(1.0))
    for name, type_name, values in (
        ("jointIndices", _TYPES.IntArray, Vt.IntArray.FromNumpy(indices.ravel())),
        ("jointWeights", _TYPES.FloatArray, Vt.FloatArray.FromNumpy(shares.ravel())),
    ):
        spec = attribute(mesh, f"primvars:skel:{name}", type_name, values)
        spec.SetInfo("elementSize", _STRONGEST)
        spec.SetInfo("interpolation", "vertex")
