"""Edits of a garage's configuration, as the page sends them: squares, sides, levels, runs of stalls, any setting."""
# Over 300 lines: one class for each kind of edit, and the indices of squares that a row or a column moves.

import itertools
from abc import abstractmethod
from collections.abc import Callable, Iterable, Iterator, Mapping
from functools import partial
from typing import Annotated, Any, Literal

import numpy as np
from pydantic import Field, TypeAdapter, ValidationError

from garage2usd.common.errors import ConfigError
from garage2usd.common.settings import Settings, config_error
from garage2usd.config import GarageConfig
from garage2usd.config.site import Side, SquareIndex
from garage2usd.config.stalls import GivenRun
from garage2usd.drafts.toml_page import TomlPage
from garage2usd.site.levels import make_street_site
from garage2usd.structure.squares import pieces_of
from garage2usd.structure.stalls import Edge

OUTSIDE, FREE, LANE, ENTRANCE, EXIT = SYMBOLS = "#.=EX"
Symbol = Literal["#", ".", "=", "E", "X"]
Symmetry = Literal["none", "left-right", "up-down", "both", "turned"]
Axis = Literal["rows", "cols"]
_STRUCTURE = "site.structure"
_SIDES: dict[Axis, tuple[str, str]] = {
    "rows": ("bay.row_depths_m", "bay.row_depths_file"),
    "cols": ("bay.column_widths_m", "bay.column_widths_file"),
}
_INSTEAD_OF_STRUCTURE = (
    "structure_file", "contour", "entrance_cells", "exit_cells", "obstacle_cells", "width_cells", "height_cells",
    "rectangles", "min_fill", "entrances", "exits", "min_portal_distance_cells", "obstacles",
    "min_obstacle_distance_cells",
)  # fmt: skip
"""Settings of the site that a structure replaces, or which say nothing beside one."""
_LEAST_SIDE, _MOST_SIDE = 3, 250
"""Rows or columns of a drawing. A larger garage is configured, and opens, but a page is not the place to paint it."""
_MirrorOf = Callable[[int, int], tuple[int, int]]


def rows_of(config: GarageConfig) -> list[str]:
    """Return S of the top level as rows of symbols, as it is given or drawn by the seed; raises as `generate`."""
    return str(make_street_site(config)).splitlines()


class _Change:
    """A configuration that is being changed: its document, its settings before, and its squares."""

    def __init__(self, page: TomlPage, config: GarageConfig) -> None:
        self.page, self.config = page, config
        self._rows: list[str] | None = None

    def grid(self) -> list[list[str]]:
        """Squares by rows, as they are until now."""
        if self._rows is None:
            self._rows = self._drawn()
        return [list(row) for row in self._rows]

    def _drawn(self) -> list[str]:
        drawing = self.config.site.structure
        if drawing is None or any(character in drawing for character in "01"):
            return rows_of(self.config)
        # also one that is not a garage yet, which is drawn on
        return [line.strip() for line in drawing.splitlines() if line.strip()]

    def put_grid(self, grid: list[list[str]]) -> None:
        """Write squares as the structure, in place of what they were drawn from, and drop runs without ground."""
        self._rows = rows = ["".join(row) for row in grid]
        for key in _INSTEAD_OF_STRUCTURE:
            self.page.put(f"site.{key}", None)
        is_list = isinstance(self.page.get(_STRUCTURE), list)
        self.page.put(_STRUCTURE, rows if is_list else "\n".join(rows) + "\n")
        self._keep_runs(lambda run: _stands(grid, run))
        self._keep_directions(lambda pair: all(_symbol(grid, square) in {LANE, ENTRANCE, EXIT} for square in pair))

    def sides_m(self, axis: Axis) -> Any:  # noqa: ANN401 - one number, one each, or one for each square
        """Return the given sides of rows or columns: one number for all, one each, or None if they are chosen."""
        sides = getattr(self.config.bay, _SIDES[axis][0].removeprefix("bay."))
        if isinstance(sides, tuple) and isinstance(sides[0], tuple):
            sides = sides[0] if axis == "cols" else tuple(row[0] for row in sides)
        return list(sides) if isinstance(sides, tuple) else sides

    def put_sides(self, axis: Axis, sides_m: Any) -> None:  # noqa: ANN401
        """Write the sides of rows or columns."""
        name, file = _SIDES[axis]
        self.page.put(file, None)
        self.page.put(name, sides_m)

    def runs(self) -> list[dict[str, Any]]:
        """Given runs of stalls as plain tables."""
        return [dict(run) for run in self.page.get("stalls.runs") or ()]

    def put_runs(self, runs: list[dict[str, Any]]) -> None:
        """Write the given runs of stalls."""
        if runs != self.runs():
            self.page.put("stalls.runs", runs or None)
        if not any(run.get("size") != "motorcycle" for run in runs):
            self.page.put("stalls.only_runs", None)

    def _keep_runs(self, keeps: Callable[[Mapping[str, Any]], bool]) -> None:
        self.put_runs([run for run in self.runs() if keeps(run)])

    def _keep_directions(self, keeps: Callable[[list[list[int]]], bool]) -> None:
        pairs = self.page.get("plan.one_way") or []
        kept = [pair for pair in pairs if keeps(pair)]
        if kept != pairs:
            self.page.put("plan.one_way", kept or None)

    def move(self, axis: Axis, moved: Callable[[int], int | None]) -> None:
        """Renumber the rows or columns in all settings that name squares; None takes a line away."""
        number = int(axis == "cols")

        def at(square: Iterable[int]) -> list[int] | None:
            index = list(square)
            line = moved(index[number])
            return None if line is None else [*index[:number], line, *index[number + 1 :]]

        runs = []
        for run in self.runs():
            squares = [at(square) for square in _squares_of(run)]
            if kept := [square for square in squares if square is not None]:
                runs.append({**run, "first": kept[0], "last": kept[-1]})
        self.put_runs(runs)
        pairs = [[at(square) for square in pair] for pair in self.page.get("plan.one_way") or []]
        if pairs:
            self.page.put("plan.one_way", [pair for pair in pairs if None not in pair] or None)
        if place := self.page.get("building.place"):
            square = at(place["square"])
            self.page.put("building.place", square and {**place, "square": square})


class Edit(Settings):
    """An edit of a configuration."""

    @abstractmethod
    def apply(self, change: _Change) -> None:
        """Change the configuration's document; raises `ConfigError` where the edit has no place in it."""


class Paint(Edit):
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

    def apply(self, change: _Change) -> None:
        """Paint the squares and their images."""
        grid = change.grid()
        height, width = len(grid), len(grid[0])
        for mirror in _mirrors(self.symmetry, height, width):
            for row, col in self._squares(grid, mirror):
                if row < height and col < width:
                    grid[row][col] = self.symbol
        if self.symbol == LANE and change.config.building.levels > 1:
            wanted = "no lanes with building.levels of 2 or more: they are planned"
            raise ConfigError(_STRUCTURE, LANE, wanted)
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
    pieces, _ = pieces_of(np.array(grid) == _symbol(grid, start))
    found: list[list[int]] = np.argwhere(pieces == pieces[start]).tolist()
    return [(row, col) for row, col in found]


def _symbol(grid: list[list[str]], square: Iterable[int]) -> str:
    row, col = square
    return grid[row][col] if 0 <= row < len(grid) and 0 <= col < len(grid[0]) else OUTSIDE


def _squares_of(run: Mapping[str, Any]) -> list[tuple[int, int]]:
    (row, col), (last_row, last_col) = run["first"], run["last"]
    return [(each, every) for each in range(row, last_row + 1) for every in range(col, last_col + 1)]


def _stands(grid: list[list[str]], run: Mapping[str, Any]) -> bool:
    """True if all squares of a run are free, with a lane before each."""
    edge = Edge[run["edge"].upper()]
    return all(
        _symbol(grid, square) == FREE and _symbol(grid, edge.beyond(square)) == LANE for square in _squares_of(run)
    )


class Sides(Edit):
    """Give all rows their depths, or all columns their widths, or let them be chosen for the plan."""

    kind: Literal["sides"]
    axis: Axis
    metres: tuple[float, ...] | None
    """One for each row or column; none to let them be chosen, if `bay.dimensioned` says so."""

    def apply(self, change: _Change) -> None:
        """Write the sides."""
        count = len(change.grid()) if self.axis == "rows" else len(change.grid()[0])
        if self.metres is not None and len(self.metres) != count:
            raise ConfigError(
                _SIDES[self.axis][0], len(self.metres), f"{count} numbers, one for each of the {self.axis}"
            )
        change.put_sides(self.axis, None if self.metres is None else [round(side, 3) for side in self.metres])


class InsertLine(Edit):
    """Insert a row or a column, a copy of the one after which it comes, with free squares for doors."""

    kind: Literal["insert"]
    axis: Axis
    after: int = Field(ge=0)
    """Number of the row or column."""

    def apply(self, change: _Change) -> None:
        """Insert the line, and renumber what lies beyond it."""
        grid = _lines(change.grid(), self.axis)
        if self.after >= len(grid) or len(grid) >= _MOST_SIDE:
            wanted = f"a number below {min(len(grid), _MOST_SIDE)}, of at most {_MOST_SIDE}"
            raise ConfigError("after", self.after, wanted)
        before = [*range(self.after + 1), *range(self.after, len(grid))]
        grid.insert(self.after + 1, [FREE if each in {ENTRANCE, EXIT} else each for each in grid[self.after]])
        _put_lines(change, self.axis, grid, lambda line: line + (line > self.after), before)


class DeleteLine(Edit):
    """Delete a row or a column."""

    kind: Literal["delete"]
    axis: Axis
    at: int = Field(ge=0)
    """Number of the row or column."""

    def apply(self, change: _Change) -> None:
        """Delete the line, and renumber what lies beyond it."""
        grid = _lines(change.grid(), self.axis)
        if self.at >= len(grid) or len(grid) <= _LEAST_SIDE:
            wanted = f"a number below {len(grid)}, of at least {_LEAST_SIDE} {self.axis} that remain"
            raise ConfigError("at", self.at, wanted)
        before = [line for line in range(len(grid)) if line != self.at]
        _put_lines(change, self.axis, [grid[line] for line in before], dict(zip(before, itertools.count())).get, before)


class Resize(Edit):
    """Give the site another number of rows and columns, at its far ends; new squares are free."""

    kind: Literal["resize"]
    rows: int = Field(ge=_LEAST_SIDE, le=_MOST_SIDE)
    cols: int = Field(ge=_LEAST_SIDE, le=_MOST_SIDE)

    def apply(self, change: _Change) -> None:
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
    change: _Change,
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


class Levels(Edit):
    """Give the building levels; with two or more, lanes and runs of stalls are planned and leave the drawing."""

    kind: Literal["levels"]
    count: int = Field(ge=1, le=6)

    def apply(self, change: _Change) -> None:
        """Write the number of levels."""
        change.page.put("building.levels", self.count)
        if self.count > 1:
            for name in ("stalls.runs", "stalls.only_runs", "plan.one_way"):
                change.page.put(name, None)
            if change.config.site.structure is not None and any(LANE in row for row in change.grid()):
                change.put_grid([[FREE if each == LANE else each for each in row] for row in change.grid()])


class Ramps(Edit):
    """Place the ramps between levels, or let them be drawn."""

    kind: Literal["ramps"]
    square: SquareIndex | None
    """As `building.place.square`; none to let their place be drawn."""
    way: Side = "down"
    aside: Side | None = None

    def apply(self, change: _Change) -> None:
        """Write the place."""
        place = None if self.square is None else {"square": list(self.square), "way": self.way}
        change.page.put(
            "building.place", place if place is None or self.aside is None else {**place, "aside": self.aside}
        )


class SetRun(Edit):
    """Give the stalls of consecutive squares a kind, or with no run let them be drawn."""

    kind: Literal["run"]
    first: SquareIndex
    last: SquareIndex
    edge: Side
    run: dict[str, Any] | None
    """The keys of an entry of `stalls.runs` beside these three."""

    def apply(self, change: _Change) -> None:
        """Replace the runs on these squares that are free beside a lane, and cut those that reach beyond them."""
        place = {"first": list(self.first), "last": list(self.last), "edge": self.edge}
        squares = set(_squares_of(place))
        runs = [part for run in change.runs() for part in _parts(run, lambda square: square not in squares)]
        if self.run is not None:
            try:
                GivenRun(**{**self.run, **place})
            except ValidationError as error:
                raise config_error(error, GivenRun, within="stalls.runs") from None
            grid = change.grid()
            stand = [*_parts({**place, **self.run}, lambda at: _stands(grid, {**place, "first": at, "last": at}))]
            if not stand:
                wanted = "free squares with a lane beyond that edge"
                raise ConfigError("stalls.runs", f"{[*self.first]}, {self.edge}", wanted)
            runs += stand
        change.put_runs(runs)


def _parts(run: Mapping[str, Any], keeps: Callable[[tuple[int, int]], bool]) -> Iterator[dict[str, Any]]:
    """Yield the parts of a run on consecutive squares that are kept."""
    for is_kept, part in itertools.groupby(_squares_of(run), key=keeps):
        if is_kept:
            first, *others = map(list, part)
            yield {**run, "first": first, "last": others[-1] if others else first}


class Adopt(Edit):
    """Keep lanes that were planned as the drawing's."""

    kind: Literal["adopt"]
    rows: tuple[str, ...]

    def apply(self, change: _Change) -> None:
        """Write the squares with the lanes."""
        grid = change.grid()
        if [len(row) for row in self.rows] != [len(row) for row in grid]:
            raise ConfigError("rows", len(self.rows), f"a plan of {len(grid)} x {len(grid[0])} squares")
        change.put_grid([list(row) for row in self.rows])


class Put(Edit):
    """Set any other setting, or take it out."""

    kind: Literal["put"]
    name: str
    """Dotted name, for example `look.floor.finish`."""
    value: Any
    """Its value as TOML has it; none to take it out."""

    def apply(self, change: _Change) -> None:
        """Write the setting."""
        if self.name.startswith(("site.", "stalls.runs", "building.levels", "building.place")):
            raise ConfigError("name", self.name, "a setting that has no edit of its own")
        change.page.put(self.name, self.value)


AnyEdit = Annotated[
    Paint | Sides | InsertLine | DeleteLine | Resize | Levels | Ramps | SetRun | Adopt | Put,
    Field(discriminator="kind"),
]
_ADAPTER: TypeAdapter[AnyEdit] = TypeAdapter(AnyEdit)


def edit_of(message: Any) -> Edit:  # noqa: ANN401 - what JSON holds
    """Read an edit; raises `ConfigError` for anything else."""
    try:
        return _ADAPTER.validate_python(message)
    except ValidationError as error:
        first = error.errors(include_url=False)[0]
        raise ConfigError(".".join(map(str, first["loc"])) or "edit", first["input"], first["msg"]) from None


def applied(edit: Edit, text: str, config: GarageConfig) -> str:
    """Apply an edit to a configuration's text and return the new text.

    Raises
    ------
    ConfigError, GenerationError
        If the edit has no place in this configuration, or its squares are drawn and cannot be.
    """
    change = _Change(TomlPage(text), config)
    edit.apply(change)
    return change.page.text()
