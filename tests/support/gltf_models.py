"""Small files of glTF made number by number, as programs write them that no library of ours does."""

import base64
import io
import json
import struct

import numpy as np
from PIL import Image

__all__ = ["SQUARE", "SQUARE_ST", "Gltf"]

SQUARE = np.array([(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0)], np.float32)
SQUARE_ST = np.array([(0, 1), (1, 1), (1, 0), (0, 0)], np.float32)
"""Coordinates of the square with V downwards, as in glTF."""
_KINDS = {"i1": 5120, "u1": 5121, "i2": 5122, "u2": 5123, "u4": 5125, "f4": 5126}
_FORMS = {1: "SCALAR", 2: "VEC2", 3: "VEC3", 4: "VEC4", 16: "MAT4"}


class Gltf:
    """A file with one mesh at one node, unless more is added to its JSON."""

    def __init__(self):
        self.json = {
            "asset": {"version": "2.0"},
            "scene": 0,
            "scenes": [{"nodes": [0]}],
            "nodes": [{"name": "node", "mesh": 0}],
            "meshes": [{"name": "square", "primitives": []}],
            "materials": [],
            "accessors": [],
            "bufferViews": [],
            "images": [],
            "textures": [],
            "samplers": [],
        }
        self.binary = b""

    def view(self, data, **more):
        self.binary += b"\0" * (-len(self.binary) % 4)
        entry = {"buffer": 0, "byteOffset": len(self.binary), "byteLength": len(data), **more}
        self.binary += data
        self.json["bufferViews"].append(entry)
        return len(self.json["bufferViews"]) - 1

    def numbers(self, values, **more):
        values = np.asarray(values)
        rows = values.reshape(len(values), -1)
        entry = {
            "bufferView": self.view(values.tobytes()),
            "componentType": _KINDS[values.dtype.str[1:]],
            "count": len(values),
            "type": _FORMS[rows.shape[1]],
            **more,
        }
        self.json["accessors"].append(entry)
        return len(self.json["accessors"]) - 1

    def material(self, name="paint", **properties):
        self.json["materials"].append({"name": name, **properties})
        return len(self.json["materials"]) - 1

    def texture(self, pixels, *, form="PNG", extension=None, sampler=None):
        stream = io.BytesIO()
        Image.fromarray(np.asarray(pixels, np.uint8)).save(stream, format=form, lossless=True)
        self.json["images"].append({"bufferView": self.view(stream.getvalue()), "mimeType": f"image/{form.lower()}"})
        source = {"source": len(self.json["images"]) - 1}
        entry = {"extensions": {extension: source}} if extension else source
        if sampler is not None:
            self.json["samplers"].append(sampler)
            entry["sampler"] = len(self.json["samplers"]) - 1
        self.json["textures"].append(entry)
        return {"index": len(self.json["textures"]) - 1}

    def primitive(
        self, positions=SQUARE, indices=(0, 1, 2, 0, 2, 3), *, material=None, attributes=None, mesh=0, **more
    ):
        given = {"POSITION": self.numbers(positions), **(attributes or {})}
        made = {"attributes": given, **more}
        if indices is not None:
            made["indices"] = self.numbers(np.array(indices, np.uint16))
        if material is not None:
            made["material"] = material
        self.json["meshes"][mesh]["primitives"].append(made)
        return made

    def node(self, **properties):
        self.json["nodes"].append(properties)
        return len(self.json["nodes"]) - 1

    def write(self, path):
        document = {name: entries for name, entries in self.json.items() if entries or name == "scene"}
        if path.suffix == ".gltf":
            uri = "data:application/octet-stream;base64," + base64.b64encode(self.binary).decode()
            document["buffers"] = [{"uri": uri, "byteLength": len(self.binary)}]
            path.write_text(json.dumps(document))
            return path
        document["buffers"] = [{"byteLength": len(self.binary)}]
        text = json.dumps(document).encode()
        text += b" " * (-len(text) % 4)
        binary = self.binary + b"\0" * (-len(self.binary) % 4)
        head = struct.pack("<4sIIII", b"glTF", 2, 28 + len(text) + len(binary), len(text), 0x4E4F534A)
        path.write_bytes(head + text + struct.pack("<II", len(binary), 0x004E4942) + binary)
        return path
