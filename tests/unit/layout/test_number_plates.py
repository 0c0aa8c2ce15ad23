"""The number plates of cars: each with a text of its own, the same in every form, and whose they are."""

import re
import sys

import numpy as np
import pytest
from pxr import Usd, UsdGeom, UsdShade
from support.glb_reader import Glb
from support.label_tables import labelled_objects
from support.small_garage import SETTINGS
from support.soak import soak_but

from garage2usd.assets.countries import Country
from garage2usd.assets.number_plates import BAND, CHARACTERS, SPACE, cell_corners, painted_plates, plate_coordinates
from garage2usd.config import GarageConfig
from garage2usd.config.vehicles import CAR_BODIES, DRIVEN_BODIES, DRIVEN_PLATE, PAINTS
from garage2usd.garage_sources import check
from garage2usd.layout.parking.car_details import number_plates
from garage2usd.maps.glb import write_glb
from garage2usd.objects.car import CarSpec
from garage2usd.objects.number_plate import NumberPlateSpec
from garage2usd.pipeline import build, generate
from garage2usd.reading.labels import Labels, NumberPlates, read_labels
from garage2usd.render.pictures import Picture, Surfaces, VisibleInstance, read_ids, write_picture
from garage2usd.render.tables import _seen
from garage2usd.stage.prototypes import asset_of

PLAN = """
........
E======X
........
"""
PATTERN = re.compile(r"[A-HJ-NPR-Z]\d\d [A-HJ-NPR-Z]\d\d")
FORMS = {
    "text": ("garage.usda", {}),
    "crate": ("garage.usdc", {}),
    "package": ("garage.usdz", {}),
    "shared": ("one/garage.usdc", {"assets": "shared"}),
    "flat": ("garage.usdc", {"form": "flat"}),
    "nested": ("garage.usdc", {"form": "nested", "arrangements": 3}),
}
CELLS = {tuple(cell_corners(one).mean(axis=0).round(4)): one for one in (*CHARACTERS, SPACE, BAND)}


def small(**stage):
    return GarageConfig(
        **{
            **SETTINGS,
            "site": {"structure": PLAN},
            "parking": {"occupancy": 0.8},
            "stage": {"texture_quality": "low", **stage},
        }
    )


@pytest.fixture(scope="module", params=soak_but(["text", "flat", "nested"], FORMS))
def made(request, tmp_path_factory):
    name, stage = FORMS[request.param]
    return request.param, build(small(**stage), tmp_path_factory.mktemp(request.param) / name)


def meshes_of(prim):
    return [each for each in Usd.PrimRange(prim, Usd.TraverseInstanceProxies()) if each.IsA(UsdGeom.Mesh)]


def read_plates(mesh):
    """What is to be read on the plates that look to -Z and to +Z, left to right as one who stands before them does."""
    points = np.array(mesh.GetAttribute("points").Get())
    corners = points[np.array(mesh.GetAttribute("faceVertexIndices").Get())].reshape(-1, 4, 3)
    st = np.array(UsdGeom.PrimvarsAPI(mesh).GetPrimvar("st").ComputeFlattened()).reshape(-1, 4, 2)
    texts = []
    for toward in (-1, 1):
        (own,) = np.nonzero(np.sign(corners[:, 0, 2]) == toward)
        # +X is on the right of one who looks to -Z, at what looks to +Z
        order = own[np.argsort(corners[own].mean(axis=1)[:, 0] * toward)]
        text = ""
        for face in order:
            normal = np.cross(corners[face, 1] - corners[face, 0], corners[face, 2] - corners[face, 0])
            assert normal[2] * toward > 0
            # up and to the right on the texture is up and to the right on the plate
            to_right, up = (
                np.sign(corners[face, :, 0] * toward - corners[face, :, 0].mean() * toward),
                corners[face, :, 1],
            )
            assert (np.sign(st[face, :, 0] - st[face, :, 0].mean()) == to_right).all()
            assert (np.sign(st[face, :, 1] - st[face, :, 1].mean()) == np.sign(up - up.mean())).all()
            middle = tuple(st[face].mean(axis=0).round(4).tolist())
            text += next(one for place, one in CELLS.items() if np.allclose(place, middle, atol=2e-4))
        texts.append(text)
    return texts


def plates_in(stage):
    """What is to be read on the plates, by the path of their prim."""
    found = {}
    for prim in Usd.PrimRange(stage.GetPseudoRoot(), Usd.TraverseInstanceProxies()):
        if list(prim.GetAttribute("semantics:labels:class").Get() or []) == ["number_plate"]:
            (mesh,) = meshes_of(prim)
            front, rear = read_plates(mesh)
            assert front == rear == BAND + prim.GetAttribute("garage:numberPlate:text").Get()
            found[str(prim.GetPath())] = front[1:]
    return found


def test_every_car_has_plates_that_say_what_labels_and_attributes_say(made):
    form, result = made
    stage = Usd.Stage.Open(str(result.stage))
    read = plates_in(stage)
    objects = {entry["id"]: entry for entry in labelled_objects(result.labels)}
    cars = {entry["path"] for entry in objects.values() if entry["class"] == "car"}
    labels = read_labels(stage, result.stage)
    assert len(labels.plates) == len(cars) > 15
    assert {objects[number]["path"]: plates.text for number, plates in labels.plates.items()} == read
    assert {objects[plates.car]["path"] for plates in labels.plates.values()} == cars
    for number, plates in labels.plates.items():
        prim = stage.GetPrimAtPath(objects[number]["path"])
        (car,) = prim.GetRelationship("garage:numberPlate:car").GetTargets()
        assert str(car) == objects[plates.car]["path"]
        places = [UsdGeom.Xformable(each).ComputeLocalToWorldTransform(0) for each in (prim, stage.GetPrimAtPath(car))]
        assert np.allclose(*map(np.array, places), atol=1e-5)
    assert all(PATTERN.fullmatch(text) for text in read.values())
    assert DRIVEN_PLATE not in read.values()
    if form != "nested":
        assert len(set(read.values())) == len(cars)
        assert form == "flat" or all(stage.GetPrimAtPath(path).IsInstance() for path in cars)


def test_their_texture_is_there_and_the_stage_is_sound(made):
    _, result = made
    stage = Usd.Stage.Open(str(result.stage))
    prim = next(each for each in meshes_of(stage.GetPseudoRoot()) if each.GetName() == "Plates")
    material, _ = UsdShade.MaterialBindingAPI(prim).ComputeBoundMaterial()
    texture = stage.GetPrimAtPath(material.GetPath().AppendChild("ColourTexture"))
    assert texture.GetAttribute("inputs:file").Get().resolvedPath
    assert not [finding for finding in check(result.stage) if "NumberPlate" in str(finding)]


def test_a_stage_without_a_table_of_labels_says_whose_plates_they_are(made):
    _, result = made
    stage = Usd.Stage.Open(str(result.stage))
    told, found = read_labels(stage, result.stage), read_labels(stage, None)
    path_of = {number: path for path, number in told.ids.items()}
    paths = {number: path for path, number in found.ids.items()}
    assert {(paths[number], paths[plates.car], plates.text) for number, plates in found.plates.items()} == {
        (path_of[number], path_of[plates.car], plates.text) for number, plates in told.plates.items()
    }


def test_plates_go_with_the_cars(made):
    form, result = made
    if form == "flat":
        return
    stage = Usd.Stage.Open(str(result.stage))
    assert plates_in(stage)
    stage.GetDefaultPrim().GetVariantSet("occupancy").SetVariantSelection("empty")
    assert not plates_in(stage)


def test_texts_depend_on_the_seed_and_the_stall_alone():
    def texts(**changes):
        layout = generate(GarageConfig(**{**small().model_dump(), **changes})).layout
        return {place.stall: place.spec.text for place in layout.of_kind("number_plate")}

    usual = texts()
    assert texts() == usual
    fuller = texts(parking={"occupancy": 1.0})
    assert len(fuller) > len(usual)
    assert fuller.items() >= usual.items()
    other = texts(seed=7)
    assert not {other[stall] for stall in other} & set(usual.values())


def test_a_text_that_is_taken_goes_to_no_second_car(monkeypatch):
    few = {Country.NONE: ("K", "47", "6", " ", "M", "92", "0123456789ABCDE")}
    monkeypatch.setattr(sys.modules[number_plates.__module__], "_PATTERNS", few)
    layout = generate(small()).layout
    texts = [place.spec.text for place in layout.of_kind("number_plate")]
    assert len(set(texts)) == len(texts) > 20


@pytest.mark.parametrize("text", ["K47 M9", "K47 M921", "K47 O21", "K47|M92", "k47 M92"])
def test_a_text_that_no_plate_has_is_refused(text):
    with pytest.raises(ValueError, match="a plate has 7 characters"):
        plate_coordinates(text)


@pytest.mark.parametrize("body", soak_but(DRIVEN_BODIES, CAR_BODIES), ids=lambda body: body.name)
def test_plates_lie_on_their_holders(body):
    holders = next(part for part in asset_of(CarSpec(body.name, PAINTS[0])).parts if part.name == "PlateHolders").points
    sheets = [asset_of(NumberPlateSpec(body.name, "K47 M92")).parts[0], *painted_plates(body, "K47 M92")]
    for points in (part.points for part in sheets):
        for toward in (-1, 1):
            own = points[np.sign(points[:, 2]) == toward]
            holder = holders[np.sign(holders[:, 2]) == toward]
            assert (own[:, :2] >= holder[:, :2].min(axis=0)).all()
            assert (own[:, :2] <= holder[:, :2].max(axis=0)).all()
            assert np.ptp(own[:, 2]) < 1e-6
            assert own[0, 2] * toward - (holder[:, 2] * toward).max() == pytest.approx(0.0012, abs=1e-4)
            assert own[0, 2] * toward <= body.length_m / 2 + 1e-3


def test_painted_plates_cover_the_plate_once():
    parts = painted_plates(CAR_BODIES[0], DRIVEN_PLATE)
    area = 0.0
    for part in parts:
        corners = part.points[part.face_indices].reshape(-1, 3, 3).astype(float)
        across = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
        assert (across[:, 2] * corners[:, 0, 2] > 0).all()  # they look outwards
        area += np.linalg.norm(across, axis=1).sum() / 2
    assert area == pytest.approx(2 * 0.52 * 0.11, rel=1e-4)


def test_in_pictures_a_plate_has_a_class_of_its_own_and_the_id_of_its_car(tmp_path):
    labels = Labels(3, {}, {"/Car": 7, "/Plate": 300}, {7: 16, 300: 35}, {300: NumberPlates(7, "K47 M92")})
    seen = np.array([[7, 300, 0]], dtype=np.int32)
    surfaces = Surfaces(np.zeros((1, 3), np.float32), np.zeros((1, 3, 3), np.float32), seen)
    for kind in (Picture.INSTANCE, Picture.SEMANTIC):
        write_picture(kind, tmp_path / f"{kind}.png", surfaces, labels)
    assert read_ids(tmp_path / "instance.png").tolist() == [[7, 7, 0]]
    assert labels.with_plates(["/Car"]) == ["/Car", "/Plate"]
    assert labels.with_plates(["/Other"]) == ["/Other"]


def test_the_list_of_what_is_seen_has_cars_with_their_plates():
    classes = read_classes()
    labels = Labels(3, classes, {"/Car": 7, "/Plate": 300}, {7: 16, 300: 35}, {300: NumberPlates(7, "K47 M92")})
    seen = [VisibleInstance(7, (10, 10, 20, 20), 80), VisibleInstance(300, (15, 18, 22, 19), 5)]
    told = _seen(seen, labels, {7: "/Car", 300: "/Plate"})
    assert told["instances"] == [{"id": 7, "path": "/Car", "class": "car", "box_px": [10, 10, 22, 20], "pixels": 85}]
    assert told["number_plates"] == [
        {"id": 7, "path": "/Plate", "text": "K47 M92", "box_px": [15, 18, 22, 19], "pixels": 5}
    ]


def read_classes():
    return read_labels(Usd.Stage.CreateInMemory(), None).classes


def test_each_car_has_its_own_plates_in_a_glb(tmp_path):
    result = build(small(), tmp_path / "garage.usdc")
    write_glb(Usd.Stage.Open(str(result.stage)), tmp_path / "garage.glb")
    glb = Glb((tmp_path / "garage.glb").read_bytes())
    plates = [node for node in glb.nodes if node.get("extras", {}).get("class") == "number_plate"]
    cars = [node for node in glb.nodes if node.get("extras", {}).get("class") == "car"]
    assert len({node["mesh"] for node in plates}) == len(plates) == len(cars)
    looks = {car.spec for car in generate(small()).layout.of_kind("car")}
    assert len({node["mesh"] for node in cars}) == len(looks)
