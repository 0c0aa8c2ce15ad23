"""rosbags and mcap read the bag of a drive: pictures, calibrations, points, and transforms that chain up."""

import base64
import json
from collections import Counter
from types import SimpleNamespace

import numpy as np
import pytest
import yaml
from rosbags.typesys import Stores, get_typestore
from scipy.spatial.transform import Rotation
from support.recordings import Recorded
from support.sample_files import REPOSITORY
from support.sensor_judges import HAS_SENSOR_JUDGES, run_judge

from garage2usd.common.errors import ConfigError
from garage2usd.sensors.formats.recording import Recording
from garage2usd.sensors.formats.ros_bag import write_ros_bag
from garage2usd.sensors.rig.rig import read_rig

pytestmark = [pytest.mark.client, pytest.mark.skipif(not HAS_SENSOR_JUDGES, reason="no environment with mcap")]

HAND_DRAWN = REPOSITORY / "samples" / "hand_drawn.toml"
TO_MAP = np.array([[1.0, 0, 0, 0], [0, 0, -1, 0], [0, 1, 0, 0], [0, 0, 0, 1]])
NUMPY = {7: "<f4", 2: "u1", 4: "<u2", 6: "<u4"}
POSES = 2


@pytest.fixture(scope="module")
def bag(builds, tmp_path_factory):
    """What mcap reads of a bag of the LiDAR car, with one of AVP's fisheyes and one of WoodScape's."""
    folder = tmp_path_factory.mktemp("bag")
    (folder / "recorded").mkdir()
    fisheyes = [
        read_rig(name).cameras[0].model_copy(update={"name": name}) for name in ("avp_surround", "woodscape_like")
    ]
    rig = read_rig("lidar_32")
    rig = rig.model_copy(update={"sensors": (*rig.sensors, *fisheyes)})
    recorded = Recorded(builds(HAND_DRAWN, "usdc"), rig, folder / "recorded", places=POSES)
    for name in ("bag", "again/bag"):
        write_ros_bag(recorded.recording, folder / name, stage_to_map=TO_MAP)
    (path,) = (folder / "bag").glob("*.mcap")
    run_judge("mcap_dump.py", path, folder / "found.json", folder=folder)
    found = json.loads((folder / "found.json").read_text())
    return SimpleNamespace(folder=folder, found=found, recorded=recorded, rig=rig)


def of_topic(bag, topic):
    return [read["message"] for read in bag.found if read["topic"] == topic]


def matrix(transform):
    place = np.eye(4)
    place[:3, :3] = Rotation.from_quat([transform["rotation"][axis] for axis in "xyzw"]).as_matrix()
    place[:3, 3] = [transform["translation"][axis] for axis in "xyz"]
    return place


def test_every_topic_has_its_messages_in_time(bag):
    counts = Counter(read["topic"] for read in bag.found)
    names = ("front", "avp_surround", "woodscape_like")
    pictures = {f"/{name}/{topic}": POSES for name in names for topic in ("image_raw/compressed", "camera_info")}
    assert counts == {"/tf_static": 1, "/tf": POSES, "/lidar_top/points": POSES, **pictures}
    times = [read["time"] for read in bag.found]
    assert times == sorted(times)
    assert set(times) == {946_684_800_000_000_000, 946_684_800_500_000_000}


def test_rosbags_reads_the_same_messages(bag):
    from rosbags.highlevel import AnyReader

    with AnyReader([bag.folder / "bag"]) as reader:
        read = [
            (connection.topic, time, reader.deserialize(data, connection.msgtype))
            for connection, time, data in reader.messages()
        ]
    assert Counter((topic, time) for topic, time, _ in read) == Counter(
        (each["topic"], each["time"]) for each in bag.found
    )
    clouds = [message.data.tobytes() for topic, _, message in read if topic == "/lidar_top/points"]
    assert clouds == [base64.b64decode(message["data"]) for message in of_topic(bag, "/lidar_top/points")]


def test_metadata_are_read_by_ros_2_humble_and_iron(bag):
    """They know the versions up to 8, in which the profiles of a topic are a text of numbers."""
    information = yaml.safe_load((bag.folder / "bag/metadata.yaml").read_text())["rosbag2_bagfile_information"]
    assert information["version"] <= 8
    profiles = {
        topic["topic_metadata"]["name"]: topic["topic_metadata"]["offered_qos_profiles"]
        for topic in information["topics_with_message_count"]
    }
    assert all(isinstance(text, str) for text in profiles.values())
    (kept,) = yaml.safe_load(profiles.pop("/tf_static"))
    assert (kept["history"], kept["depth"], kept["reliability"], kept["durability"]) == (1, 1, 1, 1)
    assert set(profiles.values()) == {""}


@pytest.mark.parametrize("distribution", ["humble", "iron", "jazzy", "kilted"])
def test_types_are_those_of_every_ros_2(distribution, bag):
    information = yaml.safe_load((bag.folder / "bag/metadata.yaml").read_text())["rosbag2_bagfile_information"]
    store = get_typestore(Stores[f"ROS2_{distribution.upper()}"])
    for topic in information["topics_with_message_count"]:
        described = topic["topic_metadata"]
        assert described["type_description_hash"] == store.hash_rihs01(described["type"])


def test_points_carry_instance_and_class(bag):
    for message, cloud in zip(of_topic(bag, "/lidar_top/points"), bag.recorded.clouds, strict=True):
        fields = message["fields"]
        row = np.dtype(
            {
                "names": [field["name"] for field in fields],
                "formats": [NUMPY[field["datatype"]] for field in fields],
                "offsets": [field["offset"] for field in fields],
                "itemsize": message["point_step"],
            }
        )
        points = np.frombuffer(base64.b64decode(message["data"]), row)
        assert len(points) == message["width"] == len(cloud)
        assert (np.stack([points[axis] for axis in "xyz"], axis=1) == cloud.points_m).all()
        for name, values in (("intensity", cloud.intensity), ("instance", cloud.instance), ("class", cloud.class_id)):
            assert (points[name] == values).all()
        assert message["header"]["frame_id"] == "lidar_top"


def test_calibrations_are_those_of_the_lenses(bag):
    found = {name: of_topic(bag, f"/{name}/camera_info")[0] for name in ("front", "avp_surround", "woodscape_like")}
    front, fisheye = bag.rig.cameras[:2]
    assert found["front"]["distortion_model"] == "plumb_bob"
    # ROS counts pixels from the middle of the first one
    assert np.reshape(found["front"]["k"], (3, 3)) == pytest.approx(
        np.array([[1266.4, 0, 799.5], [0, 1266.4, 449.5], [0, 0, 1]])
    )
    assert (found["front"]["width"], found["front"]["height"]) == front.size_px
    assert found["avp_surround"]["distortion_model"] == "equidistant"
    assert found["avp_surround"]["d"] == pytest.approx(fisheye.coefficients)
    assert found["avp_surround"]["k"][0] == fisheye.focal_px[0]
    assert not any(found["woodscape_like"]["k"])


def test_transforms_lead_from_a_sensor_to_the_map(bag):
    (static,) = of_topic(bag, "/tf_static")
    places = {each["child_frame_id"]: each for each in static["transforms"]}
    assert {each["header"]["frame_id"] for each in static["transforms"]} == {"base_link"}
    point = np.array([3.0, 1.0, 0.5, 1.0])
    for pose, message in enumerate(of_topic(bag, "/tf")):
        (vehicle,) = message["transforms"]
        assert (vehicle["header"]["frame_id"], vehicle["child_frame_id"]) == ("map", "base_link")
        for sensor in bag.rig.sensors:
            chain = matrix(vehicle["transform"]) @ matrix(places[sensor.name]["transform"])
            expected = bag.recorded.vehicles[pose] @ sensor.sensor_to_vehicle @ point
            assert chain @ point == pytest.approx([expected[0], -expected[2], expected[1], 1])


def test_pictures_are_the_files_and_two_bags_the_same(bag):
    shots = [shot for shot in bag.recorded.recording.shots if shot.sensor.name == "front"]
    for message, shot in zip(of_topic(bag, "/front/image_raw/compressed"), shots, strict=True):
        assert base64.b64decode(message["data"]) == shot.files["colour"].read_bytes()
        assert message["format"] == "png"
    (one,), (other,) = (list((bag.folder / name).glob("*.mcap")) for name in ("bag", "again/bag"))
    assert one.read_bytes() == other.read_bytes()


def test_an_empty_recording_is_refused(bag, tmp_path):
    with pytest.raises(ConfigError, match="whose pictures or points were recorded"):
        write_ros_bag(Recording("own", bag.recorded.recording.stage, ()), tmp_path / "bag", stage_to_map=TO_MAP)
    assert not (tmp_path / "bag").exists()
