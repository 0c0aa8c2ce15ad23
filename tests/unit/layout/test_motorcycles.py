"""Stalls for motorcycles: their share and shape, what parks there, and what other programs and proofs see of them."""

import json
import xml.etree.ElementTree as ET

import pytest
import shapely
from click.testing import CliRunner
from pxr import Usd
from support.label_tables import labelled_objects
from support.rays import Rays
from support.slot_frames import from_above
from support.soak import soak_but
from support.stage_lanes import read_stage

import garage2usd
from garage2usd import ConfigError, GarageConfig, generate
from garage2usd.as_built.garage import garage_of_file
from garage2usd.checks import Severity, judged_layout
from garage2usd.cli import main
from garage2usd.driving import prove_stalls
from garage2usd.driving.layout_garage import layout_garage
from garage2usd.garage_sources import check
from garage2usd.profiles import PROFILE_NAMES
from garage2usd.reading.labels import read_labels
from garage2usd.sensors.formats.coco import CocoImage, coco_keypoints
from garage2usd.sensors.formats.slot_files import dmpr_ps
from garage2usd.sensors.slots import read_slots

SETTINGS = {
    "seed": 5,
    "site": {"width_cells": 9, "height_cells": 7},
    "plan": {"episodes": 100, "starts": 1},
    "stalls": {"sizes": {"standard": 0.8, "motorcycle": 0.2}},
}
WIDTH_M, LENGTH_M = 1.2, 2.5
ALLOWED = {"column-spacing", "exit-distance", "exit-distance-sprinklered", "personnel-exits"}


def polygon(stall):
    return shapely.Polygon(stall.corners)


@pytest.fixture(scope="module")
def garage():
    return generate(GarageConfig(**SETTINGS))


@pytest.fixture(scope="module")
def stalls(garage):
    return [stall for stall in garage.layout.quads if stall.size == "motorcycle"]


@pytest.fixture(scope="module")
def built(tmp_path_factory):
    return garage2usd.build(GarageConfig(**SETTINGS), tmp_path_factory.mktemp("motorcycles") / "g.usdc")


SHARES = (0.05, 0.1, 0.15, 0.3)
CASES = [(profile, seed, share) for profile in PROFILE_NAMES for seed, share in enumerate(SHARES)]
EACH_SHARE_ONCE = [(PROFILE_NAMES[seed], seed, share) for seed, share in enumerate(SHARES)]


@pytest.mark.parametrize(("profile", "seed", "share"), soak_but(EACH_SHARE_ONCE, CASES))
def test_they_are_as_near_to_their_share_as_whole_squares_allow(profile, seed, share):
    sizes = {"standard": 1 - share, "motorcycle": share}
    stalls = {"sizes": sizes, "kinds": {"perpendicular": 0.8, "angled": 0.2}}
    made = generate(GarageConfig(**{**SETTINGS, "seed": seed, "profile": profile, "stalls": stalls}))
    quads = made.layout.quads
    own = [stall for stall in quads if stall.use == "motorcycle"]
    # one square holds seven, and angled stalls are fewer than those that are counted for the others
    assert own
    assert abs(len(own) - share * len(quads)) < 8 + 0.1 * len(quads) * share / (1 - share)
    assert {str(stall.kind) for stall in own} == {"perpendicular"}
    assert {stall.size for stall in own} == {"motorcycle"}
    findings, _ = judged_layout(made.layout, made.config)
    assert {finding.rule for finding in findings} <= ALLOWED
    assert all(proof.is_full for proof in prove_stalls(made.layout, most_explained=0))


def test_they_have_the_size_of_the_class_and_of_the_profile(stalls):
    for stall in stalls:
        assert (stall.width_m, stall.length_m) == (pytest.approx(WIDTH_M), pytest.approx(LENGTH_M))
    american = generate(GarageConfig(**{**SETTINGS, "profile": "us-ada"}))
    widths = {stall.width_m for stall in american.layout.quads if stall.size == "motorcycle"}
    assert min(widths) >= 4 * 0.3048


def test_motorbikes_stand_in_them_and_nothing_else_does(garage, stalls):
    layout = garage.layout
    grounds = {stall.name: polygon(stall) for stall in stalls}
    bikes = layout.of_kind("motorbike")
    outlines = [shapely.Polygon(outline) for bike in bikes for outline in bike.outlines()]
    assert len({bike.stall for bike in bikes}) == len(bikes) > 5
    for bike, outline in zip(bikes, outlines, strict=True):
        assert grounds[bike.stall].buffer(1e-6).covers(outline)
    tree = shapely.STRtree(outlines)
    assert all(len(tree.query(outline, predicate="intersects")) == 1 for outline in outlines)
    cars = [shapely.Polygon(outline) for car in layout.of_kind("car") for outline in car.outlines()]
    assert not any(ground.intersects(car) for ground in grounds.values() for car in cars)
    taken = {stall.name for stall in stalls if stall.is_occupied}
    assert taken == {bike.stall for bike in bikes}
    assert len(bikes) / len(stalls) == pytest.approx(0.6, abs=0.25)


def test_cars_keep_off_them_and_are_not_proven_for_them(garage, stalls):
    driven = layout_garage(garage.layout)
    names = {stall.name for stall in stalls}
    assert not names & {stall.name for stall in driven.stalls}
    assert names <= set(driven.standing.names)


def test_stalls_for_cars_alone_are_counted(garage, stalls):
    layout = garage.layout
    assert layout.parking_stalls == sum(stall.takes_cars for stall in layout.quads) < len(layout.quads)
    assert f"; {len(stalls)} for motorcycles" in layout.uses_in_words()
    numbers = [stall.number for stall in layout.quads if stall.is_parked_in]
    assert all(numbers)
    assert len(set(numbers)) == len(numbers)


def test_named_stalls_hold_a_motorbike_or_none(stalls):
    full, empty = stalls[0].name, stalls[1].name
    settings = {**SETTINGS, "parking": {"occupancy": 0.0, "occupied_stalls": [full]}}
    made = generate(GarageConfig(**settings)).layout
    assert [bike.stall for bike in made.of_kind("motorbike")] == [full]
    settings = {**SETTINGS, "parking": {"occupancy": 1.0, "empty_stalls": [empty]}}
    made = generate(GarageConfig(**settings)).layout
    assert {bike.stall for bike in made.of_kind("motorbike")} == {stall.name for stall in stalls} - {empty}


def test_given_runs_are_of_motorcycles_too(garage):
    structure = "E=====X\n......."
    run = {"first": [1, 1], "last": [1, 2], "edge": "up", "size": "motorcycle"}
    cars = {"first": [1, 3], "last": [1, 5], "edge": "up"}
    config = GarageConfig(site={"structure": structure}, stalls={"runs": [run, cars], "only_runs": True})
    made = generate(config)
    assert {stall.size for stall in made.layout.stalls} == {"motorcycle", "standard"}
    assert {stall.square for stall in made.layout.stalls if stall.size == "motorcycle"} == {(1, 1), (1, 2)}


@pytest.mark.parametrize(
    ("stalls", "said"),
    [
        ({"sizes": {"motorcycle": 1}}, "for a class of cars"),
        ({"sizes_m": {"motorcycle": (0.5, 2.5)}}, "0.8"),
        ({"sizes_m": {"compact": (1.2, 2.5)}}, "1.8 by 3.5 m"),
        ({"runs": [{"first": [0, 0], "last": [0, 0], "edge": "up", "size": "motorcycle", "kind": "parallel"}]}, "perp"),
        (
            {"runs": [{"first": [0, 0], "last": [0, 0], "edge": "up", "size": "motorcycle"}], "only_runs": True},
            "some runs for cars",
        ),
    ],
)
def test_settings_that_cannot_be_are_refused(stalls, said):
    with pytest.raises(ConfigError, match="stalls") as refused:
        GarageConfig(stalls=stalls)
    assert said in str(refused.value)


def test_a_stage_and_its_report_tell_of_them(built, garage, stalls):
    names = {stall.name: stall for stall in stalls}
    report = json.loads(built.report.read_text())
    told = {entry["name"]: entry for entry in report["levels"][0]["stalls"] if entry["use"] == "motorcycle"}
    assert told.keys() == names.keys()
    assert {entry["size"] for entry in told.values()} == {"motorcycle"}
    assert {name for name, entry in told.items() if entry["occupied"]} == {s.name for s in stalls if s.is_occupied}
    as_built = garage_of_file(built.stage)
    read = {stall.name: stall for stall in as_built.stalls}
    for name, stall in names.items():
        assert (read[name].use, read[name].size, read[name].is_occupied) == (stall.use, stall.size, stall.is_occupied)
    assert {stall.name for stall in as_built.levels[0].taken_stalls} == {
        s.name for s in garage.layout.quads if s.is_occupied
    }
    entries = labelled_objects(built.labels)
    bikes = [entry["path"] for entry in entries if entry["class"] == "motorbike"]
    assert len(bikes) == sum(stall.is_occupied for stall in stalls)
    stage = Usd.Stage.Open(str(built.stage))
    stage.GetDefaultPrim().GetVariantSets().SetSelection("occupancy", "empty")
    assert not any(stage.GetPrimAtPath(path).IsActive() for path in bikes)
    assert all(
        stall["use"] in {"standard", "ev", "accessible", "access_aisle", "motorcycle"}
        for stall in read_stage(built.stage).stalls.values()
    )


def test_check_says_that_no_way_is_proven_into_them(built, stalls):
    findings, _ = check(built.stage)
    (finding,) = (finding for finding in findings if finding.rule == "motorcycle-path")
    assert finding.severity is Severity.INFO
    assert f"the {len(stalls)} stalls for motorcycles" in finding.message
    assert stalls[0].name in finding.message
    run = CliRunner().invoke(main, ["drive", str(built.stage), "--stall", stalls[0].name, "-o", "out.csv"])
    assert run.exit_code != 0
    assert "a stall that takes a car" in run.output + str(run.exception)


def test_maps_say_who_parks_there(built, stalls, tmp_path):
    road, lanelets = garage2usd.export(built.stage, [tmp_path / "g.xodr", tmp_path / "g.osm"])
    names = {stall.name for stall in stalls}
    spaces = {
        element.get("name"): element.find("parkingSpace")
        for element in ET.parse(road).getroot().iter("object")
        if element.get("type") == "parkingSpace"
    }
    for name, space in spaces.items():
        is_own = name in names
        assert (space.get("access") == "all", space.get("restrictions") == "motorcycles") == (is_own, is_own)
    assert names < set(spaces)
    relations = [
        {tag.get("k"): tag.get("v") for tag in relation.iter("tag")}
        for relation in ET.parse(lanelets).getroot().iter("relation")
    ]
    parking = {tags["name"]: tags for tags in relations if tags.get("subtype") == "parking"}
    own = {name for name, tags in parking.items() if tags.get("participant:vehicle:motorcycle") == "yes"}
    assert own == names
    assert all("participant:vehicle" not in parking[name] for name in names)


def test_their_slots_have_a_category_of_their_own(built, stalls):
    stage = Usd.Stage.Open(str(built.stage))
    slots = read_slots(stage)
    rays = Rays(stage, read_labels(stage, built.stage).ids)
    own = {stall.name for stall in stalls}
    middles = [slot.corners_m.mean(axis=0) for slot in slots.slots if slot.stall.name in own]
    shots = [from_above(rays, middle, size_px=(300, 300), metres_per_px=1 / 30, turn_deg=0.0) for middle in middles[:3]]
    frames = [(CocoImage(f"{number}.png", (300, 300)), slots.seen_in(shot.frame)) for number, shot in enumerate(shots)]
    document = coco_keypoints(frames, description="slots")
    named = {category["id"]: category["name"] for category in document["categories"]}
    found = {entry["attributes"]["name"]: named[entry["category_id"]] for entry in document["annotations"]}
    assert {name for name, category in found.items() if category == "motorcycle_slot"} == own & set(found)
    assert len(own & set(found)) > 3
    # DMPR-PS tells of slots for cars
    for (_, records), label in zip(frames, [dmpr_ps(records, slots) for _, records in frames], strict=True):
        names = {record.slot.stall.name for record in records}
        assert len(label["slots"]) <= len(names - own)
    document = coco_keypoints([], description="none")
    assert [category["name"] for category in document["categories"]] == ["parking_slot", "kept_free"]
