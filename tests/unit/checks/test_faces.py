"""The faces of placed meshes, compared with those that trimesh finds in the same ones."""

import numpy as np
import pytest
import trimesh

from garage2usd.as_built.shapes import Body, MeshShape, Thing, turned_about_y

BALL = trimesh.creation.icosphere(subdivisions=2, radius=1.5)
PLACE = turned_about_y(0.7, (3.0, -1.0, 8.0))


def test_triangles_have_the_normals_and_corners_that_trimesh_gives_them():
    shape = MeshShape(BALL.vertices.copy(), np.full(len(BALL.faces), 3), BALL.faces.ravel().astype(np.int64))
    placed = trimesh.Trimesh(BALL.vertices @ PLACE[:3, :3] + PLACE[3, :3], BALL.faces, process=False)
    faces = list(Thing("ball", "", (Body(shape, PLACE, touches=True),)).faces())
    assert np.array([face.normal for face in faces]) == pytest.approx(placed.face_normals, abs=1e-9)
    assert np.array([face.corners for face in faces]) == pytest.approx(placed.triangles, abs=1e-12)


def test_a_face_with_many_corners_and_a_notch_has_one_normal_and_one_without_area_is_left_out():
    notched = [(0, 0), (4, 0), (4, 4), (2, 1), (0, 4)]
    points = np.array([(x, 0.5 * x, -z) for x, z in notched], dtype=float)
    shape = MeshShape(points, np.array([3, 5, 2]), np.array([1, 0, 1, 0, 1, 2, 3, 4, 0, 2]))
    (face,) = Body(shape, np.eye(4), touches=False).faces()
    assert face.corners == pytest.approx(points)
    assert face.normal == pytest.approx(np.array([-0.5, 1.0, 0.0]) / np.hypot(0.5, 1.0))
