"""Tracks as ground truth of ASAM OSI in an MCAP trace."""

from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np

from garage2usd.common.package import VERSION, of_extra
from garage2usd.config.vehicles import CAR_BODIES
from garage2usd.driving.tracks import Agent, AgentClass, AgentState, Track, Tracks
from garage2usd.maps.frame import map_points

with of_extra("a trace of OSI", "traffic"):
    import google.protobuf
    import osi3
    from mcap.writer import CompressionType, Writer
    from mcap_protobuf.schema import build_file_descriptor_set
    from osi3.osi_groundtruth_pb2 import GroundTruth
    from osi3.osi_object_pb2 import MovingObject

TOPIC = "ground_truth"
"""Topic of the messages."""
_NS = 1_000_000_000
_WRITTEN = "2000-01-01T00:00:00Z"
"""Constant time of writing, so that files are reproducible."""
_CLASSES = {
    "city": "SMALL_CAR",
    "hatchback": "COMPACT_CAR",
    "mpv": "MEDIUM_CAR",
    "pickup": "MEDIUM_CAR",
    "sports": "LUXURY_CAR",
    "van": "DELIVERY_VAN",
}
"""OSI's classes of vehicles by segment; others are medium cars."""
_TYPES = {AgentClass.PERSON: MovingObject.TYPE_PEDESTRIAN, AgentClass.TROLLEY: MovingObject.TYPE_OTHER}
_BODIES = {body.name: body for body in CAR_BODIES}
_VERSION = tuple(map(int, osi3.__version__.split(".")[:3]))


def write_osi_trace(path: Path, tracks: Tracks, *, step_s: float | None = None) -> None:
    """Write tracks as an MCAP trace of ``osi3.GroundTruth``, one message for each time step.

    Parameters
    ----------
    path
        The file.
    tracks
        The tracks.
    step_s
        Time step; by default that of the tracks.

    Notes
    -----
    The global frame is that of all maps (`garage2usd.maps.frame`). An object's number is that of its track, from 1; its
    name is its ``source_reference``. Positions are middles of bounding boxes, half their height above the floor, and
    a nose that points up has a negative pitch.
    """
    with path.open("wb") as file:
        writer = Writer(file, compression=CompressionType.ZSTD)
        writer.start(library=f"garage2usd {VERSION}")
        versions = {"osi_version": osi3.__version__, "protobuf_version": google.protobuf.__version__}
        span = {f"{end}_{name}": version for name, version in versions.items() for end in ("min", "max")}
        writer.add_metadata(
            "net.asam.osi.trace",
            {
                "version": osi3.__version__,
                **span,
                "zero_time": _WRITTEN,
                "creation_time": _WRITTEN,
                "description": "traffic in a garage",
                "authors": f"garage2usd {VERSION}",
                "data_sources": tracks.source or "garage2usd",
            },
        )
        schema = writer.register_schema(
            "osi3.GroundTruth", "protobuf", build_file_descriptor_set(GroundTruth).SerializeToString()
        )
        told = {f"net.asam.osi.trace.channel.{name}": version for name, version in versions.items()}
        told["net.asam.osi.trace.channel.description"] = "all agents that move"
        channel = writer.register_channel(TOPIC, "protobuf", schema, told)
        for time_ns, data in _messages(tracks, step_s):
            writer.add_message(channel, log_time=time_ns, data=data, publish_time=time_ns)
        writer.finish()


def _messages(tracks: Tracks, step_s: float | None) -> Iterator[tuple[int, bytes]]:
    """Yield time and bytes of each message."""
    times = tracks.times(step_s)
    rows: list[list[tuple[MovingObject, list[float]]]] = [[] for _ in times]
    for number, track in enumerate(tracks, 1):
        own, moving = track.sampled(times), _described(track.agent, number)
        first = int(np.searchsorted(times, own.time_s[0] - 1e-9)) if len(own) else 0
        for at, values in enumerate(_states(own), first):
            rows[at].append((moving, values))
    for time, row in zip(times.tolist(), rows, strict=True):
        message = GroundTruth()
        time_ns = round(time * _NS)
        message.timestamp.seconds, message.timestamp.nanos = divmod(time_ns, _NS)
        message.version.version_major, message.version.version_minor, message.version.version_patch = _VERSION
        for moving, values in row:
            _set_state(moving.base, values)
            message.moving_object.append(moving)
        # the order of fields is that of their numbers, equal for equal messages
        yield time_ns, message.SerializeToString(deterministic=True)


def _states(own: Track) -> list[list[float]]:
    """Position, orientation, velocity, acceleration and yaw rate at each time."""
    places = map_points(np.stack([own.x_m, own.z_m], axis=1))
    # `remainder` after two quarter turns keeps headings in the interval that OSI asks for
    heading = np.mod(own.yaw_rad + np.pi / 2 + np.pi, 2 * np.pi) - np.pi
    level = np.cos(own.pitch_rad)
    along = np.stack([level * np.cos(heading), level * np.sin(heading), np.sin(own.pitch_rad)], axis=1)
    turning = np.gradient(own.yaw_rad, own.time_s) if len(own) > 1 else np.zeros(len(own))
    stands = (own.state == AgentState.PARKED) | (own.state == AgentState.STANDS)
    speed, rate = np.where(stands, 0.0, own.speed_m_s), np.where(stands, 0.0, own.acceleration_m_s2)
    height = own.y_m + own.agent.height_m / 2
    columns = [places[:, 0], places[:, 1], height, heading, -own.pitch_rad]
    columns += [*(along * speed[:, None]).T, *(along * rate[:, None]).T, np.where(stands, 0.0, turning)]
    rows: list[list[float]] = (np.round(np.stack(columns, axis=1), 5) + 0.0).tolist()
    return rows


def _set_state(base: Any, values: list[float]) -> None:  # noqa: ANN401 - a message of protobuf
    base.position.x, base.position.y, base.position.z = values[:3]
    base.orientation.yaw, base.orientation.pitch = values[3:5]
    base.velocity.x, base.velocity.y, base.velocity.z = values[5:8]
    base.acceleration.x, base.acceleration.y, base.acceleration.z = values[8:11]
    base.orientation_rate.yaw = values[11]


def _described(agent: Agent, number: int) -> MovingObject:
    """Make a moving object without its state."""
    moving = MovingObject()
    moving.id.value = number
    moving.base.dimension.length, moving.base.dimension.width = agent.length_m, agent.width_m
    moving.base.dimension.height = agent.height_m
    moving.base.orientation.roll = 0.0
    reference = moving.source_reference.add()
    reference.type = "garage2usd"
    reference.identifier.append(agent.name)
    if agent.behaviour:
        reference.identifier.append(agent.behaviour)
    moving.type = _TYPES.get(agent.kind, MovingObject.TYPE_VEHICLE)
    if moving.type != MovingObject.TYPE_VEHICLE:
        return moving
    body = _BODIES.get(agent.body)
    attributes, classification = moving.vehicle_attributes, moving.vehicle_classification
    wheel_m = body.wheel_radius_m if body else 0.0
    to_axles = {"bbcenter_to_rear": -agent.rear_axle_m, "bbcenter_to_front": agent.wheelbase_m - agent.rear_axle_m}
    for name, ahead_m in to_axles.items():
        vector = getattr(attributes, name)
        vector.x, vector.y, vector.z = ahead_m, 0.0, wheel_m - agent.height_m / 2
    attributes.number_wheels = 4
    if body:
        attributes.radius_wheel = wheel_m
    large = {AgentClass.VAN: "DELIVERY_VAN", AgentClass.TRUCK: "HEAVY_TRUCK"}.get(agent.kind)
    kind = large or _CLASSES.get(body.segment if body else "", "MEDIUM_CAR")
    classification.type = MovingObject.VehicleClassification.Type.Value(f"TYPE_{kind}")
    classification.role = MovingObject.VehicleClassification.ROLE_CIVIL
    return moving
