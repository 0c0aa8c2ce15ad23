"""Fire shutters at the feet of ramps between levels, judged by the written stage."""

import numpy as np
import pytest
from support.level_judge import LevelJudge, above, first_hits
from support.overlaps import Solids
from support.small_levels import SMALL_HELICES, SMALL_LEVELS
from support.soak import soak_but

from garage2usd import GarageConfig, build, generate

GARAGES = {"straight": SMALL_LEVELS, "helix": SMALL_HELICES}


@pytest.fixture(scope="module", params=soak_but(["straight"], GARAGES))
def built(request, tmp_path_factory):
    made = build(GARAGES[request.param], tmp_path_factory.mktemp("shutters") / "garage.usdc")
    return made.garage, LevelJudge(made.stage)


def feet(judge):
    """The landing at the foot of each ramp between levels, (x, y, z), and the direction from there to the ramp."""
    for ramp in judge.ramps():
        places = ramp if ramp[-1, 1] < ramp[0, 1] else ramp[::-1]
        into = (places[-2] - places[-1]) * [1.0, 0.0, 1.0]
        yield places[-1], into / np.linalg.norm(into)


def test_each_ramp_has_one_at_its_foot_that_leaves_the_clear_height_open(built):
    garage, judge = built
    fittings = garage.config.fittings
    shutters = judge.mesh("fire_shutter")
    others = judge.mesh(*{label for _, label in judge.triangles} - {"fire_shutter"})
    found = [*feet(judge)]
    assert len(found) == 2 * (len(judge.names) - 1)
    assert {level for level, label in judge.triangles if label == "fire_shutter"} == set(judge.names[1:])
    for foot, into in found:
        asides_m = np.arange(-3.493, 3.5, 0.02)
        places = foot + asides_m[:, None] * [into[2], 0.0, -into[0]]
        ways = np.tile(into, (len(places), 1))
        closes = first_hits(shutters, above(places, fittings.ceiling_height_m - 0.1), ways)
        opens = first_hits(shutters, above(places, fittings.clear_height_m - 0.01), ways)
        wall = first_hits(others, above(places, fittings.clear_height_m - 0.01), ways)
        is_rail = np.isfinite(opens)
        left, right = asides_m[is_rail & (asides_m < 0)], asides_m[is_rail & (asides_m > 0)]
        assert (np.ptp(left), np.ptp(right)) == pytest.approx((0.08, 0.08), abs=0.021)
        assert right.min() - left.max() > 3.0
        # the rails stand before the wall, and the housing is as wide as both
        assert (wall - opens)[is_rail] == pytest.approx(0.06, abs=1e-4)
        assert (closes[(asides_m >= left.min()) & (asides_m <= right.max())] < 4.1).all()
        assert (wall[(asides_m > left.max() + 0.02) & (asides_m < right.min() - 0.02)] > opens[is_rail].max()).all()


def test_they_touch_nothing_else(built):
    garage, _ = built
    for level in garage.levels:
        clashes = [(first.name, second.name) for first, second in Solids(level.layout).clashes()]
        assert not [names for names in clashes if any(name.startswith("FireShutter") for name in names)]


@pytest.mark.parametrize("fittings", [{"fire_shutters": False}, {"clear_height_m": 2.6, "ceiling_height_m": 2.8}])
def test_there_are_none_without_room_or_where_they_are_switched_off(fittings):
    config = GarageConfig(**{**GARAGES["straight"].model_dump(mode="json"), "fittings": fittings})
    for level in generate(config).levels:
        assert not level.layout.of_kind("fire_shutter")
