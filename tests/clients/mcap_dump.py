"""Run with mcap: read a ROS 2 bag; usage: mcap_dump.py FILE.mcap OUT.json."""

import base64
import json
import sys

from mcap_ros2.reader import read_ros2_messages


def told(value):
    """A message as JSON; bytes as base64."""
    if isinstance(value, bytes | bytearray | memoryview):
        return base64.b64encode(bytes(value)).decode()
    if hasattr(value, "__slots__"):
        return {name: told(getattr(value, name)) for name in value.__slots__}
    if isinstance(value, list | tuple):
        return [told(each) for each in value]
    return value


found = [
    {"topic": read.channel.topic, "type": read.schema.name, "time": read.log_time_ns, "message": told(read.ros_msg)}
    for read in read_ros2_messages(sys.argv[1])
]
with open(sys.argv[2], "w") as file:
    json.dump(found, file)
