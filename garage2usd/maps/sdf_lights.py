"""Lights of a stage as point, spot and directional lights of SDF."""

import math
import xml.etree.ElementTree as ET

import numpy as np

from garage2usd.as_built.contents import PlacedLight
from garage2usd.maps.sdf_collisions import Z_UP
from garage2usd.maps.sdf_text import add_pose, add_text, numbers_text, sdf_name
from garage2usd.maps.xml_text import child

_WHITE_LX = 150.0
"""Illuminance by lamps alone at which a white surface is as bright as a picture can be; Gazebo has no exposure."""
_DARK_LX = 0.5
"""Illuminance below which a lamp no longer counts: the end of its range."""
_WIDEST_RAD = 3.1
"""Widest spot light. Gazebo's falls off by the cosine from the middle to its edge, as a flat lamp of 180 degrees."""
_HALF_ROUND_DEG = 90.0
_DIGITS = 6


def add_light(world: ET.Element, path: str, light: PlacedLight) -> None:
    """Add a light whose irradiance in Gazebo, intensity over squared distance, is a share of white.

    Notes
    -----
    A flat lamp shines as a spot light of nearly 180 degrees, which falls off by the cosine, as the lamp does.
    """
    source = light.source
    is_sun = source.kind == "DistantLight"
    is_point = not is_sun and source.cone_deg > _HALF_ROUND_DEG
    element = child(
        world, "light", name=sdf_name(path), type="directional" if is_sun else "point" if is_point else "spot"
    )
    place = np.eye(4)
    place[:3, 3] = Z_UP[:3, :3] @ light.matrix[3, :3]
    add_pose(element, place)
    add_text(element, "cast_shadows", "false")
    brightest = max(source.colour_rgb)
    strength = (source.lux if is_sun else source.candela) * light.nits_per_unit * brightest / source.brightness
    add_text(element, "intensity", round(strength / _WHITE_LX, _DIGITS))
    colour = f"{numbers_text([part / brightest for part in source.colour_rgb])} 1"
    add_text(element, "diffuse", colour)
    add_text(element, "specular", colour)
    if not is_sun:
        attenuation = child(element, "attenuation")
        for name, value in (
            ("range", round(math.sqrt(strength / _DARK_LX), 3)),
            ("constant", 0.0),
            ("linear", 0.0),
            ("quadratic", 1.0),
        ):
            add_text(attenuation, name, value)
    if is_point:
        return
    ahead = Z_UP[:3, :3] @ -light.matrix[2, :3]
    add_text(element, "direction", numbers_text(ahead / (np.linalg.norm(ahead) or 1.0)))
    if not is_sun:
        softness = 1.0 if source.cone_deg == _HALF_ROUND_DEG else source.softness
        outer = min(2 * math.radians(source.cone_deg), _WIDEST_RAD)
        spot = child(element, "spot")
        add_text(spot, "inner_angle", round(outer * (1 - softness), _DIGITS))
        add_text(spot, "outer_angle", round(outer, _DIGITS))
        add_text(spot, "falloff", 1.0)
