import numpy as np
import pytest
from scipy.interpolate import PchipInterpolator

from garage2usd.assets.car_shell import MonotoneCurve


@pytest.mark.parametrize("heights", ["any", "rising", "level in places"])
@pytest.mark.parametrize("count", [3, 4, 9])
def test_is_the_curve_of_scipy(heights, count):
    rng = np.random.default_rng(count)
    draw = {
        "any": rng.normal,
        "rising": lambda size: np.cumsum(rng.random(size)),
        "level in places": lambda size: rng.integers(-1, 2, size).astype(float),
    }[heights]
    for _ in range(50):
        x, y = np.cumsum(rng.random(count) + 0.01), draw(size=count)
        places = np.concatenate([x, rng.uniform(x[0] - 0.5, x[-1] + 0.5, 20)])
        assert (MonotoneCurve(x, y)(places) == PchipInterpolator(x, y)(places)).all()


def test_one_place_has_one_height():
    assert float(MonotoneCurve([0, 1, 2], [0, 1, 4])(1)) == 1
