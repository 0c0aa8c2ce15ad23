"""What a UsdPreviewSurface says at a place, by its specification, and what a material of glTF says there."""

import io

import numpy as np
from PIL import Image
from pxr import UsdShade

__all__ = ["GltfMaterial", "value_at"]

DEFAULTS = {
    "diffuseColor": (0.18, 0.18, 0.18),
    "emissiveColor": (0, 0, 0),
    "specularColor": (0, 0, 0),
    "roughness": 0.5,
    "metallic": 0,
    "opacity": 1,
    "occlusion": 1,
    "ior": 1.5,
    "clearcoat": 0,
    "clearcoatRoughness": 0.01,
    "normal": (0, 0, 1),
}
WRAPS = {33071: "clamp", 33648: "mirror", 10497: "repeat"}
CHANNELS = {"r": [0], "g": [1], "b": [2], "a": [3], "rgb": [0, 1, 2]}


def linear(stored):
    return np.where(stored <= 0.04045, stored / 12.92, ((stored + 0.055) / 1.055) ** 2.4)


def value_at(material, name, primvars):
    """An input of a material's surface, where primvars have some values; float, shape (width,)."""
    shader, _, _ = material.ComputeSurfaceSource()
    return _input(shader, name, DEFAULTS[name], primvars)


def _input(shader, name, default, primvars):
    given = shader.GetInput(name)
    if not given:
        return np.atleast_1d(np.array(default, dtype=float))
    sources, _ = given.GetConnectedSources()
    while sources and UsdShade.NodeGraph(sources[0].source.GetPrim()):
        holder, kind = sources[0].source, sources[0].sourceType
        is_input = kind == UsdShade.AttributeType.Input
        port = holder.GetInput(sources[0].sourceName) if is_input else holder.GetOutput(sources[0].sourceName)
        sources, _ = port.GetConnectedSources()
        if not sources:
            return _numbers(port.Get() if is_input else port.GetAttr().Get())
    if not sources:
        return _numbers(given.Get())
    found = _output(UsdShade.Shader(sources[0].source.GetPrim()), sources[0].sourceName, primvars)
    width = np.atleast_1d(np.array(default)).size
    return np.repeat(found, width) if len(found) == 1 else found[:width]


def _numbers(value):
    return np.atleast_1d(np.array(value, dtype=float))


def _output(node, output, primvars):
    kind = node.GetIdAttr().Get()
    if kind.startswith("UsdPrimvarReader"):
        name = node.GetInput("varname").Get()
        if name in primvars:
            return _numbers(primvars[name])
        return _input(node, "fallback", (0, 0), primvars)
    if kind == "UsdTransform2d":
        place = _input(node, "in", (0, 0), primvars) * _input(node, "scale", (1, 1), primvars)
        (degrees,) = _input(node, "rotation", 0, primvars)
        cos, sin = np.cos(np.radians(degrees)), np.sin(np.radians(degrees))
        turned = np.array([cos * place[0] - sin * place[1], sin * place[0] + cos * place[1]])
        return turned + _input(node, "translation", (0, 0), primvars)
    assert kind == "UsdUVTexture"
    file = node.GetInput("file")
    (source,) = file.GetValueProducingAttributes()
    path = source.Get().resolvedPath
    if not path:
        return _input(node, "fallback", (0, 0, 0, 1), primvars)[CHANNELS[output]]
    with Image.open(path) as picture:
        is_grey, values = len(picture.getbands()) < 3, np.array(picture.convert("RGBA"), dtype=float) / 255
    u, v = _input(node, "st", (0, 0), primvars)
    wraps = [node.GetInput(name).Get() if node.GetInput(name) else "repeat" for name in ("wrapS", "wrapT")]
    pixel = _pixel(values, _wrapped(u, wraps[0]), 1 - _wrapped(v, wraps[1]))
    space = node.GetInput("sourceColorSpace").Get() if node.GetInput("sourceColorSpace") else "auto"
    if space == "sRGB" or (space == "auto" and not is_grey):
        pixel = np.append(linear(pixel[:3]), pixel[3])
    scale, bias = _input(node, "scale", (1,) * 4, primvars), _input(node, "bias", (0,) * 4, primvars)
    return (pixel * scale + bias)[CHANNELS[output]]


def _wrapped(place, wrap):
    if wrap == "clamp":
        return min(max(place, 0), 1)
    if wrap == "mirror":
        return 1 - abs(place % 2 - 1)
    return place % 1


def _pixel(values, across, down):
    rows, columns = values.shape[:2]
    return values[min(int(down * rows), rows - 1), min(int(across * columns), columns - 1)]


class GltfMaterial:
    """The material of the first primitive of a file, at a place of it."""

    def __init__(self, glb):
        self.glb = glb
        (mesh,) = glb.json["meshes"]
        (self.primitive,) = mesh["primitives"]
        self.material = glb.json["materials"][self.primitive["material"]]
        self.reflection = self.material["pbrMetallicRoughness"]
        self.pictures = []
        for image in glb.json.get("images", ()):
            with Image.open(io.BytesIO(bytes(glb.view(image["bufferView"])))) as picture:
                self.pictures.append(np.array(picture.convert("RGBA"), dtype=float) / 255)

    def coordinates(self, number, place):
        """Texture coordinates of a place (x, y) of a flat primitive."""
        attributes = self.primitive["attributes"]
        points, found = self.glb.array(attributes["POSITION"]), self.glb.array(attributes[f"TEXCOORD_{number}"])
        rows = np.column_stack([points[:, :2], np.ones(len(points))])
        return np.array([*place, 1.0]) @ np.linalg.lstsq(rows, found, rcond=None)[0]

    def texel(self, info, place, *, is_srgb=False):
        """What a texture shows at a place; white where there is none."""
        if info is None:
            return np.ones(4)
        u, v = self.coordinates(info.get("texCoord", 0), place)
        said = info.get("extensions", {}).get("KHR_texture_transform", {})
        (scale_u, scale_v), turn = said.get("scale", (1, 1)), said.get("rotation", 0)
        # the matrices of the extension's text, whose columns are written as rows
        cos, sin = np.cos(turn), np.sin(turn)
        u, v = cos * scale_u * u + sin * scale_v * v, -sin * scale_u * u + cos * scale_v * v
        u, v = np.array([u, v]) + said.get("offset", (0, 0))
        texture = self.glb.json["textures"][info["index"]]
        sampler = self.glb.json["samplers"][texture["sampler"]] if "sampler" in texture else {}
        wraps = [WRAPS[sampler.get(name, 10497)] for name in ("wrapS", "wrapT")]
        pixel = _pixel(self.pictures[texture["source"]], _wrapped(u, wraps[0]), _wrapped(v, wraps[1]))
        return np.append(linear(pixel[:3]), pixel[3]) if is_srgb else pixel

    def _of(self, name):
        return self.material.get("extensions", {}).get(f"KHR_materials_{name}", {})

    def values(self, place):
        """What glTF says at a place, by the names of UsdPreviewSurface's inputs."""
        material, reflection, coat = self.material, self.reflection, self._of("clearcoat")
        base = self.texel(reflection.get("baseColorTexture"), place, is_srgb=True)
        base = base * reflection.get("baseColorFactor", (1, 1, 1, 1))
        finish = self.texel(reflection.get("metallicRoughnessTexture"), place)
        glow = self.texel(material.get("emissiveTexture"), place, is_srgb=True)[:3]
        strength = self._of("emissive_strength").get("emissiveStrength", 1)
        hidden, normal = material.get("occlusionTexture"), material.get("normalTexture")
        found = {
            "diffuseColor": base[:3],
            "opacity": base[3:] if "alphaMode" in material else np.ones(1),
            "roughness": finish[1:2] * reflection.get("roughnessFactor", 1),
            "metallic": finish[2:3] * reflection.get("metallicFactor", 1),
            "emissiveColor": glow * material.get("emissiveFactor", (0, 0, 0)) * strength,
            "occlusion": 1 + (hidden or {}).get("strength", 1) * (self.texel(hidden, place)[:1] - 1),
            "ior": np.array([self._of("ior").get("ior", 1.5)]),
            "clearcoat": self.texel(coat.get("clearcoatTexture"), place)[:1] * coat.get("clearcoatFactor", 0),
        }
        if normal:
            scale = normal.get("scale", 1)
            found["normal"] = (2 * self.texel(normal, place)[:3] - 1) * (scale, scale, 1)
        if coat:
            rough = self.texel(coat.get("clearcoatRoughnessTexture"), place)[1:2]
            found["clearcoatRoughness"] = rough * coat.get("clearcoatRoughnessFactor", 0)
        if mirror := self._of("specular"):
            colour = self.texel(mirror.get("specularColorTexture"), place, is_srgb=True)[:3]
            found["specularColor"] = 0.04 * colour * mirror.get("specularColorFactor", (1, 1, 1))
        return found
