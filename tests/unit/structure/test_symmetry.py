"""Canonical forms and digests of plans, held to a brute force that knows nothing of arrays."""

import hashlib

import numpy as np
from hypothesis import assume, given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from garage2usd.structure.grid import cells_from_text, cells_to_text
from garage2usd.structure.symmetry import canonical_cells, cropped_cells, eight_symmetries, plan_digest

matrices = arrays(
    np.int8,
    st.tuples(st.integers(1, 6), st.integers(1, 6)),
    elements=st.sampled_from((-1, 0, 1, 2, 3)),
    fill=st.sampled_from((-1, 0, 1)),
)


def turned(rows):
    return [list(row) for row in zip(*rows[::-1], strict=True)]


def canonical_by_hand(rows):
    """The canonical form by lists alone: borders shed one by one, quarter turns one after the other."""
    for _ in range(4):
        while rows and all(value == -1 for value in rows[0]):
            rows = rows[1:]
        rows = turned(rows)
    images = []
    for start in (rows, [row[::-1] for row in rows]):
        image = start
        for _ in range(4):
            images.append(image)
            image = turned(image)
    return min(images, key=lambda image: (len(image), [value for row in image for value in row]))


@given(matrices)
def test_the_canonical_form_is_that_of_brute_force(cells):
    assert canonical_cells(cells).tolist() == canonical_by_hand(cells.tolist())


@given(matrices)
def test_all_images_have_one_canonical_form_and_one_digest(cells):
    assert {plan_digest(image) for image in eight_symmetries(cells)} == {plan_digest(cells)}
    assert (canonical_cells(canonical_cells(cells)) == canonical_cells(cells)).all()


@given(matrices, matrices)
def test_other_canonical_forms_have_other_digests(one, other):
    is_same = canonical_by_hand(one.tolist()) == canonical_by_hand(other.tolist())
    assert (plan_digest(one) == plan_digest(other)) is is_same


@given(matrices, st.tuples(*[st.integers(0, 3)] * 4))
def test_ground_outside_does_not_count(cells, added):
    top, bottom, left, right = added
    wider = np.pad(cells, ((top, bottom), (left, right)), constant_values=-1)
    assert (cropped_cells(wider) == cropped_cells(cells)).all()
    assert plan_digest(wider) == plan_digest(cells)


@given(matrices)
def test_one_other_square_is_another_plan_unless_an_image_has_it(cells):
    assume((cells == 0).any())
    other = cells.copy()
    other[tuple(np.argwhere(cells == 0)[0])] = 1
    assert plan_digest(other) != plan_digest(cells)  # the counts of squares by kind differ


def test_a_plan_without_symmetry_has_eight_images():
    cells = cells_from_text("E=.\n...", field="S")
    images = [cells_to_text(image) for image in eight_symmetries(cells)]
    assert len(set(images)) == 8
    assert images[0] == "E=.\n..."
    assert images[1] == "..\n=.\nE."
    assert images[4] == ".=E\n..."


def test_what_is_digested_is_shape_and_canonical_cells():
    cells = cells_from_text("#####\n#=.##\n#####", field="S")
    assert canonical_cells(cells).tolist() == [[0, 1]]
    expected = hashlib.sha256((1).to_bytes(8, "little") + (2).to_bytes(8, "little") + b"\x00\x01").hexdigest()
    assert plan_digest(cells) == expected
    assert plan_digest(np.array([[0], [1]], dtype=np.int8)) == expected


def test_ground_that_is_all_outside_crops_to_nothing():
    cells = np.full((3, 4), -1, dtype=np.int8)
    assert canonical_cells(cells).shape == (0, 0)
    assert plan_digest(cells) == plan_digest(cells[:1, :1])


def test_a_canonical_form_is_a_copy_of_its_own():
    cells = np.zeros((2, 3), dtype=np.int8)
    canonical_cells(cells)[0, 0] = 1
    assert not cells.any()
