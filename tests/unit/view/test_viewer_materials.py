"""The page gets materials of other programs as UsdPreviewSurface's specification says, or they are named."""

import io
from pathlib import Path

import numpy as np
import pytest
from PIL import Image
from pxr import UsdShade
from support.foreign_materials import MATERIALS, material_stage
from support.preview_surface import linear, value_at

from garage2usd.reading.files import open_stage
from garage2usd.view.viewer import ViewerServer, read_scene

CLAMPED = "clamped and mirrored"
NAMED = {
    "glow of a texture": "textures of what glows are shown as their mean",
    "strong glow of a texture": "textures of what glows are shown as their mean",
    "glow with a bias": "textures of what glows are shown as their mean",
    "two sets of coordinates": "roughness textures that lie unlike the colour's are shown as their mean",
    CLAMPED: "textures that clamp and mirror outside are repeated",
    "missing file": "textures whose file is missing show their fallback",
    "missing file without a fallback": "textures whose file is missing show their fallback",
    "missing coordinates": "textures show one pixel without the coordinates nowhere",
}
TOLERANCE = 3 / 255


class Page:
    """What the page shows of the only object of a scene, by the texture files that it asks for."""

    def __init__(self, stage):
        path = Path(stage.GetRootLayer().realPath)
        self.scene = read_scene(open_stage(path), path)
        (self.shape,) = self.scene.shapes
        (self.piece,) = self.shape.pieces
        self.surface = self.scene.surfaces[self.scene.palettes[0][self.piece.slot]]
        with ViewerServer() as server:
            server.show(self.scene)
            answers = [server.answer(f"/textures/{number}") for number in range(len(self.scene.textures))]
        self.pictures = []
        for kind, data in answers:
            assert kind in {"image/png", "image/jpeg"}
            with Image.open(io.BytesIO(data)) as picture:
                self.pictures.append(np.array(picture.convert("RGBA"), dtype=float) / 255)

    def _texel(self, number, place):
        points = self.piece.mesh.positions_m
        rows = np.column_stack([points[:, :2], np.ones(len(points))])
        u, v = np.array([*place, 1.0]) @ np.linalg.lstsq(rows, self.piece.coordinates, rcond=None)[0]
        rows, columns = self.pictures[number].shape[:2]
        return self.pictures[number][int((1 - v % 1) % 1 * rows), int(u % 1 * columns)]

    def values(self, place):
        surface, found = self.surface, {}
        colour, opacity = np.array(surface.colour_rgb), surface.opacity
        if surface.colour_texture >= 0:
            texel = self._texel(surface.colour_texture, place)
            colour = colour * linear(texel[:3])
            opacity *= texel[3] if surface.has_alpha else 1
        found["diffuseColor"], found["opacity"] = colour, np.array([opacity])
        if surface.roughness_texture >= 0 and not surface.has_alpha:
            texel = self._texel(surface.roughness_texture, place)
            found["roughness"] = np.array([texel[surface.roughness_channel]])
        return found


@pytest.mark.parametrize("about", MATERIALS)
def test_the_page_shows_what_the_specification_says(about, tmp_path):
    stage = material_stage(tmp_path, MATERIALS[about])
    page, material = Page(stage), UsdShade.Material(stage.GetPrimAtPath("/W/M"))
    if about in NAMED:
        (line,) = page.scene.remarks
        assert line.startswith(NAMED[about])
    else:
        assert page.scene.remarks == []
    if about in {CLAMPED, "two sets of coordinates"}:
        return
    mesh = stage.GetPrimAtPath("/W/Square")
    corners = {name: np.array(mesh.GetAttribute(f"primvars:{name}").Get()) for name in ("st", "UVMap", "wide")}
    off = compared = 0
    for x, y in np.random.default_rng(1).uniform(0.02, 0.98, (40, 2)):
        shares = np.array([(1 - x) * (1 - y), x * (1 - y), x * y, (1 - x) * y])
        primvars = {name: shares @ own for name, own in corners.items()} | {"shine": 0.25}
        for name, value in page.values((x, y)).items():
            wanted = np.clip(value_at(material, name, primvars), 0, 1)
            off += bool(np.abs(wanted - value).max() > TOLERANCE)
            compared += 1
    assert off <= 0.02 * compared  # a place within rounding of another pixel
