"""Lanelet2 map of a garage, with Autoware's tags."""

from collections.abc import Mapping, Sequence
from pathlib import Path

from garage2usd.as_built import BuiltGarage, BuiltLevel
from garage2usd.config.maps import MapsConfig
from garage2usd.maps.lane_bounds import Bound, LaneBounds, lane_bounds
from garage2usd.maps.lanelet2_parking import add_lots, add_stalls, stall_points
from garage2usd.maps.lanelet2_stops import add_stops
from garage2usd.maps.level_networks import LevelNetwork, level_networks
from garage2usd.maps.network import LEFT, Network
from garage2usd.maps.osm_file import Member, OsmFile
from garage2usd.maps.stage_facts import stage_facts
from garage2usd.maps.xml_text import number_text

__all__ = ["write_lanelet2"]

_FORMAT = "1"
_STRAIGHT_RAD = 0.1


def write_lanelet2(
    garage: BuiltGarage, path: Path, settings: MapsConfig, *, networks: Sequence[LevelNetwork] | None = None
) -> tuple[LaneBounds, ...]:
    """Write a garage as a Lanelet2 map in the common map frame (`garage2usd.maps.frame`).

    Parameters
    ----------
    garage
        The garage.
    path
        The file, in an existing folder.
    settings
        Geographic position and speed limit.
    networks
        Roads of its levels by `garage2usd.maps.level_networks.level_networks`, if already known.

    Returns
    -------
    tuple of LaneBounds
        The lanes of the lanelets, their heights over the floor of their level.

    Raises
    ------
    StageError
        If a level has no complete lane graph, or a ramp leads to no landing.

    Notes
    -----
    A lanelet is a driving lane of a road of `garage2usd.maps.network`, with the numbers that both have in the OpenDRIVE
    map. The last points of one are the first of the next, and the two of an aisle share its middle line. Points are
    `garage2usd.maps.osm_file.APART_M` from one another. Bounds lie within a millimetre of the lane's where such points
    allow it; where a bend is tighter than its lane is wide, the inner one is straight.
    Latitude and longitude follow the projection of the OpenDRIVE map. Stalls are those of
    `garage2usd.maps.lanelet2_parking`.
    """
    osm = OsmFile(settings.latitude_deg, settings.longitude_deg)
    lanes: list[LaneBounds] = []
    for level, network in level_networks(garage) if networks is None else networks:
        osm.floor_m = level.place.floor_m
        lanes += _add_level(osm, level, network, settings)
    facts = {name: str(value) for name, value in stage_facts(garage.stage).items()}
    version = facts.pop("version", "")
    header = {"format_version": _FORMAT, "map_version": version, "name": Path(garage.source).stem, **facts}
    osm.write(path, generator=f"garage2usd {version}".strip(), facts=header)
    return tuple(lanes)


def _add_level(osm: OsmFile, level: BuiltLevel, network: Network, settings: MapsConfig) -> tuple[LaneBounds, ...]:
    """Write the lanes, stalls and stops of a level, and return its lanes."""
    stalls = stall_points(osm, level)
    lanes = lane_bounds(network, osm)
    feet = add_stalls(osm, level, lanes, stalls)
    stops = add_stops(osm, level, lanes)
    ways: dict[Bound, int] = {}
    for lane in lanes:
        for bound, is_left in ((lane.left, True), (lane.right, False)):
            if bound not in ways:
                points = feet.along(bound)
                is_turned = lane.lane == LEFT and not is_left
                ways[bound] = osm.way(points[::-1] if is_turned else points, _bound_tags(bound))
        members = [Member("way", ways[lane.left], "left"), Member("way", ways[lane.right], "right")]
        members += [Member("relation", rule, "regulatory_element") for rule in stops.get(lane, ())]
        osm.relation(members, _lanelet_tags(lane, settings))
    add_lots(osm, lanes, feet)
    return lanes


def _bound_tags(bound: Bound) -> dict[str, str]:
    """Return the tags of a lane bound: no lane change over the middle line; other bounds may be crossed into stalls."""
    return {"type": "line_thin", "subtype": "dashed", "lane_change": "no"} if bound.is_middle else {"type": "virtual"}


def _lanelet_tags(lane: LaneBounds, settings: MapsConfig) -> Mapping[str, str]:
    turn = {}
    if lane.road.junction is not None:
        is_straight = abs(lane.turned_rad) < _STRAIGHT_RAD
        turn = {"turn_direction": "straight" if is_straight else "left" if lane.turned_rad > 0 else "right"}
    return {
        "type": "lanelet",
        "subtype": "road",
        "location": "urban",
        "one_way": "yes",
        "participant:vehicle": "yes",
        "speed_limit": number_text(settings.speed_limit_km_h),
        **turn,
        "road": str(lane.road.number),
        "lane": str(lane.lane),
    }
