"""Files of cars of one's own: named in settings, with others beside them, and damaged ones refused in one line."""

import io
import json
import struct
from pathlib import Path

import numpy as np
import pytest
from PIL import Image
from pxr import Gf, Sdf, Usd, UsdGeom, UsdShade
from support.foreign_cars import boxes, plain, write_glb, write_z_up

from garage2usd.cli import main
from garage2usd.common.errors import ConfigError
from garage2usd.config import config_from_mapping
from garage2usd.config.files import with_textures
from garage2usd.config.own_cars import ModelFolder, read_own_cars
from garage2usd.scenes.foreign_models import read_model
from garage2usd.sensors.rig.rig import read_rig

_HEADER = struct.Struct("<4sIIII")


@pytest.fixture(scope="module")
def glb(tmp_path_factory):
    """A GLB as JSON and binary chunk."""
    path = tmp_path_factory.mktemp("glb") / "c.glb"
    write_glb(path)
    data = path.read_bytes()
    length = _HEADER.unpack_from(data)[3]
    return json.loads(data[20 : 20 + length]), data[20 + length :]


def packed(document, binary):
    text = json.dumps(document).encode()
    text += b" " * (-len(text) % 4)
    return _HEADER.pack(b"glTF", 2, 20 + len(text) + len(binary), len(text), 0x4E4F534A) + text + binary


def written(tmp_path, glb, change):
    document, binary = json.loads(json.dumps(glb[0])), glb[1]
    change(document)
    (tmp_path / "c.glb").write_bytes(packed(document, binary))
    return tmp_path / "c.glb"


def refused(path):
    with pytest.raises(ConfigError) as error:
        read_own_cars(ModelFolder(folder=str(path)))
    said = str(error.value)
    assert "\n" not in said
    assert "0x" not in said
    assert "Error" not in said
    return said.replace(str(path), "c")


FAULTS = {
    "c, compressed by EXT_meshopt_compression": lambda d: d.update(extensionsRequired=["EXT_meshopt_compression"]),
    "c, which requires ACME_clay": lambda d: d.update(extensionsRequired=["ACME_clay"]),
    "c without nope.png": lambda d: d["images"].__setitem__(0, {"uri": "nope.png"}),
    "a model whose files lie beside it": lambda d: d["images"].__setitem__(0, {"uri": "https://example.org/a.png"}),
    "c, image paint'; allowed: a picture of a known format": lambda d: d["images"].__setitem__(
        0, {"name": "paint", "uri": "data:image/png;base64,AAAA"}
    ),
    "c, node 1'; allowed: a tree of nodes": lambda d: (
        d["nodes"][1].update(children=[2]),
        d["nodes"][2].update(children=[1]),
    ),
    "c, node 1 in two nodes": lambda d: (d["nodes"][2].update(children=[1]), d["nodes"][3].update(children=[1])),
    "c, node 1 with child 999": lambda d: d["nodes"][1].update(children=[999]),
    "c, with nodes that are no list of tables'; allowed: a file whose tables are those of glTF 2.0": lambda d: d.update(
        nodes={"a": 5}
    ),
    "c, with bufferViews 1000000 of": lambda d: d["accessors"][0].update(bufferView=10**6),
}


@pytest.mark.parametrize("said", FAULTS)
def test_damaged_glbs_are_refused_in_one_line(tmp_path, glb, said, capfd):
    assert said in refused(written(tmp_path, glb, FAULTS[said]))
    assert capfd.readouterr() == ("", "")


@pytest.mark.parametrize("length", [0, 11, 19, 500, -40])
def test_cut_off_glbs_are_refused(tmp_path, glb, length):
    (tmp_path / "c.glb").write_bytes(packed(*glb)[:length])
    assert "a GLB" in refused(tmp_path / "c.glb") or "a whole GLB" in refused(tmp_path / "c.glb")


def test_pictures_beside_a_glb_are_read_and_count_in_its_digest(tmp_path, glb):
    (tmp_path / "my pictures").mkdir()
    picture = tmp_path / "my pictures" / "paint.png"
    plain((10, 160, 40)).save(picture)
    path = written(tmp_path, glb, lambda d: d["images"].__setitem__(0, {"uri": "my%20pictures/paint.png"}))
    (part,) = [part for part in read_model(path, field="models").parts if part.surface.picture]
    assert Image.open(io.BytesIO(part.surface.picture.data)).getpixel((0, 0)) == (10, 160, 40)
    first, _ = read_own_cars(ModelFolder(folder=str(path)))
    plain((10, 160, 41)).save(picture)
    second, _ = read_own_cars(ModelFolder(folder=str(path)))
    assert first.sha256 != second.sha256


def test_models_are_a_folder_a_file_or_a_list_of_files(tmp_path):
    write_glb(tmp_path / "box.glb")
    (tmp_path / "._box.glb").write_bytes(b"\0\5\26\7Mac OS X")
    digests = set()
    for named in (".", "box.glb", ["box.glb"]):
        given = with_textures({"vehicles": {"models": named}}, tmp_path)
        models = config_from_mapping(given).vehicles.models
        assert len(read_own_cars(models)[1]) == 1
        digests.add(models.sha256)
    assert len(digests) == 1
    for wrong, allowed in (
        (5, "or a list of files"),
        ([], "at least 1 item"),
        ({"foldr": "a"}, "the nearest is folder"),
    ):
        with pytest.raises(ConfigError, match=allowed) as error:
            config_from_mapping({"vehicles": {"models": wrong}})
        assert "ModelFolder" not in str(error.value)


def usd_car(path, *, metres=1.0):
    """A car in one mesh with coordinates, whose left half is that of its texture."""
    stage = Usd.Stage.CreateNew(str(path))
    UsdGeom.SetStageUpAxis(stage, UsdGeom.Tokens.y)
    UsdGeom.SetStageMetersPerUnit(stage, metres)
    stage.SetDefaultPrim(UsdGeom.Xform.Define(stage, "/Car").GetPrim())
    for name, given in boxes().items():
        mesh = UsdGeom.Mesh.Define(stage, f"/Car/{name}")
        mesh.CreatePointsAttr(given.vertices.astype(np.float32))
        mesh.CreateFaceVertexCountsAttr([3] * len(given.faces))
        mesh.CreateFaceVertexIndicesAttr(given.faces.ravel().astype(np.int32))
    return stage


def test_texture_coordinates_of_usd_cars_are_read(tmp_path):
    stage = usd_car(tmp_path / "c.usda")
    body = UsdGeom.PrimvarsAPI(stage.GetPrimAtPath("/Car/body"))
    points = UsdGeom.Mesh(body.GetPrim()).GetPointsAttr().Get()
    other = body.CreatePrimvar("aaa", Sdf.ValueTypeNames.TexCoord2fArray, UsdGeom.Tokens.vertex)
    other.Set([Gf.Vec2f(7, 7)] * len(points))
    st = body.CreatePrimvar("st", Sdf.ValueTypeNames.TexCoord2fArray, UsdGeom.Tokens.vertex)
    st.Set([Gf.Vec2f(0.25 if x < 0 else 0.75, 0.5) for x, _, _ in points])
    ground = UsdGeom.Mesh.Define(stage, "/Ground")
    ground.CreatePointsAttr([(-9, 0, -9), (9, 0, -9), (9, 0, 9)])
    ground.CreateFaceVertexCountsAttr([3])
    ground.CreateFaceVertexIndicesAttr([0, 1, 2])
    material = UsdShade.Material.Define(stage, "/Car/Paint")
    surface, picture, reader = (
        UsdShade.Shader.Define(stage, f"/Car/Paint/{name}") for name in ("Surface", "Picture", "Reader")
    )
    for shader, kind in ((surface, "PreviewSurface"), (picture, "UVTexture"), (reader, "PrimvarReader_float2")):
        shader.CreateIdAttr(f"Usd{kind}")
    plain((10, 160, 40)).save(tmp_path / "paint.png")
    reader.CreateInput("varname", Sdf.ValueTypeNames.String).Set("st")
    picture.CreateInput("file", Sdf.ValueTypeNames.Asset).Set("paint.png")
    picture.CreateInput("st", Sdf.ValueTypeNames.Float2).ConnectToSource(reader.ConnectableAPI(), "result")
    surface.CreateInput("diffuseColor", Sdf.ValueTypeNames.Color3f).ConnectToSource(picture.ConnectableAPI(), "rgb")
    material.CreateSurfaceOutput().ConnectToSource(surface.ConnectableAPI(), "surface")
    UsdShade.MaterialBindingAPI.Apply(body.GetPrim()).Bind(material)
    stage.Save()
    parts = {part.name: part for part in read_model(tmp_path / "c.usda", field="models").parts}
    part = parts["/Car/body"]
    assert (part.st[..., 0] == np.where(part.triangles_m[..., 0] < 0, 0.25, 0.75)).all()
    assert "/Ground" not in parts


def test_files_that_no_reading_needs_may_be_missing_and_others_are_named(tmp_path, capfd):
    write_z_up(tmp_path / "c.usda")
    stage = Usd.Stage.Open(str(tmp_path / "c.usda"))
    mdl = UsdShade.Shader.Define(stage, "/Van/Red/Mdl")
    mdl.SetSourceAsset("OmniPBR.mdl", "mdl")
    UsdShade.Material(stage.GetPrimAtPath("/Van/Red")).CreateSurfaceOutput("mdl").ConnectToSource(
        mdl.ConnectableAPI(), "out"
    )
    stage.Save()
    _, (car,) = read_own_cars(ModelFolder(folder=str(tmp_path)))
    (part,) = read_model(Path(car.path), field="models").parts
    assert part.surface.colour_rgb == pytest.approx((0.6, 0.02, 0.02))
    assert capfd.readouterr().err == ""
    reader = UsdShade.Shader.Define(stage, "/Van/Red/Paint")
    reader.CreateIdAttr("UsdUVTexture")
    reader.CreateInput("file", Sdf.ValueTypeNames.Asset).Set("nope.png")
    shader = UsdShade.Shader(stage.GetPrimAtPath("/Van/Red/Surface"))
    shader.GetInput("diffuseColor").ConnectToSource(reader.ConnectableAPI(), "rgb")
    stage.Save()
    assert "c without nope.png" in refused(tmp_path / "c.usda")
    (tmp_path / "nope.png").write_bytes(b"no picture")
    assert "c, nope.png'; allowed: a picture of a known format" in refused(tmp_path / "c.usda")


@pytest.mark.parametrize("metres", [0.0, -1.0, float("inf")])
def test_units_of_no_length_are_named(tmp_path, metres):
    usd_car(tmp_path / "c.usda", metres=metres).Save()
    assert "with metersPerUnit" in refused(tmp_path / "c.usda")


@pytest.mark.parametrize("face", [-1, 12, 999])
def test_faces_of_subsets_that_there_are_not_are_named(tmp_path, face):
    stage = usd_car(tmp_path / "c.usda")
    binding = UsdShade.MaterialBindingAPI.Apply(stage.GetPrimAtPath("/Car/body"))
    subset = binding.CreateMaterialBindSubset("x", [0, face])
    UsdShade.MaterialBindingAPI.Apply(subset.GetPrim()).Bind(UsdShade.Material.Define(stage, "/Car/Red"))
    stage.Save()
    assert f"/Car/body/x names face {face} of 12" in refused(tmp_path / "c.usda")


def test_flat_glass_of_a_mirror_has_an_outline(tmp_path):
    stage = usd_car(tmp_path / "c.usda")
    glass = UsdGeom.Mesh(stage.GetPrimAtPath("/Car/door_mirror_left"))
    glass.GetPointsAttr().Set([(-0.9, 0.9, -0.7), (-0.9, 1.0, -0.7), (-0.9, 1.0, -0.6), (-0.9, 0.9, -0.6)])
    glass.GetFaceVertexCountsAttr().Set([4])
    glass.GetFaceVertexIndicesAttr().Set([0, 1, 2, 3])
    stage.RemovePrim("/Car/door_mirror_right")
    stage.Save()
    _, (car,) = read_own_cars(ModelFolder(folder=str(tmp_path)))
    assert len(car.outlines) == 2


def test_pictures_of_sixteen_bits_keep_their_grey(tmp_path, glb):
    stream = io.BytesIO()
    Image.fromarray(np.full((4, 4), 76 * 257, np.uint16)).save(stream, format="PNG")
    (tmp_path / "grey.png").write_bytes(stream.getvalue())
    path = written(tmp_path, glb, lambda d: d["images"].__setitem__(0, {"uri": "grey.png"}))
    (part,) = [part for part in read_model(path, field="models").parts if part.surface.picture]
    assert Image.open(io.BytesIO(part.surface.picture.data)).getpixel((0, 0)) == (76, 76, 76)


def test_what_is_not_taken_is_said_by_each_command_and_in_the_report(tmp_path, glb, capsys):
    path = written(tmp_path, glb, lambda d: d["materials"][0].update(extensions={"KHR_materials_sheen": {}}))
    title = json.loads(json.dumps(glb[0]))["materials"][0]["name"]
    line = f"c.glb: KHR_materials_sheen is not used (1): {title}"
    (tmp_path / "garage.toml").write_text(
        f'site = {{width_cells = 4, height_cells = 4}}\nplan = {{episodes = 40}}\nvehicles = {{models = "{path}"}}\n'
    )
    main(["build", str(tmp_path / "garage.toml"), "-o", str(tmp_path / "g.usdc")], standalone_mode=False)
    assert line in capsys.readouterr().err
    assert json.loads((tmp_path / "g_report.json").read_text())["remarks"] == [line]
    (tmp_path / "rig.toml").write_text(
        'name = "own"\nmodels = "c.glb"\ncar = "c"\n'
        '[[sensors]]\nkind = "pinhole"\nname = "front"\nposition_m = [1, 0, 1.4]\nsize_px = [64, 48]\n'
        "focal_px = [40, 40]\n"
    )
    assert read_rig(tmp_path / "rig.toml").remarks == (line,)
