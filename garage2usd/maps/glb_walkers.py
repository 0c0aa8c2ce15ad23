"""People who walk, as a binary glTF file with skins and animations."""

from collections.abc import Iterable, Iterator

import numpy as np
from numpy.typing import NDArray

from garage2usd.assets import MATERIALS, Part, pascal_case
from garage2usd.assets.figures import skinned_figure
from garage2usd.assets.skeletons import JOINTS, PARENTS, strongest
from garage2usd.maps.glb_file import Channel, GlbFile, Piece, Skin
from garage2usd.scenes.meshes import Triangles
from garage2usd.scenes.pictures import Pictures
from garage2usd.scenes.remarks import Remarks
from garage2usd.scenes.surfaces import SurfaceLook
from garage2usd.stage.walkers import Walker


def walkers_glb(walkers: Iterable[Walker], times_s: NDArray[np.float64]) -> bytes:
    """Write people as the bytes of a GLB file.

    Parameters
    ----------
    walkers
        The people, all with the same number of poses.
    times_s
        Ascending times of the poses; shape (k,).

    Returns
    -------
    bytes
        One animation moves the nodes and joints of all. Metres, Y up.
    """
    file = GlbFile(Pictures(), Remarks())
    times = times_s.astype(np.float32)
    file.add_animation("Walkers", [channel for walker in walkers for channel in _added(file, walker, times)])
    return file.data({})


def _added(file: GlbFile, walker: Walker, times_s: NDArray[np.float32]) -> Iterator[Channel]:
    """Add a person, and yield what moves it."""
    figure = skinned_figure(walker.figure)
    rest, motion = figure.skeleton.rest_m, walker.motion
    root = file.add_node(walker.name, _moved(np.zeros(3)))
    joints: list[int] = []
    for name, place, parent in zip(JOINTS, rest, PARENTS, strict=True):
        bone, above = (place, root) if parent < 0 else (place - rest[parent], joints[parent])
        joints.append(file.add_node(f"{walker.name}_{name}", _moved(bone), above=above))
    inverse_binds = np.array([_moved(-place) for place in rest], np.float32)
    skin = file.add_skin(walker.name, joints, inverse_binds)
    for part, weights in zip(figure.parts, figure.weights, strict=True):
        name = f"{walker.name}_{part.name}"
        mesh = file.add_mesh([_piece(part, weights)], name)
        # the joints alone move a skinned mesh, wherever its node is
        file.add_node(name, _moved(np.zeros(3)), mesh=mesh, skin=skin)
    half = np.unwrap(walker.yaws_rad) / 2
    still = np.zeros_like(half)
    turns = np.column_stack([still, np.sin(half), still, np.cos(half)])
    moves = [(root, "translation", walker.places_m), (root, "rotation", turns)]
    moves += [(joints[0], "translation", motion.hips_m)]
    moves += [(joint, "rotation", motion.rotations[:, number]) for number, joint in enumerate(joints)]
    yield from (Channel(node, way, times_s, own.astype(np.float32)) for node, way, own in moves)


def _moved(by: NDArray[np.float64]) -> NDArray[np.float64]:
    """Translation as a matrix for points as rows."""
    matrix = np.eye(4)
    matrix[3, :3] = by
    return matrix


def _piece(part: Part, weights: NDArray[np.float64]) -> Piece:
    """Triangles of a part, with one vertex for each point and normal, and their joints."""
    pairs = np.stack([part.face_indices, part.normal_indices], axis=1)
    vertices, corners = np.unique(pairs, axis=0, return_inverse=True)
    starts = np.cumsum(part.face_counts) - part.face_counts
    fans = part.face_counts - 2
    face_of = np.repeat(np.arange(len(fans)), fans)
    step = np.arange(len(face_of)) - np.repeat(np.cumsum(fans) - fans, fans) + 1
    first = starts[face_of]
    indices = corners.ravel()[np.stack([first, first + step, first + step + 1], axis=1)]
    joints, shares = strongest(weights[vertices[:, 0]])
    material = MATERIALS[part.material]
    look = SurfaceLook(material.colour_rgb, roughness=material.roughness, name=pascal_case(part.material))
    triangles = Triangles(
        part.points[vertices[:, 0]],
        part.normals[vertices[:, 1]],
        np.empty((len(vertices), 0, 2), np.float32),
        indices.astype(np.uint32),
        face_of.astype(np.int32),
        double_sided=False,
    )
    return Piece(triangles, look, is_faceted=False, skin=Skin(joints.astype(np.uint8), shares))
