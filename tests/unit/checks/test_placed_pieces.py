"""Pieces of many placed meshes at once, against each mesh by itself."""

import numpy as np
import shapely

from garage2usd.as_built.placed_pieces import lows_m, placed_pieces
from garage2usd.as_built.shapes import Body, MeshShape, box_shape, turned_about_y


def two_boxes():
    """A box on the floor and one that hangs, in one mesh."""
    low, high = box_shape(np.zeros(3), np.ones(3)), box_shape(np.array([2.0, 1.5, 0.0]), np.array([4.0, 2.0, 1.0]))
    return MeshShape(
        np.concatenate([low.points, high.points]),
        np.concatenate([low.counts, high.counts]),
        np.concatenate([low.indices, high.indices + len(low.points)]),
    )


def bodies():
    random = np.random.default_rng(3)
    shapes = [two_boxes(), box_shape(np.array([-1.0, 0.2, -1.0]), np.array([1.0, 0.4, 1.0]))]
    placed = [
        Body(shapes[number % 2], turned_about_y(yaw, position), touches=True)
        for number, (yaw, position) in enumerate(
            zip(random.uniform(-3, 3, 7), random.uniform(-9, 9, (7, 3)), strict=True)
        )
    ]
    tilted = np.eye(4)
    tilted[:3, :3] = [[1, 0, 0], [0, 0, 1], [0, -1, 0]]
    return [*placed[:4], Body(shapes[0], tilted, touches=True), *placed[4:]]


def test_pieces_are_those_of_each_mesh_by_itself():
    given = bodies()
    are_whole = np.arange(len(given)) % 3 == 0
    expected = [
        (index, *piece)
        for index, (body, is_whole) in enumerate(zip(given, are_whole.tolist(), strict=True))
        for piece in body.pieces(whole=is_whole)
        if piece[2] >= 0.5
    ]
    found = placed_pieces(given, are_whole)
    found = found.kept(found.high_m >= 0.5)
    assert found.owner.tolist() == [index for index, *_ in expected]
    np.testing.assert_allclose(found.low_m, [low for *_, low, _ in expected], atol=1e-12)
    np.testing.assert_allclose(found.high_m, [high for *_, high in expected], atol=1e-12)
    for footprint, hull, (_, outline, _, _) in zip(found.footprints, found.hulls, expected, strict=True):
        np.testing.assert_allclose(shapely.get_coordinates(footprint)[:-1], outline, atol=1e-12)
        assert hull.equals_exact(footprint.normalize(), 1e-9, normalize=True)


def test_the_least_heights_are_those_of_each_mesh_by_itself():
    np.testing.assert_allclose(lows_m(bodies()), [body.low_m() for body in bodies()], atol=1e-12)


def test_there_may_be_no_mesh():
    found = placed_pieces([], np.zeros(0, dtype=bool))
    assert [len(column) for column in found] == [0, 0, 0, 0, 0]
    assert len(found.footprints) == len(found.hulls) == 0
    assert len(lows_m([])) == 0
