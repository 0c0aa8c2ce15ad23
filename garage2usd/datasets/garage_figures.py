"""Figures of a garage for its row of the manifest, over all of its levels."""

import math
from collections import Counter
from collections.abc import Iterator, Sequence
from statistics import median_low
from typing import Any

import numpy as np

from garage2usd.garage import LaneGraph, Stall, StallKind, StallUse
from garage2usd.layout import Layout
from garage2usd.pipeline import GarageLevel
from garage2usd.planning import measured_circulation
from garage2usd.report import area_figures

__all__ = ["garage_figures"]

_DIGITS = 6


def garage_figures(levels: Sequence[GarageLevel]) -> dict[str, Any]:
    """Measure the figures of a garage.

    Parameters
    ----------
    levels
        Its levels, the top one first.

    Returns
    -------
    dict
        Fields of `garage2usd.datasets.manifest.ManifestRow`.
    """
    layouts = [level.layout for level in levels]
    stalls = [stall for layout in layouts for stall in layout.quads]
    uses = Counter(stall.use for stall in stalls)
    kinds = Counter(stall.kind for stall in stalls if stall.takes_cars)
    circulations = [measured_circulation(layout.structure) for layout in layouts]
    level_stalls = [layout.parking_stalls for layout in layouts]
    lanes = [_lane_metres(layout.lane_graph) for layout in layouts]
    parked = [nose_out for layout in layouts for nose_out in _nose_out(layout)]
    return {
        "rows": layouts[0].structure.shape[0],
        "cols": layouts[0].structure.shape[1],
        "squares": sum(layout.counts()["floor"] for layout in layouts),
        "levels": len(levels),
        "level_stalls": tuple(level_stalls),
        "stalls": sum(level_stalls),
        "standard_stalls": uses[StallUse.STANDARD],
        "ev_stalls": uses[StallUse.EV],
        "accessible_stalls": uses[StallUse.ACCESSIBLE],
        "angled_stalls": kinds[StallKind.ANGLED],
        "parallel_stalls": kinds[StallKind.PARALLEL],
        **_sizes(layouts),
        "cars": sum(layout.counts()["car"] for layout in layouts),
        "perpendicular_cars": len(parked),
        "nose_out_cars": sum(parked),
        "lanes_m": round(math.fsum(all_m for all_m, _ in lanes), _DIGITS),
        "one_way_lanes_m": round(math.fsum(one_way_m for _, one_way_m in lanes), _DIGITS),
        "loops": sum(found.circulation.loops for found in circulations),
        "longest_dead_end_m": max(found.dead_end_m for found in circulations),
        **{name: area_m2 or 0.0 for name, area_m2 in area_figures(layouts).items()},
        "stair_cores": sum(len(layout.cores) for layout in layouts),
        "mean_lux": _mean_lux(layouts),
    }


def _sizes(layouts: Sequence[Layout]) -> dict[str, float]:
    """Measure the usual size of stalls and the clear width of the aisles in front of them, as medians."""
    pairs = [(layout.lane_graph, stall) for layout in layouts for stall in layout.quads if stall.takes_cars]
    usual = [pair for pair in pairs if pair[1].is_usual] or pairs
    measured = {
        "stall_width_m": [stall.width_m for _, stall in usual],
        "stall_length_m": [stall.length_m for _, stall in usual],
        "aisle_width_m": [lanes.clear_aisle_m(stall.access, stall.outwards) for lanes, stall in usual],
    }
    return {name: round(median_low(values), _DIGITS) for name, values in measured.items() if values}


def _lane_metres(lanes: LaneGraph) -> tuple[float, float]:
    """Return the length of all lanes between two lane nodes, without portals, and that of one-way lanes."""
    inside = [edge for edge in lanes.edges if not lanes.nodes[edge.start].is_portal | lanes.nodes[edge.end].is_portal]
    lengths = [(lanes.length_m(edge.start, edge.end), edge.one_way) for edge in inside]
    return math.fsum(length for length, _ in lengths), math.fsum(length for length, one_way in lengths if one_way)


def _nose_out(layout: Layout) -> Iterator[bool]:
    """Yield for each car in a perpendicular stall whether it stands nose out."""
    rows = layout.cars_in_stalls().tolist()
    for stall, row in zip(layout.quads, rows, strict=True):
        if row >= 0 and stall.takes_cars and stall.kind is StallKind.PERPENDICULAR:
            yield _is_nose_out(stall, float(layout.placements.yaw_rad[row]))


def _is_nose_out(stall: Stall, yaw_rad: float) -> bool:
    return abs(math.remainder(yaw_rad - stall.yaw_rad, math.tau)) > math.pi / 2


def _mean_lux(layouts: Sequence[Layout]) -> float:
    """Return the mean illuminance of stalls, levels weighted by their stalls; 0 without lamps."""
    lit = [(layout.illuminance.stalls.mean, layout.parking_stalls) for layout in layouts if layout.illuminance.stalls]
    total = sum(count for _, count in lit)
    return round(float(np.dot(*np.array(lit).T)) / total, _DIGITS) if total else 0.0
