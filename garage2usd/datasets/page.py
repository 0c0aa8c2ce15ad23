"""The HTML page of a data set: plans and their variety, in one file for offline use."""

import base64
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np

from garage2usd.common.package import of_extra
from garage2usd.datasets.charts import bars, histogram, split_colours
from garage2usd.datasets.difficulty import Level
from garage2usd.datasets.drawn_plan import ContourShape
from garage2usd.datasets.variety import FIGURES, PlanFigures, Variety
from garage2usd.layout.measures import FloorArea
from garage2usd.structure.symmetry import cropped_cells
from garage2usd.view.drawing import to_svg
from garage2usd.view.thumbnails import THUMBNAIL_COLOURS, draw_thumbnail

with of_extra("the page of a data set"):
    from jinja2 import Environment, StrictUndefined
    from markupsafe import Markup

_TEMPLATE = Path(__file__).with_name("page.html.jinja")
_MOST_DRAWN = 200
_THUMBNAIL_WORDS = {
    "stalls": "free beside a lane: stalls",
    "lane": "lane",
    "dead_end": "lane of a dead end",
    "entrance": "entrance",
    "exit": "exit",
    "landing": "landing of a ramp",
    "free": "free",
    "obstacle": "obstacle",
}


def write_page(
    path: Path,
    plans: Sequence[PlanFigures],
    *,
    title: str = "Data set of parking garages",
    facts: Mapping[str, str] | None = None,
    most_drawn: int = _MOST_DRAWN,
    sheets: Sequence[Path] = (),
) -> Variety:
    """Write the HTML page of a set of plans.

    Parameters
    ----------
    path
        The HTML file.
    plans
        The plans, in the order in which the page shows them.
    title
        Heading of the page.
    facts
        Facts below the title, by name, such as the seed or a version.
    most_drawn
        Maximum number of plans in the page, evenly spaced among all of them.
    sheets
        Contact sheets, PNG or JPEG, to embed.

    Returns
    -------
    Variety
        The figures on the page.

    Notes
    -----
    The page is self-contained. The same plans give the same bytes with the same version of matplotlib.
    """
    variety = Variety(plans)
    shares = variety.values("nearest_share")
    environment = Environment(autoescape=True, undefined=StrictUndefined, trim_blocks=True, lstrip_blocks=True)
    template = environment.from_string(_TEMPLATE.read_text(encoding="utf-8"))
    text = template.render(
        title=title,
        facts=facts or {},
        variety=variety,
        colours=split_colours(variety.splits),
        median=float(np.median(shares)) if shares.size else None,
        spreads={
            words: [variety.spread(figure, split=split) for split in (None, *variety.splits)]
            for figure, words in FIGURES.items()
        },
        kinds=_kinds(variety),
        charts=_charts(variety),
        legend=[(_THUMBNAIL_WORDS[kind], kind) for kind in THUMBNAIL_COLOURS],
        fills={kind: "#{:02x}{:02x}{:02x}".format(*colour) for kind, colour in THUMBNAIL_COLOURS.items()},
        sheets=[(sheet.stem, _picture(sheet)) for sheet in sheets],
        plans=[(plan, _thumbnail(plan)) for plan in _evenly(variety.plans, most_drawn)],
        number=_number,
    )
    path.write_text(text, encoding="utf-8", newline="\n")
    return variety


def _evenly(plans: Sequence[PlanFigures], most: int) -> list[PlanFigures]:
    """Select at most a number of plans, evenly spaced, including first and last."""
    count = min(len(plans), most)
    return [plans[place] for place in np.linspace(0, len(plans) - 1, count).round().astype(int).tolist()]


def _kinds(variety: Variety) -> dict[str, dict[str, list[int]]]:
    """Count plans by contour shape and by difficulty level, in total and for each split."""
    splits = (None, *variety.splits)
    contours = [variety.contours(split=split) for split in splits]
    levels = [variety.levels(split=split) for split in splits]
    kinds = {"Contour": {str(shape): [found[shape] for found in contours] for shape in ContourShape}}
    if any(levels[0].values()):
        kinds["Difficulty"] = {str(level): [found[level] for found in levels] for level in Level}
    return kinds


def _charts(variety: Variety) -> list[Markup]:
    histograms = [
        histogram({split: variety.values(figure, split=split) for split in variety.splits}, words)
        for figure, words in FIGURES.items()
    ]
    for name, count in (("Shape of the contour", variety.contours), ("Difficulty of the garage", variety.levels)):
        found = {split: {str(kind): many for kind, many in count(split=split).items()} for split in variety.splits}
        if any(many for kinds in found.values() for many in kinds.values()):
            histograms.append(bars(found, name))
    if any(plan.levels > 1 for plan in variety.plans):
        counts = {split: variety.level_counts(split=split) for split in variety.splits}
        found = {split: {str(levels): many for levels, many in count.items()} for split, count in counts.items()}
        histograms.append(bars(found, "Levels"))
    return [Markup(chart) for chart in histograms]  # noqa: S704 - matplotlib has escaped what it was given


def _thumbnail(plan: PlanFigures) -> Markup:
    cells = cropped_cells(plan.cells)
    rows, cols = cells.shape
    levels = f" on each of {plan.levels} levels, drawn is U1" if plan.levels > 1 else ""
    areas = FloorArea(plan.area_per_stall_m2, plan.gross_area_per_stall_m2 or plan.area_per_stall_m2).in_words()
    title = f"{plan.key}: {rows} x {cols} squares{levels}, {plan.stalls} stalls, {areas}"
    landings = list(plan.landings)
    if landings:
        first = np.argwhere(plan.cells >= 0).min(axis=0).tolist()
        landings = [(row - first[0], col - first[1]) for row, col in landings]
    return Markup(to_svg(draw_thumbnail(cells, title, landings)))  # noqa: S704 - ElementTree has escaped the key


def _picture(path: Path) -> str:
    """Encode a picture as a data URL."""
    kind = "png" if path.suffix.lower() == ".png" else "jpeg"
    return f"data:image/{kind};base64,{base64.b64encode(path.read_bytes()).decode()}"


def _number(value: Any) -> str:  # noqa: ANN401 - whatever the template has
    """Format a figure for readers: an integer, one decimal, or a dash for a missing value."""
    if value is None:
        return "\N{EN DASH}"
    return f"{value:,.0f}" if float(value).is_integer() else f"{value:,.1f}"
