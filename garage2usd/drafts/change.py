"""A configuration that is being changed: its document, with squares, sides, runs of stalls, and what names squares."""

from collections.abc import Callable, Iterable, Mapping
from typing import Any, Literal

from garage2usd.config import GarageConfig
from garage2usd.drafts.toml_page import TomlPage
from garage2usd.site.levels import make_street_site
from garage2usd.structure.stalls import Edge

OUTSIDE, FREE, LANE, ENTRANCE, EXIT = SYMBOLS = "#.=EX"
Axis = Literal["rows", "cols"]
STRUCTURE = "site.structure"
SIDES: dict[Axis, tuple[str, str]] = {
    "rows": ("bay.row_depths_m", "bay.row_depths_file"),
    "cols": ("bay.column_widths_m", "bay.column_widths_file"),
}
_INSTEAD_OF_STRUCTURE = (
    "structure_file", "contour", "entrance_cells", "exit_cells", "obstacle_cells", "width_cells", "height_cells",
    "rectangles", "min_fill", "entrances", "exits", "min_portal_distance_cells", "obstacles",
    "min_obstacle_distance_cells",
)  # fmt: skip
"""Settings of the site that a structure replaces, or which say nothing beside one."""


def rows_of(config: GarageConfig) -> list[str]:
    """Return S of the top level as rows of symbols, as it is given or drawn by the seed; raises as `generate`."""
    return str(make_street_site(config)).splitlines()


class Change:
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
        is_list = isinstance(self.page.get(STRUCTURE), list)
        self.page.put(STRUCTURE, rows if is_list else "\n".join(rows) + "\n")
        self._keep_runs(lambda run: stands(grid, run))
        self._keep_directions(lambda pair: all(symbol_at(grid, square) in {LANE, ENTRANCE, EXIT} for square in pair))

    def sides_m(self, axis: Axis) -> Any:  # noqa: ANN401 - one number, one each, or one for each square
        """Return the given sides of rows or columns: one number for all, one each, or None if they are chosen."""
        sides = getattr(self.config.bay, SIDES[axis][0].removeprefix("bay."))
        if isinstance(sides, tuple) and isinstance(sides[0], tuple):
            sides = sides[0] if axis == "cols" else tuple(row[0] for row in sides)
        return list(sides) if isinstance(sides, tuple) else sides

    def put_sides(self, axis: Axis, sides_m: Any) -> None:  # noqa: ANN401
        """Write the sides of rows or columns."""
        name, file = SIDES[axis]
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
            squares = [at(square) for square in squares_of(run)]
            if kept := [square for square in squares if square is not None]:
                runs.append({**run, "first": kept[0], "last": kept[-1]})
        self.put_runs(runs)
        pairs = [[at(square) for square in pair] for pair in self.page.get("plan.one_way") or []]
        if pairs:
            self.page.put("plan.one_way", [pair for pair in pairs if None not in pair] or None)
        if place := self.page.get("building.place"):
            square = at(place["square"])
            self.page.put("building.place", square and {**place, "square": square})


def symbol_at(grid: list[list[str]], square: Iterable[int]) -> str:
    """Return the kind of a square, that beyond the border being outside."""
    row, col = square
    return grid[row][col] if 0 <= row < len(grid) and 0 <= col < len(grid[0]) else OUTSIDE


def squares_of(run: Mapping[str, Any]) -> list[tuple[int, int]]:
    """Return the (row, col) of the squares of a run."""
    (row, col), (last_row, last_col) = run["first"], run["last"]
    return [(each, every) for each in range(row, last_row + 1) for every in range(col, last_col + 1)]


def stands(grid: list[list[str]], run: Mapping[str, Any]) -> bool:
    """True if all squares of a run are free, with a lane before each."""
    edge = Edge[run["edge"].upper()]
    return all(
        symbol_at(grid, square) == FREE and symbol_at(grid, edge.beyond(square)) == LANE for square in squares_of(run)
    )
