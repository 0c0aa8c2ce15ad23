import numpy as np
import pytest
from support.soak import soak_but

from garage2usd.common.errors import ConfigError
from garage2usd.config import BayConfig, PlanConfig, SiteConfig
from garage2usd.planning import plan_lanes, play, rank_of, tape_at, tape_of
from garage2usd.site import make_site
from garage2usd.structure.grid import Cell, Structure, cells_from_text


def structure(text):
    return Structure.from_arrays(cells_from_text(text, field="S"), 8.1, 8.1)


def bare(plan):
    return plan.with_cells(np.where(plan.cells == Cell.LANE, Cell.FREE, plan.cells).astype(np.int8))


def test_a_tape_by_hand():
    assert tape_of(structure("E==X\n.=..")) == "RDURLS"
    assert tape_of(structure("E=X")) == "RS"
    assert tape_of(structure("E==X")) == "RRLS"
    assert tape_of(structure("E=.X\n.==.")) == "RDRLUS"


def test_the_rank_is_a_base_five_number():
    assert rank_of("RS") == 25 + 3 * 5 + 4
    assert [tape_at(rank_of(tape)) for tape in ("S", "US", "UUS", "RS")] == ["S", "US", "UUS", "RS"]
    assert len({rank_of(tape) for tape in ("S", "US", "UUS")}) == 3
    for rank in (0, -3, 2, 3, 4, 10):
        with pytest.raises(ConfigError):
            tape_at(rank)


@pytest.mark.parametrize("seed", soak_but(12, range(60)))
def test_structures_and_tapes_correspond_one_to_one(seed):
    rng = np.random.default_rng(seed)
    config = SiteConfig(
        height_cells=int(rng.integers(7, 15)),
        width_cells=int(rng.integers(9, 18)),
        rectangles=int(rng.integers(0, 5)),
        entrances=int(rng.integers(1, 3)),
        obstacles=int(rng.integers(0, 2)),
    )
    site = make_site(config, bay=BayConfig(), seed=seed)
    plan = plan_lanes(site, plan=PlanConfig(episodes=100, archive_size=20), bay=BayConfig(), seed=seed)
    tapes = set()
    for entry in plan.archive:
        tape = tape_of(entry.structure)
        tapes.add(tape)
        assert play(site, tape) == entry.structure
        assert play(site, tape_at(rank_of(tape))) == entry.structure
        assert tape_of(play(site, tape)) == tape
    assert len(tapes) == len({entry.structure.digest() for entry in plan.archive}) == len(plan.archive)


@pytest.mark.parametrize(
    ("tape", "field"),
    [
        ("", "tape"),
        ("S", "tape"),
        ("RX", "tape[1]"),
        ("LS", "tape[0]"),
        ("RRRS", "tape[2]"),
        ("RRS", "tape"),
        ("RRLRLS", "tape"),
    ],
)
def test_tapes_that_are_not_canonical_are_refused(tape, field):
    with pytest.raises(ConfigError) as caught:
        play(bare(structure("E==X")), tape)
    assert caught.value.field == field


def test_lanes_that_no_agent_makes_have_no_tape():
    for text in ("E=.=X\n.....", "X=.E\n...."):
        with pytest.raises(ConfigError):
            tape_of(structure(text))
