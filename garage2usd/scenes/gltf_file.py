"""Reading of glTF 2.0 files from unknown sources: tables, numbers and pictures, also external and compressed ones."""
# Over 300 lines: each check of the tables stands where what it guards is read.

import base64
import json
import struct
from collections.abc import Iterator, Mapping
from functools import cache, cached_property
from pathlib import Path
from typing import Any
from urllib.parse import unquote, urlsplit

import numpy as np
from numpy.typing import NDArray

from garage2usd.common.documents import is_file, read_bytes
from garage2usd.common.errors import ConfigError
from garage2usd.common.package import of_extra
from garage2usd.scenes.remarks import Remarks

GLTF_SUFFIXES = (".glb", ".gltf")
"""Extensions of files of glTF."""
_HEADER, _CHUNK, _JSON, _VERSION = struct.Struct("<4sII"), struct.Struct("<II"), 0x4E4F534A, 2
_MOST_NODES_DEEP = 500
_MOST_NUMBERS = 50_000_000
_TYPES = {5120: np.int8, 5121: np.uint8, 5122: np.int16, 5123: np.uint16, 5125: np.uint32, 5126: np.float32}
_WIDTHS = {"SCALAR": 1, "VEC2": 2, "VEC3": 3, "VEC4": 4, "MAT2": 4, "MAT3": 9, "MAT4": 16}
_DRACO = "KHR_draco_mesh_compression"
_COMPRESSED = {"EXT_meshopt_compression", "KHR_meshopt_compression", "KHR_texture_basisu"}
"""Compressions that no wheel for all versions of Python decompresses."""
_INSTANCING = "EXT_mesh_gpu_instancing"
_READ = {
    _DRACO,
    _INSTANCING,
    "EXT_texture_avif",
    "EXT_texture_webp",
    "KHR_materials_clearcoat",
    "KHR_materials_ior",
    "KHR_materials_pbrSpecularGlossiness",
    "KHR_materials_transmission",
    "KHR_mesh_quantization",
    "KHR_node_visibility",
    "KHR_texture_transform",
    "KHR_xmp",
    "KHR_xmp_json_ld",
}
"""Extensions that are read, or say nothing of how a model looks."""
_SHAPELESS = {"KHR_lights_punctual", "KHR_animation_pointer"}
"""Extensions besides those of materials without which a model keeps its shape."""
_MATERIALS = "KHR_materials_"


class GltfFile:
    """A GLB, or a ``.gltf`` with the files beside it.

    Parameters
    ----------
    path
        The file.
    field
        Name of the setting, for errors.
    max_bytes
        Greatest size of the file, and of each file beside it.

    Attributes
    ----------
    document
        Its JSON.
    told
        Bytes of the file and of all files that it refers to, in the order of their names.

    Raises
    ------
    ConfigError
        If the file is not glTF 2, is truncated, requires an extension that is not read, or has nodes that hold each
        other. A missing external file is an error only when it is read.
    """

    def __init__(self, path: Path, *, field: str, max_bytes: int) -> None:
        self.path, self.field = path, field
        data = read_bytes(path, field=field, max_bytes=max_bytes)
        if path.suffix.lower() == ".glb":
            self.document, self._binary = self._chunks(data)
        else:
            self.document, self._binary = self._json(data, "a file of glTF that is a JSON object"), b""
        self._check_extensions()
        self._check_nodes()
        entries = [*self.table("buffers"), *self.table("images")]
        uris = {entry["uri"] for entry in entries if isinstance(entry.get("uri"), str)}
        places = {uri: path.parent / unquote(uri) for uri in uris if _is_beside(uri)}
        self._files = {
            uri: read_bytes(place, field=field, max_bytes=max_bytes) for uri, place in places.items() if is_file(place)
        }
        self._buffer = cache(self._of_buffer)
        self._decompressed: dict[int, Mapping[str, NDArray[Any]]] = {}
        self.told = [data, *(self._files[uri] for uri in sorted(self._files))]

    def table(self, kind: str) -> list[dict[str, Any]]:
        """Return a table of the file; empty without it."""
        entries = self.document.get(kind, [])
        if not isinstance(entries, list) or not all(isinstance(entry, dict) for entry in entries):
            raise self.fault(f"with {kind} that are no list of tables")
        return entries

    def entry(self, kind: str, number: object) -> dict[str, Any]:
        """Return an entry of a table."""
        entries = self.table(kind)
        if not isinstance(number, int) or not 0 <= number < len(entries):
            raise self.fault(f"with {kind} {number} of {len(entries)}")
        return entries[number]

    def fault(self, what: str) -> ConfigError:
        """Return the error of a file whose tables are not those of glTF."""
        return ConfigError(self.field, f"{self.path}, {what}", "a file whose tables are those of glTF 2.0")

    def add_remarks(self, remarks: Remarks) -> None:
        """Add a remark on each extension, and each kind of part, that is not used."""
        for kind, entries in self.document.items():
            for number, entry in enumerate(entries if isinstance(entries, list) else ()):
                for extension in sorted(set(_extensions_in(entry)) - _READ):
                    remarks.add(f"{extension} is not used", title_of(entry, kind, number))
        for number, entry in enumerate(self.table("animations")):
            remarks.add("animations are not used", title_of(entry, "animations", number))

    @cached_property
    def numbers(self) -> "_Numbers":
        """Numbers of the file's accessors."""
        return _Numbers(self)

    def picture(self, number: int) -> bytes:
        """Return the bytes of an image."""
        entry = self.entry("images", number)
        return self.resource(entry["uri"]) if "uri" in entry else self.view(entry.get("bufferView"))

    def resource(self, uri: str) -> bytes:
        """Return the bytes that a URI names or holds."""
        if uri.startswith("data:"):
            return base64.b64decode(uri.partition(",")[2])
        if not _is_beside(uri):
            raise ConfigError(self.field, f"{self.path} with {uri}", "a model whose files lie beside it")
        if uri not in self._files:
            raise ConfigError(
                self.field, f"{self.path} without {unquote(uri)}", "a model whose references lead to files"
            )
        return self._files[uri]

    def view(self, number: object) -> bytes:
        """Return the bytes of a buffer view."""
        entry = self.entry("bufferViews", number)
        start, length = entry.get("byteOffset", 0), entry["byteLength"]
        whole = self._buffer(int(entry["buffer"]))
        if start < 0 or length < 0 or start + length > len(whole):
            raise self.fault(f"with a view of bytes {start} to {start + length} of {len(whole)}")
        return whole[start : start + length]

    def compressed(self, primitive: Mapping[str, Any]) -> Mapping[str, NDArray[Any]]:
        """Return the attributes of a primitive that Draco compresses, and its indices under an empty name."""
        given = primitive.get("extensions", {}).get(_DRACO)
        if given is None:
            return {}
        key = id(primitive)
        if key not in self._decompressed:
            self._decompressed[key] = self._draco(primitive, given)
        return self._decompressed[key]

    def _draco(self, primitive: Mapping[str, Any], given: Mapping[str, Any]) -> dict[str, NDArray[Any]]:
        """Decompress the attributes and triangles of a primitive by Draco."""
        with of_extra(f"a model compressed by {_DRACO}"):
            import DracoPy  # noqa: PLC0415 - of an extra
        try:
            mesh = DracoPy.decode(self.view(given["bufferView"]))
        except (DracoPy.FileTypeException, ValueError):
            raise ConfigError(
                self.field, f"{self.path}, compressed by {_DRACO}", "data that Draco decompresses"
            ) from None
        found = {"": np.asarray(mesh.faces, dtype=np.int64).reshape(-1, 1)}
        for name, number in given["attributes"].items():
            values = np.asarray(mesh.get_attribute_by_unique_id(number)["data"])
            accessor = self.entry("accessors", primitive["attributes"][name])
            found[name] = _shares(values.reshape(len(values), -1), is_normalized=bool(accessor.get("normalized")))
        return found

    def _of_buffer(self, number: int) -> bytes:
        entry = self.entry("buffers", number)
        if "uri" not in entry and number:
            raise self.fault(f"with buffer {number} without a URI")
        return self.resource(entry["uri"]) if "uri" in entry else self._binary

    def _chunks(self, data: bytes) -> tuple[dict[str, Any], bytes]:
        """Return the JSON of a GLB and its binary chunk."""
        if len(data) < _HEADER.size + _CHUNK.size or data[:4] != b"glTF":
            raise ConfigError(self.field, str(self.path), "a GLB that can be read, which begins with glTF")
        _, version, length = _HEADER.unpack_from(data)
        chunk_length, kind = _CHUNK.unpack_from(data, _HEADER.size)
        if version != _VERSION or kind != _JSON:
            raise ConfigError(self.field, f"{self.path} of version {version}", "a GLB of glTF 2.0")
        start = _HEADER.size + _CHUNK.size
        if length > len(data) or start + chunk_length > len(data):
            said = f"{self.path}, cut off after {len(data)} of {length} bytes"
            raise ConfigError(self.field, said, "a whole GLB")
        document = self._json(data[start : start + chunk_length], "a GLB whose first chunk is a JSON object")
        return document, data[start + chunk_length + _CHUNK.size :]

    def _json(self, text: bytes, allowed: str) -> dict[str, Any]:
        try:
            document = json.loads(text.decode("utf-8-sig"), parse_constant=_refused)
        except (ValueError, RecursionError):
            document = None
        if not isinstance(document, dict):
            raise ConfigError(self.field, str(self.path), allowed)
        asset = document.get("asset")
        version = str(asset.get("version", "2.0")) if isinstance(asset, dict) else "2.0"
        if not version.startswith("2."):
            raise ConfigError(self.field, f"{self.path} of version {version}", "a file of glTF 2.0")
        return document

    def _check_extensions(self) -> None:
        """Refuse extensions without which the file cannot be read."""
        for extension in self.document.get("extensionsRequired", ()):
            if extension in _COMPRESSED:
                allowed = f"files that are not compressed, or by {_DRACO}, with pictures as PNG, JPEG or WebP"
                raise ConfigError(self.field, f"{self.path}, compressed by {extension}", allowed)
            if extension not in _READ | _SHAPELESS and not str(extension).startswith(_MATERIALS):
                raise ConfigError(
                    self.field, f"{self.path}, which requires {extension}", "a file without this extension"
                )

    def _check_nodes(self) -> None:
        """Refuse nodes with cycles, or with several parents."""
        nodes = self.table("nodes")
        parents: dict[int, int] = {}
        for number, node in enumerate(nodes):
            for child in node.get("children", ()):
                if not isinstance(child, int) or not 0 <= child < len(nodes):
                    place = f"{self.path}, node {number} with child {child}"
                    raise ConfigError(self.field, place, f"nodes 0 to {len(nodes) - 1}")
                if child in parents:
                    place = f"{self.path}, node {child} in two nodes"
                    raise ConfigError(self.field, place, "nodes in one other node at most")
                parents[child] = number
        for number in range(len(nodes)):
            above, depth = number, 0
            while above in parents:
                above, depth = parents[above], depth + 1
                if above == number or depth > _MOST_NODES_DEEP:
                    place = f"{self.path}, node {number}"
                    raise ConfigError(self.field, place, f"a tree of nodes up to {_MOST_NODES_DEEP} deep")


class _Numbers:
    """Reader of a file's accessors."""

    def __init__(self, file: GltfFile) -> None:
        self._file = file
        self.of = cache(self._of)

    def _of(self, number: int) -> NDArray[Any]:
        """Return the numbers of an accessor, shape (count, width); as float32 if they are shares of integers."""
        entry = self._file.entry("accessors", number)
        kind, width, count = _TYPES[entry["componentType"]], _WIDTHS[entry["type"]], entry["count"]
        if not isinstance(count, int) or not 0 <= count * width <= _MOST_NUMBERS:
            raise self._file.fault(f"with an accessor of {count} elements")
        values = np.zeros((count, width), dtype=kind)
        if "bufferView" in entry:
            values = self._elements(entry["bufferView"], entry.get("byteOffset", 0), count, kind, width)
        if "sparse" in entry:
            values, sparse = values.copy(), entry["sparse"]
            places, changed = sparse["indices"], sparse["values"]
            rows = self._elements(
                places["bufferView"], places.get("byteOffset", 0), sparse["count"], _TYPES[places["componentType"]], 1
            )
            values[rows[:, 0]] = self._elements(
                changed["bufferView"], changed.get("byteOffset", 0), sparse["count"], kind, width
            )
        return _shares(values, is_normalized=bool(entry.get("normalized")))

    def _elements(self, view: int, offset: int, count: int, kind: type[Any], width: int) -> NDArray[Any]:
        """Return elements of a buffer view, which may be interleaved with others."""
        data, size = self._file.view(view), np.dtype(kind).itemsize
        stride = self._file.entry("bufferViews", view).get("byteStride", 0) or size * width
        if count and (offset < 0 or offset + (count - 1) * stride + size * width > len(data)):
            raise self._file.fault(f"with {count} elements in a view of {len(data)} bytes")
        if not count:
            return np.zeros((0, width), dtype=kind)
        little = np.dtype(kind).newbyteorder("<")
        found: NDArray[Any] = np.ndarray((count, width), little, data, offset, (stride, size))
        return found.astype(kind)


def _is_beside(uri: str) -> bool:
    """Return True for the URI of a file beside the one that names it, and for those below it."""
    return not urlsplit(uri).scheme and not Path(unquote(uri)).is_absolute()


def _shares(values: NDArray[Any], *, is_normalized: bool) -> NDArray[Any]:
    """Convert normalized integers to shares (glTF 2.0, 3.6.2.2); return all other numbers unchanged."""
    if not is_normalized or values.dtype.kind not in "iu":
        return values
    shares: NDArray[np.float32] = values.astype(np.float32) / np.float32(np.iinfo(values.dtype).max)
    return np.maximum(shares, np.float32(-1))


def title_of(entry: Mapping[str, Any], kind: str, number: int) -> str:
    """Return the name of an entry of a table, or its kind and number."""
    return str(entry.get("name") or f"{'mesh' if kind == 'meshes' else kind.removesuffix('s')} {number}")


def _refused(constant: str) -> None:
    """Refuse NaN and infinities, which JSON lacks."""
    raise ValueError(constant)


def _extensions_in(entry: object) -> Iterator[str]:
    """Yield the extensions that an entry of a table uses."""
    if isinstance(entry, dict):
        extensions = entry.get("extensions")
        yield from extensions if isinstance(extensions, dict) else ()
        for value in entry.values():
            yield from _extensions_in(value)
    elif isinstance(entry, list):
        for value in entry:
            yield from _extensions_in(value)
