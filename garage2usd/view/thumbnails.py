"""Pictures of a garage by a build: the plan of each level, the learning curve, structures side by side, thumbnails."""

from collections.abc import Collection, Iterator, Sequence
from itertools import groupby

import numpy as np
from numpy.typing import NDArray
from PIL import Image, ImageDraw, ImageFont

from garage2usd.common.errors import ConfigError
from garage2usd.config.site import DEFAULT_SIDE_M
from garage2usd.garage import LaneKind, StallUse
from garage2usd.garage_model import Garage, GarageLevel
from garage2usd.objects.kind import rectangle
from garage2usd.planning import measured_circulation
from garage2usd.structure.grid import Cell, CellArray, Structure, edge_neighbour_count, outside_squares
from garage2usd.view.drawing import Colour, Drawing, Line, Point, Region, Text, to_image
from garage2usd.view.plan_lanes import DEAD_END, FREE, LANDING, LANE_COLOUR
from garage2usd.view.plan_picture import SOLID, STALL_COLOUR, draw_plan
from garage2usd.view.plan_sheet import PAPER

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
THUMBNAIL_COLOURS: dict[str, Colour] = {
    "stalls": STALL_COLOUR[StallUse.STANDARD],
    "lane": LANE_COLOUR[LaneKind.STRAIGHT],
    "dead_end": DEAD_END,
    "entrance": LANE_COLOUR[LaneKind.ENTRANCE],
    "exit": LANE_COLOUR[LaneKind.EXIT],
    "landing": LANDING,
    "free": FREE,
    "obstacle": SOLID,
}
"""Colours of a thumbnail's squares by kind, as in the plan picture."""
_LETTERS = {Cell.ENTRANCE: "E", Cell.EXIT: "X"}
_LETTER: Colour = (255, 255, 255)
_SEAM, _LETTER_HEIGHT = 0.06, 0.8
_PX_PER_SQUARE = 16


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


def draw_thumbnail(cells: CellArray, title: str, landings: Collection[tuple[int, int]] = ()) -> Drawing:
    """Draw the squares of a plan with sides of one metre, whatever their actual sides.

    Parameters
    ----------
    cells
        S, int8, shape (rows, cols).
    title
        Title of the drawing.
    landings
        (row, col) of the portals that lead to ramps between levels.

    Notes
    -----
    Free squares beside a lane, which hold stalls, and lanes in dead ends have separate colours. Squares outside the
    garage are left blank.
    """
    rows, cols = cells.shape
    return Drawing(
        (0.0, 0.0), (float(cols), float(rows)), _PX_PER_SQUARE, PAPER, title, list(_elements(cells, landings))
    )


def _elements(cells: CellArray, landings: Collection[tuple[int, int]]) -> Iterator[Region | Line | Text]:
    kinds = _kinds(cells)
    for row, col in landings:
        kinds[row][col] = "landing"
    for row, line in enumerate(kinds):
        for kind, run in groupby(range(len(line)), key=line.__getitem__):
            if kind:
                squares = list(run)
                box = rectangle(squares[0], row, squares[-1] + 1, row + 1)
                yield Region(box, THUMBNAIL_COLOURS[kind], kind)
    rows, cols = cells.shape
    yield Line(_comb(rows, cols), PAPER, _SEAM, "seam")
    yield Line([(x, y) for y, x in _comb(cols, rows)], PAPER, _SEAM, "seam")
    for cell, letter in _LETTERS.items():
        for row, col in np.argwhere(cells == cell).tolist():
            if (row, col) in landings:
                continue
            yield Text((col + 0.5, row + 0.5), letter, _LETTER_HEIGHT, _LETTER, kind="letter")


def _kinds(cells: CellArray) -> list[list[str]]:
    """Kind of each square; empty outside the garage."""
    side_mm = round(1000 * DEFAULT_SIDE_M)
    structure = Structure(cells, np.full(cells.shape[1], side_mm), np.full(cells.shape[0], side_mm))
    is_dead_end = measured_circulation(structure).circulation.rounds > 0
    is_beside = edge_neighbour_count(cells == Cell.LANE) > 0
    kinds = np.select(
        [
            outside_squares(cells),
            cells == Cell.OBSTACLE,
            cells == Cell.ENTRANCE,
            cells == Cell.EXIT,
            (cells == Cell.LANE) & is_dead_end,
            cells == Cell.LANE,
            is_beside,
        ],
        ["", "obstacle", "entrance", "exit", "dead_end", "lane", "stalls"],
        "free",
    )
    found: list[list[str]] = kinds.tolist()
    return found


def _comb(rows: int, cols: int) -> list[Point]:
    """A single polyline along all borders of rows, back and forth."""
    ends = (0.0, float(cols))
    return [(ends[(row + end) % 2], float(row)) for row in range(rows + 1) for end in (0, 1)]


def draw_pictures(
    garage: Garage, *, learning_curve: bool = False, best_plans: int = 0, joint: str = "_"
) -> dict[str, Image.Image]:
    """Draw the plans of a garage and, if requested, the learning curve and the best plans of each level.

    Parameters
    ----------
    garage
        The garage.
    learning_curve, best_plans
        As for `garage2usd.build`.
    joint
        Separator between the name of a level and that of its picture.

    Returns
    -------
    dict
        The pictures by name: ``plan``, ``learning`` and ``best``; among several levels ``U1_plan`` and so on.

    Raises
    ------
    ConfigError
        If pictures of learning are requested for plans that are not learnt.
    """
    for field, asked in (("learning_curve", learning_curve), ("best_plans", best_plans)):
        if asked and not all(level.plan.archive for level in garage.levels):
            raise ConfigError(field, asked, "only where lanes are learnt, not with a tape or lanes that are given")
    return {
        level.place.in_whole(name, joint=joint): picture
        for level in garage.levels
        for name, picture in _pictures(level, learning_curve=learning_curve, best_plans=best_plans).items()
    }


def _pictures(level: GarageLevel, *, learning_curve: bool, best_plans: int) -> dict[str, Image.Image]:
    pictures = {"plan": to_image(draw_plan(level.layout))}
    if learning_curve:
        pictures["learning"] = draw_learning_curve(level.plan.learning_curve)
    if best_plans:
        pictures["best"] = draw_structures(
            [
                (entry.structure, f"{entry.score.value:.2f} {'polished' if entry.is_polished else 'learnt'}")
                for entry in level.plan.archive[:best_plans]
            ]
        )
    return pictures
