"""Parking zones named by letter and number (``B2``) along the aisles, and the numbers of stalls in driving order."""

import math
import string
from collections import Counter, defaultdict
from collections.abc import Collection, Iterator, Mapping, Sequence
from dataclasses import replace
from itertools import chain, pairwise

import networkx as nx

from garage2usd.garage import LaneKind
from garage2usd.layout.placement import PlacedStall
from garage2usd.structure.lane_graph import LaneSquares, Square
from garage2usd.structure.lanes import aisles_of
from garage2usd.structure.stalls import Edge

_LETTERS = "".join(letter for letter in string.ascii_uppercase if letter not in "IO")
_MOST_NUMBER = 99
_USUAL_STALLS, _FEW_STALLS = 40, 12
"""Stalls of a zone, at which a longer aisle is divided, and below which an aisle belongs to the zone beside it."""
_MOST_WITHOUT_END = 1.5
"""Usual numbers of stalls above which a stretch without junctions is divided at its bends."""
_BESIDE = {Edge.DOWN: Edge.RIGHT, Edge.RIGHT: Edge.UP, Edge.UP: Edge.LEFT, Edge.LEFT: Edge.DOWN}
"""Direction of driving with each side of a square on the right."""
_ROUNDING = 6

_Side = tuple[Square, Edge]
"""A lane square, and one of its edges."""
_Stretch = tuple[Square, ...]
"""Lane squares from one junction or dead end to the next."""
_Place = tuple[int, int]
"""Place of a zone on the way from the entrance: numbers of its aisle and of its part of the aisle."""


def zone_of(number: str) -> str:
    """Return the name of the zone in a stall's number, ``B2`` of ``B2-07``; empty without one."""
    zone = number.rpartition("-")[0]
    return zone if len(zone) > 1 and zone[0] in string.ascii_uppercase and set(zone[1:]) <= {*string.digits} else ""


def with_numbers(
    stalls: Sequence[PlacedStall], lanes: LaneSquares, *, has_zones: bool, keeps_left: bool
) -> tuple[PlacedStall, ...]:
    """Number the stalls along the aisles, for example ``B2-07`` by zone, or ``007`` in a garage without zones.

    Parameters
    ----------
    stalls, lanes
        Stalls, and the lanes that they open onto. Stalls in which nobody parks get no number.
    has_zones
        True if numbers begin with the zone of the aisle, and count from 1 in each zone.
    keeps_left
        True if traffic keeps to the left.

    Notes
    -----
    A letter names an aisle, straight on from junction to junction, and letters follow the way from the entrance. Zones
    are the parts of about 40 stalls into which junctions divide the aisle; a stretch of more than 60 stalls between two
    junctions is also divided at its bends. An aisle of fewer than 12 stalls belongs to the zone at that end of it which
    is nearer to the entrance. The numbers of a zone follow a driver who keeps to the
    side of traffic all around its lanes: up one side of the aisle, and back down the other.
    """
    by_side: defaultdict[_Side, list[int]] = defaultdict(list)
    counts: Counter[Square] = Counter()
    for index, stall in enumerate(stalls):
        if stall.use.is_parked_in:
            by_side[stall.access_square, stall.edge.opposite].append(index)
            counts[stall.access_square] += 1
    driven_m, usual_stalls = _driven_m(lanes), _USUAL_STALLS if has_zones else math.inf
    owners = _owners(aisles := _aisles(lanes, driven_m, counts, _MOST_WITHOUT_END * usual_stalls))
    zones = _zones(aisles, owners, counts, usual_stalls)
    names = zone_names([*zones]) if has_zones else dict.fromkeys(zones, "")
    numbers, reached = {}, Counter[str]()
    for place, stretches in zones.items():
        name, squares = names[place], {square for stretch in stretches for square in stretch}
        for square, edge in _round_trip(squares, driven_m, keeps_left=keeps_left):
            ahead = _ahead(edge, keeps_left=keeps_left)
            for index in sorted(by_side[square, edge], key=lambda index: _along_m(stalls[index], ahead)):
                if owners[square] in stretches:
                    reached[name] += 1
                    numbers[index] = f"{name}-{reached[name]:02d}" if name else f"{reached[name]:03d}"
    return tuple(replace(stall, number=numbers.get(index, "")) for index, stall in enumerate(stalls))


def _driven_m(lanes: LaneSquares) -> dict[Square, float]:
    """Return the driven distance in metres from the nearest entrance to each lane and portal square."""
    graph = lanes.lanes
    found = nx.multi_source_dijkstra_path_length(graph.graph, {*graph.portals(LaneKind.ENTRANCE)}, weight="length_m")
    return {square: round(found.get(node, math.inf), _ROUNDING) for square, node in lanes.number_of.items()}


def _aisles(
    lanes: LaneSquares, driven_m: Mapping[Square, float], counts: Mapping[Square, int], most_stalls: float
) -> list[tuple[_Stretch, ...]]:
    """Return the aisles in the order in which they are reached from an entrance, each from its nearer end.

    Stretches with more than `most_stalls` stalls are divided at their bends.
    """
    ways = []
    for aisle in aisles_of(lanes.structure):
        nearer = min(aisle, tuple(stretch[::-1] for stretch in aisle[::-1]), key=lambda way: (driven_m[way[0][0]], way))
        is_long = [sum(counts.get(square, 0) for square in stretch) > most_stalls for stretch in nearer]
        parts = (_sides_of(way) if divided else [way] for way, divided in zip(nearer, is_long, strict=True))
        ways.append(tuple(chain.from_iterable(parts)))
    return sorted(ways, key=lambda way: (min(driven_m[square] for stretch in way for square in stretch), way))


def _sides_of(stretch: _Stretch) -> Iterator[_Stretch]:
    """Divide a stretch at its bends; adjacent parts share the square of the bend."""
    begin = 0
    for index, (before, after) in enumerate(zip(stretch, stretch[2:], strict=False), start=1):
        if before[0] != after[0] and before[1] != after[1]:
            yield stretch[begin : index + 1]
            begin = index
    yield stretch[begin:]


def _owners(aisles: Sequence[tuple[_Stretch, ...]]) -> dict[Square, _Stretch]:
    """Return the stretch to which the stalls on each square open; at a junction, that which ends there and goes on."""
    inner = {square: stretch for aisle in aisles for stretch in aisle for square in stretch[1:-1]}
    crossed = {stretch[-1]: stretch for aisle in aisles for stretch, _ in pairwise(aisle)}
    ends = {square: stretch for aisle in aisles for stretch in aisle for square in (stretch[0], stretch[-1])}
    return ends | inner | crossed


def _zones(
    aisles: Sequence[tuple[_Stretch, ...]],
    owners: Mapping[Square, _Stretch],
    counts: Mapping[Square, int],
    usual_stalls: float,
) -> dict[_Place, set[_Stretch]]:
    """Return the stretches of lane of each zone, in the order of the way from the entrance."""
    stalls: Counter[_Stretch] = Counter()
    for square, count in counts.items():
        stalls[owners[square]] += count
    places: dict[_Stretch, _Place] = {}
    short = []
    for number, aisle in enumerate(aisles):
        left = sum(stalls[stretch] for stretch in aisle)
        if left < _FEW_STALLS:
            short.append((number, aisle))
            continue
        part, held, share = 0, 0, left / max(1, round(left / usual_stalls))
        for stretch in aisle:
            if held + stalls[stretch] / 2 > share and min(held, left) >= _FEW_STALLS:
                part, held = part + 1, 0
            places[stretch] = number, part
            held, left = held + stalls[stretch], left - stalls[stretch]
    for number, aisle in short:
        beside = [places[owners[end]] for end in (aisle[0][0], aisle[-1][-1]) if owners[end] in places]
        places.update(dict.fromkeys(aisle, min(beside, default=(number, 0))))
    zones: dict[_Place, set[_Stretch]] = {place: set() for place in sorted({*places.values()})}
    for stretch, place in places.items():
        zones[place].add(stretch)
    return {place: own for place, own in zones.items() if any(stalls[stretch] for stretch in own)}


def zone_names(places: Sequence[_Place]) -> dict[_Place, str]:
    """Name the zones; more aisles than letters share letters, and neighbours share names in the largest garages."""
    aisles = {aisle: rank for rank, aisle in enumerate(dict.fromkeys(aisle for aisle, _ in places))}
    of_letter: defaultdict[str, list[_Place]] = defaultdict(list)
    for place in places:
        of_letter[_LETTERS[aisles[place[0]] * len(_LETTERS) // max(len(aisles), len(_LETTERS))]].append(place)
    return {
        place: f"{letter}{number * _MOST_NUMBER // max(len(own), _MOST_NUMBER) + 1}"
        for letter, own in of_letter.items()
        for number, place in enumerate(own)
    }


def _round_trip(squares: Collection[Square], driven_m: Mapping[Square, float], *, keeps_left: bool) -> Iterator[_Side]:
    """Yield the edges around some lanes as a driver passes them who keeps to them, from the nearest way in.

    The outline comes first, then the blocks inside it that it does not touch.
    """
    around = [(square, edge) for square in squares for edge in Edge if edge.beyond(square) not in squares]
    around.sort(key=lambda side: (driven_m.get(side[1].beyond(side[0]), math.inf), driven_m[side[0]], side))
    done: set[_Side] = set()
    for square, edge in around:
        while (square, edge) not in done:
            yield square, edge
            done.add((square, edge))
            ahead = _ahead(edge, keeps_left=keeps_left)
            if (beyond := ahead.beyond(square)) not in squares:
                edge = ahead  # noqa: PLW2901 - the walk goes on until it comes back
            elif (around_corner := edge.beyond(beyond)) in squares:
                square, edge = around_corner, ahead.opposite  # noqa: PLW2901 - as above
            else:
                square = beyond  # noqa: PLW2901 - as above


def _ahead(edge: Edge, *, keeps_left: bool) -> Edge:
    """Return the direction of driving along an edge of a lane, on the side of traffic."""
    return _BESIDE[edge].opposite if keeps_left else _BESIDE[edge]


def _along_m(stall: PlacedStall, ahead: Edge) -> float:
    """Return the place of a stall's mouth along a direction of driving."""
    down, right = ahead.beyond((0, 0))
    return round(sum(right * x + down * z for x, z in stall.corners_m()[:2]), _ROUNDING)
