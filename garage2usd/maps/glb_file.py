"""A binary glTF 2.0 file in the making: meshes, nodes, materials and images, packed by trimesh."""

from collections.abc import Mapping, MutableMapping
from typing import TYPE_CHECKING, Any

import numpy as np

from garage2usd.errors import MissingExtraError
from garage2usd.maps.glb_materials import Materials
from garage2usd.maps.glb_meshes import place_of, tangents_of
from garage2usd.reading.meshes import Triangles
from garage2usd.reading.objects import Matrix
from garage2usd.reading.surfaces import SurfaceLook
from garage2usd.version import VERSION

if TYPE_CHECKING:
    import trimesh

__all__ = ["GlbFile"]

_UINT16 = 5123
_MOST_SHORT = 2**16 - 1
"""Vertices that 16 bits number; the last number would restart a primitive."""
_TANGENT = "_TANGENT"
"""What trimesh calls an attribute of one's own that is named TANGENT."""
_ALIGNMENT = 4


class GlbFile:
    """Collects nodes and what they draw: equal meshes with equal materials once."""

    def __init__(self) -> None:
        """Begin an empty file.

        Raises
        ------
        MissingExtraError
            If trimesh is not installed.
        """
        try:
            import trimesh  # noqa: PLC0415 - an extra
        except ImportError as error:
            raise MissingExtraError("GLB", "maps", "trimesh") from error
        self._trimesh = trimesh
        self._scene: trimesh.Scene = trimesh.Scene()
        self._materials = Materials()
        self._places: dict[str, dict[str, list[float]]] = {}
        self._material_of: dict[str, int] = {}
        self._mesh_of: dict[tuple[bytes, int], str] = {}
        self._key_of: dict[Triangles, bytes] = {}

    def mesh(self, triangles: Triangles, surface: SurfaceLook, *, name: str) -> str:
        """Name of the mesh with some triangles and a surface; a number after `name` where it is a new one."""
        material = self._materials.number(surface, double_sided=triangles.double_sided)
        if triangles not in self._key_of:
            self._key_of[triangles] = triangles.key()
        key = self._key_of[triangles], material
        if key not in self._mesh_of:
            self._mesh_of[key] = f"{name}_{len(self._mesh_of)}"
            self._material_of[self._mesh_of[key]] = material
            self._scene.geometry[self._mesh_of[key]] = self._geometry(triangles, self._materials.materials[material])
        return self._mesh_of[key]

    def _geometry(self, triangles: Triangles, material: Mapping[str, Any]) -> "trimesh.Trimesh":
        reflection = material["pbrMetallicRoughness"]
        is_bumpy = "normalTexture" in material
        is_textured = is_bumpy or "occlusionTexture" in material or any(name.endswith("Texture") for name in reflection)
        return self._trimesh.Trimesh(
            triangles.positions_m,
            triangles.indices,
            vertex_normals=triangles.normals,
            vertex_attributes={_TANGENT: tangents_of(triangles)} if is_bumpy else None,
            visual=self._trimesh.visual.TextureVisuals(uv=triangles.coordinates if is_textured else None),
            process=False,
        )

    def add_node(
        self,
        name: str,
        matrix: Matrix,
        *,
        mesh: str | None = None,
        above: str | None = None,
        extras: Mapping[str, Any] | None = None,
    ) -> None:
        """Add a node.

        Parameters
        ----------
        name
            No other has it.
        matrix
            From its space to that of the node above; rigid.
        mesh
            Name of what it draws.
        above
            Name of the node that it is below; None for a node of the scene.
        extras
            What it says of itself.
        """
        self._places[name] = place_of(matrix)
        drawn = {} if mesh is None else {"geometry": mesh}
        self._scene.graph.update(frame_to=name, frame_from=above, metadata=dict(extras or {}), **drawn)

    def data(self, facts: Mapping[str, str]) -> bytes:
        """The bytes of the file; `facts` is what the scene says of itself."""
        self._scene.metadata.update(facts)
        data: bytes = self._trimesh.exchange.gltf.export_glb(
            self._scene,
            include_normals=True,
            unitize_normals=False,
            buffer_postprocessor=self._finish_buffers,
            tree_postprocessor=self._finish_tree,
        )
        return data

    def _finish_buffers(self, buffers: MutableMapping[Any, bytes], tree: dict[str, Any]) -> None:
        """Number vertices by two bytes where that is enough, and append the images as they are."""
        accessors, keys = list(tree["accessors"].values()), list(buffers)
        others = {accessor["bufferView"] for accessor in accessors if accessor["type"] != "SCALAR"}
        wide = {
            accessor["bufferView"]
            for accessor in accessors
            if accessor["type"] == "SCALAR" and accessor["max"][0] >= _MOST_SHORT
        }
        for accessor in accessors:
            if accessor["type"] == "SCALAR" and accessor["bufferView"] not in others | wide:
                accessor["componentType"] = _UINT16
        for view in {accessor["bufferView"] for accessor in accessors if accessor["componentType"] == _UINT16}:
            count = next(accessor["count"] for accessor in accessors if accessor["bufferView"] == view)
            buffers[keys[view]] = _padded(np.frombuffer(buffers[keys[view]], "<u4", count).astype("<u2").tobytes())
        for image in self._materials.images:
            image["bufferView"] = len(buffers)
            buffers[f"image {len(buffers)}"] = _padded(image.pop("bytes"))

    def _finish_tree(self, tree: dict[str, Any]) -> None:
        """Put in the materials, and where nodes stand."""
        materials = self._materials
        tree["asset"]["generator"] = f"garage2usd {VERSION}, trimesh {self._trimesh.__version__}"
        for name in ("materials", "textures", "images"):
            if values := getattr(materials, name):
                tree[name] = values
        if materials.extensions:
            tree["extensionsUsed"] = sorted(materials.extensions)
        positions = set()
        for mesh in tree["meshes"]:
            (primitive,) = mesh["primitives"]
            primitive["material"] = self._material_of[mesh["name"]]
            attributes = primitive["attributes"]
            if _TANGENT in attributes:
                attributes["TANGENT"] = attributes.pop(_TANGENT)
            positions.add(attributes["POSITION"])
            mesh.pop("extras", None)
        for number, accessor in enumerate(tree["accessors"]):
            accessor.pop("byteOffset", None)
            if number not in positions:
                accessor.pop("min", None)
                accessor.pop("max", None)
        for node in tree["nodes"]:
            node.update(self._places[node["name"]])


def _padded(data: bytes) -> bytes:
    return data + bytes(-len(data) % _ALIGNMENT)
