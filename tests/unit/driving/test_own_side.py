"""Cars drive on their own half of two-way aisles, and cross the middle only to turn in or out; judged by outlines."""

import numpy as np
import pytest
from support.side_judge import shares, total

import garage2usd
from garage2usd.as_built.garage import garage_as_made
from garage2usd.common.errors import ConfigError
from garage2usd.driving import DesignCar
from garage2usd.maps.drives import DrivePlanner
from garage2usd.maps.narrow_aisles import narrow_aisles

DRAWN = "##########\nE====....#\n#..=.....X\n#..=======\n#..=.....#\n#..=.....#\n##########\n"
WIDE = [("cn-jgj100", 1), ("cn-jgj100", 3), ("cn-jgj100", 11), ("us-ada", 4), ("us-ada", 8), ("de-garvo", 5)]
WIDE += [("uk-istructe", 2), ("uk-istructe", 3)]


def judged(built, drives):
    """The shares of some drives of a garage, and those with the side taken for the other."""
    planner, names = DrivePlanner(built), [stall.name for stall in built.stalls if stall.takes_cars]
    names = [names[number] for number in np.random.default_rng(0).permutation(len(names))]
    keeps_left, routes = planner.keeps_left, []
    for name in names:
        try:
            routes.append(planner.route(name))
        except ConfigError:
            continue
        if len(routes) == drives:
            break
    return [[shares(route, built, keeps_left=side) for route in routes] for side in (keeps_left, not keeps_left)]


def made(**settings):
    return garage_as_made(garage2usd.generate(garage2usd.GarageConfig(**settings)), source="garage", kind="plan")


@pytest.mark.parametrize("profile", ["cn-jgj100", "uk-istructe"])
def test_cars_keep_to_their_half_of_a_small_garage(profile):
    own, other = judged(made(profile=profile, site={"structure": DRAWN}, seed=3), 6)
    # of six drives one may find no way on its half over two bends close to each other
    assert total(own).share >= 0.8, total(own).strays
    assert total(own).judged_m > 30
    assert total(other).share < 0.1  # the judge tells the sides apart


def test_aisles_without_room_for_two_cars_are_named():
    built = made(site={"structure": DRAWN}, seed=3)
    drive = DrivePlanner(built).drive()
    assert drive.narrow_aisles == ()
    wide = narrow_aisles(drive.route.arrival, built.levels[0].lanes, DesignCar(width_m=2.7))
    names = {node.name for node in built.levels[0].lanes.nodes}
    assert wide
    assert all({aisle.start, aisle.end} <= names and str(aisle).endswith(", 6.00 m") for aisle in wide)


@pytest.mark.soak
def test_cars_keep_to_their_half_on_over_a_hundred_drives_of_eight_garages():
    found = []
    for profile, seed in WIDE:
        own, _ = judged(made(profile=profile, seed=seed), 13)
        assert total(own).share >= 0.85, (profile, seed, total(own).strays)
        found += own
    assert len(found) >= 100
    assert total(found).judged_m > 0.15 * total(found).driven_m
    assert total(found).share >= 0.95
