"""Level sheets, which are put together by less than any faces are."""

import numpy as np
import pytest
import shapely
from numpy.testing import assert_array_equal

from garage2usd.assets.flat import flat_part, level_triangles
from garage2usd.assets.glyphs import text_shape
from garage2usd.assets.mesh import make_part

_ARRAYS = ("points", "face_counts", "face_indices", "normals", "normal_indices", "st", "st_indices")


@pytest.mark.parametrize("material", ["floor_concrete", "wall_band", "drain_gaps"])
@pytest.mark.parametrize(
    "area",
    [
        shapely.box(-2.65, -3.35, 2.65, 3.35),
        text_shape("8B", 1.2),
        shapely.union_all([shapely.box(0, 0, 1, 1), shapely.box(1.00004, 0.3, 2, 0.7)]),
        shapely.Polygon([(0, 0), (1, 0), (1, 1), (0.5, 0.500002), (0, 1)]).difference(shapely.box(0.2, 0.1, 0.3, 0.2)),
        shapely.union_all([shapely.box(0, 0, 1, 1), shapely.box(2, 0, 3, 2e-6)]),
    ],
    ids=["rectangle", "letters", "two", "hole", "sliver"],
)
def test_a_level_sheet_is_what_its_faces_make(area: shapely.Geometry, material: str) -> None:
    found = flat_part("Sheet", area, material, height_m=0.0031234)
    faces = np.insert(level_triangles(area), 1, 0.0031234, axis=2)
    expected = make_part(
        "Sheet", faces, material, project=lambda corners, _: np.stack([corners[:, 0], -corners[:, 2]], axis=1)
    )
    for name in _ARRAYS:
        assert_array_equal(getattr(found, name), getattr(expected, name), err_msg=name)
        assert getattr(found, name).dtype == getattr(expected, name).dtype
    assert_array_equal(found.normals, [[0.0, 1.0, 0.0]])
    flat_area = found.points[found.face_indices].reshape(-1, 3, 3)[..., [0, 2]]
    assert shapely.union_all(shapely.polygons(flat_area)).area == pytest.approx(area.area, abs=1e-4)
