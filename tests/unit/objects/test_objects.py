"""What every kind of object declares, whichever it is: nothing here names one but for exceptions."""

import numpy as np
import pytest
import shapely
from support.object_specs import CASES, KEPT, SPECS, asset_of_case

from garage2usd.config.vehicles import VehicleClass
from garage2usd.objects import CAR_LABELS, CLASSES, CLASSES_VERSION, KINDS, PIECE_LABELS, Kind, Spec, _in_order
from garage2usd.objects.car import CAR_KINDS
from garage2usd.objects.kind import PAINT_CLASSES, VariantSet
from garage2usd.objects.panel import Paint

DRIVEN_OVER = {"Floor", "Threshold", "LeftKerb", "RightKerb"}
"""Parts of ramps that wheels touch."""
HEAD_M, FOOT_M = 2.0, 0.06
"""Between a car's roof and what a wheel goes over."""
CITYSCAPES = {
    "road", "sidewalk", "parking", "building", "wall", "fence", "guard rail", "pole", "traffic sign", "car", "sky",
    "truck", "person", "bicycle", "motorcycle", "static", "dynamic", "ground",
}  # fmt: skip


def spec_classes(base=Spec):
    for cls in base.__subclasses__():
        if hasattr(cls, "kind") and cls.__module__.startswith("garage2usd."):
            yield cls
        yield from spec_classes(cls)


@pytest.mark.parametrize("kind", KINDS, ids=lambda kind: kind.name)
def test_a_kind_declares_what_labels_need(kind):
    assert kind.label.islower()
    assert kind.cityscapes in CITYSCAPES
    assert not (kind.scattered and kind.is_solid)  # point instancers lose colliders
    assert kind.follows in {None, *VariantSet}


def test_every_class_of_shapes_belongs_to_a_kind_and_has_a_case():
    classes = set(spec_classes())
    assert {cls.kind for cls in classes} == {*KINDS, *CAR_KINDS}
    assert {type(spec) for spec in SPECS.values()} == classes
    assert {str(label) for label in VehicleClass} == CAR_LABELS


def test_numbers_of_classes_stay_as_they_are_in_data_sets():
    assert [kind.label for kind in KINDS][:26] == [
        "floor", "parking_stall", "ceiling", "wall", "vehicle_door", "obstacle", "column", "light", "beam", "duct",
        "cable_tray", "speed_bump", "wheel_stop", "traffic_sign", "traffic_cone", "car", "ramp", "sky", "barrier",
        "stall_number", "zone_plate", "charger", "sprinkler", "exit_sign", "mirror", "floor_stain",
    ]  # fmt: skip
    assert [(each.number, each.label) for each in CLASSES[28:49]] == [
        (29, "stall_line"), (30, "lane_line"), (31, "lane_arrow"), (32, "crossing"), (33, "hatching"),
        (34, "stall_symbol"), (35, "number_plate"), (36, "drain"), (37, "waste_bin"), (38, "cardboard_box"),
        (39, "pallet"), (40, "bicycle"), (41, "motorbike"), (42, "shopping_trolley"), (43, "pram"), (44, "bag"),
        (45, "person"), (46, "van"), (47, "truck"), (48, "lane_sign"), (49, "fire_shutter"),
    ]  # fmt: skip
    assert [each.number for each in CLASSES] == list(range(1, len(CLASSES) + 1))
    assert (len(CLASSES), CLASSES_VERSION) == (49, 8), "a new version of the table for new classes"


def test_pieces_are_of_classes_that_there_are_and_all_paint_has_one():
    assert {str(paint) for paint in Paint} == {each.label for each in PAINT_CLASSES}
    seen = {part.piece for case in KEPT for part in asset_of_case(case).parts}
    assert {"", *PIECE_LABELS} >= seen > {"lane_line"}
    assert all(each.cityscapes in CITYSCAPES for each in CLASSES)


@pytest.mark.parametrize("field", ["number", "name", "label"])
def test_two_kinds_cannot_share_a_number_a_name_or_a_label(field):
    first, second = (
        {"name": name, "number": number, "label": f"class_{name}", "cityscapes": "static"}
        for name, number in (("a", 1), ("b", 2))
    )
    with pytest.raises(ValueError, match=str(first[field])):
        _in_order([Kind(**first), Kind(**{**second, field: first[field]})])
    assert [kind.name for kind in _in_order([Kind(**second), Kind(**first)])] == ["a", "b"]


def touched(asset):
    """Outlines (x, z) of what a car could touch of each part with a collider: of its faces below a car's roof."""
    for part in asset.parts:
        if part.collider is None or part.name in DRIVEN_OVER:
            continue
        for corners in np.split(part.points[part.face_indices].astype(float), np.cumsum(part.face_counts)[:-1]):
            if corners[:, 1].min() < HEAD_M and corners[:, 1].max() > FOOT_M:
                yield shapely.MultiPoint(corners[:, [0, 2]]).convex_hull


def hangs(kind):
    """Whether all of an object is over cars; the rails of a fire shutter, which is hidden with the ceiling, stand."""
    if kind.name == "fire_shutter":
        return False
    return kind.name == "mirror" or kind.follows in {VariantSet.CEILING, VariantSet.LIGHTS}


@pytest.mark.parametrize("case", CASES)
def test_the_outline_on_the_ground_holds_what_a_car_could_touch_and_little_more(case):
    spec = SPECS[case]
    outlines = [shapely.Polygon(outline) for outline in spec.outlines()]
    assert all(outline.is_valid and outline.area > 0 for outline in outlines)
    assert all(outline.convex_hull.area == pytest.approx(outline.area) for outline in outlines)
    ground = shapely.union_all(outlines)
    stands = [] if hangs(spec.kind) else list(touched(asset_of_case(case)))
    assert bool(stands) == bool(outlines)
    if case == "raised_barrier":
        return  # its arm counts as if it were down
    for shape in stands:
        assert shapely.within(shape, ground.buffer(2e-3)), shape.bounds
    points = np.concatenate([part.points[:, [0, 2]] for part in asset_of_case(case).parts])
    assert shapely.within(ground, shapely.MultiPoint(points).envelope.buffer(0.11, join_style="mitre")) or not stands
