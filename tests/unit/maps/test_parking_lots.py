"""Parking lots of Lanelet2 maps: the ground of stalls, whether they share their sides or lie over each other."""

import pytest
import shapely

from garage2usd.layout.grounds import grounds_of
from garage2usd.maps.lanelet2_parking import Feet, add_lots
from garage2usd.maps.osm_file import OsmFile


class Polygons(OsmFile):
    """Takes what a map would write."""

    def __init__(self):
        super().__init__(49.0, 9.0)
        self.found = []

    def polygon(self, points, tags):
        assert tags == {"type": "parking_lot"}
        self.found.append(shapely.Polygon([self.place(point)[:2] for point in points]))


@pytest.mark.parametrize(
    "stalls",
    [
        [(0, 0, 2.5, 5), (2.5, 0, 5, 5), (10, 0, 12.5, 5)],
        [(0, 0, 2.5, 5), (2.4, 0, 5, 5), (10, 0, 12.5, 5)],
        [(0, 0, 2.5, 5), (0, 0, 2.5, 5)],
        [(0, 0, 2.5, 5), (2.5, 1, 5, 4)],
        [(0, 0, 2.5, 5), (2.5, 1, 5, 4), (2.5, 4, 5, 7), (0, 5.0001, 2.5, 7)],
    ],
    ids=["side by side", "over each other", "twice the same", "beside a part of the other's side", "a narrow gap"],
)
def test_a_lot_is_the_ground_of_its_stalls(stalls):
    boxes = [shapely.box(*stall) for stall in stalls]
    osm = Polygons()
    feet = Feet(osm, [])
    feet.grounds = grounds_of([shapely.get_coordinates(box)[:-1] for box in boxes])
    add_lots(osm, [], feet)
    ground = shapely.union_all(boxes)
    assert len(osm.found) == len(shapely.get_parts(ground))
    assert all(lot.is_valid for lot in osm.found)
    assert shapely.symmetric_difference(shapely.union_all(osm.found), ground).area == pytest.approx(0, abs=1e-3)
