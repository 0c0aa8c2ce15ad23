"""Builder of a binary glTF 2.0 file: nodes, meshes, materials and one buffer of numbers and images."""
# Over 300 lines: one class holds the buffer that nodes, meshes, materials and images are written into.

import hashlib
import struct
from collections.abc import Callable, Hashable, Iterable, Mapping
from functools import partial
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from garage2usd.common.documents import short_json
from garage2usd.common.package import VERSION
from garage2usd.maps.glb_materials import Materials, shortest
from garage2usd.maps.glb_meshes import Primitive, beside, places_of, primitive_of
from garage2usd.scenes.meshes import Triangles
from garage2usd.scenes.pictures import Pictures
from garage2usd.scenes.prims import Matrix
from garage2usd.scenes.remarks import Remarks
from garage2usd.scenes.surfaces import SurfaceLook

_FLOAT, _SHARE, _BYTE = 5126, 5123, 5121
_MOST = 65535
"""16-bit value of 1 for normalized texture coordinates; the error is at most 1/100 pixel of 1000."""
_VERTICES, _INDICES = 34962, 34963
_INDEX_TYPES = {5121: "<u1", 5123: "<u2", 5125: "<u4"}
"""Index component types, smallest first; the largest value of each is reserved for primitive restart."""
_ALIGNMENT = 4
_LIGHTS = "KHR_lights_punctual"
_GLTF, _JSON, _BIN = 0x46546C67, 0x4E4F534A, 0x004E4942


class Skin(NamedTuple):
    """The four joints that move each vertex: their numbers and weights, shapes (vertices, 4)."""

    joints: NDArray[np.uint8]
    weights: NDArray[np.float32]


class Channel(NamedTuple):
    """Values of a node's translation, rotation (x, y, z, w) or scale over time; shapes (k,) and (k, 3 or 4)."""

    node: int
    path: str
    times_s: NDArray[np.float32]
    values: NDArray[np.float32]


class Piece(NamedTuple):
    """Triangles of a mesh with one surface.

    Attributes
    ----------
    triangles, surface
        The triangles and their surface.
    is_faceted
        True if all triangles have flat normals.
    skin
        Joints that move the vertices; None for none. Smooth pieces only, alone in their mesh.
    """

    triangles: Triangles
    surface: SurfaceLook
    is_faceted: bool
    skin: Skin | None = None


class GlbFile:
    """Builder of a GLB file, which stores equal arrays, images, materials and meshes once.

    Parameters
    ----------
    pictures
        Pictures of the textures.
    remarks
        Receives remarks on features that glTF lacks.
    for_assimp
        True for programs that read by assimp, such as Gazebo: texture coordinates are floats, since assimp takes
        normalized integers for floats, and no two materials have one name, by which Gazebo keeps their images.

    Notes
    -----
    Names of keys are those of glTF 2.0 (ISO/IEC 12113:2022).
    """

    def __init__(self, pictures: Pictures, remarks: Remarks, *, for_assimp: bool = False) -> None:
        """Create an empty file."""
        self._for_assimp = for_assimp
        self._materials = Materials(pictures, remarks)
        self._numbers = _Numbers()
        self._nodes: list[dict[str, Any]] = []
        self._matrices: list[Matrix] = []
        self._roots: list[int] = []
        self._lights: list[dict[str, Any]] = []
        self._meshes: list[dict[str, Any]] = []
        self._skins: list[dict[str, Any]] = []
        self._animations: list[dict[str, Any]] = []
        self._mesh_of: dict[Hashable, int] = {}
        self._primitive_of: dict[tuple[Triangles, Triangles | None, int], dict[str, Any]] = {}

    def add_mesh(self, pieces: Iterable[Piece], name: str) -> int:
        """Return the index of the mesh of some pieces; a new mesh is called `name`."""
        of_materials = [(self._material(piece), piece) for piece in pieces]
        mates = {(material, not piece.is_faceted): piece for material, piece in of_materials}
        primitives = [
            self._primitive(piece, material, mates.get((material, piece.is_faceted)))
            for material, piece in of_materials
        ]
        key = tuple((own["material"], own["indices"], *own["attributes"].items()) for own in primitives)
        if key not in self._mesh_of:
            self._mesh_of[key] = len(self._meshes)
            self._meshes.append({"name": name, "primitives": primitives})
        return self._mesh_of[key]

    def _material(self, piece: Piece) -> int:
        own = piece.triangles
        return self._materials.number(piece.surface, double_sided=own.double_sided, has_colours=own.colours is not None)

    def _primitive(self, piece: Piece, material: int, mate: Piece | None) -> dict[str, Any]:
        """Return a primitive that shares vertices with its `mate`: a faceted with a smooth one of equal material."""
        key = piece.triangles, None if mate is None else mate.triangles, material
        if key not in self._primitive_of:
            own, attributes = self._arrays(piece, material), {}
            if mate is not None and piece.is_faceted:
                own = beside(self._arrays(mate, material), own)
            elif mate is not None:
                attributes = self._primitive(mate, material, piece)["attributes"]
            indices = self._numbers.indices(own.indices)
            attributes = self._attributes(own, within=attributes)
            if piece.skin is not None:
                attributes["JOINTS_0"] = self._numbers.joints(piece.skin.joints)
                attributes["WEIGHTS_0"] = self._numbers.vectors(piece.skin.weights)
            self._primitive_of[key] = {"attributes": attributes, "indices": indices, "material": material}
        return self._primitive_of[key]

    def _arrays(self, piece: Piece, material: int) -> Primitive:
        sets, normals = self._materials.sets_of(material), self._materials.normals_of(material)
        return primitive_of(piece.triangles, sets=sets, normals_set=normals, is_faceted=piece.is_faceted)

    def _attributes(self, own: Primitive, within: Mapping[str, int]) -> dict[str, int]:
        """Return the accessor indices of a primitive's attributes; those in `within` share another accessor."""
        attributes = {}
        for name, array in own.named().items():
            if name in within:
                attributes[name] = self._numbers.beginning(within[name], array, with_bounds=name == "POSITION")
            elif (
                name.startswith("TEXCOORD") and not self._for_assimp and bool((array >= 0).all() and (array <= 1).all())
            ):
                attributes[name] = self._numbers.shares(array)
            else:
                attributes[name] = self._numbers.vectors(array, with_bounds=name == "POSITION")
        return attributes

    def add_node(
        self,
        name: str,
        matrix: Matrix,
        *,
        mesh: int | None = None,
        skin: int | None = None,
        above: int | None = None,
        extras: Mapping[str, Any] | None = None,
    ) -> int:
        """Add a node to the GLB file.

        Parameters
        ----------
        name
            Its name.
        matrix
            Transform to the space of the parent node; rigid as defined by `garage2usd.maps.glb_meshes.are_rigid`.
        mesh
            Index of the mesh.
        skin
            Index of the skin that moves the mesh.
        above
            Index of the parent node; None for a root node of the scene.
        extras
            Extras of the node.

        Returns
        -------
        int
            Index of the node.
        """
        number = len(self._nodes)
        drawn = {name: index for name, index in (("mesh", mesh), ("skin", skin)) if index is not None}
        self._nodes.append({"name": name, **drawn, **({"extras": dict(extras)} if extras else {})})
        self._matrices.append(matrix)
        siblings = self._roots if above is None else self._nodes[above].setdefault("children", [])
        siblings.append(number)
        return number

    def add_skin(self, name: str, joints: list[int], inverse_binds: NDArray[np.float32]) -> int:
        """Add a skin of joint nodes and return its index; inverse matrices at rest, (n, 4, 4), are for rows."""
        number = self._numbers.plain(inverse_binds.reshape(-1, 16), "MAT4")
        self._skins.append({"name": name, "joints": joints, "skeleton": joints[0], "inverseBindMatrices": number})
        return len(self._skins) - 1

    def add_animation(self, name: str, channels: Iterable[Channel]) -> None:
        """Add an animation of nodes."""
        samplers: list[dict[str, int]] = []
        targets: list[dict[str, Any]] = []
        for channel in channels:
            times = self._numbers.plain(channel.times_s[:, None], "SCALAR")
            values = self._numbers.plain(channel.values, f"VEC{channel.values.shape[1]}")
            targets.append({"sampler": len(samplers), "target": {"node": channel.node, "path": channel.path}})
            samplers.append({"input": times, "output": values})
        self._animations.append({"name": name, "samplers": samplers, "channels": targets})

    def add_light(self, name: str, matrix: Matrix, light: dict[str, Any], *, above: int | None = None) -> None:
        """Add a light node, which shines along -Z.

        Parameters
        ----------
        name
            Its name.
        matrix
            Transform to the space of the parent node; a rotation and a translation.
        light
            The light as JSON of KHR_lights_punctual.
        above
            Index of the parent node; None for a root node of the scene.
        """
        node = self.add_node(name, matrix, above=above)
        if light not in self._lights:
            self._lights.append(light)
        self._nodes[node]["extensions"] = {_LIGHTS: {"light": self._lights.index(light)}}

    def data(self, facts: Mapping[str, Any]) -> bytes:
        """Return the bytes of the GLB file; `facts` are the extras of the scene."""
        materials, images = self._materials, []
        for image in materials.textures.images:
            view = self._numbers.image(image.data)
            images.append({"name": image.name, "mimeType": image.kind, "bufferView": view})
        if self._for_assimp:
            for number, material in enumerate(materials.materials, 1):
                material["name"] = f"{number:03d}_{material.get('name', '')}"
        buffer, places = self._numbers.buffer(), places_of(np.array(self._matrices))
        document = {
            "asset": {"version": "2.0", "generator": f"garage2usd {VERSION}"},
            "extensionsUsed": sorted(materials.extensions | ({_LIGHTS} if self._lights else set())),
            "extensions": {_LIGHTS: {"lights": self._lights}} if self._lights else {},
            "scene": 0,
            "scenes": [{"nodes": self._roots, **({"extras": dict(facts)} if facts else {})}],
            "nodes": [node | place for node, place in zip(self._nodes, places, strict=True)],
            "meshes": self._meshes,
            "skins": self._skins,
            "animations": self._animations,
            "materials": materials.materials,
            "textures": materials.textures.textures,
            "samplers": materials.textures.samplers,
            "images": images,
            "accessors": self._numbers.accessors,
            "bufferViews": self._numbers.views(),
            "buffers": [{"byteLength": len(buffer)}] if buffer else [],
        }
        filled = {name: value for name, value in document.items() if value not in ([], {})}
        text = short_json(filled).encode()
        chunks = (_JSON, text + b" " * (-len(text) % _ALIGNMENT)), (_BIN, buffer)
        body = b"".join(struct.pack("<II", len(chunk), kind) + chunk for kind, chunk in chunks if chunk)
        return struct.pack("<III", _GLTF, 2, 12 + len(body)) + body


class _Numbers:
    """The buffer of a GLB file: arrays of one type and width share a view, images have views of their own."""

    def __init__(self) -> None:
        self.accessors: list[dict[str, Any]] = []
        self._beginnings: dict[tuple[int, int], int] = {}
        self._known: dict[tuple[bytes, int, str, bool, bool], int] = {}
        self._parts: list[bytearray] = []
        self._headers: list[dict[str, int]] = []
        self._view_of: dict[tuple[int, str, bool], int] = {}

    def vectors(self, values: NDArray[np.float32], *, with_bounds: bool = False) -> int:
        """Add an accessor of vertex vectors and return its index; float32, shape (vertices, 2 to 4)."""
        width = values.shape[1]
        header = {"target": _VERTICES, "byteStride": 4 * width}
        bounds = partial(_bounds, values) if with_bounds else None
        return self._accessor(values.astype("<f4").tobytes(), _FLOAT, len(values), f"VEC{width}", header, bounds)

    def joints(self, values: NDArray[np.uint8]) -> int:
        """Add an accessor of joint numbers, shape (vertices, 4), and return its index."""
        return self._accessor(
            values.tobytes(), _BYTE, len(values), "VEC4", {"target": _VERTICES, "byteStride": _ALIGNMENT}, None
        )

    def plain(self, values: NDArray[np.float32], kind: str) -> int:
        """Add an accessor of float32 rows that are not of vertices, and return its index."""
        return self._accessor(
            values.astype("<f4").tobytes(), _FLOAT, len(values), kind, {}, partial(_bounds, values.astype("<f4"))
        )

    def shares(self, values: NDArray[np.float32]) -> int:
        """Add an accessor of texture coordinates from 0 to 1 as 16-bit numbers, and return its index."""
        header, data = {"target": _VERTICES, "byteStride": 4}, np.rint(values * _MOST).astype("<u2").tobytes()
        return self._accessor(data, _SHARE, len(values), "VEC2", header, None)

    def beginning(self, number: int, values: NDArray[np.float32], *, with_bounds: bool = False) -> int:
        """Return the index of an accessor of the first vectors of another one, which are `values`."""
        whole = self.accessors[number]
        if whole["count"] == len(values):
            return number
        key = number, len(values)
        if key not in self._beginnings:
            self._beginnings[key] = len(self.accessors)
            self.accessors.append(whole | {"count": len(values)} | (_bounds(values) if with_bounds else {}))
        return self._beginnings[key]

    def indices(self, triangles: NDArray[np.uint32]) -> int:
        """Add an accessor of vertex indices in the smallest sufficient type, and return its index."""
        fitting = (number for number, kind in _INDEX_TYPES.items() if triangles.max() < np.iinfo(np.dtype(kind)).max)
        component = next(fitting)
        data = triangles.astype(_INDEX_TYPES[component]).tobytes()
        return self._accessor(data, component, triangles.size, "SCALAR", {"target": _INDICES}, None)

    def image(self, data: bytes) -> int:
        """Add an image to the buffer and return the index of its view."""
        self._headers.append({})
        self._parts.append(bytearray(data))
        return len(self._parts) - 1

    def _accessor(
        self,
        data: bytes,
        component: int,
        count: int,
        kind: str,
        header: dict[str, int],
        bounds: Callable[[], dict[str, list[float]]] | None,
    ) -> int:
        key = hashlib.blake2b(data, digest_size=16).digest(), component, kind, bounds is None, bool(header)
        if key in self._known:
            return self._known[key]
        view = self._view_of.setdefault((component, kind, bool(header)), len(self._parts))
        if view == len(self._parts):
            self._headers.append(header)
            self._parts.append(bytearray())
        offset = len(self._parts[view])
        self._parts[view] += data
        self._known[key] = len(self.accessors)
        self.accessors.append(
            {
                "bufferView": view,
                **({"byteOffset": offset} if offset else {}),
                "componentType": component,
                **({"normalized": True} if component == _SHARE and kind == "VEC2" else {}),
                "count": count,
                "type": kind,
                **(bounds() if bounds else {}),
            }
        )
        return self._known[key]

    def views(self) -> list[dict[str, int]]:
        """Return the views of the buffer, aligned to four bytes."""
        views, offset = [], 0
        for part, header in zip(self._parts, self._headers, strict=True):
            length = len(part)
            views.append({"buffer": 0, "byteOffset": offset, "byteLength": length, **header})
            offset += length + -length % _ALIGNMENT
        return views

    def buffer(self) -> bytes:
        """Return the buffer: all views, padded to multiples of four bytes."""
        return b"".join(part + bytes(-len(part) % _ALIGNMENT) for part in self._parts)


def _bounds(values: NDArray[np.float32]) -> dict[str, list[float]]:
    columns = np.ascontiguousarray(values.T)  # by rows it takes several times as long
    return {"min": shortest(columns.min(axis=1)), "max": shortest(columns.max(axis=1))}
