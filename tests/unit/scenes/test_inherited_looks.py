"""What instances inherit from outside of their prototypes: each prim looks as pxr says that it does at its own path."""

import numpy as np
import pytest
from pxr import Usd, UsdGeom, UsdShade
from support.glb_reader import Glb

from garage2usd.maps.glb import write_glb
from garage2usd.render.drawn_prims import read_drawn_prims
from garage2usd.scenes.looks import MeshLooks
from garage2usd.scenes.meshes import DRAWN_TYPES
from garage2usd.scenes.walk import placed_objects
from garage2usd.view.viewer import read_scene

COLOURS = {"Red": (1, 0, 0), "Green": (0, 1, 0), "Blue": (0, 0, 1), "Grey": (0.25, 0.25, 0.25)}
BINDS = 'prepend apiSchemas = ["MaterialBindingAPI"]'


def block(kind, name, *lines, said=""):
    """A prim in the text of USD."""
    return "\n".join([f'{kind} "{name}" (', said, ")", "{", *lines, "}", ""])


LOOKS = "".join(
    block(
        "def Material",
        name,
        f"token outputs:surface.connect = </W/Looks/{name}/S.outputs:surface>",
        block(
            "def Shader",
            "S",
            'uniform token info:id = "UsdPreviewSurface"',
            f"color3f inputs:diffuseColor = {colour}",
            "token outputs:surface",
        ),
    )
    for name, colour in COLOURS.items()
)
SHEET = (
    "int[] faceVertexCounts = [3, 3]",
    "int[] faceVertexIndices = [0, 1, 2, 0, 2, 3]",
    "point3f[] points = [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0)]",
    'uniform token subdivisionScheme = "none"',
)


def instance(name, *lines, part="Part"):
    return block("def Xform", name, *lines, said=f"instanceable = true\nreferences = </{part}>\n{BINDS}")


def group(name, *lines):
    return block("def Xform", name, *lines, said=BINDS)


def bind(look, suffix="", *, strong=False):
    strength = ' (bindMaterialAs = "strongerThanDescendants")' if strong else ""
    return f"rel material:binding{suffix} = </W/Looks/{look}>{strength}"


def shown(colour):
    return f'color3f[] primvars:displayColor = [{colour}] (interpolation = "constant")'


def stage_text(*prims, sheet=SHEET):
    """A stage with the materials, parts for instances, and some prims."""
    grey = block("over", "Sheet", bind("Grey"), said=BINDS)
    pair = instance("One"), instance("Other", part="Own")
    return "".join(
        [
            '#usda 1.0\n(\ndefaultPrim = "W"\nmetersPerUnit = 1\nupAxis = "Y"\n)\n',
            block("def Xform", "W", block("def Scope", "Looks", LOOKS), *prims),
            block("class Xform", "Part", block("def Mesh", "Sheet", *sheet)),
            block("class Xform", "Own", grey, said="inherits = </Part>"),
            block("class Xform", "Pair", *pair),
        ]
    )


CAN = block("def Xform", "Can", said="references = </Part>")
CANS = block(
    "def PointInstancer",
    "Cans",
    "rel prototypes = </W/Shelf/Cans/Can>",
    "int[] protoIndices = [0, 0]",
    "point3f[] positions = [(0, 0, 0), (2, 0, 0)]",
    CAN,
)
COLLECTION = block(
    "def Xform",
    "Up",
    bind("Grey"),
    'uniform token collection:some:expansionRule = "expandPrims"',
    "rel collection:some:includes = </W/Up/B>",
    "rel material:binding:collection:some = [</W/Up.collection:some>, </W/Looks/Green>]",
    instance("A"),
    instance("B"),
    said='prepend apiSchemas = ["MaterialBindingAPI", "CollectionAPI:some"]',
)
HIDDEN, GUIDE = 'token visibility = "invisible"', 'uniform token purpose = "guide"'
STAGES = {
    "bound to instances": [instance("A", bind("Red")), instance("B", bind("Blue")), instance("C")],
    "bound above": [group("Up", bind("Red"), instance("A"), instance("B", bind("Blue")))],
    "stronger above": [
        group("Up", bind("Green", strong=True), instance("A", part="Own")),
        instance("B", part="Own"),
    ],
    "nested": [
        instance("A", bind("Red"), part="Pair"),
        instance("B", bind("Blue", strong=True), part="Pair"),
        instance("C", part="Pair"),
    ],
    "for a purpose": [instance("A", bind("Red"), bind("Blue", ":preview")), instance("B", bind("Red"))],
    "a collection": [COLLECTION],
    "colours": [
        instance("A", shown((0, 1, 0))),
        instance("B", shown((0, 0, 1))),
        group("Up", shown((1, 0, 0)), instance("C", part="Pair")),
    ],
    "hidden and guides": [
        instance("A", bind("Red")),
        instance("B", bind("Blue"), HIDDEN),
        instance("C", bind("Green"), GUIDE),
        group("Up", HIDDEN, instance("D", bind("Red"))),
    ],
    "points in instances": [
        block("class Xform", "Shelf", CANS),
        instance("A", bind("Red"), part="W/Shelf"),
        instance("B", bind("Blue"), part="W/Shelf"),
    ],
}


UNBOUND = {"colours": {(0, 1, 0), (0, 0, 1), (1, 0, 0)}}
"""Colours that come from no material."""


def opened(tmp_path, about):
    path = tmp_path / "stage.usda"
    path.write_text(stage_text(*STAGES[about]))
    return Usd.Stage.Open(str(path)), path


def colour_of(prim):
    """What pxr says of a prim at its own path."""
    material, _ = UsdShade.MaterialBindingAPI(prim).ComputeBoundMaterial(UsdShade.Tokens.preview)
    if material:
        return COLOURS[material.GetPrim().GetName()]
    shown = UsdGeom.PrimvarsAPI(prim).FindPrimvarWithInheritance("displayColor")
    return tuple(shown.Get()[0]) if shown and shown.HasValue() else (0.5, 0.5, 0.5)


def expected(stage):
    """Path and colour of each mesh that is drawn; a point of an instancer is called as its prototype."""
    for prim in Usd.PrimRange(stage.GetPseudoRoot(), Usd.TraverseInstanceProxies(Usd.PrimDefaultPredicate)):
        if prim.IsA(UsdGeom.Mesh):
            seen = UsdGeom.Imageable(prim)
            if seen.ComputeVisibility() != "invisible" and seen.ComputePurpose() in {"default", "render"}:
                yield str(prim.GetPath()), colour_of(prim)


@pytest.mark.parametrize("about", STAGES)
def test_every_reader_shows_what_usd_computes(about, tmp_path):
    stage, path = opened(tmp_path, about)
    wanted, found = dict(expected(stage)), {}
    assert wanted
    looks = MeshLooks()
    objects = placed_objects(stage, np.eye(4))
    for placed in objects:
        for part in placed.parts:
            if part.prim.GetTypeName() in DRAWN_TYPES:
                ((_, surface, _),) = looks.of_part(placed, part)
                found[placed.twin + part.path] = looks.surfaces.values[surface].colour_rgb
    assert found.keys() == wanted.keys()
    assert all(found[name] == pytest.approx(wanted[name]) for name in wanted)

    many = sorted(wanted[placed.twin + part.path] for placed in objects for part in placed.parts)
    scene = read_scene(stage, path)
    shown = [
        scene.surfaces[scene.palettes[placed.palette][piece.slot]].colour_rgb
        for placed in scene.objects
        for piece in scene.shapes[placed.shape].pieces
    ]
    assert sorted(shown) == [pytest.approx(colour) for colour in many]

    write_glb(stage, tmp_path / "stage.glb")
    glb = Glb((tmp_path / "stage.glb").read_bytes())
    written = {
        node["name"]: {
            tuple(glb.json["materials"][own["material"]]["pbrMetallicRoughness"].get("baseColorFactor", (1,) * 4)[:3])
            for own in glb.json["meshes"][node["mesh"]]["primitives"]
        }
        for node in glb.nodes
    }
    assert written == {placed.path: {wanted[placed.twin + part.path] for part in placed.parts} for placed in objects}

    drawn = read_drawn_prims(stage, {})
    rendered = sorted(colour_of(stage.GetPrimAtPath(drawn.shapes[shape])) for shape in drawn.shape)
    assert rendered == [pytest.approx(colour) for colour in many]
    bound = {COLOURS[path.name] for path in drawn.materials}
    assert bound == {colour for colour in many if colour in COLOURS.values()} - UNBOUND.get(about, set())


def test_subsets_inherit_too(tmp_path):
    path = tmp_path / "stage.usda"
    half = 'uniform token elementType = "face"', "int[] indices = [1]", bind("Green")
    sheet = *SHEET, block("def GeomSubset", "Half", *half, said=BINDS)
    instances = instance("A", bind("Red")), instance("B", bind("Blue", strong=True))
    path.write_text(stage_text(*instances, sheet=sheet))
    stage, looks = Usd.Stage.Open(str(path)), MeshLooks()
    found = {}
    for placed in placed_objects(stage, np.eye(4)):
        (part,) = placed.parts
        found[placed.path] = [looks.surfaces.values[own.surface].colour_rgb for own in looks.of_part(placed, part)]
    assert found == {"/W/A": [(0, 1, 0), (1, 0, 0)], "/W/B": [(0, 0, 1), (0, 0, 1)]}
