import math

import shapely
from hypothesis import given, settings
from hypothesis import strategies as st
from shapely import affinity

from garage2usd.driving import DesignCar, Gear, Manoeuvre, Move, Obstacles, Pose, least_clearance_m

CAR = DesignCar()
places = st.floats(-8, 8)
moves = st.builds(
    Move,
    st.sampled_from(Gear),
    st.sampled_from([0.0, 1 / CAR.rear_axle_radius_m, -1 / CAR.rear_axle_radius_m, 0.1]),
    st.floats(0.01, 5),
)


@st.composite
def shapes(draw):
    """Boxes, triangles, a shape with a notch, lines and points, turned and moved."""
    shape = draw(
        st.sampled_from(
            [
                shapely.box(-0.3, -0.3, 0.3, 0.3),
                shapely.Polygon([(0, 0), (2, 0), (0, 1)]),
                shapely.Polygon([(0, 0), (3, 0), (3, 3), (2, 3), (2, 1), (0, 1)]),
                shapely.box(0, 0, 4, 4).difference(shapely.box(1, 1, 3, 3)),
                shapely.LineString([(0, 0), (1, 2), (3, 2)]),
                shapely.Point(0, 0),
            ]
        )
    )
    turned = affinity.rotate(shape, draw(st.floats(0, 360)), origin=(0, 0))
    return affinity.translate(turned, draw(places), draw(places))


@settings(max_examples=80, deadline=None)
@given(st.lists(moves, min_size=1, max_size=4), shapes(), st.floats(-4, 4))
def test_the_clearance_is_never_more_than_what_a_finely_sampled_drive_keeps(driven, shape, yaw):
    way = Manoeuvre(Pose(0.0, 0.0, yaw), tuple(driven), 0.0)
    stated = least_clearance_m(CAR, way, Obstacles.of([("shape", shape)]), most_m=20.0)
    footprints = shapely.polygons([CAR.corners(at.pose) for at in way.waypoints(0.02)])
    sampled = float(shapely.distance(footprints, shape).min())
    assert stated <= sampled + 1e-9
    # and no less than it must be: a separating axis sees at least cos 45 degrees of a corner's distance
    if sampled > 0.1:
        assert stated >= sampled * math.cos(math.pi / 4) - 0.02


@settings(max_examples=50, deadline=None)
@given(shapes())
def test_the_pieces_of_a_shape_cover_it_and_nothing_else(shape):
    pieces = Obstacles.of([("shape", shape)]).pieces
    together = shapely.union_all([shapely.MultiPoint(piece).convex_hull for piece in pieces])
    assert shapely.hausdorff_distance(together, shape) < 1e-6 or together.symmetric_difference(shape).area < 1e-9
