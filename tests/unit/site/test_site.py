import numpy as np
import pytest

from garage2usd.common.errors import ConfigError, GenerationError
from garage2usd.config import BayConfig, SiteConfig
from garage2usd.site import make_site
from garage2usd.site.contour import inner_squares
from garage2usd.site.portals import straight_frontier
from garage2usd.structure.grid import Cell

BAY = BayConfig()


def mask(*rows):
    return np.array([[character == "." for character in row] for row in rows])


def test_straight_frontier_is_the_contour_without_corners():
    found = straight_frontier(mask(".....", ".....", "....."))
    assert found.tolist() == mask("#...#", ".###.", "#...#").tolist()


def test_reflex_corners_and_their_neighbours_are_no_straight_edge():
    inside = mask("...##", "...##", ".....", ".....", ".....")
    # the square beside the reflex corner has outside squares that are no whole side
    assert not straight_frontier(inside)[2, 2]
    assert not straight_frontier(inside)[2, 3]
    assert straight_frontier(inside)[1, 0]
    # eight neighbours that sum to -3 in another shape: one square in each of three corners
    assert not straight_frontier(mask("#.#", "...", "#.."))[1, 1]


def test_narrow_corridors_have_no_portal_or_inner_square():
    assert not straight_frontier(mask(".....")).any()
    assert straight_frontier(mask(".....", ".....")).any()
    assert not inner_squares(mask(".....", ".....")).any()


def test_given_parts_are_taken():
    site = SiteConfig(
        contour="....\n....\n....\n...#", entrance_cells=((0, 1),), exit_cells=((2, 0),), obstacle_cells=((1, 2),)
    )
    assert str(make_site(site, bay=BAY, seed=0)) == ".E..\n..#.\nX...\n...#"


def test_one_kind_given_the_other_is_drawn():
    cells = make_site(SiteConfig(entrance_cells=((0, 4),)), bay=BAY, seed=3).cells
    assert cells[0, 4] == Cell.ENTRANCE
    ((row, col),) = np.argwhere(cells == Cell.EXIT).tolist()
    assert abs(row) + abs(col - 4) >= 4


@pytest.mark.parametrize(
    ("settings", "field"),
    [
        ({"structure": "E=.\n..."}, "site.structure"),
        ({"structure": "X=.\n..."}, "site.structure"),
        ({"structure": "E=.\n..X"}, "site.structure"),
        ({"structure": "......\n.==E==\n.=..=.\nX====."}, "site.structure"),  # no door: no side on the outside
        ({"structure": "........\n.#E==...\n...=...X\n...=====\n"}, "site.structure"),  # a core is no outside
        ({"structure": "E=#....\n##.....\nE======\n......X"}, "site.structure"),  # no way out
        ({"structure": "X=#....\n##.....\nE======\n......X"}, "site.structure"),  # no way in
        ({"contour": ".....\n.....\n..#..\n.....\n.....", "entrance_cells": ((1, 2),)}, "site.entrance_cells"),
        ({"contour": "..#..\n..#..\n..#.."}, "site.contour"),
        ({"contour": "..E"}, "site.contour"),
        ({"entrance_cells": ((3, 3),)}, "site.entrance_cells"),
        ({"entrance_cells": ((0, 9),)}, "site.entrance_cells"),
        ({"entrance_cells": ((0, 1),), "exit_cells": ((0, 1),)}, "site.exit_cells"),
        ({"exit_cells": ()}, "site.exit_cells"),
        ({"obstacle_cells": ((70, 1),)}, "site.obstacle_cells"),
        ({"structure": "E=X\n...", "width_cells": 9}, "site.width_cells"),
    ],
)
def test_given_parts_that_do_not_fit_are_refused(settings, field):
    with pytest.raises(ConfigError) as caught:
        make_site(SiteConfig(**settings), bay=BAY, seed=0)
    assert caught.value.field == field
    assert "\n" not in str(caught.value)


def test_drawn_portals_open_outwards_not_into_a_court():
    contour = "\n".join(["." * 9] * 3 + ["...###..."] * 3 + ["." * 9] * 3)
    for seed in range(40):
        cells = make_site(SiteConfig(contour=contour), bay=BAY, seed=seed).cells
        rows, cols = np.nonzero(cells >= Cell.ENTRANCE)
        assert ((rows % 8 == 0) | (cols % 8 == 0)).all()


def test_a_portal_between_two_pieces_of_lanes_needs_a_way_on_one_of_them():
    drawing = "=E====X\n#......"
    assert str(make_site(SiteConfig(structure=drawing), bay=BAY, seed=0)) == drawing


def test_unsatisfiable_distances_say_what_was_found():
    with pytest.raises(GenerationError) as caught:
        make_site(SiteConfig(min_portal_distance_cells=40), bay=BAY, seed=7)
    assert caught.value.step == "portals"
    assert caught.value.seed == 7
    assert "24 eligible squares" in str(caught.value)
    with pytest.raises(GenerationError) as caught:
        make_site(SiteConfig(obstacles=9, min_obstacle_distance_cells=5), bay=BAY, seed=7)
    assert caught.value.step == "obstacles"


def test_a_step_moves_no_other():
    plain = make_site(SiteConfig(rectangles=4, width_cells=14, height_cells=12), bay=BAY, seed=5).cells
    with_obstacles = make_site(
        SiteConfig(rectangles=4, width_cells=14, height_cells=12, obstacles=2), bay=BAY, seed=5
    ).cells
    assert (with_obstacles == Cell.OBSTACLE).sum() == (plain == Cell.OBSTACLE).sum() + 2
    changed = plain != with_obstacles
    assert changed.sum() == 2
