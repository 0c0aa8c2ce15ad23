"""Run as a program of its own: print the devices on which Blender's Cycles can draw, as JSON on a line.

Usage: python -P blender_devices.py

Each kind of device that Cycles knows has the names of those that are there.
"""

import json
import sys

import bpy

KINDS = ("CPU", "OPTIX", "CUDA", "HIP", "METAL", "ONEAPI")


def main() -> None:
    """Ask Cycles."""
    preferences = bpy.context.preferences.addons["cycles"].preferences
    sys.stdout.write("\n" + json.dumps({kind: _names(preferences, kind) for kind in KINDS}) + "\n")


def _names(preferences: bpy.types.AddonPreferences, kind: str) -> list[str]:
    try:
        devices = preferences.get_devices_for_type(kind)
    except ValueError:  # Blender was made without it
        return []
    return [device.name for device in devices or [] if device.type == kind]


if __name__ == "__main__":
    main()
