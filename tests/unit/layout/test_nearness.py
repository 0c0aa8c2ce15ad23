import numpy as np
import pytest
from scipy.spatial import KDTree

from garage2usd.layout.grounds import Points, distances_m


@pytest.mark.parametrize("norm", [1, 2])
@pytest.mark.parametrize("step_m", [0.001, 1.0])  # whole metres: many lie just at the end of the reach
def test_pairs_within_reach_are_those_of_scipy(norm, step_m):
    rng = np.random.default_rng(0)
    points, places = (np.round(rng.uniform(0, 60, size=(count, 2)) / step_m) * step_m for count in (300, 200))
    place, point, far_m = Points(points).within(5.0, places, norm=norm)
    expected = KDTree(points).query_ball_point(places, 5.0, p=norm)
    found = [sorted(point[place == number].tolist()) for number in range(len(places))]
    assert found == [sorted(each) for each in expected]
    assert any(found)
    assert (np.diff(place) >= 0).all()
    assert far_m == pytest.approx(np.linalg.norm(places[place] - points[point], ord=norm, axis=1))


def test_the_nearest_point_is_as_far_as_scipy_says():
    rng = np.random.default_rng(1)
    points, places = (rng.uniform(0, 60, size=(count, 2)) for count in (40, 500))
    assert Points(points).nearest_m(places) == pytest.approx(KDTree(points).query(places)[0])
    assert Points([(0, 0), (9, 9)]).nearest_m(np.array([[3.0, 4.0]])).tolist() == [5.0]


def test_one_point_is_near_by_its_distance():
    assert distances_m(np.array([0.0, 0.0]), np.array([[3.0, 4.0], [1.0, 0.0]])).tolist() == [5.0, 1.0]
    assert distances_m(np.array([0.0, 0.0]), np.array([[3.0, -4.0]]), norm=1).tolist() == [7.0]
    assert [part.size for part in Points([]).within(1.0, np.zeros((2, 2)))] == [0, 0, 0]
