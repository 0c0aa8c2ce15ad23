"""The proven optimum against exhaustive search with bit sets."""

import numpy as np
import pytest
from support.planning_reference import BAY, G1, G2, G3, OPTIMUM, drawn, feasible

from garage2usd.common.errors import ConfigError, GenerationError
from garage2usd.config import BayConfig, PlanConfig
from garage2usd.config.site import DEFAULT_SIDE_M
from garage2usd.planning import evaluate, find_optimum, optimum
from garage2usd.planning.circulation import circulation, rules_of
from garage2usd.structure.grid import Structure
from garage2usd.structure.stalls import capacity_table

BAYS = [BAY, BayConfig(column_widths_m=5.5, row_depths_m=8.1), BayConfig(column_widths_m=8.1, row_depths_m=16.2)]

FORBID = "forbid"
RULES = (None, FORBID, 0, 1, 2)
ROOMY = {(3, 7): (2, (*range(200, 216), 271, 311)), (4, 5): (2, (*range(200, 210), 228)), (5, 5): (6, (264, 290))}


def small_site(seed):
    """3x4 to 4x5 squares, one or two of each portal on the rim, perhaps an obstacle; the bay changes too."""
    rng = np.random.default_rng(seed)
    cells = np.zeros((int(rng.integers(3, 5)), int(rng.integers(4, 6))), dtype=np.int8)
    rim = [place for place in np.ndindex(cells.shape) if 0 in place or place[0] == cells.shape[0] - 1]
    rng.shuffle(rim)
    for place, kind in zip(rim, [2, 3, *rng.choice([2, 3, 0, -1], size=2)], strict=False):
        cells[place] = kind
    return in_bays(cells, seed)


def roomy_site(seed, shape, obstacles):
    """An entrance and an exit on the rim and obstacles anywhere; on some seeds deeper dead ends make better plans."""
    rng = np.random.default_rng(seed)
    cells = np.zeros(shape, dtype=np.int8)
    last = (shape[0] - 1, shape[1] - 1)
    rim = [place for place in np.ndindex(shape) if 0 in place or place[0] == last[0] or place[1] == last[1]]
    rng.shuffle(rim)
    cells[rim[0]], cells[rim[1]] = 2, 3
    free = [place for place in np.ndindex(shape) if cells[place] == 0]
    rng.shuffle(free)
    for place in free[:obstacles]:
        cells[place] = -1
    return in_bays(cells, seed)


def in_bays(cells, seed):
    bay = BAYS[seed % len(BAYS)]
    return Structure.from_arrays(cells, bay.column_widths_m or DEFAULT_SIDE_M, bay.row_depths_m or DEFAULT_SIDE_M), bay


CASES = {f"small {seed}": small_site(seed) for seed in range(30)} | {
    f"{shape[0]} x {shape[1]} {seed}": roomy_site(seed, shape, obstacles)
    for shape, (obstacles, seeds) in ROOMY.items()
    for seed in seeds
}


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


def cores(lanes, anchors, beside):
    """What pruning leaves of the lanes before its first round, after it, and so on until it stays."""
    left = [lanes]
    while True:
        kept, rest = 0, left[-1]
        while rest:
            low = rest & -rest
            rest ^= low
            if (beside[low] & (left[-1] | anchors)).bit_count() > 1:
                kept |= low
        if kept == left[-1]:
            return left
        left.append(kept)


def keeps(rule, lanes, portals, beside, blocks):
    """Whether lanes keep a rule: its depth of dead ends, or FORBID for none, with or without loops."""
    if rule is None:
        return True
    if any(lanes & block == block for block in blocks):
        return False
    if rule is not FORBID and not cores(lanes, 0, beside)[-1]:
        return False
    return len(cores(lanes, portals, beside)) - 1 <= (0 if rule is FORBID else rule)


def exhaustive(site, bay):
    """Best y' of all sets of lanes under each of RULES, without those that none keeps; lanes are bits of a number."""
    bit = {place: 1 << index for index, place in enumerate(np.ndindex(site.shape))}
    around = {
        place: [bit.get((place[0] + dr, place[1] + dc), 0) for dr, dc in ((-1, 0), (1, 0), (0, -1), (0, 1))]
        for place in bit
    }
    beside = {bit[place]: sum(around[place]) for place in bit}
    free = [place for place in bit if site.cells[place] == 0]
    anchors = sum(bit[place] for place in bit if site.cells[place] >= 2)
    corners = {place: [bit.get((place[0] + dr, place[1] + dc), 0) for dr, dc in np.ndindex(2, 2)] for place in bit}
    blocks = [sum(squares) for squares in corners.values() if all(squares)]
    portals = [sum(around[place]) for place in bit if site.cells[place] >= 2]
    gate = sum({low for place in bit if site.cells[place] == 2 for low in around[place]})
    table = capacity_table(site, bay)
    along_x = {place: (0, table.along_x[place], table.along_x_double[place]) for place in free}
    along_z = {place: (0, table.along_z[place], table.along_z_double[place]) for place in free}
    best, everything = {}, sum(bit[place] for place in free)
    lanes = everything
    while lanes := (lanes - 1) & everything:
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
        if not stalls:
            continue
        value = stalls - 5 * time / stalls - unused
        for rule in RULES:
            if value > best.get(rule, -np.inf) and keeps(rule, lanes, anchors, beside, blocks):
                best[rule] = value
    return best


def planned(rule):
    """The settings that ask for one of RULES."""
    if rule is None or rule is FORBID:
        return PlanConfig(circulation="allow", dead_ends="allow" if rule is None else "forbid")
    return PlanConfig(circulation="loops", dead_end_cells=rule)


@pytest.mark.parametrize("name", CASES)
def test_equals_exhaustive_search(name):
    site, bay = CASES[name]
    expected = exhaustive(site, bay)
    for rule in RULES:
        if rule not in expected:
            with pytest.raises(GenerationError, match="no structure with a stall keeps the rules"):
                find_optimum(site, bay=bay, plan=planned(rule))
            continue
        result = find_optimum(site, bay=bay, plan=planned(rule))
        assert result.score.value == pytest.approx(expected[rule]), rule
        assert feasible(result.structure.cells)
        assert not circulation(result.structure).faults(rules_of(planned(rule), squares=20))


# proven by another program, with dead ends of up to so many squares
UNDER_RULES = {
    ("G1", 0): 66.7647,
    ("G2", 0): 69.1471,
    ("G3", 0): 64.8182,
    ("G1", 2): 69.8571,
    ("G2", 2): 71.7059,
    ("G3", 2): 71.0,
}


@pytest.mark.parametrize(("gate", "depth"), UNDER_RULES)
def test_gate_under_the_rules(gate, depth):
    site = {"G1": G1, "G2": G2, "G3": G3}[gate]
    result = find_optimum(site, bay=BAY, plan=planned(depth))
    assert result.score.value == pytest.approx(UNDER_RULES[gate, depth], abs=1e-4)
    assert feasible(result.structure.cells)
    assert not circulation(result.structure).faults(rules_of(planned(depth), squares=61))


COMB = "\n".join([".=..=..=."] * 5 + [".=======.", "..E...X.."])


def test_gate_from_a_worse_start():
    result = find_optimum(G1, bay=BAY, known=drawn(COMB))
    assert result.score.value == pytest.approx(OPTIMUM["G1"], abs=1e-4)
    assert result.layouts_scored > 0
    assert result.score == evaluate(result.structure, bay=BAY)
    assert feasible(result.structure.cells)


def test_start_that_is_the_optimum_stays():
    best = find_optimum(G1, bay=BAY).structure
    assert find_optimum(G1, bay=BAY, known=best).structure is best


def test_start_that_breaks_a_rule_is_left_aside():
    result = find_optimum(G1, bay=BAY, plan=planned(0), known=drawn(COMB))
    assert result.score.value == pytest.approx(UNDER_RULES["G1", 0], abs=1e-4)


def test_weights_of_the_plan_count():
    plan = PlanConfig(circulation="allow", parking_time_weight=-20.0, unused_weight=0.0)
    site, bay = CASES["small 16"]
    result = find_optimum(site, bay=bay, plan=plan)
    assert result.score == evaluate(result.structure, bay=bay, plan=plan)
    least = find_optimum(site, bay=bay).structure
    assert result.score.value > evaluate(least, bay=bay, plan=plan).value


@pytest.mark.parametrize(("side", "rule", "most"), [(13, None, 12), (11, 2, 10), (11, 4, 8)])
def test_too_large(side, rule, most):
    site = Structure.from_arrays(np.full((side, side), 0, dtype=np.int8), 8.1, 8.1)
    with pytest.raises(ConfigError, match=rf"{side} x {side} squares.*a side of at most {most}"):
        find_optimum(site, bay=BAY, plan=planned(rule))


def test_stretches_are_not_known():
    with pytest.raises(ConfigError, match=r"plan\.longest_stretch_cells.*R1 to R3"):
        find_optimum(G1, bay=BAY, plan=PlanConfig(longest_stretch_cells=12))


@pytest.mark.parametrize(
    ("limit", "most", "allowed"),
    [("_MAX_FRONTIERS", 1000, "at most 1000 frontiers"), ("_MAX_BATCHES", 1, "which 50 steps enumerate the layouts")],
)
def test_a_proof_that_would_take_too_long_is_refused(monkeypatch, limit, most, allowed):
    monkeypatch.setattr(optimum, "_STEPS", 50)
    monkeypatch.setattr(optimum, limit, most)
    with pytest.raises(ConfigError, match=rf"^site: got '7 x 9 squares'; allowed: .*{allowed}.*, for a proven optimum"):
        find_optimum(G1, bay=BAY)


def test_the_proof_is_the_same_in_steps_of_any_size(monkeypatch):
    whole = find_optimum(G2, bay=BAY, plan=planned(2))
    steps = []
    monkeypatch.setattr(optimum, "_STEPS", 7)
    monkeypatch.setattr(optimum, "_MAX_BATCHES", 10**9)
    in_steps = find_optimum(G2, bay=BAY, plan=planned(2), progress=lambda *told: steps.append(told))
    assert in_steps.structure == whole.structure
    assert in_steps.layouts_scored == whole.layouts_scored > 0
    assert {step for step, _, _ in steps} == {"frontiers", "suffixes", "layouts"}
    assert all(done <= total for _, done, total in steps)


def test_lanes_on_the_site_are_free_squares():
    lanes = find_optimum(drawn(COMB), bay=BAY)
    assert lanes.structure == find_optimum(G1, bay=BAY).structure
