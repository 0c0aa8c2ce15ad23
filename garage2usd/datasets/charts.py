"""Charts of a data set's variety: SVG for a page, in the page's text colour and font."""

import io
import re
from collections.abc import Callable, Mapping, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from garage2usd.common.package import of_extra

with of_extra("the page of a data set"):
    import matplotlib as mpl
    from matplotlib.axes import Axes
    from matplotlib.backends.backend_svg import FigureCanvasSVG
    from matplotlib.figure import Figure
    from matplotlib.ticker import MaxNLocator

_PALETTE = ("#4878a8", "#d9973a", "#57a773", "#b5599b", "#8b7d6b", "#3fa7b5")
"""Palette of splits; the first three colours differ in grey and for colour-blind readers."""
_INK = "#010203"
"""Placeholder for the page's text colour."""
_SIZE_IN = (3.2, 2.2)
_BINS, _MOST_UNIT_BINS = 24, 24
_FEW_EDGES, _BAR_SHARE = 9, 0.7
"""Number of bin edges below which bars are separated, and their share of the bin's width."""
_SETTINGS: dict[Any, Any] = {
    "svg.hashsalt": "garage2usd",
    "svg.fonttype": "none",
    "font.family": "DejaVu Sans",
    "font.size": 10,
    "text.color": _INK,
    "axes.labelcolor": _INK,
    "axes.edgecolor": _INK,
    "xtick.color": _INK,
    "ytick.color": _INK,
    "axes.spines.top": False,
    "axes.spines.right": False,
    "axes.spines.left": False,
    "ytick.left": False,
    "axes.axisbelow": True,
}


def split_colours(splits: Sequence[str]) -> dict[str, str]:
    """Return the colour of each split in charts, ``#rrggbb``; colours repeat from the seventh split."""
    return {split: _PALETTE[number % len(_PALETTE)] for number, split in enumerate(splits)}


def histogram(values: Mapping[str, NDArray[np.float64]], title: str) -> str:
    """Draw a stacked histogram of a figure of plans, by split.

    Parameters
    ----------
    values
        The figure of the plans of each split; float64, shape (plans,).
    title
        Title of the figure, with its unit.

    Returns
    -------
    str
        An ``svg`` element, reproducible from the values.
    """
    edges = _edges(np.concatenate([*values.values(), np.zeros(0)]))
    is_whole = bool((edges % 1 == 0.5).all())  # noqa: PLR2004 - around whole numbers

    def draw(axes: Axes) -> None:
        if values:
            colours = list(split_colours([*values]).values())
            share = _BAR_SHARE if len(edges) <= _FEW_EDGES else 1.0
            axes.hist(list(values.values()), edges.tolist(), stacked=True, color=colours, rwidth=share)
        axes.xaxis.set_major_locator(MaxNLocator(nbins=6, integer=is_whole))

    return _drawn(draw, title)


def bars(counts: Mapping[str, Mapping[str, int]], title: str) -> str:
    """Draw stacked bars of the kinds of plans, by split.

    Parameters
    ----------
    counts
        Number of plans by split and kind; all splits have the same order of kinds.
    title
        Title of the kinds.

    Returns
    -------
    str
        As `histogram`.
    """
    colours = split_colours([*counts])

    def draw(axes: Axes) -> None:
        kinds = list(next(iter(counts.values()), {}))
        below = np.zeros(len(kinds))
        for split, found in counts.items():
            heights = np.array(list(found.values()), dtype=np.float64)
            axes.bar(kinds, heights, _BAR_SHARE, below, color=colours[split])
            below += heights

    return _drawn(draw, title)


def _edges(values: NDArray[np.float64]) -> NDArray[np.float64]:
    """Compute bin edges: around whole numbers if there are few, otherwise evenly spaced."""
    if not values.size:
        return np.array([0.0, 1.0])
    low, high = float(values.min()), float(values.max())
    if (values % 1 == 0).all():
        step = int(np.ceil((high - low + 1) / _MOST_UNIT_BINS))
        return np.arange(low - 0.5, high + step + 0.5, step)
    return np.linspace(low, high if high > low else low + 1, _BINS + 1)


def _drawn(draw: Callable[[Axes], None], title: str) -> str:
    with mpl.rc_context(_SETTINGS):
        figure = Figure(figsize=_SIZE_IN, layout="constrained")
        axes = FigureCanvasSVG(figure).figure.add_subplot()
        draw(axes)
        axes.set_xlabel(title)
        axes.set_ylabel("Plans")
        axes.yaxis.set_major_locator(MaxNLocator(nbins=4, integer=True, min_n_ticks=1))
        axes.grid(axis="y", color=_INK, alpha=0.15, linewidth=0.7)
        text = io.StringIO()
        figure.savefig(text, format="svg", transparent=True, metadata={"Date": None, "Creator": None})
    return _in_a_page(text.getvalue(), title)


def _in_a_page(svg: str, title: str) -> str:
    """Extract the ``svg`` element from an SVG file for a page, in the page's text colour, without unused ids."""
    svg = svg[svg.index("<svg") :]
    svg = re.sub(r"<metadata>.*?</metadata>\s*", "", svg, flags=re.DOTALL).replace(_INK, "currentColor")
    used = set(re.findall(r"#([\w-]+)", svg))
    svg = re.sub(r' id="([\w-]+)"', lambda found: found[0] if found[1] in used else "", svg)
    return svg.replace("<svg ", f'<svg role="img" aria-label="{title}" ', 1)
