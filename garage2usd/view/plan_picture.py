"""The plan from above as a PNG: every square by its kind, every stall, column and parked car, and a legend."""

from collections.abc import Callable, Sequence

from PIL import Image, ImageDraw, ImageFont

from garage2usd.grid import Cell, Structure
from garage2usd.layout import Layout, ObjectKind, Placement
from garage2usd.layout.specs import ColumnSpec

__all__ = ["draw_plan"]

_MAX_SIDE_PX = 2400
_MAX_PX_PER_M = 20.0
_MARGIN_PX = 24
_LEGEND_PX = 64
_INK = (32, 34, 38)
_PAPER = (250, 249, 246)
_CELL_COLOUR = {
    Cell.OBSTACLE: (120, 112, 108),
    Cell.FREE: (226, 224, 216),
    Cell.LANE: (148, 156, 166),
    Cell.ENTRANCE: (72, 160, 96),
    Cell.EXIT: (206, 84, 72),
}
_STALL_COLOUR = (176, 204, 228)
_OCCUPIED_COLOUR = (58, 92, 140)
_Pixel = Callable[[float, float], tuple[float, float]]


def draw_plan(layout: Layout) -> Image.Image:
    """Draw a layout from above, +X to the right and +Z down.

    Returns
    -------
    PIL.Image.Image
        RGB, at most 2400 pixels wide or high beside legend and margins; outside squares are paper white.
    """
    structure = layout.structure
    width_m, depth_m = float(structure.column_edges_m[-1]), float(structure.row_edges_m[-1])
    scale = min(_MAX_PX_PER_M, _MAX_SIDE_PX / max(width_m, depth_m))
    size = (
        max(round(width_m * scale) + 2 * _MARGIN_PX, 720),
        round(depth_m * scale) + 2 * _MARGIN_PX + _LEGEND_PX,
    )
    image = Image.new("RGB", size, _PAPER)
    draw = ImageDraw.Draw(image)

    def pixel(x: float, z: float) -> tuple[float, float]:
        return _MARGIN_PX + x * scale, _MARGIN_PX + z * scale

    _draw_squares(draw, structure, layout, pixel)
    occupied = {(place.square, place.name) for place in layout.of_kind(ObjectKind.CAR)}
    for stall in layout.stalls:
        corners = [pixel(x, z) for x, z in stall.corners_m()]
        colour = _OCCUPIED_COLOUR if (stall.square, stall.named("Car")) in occupied else _STALL_COLOUR
        draw.polygon(corners, fill=colour)
        draw.line([corners[0], corners[3], corners[2], corners[1]], fill=_PAPER, width=max(1, round(scale * 0.12)))
    _draw_columns(draw, layout.of_kind(ObjectKind.COLUMN), pixel)
    _draw_legend(draw, image.height - _LEGEND_PX, layout)
    return image


def _draw_squares(draw: ImageDraw.ImageDraw, structure: Structure, layout: Layout, pixel: _Pixel) -> None:
    obstacles = {place.name for place in layout.of_kind(ObjectKind.OBSTACLE)}
    x, z = structure.column_edges_m.tolist(), structure.row_edges_m.tolist()
    rows, cols = structure.shape
    for row in range(rows):
        for col in range(cols):
            cell = Cell(structure.cells[row, col])
            if cell is Cell.OBSTACLE and f"Obstacle_r{row:02d}_c{col:02d}" not in obstacles:
                continue
            box = [pixel(x[col], z[row]), pixel(x[col + 1], z[row + 1])]
            draw.rectangle(box, fill=_CELL_COLOUR[cell], outline=(200, 198, 190))


def _draw_columns(draw: ImageDraw.ImageDraw, columns: Sequence[Placement], pixel: _Pixel) -> None:
    for place in columns:
        if isinstance(place.spec, ColumnSpec):
            x, _, z = place.position_m
            half = place.spec.size_m / 2
            draw.rectangle([pixel(x - half, z - half), pixel(x + half, z + half)], fill=_INK)


def _draw_legend(draw: ImageDraw.ImageDraw, top: int, layout: Layout) -> None:
    font = ImageFont.load_default(size=15)
    entries = [
        (_CELL_COLOUR[Cell.LANE], "lane"),
        (_CELL_COLOUR[Cell.ENTRANCE], "entrance"),
        (_CELL_COLOUR[Cell.EXIT], "exit"),
        (_STALL_COLOUR, "stall"),
        (_OCCUPIED_COLOUR, "stall with a car"),
        (_CELL_COLOUR[Cell.FREE], "free"),
        (_CELL_COLOUR[Cell.OBSTACLE], "obstacle"),
        (_INK, "column"),
    ]
    x = float(_MARGIN_PX)
    for colour, text in entries:
        draw.rectangle([x, top + 4, x + 14, top + 18], fill=colour, outline=_INK)
        draw.text((x + 20, top + 2), text, fill=_INK, font=font)
        x += 20 + draw.textlength(text, font=font) + 18
    rows, cols = layout.structure.shape
    summary = f"{rows} x {cols} squares, {len(layout.stalls)} stalls"
    draw.text((_MARGIN_PX, top + 28), summary, fill=_INK, font=font)
