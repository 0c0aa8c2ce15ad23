"""Edits of a garage's configuration, as the page sends them: squares, sides, levels, runs of stalls, any setting."""
# Over 300 lines: one class for each kind of edit.

import itertools
from abc import abstractmethod
from collections.abc import Callable, Iterable, Iterator, Mapping
from functools import partial
from typing import Annotated, Any, Literal

import numpy as np
from pydantic import Field, TypeAdapter, ValidationError

from garage2usd.common.errors import ConfigError
from garage2usd.common.settings import config_error
from garage2usd.config import GarageConfig
from garage2usd.config.site import Side, SquareIndex
from garage2usd.config.stalls import GivenRun
from garage2usd.drafts.change import (
    ENTRANCE,
    EXIT,
    FREE,
    LANE,
    SIDES,
    STRUCTURE,
    Axis,
    Change,
    squares_of,
    stands,
    symbol_at,
)  # fmt: skip
from garage2usd.drafts.draft import Edit, told_edit
from garage2usd.drafts.toml_page import TomlPage
from garage2usd.structure.squares import pieces_of

Symbol = Literal["#", ".", "=", "E", "X"]
Symmetry = Literal["none", "left-right", "up-down", "both", "turned"]
_LEAST_SIDE, _MOST_SIDE = 3, 250
"""Rows or columns of a drawing. A larger garage is configured, and opens, but a page is not the place to paint it."""
_MirrorOf = Callable[[int, int], tuple[int, int]]


class GarageEdit(Edit[GarageConfig]):
    """An edit of a configuration."""

    @abstractmethod
    def apply(self, change: Change) -> None:
        """Change the configuration's document; raises `ConfigError` where the edit has no place in it."""

    def applied(self, text: str, config: GarageConfig) -> str:
        """Apply the edit to a configuration's text and return the new text.

        Raises
        ------
        ConfigError, GenerationError
            If the edit has no place in this configuration, or its squares are drawn and cannot be.
        """
        change = Change(TomlPage(text), config)
        self.apply(change)
        return change.page.text()


class Paint(GarageEdit):
    """Give squares a kind."""

    kind: Literal["paint"]
    symbol: Symbol
    """Kind of square, as in `site.structure`."""
    shape: Literal["squares", "rectangle", "flood"] = "squares"
    """'squares': those of `at`; 'rectangle': all between the first and the last of `at`; 'flood': those of one kind
    that hang together with the first of `at`."""
    at: tuple[SquareIndex, ...] = Field(min_length=1)
    """(row, col) of the squares; squares beyond the border are left out."""
    symmetry: Symmetry = "none"
    """Also squares mirrored 'left-right', 'up-down' or 'both', or 'turned' by half a circle."""

    def apply(self, change: Change) -> None:
        """Paint the squares and their images."""
        grid = change.grid()
        height, width = len(grid), len(grid[0])
        for mirror in _mirrors(self.symmetry, height, width):
            for row, col in self._squares(grid, mirror):
                if row < height and col < width:
                    grid[row][col] = self.symbol
        if self.symbol == LANE and change.config.building.levels > 1:
            wanted = "no lanes with building.levels of 2 or more: they are planned"
            raise ConfigError(STRUCTURE, LANE, wanted)
        change.put_grid(grid)

    def _squares(self, grid: list[list[str]], mirror: _MirrorOf) -> Iterator[tuple[int, int]]:
        if self.shape == "flood":
            row, col = self.at[0]
            if row < len(grid) and col < len(grid[0]):
                yield from _flood(grid, mirror(row, col))
        elif self.shape == "rectangle":
            (row, col), (last_row, last_col) = self.at[0], self.at[-1]
            for each in range(min(row, last_row), min(max(row, last_row) + 1, len(grid))):
                for every in range(min(col, last_col), min(max(col, last_col) + 1, len(grid[0]))):
                    yield mirror(each, every)
        else:
            yield from (mirror(row, col) for row, col in self.at if row < len(grid) and col < len(grid[0]))


def _mirrors(symmetry: Symmetry, height: int, width: int) -> list[_MirrorOf]:
    """Return the identity and the images of a symmetry, on squares."""
    flips: dict[str, tuple[tuple[bool, bool], ...]] = {
        "none": (),
        "left-right": ((False, True),),
        "up-down": ((True, False),),
        "both": ((False, True), (True, False), (True, True)),
        "turned": ((True, True),),
    }

    def image(row: int, col: int, *, down: bool, right: bool) -> tuple[int, int]:
        return (height - 1 - row if down else row, width - 1 - col if right else col)

    return [partial(image, down=down, right=right) for down, right in ((False, False), *flips[symmetry])]


def _flood(grid: list[list[str]], start: tuple[int, int]) -> Iterable[tuple[int, int]]:
    pieces, _ = pieces_of(np.array(grid) == symbol_at(grid, start))
    found: list[list[int]] = np.argwhere(pieces == pieces[start]).tolist()
    return [(row, col) for row, col in found]


class Sides(GarageEdit):
    """Give all rows their depths, or all columns their widths, or let them be chosen for the plan."""

    kind: Literal["sides"]
    axis: Axis
    metres: tuple[float, ...] | None
    """One for each row or column; none to let them be chosen, if `bay.dimensioned` says so."""

    def apply(self, change: Change) -> None:
        """Write the sides."""
        count = len(change.grid()) if self.axis == "rows" else len(change.grid()[0])
        if self.metres is not None and len(self.metres) != count:
            raise ConfigError(
                SIDES[self.axis][0], len(self.metres), f"{count} numbers, one for each of the {self.axis}"
            )
        change.put_sides(self.axis, None if self.metres is None else [round(side, 3) for side in self.metres])


class InsertLine(GarageEdit):
    """Insert a row or a column, a copy of the one after which it comes, with free squares for doors."""

    kind: Literal["insert"]
    axis: Axis
    after: int = Field(ge=0)
    """Number of the row or column."""

    def apply(self, change: Change) -> None:
        """Insert the line, and renumber what lies beyond it."""
        grid = _lines(change.grid(), self.axis)
        if self.after >= len(grid) or len(grid) >= _MOST_SIDE:
            wanted = f"a number below {min(len(grid), _MOST_SIDE)}, of at most {_MOST_SIDE}"
            raise ConfigError("after", self.after, wanted)
        before = [*range(self.after + 1), *range(self.after, len(grid))]
        grid.insert(self.after + 1, [FREE if each in {ENTRANCE, EXIT} else each for each in grid[self.after]])
        _put_lines(change, self.axis, grid, lambda line: line + (line > self.after), before)


class DeleteLine(GarageEdit):
    """Delete a row or a column."""

    kind: Literal["delete"]
    axis: Axis
    at: int = Field(ge=0)
    """Number of the row or column."""

    def apply(self, change: Change) -> None:
        """Delete the line, and renumber what lies beyond it."""
        grid = _lines(change.grid(), self.axis)
        if self.at >= len(grid) or len(grid) <= _LEAST_SIDE:
            wanted = f"a number below {len(grid)}, of at least {_LEAST_SIDE} {self.axis} that remain"
            raise ConfigError("at", self.at, wanted)
        before = [line for line in range(len(grid)) if line != self.at]
        _put_lines(change, self.axis, [grid[line] for line in before], dict(zip(before, itertools.count())).get, before)


class Resize(GarageEdit):
    """Give the site another number of rows and columns, at its far ends; new squares are free."""

    kind: Literal["resize"]
    rows: int = Field(ge=_LEAST_SIDE, le=_MOST_SIDE)
    cols: int = Field(ge=_LEAST_SIDE, le=_MOST_SIDE)

    def apply(self, change: Change) -> None:
        """Cut the site, or lengthen it."""
        counts: dict[Axis, int] = {"cols": self.cols, "rows": self.rows}
        for axis, count in counts.items():
            grid = _lines(change.grid(), axis)
            before = [min(line, len(grid) - 1) for line in range(count)]
            lines = [grid[line] if line < len(grid) else [FREE] * len(grid[0]) for line in range(count)]
            _put_lines(change, axis, lines, {line: line for line in range(count)}.get, before)


def _lines(grid: list[list[str]], axis: Axis) -> list[list[str]]:
    return [list(line) for line in (zip(*grid, strict=True) if axis == "cols" else grid)]


def _put_lines(
    change: Change,
    axis: Axis,
    lines: list[list[str]],
    moved: Callable[[int], int | None],
    before: list[int],
) -> None:
    """Write rows or columns; `before` are the earlier numbers of those whose sides they have."""
    sides = change.sides_m(axis)
    change.move(axis, moved)
    change.put_grid(_lines(lines, axis))
    if isinstance(sides, list):
        change.put_sides(axis, [sides[line] for line in before])


class Levels(GarageEdit):
    """Give the building levels; with two or more, lanes and runs of stalls are planned and leave the drawing."""

    kind: Literal["levels"]
    count: int = Field(ge=1, le=6)

    def apply(self, change: Change) -> None:
        """Write the number of levels."""
        change.page.put("building.levels", self.count)
        if self.count > 1:
            for name in ("stalls.runs", "stalls.only_runs", "plan.one_way"):
                change.page.put(name, None)
            if change.config.site.structure is not None and any(LANE in row for row in change.grid()):
                change.put_grid([[FREE if each == LANE else each for each in row] for row in change.grid()])


class Ramps(GarageEdit):
    """Place the ramps between levels, or let them be drawn."""

    kind: Literal["ramps"]
    square: SquareIndex | None
    """As `building.place.square`; none to let their place be drawn."""
    way: Side = "down"
    aside: Side | None = None

    def apply(self, change: Change) -> None:
        """Write the place."""
        place = None if self.square is None else {"square": list(self.square), "way": self.way}
        change.page.put(
            "building.place", place if place is None or self.aside is None else {**place, "aside": self.aside}
        )


class SetRun(GarageEdit):
    """Give the stalls of consecutive squares a kind, or with no run let them be drawn."""

    kind: Literal["run"]
    first: SquareIndex
    last: SquareIndex
    edge: Side
    run: dict[str, Any] | None
    """The keys of an entry of `stalls.runs` beside these three."""

    def apply(self, change: Change) -> None:
        """Replace the runs on these squares that are free beside a lane, and cut those that reach beyond them."""
        place = {"first": list(self.first), "last": list(self.last), "edge": self.edge}
        squares = set(squares_of(place))
        runs = [part for run in change.runs() for part in _parts(run, lambda square: square not in squares)]
        if self.run is not None:
            try:
                GivenRun(**{**self.run, **place})
            except ValidationError as error:
                raise config_error(error, GivenRun, within="stalls.runs") from None
            grid = change.grid()
            stand = [*_parts({**place, **self.run}, lambda at: stands(grid, {**place, "first": at, "last": at}))]
            if not stand:
                wanted = "free squares with a lane beyond that edge"
                raise ConfigError("stalls.runs", f"{[*self.first]}, {self.edge}", wanted)
            runs += stand
        change.put_runs(runs)


def _parts(run: Mapping[str, Any], keeps: Callable[[tuple[int, int]], bool]) -> Iterator[dict[str, Any]]:
    """Yield the parts of a run on consecutive squares that are kept."""
    for is_kept, part in itertools.groupby(squares_of(run), key=keeps):
        if is_kept:
            first, *others = map(list, part)
            yield {**run, "first": first, "last": others[-1] if others else first}


class Adopt(GarageEdit):
    """Keep lanes that were planned as the drawing's."""

    kind: Literal["adopt"]
    rows: tuple[str, ...]

    def apply(self, change: Change) -> None:
        """Write the squares with the lanes."""
        grid = change.grid()
        if [len(row) for row in self.rows] != [len(row) for row in grid]:
            raise ConfigError("rows", len(self.rows), f"a plan of {len(grid)} x {len(grid[0])} squares")
        change.put_grid([list(row) for row in self.rows])


class Put(GarageEdit):
    """Set any other setting, or take it out."""

    kind: Literal["put"]
    name: str
    """Dotted name, for example `look.floor.finish`."""
    value: Any
    """Its value as TOML has it; none to take it out."""

    def apply(self, change: Change) -> None:
        """Write the setting."""
        if self.name.startswith(("site.", "stalls.runs", "building.levels", "building.place")):
            raise ConfigError("name", self.name, "a setting that has no edit of its own")
        change.page.put(self.name, self.value)


AnyEdit = Annotated[
    Paint | Sides | InsertLine | DeleteLine | Resize | Levels | Ramps | SetRun | Adopt | Put,
    Field(discriminator="kind"),
]
_ADAPTER: TypeAdapter[AnyEdit] = TypeAdapter(AnyEdit)


def edit_of(message: Any) -> GarageEdit:  # noqa: ANN401 - what JSON holds
    """Read an edit; raises `ConfigError` for anything else."""
    return told_edit(_ADAPTER, message)
