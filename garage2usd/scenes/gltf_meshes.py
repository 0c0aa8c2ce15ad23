"""Meshes of glTF 2.0 as triangles, placed by their nodes, skins in their rest pose."""

from collections.abc import Iterator, Mapping, Sequence
from functools import cached_property
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from garage2usd.scenes.gltf_file import GltfFile, title_of
from garage2usd.scenes.meshes import Triangles
from garage2usd.scenes.prims import Matrix
from garage2usd.scenes.remarks import Remarks
from garage2usd.scenes.surfaces import SurfaceLook
from garage2usd.scenes.textures import Coordinates

_TRIANGLES, _STRIP, _FAN = 4, 5, 6
_MOST_COPIES = 100_000
_INSTANCING, _VISIBILITY = "EXT_mesh_gpu_instancing", "KHR_node_visibility"


class GltfMesh(NamedTuple):
    """A primitive of a mesh at a node.

    Attributes
    ----------
    name
        Names of the nodes from the root, and of the mesh, separated by ``/``.
    primitive
        Its JSON.
    matrix
        From the primitive's space to the scene's; None for a skin, which `triangles` poses in the scene.
    node
        Its node.
    """

    name: str
    primitive: Mapping[str, Any]
    matrix: Matrix | None
    node: Mapping[str, Any]


class GltfMeshes:
    """Reader of the meshes of a file's scene.

    Parameters
    ----------
    file
        The file.
    remarks
        Receives remarks on omitted parts.
    """

    def __init__(self, file: GltfFile, remarks: Remarks) -> None:
        self._file, self._remarks = file, remarks
        self._nodes = file.table("nodes")
        self._read: dict[int | None, Triangles] = {}

    def drawn(self) -> Iterator[GltfMesh]:
        """Yield the primitives that the file's scene draws as triangles."""
        for number in self._roots():
            yield from self._drawn(number, "", np.eye(4))

    def triangles(self, mesh: GltfMesh, look: SurfaceLook, *, double_sided: bool) -> Triangles | None:
        """Return the triangles of a primitive in its own space, or of a skin in the scene's; None without any.

        Parameters
        ----------
        mesh
            The primitive.
        look
            Its surface, whose texture coordinates and colours are read.
        double_sided
            True if the back is visible.
        """
        # skins and morphs differ between nodes; ids are stable, as the document of the file is kept
        key = id(mesh.primitive) if mesh.matrix is not None and "weights" not in mesh.node else None
        if key in self._read:
            return self._read[key]
        attributes = self._attributes(mesh)
        count = len(attributes["POSITION"])
        corners = self._corners(mesh, count)
        if corners.size and not 0 <= corners.min() <= corners.max() < count:
            raise self._file.fault(f"with corner {corners.max()} of {count} in {mesh.name}")
        # primitives may share accessors, and each names some of their rows
        vertices, inverse = np.unique(corners, return_inverse=True)
        positions, corners = attributes["POSITION"][vertices].astype(np.float64), inverse.reshape(-1, 3)
        corners = corners[np.isfinite(positions[corners]).all(axis=(1, 2))]
        if not len(corners):
            return None
        given = attributes.get("NORMAL")
        has_normals = given is not None and len(given) == count
        if has_normals and given is not None:
            normals = given[vertices].astype(np.float64)
        else:  # faceted (3.7.2.1), so that no two triangles share a vertex
            order, corners = corners.ravel(), np.arange(corners.size).reshape(-1, 3)
            vertices, positions = vertices[order], positions[order]
            first, second = (positions[corners[:, side]] - positions[corners[:, 0]] for side in (1, 2))
            normals = np.repeat(np.cross(first, second), 3, axis=0)
        joints = self._joints(mesh, attributes)
        if joints is not None:
            positions = _posed(positions, joints[vertices], 1.0)
            normals = _posed(normals, joints[vertices], 0.0)
        sets = [self._coordinates(mesh, attributes, look, own, vertices) for own in look.sets]
        colours = attributes.get(look.colour_name)
        if colours is not None and self._counts_alpha(mesh) and (colours[:, 3:] < 1).any():
            self._remarks.add("opacities by point are not used", mesh.name)
        if colours is not None:
            colours = np.clip(np.nan_to_num(colours[vertices][:, :3] * look.colour_rgb), 0, 1).astype(np.float32)
        placed = Triangles(
            positions.astype(np.float32),
            normals.astype(np.float32),
            np.stack(sets, axis=1).astype(np.float32),
            corners.astype(np.uint32),
            np.arange(len(corners), dtype=np.int32),
            double_sided,
            colours,
            has_normals,
        ).moved(np.eye(4))  # with normals of unit length
        if key is not None:
            self._read[key] = placed
        return placed

    def _roots(self) -> Sequence[int]:
        if self._file.table("scenes"):
            scene = self._file.entry("scenes", self._file.document.get("scene", 0))
            named = dict.fromkeys(scene.get("nodes", ()))
            return [number for number in named if not any(above in named for above in self._above(number))]
        return [number for number in range(len(self._nodes)) if number not in self._parents]

    def _drawn(self, number: int, above: str, matrix: Matrix) -> Iterator[GltfMesh]:
        node = self._file.entry("nodes", number)
        extensions = node.get("extensions", {})
        if extensions.get(_VISIBILITY, {}).get("visible") is False:
            return
        name, place = f"{above}/{title_of(node, 'nodes', number)}", _place(node) @ matrix
        if "mesh" in node:
            mesh = self._file.entry("meshes", node["mesh"])
            of_mesh = f"{name}/{title_of(mesh, 'meshes', node['mesh'])}"
            for primitive in mesh["primitives"]:
                if primitive.get("mode", _TRIANGLES) < _TRIANGLES:
                    self._remarks.add("points and lines are left out", of_mesh)
                elif "skin" in node:
                    yield GltfMesh(of_mesh, primitive, None, node)
                else:
                    for instance in self._instances(extensions.get(_INSTANCING)):
                        yield GltfMesh(of_mesh, primitive, instance @ place, node)
        for child in node.get("children", ()):
            yield from self._drawn(child, name, place)

    def _instances(self, instancing: Mapping[str, Any] | None) -> list[Matrix]:
        """Return the transforms of the copies of a node's mesh."""
        if instancing is None:
            return [np.eye(4)]
        given = {name: self._file.numbers.of(number) for name, number in instancing.get("attributes", {}).items()}
        keys = {"translation": "TRANSLATION", "rotation": "ROTATION", "scale": "SCALE"}
        count = min(map(len, given.values()), default=0)
        if count > _MOST_COPIES:
            raise self._file.fault(f"with {count} copies of a mesh")
        return [
            _place({key: given[name][row].tolist() for key, name in keys.items() if name in given})
            for row in range(count)
        ]

    def _attributes(self, mesh: GltfMesh) -> dict[str, NDArray[Any]]:
        """Return the vertex attributes of a primitive, with its morph targets at their weights."""
        given = mesh.primitive
        found = {name: values for name, values in self._file.compressed(given).items() if name}
        for name, number in given["attributes"].items():
            if name not in found:
                found[name] = self._file.numbers.of(number)
        weights = mesh.node.get("weights", self._weights_of(mesh.node["mesh"]))
        for weight, target in zip(weights, given.get("targets", ()), strict=False):
            for name in ("POSITION", "NORMAL") if weight else ():
                if name in target and name in found:
                    found[name] = found[name].astype(np.float64) + weight * self._file.numbers.of(target[name])
        return found

    def _weights_of(self, number: int) -> Sequence[float]:
        weights: Sequence[float] = self._file.entry("meshes", number).get("weights", ())
        return weights

    def _corners(self, mesh: GltfMesh, count: int) -> NDArray[np.int64]:
        """Return the vertices of each triangle, shape (triangles, 3)."""
        given = mesh.primitive
        row, mode = self._file.compressed(given).get(""), given.get("mode", _TRIANGLES)
        if row is not None:
            mode = _TRIANGLES  # strips are decompressed to these
        elif "indices" in given:
            row = self._file.numbers.of(given["indices"])
        row = np.arange(count) if row is None else row.astype(np.int64).ravel()
        if mode == _TRIANGLES:
            return row[: len(row) // 3 * 3].reshape(-1, 3)
        number = np.arange(max(len(row) - 2, 0))
        if mode == _STRIP:  # every other triangle has the opposite winding
            order = [number, number + 1 + number % 2, number + 2 - number % 2]
        elif mode == _FAN:
            order = [number + 1, number + 2, np.zeros_like(number)]
        else:
            raise self._file.fault(f"with mode {mode} in {mesh.name}")
        taken: NDArray[np.int64] = row[np.stack(order, axis=1)]
        return taken

    def _joints(self, mesh: GltfMesh, attributes: Mapping[str, NDArray[Any]]) -> NDArray[np.float64] | None:
        """Return the transform of each vertex of a skin to the scene, shape (vertices, 4, 4); None without a skin."""
        if mesh.matrix is not None:
            return None
        skin = self._file.entry("skins", mesh.node["skin"])
        poses = np.stack([self._places[joint] for joint in skin["joints"]])
        if "inverseBindMatrices" in skin:
            poses = self._file.numbers.of(skin["inverseBindMatrices"]).reshape(-1, 4, 4)[: len(poses)] @ poses
        total = np.zeros((len(attributes["POSITION"]), 4, 4))
        for group in range(len(attributes)):
            if f"JOINTS_{group}" in attributes:
                weights = attributes[f"WEIGHTS_{group}"].astype(np.float64)
                total += (weights[..., None, None] * poses[attributes[f"JOINTS_{group}"].astype(np.int64)]).sum(axis=1)
        sums = total[:, 3, 3]  # weights that add up to 1, except for rounding
        total[sums <= 0], sums[sums <= 0] = np.eye(4), 1.0
        return np.asarray(total / sums[:, None, None])

    def _above(self, number: int) -> Iterator[int]:
        """Yield the ancestors of a node, from its parent upwards."""
        while number in self._parents:
            number = self._parents[number]
            yield number

    @cached_property
    def _parents(self) -> Mapping[int, int]:
        """Parent of each node that has one."""
        return {child: number for number, node in enumerate(self._nodes) for child in node.get("children", ())}

    def _counts_alpha(self, mesh: GltfMesh) -> bool:
        """Return True if the opacity of a primitive has an effect in its material."""
        material = mesh.primitive.get("material")
        return material is not None and self._file.entry("materials", material).get("alphaMode", "OPAQUE") != "OPAQUE"

    @cached_property
    def _places(self) -> dict[int, Matrix]:
        """Transforms of all nodes to the scene."""
        places: dict[int, Matrix] = {}
        waiting = [(number, np.eye(4)) for number in range(len(self._nodes)) if number not in self._parents]
        while waiting:
            number, above = waiting.pop()
            places[number] = _place(self._nodes[number]) @ above
            waiting += [(child, places[number]) for child in self._nodes[number].get("children", ())]
        return places

    def _coordinates(
        self,
        mesh: GltfMesh,
        attributes: Mapping[str, NDArray[Any]],
        look: SurfaceLook,
        wanted: Coordinates,
        vertices: NDArray[np.int64],
    ) -> NDArray[np.float64]:
        """Return texture coordinates with V upwards, shape (vertices, 2)."""
        given = attributes.get(wanted.name)
        if given is not None:
            return given[vertices].astype(np.float64) * (1, -1) + (0, 1)
        if look.has_textures and wanted.name:
            self._remarks.add(f"textures show one pixel without the coordinates {wanted.name}", mesh.name)
        return np.broadcast_to(np.array(wanted.fallback), (len(vertices), 2))


def set_named(number: int) -> str:
    """Return the name of a set of texture coordinates."""
    return f"TEXCOORD_{number}"


def _place(node: Mapping[str, Any]) -> Matrix:
    """Return the transform of a node for row vectors."""
    if "matrix" in node:
        return np.array(node["matrix"], dtype=np.float64).reshape(4, 4)
    x, y, z, w = np.array(node.get("rotation", (0, 0, 0, 1)), dtype=np.float64)
    matrix = np.eye(4)
    turn = np.array(
        [
            [1 - 2 * (y * y + z * z), 2 * (x * y + z * w), 2 * (x * z - y * w)],
            [2 * (x * y - z * w), 1 - 2 * (x * x + z * z), 2 * (y * z + x * w)],
            [2 * (x * z + y * w), 2 * (y * z - x * w), 1 - 2 * (x * x + y * y)],
        ]
    )
    matrix[:3, :3] = np.array(node.get("scale", (1, 1, 1)), dtype=np.float64)[:, None] * turn
    matrix[3, :3] = node.get("translation", (0, 0, 0))
    return matrix


def _posed(vectors: NDArray[np.float64], joints: NDArray[np.float64], shift: float) -> NDArray[np.float64]:
    """Transform vectors each by a matrix of its own; `shift` is 1 for points and 0 for directions."""
    placed: NDArray[np.float64] = np.einsum("ni,nij->nj", vectors, joints[:, :3, :3]) + shift * joints[:, 3, :3]
    return placed
