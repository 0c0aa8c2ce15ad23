"""Print the devices on which Blender's Cycles can render, as one line of JSON, as a separate program.

Usage: python -P blender_devices.py

The JSON object maps each kind of device of Cycles to the names of the available devices.
"""

import json
import sys

import bpy

KINDS = ("CPU", "OPTIX", "CUDA", "HIP", "METAL", "ONEAPI")


def main() -> None:
    """Print the devices of Cycles."""
    preferences = bpy.context.preferences.addons["cycles"].preferences
    sys.stdout.write("\n" + json.dumps({kind: _names(preferences, kind) for kind in KINDS}) + "\n")


def _names(preferences: bpy.types.AddonPreferences, kind: str) -> list[str]:
    try:
        devices = preferences.get_devices_for_type(kind)
    except ValueError:  # Blender was built without this kind of device
        return []
    return [device.name for device in devices or [] if device.type == kind]


if __name__ == "__main__":
    main()
