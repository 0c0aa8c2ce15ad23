"""Everything that is placed in a garage, as plain meshes, materials and textures, free of any file format."""

from garage2usd.assets.access import barrier, ramp, sky
from garage2usd.assets.building import (
    beam,
    beam_node,
    ceiling_panel,
    column,
    obstacle_block,
    portal_wall,
    wall_panel,
    wall_post,
)
from garage2usd.assets.cars import car
from garage2usd.assets.fittings import charger, cone, duct, no_parking_sign, speed_bump, tube_light, wheel_stop
from garage2usd.assets.floor import Marking, floor_panel
from garage2usd.assets.lettering import floor_number, zone_plate
from garage2usd.assets.materials import MATERIALS, VARYING, Material, Touch
from garage2usd.assets.mesh import Asset, Collider, Part, RectLight
from garage2usd.assets.overhead import cable_tray, exit_sign, mirror, sprinkler
from garage2usd.assets.stains import floor_stain, tyre_marks
from garage2usd.assets.textures import bake_textures, texture_folder

__all__ = [
    "MATERIALS",
    "VARYING",
    "Asset",
    "Collider",
    "Marking",
    "Material",
    "Part",
    "RectLight",
    "Touch",
    "bake_textures",
    "barrier",
    "beam",
    "beam_node",
    "cable_tray",
    "car",
    "ceiling_panel",
    "charger",
    "column",
    "cone",
    "duct",
    "exit_sign",
    "floor_number",
    "floor_panel",
    "floor_stain",
    "mirror",
    "no_parking_sign",
    "obstacle_block",
    "portal_wall",
    "ramp",
    "sky",
    "speed_bump",
    "sprinkler",
    "texture_folder",
    "tube_light",
    "tyre_marks",
    "wall_panel",
    "wall_post",
    "wheel_stop",
    "zone_plate",
]
