"""Small stages of others: one square with one material, each with something that few programs say of a surface."""

import io

import numpy as np
from PIL import Image
from pxr import Usd

__all__ = ["BROKEN_PICTURES", "MATERIALS", "material_stage", "odd_pictures", "write_pictures"]

STAGE = """#usda 1.0
(
    defaultPrim = "W"
    metersPerUnit = 1
    upAxis = "Y"
)
def Xform "W"
{{
    def Mesh "Square" (prepend apiSchemas = ["MaterialBindingAPI"])
    {{
        int[] faceVertexCounts = [4]
        int[] faceVertexIndices = [0, 1, 2, 3]
        point3f[] points = [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0)]
        uniform token subdivisionScheme = "none"
        texCoord2f[] primvars:st = [(0, 0), (1, 0), (1, 1), (0, 1)] (interpolation = "vertex")
        texCoord2f[] primvars:UVMap = [(0.9, 0.1), (0.9, 0.8), (0.2, 0.8), (0.2, 0.1)] (interpolation = "vertex")
        texCoord2f[] primvars:wide = [(-1.3, -0.6), (2.1, -0.6), (2.1, 1.7), (-1.3, 1.7)] (interpolation = "vertex")
        float[] primvars:shine = [0.25] (interpolation = "constant")
        rel material:binding = </W/M>
    }}
    def Material "M"
    {{
        token outputs:surface.connect = </W/M/S.outputs:surface>
        {interface}
        def Shader "S"
        {{
            uniform token info:id = "UsdPreviewSurface"
            {inputs}
            token outputs:surface
        }}
        {nodes}
    }}
}}
"""
KINDS = {
    **dict.fromkeys(("diffuseColor", "emissiveColor", "specularColor"), "color3f"),
    "normal": "normal3f",
    "useSpecularWorkflow": "int",
}
OUTPUTS = "float3 outputs:rgb\n float outputs:r\n float outputs:g\n float outputs:b\n float outputs:a"


def texture(name, file, st="P", **said):
    """A UsdUVTexture; what it says beside its file is text of USD."""
    kinds = {"sourceColorSpace": "token", "wrapS": "token", "wrapT": "token"}
    lines = [f"{kinds.get(key, 'float4')} inputs:{key} = {value}" for key, value in said.items()]
    return shader(name, "UsdUVTexture", f"asset inputs:file = @{file}@", read("st", st), *lines, OUTPUTS)


def moved(name, after="P", **said):
    """A UsdTransform2d."""
    kinds = {"rotation": "float"}
    lines = [f"{kinds.get(key, 'float2')} inputs:{key} = {value}" for key, value in said.items()]
    return shader(name, "UsdTransform2d", read("in", after), *lines, "float2 outputs:result")


def primvar(name="P", varname="st", kind="float2", fallback=None):
    """A UsdPrimvarReader."""
    lines = [] if fallback is None else [f"{kind} inputs:fallback = {fallback}"]
    own = f'string inputs:varname = "{varname}"'
    return shader(name, f"UsdPrimvarReader_{kind}", own, *lines, f"{kind} outputs:result")


def read(name, node):
    return f"float2 inputs:{name}.connect = </W/M/{node}.outputs:result>"


def shader(name, identifier, *lines):
    return f'def Shader "{name}" {{\n uniform token info:id = "{identifier}"\n ' + "\n ".join(lines) + "\n}\n"


def case(*nodes, interface="", **inputs):
    """A material by its nodes and inputs: text with a dot is an output that is read, all else a value."""
    lines = []
    for name, value in inputs.items():
        kind = KINDS.get(name, "float")
        is_read = isinstance(value, str) and "." in value and not value.startswith("(")
        lines.append(
            f"{kind} inputs:{name}.connect = </W/M{'/' if not value.startswith('.') else ''}{value}>"
            if is_read
            else f"{kind} inputs:{name} = {value}"
        )
    return {"inputs": "\n".join(lines), "nodes": "\n".join(nodes), "interface": interface}


RGB, RAW = "T.outputs:rgb", {"sourceColorSpace": '"raw"'}
MATERIALS = {
    "constants": case(diffuseColor=(0.2, 0.4, 0.6), roughness=0.3, metallic=0.7, opacity=0.5, ior=1.8),
    "glow of a texture": case(texture("T", "noise.png"), primvar(), diffuseColor=(0.1, 0.1, 0.1), emissiveColor=RGB),
    "strong glow of a texture": case(
        texture("T", "noise.png", scale=(5, 2, 1, 1)), primvar(), diffuseColor=(0, 0, 0), emissiveColor=RGB
    ),
    "glow with a bias": case(
        texture("T", "noise.png", scale=(2, 1, 1, 1), bias=(0.5, 0.1, 0, 0)), primvar(), emissiveColor=RGB
    ),
    "tint": case(texture("T", "noise.png", scale=(0.2, 0.4, 0.6, 1)), primvar(), diffuseColor=RGB),
    "bias": case(
        texture("T", "noise.png", scale=(0.5, 0.4, -0.6, 1), bias=(0.5, 0.1, 0.7, 0)), primvar(), diffuseColor=RGB
    ),
    "colour that is stored raw": case(texture("T", "noise.png", **RAW), primvar(), diffuseColor=RGB),
    "colour of one channel": case(texture("T", "noise.png"), primvar(), diffuseColor="T.outputs:b"),
    "moved": case(
        texture("T", "noise.png", "X", wrapS='"repeat"', wrapT='"repeat"'),
        moved("X", scale=(2, 3), translation=(0.25, 0.5)),
        primvar(),
        diffuseColor=RGB,
    ),
    "turned": case(
        texture("T", "noise.png", "X"),
        moved("X", scale=(2, 3), rotation=30, translation=(0.25, -0.5)),
        primvar(varname="UVMap"),
        diffuseColor=RGB,
    ),
    "mirrored": case(
        texture("T", "noise.png", "X"), moved("X", scale=(-1, 2), rotation=-75), primvar(), diffuseColor=RGB
    ),
    "moved twice": case(
        texture("T", "noise.png", "Y"),
        moved("X", scale=(2, 2), rotation=20, translation=(0.1, 0.2)),
        moved("Y", after="X", scale=(1.5, 1.5), rotation=-50, translation=(0.3, 0.4)),
        primvar(),
        diffuseColor=RGB,
    ),
    "other coordinates": case(texture("T", "noise.png"), primvar(varname="UVMap"), diffuseColor=RGB),
    "missing coordinates": case(
        texture("T", "noise.png"), primvar(varname="nowhere", fallback=(0.3, 0.7)), diffuseColor=RGB
    ),
    "fixed coordinates": case(
        texture("T", "noise.png").replace(read("st", "P"), "float2 inputs:st = (0.8, 0.3)"), diffuseColor=RGB
    ),
    "two sets of coordinates": case(
        texture("T", "noise.png"),
        texture("U", "other.png", "Q", **RAW),
        primvar(varname="UVMap"),
        primvar("Q", "st"),
        diffuseColor=RGB,
        roughness="U.outputs:g",
        metallic=0.5,
    ),
    "clamped and mirrored": case(
        texture("T", "noise.png", wrapS='"clamp"', wrapT='"mirror"'), primvar(varname="wide"), diffuseColor=RGB
    ),
    "repeated": case(
        texture("T", "noise.png", wrapS='"repeat"', wrapT='"useMetadata"'), primvar(varname="wide"), diffuseColor=RGB
    ),
    "missing file": case(
        texture("T", "nowhere.png", fallback=(0.9, 0.1, 0.2, 0.5), scale=(0.5, 0.5, 0.5, 1)),
        primvar(),
        diffuseColor=RGB,
        opacity="T.outputs:a",
        roughness="T.outputs:g",
    ),
    "missing file without a fallback": case(texture("T", "nowhere.png"), primvar(), diffuseColor=RGB),
    "roughness times a factor": case(
        texture("T", "noise.png", scale=(0.2, 0.2, 0.2, 1), **RAW), primvar(), roughness="T.outputs:g"
    ),
    "roughness and metallic of two files": case(
        texture("T", "noise.png", scale=(0.5, 1, 1, 1), **RAW),
        texture("U", "other.png", scale=(1, 1, -1, 1), bias=(0, 0, 1, 0), **RAW),
        primvar(),
        roughness="T.outputs:r",
        metallic="U.outputs:b",
    ),
    "metallic alone": case(texture("T", "noise.png", **RAW), primvar(), metallic="T.outputs:a", roughness=0.4),
    "roughness that is stored as sRGB": case(
        texture("T", "noise.png", sourceColorSpace='"sRGB"'), primvar(), roughness="T.outputs:g"
    ),
    "occlusion": case(texture("T", "noise.png", **RAW), primvar(), occlusion="T.outputs:b"),
    "weak occlusion": case(
        texture("T", "noise.png", scale=(0.25,) * 4, bias=(0.75,) * 4, **RAW), primvar(), occlusion="T.outputs:r"
    ),
    "opacity of another file": case(
        texture("T", "noise.png"),
        texture("O", "grey.png", **RAW),
        primvar(),
        diffuseColor=RGB,
        opacity="O.outputs:r",
    ),
    "opacity of the same file": case(texture("T", "alpha.png"), primvar(), diffuseColor=RGB, opacity="T.outputs:a"),
    "opacity times a factor": case(
        texture("T", "alpha.png", scale=(1, 1, 1, 0.5)), primvar(), diffuseColor=(0.3, 0.6, 0.9), opacity="T.outputs:a"
    ),
    "half opaque and an alpha that nobody reads": case(
        texture("T", "alpha.png"), primvar(), diffuseColor=RGB, opacity=0.5
    ),
    "an alpha that nobody reads": case(texture("T", "alpha.png"), primvar(), diffuseColor=RGB),
    "cut out": case(
        texture("T", "noise.png"),
        texture("O", "grey.png", **RAW),
        primvar(),
        diffuseColor=RGB,
        opacity="O.outputs:g",
        opacityThreshold=0.4,
    ),
    "normals": case(texture("T", "noise.png", scale=(2, 2, 2, 1), bias=(-1, -1, -1, 0), **RAW), primvar(), normal=RGB),
    "flat normals": case(
        texture("T", "noise.png", scale=(1, 1, 2, 1), bias=(-0.5, -0.5, -1, 0), **RAW), primvar(), normal=RGB
    ),
    "normals that look down": case(
        texture("T", "noise.png", scale=(2, -2, 2, 1), bias=(-1, 1, -1, 0), **RAW), primvar(), normal=RGB
    ),
    "a coat": case(
        texture("T", "noise.png", **RAW),
        primvar(),
        clearcoat="T.outputs:b",
        clearcoatRoughness="T.outputs:r",
        roughness=0.8,
    ),
    "a plain coat": case(clearcoat=0.5, clearcoatRoughness=0.25),
    "mirrors by their colour": case(
        useSpecularWorkflow=1, specularColor=(0.5, 0.02, 0.1), diffuseColor=(0.2, 0.3, 0.4)
    ),
    "mirrors by a texture": case(
        texture("T", "noise.png"), primvar(), useSpecularWorkflow=1, specularColor=RGB, metallic=1
    ),
    "through an interface": case(
        texture("T", "noise.png").replace("= @noise.png@", ".connect = </W/M.inputs:picture>"),
        primvar(),
        interface="asset inputs:picture = @noise.png@\n float inputs:rough = 0.125",
        diffuseColor=RGB,
        roughness=".inputs:rough",
    ),
    "through a graph of nodes": case(
        'def NodeGraph "N" {\n color3f outputs:colour.connect = </W/M/T.outputs:rgb>\n}',
        texture("T", "noise.png"),
        primvar(),
        diffuseColor="N.outputs:colour",
    ),
    "a number of a primvar": case(primvar("R", "shine", "float"), roughness="R.outputs:result"),
    "a number of a missing primvar": case(primvar("R", "dull", "float", fallback=0.875), roughness="R.outputs:result"),
    "a connection that leads nowhere": case(roughness="Nothing.outputs:r", metallic=0.5),
}
"""Materials by what they are about."""


def write_pictures(folder):
    """The pictures that the materials read: no two pixels of them are alike."""
    rng = np.random.default_rng(7)
    for name, mode in (("noise.png", "RGB"), ("other.png", "RGB"), ("alpha.png", "RGBA"), ("grey.png", "L")):
        channels = len(mode)
        values = rng.integers(0, 256, (8, 8, channels), dtype=np.uint8)
        Image.fromarray(values[..., 0] if channels == 1 else values).save(folder / name)


def material_stage(folder, said):
    """A stage of the square with a material of `MATERIALS`, and its pictures beside it."""
    write_pictures(folder)
    path = folder / "square.usda"
    path.write_text(STAGE.format(**said))
    return Usd.Stage.Open(str(path))


COLOUR = 200, 30, 10


def odd_pictures(folder):
    """Pictures of one colour in ways that few programs take, by name, with how far off they may be (0 to 255)."""
    plain = Image.new("RGB", (8, 8), COLOUR)
    made = {}

    def save(name, picture, off=1, **options):
        picture.save(folder / name, **options)
        made[name] = off

    save("a.tga", plain)
    save("a.webp", plain, lossless=True)
    save("a.bmp", plain)
    save("a.dds", plain)
    save("palette.png", plain.quantize())
    save("jpeg_named.png", plain, 3, format="JPEG", quality=100)
    save("no_ending", plain, format="PNG")
    save("UPPER CASE.JPG", plain, 3, format="JPEG", quality=100)
    save("print.jpg", plain.convert("CMYK"), 6, format="JPEG", quality=100)
    save("tile.1001.png", plain)
    return {("tile.<UDIM>.png" if name == "tile.1001.png" else name): off for name, off in made.items()}


def _half_png():
    noise, whole = np.random.default_rng(3).integers(0, 256, (32, 32, 3), dtype=np.uint8), io.BytesIO()
    Image.fromarray(noise).save(whole, format="PNG")
    return whole.getvalue()[:1500]


BROKEN_PICTURES = {
    "empty.png": b"",
    "half.png": _half_png(),
    "words.dds": b"no picture at all",
    "zeros.exr": b"\x76\x2f\x31\x01" + bytes(400),
    "what.xyz": bytes(range(256)),
    "head.jpg": b"\xff\xd8\xff\xe0" + bytes(40),
}
"""Bytes that are no picture, by the name of the file."""
