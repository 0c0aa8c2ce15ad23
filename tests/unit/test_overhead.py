"""Exact boxes of every piece of every mesh: nothing overhead meets anything, nothing hangs below the clear height."""

import numpy as np
import pytest
from sample_files import each_sample
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components

from garage2usd.config import GarageConfig, load_config
from garage2usd.grid import Structure, cells_from_text
from garage2usd.lanes import build_lane_graph
from garage2usd.layout import ObjectKind, lay_out
from garage2usd.layout.specs import Turn
from garage2usd.pipeline import generate
from garage2usd.stage.prototypes import asset_of

HANGING = (ObjectKind.LIGHT, ObjectKind.DUCT, ObjectKind.SPRINKLER, ObjectKind.EXIT_SIGN)
SOLID = (*HANGING, ObjectKind.MIRROR, ObjectKind.COLUMN, ObjectKind.BARRIER, ObjectKind.CAR)
TOUCH_M = 1e-4


def pieces(spec):
    """Points of each connected piece of each part."""
    for part in asset_of(spec).parts:
        loops = np.split(part.face_indices, np.cumsum(part.face_counts)[:-1])
        edges = np.concatenate([np.stack([loop, np.roll(loop, -1)], axis=1) for loop in loops])
        size = len(part.points)
        count, label = connected_components(coo_array((np.ones(len(edges)), edges.T), (size, size)), directed=False)
        yield from (part.points[label == index] for index in range(count))


def boxes(placements):
    """float64, shape (B, 2, 3), and the placement of each box."""
    known, found, owners = {}, [], []
    for index, place in enumerate(placements):
        if place.spec not in known:
            known[place.spec] = list(pieces(place.spec))
        cos, sin = np.cos(place.yaw_rad), np.sin(place.yaw_rad)
        turn = np.array([[cos, 0, -sin], [0, 1, 0], [sin, 0, cos]])
        for points in known[place.spec]:
            world = points @ turn + np.array(place.position_m)
            found.append((world.min(axis=0), world.max(axis=0)))
            owners.append(index)
    return np.array(found), np.array(owners)


def clashes(placements):
    found, owners = boxes(placements)
    order = np.argsort(found[:, 0, 0])
    found, owners = found[order], owners[order]
    for i, (low, high) in enumerate(found):
        end = np.searchsorted(found[:, 0, 0], high[0] - TOUCH_M)
        other = found[i + 1 : end]
        meets = ((other[:, 0] < high - TOUCH_M) & (other[:, 1] > low + TOUCH_M)).all(axis=1)
        for j in np.flatnonzero(meets) + i + 1:
            first, second = placements[owners[i]], placements[owners[j]]
            if owners[i] != owners[j] and not {first.kind, second.kind} <= {ObjectKind.DUCT}:
                yield first, second


def checked(layout, config):
    placements = [place for place in layout.placements if place.kind in SOLID]
    assert not [(a.name, a.square, b.name, b.square) for a, b in clashes(placements)]
    hanging = [place for place in placements if place.kind in HANGING]
    found, owners = boxes(hanging)
    lowest = found[:, 0, 1]
    assert lowest.min() >= config.fittings.clear_height_m - TOUCH_M, hanging[owners[lowest.argmin()]]
    assert found[:, 1, 1].max() <= layout.ceiling_height_m + TOUCH_M


@each_sample
def test_nothing_overhead_meets_anything_or_hangs_into_the_way(sample):
    config = load_config(sample)
    checked(generate(config).layout, config)


def laid_out(text, **fittings):
    config = GarageConfig(fittings=fittings)
    structure = Structure.from_arrays(cells_from_text(text, field="S"), 8.1, 8.1)
    return lay_out(structure, build_lane_graph(structure, config.bay), config), config


CROSS = """
..=..=..
E======X
..=..=..
.=====..
"""


@pytest.mark.parametrize("ceiling_m", [2.4, 3.2, 4.0])
def test_any_ceiling_leaves_the_clear_height(ceiling_m):
    layout, config = laid_out(CROSS, ceiling_height_m=ceiling_m, ducts=ceiling_m > 3)
    checked(layout, config)
    assert bool(layout.of_kind(ObjectKind.EXIT_SIGN)) == (ceiling_m > 3)


def test_exit_signs_point_to_the_exit():
    layout, _ = laid_out(CROSS)
    turns = {(place.square, place.name): place.spec.turn for place in layout.of_kind(ObjectKind.EXIT_SIGN)}
    assert turns[(1, 2), "ExitSign_Left"] is Turn.AHEAD
    assert turns[(1, 2), "ExitSign_Down"] is Turn.RIGHT  # driving up, the exit lies on the right
    assert turns[(1, 5), "ExitSign_Up"] is Turn.LEFT


def test_every_junction_with_a_column_has_a_mirror_on_it():
    layout, _ = laid_out(CROSS)
    columns = [place.position_m for place in layout.of_kind(ObjectKind.COLUMN)]
    placed = layout.of_kind(ObjectKind.MIRROR)
    assert {place.square for place in placed} >= {(1, 2), (1, 5)}
    for place in placed:
        x, _, z = place.position_m
        assert min(np.hypot(x - cx, z - cz) for cx, _, cz in columns) < 0.7
