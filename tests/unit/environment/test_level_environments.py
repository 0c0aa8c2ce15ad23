"""Environments of garages of several levels: one for each level, on the site that a build has there."""

from collections import deque

import gymnasium
import pytest
from gymnasium.utils.env_checker import check_env

import garage2usd
from garage2usd import ConfigError, GarageConfig, GenerationError
from garage2usd.environment import ENVIRONMENT_ID, LanesEnvironment
from garage2usd.planning import tape_of
from garage2usd.structure.grid import NEIGHBOUR_STEPS, Cell

STRAIGHT = {"levels": 2}
HELIX = {"levels": 3, "ramps": "helix"}
LEVELS = [(STRAIGHT, "U1"), (STRAIGHT, "U2"), (HELIX, "U1"), (HELIX, "U2"), (HELIX, "U3")]


def config(building, **changes):
    settings = {
        "seed": 3,
        "site": {"width_cells": 10, "height_cells": 9},
        "bay": {"square_side_m": 8.1, "dimensioned": False},
        "plan": {"episodes": 40, "starts": 1, "climb": False},
        "parking": {"occupancy": 0},
        "building": building,
    }
    return GarageConfig(**{**settings, **changes})


@pytest.fixture(scope="module", params=[STRAIGHT, HELIX], ids=["straight", "helix"])
def made(request):
    return garage2usd.generate(config(request.param))


@pytest.mark.parametrize("preset", ["paper", "tuned"])
@pytest.mark.parametrize(("building", "level"), LEVELS)
def test_gymnasiums_checker_has_nothing_to_say_of_any_level(building, level, preset):
    settings = config(building, plan={"preset": preset})
    made = gymnasium.make(ENVIRONMENT_ID, config=settings, level=level, render_mode="ansi")
    check_env(made.unwrapped)  # a warning is an error


def test_the_site_of_each_level_is_that_of_a_build(made):
    names = [level.name for level in made.levels]
    for name, level in zip(names, made.levels, strict=True):
        environment = LanesEnvironment(made.config, level=name)
        assert environment.process.site == level.site
        assert environment.sites.ramps == made.building.ramps
    assert LanesEnvironment(made.config).process.site == made.levels[0].site


def test_chosen_sides_leave_obstacles_and_portals_those_of_a_build():
    settings = config(HELIX, bay={"square_side_m": 8.1})
    for name, level in zip(("U1", "U2", "U3"), garage2usd.generate(settings).levels, strict=True):
        assert (LanesEnvironment(settings, level=name).process.site.cells == level.site.cells).all()


@pytest.mark.parametrize("dimensioned", [False, True])
@pytest.mark.parametrize("building", [STRAIGHT, HELIX], ids=["straight", "helix"])
def test_episodes_on_each_level_are_a_garage_together(building, dimensioned):
    settings = config(building, bay={"square_side_m": 8.1, "dimensioned": dimensioned})
    names = [f"U{number}" for number in range(1, building["levels"] + 1)]
    environments = [LanesEnvironment(settings, level=name, render_mode="ansi") for name in names]
    for seed, environment in enumerate(environments):
        drive_to_every_portal(environment, seed)
    structures = [environment.structure for environment in environments]
    tape = "/".join([environments[0].sites.ramps.tape, *map(tape_of, structures)])
    made = garage2usd.generate(settings, tape=tape)
    assert [str(level) for level in made.building.levels] == [str(structure) for structure in structures]
    assert made.tape == tape
    assert made.parking_stalls > 20 * len(environments)


def drive_to_every_portal(environment, seed):
    """Drive from the start on shortest ways to a square beside each portal, one after another."""
    site = environment.process.site
    environment.reset(seed=seed)
    (square,) = ((row, line.index("@")) for row, line in enumerate(environment.render().splitlines()) if "@" in line)
    for portal in site.where(Cell.ENTRANCE) + site.where(Cell.EXIT):
        for action in way_to_portal(site, square, portal):
            *_, terminated, truncated, info = environment.step(action)
            assert not terminated
            assert not truncated
            square = ahead(square, action)
    assert info["is_feasible"]


def way_to_portal(site, start, portal):
    """Actions of a shortest way over free squares to one beside a portal."""
    ways = {start: []}
    queue = deque(ways)
    free = set(site.where(Cell.FREE))
    beside = {ahead(portal, action) for action in range(4)} & free
    while queue[0] not in beside:
        square = queue.popleft()
        for action in range(4):
            following = ahead(square, action)
            if following in free and following not in ways:
                ways[following] = [*ways[square], action]
                queue.append(following)
    return ways[queue[0]]


def ahead(square, action):
    return square[0] + NEIGHBOUR_STEPS[action][0], square[1] + NEIGHBOUR_STEPS[action][1]


@pytest.mark.parametrize(
    ("building", "level", "allowed"),
    [({}, "U2", "U1, as building.levels is 1"), (STRAIGHT, "U3", "U1, U2"), (STRAIGHT, "u1", "U1, U2")],
)
def test_a_level_that_is_not_there_is_named(building, level, allowed):
    with pytest.raises(ConfigError, match=allowed) as caught:
        LanesEnvironment(config(building), level=level)
    assert (caught.value.field, caught.value.value) == ("level", level)


def test_what_no_build_of_levels_takes_is_refused():
    with pytest.raises(ConfigError, match="storey_m"):
        LanesEnvironment(config({"levels": 2, "storey_m": 2.7}))
    with pytest.raises(GenerationError, match="find no place"):
        LanesEnvironment(config(HELIX, site={"width_cells": 6, "height_cells": 6}))
    lanes = "..........\nE========X\n..........\n"
    with pytest.raises(ConfigError, match="no lanes"):
        LanesEnvironment(config(STRAIGHT, site={"structure": lanes}))


@pytest.mark.parametrize("level", [None, "U1"])
def test_the_only_level_is_the_garage(level):
    environment = LanesEnvironment(config({}), level=level)
    assert environment.sites.ramps is None
    assert environment.process.site == garage2usd.generate(config({})).site
