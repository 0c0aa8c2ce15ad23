"""The parked cars of many whole garages against the tables of their market.

Usage: python benchmarks/fleet.py [--market NAME ...] [--garages N] [--first SEED]

Plans garages of 7 to 9 by 6 to 8 squares, half of them with a contour of rectangles, in turns with the stalls of each
profile that is shipped, proves their stalls and measures the cars where they stand. No stage is written.
"""

import argparse
import math
from collections import Counter
from collections.abc import Iterable
from typing import NamedTuple

import numpy as np
import shapely

from garage2usd.config import GarageConfig
from garage2usd.config.markets import MARKET_NAMES, load_market
from garage2usd.config.vehicles import PAINTS, SEGMENTS, body_named
from garage2usd.layout import Layout, PlacedStall, Placement
from garage2usd.objects.car import CarSpec
from garage2usd.pipeline import generate
from garage2usd.profiles import PROFILE_NAMES

__all__ = ["Parked", "body_ground", "fleet", "garage_config", "parked_in", "posture", "shares_of", "table"]

MARKET, GARAGES = "world", 500
OVER_LINE = 0.02
_OCCUPANCY, _EPISODES = 0.9, 60


class Parked(NamedTuple):
    """A parked car as it stands in its stall.

    Attributes
    ----------
    segment, paint
        Class of its body, and its paint.
    is_out
        Whether it stands nose out.
    is_over
        Whether its body stands over a line.
    side_m, yaw_deg
        How far it stands to the right of the middle of its stall as one looks in, and its angle to the stall.
    """

    segment: str
    paint: str
    is_out: bool
    is_over: bool
    side_m: float
    yaw_deg: float


def posture(car: Placement, stall: PlacedStall) -> tuple[float, float, bool]:
    """Metres to the side, degrees, and whether nose out, of a car in its stall, measured in the garage."""
    (x, _, z), (cx, cz) = car.position_m, stall.centre_m
    (ax, az), (bx, bz) = stall.corners_m()[:2]
    across = np.array([bx - ax, bz - az]) / math.dist((ax, az), (bx, bz))
    turn = math.remainder(car.yaw_rad - stall.yaw_rad, math.tau)
    is_out = abs(turn) > math.pi / 2
    yaw = math.remainder(turn - (math.pi if is_out else 0), math.tau)
    return float(np.dot(across, (x - cx, z - cz))), math.degrees(yaw), is_out


def body_ground(car: Placement) -> shapely.Polygon:
    """The (x, z) polygon in metres of a car's body without its mirrors."""
    body, (x, _, z) = body_named(_spec(car).body), car.position_m
    box = shapely.box(-body.width_m / 2, -body.length_m / 2, body.width_m / 2, body.length_m / 2)
    turned = shapely.affinity.rotate(box, -math.degrees(car.yaw_rad), origin=(0, 0))
    return shapely.affinity.translate(turned, x, z)


def parked_in(layout: Layout) -> list[Parked]:
    """The parked cars of a garage."""
    stalls = {stall.name: stall for stall in layout.stalls}
    found = []
    for car in layout.of_kind("car"):
        stall, spec = stalls[car.stall or ""], _spec(car)
        side_m, yaw_deg, is_out = posture(car, stall)
        is_over = not shapely.Polygon(stall.corners_m()).covers(body_ground(car))
        found.append(Parked(body_named(spec.body).segment, spec.paint, is_out, is_over, side_m, yaw_deg))
    return found


def garage_config(number: int, market: str) -> GarageConfig:
    """The settings of one garage of many."""
    width, height = 7 + number // 4 % 3, 6 + number // 12 % 3
    return GarageConfig(
        seed=number,
        profile=PROFILE_NAMES[number % len(PROFILE_NAMES)],
        site={"width_cells": width, "height_cells": height, "rectangles": 2 * (number // 36 % 2)},
        plan={"episodes": _EPISODES},
        parking={"market": market, "occupancy": _OCCUPANCY},
    )


def shares_of(cars: Iterable[Parked], market: str) -> list[tuple[str, float, float]]:
    """Name, share in the table and share among some cars of each class, each paint, cars nose out and over a line."""
    cars, wanted = list(cars), load_market(market)
    found = [
        (Counter(car.segment for car in cars), wanted.segments.shares, SEGMENTS),
        (Counter(car.paint for car in cars), wanted.paints.shares, PAINTS),
    ]
    rows = [
        (name, table.get(name, 0.0) / sum(table.values()), counts[name] / len(cars))
        for counts, table, names in found
        for name in names
    ]
    return [
        *rows,
        ("nose out", wanted.reversed.share, sum(car.is_out for car in cars) / len(cars)),
        ("over a line", OVER_LINE, sum(car.is_over for car in cars) / len(cars)),
    ]


def table(cars: list[Parked], market: str, garages: int) -> str:
    """The table of a market against its cars, in Markdown."""
    rows = shares_of(cars, market)
    sides, yaws = (np.array([getattr(car, name) for car in cars if not car.is_over]) for name in ("side_m", "yaw_deg"))
    name, worst = max(((name, abs(found - wanted)) for name, wanted, found in rows), key=lambda row: row[1])
    lines = [f"| {name} | {wanted:.1%} | {found:.1%} | {found - wanted:+.2%} |" for name, wanted, found in rows]
    told = (
        f"Farthest from its table: {name}, {100 * worst:.2f} points. Beside the middle of the stall: "
        f"{sides.mean():+.3f} m, standard deviation {sides.std():.3f} m; angle {yaws.mean():+.2f} degrees, "
        f"standard deviation {yaws.std():.2f} degrees."
    )
    head = "| share | table | garages | difference |\n|---|---|---|---|"
    return "\n\n".join([f"### {market}: {len(cars):,} cars in {garages} garages", told, "\n".join([head, *lines])])


def fleet(markets: Iterable[str] = (MARKET,), garages: int = GARAGES, first: int = 0) -> str:
    """A section for each of some markets, each over its own garages."""
    sections = []
    for market in markets:
        cars = []
        for number in range(first, first + garages):
            cars += parked_in(generate(garage_config(number, market)).layout)
        sections.append(table(cars, market, garages))
    return "\n\n".join(sections)


def _spec(car: Placement) -> CarSpec:
    assert isinstance(car.spec, CarSpec)
    return car.spec


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--market", nargs="+", choices=MARKET_NAMES, default=[MARKET])
    parser.add_argument("--garages", type=int, default=GARAGES)
    parser.add_argument("--first", type=int, default=0)
    asked = parser.parse_args()
    print(fleet(asked.market, asked.garages, asked.first))
