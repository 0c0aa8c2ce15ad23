"""Garages of all kinds in operation for 25 minutes, judged by exact outlines at 20 Hz."""

import pytest
from support.tracks_judge import judge

from garage2usd import GarageConfig, generate
from garage2usd.config.traffic import TrafficConfig
from garage2usd.garage_sources import built_source
from garage2usd.profiles import PROFILE_NAMES
from garage2usd.traffic import Operation

_MEETINGS, _TURNOVER, _STUCK = 20, 35, 0.12
"""At most a hundredth of the agents should wait for over three minutes; on two levels a tenth does today."""
_MIXED = {"kinds": {"perpendicular": 0.4, "angled": 0.4, "parallel": 0.2}, "sizes": {"standard": 0.8, "large": 0.2}}


def settings(seed):
    is_mixed, levels = seed % 4 == 2, 2 if seed % 4 == 3 else 1
    return GarageConfig(
        seed=seed,
        profile=PROFILE_NAMES[seed // 4 % len(PROFILE_NAMES)],
        site={"width_cells": 13 + seed % 3, "height_cells": 10 + seed % 2, "obstacles": seed % 3},
        building={"levels": levels},
        parking={"occupancy": 0.9 if seed == 1 else 0.65},
        plan={"aisles": "one-way"} if is_mixed else {},
        stalls=_MIXED if is_mixed else {},
    )


@pytest.mark.soak
@pytest.mark.parametrize("seed", range(4))
def test_a_busy_garage_flows_and_nothing_touches(seed):
    garage = built_source(generate(settings(seed)), source=f"seed {seed}").garage
    tracks = Operation(garage).run(TrafficConfig(minutes=25, arrivals_per_hour=120), seed=seed)
    verdict = judge(tracks, garage, own=list(tracks.facts["cars_of_people"].items()))
    assert [str(touch) for touch in verdict.overlaps] == []
    assert verdict.meetings >= _MEETINGS
    assert min(tracks.facts["arrivals"], tracks.facts["departures"]) >= _TURNOVER
    standing = sum("has stood" in line for line in tracks.log)
    assert tracks.facts["stuck"] + standing <= _STUCK * len(tracks)
