"""Countries of the shipped profiles, by outlines on the earth.

``countries.json`` has the outlines of Natural Earth (public domain, 1:10,000,000) to about two kilometres, with the sea
up to ten kilometres from the coast, so that piers and islands lie inside.
"""

import json
from functools import cache
from importlib import resources

import shapely

from garage2usd.profiles.profile import PROFILE_NAMES, shipped_settings


def profile_at(latitude_deg: float, longitude_deg: float) -> str | None:
    """Return the name of the shipped profile of the country at a place (WGS 84); None without one."""
    place = shapely.Point(longitude_deg, latitude_deg)
    return next((name for name, ground in _grounds().items() if ground.covers(place)), None)


@cache
def _grounds() -> dict[str, shapely.MultiPolygon]:
    """Return the ground of the country of each shipped profile, in degrees of longitude and latitude."""
    text = (resources.files("garage2usd.profiles") / "countries.json").read_text(encoding="utf-8")
    outlines = json.loads(text)
    return {
        name: shapely.MultiPolygon([shapely.Polygon(ring) for ring in outlines[shipped_settings(name)["country"]]])
        for name in PROFILE_NAMES
    }
