"""Figures of variety as charts: SVG that stands in a page and takes its colour of ink and its letters."""

import io
import re
from collections.abc import Callable, Mapping, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from garage2usd.common.extras import of_extra

with of_extra("the page of a data set"):
    import matplotlib as mpl
    from matplotlib.axes import Axes
    from matplotlib.backends.backend_svg import FigureCanvasSVG
    from matplotlib.figure import Figure
    from matplotlib.ticker import MaxNLocator

__all__ = ["bars", "histogram", "split_colours"]

_PALETTE = ("#4878a8", "#d9973a", "#57a773", "#b5599b", "#8b7d6b", "#3fa7b5")
"""Told apart in grey and by colour-blind people for the first three, which are as many splits as there usually are."""
_INK = "#010203"
"""Stands for the page's own colour."""
_SIZE_IN = (3.2, 2.2)
_BINS, _MOST_UNIT_BINS = 24, 24
_FEW_EDGES, _BAR_SHARE = 9, 0.7
"""Few bars stand apart, each as wide as this share of its room."""
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
    """The colour of each split in charts, ``#rrggbb``; from the seventh on they come again."""
    return {split: _PALETTE[number % len(_PALETTE)] for number, split in enumerate(splits)}


def histogram(values: Mapping[str, NDArray[np.float64]], title: str) -> str:
    """A histogram of a figure, the splits one upon the other.

    Parameters
    ----------
    values
        The figure of the plans of each split; float64, shape (plans,).
    title
        What the figure is, with its unit.

    Returns
    -------
    str
        An ``svg`` element. The same values give the same text.
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
    """A bar for each kind of plan, the splits one upon the other.

    Parameters
    ----------
    counts
        How many plans of each split are of each kind, the kinds of all splits in the same order.
    title
        What the kinds are.

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
    """Borders of bins: around whole numbers where there are few of them, else evenly spaced."""
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
    """The ``svg`` element of a file alone, in the page's ink, without ids that nothing refers to."""
    svg = svg[svg.index("<svg") :]
    svg = re.sub(r"<metadata>.*?</metadata>\s*", "", svg, flags=re.DOTALL).replace(_INK, "currentColor")
    used = set(re.findall(r"#([\w-]+)", svg))
    svg = re.sub(r' id="([\w-]+)"', lambda found: found[0] if found[1] in used else "", svg)
    return svg.replace("<svg ", f'<svg role="img" aria-label="{title}" ', 1)
