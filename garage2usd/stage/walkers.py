"""People who walk, in a layer: skinned meshes on skeletons with animations, by UsdSkel."""

from collections.abc import Iterable
from dataclasses import replace
from pathlib import Path
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray
from pxr import Gf, Kind, Sdf, Vt

from garage2usd.assets import MATERIALS, NON_VISUAL, pascal_case
from garage2usd.assets.figures import Figure, skinned_figure
from garage2usd.assets.gait import Motion
from garage2usd.assets.skeletons import PARENTS, Skeleton, joint_paths, strongest
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

GROUP, HIPS_MOVE = "Walkers", "translate:hips"
"""Names of the group of walkers below ``/Garage``, and of the operation that moves the hips of a figure."""
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
            root = define_figure(layer, garage.path.AppendChild(GROUP).AppendChild(walker.name), walker.figure)
            place = operation(root, "translate", _TYPES.Double3, Gf.Vec3d(*walker.places_m[0]))
            turn = operation(root, "rotateY", _TYPES.Double, float(np.degrees(walker.yaws_rad[0])))
            order_operations(root, ["translate", "rotateY", HIPS_MOVE])
            yaws = np.degrees(np.unwrap(walker.yaws_rad))
            for frame in range(len(yaws)):
                layer.SetTimeSample(place.path, frame, Gf.Vec3d(*np.round(walker.places_m[frame], 5).tolist()))
                layer.SetTimeSample(turn.path, frame, round(float(yaws[frame]), 4))
            animate_figure(layer, root, walker.figure.skeleton, range(len(yaws)), walker.motion)


def define_figure(layer: Sdf.Layer, path: Sdf.Path, figure: Figure) -> Sdf.PrimSpec:
    """Define a person at rest as a SkelRoot that faces +Z, with skeleton, meshes and materials; return the root."""
    skin, rest = skinned_figure(figure), figure.skeleton.rest_m
    root = define(layer, path, "SkelRoot", kind=Kind.Tokens.component, label=KIND.label)
    tall = figure.height_m
    extent = Vt.Vec3fArray([Gf.Vec3f(-tall / 2, -0.05, -tall / 2), Gf.Vec3f(tall / 2, tall * 1.1, tall / 2)])
    attribute(root, "extent", _TYPES.Float3Array, extent)
    skeleton = define(layer, path.AppendChild("Skeleton"), "Skeleton")
    for name, places in (("bindTransforms", rest), ("restTransforms", _bones(rest))):
        matrices = [Gf.Matrix4d(1.0).SetTranslate(Gf.Vec3d(*row)) for row in np.round(places, 6).tolist()]
        attribute(skeleton, name, _TYPES.Matrix4dArray, Vt.Matrix4dArray(matrices), uniform=True)
    attribute(skeleton, "joints", _TYPES.TokenArray, Vt.TokenArray(joint_paths()), uniform=True)
    apply_schemas(skeleton, "SkelBindingAPI")
    looks = define(layer, path.AppendChild("Looks"), "Scope").path
    for key in sorted({part.material for part in skin.parts}):
        material = named_textures(MATERIALS[key], TextureQuality.HIGH)
        define_material(layer, looks.AppendChild(pascal_case(key)), material, non_visual=NON_VISUAL[key])
    define(layer, path.AppendChild("Geom"), "Scope")
    for part, weights in zip(skin.parts, skin.weights, strict=True):
        mesh = path.AppendChild("Geom").AppendChild(part.name)
        define_mesh(layer, mesh, replace(part, collider=None), looks)
        _bind(layer.GetPrimAtPath(mesh), weights, skeleton.path)
    return root


def animate_figure(
    layer: Sdf.Layer, root: Sdf.PrimSpec, skeleton: Skeleton, frames: Iterable[float], motion: Motion
) -> None:
    """Author the poses of a person at frames below a SkelRoot of `define_figure`, or one that refers to it.

    The operation `HIPS_MOVE` of the root moves the hips, so that the joints only turn: translations of all joints would
    take as much again as their rotations.
    """
    names, bones = joint_paths(), _bones(skeleton.rest_m)
    animation = define(layer, root.path.AppendChild("Animation"), "SkelAnimation")
    attribute(animation, "joints", _TYPES.TokenArray, Vt.TokenArray(names), uniform=True)
    attribute(animation, "scales", _TYPES.Half3Array, Vt.Vec3hArray([Gf.Vec3h(1.0, 1.0, 1.0)] * len(names)))
    bound = Vt.Vec3fArray.FromNumpy(bones.round(6).astype(np.float32))
    attribute(animation, "translations", _TYPES.Float3Array, bound)
    turns = attribute(animation, "rotations", _TYPES.QuatfArray)
    moves = operation(root, HIPS_MOVE, _TYPES.Float3, Gf.Vec3f(0.0))
    by = (motion.hips_m - bones[0]).round(5).tolist()
    for frame, rotations, move in zip(frames, motion.rotations.round(6).astype(np.float32), by, strict=True):
        layer.SetTimeSample(moves.path, frame, Gf.Vec3f(*move))
        layer.SetTimeSample(turns.path, frame, Vt.QuatfArray.FromNumpy(rotations))
    bound_skeleton = Sdf.CreatePrimInLayer(layer, root.path.AppendChild("Skeleton"))
    relationship(bound_skeleton, "skel:animationSource", [animation.path])


def _bones(rest_m: NDArray[np.float64]) -> NDArray[np.float64]:
    """Places of joints at rest from their parents."""
    bones: NDArray[np.float64] = rest_m - np.array([rest_m[up] if up >= 0 else np.zeros(3) for up in PARENTS])
    return bones


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
