"""A car of glTF is read corner by corner as Blender imports it: coordinates, transforms, colours and places."""

import importlib.util
import io
import json
import subprocess
import sys

import numpy as np
import pytest
from PIL import Image
from support.gltf_models import Gltf

from garage2usd.scenes.foreign_models import read_model

pytestmark = [
    pytest.mark.client,
    pytest.mark.skipif(importlib.util.find_spec("bpy") is None, reason="Blender's bpy is made for Python 3.11 only"),
]
IMPORT = """
import json, sys
import bpy
bpy.ops.wm.read_factory_settings(use_empty=True)
bpy.ops.import_scene.gltf(filepath=sys.argv[1])
found = []
for thing in bpy.data.objects:
    if thing.type != "MESH":
        continue
    mesh = thing.data
    mesh.calc_loop_triangles()
    for triangle in mesh.loop_triangles:
        material = mesh.materials[triangle.material_index]
        nodes = material.node_tree.nodes
        image = next(node for node in nodes if node.type == "TEX_IMAGE")
        moves = [node for node in nodes if node.type == "MAPPING"]
        uvs = [node.uv_map for node in nodes if node.type == "UVMAP"]
        layer = mesh.uv_layers[uvs[0] if uvs else 0]
        move = moves[0] if moves else None
        for loop, vertex in zip(triangle.loops, triangle.vertices):
            x, y, z = thing.matrix_world @ mesh.vertices[vertex].co
            found.append({
                "material": material.name,
                "place": [x, z, -y],
                "uv": list(layer.uv[loop].vector),
                "pixel": list(image.image.pixels[:3]),
                "location": list(move.inputs["Location"].default_value) if move else [0, 0, 0],
                "turn": move.inputs["Rotation"].default_value[2] if move else 0,
                "scale": list(move.inputs["Scale"].default_value) if move else [1, 1, 1],
            })
json.dump(found, open(sys.argv[2], "w"))
"""


def body(rng, count=50):
    """Triangles in any place, whose coordinates differ at every corner."""
    return rng.uniform(-2, 2, (3 * count, 3)).astype(np.float32)


@pytest.fixture(scope="module")
def car(tmp_path_factory):
    """Four meshes: plain; with a transform of its second set; quantized; mirrored, below a node that is turned."""
    rng, gltf = np.random.default_rng(3), Gltf()
    gltf.json["meshes"], gltf.json["nodes"] = [], []
    transform = {"offset": [0.3, -0.2], "rotation": 0.7, "scale": [0.5, 0.5], "texCoord": 1}
    infos = {
        "plain": {},
        "moved": {"extensions": {"KHR_texture_transform": transform}},
        "bytes": {},
        "mirrored": {"texCoord": 1},
    }
    for number, (name, info) in enumerate(infos.items()):
        points = body(rng)
        sets = [rng.uniform(0, 1, (len(points), 2)) for _ in range(2)]
        grey = 40 * (number + 1)
        reference = gltf.texture(np.full((4, 4, 3), grey)) | info
        gltf.json["meshes"].append({"name": name, "primitives": []})
        if name == "bytes":
            coordinates = [gltf.numbers((one * 65535).astype(np.uint16), normalized=True) for one in sets]
        else:
            coordinates = [gltf.numbers(one.astype(np.float32)) for one in sets]
        gltf.primitive(
            points,
            range(len(points)),
            mesh=number,
            material=gltf.material(name, pbrMetallicRoughness={"baseColorTexture": reference}),
            attributes={f"TEXCOORD_{at}": one for at, one in enumerate(coordinates)},
        )
        gltf.node(name=name, mesh=number)
    gltf.json["nodes"][3] |= {"scale": [1, -1, 2]}
    above = gltf.node(name="above", children=[3], rotation=[0, 0.6, 0, 0.8], translation=[1, 2, 3])
    gltf.json["scenes"][0]["nodes"] = [0, 1, 2, above]
    return gltf.write(tmp_path_factory.mktemp("models") / "c.glb")


def test_every_corner_is_where_blender_has_it(car, tmp_path):
    out = tmp_path / "blender.json"
    subprocess.run([sys.executable, "-c", IMPORT, str(car), str(out)], check=True, capture_output=True, timeout=300)
    wanted = {}
    for corner in json.loads(out.read_text()):
        cos, sin = np.cos(corner["turn"]), np.sin(corner["turn"])
        u, v = np.array(corner["uv"]) * corner["scale"][:2]
        st = np.array([cos * u - sin * v, sin * u + cos * v]) + corner["location"][:2]
        wanted.setdefault(corner["material"], []).append([*corner["place"], *st, corner["pixel"][0]])
    model = read_model(car, field="models")
    assert model.remarks == ()
    assert {part.surface.name for part in model.parts} == set(wanted)
    for part in model.parts:
        shade = np.asarray(Image.open(io.BytesIO(part.surface.picture.data)))[0, 0, 0] / 255
        found = np.concatenate([part.triangles_m.reshape(-1, 3), part.st.reshape(-1, 2)], axis=1)
        told = np.array(wanted[part.surface.name])
        assert len(found) == len(told)
        order, other = (np.lexsort(rows[:, :3].round(3).T) for rows in (found, told))
        assert np.abs(found[order] - told[other][:, :5]).max() < 1e-3
        assert told[0, 5] == pytest.approx(shade, abs=0.005)
