"""Garages, levels, plans and tracks as drawings that a notebook displays: inline SVG with a line of figures."""

import base64
from collections import Counter
from collections.abc import Iterable, Sequence
from dataclasses import replace
from html import escape
from io import BytesIO

from garage2usd.common.progress import time_in_words
from garage2usd.driving.tracks import Tracks
from garage2usd.garage_model import Garage, GarageLevel
from garage2usd.layout import Layout
from garage2usd.planning import Plan
from garage2usd.view.drawing import Drawing, Line, Text, text_width, to_image, to_svg
from garage2usd.view.garage_plans import draw_levels
from garage2usd.view.plan_picture import draw_plan
from garage2usd.view.plan_sheet import INK
from garage2usd.view.plan_tracks import draw_tracks
from garage2usd.view.thumbnails import draw_thumbnail

_MOST_SVG = 1_000_000
"""Characters of an SVG above which a picture takes its place, as a page with so many elements is slow."""
_SQUARE_PX, _HEAD, _LETTERS = 28.0, 1.0, 0.5
_ARROW, _ARROW_WIDTH = 0.22, 0.08
_LOGGED = 8


def garage_html(garage: Garage, *, tracks: Tracks | None = None, lines: Sequence[str] = ()) -> str:
    """Draw the plan of each level of a garage and the section through them, with a line of figures below.

    Parameters
    ----------
    garage
        The garage.
    tracks
        Tracks of traffic in it, drawn as lines.
    lines
        More lines of text below.
    """
    levels = len(garage.levels)
    where = f" on {levels} levels" if levels > 1 else ""
    config = garage.config
    figures = f"{garage.parking_stalls} stalls{where}, profile {config.standard.name}, seed {config.seed}"
    return _figure(draw_levels(garage, tracks=tracks).values(), [figures, *lines])


def level_svg(level: GarageLevel) -> str:
    """Draw the plan of a level."""
    return layout_svg(level.layout)


def layout_svg(layout: Layout) -> str:
    """Draw the plan of a layout."""
    return to_svg(draw_plan(layout), is_inline=True)


def plan_svg(plan: Plan) -> str:
    """Draw the squares of a plan by kind, with its score above and an arrow along each one-way stretch."""
    rows, cols = plan.structure.shape
    words = f"{rows} x {cols} squares, {plan.score.stalls} stalls, score {plan.score.value:.2f}"
    squares = draw_thumbnail(plan.structure.cells, f"Plan of {words}")
    width = max(float(cols), 1.2 * text_width(words, _LETTERS) + _LETTERS)  # fonts of browsers are wider
    title = Text((_LETTERS / 2, -_HEAD / 2), words, _LETTERS, INK, is_left=True, kind="title")
    elements = [*squares.elements, title, *(line for way in plan.one_way_stretches for line in _arrow(way))]
    sheet = replace(squares, low=(0.0, -_HEAD), high=(width, float(rows)), px_per_m=_SQUARE_PX, elements=elements)
    return to_svg(sheet, is_inline=True)


def tracks_html(tracks: Tracks) -> str:
    """Draw the ways of all agents level by level, with a table of the agents and the events of the log."""
    facts = tracks.facts
    told = f"{len(tracks)} agents in {time_in_words(tracks.duration_s)}"
    if "arrivals" in facts:
        told += f": {facts['arrivals']} cars arrive, {facts['departures']} leave, {facts['turned_away']} find no stall"
    more = len(tracks.log) - _LOGGED
    lines = [told, *tracks.log[:_LOGGED], *([f"and {more} lines more"] if more > 0 else [])]
    rows = [("class", "agents", "behaviour")]
    for kind, count in Counter(track.agent.kind for track in tracks).items():
        found = Counter(track.agent.behaviour for track in tracks if track.agent.kind is kind and track.agent.behaviour)
        rows.append((kind.value, str(count), ", ".join(f"{behaviour} {many}" for behaviour, many in found.items())))
    return _figure(draw_tracks(tracks).values(), lines) + table_html(rows)


def table_html(rows: Iterable[Sequence[str]]) -> str:
    """Write rows of text as a table, whose first row is its head."""
    head, *others = rows
    lines = [f"<tr>{''.join(f'<th>{escape(cell)}</th>' for cell in head)}</tr>"]
    lines += [f"<tr>{''.join(f'<td>{escape(cell)}</td>' for cell in row)}</tr>" for row in others]
    return f"<table>{''.join(lines)}</table>"


def _figure(drawings: Iterable[Drawing], lines: Iterable[str]) -> str:
    """Return drawings one below the other, with lines of text in the colour of the page below them."""
    caption = "<br/>".join(map(escape, lines))
    return f'<figure style="margin:0">{"".join(map(_shown, drawings))}<figcaption>{caption}</figcaption></figure>'


def _shown(drawing: Drawing) -> str:
    svg = to_svg(drawing, is_inline=True)
    if len(svg) <= _MOST_SVG:
        return svg
    png = BytesIO()
    to_image(drawing).save(png, "PNG")
    data = base64.b64encode(png.getvalue()).decode()
    return f'<img style="max-width:100%" alt="{escape(drawing.title)}" src="data:image/png;base64,{data}"/>'


def _arrow(way: Sequence[tuple[int, int]]) -> Iterable[Line]:
    """Draw the way over some squares, and a head in its last one."""
    points = [(col + 0.5, row + 0.5) for row, col in way]
    (x, z), (before_x, before_z) = points[-1], points[-2]
    dx, dz = (x - before_x) * _ARROW, (z - before_z) * _ARROW
    head = [(x - dx - dz, z - dz + dx), (x, z), (x - dx + dz, z - dz - dx)]
    for line in (points, head):
        yield Line(line, INK, _ARROW_WIDTH, "direction")
