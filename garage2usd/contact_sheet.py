"""Contact sheets: a grid of rendered pictures of many garages, each level from inside and from above."""

import hashlib
import json
from collections.abc import Sequence
from functools import partial
from pathlib import Path
from typing import NamedTuple

import numpy as np
from PIL import Image, ImageDraw, ImageFont

from garage2usd.common.errors import ConfigError, GenerationError, UnreachableStallError
from garage2usd.common.output import check_file, publish_at, staging_folder, unfinished_folder
from garage2usd.common.package import VERSION, require
from garage2usd.common.progress import Announce, Progress, silent, unheard
from garage2usd.config import GarageConfig
from garage2usd.config.look import look_in_words
from garage2usd.config.outputs import AssetPlace, StageForm, TextureQuality
from garage2usd.layout import Layout
from garage2usd.pipeline import generate
from garage2usd.planning import Plan
from garage2usd.render import Device, Picture, render_stage
from garage2usd.render.blender_process import WITHOUT_MODULE, find_blender
from garage2usd.render.devices import CPU, find_device, modules_for
from garage2usd.stage import stages_of_levels, write_stage
from garage2usd.stage.cameras import APERTURE_MM, FOCAL_MM

_CAMERA = "Inside"
_LEAN = 0.25
"""Horizontal offset of the upper camera from the centre of the level, as a share of its height."""
_ROOM = 1.12
"""Margin factor around the floor in the picture from above."""
_HALF_WIDTH = APERTURE_MM[0] / FOCAL_MM / 2
"""Half width of the cameras' field of view at a distance of 1."""
_BRIGHT = 200
SHEET_SUFFIXES = (".png", ".jpg", ".jpeg")
_JPEG_QUALITY = 85
_PAPER, _INK, _QUIET = (24, 25, 27), (230, 230, 230), (150, 152, 155)
_LETTERS_PX, _SMALL_PX, _GAP_PX = 15, 11, 8
_CAPTION_PX = _LETTERS_PX + _SMALL_PX + 12
_MOST_PX = 30_000
"""Greatest side of a sheet in pixels."""


class SheetGarage(NamedTuple):
    """A garage on a contact sheet.

    Attributes
    ----------
    name
        Name in the caption.
    config
        Settings of the garage.
    plan
        Plan of a garage of one level, made from these settings.
    tape
        Tape of a garage made from these settings. Without a plan and a tape the garage is planned.
    """

    name: str
    config: GarageConfig
    plan: Plan | None = None
    tape: str | None = None


class _Level(NamedTuple):
    """A level on a contact sheet.

    Attributes
    ----------
    caption
        Name of the garage, and of the level among several.
    layout
        Objects of the level, with its floor at 0.
    stage
        Stage of the level alone, with its floor at 0.
    """

    caption: str
    layout: Layout
    stage: Path


def draw_contact_sheet(
    garages: Sequence[SheetGarage],
    output: Path,
    *,
    size_px: tuple[int, int] = (320, 180),
    samples: int = 4,
    columns: int = 3,
    device: Device = Device.AUTO,
    progress: Progress = silent,
    announce: Announce = unheard,
) -> Path:
    """Render each level of each garage from its entrance and from above, with a caption.

    Parameters
    ----------
    garages
        The garages, in reading order.
    output
        The picture, PNG or JPEG by its extension. An interrupted call keeps finished garages in
        ``<output>.unfinished``, and the next equal call resumes.
    size_px
        Width and height of each of the two pictures of a level.
    samples
        Samples per pixel.
    columns
        Number of levels per row.
    device
        Rendering device.
    progress
        Called with the number of finished garages.
    announce
        Called with the garages that are left out, as their settings are infeasible.

    Raises
    ------
    ConfigError
        If the name or a size is invalid.
    GenerationError, UnreachableStallError
        If all garages are infeasible.
    MissingExtraError
        If Blender is not installed.
    OutputError, RenderError
        As `garage2usd.render.render_stage`.
    """
    count = sum(garage.config.building.levels for garage in garages)
    columns = min(columns, count)
    if output.suffix.lower() not in SHEET_SUFFIXES:
        raise ConfigError("contact-sheet", str(output), f"a file that ends in {', '.join(SHEET_SUFFIXES)}")
    rows = -(-count // max(columns, 1))
    if not garages or max(_sheet_size(columns, rows, size_px)) > _MOST_PX:
        raise ConfigError("contact-sheet", f"{len(garages)} garages", f"some, on at most {_MOST_PX} pixels a side")
    require("render", modules_for(device, find_blender()), without=WITHOUT_MODULE)
    check_file(output)
    if find_device(device, has_rays=False, blender=find_blender()).kind == CPU.kind:
        device = Device.CPU  # ask Blender once for all pictures
    with unfinished_folder(output, _key(garages, size_px, samples, device)) as work:
        cells: list[Path] = []
        for number, garage in enumerate(garages):
            progress("garages", number, len(garages))
            own = [work / f"{number:05}_{level}.png" for level in range(garage.config.building.levels)]
            try:
                if not all(cell.exists() for cell in own):
                    _draw(garage, own, size_px, samples, device)
                cells += own
            except (ConfigError, GenerationError, UnreachableStallError) as error:
                refused = error
                announce(f"without {garage.name}: {error}")
        progress("garages", len(garages), len(garages))
        if not cells:
            raise refused
        sheet = work / f"sheet{output.suffix.lower()}"
        _sheet(cells, columns, size_px).save(sheet, quality=_JPEG_QUALITY)
        publish_at({sheet: output})
    return output


def _key(garages: Sequence[SheetGarage], size_px: tuple[int, int], samples: int, device: Device) -> str:
    """Return the key that identifies unfinished work."""
    told = [VERSION, size_px, samples, device, [(garage.name, garage.config.digest()) for garage in garages]]
    return hashlib.sha256(json.dumps(told).encode()).hexdigest()


def _draw(garage: SheetGarage, cells: Sequence[Path], size_px: tuple[int, int], samples: int, device: Device) -> None:
    """Draw the two pictures of each level of a garage with their caption."""
    with staging_folder() as folder:
        stage, levels = _written(garage, folder)
        render = partial(_rendered, size_px=size_px, samples=samples, device=device)
        if len(levels) == 1:  # both pictures at once
            pairs = [render(stage, folder / "both", cameras=(_CAMERA,), over=levels[0].layout)]
        else:
            insides = render(stage, folder / "inside", cameras=(_CAMERA,))
            aboves = [render(level.stage, folder / level.stage.stem, over=level.layout)[0] for level in levels]
            pairs = [[inside, above] for inside, above in zip(insides, aboves, strict=True)]
    captioned = [_captioned(level, *pair) for level, pair in zip(levels, pairs, strict=True)]
    for cell, picture in zip(cells, captioned, strict=True):
        half = cell.with_suffix(".part")
        picture.save(half, format="PNG")
        half.replace(cell)


def _written(garage: SheetGarage, folder: Path) -> tuple[Path, list[_Level]]:
    """Make a garage and write its stage; return the stage and the garage's levels, the top one first."""
    place = folder / "stage"
    place.mkdir()
    stage = place / "garage.usdc"
    # small pictures show no finer textures, and a flat stage of several levels has no stage of each level
    plain = {"assets": AssetPlace.OWN, "texture_quality": TextureQuality.LOW, "form": StageForm.AUTO}
    made = generate(garage.config, plan=garage.plan, tape=garage.tape)
    write_stage(made, stage, config=garage.config.stage.model_copy(update=plain))
    return stage, [
        _Level(level.place.after(garage.name, joint=" "), level.layout, own)
        for level, own in zip(made.levels, stages_of_levels(made, stage), strict=True)
    ]


def _rendered(
    stage: Path,
    folder: Path,
    *,
    cameras: Sequence[str] = (),
    over: Layout | None = None,
    size_px: tuple[int, int],
    samples: int,
    device: Device,
) -> list[Image.Image]:
    """Render the cameras of some name in the order of the stage, then one over the whole floor of a layout."""
    at_m, look_at_m = (None, None) if over is None else _over(over, size_px)
    drawn = render_stage(
        stage,
        folder,
        cameras=cameras,
        at_m=at_m,
        look_at_m=look_at_m,
        size_px=size_px,
        samples=samples,
        pictures=(Picture.COLOUR,),
        device=device,
    )
    pictures = []
    for name in drawn.names:
        with Image.open(drawn.folder / Picture.COLOUR / f"{name}.png") as picture:
            pictures.append(picture.convert("RGB"))
    return pictures


def _captioned(level: _Level, inside: Image.Image, above: Image.Image) -> Image.Image:
    """Draw a cell: the two pictures of a level with its name and its look."""
    width, height = inside.size
    picture = Image.new("RGB", _cell_size(inside.size), _PAPER)
    picture.paste(inside, (0, 0))
    picture.paste(_exposed(above), (width, 0))
    draw = ImageDraw.Draw(picture)
    draw.text((2, height + 3), level.caption, _INK, ImageFont.load_default(size=_LETTERS_PX))
    words = look_in_words(level.layout.look)
    draw.text((2, height + 6 + _LETTERS_PX), words, _QUIET, ImageFont.load_default(size=_SMALL_PX))
    return picture


def _over(layout: Layout, size_px: tuple[int, int]) -> tuple[tuple[float, float, float], tuple[float, float, float]]:
    """Position of a camera that sees the whole floor, and the centre of the floor."""
    structure, height_m = layout.structure, layout.ceiling_height_m
    width_m, depth_m = structure.column_widths_mm.sum() / 1000, structure.row_depths_mm.sum() / 1000
    half_height = _HALF_WIDTH * size_px[1] / size_px[0]
    far_m = _ROOM * max(width_m / 2 / _HALF_WIDTH, depth_m / 2 / half_height) + height_m
    x, z = float(width_m / 2), float(depth_m / 2)
    return (x, float(far_m), z + _LEAN * float(far_m)), (x, 0.0, z)


def _exposed(picture: Image.Image) -> Image.Image:
    """Expose a picture from above for its brightest tenth, as nothing above the floor reflects light."""
    bright = np.asarray(picture.convert("L"))
    lit = bright[bright > 0]
    gain = _BRIGHT / max(float(np.percentile(lit, 90)) if lit.size else _BRIGHT, 1.0)
    return picture.point([min(255, round(value * max(gain, 1.0))) for value in range(256)] * 3)


def _cell_size(size_px: tuple[int, int]) -> tuple[int, int]:
    return 2 * size_px[0], size_px[1] + _CAPTION_PX


def _sheet_size(columns: int, rows: int, size_px: tuple[int, int]) -> tuple[int, int]:
    width, height = _cell_size(size_px)
    return columns * (width + _GAP_PX) + _GAP_PX, rows * (height + _GAP_PX) + _GAP_PX


def _sheet(cells: Sequence[Path], columns: int, size_px: tuple[int, int]) -> Image.Image:
    """Join the cells of all levels, row by row."""
    width, height = _cell_size(size_px)
    sheet = Image.new("RGB", _sheet_size(columns, -(-len(cells) // columns), size_px), _PAPER)
    for number, cell in enumerate(cells):
        row, column = divmod(number, columns)
        with Image.open(cell) as picture:
            sheet.paste(picture, (_GAP_PX + column * (width + _GAP_PX), _GAP_PX + row * (height + _GAP_PX)))
    return sheet
