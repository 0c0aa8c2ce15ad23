"""rosbags reads the bag of a recording in traffic: agents as the tracks have them, the map, and the files for RViz."""

from collections import defaultdict
from types import SimpleNamespace

import numpy as np
import pytest
import yaml
from rosbags.highlevel import AnyReader
from rosbags.typesys import Stores, get_typestore
from scipy.spatial.transform import Rotation
from support.launch_files import launched
from support.map_reader import read_map
from support.recorded_traffic import EGO, TOP, Recorded, middle_of
from support.small_levels import FLOORS_M, SMALL_LEVELS

import garage2usd
from garage2usd.recordings import CloudFormat, Sequence, record
from garage2usd.sensors.rig.rig import rig_from_mapping

pytestmark = pytest.mark.client
BEGINS_S = 946_684_800
CUBE, TEXT, DELETE = 1, 9, 2
MILLIMETRE = 1e-3


@pytest.fixture(scope="module")
def bag(tmp_path_factory):
    folder = tmp_path_factory.mktemp("traffic bag")
    recorded = Recorded(folder, rig_from_mapping({"name": "own", "sensors": [TOP]}), sequences=[Sequence.ROS2])
    messages, connections = defaultdict(list), {}
    with AnyReader([recorded.made.folder / "ros2"]) as reader:
        for connection, time_ns, data in reader.messages():
            connections[connection.topic] = connection
            message = reader.deserialize(data, connection.msgtype)
            messages[connection.topic].append((time_ns / 1e9 - BEGINS_S, message))
    return SimpleNamespace(recorded=recorded, folder=recorded.made.folder, messages=messages, connections=connections)


def pose_of(track, time_s):
    """Place (x, y, z) of a track in the map, and the direction of its nose and of its roof."""
    there = middle_of(track, time_s)
    ahead = np.array([-np.sin(there.yaw) * np.cos(there.pitch), np.cos(there.yaw) * np.cos(there.pitch)])
    nose = np.array([ahead[0], ahead[1], np.sin(there.pitch)])
    side = np.array([np.cos(there.yaw), np.sin(there.yaw), 0.0])
    return np.array([there.x, -there.z, there.y]), nose, np.cross(side, nose)


def xyz(vector):
    return np.array([vector.x, vector.y, vector.z])


def turn_of(quaternion):
    return Rotation.from_quat([quaternion.x, quaternion.y, quaternion.z, quaternion.w]).as_matrix()


def test_markers_are_boxes_where_the_tracks_are(bag):
    ids, seen, last = defaultdict(set), defaultdict(int), {}
    for time_s, message in bag.messages["/agents"]:
        shown = {}
        for marker in message.markers:
            assert marker.header.frame_id == "map"
            if marker.action == DELETE:
                assert (marker.ns, marker.id) in last
                continue
            shown[marker.ns, marker.id] = marker
        names = {marker.id: marker.text for (ns, _), marker in shown.items() if ns == "names"}
        for marker in shown.values():
            track = bag.recorded.by_name[names[marker.id]]
            place, nose, up = pose_of(track, time_s)
            agent = track.agent
            ids[agent.name].add(marker.id)
            if marker.ns == "names":
                assert marker.type == TEXT
                continue
            assert (marker.type, marker.ns) == (CUBE, agent.kind.value)
            assert xyz(marker.pose.position) == pytest.approx(place + up * agent.height_m / 2, abs=MILLIMETRE)
            assert xyz(marker.scale) == pytest.approx([agent.length_m, agent.width_m, agent.height_m])
            assert turn_of(marker.pose.orientation)[:, 0] == pytest.approx(nose, abs=MILLIMETRE)
            seen[agent.name] += 1
        removed = {(marker.ns, marker.id) for marker in message.markers if marker.action == DELETE}
        assert removed == last.keys() - shown.keys()
        last = shown
    # an agent has one id, and no other has it
    assert all(len(own) == 1 for own in ids.values())
    assert len({number for own in ids.values() for number in own}) == len(ids)
    expected = {
        name: sum(np.isfinite(track.at(np.array([time_s]))).all() for time_s, _ in bag.messages["/agents"])
        for name, track in bag.recorded.by_name.items()
        if name != EGO
    }
    assert seen == {name: count for name, count in expected.items() if count}
    assert len(seen) > 2


def test_transforms_lead_to_the_tracks(bag):
    found = defaultdict(list)
    for time_s, message in bag.messages["/tf"]:
        for each in message.transforms:
            stamp = each.header.stamp
            assert stamp.sec + stamp.nanosec / 1e9 - BEGINS_S == pytest.approx(time_s, abs=1e-6)
            assert each.header.frame_id == "map"
            found[each.child_frame_id].append((time_s, each.transform))
    assert found.keys() == {"base_link", "car_001", "car_900", "person_000"}
    for name, places in found.items():
        track = bag.recorded.by_name[EGO if name == "base_link" else name]
        for time_s, transform in places:
            place, nose, _ = pose_of(track, time_s)
            if name == "base_link":
                place = place - nose * track.agent.rear_axle_m
            assert xyz(transform.translation) == pytest.approx(place, abs=MILLIMETRE)
            assert turn_of(transform.rotation)[:, 0] == pytest.approx(nose, abs=MILLIMETRE)
    assert len(found["base_link"]) == len(bag.messages["/agents"])


def test_the_map_is_latched_and_has_the_cells_of_nav2_s(bag, tmp_path):
    ((_, message),) = bag.messages["/map"]
    (qos,) = bag.connections["/map"].ext.offered_qos_profiles
    assert (qos.durability.name, qos.reliability.name, qos.depth) == ("TRANSIENT_LOCAL", "RELIABLE", 1)
    garage2usd.export(bag.recorded.stage, [tmp_path / "g.yaml"])
    expected = read_map(tmp_path / "g.yaml")
    assert message.info.resolution == pytest.approx(expected.side)
    assert xyz(message.info.origin.position)[:2] == pytest.approx(expected.origin[:2])
    cells = message.data.reshape(message.info.height, message.info.width)
    assert cells.shape == expected.cells.shape
    differ = np.argwhere(cells != expected.cells)
    # the one car of the stage that moves is not part of the map
    assert 500 < len(differ) < 6000
    assert (cells[tuple(differ.T)] == 0).all()
    prims = [track.agent.prim for track in bag.recorded.tracks if track.agent.prim]
    (track,) = (track for track in bag.recorded.tracks if track.agent.prim)
    assert len(prims) == 1
    places = (differ + 0.5) * expected.side + np.array(expected.origin[:2])[::-1]
    middle = pose_of(track, float(track.time_s[0]))[0][:2]
    assert np.abs(places[:, ::-1] - middle).max() < track.agent.length_m / 2 + 0.3


def test_points_have_rings_and_times(bag):
    assert len(bag.messages["/top/points"]) > 10
    for _, cloud in bag.messages["/top/points"]:
        names = [field.name for field in cloud.fields]
        assert names == ["x", "y", "z", "intensity", "instance", "class", "ring", "time"]
        kinds = {7: "<f4", 2: "u1", 4: "<u2", 6: "<u4"}
        row = np.dtype(
            {
                "names": names,
                "formats": [kinds[field.datatype] for field in cloud.fields],
                "offsets": [field.offset for field in cloud.fields],
                "itemsize": cloud.point_step,
            }
        )
        points = np.frombuffer(cloud.data.tobytes(), row)
        # half a turn of 5 Hz to each side of the stamp
        assert -0.1001 < points["time"].min() < -0.05
        assert 0.05 < points["time"].max() < 0.1001
        assert points["ring"].max() < TOP["channels"]
        assert len(np.unique(points["ring"])) > 12


@pytest.mark.parametrize("distribution", ["humble", "iron", "jazzy", "kilted"])
def test_types_are_those_of_every_ros_2(distribution, bag):
    store = get_typestore(Stores[f"ROS2_{distribution.upper()}"])
    for topic, connection in bag.connections.items():
        assert connection.digest == store.hash_rihs01(connection.msgtype), topic


def test_rviz_and_the_launch_file_name_what_the_bag_has(bag):
    view = yaml.safe_load((bag.folder / "ros2.rviz").read_text())["Visualization Manager"]
    topics = {display["Topic"]["Value"] for display in view["Displays"] if "Topic" in display}
    assert topics == {"/map", "/agents", "/top/points"}
    latched = [each for each in view["Displays"] if each.get("Topic", {}).get("Durability Policy") == "Transient Local"]
    assert [each["Topic"]["Value"] for each in latched] == ["/map"]
    assert (view["Global Options"]["Fixed Frame"], view["Views"]["Current"]["Target Frame"]) == ("map", "base_link")
    arguments, (player, rviz) = launched(bag.folder / "ros2.launch.py")
    assert arguments == {"rate": "1.0", "rviz": "true"}
    assert player["cmd"] == ["ros2", "bag", "play", str(bag.folder / "ros2"), "--clock", "--rate", "$rate"]
    assert rviz["arguments"] == ["-d", str(bag.folder / "ros2.rviz")]


def test_each_level_has_its_map_at_its_height(tmp_path):
    stage = garage2usd.build(SMALL_LEVELS, tmp_path / "g.usdc").stage
    rig = rig_from_mapping({"name": "own", "sensors": [TOP | {"mount": "world", "position_m": (8.0, -8.0, 2.0)}]})
    made = record(stage, tmp_path / "out", rig=rig, points=[CloudFormat.NPZ], sequences=[Sequence.ROS2])
    with AnyReader([made.folder / "ros2"]) as reader:
        messages = {
            connection.topic: reader.deserialize(data, connection.msgtype) for connection, _, data in reader.messages()
        }
    assert messages.keys() == {"/tf_static", "/top/points", "/map_U1", "/map_U2"}
    assert {name: messages[f"/map_{name}"].info.origin.position.z for name in FLOORS_M} == pytest.approx(FLOORS_M)
    garage2usd.export(stage, [tmp_path / "g.yaml"])
    for name in FLOORS_M:
        expected, found = read_map(tmp_path / f"g_{name}.yaml"), messages[f"/map_{name}"]
        assert (found.data.reshape(found.info.height, found.info.width) == expected.cells).all()
    view = yaml.safe_load((made.folder / "ros2.rviz").read_text())["Visualization Manager"]
    assert view["Views"]["Current"]["Target Frame"] == "map"
