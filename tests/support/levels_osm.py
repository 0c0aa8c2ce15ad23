"""Small OSM files with levels: on each a row of stalls along an aisle, in metres, and ramps between them."""

from collections.abc import Iterable, Mapping, Sequence
from itertools import pairwise
from pathlib import Path

Place = tuple[float, float]
WIDE_M, LONG_M, STALLS = 2.5, 5.0, 12
AISLE_Y, LEFT, RIGHT = 8.5, 0.0, 32.0


class OsmFile:
    """An OSM file under construction; nodes are shared by their key: a place, or a place and a level."""

    def __init__(self) -> None:
        self.nodes: dict[object, tuple[int, Place, Mapping[str, str]]] = {}
        self.ways: list[tuple[list[int], Mapping[str, str]]] = []

    def node(self, place: Place, level: str = "", tags: Mapping[str, str] | None = None) -> int:
        return self.nodes.setdefault((place, level), (len(self.nodes) + 1, place, tags or {}))[0]

    def way(self, places: Iterable[Place], on: str | Sequence[str] = "", **tags: str) -> None:
        places = list(places)
        levels = [on] * len(places) if isinstance(on, str) else on
        self.ways.append(([self.node(place, level) for place, level in zip(places, levels, strict=True)], tags))

    def write(self, path: Path) -> Path:
        def lines(tags: Mapping[str, object]) -> str:
            return "".join(f'<tag k="{key}" v="{value}"/>' for key, value in tags.items())

        text = ['<osm version="0.6">']
        for number, (x, y), tags in self.nodes.values():
            text.append(f'<node id="{number}">{lines({"local_x": x, "local_y": y, **tags})}</node>')
        for number, (nodes, tags) in enumerate(self.ways, 1):
            refs = "".join(f'<nd ref="{node}"/>' for node in nodes)
            text.append(f'<way id="{number}">{refs}{lines(tags)}</way>')
        path.write_text("\n".join([*text, "</osm>"]), encoding="utf-8")
        return path


def add_level(osm: OsmFile, name: str, *, tag: str = "level", stalls: int = STALLS, aisle: bool = True) -> None:
    """Add a row of stalls on both sides of an aisle, with numbers, on a level."""
    for number in range(stalls):
        column, row = divmod(number, 2)
        x, y = 1.0 + column * WIDE_M, (0.5, AISLE_Y + 3.0)[row]
        ring = [(x, y), (x + WIDE_M, y), (x + WIDE_M, y + LONG_M), (x, y + LONG_M), (x, y)]
        osm.way(ring, name, amenity="parking_space", ref=f"{number + 1}", **{tag: name})
    if aisle:
        ends = [(LEFT, AISLE_Y), (RIGHT, AISLE_Y)]
        osm.way(ends, name, highway="service", service="parking_aisle", width="6", **{tag: name})


def ramp_file(*names: str, line: Sequence[Place] = ((-6.0, -10.0), (40.0, -10.0))) -> OsmFile:
    """Return a file of levels, the top one first, with two-way ramps; the level 0 has a lane towards the street."""
    osm = OsmFile()
    for name in names:
        add_level(osm, name, aisle=False)
        tags = {"highway": "service", "service": "parking_aisle", "width": "6", "level": name}
        osm.way([(-18.0 if name == "0" else -6.0, AISLE_Y), (-6.0, AISLE_Y), (40.0, AISLE_Y)], name, **tags)
        for x in (-6.0, 40.0):
            osm.way([(x, AISLE_Y), (x, -10.0)], name, **tags)
    osm.way([(-20, -30), (60, -30), (60, 20), (-20, 20), (-20, -30)], "outline", amenity="parking")
    for upper, lower in pairwise(names):
        levels = [upper, *(["ramp"] * (len(line) - 2)), lower]
        osm.way(line, levels, highway="service", level=f"{lower};{upper}", width="7")
    return osm
