"""Pictures of the planner's learning as PNG: the return by episode, and the best plans side by side."""

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray
from PIL import Image, ImageDraw, ImageFont

from garage2usd.structure.grid import Cell, Structure

__all__ = ["draw_learning_curve", "draw_structures"]

_INK, _GRID, _PAPER = (32, 34, 38), (216, 214, 206), (250, 249, 246)
_POINT, _MEAN = (170, 190, 214), (176, 52, 40)
_SIZE_PX, _LEFT_PX, _RIGHT_PX, _TOP_PX, _BOTTOM_PX = (960, 540), 72, 24, 40, 48
_RUNNING_SHARE = 50
_TICKS = 5
_CELL_PX, _GAP_PX, _TITLE_PX, _PLANS_A_ROW = 16, 20, 24, 4
_CELL_COLOUR = {
    Cell.OBSTACLE: (120, 112, 108),
    Cell.FREE: (176, 204, 228),
    Cell.LANE: (148, 156, 166),
    Cell.ENTRANCE: (72, 160, 96),
    Cell.EXIT: (206, 84, 72),
}


def draw_learning_curve(learning_curve: NDArray[np.float64]) -> Image.Image:
    """Draw G by episode with its running mean over a fiftieth of the episodes.

    Parameters
    ----------
    learning_curve
        float64, shape (episodes,), at least one episode.

    Returns
    -------
    PIL.Image.Image
        RGB, 960 x 540.
    """
    image = Image.new("RGB", _SIZE_PX, _PAPER)
    draw = ImageDraw.Draw(image)
    font = ImageFont.load_default(size=14)
    episodes = len(learning_curve)
    window = max(1, episodes // _RUNNING_SHARE)
    mean = np.convolve(learning_curve, np.ones(window) / window, mode="valid")
    low, high = float(learning_curve.min()), float(learning_curve.max())
    span = max(high - low, 1e-9)
    width, height = _SIZE_PX[0] - _LEFT_PX - _RIGHT_PX, _SIZE_PX[1] - _TOP_PX - _BOTTOM_PX

    def pixel(episode: float, value: float) -> tuple[float, float]:
        return _LEFT_PX + episode / max(episodes - 1, 1) * width, _TOP_PX + (high - value) / span * height

    for tick in range(_TICKS + 1):
        value, episode = low + span * tick / _TICKS, round((episodes - 1) * tick / _TICKS)
        _, y = pixel(0, value)
        x, _ = pixel(episode, low)
        draw.line([(_LEFT_PX, y), (_LEFT_PX + width, y)], fill=_GRID)
        draw.text((_LEFT_PX - 8, y), f"{value:.0f}", fill=_INK, font=font, anchor="rm")
        draw.text((x, _TOP_PX + height + 8), str(episode + 1), fill=_INK, font=font, anchor="ma")
    draw.point([pixel(episode, value) for episode, value in enumerate(learning_curve.tolist())], fill=_POINT)
    draw.line([pixel(i + (window - 1) / 2, value) for i, value in enumerate(mean.tolist())], fill=_MEAN, width=2)
    title = f"Learning, before polish: G by episode, mean of {window}"
    draw.text((_LEFT_PX, 12), title, fill=_INK, font=font)
    return image


def draw_structures(plans: Sequence[tuple[Structure, str]]) -> Image.Image:
    """Draw structures side by side in rows of four, each with its rank and a caption.

    Parameters
    ----------
    plans
        At least one (structure, caption), best first; all of one shape.
    """
    rows, cols = plans[0][0].shape
    width, height = cols * _CELL_PX, rows * _CELL_PX + _TITLE_PX
    across = min(len(plans), _PLANS_A_ROW)
    down = -(-len(plans) // across)
    size = across * (width + _GAP_PX) + _GAP_PX, down * (height + _GAP_PX) + _GAP_PX
    image = Image.new("RGB", size, _PAPER)
    draw = ImageDraw.Draw(image)
    font = ImageFont.load_default(size=14)
    for index, (structure, words) in enumerate(plans):
        left = _GAP_PX + index % across * (width + _GAP_PX)
        top = _GAP_PX + index // across * (height + _GAP_PX)
        draw.text((left, top), f"{index + 1}: {words}", fill=_INK, font=font)
        for (row, col), value in np.ndenumerate(structure.cells):
            x, y = left + col * _CELL_PX, top + _TITLE_PX + row * _CELL_PX
            box = [x, y, x + _CELL_PX - 1, y + _CELL_PX - 1]
            draw.rectangle(box, fill=_CELL_COLOUR[Cell(int(value))], outline=_PAPER)
    return image
