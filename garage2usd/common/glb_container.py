"""GLB files from unknown sources: the header and tables of glTF, checked before a library reads them."""

import base64
import io
import json
import struct
from collections.abc import Mapping
from pathlib import Path
from typing import Any, NamedTuple
from urllib.parse import unquote, urlsplit

from PIL import Image

from garage2usd.common.documents import read_bytes
from garage2usd.common.errors import ConfigError

__all__ = ["GlbContainer", "read_glb"]

_HEADER, _JSON, _VERSION = struct.Struct("<4sIIII"), 0x4E4F534A, 2
_MOST_NODES_DEEP = 500
_COMPRESSED = {
    "KHR_draco_mesh_compression",
    "EXT_meshopt_compression",
    "KHR_meshopt_compression",
    "KHR_mesh_quantization",
    "KHR_texture_basisu",
}
_READ = {
    "EXT_texture_webp",
    "KHR_lights_punctual",
    "KHR_materials_pbrSpecularGlossiness",
    "KHR_materials_unlit",
    "KHR_texture_transform",
    "KHR_xmp_json_ld",
}
"""Extensions without which a model keeps its shape."""
_MATERIALS = "KHR_materials_"


class GlbContainer(NamedTuple):
    """The bytes of a GLB, and those of the files that it names, by their URIs in it."""

    data: bytes
    files: Mapping[str, bytes]


def read_glb(path: Path, *, field: str, max_bytes: int) -> GlbContainer:
    """Read a GLB and the files beside it.

    Raises
    ------
    ConfigError
        For what is no GLB of glTF 2, is cut off, requires an extension that is not read, or has nodes that hold each
        other, files that are missing or pictures that are none.
    """
    data = read_bytes(path, field=field, max_bytes=max_bytes)
    document, binary = _chunks(data, path, field)
    try:
        _check_extensions(document, path, field)
        _check_nodes(document, path, field)
        files: dict[str, bytes] = {}
        for kind in ("buffers", "images"):
            for entry in document.get(kind, ()):
                uri = entry.get("uri")
                if isinstance(uri, str) and not uri.startswith("data:"):
                    files[uri] = _beside(path, uri, field, max_bytes)
        for number, entry in enumerate(document.get("images", ())):
            _check_picture(entry, f"{path}, image {_title(entry, number)}", field, (document, binary, files))
    except ConfigError:
        raise
    except (AttributeError, IndexError, KeyError, TypeError, ValueError, RecursionError):
        raise ConfigError(field, str(path), "a GLB whose tables are those of glTF 2.0") from None
    return GlbContainer(data, files)


def _chunks(data: bytes, path: Path, field: str) -> tuple[dict[str, Any], bytes]:
    """Return the JSON of a GLB and its binary chunk."""
    if len(data) < _HEADER.size or data[:4] != b"glTF":
        raise ConfigError(field, str(path), "a GLB that can be read, which begins with glTF")
    _, version, length, json_length, kind = _HEADER.unpack_from(data)
    if version != _VERSION or kind != _JSON:
        raise ConfigError(field, f"{path} of version {version}", "a GLB of glTF 2.0")
    if length > len(data) or _HEADER.size + json_length > len(data):
        raise ConfigError(field, f"{path}, cut off after {len(data)} of {length} bytes", "a whole GLB")
    text, rest = data[_HEADER.size : _HEADER.size + json_length], data[_HEADER.size + json_length :]
    try:
        document = json.loads(text.decode())
    except (ValueError, RecursionError):
        document = None
    if not isinstance(document, dict):
        raise ConfigError(field, str(path), "a GLB whose first chunk is a JSON object")
    return document, rest[8:]


def _check_extensions(document: Mapping[str, Any], path: Path, field: str) -> None:
    """Refuse extensions without which the file cannot be read."""
    for extension in document.get("extensionsRequired", ()):
        if extension in _COMPRESSED:
            raise ConfigError(field, f"{path}, compressed by {extension}", "GLB without compression")
        if extension not in _READ and not str(extension).startswith(_MATERIALS):
            raise ConfigError(field, f"{path}, which requires {extension}", "GLB without this extension")


def _check_nodes(document: Mapping[str, Any], path: Path, field: str) -> None:
    """Refuse nodes that hold each other, or that several nodes hold."""
    nodes = document.get("nodes", ())
    parents: dict[int, int] = {}
    for number, node in enumerate(nodes):
        for child in node.get("children", ()):
            if not 0 <= child < len(nodes):
                raise ConfigError(field, f"{path}, node {number} with child {child}", f"nodes 0 to {len(nodes) - 1}")
            if child in parents:
                raise ConfigError(field, f"{path}, node {child} in two nodes", "nodes in one other node at most")
            parents[child] = number
    for number in range(len(nodes)):
        above, depth = number, 0
        while above in parents:
            above, depth = parents[above], depth + 1
            if above == number or depth > _MOST_NODES_DEEP:
                raise ConfigError(field, f"{path}, node {number}", f"a tree of nodes up to {_MOST_NODES_DEEP} deep")


def _beside(path: Path, uri: str, field: str, max_bytes: int) -> bytes:
    """Read a file that a GLB names."""
    name = unquote(uri)
    if urlsplit(uri).scheme or Path(name).is_absolute():
        raise ConfigError(field, f"{path} with {uri}", "a GLB whose files lie beside it")
    if not (path.parent / name).is_file():
        raise ConfigError(field, f"{path} without {name}", "a model whose references lead to files")
    return read_bytes(path.parent / name, field=field, max_bytes=max_bytes)


def _title(entry: Mapping[str, Any], number: int) -> str:
    uri = entry.get("uri", "")
    return str(entry.get("name") or ("" if uri.startswith("data:") else uri) or number)


def _check_picture(
    entry: Mapping[str, Any], place: str, field: str, sources: tuple[Mapping[str, Any], bytes, Mapping[str, bytes]]
) -> None:
    """Refuse an image whose format is not known; libraries leave it out."""
    document, binary, files = sources
    uri = entry.get("uri")
    if uri is not None:
        picture = base64.b64decode(uri.partition(",")[2]) if uri.startswith("data:") else files[uri]
    else:
        view = document["bufferViews"][entry["bufferView"]]
        if "uri" in document["buffers"][view["buffer"]]:
            return
        start = view.get("byteOffset", 0)
        picture = binary[start : start + view["byteLength"]]
    if entry.get("mimeType") == "image/ktx2" or picture.startswith(b"\xabKTX"):
        return  # the extension that names it tells whether there is another one
    try:
        Image.open(io.BytesIO(picture)).close()
    except (OSError, SyntaxError, ValueError, Image.DecompressionBombError):
        raise ConfigError(field, place, "a picture of a known format, such as PNG or JPEG") from None
