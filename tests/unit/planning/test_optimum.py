"""The proven optimum against exhaustive search with bit sets."""

import numpy as np
import pytest
from planning_reference import BAY, G1, OPTIMUM, drawn, feasible

from garage2usd.config import BayConfig, PlanConfig
from garage2usd.config.site import DEFAULT_SIDE_M
from garage2usd.errors import ConfigError
from garage2usd.grid import Structure
from garage2usd.planning import evaluate, plan_lanes
from garage2usd.planning.optimum import find_optimum
from garage2usd.stalls import capacity_table

BAYS = [BAY, BayConfig(column_widths_m=5.5, row_depths_m=8.1), BayConfig(column_widths_m=8.1, row_depths_m=16.2)]


def small_site(seed):
    """3x4 to 4x5 squares, one or two of each portal on the rim, perhaps an obstacle; the bay changes too."""
    rng = np.random.default_rng(seed)
    cells = np.zeros((int(rng.integers(3, 5)), int(rng.integers(4, 6))), dtype=np.int8)
    rim = [place for place in np.ndindex(cells.shape) if 0 in place or place[0] == cells.shape[0] - 1]
    rng.shuffle(rim)
    for place, kind in zip(rim, [2, 3, *rng.choice([2, 3, 0, -1], size=2)], strict=False):
        cells[place] = kind
    bay = BAYS[seed % len(BAYS)]
    return Structure.from_arrays(cells, bay.column_widths_m or DEFAULT_SIDE_M, bay.row_depths_m or DEFAULT_SIDE_M), bay


def spread(start, lanes, beside):
    """Bit sets of the lanes by breadth-first distance from a set."""
    shells, seen = [], 0
    while start:
        shells.append(start)
        seen |= start
        grown = 0
        while start:
            low = start & -start
            grown |= beside[low]
            start ^= low
        start = grown & lanes & ~seen
    return shells, seen


def exhaustive(site, bay):
    """Best y' of all sets of lanes, or None; lanes are bits of a number."""
    bit = {place: 1 << index for index, place in enumerate(np.ndindex(site.shape))}
    around = {
        place: [bit.get((place[0] + dr, place[1] + dc), 0) for dr, dc in ((-1, 0), (1, 0), (0, -1), (0, 1))]
        for place in bit
    }
    beside = {bit[place]: sum(around[place]) for place in bit}
    free = [place for place in bit if site.cells[place] == 0]
    portals = [sum(around[place]) for place in bit if site.cells[place] >= 2]
    gate = sum({low for place in bit if site.cells[place] == 2 for low in around[place]})
    table = capacity_table(site, bay)
    along_x = {place: (0, table.along_x[place], table.along_x_double[place]) for place in free}
    along_z = {place: (0, table.along_z[place], table.along_z_double[place]) for place in free}
    best = None
    for chosen in range(1, 1 << len(free)):
        lanes = sum(bit[place] for index, place in enumerate(free) if chosen >> index & 1)
        if not all(lanes & portal for portal in portals):
            continue
        shells, seen = spread(lanes & gate, lanes, beside)
        if seen != lanes or spread(lanes & -lanes, lanes, beside)[1] != lanes:
            continue
        stalls = time = unused = 0
        for place in free:
            if lanes & bit[place]:
                continue
            up, down, left, right = (bool(lanes & other) for other in around[place])
            count = max(along_x[place][up + down], along_z[place][left + right])
            stalls += count
            unused += count == 0
            if count:
                time += count * (2 + min(hop for hop, shell in enumerate(shells) if shell & beside[bit[place]]))
        if stalls:
            value = stalls - 5 * time / stalls - unused
            best = value if best is None else max(best, value)
    return best


# on site 24 no feasible structure holds a stall
@pytest.mark.parametrize("seed", [*range(24), *range(25, 31)])
def test_equals_exhaustive_search(seed):
    site, bay = small_site(seed)
    expected = exhaustive(site, bay)
    assert expected is not None
    start = plan_lanes(site, plan=PlanConfig(preset="paper", episodes=20, climb=False), bay=bay, seed=seed)
    result = find_optimum(site, bay=bay, known=start.structure)
    assert result.score.value == pytest.approx(expected)
    assert feasible(result.structure.cells)


def test_gate_from_a_worse_start():
    comb = "\n".join([".=..=..=."] * 5 + [".=======.", "..E...X.."])
    result = find_optimum(G1, bay=BAY, known=drawn(comb))
    assert result.score.value == pytest.approx(OPTIMUM["G1"], abs=1e-4)
    assert result.layouts_scored > 0
    assert result.score == evaluate(result.structure, bay=BAY)
    assert feasible(result.structure.cells)


def test_too_large():
    site = Structure.from_arrays(np.full((13, 13), 0, dtype=np.int8), 8.1, 8.1)
    with pytest.raises(ConfigError, match="13 x 13 squares"):
        find_optimum(site, bay=BAY)
