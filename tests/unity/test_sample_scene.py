"""The sample's scene: its references hold by a reader of Unity's files that is not ours, and its car drives."""

import re
import shutil

import numpy as np
import pytest
import shapely
from make_meta import guid_of
from support.unity.reader import PACKAGE
from unityparser import UnityDocument

SAMPLE = PACKAGE / "Samples~" / "SmallGarage"
SCENE = SAMPLE / "SmallGarage.unity"
BUILT_IN = "0" * 32


@pytest.fixture(scope="module")
def scene():
    return UnityDocument.load_yaml(str(SCENE))


def values(part, name=""):
    """All values of a document with the names of their keys."""
    if isinstance(part, dict):
        for key, value in part.items():
            yield from values(value, key)
        if "fileID" in part:
            yield name, part
    elif isinstance(part, list):
        for value in part:
            yield from values(value, name)
    else:
        yield name, part


def entries(scene):
    return {entry.anchor: entry for entry in scene.entries}


def fields_of(entry):
    """What the file has of a document, without what the reader adds."""
    return {name: value for name, value in vars(entry).items() if name not in {"anchor", "extra_anchor_data"}}


def test_every_reference_leads_to_an_object_of_the_scene_or_a_file_of_the_package(scene):
    known = entries(scene)
    assert len(known) == len(scene.entries)
    guids = {
        re.search(r"^guid: (\w{32})$", meta.read_text(), re.MULTILINE)[1]: meta.with_suffix("")
        for meta in PACKAGE.rglob("*.meta")
    }
    scripts = []
    for entry in scene.entries:
        for name, value in values(fields_of(entry)):
            if isinstance(value, dict) and "guid" in value:
                file = guids[value["guid"]]
                scripts.append(file.name)
                assert (name, str(value["fileID"]), str(value["type"])) == ("m_Script", "11500000", "3")
            elif isinstance(value, dict):
                assert str(value["fileID"]) == "0" or str(value["fileID"]) in known, name
    assert sorted(scripts) == ["DriveAlongLanes.cs", "GarageScene.cs"]
    # the same text names any asset by its GUID
    named = set(re.findall(r"\b[0-9a-f]{32}\b", SCENE.read_text())) - {BUILT_IN}
    assert named <= guids.keys()
    assert guids[behaviour(scene, "GarageScene").assetGuid] == SAMPLE / "SmallGarage.usdz"
    assert behaviour(scene, "GarageScene").file == "SmallGarage.usdz"


def test_objects_and_their_components_know_each_other(scene):
    known = entries(scene)
    objects = [entry for entry in scene.entries if entry.__class__.__name__ == "GameObject"]
    assert [entry.m_Name for entry in objects] == ["Garage", "Car", "Camera"]
    for entry in objects:
        parts = [known[str(part["component"]["fileID"])] for part in entry.m_Component]
        assert parts[0].__class__.__name__ == "Transform"
        assert all(str(part.m_GameObject["fileID"]) == entry.anchor for part in parts)
    owned = {str(part["component"]["fileID"]) for entry in objects for part in entry.m_Component}
    components = {entry.anchor for entry in scene.entries if hasattr(entry, "m_GameObject")}
    assert owned == components
    for entry in (entry for entry in scene.entries if entry.__class__.__name__ == "Transform"):
        assert all(str(known[str(child["fileID"])].m_Father["fileID"]) == entry.anchor for child in entry.m_Children)
        father = str(entry.m_Father["fileID"])
        assert father == "0" or entry.anchor in [str(child["fileID"]) for child in known[father].m_Children]
    assert "Camera" in {entry.__class__.__name__ for entry in scene.entries}


def test_scripts_have_the_fields_that_the_scene_gives_them(scene):
    for name in ("GarageScene", "DriveAlongLanes"):
        text = (SAMPLE / f"{name}.cs").read_text()
        declared = set(re.findall(r"\[SerializeField\] \w+ (\w+)", text))
        assert own_fields(scene, name).keys() == declared
    assert str(behaviour(scene, "DriveAlongLanes").m_Enabled) == "0"  # until there is a garage


def test_its_car_drives_along_the_lanes_from_the_entrance_to_the_exit(scene, prefabs, prefab_dump, tmp_path):
    # as the package manager copies a sample, with its metas
    copied = tmp_path / "Assets" / "Samples" / "Garage USD Importer" / "0.1.0" / "Small Garage"
    shutil.copytree(SAMPLE, copied)
    given = [
        f"{name}.{field}={value}"
        for name in ("GarageScene", "DriveAlongLanes")
        for field, value in own_fields(scene, name).items()
        if not isinstance(value, dict)
    ]
    told = prefab_dump.ask("scene", copied / "SmallGarage.usdz", 400, *given)
    assert "crash" not in told, told["crash"]
    assert (told["garage"], told["drives"]) == ("SmallGarage(Clone) in Garage", "yes")
    graph = prefabs(SAMPLE / "SmallGarage.usdz").found["graph"]
    places = {node["kind"]: np.array(node["position"]) for node in graph["nodes"]}
    driven = np.array([step["position"] for step in told["steps"]])
    # nodes of the lane graph lie above the floor, the car on it
    assert np.allclose(driven[0], places["entrance"] - [0, 0.05, 0], atol=1e-3)
    # rounds at 3 m/s, each from the entrance to the exit
    steps = np.diff(driven, axis=0)
    (ends,) = np.nonzero(np.linalg.norm(steps, axis=1) > 0.301)
    assert len(ends) >= 2
    for end in ends:
        assert np.linalg.norm((driven[end] - places["exit"])[[0, 2]]) < 0.301
        assert np.linalg.norm((driven[end + 1] - places["entrance"])[[0, 2]]) < 1e-3
    lanes = shapely.MultiLineString(
        [[graph["nodes"][end]["position"][::2] for end in (edge["from"], edge["to"])] for edge in graph["edges"]]
    )
    assert shapely.distance(lanes, shapely.points(driven[:, [0, 2]])).max() < 1e-3
    assert np.allclose(driven[:, 1], 0, atol=1e-3)
    # it looks where it drives, and has the body of a parked car
    ahead = np.array([step["forward"] for step in told["steps"]])
    along = np.einsum("ij,ij->i", steps, ahead[:-1])[: ends[0]]
    assert along.min() > 0
    assert np.median(along) == pytest.approx(0.3, abs=1e-3)
    cars = {item["path"].rpartition("/")[2] for item in prefabs(SAMPLE / "SmallGarage.usdz").labelled("car")}
    assert told["body"].removesuffix("(Clone)") in cars


def test_without_the_garage_the_scene_says_so_and_nothing_drives(scene, prefab_dump, tmp_path):
    copied = tmp_path / "Assets"
    shutil.copytree(SAMPLE, copied)
    told = prefab_dump.ask("scene", copied / "SmallGarage.usdz", 5, f"GarageScene.assetGuid={guid_of(copied)}")
    assert (told["garage"], told["drives"], told["steps"]) == ("", "no", [])


def own_fields(scene, name):
    """Fields that a script itself declares."""
    return {key: value for key, value in fields_of(behaviour(scene, name)).items() if not key.startswith("m_")}


def behaviour(scene, name):
    """The component of a script."""
    guid = re.search(r"guid: (\w{32})", (SAMPLE / f"{name}.cs.meta").read_text())[1]
    (found,) = [
        entry
        for entry in scene.entries
        if entry.__class__.__name__ == "MonoBehaviour" and entry.m_Script["guid"] == guid
    ]
    return found
