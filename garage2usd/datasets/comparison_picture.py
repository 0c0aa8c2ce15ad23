"""Picture of a comparison: the published distribution of each quantity and that of the data set."""

from pathlib import Path
from typing import Any

import numpy as np

from garage2usd.common.package import of_extra
from garage2usd.datasets.comparison import Compared, Comparison
from garage2usd.datasets.published import Between, Quantiles

with of_extra("the picture of a comparison"):
    import matplotlib as mpl
    from matplotlib.axes import Axes
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.figure import Figure
    from matplotlib.ticker import MaxNLocator, PercentFormatter

PICTURE_SUFFIXES = (".png", ".svg")
_COLUMNS = 4
_PANEL_IN = (3.1, 2.4)
_DPI = 110
_REAL, _DATA = "#4878a8", "#d9973a"
_SETTINGS: dict[Any, Any] = {
    "svg.hashsalt": "garage2usd",
    "font.family": "DejaVu Sans",
    "font.size": 8,
    "axes.spines.top": False,
    "axes.spines.right": False,
}
_CURVE_POINTS = 200


def draw_comparison(comparison: Comparison, path: Path) -> None:
    """Draw a comparison as PNG or SVG, by the extension of the file.

    Parameters
    ----------
    comparison
        The comparison.
    path
        The file, which is written directly.

    Notes
    -----
    A distribution is drawn as the share of garages below each value, with the published quantiles as dots; shares are
    bars. The same comparison gives the same bytes with the same version of matplotlib.
    """
    rows = -(-len(comparison.quantities) // _COLUMNS)
    with mpl.rc_context(_SETTINGS):
        figure = Figure(figsize=(_COLUMNS * _PANEL_IN[0], rows * _PANEL_IN[1] + 0.5), layout="constrained", dpi=_DPI)
        FigureCanvasAgg(figure)
        panels = np.asarray(figure.subplots(rows, _COLUMNS, squeeze=False)).ravel().tolist()
        for axes, compared in zip(panels, comparison.quantities, strict=False):
            (_draw_shares if compared.is_of_shares else _draw_distribution)(axes, compared)
            axes.set_title(_title(compared), fontsize=8.5, loc="left")
        for axes in panels[len(comparison.quantities) :]:
            axes.set_axis_off()
        handles = [mpl.patches.Patch(color=_REAL, label="published (* in part assumed)")]
        handles.append(mpl.patches.Patch(color=_DATA, label=f"data set, {comparison.garages} garages"))
        figure.legend(handles=handles, loc="outside upper center", ncols=2, frameon=False, fontsize=9)
        is_svg = path.suffix.lower() == ".svg"
        metadata = {"Date": None, "Creator": None} if is_svg else {"Software": None}
        figure.savefig(path, format="svg" if is_svg else "png", metadata=metadata)


def _draw_distribution(axes: Axes, compared: Compared) -> None:
    published, values = compared.published.distribution, compared.values
    if published is None:
        return
    between = compared.published.between
    ends = [published.quantile(share) for share in (0.1, 0.9)] if between is None else [between.low, between.high]
    low, high = min(filter(None, ends), default=0.0), max(filter(None, ends), default=1.0)
    left, right = max(low - 0.6 * (high - low), 0.0), high + 0.6 * (high - low)
    if isinstance(published, Between):
        axes.axvspan(published.low, published.high, color=_REAL, alpha=0.3, linewidth=0)
    elif isinstance(published, Quantiles):
        axes.plot(published.values, published.shares, color=_REAL, marker="o", markersize=3.5, linewidth=1.5)
    else:
        places = np.linspace(left, right, _CURVE_POINTS)
        axes.plot(places, published.share_below(places), color=_REAL, linewidth=1.5)
    if len(values):
        axes.step(
            [left, *values, right], [0, *np.arange(1, len(values) + 1) / len(values), 1], color=_DATA, where="post"
        )
    axes.set_xlim(left, right)
    axes.set_ylim(0, 1)
    axes.yaxis.set_major_formatter(PercentFormatter(1))
    axes.xaxis.set_major_locator(MaxNLocator(nbins=5))
    if compared.published.unit:
        axes.set_xlabel(compared.published.unit)


def _draw_shares(axes: Axes, compared: Compared) -> None:
    known, found = compared.published.shares or {}, compared.shares
    places = np.arange(len(known))
    axes.bar(places - 0.2, list(known.values()), 0.38, color=_REAL)
    axes.bar(places + 0.2, [found.get(name, 0.0) for name in known], 0.38, color=_DATA)
    axes.set_xticks(places, list(known))
    axes.set_ylim(0, 1)
    axes.yaxis.set_major_formatter(PercentFormatter(1))


def _title(compared: Compared) -> str:
    mark = "*" if compared.published.assumption else ""
    if compared.distance is None:
        return f"{compared.published.title}{mark}: no data"
    far = f"{compared.distance:.1f} points" if compared.is_of_shares else f"{compared.distance:.3f}"
    return f"{compared.published.title}{mark}: {far}"
