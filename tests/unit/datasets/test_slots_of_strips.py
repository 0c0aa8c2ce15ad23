"""Slots and free ground in strips, which `benchmarks/real.py slots` learns: labels, pairs of points, and measures."""

import json
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from PIL import Image
from support.benchmarks import benchmark

from garage2usd.common.errors import ConfigError
from garage2usd.render.pictures import write_ids

strip_labels, slot_pairs, slot_maps, slot_measures, drawn_folder = map(
    benchmark, ("strip_labels", "slot_pairs", "slot_maps", "slot_measures", "drawn_folder")
)
StripLabels, MarkingPoints, TrueSlots = strip_labels.StripLabels, slot_pairs.MarkingPoints, slot_pairs.TrueSlots
INTO = (-1.0, 0.0)
OVER = np.array([[1.0, 0.0, 0.0], [0.0, -1.0, 300.0], [0.0, 0.0, 1.0]])
BOTH, LEFT_END, RIGHT_END = (1.0, 1.0), (1.0, 0.0), (0.0, 1.0)


def points(*rows):
    """Marking points as (column, row, opens, confidence), to the picture's left; a fifth is another direction."""
    directions = np.array([row[4] if len(row) > 4 else INTO for row in rows], dtype=np.float64)
    places, opens = np.array([row[:2] for row in rows], dtype=np.float64), np.array([row[2] for row in rows])
    return MarkingPoints(places, directions, opens, np.array([row[3] for row in rows], dtype=np.float64))


def pairs(found):
    return [(left[1], right[1]) for left, right in found.entries_px.tolist()]


def row_of_stalls(count, *, width=60.0, first=270.0, at=50.0, tilt_deg=0.0, slant_deg=90.0, gap_after=None):
    """Labels of stalls beside an aisle that the car follows, turned by a tilt, from the picture's lower end upwards."""
    tilt, slant = np.radians(tilt_deg), np.radians(slant_deg)
    along = np.array([np.sin(tilt), -np.cos(tilt)])
    inwards = along * np.cos(slant) + np.array([along[1], -along[0]]) * np.sin(slant)
    start, corners = np.array([at, first]), []
    for number in range(count):
        left, right = start, start + along * width
        corners.append([left, right, right + inwards * 150, left + inwards * 150])
        start = right + along * (25.0 if number == gap_after else 0.0)
    corners = np.array(corners)
    inside = ((corners[:, :2] >= 0) & (corners[:, :2] < (96, 300))).all(axis=2)
    free, known = np.ones((2, 300, 96), dtype=bool)
    return StripLabels(corners, np.where(inside, 2, 0), np.arange(count) % 2 == 0, free, known)


def answer_of(labels):
    """What a network would answer that has learnt the maps to the point."""
    maps = slot_maps.slot_maps(labels)
    answer = np.zeros((*maps.heat.shape, slot_maps.CHANNELS))
    heat = np.clip(maps.heat.astype(np.float64), 1e-6, 1 - 1e-6)
    answer[..., 0] = np.log(heat / (1 - heat))
    answer[..., 1:5] = maps.point[..., :4]
    answer[..., 5:7] = np.where(maps.point[..., 4:] > 0, 20, -20)
    answer[..., slot_maps.OCCUPIED] = np.where(maps.occupied * maps.is_slot > 0, 20, -20)
    return answer


class TestPairs:
    def test_neighbours_share_a_point_and_columns_are_no_slots(self):
        found = slot_pairs.paired(
            points(
                (50, 280, LEFT_END, 0.9), (50, 220, BOTH, 0.9), (50, 160, RIGHT_END, 0.9),
                (50, 110, LEFT_END, 0.9), (50, 50, RIGHT_END, 0.9),
            ),
            (45, 90),
        )  # fmt: skip
        assert sorted(pairs(found)) == [(110, 50), (220, 160), (280, 220)]
        assert found.direction == pytest.approx(np.tile(INTO, (3, 1)))

    def test_confidence_is_that_of_both_ends_and_shapes(self):
        found = slot_pairs.paired(points((50, 200, (0.5, 0.0), 0.9), (50, 140, (0.0, 0.8), 0.4)), (45, 90))
        assert found.confidence.tolist() == pytest.approx([(0.9 * 0.4 * 0.5 * 0.8) ** 0.5])

    @pytest.mark.parametrize(
        ("left", "right"),
        [
            ((50, 200, LEFT_END, 0.9), (50, 160, RIGHT_END, 0.9)),  # too short
            ((50, 200, LEFT_END, 0.9), (50, 105, RIGHT_END, 0.9)),  # too long
            ((50, 200, RIGHT_END, 0.9), (50, 140, LEFT_END, 0.9)),  # each opens to the other side
            ((50, 200, LEFT_END, 0.9, (1.0, 0.0)), (50, 140, RIGHT_END, 0.9)),  # to two sides of the aisle
            ((50, 200, LEFT_END, 0.9, (1.0, 0.0)), (50, 140, RIGHT_END, 0.9, (1.0, 0.0))),  # left is right there
            ((50, 200, LEFT_END, 0.9, (0.0, -1.0)), (50, 140, RIGHT_END, 0.9, (0.0, -1.0))),  # along the entry
        ],
    )
    def test_what_does_not_fit_is_no_slot(self, left, right):
        assert not len(slot_pairs.paired(points(left, right), (45, 90)).confidence)

    def test_a_sure_point_between_divides(self):
        ends = (50, 200, BOTH, 0.9), (50, 80, BOTH, 0.9)
        assert pairs(slot_pairs.paired(points(*ends), (45, 150))) == [(200, 80)]
        assert pairs(slot_pairs.paired(points(*ends, (52, 145, (0.0, 0.0), 0.5)), (45, 150))) == []
        assert pairs(slot_pairs.paired(points(*ends, (52, 145, (0.0, 0.0), 0.4)), (45, 150))) == [(200, 80)]
        assert pairs(slot_pairs.paired(points(*ends, (62, 145, (0.0, 0.0), 0.5)), (45, 150))) == [(200, 80)]

    def test_nothing_makes_nothing(self):
        none = MarkingPoints(np.zeros((0, 2)), np.zeros((0, 2)), np.zeros((0, 2)), np.zeros(0))
        assert slot_pairs.paired(none, (45, 90)).entries_px.shape == (0, 2, 2)

    @given(
        st.integers(1, 5), st.floats(48, 90), st.floats(30, 70), st.floats(-20, 20), st.floats(50, 130),
        st.sampled_from([None, 0, 1]), st.booleans(),
    )  # fmt: skip
    def test_slots_come_back_from_their_maps(self, count, width, at, tilt, slant, gap_after, is_turned):
        labels = row_of_stalls(count, width=width, at=at, tilt_deg=tilt, slant_deg=slant, gap_after=gap_after)
        labels = slot_maps.moved(labels, OVER) if is_turned else labels
        true, answer = slot_maps.true_slots(labels), answer_of(labels)
        found = slot_pairs.paired(slot_maps.points_in(answer), (45, 95))
        found = found.of(found.confidence > 0.1)
        result = slot_pairs.matched_slots(found, true)
        assert result.true == result.is_hit.sum() == len(result.is_hit)
        entries = true.entries_px[result.owner]
        assert found.entries_px[result.number] == pytest.approx(entries, abs=1e-3)
        assert found.direction[result.number] == pytest.approx(true.direction[result.owner], abs=1e-5)
        occupied = slot_maps.shares_occupied(answer, found)[result.number] > 0.5
        assert occupied.tolist() == true.is_occupied[result.owner].tolist()


class TestMaps:
    def test_turning_round_turns_the_maps(self):
        labels = row_of_stalls(4, first=265.3, at=51.7, tilt_deg=4.0, slant_deg=70.0)
        maps, turned = slot_maps.slot_maps(labels), slot_maps.slot_maps(slot_maps.moved(labels, OVER))
        assert turned.heat == pytest.approx(maps.heat[::-1], abs=1e-6)
        assert (turned.is_point == maps.is_point[::-1]).all()
        assert (turned.is_slot == maps.is_slot[::-1]).all()
        assert (turned.occupied == maps.occupied[::-1]).all()
        back = maps.point[::-1, :, [0, 1, 2, 3, 5, 4]] * np.array([1, -1, 1, -1, 1, 1])
        assert turned.point == pytest.approx(back, abs=1e-5)

    def test_labels_move_as_places_do(self):
        labels = row_of_stalls(4, at=90.0)
        labels.is_free[100:140, 40:60] = False
        move = np.array([[1.0, 0.0, -20.0], [0.0, 1.0, 8.0], [0.0, 0.0, 1.0]])
        moved = slot_maps.moved(labels, move)
        assert (moved.corners_px == labels.corners_px + np.array([-20, 8])).all()
        assert moved.visibility.tolist() == [[2, 2]] * 4
        assert (~moved.is_free[108:148, 20:40]).all()
        assert moved.is_free[150:, :76].all()
        assert not moved.is_known[:, 76:].any()
        assert not moved.is_known[:8].any()
        back = slot_maps.moved(slot_maps.moved(labels, np.array([[1.0, 0, 10], [0, 1.0, 0], [0, 0, 1.0]])), move)
        assert back.visibility.tolist() == [[1, 1]] * 4  # what was outside is not known to be seen

    def test_of_hidden_points_nothing_is_learnt(self):
        labels = row_of_stalls(1)
        labels.visibility[0] = 1, 2
        maps = slot_maps.slot_maps(labels)
        assert (maps.heat == 1).sum() == 1
        hidden = np.argwhere(maps.hidden == 1)
        assert len(hidden) == 9
        assert hidden.mean(axis=0).tolist() == [270 // 4, 50 // 4]

    def test_shares_of_free_ground_are_of_what_is_known(self):
        free, known = np.zeros((300, 96), dtype=bool), np.ones((300, 96), dtype=bool)
        free[:4, :2], known[:4, 3] = True, False
        known[4:8, :4] = False
        labels = row_of_stalls(1)
        maps = slot_maps.slot_maps(StripLabels(labels.corners_px, labels.visibility, labels.is_occupied, free, known))
        assert maps.free[0, 0] == pytest.approx(2 / 3)
        assert maps.is_known[:2, 0].tolist() == [0.75, 0.0]
        assert maps.free[1:].max() == 0


def true_slots(*entries, counts=True):
    entries = np.array(entries, dtype=np.float64).reshape(-1, 2, 2)
    return TrueSlots(
        entries, np.tile(INTO, (len(entries), 1)), np.zeros(len(entries), bool), np.full(len(entries), counts)
    )


def found_slots(*entries):
    """Slots with falling confidence."""
    count = len(entries)
    return slot_pairs.FoundSlots(
        np.array(entries, dtype=np.float64).reshape(-1, 2, 2), np.tile(INTO, (count, 1)), np.linspace(0.9, 0.5, count)
    )


class TestMeasures:
    def test_both_ends_have_to_be_near(self):
        true = true_slots(((50, 200), (50, 140)))
        near, far = ((50, 206), (50, 134)), ((50, 200), (50, 133.9))
        swapped = ((50, 140), (50, 200))
        assert slot_pairs.matched_slots(found_slots(near), true).is_hit.all()
        for entry in (far, swapped):
            assert slot_pairs.matched_slots(found_slots(entry), true).is_hit.tolist() == [False]

    def test_each_slot_is_found_once_and_hidden_ones_do_not_count(self):
        entry, other = ((50, 200), (50, 140)), ((50, 100), (50, 40))
        result = slot_pairs.matched_slots(found_slots(entry, entry, other), true_slots(entry))
        assert result.owner.tolist() == [0, -1, -1]
        assert result.number.tolist() == [0, 1, 2]
        result = slot_pairs.matched_slots(found_slots(entry, other), true_slots(entry, counts=False))
        assert (result.number.tolist(), result.true) == ([1], 0)

    def test_slots_of_a_photograph_are_corners_that_follow_each_other(self):
        corners = np.array([[50, 250], [52, 190], [51, 160], [50, 100], [50, 40], [10, 20], [70, 18]], dtype=np.float64)
        hidden = np.zeros(len(corners), dtype=bool)
        true = slot_pairs.pairs_of_corners(corners, hidden)
        counted = [(left[1], right[1]) for left, right in true.entries_px[true.counts].tolist()]
        # 30 px apart are a column; the last two corners are across the aisle's direction
        assert sorted(counted) == [(100, 40), (160, 100), (250, 190)]
        across = true.entries_px[~true.counts].tolist()
        assert [[10, 20], [70, 18]] in across
        hidden[0] = True
        true = slot_pairs.pairs_of_corners(corners, hidden)
        assert true.counts.sum() == 2
        assert [[50, 250], [52, 190]] in true.entries_px[~true.counts].tolist()

    def test_longer_pairs_of_a_photograph_do_not_count(self):
        true = slot_pairs.pairs_of_corners(np.array([[50.0, 250.0], [50.0, 130.0]]), np.zeros(2, dtype=bool))
        assert true.counts.tolist() == [False]

    def test_what_is_found_in_drawn_strips_by_hand(self):
        labels = row_of_stalls(4)
        labels.is_free[:, :32] = False
        labels.is_known[:100] = False
        right = slot_maps.true_slots(labels)
        turned = right.direction @ np.array([[0.8, 0.6], [-0.6, 0.8]])
        slots = slot_pairs.FoundSlots(right.entries_px[:3], turned[:3], np.array([0.9, 0.8, 0.7]))
        said = np.where(np.arange(96) < 64, 0.2, 0.7) * np.ones((300, 1))
        none = MarkingPoints(np.zeros((0, 2)), np.zeros((0, 2)), np.zeros((0, 2)), np.zeros(0))
        understood = slot_measures.Understood(none, slots, np.array([0.9, 0.9, 0.2]), said)
        measured = slot_measures.in_drawn([understood], [labels])
        assert measured.slots.average_precision == pytest.approx(3 / 4)
        assert measured.slots.best_f1 == pytest.approx(6 / 7)
        assert measured.occupied == pytest.approx(1 / 3)  # taken, free, taken
        assert measured.direction_deg == pytest.approx(np.degrees(np.arccos(0.8)))
        # of columns: 64 are free, 32 of them are said to be; 32 are not, 64 are said not to be
        assert measured.free == pytest.approx(1 / 2)
        assert measured.taken == pytest.approx(1 / 2)


def drawn(folder):
    """What a drawing finished of two views, and its labels."""
    ids = np.zeros((300, 96), dtype=np.int32)
    ids[:, 10:], ids[:, 90:], ids[100:200, 20:40], ids[250:, 10:20] = 1, 0, 2, 3
    slot = {"name": "s1", "corners_px": [[40, 200], [40, 140], [-110, 140], [-110, 200.5]], "visibility": [2, 1, 0, 0]}
    behind = {"name": "s2", "corners_px": [[40, 200], None, [1, 1], [2, 2]], "visibility": [2, 0, 0, 0]}
    frames = [{"name": name, "slots": [slot, behind]} for name in ("0000", "0001")]
    slots = [
        {"name": "s1", "occupied": True},
        {"name": "s2", "occupied": False},
    ]
    (folder / "instance").mkdir(parents=True)
    for name in ("0000", "0001"):
        write_ids(ids, folder / "instance" / f"{name}.png")
    (folder / "slots.json").write_text(json.dumps({"slots": slots, "frames": frames}))
    names = {1: "floor", 2: "car", 3: "ramp"}
    return SimpleNamespace(
        classes={number + 10: SimpleNamespace(name=name) for number, name in names.items()},
        class_ids={number: number + 10 for number in names},
    )


class TestLabels:
    def test_what_was_drawn_is_read_and_the_right_side_is_mirrored(self, tmp_path):
        labels, strips = drawn(tmp_path / "finished"), tmp_path / "strips"
        places = {"0000": Path("hall_left/0000.png"), "0001": Path("hall_right/0001.png")}
        strips.mkdir()
        strip_labels.write_strip_labels(strips, places, tmp_path / "finished", labels)
        read = strip_labels.read_strip_labels(strips)
        left, right = read["hall_left/0000.png"], read["hall_right/0001.png"]
        # of the other slot a corner is not seen by the lens
        assert left.corners_px.tolist() == [[[40, 200], [40, 140], [-110, 140], [-110, 200.5]]]
        assert left.visibility.tolist() == [[2, 1]]
        assert left.is_occupied.tolist() == right.is_occupied.tolist() == [True]
        assert right.corners_px.tolist() == [[[56, 140], [56, 200], [206, 200.5], [206, 140]]]
        assert right.visibility.tolist() == [[1, 2]]
        expected = np.zeros((300, 96), dtype=bool)
        expected[:, 10:90] = True
        assert (left.is_known == expected).all()
        expected[100:200, 20:40] = False
        assert (left.is_free == expected).all()
        assert (right.is_free == expected[:, ::-1]).all()

    def test_what_is_missing_is_said(self, tmp_path):
        with pytest.raises(ConfigError, match=r"real\.py draw"):
            strip_labels.read_strip_labels(tmp_path)
        (tmp_path / "labels.json").write_text('{"hall_left/1.png": []}')
        with pytest.raises(ConfigError, match="a mask of free ground"):
            strip_labels.read_strip_labels(tmp_path)

    def test_each_picture_of_a_garage_has_labels(self, tmp_path):
        garage = tmp_path / "one"
        (garage / "hall_left").mkdir(parents=True)
        (garage / "free" / "hall_left").mkdir(parents=True)
        for name in ("1", "2"):
            Image.fromarray(np.zeros((300, 96, 3), dtype=np.uint8)).save(garage / "hall_left" / f"{name}.png")
        Image.fromarray(np.zeros((300, 96), dtype=np.uint8)).save(garage / "free" / "hall_left" / "1.png")
        (garage / "corners.json").write_text('{"hall_left/1.png": []}')
        (garage / "labels.json").write_text('{"hall_left/1.png": []}')
        drawn_folder.write_drawn(tmp_path, [garage])
        (((strip, labels),),) = drawn_folder.read_labelled(tmp_path)
        assert (strip.name, labels.corners_px.shape) == ("hall_left/1.png", (0, 4, 2))
        assert not labels.is_free.any()
        assert labels.is_known.all()
        (garage / "corners.json").write_text('{"hall_left/1.png": [], "hall_left/2.png": []}')
        with pytest.raises(ConfigError, match=r"labels\.json has as well"):
            drawn_folder.read_labelled(tmp_path)
