"""Sheet around a plan: dimension chains, numbers of rows and columns, legend, list of findings."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import pairwise

from garage2usd.layout import Layout
from garage2usd.structure.grid import Structure
from garage2usd.view.drawing import Colour, Disc, Line, Point, Region, Text, text_width

INK: Colour = (32, 34, 38)
GREY: Colour = (132, 132, 128)
PAPER: Colour = (250, 249, 246)
MARK_COLOUR: dict[str, Colour] = {"error": (200, 40, 36), "warning": (214, 130, 20), "info": (40, 104, 190)}
_MAX_SIDE_PX = 4000
_MAX_PX_PER_M = 20.0
_LEAST_WIDTH_PX = 900
ARROW_END_M = 3.6
"""Distance in metres from a wall to the end of the arrows at its doors."""
_DIMENSION_GAP = 2.2
_LETTERS_PX, _LETTERS_SHARE = 15, 1 / 140
_TITLE, _TITLE_ROOM, _RAMP_GAP = 1.4, 2.4, 1.6
_SCALE_BAR_M = 10.0
_MOST_LISTED = 60


@dataclass(frozen=True)
class Mark:
    """A finding and its place on the plan.

    Attributes
    ----------
    x_m, z_m
        Position in metres.
    severity
        ``error``, ``warning`` or ``info``.
    text
        The finding in one line.
    """

    x_m: float
    z_m: float
    severity: str
    text: str


class Sheet:
    """Layout of the sheet around a plan.

    Attributes
    ----------
    px_per_m
        Pixels per metre: at most 20, and at most 4000 pixels for the plan's longer side.
    letters_m
        Height of letters.
    low, high
        Corners (x, z) of the sheet; the plan begins at (0, 0).
    ramp_m
        Visible length of a ramp from the inner side of its wall.
    """

    def __init__(self, structure: Structure, marks: Sequence[Mark], legend: Sequence[tuple[Colour, str]]) -> None:
        self._structure, self._marks, self._legend = structure, marks, legend
        self._width_m, self._depth_m = float(structure.column_edges_m[-1]), float(structure.row_edges_m[-1])
        side_m = max(self._width_m, self._depth_m)
        self.px_per_m = min(_MAX_PX_PER_M, _MAX_SIDE_PX / side_m)
        self.letters_m = max(_LETTERS_PX / self.px_per_m, side_m * _LETTERS_SHARE)
        self._zone_m = ARROW_END_M + text_width("OUT", self.letters_m) + _RAMP_GAP * self.letters_m
        margin = self._zone_m + 2 * _DIMENSION_GAP * self.letters_m
        self.ramp_m = self._zone_m - _RAMP_GAP * self.letters_m
        self.low = (-margin, -margin - _TITLE_ROOM * self.letters_m)
        right = max(self._width_m + self._zone_m + self.letters_m, _LEAST_WIDTH_PX / self.px_per_m - margin)
        self._foot_m = self._depth_m + self._zone_m + self.letters_m
        self._places = self._legend_places(right)
        lines = (
            self._places[-1][1] - self._foot_m + self.letters_m * (2.5 + 1.6 * (1 + min(len(marks), _MOST_LISTED + 1)))
        )
        self.high = (right, self._foot_m + lines)

    def title(self, words: str) -> Text:
        """Draw the title above everything else, enlarged if there is space."""
        letters = _TITLE * self.letters_m
        room = self.high[0] - self.low[0] - 2 * self.letters_m
        height = letters * min(1.0, room / text_width(words, letters))
        at = self.low[0] + self.letters_m, self.low[1] + self.letters_m + letters / 2
        return Text(at, words, height, INK, is_left=True, kind="title")

    def dimensions(self) -> Iterator[Line | Text]:
        """Draw dimension chains of R above and of C to the left, with totals, and the numbers of columns and rows."""
        letters = self.letters_m
        for edges, is_row in ((self._structure.column_edges_m, False), (self._structure.row_edges_m, True)):
            edges_m = edges.tolist()
            for level, chain in ((1, edges_m), (2, [edges_m[0], edges_m[-1]])):
                yield from self._chain(chain, self._zone_m + (level - 1) * _DIMENSION_GAP * letters, is_row=is_row)
            beyond = (self._width_m if is_row else self._depth_m) + self._zone_m
            for number, (start, end) in enumerate(pairwise(edges_m)):
                at = _swapped(((start + end) / 2, beyond), is_row)
                yield Text(at, str(number), letters, GREY, kind="row" if is_row else "column")

    def _chain(self, edges_m: Sequence[float], away_m: float, *, is_row: bool) -> Iterator[Line | Text]:
        thin = 1.2 / self.px_per_m
        tick = self.letters_m / 3
        yield Line([_swapped((along, -away_m), is_row) for along in (edges_m[0], edges_m[-1])], INK, thin, "dimension")
        for along in edges_m:
            ends = [(along - tick, -away_m + tick), (along + tick, -away_m - tick)]
            yield Line([_swapped(end, is_row) for end in ends], INK, 2 * thin, "dimension")
        for start, end in pairwise(edges_m):
            text = f"{end - start:.2f}"
            letters = min(self.letters_m, 0.9 * self.letters_m * (end - start) / text_width(text, self.letters_m))
            at = _swapped(((start + end) / 2, -away_m - 0.75 * self.letters_m), is_row)
            yield Text(at, text, letters, INK, is_turned=is_row, kind="dimension")

    def legend(self, layout: Layout) -> Iterator[Region | Line | Text]:
        """Draw the legend of colours, a scale bar of ten metres, and the garage's key figures."""
        letters = self.letters_m
        for (colour, text), (x, z) in zip(self._legend, self._places, strict=True):
            half = letters / 2
            box = [(x, z - half), (x + letters, z - half), (x + letters, z + half), (x, z + half)]
            yield Region(box, colour, "legend")
            yield Line([*box, box[0]], INK, 1 / self.px_per_m, "legend")
            yield Text((x + 1.5 * letters, z), text, letters, INK, is_left=True, kind="legend")
        z = self._places[-1][1] + 2 * letters
        rows, cols = self._structure.shape
        size = f"{self._width_m:.2f} x {self._depth_m:.2f} m"
        if layout.matrices is not None:
            size = f"{rows} x {cols} squares, {size}"
        words = f"{size}, {layout.parking_stalls} stalls ({layout.uses_in_words()})"
        tick = letters / 3
        bar = [(0.0, z - tick), (0.0, z), (_SCALE_BAR_M, z), (_SCALE_BAR_M, z - tick)]
        yield Line(bar, INK, 2 / self.px_per_m, "scale")
        yield Text((_SCALE_BAR_M + letters / 2, z), "10 m", letters, INK, is_left=True, kind="scale")
        yield Text((_SCALE_BAR_M + 5 * letters, z), words, letters, INK, is_left=True, kind="summary")

    def marks(self) -> Iterator[Disc | Text]:
        """Draw findings as numbered discs at their places, and list them."""
        radius = 0.8 * self.letters_m
        for number, mark in enumerate(self._marks, 1):
            yield from self._disc((mark.x_m, mark.z_m), radius, mark, number)
        z = self._places[-1][1] + 4 * self.letters_m
        for number, mark in enumerate(self._marks[:_MOST_LISTED], 1):
            yield from self._disc((0.8 * self.letters_m, z), 0.7 * self.letters_m, mark, number)
            text = self._fitted(f"{mark.severity}: {mark.text}")
            yield Text((2.2 * self.letters_m, z), text, self.letters_m, INK, is_left=True, kind="finding")
            z += 1.6 * self.letters_m
        if len(self._marks) > _MOST_LISTED:
            more = f"and {len(self._marks) - _MOST_LISTED} more"
            yield Text((2.2 * self.letters_m, z), more, self.letters_m, INK, is_left=True, kind="finding")

    def _disc(self, at: Point, radius_m: float, mark: Mark, number: int) -> Iterator[Disc | Text]:
        colour = MARK_COLOUR.get(mark.severity, MARK_COLOUR["info"])
        yield Disc(at, radius_m, colour, PAPER, 1.5 / self.px_per_m, f"mark {mark.severity}")
        yield Text(at, str(number), 0.9 * radius_m, PAPER, kind="mark")

    def _fitted(self, text: str) -> str:
        room = self.high[0] - 3 * self.letters_m
        if text_width(text, self.letters_m) <= room:
            return text
        while text and text_width(f"{text}...", self.letters_m) > room:
            text = text[:-1]
        return f"{text}..."

    def _legend_places(self, right_m: float) -> list[Point]:
        """Positions of the legend's entries, in as many lines as necessary."""
        places: list[Point] = []
        x, z = 0.0, self._foot_m + 1.5 * self.letters_m
        for _, text in self._legend:
            width = 3 * self.letters_m + text_width(text, self.letters_m)
            if x > 0 and x + width > right_m:
                x, z = 0.0, z + 1.8 * self.letters_m
            places.append((x, z))
            x += width
        return places


def _swapped(point: Point, swap: bool) -> Point:  # noqa: FBT001 - which axis it lies along
    return (point[1], point[0]) if swap else point
